//! A contour with its edges as normal fans: point and normal are continuous along the whole of it.
//!
//! At a kink of the contour, and at the poles, an arc of no radius turns the normal from the old to the new direction. The
//! surface of the tool then is a topological sphere, and edges need no rule of their own.

use glam::DVec2;

use crate::tool::{Contour, ContourShape, DOWN, ElementRole, UP, turn};

/// Turn of the normal below which two elements meet smoothly [rad]: rounding of what tangents and arc sines give.
const SMOOTH: f64 = 1e-12;

/// Form of a piece. Lines have the way along them as parameter [mm], arcs the normal angle [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PieceShape {
    /// Cone, cylinder or disc.
    Line {
        /// Start: radius and height [mm].
        start: DVec2,
        /// Unit tangent.
        tangent: DVec2,
        /// Outward unit normal.
        normal: DVec2,
    },
    /// Torus, sphere, or with no radius an edge.
    Arc {
        /// Centre: radius and height [mm].
        centre: DVec2,
        /// Radius [mm], negative for a concave arc; zero for an edge.
        radius: f64,
    },
}

/// Kind of a piece of the contour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PieceKind {
    /// An element of the contour.
    Element,
    /// The normals of an edge.
    Edge,
    /// The normals of a tip, or of a pit on the axis.
    Pole,
}

/// A piece of the chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainPiece {
    /// Form.
    pub shape: PieceShape,
    /// Element, edge or pole.
    pub kind: PieceKind,
    /// Parameter at the start.
    pub from: f64,
    /// Parameter at the end; on a concave arc below that of the start.
    pub to: f64,
    /// Role of the element; of an edge, that of the element after it.
    pub role: ElementRole,
    /// Number of the body of a stacked tool, counted from the tip.
    pub body: u16,
}

impl ChainPiece {
    /// Radius and height at a parameter [mm].
    pub fn point(&self, u: f64) -> DVec2 {
        match self.shape {
            PieceShape::Line { start, tangent, .. } => start + tangent * u,
            PieceShape::Arc { centre, radius } => {
                let (sin, cos) = u.sin_cos();
                centre + DVec2::new(cos, sin) * radius
            }
        }
    }

    /// Outward unit normal at a parameter: its parts away from the axis and along it.
    pub fn normal(&self, u: f64) -> DVec2 {
        match self.shape {
            PieceShape::Line { normal, .. } => normal,
            PieceShape::Arc { .. } => {
                let (sin, cos) = u.sin_cos();
                DVec2::new(cos, sin)
            }
        }
    }

    /// Point and normal at once, with sine and cosine of the parameter of an arc.
    pub(super) fn place(&self, u: f64) -> (DVec2, DVec2, (f64, f64)) {
        match self.shape {
            PieceShape::Line { start, tangent, normal } => (start + tangent * u, normal, (0.0, 1.0)),
            PieceShape::Arc { centre, radius } => {
                let (sin, cos) = u.sin_cos();
                let normal = DVec2::new(cos, sin);
                (centre + normal * radius, normal, (sin, cos))
            }
        }
    }

    /// Moment of the normal about the origin [mm]: it grows with the way along a line, and depends on the centre alone on an
    /// arc.
    pub fn moment(&self, u: f64) -> f64 {
        match self.shape {
            PieceShape::Line { start, normal, .. } => normal.x * start.y - normal.y * start.x + u,
            PieceShape::Arc { centre, .. } => {
                let (sin, cos) = u.sin_cos();
                cos * centre.y - sin * centre.x
            }
        }
    }

    /// True for an edge or pole whose normals spread outwards; a concave one never bounds what the tool sweeps.
    pub fn is_convex(&self) -> bool {
        self.to > self.from
    }

    /// True for a piece without surface: an edge or a pole.
    pub fn is_fan(&self) -> bool {
        self.kind != PieceKind::Element
    }
}

/// A contour with the fans of its edges.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::sweep::ProfileChain;
/// use kinecut::tool::{Contour, ContourElement, ElementRole};
/// let flat = Contour::new(vec![
///     ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
///     ContourElement::line([5.0, 0.0], [5.0, 30.0], ElementRole::Cutting),
///     ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
/// ])
/// .unwrap();
/// let chain = ProfileChain::new(&flat);
/// assert_eq!(chain.pieces().len(), 5); // two edges between three elements
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ProfileChain {
    pieces: Vec<ChainPiece>,
    reach: f64,
}

impl ProfileChain {
    /// The chain of a contour.
    pub fn new(contour: &Contour) -> ProfileChain {
        let mut pieces: Vec<ChainPiece> = Vec::with_capacity(2 * contour.elements().len() + 1);
        let mut phi = DOWN;
        let mut reach = 0.0f64;
        for (i, element) in contour.elements().iter().enumerate() {
            let [first, last] = element.shape.normals();
            let (start, end) = (element.shape.start(), element.shape.end());
            let piece = |shape, kind, from, to| ChainPiece {
                shape,
                kind,
                from,
                to,
                role: element.role,
                body: element.body,
            };
            // The first element begins on the axis, wherever rounding has left the end of an arc there.
            let (kind, at) = match i {
                0 => (PieceKind::Pole, DVec2::new(0.0, start.y)),
                _ => (PieceKind::Edge, start),
            };
            pieces.extend(fan(at, phi, first).map(|(shape, to)| piece(shape, kind, phi, to)));
            let (shape, from, to) = match element.shape {
                ContourShape::Line { start, end } => {
                    let length = (end - start).length();
                    let tangent = (end - start) / length;
                    let normal = DVec2::new(tangent.y, -tangent.x);
                    (PieceShape::Line { start, tangent, normal }, 0.0, length)
                }
                ContourShape::Arc { centre, radius, convex, from, to } => {
                    let radius = if convex { radius } else { -radius };
                    (PieceShape::Arc { centre, radius }, from, to)
                }
            };
            pieces.push(piece(shape, PieceKind::Element, from, to));
            phi = last;
            reach = reach.max(start.length()).max(end.length());
        }
        if let Some(last) = pieces.last().copied() {
            let top = DVec2::new(0.0, last.point(last.to).y);
            let (from, kind) = (phi, PieceKind::Pole);
            let close = fan(top, from, UP);
            pieces.extend(close.map(|(shape, to)| ChainPiece { shape, kind, from, to, ..last }));
        }
        ProfileChain { pieces, reach }
    }

    /// The pieces from the bottom of the axis to its top.
    pub fn pieces(&self) -> &[ChainPiece] {
        &self.pieces
    }

    /// Largest distance of an end of an element from the origin [mm]: the lever of a rotation.
    pub fn reach(&self) -> f64 {
        self.reach
    }
}

/// The arc of no radius that turns the normal at a place, and the angle at which it ends; none where nothing turns.
fn fan(at: DVec2, from: f64, to: f64) -> Option<(PieceShape, f64)> {
    let by = turn(from, to);
    (by.abs() > SMOOTH).then_some((PieceShape::Arc { centre: at, radius: 0.0 }, from + by))
}
