//! A FANUC program that is read is written for a FANUC and read again: the same path, and the same text from then on.

use crate::read;
use kinecut_nc::nc::Control::Fanuc;
use kinecut_nc::nc::{self, PostSettings, Reading};
use kinecut_nc::program::{Item, Spindle, Target};

/// Places of moves and heights of cycles in the work offset, with what turns: all that cuts.
fn cuts(reading: &Reading) -> Vec<String> {
    let program = &reading.program;
    let number =
        |v: f64| if v.is_nan() { "?".to_owned() } else { format!("{:.3}", (v * 1e3).round() / 1e3 + 0.0) };
    let mut said = Vec::new();
    for i in 0..program.items.len() {
        let state = program.state(i);
        let turns = if state.spindle == Spindle::Off { "-" } else { "+" };
        match program.items.get(i) {
            Item::Move(motion) => {
                let Target::Tip { point, .. } = motion.end else { continue };
                let (offset, to_work) = program.in_work(state.frame).expect("a frame in a work offset");
                let at = to_work.point(point).to_array().map(number).join(" ");
                said.push(format!("{offset} {at} {turns} {:?}", state.comp));
            }
            Item::Cycle(cycle, _) => said.push(format!("{:?}", cycle.heights().map(number))),
            Item::Dwell(seconds) => said.push(format!("wait {}", number(seconds))),
            Item::Stop(kind) => said.push(format!("{kind:?}")),
            _ => {}
        }
    }
    // A move that stays is not written.
    said.dedup();
    said
}

#[test]
fn what_is_read_is_written_and_read_again() {
    let bodies = [
        "G1 X20. ,R5. F100.\nY10. ,C2.\nG3 X10. Y20. R10. ,R1.\nG1 X0.",
        "G18 G1 X20. ,R5. F100.\nZ-10. ,C3.\nX0.\nG17",
        "G54.1 P7\nG0 X1. Y1. Z1.\nG1 X2. F100.\nG54.1 P300\nG0 X1. Y1. Z1.\nG1 X2.",
        "G0 Z25.\nG98 G76 X10. Y5. Z-10. R2. Q0.5 P100 F100.\nX20.\nG80",
        "G0 Z25.\nG98 G87 X10. Y5. Z-4. R-12. Q0.5 F100.\nG80",
        "G0 Z25.\nG99 G88 X10. Z-10. R2. P500 F100.\nG80",
        "G51 X10. Y10. P2000\nG1 X20. Y10. F100.\nG3 X10. Y20. R10.\nG50\nG1 X1.",
        "G51.1 X0.\nG41 D1 G1 X10. F100.\nY20.\nG2 X20. Y30. R10.\nG1 Y40.\nG40 X0.\nG50.1 X0.",
        "G51 X0 Y0 P2000\nG68 X10. Y0 R90.\nG1 X20. Y0 F100.\nG69\nG50\nG1 X20.",
        "G66 P9 A2.\nG0 X10.\nX20.\nG67\nM30\nO9\nG91 G1 Z-#1 F100.\nZ#1\nG90 G0\nM99",
    ];
    let settings = PostSettings::new(Fanuc);
    for body in bodies {
        let text = format!("G21 G90 G54 G0 X0. Y0. Z0.\nS500 M3\n{body}\nM30\n");
        let first = read(&text, Fanuc).expect(body);
        let written = nc::write(&first.program, &[], &settings).expect(body).text;
        let second = read(&written, Fanuc).unwrap_or_else(|e| panic!("{body}\n{written}\n{e}"));
        assert_eq!(cuts(&first), cuts(&second), "{body}\n{written}");
        let again = nc::write(&second.program, &[], &settings).expect(body).text;
        assert_eq!(written, again, "{body}");
    }
}
