//! Milled faces as operations after them see them: holes begin there.

use kinecut::base::{MemoryLoader, Silent};
use kinecut::job::{Outcome, run};

fn job(stock: &str, operations: &str) -> String {
    format!(
        r#"format = 1
stock = {stock}
post = {{ control = "fanuc" }}
simulate = {{ step = 0.5 }}
[[tool]]
number = 1
type = "face-mill"
diameter = 50
flute_length = 8
teeth = 5
[[tool]]
number = 2
type = "drill"
diameter = 8
flute_length = 60
[[setup]]
offset = "G54"
safe_height = 40
{operations}"#
    )
}

const BOX: &str = "{ box = { min = [-40, -20, -20], max = [40, 20, 0] } }";
const FACE: &str =
    "[[setup.operation]]\ntype = \"face\"\ntool = 1\noutline = \"top\"\nspeed = 1000\nfeed_per_tooth = 0.1\n";
const DRILL: &str =
    "[[setup.operation]]\ntype = \"drill\"\ntool = 2\nspeed = 1500\nfeed_per_rev = { steady = 0.15 }\n";

fn done(stock: &str, operations: &str) -> Outcome {
    let text = job(stock, operations);
    run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"))
}

/// The lines of the program from the drill on.
fn drilled(outcome: &Outcome) -> Vec<String> {
    let lines: Vec<String> = outcome.setups[0].posted.text.lines().map(str::to_owned).collect();
    let first = lines.iter().position(|l| l.contains("T2")).expect("the drill");
    // Without their numbers.
    let is_number = |w: &str| w.strip_prefix('N').is_some_and(|n| n.chars().all(|c| c.is_ascii_digit()));
    let words = |l: &String| l.split(' ').filter(|w| !is_number(w)).collect::<Vec<_>>().join(" ");
    lines[first..].iter().map(words).collect()
}

#[test]
fn a_depth_that_lies_out_of_the_stock_goes_through() {
    let face = format!("{FACE}top = -0.5\ndepth = 0.5\n");
    let through =
        "entry = { surface = \"plane\" }\nexit = { surface = \"plane\" }\ntop = -0.5\nlength = 19.5\n";
    for (depth, overrun) in [(20.0, 0.0), (20.5, 0.5), (23.5, 3.5)] {
        let hole = format!("{DRILL}points = [[10, 5]]\n");
        // Depths count from `top`, here 0, whatever the face has taken.
        let deep = done(BOX, &format!("{face}{hole}depth = {depth}\n"));
        assert!(deep.verdict.is_safe() && deep.verdict.found.is_empty(), "{depth}: {:?}", deep.verdict.found);
        let given = done(BOX, &format!("{face}{hole}{through}overrun = {overrun}\n"));
        assert_eq!(drilled(&deep), drilled(&given), "{depth}");
    }
    // Where the point comes out but not the full diameter, and where nothing does.
    let codes = |depth: f64| {
        let outcome = done(BOX, &format!("{DRILL}points = [[10, 5]]\ndepth = {depth}\n"));
        outcome.verdict.found.iter().map(|f| f.code.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(codes(19.0), ["KC0905"]);
    assert!(codes(15.0).is_empty() && codes(17.0).is_empty());
}

#[test]
fn a_hole_begins_at_the_face_that_was_milled() {
    let face = format!("{FACE}top = -0.5\ndepth = 0.5\n");
    let hole = format!("{DRILL}points = [[10, 5], [-20, 0]]\n");
    let plain = done(BOX, &format!("{face}{hole}"));
    assert!(plain.verdict.is_safe() && plain.verdict.found.is_empty(), "{:?}", plain.verdict.found);
    // The same as with the plane given by hand.
    let entry =
        "entry = { surface = \"plane\" }\nexit = { surface = \"plane\" }\ntop = -0.5\nlength = 19.5\n";
    let given = done(BOX, &format!("{face}{hole}{entry}"));
    assert!(given.verdict.found.is_empty(), "{:?}", given.verdict.found);
    assert_eq!(drilled(&plain), drilled(&given));
    // Drilled first, the hole begins at the raw stock.
    let before = done(BOX, &format!("{hole}{face}"));
    assert!(
        before.verdict.found.iter().all(|f| f.code.to_string() != "KC0905"),
        "{:?}",
        before.verdict.found
    );
    assert_ne!(drilled(&before), drilled(&plain));
}

#[test]
fn a_hole_begins_at_the_face_where_all_of_it_was_milled() {
    // The face reaches to X 10, the cutter of 50 ends with its middle at X 40, and the stock goes on.
    let long = "{ box = { min = [-40, -20, -20], max = [120, 20, 0] } }";
    let face = |more: &str| {
        let loops = format!(
            "outline = {{ loops = [ {{ points = [[-40, -20], [10, -20], [10, 20], [-40, 20]] }}{more} ] }}\n"
        );
        format!("{}top = -0.5\ndepth = 0.5\n", FACE.replace("outline = \"top\"\n", &loops))
    };
    let at = |more: &str, x: f64| {
        let outcome = done(long, &format!("{}{DRILL}points = [[{x}, 0]]\n", face(more)));
        let zones = outcome.verdict.found.iter().filter(|f| f.code.to_string() == "KC0905").count();
        assert_eq!(zones, 0, "{more} {x}: {:?}", outcome.verdict.found);
        let mut lines = drilled(&outcome).into_iter().filter(|l| l.contains("G1 Z"));
        lines.next_back().expect("the entry")
    };
    let [over, beside, raw] = [-20.0, 30.0, 100.0].map(|x| at("", x));
    assert_eq!(over, beside);
    assert_ne!(over, raw);
    // Half under the end of the cutter's way: from the raw stock.
    assert_eq!(at("", 63.0), raw);
    // A hole that the drawing of the face has already.
    assert_eq!(at(", { centre = [-20, 0], radius = 4 }", -20.0), over);
}

#[test]
fn a_bar_that_was_milled_flat_is_entered_at_its_flat() {
    let bar = "{ cylinder = { base = [0, 0, 0], diameter = 60, height = 100 } }";
    let lying = "zero = [0, 0, 50]\norient = { x = [0, 0, 1], z = [1, 0, 0] }\n";
    let flat = "outline = { loops = [ { points = [[-30, -20], [30, -20], [30, 20], [-30, 20]] } ] }\n";
    let face = format!("{}top = 22\ndepth = 8\n", FACE.replace("outline = \"top\"\n", flat));
    let hole = format!("{DRILL}points = [[5, 3]]\ntop = 22\ndepth = 10\n");
    let [found, given] = ["", "entry = { surface = \"plane\" }\n"].map(|entry| {
        let outcome = done(bar, &format!("{lying}{face}{hole}{entry}"));
        let zones = outcome.verdict.found.iter().filter(|f| f.code.to_string() == "KC0905").count();
        assert_eq!(zones, 0, "{:?}", outcome.verdict.found);
        drilled(&outcome)
    });
    assert_eq!(found, given);
}

/// The programs of a job in which a drill of 5 mm goes through before one of 8, from above or, in a second setup, from below.
fn opened(more: &str, turned: bool) -> Outcome {
    let small = DRILL.replace("tool = 2", "tool = 3");
    let tool = "[[tool]]\nnumber = 3\ntype = \"drill\"\ndiameter = 5\nflute_length = 60\n[[setup]]";
    let (setup, at) = match turned {
        true => (
            "[[setup]]\noffset = \"G55\"\nsafe_height = 40\nzero = [0, 0, -20]\norient = { x = [1, 0, 0], z = [0, 0, -1] }\n",
            "[[10, -5]]",
        ),
        false => ("", "[[10, 5]]"),
    };
    let text = job(BOX, &format!("{small}points = [[10, 5]]\n{setup}{DRILL}points = {at}\n{more}"));
    let text = text.replacen("[[setup]]", tool, 1);
    run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_drill_opens_out_a_hole_that_was_drilled_from_either_side() {
    for turned in [false, true] {
        let lines = |more: &str| {
            let outcome = opened(more, turned);
            // Of the narrower hole nothing is left to be measured; no point meets stock outside of its zones.
            let zones = outcome.verdict.found.iter().filter(|f| f.code.to_string() == "KC0905").count();
            assert_eq!(zones, 0, "{:?}", outcome.verdict.found);
            let text = &outcome.setups[usize::from(turned)].posted.text;
            let lines: Vec<String> = text.lines().map(str::to_owned).collect();
            let first = lines.iter().position(|l| l.contains("T2")).expect("the drill");
            lines[first..].to_vec()
        };
        let (found, given) = (lines(""), lines("pre_hole = { diameter = 5 }\n"));
        assert_eq!(found, given, "{turned}");
        // Of a hole into the solid the point is what comes in first.
        let solid = lines("entry = { surface = \"plane\" }\nexit = { surface = \"plane\" }\nlength = 20\n");
        assert_ne!(found, solid, "{turned}");
    }
}

/// A drill of a diameter goes 12 mm deep from above, then one of 8 mm at the same place, from above or from below.
fn after_blind(diameter: f64, more: &str, turned: bool) -> kinecut::base::Result<Outcome> {
    let first = DRILL.replace("tool = 2", "tool = 3");
    let tool = format!(
        "[[tool]]\nnumber = 3\ntype = \"drill\"\ndiameter = {diameter}\nflute_length = 60\n[[setup]]"
    );
    let (setup, at) = match turned {
        true => (
            "[[setup]]\noffset = \"G55\"\nsafe_height = 40\nzero = [0, 0, -20]\norient = { x = [1, 0, 0], z = [0, 0, -1] }\n",
            "[[10, -5]]",
        ),
        false => ("", "[[10, 5]]"),
    };
    let text =
        job(BOX, &format!("{first}points = [[10, 5]]\ndepth = 12\n{setup}{DRILL}points = {at}\n{more}"));
    run("job.toml", &text.replacen("[[setup]]", &tool, 1), &MemoryLoader::default(), &Silent)
}

/// The zones of the second drill: stage and Z of its end; and whether anything was found.
fn zones_after(diameter: f64, more: &str, turned: bool) -> (Vec<(String, f64)>, Vec<String>) {
    let outcome = after_blind(diameter, more, turned).unwrap_or_else(|e| panic!("{e}"));
    let plan: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).expect("JSON");
    let last = plan["setups"].as_array().and_then(|all| all.last()).expect("a setup");
    let drillings = last["drillings"].as_array().expect("drillings");
    let zones = drillings.last().expect("two")["holes"][0]["zones"].as_array().expect("zones").clone();
    let zone = |z: &serde_json::Value| {
        (z["stage"].as_str().unwrap_or("").to_owned(), z["to"].as_f64().unwrap_or(f64::NAN))
    };
    let found = outcome.verdict.found.iter().map(|f| f.code.to_string()).collect();
    (zones.iter().map(zone).collect(), found)
}

#[test]
fn a_drill_knows_the_blind_hole_that_was_drilled_before_it() {
    let cot = |angle: f64| 1.0 / angle.to_radians().tan();
    let point = |diameter: f64| 0.5 * diameter * cot(59.0);
    // Narrower, from above: the annulus goes in at the face, the middle all at once at the floor that has its form, steady below.
    let (zones, found) = zones_after(5.0, "", false);
    let stages: Vec<&str> = zones.iter().map(|z| z.0.as_str()).collect();
    assert_eq!(stages, ["entry", "partial", "steady", "exit"], "{zones:?}");
    assert!((zones[1].1 - (-12.0 - point(5.0))).abs() < 1e-6, "{zones:?}");
    assert!(!found.contains(&"KC0905".to_owned()), "{found:?}");
    // As wide, deeper: nothing of the point meets anything above the floor, which its own form fits all over at once.
    let (zones, found) = zones_after(8.0, "", false);
    let stages: Vec<&str> = zones.iter().map(|z| z.0.as_str()).collect();
    assert_eq!(stages, ["entry", "steady", "exit"], "{zones:?}");
    assert!((zones[0].1 - (-12.0 - point(8.0))).abs() < 1e-6, "{zones:?}");
    assert!(!found.contains(&"KC0905".to_owned()), "{found:?}");
    // From below: tip against tip, the corner last.
    for diameter in [8.0, 10.0] {
        let (zones, found) = zones_after(diameter, "", true);
        let stages: Vec<&str> = zones.iter().map(|z| z.0.as_str()).collect();
        assert_eq!(stages, ["entry", "steady", "exit"], "{zones:?}");
        // From below Z runs from 0 to 20: the tip of the first hole lies at 20 less its depth less its point.
        assert!((zones[1].1 - -(20.0 - 12.0 - point(diameter))).abs() < 1e-6, "{diameter} {zones:?}");
        assert!(!found.contains(&"KC0905".to_owned()), "{diameter} {found:?}");
        // All of it is out where both corners meet, and the usual 2 mm below.
        let out = -(20.0 - 12.0 - point(diameter)) - 2.0 * point(8.0) - 2.0;
        assert!((zones[2].1 - out).abs() < 1e-6, "{diameter} {zones:?} {out}");
    }
    // A narrower one from below: the middle comes out first.
    let (zones, found) = zones_after(5.0, "", true);
    let stages: Vec<&str> = zones.iter().map(|z| z.0.as_str()).collect();
    assert_eq!(stages, ["entry", "steady", "exit", "partial", "exit"], "{zones:?}");
    assert!(!found.contains(&"KC0905".to_owned()), "{found:?}");
    // A depth that ends in the solid between stays blind.
    let (zones, found) = zones_after(8.0, "depth = 3\n", true);
    assert_eq!(zones.last().map(|z| z.0.as_str()), Some("steady"), "{zones:?}");
    assert!(!found.contains(&"KC0905".to_owned()), "{found:?}");
    // One that comes out is planned as through.
    let (zones, found) = zones_after(8.0, "depth = 10\n", true);
    assert_eq!(zones.last().map(|z| z.0.as_str()), Some("exit"), "{zones:?}");
    assert!(!found.contains(&"KC0905".to_owned()), "{found:?}");
}

#[test]
fn a_hole_in_which_nothing_is_left_to_drill_is_refused() {
    for (diameter, more) in [(8.0, "depth = 12\n"), (8.0, "depth = 5\n"), (10.0, "depth = 9\n")] {
        let Err(e) = after_blind(diameter, more, false) else { panic!("{diameter} {more}") };
        assert!(e.0.message.contains("nothing is left to drill"), "{}", e.0.message);
        assert!(e.0.message.contains("goes down to Z"), "{}", e.0.message);
    }
    let second = format!("{DRILL}points = [[10, 5]]\n");
    let text = job(BOX, &format!("{second}{second}"));
    let Err(e) = run("job.toml", &text, &MemoryLoader::default(), &Silent) else { panic!("drilled twice") };
    assert!(e.0.message.contains("nothing is left to drill: the hole of 8 mm that is there goes through"));
}

#[test]
fn a_face_that_was_milled_after_a_blind_hole_takes_its_floor_with_it() {
    // Drilled 3 mm deep, its tip 5.4 mm; then the face lowered by 6 mm, or by 4: into the cone.
    for top in [6.0, 4.0] {
        let hole = format!("{DRILL}points = [[10, 5]]\n");
        let face = format!("{FACE}top = -{top}\ndepth = {top}\n");
        let outcome = done(BOX, &format!("{hole}depth = 3\n{face}{hole}"));
        // Of the first hole nothing is left to be measured; nothing else is found.
        let found = &outcome.verdict.found;
        assert!(found.iter().all(|f| f.code.to_string() == "KC0528"), "top {top}: {found:?}");
        let plan: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).expect("JSON");
        let zones = plan["setups"][0]["drillings"][1]["holes"][0]["zones"].as_array().expect("zones").clone();
        // It goes in at the face: its point is in 2.4 mm below that.
        let point = 4.0 / 59f64.to_radians().tan();
        assert!((zones[0]["to"].as_f64().expect("Z") - (-top - point)).abs() < 1e-9, "{zones:?}");
    }
}

#[test]
fn a_hole_through_a_wall_alone_does_not_go_through() {
    // The first wall of a tube, as the table says: its way on is not drilled yet.
    let wall = "entry = { surface = \"plane\" }\nexit = { surface = \"plane\" }\nlength = 5\n";
    let hole = format!("{DRILL}points = [[10, 5]]\n");
    let text = job(BOX, &format!("{hole}{wall}{hole}"));
    let outcome = run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"));
    assert!(outcome.setups[0].posted.text.contains("Z-24.404"), "{}", outcome.setups[0].posted.text);
}

/// A pocket or a bore 8 mm deep, and a drill of 8 mm through at a place: the outcome, and the zones of the drill as (stage, Z of the end).
fn in_floor(first: &str, at: &str, more: &str) -> (Outcome, Vec<(String, f64)>) {
    let mill = "[[tool]]\nnumber = 3\ntype = \"end-mill\"\ndiameter = 10\nteeth = 4\nflute_length = 26\nstickout = 40\n[[setup]]";
    let drill = format!("{DRILL}points = [{at}]\n{more}");
    let text = job(BOX, &format!("[[setup.operation]]\ntool = 3\nspeed = 6000\n{first}{drill}"));
    let text = text.replacen("[[setup]]", mill, 1);
    let outcome = run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"));
    let plan: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).expect("JSON");
    let zones = plan["setups"][0]["drillings"][0]["holes"][0]["zones"].as_array().expect("zones").clone();
    let zone = |z: &serde_json::Value| {
        (z["stage"].as_str().unwrap_or("").to_owned(), z["to"].as_f64().unwrap_or(f64::NAN))
    };
    let zones = zones.iter().map(zone).collect();
    (outcome, zones)
}

#[test]
fn a_hole_begins_at_the_floor_of_a_pocket_or_a_bore() {
    let pocket = "type = \"pocket\"\nrectangle = { size = [50, 32], corner = 6 }\ndepth = 8\nfeed = 1200\n";
    let bore = "type = \"bore\"\nat = [0, 0]\ndiameter = 32\ndepth = 8\nstrategy = \"lens-1\"\n\
        rough = { stepover = 3, allowance = 0.2, feed = 1200 }\nfinish = { feed = 600 }\n";
    let point = 4.0 / 59f64.to_radians().tan();
    for first in [pocket, bore] {
        let (outcome, zones) = in_floor(first, "[3, 2]", "");
        assert!(outcome.verdict.is_safe() && outcome.verdict.found.is_empty(), "{:?}", outcome.verdict.found);
        // The point goes in at the floor, and the rapid ends 2 mm above it.
        assert_eq!(zones[0].0, "entry", "{zones:?}");
        assert!((zones[0].1 - (-8.0 - point)).abs() < 1e-9, "{zones:?}");
        assert!(drilled(&outcome).iter().any(|l| l == "G0 Z-6."), "{first}");
        // A blind hole: its depth counts from `top`, here the face.
        let (outcome, zones) = in_floor(first, "[3, 2]", "depth = 14\n");
        assert!(outcome.verdict.is_safe() && outcome.verdict.found.is_empty(), "{:?}", outcome.verdict.found);
        assert!((zones.last().expect("a zone").1 - (-14.0 - point)).abs() < 1e-9, "{zones:?}");
    }
    // So near to the wall the cutter's middle has not been: it is planned from the face, and the proof says what it meets.
    let (_, zones) = in_floor(pocket, "[20.5, 0]", "");
    assert!((zones[0].1 + point).abs() < 1e-9, "{zones:?}");
    // Out of a pocket that was milled from the other side.
    let text = job(
        BOX,
        &format!(
            "[[setup.operation]]\ntool = 3\nspeed = 6000\n{pocket}[[setup]]\noffset = \"G55\"\nsafe_height = 40\nzero = [0, 0, -20]\n\
             orient = {{ x = [1, 0, 0], z = [0, 0, -1] }}\n{DRILL}points = [[3, -2]]\n"
        ),
    );
    let mill = "[[tool]]\nnumber = 3\ntype = \"end-mill\"\ndiameter = 10\nteeth = 4\nflute_length = 26\nstickout = 40\n[[setup]]";
    let outcome = run("job.toml", &text.replacen("[[setup]]", mill, 1), &MemoryLoader::default(), &Silent)
        .unwrap_or_else(|e| panic!("{e}"));
    assert!(outcome.verdict.is_safe() && outcome.verdict.found.is_empty(), "{:?}", outcome.verdict.found);
    let plan: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).expect("JSON");
    let end = plan["setups"][1]["drillings"][0]["holes"][0]["coordinates"]["Z_nvyh1"].as_f64();
    assert!(end.is_some_and(|z| (z + 12.0).abs() < 1e-9), "{end:?}");
}
