//! Points of the grazing curve.

use glam::{DVec2, DVec3};

use super::{Grazing, GrazingLoop, GrazingSpan};
use crate::sweep::{ChainPiece, GrazingBranch, NormalVelocity, ProfileChain};

/// A point of the grazing curve, in coordinates of the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrazingPoint {
    /// Piece of the chain.
    pub piece: u32,
    /// Branch: one of the two points of its parallel circle.
    pub branch: GrazingBranch,
    /// Parameter on the piece: way along a line [mm], normal angle of an arc [rad].
    pub u: f64,
    /// Place [mm].
    pub point: DVec3,
    /// Outward unit normal.
    pub normal: DVec3,
}

impl GrazingPoint {
    /// Angle about the axis [rad], of a point on the axis that of its normal.
    pub fn theta(&self) -> f64 {
        match self.point.truncate() == DVec2::ZERO {
            true => self.normal.y.atan2(self.normal.x),
            false => self.point.y.atan2(self.point.x),
        }
    }
}

impl GrazingSpan {
    /// The parameter at a part `t` of the span, from 0 to 1. It starts and ends with the square of the part, so that the curve is
    /// smooth in parts at folds too. Second: the way from the nearer end.
    pub(super) fn parameter(&self, t: f64) -> (f64, f64) {
        let length = self.to - self.from;
        if t <= 0.5 {
            let way = length * t * t * (3.0 - 2.0 * t);
            (self.from + way, way)
        } else {
            let s = 1.0 - t;
            let way = -length * s * s * (3.0 - 2.0 * s);
            (self.to + way, way)
        }
    }

    /// Change of the parameter by the part.
    pub(super) fn pace(&self, t: f64) -> f64 {
        6.0 * (self.to - self.from) * t * (1.0 - t)
    }

    /// The root of the discriminant at a part of the span, where the normal velocity is known.
    pub(super) fn root(&self, t: f64, way: f64, velocity: &NormalVelocity) -> f64 {
        let fold =
            if t <= 0.5 { self.folds[0].then_some(self.from) } else { self.folds[1].then_some(self.to) };
        let d = match fold {
            Some(fold) => self.discriminant.beside(fold, way),
            None => velocity.discriminant(),
        };
        d.max(0.0).sqrt()
    }

    /// The unit vectors across the axis to both points at a part of the span, plus branch first.
    pub(super) fn directions(&self, t: f64, u: f64, way: f64, turn: (f64, f64)) -> [DVec2; 2] {
        let velocity = self.velocity.with(u, turn);
        let size = velocity.across.length_squared();
        let still = STILL * self.velocity.slope_size() * (self.to - self.from).abs();
        if size > still * still {
            let root = self.root(t, way, &velocity);
            return velocity.directions(root);
        }
        // The whole circle is still: the curve comes to it as it is a little further inside.
        let middle = 0.5 * (self.from + self.to);
        let inside = u + INSIDE * if u == middle { self.to - middle } else { middle - u };
        let velocity = self.velocity.at(inside);
        velocity.directions(velocity.discriminant().max(0.0).sqrt())
    }

    /// Both points at a part `t` of the span, from 0 at its start to 1 at its end: plus branch first.
    pub fn points(&self, piece: &ChainPiece, t: f64) -> [GrazingPoint; 2] {
        let (u, way) = self.parameter(t);
        let (p, n, turn) = piece.place(u);
        let [plus, minus] = self.directions(t, u, way, turn);
        [(GrazingBranch::Plus, plus), (GrazingBranch::Minus, minus)].map(|(branch, e)| GrazingPoint {
            piece: self.piece as u32,
            branch,
            u,
            point: (e * p.x).extend(p.y),
            normal: (e * n.x).extend(n.y),
        })
    }
}

/// Part of what a span's normal velocity changes by that is rounding of zero.
const STILL: f64 = 1e-12;
/// Part of a span by which a curve is followed away from a circle without velocity: far above rounding, far below its bend.
const INSIDE: f64 = 1e-6;
/// Most halvings between two points of a curve.
const DEEPEST: u32 = 16;
/// Parts of a span before the first halving: less than a quarter turn each, so that a middle tells the bend.
const FIRST: u32 = 8;

impl ProfileChain {
    /// Both points at a part of a span, plus branch first.
    pub fn grazing_points(&self, span: &GrazingSpan, t: f64) -> [GrazingPoint; 2] {
        span.points(&self.pieces()[span.piece], t)
    }

    /// A curve as points: up along the plus branch and back along the minus branch, so that the last point is the first; its
    /// chords leave it by about the tolerance [mm]. A curve that does not close begins and ends on the first piece.
    pub fn curve(&self, grazing: &Grazing, of: &GrazingLoop, tolerance: f64) -> Vec<GrazingPoint> {
        let mut there: Vec<GrazingPoint> = Vec::new();
        let mut back: Vec<GrazingPoint> = Vec::new();
        for span in &grazing.spans[of.spans.clone()] {
            for t in self.parts(span, tolerance) {
                let [plus, minus] = self.grazing_points(span, t);
                there.push(plus);
                back.push(minus);
            }
        }
        there.extend(back.into_iter().rev());
        there
    }

    /// Parts of a span at which the chords of both branches keep to the tolerance [mm].
    pub fn parts(&self, span: &GrazingSpan, tolerance: f64) -> Vec<f64> {
        let mut parts = vec![0.0];
        let mut open: Vec<(f64, f64, u32)> = (0..FIRST)
            .rev()
            .map(|k| (f64::from(k) / f64::from(FIRST), f64::from(k + 1) / f64::from(FIRST), 0))
            .collect();
        while let Some((a, b, deep)) = open.pop() {
            let m = 0.5 * (a + b);
            let [at_a, at_m, at_b] = [a, m, b].map(|t| self.grazing_points(span, t));
            let off = (0..2)
                .map(|i| (at_m[i].point - at_a[i].point.lerp(at_b[i].point, 0.5)).length())
                .fold(0.0, f64::max);
            if off > tolerance && deep < DEEPEST {
                open.extend([(m, b, deep + 1), (a, m, deep + 1)]);
            } else {
                parts.push(b);
            }
        }
        parts
    }
}

/// A turn of less than half a circle between two unit vectors [rad], with its sign.
pub(super) fn turn_between(a: DVec2, b: DVec2) -> f64 {
    a.perp_dot(b).atan2(a.dot(b))
}
