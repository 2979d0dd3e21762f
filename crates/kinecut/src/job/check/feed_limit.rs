//! Limits that the feeds of a program keep to.

use crate::base::{Code, Finding, Result};
use crate::machine::Machine;
use crate::motion::{AxisLimit, axis_limits};
use crate::operations::FeedsName;

/// The least limits of the linear axes; `None` where feeds are written as they are.
///
/// # Errors
/// `KC0103` where feeds are wanted within limits that the machine does not state.
pub(super) fn feed_limit(said: Option<FeedsName>, machine: Option<&Machine>) -> Result<Option<AxisLimit>> {
    if said == Some(FeedsName::AsProgrammed) {
        return Ok(None);
    }
    let limits = machine.map(axis_limits).unwrap_or_default();
    let least = limits[..3].iter().flatten().copied().reduce(|a, b| AxisLimit {
        velocity: a.velocity.min(b.velocity),
        acceleration: a.acceleration.min(b.acceleration),
        jerk: a.jerk.min(b.jerk),
    });
    if least.is_none() && said.is_some() {
        return Err(Finding::error(
            Code::JOB_VALUE,
            "the machine states no limits that feeds could be lowered to",
        )
        .help("give the machine `dynamics = { rapid = .., acceleration = .. }`, or leave `feeds` out")
        .key("post.feeds")
        .into());
    }
    Ok(least)
}
