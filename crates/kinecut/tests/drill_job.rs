//! Drilling in a job: from the file to a proven program on every control.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

use kinecut::base::{Code, MemoryLoader, Severity, Silent};
use kinecut::job::Outcome;
use kinecut::program::ToolNumber;
use kinecut::trace::Motion;

const CONTROLS: [&str; 5] = ["sinumerik-840d", "fanuc", "linuxcnc", "grbl", "heidenhain"];

/// A plate of 60 x 40 x 20 mm with one drilling.
fn plate(control: &str, tool: &str, operation: &str) -> String {
    format!(
        r#"
        format = 1
        stock = {{ box = {{ min = [-30, -20, -20], max = [30, 20, 0] }} }}
        post = {{ control = "{control}", decimals = 3 }}
        simulate = {{ step = 0.5 }}
        [[tool]]
        number = 2
        type = "drill"
        flute_length = 60
        {tool}
        [[setup]]
        offset = "G54"
        safe_height = 20
        [[setup.operation]]
        type = "drill"
        tool = 2
        {operation}
        "#
    )
}

fn run(text: &str) -> Outcome {
    kinecut::job::run("job.toml", text, &MemoryLoader::default(), &Silent).unwrap()
}

fn program(outcome: &Outcome) -> &str {
    &outcome.setups[0].posted.text
}

/// Feed per revolution and end height of each feed move [mm].
fn feeds(outcome: &Outcome) -> Vec<(f64, f64)> {
    let spindle = outcome.setups[0].planned.drillings[0].holes[0].plan.spindle / std::f64::consts::TAU;
    let of = |motion: Motion| if let Motion::Feed(f) = motion { Some(f / spindle) } else { None };
    let segments = outcome.setups[0].trace.segments.iter();
    segments
        .filter_map(|s| Some(((of(s.motion)? * 1e5).round() / 1e5, (s.curve.end().z * 1e4).round() / 1e4)))
        .collect()
}

#[test]
fn zones_are_posted_read_back_and_cut_on_every_control() {
    for control in CONTROLS {
        let text = plate(
            control,
            "diameter = 10",
            "points = [[-15, 0], [15, 5]]
             entry = { surface = \"plane\" }
             exit = { surface = \"plane\" }
             length = 20
             speed = 1200
             feed_per_rev = { entry = 0.1, steady = 0.2, exit = 0.05 }",
        );
        let outcome = run(&text);
        assert!(outcome.verdict.safe, "{control}: {:?}\n{}", outcome.verdict.found, program(&outcome));
        // The point is 3.0043 mm long; a slower zone contains the exact one.
        let expected = [(0.1, -3.005), (0.2, -20.0), (0.05, -25.005)];
        assert_eq!(feeds(&outcome), [expected, expected].concat(), "{control}\n{}", program(&outcome));
        assert!(outcome.verdict.proven.iter().any(|p| p.claim.contains("wall")), "{control}");
    }
}
