//! The least burr of one straight pass with its certificate. Claims, on two cores: the polygons of the golden file with
//! a median under 20 ms and each under 150 ms; 1000 edges with 20 bores under 2 s.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use divan::Bencher;
use glam::{DVec2, dvec2};
use kinecut::base::Silent;
use kinecut::facing::optimum::{Options, least_burr, objective_map};
use kinecut::facing::{BadSet, FaceCase};
use kinecut::geom::{Outline, OutlineEdge};
use serde_json::Value;

fn main() {
    divan::main();
}

const POLYGONS: [&str; 17] = [
    "C_ring",
    "L_bracket",
    "T_plate",
    "U_channel",
    "Z_plate",
    "carb_flange",
    "cross",
    "engine_deck_4bores",
    "gear_pump_cover",
    "manifold_block",
    "oil_pan_rim",
    "random_concave_17",
    "random_concave_31",
    "rectangle",
    "star5",
    "triangle_scalene",
    "valve_body_maze",
];

fn golden(name: &str) -> Option<(Outline, f64)> {
    let text = include_str!("../tests/golden/burr.json");
    let file: Value = serde_json::from_str(text).ok()?;
    let polygon = &file["polygons"][name];
    let point = |p: &Value| Some(dvec2(p[0].as_f64()?, p[1].as_f64()?));
    let one = |l: &Value| l.as_array()?.iter().map(point).collect::<Option<Vec<DVec2>>>();
    let loops = polygon["loops"].as_array()?.iter().map(one).collect::<Option<Vec<_>>>()?;
    Some((Outline::polygons(&loops).ok()?, polygon["optima"][0]["R"].as_f64()?))
}

fn solve(bencher: Bencher, outline: Outline, radius: f64) {
    let bad = BadSet::below(FRAC_PI_2).expect("a right angle is a threshold");
    let case = FaceCase::new(outline, radius, bad).expect("a positive radius");
    let options = Options::for_cutter(radius);
    bencher.bench(|| least_burr(&case, &options, &Silent));
}

/// Everything `least_burr` gives: optimum, certificate, alternatives, irreducible part, sensitivity.
#[divan::bench(args = POLYGONS, sample_count = 10, sample_size = 1)]
fn polygon(bencher: Bencher, name: &str) {
    let (outline, radius) = golden(name).expect("the golden file holds it");
    solve(bencher, outline, radius);
}

fn cover() -> Outline {
    let half = (22f64 * 22.0 - 14.0 * 14.0).sqrt().atan2(14.0);
    let (right, left) = (dvec2(14.0, 0.0), dvec2(-14.0, 0.0));
    let mut loops = vec![
        vec![
            OutlineEdge::line(dvec2(-14.0, 40.0), dvec2(14.0, 40.0)),
            OutlineEdge::arc(right, 40.0, FRAC_PI_2, -PI),
            OutlineEdge::line(dvec2(14.0, -40.0), dvec2(-14.0, -40.0)),
            OutlineEdge::arc(left, 40.0, -FRAC_PI_2, -PI),
        ],
        vec![
            OutlineEdge::arc(left, 22.0, half, TAU - 2.0 * half),
            OutlineEdge::arc(right, 22.0, PI + half, TAU - 2.0 * half),
        ],
    ];
    for centre in [(46.0, 0.0), (-46.0, 0.0), (30.0, 28.0), (-30.0, 28.0), (30.0, -28.0), (-30.0, -28.0)] {
        loops.push(vec![OutlineEdge::arc(DVec2::from(centre), 3.5, 0.0, TAU)]);
    }
    Outline::new(loops, Vec::new()).expect("loops that close")
}

/// The gear pump cover with true circles.
#[divan::bench(sample_count = 10, sample_size = 1)]
fn cover_with_true_circles(bencher: Bencher) {
    solve(bencher, cover(), 50.0);
}

/// An oval of 1000 straight edges with waves on it and 20 bores.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn edges_1000_bores_20(bencher: Bencher) {
    let corners: Vec<DVec2> = (0..1000u32)
        .map(|k| {
            let a = TAU * f64::from(k) / 1000.0;
            let r = 85.0 + 8.0 * (3.0 * a).cos() + 4.0 * (11.0 * a).sin() + 0.2 * (377.0 * a).sin();
            dvec2(1.2 * r * a.cos(), r * a.sin())
        })
        .collect();
    let line = |k: usize| OutlineEdge::line(corners[k], corners[(k + 1) % corners.len()]);
    let mut loops = vec![(0..corners.len()).map(line).collect::<Vec<_>>()];
    for k in 0..20u32 {
        let centre = dvec2(-56.0 + 28.0 * f64::from(k % 5), -36.0 + 24.0 * f64::from(k / 5));
        loops.push(vec![OutlineEdge::arc(centre, 3.0 + 0.3 * f64::from(k), 0.0, TAU)]);
    }
    solve(bencher, Outline::new(loops, Vec::new()).expect("loops that close"), 125.0);
}

/// Values at 360 x 101 placements of the cover.
#[divan::bench(sample_count = 10, sample_size = 1)]
fn map_360_by_101(bencher: Bencher) {
    let bad = BadSet::below(FRAC_PI_2).expect("a right angle is a threshold");
    let case = FaceCase::new(cover(), 50.0, bad).expect("a positive radius");
    bencher.bench(|| objective_map(&case, &Options::for_cutter(50.0), 360, 101));
}
