//! Change of height along a plane curve.

use crate::num::taylor::Taylor;

/// Shape of the change, from 0 to 1 over a fraction of arc length from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RiseShape {
    /// In proportion.
    Even,
    /// `35 x^4 - 84 x^5 + 70 x^6 - 20 x^7`: three derivatives vanish at both ends; steepest 2.1875 in the middle.
    Smooth,
    /// `2 (x - 2.5 x^4 + 3 x^5 - x^6)`: begins with slope 2 and two vanishing higher derivatives, ends level with
    /// three vanishing derivatives: the foot of a helix.
    FadeOut,
}

impl RiseShape {
    fn coefficients(self) -> [f64; 8] {
        match self {
            RiseShape::Even => [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            RiseShape::Smooth => [0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0],
            RiseShape::FadeOut => [0.0, 2.0, 0.0, 0.0, -5.0, 6.0, -2.0, 0.0],
        }
    }

    /// Largest slope.
    pub fn steepest(self) -> f64 {
        match self {
            RiseShape::Even => 1.0,
            RiseShape::Smooth => 2.1875,
            RiseShape::FadeOut => 2.0,
        }
    }
}

/// Change of height along a plane curve, which may be a part of a longer one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rise {
    shape: RiseShape,
    /// Change over the whole curve [mm].
    height: f64,
    /// The part of the whole that this is, as fractions of its arc length; the first may be the larger.
    part: [f64; 2],
}

impl Rise {
    /// No change.
    pub const NONE: Rise = Rise { shape: RiseShape::Even, height: 0.0, part: [0.0, 1.0] };

    /// A change by `height` [mm] (up is positive) of some shape.
    pub fn new(shape: RiseShape, height: f64) -> Rise {
        Rise { shape, height, part: [0.0, 1.0] }
    }

    /// A change by `height` [mm] in proportion to arc length.
    pub fn even(height: f64) -> Rise {
        Rise::new(RiseShape::Even, height)
    }

    /// The change, when it is in proportion to arc length [mm].
    pub fn is_even(&self) -> Option<f64> {
        (self.shape == RiseShape::Even || self.height == 0.0).then(|| self.total())
    }

    /// Height above the start at a fraction of the curve's plane arc length, as a series by that fraction [mm].
    pub fn series<const N: usize>(&self, fraction: f64) -> Taylor<N> {
        let width = self.part[1] - self.part[0];
        let mut x = Taylor::<N>::constant(self.part[0] + width * fraction);
        if N > 1 {
            x.0[1] = width;
        }
        let base = self.shape_at(self.part[0]);
        (self.power_series(x) + -base).scaled(self.height)
    }

    fn power_series<const N: usize>(&self, x: Taylor<N>) -> Taylor<N> {
        let c = self.shape.coefficients();
        c.iter().rev().fold(Taylor::constant(0.0), |sum, c| sum * x + *c)
    }

    fn shape_at(&self, x: f64) -> f64 {
        self.power_series(Taylor::<1>::constant(x)).value()
    }

    /// Height above the start at a fraction of the curve's plane arc length [mm].
    pub fn at(&self, fraction: f64) -> f64 {
        self.series::<1>(fraction).value()
    }

    /// Height of the end above the start [mm].
    pub fn total(&self) -> f64 {
        self.height * (self.shape_at(self.part[1]) - self.shape_at(self.part[0]))
    }

    /// The rise of the part of the curve between two fractions of its plane arc length.
    #[must_use]
    pub fn part(&self, a: f64, b: f64) -> Rise {
        let width = self.part[1] - self.part[0];
        let at = |f: f64| match f {
            1.0 => self.part[1],
            f => self.part[0] + width * f,
        };
        Rise { part: [at(a), at(b)], ..*self }
    }

    /// The rise of the curve run the other way.
    #[must_use]
    pub fn reversed(&self) -> Rise {
        Rise { part: [self.part[1], self.part[0]], ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_each_shape_are_as_smooth_as_said() {
        for (shape, first, last) in
            [(RiseShape::Smooth, [0.0, 0.0, 0.0], [0.0; 3]), (RiseShape::FadeOut, [2.0, 0.0, 0.0], [0.0; 3])]
        {
            let rise = Rise::new(shape, 1.0);
            assert!((rise.total() - 1.0).abs() < 1e-14);
            for (at, wanted) in [(0.0, first), (1.0, last)] {
                let s = rise.series::<4>(at);
                for (k, w) in wanted.iter().enumerate() {
                    assert!((s.derivative(k + 1) - w).abs() < 1e-12, "{shape:?} {at} {k}");
                }
            }
            let steepest =
                (0..=1000).map(|i| rise.series::<2>(f64::from(i) / 1e3).derivative(1)).fold(0.0, f64::max);
            assert!((steepest - shape.steepest()).abs() < 1e-9);
        }
    }

    #[test]
    fn the_parts_of_a_rise_are_the_whole() {
        let rise = Rise::new(RiseShape::Smooth, -3.0);
        let (a, b) = (rise.part(0.0, 0.3), rise.part(0.3, 1.0));
        assert!((a.total() + b.total() + 3.0).abs() < 1e-14);
        assert!((a.total() + b.at(0.5) - rise.at(0.65)).abs() < 1e-14);
        let back = b.reversed();
        assert!((back.total() + b.total()).abs() < 1e-14);
        assert!((back.at(0.25) - (b.at(0.75) - b.total())).abs() < 1e-14);
        assert_eq!(Rise::even(2.0).is_even(), Some(2.0));
        assert_eq!(rise.is_even(), None);
    }
}
