//! A tool whose edge leaves material within its filled body: a core, the nub under a gun drill.
//!
//! It is no union of convex parts. Along its axis it goes through material as it is: over a radius it reaches down to
//! the edge there, and within the inner radius nowhere. A section across the axis is a set of rings, found in closed
//! form. If it moves across its axis it is cut as filled (`body.rs`), and the move's effect says so.

use glam::DVec2;

use super::face::{Station, SweptFace};
use super::plan::Plan;
use crate::geom::{EdgeProfile, EdgeSegment, Profile};

/// Sideways way [mm] up to which a move counts as one along the axis: a tenth of an end point's rounding.
const SIDEWAYS: f64 = 1e-6;

/// Gap of two rings that is rounding [mm]: as neighbouring segments of an edge may be apart.
const JOINED: f64 = 1e-9;

/// An edge that differs from its filled body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hollow {
    edge: EdgeProfile,
    /// Height of the top above the tip [mm].
    pub(super) top: f64,
}

/// The edge over a radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    /// Height above the tip [mm].
    pub(super) height: f64,
    /// Rise per radius.
    pub(super) slope: f64,
    /// Segment of the edge.
    pub(super) segment: usize,
}

/// A border of a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Border {
    /// Radius [mm].
    pub(super) r: f64,
    /// Radial and axial component of the normal of the material left there.
    pub(super) normal: (f64, f64),
    pub(super) face: SweptFace,
    pub(super) segment: usize,
}

/// A ring of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ring {
    pub(super) inner: Border,
    pub(super) outer: Border,
}

impl Hollow {
    /// The edge of a tool up to the height `top`; `None` when its filled body is all of it.
    pub(super) fn new(edge: &EdgeProfile, top: f64) -> Option<Hollow> {
        let mut least = edge.segments()[0].height(edge.inner_radius());
        let mut hollow = edge.inner_radius() > 0.0;
        for s in edge.segments() {
            let [a, b] = s.range();
            let falls = match *s {
                EdgeSegment::Line { z, .. } => z[1] < z[0],
                EdgeSegment::Arc { centre, .. } => centre[0] > a,
            };
            hollow |= falls || s.height(a) < least - JOINED;
            least = s.height(b);
        }
        hollow.then_some(Hollow { edge: *edge, top })
    }

    /// The radius within which nothing cuts [mm].
    pub(super) fn inner(&self) -> f64 {
        self.edge.inner_radius()
    }

    /// The cylinder above the highest place of the edge, with its height above the tip; nothing where a core stays.
    pub(super) fn above_all(&self) -> Option<(Profile, f64)> {
        let highest = self.edge.extent()[1];
        let profile = Profile::cylinder(2.0 * self.outer(), self.top - highest).ok()?;
        (self.inner() == 0.0).then_some((profile, highest))
    }

    /// Radii at which a segment begins or ends [mm].
    pub(super) fn radii(&self) -> impl Iterator<Item = f64> {
        self.edge.segments().iter().flat_map(|s| s.range())
    }

    /// Height of the lowest place of the edge above the tip [mm].
    pub(super) fn lowest(&self) -> f64 {
        self.edge.extent()[0]
    }

    /// Largest radius [mm].
    pub(super) fn outer(&self) -> f64 {
        self.edge.outer_radius()
    }

    /// The lowest edge over a radius; `None` where nothing cuts.
    pub(super) fn reach(&self, rho: f64) -> Option<Reach> {
        let mut best: Option<Reach> = None;
        for (segment, s) in self.edge.segments().iter().enumerate() {
            let [a, b] = s.range();
            if rho >= a && rho <= b {
                let height = s.height(rho);
                if best.is_none_or(|r| height < r.height) {
                    best = Some(Reach { height, slope: s.slope(rho), segment });
                }
            }
        }
        best
    }

    /// Highest edge within `clearance` of a radius, raised by it: what certainly touches [mm]. `None` outside the edge
    /// and less than the clearance inside it.
    pub(super) fn touches(&self, rho: f64, clearance: f64) -> Option<f64> {
        let (from, to) = (rho - clearance, rho + clearance);
        if from < self.inner() && self.inner() > 0.0 || to > self.outer() {
            return None;
        }
        let mut highest: Option<f64> = None;
        for s in self.edge.segments() {
            let [a, b] = s.range();
            let (from, to) = (if from > a { from } else { a }, if to < b { to } else { b });
            if from <= to {
                // The edge of a segment is convex: highest at an end.
                for z in [s.height(from), s.height(to)] {
                    highest = Some(highest.map_or(z, |h| if z > h { z } else { h }));
                }
            }
        }
        highest.map(|h| h + clearance)
    }

    /// The rings of the section at a height above the tip, from the axis outwards.
    pub(super) fn rings(&self, h: f64, station: Station, rings: &mut Vec<Ring>) {
        rings.clear();
        for (segment, s) in self.edge.segments().iter().enumerate() {
            let [a, b] = s.range();
            let Some((from, to)) = below(s, h) else { continue };
            let border = |r: f64, inner: bool| {
                if r > a && r < b {
                    let normal = left_by(s.slope(r));
                    Border { r, normal, face: SweptFace::side(true, station, false), segment }
                } else {
                    let side = if inner { 1.0 } else { -1.0 };
                    // The outer side of a segment and its inner one are two faces.
                    let at = if inner { Station::Start } else { Station::End };
                    Border { r, normal: (side, 0.0), face: SweptFace::side(false, at, false), segment }
                }
            };
            let new = Ring { inner: border(from, true), outer: border(to, false) };
            match rings.last_mut() {
                Some(last) if new.inner.r - last.outer.r <= JOINED => last.outer = new.outer,
                _ => rings.push(new),
            }
        }
    }
}

/// Radial and axial component of the normal of the material that an edge of a slope leaves.
pub(super) fn left_by(slope: f64) -> (f64, f64) {
    if slope.is_infinite() {
        return (-1f64.copysign(slope), 0.0);
    }
    let length = slope.hypot(1.0);
    (-slope / length, 1.0 / length)
}

/// The radii of a segment that lie at or below a height.
fn below(segment: &EdgeSegment, h: f64) -> Option<(f64, f64)> {
    let [a, b] = segment.range();
    let (from, to) = match *segment {
        EdgeSegment::Line { z: [za, zb], .. } => {
            let cross = || (a + (b - a) * ((h - za) / (zb - za))).clamp(a, b);
            match (za <= h, zb <= h) {
                (true, true) => (a, b),
                (true, false) => (a, cross()),
                (false, true) => (cross(), b),
                (false, false) => return None,
            }
        }
        EdgeSegment::Arc { centre, radius, .. } => {
            let depth = centre[1] - h;
            if depth <= 0.0 {
                return Some((a, b));
            }
            // NaN when the height lies below the circle.
            let half = ((radius - depth) * (radius + depth)).sqrt();
            let (from, to) = (centre[0] - half, centre[0] + half);
            (if from > a { from } else { a }, if to < b { to } else { b })
        }
    };
    (from < to).then_some((from, to))
}

/// Place across the axis of a tool that moves along its axis [mm]; `None` when it moves across it.
pub(super) fn standing(plan: &Plan) -> Option<DVec2> {
    match plan {
        Plan::Dot(p) => Some(*p),
        Plan::Line(line) if line.length <= SIDEWAYS => Some(line.start + line.way * 0.5),
        Plan::Line(_) | Plan::Arc(_) => None,
    }
}
