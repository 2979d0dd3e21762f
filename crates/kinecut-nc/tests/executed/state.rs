//! Saved states and places, probes, codes of the machine, splines with knots, and what begins at a height that is not known.

use crate::{moves, read, refused, run};
use kinecut_nc::base::{Severity, Sources};
use kinecut_nc::geom::Rigid;
use kinecut_nc::machine::{CodeEffect, OwnCode};
use kinecut_nc::nc::Control::{Fanuc, Grbl, LinuxCnc};
use kinecut_nc::nc::{self, PostSettings, ReadSettings, Reading};
use kinecut_nc::program::{ControlData, Item, Path, Setup, Tcp, WorkOffset};
use kinecut_nc::trace::{CompStart, RegisterState, TraceOptions, trace};

fn written(reading: &Reading) -> Result<String, String> {
    let settings = PostSettings { decimals: 6, ..PostSettings::new(LinuxCnc) };
    nc::write(&reading.program, &[], &settings).map(|p| p.text.to_string()).map_err(|e| e.to_string())
}

#[test]
fn a_state_is_saved_and_taken_again() {
    // The motion code stays; F, the distances and the unit come back.
    let body = "F100 M70\nG91 G20 F10 G1 X1\nM72\nG1 X1";
    assert_eq!(run(body, LinuxCnc), ["F 25.4 0 0", "F 1 0 0"]);
    let speed = run("F100\nM70\nF7\nM72\nG1 X#<_feed>", LinuxCnc);
    assert_eq!(speed, ["F 100 0 0"]);
    assert!(refused("M72", LinuxCnc).contains("M72 without a state that was saved"));
    assert!(refused("M70\nM71\nM72", LinuxCnc).contains("M72 without a state that was saved"));
}

#[test]
fn a_return_takes_a_state_that_m73_has_saved() {
    let body = "o1 sub\nM73\nG91\nX1\no1 endsub\nX1\no1 call\nX1\no2 sub\nM70\nG91\no2 endsub\no2 call\nX1";
    // Behind the first call G90 is in force again, behind the second it is not.
    assert_eq!(run(body, LinuxCnc), ["R 1 0 0", "R 2 0 0", "R 1 0 0", "R 2 0 0"]);
}

#[test]
fn a_place_is_stored_for_the_reference_move() {
    // Known in the work offset: it goes there, over the place that its words say.
    assert_eq!(
        run("X1 Y2 Z3\nG28.1\nX9 Y9 Z9\nG28 Z7\nG30.1\nX0\nG30 X5", LinuxCnc),
        ["R 1 2 3", "R 9 9 9", "R 9 9 7", "R 9 9 3", "R 0 9 3", "R 5 9 3", "R 9 9 3"]
    );
    // A shift moves no axis: the place has other coordinates then.
    assert_eq!(
        run("X1 Y2 Z3\nG28.1\nG52 X10\nX0\nG28 X5", LinuxCnc),
        ["R 1 2 3", "R 0 2 3", "R 5 2 3", "R -9 2 3"]
    );
    // Known in the machine: the move is one of its axes.
    let reading =
        read("G21\nG10 L2 P1 X10 Y20 Z30\nG53 G0 X11 Y22 Z33\nG28.1\nG0 X5 Y5 Z5\nG28\nM2\n", LinuxCnc);
    let text = written(&reading.unwrap()).unwrap();
    assert!(text.contains("G0 X5 Y5 Z5\nG53 G0 X11 Y22 Z33"), "{text}");
    let other = refused("X1\nG28.1\nG55 X2\nG28 X3", LinuxCnc);
    assert!(other.contains("the place to which G28 or G30 goes is not known"), "{other}");
}

#[test]
fn a_probe_ends_nobody_knows_where() {
    let reading = read("G21 G54 G0 X1 Y2 Z3\nG38.2 Z-20 F100\nG0 X5\nM2\n", LinuxCnc).unwrap();
    assert_eq!(moves(&reading), ["R 1 2 3", "R 5 2 ?"]);
    let items = &reading.program.items;
    let probe = ControlData::Probe { kind: 2, place: [None, None, Some(-20.0)] };
    assert!((0..items.len()).any(|i| items.get(i) == Item::Data(probe)));
    assert!(written(&reading).unwrap().contains("F100 G38.2 Z-20"));
    let said = reading.findings.iter().find(|f| f.message.starts_with("a probe stops where it touches"));
    assert_eq!(said.map(|f| f.severity), Some(Severity::Doubt));
    assert_eq!(run("G38.3 Z-1 F10\nG0 Z5", Grbl), ["R 0 0 5"]);
    assert!(refused("G38.2 F1", LinuxCnc).contains("a probe without an axis"));
    assert!(refused("G38.2 Z-1", LinuxCnc).contains("without a feed"));
    // It is not modal.
    assert!(refused("G38.2 Z-1 F10\nX5", LinuxCnc).contains("axis words without a motion code"));
}

#[test]
fn devices_move_nothing() {
    let body = "M64 P1\nM66 P0 L3 Q2\nM68 E0 Q12.5\nM62 P3\nM50 P0\nX1";
    assert_eq!(run(body, LinuxCnc), ["R 1 0 0"]);
    assert!(refused("M64 R1", LinuxCnc).contains("no code of this block uses it"));
}

#[test]
fn a_machine_has_codes_of_its_own() {
    let text = "G21 G54 M428\nG0 X1 Y2 Z3 A10 C20\nM429\nM10\nM2\n";
    let codes =
        [("M428", CodeEffect::TipControl), ("m429", CodeEffect::NoTipControl), ("M10", CodeEffect::NoMotion)];
    let codes = codes.map(|(name, effect)| OwnCode::parse(name, effect).unwrap()).to_vec();
    let mut sources = Sources::default();
    let file = sources.add("a.ngc", text);
    let settings = ReadSettings { codes, ..ReadSettings::default() };
    let reading = nc::read_source(&sources, file, LinuxCnc, &[], &settings).unwrap();
    assert_eq!(reading.program.state(0).tcp, Tcp::Axes);
    assert!(read(text, LinuxCnc).unwrap_err().contains("`M428` is not understood"));
    for own in ["G1", "M3", "G54", "G10"] {
        let codes = vec![OwnCode::parse(own, CodeEffect::NoMotion).unwrap()];
        let settings = ReadSettings { codes, ..ReadSettings::default() };
        let error = nc::read_source(&sources, file, LinuxCnc, &[], &settings).unwrap_err().to_string();
        assert!(
            error.contains(&format!("gives `{own}` an effect, and the language of its control has it")),
            "{error}"
        );
    }
}

#[test]
fn a_spline_has_knots_of_its_own() {
    let row = |x: f64, y: f64, k: u32, more: &str| format!("G6.2 X{x} Y{y} R1 K{k}{more}\n");
    let cubic =
        [row(0.0, 0.0, 0, " P4 Q1"), row(1.0, 2.0, 0, ""), row(3.0, 2.0, 0, ""), row(4.0, 0.0, 0, "")];
    let text = format!("G1 F100\n{}K1\nK1\nK1\nK1\nG1 X9", cubic.concat());
    let reading = read(&format!("G21 G54 G0 X0 Y0 Z0\n{text}\nM2\n"), LinuxCnc).unwrap();
    let items = &reading.program.items;
    let curves: Vec<_> = (0..items.len())
        .filter_map(|i| match items.get(i) {
            Item::Move(motion) => match motion.path {
                Path::Bezier { span } => Some(span),
                _ => None,
            },
            _ => None,
        })
        .collect();
    // Four points of the fourth order between two knots are one cubic.
    assert_eq!(curves.len(), 1);
    assert_eq!(moves(&reading), ["R 0 0 0", "F 4 0 0", "F 9 0 0"]);
    let open = text.replace("K1\nK1\nK1\nK1", "K1\nK2\nK3\nK4");
    assert!(refused(&open, LinuxCnc).contains("as many equal ones as its order"));
    assert!(refused("F1\nG6.2 X0 Y0 K0", LinuxCnc).contains("without its order P"));
    assert!(refused("F1\nG6.2 X5 Y0 K0 P3", LinuxCnc).contains("a spline begins at its first control point"));
    assert!(refused("F1\nG6.2 X0 Y0 K2 P3\nX1 Y1 K1", LinuxCnc).contains("do not fall"));
    assert!(refused("F1\nG6.2 X0 Y0 K0 P3\nX1 Y1 K0\nG6.3", LinuxCnc).contains("fewer control points"));
}

#[test]
fn a_cycle_begins_at_a_height_that_is_not_known() {
    let text = "G21 G54 G90 G0\nG98 G81 X10. Y1. Z-5. R2. F100.\nX20.\nG99 X30.\nX40.\nG80\nM30\n";
    let reading = read(text, Fanuc).unwrap();
    assert_eq!(
        moves(&reading),
        [
            "R 10 1 ?", "R 10 1 2", "H 2 -5 ?", "R 20 1 ?", "R 20 1 2", "H 2 -5 ?", "R 30 1 ?", "R 30 1 2",
            "H 2 -5 2", "R 40 1 2", "H 2 -5 2"
        ]
    );
    let said = "a cycle returns to a height that the program has not set: the ways between its holes are not followed";
    let said: Vec<_> = reading.findings.iter().filter(|f| f.message == said).collect();
    assert_eq!((said.len(), said[0].severity), (1, Severity::Doubt));
    // Down to R and out to R, all but the first way is known.
    let known = read(&text.replace("G98", "G99"), Fanuc).unwrap();
    assert!(known.findings.iter().all(|f| f.severity != Severity::Doubt), "{:?}", known.findings);
    let error = written(&reading).unwrap_err();
    assert!(error.contains("a cycle returns to a height that the program has not set"), "{error}");
    let increment = read("G21 G54 G0 X0. Y0.\nG91 G81 Z-5. R-2. F100.\nM30\n", Fanuc).unwrap_err();
    assert!(increment.contains("the program has not set Z"), "{increment}");
}

#[test]
fn a_helix_begins_at_a_height_that_is_not_known() {
    let reading = read("G21 G54 G0 X-1 Y0\nG2 X1 Z0 R1 F100\nG2 X-1 Z0 R1\nM2\n", LinuxCnc).unwrap();
    assert_eq!(moves(&reading), ["R -1 0 ?", "F 1 0 0 arc", "F -1 0 0 arc"]);
    assert!(reading.findings.iter().any(|f| f.code.to_string() == "KC0529" && f.message.ends_with("line 2")));
    let increment = read("G21 G54 G0 X-1 Y0\nG91 G2 X2 Z1 R1 F100\nM2\n", LinuxCnc).unwrap_err();
    assert!(increment.contains("the program has not set Z"), "{increment}");
}

#[test]
fn a_helix_is_followed_where_the_machine_is_known_to_stand() {
    // Another work offset leaves the tip where it was; the text alone does not tell that height any more.
    let text = "G21 G17 G54 G0 X-1 Y0 Z5\nG55 G0 X-1 Y0\nG2 X1 Y0 Z1 R1 F100\nM2\n";
    let offsets = [WorkOffset::G54, WorkOffset::parse("G55").unwrap()];
    let setup = Setup {
        name: "setup 1".to_owned(),
        part_on_table: Rigid::IDENTITY,
        work_offsets: offsets.map(|offset| (offset, Rigid::IDENTITY)).into(),
        located: false,
        stock: None,
        fixtures: Vec::new(),
    };
    let reading = nc::read(&mut Sources::default(), "a.ngc", text, LinuxCnc, &[setup]).unwrap();
    let options = TraceOptions {
        machine: None,
        tools: &[],
        retract_height: 0.0,
        radii: &[],
        operator: RegisterState::default(),
        comp_start: CompStart::default(),
        chord: 1e-3,
    };
    let trace = trace(&reading.program, &options).unwrap();
    let helix = &trace.segments.last().unwrap().curve;
    assert!((helix.start().z - 5.0).abs() < 1e-12 && (helix.end().z - 1.0).abs() < 1e-12, "{helix:?}");
    // Half a turn of radius 1, down by 4.
    assert!((helix.length() - std::f64::consts::PI.hypot(4.0)).abs() < 1e-9, "{}", helix.length());
}

#[test]
fn an_exchange_of_pallets_stays_one_and_is_not_proven_beyond() {
    let reading = read("G21 G54 G0 X1 Y2 Z3\nM60\nX2\nM2\n", LinuxCnc).unwrap();
    assert!(written(&reading).unwrap().contains("\nM60\n"));
    assert!(reading.findings.iter().any(|f| f.severity == Severity::Doubt && f.message.contains("M60")));
    let other = nc::write(&reading.program, &[], &PostSettings::new(Fanuc)).unwrap_err().to_string();
    assert!(other.contains("an exchange of pallets (M60) is not written"), "{other}");
}
