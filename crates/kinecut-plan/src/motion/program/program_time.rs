//! Time of a program.

use crate::base::Finding;

/// Time of a program on a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct ProgramTime {
    /// Time of each segment of the trace under the law [s]; 0 for ways that the machine may take instead.
    pub segments: Vec<f64>,
    /// All moves [s].
    pub moves: f64,
    /// All moves where jerk has no limit [s]: no run is faster.
    pub without_jerk: f64,
    /// Waits that the program asks for [s].
    pub dwells: f64,
    /// Tool changes: their number, and their time where the machine says it [s].
    pub tool_changes: (usize, Option<f64>),
    /// Starts, stops and changes of the spindle's speed: their number, and their time where the machine says it [s].
    pub spindle_changes: (usize, Option<f64>),
    /// Joints of moves.
    pub smoothing: Smoothing,
    /// Largest factor by which a run was slowed so that every limit holds.
    pub dilation: f64,
    /// Moves on which the limit of jerk does not count: of a program with too many of them that are not run evenly.
    pub without_limit_of_jerk: usize,
    /// Moves that count with their programmed time, because the law of their stretch was refused: their number, and the
    /// item of the first with the reason.
    pub refused: (usize, Option<(u32, Finding)>),
}

/// Joints of moves at feed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Smoothing {
    /// Joints at which the path goes on with two derivatives.
    pub smooth: usize,
    /// Joints that the control smooths.
    pub smoothed: usize,
    /// Joints at which the tool stops.
    pub stops: usize,
    /// Largest distance from the programmed path at smoothed joints, of linear axes [mm].
    pub farthest: f64,
}

impl ProgramTime {
    /// Time of the program [s]: moves, waits, and what is known of tool changes and spindle.
    pub fn total(&self) -> f64 {
        self.moves + self.dwells + self.tool_changes.1.unwrap_or(0.0) + self.spindle_changes.1.unwrap_or(0.0)
    }

    /// Time below which no run of the program can be [s].
    pub fn least(&self) -> f64 {
        self.total() - self.moves + self.without_jerk
    }
}

impl Smoothing {
    /// Counts the joints of another stretch, too.
    pub(super) fn add(&mut self, other: &Smoothing) {
        self.smooth += other.smooth;
        self.smoothed += other.smoothed;
        self.stops += other.stops;
        self.farthest = self.farthest.max(other.farthest);
    }
}
