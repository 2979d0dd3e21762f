//! The underside of a tool: its height over the radius.

use glam::DVec2;

use crate::tool::{Contour, ContourShape};

/// Form of a piece of the underside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LowerShape {
    /// `height + slope (rho - from)`.
    Cone {
        /// Height at the inner end [mm].
        height: f64,
        /// Rise by radius; negative on a hollow end.
        slope: f64,
    },
    /// A torus or sphere.
    Arc {
        /// Centre: radius and height [mm].
        centre: DVec2,
        /// Radius [mm], negative for a concave arc.
        radius: f64,
    },
}

/// A piece of the underside between two radii.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowerPiece {
    /// Inner radius [mm].
    pub from: f64,
    /// Outer radius [mm].
    pub to: f64,
    /// Form.
    pub shape: LowerShape,
}

impl LowerPiece {
    /// Height at a radius of the piece [mm].
    pub fn height(&self, rho: f64) -> f64 {
        match self.shape {
            LowerShape::Cone { height, slope } => height + slope * (rho - self.from),
            LowerShape::Arc { centre, radius } => {
                let off = rho - centre.x;
                centre.y - radius.signum() * ((radius - off) * (radius + off)).max(0.0).sqrt()
            }
        }
    }

    /// Derivative of the height by the radius; infinite at the end of an arc.
    pub fn slope(&self, rho: f64) -> f64 {
        match self.shape {
            LowerShape::Cone { slope, .. } => slope,
            LowerShape::Arc { centre, radius } => {
                let off = rho - centre.x;
                radius.signum() * off / ((radius - off) * (radius + off)).max(0.0).sqrt()
            }
        }
    }
}

/// The underside of a tool: all of its surface whose normal points down. Where pieces lie one over the other, as under the holder
/// of a stacked tool, each counts.
#[derive(Clone, Debug, PartialEq)]
pub struct LowerProfile {
    pieces: Vec<LowerPiece>,
    radius: f64,
}

/// Width below which a piece is dropped [mm].
const NO_WIDTH: f64 = 1e-12;

impl LowerProfile {
    /// The underside of a contour.
    pub fn new(contour: &Contour) -> LowerProfile {
        let mut pieces = Vec::new();
        for element in contour.elements() {
            match element.shape {
                ContourShape::Line { start, end } if end.x - start.x > NO_WIDTH => {
                    let slope = (end.y - start.y) / (end.x - start.x);
                    let shape = LowerShape::Cone { height: start.y, slope };
                    pieces.push(LowerPiece { from: start.x.max(0.0), to: end.x, shape });
                }
                ContourShape::Arc { centre, radius, convex, from, to } => {
                    // The part with normals downwards: angles from -pi to 0.
                    let (low, high) = (from.min(to).max(-std::f64::consts::PI), from.max(to).min(0.0));
                    if low >= high {
                        continue;
                    }
                    let radius = if convex { radius } else { -radius };
                    let ends = [low, high].map(|phi| centre.x + radius * phi.cos());
                    let (from, to) = (ends[0].min(ends[1]).max(0.0), ends[0].max(ends[1]));
                    if to - from > NO_WIDTH {
                        pieces.push(LowerPiece { from, to, shape: LowerShape::Arc { centre, radius } });
                    }
                }
                ContourShape::Line { .. } => {}
            }
        }
        let radius = pieces.iter().map(|p| p.to).fold(0.0, f64::max);
        LowerProfile { pieces, radius }
    }

    /// Its pieces, from the axis outwards on each body.
    pub fn pieces(&self) -> &[LowerPiece] {
        &self.pieces
    }

    /// Largest radius [mm].
    pub fn radius(&self) -> f64 {
        self.radius
    }
}
