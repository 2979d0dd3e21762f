//! Facets that set the time of a program, against the curve that they stand for.

use std::f64::consts::PI;
use std::fmt::Write;

use kinecut::base::{Code, Severity};
use kinecut::job::{GivenFile, ProgramWants, given_alone};
use kinecut::machine::{CoordinateCode, Dynamics, Machine};
use kinecut::verbs::check::{ProgramSheet, program_sheet};

const RADIUS: f64 = 20.0;
const TURNS: u32 = 10;

/// Ten turns of R 20 in this many straight moves each, at a feed [mm/min], within a tolerance [mm].
fn sheet(facets: u32, feed: f64, tolerance: f64) -> ProgramSheet {
    let mut text =
        format!("G21 G90 G94 G54\nT1 M6\nG43\nM3 S1000\nG64 P{tolerance}\nG0 X20 Y0 Z5\nG1 Z-1 F{feed}\n");
    for i in 1..=facets * TURNS {
        let (y, x) = (2.0 * PI * f64::from(i) / f64::from(facets)).sin_cos();
        writeln!(text, "X{:.5} Y{:.5}", RADIUS * x, RADIUS * y).unwrap();
    }
    text += "M2\n";
    let dynamics = Dynamics { rapid: Some(500.0), acceleration: Some(5000.0), jerk: Some(50_000.0) };
    let machine = Machine::new(CoordinateCode::parse("2103").unwrap(), [None; 3], dynamics).unwrap();
    let wants = ProgramWants { machine: Some(machine), ..ProgramWants::default() };
    let program = GivenFile { name: "round.ngc", bytes: text.as_bytes() };
    program_sheet(&given_alone(program, &wants, false).unwrap()).unwrap()
}

#[test]
fn facets_at_whose_joints_the_control_brakes_are_found_with_the_time_of_their_curve() {
    // 0.6 mm long, 1.8 degrees each: at 0.1 um they are passed far below the feed.
    let found = sheet(200, 6000.0, 0.0001);
    let note = found.findings.iter().find(|f| f.code == Code::FACETS).unwrap();
    assert_eq!(note.severity, Severity::Note);
    // The curve at its feed: 2 pi 20 mm x 10 / 100 mm/s.
    let curve = 2.0 * PI * RADIUS * f64::from(TURNS) / 100.0;
    assert!(note.message.contains(&format!("points {curve:.0} s")), "{curve} {}", note.message);
    assert!(found.time > 1.25 * curve, "{}", found.time);
    // The sagitta of a facet: 20 mm (1 - cos 0.9 degrees), rounded up to a micrometre.
    let sagitta = RADIUS * (1.0 - (PI / 200.0).cos());
    assert!(
        (0.002..0.003).contains(&sagitta) && note.help.contains("within 0.003 mm"),
        "{sagitta} {}",
        note.help
    );
    assert!((8..=2007).contains(&note.place.as_ref().unwrap().line));
}

#[test]
fn facets_that_hold_the_feed_are_not_told() {
    for (facets, feed, tolerance) in [(200, 300.0, 0.01), (200, 3000.0, 0.1), (3, 6000.0, 0.001)] {
        let found = sheet(facets, feed, tolerance);
        assert!(
            found.findings.iter().all(|f| f.code != Code::FACETS),
            "{facets} {feed} {:?}",
            found.findings
        );
    }
}
