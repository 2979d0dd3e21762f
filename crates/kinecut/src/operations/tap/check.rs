//! Tapping operations, checked.

use std::sync::Arc;

use super::TapTable;
use super::plan::{PlannedTapping, planned};
use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{Code, Finding, Result};
use crate::cutting::StartCut;
use crate::operations::kind::{self, Attempt};
use crate::operations::places::{HolePlace, places};
use crate::operations::thread_depth::thread_depth;
use crate::operations::{
    Around, CalledTool, CuttingKeys, Milling, PlaneTable, Setting, milling_of, spindle, tool_of,
    whole_revolutions,
};
use crate::tool::{Cutter, Hand, Tap};

/// Way above a thread on which the spindle comes to its speed, in pitches.
const RUN_UP: f64 = 3.0;
/// Rounding of a product of decimal numbers [mm].
const ROUNDING: f64 = 1e-9;

/// Tapping of one or many core holes.
#[derive(Clone, Debug)]
pub struct TapOperation {
    /// As written.
    pub table: TapTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
    /// Depth of full thread [mm].
    pub depth: f64,
    /// The thread of its tap.
    pub tap: Tap,
    /// The holes in the order of tapping.
    pub holes: Vec<HolePlace>,
    /// Height above the thread from which feed and spindle run together [mm].
    pub approach: f64,
}

impl TapOperation {
    /// Hand of the thread: that of the tap.
    pub fn hand(&self) -> Hand {
        self.milling.tool.limits.hand
    }

    /// Height of the lowest point of the tap at the bottom, in coordinates of the work offset [mm].
    pub fn bottom(&self) -> f64 {
        self.table.top - self.depth - self.tap.below_thread()
    }

    /// Height from which feed and spindle run together, in coordinates of the work offset [mm].
    pub fn reference(&self) -> f64 {
        self.table.top + self.approach
    }

    /// Name of the thread with its hand: "M8x1.25", "M8x1.25 left-hand".
    pub fn thread(&self) -> String {
        let hand = if self.hand() == Hand::Left { " left-hand" } else { "" };
        self.tap.name() + hand
    }
}

impl kind::Checked for TapOperation {
    type Plan = PlannedTapping;

    fn milling(&self) -> &Milling {
        &self.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.milling
    }

    fn name(&self) -> String {
        let thread = self.thread();
        match &self.holes[..] {
            [one] => format!("tap {thread} at X{} Y{}", one.at[0], one.at[1]),
            many => format!("tap {thread}, {} holes", many.len()),
        }
    }

    fn is_left_hand(&self) -> bool {
        self.hand() == Hand::Left
    }

    fn not_compared(&self) -> Option<&'static str> {
        Some("the thread that a tap makes")
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedTapping>> {
        planned(self, setting)
    }
}

impl kind::Table for TapTable {
    type Of = TapOperation;

    fn check(&self, around: &Around<'_>) -> Result<TapOperation> {
        operation(self, around)
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn data(&mut self) -> Option<CuttingKeys<'_>> {
        Some(CuttingKeys {
            speed: &mut self.speed,
            cutting_speed: &mut self.cutting_speed,
            feed: None,
            per_rev: None,
            cut: StartCut::Tap,
        })
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }
}

fn operation(t: &TapTable, around: &Around<'_>) -> Result<TapOperation> {
    if !around.control.has_rigid_tapping() {
        let title = around.control.title();
        let finding = Finding::error(
            Code::POST_CONTROL,
            format!("{title} has no synchronised spindle: tapping is refused"),
        );
        return Err(finding
            .help("type = \"thread-mill\" cuts this thread; or post for a control with rigid tapping, or tap by hand")
            .key("type").into());
    }
    let tool = tool_of(&t.tool, around.tools)?;
    let Cutter::Tap(tap) = tool.cutter else {
        let finding = Finding::error(Code::JOB_REFERENCE, format!("{} is no tap", tool.number));
        return Err(finding.help("give the tool type = \"tap\" and its pitch").key("tool").into());
    };
    let speed = spindle(t.speed, t.cutting_speed, ("tool", tap.diameter))?;
    length("top", t.top, -MAX_LENGTH, MAX_LENGTH)?;
    length("clearance", t.clearance.unwrap_or(0.0), -MAX_LENGTH, MAX_LENGTH)?;
    let depth = thread_depth(t.depth, t.top, t.plane.is_some(), around)?;
    let run_up = RUN_UP * tap.pitch;
    let approach = length("approach", t.approach.unwrap_or(run_up), 0.0, 1000.0)?;
    if approach < run_up - ROUNDING {
        let what = "the way above the thread is too short for the spindle to come to its speed";
        let finding = Finding::error(Code::JOB_VALUE, what).value_mm(approach).bound_mm(run_up);
        return Err(finding
            .help("leave `approach` out, or give at least three pitches")
            .key("approach")
            .into());
    }
    if let Some(core) = t.core {
        positive("core.diameter", core.diameter, MAX_LENGTH, "mm")?;
        positive("core.depth", core.depth.unwrap_or(1.0), MAX_LENGTH, "mm")?;
    }
    Ok(TapOperation {
        holes: places(t.points.as_deref(), t.pattern.as_ref())?,
        milling: milling_of(tool, whole_revolutions(speed), t.coolant, None)?,
        depth,
        tap,
        approach,
        table: t.clone(),
    })
}
