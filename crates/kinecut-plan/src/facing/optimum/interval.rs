//! Sums, products and quotients of intervals of numbers.

use super::domain::Extent;

/// Least and greatest product.
#[inline]
pub(super) fn times(a: Extent, b: Extent) -> Extent {
    let p = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    let mut out = [p[0], p[0]];
    for x in &p[1..] {
        if *x < out[0] {
            out[0] = *x;
        }
        if *x > out[1] {
            out[1] = *x;
        }
    }
    out
}

/// Least and greatest sum.
#[inline]
pub(super) fn plus(a: Extent, b: Extent) -> Extent {
    [a[0] + b[0], a[1] + b[1]]
}

/// Least and greatest difference.
#[inline]
pub(super) fn minus(a: Extent, b: Extent) -> Extent {
    [a[0] - b[1], a[1] - b[0]]
}

/// Least and greatest quotient; `b` does not hold 0.
#[inline]
pub(super) fn over(a: Extent, b: Extent) -> Extent {
    times(a, [1.0 / b[1], 1.0 / b[0]])
}

/// The greatest absolute value.
#[inline]
pub(super) fn most(a: Extent) -> f64 {
    if a[1] > -a[0] { a[1] } else { -a[0] }
}

/// A bad length that has no kink on a box: its value in the middle, and the intervals in which its derivatives with
/// the angle [mm/rad] and with the offset [mm/mm] lie.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Smooth {
    pub(super) value: f64,
    pub(super) by_angle: Extent,
    pub(super) by_offset: Extent,
}

impl Smooth {
    /// Adds `weight` times another.
    #[inline]
    pub(super) fn add(&mut self, weight: f64, other: &Smooth) {
        self.value += weight * other.value;
        for k in 0..2 {
            self.by_angle[k] += weight * other.by_angle[k];
            self.by_offset[k] += weight * other.by_offset[k];
        }
    }

    /// Adds the place of one end of a bad stretch, with its derivatives; `end`: the stretch ends there.
    #[inline]
    pub(super) fn add_end(&mut self, end: bool, at: f64, by_angle: Extent, by_offset: Extent) {
        if end {
            self.value += at;
            self.by_angle = plus(self.by_angle, by_angle);
            self.by_offset = plus(self.by_offset, by_offset);
        } else {
            self.value -= at;
            self.by_angle = minus(self.by_angle, by_angle);
            self.by_offset = minus(self.by_offset, by_offset);
        }
    }
}
