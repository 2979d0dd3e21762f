//! The place of a sketch on paper: isometric, with room for its arrows.

use glam::{DVec2, DVec3};

use super::{SketchTool, SplitSketch};
use crate::page::draw::{FacePiece, Facets, SeenFace, View};

/// Room round a surface, as a share of its radius.
const ROOM: f64 = 0.2;
/// Lines of a mesh from one that is drawn to the next.
const DRAWN: usize = 4;

/// A sketch on paper.
pub(crate) struct Placed {
    pub(crate) view: View,
    /// Middle of the surface [mm].
    pub(crate) middle: DVec3,
    /// Radius of the surface about its middle [mm].
    pub(crate) radius: f64,
    /// Extent of the drawing, at scale one.
    window: [DVec2; 2],
}

impl Placed {
    /// The place of a surface in a box: left, top, width, height [px]; none without a finite point.
    pub(crate) fn new(sketch: &SplitSketch, at: [f64; 4]) -> Option<Placed> {
        let tool: Vec<[f64; 3]> = match &sketch.tool {
            SketchTool::None => Vec::new(),
            SketchTool::Point(p) => vec![*p],
            SketchTool::Edge(points) => points.clone(),
            SketchTool::Patch(rows) => rows.concat(),
        };
        let points: Vec<DVec3> = finite(sketch.surface.iter().flatten().chain(&tool)).collect();
        let (low, high) =
            (points.iter().copied().reduce(DVec3::min)?, points.iter().copied().reduce(DVec3::max)?);
        let middle = 0.5 * (low + high);
        let radius = points.iter().map(|p| (*p - middle).length()).fold(0.0, f64::max).max(1e-9);
        let view = View::isometric();
        let mut placed = Placed { view, middle, radius, window: [DVec2::INFINITY, DVec2::NEG_INFINITY] };
        placed.grow(points.iter().map(|p| view.turned(*p)), ROOM);
        placed.view = view.showing(placed.window, at);
        Some(placed)
    }

    /// The same with room for points of paper too.
    pub(crate) fn with_room_for(mut self, points: impl Iterator<Item = [f64; 2]>, at: [f64; 4]) -> Placed {
        let view = self.view;
        self.grow(points.map(|p| view.back(p)), 0.5 * ROOM);
        self.view = view.showing(self.window, at);
        self
    }

    fn grow(&mut self, points: impl Iterator<Item = DVec2>, room: f64) {
        let room = room * self.radius;
        for p in points {
            self.window = [self.window[0].min(p - room), self.window[1].max(p + room)];
        }
    }

    /// A place on paper [px].
    pub(crate) fn px(&self, p: DVec3) -> [f64; 2] {
        self.view.px(p)
    }

    /// Places on paper.
    pub(crate) fn line(&self, points: &[[f64; 3]]) -> Vec<[f64; 2]> {
        finite(points.iter()).map(|p| self.px(p)).collect()
    }

    /// The faces of a mesh, seen from either side, with some of its lines.
    pub(crate) fn faces(&self, rows: &[Vec<[f64; 3]>], body: usize) -> Vec<FacePiece> {
        let columns = rows.iter().map(Vec::len).min().unwrap_or(0);
        let drawn = |n: usize, all: usize| n.is_multiple_of(DRAWN) || n + 1 == all;
        let mut found = Vec::new();
        for (i, pair) in rows.windows(2).enumerate() {
            for j in 1..columns {
                let corners = [pair[0][j - 1], pair[0][j], pair[1][j], pair[1][j - 1]].map(DVec3::from);
                if corners.iter().all(|c| c.is_finite()) {
                    let lines = [
                        drawn(i, rows.len()),
                        drawn(j, columns),
                        drawn(i + 1, rows.len()),
                        drawn(j - 1, columns),
                    ];
                    // Two triangles: a quad of a twisted surface is not flat.
                    for (k, sides) in
                        [([0, 1, 2], [lines[0], lines[1], false]), ([0, 2, 3], [false, lines[2], lines[3]])]
                    {
                        found.extend(
                            self.turned(k.map(|k| corners[k]), sides).map(|face| FacePiece { face, body }),
                        );
                    }
                }
            }
        }
        found
    }

    /// A triangle with the side to the viewer that is seen, none of one without area.
    fn turned(&self, corners: [DVec3; 3], sides: [bool; 3]) -> Option<SeenFace> {
        let order = [[0, 1, 2], [0, 2, 1]];
        let one = |[a, b, c]: [u32; 3]| {
            let facets = Facets { corners: corners.to_vec(), faces: vec![vec![a, b, c]] };
            facets.seen(self.view.viewer).pop().map(|(_, face)| face)
        };
        let [front, back] = order.map(one);
        // The sides of the turned triangle are those from the first corner backwards.
        front
            .map(|f| SeenFace { drawn: sides.to_vec(), ..f })
            .or_else(|| back.map(|f| SeenFace { drawn: vec![sides[2], sides[1], sides[0]], ..f }))
    }
}

fn finite<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> impl Iterator<Item = DVec3> {
    points.map(|p| DVec3::from(*p)).filter(|p| p.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_is_seen_from_both_sides_and_lies_in_its_box() {
        let rows: Vec<Vec<[f64; 3]>> =
            (0..3).map(|i| (0..3).map(|j| [f64::from(i), f64::from(j), 0.0]).collect()).collect();
        let turned: Vec<Vec<[f64; 3]>> = rows.iter().rev().cloned().collect();
        for rows in [rows, turned] {
            let sketch = SplitSketch { surface: rows.clone(), ..SplitSketch::default() };
            let placed = Placed::new(&sketch, [0.0, 0.0, 100.0, 100.0]).unwrap();
            let faces = placed.faces(&rows, 0);
            assert_eq!(faces.len(), 8);
            assert!(faces.iter().all(|f| f.face.normal.z > 0.999));
            let inside = |p: [f64; 2]| p.iter().all(|v| (-1e-9..100.0 + 1e-9).contains(v));
            assert!(faces.iter().flat_map(|f| &f.face.outline).all(|&p| inside(placed.px(p))));
        }
        assert!(Placed::new(&SplitSketch::default(), [0.0, 0.0, 100.0, 100.0]).is_none());
    }
}
