//! Volumes with how far they may be off.
//!
//! The volume of the raw stock is that of its solid. The volume of the cut part, and of a stock that has holes already, is taken from
//! its mesh or from its lines along Z, whichever has the lesser bound.
//!
//! **Bound of a mesh.** The vertices of the mesh lie within its tolerance of the surface, and so do those at its edges; a
//! facet over a surface of curvature 1 / R leaves it by s^2 / (12 R) in the mean over a step s, a fiftieth of a step ([`BENT`]) at
//! R = 4 s. Both together, times the area that is not flat raw stock, are the most that the volume is off.
//! Measured with a tolerance of a fiftieth of a step on holes, slots, ball rasters and bars down to R = 1.25 s it is off by half of
//! that at most, and mostly by a tenth. What is thinner than the lines may not be in the mesh at all.
//!
//! **Bound of lines.** Each line counts for the square about it. Between two lines the length of material may be anything between
//! theirs where there is a wall, and goes on as before them or behind them where there is none. A quarter of the second
//! difference of the lengths, in both directions, bounds both: of a wall of height h, half a step times h; of a kink in a slope
//! the triangle under it; of a curve three times what it is.

use rayon::prelude::*;

use crate::geom::{Mesh, Solid};
use crate::stock::surface::{CutSurface, SurfaceOptions};
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, DexelGrid, FIXED_STEP, Lattice, TriDexel};

/// Distance of facets from a bent surface, in the mean [grid steps].
const BENT: f64 = 0.02;

/// A volume.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::base::Silent;
/// use kinecut::geom::{Aabb, Solid};
/// use kinecut::stock::surface::{SurfaceOptions, surface_with_cuts};
/// use kinecut::stock::{TriDexel, Volume};
/// let bounds = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
/// let stock = TriDexel::from_box(bounds, 0.7).unwrap();
/// let options = SurfaceOptions::default();
/// let surface = surface_with_cuts(&stock, &options, &Silent).unwrap();
/// let removed = Volume::of_solid(&Solid::Box(bounds)).less(Volume::of_surface(&surface, &options, 0.7, true));
/// assert!(removed.value.abs() <= removed.bound + 1e-6);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Volume {
    /// The volume [mm^3].
    pub value: f64,
    /// The true volume is no farther from `value` than this [mm^3].
    pub bound: f64,
}

impl Volume {
    /// The volume of a solid, exact up to rounding.
    pub fn of_solid(solid: &Solid) -> Volume {
        let value = match solid {
            Solid::Box(bounds) => bounds.size().element_product(),
            Solid::Cylinder { radius, height, .. } => std::f64::consts::PI * radius * radius * height,
            Solid::Mesh(mesh) => mesh.volume(),
        };
        Volume { value, bound: 1e-12 * value.abs() }
    }

    /// The volume within a surface made with a tolerance from lines at a distance of `step` [mm]; `exact` when what no move has
    /// cut is a box, whose faces the mesh has exactly.
    pub fn of_surface(surface: &CutSurface, options: &SurfaceOptions, step: f64, exact: bool) -> Volume {
        let cuts = surface.mesh.triangles.iter().zip(&surface.cuts);
        let area: f64 =
            cuts.filter(|(_, cut)| !exact || **cut > 0).map(|(t, _)| area(&surface.mesh, *t)).sum();
        let value = surface.mesh.volume();
        Volume { value, bound: (options.tolerance(step) + BENT * step) * area + 1e-12 * value.abs() }
    }

    /// The volume of a stock by its lines along Z.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::base::Silent;
    /// use kinecut::geom::{Aabb, Line, Profile};
    /// use kinecut::stock::cut::{CutAxis, CutMove, CutOptions, ToolBody, cut};
    /// use kinecut::stock::{TriDexel, Volume};
    /// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
    /// let mut stock = TriDexel::from_box(plate, 0.7).unwrap();
    /// assert!((Volume::of_lines(&stock).value - 8000.0).abs() < 1e-9);
    /// let tool = [ToolBody::new(Profile::cylinder(8.0, 20.0).unwrap())];
    /// let slot = Line { start: [-10.0, 10.0, -3.0].into(), end: [50.0, 10.0, -3.0].into() };
    /// cut(&mut stock, &tool, &[CutMove::new(slot, CutAxis::PlusZ, 0)], &CutOptions::default(), &Silent).unwrap();
    /// let left = Volume::of_lines(&stock);
    /// // Two walls of 3 x 40 mm, each known to half a step.
    /// assert!((left.value - 8000.0 + 960.0).abs() < left.bound && left.bound < 1.01 * 0.7 * 120.0);
    /// ```
    pub fn of_lines(stock: &TriDexel) -> Volume {
        let (grid, lattice) = (stock.grid(Axis::Z), stock.lattice());
        let bounds = stock.bounds();
        let across = [0, 1].map(|k| Across::new(lattice, k, [bounds.min[k], bounds.max[k]]));
        let rows = (0..grid.tiles_across()[1]).into_par_iter();
        let parts: Vec<[f64; 2]> = rows.map(|row| of_tiles(grid, row, &across)).collect();
        let sum = |k: usize| parts.iter().map(|part| part[k]).sum::<f64>() * FIXED_STEP;
        // Ends are rounded.
        let area = bounds.size().x * bounds.size().y;
        Volume { value: sum(0), bound: 0.25 * lattice.step * lattice.step * sum(1) + FIXED_STEP * area }
    }

    /// The volume taken away to leave `rest`.
    pub fn less(self, rest: Volume) -> Volume {
        Volume { value: self.value - rest.value, bound: self.bound + rest.bound }
    }

    /// Number of digits after the point at which the bound, in this unit of cubic millimetres, is shown: `least` or more.
    pub fn digits(self, unit: f64, least: usize) -> usize {
        /// Beyond it a volume has more digits than any scale.
        const MOST: f64 = 6.0;
        let digits = -(self.bound / unit).log10().floor();
        // Not a number or infinite where the bound is zero.
        if digits.is_finite() { (digits.clamp(0.0, MOST) as usize).max(least) } else { least }
    }
}

/// The lines of a lattice in one direction.
struct Across {
    count: usize,
    step: f64,
    /// Widths that the first and the last line count for [mm]: up to the faces of the box.
    first: f64,
    last: f64,
}

impl Across {
    fn new(lattice: &Lattice, k: usize, [min, max]: [f64; 2]) -> Across {
        let (count, step, origin) = (lattice.counts[k] as usize, lattice.step, lattice.origin[k]);
        if count == 1 {
            return Across { count, step, first: max - min, last: max - min };
        }
        let end = origin + (count - 1) as f64 * step;
        Across { count, step, first: origin - min + 0.5 * step, last: max - end + 0.5 * step }
    }

    /// The width that a line counts for [mm].
    fn width(&self, index: usize) -> f64 {
        match index {
            0 => self.first,
            i if i + 1 == self.count => self.last,
            _ => self.step,
        }
    }
}

/// Of the lines of a row of tiles: the sum of lengths times areas [fixed steps mm^2], and the sum of second differences of the lengths
/// [fixed steps].
fn of_tiles(grid: &Grid, row: u32, across: &[Across; 2]) -> [f64; 2] {
    let [columns, rows] = [across[0].count, across[1].count];
    let first = (row * TILE_EDGE) as usize;
    let length = |i: usize, j: usize| -> i64 {
        grid.line(i as u32, j as u32).iter().map(|part| i64::from(part.hi.at) - i64::from(part.lo.at)).sum()
    };
    // A row beyond the stock is like the one at its border.
    let lengths = |j: usize| -> Vec<i64> { (0..columns).map(|i| length(i, j)).collect() };
    let mut before = lengths(first.saturating_sub(1));
    let mut here = lengths(first);
    let (mut volume, mut bends) = (0.0, 0);
    for j in first..rows.min(first + TILE_EDGE as usize) {
        let behind = lengths((j + 1).min(rows - 1));
        let mut sum = 0.0;
        for i in 0..columns {
            let own = here[i];
            sum += own as f64 * across[0].width(i);
            let bend = |a: i64, b: i64| (a - 2 * own + b).abs();
            bends += bend(here[i.saturating_sub(1)], here[(i + 1).min(columns - 1)]);
            bends += bend(before[i], behind[i]);
        }
        volume += sum * across[1].width(j);
        (before, here) = (here, behind);
    }
    [volume, bends as f64]
}

/// Area of a triangle [mm^2].
fn area(mesh: &Mesh, triangle: [u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize]);
    0.5 * (b - a).cross(c - a).length()
}
