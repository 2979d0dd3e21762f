//! Volumes of sweeps of fixed axis.
//!
//! A straight move adds the tool's shadow along the way times its length: the ingress part of each parallel circle moves outwards
//! by `2 (R sin alpha + C alpha)` for a unit of the way, which is constant on a cone and integrated along arcs. A level arc about a
//! centre that the tool does not reach adds the section times the way of its middle (Pappus).

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::machine::kinematics::Twist;
use crate::num::quadrature::gauss;
use crate::sweep::{ChainPiece, PieceShape, ProfileChain};
use crate::tool::{Contour, ContourShape};

/// Widest panel of an integral along an arc [rad].
const PANEL: f64 = 0.25;

/// Volume of a tool [mm^3]: of each element the body between its surface and the axis.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::sweep::tool_volume;
/// use kinecut::tool::{Contour, ContourElement, ElementRole};
/// let ball = Contour::new(vec![
///     ContourElement::arc([0.0, 3.0], 3.0, -std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_2, ElementRole::Cutting),
/// ]);
/// assert!((tool_volume(&ball.unwrap()) - 36.0 * std::f64::consts::PI).abs() < 1e-12);
/// ```
pub fn tool_volume(contour: &Contour) -> f64 {
    let of = |shape: &ContourShape| match *shape {
        ContourShape::Line { start: a, end: b } => {
            PI * (b.y - a.y) * (a.x * a.x + a.x * b.x + b.x * b.x) / 3.0
        }
        ContourShape::Arc { centre, radius, convex, from, to } => {
            let r = if convex { radius } else { -radius };
            // x = xc + r cos, dz = r cos dphi: the integral of pi x^2 r cos.
            let antiderivative = |phi: f64| {
                let (sin, cos) = phi.sin_cos();
                let (c2, c3) = (0.5 * (phi + sin * cos), sin - sin * sin * sin / 3.0);
                centre.x * centre.x * sin + 2.0 * centre.x * r * c2 + r * r * c3
            };
            PI * r * (antiderivative(to) - antiderivative(from))
        }
    };
    contour.elements().iter().map(|e| of(&e.shape)).sum()
}

/// Area of the half-section of a tool [mm^2].
fn half_section(contour: &Contour) -> f64 {
    let of = |shape: &ContourShape| match *shape {
        ContourShape::Line { start: a, end: b } => 0.5 * (b.y - a.y) * (a.x + b.x),
        ContourShape::Arc { centre, radius, convex, from, to } => {
            let r = if convex { radius } else { -radius };
            let antiderivative = |phi: f64| {
                let (sin, cos) = phi.sin_cos();
                centre.x * sin + 0.5 * r * (phi + sin * cos)
            };
            r * (antiderivative(to) - antiderivative(from))
        }
    };
    contour.elements().iter().map(|e| of(&e.shape)).sum()
}

/// Volume that a convex tool sweeps on a straight move of fixed axis [mm^3]; `way` in coordinates of the tool. Of a tool that is
/// not convex it is a bound from above: what is swept twice counts twice.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use glam::DVec3;
/// use kinecut::sweep::line_volume;
/// use kinecut::tool::{Contour, ContourElement, ElementRole};
/// let pin = Contour::new(vec![
///     ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
///     ContourElement::line([5.0, 0.0], [5.0, 30.0], ElementRole::Cutting),
///     ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
/// ]);
/// // The pin, a block between its flanks, and the ring of its bottom on the way down.
/// let volume = line_volume(&pin.unwrap(), DVec3::new(20.0, 0.0, -7.0));
/// let exact = 25.0 * std::f64::consts::PI * (30.0 + 7.0) + 20.0 * 10.0 * 30.0;
/// assert!((volume / exact - 1.0).abs() < 1e-14);
/// ```
pub fn line_volume(contour: &Contour, way: DVec3) -> f64 {
    let chain = ProfileChain::new(contour);
    let twist = Twist { turn: DVec3::ZERO, shift: way };
    let rate = |index: usize, piece: &ChainPiece, u: f64| {
        let velocity = chain.normal_velocity(&twist, index, u);
        let alpha = velocity.alpha();
        let outwards = velocity.across.length() * alpha.sin() + velocity.mean * alpha;
        2.0 * outwards * piece.point(u).x
    };
    let shadow = |(index, piece): (usize, &ChainPiece)| match piece.shape {
        // The rate is in proportion to the radius: the middle is the mean.
        PieceShape::Line { .. } => {
            rate(index, piece, 0.5 * (piece.from + piece.to)) * (piece.to - piece.from)
        }
        PieceShape::Arc { radius, .. } if radius != 0.0 => {
            // Roots of the discriminant, where alpha sets out like a root: by the square from both of their sides.
            let fold = way.truncate().length().atan2(way.z.abs());
            let (low, high) = (piece.from.min(piece.to), piece.from.max(piece.to));
            let mut cuts = vec![low];
            cuts.extend([-fold, fold].into_iter().filter(|f| *f > low && *f < high));
            cuts.push(high);
            let smooth = |a: f64, b: f64| {
                let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
                let f = |tau: f64| rate(index, piece, middle + half * tau.sin()) * half * tau.cos();
                gauss(-0.5 * PI, 0.5 * PI, PANEL, f)
            };
            cuts.windows(2).map(|w| smooth(w[0], w[1])).sum::<f64>() * radius.abs()
        }
        PieceShape::Arc { .. } => 0.0,
    };
    tool_volume(contour) + chain.pieces().iter().enumerate().map(shadow).sum::<f64>()
}

/// Volume that a tool sweeps on a level arc of fixed axis [mm^3]. `None` where its ends meet or the tool reaches the
/// centre, and for a tool that a line across its axis cuts twice: the section between would be filled.
pub fn arc_volume(contour: &Contour, radius: f64, sweep: f64) -> Option<f64> {
    let widest = contour.elements().iter().fold(0.0f64, |most, e| match e.shape {
        ContourShape::Line { start, end } => most.max(start.x).max(end.x),
        ContourShape::Arc { centre, radius, convex, .. } => {
            most.max(e.shape.start().x).max(e.shape.end().x).max(if convex { centre.x + radius } else { 0.0 })
        }
    });
    let rises = contour.elements().windows(2).all(|w| w[1].shape.end().y >= w[0].shape.end().y - RISE);
    let sweep = sweep.abs();
    // Written so that NaN is refused.
    if !(radius >= widest && radius > 0.0 && sweep <= TAU && rises) {
        return None;
    }
    let ring = 2.0 * radius * sweep * half_section(contour);
    if sweep == TAU {
        return Some(ring);
    }
    let ends = 2.0 * (widest / radius).min(1.0).asin();
    (sweep + ends <= TAU).then(|| ring + tool_volume(contour))
}

/// Fall of a contour that is rounding [mm].
const RISE: f64 = 1e-9;
