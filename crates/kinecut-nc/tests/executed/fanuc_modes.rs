//! Words of FANUC and Haas that move no axis by themselves, and words that are refused with their reason.

use crate::{moves, read, refused};
use kinecut_nc::base::Severity;
use kinecut_nc::nc::Control::{Fanuc, Haas, LinuxCnc};

/// Severities and messages about a block.
fn said(block: &str, control: kinecut_nc::nc::Control) -> Vec<(Severity, String)> {
    let text = format!("G21 G54 G0 X0. Y0. Z0.\n{block}\nX1.\nM30\n");
    let reading = read(&text, control).expect(block);
    assert_eq!(moves(&reading), ["R 0 0 0", "R 1 0 0"], "{block}");
    reading.findings.iter().map(|f| (f.severity, f.message.clone())).collect()
}

#[test]
fn modes_are_said_and_move_no_axis() {
    for block in [
        "G5.1 Q1",
        "G05.1 Q0",
        "G5 P10000",
        "G05 P0",
        "G08 P1",
        "G22 X100. Y100. Z50. I0 J0 K-50.",
        "G23",
        "G26",
        "G25",
    ] {
        let said = said(block, Fanuc);
        assert!(
            matches!(&said[..], [(Severity::Note, message)] if message.contains(&format!("`{block}`")) && message.contains("not followed")),
            "{block}: {said:?}"
        );
    }
    assert!(said("G5.1 Q1", Fanuc)[0].1.contains("rounds corners"));
    for block in ["G103 P1", "G187 P3"] {
        assert!(matches!(&said(block, Haas)[..], [(Severity::Note, _)]), "{block}");
    }
    assert!(said("M48", Fanuc)[0].1.contains("overrides"));
}

#[test]
fn the_tolerance_of_g187_is_said_in_millimetres() {
    assert!(said("G187 P1 E0.05", Haas)[0].1.contains("by 0.05 mm"));
    let text = "G20 G54 G0 X0. Y0. Z0.\nG187 E0.002\nM30\n";
    let reading = read(text, Haas).unwrap();
    assert!(reading.findings.iter().any(|f| f.message.contains("by 0.0508 mm")), "{:?}", reading.findings);
}

#[test]
fn curves_that_the_control_lays_through_lines_are_a_doubt() {
    let said = said("G5.1 Q2 X0 Y0 Z0", Fanuc);
    assert!(said.iter().any(|(s, m)| *s == Severity::Doubt && m.contains("lays curves")), "{said:?}");
}

#[test]
fn what_is_known_and_not_read_says_why() {
    for (block, why) in [
        ("G47 P0 X0. Y0. (TEXT)", "letters"),
        ("G150 P1000 Z-1.", "outline"),
        ("G77 Z-1. R-2. Q0.1", "counterbore"),
    ] {
        let error = refused(block, Haas);
        assert!(error.contains("a.nc:2:1") && error.contains(why), "{error}");
    }
    for (block, why) in [("G31 Z-1.", "machine only"), ("G7.1 C10.", "cylinder"), ("G44 H1", "G43")] {
        assert!(refused(block, Fanuc).contains(why), "{block}");
    }
    // Not words of another control.
    assert!(refused("G187 P1", LinuxCnc).contains("kinecut does not know"));
}
