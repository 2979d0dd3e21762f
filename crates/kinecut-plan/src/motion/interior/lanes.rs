//! Numbers of cells beside each other.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Cells whose numbers are computed together.
pub(super) const LANES: usize = 4;

/// One number of each of some cells.
#[derive(Clone, Copy)]
#[repr(align(32))]
pub(super) struct Lanes(pub(super) [f64; LANES]);

impl Lanes {
    pub(super) const ZERO: Lanes = Lanes([0.0; LANES]);
    pub(super) const ONE: Lanes = Lanes([1.0; LANES]);

    #[inline(always)]
    pub(super) fn all(value: f64) -> Lanes {
        Lanes([value; LANES])
    }

    /// Numbers of a list from a place on.
    #[inline(always)]
    pub(super) fn at(list: &[f64], place: usize) -> Lanes {
        let some = &list[place..place + LANES];
        Lanes([some[0], some[1], some[2], some[3]])
    }

    #[inline(always)]
    pub(super) fn put(self, list: &mut [f64], place: usize) {
        list[place..place + LANES].copy_from_slice(&self.0);
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Lanes {
        let [a, b, c, d] = self.0;
        Lanes([a.sqrt(), b.sqrt(), c.sqrt(), d.sqrt()])
    }

    #[inline(always)]
    pub(super) fn max(self, other: Lanes) -> Lanes {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        Lanes([larger(a, e), larger(b, f), larger(c, g), larger(d, h)])
    }

    #[inline(always)]
    pub(super) fn min(self, other: Lanes) -> Lanes {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        Lanes([smaller(a, e), smaller(b, f), smaller(c, g), smaller(d, h)])
    }

    pub(super) fn sum(self) -> f64 {
        self.0.iter().sum()
    }

    pub(super) fn most(self) -> f64 {
        self.0.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    pub(super) fn least(self) -> f64 {
        self.0.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// Of two numbers; without a care for those that are none, which costs an instruction less.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

// Number by number and without iterators: these are not always taken apart.
macro_rules! by_number {
    ($($operator:ident, $name:ident, $sign:tt;)*) => {$(
        impl $operator for Lanes {
            type Output = Lanes;
            #[inline(always)]
            fn $name(self, other: Lanes) -> Lanes {
                let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
                Lanes([a $sign e, b $sign f, c $sign g, d $sign h])
            }
        }
    )*};
}

by_number! { Add, add, +; Sub, sub, -; Mul, mul, *; Div, div, /; }

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Lanes) {
        *self = *self + other;
    }
}

impl Neg for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn neg(self) -> Lanes {
        Lanes::ZERO - self
    }
}

/// Sum of the products of three numbers with three others.
#[inline(always)]
pub(super) fn dot(a: &[Lanes; 3], x: &[Lanes; 3]) -> Lanes {
    a[0] * x[0] + a[1] * x[1] + a[2] * x[2]
}
