//! The tri-dexel stock: three grids of lines over one lattice.
//!
//! **Places of the lines.** End points are rounded to [`FIXED_STEP`], so the question whether a lattice point lies in
//! `[lo, hi)` is in truth asked half a step above the point along the line. Every line is therefore offset by half a
//! fixed step (5 nm) from its lattice point towards plus, in both directions across it: then the three lines through a
//! lattice point ask about one and the same point of space and agree on whether it is material, also where a face of
//! the tool or of the stock runs exactly through the lattice.
//!
//! **Late lines.** Lines that moves of an upright tool take all above their underside from are cut when something asks for them
//! (`cut/above/late.rs`, `cut/above/tops.rs`), and so are those across the axis that the tools of a long leaning run are near to
//! (`cut/leaning/at_once/owed.rs`). Whoever reads lines does not see a difference.

use std::sync::OnceLock;
use std::thread::{self, ScopedJoinHandle};

use glam::DVec3;
use rayon::prelude::*;

use super::cut::{FromAbove, OwedAcross};
use super::sieve::Sieve;
use super::skimmed::Skimmed;
use super::tile::{TILE_EDGE, Tile};
use super::{Axis, DexelGrid, EndPoint, FIXED_STEP, Interval, Lattice, unfixed};
use crate::base::{Code, Finding, Progress, Result, Silent};
use crate::geom::Aabb;

/// Offset of lines from their lattice points [mm]; see the head of the file.
pub(crate) const LINE_OFFSET: f64 = 0.5 * FIXED_STEP;

/// Coordinates beyond this do not fit the fixed-point ends [mm].
const REACH: f64 = 20_000.0;

/// Most lattice points along an axis: beyond it the lattice is a slip of the step, not a stock.
const MOST_POINTS: f64 = 1_000_000.0;

/// All lines along one axis, in tiles.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    /// Direction of the lines.
    pub(crate) axis: Axis,
    /// Number of lines along `axis.others()`.
    pub(crate) counts: [u32; 2],
    /// Tiles, rows of `tiles_across()[0]`.
    pub(crate) tiles: Vec<Tile>,
}

impl Grid {
    fn new(axis: Axis, lattice: &Lattice, alike: Option<Interval>) -> Grid {
        let (a, b) = axis.others();
        let counts = [lattice.counts[a.index()], lattice.counts[b.index()]];
        let tiles = counts[0].div_ceil(TILE_EDGE) as usize * counts[1].div_ceil(TILE_EDGE) as usize;
        Grid { axis, counts, tiles: vec![Tile::of(alike); tiles] }
    }

    /// A grid of the same shape, of no use but for it.
    pub(crate) fn without_lines(&self) -> Grid {
        Grid { axis: self.axis, counts: self.counts, tiles: Vec::new() }
    }

    /// Number of tiles along the two directions across the lines.
    pub(crate) fn tiles_across(&self) -> [u32; 2] {
        self.counts.map(|n| n.div_ceil(TILE_EDGE))
    }

    /// First line indices of a tile and its number of lines along both directions.
    pub(crate) fn tile_lines(&self, tile: usize) -> ([u32; 2], [u32; 2]) {
        let across = self.tiles_across()[0];
        let (i, j) = (tile as u32 % across, tile as u32 / across);
        let first = [i * TILE_EDGE, j * TILE_EDGE];
        (first, [0, 1].map(|k| (self.counts[k] - first[k]).min(TILE_EDGE)))
    }

    /// The intervals of a line.
    pub(crate) fn line(&self, a: u32, b: u32) -> &[Interval] {
        let (tile, line) = place(self.tiles_across()[0], a, b);
        self.tiles[tile].line(line)
    }

    /// Takes the lines over that a sieve leaves of a grid.
    fn copy_some(&mut self, from: &Grid, sieve: &Sieve) {
        let (a, b) = self.axis.others();
        let shape = self.without_lines();
        self.tiles.par_iter_mut().enumerate().for_each(|(t, tile)| {
            let (first, size) = shape.tile_lines(t);
            for j in 0..size[1] {
                for i in 0..size[0] {
                    let at = |axis: Axis, index: u32| sieve.whole_index(axis, index);
                    let line = from.line(at(a, first[0] + i), at(b, first[1] + j));
                    tile.set((j * TILE_EDGE + i) as usize, line);
                }
            }
        });
    }

    /// Length of all lines [fixed steps].
    fn content(&self) -> i128 {
        let one = |(t, tile): (usize, &Tile)| {
            let (_, [width, height]) = self.tile_lines(t);
            i128::from(tile.content(width, height))
        };
        self.tiles.par_iter().enumerate().map(one).sum()
    }

    /// Length of all lines along the tool axis of moves that have still to cut some [fixed steps].
    fn content_within(&self, above: &FromAbove) -> i128 {
        let row = |b: u32| -> i128 {
            let line = |a: u32| self.within(a, b, above.limits(a, b));
            (0..self.counts[0]).map(|a| i128::from(line(a))).sum()
        };
        (0..self.counts[1]).into_par_iter().map(row).sum()
    }

    /// Length of the material of a line between two coordinates [fixed steps].
    pub(super) fn within(&self, a: u32, b: u32, [low, high]: [i32; 2]) -> i64 {
        let part = |i: &Interval| i64::from(i.hi.at.min(high)) - i64::from(i.lo.at.max(low));
        self.line(a, b).iter().map(|i| part(i).max(0)).sum()
    }
}

/// A tri-dexel body: the stock, before, while and after it is cut.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::{geom::Aabb, stock::TriDexel};
/// let bounds = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
/// let stock = TriDexel::from_box(bounds, 0.5).unwrap();
/// assert!((stock.volume() - 8000.0).abs() < 1e-9);
/// ```
#[derive(Clone, Debug)]
pub struct TriDexel {
    lattice: Lattice,
    bounds: Aabb,
    pub(super) grids: [Grid; 3],
    /// Knowledge from cutting from above, and the moves that have still to cut the lines across their axis; it holds as long as
    /// material is only taken out.
    pub(super) above: Option<FromAbove>,
    /// Moves of leaning tools that have still to cut the lines across the axis that they are near to. Where there are some, no upright
    /// ones owe lines.
    pub(super) owed: Option<OwedAcross>,
    /// The grids across that axis with all moves cut, made where somebody reads them before they are; and the one along it.
    whole: OnceLock<Box<[Grid; 3]>>,
    whole_along: OnceLock<Box<Grid>>,
    /// Faces beside the lines along Z.
    pub(super) skimmed: Skimmed,
}

impl TriDexel {
    /// A stock without material over the lattice of a box: lines half a step inside its faces.
    ///
    /// # Errors
    /// `KC0801` when the box is empty, not finite or farther out than 20 m, or the step is not positive;
    /// `KC0105` when an axis would get more than a million points.
    pub fn empty(bounds: Aabb, step: f64) -> Result<TriDexel> {
        TriDexel::filled(bounds, step, [None; 3])
    }

    /// Over the lattice of a box, each line of an axis with the same interval.
    pub(crate) fn filled(bounds: Aabb, step: f64, alike: [Option<Interval>; 3]) -> Result<TriDexel> {
        let lattice = lattice_of(bounds, step)?;
        let grids = Axis::ALL.map(|axis| Grid::new(axis, &lattice, alike[axis.index()]));
        let skimmed = Skimmed::UNKNOWN;
        let (whole, whole_along) = (OnceLock::new(), OnceLock::new());
        Ok(TriDexel { lattice, bounds, grids, above: None, owed: None, whole, whole_along, skimmed })
    }

    /// Memory that a stock in a box needs at a grid step [bytes], at most two intervals a line. It grows with the
    /// inverse square of the step. For numbers that make no stock the answer is `u64::MAX`.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::{geom::Aabb, stock::TriDexel};
    /// let plate = Aabb { min: [-130.0, -130.0, -30.0].into(), max: [130.0, 130.0, 0.0].into() };
    /// assert!(TriDexel::memory(plate, 0.2) < 125_000_000);
    /// ```
    pub fn memory(bounds: Aabb, step: f64) -> u64 {
        let Ok(lattice) = lattice_of(bounds, step) else { return u64::MAX };
        let tiles = lattice.counts.map(|n| u64::from(n.div_ceil(TILE_EDGE)));
        (tiles[0] * tiles[1] + tiles[1] * tiles[2] + tiles[2] * tiles[0]) * Tile::BYTES as u64
    }

    /// Memory that the lines hold now [bytes], as [`TriDexel::memory`] counts it.
    pub fn memory_held(&self) -> u64 {
        self.grids.iter().flat_map(|grid| &grid.tiles).map(|tile| tile.bytes() as u64).sum()
    }

    /// Number of the lines of a stock in a box at a grid step; `u64::MAX` for numbers that make no stock.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::{geom::Aabb, stock::TriDexel};
    /// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [100.0, 50.0, 0.0].into() };
    /// assert_eq!(TriDexel::lines(plate, 1.0), 100 * 50 + 50 * 10 + 10 * 100);
    /// ```
    pub fn lines(bounds: Aabb, step: f64) -> u64 {
        let Ok(lattice) = lattice_of(bounds, step) else { return u64::MAX };
        let [x, y, z] = lattice.counts.map(u64::from);
        x * y + y * z + z * x
    }

    /// Memory that a surface of a stock in a box needs at a grid step, however little of it there is [bytes]: it grows with the
    /// inverse cube of the step. Its vertices and triangles come on top ([`SurfaceOptions::memory`]). For numbers that make no stock
    /// the answer is `u64::MAX`.
    ///
    /// [`SurfaceOptions::memory`]: super::surface::SurfaceOptions::memory
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::{geom::Aabb, stock::TriDexel};
    /// let plate = Aabb { min: [0.0, 0.0, -40.0].into(), max: [100.0, 100.0, 0.0].into() };
    /// // A bit for each of 3.2 thousand million points, and what is known of each block of them.
    /// let bytes = TriDexel::surface_memory(plate, 0.05);
    /// assert!(400_000_000 < bytes && bytes < 500_000_000);
    /// ```
    pub fn surface_memory(bounds: Aabb, step: f64) -> u64 {
        let Ok(lattice) = lattice_of(bounds, step) else { return u64::MAX };
        super::surface::memory(lattice.counts)
    }

    /// The box over which the lattice was laid.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Volume [mm^3] from the lines along Z.
    pub fn volume(&self) -> f64 {
        self.volume_along(Axis::Z)
    }

    /// Volumes [mm^3] from the lines along X, Y and Z: three independent measures of one body.
    pub fn volumes(&self) -> [f64; 3] {
        Axis::ALL.map(|axis| self.volume_along(axis))
    }

    fn volume_along(&self, axis: Axis) -> f64 {
        let (grid, above) = self.grid_within(axis);
        let content = above.map_or_else(|| grid.content(), |above| grid.content_within(above));
        content as f64 * FIXED_STEP * self.lattice.step * self.lattice.step
    }

    /// The lines along an axis, with all moves cut.
    pub(super) fn grid(&self, axis: Axis) -> &Grid {
        if let Some(owed) = &self.owed {
            return match owed.is_across(axis) {
                true => &self.whole.get_or_init(|| self.settled_apart())[axis.index()],
                false => &self.grids[axis.index()],
            };
        }
        match &self.above {
            Some(above) if !above.owes(axis) => &self.grids[axis.index()],
            Some(above) if above.is_across(axis) => {
                &self.whole.get_or_init(|| self.settled_apart())[axis.index()]
            }
            Some(_) => self.whole_along.get_or_init(|| self.settled_along_apart(axis)),
            _ => &self.grids[axis.index()],
        }
    }

    /// The lines along an axis, and who knows of more that they have lost: without cutting them for it where they run along the tool
    /// axis.
    pub(super) fn grid_within(&self, axis: Axis) -> (&Grid, Option<&FromAbove>) {
        match &self.above {
            Some(above)
                if self.owed.is_none() && !above.is_across(axis) && self.whole_along.get().is_none() =>
            {
                (&self.grids[axis.index()], Some(above))
            }
            _ => (self.grid(axis), None),
        }
    }

    /// Some of its lines, those of a coarser lattice: every so manieth along each axis, with all moves cut. The lines that are left out
    /// are cut no further for that. Lines across the axis of leaning tools that are behind are cut only between points of the coarser lattice
    /// at which the lines along it are unlike; elsewhere they have material as those do.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::base::Silent;
    /// use kinecut::geom::Aabb;
    /// use kinecut::stock::{Axis, DexelGrid, TriDexel};
    /// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
    /// let stock = TriDexel::from_box(plate, 0.5).unwrap();
    /// let some = stock.sieved(4, &Silent);
    /// assert_eq!(some.lattice().counts, [20, 10, 5]);
    /// // Its first line along Z is the third one of the stock along X and Y.
    /// assert_eq!(some.lattice().origin, stock.lattice().point(2, 2, 2));
    /// assert_eq!(some.line(Axis::Z, 0, 0), stock.line(Axis::Z, 2, 2));
    /// ```
    pub fn sieved(&self, every: u32, progress: &dyn Progress) -> TriDexel {
        let sieve = Sieve::new(&self.lattice, every);
        let lattice = sieve.lattice();
        let above = self.above.as_ref();
        // Which grids are behind, and have not been cut apart.
        let across = self.owed.as_ref().filter(|_| self.whole.get().is_none());
        let owed = Axis::ALL.map(|axis| {
            let cut_apart = |above: &FromAbove| match above.is_across(axis) {
                true => self.whole.get().is_some(),
                false => self.whole_along.get().is_some(),
            };
            above.is_some_and(|above| above.owes(axis) && !cut_apart(above))
        });
        let mut grids = Axis::ALL.map(|axis| {
            let is_behind = owed[axis.index()] || across.is_some();
            let from = if is_behind { &self.grids[axis.index()] } else { self.grid(axis) };
            let mut grid = Grid::new(axis, &lattice, None);
            grid.copy_some(from, &sieve);
            grid
        });
        if let Some(above) = above.filter(|_| self.owed.is_none()) {
            let tool = above.along();
            let (along, across) = (owed[tool.index()], owed[tool.others().0.index()]);
            let stock = (&sieve, &self.grids[tool.index()].without_lines(), self.bounds);
            above.cut_sieved(&mut grids, stock, along, across, progress);
        }
        let (whole, whole_along) = (OnceLock::new(), OnceLock::new());
        let (bounds, skimmed) = (self.bounds, Skimmed::UNKNOWN);
        let owed = across.map(|owed| owed.anew(&mut grids, &lattice, bounds));
        let mut some = TriDexel { lattice, bounds, grids, above: None, owed, whole, whole_along, skimmed };
        some.settle(progress);
        some
    }

    /// The grid along the tool axis, cut by the moves that have still to do so.
    fn settled_along_apart(&self, axis: Axis) -> Box<Grid> {
        apart(|| {
            let mut grid = self.grids[axis.index()].clone();
            if let Some(above) = &self.above {
                above.clone().settle_along(&mut grid, &self.lattice, &Silent);
            }
            Box::new(grid)
        })
    }

    /// The grids across the tool axis, cut by the moves that have still to do so.
    fn settled_apart(&self) -> Box<[Grid; 3]> {
        apart(|| {
            if let Some(owed) = &self.owed {
                let mut grids = self.grids.each_ref().map(|grid| match owed.is_across(grid.axis) {
                    true => grid.clone(),
                    false => grid.without_lines(),
                });
                owed.clone().pay_all(&mut grids, (&self.lattice, self.bounds), &Silent);
                return Box::new(grids);
            }
            let mut grids = self.grids.each_ref().map(|grid| match &self.above {
                Some(above) if above.is_across(grid.axis) && above.owes(grid.axis) => grid.clone(),
                _ => grid.without_lines(),
            });
            if let Some(above) = &self.above {
                above.clone().settle_across(&mut grids, (&self.lattice, self.bounds), &Silent);
            }
            Box::new(grids)
        })
    }

    /// All grids, to be changed: moves that have not cut all lines do so first.
    pub(super) fn settled(&mut self, progress: &dyn Progress) -> &mut [Grid; 3] {
        self.settle(progress);
        &mut self.grids
    }

    /// Before more is cut: lines that were cut apart, as somebody has read them, become the stock's own.
    pub(super) fn take_back(&mut self) {
        self.take_back_along();
        if self.whole.get().is_some() {
            self.settle(&Silent);
        }
    }

    /// The same for the lines along the tool axis alone.
    fn take_back_along(&mut self) {
        if let (Some(grid), Some(above)) = (self.whole_along.take(), &mut self.above) {
            let axis = grid.axis;
            self.grids[axis.index()] = *grid;
            above.owe_nothing_along();
        }
    }

    /// Lets moves cut the lines that they have left for later: those across the axis of upright tools, or the one that leaning tools are
    /// near to. Whoever reads these lines without
    /// this waits for it then. When it is cancelled they are left for later still.
    pub fn settle(&mut self, progress: &dyn Progress) {
        self.settle_leaning(progress);
        self.settle_upright(progress);
    }

    /// The same for lines that moves of leaning tools have left.
    fn settle_leaning(&mut self, progress: &dyn Progress) {
        let Some(mut owed) = self.owed.take() else { return };
        match self.whole.take() {
            Some(whole) => {
                for (own, grid) in self.grids.iter_mut().zip(*whole) {
                    if owed.is_across(grid.axis) {
                        *own = grid;
                    }
                }
            }
            None => {
                owed.pay_all(&mut self.grids, (&self.lattice, self.bounds), progress);
                self.owed = progress.cancelled().then_some(owed);
            }
        }
    }

    /// The same for lines that moves of upright tools have left.
    pub(super) fn settle_upright(&mut self, progress: &dyn Progress) {
        if self.owed.is_some() {
            // They have left none.
            return;
        }
        self.take_back_along();
        let Some(above) = &mut self.above else { return };
        match self.whole.take() {
            Some(whole) => {
                for (own, grid) in self.grids.iter_mut().zip(*whole) {
                    if above.is_across(grid.axis) && above.owes(grid.axis) {
                        *own = grid;
                    }
                }
                above.settle_along(&mut self.grids[above.along().index()], &self.lattice, progress);
                if !progress.cancelled() {
                    above.owe_nothing();
                }
            }
            None => above.settle(&mut self.grids, (&self.lattice, self.bounds), progress),
        }
    }

    /// The same for the lines along the tool axis alone: before somebody reads some of them. It costs what moves have cut since.
    pub fn settle_along(&mut self, progress: &dyn Progress) {
        self.take_back_along();
        if let Some(above) = &mut self.above
            && above.owes(above.along())
        {
            above.settle_along(&mut self.grids[above.along().index()], &self.lattice, progress);
        }
    }

    /// Takes the material between two ends out of a line.
    pub(crate) fn take_from_line(&mut self, axis: Axis, [a, b]: [u32; 2], lo: EndPoint, hi: EndPoint) {
        let grid = &mut self.settled(&Silent)[axis.index()];
        let (tile, line) = place(grid.tiles_across()[0], a, b);
        grid.tiles[tile].subtract(line, lo, hi);
    }

    /// The intervals of one line replaced.
    pub(crate) fn set_line(&mut self, axis: Axis, a: u32, b: u32, intervals: &[Interval]) {
        self.settle(&Silent);
        self.above = None;
        self.skimmed = Skimmed::UNKNOWN;
        let grid = &mut self.grids[axis.index()];
        let (tile, line) = place(grid.tiles_across()[0], a, b);
        grid.tiles[tile].set(line, intervals);
    }
}

impl DexelGrid for TriDexel {
    fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    fn line(&self, axis: Axis, a: u32, b: u32) -> &[Interval] {
        self.grid(axis).line(a, b)
    }

    /// As for any grid; lines along the tool axis need not be cut for it.
    fn has_material(&self, axis: Axis, [a, b]: [u32; 2], [low, high]: [f64; 2]) -> bool {
        let (grid, above) = self.grid_within(axis);
        let [from, to] = above.map_or([i32::MIN, i32::MAX], |above| above.limits(a, b)).map(unfixed);
        let (low, high) = (low.max(from), high.min(to));
        grid.line(a, b).iter().any(|i| unfixed(i.lo.at).max(low) < unfixed(i.hi.at).min(high))
    }
}

/// Does work by threads of its own: those that wait for the result cannot be asked to help with it.
fn apart<T: Send>(work: impl Fn() -> T + Sync) -> T {
    let threads = rayon::current_num_threads();
    // Where there are no threads nobody waits.
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else { return work() };
    thread::scope(|scope| {
        let made = thread::Builder::new().spawn_scoped(scope, || pool.install(&work));
        match made.map(ScopedJoinHandle::join) {
            Ok(Ok(made)) => made,
            Ok(Err(panic)) => std::panic::resume_unwind(panic),
            Err(_) => work(),
        }
    })
}

/// Tile and line within it of the lattice indices of a line.
fn place(tiles_across: u32, a: u32, b: u32) -> (usize, usize) {
    let tile = (b / TILE_EDGE) as usize * tiles_across as usize + (a / TILE_EDGE) as usize;
    (tile, ((b % TILE_EDGE) * TILE_EDGE + a % TILE_EDGE) as usize)
}

/// The lattice of a box.
fn lattice_of(bounds: Aabb, step: f64) -> Result<Lattice> {
    let ok = |v: DVec3| v.is_finite() && v.abs().max_element() <= REACH;
    if !(ok(bounds.min) && ok(bounds.max)) {
        return Err(Finding::error(Code::GEOMETRY, "the box of the stock is not finite or too far out")
            .value_mm(bounds.min.abs().max_element().max(bounds.max.abs().max_element()))
            .bound_mm(REACH)
            .help("move the part near to the origin")
            .into());
    }
    let size = bounds.size();
    if size.min_element() < 4.0 * FIXED_STEP {
        return Err(Finding::error(Code::GEOMETRY, "the box of the stock has no size")
            .value_mm(size.min_element())
            .bound_mm(4.0 * FIXED_STEP)
            .into());
    }
    if !(step.is_finite() && step > 4.0 * FIXED_STEP) {
        return Err(Finding::error(Code::GEOMETRY, "the grid step must be positive")
            .value_mm(step)
            .bound_mm(4.0 * FIXED_STEP)
            .into());
    }
    let points = (size / step).max_element();
    if points > MOST_POINTS {
        return Err(Finding::error(Code::JOB_BUDGET, "the grid step is too small for the stock")
            .value_mm(step)
            .bound_mm(size.max_element() / MOST_POINTS)
            .into());
    }
    // A box thinner than a step gets one point in its middle.
    let half = size.min(DVec3::splat(step)) * 0.5;
    let count = |i: usize| ((size[i] / step).round() as u32).max(1);
    let mut counts = [count(0), count(1), count(2)];
    for (i, n) in counts.iter_mut().enumerate() {
        // A remainder of half a step or more gets a point of its own.
        while half[i] + f64::from(*n) * step < size[i] {
            *n += 1;
        }
        while *n > 1 && half[i] + f64::from(*n - 1) * step >= size[i] {
            *n -= 1;
        }
    }
    Ok(Lattice { origin: bounds.min + half, step, counts })
}
