//! A pen that draws subpaths in user units and leaves lines and arcs [mm].

use std::f64::consts::{PI, TAU};

use glam::{DAffine2, DVec2};

use crate::base::{Code, Finding, Result};
use crate::geom::outline::OutlineEdge;
use crate::geom::outline::freeform::{EllipticArc, cubic_edges};
use crate::geom::outline::through::with_ends;

/// Distance at which points are the same [mm]: below the last digit of drawings.
const SAME: f64 = 1e-7;

/// A subpath.
pub(super) enum Subpath {
    Closed(Vec<OutlineEdge>),
    Open(Vec<OutlineEdge>),
}

/// The pen.
pub(super) struct Pen {
    /// User units to mm.
    affine: DAffine2,
    tolerance: f64,
    edges: Vec<OutlineEdge>,
    start: DVec2,
    here: DVec2,
    done: Vec<Subpath>,
    /// Number of curves replaced by lines and arcs.
    pub(super) converted: usize,
}

impl Pen {
    pub(super) fn new(affine: DAffine2, tolerance: f64) -> Pen {
        Pen {
            affine,
            tolerance,
            edges: Vec::new(),
            start: DVec2::ZERO,
            here: DVec2::ZERO,
            done: Vec::new(),
            converted: 0,
        }
    }

    /// Its position [user units].
    pub(super) fn here(&self) -> DVec2 {
        self.here
    }

    fn mm(&self, p: DVec2) -> DVec2 {
        self.affine.transform_point2(p)
    }

    /// Ends the subpath and begins another.
    pub(super) fn move_to(&mut self, p: DVec2) {
        self.lift();
        (self.start, self.here) = (p, p);
    }

    /// A line.
    pub(super) fn line_to(&mut self, p: DVec2) {
        let (a, b) = (self.mm(self.here), self.mm(p));
        // A line shorter than the last digit only moves the pen; the next edge begins where this one did.
        if a.distance(b) > SAME {
            self.push(vec![OutlineEdge::line(a, b)]);
        }
        self.here = p;
    }

    /// A cubic Bezier curve.
    pub(super) fn cubic_to(&mut self, p1: DVec2, p2: DVec2, p: DVec2) -> Result<()> {
        let points = [self.here, p1, p2, p].map(|p| self.mm(p));
        self.here = p;
        if points.iter().all(|q| q.distance(points[0]) <= SAME) {
            return Ok(());
        }
        let edges = cubic_edges(points, self.tolerance)?;
        self.converted += usize::from(edges.iter().any(|e| e.turn.is_some()));
        self.push(edges);
        Ok(())
    }

    /// A quadratic Bezier curve.
    pub(super) fn quadratic_to(&mut self, p1: DVec2, p: DVec2) -> Result<()> {
        let from = self.here;
        self.cubic_to(from.lerp(p1, 2.0 / 3.0), p.lerp(p1, 2.0 / 3.0), p)
    }

    /// An elliptic arc given by its end, half axes [user units] and their turn [rad].
    ///
    /// Source: SVG 1.1 (2011), F.6.5 and F.6.6.
    pub(super) fn arc_to(
        &mut self,
        axes: DVec2,
        turn: f64,
        large: bool,
        positive: bool,
        p: DVec2,
    ) -> Result<()> {
        let from = self.here;
        let (mut rx, mut ry) = (axes.x.abs(), axes.y.abs());
        if from == p {
            return Ok(());
        }
        if rx == 0.0 || ry == 0.0 {
            self.line_to(p);
            return Ok(());
        }
        let local = DVec2::from_angle(-turn).rotate(0.5 * (from - p));
        let q = DVec2::new(local.x / rx, local.y / ry);
        // Half axes too short for the ends grow until they are not.
        let short = q.length();
        let grow = if short > 1.0 { short } else { 1.0 };
        (rx, ry) = (rx * grow, ry * grow);
        let q = q / grow;
        let aside = ((1.0 - q.length_squared()).max(0.0) / q.length_squared()).sqrt();
        let centre = if large == positive { aside * q.perp() } else { -aside * q.perp() };
        let (a, b) = (q - centre, -q - centre);
        let mut sweep = a.angle_to(b);
        if positive && sweep < 0.0 {
            sweep += TAU;
        } else if !positive && sweep > 0.0 {
            sweep -= TAU;
        }
        let axis = |v: DVec2| self.affine.transform_vector2(DVec2::from_angle(turn).rotate(v));
        let middle =
            DVec2::from_angle(turn).rotate(DVec2::new(centre.x * rx, centre.y * ry)) + 0.5 * (from + p);
        let arc = EllipticArc {
            centre: self.mm(middle),
            major: axis(DVec2::new(rx, 0.0)),
            minor: axis(DVec2::new(0.0, ry)),
            from: a.to_angle(),
            sweep,
        };
        self.elliptic(arc)?;
        let end = self.mm(p);
        if let Some(last) = self.edges.last_mut() {
            *last = with_ends(last, last.start, end);
        }
        self.here = p;
        Ok(())
    }

    /// A whole ellipse, as a loop of its own [user units].
    pub(super) fn ellipse(&mut self, centre: DVec2, axes: DVec2) -> Result<()> {
        self.lift();
        let arc = EllipticArc {
            centre: self.mm(centre),
            major: self.affine.transform_vector2(DVec2::new(axes.x, 0.0)),
            minor: self.affine.transform_vector2(DVec2::new(0.0, axes.y)),
            from: 0.0,
            sweep: TAU,
        };
        let edges = arc.edges(self.tolerance)?;
        self.converted += usize::from(edges.len() > 1);
        self.done.push(Subpath::Closed(edges));
        Ok(())
    }

    fn elliptic(&mut self, arc: EllipticArc) -> Result<()> {
        if !arc.sweep.is_finite() || arc.sweep.abs() > TAU + PI {
            return Err(Finding::error(Code::OUTLINE_EDGE, "an arc has numbers that are not finite").into());
        }
        let edges = arc.edges(self.tolerance)?;
        self.converted += usize::from(edges.len() > 1);
        self.push(edges);
        Ok(())
    }

    /// Adds edges; the first is made to begin where the last one ended.
    fn push(&mut self, mut edges: Vec<OutlineEdge>) {
        if let (Some(last), Some(first)) = (self.edges.last(), edges.first_mut()) {
            *first = with_ends(first, last.end, first.end);
        }
        self.edges.extend(edges);
    }

    /// Closes the subpath.
    pub(super) fn close(&mut self) {
        if !self.edges.is_empty() {
            let (first, last) = (self.edges[0].start, self.edges[self.edges.len() - 1].end);
            if first.distance(last) > SAME {
                self.edges.push(OutlineEdge::line(last, first));
            } else if let Some(edge) = self.edges.last_mut() {
                *edge = with_ends(edge, edge.start, first);
            }
            self.done.push(Subpath::Closed(std::mem::take(&mut self.edges)));
        }
        self.here = self.start;
    }

    fn lift(&mut self) {
        if let (Some(first), Some(last)) = (self.edges.first(), self.edges.last()) {
            // A subpath of one line does not return.
            if first.start.distance(last.end) <= SAME && self.edges.len() > 1 {
                self.close();
            } else {
                self.done.push(Subpath::Open(std::mem::take(&mut self.edges)));
            }
        }
    }

    /// The subpaths drawn.
    pub(super) fn finish(mut self) -> Vec<Subpath> {
        self.lift();
        self.done
    }
}
