//! Drilling cycles written: natively where the control makes the same motion, and always read as the same motion.

use std::f64::consts::TAU;

use glam::DVec3;
use kinecut::base::Sources;
use kinecut::geom::Rigid;
use kinecut::nc::{self, Control, PostSettings, Reading, Units};
use kinecut::program::{
    Between, Cycle, CycleStep, DeepHole, Frame, Item, Move, Origin, Path, Program, Setup, SetupId,
    Shortening, Speed, Spindle, State, Target, ToolAxis, ToolNumber, WorkOffset,
};
use kinecut::tool::{Cutter, Tool};
use kinecut::trace::{CompStart, SegmentPace, Trace, TraceOptions, trace};
use proptest::prelude::*;

const RAPID: Speed = Speed::Rapid { linear: true };

fn setup() -> Setup {
    Setup {
        name: "one".to_owned(),
        part_on_table: Rigid::IDENTITY,
        work_offsets: [(WorkOffset::G54, Rigid::IDENTITY)].into(),
        located: false,
        stock: None,
        fixtures: Vec::new(),
    }
}

fn drill() -> Tool {
    Tool {
        number: ToolNumber(1),
        name: "drill".to_owned(),
        cutter: Cutter::EndMill { diameter: 8.0 },
        teeth: 2,
        spacing: Default::default(),
        flute_length: 80.0,
        stickout: 90.0,
        shank_diameter: 8.0,
        holder: None,
        centre_cutting: true,
        max_ramp_angle: None,
        gauge_length: Some(170.0),
        limits: Default::default(),
        elasticity: None,
    }
}

/// A tool at 800 rev/min, 50 mm above the work.
fn start(control: Control) -> (Program, State) {
    let mut program = Program::new(vec![setup()]);
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    state.blend = control.usual_blend();
    let register = Some(control.length_register(ToolNumber(1)));
    program.push_tool(ToolNumber(1), register, register, &state, Origin::default());
    state.spindle = Spindle::Clockwise(800.0 / 60.0 * TAU);
    (program, state)
}

fn rapid(program: &mut Program, state: &State, to: [f64; 3]) {
    let end = Target::Tip { point: DVec3::from_array(to), axis: ToolAxis::Fixed };
    program.push_move(Move { end, path: Path::Line }, &State { speed: RAPID, ..*state }, Origin::default());
}

/// Holes at the places, each approached at the height where the one before left the tool.
fn holes(control: Control, speed: Speed, holes: &[([f64; 2], Cycle)]) -> Program {
    let (mut program, mut state) = start(control);
    let mut height = 50.0;
    for ([x, y], cycle) in holes {
        rapid(&mut program, &state, [*x, *y, height]);
        state.speed = speed;
        program.push_cycle(*cycle, &state, Origin::default()).unwrap();
        let Some(CycleStep::Rapid(retract)) = cycle.expansion().unwrap().last().copied() else { panic!() };
        height = retract;
    }
    rapid(&mut program, &state, [0.0, 0.0, 60.0]);
    program
}

fn post(program: &Program, control: Control) -> String {
    post_in(program, control, Units::Millimetres)
}

/// In inches with decimals that hold a thousandth of a millimetre.
fn settings(control: Control, units: Units) -> PostSettings {
    let usual = PostSettings::in_units(control, units);
    PostSettings { decimals: usual.decimals + u8::from(units.is_inch()), ..usual }
}

fn post_in(program: &Program, control: Control, units: Units) -> String {
    nc::write(program, &[], &settings(control, units)).unwrap().text.to_string()
}

fn read(text: &str, control: Control) -> Reading {
    nc::read(&mut Sources::default(), "test", text, control, &[setup()])
        .unwrap_or_else(|e| panic!("{control}: {e}\n{text}"))
}

fn traced(program: &Program) -> Trace {
    let tools = [drill()];
    let options = TraceOptions {
        chord: 1e-3,
        machine: None,
        tools: &tools,
        retract_height: 300.0,
        operator: kinecut::trace::RegisterState::default(),
        radii: &[],
        comp_start: CompStart::AtNext,
    };
    trace(program, &options).unwrap()
}

/// One move of a trace: feed [mm/s] (rapid: 0), end; a dwell has its seconds as its feed, and no end.
type Step = (f64, Option<[f64; 3]>);

/// Moves and dwells in the order of the program.
fn steps(program: &Program) -> Vec<Step> {
    let trace = traced(program);
    let mut found = Vec::new();
    let mut at = f64::NAN;
    let mut segments = trace.segments.iter().filter(|s| !s.alternative).peekable();
    let mut dwells = trace.dwells.iter().peekable();
    for item in 0..program.items.len() as u32 {
        // Within a cycle the order is that of its expansion, which the other tests look at.
        while let Some(segment) = segments.next_if(|s| s.item == item) {
            let feed = if let SegmentPace::Feed(feed) = segment.motion { feed } else { 0.0 };
            let end = segment.curve.end();
            at = end.z;
            found.push((feed, Some(end.to_array())));
        }
        while let Some((_, seconds)) = dwells.next_if(|d| d.0 == item) {
            found.push((*seconds, None));
        }
    }
    assert!(at.is_finite());
    found
}

fn time(program: &Program) -> f64 {
    let trace = traced(program);
    let moving: f64 = trace.segments.iter().filter(|s| !s.alternative).filter_map(|s| s.duration).sum();
    moving + trace.dwells.iter().map(|d| d.1).sum::<f64>()
}

/// The same moves within half a unit of the number format.
fn assert_same(wanted: &Program, found: &Program, control: Control, text: &str) {
    let half = 0.5 * control.resolution(control.usual_decimals());
    assert_same_within((half, 1e-6), (wanted, found), control, text);
}

/// The same moves within a length [mm], their feeds within a share.
fn assert_same_within(
    (half, share): (f64, f64),
    (wanted, found): (&Program, &Program),
    control: Control,
    text: &str,
) {
    // An expanded cycle has its dwells as items of their own: compare motion and dwells apart.
    let split = |program: &Program| {
        let all = steps(program);
        let moves: Vec<Step> = all.iter().copied().filter(|s| s.1.is_some()).collect();
        let dwells: Vec<f64> = all.iter().filter(|s| s.1.is_none()).map(|s| s.0).collect();
        (moves, dwells)
    };
    let (a, b) = (split(wanted), split(found));
    let half = half + 1e-9;
    // Moves shorter than the number format vanish.
    assert_eq!(a.0.len(), b.0.len(), "{control}\n{:?}\n{:?}\n{text}", a.0, b.0);
    for ((feed, end), (read_feed, read_end)) in a.0.iter().zip(&b.0) {
        assert!((feed - read_feed).abs() <= share * feed.max(1.0), "{control} {feed} {read_feed}\n{text}");
        for (x, y) in end.unwrap().iter().zip(read_end.unwrap()) {
            assert!((x - y).abs() <= half, "{control} {end:?} {read_end:?}\n{text}");
        }
    }
    assert_eq!(a.1.len(), b.1.len(), "{control}\n{text}");
    for (x, y) in a.1.iter().zip(&b.1) {
        assert!((x - y).abs() <= 0.000_51, "{control} {x} {y}\n{text}");
    }
}

fn cycles(program: &Program) -> Vec<Cycle> {
    (0..program.items.len())
        .filter_map(|i| if let Item::Cycle(c, _) = program.items.get(i) { Some(*c) } else { None })
        .collect()
}

fn lines(text: &str) -> Vec<&str> {
    text.lines()
        .map(|l| match l.strip_prefix('N') {
            Some(rest) => rest.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start(),
            None => l,
        })
        .collect()
}

fn has(text: &str, wanted: &[&str]) -> bool {
    lines(text).windows(wanted.len()).any(|w| w == wanted)
}

// ---- what is written ----

const HOLE: Cycle = Cycle::Drill { reference: 2.0, bottom: -9.907, retract: 50.0, dwell: 0.0 };
const LOW: Cycle = Cycle::Drill { reference: 2.0, bottom: -9.907, retract: 2.0, dwell: 0.25 };

fn peck(clearance: f64) -> Cycle {
    Cycle::Peck { reference: 2.0, bottom: -10.0, retract: 2.0, step: 4.0, clearance }
}

#[test]
fn a_series_says_only_what_changes() {
    let per_minute = Speed::PerMinute(5.0);
    let series = [
        ([10.0, 0.0], HOLE),
        ([20.0, 0.0], HOLE),
        ([20.0, 30.0], HOLE),
        ([0.0, 0.0], LOW),
        ([5.0, 0.0], LOW),
    ];
    let text = post(&holes(Control::LinuxCnc, per_minute, &series), Control::LinuxCnc);
    assert!(
        has(
            &text,
            &[
                "G0 X10 Y0 Z50",
                "G98 G81 X10 Y0 Z-9.907 R2 F300",
                "X20",
                "Y30",
                "G80",
                "G0 X0 Y0",
                "G99 G82 X0 Y0 Z-9.907 R2 P0.25",
                "X5",
                "G80",
                "G0 X0 Z60",
            ]
        ),
        "{text}"
    );
    let text = post(&holes(Control::Fanuc, Speed::PerRevolution(0.2), &series), Control::Fanuc);
    assert!(
        has(
            &text,
            &[
                "G95 G98 G81 X10. Y0. Z-9.907 R2. F0.2",
                "X20.",
                "Y30.",
                "G80",
                "G0 X0. Y0.",
                "G99 G82 X0. Y0. Z-9.907 R2. P250",
                "X5.",
                "G80"
            ]
        ),
        "{text}"
    );
    let text =
        post(&holes(Control::Sinumerik840d, Speed::PerRevolution(0.2), &series), Control::Sinumerik840d);
    assert!(
        has(
            &text,
            &[
                "G0 X10 Y0 Z50",
                "G95 F0.2",
                "CYCLE81(50,0,2,-9.907)",
                "G0 X20",
                "CYCLE81(50,0,2,-9.907)",
                "G0 Y30",
                "CYCLE81(50,0,2,-9.907)",
                "G0 X0 Y0",
                "CYCLE82(2,0,2,-9.907,,0.25)",
                "G0 X5",
            ]
        ),
        "{text}"
    );
    // Many holes are called by the moves to them.
    let row: Vec<([f64; 2], Cycle)> = (0..5).map(|i| ([f64::from(10 * i), 0.0], HOLE)).collect();
    let text = post(&holes(Control::Sinumerik840d, Speed::PerMinute(5.0), &row), Control::Sinumerik840d);
    assert!(
        has(
            &text,
            &[
                "F300",
                "CYCLE81(50,0,2,-9.907)",
                "MCALL CYCLE81(50,0,2,-9.907)",
                "G0 X10",
                "G0 X20",
                "G0 X30",
                "G0 X40",
                "MCALL",
                "G0 X0 Z60",
            ]
        ),
        "{text}"
    );
    let grbl = post(&holes(Control::Grbl, per_minute, &series), Control::Grbl);
    assert!(!grbl.contains("G81") && !grbl.contains("G82") && grbl.matches("Z-9.907").count() == 5, "{grbl}");
}

#[test]
fn pecks_are_native_where_the_control_makes_them() {
    let of = |control: Control, cycle: Cycle| {
        let program = holes(control, Speed::PerMinute(5.0), &[([10.0, 0.0], cycle)]);
        let text = post(&program, control);
        assert_same(&program, &read(&text, control).program, control, &text);
        text
    };
    let lift = |lift: f64| Cycle::ChipBreak { reference: 2.0, bottom: -10.0, retract: 2.0, step: 5.0, lift };
    let text = of(Control::LinuxCnc, peck(0.254));
    assert!(has(&text, &["G99 G83 X10 Y0 Z-10 R2 Q4 F300", "G80"]), "{text}");
    assert!(has(&of(Control::LinuxCnc, lift(0.254)), &["G99 G73 X10 Y0 Z-10 R2 Q5 F300", "G80"]));
    assert!(!of(Control::LinuxCnc, peck(0.5)).contains("G83"));
    assert!(!of(Control::LinuxCnc, lift(0.2)).contains("G73"));
    let text = of(Control::Fanuc, peck(1.0));
    assert!(has(&text, &["G99 G83 X10. Y0. Z-10. R2. Q4. F300.", "G80"]), "{text}");
    assert!(text.contains("5115"), "{text}");
    assert!(
        !of(Control::Fanuc, peck(0.5)).contains("G83") && !of(Control::Fanuc, peck(0.5)).contains("5115")
    );
    let text = of(Control::Sinumerik840d, peck(0.5));
    assert!(has(&text, &["F300", "CYCLE83(2,2,0,-10,,-2,,0,,,1,1,,,,,0.5)"]), "{text}");
    // A remainder is drilled by moves: what the cycle does with it is not certain.
    let rest = Cycle::Peck { reference: 2.0, bottom: -10.0, retract: 2.0, step: 5.0, clearance: 0.5 };
    assert!(!of(Control::Sinumerik840d, rest).contains("CYCLE83"));
    assert!(!of(Control::Sinumerik840d, lift(1.0)).contains("CYCLE83"));
    // Steps from the surface, first at a third of the feed.
    let deep = DeepHole {
        reference: 3.0,
        first: -4.0,
        bottom: -20.0,
        retract: 30.0,
        step: 4.0,
        shortening: Shortening::None,
        between: Between::Withdraw { clearance: 0.8, dwell: 0.1 },
        first_feed: 0.35,
        dwell: 0.5,
        dwell_bottom: 2.0,
    };
    let text = of(Control::Sinumerik840d, Cycle::DeepHole(deep));
    assert!(has(&text, &["CYCLE83(30,0,3,-20,,-4,,0,0.5,0.1,0.35,1,,,,2,0.8)"]), "{text}");
    let plain = DeepHole {
        between: Between::Withdraw { clearance: 3.0, dwell: 0.1 },
        first_feed: 1.0,
        dwell: 0.0,
        ..deep
    };
    let text = of(Control::Heidenhain, Cycle::DeepHole(plain));
    for word in ["Q200=+3", "Q201=-20", "Q202=+4", "Q203=+0", "Q204=+30", "Q210=+0.1", "Q211=+2"] {
        assert!(text.contains(word), "{word} {text}");
    }
    assert!(!of(Control::Heidenhain, Cycle::DeepHole(deep)).contains("CYCL DEF 200"));
    assert!(!of(Control::Heidenhain, peck(0.5)).contains("CYCL DEF 200"));
}

#[test]
fn the_cycle_nearest_to_the_wanted_one_is_native() {
    let words = [
        (Control::Sinumerik840d, "CYCLE83("),
        (Control::LinuxCnc, "G83 "),
        (Control::Fanuc, "G83 "),
        (Control::Heidenhain, "CYCL CALL"),
    ];
    for (control, word) in words {
        let unit = control.resolution(control.usual_decimals());
        let wanted = Cycle::Peck { reference: 2.0, bottom: -30.0, retract: 2.0, step: 5.0, clearance: 0.5 };
        let cycle = control.own_cycle(wanted, unit);
        let program = holes(control, Speed::PerMinute(5.0), &[([10.0, 0.0], cycle), ([20.0, 0.0], cycle)]);
        let text = post(&program, control);
        assert!(text.contains(word), "{text}");
        let back = read(&text, control).program;
        assert_eq!(cycles(&back), [cycle, cycle], "{text}");
        assert_same(&program, &back, control, &text);
    }
}

#[test]
fn zones_of_a_hole_keep_their_feeds_per_revolution() {
    for control in Control::WRITTEN.iter().copied().filter(|c| c.has_feed_per_revolution()) {
        let (mut program, mut state) = start(control);
        rapid(&mut program, &state, [10.0, 0.0, 50.0]);
        rapid(&mut program, &state, [10.0, 0.0, 2.0]);
        let zone = |program: &mut Program, state: &mut State, z: f64, feed: f64| {
            state.speed = Speed::PerRevolution(feed);
            let end = Target::Tip { point: DVec3::new(10.0, 0.0, z), axis: ToolAxis::Fixed };
            program.push_move(Move { end, path: Path::Line }, state, Origin::default());
        };
        zone(&mut program, &mut state, -7.907, 0.6);
        // The steady zone breaks its chip, from within the hole.
        state.speed = Speed::PerRevolution(0.8);
        let wanted =
            Cycle::ChipBreak { reference: -7.907, bottom: -150.0, retract: -7.907, step: 20.0, lift: 1.0 };
        let steady = control.own_cycle(wanted, 0.001);
        program.push_cycle(steady, &state, Origin::default()).unwrap();
        rapid(&mut program, &state, [10.0, 0.0, -150.0]);
        zone(&mut program, &mut state, -159.907, 0.2);
        rapid(&mut program, &state, [10.0, 0.0, 50.0]);
        let text = post(&program, control);
        let back = read(&text, control).program;
        assert_same(&program, &back, control, &text);
        assert!((time(&program) - time(&back)).abs() < 1e-6);
        let word = if control == Control::Heidenhain { "FU0.6" } else { "G95" };
        assert!(text.contains(word), "{text}");
        assert_eq!(text.contains("G73"), matches!(control, Control::LinuxCnc | Control::Fanuc), "{text}");
    }
}

#[test]
fn no_cycle_where_the_height_is_not_known() {
    for control in [Control::LinuxCnc, Control::Sinumerik840d, Control::Fanuc] {
        let (mut program, mut state) = start(control);
        rapid(&mut program, &state, [10.0, 0.0, f64::NAN]);
        state.speed = Speed::PerMinute(5.0);
        program.push_cycle(HOLE, &state, Origin::default()).unwrap();
        let text = post(&program, control);
        assert!(!text.contains("G81") && !text.contains("CYCLE81"), "{text}");
    }
}

#[test]
fn a_return_that_the_control_does_not_make_is_written_as_moves() {
    // Neither R nor the height where the series begins.
    let cycle = Cycle::Drill { reference: 2.0, bottom: -5.0, retract: 20.0, dwell: 0.0 };
    let program =
        holes(Control::LinuxCnc, Speed::PerMinute(5.0), &[([10.0, 0.0], cycle), ([20.0, 0.0], cycle)]);
    let text = post(&program, Control::LinuxCnc);
    // The second hole begins where it returns to.
    assert!(has(&text, &["G0 Z2", "G1 Z-5 F300", "G0 Z20", "G0 X20", "G98 G81 X20 Y0 Z-5 R2"]), "{text}");
    assert_same(&program, &read(&text, Control::LinuxCnc).program, Control::LinuxCnc, &text);
}

// ---- any cycle ----

fn any_cycle() -> impl Strategy<Value = Cycle> {
    let height = |low: i32, high: i32| (low..high).prop_map(|v| f64::from(v) * 0.001);
    let heights = (height(-3000, 4000), height(1, 30_000), prop_oneof![Just(0.0), height(0, 40_000)]);
    let dwell = prop_oneof![Just(0.0), (1..3000).prop_map(|v| f64::from(v) * 0.001)];
    (
        heights,
        0..4u8,
        height(300, 9000),
        prop_oneof![Just(0.254), Just(1.0), height(0, 3000)],
        dwell,
        1..20i32,
        0..3u8,
    )
        .prop_map(|((reference, depth, above), kind, step, distance, dwell, factor, between)| {
            let (bottom, retract) = (reference - depth, reference + above);
            match kind {
                0 => Cycle::Drill { reference, bottom, retract, dwell },
                1 => Cycle::Peck { reference, bottom, retract, step, clearance: distance },
                2 => Cycle::ChipBreak { reference, bottom, retract, step, lift: distance },
                _ => Cycle::DeepHole(DeepHole {
                    reference,
                    first: reference - distance.min(depth) - step,
                    bottom,
                    retract,
                    step,
                    shortening: match between {
                        0 => Shortening::None,
                        1 => Shortening::By { decrement: 0.3, least: 0.5 },
                        _ => Shortening::Degressive { amount: 0.7 },
                    },
                    between: match factor % 3 {
                        0 => Between::Lift { lift: 0.2, at_feed: between == 0 },
                        _ => Between::Withdraw { clearance: distance, dwell },
                    },
                    first_feed: if factor < 10 { 1.0 } else { f64::from(factor) * 0.05 },
                    dwell: if factor % 2 == 0 { dwell } else { 0.0 },
                    dwell_bottom: dwell,
                }),
            }
        })
}

proptest! {
    #![proptest_config(kinecut_cases::property(48))]

    #[test]
    fn the_text_of_any_cycles_runs_as_the_program(
        list in prop::collection::vec(((-9..9i32, -9..9i32), any_cycle(), 1..6usize), 1..4),
        feed in prop_oneof![(1..200i32).prop_map(|f| Speed::PerMinute(f64::from(f) * 0.1)), (1..50i32).prop_map(|f| Speed::PerRevolution(f64::from(f) * 0.01))],
        own in any::<bool>(), inches in any::<bool>(),
    ) {
        let units = if inches { Units::Inches } else { Units::Millimetres };
        for control in Control::WRITTEN.iter().copied() {
            let speed = match feed {
                Speed::PerRevolution(f) if !control.has_feed_per_revolution() => Speed::PerMinute(f * 10.0),
                other => other,
            };
            let decimals = settings(control, units).decimals;
            let unit = units.mm() * control.resolution(decimals);
            let mut all = Vec::new();
            for ((x, y), cycle, count) in &list {
                let cycle = if own { control.own_cycle(*cycle, unit) } else { *cycle };
                for k in 0..*count {
                    all.push(([f64::from(*x) + 20.0 * k as f64, f64::from(*y)], cycle));
                }
            }
            let program = holes(control, speed, &all);
            let text = post_in(&program, control, units);
            let back = read(&text, control);
            // Eight decimals of the smallest pitch, in inches.
            let share = if inches { 2e-6 } else { 1e-6 };
            assert_same_within((0.5 * unit, share), (&program, &back.program), control, &text);
            prop_assert!((time(&program) - time(&back.program)).abs() < 1e-3 * time(&program).max(1.0));
            // Written again it is the same text.
            prop_assert_eq!(post_in(&back.program, control, units), text);
        }
    }
}
