//! Coordinate codes.

use super::{Elementary, Word};
use crate::base::{Code, Finding, Result};

/// A coordinate code: motions from workpiece to tool; 1 2 3 translations along X Y Z, 4 5 6 rotations about
/// them (A B C), 7 8 9 rotations about inclined axes, 0 the bed.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::CoordinateCode;
/// let code = CoordinateCode::parse("2103").unwrap();
/// assert_eq!(code.to_string(), "2103");
/// assert_eq!(code.axes().collect::<String>(), "YXZ");
/// assert!(CoordinateCode::parse("213").is_err()); // no bed
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CoordinateCode {
    word: Word,
    bed: usize,
}

impl CoordinateCode {
    /// Reads digits.
    ///
    /// # Errors
    /// `KC0702` for a digit that is no motion, a motion that occurs twice, or not exactly one bed.
    pub fn parse(text: &str) -> Result<CoordinateCode> {
        let fail = |what: String| {
            Err(Finding::error(Code::MACHINE_CODE, format!("coordinate code `{text}` {what}"))
                .help("write the motions from workpiece to tool, as in \"2103\": Y X bed Z")
                .into())
        };
        if let Some(c) = text.chars().find(|c| !c.is_ascii_digit()) {
            return fail(format!("has `{c}`, which is no motion"));
        }
        let beds = text.matches('0').count();
        if beds != 1 {
            return fail(format!("has {beds} beds (0), and needs one"));
        }
        let bed = text.find('0').unwrap_or(0);
        let word = Word::parse(&text.replace('0', ""))?;
        for (i, motion) in word.0.iter().enumerate() {
            if word.0[..i].contains(motion) {
                let times = word.0.iter().filter(|m| *m == motion).count();
                return fail(format!("has motion {motion} {times} times"));
            }
        }
        Ok(CoordinateCode { word, bed })
    }

    /// A code of a word whose motions all differ, with the bed after its first `bed` motions.
    ///
    /// # Errors
    /// `KC0702` for a motion that occurs twice, or a bed beyond the end.
    pub fn new(word: Word, bed: usize) -> Result<CoordinateCode> {
        let mut text = word.to_string();
        text.insert(bed.min(text.len()), '0');
        CoordinateCode::parse(&text)
    }

    /// The motions from workpiece to tool, without the bed.
    pub fn word(&self) -> &Word {
        &self.word
    }

    /// Number of motions on the work side of the bed.
    pub fn bed(&self) -> usize {
        self.bed
    }

    /// Letters of the standard axes from workpiece to tool, without the bed.
    pub fn axes(&self) -> impl Iterator<Item = char> + '_ {
        self.word.0.iter().filter_map(|motion| motion.letter())
    }

    /// True if the code has this motion.
    pub fn has(&self, motion: Elementary) -> bool {
        self.word.0.contains(&motion)
    }
}

impl std::fmt::Display for CoordinateCode {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (work, tool) = self.word.0.split_at(self.bed);
        work.iter().try_for_each(|motion| write!(f, "{motion}"))?;
        f.write_str("0")?;
        tool.iter().try_for_each(|motion| write!(f, "{motion}"))
    }
}
