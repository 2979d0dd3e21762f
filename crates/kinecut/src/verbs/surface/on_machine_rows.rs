//! Answers of a machine to a surface, as rows in micrometres.

use glam::DVec3;
use serde::Serialize;

use crate::base::Finding;
use crate::machine::generation::{Coverage, SurfaceBudget, micro};

/// Measure of the nearness of machines, in a sentence.
pub(crate) const NEARNESS: &str = "nearest by changes of the code (an axis or the bed more, less, another, or exchanged with its neighbour), \
     then by the number of axes and the mass that they move";

/// Limits of the figures, in sentences.
pub(crate) const NOT_VERIFIED: [&str; 4] = [
    "the axes follow their laws exactly, and the tool has no errors of its own: the budget says what errors of the axes do",
    "errors of the spindle and of the tool, deflection, heat and wear are not in it",
    "the tool's body beside its edge, its holder and the way in and out are not compared with the part",
    "touching and rolling: the motion counts as continuous; the marks of single teeth and strokes are not in it",
];

/// Distance of the generated surface from the wanted one: positive is stock that stays, negative a gouge.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ResidualRow {
    /// The lowest place [um].
    pub least_um: f64,
    /// The highest place [um].
    pub greatest_um: f64,
    /// Root mean square [um].
    pub rms_um: f64,
    /// The place farthest off, in coordinates of the surface [mm].
    pub at: [f64; 3],
}

impl ResidualRow {
    /// From lengths in millimetres.
    pub(crate) fn of(least: f64, greatest: f64, rms: f64, at: DVec3) -> ResidualRow {
        ResidualRow {
            least_um: micro(least),
            greatest_um: micro(greatest),
            rms_um: micro(rms),
            at: at.to_array(),
        }
    }
}

/// A machine that could.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AlternativeRow {
    /// Its code.
    pub code: String,
    /// Number of changes of the code.
    pub distance: usize,
    /// Changes of the code, in words.
    pub changes: Vec<String>,
    /// Laws of its axes.
    pub laws: Vec<String>,
}

/// The nearest machines that could.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NearestRow {
    /// Layouts that were looked at.
    pub layouts: usize,
    /// Classes of them that position alike.
    pub classes: usize,
    /// The nearest ones that can; none if none can.
    pub machines: Vec<AlternativeRow>,
}

/// A way in which a machine makes a surface: its laws, and how good the result is.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct HowMade {
    /// Whether it can.
    pub possible: bool,
    /// Laws of its axes: settings, forming, linked.
    pub laws: Vec<String>,
    /// Surface that is generated, or left by the tool, against the wanted one.
    pub residual: Option<ResidualRow>,
    /// Part of the wanted surface that is reached.
    pub coverage: Option<Coverage>,
    /// Effect of errors of the axes.
    pub budget: Option<SurfaceBudget>,
}

/// A redistribution on a machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MadeRow {
    /// Code of the machine's part.
    pub machine_code: String,
    /// Code of the tool's part.
    pub tool_code: String,
    /// Name of the process in the trade.
    pub process: String,
    /// Whether and how the machine makes it.
    #[serde(flatten)]
    pub made: HowMade,
    /// Why not.
    pub obstacle: Option<Finding>,
    /// Machines that could, where they were asked for.
    pub nearest: Option<NearestRow>,
}

/// A surface made by a tool that touches or rolls, on a machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EnvelopedRow {
    /// Name of the process.
    pub process: String,
    /// "touching" or "rolling".
    pub method: &'static str,
    /// Kind of tool.
    pub tool: String,
    /// Whether and how the machine makes it.
    #[serde(flatten)]
    pub made: HowMade,
    /// Why the result is not verified.
    pub unverified: Option<Finding>,
    /// Why the machine cannot.
    pub obstacle: Option<Finding>,
}

impl NearestRow {
    /// As sentences, one machine each.
    pub fn sentences(&self) -> Vec<String> {
        if self.machines.is_empty() {
            return vec![format!(
                "none of {} layouts of two to five axes can ({} classes)",
                self.layouts, self.classes
            )];
        }
        let one = |a: &AlternativeRow| {
            let changes = if a.distance == 1 { "change" } else { "changes" };
            format!("{} could, {} {changes}: {}", a.code, a.distance, a.changes.join(", "))
        };
        self.machines.iter().map(one).collect()
    }
}

/// A surface on a machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OnMachine {
    /// Name of the machine.
    pub machine: String,
    /// Its code.
    pub code: String,
    /// Largest deviation that counts as reached [um].
    pub tolerance_um: f64,
    /// Errors of the axes for the budgets.
    pub errors: String,
    /// Its answers to the redistributions: traced and copied lines.
    pub splits: Vec<MadeRow>,
    /// Its answers to the known envelopes: touching and rolling.
    pub envelopes: Vec<EnvelopedRow>,
}

impl OnMachine {
    /// Whether the machine can make the surface in some way.
    pub fn is_possible(&self) -> bool {
        self.splits.iter().any(|s| s.made.possible) || self.envelopes.iter().any(|e| e.made.possible)
    }
}
