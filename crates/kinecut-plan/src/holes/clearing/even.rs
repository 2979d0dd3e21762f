//! The lens spiral of constant engagement, with the step as a cap.
//!
//! The step that keeps an engagement angle `A` grows with the path radius `q`, from `q (1 - cos A)` near the centre to
//! `a (1 - cos A)` on a straight wall. So the spiral of constant engagement has small steps inside and large ones
//! outside; where they would exceed the step asked for, it goes over into a lens involute of constant step, on which
//! the engagement falls outwards. Both parts take whole turns and touch the circle between them, the starting circle
//! and the wall with the contact of the lens.
//!
//! The first turns on which the step is constant are held against the exact engagement (a path that moves outwards
//! quickly engages more than a ring): where it would exceed the limit, the circle between the parts is moved outwards.
//!
//! Whole turns: the smallest number for which the engagement stays within the limit; the angle is then lowered until
//! the turns are exactly that many. With few turns that is a good deal: up to a share `1/N` of the steps.

use std::f64::consts::TAU;

use super::disc::{Cleared, Disc, MOST_PIECES, too_many};
use super::turns::Turns;
use crate::base::{Code, Finding, Result};
use crate::geom::{ConstantEngagement, LensOrder, PlaneCurve, Spiral, Support};
use crate::holes::spiral::lens_between;
use crate::num::root::bracketed_newton;

/// Largest limit [rad]: beyond it the cutter is as good as in a slot, and there is nothing to keep.
const MOST_ENGAGEMENT: f64 = 150.0 * std::f64::consts::PI / 180.0;
/// Parts of a step in which the circle between the two parts is tried.
const PLACES: u32 = 4;
/// Further turns that are tried for the inner part, to bring its last step under the cap.
const MORE_TURNS: u32 = 3;
/// Places in a turn at which the exact engagement is looked at: it changes smoothly between two flat ends of a turn.
const LOOKS: u32 = 24;
/// Slack of the exact engagement between the places looked at [rad], a twentieth of a degree.
const LOOK_SLACK: f64 = 1e-3;
/// Relative slack of a whole number of turns and of a step: a hundred times the rounding of the turn count.
const SLACK: f64 = 1e-12;
/// Newton steps for the angle: a dozen from the law `turns ~ 1/(1 - cos A)`, more only where the bracket is halved.
const STEPS: u32 = 100;

/// Radii of concentric rings [mm], from `outer` inwards down to the first that is not above `inner`, each of which
/// engages a cutter of radius `cutter` [mm] by the same angle [rad]: `(p + a)^2 = q^2 + a^2 + 2 q a cos A` for the ring
/// of radius p inside that of radius q. At most ten thousand; none for numbers that are not positive.
///
/// ```
/// # use kinecut_plan as kinecut;
/// let rings = kinecut::holes::clearing::rings_of_equal_engagement(79.0, 10.0, 20.0, 60f64.to_radians());
/// assert!(rings.len() == 11 && (rings[1] - 70.6697303403953).abs() < 1e-12);
/// ```
pub fn rings_of_equal_engagement(outer: f64, inner: f64, cutter: f64, angle: f64) -> Vec<f64> {
    let mut rings = Vec::new();
    if !(outer > 0.0 && inner > 0.0 && cutter > 0.0 && angle > 0.0) {
        return rings;
    }
    let mut q = outer;
    rings.push(q);
    while q > inner && (rings.len() as f64) < MOST_PIECES {
        q = (q * q + cutter * cutter + 2.0 * q * cutter * angle.cos()).sqrt() - cutter;
        rings.push(q);
    }
    rings
}

/// The spiral of constant engagement between two circles in the smallest whole number of turns that is at least
/// `least_turns`, with that number.
fn fitted(
    [inner, outer]: [f64; 2],
    cutter: f64,
    limit: f64,
    order: LensOrder,
    least_turns: f64,
) -> Result<(ConstantEngagement, f64)> {
    let law = |angle: f64| ConstantEngagement::new(inner, outer, cutter, angle, order);
    let wanted = law(limit).turns();
    let whole = (wanted * (1.0 - SLACK)).ceil().max(least_turns);
    if whole.is_nan() || whole > MOST_PIECES {
        return Err(too_many(wanted, "turns"));
    }
    let mut least = 0.5 * limit;
    while law(least).turns() < whole {
        least *= 0.5;
    }
    let missing = |angle: f64| {
        let turns = law(angle).turns();
        (whole - turns, turns * angle.sin() / (1.0 - angle.cos()))
    };
    let (angle, _) = bracketed_newton(missing, limit, least, limit, STEPS);
    Ok((law(angle), whole))
}

/// The path radius at which the step of constant engagement reaches `step`: `h(q) = step` solved for q; infinite when
/// it never does.
fn radius_of_step(cutter: f64, angle: f64, step: f64) -> f64 {
    let room = cutter * (1.0 - angle.cos()) - step;
    if room > 0.0 { step * (2.0 * cutter - step) / (2.0 * room) } else { f64::INFINITY }
}

/// Largest normal step of a spiral of constant engagement, that of its last turn [mm].
fn last_step(law: &ConstantEngagement, whole: f64) -> f64 {
    let [inner, outer] = law.radii();
    if whole == 1.0 {
        return outer - inner;
    }
    let [before, _] = Support::ConstantEngagement(*law).at(TAU * (whole - 1.0));
    outer - before
}

pub(super) fn constant_engagement(disc: &Disc, order: LensOrder) -> Result<Cleared> {
    let limit = limit(disc)?;
    let reach = radius_of_step(disc.cutter, limit, disc.step);
    let most = ((disc.outer - reach) / disc.step).ceil().max(0.0);
    let whole = ((disc.outer - disc.inner) / disc.step * (1.0 - SLACK)).ceil().max(1.0);
    let mut best: Option<Parts> = None;
    if most >= whole {
        // The step alone binds.
        for more in 0..=MORE_TURNS {
            best = best.or_else(|| Parts::constant_step(disc, limit, order, whole + f64::from(more)));
        }
    }
    let count = most.min(whole);
    for part in 0..PLACES {
        if best.is_none() {
            let between = disc.outer - (count - f64::from(part) / f64::from(PLACES)) * disc.step;
            best = Parts::both(disc, limit, order, between, count)?;
        }
    }
    // The inner part's last turn keeps below the step at its end, so that one turn less at the wall may do.
    if count > 0.0 {
        let between = disc.outer - (count - 1.0) * disc.step;
        let other = Parts::both(disc, limit, order, between, count - 1.0)?;
        best = match (best, other) {
            (Some(a), Some(b)) => {
                // With as many turns the smaller outer part, but no second part where one curve does.
                let better = b.turns() < a.turns() || b.turns() == a.turns() && a.even.is_some();
                Some(if better { b } else { a })
            }
            (a, b) => a.or(b),
        };
    }
    let Some(parts) = best else {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "no path keeps both the limit of engagement and the step",
        )
        .value(limit.to_degrees(), "deg")
        .help("enter on a larger circle, or choose a smaller step")
        .into());
    };
    let curves = parts.curves(disc.psi, order)?;
    Ok(Cleared { engagement: Some(parts.angle), ..disc.cleared(curves, parts.turns(), parts.step)? })
}

fn limit(disc: &Disc) -> Result<f64> {
    let Some(limit) = disc.engagement else {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "a path of constant engagement needs a limit of engagement",
        )
        .help("give the largest engagement angle")
        .into());
    };
    if !(limit > 0.0 && limit <= MOST_ENGAGEMENT) {
        return Err(Finding::error(Code::PLAN_VALUE, "the limit of engagement is not usable")
            .value(limit.to_degrees(), "deg")
            .bound(MOST_ENGAGEMENT.to_degrees(), "deg")
            .help("choose an angle above zero and below the bound; 60 deg is usual")
            .into());
    }
    if disc.inner == 0.0 {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "a path of constant engagement cannot start in the centre, where the cutter is in a slot",
        )
        .value_mm(0.0)
        .bound_mm(0.0)
        .help("enter by a helix or through a pre-drilled hole, so that the path starts on a circle")
        .into());
    }
    Ok(limit)
}

/// A path in one or two parts about the origin.
struct Parts {
    inner: f64,
    /// Constant engagement, with its turns.
    even: Option<(ConstantEngagement, f64)>,
    /// Circle from which the constant step goes on to the wall, with the turns.
    lens: Option<(f64, f64)>,
    outer: f64,
    step: f64,
    angle: f64,
}

impl Parts {
    /// Constant engagement up to the circle of radius `between` [mm], `count` turns of constant step from there to the
    /// wall; nothing when there is no room inside, or a limit would be broken.
    fn both(disc: &Disc, limit: f64, order: LensOrder, between: f64, count: f64) -> Result<Option<Parts>> {
        if between <= disc.inner * (1.0 + SLACK) {
            return Ok(None);
        }
        let (mut law, mut whole) = fitted([disc.inner, between], disc.cutter, limit, order, 1.0)?;
        let mut step = last_step(&law, whole);
        for _ in 0..MORE_TURNS {
            if step > disc.step * (1.0 + SLACK) {
                (law, whole) = fitted([disc.inner, between], disc.cutter, limit, order, whole + 1.0)?;
                step = last_step(&law, whole);
            }
        }
        if step > disc.step * (1.0 + SLACK) {
            return Ok(None);
        }
        let lens = (count > 0.0).then_some((between, count));
        if count > 0.0 {
            step = step.max((disc.outer - between) / count);
        }
        let parts = Parts {
            inner: disc.inner,
            even: Some((law, whole)),
            lens,
            outer: disc.outer,
            step,
            angle: law.angle(),
        };
        Ok((count == 0.0 || parts.engaged(disc.cutter, order) <= limit + LOOK_SLACK).then_some(parts))
    }

    /// All of constant step, when it keeps the limit.
    fn constant_step(disc: &Disc, limit: f64, order: LensOrder, count: f64) -> Option<Parts> {
        let step = (disc.outer - disc.inner) / count;
        let mut parts = Parts {
            inner: disc.inner,
            even: None,
            lens: Some((disc.inner, count)),
            outer: disc.outer,
            step,
            angle: 0.0,
        };
        parts.angle = parts.engaged(disc.cutter, order);
        (parts.angle <= limit + LOOK_SLACK).then_some(parts)
    }

    fn supports(&self, order: LensOrder) -> Vec<(Support, f64)> {
        let even = self.even.map(|(law, turns)| (Support::ConstantEngagement(law), turns));
        let lens = self.lens.map(|(inner, turns)| {
            (Support::Lens { inner, base_radius: (self.outer - inner) / (TAU * turns), order }, turns)
        });
        even.into_iter().chain(lens).collect()
    }

    /// Largest engagement [rad] on the first two turns of constant step: it falls from there.
    fn engaged(&self, cutter: f64, order: LensOrder) -> f64 {
        let inside = self.even.map_or(0.0, |(_, turns)| turns);
        let outside = self.lens.map_or(0.0, |(_, turns)| turns);
        let turns = Turns { inner: self.inner, parts: &self.supports(order) };
        turns.largest_engagement(cutter, TAU * inside, TAU * (inside + outside.min(2.0)), LOOKS)
    }

    fn turns(&self) -> f64 {
        self.even.map_or(0.0, |(_, turns)| turns) + self.lens.map_or(0.0, |(_, turns)| turns)
    }

    fn curves(&self, psi: f64, order: LensOrder) -> Result<Vec<PlaneCurve>> {
        let mut curves = Vec::new();
        if let Some((law, turns)) = self.even {
            let spiral = Spiral::new(Support::ConstantEngagement(law).into(), 0.0, TAU * turns)?;
            curves.push(spiral.rotated(psi).into());
        }
        if let Some((inner, turns)) = self.lens {
            // Below MOST_PIECES by the check of the disc.
            curves.push(lens_between(inner, self.outer, turns as u32, psi, order)?);
        }
        Ok(curves)
    }
}
