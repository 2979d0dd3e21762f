//! The order of contact of a joint: the smoothness with which one curve follows another.
//!
//! A control slows down, and a machine shakes, according to the first derivative that jumps: a gap cannot be
//! driven, a kink (G0) asks for a stop, a step of curvature (G1) is a step of acceleration, a step of its
//! derivative (G2) one of jerk.

use super::Curve;

/// Largest gap that is rounding [mm]: coordinates of metres carry 1e-13, a chain of a thousand turns 1e-10.
const GAP: f64 = 1e-8;
/// Largest tangent angle that is rounding [rad].
const KINK: f64 = 1e-8;
/// Largest jump of a derivative of order m, relative to the curvature to the power m - 1, that is rounding: an
/// involute of a hundred thousand turns still jumps by 1.6e-6.
const JUMP: f64 = 1e-8;

/// Order of contact of two curves in a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ContactOrder {
    /// They do not meet.
    Apart,
    /// They meet with a kink.
    G0,
    /// Common tangent.
    G1,
    /// Common tangent and curvature.
    G2,
    /// Common tangent, curvature and derivative of curvature.
    G3,
    /// Common derivatives to the fourth.
    G4,
    /// Common derivatives to the fifth.
    G5,
    /// Common derivatives to the sixth.
    G6,
    /// No derivative to the seventh jumps: one curve goes on as the other.
    Smooth,
}

impl ContactOrder {
    /// Its short name: "G2", "smooth", "apart".
    pub fn name(self) -> &'static str {
        match self {
            ContactOrder::Apart => "apart",
            ContactOrder::G0 => "G0",
            ContactOrder::G1 => "G1",
            ContactOrder::G2 => "G2",
            ContactOrder::G3 => "G3",
            ContactOrder::G4 => "G4",
            ContactOrder::G5 => "G5",
            ContactOrder::G6 => "G6",
            ContactOrder::Smooth => "smooth",
        }
    }
}

/// The end of one curve against the start of the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveJoint {
    /// Distance [mm].
    pub gap: f64,
    /// Angle between the tangents [rad].
    pub angle: f64,
    /// Jump of the curvature vector [1/mm].
    pub curvature: f64,
    /// Jump of the third derivative by arc length [1/mm^2].
    pub slope: f64,
    /// Order of contact.
    pub contact: ContactOrder,
}

/// Measures the joint between the end of `a` and the start of `b`. A curve of no length has no tangent: the joint
/// is then G0 at most.
pub fn joint(a: &Curve, b: &Curve) -> CurveJoint {
    let (e, s) = (a.derivatives::<8>(a.length()), b.derivatives::<8>(0.0));
    let (before, after) = (a.at(a.length()), b.at(0.0));
    let gap = (after.p - before.p).length();
    let angle = before.d1.cross(after.d1).length().atan2(before.d1.dot(after.d1));
    let (curvature, slope) = ((after.d2 - before.d2).length(), (after.d3 - before.d3).length());
    let k = if before.curvature() > after.curvature() { before.curvature() } else { after.curvature() };
    let directed = before.d1.length_squared() > 0.0 && after.d1.length_squared() > 0.0;
    let contact = if gap > GAP || gap.is_nan() {
        ContactOrder::Apart
    } else if !(directed && angle <= KINK) {
        ContactOrder::G0
    } else {
        // A jump that is not a number (the curvature of a cusp) is within no tolerance.
        const ORDERS: [ContactOrder; 7] = [
            ContactOrder::G1,
            ContactOrder::G2,
            ContactOrder::G3,
            ContactOrder::G4,
            ContactOrder::G5,
            ContactOrder::G6,
            ContactOrder::Smooth,
        ];
        let common = (2..8).take_while(|&m| (s[m] - e[m]).length() <= JUMP * k.powi(m as i32 - 1)).count();
        ORDERS[common]
    };
    CurveJoint { gap, angle, curvature, slope, contact }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Arc, InvoluteRecord, Line};
    use glam::DVec3;

    fn line(a: [f64; 3], b: [f64; 3]) -> Curve {
        Line { start: a.into(), end: b.into() }.into()
    }

    #[test]
    fn each_order_is_told_from_the_next() {
        let x = line([0.0; 3], [1.0, 0.0, 0.0]);
        let order = |b: &Curve| joint(&x, b).contact;
        assert_eq!(order(&line([1.1, 0.0, 0.0], [2.0, 0.0, 0.0])), ContactOrder::Apart);
        assert_eq!(order(&line([1.0, 0.0, 0.0], [1.0, 1.0, 0.0])), ContactOrder::G0);
        assert_eq!(order(&line([1.0, 0.0, 0.0], [2.0, 0.0, 0.0])), ContactOrder::Smooth);
        assert_eq!(order(&line([1.0, 0.0, 0.0], [1.0, 0.0, 0.0])), ContactOrder::G0);
        let arc = Arc::new(DVec3::X, DVec3::new(1.0, 5.0, 0.0), DVec3::Z, 1.0, 0.0).unwrap();
        let j = joint(&x, &arc.into());
        assert_eq!(j.contact, ContactOrder::G1);
        assert!((j.curvature - 0.2).abs() < 1e-15);
    }

    #[test]
    fn a_cusp_has_a_tangent_but_no_curvature() {
        let spiral = InvoluteRecord::new(10.0, [1.0, 0.0], 0.0, 0.0, 4.0).unwrap();
        let (out, back) = (Curve::involute(spiral, 0.0, 0.0), Curve::involute(spiral.reversed(), 0.0, 0.0));
        assert_eq!(joint(&line([0.0; 3], [1.0, 0.0, 0.0]), &out).contact, ContactOrder::G1);
        assert_eq!(joint(&back, &line([1.0, 0.0, 0.0], [0.0; 3])).contact, ContactOrder::G1);
    }

    #[test]
    fn a_lens_meets_both_circles_to_the_order_of_its_weight() {
        use crate::geom::{LensOrder, Spiral, Support};
        use std::f64::consts::TAU;
        let circle = |r: f64| {
            Curve::from(Arc::new(DVec3::new(0.0, -r, 0.0), DVec3::ZERO, DVec3::Z, TAU, 0.0).unwrap())
        };
        for (order, contact) in [
            (LensOrder::Zero, ContactOrder::G2),
            (LensOrder::One, ContactOrder::G4),
            (LensOrder::Two, ContactOrder::G6),
        ] {
            for (inner, turns) in [(10.0, 17.0), (1.0, 3.0), (70.0, 1.0)] {
                let law = Support::Lens { inner, base_radius: (79.0 - inner) / (TAU * turns), order };
                let spiral = Curve::spiral(
                    Spiral::new(law.into(), 0.0, TAU * turns).unwrap(),
                    0.0,
                    crate::geom::Rise::NONE,
                );
                assert_eq!(joint(&circle(inner), &spiral).contact, contact, "{inner}");
                assert_eq!(joint(&spiral, &circle(79.0)).contact, contact, "{turns}");
            }
        }
    }

    #[test]
    fn an_involute_meets_its_circle_to_second_order() {
        for n in [1.0, 20.0, 1e5] {
            let spiral =
                InvoluteRecord::new(n * 79.0 * std::f64::consts::PI, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
            let circle = Arc::new(DVec3::new(0.0, -79.0, 0.0), DVec3::ZERO, DVec3::Z, 1.0, 0.0).unwrap();
            // A long spiral carries its turned angle to an ulp of itself: the end is off by that much.
            let j = joint(&Curve::involute(spiral, 0.0, 0.0), &circle.into());
            assert!(j.gap < 1e-7);
            if n < 1e3 {
                assert_eq!(j.contact, ContactOrder::G2, "{j:?}");
                assert!((j.slope * std::f64::consts::TAU * n * 79.0 * 79.0 - 1.0).abs() < 1e-6);
            }
        }
    }
}
