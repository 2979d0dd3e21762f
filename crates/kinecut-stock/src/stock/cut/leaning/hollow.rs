//! A tool whose edge leaves a core or a nub, on a move along its own axis that leans: what it covers of a line.
//!
//! Over a radius it reaches from the edge there, at the tool's lowest place, up to the top of the tool at its highest; within the
//! inner radius nowhere. On a line these are the places between the radii and below the top, above the edge. Where the line
//! crosses the edge is found between places at which it changes its segment, in steps and by halving.

use glam::DVec3;

use super::super::body::Touch;
use super::super::hollow::{Hollow, left_by};
use super::chord::{LineFrom, roots};
use super::span::{Pose, PoseSpan};
use super::swept::{CoverEnd, StockLine};

/// Way across the axis up to which a tool goes along it [mm]: what coordinates rounded to a micrometre explain.
const ALONG: f64 = 2e-3;

/// Steps in which a crossing of the edge is looked for between two places.
const STEPS: u32 = 16;

/// Distance from all other faces above which an end lies on a step between two segments [mm].
const BESIDE: f64 = 1e-5;

/// Accuracy of a crossing [mm].
const CLOSE: f64 = 1e-7;

/// A hollow tool over a span of a move along its axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plunge<'a> {
    hollow: &'a Hollow,
    /// The tool at its lowest place.
    pose: Pose,
    /// Height of the highest above the lowest [mm].
    rise: f64,
    /// Parameter of the span at the lowest place, and at the highest.
    times: [f64; 2],
    /// Way across the axis, which is left out [mm].
    pub(super) across: f64,
}

impl Plunge<'_> {
    /// A span as one along the axis; `None` when the tool moves across it or turns.
    pub(super) fn of<'a>(hollow: &'a Hollow, span: &PoseSpan) -> Option<Plunge<'a>> {
        let [a, b] = [-0.5, 0.5].map(|t| span.at(t));
        let way = b.tip - a.tip;
        let rise = way.dot(a.axis);
        let across = (way - a.axis * rise).length();
        let straight = a.axis == b.axis && across + span.bend(0.0) <= ALONG && across <= rise.abs();
        let (pose, times) = if rise >= 0.0 { (a, [-0.5, 0.5]) } else { (b, [0.5, -0.5]) };
        straight.then_some(Plunge { hollow, pose, rise: rise.abs(), times, across })
    }

    /// Calls for each stretch of a line that is covered, with its ends; all faces moved inwards by `clearance` [mm].
    pub(super) fn covers(&self, line: &StockLine, clearance: f64, mut found: impl FnMut([CoverEnd; 2])) {
        let seen = Seen { of: self, from: LineFrom::new(line.start, line.along, &self.pose), clearance };
        let heights = [self.hollow.lowest(), self.rise + self.hollow.top];
        let Some(within) = seen.from.within(line.material, self.hollow.outer(), heights) else { return };
        let places = seen.places(within);
        let mut begin: Option<f64> = None;
        // Between two segments that join lies nothing but rounding.
        for pair in places.windows(2).filter(|pair| pair[1] - pair[0] > 10.0 * CLOSE) {
            let inside = seen.inside(0.5 * (pair[0] + pair[1])) > 0.0;
            match (inside, begin) {
                (true, None) => begin = Some(pair[0]),
                (false, Some(from)) => {
                    found([seen.end(from), seen.end(pair[0])]);
                    begin = None;
                }
                _ => {}
            }
        }
        if let (Some(from), Some(last)) = (begin, places.last()) {
            found([seen.end(from), seen.end(*last)]);
        }
    }

    /// The stretch of a line within the inner radius, where nothing cuts.
    pub(super) fn core(&self, line: &StockLine, clearance: f64) -> Option<[f64; 2]> {
        let from = LineFrom::new(line.start, line.along, &self.pose);
        let heights = [clearance, self.rise + self.hollow.top - clearance];
        from.within(line.material, self.hollow.inner() - clearance, heights)
    }
}

/// A line, seen from a plunge.
struct Seen<'a> {
    of: &'a Plunge<'a>,
    from: LineFrom,
    clearance: f64,
}

impl Seen<'_> {
    /// The place above the edge and within the radii, by the least of its distances [mm]; negative outside.
    fn inside(&self, s: f64) -> f64 {
        let (rho, z) = self.from.place(s);
        let hollow = self.of.hollow;
        let clear = self.clearance;
        let below = self.of.rise + hollow.top - clear - z;
        let outer = hollow.outer() - clear - rho;
        let inner = if hollow.inner() > 0.0 { rho - hollow.inner() - clear } else { f64::INFINITY };
        let foot = if clear > 0.0 { hollow.touches(rho, clear) } else { hollow.reach(rho).map(|r| r.height) };
        let over = foot.map_or(f64::NEG_INFINITY, |height| z - height);
        below.min(outer).min(inner).min(over)
    }

    /// Places on a line between which it is inside throughout, or outside.
    fn places(&self, [low, high]: [f64; 2]) -> Vec<f64> {
        let hollow = self.of.hollow;
        let [a, b, c] = self.from.square();
        let [height, rise] = self.from.heights();
        let mut marks = vec![low, high];
        if a > 0.0 {
            marks.push(-b / a);
            let clear = [-self.clearance, 0.0, self.clearance];
            let radii = hollow.radii().flat_map(|r| clear.map(|by| r + by)).filter(|r| *r > 0.0);
            for (x, y) in radii.filter_map(|r| roots(a, b, c - r * r)) {
                marks.extend([x, y]);
            }
        }
        if rise != 0.0 {
            marks.push((self.of.rise + hollow.top - self.clearance - height) / rise);
        }
        marks.retain(|s| *s >= low && *s <= high);
        marks.sort_by(f64::total_cmp);
        marks.dedup();
        let mut places = Vec::with_capacity(2 * marks.len());
        for pair in marks.windows(2) {
            // Inwards, where the edge is the one between the marks.
            let (from, to) = (pair[0] + CLOSE, pair[1] - CLOSE);
            places.push(pair[0]);
            if !(to > from) {
                continue;
            }
            let at = |k: u32| from + (to - from) * f64::from(k) / f64::from(STEPS);
            for k in 0..STEPS {
                let (mut x, mut y) = (at(k), at(k + 1));
                let first = self.inside(x) > 0.0;
                if first == (self.inside(y) > 0.0) {
                    continue;
                }
                while y - x > CLOSE {
                    let middle = 0.5 * (x + y);
                    if (self.inside(middle) > 0.0) == first { x = middle } else { y = middle }
                }
                places.push(0.5 * (x + y));
            }
        }
        places.extend(marks.last());
        places
    }

    /// The end of a stretch: by the nearest face.
    fn end(&self, s: f64) -> CoverEnd {
        let (rho, z) = self.from.place(s);
        let hollow = self.of.hollow;
        let far = |d: f64| d.abs();
        let top = far(self.of.rise + hollow.top - self.clearance - z);
        let (outer, inner) = (far(hollow.outer() - rho), far(rho - hollow.inner()));
        let reach = hollow.reach(rho);
        let foot = reach.map_or(f64::INFINITY, |r| far(z - r.height) / r.slope.hypot(1.0));
        let least = top.min(outer).min(inner).min(foot);
        let height = |by: f64| hollow.reach(rho + by).map_or(f64::INFINITY, |r| r.height);
        let (gradient, touch, time) = if least > BESIDE {
            // A step between two segments: the tool is on the side on which the edge is the lower.
            (((height(BESIDE) - height(-BESIDE)).signum(), 0.0), Touch::Rim, 0)
        } else if least == top {
            ((0.0, 1.0), Touch::Top, 1)
        } else if least == foot {
            let (radial, axial) = reach.map_or((0.0, 1.0), |r| left_by(r.slope));
            ((-radial, -axial), Touch::Foot, 0)
        } else if least == outer {
            ((1.0, 0.0), Touch::Rim, 0)
        } else {
            ((-1.0, 0.0), Touch::Rim, 0)
        };
        let normal = self.from.normal(s, rho, gradient);
        CoverEnd { s, t: self.of.times[time], normal: normal.try_normalize().unwrap_or(DVec3::Z), touch }
    }
}
