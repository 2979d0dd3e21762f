//! Macros that are called after each block that moves: `G66`, `G67`.

use crate::{read, refused, run};
use kinecut_nc::base::Severity;
use kinecut_nc::nc::Control::{Fanuc, Haas};

#[test]
fn a_macro_runs_after_each_move_and_not_after_its_own() {
    let body =
        "G66 P9 A2.\nM8\nG0 X10.\n#100=1.\nG0 X20.\nG67\nX30.\nM30\nO9\nG91 G1 Z-#1 F100.\nZ#1\nG90 G0\nM99";
    assert_eq!(
        run(body, Fanuc),
        ["R 10 0 0", "F 10 0 -2", "F 10 0 0", "R 20 0 0", "F 20 0 -2", "F 20 0 0", "R 30 0 0"]
    );
    // L times, after each.
    let body = "G66 P9 L2\nG0 X10.\nG67\nM30\nO9\nG91 Y1.\nG90\nM99";
    assert_eq!(run(body, Fanuc), ["R 10 0 0", "R 10 1 0", "R 10 2 0"]);
}

#[test]
fn a_macro_within_another_is_called_by_the_moves_of_the_later() {
    let body = "G66 P8\nG66 P9\nG0 X10.\nG67\nG0 X20.\nG67\nG0 X30.\nM30\nO8\nG91 G0 Z1.\nG90\nM99\nO9\nG91 G0 Y1.\nG90\nM99";
    assert_eq!(run(body, Fanuc), ["R 10 0 0", "R 10 1 0", "R 10 1 1", "R 20 1 1", "R 20 1 2", "R 30 1 2"]);
}

#[test]
fn moves_of_a_subprogram_call_it_too() {
    let body = "G66 P9\nM98 P7\nG67\nM30\nO7\nG0 X10.\nM99\nO9\nG91 G0 Y1.\nG90\nM99";
    assert_eq!(run(body, Fanuc), ["R 10 0 0", "R 10 1 0"]);
}

#[test]
fn a_macro_that_changes_its_arguments_is_a_doubt() {
    let text = |what: &str| {
        format!("G21 G54 G0 X0. Y0. Z0.\nG66 P9 A1.\nG0 X5.\nX6.\nG67\nM30\nO9\nG0 Y#1\n{what}=#1+1.\nM99\n")
    };
    let doubts = |what: &str| {
        let reading = read(&text(what), Fanuc).unwrap();
        reading.findings.iter().filter(|f| f.severity == Severity::Doubt).count()
    };
    assert_eq!([doubts("#1"), doubts("#2")], [1, 0]);
}

#[test]
fn what_is_not_followed_is_refused() {
    assert!(refused("G66.1 P9\nG0 X1.\nM30\nO9\nM99", Fanuc).contains("every block"));
    assert!(refused("G66 P9\nG0 X1.\nM30\nO9\nM99", Haas).contains("not published"));
    assert!(refused("G66 A1.", Fanuc).contains("without the number"));
    assert!(refused("G66 P9\nG0 X1.", Fanuc).contains("O9"));
    assert!(refused("G66 P9\nG0 X1. M98 P8\nM30\nO8\nM99\nO9\nM99", Fanuc).contains("two blocks"));
    assert!(refused("G65 P9\nM30\nO9\nG66 P8\nM99\nO8\nM99", Fanuc).contains("within a macro"));
    assert!(refused("G67 X1.", Fanuc).contains("block of its own"));
    assert!(refused("G66 P9\nG1 X5. ,R1. F100.\nY5.\nM30\nO9\nM99", Fanuc).contains(",R1."));
}
