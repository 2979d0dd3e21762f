//! Coordinate codes.

use crate::base::{Code, Finding, Result};

/// A coordinate code: motions from workpiece to tool; 1 2 3 translations along X Y Z, 4 5 6 rotations about
/// them (A B C), 0 the bed.
///
/// ```
/// use kinecut::machine::CoordinateCode;
/// let code = CoordinateCode::parse("2103").unwrap();
/// assert_eq!(code.to_string(), "2103");
/// assert_eq!(code.axes().collect::<String>(), "YXZ");
/// assert!(CoordinateCode::parse("213").is_err()); // no bed
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CoordinateCode(Vec<u8>);

impl CoordinateCode {
    /// Reads a code.
    ///
    /// # Errors
    /// `KC0702` for a digit that is no motion, a translation that stands twice, or not exactly one bed.
    pub fn parse(text: &str) -> Result<CoordinateCode> {
        let fail = |what: String| {
            Err(Finding::error(Code::MACHINE_CODE, format!("coordinate code `{text}` {what}"))
                .cure("write the motions from workpiece to tool, as in \"2103\": Y X bed Z")
                .into())
        };
        let mut digits = Vec::new();
        for c in text.chars() {
            match c.to_digit(10) {
                Some(d @ 0..=6) => digits.push(d as u8),
                _ => return fail(format!("has `{c}`, which is no motion")),
            }
        }
        for d in 0..=6u8 {
            let n = digits.iter().filter(|&&x| x == d).count();
            if d == 0 && n != 1 {
                return fail(format!("has {n} beds (0), and needs one"));
            }
            if d > 0 && n > 1 {
                return fail(format!("has motion {d} {n} times"));
            }
        }
        Ok(CoordinateCode(digits))
    }

    /// Axis letters from workpiece to tool, without the bed.
    pub fn axes(&self) -> impl Iterator<Item = char> + '_ {
        self.0.iter().filter(|&&d| d > 0).map(|&d| b"XYZABC"[d as usize - 1] as char)
    }
}

impl std::fmt::Display for CoordinateCode {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.iter().try_for_each(|d| write!(f, "{d}"))
    }
}
