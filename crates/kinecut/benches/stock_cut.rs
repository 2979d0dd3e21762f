//! Cutting a 200 mm bore into a 260 x 260 x 30 mm plate at 0.2 mm: flat cutter of 40 mm, two levels of 15 mm, each a
//! spiral of 5.46 m with its closing circle, once as involutes and once as 4-pole arcs.
//!
//! `cargo bench -p kinecut --bench stock_cut`

use divan::{Bencher, black_box};
use glam::DVec3;
use kinecut::base::Silent;
use kinecut::geom::{Aabb, Arc, Curve, InvoluteRecord, Line, Profile};
use kinecut::stock::TriDexel;
use kinecut::stock::cut::{CutAxis, CutMove, CutOptions, ToolBody, cut};

fn main() {
    divan::main();
}

fn plate() -> TriDexel {
    let bounds = Aabb { min: DVec3::new(-130.0, -130.0, -30.0), max: DVec3::new(130.0, 130.0, 0.0) };
    TriDexel::from_box(bounds, 0.2).expect("a plate of sound size")
}

fn cutter() -> ToolBody {
    ToolBody {
        cutting: Profile::cylinder(40.0, 45.0).expect("sound numbers"),
        edge: None,
        shank: vec![(Profile::cylinder(38.0, 45.0).expect("sound numbers"), 45.0)],
        holder: vec![(Profile::cylinder(60.0, 80.0).expect("sound numbers"), 90.0)],
    }
}

/// Radius of the path at the wall, allowance taken off [mm].
const PATH: f64 = 79.0;

fn arc(start: DVec3, centre: DVec3, sweep: f64) -> Curve {
    Arc::new(start, centre, DVec3::Z, sweep, 0.0).expect("sound numbers").into()
}

/// Plunge, path of the level, closing circle at the roughing radius, finishing circle.
fn job(spiral: impl Fn(f64) -> Vec<Curve>) -> Vec<CutMove> {
    let mut moves = Vec::new();
    for z in [-15.0, -30.0] {
        let plunge = Line { start: DVec3::new(0.0, 0.0, z + 16.0), end: DVec3::new(0.0, 0.0, z) };
        let mut curves = vec![plunge.into()];
        curves.extend(spiral(z));
        let centre = DVec3::new(0.0, 0.0, z);
        for radius in [PATH, PATH + 1.0] {
            curves.push(arc(DVec3::new(0.0, -radius, z), centre, std::f64::consts::TAU));
        }
        moves.extend(curves.into_iter().map(|c| CutMove::new(c, CutAxis::PlusZ, 0)));
    }
    moves
}

/// The involute of 20 turns.
fn involute(z: f64) -> Vec<Curve> {
    let record =
        InvoluteRecord::new(4_963.716_392_671_87, [0.0, 0.0], 0.0, 0.0, PATH).expect("sound numbers");
    vec![Curve::involute(record, z, 0.0)]
}

/// Arcs of 0.3 rad between points of the involute: what a control without involutes is given.
fn arcs(z: f64) -> Vec<Curve> {
    let turns = 125.66;
    let step = 0.3;
    let base = PATH / turns;
    let point =
        |roll: f64| DVec3::new(roll.cos() + roll * roll.sin(), roll.sin() - roll * roll.cos(), 0.0) * base;
    let mut roll = step;
    let mut curves = Vec::new();
    while roll + step < turns {
        // The centre of curvature at the middle, moved onto the perpendicular bisector of the chord.
        let (a, b) = (point(roll), point(roll + step));
        let middle = (roll + 0.5 * step).sin_cos();
        let centre = DVec3::new(middle.1, middle.0, 0.0) * base;
        let along = (b - a).normalize_or_zero();
        let centre = centre - along * (centre - 0.5 * (a + b)).dot(along);
        let lift = DVec3::Z * z;
        let sweep = (a - centre).angle_between(b - centre);
        curves.push(arc(a + lift, centre + lift, sweep));
        roll += step;
    }
    curves
}

fn run(bencher: Bencher, moves: &[CutMove]) {
    run_with(bencher, moves, cutter());
}

fn run_with(bencher: Bencher, moves: &[CutMove], tool: ToolBody) {
    let bodies = [tool];
    bencher.with_inputs(plate).bench_local_values(|mut stock| {
        let effects = cut(&mut stock, &bodies, black_box(moves), &CutOptions::default(), &Silent);
        (stock, effects.expect("sound moves"))
    });
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn bore_200_mm_two_involutes_at_0_2_mm(bencher: Bencher) {
    run(bencher, &job(involute));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn bore_200_mm_840_arcs_at_0_2_mm(bencher: Bencher) {
    run(bencher, &job(arcs));
}

/// The cut alone: nothing is looked for.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn bore_200_mm_840_arcs_of_the_edges_alone(bencher: Bencher) {
    run_with(bencher, &job(arcs), ToolBody::new(cutter().cutting));
}

/// Shank and holder near the floor: the shank begins at a quarter of the depth, so that it is looked for on all grids.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn bore_200_mm_840_arcs_with_a_shank_in_the_bore(bencher: Bencher) {
    let tool = ToolBody {
        cutting: Profile::cylinder(40.0, 16.0).expect("sound numbers"),
        shank: vec![(Profile::cylinder(38.0, 45.0).expect("sound numbers"), 16.0)],
        ..cutter()
    };
    run_with(bencher, &job(arcs), tool);
}

/// A ball of 6 mm on a wave of short sloping lines: every kernel for slopes, on lines along and across the tool.
#[divan::bench(sample_count = 3, sample_size = 1)]
fn wave_of_20000_sloping_ball_lines_at_0_1_mm(bencher: Bencher) {
    let bounds = Aabb { min: DVec3::new(0.0, 0.0, -10.0), max: DVec3::new(60.0, 60.0, 0.0) };
    let stock = TriDexel::from_box(bounds, 0.1).expect("a plate of sound size");
    let ball = ToolBody {
        cutting: Profile::bull_nose(6.0, 3.0, 20.0).expect("sound numbers"),
        edge: None,
        shank: vec![],
        holder: vec![],
    };
    let mut moves = Vec::new();
    for row in 0..100 {
        let y = 0.3 + 0.6 * f64::from(row);
        let at = |i: u32| {
            let x = 0.3 * f64::from(i);
            DVec3::new(x, y, -3.0 + (x * 0.3).sin() + (y * 0.2).cos())
        };
        moves
            .extend((0..200).map(|i| CutMove::new(Line { start: at(i), end: at(i + 1) }, CutAxis::PlusZ, 0)));
    }
    bencher.with_inputs(|| stock.clone()).bench_local_values(|mut stock| {
        let effects =
            cut(&mut stock, std::slice::from_ref(&ball), black_box(&moves), &CutOptions::default(), &Silent);
        (stock, effects.expect("sound moves"))
    });
}
