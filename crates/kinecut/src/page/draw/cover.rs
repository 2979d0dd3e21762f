//! Points that faces hide: those with a face in front of them.

use glam::{DVec2, DVec3};

use super::{FacePiece, View};

/// Most cells of the grid in which faces are found, along each side.
const CELLS: f64 = 96.0;

/// Faces over the paper.
pub(crate) struct Cover {
    view: View,
    faces: Vec<Covering>,
    /// For each cell of the paper the faces over it.
    grid: Vec<Vec<u32>>,
    cells: usize,
    corner: DVec2,
    cell: DVec2,
    off: f64,
}

/// A face over the paper.
struct Covering {
    outline: Vec<DVec2>,
    corner: DVec3,
    /// Normal by its part to the viewer.
    slope: DVec3,
}

impl Cover {
    /// The cover of faces that are turned to the viewer; they hide only points more than `off` behind them [mm].
    pub(crate) fn new(view: View, pieces: &[FacePiece], off: f64) -> Cover {
        let over = |p: &FacePiece| Covering {
            outline: p.face.outline.iter().map(|&c| DVec2::from(view.px(c))).collect(),
            corner: p.face.outline.first().copied().unwrap_or_default(),
            slope: p.face.normal / view.depth(p.face.normal),
        };
        let faces: Vec<Covering> = pieces.iter().map(over).collect();
        let cells = (faces.len() as f64).sqrt().clamp(1.0, CELLS) as usize;
        let all = || faces.iter().flat_map(|f| f.outline.iter().copied());
        let (low, high) =
            (all().fold(DVec2::INFINITY, DVec2::min), all().fold(DVec2::NEG_INFINITY, DVec2::max));
        let cell = ((high - low) / cells as f64).max(DVec2::splat(1e-9));
        let mut cover =
            Cover { view, faces, grid: vec![Vec::new(); cells * cells], cells, corner: low, cell, off };
        for (i, face) in cover.faces.iter().enumerate() {
            let ends =
                [DVec2::min, DVec2::max].map(|f| face.outline.iter().copied().reduce(f).unwrap_or_default());
            let [from, to] = ends.map(|p| cover.cell_of(p));
            for row in from[1]..=to[1] {
                cover.grid[row * cells + from[0]..=row * cells + to[0]]
                    .iter_mut()
                    .for_each(|c| c.push(i as u32));
            }
        }
        cover
    }

    fn cell_of(&self, p: DVec2) -> [usize; 2] {
        let c = (p - self.corner) / self.cell;
        [c.x, c.y].map(|v| (v.max(0.0) as usize).min(self.cells - 1))
    }

    /// Whether a face is in front of a point.
    pub(crate) fn hides(&self, point: DVec3) -> bool {
        let p = DVec2::from(self.view.px(point));
        let [column, row] = self.cell_of(p);
        self.grid[row * self.cells + column].iter().map(|&i| &self.faces[i as usize]).any(|face| {
            // Way along the ray from the point to the plane of the face.
            face.slope.dot(face.corner - point) > self.off && contains(&face.outline, p)
        })
    }
}

/// Whether a point lies in an outline.
pub(super) fn contains(outline: &[DVec2], p: DVec2) -> bool {
    let mut odd = false;
    for (i, a) in outline.iter().enumerate() {
        let b = outline[(i + 1) % outline.len()];
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
            odd = !odd;
        }
    }
    odd
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Aabb, Rigid, Solid};
    use crate::page::draw::Facets;

    #[test]
    fn a_box_hides_what_is_behind_it_and_nothing_before_or_beside() {
        let solid = Solid::Box(Aabb { min: DVec3::ZERO, max: DVec3::ONE });
        let facets = Facets::of(&solid, &Rigid::IDENTITY);
        let view = View::isometric().fitting(facets.corners.iter().copied(), [0.0, 0.0, 100.0, 100.0]);
        let seen = facets.seen(view.viewer).into_iter();
        let pieces: Vec<FacePiece> = seen.map(|(_, face)| FacePiece { face, body: 0 }).collect();
        let cover = Cover::new(view, &pieces, 1e-6);
        let middle = DVec3::splat(0.5);
        assert!(cover.hides(middle) && cover.hides(middle - 3.0 * view.viewer));
        assert!(!cover.hides(middle + 3.0 * view.viewer) && !cover.hides(DVec3::new(0.5, 0.5, 1.0)));
        assert!(!cover.hides(DVec3::new(40.0, 40.0, 0.0)));
    }
}
