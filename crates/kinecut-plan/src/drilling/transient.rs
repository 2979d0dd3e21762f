//! The Z interval over which a cutting edge passes a surface, exactly: every place at which the extremum can lie is
//! looked at, no sampling.
//!
//! Notation: S(u) height of the surface, z(r) height of the edge, X = |offset|, F(u) = sqrt(RS^2 - u^2). On the circle
//! of radius r the extremes of S are known, so the search runs over r alone: ends of segments, the kinks r = X and
//! r = RS - X of a cylinder, and the stationary points of each pair of segment and surface. An extra candidate does no harm.

use super::BoundarySurface;
use crate::base::{Code, Finding, Result};
use crate::geom::{EdgeProfile, EdgeSegment};

/// Z interval in which a cutting edge passes one surface: Z of the tool's reference point [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transient {
    /// First contact of an entry, first break-through of an exit: the greatest S - z.
    pub first: f64,
    /// All of the edge is inside, or the last of it is out: the least S - z.
    pub last: f64,
    /// Radius of the edge that touches first; of equals the least.
    pub first_radius: f64,
    /// Radius of the edge that passes last; of equals the greatest.
    pub last_radius: f64,
}

/// The part of the edge's disc that a cylinder must cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cover {
    /// All of it: otherwise the hole opens sideways.
    Whole,
    /// Any part: a cross bore off the tool axis.
    Part,
}

/// Largest reach of a disc beyond a cylinder that is rounding [mm].
const ROUNDING: f64 = 1e-9;
/// Values of S - z nearer than this are equal [mm]: ties, as in a cylinder touched all along a circle.
const TIE: f64 = 1e-10;

/// The transient of an edge at a surface.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::drilling::{Cover, BoundarySurface, transient};
/// use kinecut::tool::DrillPoint;
/// let edge = DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(20.0).unwrap();
/// // Out of a shaft of 80 mm: the rim passes the lowest line of the shaft last, 6.0086 mm below it.
/// let t = transient(&edge, &BoundarySurface::Valley { radius: 40.0, offset: 0.0, height: 0.0 }, Cover::Whole).unwrap();
/// assert!((t.first - -40.0).abs() < 1e-12 && (t.last - -46.008606).abs() < 1e-6);
/// ```
///
/// # Errors
/// `KC0902` when the disc reaches beyond the cylinder ([`Cover::Whole`]) or does not meet it at all.
pub fn transient(edge: &EdgeProfile, surface: &BoundarySurface, cover: Cover) -> Result<Transient> {
    let mut search = Search::new();
    match *surface {
        BoundarySurface::Plane { height, slope } => {
            let t = slope.abs();
            for segment in edge.segments() {
                let [a, b] = segment.range();
                let mut at = |r: f64| {
                    if r >= a && r <= b {
                        let z = segment.height(r);
                        search.note(height + r * t - z, height - r * t - z, r);
                    }
                };
                at(a);
                at(b);
                if let EdgeSegment::Arc { centre, radius, .. } = *segment {
                    let s = radius * t / (t * t + 1.0).sqrt();
                    at(centre[0] + s);
                    at(centre[0] - s);
                }
            }
        }
        BoundarySurface::Ridge { radius, offset, height } => {
            cylinder(edge, radius, offset, cover, &mut search, |near, far| [near, far])?;
            search.shift(height);
        }
        BoundarySurface::Valley { radius, offset, height } => {
            cylinder(edge, radius, offset, cover, &mut search, |near, far| [-far, -near])?;
            search.shift(height);
        }
    }
    Ok(search.found)
}

/// The candidates of a cylinder. `sides` gives the greatest and least height on a circle from F at its nearest and
/// farthest distance from the cylinder's axis.
fn cylinder(
    edge: &EdgeProfile,
    radius: f64,
    offset: f64,
    cover: Cover,
    search: &mut Search,
    sides: impl Fn(f64, f64) -> [f64; 2],
) -> Result<()> {
    let x = offset.abs();
    let reach = x + edge.outer_radius();
    let least = x - radius;
    if cover == Cover::Whole && reach > radius + ROUNDING {
        return Err(Finding::error(
            Code::DRILL_SURFACE,
            "the hole opens sideways: the drill reaches beyond the cylinder",
        )
        .value_mm(reach)
        .bound_mm(radius)
        .help("move the hole towards the cylinder's axis, or use a smaller drill")
        .key("offset")
        .into());
    }
    if least >= edge.outer_radius() {
        return Err(Finding::error(Code::DRILL_SURFACE, "the drill passes beside the cylinder")
            .value_mm(x)
            .bound_mm(radius + edge.outer_radius())
            .key("offset")
            .into());
    }
    let f = |u: f64| ((radius - u) * (radius + u)).clamp(0.0, f64::INFINITY).sqrt();
    for segment in edge.segments() {
        let [a, b] = segment.range();
        let from = if least > a { least } else { a };
        let line =
            if let EdgeSegment::Line { z, .. } = *segment { Some((z[0], segment.slope(a))) } else { None };
        let mut at = |r: f64| {
            if r >= from && r <= b {
                let near = if x > r { x - r } else { 0.0 };
                let far = if x + r < radius { x + r } else { radius };
                let z = match line {
                    Some((z0, k)) => z0 + k * (r - a),
                    None => segment.height(r),
                };
                let [greatest, lowest] = sides(f(near), f(far));
                search.note(greatest - z, lowest - z, r);
            }
        };
        at(from);
        at(b);
        at(x);
        // The far side of a bore that is narrower than the disc: farther out its height stays what it is there.
        at(radius - x);
        match *segment {
            EdgeSegment::Line { .. } => {
                let k = line.map_or(0.0, |(_, k)| k);
                let q = radius * k / (k * k + 1.0).sqrt();
                for r in [x - q, x + q, q - x, -q - x] {
                    at(r);
                }
            }
            EdgeSegment::Arc { centre: [rc, _], radius: rho, .. } => {
                at(rc);
                at((x * rho + rc * radius) / (radius + rho));
                if radius != rho {
                    at((x * rho + rc * radius) / (radius - rho));
                    at((rc * radius - x * rho) / (radius - rho));
                }
            }
        }
    }
    Ok(())
}

/// The greatest and least values so far.
pub(super) struct Search {
    pub(super) found: Transient,
}

impl Search {
    pub(super) fn new() -> Search {
        Search {
            found: Transient {
                first: f64::NEG_INFINITY,
                last: f64::INFINITY,
                first_radius: f64::INFINITY,
                last_radius: f64::NEG_INFINITY,
            },
        }
    }

    /// Notes the greatest and least S - z on the circle of radius r.
    #[inline]
    pub(super) fn note(&mut self, greatest: f64, least: f64, r: f64) {
        let t = &mut self.found;
        if greatest > t.first + TIE || greatest > t.first - TIE && r < t.first_radius {
            t.first_radius = r;
        }
        if greatest > t.first {
            t.first = greatest;
        }
        if least < t.last - TIE || least < t.last + TIE && r > t.last_radius {
            t.last_radius = r;
        }
        if least < t.last {
            t.last = least;
        }
    }

    fn shift(&mut self, height: f64) {
        self.found.first += height;
        self.found.last += height;
    }
}
