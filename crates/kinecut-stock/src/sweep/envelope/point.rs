//! Points of an envelope with what is known of them, for others to check.

use glam::{DVec2, DVec3};

use super::second::second;
use crate::sweep::{GrazingBranch, MotionJet, ProfileChain, ToolMotion};
use crate::tool::ElementRole;

/// A grazing point of a moving tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvelopePoint {
    /// Moment of the move.
    pub t: f64,
    /// Piece of the tool's chain.
    pub piece: u32,
    /// Branch: one of the two points of the parallel circle.
    pub branch: GrazingBranch,
    /// Parameter on the piece: way along a line [mm], normal angle of an arc [rad].
    pub u: f64,
    /// Angle about the tool's axis [rad].
    pub theta: f64,
    /// Place [workpiece, mm].
    pub point: DVec3,
    /// Outward unit normal of tool and envelope, in workpiece coordinates.
    pub normal: DVec3,
    /// Second derivative by time of the tool's distance from the point, see [`EnvelopePoint::is_on_boundary`]. Infinite on edges.
    pub second: f64,
    /// Role of the part that touches there.
    pub role: ElementRole,
}

impl EnvelopePoint {
    /// True if no neighbouring moment removes the point. It may still be removed at another time.
    pub fn is_on_boundary(&self) -> bool {
        self.second > 0.0
    }
}

impl ProfileChain {
    /// The two envelope points on a parallel circle of the tool at a moment, plus branch first; none where the circle has none.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::geom::Line;
    /// use kinecut::sweep::{ProfileChain, ToolMotion};
    /// use kinecut::tool::{Contour, ContourElement, ElementRole};
    /// let pin = Contour::new(vec![
    ///     ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 0.0], [5.0, 30.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
    /// ]);
    /// let line = Line { start: DVec3::ZERO, end: DVec3::new(20.0, 0.0, 0.0) };
    /// let motion = ToolMotion::fixed(line.into(), DVec3::Z).unwrap();
    /// let [left, _] = ProfileChain::new(&pin.unwrap()).envelope_at(&motion, 0.5, 2, 10.0).unwrap();
    /// assert!((left.point - DVec3::new(10.0, 5.0, 10.0)).length() < 1e-14);
    /// assert!((left.second - 20.0 * 20.0 / 5.0).abs() < 1e-10); // speed squared by radius
    /// ```
    pub fn envelope_at(
        &self,
        motion: &ToolMotion,
        t: f64,
        piece: usize,
        u: f64,
    ) -> Option<[EnvelopePoint; 2]> {
        self.pieces().get(piece)?;
        let jet = motion.at(t);
        let velocity = self.normal_velocity(&jet.twist, piece, u);
        let d = velocity.discriminant();
        (d > 0.0).then(|| {
            let [plus, minus] = velocity.directions(d.sqrt());
            [(GrazingBranch::Plus, plus), (GrazingBranch::Minus, minus)]
                .map(|(branch, e)| self.envelope_point(&jet, t, piece, u, (branch, e)))
        })
    }

    /// Envelope points of all grazing curves at a moment, `count` on each branch of each span.
    pub fn envelope_points(&self, motion: &ToolMotion, t: f64, count: usize) -> Vec<EnvelopePoint> {
        let jet = motion.at(t);
        let grazing = self.grazing(&jet.twist);
        let mut all = Vec::with_capacity(2 * count * grazing.spans.len());
        for span in &grazing.spans {
            for k in 0..count {
                let part = (k as f64 + 0.5) / count as f64;
                for at in self.grazing_points(span, part) {
                    let e = across(at.normal, at.point);
                    all.push(self.envelope_point(&jet, t, span.piece, at.u, (at.branch, e)));
                }
            }
        }
        all
    }

    pub(super) fn envelope_point(
        &self,
        jet: &MotionJet,
        t: f64,
        index: usize,
        u: f64,
        (branch, e): (GrazingBranch, DVec2),
    ) -> EnvelopePoint {
        let piece = &self.pieces()[index];
        let (place, normal, _) = piece.place(u);
        EnvelopePoint {
            t,
            piece: index as u32,
            branch,
            u,
            theta: e.y.atan2(e.x),
            point: jet.pose.point((e * place.x).extend(place.y)),
            normal: jet.pose.vector((e * normal.x).extend(normal.y)),
            second: second(jet, piece, u, e),
            role: piece.role,
        }
    }
}

/// The unit vector across the axis to a point of the tool.
pub(super) fn across(normal: DVec3, point: DVec3) -> DVec2 {
    let (n, p) = (normal.truncate(), point.truncate());
    p.try_normalize().or_else(|| n.try_normalize()).unwrap_or(DVec2::X)
}
