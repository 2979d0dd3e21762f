//! Machines near one that cannot do a task, and can.
//!
//! All orders of two to five different axes are looked at, with every place of the bed: among them the 2160 layouts of
//! X, Y, Z and two rotations, the 360 with one, and the 24 of X, Y, Z. Nearness is the number of changes of the code,
//! bed included: an axis more, one less, one instead of another, two neighbours exchanged (edit distance with
//! exchanges); then the number of axes, then the mass that the axes move. The place of the bed does not matter for what
//! is reached, nor does the order of motions that change places: each class is tried once, by its nearest layout. A
//! class is put aside when it does not reach three poses of the task with all its joints; laws are looked for only for
//! the nearest ones that are left. An axis keeps the place and the travel that it has in the asked machine; a new one
//! passes at home through the zero of the machine, without bounds.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::search::Search;
use super::{FeasibleOptions, Task, can_make};
use crate::base::{Code, Finding, Progress, Result};
use crate::geom::Rigid;
use crate::machine::layouts::{Masses, moved_masses};
use crate::machine::{
    CoordinateCode, Elementary, Joint, JointValues, Kinematics, MOST_JOINTS, Machine, Word,
};

/// A machine that can do a task.
#[derive(Clone, Debug, PartialEq)]
pub struct Alternative {
    /// Its code.
    pub code: CoordinateCode,
    /// Number of changes from the code that was asked.
    pub distance: usize,
    /// Axes added and left out, in words: "with a rotation B".
    pub changes: Vec<String>,
    /// The way in which it does the task.
    pub way: super::TaskMotion,
}

/// Extent of the search, and the nearest machines that can.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// Layouts that were looked at.
    pub layouts: usize,
    /// Classes of layouts that position alike.
    pub classes: usize,
    /// The nearest machines that can, one of each class; empty if no machine can.
    pub found: Vec<Alternative>,
}

/// Up to `most` machines that can do the task, the nearest first: by changes of the code, number of axes, mass that they
/// move, digits.
///
/// # Errors
/// Those of [`can_make`]; `KC0009` when cancelled.
pub fn nearest_machines(
    machine: &Machine,
    task: &Task<'_>,
    options: &FeasibleOptions,
    most: usize,
    progress: &dyn Progress,
) -> Result<Nearest> {
    task.check()?;
    machine.check()?;
    let coarse = FeasibleOptions { cells: COARSE, ..options.clone() };
    let (layouts, classes) = classes(machine);
    let mut found: Vec<Alternative> = Vec::new();
    for batch in classes.chunks(BATCH) {
        if found.len() >= most {
            break;
        }
        let tried: Vec<Result<Option<Alternative>>> = batch
            .par_iter()
            .map(|candidate| {
                if progress.cancelled() {
                    return Err(Finding::error(Code::CANCELLED, "the search was cancelled").into());
                }
                // Held axes may be gone.
                let other = &candidate.machine;
                let held = coarse
                    .held
                    .iter()
                    .filter(|(letter, _)| other.joint(*letter).is_some())
                    .copied()
                    .collect();
                let options = FeasibleOptions { held, ..coarse.clone() };
                if !reaches(other, task, &options) {
                    return Ok(None);
                }
                let way = can_make(other, task, &options, progress)?;
                Ok(way.ok().map(|way| Alternative {
                    code: other.code.clone(),
                    distance: candidate.distance,
                    changes: changes(machine, other),
                    way,
                }))
            })
            .collect();
        for one in tried {
            found.extend(one?);
        }
    }
    found.truncate(most);
    Ok(Nearest { layouts, classes: classes.len(), found })
}

/// The nearest layout of a class.
struct Candidate {
    machine: Machine,
    distance: usize,
}

/// The number of layouts, and the nearest one of each class, the nearest first; without the class of the asked machine.
fn classes(machine: &Machine) -> (usize, Vec<Candidate>) {
    let mut alphabet: Vec<Elementary> = Elementary::STANDARD.to_vec();
    alphabet.extend(machine.code.word().0.iter().filter(|m| !Elementary::STANDARD.contains(m)));
    let asked = machine.code.to_string();
    let own = machine.code.word().canonical();
    let mut words = Vec::new();
    orders(&alphabet, &mut Vec::new(), &mut words);
    let mut layouts = 0;
    let mut best: BTreeMap<Word, (usize, f64, CoordinateCode)> = BTreeMap::new();
    for word in words {
        let class = word.canonical();
        for bed in 0..=word.0.len() {
            let Ok(code) = CoordinateCode::new(word.clone(), bed) else { continue };
            layouts += 1;
            if class == own {
                continue;
            }
            let moved: f64 = moved_masses(&code, &Masses::default()).sum();
            let new = (edits(asked.as_bytes(), code.to_string().as_bytes()), moved, code);
            match best.get_mut(&class) {
                Some(old) if key(old) <= key(&new) => {}
                Some(old) => *old = new,
                None => {
                    best.insert(class.clone(), new);
                }
            }
        }
    }
    let mut sorted: Vec<_> = best.into_values().collect();
    sorted.sort_by_key(key);
    let candidate = |(distance, _, code): (usize, f64, CoordinateCode)| {
        let joint = |&motion: &Elementary| {
            let own = machine.joints.iter().find(|j| j.motion == motion);
            own.cloned().unwrap_or_else(|| Joint::standard(motion))
        };
        let joints = code.word().0.iter().map(joint).collect();
        // Bodies hang on axes by their places, which are others here.
        let machine = Machine {
            code,
            joints,
            name: String::new(),
            bodies: std::sync::Arc::default(),
            ..machine.clone()
        };
        machine.check().is_ok().then_some(Candidate { machine, distance })
    };
    (layouts, sorted.into_iter().filter_map(candidate).collect())
}

/// The order of layouts: changes, axes, mass moved to a millionth, digits.
fn key((distance, moved, code): &(usize, f64, CoordinateCode)) -> (usize, usize, i64, String) {
    #[expect(clippy::cast_possible_truncation, reason = "masses of links are small numbers")]
    let moved = (moved * 1e6).round() as i64;
    (*distance, code.word().0.len(), moved, code.to_string())
}

/// All orders of some of the letters.
fn orders(alphabet: &[Elementary], word: &mut Vec<Elementary>, list: &mut Vec<Word>) {
    if word.len() >= LEAST_AXES {
        list.push(Word(word.clone()));
    }
    if word.len() == MOST_AXES.min(MOST_JOINTS) {
        return;
    }
    for &motion in alphabet {
        if !word.contains(&motion) {
            word.push(motion);
            orders(alphabet, word, list);
            word.pop();
        }
    }
}

/// Number of changes from one text to another: a character more, less or another, two neighbours exchanged (Damerau's
/// distance in the restricted form, in which nothing is changed twice).
fn edits(a: &[u8], b: &[u8]) -> usize {
    let mut rows = vec![vec![0usize; b.len() + 1]; a.len() + 1];
    for (i, row) in rows.iter_mut().enumerate() {
        row[0] = i;
    }
    for (j, cell) in rows[0].iter_mut().enumerate() {
        *cell = j;
    }
    for i in 1..=a.len() {
        for j in 1..=b.len() {
            let other = usize::from(a[i - 1] != b[j - 1]);
            let mut least = (rows[i - 1][j] + 1).min(rows[i][j - 1] + 1).min(rows[i - 1][j - 1] + other);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            rows[i][j] = least;
        }
    }
    rows[a.len()][b.len()]
}

/// True if all joints together reach the middle and two corners of a task: without that no choice of them does it.
fn reaches(machine: &Machine, task: &Task<'_>, options: &FeasibleOptions) -> bool {
    let mut home = JointValues::zero(machine.joints.len());
    let mut free: Vec<usize> = (0..home.len()).collect();
    for &(letter, position) in &options.held {
        if let Some((place, _)) = machine.joint(letter) {
            if let Some(slot) = home.get_mut(place) {
                *slot = position;
            }
            free.retain(|&j| j != place);
        }
    }
    let tip = Rigid::from_translation(DVec3::Z * -options.tool_length + task.control);
    let chain = Kinematics::new(&machine.joints, machine.work, machine.spindle.after(&tip));
    Search::new(machine, &chain, task, home, task.nodes(options.cells)).reaches(&free)
}

/// Axes added and axes left out, in words; or a note that only the order differs.
fn changes(from: &Machine, to: &Machine) -> Vec<String> {
    let named = |motion: Elementary| {
        let axis = motion.letter().map_or_else(|| "about an inclined axis".to_owned(), String::from);
        if motion.is_rotation() { format!("a rotation {axis}") } else { format!("a translation {axis}") }
    };
    let only = |a: &Machine, b: &Machine| -> Vec<Elementary> {
        a.code.word().0.iter().copied().filter(|m| !b.code.has(*m)).collect()
    };
    let more = only(to, from).into_iter().map(|m| format!("with {}", named(m)));
    let less = only(from, to).into_iter().map(|m| format!("without {}", named(m)));
    let all: Vec<String> = more.chain(less).collect();
    if all.is_empty() { vec!["with the axes in another order".to_owned()] } else { all }
}

/// Axes of the layouts that are looked at.
const LEAST_AXES: usize = 2;
const MOST_AXES: usize = 5;
/// Classes that are tried side by side before it is asked whether enough are found: fixed, so that the answer does not
/// depend on the number of threads.
const BATCH: usize = 24;
/// Cells at which the laws of a layout are looked at.
const COARSE: [usize; 2] = [6, 4];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_of_a_code_are_counted() {
        for (a, b, wanted) in [
            ("2103", "2103", 0),
            ("2103", "52103", 1),
            ("2103", "1203", 1),
            ("6031", "2103", 3),
            ("", "12", 2),
        ] {
            assert_eq!(edits(a.as_bytes(), b.as_bytes()), wanted, "{a} {b}");
            assert_eq!(edits(b.as_bytes(), a.as_bytes()), wanted, "{b} {a}");
        }
    }

    #[test]
    fn all_layouts_are_looked_at() {
        let machine = Machine::of_code(CoordinateCode::parse("2103").unwrap_or_else(|_| unreachable!()));
        let (layouts, classes) = classes(&machine);
        // Orders of k out of 6 axes by the k + 1 places of the bed: 30*3 + 120*4 + 360*5 + 720*6.
        assert_eq!(layouts, 90 + 480 + 1800 + 4320);
        let five = |c: &&Candidate| {
            let word = &c.machine.code.word().0;
            word.len() == 5 && word.iter().filter(|m| !m.is_rotation()).count() == 3
        };
        // Three translations and two rotations: 72 classes.
        assert_eq!(classes.iter().filter(five).count(), 72);
        assert!(classes.windows(2).all(|w| w[0].distance <= w[1].distance));
        assert!(classes.iter().all(|c| c.distance > 0));
    }
}
