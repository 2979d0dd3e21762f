//! Blocks at whose start the control leaves the programmed path.

use serde::Serialize;

use super::moving::MovingProgram;
use super::slow_block::{one_line, short};
use crate::motion::ProgramTime;
use crate::page::{Cell, Row, Table, fixed};

/// A block that begins with a joint which the control smooths.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SmoothedBlock {
    /// Program file.
    pub file: String,
    /// Line of the program, from 1.
    pub line: u32,
    /// Text of the block.
    pub block: String,
    /// Angle by which the linear axes turn there [deg].
    pub corner: f64,
    /// Distance from the programmed path [mm].
    pub off: f64,
}

impl SmoothedBlock {
    /// The blocks where the path is left most, up to a number, the farthest first.
    pub(super) fn farthest(programs: &[(MovingProgram, ProgramTime)], number: usize) -> Vec<SmoothedBlock> {
        let mut found = Vec::new();
        for (program, time) in programs {
            for joint in &time.smoothing.farthest {
                let Some(line) = program.line(joint.item) else { continue };
                found.push(SmoothedBlock {
                    file: program.file.clone(),
                    line: line + 1,
                    block: one_line(program.text.lines().nth(line as usize).unwrap_or_default()),
                    corner: joint.corner.to_degrees(),
                    off: joint.off,
                });
            }
        }
        // The earlier one first where two are as far.
        found.sort_by(|a, b| b.off.total_cmp(&a.off));
        found.truncate(number);
        found
    }

    fn row(&self, several: bool) -> Row {
        let line = if several { format!("{}:{}", self.file, self.line) } else { self.line.to_string() };
        let cells = [line, short(&self.block), fixed(self.corner, 1), fixed(self.off, 4)];
        Row::new(cells.map(Cell::new).to_vec())
    }

    /// Blocks as a table; `several`: they are of several programs.
    pub(super) fn table(blocks: &[SmoothedBlock], several: bool) -> Table {
        let columns = "Line; Block; Corner [deg]; Off the path [mm]";
        let rows = blocks.iter().map(|block| block.row(several));
        Table::new("Corners that are smoothed most, at the start of these blocks", columns).rows(rows)
    }
}
