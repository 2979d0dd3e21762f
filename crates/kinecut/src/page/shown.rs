//! Text from outside made harmless for what shows it: a page, inline JSON, a terminal.
//!
//! Markup is escaped by the HTML writer itself; here only what stays dangerous or misleading after that:
//! control characters (ESC, NUL, line ends inside a line) and the marks that turn the direction of text
//! around, with which a comment can be made to look like other code.

use std::borrow::Cow;
use std::fmt::Write as _;

use maud::{Markup, html};

/// Marks that change the direction of text, end a line, or cannot be seen at all.
fn misleads(c: char) -> bool {
    matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}' | '\u{061c}')
}

/// The text with each control character as its picture (ESC as `␛`) and each mark of direction as `⟨U+202E⟩`; a tab
/// becomes a blank.
///
/// ```
/// assert_eq!(kinecut::page::visible("a\u{1b}[2Jb\n"), "a␛[2Jb␊");
/// ```
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.chars().any(|c| c.is_control() || misleads(c)) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        match c {
            '\t' => out.push(' '),
            '\u{7f}' => out.push('␡'),
            c if (c as u32) < 0x20 => out.extend(char::from_u32(0x2400 + c as u32)),
            c if c.is_control() || misleads(c) => put_code(&mut out, c),
            c => out.push(c),
        }
    }
    Cow::Owned(out)
}

/// The text for a terminal: control characters as `\x1b`, marks of direction as `⟨U+202E⟩`.
///
/// ```
/// assert_eq!(kinecut::page::terminal("a\u{1b}[2J"), "a\\x1b[2J");
/// ```
pub fn terminal(text: &str) -> Cow<'_, str> {
    if !text.chars().any(|c| c.is_control() || misleads(c)) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        if c.is_control() {
            // Writing to a String cannot fail.
            let _ = write!(out, "\\x{:02x}", c as u32);
        } else if misleads(c) {
            put_code(&mut out, c);
        } else {
            out.push(c);
        }
    }
    Cow::Owned(out)
}

/// A sentence for a page: [`visible`], and text between backticks as code.
pub(crate) fn prose(text: &str) -> Markup {
    let text = visible(text);
    // An odd backtick at the end quotes nothing.
    let last = text.matches('`').count() & !1;
    html! {
        @for (i, bit) in text.splitn(last + 1, '`').enumerate() {
            @if i % 2 == 1 { code { (bit) } } @else { (bit) }
        }
    }
}

fn put_code(out: &mut String, c: char) {
    // Writing to a String cannot fail.
    let _ = write!(out, "⟨U+{:04X}⟩", c as u32);
}

/// JSON text that is safe inside a `<script>` element: no `<`, `>`, `&`, U+2028, U+2029 stays, all of which can only
/// occur inside JSON strings, where an escape means the same.
///
/// ```
/// assert_eq!(kinecut::page::inline_json(r#"["</script>"]"#), r#"["\u003c/script\u003e"]"#);
/// ```
pub fn inline_json(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    for c in json.chars() {
        match c {
            '<' => out.push_str("\\u003c"),
            '>' => out.push_str("\\u003e"),
            '&' => out.push_str("\\u0026"),
            '\u{2028}' => out.push_str("\\u2028"),
            '\u{2029}' => out.push_str("\\u2029"),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn direction_marks_and_c1_controls_are_spelled_out() {
        assert_eq!(visible("x\u{202e}y\u{9b}z"), "x⟨U+202E⟩y⟨U+009B⟩z");
        assert_eq!(terminal("x\u{202e}y\u{9b}z\t"), "x⟨U+202E⟩y\\x9bz\\x09");
        assert!(matches!(visible("Ø 200 µm — ok"), Cow::Borrowed(_)));
    }

    #[test]
    fn backticks_quote_code_and_an_odd_one_stays() {
        assert_eq!(prose("`a` and `<b>`").into_string(), "<code>a</code> and <code>&lt;b&gt;</code>");
        assert_eq!(prose("a ` b").into_string(), "a ` b");
        assert_eq!(prose("`a` ` b").into_string(), "<code>a</code> ` b");
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn nothing_shown_can_steer_a_terminal_or_leave_a_script(text in any::<String>()) {
            prop_assert!(visible(&text).chars().all(|c| !c.is_control()));
            prop_assert!(terminal(&text).chars().all(|c| !c.is_control()));
            let json = serde_json::to_string(&text).expect("a string is JSON");
            let inline = inline_json(&json);
            let breaks = inline.contains(['<', '>', '&', '\u{2028}', '\u{2029}']);
            prop_assert!(!breaks);
            prop_assert_eq!(serde_json::from_str::<String>(&inline).expect("still JSON"), text);
        }
    }
}
