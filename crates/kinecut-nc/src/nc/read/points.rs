//! Numbers without a decimal point on a FANUC control: which of their two meanings counts.

use crate::base::{Code as FindingCode, Finding, Result};
use crate::nc::NumberInput;
use crate::nc::dialect::{Code, Dialect};

use super::block::Word;
use super::modal::FeedMode;
use super::reader::Reader;

/// Letters of coordinates.
const LENGTHS: [u8; 7] = [b'X', b'Y', b'Z', b'I', b'J', b'K', b'R'];

/// Coordinates without a decimal point, in a program.
#[derive(Debug, Default)]
pub(super) struct Points {
    input: NumberInput,
    /// They are whole units, not least increments.
    pub(super) in_units: bool,
    /// Another coordinate of the text has a point.
    mixed: bool,
    /// The first was said.
    said: bool,
    /// A feed without a point was said (Haas).
    feed_said: bool,
    /// The first of the present block that counts increments, as help for an arc that it does not fit.
    pub(super) increment: Option<String>,
}

impl Points {
    pub(super) fn of(text: &str, dialect: &Dialect, input: NumberInput) -> Points {
        let mixed = dialect.point && has_point(text);
        let in_units = match input {
            NumberInput::Calculator => true,
            NumberInput::LeastIncrement => false,
            NumberInput::Auto => dialect.point && !mixed,
        };
        Points { input, in_units, mixed, ..Points::default() }
    }
}

impl<'s> Reader<'s> {
    /// Gives the numbers of a block without a decimal point, and those that are computed, their values.
    pub(super) fn numbers_without_point(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        self.points.increment = None;
        let own_words = self.mode().map_or(&[] as &[&str], |(mode, _)| mode.words);
        let scales = self.code(|c| c == (Code::Scale { on: true })).is_some();
        if scales {
            self.factors_without_point(words)?;
        }
        let inch = match self.code(|c| matches!(c, Code::Units { .. })) {
            Some((Code::Units { inch, .. }, _)) => inch,
            _ => self.modal.length_unit != 1.0,
        };
        let step = if inch { 0.0001 } else { 0.001 };
        let has = |code: Code| self.codes.iter().any(|(c, _)| *c == code);
        let per_revolution = match self.modal.feed_mode {
            FeedMode::PerRevolution => !has(Code::FeedPerMinute) && !has(Code::InverseTime),
            _ => has(Code::FeedPerRevolution),
        };
        let feature = has(Code::Tilt);
        let pattern = self.code(|c| matches!(c, Code::Holes(_))).is_some();
        let axis = self.centre_is_axis() || has(Code::TipControl { vector: true });
        // A Haas counts by L.
        let lengths_k = self.curved() || feature || axis || self.dialect.haas;
        let (dwells, turns) = (has(Code::Dwell), has(Code::Rotation { on: true }));
        let is = |word: &Word<'_>, names: &[&str]| names.iter().any(|n| word.is(n));
        let mut without = None;
        for word in words.iter_mut().filter(|w| !(scales && is(w, &["P", "I", "J", "K"]) || is(w, own_words)))
        {
            let length_k = is(word, &["K"]) && lengths_k;
            let count = is(word, &["P", "T", "H", "D", "O", "N"])
                || is(word, &["K"]) && !length_k
                || is(word, &["Q"]) && feature;
            let angle = is(word, &["R"]) && turns
                || is(word, &["J"]) && pattern
                || is(word, &["K"]) && pattern
                || is(word, &["A", "B", "C"])
                || is(word, &["I", "J", "K"]) && feature;
            let seconds = is(word, &["X"]) && dwells;
            let length =
                !angle && !seconds && (is(word, &["X", "Y", "Z", "I", "J", "R", ",R", ",C"]) || length_k);
            let depth = is(word, &["Q"]) && !feature;
            if word.computed {
                let step =
                    if count || is(word, &["S"]) { Some(1.0) } else { (length || depth).then_some(step) };
                if let (Some(step), Some(value)) = (step, &mut word.value) {
                    *value = (*value / step).round() * step;
                }
                continue;
            }
            if word.point && count && self.dialect.haas && is(word, &["P"]) {
                // Seconds, where a number without a point is milliseconds.
                if let Some(value) = &mut word.value {
                    *value *= 1e3;
                }
                continue;
            }
            if word.point && count {
                let finding =
                    self.place.malformed(&word.bytes, "it is a count here, write it without a decimal point");
                return Err(finding.into());
            }
            let unit = if word.point || count || self.points.in_units {
                1.0
            } else if angle || seconds {
                0.001
            } else if length || depth {
                step
            } else if is(word, &["F"]) && per_revolution {
                if inch { 0.0001 } else { 0.01 }
            } else {
                1.0
            };
            if self.dialect.haas && is(word, &["F"]) && !word.point && !self.points.feed_said {
                self.points.feed_said = true;
                let message = "a feed without a decimal point counts by setting 77: whole units are assumed";
                let finding = self.place.warning(FindingCode::NC_ASSUMED, &word.bytes, message);
                self.findings.push(finding.help("write it with a point"));
            }
            let Some(value) = &mut word.value else { continue };
            let written = *value;
            *value *= unit;
            // A nought is one either way.
            if length && !word.point && written != 0.0 && without.is_none() {
                without = Some(self.without_point(word, written, inch));
            }
        }
        if let Some(finding) = without {
            if !self.points.in_units {
                self.points.increment = Some(format!("{}: {}", finding.message, finding.help));
            }
            if !self.points.said {
                self.points.said = true;
                self.findings.push(finding);
            }
        }
        Ok(())
    }

    /// Finding for a coordinate without a decimal point.
    fn without_point(&self, word: &Word<'_>, written: f64, inch: bool) -> Finding {
        let name = word.name;
        let value = (word.value.unwrap_or_default() * 1e4).round() / 1e4;
        let others = if self.points.mixed {
            ", other coordinates of the program have one"
        } else {
            ", nor has any other coordinate of the program"
        };
        let unit = if inch { "inch" } else { "mm" };
        let how = if self.points.in_units { "in whole units" } else { "in least increments" };
        let said = format!(
            "`{name}{written}` has no decimal point{others}: read as {value} {unit}, {how} (parameter 3401)"
        );
        let finding = self.place.warning(FindingCode::NC_ASSUMED, &word.bytes, &said);
        match (self.points.input, self.points.in_units) {
            (NumberInput::Auto, true) => {
                finding.help("say how the control is set: --input calculator or --input least-increment")
            }
            (_, true) => {
                finding.help(format!("write {name}{written}. so that it is read so on every control"))
            }
            (_, false) => finding.help(format!("write {name}{written}. if that is meant")),
        }
    }
}

/// Whether a coordinate of a text has a decimal point.
fn has_point(text: &str) -> bool {
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let byte = bytes[at].to_ascii_uppercase();
        at += 1;
        match byte {
            b'(' => at += bytes[at..].iter().position(|b| matches!(b, b')' | b'\n')).unwrap_or(0),
            b';' => at += bytes[at..].iter().position(|b| *b == b'\n').unwrap_or(0),
            letter if LENGTHS.contains(&letter) => {
                let number =
                    bytes[at..].iter().take_while(|b| matches!(b, b'0'..=b'9' | b'.' | b'+' | b'-' | b' '));
                let mut digits = false;
                for digit in number {
                    at += 1;
                    if *digit == b'.' && (digits || bytes.get(at).is_some_and(u8::is_ascii_digit)) {
                        return true;
                    }
                    digits |= digit.is_ascii_digit();
                }
            }
            _ => {}
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_of_a_coordinate_is_found_wherever_it_is() {
        assert!(has_point("G0 X1 Y.5"));
        assert!(has_point("g1x5."));
        assert!(has_point("(A)\nG2 I- 1.5"));
        assert!(!has_point("(X1.5)\nG0 X15 F1.5 ;Y2.5\nG4 P1"));
        assert!(!has_point("X . Y"));
    }
}
