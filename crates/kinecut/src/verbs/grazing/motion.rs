//! The motion of a grazing table as a twist of the tool.

use glam::{DMat3, DVec3};
use serde::Serialize;

use super::{GrazingTable, TwistTable, moment};
use crate::base::{Code, Finding, Loader, Result};
use crate::geom::Rigid;
use crate::machine::Twist;
use crate::sweep::twist_of;
use crate::tool::Contour;

/// Seconds of a minute: the border between the shop's units and those inside.
const MINUTE: f64 = 60.0;
/// Largest speed that is taken [mm/s, rad/s]: beyond it products of velocities overflow nothing yet, and nothing moves so.
const FASTEST: f64 = 1e12;

/// Where a motion comes from.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum MotionSource {
    /// Given as a twist.
    Twist,
    /// From a pose and its rate.
    Pose(#[serde(serialize_with = "super::json::pose")] Rigid),
    /// A moment of a program.
    #[serde(untagged)]
    Moment {
        /// The block.
        block: String,
        /// Line, from 1.
        line: u32,
        /// Part of the way.
        part: f64,
        /// Tool to part; X of the tool is where the feed goes.
        #[serde(serialize_with = "super::json::pose")]
        pose: Rigid,
        /// Name of the program.
        program: String,
    },
}

/// A motion, and the tool where the program names it.
pub(crate) struct Moving {
    pub(crate) twist: Twist,
    pub(crate) source: MotionSource,
    pub(crate) tool: Option<(String, Contour)>,
}

/// The motion of a table, and if it is wanted the tool of the program.
pub(crate) fn motion(table: &GrazingTable, loader: &dyn Loader, with_tool: bool) -> Result<Moving> {
    let given = [table.twist.is_some(), table.pose.is_some(), table.moment.is_some()];
    if given.iter().filter(|g| **g).count() != 1 {
        return Err(Finding::error(Code::GRAZING_MOTION, "the motion of the tool is not given once")
            .value(given.iter().filter(|g| **g).count() as f64, "motions")
            .bound(1.0, "")
            .help("give one of: twist = { velocity = [..], turn = [..] }; pose and rate; moment = { job = .., line = .. }")
            .into());
    }
    let plain = |twist, source| Moving { twist, source, tool: None };
    if let Some(twist) = &table.twist {
        return Ok(plain(of_twist(twist)?, MotionSource::Twist));
    }
    if let Some(pose) = &table.pose {
        let (rotation, at) = rows("pose", pose, 1.0)?;
        let rate = table.rate.as_ref().ok_or_else(|| {
            Finding::error(Code::GRAZING_MOTION, "a pose without its rate is no motion")
                .key("rate")
                .help("give rate: rows of the derivative [R' p'] per second")
        })?;
        let (turning, velocity) = rows("rate", rate, 0.0)?;
        let pose = Rigid { rotation, translation: at };
        let twist = twist_of(&pose, turning, velocity).map_err(|e| e.under("pose"))?;
        return Ok(plain(bounded("rate", twist)?, MotionSource::Pose(pose)));
    }
    match &table.moment {
        Some(m) => moment::moment(m, with_tool, loader).map_err(|e| e.under("moment")),
        None => Err(Finding::error(Code::GRAZING_MOTION, "there is no motion").into()),
    }
}

fn of_twist(table: &TwistTable) -> Result<Twist> {
    for (key, v) in [("velocity", table.velocity), ("turn", table.turn), ("at", table.at)] {
        if let Some(i) = v.iter().position(|c| !(c.abs() <= FASTEST)) {
            return Err(Finding::error(
                Code::JOB_VALUE,
                "a number of the twist is not finite or out of all measure",
            )
            .value(v[i], "")
            .bound(FASTEST, "")
            .key(format!("twist.{key}[{i}]"))
            .into());
        }
    }
    let turn = DVec3::from(table.turn.map(f64::to_radians)) / MINUTE;
    let velocity = DVec3::from(table.velocity) / MINUTE;
    Ok(Twist { turn, shift: velocity - turn.cross(DVec3::from(table.at)) })
}

fn bounded(key: &str, twist: Twist) -> Result<Twist> {
    let most = twist.turn.abs().max_element().max(twist.shift.abs().max_element());
    if most <= FASTEST {
        return Ok(twist);
    }
    Err(Finding::error(Code::JOB_VALUE, "the motion is out of all measure")
        .value(most, "")
        .bound(FASTEST, "")
        .key(key)
        .into())
}

/// Rows of `[R p]`, with or without the last row `[0 0 0 corner]`.
pub(crate) fn rows(key: &str, rows: &[Vec<f64>], corner: f64) -> Result<(DMat3, DVec3)> {
    let shape = |what: &str| {
        Finding::error(Code::JOB_SHAPE, what.to_owned())
            .key(key)
            .help("give three rows of four numbers: [R p]; a fourth row [0, 0, 0, 1], of a rate [0, 0, 0, 0], may follow")
    };
    if !(3..=4).contains(&rows.len()) || rows.iter().any(|r| r.len() != 4) {
        return Err(shape("a matrix has not three or four rows of four numbers").into());
    }
    if rows.iter().flatten().any(|v| !v.is_finite()) {
        return Err(shape("a matrix has a number that is not finite").into());
    }
    if rows.get(3).is_some_and(|last| last[..] != [0.0, 0.0, 0.0, corner]) {
        return Err(shape("the last row of a matrix is not that of a rigid motion").into());
    }
    let column = |k: usize| DVec3::new(rows[0][k], rows[1][k], rows[2][k]);
    Ok((DMat3::from_cols(column(0), column(1), column(2)), column(3)))
}
