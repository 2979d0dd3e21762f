//! The move of an envelope table, as a motion of the tool.

use glam::DVec3;

use super::EnvelopeTable;
use super::given_move::{GREAT_CIRCLE, GivenMove, JOINTS, MoveSource, STANDS, TIP_AND_JOINTS, path_words};
use super::joints::of_joints;
use crate::base::{Code, Finding, Loader, Result};
use crate::sweep::{ScrewMove, TipMove, ToolMotion};
use crate::trace::{Carried, Segment};
use crate::verbs::program_line::{ProgramLineTable, program_line};

/// The motions of a table, at least one; if it is wanted with the tool of the program.
pub(crate) fn motions(table: &EnvelopeTable, with_tool: bool, loader: &dyn Loader) -> Result<Vec<GivenMove>> {
    let given = [table.way.is_some(), table.joints.is_some(), table.screw.is_some(), table.of.is_some()];
    let count = given.iter().filter(|g| **g).count();
    let refused = || {
        Finding::error(Code::ENVELOPE_MOTION, "the move of the tool is not given once")
            .value(count as f64, "moves")
            .bound(1.0, "")
            .help("give one of: move = { from = [..], to = [..] }; joints = { machine = .., from = {..}, to = {..} }; screw = { velocity = [..], turn = [..] }; of = { job = .., line = .. }")
    };
    match (count, &table.way, &table.joints, &table.screw, &table.of) {
        (1, Some(way), ..) => of_tip(way).map(|m| vec![m]).map_err(|e| e.under("move")),
        (1, _, Some(joints), ..) => of_joints(joints, loader).map(|m| vec![m]).map_err(|e| e.under("joints")),
        (1, _, _, Some(screw), _) => of_screw(screw).map(|m| vec![m]).map_err(|e| e.under("screw")),
        (1, _, _, _, Some(line)) => of_line(line, with_tool, loader).map_err(|e| e.under("of")),
        _ => Err(refused().into()),
    }
}

fn of_tip(table: &TipMove) -> Result<GivenMove> {
    let (motion, way) = (table.motion()?, path_words(&table.path().curve()?));
    let mode = if table.axis_to.is_some() { GREAT_CIRCLE } else { STANDS };
    Ok(GivenMove { motion, way, mode, source: MoveSource::Way, tool: None })
}

fn of_screw(table: &ScrewMove) -> Result<GivenMove> {
    let (start, twist) = table.start_and_twist()?;
    let way = match (twist.turn == DVec3::ZERO, twist.shift == DVec3::ZERO) {
        (true, true) => "the tool stays",
        (true, false) => "the tool goes straight",
        (false, _) => "the tool goes along a screw",
    };
    let mode = "a constant twist in coordinates of the tool";
    Ok(GivenMove {
        motion: ToolMotion::screw(start, twist)?,
        way,
        mode,
        source: MoveSource::Screw,
        tool: None,
    })
}

fn of_line(table: &ProgramLineTable, with_tool: bool, loader: &dyn Loader) -> Result<Vec<GivenMove>> {
    let line = program_line(table, Code::ENVELOPE_MOTION, loader)?;
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
        Ok(GivenMove { motion, way, mode, source, tool })
    };
    moves.into_iter().enumerate().map(one).collect()
}

/// The move of a segment of a program, in words.
fn segment_words(segment: &Segment) -> (&'static str, &'static str) {
    let way = path_words(&segment.curve);
    match segment.turning.as_ref().map(|turning| turning.carried()) {
        None => (way, STANDS),
        Some(Carried::Plane) => (way, GREAT_CIRCLE),
        Some(Carried::TipAndJoints { .. }) => (way, TIP_AND_JOINTS),
        Some(Carried::Joints { .. }) => ("the axes of the machine move", JOINTS),
    }
}
