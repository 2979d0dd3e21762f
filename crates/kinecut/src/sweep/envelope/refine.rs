//! More slices where strips between neighbours leave the envelope, or curves change between them.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::slice::{Fineness, Slice};
use super::{too_fine, wall};
use crate::base::{Code, Finding, Progress, Result};
use crate::machine::kinematics::Twist;
use crate::sweep::{Motion, MotionJet, ProfileChain, ToolMotion};

pub(super) struct Refine<'a> {
    pub chain: &'a ProfileChain,
    pub motion: &'a ToolMotion,
    /// Distance of the tool's points from the tip [mm].
    pub reach: f64,
    /// How far strips may leave the envelope [mm].
    pub strip: f64,
    pub fineness: Fineness,
}

/// Every how many nodes a strip is tried.
const EVERY: usize = 3;
/// By what part of the strips' tolerance the tool moves between two slices at most, where curves change between them.
const EVENT: f64 = 0.25;
/// Time by which a moment lies beside one at which a whole face or circle grazes.
const BESIDE: f64 = 1e-7;
/// Shortest step of time: below it neighbours cannot be told apart.
const SHORTEST: f64 = 1e-9;

impl Refine<'_> {
    /// The curves at a moment. Where a face or circle grazes as a whole only at this moment, they are those of the moment beside:
    /// so no half of a circle is taken for one that neither neighbour has.
    pub(super) fn slice(&self, t: f64, fineness: Fineness) -> Slice {
        let mut jet = self.motion.at(t);
        if self.is_degenerate(&jet) {
            let inside = if t + BESIDE <= 1.0 && t < 0.5 { t + BESIDE } else { t - BESIDE };
            let beside = self.motion.at(inside);
            if !self.is_degenerate(&beside) {
                jet.twist = beside.twist;
            }
        }
        Slice::new(self.chain, t, jet, fineness)
    }

    fn is_degenerate(&self, jet: &MotionJet) -> bool {
        let grazing = self.chain.grazing(&jet.twist);
        matches!(grazing.motion, Motion::Plunge | Motion::Still | Motion::Spin) || grazing.is_degenerate()
    }

    /// Where the tool, without turning, goes back the way it came while it moves along its axis, all of its flank grazes at one
    /// moment: curves in between, as if it went round a narrow bend.
    fn turn_over(&self, slices: &mut Vec<Slice>) {
        let old = std::mem::take(slices);
        for slice in old {
            if let Some(last) = slices.last() {
                slices.extend(self.bend(last, &slice));
            }
            slices.push(slice);
        }
    }

    fn bend(&self, a: &Slice, b: &Slice) -> Vec<Slice> {
        let [x, y] = [a, b].map(|s| s.jet.twist);
        let [from, to] = [x, y].map(|twist| twist.shift.truncate());
        let turns = [x, y].iter().any(|twist| twist.turn.truncate() != DVec2::ZERO);
        let plain = from.dot(to) >= 0.0 || from == DVec2::ZERO || to == DVec2::ZERO;
        if b.t - a.t > 2.0 * SHORTEST || turns || plain {
            return Vec::new();
        }
        let side = 0.5 * (to - from).perp();
        let widest =
            self.chain.pieces().iter().map(|p| p.point(p.from).x.max(p.point(p.to).x)).fold(0.0, f64::max);
        let step = (8.0 * self.fineness.chord / widest).sqrt().min(FRAC_PI_2);
        let count = (PI / step).ceil() as u32;
        let of = |k: u32| {
            let part = f64::from(k) / f64::from(count);
            let bend = from.lerp(to, 0.5 - 0.5 * (PI * part).cos()) + side * (PI * part).sin();
            let shift = bend.extend(x.shift.z + (y.shift.z - x.shift.z) * part);
            let jet = MotionJet { twist: Twist { turn: x.turn, shift }, ..a.jet };
            Slice::new(self.chain, a.t, jet, Fineness { step: 0.0, ..self.fineness })
        };
        (1..count).map(of).collect()
    }

    /// Adds slices until nothing is left to add.
    pub(super) fn run(
        &self,
        slices: &mut Vec<Slice>,
        most: usize,
        most_nodes: usize,
        progress: &dyn Progress,
    ) -> Result<()> {
        // Which slices are new since the last look.
        let mut new = vec![true; slices.len()];
        loop {
            if progress.cancelled() {
                return Err(Finding::error(Code::CANCELLED, "the work was cancelled").into());
            }
            let cut = self.steps_to_cut(slices, &new);
            let moments: Vec<(usize, f64)> = (0..cut.len())
                .filter(|&i| cut[i])
                .map(|i| (i, 0.5 * (slices[i].t + slices[i + 1].t)))
                .collect();
            if moments.is_empty() {
                self.turn_over(slices);
                return Ok(());
            }
            if slices.len() + moments.len() > most {
                return Err(too_fine((slices.len() + moments.len()) as f64, most as f64));
            }
            let nodes: usize = slices.iter().map(|s| s.nodes.len()).sum();
            if 2 * nodes > most_nodes {
                return Err(too_fine(2.0 * nodes as f64, most_nodes as f64));
            }
            let added: Vec<(usize, Slice)> = moments
                .into_par_iter()
                .map(|(i, t)| {
                    let step = t - slices[i].t;
                    (i, self.slice(t, Fineness { step, ..self.fineness }))
                })
                .collect();
            let old = std::mem::take(slices);
            new.clear();
            let mut added = added.into_iter().peekable();
            for (i, slice) in old.into_iter().enumerate() {
                slices.push(slice);
                new.push(false);
                if let Some((_, slice)) = added.next_if(|(after, _)| *after == i) {
                    slices.push(slice);
                    new.push(true);
                }
            }
        }
    }

    /// Which steps between neighbours are too long.
    fn steps_to_cut(&self, slices: &[Slice], new: &[bool]) -> Vec<bool> {
        let mut cut: Vec<bool> = (0..slices.len().saturating_sub(1))
            .into_par_iter()
            .map(|i| {
                let (a, b) = (&slices[i], &slices[i + 1]);
                let step = b.t - a.t;
                (new[i] || new[i + 1])
                    && step > SHORTEST
                    && wall::kin(a, b).iter().any(|k| !k.is_plain())
                    && step * self.motion.speed(a.t, self.reach) > EVENT * self.strip
            })
            .collect();
        let bent: Vec<bool> = (1..slices.len().saturating_sub(1))
            .into_par_iter()
            .map(|i| {
                let three = &slices[i - 1..=i + 1];
                new[i - 1..=i + 1].contains(&true)
                    && three[2].t - three[0].t > SHORTEST
                    && self.leaves([&three[0], &three[1], &three[2]])
            })
            .collect();
        for (i, bent) in bent.into_iter().enumerate() {
            // The middle one is i + 1: the longer step is cut, or both.
            if bent {
                let steps = [slices[i + 1].t - slices[i].t, slices[i + 2].t - slices[i + 1].t];
                cut[i] |= steps[0] > 0.75 * steps[1];
                cut[i + 1] |= steps[1] > 0.75 * steps[0];
            }
        }
        cut
    }

    /// Whether a strip leaves the envelope too far: by what the middle of three curves leaves the line between its neighbours.
    fn leaves(&self, [a, m, b]: [&Slice; 3]) -> bool {
        let part = (m.t - a.t) / (b.t - a.t);
        // A strip from neighbour to neighbour is longer than each of the two, by which squared the distance falls.
        let share = part.max(1.0 - part);
        let most = self.strip / (share * share);
        let off = |p: DVec3, normal: DVec3, from: DVec3, to: DVec3| {
            normal.dot(p - from.lerp(to, part)).abs() > most
        };
        m.nodes.iter().enumerate().filter(|(i, _)| i % EVERY == 0).any(|(_, node)| {
            let at = [m, a, b].map(|s| s.points_at(self.chain, m, node));
            let [Some(m), Some(a), Some(b)] = at else { return false };
            (0..2).any(|k| off(m[k][0], m[k][1], a[k][0], b[k][0]))
        })
    }
}
