//! Lines along the tool axis that are cut late: how far down, and by which move, is kept; the ends of the lines follow when somebody
//! reads them.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use glam::DVec2;
use rayon::prelude::*;

use super::super::axis::ToolFrame;
use super::super::task::{Task, TileLines};
use super::super::tile_axial::cut_above;
use super::super::upright::tasks_of;
use super::field::OWN;
use super::late::Late;
use super::patch::NONE;
use crate::base::Progress;
use crate::geom::CurveKind;
use crate::stock::Lattice;
use crate::stock::sieve::Sieve;
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::Grid;

/// Lines of a patch that are its own.
pub(super) const OWN_LINES: usize = (OWN * OWN) as usize;

/// The own lines of a patch, row by row.
#[derive(Clone, Debug)]
pub(in crate::stock) struct Tops {
    /// Heights in the tool frame above which nothing is left [fixed steps].
    pub(super) at: [i32; OWN_LINES],
    /// Numbers of the moves that went down to them, among those that are owed; [`NONE`] where the line is as it is in the grid.
    pub(super) by: [u32; OWN_LINES],
    /// The pieces of these moves; [`MANY`] where that is not kept.
    pub(super) piece: [u16; OWN_LINES],
}

/// A piece of a move that has more than are counted.
const MANY: u16 = u16::MAX;

impl Tops {
    /// All lines are as they are in the grid.
    pub(super) const UNCUT: Tops =
        Tops { at: [i32::MAX; OWN_LINES], by: [NONE; OWN_LINES], piece: [MANY; OWN_LINES] };

    /// The height above which nothing is left on an own line; `None` where it is as it is in the grid.
    pub(super) fn top(&self, line: usize) -> Option<i32> {
        (self.by[line] != NONE).then_some(self.at[line])
    }

    /// Adds lines that tasks have cut since to those that are kept; `of` is the number of a task's move, and its piece.
    pub(super) fn add_to(mut self: Box<Tops>, kept: &mut Option<Box<Tops>>, of: impl Fn(u32) -> (u32, u16)) {
        for line in 0..OWN_LINES {
            if self.by[line] == NONE {
                continue;
            }
            (self.by[line], self.piece[line]) = of(self.by[line]);
            if let Some(kept) = kept {
                kept.at[line] = self.at[line];
                (kept.by[line], kept.piece[line]) = (self.by[line], self.piece[line]);
            }
        }
        kept.get_or_insert(self);
    }
}

/// By task, the number of the piece that it is of its move.
pub(super) fn pieces(tasks: &[Task]) -> Vec<u16> {
    let of_moves = tasks.chunk_by(|a, b| a.index == b.index);
    of_moves.flat_map(|some| (0..some.len()).map(|i| u16::try_from(i).unwrap_or(MANY))).collect()
}

/// The heights of the lines of a field, by patch.
#[derive(Clone, Copy)]
pub(in crate::stock) struct Kept<'a> {
    pub(super) tops: &'a [Option<Box<Tops>>],
    /// Number of patches along the first direction.
    pub(super) across: usize,
}

impl Kept<'_> {
    /// The height above which nothing is left on a line, in the tool frame [fixed steps]; `None` where it is as it is in the grid.
    pub(in crate::stock) fn top(&self, a: usize, b: usize) -> Option<i32> {
        let own = OWN as usize;
        let tops = self.tops[b / own * self.across + a / own].as_ref()?;
        tops.top(b % own * own + a % own)
    }
}

/// Cuts the lines of the patches of a rectangle that are behind, and forgets their heights.
pub(super) fn settle(
    grid: &mut Grid,
    (lattice, frame): (&Lattice, &ToolFrame),
    (tops, across): (&mut [Option<Box<Tops>>], usize),
    rectangle: &[Range<usize>; 2],
    late: &Late,
    progress: &dyn Progress,
) {
    let [columns, rows] = rectangle;
    let inside = |p: usize| columns.contains(&(p % across)) && rows.contains(&(p / across));
    let kept = Kept { tops, across };
    if cut_behind(grid, (&Sieve::all(lattice), frame), kept, &inside, late, progress) {
        for (_, tops) in tops.iter_mut().enumerate().filter(|(p, _)| inside(*p)) {
            *tops = None;
        }
    }
}

/// Cuts lines of a sieve in patches that are behind, and are inside; true if it was not cancelled.
pub(super) fn cut_behind(
    grid: &mut Grid,
    (sieve, frame): (&Sieve, &ToolFrame),
    Kept { tops, across }: Kept<'_>,
    inside: &(dyn Fn(usize) -> bool + Sync),
    late: &Late,
    progress: &dyn Progress,
) -> bool {
    let (own, edge) = (OWN as usize, TILE_EDGE as usize);
    let (empty, lattice) = (grid.without_lines(), sieve.lattice());
    let (first_axis, second_axis) = grid.axis.others();
    let axes = [first_axis, second_axis];
    // A tile has lines of several patches along both directions.
    let is_reached = |t: usize| {
        let (first, size) = empty.tile_lines(t);
        let [columns, rows] = [0, 1].map(|k| {
            let patch = |i: u32| sieve.whole_index(axes[k], first[k] + i) as usize / own;
            patch(0)..patch(size[k] - 1) + 1
        });
        let mut patches = rows.flat_map(|row| columns.clone().map(move |column| row * across + column));
        patches.any(|p| tops[p].is_some() && inside(p))
    };
    // Moves of many pieces are taken apart once, the others where they are met.
    let mut curved: Vec<u32> = Vec::new();
    for (_, tops) in tops.iter().enumerate().filter(|(p, _)| inside(*p)) {
        let by = tops.iter().flat_map(|tops| tops.by).filter(|by| *by != NONE);
        curved.extend(by.filter(|by| late.is_curved(*by)));
        curved.sort_unstable();
        curved.dedup();
    }
    let curved: BTreeMap<u32, Vec<Task>> =
        curved.into_par_iter().map(|by| (by, late.tasks_of_move(by, frame))).collect();
    let stopped = AtomicBool::new(false);
    let work = grid.tiles.par_iter_mut().enumerate().filter(|(t, _)| is_reached(*t));
    work.for_each(|(t, tile)| {
        if progress.cancelled() {
            stopped.store(true, Relaxed);
            return;
        }
        let places = TileLines::new(&empty, &lattice, t);
        let (first, size) = empty.tile_lines(t);
        let mut moves: BTreeMap<u32, Vec<Task>> = BTreeMap::new();
        for j in 0..size[1] as usize {
            let b = sieve.whole_index(second_axis, first[1] + j as u32) as usize;
            for i in 0..size[0] as usize {
                let a = sieve.whole_index(first_axis, first[0] + i as u32) as usize;
                let p = b / own * across + a / own;
                let Some(tops) = tops[p].as_ref().filter(|_| inside(p)) else { continue };
                let line = b % own * own + a % own;
                let (by, piece) = (tops.by[line], tops.piece[line]);
                if by == NONE {
                    continue;
                }
                let tasks = match curved.get(&by) {
                    Some(tasks) => tasks,
                    None => moves.entry(by).or_insert_with(|| late.tasks_of_move(by, frame)),
                };
                let tasks = match usize::from(piece) {
                    piece if piece < tasks.len() => &tasks[piece..=piece],
                    _ => &tasks[..],
                };
                let (p, q) = (places.at[0][i], places.at[1][j]);
                let over = if frame.sign < 0.0 { DVec2::new(q, p) } else { DVec2::new(p, q) };
                cut_above(tile, j * edge + i, over, tasks);
            }
        }
    });
    !stopped.load(Relaxed)
}

impl Late {
    /// True for the number of a move that does not go along a straight line.
    fn is_curved(&self, number: u32) -> bool {
        let owed = self.owed(number as usize);
        owed.is_some_and(|(list, at)| !matches!(list.moves[at].curve.kind(), CurveKind::Line(_)))
    }

    /// The tasks of a move by its number.
    fn tasks_of_move(&self, number: u32, frame: &ToolFrame) -> Vec<Task<'_>> {
        let mut tasks = Vec::new();
        if let Some((list, at)) = self.owed(number as usize) {
            tasks_of(list, at, frame, number, &mut tasks);
        }
        tasks
    }
}
