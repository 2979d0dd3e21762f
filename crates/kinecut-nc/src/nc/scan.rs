//! Search for lines of a text by a letter that they must have.

/// Bytes that are looked at together.
const STEP: usize = 64;

/// The first place from `from` on of a letter, capital or small.
fn next_letter(bytes: &[u8], from: usize, letter: u8) -> Option<usize> {
    let is = |b: u8| b | 0x20 == letter | 0x20;
    let mut at = from;
    // A fold without a way out is done by many bytes at once.
    while let Some(step) = bytes.get(at..at + STEP)
        && !step.iter().fold(false, |found, b| found | is(*b))
    {
        at += STEP;
    }
    bytes[at.min(bytes.len())..].iter().position(|b| is(*b)).map(|n| at + n)
}

/// The lines that have a letter, capital or small: the first byte of each, and the one behind its line end.
pub(super) fn lines_with(text: &str, letter: u8) -> impl Iterator<Item = (usize, usize)> + '_ {
    let bytes = text.as_bytes();
    let mut next = 0;
    std::iter::from_fn(move || {
        let at = next_letter(bytes, next, letter)?;
        let start = bytes[next..at].iter().rposition(|b| *b == b'\n').map_or(next, |n| next + n + 1);
        next = bytes[at..].iter().position(|b| *b == b'\n').map_or(bytes.len(), |n| at + n + 1);
        Some((start, next))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_found_wherever_its_letter_stands() {
        for width in [1, 3, 63, 64, 65, 200] {
            let line = |i: usize| match i % 4 {
                0 => format!("{}O\n", "x".repeat(width)),
                1 => format!("o{}\n", "1".repeat(width)),
                2 => "\n".to_owned(),
                _ => format!("G1 X{}o1o\n", " ".repeat(width)),
            };
            let text: String = (0..40).map(line).collect::<String>() + "G0 o";
            let lines: Vec<&str> =
                lines_with(&text, b'O').map(|(start, after)| &text[start..after]).collect();
            let all = text.split_inclusive('\n').filter(|line| line.contains(['o', 'O']));
            assert_eq!(lines, all.collect::<Vec<_>>());
        }
        assert!(lines_with("", b'O').next().is_none());
    }
}
