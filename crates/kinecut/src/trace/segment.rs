//! Segments of a trace.

use glam::DVec3;

use crate::geom::{Curve, Jet, Rigid};
use crate::program::{SetupId, ToolNumber};

/// How fast a segment is run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Rapid.
    Rapid,
    /// Path speed [mm/s].
    Feed(f64),
}

/// The tool at a point of a segment, in part coordinates: the tip with its derivatives by arc length, and the
/// tool axis (from tip to holder) with its rate of turning by arc length [rad/mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Tool tip.
    pub tip: Jet,
    /// Unit vector from tip to holder.
    pub axis: DVec3,
    /// Turning of the tool by arc length; zero while the axis is fixed.
    pub turning: DVec3,
}

/// Position of one machine axis and its derivatives by arc length [mm, 1, 1/mm, 1/mm^2].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisJet {
    /// Position.
    pub q: f64,
    /// First derivative.
    pub d1: f64,
    /// Second derivative.
    pub d2: f64,
    /// Third derivative.
    pub d3: f64,
}

/// One segment: the tip runs along a curve, the tool axis stands still.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Path of the tip [part coordinates].
    pub curve: Curve,
    /// Unit vector from tip to holder [part coordinates].
    pub axis: DVec3,
    /// Rapid or feed.
    pub motion: Motion,
    /// Tool in the spindle.
    pub tool: Option<ToolNumber>,
    /// Whether the spindle turns.
    pub spindle_on: bool,
    /// Index of the program item.
    pub item: u32,
    /// Setup.
    pub setup: SetupId,
    /// Time at the programmed speed [s]; `None` when it is not known.
    pub duration: Option<f64>,
    /// A way that the machine may take instead of the segment before (a rapid axis by axis): to be checked for
    /// collision, not to be counted in time.
    pub alternative: bool,
    /// Maps part coordinates into the table frame.
    pub(super) part_on_table: Rigid,
    /// Added to the Z of the tip to get the axis position [mm]: the length of the tool, where it is known.
    pub(super) gauge_length: f64,
}

impl Segment {
    /// The tool at arc length `s` [mm].
    pub fn pose(&self, s: f64) -> Pose {
        Pose { tip: self.curve.at(s), axis: self.axis, turning: DVec3::ZERO }
    }

    /// Positions of the axes X, Y, Z at arc length `s` [mm], with their derivatives by arc length: exact up to a
    /// constant when the setup is not located on the machine.
    pub fn axes(&self, s: f64) -> [AxisJet; 3] {
        let jet = self.curve.at(s);
        let p = self.part_on_table.point(jet.p) + DVec3::Z * self.gauge_length;
        let [d1, d2, d3] = [jet.d1, jet.d2, jet.d3].map(|d| self.part_on_table.vector(d));
        [0, 1, 2].map(|i| AxisJet { q: p[i], d1: d1[i], d2: d2[i], d3: d3[i] })
    }

    /// The path of the gauge point in the table frame: what the linear axes do.
    pub fn axis_path(&self) -> Curve {
        let lift = Rigid::from_translation(DVec3::Z * self.gauge_length);
        self.curve.moved(&lift.after(&self.part_on_table))
    }
}

/// A move whose start is not known, so that it could not be followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Untraced {
    /// Index of the program item.
    pub item: u32,
}

/// A program on a machine.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    /// Segments in order.
    pub segments: Vec<Segment>,
    /// Moves that could not be followed: the first approach.
    pub untraced: Vec<Untraced>,
    /// Waits: item and seconds.
    pub dwells: Vec<(u32, f64)>,
    /// What had to be assumed, in words for the verdict.
    pub assumed: Vec<String>,
}

impl Trace {
    /// Time of all segments and waits at programmed speeds [s]; second: whether rapids are in it.
    pub fn duration(&self) -> (f64, bool) {
        let counted = self.segments.iter().filter(|s| !s.alternative);
        let complete = counted.clone().all(|s| s.duration.is_some());
        let moves: f64 = counted.filter_map(|s| s.duration).sum();
        (moves + self.dwells.iter().map(|d| d.1).sum::<f64>(), complete)
    }
}
