//! Comments that stay comments: text from a job cannot break out of a comment and become a block.

/// Longest piece of text in one comment: with its marks far below the 255 characters of most controls.
pub(super) const LONGEST: usize = 100;

/// First words by which LinuxCNC takes a comment for a command.
const MAGIC: &[&str] = &[
    "MSG",
    "DEBUG",
    "PRINT",
    "LOG",
    "LOGOPEN",
    "LOGAPPEND",
    "LOGCLOSE",
    "PROBEOPEN",
    "PROBECLOSE",
    "PY",
    "ABORT",
];

/// Splits text into lines that are safe between the marks of a comment: printable ASCII without brackets and
/// semicolons, not longer than a line, not a command of the control. No text gives no line.
pub(super) fn lines(text: &str, longest: usize) -> Vec<String> {
    let mut out = Vec::new();
    for line in text.lines() {
        let safe: String = line.chars().map(safe).collect();
        let mut rest = safe.trim();
        while !rest.is_empty() {
            let (line, more) = cut(rest, longest);
            out.push(tame(line));
            rest = more;
        }
    }
    out
}

/// Text in printable ASCII, cut at a blank where it is longer than a line.
pub(super) fn cut(text: &str, longest: usize) -> (&str, &str) {
    // ASCII only: every byte index is a boundary.
    let at = match text.len() {
        n if n <= longest => n,
        _ => text[..longest].rfind(' ').filter(|&at| at > 0).unwrap_or(longest),
    };
    (text[..at].trim_end(), text[at..].trim_start())
}

/// Text of a message in one line that stays between its marks: between quotes, or in round brackets.
pub(super) fn message(text: &str, quoted: bool) -> String {
    let inside = |c: char| match c {
        '"' if quoted => '\'',
        '(' if !quoted => '[',
        ')' if !quoted => ']',
        ' '..='~' => c,
        c if c.is_whitespace() => ' ',
        _ => '?',
    };
    text.trim().chars().map(inside).collect()
}

fn safe(c: char) -> char {
    match c {
        '(' => '[',
        ')' => ']',
        ';' => ',',
        ' '..='~' => c,
        c if c.is_whitespace() => ' ',
        _ => '?',
    }
}

fn tame(line: &str) -> String {
    let word: String = line.chars().take_while(char::is_ascii_alphanumeric).collect();
    let magic = MAGIC.iter().any(|m| word.to_ascii_uppercase().starts_with(m));
    if magic || line.starts_with('$') { format!("- {line}") } else { line.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::LONGEST;

    fn lines(text: &str) -> Vec<String> {
        super::lines(text, LONGEST)
    }
    use proptest::prelude::*;

    #[test]
    fn a_comment_cannot_be_closed_from_inside() {
        assert_eq!(lines("a) G0 Z-100 (b\nM30\r; x"), ["a] G0 Z-100 [b", "M30 , x"]);
        assert_eq!(lines(" \u{7}\t\n"), ["?"]);
        assert_eq!(lines("msg, hello"), ["- msg, hello"]);
        assert_eq!(lines("LogOpen,/x"), ["- LogOpen,/x"]);
        assert!(lines("").is_empty() && lines("  \n ").is_empty());
    }

    #[test]
    fn long_text_is_wrapped_at_blanks() {
        let text = "word ".repeat(60);
        let wrapped = lines(&text);
        assert!(wrapped.iter().all(|l| l.len() <= LONGEST));
        assert_eq!(wrapped.join(" "), text.trim_end());
        assert!(lines(&"x".repeat(1000)).iter().all(|l| l.len() <= LONGEST));
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn lines_are_plain_and_stable(text in any::<String>()) {
            let once = lines(&text);
            for line in &once {
                prop_assert!(line.bytes().all(|b| (b' '..=b'~').contains(&b) && !b"();".contains(&b)));
                prop_assert!(line.len() <= LONGEST + 2 && !line.is_empty());
            }
        }
    }
}
