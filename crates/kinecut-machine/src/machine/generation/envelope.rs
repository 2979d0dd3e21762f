//! Surfaces that a moving tool touches: residual at given points.
//!
//! A point of the wanted surface keeps `min over u of distance(tool, M(u)^-1 p)`: positive is stock that stays, negative a
//! gouge, zero a surface that is touched. `M` maps the tool's frame into the work's. No algebra of envelopes is
//! needed; the contact equation `n . V = 0` (normal of the tool, velocity of its point relative to the work) must then
//! hold at the minimum, and is computed apart from it, from the twist of the motion by differences.

use glam::DVec3;
use rayon::prelude::*;

use super::Distance;
use crate::base::{Code, Finding, Progress, Result};
use crate::geom::Rigid;
use crate::num::minimum::minimum_over;

/// A motion of the tool's frame relative to the work, over one or two variables.
pub trait FrameMotion: Sync {
    /// Maps the tool's frame into the work's at these values.
    fn pose(&self, u: [f64; 2]) -> Rigid;
}

impl<F: Fn([f64; 2]) -> Rigid + Sync> FrameMotion for F {
    fn pose(&self, u: [f64; 2]) -> Rigid {
        self(u)
    }
}

/// A tool that moves: the envelope of its surface, and all that it cuts.
#[derive(Clone, Copy, Debug)]
pub struct ToolEnvelope<'a, T: ?Sized, M: ?Sized> {
    /// Tool, in its own frame.
    pub tool: &'a T,
    /// Motion.
    pub motion: &'a M,
    /// Ranges of the variables; a motion of one variable has a second range of no length.
    pub domain: [[f64; 2]; 2],
    /// Cells of the grid in which the minima are looked for: every valley must be wider than one.
    pub cells: [usize; 2],
}

/// Stock left at a point, or the gouge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Left {
    /// Distance from the tool at its nearest [mm]: positive uncut, negative gouged.
    pub residual: f64,
    /// Values of the variables at which the tool is nearest.
    pub at: [f64; 2],
    /// True if the nearest pose is at an end of the motion: then no contact equation holds.
    pub at_end: bool,
}

/// Stock left and gouges over a set of points.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOver {
    /// Each point, in their order.
    pub points: Vec<Left>,
    /// The least residual [mm] and the number of its point.
    pub least: (f64, usize),
    /// The greatest residual [mm] and the number of its point.
    pub greatest: (f64, usize),
    /// Root of the mean square [mm].
    pub rms: f64,
}

impl<T: Distance + ?Sized, M: FrameMotion + ?Sized> ToolEnvelope<'_, T, M> {
    /// Stock left, or the gouge, at a point of the work [mm].
    pub fn left(&self, p: DVec3) -> Left {
        let distance = |u: [f64; 2]| self.tool.signed(self.motion.pose(u).inverse().point(p));
        let (at, residual) = minimum_over(distance, self.domain, self.cells);
        let on_end = |k: usize| {
            let [from, to] = self.domain[k];
            let margin = END * (to - from);
            to > from && (at[k] <= from + margin || at[k] >= to - margin)
        };
        Left { residual, at, at_end: on_end(0) || on_end(1) }
    }

    /// Stock left and gouges at many points of the work [mm].
    ///
    /// # Errors
    /// `KC1131` without points or with one that is not finite; `KC0009` when cancelled.
    pub fn left_over(&self, points: &[DVec3], progress: &dyn Progress) -> Result<LeftOver> {
        if points.is_empty() || points.iter().any(|p| !p.is_finite()) {
            return Err(Finding::error(
                Code::GENERATION_INPUT,
                "no points to compare, or one that is not finite",
            )
            .value(points.len() as f64, "points")
            .bound(1.0, "points")
            .help("sample the wanted surface")
            .into());
        }
        let left: Vec<Option<Left>> =
            points.par_iter().map(|&p| (!progress.cancelled()).then(|| self.left(p))).collect();
        let Some(points) = left.into_iter().collect::<Option<Vec<Left>>>() else {
            return Err(Finding::error(Code::CANCELLED, "the comparison was cancelled").into());
        };
        let (mut least, mut greatest, mut sum) = ((f64::INFINITY, 0), (f64::NEG_INFINITY, 0), 0.0);
        for (i, left) in points.iter().enumerate() {
            if left.residual < least.0 {
                least = (left.residual, i);
            }
            if left.residual > greatest.0 {
                greatest = (left.residual, i);
            }
            sum += left.residual * left.residual;
        }
        let rms = (sum / points.len() as f64).sqrt();
        Ok(LeftOver { points, least, greatest, rms })
    }

    /// The contact equation `n . V` [mm per unit] of a point of the work at values of the variables, for both variables:
    /// zero where the tool touches the envelope there.
    pub fn contact(&self, p: DVec3, at: [f64; 2]) -> [f64; 2] {
        let pose = self.motion.pose(at);
        let q = pose.inverse().point(p);
        let normal = pose.vector(self.tool.gradient(q));
        [0, 1].map(|k| {
            let [from, to] = self.domain[k];
            if !(to > from) {
                return 0.0;
            }
            normal.dot(velocity(self.motion, at, k, (to - from) * STEP, q))
        })
    }
}

/// Velocity of the tool's point `q` relative to the work by variable `k`, by a difference of the fourth order.
pub(super) fn velocity<M: FrameMotion + ?Sized>(
    motion: &M,
    at: [f64; 2],
    k: usize,
    h: f64,
    q: DVec3,
) -> DVec3 {
    let f = |s: f64| {
        let mut u = at;
        u[k] += s * h;
        motion.pose(u).point(q)
    };
    ((f(1.0) - f(-1.0)) * 8.0 - (f(2.0) - f(-2.0))) / (12.0 * h)
}

/// Share of a range at its ends that counts as the end: above the resolution of the minima.
const END: f64 = 1e-8;
/// Step of differences as a share of the range: the fifth root of the rounding unit, for the fourth order.
const STEP: f64 = 5e-4;
