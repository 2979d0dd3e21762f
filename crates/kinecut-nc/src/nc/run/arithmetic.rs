//! Operators and functions of the control languages, and the differences between them.
//!
//! | | LinuxCNC | FANUC macro B, Haas |
//! |---|---|---|
//! | order | `**`; `* / MOD`; `+ -`; comparisons; `AND OR XOR` | `* / AND MOD`; `+ - OR XOR`; comparisons |
//! | `AND OR XOR` | of truths | of the bits of whole numbers |
//! | `MOD` of negative numbers | never negative | sign of the first |
//! | `FIX[-2.8]`, `FUP[-2.8]` | -3, -2 | -2, -3 |
//! | `ATAN[-1]/[-1]` | -135 degrees | 225 degrees (parameter 6004#0 = 0) |
//!
//! Sources: the interpreter of LinuxCNC 2.9; for macro B articles and one public manual of a control that follows it, the
//! range of `ATAN` and the sign of `MOD` from memory.

/// The arithmetic of a control language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::nc) enum Arithmetic {
    /// RS274/NGC of LinuxCNC.
    Ngc,
    /// FANUC custom macro B, and Haas.
    MacroB,
}

/// An operator between two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Power,
    Times,
    Over,
    Modulo,
    Plus,
    Minus,
    Equal,
    NotEqual,
    Greater,
    GreaterEqual,
    Less,
    LessEqual,
    And,
    Or,
    Xor,
}

/// A function of one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Abs,
    ArcCosine,
    ArcSine,
    /// Of a quotient: two values.
    ArcTangent,
    Cosine,
    Sine,
    Tangent,
    Exponential,
    Logarithm,
    Root,
    /// To whole numbers: down (or towards 0), up (or away from 0), to the nearest.
    Down,
    Up,
    Nearest,
    /// Whether a named parameter exists.
    Exists,
    /// To and from binary-coded decimals.
    FromDecimal,
    ToDecimal,
    /// `POW[a, b]`.
    PowerOf,
    /// Marks a whole number as one with a point (`ADP`).
    AsReal,
}

/// Why a value has none.
pub(super) type Domain = &'static str;

const NGC: [(&str, Operator, u8); 15] = [
    ("**", Operator::Power, 5),
    ("*", Operator::Times, 4),
    ("/", Operator::Over, 4),
    ("MOD", Operator::Modulo, 4),
    ("+", Operator::Plus, 3),
    ("-", Operator::Minus, 3),
    ("EQ", Operator::Equal, 2),
    ("NE", Operator::NotEqual, 2),
    ("GT", Operator::Greater, 2),
    ("GE", Operator::GreaterEqual, 2),
    ("LT", Operator::Less, 2),
    ("LE", Operator::LessEqual, 2),
    ("AND", Operator::And, 1),
    ("OR", Operator::Or, 1),
    ("XOR", Operator::Xor, 1),
];

const MACRO_B: [(&str, Operator, u8); 14] = [
    ("*", Operator::Times, 4),
    ("/", Operator::Over, 4),
    ("MOD", Operator::Modulo, 4),
    ("AND", Operator::And, 4),
    ("+", Operator::Plus, 3),
    ("-", Operator::Minus, 3),
    ("OR", Operator::Or, 3),
    ("XOR", Operator::Xor, 3),
    ("EQ", Operator::Equal, 2),
    ("NE", Operator::NotEqual, 2),
    ("GT", Operator::Greater, 2),
    ("GE", Operator::GreaterEqual, 2),
    ("LT", Operator::Less, 2),
    ("LE", Operator::LessEqual, 2),
];

const NGC_FUNCTIONS: [(&str, Function); 14] = [
    ("ABS", Function::Abs),
    ("ACOS", Function::ArcCosine),
    ("ASIN", Function::ArcSine),
    ("ATAN", Function::ArcTangent),
    ("COS", Function::Cosine),
    ("EXISTS", Function::Exists),
    ("EXP", Function::Exponential),
    ("FIX", Function::Down),
    ("FUP", Function::Up),
    ("LN", Function::Logarithm),
    ("ROUND", Function::Nearest),
    ("SIN", Function::Sine),
    ("SQRT", Function::Root),
    ("TAN", Function::Tangent),
];

const MACRO_B_FUNCTIONS: [(&str, Function); 19] = [
    ("ABS", Function::Abs),
    ("ACOS", Function::ArcCosine),
    ("ADP", Function::AsReal),
    ("ASIN", Function::ArcSine),
    ("ATAN", Function::ArcTangent),
    ("BCD", Function::ToDecimal),
    ("BIN", Function::FromDecimal),
    ("COS", Function::Cosine),
    ("EXP", Function::Exponential),
    ("FIX", Function::Down),
    ("FUP", Function::Up),
    ("LN", Function::Logarithm),
    ("POW", Function::PowerOf),
    ("RND", Function::Nearest),
    ("ROUND", Function::Nearest),
    ("SIN", Function::Sine),
    ("SQR", Function::Root),
    ("SQRT", Function::Root),
    ("TAN", Function::Tangent),
];

/// Largest difference of two values that are equal (LinuxCNC).
const EQUAL: f64 = 0.0001;
/// Largest whole number that a double holds exactly.
const WHOLE: f64 = 9_007_199_254_740_992.0;

impl Arithmetic {
    /// Operators with their ranks, the strongest first.
    pub(super) fn operators(self) -> &'static [(&'static str, Operator, u8)] {
        match self {
            Arithmetic::Ngc => &NGC,
            Arithmetic::MacroB => &MACRO_B,
        }
    }

    /// The function of this name, in capitals.
    pub(super) fn function(self, name: &str) -> Option<Function> {
        let table: &[(&str, Function)] = match self {
            Arithmetic::Ngc => &NGC_FUNCTIONS,
            Arithmetic::MacroB => &MACRO_B_FUNCTIONS,
        };
        table.iter().find(|(n, _)| *n == name).map(|(_, f)| *f)
    }

    /// Two numbers by an operator; comparisons give 1 or 0.
    pub(super) fn apply(self, operator: Operator, a: f64, b: f64) -> Result<f64, Domain> {
        let ngc = self == Arithmetic::Ngc;
        let equal = if ngc { (a - b).abs() < EQUAL } else { a == b };
        let truth = |yes: bool| Ok(f64::from(u8::from(yes)));
        match operator {
            Operator::Plus => Ok(a + b),
            Operator::Minus => Ok(a - b),
            Operator::Times => Ok(a * b),
            Operator::Over if b == 0.0 => Err("division by zero"),
            Operator::Over => Ok(a / b),
            Operator::Modulo if b == 0.0 => Err("the rest of a division by zero"),
            Operator::Modulo if ngc => {
                let rest = a % b;
                Ok(if rest < 0.0 { rest + b.abs() } else { rest })
            }
            Operator::Modulo => match b.round() {
                0.0 => Err("the rest of a division by zero"),
                whole => Ok(a.round() % whole),
            },
            Operator::Power if a < 0.0 && b != b.floor() => {
                Err("a negative number to a power that is not whole")
            }
            Operator::Power => Ok(a.powf(b)),
            Operator::Equal => truth(equal),
            Operator::NotEqual => truth(!equal),
            Operator::Greater => truth(a > b),
            Operator::GreaterEqual => truth(a >= b),
            Operator::Less => truth(a < b),
            Operator::LessEqual => truth(a <= b),
            Operator::And | Operator::Or | Operator::Xor if ngc => {
                let (a, b) = (a != 0.0, b != 0.0);
                truth(match operator {
                    Operator::And => a && b,
                    Operator::Or => a || b,
                    _ => a != b,
                })
            }
            Operator::And | Operator::Or | Operator::Xor => {
                let (a, b) = (whole(a)?, whole(b)?);
                Ok(match operator {
                    Operator::And => a & b,
                    Operator::Or => a | b,
                    _ => a ^ b,
                } as f64)
            }
        }
    }

    /// A function of one number; angles in degrees.
    pub(super) fn call(self, function: Function, x: f64) -> Result<f64, Domain> {
        let ngc = self == Arithmetic::Ngc;
        Ok(match function {
            Function::Abs => x.abs(),
            Function::ArcCosine if !(-1.0..=1.0).contains(&x) => return Err("the cosine of no angle"),
            Function::ArcCosine => x.acos().to_degrees(),
            Function::ArcSine if !(-1.0..=1.0).contains(&x) => return Err("the sine of no angle"),
            Function::ArcSine => {
                let angle = x.asin().to_degrees();
                if ngc || angle >= 0.0 { angle } else { angle + 360.0 }
            }
            Function::ArcTangent => x.atan().to_degrees(),
            Function::Cosine => x.to_radians().cos(),
            Function::Sine => x.to_radians().sin(),
            Function::Tangent => x.to_radians().tan(),
            Function::Exponential => x.exp(),
            Function::Logarithm if x <= 0.0 => return Err("the logarithm of zero or a negative number"),
            Function::Logarithm => x.ln(),
            Function::Root if x < 0.0 => return Err("the root of a negative number"),
            Function::Root => x.sqrt(),
            Function::Down => {
                if ngc {
                    x.floor()
                } else {
                    x.trunc()
                }
            }
            Function::Up if ngc => x.ceil(),
            Function::Up => x.abs().ceil().copysign(x),
            Function::Nearest => x.round(),
            Function::FromDecimal => from_decimal(whole(x)?)?,
            Function::ToDecimal => to_decimal(whole(x)?)?,
            Function::AsReal | Function::Exists | Function::PowerOf => x,
        })
    }

    /// The angle of a point [deg].
    pub(super) fn angle(self, y: f64, x: f64) -> f64 {
        let angle = y.atan2(x).to_degrees();
        if self == Arithmetic::Ngc || angle >= 0.0 { angle } else { angle + 360.0 }
    }
}

/// The whole number next to a value.
fn whole(x: f64) -> Result<i64, Domain> {
    if x.abs() < WHOLE { Ok(x.round() as i64) } else { Err("the bits of a number beyond 2^53") }
}

/// Digits of a decimal number as groups of four bits.
const DIGITS: u32 = 8;

fn to_decimal(x: i64) -> Result<f64, Domain> {
    if !(0..100_000_000).contains(&x) {
        return Err("the decimal digits of a number that is negative or has more than eight");
    }
    Ok((0..DIGITS).map(|i| (x / 10i64.pow(i) % 10) << (4 * i)).sum::<i64>() as f64)
}

fn from_decimal(x: i64) -> Result<f64, Domain> {
    if !(0..1 << (4 * DIGITS)).contains(&x) {
        return Err("more than eight decimal digits");
    }
    let digit = |i: u32| x >> (4 * i) & 15;
    if (0..DIGITS).any(|i| digit(i) > 9) {
        return Err("bits that are no decimal digits");
    }
    Ok((0..DIGITS).map(|i| digit(i) * 10i64.pow(i)).sum::<i64>() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn negative_numbers_are_rounded_as_each_language_does() {
        let both = |f, x| [Arithmetic::Ngc, Arithmetic::MacroB].map(|a| a.call(f, x).unwrap());
        assert_eq!(both(Function::Down, -2.8), [-3.0, -2.0]);
        assert_eq!(both(Function::Up, -2.8), [-2.0, -3.0]);
        assert_eq!(both(Function::Nearest, -2.5), [-3.0, -3.0]);
        let rest = |a: Arithmetic| a.apply(Operator::Modulo, -7.0, 3.0).unwrap();
        assert_eq!([rest(Arithmetic::Ngc), rest(Arithmetic::MacroB)], [2.0, -1.0]);
        assert_eq!(
            [Arithmetic::Ngc.angle(-1.0, -1.0), Arithmetic::MacroB.angle(-1.0, -1.0)],
            [-135.0, 225.0]
        );
    }

    #[test]
    fn decimals_go_to_bits_and_back() {
        let bits = Arithmetic::MacroB.call(Function::ToDecimal, 1998.0).unwrap();
        assert_eq!(bits, f64::from(0x1998));
        assert_eq!(Arithmetic::MacroB.call(Function::FromDecimal, bits).unwrap(), 1998.0);
        assert!(Arithmetic::MacroB.call(Function::FromDecimal, 15.0).is_err());
    }
}
