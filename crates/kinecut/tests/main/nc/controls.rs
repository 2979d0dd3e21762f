//! What is particular to FANUC and GRBL, and the settings of the post: resolution, chords, templates, spirals.

use std::f64::consts::TAU;

use glam::DVec3;
use kinecut::base::{Code, Sources};
use kinecut::geom::{
    Arc, Curve, CurveKind, InvoluteRecord, LensOrder, Line, Rise, RiseShape, Spiral, Support,
};
use kinecut::nc::{self, Control, PostSettings, Reading};
use kinecut::program::{
    Blend, Coolant, Cycle, CycleStep, Frame, Item, Move, Origin, Program, SetupId, Speed, Spindle, State,
    StopKind, Target, ToolNumber, WorkOffset,
};
use kinecut::tool::{Cutter, Tool};

use Control::{Fanuc, Grbl, LinuxCnc};

fn try_read(text: &str, control: Control) -> kinecut::base::Result<Reading> {
    nc::read(&mut Sources::default(), "test", text, control, &[])
}

fn read(text: &str, control: Control) -> Reading {
    try_read(text, control).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A program of curves at feed, each from the end of the one before.
fn program(curves: &[Curve]) -> Program {
    let mut program = Program::default();
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    state.blend = Blend::Continuous;
    program.push_tool(ToolNumber(1), Some(1), None, &state, Origin::default());
    state.spindle = Spindle::Clockwise(100.0 * TAU);
    let start = curves[0].start();
    program.push_move(Move::along(&Line { start, end: start }.into()), &state, Origin::default());
    state.speed = Speed::PerMinute(10.0);
    for curve in curves {
        program.push_move(Move::along(curve), &state, Origin::default());
    }
    program.push_stop(StopKind::End, &state, Origin::default());
    program
}

fn curves(program: &Program) -> Vec<Curve> {
    let mut at = DVec3::NAN;
    let mut out = Vec::new();
    for i in 0..program.items.len() {
        let Item::Move(motion) = program.items.get(i) else { continue };
        let Target::Tip { point, .. } = motion.end else { continue };
        if at.is_finite() {
            out.push(motion.curve(at).unwrap());
        }
        at = point;
    }
    out
}

fn circle(turns: f64, rise: f64) -> Curve {
    Arc { start: DVec3::X * 10.0, centre: DVec3::ZERO, axis: DVec3::Z, sweep: turns * TAU, rise }.into()
}

/// Largest distance of points of `found` from the exact curve: each from its foot near the same share of the length.
fn strayed(exact: &Curve, found: &[Curve]) -> f64 {
    let total: f64 = found.iter().map(Curve::length).sum();
    let (mut before, mut worst) = (0.0, 0.0f64);
    for curve in found {
        for k in 0..=5 {
            let s = curve.length() * f64::from(k) / 5.0;
            let p = curve.at(s).p;
            let mut foot = (before + s) / total * exact.length();
            for _ in 0..4 {
                let jet = exact.at(foot);
                let off = p - jet.p;
                foot = (foot + off.dot(jet.d1)).clamp(0.0, exact.length());
            }
            worst = worst.max((p - exact.at(foot).p).length());
        }
        before += curve.length();
    }
    worst
}

#[test]
fn numbers_without_a_point_are_least_increments_on_fanuc() {
    let text = "%\nO1234(NAME)\nG21 G17 G40 G49 G80\nG90 G94 G54\nT3 M6\nS500 M3\nG0 X1000 Y-2500\nG43 H3 Z5000\n\
        G1 Z-1. F200\nG1 X2. F200.\nG2 X4000 I1000 J0\nG4 P1500\nG4 X2.5\nG4 X300\nG95 G1 X5. F12\nG1 X6. F.12\nM30\n%\n";
    let reading = read(text, Fanuc);
    assert_eq!(reading.header, ["NAME"]);
    let items = &reading.program.items;
    let mut ends = Vec::new();
    let mut waits = Vec::new();
    let mut feeds = Vec::new();
    for i in 0..items.len() {
        match items.get(i) {
            Item::Move(Move { end: Target::Tip { point, .. }, .. }) => {
                ends.push(point);
                feeds.push(reading.program.state(i).speed);
            }
            Item::Dwell(seconds) => waits.push(seconds),
            Item::Tool { id, length, .. } => assert_eq!((id, length), (ToolNumber(3), Some(3))),
            _ => {}
        }
    }
    assert_eq!((ends[0].x, ends[0].y), (1.0, -2.5));
    assert!(ends[0].z.is_nan());
    assert_eq!(ends[1], DVec3::new(1.0, -2.5, 5.0));
    assert_eq!(ends[4], DVec3::new(4.0, -2.5, -1.0));
    assert_eq!(waits, [1.5, 2.5, 0.3]);
    let Speed::PerMinute(feed) = feeds[2] else { panic!() };
    assert!((feed * 60.0 - 200.0).abs() < 1e-9);
    assert_eq!(feeds[2], feeds[3]);
    assert!(matches!(feeds[5], Speed::PerRevolution(f) if (f - 0.12).abs() < 1e-12), "{:?}", feeds[5]);
    assert!(matches!(feeds[6], Speed::PerRevolution(f) if (f - 0.12).abs() < 1e-12), "{:?}", feeds[6]);
    // In inches the least increment is a tenth of a thousandth.
    let inch = read("%\nO1\nG20 G90 G54\nG0 X10000 Y0. Z5000\nM30\n%\n", Fanuc);
    let Item::Move(Move { end: Target::Tip { point, .. }, .. }) = inch.program.items.get(0) else { panic!() };
    assert!((point - DVec3::new(25.4, 0.0, 12.7)).length() < 1e-12);
}

#[test]
fn fanuc_text_always_has_its_points_and_calls_the_length_with_z() {
    let p = program(&[circle(2.5, -6.0)]);
    let posted = nc::write(&p, &[], &PostSettings::new(Fanuc)).unwrap();
    assert!(posted.text.starts_with("%\nO0001\n(PROGRAM)\n"), "{}", posted.text);
    assert!(posted.text.contains("G43 H1 G0 X10. Y0. Z0.\n"), "{}", posted.text);
    // Whole turns are blocks of their own.
    assert!(
        posted.text.contains(
            "G3 X10. Y0. Z-2.4 I-10. J0. F600.\nG3 X10. Y0. Z-4.8 I-10. J0.\nG3 X-10. Y0. Z-6. I-10. J0.\n"
        ),
        "{}",
        posted.text
    );
    for line in posted.text.lines().filter(|l| l.starts_with(['G', 'X', 'Y', 'Z'])) {
        for word in line.split(' ').filter(|w| w.starts_with(['X', 'Y', 'Z', 'I', 'J', 'F'])) {
            assert!(word.contains('.'), "{line}");
        }
    }
}

#[test]
fn fanuc_involutes_keep_off_the_base_circle_and_below_a_hundred_turns() {
    let native = |record: InvoluteRecord, rise: f64, decimals: u8| {
        let p = program(&[Curve::involute(record, 0.0, rise)]);
        let settings = PostSettings { decimals, ..PostSettings::new(Fanuc) };
        nc::write(&p, &[], &settings).unwrap().text.contains("G3.2")
    };
    let r = 0.628;
    // From roll `from` to roll `to`, [rad].
    let record = |from: f64, to: f64| {
        let (a, b) = (r * from, r * to);
        InvoluteRecord::new(0.5 * (to - from) * (a + b), [5.0, 3.0], 0.7, a, b).unwrap()
    };
    assert!(native(record(TAU, 10.0 * TAU), 0.0, 3));
    assert!(!native(record(0.0, 10.0 * TAU), 0.0, 3), "from the base circle");
    assert!(!native(record(TAU, 10.0 * TAU), -1.0, 3), "Z moves");
    assert!(native(record(91.0 * TAU, 99.9 * TAU), 0.0, 6));
    assert!(!native(record(91.0 * TAU, 100.1 * TAU), 0.0, 6), "more than a hundred turns");
}

#[test]
fn fanuc_refusals_point_at_the_word() {
    let head = "%\nO1\nG21 G90 G94 G54\nG0 X0. Y0. Z0.\n";
    for (block, code) in [
        ("G27 Z0.", Code::NC_WORD),
        ("G68.2 P2 X0. Y0. Z0.", Code::NC_WORD),
        ("#1000=3", Code::NC_WORD),
        ("G4 P1.5", Code::NC_SYNTAX),
        ("G43 Z5.", Code::NC_STATE),
        ("G1 X1.", Code::NC_STATE),
        ("G2 X5. Y0. R1. F100.", Code::NC_ARC),
        ("G3.2 X5. Y0. I1. J0. F100.", Code::NC_ARC),
        ("G64 P1", Code::NC_WORD),
    ] {
        let error = try_read(&format!("{head}{block}\nM30\n%\n"), Fanuc).expect_err(block);
        assert_eq!(error.code(), code, "{block}: {error}");
        assert_eq!(error.0.place.as_ref().unwrap().line, 5, "{block}: {error}");
    }
}

#[test]
fn fanuc_cycles_count_milliseconds_and_repeat_by_k() {
    let text = "%\nO7\nG21 G90 G94 G54\nT1 M6\nG43 H1 G0 X0. Y0. Z50.\nG99 G82 X10. Y5. Z-5. R2. P250 K1 F100.\nG80\nM30\n%\n";
    let reading = read(text, Fanuc);
    let items = &reading.program.items;
    let cycle = (0..items.len()).find_map(|i| match items.get(i) {
        Item::Cycle(cycle, steps) => Some((*cycle, steps.to_vec())),
        _ => None,
    });
    let (cycle, steps) = cycle.unwrap();
    assert_eq!(cycle, Cycle::Drill { reference: 2.0, bottom: -5.0, retract: 2.0, dwell: 0.25 });
    assert!(steps.contains(&CycleStep::Dwell(0.25)));
}

#[test]
fn grbl_lines_are_short_and_its_tools_are_changed_by_hand() {
    let second = program(&[Arc {
        start: DVec3::new(-500.123_456, -400.123_456, -100.123_456),
        centre: DVec3::new(-100.654_321, -300.654_321, -100.123_456),
        axis: DVec3::Z,
        sweep: -2.3,
        rise: -22.333_333,
    }
    .into()]);
    let state = State { speed: Speed::PerMinute(10.0), ..*second.state(0) };
    for decimals in [3, 6] {
        let settings = PostSettings { decimals, block_numbers: true, ..PostSettings::new(Grbl) };
        let posted = nc::write(&second, &[], &settings).unwrap();
        assert!(posted.text.lines().all(|l| l.len() < 80), "{}", posted.text);
        assert!(posted.text.contains("T1 M0"), "{}", posted.text);
        assert!(!posted.text.contains('%') && !posted.text.contains("M6") && !posted.text.contains("G43"));
        let again = nc::write(&read(&posted.text, Grbl).program, &[], &settings).unwrap();
        assert_eq!(posted.text, again.text);
    }
    let refused = |change: &dyn Fn(&mut Program, &mut State)| {
        let mut p = Program::default();
        p.add_frame(Frame::Work(WorkOffset::G54));
        let mut state = state;
        p.push_tool(ToolNumber(1), Some(1), None, &state, Origin::default());
        change(&mut p, &mut state);
        let end = Line { start: DVec3::ZERO, end: DVec3::X };
        p.push_move(Move::along(&end.into()), &state, Origin::default());
        nc::write(&p, &[], &PostSettings::new(Grbl)).expect_err("refused").code()
    };
    let call = |length| {
        move |p: &mut Program, s: &mut State| p.push_tool(ToolNumber(1), length, None, s, Origin::default())
    };
    assert_eq!(refused(&call(None)), Code::POST_CONTROL);
    assert_eq!(refused(&call(Some(2))), Code::POST_CONTROL);
    assert_eq!(refused(&|_, s| s.coolant = Coolant::Mist), Code::POST_CONTROL);
    assert_eq!(refused(&|_, s| s.speed = Speed::PerRevolution(0.1)), Code::POST_CONTROL);
}

#[test]
fn grbl_refuses_what_the_firmware_refuses() {
    let head = "G21 G90 G94 G54\nT1\nG0 X0 Y0 Z0\n";
    for (block, code) in [
        ("T2", Code::NC_STATE),
        ("T2 M6", Code::NC_WORD),
        ("G43 H1", Code::NC_WORD),
        ("G43.1 Z10", Code::NC_WORD),
        ("G64", Code::NC_WORD),
        ("G95 F1", Code::NC_WORD),
        ("M7", Code::NC_WORD),
        ("G41 D1", Code::NC_WORD),
        ("G81 X1 Y1 Z-1 R1 F100", Code::NC_WORD),
        ("G2 X10 Y0 I5.0055 J0 F100", Code::NC_ARC),
        ("G3 X0 Y0 I5 J0 P2 F100", Code::NC_WORD),
    ] {
        let error = try_read(&format!("{head}{block}\nM30\n"), Grbl).expect_err(block);
        assert!(error.code() == code || block == "G41 D1", "{block}: {error}");
        assert_eq!(error.0.place.as_ref().unwrap().line, 4, "{block}: {error}");
    }
    // 0.004 mm is taken, and 0.3 mm at a radius of 400.
    read(&format!("{head}G2 X10 Y0 I5.002 J0 F100\nM30\n"), Grbl);
    read(&format!("{head}G2 X800 Y0 I400.15 J0 F100\nM30\n"), Grbl);
}

#[test]
fn every_coordinate_is_a_multiple_of_the_resolution() {
    let p = program(&[circle(0.3, 0.0), circle(0.3, 0.0).reversed()]);
    for &control in Control::WRITTEN {
        let settings = PostSettings { decimals: 3, resolution: Some(0.005), ..PostSettings::new(control) };
        let posted = nc::write(&p, &[], &settings).unwrap();
        let mut seen = 0;
        for word in posted.text.lines().filter(|l| !l.starts_with(['(', ';'])).flat_map(|l| l.split(' ')) {
            if let Some(number) = word.strip_prefix(['X', 'Y', 'Z', 'I', 'J'])
                && let Ok(value) = number.parse::<f64>()
            {
                seen += 1;
                assert!((value / 0.005 - (value / 0.005).round()).abs() < 1e-6, "{word}");
            }
        }
        assert!(seen > 8, "{}", posted.text);
        let back = read(&posted.text, control);
        assert!(strayed(&circle(0.3, 0.0), &curves(&back.program)[..1]) < 0.012);
        assert_eq!(nc::write(&back.program, &[], &settings).unwrap().text, posted.text);
        let bad = PostSettings { resolution: Some(0.0007), ..settings };
        assert_eq!(nc::write(&p, &[], &bad).unwrap_err().code(), Code::POST_NUMBER);
    }
}

#[test]
fn without_arcs_there_are_only_lines_with_their_ends_on_the_curve() {
    let record = InvoluteRecord::new(25.0 * TAU * 0.5, [0.0, 0.0], 0.0, 0.0, 12.5).unwrap();
    for exact in [circle(1.4, -3.0), Curve::involute(record, 0.0, 0.0)] {
        let p = program(std::slice::from_ref(&exact));
        for &control in Control::WRITTEN {
            let settings = PostSettings { arcs: false, chord_tolerance: 0.01, ..PostSettings::new(control) };
            let posted = nc::write(&p, &[], &settings).unwrap();
            assert!(
                !posted.text.contains("G2 ") && !posted.text.contains("G3 ") && !posted.text.contains("INV")
            );
            let found = curves(&read(&posted.text, control).program);
            let unit = control.resolution(settings.decimals);
            let off = strayed(&exact, &found);
            assert!(off < 0.01 + unit && off > 0.004, "{off}");
            let ends: Vec<Curve> =
                found.iter().map(|c| Line { start: c.end(), end: c.end() }.into()).collect();
            assert!(ends.len() > 20 && found.iter().all(|c| matches!(c.kind(), CurveKind::Line(_))));
        }
    }
}

#[test]
fn spirals_read_back_within_a_micrometre() {
    let r = 25.0 / (5.0 * TAU);
    for order in [LensOrder::One, LensOrder::Two] {
        let law = Support::Lens { inner: 5.0, base_radius: r, order };
        let spiral = Spiral::new(law.into(), 0.0, 5.0 * TAU).unwrap();
        for (spiral, rise) in [
            (spiral, Rise::NONE),
            (spiral.reversed(), Rise::NONE),
            (spiral.mirrored(), Rise::new(RiseShape::Smooth, -4.0)),
        ] {
            let exact = Curve::spiral(spiral, 1.0, rise);
            let p = program(std::slice::from_ref(&exact));
            for &control in Control::WRITTEN {
                let settings = PostSettings { decimals: 4, ..PostSettings::new(control) };
                let posted = nc::write(&p, &[], &settings).unwrap();
                assert!(!posted.text.contains("G1 "), "{}", posted.text);
                let found = curves(&read(&posted.text, control).program);
                let off = strayed(&exact, &found);
                assert!(off < 0.001 + 0.0001, "{control} {off}");
                assert!((found[found.len() - 1].end() - exact.end()).abs().max_element() < 0.000_051);
                let back = read(&posted.text, control);
                assert_eq!(nc::write(&back.program, &[], &settings).unwrap().text, posted.text);
            }
        }
    }
}

fn tool() -> Tool {
    Tool {
        number: ToolNumber(1),
        name: "shoulder mill".to_owned(),
        cutter: Cutter::EndMill { diameter: 20.0 },
        teeth: 4,
        spacing: Default::default(),
        flute_length: 45.0,
        stickout: 90.0,
        shank_diameter: 20.0,
        holder: None,
        centre_cutting: true,
        max_ramp_angle: None,
        gauge_length: Some(120.0),
        limits: Default::default(),
        elasticity: None,
    }
}

#[test]
fn templates_replace_start_and_end_and_are_read_back() {
    let p = program(&[circle(0.5, 0.0)]);
    let mut settings = PostSettings::new(LinuxCnc);
    settings.start_template = Some(
        "( {{ program_name }} in {{ units }} )\n{% for t in tools %}( T{{ t.number }} {{ t.name }} D{{ t.diameter }} L{{ t.length }} )\n{% endfor %}\
         G21 G17 G90 G91.1\nG40 G49 G80 {{ offset }}\n"
            .to_owned(),
    );
    settings.end_template = Some("M5 M9\nG53 G0 Z0\nM30\n".to_owned());
    let posted = nc::write(&p, &[tool()], &settings).unwrap();
    assert!(
        posted.text.contains("( T1 shoulder mill D20.0 L120.0 )\nG21 G17 G90 G91.1\nG40 G49 G80 G54\n"),
        "{}",
        posted.text
    );
    assert!(posted.text.ends_with("M5\nM5 M9\nG53 G0 Z0\nM30\n%\n"), "{}", posted.text);
    // Nothing is taken for granted after it.
    assert!(posted.text.contains("G17 G94 G3"), "{}", posted.text);
    assert_eq!(posted.lines.len(), posted.text.lines().count());
    let back = read(&posted.text, LinuxCnc);
    assert!(strayed(&circle(0.5, 0.0), &curves(&back.program)) < 0.0002);
}

#[test]
fn templates_of_klartext_are_read_back_too() {
    let p = program(&[circle(0.5, 0.0)]);
    let mut settings = PostSettings::new(Control::Heidenhain);
    settings.start_template = Some("; {{ program_name }} {{ tools[0].diameter }}\n".to_owned());
    settings.end_template = Some("M9\nL Z+0 R0 FMAX M91\nM30\n".to_owned());
    let refused = |start: &str, end: &str| {
        let mut settings = PostSettings::new(Control::Heidenhain);
        settings.start_template = Some(start.to_owned());
        settings.end_template = Some(end.to_owned());
        nc::write(&p, &[tool()], &settings).unwrap_err().to_string()
    };
    let posted = nc::write(&p, &[tool()], &settings).unwrap();
    assert!(posted.text.contains("; PROGRAM 20.0\n"), "{}", posted.text);
    assert!(posted.text.contains("L Z+0 R0 FMAX M91\n"), "{}", posted.text);
    let back = read(&posted.text, Control::Heidenhain);
    assert!(strayed(&circle(0.5, 0.0), &curves(&back.program)) < 0.0005);
    assert!(refused("L X+5 R0 FMAX\n", "M30\n").contains("moves axes"));
    assert!(refused("; A\n", "M9\n").contains("does not end"));
    assert!(refused("M30\n", "M30\n").contains("ends the program"));
    assert!(
        refused("; A\nPLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY\n", "M30\n").contains("tilts the coordinates")
    );
    assert!(refused("M128\n", "M30\n").contains("M128"));
    assert!(refused("; A\nPLANE AXIAL A+10 STAY\n", "M30\n").contains("line 2"));
    assert!(refused("END PGM X MM\n", "M30\n").contains("END PGM"));
}

#[test]
fn templates_that_do_not_work_are_refused_with_their_line() {
    let p = program(&[circle(0.5, 0.0)]);
    let refuse = |start: Option<&str>, end: Option<&str>| {
        let mut settings = PostSettings::new(LinuxCnc);
        settings.start_template = start.map(str::to_owned);
        settings.end_template = end.map(str::to_owned);
        let error = nc::write(&p, &[tool()], &settings).expect_err("refused");
        assert_eq!(error.code(), Code::POST_TEMPLATE, "{error}");
        error.0.to_string()
    };
    let start = |text: &str| refuse(Some(text), None);
    let end = |text: &str| refuse(None, Some(text));
    let says = |message: String, part: &str| assert!(message.contains(part), "{message}");
    says(start("G21 G90\n( {{ progam_name }} )\n"), "line 2");
    says(start("G21 G90\n{{ tools[3].name }}\n"), "line 2");
    says(start("G21\n{% for %}\n"), "line 2");
    says(start("{% include 'x' %}"), "start template");
    says(
        start("{% for i in range(99999) %}{% for j in range(99999) %}x{% endfor %}{% endfor %}"),
        "start template",
    );
    says(start("G21 G90\n( \u{1b} )\n"), "character");
    says(start(&format!("G21 G90\n( {} )\n", "x".repeat(300))), "too long");
    says(start("G21 G90\nG100 X1\n"), "line 2 of its result");
    says(start("G21 G91\n"), "increments");
    says(start("G20 G90\n"), "inches");
    says(start("G90\n"), "units");
    says(start("G21 G90 G90.1\n"), "absolute");
    says(start("G21 G90\nM30\n"), "ends the program");
    says(start("G21 G90\nG0 X0 Y0 Z0\n"), "moves axes");
    says(start("%\nG21 G90\n"), "%");
    says(end("M5\n"), "does not end");
    says(end("M30 X\n"), "end template");
}
