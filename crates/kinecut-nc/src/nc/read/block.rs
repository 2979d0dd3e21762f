//! A block of a program: its words, each with its place.

use crate::nc::run::Value;

use super::place::Bytes;

/// A word: an address with its number, or a keyword without one.
#[derive(Clone, Debug)]
pub(super) struct Word<'t> {
    /// Address or keyword, as typed.
    pub(super) name: &'t str,
    pub(super) value: Option<f64>,
    pub(super) bytes: Bytes,
    /// Meaning of the number.
    pub(super) way: WordMode,
    /// Whether the number has a decimal point.
    pub(super) point: bool,
    /// Whether the number was computed.
    pub(super) computed: bool,
    /// Whether a code of the block has used it.
    pub(super) used: bool,
}

impl<'t> Word<'t> {
    /// Whether it has this name, in capitals or not.
    #[inline]
    pub(super) fn is(&self, name: &str) -> bool {
        match (self.name.as_bytes(), name.as_bytes()) {
            // Nearly all are one letter.
            ([own], [letter]) => own.eq_ignore_ascii_case(letter),
            (own, name) => own.eq_ignore_ascii_case(name),
        }
    }

    /// Whether GRBL reads its letter.
    pub(super) fn is_of_grbl(&self) -> bool {
        "FGIJKLMNPRSTXYZ".contains(&self.name.to_ascii_uppercase())
    }

    /// A keyword without a number.
    pub(super) fn bare(name: &'t str, bytes: Bytes) -> Word<'t> {
        Word { name, value: None, bytes, way: WordMode::Plain, point: false, computed: false, used: false }
    }
}

/// Meaning of the number of a word, whatever mode is in force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum WordMode {
    /// As the mode says.
    #[default]
    Plain,
    /// `AC()`.
    Absolute,
    /// `IC()`.
    Increment,
    /// To an angle by the shortest way, `DC()`, upwards, `ACP()`, or downwards, `ACN()`.
    Shortest,
    Up,
    Down,
}

/// A call with arguments, those left out as `None`.
#[derive(Clone, Debug)]
pub(super) struct Call<'t> {
    pub(super) name: &'t str,
    pub(super) arguments: Vec<Option<f64>>,
    /// The argument that is a text, between quotes.
    pub(super) text: Option<&'t str>,
    /// Places of the arguments.
    pub(super) places: Vec<Bytes>,
    pub(super) bytes: Bytes,
}

/// A variable that a block sets.
#[derive(Clone, Debug)]
pub(super) struct Assignment {
    pub(super) variable: Variable,
    pub(super) value: Value,
    pub(super) bytes: Bytes,
}

/// A variable by its number or its name.
#[derive(Clone, Debug)]
pub(super) enum Variable {
    Numbered(u32),
    Named(String),
}

/// The words of a line.
#[derive(Debug, Default)]
pub(super) struct Block<'t> {
    pub(super) words: Vec<Word<'t>>,
    /// Variables that it sets, in the order of the text.
    pub(super) assignments: Vec<Assignment>,
    pub(super) comments: Vec<(&'t str, Bytes)>,
    /// Call with arguments.
    pub(super) call: Option<Call<'t>>,
    /// RegisterState message, as typed between quotes.
    pub(super) message: Option<(&'t str, Bytes)>,
    /// `/` at the beginning.
    pub(super) skip: Option<Bytes>,
    /// `%` line.
    pub(super) tape: bool,
    /// A number was written with blanks inside.
    pub(super) torn: Option<Bytes>,
}

impl Block<'_> {
    pub(super) fn clear(&mut self) {
        // The lists keep their memory: a block of a loop takes none anew.
        self.words.clear();
        self.assignments.clear();
        self.comments.clear();
        (self.call, self.message, self.skip, self.torn) = (None, None, None, None);
        self.tape = false;
    }

    /// Whether it says anything.
    pub(super) fn is_empty(&self) -> bool {
        self.words.is_empty() && self.message.is_none() && self.call.is_none() && self.assignments.is_empty()
    }

    /// Whether nothing is in it, remarks included.
    #[inline]
    pub(super) fn is_blank(&self) -> bool {
        self.is_empty() && self.comments.is_empty() && self.skip.is_none() && !self.tape
    }

    /// Whether it says nothing but words.
    #[inline]
    fn only_words(&self) -> bool {
        self.message.is_none() && self.call.is_none() && self.assignments.is_empty()
    }

    /// From the first to the last word.
    pub(super) fn bytes(&self) -> Bytes {
        // Words stand in the order of the text.
        if let (Some(first), Some(last), true) = (self.words.first(), self.words.last(), self.only_words()) {
            return first.bytes.start..last.bytes.end;
        }
        let call = self.call.iter().map(|c| &c.bytes);
        let set = self.assignments.iter().map(|a| &a.bytes);
        let words = self.words.iter().map(|w| &w.bytes);
        let mut all = self.message.iter().map(|m| &m.1).chain(call).chain(set).chain(words);
        let Some(first) = all.next() else { return 0..0 };
        all.fold(first.clone(), |a, b| a.start.min(b.start)..a.end.max(b.end))
    }
}
