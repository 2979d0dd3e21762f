//! What an operation leaves, operations after it begin with: a milled face is where holes begin.

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
    lines[first..].iter().map(|l| l.split_once(' ').map_or(l.clone(), |(_, rest)| rest.to_owned())).collect()
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
fn a_face_that_ends_within_the_hole_is_not_where_it_begins() {
    // The face reaches to X 10: the drill at X 9 is half over it.
    let half = "outline = { loops = [ { points = [[-40, -20], [10, -20], [10, 20], [-40, 20]] } ] }\n";
    let face = FACE.replace("outline = \"top\"\n", half);
    let face = format!("{face}top = -0.5\ndepth = 0.5\n");
    let at = |x: f64| done(BOX, &format!("{face}{DRILL}points = [[{x}, 0]]\n"));
    let zones =
        |outcome: &Outcome| outcome.verdict.found.iter().filter(|f| f.code.to_string() == "KC0905").count();
    let outcomes = [-20.0, 9.0, 30.0].map(|x| (x, at(x)));
    assert_eq!(outcomes.each_ref().map(|(_, outcome)| zones(outcome)), [0; 3]);
    // Half over the end of the face it is drilled from the raw stock's height, as beside the face.
    let [over, half, beside] = outcomes.map(|(x, outcome)| {
        let lines = drilled(&outcome).into_iter().filter(|l| !l.contains(" AT X"));
        lines.map(|l| l.replace(&format!("X{x:.0}."), "X")).collect::<Vec<_>>()
    });
    assert_eq!(half, beside);
    assert_ne!(over, half);
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
