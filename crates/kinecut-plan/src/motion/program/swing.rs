//! Turns of rotary axes on the spot: where a move begins or ends with the tool along a rotary axis, that axis is free there, and
//! it must turn before the tool can leave, or after it came.

use super::super::{AxisLimit, SCurve};
use super::joint::AXES;
use crate::trace::AxisPath;

/// Part of a move beside its end.
pub(super) const BESIDE: f64 = 1e-6;
/// Least turn that counts [rad]: far above that of a regular move on that part.
const LEAST: f64 = 1e-3;

/// Positions of the axes at the start of a move and beside it, and beside its end and at it [mm, rad].
pub(super) fn around_ends(path: &AxisPath) -> [[[f64; AXES]; 2]; 2] {
    let at = |part: f64| path.at(part * path.length()).map(|jet| jet.q);
    [[at(0.0), at(BESIDE)], [at(1.0 - BESIDE), at(1.0)]]
}

/// Turn of the axes on the spot at the start and at the end of a move [mm, rad], if they make one.
pub(super) fn swings(path: &AxisPath) -> [Option<[f64; AXES]>; 2] {
    around_ends(path).map(|[from, to]| {
        let turn: [f64; AXES] = std::array::from_fn(|a| (to[a] - from[a]).abs());
        turn[3..].iter().any(|t| *t > LEAST).then_some(turn)
    })
}

/// Time in which all axes turn by this from rest to rest [s]; `None` if one of them has no limits.
pub(super) fn swing_time(turn: &[f64; AXES], limits: &[Option<AxisLimit>; AXES]) -> Option<f64> {
    let mut time = 0.0_f64;
    for (turn, limit) in turn.iter().zip(limits) {
        if *turn > 0.0 {
            time = time.max(SCurve::new(*turn, (*limit)?).duration());
        }
    }
    Some(time)
}
