//! The functions of formulas: names, number of arguments, values.

/// A function of formulas; angles in radians.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Function {
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Tangent.
    Tan,
    /// Arc sine.
    Asin,
    /// Arc cosine.
    Acos,
    /// Arc tangent.
    Atan,
    /// Angle of the point (second argument, first argument), from -pi to pi.
    Atan2,
    /// Square root.
    Sqrt,
    /// Absolute value.
    Abs,
    /// Exponential function.
    Exp,
    /// Natural logarithm; `log` is read as the same.
    Ln,
    /// Smallest of two or more.
    Min,
    /// Greatest of two or more.
    Max,
    /// Root of the sum of two squares.
    Hypot,
    /// Greatest whole number that is not greater.
    Floor,
    /// -1, 0 or 1; 0 at zero.
    Sign,
}

impl Function {
    /// All functions.
    pub const ALL: [Function; 16] = [
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Asin,
        Function::Acos,
        Function::Atan,
        Function::Atan2,
        Function::Sqrt,
        Function::Abs,
        Function::Exp,
        Function::Ln,
        Function::Min,
        Function::Max,
        Function::Hypot,
        Function::Floor,
        Function::Sign,
    ];

    /// Name as written and read.
    pub fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Asin => "asin",
            Function::Acos => "acos",
            Function::Atan => "atan",
            Function::Atan2 => "atan2",
            Function::Sqrt => "sqrt",
            Function::Abs => "abs",
            Function::Exp => "exp",
            Function::Ln => "ln",
            Function::Min => "min",
            Function::Max => "max",
            Function::Hypot => "hypot",
            Function::Floor => "floor",
            Function::Sign => "sign",
        }
    }

    /// The function of this name.
    pub fn named(name: &str) -> Option<Function> {
        let name = if name == "log" { "ln" } else { name };
        Function::ALL.into_iter().find(|f| f.name() == name)
    }

    /// Least and greatest number of arguments.
    pub fn arguments(self) -> (usize, usize) {
        match self {
            Function::Atan2 | Function::Hypot => (2, 2),
            Function::Min | Function::Max => (2, usize::MAX),
            _ => (1, 1),
        }
    }

    /// Value for one argument; `NaN` for a function of two.
    pub(super) fn value(self, x: f64) -> f64 {
        match self {
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
            Function::Tan => x.tan(),
            Function::Asin => x.asin(),
            Function::Acos => x.acos(),
            Function::Atan => x.atan(),
            Function::Sqrt => x.sqrt(),
            Function::Abs => x.abs(),
            Function::Exp => x.exp(),
            Function::Ln => x.ln(),
            Function::Floor => x.floor(),
            Function::Sign if x == 0.0 => 0.0,
            Function::Sign => x.signum(),
            Function::Atan2 | Function::Min | Function::Max | Function::Hypot => f64::NAN,
        }
    }

    /// Value for two arguments; `NaN` for a function of one. Smallest and greatest of a `NaN` are `NaN`.
    pub(super) fn value_of_two(self, a: f64, b: f64) -> f64 {
        match self {
            Function::Atan2 => a.atan2(b),
            Function::Hypot => a.hypot(b),
            Function::Min | Function::Max if a.is_nan() || b.is_nan() => f64::NAN,
            Function::Min => a.min(b),
            Function::Max => a.max(b),
            _ => f64::NAN,
        }
    }
}
