//! What a machine answers to a surface, as rows in micrometres.

use glam::DVec3;
use serde::Serialize;

use crate::base::Finding;
use crate::machine::generation::{Coverage, Sensitivity};

/// Micrometres in a millimetre.
const MICRO: f64 = 1e3;
/// Picometres are below what any of this means [1/um].
const FINEST: f64 = 1e6;

/// Rounded to what means something; adding zero makes -0 to 0.
fn micro(mm: f64) -> f64 {
    (mm * MICRO * FINEST).round() / FINEST + 0.0
}

/// How nearness of machines is measured, in a sentence.
pub(crate) const NEARNESS: &str = "nearest by changes of the code (an axis or the bed more, less, another, or exchanged with its neighbour), \
     then by the number of axes and the mass that they move";

/// What the figures do not hold, in sentences.
pub(crate) const NOT_VERIFIED: [&str; 4] = [
    "the axes follow their laws exactly, and the tool has no errors of its own: the budget says what errors of the axes do",
    "errors of the spindle and of the tool, deflection, heat and wear are not in it",
    "the tool's body beside its edge, its holder and the way in and out are not compared with the part",
    "touching and rolling: the motion counts as continuous; the marks of single teeth and strokes are not in it",
];

/// How far what is generated is from what is wanted: positive is stock that stays, negative a gouge.
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

/// What of the wanted surface is reached.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CoverageRow {
    /// Share of its area, from 0 to 1.
    pub share: f64,
    /// Its area [mm2].
    pub area_mm2: f64,
    /// Area of the largest patch that is not reached [mm2].
    pub gap_mm2: Option<f64>,
    /// The place of that patch farthest from what is reached [mm].
    pub gap_at: Option<[f64; 3]>,
}

impl CoverageRow {
    pub(crate) fn of(coverage: &Coverage) -> CoverageRow {
        CoverageRow {
            share: coverage.share,
            area_mm2: coverage.area,
            gap_mm2: coverage.largest_gap.map(|gap| gap.area),
            gap_at: coverage.largest_gap.map(|gap| gap.point.to_array()),
        }
    }
}

/// What the errors of an axis do to the surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxisEffectRow {
    /// Address of the axis.
    pub axis: char,
    /// By its error of position, along the normal, where that is greatest [um].
    pub position_um: f64,
    /// By its six errors as independent ones, where that is greatest [um].
    pub guide_um: f64,
}

/// An error budget.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BudgetRow {
    /// Each axis, in the order of the code.
    pub axes: Vec<AxisEffectRow>,
    /// All errors as independent ones [um].
    pub independent_um: f64,
    /// All errors at their bounds with the worst signs [um].
    pub worst_um: f64,
    /// The place of the worst, in coordinates of the surface [mm].
    pub at: [f64; 3],
}

impl BudgetRow {
    pub(crate) fn of(found: &Sensitivity) -> BudgetRow {
        let axes = found.axes.iter().map(|a| AxisEffectRow {
            axis: a.letter,
            position_um: micro(a.position),
            guide_um: micro(a.guide),
        });
        BudgetRow {
            axes: axes.collect(),
            independent_um: micro(found.independent),
            worst_um: micro(found.worst),
            at: found.at.to_array(),
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
    /// What is more and what less.
    pub changes: Vec<String>,
    /// How it does it.
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

/// A redistribution on a machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MadeRow {
    /// Code of the machine's part.
    pub machine_code: String,
    /// Code of the tool's part.
    pub tool_code: String,
    /// What the trade calls it.
    pub process: String,
    /// Whether the machine can make it.
    pub possible: bool,
    /// Laws of its axes: settings, forming, linked.
    pub laws: Vec<String>,
    /// What is generated against what is wanted.
    pub residual: Option<ResidualRow>,
    /// What of the wanted surface is reached.
    pub coverage: Option<CoverageRow>,
    /// What errors of the axes do.
    pub budget: Option<BudgetRow>,
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
    /// What the tool is.
    pub tool: String,
    /// Whether the machine can make it.
    pub possible: bool,
    /// Laws of its axes.
    pub laws: Vec<String>,
    /// What the tool leaves against what is wanted.
    pub residual: Option<ResidualRow>,
    /// What of the wanted surface is reached.
    pub coverage: Option<CoverageRow>,
    /// What errors of the axes do.
    pub budget: Option<BudgetRow>,
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
    /// What counts as reached [um].
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
        self.splits.iter().any(|s| s.possible) || self.envelopes.iter().any(|e| e.possible)
    }
}
