//! Feeds that an axis cannot hold, against the closed forms of a circle.

use std::f64::consts::TAU;

use glam::DVec3;
use kinecut::base::{Code, Severity};
use kinecut::geom::CurveKind;
use kinecut::job::{GivenFile, ProgramWants, given_alone};
use kinecut::machine::{CoordinateCode, Dynamics, Machine};
use kinecut::motion::{AxisBound, feeds_beyond};
use kinecut::program::{
    Frame, Move, Origin, Path, Program, SetupId, Speed, State, Target, ToolAxis, WorkOffset,
};
use kinecut::trace::{CompStart, RegisterState, TraceOptions, trace};
use kinecut::verbs::check::program_sheet;

use crate::common::setup::setup;

/// X 5 m/s2 and 50 m/s3, Y and Z as much unless `y` [mm/s2] says otherwise.
fn machine(y: Option<f64>) -> Machine {
    let dynamics = Dynamics { rapid: Some(500.0), acceleration: Some(5000.0), jerk: Some(50_000.0) };
    let mut machine = Machine::new(CoordinateCode::parse("2103").unwrap(), [None; 3], dynamics).unwrap();
    let joint = machine.joints.iter_mut().find(|joint| joint.letter == 'Y').unwrap();
    joint.dynamics.acceleration = y;
    machine
}

/// A whole circle of this radius at a feed [mm/s].
fn circle(radius: f64, feed: f64) -> Program {
    let mut program = Program::new(vec![setup()]);
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    let mut to = |point: DVec3, path: Path, speed: Speed| {
        state.speed = speed;
        let end = Target::Tip { point, axis: ToolAxis::Fixed };
        program.push_move(Move { end, path }, &state, Origin::default());
    };
    let start = DVec3::X * radius;
    to(start, Path::Line, Speed::Rapid { linear: true });
    let round = Path::Arc { centre: DVec3::ZERO, axis: DVec3::Z, sweep: TAU, rise: 0.0 };
    to(start, round, Speed::PerMinute(feed));
    to(start + DVec3::X * 50.0, Path::Line, Speed::PerMinute(feed));
    program
}

#[test]
fn a_circle_is_held_up_to_its_closed_forms() {
    let acceleration = |a: f64, r: f64| (AxisBound::Acceleration, (a * r).sqrt());
    let jerk = |r: f64| (AxisBound::Jerk, (5e4 * r * r).cbrt());
    // Radius, feed, acceleration of Y, and the largest feeds.
    let cases = [
        (10.0, 150.0, None, vec![]),
        (10.0, 200.0, None, vec![jerk(10.0)]),
        (10.0, 300.0, None, vec![acceleration(5000.0, 10.0), jerk(10.0)]),
        (10.0, 150.0, Some(2000.0), vec![acceleration(2000.0, 10.0)]),
        (400.0, 600.0, None, vec![(AxisBound::Velocity, 500.0)]),
    ];
    for (radius, feed, y, expected) in cases {
        let machine = machine(y);
        let program = circle(radius, feed);
        let options = TraceOptions {
            machine: Some(&machine),
            tools: &[],
            retract_height: 250.0,
            operator: RegisterState::default(),
            radii: &[],
            comp_start: CompStart::AtNext,
            chord: 1e-3,
        };
        let trace = trace(&program, &options).unwrap();
        let round = |i: usize| matches!(trace.segments[i].curve.kind(), CurveKind::Arc(_));
        let found: Vec<_> = feeds_beyond(&trace, &machine).into_iter().filter(|b| round(b.segment)).collect();
        assert_eq!(found.len(), expected.len(), "{radius} {feed} {found:?}");
        for (found, (bound, held)) in found.iter().zip(expected) {
            assert_eq!(found.bound, bound);
            assert!((found.share * feed / held - 1.0).abs() < 2e-3, "{radius} {found:?} {held}");
            assert!(found.axis == 'Y' || y.is_none());
        }
    }
}

#[test]
fn a_sheet_names_the_axis_its_limit_and_the_feed_that_it_holds() {
    let text = b"G21 G90 G94 G54\nT1 M6\nG43\nM3 S1000\nG0 X2 Y0 Z5\nG1 Z-1 F600\nG3 X2 Y0 I-2 J0 F6000\nG1 X30\nM2\n";
    let given = |machine: Machine| {
        let wants = ProgramWants { machine: Some(machine), ..ProgramWants::default() };
        let program = GivenFile { name: "circle.ngc", bytes: text };
        program_sheet(&given_alone(program, &wants, false).unwrap()).unwrap()
    };
    let sheet = given(machine(Some(1000.0)));
    let found: Vec<_> = sheet.findings.iter().filter(|f| f.code == Code::FEED_BEYOND).collect();
    assert!(found.len() == 2 && found.iter().all(|f| f.severity == Severity::Warning), "{found:?}");
    assert!(found[1].message.contains("within its jerk"), "{found:?}");
    assert!(found[0].message.starts_with("Y does not hold the feed within its acceleration"), "{found:?}");
    assert_eq!(found[0].place.as_ref().unwrap().line, 7);
    let value = found[0].value.as_ref().unwrap().value;
    assert!((value - 60.0 * 2000.0_f64.sqrt()).abs() < 6.0, "{value}");
    let free = given(Machine { dynamics: Dynamics::default(), ..machine(None) });
    assert!(free.findings.iter().all(|f| f.code != Code::FEED_BEYOND));
}
