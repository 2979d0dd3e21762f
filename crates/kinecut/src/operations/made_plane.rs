//! Planes that operations before leave: the faces that have been milled.

use glam::{DVec2, DVec3};

use crate::facing::passes::PassPath;
use crate::geom::{Outline, OutlineEdge, Rigid};

/// A plane that an operation leaves: nothing is over it within its outline, and where the cutter has run.
#[derive(Clone, Debug)]
pub(crate) struct MadePlane {
    /// The face, in coordinates of the operation with the part not turned.
    outline: Outline,
    /// The way of the cutter's centre there.
    ways: Vec<OutlineEdge>,
    /// Radius of the cutter at the plane [mm].
    reach: f64,
    /// Height there [mm].
    top: f64,
}

/// The same with its place in the part.
#[derive(Clone, Debug)]
pub(crate) struct PlacedPlane {
    pub(crate) plane: MadePlane,
    /// Maps coordinates of the operation into those of the part.
    pub(crate) to_part: Rigid,
}

/// Difference of directions that is rounding.
const ROUNDING: f64 = 1e-9;

impl MadePlane {
    /// Of a face at a height, milled along a path by a cutter of a radius at the plane [mm].
    pub(crate) fn new(outline: &Outline, top: f64, path: PassPath, reach: f64) -> MadePlane {
        MadePlane { outline: outline.clone(), ways: path.chains.into_iter().flatten().collect(), reach, top }
    }

    /// Whether all of a disc of a radius [mm] is milled: it lies in the face, or under one piece of the cutter's way.
    fn covers(&self, centre: DVec2, radius: f64) -> bool {
        let in_face = || {
            self.outline.edges().iter().all(|e| e.nearest(centre).1 >= radius)
                && self.outline.contains(centre)
        };
        // Of a hole that the drawing of the face has, and beside the face.
        self.ways.iter().any(|way| way.nearest(centre).1 <= self.reach - radius) || in_face()
    }
}

impl PlacedPlane {
    /// Its height over a disc of a radius [mm] around a point, along a direction there, if it lies square to the direction on
    /// the side from which that points, and all of the disc is milled; everything in part coordinates.
    pub(crate) fn over(&self, point: DVec3, out: DVec3, radius: f64) -> Option<f64> {
        if self.to_part.vector(DVec3::Z).dot(out) < 1.0 - ROUNDING {
            return None;
        }
        let at = self.to_part.inverse().point(point);
        self.plane.covers(at.truncate(), radius).then_some(self.plane.top - at.z)
    }
}
