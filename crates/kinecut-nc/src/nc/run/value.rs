//! A value of an expression.

/// A number, the truth of a condition, or nothing: a variable that holds no value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::nc) enum Value {
    Number(f64),
    /// The result of a comparison.
    Truth(bool),
    /// "Null" of FANUC and Haas (`#0`).
    Vacant,
}

impl Value {
    /// The number it counts as: nothing is nought.
    pub(in crate::nc) fn number(self) -> f64 {
        match self {
            Value::Number(number) => number,
            Value::Truth(truth) => f64::from(u8::from(truth)),
            Value::Vacant => 0.0,
        }
    }

    pub(in crate::nc) fn is_true(self) -> bool {
        self.number() != 0.0
    }
}
