//! Questions of the rules about the stock between two cuts: at a tool that stands still, and before it goes down.

use glam::DVec3;

use super::check::Job;
use crate::base::Silent;
use crate::geom::{Aabb, Profile};
use crate::stock::TriDexel;
use crate::stock::cut::ToolBody;
use crate::stock::near::{above, face_below, highest, touches};
use crate::tool::{Cutter, Tool};
use crate::trace::{Segment, SegmentPace, Trace};

/// Answers about the stock while one setup's program was cut.
#[derive(Clone, Debug, Default)]
pub struct Looks {
    /// Contacts of the tool at rest.
    pub stands: Vec<StandContact>,
    /// Descents that are steeper than the tool may go.
    pub descents: Vec<SteepDescent>,
    /// Faces that drills enter.
    pub entries: Vec<DrillEntry>,
}

/// A face that a drill enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrillEntry {
    /// Index of the first segment that goes down.
    pub segment: usize,
    /// Angle between the tool's axis and the mean normal of the face below it [rad].
    pub angle: f64,
}

/// Material around a tool at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandContact {
    /// Index among the trace's stands.
    pub stand: usize,
    /// Whether its edges or its shank touch material.
    pub touches: bool,
    /// Height of the highest material above its tip, along its axis [mm]; where the tool stands above the raw stock that of its box.
    pub below: f64,
}

/// A tool that goes down more steeply than it may.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteepDescent {
    /// Index of the segment.
    pub segment: usize,
    /// Steepest angle from the plane across the tool [rad].
    pub angle: f64,
    /// Longest stretch of material that the middle of the tool goes through [mm].
    pub core: f64,
}

/// A question.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Look {
    /// About a stand of the trace.
    Stand(usize),
    /// About a segment, and its angle.
    Descent(usize, f64),
    /// About the face below a drill, by its segment.
    Entry(usize),
}

/// Steeper than this a descent counts as a plunge, for tools that may not [rad].
pub(super) const PLUNGE: f64 = std::f64::consts::FRAC_PI_4;
/// Steeper than this it is straight down, which a tool that cuts at its centre may [rad].
const STRAIGHT_DOWN: f64 = 85.0 / 180.0 * std::f64::consts::PI;
/// Excess of a ramp over the steepest way of the tool that passes [rad]: rounding of coordinates of a short move.
pub(super) const RAMP_SLACK: f64 = 0.05 / 180.0 * std::f64::consts::PI;
/// Share of its radius within which a tool that does not cut at its centre has no edges.
const DEAD_CENTRE: f64 = 0.2;
/// Distance at which a tool counts as touching [mm].
pub(super) const TOUCH: f64 = 0.05;

/// The questions about a trace, by the item before which they are asked.
pub(super) fn looks(job: &Job, trace: &Trace) -> Vec<(u32, Look)> {
    let mut list: Vec<(u32, Look)> =
        trace.stands.iter().enumerate().map(|(i, stand)| (stand.item, Look::Stand(i))).collect();
    for (i, segment) in trace.segments.iter().enumerate() {
        let tool = segment.tool.and_then(|n| job.tools.iter().find(|t| t.number == n));
        if let Some(tool) = tool
            && !segment.alternative
            && matches!(segment.motion, SegmentPace::Feed(_))
            && let Some(angle) = too_steep(tool, segment)
        {
            list.push((segment.item, Look::Descent(i, angle)));
        }
        if tool.is_some_and(|t| matches!(t.cutter, Cutter::Drill { .. })) && goes_down(segment) {
            // The first of a cycle, which may peck.
            let again = list
                .last()
                .is_some_and(|(item, look)| *item == segment.item && matches!(look, Look::Entry(_)));
            if !again {
                list.push((segment.item, Look::Entry(i)));
            }
        }
    }
    list
}

/// Greatest height of a box along an axis [mm].
fn top(bounds: Aabb, axis: DVec3) -> f64 {
    (bounds.min * axis).max(bounds.max * axis).element_sum()
}

/// Whether a tool goes down along its axis at feed.
fn goes_down(segment: &Segment) -> bool {
    let way = segment.curve.end() - segment.curve.start();
    let feeds = matches!(segment.motion, SegmentPace::Feed(_)) && !segment.alternative;
    feeds && segment.turning.is_none() && way.dot(segment.axis) < -0.99 * way.length()
}

/// The angle of a descent that the tool may not follow in material.
fn too_steep(tool: &Tool, segment: &Segment) -> Option<f64> {
    // A ramp is no matter of a tool that works along its axis.
    let most = tool.max_ramp_angle.filter(|_| !tool.cutter.is_axial());
    if tool.centre_cutting && most.is_none() {
        return None;
    }
    let length = segment.curve.length();
    let steepest = (0..=SAMPLES)
        .map(|i| {
            let share = f64::from(i) / f64::from(SAMPLES);
            let along = segment.curve.at(length * share).d1;
            (-along.dot(segment.tool_at(share).1)).clamp(-1.0, 1.0).asin()
        })
        .fold(0.0, f64::max);
    let plunges = !tool.centre_cutting && steepest > PLUNGE;
    let ramps = most.is_some_and(|most| steepest > most + RAMP_SLACK) && steepest < STRAIGHT_DOWN;
    (plunges || ramps).then_some(steepest)
}

/// Places along a segment at which is looked.
const SAMPLES: u32 = 8;

impl Looks {
    /// Answers a question from the stock as it is.
    pub(super) fn answer(
        &mut self,
        look: Look,
        (job, trace): (&Job, &Trace),
        bodies: &[ToolBody],
        stock: &mut TriDexel,
    ) {
        match look {
            Look::Stand(index) => {
                let stand = &trace.stands[index];
                let body = job.tools.iter().position(|t| t.number == stand.tool).map(|i| &bodies[i]);
                if let Some(body) = body {
                    let (tip, axis) = (stand.tip, stand.axis);
                    let most = top(stock.bounds(), axis) - tip.dot(axis);
                    let off = job.uncertainty.map_or(0.0, |off| off.of_stock());
                    if most <= -(TOUCH + off) {
                        self.stands.push(StandContact { stand: index, touches: false, below: most });
                        return;
                    }
                    stock.settle_along(&Silent);
                    let stock = &*stock;
                    let below = highest(stock, axis).map_or(f64::NEG_INFINITY, |top| top - tip.dot(axis));
                    let touches = below > -TOUCH && touches(stock, &parts(body), tip, axis, TOUCH);
                    self.stands.push(StandContact { stand: index, touches, below });
                }
            }
            Look::Entry(index) => {
                let segment = &trace.segments[index];
                let tool = segment.tool.and_then(|n| job.tools.iter().find(|t| t.number == n));
                let Some(tool) = tool else { return };
                let (start, axis) = segment.tool_at(0.0);
                let radius = 0.5 * tool.cutter.diameter(tool.flute_length);
                let reach = (segment.curve.end() - start).length() + tool.cutter.tip_height();
                stock.settle_along(&Silent);
                if let Some(normal) = face_below(&*stock, start, axis, radius, reach) {
                    self.entries.push(DrillEntry { segment: index, angle: normal.angle_between(axis) });
                }
            }
            Look::Descent(index, angle) => {
                let segment = &trace.segments[index];
                let tool = segment.tool.and_then(|n| job.tools.iter().find(|t| t.number == n));
                if let Some(tool) = tool {
                    stock.settle_along(&Silent);
                    let stock = &*stock;
                    // The flat of a face mill is at its tip.
                    let radius = 0.5 * DEAD_CENTRE * tool.cutter.diameter(0.0);
                    let core = |i: u32| {
                        let (tip, axis) = segment.tool_at(f64::from(i) / f64::from(SAMPLES));
                        above(stock, tip, axis, radius)
                    };
                    let core = (0..=SAMPLES).map(core).fold(0.0, f64::max);
                    self.descents.push(SteepDescent { segment: index, angle, core });
                }
            }
        }
    }
}

/// Edges and shank of a tool, and their heights.
pub(super) fn parts(body: &ToolBody) -> Vec<(&Profile, f64)> {
    std::iter::once((&body.cutting, 0.0)).chain(body.shank.iter().map(|(p, z)| (p, *z))).collect()
}
