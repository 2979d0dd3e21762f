//! A tool whose arcs are chains of cones, as the paper proposes for the torus: kept as a baseline, with its error.
//!
//! On a cone the normal does not turn along the generator, so the grazing curve of the chain runs in steps: nearly along the
//! generator on a cone, and about the axis on the edge to the next one. Its distance from the exact curve falls with the number
//! of cones only as 1/n; the exact curve of the torus costs no more than that of one cone.

use glam::DVec3;

use super::ProfileChain;
use crate::base::{Code, Finding, Result};
use crate::machine::Twist;
use crate::tool::{Contour, ContourElement, ContourShape};

/// Most cones for an arc: what more would show is rounding.
const MOST: usize = 100_000;
/// Tolerance of the sampled curves, by the reach of the tool: a thousandth of the error of some hundred cones, and every point
/// is compared with every leg.
const SAMPLED: f64 = 3e-5;

/// The contour with every arc replaced by chords between as many equal steps of its normal.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::{sweep::cone_chain, tool::{Contour, ContourElement, ElementRole}};
/// let quarter = ContourElement::arc([0.0, 5.0], 5.0, -std::f64::consts::FRAC_PI_2, 0.0, ElementRole::Cutting);
/// let up = ContourElement::line([5.0, 5.0], [5.0, 20.0], ElementRole::Cutting);
/// let ball = Contour::new(vec![quarter, up, ContourElement::line([5.0, 20.0], [0.0, 20.0], ElementRole::Shank)]).unwrap();
/// assert_eq!(cone_chain(&ball, 8).unwrap().elements().len(), 10);
/// ```
///
/// # Errors
/// `KC1210` for no cones, or more than 100 000; those of the contour.
pub fn cone_chain(contour: &Contour, cones: usize) -> Result<Contour> {
    if cones == 0 || cones > MOST {
        return Err(Finding::error(Code::CONE_CHAIN, "a chain of cones has from one to 100 000 of them")
            .value(cones as f64, "")
            .bound(MOST as f64, "")
            .into());
    }
    let mut elements: Vec<ContourElement> = Vec::new();
    for element in contour.elements() {
        let ContourShape::Arc { from, to, .. } = element.shape else {
            elements.push(*element);
            continue;
        };
        let mut start = element.shape.start();
        for k in 1..=cones {
            let end = match k == cones {
                true => element.shape.end(),
                false => on(&element.shape, from + (to - from) * k as f64 / cones as f64),
            };
            elements.push(ContourElement { shape: ContourShape::Line { start, end }, ..*element });
            start = end;
        }
    }
    Contour::new(elements)
}

/// A point of an arc by its normal angle.
fn on(shape: &ContourShape, phi: f64) -> glam::DVec2 {
    match *shape {
        ContourShape::Line { start, .. } => start,
        ContourShape::Arc { centre, radius, convex, .. } => {
            let (sin, cos) = phi.sin_cos();
            centre + glam::DVec2::new(cos, sin) * if convex { radius } else { -radius }
        }
    }
}

/// Largest distance between the grazing curves of a tool and of its chain of cones, in both directions [mm]; infinite where
/// one of them has a curve and the other none.
///
/// # Errors
/// As [`cone_chain`].
pub fn cone_chain_error(contour: &Contour, twist: &Twist, cones: usize) -> Result<f64> {
    let exact = ProfileChain::new(contour);
    let chain = ProfileChain::new(&cone_chain(contour, cones)?);
    let [a, b] = [&exact, &chain].map(|c| curves(c, twist));
    Ok(farthest(&a, &b).max(farthest(&b, &a)))
}

/// All curves as points.
fn curves(chain: &ProfileChain, twist: &Twist) -> Vec<Vec<DVec3>> {
    let grazing = chain.grazing(twist);
    let tolerance = SAMPLED * chain.reach();
    let points = |l| chain.curve(&grazing, l, tolerance).iter().map(|p| p.point).collect();
    grazing.loops.iter().map(points).collect()
}

/// Largest distance of points of one set of curves from the other.
fn farthest(of: &[Vec<DVec3>], from: &[Vec<DVec3>]) -> f64 {
    let distance = |p: &DVec3| {
        let legs = from.iter().flat_map(|c| c.windows(2));
        legs.map(|leg| to_leg(*p, leg[0], leg[1])).fold(f64::INFINITY, |a, b| if b < a { b } else { a })
    };
    of.iter().flatten().map(distance).fold(0.0, |a, b| if b > a { b } else { a })
}

/// Distance of a point from a straight leg.
fn to_leg(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let square = along.length_squared();
    let t = if square > 0.0 { ((p - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    (p - a - along * t).length()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::tool::ElementRole;

    fn bull() -> Contour {
        Contour::new(vec![
            ContourElement::line([0.0, 0.0], [6.0, 0.0], ElementRole::Cutting),
            ContourElement::arc([6.0, 4.0], 4.0, -FRAC_PI_2, 0.0, ElementRole::Cutting),
            ContourElement::line([10.0, 4.0], [10.0, 30.0], ElementRole::Cutting),
            ContourElement::line([10.0, 30.0], [0.0, 30.0], ElementRole::Shank),
        ])
        .unwrap()
    }

    #[test]
    fn the_error_falls_as_one_over_the_number_of_cones() {
        let twist = Twist::translation(DVec3::new(10.0, 0.0, -3.0));
        let errors: Vec<f64> = [4, 8, 16, 32].map(|n| cone_chain_error(&bull(), &twist, n).unwrap()).to_vec();
        assert!(errors[0] > 0.1 && errors[3] > 0.005, "{errors:?}");
        for pair in errors.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!((1.5..2.6).contains(&ratio), "{errors:?}");
        }
    }

    #[test]
    fn a_tool_without_arcs_is_its_own_chain() {
        let flat = Contour::new(vec![
            ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
            ContourElement::line([5.0, 0.0], [5.0, 20.0], ElementRole::Cutting),
            ContourElement::line([5.0, 20.0], [0.0, 20.0], ElementRole::Shank),
        ])
        .unwrap();
        assert_eq!(cone_chain(&flat, 7).unwrap(), flat);
        let twist = Twist { turn: DVec3::new(0.1, 0.2, 0.0), shift: DVec3::new(1.0, 0.0, 0.4) };
        assert!(cone_chain_error(&flat, &twist, 7).unwrap() < 1e-9);
    }

    #[test]
    fn no_cones_are_refused() {
        assert_eq!(cone_chain(&bull(), 0).unwrap_err().code(), Code::CONE_CHAIN);
        assert!(cone_chain(&bull(), MOST + 1).is_err());
    }
}
