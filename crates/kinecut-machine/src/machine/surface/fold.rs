//! Places at which a surface folds over or shrinks to a point.
//!
//! The product of the derivatives by the two variables keeps its direction, up to a slow turn, as long as it does not
//! vanish. Where it jumps to the opposite between two samples of the domain, it passes through zero between them, and
//! the place is found by bisection. Samples in which it vanishes are singular themselves. A fold that is crossed twice
//! between neighbouring samples is not seen.

use glam::DVec3;

use super::{GeneratedSurface, ShapeFunction};
use crate::base::{Code, Finding, Result};

/// Samples of each variable.
const SAMPLES: usize = 49;
/// Halvings of the distance between two samples: to rounding.
const HALVINGS: u32 = 50;
/// The product of the derivatives by its greatest value in the domain, below which it counts as vanishing.
const VANISHING: f64 = 1e-9;

/// Kind of a singular place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FoldKind {
    /// The surface turns back: both lines run in one direction there.
    Fold,
    /// One of the two variables does not move the point: a pole, an apex.
    Pole,
}

/// A place in the domain in which the surface is not regular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fold {
    /// Kind of the place.
    pub kind: FoldKind,
    /// The two variables [mm or rad].
    pub at: [f64; 2],
    /// The point [mm].
    pub point: DVec3,
}

impl GeneratedSurface {
    /// Places in the domain, its border included, where the surface folds over or shrinks to a point; those of the
    /// first variable's samples first. A whole line of such places gives many.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::surface::{FoldKind, GeneratedSurface};
    /// let ring = GeneratedSurface::named("sphere-ring").unwrap();
    /// assert!(ring.folds().unwrap().is_empty());
    /// let whole = ring.over("psi", -1.0, 2.0).folds().unwrap(); // the ring reaches its least latitude at psi = 0
    /// assert!(whole.iter().all(|f| f.kind == FoldKind::Fold && f.at[1].abs() < 1e-9) && !whole.is_empty());
    /// ```
    ///
    /// # Errors
    /// Those of [`GeneratedSurface::check`].
    pub fn folds(&self) -> Result<Vec<Fold>> {
        self.check()?;
        let shape = self.compiled()?;
        let place = |i: usize, j: usize| {
            let fraction = |k: usize| k as f64 / (SAMPLES - 1) as f64;
            [self.variables[0].at(fraction(i)), self.variables[1].at(fraction(j))]
        };
        let area = |at: [f64; 2]| shape.jet(at[0], at[1]).area();
        let areas: Vec<Vec<DVec3>> =
            (0..SAMPLES).map(|i| (0..SAMPLES).map(|j| area(place(i, j))).collect()).collect();
        let greatest = areas.iter().flatten().map(|a| a.length()).fold(0.0, f64::max);
        let vanishes = |a: DVec3| a.length() <= VANISHING * greatest;
        let mut folds = Vec::new();
        for i in 0..SAMPLES {
            for j in 0..SAMPLES {
                let here = areas[i][j];
                if vanishes(here) {
                    folds.push(fold_at(self, &shape, place(i, j)));
                    continue;
                }
                for (k, l) in [(i + 1, j), (i, j + 1)] {
                    let Some(there) = areas.get(k).and_then(|row| row.get(l)).copied() else { continue };
                    if vanishes(there) || here.dot(there) >= 0.0 {
                        continue;
                    }
                    let at = bisected(place(i, j), place(k, l), here, &area);
                    // A normal that only turns fast does not vanish.
                    if area(at).length() <= VANISHED_BY_BISECTION * greatest {
                        folds.push(fold_at(self, &shape, at));
                    }
                }
            }
        }
        Ok(folds)
    }

    /// Warnings about the folds of the domain: at most one of each kind, with the first place.
    ///
    /// # Errors
    /// Those of [`GeneratedSurface::check`].
    pub fn fold_findings(&self) -> Result<Vec<Finding>> {
        let folds = self.folds()?;
        let first = |kind: FoldKind| folds.iter().find(|f| f.kind == kind);
        let [u, v] = &self.variables;
        let remark = |fold: &Fold| {
            let what = match fold.kind {
                FoldKind::Fold => "folds over",
                FoldKind::Pole => "shrinks to a point",
            };
            let shown = |x: f64| (x * 1e6).round() / 1e6 + 0.0;
            let (a, b) = (shown(fold.at[0]), shown(fold.at[1]));
            let message = format!("surface `{}` {what} at {} = {a}, {} = {b}", self.name, u.name, v.name);
            Finding::warning(Code::SURFACE_FOLD, message)
                .point(fold.point.to_array())
                .help("end the domain there")
        };
        Ok([FoldKind::Fold, FoldKind::Pole].into_iter().filter_map(first).map(remark).collect())
    }
}

/// After bisection what is left of the product by its greatest value: the square root of rounding, for a product that
/// vanishes as the square of the distance.
const VANISHED_BY_BISECTION: f64 = 1e-7;

fn bisected(
    mut from: [f64; 2],
    mut to: [f64; 2],
    first: DVec3,
    area: &dyn Fn([f64; 2]) -> DVec3,
) -> [f64; 2] {
    let middle = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    for _ in 0..HALVINGS {
        let m = middle(from, to);
        if area(m).dot(first) > 0.0 {
            from = m;
        } else {
            to = m;
        }
    }
    middle(from, to)
}

fn fold_at(surface: &GeneratedSurface, shape: &ShapeFunction, at: [f64; 2]) -> Fold {
    let jet = shape.jet(at[0], at[1]);
    // Lengths over the whole domain of each variable, to compare millimetres with radians.
    let [a, b] = [0, 1].map(|k| {
        let variable = &surface.variables[k];
        jet.tangents[k].length() * (variable.to - variable.from)
    });
    let kind =
        if a.min(b) <= STANDING * a.max(b) || a.max(b) == 0.0 { FoldKind::Pole } else { FoldKind::Fold };
    Fold { kind, at, point: jet.point() }
}

/// Ratio of the derivatives at which the smaller one counts as zero: after bisection to rounding.
const STANDING: f64 = 1e-7;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_meridian_shrinks_to_a_point_at_the_pole() {
        let sphere = GeneratedSurface::named("sphere").unwrap();
        assert!(sphere.folds().unwrap().is_empty());
        for (from, to) in [(-0.4, 0.9), (0.0, 1.0)] {
            let folds = sphere.clone().over("th", from, to).folds().unwrap();
            assert!(!folds.is_empty());
            for fold in &folds {
                assert_eq!(fold.kind, FoldKind::Pole);
                assert!(fold.at[1].abs() < 1e-8 && fold.point.distance(DVec3::new(0.0, 0.0, 25.0)) < 1e-7);
            }
        }
    }

    #[test]
    fn a_cone_shrinks_to_a_point_at_its_apex() {
        let cone = GeneratedSurface::named("cone").unwrap().over("z", 0.0, 200.0);
        let apex = 30.0 / 0.35_f64.sin();
        let folds = cone.folds().unwrap();
        assert!(folds.iter().all(|f| f.kind == FoldKind::Pole && (f.at[1] - apex).abs() < 1e-7), "{folds:?}");
        let found = cone.fold_findings().unwrap();
        assert_eq!(found.len(), 1);
        assert!(found[0].message.contains("shrinks to a point"), "{}", found[0]);
    }

    /// The involute begins at its base circle: its edge of regression.
    #[test]
    fn an_involute_turns_back_at_its_base_circle() {
        let folds =
            GeneratedSurface::named("involute-cylinder").unwrap().over("phi", -0.5, 0.6).folds().unwrap();
        assert!(!folds.is_empty());
        assert!(
            folds.iter().all(|f| f.at[0].abs() < 1e-9 && (f.point.truncate().length() - 40.0).abs() < 1e-9)
        );
    }

    #[test]
    fn regular_surfaces_have_no_folds() {
        for surface in super::super::catalogue() {
            assert!(surface.folds().unwrap().is_empty(), "{}", surface.name);
        }
    }
}
