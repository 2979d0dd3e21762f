//! The grazing curve of a tool of five elements on one core: found, and sampled at 64 points, in under 3 us.

use divan::{Bencher, black_box};
use glam::DVec3;
use kinecut::machine::Twist;
use kinecut::sweep::{Grazing, ProfileChain};
use kinecut::tool::{Contour, ContourElement, Role};

fn main() {
    divan::main();
}

/// A bull-nose cutter with a conical neck: disc, torus, cylinder, cone, disc, and the four edges between them.
fn five_elements() -> ProfileChain {
    let contour = Contour::new(vec![
        ContourElement::line([0.0, 0.0], [3.0, 0.0], Role::Cutting),
        ContourElement::arc([3.0, 2.0], 2.0, -std::f64::consts::FRAC_PI_2, 0.0, Role::Cutting),
        ContourElement::line([5.0, 2.0], [5.0, 20.0], Role::Cutting),
        ContourElement::line([5.0, 20.0], [4.0, 40.0], Role::Shank),
        ContourElement::line([4.0, 40.0], [0.0, 40.0], Role::Shank),
    ]);
    ProfileChain::new(&contour.expect("a contour"))
}

/// A five-axis move: one curve.
const MOVE: Twist = Twist { turn: DVec3::new(0.1, 0.3, 0.05), shift: DVec3::new(20.0, 3.0, -2.0) };

#[divan::bench]
fn found(bencher: Bencher) {
    let (chain, mut grazing) = (five_elements(), Grazing::none());
    bencher.bench_local(|| {
        chain.grazing_into(black_box(&MOVE), &mut grazing);
        grazing.spans.len()
    });
}

#[divan::bench]
fn found_and_sampled_at_64_points(bencher: Bencher) {
    let (chain, mut grazing) = (five_elements(), Grazing::none());
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
