//! Sine and cosine of one angle together.
//!
//! Kinematics takes one pair for each rotary axis of each pose; the pair of the platform's library takes most of the time
//! of a pose, and its last bit depends on the platform. Here the angle is reduced by multiples of a quarter turn in three
//! parts (Cody, Waite), and both functions follow from the minimax polynomials of fdlibm (Sun Microsystems, 1993;
//! `k_sin.c`, `k_cos.c`, `e_rem_pio2.c`), good to one unit in the last place.

use std::f64::consts::FRAC_2_PI;

/// A quarter turn in three parts: the first two of 33 bits, so that their multiples are exact, and the rest.
const QUARTER: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
/// Angles beyond this are left to the library [rad]: the multiple has 20 bits, as the parts above allow.
const MOST: f64 = 1e6;
/// Adding and taking it away rounds to an integer.
const ROUNDING: f64 = 1.5 * (1u64 << 52) as f64;

/// Sine and cosine of an angle [rad], good to one unit in the last place.
///
/// ```
/// let (sin, cos) = kinecut::num::sine::sin_cos(2.0);
/// assert!((sin - 2f64.sin()).abs() < 2.3e-16 && (cos - 2f64.cos()).abs() < 2.3e-16);
/// ```
#[inline]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    if !(angle.abs() < MOST) {
        return angle.sin_cos();
    }
    let multiple = (angle * FRAC_2_PI + ROUNDING) - ROUNDING;
    // The rest as a sum of two numbers.
    let first = angle - multiple * QUARTER[0];
    let second = multiple * QUARTER[1];
    let rest = first - second;
    let small = multiple * QUARTER[2] - ((first - rest) - second);
    let x = rest - small;
    let y = (rest - x) - small;
    let (sin, cos) = (sine(x, y), cosine(x, y));
    let turned = if multiple as i64 & 1 == 0 { (sin, cos) } else { (cos, -sin) };
    if multiple as i64 & 2 == 0 { turned } else { (-turned.0, -turned.1) }
}

/// Sine of `x + y`, with `|x| < pi / 4` and `y` far smaller.
#[inline]
fn sine(x: f64, y: f64) -> f64 {
    const S: [f64; 6] = [
        -1.666_666_666_666_663_2e-1,
        8.333_333_333_322_49e-3,
        -1.984_126_982_985_795e-4,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ];
    let z = x * x;
    let w = z * z;
    let v = z * x;
    let r = S[1] + z * (S[2] + z * S[3]) + z * w * (S[4] + z * S[5]);
    x - ((z * (0.5 * y - v * r) - y) - v * S[0])
}

/// Cosine of `x + y`, with `|x| < pi / 4` and `y` far smaller.
#[inline]
fn cosine(x: f64, y: f64) -> f64 {
    const C: [f64; 6] = [
        4.166_666_666_666_66e-2,
        -1.388_888_888_887_411e-3,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ];
    let z = x * x;
    let w = z * z;
    let r = z * (C[0] + z * (C[1] + z * C[2])) + w * w * (C[3] + z * (C[4] + z * C[5]));
    let half = 0.5 * z;
    let whole = 1.0 - half;
    whole + (((1.0 - whole) - half) + (z * r - x * y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn assert_good(angle: f64) {
        let (sin, cos) = sin_cos(angle);
        // One unit in the last place of a number, and half of one that the library may be off.
        let near = |have: f64, want: f64| (have - want).abs() <= 1.6 * f64::EPSILON * want.abs();
        assert!(near(sin, angle.sin()) && near(cos, angle.cos()), "{angle} {sin} {cos}");
    }

    proptest! {
        #[test]
        fn agrees_with_the_library(near in -7.0..7.0f64, far in -1.1e6..1.1e6f64) {
            assert_good(near);
            assert_good(far);
        }
    }

    #[test]
    fn keeps_its_digits_beside_multiples_of_a_quarter_turn() {
        for k in -2000..2000 {
            let angle = f64::from(k) * std::f64::consts::FRAC_PI_2;
            for off in [0.0, 1e-9, -1e-9, 1e-16] {
                assert_good(angle + off);
            }
        }
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        assert!(sin_cos(-0.0).0.is_sign_negative());
        assert!(sin_cos(f64::NAN).0.is_nan() && sin_cos(f64::INFINITY).1.is_nan());
    }
}
