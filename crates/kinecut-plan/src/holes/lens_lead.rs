//! Tangential ways from a start point to the wall circle on a lens involute: as [`super::lead_in::lead_in`], with
//! contact G4 or G6.
//!
//! The lens involute of support `q = r W(th)` through the hole centre, `r = R / (2 pi n)`, has the distance
//! `sqrt(q^2 + q'^2)` from the centre, which grows all along (`d|p|^2/dth = 2 q' (q + q'')`): one tangent angle for the
//! start, and then a turn of the whole about the centre so that it passes through it. The higher the contact, the
//! longer the last sliver: of what is left at an angle `e` before the wall, `r e^3/6` becomes `r e^5/30` or
//! `4 r e^7/315`.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use crate::base::{Code, Finding, Result};
use crate::geom::{LensOrder, Spiral, Support};
use crate::num::root::bracketed_newton;

/// A tangential way between a point and the wall circle, counter-clockwise about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LensLead {
    /// The path.
    pub spiral: Spiral,
    /// Mean base radius, `radius / (2 pi turns)` [mm].
    pub base_radius: f64,
    /// Tangent angle at the free end before the involute is turned [rad]: 0 in the centre, `2 pi turns` at the wall.
    pub theta: f64,
    /// Tangent angle at the wall [rad].
    pub psi: f64,
    /// Turns of the path.
    pub turns: f64,
}

/// The lens involute from `start` that touches the circle of `radius` [mm] about the origin; it would reach the centre
/// after `turns` whole turns. When `start` is the centre itself the direction is free: `polar` is then the polar angle
/// [rad] of the point in which the wall is met.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::geom::LensOrder;
/// use kinecut::holes::lens_lead::lens_lead_in;
/// let finish = lens_lead_in(80.0, 2, [-40.0, 40.0], 0.0, LensOrder::One).unwrap();
/// assert!((finish.theta - 9.0799901497769).abs() < 1e-10);
/// assert!((finish.spiral.length() - 240.583995420465).abs() < 1e-8);
/// ```
///
/// # Errors
/// `KC0402` when the start is not inside the circle, `KC0404` for no turns or a radius that is not positive.
pub fn lens_lead_in(
    radius: f64,
    turns: u32,
    start: [f64; 2],
    polar: f64,
    order: LensOrder,
) -> Result<LensLead> {
    if turns == 0 {
        return Err(Finding::error(Code::PLAN_VALUE, "a lead-in needs at least one turn")
            .value(0.0, "")
            .bound(1.0, "")
            .into());
    }
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(Finding::error(Code::PLAN_VALUE, "the radius of the path must be positive")
            .value_mm(radius)
            .bound_mm(0.0)
            .into());
    }
    let end = TAU * f64::from(turns);
    let base_radius = radius / end;
    let start = DVec2::from_array(start);
    let distance = start.length();
    let law = Support::Lens { inner: 0.0, base_radius, order };
    let excess = |theta: f64| {
        let [q, slope] = law.at(theta);
        (q.hypot(slope) - distance, slope * law.radius(theta) / q.hypot(slope))
    };
    /// Near the whole turns the distance is flat, and Newton closes in by thirds and fifths only.
    const STEPS: u32 = 200;
    let theta = if distance == 0.0 {
        0.0
    } else {
        bracketed_newton(excess, distance / base_radius, 0.0, end, STEPS).0
    };
    if !(distance < radius && theta < end) {
        return Err(Finding::error(Code::START_OUTSIDE, "the start point is not inside the path circle")
            .value_mm(distance)
            .bound_mm(radius)
            .help("choose a start nearer to the hole centre")
            .into());
    }
    let unturned = Spiral::new(law.into(), theta, end)?;
    let there = unturned.start();
    let psi = if distance == 0.0 { polar + FRAC_PI_2 } else { there.perp_dot(start).atan2(there.dot(start)) };
    Ok(LensLead {
        spiral: unturned.rotated(psi),
        base_radius,
        theta,
        psi,
        turns: f64::from(turns) - theta / TAU,
    })
}

/// The tangent angle [rad] at which the lens involute from the centre to the wall circle of `radius` [mm] has the radius
/// of curvature `wanted` [mm]: 0 in the centre, `2 pi turns` at the wall. The radius grows all along, though not at whole
/// and half turns, where it takes Newton's method longer.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::geom::LensOrder;
/// use kinecut::holes::lens_lead::angle_of_curvature;
/// let theta = angle_of_curvature(80.0, 2, 59.8301313925462, LensOrder::One);
/// assert!((theta - 9.0799901497769).abs() < 1e-12);
/// ```
pub fn angle_of_curvature(radius: f64, turns: u32, wanted: f64, order: LensOrder) -> f64 {
    let end = TAU * f64::from(turns);
    // In base radii, so that no size is special.
    let law = Support::Lens { inner: 0.0, base_radius: 1.0, order };
    let wanted = wanted / radius * end;
    let excess = |theta: f64| {
        let (q, slope) = law.series::<3>(theta);
        (q.0[0] + slope.0[1] - wanted, q.0[1] + 2.0 * slope.0[2])
    };
    /// As in [`lens_lead_in`]: at the flat places, of third and fifth order, a step leaves 2/3 or 4/5 of the distance.
    const STEPS: u32 = 200;
    bracketed_newton(excess, wanted, 0.0, end, STEPS).0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::on_circle;
    use crate::holes::lead_in::lead_in;
    use proptest::prelude::*;

    const ORDERS: [LensOrder; 3] = [LensOrder::Zero, LensOrder::One, LensOrder::Two];

    #[test]
    fn order_zero_is_the_circle_involute() {
        for start in [[-40.0, 40.0], [1.0, 0.0], [0.0, -79.9]] {
            let lens = lens_lead_in(80.0, 2, start, 0.0, LensOrder::Zero).unwrap();
            let involute = lead_in(80.0, 2, start, 0.0).unwrap();
            assert!((lens.psi - involute.psi).abs() < 1e-9, "{lens:?} {involute:?}");
            assert!((lens.spiral.length() - involute.record.length()).abs() < 1e-7);
            assert!((lens.turns - involute.turns).abs() < 1e-9);
        }
    }

    #[test]
    fn what_is_not_inside_is_refused() {
        for start in [[80.0, 0.0], [60.0, 60.0], [f64::NAN, 0.0], [80.0 - 1e-17, 0.0]] {
            let e = lens_lead_in(80.0, 2, start, 0.0, LensOrder::One).unwrap_err();
            assert_eq!(e.code(), Code::START_OUTSIDE);
        }
        assert!(lens_lead_in(80.0, 0, [1.0, 0.0], 0.0, LensOrder::One).is_err());
        assert!(lens_lead_in(0.0, 1, [0.0, 0.0], 0.0, LensOrder::One).is_err());
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn a_lead_passes_through_its_start_and_ends_on_the_wall(
            radius in 0.5..300.0f64, n in 1u32..40, u in 0.0..0.999_999f64, at in -3.2..3.2f64, j in 0usize..3,
        ) {
            let start = radius * u * DVec2::from_angle(at);
            let lead = lens_lead_in(radius, n, start.to_array(), at, ORDERS[j]).unwrap();
            let scale = 1e-12 * radius * f64::from(n);
            prop_assert!((lead.spiral.start() - start).length() < scale, "{lead:?}");
            prop_assert!((lead.spiral.end() - on_circle(radius, lead.psi)).length() < scale, "{lead:?}");
        }
    }
}
