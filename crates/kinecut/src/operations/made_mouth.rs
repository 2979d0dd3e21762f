//! Recesses at the mouths of holes that operations before leave: spots, countersinks.

use glam::DVec3;

use crate::drilling::Mouth;
use crate::geom::{EdgeProfile, Rigid};

/// A recess of revolution that an operation leaves, open upwards [mm].
#[derive(Clone, Copy, Debug)]
pub(crate) struct MadeMouth {
    /// Place of the tool that made it, where its edge has the height 0, in coordinates of the operation.
    pub(crate) tip: DVec3,
    /// The edge that made it, from the axis to its rim.
    pub(crate) edge: EdgeProfile,
}

/// The same with its place in the part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedMouth {
    pub(crate) mouth: MadeMouth,
    /// Maps coordinates of the operation into those of the part.
    pub(crate) to_part: Rigid,
}

/// Distance of axes and heights that is nothing [mm].
const SAME: f64 = 1e-6;
/// Difference of directions that is rounding.
const ROUNDING: f64 = 1e-9;

impl PlacedMouth {
    /// The recess as a drill sees it whose axis goes through a point along Z of its own coordinates, with a level face at a height
    /// over the point; `None` where it lies elsewhere. Heights count from the point.
    pub(crate) fn seen(&self, to_part: &Rigid, point: DVec3, face: f64) -> Option<Mouth> {
        let (own, up) = (to_part.point(point), to_part.vector(DVec3::Z));
        if self.to_part.vector(DVec3::Z).dot(up) < 1.0 - ROUNDING {
            return None;
        }
        let tip = self.to_part.point(self.mouth.tip) - own;
        let height = tip.dot(up);
        let beside = (tip - up * height).length();
        let rim = height + self.mouth.edge.height(self.mouth.edge.outer_radius())?;
        (beside <= SAME && (rim - face).abs() <= SAME).then_some(Mouth { height, edge: self.mouth.edge })
    }
}
