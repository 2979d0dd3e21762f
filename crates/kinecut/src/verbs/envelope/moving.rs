//! The move of an envelope table, as a motion of the tool.

use glam::DMat3;
use serde::Serialize;

use super::joints::of_joints;
use super::way::{angle, curve, direction, place};
use super::{EnvelopeTable, ProgramLineTable, ScrewTable, WayTable};
use crate::base::{Code, Finding, Loader, Result};
use crate::geom::Rigid;
use crate::machine::Twist;
use crate::sweep::{ToolMotion, twist_of};
use crate::tool::Contour;
use crate::verbs::grazing::rows;
use crate::verbs::program_line::{LineWants, program_line};

/// Where a move comes from.
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
        /// Which of the line's moves, from 1.
        #[serde(rename = "move")]
        part: usize,
        /// How many there are.
        of: usize,
        /// Name of the program.
        program: String,
    },
}

/// A motion with what is known of it.
pub(crate) struct Moving {
    pub(crate) motion: ToolMotion,
    /// What the tip or the tool does, in words.
    pub(crate) way: &'static str,
    /// How the positions between the ends are found, in words.
    pub(crate) mode: &'static str,
    pub(crate) source: MoveSource,
    pub(crate) tool: Option<(String, Contour)>,
}

/// The tool does not turn.
pub(crate) const STANDS: &str = "the direction of the tool stands still";
/// Great circle.
const GREAT_CIRCLE: &str = "control of the tool centre point; the direction turns on the great circle at a constant rate \
(interpolation of the tool vector)";
/// Rotary joints under control of the tip.
pub(crate) const TIP_AND_JOINTS: &str =
    "control of the tool centre point; rotary axes go straight from position to position";
/// All joints.
pub(crate) const JOINTS: &str =
    "all axes go straight from position to position (no control of the tool centre point)";

/// The motions of a table, at least one; if it is wanted with the tool of the program.
pub(crate) fn motions(table: &EnvelopeTable, with_tool: bool, loader: &dyn Loader) -> Result<Vec<Moving>> {
    let given = [table.way.is_some(), table.joints.is_some(), table.screw.is_some(), table.of.is_some()];
    let count = given.iter().filter(|g| **g).count();
    let refused = || {
        Finding::error(Code::ENVELOPE_MOTION, "the move of the tool is not given once")
            .value(count as f64, "moves")
            .bound(1.0, "")
            .help("give one of: move = { from = [..], to = [..] }; joints = { machine = .., from = {..}, to = {..} }; screw = { velocity = [..], turn = [..] }; of = { job = .., line = .. }")
    };
    match (count, &table.way, &table.joints, &table.screw, &table.of) {
        (1, Some(way), ..) => of_way(way).map(|m| vec![m]).map_err(|e| e.under("move")),
        (1, _, Some(joints), ..) => of_joints(joints, loader).map(|m| vec![m]).map_err(|e| e.under("joints")),
        (1, _, _, Some(screw), _) => of_screw(screw).map(|m| vec![m]).map_err(|e| e.under("screw")),
        (1, _, _, _, Some(line)) => of_line(line, with_tool, loader).map_err(|e| e.under("of")),
        _ => Err(refused().into()),
    }
}

fn of_way(table: &WayTable) -> Result<Moving> {
    let (tip, way) = curve(&table.tip())?;
    let from = direction("axis", table.axis.unwrap_or([0.0, 0.0, 1.0]))?;
    let to = table.axis_to.map(|to| direction("axis_to", to)).transpose()?;
    let (motion, mode) = match to {
        None => (ToolMotion::fixed(tip, from)?, STANDS),
        Some(to) => (ToolMotion::between(tip, from, to).map_err(|e| e.under("axis_to"))?, GREAT_CIRCLE),
    };
    Ok(Moving { motion, way, mode, source: MoveSource::Way, tool: None })
}

fn of_screw(table: &ScrewTable) -> Result<Moving> {
    let start = match &table.pose {
        None => Rigid::IDENTITY,
        Some(given) => {
            let (rotation, translation) = rows("pose", given, 1.0)?;
            place("pose", translation.to_array())?;
            let pose = Rigid { rotation, translation };
            // A rate of nothing leaves the check of the matrix.
            twist_of(&pose, DMat3::ZERO, glam::DVec3::ZERO).map_err(|e| e.under("pose"))?;
            pose
        }
    };
    let mut turn = glam::DVec3::ZERO;
    for (i, &degrees) in table.turn.iter().enumerate() {
        turn[i] = angle(&format!("turn[{i}]"), degrees)?;
    }
    let velocity = place("velocity", table.velocity)?;
    let shift = velocity - turn.cross(place("at", table.at)?);
    let way = match (turn == glam::DVec3::ZERO, shift == glam::DVec3::ZERO) {
        (true, true) => "the tool stays",
        (true, false) => "the tool goes straight",
        (false, _) => "the tool goes along a screw",
    };
    let motion = ToolMotion::screw(start, Twist { turn, shift })?;
    Ok(Moving {
        motion,
        way,
        mode: "a constant twist in coordinates of the tool",
        source: MoveSource::Screw,
        tool: None,
    })
}

fn of_line(table: &ProgramLineTable, with_tool: bool, loader: &dyn Loader) -> Result<Vec<Moving>> {
    let wants = LineWants {
        job: &table.job,
        program: table.program.as_deref(),
        setup: table.setup.unwrap_or(1),
        line: table.line,
    };
    let line = program_line(&wants, Code::ENVELOPE_MOTION, loader)?;
    let moves = ToolMotion::of_segments(&line.segments)?;
    let count = moves.len();
    let one = |(i, (range, motion)): (usize, (std::ops::Range<usize>, ToolMotion))| {
        let segment = &line.segments[range.start];
        let (way, mode) = segment_words(segment);
        let source = MoveSource::Line {
            program: line.program.clone(),
            line: table.line,
            block: line.block.clone(),
            part: i + 1,
            of: count,
        };
        let tool = if with_tool { line.tool(segment)? } else { None };
        Ok(Moving { motion, way, mode, source, tool })
    };
    moves.into_iter().enumerate().map(one).collect()
}

/// What a segment of a program does, in words.
fn segment_words(segment: &crate::trace::Segment) -> (&'static str, &'static str) {
    use crate::geom::CurveKind;
    use crate::trace::Carried;
    let way = match segment.curve.kind() {
        _ if segment.curve.length() == 0.0 => "the tip stays",
        CurveKind::Line(_) => "the tip goes along a straight line",
        CurveKind::Arc(arc) if arc.rise == 0.0 => "the tip goes along an arc",
        CurveKind::Arc(_) => "the tip goes along a helix",
        _ => "the tip goes along a curve",
    };
    match segment.turning.as_ref().map(|turning| turning.carried()) {
        None => (way, STANDS),
        Some(Carried::Plane) => (way, GREAT_CIRCLE),
        Some(Carried::TipAndJoints { .. }) => (way, TIP_AND_JOINTS),
        Some(Carried::Joints { .. }) => ("the axes of the machine move", JOINTS),
    }
}
