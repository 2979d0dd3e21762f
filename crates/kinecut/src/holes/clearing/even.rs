//! The lens spiral of constant engagement, with the step as a cap.
//!
//! The step that keeps an engagement angle `A` grows with the path radius `q`, from `q (1 - cos A)` near the centre to
//! `a (1 - cos A)` on a straight wall. So the spiral of constant engagement has small steps inside and large ones
//! outside; where they would exceed the step asked for, it goes over into a lens involute of constant step, on which
//! the engagement falls outwards. Both parts take whole turns and touch the circle between them, the starting circle
//! and the wall with the contact of the lens.
//!
//! Whole turns: the smallest number for which the engagement stays within the limit; the angle is then lowered until
//! the turns are exactly that many. With few turns that is a good deal: up to a share `1/N` of the steps.

use std::f64::consts::TAU;

use super::spiral::lens_between;
use super::{Cleared, Disc, MOST_PIECES, too_many};
use crate::base::{Code, Finding, Result};
use crate::geom::{ConstantEngagement, LensOrder, PlaneCurve, Spiral, Support};
use crate::holes::spiral::{circle, turns};
use crate::num::root::bracketed_newton;

/// Largest limit [rad]: beyond it the cutter is as good as in a slot, and there is nothing to keep.
const MOST_ENGAGEMENT: f64 = 150.0 * std::f64::consts::PI / 180.0;
/// Relative slack of a whole number of turns and of a step: a hundred times the rounding of the turn count.
const SLACK: f64 = 1e-12;
/// Newton steps for the angle: a dozen from the law `turns ~ 1/(1 - cos A)`, more only where the bracket is halved.
const STEPS: u32 = 100;

/// The spiral of constant engagement between two circles in the smallest whole number of turns, with that number.
fn fitted(
    inner: f64,
    outer: f64,
    cutter: f64,
    limit: f64,
    order: LensOrder,
) -> Result<(ConstantEngagement, f64)> {
    let law = |angle: f64| ConstantEngagement::new(inner, outer, cutter, angle, order);
    let wanted = law(limit).turns();
    let whole = (wanted * (1.0 - SLACK)).ceil().max(1.0);
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
    let outermost = ((disc.outer - reach) / disc.step).ceil().max(0.0);
    // The last turn of the inner part is smaller than the step at its end: one turn less at constant step may do.
    let mut best: Option<Parts> = None;
    for count in [(outermost - 1.0).max(0.0), outermost] {
        let Some(parts) = Parts::new(disc, limit, order, count)? else {
            continue;
        };
        if best.as_ref().is_none_or(|b| parts.turns < b.turns) {
            best = Some(parts);
        }
    }
    let parts = match best {
        Some(parts) => parts,
        None => Parts::even_step(disc, order)?,
    };
    Ok(Cleared {
        curves: parts.curves,
        inner: disc.inner,
        closing: circle(disc.outer, disc.psi)?,
        turns: parts.turns,
        step: parts.step,
        engagement: Some(parts.angle),
    })
}

fn limit(disc: &Disc) -> Result<f64> {
    let Some(limit) = disc.engagement else {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "a path of constant engagement needs a limit of engagement",
        )
        .cure("give the largest engagement angle")
        .into());
    };
    if !(limit > 0.0 && limit <= MOST_ENGAGEMENT) {
        return Err(Finding::error(Code::PLAN_VALUE, "the limit of engagement is not usable")
            .value(limit.to_degrees(), "deg")
            .bound(MOST_ENGAGEMENT.to_degrees(), "deg")
            .cure("choose an angle above zero and below the bound; 60 deg is usual")
            .into());
    }
    if disc.inner == 0.0 {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "a path of constant engagement cannot start in the centre, where the cutter is in a slot",
        )
        .value_mm(0.0)
        .bound_mm(0.0)
        .cure("enter by a helix or through a pre-drilled hole, so that the path starts on a circle")
        .into());
    }
    Ok(limit)
}

/// A path in one or two parts.
struct Parts {
    curves: Vec<PlaneCurve>,
    turns: f64,
    step: f64,
    angle: f64,
}

impl Parts {
    /// With `count` turns of the largest step at the wall, constant engagement inside; nothing when there is no room
    /// inside, or its steps are too large.
    fn new(disc: &Disc, limit: f64, order: LensOrder, count: f64) -> Result<Option<Parts>> {
        let between = disc.outer - count * disc.step;
        if between <= disc.inner * (1.0 + SLACK) {
            return Ok(None);
        }
        let (law, whole) = fitted(disc.inner, between, disc.cutter, limit, order)?;
        let mut step = last_step(&law, whole);
        if step > disc.step * (1.0 + SLACK) {
            return Ok(None);
        }
        let spiral = Spiral::new(Support::ConstantEngagement(law).into(), 0.0, TAU * whole)?;
        let mut curves = vec![PlaneCurve::from(spiral.rotated(disc.psi))];
        if count > 0.0 {
            step = disc.step;
            // Below MOST_PIECES by the check of the disc.
            curves.push(lens_between(between, disc.outer, count as u32, disc.psi, order)?);
        }
        Ok(Some(Parts { curves, turns: whole + count, step, angle: law.angle() }))
    }

    /// All of constant step, where the engagement stays below its limit from the start.
    fn even_step(disc: &Disc, order: LensOrder) -> Result<Parts> {
        let n = turns(disc.outer - disc.inner, disc.step)?;
        let step = (disc.outer - disc.inner) / f64::from(n);
        // It is largest where the first full step is reached.
        let radius = disc.inner + step;
        let angle = crate::holes::engagement_formula(radius, disc.cutter, step);
        Ok(Parts {
            curves: vec![lens_between(disc.inner, disc.outer, n, disc.psi, order)?],
            turns: f64::from(n),
            step,
            angle,
        })
    }
}
