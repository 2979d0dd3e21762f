//! Patterns of holes of a Haas: `G70`, `G71`, `G72`.
//!
//! Expected values are worked out by hand: radius 10 at 30 degrees is (8.6603, 5).

use crate::{refused, run};
use kinecut_nc::nc::Control::{Fanuc, Haas};

/// Places of the holes of a program that starts 25 above.
fn holes(body: &str) -> Vec<String> {
    let done = run(&format!("G0 Z25.\n{body}\nG80"), Haas);
    (1..done.len())
        .filter(|i| done[*i].starts_with('H'))
        .map(|i| {
            assert_eq!(done[i], "H 2 -5 2");
            let at: Vec<&str> = done[i - 1].split(' ').collect();
            format!("{} {}", at[1], at[2])
        })
        .collect()
}

#[test]
fn holes_are_made_on_a_circle() {
    let circle = ["8.6603 5", "-5 8.6603", "-8.6603 -5", "5 -8.6603"];
    assert_eq!(holes("G81 G99 Z-5. R2. L0 F100.\nG70 I10. J30. L4"), circle);
    // With the clock; and with the cycle in the same block, about a centre that it says.
    assert_eq!(
        holes("G81 G99 Z-5. R2. L0 F100.\nG70 I10. J30. L-4"),
        ["8.6603 5", "5 -8.6603", "-8.6603 -5", "-5 8.6603"]
    );
    assert_eq!(holes("G70 G81 G99 X1. Y2. I10. J0. L2 Z-5. R2. F100."), ["11 2", "-9 2"]);
    // The word does not last: the next block is a hole of the cycle.
    assert_eq!(holes("G81 G99 Z-5. R2. L0 F100.\nG70 I10. J0. L1\nX3."), ["10 0", "3 0"]);
}

#[test]
fn holes_are_made_on_an_arc_and_on_a_line() {
    let cycle = "G81 G99 Z-5. R2. L0 F100.\n";
    assert_eq!(holes(&format!("{cycle}G71 I10. J0. K-30. L3")), ["10 0", "8.6603 -5", "5 -8.6603"]);
    assert_eq!(holes(&format!("{cycle}G72 I10. J90. L3")), ["0 0", "0 10", "0 20"]);
    assert_eq!(holes(&format!("{cycle}G72 I-10. J0. L2")), ["0 0", "-10 0"]);
}

#[test]
fn heights_are_those_of_the_series() {
    let body = "G0 Z25.\nG81 G98 Z-5. R2. L0 F100.\nG70 I10. J0. L2\nG80";
    assert_eq!(run(body, Haas), ["R 0 0 25", "R 10 0 25", "H 2 -5 25", "R -10 0 25", "H 2 -5 25"]);
}

#[test]
fn a_pattern_needs_its_words_and_a_cycle() {
    assert!(refused("G70 I10. J0. L4", Haas).contains("without a cycle"));
    assert!(
        refused("G0 Z25.\nG81 Z-5. R2. L0 F100.\nG80\nG70 I10. J0. L4", Haas).contains("without a cycle")
    );
    let cycle = "G0 Z25.\nG81 Z-5. R2. L0 F100.\n";
    assert!(refused(&format!("{cycle}G70 J0. L4"), Haas).contains("without I"));
    assert!(refused(&format!("{cycle}G71 I10. J0. L4"), Haas).contains("without K"));
    assert!(refused(&format!("{cycle}G70 I10. J0. L0"), Haas).contains("number of holes"));
    assert!(refused(&format!("{cycle}G72 I10. J0. L-4"), Haas).contains("number of holes"));
    assert!(refused(&format!("{cycle}G70 I-10. J0. L4"), Haas).contains("positive"));
    assert!(refused("G70 I10. J0. L4", Fanuc).contains("not understood"));
}
