//! More slices where strips between neighbours leave the envelope.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;
use rayon::prelude::*;

use super::face::EnvelopeFace;
use super::slice::{Fineness, Slice};
use super::stray::strays;
use super::{stopped, too_fine};
use crate::base::{Progress, Result};
use crate::machine::kinematics::Twist;
use crate::sweep::{Motion, MotionJet, ProfileChain, ToolMotion};

pub(super) struct Refine<'a> {
    pub chain: &'a ProfileChain,
    pub motion: &'a ToolMotion,
    /// Distance of the tool's points from the tip [mm].
    pub reach: f64,
    /// Largest distance of strips from the envelope [mm].
    pub strip: f64,
    pub fineness: Fineness,
    pub faces: Vec<EnvelopeFace>,
}

/// Way of the tool's points between two slices, by the tolerance of strips, that is not cut whatever lies between: only
/// where curves jump, and the strip then lies on the tool.
const LEAST: f64 = 0.25;
/// Time between a moment at which a whole face or circle grazes and the moment taken instead.
const BESIDE: f64 = 1e-7;
/// Shortest step of time: below it neighbours cannot be told apart.
const SHORTEST: f64 = 1e-9;

impl Refine<'_> {
    /// The curves at a moment. If a face or circle grazes as a whole only at this moment, they are those of the next
    /// moment or the one before: so no half of a circle is taken for one that neither neighbour has.
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

    /// Adds curves at a reversal: if the tool, without turning, goes back the way it came while it moves along its
    /// axis, all of its flank grazes at one moment; the curves in between are as if it went round a narrow bend.
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
        if turns || plain || !self.is_least(a, b) {
            return Vec::new();
        }
        let turn = from.angle_to(to);
        let widest =
            self.chain.pieces().iter().map(|p| p.point(p.from).x.max(p.point(p.to).x)).fold(0.0, f64::max);
        let step = (8.0 * self.fineness.chord / widest).sqrt().min(FRAC_PI_2);
        let count = (PI / step).ceil() as u32;
        let of = |k: u32| {
            let part = f64::from(k) / f64::from(count);
            let size = from.length() + (to.length() - from.length()) * part;
            let bend = DVec2::from_angle(turn * part).rotate(from) * (size / from.length());
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
        // Steps that were not looked at yet.
        let mut open = vec![true; slices.len().saturating_sub(1)];
        loop {
            let added: Vec<Option<Slice>> = slices
                .par_windows(2)
                .zip(&open)
                .map(|(pair, &open)| {
                    let (a, b) = (&pair[0], &pair[1]);
                    let step = 0.5 * (b.t - a.t);
                    let cut = open && !progress.cancelled() && self.is_long(a, b);
                    cut.then(|| self.slice(a.t + step, Fineness { step, ..self.fineness }))
                })
                .collect();
            stopped(progress)?;
            let count = slices.len() + added.iter().flatten().count();
            if count == slices.len() {
                self.turn_over(slices);
                return Ok(());
            }
            if count > most {
                return Err(too_fine(count as f64, most as f64));
            }
            let nodes: usize = slices.iter().map(|s| s.nodes.len()).sum();
            if 2 * nodes > most_nodes {
                return Err(too_fine(2.0 * nodes as f64, most_nodes as f64));
            }
            let old = std::mem::replace(slices, Vec::with_capacity(count));
            open.clear();
            let mut added = added.into_iter();
            for slice in old {
                slices.push(slice);
                let Some(added) = added.next() else { break };
                let halves = if added.is_some() { 2 } else { 1 };
                open.extend(std::iter::repeat_n(added.is_some(), halves));
                slices.extend(added);
            }
        }
    }

    /// True if the step between two neighbours is too long.
    fn is_long(&self, a: &Slice, b: &Slice) -> bool {
        !self.is_least(a, b) && strays(&self.faces, self.motion, self.strip, (a, b))
    }

    /// True if the tool hardly moves between two slices.
    fn is_least(&self, a: &Slice, b: &Slice) -> bool {
        let step = b.t - a.t;
        step <= SHORTEST || step * self.motion.speed(a.t, self.reach) <= LEAST * self.strip
    }
}
