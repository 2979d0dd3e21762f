//! Arrows of motions: straight ones on the visible side of a body, turning ones about it.

use std::f64::consts::PI;

use super::bodies::Link;
use super::solid::{Place, Shape, Solid, VIEWER, across, dot, project};

/// Points of a turning arrow.
const STEPS: usize = 28;
/// How far a turning arrow goes to each side of what is nearest to the viewer [rad].
const TURN: f64 = 0.52 * PI;
/// How far a turning arrow stands off its body, as a share of the radius.
const OFF: f64 = 1.16;

/// The arrow of a link on paper, its head last [mm of the model]. The positive direction of an axis that carries the work
/// is that of its slide (ISO 841: X', C'), opposite to that of the tool relative to the work.
pub(super) fn motion_arrow(link: &Link, body: &Solid) -> Vec<[f64; 2]> {
    let axis = if link.work { link.axis.map(|c| -c) } else { link.axis };
    if link.motion.is_rotation() { turning(axis, body) } else { straight(axis, body) }
}

fn straight(axis: Place, body: &Solid) -> Vec<[f64; 2]> {
    let [low, high] = body.bounds();
    let middle = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
    // On the front face, or on the right one for what goes back.
    let mut at = middle;
    if axis[1].abs() > 0.5 {
        at[0] = high[0]
    } else {
        at[1] = low[1]
    }
    let extent = [0, 1, 2].map(|k| axis[k].abs() * (high[k] - low[k])).iter().sum::<f64>();
    let smallest = (0..3).map(|k| high[k] - low[k]).fold(f64::INFINITY, f64::min);
    let half = (0.36 * extent).max(0.9 * smallest.min(extent));
    [-half, half].map(|s| project([0, 1, 2].map(|k| at[k] + s * axis[k]))).to_vec()
}

fn turning(axis: Place, body: &Solid) -> Vec<[f64; 2]> {
    let Shape::Drum { centre, radius, half, .. } = body.shape else { return Vec::new() };
    let [u, v] = across(axis);
    // Upright drums carry the arrow round their middle, others on the end that is seen.
    let side = if axis[2].abs() > 0.5 { 0.0 } else { half * dot(axis, VIEWER).signum() };
    let off = if axis[2].abs() > 0.5 { OFF } else { 0.72 };
    let nearest = dot(v, VIEWER).atan2(dot(u, VIEWER));
    let at = |i: usize| {
        let angle = nearest - TURN + 2.0 * TURN * i as f64 / STEPS as f64;
        let (sin, cos) = angle.sin_cos();
        let r = off * radius;
        project([0, 1, 2].map(|k| centre[k] + side * axis[k] + r * (cos * u[k] + sin * v[k])))
    };
    (0..=STEPS).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::super::style::Look;
    use super::*;
    use crate::machine::Elementary;

    #[test]
    fn a_slide_that_carries_the_work_points_the_other_way() {
        let body = Solid::block(Look::Work, [0.0; 3], [400.0, 300.0, 50.0]);
        let link = |work| Link { motion: Elementary::X, work, axis: [1.0, 0.0, 0.0], body: 0 };
        let right = |work| {
            let arrow = motion_arrow(&link(work), &body);
            arrow[1][0] - arrow[0][0]
        };
        assert!(right(false) > 100.0 && right(true) < -100.0);
    }

    #[test]
    fn a_turning_arrow_goes_counterclockwise_seen_from_above() {
        let up = [0.0, 0.0, 1.0];
        let body = Solid::drum(Look::Tool, [0.0; 3], up, 100.0, 20.0);
        let link = Link { motion: Elementary::C, work: false, axis: up, body: 0 };
        let arrow = motion_arrow(&link, &body);
        // The front is nearest: counterclockwise from above passes there from left to right.
        assert!(arrow[STEPS][0] > arrow[0][0]);
    }
}
