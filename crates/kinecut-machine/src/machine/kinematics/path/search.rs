//! Dynamic programming over the poses of a path.
//!
//! Only the layers at every `sqrt(n)`th pose are kept; those between are computed again on the way back. Memory grows with
//! the square root of the number of poses.

use std::f64::consts::{PI, TAU};

use super::super::Kinematics;
use super::super::inverse::{Solution, Solutions};
use super::candidates::{Rotaries, push, translations_inside};
use super::{JointPath, PathOptions, Retract, RetractKind, StepCost, ToolPose, at_pose, outside_travel};
use crate::base::{Code, Finding, Progress, Result};
use crate::machine::{JointValues, MOST_JOINTS};
use crate::num::angle::wrap;

/// Costs this near to each other are equal: rounding of sums over long paths. The candidate nearer to zero then wins.
const TIE: f64 = 1e-9;

/// The best way to a candidate.
#[derive(Clone, Copy)]
struct State {
    values: [f64; 2],
    cost: f64,
    /// Place of its predecessor in the layer before.
    from: usize,
}

/// All states of a pose.
type Layer = Vec<State>;

pub(super) struct Search<'a> {
    chain: &'a Kinematics,
    poses: &'a [ToolPose],
    options: &'a PathOptions,
    /// Solutions of the poses; open axes at the start.
    found: &'a [Solutions],
    progress: &'a dyn Progress,
    rotaries: Rotaries,
    rotary: [bool; MOST_JOINTS],
}

impl<'a> Search<'a> {
    pub(super) fn new(
        chain: &'a Kinematics,
        poses: &'a [ToolPose],
        options: &'a PathOptions,
        found: &'a [Solutions],
        progress: &'a dyn Progress,
    ) -> Search<'a> {
        let mut rotary = [false; MOST_JOINTS];
        for (slot, screw) in rotary.iter_mut().zip(&chain.screws[..chain.count]) {
            *slot = screw.rotary;
        }
        let rotaries = Rotaries::new((0..chain.count).filter(|&i| rotary[i] && !options.locked[i]));
        Search { chain, poses, options, found, progress, rotaries, rotary }
    }

    fn travel(&self, k: usize) -> Option<[f64; 2]> {
        self.rotaries.joints().get(k).and_then(|&joint| self.options.travels.0[joint])
    }

    /// True if an axis has limits that are a turn or more apart.
    pub(super) fn has_wide_travel(&self) -> bool {
        (0..2).any(|k| self.travel(k).is_some_and(|[least, most]| most - least >= TAU))
    }

    /// True if all rotary positions lie inside their travel.
    pub(super) fn inside(&self, values: &[JointValues]) -> bool {
        let joints = self.rotaries.joints();
        values.iter().all(|q| joints.iter().all(|&j| self.options.travels.beyond(j, q[j]) == 0.0))
    }

    /// The best path; with `relaxed`, travel of a turn or more counts as endless.
    pub(super) fn run(&self, relaxed: bool) -> Result<JointPath> {
        let endless = [0, 1].map(|k| match self.travel(k) {
            None => true,
            Some([least, most]) => relaxed && most - least >= TAU,
        });
        let count = self.poses.len();
        let spacing = (count as f64).sqrt().ceil() as usize;
        let mut kept: Vec<Layer> = Vec::with_capacity(count / spacing + 1);
        let mut layer = self.first_layer(endless)?;
        self.progress.stage("joint path", count as u64);
        for index in 0..count {
            if index > 0 {
                layer = self.next_layer(&layer, index, endless)?;
            }
            if index % spacing == 0 {
                kept.push(layer.clone());
                self.progress.advance(spacing.min(count - index) as u64);
                if self.progress.cancelled() {
                    return Err(Finding::error(Code::CANCELLED, "the joint path was cancelled").into());
                }
            }
        }
        let mut best = 0;
        for (i, state) in layer.iter().enumerate() {
            if state.cost < layer[best].cost - TIE {
                best = i;
            }
        }
        let cost = layer[best].cost;
        let chosen = self.trace_back(&kept, spacing, best, endless)?;
        let values = self.all_joints(&chosen)?;
        let retracts = self.retracts(&chosen);
        Ok(JointPath { values, cost, retracts })
    }

    /// The chosen rotary positions of all poses, from the last back.
    fn trace_back(
        &self,
        kept: &[Layer],
        spacing: usize,
        best: usize,
        endless: [bool; 2],
    ) -> Result<Vec<[f64; 2]>> {
        let mut chosen = vec![[0.0; 2]; self.poses.len()];
        let mut at = best;
        for (block, first) in kept.iter().enumerate().rev() {
            let start = block * spacing;
            let end = (start + spacing).min(self.poses.len());
            let mut layers = vec![first.clone()];
            for index in start + 1..end {
                let next = self.next_layer(&layers[index - start - 1], index, endless)?;
                layers.push(next);
            }
            for index in (start..end).rev() {
                let state = layers[index - start][at];
                chosen[index] = state.values;
                at = state.from;
            }
        }
        Ok(chosen)
    }

    /// States of the first pose.
    fn first_layer(&self, endless: [bool; 2]) -> Result<Layer> {
        let seeds: Vec<[f64; 2]> = match self.options.start {
            Some(start) => vec![self.rotaries.of(&start)],
            // Free: axes that the first poses leave open take the positions of the first pose that determines them.
            None => match self.found.iter().position(|s| s.iter().all(|s| !s.singular)) {
                Some(index) => self.candidates(index, &[], endless)?,
                None => vec![[0.0; 2]],
            },
        };
        let candidates = self.candidates(0, &seeds, endless)?;
        let mut layer = Layer::with_capacity(candidates.len());
        for candidate in candidates {
            let (mut values, mut cost) = (candidate, 0.0);
            if self.options.start.is_some() {
                values = unwound(seeds[0], candidate, endless);
                cost = self.step(seeds[0], values).0;
            }
            if self.is_negative(values) {
                cost += self.options.retract_cost;
            }
            layer.push(State { values, cost, from: 0 });
        }
        Ok(layer)
    }

    fn is_negative(&self, values: [f64; 2]) -> bool {
        let place = self.rotaries.joints().iter().position(|&j| Some(j) == self.options.prefer_positive);
        place.is_some_and(|k| values[k] < -TIE)
    }

    fn next_layer(&self, before: &Layer, index: usize, endless: [bool; 2]) -> Result<Layer> {
        let held: Vec<[f64; 2]> = before.iter().map(|state| state.values).collect();
        let candidates = self.candidates(index, &held, endless)?;
        let mut layer = Layer::with_capacity(candidates.len());
        for candidate in candidates {
            let mut best: Option<State> = None;
            for (from, state) in before.iter().enumerate() {
                let values = unwound(state.values, candidate, endless);
                let (step, far) = self.step(state.values, values);
                if far && !self.options.may_retract {
                    continue;
                }
                let cost = state.cost + step + if far { self.options.retract_cost } else { 0.0 };
                if best.is_none_or(|best| cost < best.cost - TIE) {
                    best = Some(State { values, cost, from });
                }
            }
            layer.extend(best);
        }
        if layer.is_empty() {
            let message =
                format!("between poses {} and {index} the tool would have to be retracted", index - 1);
            let finding = Finding::error(Code::PATH_BROKEN, message);
            return Err(finding
                .point(self.poses[index].tip.to_array())
                .help("allow a retraction there, or incline the tool otherwise")
                .into());
        }
        Ok(layer)
    }

    /// Cost of a step without that of a retraction, and whether it turns an axis far.
    fn step(&self, from: [f64; 2], to: [f64; 2]) -> (f64, bool) {
        let mut cost: f64 = 0.0;
        let mut far = false;
        for (k, &joint) in self.rotaries.joints().iter().enumerate() {
            let travel = (to[k] - from[k]).abs();
            far |= travel > self.options.retract_step + TIE;
            match &self.options.cost {
                StepCost::Travel(weights) => cost += weights[joint] * travel,
                StepCost::Time(speeds) => cost = cost.max(travel / speeds[joint]),
            }
        }
        (cost, far)
    }

    /// Candidates of a pose; axes that it leaves open have the positions of one of `held`.
    fn candidates(&self, index: usize, held: &[[f64; 2]], endless: [bool; 2]) -> Result<Vec<[f64; 2]>> {
        let mut candidates = Vec::new();
        let mut add = |solutions: &[Solution], held: Option<[f64; 2]>| {
            for solution in solutions {
                if translations_inside(solution, &self.rotary, self.options) {
                    push(&mut candidates, &self.rotaries, solution, held, endless, self.options);
                }
            }
        };
        let base = &self.found[index];
        if base.iter().any(|s| s.singular) {
            for &values in held {
                let solutions = self.solutions_at(index, values, None)?;
                add(&solutions, Some(values));
            }
        } else {
            add(base, None);
        }
        if candidates.is_empty() {
            let finding = outside_travel(base, &self.rotary, self.options, index);
            return Err(finding.point(self.poses[index].tip.to_array()).into());
        }
        Ok(candidates)
    }

    /// Solutions of a pose with open axes at given rotary positions, and open translations where they were.
    fn solutions_at(
        &self,
        index: usize,
        values: [f64; 2],
        before: Option<&JointValues>,
    ) -> Result<Solutions> {
        let mut given = before.copied().or(self.options.start).unwrap_or(self.options.held);
        for (&joint, value) in self.rotaries.joints().iter().zip(values) {
            if let Some(slot) = given.get_mut(joint) {
                *slot = value;
            }
        }
        let pose = &self.poses[index];
        self.chain.solutions(pose, &given, self.options).map_err(|error| at_pose(error, index, pose))
    }

    /// Positions of all joints from those of the rotary axes.
    fn all_joints(&self, chosen: &[[f64; 2]]) -> Result<Vec<JointValues>> {
        let mut all: Vec<JointValues> = Vec::with_capacity(chosen.len());
        for (index, &values) in chosen.iter().enumerate() {
            let again;
            let base = &self.found[index];
            let solutions = if base.iter().any(|s| s.singular) {
                again = self.solutions_at(index, values, all.last())?;
                &again
            } else {
                base
            };
            let apart = |s: &Solution| {
                let own = self.rotaries.of(&s.values);
                wrap(own[0] - values[0]).abs() + wrap(own[1] - values[1]).abs()
            };
            let nearest = solutions.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
            let mut joints = nearest.map_or(JointValues::zero(self.chain.count), |s| s.values);
            for (&joint, value) in self.rotaries.joints().iter().zip(values) {
                joints[joint] = value;
            }
            all.push(joints);
        }
        Ok(all)
    }

    fn retracts(&self, chosen: &[[f64; 2]]) -> Vec<Retract> {
        let mut retracts = Vec::new();
        for (i, pair) in chosen.windows(2).enumerate() {
            if !self.step(pair[0], pair[1]).1 {
                continue;
            }
            let apart = [0, 1].map(|k| (pair[1][k] - pair[0][k]).abs());
            let far = usize::from(apart[1] > apart[0]);
            let near = |k: usize| wrap(pair[1][k] - pair[0][k]).abs() <= self.options.retract_step + TIE;
            retracts.push(Retract {
                index: i + 1,
                kind: if near(0) && near(1) { RetractKind::Unwind } else { RetractKind::Flip },
                joint: self.rotaries.joints()[far],
                travel: apart[far],
            });
        }
        retracts
    }
}

/// The turn of an endless axis that is nearest to where it was.
fn unwound(from: [f64; 2], mut to: [f64; 2], endless: [bool; 2]) -> [f64; 2] {
    for k in 0..2 {
        if endless[k] && (to[k] - from[k]).abs() > PI {
            to[k] -= ((to[k] - from[k]) / TAU).round() * TAU;
        }
    }
    to
}
