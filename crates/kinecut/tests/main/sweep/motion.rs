//! Moves as pose, twist and change: against the golden poses, against differences, and their bound against brute force.

use glam::{DMat3, DVec3};
use kinecut::base::Code;
use kinecut::geom::{Arc, Curve, Line, Rigid};
use kinecut::machine::Machine;
use kinecut::machine::kinematics::Twist;
use kinecut::sweep::{ProfileChain, ToolMotion};

use crate::common::golden::{self, vector};
use crate::common::sweep_golden::{contour, motion, trunnion};

#[test]
fn poses_are_those_of_the_golden_motions() {
    let golden = golden::file("sweep");
    let mut points = 0;
    for case in golden["envelope"].as_array().unwrap() {
        let motion = motion(&case["motion"]);
        let chain = ProfileChain::new(&contour(&golden, case["tool"].as_str().unwrap()));
        for p in case["points"].as_array().unwrap() {
            let number = |key: &str| p[key].as_f64().unwrap();
            let piece = &chain.pieces()[p["chain"].as_u64().unwrap() as usize];
            let on = piece.point(number("u"));
            let (sin, cos) = number("theta").sin_cos();
            let world = motion.pose(number("t")).point(DVec3::new(on.x * cos, on.x * sin, on.y));
            assert!((world - vector(&p["world"])).length() < 1e-12, "{} {p}", case["name"]);
            points += 1;
        }
    }
    assert!(points > 90);
}

fn all_kinds() -> Vec<(&'static str, ToolMotion)> {
    let line: Curve = Line { start: DVec3::new(1.0, 2.0, 3.0), end: DVec3::new(9.0, -4.0, 2.0) }.into();
    let helix: Curve = Arc::new(DVec3::new(7.0, 0.0, 1.0), DVec3::ZERO, DVec3::new(0.1, 0.2, 1.0), 2.5, -3.0)
        .unwrap()
        .into();
    let chain = || trunnion(DVec3::new(3.0, -2.0, -50.0));
    let (from, to) = ([0.2, 0.1, 0.0, 1.0, 0.0], [0.9, -0.6, 12.0, 8.0, 2.0]);
    let twist = Twist { turn: DVec3::new(0.2, 0.5, -0.9), shift: DVec3::new(18.0, 3.0, -4.0) };
    let pose = Rigid { rotation: DMat3::from_rotation_x(0.7), translation: DVec3::new(1.0, 2.0, 3.0) };
    vec![
        ("fixed line", ToolMotion::fixed(line, DVec3::new(0.3, 0.1, 1.0)).unwrap()),
        ("fixed helix", ToolMotion::fixed(helix.clone(), DVec3::Z).unwrap()),
        ("great circle", ToolMotion::between(helix.clone(), DVec3::new(0.0, 0.2, 1.0), DVec3::X).unwrap()),
        ("joints", ToolMotion::joints(chain(), &from, &to).unwrap()),
        ("tip and joints", ToolMotion::tip_and_joints(helix, chain(), &from, &to).unwrap()),
        ("screw", ToolMotion::screw(pose, twist).unwrap()),
    ]
}

#[test]
fn twist_and_change_are_the_differences_of_poses() {
    for (name, motion) in all_kinds() {
        for t in [0.13, 0.5, 0.87] {
            let jet = motion.at(t);
            let off = jet.pose.point(DVec3::splat(20.0)) - motion.pose(t).point(DVec3::splat(20.0));
            assert!(off.length() < 1e-12, "{name}");
            let p = DVec3::new(2.0, -3.0, 25.0);
            let h = 1e-4;
            let [a, b, c] = [t - h, t, t + h].map(|t| motion.pose(t).point(p));
            let back = jet.pose.rotation.transpose();
            let speed = back * ((c - a) / (2.0 * h));
            let acceleration = back * ((a + c - 2.0 * b) / (h * h));
            assert!((speed - jet.twist.velocity(p)).length() < 1e-6, "{name}");
            assert!((acceleration - jet.acceleration(p)).length() < 1e-4, "{name}");
            // The change itself, not only what it makes of one point.
            let [a, c] = [t - h, t + h].map(|t| motion.at(t).twist);
            assert!(((c.turn - a.turn) / (2.0 * h) - jet.change.turn).length() < 1e-6, "{name}");
            assert!(((c.shift - a.shift) / (2.0 * h) - jet.change.shift).length() < 1e-4, "{name}");
        }
    }
}

#[test]
fn points_of_the_tool_keep_within_the_bound_of_their_chords() {
    let reach = 30.0;
    for (name, motion) in all_kinds() {
        for (from, to) in [(0.0, 1.0), (0.25, 0.5), (0.9, 0.91)] {
            let bound = motion.chord_error(from, to, reach);
            let mut worst = 0.0f64;
            for p in [DVec3::ZERO, DVec3::Z, DVec3::X, DVec3::new(0.6, 0.0, -0.8), DVec3::new(0.0, 0.6, 0.8)]
            {
                let p = p * reach;
                let [a, b] = [from, to].map(|t| motion.pose(t).point(p));
                for k in 1..20 {
                    let f = f64::from(k) / 20.0;
                    let at = motion.pose(from + (to - from) * f).point(p);
                    worst = worst.max((at - a.lerp(b, f)).length());
                }
            }
            assert!(worst <= bound + 1e-12, "{name}: {worst} > {bound}");
            // No bound is useful that is far too large.
            assert!(bound < 6.0 * worst + 1e-9, "{name}: {worst} << {bound}");
        }
    }
}

#[test]
fn moves_that_cannot_be_made_are_refused() {
    let line: Curve = Line { start: DVec3::ZERO, end: DVec3::X }.into();
    let code = |r: kinecut::base::Result<ToolMotion>| r.unwrap_err().code();
    assert_eq!(code(ToolMotion::fixed(line.clone(), DVec3::ZERO)), Code::MOVE_NOT_POSSIBLE);
    assert_eq!(code(ToolMotion::fixed(line.clone(), DVec3::splat(f64::NAN))), Code::MOVE_NOT_POSSIBLE);
    let far: Curve = Line { start: DVec3::ZERO, end: DVec3::X * f64::INFINITY }.into();
    assert_eq!(code(ToolMotion::fixed(far, DVec3::Z)), Code::MOVE_NOT_POSSIBLE);
    assert_eq!(code(ToolMotion::between(line, DVec3::Z, -DVec3::Z)), Code::MOVE_NOT_POSSIBLE);
    let chain = trunnion(DVec3::ZERO);
    assert_eq!(code(ToolMotion::joints(chain.clone(), &[0.0; 4], &[0.0; 5])), Code::MOVE_NOT_POSSIBLE);
    assert_eq!(code(ToolMotion::joints(chain, &[0.0; 5], &[f64::NAN; 5])), Code::MOVE_NOT_POSSIBLE);
    let mut machine = Machine::preset("mill4_xyza").unwrap();
    machine.joints[0].travel = Some([-2.0, 2.0]);
    assert!(ToolMotion::on_machine(&machine, 50.0, &[0.0; 4], &[0.0; 4]).is_ok());
    let beyond = ToolMotion::on_machine(&machine, 50.0, &[0.0; 4], &[-3.0, 0.0, 0.0, 0.0]).unwrap_err();
    assert_eq!(beyond.code(), Code::MOVE_NOT_POSSIBLE);
    assert!((beyond.0.bound.unwrap().value + 2f64.to_degrees()).abs() < 1e-9); // A turns
}
