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

use super::entry::{EntryRow, ways};
use super::figures::{PassFigures, Slug};
use super::finish::plan_finish;
use super::levels::no_depth;
use super::ramp::{by_helix, by_ramp};
use super::rough::by_clearing;
use super::spec::{BoreSpec, Rough};
use super::strategy::Strategy;
use super::toolpath::{PlannedMove, Toolpath, ToolpathPace, ToolpathRole};
use crate::base::{Code, Finding, Result};
use crate::geom::{CurveJoint, joint};

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
    /// Findings: a slug that comes loose.
    pub findings: Vec<Finding>,
}

impl BorePlan {
    /// The joint after each move but the last.
    pub fn joints(&self) -> Vec<CurveJoint> {
        self.moves.windows(2).map(|w| joint(&w[0].curve, &w[1].curve)).collect()
    }

    /// Path length at feed and at rapid [mm].
    pub fn lengths(&self) -> (f64, f64) {
        self.moves.iter().fold((0.0, 0.0), |(feed, rapid), m| match m.pace {
            ToolpathPace::Feed(_) => (feed + m.curve.length(), rapid),
            ToolpathPace::Rapid => (feed, rapid + m.curve.length()),
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
    let mut toolpath = Toolpath::new(spec);
    let mut slug = None;
    let (rough, ways) = match &spec.rough {
        Some(rough) => {
            let (figures, ways) = plan_rough(&mut toolpath, spec, rough, &mut slug)?;
            (Some(figures), ways)
        }
        None => (None, Vec::new()),
    };
    let finish = match &spec.finish {
        Some(finish) => Some(plan_finish(&mut toolpath, spec, finish).map_err(|e| e.under("finish"))?),
        None => None,
    };
    toolpath.vertically(ToolpathRole::Retract, ToolpathPace::Rapid, spec.retract_z);
    let findings = slug.iter().map(slug_warning).collect();
    let slug = slug.filter(|_| spec.finish.is_some());
    Ok(BorePlan { moves: toolpath.moves, rough, finish, ways, slug, findings })
}

/// Plans the roughing, and says what ways down there are and what core comes loose.
fn plan_rough(
    toolpath: &mut Toolpath,
    spec: &BoreSpec,
    rough: &Rough,
    slug: &mut Option<Slug>,
) -> Result<(PassFigures, Vec<EntryRow>)> {
    let levels = spec.levels(rough.stepdown, rough.allowance).map_err(|e| e.under("rough"))?;
    let wall = levels.last().ok_or_else(no_depth)?.radius;
    let (entry, ways) = ways(spec, rough, wall)?;
    let figures = match spec.strategy.clearing() {
        Some(clearing) => by_clearing(toolpath, spec, rough, (entry, clearing), &levels),
        None if spec.strategy == Strategy::Ramping => by_ramp(toolpath, spec, rough, (entry, wall), &levels),
        None => by_helix(toolpath, spec, rough, wall, slug),
    };
    Ok((figures?, ways))
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
