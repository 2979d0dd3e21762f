//! The plan of a milled bore: all moves from the safe plane back to it.
//!
//! A roughing level: down to the material (rapid in the air only), the entry, the spiral, a circle at the wall, a
//! tangential way back into the open, up. Finishing: a lead-in along an involute, a full circle at the wall, a
//! tangential way out; once at full depth when the flutes are long enough, otherwise level by level.
//!
//! Every move starts where the one before ended. Within the cutting passes of a level the path has at least a
//! common tangent in each joint (involute to circle: common curvature); the exceptions are the foot of a plunge and
//! of a helix, where the direction changes by the slope. The way to the first point, on the safe plane, is the
//! caller's.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;

use super::entry::{self, Opening};
use super::levels::{Level, levels};
use super::rounded::{HALF_TURN, Lead, Rounding, base_radius, cut_at_native_roll, lead, leave};
use super::route::{Pace, PlannedMove, Role, Route};
use super::spec::{BoreSpec, Entry, Finish, Rough, RoughStart, Sense};
use super::spiral::circle;
use super::wear;
use crate::base::{Code, Finding, Result};
use crate::geom::{InvoluteRecord, Joint, PlaneCurve, joint};
use crate::num::angle::wrap_positive;

/// Turns of the involute that leads from the roughed wall back into the open: half a turn of it ends a quarter of
/// the radius off the wall.
const WAY_BACK_TURNS: u32 = 2;
/// Overlap of the finishing circle that is none [rad]: rounding of two tangent angles that are the same.
const NO_OVERLAP: f64 = 1e-9;
/// How far from the wall a lead-in begins that is left to the planner, in allowances: clear of the stock by as much
/// again.
const START_CLEARANCE: f64 = 2.0;
/// Slack of the turns of a helix: a fall of exactly three pitches is three turns.
const TURN_SLACK: f64 = 1e-9;

/// Figures of a pass, as in the tables of the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct PassFigures {
    /// Radius of the path at the wall, R [mm].
    pub path_radius: f64,
    /// Whole turns of the spiral or of the lead-in's involute, n.
    pub turns: u32,
    /// Normal step of neighbouring turns, H [mm].
    pub step: f64,
    /// Base radius, r [mm].
    pub base_radius: f64,
    /// Radius of the circle where the annular spiral begins [mm]; zero: in the centre or a point.
    pub inner_radius: f64,
    /// Length of the spiral or lead-in [mm].
    pub length: f64,
    /// Roll angle at the start, phi0 [rad].
    pub roll: f64,
    /// Rotation of the involute, psi [rad].
    pub psi: f64,
    /// Tangent angle at the start, theta0 [rad].
    pub start_angle: f64,
    /// Turns that are really run.
    pub visible_turns: f64,
    /// Jump of the curvature's derivative where the spiral meets the wall circle [1/mm^2].
    pub slope_jump: f64,
    /// The records as they are run: spiral or lead-in, then the circle; about the bore's centre, at one level.
    pub records: Vec<InvoluteRecord>,
    /// Heights of the floors, from the top [mm].
    pub floors: Vec<f64>,
}

/// A planned bore.
#[derive(Clone, Debug, PartialEq)]
pub struct BorePlan {
    /// The moves in order, from the safe plane above the first entry back to the safe plane.
    pub moves: Vec<PlannedMove>,
    /// Figures of roughing.
    pub rough: Option<PassFigures>,
    /// Figures of finishing.
    pub finish: Option<PassFigures>,
}

impl BorePlan {
    /// The joint after each move but the last.
    pub fn joints(&self) -> Vec<Joint> {
        self.moves.windows(2).map(|w| joint(&w[0].curve, &w[1].curve)).collect()
    }

    /// Path length at feed and at rapid [mm].
    pub fn lengths(&self) -> (f64, f64) {
        self.moves.iter().fold((0.0, 0.0), |(feed, rapid), m| match m.pace {
            Pace::Feed(_) => (feed + m.curve.length(), rapid),
            Pace::Rapid => (feed, rapid + m.curve.length()),
        })
    }
}

/// Plans a bore.
///
/// ```
/// use kinecut::holes::*;
/// let spec = BoreSpec {
///     centre: [0.0, 0.0], top: 0.0, depth: 30.0, breakthrough: None, diameter: 200.0,
///     cutter: CutterData { diameter: 40.0, centre_cutting: true, max_ramp_angle: None, flute_length: 45.0 },
///     sense: Sense::Climb, start: RoughStart::Centre, entry: Entry::Plunge,
///     rough: Some(Rough { step: 4.0, allowance: 1.0, feed: 100.0, plunge_feed: 5.0, axial_step: None }),
///     finish: Some(Finish { turns: 2, feed: 50.0, start: Some([-40.0, 40.0]), end: None, axial_step: None, wear: None }),
///     retract_z: 50.0, approach_z: 2.0, resolution: None,
/// };
/// let plan = plan_bore(&spec).unwrap();
/// assert!((plan.finish.unwrap().length - 242.249726898481).abs() < 1e-10);
/// ```
///
/// # Errors
/// `KC0401` the cutter does not fit, `KC0402` a start outside the path, `KC0403` the entry is not possible,
/// `KC0404` a value is out of range; each with value, bound, key and cure.
pub fn plan_bore(spec: &BoreSpec) -> Result<BorePlan> {
    spec.check()?;
    let mut route = Route::new(spec);
    let rough = match &spec.rough {
        Some(rough) => {
            entry::check(spec, rough)?;
            Some(plan_rough(&mut route, spec, rough)?)
        }
        None => None,
    };
    let finish = match &spec.finish {
        Some(finish) => Some(plan_finish(&mut route, spec, finish).map_err(|e| e.under("finish"))?),
        None => None,
    };
    route.vertically(Role::Retract, Pace::Rapid, spec.retract_z);
    Ok(BorePlan { moves: route.moves, rough, finish })
}

fn plan_rough(route: &mut Route, spec: &BoreSpec, rough: &Rough) -> Result<PassFigures> {
    let radius = spec.rough_radius(rough)?;
    let opening = entry::opening(spec, rough)?;
    if let Entry::Helix { pitch, .. } = spec.entry {
        // The helix has the radius that the rounded spiral starts from.
        entry::ramp(spec, opening.spiral.inner_radius, pitch)?;
    }
    let step = rough.axial_step.unwrap_or(spec.cutter.flute_length);
    let levels = levels(spec.top, spec.full_depth(), step).map_err(|e| e.under("rough.axial_step"))?;
    let back = leave(radius, base_radius(radius, WAY_BACK_TURNS, spec.resolution), HALF_TURN, opening.psi)?;
    for level in &levels {
        route.level = level.index;
        enter(route, spec, rough, &opening, level)?;
        for record in &opening.spiral.records {
            route.along(Role::Rough, rough.feed, record);
        }
        route.circle(Role::Circle, rough.feed, radius, opening.psi)?;
        route.along(Role::LeadOut, rough.feed, &back);
    }
    let spiral = &opening.spiral;
    figures(
        route,
        spec,
        &spiral.records,
        Pass {
            path_radius: radius,
            turns: spiral.turns,
            step: spiral.step,
            base_radius: spiral.base_radius,
            inner_radius: spiral.inner_radius,
            roll: opening.roll,
            psi: opening.psi,
            visible_turns: opening.visible_turns,
        },
        &levels,
    )
}

/// From wherever the cutter is to the floor of the level.
fn enter(route: &mut Route, spec: &BoreSpec, rough: &Rough, opening: &Opening, level: &Level) -> Result<()> {
    let [x, y] = opening.point;
    let clear = level.above + spec.clearance();
    if level.index == 0 {
        route.to(Role::Approach, Pace::Rapid, DVec3::new(x, y, spec.retract_z));
    } else {
        // Up into what the level above has cleared, and across.
        route.vertically(Role::Link, Pace::Rapid, clear);
        route.to(Role::Link, Pace::Rapid, DVec3::new(x, y, clear));
    }
    match spec.entry {
        Entry::Plunge => {
            route.vertically(Role::Approach, Pace::Rapid, clear);
            route.vertically(Role::Entry, Pace::Feed(rough.plunge_feed), level.floor);
        }
        Entry::PreDrilled => {
            route.vertically(Role::Approach, Pace::Rapid, clear.min(level.floor + spec.clearance()));
            route.vertically(Role::Entry, Pace::Feed(rough.plunge_feed), level.floor);
        }
        Entry::Helix { pitch, .. } => {
            route.vertically(Role::Approach, Pace::Rapid, clear);
            let fall = clear - level.floor;
            // Whole turns, so that the foot is where the spiral begins.
            let turns = (fall / pitch - TURN_SLACK).ceil().clamp(1.0, f64::INFINITY);
            let radius = opening.spiral.inner_radius;
            route.around(Role::Entry, rough.plunge_feed, radius, opening.psi, TAU * turns, -fall)?;
            route.to(Role::Entry, Pace::Feed(rough.plunge_feed), DVec3::new(x, y, level.floor));
            route.circle(Role::Circle, rough.feed, radius, opening.psi)?;
        }
    }
    Ok(())
}

fn plan_finish(route: &mut Route, spec: &BoreSpec, finish: &Finish) -> Result<PassFigures> {
    let radius = spec.finish_radius()?;
    let open = open_radius(spec, radius)?;
    let way_in = way_in(spec, finish, radius, open)?;
    let way_out = way_out(spec, finish, radius, open, &way_in)?;
    let overlap = wrap_positive(way_out.psi - way_in.psi);
    let step = finish.axial_step.unwrap_or(spec.cutter.flute_length);
    let levels = levels(spec.top, spec.full_depth(), step).map_err(|e| e.under("axial_step"))?;
    let plane = |lead: &Lead| lead.records.iter().map(|r| PlaneCurve::from(*r)).collect::<Vec<_>>();
    let switches =
        finish.wear.map(|w| wear::switches(&plane(&way_in), &plane(&way_out), &w, open)).transpose()?;
    route.finishing = true;
    for level in &levels {
        route.level = level.index;
        let lead_start = way_in.records[0].start();
        let start = switches.map_or(lead_start, |s| s.start);
        let clear = level.floor + spec.clearance();
        if route.height().is_infinite() {
            route.to(Role::Approach, Pace::Rapid, start.extend(spec.retract_z));
        } else {
            let across = clear.max(route.height() + spec.clearance());
            route.vertically(Role::Link, Pace::Rapid, across);
            route.to(Role::Link, Pace::Rapid, start.extend(across));
        }
        route.vertically(Role::Approach, Pace::Rapid, clear);
        let down = spec.rough.map_or(finish.feed, |r| r.plunge_feed);
        route.vertically(Role::Entry, Pace::Feed(down), level.floor);
        route.comp = switches.is_some();
        route.to(Role::LeadIn, Pace::Feed(finish.feed), lead_start.extend(level.floor));
        for record in &way_in.records {
            route.along(Role::LeadIn, finish.feed, record);
        }
        route.circle(Role::Finish, finish.feed, radius, way_in.psi)?;
        if overlap > NO_OVERLAP && overlap < TAU - NO_OVERLAP {
            route.around(Role::Finish, finish.feed, radius, way_in.psi, overlap, 0.0)?;
        }
        for record in &way_out.records {
            route.along(Role::LeadOut, finish.feed, record);
        }
        route.comp = false;
        if let Some(s) = switches {
            route.to(Role::LeadOut, Pace::Feed(finish.feed), s.end.extend(level.floor));
        }
    }
    figures(
        route,
        spec,
        &way_in.records,
        Pass {
            path_radius: radius,
            turns: finish.turns,
            step: TAU * way_in.base_radius,
            base_radius: way_in.base_radius,
            inner_radius: 0.0,
            roll: way_in.roll,
            psi: way_in.psi,
            visible_turns: way_in.turns,
        },
        &levels,
    )
}

/// Radius about the centre within which the cutter's centre is in the open before finishing [mm].
fn open_radius(spec: &BoreSpec, radius: f64) -> Result<f64> {
    match (&spec.rough, spec.start) {
        (Some(rough), _) => spec.rough_radius(rough),
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
            .cure("rough it first, or use a smaller cutter")
            .into())
        }
        (None, _) => Err(Finding::error(
            Code::ENTRY_IMPOSSIBLE,
            "finishing alone needs the diameter that the bore has before",
        )
        .cure("add `rough`, or give the bore as a pre-drilled start")
        .into()),
    }
}

/// The lead-in, counter-clockwise about the origin.
fn way_in(spec: &BoreSpec, finish: &Finish, radius: f64, open: f64) -> Result<Lead> {
    if let Some(start) = finish.start {
        inside("start", start, open)?;
        return lead(
            radius,
            finish.turns,
            mirrored(spec, start),
            -FRAC_PI_2,
            spec.resolution,
            Rounding::Nearest,
        )
        .map_err(|e| e.under("start"));
    }
    let r = base_radius(radius, finish.turns, spec.resolution);
    let wanted = radius - START_CLEARANCE * (radius - open) - finish.wear.map_or(0.0, |w| START_CLEARANCE * w.largest);
    for halves in 1..2 * finish.turns {
        let turned = HALF_TURN * f64::from(halves);
        if turned * r >= radius {
            break;
        }
        let record = leave(radius, r, turned, 0.0)?.mirrored().reversed();
        if record.start().length() <= wanted {
            let (roll, turns) = (record.start_radius() / r, turned / TAU);
            let records = if spec.resolution.is_some() { cut_at_native_roll(&record) } else { vec![record] };
            return Ok(Lead { records, base_radius: r, roll, psi: 0.0, turns });
        }
    }
    lead(radius, finish.turns, [0.0, 0.0], -FRAC_PI_2, spec.resolution, Rounding::Nearest)
}

/// The lead-out, counter-clockwise about the origin.
fn way_out(spec: &BoreSpec, finish: &Finish, radius: f64, open: f64, way_in: &Lead) -> Result<Lead> {
    let Some([x, y]) = finish.end.map(|p| mirrored(spec, p)) else {
        // The mirror image of the lead-in in the line through the centre and the place where it meets the wall.
        let records = way_in.records.iter().rev().map(|r| r.rotated(-way_in.psi).mirrored().reversed());
        let records = records.map(|r| r.rotated(way_in.psi)).collect();
        return Ok(Lead { records, ..way_in.clone() });
    };
    inside("end", [x, y], open)?;
    Ok(lead(radius, finish.turns, [-x, y], -FRAC_PI_2, spec.resolution, Rounding::Nearest)
        .map_err(|e| e.under("end"))?
        .turned_out())
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
        .cure("choose a point nearer to the bore's centre")
        .key(key)
        .into())
}

/// The numbers of a pass that do not follow from its records.
struct Pass {
    path_radius: f64,
    turns: u32,
    step: f64,
    base_radius: f64,
    inner_radius: f64,
    roll: f64,
    psi: f64,
    visible_turns: f64,
}

fn figures(
    route: &Route,
    spec: &BoreSpec,
    spiral: &[InvoluteRecord],
    pass: Pass,
    levels: &[Level],
) -> Result<PassFigures> {
    let closing = circle(pass.path_radius, pass.psi)?;
    let records: Vec<_> = spiral.iter().chain([&closing]).map(|r| route.turned(r)).collect();
    let clockwise = spec.sense == Sense::Conventional;
    Ok(PassFigures {
        path_radius: pass.path_radius,
        turns: pass.turns,
        step: pass.step,
        base_radius: pass.base_radius,
        inner_radius: pass.inner_radius,
        length: spiral.iter().map(InvoluteRecord::length).sum(),
        roll: pass.roll,
        psi: if clockwise { std::f64::consts::PI - pass.psi } else { pass.psi },
        start_angle: records[0].start_angle(),
        visible_turns: pass.visible_turns,
        slope_jump: pass.base_radius / pass.path_radius.powi(3),
        records,
        floors: levels.iter().map(|l| l.floor).collect(),
    })
}
