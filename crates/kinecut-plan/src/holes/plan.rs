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

use std::f64::consts::TAU;

use super::entry::Opening;
use super::entry_table::{EntryRow, ways};
use super::finish::{Way, plan_finish};
use super::levels::Level;
use super::rough::plan_rough;
use super::route::{Pace, PlannedMove, Role, Route};
use super::spec::BoreSpec;
use super::spiral::circle;
use crate::base::{Code, Finding, Result};
use crate::geom::{Joint, PlaneCurve, joint};

/// Figures of a pass, as in the tables of the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct PassFigures {
    /// Radius of the path at the wall, R [mm].
    pub path_radius: f64,
    /// Turns of the clearing, the circle at the wall not counted, or of the lead-in's involute from the centre, n.
    pub turns: f64,
    /// Normal step of neighbouring turns, H [mm].
    pub step: f64,
    /// Base radius of the involute at the wall, r [mm]; zero for other curves.
    pub base_radius: f64,
    /// Radius of the circle where the annular spiral begins [mm]; zero: in the centre or a point.
    pub inner_radius: f64,
    /// Engagement that the strategy keeps [rad], if it keeps one.
    pub engagement: Option<f64>,
    /// Length of the clearing path or lead-in [mm].
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
    /// The curves as they are run: clearing or lead-in, then the circle; about the bore's centre, at the last level.
    pub curves: Vec<PlaneCurve>,
    /// Heights of the floors, from the top [mm].
    pub floors: Vec<f64>,
}

/// A core that comes loose and has to be taken out before the program goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slug {
    /// Its diameter [mm].
    pub diameter: f64,
    /// Index of the move before which it is taken out; the tool is on the safe plane then.
    pub before: usize,
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
    /// The entry table of roughing.
    pub ways: Vec<EntryRow>,
    /// The core that comes loose before finishing, if there is one.
    pub slug: Option<Slug>,
    /// What a person should know: a slug that comes loose.
    pub findings: Vec<Finding>,
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
/// # use kinecut_plan as kinecut;
/// use kinecut::holes::*;
/// let cutter =
///     CutterData { diameter: 40.0, centre_cutting: true, max_ramp_angle: None, flute_length: 45.0 };
/// let spec = BoreSpec {
///     rough: Some(Rough { allowance: 1.0, ..Rough::new(4.0, 100.0) }),
///     finish: Some(Finish { start: LeadEnd::Point([-40.0, 40.0]), ..Finish::new(50.0) }),
///     ..BoreSpec::new(200.0, 30.0, cutter)
/// };
/// let plan = plan_bore(&spec).unwrap();
/// assert!((plan.finish.unwrap().length - 242.249726898481).abs() < 1e-10);
/// ```
///
/// # Errors
/// `KC0401` the cutter does not fit, `KC0402` a start outside the path, `KC0403` the entry is not possible,
/// `KC0404` a value is out of range; each with value, bound, key and help.
pub fn plan_bore(spec: &BoreSpec) -> Result<BorePlan> {
    spec.check()?;
    let mut route = Route::new(spec);
    let mut slug = None;
    let (rough, ways) = match &spec.rough {
        Some(rough) => {
            let figures = plan_rough(&mut route, spec, rough, &mut slug)?;
            (Some(figures), ways(spec, rough)?)
        }
        None => (None, Vec::new()),
    };
    let finish = match &spec.finish {
        Some(finish) => Some(plan_finish(&mut route, spec, finish).map_err(|e| e.under("finish"))?),
        None => None,
    };
    route.vertically(Role::Retract, Pace::Rapid, spec.retract_z);
    let findings = slug.iter().map(slug_warning).collect();
    let slug = slug.filter(|_| spec.finish.is_some());
    Ok(BorePlan { moves: route.moves, rough, finish, ways, slug, findings })
}

fn slug_warning(slug: &Slug) -> Finding {
    let core = slug.diameter;
    Finding::warning(
        Code::SLUG,
        format!("the core of diameter {core:.3} mm comes loose when the helix goes through"),
    )
    .value_mm(core)
    .bound_mm(0.0)
    .help("hold it from below, or clear the bore by another strategy")
    .key("strategy")
}

impl PassFigures {
    /// Of a roughed level.
    pub(super) fn of(route: &Route, opening: Opening, radius: f64, levels: &[Level]) -> Result<PassFigures> {
        let curves = opening.curves;
        let figures = PassFigures {
            path_radius: radius,
            turns: opening.turns,
            step: opening.step,
            base_radius: opening.base_radius,
            inner_radius: opening.inner_radius,
            engagement: opening.engagement,
            length: curves.iter().map(PlaneCurve::length).sum(),
            roll: opening.roll,
            psi: opening.psi,
            start_angle: 0.0,
            visible_turns: opening.visible_turns,
            slope_jump: opening.base_radius / radius.powi(3),
            curves,
            floors: levels.iter().map(|l| l.floor).collect(),
        };
        figures.placed(route)
    }

    /// Of a finished level.
    pub(super) fn of_lead(
        route: &Route,
        way: Way,
        turns: u32,
        radius: f64,
        levels: &[Level],
    ) -> Result<PassFigures> {
        let opening = Opening {
            point: [0.0, 0.0],
            inner_radius: 0.0,
            base_radius: way.base_radius,
            turns: f64::from(turns),
            step: TAU * way.base_radius,
            engagement: None,
            roll: way.roll,
            psi: way.psi,
            visible_turns: way.turns,
            curves: way.curves,
        };
        PassFigures::of(route, opening, radius, levels)
    }

    /// With the circle, and as it is run.
    fn placed(mut self, route: &Route) -> Result<PassFigures> {
        self.curves.push(circle(self.path_radius, self.psi)?.into());
        self.curves = self.curves.iter().map(|c| route.turned(c)).collect();
        if route.is_clockwise() {
            self.psi = std::f64::consts::PI - self.psi;
        }
        self.start_angle = self.curves[0].at(0.0).angle;
        Ok(self)
    }
}
