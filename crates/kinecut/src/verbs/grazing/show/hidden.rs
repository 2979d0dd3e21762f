//! Parts of a tool that hide behind itself: a point is seen if its surface is turned to the viewer and no ray from it
//! to the viewer meets the tool again. The profile is taken as a polygon; each of its sides with the ray makes a
//! quadratic.

use glam::{DVec2, DVec3};

use crate::sweep::PieceShape;
use crate::verbs::grazing::GrazingSheet;

/// Widest chord of an arc [rad]: it leaves a circle by 0.04 % of its radius.
const CHORD: f64 = 0.05;
/// Distance from the surface at which a ray starts, by the size of the tool: more than chords leave it by.
const OFF: f64 = 0.003;
/// Turn of the surface away from the viewer that still counts as seen: curves on the outline.
const EDGE_ON: f64 = -1e-9;

/// A tool that hides.
pub(crate) struct Hiding {
    profile: Vec<DVec2>,
    viewer: DVec3,
    off: f64,
}

impl Hiding {
    pub(crate) fn new(sheet: &GrazingSheet, viewer: DVec3) -> Hiding {
        let mut profile: Vec<DVec2> = Vec::new();
        for piece in sheet.chain.pieces().iter().filter(|p| !p.is_fan()) {
            let steps = match piece.shape {
                PieceShape::Line { .. } => 1.0,
                PieceShape::Arc { .. } => ((piece.to - piece.from).abs() / CHORD).ceil().max(1.0),
            };
            let mut k = if profile.is_empty() { 0.0 } else { 1.0 };
            while k <= steps {
                profile.push(piece.point(piece.from + (piece.to - piece.from) * k / steps));
                k += 1.0;
            }
        }
        let size = profile.iter().map(|p| p.x).fold(0.0, f64::max);
        Hiding { profile, viewer, off: OFF * size }
    }

    /// Whether a point of the surface with this normal is seen.
    pub(crate) fn sees(&self, point: DVec3, normal: DVec3) -> bool {
        normal.dot(self.viewer) > EDGE_ON && self.is_free(point + normal * self.off)
    }

    /// Whether nothing stands between a point and the viewer.
    pub(crate) fn is_free(&self, p: DVec3) -> bool {
        let d = self.viewer;
        let a = d.truncate().length_squared();
        let b = p.truncate().dot(d.truncate());
        let c = p.truncate().length_squared();
        !self.profile.windows(2).any(|side| {
            let (p0, p1) = (side[0], side[1]);
            let rise = p1.y - p0.y;
            if rise == 0.0 {
                let s = (p0.y - p.z) / d.z;
                let r = (a * s * s + 2.0 * b * s + c).max(0.0).sqrt();
                return s > 0.0 && r >= p0.x.min(p1.x) && r <= p0.x.max(p1.x);
            }
            // Radius of the side at the ray's height: g + h s.
            let slope = (p1.x - p0.x) / rise;
            let (g, h) = (p0.x + (p.z - p0.y) * slope, d.z * slope);
            let (q2, q1, q0) = (a - h * h, b - g * h, c - g * g);
            let disc = q1 * q1 - q2 * q0;
            if disc < 0.0 || q2 == 0.0 {
                return false;
            }
            let root = disc.sqrt();
            [(-q1 - root) / q2, (-q1 + root) / q2].into_iter().any(|s| {
                let z = p.z + s * d.z;
                s > 0.0 && g + h * s >= 0.0 && z >= p0.y.min(p1.y) && z <= p0.y.max(p1.y)
            })
        })
    }
}
