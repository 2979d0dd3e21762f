//! A planned face: its moves, its proof, its part of report and plan.

use glam::{DMat3, DVec3};
use serde::Serialize;

use super::moves::write_face;
use super::prove::{judged, simulated_face};
use super::section::sections;
use super::{FaceJson, PlannedFace};
use crate::base::Result;
use crate::facing::burrs::MilledEdges;
use crate::geom::Rigid;
use crate::operations::edge::FaceEdges;
use crate::operations::kind::Checked as _;
use crate::operations::wanted::WantedPlane;
use crate::operations::{Found, Judged, MadePlane, Pen, PostedPlan, Probes, Setting, Shown, kind};
use crate::page::Section;
use crate::program::{Frame, Setup};

impl kind::Plan for PlannedFace {
    type Json = PlannedFaceJson;

    const LIST: &'static str = "faces";

    /// Turns the part about the work zero.
    fn turn_part(&self, setting: &Setting<'_>, setup: &mut Setup) {
        if self.part_turned == 0.0 {
            return;
        }
        let work = setting.clamping.work();
        let turn = Rigid { rotation: DMat3::from_rotation_z(self.part_turned), translation: DVec3::ZERO };
        setup.part_on_table = work.after(&turn).after(&work.inverse()).after(&setup.part_on_table);
    }

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        self.first_item = pen.program.items.len() as u32;
        if self.part_turned != 0.0 {
            let turned = self.part_turned.to_degrees();
            let sense = if turned < 0.0 { "CLOCKWISE" } else { "COUNTERCLOCKWISE" };
            pen.text(format!("PART TURNED BY {:.3} DEG {sense} ABOUT THE WORK ZERO", turned.abs()));
        }
        let plain = pen.state.frame;
        if self.coordinates_turned != 0.0 {
            let rotation = DMat3::from_rotation_z(self.coordinates_turned);
            let motion = Rigid { rotation, translation: DVec3::ZERO };
            pen.state.frame = pen.program.add_frame(Frame::Shift { parent: plain, motion });
        }
        write_face(pen, &self.of, &self.programmed_path())?;
        pen.state.frame = plain;
        Ok(())
    }

    fn milled(&self) -> Option<FaceEdges> {
        let edges =
            MilledEdges { case: self.of.case.clone(), path: self.path(), left_hand: self.plan.left_hand };
        Some(FaceEdges {
            operation: self.operation,
            name: self.of.name(),
            edges,
            rule: self.of.rule.clone(),
            psi_side: self.of.table.psi_side,
        })
    }

    fn made_plane(&self) -> Option<MadePlane> {
        let case = &self.of.case;
        Some(MadePlane::new(&case.outline, self.of.table.top, self.path(), case.radius))
    }

    fn plane(&self) -> Option<WantedPlane<'_>> {
        let (outline, top) = (&self.of.case.outline, self.of.table.top);
        Some(WantedPlane { outline, turned: self.part_turned, top })
    }

    fn probes(&self, posted: &PostedPlan<'_>, _most: usize) -> Probes {
        Probes { points: Vec::new(), walls: self.wall_probe(posted) }
    }

    fn judge(&mut self, name: &str, posted: &PostedPlan<'_>, found: &Found<'_>) -> Judged {
        let Some(probe) = found.probes.walls else { return Judged::default() };
        let simulated = simulated_face(self, posted, found.walls, found.step);
        let judged = judged(&simulated, name, probe.item, found.step);
        self.simulated = Some(simulated);
        judged
    }

    fn sections(all: &[(&PlannedFace, &Shown<'_>)]) -> Vec<Section> {
        sections(all)
    }

    fn json(&self, shown: &Shown<'_>) -> Option<PlannedFaceJson> {
        let simulated = self.simulated.as_ref().map(|m| Figures {
            bad: m.bad,
            matched: m.matched,
            strange: m.strange,
            missing: m.missing,
            differing: m.differing,
            largest_difference_deg: m.largest.to_degrees(),
            height: shown.plane.map(|f| f.height).filter(|h| h[0] <= h[1]),
        });
        Some(PlannedFaceJson { operation: shown.number, plan: self.plan_json(), simulated })
    }
}

/// A milled face, in coordinates of the work offset as the part lies when it is not turned.
#[derive(Debug, Serialize)]
pub(crate) struct PlannedFaceJson {
    operation: u32,
    /// As the sheet of `kinecut face`.
    plan: FaceJson,
    #[serde(skip_serializing_if = "Option::is_none")]
    simulated: Option<Figures>,
}

/// Measures of the simulated stock.
#[derive(Debug, Serialize)]
struct Figures {
    bad: f64,
    /// Length of the stock's walls at the outline, of others within it, and of edges that the stock does not have.
    matched: f64,
    strange: f64,
    missing: f64,
    /// Length on which the exit angle is not the plan's.
    differing: f64,
    largest_difference_deg: f64,
    /// Least and greatest height over the finished plane.
    height: Option<[f64; 2]>,
}
