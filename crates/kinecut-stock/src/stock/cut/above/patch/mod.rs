//! A patch: 31 x 31 lines along the tool axis and the ways between neighbours, the unit of work of this folder.
//!
//! It knows for each line the height from which on up all is gone, and the task that went lowest; for each way from a line to
//! its neighbour a height from which on up nothing is left on it (a **ceiling**): one convex part took both ends, so it took all
//! between. Tasks come in order. Blocks of 8 x 8 lines are left out where a bound says that a task goes nowhere lower.

mod covers;
mod sink;
mod told;

use std::f64::consts::SQRT_2;
use std::sync::Arc;

use glam::DVec2;
use pulp::{Arch, NullaryFnOnce};

use self::covers::Cover;
use super::super::body::RevolvedParts;
use super::super::edge::most_below;
use super::super::effect::Looked;
use super::super::task::Task;
use super::Done;
use super::field::{Field, OWN};
use super::movers::Mover;
use super::sweep::{BLOCK, BlockOf, Sweep, most};
use super::tops::Tops;
use crate::stock::FIXED_STEP;

/// Lines along an edge of a patch that are computed; the first row and column belong to the neighbours.
pub(super) const SIDE: usize = 32;
/// Blocks along an edge.
const ACROSS: usize = SIDE / BLOCK;
/// Blocks of a patch.
pub(super) const BLOCKS: usize = ACROSS * ACROSS;
/// Lines of a patch, as computed.
pub(super) const LINES: usize = SIDE * SIDE;
/// Heights along an edge: two more before the first line, and one behind the last, are as of no line.
pub(super) const HEIGHTS: usize = SIDE + 3;

/// Rounding of heights and ceilings [mm].
pub(super) const ROUNDING: f64 = 2.0 * FIXED_STEP;

/// The task of a line that none has cut.
const NO_TASK: f64 = -1.0;

/// Ceilings of a patch as they are kept between calls: along the first direction across the tool axis and the second, each of
/// the way to a line from its neighbour before [mm]; rounded upwards.
pub(in crate::stock) type PatchCeilings = [[f32; LINES]; 2];

/// Ceilings of a patch, shared by the times at which they were the same; `None` where they are as high as the stock.
pub(super) type Known = Option<Arc<PatchCeilings>>;

/// The bodies of a task that should meet nothing, as far as that is not known.
pub(super) fn bodies<'a>(task: &Task<'a>) -> impl Iterator<Item = (&'a RevolvedParts, Looked)> {
    let tool = task.tool;
    let asked = [
        task.watch && !task.free,
        // What cuts below it, or meets nothing, leaves nothing to a shank that is no wider.
        tool.shank.radius > tool.cutting.radius,
        true,
    ];
    let all =
        [(&tool.contact, Looked::Cutting), (&tool.shank, Looked::Shank), (&tool.holder, Looked::Holder)];
    all.into_iter()
        .zip(asked)
        .filter(|((body, _), asked)| *asked && !body.parts.is_empty())
        .map(|(body, _)| body)
}

/// Distance below a body down to which material counts as near [mm].
pub(super) fn lowered(task: &Task) -> f64 {
    let slack = if task.tool.edges.is_some() { most_below(task.step).max(task.step) } else { 0.0 };
    slack + task.clearance
}

/// Index of the height over a line in row `r` and column `c`.
#[inline(always)]
pub(super) fn height_at(r: usize, c: usize) -> usize {
    (r + 2) * HEIGHTS + c + 2
}

/// Blocks of a patch: a bit for each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Blocks(u32);

impl Blocks {
    pub(super) fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// First column and row of each.
    pub(super) fn corners(self) -> impl Iterator<Item = (usize, usize)> {
        (0..BLOCKS).filter(move |b| self.0 >> b & 1 == 1).map(corner)
    }
}

/// First column and row of a block.
fn corner(block: usize) -> (usize, usize) {
    (block % ACROSS * BLOCK, block / ACROSS * BLOCK)
}

/// By block, the height of a plane over the middle [mm], and its slopes along x and y.
pub(super) type Planes = [[f64; BLOCKS]; 3];

/// The state of a patch while tasks go over it.
pub(super) struct Patch {
    /// Places of the lines [mm].
    pub(super) x: [f64; SIDE],
    pub(super) y: [f64; SIDE],
    /// Heights above which nothing is left on a line, in the tool frame [fixed steps]; no height where no own line is.
    top: Box<[f64; LINES]>,
    /// Heights of their lowest material [fixed steps].
    bottom: Box<[f64; LINES]>,
    /// Tasks that went lowest; as floating-point numbers they are chosen with the heights in one instruction.
    task: Box<[f64; LINES]>,
    /// Ceilings of the ways to a line from the one before it, along x and along y [mm].
    pub(super) ceilings: [Box<[f64; LINES]>; 2],
    /// What the part at hand took of each line [fixed steps].
    overlap: Box<[f64; LINES]>,
    /// Heights of the part at hand [mm], see [`height_at`].
    pub(super) heights: Box<[f64; HEIGHTS * HEIGHTS]>,
    /// Bounds from below on the part at hand on the ways, see `claims.rs`.
    pub(super) lows: [Box<[f64; LINES]>; 2],
    /// Greatest of tops and ceilings of each block [mm].
    hull: [f64; BLOCKS],
    /// Middles of the blocks.
    middles: [[f64; BLOCKS]; 2],
    /// Half a diagonal of a block, with the way to its neighbours.
    pub(super) radius: f64,
    pub(super) step: f64,
    /// Indices of the first line, which is not its own.
    pub(super) first: [i64; 2],
    /// Its number in the field.
    number: usize,
    /// The last of the tasks that went lowest on the lines of each block.
    latest: [f64; BLOCKS],
    /// Covers of the blocks, where they are kept.
    covers: Option<[Cover; BLOCKS]>,
    /// See [`Patch::keep_covers`].
    whole: bool,
    /// No line has more than one interval.
    simple: bool,
    /// The ways between the lines are asked for, too.
    between: bool,
    /// Instructions of the machine.
    pub(super) arch: Arch,
}

impl Patch {
    /// A patch of a field with its ceilings so far, as if no line had material.
    pub(super) fn new(field: &Field, patch: usize, known: Option<&PatchCeilings>) -> Patch {
        // Ways between sparse lines have no ceilings but those that are given.
        let is_between = field.stride == 1 || known.is_some();
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
            overlap: Box::new([0.0; LINES]),
            lows: [(); 2].map(|()| Box::new([0.0; LINES])),
            heights: Box::new([f64::INFINITY; HEIGHTS * HEIGHTS]),
            arch: field.arch,
            hull: [0.0; BLOCKS],
            latest: [NO_TASK; BLOCKS],
            covers: None,
            whole: false,
            between: field.stride == 1,
            radius: (0.5 * (BLOCK - 1) as f64 * SQRT_2 + 1.0) * field.step,
            step: field.step,
            first,
            number: patch,
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
                for (k, ceilings) in made.ceilings.iter_mut().enumerate() {
                    if is_between && field.has_way(k, a, b) {
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

    /// The patch with the material of its own lines.
    pub(super) fn with_lines(mut self, field: &Field) -> Patch {
        let tops = field.kept_of(self.number);
        for r in 1..SIDE {
            for c in 1..SIDE {
                let (l, a, b) = (r * SIDE + c, self.first[0] + c as i64, self.first[1] + r as i64);
                if let Some(line) = field.line(a, b) {
                    let kept = match tops {
                        Some(tops) => tops.top_of(c - 1, r - 1),
                        None => field.kept_top(a, b),
                    };
                    [self.bottom[l], self.top[l]] = field.ends(line, kept);
                    self.simple &= field.material(line).len() < 2;
                }
            }
        }
        for b in 0..BLOCKS {
            self.hull[b] = self.hull_of(b);
        }
        self
    }

    /// The ceilings, rounded upwards.
    pub(super) fn kept_ceilings(&self) -> PatchCeilings {
        let mut kept = [[f32::NEG_INFINITY; LINES]; 2];
        for (kept, own) in kept.iter_mut().zip(&self.ceilings) {
            for (kept, own) in kept.iter_mut().zip(own.iter()) {
                let near = *own as f32;
                *kept = if f64::from(near) < *own { near.next_up() } else { near };
            }
        }
        kept
    }

    /// Greatest of tops and ceilings of a block, and of the ways from it to the next blocks.
    #[inline(always)]
    fn hull_of(&self, block: usize) -> f64 {
        let (c0, r0) = corner(block);
        let (mut tops, mut ways) = ([f64::NEG_INFINITY; BLOCK], [f64::NEG_INFINITY; BLOCK]);
        let mut beyond = f64::NEG_INFINITY;
        for r in r0..r0 + BLOCK {
            let start = r * SIDE + c0;
            let row = |of: &[f64; LINES]| row_at(&of[..], start);
            let (top, along, up) = (row(&self.top), row(&self.ceilings[0]), row(&self.ceilings[1]));
            for c in 0..BLOCK {
                tops[c] = most(tops[c], top[c]);
                ways[c] = most(ways[c], most(along[c], up[c]));
            }
            if c0 + BLOCK < SIDE {
                beyond = most(beyond, self.ceilings[0][start + BLOCK]);
            }
        }
        if r0 + BLOCK < SIDE {
            let next = row_at(&self.ceilings[1][..], (r0 + BLOCK) * SIDE + c0);
            for c in 0..BLOCK {
                ways[c] = most(ways[c], next[c]);
            }
        }
        let greatest = |of: [f64; BLOCK]| of.into_iter().fold(f64::NEG_INFINITY, most);
        most(most(greatest(ways), beyond), greatest(tops) * FIXED_STEP)
    }

    /// The last of the tasks that went lowest on the lines of a block.
    #[inline(always)]
    fn latest_of(&self, block: usize) -> f64 {
        let (c0, r0) = corner(block);
        let mut latest = [NO_TASK; BLOCK];
        for r in r0..r0 + BLOCK {
            let row = row_at(&self.task[..], r * SIDE + c0);
            for c in 0..BLOCK {
                latest[c] = most(latest[c], row[c]);
            }
        }
        latest.into_iter().fold(NO_TASK, most)
    }

    /// The blocks in which a task may go lowest, by its bounds on them: lower than the hull, or as low and earlier.
    pub(super) fn open_to(&self, bounds: &[f64; BLOCKS], index: f64) -> Blocks {
        let mut mask = 0;
        for b in 0..BLOCKS {
            let slack = if index < self.latest[b] { FIXED_STEP } else { 0.0 };
            mask |= u32::from(bounds[b] < self.hull[b] + slack) << b;
        }
        Blocks(mask)
    }

    /// Height above a block's cover up to which a task may still go lowest: where it does as low, and comes earlier [mm].
    pub(super) fn slack(&self, block: usize, index: f64) -> f64 {
        /// Rounding of planes [mm].
        const NEAR: f64 = 1e-9;
        if index < self.latest[block] { FIXED_STEP } else { NEAR }
    }

    /// Bounds on a part by block, as [`Sweep::bounds`] has them.
    pub(super) fn bounds(&self, sweep: &Sweep) -> [f64; BLOCKS] {
        self.arch.dispatch(Bounds { patch: self, sweep })
    }

    /// Greatest of tops and ceilings [mm].
    pub(super) fn highest(&self) -> f64 {
        self.hull.into_iter().fold(f64::NEG_INFINITY, most)
    }

    /// The blocks that a part may go lower in than the hull and a slack [mm]; where nothing was cut yet, all that it reaches.
    pub(super) fn active(&self, sweep: &Sweep, slack: f64) -> Blocks {
        self.arch.dispatch(Reached { patch: self, sweep, slack })
    }

    /// Computes the heights of a part over blocks, where not several are computed at once.
    pub(super) fn raise_one_by_one(&mut self, sweep: &Sweep, blocks: Blocks) {
        let mut out: BlockOf<f64> = [[0.0; BLOCK]; BLOCK];
        for corner in blocks.corners() {
            let [x, y] = self.places(corner);
            sweep.heights_one_by_one(&x, &y, &mut out);
            self.set_heights(corner, &out);
        }
    }

    /// Computes the heights of a part over blocks, several at once.
    #[inline(always)]
    pub(super) fn raise(&mut self, sweep: &Sweep, blocks: Blocks) {
        let mut out: BlockOf<f64> = [[0.0; BLOCK]; BLOCK];
        for corner in blocks.corners() {
            let [x, y] = self.places(corner);
            sweep.heights(&x, &y, &mut out);
            self.set_heights(corner, &out);
        }
    }

    #[inline(always)]
    fn places(&self, (c, r): (usize, usize)) -> [[f64; BLOCK]; 2] {
        [row_at(&self.x, c), row_at(&self.y, r)]
    }

    #[inline(always)]
    fn set_heights(&mut self, (c, r): (usize, usize), heights: &BlockOf<f64>) {
        for (i, row) in heights.iter().enumerate() {
            put_row(&mut self.heights[..], height_at(r + i, c), *row);
        }
    }

    /// Forgets the heights over blocks.
    pub(super) fn lower(&mut self, blocks: Blocks) {
        for (c, r) in blocks.corners() {
            for i in 0..BLOCK {
                put_row(&mut self.heights[..], height_at(r + i, c), [f64::INFINITY; BLOCK]);
            }
        }
    }

    /// True if a task may meet, where it should not, something that this patch knows too little about.
    pub(super) fn is_unclear(&self, task: &Task) -> bool {
        bodies(task).any(|(body, _)| {
            let bottom = task.tip_range().0 + body.bottom - lowered(task);
            let reach = body.radius + 2.0 * self.step;
            let is_near = |x: f64, y: f64, reach: f64| {
                let at = Sweep::exchanged(task, DVec2::new(x, y));
                task.piece.plan.distance_squared(at) <= reach * reach
            };
            let is_higher = |height: f64| bottom < height + ROUNDING;
            // Blocks first, then their lines, each with the ways to it.
            (0..BLOCKS).any(|b| {
                is_higher(self.hull[b])
                    && is_near(self.middles[0][b], self.middles[1][b], reach + self.radius)
                    && (0..BLOCK * BLOCK).any(|i| {
                        let (c, r) = (corner(b).0 + i % BLOCK, corner(b).1 + i / BLOCK);
                        let l = r * SIDE + c;
                        let ways = most(self.ceilings[0][l], self.ceilings[1][l]);
                        is_higher(most(self.top[l] * FIXED_STEP, ways))
                            && is_near(self.x[c], self.y[r], reach + self.step)
                    })
            })
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
            if !self.is_taken_whole(task) {
                return None;
            }
            self.cut(field, task, &mut done);
        }
        (rising || !self.is_unclear(task)).then_some(done)
    }

    /// Whether a task takes all above its underside, as far as it goes lower than what is there.
    fn is_taken_whole(&self, task: &Task) -> bool {
        let whole = task.removes && task.tool.hollow.is_none();
        task.tool.cutting.parts.iter().all(|part| {
            let active = self.active(&Sweep::new(task, part), 0.0);
            let top = task.tip_range().0 + part.top;
            let is_below = |b: usize| active.0 >> b & 1 == 0 || self.hull[b] <= top;
            active.is_empty() || whole && (0..BLOCKS).all(is_below)
        })
    }

    /// Lets the parts of a task, which takes all above its underside, go through the patch, and notes what they take.
    pub(super) fn cut(&mut self, field: &Field, task: &Task, done: &mut Done) {
        for part in &task.tool.cutting.parts {
            let sweep = Sweep::new(task, part);
            let active = self.active(&sweep, 0.0);
            if active.is_empty() {
                continue;
            }
            let sunk = self.sink(&sweep, active, f64::from(done.task), true);
            for (corner, sunk) in active.corners().zip(&sunk) {
                self.note(field, corner, task, sunk, done);
            }
            self.lower(active);
        }
    }

    /// The own lines that have been cut: those of tasks, of whose moves `of` tells the number and the piece, else as they were kept.
    pub(super) fn cut_tops(&self, kept: Option<&Tops>, of: &dyn Fn(u32) -> Mover) -> Tops {
        Tops::of(|own| {
            let l = own + own / OWN as usize + 1 + SIDE;
            if self.task[l] == NO_TASK {
                return kept?.line(own);
            }
            Some((self.top[l] as i32, of(self.task[l] as u32)))
        })
    }
}

// Work in the widest instructions of the machine: all that these call has to become part of them.

/// The blocks that a part may go lower in.
struct Reached<'a, 'b> {
    patch: &'a Patch,
    sweep: &'a Sweep<'b>,
    slack: f64,
}

impl NullaryFnOnce for Reached<'_, '_> {
    type Output = Blocks;

    #[inline(always)]
    fn call(self) -> Blocks {
        let patch = self.patch;
        let bounds = self.sweep.bounds(&patch.middles[0], &patch.middles[1], patch.radius);
        let mut mask = 0;
        for b in 0..BLOCKS {
            mask |= u32::from(bounds[b] < patch.hull[b] + self.slack) << b;
        }
        Blocks(mask)
    }
}

/// Bounds on a part by block.
struct Bounds<'a, 'b> {
    patch: &'a Patch,
    sweep: &'a Sweep<'b>,
}

impl NullaryFnOnce for Bounds<'_, '_> {
    type Output = [f64; BLOCKS];

    #[inline(always)]
    fn call(self) -> [f64; BLOCKS] {
        let Bounds { patch, sweep } = self;
        sweep.bounds(&patch.middles[0], &patch.middles[1], patch.radius)
    }
}

/// A row of a block.
#[inline(always)]
pub(super) fn row_at(of: &[f64], start: usize) -> [f64; BLOCK] {
    // Not by copying a slice: that is a call unless the compiler sees its length.
    of[start..].first_chunk().copied().unwrap_or_default()
}

/// Puts a row of a block in its place.
#[inline(always)]
pub(super) fn put_row(of: &mut [f64], start: usize, row: [f64; BLOCK]) {
    if let Some(place) = of[start..].first_chunk_mut() {
        *place = row;
    }
}
