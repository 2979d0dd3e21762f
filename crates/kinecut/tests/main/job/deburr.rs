//! Deburring through the whole: the edges that face milling has left bad, posted for each control, read back, cut, and measured.

use glam::DVec2;
use kinecut::base::{Code, Error, MemoryLoader, Severity, Silent};
use kinecut::facing::passes::Met;
use kinecut::job::{Outcome, plan_json, run};
use serde_json::Value;

use crate::common::planned::faces;

const CONTROLS: [&str; 5] = ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc", "grbl"];

/// A plate of 60 x 40 with a bore of 14, half a millimetre to mill, then `operations`; keys of the face are `face`.
fn job(control: &str, face: &str, operations: &str) -> String {
    format!(
        r#"format = 1
post = {{ control = "{control}" }}
stock = {{ box = {{ min = [-30, -20, -8], max = [30, 20, 0.5] }} }}
drilled = [{{ at = [14, 5], diameter = 14, top = 1, bottom = -9 }}]
simulate = {{ step = 0.4, engagement = false }}
[[tool]]
number = 1
type = "face-mill"
diameter = 80
teeth = 5
flute_length = 8
stickout = 40
shank_diameter = 50
[[tool]]
number = 5
type = "tapered"
diameter = 0
half_angle = 45
flute_length = 3
shank_diameter = 6
stickout = 30
[[tool]]
number = 6
type = "ball-nose"
diameter = 4
teeth = 2
flute_length = 10
stickout = 30
[[setup]]
offset = "G54"
safe_height = 30
[[setup.operation]]
type = "face"
tool = 1
depth = 0.5
cutting_speed = 200
feed_per_tooth = 0.1
{face}
{operations}
"#
    )
}

const DRAWN: &str = "outline = \"top\"\nplacement = \"as-drawn\"\npasses = \"one\"\nexit_angle_min = 90\n";
const DEBURR: &str = "[[setup.operation]]\ntype = \"deburr\"\ntool = 5\nspeed = 12000\nfeed = 900\n";
const BALL: &str = "[[setup.operation]]\ntype = \"deburr\"\ntool = 6\nspeed = 12000\nfeed = 900\n";
const TABLE: &str = "burr = [[0, 0.30], [30, 0.25], [60, 0.12], [90, 0.05], [120, 0.03], [180, 0.02]]\n";

fn cut(control: &str, face: &str, operations: &str) -> Outcome {
    run("job.toml", &job(control, face, operations), &MemoryLoader::default(), &Silent)
        .unwrap_or_else(|e| panic!("{e}"))
}

fn refused(face: &str, operations: &str) -> Error {
    run("job.toml", &job("fanuc", face, operations), &MemoryLoader::default(), &Silent).unwrap_err()
}

fn json(outcome: &Outcome, list: &str) -> Value {
    let json: Value = serde_json::from_str(&plan_json(outcome)).unwrap();
    json["setups"][0][list][0].clone()
}

fn length(list: &Value) -> f64 {
    list.as_array().unwrap().iter().map(|p| p["to"].as_f64().unwrap() - p["from"].as_f64().unwrap()).sum()
}

fn burrs(json: &Value) -> Vec<Value> {
    let pieces = json["burrs"]["pieces"].as_array().unwrap().iter();
    pieces.flat_map(|p| p["burrs"].as_array().unwrap().clone()).collect()
}

#[test]
fn bad_edges_are_broken_on_every_control() {
    for control in CONTROLS {
        for (tool, what) in [(DEBURR, "the chamfer lies within"), (BALL, "the break lies within")] {
            let outcome = cut(control, DRAWN, &format!("{tool}edges = \"bad\"\nwidth = 0.3\n{TABLE}"));
            let verdict = &outcome.verdict;
            let errors: Vec<_> = verdict.found.iter().filter(|f| f.severity != Severity::Note).collect();
            assert!(verdict.is_safe() && errors.is_empty(), "{control}: {errors:?}");
            assert_eq!(verdict.proven.iter().filter(|p| p.claim.contains(what)).count(), 1, "{control}");
            // Each piece is measured for itself, and all of them are one shape.
            let pieces = &outcome.deviation.bores;
            let ends: usize = pieces.iter().map(|b| b.ends).sum();
            assert!(
                ends > 100 && pieces.iter().all(|b| b.ends > 0 && b.worst() < 2e-3),
                "{control}: {pieces:?}"
            );
            let count = json(&outcome, "deburrings")["burrs"]["pieces"].as_array().unwrap().len();
            assert!(pieces.len() == count && count > 1, "{control}: {pieces:?}");
            let scope = verdict.scope.join(" ");
            assert!(scope.contains("1 deburring") && !scope.contains("deburrings"), "{control}: {scope}");
            // Treated is what is bad, all of it.
            let own = json(&outcome, "deburrings");
            let treated = burrs(&own);
            let bad = faces(&outcome.setups[0].planned)[0].chosen().bad;
            let rest = own["burrs"]["not_treated"].as_array().unwrap().iter().filter(|b| b["chosen"] == true);
            let left = length(&Value::Array(rest.cloned().collect()));
            let found = length(&Value::Array(treated.clone()));
            assert!((found + left - bad).abs() < 1e-6 && left < 0.5, "{control}: {found} {left} {bad}");
            for b in &treated {
                let angles = b["exit_angles"].as_array().unwrap();
                assert!(angles[1].as_f64().unwrap() <= 90.0 + 1e-6, "{b}");
                let height = b["height"].as_f64().unwrap();
                assert!((0.05 - 1e-9..=0.3).contains(&height), "{b}");
            }
            // What is not treated is not claimed, and said.
            let told = verdict.unchecked().any(|u| format!("{u:?}").contains("heights of burrs"));
            assert!(told, "{control}");
            let others = verdict.unchecked().any(|u| format!("{u:?}").contains("cut these edges away"));
            assert!(!others, "{control}: no operation is there that could");
            let text = &outcome.setups[0].posted.text;
            let comments = text.lines().filter(|l| l.contains("BURR TO 0.")).count();
            assert!(comments >= own["burrs"]["pieces"].as_array().unwrap().len(), "{control}: {text}");
        }
    }
}

#[test]
fn only_its_pieces_lose_material() {
    // The volume of a chamfer along the pieces and their leads; whole loops lose more.
    let gone = |operations: &str| {
        let o = cut("fanuc", DRAWN, operations);
        o.simulation.raw_volume - o.simulation.stock.volume()
    };
    let face = gone("");
    let bad = gone(&format!("{DEBURR}edges = \"bad\"\nwidth = 0.5\n")) - face;
    let whole =
        gone(&format!("{DEBURR}polygon = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\nwidth = 0.5\n"))
            - face;
    let own = json(&cut("fanuc", DRAWN, &format!("{DEBURR}edges = \"bad\"\nwidth = 0.5\n")), "deburrings");
    let pieces = own["burrs"]["pieces"].as_array().unwrap();
    let along = |p: &Value| {
        let a = p["along"].as_array().unwrap();
        a[1].as_f64().unwrap() - a[0].as_f64().unwrap()
    };
    let length: f64 = pieces.iter().flat_map(|p| p["beside"].as_array().unwrap()).map(along).sum();
    let section = 0.5 * 0.5 * 0.5;
    // Leads take away a little beyond both ends.
    assert!(
        bad > 0.9 * section * length && bad < section * (length + 3.0 * pieces.len() as f64),
        "{bad} {length}"
    );
    assert!((whole / (section * 200.0) - 1.0).abs() < 0.05, "{whole}");
}

#[test]
fn burrs_above_a_limit_are_chosen_by_the_table() {
    let of = |keys: &str| json(&cut("fanuc", DRAWN, &format!("{DEBURR}{keys}{TABLE}")), "deburrings");
    let (bad, above) = (of("edges = \"bad\"\n"), of("above = 0.1\n"));
    let total = |v: &Value| length(&Value::Array(burrs(v)));
    assert!(total(&above) < total(&bad) - 1.0, "{above}");
    // 0.1 lies at 68.57 degrees.
    for b in burrs(&above) {
        assert!(b["exit_angles"][1].as_f64().unwrap() < 68.58, "{b}");
        assert!(b["height"].as_f64().unwrap() > 0.1);
    }
    let rest = above["burrs"]["not_treated"].as_array().unwrap();
    assert!(
        rest.iter().all(|b| b["chosen"] == true || b["height"].as_f64().unwrap() <= 0.1 + 1e-6),
        "{rest:?}"
    );
    // Together they are all exits of the face.
    let all = |v: &Value| total(v) + length(&v["burrs"]["not_treated"]);
    assert!((all(&bad) - all(&above)).abs() < 1e-6);
}

#[test]
fn without_a_table_a_length_is_said_and_no_height() {
    let outcome = cut("fanuc", DRAWN, &format!("{DEBURR}edges = \"bad\"\n"));
    let own = json(&outcome, "deburrings");
    assert!(burrs(&own).iter().all(|b| b["height"].is_null()));
    let text = &outcome.setups[0].posted.text;
    assert!(text.contains("MM OF BURR") && !text.contains("BURR TO"), "{text}");
    assert_eq!(own["width"], 0.2);
}

#[test]
fn a_chamfer_takes_the_edges_too() {
    let keys = format!("edges = \"bad\"\nwidth = 0.3\n{TABLE}");
    let chamfer = cut("fanuc", DRAWN, &format!("{}{keys}", DEBURR.replace("deburr", "chamfer")));
    let deburr = cut("fanuc", DRAWN, &format!("{DEBURR}{keys}"));
    let moves = |o: &Outcome| {
        let lines = o.setups[0].posted.text.lines().map(str::to_owned);
        lines.filter(|l| !l.contains("DEBURR") && !l.contains("CHAMFER")).collect::<Vec<_>>()
    };
    assert_eq!(moves(&chamfer), moves(&deburr));
    assert!(chamfer.verdict.is_safe() && chamfer.deviation.bores.iter().all(|b| b.worst() < 2e-3));
}

#[test]
fn operations_that_may_cut_the_same_edges_are_said() {
    let deburr = format!("{DEBURR}edges = \"bad\"\n");
    let said = |operations: &str| {
        let outcome = cut("fanuc", DRAWN, operations);
        outcome.verdict.unchecked().any(|u| format!("{u:?}").contains("cut these edges away"))
    };
    assert_eq!((said(&deburr), said(&format!("{deburr}{deburr}"))), (false, true));
}

#[test]
fn a_face_without_bad_edges_leaves_nothing_to_do() {
    // Round the outline, the edge on the left of the feed: every tooth enters there.
    let round = "outline = { loops = [[[-30, -20], [30, -20], [30, 20], [-30, 20]]] }\npasses = { frames = 10 }\nexit_angle_min = 90\n";
    let without = cut("fanuc", round, "");
    for (keys, words) in [
        ("edges = \"bad\"\n".to_owned(), "edges = \"bad\": operation 1 (face 60 x 40) left no bad edge"),
        (format!("above = 0.2\n{TABLE}"), "above = 0.2: operation 1 (face 60 x 40) left no burr higher"),
    ] {
        let outcome = cut("fanuc", round, &format!("{DEBURR}{keys}"));
        let note = outcome.verdict.found.iter().find(|f| f.code == Code::BURRS).unwrap();
        assert!(note.message.contains(words) && note.severity == Severity::Note, "{}", note.message);
        let key = if keys.starts_with("edges") { "edges" } else { "above" };
        assert_eq!(note.key, Some(format!("setup[0].operation[1].{key}")), "{note:?}");
        assert_eq!(outcome.setups[0].posted.text, without.setups[0].posted.text);
    }
}

/// The job's face is this outline, of which all exits are bad but the last degree.
fn outlined(points: &str) -> String {
    format!(
        "outline = {{ loops = [[{points}]] }}\nplacement = \"as-drawn\"\npasses = \"one\"\nexit_angle_min = 179\n"
    )
}

#[test]
fn before_inside_corners_burrs_stay_and_are_told() {
    let plate = outlined("[-30, -20], [10, -20], [10, -8], [30, -8], [30, 20], [-30, 20]");
    let outcome = cut("fanuc", &plate, &format!("{DEBURR}edges = \"bad\"\nwidth = 0.3\n"));
    // The stock is the whole box: it does not have all edges of the outline, and nothing else is wrong.
    let errors: Vec<Code> =
        outcome.verdict.found.iter().filter(|f| f.severity == Severity::Error).map(|f| f.code).collect();
    assert_eq!(errors, [Code::FACE_EXITS], "{:?}", outcome.verdict.found);
    let bores = &outcome.deviation.bores;
    assert!(bores.iter().all(|b| b.ends > 0 && b.worst() < 2e-3), "{bores:?}");
    let own = json(&outcome, "deburrings");
    let offset = own["offset"].as_f64().unwrap();
    let face = faces(&outcome.setups[0].planned)[0];
    let outline = &face.of.case.outline;
    let treated = burrs(&own);
    let not = own["burrs"]["not_treated"].as_array().unwrap();
    let left: Vec<Value> = not.iter().filter(|b| b["chosen"] == true).cloned().collect();
    let is_on = |list: &[Value], edge: usize, at: f64| {
        list.iter().any(|b| {
            let own = b["edge"].as_u64() == Some(edge as u64);
            own && b["from"].as_f64().unwrap() <= at && at <= b["to"].as_f64().unwrap()
        })
    };
    // A place is treated where the tip comes beside it at its distance from all edges.
    let (mut cut, mut uncut) = (0, 0);
    for s in &face.chosen().burr.stretches {
        if !matches!(s.met, Met::First { weight, .. } if weight > 0.0) {
            continue;
        }
        let edge = &outline.edges()[s.edge];
        for i in 0..200 {
            let share = s.from + (s.to - s.from) * (f64::from(i) + 0.5) / 200.0;
            let tip = edge.at(share) + offset * DVec2::from_angle(edge.outward(share));
            let is_reached = outline.edges().iter().all(|e| e.nearest(tip).1 > offset - 1e-6);
            let at = share * edge.length();
            let found = (is_on(&treated, s.edge, at), is_on(&left, s.edge, at));
            assert_eq!(found, (is_reached, !is_reached), "{at} of {}: {own}", s.edge);
            *if is_reached { &mut cut } else { &mut uncut } += 1;
        }
    }
    assert!(cut > 300 && uncut > 0, "{cut} {uncut}");
    let told = outcome.verdict.found.iter().find(|f| f.code == Code::BURRS).unwrap();
    assert!(told.message.contains("burrs stay on"), "{}", told.message);
}

#[test]
fn burrs_to_which_the_cutter_does_not_come_leave_the_operation_out() {
    // The upper side of a slit of 0.8 mm alone has its exit angle.
    let plate =
        outlined("[-30, -20], [30, -20], [30, 15], [22, 15], [22, 15.8], [30, 15.8], [30, 20], [-30, 20]");
    let without = cut("fanuc", &plate, "");
    let face = faces(&without.setups[0].planned)[0];
    let flank = face.chosen().burr.stretches.iter().find_map(|s| {
        let edge = &face.of.case.outline.edges()[s.edge];
        let is_flank = (edge.start.y - 15.8).abs() < 1e-9 && (edge.end.y - 15.8).abs() < 1e-9;
        match s.met {
            Met::First { angles, .. } if is_flank => Some(angles[0].to_degrees()),
            _ => None,
        }
    });
    let psi = flank.unwrap();
    let keys = format!("above = 0.5\nburr = [[{}, 0], [{psi}, 1], [{}, 0]]\n", psi - 0.5, psi + 0.5);
    let outcome = cut("fanuc", &plate, &format!("{DEBURR}{keys}"));
    let found = outcome.verdict.found.iter().find(|f| f.code == Code::BURRS).unwrap();
    assert!(
        found.message.contains("comes to none of the edges") && found.message.contains("8 mm stay"),
        "{found}"
    );
    assert_eq!(found.severity, Severity::Warning);
    assert_eq!(found.key.as_deref(), Some("setup[0].operation[1].above"));
    assert_eq!(outcome.setups[0].posted.text, without.setups[0].posted.text);
    // Loops of which the outline has none.
    let square = "rectangle = { size = [60, 40] }\nloops = \"inner\"\n";
    let outcome = cut("fanuc", &plate, &format!("{DEBURR}{square}"));
    let found = outcome.verdict.found.iter().find(|f| f.code == Code::JOB_SHAPE).unwrap();
    assert_eq!(
        (found.severity, found.key.as_deref()),
        (Severity::Warning, Some("setup[0].operation[1].loops"))
    );
    assert_eq!(outcome.setups[0].posted.text, without.setups[0].posted.text);
}

#[test]
fn cures_of_a_ball_name_no_tip_clearance() {
    let hole = |diameter: f64| {
        let error =
            refused(DRAWN, &format!("{BALL}side = \"inside\"\ncircle = {{ diameter = {diameter} }}\n"));
        assert!(!error.0.help.contains("tip_clearance") && error.0.help.contains("smaller ball"), "{error}");
        error
    };
    let small = hole(1.6);
    assert_eq!(
        (small.code(), small.0.key.as_deref()),
        (Code::CUTTER_TOO_LARGE, Some("setup[0].operation[1].tool"))
    );
    assert_eq!(hole(3.0).code(), Code::LEAD_ROOM);
    // Nor where it leaves webs.
    let pocket =
        cut("fanuc", DRAWN, &format!("{BALL}side = \"inside\"\nrectangle = {{ size = [44, 34] }}\n"));
    let web = pocket.verdict.found.iter().find(|f| f.code == Code::CORNERS_STAY).unwrap();
    assert!(
        web.help.contains("a smaller ball makes it shorter") && !web.help.contains("tip_clearance"),
        "{web}"
    );
    let floor = refused(DRAWN, &format!("{BALL}circle = {{ diameter = 30 }}\nwall_height = 0.5\n"));
    assert!(!floor.0.help.contains("tip_clearance"), "{floor}");
}

#[test]
fn the_face_may_be_mirrored_and_its_angles_given_from_the_other_side() {
    // M4: as safe, and as long.
    let keys = format!("{DEBURR}edges = \"bad\"\nwidth = 0.3\n{TABLE}");
    let plain = json(&cut("fanuc", DRAWN, &keys), "deburrings");
    let left = cut("fanuc", &format!("{DRAWN}left_hand = true\n"), &keys);
    assert!(left.verdict.is_safe(), "{:?}", left.verdict.found);
    assert!(left.deviation.bores.iter().all(|b| b.worst() < 2e-3));
    // The bore lies beside the middle: only the straight edges are as long.
    let straight = |v: &Value| {
        let all = burrs(v).into_iter().filter(|b| b["edge"].as_u64().unwrap() < 4).collect();
        length(&Value::Array(all))
    };
    assert!((straight(&json(&left, "deburrings")) - straight(&plain)).abs() < 1e-6);
    // Supplement: bad where 180 degrees minus the angle is.
    let face = DRAWN.replace("exit_angle_min = 90", "exit_angle_min = 90\npsi_side = \"supplement\"");
    let other = json(&cut("fanuc", &face, &keys), "deburrings");
    for b in burrs(&other) {
        // Shown as given: below 90 again, and the table read there.
        let angles = b["exit_angles"].as_array().unwrap();
        assert!(angles[1].as_f64().unwrap() <= 90.0 + 1e-6, "{b}");
        let least = angles[0].as_f64().unwrap();
        let points = [[0.0, 0.30], [30.0, 0.25], [60.0, 0.12], [90.0, 0.05]];
        let w = points.windows(2).find(|w| least <= w[1][0] + 1e-9).unwrap();
        let height = w[0][1] + (least - w[0][0]) / 30.0 * (w[1][1] - w[0][1]);
        assert!((b["height"].as_f64().unwrap() - height).abs() < 1e-6, "{b}");
    }
    assert!((length(&Value::Array(burrs(&other))) - length(&Value::Array(burrs(&plain)))).abs() > 1.0);
}

#[test]
fn whole_outlines_are_deburred_by_a_ball() {
    for (outline, more) in [
        ("rectangle = { size = [60, 40] }", "width = 0.5\nloops = \"outer\""),
        ("side = \"inside\"\ncircle = { at = [14, 5], diameter = 14 }", "width = 0.4"),
    ] {
        let outcome = cut("linuxcnc", DRAWN, &format!("{BALL}{outline}\n{more}\n"));
        assert!(outcome.verdict.is_safe(), "{outline}: {:?}", outcome.verdict.found);
        let edge = &outcome.deviation.bores[0];
        assert!(edge.ends > 100 && edge.worst() < 2e-3, "{outline}: {edge:?}");
        let own = json(&outcome, "deburrings");
        assert!(own["hollow"].as_f64().unwrap() > 0.0 && own["tip_clearance"].is_null());
    }
}

#[test]
fn what_deburrs_nothing_is_refused_with_a_cure() {
    let key = |e: &Error| e.0.key.clone().unwrap_or_default();
    let under = |key: &str| format!("setup[0].operation[1].{key}");
    let of = |operation: &str| refused(DRAWN, &format!("{DEBURR}{operation}\n"));
    let table = of("above = 0.1");
    assert_eq!((table.code(), key(&table)), (Code::BURRS, under("burr")), "{table}");
    assert!(
        table.0.message.contains("`burr` is missing: the program can say where, not how high"),
        "{table}"
    );
    for (operation, code, at) in [
        ("edges = \"bad\"\nabove = 0.1", Code::JOB_SHAPE, "above"),
        ("edges = \"bad\"\ncircle = { diameter = 14 }", Code::JOB_SHAPE, "edges"),
        ("edges = \"bad\"\nof = \"rim\"", Code::JOB_SHAPE, "edges"),
        ("edges = \"bad\"\nside = \"inside\"", Code::JOB_SHAPE, "side"),
        ("edges = \"bad\"\nstart = [0, 0]", Code::JOB_SHAPE, "start"),
        ("circle = { diameter = 14 }\nburr = [[0, 1]]", Code::JOB_SHAPE, "burr"),
        ("above = 0\nburr = [[0, 1]]", Code::JOB_VALUE, "above"),
        ("above = 0.1\nburr = [[10, 1], [5, 1]]", Code::FACE_CASE, "burr"),
        ("above = 0.1\nburr = [[0, -1]]", Code::FACE_CASE, "burr"),
        ("above = 0.1\nburr = []", Code::FACE_CASE, "burr"),
        ("edges = \"bad\"\nwidth = 0", Code::JOB_VALUE, "width"),
        ("width = 0.2", Code::JOB_SHAPE, "outline"),
    ] {
        let error = of(operation);
        assert_eq!((error.code(), key(&error)), (code, under(at)), "{operation}: {error}");
        assert!(!error.0.help.is_empty() || code == Code::JOB_VALUE, "{operation}");
    }
    let ball =
        |operation: &str| refused(DRAWN, &format!("{BALL}circle = {{ diameter = 30 }}\n{operation}\n"));
    assert_eq!(key(&ball("tip_clearance = 0.3")), under("tip_clearance"));
    let wide = ball("width = 1.2");
    assert_eq!((wide.code(), key(&wide)), (Code::PLAN_VALUE, under("width")), "{wide}");
    assert!(wide.0.help.contains("width = 1 at most"), "{wide}");
    assert_eq!(key(&ball("wall_height = 0.5")), under("tool"));
    let mill = refused(DRAWN, &format!("{}edges = \"bad\"\n", DEBURR.replace("tool = 5", "tool = 1")));
    assert_eq!((mill.code(), key(&mill)), (Code::JOB_REFERENCE, under("tool")), "{mill}");
    // Without a face before it in the setup.
    let alone = job("fanuc", DRAWN, "");
    let (head, _) = alone.split_once("[[setup.operation]]").unwrap();
    let error =
        run("job.toml", &format!("{head}{DEBURR}edges = \"bad\"\n"), &MemoryLoader::default(), &Silent);
    let error = error.unwrap_err();
    assert_eq!(
        (error.code(), key(&error)),
        (Code::BURRS, "setup[0].operation[0].edges".to_owned()),
        "{error}"
    );
    assert!(error.0.message.contains("needs a face operation before it in this setup"), "{error}");
}
