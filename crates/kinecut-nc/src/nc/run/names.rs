//! Variables as an expression reads them.

use super::Value;

/// A variable, as far as its value is known.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::nc) enum Known {
    Value(Value),
    /// It has a value on the machine only; why.
    Unknown(&'static str),
    /// The control has no such variable.
    Missing,
}

/// The variables in force.
pub(in crate::nc) trait Names {
    /// A variable with a number.
    fn numbered(&self, number: u32) -> Known;

    /// A variable with a name, in small letters and without blanks.
    fn named(&self, name: &str) -> Known;
}
