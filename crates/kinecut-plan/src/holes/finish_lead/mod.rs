//! Lead-in and lead-out of a finishing pass, as asked for or as usual.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::lead::{Lead, Rounding, curves, cut_at_native_roll, lead};
use super::lens_lead::{angle_of_curvature, lens_lead_in};
use super::spec::{BoreSpec, Finish, LeadEnd};
use super::spiral::{HALF_TURN, base_radius, turned_to};
use crate::base::{Code, Finding, Result};
use crate::geom::{LensOrder, Spiral, Support};

/// Distance from the wall at which the planner's own lead-in begins, in allowances: clear of the stock by one more.
const START_CLEARANCE: f64 = 2.0;

/// The lead-in, counter-clockwise about the origin.
pub(super) fn way_in(spec: &BoreSpec, finish: &Finish, radius: f64, open: f64) -> Result<Lead> {
    let start = match finish.start {
        LeadEnd::Point(p) => LeadEnd::Point(spec.about_centre(p)),
        start => start,
    };
    let way = form(spec, finish, radius, open, start, "start")?;
    match finish.touch_angle {
        None => Ok(way),
        Some(wanted) if is_free(start) => Ok(way.touching_at(spec.tangent_angle(wanted))),
        Some(wanted) => Err(spec.no_free_direction(["touch_angle", "start"], wanted, way.psi).into()),
    }
}

/// Whether a lead with this free end may touch the wall anywhere.
fn is_free(end: LeadEnd) -> bool {
    !matches!(end, LeadEnd::Point(p) if p != [0.0, 0.0])
}

/// A lead-in from the free end that is asked for by `key` and its kin, a point about the centre; where it leaves the
/// place on the wall free, it comes there at tangent angle 0.
fn form(spec: &BoreSpec, finish: &Finish, radius: f64, open: f64, end: LeadEnd, key: &str) -> Result<Lead> {
    match end {
        LeadEnd::Usual => usual(spec, finish, radius, open),
        LeadEnd::Point(p) => {
            inside(key, p, open)?;
            through(spec, finish, radius, p).map_err(|e| e.under(key))
        }
        LeadEnd::Radius(free) => {
            let key = format!("{key}_radius");
            inside(&key, [free, 0.0], open)?;
            let way = through(spec, finish, radius, [free, 0.0]).map_err(|e| e.under(&key))?;
            Ok(way.touching_at(0.0))
        }
        LeadEnd::Length(length) => by_length(spec, finish, radius, open, length, &format!("{key}_length")),
        LeadEnd::CurvatureRadius(free) => {
            by_curvature(spec, finish, radius, open, free, &format!("{key}_curvature_radius"))
        }
    }
}

/// Half a turn from the wall, or more where that would not be clear of the stock.
fn usual(spec: &BoreSpec, finish: &Finish, radius: f64, open: f64) -> Result<Lead> {
    let r = base_radius(radius, finish.turns, spec.resolution);
    if finish.lead != LensOrder::Zero {
        return usual_lens(finish, radius, open);
    }
    let room = radius - open + finish.wear.map_or(0.0, |w| w.largest);
    let wanted = radius - START_CLEARANCE * room;
    for halves in 1..2 * finish.turns {
        let turned = HALF_TURN * f64::from(halves);
        if turned * r >= radius {
            break;
        }
        let way = inwards(spec, radius, r, [turned, radius - r * turned])?;
        if way.curves[0].start().length() <= wanted {
            return Ok(way);
        }
    }
    through(spec, finish, radius, [0.0, 0.0])
}

/// The end of a lens involute that comes to the wall at tangent angle 0, in half turns, clear of the stock.
fn usual_lens(finish: &Finish, radius: f64, open: f64) -> Result<Lead> {
    let room = radius - open + finish.wear.map_or(0.0, |w| w.largest);
    let wanted = radius - START_CLEARANCE * room;
    let whole = lens(finish, radius)?;
    let [_, end] = whole.parameters();
    for halves in 1..2 * finish.turns {
        let start = end - HALF_TURN * f64::from(halves);
        if whole.point(start).length() <= wanted {
            return Ok(lens_way(&whole, start));
        }
    }
    Ok(lens_way(&whole, 0.0))
}

/// The whole lens involute from the centre to the wall.
fn lens(finish: &Finish, radius: f64) -> Result<Spiral> {
    let angle = TAU * f64::from(finish.turns);
    let law = Support::Lens { inner: 0.0, base_radius: radius / angle, order: finish.lead };
    Spiral::new(law.into(), 0.0, angle)
}

/// The end of a lens involute from a parameter on.
fn lens_way(whole: &Spiral, start: f64) -> Lead {
    let [_, end] = whole.parameters();
    Lead {
        curves: vec![whole.between(start, end).into()],
        base_radius: 0.0,
        roll: start,
        psi: 0.0,
        turns: (end - start) / TAU,
    }
}

/// The involute that comes to the wall at tangent angle 0 after turning by `turned` [rad] from where its radius of
/// curvature is `free` [mm].
fn inwards(spec: &BoreSpec, radius: f64, r: f64, [turned, free]: [f64; 2]) -> Result<Lead> {
    let record = turned_to(radius, free, turned, 0.0)?.mirrored().reversed();
    let records = if spec.resolution.is_some() { cut_at_native_roll(&record) } else { vec![record] };
    Ok(Lead {
        curves: curves(records),
        base_radius: r,
        roll: record.start_radius() / r,
        psi: 0.0,
        turns: turned / TAU,
    })
}

/// The involute that comes to the wall at tangent angle 0 and starts where its radius of curvature is `free` [mm].
fn by_curvature(
    spec: &BoreSpec,
    finish: &Finish,
    radius: f64,
    open: f64,
    free: f64,
    key: &str,
) -> Result<Lead> {
    let refused = |rule: &str, bound: f64| {
        Finding::error(Code::PLAN_VALUE, format!("`{key}` {rule}")).value_mm(free).bound_mm(bound).key(key)
    };
    if !(free < radius) {
        let rule = "must be smaller than the radius of the path at the wall, to which the lead opens";
        return Err(refused(rule, radius).help(format!("write less than {radius}")).into());
    }
    let way = if finish.lead == LensOrder::Zero {
        let r = base_radius(radius, finish.turns, spec.resolution);
        inwards(spec, radius, r, [(radius - free) / r, free])?
    } else {
        lens_way(&lens(finish, radius)?, angle_of_curvature(radius, finish.turns, free, finish.lead))
    };
    let start = way.curves[0].start().length();
    if start <= open {
        return Ok(way);
    }
    let rule = "lies so near to the wall that the cutter would come down or up in it";
    let most =
        through(spec, finish, radius, [open, 0.0]).map(|way| 1.0 / way.curves[0].at(0.0).curvature.abs());
    Err(match most {
        // Three decimals, never above the bound.
        Ok(most) => refused(rule, most)
            .help(format!("write {:.3} or less, or more `turns`", (most * 1000.0).floor() / 1000.0)),
        Err(_) => refused(rule, radius).help("write a smaller radius, or more `turns`"),
    }
    .into())
}

/// The involute of a length that comes to the wall at tangent angle 0.
fn by_length(
    spec: &BoreSpec,
    finish: &Finish,
    radius: f64,
    open: f64,
    length: f64,
    key: &str,
) -> Result<Lead> {
    // L = R d - r d^2 / 2 for the turned angle d; a lens involute is as long.
    let r = base_radius(radius, finish.turns, spec.resolution);
    let most = 0.5 * radius * radius / r;
    if length >= most {
        return Err(Finding::error(Code::PLAN_VALUE, "the lead is longer than its whole involute")
            .value_mm(length)
            .bound_mm(most)
            .help("use a shorter lead, or more `turns`")
            .key(key)
            .into());
    }
    let way = if finish.lead == LensOrder::Zero {
        let turned = 2.0 * length / (radius + (radius * radius - 2.0 * r * length).sqrt());
        inwards(spec, radius, r, [turned, radius - r * turned])?
    } else {
        let whole = lens(finish, radius)?;
        lens_way(&whole, whole.parameter(whole.length() - length))
    };
    let free = way.curves[0].start().length();
    if free > open {
        return Err(Finding::error(
            Code::START_OUTSIDE,
            "the lead is too short: the cutter would come down or up in the wall",
        )
        .value_mm(free)
        .bound_mm(open)
        .help("use a longer lead, or fewer `turns`")
        .key(key)
        .into());
    }
    Ok(way)
}

/// The lead-in through a point.
fn through(spec: &BoreSpec, finish: &Finish, radius: f64, point: [f64; 2]) -> Result<Lead> {
    if finish.lead != LensOrder::Zero {
        let lead = lens_lead_in(radius, finish.turns, point, -FRAC_PI_2, finish.lead)?;
        return Ok(Lead {
            curves: vec![lead.spiral.into()],
            base_radius: 0.0,
            roll: lead.theta,
            psi: lead.psi,
            turns: lead.turns,
        });
    }
    lead(radius, finish.turns, point, -FRAC_PI_2, spec.resolution, Rounding::Nearest)
}

/// The lead-out, counter-clockwise about the origin.
pub(super) fn way_out(
    spec: &BoreSpec,
    finish: &Finish,
    radius: f64,
    open: f64,
    way_in: &Lead,
) -> Result<Lead> {
    let mirrored = match finish.end {
        LeadEnd::Point(p) => {
            let [x, y] = spec.about_centre(p);
            LeadEnd::Point([-x, y])
        }
        end => end,
    };
    // A lead-out is the mirror image of a lead-in; the usual one is that of the lead-in at hand.
    let way = match mirrored {
        LeadEnd::Usual => way_in.clone().touching_at(0.0),
        mirrored => form(spec, finish, radius, open, mirrored, "end")?,
    };
    let way = way.turned_out();
    match finish.end_touch_angle {
        wanted if is_free(mirrored) => {
            Ok(way.touching_at(wanted.map_or(way_in.psi, |wanted| spec.tangent_angle(wanted))))
        }
        Some(wanted) => Err(spec.no_free_direction(["end_touch_angle", "end"], wanted, way.psi).into()),
        None => Ok(way),
    }
}

fn inside(key: &str, [x, y]: [f64; 2], open: f64) -> Result<()> {
    if x.hypot(y) <= open {
        return Ok(());
    }
    Err(Finding::error(Code::START_OUTSIDE, "the cutter would come down or up in the wall")
        .value_mm(x.hypot(y))
        .bound_mm(open)
        .help("choose a point nearer to the bore's centre")
        .key(key)
        .into())
}

#[cfg(test)]
mod tests;
