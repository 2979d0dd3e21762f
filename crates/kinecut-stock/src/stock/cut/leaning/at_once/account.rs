//! Amounts that the moves of a run remove, in order, on some of the lines.
//!
//! Every nth line of those along the tool axis is taken, n up to 16 so that they are no more than a quarter of the radius of the
//! run's thinnest tool apart, or all where the lines of the stock are no closer. Of a span, poses are taken that are a quarter of the
//! radius apart or less. Such an amount is measured, not bounded.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::super::super::body::RevolvedParts;
use super::super::super::effect::{Effect, Effects};
use super::super::super::task::TileLines;
use super::super::chord::LineFrom;
use super::super::swept::{MOST_STRETCHES, StockLine};
use super::super::task::SpanTask;
use crate::base::Progress;
use crate::geom::Aabb;
use crate::stock::tile::{TILE_EDGE, Tile};
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, CutId, DexelGrid, TriDexel, fixed, unfixed};

/// Lines, and poses, to a radius of the tool.
const LINES: f64 = 4.0;

/// Cosine of the angle to lines below which they are not those to measure a tool on: 53 degrees.
const FLAT: f64 = 0.6;

/// Most poses of a span.
const MOST_POSES: usize = 17;

/// A line on which is measured.
struct Sample {
    /// Its point at the coordinate 0.
    start: DVec3,
    /// Its material [fixed steps].
    material: Vec<(i32, i32)>,
    /// The last move that cut it, and the material that it met there so far [fixed steps].
    met: (CutId, i64),
}

/// Tells what moves remove, on the lines along the axis that most of their tools are nearest to; a tool that leans from it by more
/// than [`FLAT`] is looked at along the one it is nearest to itself.
pub(super) fn account(
    stock: &TriDexel,
    tasks: &[SpanTask],
    progress: &dyn Progress,
    mut each: impl FnMut(&Effect),
) {
    let lattice = *stock.lattice();
    let axes = tasks.iter().map(|t| t.poses.poses[1].axis.abs());
    let usual = Axis::nearest(axes.clone().sum()).index();
    let main: Vec<usize> =
        axes.map(|axis| if axis[usual] > FLAT { usual } else { Axis::nearest(axis).index() }).collect();
    let radius = tasks.iter().map(|t| t.tool.cutting.radius).fold(f64::INFINITY, f64::min);
    let apart = apart(radius / (LINES * lattice.step));
    for grid in &stock.grids {
        let along = grid.axis.index();
        if !main.contains(&along) {
            continue;
        }
        let lines: Vec<TileLines> =
            (0..grid.tiles.len()).map(|t| TileLines::new(grid, &lattice, t)).collect();
        let shadows: Vec<Shadow> = tasks.iter().map(|t| Shadow::new(t, along, stock.bounds())).collect();
        let bins = bins(grid, &lines, &shadows);
        let work = grid.tiles.par_iter().zip(&bins).zip(&lines).filter(|((_, bin), _)| !bin.is_empty());
        let done: Vec<Vec<Effect>> = work
            .map(|((tile, bin), lines)| {
                let mut effects = Effects::default();
                let mut samples = samples(tile, lines, along, apart);
                let shares = [lines.size.iter().product(), samples.len()].map(|n| n as i64);
                for i in bin {
                    let task = &tasks[*i as usize];
                    if samples.is_empty() || progress.cancelled() {
                        break;
                    }
                    let is_main = main[*i as usize] == along;
                    let shadow = &shadows[*i as usize];
                    for sample in samples.iter_mut().filter(|s| shadow.is_near(plan(s.start, along), 0.0)) {
                        pass(sample, task, along, is_main.then_some(&mut effects));
                    }
                }
                // Each stands for as many lines.
                let scaled = |e: &Effect| Effect { removed: e.removed * shares[0] / shares[1].max(1), ..*e };
                effects.iter().map(scaled).collect::<Vec<Effect>>()
            })
            .collect();
        done.iter().flatten().for_each(&mut each);
    }
}

/// All that the edges of a span may sweep of the stock, seen along its lines: what is near a straight way.
struct Shadow {
    from: DVec2,
    to: DVec2,
    reach: f64,
}

impl Shadow {
    fn new(task: &SpanTask, along: usize, stock: Aabb) -> Shadow {
        let (pose, body) = (&task.poses.poses[1], &task.tool.cutting);
        let stray = task.poses.span.stray(body.top.max(-body.bottom).hypot(body.radius));
        let reach = body.radius + stray;
        // Places of the tool's axis, which go no farther than needed out of the stock.
        let (rise, tip) = (pose.axis[along], pose.tip[along]);
        let [a, b] = [stock.min[along] - reach, stock.max[along] + reach].map(|s| (s - tip) / rise);
        let (low, high) = if rise.abs() > 1e-9 { (a.min(b), a.max(b)) } else { (f64::MIN, f64::MAX) };
        let ends = [body.bottom, body.top].map(|z| plan(pose.tip + pose.axis * z.min(high).max(low), along));
        Shadow { from: ends[0], to: ends[1], reach }
    }

    /// True if a place is no farther away than `by` [mm].
    fn is_near(&self, place: DVec2, by: f64) -> bool {
        let (way, off) = (self.to - self.from, place - self.from);
        let length = way.length_squared();
        let t = if length > 0.0 { (off.dot(way) / length).clamp(0.0, 1.0) } else { 0.0 };
        let far = self.reach + by;
        (off - way * t).length_squared() <= far * far
    }
}

/// A point seen along lines: the coordinates along the two other axes in cyclic order, see [`Axis::others`].
fn plan(point: DVec3, along: usize) -> DVec2 {
    DVec2::new(point[(along + 1) % 3], point[(along + 2) % 3])
}

/// For each tile of lines the shadows that may reach it, in order.
fn bins(grid: &Grid, lines: &[TileLines], shadows: &[Shadow]) -> Vec<Vec<u32>> {
    let ends = |tile: &TileLines| [0, 1].map(|k| [tile.at[k][0], tile.at[k][tile.size[k] - 1]]);
    let [columns, rows] = grid.tiles_across().map(|n| n as usize);
    let column_ends: Vec<[f64; 2]> = (0..columns).map(|i| ends(&lines[i])[0]).collect();
    let row_ends: Vec<[f64; 2]> = (0..rows).map(|j| ends(&lines[j * columns])[1]).collect();
    // The tiles that overlap a stretch.
    let range = |of: &[[f64; 2]], min: f64, max: f64| {
        let first = of.partition_point(|e| e[1] < min);
        first..first.max(of.partition_point(|e| e[0] <= max))
    };
    let mut bins = vec![Vec::new(); lines.len()];
    for (i, shadow) in shadows.iter().enumerate() {
        let min = shadow.from.min(shadow.to) - shadow.reach;
        let max = shadow.from.max(shadow.to) + shadow.reach;
        for row in range(&row_ends, min.y, max.y) {
            for column in range(&column_ends, min.x, max.x) {
                let [[a, b], [c, d]] = [column_ends[column], row_ends[row]];
                let (middle, half) =
                    (DVec2::new(0.5 * (a + b), 0.5 * (c + d)), DVec2::new(b - a, d - c) * 0.5);
                if shadow.is_near(middle, half.length()) {
                    bins[row * columns + column].push(i as u32);
                }
            }
        }
    }
    bins
}

/// Lines from one that is looked at to the next: a power of two up to the edge of a tile.
fn apart(wanted: f64) -> u32 {
    let mut apart = 1;
    while apart < TILE_EDGE && f64::from(2 * apart) <= wanted {
        apart *= 2;
    }
    apart
}

/// The lines of a tile on which is measured.
fn samples(tile: &Tile, lines: &TileLines, along: usize, apart: u32) -> Vec<Sample> {
    let mut samples = Vec::new();
    let apart = apart as usize;
    // In the middle of their squares; at least one of a narrow tile.
    let places = |n: usize| ((apart / 2).min(n - 1)..n).step_by(apart);
    for b in places(lines.size[1]) {
        for a in places(lines.size[0]) {
            let line = tile.line(b * TILE_EDGE as usize + a);
            let mut start = DVec3::ZERO;
            // The two other axes in cyclic order, see `Axis::others`.
            start[(along + 1) % 3] = lines.at[0][a];
            start[(along + 2) % 3] = lines.at[1][b];
            let material = line.iter().map(|i| (i.lo.at, i.hi.at)).collect();
            samples.push(Sample { start, material, met: (0, 0) });
        }
    }
    samples
}

/// Takes a span past a line; tells what it does there if that is asked for.
fn pass(sample: &mut Sample, task: &SpanTask, along: usize, effects: Option<&mut Effects>) {
    let (Some(first), Some(last)) = (sample.material.first(), sample.material.last()) else { return };
    let (low, high) = (fixed(task.bounds.min[along]), fixed(task.bounds.max[along]));
    if high <= first.0 || last.1 <= low {
        return;
    }
    let hull = [unfixed(first.0), unfixed(last.1)];
    let seen = StockLine { start: sample.start, along, material: hull, stretches: [hull; MOST_STRETCHES] };
    if task.tool.cutting.parts.iter().all(|part| task.poses.surely_misses(part, task.bend, &seen)) {
        return;
    }
    let covered = covered(&task.tool.cutting, task, sample.start, along);
    if covered.iter().all(|c| length(&sample.material, *c) == 0) {
        return;
    }
    if let Some(effects) = effects {
        let contact = self::covered(&task.tool.contact, task, sample.start, along);
        let met: i64 = contact.iter().map(|c| length(&sample.material, *c)).sum();
        let effect = effects.of(task.index);
        effect.removed += covered.iter().map(|c| length(&sample.material, *c)).sum::<i64>();
        if met > 0 {
            if sample.met.0 != task.cut {
                sample.met = (task.cut, 0);
            }
            sample.met.1 += met;
            effect.deepest = effect.deepest.max(sample.met.1);
            let t = task.poses.span.fraction(0.0);
            if effect.first.is_none_or(|(old, _)| t < old) {
                let top = contact.iter().map(|c| c.1.min(sample.material[sample.material.len() - 1].1)).max();
                let mut point = sample.start;
                point[along] = unfixed(top.unwrap_or(0));
                effect.first = Some((t, point.to_array()));
            }
        }
    }
    for (lo, hi) in covered {
        subtract(&mut sample.material, lo, hi);
    }
}

/// The stretches of a line that a body covers in a span, without those between; sorted, and apart from each other [fixed steps].
fn covered(body: &RevolvedParts, task: &SpanTask, start: DVec3, along: usize) -> Vec<(i32, i32)> {
    let wanted = 2.0 * LINES * task.poses.span.stray(body.radius) / body.radius + 1.0;
    let count = (wanted.ceil() as usize).clamp(3, MOST_POSES);
    let mut list = Vec::new();
    for part in &body.parts {
        for i in 0..count {
            let pose = match count {
                3 => task.poses.poses[i],
                _ => task.poses.span.at(i as f64 / (count - 1) as f64 - 0.5),
            };
            if let Some(chord) = LineFrom::new(start, along, &pose).chord(part) {
                list.push((fixed(chord.lo), fixed(chord.hi)));
            }
        }
    }
    list.sort_unstable();
    let mut merged: Vec<(i32, i32)> = Vec::with_capacity(list.len());
    for (lo, hi) in list {
        match merged.last_mut() {
            Some(last) if lo <= last.1 => last.1 = last.1.max(hi),
            _ => merged.push((lo, hi)),
        }
    }
    merged
}

/// Length of material between two coordinates.
fn length(material: &[(i32, i32)], (lo, hi): (i32, i32)) -> i64 {
    material.iter().map(|(from, to)| (i64::from(*to.min(&hi)) - i64::from(*from.max(&lo))).max(0)).sum()
}

/// Takes a stretch out of material.
fn subtract(material: &mut Vec<(i32, i32)>, lo: i32, hi: i32) {
    let mut i = 0;
    while i < material.len() {
        let (from, to) = material[i];
        if to <= lo || hi <= from {
            i += 1;
            continue;
        }
        material.remove(i);
        if from < lo {
            material.insert(i, (from, lo));
            i += 1;
        }
        if hi < to {
            material.insert(i, (hi, to));
            i += 1;
        }
    }
}
