//! Speed of the involute method: `cargo bench --bench holes`.

use std::hint::black_box;

use kinecut::geom::arc_chain;
use kinecut::holes::{
    BoreSpec, CutterData, Entry, Finish, Rough, RoughStart, Sense, engagement, plan_bore, roll, spiral,
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
    let spec = BoreSpec {
        centre: [0.0, 0.0],
        top: 0.0,
        depth: 30.0,
        breakthrough: None,
        diameter: 200.0,
        cutter: CutterData { diameter: 40.0, centre_cutting: true, max_ramp_angle: None, flute_length: 45.0 },
        sense: Sense::Climb,
        start: RoughStart::Centre,
        entry: Entry::Plunge,
        rough: Some(Rough { step: 4.0, allowance: 1.0, feed: 100.0, plunge_feed: 5.0, axial_step: None }),
        finish: Some(Finish {
            turns: 2,
            feed: 50.0,
            start: Some([-40.0, 40.0]),
            end: None,
            axial_step: None,
            wear: None,
        }),
        retract_z: 50.0,
        approach_z: 2.0,
        resolution: Some(1e-4),
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
