//! Thread milling as written in the job file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::holes::Sense;
use crate::operations::core_hole::CoreTable;
use crate::operations::places::PatternTable;
use crate::operations::{CalledTool, PlaneTable};
use crate::program::Coolant;
use crate::threading::{MillProfile, ThreadForm, ThreadSide};
use crate::tool::Hand;

/// Milling of threads with a thread mill, in core holes or on bosses that are there.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThreadMillTable {
    /// A tilted plane of the work: the tool is along its Z; default: along the Z of the work offset. Needs a machine
    /// with rotary axes.
    #[serde(default)]
    pub plane: Option<PlaneTable>,
    /// The tool, a thread mill of the thread's pitch: its number, or its name.
    #[schemars(example = 1)]
    pub tool: CalledTool,
    /// Places of the threads' axes, in coordinates of the work offset.
    #[serde(default)]
    pub points: Option<Vec<[f64; 2]>>,
    /// Places of the threads as a pattern.
    #[serde(default)]
    pub pattern: Option<PatternTable>,
    /// Size of a metric thread: "M8" with the coarse pitch of ISO 261, "M20x1.5"; or give `diameter` and `pitch`.
    #[serde(default)]
    pub size: Option<String>,
    /// Major diameter of the thread; of a taper thread at `top`.
    #[serde(default)]
    pub diameter: Option<f64>,
    /// Pitch of the thread.
    #[serde(default)]
    pub pitch: Option<f64>,
    /// Profile of the thread: "metric" (60 degrees, also UN), "whitworth" (55), "npt" (60, 1 in 16); default "metric".
    #[serde(default)]
    pub form: ThreadForm,
    /// Hand of the thread; default "right".
    #[serde(default)]
    pub hand: Hand,
    /// Taper as 1 in so much on the diameter, no unit: 16 for NPT and R; default: of "npt" 16, else none.
    #[serde(default)]
    pub taper: Option<f64>,
    /// Added to the thread's diameters, half of its tolerance for one in the middle of it; negative for a smaller bolt;
    /// default 0.
    #[serde(default)]
    pub oversize: f64,
    /// Whether the thread is "inside", in a hole, or "outside", on a boss; default "inside".
    #[serde(default)]
    pub side: ThreadSide,
    /// Profile of the tool's teeth: "standard", for which the path is corrected, or "corrected" by the maker for this thread;
    /// default "standard".
    #[serde(default)]
    pub profile: MillProfile,
    /// Climb or conventional milling; default climb.
    #[serde(default)]
    pub direction: Sense,
    /// Height at which the thread begins, in coordinates of the work offset; default 0.
    #[serde(default)]
    pub top: f64,
    /// Depth of full thread below `top`; the lowest tooth and the way in or out go deeper by three quarters of a pitch.
    /// Default: through the stock.
    #[serde(default)]
    pub depth: Option<f64>,
    /// The core holes, where neither an operation before nor `drilled` says them.
    #[serde(default)]
    pub core: Option<CoreTable>,
    /// Radial passes as shares of the thread's depth, ascending to 1; default [1.0].
    #[serde(default)]
    pub infeed: Option<Vec<f64>>,
    /// Further passes at full depth; default 0.
    #[serde(default)]
    pub spring_passes: u32,
    /// Register of the control by whose value the thread is moved at the machine: "D2".
    #[serde(default)]
    pub wear_offset: Option<String>,
    /// Largest value, of either sign, that the register may get; default 0.05.
    #[serde(default)]
    pub wear_largest: Option<f64>,
    /// Value of the register with which the program is simulated; default 0.
    #[serde(default)]
    pub wear_value: Option<f64>,
    /// Largest allowed deviation of the pitch diameter in the text, and of the wall of the crests; default 0.01.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Spindle speed, rev/min; or give `cutting_speed`.
    #[serde(default)]
    #[schemars(example = 3800)]
    pub speed: Option<f64>,
    /// Cutting speed at the crests of the teeth, m/min.
    #[serde(default)]
    #[schemars(example = 120)]
    pub cutting_speed: Option<f64>,
    /// Feed of the edge at the major diameter, mm/min; that of the centre follows in each radial pass. Or give `feed_per_tooth`.
    #[serde(default)]
    #[schemars(example = 600)]
    pub feed: Option<f64>,
    /// Feed per tooth at the major diameter.
    #[serde(default)]
    #[schemars(example = 0.05)]
    pub feed_per_tooth: Option<f64>,
    /// Height of the moves between threads, above `top`, in coordinates of the work offset; default: the setup's safe height.
    #[serde(default)]
    pub clearance: Option<f64>,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: Coolant,
}
