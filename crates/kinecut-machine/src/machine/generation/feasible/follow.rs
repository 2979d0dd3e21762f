//! One continuous branch of joint positions over the whole domain.
//!
//! From a solution in the middle the branch is followed along one row of the grid and then along all lines across it. Each step
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
    pub(super) nodes: [usize; 2],
    /// Positions, the second variable running faster.
    pub(super) values: Vec<JointValues>,
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

/// Follows a branch from the solution `first` at the middle node, along one variable and then along the other, in
/// whichever order works: where the tool comes parallel to a rotation at an end of one variable, only one does.
pub(super) fn follow(
    mover: &Mover<'_>,
    task: &Task<'_>,
    first: &JointValues,
    nodes: [usize; 2],
) -> Result<Branch, Obstacle> {
    let one = follow_from(mover, task, first, nodes, 0);
    if nodes[0] == 1 || nodes[1] == 1 || one.is_ok() {
        return one;
    }
    follow_from(mover, task, first, nodes, 1).or(one)
}

/// Follows along the variable `lead` through the middle, and from there along the other.
fn follow_from(
    mover: &Mover<'_>,
    task: &Task<'_>,
    first: &JointValues,
    nodes: [usize; 2],
    lead: usize,
) -> Result<Branch, Obstacle> {
    let mut values = vec![*first; nodes[0] * nodes[1]];
    let place = |along: usize, across: usize| if lead == 0 { [along, across] } else { [across, along] };
    let index = |[i, j]: [usize; 2]| i * nodes[1] + j;
    let (middle, side) = (nodes[lead] / 2, nodes[1 - lead] / 2);
    let mut go = |from: [usize; 2], to: [usize; 2]| -> Result<(), Obstacle> {
        let (a, b) = (task.node(nodes, from[0], from[1]), task.node(nodes, to[0], to[1]));
        values[index(to)] = step(mover, task, a, b, &values[index(from)])?;
        Ok(())
    };
    for along in outwards(middle, nodes[lead]) {
        go(place(along.0, side), place(along.1, side))?;
    }
    for along in 0..nodes[lead] {
        for across in outwards(side, nodes[1 - lead]) {
            go(place(along, across.0), place(along, across.1))?;
        }
    }
    // Rows that were followed apart must still be neighbours.
    let rank = |q: &JointValues| {
        let jacobian = mover.chain.jacobian(q);
        let rates = mover.moving.iter().map(|&j| (jacobian.tip_rate(j), jacobian.twists()[j].turn));
        super::rank::rank(rates, mover.hold, jacobian.frame.rotation.z_axis, mover.arm)
    };
    let regular = rank(first);
    for along in 1..nodes[lead] {
        for across in 0..nodes[1 - lead] {
            if across == side {
                continue;
            }
            let (from, to) = (place(along - 1, across), place(along, across));
            let (before, here) = (&values[index(from)], &values[index(to)]);
            let (a, b) = (task.node(nodes, from[0], from[1]), task.node(nodes, to[0], to[1]));
            // The rows next to these, towards the middle.
            let inner = if across > side { across - 1 } else { across + 1 };
            let [p, q] = [along - 1, along].map(|along| &values[index(place(along, inner))]);
            let apart = match step(mover, task, a, b, before) {
                Ok(again) => {
                    let apart = |j: &usize| (again[*j] - here[*j]).abs() > APART * (1.0 + here[*j].abs());
                    mover.moving.iter().copied().find(apart).map(|j| (j, here[j] - again[j]))
                }
                // A step across a free axis may ask it to jump although the rows are neighbours.
                Err(Obstacle::Jump { joint, by, .. }) => Some((joint, by)),
                Err(other) => return Err(other),
            };
            let Some((joint, by)) = apart else { continue };
            let singular = rank(here) < regular || rank(before) < regular;
            let near =
                |&j: &usize| (here[j] - before[j]).abs() <= (q[j] - p[j]).abs() + NEIGHBOUR * mover.unit(j);
            if !(singular && mover.moving.iter().all(near)) {
                return Err(Obstacle::Jump { joint, by, at: b, point: task.pose(b).translation });
            }
        }
    }
    Ok(Branch { nodes, values })
}

/// Steps from `middle` to both ends of `0..count`.
fn outwards(middle: usize, count: usize) -> impl Iterator<Item = (usize, usize)> {
    let up = (middle..count.saturating_sub(1)).map(|i| (i, i + 1));
    up.chain((0..middle).rev().map(|i| (i + 1, i)))
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
            _ => {
                // Near a singular place the search may fail although there is a solution: near, or after a jump.
                let pose = task.pose(u);
                let found = mover.reach_all(&pose, &at);
                let Some(other) = found.first().filter(|f| f.is_exact()) else {
                    return Err(unreached(mover, task, u, &reached));
                };
                let by = |j: usize| (other.values[j] - at[j]) / mover.unit(j);
                let farthest =
                    mover.moving.iter().copied().max_by(|&a, &b| by(a).abs().total_cmp(&by(b).abs()));
                if let Some(joint) = farthest.filter(|&j| by(j).abs() > MOST_TURN) {
                    let by = other.values[joint] - at[joint];
                    return Err(Obstacle::Jump { joint, by, at: u, point: pose.translation });
                }
                at = other.values;
                done = goal;
            }
        }
    }
    Ok(at)
}

/// Obstacle between the tool and a pose, from the nearest pose that was found.
pub(super) fn unreached(mover: &Mover<'_>, task: &Task<'_>, at: [f64; 2], reached: &Reached) -> Obstacle {
    let moving = mover.chain.jacobian(&reached.values);
    let rates = mover.moving.iter().map(|&j| (moving.tip_rate(j), moving.twists()[j].turn));
    let pose = task.pose(at);
    let back = pose.rotation.transpose();
    Obstacle::Unreached {
        shift: back * reached.miss.shift,
        turn: back * reached.miss.turn,
        at,
        point: pose.translation,
        rank: super::rank::rank(rates, mover.hold, moving.frame.rotation.z_axis, mover.arm),
    }
}

/// Greatest turn of a rotation in one step [rad].
const MOST_TURN: f64 = 0.5;
/// Shortest part of a step between two nodes: an axis that still turns by more jumps.
const SHORTEST: f64 = 1.0 / 4096.0;
/// Amount by which rows may differ more than the rows next to them where an axis is free: half a radian, or so many
/// millimetres of the tip.
const NEIGHBOUR: f64 = 0.5;
/// Difference by which two ways to one node are different branches, relative.
const APART: f64 = 1e-5;
