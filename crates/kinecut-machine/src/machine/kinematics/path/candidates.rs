//! Candidates: the positions of the rotary axes that one pose allows.

use std::f64::consts::TAU;

use super::super::inverse::Solution;
use super::PathOptions;
use crate::num::angle::wrap;

/// Two angles this near to each other [rad] modulo a turn are one: rounding of some hundred turns.
const SAME: f64 = 1e-9;
/// Most candidates of a pose: two solutions with 250 turns. The ones nearest to zero are kept.
const MOST_CANDIDATES: usize = 512;
/// Most turns of an axis to each side.
const MOST_TURNS: i64 = 250;

/// The rotary axes of a path: their joints.
#[derive(Clone, Copy)]
pub(super) struct Rotaries {
    joints: [usize; 2],
    count: usize,
}

impl Rotaries {
    pub(super) fn new(joints: impl Iterator<Item = usize>) -> Rotaries {
        let mut rotaries = Rotaries { joints: [0; 2], count: 0 };
        for joint in joints.take(2) {
            rotaries.joints[rotaries.count] = joint;
            rotaries.count += 1;
        }
        rotaries
    }

    pub(super) fn joints(&self) -> &[usize] {
        &self.joints[..self.count]
    }

    /// The positions of the rotary axes among those of all joints; zero for axes that are not there.
    pub(super) fn of(&self, values: &[f64]) -> [f64; 2] {
        let mut own = [0.0; 2];
        for (slot, &joint) in own.iter_mut().zip(self.joints()) {
            *slot = values.get(joint).copied().unwrap_or(0.0);
        }
        own
    }
}

/// Adds the candidates of a solution. An endless axis has one candidate for all its turns; an axis at the position it
/// has in `held` keeps its turns.
pub(super) fn push(
    candidates: &mut Vec<[f64; 2]>,
    rotaries: &Rotaries,
    solution: &Solution,
    held: Option<[f64; 2]>,
    endless: [bool; 2],
    options: &PathOptions,
) {
    let own = rotaries.of(&solution.values);
    let mut turns = [0..=0, 0..=0];
    let mut start = own;
    for (k, &joint) in rotaries.joints().iter().enumerate() {
        if let Some(held) = held
            && wrap(own[k] - held[k]).abs() < SAME
        {
            start[k] = held[k];
        } else if !endless[k] {
            let range = options.travels.turns(joint, own[k]);
            turns[k] = *range.start().max(&-MOST_TURNS)..=*range.end().min(&MOST_TURNS);
        }
    }
    let first = candidates.len();
    for i in turns[0].clone() {
        for j in turns[1].clone() {
            let candidate = [start[0] + i as f64 * TAU, start[1] + j as f64 * TAU];
            if !candidates.contains(&candidate) {
                candidates.push(candidate);
            }
        }
    }
    // Nearest to zero first: of equal costs the least wound path wins.
    candidates[first..].sort_by(|a, b| (a[0].abs() + a[1].abs()).total_cmp(&(b[0].abs() + b[1].abs())));
    candidates.truncate(first + MOST_CANDIDATES);
}

/// True if the translations of a solution lie inside their travel.
pub(super) fn translations_inside(solution: &Solution, rotary: &[bool], options: &PathOptions) -> bool {
    let mut values = solution.values.iter().enumerate();
    values.all(|(joint, &value)| rotary[joint] || options.travels.beyond(joint, value) == 0.0)
}
