//! The end of a polar arc `CP IPA`: the start, turned about the pole.
//!
//! For writer and reader, so that both find the same point to the last bit. A block names an angle, not an end,
//! and the angle has four decimals of a degree: at a radius of 400 mm its step is 0.7 um. Whole and quarter turns
//! are exact; after any other angle the control is off the point that was meant. The writer therefore ends
//! the arc a little early and closes the gap by a short line to the exact end, flat enough to lie on the arc.

use glam::DVec2;

/// Steps of an angle in a degree: four decimals.
pub(in crate::nc) const TICKS: f64 = 1e4;
/// Steps of a whole turn.
pub(in crate::nc) const TURN: i64 = 3_600_000;

/// A point turned about the pole by an angle [deg], positive counter-clockwise.
///
/// ```text
/// p' = pole + R(angle mod 360) (p - pole), with exact quarter turns
/// ```
pub(in crate::nc) fn turned(point: DVec2, pole: DVec2, degrees: f64) -> DVec2 {
    let part = degrees.rem_euclid(360.0);
    if part == 0.0 || part == 360.0 {
        return point;
    }
    let arm = point - pole;
    // The nearest quarter turn exactly, the rest by sine and cosine.
    let quarters = (part / 90.0).round();
    let arm = match quarters as u8 % 4 {
        0 => arm,
        1 => arm.perp(),
        2 => -arm,
        _ => -arm.perp(),
    };
    pole + DVec2::from_angle((part - 90.0 * quarters).to_radians()).rotate(arm)
}

/// An angle in steps as degrees.
pub(in crate::nc) fn degrees(ticks: i64) -> f64 {
    ticks as f64 / TICKS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        let (p, pole) = (DVec2::new(0.1, 0.7), DVec2::new(-0.3, 0.2));
        assert_eq!(turned(p, pole, 720.0), p);
        assert_eq!(turned(p, pole, -3600.0), p);
        assert_eq!(turned(p, pole, 90.0), pole + DVec2::new(-(0.7 - 0.2), 0.1 + 0.3));
        assert_eq!(turned(p, pole, -90.0), pole + DVec2::new(0.7 - 0.2, -(0.1 + 0.3)));
        assert_eq!(turned(p, pole, 540.0), pole - (p - pole));
    }

    #[test]
    fn an_angle_turns_against_the_clock() {
        // Radius 10 about (1, 2), from 0 to 30 degrees.
        let p = turned(DVec2::new(11.0, 2.0), DVec2::new(1.0, 2.0), 30.0);
        assert!((p - DVec2::new(1.0 + 10.0 * 0.75f64.sqrt(), 7.0)).length() < 1e-14);
        let q = turned(DVec2::new(11.0, 2.0), DVec2::new(1.0, 2.0), -390.0);
        assert!((q - DVec2::new(1.0 + 10.0 * 0.75f64.sqrt(), -3.0)).length() < 1e-14);
    }
}
