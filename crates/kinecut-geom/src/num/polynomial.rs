//! Roots of a polynomial in an interval, for those who look for every place at which a curve can be extreme.
//!
//! Between two neighbouring roots of its derivative a polynomial is monotone, so that a change of sign brackets exactly
//! one root; the derivative's roots come the same way, down to a line. A double root is a root of the derivative where
//! the value does not change sign: it may be left out.

use super::root::bracketed_newton;

/// Evaluations of one bracketed root; halving alone would need 1100 in the worst case, Newton needs about 8.
const LIMIT: u32 = 200;

/// The roots at which a polynomial of degree 4, coefficients from the constant upwards, changes its sign between `lo`
/// and `hi`, ascending.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::num::polynomial::quartic_roots;
/// // (x - 1)(x - 2)(x + 3)(x - 9)
/// let found: Vec<f64> = quartic_roots([-54.0, 69.0, -7.0, -9.0, 1.0], 0.0, 5.0).collect();
/// assert!(found.len() == 2 && (found[0] - 1.0).abs() < 1e-12 && (found[1] - 2.0).abs() < 1e-12);
/// ```
pub fn quartic_roots(c: [f64; 5], lo: f64, hi: f64) -> impl Iterator<Item = f64> {
    // Row k: the polynomial of degree k + 1 in the chain of derivatives.
    let mut chain = [[0.0; 5]; 4];
    chain[3] = c;
    for k in (0..3).rev() {
        for i in 0..4 {
            chain[k][i] = chain[k + 1][i + 1] * (i + 1) as f64;
        }
    }
    let (mut roots, mut count) = ([0.0; 4], 0);
    for (degree, p) in chain.iter().enumerate() {
        let (mut next, mut n) = ([0.0; 4], 0);
        let mut from = lo;
        for i in 0..=count {
            let to = if i < count { roots[i] } else { hi };
            let [a, b] = [from, to].map(|x| value(p, x)[0]);
            if n <= degree && to > from && (a < 0.0) != (b < 0.0) {
                let sign = if a < 0.0 { 1.0 } else { -1.0 };
                let f = |x: f64| {
                    let [v, d] = value(p, x);
                    (sign * v, sign * d)
                };
                next[n] = bracketed_newton(f, 0.5 * (from + to), from, to, LIMIT).0;
                n += 1;
            }
            from = to;
        }
        (roots, count) = (next, n);
    }
    roots.into_iter().take(count)
}

/// Value and slope.
fn value(p: &[f64; 5], x: f64) -> [f64; 2] {
    let (mut v, mut d) = (0.0, 0.0);
    for &c in p.iter().rev() {
        d = d * x + v;
        v = v * x + c;
    }
    [v, d]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn roots_that_were_put_in_come_out(mut r in prop::array::uniform4(-5.0..5.0f64)) {
            r.sort_by(f64::total_cmp);
            prop_assume!(r.windows(2).all(|w| w[1] - w[0] > 1e-3));
            let mut c = [1.0, 0.0, 0.0, 0.0, 0.0];
            for root in r {
                for i in (0..5).rev() {
                    c[i] = if i > 0 { c[i - 1] } else { 0.0 } - root * c[i];
                }
            }
            let found: Vec<f64> = quartic_roots(c, -6.0, 6.0).collect();
            prop_assert_eq!(found.len(), 4);
            for (a, b) in found.iter().zip(r) {
                prop_assert!((a - b).abs() < 1e-6, "{:?} {:?}", found, r);
            }
            prop_assert_eq!(quartic_roots(c, r[1] + 1e-4, r[3] - 1e-4).count(), 1);
        }
    }

    #[test]
    fn lower_degrees_and_nothing() {
        assert_eq!(quartic_roots([-2.0, 1.0, 0.0, 0.0, 0.0], 0.0, 5.0).collect::<Vec<_>>(), [2.0]);
        assert_eq!(quartic_roots([1.0, 0.0, 1.0, 0.0, 0.0], -5.0, 5.0).count(), 0);
        assert_eq!(quartic_roots([0.0; 5], -5.0, 5.0).count(), 0);
    }
}
