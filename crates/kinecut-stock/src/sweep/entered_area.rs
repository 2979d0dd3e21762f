//! Area of a tool that enters at one moment, and the volume that it gains.
//!
//! On each parallel circle the tool enters on `|theta - psi| < alpha`, so the area and the volume entered per unit of the motion
//! are integrals of one variable: `2 alpha x` and `2 (r sin alpha + c alpha) x`. A closed body enters as much as it leaves.

use std::f64::consts::PI;

use super::normal_velocity::PieceVelocity;
use super::{Grazing, PieceShape, ProfileChain, twist};
use crate::machine::Twist;
use crate::num::quadrature::gauss;

/// Width of a panel of the quadrature, of a stretch between two folds: the integrand is smooth there.
const PANEL: f64 = 0.25;

/// Areas and volumes that enter of a piece of the chain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnteredArea {
    /// Area [mm2]; of an edge or tip none.
    pub area: f64,
    /// Area that enters [mm2].
    pub entering: f64,
    /// Part that enters: of the area, of an edge or tip of its normals.
    pub share: f64,
    /// Volume that it enters per unit of the motion [mm3].
    pub gained: f64,
    /// Volume that it leaves per unit of the motion [mm3].
    pub lost: f64,
}

impl ProfileChain {
    /// Area and volume of each piece that enter under a twist; `grazing` is that of the same twist.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::{machine::Twist, sweep::ProfileChain, tool::{Contour, ContourElement, ElementRole}};
    /// let flat = Contour::new(vec![
    ///     ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 0.0], [5.0, 30.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
    /// ])
    /// .unwrap();
    /// let chain = ProfileChain::new(&flat);
    /// let along = Twist::translation(DVec3::new(2.0, 0.0, 0.0));
    /// let entering = chain.entered_areas(&along, &chain.grazing(&along));
    /// // Half of the cylinder enters, and its section of 10 by 30 at 2 mm per unit.
    /// assert!((entering[2].share - 0.5).abs() < 1e-12);
    /// assert!((entering.iter().map(|e| e.gained).sum::<f64>() - 600.0).abs() < 1e-9);
    /// ```
    pub fn entered_areas(&self, twist: &Twist, grazing: &Grazing) -> Vec<EnteredArea> {
        let (twist, _) = twist::clean(twist, self.reach());
        let one = |(index, piece): (usize, &super::ChainPiece)| {
            let velocity = PieceVelocity::new(piece, &twist);
            let speed = match piece.shape {
                PieceShape::Line { .. } => 1.0,
                PieceShape::Arc { radius, .. } => radius.abs(),
            };
            let mut stops = vec![piece.from, piece.to];
            stops.extend(grazing.spans.iter().filter(|s| s.piece == index).flat_map(|s| [s.from, s.to]));
            stops.sort_by(f64::total_cmp);
            let mut sums = [0.0; 4];
            for pair in stops.windows(2) {
                let length = pair[1] - pair[0];
                if length <= 0.0 {
                    continue;
                }
                // Square roots at folds become smooth in t; each sum by itself, so that one quadrature serves all.
                let integral = |f: &dyn Fn(f64) -> f64| {
                    gauss(0.0, 1.0, PANEL, |t| {
                        f(pair[0] + length * t * t * (3.0 - 2.0 * t)) * 6.0 * length * t * (1.0 - t)
                    })
                };
                sums[0] += integral(&|u| velocity.at(u).alpha() / PI);
                if speed == 0.0 {
                    continue;
                }
                let ring = |u: f64| piece.point(u).x * speed;
                sums[1] += integral(&|u| 2.0 * velocity.at(u).alpha() * ring(u));
                sums[2] += integral(&|u| {
                    let v = velocity.at(u);
                    let alpha = v.alpha();
                    2.0 * (v.across.length() * alpha.sin() + v.mean * alpha) * ring(u)
                });
                sums[3] += integral(&|u| 2.0 * PI * velocity.at(u).mean * ring(u));
            }
            let [normals, entering, gained, net] = sums;
            let area = if speed == 0.0 { 0.0 } else { area(piece) };
            let width = (piece.to - piece.from).abs();
            let share = if area > 0.0 { entering / area } else { normals / width };
            EnteredArea { area, entering, share, gained, lost: gained - net }
        };
        self.pieces().iter().enumerate().map(one).collect()
    }
}

/// Area of the surface of revolution [mm2], in closed form.
fn area(piece: &super::ChainPiece) -> f64 {
    let [a, b] = [piece.from, piece.to];
    match piece.shape {
        PieceShape::Line { .. } => PI * (piece.point(a).x + piece.point(b).x) * (b - a),
        PieceShape::Arc { centre, radius } => {
            2.0 * PI * radius * (centre.x * (b - a) + radius * (b.sin() - a.sin()))
        }
    }
    .abs()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use glam::DVec3;

    use super::*;
    use crate::tool::{Contour, ContourElement, ElementRole};

    fn lollipop() -> ProfileChain {
        let phi = (2.0f64 / 5.0).acos();
        let neck = 5.0 + 5.0 * phi.sin();
        ProfileChain::new(
            &Contour::new(vec![
                ContourElement::arc([0.0, 5.0], 5.0, -FRAC_PI_2, phi, ElementRole::Cutting),
                ContourElement::line([2.0, neck], [2.0, 30.0], ElementRole::Shank),
                ContourElement::line([2.0, 30.0], [6.0, 40.0], ElementRole::Holder),
                ContourElement::line([6.0, 40.0], [0.0, 40.0], ElementRole::Holder),
            ])
            .unwrap(),
        )
    }

    #[test]
    fn a_closed_tool_enters_as_much_as_it_leaves() {
        let chain = lollipop();
        let motions = [
            ([3.0, 1.0, -2.0], [0.0, 0.0, 0.0]),
            ([3.0, 1.0, -2.0], [0.2, -0.1, 0.4]),
            ([0.0, 0.0, -1.0], [0.0, 0.0, 0.0]),
            ([0.0, 0.0, 0.0], [0.1, 0.3, 0.0]),
            ([0.1, 0.0, 0.3], [0.3, -0.3, 5.0]),
        ];
        for (v, w) in motions {
            let twist = Twist { shift: DVec3::from(v), turn: DVec3::from(w) };
            let found = chain.entered_areas(&twist, &chain.grazing(&twist));
            let gained: f64 = found.iter().map(|e| e.gained).sum();
            let lost: f64 = found.iter().map(|e| e.lost).sum();
            assert!(gained > 0.0 && (gained - lost).abs() < 1e-9 * gained, "{v:?} {w:?}: {gained} {lost}");
        }
    }

    #[test]
    fn areas_agree_with_a_count_of_cells() {
        let chain = lollipop();
        let twist = Twist { shift: DVec3::new(1.0, 2.0, -1.5), turn: DVec3::new(0.1, 0.05, 0.0) };
        let found = chain.entered_areas(&twist, &chain.grazing(&twist));
        for (piece, entering) in chain.pieces().iter().zip(&found).filter(|p| !p.0.is_fan()) {
            let (mut area, mut enters) = (0.0, 0.0);
            let (rows, columns) = (400, 720);
            for i in 0..rows {
                let u = piece.from + (piece.to - piece.from) * (f64::from(i) + 0.5) / f64::from(rows);
                let (p, n) = (piece.point(u), piece.normal(u));
                for j in 0..columns {
                    let (sin, cos) = (2.0 * PI * f64::from(j) / f64::from(columns)).sin_cos();
                    let at = DVec3::new(p.x * cos, p.x * sin, p.y);
                    let normal = DVec3::new(n.x * cos, n.x * sin, n.y);
                    let cell = p.x * (piece.point(piece.to) - piece.point(piece.from)).length().max(1.0);
                    area += cell;
                    if normal.dot(twist.shift + twist.turn.cross(at)) > 0.0 {
                        enters += cell;
                    }
                }
            }
            assert!((entering.share - enters / area).abs() < 2e-3, "{entering:?} {}", enters / area);
        }
    }

    #[test]
    fn areas_are_those_of_pappus() {
        let chain = lollipop();
        let twist = Twist::translation(DVec3::X);
        let found = chain.entered_areas(&twist, &chain.grazing(&twist));
        // A zone of a sphere: 2 pi r h.
        let height = 5.0 + 5.0 * (2.0f64 / 5.0).acos().sin();
        assert!((found[0].area - 2.0 * PI * 5.0 * height).abs() < 1e-9, "{}", found[0].area);
        assert!((found[0].share - 0.5).abs() < 1e-12);
    }
}
