//! The swept body on paper: faces in the order in which they hide one another, and which points are seen.

use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use super::parts::{Part, parts};
use crate::base::{Result, Silent};
use crate::geom::Mesh;
use crate::verbs::envelope::EnvelopeSheet;
use crate::verbs::grazing::show::View;
use crate::verbs::layouts::show::{Facets, PaintedPiece, painted};

/// Parts of the body's longest side by which the drawn mesh may leave the envelope: below a pixel.
const FINENESS: f64 = 600.0;
/// Most triangles of a picture, and how often the tolerance is doubled for them.
const MOST: usize = 16_000;
const COARSER: u32 = 3;
/// Cells of the grid in which faces are found, along each side.
const CELLS: usize = 96;
/// Distance of the points of a face that are looked at [px], and by which part they are drawn to its middle.
const SAMPLE: f64 = 6.0;
const WITHIN: f64 = 0.05;
/// How much nearer than a point of the surface a face must be to hide it, by the size of the body: more than the drawn mesh is
/// off.
const OFF: f64 = 0.006;

/// A face in the order of drawing.
pub(crate) struct Drawn {
    pub(crate) outline: Vec<[f64; 2]>,
    pub(crate) part: Part,
    pub(crate) normal: DVec3,
    /// Edges that are drawn.
    pub(crate) edges: Vec<[[f64; 2]; 2]>,
}

/// What is seen of an envelope.
pub(crate) struct Scene {
    pub(crate) view: View,
    pub(crate) faces: Vec<Drawn>,
    mesh: Mesh,
    /// Its vertices on paper.
    places: Vec<DVec2>,
    /// For each cell of the paper the triangles over it.
    grid: Vec<Vec<u32>>,
    corner: DVec2,
    cell: DVec2,
    off: f64,
}

impl Scene {
    /// The scene in a box: left, top, width, height [px].
    pub(crate) fn new(sheet: &EnvelopeSheet, at: [f64; 4]) -> Result<Scene> {
        let size = sheet.envelope.mesh.bounds().size().max_element();
        let mesh = drawn_mesh(sheet, size)?;
        let view = View::fitting(ahead(sheet), &mesh.vertices, at);
        let labels = parts(sheet, &mesh);
        let places = mesh.vertices.iter().map(|&v| DVec2::from(view.px(v))).collect();
        let mut scene = Scene {
            view,
            faces: Vec::new(),
            mesh,
            places,
            grid: vec![Vec::new(); CELLS * CELLS],
            corner: DVec2::new(at[0], at[1]),
            cell: DVec2::new(at[2], at[3]) / CELLS as f64,
            off: OFF * size,
        };
        scene.fill();
        // What lies wholly behind is left out before the rest is ordered: a body that cuts itself has much of it.
        let seen: Vec<bool> =
            (0..scene.mesh.triangles.len()).into_par_iter().map(|i| scene.shows(i)).collect();
        scene.faces = faces(&scene.view, &scene.mesh, &labels, &seen);
        Ok(scene)
    }

    fn fill(&mut self) {
        for (i, t) in self.mesh.triangles.iter().enumerate() {
            let p = t.map(|v| self.places[v as usize]);
            let (low, high) = (p[0].min(p[1]).min(p[2]), p[0].max(p[1]).max(p[2]));
            let [from, to] = [low, high].map(|q| self.cell_of(q));
            for row in from[1]..=to[1] {
                for column in from[0]..=to[0] {
                    self.grid[row * CELLS + column].push(i as u32);
                }
            }
        }
    }

    fn cell_of(&self, p: DVec2) -> [usize; 2] {
        let c = (p - self.corner) / self.cell;
        [c.x, c.y].map(|v| (v.max(0.0) as usize).min(CELLS - 1))
    }

    /// Whether a face is turned to the viewer and any of its points, a few pixels apart, is free.
    fn shows(&self, index: usize) -> bool {
        let triangle = self.mesh.triangles[index].map(|v| v as usize);
        let (c, q) = (triangle.map(|v| self.mesh.vertices[v]), triangle.map(|v| self.places[v]));
        if (c[1] - c[0]).cross(c[2] - c[0]).dot(self.view.viewer) <= 0.0 {
            return false;
        }
        let longest = (0..3).map(|i| (q[i] - q[(i + 1) % 3]).length()).fold(0.0, f64::max);
        let n = (longest / SAMPLE).ceil().clamp(1.0, 12.0);
        let middle = (c[0] + c[1] + c[2]) / 3.0;
        let steps = 0..=n as u32;
        steps.clone().any(|i| {
            steps.clone().filter(|j| f64::from(i + j) <= n).any(|j| {
                let (a, b) = (f64::from(i) / n, f64::from(j) / n);
                let p = c[0] * a + c[1] * b + c[2] * (1.0 - a - b);
                self.is_free(p + (middle - p) * WITHIN)
            })
        })
    }

    /// Whether no face of the body stands before a point.
    pub(crate) fn is_free(&self, point: DVec3) -> bool {
        let p = DVec2::from(self.view.px(point));
        let depth = point.dot(self.view.viewer) + self.off;
        let [column, row] = self.cell_of(p);
        !self.grid[row * CELLS + column].iter().any(|&i| {
            let triangle = self.mesh.triangles[i as usize].map(|v| v as usize);
            let (corners, q) = (triangle.map(|v| self.mesh.vertices[v]), triangle.map(|v| self.places[v]));
            let area = (q[1] - q[0]).perp_dot(q[2] - q[0]);
            if area == 0.0 {
                return false;
            }
            let weight = |a: usize, b: usize| (q[a] - p).perp_dot(q[b] - p) / area;
            let w = [weight(1, 2), weight(2, 0), weight(0, 1)];
            w.iter().all(|w| *w >= 0.0)
                && corners.iter().zip(w).map(|(c, w)| w * c.dot(self.view.viewer)).sum::<f64>() > depth
        })
    }
}

/// The mesh of the sheet, or a coarser one that a picture can show.
fn drawn_mesh(sheet: &EnvelopeSheet, size: f64) -> Result<Mesh> {
    let mut tolerance = size / FINENESS;
    let mut coarser = None;
    for _ in 0..COARSER {
        let so_far = coarser.as_ref().unwrap_or(&sheet.envelope.mesh);
        if so_far.triangles.len() <= MOST {
            break;
        }
        if tolerance > sheet.tolerance {
            coarser = Some(sheet.chain.envelope(&sheet.motion, tolerance, &Silent)?.mesh);
        }
        tolerance *= 2.0;
    }
    Ok(coarser.unwrap_or_else(|| sheet.envelope.mesh.clone()))
}

/// Where the tool goes, seen from above: by the middle of its axis, else by its tip.
fn ahead(sheet: &EnvelopeSheet) -> DVec2 {
    let [a, b] = [0.0, 1.0].map(|t| sheet.motion.pose(t));
    let middle = DVec3::Z * 0.5 * sheet.contour.height();
    let way = (b.point(middle) - a.point(middle)).truncate();
    way.try_normalize()
        .or_else(|| (b.translation - a.translation).truncate().try_normalize())
        .unwrap_or(DVec2::X)
}

fn faces(view: &View, mesh: &Mesh, labels: &[Part], seen: &[bool]) -> Vec<Drawn> {
    // The order of drawing looks along the diagonal of a cube: the body is turned so that the viewer stands there.
    let to_diagonal = {
        let viewer = DVec3::new(1.0, -1.0, 1.0) / 3f64.sqrt();
        let right = DVec3::new(1.0, 1.0, 0.0) / 2f64.sqrt();
        DMat3::from_cols(right, viewer.cross(right), viewer)
    };
    let [right, up, viewer] = view.axes();
    let turn = to_diagonal * DMat3::from_cols(right, up, viewer).transpose();
    let back = turn.transpose();
    let facets = Facets {
        corners: mesh.vertices.iter().map(|&v| (turn * v).to_array()).collect(),
        faces: mesh.triangles.iter().map(|t| t.to_vec()).collect(),
    };
    let numbered = facets.seen_numbered().filter(|(body, _)| seen[*body]);
    let pieces = numbered.map(|(body, face)| PaintedPiece { face, body }).collect();
    let px = |p: [f64; 3]| view.px(back * DVec3::from_array(p));
    painted(pieces)
        .into_iter()
        .map(|piece| {
            let outline: Vec<[f64; 2]> = piece.face.outline.iter().map(|&p| px(p)).collect();
            let n = outline.len();
            let edges = (0..n)
                .filter(|&i| piece.face.drawn.get(i).copied().unwrap_or(false))
                .map(|i| [outline[i], outline[(i + 1) % n]])
                .collect();
            Drawn { edges, part: labels[piece.body], normal: back * piece.face.normal, outline }
        })
        .collect()
}
