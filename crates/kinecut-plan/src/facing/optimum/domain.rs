//! The allowed placements: the outline stays in the cutter's reach, orientations are not forbidden.
//!
//! The frame is moved to the middle of the part, which keeps the heights of its points slow in the angle. There the
//! offset allowed at an angle runs from (highest point - reach above) to (lowest point - reach below); a distance from
//! the middle cuts it in two.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use super::Options;
use crate::facing::{FaceCase, Placement};
use crate::geom::{Turn, convex_hull};
use crate::num::angle::wrap_positive;

/// An interval [from, to]; empty where the first exceeds the second.
pub(super) type Extent = [f64; 2];

/// The empty interval.
const NONE: Extent = [f64::INFINITY, f64::NEG_INFINITY];

/// Sine and cosine of both ends of an interval of angles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turned {
    pub(super) angle: Extent,
    sin: [f64; 2],
    cos: [f64; 2],
}

impl Turned {
    /// `angle` spans less than half a turn.
    pub(super) fn new(angle: Extent) -> Turned {
        let (s0, c0) = angle[0].sin_cos();
        let (s1, c1) = if angle[0] == angle[1] { (s0, c0) } else { angle[1].sin_cos() };
        Turned { angle, sin: [s0, s1], cos: [c0, c1] }
    }

    /// Least and greatest height over the interval of a point at `size` from the origin: at its ends, or where the
    /// point is highest or lowest of all, as the sign of its abscissa tells.
    #[inline]
    pub(super) fn heights(&self, p: DVec2, size: f64) -> Extent {
        let y0 = p.x * self.sin[0] + p.y * self.cos[0];
        let y1 = p.x * self.sin[1] + p.y * self.cos[1];
        let x0 = p.x * self.cos[0] - p.y * self.sin[0];
        let x1 = p.x * self.cos[1] - p.y * self.sin[1];
        let mut out = if y0 < y1 { [y0, y1] } else { [y1, y0] };
        if x0 > 0.0 && x1 < 0.0 {
            out[1] = size;
        }
        if x0 < 0.0 && x1 > 0.0 {
            out[0] = -size;
        }
        out
    }

    /// Least and greatest abscissa, likewise.
    #[inline]
    pub(super) fn abscissas(&self, p: DVec2, size: f64) -> Extent {
        self.heights(DVec2::new(-p.y, p.x), size)
    }
}

/// The allowed placements of a case.
#[derive(Clone, Debug)]
pub(super) struct Domain {
    /// Middle of the part, the origin of all that follows [mm].
    pub(super) middle: DVec2,
    /// Corners of the hull of the outline's vertices, with their distance from the origin.
    corners: Vec<(DVec2, f64)>,
    /// Convex arcs of outer loops.
    arcs: Vec<Turn>,
    /// Heights over the centre line between which every point of the outline lies.
    pub(super) reach: Extent,
    /// Least distance of the centre line from the middle of the width.
    off_middle: f64,
    /// Allowed angles, ascending, within [0, 2 pi].
    pub(super) angles: Vec<Extent>,
}

impl Domain {
    pub(super) fn new(case: &FaceCase, options: &Options) -> Domain {
        let [min, max] = case.outline.bounds();
        let middle = 0.5 * (min + max);
        let mut arcs = Vec::new();
        let mut points = Vec::new();
        for one in case.outline.loops().iter().filter(|l| l.outer) {
            for edge in &case.outline.edges()[one.edges.clone()] {
                points.push(edge.start - middle);
                if let Some(turn) = edge.turn.filter(Turn::convex) {
                    arcs.push(Turn { centre: turn.centre - middle, ..turn });
                }
            }
        }
        let reach = case.radius - options.margin;
        let [lo, hi] = options.engagement.map(|a| case.radius * a.sin());
        Domain {
            middle,
            corners: convex_hull(points).into_iter().map(|p| (p, p.length())).collect(),
            arcs,
            reach: [if lo > -reach { lo } else { -reach }, if hi < reach { hi } else { reach }],
            off_middle: options.least_off_middle,
            angles: allowed(&options.forbidden),
        }
    }

    /// The placement of a local offset.
    pub(super) fn placement(&self, angle: f64, local: f64) -> Placement {
        let (sin, cos) = angle.sin_cos();
        let angle = wrap_positive(angle);
        Placement { angle, offset: local + sin * self.middle.x + cos * self.middle.y }
    }

    /// The local offset of a placement.
    pub(super) fn local(&self, placement: Placement) -> f64 {
        let (sin, cos) = placement.angle.sin_cos();
        placement.offset - sin * self.middle.x - cos * self.middle.y
    }

    /// True if an angle is allowed [rad].
    pub(super) fn allows(&self, angle: f64) -> bool {
        let angle = wrap_positive(angle);
        self.angles.iter().any(|a| a[0] <= angle && angle <= a[1])
    }

    /// Least turn, to either side, that makes an angle an allowed one [rad]; infinite if no angle is allowed.
    pub(super) fn turn_to_allowed(&self, angle: f64) -> f64 {
        if self.allows(angle) {
            return 0.0;
        }
        let turns =
            self.angles.iter().flat_map(|a| [wrap_positive(a[0] - angle), wrap_positive(angle - a[1])]);
        turns.fold(f64::INFINITY, |a, b| if b < a { b } else { a })
    }

    /// Angles at which an edge of the hull is parallel to the feed, in [0, 2 pi).
    pub(super) fn hull_angles(&self) -> impl Iterator<Item = f64> + '_ {
        let n = self.corners.len();
        let edges = (0..n).map(move |i| self.corners[(i + 1) % n].0 - self.corners[i].0);
        edges.flat_map(|d| [-d.y.atan2(d.x), PI - d.y.atan2(d.x)]).map(wrap_positive)
    }

    /// Lowest and highest point of the part at an angle.
    pub(super) fn extent(&self, angle: f64) -> Extent {
        let [low, high] = self.extents(&Turned::new([angle, angle]));
        [low[0], high[1]]
    }

    /// The two intervals of local offsets allowed at an angle; each may be empty.
    pub(super) fn offsets(&self, angle: f64) -> [Extent; 2] {
        self.offsets_over(&Turned::new([angle, angle]))
    }

    /// Intervals that hold every local offset allowed at some angle of the interval.
    pub(super) fn offsets_over(&self, turned: &Turned) -> [Extent; 2] {
        let [low, high] = self.extents(turned);
        let whole = [high[0] - self.reach[1], low[1] - self.reach[0]];
        if self.off_middle == 0.0 {
            return [whole, NONE];
        }
        let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
        let (below, above) = (middle[1] - self.off_middle, middle[0] + self.off_middle);
        if below >= above {
            return [whole, NONE];
        }
        [
            [whole[0], if below < whole[1] { below } else { whole[1] }],
            [if above > whole[0] { above } else { whole[0] }, whole[1]],
        ]
    }

    /// Bounds of the lowest and of the highest point's height over an interval of angles.
    fn extents(&self, turned: &Turned) -> [Extent; 2] {
        let mut low = NONE;
        let mut high = [f64::NEG_INFINITY; 2];
        low[1] = f64::INFINITY;
        let mut take = |y: Extent, up: bool, down: bool| {
            for k in 0..2 {
                if up && y[k] > high[k] {
                    high[k] = y[k];
                }
                if down && y[k] < low[k] {
                    low[k] = y[k];
                }
            }
        };
        for &(p, size) in &self.corners {
            take(turned.heights(p, size), true, true);
        }
        for arc in &self.arcs {
            // The highest point of the circle has the polar angle pi/2 - angle in the part.
            let y = turned.heights(arc.centre, arc.centre.length());
            for (side, at) in [(1.0, FRAC_PI_2), (-1.0, -FRAC_PI_2)] {
                let apex = [at - turned.angle[1], at - turned.angle[0]];
                let beyond = [y[0] + side * arc.radius, y[1] + side * arc.radius];
                match covers(arc, apex) {
                    Covers::All => take(beyond, side > 0.0, side < 0.0),
                    // Somewhere in the interval the arc's apex may be the extreme: a bound outwards only.
                    Covers::Some if side > 0.0 => take([f64::NEG_INFINITY, beyond[1]], true, false),
                    Covers::Some => take([beyond[0], f64::INFINITY], false, true),
                    Covers::None => {}
                }
            }
        }
        [low, high]
    }
}

/// The part of an interval of polar angles that an arc passes.
pub(super) enum Covers {
    All,
    Some,
    None,
}

pub(super) fn covers(arc: &Turn, apex: Extent) -> Covers {
    let span = arc.sweep.abs();
    let first = if arc.sweep > 0.0 { arc.from } else { arc.from + arc.sweep };
    let gone = wrap_positive(apex[0] - first);
    let end = gone + (apex[1] - apex[0]);
    if end <= span || span >= TAU {
        Covers::All
    } else if gone <= span || end >= TAU {
        Covers::Some
    } else {
        Covers::None
    }
}

/// The rest of the full turn, as intervals within [0, 2 pi].
fn allowed(forbidden: &[Extent]) -> Vec<Extent> {
    let mut shut: Vec<Extent> = Vec::new();
    for &[from, to] in forbidden {
        let start = wrap_positive(from);
        let end = start + (to - from);
        shut.push([start, if end < TAU { end } else { TAU }]);
        if end > TAU {
            shut.push([0.0, end - TAU]);
        }
    }
    shut.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut open = Vec::new();
    let mut at = 0.0;
    for [from, to] in shut {
        if from >= at && !(from == 0.0 && to > 0.0) {
            open.push([at, from]);
        }
        if to > at {
            at = to;
        }
    }
    if at < TAU {
        open.push([at, TAU]);
    }
    open
}
