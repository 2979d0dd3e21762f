//! A number or a word with its name.

use serde::{Deserialize, Serialize};

/// A number or a word with its name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fact {
    /// Name of the fact ("Largest deviation").
    pub label: String,
    /// The value with its unit, as shown.
    pub value: String,
    /// A short addition below the value; may be empty.
    pub note: String,
}

impl Fact {
    /// A fact without a note.
    pub fn new(label: impl Into<String>, value: impl Into<String>) -> Fact {
        Fact { label: label.into(), value: value.into(), note: String::new() }
    }

    /// With a note.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Fact {
        self.note = note.into();
        self
    }
}
