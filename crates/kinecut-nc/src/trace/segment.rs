//! Segments of a trace.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::chain::Chain;
use super::stand::Stand;
use super::turning::AxisTurning;
use crate::geom::{Curve, Jet};
use crate::program::{SetupId, ToolNumber};

/// Speed of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SegmentPace {
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
    /// Turning of the tool by arc length; zero while the axis is fixed, and in a segment that only turns the tool.
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

/// One segment: the tip runs along a curve, the tool axis keeps its direction or turns.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Path of the tip [part coordinates]; of no length where the tool turns about its tip.
    pub curve: Curve,
    /// Unit vector from tip to holder at the start [part coordinates].
    pub axis: DVec3,
    /// Turning of the tool axis along the segment; `None` while it keeps its direction.
    pub turning: Option<Arc<AxisTurning>>,
    /// Rapid or feed.
    pub motion: SegmentPace,
    /// Tool in the spindle.
    pub tool: Option<ToolNumber>,
    /// True if the spindle turns.
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
    /// The axes at the start; segments with the same share them.
    pub(super) start_axes: Arc<StartAxes>,
}

/// Axes of the machine at the start of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StartAxes {
    /// Positions of the rotary axes A, B, C [rad].
    pub(super) rotary: [f64; 3],
    /// Maps part coordinates of the tip into positions of the linear axes at these rotary positions.
    pub(super) to_linear: (DMat3, DVec3),
}

impl Segment {
    /// The tool at arc length `s` [mm].
    pub fn pose(&self, s: f64) -> Pose {
        let tip = self.curve.at(s);
        match &self.turning {
            None => Pose { tip, axis: self.axis, turning: DVec3::ZERO },
            Some(turning) => {
                let length = self.curve.length();
                let (axis, rate) = turning.axis(if length > 0.0 { s / length } else { 0.0 });
                Pose { tip, axis, turning: if length > 0.0 { rate / length } else { DVec3::ZERO } }
            }
        }
    }

    /// Tip and unit vector from tip to holder at a part `t` of the segment, from 0 to 1 [part coordinates].
    pub fn tool_at(&self, t: f64) -> (DVec3, DVec3) {
        let tip = self.curve.at(t * self.curve.length()).p;
        (tip, self.turning.as_ref().map_or(self.axis, |turning| turning.axis(t).0))
    }

    /// Positions of the rotary axes A, B, C at the start [rad], where the machine is known.
    pub fn rotary(&self) -> [f64; 3] {
        self.start_axes.rotary
    }

    /// Unit vector from tip to holder at the end [part coordinates].
    pub fn end_axis(&self) -> DVec3 {
        self.turning.as_ref().map_or(self.axis, |turning| turning.axis(1.0).0)
    }

    /// Positions of the axes X, Y, Z at arc length `s` [mm], with their derivatives by arc length: exact up to a
    /// constant when the setup is not located on the machine. Where the tool turns they are those at the rotary positions
    /// of the start; [`Segment::axis_path`] has the others.
    pub fn axes(&self, s: f64) -> [AxisJet; 3] {
        let jet = self.curve.at(s);
        let (matrix, shift) = self.start_axes.to_linear;
        let p = matrix * jet.p + shift;
        let [d1, d2, d3] = [jet.d1, jet.d2, jet.d3].map(|d| matrix * d);
        [0, 1, 2].map(|i| AxisJet { q: p[i], d1: d1[i], d2: d2[i], d3: d3[i] })
    }

    /// Positions of the axes X Y Z A B C [mm, rad] at a part `t` of the path, from 0 to 1; `None` where the tool turns
    /// and its machine is not known.
    pub fn joints(&self, t: f64) -> Option<[f64; 6]> {
        let tip = self.curve.at(t * self.curve.length()).p;
        let (linear, rotary) = match &self.turning {
            None => {
                let StartAxes { rotary, to_linear: (matrix, shift) } = *self.start_axes;
                (matrix * tip + shift, rotary)
            }
            Some(turning) => turning.joints(tip, t)?,
        };
        Some([linear.x, linear.y, linear.z, rotary[0], rotary[1], rotary[2]])
    }

    /// The tip [part coordinates, mm] while the axes X Y Z A B C stand at these positions [mm, rad], on the path or beside it;
    /// `None` where the tool turns and its machine is not known, or the linear axes are not independent. A segment on which the
    /// tool does not turn keeps its rotary axes: those of `axes` are not looked at.
    pub fn tip_at(&self, axes: [f64; 6]) -> Option<DVec3> {
        let (linear, rotary) = (DVec3::new(axes[0], axes[1], axes[2]), [axes[3], axes[4], axes[5]]);
        match &self.turning {
            None => {
                let (matrix, shift) = self.start_axes.to_linear;
                Chain::independent(matrix).map(|back| back * (linear - shift))
            }
            Some(turning) => {
                let chain = turning.chain.as_ref()?;
                Some(turning.to_part.point(chain.pose(linear, rotary).translation))
            }
        }
    }
}

/// A move whose start is not known, so that it could not be followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Untraced {
    /// Index of the program item.
    pub item: u32,
    /// Setup.
    pub setup: SetupId,
    /// Tool in the spindle.
    pub tool: Option<ToolNumber>,
    /// Unit vector from tip to holder at the end [table frame].
    pub axis: DVec3,
    /// Whether it is a move at feed, otherwise a rapid.
    pub feed: bool,
    /// Start of the tip [table frame, mm]; a coordinate is `None` where it is not known.
    pub start: [Option<f64>; 3],
    /// End of the tip [table frame, mm]; a coordinate is `None` while it is not known.
    pub end: [Option<f64>; 3],
}

/// A program on a machine.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    /// Segments in order.
    pub segments: Vec<Segment>,
    /// Moves that could not be followed: the first approach, and whatever starts at a place that is not known.
    pub untraced: Vec<Untraced>,
    /// Waits: item and seconds.
    pub dwells: Vec<(u32, f64)>,
    /// Rests of the tool (waits, stops, tool changes) at places that are known.
    pub stands: Vec<Stand>,
    /// Assumptions, in words for the verdict.
    pub assumed: Vec<String>,
    /// Largest distance of a tip path that was followed by chords from the exact one [mm]: moves in which rotary axes
    /// turn without control of the tool centre point.
    pub chord_error: f64,
}

impl Trace {
    /// Time of all segments and waits at programmed speeds [s]; second: true if all segments have a time, rapids too.
    pub fn duration(&self) -> (f64, bool) {
        let counted = self.segments.iter().filter(|s| !s.alternative);
        let complete = counted.clone().all(|s| s.duration.is_some());
        let moves: f64 = counted.filter_map(|s| s.duration).sum();
        (moves + self.dwells.iter().map(|d| d.1).sum::<f64>(), complete)
    }
}
