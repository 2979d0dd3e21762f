//! Milling of an elliptic pocket as written in the job file, and checked; the numbers of its table are left to the planner.

use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::PlannedEllipse;
use super::plan::planned;
use crate::base::Result;
use crate::base::unit::MmPerMin;
use crate::holes::{Entry, Rough, Sense};
use crate::operations::kind::{self, Attempt};
use crate::operations::wall::ContactName;
use crate::operations::wanted::PlannedOutline;
use crate::operations::{Around, CalledTool, Milling, PlaneTable, Setting, milling};
use crate::program::Coolant;

/// Milling of an elliptic pocket: a spiral that grows from a circle into the ellipse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EllipseTable {
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
    /// Half axes of the finished pocket.
    #[schemars(example = vec![30, 20])]
    pub half_axes: [f64; 2],
    /// Direction of the first half axis from X, degrees; default 0.
    #[serde(default)]
    pub angle: f64,
    /// Depth below the rim.
    #[schemars(example = 8)]
    pub depth: f64,
    /// Depth that the tool goes below the pocket's depth, for a pocket that goes through; default 0.
    #[serde(default)]
    pub breakthrough: f64,
    /// Stock to leave on the wall when all is done; default 0.
    #[serde(default, alias = "leave")]
    pub stock_to_leave: f64,
    /// Stock to leave on the floor; default 0.
    #[serde(default, alias = "leave_floor")]
    pub stock_to_leave_floor: f64,
    /// Largest allowed deviation of wall and floor; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Contact of the spiral with the wall; default G4.
    #[serde(default = "fourth")]
    pub contact: ContactName,
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
    /// Roughing.
    pub rough: Rough,
    /// Finishing; left out, the allowance stays.
    #[serde(default)]
    pub finish: Option<EllipseFinishTable>,
}

fn fourth() -> ContactName {
    ContactName::G4
}

/// Finishing of an elliptic pocket.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EllipseFinishTable {
    /// Feed; mm/min in a file.
    #[serde(with = "MmPerMin")]
    #[schemars(example = 500)]
    pub feed: f64,
    /// Further laps at the wall without infeed; default 0.
    #[serde(default)]
    pub spring_passes: u32,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default, alias = "axial_step")]
    pub stepdown: Option<f64>,
}

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

    fn spring_passes(&self) -> u32 {
        self.table.finish.as_ref().map_or(0, |f| f.spring_passes)
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
        let milling = milling(&self.tool, self.speed, self.coolant, self.tolerance, around.tools)?;
        Ok(EllipseOperation { milling, table: self.clone() })
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }
}
