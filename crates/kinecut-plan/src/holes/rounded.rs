//! Spirals and lead-ins whose base radius a control can print.
//!
//! A control with involutes reads the base radius rounded to its resolution, and draws the involute with the
//! error times the roll angle: 63 um in the paper's example with three decimals. The help is a base radius that is
//! a multiple of the resolution, so that nothing is rounded. The wall circle stays exact, always; what gives way:
//!
//! * a spiral out of the centre becomes one turn on its own from the centre to a circle `R1` (it starts on its
//!   base circle, where no control takes an involute, so it is posted as arcs) and an annular spiral from `R1` to
//!   the wall; both osculate `R1`. The steps stay within the limit, but for the first turn, which may exceed it by
//!   [`FIRST_TURN_EXCESS`] (it is a slot anyway);
//! * a spiral out of a given circle starts from one a little smaller (or larger, up to a bound);
//! * a lead-in or lead-out keeps its start and end exactly: the involute need not pass through the hole centre,
//!   so any base radius serves. Only its place on the wall moves a little.
//!
//! A record is cut where it is one turn away from its base circle: inside of that it is for arcs, outside native.

use std::f64::consts::{PI, TAU};

use super::spiral::{LeadIn, annular, from_centre, lead_in, lead_in_with_base, turns};
use crate::base::Result;
use crate::geom::InvoluteRecord;

/// How far the first turn of a native spiral may exceed the step, relative: at 92 degrees of engagement and more
/// it adds a third of a degree, and without it a step that divides the radius would cost a whole turn.
pub const FIRST_TURN_EXCESS: f64 = 0.02;
/// Roll angle from which on a control takes an involute without trouble [rad]: the distance from the base circle
/// is then 5.4 base radii.
pub const NATIVE_ROLL: f64 = TAU;
/// Least part of a step that the first circle may have, so that the annular spiral does not start on its base
/// circle: its roll is this times 2 pi.
const LEAST_FIRST_STEP: f64 = 0.5;
/// Relative slack in comparisons of steps: rounding of `2 pi r`.
const SLACK: f64 = 1e-12;

/// The spiral of a roughing level.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughSpiral {
    /// Consecutive records up to the wall circle.
    pub records: Vec<InvoluteRecord>,
    /// Radius of the circle from which the annular spiral starts [mm]; zero when it starts in the centre.
    pub inner_radius: f64,
    /// Base radius of the last record [mm].
    pub base_radius: f64,
    /// Whole turns, a first turn of its own included.
    pub turns: u32,
    /// Constant normal step [mm].
    pub step: f64,
}

/// The spiral from the hole centre to the circle of `radius` in steps of at most `max_step` [mm], meeting the wall
/// at tangent angle `psi`. With a `resolution` [mm] its base radius is a multiple of it where it is native.
///
/// # Errors
/// As [`turns`] and [`from_centre`].
pub fn spiral_from_centre(
    radius: f64,
    max_step: f64,
    psi: f64,
    resolution: Option<f64>,
) -> Result<RoughSpiral> {
    let n = turns(radius, max_step)?;
    if let (Some(u), true) = (resolution, n > 1) {
        let first = max_step * (1.0 + FIRST_TURN_EXCESS);
        for outer in [n - 1, n] {
            let wanted = radius / (TAU * f64::from(outer + 1));
            for r in multiples(wanted, u) {
                let inner = radius - TAU * f64::from(outer) * r;
                let step = TAU * r;
                if step <= max_step * (1.0 + SLACK) && inner <= first && inner >= LEAST_FIRST_STEP * step {
                    let records = vec![from_centre(inner, 1, psi)?, annular(inner, radius, outer, psi)?];
                    return Ok(RoughSpiral {
                        records,
                        inner_radius: inner,
                        base_radius: r,
                        turns: outer + 1,
                        step,
                    });
                }
            }
        }
    }
    let record = from_centre(radius, n, psi)?;
    let base_radius = record.base_radius();
    Ok(RoughSpiral {
        records: vec![record],
        inner_radius: 0.0,
        base_radius,
        turns: n,
        step: radius / f64::from(n),
    })
}

/// The spiral from a circle of about `inner` [mm] to the circle of `radius`, in steps of at most `max_step`. With a
/// `resolution` the inner circle moves by at most `pi turns resolution` where it may: never above `most` [mm].
///
/// # Errors
/// As [`turns`] and [`annular`].
pub fn spiral_from_circle(
    inner: f64,
    most: f64,
    radius: f64,
    max_step: f64,
    psi: f64,
    resolution: Option<f64>,
) -> Result<RoughSpiral> {
    let n = turns(radius - inner, max_step)?;
    if let Some(u) = resolution {
        for count in [n, n + 1] {
            let wanted = (radius - inner) / (TAU * f64::from(count));
            for r in multiples(wanted, u) {
                let from = radius - TAU * f64::from(count) * r;
                let step = TAU * r;
                if step <= max_step * (1.0 + SLACK) && from <= most && from >= LEAST_FIRST_STEP * step {
                    let records = vec![annular(from, radius, count, psi)?];
                    return Ok(RoughSpiral {
                        records,
                        inner_radius: from,
                        base_radius: r,
                        turns: count,
                        step,
                    });
                }
            }
        }
    }
    let record = annular(inner, radius, n, psi)?;
    let step = (radius - inner) / f64::from(n);
    Ok(RoughSpiral {
        records: vec![record],
        inner_radius: inner,
        base_radius: record.base_radius(),
        turns: n,
        step,
    })
}

/// The two positive multiples of `u` around `value`, the larger first.
fn multiples(value: f64, u: f64) -> impl Iterator<Item = f64> {
    let count = value / u;
    [count.ceil(), count.floor()].into_iter().filter(|c| *c >= 1.0).map(move |c| c * u)
}

/// A lead-in, or a spiral from a start point, as one or two records.
#[derive(Clone, Debug, PartialEq)]
pub struct Lead {
    /// Consecutive records between start point and wall, in the order in which they are run.
    pub records: Vec<InvoluteRecord>,
    /// Base radius at the wall [mm].
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
        Lead { records: vec![l.record], base_radius: l.base_radius, roll: l.roll, psi: l.psi, turns: l.turns }
    }
}

impl Lead {
    /// The way out that is this way in, mirrored and run backwards: the clockwise twin met the wall at `pi - psi`.
    #[must_use]
    pub fn turned_out(self) -> Lead {
        let records = self.records.iter().rev().map(|r| r.mirrored().reversed()).collect();
        Lead { records, psi: -self.psi, ..self }
    }
}

/// Which way a base radius may be rounded.
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
/// [`spiral_from_centre`]. So near to the centre that a rounded involute does not come there, the exact one is kept.
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
        let s = spiral_from_centre(radius, step, exact.psi, resolution)?;
        return Ok(Lead {
            records: s.records,
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
    let records = cut_at_native_roll(&native.record);
    Ok(Lead { records, ..native.into() })
}

/// An outward record in two where it passes [`NATIVE_ROLL`], or as it is.
pub fn cut_at_native_roll(record: &InvoluteRecord) -> Vec<InvoluteRecord> {
    let radius = NATIVE_ROLL * record.base_radius().abs();
    let (a, b) = (record.start_radius().abs(), record.end_radius().abs());
    if !(a < radius && radius < b) {
        return vec![*record];
    }
    let s = (radius - a) * (radius + a) / (2.0 * record.base_radius().abs());
    let (first, second) = record.split(s);
    vec![first, second]
}

/// The involute that leaves the circle of `radius` [mm] at tangent angle `psi` inwards and turns by `turned` [rad]:
/// the way back from the wall into the open.
///
/// # Errors
/// `KC0801` when it would pass its cusp: `turned` times the base radius exceeds the radius.
pub fn leave(radius: f64, base_radius: f64, turned: f64, psi: f64) -> Result<InvoluteRecord> {
    let end = radius - base_radius * turned;
    let wall = super::spiral::wall_point(radius, psi);
    InvoluteRecord::new(0.5 * turned * (radius + end), wall.to_array(), psi, radius, end)
}

/// A base radius near `radius / (2 pi turns)` that is a multiple of the resolution.
pub fn base_radius(radius: f64, turns: u32, resolution: Option<f64>) -> f64 {
    let exact = radius / (TAU * f64::from(turns));
    match resolution {
        Some(u) if exact >= u => (exact / u).round() * u,
        _ => exact,
    }
}

/// Half a turn [rad]: how far a way back from the wall turns unless told otherwise. It is then `pi` base radii off
/// the wall.
pub const HALF_TURN: f64 = PI;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Contact, Curve, joint};
    use proptest::prelude::*;

    fn multiple(r: f64, u: f64) -> bool {
        ((r / u).round() * u - r).abs() < 1e-9 * u
    }

    fn contact(a: &InvoluteRecord, b: &InvoluteRecord) -> Contact {
        joint(&Curve::involute(*a, 0.0, 0.0), &Curve::involute(*b, 0.0, 0.0)).contact
    }

    #[test]
    fn the_papers_spiral_for_a_control_with_three_decimals() {
        let s = spiral_from_centre(79.0, 4.0, 0.0, Some(1e-3)).unwrap();
        // 19 turns of 0.629: R1 = 79 - 38 pi 0.629.
        assert!((s.base_radius - 0.629).abs() < 1e-12 && s.turns == 20);
        assert!((s.inner_radius - (79.0 - 38.0 * PI * 0.629)).abs() < 1e-12);
        assert_eq!(contact(&s.records[0], &s.records[1]), Contact::G2);
        // A step that divides the radius keeps its turns; the first one pays.
        let s = spiral_from_centre(80.0, 4.0, 0.0, Some(1e-3)).unwrap();
        assert!(s.turns == 20 && s.step <= 4.0 && s.inner_radius < 4.08, "{s:?}");
        // Ninety-nine turns at 0.636 would leave a first turn of 4.4: one turn more.
        let s = spiral_from_centre(400.0, 4.0, 0.0, Some(1e-3)).unwrap();
        assert!(s.turns == 101 && s.inner_radius < 4.08, "{s:?}");
        let exact = spiral_from_centre(79.0, 4.0, 0.0, None).unwrap();
        assert_eq!((exact.records.len(), exact.turns, exact.inner_radius), (1, 20, 0.0));
    }

    #[test]
    fn one_turn_or_a_coarse_resolution_keeps_the_exact_form() {
        assert_eq!(spiral_from_centre(3.0, 4.0, 0.0, Some(1e-3)).unwrap().records.len(), 1);
        assert_eq!(spiral_from_centre(3.0, 0.5, 0.0, Some(1.0)).unwrap().records.len(), 1);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn native_spirals_keep_wall_step_and_contact(
            radius in 1.0..300.0f64, share in 0.01..0.9f64, psi in -3.0..3.0f64, digits in 3i32..5, ring in 0.0..0.8f64,
        ) {
            let (u, max_step) = (10f64.powi(-digits), radius * share);
            let inner = radius * ring;
            for s in [
                spiral_from_centre(radius, max_step, psi, Some(u)).unwrap(),
                spiral_from_circle(inner, inner * 1.01, radius, max_step, psi, Some(u)).unwrap(),
            ] {
                prop_assert!(s.step <= max_step * (1.0 + 1e-9), "{s:?}");
                prop_assert!(s.records[0].end_radius() <= radius);
                let last = s.records.last().unwrap();
                let native = s.inner_radius > 0.0 && s.inner_radius != inner;
                prop_assert!(!native || multiple(s.base_radius, u));
                prop_assert!((last.base_radius() - s.base_radius).abs() < 1e-9 * s.base_radius);
                let wall = super::super::spiral::circle(radius, psi).unwrap();
                prop_assert_eq!(contact(last, &wall), Contact::G2);
                if let [first, second] = s.records[..] {
                    prop_assert!(first.end_radius() <= max_step * (1.0 + FIRST_TURN_EXCESS) * (1.0 + 1e-9));
                    prop_assert!(contact(&first, &second) >= Contact::G2);
                }
            }
        }

        #[test]
        fn native_leads_keep_start_and_wall(
            radius in 5.0..200.0f64, n in 1u32..8, share in 0.0..0.98f64, at in -3.1..3.1f64, digits in 3i32..5,
            out: bool,
        ) {
            let u = 10f64.powi(-digits);
            let start = radius * share * glam::DVec2::from_angle(at);
            let l = lead(radius, n, start.to_array(), 0.0, Some(u), Rounding::Nearest).unwrap();
            let l = if out { l.turned_out() } else { l };
            for w in l.records.windows(2) {
                prop_assert!(contact(&w[0], &w[1]) >= Contact::G2, "{l:?}");
            }
            let wall = super::super::spiral::circle(radius, l.psi).unwrap();
            let (first, last) = (l.records[0], l.records[l.records.len() - 1]);
            prop_assert_eq!(if out { contact(&wall, &first) } else { contact(&last, &wall) }, Contact::G2);
            let free = if out { last.end() } else { first.start() };
            let wanted = if out { glam::DVec2::new(-start.x, start.y) } else { start };
            prop_assert!((free - wanted).length() < 1e-10 * radius);
            // What starts and ends a turn away from the base circle is printable.
            let native = if out { first } else { last };
            let least = native.start_radius().min(native.end_radius());
            if least >= NATIVE_ROLL * l.base_radius * 0.999 && share * radius > l.base_radius {
                prop_assert!(multiple(l.base_radius, u), "{l:?}");
            }
        }
    }
}
