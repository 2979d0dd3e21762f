//! Rests of the tool: waits, stops and tool changes.

use glam::DVec3;

use crate::program::{StopKind, ToolNumber};

/// Reason for which the tool rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StandKind {
    /// A wait [s].
    Dwell(f64),
    /// The operator is asked for.
    Stop(StopKind),
    /// This tool comes into the spindle.
    Change(ToolNumber),
}

/// A place at which the tool rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Index of the program item.
    pub item: u32,
    /// Reason.
    pub kind: StandKind,
    /// The tool in the spindle, before a change.
    pub tool: ToolNumber,
    /// Its tip [part coordinates].
    pub tip: DVec3,
    /// Unit vector from tip to holder [part coordinates].
    pub axis: DVec3,
    /// True if the spindle turns.
    pub spindle_on: bool,
    /// Index of the next segment of the trace.
    pub next: usize,
}
