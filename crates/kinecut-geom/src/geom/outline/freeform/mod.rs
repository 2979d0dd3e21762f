//! Ellipses and splines as arcs.

mod cusp;

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::OutlineEdge;
use super::contact::distance;
use super::through::{FLAT, arc_through, with_ends};
use crate::base::{Code, Finding, Result};
use crate::geom::biarc_fit::{Walk, arcs_of};
use crate::geom::{CubicSpan, PlanarArc};

/// An arc of an ellipse: `centre + cos(u) major + sin(u) minor`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EllipticArc {
    pub(super) centre: DVec2,
    /// From the centre to the end of a half axis, or of one of two conjugate half diameters [mm].
    pub(super) major: DVec2,
    /// From the centre to the end of the other [mm].
    pub(super) minor: DVec2,
    /// First parameter [rad].
    pub(super) from: f64,
    /// Parameters travelled, signed [rad].
    pub(super) sweep: f64,
}

impl EllipticArc {
    fn point(&self, u: f64) -> DVec2 {
        self.centre + u.cos() * self.major + u.sin() * self.minor
    }

    /// Lines and arcs that leave it by at most `tolerance` [mm]; one arc where it is circular.
    pub(super) fn edges(&self, tolerance: f64) -> Result<Vec<OutlineEdge>> {
        /// Difference of the half axes per size that is rounding of their digits.
        const ROUND: f64 = 1e-9;
        let (a, b) = (self.major.length(), self.minor.length());
        if (a - b).abs() <= ROUND * a && self.major.dot(self.minor).abs() <= ROUND * a * b {
            let hand = self.major.perp_dot(self.minor).signum();
            let from = self.major.to_angle() + hand * self.from;
            return Ok(vec![OutlineEdge::arc(self.centre, a, from, hand * self.sweep)]);
        }
        if !(a > 0.0
            && b > 0.0
            && self.major.perp_dot(self.minor) != 0.0
            && self.major.is_finite()
            && self.minor.is_finite())
        {
            return Err(Finding::error(Code::OUTLINE_EDGE, "an ellipse needs two half axes").into());
        }
        let mut edges = edges_of(arcs_of(self, tolerance)?);
        if self.sweep.abs() >= TAU && !edges.is_empty() {
            let (start, last) = (edges[0].start, edges.len() - 1);
            edges[last] = with_ends(&edges[last], edges[last].start, start);
        }
        Ok(edges)
    }
}

impl Walk for EllipticArc {
    fn ends(&self) -> [f64; 2] {
        [self.from, self.from + self.sweep]
    }

    fn at(&self, u: f64) -> (DVec2, DVec2) {
        let along = (u.cos() * self.minor - u.sin() * self.major) * self.sweep.signum();
        (self.point(u), along.normalize_or(DVec2::X))
    }

    fn length(&self, a: f64, b: f64) -> f64 {
        crate::num::quadrature::gauss(a, b, 0.5, |u| (u.cos() * self.minor - u.sin() * self.major).length())
            .abs()
    }
}

/// A cubic Bezier curve as lines and arcs that leave it by at most `tolerance` [mm]: one line or arc where that is near
/// enough, else tangent arcs.
pub(super) fn cubic_edges(points: [DVec2; 4], tolerance: f64) -> Result<Vec<OutlineEdge>> {
    /// Points at which one arc is measured; the distance of a cubic from it has few extremes.
    const SAMPLES: u32 = 16;
    /// Share of the tolerance for one arc: what the samples may miss, and tangents that do not meet exactly.
    const SHARE: f64 = 0.8;
    let span = CubicSpan::new(points)?;
    let one = arc_through(span.start(), span.point(0.5), span.end());
    let near = (1..SAMPLES).all(|i| {
        let p = span.point(f64::from(i) / f64::from(SAMPLES));
        distance(&one, p) <= SHARE * tolerance
    });
    // A curve that doubles back runs farther than the arc.
    if near && span.start() != span.end() && span.length() <= one.length() + tolerance {
        return Ok(vec![one]);
    }
    match span.arcs(tolerance) {
        Ok(arcs) => Ok(edges_of(arcs)),
        // One that turns back in a cusp is parted there.
        Err(error) => {
            let knots = [[0.0; 4], [1.0; 4]].concat();
            Spline::new(3, knots, &points, &[]).map_err(|_| error)?.edges(tolerance)
        }
    }
}

/// A spline of any degree, rational or not.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spline {
    degree: usize,
    knots: Vec<f64>,
    /// Control points times weight, and weight.
    points: Vec<DVec3>,
}

impl Spline {
    /// Highest degree that any program writes is 25; higher ones are slips.
    const MOST_DEGREE: usize = 25;

    /// A spline of control points [mm] with weights (none: all 1).
    pub(super) fn new(
        degree: usize,
        knots: Vec<f64>,
        points: &[DVec2],
        weights: &[f64],
    ) -> std::result::Result<Spline, &'static str> {
        if !(1..=Spline::MOST_DEGREE).contains(&degree) {
            return Err("its degree is out of range");
        }
        if points.len() <= degree {
            return Err("it has too few control points");
        }
        if knots.len() != points.len() + degree + 1 {
            return Err("its knots do not fit its control points");
        }
        if !knots.is_sorted() || knots.iter().any(|k| !k.is_finite()) {
            return Err("its knots do not rise");
        }
        if !weights.is_empty() && (weights.len() != points.len() || weights.iter().any(|w| !(*w > 0.0))) {
            return Err("its weights are not positive, or not as many as its points");
        }
        let weight = |i: usize| weights.get(i).copied().unwrap_or(1.0);
        let points = points.iter().enumerate().map(|(i, p)| (*p * weight(i)).extend(weight(i))).collect();
        Ok(Spline { degree, knots, points })
    }

    /// Lines and arcs that leave it by at most `tolerance` [mm]; each stretch between knots for itself, so that corners
    /// stay corners; within a stretch it is parted at its cusps. There are none where it is a point.
    pub(super) fn edges(&self, tolerance: f64) -> Result<Vec<OutlineEdge>> {
        let mut edges = Vec::new();
        for k in self.degree..self.points.len() {
            let ends = [self.knots[k], self.knots[k + 1]];
            if ends[0] < ends[1] {
                let stretch = Stretch { spline: self, interval: k, ends };
                if self.degree == 1 {
                    let [a, b] = [0.0, 1.0].map(|t| stretch.point_and_velocity(t)[0]);
                    edges.extend((a != b).then(|| OutlineEdge::line(a, b)));
                    continue;
                }
                for part in cusp::parts(&stretch, tolerance) {
                    edges.extend(edges_of(arcs_of(&part, tolerance)?));
                }
            }
        }
        // Stretches end and begin in the same point but for rounding.
        for i in 1..edges.len() {
            edges[i] = with_ends(&edges[i], edges[i - 1].end, edges[i].end);
        }
        Ok(edges)
    }

    /// Homogeneous point and derivative in a knot interval, by de Boor's scheme.
    fn homogeneous(&self, interval: usize, u: f64) -> [DVec3; 2] {
        let p = self.degree;
        let mut d: Vec<DVec3> = self.points[interval - p..=interval].to_vec();
        let mut derivative = DVec3::ZERO;
        for r in 1..=p {
            for j in (r..=p).rev() {
                let (low, high) = (self.knots[j + interval - p], self.knots[j + 1 + interval - r]);
                let share = (u - low) / (high - low);
                if r == p {
                    derivative = (d[j] - d[j - 1]) * (p as f64 / (high - low));
                }
                d[j] = d[j - 1] * (1.0 - share) + d[j] * share;
            }
        }
        [d[p], derivative]
    }
}

/// A spline between two knots, its parameter from 0 to 1.
struct Stretch<'a> {
    spline: &'a Spline,
    interval: usize,
    ends: [f64; 2],
}

impl Stretch<'_> {
    fn point_and_velocity(&self, t: f64) -> [DVec2; 2] {
        let [a, b] = self.ends;
        let u = if t >= 1.0 { b } else { a + (b - a) * t };
        let [h, dh] = self.spline.homogeneous(self.interval, u);
        let point = h.truncate() / h.z;
        [point, (dh.truncate() - point * dh.z) / h.z * (b - a)]
    }
}

fn edges_of(arcs: Vec<PlanarArc>) -> Vec<OutlineEdge> {
    let edge = |a: PlanarArc| {
        if a.is_line() || a.sweep.abs() < 4.0 * FLAT {
            return OutlineEdge::line(a.start, a.end);
        }
        let (from, radius) = ((a.start - a.centre).to_angle(), a.radius());
        let arc = OutlineEdge::arc(a.centre, radius, from, a.sweep);
        OutlineEdge { start: a.start, end: a.end, ..arc }
    };
    arcs.into_iter().map(edge).collect()
}

#[cfg(test)]
mod tests;
