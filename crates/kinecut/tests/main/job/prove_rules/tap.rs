//! Taps: feed and speed, the hand, the core hole.

use kinecut::base::{Code, Severity};

use super::*;

/// A tap M7 of a pitch of 1 mm, whose core hole is that of the drill.
const TAP: &str = "[[tool]]\nnumber = 3\ntype = \"tap\"\ndiameter = 7\npitch = 1\nflute_length = 15\nstickout = 40\n\
    gauge_length = 120\n";

/// A hole at X15 Y8, and a thread at a place.
fn tapped(thread: &str) -> Outcome {
    tapped_with(TAP, thread)
}

fn tapped_with(tool: &str, thread: &str) -> Outcome {
    let program = format!(
        "%\nO9\nG17 G21 G40 G49 G80 G90 G94\nT2 M6\nG54 G0 X15. Y8. S2000 M3\nG43 H2 Z20. M8\n\
         G99 G81 X15. Y8. Z-10. R2. F150.\nG80\nG0 Z20. M9\nM5\nT3 M6\nG54 G0 X15. Y8. S300 M3\nG43 H3 Z20. M8\n\
         {thread}\nG0 Z20. M9\nM5\nM30\n%\n"
    );
    outcome(&job("fanuc", "", tool, PLAIN), &program)
}

#[test]
fn a_right_thread_breaks_no_rule() {
    right(&tapped("M29 S300\nG99 G84 X15. Y8. Z-7. R5. F300.\nG80"));
    right(&tapped("M29 S300\nG95 G99 G84 X15. Y8. Z-7. R5. F1.\nG80 G94"));
}

#[test]
fn a_feed_that_is_not_pitch_times_speed_is_wrong() {
    let block = "G99 G84 X15. Y8. Z-7. R5. F1.";
    // The pitch written for the feed per minute.
    told(&tapped(&format!("M29 S300\n{block}\nG80")), Code::TAP_FEED, Severity::Error, block);
    let near = "G99 G84 X15. Y8. Z-7. R5. F300.01";
    told(&tapped(&format!("M29 S300\n{near}\nG80")), Code::TAP_FEED, Severity::Error, near);
    let left = "G99 G74 X15. Y8. Z-7. R5. F300.";
    told(&tapped(&format!("M29 S300\n{left}\nG80")), Code::TAP_FEED, Severity::Error, left);
    told(&tapped("G0 Z2.\nG1 Z-7. F300.\nZ2."), Code::TAP_FEED, Severity::Error, "G1 Z-7. F300.");
}

#[test]
fn a_tap_without_its_core_hole_meets_material() {
    let block = "G99 G84 X30. Y20. Z-7. R5. F300.";
    let outcome = tapped(&format!("G0 X30. Y20.\nM29 S300\n{block}\nG80"));
    told(&outcome, Code::TAP_MEETS, Severity::Error, block);
}

#[test]
fn a_tapping_cycle_with_a_tool_that_is_no_tap_is_wrong() {
    let drill = TAP.replace("\"tap\"", "\"drill\"").replace("pitch = 1\n", "");
    let block = "G99 G84 X15. Y8. Z-7. R5. F300.";
    told(&tapped_with(&drill, &format!("M29 S300\n{block}\nG80")), Code::TAP_FEED, Severity::Error, block);
}
