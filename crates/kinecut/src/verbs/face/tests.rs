use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use serde_json::Value;

use crate::base::{MemoryLoader, Progress, Silent};
use crate::facing::optimum::map_size;
use crate::verbs::face::{SheetWants, plan_face_sheet};
use crate::verbs::hole::read_holes;

/// A plate with a cut corner and a bore.
const LOOPS: &str = "{ loops = [{ points = [[0, 0], [90, 0], [100, 20], [100, 60], [0, 60]] }, { centre = [40, 25], radius = 9 }] }";

fn sheet(keys: &str) -> Value {
    wanted(keys, SheetWants { events: true, ..SheetWants::default() })
}

fn wanted(keys: &str, wants: SheetWants) -> Value {
    watched(keys, wants, &Silent)
}

fn watched(keys: &str, wants: SheetWants, progress: &dyn Progress) -> Value {
    let text = format!(
        "title = \"plate\"\n[tool]\nnumber = 1\ntype = \"face-mill\"\ndiameter = 100\nteeth = 5\nflute_length = 8\n\
         [operation]\ntype = \"face\"\ntool = 1\ndepth = 0.5\nspeed = 600\nfeed_per_tooth = 0.2\nguard = 0\n{keys}"
    );
    let texts = read_holes("face.toml", &text).unwrap();
    let table = texts.item(0).unwrap();
    serde_json::to_value(plan_face_sheet(&table, wants, &MemoryLoader::default(), progress).unwrap()).unwrap()
}

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap()
}

/// Checks that hold for any sheet: stretches are the whole outline, bad ones the bad length of the way chosen.
fn agrees(json: &Value) {
    let edges = json["outline"]["edges"].as_array().unwrap();
    let (mut whole, mut bad) = (vec![0.0; edges.len()], 0.0);
    for s in json["stretches"].as_array().unwrap() {
        let edge = s["edge"].as_u64().unwrap() as usize;
        let share = number(&s["to"]) - number(&s["from"]);
        assert!(share >= 0.0, "{s}");
        whole[edge] += share;
        if let Some(weight) = s["weight"].as_f64() {
            bad += share * number(&edges[edge]["length"]) * number(&edges[edge]["weight"]) * weight;
        }
    }
    assert!(whole.iter().all(|w| (w - 1.0).abs() < 1e-9), "{whole:?}");
    let chosen = &json["ways"][json["chosen"].as_u64().unwrap() as usize];
    assert!((bad - number(&chosen["bad"])).abs() < 1e-9, "{bad} {}", chosen["bad"]);
}

#[test]
fn the_numbers_of_a_sheet_agree_and_m4_is_the_mirror() {
    let turned = "placement = { angle = 20, offset = 45 }\n";
    let right = sheet(&format!("{turned}outline = {LOOPS}"));
    agrees(&right);
    // The mirrored part under the other spindle, turned the other way.
    let mirrored = LOOPS.replace("20]", "-20]").replace("60]", "-60]").replace("25]", "-25]");
    let other = "left_hand = true\nplacement = { angle = -20, offset = -45 }\n";
    let left = sheet(&format!("{other}outline = {mirrored}"));
    agrees(&left);
    let way = |s: &Value| s["ways"][s["chosen"].as_u64().unwrap() as usize].clone();
    let (a, b) = (way(&right), way(&left));
    assert!((number(&a["bad"]) - number(&b["bad"])).abs() < 1e-9);
    assert!((number(&a["turn"]) - 20.0).abs() < 1e-9 && (number(&b["turn"]) - 340.0).abs() < 1e-9);
    assert!((number(&a["offset"]) - 45.0).abs() < 1e-9 && (number(&b["offset"]) + 45.0).abs() < 1e-9);
    let start = |w: &Value, i: usize| number(&w["path"][0][0]["start"][i]);
    assert!((start(&a, 0) - start(&b, 0)).abs() < 1e-9 && (start(&a, 1) + start(&b, 1)).abs() < 1e-9);
}

#[test]
fn events_lie_on_the_edges_they_name() {
    for left in [false, true] {
        let json = sheet(&format!(
            "left_hand = {left}\nplacement = {{ angle = 20, offset = {} }}\noutline = {LOOPS}",
            if left { 42 } else { 45 }
        ));
        let edges = json["outline"]["edges"].as_array().unwrap();
        let events = json["events"].as_array().unwrap();
        assert!(events.len() > 1000);
        let (sin, cos) = 20f64.to_radians().sin_cos();
        for e in events.iter().step_by(7) {
            let edge = &edges[e["edge"].as_u64().unwrap() as usize];
            let [x, y] = [0, 1].map(|i| number(&e["point"][i]));
            // Back from the frame of the pass to the part's.
            let at = [x * cos + y * sin, y * cos - x * sin];
            if edge["radius"].is_null() {
                let s = number(&e["share"]);
                for (i, at) in at.iter().enumerate() {
                    let (a, b) = (number(&edge["start"][i]), number(&edge["end"][i]));
                    assert!((a + s * (b - a) - at).abs() < 1e-6, "{left} {e}");
                }
            } else {
                let off = (at[0] - 40.0).hypot(at[1] - 25.0) - 9.0;
                assert!(off.abs() < 1e-6, "{left} {e}");
            }
            let angle = number(&e["exit_angle"]);
            assert_eq!(e["exit"].as_bool().unwrap(), angle > 0.0);
        }
    }
}

#[test]
fn the_certificate_is_in_the_sheet() {
    let json = sheet(&format!("outline = {LOOPS}"));
    agrees(&json);
    let o = &json["optimum"];
    let (value, bound) = (number(&o["value"]), number(&o["lower_bound"]));
    assert!(bound <= value && value - bound < 1e-5 * number(&json["outline"]["perimeter"]), "{o}");
    assert!((number(&o["gap"]) - (value - bound)).abs() < 1e-12);
    assert!(number(&json["teeth_check"]["front"]["bad"]) > 0.0);
    assert_eq!(json["cutter"]["teeth"].as_array().unwrap().len(), 5);
    let wide =
        sheet("passes = { rows = 2 }\noutline = { loops = [[[0, 0], [150, 0], [150, 120], [0, 120]]] }");
    agrees(&wide);
    assert_eq!(wide["optimum"]["error"]["code"], "KC1002");
    assert!(wide["teeth_check"].is_null() && wide["as_drawn"].is_null());
}

#[test]
fn the_map_has_the_values_of_its_placements_and_m4_is_the_mirror() {
    let map = |keys: &str| wanted(keys, SheetWants { map: true, ..SheetWants::default() });
    let right = map(&format!("outline = {LOOPS}"));
    let map_of = &right["map"];
    let (turns, rows) = (map_of["turns"].as_array().unwrap(), map_of["rows"].as_u64().unwrap() as usize);
    assert_eq!((turns.len(), rows), (180, 41));
    let [mut seen, mut shut] = [0, 0];
    for (i, turn) in turns.iter().enumerate().step_by(7) {
        let (range, values) = (&map_of["beside"][i], &map_of["values"][i]);
        assert_eq!(range.is_null(), values.is_null());
        if values.is_null() {
            shut += 1;
            continue;
        }
        for j in [0, rows / 2, rows - 1] {
            let share = j as f64 / (rows - 1) as f64;
            let beside = number(&range[0]) + share * (number(&range[1]) - number(&range[0]));
            let (sin, cos) = number(turn).to_radians().sin_cos();
            let across = [[0.0, 0.0], [90.0, 0.0], [100.0, 20.0], [100.0, 60.0], [0.0, 60.0]];
            let across = across.map(|[x, y]: [f64; 2]| x * sin + y * cos);
            let low = across.iter().fold(f64::INFINITY, |a, &b| a.min(b));
            let high = across.iter().fold(f64::NEG_INFINITY, |a, &b| a.max(b));
            // Inside the bound, which the rounding of the map can miss.
            let offset = 0.5 * (low + high) + 0.999 * beside;
            let one = sheet(&format!(
                "placement = {{ angle = {}, offset = {offset} }}\npasses = \"one\"\noutline = {LOOPS}",
                number(turn)
            ));
            let value = number(&one["ways"][one["chosen"].as_u64().unwrap() as usize]["guarded"]);
            if let Some(shown) = values[j].as_f64() {
                seen += 1;
                assert!((shown - value).abs() < 0.2, "{turn} {j}: {shown}, the plan has {value}");
            }
        }
    }
    assert!(seen > 20 && shut > 0, "{seen} {shut}");
    let mirrored = LOOPS.replace("20]", "-20]").replace("60]", "-60]").replace("25]", "-25]");
    let left = map(&format!("left_hand = true\noutline = {mirrored}"));
    for i in 0..180 {
        let other = (180 - i) % 180;
        let (a, b) = (&map_of["values"][i], &left["map"]["values"][other]);
        assert_eq!(a.is_null(), b.is_null(), "{i}");
        if !a.is_null() {
            for j in 0..41 {
                let (a, b) = (a[j].as_f64(), b[40 - j].as_f64());
                let near = a.zip(b).map_or(a == b, |(a, b)| (a - b).abs() < 2e-3);
                assert!(near, "{i} {j}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn the_walk_is_the_descent_triangle_by_triangle() {
    let wants = SheetWants { walk: true, paper: true, ..SheetWants::default() };
    let drawn = wanted(&format!("outline = {LOOPS}"), wants);
    let place = &drawn["as_drawn"]["placement"];
    let json = wanted(
        &format!(
            "placement = {{ angle = 0, offset = {} }}\npasses = \"one\"\noutline = {LOOPS}",
            place["offset"]
        ),
        wants,
    );
    let (walk, own) = (&json["walk"], &json["paper"]["descent_from_as_drawn"]);
    for key in ["start", "end", "value", "evaluations"] {
        assert_eq!(walk[key], own[key], "{key}");
    }
    let steps = walk["steps"].as_array().unwrap();
    let value = |s: &Value, i: usize| number(&s["corners"][i]["value"]);
    assert!(steps.len() > 20 && steps[0]["evaluations"] == 3);
    assert!(steps.windows(2).all(|s| value(&s[1], 0) <= value(&s[0], 0)));
    assert!(steps.iter().all(|s| value(s, 0) <= value(s, 1) && value(s, 1) <= value(s, 2)));
    let last = steps.last().unwrap();
    assert_eq!(value(last, 0), number(&walk["value"]));
    assert_eq!(last["evaluations"], walk["evaluations"]);
    let rows = wanted(&format!("passes = {{ rows = 2 }}\noutline = {LOOPS}"), wants);
    assert!(rows["walk"].is_null() && rows["findings"].to_string().contains("walks from one straight pass"));
}

#[test]
fn the_walk_stays_where_the_search_may_look() {
    let wants = SheetWants { walk: true, paper: true, ..SheetWants::default() };
    // A free walk ends 6 mm beside of what the engagement allows, and below the certificate.
    let json = wanted(
        "engagement = [-60, 60]\nforbidden = [[80, 280]]\noutline = { loops = [[[0, 0], [80, 0], [80, 30], [30, 30], [30, 60], [0, 60]]] }",
        wants,
    );
    let (optimum, walk) = (&json["optimum"], &json["walk"]);
    let bound = number(&optimum["lower_bound"]);
    assert!(number(&walk["value"]) >= bound - 1e-6, "{} below {bound}", walk["value"]);
    let heights = |p: &Value| {
        let (sin, cos) = number(&p["turn"]).to_radians().sin_cos();
        [[0.0, 0.0], [80.0, 0.0], [80.0, 30.0], [30.0, 60.0], [0.0, 60.0]]
            .map(|[x, y]: [f64; 2]| x * sin + y * cos - number(&p["offset"]))
    };
    let reach = 50.0 * 60f64.to_radians().sin();
    assert!(heights(&walk["end"]).iter().all(|h| h.abs() < reach + 1e-6), "{}", walk["end"]);
    let descents = json["paper"]["descents"].as_array().unwrap();
    assert_eq!(descents.len(), 100);
    for d in descents {
        assert!(
            number(&d["value"]) >= bound - 1e-6 && heights(&d["end"]).iter().all(|h| h.abs() < reach + 1e-6),
            "{d}"
        );
    }
    assert!(number(&json["paper"]["statistics"]["best"]) >= bound - 1e-6);
}

/// Work that is cancelled when a stage of this name begins.
struct StopAt {
    stage: &'static str,
    reached: AtomicBool,
    after: AtomicU64,
}

impl Progress for StopAt {
    fn stage(&self, name: &str, _: u64) {
        if name == self.stage {
            self.reached.store(true, Ordering::Relaxed);
        }
    }

    fn advance(&self, steps: u64) {
        if self.cancelled() {
            self.after.fetch_add(steps, Ordering::Relaxed);
        }
    }

    fn cancelled(&self) -> bool {
        self.reached.load(Ordering::Relaxed)
    }
}

#[test]
fn map_and_walk_can_be_given_up_and_the_plan_is_an_answer_without_them() {
    let wants = SheetWants { map: true, walk: true, ..SheetWants::default() };
    for stage in ["map", "walk"] {
        let stop = StopAt { stage, reached: AtomicBool::new(false), after: AtomicU64::new(0) };
        let json = watched(&format!("outline = {LOOPS}"), wants, &stop);
        assert!(stop.cancelled(), "{stage} is never told");
        // Whatever other threads were at when it was told.
        assert!(stop.after.load(Ordering::Relaxed) <= 16, "{stage} goes on");
        assert_eq!(json["map"].is_null(), stage == "map", "{stage}");
        assert!(json["walk"].is_null() && json["optimum"]["complete"] == true, "{stage}");
        assert!(json["findings"].to_string().contains("the work was cancelled"), "{}", json["findings"]);
    }
}

#[test]
fn the_map_of_many_edges_is_coarser_and_bounded() {
    assert_eq!([5, 4000].map(|edges| map_size([180, 41], edges)), [[180, 41]; 2]);
    for edges in [9000, 20_000, 80_000] {
        let [columns, rows] = map_size([180, 41], edges);
        assert!((36..180).contains(&columns) && (9..41).contains(&rows), "{columns} {rows}");
        assert!(columns * rows * edges <= 30_000_000, "{columns} {rows} {edges}");
    }
}
