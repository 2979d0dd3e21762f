//! Words: sequences of elementary motions from the workpiece to the tool, without a bed.

use super::Elementary;
use crate::base::{Code, Finding, Result};

/// A word over elementary motions, from the workpiece to the tool; a motion may come in it more than once.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::Word;
/// let cone = Word::parse("6153").unwrap();
/// assert_eq!(cone.to_string(), "6153");
/// assert_eq!(Word::parse("631").unwrap().canonical().to_string(), "361");
/// assert_eq!(Word::parse("323").unwrap().canonical().to_string(), "23"); // 3 and 3 are one motion
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Word(pub Vec<Elementary>);

impl Word {
    /// Reads digits from 1 to 9; an empty text is the empty word.
    ///
    /// # Errors
    /// `KC0702` for a character that is no motion.
    pub fn parse(text: &str) -> Result<Word> {
        let read = |c: char| c.to_digit(10).and_then(|d| Elementary::from_digit(d as u8)).ok_or(c);
        text.chars().map(read).collect::<std::result::Result<Vec<_>, char>>().map(Word).map_err(|c| {
            Finding::error(Code::MACHINE_CODE, format!("`{text}` has `{c}`, which is no motion"))
                .help("write digits from 1 to 9: 1 2 3 translations along X Y Z, 4 5 6 rotations about them")
                .into()
        })
    }

    /// The representative of all words that differ by motions that change places: the smallest motion that can be
    /// brought to the front comes first, and so on; neighbours of one kind are merged.
    #[must_use]
    pub fn canonical(&self) -> Word {
        let mut rest = self.0.clone();
        let mut sorted: Vec<Elementary> = Vec::with_capacity(rest.len());
        while !rest.is_empty() {
            let free = (0..rest.len()).filter(|&i| rest[..i].iter().all(|&before| before.commutes(rest[i])));
            let Some(first) = free.min_by_key(|&i| (rest[i], i)) else { break };
            let motion = rest.remove(first);
            if sorted.last() != Some(&motion) {
                sorted.push(motion);
            }
        }
        Word(sorted)
    }
}

impl std::fmt::Display for Word {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.iter().try_for_each(|motion| write!(f, "{motion}"))
    }
}
