//! Slots through the whole: posted for each control, read back, cut, their walls and floors measured.

use std::f64::consts::PI;

use kinecut::base::{Code, Finding, MemoryLoader, Silent};
use kinecut::job::{Outcome, engagement_json, plan_json, run};

use super::pocket::{done, job, removed};

const SLOT: &str = "[[setup.operation]]\ntype = \"slot\"\ntool = 1\nspeed = 6000\nfeed = 1200\n";
const LINE: &str = "line = [[-20, 5], [25, -8.3]]\nwidth = 13\ndepth = 6\n";

fn cut(control: &str, keys: &str) -> Outcome {
    done(control, &format!("{SLOT}{keys}"))
}

fn refused(keys: &str) -> Box<Finding> {
    let text = job("fanuc", &format!("{SLOT}{keys}"));
    run("job.toml", &text, &MemoryLoader::default(), &Silent).map(|_| ()).unwrap_err().0
}

fn is_good(name: &str, outcome: &Outcome, volume: f64) {
    assert!(outcome.verdict.is_safe(), "{name}: {:?}", outcome.verdict.found);
    assert!(outcome.verdict.found.is_empty(), "{name}: {:?}", outcome.verdict.found);
    let wall = &outcome.deviation.bores[0];
    assert!(wall.ends > 200 && wall.worst() < 1e-3, "{name}: {wall:?}");
    assert!(wall.floor.is_some_and(|f| f[0].abs() < 1e-3 && f[1].abs() < 1e-3), "{name}: {wall:?}");
    assert!((removed(outcome) - volume).abs() < 0.005 * volume, "{name}: {} of {volume}", removed(outcome));
}

#[test]
fn a_slot_is_safe_and_measured_on_every_control() {
    let volume = 6.0 * (13.0 * 45.0_f64.hypot(13.3) + PI * 6.5 * 6.5);
    for control in ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc", "grbl"] {
        let outcome = cut(control, &format!("{LINE}stepdown = 3\n"));
        is_good(control, &outcome, volume);
        let plan: serde_json::Value = serde_json::from_str(&plan_json(&outcome)).unwrap();
        let slot = &plan["setups"][0]["slots"][0];
        assert_eq!((slot["entries"].as_u64(), slot["levels"].as_array().map(Vec::len)), (Some(1), Some(2)));
        let largest = slot["largest_engagement"].as_f64().unwrap();
        assert!(largest > 58.0 && largest < 60.5, "{largest}");
    }
}

#[test]
fn arcs_finishes_and_full_widths_are_what_they_are() {
    let arc = "arc = { radius = 25, from = 20, to = 120 }\n";
    let length = 25.0 * 100.0_f64.to_radians();
    let area = |width: f64| width * length + 0.25 * PI * width * width;
    let finish = "finish = { allowance = 0.2, wear_offset = \"D101\", wear_largest = 0.05 }\n";
    for (name, keys, width) in [
        ("conventional", "width = 12\ndepth = 5\ndirection = \"conventional\"\n".to_owned(), 12.0),
        ("finish", format!("width = 13\ndepth = 5\n{finish}"), 13.0),
        ("full", "width = 10\ndepth = 5\nstepdown = 2\nengagement = 180\n".to_owned(), 10.0),
        ("wide", "width = 18\ndepth = 5\nengagement = 45\n".to_owned(), 18.0),
    ] {
        is_good(name, &cut("fanuc", &format!("{arc}{keys}")), 5.0 * area(width));
    }
    // An end beyond the stock is open: no helix.
    let outcome = cut("fanuc", "line = [[0, 0], [80, 0]]\nwidth = 13\ndepth = 6\n");
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    let plan: serde_json::Value = serde_json::from_str(&plan_json(&outcome)).unwrap();
    assert_eq!(plan["setups"][0]["slots"][0]["entries"].as_u64(), Some(0));
}

#[test]
fn slots_hardly_wider_than_the_cutter_are_cut_to_size() {
    let line = "line = [[-20, 5], [25, -8.3]]\ndepth = 4\n";
    for (width, keys) in [
        (10.02, "engagement = 180\n"),
        (10.05, "engagement = 180\n"),
        (10.4, "engagement = 180\n"),
        (10.6, ""),
        (10.5, "engagement = 180\nfinish = { allowance = 0.25 }\n"),
        (11.1, "finish = { allowance = 0.2 }\n"),
    ] {
        let outcome = cut("fanuc", &format!("{line}width = {width}\n{keys}"));
        is_good(
            &format!("{width}"),
            &outcome,
            4.0 * (width * 45.0_f64.hypot(13.3) + 0.25 * PI * width * width),
        );
    }
}

#[test]
fn levels_at_the_full_width_are_shallow_unless_the_job_says_otherwise() {
    let line = "line = [[-20, 5], [25, -8.3]]\ndepth = 12\nwidth = 10\nengagement = 180\n";
    let levels = |outcome: &Outcome| {
        let plan: serde_json::Value = serde_json::from_str(&plan_json(outcome)).unwrap();
        plan["setups"][0]["slots"][0]["levels"].as_array().map(Vec::len)
    };
    let usual = cut("fanuc", line);
    assert!(usual.verdict.found.is_empty(), "{:?}", usual.verdict.found);
    assert_eq!(levels(&usual), Some(3));
    let deep = cut("fanuc", &format!("{line}stepdown = 12\n"));
    let found: Vec<_> = deep.verdict.found.iter().map(|f| f.code).collect();
    assert_eq!((found, levels(&deep)), (vec![Code::FULL_WIDTH], Some(1)));
}

#[test]
fn the_simulator_measures_the_engagement_of_loops() {
    let outcome = cut("fanuc", "line = [[-20, 5], [25, -8.3]]\nwidth = 16\ndepth = 5\n");
    let all: serde_json::Value = serde_json::from_str(&engagement_json(&outcome).unwrap()).unwrap();
    let blocks = all["setups"][0]["blocks"].as_array().unwrap();
    let arcs = blocks.iter().filter_map(|b| Some((b["arc"].as_f64()?, b["length"].as_f64()?)));
    // The helix cuts all around; the others are loops, ways back and the lap.
    let mut arcs: Vec<f64> =
        arcs.filter(|(arc, length)| *arc < 180.0 && *length > 5.0).map(|(arc, _)| arc).collect();
    arcs.sort_by(f64::total_cmp);
    assert!(arcs.len() > 40, "{}", arcs.len());
    let at = |share: f64| arcs[(share * arcs.len() as f64) as usize];
    assert!(at(0.5) > 50.0 && at(0.95) < 62.0, "{} {}", at(0.5), at(0.95));
}

#[test]
fn a_slot_is_an_outline_for_others() {
    let chamfer = "[[setup.operation]]\ntype = \"chamfer\"\ntool = 5\nspeed = 9000\nfeed = 900\nof = \"key\"\nwidth = 0.5\n";
    let outcome = cut("fanuc", &format!("{LINE}name = \"key\"\n{chamfer}"));
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    assert!(outcome.verdict.found.is_empty(), "{:?}", outcome.verdict.found);
    let pocket = "[[setup.operation]]\ntype = \"pocket\"\ntool = 1\nspeed = 6000\nfeed = 1200\ndepth = 5\n\
        slot = { line = [[-20, 0], [20, 0]], width = 24 }\n";
    let outcome = done("fanuc", pocket);
    is_good("pocket", &outcome, 5.0 * (40.0 * 24.0 + PI * 144.0));
}

#[test]
fn wrong_slots_are_refused_with_their_key() {
    for (keys, key, words) in [
        ("width = 13\ndepth = 6\n", "line", "needs a centre line"),
        ("line = [[0, 0], [0, 0]]\nwidth = 13\ndepth = 6\n", "line", "no length"),
        ("arc = { radius = 20, from = 30, to = 10 }\nwidth = 13\ndepth = 6\n", "arc.to", ""),
        ("arc = { radius = 20, from = 0, to = 360 }\nwidth = 13\ndepth = 6\n", "arc", "closed"),
        ("arc = { radius = 6, from = 0, to = 90 }\nwidth = 13\ndepth = 6\n", "", "inner wall vanishes"),
        ("line = [[0, 0], [20, 0]]\nwidth = 9\ndepth = 6\n", "tool", "wider than the slot"),
        ("line = [[0, 0], [20, 0]]\nwidth = 10\ndepth = 6\n", "engagement", "180 degrees over 20.0 mm"),
        ("line = [[0, 0], [20, 0]]\nwidth = 13\ndepth = 6\nengagement = 150\n", "engagement", ""),
    ] {
        let error = refused(keys);
        let found = error.key.clone().unwrap_or_default();
        assert!(found.ends_with(key) && error.message.contains(words), "{keys}: {found}: {error:?}");
    }
}
