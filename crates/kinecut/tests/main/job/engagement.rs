//! Engagement of the tools in a job: by block in `engagement.json`, left out where it is not wanted.

use std::f64::consts::PI;

use kinecut::job::engagement_json;
use serde_json::Value;

use super::external::{FANUC, PLAIN, job, outcome};
use crate::common::job::run_program;

/// The blocks of the first setup.
fn blocks(json: &str) -> Vec<Value> {
    let all: Value = serde_json::from_str(json).unwrap();
    all["setups"][0]["blocks"].as_array().unwrap().clone()
}

#[test]
fn blocks_tell_arc_depth_chip_and_rate() {
    let done = outcome("fanuc", PLAIN, FANUC).unwrap();
    let json = engagement_json(&done).unwrap();
    let blocks = blocks(&json);
    let lines: Vec<u64> = blocks.iter().map(|b| b["line"].as_u64().unwrap()).collect();
    // The plunge, the slot, and the two holes.
    assert_eq!(lines, [9, 10, 17, 18], "{json}");
    let value = |i: usize, name: &str| blocks[i][name].as_f64().unwrap();
    let near = |i: usize, name: &str, expected: f64, by: f64| {
        assert!((value(i, name) - expected).abs() <= by, "{i} {name}: {} {expected}", value(i, name));
    };
    near(0, "arc", 360.0, 10.0);
    near(0, "removed", PI * 16.0 * 3.0, 3.0);
    near(0, "chip", 200.0 / 3000.0 / 2.0, 1e-6);
    // From Z 2 to Z 0, one stretch of 0.75 mm more or less.
    near(0, "air", 2.0, 0.75);
    near(1, "arc", 180.0, 2.0);
    near(1, "depth", 3.0, 1e-3);
    near(1, "width", 8.0, 0.01);
    near(1, "chip", 400.0 / 3000.0 / 2.0, 1e-4);
    near(1, "removed", 720.0, 5.0);
    near(1, "rate", 720.0 / (30.0 / 400.0 * 60.0), 20.0);
    near(1, "air", 0.0, 0.01);
    near(2, "removed", PI * 9.0 * 10.0, 6.0);
    near(2, "chip", 150.0 / 2000.0 / 2.0, 1e-6);
    let all: Value = serde_json::from_str(&json).unwrap();
    let sum: f64 = (0..4).map(|i| value(i, "removed")).sum();
    assert!((sum / all["removed"].as_f64().unwrap() - 1.0).abs() < 1e-9, "{sum}");
    let section = kinecut::job::report::of_job(&done).sections;
    assert!(section.iter().any(|s| s.title == "Engagement of the tools"));
}

#[test]
fn it_is_left_out_where_the_job_or_the_command_says_so() {
    let text = job("fanuc", PLAIN).replace("{ step = 0.5 }", "{ step = 0.5, engagement = false }");
    let done = run_program(&text, FANUC).unwrap();
    assert!(done.simulation.engagement.is_none() && engagement_json(&done).is_none());
    assert!(
        !kinecut::job::report::of_job(&done).sections.iter().any(|s| s.title == "Engagement of the tools")
    );
}

#[test]
fn unasked_it_is_measured_for_programs_of_less_than_20_000_moves() {
    let measured = |moves: usize| {
        let cuts: String = (0..moves).map(|k| format!("X{}.{}\n", 15 + k % 2, k % 10)).collect();
        let program = format!(
            "%\nO7\nG17 G21 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X15. Y20. S3000 M3\nG43 H1 Z20.\nG1 Z5. F200.\n{cuts}G0 Z20.\nM30\n%\n"
        );
        let done = run_program(&job("fanuc", PLAIN).replace("step = 0.5", "step = 4.0"), &program).unwrap();
        (done.setups[0].trace.segments.len(), done.simulation.engagement.is_some())
    };
    let (few, is_measured) = measured(19_900);
    assert!(few < 20_000 && is_measured, "{few}");
    let (many, is_measured) = measured(20_000);
    assert!(many >= 20_000 && !is_measured, "{many}");
}
