//! A number of a word, from its letters.

/// Digits that are exact as a double, and the powers of ten for as many decimals.
const EXACT_DIGITS: usize = 15;
const POWERS: [f64; EXACT_DIGITS + 1] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// A number as it is written.
#[derive(Debug)]
pub(in crate::nc) struct Number {
    /// The double nearest to it; `None` where there is no digit.
    pub(in crate::nc) value: Option<f64>,
    /// One past its last byte.
    pub(in crate::nc) end: usize,
    /// Whether there are blanks within.
    pub(in crate::nc) torn: bool,
    /// Whether it has a decimal point.
    pub(in crate::nc) point: bool,
}

impl Number {
    /// The number from `from` on, as far as one goes; `blanks`: they count for nothing.
    pub(in crate::nc) fn written(text: &str, from: usize, blanks: bool) -> Number {
        let bytes = text.as_bytes();
        let (mut digits, mut decimals) = (0, 0);
        // The digits as a whole number, as long as they are few.
        let mut whole = 0u64;
        let mut number = Number { value: None, end: from, torn: false, point: false };
        let mut blank = false;
        let mut at = from;
        while let Some(byte) = bytes.get(at) {
            match byte {
                b'0'..=b'9' => {
                    digits += 1;
                    decimals += usize::from(number.point);
                    whole = whole.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
                }
                b'.' if !number.point => number.point = true,
                b' ' | b'\t' if blanks => {
                    blank = true;
                    at += 1;
                    continue;
                }
                b'+' | b'-' if at == from => {}
                _ => break,
            }
            at += 1;
            number.end = at;
            number.torn = blank;
        }
        let written = &text[from..number.end];
        number.value = match (digits, number.torn) {
            (0, _) => None,
            // Both are exact as doubles, so their quotient is the double nearest to what is written.
            (1..=EXACT_DIGITS, _) => {
                // At most fifteen digits: a signed number converts in one step.
                let value = whole as i64 as f64 / POWERS[decimals];
                Some(if bytes[from] == b'-' { -value } else { value })
            }
            (_, false) => written.parse().ok(),
            (_, true) => written.replace([' ', '\t'], "").parse().ok(),
        };
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_number_ends_where_it_ends() {
        let written = |text: &str, blanks| {
            let n = Number::written(text, 1, blanks);
            (n.value, n.end, n.torn, n.point)
        };
        assert_eq!(written("X-0.125 Y1", false), (Some(-0.125), 7, false, true));
        assert_eq!(written("X-0.125 Y1", true), (Some(-0.125), 7, false, true));
        assert_eq!(written("X1 2. 5 Y1", true), (Some(12.5), 7, true, true));
        assert_eq!(written("X1 2", false), (Some(1.0), 2, false, false));
        assert_eq!(written("X5.", false), (Some(5.0), 3, false, true));
        assert_eq!(written("X1.2.3", false), (Some(1.2), 4, false, true));
        assert_eq!(written("X-.", false), (None, 3, false, true));
        assert!(written("X-0", false).0.is_some_and(|v| v == 0.0 && v.is_sign_negative()));
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(4096))]
        #[test]
        fn it_is_the_double_nearest_to_what_is_written(text in "[-+]?[0-9]{1,12}(\\.[0-9]{0,9})?") {
            let value = Number::written(&text, 0, false).value.unwrap();
            prop_assert_eq!(value.to_bits(), text.parse::<f64>().unwrap().to_bits());
        }
    }
}
