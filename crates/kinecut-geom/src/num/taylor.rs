//! Truncated power series: a function and its derivatives at a point, exactly, to any order.
//!
//! Arithmetic on the coefficients of `f(x0 + h) = c0 + c1 h + c2 h^2 + ..` is what the derivatives of curves are
//! made of here: one formula for the curve gives its tangent, curvature and every further order of contact.
//! Source: Knuth, The Art of Computer Programming, volume 2, section 4.7.

use std::ops::{Add, Mul, Neg, Sub};

/// The first `N` coefficients of a power series.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::num::taylor::Taylor;
/// let x = Taylor::<4>::variable(0.5);
/// let (sin, _) = x.sin_cos();
/// assert!((sin.derivative(3) + 0.5f64.cos()).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taylor<const N: usize>(pub [f64; N]);

impl<const N: usize> Taylor<N> {
    /// A constant.
    pub fn constant(value: f64) -> Taylor<N> {
        let mut c = [0.0; N];
        c[0] = value;
        Taylor(c)
    }

    /// The variable itself, at a value.
    pub fn variable(value: f64) -> Taylor<N> {
        let mut c = [0.0; N];
        c[0] = value;
        if N > 1 {
            c[1] = 1.0;
        }
        Taylor(c)
    }

    /// The value at the point.
    pub fn value(&self) -> f64 {
        self.0[0]
    }

    /// The derivative of an order below `N` at the point.
    pub fn derivative(&self, order: usize) -> f64 {
        (1..=order).fold(self.0[order], |d, k| d * k as f64)
    }

    /// The value at a distance `h` from the point.
    pub fn at(&self, h: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, c| sum * h + c)
    }

    /// The series of the derivative; its last coefficient is not known and set to zero.
    #[must_use]
    pub fn differentiated(&self) -> Taylor<N> {
        let mut c = [0.0; N];
        for k in 1..N {
            c[k - 1] = self.0[k] * k as f64;
        }
        Taylor(c)
    }

    /// The series of the integral from the point, with the value `start` there.
    #[must_use]
    pub fn integrated(&self, start: f64) -> Taylor<N> {
        let mut c = [0.0; N];
        c[0] = start;
        for k in 1..N {
            c[k] = self.0[k - 1] / k as f64;
        }
        Taylor(c)
    }

    /// Times a number.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Taylor<N> {
        Taylor(self.0.map(|c| c * by))
    }

    /// One over the series; not a number where it is zero.
    #[must_use]
    pub fn recip(&self) -> Taylor<N> {
        let mut c = [0.0; N];
        c[0] = 1.0 / self.0[0];
        for k in 1..N {
            let sum: f64 = (1..=k).map(|i| self.0[i] * c[k - i]).sum();
            c[k] = -sum * c[0];
        }
        Taylor(c)
    }

    /// The square root; not a number where it is zero.
    #[must_use]
    pub fn sqrt(&self) -> Taylor<N> {
        let mut c = [0.0; N];
        c[0] = self.0[0].sqrt();
        for k in 1..N {
            let sum: f64 = (1..k).map(|i| c[i] * c[k - i]).sum();
            c[k] = (self.0[k] - sum) / (2.0 * c[0]);
        }
        Taylor(c)
    }

    /// Sine and cosine.
    #[must_use]
    pub fn sin_cos(&self) -> (Taylor<N>, Taylor<N>) {
        let (mut s, mut c) = ([0.0; N], [0.0; N]);
        (s[0], c[0]) = self.0[0].sin_cos();
        for k in 1..N {
            let (mut ds, mut dc) = (0.0, 0.0);
            for i in 1..=k {
                let weight = i as f64 * self.0[i];
                ds += weight * c[k - i];
                dc -= weight * s[k - i];
            }
            (s[k], c[k]) = (ds / k as f64, dc / k as f64);
        }
        (Taylor(s), Taylor(c))
    }

    /// `self` at `inner`, whose first coefficient is the point of `self` and is not looked at.
    #[must_use]
    pub fn compose(&self, inner: &Taylor<N>) -> Taylor<N> {
        let mut step = *inner;
        step.0[0] = 0.0;
        let mut sum = Taylor::constant(self.0[N - 1]);
        for k in (0..N - 1).rev() {
            sum = sum * step;
            sum.0[0] += self.0[k];
        }
        sum
    }

    /// The series of the inverse function about the value, whose own value is `point`. Not a number where the
    /// first derivative is zero.
    #[must_use]
    pub fn inverted(&self, point: f64) -> Taylor<N> {
        // One coefficient a round: g_k from what is left of f(g(y)) - y at order k.
        let mut inverse = Taylor::constant(point);
        if N > 1 {
            inverse.0[1] = 1.0 / self.0[1];
        }
        for k in 2..N {
            let left = self.compose(&inverse).0[k];
            inverse.0[k] = -left / self.0[1];
        }
        inverse
    }
}

impl<const N: usize> Add for Taylor<N> {
    type Output = Taylor<N>;
    fn add(mut self, other: Taylor<N>) -> Taylor<N> {
        self.0.iter_mut().zip(other.0).for_each(|(a, b)| *a += b);
        self
    }
}

impl<const N: usize> Add<f64> for Taylor<N> {
    type Output = Taylor<N>;
    fn add(mut self, other: f64) -> Taylor<N> {
        self.0[0] += other;
        self
    }
}

impl<const N: usize> Sub for Taylor<N> {
    type Output = Taylor<N>;
    fn sub(mut self, other: Taylor<N>) -> Taylor<N> {
        self.0.iter_mut().zip(other.0).for_each(|(a, b)| *a -= b);
        self
    }
}

impl<const N: usize> Neg for Taylor<N> {
    type Output = Taylor<N>;
    fn neg(self) -> Taylor<N> {
        self.scaled(-1.0)
    }
}

impl<const N: usize> Mul for Taylor<N> {
    type Output = Taylor<N>;
    fn mul(self, other: Taylor<N>) -> Taylor<N> {
        let mut c = [0.0; N];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0[..N - i].iter().enumerate() {
                c[i + j] += a * b;
            }
        }
        Taylor(c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type T = Taylor<8>;

    fn close(a: T, b: T) {
        for (x, y) in a.0.iter().zip(b.0) {
            assert!((x - y).abs() < 1e-9 * (1.0 + y.abs()), "{a:?} {b:?}");
        }
    }

    #[test]
    fn the_exponential_of_a_known_series() {
        // Derivatives of sqrt(x) at 4: 1/4, -1/32, 3/256.
        let root = Taylor::<4>::variable(4.0).sqrt();
        assert_eq!([0, 1, 2, 3].map(|k| root.derivative(k)), [2.0, 0.25, -1.0 / 32.0, 3.0 / 256.0]);
        assert_eq!(root.integrated(1.0).differentiated().0[..3], root.0[..3]);
        assert!((root.at(0.01) - 4.01f64.sqrt()).abs() < 1e-9);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn the_identities_hold(c in proptest::array::uniform8(-1.0..1.0f64), lead in 0.5..2.0f64) {
            let mut x = Taylor(c);
            x.0[0] = lead;
            let one = T::constant(1.0);
            close(x * x.recip(), one);
            close(x.sqrt() * x.sqrt(), x);
            let (s, k) = x.sin_cos();
            close(s * s + k * k, one);
            // d sin x = cos x dx, but for the coefficient that the derivative does not know.
            let (mut a, mut b) = (s.differentiated(), k * x.differentiated());
            (a.0[7], b.0[7]) = (0.0, 0.0);
            close(a, b);
            x.0[1] = lead;
            let inverse = x.inverted(0.25);
            let mut identity = T::variable(x.value());
            close(x.compose(&inverse), identity);
            identity.0[0] = 0.25;
            close(inverse.compose(&x), identity);
        }
    }
}
