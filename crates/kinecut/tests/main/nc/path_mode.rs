//! The passage between moves: the distances that a program gives stay what they are, however often it is read and written.

use kinecut::base::{Code, Severity, Sources};
use kinecut::nc::{self, Control, PostSettings, Reading};
use kinecut::program::{Blend, Item, Program};

fn read(text: &str, control: Control) -> Reading {
    nc::read(&mut Sources::default(), "test", text, control, &[]).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn written(program: &Program, control: Control) -> String {
    nc::write(program, &[], &PostSettings::new(control)).unwrap_or_else(|e| panic!("{e}")).text.to_string()
}

fn with(word: &str) -> String {
    format!("G17 G21 G90 G94\nT1 M6\nG43 H1\nG54\nS1000 M3\n{word}\nG0 X0 Y0 Z5\nG1 X2 F120\nY3\nM2\n")
}

/// Passage of the last move.
fn blend(reading: &Reading) -> Blend {
    let moves = (0..reading.program.items.len()).rev();
    let last = moves.clone().find(|i| matches!(reading.program.items.get(*i), Item::Move(_)));
    reading.program.state(last.unwrap()).blend
}

#[test]
fn both_distances_of_g64_stay_as_they_are() {
    let within = |path, merge| Blend::Tolerance { path, merge, angle: 0.0 };
    let cases = [
        // Left out, Q is P.
        ("G64 P0.1", within(0.1, 0.1), "G64 P0.1 Q0.1\n"),
        ("G64 P0.1 Q0", within(0.1, 0.0), "G64 P0.1 Q0\n"),
        ("G64 P0.1 Q0.05", within(0.1, 0.05), "G64 P0.1 Q0.05\n"),
        ("G64", Blend::Continuous, "G64\n"),
        // P0 is no tolerance, not the exact path.
        ("G64 P0", Blend::Continuous, "G64\n"),
        ("G64 P0 Q0", Blend::Continuous, "G64\n"),
    ];
    for (word, wanted, said) in cases {
        let mut text = with(word);
        for pass in 0..3 {
            let reading = read(&text, Control::LinuxCnc);
            assert_eq!(blend(&reading), wanted, "{word}, pass {pass}");
            text = written(&reading.program, Control::LinuxCnc);
            assert!(text.contains(said), "{word}, pass {pass}:\n{text}");
        }
    }
    let inch = read(&with("G20\nG64 P0.01 Q0.02\nG21"), Control::LinuxCnc);
    let Blend::Tolerance { path, merge, .. } = blend(&inch) else { panic!() };
    assert!((path - 0.254).abs() < 1e-12 && (merge - 0.508).abs() < 1e-12);
}

#[test]
fn merging_without_a_tolerance_is_noted() {
    for word in ["G64 Q0.5", "G64 P0 Q0.5"] {
        let reading = read(&with(word), Control::LinuxCnc);
        assert_eq!(blend(&reading), Blend::Continuous);
        let notes: Vec<_> = reading.findings.iter().filter(|f| f.code == Code::NC_WORD).collect();
        assert_eq!(notes.len(), 1, "{:?}", reading.findings);
        assert!(notes[0].severity == Severity::Note && notes[0].message.contains("Q0.5"), "{:?}", notes[0]);
    }
}

#[test]
fn other_controls_get_the_largest_distance() {
    let program = read(&with("G64 P0.1 Q0.05"), Control::LinuxCnc).program;
    let to = |control| written(&program, control);
    assert!(to(Control::Sinumerik840d).contains("G641 ADIS=0.15\n"), "{}", to(Control::Sinumerik840d));
    assert!(to(Control::Heidenhain).contains("CYCL DEF 32.1 T0.15\n"), "{}", to(Control::Heidenhain));
    let back = read(&to(Control::Sinumerik840d), Control::Sinumerik840d);
    assert!(matches!(blend(&back).bound(), Some(b) if (b - 0.15).abs() < 1e-12));
}

#[test]
fn a_tolerance_of_zero_is_not_written_as_none_at_all() {
    let text = with("G641").replace("T1 M6\nG43 H1", "T1 M6\nD1").replace("M2", "M30").replace("G21", "G710");
    let program = read(&text, Control::Sinumerik840d).program;
    assert!(written(&program, Control::LinuxCnc).contains("G61\n"));
    assert!(written(&program, Control::Sinumerik840d).contains("G641 ADIS=0\n"));
}
