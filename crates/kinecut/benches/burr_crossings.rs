//! Crossings of real teeth with the outline, on one core: ten million in a second are the goal.

use divan::counter::ItemsCount;
use glam::{DVec2, dvec2};
use kinecut::facing::{BadSet, FaceCase, Placement, Sweep, ToothedPass, toothed_lengths};
use kinecut::geom::{Outline, OutlineEdge};

fn main() {
    divan::main();
}

/// A plate of 100 x 90 with a zigzag on one side: edges in many directions.
fn zigzag() -> Outline {
    let mut corners = vec![dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 80.0)];
    corners.extend((0..20).map(|i| dvec2(95.0 - 5.0 * f64::from(i), if i % 2 == 0 { 90.0 } else { 82.0 })));
    Outline::polygon(&corners).expect("the outline is right")
}

/// The same plate with nine bores.
fn bores() -> Outline {
    let mut loops = vec![zigzag().edges().to_vec()];
    for i in 0..9 {
        let centre = DVec2::new(20.0 + 30.0 * f64::from(i % 3), 20.0 + 22.0 * f64::from(i / 3));
        loops.push(vec![OutlineEdge::arc(centre, 8.0, 0.0, std::f64::consts::TAU)]);
    }
    Outline::new(loops, vec![]).expect("the outline is right")
}

fn pass(feed_per_tooth: f64) -> ToothedPass {
    let placement = Placement { angle: 0.37, offset: 55.0 };
    ToothedPass::even(8, 80.0, feed_per_tooth, placement).expect("the pass is right")
}

#[divan::bench(args = [0.2, 0.05, 0.01], sample_count = 10)]
fn crossings_with_straight_edges(bencher: divan::Bencher, feed_per_tooth: f64) {
    let (outline, pass) = (zigzag(), pass(feed_per_tooth));
    bencher.counter(ItemsCount::new(pass.count(&outline))).bench_local(|| {
        let mut sum = 0.0;
        pass.visit(&outline, |c| sum += c.time + c.share + c.along);
        sum
    });
}

#[divan::bench(args = [0.2, 0.05, 0.01], sample_count = 10)]
fn crossings_with_lines_and_arcs(bencher: divan::Bencher, feed_per_tooth: f64) {
    let (outline, pass) = (bores(), pass(feed_per_tooth));
    bencher.counter(ItemsCount::new(pass.count(&outline))).bench_local(|| {
        let mut sum = 0.0;
        pass.visit(&outline, |c| sum += c.time + c.share + c.along);
        sum
    });
}

#[divan::bench(args = [0.2, 0.05], sample_count = 10)]
fn bad_length_of_real_teeth(bencher: divan::Bencher, feed_per_tooth: f64) {
    let bad = BadSet::below(90f64.to_radians()).expect("the set is right");
    let case = FaceCase::new(bores(), 80.0, bad).expect("the case is right");
    let pass = pass(feed_per_tooth);
    bencher.bench_local(|| toothed_lengths(&case, &pass, Sweep::Front).expect("few enough").bad);
}
