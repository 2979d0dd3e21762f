//! Volumes with how far they may be off.
//!
//! The volume of the raw stock is that of its solid. The volume of the cut part, and of a stock that has holes already, is taken from
//! its mesh or from its lines along Z, whichever has the lesser bound.
//!
//! **Bound of a mesh.** The vertices of the mesh lie within its tolerance of the surface, and so do those at its edges; a
//! facet over a surface of curvature 1 / R leaves it by s^2 / (12 R) in the mean over a step s, a fiftieth of a step ([`BENT`]) at
//! R = 4 s. Both together, times the area that is not flat raw stock, are the most that the volume is off.
//! Measured with a tolerance of a fiftieth of a step on holes, slots, ball rasters and bars down to R = 1.25 s it is off by half of
//! that at most, and mostly by a tenth. Ledges in the faces of the stock that end between two lines are added (`skimmed.rs`). What else
//! is thinner than the lines may not be in the mesh at all.
//!
//! **Bound of lines.** Each line counts for the square about it, and beside a face of the stock for all up to that face. The bound is a
//! quarter of the second differences of the lengths of material, in both directions, times the square of the step: half a step for each
//! wall between two lines, the triangle under a kink of a slope, three times the error on a curve. The strip between a face and the line
//! next to it is not known between the lowest and the highest place of the moves that have come there (`skimmed.rs`). Grooves, webs and
//! terraces no wider than the lines are apart go unseen.

use rayon::prelude::*;

use crate::geom::{Mesh, Solid};
use crate::stock::cut::FromAbove;
use crate::stock::skimmed::Strip;
use crate::stock::surface::{CutSurface, SurfaceOptions};
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, DexelGrid, FIXED_STEP, TriDexel, fixed};

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
/// let removed = Volume::of_solid(&Solid::Box(bounds)).less(Volume::of_surface(&surface, &options, &stock, true));
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

    /// The volume within a surface of a stock, made with a tolerance; `exact` when what no move has cut is a box, whose faces the
    /// mesh has exactly.
    pub fn of_surface(
        surface: &CutSurface,
        options: &SurfaceOptions,
        stock: &TriDexel,
        exact: bool,
    ) -> Volume {
        let step = stock.lattice().step;
        let cuts = surface.mesh.triangles.iter().zip(&surface.cuts);
        let area: f64 =
            cuts.filter(|(_, cut)| !exact || **cut > 0).map(|(t, _)| area(&surface.mesh, *t)).sum();
        let value = surface.mesh.volume();
        let ledges = stock.skimmed.ledges(stock.lattice(), stock.bounds());
        let bound = (options.tolerance(step) + BENT * step) * area + ledges + 1e-12 * value.abs();
        Volume { value, bound }
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
    /// // Two walls of 3 x 40 mm, each known to half a step, and a little where they meet the faces.
    /// assert!((left.value - 8000.0 + 960.0).abs() < left.bound && left.bound < 1.05 * 0.7 * 120.0);
    /// ```
    pub fn of_lines(stock: &TriDexel) -> Volume {
        let ((grid, above), lattice) = (stock.grid_within(Axis::Z), stock.lattice());
        let bounds = stock.bounds();
        let across = [0, 1].map(|k| Across::new(stock, k));
        let rows = (0..grid.tiles_across()[1]).into_par_iter();
        let parts: Vec<Part> = rows.map(|row| of_tiles((grid, above), row, &across)).collect();
        let sum = |of: fn(&Part) -> f64| parts.iter().map(of).sum::<f64>() * FIXED_STEP;
        // Ends are rounded.
        let area = bounds.size().x * bounds.size().y;
        let between = 0.25 * lattice.step * lattice.step * sum(|part| part.bends);
        Volume {
            value: sum(|part| part.volume),
            bound: between + sum(|part| part.unknown) + FIXED_STEP * area,
        }
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

/// The lines of a stock in one direction.
struct Across<'a> {
    count: usize,
    step: f64,
    /// Coordinate of the first line [mm].
    first: f64,
    /// Distances of the first line from the least face, and of the last line from the greatest [mm].
    faces: [f64; 2],
    strips: &'a [Strip; 2],
}

impl Across<'_> {
    fn new(stock: &TriDexel, k: usize) -> Across<'_> {
        let (lattice, bounds) = (stock.lattice(), stock.bounds());
        let (count, step, first) = (lattice.counts[k] as usize, lattice.step, lattice.origin[k]);
        let last = first + (count - 1) as f64 * step;
        let faces = [first - bounds.min[k], bounds.max[k] - last];
        Across { count, step, first, faces, strips: stock.skimmed.strips(k) }
    }

    /// The face that a line is next to on one side, with the width up to it [mm].
    fn face(&self, index: usize, side: usize) -> Option<(f64, &Strip)> {
        let is_last = index == if side == 0 { 0 } else { self.count - 1 };
        is_last.then(|| (self.faces[side], &self.strips[side]))
    }

    /// What a line counts for: from where to where [mm].
    fn span(&self, index: usize) -> (f64, f64) {
        let at = self.first + index as f64 * self.step;
        let to = |side: usize| self.face(index, side).map_or(0.5 * self.step, |(width, _)| width);
        (at - to(0), at + to(1))
    }
}

/// Sums over some lines.
#[derive(Clone, Copy, Debug, Default)]
struct Part {
    /// Lengths times areas [fixed steps mm^2].
    volume: f64,
    /// Second differences of the lengths [fixed steps].
    bends: f64,
    /// Lengths that are not known times areas [fixed steps mm^2].
    unknown: f64,
}

/// The sums of the lines of a row of tiles.
fn of_tiles((grid, above): (&Grid, Option<&FromAbove>), row: u32, across: &[Across; 2]) -> Part {
    let [columns, rows] = [across[0].count, across[1].count];
    let first = (row * TILE_EDGE) as usize;
    let within = |i: usize, j: usize, [low, high]: [i32; 2]| -> i64 {
        let (a, b) = (i as u32, j as u32);
        let [from, to] = above.map_or([i32::MIN, i32::MAX], |above| above.limits(a, b));
        grid.within(a, b, [low.max(from), high.min(to)])
    };
    // A row beyond the stock is like the one at its border.
    let mut limits = vec![[i32::MIN, i32::MAX]; columns];
    let mut lengths = |j: usize| -> Vec<i64> {
        if let Some(above) = above {
            above.limits_of_row(j as u32, &mut limits);
        }
        limits.iter().enumerate().map(|(i, limits)| grid.within(i as u32, j as u32, *limits)).collect()
    };
    let mut before = lengths(first.saturating_sub(1));
    let mut here = lengths(first);
    let counts_for = |k: usize, index: usize| {
        let (from, to) = across[k].span(index);
        to - from
    };
    let mut all = Part::default();
    let mut bends = 0;
    for j in first..rows.min(first + TILE_EDGE as usize) {
        let behind = lengths((j + 1).min(rows - 1));
        let mut sum = 0.0;
        for i in 0..columns {
            let own = here[i];
            sum += own as f64 * counts_for(0, i);
            let bend = |a: i64, b: i64| (a - 2 * own + b).abs();
            bends += bend(here[i.saturating_sub(1)], here[(i + 1).min(columns - 1)]);
            bends += bend(before[i], behind[i]);
            let place = [i, j];
            if i > 0 && i + 1 < columns && j > 0 && j + 1 < rows {
                continue;
            }
            for (k, side) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                if let Some((width, strip)) = across[k].face(place[k], side) {
                    let heights = strip.unknown(across[1 - k].span(place[1 - k])).map(fixed);
                    let beside = counts_for(1 - k, place[1 - k]);
                    all.unknown += within(i, j, heights) as f64 * width * beside;
                }
            }
        }
        all.volume += sum * counts_for(1, j);
        (before, here) = (here, behind);
    }
    all.bends = bends as f64;
    all
}

/// Area of a triangle [mm^2].
fn area(mesh: &Mesh, triangle: [u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize]);
    0.5 * (b - a).cross(c - a).length()
}
