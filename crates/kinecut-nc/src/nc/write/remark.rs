//! Comments, and messages to the operator: text that nothing else can come out of.

use crate::nc::{Control, comment};

use super::Writer;

/// Longest message: SINUMERIK shows 124 characters.
const LONGEST_MESSAGE: usize = 120;

impl Writer<'_> {
    /// A comment, in as many lines as it needs.
    pub(super) fn comment(&mut self, text: &str) {
        let [before, after] = self.dialect.comment;
        let room =
            self.dialect.line_limit.unwrap_or(usize::MAX).saturating_sub(before.len() + after.len() + 2);
        for line in comment::lines(text, room.min(comment::LONGEST)) {
            let mut line = self.harmless(&line);
            if self.dialect.capitals {
                line.make_ascii_uppercase();
            }
            self.page.line(format!("{before}{line}{after}"));
        }
    }

    /// A message to the operator: the control's own, where it has one, otherwise a comment. What is too long for one goes on as a
    /// comment.
    pub(super) fn message(&mut self, text: &str) {
        let Some([before, after]) = self.dialect.message else { return self.comment(text) };
        let quoted = before.ends_with('"');
        let text = self.harmless(&comment::message(text, quoted));
        if text.is_empty() {
            // Only a control of which the message stays has a word to take it away.
            if quoted {
                self.page.block(format!("{})", before.trim_end_matches('"')));
            }
            return;
        }
        let room = self.dialect.line_limit.unwrap_or(usize::MAX).saturating_sub(before.len() + after.len());
        let (said, rest) = comment::cut(&text, room.min(LONGEST_MESSAGE));
        let line = format!("{before}{said}{after}");
        if quoted {
            self.page.block(line)
        } else {
            self.page.line(line)
        }
        self.comment(rest);
    }

    /// The text without characters that this control takes for more than text wherever they are.
    fn harmless(&self, text: &str) -> String {
        let changed: &[(char, char)] = match self.settings.control {
            // At the end of a line it would join the next one.
            Control::Heidenhain => &[('~', '-')],
            // Sent line by line it would end the program on some controls.
            Control::Fanuc | Control::Haas => &[('%', '-')],
            // Hold, go on and report, taken out of the stream of characters before any line is read (Grbl 1.1 interface).
            Control::Grbl | Control::GrblHal => &[('!', '.'), ('~', '-'), ('?', '.')],
            Control::LinuxCnc | Control::Sinumerik840d => &[],
        };
        let other = |c: char| changed.iter().find(|(from, _)| *from == c).map_or(c, |(_, to)| *to);
        text.chars().map(other).collect()
    }
}
