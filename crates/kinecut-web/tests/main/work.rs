//! Plans and simulations: the newest counts, and nothing grows.

use std::io::Write as _;
use std::time::{Duration, Instant};

use kinecut_web::Limits;
use serde_json::{Value, json};

use crate::common::{Folder, PLATE, Running, reply, until};

fn plate() -> (Folder, Running) {
    let folder = Folder::new();
    folder.write("job.toml", PLATE);
    let running = Running::of(&folder);
    (folder, running)
}

/// A job whose simulation takes long.
fn slow(step: f64) -> String {
    PLATE
        .replace("[[setup]]", &format!("simulate = {{ step = {step}, memory = 8000 }}\n[[setup]]"))
        .replace("max = [40, 30, 0]", "max = [400, 300, 0]")
}

#[test]
fn a_text_that_is_being_edited_is_planned() {
    let (_folder, running) = plate();
    let id = running.id("job.toml");
    let ask = |text: Value| {
        running.post("/api/plan", &json!({ "client": "c", "generation": 7, "file": id, "text": text })).json()
    };
    let done = ask(Value::Null);
    assert_eq!((&done["state"], &done["generation"]), (&json!("done"), &json!(7)));
    assert_eq!(done["programs"][0]["file"], "job.ngc");
    assert!(done["programs"][0]["text"].as_str().unwrap().contains("X30"), "{done}");
    assert_eq!(done["plan"]["setups"][0]["program"], "job.ngc");
    assert!(done["plan"].get("stock_volume").is_none());
    assert!(done["scene"]["head"]["path"]["pieces"].as_u64().unwrap() > 4);
    assert_eq!(done["scene"]["head"]["part"]["triangles"], 12);
    assert!(done["scene"]["streams"]["kc-path"].as_str().unwrap().len() > 20);
    let edited = ask(json!(PLATE.replace("[30, 10]", "[31, 10]")));
    assert!(edited["programs"][0]["text"].as_str().unwrap().contains("X31"));
    let wrong = ask(json!(PLATE.replace("depth = 6", "depth = -6")));
    assert_eq!(wrong["state"], "wrong");
    let place = &wrong["error"]["place"];
    assert_eq!(
        (&place["file"], &place["line"], &place["text"]),
        (&json!("job.toml"), &json!(12), &json!("depth = -6"))
    );
    assert!(place["start"].as_u64() < place["end"].as_u64());
    // Without the time law, which is most of the work.
    let machined = format!(
        "machine = {{ code = \"2103\", dynamics = {{ rapid = 30000, acceleration = 5, jerk = 50 }} }}\n{PLATE}"
    );
    let times = [true, false].map(|quick| {
        let asked = json!({ "client": "c", "file": id, "text": machined, "quick": quick });
        let done = running.post("/api/plan", &asked).json();
        assert_eq!((&done["state"], &done["quick"]), (&json!("done"), &json!(quick)), "{done}");
        done["plan"]["setups"][0]["time"].as_f64().unwrap()
    });
    assert!(times[0] < times[1], "{times:?}");
    let broken = ask(json!("format = "));
    assert_eq!((&broken["state"], &broken["error"]["code"]), (&json!("wrong"), &json!("KC0101")));
}

/// The runs of lines of a plan or simulation: key, tool, and what of the text stands at their place.
fn runs(done: &Value, text: &str) -> Vec<(String, u64, String)> {
    let all = done["operations"].as_array().unwrap_or_else(|| panic!("{done}"));
    let at = |run: &Value| {
        let place = &run["place"];
        let [start, end] = ["start", "end"].map(|end| place[end].as_u64().unwrap() as usize);
        text[start..end].to_owned()
    };
    let word = |run: &Value, key: &str| run[key].as_str().unwrap().to_owned();
    all.iter().map(|run| (word(run, "key"), run["tool"].as_u64().unwrap(), at(run))).collect()
}

#[test]
fn operations_have_the_lines_of_the_programs_that_were_written_for_them() {
    let (_folder, running) = plate();
    let id = running.id("job.toml");
    let second = PLATE[PLATE.find("[[setup]]").unwrap()..].replace("depth = 6", "depth = 7");
    let text = format!("{PLATE}{second}");
    for path in ["/api/plan", "/api/simulate"] {
        let mut asked = json!({ "client": "c", "file": id, "text": text });
        if path == "/api/simulate" {
            asked["step"] = json!("coarse");
        }
        let done = running.post(path, &asked).json();
        let keys: Vec<String> = runs(&done, &text).into_iter().map(|(key, ..)| key).collect();
        assert_eq!(keys, ["setup[0].operation[0]", "setup[1].operation[0]"], "{path}");
        let [first, second] = [0, 1].map(|i| &done["operations"][i]);
        let lines = |i: usize| done["programs"][i]["text"].as_str().unwrap().lines().collect::<Vec<_>>();
        let number = |run: &Value, key: &str| run[key].as_u64().unwrap() as usize;
        // The second program's lines follow those of the first.
        let begin = lines(0).len();
        assert_eq!(done["programs"][1]["first"], begin);
        assert!(number(first, "to") <= begin && number(second, "from") >= begin, "{first} {second}");
        let own = &lines(1)[number(second, "from") - begin..number(second, "to") - begin];
        assert!(own.iter().any(|line| line.contains("X30")) && !own.iter().any(|line| line.contains("M30")));
        assert_eq!((&first["tool"], &done["tools"][0]["number"]), (&json!(1), &json!(1)));
        assert_eq!(first["tool_name"], done["tools"][0]["name"]);
    }
}

#[test]
fn operations_of_holes_lie_where_the_hole_is_in_the_text() {
    let folder = Folder::new();
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/21_plate_by_sizes");
    let read = |name: &str| std::fs::read_to_string(format!("{example}/{name}")).unwrap();
    let text = read("job.toml");
    for name in ["job.toml", "tools.toml"] {
        folder.write(name, &read(name));
    }
    let running = Running::of(&folder);
    let asked = json!({ "client": "c", "file": running.id("job.toml"), "text": text });
    let done = running.post("/api/plan", &asked).json();
    let runs = runs(&done, &text);
    // Spot, drill, ream, tap: of one entry of the text come several operations, and none lies elsewhere.
    let of = |line: &str| {
        let at = text[..text.find(line).unwrap()].rfind("[[setup.operation]]").unwrap();
        let number = text[..=at].matches('\n').count() + 1;
        let all = done["operations"].as_array().unwrap();
        all.iter().filter(|run| run["place"]["line"] == json!(number)).count()
    };
    assert_eq!(
        [of("type = \"face\""), of("size = 6.6"), of("size = \"8H7\""), of("size = \"M8\"")],
        [1, 2, 3, 3],
        "{runs:?}"
    );
    assert!(runs.iter().all(|(key, ..)| key.starts_with("setup[0].operation[")), "{runs:?}");
}

#[test]
fn a_program_that_comes_alone_is_guessed_as_a_job_that_can_be_planned() {
    let folder = Folder::new();
    folder.write(
        "sub/slot.ngc",
        "(T1 D=6. CR=0. - FLAT END MILL)\nG21 G90 G54\nT1 M6\nG43\nG0 X0 Y0 Z5\nG1 Z-1 F300\nX30\nM2\n",
    );
    let running = Running::of(&folder);
    let file = running.id("sub/slot.ngc");
    let done = running.post("/api/guess", &json!({ "client": "c", "generation": 2, "file": file })).json();
    assert_eq!((&done["state"], &done["generation"]), (&json!("done"), &json!(2)), "{done}");
    let job = done["job"].as_str().unwrap();
    assert!(job.contains("min = [-3, -3, -1], max = [33, 3, 0]") && job.contains("diameter = 6"), "{job}");
    let made = running.post("/api/file", &json!({ "new": "slot.toml", "beside": file, "text": job })).json();
    let id = running.id(made["name"].as_str().unwrap());
    let planned = running.post("/api/plan", &json!({ "client": "c", "file": id })).json();
    assert_eq!((&planned["state"], &planned["programs"][0]["file"]), (&json!("done"), &json!("slot.ngc")));
    // Programs of others have no operations of the job.
    assert_eq!(planned["operations"], json!([]));
    let wrong = running.post("/api/guess", &json!({ "client": "c", "file": id, "control": "none" })).json();
    assert_eq!(wrong["state"], "wrong", "{wrong}");
}

#[test]
fn other_files_that_are_being_edited_are_seen_too() {
    let folder = Folder::new();
    let machine = "name = \"M\"\ncode = \"2103\"\n";
    folder.write("jobs/mill.toml", machine);
    folder.write("jobs/job.toml", &format!("machine = \"mill.toml\"\n{PLATE}"));
    let running = Running::of(&folder);
    let (job, mill) = (running.id("jobs/job.toml"), running.id("jobs/mill.toml"));
    let ask = |text: &str| {
        let edits = json!([{ "file": mill, "text": text }]);
        running.post("/api/plan", &json!({ "client": "c", "file": job, "edits": edits })).json()
    };
    assert_eq!(ask(machine)["state"], "done");
    let wrong = ask("name = \"M\"\ncode = \"99\"\n");
    assert_eq!((&wrong["state"], &wrong["error"]["place"]["file"]), (&json!("wrong"), &json!("mill.toml")));
    assert_eq!(folder.read("jobs/mill.toml"), machine);
}

#[test]
fn a_simulation_answers_with_verdict_and_part_and_questions_about_it() {
    let (_folder, running) = plate();
    let id = running.id("job.toml");
    let ask = |step: Value, full: bool| {
        let asked = json!({ "client": "c", "generation": 1, "file": id, "step": step, "full": full });
        running.post("/api/simulate", &asked).json()
    };
    let coarse = ask(json!("coarse"), false);
    assert_eq!((&coarse["state"], &coarse["coarse"]), (&json!("done"), &json!(true)));
    let fine = ask(json!(0.15), true);
    assert!(
        fine["step"] == 0.15 && fine["step"].as_f64() < coarse["step"].as_f64(),
        "{} {}",
        fine["step"],
        coarse["step"]
    );
    assert_eq!(fine["verdict"]["outcome"], "safe", "{}", fine["findings"]);
    assert!(fine["scene"]["head"]["part"]["triangles"].as_u64() > Some(100));
    assert!(fine["scene"]["head"]["playback"]["faces"].as_u64() > Some(10));
    // Two holes of 6 mm and the point below.
    let removed = fine["plan"]["removed_volume"].as_f64().unwrap();
    assert!(removed > 2.0 * 6.0 * 50.0 && removed < 2.0 * 9.0 * 51.0, "{removed}");
    let result = fine["result"].as_str().unwrap();
    let seen = running
        .post("/api/inspect", &json!({ "result": result, "sections": ["z=-3"], "points": [[10, 10, -3]] }));
    let seen = seen.json();
    // The plate less two holes of 8 mm.
    let area = seen["sections"][0]["area"].as_f64().unwrap();
    assert!((area - (1200.0 - 32.0 * std::f64::consts::PI)).abs() < 1.0, "{seen}");
    let page = running.post("/api/report", &json!({ "result": result }));
    assert!(page.status == 200 && page.body.starts_with(b"<!DOCTYPE html>"));
    assert_eq!(running.post("/api/inspect", &json!({ "result": "r999" })).reason(), "gone");
}

#[test]
fn a_run_is_written_beside_its_job() {
    let (folder, running) = plate();
    let done = running.post("/api/write", &json!({ "client": "c", "file": running.id("job.toml") })).json();
    assert_eq!(
        (&done["state"], &done["folder"], &done["verdict"]["outcome"]),
        (&json!("done"), &json!("out"), &json!("safe"))
    );
    let verdict =
        kinecut::verify(&folder.opened().join("out"), Some(&folder.opened().join("job.toml"))).unwrap();
    let text = serde_json::to_string(&verdict).unwrap();
    assert!(text.contains("\"holds\":true") || !kinecut::verbs::Answer::is_no(&verdict), "{text}");
    for name in ["..", "a/b", "", "."] {
        let asked = json!({ "client": "c", "file": running.id("job.toml"), "folder": name });
        assert_eq!(running.post("/api/write", &asked).status, 400, "{name}");
    }
}

#[test]
fn the_newest_request_cancels_the_older_of_its_kind() {
    let (_folder, running) = plate();
    let id = running.id("job.toml");
    let body = |text: &str| {
        json!({ "client": "c", "generation": 1, "file": id, "text": text, "playback": false }).to_string()
    };
    let send = |body: &str| {
        let mut stream = running.connect();
        let own: String = running.own().iter().map(|(k, v)| format!("{k}: {v}\r\n")).collect();
        let head = format!(
            "POST /api/simulate HTTP/1.1\r\n{own}Connection: close\r\nContent-Length: {}\r\n\r\n",
            body.len()
        );
        stream.write_all(head.as_bytes()).unwrap();
        stream.write_all(body.as_bytes()).unwrap();
        stream
    };
    let mut older = send(&body(&slow(0.1)));
    until("the older one runs", || running.look.held().lanes == 1);
    // A slow simulation keeps no plan waiting.
    let plan = running.post("/api/plan", &json!({ "client": "c", "file": id }));
    assert_eq!(plan.json()["state"], "done");
    let begun = Instant::now();
    let mut newest = send(&body(PLATE));
    let ended = reply(&mut older).json();
    assert_eq!((&ended["state"], &ended["generation"]), (&json!("cancelled"), &json!(1)));
    assert!(begun.elapsed() < Duration::from_secs(2), "it was not told at once");
    assert_eq!(reply(&mut newest).json()["state"], "done");
    // One whose client has gone stops too, and so does one that is stopped.
    drop(send(&body(&slow(0.1))));
    until("work of nobody ends", || running.look.held().waiting == 0);
    let mut stopped = send(&body(&slow(0.1)));
    until("it runs", || running.look.held().lanes == 1);
    let said = running.post("/api/stop", &json!({ "client": "c", "kind": "simulate" }));
    assert_eq!(said.json()["stopped"], 1);
    assert_eq!(reply(&mut stopped).json()["state"], "cancelled");
    until("nothing runs", || running.look.held().waiting == 0);
}

#[test]
fn no_more_than_a_number_of_requests_waits() {
    let folder = Folder::new();
    folder.write("job.toml", PLATE);
    let running = Running::with(&folder, Limits { waiting: 2, ..Limits::default() });
    let id = running.id("job.toml");
    let send = |client: &str| {
        let body = json!({ "client": client, "file": id, "text": slow(0.1), "playback": false }).to_string();
        let mut stream = running.connect();
        let own: String = running.own().iter().map(|(k, v)| format!("{k}: {v}\r\n")).collect();
        let head = format!(
            "POST /api/simulate HTTP/1.1\r\n{own}Connection: close\r\nContent-Length: {}\r\n\r\n",
            body.len()
        );
        stream.write_all(format!("{head}{body}").as_bytes()).unwrap();
        stream
    };
    let held = [send("a"), send("b")];
    until("two run", || running.look.held().waiting == 2);
    let third = reply(&mut send("c"));
    assert_eq!((third.status, third.reason().as_str()), (429, "busy"));
    drop(held);
    until("none runs", || running.look.held().waiting == 0);
    assert_eq!(running.post("/api/plan", &json!({ "client": "c", "file": id })).json()["state"], "done");
}

#[test]
fn a_thousand_edits_leave_nothing_behind() {
    let (_folder, running) = plate();
    let id = running.id("job.toml");
    let own: String = running.own().iter().map(|(k, v)| format!("{k}: {v}\r\n")).collect();
    let before = memory();
    for i in 0..1000 {
        let text = PLATE.replace("[30, 10]", &format!("[{}, 10]", 20.0 + f64::from(i) * 0.01));
        // Another page now and then, and a simulation.
        let client = format!("c{}", i % 7);
        let (path, mut body) =
            ("/api/plan", json!({ "client": client, "generation": i, "file": id, "text": text }));
        let path = if i % 50 == 0 {
            body["step"] = json!(1.0);
            "/api/simulate"
        } else {
            path
        };
        let body = body.to_string();
        let head = format!(
            "POST {path} HTTP/1.1\r\n{own}Connection: close\r\nContent-Length: {}\r\n\r\n",
            body.len()
        );
        let reply = running.raw(format!("{head}{body}").as_bytes());
        assert_eq!((reply.status, &reply.json()["state"]), (200, &json!("done")), "{i}");
    }
    until("all has ended", || running.look.held().connections == 0);
    let held = running.look.held();
    assert_eq!((held.lanes, held.waiting, held.listening), (0, 0, 0));
    assert!(held.results <= 2, "{held:?}");
    if let (Some(before), Some(after)) = (before, memory()) {
        assert!(after < before + (300 << 20), "{before} bytes before, {after} after");
    }
}

/// Memory of this process [bytes], where the system tells it.
fn memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    Some(text.split(' ').nth(1)?.parse::<u64>().ok()? * 4096)
}

#[test]
fn a_program_by_others_is_followed_and_cut() {
    let folder = Folder::new();
    folder.write("slot.ngc", "(T1 D=6. CR=0. - FLAT END MILL)\nG21 G90 G94 G54\nT1 M6\nS3000 M3\nG43 H1\nG0 X0 Y0 Z5\nG1 Z-1 F300\nX30\nG0 Z5\nM2\n");
    let running = Running::of(&folder);
    let id = running.id("slot.ngc");
    let plan = running.post("/api/plan", &json!({ "client": "c", "file": id })).json();
    assert_eq!((&plan["state"], &plan["check"]["feed_moves"]), (&json!("done"), &json!(2)), "{plan}");
    assert!(plan["scene"]["head"]["path"]["pieces"].as_u64() > Some(2));
    let cut = running.post("/api/simulate", &json!({ "client": "c", "file": id, "step": "coarse" })).json();
    assert_eq!(
        (&cut["state"], &cut["programs"][0]["control"]),
        (&json!("done"), &json!("linuxcnc")),
        "{cut}"
    );
    assert!(cut["guessed"].as_array().is_some_and(|g| g.len() == 2), "{}", cut["guessed"]);
    let given = running
        .post(
            "/api/simulate",
            &json!({ "client": "c", "file": id, "step": 0.5, "stock": [-5, -5, -10, 35, 5, 0] }),
        )
        .json();
    assert_eq!(given["plan"]["stock_volume"], 4000.0);
}

#[test]
fn a_moving_tool_is_asked_with_the_flags_of_the_command_line() {
    let folder = Folder::new();
    let tool = "tool.shape.ball-nose = { diameter = 10, flute_length = 30 }\n";
    folder.write("curve.toml", &format!("{tool}twist = {{ velocity = [60, 0, -20] }}\n"));
    folder.write(
        "move.toml",
        &format!("{tool}tolerance = 0.1\nmove = {{ from = [0, 0, 0], to = [20, 0, 0] }}\n"),
    );
    let running = Running::of(&folder);
    let kinds = running.get("/api/project").json();
    let questions = kinds["files"].as_array().unwrap().iter().filter(|f| f["kind"] == "question").count();
    assert_eq!(questions, 2, "{kinds}");
    let ask = |verb: &str, name: &str, flags: Value| {
        let mut asked = json!({ "client": "c", "file": running.id(name) });
        asked.as_object_mut().unwrap().extend(flags.as_object().unwrap().clone());
        running.post(&format!("/api/verb/{verb}"), &asked).json()
    };
    let curve = ask("grazing", "curve.toml", json!({}));
    assert!(curve["bands"].as_array().unwrap().len() > 10, "{curve}");
    let growth = ask("envelope", "move.toml", json!({ "moments": 8 }));
    assert_eq!(growth["moments"].as_array().unwrap().len(), 9);
    let gallery = ask("grazing", "curve.toml", json!({ "gallery": true }));
    assert!(gallery.as_array().unwrap().iter().any(|g| g["title"] == "Sphere"));
}
