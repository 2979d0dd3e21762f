//! Words of a program's text, for facts that the program as read does not keep: the block of a word that only switches,
//! and whether a word was written at all. No reading of its meaning.

use crate::job::SetupOutcome;
use crate::nc::Control;

/// A line without its comments, in capitals.
#[derive(Clone, Debug)]
pub(super) struct Text(Vec<u8>);

impl Text {
    pub(super) fn of(line: &str, control: Control) -> Text {
        // On SINUMERIK and HEIDENHAIN round brackets are no comments.
        let brackets = !matches!(control, Control::Sinumerik840d | Control::Heidenhain);
        let mut depth = 0u32;
        let mut kept = Vec::new();
        for c in line.bytes() {
            match c {
                b';' if depth == 0 => break,
                b'(' if brackets => depth += 1,
                b')' if brackets => depth = depth.saturating_sub(1),
                _ if depth == 0 => kept.push(c.to_ascii_uppercase()),
                _ => {}
            }
        }
        Text(kept)
    }

    /// Whether an address with a value is here: `S3000`, `S1=3000`, `F=R1`, `FQ5`, `FZ0.1`.
    pub(super) fn has_word(&self, address: u8) -> bool {
        let t = &self.0;
        (0..t.len()).filter(|&i| t[i] == address).any(|i| {
            let letter_before = i > 0 && (t[i - 1].is_ascii_alphabetic() || t[i - 1] == b'_');
            let rest: Vec<u8> = t[i + 1..].iter().copied().filter(|c| *c != b' ').take(2).collect();
            let value = |c: u8| c.is_ascii_digit() || matches!(c, b'.' | b'+' | b'-' | b'=' | b'#');
            !letter_before
                && match rest[..] {
                    [c, ..] if value(c) => true,
                    [b'Q' | b'Z' | b'U', c] => value(c),
                    _ => false,
                }
        })
    }

    /// Whether a code of one digit is here, with a leading nought or without: `M4`, `M04`.
    pub(super) fn has_code(&self, address: u8, digit: u8) -> bool {
        let t = &self.0;
        (0..t.len()).filter(|&i| t[i] == address).any(|i| {
            let letter_before = i > 0 && t[i - 1].is_ascii_alphabetic();
            let zeros = t[i + 1..].iter().take_while(|c| **c == b'0').count();
            let after = t.get(i + 2 + zeros);
            !letter_before
                && t.get(i + 1 + zeros) == Some(&digit)
                && after.is_none_or(|c| !c.is_ascii_digit() && *c != b'.')
        })
    }

    /// Whether the text has these letters.
    pub(super) fn has(&self, what: &str) -> bool {
        self.0.windows(what.len()).any(|w| w == what.as_bytes())
    }
}

/// The last line with something, from the block of an item back to that of the item before: a block that only switches
/// something makes no item of its own.
pub(super) fn line_with(done: &SetupOutcome, item: u32, test: impl Fn(&Text) -> bool) -> Option<u32> {
    let to = done.lines.get(item as usize).copied().flatten()?;
    let from = (0..item).rev().find_map(|i| done.lines[i as usize]).filter(|l| *l < to).map_or(0, |l| l + 1);
    let control = done.external.as_ref()?.control;
    let lines: Vec<&str> = done.posted.text.lines().collect();
    (from..=to).rev().find(|l| lines.get(*l as usize).is_some_and(|t| test(&Text::of(t, control))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_found_and_comments_and_other_words_are_not() {
        let has = |line: &str, control| Text::of(line, control).has_word(b'S');
        for line in ["G0X1.S3000M3", "s 3000", "S=R1", "S1=500", "N10 S+500"] {
            assert!(has(line, Control::Sinumerik840d), "{line}");
        }
        for line in ["G0 X1 (S3000)", "; S3000", "SPOS=3", "CYCLES1(2)", "G53 X1"] {
            assert!(!has(line, Control::Fanuc), "{line}");
        }
        let feed = |line: &str| Text::of(line, Control::Heidenhain).has_word(b'F');
        assert!(feed("L X+1 F200") && feed("L X+1 FQ5") && feed("L X+1 FZ0.1"));
        assert!(!feed("L X+1 FMAX") && !feed("L X+1 F AUTO"));
        let m4 = |line: &str| Text::of(line, Control::Fanuc).has_code(b'M', b'4');
        assert!(m4("S1M4") && m4("M04 S1") && !m4("M40") && !m4("(M4)") && !m4("M3"));
    }
}
