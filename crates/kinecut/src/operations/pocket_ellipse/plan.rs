//! A planned elliptic pocket: its moves, its wall, its section of the report.

use std::sync::Arc;

use super::EllipseOperation;
use super::spec::spec;
use crate::base::Result;
use crate::holes::{EllipsePlan, plan_ellipse};
use crate::operations::kind::{self, Attempt, Nothing};
use crate::operations::wall::{ShownWall, sections, write_moves};
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
