//! Places in source text: a compact span for each program item, and the resolved location a person reads.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

/// Index of a file in [`Sources`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct FileId(pub u32);

/// A byte range of one source file; twelve bytes, so that every item of a long program can carry one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Span {
    /// The file.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The smallest span that holds both; they must be of the same file.
    pub fn join(self, other: Span) -> Span {
        debug_assert_eq!(self.file, other.file, "spans of one file");
        Span { file: self.file, start: self.start.min(other.start), end: self.end.max(other.end) }
    }
}

/// A span resolved for a reader: name of the file, line and column (1-based, columns in characters).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Location {
    /// Name of the file as the user gave it.
    pub file: String,
    /// Line, 1-based.
    pub line: u32,
    /// Column in characters, 1-based.
    pub column: u32,
    /// First byte of the place in the file.
    pub start: u32,
    /// One past the last byte of the place.
    pub end: u32,
    /// The source line that holds the first byte, without its line end.
    pub text: String,
}

impl Location {
    /// A place that is a whole file (one that does not exist or cannot be read).
    pub fn whole_file(file: impl Into<String>) -> Location {
        Location { file: file.into(), line: 0, column: 0, start: 0, end: 0, text: String::new() }
    }
}

#[derive(Clone, Debug)]
struct Source {
    name: String,
    text: Arc<str>,
    /// Line ends before each stretch of the text: its lines are counted from there, so that a long text needs no list of them.
    ends_before: Vec<u32>,
}

/// Bytes of a stretch.
const STRETCH: usize = 1024;

/// Line ends in bytes.
fn ends(bytes: &[u8]) -> u32 {
    // A sum that wraps is one of many bytes at once.
    bytes.iter().fold(0, |count: u32, b| count.wrapping_add(u32::from(*b == b'\n')))
}

impl Source {
    fn new(name: String, text: Arc<str>) -> Source {
        let mut ends_before = Vec::with_capacity(text.len() / STRETCH + 1);
        let mut count = 0;
        for stretch in text.as_bytes().chunks(STRETCH) {
            ends_before.push(count);
            count += ends(stretch);
        }
        Source { name, text, ends_before }
    }

    /// The 0-based line of a byte; one beyond the text is in the last line.
    fn line(&self, at: usize) -> u32 {
        let at = at.min(self.text.len());
        // A stretch that just ends here counts as a whole.
        let stretch = (at / STRETCH).min(self.ends_before.len().saturating_sub(1));
        let before = self.ends_before.get(stretch).copied().unwrap_or(0);
        before + ends(&self.text.as_bytes()[stretch * STRETCH..at])
    }
}

/// The source texts of one run; resolves spans to locations.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::base::{Sources, Span};
/// let mut sources = Sources::default();
/// let file = sources.add("hole.mpf", "G0 X0\nG1 Q7\n");
/// let place = sources.locate(Span { file, start: 9, end: 11 });
/// assert_eq!((place.line, place.column, place.text.as_str()), (2, 4, "G1 Q7"));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<Source>,
}

impl Sources {
    /// Adds a text and returns its identifier. Texts over 4 GiB are cut at the span type's limit by the loader.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<Arc<str>>) -> FileId {
        self.files.push(Source::new(name.into(), text.into()));
        FileId(self.files.len() as u32 - 1)
    }

    /// The text of a file.
    pub fn text(&self, file: FileId) -> &str {
        &self.files[file.0 as usize].text
    }

    /// The name of a file as the user gave it.
    pub fn name(&self, file: FileId) -> &str {
        &self.files[file.0 as usize].name
    }

    /// The 1-based line in which a span begins.
    pub fn line(&self, span: Span) -> u32 {
        self.files[span.file.0 as usize].line(span.start as usize) + 1
    }

    /// The 1-based line in which each of some spans begins: as [`Sources::line`], and quick where they ascend.
    pub fn lines(&self, spans: impl IntoIterator<Item = Option<Span>>) -> Vec<Option<u32>> {
        // File, place and line of the one before.
        let mut last = (FileId::default(), 0usize, 0u32);
        let mut line = |span: Span| {
            let source = &self.files[span.file.0 as usize];
            let at = (span.start as usize).min(source.text.len());
            let (file, from, line) = last;
            let near = file == span.file && (from..from + STRETCH).contains(&at);
            let line = match near {
                true => line + ends(&source.text.as_bytes()[from..at]),
                false => source.line(at),
            };
            last = (span.file, at, line);
            line + 1
        };
        spans.into_iter().map(|span| span.map(&mut line)).collect()
    }

    /// The span as a person reads it. Byte offsets beyond the text point at its end.
    pub fn locate(&self, span: Span) -> Location {
        let source = &self.files[span.file.0 as usize];
        let mut start = (span.start as usize).min(source.text.len());
        while !source.text.is_char_boundary(start) {
            start -= 1;
        }
        let line = source.line(start) + 1;
        let line_start = source.text[..start].rfind('\n').map_or(0, |end| end + 1);
        let text = source.text[line_start..].lines().next().unwrap_or("").to_owned();
        let column = source.text[line_start..start].chars().count() as u32 + 1;
        Location {
            file: source.name.clone(),
            line,
            column,
            start: start as u32,
            end: span.end.max(start as u32),
            text,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_counted_over_stretches() {
        // Lines of all lengths, some of them longer than a stretch.
        let text: String = (0..90).map(|i| format!("{}\n", "x".repeat(i * 31))).collect();
        let mut sources = Sources::default();
        let file = sources.add("a", text.as_str());
        let (mut line, mut begin) = (1, 0);
        for (at, byte) in text.bytes().enumerate() {
            let start = at as u32;
            assert_eq!(sources.line(Span { file, start, end: start + 1 }), line);
            if byte == b'\n' || at % 97 == 0 {
                let place = sources.locate(Span { file, start, end: start + 1 });
                assert_eq!((place.line, place.column as usize), (line, at - begin + 1));
            }
            if byte == b'\n' {
                (line, begin) = (line + 1, at + 1);
            }
        }
        let beyond = text.len() as u32 + 5;
        assert_eq!(sources.line(Span { file, start: beyond, end: beyond }), line);
    }

    #[test]
    fn a_long_text_takes_few_bytes_for_its_lines() {
        let text = "G1 X1\n".repeat(100_000);
        let source = Source::new(String::new(), text.as_str().into());
        assert!(source.ends_before.capacity() * 4 <= text.len() / 200);
    }

    #[test]
    fn the_lines_of_many_spans_are_those_of_each() {
        let mut sources = Sources::default();
        let first = sources.add("a", "one\n\nthree\nfour");
        let second = sources.add("b", "\nx\n");
        let at = |file, start| Some(Span { file, start, end: start + 1 });
        let rising = (0..18).map(|i| at(first, i));
        let others = [at(second, 0), None, at(second, 2), at(first, 16), at(first, 0), at(second, 99)];
        let spans: Vec<_> = rising.chain(others).collect();
        let lines: Vec<_> = spans.iter().map(|s| s.map(|s| sources.line(s))).collect();
        assert_eq!(sources.lines(spans), lines);
        assert_eq!(lines[3..6], [Some(1), Some(2), Some(3)]);
    }
}
