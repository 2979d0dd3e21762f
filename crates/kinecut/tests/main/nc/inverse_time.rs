//! Inverse time (`G93`, `FT`): the time of a move is that of all blocks it becomes, on every control.

use glam::DVec3;
use kinecut::base::Sources;
use kinecut::nc::{self, Control, PostSettings};
use kinecut::program::{Item, Program, Speed, Target};

const HEAD: &str = "G17 G21 G40 G49 G80 G90 G94\nT1 M6\nG43 H1\nG54\nG64\nG0 X0 Y0\nZ25\nG93\n";

fn read(text: &str, control: Control) -> Program {
    let reading = nc::read(&mut Sources::default(), "test", text, control, &[]);
    reading.unwrap_or_else(|e| panic!("{e}\n{text}")).program
}

/// Times and lengths of the moves in inverse time.
fn timed(program: &Program) -> Vec<(f64, f64)> {
    let mut at = DVec3::NAN;
    let mut found = Vec::new();
    for i in 0..program.items.len() {
        let Item::Move(motion) = program.items.get(i) else { continue };
        let Target::Tip { point, .. } = motion.end else { continue };
        if let Speed::Duration(seconds) = program.state(i).speed {
            found.push((seconds, motion.curve(at).unwrap().length()));
        }
        at = DVec3::from_array([0, 1, 2].map(|k| if point[k].is_nan() { at[k] } else { point[k] }));
    }
    found
}

fn written(program: &Program, control: Control, arcs: bool) -> String {
    let settings = PostSettings { arcs, ..PostSettings::new(control) };
    nc::write(program, &[], &settings).unwrap_or_else(|e| panic!("{control}: {e}")).text.to_string()
}

/// Moves that one control or another takes in several blocks.
const MOVES: [&str; 7] = [
    "G2 Z-23.13 J1.96473 I-8.59839 P2 F13.08",
    "G3 R2.09 Z1.8849 Y-0.77014 F14.69",
    "G3 X0 Y0 I10 P5 F2",
    "G2 X0 Y20 Z0 J10 P17 F0.5",
    "G18 G2 X8 Z17 I8 K0 F30",
    "G5 X20 Y5 I5 J5 P-3 Q4 F7.5",
    "G3 X0.004 Y0 I0.002 Z24 F1200",
];

#[test]
fn blocks_of_a_move_share_its_time() {
    for text in MOVES {
        let text = format!("{HEAD}{text}\nG94\nG0 Z50\nM2\n");
        let program = read(&text, Control::LinuxCnc);
        let wanted: f64 = timed(&program).iter().map(|t| t.0).sum();
        for (control, arcs) in Control::WRITTEN.iter().flat_map(|c| [(*c, true), (*c, false)]) {
            let posted = written(&program, control, arcs);
            let found = timed(&read(&posted, control));
            let seconds: f64 = found.iter().map(|t| t.0).sum();
            assert!(
                (seconds - wanted).abs() < 2e-6 * wanted,
                "{control}: {seconds} of {wanted}\n{text}\n{posted}"
            );
            // At one speed all the way.
            let length: f64 = found.iter().map(|t| t.1).sum();
            for (time, way) in found.iter().filter(|t| t.1 > 2e-3) {
                assert!(
                    (way / time - length / seconds).abs() < 1e-3 * length / seconds,
                    "{control}: {way} in {time}, {length} in {seconds}\n{posted}"
                );
            }
        }
    }
}

#[test]
fn a_block_of_its_own_keeps_its_number() {
    let text = format!("{HEAD}G2 X8 Y0 I4 F13.08\nG94\nG0 Z50\nM2\n");
    let program = read(&text, Control::LinuxCnc);
    for control in [Control::LinuxCnc, Control::Fanuc, Control::Sinumerik840d, Control::Grbl] {
        assert!(
            written(&program, control, true).contains("F13.08\n"),
            "{}",
            written(&program, control, true)
        );
    }
    // Two turns of a helix: half the time each, where each is a block.
    let text = format!("{HEAD}G2 X0 Y0 Z15 I4 P2 F10\nG94\nG0 Z50\nM2\n");
    let fanuc = written(&read(&text, Control::LinuxCnc), Control::Fanuc, true);
    assert_eq!(fanuc.matches(" F20.\n").count(), 2, "{fanuc}");
    assert!(written(&read(&text, Control::LinuxCnc), Control::LinuxCnc, true).contains("P2 F10\n"));
}
