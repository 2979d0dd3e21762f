//! Offsets and directions of rows that leave the least burr.
//!
//! Row k owns the strip above what the rows before it reach, c(k-1) + R; its cost there is the closed form of a straight
//! pass. The best sequences of rows over a grid of offsets are shortest paths. The cost is piecewise linear in each
//! offset for straight edges: rows, and all rows together, are then moved between its bends until nothing is gained;
//! bends of arcs are completed by a golden section. Rows by falling ordinate are rows of the part turned by half a turn.

use super::row_cost::RowCost;
use super::{MilledRow, MilledRows, RowWays};
use crate::facing::FaceCase;
use crate::num::minimum::golden;

/// Offsets of the shortest path: even ones, and bends while these are not more.
const GRID: usize = 96;

/// Shortest paths from which rows are moved: on parts with arcs the best one of the grid is not always next to the best rows.
const STARTS: usize = 8;

/// Rounds of moving rows between bends; each gains, most parts need two or three.
const ROUNDS: usize = 8;

/// Most shifts tried at a time, the least first: all of them on parts of some dozens of edges. Fewer on parts of many
/// edges, where each is the work of all edges and bends lie close.
const SHIFTS: usize = 128;

/// Shifts times edges at a time.
const SHIFT_WORK: usize = 24_000;

/// Steps of the golden section: 0.618^30 of the grid's step is a micrometre's thousandth.
const GOLDEN_STEPS: u32 = 30;

/// Gains below this per weighted perimeter are rounding.
const GAIN: f64 = 1e-11;

/// The rows of one orientation and order with the least bad length found: `count` rows by rising ordinate in the frame
/// turned by `angle` [rad], every point of the part within radius less `margin` [mm] of a row's line. None where so
/// many rows do not cover the part.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::passes::{MilledRows, RowWays, best_rows};
/// use kinecut::facing::{BadSet, FaceCase};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(200.0, 0.0), dvec2(200.0, 120.0), dvec2(0.0, 120.0)])?;
/// let case = FaceCase::new(plate, 40.0, BadSet::below(90f64.to_radians())?)?;
/// let two = best_rows(&case, 0.0, 2, 0.8, RowWays::Free).expect("two rows of 80 cover 120");
/// assert!(two.bad_length(&case) <= 44.0);
/// assert!(MilledRows::even(&case, 0.0, 3, RowWays::Zigzag).bad_length(&case) > 250.0);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn best_rows(
    case: &FaceCase,
    angle: f64,
    count: usize,
    margin: f64,
    ways: RowWays,
) -> Option<MilledRows> {
    let starts = RowGrid::new(case, angle, count, margin)?.best(count, ways, STARTS);
    let refined = starts.into_iter().map(|rows| {
        let rows = refined_rows(case, MilledRows { angle, rows }, margin);
        (rows.bad_length(case), rows)
    });
    refined.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, rows)| rows)
}

/// Rows moved between bends of their cost; each keeps its way.
pub(super) fn refined_rows(case: &FaceCase, rows: MilledRows, margin: f64) -> MilledRows {
    let reach = case.radius - margin;
    let planner = Planner { cost: RowCost::new(case, rows.angle), radius: case.radius, reach };
    let mut refined = rows.rows;
    planner.refine(&mut refined, GAIN * case.weighted_perimeter());
    MilledRows { rows: refined, ..rows }
}

/// The costs of rows of one orientation on a grid of offsets.
pub(super) struct RowGrid<'a> {
    planner: Planner<'a>,
    angle: f64,
    grid: Vec<f64>,
    /// By offset and way (even: forward), then by the offset of the row below; first: none.
    table: Vec<Vec<f64>>,
}

impl RowGrid<'_> {
    /// For up to `most` rows; none where the margin leaves nothing of the cutter, or for no rows.
    pub(super) fn new(case: &FaceCase, angle: f64, most: usize, margin: f64) -> Option<RowGrid<'_>> {
        let reach = case.radius - margin;
        if !(reach > 0.0 && margin >= 0.0) || most == 0 {
            return None;
        }
        let planner = Planner { cost: RowCost::new(case, angle), radius: case.radius, reach };
        let grid = planner.grid(most);
        let tops: Vec<f64> =
            std::iter::once(f64::NEG_INFINITY).chain(grid.iter().map(|c| c + planner.radius)).collect();
        let table = (0..2 * grid.len())
            .map(|i| {
                let mut costs = vec![0.0; tops.len()];
                planner.cost.of_tops(&tops, grid[i / 2], i % 2 == 0, &mut costs);
                costs
            })
            .collect();
        Some(RowGrid { planner, angle, grid, table })
    }

    /// The shortest path over the grid: within a step of the grid of the best rows.
    pub(super) fn rows(&self, count: usize, ways: RowWays) -> Option<MilledRows> {
        let rows = self.best(count, ways, 1).pop()?;
        Some(MilledRows { angle: self.angle, rows })
    }

    /// Of the shortest paths to each last row the best `most`, the best first.
    fn best(&self, count: usize, ways: RowWays, most: usize) -> Vec<Vec<MilledRow>> {
        let (planner, grid, table) = (&self.planner, &self.grid, &self.table);
        let [low, high] = planner.cost.heights;
        let (reach, near, m) = (planner.reach, planner.near(), grid.len());
        // State: offset and way of the last row; value and the state before.
        let mut levels: Vec<Vec<(f64, usize)>> = Vec::new();
        for k in 0..count {
            let mut level = vec![(f64::INFINITY, usize::MAX); 2 * m];
            for (state, slot) in level.iter_mut().enumerate() {
                let (offset, way) = (grid[state / 2], state % 2);
                if k == 0 {
                    if offset <= low + reach + near && (way == 0 || ways == RowWays::Free) {
                        *slot = (table[state][0], usize::MAX);
                    }
                    continue;
                }
                let widest = offset - 2.0 * reach - near;
                for before in grid.partition_point(|c| *c < widest)..state / 2 {
                    for way_before in 0..2 {
                        let allowed = match ways {
                            RowWays::Free => true,
                            RowWays::OneWay => way == way_before,
                            RowWays::Zigzag => way != way_before,
                        };
                        let value = levels[k - 1][2 * before + way_before].0 + table[state][before + 1];
                        if allowed && value < slot.0 {
                            *slot = (value, 2 * before + way_before);
                        }
                    }
                }
            }
            levels.push(level);
        }
        let Some(last) = levels.last() else { return Vec::new() };
        let mut ends: Vec<usize> =
            (0..2 * m).filter(|s| grid[s / 2] >= high - reach - near && last[*s].0.is_finite()).collect();
        ends.sort_by(|a, b| last[*a].0.total_cmp(&last[*b].0));
        ends.truncate(most);
        let back = |mut state: usize| {
            let mut rows = Vec::with_capacity(count);
            for level in levels.iter().rev() {
                rows.push(MilledRow { offset: grid[state / 2], forward: state.is_multiple_of(2) });
                state = level[state].1;
            }
            rows.reverse();
            rows
        };
        ends.into_iter().map(back).collect()
    }
}

struct Planner<'a> {
    cost: RowCost<'a>,
    radius: f64,
    reach: f64,
}

impl Planner<'_> {
    /// Offsets at which rows are tried.
    fn grid(&self, count: usize) -> Vec<f64> {
        let [low, high] = self.cost.heights;
        let (first, last) = (low - self.radius, high + self.radius);
        let mut grid: Vec<f64> = Vec::new();
        self.cost.bends(|offset| grid.push(offset), |_| {});
        grid.retain(|c| (first..=last).contains(c));
        grid.sort_by(f64::total_cmp);
        let near = 1e-9 * (last - first);
        grid.dedup_by(|a, b| *a - *b < near);
        if grid.len() > GRID {
            grid.clear();
        }
        grid.extend((0..GRID).map(|i| first + (last - first) * (i as f64 + 0.5) / GRID as f64));
        // The tightest rows from below and from above: with the least number of rows no others may do.
        for k in 0..count {
            let across = 2.0 * self.reach * k as f64;
            grid.extend([low + self.reach + across, high - self.reach - across]);
        }
        grid.retain(|c| (first..=last).contains(c));
        grid.sort_by(f64::total_cmp);
        grid.dedup();
        grid
    }

    fn near(&self) -> f64 {
        1e-9 * self.radius
    }

    fn value(&self, rows: &[MilledRow]) -> f64 {
        let [low, high] = self.cost.heights;
        let near = self.near();
        let apart = |w: &[MilledRow]| (0.0..=2.0 * self.reach + near).contains(&(w[1].offset - w[0].offset));
        let covers = rows.first().is_some_and(|r| r.offset <= low + self.reach + near)
            && rows.last().is_some_and(|r| r.offset >= high - self.reach - near)
            && rows.windows(2).all(apart);
        if !covers {
            return f64::INFINITY;
        }
        let mut top = f64::NEG_INFINITY;
        rows.iter().fold(0.0, |sum, row| {
            let cost = self.cost.of(top, row.offset, row.forward);
            top = row.offset + self.radius;
            sum + cost
        })
    }

    /// Moves single rows, and all rows together, to bends of the cost while that gains.
    fn refine(&self, rows: &mut Vec<MilledRow>, gain: f64) {
        let mut value = self.value(rows);
        let mut bends = Vec::new();
        let mut levels = vec![self.radius, -self.radius];
        self.cost.bends(|offset| bends.push(offset), |level| levels.push(level));
        for list in [&mut bends, &mut levels] {
            list.sort_by(f64::total_cmp);
            list.dedup_by(|a, b| *a - *b < self.near());
        }
        for _ in 0..ROUNDS {
            let before = value;
            for k in 0..=rows.len() {
                let moved = if k < rows.len() { k..k + 1 } else { 0..rows.len() };
                let shifts = self.shifts(rows, moved.clone(), &bends, &levels);
                let start = rows.clone();
                let shifted = |by: f64| {
                    let mut rows = start.clone();
                    rows[moved.clone()].iter_mut().for_each(|r| r.offset += by);
                    rows
                };
                let mut best = 0.0;
                for &by in &shifts {
                    let trial = self.value(&shifted(by));
                    if trial < value - gain {
                        (value, best) = (trial, by);
                    }
                }
                let step = (self.cost.heights[1] - self.cost.heights[0] + 2.0 * self.radius) / GRID as f64;
                let (by, trial) = golden(
                    [best - step, best + step],
                    GOLDEN_STEPS,
                    |by| (by, self.value(&shifted(by))),
                    |(_, value)| *value,
                );
                if trial < value - gain {
                    (value, best) = (trial, by);
                }
                *rows = shifted(best);
            }
            if !(value < before - gain) {
                break;
            }
        }
    }

    /// Shifts of some rows that bring one of them to a bend.
    fn shifts(
        &self,
        rows: &[MilledRow],
        moved: std::ops::Range<usize>,
        bends: &[f64],
        levels: &[f64],
    ) -> Vec<f64> {
        let [low, high] = self.cost.heights;
        let mut to = Vec::new();
        for k in moved.clone() {
            let from = rows[k].offset;
            to.extend(bends.iter().map(|c| c - from));
            to.extend([low + self.reach - from, high - self.reach - from]);
            if k > 0 && k == moved.start {
                let below = rows[k - 1].offset;
                to.push(below + 2.0 * self.reach - from);
                to.extend(levels.iter().map(|level| below + self.radius - level - from));
            }
            if k + 1 < rows.len() && k + 1 == moved.end {
                let above = rows[k + 1].offset;
                to.push(above - 2.0 * self.reach - from);
                to.extend(levels.iter().map(|level| above + level - self.radius - from));
            }
        }
        // Beyond the neighbours nothing covers.
        to.retain(|by| by.abs() <= 2.0 * self.radius);
        to.sort_by(f64::total_cmp);
        to.dedup_by(|a, b| *a - *b < self.near());
        let most = (SHIFT_WORK / self.cost.edges()).clamp(16, SHIFTS);
        if to.len() > most {
            to.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
            to.truncate(most);
        }
        to
    }
}
