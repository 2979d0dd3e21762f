//! Comments, and messages to the operator: `MSG("text")` of SINUMERIK, and `(MSG, text)`, a comment by which LinuxCNC and
//! senders for Grbl show the text (`convert_comment` of LinuxCNC's interpreter: blanks before the word and capitals do not count,
//! the comma follows at once; after a semicolon it is a comment like any other).

use crate::program::{Origin, Speed};

use super::block::Block;
use super::place::Bytes;
use super::reader::{Kind, Reader};

/// First letters of a comment that is a message.
const MARK: &str = "MSG,";

impl<'s> Reader<'s> {
    /// Whether one of the comments of a block is a message.
    pub(super) fn has_message(&self, block: &Block<'s>) -> bool {
        block.comments.iter().any(|(text, bytes)| self.message_in(text, bytes).is_some())
    }

    /// Appends the comments and messages of a block.
    pub(super) fn remarks(&mut self, block: &Block<'s>) {
        if block.comments.is_empty() && block.message.is_none() {
            return;
        }
        let comments = block.comments.iter().map(|(text, bytes)| match self.message_in(text, bytes) {
            Some(message) => (message, true, bytes),
            None => (*text, false, bytes),
        });
        let messages = block.message.iter().map(|(text, bytes)| (*text, true, bytes));
        for (text, message, bytes) in comments.chain(messages).collect::<Vec<_>>() {
            if text.is_empty() && !message {
                continue;
            }
            let span = Some(self.place.span(bytes));
            let origin = Origin { span, parent: self.parent, ..Origin::default() };
            self.flush(Kind::Other);
            let state = self.state(Speed::Rapid { linear: false });
            match message {
                true => self.program.push_message(text, &state, origin),
                false => self.program.push_text(text, &state, origin),
            }
        }
    }

    /// The text of a message that a comment is.
    fn message_in(&self, comment: &'s str, bytes: &Bytes) -> Option<&'s str> {
        let marked = self.dialect.message.is_some_and(|marks| marks[0].starts_with('('));
        let before = (bytes.start as usize).checked_sub(1)?;
        let round = self.place.text().as_bytes().get(before) == Some(&b'(');
        let (mark, text) = comment.split_at_checked(MARK.len())?;
        (marked && round && mark.eq_ignore_ascii_case(MARK)).then(|| text.trim())
    }
}
