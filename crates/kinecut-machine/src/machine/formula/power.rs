//! Powers with whole exponents.

/// Greatest whole exponent that is worked out by multiplying.
const MOST_POWER: i32 = 64;

/// The exponent, if it is a whole number that is worked out by multiplying.
pub(super) fn integer_power(exponent: f64) -> Option<i32> {
    (exponent.fract() == 0.0 && exponent.abs() <= f64::from(MOST_POWER)).then_some(exponent as i32)
}

/// Whole power by squaring; the same bits on every machine.
pub(super) fn powi(base: f64, exponent: i32) -> f64 {
    let mut result = 1.0;
    let mut square = base;
    let mut rest = exponent.unsigned_abs();
    while rest > 0 {
        if rest & 1 == 1 {
            result *= square;
        }
        square *= square;
        rest >>= 1;
    }
    if exponent < 0 { 1.0 / result } else { result }
}
