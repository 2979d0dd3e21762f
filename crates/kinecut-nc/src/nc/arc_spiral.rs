//! Arcs whose ends differ in their distance from the centre, as LinuxCNC runs them: about the centre that is written, with a radius
//! that changes evenly by the angle, which is a part of an Archimedean spiral.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::base::Result;
use crate::geom::{Spiral, SpiralLaw};

use super::arc_fit::angle_between;

/// Difference of radius from which an arc is followed as a spiral [mm]: below it the arc through both ends is within half of this of the
/// control's path, as rounded words make nearly all arcs of a program.
pub(super) const APPARENT: f64 = 0.005;

/// The spiral from `from` to `to` about `centre` with `turns` further turns.
///
/// # Errors
/// `KC0801` when it has no length.
pub(super) fn spiral(from: DVec2, to: DVec2, centre: DVec2, ccw: bool, turns: u32) -> Result<Spiral> {
    let (begin, end) = (from - centre, to - centre);
    let (first, last) = (begin.length(), end.length());
    let between = angle_between(begin, end);
    let swept = (if ccw { between } else { -between }).rem_euclid(TAU) + TAU * f64::from(turns);
    let growth = (last - first).abs() / swept;
    let part = Spiral::new(SpiralLaw::Archimedes { growth }, first / growth, last / growth)?;
    // The law runs counter-clockwise with a growing radius.
    let part = if ccw == (last > first) { part } else { part.mirrored() };
    let turned = begin.to_angle() - part.start().to_angle();
    Ok(part.rotated(turned).shifted(centre))
}

/// Centre and signed angle of a part of an Archimedean spiral about its centre [rad].
pub(super) fn as_arc(spiral: &Spiral) -> Option<(DVec2, f64)> {
    let SpiralLaw::Archimedes { .. } = spiral.law() else { return None };
    let (mirrored, _, centre) = spiral.placement();
    let [from, to] = spiral.parameters();
    Some((centre, if mirrored { from - to } else { to - from }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_begins_and_ends_where_the_block_says_and_is_half_way_between_in_radius() {
        let centre = DVec2::new(3.0, -2.0);
        for (from, to) in [(50.0, 50.02), (50.02, 50.0)] {
            for ccw in [true, false] {
                for turns in [0, 2] {
                    let (begin, end) = (centre + DVec2::X * from, centre + DVec2::Y * to);
                    let part = spiral(begin, end, centre, ccw, turns).unwrap();
                    assert!(part.start().distance(begin) < 1e-9 && part.end().distance(end) < 1e-9);
                    let quarter = if ccw { 0.25 } else { 0.75 };
                    let (about, sweep) = as_arc(&part).unwrap();
                    let wanted = TAU * (quarter + f64::from(turns)) * if ccw { 1.0 } else { -1.0 };
                    assert!(about.distance(centre) < 1e-12 && (sweep - wanted).abs() < 1e-9, "{sweep}");
                    let [a, b] = part.parameters();
                    let middle = part.point(0.5 * (a + b)) - centre;
                    assert!((middle.length() - 50.01).abs() < 1e-9);
                    let goal = DVec2::from_angle(0.5 * wanted) * 50.01;
                    assert!(middle.distance(goal) < 1e-9);
                }
            }
        }
    }
}
