//! Holes by their size: the operations that they become, the tools that are taken, spots before drills.

use kinecut::base::{Code, Finding, MemoryLoader, Silent};
use kinecut::job::{Outcome, run};

use crate::common::quads::{ring, sides, stl, turned};

/// A plate of 20 mm with a milled face, and the tools for its holes.
fn job(control: &str, more: &str, operations: &str) -> String {
    let drill = |number: u32, name: &str, diameter: f64, rest: &str, feed: f64| {
        format!(
            "[[tool]]\nnumber = {number}\nname = \"{name}\"\ntype = \"drill\"\ndiameter = {diameter}\nflute_length = 60\n\
             stickout = 80\ngauge_length = 160\n{rest}preset = [{{ material = \"C45\", cutting_speed = 20, feed_per_rev = {feed} }}]\n"
        )
    };
    let tools = [
        drill(1, "spot drill 90", 10.0, "point_angle = 90\n", 0.1),
        drill(2, "drill 6.6", 6.6, "", 0.13),
        drill(3, "drill 6.8", 6.8, "", 0.13),
        drill(4, "drill 7.8", 7.8, "", 0.15),
        drill(
            5,
            "reamer 8H7",
            8.0,
            "centre_cutting = false\npoint = { cone = { cone_angle = 90, nose_diameter = 7.6 } }\n",
            0.16,
        ),
        drill(6, "drill 12", 12.0, "", 0.2),
    ];
    format!(
        r#"format = 1
material = "C45"
post = {{ control = "{control}" }}
stock = {{ box = {{ min = [-60, -40, -20], max = [60, 40, 1] }} }}
simulate = {{ step = 0.4 }}
{}
[[tool]]
number = 7
name = "tap M8"
type = "tap"
diameter = 8
pitch = 1.25
flute_length = 20
shank_diameter = 6
stickout = 60
gauge_length = 160
preset = [{{ material = "C45", cutting_speed = 12 }}]
[[tool]]
number = 8
name = "face mill 80"
type = "face-mill"
diameter = 90
flute_length = 10
teeth = 6
stickout = 40
gauge_length = 120
{more}
[[setup]]
offset = "G54"
[[setup.operation]]
type = "face"
tool = 8
outline = "top"
depth = 1
speed = 700
feed = 400
{operations}
"#,
        tools.concat()
    )
}

const THREAD_MILL: &str = r#"[[tool]]
number = 9
type = "thread-mill"
diameter = 5.5
pitch = 1.25
teeth = 3
rows = 10
flute_length = 14
stickout = 30
shank_diameter = 6
gauge_length = 120
preset = [{ material = "C45", cutting_speed = 80, feed_per_tooth = 0.03 }]
"#;

fn done(control: &str, more: &str, operations: &str) -> Outcome {
    run("job.toml", &job(control, more, operations), &MemoryLoader::default(), &Silent)
        .unwrap_or_else(|e| panic!("{control}: {e}"))
}

fn refused(operations: &str) -> Box<Finding> {
    run("job.toml", &job("fanuc", "", operations), &MemoryLoader::default(), &Silent)
        .map(|_| ())
        .unwrap_err()
        .0
}

fn names(outcome: &Outcome) -> Vec<String> {
    outcome.job.setups[0].operations.iter().map(|o| o.name()).collect()
}

/// Findings beside the notes about chosen tools.
fn findings(outcome: &Outcome) -> Vec<&Finding> {
    outcome.verdict.found.iter().filter(|f| f.code != Code::TOOL_CHOSEN).collect()
}

const HOLES: &str = r#"[[setup.operation]]
type = "hole"
size = 6.6
points = [[-50, -30], [50, 30]]
[[setup.operation]]
type = "hole"
size = "8H7"
points = [[-20, 0]]
[[setup.operation]]
type = "hole"
size = "M8"
depth = 12
points = [[20, 0], [30, 10]]
"#;

#[test]
fn holes_become_spots_drills_and_what_brings_them_to_size() {
    for control in ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc"] {
        let outcome = done(control, "", HOLES);
        assert_eq!(
            names(&outcome)[1..],
            [
                "centring 7, 2 holes",
                "centring 8.4 at X-20 Y0",
                "centring 8.4, 2 holes",
                "drilling 6.6, 2 holes",
                "drilling 7.8 at X-20 Y0",
                "drilling 6.8, 2 holes",
                "reaming 8 at X-20 Y0",
                "tap M8x1.25, 2 holes"
            ]
        );
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        assert!(findings(&outcome).is_empty(), "{control}: {:?}", findings(&outcome));
    }
    // GRBL has no synchronised spindle: the thread is milled.
    let outcome = done("grbl", THREAD_MILL, HOLES);
    assert!(names(&outcome)[8].starts_with("mill thread M8x1.25"), "{:?}", names(&outcome));
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
}

#[test]
fn the_drilling_knows_the_spot_and_the_depth_counts_from_the_milled_face() {
    let outcome = done(
        "fanuc",
        "",
        "[[setup.operation]]\ntype = \"hole\"\nsize = 6.6\ndepth = 15\npoints = [[0, 0]]\n",
    );
    assert!(findings(&outcome).is_empty(), "{:?}", findings(&outcome));
    let plan: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
    let hole = |i: usize| plan["setups"][0]["drillings"][i]["holes"][0].clone();
    // The spot: 90 degrees, 7 mm wide at the face in Z 0.
    let tip = hole(0)["zones"].as_array().unwrap().last().unwrap()["to"].as_f64().unwrap();
    assert!((tip + 3.5).abs() < 1e-9, "{}", hole(0));
    // The corner of the drill comes to the cone of the spot 0.2 mm below the face, its tip is deeper by its point then.
    let point = 3.3 / 59f64.to_radians().tan();
    let zones = hole(1)["zones"].as_array().unwrap().clone();
    let last = zones.iter().find(|z| z["stage"] == "entry").unwrap()["to"].as_f64().unwrap();
    assert!((last + 3.5).abs() < 1e-9 && hole(1)["first_contact_radius"] == 3.3, "{}", hole(1));
    let end = hole(1)["zones"].as_array().unwrap().last().unwrap()["to"].as_f64().unwrap();
    assert!((end + 15.0 + point).abs() < 1e-9, "{}", hole(1));
    // A face at another height.
    let text =
        job("fanuc", "", "[[setup.operation]]\ntype = \"hole\"\nsize = 6.6\ndepth = 15\npoints = [[0, 0]]\n");
    let text = text.replace("outline = \"top\"\ndepth = 1\n", "outline = \"top\"\ntop = -2\ndepth = 3\n");
    let lower = run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"));
    assert!(findings(&lower).is_empty(), "{:?}", findings(&lower));
    let plan: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&lower)).unwrap();
    let zero = plan["setups"][0]["drillings"][1]["holes"][0]["zero"].as_f64();
    assert!(zero.is_none_or(|zero| (zero + 2.0).abs() < 1e-9), "{zero:?}");
}

#[test]
fn a_reamer_leaves_at_feed_and_no_rapid_move_ends_in_a_spot() {
    let outcome = done("fanuc", "", HOLES);
    let text = &outcome.setups[0].posted.text;
    let from = text.find("(REAMING 8").unwrap();
    let reaming: Vec<&str> = text[from..].lines().take_while(|l| !l.starts_with("G53")).collect();
    let down = reaming.iter().rposition(|l| l.starts_with("Z-")).unwrap();
    // Up at the feed of the steady stretch, mm a revolution.
    let up = reaming[down + 1];
    assert!(up.starts_with('Z') && !up.starts_with("Z-") && up.ends_with(" F0.16"), "{reaming:?}");
    assert!(reaming[down + 2].starts_with("G0 Z"), "{reaming:?}");
    // 2 mm over the face in Z 0, for all that the spot is deeper.
    let from = text.find("(DRILLING 6.6").unwrap();
    let downs = text[from..].lines().take_while(|l| !l.starts_with("M5")).filter(|l| l.starts_with("G0 Z"));
    let lowest = downs.filter_map(|l| l[4..].parse::<f64>().ok()).fold(f64::INFINITY, f64::min);
    assert_eq!(lowest, 2.0);
}

#[test]
fn a_hole_that_goes_through_deeper_than_four_diameters_is_drilled_in_steps() {
    let fine = "[[tool]]\nnumber = 10\nname = \"drill 4\"\ntype = \"drill\"\ndiameter = 4\nflute_length = 40\nstickout = 50\n\
        gauge_length = 160\npreset = [{ material = \"C45\", cutting_speed = 20, feed_per_rev = 0.08 }]\n";
    let hole =
        |size: &str| format!("[[setup.operation]]\ntype = \"hole\"\nsize = {size}\npoints = [[0, 0]]\n");
    // Short lifts in the hole, which break the chip: half a millimetre, or what the control's cycle has.
    let lifts = |outcome: &Outcome| {
        let is_lift = |s: &&kinecut::trace::Segment| {
            let (a, b) = (s.curve.start(), s.curve.end());
            a.z < -2.0 && b.z - a.z > 1e-6 && b.z - a.z < 1.5 && (b - a).truncate().length() < 1e-9
        };
        outcome.setups[0].trace.segments.iter().filter(is_lift).count()
    };
    for control in ["fanuc", "linuxcnc", "heidenhain", "sinumerik-840d"] {
        // 20 mm thick: five diameters, of which the steady stretch takes 17.8 mm, and three.
        let deep = done(control, fine, &hole("4"));
        assert!(
            (4..=5).contains(&lifts(&deep)),
            "{control}: {} {}",
            lifts(&deep),
            deep.setups[0].posted.text
        );
        assert!(deep.verdict.is_safe() && findings(&deep).is_empty(), "{control}: {:?}", findings(&deep));
        assert_eq!(lifts(&done(control, fine, &hole("6.6"))), 0, "{control}");
    }
}

#[test]
fn tools_can_be_named_and_spots_left_out() {
    let hole = "[[setup.operation]]\ntype = \"hole\"\nsize = \"M8\"\npoints = [[0, 0]]\n";
    let outcome = done(
        "fanuc",
        THREAD_MILL,
        &format!("{hole}depth = 10\nspot = false\ntool = 9\ndrill = \"drill 6.8\"\n"),
    );
    let names = names(&outcome);
    assert_eq!(names[1], "drilling 6.8 at X0 Y0");
    assert!(names[2].starts_with("mill thread M8x1.25") && names.len() == 3, "{names:?}");
    // Through: the tap goes through the stock, which ends at Z -20.
    let outcome = done("fanuc", "", hole);
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    let plan: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
    assert_eq!(plan["setups"][0]["threads"][0]["depth"].as_f64(), Some(20.0));
}

/// Of drills as near to the usual diameter the wider is taken, of those alike the shortest that reaches, for a hole through the longest.
#[test]
fn the_drill_that_suits_best_is_taken() {
    let drill = |number: u32, diameter: f64, flutes: f64| {
        format!(
            "[[tool]]\nnumber = {number}\ntype = \"drill\"\ndiameter = {diameter}\nflute_length = {flutes}\nstickout = 80\n\
             gauge_length = 160\npreset = [{{ material = \"C45\", cutting_speed = 20, feed_per_rev = 0.1 }}]\n"
        )
    };
    let more =
        [drill(21, 6.7, 60.0), drill(22, 6.8, 25.0), drill(23, 6.8, 28.0), drill(24, 6.8, 70.0)].concat();
    let taken = |depth: &str| {
        let hole = format!(
            "[[setup.operation]]\ntype = \"hole\"\nsize = \"M8\"\nspot = false\npoints = [[0, 0]]\n{depth}"
        );
        let outcome = done("fanuc", &more, &hole);
        outcome.job.setups[0].operations[1].milling().tool.number.0
    };
    // Drilled to 15 with 10 of thread, 19 with 14: the flutes reach a diameter farther.
    assert_eq!([taken("depth = 10\n"), taken("depth = 14\n"), taken("")], [22, 23, 24]);
}

#[test]
fn what_is_missing_is_said_with_what_is_there() {
    let hole = |rest: &str| format!("[[setup.operation]]\ntype = \"hole\"\npoints = [[0, 0]]\n{rest}\n");
    for (rest, key, says) in [
        ("size = 6.5", "size", "no drill 6.5 for a hole of 6.5 in the job; the nearest is 6.6"),
        ("size = \"10H7\"", "size", "no reamer 10 for 10H7 in the job"),
        ("size = \"M10\"", "size", "no tap M10x1.5 and no thread mill for it in the job"),
        (
            "size = \"M8\"\npilot = 7.2",
            "size",
            "no drill 7.2 for M8x1.25 in the job; 6.8 gives 89 % of the thread, 7.8 gives 15 % of the thread",
        ),
        ("size = \"8h7\"", "size", "`8h7` is no size of a hole"),
        ("size = 12\npilot = 5", "pilot", "a plain hole has no pilot"),
        ("size = \"8H7\"\npilot = 8", "pilot", "the pilot is as wide as the hole"),
        ("size = \"8H7\"\npilot = 7.8\ndrill = 4", "pilot", "`pilot` and `drill` exclude each other"),
        ("size = 12\ntool = 6", "tool", "a plain hole has only a drill"),
        ("size = 12\nspot = false\nchamfer = 0.3", "chamfer", "a hole without a spot has none of its keys"),
        ("size = 12\ndrill = \"drill 13\"", "drill", "`drill 13` is not defined"),
        ("size = 12\ndepth = -1", "depth", "depth must be positive"),
    ] {
        let error = refused(&hole(rest));
        assert_eq!(error.key.as_deref(), Some(&*format!("setup[0].operation[1].{key}")), "{rest}: {error:?}");
        assert!(error.message.contains(says), "{rest}: {}", error.message);
        let place = error.place.as_ref().unwrap();
        assert!(place.line > 90, "{rest}: {place:?}");
    }
    let text = job("fanuc", "", &hole("size = 12")).replace("material = \"C45\"\npost", "post");
    let error = run("job.toml", &text, &MemoryLoader::default(), &Silent).map(|_| ()).unwrap_err().0;
    assert!(error.message.contains("the job has no material"), "{error:?}");
    let text =
        job("fanuc", "", &hole("size = 12")).replace("material = \"C45\"\npost", "material = \"S235\"\npost");
    let error = run("job.toml", &text, &MemoryLoader::default(), &Silent).map(|_| ()).unwrap_err().0;
    assert!(
        error.message.contains("T1 has no preset for S235, and there are no values to start with for S235"),
        "{error:?}"
    );
}

/// Errors of operations after a hole keep their place though the hole has become several of them.
#[test]
fn places_are_those_of_the_text() {
    let after = "[[setup.operation]]\ntype = \"drill\"\ntool = 6\npoints = [[0, 0], [1, 1]]\nspeed = -5\nfeed_per_rev = { steady = 0.1 }\n";
    let operations = format!("{HOLES}{after}");
    let error = refused(&operations);
    let text = job("fanuc", "", &operations);
    let line = text.lines().position(|l| l == "speed = -5").unwrap() + 1;
    assert_eq!(error.place.as_ref().map(|p| p.line as usize), Some(line), "{error:?}");
    // A hole off the stock: at its own point.
    let off = HOLES.replace("[30, 10]", "[90, 10]");
    let error = refused(&off);
    let line = job("fanuc", "", &off).lines().position(|l| l.contains("[90, 10]")).unwrap() + 1;
    assert_eq!(error.place.as_ref().map(|p| p.line as usize), Some(line), "{error:?}");
}

#[test]
fn a_spot_is_drilling_by_centring() {
    let spot = |kind: &str| {
        format!(
            "[[setup.operation]]\n{kind}\ntool = 1\npoints = [[10, 5], [-20, 0]]\nreach_diameter = 7\nspeed = 900\nfeed_per_rev = {{ steady = 0.1 }}\ntop = 0\n"
        )
    };
    let text = |kind: &str| done("linuxcnc", "", &spot(kind)).setups[0].posted.text.clone();
    let plain = text("type = \"spot\"");
    assert_eq!(plain, text("type = \"drill\"\nmethod = \"centring\""));
    let error = refused(&spot("type = \"spot\"\nmethod = \"reaming\""));
    assert!(error.message.contains("a spot has no method") && error.place.is_some(), "{error}");
    let error = refused("[[setup.operation]]\ntype = \"spot\"\n");
    assert!(error.message.contains("`tool` is missing"), "{error}");
}

/// Tools for recesses: a countersink, a counterbore.
const RECESSES: &str = "[[tool]]\nnumber = 11\nname = \"countersink 90\"\ntype = \"drill\"\ndiameter = 16.5\nflute_length = 12\n\
    stickout = 40\ngauge_length = 160\npoint = { cone = { cone_angle = 90, nose_diameter = 3.2 } }\n\
    preset = [{ material = \"C45\", cutting_speed = 20, feed_per_rev = 0.1 }]\n\
    [[tool]]\nnumber = 12\nname = \"counterbore 11\"\ntype = \"drill\"\ndiameter = 11\nflute_length = 20\nstickout = 40\n\
    gauge_length = 160\npoint = \"flat\"\npreset = [{ material = \"C45\", cutting_speed = 18, feed_per_rev = 0.1 }]\n";

#[test]
fn recesses_for_screws_are_made_before_the_hole_is_brought_to_size() {
    let holes = r#"
[[setup.operation]]
type = "hole"
size = 6.6
points = [[-20, 20]]
countersink = { diameter = 12.6 }
[[setup.operation]]
type = "hole"
size = 6.6
points = [[0, 20]]
counterbore = { diameter = 11, depth = 6.8 }
[[setup.operation]]
type = "hole"
size = "8H7"
points = [[20, 20]]
countersink = { diameter = 9 }
[[setup.operation]]
type = "hole"
size = "8H7"
points = [[-20, -20]]
depth = 15
counterbore = { diameter = 11, depth = 3 }
[[setup.operation]]
type = "hole"
size = "M8"
points = [[0, -20]]
counterbore = { diameter = 11, depth = 4 }
"#;
    for control in ["fanuc", "sinumerik-840d", "heidenhain", "linuxcnc"] {
        let outcome = done(control, RECESSES, holes);
        let names = names(&outcome);
        let recesses: Vec<&String> = names.iter().filter(|n| n.starts_with("counter")).collect();
        assert_eq!(
            recesses,
            [
                "countersinking 12.6 at X-20 Y20",
                "countersinking 9 at X20 Y20",
                "counterboring 11 at X0 Y20",
                "counterboring 11 at X-20 Y-20",
                "counterboring 11 at X0 Y-20",
            ]
        );
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        assert!(findings(&outcome).is_empty(), "{control}: {:?}", findings(&outcome));
    }
    let outcome = done("fanuc", RECESSES, holes);
    let plan: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
    let lists = plan["setups"][0]["drillings"].as_array().unwrap();
    let end = |of: usize| {
        lists[of]["holes"][0]["zones"].as_array().unwrap().last().unwrap()["to"].as_f64().unwrap()
    };
    let number = |name: &str| {
        outcome.job.setups[0].operations[1..].iter().position(|o| o.name() == name).expect("the recess")
    };
    // A cone of 90 degrees is as deep as it is wide on one side: without its nose of 3.2 mm.
    let tip = end(number("countersinking 12.6 at X-20 Y20"));
    assert!((tip + 0.5 * (12.6 - 3.2)).abs() < 1e-9, "{tip}");
    let floor = end(number("counterboring 11 at X0 Y20"));
    assert!((floor + 6.8).abs() < 1e-9, "{floor}");
    // The thread begins at the floor of its recess.
    let threads = plan["setups"][0]["threads"][0].clone();
    assert!((threads["reference"].as_f64().unwrap() - (-4.0 + 2.0 * 1.25)).abs() < 2.0, "{threads}");
}

#[test]
fn a_blind_hole_that_is_reamed_breaks_through_nothing() {
    let hole = "[[setup.operation]]\ntype = \"hole\"\nsize = \"8H7\"\ndepth = 12\npoints = [[0, 0]]\n";
    let outcome = done("fanuc", "", hole);
    assert!(outcome.verdict.is_safe() && findings(&outcome).is_empty(), "{:?}", findings(&outcome));
    let plan: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
    let ream = plan["setups"][0]["drillings"].as_array().unwrap().last().unwrap()["holes"][0].clone();
    // All of the ring is in below the face, and cuts to the depth: nothing of the drilled hole's floor is met.
    let zones: Vec<&str> =
        ream["zones"].as_array().unwrap().iter().filter_map(|z| z["stage"].as_str()).collect();
    assert_eq!(zones.last(), Some(&"partial"), "{ream}");
    assert!(ream["lengths"]["L_ust"].as_f64().is_some_and(|l| l > 10.0), "{ream}");
}

#[test]
fn recesses_that_cannot_be_made_are_refused() {
    let hole = |keys: &str| {
        let operations =
            format!("[[setup.operation]]\ntype = \"hole\"\nsize = 6.6\npoints = [[0, 0]]\n{keys}");
        let text = job("fanuc", RECESSES, &operations);
        let Err(e) = run("job.toml", &text, &MemoryLoader::default(), &Silent) else { panic!("{keys}") };
        (e.0.message.clone(), e.0.key.clone().unwrap_or_default())
    };
    for (keys, words, key) in [
        ("countersink = { diameter = 6 }", "not wider than the hole", "countersink.diameter"),
        ("countersink = { diameter = 17 }", "no countersink of 90 degrees for 17", "countersink"),
        ("countersink = { diameter = 12, angle = 82 }", "no countersink of 82 degrees", "countersink"),
        ("countersink = { diameter = 12, angle = 180 }", "between 0 and 180", "countersink.angle"),
        ("countersink = { diameter = 12, tool = \"drill 12\" }", "another angle", "countersink.tool"),
        ("counterbore = { diameter = 10, depth = 5 }", "no counterbore 10", "counterbore"),
        ("counterbore = { diameter = 11, depth = -5 }", "depth", "counterbore.depth"),
        ("counterbore = { diameter = 11, depth = 5, tool = 6 }", "does not fit", "counterbore.tool"),
        (
            "counterbore = { diameter = 11, depth = 5 }\ncountersink = { diameter = 12 }",
            "exclude",
            "counterbore",
        ),
        ("depth = 5\ncounterbore = { diameter = 11, depth = 6 }", "depth", "counterbore.depth"),
    ] {
        let (message, at) = hole(keys);
        assert!(message.contains(words), "{keys}: {message}");
        assert!(at.ends_with(key), "{keys}: {at}");
    }
}

#[test]
fn a_stock_that_is_a_mesh_is_drilled_from_the_milled_face_like_a_box() {
    let of_box = done("fanuc", "", HOLES);
    let text = job("fanuc", "", HOLES);
    let mesh =
        text.replace("{ box = { min = [-60, -40, -20], max = [60, 40, 1] } }", "{ mesh = \"raw.stl\" }");
    assert_ne!(mesh, text);
    let of_mesh = |heights: [f64; 4]| {
        let low = ring([60.0, 40.0], -20.0);
        let high = std::array::from_fn(|i| [low[i][0], low[i][1], heights[i]]);
        let quads = [sides(low, high).to_vec(), vec![high, turned(low)]].concat();
        let loader = MemoryLoader::default().with("raw.stl", stl(&quads));
        run("job.toml", &mesh, &loader, &Silent).unwrap_or_else(|e| panic!("{e}"))
    };
    let moves = |outcome: &Outcome| -> Vec<String> {
        outcome.setups[0].posted.text.lines().filter(|l| !l.contains('(')).map(str::to_owned).collect()
    };
    // Level: the same program. Leaning, as a casting may be, and milled level: the holes are those of the box too.
    for heights in [[1.0; 4], [0.25, 1.0, 1.0, 0.25]] {
        let outcome = of_mesh(heights);
        assert!(outcome.verdict.is_safe() && findings(&outcome).is_empty(), "{:?}", findings(&outcome));
        assert_eq!(moves(&outcome), moves(&of_box), "{heights:?}");
    }
}
