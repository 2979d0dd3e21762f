//! The case of a face: the outline with its weights, the cutter, the bad exit angles.

use glam::DVec2;
use serde::Serialize;

use super::BadSet;
use crate::base::unit::turn_degrees;
use crate::base::{Code, Finding, Result};
use crate::geom::Outline;

/// A face, the cutter that mills it, and the bad exit angles. Everything in this layer takes the spindle as M3.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceCase {
    /// The outline, material on the right.
    pub outline: Outline,
    /// Weight of a millimetre of each edge, edge by edge: 0 for an edge that is chamfered anyway.
    pub weights: Vec<f64>,
    /// Radius of the cutter at the finished plane [mm].
    pub radius: f64,
    /// The bad exit angles.
    pub bad: BadSet,
}

/// Placement of the part under a straight pass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Placement {
    /// Ordinate of the line of the cutter centre in the turned part's frame, feed towards +x [mm].
    pub offset: f64,
    /// The part is turned by this, counter-clockwise about its origin [rad]; in JSON `turn`, degrees from 0 to 360.
    #[serde(rename = "turn", serialize_with = "turn_degrees")]
    pub angle: f64,
}

impl Placement {
    /// Direction of feed in the part's own frame.
    pub fn feed_in_part(&self) -> DVec2 {
        DVec2::from_angle(-self.angle)
    }

    /// A point given in the turned frame, in the part's own frame.
    pub fn in_part(&self, point: DVec2) -> DVec2 {
        DVec2::from_angle(-self.angle).rotate(point)
    }

    /// The placement of the mirrored part (y and -y exchanged) that mirrors this one.
    #[must_use]
    pub fn mirrored(&self) -> Placement {
        Placement { angle: -self.angle, offset: -self.offset }
    }
}

impl FaceCase {
    /// A case with every edge counting 1.
    ///
    /// # Errors
    /// `KC1001` for a radius that is not positive and finite.
    pub fn new(outline: Outline, radius: f64, bad: BadSet) -> Result<FaceCase> {
        let weights = vec![1.0; outline.edges().len()];
        FaceCase { outline, weights, radius, bad }.checked()
    }

    /// The same with a weight for each edge.
    ///
    /// # Errors
    /// `KC1001` for a weight that is negative or not finite, or when there are not as many as edges.
    pub fn with_weights(self, weights: Vec<f64>) -> Result<FaceCase> {
        FaceCase { weights, ..self }.checked()
    }

    fn checked(self) -> Result<FaceCase> {
        if !(self.radius > 0.0 && self.radius.is_finite()) {
            return Err(Finding::error(Code::FACE_CASE, "the radius of the cutter must be positive")
                .value_mm(self.radius)
                .bound_mm(0.0)
                .into());
        }
        if self.weights.len() != self.outline.edges().len() {
            return Err(Finding::error(Code::FACE_CASE, "each edge has one weight")
                .value(self.weights.len() as f64, "weights")
                .bound(self.outline.edges().len() as f64, "edges")
                .into());
        }
        for (edge, &weight) in self.weights.iter().enumerate() {
            if !(0.0..=BadSet::MAX_WEIGHT).contains(&weight) {
                return Err(Finding::error(
                    Code::FACE_CASE,
                    format!("the weight of edge {edge} is out of range"),
                )
                .value(weight, "")
                .bound(BadSet::MAX_WEIGHT, "")
                .into());
            }
        }
        Ok(self)
    }

    /// The sum of lengths times weights: the bad length if every exit were bad [mm].
    pub fn weighted_perimeter(&self) -> f64 {
        self.outline.edges().iter().zip(&self.weights).map(|(e, w)| e.length() * w).sum()
    }

    /// The mirror image, y and -y exchanged: a pass with an M4 spindle over the part is a pass with M3 over this.
    /// Edges of a loop come in the reverse order.
    #[must_use]
    pub fn mirrored(&self) -> FaceCase {
        let mut weights = self.weights.clone();
        for one in self.outline.loops() {
            weights[one.edges.clone()].reverse();
        }
        FaceCase { outline: self.outline.mirrored(), weights, ..self.clone() }
    }

    /// Ordinates of the centre line that keep the whole outline at least `margin` inside the cutter, for the part
    /// turned by `angle`; the first exceeds the second where the part is too wide [mm].
    pub fn offsets(&self, angle: f64, margin: f64) -> [f64; 2] {
        let [low, high] = self.outline.extent(DVec2::new(angle.sin(), angle.cos()));
        let reach = self.radius - margin;
        [high - reach, low + reach]
    }
}
