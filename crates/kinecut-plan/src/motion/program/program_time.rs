//! Time of a program.

use super::passing::Passing;
use super::smoothed_joint::SmoothedJoint;
use crate::base::Finding;

/// Time of a program on a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct ProgramTime {
    /// Time of each segment of the trace under the law [s]; 0 for ways that the machine may take instead.
    pub segments: Vec<f64>,
    /// All moves [s].
    pub moves: f64,
    /// All moves where jerk has no limit [s], the joints passed as they are here.
    pub without_jerk: f64,
    /// Waits that the program asks for [s].
    pub dwells: f64,
    /// Tool changes.
    pub tool_changes: Changes,
    /// Starts and changes of the spindle's speed.
    pub spindle_changes: Changes,
    /// Joints of moves.
    pub smoothing: Smoothing,
    /// Largest factor by which a run was slowed so that every limit holds.
    pub dilation: f64,
    /// True if the limits have one of jerk.
    pub limits_jerk: bool,
    /// Moves on which the limit of jerk does not count: of a program with too many of them that are not run evenly, or where
    /// some of their axes have one and others have none.
    pub jerk_left_out: usize,
    /// Moves that count with their programmed time, because their stretch has no law.
    pub refused: usize,
    /// Note about them, at the item of the first, with its reason.
    pub reason: Option<Finding>,
    /// Turns of rotary axes on the spot that are in the time [s]: where the tool begins to leave the direction of a rotary
    /// axis, that axis must turn first.
    pub swings: f64,
}

/// Changes for which the path waits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Changes {
    /// Their number.
    pub count: usize,
    /// Their time [s], where the machine states it.
    pub time: Option<f64>,
}

/// Joints of moves at feed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Smoothing {
    /// Joints at which the path goes on with two derivatives.
    pub smooth: usize,
    /// Joints that the control smooths.
    pub smoothed: usize,
    /// Joints at which the tool stops.
    pub stops: usize,
    /// The smoothed joints that are farthest off the programmed path, up to ten, the farthest first.
    pub farthest: Vec<SmoothedJoint>,
}

impl ProgramTime {
    /// Time of the program [s]: moves, waits, and what is known of tool changes and spindle.
    pub fn total(&self) -> f64 {
        let changes = [self.tool_changes, self.spindle_changes].map(|changes| changes.time.unwrap_or(0.0));
        self.moves + self.dwells + changes[0] + changes[1]
    }

    /// Time of the program where jerk has no limit [s]: the same joints, waits and changes.
    pub fn total_without_jerk(&self) -> f64 {
        self.total() - self.moves + self.without_jerk
    }
}

impl Smoothing {
    /// Largest distance from the programmed path [mm].
    pub fn most_off(&self) -> f64 {
        self.farthest.first().map_or(0.0, |joint| joint.off)
    }

    /// Counts these joints, too.
    pub(super) fn count(&mut self, passings: &[Passing]) {
        for passing in passings {
            match passing {
                Passing::Passed(Some(_), _) => self.smoothed += 1,
                Passing::Passed(None, _) => self.smooth += 1,
                Passing::Stop => self.stops += 1,
            }
        }
    }

    /// Lists these smoothed joints, too.
    pub(super) fn add_farthest(&mut self, joints: &[SmoothedJoint]) {
        if !joints.is_empty() {
            let all = std::mem::take(&mut self.farthest).into_iter().chain(joints.iter().copied());
            self.farthest = SmoothedJoint::farthest(all.collect());
        }
    }

    /// Counts the joints of another stretch, too.
    pub(super) fn add(&mut self, other: &Smoothing) {
        self.smooth += other.smooth;
        self.smoothed += other.smoothed;
        self.stops += other.stops;
        self.add_farthest(&other.farthest);
    }
}
