//! Spans to tiles of lines, and what each move does there.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::super::body::{RevolvedParts, Touch};
use super::super::effect::{Effects, Looked, Sum, deeper, met};
use super::super::face::{Station, SweptFace};
use super::super::task::TileLines;
use super::edge;
use super::swept::{CoverEnd, MOST_STRETCHES, NO_STRETCH, StockLine};
use super::task::{Batch, SpanTask};
use crate::base::Progress;
use crate::geom::Aabb;
use crate::stock::tile::{TILE_EDGE, TILE_LINES, Tile};
use crate::stock::tri_dexel::Grid;
use crate::stock::{CutId, DexelGrid, EndPoint, PackedNormal, TriDexel, fixed, unfixed};

/// Cuts a range of moves of a batch in order, and adds up what each does.
pub(super) fn cut_in_order(
    stock: &mut TriDexel,
    batch: &Batch,
    moves: Range<usize>,
    sums: &mut [Sum],
    progress: &dyn Progress,
) {
    let lattice = *stock.lattice();
    let (tasks, main) = (batch.tasks_of(moves), &batch.main);
    for grid in &mut stock.grids {
        let lines: Vec<TileLines> =
            (0..grid.tiles.len()).map(|t| TileLines::new(grid, &lattice, t)).collect();
        let bins = bins(grid, &lines, tasks);
        let along = grid.axis.index();
        let work = grid.tiles.par_iter_mut().zip(&bins).zip(&lines);
        let done: Vec<Effects> = work
            .map(|((tile, bin), lines)| {
                let mut effects = Effects::default();
                let mut work = TileWork { tile, lines, along, hull: None, met: Vec::new() };
                for task in bin.iter().map(|i| &tasks[*i as usize]) {
                    if progress.cancelled() {
                        break;
                    }
                    work.pass(task, main[task.index as usize] == along, &mut effects);
                }
                effects
            })
            .collect();
        for effect in done.iter().flat_map(Effects::iter) {
            let main = main[effect.index as usize];
            // Along the axis of the tool, and the two across it.
            sums[effect.index as usize].add(effect, (3 + along - main) % 3);
        }
    }
}

/// For each tile the spans that may reach it, in order.
pub(super) fn bins(grid: &Grid, lines: &[TileLines], tasks: &[SpanTask]) -> Vec<Vec<u32>> {
    let mut bins = vec![Vec::new(); grid.tiles.len()];
    let across = grid.tiles_across().map(|n| n as usize);
    let (a, b) = grid.axis.others();
    let range = |k: usize, axis: usize, bounds: &Aabb| {
        let tile = |i: usize| &lines[if k == 0 { i } else { i * across[0] }];
        let ends = |i: usize| (tile(i).at[k][0], tile(i).at[k][tile(i).size[k] - 1]);
        let first = (0..across[k]).find(|i| ends(*i).1 >= bounds.min[axis]).unwrap_or(across[k]);
        let last = (first..across[k]).take_while(|i| ends(*i).0 <= bounds.max[axis]).count();
        first..first + last
    };
    for (i, task) in tasks.iter().enumerate() {
        let columns = range(0, a.index(), &task.bounds);
        for row in range(1, b.index(), &task.bounds) {
            for column in columns.clone() {
                bins[row * across[0] + column].push(i as u32);
            }
        }
    }
    bins
}

/// A tile of lines that spans pass.
struct TileWork<'a> {
    tile: &'a mut Tile,
    lines: &'a TileLines,
    along: usize,
    /// Coordinates between which all material lies; `None` when it is to be found anew.
    hull: Option<(i32, i32)>,
    /// For each line the last move that cut it, and the material that it met there so far [fixed steps].
    met: Vec<(CutId, i64)>,
}

impl TileWork<'_> {
    fn pass(&mut self, task: &SpanTask, main: bool, effects: &mut Effects) {
        let [width, height] = self.lines.size;
        let hull = self.hull.or_else(|| self.tile.hull(width as u32, height as u32));
        let Some(hull) = hull else { return };
        self.hull = Some(hull);
        let (low, high) = (task.bounds.min[self.along], task.bounds.max[self.along]);
        if fixed(high) <= hull.0 || hull.1 <= fixed(low) {
            return;
        }
        let (middle, half) = self.middle(hull);
        let far = |body: &RevolvedParts| task.poses.keep_off(body, task.bend, &middle, half);
        let cuts = !far(&task.tool.cutting);
        let looks =
            [Looked::Shank, Looked::Holder].into_iter().any(|looked| !far(task.tool.looked_at(looked)));
        let near =
            |looked: Looked| task.tool.grown.as_ref().is_some_and(|(grown, _)| !far(&grown[looked as usize]));
        let [watched, shank, holder] =
            [task.one.watch && near(Looked::Cutting), near(Looked::Shank), near(Looked::Holder)];
        if !(cuts || looks || watched || shank || holder) {
            return;
        }
        let mut changed = false;
        for b in 0..height {
            for a in 0..width {
                let l = b * TILE_EDGE as usize + a;
                let Some(line) = self.line(l, a, b) else { continue };
                if line.material[1] < low || high < line.material[0] {
                    continue;
                }
                if looks && task.before {
                    self.probe(task, l, &line, effects);
                }
                if watched {
                    edge::note(self.tile, l, task, &line, Looked::Cutting, effects);
                }
                if cuts {
                    changed |= self.cut_line(task, l, &line, main, effects);
                }
                if looks && !task.before {
                    self.probe(task, l, &line, effects);
                }
                // After the cut: shank and holder come near to what the edges have left.
                for (near, looked) in [(shank, Looked::Shank), (holder, Looked::Holder)] {
                    if near {
                        edge::note(self.tile, l, task, &line, looked, effects);
                    }
                }
            }
        }
        if changed {
            self.hull = None;
        }
    }

    /// The line in the middle of the tile, with all heights of its material, and the distance of its farthest line from there [mm].
    fn middle(&self, hull: (i32, i32)) -> (StockLine, f64) {
        let mut start = DVec3::ZERO;
        let ends = [0, 1].map(|k| [self.lines.at[k][0], self.lines.at[k][self.lines.size[k] - 1]]);
        for (k, [from, to]) in ends.into_iter().enumerate() {
            start[(self.along + 1 + k) % 3] = 0.5 * (from + to);
        }
        let half = 0.5 * (ends[0][1] - ends[0][0]).hypot(ends[1][1] - ends[1][0]);
        let material = [unfixed(hull.0), unfixed(hull.1)];
        (StockLine { start, along: self.along, material, stretches: [material; MOST_STRETCHES] }, half)
    }

    /// A line of the tile that has material.
    fn line(&self, l: usize, a: usize, b: usize) -> Option<StockLine> {
        let line = self.tile.line(l);
        let (first, last) = (line.first()?, line.last()?);
        let mut start = DVec3::ZERO;
        // The two other axes in cyclic order, see `Axis::others`.
        start[(self.along + 1) % 3] = self.lines.at[0][a];
        start[(self.along + 2) % 3] = self.lines.at[1][b];
        let mut stretches = [NO_STRETCH; MOST_STRETCHES];
        for (i, part) in line.iter().enumerate() {
            let kept = &mut stretches[i.min(MOST_STRETCHES - 1)];
            *kept = [kept[0].min(unfixed(part.lo.at)), unfixed(part.hi.at)];
        }
        let material = [unfixed(first.lo.at), unfixed(last.hi.at)];
        Some(StockLine { start, along: self.along, material, stretches })
    }

    /// Cuts one line; true when it was changed.
    fn cut_line(
        &mut self,
        task: &SpanTask,
        l: usize,
        line: &StockLine,
        main: bool,
        effects: &mut Effects,
    ) -> bool {
        let mut changed = false;
        let mut each = |work: &mut Self, part: usize, [lo, hi]: [CoverEnd; 2]| {
            let (from, to) = (fixed(lo.s), fixed(hi.s));
            if met(work.tile.line(l), from, to).0 == 0 {
                return;
            }
            if main || task.one.watch {
                contact(work.tile, &mut work.met, l, task, line, effects);
            }
            if task.one.removes {
                let ends = [(from, &lo), (to, &hi)].map(|(at, end)| end_point(task, part, at, end));
                let removed = work.tile.subtract(l, ends[0], ends[1]);
                if main {
                    effects.of(task.index).removed += removed;
                }
                changed |= removed > 0;
            }
        };
        if let Some(plunge) = &task.plunge {
            plunge.covers(line, 0.0, |ends| each(self, 0, ends));
            let core = plunge.core(line, task.clearance);
            let (length, _, last) =
                core.map_or((0, 0, 0), |[lo, hi]| met(self.tile.line(l), fixed(lo), fixed(hi)));
            if length > 0 {
                let mut point = line.start;
                point[line.along] = unfixed(last);
                deeper(&mut effects.of(task.index).core, length, || point.to_array());
            }
        } else {
            for (i, part) in task.tool.cutting.parts.iter().enumerate() {
                task.poses.covers(part, task.bend, line, |ends| each(self, i, ends));
            }
        }
        changed
    }

    /// Notes what shank and holder meet.
    fn probe(&self, task: &SpanTask, l: usize, line: &StockLine, effects: &mut Effects) {
        for looked in [Looked::Shank, Looked::Holder] {
            if let Some((depth, _, point)) = touched(self.tile, l, task, looked, line) {
                let effect = effects.of(task.index);
                let kept = if looked == Looked::Holder { &mut effect.holder } else { &mut effect.shank };
                deeper(kept, depth, || point);
            }
        }
    }
}

/// Notes a contact of the cutting part with a line; what spans of one move take one after the other counts together.
fn contact(
    tile: &Tile,
    so_far: &mut Vec<(CutId, i64)>,
    l: usize,
    task: &SpanTask,
    line: &StockLine,
    effects: &mut Effects,
) {
    let Some((length, t, point)) = touched(tile, l, task, Looked::Cutting, line) else { return };
    so_far.resize(TILE_LINES, (0, 0));
    let (cut, met) = &mut so_far[l];
    if *cut != task.cut {
        (*cut, *met) = (task.cut, 0);
    }
    *met = if task.one.removes { *met + length } else { length.max(*met) };
    let effect = effects.of(task.index);
    effect.deepest = effect.deepest.max(*met);
    if effect.first.is_none_or(|(old, _)| t < old) {
        effect.first = Some((t, point));
    }
}

/// Longest stretch of material that a part of a body meets on a line, with the fraction of the move and a point of it.
fn touched(
    tile: &Tile,
    l: usize,
    task: &SpanTask,
    looked: Looked,
    line: &StockLine,
) -> Option<(i64, f64, [f64; 3])> {
    let mut best: Option<(i64, f64, [f64; 3])> = None;
    let mut each = |[lo, hi]: [CoverEnd; 2]| {
        let (length, first, last) = met(tile.line(l), fixed(lo.s), fixed(hi.s));
        if length > best.map_or(0, |b| b.0) {
            let up = task.poses.poses[1].axis[line.along] > 0.0;
            let mut point = line.start;
            // The point nearest to the holder.
            point[line.along] = unfixed(if up { last } else { first });
            best = Some((length, task.poses.span.fraction(lo.t.min(hi.t)), point.to_array()));
        }
    };
    match (looked, &task.plunge) {
        (Looked::Cutting, Some(plunge)) => plunge.covers(line, task.clearance, each),
        _ => {
            for part in &task.tool.looked_at(looked).parts {
                task.poses.covers(part, task.bend, line, &mut each);
            }
        }
    }
    best
}

/// The end that a part leaves on a line: the normal of the material is against that of the tool.
pub(super) fn end_point(task: &SpanTask, part: usize, at: i32, end: &CoverEnd) -> EndPoint {
    let pose = task.poses.span.at(end.t);
    let left = end.normal.dot(pose.axis.cross(pose.tip_rate)) > 0.0;
    let station = Station::at(task.poses.span.fraction(end.t));
    let face = match end.touch {
        Touch::Disc => SweptFace::Floor,
        Touch::Top => SweptFace::Roof,
        Touch::Foot => SweptFace::side(true, station, left),
        Touch::Edge => SweptFace::Trough,
        Touch::Rim => SweptFace::side(false, station, left),
    };
    EndPoint { at, normal: PackedNormal::new(-end.normal, face.class(part)), cut: task.cut }
}
