//! Strokes that a part and a tool need.
//!
//! At each orientation of the worked range the three translations follow from the place of the tip, `D x = p - p0`: `D` has
//! the directions of the translations as turned by the rotary axes before them, `p0` the tip with them at zero. Over a
//! box of places each row of `D^-1` gives its interval in closed form, so only orientations are sampled. Rotary axes of a table
//! pass through the middle of the part's foot, those of a head lie one tool length behind the tip.

use glam::{DMat3, DVec3};

use super::Sizes;
use crate::machine::{CoordinateCode, Elementary};

/// Steps of a rotary axis over its range: with 36 in a turn an extent is short by 0.4 % at most (1 - cos 5 degrees).
const STEPS: u32 = 36;
/// Steps where there are more than two rotary axes.
const FEW_STEPS: u32 = 9;
/// Below this volume of the unit translations an orientation is not used.
const FLAT: f64 = 0.05;

/// Strokes needed for the part of these sizes, or `None` where there is no part or the code has not three translations.
pub fn needed_strokes(code: &CoordinateCode, sizes: &Sizes) -> Option<[f64; 3]> {
    let part = DVec3::from_array(sizes.part?);
    let motions = &code.word().0;
    if motions.iter().filter(|m| !m.is_rotation()).count() != 3 {
        return None;
    }
    let spindle = sizes.spindle();
    let (half, middle) = (part * 0.5, DVec3::new(0.0, 0.0, 0.5 * part.z));
    let rotary: Vec<usize> = (0..motions.len()).filter(|&i| motions[i].is_rotation()).collect();
    let steps = if rotary.len() > 2 { FEW_STEPS } else { STEPS };
    let mut values = vec![0.0; motions.len()];
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let ranges = motions.iter().map(|&m| worked_range(m, sizes)).collect::<Vec<_>>();
    let cases = (u64::from(steps) + 1).pow(rotary.len() as u32);
    for case in 0..cases {
        let mut digits = case;
        for &i in &rotary {
            let [from, to] = ranges[i];
            values[i] = from + (to - from) * (digits % (u64::from(steps) + 1)) as f64 / f64::from(steps);
            digits /= u64::from(steps) + 1;
        }
        let mut turn = DMat3::IDENTITY;
        let mut at = DVec3::ZERO;
        let mut columns = [DVec3::ZERO; 3];
        for (i, &motion) in motions.iter().enumerate() {
            let axis = sizes.direction(motion);
            if motion.is_rotation() {
                let pivot = if i < code.bed() { DVec3::ZERO } else { spindle * sizes.tool_length };
                let rotation = DMat3::from_axis_angle(axis, values[i]);
                at += turn * (pivot - rotation * pivot);
                turn *= rotation;
            } else {
                columns[usize::from(motion.digit()) - 1] = turn * axis;
            }
        }
        // The tip is at zero at home, so `at` is where it comes by turning alone.
        let tilt = (turn * spindle).dot(spindle).clamp(-1.0, 1.0).acos();
        let matrix = DMat3::from_cols(columns[0], columns[1], columns[2]);
        if tilt > sizes.worked_tilt + 1e-9 || matrix.determinant().abs() < FLAT {
            continue;
        }
        let rows = matrix.inverse().transpose();
        for (k, row) in [rows.x_axis, rows.y_axis, rows.z_axis].into_iter().enumerate() {
            let tool = -row.dot(at);
            let (centre, extent) = (row.dot(middle), row.abs().dot(half));
            low[k] = low[k].min(centre + tool - extent);
            high[k] = high[k].max(centre + tool + extent);
        }
    }
    low.iter().all(|v| v.is_finite()).then(|| [0, 1, 2].map(|k| high[k] - low[k]))
}

/// The part of a rotary axis' range that is worked: A and B tilt the tool by their own angle, so no more than the
/// worked tilt of them is used.
fn worked_range(motion: Elementary, sizes: &Sizes) -> [f64; 2] {
    let [from, to] = sizes.range(motion);
    let tilt = sizes.worked_tilt;
    match motion {
        Elementary::A | Elementary::B if from < tilt && to > -tilt => [from.max(-tilt), to.min(tilt)],
        _ => [from, to],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn needed(code: &str, sizes: &Sizes) -> [f64; 3] {
        needed_strokes(&CoordinateCode::parse(code).unwrap(), sizes).unwrap()
    }

    #[test]
    fn strokes_of_simple_machines_are_those_of_part_and_swing() {
        let sizes = Sizes { part: Some([300.0, 200.0, 100.0]), tool_length: 150.0, ..Sizes::default() };
        let near = |a: [f64; 3], b: [f64; 3], by: f64| a.iter().zip(b).all(|(x, y)| (x - y).abs() <= by);
        assert!(near(needed("2103", &sizes), [300.0, 200.0, 100.0], 1e-9));
        // A round table: the diagonal of the part in X and Y.
        let diagonal = 300f64.hypot(200.0);
        let table = needed("62103", &sizes);
        assert!(near(table, [diagonal, diagonal, 100.0], 0.004 * diagonal), "{table:?}");
        // A head that swivels to both sides by a right angle: two tool lengths more in X, one more in Z.
        let head = needed("21035", &sizes);
        assert!(near(head, [300.0 + 300.0, 200.0, 100.0 + 150.0], 1e-9), "{head:?}");
        // A trunnion about X tilts a part that lies on its axis: Y from -100 to 100 becomes 100 both ways, Z from -100
        // (the foot's edge) to the top corner.
        let trunnion = needed("42103", &sizes);
        let top = 100f64.hypot(100.0);
        assert!(near(trunnion, [300.0, 2.0 * top, top + 100.0], 0.01 * top), "{trunnion:?}");
        assert!(needed_strokes(&CoordinateCode::parse("6031").unwrap(), &sizes).is_none());
    }

    #[test]
    fn less_tilt_needs_less_stroke() {
        let sizes = |tilt| Sizes { part: Some([100.0; 3]), worked_tilt: tilt, ..Sizes::default() };
        let [steep, flat] = [FRAC_PI_2, 0.5].map(|t| needed("012365", &sizes(t)));
        assert!(flat[0] < steep[0] && flat[2] < steep[2], "{flat:?} {steep:?}");
        assert!((flat[0] - (100.0 + 400.0 * 0.5f64.sin())).abs() < 1e-6, "{flat:?}");
    }
}
