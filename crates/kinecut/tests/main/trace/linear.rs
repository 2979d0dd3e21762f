//! The trace against what it must be: derivatives against differences, positions against hand values.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3};
use kinecut::base::Code;
use kinecut::geom::{Arc, Curve, InvoluteRecord, Line, Rigid};
use kinecut::machine::{CoordinateCode, Dynamics, Machine};
use kinecut::program::{
    Cycle, Frame, Move, Origin, Program, Setup, SetupId, Speed, Spindle, State, Target, WorkOffset,
};
use kinecut::tool::{Tool, ToolNumber};
use kinecut::trace::{CompStart, TraceOptions, trace, travel_findings};

use crate::common::end_mill::end_mill;

fn tool() -> Tool {
    end_mill(1, 100.0)
}

fn machine() -> Machine {
    let code = CoordinateCode::parse("2103").unwrap();
    let travel = [Some([-200.0, 200.0]), Some([-150.0, 150.0]), Some([-400.0, 0.0])];
    Machine::new(code, travel, Dynamics { rapid: Some(500.0), ..Dynamics::default() }).unwrap()
}

/// Work zero at machine (10, 20, -300); the part turned about Z by 90 degrees.
fn setup(located: bool) -> Setup {
    let work = Rigid::from_translation(if located { DVec3::new(10.0, 20.0, -300.0) } else { DVec3::ZERO });
    let turn =
        Rigid { rotation: DMat3::from_rotation_z(std::f64::consts::FRAC_PI_2), translation: DVec3::ZERO };
    Setup {
        name: "setup 1".into(),
        part_on_table: work.after(&turn),
        work_offsets: BTreeMap::from([(WorkOffset::G54, work)]),
        located,
        stock: None,
        fixtures: Vec::new(),
    }
}

fn program(located: bool, curves: &[Curve]) -> Program {
    let mut program = Program::new(vec![setup(located)]);
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    program.push_tool(ToolNumber(1), Some(1), None, &state, Origin::default());
    let retract = Move {
        end: Target::Joints([None, None, Some(0.0), None, None, None]),
        path: kinecut::program::Path::Line,
    };
    program.push_move(retract, &state, Origin::default());
    let start = curves[0].start();
    let over = Line { start, end: DVec3::new(start.x, start.y, f64::NAN) };
    program.push_move(Move::along(&over.into()), &state, Origin::default());
    program.push_move(Move::along(&Line { start, end: start }.into()), &state, Origin::default());
    state.speed = Speed::PerMinute(10.0);
    state.spindle = Spindle::Clockwise(100.0);
    for curve in curves {
        program.push_move(Move::along(curve), &state, Origin::default());
    }
    program
}

fn options<'a>(machine: &'a Machine, tools: &'a [Tool]) -> TraceOptions<'a> {
    TraceOptions {
        chord: 1e-3,
        machine: Some(machine),
        tools,
        retract_height: 250.0,
        operator: kinecut::trace::RegisterState::default(),
        radii: &[],
        comp_start: CompStart::AtNext,
    }
}

#[test]
fn derivatives_of_axes_are_exact_on_every_kind_of_curve() {
    let record = InvoluteRecord::new(100.0, [0.0, 0.0], 0.3, 10.0, 20.0).unwrap();
    let end = record.end().extend(-2.0);
    let helix = Arc::new(end, end + DVec3::X * 15.0, DVec3::Z, -7.0, 3.0).unwrap();
    let curves = [
        Curve::involute(record, 0.0, -2.0),
        Curve::from(helix),
        Line { start: helix.point(1.0), end: DVec3::new(1.0, 2.0, 3.0) }.into(),
    ];
    let (machine, tools) = (machine(), [tool()]);
    let trace = trace(&program(true, &curves), &options(&machine, &tools)).unwrap();
    let cuts: Vec<_> = trace.segments.iter().filter(|s| s.spindle_on).collect();
    assert_eq!(cuts.len(), 3);
    for segment in cuts {
        let h = 1e-3;
        for i in 1..20 {
            let s = segment.curve.length() * f64::from(i) / 20.0;
            let q = |k: f64| segment.axes(s + k * h);
            let (a, b, c, d, m) = (q(-2.0), q(-1.0), q(1.0), q(2.0), segment.axes(s));
            for axis in 0..3 {
                let d1 = (a[axis].q - 8.0 * b[axis].q + 8.0 * c[axis].q - d[axis].q) / (12.0 * h);
                assert!((d1 - m[axis].d1).abs() < 1e-9, "first derivative {d1} {}", m[axis].d1);
                let d2 = (a[axis].d1 - 8.0 * b[axis].d1 + 8.0 * c[axis].d1 - d[axis].d1) / (12.0 * h);
                assert!((d2 - m[axis].d2).abs() < 1e-9, "second derivative {d2} {}", m[axis].d2);
                let d3 = (a[axis].d2 - 8.0 * b[axis].d2 + 8.0 * c[axis].d2 - d[axis].d2) / (12.0 * h);
                assert!((d3 - m[axis].d3).abs() < 1e-9, "third derivative {d3} {}", m[axis].d3);
            }
            let speed: f64 = m.iter().map(|j| j.d1 * j.d1).sum();
            assert!((speed - 1.0).abs() < 1e-12, "arc length");
        }
    }
}

#[test]
fn axis_positions_are_work_zero_plus_programmed_point_plus_tool_length() {
    let cut = Line { start: DVec3::new(1.0, 2.0, 5.0), end: DVec3::new(31.0, 2.0, 5.0) };
    let (machine, tools) = (machine(), [tool()]);
    let trace = trace(&program(true, &[cut.into()]), &options(&machine, &tools)).unwrap();
    let last = trace.segments.last().unwrap();
    let [x, y, z] = last.axes(30.0).map(|a| a.q);
    assert!(
        (x - 41.0).abs() < 1e-12 && (y - 22.0).abs() < 1e-12 && (z - (-195.0)).abs() < 1e-12,
        "{x} {y} {z}"
    );
    // In part coordinates the part's own X points along the work offset's Y.
    let tip = last.pose(0.0).tip.p;
    assert!((tip - DVec3::new(2.0, -1.0, 5.0)).length() < 1e-12, "{tip}");
    assert!((trace.duration().0 - (3.0 + (0.0 - (-195.0)) / 500.0)).abs() < 1e-9, "{:?}", trace.duration());
    assert_eq!(trace.untraced.len(), 2, "retract and first positioning start at an unknown place");
}

#[test]
fn the_first_descent_is_traced_from_the_retracted_height() {
    let cut = Line { start: DVec3::new(1.0, 2.0, 5.0), end: DVec3::new(31.0, 2.0, 5.0) };
    let (machine, tools) = (machine(), [tool()]);
    let located = trace(&program(true, &[cut.into()]), &options(&machine, &tools)).unwrap();
    // Gauge point at machine Z0, tip 100 below it, work zero at -300: 200 above the work zero.
    assert!((located.segments[0].curve.start().z - 200.0).abs() < 1e-12);
    assert!(located.assumed.is_empty());
    let free = trace(&program(false, &[cut.into()]), &options(&machine, &tools)).unwrap();
    assert!((free.segments[0].curve.start().z - 250.0).abs() < 1e-12);
    assert_eq!(free.assumed.len(), 1);
}

#[test]
fn travel_limits_are_compared_with_axis_positions() {
    let far = Line { start: DVec3::new(0.0, 0.0, 5.0), end: DVec3::new(195.0, 0.0, 5.0) };
    let (machine, tools) = (machine(), [tool()]);
    let program = program(true, &[far.into()]);
    let found = travel_findings(&trace(&program, &options(&machine, &tools)).unwrap(), &program, &machine);
    assert_eq!(found.len(), 1);
    assert_eq!(
        (found[0].value.as_ref().unwrap().value, found[0].bound.as_ref().unwrap().value),
        (205.0, 200.0)
    );
}

#[test]
fn a_feed_move_from_an_unknown_position_is_noted() {
    let mut program = Program::new(vec![setup(true)]);
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    state.speed = Speed::PerMinute(10.0);
    let cut = Line { start: DVec3::ZERO, end: DVec3::X };
    program.push_move(Move::along(&cut.into()), &state, Origin::default());
    let (machine, tools) = (machine(), [tool()]);
    let trace = trace(&program, &options(&machine, &tools)).unwrap();
    assert!(trace.segments.is_empty() && trace.untraced.len() == 1 && trace.untraced[0].feed);
}

#[test]
fn a_program_without_the_setup_of_an_item_is_refused() {
    let (machine, tools) = (machine(), [tool()]);
    let mut program = program(true, &[Line { start: DVec3::Z, end: DVec3::X }.into()]);
    program.setups.clear();
    let error = trace(&program, &options(&machine, &tools)).unwrap_err();
    assert_eq!((error.code(), error.0.item), (Code::NC_STATE, Some(0)));
    assert!(error.0.message.contains("setup 0, and the program has 0"), "{}", error.0.message);
}

#[test]
fn a_cycle_is_expanded_at_the_present_position() {
    let mut program = program(true, &[Line { start: DVec3::Z * 20.0, end: DVec3::Z * 10.0 }.into()]);
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    state.speed = Speed::PerMinute(2.0);
    let cycle = Cycle::Peck { reference: 2.0, bottom: -10.0, retract: 10.0, step: 7.0, clearance: 0.5 };
    program.push_cycle(cycle, &state, Origin::default()).unwrap();
    let (machine, tools) = (machine(), [tool()]);
    let before = 2;
    let heights: Vec<f64> = trace(&program, &options(&machine, &tools)).unwrap().segments[before..]
        .iter()
        .map(|s| s.curve.end().z)
        .collect();
    assert_eq!(heights, [2.0, -5.0, 2.0, -4.5, -10.0, 10.0]);
}
