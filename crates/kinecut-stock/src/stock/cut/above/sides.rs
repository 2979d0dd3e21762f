//! Cutting the lines across the tool axis: by the tasks that claim them, then what lies above the ceilings.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use super::super::axis::ToolFrame;
use super::super::in_order::{strip_lines, strips};
use super::super::strip::Strip;
use super::super::task::Task;
use super::claims::Claim;
use super::field::OWN;
use super::gathered::Gathered;
use super::late::Open;
use super::layers::Layers;
use super::patch::{Known, SIDE};
use crate::base::Progress;
use crate::stock::sieve::Sieve;
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::{Grid, LINE_OFFSET};
use crate::stock::{Axis, EndPoint, Lattice, fixed};

/// Ends of what lies above ceilings keep clear of what the tasks leave by this [fixed steps].
const CLEAR: i32 = 3;

/// Cuts the claims of tasks in a grid across the tool axis.
pub(super) fn cut_claims(
    grid: &mut Grid,
    (lattice, frame): (&Lattice, &ToolFrame),
    (tasks, claims): (&[Task], &Gathered),
    progress: &dyn Progress,
) {
    let (axis, edge) = (grid.axis, TILE_EDGE as usize);
    let k = direction(axis, frame);
    let (rows, heights) = strip_lines(grid, lattice, frame);
    let reached = claims.rows(k);
    let some = reached.start / edge..reached.end.min(rows.len()).div_ceil(edge);
    let work = strips(grid, frame, (&rows, &heights), some.clone()).into_par_iter().zip(some).with_max_len(1);
    work.for_each(|(mut strip, s)| {
        if !progress.cancelled() {
            cut_in_strip(&mut strip, axis, tasks, &claims.on_rows(k, &(s * edge..(s + 1) * edge)));
        }
    });
}

/// Takes what lies above the ceilings out of whole lines of a grid, through a rectangle of patches; `before` are the ceilings of the last
/// time.
pub(super) fn clear(
    grid: &mut Grid,
    (sieve, frame): (&Sieve, &ToolFrame),
    (now, before): (&[Known], &[Known]),
    open: &Open,
    progress: &dyn Progress,
) {
    let axis = grid.axis;
    let k = direction(axis, frame);
    let (lattice, lines) = (sieve.whole(), sieve.lattice());
    let layers = Layers::new(&lines, frame);
    let mut ends: Vec<i32> = (-1..=i64::from(lattice.counts[axis.index()]))
        .map(|i| fixed(lattice.origin[axis.index()] + i as f64 * lattice.step + LINE_OFFSET))
        .collect();
    // Nothing is left out there.
    if let [first, .., last] = &mut ends[..] {
        (*first, *last) = (*first - CLEAR, *last + CLEAR);
    }
    let bands = &open.rectangle[1 - k];
    let ceilings = Ceilings::new((now, before), open, k);
    let (rows, heights) = strip_lines(grid, &lines, frame);
    let (own, edge) = (OWN as usize, TILE_EDGE as usize);
    let side = row_axis(k, frame);
    let band_of = |row: usize| sieve.whole_index(side, row as u32) as usize / own;
    let inside = (0..rows.len()).filter(|row| bands.contains(&band_of(*row)));
    let (first, last) = (inside.clone().min().unwrap_or(0), inside.max().unwrap_or(0));
    let some = first / edge..(last + 1).div_ceil(edge);
    let work = strips(grid, frame, (&rows, &heights), some.clone()).into_par_iter().zip(some).with_max_len(1);
    work.for_each(|(mut strip, s)| {
        let mut clear = Clear { layers: &layers, ends: &ends, starts: vec![0; layers.count()], open: 0..0 };
        let mut ways = Vec::new();
        for row in 0..strip.rows.len() {
            let index = s * edge + row;
            if bands.contains(&band_of(index)) && !progress.cancelled() {
                let whole = sieve.whole_index(side, index as u32) as usize;
                ceilings.of_row(whole, &layers, &mut ways);
                clear.cut(&mut strip, row, &ways);
            }
        }
    });
}

/// Direction of lines across the tool axis: along the first direction across it, or the second.
pub(super) fn direction(axis: Axis, frame: &ToolFrame) -> usize {
    usize::from(axis != frame.axes[2].others().0)
}

/// The axis along which the rows of lines are numbered that run along a direction across the tool axis.
pub(super) fn row_axis(k: usize, frame: &ToolFrame) -> Axis {
    let (first, second) = frame.axes[2].others();
    if k == 0 { second } else { first }
}

/// Cuts the tasks in the rows and layers that they claim.
fn cut_in_strip(strip: &mut Strip, axis: Axis, tasks: &[Task], claims: &[Claim]) {
    for of_task in claims.chunk_by(|a, b| a.task == b.task) {
        let view = Strip::view(axis, &tasks[of_task[0].task as usize]);
        for of_row in of_task.chunk_by(|a, b| a.row == b.row) {
            let row = (of_row[0].row % TILE_EDGE) as usize;
            let mut from = 0;
            for claim in of_row {
                let layers = (claim.layers.0.max(from) as usize, claim.layers.1 as usize);
                from = from.max(claim.layers.1);
                if layers.0 < layers.1 {
                    strip.cut(&view, row..row + 1, layers);
                }
            }
        }
    }
}

/// The ceilings of a grid's ways.
struct Ceilings<'a> {
    now: &'a [Known],
    before: &'a [Known],
    open: &'a Open,
    k: usize,
    /// By band and place along the lines: a bit for each row in which a ceiling of the patch is new.
    new: Vec<u32>,
}

/// A way between two lines of a row.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// Its index in the row; it leads to the line of this index from the one before it.
    index: usize,
    /// The lowest layer that is clear, counted upwards, and the lowest that was before.
    clear: usize,
    before: usize,
}

impl<'a> Ceilings<'a> {
    fn new((now, before): (&'a [Known], &'a [Known]), open: &'a Open, k: usize) -> Ceilings<'a> {
        let mut made = Ceilings { now, before, open, k, new: Vec::new() };
        let [bands, along] = [&open.rectangle[1 - k], &open.rectangle[k]];
        let all = bands.clone().flat_map(|band| along.clone().map(move |q| (band, q)));
        made.new = all.map(|(band, q)| made.new_rows(made.patch(band, q))).collect();
        made
    }

    /// Index of a patch of a band.
    fn patch(&self, band: usize, q: usize) -> usize {
        self.open.patch(if self.k == 0 { [q, band] } else { [band, q] })
    }

    /// A bit for each row in which a ceiling of a patch is new.
    fn new_rows(&self, patch: usize) -> u32 {
        let (now, before) = match (&self.now[patch], &self.before[patch]) {
            (Some(now), Some(before)) if Arc::ptr_eq(now, before) => return 0,
            (None, _) => return 0,
            (Some(_), None) => return u32::MAX,
            (Some(now), Some(before)) => (&now[self.k], &before[self.k]),
        };
        let is_new = |row: usize| {
            let at = |i: usize| if self.k == 0 { row * SIDE + i } else { i * SIDE + row };
            (1..SIDE).any(|i| now[at(i)] != before[at(i)])
        };
        (1..SIDE).filter(|row| is_new(*row)).fold(0, |rows, row| rows | 1 << row)
    }

    /// The ways of a row in patches where it has new ceilings, and in their neighbours.
    fn of_row(&self, row: usize, layers: &Layers, ways: &mut Vec<Way>) {
        let own = OWN as usize;
        let (band, within) = (row / own, row % own + 1);
        ways.clear();
        let [bands, along] = [&self.open.rectangle[1 - self.k], &self.open.rectangle[self.k]];
        let new = &self.new[(band - bands.start) * along.len()..][..along.len()];
        for (n, q) in along.clone().enumerate() {
            let around = &new[n.saturating_sub(1)..new.len().min(n + 2)];
            if around.iter().all(|rows| rows >> within & 1 == 0) {
                continue;
            }
            let patch = self.patch(band, q);
            let Some(now) = self.now[patch].as_deref() else { continue };
            let before = self.before[patch].as_deref();
            for i in 1..SIDE {
                let l = if self.k == 0 { within * SIDE + i } else { i * SIDE + within };
                let ceiling = now[self.k][l];
                // Behind the last line there is none.
                if ceiling > f32::NEG_INFINITY {
                    let clear = layers.above(f64::from(ceiling));
                    let before = match before.map(|b| b[self.k][l]) {
                        Some(before) if before == ceiling => clear,
                        before => before.map_or(layers.count(), |b| layers.above(f64::from(b))),
                    };
                    ways.push(Way { index: q * own + i - 1, clear, before });
                }
            }
        }
    }
}

/// Takes out of lines what lies above the ceilings of their ways.
struct Clear<'a> {
    layers: &'a Layers,
    /// Ends of the ways, in their order.
    ends: &'a [i32],
    /// By layer, counted upwards: the way at which the stretch that is cut begins.
    starts: Vec<usize>,
    /// Layers that are in a stretch.
    open: Range<usize>,
}

impl Clear<'_> {
    /// Cuts the lines of a row; layers that were clear before are left alone, but for the neighbours of what is new.
    fn cut(&mut self, strip: &mut Strip, row: usize, ways: &[Way]) {
        let mut next = 0;
        for (i, way) in ways.iter().enumerate() {
            let around = &ways[i.saturating_sub(1)..ways.len().min(i + 2)];
            let new = around.iter().filter(|w| w.clear < w.before && w.index.abs_diff(way.index) <= 1);
            let to = new.map(|w| w.before).max().unwrap_or(0);
            if way.index > next {
                self.step(strip, row, 0..0, next);
            }
            let open = if way.clear < to { way.clear..to } else { 0..0 };
            if open != self.open {
                self.step(strip, row, open, way.index);
            }
            next = way.index + 1;
        }
        self.step(strip, row, 0..0, next);
    }

    /// Goes on with other layers at the beginning of a way: stretches in layers that are no longer open are cut.
    fn step(&mut self, strip: &mut Strip, row: usize, open: Range<usize>, way: usize) {
        let before = std::mem::replace(&mut self.open, open.clone());
        for layer in outside(&before, &open) {
            let (lo, hi) = (self.ends[self.starts[layer]] + CLEAR, self.ends[way] - CLEAR);
            strip.take_out(row, self.layers.in_stock(layer), lo, hi);
        }
        for layer in outside(&open, &before) {
            self.starts[layer] = way;
        }
    }
}

/// The layers of one range that are not in another one.
fn outside(one: &Range<usize>, other: &Range<usize>) -> impl Iterator<Item = usize> + use<> {
    let apart = other.is_empty() || one.end <= other.start || other.end <= one.start;
    let (low, high) =
        if apart { (one.clone(), 0..0) } else { (one.start..other.start, other.end.max(one.start)..one.end) };
    low.chain(high)
}

impl Strip<'_> {
    /// Takes a stretch that is known to be void out of a line.
    fn take_out(&mut self, row: usize, layer: usize, lo: i32, hi: i32) {
        let (tile, line) = self.place(row, layer);
        let end = |at: i32| EndPoint { at, ..EndPoint::default() };
        if lo < hi {
            self.tiles[tile].subtract(line, end(lo), end(hi));
        }
    }
}
