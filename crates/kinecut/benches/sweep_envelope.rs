//! The mesh of the envelope of a five-axis move within a micrometre, in under 5 ms: tool centre point on a line, tool in a plane.

#![allow(clippy::print_stdout, reason = "a bench tells the size of what it measures")]

mod cutter;

use cutter::bull_nose;
use divan::{Bencher, black_box};
use glam::DVec3;
use kinecut::base::Silent;
use kinecut::geom::Line;
use kinecut::sweep::ToolMotion;

fn main() {
    for (name, motion) in MOVES.map(|name| (name, five_axis_move(name))) {
        let swept = bull_nose().envelope(&motion, 0.001, &Silent).expect("an envelope");
        println!(
            "{name}: {} moments, {} triangles, poses within {:.1e} mm",
            swept.moments.len(),
            swept.mesh.triangles.len(),
            swept.pose_error
        );
    }
    divan::main();
}

const MOVES: [&str; 3] = ["1 mm, 1.3 degrees", "5 mm, 5 degrees", "20 mm, 29 degrees"];

fn five_axis_move(name: &str) -> ToolMotion {
    let (length, angle) = match name {
        "1 mm, 1.3 degrees" => (1.0, 1.3f64),
        "5 mm, 5 degrees" => (5.0, 5.0),
        _ => (20.0, 29.0),
    };
    let line = Line { start: DVec3::ZERO, end: DVec3::new(length, 0.1 * length, -0.1 * length) };
    let (sin, cos) = angle.to_radians().sin_cos();
    ToolMotion::between(line.into(), DVec3::Z, DVec3::new(sin, 0.1 * sin, cos)).expect("a move")
}

#[divan::bench(args = MOVES)]
fn one_micrometre(bencher: Bencher, name: &str) {
    let (chain, motion) = (bull_nose(), five_axis_move(name));
    bencher.bench_local(|| chain.envelope(black_box(&motion), 0.001, &Silent));
}
