//! Coolant, units, and the time that a program takes.

use kinecut::base::{Code, Severity};

use super::*;

#[test]
fn coolant_that_one_tool_lacks_is_told_and_a_dry_program_is_right() {
    let one = GOOD.replace("G43 H2 Z20. M8", "G43 H2 Z20.");
    told(&fanuc(&one), Code::NEVER_STARTED, Severity::Warning, "G99 G81 X15. Y8. Z-10. R2. F150.");
    right(&fanuc(&one.replace(" M8", "").replace(" M9", "")));
}

#[test]
fn a_program_moves_in_one_unit() {
    let changed = mill("G1 Z-2. F200.\nX45. F400.\nG20\nX1. F10.");
    told(&fanuc(&changed), Code::NC_ASSUMED, Severity::Warning, "G20");
    // A word that changes nothing, and one before the first move.
    right(&fanuc(&mill("G21 G1 Z-2. F200.\nX45. F400.")));
    right(&fanuc(&mill("G1 Z-2. F200.\nX45. F400.").replace("G17 G21", "G20\nG17 G21")));
    right(&fanuc(&mill("G1 Z-2. F200.\nX45. F400.\nG20\nG21")));
}

#[test]
fn a_move_of_many_hours_is_told() {
    let outcome = fanuc(&mill("G1 Z-2. F200.\nX45. F0.1"));
    told(&outcome, Code::ABSURD_RUN, Severity::Warning, "X45. F0.1");
    assert!(blocks(&fanuc(&mill("G1 Z-2. F200.\nX45. F5.")), Code::ABSURD_RUN).is_empty());
}
