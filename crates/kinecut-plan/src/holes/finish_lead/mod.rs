//! Lead-in and lead-out of a finishing pass, as asked for or as usual.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::lead::{Lead, Rounding, curves, cut_at_native_roll, lead};
use super::lens_lead::lens_lead_in;
use super::spec::{BoreSpec, Finish, LeadEnd};
use super::spiral::{HALF_TURN, base_radius, leave};
use crate::base::{Code, Finding, Result};
use crate::geom::{LensOrder, Spiral, Support};

/// Distance from the wall at which the planner's own lead-in begins, in allowances: clear of the stock by one more.
const START_CLEARANCE: f64 = 2.0;

/// The lead-in, counter-clockwise about the origin.
pub(super) fn way_in(spec: &BoreSpec, finish: &Finish, radius: f64, open: f64) -> Result<Lead> {
    let r = base_radius(radius, finish.turns, spec.resolution);
    match finish.start {
        LeadEnd::Usual => usual(spec, finish, radius, open, r),
        LeadEnd::Point(p) => {
            let p = spec.about_centre(p);
            inside("start", p, open)?;
            through(spec, finish, radius, p).map_err(|e| e.under("start"))
        }
        LeadEnd::Radius(start) => {
            inside("start_radius", [start, 0.0], open)?;
            let way = through(spec, finish, radius, [start, 0.0]).map_err(|e| e.under("start_radius"))?;
            let psi = way.psi;
            Ok(way.rotated(-psi))
        }
        LeadEnd::Length(length) => by_length(spec, finish, radius, open, length, "start_length"),
    }
}

/// Half a turn from the wall, or more where that would not be clear of the stock.
fn usual(spec: &BoreSpec, finish: &Finish, radius: f64, open: f64, r: f64) -> Result<Lead> {
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
        let way = inwards(spec, radius, r, turned)?;
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

/// The involute that comes to the wall at tangent angle 0 after turning by `turned` [rad].
fn inwards(spec: &BoreSpec, radius: f64, r: f64, turned: f64) -> Result<Lead> {
    let record = leave(radius, r, turned, 0.0)?.mirrored().reversed();
    let records = if spec.resolution.is_some() { cut_at_native_roll(&record) } else { vec![record] };
    Ok(Lead {
        curves: curves(records),
        base_radius: r,
        roll: record.start_radius() / r,
        psi: 0.0,
        turns: turned / TAU,
    })
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
        inwards(spec, radius, r, turned)?
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
    match finish.end {
        // The mirror image of the lead-in in the line through the centre and the place where it meets the wall.
        LeadEnd::Usual => {
            let (psi, here) = (way_in.psi, way_in.clone());
            Ok(here.rotated(-psi).turned_out().rotated(psi))
        }
        LeadEnd::Point(p) => {
            let [x, y] = spec.about_centre(p);
            inside("end", [x, y], open)?;
            Ok(through(spec, finish, radius, [-x, y]).map_err(|e| e.under("end"))?.turned_out())
        }
        LeadEnd::Radius(end) => {
            inside("end_radius", [end, 0.0], open)?;
            let way = through(spec, finish, radius, [end, 0.0]).map_err(|e| e.under("end_radius"))?;
            let psi = way.psi;
            Ok(way.rotated(-psi).turned_out().rotated(way_in.psi))
        }
        LeadEnd::Length(length) => {
            let way = by_length(spec, finish, radius, open, length, "end_length")?;
            Ok(way.turned_out().rotated(way_in.psi))
        }
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
