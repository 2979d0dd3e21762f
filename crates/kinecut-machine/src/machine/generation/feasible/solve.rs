//! Joint positions for a pose, for any chain: damped least squares.
//!
//! Closed forms exist for three translations and two rotations (`Kinematics::inverse`); a point tool on a lathe, an
//! edge with its frame and a chain that lacks an axis do not fit them. So each pose is solved by Levenberg and
//! Marquardt's method on the joints that may move, from the previous pose or from a lattice of starts. The search for a
//! pose out of reach ends at its nearest pose, and so gives the missing motion.

use super::Hold;
use super::task::Miss;
use crate::geom::Rigid;
use crate::machine::{JointValues, Kinematics, MOST_JOINTS};

/// A machine with the joints that may move for a task.
#[derive(Clone, Debug)]
pub(super) struct Mover<'a> {
    pub(super) chain: &'a Kinematics,
    pub(super) hold: Hold,
    /// The joints that may move, rising.
    pub(super) moving: &'a [usize],
    /// True for each joint of the chain that is a rotation.
    pub(super) rotary: &'a [bool],
    /// Length by which angles are weighed [mm].
    pub(super) arm: f64,
}

/// End of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reached {
    pub(super) values: JointValues,
    /// Motion that is missing there.
    pub(super) miss: Miss,
}

impl Reached {
    /// True if the pose is reached.
    pub(super) fn is_exact(&self) -> bool {
        self.miss.shift.length() <= NEAR * (1.0 + self.scale()) && self.miss.turn.length() <= NEAR_TURN
    }

    fn scale(&self) -> f64 {
        self.values.iter().fold(0.0f64, |most, v| most.max(v.abs())) * 1e-2
    }
}

impl Mover<'_> {
    /// The pose nearest to `to` from a start.
    pub(super) fn reach(&self, to: &Rigid, start: &JointValues) -> Reached {
        let n = self.moving.len();
        let mut at = *start;
        let mut jacobian = self.chain.jacobian(&at);
        let mut miss = self.hold.miss(&jacobian.frame, to);
        let mut size = miss.size(self.arm);
        let mut damping = 0.0;
        for _ in 0..STEPS {
            if size <= EXACT || n == 0 {
                break;
            }
            // Rows: three of the tip, three of the direction; columns: the joints, angles weighed by the arm.
            let mut columns = [[0.0; 6]; MOST_JOINTS];
            let axis = jacobian.frame.rotation.z_axis;
            for (column, &joint) in columns.iter_mut().zip(self.moving) {
                let weight = self.weight(joint);
                let shift = jacobian.tip_rate(joint) * weight;
                let turn = jacobian.twists()[joint].turn * weight * self.arm;
                let turn = match self.hold {
                    Hold::Point => glam::DVec3::ZERO,
                    Hold::Axis => turn - axis * axis.dot(turn),
                    Hold::Frame => turn,
                };
                *column = [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z];
            }
            let turn = miss.turn * self.arm;
            let wanted = [miss.shift.x, miss.shift.y, miss.shift.z, turn.x, turn.y, turn.z];
            let Some(step) = damped_step(&columns[..n], &wanted, damping) else { break };
            let mut next = at;
            for (&joint, &by) in self.moving.iter().zip(&step) {
                next[joint] += (by * self.weight(joint)).clamp(-self.most(joint), self.most(joint));
            }
            let there = self.chain.jacobian(&next);
            let less = self.hold.miss(&there.frame, to);
            let smaller = less.size(self.arm);
            if smaller < size {
                let gain = size - smaller;
                (at, jacobian, miss, size) = (next, there, less, smaller);
                damping = if damping < LEAST_DAMPING { 0.0 } else { damping * 0.1 };
                if gain < size * STALLED {
                    break;
                }
            } else {
                if damping > MOST_DAMPING {
                    break;
                }
                damping = (damping * 10.0).max(FIRST_DAMPING);
            }
        }
        Reached { values: at, miss }
    }

    /// All poses that are reached from a lattice of starts around `home`, those near to home first; else the nearest
    /// miss alone.
    pub(super) fn reach_all(&self, to: &Rigid, home: &JointValues) -> Vec<Reached> {
        let rotations: Vec<usize> = self.moving.iter().copied().filter(|&j| self.rotary[j]).collect();
        let per_joint = STARTS[rotations.len().min(STARTS.len() - 1)];
        let mut found: Vec<Reached> = Vec::new();
        let mut nearest: Option<Reached> = None;
        for n in 0..per_joint.pow(rotations.len() as u32) {
            let mut start = *home;
            let mut rest = n;
            for &joint in &rotations {
                // From home outwards to both sides; a little off the square, where derivatives vanish.
                let k = rest % per_joint;
                rest /= per_joint;
                let side = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
                start[joint] +=
                    side * k.div_ceil(2) as f64 * std::f64::consts::TAU / per_joint as f64 + ASKEW;
            }
            let mut reached = self.reach(to, &start);
            if !reached.is_exact() {
                if nearest.is_none_or(|other| reached.miss.size(self.arm) < other.miss.size(self.arm)) {
                    nearest = Some(reached);
                }
                continue;
            }
            for &joint in &rotations {
                let turns = ((reached.values[joint] - home[joint]) / std::f64::consts::TAU).round();
                reached.values[joint] -= turns * std::f64::consts::TAU;
            }
            let known = |other: &Reached| {
                self.moving
                    .iter()
                    .all(|&j| (other.values[j] - reached.values[j]).abs() < SAME * (1.0 + reached.scale()))
            };
            if !found.iter().any(known) {
                found.push(reached);
            }
        }
        let far = |r: &Reached| -> f64 {
            self.moving.iter().map(|&j| ((r.values[j] - home[j]) / self.weight(j)).powi(2)).sum()
        };
        found.sort_by(|a, b| far(a).total_cmp(&far(b)));
        found.truncate(MOST_BRANCHES);
        if found.is_empty() { nearest.into_iter().collect() } else { found }
    }

    /// Change of a joint that moves the tool by about 1 mm.
    fn weight(&self, joint: usize) -> f64 {
        if self.rotary[joint] { 1.0 / self.arm } else { 1.0 }
    }

    /// Change of a joint that is as much as one radian of a rotation [mm or rad].
    pub(super) fn unit(&self, joint: usize) -> f64 {
        if self.rotary[joint] { 1.0 } else { self.arm }
    }

    /// Longest step of a joint: a rotation's tangent means nothing farther away.
    fn most(&self, joint: usize) -> f64 {
        if self.rotary[joint] { 0.7 } else { f64::INFINITY }
    }
}

/// Solves `(J^T J + damping) x = J^T b`, or the shortest least-squares step when the joints are not independent.
fn damped_step(columns: &[[f64; 6]], wanted: &[f64; 6], damping: f64) -> Option<[f64; MOST_JOINTS]> {
    let n = columns.len();
    let dot = |a: &[f64; 6], b: &[f64; 6]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut matrix = [[0.0; MOST_JOINTS]; MOST_JOINTS];
    let mut right = [0.0; MOST_JOINTS];
    let mut trace = 0.0;
    for i in 0..n {
        for j in 0..n {
            matrix[i][j] = dot(&columns[i], &columns[j]);
        }
        trace += matrix[i][i];
        right[i] = dot(&columns[i], wanted);
    }
    if !(trace > 0.0) {
        return None;
    }
    // Cholesky; the floor keeps joints that do not matter where they are.
    for i in 0..n {
        matrix[i][i] += trace * (damping + FLOOR);
    }
    for i in 0..n {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| matrix[i][k] * matrix[j][k]).sum();
            let value = matrix[i][j] - sum;
            if i == j {
                if !(value > 0.0) {
                    return None;
                }
                matrix[i][i] = value.sqrt();
            } else {
                matrix[i][j] = value / matrix[j][j];
            }
        }
    }
    let mut x = [0.0; MOST_JOINTS];
    for i in 0..n {
        let sum: f64 = (0..i).map(|k| matrix[i][k] * x[k]).sum();
        x[i] = (right[i] - sum) / matrix[i][i];
    }
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|k| matrix[k][i] * x[k]).sum();
        x[i] = (x[i] - sum) / matrix[i][i];
    }
    Some(x)
}

/// Miss of the tip that counts as reached [mm], and of the direction [rad]: a thousandth of what a control resolves.
const NEAR: f64 = 1e-8;
const NEAR_TURN: f64 = 1e-10;
/// Miss at which the search ends [mm]: rounding of coordinates of some metres.
const EXACT: f64 = 1e-12;
/// Gain below which a search for what is out of reach has come to rest.
const STALLED: f64 = 1e-9;
/// Damping relative to the trace: added always (squares of rounding), first after a failure, last, and forgotten.
const FLOOR: f64 = 1e-15;
const FIRST_DAMPING: f64 = 1e-6;
const MOST_DAMPING: f64 = 1e6;
const LEAST_DAMPING: f64 = 1e-9;
/// Most steps of a search; Newton needs about six from a neighbour, and the first ones turn by 40 degrees at most.
const STEPS: usize = 80;
/// Starts of each rotation for 0 to 8 moving rotations.
const STARTS: [usize; 9] = [1, 8, 6, 4, 3, 2, 2, 2, 2];
/// Turn of all starts off the square [rad].
const ASKEW: f64 = 0.013;
/// Difference below which two solutions are one.
const SAME: f64 = 1e-6;
/// Most solutions of one pose that are followed: rotations about three axes have eight.
const MOST_BRANCHES: usize = 8;
