//! Planes that operations before leave: the faces that have been milled, the floors of pockets and bores.

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
    /// Least distance of a disc's centre from the outline, and of its rim [mm]: beside the wall of a pocket the cutter may not have been,
    /// or its corner.
    room: [f64; 2],
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
        let ways = path.chains.into_iter().flatten().collect();
        MadePlane { outline: outline.clone(), ways, reach, top, room: [0.0; 2] }
    }

    /// Of the floor within an outline that a flat cutter has cleared: its radius, the radius of its corner, and the stock that it leaves on
    /// the wall [mm].
    pub(crate) fn floor(outline: Outline, top: f64, [radius, corner, leave]: [f64; 3]) -> MadePlane {
        MadePlane { outline, ways: Vec::new(), reach: 0.0, top, room: [leave + radius, leave + corner] }
    }

    /// Whether all of a disc of a radius [mm] is milled: it lies in the face, or under one piece of the cutter's way.
    fn covers(&self, centre: DVec2, radius: f64) -> bool {
        let in_face = || {
            // The cutter has stood over the centre, or has come so near to all of the rim.
            let room = self.room[0].max(radius + self.room[1]);
            self.outline.edges().iter().all(|e| e.nearest(centre).1 >= room) && self.outline.contains(centre)
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
