//! Surfaces, layouts and machines: as the command line answers, and of the folder alone.

use kinecut::base::{Severity, Silent};
use kinecut::machine::Machine;
use kinecut::verbs::fk::forward;
use kinecut::verbs::layouts::{LayoutWants, layout_sheet};
use kinecut::verbs::poses::PoseWords;
use kinecut::verbs::surface::{OnMachineWants, SurfaceWants, load_surface};
use kinecut::verbs::{Answer, Answers};
use serde_json::{Value, json};

use crate::common::{Folder, Reply, Running, until};

const CONE: &str = "like = \"cone\"\nparameters = { R = 30, alpha = \"20*pi/180\" }\n";

fn cone() -> (Folder, Running) {
    let folder = Folder::new();
    folder.write("sub/cone.toml", CONE);
    folder.write("mill.toml", "name = \"m\"\ncode = \"2103\"\n");
    let running = Running::of(&folder);
    (folder, running)
}

/// An answer as `--json` prints it.
fn printed<A: Answer>(answer: &A) -> String {
    let mut answers = Answers::new(false, Severity::Doubt);
    answers.json(Ok(answer)) + answers.json_end()
}

fn body(reply: &Reply) -> String {
    String::from_utf8_lossy(&reply.body).into_owned()
}

fn pair(name: &str, value: &str) -> (String, String) {
    (name.to_owned(), value.to_owned())
}

#[test]
fn a_surface_is_answered_letter_by_letter_and_drawn() {
    let (_folder, running) = cone();
    let asked = json!({ "client": "c", "surface": "cone", "set": { "R": "40" }, "at": { "phi": "1", "z": "20" }, "sketch": true });
    let reply = running.post("/api/verb/surface", &asked);
    let wants = SurfaceWants {
        set: vec![pair("R", "40")],
        at: vec![pair("phi", "1"), pair("z", "20")],
        sketch: true,
        ..SurfaceWants::default()
    };
    let own = wants.answer(load_surface("cone", None).unwrap(), None, &Silent).unwrap();
    assert_eq!(body(&reply), printed(&own));
    assert_eq!(reply.header("kinecut-exit"), Some("0"));
    // By hand: the point of the paper's equation 4, with its brackets.
    let (a, z) = (0.35f64, 20.0);
    let radius = 40.0 - z * a.sin();
    let wanted = [radius * 1f64.cos(), radius * 1f64.sin(), z * a.cos()];
    for (i, wanted) in wanted.into_iter().enumerate() {
        let found = reply.json()["place"]["point"][i].as_f64().unwrap();
        assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    }
    let drawing = running.post("/api/drawing/surface", &asked);
    assert!(drawing.status == 200 && body(&drawing).starts_with("<svg"), "{}", drawing.head);
    assert_eq!(drawing.header("content-type"), Some("image/svg+xml"));
    let page = running.post("/api/page/surface", &asked);
    assert!(body(&page).contains("Redistributions"));
    let all = running.post("/api/verb/surface", &json!({ "client": "c" })).json();
    assert!(all.as_array().unwrap().iter().any(|s| s["name"] == "cone"));
}

#[test]
fn a_surface_of_the_folder_is_asked_as_it_is_edited_and_a_machine_says_what_it_can() {
    let (_folder, running) = cone();
    let id = running.id("sub/cone.toml");
    let listed = running.get("/api/project").json();
    let kinds: Vec<&Value> = listed["files"].as_array().unwrap().iter().map(|f| &f["kind"]).collect();
    assert_eq!(kinds, [&json!("machine"), &json!("surface")]);
    let ask = |more: Value| {
        let mut asked = json!({ "client": "c", "file": id });
        asked.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        running.post("/api/verb/surface", &asked)
    };
    let disk = ask(json!({})).json();
    assert!((disk["parameters"]["alpha"].as_f64().unwrap() - 20f64.to_radians()).abs() < 1e-15);
    assert_eq!(ask(json!({ "text": CONE.replace("30", "35") })).json()["parameters"]["R"], 35.0);
    let lathe = ask(json!({ "machine": "lathe_xzc", "set": { "alpha": "0.35" } }));
    let wants = SurfaceWants { set: vec![pair("alpha", "0.35")], ..SurfaceWants::default() };
    let machine = Machine::preset("lathe_xzc").unwrap();
    let surface = load_surface("sub/cone.toml", Some(CONE)).unwrap();
    let own = wants.answer(surface, Some((&machine, &OnMachineWants::default())), &Silent).unwrap();
    assert_eq!(body(&lathe), printed(&own));
    // A mill of the folder cannot turn the work under an edge; its text may be edited.
    let mill = running.id("mill.toml");
    let knee = ask(json!({ "machine": mill })).json();
    let splits = knee["on_machine"]["splits"].as_array().unwrap();
    let turned = splits.iter().find(|s| s["machine_code"] == "615").unwrap();
    assert_eq!((&turned["possible"], &turned["obstacle"]["code"]), (&json!(false), &json!("KC1132")));
    let edits = json!([{ "file": mill, "text": "name = \"m\"\ncode = \"6031\"\n" }]);
    assert_eq!(ask(json!({ "machine": mill, "edits": edits })).json()["on_machine"]["code"], "6031");
}

#[test]
fn what_is_wrong_is_told_by_the_verb_and_no_path_leads_out() {
    let (folder, running) = cone();
    std::fs::write(folder.outside().join("secret.toml"), "code = \"2103\"\n").unwrap();
    let code = |path: &str, asked: &Value| running.post(path, asked).json()["code"].clone();
    let surface = "/api/verb/surface";
    assert_eq!(code(surface, &json!({ "client": "c", "surface": "kone" })), "KC1107");
    assert_eq!(code(surface, &json!({ "client": "c", "surface": "cone", "set": { "S": "1" } })), "KC1102");
    let typed = running.post(surface, &json!({ "client": "c", "surface": "cone", "set": { "R": "3+" } }));
    assert_eq!((typed.json()["key"].clone(), typed.header("kinecut-exit")), (json!("R"), Some("2")));
    let far = running.post(surface, &json!({ "client": "c", "surface": "cone", "at": { "z": "70" } })).json();
    assert_eq!((&far["key"], &far["bound"]["value"]), (&json!("z"), &json!(50.0)));
    for name in ["../secret.toml", "/etc/passwd", "mill.toml", "sub/cone.toml", "..", ""] {
        let asked = json!({ "client": "c", "surface": "cone", "machine": name });
        assert_eq!(code(surface, &asked), "KC1117", "{name}");
        assert_eq!(code("/api/verb/machine", &json!({ "client": "c", "machine": name })), "KC1117", "{name}");
        let asked = json!({ "client": "c", "machine": name, "at": ["X0"] });
        assert_eq!(code("/api/verb/fk", &asked), "KC1117", "{name}");
        let file = running.post(surface, &json!({ "client": "c", "file": name }));
        assert_eq!((file.status, file.reason().as_str()), (404, "not-found"), "{name}");
    }
    let guess = json!({ "client": "c", "file": running.id("mill.toml"), "machine": "../secret.toml" });
    assert_eq!(running.post("/api/guess", &guess).status, 404);
    for (path, asked) in [
        (surface, json!({ "client": "c", "surfase": "cone" })),
        (surface, json!({ "client": "c", "surface": "cone", "file": running.id("sub/cone.toml") })),
        ("/api/verb/layouts", json!({ "client": "c", "of": "XYZ", "show": 100_000 })),
        ("/api/verb/layouts", json!({ "client": "c", "of": "XYZ", "worklinks": 1 })),
        ("/api/verb/machine", json!({ "client": "c", "machine": "mill3_xyz", "layout": "2103" })),
        ("/api/verb/fk", json!({ "client": "c", "machine": "mill3_xyz", "at": [] })),
        // What would be passed over, or be more than it counts as.
        ("/api/verb/fk", json!({ "client": "c", "machine": "mill3_xyz", "at": ["X1\nX2"] })),
        ("/api/verb/fk", json!({ "client": "c", "machine": "mill3_xyz", "at": ["X1 ".repeat(5000)] })),
        ("/api/verb/ik", json!({ "client": "c", "machine": "trt_xyzac", "at": ["X0"], "lock": "A1\nC5" })),
        ("/api/verb/machine", json!({ "client": "c", "machine": "x".repeat(3000) })),
        ("/api/verb/machine", json!({ "client": "c", "at": "X1" })),
        ("/api/verb/machine", json!({ "client": "c", "machine": "mill3_xyz", "text": "code = \"2103\"" })),
        (surface, json!({ "client": "c", "surface": "cone", "verify": "61" })),
        (surface, json!({ "client": "c", "text": "like = \"cone\"" })),
        (surface, json!({ "client": "c", "surface": "z".repeat(3000) })),
    ] {
        let refused = running.post(path, &asked);
        assert_eq!((refused.status, refused.reason().as_str()), (400, "request"), "{path} {asked}");
    }
    // Each entry of `at` has its answer, in its place.
    let asked = json!({ "client": "c", "machine": "mill3_xyz", "at": ["X1", "Q5", "{\"X\":2}"] });
    let answers = running.post("/api/verb/fk", &asked).json();
    let answers = answers.as_array().unwrap();
    assert!(answers.len() == 3 && answers[1]["error"]["code"].is_string(), "{answers:?}");
    assert_eq!((&answers[0]["tip"][0], &answers[2]["tip"][0]), (&json!(1.0), &json!(2.0)), "{answers:?}");
    running.still_answers();
}

#[test]
fn a_search_for_layouts_ends_when_it_is_no_longer_wanted() {
    let (_folder, running) = cone();
    let sizes = json!({ "stroke": [500, 400, 300], "part": [200, 200, 200], "show": 240, "spindle": "both" });
    let mut asked = json!({ "client": "c", "of": "XYZABCBn", "generation": 1 });
    asked.as_object_mut().unwrap().extend(sizes.as_object().unwrap().clone());
    std::thread::scope(|scope| {
        let long = scope.spawn(|| running.post("/api/verb/layouts", &asked));
        until("it is at work", || running.look.held().waiting > 0);
        let newer = json!({ "client": "c", "of": "XYZ", "generation": 2 });
        assert_eq!(running.post("/api/verb/layouts", &newer).status, 200);
        assert_eq!(long.join().unwrap().json()["code"], "KC0009");
        until("nothing is at work", || running.look.held().waiting == 0);
    });
}

#[test]
fn layouts_are_answered_letter_by_letter() {
    let (_folder, running) = cone();
    let asked = json!({ "client": "c", "of": "XYZAC", "full": true, "kind": ["table-table"], "work-links": 4,
        "weight": [["moved-mass", 2.0], ["overhang", 1.0]], "show": 3 });
    let reply = running.post("/api/verb/layouts", &asked);
    let wants = LayoutWants {
        full: true,
        kind: vec!["table-table".to_owned()],
        work_links: Some(4),
        weight: vec![("moved-mass".to_owned(), 2.0), ("overhang".to_owned(), 1.0)],
        show: Some(3),
        ..LayoutWants::default()
    };
    let own = layout_sheet("XYZAC", &wants.query("XYZAC").unwrap(), &Silent).unwrap();
    assert_eq!(body(&reply), printed(&own));
    assert_eq!(reply.json()["layouts"].as_array().unwrap().len(), 3);
    let weights = reply.json()["weights"].as_array().unwrap().clone();
    assert!(weights.contains(&json!(["moved-mass", 2.0])) && weights.contains(&json!(["lifted-mass", 0.0])));
    assert!(body(&running.post("/api/drawing/layouts", &asked)).starts_with("<svg"));
    let none = running.post("/api/verb/layouts", &json!({ "client": "c", "of": "XYZ", "tilt": 30 }));
    assert_eq!((none.json()["left"].clone(), none.header("kinecut-exit")), (json!(0), Some("1")));
}

#[test]
fn a_machine_moves_with_its_links() {
    let (_folder, running) = cone();
    let ask = |more: Value| {
        let mut asked = json!({ "client": "c" });
        asked.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        running.post("/api/verb/machine", &asked)
    };
    let told = ask(json!({ "machine": "trt_xyzac", "at": "A-30 C45 X10", "bodies": true })).json();
    let words = PoseWords { words: vec![('A', -30.0), ('C', 45.0), ('X', 10.0)] };
    let own = forward(&Machine::preset("trt_xyzac").unwrap(), &words, 0.0).unwrap();
    assert_eq!(told["pose"]["tip"], json!(own.tip));
    assert_eq!(told["drawn"]["usual"], true);
    let links = told["pose"]["links"].as_array().unwrap();
    let of = |name: &str| &links.iter().find(|l| l["link"] == name).unwrap()["matrix"];
    // The slide of a table axis goes the other way; the bed stands.
    assert_eq!((&of("X")[0][3], &of("bed")[0]), (&json!(-10.0), &json!([1.0, 0.0, 0.0, 0.0])));
    assert!((of("A")[1][1].as_f64().unwrap() - 30f64.to_radians().cos()).abs() < 1e-12);
    let bodies = told["drawn"]["bodies"].as_array().unwrap();
    assert!(bodies.iter().any(|b| b["role"] == "part" && b["link"] == "C"));
    let far = ask(json!({ "machine": "trt_xyzac", "at": "A80" }));
    assert_eq!(
        (far.json()["pose"]["findings"][0]["key"].clone(), far.header("kinecut-exit")),
        (json!("A"), Some("1"))
    );
    // A layout is a machine too; written, it is a file that is read again.
    let layout = ask(json!({ "layout": "641203", "stroke": [300, 200, 100], "at": "Z-20" })).json();
    assert_eq!((&layout["axes"][2]["travel"], &layout["code"]), (&json!([-150.0, 150.0]), &json!("641203")));
    let file = running.post("/api/verb/machinefile", &json!({ "client": "c", "layout": "641203" })).json();
    let made = running.post("/api/file", &json!({ "new": "made.toml", "text": file }));
    let id = made.json()["id"].as_str().unwrap().to_owned();
    let again = ask(json!({ "machine": id, "bodies": true })).json();
    assert_eq!((&again["code"], &again["drawn"]["usual"]), (&json!("641203"), &json!(false)));
    let svg =
        |at: &str| running.post("/api/drawing/machine", &json!({ "client": "c", "machine": id, "at": at }));
    assert_ne!(svg("C0").body, svg("C30 A-20").body);
    let poses = json!({ "client": "c", "machine": "trt_xyzac", "at": ["X10 Z5 J-0.7 K0.7", "X0 Z0 K1"] });
    let found = running.post("/api/verb/ik", &poses).json();
    assert!((found[0]["solutions"][0]["joints"]["A"].as_f64().unwrap() - 45.0).abs() < 1e-9, "{found}");
}

#[test]
fn the_newest_question_about_a_surface_counts() {
    let (_folder, running) = cone();
    let asked = |n: u64| json!({ "client": "c", "generation": n, "surface": "torus", "machine": "millturn_xyzbc", "alternatives": true });
    std::thread::scope(|scope| {
        let first = scope.spawn(|| running.post("/api/verb/surface", &asked(1)));
        until("the first is being worked on", || running.look.held().lanes > 0 || first.is_finished());
        let second = running.post("/api/verb/surface", &json!({ "client": "c", "generation": 2, "surface": "torus", "machine": "millturn_xyzbc", "set": { "R": "41" }, "verify": "6151" }));
        let first = first.join().unwrap().json();
        assert!(first["code"] == "KC0009" || first["name"] == "torus", "{first}");
        assert_eq!(second.json()["parameters"]["R"], 41.0);
    });
}
