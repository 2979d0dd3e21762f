//! Kinematics of a five-axis machine on one core: forward under 50 ns, all inverse solutions under 500 ns.

use divan::{Bencher, black_box};
use glam::DVec3;
use kinecut::machine::{CoordinateCode, Kinematics, Machine};

fn main() {
    divan::main();
}

/// The codes measured: table-table, head-table, head-head, and a nutating head.
const CODES: [&str; 4] = ["641203", "612035", "012365", "012367"];

fn chain(code: &str) -> Kinematics {
    let code = CoordinateCode::parse(code).expect("a code");
    let mut machine = Machine::new(code, [None; 3], Default::default()).expect("a machine");
    for joint in &mut machine.joints {
        joint.point = DVec3::new(12.0, 20.0, 120.0);
        if joint.motion.direction().is_none() {
            joint.direction = DVec3::new(0.0, 0.5f64.sqrt(), 0.5f64.sqrt());
        }
    }
    machine.kinematics(80.0)
}

const POSITIONS: [f64; 5] = [0.7, -0.4, 35.0, -62.0, 110.0];

fn positions(chain: &Kinematics) -> [f64; 5] {
    // Rotary axes get the angles, translations the lengths, whatever their order.
    let jacobian = chain.jacobian(&[]);
    let (mut angles, mut lengths) = (POSITIONS[..2].iter(), POSITIONS[2..].iter());
    let mut q = [0.0; 5];
    for (value, twist) in q.iter_mut().zip(jacobian.twists()) {
        let next = if twist.turn == DVec3::ZERO { lengths.next() } else { angles.next() };
        *value = *next.expect("two angles and three lengths");
    }
    q
}

#[divan::bench(args = CODES)]
fn forward(bencher: Bencher, code: &str) {
    let chain = chain(code);
    let q = positions(&chain);
    bencher.bench(|| black_box(&chain).forward(black_box(&q)));
}

#[divan::bench(args = CODES)]
fn all_inverse_solutions(bencher: Bencher, code: &str) {
    let chain = chain(code);
    let at = chain.forward(&positions(&chain));
    assert_eq!(chain.inverse(at.translation, at.rotation.z_axis, &[]).map_or(0, |found| found.len()), 2);
    bencher.bench(|| {
        black_box(&chain).inverse(black_box(at.translation), black_box(at.rotation.z_axis), black_box(&[]))
    });
}

#[divan::bench(args = CODES)]
fn jacobian(bencher: Bencher, code: &str) {
    let chain = chain(code);
    let q = positions(&chain);
    bencher.bench(|| black_box(&chain).jacobian(black_box(&q)));
}
