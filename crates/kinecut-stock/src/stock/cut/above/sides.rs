//! Cutting the lines across the tool axis: by the tasks that claim them, then what lies above the ceilings.

use rayon::prelude::*;

use super::super::axis::ToolFrame;
use super::super::in_order::{strip_lines, strips};
use super::super::strip::Strip;
use super::super::task::Task;
use super::Outcome;
use super::claims::Claim;
use super::field::OWN;
use super::layers::Layers;
use super::patch::{PatchCeilings, SIDE};
use crate::base::Progress;
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::{Grid, LINE_OFFSET};
use crate::stock::{Axis, EndPoint, Lattice, fixed};

/// Ends of what lies above ceilings keep clear of what the tasks leave by this [fixed steps].
const CLEAR: i32 = 3;

/// Cuts a grid across the tool axis.
pub(super) fn cut_sides(
    grid: &mut Grid,
    (lattice, frame): (&Lattice, &ToolFrame),
    tasks: &[Task],
    outcomes: &mut [Option<Outcome>],
    patches: [usize; 2],
    progress: &dyn Progress,
) {
    let axis = grid.axis;
    // Lines along the first direction across the tool axis, or the second.
    let k = usize::from(axis != frame.axes[2].others().0);
    let (rows, heights) = strip_lines(grid, lattice, frame);
    let mut claims: Vec<Vec<Claim>> = vec![Vec::new(); rows.len().div_ceil(TILE_EDGE as usize)];
    for outcome in outcomes.iter_mut().flatten() {
        for claim in std::mem::take(&mut outcome.claims[k]) {
            claims[(claim.row / TILE_EDGE) as usize].push(claim);
        }
    }
    let layers = Layers::new(lattice, frame);
    let mut ends: Vec<i32> = (-1..=i64::from(lattice.counts[axis.index()]))
        .map(|i| fixed(lattice.origin[axis.index()] + i as f64 * lattice.step + LINE_OFFSET))
        .collect();
    // Nothing is left out there.
    if let [first, .., last] = &mut ends[..] {
        (*first, *last) = (*first - CLEAR, *last + CLEAR);
    }
    let ceilings = Ceilings { outcomes, patches, k };
    let work = strips(grid, frame, &rows, &heights).into_par_iter().zip(claims);
    work.enumerate().for_each(|(s, (mut strip, mut claims))| {
        if progress.cancelled() {
            return;
        }
        claims.sort_unstable();
        cut_claims(&mut strip, axis, tasks, &claims);
        for row in 0..strip.rows.len() {
            let index = s * TILE_EDGE as usize + row;
            clear(&mut strip, row, &layers, &ends, ceilings.of_row(index));
        }
    });
}

/// Cuts the tasks in the rows and layers that they claim.
fn cut_claims(strip: &mut Strip, axis: Axis, tasks: &[Task], claims: &[Claim]) {
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
    outcomes: &'a [Option<Outcome>],
    patches: [usize; 2],
    k: usize,
}

impl<'a> Ceilings<'a> {
    /// The patches that a row runs through, each with the ceilings of its ways; none of those that no task reached.
    fn of_row(&self, row: usize) -> impl Iterator<Item = (usize, impl Iterator<Item = f32> + use<'a>)> {
        let own = OWN as usize;
        let (p, within) = (row / own, row % own + 1);
        let (k, outcomes, across) = (self.k, self.outcomes, self.patches);
        (0..across[k]).filter_map(move |q| {
            let patch = if k == 0 { p * across[0] + q } else { q * across[0] + p };
            let ceilings: &'a PatchCeilings = &outcomes[patch].as_ref()?.ceilings;
            let ways = (1..SIDE).map(move |i| {
                let l = if k == 0 { within * SIDE + i } else { i * SIDE + within };
                ceilings[k][l]
            });
            Some((q * own, ways))
        })
    }
}

/// Takes out of the lines of a row what lies above the ceilings of its ways.
fn clear(
    strip: &mut Strip,
    row: usize,
    layers: &Layers,
    ends: &[i32],
    patches: impl Iterator<Item = (usize, impl Iterator<Item = f32>)>,
) {
    // First end of the stretch that is clear in each layer, counted upwards; layers from `clear` on are in one.
    let mut starts = vec![0; layers.count()];
    let (mut clear, mut next) = (layers.count(), 0);
    let until = |strip: &mut Strip, starts: &mut [usize], clear: &mut usize, to: usize, way: usize| {
        for (layer, start) in starts.iter_mut().enumerate().take(to).skip(*clear) {
            let (lo, hi) = (ends[*start] + CLEAR, ends[way] - CLEAR);
            strip.take_out(row, layers.in_stock(layer), lo, hi);
        }
        if to < *clear {
            starts[to..*clear].fill(way);
        }
        *clear = to;
    };
    for (first, ways) in patches {
        if first > next {
            until(strip, &mut starts, &mut clear, layers.count(), next);
        }
        next = first;
        for ceiling in ways {
            // Ways of no line lie behind the last one.
            let above =
                if ceiling == f32::NEG_INFINITY { layers.count() } else { layers.above(f64::from(ceiling)) };
            if above != clear {
                until(strip, &mut starts, &mut clear, above, next.min(ends.len() - 1));
            }
            next += 1;
        }
    }
    until(strip, &mut starts, &mut clear, layers.count(), next.min(ends.len() - 1));
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
