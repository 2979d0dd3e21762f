//! A bore that is set at the machine: planned, posted, read back and followed with values in the wear register.
//!
//! The LinuxCNC text is the one that its interpreter (`rs274` 2.9) was run on; what it printed stands below.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use kinecut::base::{Code, Sources};
use kinecut::geom::{ContactOrder, Curve, CurveKind, Line, Rigid, joint};
use kinecut::holes::{
    BorePlan, BoreSpec, CutterData, Entry, Finish, LeadEnd, PlannedMove, Rough, Sense, ToolpathPace,
    ToolpathRole, Wear, plan_bore,
};
use kinecut::nc::{self, Control, PostSettings, Reading};
use kinecut::program::{
    Comp, Frame, Item, Move, Origin, Program, Setup, SetupId, Speed, Spindle, State, WorkOffset,
};
use kinecut::tool::{Cutter, Tool, ToolNumber};
use kinecut::trace::{Segment, SegmentPace, TraceOptions, trace};
use proptest::prelude::*;

/// Radius of the cutter's path at the wall of the bore below [mm].
const PATH_RADIUS: f64 = 80.0;

fn spec(sense: Sense, wear: Option<Wear>) -> BoreSpec {
    let cutter =
        CutterData { diameter: 40.0, centre_cutting: true, max_ramp_angle: None, flute_length: 45.0 };
    BoreSpec {
        centre: [10.0, -5.0],
        sense,
        entry: Some(Entry::Plunge),
        rough: Some(Rough { allowance: 1.0, plunge_feed: Some(5.0), ..Rough::new(20.0, 100.0) }),
        finish: Some(Finish { start: LeadEnd::Point([-40.0, 40.0]), wear, ..Finish::new(50.0) }),
        retract_z: 50.0,
        approach_z: 2.0,
        resolution: None,
        ..BoreSpec::new(200.0, 10.0, cutter)
    }
}

fn tool() -> Tool {
    Tool {
        number: ToolNumber(1),
        name: "end mill".into(),
        cutter: Cutter::EndMill { diameter: 40.0 },
        teeth: 4,
        spacing: Default::default(),
        flute_length: 45.0,
        stickout: 60.0,
        shank_diameter: 40.0,
        holder: None,
        centre_cutting: true,
        max_ramp_angle: None,
        gauge_length: None,
        limits: Default::default(),
        elasticity: None,
    }
}

fn setup() -> Setup {
    Setup {
        name: "setup".into(),
        part_on_table: Rigid::IDENTITY,
        work_offsets: BTreeMap::from([(WorkOffset::G54, Rigid::IDENTITY)]),
        located: false,
        stock: None,
        fixtures: Vec::new(),
    }
}

/// The finishing moves as a program: tool, over the start, down, along.
fn program(moves: &[PlannedMove], control: Control, sense: Sense) -> Program {
    let mut program = Program::new(vec![setup()]);
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    let register = control.wear_register(ToolNumber(1));
    let edge = if control == Control::Sinumerik840d { register } else { 1 };
    program.push_tool(ToolNumber(1), Some(edge), Some(edge), &state, Origin::default());
    state.spindle = Spindle::Clockwise(100.0);
    let at = moves[0].curve.start();
    for z in [f64::NAN, at.z] {
        let end = DVec3::new(at.x, at.y, z);
        program.push_move(Move::along(&Line { start: at, end }.into()), &state, Origin::default());
    }
    for m in moves {
        state.speed = match m.pace {
            ToolpathPace::Rapid => Speed::Rapid { linear: true },
            ToolpathPace::Feed(feed) => Speed::PerMinute(feed),
        };
        state.comp = match (m.comp, sense) {
            (false, _) => Comp::Off,
            (true, Sense::Climb) => Comp::Left(register),
            (true, Sense::Conventional) => Comp::Right(register),
        };
        program.push_move(Move::along(&m.curve), &state, Origin::default());
    }
    program
}

fn finishing(plan: &BorePlan) -> Vec<PlannedMove> {
    plan.moves
        .iter()
        .filter(|m| m.finishing && m.role != ToolpathRole::Link && m.role != ToolpathRole::Retract)
        .cloned()
        .collect()
}

fn planned(control: Control, sense: Sense) -> Program {
    let wear = Wear { register: control.wear_register(ToolNumber(1)), largest: 0.2 };
    program(&finishing(&plan_bore(&spec(sense, Some(wear))).unwrap()), control, sense)
}

fn post(program: &Program, control: Control) -> String {
    let settings = PostSettings { arc_tolerance: 0.01, ..PostSettings::new(control) };
    nc::write(program, &[tool()], &settings).unwrap().text.to_string()
}

fn read(text: &str, control: Control) -> Reading {
    nc::read(&mut Sources::default(), "bore.nc", text, control, &[setup()]).unwrap()
}

fn follow(program: &Program, control: Control, value: f64) -> kinecut::base::Result<Vec<Segment>> {
    let tools = [tool()];
    let radii = [(control.wear_register(ToolNumber(1)), control.compensation_radius(value))];
    let options = TraceOptions {
        chord: 1e-3,
        machine: None,
        tools: &tools,
        retract_height: 100.0,
        operator: kinecut::trace::RegisterState::default(),
        radii: &radii,
        comp_start: control.comp_start(),
    };
    Ok(trace(program, &options)?.segments)
}

fn feeds(segments: &[Segment]) -> Vec<Curve> {
    segments.iter().filter(|s| matches!(s.motion, SegmentPace::Feed(_))).map(|s| s.curve.clone()).collect()
}

#[test]
fn the_register_sets_the_bore_and_the_joints_stay_as_planned() {
    for sense in [Sense::Climb, Sense::Conventional] {
        let control = Control::Sinumerik840d;
        let program = planned(control, sense);
        let as_planned = feeds(&follow(&program, control, 0.0).unwrap());
        for value in [0.0, 0.01, -0.01, 0.2, -0.2] {
            let path = feeds(&follow(&program, control, value).unwrap());
            assert_eq!(path.len(), as_planned.len());
            let circles: Vec<_> = path
                .iter()
                .filter_map(|c| if let CurveKind::Arc(arc) = c.kind() { Some(arc) } else { None })
                .collect();
            assert!(!circles.is_empty());
            for arc in circles {
                assert!((arc.radius() - (PATH_RADIUS - value)).abs() < 1e-10);
                assert!((arc.centre.truncate() - DVec2::new(10.0, -5.0)).length() < 1e-10);
            }
            // Down, on, lead-in, circle, lead-out, off: only the switching lines turn, by value/length.
            let inner = &path[2..path.len() - 1];
            for w in inner.windows(2) {
                assert!(joint(&w[0], &w[1]).contact >= ContactOrder::G2, "{:?}", joint(&w[0], &w[1]));
            }
            let on = joint(&path[1], &path[2]);
            assert!(on.gap < 1e-9 && (on.angle - (value.abs() / 1.4).atan()).abs() < 1e-9, "{on:?}");
            // The ends are programmed places, whatever the register holds.
            assert_eq!(path[0].start(), as_planned[0].start());
            assert!(path[path.len() - 1].end().distance(as_planned[path.len() - 1].end()) < 1e-12);
        }
    }
}

#[test]
fn written_and_read_the_compensation_is_the_same() {
    for control in [Control::Sinumerik840d, Control::LinuxCnc] {
        for (sense, word) in [(Sense::Climb, "G41"), (Sense::Conventional, "G42")] {
            let program = planned(control, sense);
            let text = post(&program, control);
            let words =
                if control == Control::LinuxCnc { format!("{word} D101 X") } else { format!("{word} X") };
            assert!(text.contains(&words), "{text}");
            assert!(
                text.lines().any(|l| l.contains("G40 ") && l.contains('X') && !l.contains("G17")),
                "{text}"
            );
            let reading = read(&text, control);
            let comp = |p: &Program| {
                let mut found: Vec<Comp> = Vec::new();
                for i in (0..p.items.len()).filter(|i| matches!(p.items.get(*i), Item::Move(_))) {
                    if found.last() != Some(&p.state(i).comp) {
                        found.push(p.state(i).comp);
                    }
                }
                found
            };
            assert_eq!(comp(&reading.program), comp(&program));
            assert_eq!(comp(&program).len(), 3);
            // Written again it is the same text.
            assert_eq!(post(&reading.program, control).lines().last(), text.lines().last());
            for value in [0.0, 0.02, -0.2] {
                let path = feeds(&follow(&reading.program, control, value).unwrap());
                let wanted = PATH_RADIUS - control.compensation_radius(value);
                let circle: f64 = path
                    .iter()
                    .filter_map(|c| match c.kind() {
                        CurveKind::Arc(arc) if (arc.radius() - PATH_RADIUS).abs() < 0.5 => Some(arc),
                        _ => None,
                    })
                    .filter(|arc| arc.sweep.abs() > 1.5)
                    .map(|arc| {
                        assert!((arc.radius() - wanted).abs() < 2e-3, "{} {wanted}", arc.radius());
                        arc.sweep.abs()
                    })
                    .sum();
                assert!((circle - TAU).abs() < 0.3 || circle > TAU, "{circle}");
                for w in path.windows(2) {
                    assert!(w[0].end().distance(w[1].start()) < 1e-6);
                }
            }
        }
    }
}

/// Half of the last decimal that the interpreter prints, and the joints that it leaves open by less.
const PRINTED: f64 = 1e-4;

#[test]
fn a_posted_finishing_pass_runs_as_in_the_interpreter_of_linuxcnc() {
    let control = Control::LinuxCnc;
    let reading = read(include_str!("../../golden/compensation/bore.ngc"), control);
    let golden = include_str!("../../golden/compensation/rs274.txt");
    let mut rows = golden.lines().filter(|l| !l.starts_with('#')).peekable();
    let mut passes = 0;
    while let Some(head) = rows.next() {
        let value: f64 = head.strip_prefix("D ").unwrap().parse().unwrap();
        let mut path = feeds(&follow(&reading.program, control, value).unwrap()).into_iter();
        while let Some(row) = rows.next_if(|r| !r.starts_with('D')) {
            let wanted: Vec<f64> = row.split(' ').map(|w| w.parse().unwrap()).collect();
            let curve = path.next().unwrap();
            let mut found = curve.end().truncate().to_array().to_vec();
            if let CurveKind::Arc(arc) = curve.kind() {
                found.extend(arc.centre.truncate().to_array());
            }
            assert_eq!(found.len(), wanted.len());
            assert!(
                found.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < PRINTED),
                "{value}: {found:?} {wanted:?}"
            );
        }
        assert!(path.next().is_none());
        passes += 1;
    }
    assert_eq!(passes, 3);
}

/// Whatever the planner accepts, each control follows with any value that the register may carry (`share` of `largest`
/// mm), and the cutter goes down, and its compensation is switched, in what roughing has opened.
fn can_be_run(spec: &BoreSpec, control: Control, share: f64) {
    let (wear, rough) = (spec.finish.unwrap().wear.unwrap(), spec.rough.unwrap());
    let plan = match plan_bore(spec) {
        Ok(plan) => plan,
        Err(e) => {
            assert!(e.code() == Code::START_OUTSIDE || e.code() == Code::PLAN_VALUE, "{e}");
            assert_eq!(e.0.key.as_deref(), Some("finish.wear_largest"));
            return;
        }
    };
    let moves = finishing(&plan);
    let first = moves.iter().position(|m| m.comp).unwrap();
    let last = moves.iter().rposition(|m| m.comp).unwrap();
    let centre = DVec3::new(10.0, -5.0, -10.0);
    let room = 0.5 * (spec.diameter - spec.cutter.diameter);
    let open = room - rough.allowance + 1e-9;
    assert!((moves[first].curve.start() - centre).length() <= open);
    assert!((moves[last + 1].curve.end() - centre).length() <= open);
    let value = share * wear.largest;
    let register = if control == Control::Sinumerik840d { value } else { 2.0 * value };
    let program = program(&moves, control, spec.sense);
    for p in [&program, &read(&post(&program, control), control).program] {
        let path = feeds(&follow(p, control, register).unwrap());
        // Path radius at the wall: as the register says.
        let most = path.iter().fold(0.0, |most: f64, c| {
            let mid = (c.at(0.5 * c.length()).p - centre).truncate().length();
            if mid > most { mid } else { most }
        });
        assert!((most - (room - value)).abs() < 2e-3, "{most} {room} {value}");
        for w in path.windows(2) {
            assert!(w[0].end().distance(w[1].start()) < 1e-6);
        }
    }
}

/// The bore of a cutter of `diameter` whose path has the radius `room` at the wall, in two passes, for a control that
/// has the involute itself or one that has not.
fn roomy(
    diameter: f64,
    room: f64,
    turns: u32,
    [allowance, largest]: [f64; 2],
    climb: bool,
    native: bool,
) -> (BoreSpec, Control) {
    let sense = if climb { Sense::Climb } else { Sense::Conventional };
    let control = if native { Control::Sinumerik840d } else { Control::LinuxCnc };
    let wear = Wear { register: control.wear_register(ToolNumber(1)), largest };
    let mut spec = spec(sense, Some(wear));
    spec.diameter = diameter + 2.0 * room;
    spec.cutter.diameter = diameter;
    spec.rough = spec.rough.map(|r| Rough { stepover: Some(0.4 * diameter), allowance, ..r });
    spec.finish = spec.finish.map(|f| Finish { turns, start: LeadEnd::Usual, ..f });
    spec.resolution = native.then_some(1e-4);
    (spec, control)
}

/// The lead-in was cut in two 2 um behind its start: rounded to the digits of the program, the first part turned so far
/// that the compensation had no room in it.
#[test]
fn a_lead_in_that_begins_near_the_roll_of_the_control_can_be_run() {
    let sizes = [1.0641292023866027, 0.2196605937564023];
    let (spec, control) = roomy(6.0, 9.022077809860638, 2, sizes, false, true);
    can_be_run(&spec, control, 0.9369007705366984);
}

proptest! {
    #![proptest_config(kinecut_cases::property(64))]
    #[test]
    fn an_accepted_correction_can_be_run(
        diameter in 6.0..30.0f64,
        room in 4.0..60.0f64,
        turns in 1u32..4,
        allowance in 0.2..1.5f64,
        largest in 0.01..0.4f64,
        share in -1.0..1.0f64,
        climb in any::<bool>(),
        native in any::<bool>(),
    ) {
        let (spec, control) = roomy(diameter, room, turns, [allowance, largest], climb, native);
        can_be_run(&spec, control, share);
    }
}

#[test]
fn a_missing_register_is_named() {
    let program = planned(Control::LinuxCnc, Sense::Climb);
    let tools = [tool()];
    let options = TraceOptions {
        chord: 1e-3,
        machine: None,
        tools: &tools,
        retract_height: 100.0,
        operator: kinecut::trace::RegisterState::default(),
        radii: &[(7, 0.0)],
        comp_start: Control::LinuxCnc.comp_start(),
    };
    let error = trace(&program, &options).unwrap_err();
    assert_eq!(error.code(), Code::JOB_REFERENCE);
    assert!(error.to_string().contains("register 101"), "{error}");
}

#[test]
fn what_a_control_does_not_take_is_refused_when_read() {
    let refused = |control: Control, body: &str| {
        let text = format!("G17 G40 G90 G94\nT1 M6\nG54\nS1000 M3\nG0 X0 Y0\nG0 Z5\n{body}M30\n");
        let setups = [setup()];
        let found = nc::read(&mut Sources::default(), "a.nc", &text, control, &setups);
        found.err().map(|e| (e.code(), e.to_string()))
    };
    let comp = |control, body: &str| match refused(control, body) {
        Some((code, text)) => {
            assert!(code == Code::COMPENSATION && text.starts_with("a.nc:"), "{text}");
            true
        }
        None => false,
    };
    for control in [Control::Sinumerik840d, Control::LinuxCnc] {
        let d = if control == Control::LinuxCnc { " D2" } else { "" };
        let on = format!("G41{d} G1 X10 F100\nY10\n");
        // As it should be: switched on and off in its block, or in a block before.
        assert!(!comp(control, &format!("{on}G40 X20\n")));
        assert!(!comp(control, &format!("G41{d}\nG1 X10 F100\nG40\nX20\n")));
        // Switched on arcs, or without movement in the plane.
        // LinuxCNC enters on arcs, and never leaves on one.
        let arc = format!("G41{d} G2 X10 I5 F100\nG40 G1 X20\n");
        assert_eq!(comp(control, &arc), control != Control::LinuxCnc);
        assert!(comp(control, &format!("G41{d} G1 Z-1 F100\nX10\nG40 X20\n")));
        assert!(comp(control, &format!("{on}G40 G2 X20 I5\n")));
        assert!(comp(control, &format!("{on}G40\nZ50\nX20\n")));
        // While it is on.
        for change in ["G18 X20", "T2 M6", "G55 X20", "G91 G70 X1"] {
            if control == Control::LinuxCnc && change.contains("G70") {
                continue;
            }
            assert!(comp(control, &format!("{on}{change}\nG40 X30\n")), "{change}");
        }
        assert!(comp(control, &format!("{on}G42{d} X20\nG40 X30\n")));
    }
    assert!(comp(Control::LinuxCnc, "G41 D2 G1 X10 F100\nG53 G0 Z0\nG40 X30\n"));
    assert!(comp(Control::LinuxCnc, "G41 D2 G1 X10 F100\nG81 X20 Z-5 R1\nG40 X30\n"));
    assert!(comp(Control::LinuxCnc, "G41 D2 G1 X10 F100\nG41 D2 X20\nG40 X30\n"));
    assert!(comp(Control::LinuxCnc, "G41 D2 G1 X10 F100\nG20 X20\nG40 X30\n"));
    assert!(comp(Control::Sinumerik840d, "G41 G1 X10 F100\nG0 SUPA Z0 D0\nG40 X30\n"));
    assert!(comp(Control::Sinumerik840d, "G41 G1 X10 F100\nD2 X20\nG40 X30\n"));
    // Without a radius: no edge in force; D without G41 is no word of LinuxCNC.
    assert!(comp(Control::Sinumerik840d, "D0\nG0 Z5\nG41 G1 X10 F100\nG40 X30\n"));
    assert!(comp(Control::LinuxCnc, "G41 D0 G1 X10 F100\nG40 X30\n"));
    assert_eq!(refused(Control::LinuxCnc, "G1 X10 D2 F100\n").unwrap().0, Code::NC_WORD);
    // On LinuxCNC the tool in the spindle counts when D is not said.
    let text = "G17 G90 G94\nT7 M6\nG54\nG0 X0 Y0 Z0\nG41 G1 X10 F100\nG40 X20\nM2\n";
    let reading = read(text, Control::LinuxCnc);
    let comps: Vec<Comp> = (0..reading.program.items.len()).map(|i| reading.program.state(i).comp).collect();
    assert!(comps.contains(&Comp::Left(7)));
}

#[test]
fn what_a_control_does_not_take_is_refused_when_written() {
    let line =
        |x: f64, y: f64, z: f64| Move::along(&Line { start: DVec3::ZERO, end: DVec3::new(x, y, z) }.into());
    let write = |control: Control, moves: &[(Move, Comp)], edge: u32| {
        let mut program = Program::new(vec![setup()]);
        let frame = program.add_frame(Frame::Work(WorkOffset::G54));
        let mut state = State::start(SetupId(0), frame);
        program.push_tool(ToolNumber(1), Some(edge), Some(edge), &state, Origin::default());
        for (i, (motion, comp)) in moves.iter().enumerate() {
            state.speed = if i == 0 { Speed::Rapid { linear: true } } else { Speed::PerMinute(5.0) };
            state.comp = *comp;
            program.push_move(*motion, &state, Origin::default());
        }
        nc::write(&program, &[], &PostSettings::new(control)).map(|p| p.text)
    };
    let on = Comp::Left(2);
    let good = [
        (line(0.0, 0.0, 0.0), Comp::Off),
        (line(10.0, 0.0, 0.0), on),
        (line(20.0, 0.0, 0.0), on),
        (line(30.0, 0.0, 0.0), Comp::Off),
    ];
    let text = write(Control::LinuxCnc, &good, 1).unwrap();
    assert!(text.contains("G41 D2 G1 X10 F300\nX20\nG40 X30\n"), "{text}");
    let text = write(Control::Sinumerik840d, &good, 2).unwrap();
    assert!(text.contains("D2") && text.contains("G41 G1 X10 F300"), "{text}");
    let code = |control, moves: &[(Move, Comp)], edge| write(control, moves, edge).unwrap_err().code();
    // The edge in force is another.
    assert_eq!(code(Control::Sinumerik840d, &good, 1), Code::COMPENSATION);
    // On without movement in the plane, never off, side changed.
    let mut bad = good;
    bad[1].0 = line(0.0, 0.0, -5.0);
    assert_eq!(code(Control::LinuxCnc, &bad, 1), Code::COMPENSATION);
    assert_eq!(code(Control::LinuxCnc, &good[..3], 1), Code::COMPENSATION);
    bad = good;
    bad[2].1 = Comp::Right(2);
    assert_eq!(code(Control::LinuxCnc, &bad, 1), Code::COMPENSATION);
}

#[test]
fn an_entry_comes_later_and_may_be_an_arc_on_linuxcnc() {
    let head = "G17 G21 G40 G90 G94\nT1 M6\nG54\nS1000 M3\nG0 X0 Y0 Z5\n";
    let text =
        format!("{head}G41 D101\n(now)\nM8\nG4 P0.5\nF100\nG3 X20 Y0 I10\nG1 X20 Y20\nG40\nG1 X40 Y60\nM2\n");
    let reading = read(&text, Control::LinuxCnc);
    let again = post(&reading.program, Control::LinuxCnc);
    assert!(again.contains("G41 D101 G3 X20 Y0 I10 J0 F100\n"), "{again}");
    for program in [&reading.program, &read(&again, Control::LinuxCnc).program] {
        let mut program = program.clone();
        program.setups = vec![setup()];
        let path: Vec<Curve> = feeds(&follow(&program, Control::LinuxCnc, 4.0).unwrap());
        // As rs274 runs it: ARC_FEED(18, 0, 9, 0, 1), STRAIGHT_FEED(18, 20), STRAIGHT_FEED(40, 60).
        let CurveKind::Arc(arc) = path[0].kind() else { panic!("{path:?}") };
        assert!(arc.centre.distance(DVec3::new(9.0, 0.0, 5.0)) < 1e-9, "{arc:?}");
        let ends: Vec<DVec3> = path.iter().map(Curve::end).collect();
        let wanted = [[18.0, 0.0, 5.0], [18.0, 20.0, 5.0], [40.0, 60.0, 5.0]].map(DVec3::from_array);
        assert!(ends.len() == 3 && ends.iter().zip(wanted).all(|(a, b)| a.distance(b) < 1e-9), "{ends:?}");
    }
    // The others want a straight one, and what is wrong with a move is said.
    let settings = PostSettings::new(Control::Fanuc);
    assert_eq!(nc::write(&reading.program, &[], &settings).unwrap_err().code(), Code::COMPENSATION);
    let fault = |body: &str| {
        let text = format!("G17 G21 G40 G90 G94\nT1 M6\nG54\nS1000 M3\nG0 Z5\n{body}M2\n");
        let refused = nc::read(&mut Sources::default(), "a.nc", &text, Control::LinuxCnc, &[]).unwrap_err();
        assert_eq!(refused.code(), Code::COMPENSATION, "{refused}");
        refused.to_string()
    };
    assert!(fault("G41 D2\nG0 X0 Y0\nG1 X10 F100\n").contains("has not set X, Y"));
    assert!(fault("G0 X0 Y0\nG41 D2\nG1 Z1 F100\nX10\n").contains("does not move in the plane"));
    assert!(fault("G0 X0 Y0\nG41 D2\nG1 X10 F100\nY10\nG40\nG2 X20 I5\n").contains("is not straight"));
}
