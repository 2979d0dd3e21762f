//! Times of whole programs on machines with dynamics.

use std::f64::consts::TAU;

use glam::DVec3;
use kinecut::base::Silent;
use kinecut::geom::Arc;
use kinecut::job::{GivenFile, ProgramWants, given_alone};
use kinecut::machine::{CoordinateCode, Dynamics, Interpolator, Machine, Rapids};
use kinecut::motion::{AxisLimit, Changes, ProgramTime, SCurve, axis_limits, program_time};
use kinecut::program::{
    Blend, Frame, Move, Origin, Path, Program, SetupId, Speed, Spindle, State, Target, Tcp, ToolAxis,
    ToolNumber, WorkOffset,
};
use kinecut::tool::Tool;
use kinecut::trace::{CompStart, RegisterState, Trace, TraceOptions, trace};
use kinecut::verbs::check::program_sheet;

use crate::common::end_mill::end_mill;
use crate::common::setup::setup;

pub(super) const X: AxisLimit = AxisLimit { velocity: 500.0, acceleration: 5000.0, jerk: 50_000.0 };
pub(super) const Y: AxisLimit = AxisLimit { velocity: 400.0, acceleration: 2000.0, jerk: 60_000.0 };
pub(super) const Z: AxisLimit = AxisLimit { velocity: 250.0, acceleration: 3000.0, jerk: 30_000.0 };
pub(super) const FEED: f64 = 60.0;

pub(super) fn dynamics(limit: AxisLimit) -> Dynamics {
    Dynamics { rapid: Some(limit.velocity), acceleration: Some(limit.acceleration), jerk: Some(limit.jerk) }
}

/// X has the limits of the machine, Y and Z their own; rotary axes, if the code has any, those of none.
pub(super) fn machine_of(code: &str) -> Machine {
    let mut machine = Machine::new(CoordinateCode::parse(code).unwrap(), [None; 3], dynamics(X)).unwrap();
    for (letter, limit) in [('Y', Y), ('Z', Z)] {
        let (place, _) = machine.joint(letter).unwrap();
        machine.joints[place].dynamics = dynamics(limit);
    }
    machine
}

pub(super) fn machine() -> Machine {
    machine_of("2103")
}

fn tool(number: u32) -> Tool {
    end_mill(number, 100.0)
}

/// A program that stands at the origin, with what its next moves do.
pub(super) struct Written {
    pub(super) program: Program,
    pub(super) state: State,
}

impl Written {
    pub(super) fn new() -> Written {
        let mut program = Program::new(vec![setup()]);
        let frame = program.add_frame(Frame::Work(WorkOffset::G54));
        let mut state = State::start(SetupId(0), frame);
        state.speed = Speed::Rapid { linear: true };
        program.push_tool(ToolNumber(1), Some(1), None, &state, Origin::default());
        let mut written = Written { program, state };
        written.to([0.0; 3]);
        written
    }

    pub(super) fn at_feed(blend: Blend) -> Written {
        let mut written = Written::new();
        written.state.speed = Speed::PerMinute(FEED);
        written.state.blend = blend;
        written
    }

    pub(super) fn to(&mut self, point: [f64; 3]) {
        self.turned_to(point, ToolAxis::Fixed);
    }

    pub(super) fn turned_to(&mut self, point: [f64; 3], axis: ToolAxis) {
        let end = Target::Tip { point: DVec3::from_array(point), axis };
        self.program.push_move(Move { end, path: Path::Line }, &self.state, Origin::default());
    }

    pub(super) fn time(&self, machine: &Machine) -> Option<ProgramTime> {
        program_time(&self.program, &self.traced(machine), machine, &Silent).unwrap()
    }

    pub(super) fn traced(&self, machine: &Machine) -> Trace {
        let tools = [tool(1), tool(2)];
        let options = TraceOptions {
            machine: Some(machine),
            tools: &tools,
            retract_height: 250.0,
            operator: RegisterState::default(),
            radii: &[],
            comp_start: CompStart::AtNext,
            chord: 1e-3,
        };
        trace(&self.program, &options).unwrap()
    }
}

/// A straight way of these axes: the closed form under the limit that binds first.
fn straight(way: [f64; 3], feed: f64) -> f64 {
    let length = way.iter().map(|w| w * w).sum::<f64>().sqrt();
    let mut along = AxisLimit { velocity: feed, acceleration: f64::INFINITY, jerk: f64::INFINITY };
    for (way, limit) in way.iter().zip([X, Y, Z]) {
        let share = way.abs() / length;
        if share > 0.0 {
            along.velocity = along.velocity.min(limit.velocity / share);
            along.acceleration = along.acceleration.min(limit.acceleration / share);
            along.jerk = along.jerk.min(limit.jerk / share);
        }
    }
    SCurve::new(length, along).duration()
}

fn same(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9 * (1.0 + expected), "{found} {expected}");
}

const WAYS: [[f64; 3]; 5] =
    [[80.0, 0.0, 0.0], [0.0, -3.0, 0.0], [0.0, 0.0, 0.2], [120.0, 50.0, -10.0], [1.0, 30.0, 2.0]];

#[test]
fn a_rapid_is_the_closed_form_of_the_axis_that_binds_first() {
    for way in WAYS {
        let mut written = Written::new();
        written.to(way);
        let time = written.time(&machine()).unwrap();
        same(time.moves, straight(way, f64::INFINITY));
        same(time.total(), time.moves);
        assert!(time.without_jerk < time.moves && time.total_without_jerk() < time.total(), "{time:?}");
    }
}

#[test]
fn a_straight_move_at_feed_is_the_closed_form_under_its_feed() {
    for way in WAYS {
        let mut written = Written::at_feed(Blend::Continuous);
        written.to(way);
        same(written.time(&machine()).unwrap().moves, straight(way, FEED));
    }
}

#[test]
fn rapids_axis_by_axis_take_the_time_of_the_slowest_axis() {
    let mut machine = machine();
    machine.rapids = Some(Rapids::AxisByAxis);
    for way in WAYS {
        let mut written = Written::new();
        written.state.speed = Speed::Rapid { linear: false };
        written.to(way);
        let apart = way.iter().zip([X, Y, Z]).map(|(w, limit)| SCurve::new(w.abs(), limit).duration());
        same(written.time(&machine).unwrap().moves, apart.fold(0.0, f64::max));
    }
}

#[test]
fn a_rotary_axis_has_its_own_limits_and_none_of_them_are_those_of_linear_axes() {
    let limit = AxisLimit { velocity: 0.8, acceleration: 4.0, jerk: 90.0 };
    let mut machine = machine_of("651203");
    let mut written = Written::new();
    written.turned_to([0.0; 3], ToolAxis::Rotary([None, None, Some(1.1)]));
    assert_eq!(written.time(&machine), None, "C has no limits");
    let (place, _) = machine.joint('C').unwrap();
    machine.joints[place].dynamics = dynamics(limit);
    assert_eq!(axis_limits(&machine), [Some(X), Some(Y), Some(Z), None, None, Some(limit)]);
    // On the axis of C nothing else moves.
    same(written.time(&machine).unwrap().moves, SCurve::new(1.1, limit).duration());
}

/// A square of 40 mm, from corner to corner.
fn square(blend: Blend) -> ProgramTime {
    let mut written = Written::at_feed(blend);
    for point in [[40.0, 0.0], [40.0, 40.0], [0.0, 40.0], [0.0, 0.0]] {
        written.to([point[0], point[1], 0.0]);
    }
    written.time(&machine()).unwrap()
}

#[test]
fn exact_stops_stop_in_every_corner_and_a_tolerance_is_never_slower() {
    let stops = square(Blend::Stop);
    let sides = [straight([40.0, 0.0, 0.0], FEED), straight([0.0, 40.0, 0.0], FEED)];
    same(stops.moves, 2.0 * (sides[0] + sides[1]));
    same(stops.segments.iter().sum(), stops.moves);
    assert_eq!((stops.smoothing.stops, stops.smoothing.smoothed, stops.smoothing.most_off()), (3, 0, 0.0));
    for path in [0.0, 1e-4, 1e-3, 0.01, 0.05, 0.2, 1.0, 5.0] {
        let within = square(Blend::within(path));
        assert!(within.moves <= stops.moves * (1.0 + 1e-3), "{path}: {} {}", within.moves, stops.moves);
        assert!(within.moves >= within.without_jerk, "{path}: {within:?}");
        assert!(within.smoothing.most_off() <= path, "{path}: {within:?}");
        assert_eq!(within.smoothing.stops + within.smoothing.smoothed, 3, "{path}: {within:?}");
        assert_eq!(within.refused, 0, "{path}: {within:?}");
    }
    let wide = square(Blend::within(5.0));
    assert!(wide.moves < 0.95 * stops.moves, "{} {}", wide.moves, stops.moves);
}

#[test]
fn straight_on_an_exact_stop_stops_and_an_exact_path_goes_on() {
    let ahead = |blend: Blend| {
        let mut written = Written::at_feed(blend);
        written.to([30.0, 0.0, 0.0]);
        written.to([70.0, 0.0, 0.0]);
        written.time(&machine()).unwrap()
    };
    let (stops, goes_on) = (ahead(Blend::Stop), ahead(Blend::Exact));
    same(stops.moves, straight([30.0, 0.0, 0.0], FEED) + straight([40.0, 0.0, 0.0], FEED));
    same(goes_on.moves, straight([70.0, 0.0, 0.0], FEED));
    assert_eq!((stops.smoothing.stops, goes_on.smoothing.stops), (1, 0));
    // A control that always stops does not ask the program.
    let mut control = machine();
    control.control.interpolator = Some(Interpolator::ExactStop);
    let mut written = Written::at_feed(Blend::Exact);
    written.to([30.0, 0.0, 0.0]);
    written.to([70.0, 0.0, 0.0]);
    same(written.time(&control).unwrap().moves, stops.moves);
    // A corner stops both.
    same(square(Blend::Exact).moves, square(Blend::Stop).moves);
}

/// A circle of 20 mm radius, of facets of 5 degrees.
pub(super) fn facets(path: f64) -> Written {
    let mut written = Written::new();
    written.to([20.0, 0.0, 0.0]);
    written.state.speed = Speed::PerMinute(FEED);
    written.state.blend = Blend::within(path);
    for i in 1..=72 {
        let (sin, cos) = (f64::from(i) / 72.0 * TAU).sin_cos();
        written.to([20.0 * cos, 20.0 * sin, 0.0]);
    }
    written
}

#[test]
fn short_lines_along_a_gentle_wave_are_run_at_their_feed() {
    const FEED: f64 = 100.0;
    let mut written = Written::new();
    written.state.speed = Speed::PerMinute(FEED);
    written.state.blend = Blend::within(0.01);
    for i in 1..=1000 {
        let x = 0.3 * f64::from(i);
        written.to([x, 2.0 * (x / 7.0).sin(), 0.0]);
    }
    let machine = machine();
    let (time, trace) = (written.time(&machine).unwrap(), written.traced(&machine));
    assert_eq!((time.smoothing.stops, time.jerk_left_out, time.refused), (0, 0, 0));
    assert!(time.smoothing.most_off() <= 0.01, "{}", time.smoothing.most_off());
    let n = time.segments.len();
    for (own, segment) in time.segments.iter().zip(&trace.segments).take(n - 200).skip(200) {
        let wanted = segment.curve.length() / FEED;
        assert!((own / wanted - 1.0).abs() < 1e-8, "{own} {wanted}");
    }
}

#[test]
fn facets_are_faster_within_a_wider_tolerance_and_stay_within_it() {
    let machine = machine();
    let [narrow, wide] = [0.005, 0.05].map(|path| {
        let time = facets(path).time(&machine).unwrap();
        assert!(time.smoothing.most_off() <= path, "{path}: {:?}", time.smoothing);
        assert_eq!(time.refused, 0, "{time:?}");
        assert!(time.moves >= time.without_jerk);
        time
    });
    assert!(wide.moves < 0.95 * narrow.moves, "{} {}", wide.moves, narrow.moves);
    // No faster than the feed.
    assert!(wide.moves > TAU * 20.0 * 0.99 / FEED, "{}", wide.moves);
}

/// A contour with arcs, corners and short lines.
pub(super) fn contour(blend: Blend) -> Written {
    let mut written = Written::at_feed(blend);
    written.to([10.0, 0.0, 0.0]);
    let arc = Arc::new(DVec3::new(10.0, 0.0, 0.0), DVec3::new(10.0, 8.0, 0.0), DVec3::Z, 2.0, 0.0).unwrap();
    written.program.push_move(Move::along(&arc.into()), &written.state, Origin::default());
    let end = arc.point(1.0);
    written.to([end.x - 12.0, end.y + 3.0, 1.0]);
    written.to([end.x - 12.5, end.y + 4.0, 1.0]);
    written.to([end.x - 13.5, end.y + 4.2, 0.5]);
    written.to([0.0, 0.0, 0.0]);
    written
}

#[test]
fn half_the_acceleration_and_jerk_never_make_a_program_faster() {
    let within = |path| Blend::within(path);
    let programs = [
        ("facets, 0.005", facets(0.005)),
        ("facets, 0.05", facets(0.05)),
        ("contour, stops", contour(Blend::Stop)),
        ("contour, exact path", contour(Blend::Exact)),
        ("contour, usual", contour(Blend::Continuous)),
        ("contour, 0.02", contour(within(0.02))),
        ("contour, 0.2", contour(within(0.2))),
    ];
    for (name, written) in programs {
        let mut before = 0.0;
        for halvings in 0..6 {
            let factor = 0.5f64.powi(halvings);
            let mut machine = machine();
            let joints = machine.joints.iter_mut().map(|j| &mut j.dynamics);
            for d in joints.chain([&mut machine.dynamics]) {
                d.acceleration = d.acceleration.map(|a| a * factor);
                d.jerk = d.jerk.map(|j| j * factor);
            }
            let time = written.time(&machine).unwrap();
            assert_eq!(time.refused, 0, "{name}: {time:?}");
            assert!(time.moves >= before, "{name}: {} after {before} at {factor}", time.moves);
            assert!(time.moves >= time.without_jerk, "{name} {factor}: {time:?}");
            before = time.moves;
        }
    }
}

#[test]
fn an_acceleration_of_a_hundredth_takes_longer() {
    let fast = contour(Blend::Continuous).time(&machine()).unwrap().moves;
    let mut slow = machine();
    slow.dynamics = Dynamics { acceleration: Some(50.0), ..slow.dynamics };
    let slow = contour(Blend::Continuous).time(&slow).unwrap().moves;
    assert!(slow > 1.3 * fast, "{slow} {fast}");
}

#[test]
fn waits_count() {
    let mut written = Written::at_feed(Blend::Continuous);
    written.to([30.0, 0.0, 0.0]);
    let before = written.time(&machine()).unwrap();
    written.program.push_dwell(1.25, &written.state, Origin::default());
    written.to([60.0, 0.0, 0.0]);
    let after = written.time(&machine()).unwrap();
    same(after.dwells, 1.25);
    // The tool stands still for it.
    same(after.total(), before.total() + 1.25 + straight([30.0, 0.0, 0.0], FEED));
    same(after.total_without_jerk(), after.without_jerk + 1.25);
}

#[test]
fn a_machine_without_acceleration_has_no_law() {
    let mut written = Written::at_feed(Blend::Continuous);
    written.to([30.0, 0.0, 0.0]);
    let mut none = machine();
    none.dynamics.acceleration = None;
    assert_eq!(written.time(&none), None);
    // An axis that stands still needs none.
    let mut written = Written::at_feed(Blend::Continuous);
    written.to([0.0, 30.0, 0.0]);
    same(written.time(&none).unwrap().moves, straight([0.0, 30.0, 0.0], FEED));
    // Jerk that is not given is not limited.
    let mut free = machine();
    free.joints.iter_mut().for_each(|j| j.dynamics.jerk = None);
    free.dynamics.jerk = None;
    let time = written.time(&free).unwrap();
    let limit = AxisLimit { velocity: FEED, jerk: f64::INFINITY, ..Y };
    same(time.moves, SCurve::new(30.0, limit).duration());
    same(time.without_jerk, time.moves);
    let curved = contour(Blend::Continuous).time(&free).unwrap();
    same(curved.moves, curved.without_jerk);
}

#[test]
fn tool_changes_and_spindle_ramps_count_where_the_machine_says_them() {
    let mut written = Written::new();
    written.state.speed = Speed::PerMinute(FEED);
    written.state.spindle = Spindle::Clockwise(600.0);
    written.to([30.0, 0.0, 0.0]);
    written.state.spindle = Spindle::CounterClockwise(200.0);
    written.to([30.0, 20.0, 0.0]);
    written.state.spindle = Spindle::Off;
    written.program.push_tool(ToolNumber(2), Some(2), None, &written.state, Origin::default());
    let silent = written.time(&machine()).unwrap();
    let two = Changes { count: 2, time: None };
    assert_eq!((silent.tool_changes, silent.spindle_changes), (two, two));
    let mut machine = machine();
    machine.control.tool_change = Some(4.5);
    machine.control.spindle_ramp = Some(3.0);
    machine.control.max_speed = Some(1200.0);
    let time = written.time(&machine).unwrap();
    assert_eq!(time.tool_changes, Changes { count: 2, time: Some(9.0) });
    // From rest to 600 one way round, and from there to 200 the other way round.
    assert_eq!(time.spindle_changes.count, 2);
    same(time.spindle_changes.time.unwrap(), 3.0 * (600.0 + 800.0) / 1200.0);
    same(time.total(), silent.total() + 9.0 + 3.5);
}

#[test]
fn an_even_circle_takes_its_way_over_its_feed_and_two_ramps() {
    // Twenty turns of R 20 at 60 mm/s: nothing but the ends has to be solved.
    let mut written = Written::at_feed(Blend::Continuous);
    for _ in 0..20 {
        let path = Path::Arc { centre: DVec3::new(20.0, 0.0, 0.0), axis: DVec3::Z, sweep: TAU, rise: 0.0 };
        let end = Target::Tip { point: DVec3::ZERO, axis: ToolAxis::Fixed };
        written.program.push_move(Move { end, path }, &written.state, Origin::default());
    }
    let time = written.time(&machine()).unwrap();
    let way = 20.0 * TAU * 20.0;
    // A ramp loses half its time; on the circle the slower axis Y is the one across at the start.
    let least = way / FEED;
    let lost = time.moves - least;
    let ramp = |limit: AxisLimit| {
        let long = AxisLimit { velocity: FEED, ..limit };
        SCurve::new(1000.0, long).duration() - 1000.0 / FEED
    };
    assert!(
        lost > 0.99 * ramp(X).min(ramp(Y)) && lost < 1.1 * ramp(X).max(ramp(Y)),
        "{lost} {} {}",
        ramp(X),
        ramp(Y)
    );
    // All turns but the first and the last take the same, to the last digits.
    let turns = &time.segments[time.segments.len() - 19..time.segments.len() - 1];
    assert!(turns.iter().all(|t| (t - TAU * 20.0 / FEED).abs() < 1e-9), "{turns:?}");
}

#[test]
fn junction_deviation_passes_a_corner_at_the_speed_of_its_rule() {
    let mut machine = machine();
    for joint in &mut machine.joints {
        joint.dynamics = dynamics(X);
    }
    machine.control.interpolator = Some(Interpolator::JunctionDeviation);
    machine.control.junction_deviation = Some(0.02);
    let mut written = Written::at_feed(Blend::Continuous);
    written.to([100.0, 0.0, 0.0]);
    written.to([100.0, 100.0, 0.0]);
    let time = written.time(&machine).unwrap();
    let (a, v) = (X.acceleration, FEED);
    let sine = 0.5_f64.sqrt();
    let corner = (a * 0.02 * sine / (1.0 - sine)).sqrt();
    // Ramps from rest and to rest, and two that end at the corner's speed; each loses (v - u)^2 / (2 a v).
    let lost = 2.0 * v * v / (2.0 * a * v) + 2.0 * (v - corner).powi(2) / (2.0 * a * v);
    same(time.moves, 200.0 / v + lost);
    // A joint at which the way goes straight on is none.
    let mut straight = Written::at_feed(Blend::Continuous);
    straight.to([60.0, 0.0, 0.0]);
    straight.to([100.0, 0.0, 0.0]);
    same(straight.time(&machine).unwrap().moves, 100.0 / v + v / a);
}

#[test]
fn an_interpolator_stops_or_forgets_jerk_as_it_says() {
    let mut machine = machine();
    let mut written = Written::at_feed(Blend::Continuous);
    written.to([30.0, 0.0, 0.0]);
    written.to([60.0, 2.0, 0.0]);
    written.to([90.0, 0.0, 0.0]);
    let usual = written.time(&machine).unwrap();
    machine.control.interpolator = Some(Interpolator::ExactStop);
    let stops = written.time(&machine).unwrap();
    assert_eq!((stops.smoothing.stops, usual.smoothing.stops), (2, 0));
    let legs = [[30.0, 0.0, 0.0], [30.0, 2.0, 0.0], [30.0, -2.0, 0.0]];
    same(stops.moves, legs.iter().map(|way| straight(*way, FEED)).sum());
    machine.control.interpolator = Some(Interpolator::Trapezoid);
    let trapezoid = written.time(&machine).unwrap();
    assert!(trapezoid.moves < usual.moves && usual.moves < stops.moves);
    // Nearly the trapezoid of a straight way of this length.
    let way = 30.0 + 2.0 * (904.0_f64).sqrt();
    let whole = way / FEED + FEED / X.acceleration;
    assert!(trapezoid.moves > 0.999 * whole && trapezoid.moves < 1.02 * whole, "{} {whole}", trapezoid.moves);
}

#[test]
fn a_sheet_says_under_which_terms_its_time_holds_and_where_the_feed_is_not_held() {
    let text =
        b"G21 G90 G94 G54\nT1 M6\nG43\nM3 S1000\nG0 X0 Y0 Z5\nG1 Z-1 F600\nG64 P0.01\nX300\nX301\nY1\nM2\n";
    let program = GivenFile { name: "slot.ngc", bytes: text };
    let sheet = |machine: Option<Machine>| {
        let wants = ProgramWants { machine, ..ProgramWants::default() };
        program_sheet(&given_alone(program, &wants, false).unwrap()).unwrap()
    };
    let programmed = sheet(None);
    assert!(programmed.time_terms.starts_with("at programmed feeds"), "{}", programmed.time_terms);
    assert_eq!((programmed.time_without_jerk_limit, &programmed.feed_held), (None, &None));
    let law = sheet(Some(machine()));
    assert!(law.time > programmed.time && law.time_without_jerk_limit.is_some_and(|t| t < law.time));
    assert!(law.time_terms.contains(" if jerk had no limit"), "{}", law.time_terms);
    assert!(law.time_terms.ends_with("not counted: 1 tool change, 1 spindle ramp"), "{}", law.time_terms);
    // The long move holds its feed, the short ones beside the corner do not.
    let held = law.feed_held.unwrap();
    assert!(held.starts_with("held on 9") && held.contains("in line "), "{held}");
    let mut slow = machine();
    slow.control.tool_change = Some(4.0);
    slow.control.max_speed = Some(1000.0 * TAU / 60.0);
    slow.control.spindle_ramp = Some(1.5);
    let counted = sheet(Some(slow));
    same(counted.time, law.time + 5.5);
    assert!(!counted.time_terms.contains("not counted"), "{}", counted.time_terms);
}

#[test]
fn a_control_of_which_nothing_is_said_smooths_within_a_hundredth() {
    let mut written = Written::at_feed(Blend::Continuous);
    written.to([30.0, 0.0, 0.0]);
    written.to([60.0, 12.0, 0.0]);
    let time = written.time(&machine()).unwrap();
    assert_eq!((time.smoothing.smoothed, time.smoothing.stops), (1, 0));
    let farthest = time.smoothing.most_off();
    assert!(farthest > 0.009 && farthest <= 0.0102, "{farthest}");
}

#[test]
fn a_step_of_curvature_leaves_the_path_beside_the_joint_and_not_at_it() {
    // A line and an arc of 1 mm that goes on from it: the axes step in their second derivative alone.
    let mut written = Written::at_feed(Blend::within(1e-4));
    written.to([30.0, 0.0, 0.0]);
    let path = Path::Arc { centre: DVec3::new(30.0, 1.0, 0.0), axis: DVec3::Z, sweep: TAU / 2.0, rise: 0.0 };
    let end = Target::Tip { point: DVec3::new(30.0, 2.0, 0.0), axis: ToolAxis::Fixed };
    written.program.push_move(Move { end, path }, &written.state, Origin::default());
    let time = written.time(&machine()).unwrap();
    assert_eq!((time.smoothing.smoothed, time.smoothing.stops), (1, 0));
    let farthest = time.smoothing.most_off();
    assert!((farthest - 1e-4).abs() < 1e-8, "{farthest}");
}

#[test]
fn a_run_that_starts_along_a_slow_axis_is_as_slow_as_that_axis_however_long_it_goes_on() {
    let mut machine = machine();
    let (place, _) = machine.joint('Y').unwrap();
    machine.joints[place].dynamics = dynamics(AxisLimit { acceleration: 10.0, ..Y });
    // 20 mm along Y, a quarter of R 400, and a way along X.
    let moves = |way: f64| {
        let mut written = Written::at_feed(Blend::Continuous);
        written.to([0.0, 20.0, 0.0]);
        let arc =
            Path::Arc { centre: DVec3::new(400.0, 20.0, 0.0), axis: -DVec3::Z, sweep: TAU / 4.0, rise: 0.0 };
        let end = Target::Tip { point: DVec3::new(400.0, 420.0, 0.0), axis: ToolAxis::Fixed };
        written.program.push_move(Move { end, path: arc }, &written.state, Origin::default());
        written.to([400.0 + way, 420.0, 0.0]);
        written.time(&machine).unwrap().moves
    };
    let [short, long] = [moves(3e3), moves(3e5)];
    // The long one is solved as a whole, on longer cells: a hundredth of a second.
    assert!((long - short - 297e3 / FEED).abs() < 0.02, "{short} {long}");
    // 2.940 s are lost where jerk has no limit, by steps of a micrometre: a little less than on a straight way, 60 mm/s over
    // twice 10 mm/s^2, because Y has less and less to do.
    let lost = short - (20.0 + 100.0 * TAU + 3e3) / FEED;
    assert!(lost > 2.940 && lost < 3.0, "{lost}");
}

#[test]
fn an_axis_that_is_free_at_the_start_turns_first_and_its_turn_counts() {
    let slow = AxisLimit { velocity: 0.2, acceleration: 1.0, jerk: 10.0 };
    let mut machine = machine_of("641203");
    for letter in ['A', 'C'] {
        let (place, _) = machine.joint(letter).unwrap();
        machine.joints[place].dynamics = dynamics(slow);
    }
    let mut written = Written::new();
    written.state.tcp = Tcp::Vector;
    written.state.speed = Speed::PerMinute(FEED);
    // The tool leaves the direction of C across A: C turns by a right angle before A can lean it.
    written.turned_to([40.0, 0.0, 0.0], ToolAxis::Vector(DVec3::new(0.3, 0.0, 0.9)));
    let time = written.time(&machine).unwrap();
    same(time.swings, SCurve::new(TAU / 4.0, slow).duration());
    assert!(time.moves > time.swings + 40.0 / FEED, "{time:?}");
    // Within the plane of A nothing has to turn first.
    let mut within = Written::new();
    within.state.tcp = Tcp::Vector;
    within.state.speed = Speed::PerMinute(FEED);
    within.turned_to([40.0, 0.0, 0.0], ToolAxis::Vector(DVec3::new(0.0, 0.3, 0.9)));
    assert_eq!(within.time(&machine).unwrap().swings, 0.0);
}

#[test]
fn axes_of_which_some_have_a_jerk_limit_and_others_none_are_told() {
    let mut machine = machine();
    machine.dynamics.jerk = None;
    for joint in &mut machine.joints {
        if joint.letter == 'X' {
            joint.dynamics.jerk = None;
        }
    }
    let time = facets(0.05).time(&machine).unwrap();
    assert!(time.limits_jerk && time.jerk_left_out > 0, "{}", time.jerk_left_out);
    assert_eq!(facets(0.05).time(&self::machine()).unwrap().jerk_left_out, 0);
    // A lone straight move along X is the trapezoid, as with a control that does not limit jerk.
    let mut written = Written::at_feed(Blend::Stop);
    written.to([100.0, 0.0, 0.0]);
    same(written.time(&machine).unwrap().moves, 100.0 / FEED + FEED / X.acceleration);
    let mut control = self::machine();
    control.control.interpolator = Some(Interpolator::Trapezoid);
    same(written.time(&control).unwrap().moves, 100.0 / FEED + FEED / X.acceleration);
}

#[test]
fn a_sheet_names_the_axes_whose_limits_are_missing() {
    let text = b"G21 G90 G94 G54\nT1 M6\nG43\nG0 X0 Y0 Z5\nG1 X30 F600\nM2\n";
    let program = GivenFile { name: "slot.ngc", bytes: text };
    let mut machine = machine();
    machine.dynamics.acceleration = None;
    for joint in &mut machine.joints {
        if joint.letter != 'Z' {
            joint.dynamics.acceleration = None;
        }
    }
    let wants = ProgramWants { machine: Some(machine), ..ProgramWants::default() };
    let sheet = program_sheet(&given_alone(program, &wants, false).unwrap()).unwrap();
    let expected =
        "at programmed feeds, rapids at full speed; axes X, Y have no rapid speed or no acceleration";
    assert_eq!((sheet.time_terms.as_str(), sheet.time_without_jerk_limit), (expected, None));
}
