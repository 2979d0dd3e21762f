//! The words of a commutation class, and of a set of motions.
//!
//! Two words are of one class when they differ by neighbours that change places (`Elementary::commutes`): the machines
//! then position alike. The words of a class are the linear extensions of its dependence order: a motion may come next
//! when all motions before it in the word that do not commute with it are placed already.

use crate::base::{Code, Finding, Result};
use crate::machine::{Elementary, MOST_JOINTS, Word};

/// All words of the commutation class of a word, sorted; motions may come in it more than once.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::{Word, layouts::class_words};
/// let words = class_words(&Word::parse("613").unwrap()).unwrap();
/// assert_eq!(words.iter().map(|w| w.to_string()).collect::<Vec<_>>(), ["361", "613", "631"]);
/// ```
///
/// # Errors
/// `KC1121` for more than eight motions.
pub fn class_words(word: &Word) -> Result<Vec<Word>> {
    check_length(word.0.len())?;
    let before = word.0.iter().enumerate().map(|(i, &motion)| {
        let earlier = word.0[..i].iter().enumerate();
        // Equal motions commute, but keep their order: otherwise a word would be found twice.
        earlier.filter(|(_, m)| !m.commutes(motion) || **m == motion).fold(0u16, |set, (j, _)| set | 1 << j)
    });
    let before: Vec<u16> = before.collect();
    let mut words = Vec::new();
    extend(&word.0, &before, 0, &mut Vec::with_capacity(word.0.len()), &mut words);
    words.sort();
    Ok(words)
}

/// All orders of distinct motions, sorted.
///
/// # Errors
/// `KC1121` for more than eight motions; `KC0702` for a motion that occurs twice.
pub fn orders(motions: &[Elementary]) -> Result<Vec<Word>> {
    check_length(motions.len())?;
    let mut sorted = motions.to_vec();
    sorted.sort_unstable();
    if let Some(pair) = sorted.windows(2).find(|p| p[0] == p[1]) {
        return Err(Finding::error(
            Code::MACHINE_CODE,
            format!("the set of axes has {} more than once", pair[0].iso()),
        )
        .help("name each axis once")
        .into());
    }
    let none = vec![0; sorted.len()];
    let mut words = Vec::new();
    extend(&sorted, &none, 0, &mut Vec::with_capacity(sorted.len()), &mut words);
    Ok(words)
}

/// Puts every motion that may come next, by depth first.
fn extend(all: &[Elementary], before: &[u16], used: u16, word: &mut Vec<Elementary>, words: &mut Vec<Word>) {
    if word.len() == all.len() {
        words.push(Word(word.clone()));
        return;
    }
    for (i, &motion) in all.iter().enumerate() {
        if used & (1 << i) == 0 && before[i] & !used == 0 {
            word.push(motion);
            extend(all, before, used | 1 << i, word, words);
            word.pop();
        }
    }
}

fn check_length(len: usize) -> Result<()> {
    if len <= MOST_JOINTS {
        return Ok(());
    }
    Err(Finding::error(Code::LAYOUT_SEARCH, "too many motions to list their layouts")
        .value(len as f64, "")
        .bound(MOST_JOINTS as f64, "")
        .help("leave out motions that are only set")
        .into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// By brute force: all permutations whose canonical word is the same.
    fn by_permutations(word: &Word) -> BTreeSet<Word> {
        fn all(rest: Vec<Elementary>) -> BTreeSet<Vec<Elementary>> {
            if rest.is_empty() {
                return BTreeSet::from([Vec::new()]);
            }
            let mut found = BTreeSet::new();
            for i in 0..rest.len() {
                let mut others = rest.clone();
                let first = others.remove(i);
                found.extend(all(others).into_iter().map(|tail| [vec![first], tail].concat()));
            }
            found
        }
        // Two letters are in the same order in both words iff they do not commute: projections on pairs.
        let same = |other: &[Elementary]| {
            word.0.iter().all(|a| {
                word.0.iter().filter(|b| !a.commutes(**b)).all(|b| {
                    let on = |w: &[Elementary]| {
                        w.iter().filter(|m| *m == a || *m == b).copied().collect::<Vec<_>>()
                    };
                    on(&word.0) == on(other)
                })
            })
        };
        all(word.0.clone()).into_iter().filter(|w| same(w)).map(Word).collect()
    }

    #[test]
    fn classes_are_those_found_by_permutations() {
        for text in ["", "1", "321", "6153", "65361", "61613", "63151", "123653", "6313", "731"] {
            let word = Word::parse(text).unwrap();
            let words = class_words(&word).unwrap();
            assert_eq!(words, by_permutations(&word).into_iter().collect::<Vec<_>>(), "{text}");
        }
    }

    #[test]
    fn sets_are_checked() {
        assert_eq!(orders(&[Elementary::Z, Elementary::X]).unwrap().len(), 2);
        assert!(
            orders(&[Elementary::X, Elementary::X]).unwrap_err().to_string().contains("X more than once")
        );
        assert!(class_words(&Word::parse("123456123").unwrap()).is_err());
    }
}
