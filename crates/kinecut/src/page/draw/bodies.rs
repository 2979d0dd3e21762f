//! Bodies on a picture: what is seen of their faces, in the order in which they hide one another.

use super::hidden::{Piece, painted};
use super::{Colour, Ink, Tint, View, Width, line};
use crate::page::picture::Picture;

/// Edges of bodies.
const EDGE: Ink = Ink::line(Colour::Ink, Width::Hair);

/// Draws faces, each with the tint of its body; neighbours of one look are one path, edges follow their face.
pub(crate) fn put(picture: &mut Picture, view: &View, faces: Vec<Piece>, tint: impl Fn(usize) -> Tint) {
    let mut run: Option<(Ink, String)> = None;
    for Piece { face, body } in painted(faces, view.viewer) {
        let outline: Vec<[f64; 2]> = face.outline.iter().map(|&p| view.px(p)).collect();
        let ink = Ink::Face(tint(body), view.shade(face.normal));
        let d = line(outline.iter().copied()) + "Z";
        match &mut run {
            Some((same, all)) if *same == ink => *all += &d,
            _ => {
                if let Some((ink, d)) = run.replace((ink, d)) {
                    picture.path(ink, d);
                }
            }
        }
        let next = |i: usize| outline[(i + 1) % outline.len()];
        let drawn = face.drawn.iter().enumerate().filter(|(_, drawn)| **drawn);
        let edges: String = drawn.map(|(i, _)| line([outline[i], next(i)])).collect();
        if !edges.is_empty() {
            if let Some((ink, d)) = run.take() {
                picture.path(ink, d);
            }
            picture.path(EDGE, edges);
        }
    }
    if let Some((ink, d)) = run {
        picture.path(ink, d);
    }
}
