//! Machines that differ little from one that cannot, and can.
//!
//! One or two changes of the code are tried: an axis more, one instead of another, one less, one elsewhere in the chain.
//! What stays keeps its offsets and its travel; a new axis stands at home through the zero of the machine, without bounds.
//! Codes whose words differ only by motions that change places and by the bed count once.

use std::collections::BTreeSet;

use super::{FeasibleOptions, Task, can_make};
use crate::base::{Progress, Result};
use crate::machine::{CoordinateCode, Elementary, Joint, MOST_JOINTS, Machine, Word};

/// A machine that can do a task.
#[derive(Clone, Debug, PartialEq)]
pub struct Alternative {
    /// Its code.
    pub code: CoordinateCode,
    /// What is changed, as a sentence: "with a rotation about Y after 6".
    pub changes: Vec<String>,
    /// How it does the task.
    pub way: super::Way,
}

/// Up to `most` machines that can do the task with one change of the code, or with two if one is not enough; those with
/// fewer moving axes first.
///
/// # Errors
/// Those of [`can_make`].
pub fn nearest_machines(
    machine: &Machine,
    task: &Task<'_>,
    options: &FeasibleOptions,
    most: usize,
    progress: &dyn Progress,
) -> Result<Vec<Alternative>> {
    let coarse = FeasibleOptions { cells: [6, 4], ..options.clone() };
    let mut seen: BTreeSet<Word> = BTreeSet::from([machine.code.word().canonical()]);
    let mut ring = vec![(machine.clone(), Vec::new())];
    let mut found: Vec<Alternative> = Vec::new();
    for _ in 0..MOST_CHANGES {
        let mut next = Vec::new();
        for (base, said) in &ring {
            for (changed, what) in changes(base) {
                if !seen.insert(changed.code.word().canonical()) {
                    continue;
                }
                let mut said: Vec<String> = said.clone();
                said.push(what);
                next.push((changed, said));
            }
        }
        let mut these = Vec::new();
        for (other, said) in &next {
            // Held axes may be gone.
            let held =
                coarse.held.iter().filter(|(letter, _)| other.joint(*letter).is_some()).copied().collect();
            let options = FeasibleOptions { held, ..coarse.clone() };
            if let Ok(way) = can_make(other, task, &options, progress)? {
                these.push(Alternative { code: other.code.clone(), changes: said.clone(), way });
            }
        }
        these.sort_by_key(|a| (a.way.cost(), a.code.word().0.len(), a.code.to_string()));
        found.extend(these);
        if !found.is_empty() || next.len() * changes_of(machine) > MOST_TRIES {
            break;
        }
        ring = next;
    }
    found.truncate(most);
    Ok(found)
}

/// All machines with one change.
fn changes(machine: &Machine) -> Vec<(Machine, String)> {
    let mut list = Vec::new();
    let motions = &machine.code.word().0;
    let named = |motion: Elementary| {
        let axis = motion.letter().map_or_else(|| "an inclined axis".to_owned(), String::from);
        if motion.is_rotation() { format!("a rotation {axis}") } else { format!("a translation {axis}") }
    };
    let mut push = |joints: Vec<Joint>, bed: usize, what: String| {
        let word = Word(joints.iter().map(|j| j.motion).collect());
        if let Ok(code) = CoordinateCode::new(word, bed) {
            let changed = Machine { code, joints, bodies: std::sync::Arc::default(), ..machine.clone() };
            if changed.check().is_ok() {
                list.push((changed, what));
            }
        }
    };
    let new = Elementary::STANDARD.into_iter().filter(|m| !machine.code.has(*m));
    let bed = machine.code.bed();
    for motion in new {
        if motions.len() < MOST_JOINTS {
            for at in 0..=motions.len() {
                let mut joints = machine.joints.clone();
                joints.insert(at, Joint::standard(motion));
                let what = format!("with {} in place {}", named(motion), at + 1);
                push(joints, bed + usize::from(at < bed), what);
            }
        }
        for at in 0..motions.len() {
            let mut joints = machine.joints.clone();
            joints[at] = Joint::standard(motion);
            push(joints, bed, format!("with {} instead of {}", named(motion), motions[at]));
        }
    }
    for at in 0..motions.len() {
        for to in 0..motions.len() {
            if to != at {
                let mut joints = machine.joints.clone();
                let joint = joints.remove(at);
                joints.insert(to, joint);
                push(joints, bed, format!("with {} in place {}", motions[at], to + 1));
            }
        }
    }
    list
}

/// Number of changes of one machine, about.
fn changes_of(machine: &Machine) -> usize {
    let n = machine.joints.len();
    6 * (2 * n + 1) + n * n
}

/// Most changes of a code.
const MOST_CHANGES: usize = 2;
/// Most machines that are tried in one round.
const MOST_TRIES: usize = 20_000;
