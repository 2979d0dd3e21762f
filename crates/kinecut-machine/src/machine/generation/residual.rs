//! Traced and copied surfaces against the wanted one.
//!
//! The generated point is `M(machine) * tool`, a function of two variables. Its signed distance from the wanted surface is
//! taken on a grid; the greatest and the least are followed down from the grid by parabolas, and the root of the mean
//! square is weighted by area with Simpson's rule.

use glam::DVec3;
use rayon::prelude::*;

use super::{Distance, SurfaceMap};
use crate::base::{Code, Finding, Progress, Result};
use crate::num::minimum::minimum_over;

/// A place on the generated surface, and its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceError {
    /// Signed distance from the wanted surface [mm]: positive outside of its material.
    pub distance: f64,
    /// Values of the two variables.
    pub at: [f64; 2],
    /// The point [mm].
    pub point: DVec3,
}

/// Deviation of a generated surface from the wanted one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// The lowest place.
    pub least: SurfaceError,
    /// The highest place.
    pub greatest: SurfaceError,
    /// Root of the mean square over the area [mm].
    pub rms: f64,
    /// Greatest angle between the normals of both surfaces [rad], on the grid; zero where the generated surface has no
    /// normal.
    pub tilt: f64,
    /// Area of the generated surface [mm^2].
    pub area: f64,
}

impl Residual {
    /// The place farthest from the wanted surface.
    pub fn worst(&self) -> SurfaceError {
        let lower = self.least.distance.abs() > self.greatest.distance.abs();
        if lower { self.least } else { self.greatest }
    }

    /// `KC1133` when the generated surface is farther away than `tolerance` [mm].
    pub fn finding(&self, tolerance: f64) -> Option<Finding> {
        let worst = self.worst();
        (!(worst.distance.abs() <= tolerance)).then(|| {
            Finding::error(Code::GENERATION_RESIDUAL, "the generated surface is not the wanted one")
                .value(worst.distance * 1e3, "um")
                .bound(tolerance * 1e3, "um")
                .point(worst.point.to_array())
                .help("correct the settings and the laws of the motions, or the edge of the tool")
        })
    }
}

/// Compares a generated surface over `domain` with the wanted one on a grid of `cells` cells (made even).
///
/// ```
/// # use kinecut_machine as kinecut;
/// use glam::DVec3;
/// use kinecut::base::Silent;
/// use kinecut::machine::generation::{residual, ElementaryBody};
/// // A cone that was turned with its angle set wrong, against a cylinder of radius 25.
/// let turned = |f: f64, z: f64| DVec3::new((25.0 + 0.001 * z) * f.cos(), (25.0 + 0.001 * z) * f.sin(), z);
/// let wanted = ElementaryBody::Cylinder { point: DVec3::ZERO, axis: DVec3::Z, radius: 25.0 };
/// let found = residual(&turned, [[0.0, 6.0], [0.0, 40.0]], [8, 8], &wanted, &Silent).unwrap();
/// assert!((found.worst().distance - 0.04).abs() < 1e-12);
/// ```
///
/// # Errors
/// `KC1131` for a domain that is empty or a point that is not finite; `KC0009` when cancelled.
pub fn residual<S: SurfaceMap + ?Sized, W: Distance + ?Sized>(
    generated: &S,
    domain: [[f64; 2]; 2],
    cells: [usize; 2],
    wanted: &W,
    progress: &dyn Progress,
) -> Result<Residual> {
    let lengths = domain.map(|[from, to]| to - from);
    if !lengths.iter().all(|&l| l >= 0.0 && l.is_finite()) || lengths == [0.0, 0.0] {
        return Err(Finding::error(Code::GENERATION_INPUT, "the range of a generated surface is empty")
            .value(lengths[0], "")
            .bound(0.0, "")
            .help("give ranges whose end is above their start")
            .into());
    }
    let [nu, nv] = [0, 1].map(|k| if lengths[k] > 0.0 { cells[k].div_ceil(2).max(1) * 2 } else { 0 });
    let place = |i: usize, j: usize| {
        let along = |k: usize, i: usize, n: usize| domain[k][0] + lengths[k] * i as f64 / n.max(1) as f64;
        [along(0, i, nu), along(1, j, nv)]
    };
    let sample = |i: usize, j: usize| {
        let [u, v] = place(i, j);
        let point = generated.point(u, v);
        let normal = tangents(generated, [u, v], lengths);
        let distance = wanted.signed(point);
        let (area, tilt) = (normal.length(), tilt(normal, wanted.gradient(point)));
        (distance, area, tilt)
    };
    let rows: Vec<Option<Vec<(f64, f64, f64)>>> = (0..=nu)
        .into_par_iter()
        .map(|i| (!progress.cancelled()).then(|| (0..=nv).map(|j| sample(i, j)).collect()))
        .collect();
    let Some(rows) = rows.into_iter().collect::<Option<Vec<_>>>() else {
        return Err(Finding::error(Code::CANCELLED, "the comparison was cancelled").into());
    };
    let (mut area, mut squares, mut tilt, mut greatest) = (0.0, 0.0, 0.0f64, 0.0f64);
    for (i, row) in rows.iter().enumerate() {
        for (j, &(distance, density, angle)) in row.iter().enumerate() {
            if !distance.is_finite() {
                return Err(Finding::error(Code::GENERATION_INPUT, "a generated point is not finite")
                    .value(place(i, j)[0], "")
                    .help("choose parameters and ranges for which the laws have values")
                    .into());
            }
            let weight = simpson(i, nu) * simpson(j, nv) * density;
            area += weight;
            squares += weight * distance * distance;
            tilt = tilt.max(angle);
            greatest = greatest.max(distance.abs());
        }
    }
    let even = (rows.len() * rows[0].len()) as f64;
    let rms = if area > 0.0 {
        (squares / area).sqrt()
    } else {
        (rows.iter().flatten().map(|s| s.0 * s.0).sum::<f64>() / even).sqrt()
    };
    let extreme = |sign: f64| {
        let nodes = (0..=nu).flat_map(|i| (0..=nv).map(move |j| (i, j)));
        let node = nodes.min_by(|a, b| (sign * rows[a.0][a.1].0).total_cmp(&(sign * rows[b.0][b.1].0)));
        if greatest <= ROUNDING
            && let Some((i, j)) = node
        {
            let at = place(i, j);
            return SurfaceError { distance: rows[i][j].0, at, point: generated.point(at[0], at[1]) };
        }
        let f = |[u, v]: [f64; 2]| sign * wanted.signed(generated.point(u, v));
        let (at, value) = minimum_over(f, domain, [nu, nv]);
        SurfaceError { distance: sign * value, at, point: generated.point(at[0], at[1]) }
    };
    let (least, greatest) = rayon::join(|| extreme(1.0), || extreme(-1.0));
    Ok(Residual { least, greatest, rms, tilt, area })
}

/// Product of both derivatives, by differences over the lengths of the ranges; a range of no length counts as one
/// tangent of length one, so that a curve has a density of length.
fn tangents<S: SurfaceMap + ?Sized>(surface: &S, at: [f64; 2], lengths: [f64; 2]) -> DVec3 {
    let along = |k: usize| {
        let h = lengths[k] * STEP;
        let mut ends = [at, at];
        ends[0][k] -= h;
        ends[1][k] += h;
        (surface.point(ends[1][0], ends[1][1]) - surface.point(ends[0][0], ends[0][1])) / (2.0 * STEP)
    };
    match lengths {
        [_, 0.0] => DVec3::X * along(0).length(),
        [0.0, _] => DVec3::X * along(1).length(),
        _ => along(0).cross(along(1)),
    }
}

/// Angle between two normals whose senses do not matter [rad].
fn tilt(a: DVec3, b: DVec3) -> f64 {
    if a == DVec3::ZERO || b == DVec3::ZERO { 0.0 } else { a.cross(b).length().atan2(a.dot(b).abs()) }
}

/// Weight of Simpson's rule of node `i` of `n` cells, as a share of the range.
fn simpson(i: usize, n: usize) -> f64 {
    let weight = match i {
        _ if n == 0 => 3.0,
        0 => 1.0,
        _ if i == n => 1.0,
        _ if i % 2 == 1 => 4.0,
        _ => 2.0,
    };
    weight / (3.0 * n.max(1) as f64)
}

/// Distance that is rounding everywhere on the grid, so that nothing is looked for between its nodes [mm].
const ROUNDING: f64 = 1e-9;
/// Step of central differences as a share of the range: the cube root of the rounding unit.
const STEP: f64 = 6e-6;
