//! Room in a hole for the straight lines on which the control switches its compensation on and off.

use super::{ThreadMillSpec, ThreadSide};
use crate::base::{Code, Finding, Result};

/// Lengths of the lines that are tried: a multiple of the largest correction and a constant [mm].
const LINES: [(f64, f64); 3] = [(2.0, 1.0), (1.5, 0.5), (1.25, 0.1)];
/// Way between the cutter and the wall of the hole [mm].
const CLEAR: f64 = 0.02;

/// Length of the lines; 0 without a register. `radius`: the least of the path.
///
/// # Errors
/// `KC0404` for a correction for which the arcs are too tight or the hole is too narrow.
pub(super) fn line(spec: &ThreadMillSpec, radius: f64) -> Result<f64> {
    let Some(wear) = spec.wear else { return Ok(0.0) };
    let (share, more) = LINES[0];
    if spec.side == ThreadSide::Outside {
        return Ok(share * wear.largest + more);
    }
    let refused = |what: &str, bound: f64| {
        let finding = Finding::error(Code::PLAN_VALUE, what).value_mm(wear.largest).bound_mm(bound);
        finding.help("allow a smaller correction, or take a smaller cutter").key("wear_largest")
    };
    // The half circles from the axis to the helix.
    if wear.largest >= 0.5 * radius {
        return Err(
            refused("the arcs to the thread are too tight for this wear correction", 0.5 * radius).into()
        );
    }
    let narrowest = spec.thread.minor_diameter() + 2.0 * spec.thread.widening(spec.side, spec.depth);
    let open = 0.5 * (narrowest - spec.cutter.mill.diameter) - CLEAR;
    for (share, more) in LINES {
        let long = share * wear.largest + more;
        if long.hypot(wear.largest) <= open {
            return Ok(long);
        }
    }
    let (share, more) = LINES[2];
    let most = (open - more) / share;
    Err(refused(
        "the hole has no room to switch this wear correction on",
        if most > 0.0 { most } else { 0.0 },
    )
    .into())
}
