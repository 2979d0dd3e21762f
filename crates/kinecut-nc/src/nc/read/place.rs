//! Findings that point at words.

use std::ops::Range;

use crate::base::{Code, Error, FileId, Finding, Sources, Span};

/// The text that is being read.
#[derive(Clone, Copy, Debug)]
pub(in crate::nc) struct SourceText<'s> {
    pub(in crate::nc) sources: &'s Sources,
    pub(in crate::nc) file: FileId,
    /// The text of the file: looked at for every byte.
    text: &'s str,
}

/// Bytes of a word in the text.
pub(in crate::nc) type Bytes = Range<u32>;

impl<'s> SourceText<'s> {
    pub(in crate::nc) fn new(sources: &'s Sources, file: FileId) -> SourceText<'s> {
        SourceText { sources, file, text: sources.text(file) }
    }

    #[inline]
    pub(in crate::nc) fn text(&self) -> &'s str {
        self.text
    }

    #[inline]
    pub(in crate::nc) fn span(&self, bytes: &Bytes) -> Span {
        Span { file: self.file, start: bytes.start, end: bytes.end }
    }

    /// The text of a place, as it may be shown in a message.
    pub(in crate::nc) fn shown(&self, bytes: &Bytes) -> String {
        const LONGEST: usize = 40;
        let text = self.text().get(bytes.start as usize..bytes.end as usize).unwrap_or("");
        let mut shown: String = text.chars().take(LONGEST).flat_map(char::escape_debug).collect();
        if text.chars().count() > LONGEST {
            shown.push_str("...");
        }
        shown
    }

    pub(in crate::nc) fn error(&self, code: Code, bytes: &Bytes, message: impl Into<String>) -> Finding {
        Finding::error(code, message).at(self.sources.locate(self.span(bytes)))
    }

    /// An error of something that knows no place.
    pub(in crate::nc) fn located(&self, bytes: &Bytes, error: Error) -> Error {
        error.0.at(self.sources.locate(self.span(bytes))).into()
    }

    pub(in crate::nc) fn warning(&self, code: Code, bytes: &Bytes, message: impl Into<String>) -> Finding {
        Finding::warning(code, message).at(self.sources.locate(self.span(bytes)))
    }

    pub(in crate::nc) fn not_understood(&self, bytes: &Bytes, why: &str) -> Finding {
        self.error(Code::NC_WORD, bytes, format!("`{}` is not understood: {why}", self.shown(bytes)))
    }

    pub(in crate::nc) fn malformed(&self, bytes: &Bytes, why: &str) -> Finding {
        self.error(Code::NC_SYNTAX, bytes, format!("`{}` is malformed: {why}", self.shown(bytes)))
    }
}
