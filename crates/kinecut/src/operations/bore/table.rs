//! Milling of a bore as written in the job file, and checked; the numbers of its table are left to the planner.

use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::PlannedBore;
use super::plan::planned;
use crate::base::Result;
use crate::holes::{Entry, Rough, Sense, Strategy};
use crate::operations::kind::{self, Attempt};
use crate::operations::wall::FinishTable;
use crate::operations::wanted::PlannedOutline;
use crate::operations::{Around, CalledTool, Milling, PlaneTable, Setting, milling};
use crate::program::Coolant;

/// Milling of a bore.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoreTable {
    /// A tilted plane of the work: the tool is along its Z; default: along the Z of the work offset. Needs a machine
    /// with rotary axes.
    #[serde(default)]
    pub plane: Option<PlaneTable>,
    /// The tool: its number, or its name.
    #[schemars(example = 1)]
    pub tool: CalledTool,
    /// Centre, in coordinates of the work offset.
    #[schemars(example = vec![0, 0])]
    pub at: [f64; 2],
    /// Height of the upper rim, in coordinates of the work offset; default 0.
    #[serde(default)]
    pub top: f64,
    /// Diameter of the finished bore; of a conical one at its rim.
    #[schemars(example = 40)]
    pub diameter: f64,
    /// Diameter at the depth, for a bore that narrows downwards; it is milled in steps, level by level.
    #[serde(default)]
    pub bottom_diameter: Option<f64>,
    /// Stock to leave on the wall when all is done; default 0.
    #[serde(default, alias = "leave")]
    pub stock_to_leave: f64,
    /// Stock to leave on the floor of a blind bore; default 0.
    #[serde(default, alias = "leave_floor")]
    pub stock_to_leave_floor: f64,
    /// Depth below the rim.
    #[schemars(example = 8)]
    pub depth: f64,
    /// Depth that the tool goes below the bore's depth, for a bore that goes through; default 0.
    #[serde(default)]
    pub breakthrough: f64,
    /// Largest allowed deviation of the bore's radius and floor; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Path of the cutter.
    pub strategy: Strategy,
    /// Climb or conventional milling; default climb.
    #[serde(default)]
    pub direction: Sense,
    /// The cutter's way down; default: a helix that leaves no core.
    #[serde(default)]
    pub entry: Option<Entry>,
    /// Spindle speed, rev/min.
    #[schemars(example = 3800)]
    pub speed: f64,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
    /// Roughing; left out, only the wall is finished.
    #[serde(default)]
    pub rough: Option<Rough>,
    /// Finishing; left out, the allowance stays.
    #[serde(default)]
    pub finish: Option<FinishTable>,
}

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

    fn spring_passes(&self) -> u32 {
        self.table.finish.as_ref().map_or(0, |f| f.spring_passes)
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
        let milling = milling(&self.tool, self.speed, self.coolant, self.tolerance, around.tools)?;
        Ok(BoreOperation { milling, table: self.clone() })
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }
}
