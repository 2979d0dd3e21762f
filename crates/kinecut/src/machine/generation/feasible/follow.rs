//! One continuous branch of joint positions over the whole domain.
//!
//! From a solution at one corner the branch is followed along one side of the grid and then along its rows. Each step
//! starts where the last one ended and is halved until the rotations turn little; where halving does not help, an axis
//! has to jump.

use super::Obstacle;
use super::solve::{Mover, Reached};
use super::task::Task;
use crate::machine::JointValues;

/// Joint positions on a grid over the domain.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Branch {
    /// Nodes of each variable.
    pub nodes: [usize; 2],
    /// Positions, the second variable running faster.
    pub values: Vec<JointValues>,
}

impl Task<'_> {
    /// Values of the variables at a node of a grid.
    pub(super) fn node(&self, nodes: [usize; 2], i: usize, j: usize) -> [f64; 2] {
        let along = |k: usize, i: usize| {
            let [from, to] = self.domain[k];
            let share = if nodes[k] > 1 { i as f64 / (nodes[k] - 1) as f64 } else { 0.0 };
            from * (1.0 - share) + to * share
        };
        [along(0, i), along(1, j)]
    }

    /// Nodes of a grid of `cells` cells; one for a range of no length.
    pub(super) fn nodes(&self, cells: [usize; 2]) -> [usize; 2] {
        [0, 1].map(|k| if self.domain[k][1] > self.domain[k][0] { cells[k].max(2) + 1 } else { 1 })
    }
}

/// Follows a branch from the solution `first` at the lower ends of both variables.
pub(super) fn follow(
    mover: &Mover<'_>,
    task: &Task<'_>,
    first: &JointValues,
    nodes: [usize; 2],
) -> Result<Branch, Obstacle> {
    let mut values = vec![*first; nodes[0] * nodes[1]];
    for j in 1..nodes[1] {
        let (from, to) = (task.node(nodes, 0, j - 1), task.node(nodes, 0, j));
        values[j] = step(mover, task, from, to, &values[j - 1])?;
    }
    for j in 0..nodes[1] {
        for i in 1..nodes[0] {
            let (from, to) = (task.node(nodes, i - 1, j), task.node(nodes, i, j));
            values[i * nodes[1] + j] = step(mover, task, from, to, &values[(i - 1) * nodes[1] + j])?;
        }
    }
    // Rows that were followed apart must still be neighbours.
    for i in 1..nodes[0] {
        for j in 1..nodes[1] {
            let (before, here) = (&values[i * nodes[1] + j - 1], &values[i * nodes[1] + j]);
            let to = task.node(nodes, i, j);
            let again = step(mover, task, task.node(nodes, i, j - 1), to, before)?;
            let apart =
                |joint: &usize| (again[*joint] - here[*joint]).abs() > APART * (1.0 + here[*joint].abs());
            if let Some(joint) = mover.moving.iter().copied().find(apart) {
                return Err(Obstacle::Jump {
                    joint,
                    by: here[joint] - again[joint],
                    at: to,
                    point: task.pose(to).translation,
                });
            }
        }
    }
    Ok(Branch { nodes, values })
}

/// Joint positions at `to`, from those at `from`.
fn step(
    mover: &Mover<'_>,
    task: &Task<'_>,
    from: [f64; 2],
    to: [f64; 2],
    start: &JointValues,
) -> Result<JointValues, Obstacle> {
    let between = |s: f64| [0, 1].map(|k| from[k] * (1.0 - s) + to[k] * s);
    let (mut done, mut length, mut at) = (0.0, 1.0f64, *start);
    while done < 1.0 {
        let goal = (done + length).min(1.0);
        let u = if goal == 1.0 { to } else { between(goal) };
        let reached = mover.reach(&task.pose(u), &at);
        let turned =
            |&&joint: &&usize| mover.rotary[joint] && (reached.values[joint] - at[joint]).abs() > MOST_TURN;
        let turning = mover.moving.iter().find(turned);
        match turning {
            None if reached.is_exact() => {
                at = reached.values;
                done = goal;
                length *= 2.0;
            }
            _ if length > SHORTEST => length *= 0.5,
            Some(&joint) if reached.is_exact() => {
                let by = reached.values[joint] - at[joint];
                return Err(Obstacle::Jump { joint, by, at: u, point: task.pose(u).translation });
            }
            _ => return Err(unreached(mover, task, u, &reached)),
        }
    }
    Ok(at)
}

/// What keeps the tool from a pose, from the nearest pose that was found.
pub(super) fn unreached(mover: &Mover<'_>, task: &Task<'_>, at: [f64; 2], reached: &Reached) -> Obstacle {
    let moving = mover.chain.jacobian(&reached.values);
    let rates = mover.moving.iter().map(|&j| (moving.tip_rate(j), moving.twists()[j].turn));
    Obstacle::Unreached {
        shift: reached.miss.shift,
        turn: reached.miss.turn,
        at,
        point: task.pose(at).translation,
        rank: super::rank::rank(rates, mover.hold, moving.frame.rotation.z_axis, mover.arm),
    }
}

/// Greatest turn of a rotation in one step [rad].
const MOST_TURN: f64 = 0.5;
/// Shortest part of a step between two nodes: an axis that still turns by more jumps.
const SHORTEST: f64 = 1.0 / 4096.0;
/// Difference by which two ways to one node are different branches, relative.
const APART: f64 = 1e-5;
