//! Milling of an elliptic pocket, checked; the numbers of its table are left to the planner.

use std::sync::Arc;

use super::plan::planned;
use super::{EllipseTable, PlannedEllipse};
use crate::base::Result;
use crate::operations::kind::{self, Attempt};
use crate::operations::wanted::PlannedOutline;
use crate::operations::{Around, Milling, PlaneTable, Setting, milling};

/// Milling of an elliptic pocket.
#[derive(Clone, Debug)]
pub struct EllipseOperation {
    /// As written: the planner's own checks work on it.
    pub table: EllipseTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
}

impl kind::Checked for EllipseOperation {
    type Plan = PlannedEllipse;

    const NOUN: &'static str = "pocket";

    fn milling(&self) -> &Milling {
        &self.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.milling
    }

    fn name(&self) -> String {
        let t = &self.table;
        let [a, b] = t.half_axes;
        format!("elliptic pocket {} x {} at X{} Y{}", 2.0 * a, 2.0 * b, t.at[0], t.at[1])
    }

    fn outline(&self) -> Option<PlannedOutline> {
        let t = &self.table;
        let angle = t.angle.to_radians();
        let (half_axes, top, depth) = (t.half_axes, t.top, t.depth);
        Some(PlannedOutline { centre: t.at.into(), half_axes, angle, top, depth })
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedEllipse>> {
        planned(self, setting)
    }
}

impl kind::Table for EllipseTable {
    type Of = EllipseOperation;

    fn check(&self, around: &Around<'_>) -> Result<EllipseOperation> {
        let milling = milling(self.tool, self.speed, self.coolant, self.tolerance, around.tools)?;
        Ok(EllipseOperation { milling, table: self.clone() })
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }
}
