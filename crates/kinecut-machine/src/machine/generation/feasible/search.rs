//! One choice of moving joints for a task: its branches, their whole turns, their laws.

use super::follow::{Branch, follow, unreached};
use super::solve::{Mover, Reached};
use super::{Hold, JointLaw, Obstacle, Task, TaskMotion, VariableLaw, law};
use crate::machine::{JointValues, Kinematics, Machine};

/// A way, or the obstacle.
pub(super) type Attempt = Result<TaskMotion, Obstacle>;

/// The task, machine and grid that all choices of joints share.
pub(super) struct Search<'a> {
    machine: &'a Machine,
    chain: &'a Kinematics,
    task: &'a Task<'a>,
    home: JointValues,
    rotary: Vec<bool>,
    nodes: [usize; 2],
    /// Length by which angles are weighed against lengths [mm].
    pub(super) arm: f64,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        machine: &'a Machine,
        chain: &'a Kinematics,
        task: &'a Task<'a>,
        home: JointValues,
        nodes: [usize; 2],
    ) -> Search<'a> {
        let rotary = machine.joints.iter().map(|j| j.motion.is_rotation()).collect();
        let reach = [[0, 0], [0, 1], [1, 0], [1, 1]]
            .map(|[i, j]| task.pose([task.domain[0][i], task.domain[1][j]]).translation.length());
        let arm = reach.into_iter().fold(LEAST_ARM, f64::max);
        Search { machine, chain, task, home, rotary, nodes, arm }
    }

    fn mover<'b>(&'b self, moving: &'b [usize]) -> Mover<'b> {
        Mover { chain: self.chain, hold: self.task.hold, moving, rotary: &self.rotary, arm: self.arm }
    }

    /// True if these joints reach the middle and two corners of the domain.
    pub(super) fn reaches(&self, moving: &[usize]) -> bool {
        let mover = self.mover(moving);
        let [nu, nv] = self.nodes;
        [[nu / 2, nv / 2], [0, 0], [nu - 1, nv - 1]].iter().all(|&[i, j]| {
            let pose = self.task.pose(self.task.node(self.nodes, i, j));
            mover.reach_all(&pose, &self.home).first().is_some_and(super::solve::Reached::is_exact)
        })
    }

    /// All ways in which these joints alone do the task, or what keeps them from it.
    pub(super) fn ways(&self, moving: &[usize]) -> Vec<Attempt> {
        let mover = self.mover(moving);
        let [nu, nv] = self.nodes;
        // The middle, where the branch begins, then two corners, so that most choices are put aside at once.
        let corners =
            [[nu / 2, nv / 2], [0, 0], [nu - 1, nv - 1]].map(|[i, j]| self.task.node(self.nodes, i, j));
        let mut roots = Vec::new();
        for (n, &u) in corners.iter().enumerate() {
            let found = mover.reach_all(&self.task.pose(u), &self.home);
            match found.first() {
                Some(first) if first.is_exact() => {}
                Some(first) => return vec![Err(unreached(&mover, self.task, u, first))],
                None => return Vec::new(),
            }
            if n == 0 {
                roots = found;
            }
        }
        let follow = |root: &Reached| -> Attempt {
            let mut branch = follow(&mover, self.task, &root.values, self.nodes)?;
            self.wind(&mut branch)?;
            Ok(self.way(branch, moving))
        };
        roots.iter().map(follow).collect()
    }

    /// Shifts rotations by whole turns into their travel, and checks the travel of all joints.
    fn wind(&self, branch: &mut Branch) -> Result<(), Obstacle> {
        use std::f64::consts::TAU;
        for (joint, axis) in self.machine.joints.iter().enumerate() {
            let values = || branch.values.iter().enumerate().map(|(n, q)| (q[joint], n));
            let (Some(least), Some(most)) =
                (values().min_by(|a, b| a.0.total_cmp(&b.0)), values().max_by(|a, b| a.0.total_cmp(&b.0)))
            else {
                continue;
            };
            let start = branch.values[0][joint];
            let mut shift = if self.rotary[joint] { -(start / TAU).round() * TAU } else { 0.0 };
            if let Some([from, to]) = axis.travel {
                if self.rotary[joint] && (least.0 + shift < from || most.0 + shift > to) {
                    // The turn at which the middle of the range is nearest to that of the travel is the best there is.
                    shift = ((0.5 * (from + to) - 0.5 * (least.0 + most.0)) / TAU).round() * TAU;
                }
                let (under, over) = (from - least.0 - shift, most.0 + shift - to);
                if under > SLACK || over > SLACK {
                    let ((value, node), bound) = if under > over { (least, from) } else { (most, to) };
                    let at = self.task.node(branch.nodes, node / branch.nodes[1], node % branch.nodes[1]);
                    let point = self.task.pose(at).translation;
                    return Err(Obstacle::Travel { joint, value: value + shift, bound, at, point });
                }
            }
            if shift != 0.0 {
                for q in &mut branch.values {
                    q[joint] += shift;
                }
            }
        }
        Ok(())
    }

    fn way(&self, branch: Branch, moving: &[usize]) -> TaskMotion {
        let laws = law::laws(self.machine, self.task, &branch);
        let links = law::links(&laws);
        let (tip_error, turn_error) = self.between(&branch, &laws, moving);
        let frame = self.chain.forward(&branch.values[0]);
        let astray =
            Hold::Frame.miss(&frame, &self.task.pose(self.task.node(branch.nodes, 0, 0))).turn.length();
        let Branch { nodes, values } = branch;
        TaskMotion {
            laws,
            links,
            tip_error,
            turn_error,
            nodes,
            positions: values,
            names: self.task.names.clone(),
            domain: self.task.domain,
            astray,
        }
    }

    /// Errors of the laws in the middles of the cells: what is sampled is solved anew, the rest follows its law.
    fn between(&self, branch: &Branch, laws: &[JointLaw], moving: &[usize]) -> (f64, f64) {
        let sampled: Vec<usize> =
            moving.iter().copied().filter(|&j| laws[j].law == VariableLaw::Sampled).collect();
        let mover = self.mover(&sampled);
        let (mut tip, mut turn) = (0.0f64, 0.0f64);
        let [nu, nv] = branch.nodes;
        for i in 0..nu.max(2) - 1 {
            for j in 0..nv.max(2) - 1 {
                let (a, b) = (
                    self.task.node(branch.nodes, i, j),
                    self.task.node(branch.nodes, (i + 1).min(nu - 1), (j + 1).min(nv - 1)),
                );
                let u = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
                let mut q = branch.values[i * nv + j];
                for (value, law) in q.iter_mut().zip(laws) {
                    match law.law {
                        VariableLaw::Setting(set) => *value = set,
                        VariableLaw::Affine { at_start, slopes } => {
                            let by = |k: usize| slopes[k] * (u[k] - self.task.domain[k][0]);
                            *value = at_start + by(0) + by(1);
                        }
                        VariableLaw::Sampled => {}
                    }
                }
                let miss = mover.reach(&self.task.pose(u), &q).miss;
                tip = tip.max(miss.shift.length());
                turn = turn.max(miss.turn.length());
            }
        }
        (tip, turn)
    }

    /// An unreached pose is replaced by the one that is farthest out of reach.
    pub(super) fn worst(&self, obstacle: Obstacle, moving: &[usize]) -> Obstacle {
        let Obstacle::Unreached { .. } = obstacle else { return obstacle };
        let mover = self.mover(moving);
        let mut worst = obstacle;
        for n in 0..25 {
            let at = |k: usize, i: usize| {
                let [from, to] = self.task.domain[k];
                from + (to - from) * i as f64 / 4.0
            };
            let u = [at(0, n / 5), at(1, n % 5)];
            let found = mover.reach_all(&self.task.pose(u), &self.home);
            if let Some(first) = found.first().filter(|f| !f.is_exact()) {
                let other = unreached(&mover, self.task, u, first);
                // Not by rounding: places that are equally bad keep the first.
                if other.distance(self.arm).1 > worst.distance(self.arm).1 * (1.0 + SAME) {
                    worst = other;
                }
            }
        }
        worst
    }
}

/// All choices of `count` of the joints, in their order.
pub(super) fn choices(joints: &[usize], count: usize) -> Vec<Vec<usize>> {
    let masks = 0u32..1 << joints.len().min(31);
    let chosen = masks.filter(|mask| mask.count_ones() as usize == count).map(|mask| {
        (0..joints.len()).filter(|&i| mask >> i & 1 == 1).map(|i| joints[i]).collect::<Vec<usize>>()
    });
    let mut all: Vec<Vec<usize>> = chosen.collect();
    all.sort();
    all
}

/// Shortest length by which angles are weighed [mm].
const LEAST_ARM: f64 = 10.0;
/// Excess of a joint over its travel that is rounding [mm or rad].
const SLACK: f64 = 1e-9;
/// Relative difference of two misses that are one.
const SAME: f64 = 1e-6;
