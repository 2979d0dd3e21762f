//! The same rules for what kinecut has planned.

use kinecut::base::{Code, Severity};

use super::*;

/// A bore of 20 through the plate.
fn bore(at: &str, more: &str) -> String {
    format!(
        r#"[[setup.operation]]
type = "bore"
tool = 1
at = {at}
diameter = 20
depth = 12
breakthrough = 1
strategy = "involute"
speed = 3000
rough = {{ stepover = 3, allowance = 0.3, feed = 600, plunge_feed = 200 }}
finish = {{ feed = 400 }}
{more}"#
    )
}

fn planned(mill: &str, operations: &str) -> Outcome {
    let more = "[machine]\ncode = \"2103\"\ndynamics = { rapid = 24000 }";
    outcome(&job("fanuc", mill, more, operations), "")
}

#[test]
fn a_bore_in_the_stock_breaks_no_rule() {
    right(&planned("", &bore("[30, 20]", "")));
}

#[test]
fn a_bore_beside_the_stock_is_wrong_and_one_that_breaks_out_is_not_proven() {
    let found = |at: &str| {
        let outcome = planned("", &bore(at, ""));
        let worst = outcome.verdict.found.iter().find(|f| f.code == Code::BESIDE_STOCK).cloned();
        (worst.map(|f| f.severity), outcome.verdict.is_safe())
    };
    assert_eq!(found("[150, 20]"), (Some(Severity::Error), false));
    // Its centre is beside the stock; it is within, but the side is cut open; two millimetres of wall stay.
    assert_eq!(found("[62, 20]"), (Some(Severity::Error), false));
    assert_eq!(found("[52, 20]"), (Some(Severity::Doubt), false));
    assert_eq!(found("[48, 20]"), (None, true));
}

#[test]
fn an_operation_that_another_has_done_already_removes_nothing() {
    let twice = format!("{}\n{}", bore("[30, 20]", ""), bore("[30, 20]", ""));
    let outcome = planned("", &twice);
    let found: Vec<_> = outcome.verdict.found.iter().filter(|f| f.code == Code::NOTHING_REMOVED).collect();
    assert_eq!(found.len(), 1, "{:?}", outcome.verdict.found);
    assert!(found[0].severity == Severity::Doubt && found[0].message.contains("bore 20 at X30 Y20"));
    assert!(found[0].place.is_some());
}

#[test]
fn limits_of_the_tool_hold_for_what_is_planned() {
    let operations = bore("[30, 20]", "");
    assert!(!blocks(&planned("max_speed = 2000", &operations), Code::SPINDLE_WRONG).is_empty());
    assert!(!blocks(&planned("max_feed = 500", &operations), Code::FEED_TOO_FAST).is_empty());
    let table = format!("table = -12.5\n{operations}");
    assert_eq!(blocks(&planned("", &table), Code::BELOW_STOCK).len(), 1);
}
