//! Haas, grblHAL, GRBL, and words of FANUC that change coordinates.
//!
//! Expected values are worked out by hand from the rules of each control.

use crate::{moves, read, refused, run};
use kinecut_nc::base::Sources;
use kinecut_nc::nc::Control::{Fanuc, Grbl, GrblHal, Haas, LinuxCnc, Sinumerik840d};
use kinecut_nc::nc::{self, ReadSettings};

#[test]
fn haas_calls_a_block_by_its_number() {
    let body = "M97 P100 L2\nM30\nN100 G91 G0 X5.\nG90\nM99";
    assert_eq!(run(body, Haas), ["R 5 0 0", "R 10 0 0"]);
    // Five digits are a number, not four and a count.
    assert_eq!(run("M98 P10010\nM30\nO10010\nG0 X1.\nM99", Haas), ["R 1 0 0"]);
}

#[test]
fn haas_repeats_a_cycle_by_l_and_keeps_r() {
    let body = "G0 Z25.\nG99 G82 X10. Z-5. R2. P100 F100.\nG91 X5. L2\nG90 G80\nG0 Z25.\nG82 X0. Z-3. P100 F100.\nG80";
    assert_eq!(
        run(body, Haas),
        [
            "R 0 0 25",
            "R 10 0 25",
            "H 2 -5 2",
            "R 15 0 2",
            "H 2 -5 2",
            "R 20 0 2",
            "H 2 -5 2",
            "R 20 0 25",
            "R 0 0 25",
            "H 2 -3 2"
        ]
    );
}

#[test]
fn dwells_with_a_point_are_seconds_on_haas() {
    let reading = read("G21 G54 G0 X0. Y0. Z0.\nG4 P1.5\nG4 P500\nM30\n", Haas).unwrap();
    let items = &reading.program.items;
    let dwells: Vec<f64> = (0..items.len())
        .filter_map(|i| if let kinecut_nc::program::Item::Dwell(s) = items.get(i) { Some(s) } else { None })
        .collect();
    assert_eq!(dwells, [1.5, 0.5]);
}

#[test]
fn grblhal_returns_to_where_the_block_began() {
    let body = "G0 Z25\nG99 G81 X10 Z-5 R2 F100\nG98 X20";
    assert_eq!(run(body, GrblHal), ["R 0 0 25", "R 10 0 25", "H 2 -5 2", "R 20 0 2", "H 2 -5 2"]);
    assert_eq!(run(body, LinuxCnc), ["R 0 0 25", "R 10 0 25", "H 2 -5 2", "R 20 0 25", "H 2 -5 25"]);
    assert_eq!(run("T1 M6\nG43 H1\nG0 Z5", GrblHal), ["R ? ? 5"]);
    assert!(refused("G41 D1\nG1 X5 F100", GrblHal).contains("G41"));
}

#[test]
fn the_present_position_gets_coordinates() {
    for control in [LinuxCnc, Grbl, GrblHal] {
        // The frame of the moves changes, so the first two are equal places.
        assert_eq!(run("G0 X5 Y1\nG92 X0\nG0 X1 Y2", control), ["R 5 1 0", "R 1 2 0"], "{control}");
        // After a shift a place that is not known could be anywhere.
        let unknown = read("G21 G54 G0 X5 Y0\nG92 X0\nG92 Z1\nM2\n", control).unwrap_err();
        assert!(unknown.contains("whose Z the program has not set"), "{unknown}");
    }
    assert_eq!(
        run("G0 X5\nG92 X0\n#1=#5420\nG92.2\nX[#5420+1]\nG92.3\nX#1", LinuxCnc),
        ["R 5 0 0", "R 6 0 0", "R 0 0 0"]
    );
    assert_eq!(run("G92 X1 Y1\nG52 X3\nX#5420 Y#5421", LinuxCnc), ["R -3 1 0"]);
}

#[test]
fn polar_words_are_radius_and_angle() {
    let body = "G0 Z10.\nG90 G16\nG81 X100. Y30. Z-20. R-5. F200.\nG91 Y120.\nY120.\nG15 G80";
    let done = run(body, Fanuc);
    let holes: Vec<&String> = done.iter().filter(|m| m.starts_with('R')).skip(1).collect();
    assert_eq!(holes, ["R 86.6025 50 10", "R -86.6025 50 10", "R 0 -100 10"]);
    assert_eq!(run("G0 X10. Y5.\nG91 G16 X2. Y90.\nG15", Fanuc), ["R 10 5 0", "R 10 7 0"]);
}

#[test]
fn an_arc_stays_at_a_height_that_is_not_known() {
    let reading = read("G21 G54\nG0 X0 Y0\nG2 X10 I5 F100\nG1 Z-1\nM2\n", LinuxCnc).unwrap();
    assert_eq!(moves(&reading), ["R 0 0 ?", "F 10 0 ? arc", "F 10 0 -1"]);
}

#[test]
fn a_program_may_begin_with_a_colon() {
    let reading = read("%\n:0097\nG21 G54 G0 X1. Y0. Z0.\nM30\n%\n", Fanuc).unwrap();
    assert_eq!(moves(&reading), ["R 1 0 0"]);
}

#[test]
fn radius_registers_are_set_by_macros() {
    let reading = read("G21 G54 G0 X0. Y0. Z0.\n#13001=16.\nG0 X#13001\nM30\n", Fanuc).unwrap();
    assert_eq!(
        (reading.radii.as_slice(), moves(&reading)),
        ([(1, 16.0)].as_slice(), vec!["R 0 0 0".to_owned(), "R 16 0 0".to_owned()])
    );
}

#[test]
fn reading_goes_on_behind_what_is_not_understood() {
    let text = "G21 G54 G0 X0 Y0 Z5\nG1 X1 F100 Q7\nG1 X2\nG91 X1\nG90 G0 X5 Y5 Z5\nM777\nG0 X5 Y5 Z5\nG1 Z1\nG2 X9\nM2\n";
    let settings = ReadSettings { reads_on: true, ..ReadSettings::default() };
    let mut sources = Sources::default();
    let file = sources.add("a.ngc", text);
    let reading = nc::read_source(&sources, file, LinuxCnc, &[], &settings).unwrap();
    let said: Vec<String> = reading.errors.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 3, "{said:?}");
    assert!(said[0].starts_with("a.ngc:2:12: `Q7` is not understood"), "{said:?}");
    assert!(said[1].starts_with("a.ngc:6:1: `M777` is not understood"), "{said:?}");
    assert!(said[2].starts_with("a.ngc:9:"), "{said:?}");
    assert_eq!(moves(&reading).last().unwrap(), "F 5 5 1");
    assert!(nc::read_source(&sources, file, LinuxCnc, &[], &ReadSettings::default()).is_err());
}

#[test]
fn reading_on_ends_with_the_text() {
    for (control, text) in [
        (Haas, "G21 G54 G0 X0. Y0. Z5.\nM97 P100 L2\nM30\nN100 G1 X1. F9.\n"),
        (Fanuc, "O1\nG21 G54 G0 X0. Y0. Z5.\nM98 P2\nM30\nO2\nG1 X1. F9.\n"),
        (LinuxCnc, "G21 G54 G0 X0 Y0 Z5\nM98 P100\nM2\nO100\nG1 X1 F9\n"),
    ] {
        let settings = ReadSettings { reads_on: true, ..ReadSettings::default() };
        let mut sources = Sources::default();
        let file = sources.add("a", text);
        let reading = nc::read_source(&sources, file, control, &[], &settings).unwrap();
        let said: Vec<&str> = reading.errors.iter().map(|e| &*e.message).collect();
        assert_eq!(said.len(), 1, "{control:?} {said:?}");
        assert!(said[0].contains("the file ends within a subprogram"), "{control:?} {said:?}");
    }
}

#[test]
fn the_last_shift_is_taken_again() {
    // The interpreter keeps G52 and G92 in one place, and reads G52 as absolute in G91 too.
    assert_eq!(
        run("G52 X3\nG92.3\nX#5420\nG92.2\nX#5420\nG92.3\nX#5420", LinuxCnc),
        ["R -3 0 0", "R 0 0 0", "R -3 0 0"]
    );
    assert_eq!(run("G91\nG52 X3\nG52 X5\nG90 X#5420", LinuxCnc), ["R -5 0 0"]);
    assert_eq!(run("G92 X3\nG92.1\nG92.3\nX#5420", LinuxCnc), ["R 0 0 0"]);
}

#[test]
fn grbl_is_quoted_and_a_surface_speed_is_said() {
    let error = refused("T1 M6", Grbl);
    assert!(error.contains("GRBL answers error 20") && error.contains("--control grblhal"), "{error}");
    let reading =
        read("G21 G54 G0 X0 Y0 Z0\nG96 S200 D1000 M3\nG1 X1 F100\nG97 S500\nM2\n", LinuxCnc).unwrap();
    assert!(
        reading.findings.iter().any(|f| f.message.contains("by a surface speed (G96)")),
        "{:?}",
        reading.findings
    );
    assert!(refused("G96 M3", LinuxCnc).contains("without S"));
}

#[test]
fn a_program_may_begin_at_a_place_that_is_given() {
    let text = "G21 G54 G91\nG1 X1 F100\nG2 X2 I1 Z-1\nM2\n";
    let mut sources = Sources::default();
    let file = sources.add("a.ngc", text);
    let settings = ReadSettings { start: Some([5.0, 6.0, 7.0]), ..ReadSettings::default() };
    let reading = nc::read_source(&sources, file, LinuxCnc, &[], &settings).unwrap();
    assert_eq!(moves(&reading), ["F 6 6 7", "F 8 6 6 arc"]);
    assert!(read(text, LinuxCnc).unwrap_err().contains("an increment from a position"));
}

#[test]
fn haas_calls_again_with_what_the_call_before_has_left() {
    let body = "G65 P9 L2 A1.\nM30\nO9\nG0 X#1\n#1=#1+5.\nM99";
    assert_eq!(run(body, Haas), ["R 1 0 0", "R 6 0 0"]);
    assert_eq!(run(body, Fanuc), ["R 1 0 0", "R 1 0 0"]);
}

#[test]
fn a_shift_that_stays_beyond_the_program_is_said() {
    for control in [LinuxCnc, Grbl, GrblHal] {
        let reading = read("G21 G54 G0 X5 Y0 Z0\nG92 X0\nM2\n", control).unwrap();
        assert!(reading.findings.iter().any(|f| f.message.contains("stays beyond the program")), "{control}");
    }
}

#[test]
fn an_alarm_of_the_program_ends_it() {
    let settings = ReadSettings { reads_on: true, ..ReadSettings::default() };
    let mut sources = Sources::default();
    let file = sources.add("a.nc", "G21 G54 G0 X0. Y0. Z0.\n#3000=1(ONE)\n#3000=2(TWO)\nM30\n");
    let reading = nc::read_source(&sources, file, Fanuc, &[], &settings).unwrap();
    assert_eq!(reading.errors.len(), 1, "{:?}", reading.errors);
}

#[test]
fn grbl_answers_by_number() {
    for (body, number) in [
        ("G1 X5 Q2 F100", 20),
        ("G1 X5 P2 F100", 36),
        ("M6", 20),
        ("G0 X1 X2", 25),
        ("G0 G1 X1", 21),
        ("G28 G1 X5 F1", 24),
        ("G1 X1", 22),
        ("G2 X10.01 Y0 I5 F100", 33),
        ("G2 X10 Y0 R1 F100", 34),
        ("G2 X10 Y0 F100", 35),
        ("G2 G53 X10 Y0 I5 F100", 30),
        ("G80 X1", 31),
        ("G4", 28),
        ("G10 P1 X1", 28),
        ("G10 L2.5 P1 X1", 23),
        ("G53 G0", 26),
        ("G38.2 F1", 26),
        ("G1 X1.2.3 F1", 2),
        ("G1 X1 =2 F1", 1),
    ] {
        let said = format!("GRBL answers error {number} here");
        let error = refused(body, Grbl);
        assert!(error.contains(&said), "{body}: {error}");
    }
    assert!(!refused("G1 X1", LinuxCnc).contains("answers error"));
    let tape = read("%\nG21 G54 G0 X1\nM2\n", Grbl).unwrap();
    assert!(tape.findings.iter().any(|f| f.message.starts_with("GRBL answers error 1 to a line with `%`")));
    assert!(refused("G1 X1", GrblHal).contains("grblHAL answers error 22 here"));
}

#[test]
fn functions_of_the_machine_are_passed_over_where_that_is_asked_for() {
    let read = |text: &str, control, tolerant| {
        let mut sources = Sources::default();
        let file = sources.add("a.nc", text);
        let settings = ReadSettings { tolerant, ..ReadSettings::default() };
        nc::read_source(&sources, file, control, &[], &settings).map_err(|e| e.to_string())
    };
    let program = |code: &str| format!("O1\nG21 G90 G54\nG0 X1. Y1. Z1.\n{code}\nG1 X2. F100.\nM30\n");
    for (control, code) in [(Fanuc, "M10"), (Haas, "M83"), (Haas, "M52 M61"), (Sinumerik840d, "M40")] {
        let text =
            if control == Sinumerik840d { program(code).replace("O1\nG21", "G71") } else { program(code) };
        let refused = read(&text, control, false).unwrap_err();
        assert!(refused.contains("pass it over with --tolerant"), "{code}: {refused}");
        let said = read(&text, control, true).unwrap().findings;
        let passed: Vec<_> = said.iter().filter(|f| f.message.contains("is passed over")).collect();
        assert_eq!(passed.len(), code.split(' ').count(), "{code}");
        assert!(passed.iter().all(|f| f.severity == kinecut_nc::base::Severity::Warning));
    }
    let own = read("G21 G54 G0 X1 Y1 Z1\nM101 P3 Q4\nM2\n", LinuxCnc, true).unwrap();
    assert!(own.findings.iter().any(|f| {
        f.message.starts_with("`M101` (program of the machine) is passed over, neither followed nor written")
    }));
    // One that is in no table, and words that move an axis, stay errors.
    assert!(!read(&program("M77"), Fanuc, true).unwrap_err().contains("--tolerant"));
    assert!(read(&program("G77 X1."), Fanuc, true).is_err());
}
