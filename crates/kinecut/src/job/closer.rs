//! A closer look at edges of the stock that a tool may clip between the lines of its model.
//!
//! Where an edge is so near that the lines cannot tell, the part of the stock around it is cut once more with lines four
//! times as near, by all moves that reach it, and again four times as near where that does not tell either, until an overlap
//! of [`Missed::UNTOLD`] cannot lie between them. What is met then is met; what is not was none. What would take too many
//! lines stays a doubt.

use std::f64::consts::SQRT_2;

use super::check::Job;
use super::simulate::{Loose, Missed, drill, may_clip, take_out};
use crate::base::{Progress, Result};
use crate::geom::Aabb;
use crate::stock::TriDexel;
use crate::stock::cut::{CutMove, CutOptions, MoveEffect, ToolBody, cut};
use crate::trace::Trace;

/// Lines are brought so much nearer together at a time.
const FINER: f64 = 4.0;

/// Most memory of one part of the stock [bytes], and of all of one job in turn.
const MOST_BYTES: u64 = 64 << 20;
const MOST_BYTES_OF_ALL: u64 = 2 << 30;

/// A part of the stock thinner than this is not worth a look [mm].
const LEAST: f64 = 1e-3;

/// What happens to the stock.
pub(super) struct Story<'a> {
    pub(super) job: &'a Job,
    pub(super) traces: &'a [Trace],
    /// For each setup, the cores that are taken out.
    pub(super) loose: &'a [Vec<Loose>],
    /// For each setup the moves, where they can be cut.
    pub(super) moves: &'a [Vec<Option<CutMove>>],
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
    let swept: Vec<Vec<Aabb>> =
        story.moves.iter().map(|list| list.iter().map(|m| swept(m, story)).collect()).collect();
    let mut left = MOST_BYTES_OF_ALL;
    while !passing.is_empty() && SQRT_2 * step > Missed::UNTOLD {
        step = (step / FINER).max(Missed::UNTOLD / SQRT_2 * 0.999);
        let mut again = Vec::new();
        for (part, inside) in parts(passing) {
            let Some(part) = cut_to(part, story.job.stock.bounds()) else { continue };
            let bytes = TriDexel::memory(part, step);
            if bytes > MOST_BYTES || bytes > left {
                continue;
            }
            left -= bytes;
            let found = cut_part(story, &swept, part, step, &inside, progress)?;
            for (was, now) in inside.iter().zip(found) {
                let effect = &mut effects[was.setup][was.index];
                merge(effect, &now);
                if let Some(edge) = may_clip(effect) {
                    again.push(Passing { bounds: room(edge.bounds, step), ..*was });
                }
            }
        }
        passing = again;
    }
    Ok(())
}

/// The moves that pass an edge.
fn all_passing(effects: &[Vec<MoveEffect>], step: f64) -> Vec<Passing> {
    let mut all = Vec::new();
    for (setup, list) in effects.iter().enumerate() {
        for (index, effect) in list.iter().enumerate() {
            all.extend(may_clip(effect).map(|e| Passing { setup, index, bounds: room(e.bounds, step) }));
        }
    }
    all
}

/// Where an overlap may lie whose edge was seen in a box: and some more, so that walls have a thickness.
fn room(seen: Aabb, step: f64) -> Aabb {
    seen.grown(2.5 * step)
}

/// Boxes that share a point are one: each with its moves.
fn parts(passing: Vec<Passing>) -> Vec<(Aabb, Vec<Passing>)> {
    let mut parts: Vec<(Aabb, Vec<Passing>)> = Vec::new();
    for one in passing {
        let (mut bounds, mut inside) = (one.bounds, vec![one]);
        // What grows may meet another one.
        while let Some(i) = parts.iter().position(|(b, _)| b.meets(bounds)) {
            let (other, mut more) = parts.swap_remove(i);
            bounds = bounds.union(other);
            more.append(&mut inside);
            inside = more;
        }
        parts.push((bounds, inside));
    }
    parts
}

/// The part of a box within another; `None` when nothing of it is.
fn cut_to(part: Aabb, whole: Aabb) -> Option<Aabb> {
    let part = Aabb { min: part.min.max(whole.min), max: part.max.min(whole.max) };
    (part.size().min_element() > LEAST).then_some(part)
}

/// A box that holds all that a move sweeps; empty when it is not cut.
fn swept(one: &Option<CutMove>, story: &Story<'_>) -> Aabb {
    let Some(one) = one else { return Aabb::EMPTY };
    let body = &story.bodies[one.body as usize];
    let stacked = body.shank.iter().chain(&body.holder).map(|(profile, z)| (profile, *z));
    let (mut radius, mut low, mut high) = (0.0f64, 0.0f64, 0.0f64);
    for (profile, z) in stacked.chain([(&body.cutting, 0.0)]) {
        radius = radius.max(profile.max_radius());
        (low, high) = (low.min(z + profile.bottom()), high.max(z + profile.top()));
    }
    let path = one.curve.bounds();
    let along = |z: f64| {
        let by = one.axis.vector() * z;
        Aabb { min: path.min + by, max: path.max + by }
    };
    along(low).union(along(high)).grown(radius)
}

/// Cuts a part of the stock anew and tells what some moves meet in it.
fn cut_part(
    story: &Story<'_>,
    swept: &[Vec<Aabb>],
    part: Aabb,
    step: f64,
    asked: &[Passing],
    progress: &dyn Progress,
) -> Result<Vec<MoveEffect>> {
    let mut stock = TriDexel::part_of_solid(&story.job.stock, part, step)?;
    drill(&mut stock, story.job)?;
    let mut found = vec![MoveEffect::default(); asked.len()];
    let last = asked.iter().map(|p| p.setup).max().unwrap_or(0);
    for setup in 0..=last {
        let segments = &story.traces[setup].segments;
        let mut cores: Vec<&Loose> = story.loose.get(setup).into_iter().flatten().collect();
        cores.sort_by_key(|core| core.item);
        let mut done = 0;
        let mut run = |stock: &mut TriDexel, range: std::ops::Range<usize>| -> Result<()> {
            let reach = |i: &usize| swept[setup][*i].meets(part);
            let indices: Vec<usize> = range.filter(reach).collect();
            let moves: Vec<CutMove> = indices.iter().filter_map(|i| story.moves[setup][*i].clone()).collect();
            let quiet = Quiet(progress);
            let effects = cut(stock, story.bodies, &moves, &CutOptions::default(), &quiet)?;
            for (index, effect) in indices.into_iter().zip(effects) {
                for (k, _) in asked.iter().enumerate().filter(|(_, p)| (p.setup, p.index) == (setup, index)) {
                    found[k] = effect;
                }
            }
            Ok(())
        };
        for core in cores {
            let to = segments.partition_point(|s| s.item < core.item).max(done);
            run(&mut stock, done..to)?;
            take_out(&mut stock, core, 0)?;
            done = to;
        }
        run(&mut stock, done..segments.len())?;
    }
    Ok(found)
}

/// Puts what a closer look has found of a move in place of its edge.
fn merge(effect: &mut MoveEffect, closer: &MoveEffect) {
    effect.edge = closer.edge;
    effect.shank = effect.shank.or(closer.shank);
    effect.holder = effect.holder.or(closer.holder);
    if effect.first_contact.is_none() {
        effect.first_contact = closer.first_contact;
        (effect.deepest, effect.widest) = (closer.deepest, closer.widest);
    }
}

/// Passes on that a run was cancelled, and says nothing of stages.
struct Quiet<'a>(&'a dyn Progress);

impl Progress for Quiet<'_> {
    fn stage(&self, _: &str, _: u64) {}

    fn advance(&self, _: u64) {}

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
