//! The cut stock proven against the moves that cut it, by branch and bound that shares nothing with the cutting but the moves
//! themselves.
//!
//! **No stock too many.** For all material that is left, on all lines, and for all moments of all moves: no tool, its faces moved
//! inwards by [`GAP`], reaches into it. A stretch of a line and a stretch of a move are one box; where the gauge of the tool
//! (`gauge.rs`) at its middle, less what it can change within the box, is not above zero, the box is divided (`pair.rs`). The
//! change is bounded by the tangent plane at the middle, and what the motion can stray from it (`moment.rs`). Material in which a
//! tool is found is taken out.
//!
//! **No stock too few.** Each end that a move has left lies no more than [`GAP`] outside of its tool at some moment (`ends.rs`).
//! The stretch between two such ends is not gone through.
//!
//! The boxes start as bricks of 16 x 16 x 16 lattice points and whole moves (`bricks.rs`).

mod bricks;
mod ends;
mod gauge;
mod moment;
mod pair;
#[cfg(test)]
mod tests;

use rayon::prelude::*;

use self::bricks::{Bricks, Found};
use self::gauge::Gauges;
use self::pair::Checked;
use super::cut::{CutMove, Stance, ToolBody};
use super::{CutId, EndPoint, PackedNormal, TriDexel};
use crate::base::{Code, Finding, Progress, Result};
use crate::sweep::ToolMotion;

/// Depth in a tool down to which material must be gone, and distance from it up to which an end counts as its own [mm].
pub const GAP: f64 = 1e-3;

/// Depth of a point in a tool of several convex parts over the greatest of its depths in them, at most.
const PARTED: f64 = std::f64::consts::SQRT_2;

/// Pairs of brick and move that are kept at once.
const PAIRS: usize = 8_000_000;

/// Moves of a stage of the progress.
const CHUNK: usize = 256;

/// A run of moves and the number of the cut before its first.
#[derive(Clone, Copy, Debug)]
pub struct CertifiedRun<'a> {
    /// The first move is the cut `first_cut + 1`.
    pub first_cut: CutId,
    /// The moves.
    pub moves: &'a [CutMove],
}

/// A proof about a cut stock.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certificate {
    /// Moves that were gone through.
    pub moves: usize,
    /// Moves of tools that leave a core, which were not.
    pub left_out: usize,
    /// Moves along spirals and cubics: the bound on their curvature rests on samples, so that for them the proof is not strict.
    pub sampled: usize,
    /// No material lies deeper than this in a tool [mm].
    pub gap: f64,
    /// Stretches of lines that were left although a tool reaches into them, and are taken out.
    pub taken: usize,
    /// Depth of the deepest of them in a tool, at least [mm].
    pub deepest: f64,
    /// Ends that moves have left, each looked for at its tool.
    pub ends: usize,
    /// Ends that lie farther than [`GAP`] outside of their tool at all moments.
    pub strayed: usize,
    /// The farthest of them [mm].
    pub farthest: f64,
    /// Boxes that were bounded.
    pub boxes: u64,
}

/// A move that is gone through.
struct Task<'a> {
    motion: ToolMotion,
    tool: &'a Gauges,
    cut: CutId,
}

/// Proves a cut stock against the moves that cut it, in any order; what is found to be left in a tool is taken out.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use glam::DVec3;
/// use kinecut::base::Silent;
/// use kinecut::geom::{Aabb, Line, Profile};
/// use kinecut::stock::TriDexel;
/// use kinecut::stock::certify::{CertifiedRun, certify};
/// use kinecut::stock::cut::{CutAxis, CutMove, CutOptions, ToolBody, cut};
/// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
/// let mut stock = TriDexel::from_box(plate, 0.5).unwrap();
/// let tools = [ToolBody::new(Profile::bull_nose(8.0, 4.0, 30.0).unwrap())];
/// let line = Line { start: DVec3::new(-5.0, 10.0, -3.0), end: DVec3::new(45.0, 10.0, -3.0) };
/// let moves = [CutMove::new(line, CutAxis::PlusZ, 0)];
/// let run = [CertifiedRun { first_cut: 0, moves: &moves }];
/// // Before it is cut the move has 3 mm of stock in its way.
/// let before = certify(&mut stock.clone(), &tools, &run, &Silent).unwrap();
/// assert!(before.taken > 0 && before.deepest > 1.0);
/// cut(&mut stock, &tools, &moves, &CutOptions::default(), &Silent).unwrap();
/// let after = certify(&mut stock, &tools, &run, &Silent).unwrap();
/// assert_eq!((after.moves, after.taken, after.strayed), (1, 0, 0));
/// assert!(after.gap <= 1.5e-3 && after.ends > 1000);
/// ```
///
/// # Errors
/// `KC1203` for a move that is no motion, `KC0009` when cancelled.
pub fn certify(
    stock: &mut TriDexel,
    bodies: &[ToolBody],
    runs: &[CertifiedRun<'_>],
    progress: &dyn Progress,
) -> Result<Certificate> {
    let gauges: Vec<Gauges> = bodies.iter().map(|body| Gauges::of(&body.cutting)).collect();
    let (tasks, left_out) = tasks(bodies, &gauges, runs)?;
    let parted = gauges.iter().any(Gauges::is_parted);
    let mut all = Checked::default();
    stock.settle(progress);
    let bricks = Bricks::new(stock);
    progress.stage("certify", 2 * tasks.len() as u64);
    let mut next = 0;
    while next < tasks.len() {
        let from = next;
        let mut pairs = Vec::new();
        while next < tasks.len() && pairs.len() < PAIRS {
            let end = (next + CHUNK).min(tasks.len());
            let near = |i: usize| bricks.near(i as u32, &tasks[i]);
            let some: Vec<_> = (next..end).into_par_iter().flat_map_iter(near).collect();
            pairs.extend(some);
            next = end;
            still_wanted(progress)?;
        }
        pairs.par_sort_unstable();
        let groups: Vec<_> = pairs.chunk_by(|a, b| a.brick == b.brick).collect();
        let found: Vec<Found> =
            groups.par_iter().map(|pairs| bricks.check(stock, &tasks, pairs, progress)).collect();
        still_wanted(progress)?;
        for one in found {
            all.add(&one.checked);
            for stretch in one.stretches {
                let cut = tasks[stretch.task as usize].cut;
                let end = |k: usize| {
                    let normal = PackedNormal::new(stretch.normals[k], stretch.faces[k]);
                    EndPoint { at: stretch.ends[k], normal, cut }
                };
                stock.take_from_line(stretch.axis, stretch.line, end(0), end(1));
            }
        }
        progress.advance((next - from) as u64);
    }
    let ends = ends::check(stock, &tasks, runs, progress)?;
    Ok(Certificate {
        moves: tasks.len(),
        left_out,
        sampled: tasks.iter().filter(|task| task.motion.is_sampled()).count(),
        gap: all.gap.max(GAP) * if parted { PARTED } else { 1.0 },
        taken: all.taken,
        deepest: all.deepest,
        ends: ends.ends,
        strayed: ends.strayed,
        farthest: ends.farthest,
        boxes: all.boxes + ends.boxes,
    })
}

/// The moves that remove what they meet, and the number of those that are left out.
fn tasks<'a>(
    bodies: &[ToolBody],
    gauges: &'a [Gauges],
    runs: &[CertifiedRun<'_>],
) -> Result<(Vec<Task<'a>>, usize)> {
    let (mut tasks, mut left_out) = (Vec::new(), 0);
    for run in runs {
        for (i, one) in run.moves.iter().enumerate().filter(|(_, one)| one.removes) {
            if bodies[one.body as usize].edge.is_some() {
                left_out += 1;
                continue;
            }
            let motion = match &one.stance {
                Stance::Along(axis) => ToolMotion::fixed(one.curve.clone(), axis.vector())?,
                Stance::Leaning(motion) => (**motion).clone(),
            };
            tasks.push(Task { motion, tool: &gauges[one.body as usize], cut: run.first_cut + i as u32 + 1 });
        }
    }
    Ok((tasks, left_out))
}

fn still_wanted(progress: &dyn Progress) -> Result<()> {
    match progress.cancelled() {
        true => Err(Finding::error(Code::CANCELLED, "the stock was not proven to the end").into()),
        false => Ok(()),
    }
}
