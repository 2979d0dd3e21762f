//! Speed of time laws: `cargo bench --bench motion`. Each number of cells is that of the grid, with two axes.

use std::f64::consts::TAU;
use std::hint::black_box;

use kinecut::motion::{AxisLimit, Course, TimeLaw, WithoutJerk};

fn main() {
    divan::main();
}

const LIMIT: AxisLimit = AxisLimit { velocity: 500.0, acceleration: 5000.0, jerk: 50_000.0 };
/// Length of a cell [mm].
const CELL: f64 = 0.2;

/// A path that winds: its heading goes to and fro by 2 rad in 160 mm, a little more from wave to wave.
struct Wave {
    length: f64,
}

impl Course<2> for Wave {
    fn length(&self) -> f64 {
        self.length
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
        CELL
    }
}

#[divan::bench(args = [10_000, 100_000, 1_000_000], sample_count = 1, sample_size = 1)]
fn under_jerk_limits(cells: u32) -> f64 {
    let wave = Wave { length: CELL * f64::from(cells) };
    TimeLaw::new(black_box(&wave), &[LIMIT; 2]).map_or(0.0, |law| law.duration())
}

#[divan::bench(args = [10_000, 100_000, 1_000_000], sample_count = 5, sample_size = 1)]
fn without_jerk_limits(cells: u32) -> f64 {
    let wave = Wave { length: CELL * f64::from(cells) };
    WithoutJerk::new(black_box(&wave), &[LIMIT; 2]).map_or(0.0, |law| law.duration())
}
