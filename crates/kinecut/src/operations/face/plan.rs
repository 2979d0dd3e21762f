//! A face operation in the planner's words, and what was planned.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec2;

use super::{FaceOperation, SimulatedFace, TurnName};
use crate::base::{Error, Finding, Result};
use crate::facing::optimum::Options;
use crate::facing::passes::{EdgeStretch, PassPath};
use crate::facing::{self, FacePlan, FaceSpec, MillingWay, PassesChoice, Tooth, ToothedPass};
use crate::operations::{Attempt, Setting};

/// A planned face operation.
#[derive(Clone, Debug)]
pub struct PlannedFace {
    /// The operation.
    pub of: Arc<FaceOperation>,
    /// Number of the operation over all setups.
    pub operation: u32,
    /// Index of the first item of the plan's program that mills it.
    pub first_item: u32,
    /// Height of the finished plane in coordinates of the work offset [mm].
    pub top: f64,
    /// The planner's result.
    pub plan: FacePlan,
    /// Angle by which the part is turned on the table, counter-clockwise [rad]; 0 where the path is.
    pub part_turned: f64,
    /// Direction of X of the turned coordinates that the program uses, from X of the work offset [rad]; 0 for none.
    pub coordinates_turned: f64,
    /// The cutter's teeth.
    pub teeth: Vec<Tooth>,
    /// Feed per revolution [mm].
    pub feed_per_revolution: f64,
    /// Its exits as simulated, once they were.
    pub simulated: Option<SimulatedFace>,
}

impl PlannedFace {
    /// The way chosen, as an M3 spindle sees it.
    pub fn chosen(&self) -> &MillingWay {
        &self.plan.ways[self.plan.chosen]
    }

    /// The path chosen, in the coordinates of the outline as the part lies when it is not turned.
    pub fn path(&self) -> PassPath {
        let path = &self.chosen().path;
        if self.plan.left_hand { path.mirrored() } else { path.clone() }
    }

    /// The path in the coordinates of the program: those of the work offset, turned where it turns them.
    pub fn programmed_path(&self) -> PassPath {
        self.path().moved(self.part_turned - self.coordinates_turned, DVec2::ZERO)
    }

    /// A point of the work offset in the coordinates of the outline.
    pub fn in_outline(&self, point: DVec2) -> DVec2 {
        DVec2::from_angle(-self.part_turned).rotate(point)
    }

    /// An edge of the outline as the part lies, and a share of its length, as the plan's case has them: there an M4
    /// spindle sees the part in the mirror.
    pub fn as_planned(&self, edge: usize, s: f64) -> (usize, f64) {
        let of = self.plan.case.outline.loops().iter().find(|l| l.edges.contains(&edge));
        match of.filter(|_| self.plan.left_hand) {
            Some(l) => (l.edges.start + l.edges.end - 1 - edge, 1.0 - s),
            None => (edge, s),
        }
    }

    /// The stretch of the plan that holds a place of the outline as the part lies, and the share of the length there.
    pub fn planned_stretch(&self, edge: usize, s: f64) -> Option<(&EdgeStretch, f64)> {
        let (edge, s) = self.as_planned(edge, s);
        let mut all = self.chosen().burr.stretches.iter().filter(|x| x.edge == edge);
        all.find(|x| x.from <= s && s <= x.to).map(|x| (x, s))
    }

    /// One straight pass of the real teeth under the way chosen, if that is one straight pass.
    pub fn toothed_pass(&self) -> Option<ToothedPass> {
        let pass = ToothedPass {
            teeth: self.teeth.clone(),
            feed_per_radian: self.feed_per_revolution / (2.0 * PI),
            placement: self.chosen().placement()?,
            along: 0.0,
        };
        pass.checked().ok()
    }
}

/// Plans a face operation; what a person should know of it comes with it.
///
/// # Errors
/// Those of the planner.
pub(super) fn plan_face(face: &Arc<FaceOperation>, setting: &Setting<'_>) -> Result<Attempt<PlannedFace>> {
    let rapid = setting.machine.and_then(|m| m.dynamics.rapid);
    let (plan, findings) = facing::plan_face(&spec(face, setting.compare, rapid), setting.progress)?;
    let planned = planned(face, setting.number, plan);
    if face.table.turn == TurnName::Part && setting.others > 0 {
        return Err(Error::from(
            Finding::error(
                crate::base::Code::JOB_SHAPE,
                "a part is turned for one operation: other operations of the setup would not know",
            )
            .help("give the face a setup of its own, or turn the path or the coordinates")
            .key("turn"),
        ));
    }
    Ok(Attempt::SetupPlan(planned, findings))
}

/// The plan with what the job adds to it.
fn planned(face: &Arc<FaceOperation>, operation: u32, plan: FacePlan) -> PlannedFace {
    let way = &plan.ways[plan.chosen];
    let seen = if plan.left_hand { -1.0 } else { 1.0 };
    let angle = seen * way.angle.unwrap_or(0.0);
    let tool = &face.milling.tool;
    let teeth =
        tool.spacing.places(tool.teeth).map(|(phase, out)| Tooth { phase, radius: face.case.radius + out });
    PlannedFace {
        of: Arc::clone(face),
        operation,
        first_item: 0,
        top: face.table.top,
        part_turned: if face.table.turn == TurnName::Part { angle } else { 0.0 },
        // Turned by the angle the feed runs along X: X of the turned coordinates lies at minus the angle.
        coordinates_turned: if face.table.turn == TurnName::Coordinates { -angle } else { 0.0 },
        teeth: teeth.collect(),
        feed_per_revolution: face.feed_per_revolution,
        simulated: None,
        plan,
    }
}

/// Constraints of the placement; `mirrored`: as an M4 spindle sees the part.
pub(crate) fn options(face: &FaceOperation, mirrored: bool) -> Options {
    let t = &face.table;
    let mut options = Options {
        margin: face.margin,
        forbidden: t.forbidden.iter().map(|f| f.map(f64::to_radians)).collect(),
        least_off_middle: t.off_centre,
        ..Options::for_cutter(face.case.radius)
    };
    if let Some(engagement) = t.engagement {
        options.engagement = engagement.map(f64::to_radians);
    }
    if mirrored { options.mirrored() } else { options }
}

/// The operation in the planner's words, with the machine's rapid [mm/s] if it is known.
fn spec(face: &FaceOperation, compare: bool, rapid: Option<f64>) -> FaceSpec {
    let t = &face.table;
    /// Speed of links where no machine is given [mm/s].
    const USUAL_RAPID: f64 = 500.0;
    FaceSpec {
        case: face.case.clone(),
        left_hand: t.left_hand,
        guard: face.guard,
        options: options(face, false),
        placement: t.placement.unwrap_or_default(),
        passes: t.passes.unwrap_or(PassesChoice::Fewest),
        feed: face.feed,
        rapid: rapid.unwrap_or(USUAL_RAPID),
        clearance: t.clearance.unwrap_or(5.0),
        compare,
    }
}
