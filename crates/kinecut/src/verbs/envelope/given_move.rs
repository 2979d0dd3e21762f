//! A move with what is known of it.

use serde::Serialize;

use crate::geom::{Curve, CurveKind};
use crate::sweep::ToolMotion;
use crate::tool::Contour;

/// Source of a move.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum MoveSource {
    /// The way of the tip.
    #[serde(rename = "move")]
    Way,
    /// A pose and a twist.
    Screw,
    /// Positions of a machine's axes.
    #[serde(untagged)]
    Joints {
        /// Positions at the start, as words.
        from: String,
        /// The machine.
        machine: String,
        /// Positions at the end, as words.
        to: String,
    },
    /// A line of a program.
    #[serde(untagged)]
    Line {
        /// The block.
        block: String,
        /// Line, from 1.
        line: u32,
        /// Number of the move among those of the line, from 1.
        #[serde(rename = "move")]
        part: usize,
        /// Their number.
        of: usize,
        /// Name of the program.
        program: String,
    },
}

/// A motion with what is known of it.
pub(crate) struct GivenMove {
    pub(crate) motion: ToolMotion,
    /// Motion of the tip or the tool, in words.
    pub(crate) way: &'static str,
    /// Law of the positions between the ends, in words.
    pub(crate) mode: &'static str,
    pub(crate) source: MoveSource,
    pub(crate) tool: Option<(String, Contour)>,
}

/// The tool does not turn.
pub(super) const STANDS: &str = "the direction of the tool stands still";
/// Great circle.
pub(super) const GREAT_CIRCLE: &str = "control of the tool centre point; the direction turns on the great circle at a constant rate \
(interpolation of the tool vector)";
/// Rotary joints under control of the tip.
pub(super) const TIP_AND_JOINTS: &str =
    "control of the tool centre point; rotary axes go straight from position to position";
/// All joints.
pub(super) const JOINTS: &str =
    "all axes go straight from position to position (no control of the tool centre point)";

/// The way of the tip along a curve, in words.
pub(super) fn path_words(curve: &Curve) -> &'static str {
    match curve.kind() {
        CurveKind::Line(_) if curve.length() == 0.0 => "the tip stays",
        CurveKind::Line(_) => "the tip goes along a straight line",
        CurveKind::Arc(arc) if arc.rise == 0.0 => "the tip goes along an arc",
        CurveKind::Arc(_) => "the tip goes along a helix",
        _ => "the tip goes along a curve",
    }
}
