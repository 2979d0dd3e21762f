//! Turns of rotary axes on the spot: where a move begins or ends with the tool along a rotary axis, that axis is free there, and
//! it must turn before the tool can leave, or after it came.

use super::super::{AxisLimit, SCurve};
use super::joint::AXES;
use crate::trace::AxisPath;

/// Part of a move beside its end.
const BESIDE: f64 = 1e-6;
/// Least turn that counts [rad]: far above that of a regular move on that part.
const LEAST: f64 = 1e-3;

/// Turn of the axes on the spot at the start and at the end of a move [mm, rad]; `None` where there is none.
pub(super) fn swings(path: &AxisPath) -> [Option<[f64; AXES]>; 2] {
    let length = path.length();
    [[0.0, BESIDE], [1.0, 1.0 - BESIDE]].map(|[end, beside]| {
        let [end, beside] = [end, beside].map(|part| path.at(part * length).map(|jet| jet.q));
        let turn: [f64; AXES] = std::array::from_fn(|a| (beside[a] - end[a]).abs());
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
