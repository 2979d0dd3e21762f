//! Milling of a bore, checked; the numbers of its table are left to the planner.

use std::sync::Arc;

use super::plan::planned;
use super::{BoreTable, PlannedBore};
use crate::base::Result;
use crate::operations::kind::{self, Attempt};
use crate::operations::wanted::PlannedOutline;
use crate::operations::{Around, Milling, PlaneTable, Setting, milling};

/// Milling of a bore.
#[derive(Clone, Debug)]
pub struct BoreOperation {
    /// As written: the planner's own checks work on it.
    pub table: BoreTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
}

impl kind::Checked for BoreOperation {
    type Plan = PlannedBore;

    const NOUN: &'static str = "bore";

    fn milling(&self) -> &Milling {
        &self.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.milling
    }

    fn name(&self) -> String {
        let t = &self.table;
        format!("bore {} at X{} Y{}", t.diameter, t.at[0], t.at[1])
    }

    fn outline(&self) -> Option<PlannedOutline> {
        let t = &self.table;
        let half_axes = [0.5 * t.diameter; 2];
        Some(PlannedOutline { centre: t.at.into(), half_axes, angle: 0.0, top: t.top, depth: t.depth })
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedBore>> {
        planned(self, setting)
    }
}

impl kind::Table for BoreTable {
    type Of = BoreOperation;

    fn check(&self, around: &Around<'_>) -> Result<BoreOperation> {
        let milling = milling(self.tool, self.speed, self.coolant, self.tolerance, around.tools)?;
        Ok(BoreOperation { milling, table: self.clone() })
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }
}
