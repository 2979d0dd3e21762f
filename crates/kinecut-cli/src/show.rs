//! Everything that this program prints, and the one place where it is made harmless.
//!
//! Text for a person goes through [`put`] and [`complain`]: whatever stands in it, no character of it steers a terminal. Data
//! for another program ([`data`], [`json`]) stays byte for byte what it is in a pipe; on a terminal it is text for a person.

use std::borrow::Cow;
use std::fmt::Display;
use std::io::{IsTerminal as _, Write as _};

use kinecut::page::terminal;

/// Text that was made harmless: what [`plain`] gives, and findings, whose parts were before they were coloured.
pub(crate) struct Shown(String);

impl Shown {
    /// Text that has colours of our own around parts that are harmless.
    pub(crate) fn coloured(text: String) -> Shown {
        Shown(text)
    }
}

/// Text of any origin, its line ends kept.
pub(crate) fn plain(text: impl Display) -> Shown {
    let text = text.to_string();
    let lines: Vec<Cow<'_, str>> = text.split('\n').map(terminal).collect();
    Shown(lines.join("\n"))
}

/// A text that can be shown.
pub(crate) trait Show {
    fn shown(self) -> Shown;
}

impl Show for Shown {
    fn shown(self) -> Shown {
        self
    }
}

impl<T: Display> Show for T {
    fn shown(self) -> Shown {
        plain(self)
    }
}

/// Text on standard output. A reader that has had enough (`| head`) is no error.
pub(crate) fn put(text: impl Show) {
    write(text.shown().0.as_bytes());
}

/// A line on standard error.
pub(crate) fn complain(text: impl Show) {
    // Nobody is left to hear of a failure.
    let _ = writeln!(std::io::stderr(), "{}", text.shown().0);
}

/// An NC program or a machine file on standard output.
pub(crate) fn data(text: &str) {
    if std::io::stdout().is_terminal() { put(text) } else { write(text.as_bytes()) }
}

/// A JSON document, or a piece of one: it has nothing that steers a terminal.
pub(crate) fn json(text: &str) {
    write(text.as_bytes());
}

fn write(bytes: &[u8]) {
    let _ = std::io::stdout().write_all(bytes);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_shown_steers_a_terminal() {
        let text = "a\u{1b}]0;x\u{7}\u{9b}31m\u{202e}\nb\r\tc";
        assert_eq!(plain(text).0, "a\\x1b]0;x\\x07\\x9b31m⟨U+202E⟩\nb\\x0d\\x09c");
    }
}
