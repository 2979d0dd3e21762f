//! The swept body on paper: faces in the order in which they hide one another, and which points are seen.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::parts::{EnvelopePart, parts};
use crate::base::{Result, Silent};
use crate::geom::Mesh;
use crate::page::draw::{Cover, FacePiece, Facets, SeenFace, View};
use crate::verbs::envelope::EnvelopeSheet;
use crate::verbs::grazing::show::view_of;

/// Parts of the body's longest side by which the drawn mesh may leave the envelope: below a pixel.
const FINENESS: f64 = 600.0;
/// Most triangles of a picture, and how often the tolerance is doubled for them.
const MOST: usize = 16_000;
const COARSER: u32 = 3;
/// Distance of the points of a face that are looked at [px], and by which part they are drawn to its middle.
const SAMPLE: f64 = 6.0;
const WITHIN: f64 = 0.05;
/// Distance by which a face must be nearer than a point of the surface to hide it, by the size of the body: more than
/// the drawn mesh is off.
const OFF: f64 = 0.006;

/// View of an envelope.
pub(crate) struct Scene {
    pub(crate) view: View,
    /// The part of each face of the mesh.
    pub(crate) labels: Vec<EnvelopePart>,
    /// Pieces that are not wholly hidden, each with the number of its face.
    pub(crate) pieces: Vec<FacePiece>,
    pub(crate) cover: Cover,
}

impl Scene {
    /// The scene in a box: left, top, width, height [px].
    pub(crate) fn new(sheet: &EnvelopeSheet, at: [f64; 4]) -> Result<Scene> {
        let size = sheet.envelope.mesh.bounds().size().max_element();
        let mesh = drawn_mesh(sheet, size)?;
        let view = view_of(ahead(sheet)).fitting(mesh.vertices.iter().copied(), at);
        let labels = parts(sheet, &mesh);
        let faces = mesh.triangles.iter().map(|t| t.to_vec()).collect();
        let seen = Facets { corners: mesh.vertices, faces }.seen(view.viewer);
        let mut pieces: Vec<FacePiece> =
            seen.into_iter().map(|(body, face)| FacePiece { face, body }).collect();
        let cover = Cover::new(view, &pieces, OFF * size);
        // Faces wholly behind others are left out before the rest is ordered: a body that cuts itself has many.
        let shown: Vec<bool> = pieces.par_iter().map(|p| shows(&view, &cover, &p.face)).collect();
        let mut shown = shown.into_iter();
        pieces.retain(|_| shown.next().unwrap_or(false));
        Ok(Scene { view, labels, pieces, cover })
    }
}

/// Whether any point of a triangle, a few pixels apart, is free.
fn shows(view: &View, cover: &Cover, face: &SeenFace) -> bool {
    let [a, b, c] = face.outline[..] else { return false };
    let q = [a, b, c].map(|p| DVec2::from(view.px(p)));
    let longest = (0..3).map(|i| (q[i] - q[(i + 1) % 3]).length()).fold(0.0, f64::max);
    let n = (longest / SAMPLE).ceil().clamp(1.0, 12.0);
    let middle = (a + b + c) / 3.0;
    let steps = 0..=n as u32;
    steps.clone().any(|i| {
        steps.clone().filter(|j| f64::from(i + j) <= n).any(|j| {
            let (s, t) = (f64::from(i) / n, f64::from(j) / n);
            let p = a * s + b * t + c * (1.0 - s - t);
            !cover.hides(p + (middle - p) * WITHIN)
        })
    })
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

/// Direction of the tool's motion, seen from above: of the middle of its axis, else of its tip.
fn ahead(sheet: &EnvelopeSheet) -> DVec2 {
    let [a, b] = [0.0, 1.0].map(|t| sheet.motion.pose(t));
    let middle = DVec3::Z * 0.5 * sheet.contour.height();
    let way = (b.point(middle) - a.point(middle)).truncate();
    way.try_normalize()
        .or_else(|| (b.translation - a.translation).truncate().try_normalize())
        .unwrap_or(DVec2::X)
}
