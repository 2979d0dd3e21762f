//! Tool changes that are called for though the tool is in the spindle: they stay.

use kinecut::base::Sources;
use kinecut::nc::{self, Control, PostSettings};
use kinecut::program::{Item, Program};

fn read(text: &str, control: Control) -> Program {
    let reading = nc::read(&mut Sources::default(), "test", text, control, &[]);
    reading.unwrap_or_else(|e| panic!("{e}\n{text}")).program
}

fn written(program: &Program, control: Control) -> String {
    nc::write(program, &[], &PostSettings::new(control)).unwrap_or_else(|e| panic!("{e}")).text.to_string()
}

/// Tools that are called, with their lengths, and whether again.
fn calls(program: &Program) -> Vec<(u32, Option<u32>, bool)> {
    let items = &program.items;
    let call = |i| match items.get(i) {
        Item::Tool { id, length, again, .. } => Some((id.0, length, again)),
        _ => None,
    };
    (0..items.len()).filter_map(call).collect()
}

const TWICE: &str = "G17 G21 G90 G94\nT1 M6\nG43 H1\nG54\nS1000 M3\nG0 X0 Y0\nZ5\nM6\nS1000 M3\nG0 X1 Y1\nZ5\nG1 Z1 F100\nM6\n\
    M6\nT2\nM6\nG43 H2\nM2\n";

#[test]
fn a_second_change_without_t_stays() {
    let program = read(TWICE, Control::LinuxCnc);
    let wanted = [
        (1, Some(1), false),
        (1, Some(1), true),
        (1, Some(1), true),
        (1, Some(1), true),
        (2, Some(2), false),
    ];
    assert_eq!(calls(&program), wanted);
    for control in [Control::LinuxCnc, Control::Fanuc] {
        let text = written(&program, control);
        assert_eq!(text.matches("M6\n").count(), 5, "{text}");
        let back = read(&text, control);
        let again: Vec<bool> = calls(&back).iter().map(|c| c.2).collect();
        assert_eq!(again, [false, true, true, true, false], "{text}");
        // The place after it is the control's: it is said anew.
        let after = text.split("M6\n").nth(2).unwrap();
        assert!(after.contains("X1") && after.contains("Y1"), "{text}");
    }
}

#[test]
fn another_length_of_the_same_tool_is_no_change() {
    let text = "G21 G90\nT1 M6\nG43 H1\nG54\nG0 X0 Y0 Z5\nG43 H3\nZ4\nM2\n";
    let program = read(text, Control::LinuxCnc);
    assert_eq!(calls(&program), [(1, Some(1), false), (1, Some(3), false)]);
    assert_eq!(written(&program, Control::LinuxCnc).matches("M6\n").count(), 1);
}
