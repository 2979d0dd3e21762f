//! The ends of lines, each looked for at the tool that is said to have cut it.

use glam::DVec3;
use rayon::prelude::*;

use super::moment::Moment;
use super::pair::is_wide;
use super::{CertifiedRun, GAP, Task, still_wanted};
use crate::base::{Progress, Result};
use crate::stock::tri_dexel::LINE_OFFSET;
use crate::stock::{Axis, CutId, DexelGrid, TriDexel, unfixed};

/// Time below which a stretch of a move is no longer divided.
const SHORTEST: f64 = 1e-12;

/// Error of the distance of an end that has strayed [mm].
const FINE: f64 = 1e-6;

/// Ends that were looked for.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ends {
    pub(super) ends: usize,
    pub(super) strayed: usize,
    pub(super) farthest: f64,
    pub(super) boxes: u64,
}

impl Ends {
    fn and(self, other: Ends) -> Ends {
        Ends {
            ends: self.ends + other.ends,
            strayed: self.strayed + other.strayed,
            farthest: self.farthest.max(other.farthest),
            boxes: self.boxes + other.boxes,
        }
    }
}

/// Looks for all ends that the moves of runs have left.
///
/// # Errors
/// `KC0009` when cancelled.
pub(super) fn check(
    stock: &TriDexel,
    tasks: &[Task],
    runs: &[CertifiedRun<'_>],
    progress: &dyn Progress,
) -> Result<Ends> {
    // By cut: the index of its task behind it.
    let last = runs.iter().map(|run| run.first_cut as usize + run.moves.len()).max().unwrap_or(0);
    let mut task_of = vec![None; last + 1];
    for task in tasks {
        task_of[task.cut as usize] = Some(task);
    }
    let lattice = *stock.lattice();
    let mut all = Ends::default();
    for axis in Axis::ALL {
        let (u, v) = axis.others();
        let row = |b: u32| {
            let mut sums = Ends::default();
            if progress.cancelled() {
                return sums;
            }
            let mut p = DVec3::ZERO;
            p[v.index()] = lattice.coordinate(v, b) + LINE_OFFSET;
            for a in 0..lattice.counts[u.index()] {
                p[u.index()] = lattice.coordinate(u, a) + LINE_OFFSET;
                for end in stock.line(axis, a, b).iter().flat_map(|i| [i.lo, i.hi]) {
                    p[axis.index()] = unfixed(end.at);
                    sums.look(&task_of, end.cut, p);
                }
            }
            sums
        };
        let rows = (0..lattice.counts[v.index()]).into_par_iter().map(row);
        all = all.and(rows.reduce(Ends::default, Ends::and));
        still_wanted(progress)?;
        progress.advance((tasks.len() / 3) as u64);
    }
    Ok(all)
}

impl Ends {
    /// Looks for an end at the tool of a cut.
    fn look(&mut self, task_of: &[Option<&Task>], cut: CutId, p: DVec3) {
        let Some(task) = task_of.get(cut as usize).copied().flatten() else { return };
        self.ends += 1;
        if self.distance(task, p, Some(GAP)) > GAP {
            self.strayed += 1;
            self.farthest = self.farthest.max(self.distance(task, p, None));
        }
    }

    /// Least gauge of the tool at a point, of all moments, to within [`FINE`]. Where it is only asked whether it is `enough`, any
    /// gauge up to that or beyond it.
    fn distance(&mut self, task: &Task, p: DVec3, enough: Option<f64>) -> f64 {
        let mut best = f64::INFINITY;
        let mut open = vec![[0.0, 1.0]];
        while let Some([from, to]) = open.pop() {
            let moment = Moment::of(&task.motion, [from, to], task.tool.reach);
            let seen = moment.see(p);
            self.boxes += 1;
            let gauge = task.tool.at(seen.x);
            best = best.min(gauge.value);
            if enough.is_some_and(|enough| best <= enough) {
                return best;
            }
            let far = seen.x.length() > task.tool.reach + moment.travel + best;
            let rate = gauge.normal.dot(seen.way);
            if far || to - from < SHORTEST {
                continue;
            }
            if !is_wide(task.tool, &moment, 0.0) {
                let least = |part: &super::gauge::GaugePart| {
                    let gauge = part.at(seen.x);
                    gauge.value - gauge.normal.dot(seen.way).abs() - moment.stray
                };
                if task.tool.parts.iter().all(|part| least(part) >= enough.unwrap_or(best - FINE)) {
                    continue;
                }
            }
            // The half towards which the gauge falls comes first.
            let halves = [[from, moment.t], [moment.t, to]];
            open.extend(if rate < 0.0 { halves } else { [halves[1], halves[0]] });
        }
        best
    }
}
