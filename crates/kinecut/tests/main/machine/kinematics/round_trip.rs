//! Positions go to a pose and come back.

use std::f64::consts::TAU;

use kinecut::machine::Kinematics;

use crate::common::random::Random;
use kinecut_cases::cases;

use super::machines::{RandomMachine, classes};

/// Bounds on poses [mm], [rad].
const TIP: f64 = 1e-9;
const AXIS: f64 = 1e-11;
/// Rounding of the sum that places the tip, in parts of the largest position: where the translations nearly depend on one
/// another the second solution has positions of kilometres.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Poses in all.
const POSES: usize = 100_000;

/// How far two sets of positions are apart, rotary axes modulo a turn, and the least such of all solutions.
fn apart(rotary: &[bool], a: &[f64], b: &[f64]) -> f64 {
    let one = |i: usize| {
        let d = a[i] - b[i];
        if rotary[i] { (d - TAU * (d / TAU).round()).abs() } else { d.abs() }
    };
    (0..a.len()).map(one).fold(0.0, f64::max)
}

/// How far a pose is from singular ones: the volume that the unit translations span, and the area of the rates of the
/// direction for the rotary axes; a change of the pose changes the positions by about its inverse.
fn conditioned(chain: &Kinematics, q: &[f64]) -> f64 {
    let jacobian = chain.jacobian(q);
    let rotary: Vec<usize> = (0..q.len()).filter(|&i| jacobian.twists()[i].turn.length() > 0.5).collect();
    let shifts: Vec<_> = (0..q.len()).filter(|i| !rotary.contains(i)).map(|i| jacobian.tip_rate(i)).collect();
    let volume = shifts[0].cross(shifts[1]).dot(shifts[2]).abs();
    let area = jacobian.axis_rate(rotary[0]).cross(jacobian.axis_rate(rotary[1])).length();
    volume.min(area)
}

#[test]
fn a_hundred_thousand_poses_of_all_classes_come_back() {
    let classes = classes();
    assert_eq!(classes.len(), 48);
    let mut random = Random(20_261_121);
    let machines_of_class = 20;
    let poses_of_machine = POSES.div_ceil(classes.len() * machines_of_class);
    let (mut poses, mut worst_tip, mut worst_axis, mut worst_itself) = (0, 0.0f64, 0.0f64, 0.0f64);
    let mut compared = 0;
    for class in &classes {
        for number in 0..machines_of_class {
            let machine = RandomMachine::new(class, number % 2 == 1, &mut random);
            let chain = machine.chain();
            let rotary: Vec<bool> = machine.joints.iter().map(|j| j.motion.is_rotation()).collect();
            for _ in 0..poses_of_machine {
                poses += 1;
                let q = machine.positions(&mut random);
                let at = chain.forward(&q);
                let found = chain.inverse(at.translation, at.rotation.z_axis, &q).unwrap();
                assert!(matches!(found.len(), 1 | 2));
                for solution in found.iter() {
                    let back = chain.forward(&solution.values);
                    let size = solution.values.iter().fold(0.0f64, |size, value| size.max(value.abs()));
                    let off = back.translation.distance(at.translation);
                    assert!(off < TIP.max(ROUNDING * size), "{off:e} mm at {size:e} mm");
                    if size < 1e4 {
                        worst_tip = worst_tip.max(off);
                    }
                    worst_axis = worst_axis.max(back.rotation.z_axis.distance(at.rotation.z_axis));
                    for (value, rotary) in solution.values.iter().zip(&rotary) {
                        assert!(!rotary || (-TAU / 2.0 < *value && *value <= TAU / 2.0));
                    }
                }
                // Away from singular positions the positions themselves come back.
                let conditioned = conditioned(&chain, &q);
                if conditioned > 1e-2 {
                    compared += 1;
                    let itself = found.iter().map(|s| apart(&rotary, &s.values, &q));
                    worst_itself = worst_itself.max(itself.fold(f64::INFINITY, f64::min));
                }
            }
        }
    }
    assert!(poses >= POSES && compared > poses * 9 / 10, "{compared} of {poses}");
    assert!(worst_tip < TIP && worst_axis < AXIS, "{worst_tip:e} mm {worst_axis:e} rad");
    // A pose rounds to 1e-13 mm, and its positions to 100 times that at the least distance compared.
    assert!(worst_itself < TIP, "{worst_itself:e} mm or rad");
}

#[test]
fn rotary_positions_come_back_to_their_bound_too() {
    let mut random = Random(7);
    for class in &classes() {
        let machine = RandomMachine::new(class, true, &mut random);
        let chain = machine.chain();
        for _ in 0..20 {
            let q = machine.positions(&mut random);
            if conditioned(&chain, &q) < 0.1 {
                continue;
            }
            let at = chain.forward(&q);
            let found = chain.inverse(at.translation, at.rotation.z_axis, &[]).unwrap();
            let turns = |values: &[f64]| {
                let rotary = machine.joints.iter().map(|j| j.motion.is_rotation());
                values
                    .iter()
                    .zip(&q)
                    .zip(rotary)
                    .filter(|(_, rotary)| *rotary)
                    .fold(0.0f64, |worst, ((a, b), _)| {
                        worst.max(((a - b) - TAU * ((a - b) / TAU).round()).abs())
                    })
            };
            assert!(found.iter().any(|s| turns(&s.values) < AXIS));
        }
    }
}

#[test]
fn locked_axes_stay_and_the_others_solve() {
    let mut random = Random(11);
    for class in &classes() {
        // A sixth and a seventh axis: C on the work side, W on the tool side, both held.
        let mut machine = RandomMachine::new(class, true, &mut random);
        let extra = RandomMachine::new(class, true, &mut random);
        let rotary = extra.joints.iter().find(|j| j.motion.is_rotation()).unwrap().clone();
        let linear = extra.joints.iter().find(|j| !j.motion.is_rotation()).unwrap().clone();
        machine.joints.insert(0, rotary);
        machine.joints.insert(3, linear);
        let chain = machine.chain();
        let locked = [true, false, false, true, false, false, false];
        let q = machine.positions(&mut random);
        let at = chain.forward(&q);
        let found = chain.inverse_locked(at.translation, at.rotation.z_axis, &q, &locked).unwrap();
        for solution in found.iter() {
            assert_eq!((solution.values[0], solution.values[3]), (q[0], q[3]));
            let back = chain.forward(&solution.values);
            assert!(back.translation.distance(at.translation) < TIP);
            assert!(back.rotation.z_axis.distance(at.rotation.z_axis) < AXIS);
        }
        let error = chain.inverse(at.translation, at.rotation.z_axis, &q).unwrap_err();
        assert_eq!(error.code().as_str(), "KC1113");
    }
}

#[test]
fn polar_chains_of_any_order_come_back() {
    let mut random = Random(13);
    for word in ["631", "361", "316", "421", "241", "612", "126"] {
        let word = kinecut::machine::Word::parse(word).unwrap();
        for number in 0..cases(200, 2000) {
            let machine = RandomMachine::new(&word, number % 2 == 1, &mut random);
            let chain = machine.chain();
            let q = machine.positions(&mut random);
            let at = chain.forward(&q);
            let found = chain.inverse_polar(at.translation, &q).unwrap();
            for solution in found.iter() {
                let back = chain.forward(&solution.values);
                assert!(back.translation.distance(at.translation) < 1e-8, "{word} {number}");
            }
            let rotary: Vec<bool> = machine.joints.iter().map(|j| j.motion.is_rotation()).collect();
            let jacobian = chain.jacobian(&q);
            let volume = jacobian.tip_rate(0).cross(jacobian.tip_rate(1)).dot(jacobian.tip_rate(2)).abs();
            if volume > 1.0 {
                assert!(
                    found.iter().any(|s| apart(&rotary, &s.values, &q) < 1e-8),
                    "{word} {number} {volume}"
                );
            }
        }
    }
}
