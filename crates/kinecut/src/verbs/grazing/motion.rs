//! The motion of a grazing table as a twist of the tool.

use super::given_motion::{GivenMotion, MotionSource};
use super::{GrazingTable, moment};
use crate::base::{Code, Finding, Loader, Result};
use crate::sweep::twist_of_rows;

/// The motion of a table, and if it is wanted the tool of the program.
pub(crate) fn motion(table: &GrazingTable, loader: &dyn Loader, with_tool: bool) -> Result<GivenMotion> {
    let given = [table.twist.is_some(), table.pose.is_some(), table.moment.is_some()];
    if given.iter().filter(|g| **g).count() != 1 {
        return Err(Finding::error(Code::GRAZING_MOTION, "the motion of the tool is not given once")
            .value(given.iter().filter(|g| **g).count() as f64, "motions")
            .bound(1.0, "")
            .help("give one of: twist = { velocity = [..], turn = [..] }; pose and rate; moment = { job = .., line = .. }")
            .into());
    }
    let plain = |twist, source| GivenMotion { twist, source, tool: None };
    if let Some(given) = &table.twist {
        return given.twist().map(|t| plain(t, MotionSource::Twist)).map_err(|e| e.under("twist"));
    }
    if let Some(pose) = &table.pose {
        let (pose, twist) = twist_of_rows(pose, table.rate.as_deref())?;
        return Ok(plain(twist, MotionSource::Pose(pose)));
    }
    match &table.moment {
        Some(m) => moment::moment(m, with_tool, loader).map_err(|e| e.under("moment")),
        None => Err(Finding::error(Code::GRAZING_MOTION, "there is no motion").into()),
    }
}
