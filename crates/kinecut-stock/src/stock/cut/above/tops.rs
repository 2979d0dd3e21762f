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
use super::movers::{Mover, Movers};
use super::narrow::Narrow;
use crate::base::Progress;
use crate::geom::CurveKind;
use crate::stock::Lattice;
use crate::stock::sieve::Sieve;
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::Grid;

/// Own lines along an edge of a patch.
const EDGE: usize = OWN as usize;

/// Lines of a patch that are its own.
pub(super) const OWN_LINES: usize = (OWN * OWN) as usize;

/// The own lines of a patch, row by row, as far as they are cut: the heights in the tool frame above which nothing is left
/// [fixed steps], and the pieces of moves that went down to them.
///
/// A height is counted from a plane: a slope then takes two bytes a line, a piece mostly one.
#[derive(Clone, Debug)]
pub(in crate::stock) struct Tops {
    plane: Plane,
    /// By line, its height above the plane.
    above: Narrow,
    /// By line, the index of its mover and one; 0 where a line is as it is in the grid.
    by: Narrow,
    /// Numbers of moves, among those that are owed, and of their pieces; [`MANY`] where that is not kept.
    movers: Box<[Mover]>,
}

/// A piece of a move that has more than are counted.
const MANY: u16 = u16::MAX;

/// Heights over rows and columns [fixed steps].
#[derive(Clone, Copy, Debug)]
struct Plane {
    base: i64,
    /// From one column to the next, and from one row to the next.
    slopes: [i64; 2],
}

impl Plane {
    /// Height over the line of a column and a row.
    #[inline(always)]
    fn over(&self, column: usize, row: usize) -> i64 {
        self.base + self.slopes[0] * column as i64 + self.slopes[1] * row as i64
    }

    /// The highest plane with these slopes that no height lies below, and how far above it they reach.
    fn below(heights: &[i32; OWN_LINES], by: &[u32; OWN_LINES], slopes: [i64; 2]) -> (Plane, i64) {
        let plane = Plane { base: 0, slopes };
        let (mut low, mut high) = ([i64::MAX; EDGE], [i64::MIN; EDGE]);
        for (row, (heights, by)) in heights.chunks_exact(EDGE).zip(by.chunks_exact(EDGE)).enumerate() {
            for column in 0..EDGE {
                let above = i64::from(heights[column]) - plane.over(column, row);
                let is_cut = by[column] > 0;
                low[column] = low[column].min(if is_cut { above } else { i64::MAX });
                high[column] = high[column].max(if is_cut { above } else { i64::MIN });
            }
        }
        let low = low.into_iter().fold(i64::MAX, i64::min);
        let high = high.into_iter().fold(i64::MIN, i64::max);
        if low > high { (plane, 0) } else { (Plane { base: low, slopes }, high - low) }
    }
}

impl Tops {
    /// The height above which nothing is left on an own line; `None` where it is as it is in the grid.
    #[inline]
    pub(super) fn top(&self, line: usize) -> Option<i32> {
        self.top_of(line % EDGE, line / EDGE)
    }

    /// The same for the own line of a column and a row.
    #[inline]
    pub(super) fn top_of(&self, column: usize, row: usize) -> Option<i32> {
        let line = row * EDGE + column;
        // It was a whole number of this type.
        let top = || (self.plane.over(column, row) + i64::from(self.above.get(line))) as i32;
        (self.by.get(line) > 0).then(top)
    }

    /// The piece of a move that went down to an own line; `None` as for its height.
    fn mover(&self, line: usize) -> Option<Mover> {
        let by = self.by.get(line).checked_sub(1)?;
        Some(self.movers[by as usize])
    }

    /// Lines by what is known of each: its height, and who went down to it.
    pub(super) fn of(lines: impl Fn(usize) -> Option<(i32, Mover)>) -> Tops {
        let (mut heights, mut by) = ([0; OWN_LINES], [0; OWN_LINES]);
        let mut movers = Movers::new();
        for line in 0..OWN_LINES {
            if let Some((height, mover)) = lines(line) {
                heights[line] = height;
                by[line] = u32::from(movers.index(mover)) + 1;
            }
        }
        let is_cut = |line: usize| by[line] > 0;
        // Slopes from one border to the other, where they are known.
        let last = EDGE - 1;
        let [a, b, c, d] = [0, last, last * EDGE, OWN_LINES - 1];
        let slope = |from: [usize; 2], to: [usize; 2]| {
            let sum = |of: [usize; 2]| of.iter().map(|line| i64::from(heights[*line])).sum::<i64>();
            (sum(to) - sum(from)) / (2 * last as i64)
        };
        let corners = [a, b, c, d].into_iter().all(is_cut);
        let slopes = if corners { [slope([a, c], [b, d]), slope([a, b], [c, d])] } else { [0; 2] };
        let (mut plane, reach) = Plane::below(&heights, &by, slopes);
        if reach > i64::from(u16::MAX) {
            // Above a level plane they reach no farther than four bytes.
            let level = Plane::below(&heights, &by, [0; 2]);
            plane = if level.1 <= reach { level.0 } else { plane };
        }
        let mut above = [0; OWN_LINES];
        for (row, above) in above.chunks_exact_mut(EDGE).enumerate() {
            for (column, above) in above.iter_mut().enumerate() {
                let line = row * EDGE + column;
                let height = i64::from(heights[line]) - plane.over(column, row);
                *above = if by[line] > 0 { height as u32 } else { 0 };
            }
        }
        Tops { plane, above: Narrow::of(&above), by: Narrow::of(&by), movers: movers.into_all() }
    }

    /// Height and mover of an own line, if it has some.
    pub(super) fn line(&self, line: usize) -> Option<(i32, Mover)> {
        self.top(line).zip(self.mover(line))
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
        let by = tops.iter().flat_map(|tops| &tops.movers).map(|(by, _)| *by);
        curved.extend(by.filter(|by| late.is_curved(*by)));
        curved.sort_unstable();
        curved.dedup();
    }
    let curved: BTreeMap<u32, Vec<Task>> =
        curved.into_par_iter().map(|by| (by, late.tasks_of_move(by, frame))).collect();
    let stopped = AtomicBool::new(false);
    let work = grid.tiles.par_iter_mut().enumerate().with_max_len(1).filter(|(t, _)| is_reached(*t));
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
                let Some((by, piece)) = tops.mover(line) else { continue };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_and_movers_come_back() {
        let wide = |line: usize| [i32::MIN, i32::MAX, 0, 17][line % 4];
        let slope = |line: usize| 400_000 - 1900 * (line % 31) as i32 + 1200 * (line / 31) as i32;
        let heights: [&dyn Fn(usize) -> i32; 3] = [&wide, &slope, &|_| -5];
        for (k, height) in heights.into_iter().enumerate() {
            for every in [1, 7] {
                let line = |line: usize| {
                    line.is_multiple_of(every).then(|| (height(line), (line as u32 / 40, (line % 2) as u16)))
                };
                let tops = Tops::of(line);
                for l in 0..OWN_LINES {
                    assert_eq!(tops.line(l), line(l), "{k} {every} {l}");
                }
            }
        }
        assert!(matches!(Tops::of(|l| Some((slope(l), (0, 0)))).above, Narrow::One(_)));
        assert!((0..OWN_LINES).all(|l| Tops::of(|_| None).line(l).is_none()));
    }
}
