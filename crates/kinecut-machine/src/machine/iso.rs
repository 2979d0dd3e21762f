//! Coordinate codes in the form of ISO 10791: `w C' A' X' Y' b Z (C1) t`.
//!
//! The chain from workpiece `w` to tool `t` with the bed `b`; axes that carry the work are primed, because their slide
//! moves against the positive direction of the axis. `(C1)` is the spindle: it turns the tool and is no axis of the
//! code. Rotations about inclined axes have no letter in the standard; here `Bn`, `Cn`, `An` are the digits 7, 8, 9.

use super::{CoordinateCode, Elementary, Word};
use crate::base::{Code, Finding, Result};

/// Names of the inclined rotations 7, 8, 9.
const INCLINED: [&str; 3] = ["Bn", "Cn", "An"];

impl Elementary {
    /// The name in a chain of ISO 10791: the letter, or `Bn`, `Cn`, `An` for the inclined rotations 7, 8, 9.
    pub fn iso(self) -> &'static str {
        match self {
            Elementary::X => "X",
            Elementary::Y => "Y",
            Elementary::Z => "Z",
            Elementary::A => "A",
            Elementary::B => "B",
            Elementary::C => "C",
            Elementary::Inclined(digit) => INCLINED[usize::from(digit.clamp(7, 9)) - 7],
        }
    }

    /// The motion of a name as [`Elementary::iso`] gives it, in either case; a digit from 1 to 9 too.
    pub fn from_iso(name: &str) -> Option<Elementary> {
        let all = (1..=9).filter_map(Elementary::from_digit);
        all.into_iter().find(|m| m.iso().eq_ignore_ascii_case(name) || m.to_string() == name)
    }
}

impl CoordinateCode {
    /// The chain in the form of ISO 10791.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::CoordinateCode;
    /// let code = CoordinateCode::parse("641203").unwrap();
    /// assert_eq!(code.iso(), "w C' A' X' Y' b Z (C1) t");
    /// assert_eq!(CoordinateCode::parse_any(&code.iso()).unwrap(), code);
    /// ```
    pub fn iso(&self) -> String {
        let (work, tool) = self.word().0.split_at(self.bed());
        let mut text = String::from("w ");
        for motion in work {
            text.push_str(motion.iso());
            text.push_str("' ");
        }
        text.push_str("b ");
        for motion in tool {
            text.push_str(motion.iso());
            text.push(' ');
        }
        text.push_str("(C1) t");
        text
    }

    /// Reads digits ("641203") or a chain of ISO 10791 ("w C' A' X' Y' b Z (C1) t"; blanks or hyphens between, `F` or `0`
    /// for the bed too; `w`, `t` and the spindle in brackets may be left out).
    ///
    /// # Errors
    /// `KC0702` for a name that is no motion, a motion that occurs twice, not exactly one bed, a prime on the tool side
    /// or a missing one on the work side, or words outside of `w` and `t`.
    pub fn parse_any(text: &str) -> Result<CoordinateCode> {
        let trimmed = text.trim();
        if trimmed.chars().all(|c| c.is_ascii_digit()) {
            return CoordinateCode::parse(trimmed);
        }
        parse_iso(trimmed)
    }
}

/// An error about a chain.
fn wrong(text: &str, what: &str) -> crate::base::Error {
    Finding::error(Code::MACHINE_CODE, format!("chain `{text}`: {what}"))
        .help(
            "write the axes from workpiece to tool, primed where they carry the work, as in \"w Y' X' b Z (C1) t\"",
        )
        .into()
}

/// Kind of a word of a chain.
enum ChainPart {
    Work,
    Tool,
    Bed,
    Spindle,
    Axis { motion: Elementary, primed: bool },
}

fn part(word: &str) -> Option<ChainPart> {
    let name = word.trim_end_matches(['\'', '\u{2032}', '\u{2019}', '*']);
    let primed = name.len() != word.len();
    match name {
        _ if name.starts_with('(') && name.ends_with(')') && !primed => Some(ChainPart::Spindle),
        "w" | "W" if !primed => Some(ChainPart::Work),
        "t" | "T" if !primed => Some(ChainPart::Tool),
        "b" | "F" | "f" | "0" if !primed => Some(ChainPart::Bed),
        // A small b is the bed, so axes of one letter are capitals.
        _ if name.len() == 1 && name.chars().all(|c| c.is_ascii_lowercase()) => None,
        _ => Elementary::from_iso(name).map(|motion| ChainPart::Axis { motion, primed }),
    }
}

fn parse_iso(text: &str) -> Result<CoordinateCode> {
    let words: Vec<&str> = text
        .split(|c: char| c.is_whitespace() || c == '-' || c == '\u{2013}')
        .filter(|w| !w.is_empty())
        .collect();
    let mut motions: Vec<(Elementary, bool)> = Vec::new();
    let mut bed = None;
    for (at, &word) in words.iter().enumerate() {
        let place = at + 1;
        let fail = |what: &str| Err(wrong(text, &format!("word {place}, `{word}`, {what}")));
        match part(word) {
            None => return fail("is no axis: X Y Z A B C, or Bn Cn An for inclined rotations"),
            Some(ChainPart::Work) if at == 0 => {}
            Some(ChainPart::Work) => return fail("is the workpiece, which stands first"),
            Some(ChainPart::Tool) if place == words.len() => {}
            Some(ChainPart::Tool) => return fail("is the tool, which stands last"),
            Some(ChainPart::Spindle) => {
                let last = words[place..].iter().all(|w| matches!(part(w), Some(ChainPart::Tool)));
                if !last {
                    return fail("is the spindle, which stands before the tool");
                }
            }
            Some(ChainPart::Bed) if bed.is_some() => return fail("is a second bed"),
            Some(ChainPart::Bed) => bed = Some(motions.len()),
            Some(ChainPart::Axis { motion, primed }) => {
                if motions.iter().any(|m| m.0 == motion) {
                    return fail("stands there a second time");
                }
                if primed && bed.is_some() {
                    return fail("is primed, but stands on the tool side of the bed");
                }
                motions.push((motion, primed));
            }
        }
    }
    let Some(bed) = bed else { return Err(wrong(text, "has no bed (b)")) };
    if let Some((motion, _)) = motions[..bed].iter().find(|m| !m.1) {
        let name = motion.iso();
        return Err(wrong(text, &format!("`{name}` carries the work and needs a prime: {name}'")));
    }
    CoordinateCode::new(Word(motions.into_iter().map(|m| m.0).collect()), bed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(text: &str) -> CoordinateCode {
        CoordinateCode::parse_any(text).unwrap()
    }

    #[test]
    fn chains_of_known_machines_are_read_and_written() {
        for (digits, chain) in [
            ("2103", "w Y' X' b Z (C1) t"),
            ("012365", "w b X Y Z C B (C1) t"),
            ("012367", "w b X Y Z C Bn (C1) t"),
            ("671203", "w C' Bn' X' Y' b Z (C1) t"),
            ("32104", "w Z' Y' X' b A (C1) t"),
        ] {
            assert_eq!(code(digits).iso(), chain);
            assert_eq!(code(chain).to_string(), digits);
        }
        assert_eq!(code("Y'-X'-F-Z").to_string(), "2103");
        assert_eq!(code(" w Y\u{2032} X\u{2032} b Z t").to_string(), "2103");
    }

    #[test]
    fn errors_say_which_word_is_wrong() {
        for (text, said) in [
            ("w Q' b Z t", "word 2, `Q'`"),
            ("w X' b X t", "word 4, `X`, stands there a second time"),
            ("w X' Y' Z' t", "has no bed"),
            ("w X' b Y b Z t", "a second bed"),
            ("w b X' t", "tool side"),
            ("w X b Z t", "`X` carries the work"),
            ("X' w b t", "stands first"),
            ("w t b X", "stands last"),
            ("w (C1) b X t", "before the tool"),
            ("2113", "has 0 beds"),
            ("21013", "motion 1 2 times"),
        ] {
            let message = CoordinateCode::parse_any(text).unwrap_err().to_string();
            assert!(message.contains(said), "{text}: {message}");
        }
    }
}
