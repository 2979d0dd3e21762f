//! Lengths of grazing curves.
//!
//! Edges, discs, spheres and translations have closed forms; other segments are integrated in the parameter that takes the
//! square roots out of both ends.

use glam::DVec3;

use super::branch::turn_between;
use super::{Grazing, GrazingLoop, GrazingSpan, SegmentKind};
use crate::num::quadrature::gauss;
use crate::sweep::normal_velocity::PieceVelocity;
use crate::sweep::{GrazingBranch, PieceShape, ProfileChain};

/// Relative change of a length below which more panels are not tried.
const SAME: f64 = 1e-12;
/// Most panels.
const MOST_PANELS: u32 = 256;
/// Sine of the angle between two vectors that are one line but for rounding.
const PARALLEL: f64 = 1e-12;
/// Steps in which an edge is followed, so that none turns by half a circle.
const EDGE_STEPS: u32 = 16;

impl ProfileChain {
    /// Length of a curve [mm].
    pub fn loop_length(&self, grazing: &Grazing, of: &GrazingLoop) -> f64 {
        let spans = &grazing.spans[of.spans.clone()];
        spans.iter().map(|span| self.span_lengths(span).iter().sum::<f64>()).sum()
    }

    /// Lengths of both branches of a span [mm], relative accuracy 1e-12.
    pub fn span_lengths(&self, span: &GrazingSpan) -> [f64; 2] {
        let piece = &self.pieces()[span.piece];
        match (span.kind, piece.shape) {
            (SegmentKind::Generator, _) => [(span.to - span.from).abs(); 2],
            (SegmentKind::DiscChord, PieceShape::Line { start, tangent, .. }) => {
                let length = self.chord(span, start.x, tangent.x);
                [length; 2]
            }
            (SegmentKind::EdgeArc | SegmentKind::Join, _) => {
                let radius = piece.point(span.from).x;
                GrazingBranch::BOTH.map(|branch| radius * edge_turn(span, branch).abs())
            }
            (SegmentKind::SphereArc, PieceShape::Arc { radius, .. }) => {
                let ends = [0.0, 1.0].map(|t| self.grazing_points(span, t));
                [0, 1].map(|i| radius.abs() * angle(ends[0][i].normal, ends[1][i].normal))
            }
            _ => GrazingBranch::BOTH.map(|branch| self.integrated(span, branch)),
        }
    }

    /// A chord of a disc between two distances from the axis: its middle has the distance at the fold.
    fn chord(&self, span: &GrazingSpan, start: f64, slope: f64) -> f64 {
        let n = span.velocity.slope(span.from).across.length();
        let away = span.velocity.at(span.from).mean.abs() / n;
        let reach = |u: f64, fold: bool| {
            let x = start + slope * u;
            if fold { 0.0 } else { ((x - away) * (x + away)).max(0.0).sqrt() }
        };
        (reach(span.to, span.folds[1]) - reach(span.from, span.folds[0])).abs()
    }

    fn integrated(&self, span: &GrazingSpan, branch: GrazingBranch) -> f64 {
        let piece = &self.pieces()[span.piece];
        let index = usize::from(branch == GrazingBranch::Minus);
        let speed = |t: f64| {
            let (u, way) = span.parameter(t);
            let (p, _, turn) = piece.place(u);
            let along = match piece.shape {
                PieceShape::Line { .. } => 1.0,
                PieceShape::Arc { radius, .. } => radius.abs(),
            };
            // d theta / d u = -F_u / F_theta, where F_theta is the root with the sign of the branch, reversed.
            let e = span.directions(t, u, way, turn)[index];
            let root = span.root(t, way, &span.velocity.with(u, turn));
            let slope = span.velocity.slope(u);
            let rise = slope.across.dot(e) + slope.mean;
            let about = if rise == 0.0 { 0.0 } else { p.x * rise / root };
            along.hypot(about) * span.pace(t).abs()
        };
        let mut panels = 4;
        let mut length = gauss(0.0, 1.0, 1.0 / f64::from(panels), speed);
        while panels < MOST_PANELS {
            panels *= 2;
            let finer = gauss(0.0, 1.0, 1.0 / f64::from(panels), speed);
            let same = (finer - length).abs() <= SAME * finer.max(1.0);
            length = finer;
            if same {
                break;
            }
        }
        length
    }
}

/// Angle by which a branch turns about the axis on an edge [rad].
fn edge_turn(span: &GrazingSpan, branch: GrazingBranch) -> f64 {
    if let PieceVelocity::Arc { axial: 0.0, .. } = span.velocity {
        // Both points lie square to the amplitude, which turns by less than half a circle; one that shrinks to nothing
        // and comes back reversed has left a whole circle there, which is listed apart.
        let [a, b] = [span.from, span.to].map(|u| span.velocity.at(u).across);
        let parallel = a.perp_dot(b).abs() <= PARALLEL * a.length() * b.length();
        return if parallel { 0.0 } else { turn_between(a, b) };
    }
    let mut turn = 0.0;
    let mut before = None;
    for k in 0..=EDGE_STEPS {
        let t = f64::from(k) / f64::from(EDGE_STEPS);
        let (u, way) = span.parameter(t);
        let e = span.directions(t, u, way, u.sin_cos())[usize::from(branch == GrazingBranch::Minus)];
        turn += before.map_or(0.0, |b| turn_between(b, e));
        before = Some(e);
    }
    turn
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}
