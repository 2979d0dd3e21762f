//! The grid along the tool axis as patches see it.

use std::ops::{Range, RangeInclusive};

use glam::DVec2;
use pulp::Arch;
use rayon::prelude::*;

use super::super::axis::ToolFrame;
use super::super::task::Task;
use super::patch::SIDE;
use super::sweep::Sweep;
use super::tops::{Kept, Tops};
use crate::geom::Aabb;
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::{Grid, LINE_OFFSET};
use crate::stock::{Axis, FIXED_STEP, Interval, Lattice};

/// Lines along an edge of a patch that are its own.
pub(super) const OWN: i64 = SIDE as i64 - 1;

/// Tile and line in it.
pub(super) type Line = (usize, usize);

/// The lines along the tool axis, numbered along the two directions across it, x and y; one row of ways more than lines leads
/// out of the stock on either side. Or some of these lines, a stride apart, without the ways between them.
pub(super) struct Field<'a> {
    grid: &'a Grid,
    tiles_across: usize,
    sign: f64,
    counts: [i64; 2],
    origin: [f64; 2],
    /// Distance of the lines [mm].
    pub(super) step: f64,
    /// Heights down to which lines are gone that the grid does not know of.
    kept: Option<Kept<'a>>,
    /// Distance of the lines, counted in those of the grid, and the first of them.
    pub(super) stride: i64,
    first: [i64; 2],
    /// A height above all material, in the tool frame [mm].
    pub(super) highest: f64,
    /// Instructions of the machine.
    pub(super) arch: Arch,
}

impl<'a> Field<'a> {
    /// The field of a grid of a stock within `bounds`; `kept`: what is known of its lines beside it.
    pub(super) fn new(
        grid: &'a Grid,
        lattice: &Lattice,
        frame: &ToolFrame,
        bounds: Aabb,
        kept: Option<Kept<'a>>,
    ) -> Field<'a> {
        let axes: [Axis; 2] = grid.axis.others().into();
        let along = grid.axis.index();
        let highest = if frame.sign > 0.0 { bounds.max[along] } else { -bounds.min[along] };
        Field {
            grid,
            tiles_across: grid.tiles_across()[0] as usize,
            sign: frame.sign,
            counts: grid.counts.map(i64::from),
            origin: axes.map(|axis| lattice.origin[axis.index()]),
            step: lattice.step,
            kept,
            stride: 1,
            first: [0; 2],
            highest,
            arch: Arch::new(),
        }
    }

    /// Some of the lines, a stride apart.
    pub(super) fn sparse(self, stride: i64) -> Field<'a> {
        let first = self.counts.map(|n| (stride / 2).min((n - 1) / 2));
        Field {
            counts: [0, 1].map(|k| (self.counts[k] - first[k] + stride - 1) / stride),
            origin: [0, 1].map(|k| self.origin[k] + first[k] as f64 * self.step),
            step: self.step * stride as f64,
            stride,
            first,
            ..self
        }
    }

    /// Index in the grid of a line along the direction `k`.
    pub(super) fn in_whole(&self, k: usize, index: i64) -> i64 {
        self.first[k] + index * self.stride
    }

    /// The ways of the grid along the direction `k` that the way to a line from the one before it is made of: each by the line that it
    /// leads to.
    pub(super) fn ways(&self, k: usize, index: i64) -> RangeInclusive<i64> {
        let from = if index == 0 { 0 } else { self.in_whole(k, index - 1) + 1 };
        let out = i64::from(self.grid.counts[k]);
        let to = if index == self.counts[k] { out } else { self.in_whole(k, index) };
        from..=to
    }

    /// Number of patches along both directions.
    pub(super) fn patches(&self) -> [usize; 2] {
        self.counts.map(|n| (n / OWN + 1) as usize)
    }

    /// Indices of the first line of a patch, which is not its own.
    pub(super) fn first(&self, patch: usize) -> [i64; 2] {
        let across = self.patches()[0];
        [patch % across, patch / across].map(|p| p as i64 * OWN - 1)
    }

    /// Coordinate of a line along the direction `k`.
    pub(super) fn place(&self, k: usize, index: i64) -> f64 {
        self.origin[k] + index as f64 * self.step + LINE_OFFSET
    }

    /// A line by its indices, when it is one.
    #[inline]
    pub(super) fn line(&self, a: i64, b: i64) -> Option<Line> {
        let [a, b] = self.in_grid(a, b)?;
        let edge = TILE_EDGE as usize;
        Some((b / edge * self.tiles_across + a / edge, b % edge * edge + a % edge))
    }

    /// Indices of a line in the grid, when it is one.
    #[inline]
    fn in_grid(&self, a: i64, b: i64) -> Option<[usize; 2]> {
        if a < 0 || b < 0 || a >= self.counts[0] || b >= self.counts[1] {
            return None;
        }
        Some([(self.first[0] + a * self.stride) as usize, (self.first[1] + b * self.stride) as usize])
    }

    /// True if a way leads along the direction `k` to a line from the one before it, or to or from the outside.
    #[inline]
    pub(super) fn has_way(&self, k: usize, a: i64, b: i64) -> bool {
        let (along, across) = if k == 0 { (a, b) } else { (b, a) };
        (0..=self.counts[k]).contains(&along) && (0..self.counts[1 - k]).contains(&across)
    }

    /// The intervals of a line.
    pub(super) fn material(&self, (tile, line): Line) -> &'a [Interval] {
        self.grid.tiles[tile].line(line)
    }

    /// Heights of the lowest and the topmost material of a line, in the tool frame [fixed steps], of which nothing is left above `kept`;
    /// as low as can be when it has no material.
    pub(super) fn ends(&self, line: Line, kept: Option<i32>) -> [f64; 2] {
        let material = self.material(line);
        let (Some(first), Some(last)) = (material.first(), material.last()) else {
            return [f64::NEG_INFINITY; 2];
        };
        let [low, high] =
            if self.sign > 0.0 { [first.lo.at, last.hi.at] } else { [-last.hi.at, -first.lo.at] };
        let top = kept.map_or(high, |top| top.min(high));
        if top > low { [low, top].map(f64::from) } else { [f64::NEG_INFINITY; 2] }
    }

    /// The heights that are kept of the lines of a patch, where they are those of the field.
    pub(super) fn kept_of(&self, patch: usize) -> Option<&'a Tops> {
        self.kept.filter(|_| self.stride == 1)?.tops[patch].as_deref()
    }

    /// The height above which nothing is left on a line, where the lines are sparse; `None` where it is as it is in the grid.
    pub(super) fn kept_top(&self, a: i64, b: i64) -> Option<i32> {
        let [i, j] = self.in_grid(a, b)?;
        self.kept.filter(|_| self.stride > 1)?.top(i, j)
    }

    /// For each patch the tasks that may reach it, in order.
    pub(super) fn bins(&self, tasks: &[Task]) -> Vec<Vec<u32>> {
        /// Tasks that are looked at together, which bounds the memory of it, and those that one thread takes of them.
        const WAVE: usize = 16 * PART;
        const PART: usize = 512;
        let patches = self.patches();
        let mut bins = vec![Vec::new(); patches[0] * patches[1]];
        for (wave, tasks) in tasks.chunks(WAVE).enumerate() {
            let near = |(part, tasks): (usize, &[Task])| {
                let first = (wave * WAVE + part * PART) as u32;
                let mut near: Vec<(u32, u32)> = Vec::new();
                self.each_near(tasks, |patch, task| near.push((patch as u32, first + task)));
                near
            };
            let near: Vec<Vec<(u32, u32)>> = tasks.par_chunks(PART).enumerate().map(near).collect();
            for (patch, task) in near.into_iter().flatten() {
                bins[patch as usize].push(task);
            }
        }
        bins
    }

    /// Calls for each task, in order, with each patch that it may reach.
    pub(super) fn each_near(&self, tasks: &[Task], mut each: impl FnMut(usize, u32)) {
        let patches = self.patches();
        let half = 0.5 * (SIDE - 1) as f64 * self.step;
        let middle = |k: usize, p: usize| self.place(k, p as i64 * OWN - 1) + half;
        // The nearest patches by index, one more on either side than needed.
        let range = |k: usize, min: f64, max: f64| {
            let of = |x: f64| (x - self.origin[k]) / (self.step * OWN as f64);
            let from = (of(min).floor() - 1.0).clamp(0.0, patches[k] as f64) as usize;
            let to = (of(max).floor() + 2.0).clamp(0.0, patches[k] as f64) as usize;
            from..to
        };
        for (i, task) in tasks.iter().enumerate() {
            let reach = task.tool.radius + 3.0 * self.step;
            let (min, max) = (task.plan_box.0 - reach, task.plan_box.1 + reach);
            let (min, max) = (Sweep::exchanged(task, min), Sweep::exchanged(task, max));
            let far = reach + half * std::f64::consts::SQRT_2;
            for q in range(1, min.y, max.y) {
                for p in range(0, min.x, max.x) {
                    let centre = Sweep::exchanged(task, DVec2::new(middle(0, p), middle(1, q)));
                    if task.piece.plan.distance_squared(centre) <= far * far {
                        each(q * patches[0] + p, i as u32);
                    }
                }
            }
        }
    }

    /// The rectangle of patches that lines in a box across the axis may lie in, in grid coordinates.
    pub(super) fn rectangle(&self, (min, max): (DVec2, DVec2)) -> [Range<usize>; 2] {
        let patches = self.patches();
        [0, 1].map(|k| {
            let of = |x: f64| ((x - self.origin[k]) / self.step / OWN as f64).floor();
            let inside = |patch: f64| patch.clamp(0.0, patches[k] as f64) as usize;
            inside(of(min[k] - self.step))..inside(of(max[k] + self.step) + 1.0)
        })
    }
}

/// A height as fixed steps, rounded; infinite ones stay so.
#[inline(always)]
pub(super) fn rounded(height: f64) -> f64 {
    /// Added and taken off again it leaves a whole number.
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    (height * (1.0 / FIXED_STEP) + WHOLE) - WHOLE
}
