//! Cells of the annulus of an edge, radius by angle, and bounds of surfaces and edges over them, for
//! [`super::clash`].

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use crate::drilling::BoundarySurface;
use crate::drilling::domain::Laid;
use crate::geom::{EdgeProfile, EdgeSegment};

/// A cell smaller than this either way is a place [mm]: under an upright wall of a bore, heights differ by 0.05 µm in it.
/// If its corners and its middle do not count, none of it does.
const FINEST: f64 = 1e-10;

/// A cell of the annulus.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) r: [f64; 2],
    pub(super) angle: [f64; 2],
}

impl Cell {
    /// Both halves of its radii or of its angles.
    pub(super) fn split(&self, radially: bool) -> [Cell; 2] {
        let range = if radially { self.r } else { self.angle };
        let middle = 0.5 * (range[0] + range[1]);
        [[range[0], middle], [middle, range[1]]]
            .map(|part| if radially { Cell { r: part, ..*self } } else { Cell { angle: part, ..*self } })
    }

    /// True if it is longer along the radius than along the angle.
    pub(super) fn longer_radially(&self) -> bool {
        self.r[1] - self.r[0] > self.r[1] * (self.angle[1] - self.angle[0])
    }

    /// True if it is too small to be halved usefully.
    pub(super) fn is_place(&self) -> bool {
        self.r[1] - self.r[0] < FINEST && self.r[1] * (self.angle[1] - self.angle[0]) < FINEST
    }

    /// Its middle.
    pub(super) fn centre(&self) -> DVec2 {
        DVec2::from_angle(0.5 * (self.angle[0] + self.angle[1])) * (0.5 * (self.r[0] + self.r[1]))
    }

    /// Bounds of the cosine of the angle less `from`.
    pub(super) fn cosine(&self, from: f64) -> [f64; 2] {
        let [a, b] = self.angle.map(|t| t - from);
        // A whole multiple of pi between the ends, even or odd.
        let holds = |phase: f64| ((b - phase) / TAU).floor() >= ((a - phase) / TAU).ceil();
        let [low, high] = ordered(a.cos(), b.cos());
        [if holds(PI) { -1.0 } else { low }, if holds(0.0) { 1.0 } else { high }]
    }

    /// Bounds of the coordinate u at an angle.
    pub(super) fn along(&self, turn: f64) -> [f64; 2] {
        let c = self.cosine(turn);
        let low = if c[0] < 0.0 { self.r[1] } else { self.r[0] } * c[0];
        let high = if c[1] > 0.0 { self.r[1] } else { self.r[0] } * c[1];
        [low, high]
    }

    /// Bounds of the distance from a point.
    pub(super) fn distance(&self, from: DVec2) -> [f64; 2] {
        let d = from.length();
        let c = self.cosine(from.to_angle());
        let squared = |r: f64, c: f64| (r * r - 2.0 * r * d * c + d * d).clamp(0.0, f64::INFINITY);
        let nearest = squared((d * c[1]).clamp(self.r[0], self.r[1]), c[1]);
        let (a, b) = (squared(self.r[0], c[0]), squared(self.r[1], c[0]));
        [nearest.sqrt(), if a > b { a.sqrt() } else { b.sqrt() }]
    }
}

fn ordered(a: f64, b: f64) -> [f64; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// Bounds of a surface over a cell.
pub(super) fn bounds(laid: &Laid, cell: &Cell) -> [f64; 2] {
    let u = cell.along(laid.turn);
    let [a, b] = u.map(|u| laid.surface.height(u));
    let [mut low, mut high] = ordered(a, b);
    match laid.surface {
        BoundarySurface::Plane { .. } => {}
        BoundarySurface::Ridge { radius, offset, height } if u[0] < -offset && u[1] > -offset => {
            high = height + radius
        }
        BoundarySurface::Valley { radius, offset, height } if u[0] < -offset && u[1] > -offset => {
            low = height - radius
        }
        _ => {}
    }
    [low, high]
}

/// Bounds of an edge between two radii; `None` where it is not.
pub(super) fn edge_bounds(edge: &EdgeProfile, r: [f64; 2]) -> Option<[f64; 2]> {
    let mut found: Option<[f64; 2]> = None;
    for s in edge.segments() {
        let [a, b] = s.range();
        let (a, b) = (if a > r[0] { a } else { r[0] }, if b < r[1] { b } else { r[1] });
        if a <= b {
            let [mut low, high] = ordered(s.height(a), s.height(b));
            if let EdgeSegment::Arc { centre, radius, .. } = *s
                && centre[0] > a
                && centre[0] < b
            {
                low = centre[1] - radius;
            }
            found = Some(match found {
                Some([l, h]) => [if l < low { l } else { low }, if h > high { h } else { high }],
                None => [low, high],
            });
        }
    }
    found
}
