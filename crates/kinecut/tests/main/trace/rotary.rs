//! Following programs on machines with rotary axes, against the machine's forward kinematics and by brute force.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use glam::{DMat3, DVec3};
use kinecut::base::Code;
use kinecut::geom::Rigid;
use kinecut::machine::{CoordinateCode, JointValues, Machine};
use kinecut::program::{
    Frame, Move, Origin, Path, Program, RotarySolution, Setup, SetupId, Speed, State, Target, Tcp, ToolAxis,
    ToolNumber, WorkOffset,
};
use kinecut::sweep::ToolMotion;
use kinecut::tool::Tool;
use kinecut::trace::{CompStart, Segment, Trace, TraceOptions, trace, travel_findings};

use crate::common::end_mill::end_mill;

const LENGTH: f64 = 120.0;

/// A machine with offsets, so that nothing cancels by chance.
pub(super) fn machine(code: &str) -> Machine {
    let mut machine =
        Machine::new(CoordinateCode::parse(code).unwrap(), [None; 3], Default::default()).unwrap();
    for (i, joint) in machine.joints.iter_mut().enumerate() {
        if joint.motion.is_rotation() {
            joint.point = DVec3::new(5.0 + i as f64, -3.0, 40.0 - 7.0 * i as f64);
        }
    }
    machine
}

fn tool() -> Tool {
    end_mill(1, LENGTH)
}

const WORK: DVec3 = DVec3::new(30.0, -20.0, 15.0);

pub(super) fn program(located: bool) -> (Program, State) {
    let setup = Setup {
        name: "setup 1".to_owned(),
        part_on_table: Rigid { rotation: DMat3::from_rotation_z(FRAC_PI_2), translation: WORK },
        work_offsets: BTreeMap::from([(WorkOffset::G54, Rigid::from_translation(WORK))]),
        located,
        stock: None,
        fixtures: Vec::new(),
    };
    let mut program = Program::new(vec![setup]);
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    state.speed = Speed::Rapid { linear: true };
    program.push_tool(ToolNumber(1), Some(1), None, &state, Origin::default());
    (program, state)
}

pub(super) fn to(program: &mut Program, state: &State, point: [f64; 3], axis: ToolAxis) {
    let end = Target::Tip { point: DVec3::from_array(point), axis };
    program.push_move(Move { end, path: Path::Line }, state, Origin::default());
}

pub(super) fn followed(program: &Program, machine: &Machine) -> Trace {
    followed_or(program, Some(machine)).unwrap()
}

pub(super) fn followed_or(program: &Program, machine: Option<&Machine>) -> kinecut::base::Result<Trace> {
    let tools = [tool()];
    let options = TraceOptions {
        machine,
        tools: &tools,
        retract_height: 250.0,
        operator: kinecut::trace::RegisterState::default(),
        radii: &[],
        comp_start: CompStart::AtNext,
        chord: 1e-3,
    };
    trace(program, &options)
}

/// The tip and the tool axis in part coordinates at axis positions X Y Z A B C.
fn on_machine(machine: &Machine, program: &Program, axes: [f64; 6]) -> (DVec3, DVec3) {
    let values: Vec<f64> = machine.joints.iter().map(|j| axes["XYZABC".find(j.letter).unwrap()]).collect();
    let tip = machine.kinematics(LENGTH).forward(&JointValues::new(&values));
    let to_part = program.setups[0].part_on_table.inverse();
    (to_part.point(tip.translation), to_part.vector(tip.rotation.z_axis))
}

/// Pose and axis positions of a segment belong together at all places, but for the chords of the tip.
fn consistent(segment: &Segment, machine: &Machine, program: &Program, chord: f64) {
    for k in 0..=8 {
        let t = f64::from(k) / 8.0;
        let joints = segment.joints(t).unwrap();
        let (tip, axis) = on_machine(machine, program, joints);
        let pose = segment.pose(t * segment.curve.length());
        let back = segment.tip_at(joints).unwrap();
        assert!((back - tip).length() < 1e-9, "tip off by {} at {t}", (back - tip).length());
        assert!(
            (tip - pose.tip.p).length() <= 1.02 * chord + 1e-9,
            "tip off by {} at {t}",
            (tip - pose.tip.p).length()
        );
        if segment.curve.length() > 0.0 || k == 0 {
            assert!((axis - pose.axis).length() < 1e-9, "axis {axis} {} at {t}", pose.axis);
        }
    }
}

pub(super) fn rotary(code: &str, first: f64, second: f64) -> [Option<f64>; 3] {
    let mut angles = [None; 3];
    let letters: Vec<usize> = code.chars().filter_map(|c| "456".find(c)).collect();
    angles[letters[0]] = Some(first);
    angles[letters[1]] = Some(second);
    angles
}

const CODES: [&str; 6] = ["641203", "651203", "450123", "012365", "603125", "261035"];

#[test]
fn the_tip_keeps_to_its_line_under_control_of_the_tool_centre_point() {
    for code in &CODES[..4] {
        for tcp in [Tcp::Axes, Tcp::Vector] {
            let machine = machine(code);
            let (mut program, mut state) = program(true);
            to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
            state.tcp = tcp;
            state.speed = Speed::PerMinute(20.0);
            to(&mut program, &state, [40.0, 10.0, 20.0], ToolAxis::Rotary(rotary(code, 0.4, -0.7)));
            to(&mut program, &state, [-10.0, 30.0, 5.0], ToolAxis::Rotary(rotary(code, -0.2, 0.3)));
            let trace = followed(&program, &machine);
            assert_eq!(trace.segments.len(), 2, "{code}");
            let to_part = program.setups[0].part_on_table.inverse();
            let work = |p: [f64; 3]| to_part.point(DVec3::from_array(p) + WORK);
            assert!((trace.segments[1].curve.end() - work([-10.0, 30.0, 5.0])).length() < 1e-12);
            for segment in &trace.segments {
                consistent(segment, &machine, &program, trace.chord_error);
                let [start, middle, end] =
                    [0.0, 0.5, 1.0].map(|t| segment.pose(t * segment.curve.length()).axis);
                let plane = start.cross(end).try_normalize().unwrap();
                if tcp == Tcp::Vector {
                    assert!(middle.dot(plane).abs() < 1e-12, "the axis leaves the plane of its ends");
                    assert!((middle - (start + end).try_normalize().unwrap()).length() < 1e-12);
                } else {
                    let [a, m, b] = [0.0, 0.5, 1.0].map(|t| segment.joints(t).unwrap());
                    for i in 3..6 {
                        assert!((m[i] - 0.5 * (a[i] + b[i])).abs() < 1e-15);
                    }
                    assert!(middle.dot(plane).abs() > 1e-6, "{code}: axes that go straight leave the plane");
                }
                // The rate of turning by differences.
                let (s, h) = (0.37 * segment.curve.length(), 1e-5);
                let slope = (segment.pose(s + h).axis - segment.pose(s - h).axis) / (2.0 * h);
                let pose = segment.pose(s);
                assert!((pose.turning.cross(pose.axis) - slope).length() < 1e-9, "{code}");
            }
            let time: f64 = trace.segments.iter().map(|s| s.duration.unwrap()).sum();
            let way: f64 = trace.segments.iter().map(|s| s.curve.length()).sum();
            assert!((time - way / 20.0).abs() < 1e-12);
            // Where the tip stands still, the feed counts degrees of the rotary axes.
            to(&mut program, &state, [-10.0, 30.0, 5.0], ToolAxis::Rotary(rotary(code, -0.3, 0.5)));
            let last = followed(&program, &machine).segments.pop().unwrap();
            assert_eq!(last.curve.length(), 0.0);
            assert!((last.duration.unwrap() - 0.3f64.to_degrees() / 20.0).abs() < 1e-12);
        }
    }
}

#[test]
fn a_vector_turns_the_rotary_axes_to_it() {
    for code in &CODES {
        let machine = machine(code);
        let (mut program, mut state) = program(true);
        to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
        state.tcp = Tcp::Vector;
        state.speed = Speed::PerMinute(20.0);
        let axis = DVec3::new(0.3, -0.2, 0.9).try_normalize().unwrap();
        to(&mut program, &state, [40.0, 10.0, 20.0], ToolAxis::Vector(axis));
        let trace = followed(&program, &machine);
        let segment = &trace.segments[0];
        consistent(segment, &machine, &program, trace.chord_error);
        let to_part = program.setups[0].part_on_table.inverse();
        assert!((segment.end_axis() - to_part.vector(axis)).length() < 1e-12, "{code}");
    }
}

#[test]
fn without_it_the_axes_go_straight_and_the_tip_is_followed_by_chords() {
    for code in &CODES {
        let machine = machine(code);
        let (mut program, mut state) = program(true);
        to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
        state.speed = Speed::Duration(3.0);
        let angles = rotary(code, 0.5, -0.6);
        to(&mut program, &state, [40.0, 10.0, 20.0], ToolAxis::Rotary(angles));
        let trace = followed(&program, &machine);
        assert!(trace.segments.len() > 10, "{code}");
        assert!(trace.chord_error <= 1e-3 && trace.chord_error > 1e-5);
        let mut done = 0.0;
        for segment in &trace.segments {
            let part = segment.duration.unwrap() / 3.0;
            for k in 0..=4 {
                let t = f64::from(k) / 4.0;
                // What the control does: every axis in proportion to time.
                let at = done + part * t;
                let start = [WORK.x, WORK.y, 50.0 + WORK.z + LENGTH];
                let mut axes = [0.0; 6];
                for (i, by) in [40.0, 10.0, -30.0].into_iter().enumerate() {
                    axes[i] = start[i] + at * by;
                    axes[3 + i] = at * angles[i].unwrap_or(0.0);
                }
                let (tip, axis) = on_machine(&machine, &program, axes);
                let pose = segment.pose(t * segment.curve.length());
                assert!((tip - pose.tip.p).length() < 1.01e-3, "{code}: {}", (tip - pose.tip.p).length());
                assert!((axis - pose.axis).length() < 1e-9);
            }
            done += part;
        }
        assert!((done - 1.0).abs() < 1e-12);
    }
}

#[test]
fn coordinates_are_axis_positions_while_rotary_axes_stand_turned() {
    let machine = machine("641203");
    let (mut program, mut state) = program(true);
    to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
    to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Rotary(rotary("641203", 0.3, 0.9)));
    let before = followed(&program, &machine).segments.len();
    state.speed = Speed::PerMinute(10.0);
    to(&mut program, &state, [8.0, -3.0, 40.0], ToolAxis::Fixed);
    let centre = DVec3::new(8.0, -3.0 + 5.0, 40.0);
    let arc = Path::Arc { centre, axis: DVec3::Z, sweep: 1.0, rise: 0.0 };
    let end = centre + DMat3::from_rotation_z(1.0) * (DVec3::NEG_Y * 5.0);
    let end = Target::Tip { point: end, axis: ToolAxis::Fixed };
    program.push_move(Move { end, path: arc }, &state, Origin::default());
    let trace = followed(&program, &machine);
    let [line, arc] = &trace.segments[before..] else { panic!("two moves") };
    for segment in [line, arc] {
        consistent(segment, &machine, &program, trace.chord_error);
        for (i, angle) in [(3, 0.9), (5, 0.3)] {
            assert_eq!(segment.joints(0.5).unwrap()[i], angle);
        }
    }
    let end = line.joints(1.0).unwrap();
    let wanted = [8.0 + WORK.x, -3.0 + WORK.y, 40.0 + WORK.z + LENGTH];
    assert!((0..3).all(|i| (end[i] - wanted[i]).abs() < 1e-9), "{end:?}");
    // The arc is one of the linear axes: its middle lies on the circle of axis positions.
    let middle = arc.joints(0.5).unwrap();
    let from_centre = DVec3::new(middle[0], middle[1], middle[2]) - (centre + WORK + DVec3::Z * LENGTH);
    assert!((from_centre.length() - 5.0).abs() < 1e-9 && from_centre.z.abs() < 1e-9);
}

pub(super) fn tilted(z: DVec3, branch: RotarySolution) -> (Program, State) {
    let (mut program, mut state) = program(true);
    to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
    let x = z.any_orthonormal_vector();
    let motion =
        Rigid { rotation: DMat3::from_cols(x, z.cross(x), z), translation: DVec3::new(1.0, 2.0, 3.0) };
    state.frame = program.add_frame(Frame::Tilted { parent: state.frame, motion, branch });
    let orient = Move { end: Target::Orient, path: Path::Line };
    program.push_move(orient, &state, Origin::default());
    (program, state)
}

#[test]
fn a_tilted_plane_is_reached_on_the_asked_branch() {
    let z = DVec3::new(0.3, 0.4, 0.8).try_normalize().unwrap();
    for (branch, sign) in [(RotarySolution::Positive, 1.0), (RotarySolution::Negative, -1.0)] {
        let machine = machine("641203");
        let (mut program, mut state) = tilted(z, branch);
        to(&mut program, &state, [4.0, 5.0, 6.0], ToolAxis::Fixed);
        state.speed = Speed::PerMinute(10.0);
        to(&mut program, &state, [14.0, 5.0, 6.0], ToolAxis::Fixed);
        let trace = followed(&program, &machine);
        let last = trace.segments.last().unwrap();
        assert_eq!(last.joints(0.0).unwrap()[3].signum(), sign, "A takes the branch");
        let Frame::Tilted { motion, .. } = program.frames[1] else { panic!() };
        let to_part = program.setups[0].part_on_table.inverse();
        let wanted = to_part.point(motion.point(DVec3::new(14.0, 5.0, 6.0)) + WORK);
        assert!((last.curve.end() - wanted).length() < 1e-9);
        assert!((last.axis - to_part.vector(z)).length() < 1e-9);
        for segment in &trace.segments {
            consistent(segment, &machine, &program, trace.chord_error);
        }
        // Linear axes stand still while the plane is reached: the first and the last of these positions are alike.
        let turn: Vec<_> = trace.segments.iter().filter(|s| s.turning.is_some()).collect();
        let (start, end) = (turn[0].joints(0.0).unwrap(), turn.last().unwrap().joints(1.0).unwrap());
        assert!((0..3).all(|i| (start[i] - end[i]).abs() < 1e-9), "{start:?} {end:?}");
    }
}

#[test]
fn a_retraction_runs_along_the_machines_axis() {
    let machine = machine("641203");
    let (mut program, mut state) = tilted(DVec3::new(0.6, 0.0, 0.8), RotarySolution::Free);
    to(&mut program, &state, [4.0, 5.0, 6.0], ToolAxis::Fixed);
    state.frame = kinecut::program::FrameId(0);
    let up = Target::Joints([None, None, Some(400.0), None, None, None]);
    program.push_move(Move { end: up, path: Path::Line }, &state, Origin::default());
    let back = Target::Joints([None, None, None, Some(0.0), None, Some(0.0)]);
    program.push_move(Move { end: back, path: Path::Line }, &state, Origin::default());
    to(&mut program, &state, [0.0, 0.0, 60.0], ToolAxis::Fixed);
    let trace = followed(&program, &machine);
    let up = trace.segments.iter().find(|s| (s.joints(1.0).unwrap()[2] - 400.0).abs() < 1e-9).unwrap();
    let (a, b) = (up.joints(0.0).unwrap(), up.joints(1.0).unwrap());
    assert!((0..2).all(|i| (a[i] - b[i]).abs() < 1e-9), "X and Y stand still");
    assert!((0..3).all(|i| (a[3 + i] - b[3 + i]).abs() < 1e-15));
    let last = trace.segments.last().unwrap();
    assert_eq!(last.rotary(), [0.0; 3]);
    for segment in &trace.segments {
        consistent(segment, &machine, &program, trace.chord_error);
    }
}

#[test]
fn travel_is_compared_on_all_axes() {
    let mut machine = machine("641203");
    let (mut program, mut state) = program(true);
    to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
    state.tcp = Tcp::Axes;
    state.speed = Speed::PerMinute(20.0);
    to(&mut program, &state, [40.0, 10.0, 20.0], ToolAxis::Rotary([Some(0.8), None, Some(0.2)]));
    let trace = followed(&program, &machine);
    assert!(travel_findings(&trace, &program, &machine).is_empty());
    let dense = (0..=20_000).map(|k| trace.segments[0].joints(f64::from(k) / 20_000.0).unwrap());
    let highest = dense.map(|q| q[1]).fold(f64::NEG_INFINITY, f64::max);
    for joint in &mut machine.joints {
        joint.travel = match joint.letter {
            'A' => Some([-0.1, 0.5]),
            'Y' => Some([-1000.0, highest - 0.01]),
            _ => Some([-1000.0, 1000.0]),
        };
    }
    // A limit is no hindrance to angles that are programmed: the finding is about the program.
    let found = travel_findings(&followed(&program, &machine), &program, &machine);
    let said: Vec<String> = found.iter().map(|f| f.message.clone()).collect();
    assert_eq!(said, ["Y leaves its travel", "A leaves its travel"]);
    assert!((found[1].value.as_ref().unwrap().value - 0.8f64.to_degrees()).abs() < 1e-9);
    assert!((found[0].value.as_ref().unwrap().value - highest).abs() < 0.01);
}

#[test]
fn a_direction_given_as_a_vector_stays_without_a_machine() {
    let (mut program, mut state) = program(false);
    to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
    state.tcp = Tcp::Vector;
    state.speed = Speed::PerMinute(20.0);
    to(&mut program, &state, [40.0, 10.0, 20.0], ToolAxis::Vector(DVec3::new(0.6, 0.0, 0.8)));
    to(&mut program, &state, [40.0, 10.0, 60.0], ToolAxis::Rotary([None; 3]));
    let followed = followed_or(&program, None).unwrap();
    let last = followed.segments.last().unwrap();
    // The part lies turned by a right angle.
    assert!(last.turning.is_none() && last.axis.distance(DVec3::new(0.0, -0.6, 0.8)) < 1e-12);
    assert!(last.curve.end().distance(DVec3::new(10.0, -40.0, 60.0)) < 1e-12);
}

#[test]
fn what_cannot_be_followed_is_said() {
    let refused = |located: bool, machine: Option<&Machine>, tcp: Tcp, axis: ToolAxis| {
        let (mut program, mut state) = program(located);
        to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
        state.tcp = tcp;
        state.speed = Speed::PerMinute(20.0);
        to(&mut program, &state, [40.0, 10.0, 20.0], axis);
        followed_or(&program, machine).unwrap_err()
    };
    let table = machine("641203");
    let turn = ToolAxis::Rotary([Some(0.8), None, None]);
    assert_eq!(refused(true, None, Tcp::Axes, turn).code(), Code::MACHINE_AXIS);
    let wrong = refused(true, Some(&table), Tcp::Axes, ToolAxis::Rotary([None, Some(0.1), None]));
    assert!(wrong.to_string().contains("no B axis"), "{wrong}");
    let unknown = refused(false, Some(&table), Tcp::Off, turn);
    assert!(unknown.to_string().contains("where the work lies"), "{unknown}");
    let vector = ToolAxis::Vector(DVec3::new(0.6, 0.0, 0.8));
    assert_eq!(refused(true, Some(&table), Tcp::Off, vector).code(), Code::NC_STATE);
    // A direction outside of the travel.
    let mut narrow = table.clone();
    for joint in narrow.joints.iter_mut().filter(|j| j.letter == 'A') {
        joint.travel = Some([-0.1, 0.1]);
    }
    assert_eq!(refused(true, Some(&narrow), Tcp::Vector, vector).code(), Code::TRAVEL_EXCEEDED);
    // A move in a tilted plane before the axes were turned to it.
    let (mut program, mut state) = program(true);
    let motion = Rigid { rotation: DMat3::from_rotation_x(0.3), translation: DVec3::ZERO };
    state.frame =
        program.add_frame(Frame::Tilted { parent: state.frame, motion, branch: RotarySolution::Free });
    to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
    assert!(followed_or(&program, Some(&table)).unwrap_err().to_string().contains("before the rotary axes"));
}

/// Tip and axis of a move are those of its segment, and it turns as fast.
fn moves_as(motion: &ToolMotion, segment: &Segment, chord: f64) {
    let length = segment.curve.length();
    for k in 0..=8 {
        let t = f64::from(k) / 8.0;
        let (pose, jet) = (segment.pose(t * length), motion.at(t));
        assert!((jet.pose.translation - motion.pose(t).translation).length() < 1e-9);
        let off = (jet.pose.translation - pose.tip.p).length();
        assert!(off <= if k % 8 == 0 { 1e-9 } else { 1.02 * chord + 1e-9 }, "tip off by {off} at {t}");
        if length > 0.0 {
            assert!((jet.pose.rotation.z_axis - pose.axis).length() < 1e-9, "axis at {t}");
            let turning = (jet.pose.rotation * jet.twist.turn).cross(pose.axis);
            assert!((turning - pose.turning.cross(pose.axis) * length).length() < 1e-8, "turning at {t}");
        }
        assert!((jet.pose.rotation.determinant() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn moves_of_the_tool_are_those_of_the_segments_of_every_kind() {
    for code in &CODES {
        let machine = machine(code);
        let (mut program, mut state) = program(true);
        to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
        state.speed = Speed::PerMinute(20.0);
        to(&mut program, &state, [12.0, -5.0, 40.0], ToolAxis::Fixed);
        for tcp in [Tcp::Axes, Tcp::Vector] {
            state.tcp = tcp;
            let sign = if tcp == Tcp::Axes { 1.0 } else { -1.0 };
            to(&mut program, &state, [40.0, 10.0, 20.0], ToolAxis::Rotary(rotary(code, 0.4 * sign, -0.7)));
            // On the spot.
            to(&mut program, &state, [40.0, 10.0, 20.0], ToolAxis::Rotary(rotary(code, 0.1, 0.2)));
        }
        let trace = followed(&program, &machine);
        assert_eq!(trace.segments.len(), 5, "{code}");
        for segment in &trace.segments {
            moves_as(&ToolMotion::of_segment(segment).unwrap(), segment, 0.0);
        }
        assert_eq!(ToolMotion::of_segments(&trace.segments).unwrap().len(), 5, "nothing is joined");
    }
}

#[test]
fn chords_of_axes_that_go_straight_are_one_move_of_the_tool() {
    for code in &CODES {
        let machine = machine(code);
        let (mut program, mut state) = program(true);
        to(&mut program, &state, [0.0, 0.0, 50.0], ToolAxis::Fixed);
        state.speed = Speed::Duration(3.0);
        let angles = rotary(code, 0.5, -0.6);
        to(&mut program, &state, [40.0, 10.0, 20.0], ToolAxis::Rotary(angles));
        to(&mut program, &state, [40.0, -10.0, 20.0], ToolAxis::Rotary(rotary(code, 0.2, 0.6)));
        let trace = followed(&program, &machine);
        for segment in &trace.segments {
            moves_as(&ToolMotion::of_segment(segment).unwrap(), segment, trace.chord_error);
        }
        let moves = ToolMotion::of_segments(&trace.segments).unwrap();
        assert_eq!(moves.len(), 2, "{code}: as many as the program has");
        assert_eq!(moves[0].0.end, moves[1].0.start);
        assert_eq!(moves[1].0.end, trace.segments.len());
        for k in 0..=8 {
            let t = f64::from(k) / 8.0;
            let mut axes = [0.0; 6];
            let start = [WORK.x, WORK.y, 50.0 + WORK.z + LENGTH];
            for (i, by) in [40.0, 10.0, -30.0].into_iter().enumerate() {
                axes[i] = start[i] + t * by;
                axes[3 + i] = t * angles[i].unwrap_or(0.0);
            }
            let (tip, axis) = on_machine(&machine, &program, axes);
            let pose = moves[0].1.pose(t);
            assert!((pose.translation - tip).length() < 1e-9, "{code}: exact, not by chords");
            assert!((pose.rotation.z_axis - axis).length() < 1e-9);
        }
    }
}
