//! A planned chamfer: its table in the planner's words, its moves, its wall.

use std::sync::Arc;

use glam::DVec2;

use super::ChamferOperation;
use super::json::ChamferJson;
use super::section::section;
use super::webs::{Webs, warning};
use crate::base::{Code, Error, Result};
use crate::contouring::{ContourLoops, ContourPlan, ContourSide, ContourSpec, plan_contour};
use crate::holes::CutterData;
use crate::operations::band::{Band, Slope};
use crate::operations::kind::{self, Attempt, Checked as _};
use crate::operations::wall::{CLEARANCE, write_moves};
use crate::operations::wanted::{Wall, WantedWall};
use crate::operations::{Found, Judged, Pen, PostedPlan, Setting, Shown, uncut};
use crate::page::Section;

/// Distance of the cutter from the edge where it comes down [mm].
const BESIDE: f64 = 0.05;
/// Way beyond the start that is cut twice where the job does not say [mm].
const OVERLAP: f64 = 1.0;

/// A planned chamfer.
#[derive(Clone, Debug)]
pub struct PlannedChamfer {
    /// The operation.
    pub of: Arc<ChamferOperation>,
    /// The way of its tip as a contour: that of a cutter whose radius is the distance of the tip from the wall.
    pub spec: ContourSpec,
    /// The plan.
    pub plan: ContourPlan,
}

/// Plans a chamfer.
pub(super) fn planned(of: &Arc<ChamferOperation>, setting: &Setting<'_>) -> Result<Attempt<PlannedChamfer>> {
    let spec = spec(setting, of);
    let plan = plan_contour(&spec).map_err(|e| in_its_words(e, &spec))?;
    // The planner tells of fillets: a chamfer leaves webs.
    let mut findings = plan.findings.clone();
    findings.retain(|f| f.code != Code::CORNERS_STAY);
    findings.extend(warning(&plan.uncut));
    Ok(Attempt::SetupPlan(PlannedChamfer { of: Arc::clone(of), spec, plan }, findings))
}

/// The operation in the planner's words.
fn spec(setting: &Setting<'_>, of: &ChamferOperation) -> ContourSpec {
    let (t, chamfer) = (&of.table, &of.chamfer);
    let safe = setting.clamping.safe_height;
    let tool = CutterData::of(&of.milling.tool);
    // Beside the edge it comes down in the air, where no tooth has to cut at the centre.
    let cutter =
        CutterData { diameter: 2.0 * chamfer.offset(), centre_cutting: true, max_ramp_angle: None, ..tool };
    ContourSpec {
        side: of.side,
        loops: of.loops,
        left_hand: of.is_left_hand(),
        sense: t.direction,
        top: of.top,
        stock_to_leave: of.stock_to_leave,
        plunge_feed: of.plunge_feed,
        ramp: None,
        room: Some(chamfer.top_radius() + of.stock_to_leave + BESIDE),
        lead_radius: t.lead_radius,
        start: t.start.map(DVec2::from_array),
        overlap: Some(t.overlap.unwrap_or(OVERLAP)),
        retract_z: safe,
        approach_z: (of.top + CLEARANCE).clamp(f64::NEG_INFINITY, safe),
        ..ContourSpec::new(of.outline.clone(), chamfer.depth(), cutter, of.feed)
    }
}

/// An error of the planner with the cures of a chamfer.
fn in_its_words(error: Error, spec: &ContourSpec) -> Error {
    let key = error.0.key.clone().unwrap_or_default();
    match error.code() {
        Code::CUTTER_TOO_LARGE if key == "tool" => {
            let Error(finding) = error;
            let help = "write a smaller tip_clearance, or leave the loop out: loops = \"outer\", or by layer";
            finding.help(help).key("tip_clearance").into()
        }
        Code::LEAD_ROOM => {
            let wide = crate::page::trimmed(2.0 * spec.room.unwrap_or(0.0), 2);
            let Error(finding) = error;
            let help = format!(
                "the cutter is {wide} mm wide at the edge and comes down beside it: give another start, a smaller tip_clearance or width"
            );
            finding.help(help).into()
        }
        _ => error,
    }
}

impl kind::Plan for PlannedChamfer {
    type Json = ChamferJson;

    const LIST: &'static str = "chamfers";

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        write_moves(pen, &self.plan.moves, self.of.milling.coolant, None);
        Ok(())
    }

    fn walls(&self) -> Vec<WantedWall> {
        let (spec, chamfer) = (&self.spec, &self.of.chamfer);
        let keeps_face = spec.side == ContourSide::Outside;
        let band = Band::new(&self.cut_outline(), keeps_face, spec.stock_to_leave, spec.cutter.diameter);
        let mut band = band.leaning(Slope {
            top: spec.top,
            width: chamfer.width,
            lean: chamfer.half_angle.tan(),
            tip: spec.bottom(),
        });
        band.corners = uncut::fillets(&self.plan.uncut, spec.radius());
        vec![WantedWall {
            centre: band.middle,
            top: spec.top,
            floor: None,
            bottom: spec.top - chamfer.leg(),
            slug: 0.0,
            wall: Wall::Band(Arc::new(band)),
        }]
    }

    fn judge(&mut self, name: &str, _posted: &PostedPlan<'_>, _found: &Found<'_>) -> Judged {
        let webs = self.webs().in_words();
        let mut left = if webs.is_empty() { Vec::new() } else { vec![webs] };
        // The wall of the operation to which it refers is compared there.
        if self.of.table.of.is_none() {
            left.push(
                "the wall below it, which is compared where an operation of the job cuts it".to_owned(),
            );
        }
        let unchecked = (!left.is_empty()).then(|| format!("{name}: {}", left.join("; ")));
        Judged { unchecked, ..Judged::default() }
    }

    fn sections(all: &[(&PlannedChamfer, &Shown<'_>)]) -> Vec<Section> {
        all.iter().map(|(plan, shown)| section(plan, shown)).collect()
    }

    fn json(&self, shown: &Shown<'_>) -> Option<ChamferJson> {
        Some(ChamferJson::new(self, shown.number))
    }
}

impl PlannedChamfer {
    /// Edges that keep a web.
    pub(super) fn webs(&self) -> Webs {
        Webs::of(&self.plan.uncut)
    }

    /// The loops of the outline whose edges are chamfered, as an outline.
    fn cut_outline(&self) -> crate::geom::Outline {
        let wanted = |outer: bool| match self.spec.loops {
            ContourLoops::All => true,
            ContourLoops::Outer => outer,
            ContourLoops::Inner => !outer,
        };
        self.of.outline.with_loops(|l| wanted(l.outer))
    }
}
