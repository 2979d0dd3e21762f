//! Planes that operations before leave: the faces that have been milled.

use glam::{DVec2, DVec3};

use super::wanted::WantedPlane;
use crate::geom::{Outline, Rigid};

/// A plane that an operation leaves: nothing stands over it within its outline.
#[derive(Clone, Debug)]
pub(crate) struct MadePlane {
    /// Its outer edges, in coordinates of that operation with the part not turned.
    outline: Outline,
    /// Height there [mm].
    top: f64,
    /// Maps these into coordinates of the part.
    to_part: Rigid,
}

/// Difference of directions that is rounding.
const ROUNDING: f64 = 1e-9;

impl MadePlane {
    /// Of a plane that an operation wants; `to_part` maps coordinates of the operation into those of the part.
    pub(crate) fn new(plane: &WantedPlane<'_>, to_part: &Rigid) -> Option<MadePlane> {
        // A cutter that mills a face goes over its holes too.
        let edges = plane.outline.edges();
        let outer = plane.outline.loops().iter().filter(|l| l.outer).map(|l| edges[l.edges.clone()].to_vec());
        let outline = Outline::new(outer.collect(), Vec::new()).ok()?;
        // The part is clamped as the operation sees it; turned on the table, its face is where its outline says.
        Some(MadePlane { outline, top: plane.top, to_part: *to_part })
    }

    /// Its height over a disc of a radius [mm] around a point, along a direction there, if it lies square to the direction on
    /// the side from which that points, and all of the disc is within it; everything in part coordinates.
    pub(crate) fn over(&self, point: DVec3, out: DVec3, radius: f64) -> Option<f64> {
        if self.to_part.vector(DVec3::Z).dot(out) < 1.0 - ROUNDING {
            return None;
        }
        let at = self.to_part.inverse().point(point);
        let centre: DVec2 = at.truncate();
        let near = self.outline.edges().iter().all(|e| e.nearest(centre).1 >= radius);
        (near && self.outline.contains(centre)).then_some(self.top - at.z)
    }
}
