//! A winding course for the tests of the law.

use std::f64::consts::TAU;

use super::{AxisLimit, Course};

pub(super) const LIMIT: AxisLimit = AxisLimit { velocity: 500.0, acceleration: 5000.0, jerk: 50_000.0 };

/// A path whose heading goes to and fro by 2 rad in 160 mm, no wave like the one before.
pub(super) struct Wave;

impl Course<2> for Wave {
    fn length(&self) -> f64 {
        1300.0
    }

    fn derivatives(&self, s: f64) -> [[f64; 3]; 2] {
        let w = TAU / 160.0;
        let (sine, cosine) = (w * s).sin_cos();
        let swell = 1.0 + 0.3 * (0.1 * w * s).sin();
        let [angle, bend, slope] =
            [2.0 * swell * sine, 2.0 * swell * w * cosine, -2.0 * swell * w * w * sine];
        let (y, x) = angle.sin_cos();
        [[x, -bend * y, -slope * y - bend * bend * x], [y, bend * x, slope * x - bend * bend * y]]
    }

    fn feed(&self, _: f64) -> f64 {
        300.0
    }

    fn knots(&self) -> &[f64] {
        &[]
    }

    fn finest(&self, _: f64) -> f64 {
        0.2
    }
}
