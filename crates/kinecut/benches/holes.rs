//! Speed of the involute method: `cargo bench --bench holes`.

use std::hint::black_box;

use kinecut::geom::{InvoluteRecord, LensOrder, arc_chain};
use kinecut::holes::clearing::{Clearing, Disc, EllipsePocket, ellipse};
use kinecut::holes::{
    BoreSpec, CutterData, Entry, Finish, LeadEnd, Rough, engagement, lead_in, plan_bore, roll, spiral,
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
    lead_in::lead_in(black_box(80.0), 2, [-40.0, 40.0], 0.0).map_or(0.0, |l| l.psi)
}

#[divan::bench]
fn plan_of_the_papers_bore(bencher: divan::Bencher) {
    let cutter =
        CutterData { diameter: 40.0, centre_cutting: true, max_ramp_angle: None, flute_length: 45.0 };
    let spec = BoreSpec {
        entry: Some(Entry::Plunge),
        rough: Some(Rough { allowance: 1.0, plunge_feed: Some(5.0), ..Rough::new(4.0, 100.0) }),
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
        InvoluteRecord::circle(79.0, 0.0).expect("a positive radius"),
    ];
    bencher.bench(|| engagement(black_box(&path), 20.0, None, 500));
}

/// The paper's rough pass (R 79, cutter 40, step 4) from an entry helix of radius 10, engagement 60 degrees.
#[divan::bench(args = [
    "involute", "lens-1", "lens-2", "constant-engagement", "constant-engagement-free-step", "arcs-2", "arcs-4",
    "archimedean", "rings", "rings-tangent", "trochoidal",
])]
fn clearing_r79_step4_from_r10(bencher: divan::Bencher, name: &str) {
    let clearing = match name {
        "lens-1" => Clearing::Lens(LensOrder::One),
        "lens-2" => Clearing::Lens(LensOrder::Two),
        "constant-engagement" | "constant-engagement-free-step" => {
            Clearing::ConstantEngagement(LensOrder::One)
        }
        "arcs-2" => Clearing::Poles(2),
        "arcs-4" => Clearing::Poles(4),
        "archimedean" => Clearing::Archimedes,
        "rings" => Clearing::RingsRadial,
        "rings-tangent" => Clearing::RingsTangent,
        "trochoidal" => Clearing::Trochoid,
        _ => Clearing::Involute,
    };
    let disc = Disc {
        inner: 10.0,
        inner_most: 10.0,
        outer: 79.0,
        cutter: 20.0,
        step: if name == "constant-engagement-free-step" { 40.0 } else { 4.0 },
        engagement: Some(60f64.to_radians()),
        psi: 0.0,
        resolution: Some(1e-4),
    };
    bencher.bench(|| clearing.path(black_box(&disc)));
}

/// A pocket of 136 by 96 mm, cutter 16, step 4, from an entry helix of radius 5.
#[divan::bench]
fn elliptic_pocket_136x96_step4(bencher: divan::Bencher) {
    let pocket = EllipsePocket {
        half_axes: [68.0, 48.0],
        cutter: 8.0,
        allowance: 0.0,
        inner: 5.0,
        step: 4.0,
        order: LensOrder::One,
    };
    bencher.bench(|| ellipse(black_box(&pocket)));
}

#[divan::bench]
fn lens_lead_in_of_the_paper() -> f64 {
    kinecut::holes::lens_lead_in(black_box(80.0), 2, [-40.0, 40.0], 0.0, LensOrder::One)
        .map_or(0.0, |l| l.psi)
}
