//! Sets of layouts to search.

use super::{class_words, orders};
use crate::base::{Code, Finding, Result};
use crate::machine::{CoordinateCode, Elementary, Word};

/// The 12 regular classes of three translations and two rotations: X, Y and Z can be brought together, so that they
/// stay at right angles whatever the rotary axes do; the tool's axis is Z.
pub const REGULAR_CLASSES: [&str; 12] = [
    "12345", "12354", "12364", "12365", "14235", "25134", "36124", "36125", "42513", "51423", "61423",
    "62513",
];

/// A set of layouts to search.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Search {
    /// Those that position like this word: all words of its commutation class.
    Class(Word),
    /// All orders of these motions.
    Motions(Vec<Elementary>),
    /// The regular classes of five axes ([`REGULAR_CLASSES`]).
    Regular,
}

impl Search {
    /// Reads what a user writes: a code ("641203") or chain of ISO 10791 for its class, digits without bed ("613") too;
    /// letters ("XYZAC") for a set of motions in any order; "regular".
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::layouts::Search;
    /// assert_eq!(Search::parse("XYZ").unwrap().codes().unwrap().len(), 24);
    /// assert_eq!(Search::parse("2103").unwrap().codes().unwrap().len(), 24);
    /// assert_eq!(Search::parse("regular").unwrap().codes().unwrap().len(), 648);
    /// ```
    ///
    /// # Errors
    /// `KC0702` as [`CoordinateCode::parse_any`]; for a letter that is no axis or comes twice, and for an empty text.
    pub fn parse(text: &str) -> Result<Search> {
        let text = text.trim();
        if text.is_empty() {
            return Err(help(Finding::error(Code::MACHINE_CODE, "no axes are given")).into());
        }
        if text.eq_ignore_ascii_case("regular") {
            return Ok(Search::Regular);
        }
        if text.chars().all(|c| c.is_ascii_digit()) {
            if text.contains('0') {
                return CoordinateCode::parse(text).map(|code| Search::Class(code.word().clone()));
            }
            return Word::parse(text).map(Search::Class);
        }
        let is_chain = text.chars().any(|c| c.is_whitespace() || "-–'′’".contains(c));
        if is_chain {
            return CoordinateCode::parse_any(text).map(|code| Search::Class(code.word().clone()));
        }
        let mut motions: Vec<Elementary> = Vec::new();
        let mut rest = text;
        while let Some(c) = rest.chars().next() {
            let column = text.len() - rest.len() + 1;
            let length = if rest[c.len_utf8()..].starts_with('n') { 2 } else { c.len_utf8() };
            let name = &rest[..length];
            let known = if c.is_ascii_digit() { None } else { Elementary::from_iso(name) };
            let Some(motion) = known else {
                let what = format!("axes `{text}`: `{name}` in place {column} is no axis");
                return Err(help(Finding::error(Code::MACHINE_CODE, what)).into());
            };
            if motions.contains(&motion) {
                let what = format!("axes `{text}`: {} stands a second time in place {column}", motion.iso());
                return Err(help(Finding::error(Code::MACHINE_CODE, what)).into());
            }
            motions.push(motion);
            rest = &rest[length..];
        }
        Ok(Search::Motions(motions))
    }

    /// The words, each class by itself where there are several, sorted within.
    ///
    /// # Errors
    /// `KC1121` for more than eight motions; `KC0702` for a motion that occurs twice in a set.
    pub fn words(&self) -> Result<Vec<Word>> {
        match self {
            Search::Class(word) => class_words(word),
            Search::Motions(motions) => orders(motions),
            Search::Regular => {
                let mut words = Vec::new();
                for class in REGULAR_CLASSES {
                    words.extend(class_words(&Word::parse(class)?)?);
                }
                Ok(words)
            }
        }
    }

    /// The codes: each word with each position of the bed. Equal motions that become neighbours are one motion.
    ///
    /// # Errors
    /// Those of [`Search::words`]; `KC0702` when a motion occurs twice with another one between: a machine whose axes
    /// differ does not do that, one of the two must be set or belong to the tool.
    pub fn codes(&self) -> Result<Vec<CoordinateCode>> {
        let mut codes = Vec::new();
        let mut words = self.words()?;
        for word in &mut words {
            word.0.dedup();
        }
        let repeated = |word: &Word| word.0.iter().enumerate().any(|(i, m)| word.0[..i].contains(m));
        // A class in which a motion is apart from its equal has other words in which it is not.
        if words.iter().any(repeated) {
            if words.iter().all(repeated) {
                return Err(self.repeated(&words[0]).into());
            }
            words.retain(|word| !repeated(word));
            words.sort();
            words.dedup();
        }
        for word in words {
            for bed in 0..=word.0.len() {
                codes.push(CoordinateCode::new(word.clone(), bed)?);
            }
        }
        Ok(codes)
    }

    fn repeated(&self, word: &Word) -> Finding {
        let twice =
            word.0.iter().enumerate().find(|(i, m)| word.0[..*i].contains(m)).map_or("", |(_, m)| m.iso());
        Finding::error(
            Code::MACHINE_CODE,
            format!("code `{word}` has {twice} twice with a motion between that does not commute with it"),
        )
        .help("a machine has an axis once: let one of the two be set, or belong to the tool")
    }
}

fn help(finding: Finding) -> Finding {
    finding.help("write a code (\"2103\"), a chain (\"w Y' X' b Z t\"), letters in any order (\"XYZAC\"), or \"regular\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_user_writes_is_understood() {
        let word = |t: &str| Search::Class(Word::parse(t).unwrap());
        assert_eq!(Search::parse("641203").unwrap(), word("64123"));
        assert_eq!(Search::parse("w C' A' X' Y' b Z (C1) t").unwrap(), word("64123"));
        assert_eq!(Search::parse("613").unwrap(), word("613"));
        let five = Search::parse("XYZCBn").unwrap();
        assert_eq!(five, Search::parse("xyzcBn").unwrap());
        assert_eq!(five.words().unwrap().len(), 120);
    }

    #[test]
    fn errors_name_the_place() {
        for (text, said) in [
            ("XYQ", "`Q` in place 3"),
            ("XYZX", "X stands a second time in place 4"),
            ("", "no axes"),
            ("64X", "`6` in place 1"),
            ("Ä", "`Ä` in place 1"),
            ("2003", "2 beds"),
        ] {
            let message = Search::parse(text).unwrap_err().to_string();
            assert!(message.contains(said), "{text}: {message}");
        }
        let twice = Search::parse("61613").unwrap().codes().unwrap_err().to_string();
        assert!(twice.contains("twice"), "{twice}");
    }

    #[test]
    fn a_quill_over_a_slide_is_one_motion() {
        let merged = Search::parse("3123").unwrap().codes().unwrap();
        assert_eq!(merged, Search::parse("312").unwrap().codes().unwrap());
    }
}
