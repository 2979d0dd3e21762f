//! A planned elliptic pocket: its table in the planner's words, its moves, its wall, its section of the report.

use std::sync::Arc;

use super::EllipseOperation;
use crate::base::Result;
use crate::holes::{BoreSpec, CutterData, EllipsePlan, EllipseSpec, Finish, Rough, plan_ellipse};
use crate::operations::kind::{self, Attempt, Nothing};
use crate::operations::wall::{CLEARANCE, ShownWall, sections, write_moves};
use crate::operations::wanted::{Wall, WantedWall};
use crate::operations::{Pen, Setting, Shown};
use crate::page::Section;

/// A planned elliptic pocket.
#[derive(Clone, Debug)]
pub struct PlannedEllipse {
    /// The operation.
    pub of: Arc<EllipseOperation>,
    /// The plan.
    pub plan: EllipsePlan,
}

/// Plans a pocket.
pub(super) fn planned(of: &Arc<EllipseOperation>, setting: &Setting<'_>) -> Result<Attempt<PlannedEllipse>> {
    let plan = plan_ellipse(&spec(setting, of))?;
    Ok(Attempt::SetupPlan(PlannedEllipse { of: Arc::clone(of), plan }, Vec::new()))
}

/// The pocket operation in the planner's words.
fn spec(setting: &Setting<'_>, pocket: &EllipseOperation) -> EllipseSpec {
    let t = &pocket.table;
    EllipseSpec {
        half_axes: t.half_axes,
        turned: t.angle.to_radians(),
        order: t.contact.order(),
        bore: BoreSpec {
            centre: t.at,
            top: t.top,
            breakthrough: (t.breakthrough > 0.0).then_some(t.breakthrough),
            stock_to_leave: [t.stock_to_leave, t.stock_to_leave_floor],
            sense: t.direction,
            entry: t.entry,
            // Always from the centre.
            rough: Some(Rough { start: None, ..t.rough }),
            finish: t.finish.as_ref().map(|f| Finish {
                spring_passes: f.spring_passes,
                stepdown: f.stepdown,
                ..Finish::new(f.feed)
            }),
            retract_z: setting.clamping.safe_height,
            approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, setting.clamping.safe_height),
            ..BoreSpec::new(
                2.0 * t.half_axes[0].min(t.half_axes[1]),
                t.depth,
                CutterData::of(&pocket.milling.tool),
            )
        },
    }
}

impl kind::Plan for PlannedEllipse {
    type Json = Nothing;

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        write_moves(pen, &self.plan.moves, self.of.milling.coolant, None);
        Ok(())
    }

    fn breakthrough(&self) -> f64 {
        self.of.table.breakthrough
    }

    fn walls(&self) -> Vec<WantedWall> {
        let (t, tool) = (&self.of.table, &self.of.milling.tool);
        let bottom = t.top - t.depth;
        let leave = t.stock_to_leave + if t.finish.is_some() { 0.0 } else { t.rough.allowance };
        let through = t.breakthrough > 0.0;
        let wall = WantedWall {
            centre: t.at.into(),
            wall: Wall::Ellipse { half_axes: t.half_axes, turned: t.angle.to_radians(), leave },
            top: t.top,
            floor: (!through).then_some(bottom + t.stock_to_leave_floor),
            bottom: if through { bottom } else { bottom + t.stock_to_leave_floor },
            slug: 0.0,
        };
        wall.fits(tool.cutter.diameter(tool.flute_length)).into_iter().collect()
    }

    fn sections(all: &[(&PlannedEllipse, &Shown<'_>)]) -> Vec<Section> {
        let one = |(pocket, of): &(&PlannedEllipse, &Shown<'_>)| {
            let t = &pocket.of.table;
            let shown = ShownWall {
                milling: &pocket.of.milling,
                at: t.at,
                plan: None,
                entry: t.entry,
                step: None,
                roughed: None,
                is_round: false,
            };
            shown.section(of)
        };
        sections(all.iter().map(one).collect())
    }
}
