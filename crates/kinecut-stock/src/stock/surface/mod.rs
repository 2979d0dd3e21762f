//! The surface of a tri-dexel body: a closed triangle mesh with sharp edges, flat regions in few triangles.
//!
//! For pictures, files and the comparison of vertices with the wanted part.
//!
//! Method: dual contouring on octrees, from the top down.
//! 1. `signs`: each lattice point is material or not, by majority of the three lines through it. All topology
//!    follows from these signs, so the mesh closes whatever the lines say; end points only place vertices.
//! 2. `block`: blocks of 16^3 cells become one leaf if the surface in them is one disk whose end points fit one
//!    vertex within the tolerance, else their eight parts are tried, down to single cells. A single cell has a
//!    vertex for each piece of surface in it (`cell`).
//! 3. `flat`: leaves in one plane are merged further.
//! 4. `polygon`: around each lattice edge with a change of sign the vertices of the leaves of its four cells
//!    make a quad, a triangle or nothing. Leaves of different size fit without cracks.
//! 5. `unfold`: facets folded over at a curved edge are laid straight.
//!
//! **Why the mesh is a manifold.** Regard the marching-cubes surface of all single cells, which is a closed
//! manifold made of one patch per piece in a cell. A leaf unites patches to a region; the mesh is the dual of the
//! regions. It is a manifold if every region is a disk and two regions meet in at most one chain of patch edges.
//! A region is a disk, and each of its block's faces carries at most one arc, when the signs in the block are
//! (a) along one axis changed exactly once, in one direction, on each lattice line (a graph over a square), or
//! (b) along each axis changed in one direction only (then each diagonal crosses the surface at most once: the
//! region is a graph over the diagonal, and its border is that of the eight corners). In both cases no face on the
//! block's border is ambiguous. Two regions meet in the smaller one's face, hence in one chain. Between single
//! cells `cell` resolves the one bad case.
//!
//! Sources: Ju, Losasso, Schaefer, Warren, Dual contouring of Hermite data (2002); Schaefer, Ju, Warren, Manifold
//! dual contouring (2007); Wenger, Isosurfaces (2013), for the ambiguous faces of dual marching cubes. Conditions
//! (a) and (b) are ours.

mod block;
#[cfg(test)]
pub(crate) mod bodies;
mod cell;
mod crossing;
mod fit;
mod flat;
mod forest;
mod polygon;
mod rows;
mod signs;
#[cfg(test)]
mod tests;
mod tree;
mod unfold;

use glam::DVec3;

use super::{CutId, DexelGrid};
use crate::base::{Code, Finding, Progress, Result};
use crate::geom::Mesh;

use self::crossing::Lines;
use self::forest::{Forest, Grown};
use self::polygon::Facets;
use self::signs::Signs;

/// Fineness of the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceOptions {
    /// Largest distance of an end point from the facets near it [mm]; default: a fiftieth of a step. Greater than 0; below about
    /// a thousandth of a step flat faces at an angle to the axes no longer merge, above a tenth facets become visible.
    pub tolerance: Option<f64>,
    /// Most memory that its vertices and triangles may take [bytes]; default: as much as they need. They are counted as they are found.
    pub memory: Option<u64>,
}

/// The default tolerance in grid steps.
const USUAL: f64 = 0.02;

impl SurfaceOptions {
    /// The tolerance over a lattice with a step [mm].
    pub fn tolerance(&self, step: f64) -> f64 {
        self.tolerance.unwrap_or(USUAL * step)
    }
}

/// Memory of what a surface needs however little of it there is [bytes], by the number of lattice points along X, Y, Z.
pub(super) fn memory(counts: [u32; 3]) -> u64 {
    let padded = counts.map(|n| u64::from(n) + 2);
    Signs::bytes(padded) + Forest::bytes(padded) + flat::bytes(padded)
}

/// A surface and the moves that made it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CutSurface {
    /// The closed mesh [mm].
    pub mesh: Mesh,
    /// For each triangle the move that cut the end point it was made around; 0 is raw stock.
    pub cuts: Vec<CutId>,
}

/// The closed surface of a body, see the head of this module.
///
/// A body without material gives an empty mesh.
///
/// # Errors
/// `KC0801` when the tolerance is not positive; `KC0105` when it would need more memory than allowed; `KC0009` when cancelled.
pub fn surface<G: DexelGrid + ?Sized>(
    grid: &G,
    options: &SurfaceOptions,
    progress: &dyn Progress,
) -> Result<Mesh> {
    Ok(surface_with_cuts(grid, options, progress)?.mesh)
}

/// The closed surface of a body with the move that made each triangle.
///
/// # Errors
/// As [`surface`].
pub fn surface_with_cuts<G: DexelGrid + ?Sized>(
    grid: &G,
    options: &SurfaceOptions,
    progress: &dyn Progress,
) -> Result<CutSurface> {
    let step = grid.lattice().step;
    let tolerance = options.tolerance(step);
    if !(tolerance.is_finite() && tolerance > 0.0) {
        return Err(Finding::error(Code::GEOMETRY, "the tolerance of a surface must be positive")
            .value_mm(tolerance)
            .bound_mm(0.0)
            .into());
    }
    // Inside of here lengths count in steps.
    let tolerance = tolerance / step;
    let lines = Lines::new(grid);
    progress.stage("surface", 4);
    let cancelled = || Finding::error(Code::CANCELLED, "the surface was not finished");
    let go_on = || {
        progress.advance(1);
        if progress.cancelled() { Err(cancelled()) } else { Ok(()) }
    };
    let signs = Signs::vote(&lines, progress);
    go_on()?;
    let mut forest = match Forest::grow(&lines, &signs, tolerance, options.memory, progress) {
        Grown::All(forest) => forest,
        Grown::Cancelled => return Err(cancelled().into()),
        Grown::TooMuch(bytes) => {
            let coarser = |tolerance: f64| {
                let grown = Forest::grow(&lines, &signs, tolerance, options.memory, progress);
                matches!(grown, Grown::All(_))
            };
            return Err(too_much(bytes, options, (tolerance, step), coarser).into());
        }
    };
    go_on()?;
    flat::merge(&mut forest, &lines, tolerance);
    let vertices = forest.number();
    go_on()?;
    let Facets { mut triangles, normals, cuts } =
        polygon::polygons(&forest, &lines, &signs, &vertices, progress).ok_or_else(cancelled)?;
    unfold::unfold(&mut triangles, &normals, &vertices);
    go_on()?;
    let vertices = vertices.into_iter().map(|v| lines.to_mm(v)).collect::<Vec<DVec3>>();
    Ok(CutSurface { mesh: Mesh { vertices, triangles }, cuts })
}

/// The error of a surface that needs more memory than it may take; `fits` tells whether another tolerance [cells] would do.
fn too_much(
    bytes: u64,
    options: &SurfaceOptions,
    (tolerance, step): (f64, f64),
    fits: impl Fn(f64) -> bool,
) -> Finding {
    /// Coarser tolerances that are tried, each as a multiple of the one before.
    const COARSER: f64 = 2.0;
    let limit = options.memory.unwrap_or(u64::MAX);
    let tries =
        std::iter::successors(Some(COARSER * tolerance), |t| Some(COARSER * t)).take_while(|t| *t < 1.0);
    let tolerance = tries.chain([1.0]).find(|t| fits(*t)).map(|t| rounded_up(t * step));
    let help = match tolerance {
        // No tolerance is coarser than a step.
        Some(tolerance) => {
            format!("set the mesh tolerance to {} mm or more, or allow more memory", tolerance.min(step))
        }
        // The surface grows with the inverse square of the step.
        None => {
            let step = rounded_up(step * (bytes as f64 / limit as f64).sqrt());
            format!("set the step to {step} mm or more, or allow more memory")
        }
    };
    Finding::error(Code::JOB_BUDGET, "the surface of the part needs more memory than it may take")
        .value((bytes as f64 / 1e6).ceil(), "MB")
        .bound((limit as f64 / 1e6).floor(), "MB")
        .help(help)
}

/// The next number with two digits.
fn rounded_up(value: f64) -> f64 {
    let digit = 10f64.powf(value.log10().floor() - 1.0);
    let digits = (value / digit - 1e-9).ceil();
    // Divided by a power of ten it is the number as it is written.
    if digit < 1.0 { digits / (1.0 / digit).round() } else { digits * digit }
}
