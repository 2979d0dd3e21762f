//! Threads of a job: core holes checked and measured, each control's own cycle, feed over speed the pitch.

use std::path::Path;

use kinecut::base::{Code, DiskLoader, Severity, Silent};
use kinecut::job::Outcome;
use kinecut::program::{Cycle, CycleStep, Item, SAME_PITCH, Spindle};
use kinecut::trace::SegmentPace;

fn attempt(replace: &[(&str, &str)]) -> kinecut::base::Result<Outcome> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/16_tapped_plate");
    let mut text = std::fs::read_to_string(folder.join("job.toml")).unwrap();
    for (from, to) in [("step = 0.2", "step = 0.4")].iter().chain(replace) {
        assert!(text.contains(from), "`{from}` is not in the example");
        text = text.replace(from, to);
    }
    kinecut::job::run("job.toml", &text, &DiskLoader::new(folder), &Silent)
}

fn run(replace: &[(&str, &str)]) -> Outcome {
    attempt(replace).unwrap_or_else(|e| panic!("{e}"))
}

/// Pitch, speed [rev/s] and path speed [mm/s] of each thread of the text, as the control reads it.
fn threads(outcome: &Outcome) -> Vec<(f64, Spindle, f64)> {
    let done = &outcome.setups[0];
    let mut found = Vec::new();
    for segment in done.trace.segments.iter().filter(|s| !s.alternative) {
        let item = segment.item as usize;
        if let (Item::Cycle(Cycle::Tap(tapping), steps), SegmentPace::Feed(feed)) =
            (done.program.items.get(item), segment.motion)
        {
            assert!(steps.iter().all(|s| !matches!(s, CycleStep::Feed(_))));
            found.push((tapping.pitch, done.program.state(item).spindle, feed));
        }
    }
    found
}

#[test]
fn every_control_taps_the_plate_and_keeps_feed_to_speed() {
    for (control, word) in [
        ("fanuc", "G84"),
        ("sinumerik-840d", "CYCLE84("),
        ("heidenhain", "CYCL DEF 207"),
        ("linuxcnc", "G33.1"),
    ] {
        let outcome = run(&[("\"fanuc\"", &format!("\"{control}\""))]);
        assert!(outcome.verdict.is_safe(), "{control}: {:#?}", outcome.verdict.found);
        assert!(outcome.setups[0].posted.text.contains(word), "{control}");
        let found = threads(&outcome);
        // In and out, four M8 and one M12.
        assert_eq!(found.len(), 10, "{control}");
        for (i, (pitch, spindle, feed)) in found.into_iter().enumerate() {
            let wanted = if i < 8 { 1.25 } else { 1.75 };
            let per_turn = feed / (spindle.rate() / std::f64::consts::TAU);
            assert!(
                (pitch - wanted).abs() <= SAME_PITCH && (per_turn - wanted).abs() <= SAME_PITCH,
                "{control}"
            );
            assert!(matches!(spindle, Spindle::Clockwise(_)), "{control}");
        }
        let claims: Vec<&str> = outcome.verdict.proven.iter().map(|p| p.claim.as_str()).collect();
        assert!(claims.iter().any(|c| c.starts_with("5 threads: the core hole is free")), "{claims:?}");
        assert!(
            format!("{:?}", outcome.verdict).contains("the thread that a tap makes"),
            "it is said to be not compared"
        );
    }
}

#[test]
fn the_core_holes_stay_as_they_were_drilled() {
    let tapped = run(&[]);
    let bores = &tapped.deviation.bores;
    assert_eq!(bores.len(), 5);
    for bore in bores {
        assert!(bore.worst() < 1e-3, "{bore:?}");
    }
    // The lowest point of the tap: 16 of thread and three pitches of lead.
    let low = tapped.setups[0].trace.segments.iter().filter(|s| matches!(s.motion, SegmentPace::Feed(_)));
    let m8 = low.filter(|s| s.tool.is_some_and(|t| t.0 == 3)).map(|s| s.curve.end().z).fold(0.0, f64::min);
    assert!((m8 + 16.0 + 3.75).abs() < 1e-9, "{m8}");
}

#[test]
fn a_left_hand_tap_turns_to_the_left_in_and_out() {
    for (control, word) in
        [("fanuc", "G74"), ("sinumerik-840d", ",-1.25,"), ("heidenhain", "Q239=-1.25"), ("linuxcnc", "M4")]
    {
        let left = ("pitch = 1.25", "pitch = 1.25\nhand = \"left\"");
        let outcome = run(&[("\"fanuc\"", &format!("\"{control}\"")), left]);
        assert!(outcome.verdict.is_safe(), "{control}: {:#?}", outcome.verdict.found);
        assert!(outcome.setups[0].posted.text.contains(word), "{control}");
        let found = threads(&outcome);
        assert!(
            found[..8].iter().all(|(_, spindle, _)| matches!(spindle, Spindle::CounterClockwise(_))),
            "{control}"
        );
        assert!(
            found[8..].iter().all(|(_, spindle, _)| matches!(spindle, Spindle::Clockwise(_))),
            "{control}"
        );
    }
}

/// The error of a job that must not be planned: code and message.
fn refused(replace: &[(&str, &str)]) -> (Code, String) {
    let error = attempt(replace).err().unwrap_or_else(|| panic!("{replace:?} is planned"));
    (error.code(), error.to_string())
}

#[test]
fn a_tap_that_does_not_fit_its_core_hole_is_refused_with_numbers_and_help() {
    let short = [("chamfer = \"C\"", "lead = 2"), ("depth = 21.5", "depth = 14.2")];
    let (code, text) = refused(&short);
    assert_eq!(code, Code::TAP_CORE);
    for part in ["14.2 deep", "16 + 2.5 (lead) + 1.25", "drill to 19.8"] {
        assert!(text.contains(part), "no `{part}` in {text}");
    }
    // Just deep enough.
    assert!(run(&[("chamfer = \"C\"", "lead = 2"), ("depth = 21.5", "depth = 19.75")]).verdict.is_safe());
    let (code, text) = refused(&[("diameter = 6.8", "diameter = 6.4")]);
    assert_eq!(code, Code::TAP_CORE);
    for part in ["is 6.4", "smallest is 6.647", "breaks", "drill 6.75"] {
        assert!(text.contains(part), "no `{part}` in {text}");
    }
    let (code, text) = refused(&[("diameter = 6.8", "diameter = 7.2")]);
    assert!(code == Code::TAP_CORE && text.contains("largest is 6.916"), "{text}");
    let (code, text) = refused(&[("points = [[0, 0]]\ndepth = 25", "points = [[0, 1]]\ndepth = 25")]);
    assert!(code == Code::TAP_CORE && text.contains("no core hole"), "{text}");
}

#[test]
fn a_forming_tap_wants_a_wider_core_hole_and_its_maker_has_the_last_word() {
    let forming = ("pitch = 1.25", "pitch = 1.25\nforming = true");
    assert!(run(&[forming, ("diameter = 6.8", "diameter = 7.4")]).verdict.is_safe());
    let outcome = run(&[forming]);
    let warning = outcome.verdict.found.iter().find(|f| f.code == Code::TAP_CORE).unwrap();
    assert_eq!(warning.severity, Severity::Warning);
}

#[test]
fn a_core_hole_that_is_only_said_is_found_missing_in_the_stock() {
    let said = "points = [[10, 10]]\ncore = { diameter = 10.2 }\ndepth = 25";
    let outcome = run(&[("points = [[0, 0]]\ndepth = 25", said)]);
    let found = outcome.verdict.found.iter().find(|f| f.code == Code::TAP_MEETS);
    assert!(found.is_some_and(|f| f.severity == Severity::Error), "{:#?}", outcome.verdict.found);
    assert!(!outcome.verdict.is_safe());
}

#[test]
fn a_core_hole_of_the_raw_stock_is_one() {
    let raw =
        ("format = 1", "format = 1\ndrilled = [{ at = [10, 10], diameter = 10.2, top = 0, bottom = -25 }]");
    let outcome = run(&[raw, ("points = [[0, 0]]\ndepth = 25", "points = [[10, 10]]\ndepth = 25")]);
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
}

#[test]
fn a_core_hole_of_a_setup_before_is_one() {
    let second = (
        "[[setup.operation]]\ntype = \"tap\"\ntool = 3",
        "[[setup]]\noffset = \"G55\"\nzero = [10, 0, -1]\n",
    );
    let moved = format!("{}\n{}", second.1, second.0);
    let shifted = [
        (second.0, moved.as_str()),
        ("depth = 16", "top = 1\ndepth = 16"),
        ("points = [[0, 0]]\ndepth = 25", "points = [[-10, 0]]\ntop = 1\ndepth = 25"),
    ];
    // The places of the four holes are still those of the first zero.
    let (code, text) = refused(&shifted);
    assert!(code == Code::TAP_CORE && text.contains("M8x1.25 at X-30 Y-20: there is no core hole"), "{text}");
    let tap = "tool = 3\npattern = { grid = { at = [-30, -20]";
    let right = [&shifted[..], &[(tap, "tool = 3\npattern = { grid = { at = [-40, -20]")]].concat();
    let outcome = run(&right);
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
}

#[test]
fn grbl_and_a_short_run_up_are_refused_with_the_reason() {
    let (code, text) = refused(&[("\"fanuc\"", "\"grbl\"")]);
    assert!(code == Code::POST_CONTROL && text.contains("synchronised spindle"), "{text}");
    let (code, text) = refused(&[("depth = 16", "depth = 16\napproach = 2")]);
    assert!(code == Code::JOB_VALUE && text.contains("3.75"), "{text}");
    let (code, text) = refused(&[("type = \"tap\"\ntool = 3", "type = \"tap\"\ntool = 1")]);
    assert!(code == Code::JOB_REFERENCE && text.contains("T1 is no tap"), "{text}");
}
