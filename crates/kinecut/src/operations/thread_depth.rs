//! Depth of a thread: as a table says it, or through the stock.

use super::Around;
use super::setting::corners;
use crate::base::bounded::{MAX_LENGTH, positive};
use crate::base::{Code, Finding, Result};

/// The depth of full thread below a height [mm]: where the table does not say it, down to the underside of the raw stock.
///
/// # Errors
/// `KC0103` for a depth out of range, `KC0102` where a tilted plane lacks one: the stock has no underside there.
pub(super) fn thread_depth(said: Option<f64>, top: f64, is_tilted: bool, around: &Around<'_>) -> Result<f64> {
    if let Some(depth) = said {
        return positive("depth", depth, MAX_LENGTH, "mm");
    }
    if is_tilted {
        let what = "a thread in a tilted plane needs its depth";
        let help = "give depth = .. below `top`: only along the work offset it is known where the stock ends";
        return Err(Finding::error(Code::JOB_SHAPE, what).help(help).key("plane").into());
    }
    let bottom = corners(&around.stock.stock.bounds(), &around.stock.to_work)
        .iter()
        .map(|c| c.z)
        .fold(f64::INFINITY, f64::min);
    if bottom >= top {
        let what = "the thread begins below the stock";
        return Err(Finding::error(Code::JOB_VALUE, what).value_mm(top).bound_mm(bottom).key("top").into());
    }
    Ok(top - bottom)
}
