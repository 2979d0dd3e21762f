//! What the readers understand, what they refuse, and where they point.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DMat3, DVec3};
use kinecut::base::{Code, Sources};
use kinecut::geom::Rigid;
use kinecut::nc::{self, Control, Reading};
use kinecut::program::{
    Blend, Coolant, Cycle, CycleStep, Frame, Item, Path, Setup, Speed, Spindle, StopKind, Target, WorkOffset,
};

use Control::{LinuxCnc, Sinumerik840d};

fn try_read(text: &str, control: Control) -> kinecut::base::Result<Reading> {
    nc::read(&mut Sources::default(), "test", text, control, &[])
}

fn read(text: &str, control: Control) -> Reading {
    try_read(text, control).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// End points of the moves; machine moves are not numbers.
fn ends(reading: &Reading) -> Vec<[f64; 3]> {
    let items = &reading.program.items;
    (0..items.len())
        .filter_map(|i| match items.get(i) {
            Item::Move(m) => Some(match m.end {
                Target::Tip { point, .. } => point.to_array(),
                Target::Joints(_) | Target::Orient => [f64::NAN; 3],
            }),
            _ => None,
        })
        .collect()
}

/// Centre, sweep and rise of the arcs.
fn arcs(reading: &Reading) -> Vec<(DVec3, DVec3, f64, f64)> {
    let items = &reading.program.items;
    (0..items.len())
        .filter_map(|i| match items.get(i) {
            Item::Move(m) => match m.path {
                Path::Arc { centre, axis, sweep, rise } => Some((centre, axis, sweep, rise)),
                _ => None,
            },
            _ => None,
        })
        .collect()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

/// Reads `head` and then `block`, which must be refused with this code at this word.
#[track_caller]
fn refused(control: Control, head: &str, block: &str, code: Code, word: &str) {
    let text = format!("{head}\n{block}\nM2\n");
    let error = try_read(&text, control).map(|r| format!("{:?}", ends(&r))).expect_err(block);
    let place = error.0.place.clone().expect("a place");
    let line = head.lines().count() as u32 + 1;
    assert_eq!(error.code(), code, "{error}");
    assert_eq!((place.line, place.text.as_str()), (line, block), "{error}");
    let pointed = &text[place.start as usize..place.end as usize];
    assert_eq!(pointed, word, "{error}");
    let column = block.find(word).unwrap() + 1;
    assert_eq!(place.column as usize, column, "{error}");
}

const HEAD: &str = "G90 G94\nG0 X10 Y0 Z5\nF100";

#[test]
fn words_that_are_not_understood_are_pointed_at() {
    for (control, block, word) in [
        (Sinumerik840d, "G1 X20 Q7", "Q7"),
        (Sinumerik840d, "N10 CYCLE800(2,\"T\",0,64)", "64"),
        (Sinumerik840d, "R1=5", "R1=5"),
        (Sinumerik840d, "G1 X=R1*2 Y5", "X=R1*2"),
        (Sinumerik840d, "G1 X=-R2", "X=-R2"),
        (Sinumerik840d, "TRAORI(2)", "TRAORI(2)"),
        (Sinumerik840d, "G451 X3", "G451"),
        (Sinumerik840d, "OFFN=2", "OFFN=2"),
        (LinuxCnc, "G14 X3", "G14"),
        (Sinumerik840d, "G1 X5 M77", "M77"),
        (Sinumerik840d, "LOOP1: G1 X3", "LOOP1:"),
        (Sinumerik840d, "G58 X3", "G58"),
        (Sinumerik840d, "T=\"MILL 63\"", "T=\"MILL"),
        (Sinumerik840d, "S1=500", "S1=500"),
        (LinuxCnc, "G1 X20 U90", "U90"),
        (LinuxCnc, "G1 X[1+NO[2]]", "NO"),
        (LinuxCnc, "#5420=3", "#5420=3"),
        (LinuxCnc, "G77 Z5", "G77"),
        (LinuxCnc, "G0 Z5 H3", "H3"),
        (LinuxCnc, "G505", "G505"),
        (LinuxCnc, "G61 R0.5", "R0.5"),
    ] {
        refused(control, HEAD, block, Code::NC_WORD, word);
    }
}

#[test]
fn malformed_blocks_are_pointed_at() {
    for (control, block, word) in [
        (LinuxCnc, "G1 X1O", "X1O"),
        (LinuxCnc, "GO X1", "GO"),
        (LinuxCnc, "G1 X", "X"),
        (LinuxCnc, "G1 X1.2.3", "X1.2.3"),
        (LinuxCnc, "G1 X1 X2", "X2"),
        (LinuxCnc, "G1 G2 X1 I1", "G2"),
        (LinuxCnc, "G1 X1 (open", "(open"),
        (LinuxCnc, "G1 X2 ü", "ü"),
        (LinuxCnc, "G1 X9999999999", "X9999999999"),
        (Sinumerik840d, "G1 X1O", "X1O"),
        (Sinumerik840d, "GO X1", "GO"),
        (Sinumerik840d, "G1 XO", "XO"),
        (Sinumerik840d, "G1 X", "X"),
        (Sinumerik840d, "G1 X=1.2.3", "X=1.2.3"),
        (Sinumerik840d, "G1 X1 X=2", "X=2"),
        (Sinumerik840d, "M3 S100 M4", "M4"),
        (Sinumerik840d, "G1 X1 (note)", "("),
        (Sinumerik840d, "MSG(\"open)", "MSG(\"open)"),
        (Sinumerik840d, "D1.5", "D1.5"),
    ] {
        refused(control, HEAD, block, Code::NC_SYNTAX, word);
    }
}

#[test]
fn a_comment_in_a_comment_is_pointed_at() {
    let error = try_read("G1 X1 (a (b)", LinuxCnc).unwrap_err();
    assert_eq!((error.code(), error.0.place.unwrap().column), (Code::NC_SYNTAX, 10));
}

/// Reads a feed move whose start is not known: that is said of its block.
fn from_nowhere(control: Control, head: &str, block: &str) {
    let reading = try_read(&format!("{head}\n{block}\n"), control).unwrap();
    let found = reading.findings.iter().find(|f| f.code == Code::UNKNOWN_START).unwrap();
    assert_eq!(found.place.as_ref().unwrap().text, block, "{found}");
}

#[test]
fn blocks_that_lack_something_are_refused() {
    for control in [LinuxCnc, Sinumerik840d] {
        refused(control, "G90\nG0 X0 Y0 Z0", "G1 X1", Code::NC_STATE, "G1 X1");
        refused(control, "F100", "G91 G0 X1", Code::NC_STATE, "X1");
        refused(control, "F100", "X1", Code::NC_STATE, "X1");
        refused(control, "F100", "M6", Code::NC_STATE, "M6");
        refused(control, "G0 X0 Y0 Z0 F0", "G1 X1", Code::NC_STATE, "G1 X1");
        refused(control, "G93\nG0 X0 Y0 Z0\nG1 X1 F5", "X2", Code::NC_STATE, "X2");
        // After a machine move, a tool change, another work offset the place is open again.
        from_nowhere(control, &format!("{HEAD}\nT1\nM6"), "G1 X1 Y1 Z1");
        from_nowhere(control, &format!("{HEAD}\nG55"), "G1 X1 Y1 Z1");
    }
    from_nowhere(LinuxCnc, &format!("{HEAD}\nG53 G0 Z0"), "G1 X1");
    from_nowhere(LinuxCnc, "F100\nG0 X0 Y0", "G1 X1");
    refused(LinuxCnc, HEAD, "G43", Code::NC_STATE, "G43");
    refused(LinuxCnc, HEAD, "G94 G1 X1", Code::NC_STATE, "G94 G1 X1");
    refused(LinuxCnc, HEAD, "G53 G2 X1 I1", Code::NC_STATE, "G53");
    // The tip, not the spindle, would go to machine zero.
    refused(Sinumerik840d, &format!("{HEAD}\nT1 M6\nD1"), "G0 SUPA Z0", Code::NC_STATE, "SUPA");
    read(&format!("{HEAD}\nT1 M6\nD1\nG0 SUPA Z0 D0\nM30"), Sinumerik840d);
}

/// Limits of the interpreter's own suite: arcs that are just good and just bad.
#[test]
fn arcs_that_do_not_fit_are_refused_with_the_numbers() {
    let t = 2.0 * 2f64.sqrt() * 0.01;
    for (units, x, i, good) in [
        ("G21", 2000.0, 998.5, false),
        ("G21", 50.0, 25.0 - 0.0101 * 2f64.sqrt(), false),
        ("G21", 50.0, 25.0 - 0.0099 * 2f64.sqrt(), true),
        ("G21", 6000.0, 3000.0 + 100.0 * 0.0099 * 2f64.sqrt(), true),
        ("G20", 200.0, 99.95, true),
    ] {
        let text = format!("{units}\nF1\nG0 X0 Y0 Z0\nG2 X{x} I{i:.9}\nM2\n");
        let result = try_read(&text, LinuxCnc);
        assert_eq!(result.is_ok(), good, "{text} {:?}", result.err());
        if let Err(error) = result {
            assert_eq!(error.code(), Code::NC_ARC);
            let (value, bound) = (error.0.value.unwrap().value, error.0.bound.unwrap().value);
            assert!((value - (x - 2.0 * i).abs()).abs() < 1e-6, "{value}");
            assert!((bound - if x > 1000.0 { 1.0015 } else { t }).abs() < 1e-9, "{bound}");
        }
    }
    refused(Sinumerik840d, HEAD, "G3 X0 Y10.011 I-10 J0", Code::NC_ARC, "G3 X0 Y10.011 I-10 J0");
    read(&format!("{HEAD}\nG3 X0 Y10.009 I-10 J0\nM30"), Sinumerik840d);
    for block in ["G2 X1", "G2"] {
        refused(LinuxCnc, HEAD, block, Code::NC_ARC, block);
        refused(Sinumerik840d, HEAD, block, Code::NC_ARC, block);
    }
    refused(LinuxCnc, HEAD, "G2 X0 R4.9", Code::NC_ARC, "R4.9");
    refused(LinuxCnc, HEAD, "G2 R5", Code::NC_ARC, "G2");
    refused(LinuxCnc, HEAD, "G2 X10 R5", Code::NC_ARC, "R5");
    refused(Sinumerik840d, HEAD, "G2 X0 Y0 CR=4.9", Code::NC_ARC, "CR=4.9");
    refused(LinuxCnc, HEAD, "G90.1 G3 X0 Y10 I0", Code::NC_ARC, "G90.1 G3 X0 Y10 I0");
}

#[test]
fn involutes_that_do_not_fit_are_refused() {
    let head = "G90\nG0 X10 Y0 Z0\nF100";
    // The example of the manual: the end is 0.0074 mm off.
    let block = "INVCCW X32.77 Y32.77 CR=5 I-10 J0";
    let reading = read(&format!("{head}\n{block}\nM30"), Sinumerik840d);
    assert!((reading.involute_difference - 0.0074).abs() < 5e-5);
    for block in [
        "INVCCW X32.80 Y32.80 CR=5 I-10 J0",
        "INVCCW X32.77 Y32.77 CR=11 I-10 J0",
        "INVCCW X32.77 Y32.77 I-10 J0",
        "INVCCW X32.77 Y32.77 CR=5",
    ] {
        refused(Sinumerik840d, head, block, Code::NC_ARC, block);
    }
    refused(Sinumerik840d, head, "INVCCW X32.77 Y32.77 I-10 J0 CR=5 AR=300", Code::NC_WORD, "AR=300");
    refused(LinuxCnc, head, "INVCCW X1", Code::NC_SYNTAX, "INVCCW");
}

#[test]
fn arcs_in_all_forms() {
    let quarter = |text: &str, control| {
        let arcs = arcs(&read(&format!("{HEAD}\n{text}\nM30"), control));
        assert_eq!(arcs.len(), 1, "{text}");
        arcs[0]
    };
    for (control, text) in [
        (LinuxCnc, "G3 X0 Y10 I-10"),
        (LinuxCnc, "G3 X0 Y10 R10"),
        (LinuxCnc, "G90.1 G3 X0 Y10 I0 J0"),
        (LinuxCnc, "G91 G3 X-10 Y10 I-10 J0"),
        (LinuxCnc, "g3x0y10i-1 0.0"),
        (Sinumerik840d, "G3 X0 Y10 I-10 J0"),
        (Sinumerik840d, "G3 X=0 Y=10 I=-10 J=0"),
        (Sinumerik840d, "G3 X0 Y10 CR=10"),
        (Sinumerik840d, "g03 x0 y10 cr=10"),
    ] {
        let (centre, axis, sweep, rise) = quarter(text, control);
        assert!(centre.distance(DVec3::new(0.0, 0.0, 5.0)) < 1e-12, "{text} {centre}");
        assert!(axis == DVec3::Z && close(sweep, FRAC_PI_2) && rise == 0.0, "{text} {sweep}");
    }
    // Long way, whole turns, helices.
    assert!(close(quarter("G3 X0 Y10 R-10", LinuxCnc).2, 1.5 * PI));
    assert!(close(quarter("G2 X0 Y10 CR=-10", Sinumerik840d).2, -1.5 * PI));
    assert!(close(quarter("G2 X0 Y10 I-10", LinuxCnc).2, -1.5 * PI));
    assert!(close(quarter("G3 I-10 P3 Z-1", LinuxCnc).2, 3.0 * TAU));
    assert!(close(quarter("G3 X10 Y0 I-10 J0 Z-1 TURN=2", Sinumerik840d).2, 3.0 * TAU));
    assert!(close(quarter("G3 X0 Y10 I-10 P2", LinuxCnc).2, TAU + FRAC_PI_2));
    assert!(close(quarter("G3 X0 Y10 Z1 I-10 J0 TURN=1", Sinumerik840d).3, -4.0));
    // Inches.
    let (centre, ..) = quarter("G20 G0 X1 Y0 Z0\nG3 X0 Y1 I-1", LinuxCnc);
    assert!(centre.length() < 1e-12);
    // Other planes: G18 counts from Z to X.
    let (centre, axis, sweep, rise) = quarter("G18 G0 X0 Z10\nG3 X10 Z0 K-10 Y3", LinuxCnc);
    assert!(axis == DVec3::Y && close(sweep, FRAC_PI_2) && close(rise, 3.0) && centre.length() < 1e-12);
    let (_, axis, sweep, _) = quarter("G19 G0 Y10 Z0\nG3 Y0 Z10 J-10", LinuxCnc);
    assert!(axis == DVec3::X && close(sweep, FRAC_PI_2));
}

/// Rounded to two decimals the ends of an almost full circle fit badly; the far side must not move for that.
#[test]
fn an_almost_full_circle_stays_in_place() {
    let e: f64 = 0.002;
    let (x, y) = (50.0 * e.cos(), -50.0 * e.sin());
    let text = format!("G90\nG0 X50 Y0 Z0\nF100\nG3 X{x:.2} Y{y:.2} I-50.005 J0\nM30\n");
    for control in [LinuxCnc, Sinumerik840d] {
        let reading = read(&text, control);
        let mut turned = 0.0;
        for (centre, _, sweep, _) in arcs(&reading) {
            turned += sweep;
            assert!(centre.distance(DVec3::new(-0.005, 0.0, 0.0)) < 0.006, "{centre}");
        }
        assert!((turned - (TAU - e)).abs() < 1e-4, "{turned}");
    }
}

#[test]
fn exact_stops_and_exact_paths_are_told_apart() {
    use kinecut::nc::Control;
    let blend = |word: &str, control: Control| {
        let reading = read(&format!("G90\n{word}\nG0 X0 Y0 Z5\nG1 X2 F120\nM2\n"), control);
        let moves =
            (0..reading.program.items.len()).find(|i| matches!(reading.program.items.get(*i), Item::Move(_)));
        reading.program.state(moves.unwrap()).blend
    };
    // A control may begin with either: what is assumed is said, and not where the program says it.
    let notes = |word: &str| {
        let reading = read(&format!("G90\n{word}\nG0 X0 Y0 Z5\nG1 X2 F120\nX4\nM2\n"), Sinumerik840d);
        reading.findings.iter().filter(|f| f.message.contains("neither G60 nor G64")).count()
    };
    assert_eq!([notes(""), notes("G60"), notes("G64")], [1, 0, 0]);
    assert_eq!(blend("G61", LinuxCnc), Blend::Exact);
    assert_eq!(blend("G61.1", LinuxCnc), Blend::Stop);
    assert_eq!(blend("G61", Control::Fanuc), Blend::Stop);
    assert_eq!(blend("G60", Sinumerik840d), Blend::Stop);
    assert_eq!(blend("G61", Control::Grbl), Blend::Continuous);
}

#[test]
fn states_are_followed() {
    let text = "G17 G21 G90 G94\nT3 M6\nG43 H7\nG55\nS600 M4\nG64 P0.01 Q0.02\nG0 X1 Y2 Z3\n\
        M8\nG1 X2 F120\nG95 G1 X3 F0.2\nG93 X4 F30\nG94 G61 G20 G1 X0 F12\nM9 M5\nG4 P1.5\nM1\nM2\n";
    let reading = read(text, LinuxCnc);
    let program = &reading.program;
    let Item::Tool { id, length, radius, .. } = program.items.get(0) else { panic!() };
    assert_eq!((id.0, length, radius), (3, Some(7), None));
    let state = |i: usize| program.state(i);
    assert_eq!(program.frames[state(1).frame.0 as usize], Frame::Work(WorkOffset::parse("G55").unwrap()));
    assert_eq!(state(1).speed, Speed::Rapid { linear: true });
    assert_eq!(state(1).coolant, Coolant::Off);
    assert!(matches!(state(1).spindle, Spindle::CounterClockwise(w) if close(w, 20.0 * PI)));
    assert!(
        matches!(state(1).blend, Blend::Tolerance { path, merge, .. } if close(path, 0.01) && close(merge, 0.02))
    );
    assert_eq!(state(2).speed, Speed::PerMinute(2.0));
    assert_eq!(state(2).coolant, Coolant::Flood);
    assert_eq!(state(3).speed, Speed::PerRevolution(0.2));
    assert_eq!(state(4).speed, Speed::Duration(2.0));
    assert_eq!(state(5).blend, Blend::Exact);
    // The interpreter takes F before G20 of the same block: 12 mm/min.
    assert!(matches!(state(5).speed, Speed::PerMinute(f) if close(f, 0.2)));
    assert_eq!(program.items.get(6), Item::Dwell(1.5));
    assert_eq!((state(6).spindle, state(6).coolant), (Spindle::Off, Coolant::Off));
    assert_eq!(program.items.get(7), Item::Stop(StopKind::Optional));
    assert_eq!(program.items.get(8), Item::Stop(StopKind::End));
    // It moves in both units.
    let codes: Vec<&str> = reading.findings.iter().map(|f| f.code.as_str()).collect();
    assert_eq!(codes, ["KC0207"], "{:?}", reading.findings);
}

#[test]
fn sinumerik_states_are_followed() {
    let text = "%_N_PART_MPF\n; HEAD\nN10 G17 G700 G90\nG60\nT1 M6\nD2\nMSG(\"HELLO ; M30\")\nG505\nG641 ADIS=0.1\n\
        S100 M3\nG0 X1 Y1 Z1\nG1 X2 F10\nG71 X3 ; COMMENT\nG4 S50\nFFWON SOFT\nG0 SUPA Z0 D0 M5\nD2\nG0 X1 Y1\nM30\n";
    let reading = read(text, Sinumerik840d);
    let items = &reading.program.items;
    assert_eq!(reading.header, ["HEAD"]);
    assert!(matches!(items.get(0), Item::Tool { length: Some(2), radius: Some(2), .. }));
    assert_eq!(items.get(1), Item::Message("HELLO ; M30"));
    assert!(matches!(reading.program.state(2).blend, Blend::Tolerance { path, .. } if close(path, 2.54)));
    assert!(matches!(reading.program.state(3).speed, Speed::PerMinute(f) if close(f, 254.0 / 60.0)));
    assert_eq!(items.get(4), Item::Text("COMMENT"));
    assert!(close(ends(&reading)[2][0], 3.0));
    // 50 turns at 100 rev/min.
    assert!(matches!(items.get(6), Item::Dwell(s) if close(s, 30.0)));
    let Item::Move(up) = items.get(7) else { panic!("{:?}", items.get(7)) };
    assert_eq!(up.end, Target::Joints([None, None, Some(0.0), None, None, None]));
    // D0 for the retraction and D2 after it are no change of tool.
    let Item::Move(next) = items.get(8) else { panic!("{:?}", items.get(8)) };
    assert!(matches!(next.end, Target::Tip { point, .. } if point.x == 1.0 && point.z.is_nan()));
    let codes: Vec<&str> = reading.findings.iter().map(|f| f.code.as_str()).collect();
    assert_eq!(codes, ["KC0207", "KC0201", "KC0201"], "{:?}", reading.findings);
}

/// Figures of the LinuxCNC interpreter for these lines.
#[test]
fn cycles_are_read_as_the_interpreter_runs_them() {
    let text = "G21 G90 G54\nF100\nG0 X0 Y0 Z5\nG99 G83 X1 Z-3 R2 Q2\nX2\nG98 X3\nG80\nG73 X1 Z-3 R2 Q2\nG80\n\
        G0 Z0\nG91 G81 X1 Z-3 R2 L2\nG80 G90\nG82 X0 Z-1 R1 P2.5\nM2\n";
    let reading = read(text, LinuxCnc);
    let program = &reading.program;
    let mut at = [0.0; 3];
    let mut seen = Vec::new();
    for i in 0..program.items.len() {
        match program.items.get(i) {
            Item::Move(m) => {
                let Target::Tip { point, .. } = m.end else { panic!() };
                at = point.to_array();
                seen.push(('R', at));
            }
            Item::Cycle(_, steps) => {
                for step in steps {
                    let (kind, z) = match *step {
                        CycleStep::Rapid(z) => ('R', z),
                        CycleStep::Feed(z) | CycleStep::FeedAt { height: z, .. } => ('F', z),
                        CycleStep::Thread { height, .. } => ('T', height),
                        CycleStep::Dwell(s) => ('D', s),
                    };
                    if kind == 'D' {
                        // A dwell has no place; its seconds stand for one.
                        seen.push((kind, [z, 0.0, 0.0]));
                        continue;
                    }
                    at[2] = z;
                    seen.push((kind, at));
                }
            }
            _ => {}
        }
    }
    seen.dedup();
    let peck = |x: f64, up: f64| {
        vec![
            ('R', x, 2.0),
            ('F', x, 0.0),
            ('R', x, 2.0),
            ('R', x, 0.254),
            ('F', x, -2.0),
            ('R', x, 2.0),
            ('R', x, -1.746),
            ('F', x, -3.0),
            ('R', x, up),
        ]
    };
    let mut wanted = vec![('R', 0.0, 5.0), ('R', 1.0, 5.0)];
    wanted.extend(peck(1.0, 2.0));
    wanted.extend(peck(2.0, 2.0));
    // With G98 the way is at the height at which the series began.
    wanted.push(('R', 3.0, 5.0));
    wanted.extend(peck(3.0, 5.0));
    wanted.extend([
        ('R', 1.0, 5.0),
        ('R', 1.0, 2.0),
        ('F', 1.0, 0.0),
        ('R', 1.0, 0.254),
        ('F', 1.0, -2.0),
        ('R', 1.0, -1.746),
        ('F', 1.0, -3.0),
        ('R', 1.0, 5.0),
    ]);
    wanted.extend([
        ('R', 1.0, 0.0),
        ('R', 1.0, 2.0),
        ('R', 2.0, 2.0),
        ('F', 2.0, -1.0),
        ('R', 2.0, 2.0),
        ('R', 3.0, 2.0),
        ('F', 3.0, -1.0),
        ('R', 3.0, 2.0),
    ]);
    wanted.extend([('R', 0.0, 2.0), ('R', 0.0, 1.0), ('F', 0.0, -1.0), ('D', 2.5, 0.0), ('R', 0.0, 2.0)]);
    let seen: Vec<(char, f64, f64)> = seen.iter().map(|(k, p)| (*k, p[0], p[2])).collect();
    assert_eq!(seen.len(), wanted.len(), "{seen:?}");
    for (s, w) in seen.iter().zip(&wanted) {
        assert!(s.0 == w.0 && close(s.1, w.1) && close(s.2, w.2), "{s:?} {w:?}\n{seen:?}");
    }
    assert!(matches!(program.items.get(2), Item::Cycle(Cycle::Peck { .. }, _)));
}

#[test]
fn unknown_coordinates_are_not_numbers() {
    let reading = read("G90\nG0 X1\nZ5\nY2\nG1 X3 F10\nM30\n", Sinumerik840d);
    let ends = ends(&reading);
    assert!(ends[0][0] == 1.0 && ends[0][1].is_nan() && ends[0][2].is_nan());
    assert!(ends[1][1].is_nan() && ends[1][2] == 5.0);
    assert_eq!(ends[2], [1.0, 2.0, 5.0]);
    assert_eq!(ends[3], [3.0, 2.0, 5.0]);
}

#[test]
fn a_work_offset_selects_its_clamping() {
    let setup = |name: &str, offset: &str| Setup {
        name: name.to_owned(),
        part_on_table: Rigid { rotation: DMat3::IDENTITY, translation: DVec3::ZERO },
        work_offsets: [(WorkOffset::parse(offset).unwrap(), Rigid::IDENTITY)].into(),
        located: false,
        stock: None,
        fixtures: Vec::new(),
    };
    let setups = [setup("1", "G54"), setup("2", "G55")];
    let text = "G54\nG0 X0 Y0 Z5\nG55\nG0 X0 Y0 Z5\nG54\nG0 X1\nM30\n";
    let reading = nc::read(&mut Sources::default(), "test", text, Sinumerik840d, &setups).unwrap();
    let of = |i: usize| reading.program.state(i).setup.0;
    assert_eq!((of(0), of(1), of(2)), (0, 1, 0));
}

#[test]
fn what_a_control_ignores_is_said() {
    let has = |text: &str, control: Control, what: &str| {
        let reading = read(text, control);
        assert!(reading.findings.iter().any(|f| f.message.contains(what)), "{what}: {:?}", reading.findings);
    };
    has("G54 G21\nG0 X1\n", LinuxCnc, "no end");
    has("G54 G21\nG0 X1\nM2\nG0 X5\n", LinuxCnc, "after the end");
    has("G54 G21\n/G0 X1\nM2\n", LinuxCnc, "skip switch");
    has("G54 G21\nG0 X1 0\nM2\n", LinuxCnc, "blanks");
    has("G21\nG0 X1\nM2\n", LinuxCnc, "no work offset");
    has("G54\nG0 X1\nM2\n", LinuxCnc, "no unit");
    has("G54 G21\nM3\nG0 X1\nM2\n", LinuxCnc, "without a speed");
    has("G54 G710\nSOFT\nG0 X1\nM30\n", Sinumerik840d, "`SOFT`");
    // A second percent sign is the end of the tape.
    let reading = read("%\n(head)\nG54 G21\nG0 X1\n%\nG0 X9\n", LinuxCnc);
    assert_eq!((ends(&reading).len(), reading.header.len()), (1, 1));
}
