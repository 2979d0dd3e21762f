//! Messages to the operator: messages on controls that show them, comments elsewhere, and text in any case.

use kinecut::base::Sources;
use kinecut::nc::{self, Control, PostSettings};
use kinecut::program::{Frame, Item, Origin, Program, SetupId, State, StopKind, WorkOffset};
use proptest::prelude::*;

fn read(text: &str, control: Control) -> Program {
    let reading = nc::read(&mut Sources::default(), "test", text, control, &[]);
    reading.unwrap_or_else(|e| panic!("{e}\n{text}")).program
}

fn written(program: &Program, control: Control) -> String {
    let settings = PostSettings { block_numbers: false, ..PostSettings::new(control) };
    nc::write(program, &[], &settings).unwrap_or_else(|e| panic!("{e}")).text.to_string()
}

fn messages(program: &Program) -> Vec<String> {
    let items = &program.items;
    let message = |i| match items.get(i) {
        Item::Message(text) => Some(text.to_owned()),
        _ => None,
    };
    (0..items.len()).filter_map(message).collect()
}

/// A program of a message and its end.
fn saying(text: &str) -> Program {
    let mut program = Program::default();
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let state = State::start(SetupId(0), frame);
    program.push_message(text, &state, Origin::default());
    program.push_stop(StopKind::End, &state, Origin::default());
    program
}

#[test]
fn messages_stay_messages() {
    // Before the first block, in a block, in any case; after a semicolon, or with a blank before the comma, it is a comment.
    let text = "( head )\n(MSG, turn the part)\nG21 G90 ( msg,clamp it )\n; MSG, not this\n(MSG , nor this)\nG54\nG0 X0 Y0 Z5\nM2\n";
    let program = read(text, Control::LinuxCnc);
    assert_eq!(messages(&program), ["turn the part", "clamp it"]);
    let again = written(&program, Control::LinuxCnc);
    assert!(again.contains("\n(MSG,turn the part)\n") && again.contains("\n(MSG,clamp it)\n"), "{again}");
    assert_eq!(messages(&read(&again, Control::LinuxCnc)), messages(&program));
    let siemens = written(&program, Control::Sinumerik840d);
    assert!(siemens.contains("\nMSG(\"clamp it\")\n"), "{siemens}");
    assert_eq!(messages(&read(&siemens, Control::Sinumerik840d)), messages(&program));
    // FANUC has comments only, and reads them so.
    assert_eq!(
        messages(&read(&text.replace("; MSG, not this", "").replace("M2", "M30"), Control::Fanuc)),
        [""; 0]
    );
    let fanuc = written(&program, Control::Fanuc);
    assert!(fanuc.contains("\n(CLAMP IT)\n"), "{fanuc}");
    let klartext = written(&program, Control::Heidenhain);
    assert!(klartext.contains("; clamp it\n"), "{klartext}");
}

#[test]
fn a_message_is_taken_away_where_it_stays() {
    let text = "G710 G90 G54\nMSG(\"one\")\nG0 X0 Y0 Z5\nMSG()\nM30\n";
    let program = read(text, Control::Sinumerik840d);
    assert_eq!(messages(&program), ["one", ""]);
    let again = written(&program, Control::Sinumerik840d);
    assert!(again.contains("MSG(\"one\")\n") && again.contains("MSG()\n"), "{again}");
    assert!(!written(&program, Control::LinuxCnc).contains("(MSG,)"));
}

#[test]
fn text_does_not_leave_its_marks() {
    let program = saying("say \"hi\" (now); 100 %\nM30 \u{fc}");
    let said = |control| written(&program, control);
    assert!(said(Control::LinuxCnc).contains("(MSG,say \"hi\" [now]; 100 % M30 ?)\n"));
    assert!(said(Control::Sinumerik840d).contains("MSG(\"say 'hi' (now); 100 % M30 ?\")\n"));
    // Characters that Grbl takes out of its stream wherever they are.
    let grbl = written(&saying("stop! go~ on?"), Control::Grbl);
    assert!(grbl.contains("(MSG,stop. go- on.)\n"), "{grbl}");
    // Too long for one: the rest is a comment.
    let long = written(&saying(&"word ".repeat(60)), Control::LinuxCnc);
    assert_eq!(long.matches("(MSG,").count(), 1, "{long}");
    assert_eq!(long.matches("word").count(), 60, "{long}");
}

proptest! {
    #![proptest_config(kinecut_cases::property(64))]
    /// Any text is a message, or nothing, and never a block.
    #[test]
    fn any_text_stays_text(text in "[A-Z ]{0,12}[(),;%$\n\r\u{1b}\u{fc}/#\\[\\]\"!~?]{0,4}[A-Z0-9 \"()]{1,160}") {
        for control in Control::WRITTEN.iter().copied() {
            let first = written(&saying(&text), control);
            let back = read(&first, control);
            let others = (0..back.items.len())
                .filter(|i| !matches!(back.items.get(*i), Item::Text(_) | Item::Message(_)))
                .count();
            prop_assert_eq!(others, 1, "{}:\n{}", control, first);
            if control.has_messages() && !text.trim().is_empty() {
                prop_assert_eq!(messages(&back).len(), 1, "{}:\n{}", control, first);
            }
            prop_assert_eq!(messages(&read(&written(&back, control), control)), messages(&back));
        }
    }
}
