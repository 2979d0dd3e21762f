//! The ways to the helix and from it, on its slope: half circles from the axis of a hole, quarter circles beside a boss.

use glam::DVec2;

use super::ThreadSide;

/// A lead about the axis of a thread [mm, rad]; a way out is the mirror image of a way in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lead {
    /// Its free end.
    pub(super) free: DVec2,
    /// Centre of its arc.
    pub(super) centre: DVec2,
    /// Angle of its arc, counter-clockwise.
    pub(super) sweep: f64,
    /// Direction away from the thread at the free end.
    pub(super) away: DVec2,
}

/// The lead at a place of the helix, by the direction from the axis to it and the radius; `turn`: 1 where the helix is run
/// counter-clockwise, `way_in`: 1, of a way out -1, `round`: radius of the arc beside a boss.
pub(super) fn lead(side: ThreadSide, out: DVec2, radius: f64, round: f64, [turn, way_in]: [f64; 2]) -> Lead {
    use std::f64::consts::{FRAC_PI_2, PI};
    // Along the helix there, and back to where the lead comes from.
    let back = -out.perp() * turn * way_in;
    match side {
        ThreadSide::Inside => {
            Lead { free: DVec2::ZERO, centre: 0.5 * radius * out, sweep: turn * PI, away: -back }
        }
        ThreadSide::Outside => {
            let centre = (radius + round) * out;
            Lead { free: centre + round * back, centre, sweep: -turn * FRAC_PI_2, away: out }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leads_are_tangent_to_the_helix_and_to_their_straight_lines() {
        for side in [ThreadSide::Inside, ThreadSide::Outside] {
            for turn in [1.0, -1.0] {
                for angle in [0.0, 0.7, 4.0] {
                    let out = DVec2::from_angle(angle);
                    let (on, along) = (3.0 * out, out.perp() * turn);
                    let way_in = lead(side, out, 3.0, 2.5, [turn, 1.0]);
                    let arm = way_in.free - way_in.centre;
                    let reached = way_in.centre + DVec2::from_angle(way_in.sweep).rotate(arm);
                    assert!(reached.distance(on) < 1e-12, "{side:?} {turn} {angle}");
                    let sense = way_in.sweep.signum();
                    assert!((arm.perp() * sense).normalize_or_zero().distance(-way_in.away) < 1e-12);
                    assert!(
                        ((on - way_in.centre).perp() * sense).normalize_or_zero().distance(along) < 1e-12
                    );
                    let way_out = lead(side, out, 3.0, 2.5, [turn, -1.0]);
                    let left = way_out.centre + DVec2::from_angle(way_out.sweep).rotate(on - way_out.centre);
                    assert!(left.distance(way_out.free) < 1e-12, "{side:?} {turn} {angle}");
                    let arm = (way_out.free - way_out.centre).perp() * way_out.sweep.signum();
                    assert!(arm.normalize_or_zero().distance(way_out.away) < 1e-12);
                }
            }
        }
    }
}
