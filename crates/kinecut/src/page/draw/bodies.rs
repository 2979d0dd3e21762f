//! Bodies on a picture: what is seen of their faces, in the order in which they hide one another.
//!
//! Faces that follow one another and do not lie over one another on paper need no order: they are drawn together, each shade as
//! one path, then their edges.

use glam::DVec2;

use super::cover::contains;
use super::hidden::{FacePiece, painted};
use super::{Colour, Ink, Tint, View, Width, line};
use crate::page::picture::Picture;

/// Edges of bodies.
const EDGE: Ink = Ink::line(Colour::Ink, Width::Hair);
/// Most faces that are drawn together.
const MOST: usize = 64;
/// Share of a face in which something lies over it: less than all, since neighbours touch.
const WITHIN: f64 = 0.96;

/// Draws faces, each with the tint of its body.
pub(crate) fn put(picture: &mut Picture, view: &View, faces: Vec<FacePiece>, tint: impl Fn(usize) -> Tint) {
    let mut together = Together::default();
    for FacePiece { face, body } in painted(faces, view.viewer) {
        let outline: Vec<DVec2> = face.outline.iter().map(|&p| DVec2::from(view.px(p))).collect();
        let next = |i: usize| outline[(i + 1) % outline.len()];
        let edges = (0..outline.len()).filter(|&i| face.drawn[i]).map(|i| [outline[i], next(i)]).collect();
        let ink = Ink::Face(tint(body), view.shade(face.normal));
        together.add(picture, Shown { ink, outline, edges });
    }
    together.put(picture);
}

/// A face on paper.
struct Shown {
    ink: Ink,
    outline: Vec<DVec2>,
    edges: Vec<[DVec2; 2]>,
}

impl Shown {
    fn middle(&self) -> DVec2 {
        self.outline.iter().sum::<DVec2>() / self.outline.len().max(1) as f64
    }

    /// Whether a face and its edges would be covered in part.
    fn covers(&self, other: &Shown) -> bool {
        let middle = self.middle();
        let own: Vec<DVec2> = self.outline.iter().map(|p| middle + (p - middle) * WITHIN).collect();
        let edges = other.edges.iter().flat_map(|[a, b]| [0.1, 0.5, 0.9].map(|t| a.lerp(*b, t)));
        let corners = other.outline.iter().copied();
        corners.chain(edges).chain([other.middle()]).any(|p| contains(&own, p))
            || contains(&other.outline, middle)
    }
}

/// Faces that are drawn together.
#[derive(Default)]
struct Together(Vec<Shown>);

impl Together {
    fn add(&mut self, picture: &mut Picture, next: Shown) {
        if self.0.len() >= MOST || self.0.iter().any(|s| next.covers(s)) {
            self.put(picture);
        }
        self.0.push(next);
    }

    fn put(&mut self, picture: &mut Picture) {
        let path = |points: &[DVec2]| line(points.iter().map(|p| p.to_array()));
        let mut fills: Vec<(Ink, String)> = Vec::new();
        let mut edges = String::new();
        for Shown { ink, outline, edges: own } in self.0.drain(..) {
            let d = path(&outline) + "Z";
            match fills.iter_mut().find(|f| f.0 == ink) {
                Some((_, all)) => *all += &d,
                None => fills.push((ink, d)),
            }
            edges.extend(own.iter().map(|e| path(e)));
        }
        fills.into_iter().for_each(|(ink, d)| picture.path(ink, d));
        picture.path(EDGE, edges);
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::geom::{Aabb, Rigid, Solid};
    use crate::page::draw::Facets;
    use crate::page::picture::Shape;

    #[test]
    fn a_body_before_another_one_is_drawn_after_it() {
        let cube = |at: DVec3| Solid::Box(Aabb { min: at, max: at + 10.0 });
        let view = View::isometric();
        // The first one is nearer to the viewer; both overlap on paper.
        let bodies = [cube(DVec3::ZERO), cube(DVec3::new(-14.0, 14.0, -2.0))];
        let faces = bodies.iter().enumerate().flat_map(|(body, solid)| {
            let seen = Facets::of(solid, &Rigid::IDENTITY).seen(view.viewer);
            seen.into_iter().map(move |(_, face)| FacePiece { face, body })
        });
        let mut picture = Picture::default();
        put(&mut picture, &view, faces.collect(), |body| if body == 0 { Tint::Blue } else { Tint::Sand });
        let tints = picture.shapes.iter().filter_map(|s| match s {
            Shape::Path { ink: Ink::Face(tint, _), .. } => Some(*tint),
            _ => None,
        });
        let mut order: Vec<Tint> = tints.collect();
        order.dedup();
        assert_eq!(order, [Tint::Sand, Tint::Blue]);
        assert!(
            matches!(picture.shapes.last(), Some(Shape::Path { ink: EDGE, .. })),
            "edges after their faces"
        );
    }
}
