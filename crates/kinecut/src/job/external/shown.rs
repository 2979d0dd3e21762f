//! Result of reading a program of others.

use std::fmt;

use crate::base::Finding;
use crate::nc::Control;

/// Result of reading a program of others.
#[derive(Clone, Debug)]
pub struct ExternalProgram {
    /// The control that runs it.
    pub control: Control,
    /// Warnings of the reader, and registers that are not the tools' own.
    pub findings: Vec<Finding>,
    /// Parts that were read and are not followed.
    pub unfollowed: Vec<Unfollowed>,
    /// Largest difference of the distances of start and end from the centre of an arc, as written [mm].
    pub radius_difference: f64,
}

/// Something that was read and is not followed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unfollowed {
    /// Line of the program, from 1.
    pub line: Option<u32>,
    /// In words.
    pub what: String,
}

impl fmt::Display for Unfollowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.what),
            None => f.write_str(&self.what),
        }
    }
}

impl ExternalProgram {
    /// Claim about a file that reading it proves.
    pub(crate) fn claim(&self, file: &str) -> String {
        format!("`{file}` was read whole as {} reads it: no word of it is skipped", self.control.title())
    }
}
