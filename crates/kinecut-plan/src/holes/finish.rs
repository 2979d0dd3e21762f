//! Finishing of a bore's wall: a lead-in along a spiral, the circle at the wall, spring passes, a lead-out; once at
//! full depth when the flutes are long enough, otherwise level by level.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use super::lens_lead::lens_lead_in;
use super::levels::{Level, levels};
use super::plan::PassFigures;
use super::rounded::{HALF_TURN, Lead, Rounding, base_radius, cut_at_native_roll, lead, leave};
use super::route::{Pace, Role, Route};
use super::spec::{BoreSpec, Finish, LeadEnd, RoughStart, Sense};
use super::wear;
use crate::base::{Code, Finding, Result};
use crate::geom::{LensOrder, PlaneCurve, Spiral, Support};
use crate::num::angle::wrap_positive;

/// Overlap of the finishing circle that is none [rad]: rounding of two tangent angles that are the same.
const NO_OVERLAP: f64 = 1e-9;
/// How far from the wall a lead-in begins that is left to the planner, in allowances: clear of the stock by as much
/// again.
const START_CLEARANCE: f64 = 2.0;

/// A lead-in or lead-out, in the order in which it is run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Way {
    pub(super) curves: Vec<PlaneCurve>,
    pub(super) base_radius: f64,
    /// Roll angle at the free end [rad].
    pub(super) roll: f64,
    /// Tangent angle at the wall [rad].
    pub(super) psi: f64,
    pub(super) turns: f64,
}

impl From<Lead> for Way {
    fn from(l: Lead) -> Way {
        let curves = l.records.into_iter().map(PlaneCurve::from).collect();
        Way { curves, base_radius: l.base_radius, roll: l.roll, psi: l.psi, turns: l.turns }
    }
}

impl Way {
    /// Turned about the bore's centre [rad].
    fn rotated(self, angle: f64) -> Way {
        let curves = self.curves.iter().map(|c| c.rotated(angle)).collect();
        Way { curves, psi: self.psi + angle, ..self }
    }

    /// The mirror image in the y axis, run backwards: a way in becomes a way out, the place `psi` becomes `-psi`.
    fn turned_out(&self) -> Way {
        let curves = self.curves.iter().rev().map(|c| c.mirrored().reversed()).collect();
        Way { curves, psi: -self.psi, ..*self }
    }
}

pub(super) fn plan_finish(route: &mut Route, spec: &BoreSpec, finish: &Finish) -> Result<PassFigures> {
    let step = finish.stepdown.unwrap_or(spec.cutter.flute_length);
    let levels = levels(spec.top, spec.full_depth(), step).map_err(|e| e.under("stepdown"))?;
    route.finishing = true;
    let mut last: Option<(f64, f64, Ways)> = None;
    for level in &levels {
        route.level = level.index;
        let radius = spec.finish_radius(level.floor)?;
        let open = open_radius(spec, radius, level)?;
        let ways = match last.take() {
            Some((r, o, ways)) if (r, o) == (radius, open) => ways,
            _ => {
                let enter = way_in(spec, finish, radius, open)?;
                let leave = way_out(spec, finish, radius, open, &enter)?;
                let switches = finish
                    .wear
                    .map(|w| wear::switches(&enter.curves, &leave.curves, &w, open))
                    .transpose()?;
                Ways { enter, leave, switches }
            }
        };
        run(route, spec, finish, level, radius, &ways)?;
        last = Some((radius, open, ways));
    }
    let Some((radius, _, ways)) = last else {
        return Err(Finding::error(Code::PLAN_VALUE, "a bore needs a depth").into());
    };
    let way_in = ways.enter;
    PassFigures::of_lead(route, way_in, finish.turns, radius, &levels)
}

/// The ways of a level.
struct Ways {
    enter: Way,
    leave: Way,
    /// Where the control's compensation is switched on and off.
    switches: Option<wear::Switches>,
}

/// One level.
fn run(
    route: &mut Route,
    spec: &BoreSpec,
    finish: &Finish,
    level: &Level,
    radius: f64,
    ways: &Ways,
) -> Result<()> {
    let (way_in, way_out) = (&ways.enter, &ways.leave);
    let lead_start = way_in.curves[0].start();
    let start = ways.switches.map_or(lead_start, |s| s.start);
    descend(route, spec, finish, level, start);
    let feed = centre_feed(spec, finish, radius);
    route.comp = ways.switches.is_some();
    route.to(Role::LeadIn, Pace::Feed(feed), lead_start.extend(level.floor));
    for curve in &way_in.curves {
        route.along(Role::LeadIn, feed, curve);
    }
    for _ in 0..=finish.spring_passes {
        route.circle(Role::Finish, feed, radius, way_in.psi)?;
    }
    let overlap = wrap_positive(way_out.psi - way_in.psi);
    if overlap > NO_OVERLAP && overlap < TAU - NO_OVERLAP {
        route.around(Role::Finish, feed, radius, way_in.psi, overlap, 0.0)?;
    }
    for curve in &way_out.curves {
        route.along(Role::LeadOut, feed, curve);
    }
    route.comp = false;
    if let Some(s) = ways.switches {
        route.to(Role::LeadOut, Pace::Feed(feed), s.end.extend(level.floor));
    }
    Ok(())
}

/// To a place on the floor of a level, from the safe plane or across what is open.
pub(super) fn descend(route: &mut Route, spec: &BoreSpec, finish: &Finish, level: &Level, start: DVec2) {
    let clear = level.floor + spec.clearance();
    if route.height() >= spec.retract_z {
        route.to(Role::Approach, Pace::Rapid, start.extend(spec.retract_z));
    } else {
        let across = clear.max(route.height() + spec.clearance());
        route.vertically(Role::Link, Pace::Rapid, across);
        route.to(Role::Link, Pace::Rapid, start.extend(across));
    }
    route.vertically(Role::Approach, Pace::Rapid, clear);
    let down = spec.rough.map_or(finish.feed, |r| r.plunge_feed);
    route.vertically(Role::Entry, Pace::Feed(down), level.floor);
}

/// Feed of the cutter's centre [mm/s]: at the wall the edge's envelope runs on a circle larger by the cutter's
/// radius.
fn centre_feed(spec: &BoreSpec, finish: &Finish, radius: f64) -> f64 {
    if finish.feed_at_wall { finish.feed * radius / (radius + spec.cutter_radius()) } else { finish.feed }
}

/// Radius about the centre within which the cutter's centre is in the open before finishing a level [mm].
fn open_radius(spec: &BoreSpec, radius: f64, level: &Level) -> Result<f64> {
    match (&spec.rough, spec.start) {
        (Some(rough), _) => {
            // The roughing level that holds this floor may end deeper, where a conical wall is narrower.
            let step = rough.stepdown.unwrap_or(spec.cutter.flute_length);
            /// Floors that agree but for rounding [mm].
            const SAME: f64 = 1e-9;
            let floor = levels(spec.top, spec.full_depth(), step)?
                .iter()
                .map(|l| l.floor)
                .find(|f| *f <= level.floor + SAME)
                .unwrap_or(level.floor);
            spec.rough_radius(rough, floor)
        }
        (None, RoughStart::PreDrilled { diameter }) => {
            let open = 0.5 * diameter - spec.cutter_radius();
            if open > 0.0 {
                return Ok(open.min(radius));
            }
            Err(Finding::error(
                Code::ENTRY_IMPOSSIBLE,
                "the cutter does not fit into the bore as it is before finishing",
            )
            .value_mm(spec.cutter.diameter)
            .bound_mm(diameter)
            .help("rough it first, or use a smaller cutter")
            .into())
        }
        (None, _) => Err(Finding::error(
            Code::ENTRY_IMPOSSIBLE,
            "finishing alone needs the diameter that the bore has before",
        )
        .help("add `rough`, or give the bore as a pre-drilled start")
        .into()),
    }
}

/// The lead-in, counter-clockwise about the origin.
fn way_in(spec: &BoreSpec, finish: &Finish, radius: f64, open: f64) -> Result<Way> {
    let r = base_radius(radius, finish.turns, spec.resolution);
    match finish.start {
        LeadEnd::Usual => usual(spec, finish, radius, open, r),
        LeadEnd::Point(p) => {
            inside("start", p, open)?;
            through(spec, finish, radius, mirrored(spec, p)).map_err(|e| e.under("start"))
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
fn usual(spec: &BoreSpec, finish: &Finish, radius: f64, open: f64, r: f64) -> Result<Way> {
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
fn usual_lens(finish: &Finish, radius: f64, open: f64) -> Result<Way> {
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
fn lens_way(whole: &Spiral, start: f64) -> Way {
    let [_, end] = whole.parameters();
    Way {
        curves: vec![whole.between(start, end).into()],
        base_radius: 0.0,
        roll: start,
        psi: 0.0,
        turns: (end - start) / TAU,
    }
}

/// The involute that comes to the wall at tangent angle 0 after turning by `turned` [rad].
fn inwards(spec: &BoreSpec, radius: f64, r: f64, turned: f64) -> Result<Way> {
    let record = leave(radius, r, turned, 0.0)?.mirrored().reversed();
    let records = if spec.resolution.is_some() { cut_at_native_roll(&record) } else { vec![record] };
    Ok(Way {
        curves: records.into_iter().map(PlaneCurve::from).collect(),
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
) -> Result<Way> {
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
fn through(spec: &BoreSpec, finish: &Finish, radius: f64, point: [f64; 2]) -> Result<Way> {
    if finish.lead != LensOrder::Zero {
        let lead = lens_lead_in(radius, finish.turns, point, -FRAC_PI_2, finish.lead)?;
        return Ok(Way {
            curves: vec![lead.spiral.into()],
            base_radius: 0.0,
            roll: lead.theta,
            psi: lead.psi,
            turns: lead.turns,
        });
    }
    Ok(lead(radius, finish.turns, point, -FRAC_PI_2, spec.resolution, Rounding::Nearest)?.into())
}

/// The lead-out, counter-clockwise about the origin.
fn way_out(spec: &BoreSpec, finish: &Finish, radius: f64, open: f64, way_in: &Way) -> Result<Way> {
    match finish.end {
        // The mirror image of the lead-in in the line through the centre and the place where it meets the wall.
        LeadEnd::Usual => {
            let (psi, here) = (way_in.psi, way_in.clone());
            Ok(here.rotated(-psi).turned_out().rotated(psi))
        }
        LeadEnd::Point(p) => {
            inside("end", p, open)?;
            let [x, y] = mirrored(spec, p);
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

fn mirrored(spec: &BoreSpec, [x, y]: [f64; 2]) -> [f64; 2] {
    if spec.sense == Sense::Climb { [x, y] } else { [-x, y] }
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
