//! Arrows of motions: straight ones on the visible side of a body, turning ones about it.

use std::f64::consts::PI;

use glam::DVec3;

use super::bodies::Link;
use super::solid::{Hub, Point3, Solid};
use crate::page::draw::View;

/// Points of a turning arrow.
const STEPS: usize = 28;
/// Angle of a turning arrow to each side of the place nearest to the viewer [rad].
const TURN: f64 = 0.52 * PI;
/// Radius of a turning arrow, as a share of that of its body.
const OFF: f64 = 1.16;

/// Ways to draw the arrow of a link, the usual one first, the head last. The positive direction
/// of an axis that carries the work is that of its slide (ISO 841: X', C'), opposite to that of the tool relative to the
/// work.
pub(crate) fn motion_arrows(link: &Link, body: &Solid, view: &View) -> Vec<Vec<DVec3>> {
    let axis = if link.work { link.axis.map(|c| -c) } else { link.axis };
    if link.motion.is_rotation() { turning(axis, link, body, view) } else { straight(axis, body) }
}

/// Along the front face, or the right one for what goes back; in its middle or nearer to its ends; along the edges of the
/// lid.
fn straight(axis: Point3, body: &Solid) -> Vec<Vec<DVec3>> {
    let [low, high] = body.bounds();
    let size = [0, 1, 2].map(|k| high[k] - low[k]);
    let extent = (0..3).map(|k| axis[k].abs() * size[k]).sum::<f64>();
    let smallest = size.into_iter().fold(f64::INFINITY, f64::min);
    let half = (0.36 * extent).max(0.9 * smallest.min(extent));
    let back = axis[1].abs() > 0.5;
    let mut ways = Vec::new();
    for (lid, along, shrink) in [
        (false, 0.5, 1.0),
        (false, 0.78, 0.5),
        (false, 0.22, 0.5),
        (true, 0.5, 1.0),
        (true, 0.8, 0.45),
        (true, 0.2, 0.45),
    ] {
        let mut at = [0, 1, 2].map(|k| {
            let share = if axis[k].abs() > 0.5 { along } else { 0.5 };
            low[k] + share * size[k]
        });
        match (lid, back) {
            (false, true) => at[0] = high[0],
            (false, false) => at[1] = low[1],
            // A little inside of the edge of the lid.
            (true, true) => (at[0], at[2]) = (high[0] - 0.1 * size[0], high[2]),
            (true, false) => (at[1], at[2]) = (low[1] + 0.1 * size[1], high[2]),
        }
        if lid && axis[2].abs() > 0.5 {
            continue;
        }
        let end = |s: f64| DVec3::from(at) + s * shrink * half * DVec3::from(axis);
        ways.push((0..=STEPS).map(|i| end(2.0 * i as f64 / STEPS as f64 - 1.0)).collect());
    }
    ways
}

/// Round the body, or on the end of it that is seen, or as far along the axis as the link says.
fn turning(axis: Point3, link: &Link, body: &Solid, view: &View) -> Vec<Vec<DVec3>> {
    let Some(Hub { centre, radius, half }) = link.hub.or(body.hub) else { return Vec::new() };
    let (axis, centre) = (DVec3::from(axis), DVec3::from(centre));
    let (u, v) = axis.any_orthonormal_pair();
    let seen = view.depth(axis).signum();
    let upright = axis.z.abs() > 0.5;
    let places: &[(f64, f64)] = if upright { &[(0.0, OFF)] } else { &[(1.0, 0.8), (0.0, OFF)] };
    let nearest = view.depth(v).atan2(view.depth(u));
    let arrow = |&(side, off): &(f64, f64)| {
        let along = side * seen * if upright { half } else { link.end.max(half) };
        let at = |i: usize| {
            let (sin, cos) = (nearest - TURN + 2.0 * TURN * i as f64 / STEPS as f64).sin_cos();
            centre + along * axis + off * radius * (cos * u + sin * v)
        };
        (0..=STEPS).map(at).collect()
    };
    places.iter().map(arrow).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Elementary;
    use crate::verbs::layouts::show::looks;

    #[test]
    fn a_slide_that_carries_the_work_points_the_other_way() {
        let body = Solid::block(looks::WORK, [0.0; 3], [400.0, 300.0, 50.0]);
        let link =
            |work| Link { motion: Elementary::X, work, axis: [1.0, 0.0, 0.0], body: 0, end: 0.0, hub: None };
        let right = |work| {
            let arrow = &motion_arrows(&link(work), &body, &View::isometric())[0];
            arrow[STEPS].x - arrow[0].x
        };
        assert!(right(false) > 100.0 && right(true) < -100.0);
    }

    #[test]
    fn a_turning_arrow_goes_counterclockwise_seen_from_above() {
        let up = [0.0, 0.0, 1.0];
        let body = Solid::drum(looks::TOOL, [0.0; 3], up, 100.0, 20.0);
        let link = Link { motion: Elementary::C, work: false, axis: up, body: 0, end: 0.0, hub: None };
        let view = View::isometric();
        let arrow = &motion_arrows(&link, &body, &view)[0];
        // The front is nearest: counterclockwise from above passes there from left to right.
        assert!(view.px(arrow[STEPS])[0] > view.px(arrow[0])[0]);
    }
}
