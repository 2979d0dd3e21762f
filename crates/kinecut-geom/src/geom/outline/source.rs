//! The text of a file, and places in it for findings.

use std::sync::Arc;

use crate::base::{Code, FileId, Finding, Location, Sources, Span};

/// A text with its name.
pub(super) struct Source {
    sources: Sources,
    file: FileId,
    text: Arc<str>,
}

impl Source {
    /// Bytes as text; what is not UTF-8 (names in old code pages) becomes a replacement character.
    pub(super) fn new(name: &str, bytes: &[u8]) -> Source {
        let mut sources = Sources::default();
        let text: Arc<str> = Arc::from(String::from_utf8_lossy(bytes));
        let file = sources.add(name, Arc::clone(&text));
        Source { sources, file, text }
    }

    /// The text; a handle of its own, so that it may be read while findings are made.
    pub(super) fn text(&self) -> Arc<str> {
        Arc::clone(&self.text)
    }

    /// The place of a byte.
    pub(super) fn at(&self, offset: usize) -> Location {
        let start = u32::try_from(offset).unwrap_or(u32::MAX);
        self.sources.locate(Span { file: self.file, start, end: start })
    }

    /// The line of a byte, from 1.
    pub(super) fn line(&self, offset: usize) -> u32 {
        self.sources.line(Span {
            file: self.file,
            start: u32::try_from(offset).unwrap_or(u32::MAX),
            end: u32::MAX,
        })
    }

    /// First byte of a line, from 1.
    pub(super) fn offset_of_line(&self, line: usize) -> usize {
        self.text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum()
    }

    /// The whole file as a place.
    pub(super) fn file(&self) -> Location {
        Location::whole_file(self.sources.name(self.file))
    }

    /// An error of reading at a byte.
    pub(super) fn error(&self, offset: usize, message: impl Into<String>) -> Finding {
        Finding::error(Code::OUTLINE_FILE, message).at(self.at(offset))
    }

    /// An error of reading without a place.
    pub(super) fn whole(&self, message: impl Into<String>) -> Finding {
        Finding::error(Code::OUTLINE_FILE, message).at(self.file())
    }
}
