//! A closer look at edges of the stock that a tool may clip between the lines of its model.
//!
//! The part of the stock around the edge is cut once more with lines four times as near, by all moves that reach it, and
//! again where these do not tell either, until an overlap of [`Missed::UNTOLD`] cannot lie between them. An overlap that is
//! met replaces the edge; an edge with no overlap is dropped. A part that would take too many lines stays a doubt.

use std::collections::BTreeMap;
use std::f64::consts::SQRT_2;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use super::bins::Bins;
use super::check::Job;
use super::missed::{Missed, may_clip};
use super::raw::{drill, take_out};
use crate::base::{Progress, Result};
use crate::geom::Aabb;
use crate::operations::measured::Loose;
use crate::stock::TriDexel;
use crate::stock::cut::{CutList, CutMove, CutOptions, Edge, MoveEffect, ToolBody, cut};
use crate::trace::Trace;

/// Lines are brought so much nearer together at a time.
const FINER: f64 = 4.0;

/// Most memory of one part of the stock [bytes], and of all of one job in turn.
const MOST_BYTES: u64 = 64 << 20;
const MOST_BYTES_OF_ALL: u64 = 2 << 30;

/// Most pairs of a line and a move over it, of all parts of one job: work of about half a minute on one core.
const MOST_WORK: f64 = 3e8;

/// Round an edge that was seen, so many steps are looked at: an overlap is no farther than 1.42 steps from it, and walls shall
/// have a thickness.
const ROOM: f64 = 2.5;

/// A part of the stock thinner than this is not worth a look [mm].
const LEAST: f64 = 1e-3;

/// A job's moves, cores and tools: all that changes the stock, in order.
pub(super) struct Story<'a> {
    pub(super) job: &'a Job,
    pub(super) traces: &'a [&'a Trace],
    /// For each setup, the cores that are taken out.
    pub(super) loose: &'a [Vec<Loose>],
    /// For each setup the moves.
    pub(super) moves: &'a [Arc<CutList>],
    pub(super) bodies: &'a [ToolBody],
}

/// A move that passes an edge: setup, index, and where.
#[derive(Clone, Copy, Debug)]
struct Passing {
    setup: usize,
    index: usize,
    bounds: Aabb,
}

/// Looks closer wherever an edge may have been clipped, and replaces what the moves there are known to meet.
pub(super) fn look_closer(
    story: &Story<'_>,
    effects: &mut [Vec<MoveEffect>],
    progress: &dyn Progress,
) -> Result<()> {
    let mut step = story.job.step;
    let mut passing = all_passing(effects, step);
    if passing.is_empty() {
        return Ok(());
    }
    let swept: Vec<Swept<'_>> = story.moves.iter().map(|list| Swept::of(list)).collect();
    let mut left = Left { bytes: MOST_BYTES_OF_ALL, work: MOST_WORK };
    while !passing.is_empty() && SQRT_2 * step > Missed::UNTOLD {
        let margin = ROOM * step;
        step = (step / FINER).max(Missed::UNTOLD / SQRT_2 * 0.999);
        // The effect of each move on all parts that it reaches; none where a part was not looked at.
        let mut answers: BTreeMap<(usize, usize), Option<MoveEffect>> = BTreeMap::new();
        for (all, group) in groups(passing) {
            let Some(all) = cut_to(all, story.job.stock.bounds()) else { continue };
            for part in split(all, step, margin) {
                let inside: Vec<Passing> = group.iter().filter(|p| p.bounds.meets(part)).copied().collect();
                if inside.is_empty() {
                    continue;
                }
                let found = match left.moves_of(story, &swept, part, step, &inside) {
                    Some(moves) => cut_part(story, &moves, part, step, &inside, progress)?
                        .into_iter()
                        .map(Some)
                        .collect(),
                    None => vec![None; inside.len()],
                };
                for (of, now) in inside.iter().zip(found) {
                    let answer = answers.entry((of.setup, of.index)).or_insert(Some(MoveEffect::default()));
                    *answer = answer.take().zip(now).map(|(before, now)| either(before, &now));
                }
            }
        }
        passing = Vec::new();
        for ((setup, index), answer) in answers {
            let effect = &mut effects[setup][index];
            let Some(closer) = answer else { continue };
            merge(effect, &closer);
            passing.extend(may_clip(effect).map(|e| Passing {
                setup,
                index,
                bounds: e.bounds.grown(ROOM * step),
            }));
        }
    }
    Ok(())
}

/// Memory [bytes] and work that are left to closer looks.
struct Left {
    bytes: u64,
    work: f64,
}

impl Left {
    /// The moves of each setup that cut a part of the stock anew, in order; `None` where that needs more than is left.
    fn moves_of(
        &mut self,
        story: &Story<'_>,
        swept: &[Swept<'_>],
        part: Aabb,
        step: f64,
        asked: &[Passing],
    ) -> Option<Vec<Vec<usize>>> {
        let bytes = TriDexel::memory(part, step);
        if bytes > MOST_BYTES || bytes > self.bytes {
            return None;
        }
        let last = asked.iter().map(|p| p.setup).max().unwrap_or(0);
        let moves: Vec<Vec<usize>> = swept[..=last].iter().map(|s| s.reaching(part)).collect();
        let lines = |(list, indices): (&Arc<CutList>, &Vec<usize>)| -> f64 {
            indices.iter().map(|i| lines_over(list.swept(*i), part, step)).sum()
        };
        let work: f64 = story.moves.iter().zip(&moves).map(lines).sum();
        if work > self.work {
            return None;
        }
        self.bytes -= bytes;
        self.work -= work;
        Some(moves)
    }
}

/// Lines of a part of the stock, in all three directions, that cross a box.
fn lines_over(swept: Aabb, part: Aabb, step: f64) -> f64 {
    let size = part.max.min(swept.max) - part.min.max(swept.min);
    let along = |length: f64| (length.max(0.0) / step).floor() + 1.0;
    let (x, y, z) = (along(size.x), along(size.y), along(size.z));
    x * y + y * z + z * x
}

/// The moves that pass an edge.
fn all_passing(effects: &[Vec<MoveEffect>], step: f64) -> Vec<Passing> {
    let mut all = Vec::new();
    for (setup, list) in effects.iter().enumerate() {
        for (index, effect) in list.iter().enumerate() {
            all.extend(may_clip(effect).map(|e| Passing {
                setup,
                index,
                bounds: e.bounds.grown(ROOM * step),
            }));
        }
    }
    all
}

/// Halves of a box, and halves of these, until each takes no more memory than a part may; they overlap by twice a margin [mm].
fn split(all: Aabb, step: f64, margin: f64) -> Vec<Aabb> {
    let (mut parts, mut open) = (Vec::new(), vec![all]);
    while let Some(part) = open.pop() {
        let size = part.size();
        let longest = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        if TriDexel::memory(part, step) <= MOST_BYTES || size[longest] < 8.0 * margin {
            parts.push(part);
            continue;
        }
        let middle = 0.5 * (part.min[longest] + part.max[longest]);
        let (mut low, mut high) = (part, part);
        low.max[longest] = middle + margin;
        high.min[longest] = middle - margin;
        open.extend([high, low]);
    }
    parts
}

/// The effect of one move on two parts of the stock together.
fn either(before: MoveEffect, now: &MoveEffect) -> MoveEffect {
    let edge = match (before.edge(), now.edge()) {
        (Some(a), Some(b)) => {
            let wider = if b.width > a.width { b } else { a };
            Some(Edge { bounds: a.bounds.union(b.bounds), ..wider })
        }
        (a, b) => a.or(b),
    };
    let contacts = [before.shank().or(now.shank()), before.holder().or(now.holder())];
    let mut both = before;
    both.set_contacts(contacts, edge);
    if both.first_contact.is_none() {
        both.first_contact = now.first_contact;
        (both.deepest, both.widest) = (now.deepest, now.widest);
    }
    both
}

/// Boxes that share a point are one: each with its moves.
fn groups(passing: Vec<Passing>) -> Vec<(Aabb, Vec<Passing>)> {
    let mut parts: Vec<(Aabb, Vec<Passing>)> =
        passing.into_iter().map(|one| (one.bounds, vec![one])).collect();
    loop {
        let boxes: Vec<Aabb> = parts.iter().map(|(b, _)| *b).collect();
        let bins = Bins::of(&boxes);
        // Each joins the first that it meets; what grows may meet another one in the next round.
        let joins: Vec<usize> = boxes
            .iter()
            .enumerate()
            .map(|(i, b)| {
                bins.about(*b).into_iter().map(|k| k as usize).find(|k| boxes[*k].meets(*b)).unwrap_or(i)
            })
            .collect();
        if joins.iter().enumerate().all(|(i, k)| i == *k) {
            return parts;
        }
        let mut joined: Vec<Option<(Aabb, Vec<Passing>)>> = vec![None; parts.len()];
        for ((bounds, inside), to) in parts.into_iter().zip(&joins) {
            match &mut joined[*to] {
                Some((all, list)) => {
                    *all = all.union(bounds);
                    list.extend(inside);
                }
                none => *none = Some((bounds, inside)),
            }
        }
        parts = joined.into_iter().flatten().collect();
    }
}

/// The moves of a setup by where they sweep.
struct Swept<'a> {
    list: &'a CutList,
    /// Boxes of [`BLOCK`] moves each; made when the first part is looked at.
    blocks: OnceLock<Vec<Aabb>>,
}

/// Moves that share a box.
const BLOCK: usize = 64;

impl Swept<'_> {
    fn of(list: &CutList) -> Swept<'_> {
        Swept { list, blocks: OnceLock::new() }
    }

    /// The moves of a block.
    fn block(&self, block: usize) -> Range<usize> {
        block * BLOCK..self.list.moves().len().min((block + 1) * BLOCK)
    }

    /// The moves that reach a part of the stock, in order.
    fn reaching(&self, part: Aabb) -> Vec<usize> {
        let blocks = self.blocks.get_or_init(|| {
            let all = 0..self.list.moves().len().div_ceil(BLOCK);
            let swept = |b| self.block(b).map(|i| self.list.swept(i)).fold(Aabb::EMPTY, Aabb::union);
            all.into_par_iter().map(swept).collect()
        });
        let near = blocks.iter().enumerate().filter(|(_, all)| all.meets(part));
        near.flat_map(|(b, _)| self.block(b)).filter(|i| self.list.swept(*i).meets(part)).collect()
    }
}

/// The part of a box within another; `None` when nothing of it is.
fn cut_to(part: Aabb, whole: Aabb) -> Option<Aabb> {
    let part = Aabb { min: part.min.max(whole.min), max: part.max.min(whole.max) };
    (part.size().min_element() > LEAST).then_some(part)
}

/// Cuts a part of the stock anew and tells what some moves meet in it.
fn cut_part(
    story: &Story<'_>,
    moves: &[Vec<usize>],
    part: Aabb,
    step: f64,
    asked: &[Passing],
    progress: &dyn Progress,
) -> Result<Vec<MoveEffect>> {
    let mut stock = TriDexel::part_of_solid(&story.job.stock, part, step)?;
    drill(&mut stock, story.job)?;
    let mut found = vec![MoveEffect::default(); asked.len()];
    let places: BTreeMap<(usize, usize), usize> =
        asked.iter().enumerate().map(|(k, p)| ((p.setup, p.index), k)).collect();
    for (setup, reaching) in moves.iter().enumerate() {
        let segments = &story.traces[setup].segments;
        let mut cores: Vec<&Loose> = story.loose.get(setup).into_iter().flatten().collect();
        cores.sort_by_key(|core| core.item);
        let mut done = 0;
        let mut run = |stock: &mut TriDexel, to: usize| -> Result<()> {
            let indices = &reaching[done..reaching.partition_point(|i| *i < to).max(done)];
            done += indices.len();
            let moves: Vec<CutMove> =
                indices.iter().map(|i| story.moves[setup].moves()[*i].clone()).collect();
            let effects = cut(stock, story.bodies, &moves, &CutOptions::default(), &Quiet(progress))?;
            for (index, effect) in indices.iter().zip(effects) {
                if let Some(k) = places.get(&(setup, *index)) {
                    found[*k] = effect;
                }
            }
            Ok(())
        };
        for core in cores {
            run(&mut stock, segments.partition_point(|s| s.item < core.item))?;
            take_out(&mut stock, core, 0)?;
        }
        run(&mut stock, segments.len())?;
    }
    Ok(found)
}

/// Puts what a closer look has found of a move in place of its edge.
fn merge(effect: &mut MoveEffect, closer: &MoveEffect) {
    let contacts = [effect.shank().or(closer.shank()), effect.holder().or(closer.holder())];
    effect.set_contacts(contacts, closer.edge());
    if effect.first_contact.is_none() {
        effect.first_contact = closer.first_contact;
        (effect.deepest, effect.widest) = (closer.deepest, closer.widest);
    }
}

/// Passes on that a run was cancelled, and says nothing of stages.
pub(super) struct Quiet<'a>(pub(super) &'a dyn Progress);

impl Progress for Quiet<'_> {
    fn stage(&self, _: &str, _: u64) {}

    fn advance(&self, _: u64) {}

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
