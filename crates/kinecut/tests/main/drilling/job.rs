//! Drilling in a job: from the file to a proven program on every control.

use kinecut::base::{Code, Finding, MemoryLoader, Silent};
use kinecut::drilling::ZoneStage;
use kinecut::geom::{Mesh, write_stl};
use kinecut::job::Outcome;
use kinecut::trace::SegmentPace;

use crate::common::job::{self, refused};
use crate::common::planned::drillings;

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
    job::run(text).unwrap()
}

fn codes(outcome: &Outcome) -> Vec<Code> {
    outcome.verdict.found.iter().map(|f| f.code).collect()
}

/// A hole through the plate from face to face.
const THROUGH: &str = "
    entry = { surface = \"plane\" }
    exit = { surface = \"plane\" }
    length = 20
    speed = 1200
    feed_per_rev = { entry = 0.1, steady = 0.2, exit = 0.05 }";

fn program(outcome: &Outcome) -> &str {
    &outcome.setups[0].posted.text
}

/// Feed per revolution and end height of each feed move [mm].
fn feeds(outcome: &Outcome) -> Vec<(f64, f64)> {
    let spindle = drillings(&outcome.setups[0].planned)[0].holes[0].plan.spindle / std::f64::consts::TAU;
    let of = |motion: SegmentPace| if let SegmentPace::Feed(f) = motion { Some(f / spindle) } else { None };
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
        assert!(outcome.verdict.is_safe(), "{control}: {:?}\n{}", outcome.verdict.found, program(&outcome));
        // The point is 3.0043 mm long; a slower zone contains the exact one.
        let expected = [(0.1, -3.005), (0.2, -20.0), (0.05, -25.005)];
        assert_eq!(feeds(&outcome), [expected, expected].concat(), "{control}\n{}", program(&outcome));
        assert!(outcome.verdict.proven.iter().any(|p| p.claim.contains("wall")), "{control}");
    }
}

#[test]
fn pecked_holes_are_the_same_on_every_control() {
    for control in CONTROLS {
        for after in ["break-chip", "clear"] {
            let peck =
                format!("points = [[0, 0], [12, 3]]\npeck = {{ step = 4, after = \"{after}\" }}{THROUGH}");
            let outcome = run(&plate(control, "diameter = 6", &peck));
            assert!(
                outcome.verdict.is_safe(),
                "{control} {after}: {:?}\n{}",
                outcome.verdict.found,
                program(&outcome)
            );
            let depth = |f: f64| {
                feeds(&outcome).iter().filter(|x| (x.0 - f).abs() < 1e-4).map(|x| x.1).fold(1.0, f64::min)
            };
            // Entry, steady and exit each end where they end without steps.
            assert_eq!([depth(0.1), depth(0.2), depth(0.05)], [-1.803, -20.0, -23.803], "{control} {after}");
            let steps = feeds(&outcome).iter().filter(|x| (x.0 - 0.2).abs() < 1e-4).count();
            assert!(steps >= 2 * 5, "{control} {after}: {steps} steps\n{}", program(&outcome));
        }
    }
}

#[test]
fn holes_of_one_feed_are_the_controls_own_cycle() {
    let words =
        [("sinumerik-840d", "CYCLE8"), ("fanuc", "G81"), ("linuxcnc", "G81"), ("heidenhain", "CYCL DEF 200")];
    for (control, word) in words {
        let operation = "points = [[0, 0], [12, 3]]
            entry = { surface = \"plane\" }
            depth = 12
            speed = 1200
            feed_per_rev = { entry = 0.1, steady = 0.1 }";
        let outcome = run(&plate(control, "diameter = 6", operation));
        assert!(outcome.verdict.is_safe(), "{control}: {:?}\n{}", outcome.verdict.found, program(&outcome));
        let own = program(&outcome).contains(word);
        assert_eq!(
            own,
            control != "heidenhain" || program(&outcome).contains("CYCL DEF"),
            "{}",
            program(&outcome)
        );
        let without = run(&plate(control, "diameter = 6", &format!("cycles = false\n{operation}")));
        assert!(without.verdict.is_safe() && !program(&without).contains(word), "{control}");
        assert_eq!(feeds(&without).last(), feeds(&outcome).last(), "{control}");
    }
}

#[test]
fn an_entry_and_steps_are_one_cycle_of_sinumerik() {
    let operation = "points = [[0, 0]]
        entry = { surface = \"plane\", inclination = 10 }
        tip = -15
        speed = 1200
        peck = { step = 3, after = \"clear\" }
        feed_per_rev = { entry = 0.05, steady = 0.1 }";
    // An entry from an inclined face, so a stock with that face.
    let text = plate("sinumerik-840d", "diameter = 6", operation)
        .replace("{ box = { min = [-30, -20, -20], max = [30, 20, 0] } }", "{ mesh = \"wedge.stl\" }")
        .replace("inclination = 10", "inclination = 11.309932474020213");
    let loader = MemoryLoader::default().with("wedge.stl", wedge());
    let outcome = kinecut::job::run("job.toml", &text, &loader, &Silent).unwrap();
    assert!(outcome.verdict.is_safe(), "{:?}\n{}", outcome.verdict.found, program(&outcome));
    let block = program(&outcome)
        .lines()
        .find(|l| l.contains("CYCLE83("))
        .unwrap_or_else(|| panic!("{}", program(&outcome)));
    assert!(block.contains(",0.5,1,"), "half the feed in the first step, withdrawing: {block}");
    let exact = drillings(&outcome.setups[0].planned)[0].holes[0].plan.entry.last;
    let first = feeds(&outcome)[0];
    assert!(first.0 == 0.05 && first.1 <= exact && first.1 > exact - 0.01, "{first:?} {exact}");
    assert!(feeds(&outcome)[1..].iter().all(|f| f.0 == 0.1));
    assert_eq!(feeds(&outcome).last().unwrap().1, -15.0);
}

#[test]
fn patterns_are_drilled_in_their_order() {
    let places = |operation: &str| -> Vec<[f64; 2]> {
        let outcome = run(&plate("linuxcnc", "diameter = 4", &format!("{operation}{THROUGH}")));
        assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
        drillings(&outcome.setups[0].planned)[0]
            .holes
            .iter()
            .map(|h| h.at.map(|v| (v * 1e6).round() / 1e6))
            .collect()
    };
    assert_eq!(
        places("pattern = { grid = { at = [-10, -5], step = [10, 8], count = [3, 2] } }"),
        [[-10.0, -5.0], [0.0, -5.0], [10.0, -5.0], [10.0, 3.0], [0.0, 3.0], [-10.0, 3.0]]
    );
    assert_eq!(
        places("pattern = { circle = { at = [2, 0], diameter = 20, count = 4, start_angle = 90 } }"),
        [[2.0, 10.0], [-8.0, 0.0], [2.0, -10.0], [12.0, 0.0]]
    );
    assert_eq!(
        places("pattern = { line = { at = [0, 0], step = 5, count = 3, angle = 180 } }"),
        [[0.0, 0.0], [-5.0, 0.0], [-10.0, 0.0]]
    );
}

/// A wedge of 60 x 40 mm whose top rises by 0.2 along X from -6 to 6, its foot at -20.
fn wedge() -> Vec<u8> {
    let top = |x: f64| 0.2 * x;
    let mut vertices = Vec::new();
    for (x, y) in [(-30.0, -20.0), (30.0, -20.0), (30.0, 20.0), (-30.0, 20.0)] {
        vertices.push([x, y, -20.0].into());
        vertices.push([x, y, top(x)].into());
    }
    let mut triangles = Vec::new();
    for i in 0..4u32 {
        let (a, b) = (2 * i, 2 * ((i + 1) % 4));
        triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
    }
    triangles.extend([[0, 4, 2], [0, 6, 4], [1, 3, 5], [1, 5, 7]]);
    write_stl(&Mesh { vertices, triangles })
}

#[test]
fn each_hole_of_a_pattern_has_the_zones_of_the_parts_mesh() {
    let text = plate(
        "sinumerik-840d",
        "diameter = 6",
        "points = [[-20, 0], [0, 0], [20, 0], [45, 0]]
         speed = 1500
         feed_per_rev = { steady = 0.15 }",
    )
    .replace("{ box = { min = [-30, -20, -20], max = [30, 20, 0] } }", "{ mesh = \"wedge.stl\" }");
    let loader = MemoryLoader::default().with("wedge.stl", wedge());
    let outcome = kinecut::job::run("job.toml", &text, &loader, &Silent).unwrap();
    let holes = &drillings(&outcome.setups[0].planned)[0].holes;
    assert_eq!(holes.len(), 3, "the fourth lies beside the part");
    for hole in holes {
        let x = hole.at[0];
        // A plane of slope 0.2: first contact by the tip, the whole edge in 3 mm * 0.2 + L1 below.
        let l1 = 3.0 / 59f64.to_radians().tan();
        assert!((hole.plan.entry.first - 0.2 * x).abs() < 1e-5, "{}", hole.plan.entry.first);
        assert!((hole.plan.entry.last - (0.2 * x - 0.6 - l1)).abs() < 1e-5);
        assert!((hole.plan.exit.unwrap().first - -20.0).abs() < 1e-5);
        // Inclined in, square out: our defaults.
        assert_eq!(hole.plan.feed_sources, ["our default", "given", "our default"]);
        assert!((hole.plan.feeds.entry - 0.05).abs() < 1e-12 && (hole.plan.feeds.exit - 0.075).abs() < 1e-12);
    }
    let beside: Vec<&Finding> =
        outcome.verdict.found.iter().filter(|f| f.code == Code::DRILL_MISSES).collect();
    assert_eq!(beside.len(), 1);
    assert!(beside[0].message.starts_with("hole 4 at X45 Y0"), "{}", beside[0].message);
    assert!(beside[0].place.as_ref().is_some_and(|p| p.line > 0), "{:?}", beside[0]);
    assert!(!outcome.verdict.is_safe());
    // The others are cut as planned.
    assert!(outcome.verdict.proven.iter().any(|p| p.claim.starts_with("3 drilled holes")));
}

#[test]
fn surfaces_of_a_plain_stock_need_not_be_given() {
    let operation =
        "points = [[5, 5]]\nspeed = 900\nfeed_per_rev = { entry = 0.1, steady = 0.2, exit = 0.05 }";
    let outcome = run(&plate("linuxcnc", "diameter = 10", operation));
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    assert_eq!(feeds(&outcome), [(0.1, -3.005), (0.2, -20.0), (0.05, -25.005)]);
    // At the edge of the plate a part of the drill meets nothing: told by the stock as a mesh.
    let edge = run(&plate("linuxcnc", "diameter = 10", &operation.replace("[5, 5]", "[28, 0]")));
    let hole = &drillings(&edge.setups[0].planned)[0].holes[0];
    assert!(hole.plan.passages.iter().all(|p| p.share < 0.9), "{:?}", hole.plan.passages);
    assert!(hole.plan.zones.iter().any(|z| z.stage == ZoneStage::Partial), "{:?}", hole.plan.zones);
}

#[test]
fn a_bar_is_drilled_across_without_a_word_of_its_surfaces() {
    // A bar of 80 mm along Z of the part lies along X of the machine, the work zero on top of it.
    let text = plate(
        "linuxcnc",
        "diameter = 10",
        "points = [[0, 0], [20, 12]]
         speed = 900
         feed_per_rev = { entry = 0.1, steady = 0.2, exit = 0.05 }",
    )
    .replace(
        "box = { min = [-30, -20, -20], max = [30, 20, 0] }",
        "cylinder = { base = [0, 0, 0], diameter = 80, height = 100 }",
    )
    .replace("step = 0.5", "step = 1")
    .replace("flute_length = 60", "flute_length = 95")
    .replace(
        "safe_height = 20",
        "safe_height = 20\nzero = [40, 0, 50]\norient = { x = [0, 0, 1], z = [1, 0, 0] }",
    );
    let outcome = run(&text);
    assert!(outcome.verdict.is_safe(), "{:?}\n{}", outcome.verdict.found, program(&outcome));
    let holes = &drillings(&outcome.setups[0].planned)[0].holes;
    let f = |u: f64| (1600.0 - u * u).sqrt() - 40.0;
    let l1 = 5.0 / 59f64.to_radians().tan();
    for (hole, x) in holes.iter().zip([0.0, 12.0]) {
        let (entry, exit) = (hole.plan.entry, hole.plan.exit.unwrap());
        assert!(
            (entry.first - f(x)).abs() < 1e-9 && (entry.last - (f(x + 5.0) - l1)).abs() < 1e-9,
            "{entry:?}"
        );
        assert!((exit.first - (-80.0 - f(x))).abs() < 1e-9, "{exit:?}");
        let lowest = if x < 5.0 { -80.0 } else { -80.0 - f(x - 5.0) };
        assert!((exit.last - (lowest - l1)).abs() < 1e-9, "{exit:?}");
    }
}

#[test]
fn a_drilled_hole_of_the_stock_is_opened_out() {
    let mut text = plate(
        "fanuc",
        "diameter = 12\npoint = { cone = { cone_angle = 120, nose_diameter = 6 } }",
        "method = \"core-drilling\"\npoints = [[0, 0]]\nspeed = 800\nfeed_per_rev = { steady = 0.3 }",
    );
    text.push_str("\n[[drilled]]\nat = [0, 0]\ndiameter = 8\ntop = 0\nbottom = -20\n");
    let outcome = run(&text);
    assert!(outcome.verdict.is_safe(), "{:?}\n{}", outcome.verdict.found, program(&outcome));
    let plan = &drillings(&outcome.setups[0].planned)[0].holes[0].plan;
    // The nose runs in the hole: first contact where the cone is 8 mm wide, (8 - 6) / 2 / tan 60 above the nose.
    assert!((plan.entry.first - -1.0 / 60f64.to_radians().tan()).abs() < 1e-9, "{:?}", plan.entry);
    assert_eq!(plan.edge.inner_radius(), 4.0);
}

#[test]
fn recesses_and_reamers_go_as_deep_as_their_rule_says() {
    let end_in = |tool: &str, operation: &str, stock: &str| -> f64 {
        let outcome = run(&format!("{}\n{stock}", plate("linuxcnc", tool, operation)));
        assert!(outcome.verdict.is_safe(), "{tool}: {:?}\n{}", outcome.verdict.found, program(&outcome));
        drillings(&outcome.setups[0].planned)[0].holes[0].plan.coordinates.end
    };
    let end = |tool: &str, operation: &str| end_in(tool, operation, "");
    let common = "points = [[0, 0]]\nspeed = 800\nfeed_per_rev = { entry = 0.1, steady = 0.1, exit = 0.1 }";
    let plane = "entry = { surface = \"plane\" }";
    let countersink = end(
        "diameter = 25\npoint = { cone = { cone_angle = 90 } }",
        &format!("method = \"countersinking\"\nreach_diameter = 16\n{plane}\n{common}"),
    );
    assert!((countersink - -8.0).abs() < 1e-9);
    let centre = end(
        "diameter = 10\npoint = { centre = { pilot_diameter = 4, pilot_length = 5 } }",
        &format!("method = \"centring\"\nreach_diameter = 8.5\n{plane}\n{common}"),
    );
    assert!((centre - -(5.0 + 2.25 / 30f64.to_radians().tan())).abs() < 1e-9, "{centre}");
    let counterbore = end(
        "diameter = 15\npoint = \"flat\"",
        &format!("method = \"counterboring\"\ndepth = 6\n{plane}\n{common}"),
    );
    assert_eq!(counterbore, -6.0);
    let reamer = end_in(
        "diameter = 16\npoint = { cone = { cone_angle = 90, nose_diameter = 14 } }",
        &format!(
            "method = \"reaming\"\npre_hole = {{ diameter = 15.6 }}\nlength = 20\n{plane}\nexit = \"same\"\n{common}"
        ),
        "[[drilled]]\nat = [0, 0]\ndiameter = 15.6\ntop = 0\nbottom = -20",
    );
    // The lead is 1 mm high; its outer end goes a quarter of the diameter beyond.
    assert!((reamer - -25.0).abs() < 1e-9, "{reamer}");
    let step = end(
        "diameter = 12\npoint = { stepped = { point_angle = 118, stages = [{ diameter = 6, length = 15 }] } }",
        &format!("method = \"step-drilling\"\ndepth = 3\n{plane}\n{common}"),
    );
    assert_eq!(step, -18.0);
}

#[test]
fn a_nose_that_finds_no_hole_is_an_error() {
    let operation = "method = \"countersinking\"
        points = [[0, 0]]
        entry = { surface = \"plane\" }
        reach_diameter = 12
        speed = 500
        feed_per_rev = { steady = 0.1 }";
    let tool = "diameter = 16\npoint = { cone = { cone_angle = 90, nose_diameter = 4 } }";
    let found = run(&plate("linuxcnc", tool, operation));
    assert!(codes(&found).contains(&Code::NOSE_IN_STOCK), "{:?}", codes(&found));
    let text = plate("linuxcnc", tool, &format!("{operation}\npre_hole = {{ diameter = 6 }}"));
    let drilled = run(&format!("{text}\n[[drilled]]\nat = [0, 0]\ndiameter = 6\ntop = 0\nbottom = -20"));
    assert!(drilled.verdict.is_safe(), "{:?}", drilled.verdict.found);
    // The plan has its zones for other programs.
    let plan: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&drilled)).unwrap();
    let zone = &plan["setups"][0]["drillings"][0]["holes"][0]["zones"][0];
    assert_eq!((zone["stage"].as_str(), zone["feed_from"].as_str()), (Some("entry"), Some("our default")));
}

#[test]
fn an_annular_drill_leaves_a_core_that_falls_out() {
    for (operation, left) in [(format!("points = [[0, 0]]{THROUGH}"), false), (
        "points = [[0, 0]]\nentry = { surface = \"plane\" }\ndepth = 8\nspeed = 500\nfeed_per_rev = { steady = 0.1 }".to_owned(),
        true,
    )] {
        let outcome = run(&plate("linuxcnc", "diameter = 16\npoint = { annular = { core_diameter = 10 } }", &operation));
        assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
        assert_eq!(codes(&outcome).contains(&Code::SLUG), !left);
        let removed = outcome.simulation.raw_volume - outcome.simulation.stock.volume();
        let ring = std::f64::consts::PI * (64.0 - 25.0);
        let expected = if left { ring * 8.0 } else { std::f64::consts::PI * 64.0 * 20.0 };
        assert!((removed / expected - 1.0).abs() < 0.02, "{removed} {expected}");
    }
}

#[test]
fn surfaces_that_are_not_those_of_the_stock_are_found() {
    let wrong = |operation: &str| codes(&run(&plate("linuxcnc", "diameter = 10", operation)));
    // The stock's top is at 0; drawn 6 mm lower, the drill is fully in while the plan still waits.
    let lower = format!("points = [[0, 0]]\ntop = -6{}", THROUGH.replace("length = 20", "length = 14"));
    let found = wrong(&lower);
    assert!(found.contains(&Code::DRILL_ZONES) || found.contains(&Code::RAPID_IN_STOCK), "{found:?}");
    // Thicker than drawn: the end lies in material.
    let drawn = |length: &str| format!("points = [[0, 0]]{}", THROUGH.replace("length = 20", length));
    let thick = run(&plate("linuxcnc", "diameter = 10", &drawn("length = 12")));
    let told: Vec<&Finding> = thick.verdict.found.iter().filter(|f| f.code == Code::DRILL_ZONES).collect();
    assert!(told.len() == 1 && told[0].message.contains("does not go through"), "{:?}", thick.verdict.found);
    assert!(!thick.verdict.is_safe());
    // Thinner than drawn: it breaks through at full feed.
    let thin = run(&plate("linuxcnc", "diameter = 10", &drawn("length = 30")));
    assert!(!thin.verdict.is_safe() && codes(&thin).contains(&Code::DRILL_ZONES), "{:?}", thin.verdict.found);
    // Into a hole that was not described: the corner comes in at full feed, a warning.
    let text = plate("linuxcnc", "diameter = 10", &drawn("length = 20"));
    let over_recess = run(&format!("{text}\n[[drilled]]\nat = [0, 0]\ndiameter = 14\ntop = 0\nbottom = -6"));
    let severe = over_recess.verdict.found.iter().filter(|f| f.code == Code::DRILL_ZONES).map(|f| f.severity);
    assert_eq!(
        severe.collect::<Vec<_>>(),
        [kinecut::base::Severity::Warning],
        "{:?}",
        over_recess.verdict.found
    );
}

#[test]
fn a_recess_in_a_mesh_is_as_wide_as_asked() {
    let operation = "method = \"countersinking\"
        points = [[5, 0]]
        reach_diameter = 8
        speed = 500
        feed_per_rev = { entry = 0.1, steady = 0.1 }";
    let text = plate("linuxcnc", "diameter = 25\npoint = { cone = { cone_angle = 90 } }", operation)
        .replace("{ box = { min = [-30, -20, -20], max = [30, 20, 0] } }", "{ mesh = \"wedge.stl\" }");
    let loader = MemoryLoader::default().with("wedge.stl", wedge());
    let outcome = kinecut::job::run("job.toml", &text, &loader, &Silent).unwrap();
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    // On a plane of slope 0.2: 8 mm all round where the lower side is reached, 4 * 0.2 + 4 below the axis.
    let end = drillings(&outcome.setups[0].planned)[0].holes[0].plan.coordinates.end;
    assert!((end - (1.0 - 0.8 - 4.0)).abs() < 1e-5, "{end}");
}

#[test]
fn a_body_and_the_same_faces_give_the_same_holes() {
    let bar = |surfaces: &str| {
        plate(
            "linuxcnc",
            "diameter = 10",
            &format!(
                "points = [[3, 12]]
                 pre_hole = {{ diameter = 5, offset = [1, 2] }}
                 speed = 900
                 feed_per_rev = {{ entry = 0.1, steady = 0.2, exit = 0.05 }}
                 {surfaces}"
            ),
        )
        .replace(
            "box = { min = [-30, -20, -20], max = [30, 20, 0] }",
            "cylinder = { base = [0, 0, 0], diameter = 80, height = 100 }",
        )
        .replace("step = 0.5", "step = 2")
        .replace("flute_length = 60", "flute_length = 95")
        .replace(
            "safe_height = 20",
            "safe_height = 60\nzero = [0, 0, 50]\norient = { x = [0, 0, 1], z = [1, 0, 0] }",
        )
    };
    let entry = |text: &str| {
        let outcome = run(text);
        let hole = drillings(&outcome.setups[0].planned)[0].holes[0].clone();
        (hole.plan.passages, hole.plan.zones)
    };
    let faces = entry(&bar("entry = { surface = \"outer-cylinder\", radius = 40 }\nexit = \"same\""));
    let body = entry(&bar(""));
    assert_eq!(faces.1.len(), body.1.len());
    for (a, b) in faces.0.iter().zip(&body.0) {
        let (a, b) = (a.transient, b.transient);
        assert!((a.first - b.first).abs() < 1e-8 && (a.last - b.last).abs() < 1e-8, "{a:?} {b:?}");
    }
    // The pre-hole's place matters: mirrored it is another hole.
    let mirrored = entry(&bar("").replace("offset = [1, 2]", "offset = [1, -2]"));
    let differs = |(a, b): (&kinecut::drilling::Passage, &kinecut::drilling::Passage)| {
        (a.transient.first - b.transient.first).abs() > 1e-3
    };
    assert!(body.0.iter().zip(&mirrored.0).any(differs), "{:?}", mirrored.0);
}

#[test]
fn what_a_mesh_must_have_itself_is_not_put_into_it() {
    for (extra, key) in [
        ("cross_bore = [{ diameter = 6, z = -10 }]", "cross_bore"),
        ("pre_hole = { diameter = 3, bottom = -5 }", "pre_hole"),
    ] {
        let operation = format!("points = [[0, 0]]\nspeed = 900\nfeed_per_rev = {{ steady = 0.1 }}\n{extra}");
        let text = plate("linuxcnc", "diameter = 6", &operation)
            .replace("{ box = { min = [-30, -20, -20], max = [30, 20, 0] } }", "{ mesh = \"wedge.stl\" }");
        let loader = MemoryLoader::default().with("wedge.stl", wedge());
        let error = kinecut::job::run("job.toml", &text, &loader, &Silent).unwrap_err();
        let place = format!("setup[0].operation[0].{key}");
        assert_eq!(
            (error.code(), error.0.key.as_deref()),
            (Code::DRILL_CASE, Some(place.as_str())),
            "{error}"
        );
    }
}

#[test]
fn a_dwell_of_a_pecked_hole_is_at_its_bottom() {
    for after in ["break-chip", "clear"] {
        let operation = format!(
            "points = [[0, 0]]
             entry = {{ surface = \"plane\" }}
             depth = 15
             dwell = 1.5
             cycles = false
             peck = {{ step = 4, after = \"{after}\" }}
             speed = 900
             feed_per_rev = {{ entry = 0.1, steady = 0.2 }}"
        );
        let outcome = run(&plate("grbl", "diameter = 6", &operation));
        let lines: Vec<&str> = program(&outcome).lines().collect();
        let dwell = lines
            .iter()
            .position(|l| l.starts_with("G4 "))
            .unwrap_or_else(|| panic!("{}", program(&outcome)));
        assert!(lines[dwell - 1].contains("Z-16.803"), "{}", program(&outcome));
    }
}

#[test]
fn a_corner_that_touches_first_is_an_error_unless_guided() {
    let steep = "points = [[0, 0]]
        entry = { surface = \"plane\", inclination = 40 }
        depth = 5
        speed = 500
        feed_per_rev = { steady = 0.1 }";
    let found = run(&plate("linuxcnc", "diameter = 10", steep));
    let corner = found.verdict.found.iter().find(|f| f.code == Code::CORNER_FIRST).unwrap();
    // 5 tan 40 - 3.0043 = 1.1912 mm before the tip.
    assert!(corner.message.contains("touches first by 1.191 mm"), "{}", corner.message);
    assert!(corner.severity == kinecut::base::Severity::Error);
    let guided = run(&plate("linuxcnc", "diameter = 10", &format!("guided = true\n{steep}")));
    let corner = guided.verdict.found.iter().find(|f| f.code == Code::CORNER_FIRST).unwrap();
    assert!(corner.severity == kinecut::base::Severity::Warning);
}

#[test]
fn wrong_drillings_name_their_key() {
    let through = format!("points = [[0, 0]]{THROUGH}");
    let with = |from: &str, to: &str| {
        assert!(through.contains(from), "{from}");
        through.replace(from, to)
    };
    let cases = [
        (with("speed = 1200", ""), Code::JOB_SHAPE, ""),
        (with("speed = 1200", "speed = 0"), Code::JOB_VALUE, "speed"),
        (with("speed = 1200", "speed = 900\ncutting_speed = 20"), Code::JOB_SHAPE, "speed"),
        (with("steady = 0.2", "steady = 0"), Code::JOB_VALUE, "feed_per_rev.steady"),
        (with("steady = 0.2", "steady = nan"), Code::JOB_VALUE, "feed_per_rev.steady"),
        (with("entry = 0.1", "entry = -0.1"), Code::JOB_VALUE, "feed_per_rev.entry"),
        (with("length = 20", "length = 20\ndepth = 3"), Code::JOB_SHAPE, "exit"),
        (with("points = [[0, 0]]", "points = []"), Code::JOB_VALUE, "points"),
        (with("points = [[0, 0]]", "points = [[0, inf]]"), Code::JOB_VALUE, "points[0][1]"),
        (with("points = [[0, 0]]", ""), Code::JOB_SHAPE, "points"),
        (with("entry = { surface = \"plane\" }", ""), Code::JOB_SHAPE, "exit"),
        (
            with("entry = { surface = \"plane\" }", "entry = { surface = \"plane\", inclination = 90 }"),
            Code::DRILL_SURFACE,
            "entry.inclination",
        ),
        (
            with("entry = { surface = \"plane\" }", "entry = { surface = \"outer-cylinder\" }"),
            Code::JOB_SHAPE,
            "entry.surface",
        ),
        (
            with("entry = { surface = \"plane\" }", "entry = { surface = \"outer-cylinder\", radius = -3 }"),
            Code::DRILL_SURFACE,
            "entry.radius",
        ),
        (
            with(
                "entry = { surface = \"plane\" }",
                "entry = { surface = \"outer-cylinder\", radius = 20, offset = 16 }",
            ),
            Code::DRILL_SURFACE,
            "entry.offset",
        ),
        (
            with("length = 20", "length = 20\npre_hole = { diameter = 10 }"),
            Code::DRILL_CASE,
            "pre_hole.diameter",
        ),
        (with("length = 20", "length = 20\nmethod = \"reaming\""), Code::DRILL_CASE, "pre_hole"),
        (with("length = 20", "length = 20\nclearance = 1"), Code::DRILL_CASE, "clearance"),
        (with("length = 20", "length = 20\npeck = { step = 0 }"), Code::JOB_VALUE, "peck.step"),
        (with("length = 20", "length = 20\napproach = -1"), Code::JOB_VALUE, "approach"),
    ];
    for (operation, code, key) in cases {
        let finding = refused(&plate("linuxcnc", "diameter = 10", &operation));
        let place = format!("setup[0].operation[0]{}{key}", if key.is_empty() { "" } else { "." });
        assert_eq!(
            (finding.code, finding.key.as_deref()),
            (code, Some(place.as_str())),
            "{operation}: {finding}"
        );
        assert!(finding.place.as_ref().is_some_and(|p| p.line > 0), "{operation}: {finding}");
    }
    // Words are told with what would be right.
    for (from, to, help) in [
        ("exit = { surface = \"plane\" }", "exit = \"sam\"", "same"),
        ("exit = { surface = \"plane\" }", "exit = { surfac = \"plane\" }", "surface"),
    ] {
        let finding = refused(&plate("linuxcnc", "diameter = 10", &with(from, to)));
        let told = format!("{finding}");
        assert!(finding.code == Code::JOB_SHAPE && told.contains(&format!("`{help}`")), "{told}");
    }
    let tools = [
        (
            "diameter = 10\npoint = { rounded-lips = { lip_radius = 4 } }",
            Code::TOOL_VALUE,
            "tool[0].point.rounded-lips.lip_radius",
        ),
        ("diameter = 10\npoint = { gun = { apex = 6 } }", Code::TOOL_VALUE, "tool[0].point.gun.apex"),
        ("diameter = 10\npoint = \"flat\"\npoint_angle = 118", Code::JOB_SHAPE, "tool[0].point_angle"),
        ("diameter = 0", Code::TOOL_VALUE, "tool[0].diameter"),
        ("diameter = 10\npoint_angle = 0", Code::TOOL_VALUE, "tool[0].point_angle"),
    ];
    for (tool, code, key) in tools {
        let finding = refused(&plate("linuxcnc", tool, &through));
        assert_eq!((finding.code, finding.key.as_deref()), (code, Some(key)), "{tool}: {finding}");
    }
}
