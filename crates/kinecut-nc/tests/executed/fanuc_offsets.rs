//! Work offsets beyond G59 and further reference points of FANUC and Haas.

use crate::{moves, read, refused, run};
use kinecut_nc::base::Severity;
use kinecut_nc::nc::Control::{Fanuc, Haas, LinuxCnc};
use kinecut_nc::nc::{self, PostSettings};
use kinecut_nc::program::{Frame, Item, Program, Target, WorkOffset};

/// Names of the work offsets of the moves.
fn offsets(program: &Program) -> Vec<String> {
    let of = |i: usize| match program.frames[program.state(i).frame.0 as usize] {
        Frame::Work(offset) => offset.to_string(),
        other => format!("{other:?}"),
    };
    let items = &program.items;
    (0..items.len()).filter(|i| matches!(items.get(*i), Item::Move(_))).map(of).collect()
}

#[test]
fn work_offsets_beyond_g59_are_named_by_p() {
    let text = "G21 G90\nG54.1 P1 G0 X1. Y1. Z1.\nG54 P48\nX2. Y1. Z1.\nG54\nX3. Y1. Z1.\nM30\n";
    let reading = read(text, Fanuc).unwrap();
    assert_eq!(offsets(&reading.program), ["G54.1 P1", "G54.1 P48", "G54"]);
    let text = "G21 G90\nG154 P99 G0 X1. Y1. Z1.\nG110\nX2. Y1. Z1.\nG129 X3. Y1. Z1.\nM30\n";
    let reading = read(text, Haas).unwrap();
    assert_eq!(offsets(&reading.program), ["G54.1 P99", "G54.1 P1", "G54.1 P20"]);
    // Another offset, so the place is not known in it.
    assert!(refused("G54.1 P2\nG91 G0 X1.", Fanuc).contains("has not set"));
}

#[test]
fn the_p_of_another_code_is_not_that_of_an_offset() {
    let text = "G21 G90\nG54 G0 X1. Y1. Z1.\nG54 M98 P20\nM30\nO20\nG0 X2.\nM99\n";
    assert_eq!(offsets(&read(text, Fanuc).unwrap().program), ["G54", "G54"]);
    assert!(refused("G54.1 X1.", Fanuc).contains("without its number P"));
    assert!(refused("G54.1 P301", Fanuc).contains("P1 to P300"));
    assert!(refused("G154 P100", Haas).contains("P1 to P99"));
    assert!(refused("G154 P1", Fanuc).contains("not understood"));
    assert!(refused("G54.1 P1", Haas).contains("not understood"));
    assert!(refused("G59.1 G0 X1.", Fanuc).contains("not understood"));
    assert!(refused("G54.1 G4 P100", Fanuc).contains("two codes"));
    assert!(refused("G54 P1", LinuxCnc).contains("P1"));
}

#[test]
fn a_further_offset_is_written_where_the_control_has_it() {
    let text = "G21 G90\nG54.1 P3\nG0 X1. Y1. Z1.\nM30\n";
    let reading = read(text, Fanuc).unwrap();
    let settings = PostSettings::new(Fanuc);
    let written = nc::write(&reading.program, &[], &settings).unwrap().text;
    assert!(written.contains("G54.1 P3\n"), "{written}");
    let again = read(&written, Fanuc).unwrap();
    assert_eq!(offsets(&again.program), ["G54.1 P3"]);
    let error = nc::write(&reading.program, &[], &PostSettings::new(LinuxCnc)).unwrap_err().to_string();
    assert!(error.contains("has no work offset G54.1 P3"), "{error}");
    assert_eq!(WorkOffset::parse("G54.1P0"), None);
}

#[test]
fn the_offset_in_force_is_a_variable() {
    assert_eq!(run("G54.1 P7\nG0 X#4014 Y#4130 Z0.", Fanuc), ["R 54.1 7 0"]);
    assert_eq!(run("G0 X#4014 Y#4130 Z0.", Fanuc), ["R 54 0 0"]);
}

#[test]
fn g30_goes_over_its_point_to_a_place_that_is_a_doubt() {
    let reading = read("G21 G54 G0 X0. Y0. Z5.\nG91 G30 P3 Z10.\nG30 X0.\nM30\n", Fanuc).unwrap();
    assert_eq!(moves(&reading), ["R 0 0 5", "R 0 0 15"]);
    let items = &reading.program.items;
    let joints: Vec<_> = (0..items.len())
        .filter_map(|i| match items.get(i) {
            Item::Move(motion) => match motion.end {
                Target::Joints(joints) => Some(joints),
                _ => None,
            },
            _ => None,
        })
        .collect();
    assert_eq!(
        joints,
        [[None, None, Some(0.0), None, None, None], [Some(0.0), None, None, None, None, None]]
    );
    let doubts: Vec<&str> = reading
        .findings
        .iter()
        .filter(|f| f.severity == Severity::Doubt)
        .map(|f| f.message.as_str())
        .collect();
    assert_eq!(doubts.len(), 2, "{doubts:?}");
    assert!(doubts[0].contains("reference point 3") && doubts[0].contains("1242"), "{doubts:?}");
    assert!(doubts[1].contains("reference point 2") && doubts[1].contains("1241"), "{doubts:?}");
    assert!(refused("G91 G30 P5 Z0.", Fanuc).contains("P2 to P4"));
    assert!(refused("G41 D1 G1 X5. F100.\nG91 G30 Z0.", Fanuc).contains("compensation"));
}

#[test]
fn g28_of_a_haas_cancels_the_tool_length() {
    let text = |end: &str| format!("G21 G54\nT1 M6\nG43 H1 G0 Z50.\nG91 G28 Z0.\nG90 X1. Y1.\n{end}\nM30\n");
    let error = read(&text("G0 Z50."), Haas).unwrap_err();
    assert!(error.starts_with("a.nc:6:4: Z without a tool length"), "{error}");
    for end in ["G43 H1 Z50.", "G53 Z0.", "T2 M6\nG43 H2 Z50.", "G49 Z50."] {
        assert!(read(&text(end), Haas).is_ok(), "{end}");
    }
    assert!(read(&text("G0 Z50."), Fanuc).is_ok());
}
