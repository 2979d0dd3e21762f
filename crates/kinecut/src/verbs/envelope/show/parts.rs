//! Which part of an envelope a face of its mesh is: the tool at the start, at the end, the wall between, and what of the wall lies
//! inside.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::geom::{Mesh, Rigid};
use crate::sweep::{ChainPiece, PieceShape, ProfileChain};
use crate::verbs::envelope::EnvelopeSheet;

/// A part of an envelope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EnvelopePart {
    /// Surface that leaves at the first moment.
    Start,
    /// Surface that enters at the last.
    End,
    /// Traced by grazing curves.
    Wall,
    /// The same, inside of what the moments beside sweep.
    Inside,
}

/// Distance from the tool's surface that is rounding, by the size of the tool.
const ON: f64 = 1e-7;
/// Places along the longest side of the body in which cells of its walls are found.
const CELLS: f64 = 32.0;

/// The part of each triangle of a mesh of the sheet's move.
pub(crate) fn parts(sheet: &EnvelopeSheet, mesh: &Mesh) -> Vec<EnvelopePart> {
    let on = ON * sheet.chain.bound();
    let ends = [0.0, 1.0].map(|t| {
        let pose = sheet.motion.pose(t);
        mesh.vertices.iter().map(|&v| is_on(&sheet.chain, &pose, v, on)).collect::<Vec<bool>>()
    });
    let inside = Inside::new(sheet, mesh.bounds().size().max_element() / CELLS);
    let of = |t: &[u32; 3]| {
        let corners = t.map(|i| i as usize);
        let middle = corners.iter().map(|&i| mesh.vertices[i]).sum::<DVec3>() / 3.0;
        let [a, b, c] = corners.map(|i| mesh.vertices[i]);
        let normal = (b - a).cross(c - a);
        for (k, part) in [EnvelopePart::Start, EnvelopePart::End].into_iter().enumerate() {
            if corners.iter().all(|&i| ends[k][i]) {
                // A surface that leaves is the start's, one that enters the end's; the other side of a move on the spot
                // is a wall.
                let jet = sheet.motion.at(k as f64);
                let local = jet.pose.inverse().point(middle);
                let velocity = jet.pose.vector(jet.twist.velocity(local));
                let enters = normal.dot(velocity) > 0.0;
                if enters == (part == EnvelopePart::End) {
                    return part;
                }
            }
        }
        if inside.is_near(middle) { EnvelopePart::Inside } else { EnvelopePart::Wall }
    };
    mesh.triangles.iter().map(of).collect()
}

/// Cells of the walls by their places, where any of them lies inside.
struct Inside {
    places: BTreeMap<[i64; 3], Vec<(DVec3, bool)>>,
    cell: f64,
}

impl Inside {
    fn new(sheet: &EnvelopeSheet, cell: f64) -> Inside {
        let mut inside = Inside { places: BTreeMap::new(), cell };
        if cell > 0.0 && sheet.walls.iter().any(|c| c.inside) {
            for c in &sheet.walls {
                inside.places.entry(inside.key(c.middle)).or_default().push((c.middle, c.inside));
            }
        }
        inside
    }

    fn key(&self, p: DVec3) -> [i64; 3] {
        (p / self.cell).floor().to_array().map(|c| c as i64)
    }

    /// Whether the nearest cell of a wall within the width of a place lies inside.
    fn is_near(&self, p: DVec3) -> bool {
        if self.places.is_empty() {
            return false;
        }
        let [x, y, z] = self.key(p);
        let mut best = (f64::INFINITY, false);
        for (i, j, k) in (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| (i, j, k)))) {
            for (middle, inside) in self.places.get(&[x + i, y + j, z + k]).into_iter().flatten() {
                let away = (*middle - p).length_squared();
                if away < best.0 {
                    best = (away, *inside);
                }
            }
        }
        best.1
    }
}

/// Whether a point lies on the surface of the tool in a pose.
fn is_on(chain: &ProfileChain, pose: &Rigid, v: DVec3, within: f64) -> bool {
    let local = pose.inverse().point(v);
    let q = DVec2::new(local.truncate().length(), local.z);
    chain.pieces().iter().filter(|p| !p.is_fan()).any(|p| distance(p, q) <= within)
}

/// Distance of a point of the half-plane from a piece.
fn distance(piece: &ChainPiece, q: DVec2) -> f64 {
    let ends = [piece.from, piece.to].map(|u| piece.point(u));
    let to_ends = ends.map(|e| (q - e).length());
    let least = to_ends[0].min(to_ends[1]);
    match piece.shape {
        PieceShape::Line { .. } => {
            let way = ends[1] - ends[0];
            let part = (q - ends[0]).dot(way) / way.length_squared();
            if part > 0.0 && part < 1.0 { (q - ends[0] - way * part).length() } else { least }
        }
        PieceShape::Arc { centre, radius } => {
            let from_centre = q - centre;
            // The normal of the arc at the point beside, as an angle beside those of the piece.
            let normal = from_centre * radius.signum();
            let middle = 0.5 * (piece.from + piece.to);
            let phi = normal.y.atan2(normal.x);
            let away = (phi - middle + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
                - std::f64::consts::PI;
            if away.abs() <= 0.5 * (piece.to - piece.from).abs() {
                (from_centre.length() - radius.abs()).abs()
            } else {
                least
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::{Contour, ContourElement, ElementRole};

    #[test]
    fn a_point_of_a_turned_tool_is_on_it_and_one_beside_is_not() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let bull = Contour::new(vec![
            ContourElement::line([0.0, 0.0], [3.0, 0.0], ElementRole::Cutting),
            ContourElement::arc([3.0, 2.0], 2.0, -quarter, 0.0, ElementRole::Cutting),
            ContourElement::line([5.0, 2.0], [5.0, 20.0], ElementRole::Cutting),
            ContourElement::line([5.0, 20.0], [0.0, 20.0], ElementRole::Shank),
        ]);
        let chain = ProfileChain::new(&bull.unwrap());
        let pose =
            Rigid { rotation: glam::DMat3::from_rotation_x(0.4), translation: DVec3::new(1.0, 2.0, 3.0) };
        let (sin, cos) = 0.7f64.sin_cos();
        // On the torus at 45 degrees, on the flank, on the bottom.
        for (r, z) in [(3.0 + 2.0f64.sqrt(), 2.0 - 2.0f64.sqrt()), (5.0, 11.0), (1.5, 0.0)] {
            let at = |r: f64| pose.point(DVec3::new(r * cos, r * sin, z));
            assert!(is_on(&chain, &pose, at(r), 1e-9), "{r} {z}");
            assert!(!is_on(&chain, &pose, at(r) + pose.vector(DVec3::new(0.1 * cos, 0.1 * sin, -0.1)), 1e-9));
        }
    }
}
