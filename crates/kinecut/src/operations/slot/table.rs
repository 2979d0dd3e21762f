//! Milling of a slot as written in the job file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::holes::{FeedAt, Sense};
use crate::operations::contour::ContourFinishTable;
use crate::operations::pocket::{PocketEntryTable, PocketTable};
use crate::operations::slot_outline::{OutlineSlot, SlotArc};
use crate::operations::{CalledTool, PlaneTable};
use crate::program::Coolant;

/// Milling of a slot: a line or an arc of a width, with round ends. An end beyond the stock is open.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SlotTable {
    /// Name by which a chamfer refers to it: `of`.
    #[serde(default)]
    pub name: Option<String>,
    /// A tilted plane of the work: the tool is along its Z; default: along the Z of the work offset. Needs a machine
    /// with rotary axes.
    #[serde(default)]
    pub plane: Option<PlaneTable>,
    /// The tool, one with a cylindrical edge: its number, or its name.
    #[schemars(example = 1)]
    pub tool: CalledTool,
    /// Centres of its two round ends, in coordinates of the work offset; or give `arc`.
    #[serde(default)]
    pub line: Option<[[f64; 2]; 2]>,
    /// Its centre line as an arc between the centres of its ends.
    #[serde(default)]
    pub arc: Option<SlotArc>,
    /// Its width, that of the cutter or more.
    #[schemars(example = 12)]
    pub width: f64,
    /// Height of the material's upper face, in coordinates of the work offset; default 0.
    #[serde(default)]
    pub top: f64,
    /// Depth below it.
    #[schemars(example = 8)]
    pub depth: f64,
    /// Depth that the tool goes below `depth`, for a cut that goes through; default 0.
    #[serde(default)]
    pub breakthrough: f64,
    /// Largest depth of a level; default: the length of the flutes, half the cutter's diameter in a slot as wide as the cutter.
    #[serde(default, alias = "axial_step")]
    pub stepdown: Option<f64>,
    /// Stock to leave on the wall when all is done; default 0.
    #[serde(default, alias = "leave")]
    pub stock_to_leave: f64,
    /// Largest allowed deviation of the wall and the floor; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Climb or conventional milling; default climb.
    #[serde(default)]
    pub direction: Sense,
    /// Largest angle of the cutter's circle that cuts, degrees, between 5 and 120; default 60. 180 for a slot hardly wider than the cutter, up to a twentieth of its diameter: no room for loops.
    #[serde(default)]
    pub engagement: Option<f64>,
    /// The way down where no end is open and no hole is there.
    #[serde(default)]
    pub entry: Option<PocketEntryTable>,
    /// Radius of the arcs on which the wall is joined and left; default: half the cutter's radius, 1 at least, smaller where
    /// there is no room.
    #[serde(default)]
    pub lead_radius: Option<f64>,
    /// Spindle speed, rev/min; or give `cutting_speed`.
    #[serde(default)]
    #[schemars(example = 3800)]
    pub speed: Option<f64>,
    /// Cutting speed, m/min.
    #[serde(default)]
    #[schemars(example = 120)]
    pub cutting_speed: Option<f64>,
    /// Feed of the loops or passes, and along the wall, mm/min; or give `feed_per_tooth`.
    #[serde(default)]
    #[schemars(example = 600)]
    pub feed: Option<f64>,
    /// Feed per tooth.
    #[serde(default)]
    #[schemars(example = 0.05)]
    pub feed_per_tooth: Option<f64>,
    /// Feed straight down, along the helix and the ramp, mm/min; default: half the feed.
    #[serde(default)]
    pub plunge_feed: Option<f64>,
    /// Feed of the way back in a loop, mm/min; default: twice the feed.
    #[serde(default)]
    pub link_feed: Option<f64>,
    /// Whether the feeds along the wall are those of the cutter's centre or those of its edge at the wall; default centre.
    #[serde(default)]
    pub feed_at: FeedAt,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
    /// Finishing of the wall after all levels; left out, a lap along it on each level cuts it to size.
    #[serde(default)]
    pub finish: Option<ContourFinishTable>,
}

impl SlotTable {
    /// The slot as an outline.
    pub(super) fn slot(&self) -> OutlineSlot {
        OutlineSlot { line: self.line, arc: self.arc, width: self.width }
    }

    /// All other keys, as those of a pocket.
    pub(super) fn pocket(&self) -> PocketTable {
        let t = self.clone();
        PocketTable {
            name: t.name,
            rest: None,
            plane: t.plane,
            tool: t.tool,
            top: t.top,
            depth: t.depth,
            breakthrough: t.breakthrough,
            stepdown: t.stepdown,
            stock_to_leave: t.stock_to_leave,
            tolerance: t.tolerance,
            direction: t.direction,
            engagement: t.engagement,
            entry: t.entry,
            lead_radius: t.lead_radius,
            speed: t.speed,
            cutting_speed: t.cutting_speed,
            feed: t.feed,
            feed_per_tooth: t.feed_per_tooth,
            plunge_feed: t.plunge_feed,
            link_feed: t.link_feed,
            feed_at: t.feed_at,
            coolant: t.coolant,
            finish: t.finish,
            rectangle: None,
            circle: None,
            polygon: None,
            slot: Some(self.slot()),
            outline: None,
            unit: None,
            layers: None,
            snap: None,
            section: None,
            edge_at: None,
            at: [0.0; 2],
            angle: 0.0,
            lift: None,
        }
    }
}
