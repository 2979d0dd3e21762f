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

/// The variables in force, and names that the block gives a value: the interpreter makes them, with the value 0, as soon as it has read
/// the left side (`read_parameter_setting`, `add_named_param`).
pub(in crate::nc) struct WithMade<'a> {
    pub(in crate::nc) names: &'a dyn Names,
    pub(in crate::nc) made: Vec<String>,
}

impl Names for WithMade<'_> {
    fn numbered(&self, number: u32) -> Known {
        self.names.numbered(number)
    }

    fn named(&self, name: &str) -> Known {
        match self.names.named(name) {
            Known::Missing if self.made.iter().any(|made| made == name) => Known::Value(Value::Number(0.0)),
            known => known,
        }
    }
}

/// The variables in force.
pub(in crate::nc) trait Names {
    /// A variable with a number.
    fn numbered(&self, number: u32) -> Known;

    /// A variable with a name, in small letters and without blanks.
    fn named(&self, name: &str) -> Known;
}
