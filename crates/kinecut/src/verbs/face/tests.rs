use serde_json::Value;

use crate::base::{MemoryLoader, Silent};
use crate::verbs::face::{SheetWants, plan_face_sheet};
use crate::verbs::hole::read_holes;

/// A plate with a cut corner and a bore.
const LOOPS: &str = "{ loops = [{ points = [[0, 0], [90, 0], [100, 20], [100, 60], [0, 60]] }, { centre = [40, 25], radius = 9 }] }";

fn sheet(keys: &str) -> Value {
    let text = format!(
        "title = \"plate\"\n[tool]\nnumber = 1\ntype = \"face-mill\"\ndiameter = 100\nteeth = 5\nflute_length = 8\n\
         [operation]\ntype = \"face\"\ntool = 1\ndepth = 0.5\nspeed = 600\nfeed_per_tooth = 0.2\nguard = 0\n{keys}"
    );
    let texts = read_holes("face.toml", &text).unwrap();
    let table = texts.item(0).unwrap();
    let wants = SheetWants { events: true, ..SheetWants::default() };
    serde_json::to_value(plan_face_sheet(&table, wants, &MemoryLoader::default(), &Silent).unwrap()).unwrap()
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
