//! Speed of the involute method: `cargo bench --bench holes`.

use std::hint::black_box;

use kinecut::geom::arc_chain;
use kinecut::holes::{
    BoreSpec, CutterData, Entry, Finish, LeadEnd, Rough, engagement, plan_bore, roll, spiral,
};

fn main() {
    divan::main();
}

#[divan::bench]
fn roll_solver_10_000_radii(bencher: divan::Bencher) {
    let t: Vec<f64> = (0..10_000).map(|i| 10f64.powf(-6.0 + 11.0 * f64::from(i) / 10_000.0)).collect();
    bencher.bench(|| {
        t.iter().filter_map(|t| roll::roll_angle(black_box(*t)).ok()).map(|r| r.angle).sum::<f64>()
    });
}

#[divan::bench]
fn lead_in_of_the_paper() -> f64 {
    spiral::lead_in(black_box(80.0), 2, [-40.0, 40.0], 0.0).map_or(0.0, |l| l.psi)
}

#[divan::bench]
fn plan_of_the_papers_bore(bencher: divan::Bencher) {
    let cutter =
        CutterData { diameter: 40.0, centre_cutting: true, max_ramp_angle: None, flute_length: 45.0 };
    let spec = BoreSpec {
        entry: Entry::Plunge,
        rough: Some(Rough { allowance: 1.0, plunge_feed: 5.0, ..Rough::new(4.0, 100.0) }),
        finish: Some(Finish { start: LeadEnd::Point([-40.0, 40.0]), ..Finish::new(50.0) }),
        resolution: Some(1e-4),
        ..BoreSpec::new(200.0, 30.0, cutter)
    };
    bencher.bench(|| plan_bore(black_box(&spec)));
}

#[divan::bench(args = [0.01, 0.001, 0.0001])]
fn arc_chain_of_the_papers_spiral(bencher: divan::Bencher, eps: f64) {
    let record = spiral::from_centre(79.0, 20, 0.0).expect("the paper's numbers");
    bencher.bench(|| arc_chain(black_box(&record), eps));
}

#[divan::bench]
fn engagement_of_the_papers_spiral_500_places(bencher: divan::Bencher) {
    let path = [
        spiral::from_centre(79.0, 20, 0.0).expect("the paper's numbers"),
        spiral::circle(79.0, 0.0).expect("a positive radius"),
    ];
    bencher.bench(|| engagement(black_box(&path), 20.0, None, 500));
}
