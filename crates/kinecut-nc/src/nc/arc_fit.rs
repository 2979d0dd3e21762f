//! The arc that a block means: through both its ends exactly.
//!
//! The words of a block are rounded, so start and end differ in their distance from the centre. The arc that is
//! used has its centre moved along the chord onto the perpendicular bisector of start and end; its distance from
//! the chord, and with it the shape, stays. Writer and reader use the same rule, so that neither drifts.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

/// Centre on the bisector and angle turned, positive counter-clockwise; equal ends make a full circle.
///
/// ```text
/// ccw: turn = 2 atan2(half chord, signed distance of the centre to the left of the chord)
/// ```
pub(super) fn fit(start: DVec2, end: DVec2, centre: DVec2, ccw: bool) -> (DVec2, f64) {
    let sign = if ccw { 1.0 } else { -1.0 };
    let chord = end - start;
    let length = chord.length();
    if length == 0.0 {
        return (centre, sign * TAU);
    }
    let left = chord.perp() / length;
    let middle = 0.5 * (start + end);
    let distance = (centre - middle).dot(left);
    (middle + left * distance, sign * 2.0 * (0.5 * length).atan2(sign * distance))
}

/// Angle from one direction to another, in -pi to pi, positive counter-clockwise [rad]: to the last bits for small angles too, where an
/// arc cosine has half the digits.
pub(super) fn angle_between(from: DVec2, to: DVec2) -> f64 {
    from.perp_dot(to).atan2(from.dot(to))
}

/// Largest distance by which the centre of an arc of more than half a turn is moved onto the bisector of its ends
/// [mm]; beyond it the arc is read in parts. Our own rounding to three decimals leaves 0.0008 mm.
const SHIFT: f64 = 0.002;

/// A part of the arc that a block means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ArcPart {
    /// Its end; `None` at the end that the block names.
    pub(super) end: Option<DVec2>,
    pub(super) centre: DVec2,
    /// Signed angle [rad].
    pub(super) sweep: f64,
}

/// The arc of a block with `turns` further turns, as one curve where that keeps its shape: where the ends of a
/// long arc lie close together, their difference of radius must not move the far side.
pub(super) fn pieces(start: DVec2, end: DVec2, centre: DVec2, ccw: bool, turns: u32) -> Vec<ArcPart> {
    let (fitted, sweep) = fit(start, end, centre, ccw);
    let whole = sweep.signum() * TAU * f64::from(turns);
    let piece = |end, centre, sweep| ArcPart { end, centre, sweep };
    if (sweep + whole).abs() <= PI || (fitted - centre).length() <= SHIFT {
        return vec![piece(None, fitted, sweep + whole)];
    }
    let mut out = Vec::new();
    if turns > 0 {
        out.push(piece(Some(start), centre, whole));
    }
    if sweep.abs() <= PI {
        out.push(piece(None, fitted, sweep));
        return out;
    }
    let radius = 0.5 * ((start - centre).length() + (end - centre).length());
    let half = centre + DVec2::from_angle(0.5 * sweep).rotate(start - centre).normalize_or_zero() * radius;
    for (from, to, stop) in [(start, half, Some(half)), (half, end, None)] {
        let (centre, sweep) = fit(from, to, centre, ccw);
        out.push(piece(stop, centre, sweep));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn quarter_half_and_three_quarters() {
        let v = DVec2::new;
        let (centre, turn) = fit(v(1.0, 0.0), v(0.0, 1.0), v(0.0, 0.0), true);
        assert!(centre.length() < 1e-15 && (turn - FRAC_PI_2).abs() < 1e-15);
        assert_eq!(fit(v(1.0, 0.0), v(-1.0, 0.0), v(0.0, 0.0), false).1, -PI);
        let (_, turn) = fit(v(1.0, 0.0), v(0.0, 1.0), v(0.0, 0.0), false);
        assert!((turn + 1.5 * PI).abs() < 1e-15);
        assert_eq!(fit(v(1.0, 0.0), v(1.0, 0.0), v(0.0, 0.0), false), (v(0.0, 0.0), -TAU));
    }

    #[test]
    fn a_centre_off_the_bisector_is_moved_along_the_chord() {
        let (c, _) = fit(DVec2::new(-1.0, 0.0), DVec2::new(1.0, 0.0), DVec2::new(0.01, -2.0), false);
        assert!((c - DVec2::new(0.0, -2.0)).length() < 1e-15);
    }
}
