//! Tangential ways to and from the wall whose base radius a control can print.
//!
//! A lead-in or lead-out keeps its start and end exactly: the involute need not pass through the hole centre, so any base
//! radius serves. Only its place on the wall moves a little. A record is cut where it is one turn away from its base
//! circle: inside of that it is for arcs, outside native.

use std::f64::consts::TAU;

use super::lead_in::{LeadIn, lead_in, lead_in_with_base};
use super::spiral::{SLACK, rough_spiral};
use crate::base::Result;
use crate::geom::{InvoluteRecord, PlaneCurve};

/// Roll angle from which on a control takes an involute without trouble [rad]: the distance from the base circle
/// is then 5.4 base radii.
pub const NATIVE_ROLL: f64 = TAU;

/// A tangential way between a point and the wall, or a spiral from a start point.
#[derive(Clone, Debug, PartialEq)]
pub struct Lead {
    /// Consecutive curves, in the order in which they are run.
    pub curves: Vec<PlaneCurve>,
    /// Base radius at the wall [mm]; zero for other curves than involutes.
    pub base_radius: f64,
    /// Roll angle at the free end [rad].
    pub roll: f64,
    /// Tangent angle at the wall [rad].
    pub psi: f64,
    /// Turns of the path.
    pub turns: f64,
}

impl From<LeadIn> for Lead {
    fn from(l: LeadIn) -> Lead {
        let curves = vec![l.record.into()];
        Lead { curves, base_radius: l.base_radius, roll: l.roll, psi: l.psi, turns: l.turns }
    }
}

impl Lead {
    /// Turned about the bore's centre by `angle` [rad].
    #[must_use]
    pub fn rotated(self, angle: f64) -> Lead {
        let curves = self.curves.iter().map(|c| c.rotated(angle)).collect();
        Lead { curves, psi: self.psi + angle, ..self }
    }

    /// Turned about the bore's centre so that its tangent angle at the wall is `psi` [rad].
    #[must_use]
    pub fn touching_at(self, psi: f64) -> Lead {
        let by = psi - self.psi;
        Lead { psi, ..self.rotated(by) }
    }

    /// The mirror image in the y axis, run backwards: a way in becomes a way out, the place `psi` becomes `-psi`.
    #[must_use]
    pub fn turned_out(&self) -> Lead {
        let curves = self.curves.iter().rev().map(|c| c.mirrored().reversed()).collect();
        Lead { curves, psi: -self.psi, ..*self }
    }
}

/// Direction in which a base radius may be rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounding {
    /// To the nearest multiple.
    Nearest,
    /// Down: the step must not grow.
    Down,
}

/// The lead-in of [`lead_in`], or with a `resolution` [mm] one whose base radius is a multiple of it. Start and wall
/// are exact in both.
///
/// From the hole centre itself the native form is a turn to a circle of about one step and an annular spiral, as in
/// [`rough_spiral`]. So near to the centre that a rounded involute does not come there, the exact one is kept.
///
/// # Errors
/// As [`lead_in`].
pub fn lead(
    radius: f64,
    turns: u32,
    start: [f64; 2],
    polar: f64,
    resolution: Option<f64>,
    rounding: Rounding,
) -> Result<Lead> {
    let exact = lead_in(radius, turns, start, polar)?;
    let Some(u) = resolution else {
        return Ok(exact.into());
    };
    if start == [0.0, 0.0] {
        let step = radius / f64::from(turns);
        let s = rough_spiral(0.0, 0.0, radius, step, exact.psi, resolution)?;
        return Ok(Lead {
            curves: curves(s.records),
            turns: f64::from(s.turns),
            base_radius: s.base_radius,
            ..exact.into()
        });
    }
    let count = exact.base_radius / u;
    let count = if rounding == Rounding::Down { (count * (1.0 + SLACK)).floor() } else { count.round() };
    let Some(native) =
        (count >= 1.0).then(|| lead_in_with_base(radius, count * u, start, polar).ok()).flatten()
    else {
        return Ok(exact.into());
    };
    Ok(Lead { curves: curves(cut_at_native_roll(&native.record)), ..native.into() })
}

/// Records as curves.
pub(super) fn curves(records: Vec<InvoluteRecord>) -> Vec<PlaneCurve> {
    records.into_iter().map(PlaneCurve::from).collect()
}

/// An outward record in two where it passes [`NATIVE_ROLL`], or as it is. Neither part is shorter than the base radius:
/// a shorter first part is cut off farther out, and a record whose second part would be shorter stays whole. The
/// rounded ends of a sliver would turn it so far that no compensation follows it.
pub fn cut_at_native_roll(record: &InvoluteRecord) -> Vec<InvoluteRecord> {
    let base = record.base_radius().abs();
    let radius = NATIVE_ROLL * base;
    let (a, b) = (record.start_radius().abs(), record.end_radius().abs());
    if !(a < radius && radius < b) {
        return vec![*record];
    }
    let there = (radius - a) * (radius + a) / (2.0 * base);
    let s = if there < base { base } else { there };
    if !(record.length() - s >= base) {
        return vec![*record];
    }
    let (first, second) = record.split(s);
    vec![first, second]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ContactOrder, joint};
    use proptest::prelude::*;

    fn contact(a: &PlaneCurve, b: &PlaneCurve) -> ContactOrder {
        joint(&a.at_height(0.0, 0.0), &b.at_height(0.0, 0.0)).contact
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn native_leads_keep_start_and_wall(
            radius in 5.0..200.0f64, n in 1u32..8, share in 0.0..0.98f64, at in -3.1..3.1f64, digits in 3i32..5,
            out: bool,
        ) {
            let u = 10f64.powi(-digits);
            let start = radius * share * glam::DVec2::from_angle(at);
            let l = lead(radius, n, start.to_array(), 0.0, Some(u), Rounding::Nearest).unwrap();
            let l = if out { l.turned_out() } else { l };
            for w in l.curves.windows(2) {
                prop_assert!(contact(&w[0], &w[1]) >= ContactOrder::G2, "{l:?}");
                prop_assert!(w.iter().all(|c| c.length() >= l.base_radius * (1.0 - 1e-9)), "{l:?}");
            }
            let wall = InvoluteRecord::circle(radius, l.psi).unwrap().into();
            let (first, last) = (l.curves[0], l.curves[l.curves.len() - 1]);
            prop_assert_eq!(if out { contact(&wall, &first) } else { contact(&last, &wall) }, ContactOrder::G2);
            let free = if out { last.end() } else { first.start() };
            let wanted = if out { glam::DVec2::new(-start.x, start.y) } else { start };
            prop_assert!((free - wanted).length() < 1e-10 * radius);
            // The base radius is printable if the lead starts and ends a turn away from the base circle.
            let PlaneCurve::Record(native) = (if out { first } else { last }) else { unreachable!() };
            let least = native.start_radius().min(native.end_radius());
            if least >= NATIVE_ROLL * l.base_radius * 0.999 && share * radius > l.base_radius {
                prop_assert!(((l.base_radius / u).round() * u - l.base_radius).abs() < 1e-9 * u, "{l:?}");
            }
        }
    }
}
