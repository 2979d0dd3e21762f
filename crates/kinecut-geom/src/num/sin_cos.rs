//! Sine and cosine of two angles at once.
//!
//! The same operations on both, without a branch, so that a processor does them side by side: reduction to a quarter turn in
//! three parts (Cody, Waite 1980), minimax polynomials (Sun Microsystems 1993, the kernels of `fdlibm`).

/// A quarter turn in three parts; the first two have 33 bits, so that their products with the number of quarters are exact.
const QUARTER: [f64; 3] = [
    f64::from_bits(0x3ff9_21fb_5440_0000),
    f64::from_bits(0x3dd0_b461_1a60_0000),
    f64::from_bits(0x3ba3_198a_2e03_7073),
];
const SIN: [f64; 6] = [
    f64::from_bits(0xbfc5_5555_5555_5549),
    f64::from_bits(0x3f81_1111_1110_f8a6),
    f64::from_bits(0xbf2a_01a0_19c1_61d5),
    f64::from_bits(0x3ec7_1de3_57b1_fe7d),
    f64::from_bits(0xbe5a_e5e6_8a2b_9ceb),
    f64::from_bits(0x3de5_d93a_5acf_d57c),
];
const COS: [f64; 6] = [
    f64::from_bits(0x3fa5_5555_5555_554c),
    f64::from_bits(0xbf56_c16c_16c1_5177),
    f64::from_bits(0x3efa_01a0_19cb_1590),
    f64::from_bits(0xbe92_7e4f_809c_52ad),
    f64::from_bits(0x3e21_ee9e_bdb4_b1c4),
    f64::from_bits(0xbda8_fae9_be88_38d4),
];
/// Largest angle of the quick way [rad]: far within what the parts of the quarter turn are exact for.
const QUICK: f64 = 1e5;
/// Added to a number below 2^51 it leaves the nearest integer in the lowest bits.
const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// Sines and cosines of two angles [rad], within two units in the last place.
///
/// ```
/// # use kinecut_geom as kinecut;
/// let (sin, cos) = kinecut::num::sin_cos::pair([0.5, -2.0]);
/// assert!((sin[0] - 0.5f64.sin()).abs() < 1e-15 && (cos[1] - 2f64.cos()).abs() < 1e-15);
/// ```
#[inline]
pub fn pair(angles: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    if !(angles[0].abs() < QUICK && angles[1].abs() < QUICK) {
        let [a, b] = angles.map(f64::sin_cos);
        return ([a.0, b.0], [a.1, b.1]);
    }
    let (mut sin, mut cos, mut quarters) = ([0.0; 2], [0.0; 2], [0u64; 2]);
    for i in 0..2 {
        let shifted = angles[i] * std::f64::consts::FRAC_2_PI + TO_INTEGER;
        quarters[i] = shifted.to_bits();
        let k = shifted - TO_INTEGER;
        let r = ((angles[i] - k * QUARTER[0]) - k * QUARTER[1]) - k * QUARTER[2];
        let z = r * r;
        let (z2, z4) = (z * z, (z * z) * (z * z));
        let s = (SIN[0] + z * SIN[1]) + z2 * (SIN[2] + z * SIN[3]) + z4 * (SIN[4] + z * SIN[5]);
        let c = (COS[0] + z * COS[1]) + z2 * (COS[2] + z * COS[3]) + z4 * (COS[4] + z * COS[5]);
        sin[i] = r + r * z * s;
        let (half, one) = (0.5 * z, 1.0 - 0.5 * z);
        cos[i] = one + (((1.0 - one) - half) + z2 * c);
    }
    // In odd quarters sine and cosine change places, in the second half they change signs.
    for i in 0..2 {
        let (s, c, odd) = (sin[i].to_bits(), cos[i].to_bits(), 0u64.wrapping_sub(quarters[i] & 1));
        let sign = |q: u64| (q & 2) << 62;
        sin[i] = f64::from_bits(((s & !odd) | (c & odd)) ^ sign(quarters[i]));
        cos[i] = f64::from_bits(((c & !odd) | (s & odd)) ^ sign(quarters[i].wrapping_add(1)));
    }
    (sin, cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_the_libraries_own() {
        let mut worst = 0f64;
        for k in 0..400_000 {
            // Angles near to multiples of a quarter turn are where digits are lost.
            let base = f64::from(k % 40 - 20) * std::f64::consts::FRAC_PI_2;
            let a = base + 1e-9 * f64::from(k) * f64::from(k % 1013 - 506);
            let b = f64::from(k) * 0.247_1 - 49_000.0;
            let (sin, cos) = pair([a, b]);
            for (i, x) in [a, b].into_iter().enumerate() {
                let (s, c) = x.sin_cos();
                worst = worst.max(((sin[i] - s) / s).abs()).max(((cos[i] - c) / c).abs());
            }
        }
        assert!(worst < 4.5e-16, "{worst:e}");
        for x in [1e6, -3e5, f64::MAX, 1e5] {
            assert_eq!(pair([x, 0.0]).0[0], x.sin());
        }
        assert!(pair([f64::NAN, 0.0]).0[0].is_nan() && pair([0.0, f64::INFINITY]).1[1].is_nan());
    }
}
