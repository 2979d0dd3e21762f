//! A patch: 31 x 31 lines along the tool axis and the ways between neighbours, the unit of work of this folder.
//!
//! It knows for each line the height from which on up all is gone, and the task that went lowest; for each way from a line to
//! its neighbour a height from which on up nothing is left on it (a **ceiling**): one convex part took both ends, so it took all
//! between. Tasks come in order. Blocks of 8 x 8 lines are left out where a bound says that a task goes nowhere lower.

use std::f64::consts::SQRT_2;

use glam::DVec2;

use super::super::edge::most_below;
use super::super::effect::Looked;
use super::super::task::Task;
use super::Done;
use super::column::Column;
use super::field::{Field, rounded};
use super::sweep::{BLOCK, BlockOf, Sweep};
use crate::stock::FIXED_STEP;

/// Lines along an edge of a patch that are computed; the first row and column belong to the neighbours.
pub(super) const SIDE: usize = 32;
/// Blocks along an edge.
const ACROSS: usize = SIDE / BLOCK;
/// Blocks of a patch.
const BLOCKS: usize = ACROSS * ACROSS;
/// Lines of a patch, as computed.
const LINES: usize = SIDE * SIDE;

/// Rounding of heights and ceilings [mm].
pub(super) const ROUNDING: f64 = 2.0 * FIXED_STEP;

/// The task of a line that none has cut.
pub(super) const NO_TASK: u32 = u32::MAX;

/// Ceilings of a patch as they are kept between calls: along the first direction across the tool axis and the second, each of
/// the way to a line from its neighbour before [mm]; rounded upwards.
pub(in crate::stock) type PatchCeilings = [[f32; LINES]; 2];

/// The state of a patch while tasks go over it.
pub(super) struct Patch {
    /// Places of the lines [mm].
    pub(super) x: [f64; SIDE],
    pub(super) y: [f64; SIDE],
    /// Heights above which nothing is left on a line, in the tool frame [fixed steps]; no height where no own line is.
    top: Box<[f64; LINES]>,
    /// Heights of their lowest material [fixed steps].
    bottom: Box<[f64; LINES]>,
    /// Tasks that went lowest.
    pub(super) task: Box<[u32; LINES]>,
    /// Ceilings of the ways to a line from the one before it, along x and along y [mm].
    pub(super) ceilings: [Box<[f64; LINES]>; 2],
    /// Heights of the part at hand [mm].
    pub(super) heights: Box<[f64; LINES]>,
    /// Greatest of tops and ceilings of each block [mm].
    hull: [f64; BLOCKS],
    /// Middles of the blocks.
    middles: [[f64; BLOCKS]; 2],
    /// Half a diagonal of a block, with the way to its neighbours.
    pub(super) radius: f64,
    pub(super) step: f64,
    /// Indices of the first line, which is not its own.
    pub(super) first: [i64; 2],
    /// No line has more than one interval.
    simple: bool,
}

impl Patch {
    /// A patch of a field with its ceilings so far.
    pub(super) fn new(field: &Field, patch: usize, known: Option<&PatchCeilings>) -> Patch {
        let first = field.first(patch);
        let places =
            |k: usize| -> [f64; SIDE] { std::array::from_fn(|i| field.place(k, first[k] + i as i64)) };
        let (x, y) = (places(0), places(1));
        let mut made = Patch {
            middles: [[0.0; BLOCKS]; 2],
            top: Box::new([f64::NEG_INFINITY; LINES]),
            bottom: Box::new([f64::NEG_INFINITY; LINES]),
            task: Box::new([NO_TASK; LINES]),
            ceilings: [(); 2].map(|()| Box::new([f64::NEG_INFINITY; LINES])),
            heights: Box::new([f64::INFINITY; LINES]),
            hull: [0.0; BLOCKS],
            radius: (0.5 * (BLOCK - 1) as f64 * SQRT_2 + 1.0) * field.step,
            step: field.step,
            first,
            simple: true,
            x,
            y,
        };
        for b in 0..BLOCKS {
            let at = |line: usize, of: &[f64; SIDE]| 0.5 * (of[line * BLOCK] + of[line * BLOCK + BLOCK - 1]);
            made.middles[0][b] = at(b % ACROSS, &made.x);
            made.middles[1][b] = at(b / ACROSS, &made.y);
        }
        for r in 1..SIDE {
            for c in 1..SIDE {
                let (l, a, b) = (r * SIDE + c, first[0] + c as i64, first[1] + r as i64);
                if let Some(line) = field.line(a, b) {
                    [made.bottom[l], made.top[l]] = field.ends(line);
                    made.simple &= field.material(line).len() < 2;
                }
                for (k, ceilings) in made.ceilings.iter_mut().enumerate() {
                    if field.has_way(k, a, b) {
                        ceilings[l] = known.map_or(field.highest, |known| f64::from(known[k][l]));
                    }
                }
            }
        }
        for b in 0..BLOCKS {
            made.hull[b] = made.hull_of(b);
        }
        made
    }

    /// The ceilings, rounded upwards; those of the patch become the same.
    pub(super) fn keep_ceilings(&mut self) -> Box<PatchCeilings> {
        let mut kept = Box::new([[f32::NEG_INFINITY; LINES]; 2]);
        for (kept, own) in kept.iter_mut().zip(&mut self.ceilings) {
            for (kept, own) in kept.iter_mut().zip(own.iter_mut()) {
                let near = *own as f32;
                *kept = if f64::from(near) < *own { near.next_up() } else { near };
                *own = f64::from(*kept);
            }
        }
        kept
    }

    /// Places of the lines of a block.
    fn places(&self, block: usize) -> [[f64; BLOCK]; 2] {
        let (c, r) = (block % ACROSS * BLOCK, block / ACROSS * BLOCK);
        [std::array::from_fn(|i| self.x[c + i]), std::array::from_fn(|i| self.y[r + i])]
    }

    /// Greatest of tops and ceilings of a block, and of the ways from it to the next blocks.
    fn hull_of(&self, block: usize) -> f64 {
        let (c0, r0) = (block % ACROSS * BLOCK, block / ACROSS * BLOCK);
        let mut hull = f64::NEG_INFINITY;
        let mut top = f64::NEG_INFINITY;
        for r in r0..r0 + BLOCK {
            let row = r * SIDE + c0..r * SIDE + c0 + BLOCK;
            let (along, up) = (&self.ceilings[0][row.clone()], &self.ceilings[1][row.clone()]);
            for ((t, a), u) in self.top[row].iter().zip(along).zip(up) {
                top = if *t > top { *t } else { top };
                hull = if *a > hull { *a } else { hull };
                hull = if *u > hull { *u } else { hull };
            }
            if c0 + BLOCK < SIDE {
                hull = hull.max(self.ceilings[0][r * SIDE + c0 + BLOCK]);
            }
        }
        if r0 + BLOCK < SIDE {
            for c in c0..c0 + BLOCK {
                hull = hull.max(self.ceilings[1][(r0 + BLOCK) * SIDE + c]);
            }
        }
        hull.max(top * FIXED_STEP)
    }

    /// The blocks that a part may go lower in than the hull and a slack [mm]; where nothing was cut yet, all that it reaches.
    pub(super) fn active(&self, sweep: &Sweep, slack: f64) -> impl Iterator<Item = usize> + use<> {
        let bounds = sweep.bounds(&self.middles[0], &self.middles[1], self.radius);
        let mut mask = 0u32;
        for b in 0..BLOCKS {
            mask |= u32::from(bounds[b] < self.hull[b] + slack) << b;
        }
        (0..BLOCKS).filter(move |b| mask >> b & 1 == 1)
    }

    /// Computes the heights of a part over blocks.
    pub(super) fn raise(&mut self, sweep: &Sweep, blocks: impl Iterator<Item = usize>) {
        let mut out: BlockOf<f64> = [[0.0; BLOCK]; BLOCK];
        for block in blocks {
            let [x, y] = self.places(block);
            sweep.heights(&x, &y, &mut out);
            self.set_heights(block, |r, c| out[r][c]);
        }
    }

    /// Forgets the heights over blocks.
    pub(super) fn lower(&mut self, blocks: impl Iterator<Item = usize>) {
        for block in blocks {
            self.set_heights(block, |_, _| f64::INFINITY);
        }
    }

    fn set_heights(&mut self, block: usize, of: impl Fn(usize, usize) -> f64) {
        let start = block / ACROSS * BLOCK * SIDE + block % ACROSS * BLOCK;
        for r in 0..BLOCK {
            for (c, h) in self.heights[start + r * SIDE..][..BLOCK].iter_mut().enumerate() {
                *h = of(r, c);
            }
        }
    }

    /// True if a task may meet, where it should not, something that this patch knows too little about.
    pub(super) fn is_unclear(&self, task: &Task) -> bool {
        let tool = task.tool;
        let slack = if tool.edges.is_some() { most_below(self.step).max(self.step) } else { 0.0 };
        let bodies =
            [(&tool.contact, Looked::Cutting), (&tool.shank, Looked::Shank), (&tool.holder, Looked::Holder)];
        bodies.into_iter().any(|(body, looked)| {
            let asked = looked != Looked::Cutting || task.watch;
            let bottom = task.tip_range().0 + body.bottom - slack - task.clearance;
            asked && !body.parts.is_empty() && {
                let reach = body.radius + 2.0 * self.step + self.radius;
                (0..BLOCKS).any(|b| {
                    let middle = DVec2::new(self.middles[0][b], self.middles[1][b]);
                    bottom < self.hull[b] + ROUNDING
                        && task.piece.plan.distance_squared(Sweep::exchanged(task, middle)) <= reach * reach
                })
            }
        })
    }

    /// Takes a task over the patch; `None` where it has to be looked at line by line.
    pub(super) fn take(&mut self, field: &Field, index: u32, task: &Task) -> Option<Done> {
        let mut done = Done { task: index, removed: 0, deepest: 0, first: None };
        let rising = task.piece.rise() > 0.0;
        if rising && self.is_unclear(task) || task.watch && self.is_unclear(task) {
            return None;
        }
        // What is watched and clear meets nothing.
        if !task.watch {
            for part in &task.tool.cutting.parts {
                let sweep = Sweep::new(task, part);
                let active = self.active(&sweep, 0.0);
                let active: Vec<usize> = active.collect();
                if active.is_empty() {
                    continue;
                }
                let top = task.tip_range().0 + part.top;
                let whole = task.removes && task.tool.hollow.is_none();
                if !whole || active.iter().any(|b| self.hull[*b] > top) {
                    return None;
                }
                self.raise(&sweep, active.iter().copied());
                for block in &active {
                    self.sink(field, *block, (index, task), &sweep, &mut done);
                }
                for block in &active {
                    self.hull[*block] = self.hull_of(*block);
                }
                self.lower(active.iter().copied());
            }
        }
        (rising || !self.is_unclear(task)).then_some(done)
    }

    /// Lowers the tops and ceilings of a block to the heights of a part.
    fn sink(
        &mut self,
        field: &Field,
        block: usize,
        (index, task): (u32, &Task),
        sweep: &Sweep,
        done: &mut Done,
    ) {
        let (c0, r0) = (block % ACROSS * BLOCK, block / ACROSS * BLOCK);
        let mut overlap = [[0.0; BLOCK]; BLOCK];
        let (mut greatest, mut sum) = (0.0, 0.0);
        for (r, overlap) in overlap.iter_mut().enumerate() {
            let start = (r0 + r) * SIDE + c0;
            let heights: &[f64; BLOCK] =
                self.heights[start..start + BLOCK].try_into().unwrap_or(&[0.0; BLOCK]);
            let tops = &mut self.top[start..start + BLOCK];
            let tasks = &mut self.task[start..start + BLOCK];
            let bottoms = &self.bottom[start..start + BLOCK];
            let lines = tops.iter_mut().zip(bottoms).zip(tasks);
            for ((((top, bottom), owner), h), overlap) in lines.zip(heights).zip(overlap) {
                let at = rounded(*h);
                let at = if at > *bottom { at } else { *bottom };
                let lower = at < *top;
                *overlap = if lower { *top - at } else { 0.0 };
                *owner = if lower { index } else { *owner };
                *top = if lower { at } else { *top };
                sum += *overlap;
                greatest = if *overlap > greatest { *overlap } else { greatest };
            }
        }
        if self.simple {
            done.removed += sum as i64;
        }
        // The part made smaller by the clearance passes higher by the clearance at least.
        let clearance = task.clearance / FIXED_STEP - 1.0;
        let told = |overlap: f64, done: &Done| overlap > clearance && overlap > done.deepest as f64;
        if greatest > 0.0 && (!self.simple || told(greatest, done)) {
            for (i, overlap) in overlap.iter().flatten().enumerate().filter(|(_, o)| **o > 0.0) {
                let (r, c) = (r0 + i / BLOCK, c0 + i % BLOCK);
                let Some(line) = field.line(self.first[0] + c as i64, self.first[1] + r as i64) else {
                    continue;
                };
                let floor = self.top[r * SIDE + c];
                let over = Sweep::exchanged(task, DVec2::new(self.x[c], self.y[r]));
                let column = Column { over, floor: floor as i32, top: (floor + overlap) as i32 };
                let mut taken = *overlap as i64;
                if !self.simple {
                    taken = column.taken(field.material(line), task);
                    done.removed += taken;
                }
                if told(*overlap, done) {
                    column.note(field.material(line), taken, task, done);
                }
            }
        }
        self.sink_ceilings(block, sweep);
    }

    fn sink_ceilings(&mut self, block: usize, sweep: &Sweep) {
        let (c0, r0) = (block % ACROSS * BLOCK, block / ACROSS * BLOCK);
        for (k, back) in [(0, 1), (1, SIDE)] {
            for r in r0..r0 + BLOCK {
                // The first row and column have none.
                if r == 0 {
                    continue;
                }
                let from = r * SIDE + c0 + usize::from(c0 == 0);
                let to = r * SIDE + c0 + BLOCK;
                let ceilings = &mut self.ceilings[k][from..to];
                let (before, here) = (&self.heights[from - back..to - back], &self.heights[from..to]);
                if sweep.is_convex() {
                    for ((ceiling, a), b) in ceilings.iter_mut().zip(before).zip(here) {
                        let both = if *a > *b { *a } else { *b };
                        *ceiling = if both < *ceiling { both } else { *ceiling };
                    }
                } else {
                    for (i, ceiling) in ceilings.iter_mut().enumerate() {
                        if before[i].max(here[i]) < *ceiling {
                            let (l, p) = (from + i, from + i - back);
                            let at = |l: usize| DVec2::new(self.x[l % SIDE], self.y[l / SIDE]);
                            *ceiling = ceiling.min(sweep.between(at(p), at(l)));
                        }
                    }
                }
            }
        }
    }
}
