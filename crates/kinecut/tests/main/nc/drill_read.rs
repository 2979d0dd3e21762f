//! Drilling cycles read: hand-written texts run as their manuals say, and what is not certain is refused or noted.

use glam::DVec3;
use kinecut::base::{Code, Severity, Sources};
use kinecut::geom::Rigid;
use kinecut::nc::{self, Control, Reading};
use kinecut::program::{Cycle, CycleStep, Item, Program, Setup, Speed, Target, WorkOffset};
use proptest::prelude::*;

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

fn read(text: &str, control: Control) -> Reading {
    nc::read(&mut Sources::default(), "test", text, control, &[setup()])
        .unwrap_or_else(|e| panic!("{control}: {e}\n{text}"))
}

fn refused(text: &str, control: Control) -> (Code, String) {
    let error = nc::read(&mut Sources::default(), "test", text, control, &[setup()]).expect_err("refused");
    (error.code(), error.to_string())
}

fn cycles(program: &Program) -> Vec<Cycle> {
    (0..program.items.len())
        .filter_map(|i| if let Item::Cycle(c, _) = program.items.get(i) { Some(*c) } else { None })
        .collect()
}

/// Heights of the items after the first moves, with `R`apid, `F`eed at a part of the feed, or `D`well.
fn heights(program: &Program) -> Vec<(char, f64, f64)> {
    let mut found = Vec::new();
    for i in 0..program.items.len() {
        match program.items.get(i) {
            Item::Move(m) => {
                let Target::Tip { point, .. } = m.end else { continue };
                let rapid = matches!(program.state(i).speed, Speed::Rapid { .. });
                found.push((if rapid { 'R' } else { 'F' }, point.z, 1.0));
            }
            Item::Cycle(_, steps) => found.extend(steps.iter().map(|s| match *s {
                CycleStep::Rapid(z) => ('R', z, 1.0),
                CycleStep::Feed(z) => ('F', z, 1.0),
                CycleStep::FeedAt { height, factor } => ('F', height, factor),
                CycleStep::Thread { height, pitch } => ('T', height, pitch),
                CycleStep::Dwell(seconds) => ('D', seconds, 1.0),
            })),
            Item::Dwell(seconds) => found.push(('D', seconds, 1.0)),
            _ => {}
        }
    }
    found
}

fn assert_heights(found: &[(char, f64, f64)], wanted: &[(char, f64, f64)]) {
    assert_eq!(found.len(), wanted.len(), "{found:?}\n{wanted:?}");
    for (a, b) in found.iter().zip(wanted) {
        assert!(
            a.0 == b.0 && (a.1 - b.1).abs() < 1e-9 && (a.2 - b.2).abs() < 1e-12,
            "{a:?} {b:?}\n{found:?}"
        );
    }
}

const SINUMERIK: &str = "G17 G90 G94 G710\nG54\nS600 M3\nG0 X1 Y2 Z50\nF120\n";

#[test]
fn sinumerik_calls_run_as_their_arguments_say() {
    let run = |calls: &str| {
        let reading = read(&format!("{SINUMERIK}{calls}\nM30\n"), Control::Sinumerik840d);
        let found = heights(&reading.program);
        (found[1..].to_vec(), reading)
    };
    let one = |z: f64| [('R', 2.0, 1.0), ('F', z, 1.0), ('R', 10.0, 1.0)];
    assert_heights(&run("CYCLE81(10,0,2,-20)").0, &one(-20.0));
    assert_heights(&run("N60 CYCLE81( 10 , 0, 2, , 20 ) ; hole").0, &one(-20.0));
    assert_heights(&run("CYCLE81(10,2,,-20,)").0, &one(-20.0));
    assert_heights(
        &run("CYCLE82(10,0,2,-20,,0.5)").0,
        &[('R', 2.0, 1.0), ('F', -20.0, 1.0), ('D', 0.5, 1.0), ('R', 10.0, 1.0)],
    );
    // Depth 20 in steps of 5 from the surface, first at 0.4, 3 revolutions at 600 rev/min after each.
    let (found, reading) = run("CYCLE83(10,0,2,-20,,,5,0,-3,1,0.4,1,,,,0.7,0.9)");
    let deep = |z: f64, factor: f64| {
        [('F', z, factor), ('D', 0.3, 1.0), ('R', 2.0, 1.0), ('D', 1.0, 1.0), ('R', z + 0.9, 1.0)]
    };
    let mut wanted = vec![('R', 2.0, 1.0)];
    wanted.extend(deep(-5.0, 0.4));
    wanted.extend(deep(-10.0, 1.0));
    wanted.extend(deep(-15.0, 1.0));
    wanted.extend([('F', -20.0, 1.0), ('D', 0.7, 1.0), ('R', 10.0, 1.0)]);
    assert_heights(&found, &wanted);
    assert!(reading.findings.is_empty(), "{:?}", reading.findings);
    // Chip breaking: lifts of 1 mm at the feed.
    let (found, reading) = run("CYCLE83(10,0,2,-10,,-5,,0,0,0,1,0)");
    let lifts = [('R', 2.0, 1.0), ('F', -5.0, 1.0), ('F', -4.0, 1.0), ('F', -10.0, 1.0), ('R', 10.0, 1.0)];
    assert_heights(&found, &lifts);
    assert!(reading.findings.iter().any(|f| f.severity == Severity::Note && f.message.contains("lift")));
    // Degression by 2 after 6: 4, 2, 2, then 3 in halves; back in to 0.6 mm above.
    let (found, _) = run("CYCLE83(10,0,2,-17,,-6,,2,0,0,1,1)");
    let depths: Vec<f64> = found.iter().filter(|s| s.0 == 'F').map(|s| s.1).collect();
    assert_eq!(depths, [-6.0, -10.0, -12.0, -14.0, -15.5, -17.0]);
    assert!(found.contains(&('R', -5.4, 1.0)), "{found:?}");
}

#[test]
fn a_modal_call_follows_each_block_that_moves() {
    let text = format!(
        "{SINUMERIK}MCALL CYCLE81(10,0,2,-20)\nX5 Y5\nM8\nX10\nG0 Z30\nMCALL\nG1 X20 F60\nCYCLE82(10,0,2,-5,,1)\nM30\n"
    );
    let reading = read(&text, Control::Sinumerik840d);
    let kinds: String = (0..reading.program.items.len())
        .map(|i| match reading.program.items.get(i) {
            Item::Move(_) => 'm',
            Item::Cycle(..) => 'c',
            _ => '-',
        })
        .collect();
    assert_eq!(kinds, "mmcmcmcmc-");
    let feeds: Vec<Speed> = (0..reading.program.items.len())
        .filter(|i| matches!(reading.program.items.get(*i), Item::Cycle(..)))
        .map(|i| reading.program.state(i).speed)
        .collect();
    assert_eq!(feeds, [2.0, 2.0, 2.0, 1.0].map(Speed::PerMinute));
}

#[test]
fn what_a_call_does_not_say_for_certain_is_refused() {
    for (call, words) in [
        ("CYCLE81(10,0,2,-20,,0,0,1,11)", "not known"),
        ("CYCLE82(10,0,2,-20,,0.5,0,1,12,-2,50,-18,30)", "not known"),
        ("CYCLE83(10,0,5,,20,,4,100,0,0.5,100,1,0,1.2,1.4,0,1.6,0,1,11211111)", "not known"),
        ("CYCLE83(10,0,2,-20,,-5,,-0.5,0,0,1,1)", "DAM"),
        ("CYCLE81(R1,0,2,-20)", "expressions"),
        ("CYCLE81(10,0,2,-2*10)", "expressions"),
        ("CYCLE81(10,0,2,-20", "bracket"),
        ("CYCLE84(10,0,2,-20)", "PIT of CYCLE84"),
        ("CYCLE81(1,0,2,-20)", "RTP"),
        ("CYCLE81(10,0,2,20)", "DP"),
        ("CYCLE81(10,0,2,-20) X5", "no code of this block uses it"),
        ("M8 CYCLE81(10,0,2,-20)", "block of its own"),
        ("MCALL CYCLE85(10,0,2,-20)", "not read yet"),
        ("G93\nCYCLE81(10,0,2,-20)", "feed"),
        ("G18\nCYCLE81(10,0,2,-20)", "G17"),
        ("G55\nCYCLE81(10,0,2,-20)", "not set"),
    ] {
        let (code, message) = refused(&format!("{SINUMERIK}{call}\nM30\n"), Control::Sinumerik840d);
        assert!(message.contains(words), "{call}: {message}");
        assert!(matches!(code, Code::NC_WORD | Code::NC_STATE | Code::NC_SYNTAX), "{call}: {message}");
    }
}

#[test]
fn fanuc_cycles_assume_the_usual_parameters_and_say_so() {
    let text = "%\nO1\nG21 G90 G54 G94\nS600 M3\nG0 X1. Y2. Z50.\nG99 G83 Z-10. R2. Q5. F120.\nG98 X5.\nG80\nG0 Z40.\n\
        G73 X1. Z-7. R2. Q4.\nG80\nM30\n%\n";
    let reading = read(text, Control::Fanuc);
    let found = heights(&reading.program);
    let r = |z: f64| ('R', z, 1.0);
    let f = |z: f64| ('F', z, 1.0);
    let one = |up: f64| vec![r(2.0), f(-3.0), r(2.0), r(-2.0), f(-8.0), r(2.0), r(-7.0), f(-10.0), r(up)];
    let mut wanted = vec![r(50.0), r(50.0)];
    wanted.extend(one(2.0));
    wanted.push(r(2.0));
    wanted.extend(one(50.0));
    wanted.extend([r(40.0), r(40.0), r(2.0), f(-2.0), r(-1.0), f(-6.0), r(-5.0), f(-7.0), r(40.0)]);
    assert_heights(&found, &wanted);
    let notes: Vec<_> = reading.findings.iter().filter(|f| f.message.contains("5114")).collect();
    assert!(notes.len() == 1 && notes[0].severity == Severity::Note);
}

#[test]
fn klartext_cycles_run_as_their_parameters_say() {
    let run = |definition: &str| {
        let text = format!(
            "BEGIN PGM T MM\nCYCL DEF 247 Q339=1\nTOOL CALL 1 Z S600\nL X0 Y0 Z50 R0 FMAX M3\n{definition}\nCYCL CALL\nM30\nEND PGM T MM\n"
        );
        let reading = read(&text, Control::Heidenhain);
        (heights(&reading.program)[1..].to_vec(), reading)
    };
    let (r, f) = (|z: f64| ('R', z, 1.0), |z: f64| ('F', z, 1.0));
    // In steps from the surface at 1: to -3, back to the clearance of 2 above, to -7, to -9.
    let (found, reading) =
        run("CYCL DEF 200 Q200=2 Q201=-10 Q206=120 Q202=4 Q210=0.2 Q203=1 Q204=50 Q211=0.5");
    let top = ('D', 0.2, 1.0);
    assert_heights(
        &found,
        &[
            r(3.0),
            f(-3.0),
            r(3.0),
            top,
            r(-1.0),
            f(-7.0),
            r(3.0),
            top,
            r(-5.0),
            f(-9.0),
            ('D', 0.5, 1.0),
            r(51.0),
        ],
    );
    assert!(matches!(cycles(&reading.program)[..], [Cycle::DeepHole(_)]));
    // 203: two breaks, then out; steps of 6, 5, 4, 4; out at its feed.
    let (found, reading) = run(
        "CYCL DEF 203 Q200=2 Q201=-19 Q206=120 Q202=6 Q210=0 Q203=0 Q204=20 Q212=1 Q213=2 Q205=4 Q211=0 Q208=600 Q256=0.2",
    );
    assert_heights(
        &found,
        &[
            r(2.0),
            f(-6.0),
            f(-5.8),
            f(-11.0),
            f(-10.8),
            f(-15.0),
            f(2.0),
            r(-13.0),
            f(-19.0),
            f(2.0),
            r(20.0),
        ],
    );
    assert!(reading.findings.iter().any(|f| f.message.contains("203")));
    // 205: back in to 0.5 above the last depth.
    let pecking = "CYCL DEF 205 Q200=2 Q201=-10 Q206=120 Q202=4 Q203=0 Q204=2 Q212=1 Q205=2 Q258=0.5 Q259=0.5 Q257=0 Q256=0.2 Q211=0";
    let (found, _) = run(pecking);
    assert_heights(
        &found,
        &[
            r(2.0),
            f(-4.0),
            r(2.0),
            r(-3.5),
            f(-7.0),
            r(2.0),
            r(-6.5),
            f(-9.0),
            r(2.0),
            r(-8.5),
            f(-10.0),
            r(2.0),
        ],
    );
    // The older pecking, from where the tool stands: surface 25 below, back in to 0.6 above the last depth.
    let old = "L Z+25 FMAX\nCYCL DEF 1.0 PECKING\nCYCL DEF 1.1 DIST25.000\nCYCL DEF 1.2 DEPTH-5.000\nCYCL DEF 1.3 PLNGNG3.0\n\
        CYCL DEF 1.4 DWELL0.5\nCYCL DEF 1.5 F120";
    let (found, reading) = run(old);
    assert_heights(&found, &[r(25.0), r(25.0), f(-3.0), r(25.0), r(-2.4), f(-5.0), ('D', 0.5, 1.0), r(25.0)]);
    let last = reading.program.items.len() - 2;
    assert_eq!(reading.program.state(last).speed, Speed::PerMinute(2.0));
    // A fiftieth of 50 mm.
    let deep =
        old.replace("DEPTH-5.000", "DEPTH -50").replace("DIST25.000", "SET UP 2").replace("Z+25", "Z+2");
    assert!(run(&deep).0[..6] == [r(2.0), r(2.0), f(-3.0), r(2.0), r(-2.0), f(-6.0)]);
    let (_, message) = refused("BEGIN PGM T MM\nL X0 Y0 Z2 FMAX\nCYCL DEF 1.1 DIST 2\n", Control::Heidenhain);
    assert!(message.contains("does not follow"), "{message}");
    let head = "BEGIN PGM T MM\nTOOL CALL 1 Z S600\nL X0 Y0 Z50 R0 FMAX M3\n";
    for (from, to, words) in [
        ("Q257=0", "Q257=2", "Q257"),
        ("Q259=0.5", "Q259=0.2", "Q258"),
        ("Q211=0", "Q211=0 Q379=3", "Q379"),
        ("Q211=0", "Q211=0 Q395=1", "depth below zero"),
        ("Q211=0", "Q211=0 Q999=1", "does not use it"),
    ] {
        let text = format!("{head}{}\nCYCL CALL\n", pecking.replace(from, to));
        let (_, message) = refused(&text, Control::Heidenhain);
        assert!(message.contains(words), "{message}");
    }
}

#[test]
fn the_first_block_of_a_series_may_say_where_the_hole_is() {
    let text = "%\nO1\nG0 G17 G21 G40 G49 G80 G90\nG54\nS600 M3\nG0 Z50.\nG98 G81 X3. Y4. Z-5. R2. F120.\nG80 G0 X0. Y0.\nM30\n%\n";
    let program = read(text, Control::Fanuc).program;
    let ends: Vec<DVec3> = (0..program.items.len())
        .filter_map(|i| match program.items.get(i) {
            Item::Move(m) => {
                if let Target::Tip { point, .. } = m.end {
                    Some(point)
                } else {
                    None
                }
            }
            _ => None,
        })
        .collect();
    assert_eq!(ends[1..], [DVec3::new(3.0, 4.0, 50.0), DVec3::new(0.0, 0.0, 50.0)]);
    assert_eq!(cycles(&program), [Cycle::Drill { reference: 2.0, bottom: -5.0, retract: 50.0, dwell: 0.0 }]);
    // Not as increments, and not without one of them.
    for block in ["G91 G81 X3. Y4. Z-5. R-2. F120.", "G81 X3. Z-5. R2. F120."] {
        let text = format!("%\nO1\nG21 G90 G54\nS600 M3\nG0 Z50.\n{block}\nM30\n%\n");
        assert!(refused(&text, Control::Fanuc).1.contains("has not set"), "{block}");
    }
    // Two codes of motion in a block are refused; the end of a cycle is one to Grbl, and none to LinuxCNC.
    for (block, control) in [("G0 G1 X1", Control::LinuxCnc), ("G0 G80 X1", Control::Grbl)] {
        let (code, _) = refused(&format!("G21 G90 G54\n{block}\nM2\n"), control);
        assert_eq!(code, Code::NC_SYNTAX, "{block}");
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(400))]

    #[test]
    fn any_call_is_read_or_refused(
        parts in prop::collection::vec(prop::sample::select(vec![
            "CYCLE81", "CYCLE82(", "CYCLE83(", "MCALL ", "(", ")", ",", ",,", "-", "1", "2.5", "-20", "1e9", "0", " ", "\n", ";x",
            "CYCL DEF 200 ", "CYCL DEF 203 ", "Q200=", "Q201=-", "Q202=", "CYCL CALL", "G83 ", "Q", "R2 ", "Z-5 ", "X1 ", "G98 ", "999999",
        ]), 0..24),
    ) {
        let text: String = parts.concat();
        for (control, head) in [
            (Control::Sinumerik840d, SINUMERIK),
            (Control::Fanuc, "G21 G90 G54\nS1 M3\nG0 X0. Y0. Z9.\nF9.\n"),
            (Control::LinuxCnc, "G21 G90 G54\nS1 M3\nG0 X0 Y0 Z9\nF9\n"),
            (Control::Heidenhain, "BEGIN PGM A MM\nL X0 Y0 Z9 FMAX\n"),
        ] {
            let text = format!("{head}{text}\n");
            if let Ok(reading) = nc::read(&mut Sources::default(), "any", &text, control, &[setup()]) {
                for cycle in cycles(&reading.program) {
                    prop_assert!(cycle.expansion().is_ok());
                }
            }
        }
    }
}

/// Places of all moves: `R`apid or `F`eed, and the end.
fn places(program: &Program) -> Vec<(char, [f64; 3])> {
    let mut at = [f64::NAN; 3];
    let mut found = Vec::new();
    for i in 0..program.items.len() {
        match program.items.get(i) {
            Item::Move(m) => {
                let Target::Tip { point, .. } = m.end else { continue };
                at = point.to_array();
                let rapid = matches!(program.state(i).speed, Speed::Rapid { .. });
                found.push((if rapid { 'R' } else { 'F' }, at));
            }
            Item::Cycle(_, steps) => {
                for step in steps {
                    let (kind, z) = match *step {
                        CycleStep::Rapid(z) => ('R', z),
                        CycleStep::Feed(z) => ('F', z),
                        _ => continue,
                    };
                    at[2] = z;
                    found.push((kind, at));
                }
            }
            _ => {}
        }
    }
    found
}

#[test]
fn on_a_fanuc_control_the_heights_of_a_series_stay_where_they_were_given() {
    let head = "G17 G21 G40 G49 G80 G90 G94\nG54\nS600 M3\nG0 X0. Y0. Z12.\n";
    let run = |series: &str| {
        let reading = read(&format!("{head}{series}\nG80\nM30\n"), Control::Fanuc);
        places(&reading.program)[1..].to_vec()
    };
    let hole = |x: f64, from: f64, [r, z]: [f64; 2]| {
        [('R', [x, 0.0, from]), ('R', [x, 0.0, r]), ('F', [x, 0.0, z]), ('R', [x, 0.0, r])]
    };
    // Given under G90: G91 behind it counts X and Y alone.
    let found = run("G99 G81 X10. Z-20. R2. F100.\nG91 X5. K2\nG90");
    let wanted =
        [hole(10.0, 12.0, [2.0, -20.0]), hole(15.0, 2.0, [2.0, -20.0]), hole(20.0, 2.0, [2.0, -20.0])];
    assert_eq!(found, wanted.concat());
    // Given under G91: R from where the series began, Z from R; G90 behind it leaves them.
    let found = run("G91 G99 G81 X10. Z-12. R-8. K2 F100.\nG90 X40.");
    let wanted = [hole(10.0, 12.0, [4.0, -8.0]), hole(20.0, 4.0, [4.0, -8.0]), hole(40.0, 4.0, [4.0, -8.0])];
    assert_eq!(found, wanted.concat());
    // Another depth alone counts from the R that stays.
    let found = run("G91 G99 G81 X10. Z-12. R-8. F100.\nX10. Z-5.\nG90");
    assert_eq!(found, [hole(10.0, 12.0, [4.0, -8.0]), hole(20.0, 4.0, [4.0, -1.0])].concat());
}

#[test]
fn linuxcnc_goes_to_the_next_hole_at_the_height_of_its_return() {
    let head = "G17 G21 G40 G49 G80 G90 G94\nG54\nS600 M3\nG0 X0 Y0 Z25\n";
    // Without moves that end where they begin.
    let run = |series: &str| {
        let reading = read(&format!("{head}{series}\nG80\nM2\n"), Control::LinuxCnc);
        let mut found = places(&reading.program);
        found.dedup_by_key(|(_, place)| *place);
        found[1..].to_vec()
    };
    let hole = |[x, y]: [f64; 2], from: f64, back: f64| {
        let moves = [('R', from), ('R', 2.0), ('F', -5.0), ('R', back)];
        let mut moves = moves.map(|(kind, z)| (kind, [x, y, z])).to_vec();
        moves.dedup_by_key(|(_, place)| *place);
        moves
    };
    // From R across and up to where the series began, then down.
    let found = run("G99 G81 X10 Y0 Z-5 R2 F100\nX20\nG98 X30 Y10\nX40");
    let wanted = [
        hole([10.0, 0.0], 25.0, 2.0),
        hole([20.0, 0.0], 2.0, 2.0),
        hole([30.0, 10.0], 25.0, 25.0),
        hole([40.0, 10.0], 25.0, 25.0),
    ];
    assert_eq!(found, wanted.concat());
    // A higher R behind a hole: across and up, too.
    let found = run("G99 G81 X10 Z-5 R2 F100\nX20 R10");
    assert_eq!(found[4], ('R', [20.0, 0.0, 10.0]));
}

#[test]
fn the_interpreter_takes_one_code_of_a_group_and_one_use_of_axis_words() {
    let head = "G17 G21 G90 G94\nG54\nG0 X0 Y0 Z5\n";
    for (control, block, why) in [
        (Control::LinuxCnc, "G28 G1 X5 F100", "both use its axis words"),
        (Control::LinuxCnc, "G0 G10 L2 P1 R30", "both use its axis words"),
        (Control::Grbl, "G28 G0 X5", "both use its axis words"),
        (Control::LinuxCnc, "M7 M8", "says this twice"),
        (Control::LinuxCnc, "M48 M49", "says this twice"),
        (Control::Grbl, "M8 M9", "says this twice"),
        (Control::LinuxCnc, "N-1 G0 X5", "a block number is not negative"),
        (Control::Fanuc, "N-1 G0 X5.", "a block number is not negative"),
    ] {
        let (_, message) = refused(&format!("{head}{block}\nM2\n"), control);
        assert!(message.contains(":4:") && message.contains(why), "{block}: {message}");
    }
    // A Fanuc control takes both.
    read(&format!("{head}G0 G28 Z5.\nM8 M9\nM30\n"), Control::Fanuc);
    // An end of a cycle beside a move, and several signs.
    let reading = read(&format!("{head}G80 G0 X--5 Y- +2\nG1 G80 X+-7 F100\nM2\n"), Control::LinuxCnc);
    assert_eq!(places(&reading.program)[1..], [('R', [5.0, -2.0, 5.0]), ('F', [-7.0, -2.0, 5.0])]);
    for control in [Control::Grbl, Control::Fanuc] {
        refused(&format!("{head}G0 X--5\nM2\n"), control);
    }
}
