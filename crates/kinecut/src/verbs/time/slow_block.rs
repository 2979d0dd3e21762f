//! Blocks that lose time against their programmed feed.

use std::collections::BTreeMap;

use serde::Serialize;

use super::moving::MovingProgram;
use crate::motion::ProgramTime;
use crate::page::{Cell, Row, Table, fixed};
use crate::trace::SegmentPace;

/// A block that loses time against its programmed feed, all its passes together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SlowBlock {
    /// Program file.
    pub file: String,
    /// Line of the program, from 1.
    pub line: u32,
    /// Text of the block.
    pub block: String,
    /// Way of the tip [mm].
    pub way: f64,
    /// Programmed feed on average [mm/min]; none where the tip stands.
    pub programmed_feed: Option<f64>,
    /// Mean feed [mm/min]; none where the tip stands.
    pub mean_feed: Option<f64>,
    /// Time [s].
    pub time: f64,
    /// Time that it takes longer than at its programmed feed [s].
    pub lost: f64,
}

/// Way, time and programmed time of a block.
#[derive(Clone, Copy, Default)]
struct Passes {
    way: f64,
    time: f64,
    programmed: f64,
}

impl SlowBlock {
    /// The blocks that lose most, up to a number, the worst first.
    pub(super) fn most(programs: &[(MovingProgram, ProgramTime)], number: usize) -> Vec<SlowBlock> {
        /// Loss that counts [s].
        const LEAST: f64 = 5e-4;
        let mut found: Vec<(usize, u32, Passes)> = Vec::new();
        for (p, (program, time)) in programs.iter().enumerate() {
            let lines = by_line(program, time).into_iter();
            found.extend(
                lines.filter(|(_, all)| all.time - all.programmed >= LEAST).map(|(l, all)| (p, l, all)),
            );
        }
        // The earlier one first where two lose the same.
        found.sort_by(|a, b| (b.2.time - b.2.programmed).total_cmp(&(a.2.time - a.2.programmed)));
        found.truncate(number);
        found.into_iter().map(|(p, line, all)| SlowBlock::new(&programs[p].0, line, all)).collect()
    }

    fn new(program: &MovingProgram, line: u32, Passes { way, time, programmed }: Passes) -> SlowBlock {
        let feed = |time: f64| (way > 0.0 && time > 0.0).then(|| 60.0 * way / time);
        SlowBlock {
            file: program.file.clone(),
            line: line + 1,
            block: one_line(program.text.lines().nth(line as usize).unwrap_or_default()),
            way,
            programmed_feed: feed(programmed),
            mean_feed: feed(time),
            time,
            lost: time - programmed,
        }
    }

    fn row(&self, several: bool) -> Row {
        let feed = |feed: Option<f64>| feed.map_or(String::new(), |feed| fixed(feed, 0));
        let line = if several { format!("{}:{}", self.file, self.line) } else { self.line.to_string() };
        let cells = [
            line,
            short(&self.block),
            feed(self.programmed_feed),
            feed(self.mean_feed),
            fixed(self.time, 3),
            fixed(self.lost, 3),
        ];
        Row::new(cells.map(Cell::new).to_vec())
    }

    /// Blocks as a table; `several`: they are of several programs.
    pub(super) fn table(blocks: &[SlowBlock], several: bool) -> Table {
        let columns = "Line; Block; Programmed [mm/min]; Mean [mm/min]; Time [s]; Lost [s]";
        Table::new("Blocks that lose most time", columns).rows(blocks.iter().map(|block| block.row(several)))
    }
}

/// A block as it is shown in a table.
pub(super) fn short(block: &str) -> String {
    /// Characters of a block that are shown.
    const SHOWN: usize = 48;
    match block.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}..", &block[..end]),
        None => block.to_owned(),
    }
}

/// The words of a block with one blank between them.
pub(super) fn one_line(block: &str) -> String {
    block.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Passes of the blocks at feed, by line.
fn by_line(program: &MovingProgram, time: &ProgramTime) -> BTreeMap<u32, Passes> {
    let mut lines: BTreeMap<u32, Passes> = BTreeMap::new();
    for (segment, own) in program.trace.segments.iter().zip(&time.segments) {
        let SegmentPace::Feed(feed) = segment.motion else { continue };
        let Some(line) = program.line(segment.item).filter(|_| !segment.alternative) else { continue };
        let way = segment.curve.length();
        let all = lines.entry(line).or_default();
        all.way += way;
        all.time += own;
        all.programmed += segment.duration.unwrap_or(way / feed);
    }
    lines
}
