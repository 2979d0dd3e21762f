//! Pockets through the whole: posted for each control, read back, cut, their walls and floors measured.

use std::f64::consts::PI;

use kinecut::base::{Code, MemoryLoader, Silent};
use kinecut::job::{Outcome, engagement_json, plan_json, run};

pub(super) fn job(control: &str, operations: &str) -> String {
    format!(
        r#"format = 1
post = {{ control = "{control}" }}
stock = {{ box = {{ min = [-60, -45, -20], max = [60, 45, 0] }} }}
simulate = {{ step = 0.5 }}
[[tool]]
number = 1
type = "end-mill"
diameter = 10
teeth = 4
flute_length = 26
stickout = 40
gauge_length = 120
[[tool]]
number = 2
type = "bull-nose"
diameter = 10
corner_radius = 1
teeth = 4
flute_length = 26
stickout = 40
gauge_length = 120
[[tool]]
number = 3
type = "drill"
diameter = 12
flute_length = 60
stickout = 80
gauge_length = 160
[[tool]]
number = 4
type = "end-mill"
diameter = 10
teeth = 4
hand = "left"
flute_length = 26
stickout = 40
gauge_length = 120
[[tool]]
number = 5
type = "tapered"
diameter = 0
half_angle = 45
teeth = 4
flute_length = 5
stickout = 40
gauge_length = 120
[[setup]]
offset = "G54"
{operations}
"#
    )
}

const POCKET: &str =
    "[[setup.operation]]\ntype = \"pocket\"\ntool = 1\nspeed = 6000\nfeed = 1200\nstepdown = 5\n";

pub(super) fn done(control: &str, operations: &str) -> Outcome {
    let loader = MemoryLoader::default();
    run("job.toml", &job(control, operations), &loader, &Silent).unwrap_or_else(|e| panic!("{e}"))
}

fn cut(control: &str, keys: &str) -> Outcome {
    done(control, &format!("{POCKET}{keys}"))
}

fn refused(keys: &str) -> Box<kinecut::base::Finding> {
    let text = job("fanuc", &format!("{POCKET}{keys}"));
    run("job.toml", &text, &MemoryLoader::default(), &Silent).map(|_| ()).unwrap_err().0
}

const RECTANGLE: &str = "rectangle = { size = [60, 40], corner = 6 }\ndepth = 8\n";

pub(super) fn removed(outcome: &Outcome) -> f64 {
    outcome.simulation.raw_volume - outcome.simulation.stock.volume()
}

/// The first pocket of `plan.json`.
fn pocket(outcome: &Outcome) -> serde_json::Value {
    let plan: serde_json::Value = serde_json::from_str(&plan_json(outcome)).unwrap();
    plan["setups"][0]["pockets"][0].clone()
}

#[test]
fn a_pocket_is_safe_and_measured_on_every_control() {
    for control in ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc", "grbl"] {
        let outcome = cut(control, &format!("{RECTANGLE}finish = {{ allowance = 0.2 }}"));
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        assert!(outcome.verdict.found.is_empty(), "{control}: {:?}", outcome.verdict.found);
        let wall = &outcome.deviation.bores[0];
        assert!(wall.ends > 1000 && wall.worst() < 1e-3, "{control}: {wall:?}");
        assert!(wall.floor.is_some_and(|f| f[0].abs() < 1e-3 && f[1].abs() < 1e-3), "{control}: {wall:?}");
        let area = 60.0 * 40.0 - (4.0 - PI) * 36.0;
        assert!((removed(&outcome) - 8.0 * area).abs() < 0.002 * 8.0 * area, "{control}");
    }
}

#[test]
fn a_wear_register_moves_the_wall() {
    for (control, register) in [("sinumerik-840d", "D2"), ("fanuc", "D101"), ("linuxcnc", "D7")] {
        let finish = format!(
            "finish = {{ allowance = 0.2, wear_offset = \"{register}\", wear_largest = 0.05, wear_value = 0.03 }}"
        );
        let outcome = cut(control, &format!("{RECTANGLE}{finish}"));
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        assert!(outcome.deviation.bores[0].worst() < 1e-3, "{control}: {:?}", outcome.deviation.bores[0]);
    }
}

#[test]
fn islands_open_sides_and_holes_are_what_they_are() {
    let island = "outline = { loops = [ { points = [[-40, -30], [40, -30], [40, 30], [-40, 30]] }, \
        { centre = [5, 0], radius = 9 } ] }\ndepth = 5\n";
    let open = "rectangle = { at = [60, 0], size = [60, 30], corner = 6 }\ndepth = 6\n";
    let through = "circle = { diameter = 50 }\ndepth = 20\nbreakthrough = 0.5\n";
    let conventional =
        "rectangle = { size = [50, 40], angle = 20 }\ndepth = 5\ndirection = \"conventional\"\n";
    for (name, keys, helices) in
        [("open", open, 0), ("through", through, 1), ("conventional", conventional, 1), ("island", island, 1)]
    {
        let outcome = cut("linuxcnc", keys);
        assert!(outcome.verdict.is_safe(), "{name}: {:?}", outcome.verdict.found);
        assert!(outcome.deviation.bores[0].worst() < 1e-3, "{name}: {:?}", outcome.deviation.bores[0]);
        assert_eq!(pocket(&outcome)["entries"].as_u64(), Some(helices), "{name}");
    }
}

#[test]
fn a_pocket_within_an_island_has_its_own_way_in() {
    let frame = "outline = { loops = [ [[-36, -36], [36, -36], [36, 36], [-36, 36]], \
        [[-22, -22], [22, -22], [22, 22], [-22, 22]], { centre = [0, 0], radius = 14 } ] }\ndepth = 5\n";
    let outcome = cut("fanuc", frame);
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    assert_eq!(pocket(&outcome)["entries"].as_u64(), Some(2));
    let area = 72.0 * 72.0 - 44.0 * 44.0 + PI * 14.0 * 14.0;
    assert!((removed(&outcome) - 5.0 * area).abs() < 0.02 * 5.0 * area, "{}", removed(&outcome));
}

/// Passes around this island leave a pillar of 0.05 mm2 between them, thinner than a cell of the cleared area.
#[test]
fn what_stands_between_passes_is_swept() {
    let keys = "outline = { loops = [ [[-40, -25], [40, -25], [40, 25], [-40, 25]], \
        { centre = [24, -8], radius = 6.6 } ] }\ndepth = 2\n";
    let text = job("sinumerik-840d", &format!("{POCKET}{keys}")).replacen("diameter = 10", "diameter = 4", 1);
    let outcome = run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"));
    // Every place of the pocket is swept by the text: by its own points, on a grid of 0.04 mm, away from the walls.
    let mut swept = std::collections::HashMap::<[i64; 2], Vec<glam::DVec2>>::new();
    let cell = |p: glam::DVec2| [(p.x / 2.0).floor() as i64, (p.y / 2.0).floor() as i64];
    for segment in outcome.setups[0].trace.segments.iter() {
        let count = (segment.curve.length() / 0.02).ceil() as usize;
        for k in 0..=count {
            let p = segment.curve.at(segment.curve.length() * k as f64 / count.max(1) as f64).p;
            if p.z < -2.0 + 1e-6 {
                swept.entry(cell(p.truncate())).or_default().push(p.truncate());
            }
        }
    }
    let holds = |p: glam::DVec2| {
        let [x, y] = cell(p);
        (x - 1..=x + 1)
            .flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]))
            .any(|near| swept.get(&near).is_some_and(|all| all.iter().any(|q| q.distance_squared(p) <= 4.0)))
    };
    let mut standing = Vec::new();
    for i in -900..=900 {
        for j in -540..=540 {
            let p = glam::dvec2(0.04 * f64::from(i), 0.04 * f64::from(j));
            if p.distance(glam::dvec2(24.0, -8.0)) > 6.8 && !holds(p) {
                standing.push(p);
            }
        }
    }
    assert!(standing.is_empty(), "{} places, the first {:?}", standing.len(), standing.first());
}

/// The loop of the cutter's centre has edges that are rounding where an arc of an island nearly touches the wall's own line.
#[test]
fn crumbs_of_an_offset_are_no_fault_of_the_drawing() {
    for radius in [1.599_999_999_999_998, 1.6, 1.600_000_000_000_002] {
        let keys = format!(
            "outline = {{ loops = [ [[-59.5, 36.75], [-59.5, -36.75], [59.5, -36.75], [59.5, 36.75]], \
             {{ centre = [-56.75, -27.0], radius = {radius} }} ] }}\ndepth = 2\n"
        );
        let text = job("fanuc", &format!("{POCKET}{keys}")).replacen("diameter = 10", "diameter = 4", 1);
        let text = text.replace("step = 0.5", "step = 1");
        let outcome =
            run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"));
        assert!(outcome.verdict.is_safe(), "{radius}: {:?}", outcome.verdict.found);
    }
}

#[test]
fn a_drilled_hole_is_the_way_in() {
    let drilled = "[[setup.operation]]\ntype = \"drill\"\ntool = 3\nspeed = 1500\nfeed_per_rev = { steady = 0.15 }\n\
        points = [[10, 5]]\n";
    let outcome = done("fanuc", &format!("{drilled}{POCKET}{RECTANGLE}"));
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    assert_eq!(pocket(&outcome)["entries"], 0, "{}", pocket(&outcome));
}

#[test]
fn the_other_hand_and_a_cutter_with_a_corner() {
    for tool in [2, 4] {
        let keys = RECTANGLE.replace("depth = 8", "depth = 6");
        let pocket = format!("{POCKET}{keys}").replace("tool = 1", &format!("tool = {tool}"));
        let outcome = done("fanuc", &pocket);
        assert!(outcome.verdict.is_safe(), "T{tool}: {:?}", outcome.verdict.found);
        let wall = &outcome.deviation.bores[0];
        assert!(wall.worst() < 1e-3, "T{tool}: {wall:?}");
        assert!(wall.floor.is_some_and(|f| f[0].abs() < 1e-3 && f[1].abs() < 1e-3), "T{tool}: {wall:?}");
    }
}

#[test]
fn the_simulator_measures_the_engagement_that_was_planned() {
    for degrees in [40.0, 70.0] {
        let outcome = cut("fanuc", &format!("{RECTANGLE}engagement = {degrees}\n"));
        let all: serde_json::Value = serde_json::from_str(&engagement_json(&outcome).unwrap()).unwrap();
        let number = |block: &serde_json::Value, key: &str| block[key].as_f64().unwrap();
        let blocks = all["setups"][0]["blocks"].as_array().unwrap();
        // Blocks of passes that cut all along; the helix cuts all around.
        let cuts = |b: &&serde_json::Value| {
            number(b, "length") > 1.5
                && number(b, "air") < 0.2 * number(b, "length")
                && number(b, "arc") < 180.0
        };
        let mut arcs: Vec<f64> = blocks.iter().filter(cuts).map(|b| number(b, "arc")).collect();
        arcs.sort_by(f64::total_cmp);
        let at = |share: f64| arcs[(share * arcs.len() as f64) as usize];
        assert!(arcs.len() > 200, "{}", arcs.len());
        assert!(
            (at(0.5) - degrees).abs() < 3.0 && at(0.95) < degrees + 6.0,
            "{degrees}: {} {}",
            at(0.5),
            at(0.95)
        );
    }
}

#[test]
fn pockets_that_cannot_be_are_refused_with_their_place() {
    let narrow = refused("rectangle = { size = [40, 9] }\ndepth = 5\n");
    assert_eq!(narrow.code, Code::CUTTER_TOO_LARGE);
    assert!(narrow.message.contains("the widest place of the pocket is 9.000 mm"), "{}", narrow.message);
    let tight = refused("rectangle = { size = [40, 10.05] }\ndepth = 5\n");
    assert!([Code::ENTRY_IMPOSSIBLE, Code::POCKET_LEFT].contains(&tight.code), "{tight:?}");
    for (keys, key) in [
        ("engagement = 150\n", "engagement"),
        ("engagement = 0\n", "engagement"),
        ("depth = 0\n", "depth"),
        ("stepdown = 30\n", "stepdown"),
        ("entry = { helix = 80 }\n", "entry.helix"),
        ("entry = { helix = 3, radius = 7 }\n", "entry.radius"),
        ("link_feed = -1\n", "link_feed"),
        ("lift = -1\n", "lift"),
    ] {
        let rest = if key == "depth" { RECTANGLE.replace("depth = 8\n", "") } else { RECTANGLE.to_owned() };
        let text = format!("{POCKET}{rest}{keys}");
        let text = if key == "stepdown" { text.replace("stepdown = 5\n", "") } else { text };
        let error = run("job.toml", &job("fanuc", &text), &MemoryLoader::default(), &Silent)
            .map(|_| ())
            .unwrap_err()
            .0;
        let found = error.key.clone().unwrap_or_default();
        assert!(found.ends_with(key), "{keys}: {found}: {error:?}");
    }
}

#[test]
fn a_leg_that_is_narrower_than_the_cutter_is_named() {
    let leg = "polygon = [[-40, -20], [40, -20], [40, -11], [0, -11], [0, 20], [-40, 20]]\ndepth = 5\n";
    let outcome = cut("fanuc", leg);
    let found = &outcome.verdict.found;
    let words = "does not go into a part of the outline: up to 38.3 mm stay near";
    assert!(found.len() == 1 && found[0].message.contains(words), "{found:?}");
    assert!(found[0].message.contains("inside corners stay at 3 places"), "{found:?}");
    let told = outcome.verdict.unchecked().any(|item| {
        let item = format!("{item:?}");
        item.contains("1 part that the cutter does not enter") && item.contains("3 corners beyond")
    });
    assert!(told);
}

#[test]
fn islands_of_a_pocket_that_goes_through_come_loose() {
    let island = "outline = { loops = [[[-40, -30], [40, -30], [40, 30], [-40, 30]], { centre = [5, 0], radius = 9 }] }\n";
    let loose = |depth: &str| {
        let outcome = cut("fanuc", &format!("{island}{depth}"));
        outcome
            .verdict
            .found
            .iter()
            .any(|f| f.code == Code::SLUG && f.message.contains("1 island comes loose"))
    };
    assert!(loose("depth = 20\nbreakthrough = 0.5\n") && !loose("depth = 18\n"));
}

#[test]
fn the_edge_of_a_pocket_is_chamfered_by_its_name() {
    let chamfer = "[[setup.operation]]\ntype = \"chamfer\"\ntool = 5\nspeed = 8000\nfeed = 800\n\
        of = \"basin\"\nwidth = 0.5\n";
    let outcome = done("fanuc", &format!("{POCKET}name = \"basin\"\n{RECTANGLE}{chamfer}"));
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    let claims = outcome.verdict.proven.iter().filter(|p| p.claim.contains("the chamfer lies within"));
    assert_eq!(claims.count(), 1, "{:?}", outcome.verdict.proven);
    // Its wall is that of the pocket, which is compared.
    assert!(!outcome.verdict.unchecked().any(|item| format!("{item:?}").contains("the wall below it")));
}
