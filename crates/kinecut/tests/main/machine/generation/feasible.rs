//! Can a machine make a surface with a tool: laws of the joints, and obstacles.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};
use kinecut::base::Silent;
use kinecut::geom::Rigid;
use kinecut::machine::generation::{
    ElementaryBody, FeasibleOptions, Hold, MachineMotion, Obstacle, Task, TaskMotion, ToolEnvelope,
    VariableLaw, can_make, nearest_machines,
};
use kinecut::machine::{CoordinateCode, Machine};
use proptest::prelude::*;

fn machine(code: &str) -> Machine {
    Machine::of_code(CoordinateCode::parse(code).unwrap())
}

fn turn_z(angle: f64) -> Rigid {
    Rigid { rotation: DMat3::from_rotation_z(angle), translation: DVec3::ZERO }
}

fn turn_y(angle: f64) -> Rigid {
    Rigid { rotation: DMat3::from_rotation_y(angle), translation: DVec3::ZERO }
}

fn shift(x: f64, y: f64, z: f64) -> Rigid {
    Rigid::from_translation(DVec3::new(x, y, z))
}

fn found(machine: &Machine, task: &Task<'_>) -> Result<TaskMotion, Obstacle> {
    can_make(machine, task, &FeasibleOptions::default(), &Silent).unwrap()
}

fn cone([phi, z]: [f64; 2]) -> Rigid {
    turn_z(phi).after(&shift(30.0, 0.0, 0.0)).after(&turn_y(-0.35)).after(&shift(0.0, 0.0, z))
}

fn thread([phi, r]: [f64; 2]) -> Rigid {
    turn_z(phi).after(&shift(r, 0.0, 6.0 * phi / TAU))
}

fn sphere([phi, t]: [f64; 2]) -> Rigid {
    turn_z(phi).after(&turn_y(t)).after(&shift(0.0, 0.0, 25.0))
}

#[test]
fn a_lathe_turns_a_cone_a_thread_and_a_sphere_with_a_point() {
    let lathe = machine("6031");
    let task = Task::new(&cone, [[0.0, 6.0], [0.0, 50.0]], ["phi", "z"], Hold::Point);
    let way = found(&lathe, &task).unwrap();
    // X = R - z sin a, Z = z cos a: both even, so X follows Z by the taper.
    let VariableLaw::Affine { at_start, slopes } = way.law('X').unwrap().law else { panic!("{way:?}") };
    assert!((at_start - 30.0).abs() < 1e-9 && (slopes[1] + 0.35f64.sin()).abs() < 1e-9 && slopes[0] == 0.0);
    assert!(way.tip_error < 1e-9);
    let taper = format!("{}", (-0.35f64.tan() * 1e6).round() / 1e6);
    let lines = way.lines().join("; ");
    assert!(lines.contains("C turns with phi, from 0 deg to 343.774677 deg"), "{lines}");
    assert!(lines.contains(&format!("follows Z, {taper} mm/mm")) || lines.contains("Z follows X"), "{lines}");

    let task = Task::new(&thread, [[0.0, 20.0], [10.0, 12.0]], ["phi", "r"], Hold::Point);
    let way = found(&lathe, &task).unwrap();
    let lines = way.lines();
    assert!(lines.contains(&"Z follows C, 6 mm/rev".to_owned()), "{lines:?}");
    assert!(lines.contains(&"X moves with r, from 10 mm to 12 mm".to_owned()), "{lines:?}");
    assert_eq!(way.links.len(), 1);

    let task = Task::new(&sphere, [[0.0, 6.0], [0.05, 1.5]], ["phi", "t"], Hold::Point);
    let way = found(&lathe, &task).unwrap();
    let (x, z) = (way.law('X').unwrap(), way.law('Z').unwrap());
    assert_eq!((x.law, z.law), (VariableLaw::Sampled, VariableLaw::Sampled));
    assert_eq!((x.depends, z.depends), ([false, true], [false, true]));
    // Positions are those of the circle.
    let [nu, nv] = way.nodes;
    for n in 0..nu * nv {
        let t = 0.05 + 1.45 * (n % nv) as f64 / (nv - 1) as f64;
        let q = &way.positions[n];
        assert!((q[1] - 25.0 * t.cos()).abs() < 1e-8 && (q[2] - 25.0 * t.sin()).abs() < 1e-8);
    }
    assert!(way.lines().iter().any(|l| l.contains("by a law of its own")), "{:?}", way.lines());
}

#[test]
fn a_cylinder_takes_the_fewest_moving_axes() {
    let cylinder = |[phi, z]: [f64; 2]| turn_z(phi).after(&shift(20.0, 0.0, z));
    let task = Task::new(&cylinder, [[0.0, 6.0], [0.0, 40.0]], ["phi", "z"], Hold::Point);
    let way = found(&machine("603125"), &task).unwrap();
    assert_eq!(way.law('X').unwrap().law, VariableLaw::Setting(20.0));
    assert!(way.links.is_empty() && way.law('C').unwrap().is_forming() && way.law('Z').unwrap().is_forming());
    assert!(way.lines().contains(&"X is set to 20 mm".to_owned()), "{:?}", way.lines());
    // Without a rotation the same point goes round by X and Y together.
    let way = found(&machine("2103"), &task).unwrap();
    assert_eq!(way.law('X').unwrap().law, VariableLaw::Sampled);
    assert_eq!(way.links.len(), 1);
    // Nothing moves for a point that stands still.
    let still = |_: [f64; 2]| shift(3.0, 0.0, 4.0);
    let task = Task::new(&still, [[0.0, 0.0], [0.0, 0.0]], ["u", "v"], Hold::Point);
    let way = found(&machine("2103"), &task).unwrap();
    assert!(
        way.laws.iter().all(|l| !l.is_forming()) && way.law('Z').unwrap().law == VariableLaw::Setting(4.0)
    );
}

#[test]
fn a_turning_edge_needs_its_frame() {
    // Split 615 | 3 of the cone: the straight edge is swivelled by B.
    let edge = |[phi, _]: [f64; 2]| turn_z(phi).after(&shift(30.0, 0.0, 0.0)).after(&turn_y(-0.35));
    let domain = [[0.0, 6.0], [0.0, 0.0]];
    let task = Task::new(&edge, domain, ["phi", "z"], Hold::Frame);
    let way = found(&machine("603125"), &task).unwrap();
    assert_eq!(way.law('C').unwrap().depends, [true, false]);
    let VariableLaw::Setting(b) = way.law('B').unwrap().law else { panic!("{way:?}") };
    assert!((b + 0.35).abs() < 1e-9);
    // A lathe without B lacks 20 degrees about Y, unless the angle is ground into the tool or set by its mounting.
    let lathe = machine("6031");
    let obstacle = found(&lathe, &task).unwrap_err();
    let Obstacle::Unreached { turn, rank, .. } = &obstacle else { panic!("{obstacle:?}") };
    assert!((turn.length() - 0.35).abs() < 1e-6 && *rank < 6, "{obstacle:?}");
    let finding = obstacle.finding(&lathe, task.hold, &task.names);
    assert_eq!(finding.code.as_str(), "KC1132");
    // The message has the digits that count, the finding the whole number.
    assert!(
        finding.message.contains("lacks a motion: 20.05 degrees") && !finding.message.contains("20.0535"),
        "{finding}"
    );
    assert!((finding.value.as_ref().unwrap().value - 0.35f64.to_degrees()).abs() < 1e-4, "{finding}");
    let mounted = Task { mount: turn_y(0.35), ..Task::new(&edge, domain, ["phi", "z"], Hold::Frame) };
    let way = found(&lathe, &mounted).unwrap();
    assert_eq!(way.law('X').unwrap().law, VariableLaw::Setting(30.0));
}

#[test]
fn face_milling_needs_three_axes_and_a_tilted_face_five() {
    let face = |[x, y]: [f64; 2]| shift(x, y, 10.0);
    let domain = [[-40.0, 40.0], [-30.0, 30.0]];
    let task = Task::new(&face, domain, ["x", "y"], Hold::Axis);
    let way = found(&machine("2103"), &task).unwrap();
    assert_eq!(way.law('Z').unwrap().law, VariableLaw::Setting(10.0));
    let tilted = |[x, y]: [f64; 2]| turn_y(0.4).after(&shift(x, y, 10.0));
    let task = Task::new(&tilted, domain, ["x", "y"], Hold::Axis);
    let three = machine("2103");
    let obstacle = found(&three, &task).unwrap_err();
    let Obstacle::Unreached { turn, .. } = &obstacle else { panic!("{obstacle:?}") };
    assert!((turn.length() - 0.4).abs() < 1e-9);
    let five = machine("641203");
    let way = found(&five, &task).unwrap();
    assert!(
        matches!(way.law('A').unwrap().law, VariableLaw::Setting(a) if (a.abs() - 0.4).abs() < 1e-9),
        "{way:?}"
    );
    assert!(way.tip_error < 1e-9 && way.turn_error < 1e-11);
    // The nearest machines have one more rotation; a B axis needs nothing else.
    let near = nearest_machines(&three, &task, &FeasibleOptions::default(), 4, &Silent).unwrap();
    // Y and B change places, so there are three places for B that differ; a fourth machine needs two changes.
    assert!(near.layouts == 6690 && near.classes > 100);
    let near = near.found;
    assert_eq!(near.iter().map(|a| a.distance).collect::<Vec<_>>(), [1, 1, 1, 2]);
    assert!(near[..3].iter().all(|a| a.changes.len() == 1 && a.code.to_string().contains('5')));
    assert!(near[0].changes[0].contains("a rotation B"), "{:?}", near[0].changes);
}

#[test]
fn travel_and_singular_places_are_told() {
    let mut lathe = machine("6031");
    lathe.joints[2].travel = Some([-5.0, 29.0]);
    let task = Task::new(&cone, [[0.0, 6.0], [0.0, 50.0]], ["phi", "z"], Hold::Point);
    let obstacle = found(&lathe, &task).unwrap_err();
    let Obstacle::Travel { joint: 2, value, bound, .. } = obstacle else { panic!("{obstacle:?}") };
    assert!((value - 30.0).abs() < 1e-9 && bound == 29.0);
    let finding = obstacle.finding(&lathe, task.hold, &task.names);
    assert!(finding.message.contains("axis X leaves its travel by 1 mm"), "{finding}");
    // Whole turns are put into the travel.
    lathe.joints[2].travel = None;
    lathe.joints[0].travel = Some([TAU - 0.1, TAU + 6.5]);
    let way = found(&lathe, &task).unwrap();
    assert!((way.law('C').unwrap().range[0] - TAU).abs() < 1e-9);
    // The direction of the tool passes near the axis of C: C has to turn half round at once, or A to change sides.
    let over = |[s, x]: [f64; 2]| {
        let lean = DMat3::from_rotation_x(s) * DMat3::from_rotation_y(1e-7);
        Rigid { rotation: lean, translation: DVec3::new(x, 0.0, 0.0) }
    };
    let task = Task::new(&over, [[-0.5, 0.5], [0.0, 10.0]], ["s", "x"], Hold::Axis);
    let mut five = machine("641203");
    let obstacle = found(&five, &task);
    // Through the pole A passes to its other side, and C hardly moves ... unless A may not.
    five.joints[1].travel = Some([-1.0, 0.1]);
    let blocked = found(&five, &task).unwrap_err();
    assert!(
        matches!(blocked, Obstacle::Travel { joint: 1, .. } | Obstacle::Jump { joint: 0, .. }),
        "{blocked:?} {obstacle:?}"
    );
}

#[test]
fn out_of_reach_is_told_in_degrees() {
    // A head that nutates about an axis at 45 degrees tilts up to 90.
    let mut machine = machine("6701230".trim_end_matches('0'));
    machine.joints[1].direction = DVec3::new(0.0, 1.0, 1.0).try_normalize().unwrap();
    let tilt = |[t, _]: [f64; 2]| turn_y(t);
    let task = Task::new(&tilt, [[0.0, 1.9], [0.0, 0.0]], ["t", "v"], Hold::Axis);
    let obstacle = found(&machine, &task).unwrap_err();
    let Obstacle::Unreached { turn, at, rank, .. } = &obstacle else { panic!("{obstacle:?}") };
    assert!((turn.length() - (1.9 - TAU / 4.0)).abs() < 1e-5 && (at[0] - 1.9).abs() < 1e-9, "{obstacle:?}");
    let finding = obstacle.finding(&machine, task.hold, &task.names);
    assert!(finding.value.as_ref().unwrap().unit == "deg" && *rank <= 5, "{finding}");
    let within = Task::new(&tilt, [[0.1, 1.5], [0.0, 0.0]], ["t", "v"], Hold::Axis);
    assert!(found(&machine, &within).is_ok());
}

#[test]
fn a_gear_flank_is_rolled_where_the_work_turns_and_the_rack_shifts() {
    // 6(phi) 1(rp) 2(-rp phi): the rack's frame.
    let rack = |[phi, z]: [f64; 2]| turn_z(phi).after(&shift(50.0, -50.0 * phi, z));
    let domain = [[-0.3, 0.5], [0.0, 20.0]];
    let task = Task::new(&rack, domain, ["phi", "z"], Hold::Frame);
    let way = found(&machine("61203"), &task).unwrap();
    let lines = way.lines();
    let feed = (-50.0 * TAU * 1e6).round() / 1e6;
    assert!(lines.contains(&format!("Y follows C, {feed} mm/rev")), "{lines:?}");
    assert!(lines.contains(&"X is set to 50 mm".to_owned()), "{lines:?}");
    // What the machine does by these laws leaves the involute of the base circle, from the base circle on.
    let alpha = 20f64.to_radians();
    let flank =
        ElementaryBody::HalfSpace { point: DVec3::ZERO, normal: DVec3::new(-alpha.sin(), alpha.cos(), 0.0) };
    let motion = MachineMotion::new(&way, &machine("61203"), 0.0, Rigid::IDENTITY);
    let domain = [[-0.3, 0.5], [0.0, 0.0]];
    let envelope = ToolEnvelope { tool: &flank, motion: &motion, domain, cells: [16, 0] };
    let base = 50.0 * alpha.cos();
    for phi in [-0.2f64, 0.0, 0.3] {
        let (t, start) = (phi + alpha.tan(), alpha - alpha.tan());
        let (s, c) = (t + start).sin_cos();
        let p = DVec3::new(c + t * s, s - t * c, 0.0) * base;
        let left = envelope.left(p);
        assert!(left.residual.abs() < 1e-9 && (left.at[0] - phi).abs() < 2e-5, "{phi} {left:?}");
        assert!(envelope.contact(p, [phi, 0.0])[0].abs() < 1e-8);
    }
    // Without the rotation of the work there is no rolling.
    let mill = machine("2103");
    let obstacle = found(&mill, &task).unwrap_err();
    assert!(matches!(obstacle, Obstacle::Unreached { rank: 3, .. }), "{obstacle:?}");
    let near = nearest_machines(&mill, &task, &FeasibleOptions::default(), 3, &Silent).unwrap().found;
    assert!(near.iter().all(|a| a.code.to_string().contains('6') && a.changes.len() == 1));
    assert!(!near.is_empty());
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let lathe = machine("6031");
    let task = Task::new(&cone, [[6.0, 0.0], [0.0, 50.0]], ["phi", "z"], Hold::Point);
    let error = can_make(&lathe, &task, &FeasibleOptions::default(), &Silent).unwrap_err();
    assert_eq!(error.code().as_str(), "KC1131");
    let broken = |u: [f64; 2]| shift(u[0].ln(), 0.0, 0.0);
    let task = Task::new(&broken, [[0.0, 1.0], [0.0, 1.0]], ["u", "v"], Hold::Point);
    assert!(can_make(&lathe, &task, &FeasibleOptions::default(), &Silent).is_err());
    let task = Task::new(&cone, [[0.0, 6.0], [0.0, 50.0]], ["phi", "z"], Hold::Point);
    let held = FeasibleOptions { held: vec![('A', 0.1)], ..FeasibleOptions::default() };
    assert_eq!(can_make(&lathe, &task, &held, &Silent).unwrap_err().code().as_str(), "KC0703");
    let held = FeasibleOptions { held: vec![('X', f64::NAN)], ..FeasibleOptions::default() };
    assert!(can_make(&lathe, &task, &held, &Silent).is_err());
    let mut unchecked = lathe.clone();
    unchecked.joints[0].direction = DVec3::ZERO;
    assert!(can_make(&unchecked, &task, &FeasibleOptions::default(), &Silent).is_err());
    // A pose that is no number somewhere inside is an obstacle, not a way.
    let hole = |u: [f64; 2]| shift(20.0 + (u[0] - 0.5).abs().ln(), 0.0, u[1]);
    let inside = Task::new(&hole, [[0.0, 1.0], [0.0, 1.0]], ["u", "v"], Hold::Point);
    assert!(can_make(&lathe, &inside, &FeasibleOptions::default(), &Silent).unwrap().is_err());
    // A held X leaves no cone.
    let held = FeasibleOptions { held: vec![('X', 30.0)], ..FeasibleOptions::default() };
    assert!(can_make(&lathe, &task, &held, &Silent).unwrap().is_err());
}

#[test]
fn a_pole_at_the_end_of_a_variable_is_passed_on_the_right_branch() {
    // A ball nose stands upright on a sphere: at the pole C is free, and must be where the way comes from.
    let upright = |[phi, t]: [f64; 2]| turn_z(phi).after(&turn_y(t)).after(&shift(0.0, 0.0, 25.0));
    let five = machine("651203");
    for names in [["phi", "t"], ["t", "phi"]] {
        let swap = names[0] == "t";
        let motion = |u: [f64; 2]| upright(if swap { [u[1], u[0]] } else { u });
        let (turn, tilt) = ([0.0, 6.0], [0.0, 1.2]);
        let domain = if swap { [tilt, turn] } else { [turn, tilt] };
        let task = Task::new(&motion, domain, names, Hold::Axis);
        let way = found(&five, &task).unwrap();
        let c = way.law('C').unwrap();
        let slope = match c.law {
            VariableLaw::Affine { slopes, .. } => slopes[usize::from(swap)],
            _ => panic!("{:?}", way.lines()),
        };
        assert!((slope - 1.0).abs() < 1e-9, "{:?}", way.lines());
        assert!(way.tip_error < 1e-8 && way.turn_error < 1e-10);
    }
    // Straight over the pole and a little beside it, C has to turn half round at once.
    let beside = |[s, x]: [f64; 2]| {
        let rotation = DMat3::from_rotation_y(s) * DMat3::from_rotation_x(1e-7);
        Rigid { rotation, translation: DVec3::new(x, 0.0, 0.0) }
    };
    let task = Task::new(&beside, [[-0.5, 0.5], [0.0, 10.0]], ["s", "x"], Hold::Axis);
    let obstacle = found(&five, &task).unwrap_err();
    assert!(matches!(obstacle, Obstacle::Jump { .. }), "{obstacle:?}");
    let finding = obstacle.finding(&five, task.hold, &task.names);
    assert!(finding.message.contains("would have to jump"), "{finding}");
}

struct Cancelled;

impl kinecut::base::Progress for Cancelled {
    fn stage(&self, _: &str, _: u64) {}
    fn advance(&self, _: u64) {}
    fn cancelled(&self) -> bool {
        true
    }
}

#[test]
fn a_search_that_is_cancelled_says_so() {
    let task = Task::new(&cone, [[0.0, 6.0], [0.0, 50.0]], ["phi", "z"], Hold::Point);
    let error = can_make(&machine("6031"), &task, &FeasibleOptions::default(), &Cancelled).unwrap_err();
    assert_eq!(error.code().as_str(), "KC0009");
}

/// Chains of three translations and two rotations with full mobility for a cutter.
const CLASSES: [&str; 12] = [
    "12345", "12354", "12364", "12365", "14235", "25134", "36124", "36125", "42513", "51423", "61423",
    "62513",
];

proptest! {
    #![proptest_config(kinecut_cases::property(24))]

    #[test]
    fn what_a_machine_did_it_can_do_again(
        class in 0usize..12,
        offsets in prop::array::uniform5(prop::array::uniform3(-40.0..40.0f64)),
        senses in 0u32..32,
        start in prop::array::uniform5(-0.3..0.3f64),
        slopes in prop::array::uniform5(prop::array::uniform2(-0.3..0.3f64)),
    ) {
        let mut five = machine(&format!("0{}", CLASSES[class]));
        for (i, joint) in five.joints.iter_mut().enumerate() {
            joint.point = DVec3::from(offsets[i]);
            joint.sense = if senses >> i & 1 == 1 { -1.0 } else { 1.0 };
        }
        let rotary: Vec<bool> = five.joints.iter().map(|j| j.motion.is_rotation()).collect();
        let tool_most = rotary.iter().rposition(|&r| r).unwrap();
        let laws = |[u, v]: [f64; 2]| -> Vec<f64> {
            let law = |i: usize| {
                let by = start[i] + slopes[i][0] * u + slopes[i][1] * v;
                // The second rotation tilts the tool, away from the axis of the first.
                let tilt = if i == tool_most { 0.9 } else { 0.0 };
                if rotary[i] { by + tilt } else { by * 100.0 }
            };
            (0..5).map(law).collect()
        };
        let chain = five.kinematics(80.0);
        let motion = |u: [f64; 2]| chain.forward(&laws(u));
        let task = Task::new(&motion, [[0.0, 1.0], [0.0, 1.0]], ["u", "v"], Hold::Axis);
        let options = FeasibleOptions { cells: [4, 3], tool_length: 80.0, ..FeasibleOptions::default() };
        let way = can_make(&five, &task, &options, &Silent).unwrap();
        let way = way.unwrap_or_else(|e| panic!("{} {e:?}", five.code));
        prop_assert!(way.tip_error < 1e-7 && way.turn_error < 1e-9);
        let [nu, nv] = way.nodes;
        for n in 0..nu * nv {
            let u = [(n / nv) as f64 / (nu - 1) as f64, (n % nv) as f64 / (nv - 1) as f64];
            let (made, wanted) = (chain.forward(&way.positions[n]), motion(u));
            prop_assert!((made.translation - wanted.translation).length() < 1e-7);
            prop_assert!((made.rotation.z_axis - wanted.rotation.z_axis).length() < 1e-9);
        }
    }
}
