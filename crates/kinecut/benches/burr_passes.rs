//! Speed of several passes over a face: `cargo bench --bench burr_passes`.

#![allow(clippy::unwrap_used, reason = "a bench panics when it fails")]

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec2, dvec2};
use kinecut::base::Silent;
use kinecut::facing::passes::{
    Corner, Fill, FrameOptions, PassOptions, PassPath, RowWays, best_rows, frames, pareto, path_burr,
    uncovered,
};
use kinecut::facing::{BadSet, FaceCase};
use kinecut::geom::{Outline, OutlineEdge};

fn main() {
    divan::main();
}

/// A plate of 400 x 200 with 20 round bores.
fn block(radius: f64) -> FaceCase {
    let corners = [dvec2(0.0, 0.0), dvec2(400.0, 0.0), dvec2(400.0, 200.0), dvec2(0.0, 200.0)];
    let mut loops = vec![Outline::polygon(&corners).unwrap().edges().to_vec()];
    for k in 0..20 {
        let at = dvec2(40.0 + 80.0 * f64::from(k % 5), 25.0 + 50.0 * f64::from(k / 5));
        loops.push(vec![OutlineEdge::arc(at, 8.0 + f64::from(k % 3), 0.1, TAU)]);
    }
    FaceCase::new(Outline::new(loops, vec![]).unwrap(), radius, BadSet::below(FRAC_PI_2).unwrap()).unwrap()
}

/// A star of 1000 short edges.
fn thousand_edges(radius: f64) -> FaceCase {
    let corner = |k: usize| {
        let out = 100.0 + 6.0 * (k % 2) as f64 + 20.0 * (0.05 * k as f64).sin();
        out * DVec2::from_angle(TAU * k as f64 / 1000.0)
    };
    let corners: Vec<DVec2> = (0..1000).map(corner).collect();
    let outline = Outline::polygon(&corners).unwrap();
    FaceCase::new(outline, radius, BadSet::below(FRAC_PI_2).unwrap()).unwrap()
}

fn round(case: &FaceCase) -> PassPath {
    let options = FrameOptions {
        outside: 10.0,
        corner: Corner::Round,
        fill: Fill::Rings,
        holes: false,
        margin: 0.5,
        clearance: 5.0,
    };
    frames(case, &options).unwrap()
}

#[divan::bench]
fn exit_angles_of_frames_on_20_bores(bencher: divan::Bencher) {
    let case = block(40.0);
    let path = round(&case);
    bencher.bench(|| path_burr(&case, &path).bad);
}

#[divan::bench]
fn exit_angles_of_a_pass_over_1000_edges(bencher: divan::Bencher) {
    let case = thousand_edges(130.0);
    let path = PassPath::lines(&[vec![dvec2(-300.0, 3.0), dvec2(300.0, -4.0)]]);
    bencher.bench(|| path_burr(&case, &path).bad);
}

#[divan::bench]
fn best_four_rows_of_20_bores(bencher: divan::Bencher) {
    let case = block(40.0);
    bencher.bench(|| best_rows(&case, 0.0, 4, 0.5, RowWays::Free));
}

#[divan::bench]
fn frames_and_rings_of_20_bores(bencher: divan::Bencher) {
    let case = block(40.0);
    bencher.bench(|| round(&case));
}

#[divan::bench]
fn coverage_of_20_bores(bencher: divan::Bencher) {
    let case = block(40.0);
    let path = round(&case);
    bencher.bench(|| uncovered(&case, &path, 0.5, 9));
}

#[divan::bench(sample_count = 3)]
fn all_plans_of_20_bores(bencher: divan::Bencher) {
    let case = block(40.0);
    bencher.bench(|| pareto(&case, &[], &PassOptions::default(), &Silent).unwrap().len());
}

#[divan::bench(sample_count = 1)]
fn all_plans_of_1000_edges(bencher: divan::Bencher) {
    let case = thousand_edges(60.0);
    bencher.bench(|| pareto(&case, &[], &PassOptions::default(), &Silent).unwrap().len());
}
