//! Plain blocks, which are read in one go, mean what they mean where each is read word by word.
//!
//! A blank between a letter and its number counts for nothing on these controls, and takes a block the long way.

use crate::moves;
use kinecut_nc::base::Sources;
use kinecut_nc::nc::{self, Control, ReadSettings};
use kinecut_nc::program::Item;
use proptest::prelude::*;

/// All that a program is: its moves with their states, and what was found, without places.
fn meaning(text: &str, control: Control) -> (Vec<String>, Vec<String>) {
    let mut sources = Sources::default();
    let file = sources.add("a.nc", text.to_owned());
    let settings = ReadSettings { reads_on: true, ..ReadSettings::default() };
    match nc::read_source(&sources, file, control, &[], &settings) {
        Ok(reading) => {
            let items = &reading.program.items;
            let mut said = moves(&reading);
            for i in 0..items.len() {
                let line = reading.program.origin(i).span.map(|span| sources.line(span));
                let item = items.get(i);
                // Lengths of a text are those of its letters.
                if !matches!(item, Item::Text(_)) {
                    said.push(format!("{line:?} {item:?} {:?}", reading.program.state(i)));
                }
            }
            let found = reading.findings.iter().chain(&reading.errors);
            (said, found.map(|f| format!("{:?} {}", f.severity, f.message.replace(' ', ""))).collect())
        }
        Err(error) => (Vec::new(), vec![error.0.message.replace(' ', "")]),
    }
}

/// A blank behind the first letter of each line.
fn apart(text: &str) -> String {
    let line = |line: &str| match line.chars().next() {
        Some(letter) if letter.is_ascii_alphabetic() && letter != 'O' => {
            format!("{letter} {}\n", &line[1..])
        }
        _ => format!("{line}\n"),
    };
    text.lines().map(line).collect()
}

fn plain() -> impl Strategy<Value = String> {
    let number = prop_oneof![
        (-50i32..50).prop_map(|n| format!("{n}.")),
        (-5000i32..5000).prop_map(|n| format!("{}", f64::from(n) / 100.0)),
        Just("0".to_owned()),
        Just("-.5".to_owned()),
        Just("+1.50".to_owned()),
    ];
    let word = (prop::sample::select(vec!["X", "Y", "Z", "x"]), number).prop_map(|(a, n)| a.to_owned() + &n);
    let code = prop::sample::select(vec!["", "", "", "G0 ", "G1 ", "G01", "G00 ", "N7 G1 ", "N8 ", "g1 "]);
    let feed = prop::sample::select(vec!["", "", "", " F100.", " F2.5", " F0", " F300", " F-1."]);
    (code, prop::collection::vec(word, 1..4), feed).prop_map(|(c, w, f)| format!("{c}{}{f}", w.join(" ")))
}

fn state() -> impl Strategy<Value = String> {
    let lines = [
        "G90",
        "G91",
        "G20",
        "G21",
        "G93",
        "G94",
        "G95",
        "G55",
        "G54",
        "G17",
        "G18",
        "G40",
        "G80",
        "G64",
        "G61",
        "S500 M3",
        "M5",
        "T2 M6",
        "G43 H2",
        "G49",
        "G53 G0 Z0.",
        "G28 Z0.",
        "G28",
        "G52 X1.",
        "G52 X0.",
        "G92 X0. Y1.",
        "G68 X0. Y0. R30.",
        "G69",
        "G51 X0. Y0. Z0. P2.",
        "G50",
        "G51.1 X0.",
        "G50.1 X0.",
        "G16",
        "G15",
        "G41 D1 X3.",
        "G42 D2 X5. F9.",
        "G41 D1",
        "G1 F50. S9 M3\nG42 D2",
        "G41 D1 G1 X30. F50.\nX40. Y9.\nG40",
        "G2 X1. Y1. R9.",
        "G3 I2.",
        "G81 X1. Y2. Z-5. R1. F50.",
        "G83 X1. Z-5. R1. Q2. F50.",
        "G7",
        "G8",
        "G98",
        "G99",
        "M98 P5",
        "M0",
        "A10.",
        "G1 A0. X1.",
        "G1 X5. ,R1.",
        "G1 X5. ,C1.",
        "G66 P5 A1.",
        "G67",
        "G4 P1.",
        "G10 L2 P1 X1. Y1. Z1.",
        "(said)",
        "M29",
        "#1=5",
        "X#1",
        "G77",
        "G5 X1. Y1. I1. J1. P1. Q1.",
        "G33 Z1. K1.",
        "G38.2 Z-1. F5.",
        "G12 I5. Z-1. D0",
        "G41.1 D.2 X3.",
        "G43.1 Z1.",
        "M70",
        "M72",
    ];
    prop::sample::select(lines.to_vec()).prop_map(str::to_owned)
}

/// The first move after `G40` moves in the plane: a plain block that does not is refused as any other.
#[test]
fn the_end_of_a_compensation_is_no_plain_block() {
    for control in [Control::LinuxCnc, Control::Fanuc] {
        let ends = |last: &str| {
            format!(
                "G21 G90 G54 G94 G64 S500 M3\nT1 M6\nG0 X0. Y0. Z0. F100.\nG41 D1 G1 X30.\nX40. Y9.\nG40\n{last}\nM30\n"
            )
        };
        let wrong = meaning(&ends("Z3."), control);
        assert!(wrong.1.iter().any(|f| f.contains("doesnotmoveintheplane")), "{control} {:?}", wrong.1);
        assert_eq!(wrong, meaning(&apart(&ends("Z3.")), control));
        assert!(meaning(&ends("X50. Y9."), control).1.iter().all(|f| !f.starts_with("Error")));
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(400))]

    #[test]
    fn a_plain_block_means_what_its_words_mean(
        lines in prop::collection::vec(prop_oneof![3 => plain(), 1 => state()], 1..40), known in any::<bool>(),
    ) {
        let begin = if known { "G21 G90 G54 G94 G64 S500 M3\nT1 M6\nG0 X0. Y0. Z0. F100.\n" } else { "" };
        let text = format!("{begin}{}\nM30\nO5\nX2.\nX3. Y1.\nM99\n", lines.join("\n"));
        for control in [Control::LinuxCnc, Control::Grbl, Control::GrblHal, Control::Fanuc, Control::Haas] {
            prop_assert_eq!(meaning(&text, control), meaning(&apart(&text), control), "{} {}", control, text);
        }
    }
}
