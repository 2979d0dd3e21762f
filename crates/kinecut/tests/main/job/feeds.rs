//! Feeds of posted programs against the accelerations of the machine, evaluated on the curves that the text says.

use kinecut::base::{Code, Finding, Severity};
use kinecut::job::Outcome;
use kinecut::trace::{Segment, SegmentPace};

use super::examples::run;

const COARSE: (&str, &str) = ("step = 0.2 }", "step = 2.0 }");
const AS_PROGRAMMED: (&str, &str) = ("decimals = 4,", "decimals = 4, feeds = \"as-programmed\",");

/// Largest acceleration [mm/s2] and jerk [mm/s3] of an axis on even runs along the blocks of the text at their feeds.
fn asked(outcome: &Outcome) -> [f64; 2] {
    const PLACES: u32 = 60;
    let at_feed = |s: &Segment| match s.motion {
        SegmentPace::Feed(feed) => Some(feed),
        SegmentPace::Rapid => None,
    };
    let mut most = [0.0_f64; 2];
    for segment in &outcome.setups[0].trace.segments {
        let Some(feed) = at_feed(segment) else { continue };
        for k in 0..=PLACES {
            let jet = segment.curve.at(segment.curve.length() * f64::from(k) / f64::from(PLACES));
            let of = |d: glam::DVec3, power: i32| d.abs().max_element() * feed.powi(power);
            most = [most[0].max(of(jet.d2, 2)), most[1].max(of(jet.d3, 3))];
        }
    }
    most
}

fn found(outcome: &Outcome) -> Vec<&Finding> {
    outcome.verdict.found.iter().filter(|f| f.code == Code::FEED_BEYOND).collect()
}

#[test]
fn no_block_asks_an_axis_for_more_than_it_has_on_any_control() {
    for (control, acceleration) in [
        ("sinumerik-840d", 5.0),
        ("sinumerik-840d", 0.05),
        ("fanuc", 5.0),
        ("linuxcnc", 0.5),
        ("heidenhain", 5.0),
    ] {
        let limits = format!("acceleration = {acceleration}, jerk = 50 }}");
        let change = [COARSE, ("sinumerik-840d", control), ("acceleration = 5, jerk = 50 }", &limits)];
        let outcome = run("01_bore", &change);
        assert!(outcome.verdict.is_safe(), "{control} {:?}", outcome.verdict.found);
        let [a, j] = asked(&outcome);
        assert!(a <= 1e3 * acceleration * (1.0 + 1e-6) && j <= 5e4 * (1.0 + 1e-6), "{control} {a} {j}");
        // Nor less than the machine can: the feeds are used up.
        assert!(
            a > 0.9e3 * acceleration.min(0.5) && j > 4.5e4 * (acceleration / 5.0).min(0.01),
            "{control} {a} {j}"
        );
        assert!(found(&outcome).is_empty(), "{control}");
        let words = kinecut::job::report::of_job_in_words(&outcome);
        let fact = words.verdict.facts.iter().find(|fact| fact.label == "Feed").unwrap();
        let note = &fact.note;
        assert!(note.contains("feed words lowered in ") && note.contains(" of 6000 mm/min"), "{fact:?}");
    }
}

#[test]
fn feeds_as_programmed_are_written_as_they_are_and_found() {
    let outcome = run("01_bore", &[COARSE, AS_PROGRAMMED]);
    let [a, _] = asked(&outcome);
    assert!(a > 1e5, "{a}");
    let warnings = found(&outcome);
    assert!(warnings.iter().all(|f| f.severity == Severity::Warning) && !warnings.is_empty());
    let line = |f: &Finding| f.place.as_ref().unwrap().line;
    let first = outcome.setups[0].posted.text.lines().position(|l| l.contains("F6000")).unwrap() as u32;
    assert!(warnings.iter().any(|f| line(f) == first + 1), "{warnings:?}");
    // The value is what the block holds: the same radius by the closed form of a circle.
    let jerk = warnings.iter().find(|f| f.message.contains("jerk")).unwrap();
    let radius = outcome.setups[0].trace.segments.iter().find_map(|s| match s.curve.kind() {
        kinecut::geom::CurveKind::Arc(arc) => Some(arc.radius()),
        _ => None,
    });
    let radius = radius.unwrap();
    let held = 60.0 * (5e4 * radius * radius).cbrt();
    assert!((jerk.value.as_ref().unwrap().value / held - 1.0).abs() < 1e-3, "{jerk:?} {held}");
}

#[test]
fn lower_feeds_cost_little_time_where_the_whole_way_is_too_fast() {
    let slow = ("acceleration = 5, jerk = 50 }", "acceleration = 0.05, jerk = 50 }");
    let times = [vec![COARSE, slow], vec![COARSE, slow, AS_PROGRAMMED]].map(|change| {
        let outcome = run("01_bore", &change);
        outcome.setups[0].seconds()
    });
    assert!(times[0] > times[1] && times[0] < 1.04 * times[1], "{times:?}");
    let usual = run("01_bore", &[COARSE]).setups[0].seconds();
    assert!(times[1] > 1.5 * usual, "{times:?} {usual}");
}

#[test]
fn feeds_within_limits_need_limits() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/01_bore");
    let text = std::fs::read_to_string(folder.join("job.toml")).unwrap();
    let text = text
        .replace("decimals = 4,", "decimals = 4, feeds = \"within-limits\",")
        .replace("dynamics = { rapid = 30000, acceleration = 5, jerk = 50 }", "");
    let loader = kinecut::base::DiskLoader::new(folder);
    let error = kinecut::job::run("job.toml", &text, &loader, &kinecut::base::Silent).unwrap_err();
    assert_eq!((error.code(), error.0.key.as_deref()), (Code::JOB_VALUE, Some("post.feeds")));
    assert!(error.to_string().contains("acceleration"), "{error}");
}
