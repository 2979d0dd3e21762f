//! Arrangements of a word: the orders of its motions that make the same movement.

use super::super::{Elementary, Word};

/// All different words that differ from this one by motions that change places, in the order of their digits. Equal
/// neighbours stay apart.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::{Word, surface::arrangements};
/// let words: Vec<String> = arrangements(&Word::parse("613").unwrap()).iter().map(Word::to_string).collect();
/// assert_eq!(words, ["361", "613", "631"]);
/// ```
pub fn arrangements(word: &Word) -> Vec<Word> {
    let mut words = Vec::new();
    grow(&mut Vec::with_capacity(word.0.len()), &word.0, &mut words);
    words
}

fn grow(front: &mut Vec<Elementary>, rest: &[Elementary], words: &mut Vec<Word>) {
    if rest.is_empty() {
        words.push(Word(front.clone()));
        return;
    }
    let mut firsts: Vec<usize> =
        (0..rest.len()).filter(|&i| rest[..i].iter().all(|&before| before.commutes(rest[i]))).collect();
    // Of equal motions only the first: taking the second would give the same word again.
    firsts.sort_by_key(|&i| (rest[i], i));
    firsts.dedup_by_key(|i| rest[*i]);
    for i in firsts {
        let mut others = rest.to_vec();
        front.push(others.remove(i));
        grow(front, &others, words);
        front.pop();
    }
}
