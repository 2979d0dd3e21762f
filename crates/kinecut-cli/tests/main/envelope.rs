//! `kinecut envelope` as a shell sees it.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use serde_json::Value;

use crate::shell::{example, folder, kinecut, text};

/// A flat end mill of 10 by 30 in a move, as JSON.
fn flat(motion: &str) -> String {
    format!(
        r#"{{ "tool": {{ "shape": {{ "end-mill": {{ "diameter": 10, "flute_length": 30 }} }} }}, {motion} }}"#
    )
}

/// A ball-nose cutter of 10 by 30 in a move, as JSON.
fn ball(motion: &str) -> String {
    flat(motion).replace("end-mill", "ball-nose")
}

/// A tool of lines through points, from the axis, in a move.
fn lines(points: &[[f64; 2]]) -> String {
    let elements: Vec<String> =
        points.iter().map(|p| format!(r#"{{ "to": [{}, {}] }}"#, p[0], p[1])).collect();
    format!(
        r#"{{ "tool": {{ "shape": {{ "contour": {{ "elements": [{}] }} }} }}, "move": {{ "from": [0, 0, 0], "to": [9, 0, 0] }} }}"#,
        elements.join(", ")
    )
}

fn json(input: &str) -> Value {
    let run = kinecut(&["envelope", "-", "--json"], input);
    assert_eq!(run.status.code(), Some(0), "{}{}", text(&run.stdout), text(&run.stderr));
    serde_json::from_slice(&run.stdout).unwrap()
}

/// The error of wrong input: exit code 2, its code, and all of the words in it.
fn refused(input: &str, code: &str, words: &[&str]) {
    let run = kinecut(&["envelope", "-"], input);
    let error = text(&run.stderr);
    assert_eq!(run.status.code(), Some(2), "{input}\n{error}");
    assert!(error.contains(code), "{code} for {input}\n{error}");
    for word in words {
        assert!(error.contains(word), "`{word}` for {input}\n{error}");
    }
    assert_eq!(error.matches("error[").count(), 1, "one error only\n{error}");
}

fn three(v: &Value) -> [f64; 3] {
    [0, 1, 2].map(|i| v[i].as_f64().unwrap())
}

#[test]
fn straight_and_level_and_round_have_their_volumes() {
    let volume = |sheet: &Value| sheet["mesh"]["volume"].as_f64().unwrap();
    let pin = 25.0 * PI * 30.0;
    let line = json(&flat(r#""move": { "from": [0, 0, 0], "to": [20, 0, 0] }"#));
    let exact = pin + 10.0 * 20.0 * 30.0;
    assert!(
        (volume(&line) / exact - 1.0).abs() < 1e-3
            && (line["exact_volume"].as_f64().unwrap() - exact).abs() < 1e-6
    );
    assert!((line["tool_volume"].as_f64().unwrap() - pin).abs() < 1e-9);
    assert_eq!(line["length"].as_f64().unwrap(), 20.0);
    // The shadow of the tool ahead: 10 by 30 for each mm.
    let rate = line["entering"][24]["volume_rate"].as_f64().unwrap() / 20.0;
    assert!((rate - 300.0).abs() < 1e-9, "{rate}");
    // A quarter of a ring of 10 by 30 about a circle of 40, and half the tool at each end.
    let arc = json(&flat(r#""move": { "from": [40, 0, 0], "centre": [0, 0, 0], "turn": 90 }"#));
    let exact = pin + 0.5 * PI * 40.0 * 10.0 * 30.0;
    assert!((volume(&arc) / exact - 1.0).abs() < 2e-3, "{} {exact}", volume(&arc));
    assert!(arc["way"].as_str().unwrap().contains("arc"));
    // A plunge is the longer tool.
    let plunge = json(&flat(r#""move": { "from": [0, 0, 0], "to": [0, 0, -7] }"#));
    assert!((volume(&plunge) / (25.0 * PI * 37.0) - 1.0).abs() < 2e-3);
    let helix = json(&flat(r#""move": { "from": [40, 0, 0], "centre": [0, 0, 0], "turn": 90, "rise": -6 }"#));
    assert!(volume(&helix) > volume(&arc) && helix["way"].as_str().unwrap().contains("helix"));
}

/// Twist of a move at a moment by differences of points, from the sheet's own statement of the motion: a great circle.
#[test]
fn points_of_a_turning_move_graze_and_stay_on_the_tool() {
    let input = ball(
        r#""move": { "from": [1, 2, 3], "to": [21, -4, 8], "axis": [0, 0, 1], "axis_to": [1, 0, 1] }, "points": 300"#,
    );
    let sheet = json(&input);
    let points = sheet["points"].as_array().unwrap();
    assert_eq!(points.len(), 300);
    assert!((sheet["turn"].as_f64().unwrap() - 45.0).abs() < 1e-9);
    assert!(sheet["mode"].as_str().unwrap().contains("great circle"));
    // The pose by hand: turned by 45 t degrees about Y, the tip on the line.
    let place = |t: f64, q: [f64; 3]| {
        let (sin, cos) = (0.25 * PI * t).sin_cos();
        let tip = [1.0 + 20.0 * t, 2.0 - 6.0 * t, 3.0 + 5.0 * t];
        [tip[0] + cos * q[0] + sin * q[2], tip[1] + q[1], tip[2] - sin * q[0] + cos * q[2]]
    };
    let back = |t: f64, p: [f64; 3]| {
        let (sin, cos) = (0.25 * PI * t).sin_cos();
        let d = [p[0] - 1.0 - 20.0 * t, p[1] - 2.0 + 6.0 * t, p[2] - 3.0 - 5.0 * t];
        [cos * d[0] - sin * d[2], d[1], sin * d[0] + cos * d[2]]
    };
    for p in points {
        let (t, at, n) = (p["t"].as_f64().unwrap(), three(&p["point"]), three(&p["normal"]));
        let q = back(t, at);
        // On the ball of radius 5 about (0, 0, 5), the flank, or the top at 30.
        let r = q[0].hypot(q[1]);
        let off = [(r.hypot(q[2] - 5.0) - 5.0).abs(), (r - 5.0).abs(), (q[2] - 30.0).abs()];
        assert!(off.into_iter().fold(f64::INFINITY, f64::min) < 1e-9, "{p} {q:?}");
        let h = 1e-5;
        let (a, b) = (place(t - h, q), place(t + h, q));
        let across: f64 = (0..3).map(|k| n[k] * (b[k] - a[k]) / (2.0 * h)).sum();
        assert!(across.abs() < 1e-6 * 30.0, "{p} {across}");
        let size: f64 = n.iter().map(|c| c * c).sum();
        assert!((size - 1.0).abs() < 1e-12);
    }
}

#[test]
fn every_kind_of_move_has_its_words() {
    let run = kinecut(&["envelope", &example("06_five_axis_sweep/envelopes.toml"), "--json"], "");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let all: Value = serde_json::from_slice(&run.stdout).unwrap();
    let all = all.as_array().unwrap();
    let modes = [
        "stands still",
        "stands still",
        "great circle",
        "no control of the tool centre point",
        "rotary axes go straight",
        "constant twist",
        "tool centre point",
    ];
    assert_eq!(all.len(), modes.len());
    for (sheet, mode) in all.iter().zip(modes) {
        assert!(sheet["mode"].as_str().unwrap().contains(mode), "{mode}: {}", sheet["mode"]);
        assert!(sheet["pose_error"].as_f64().unwrap() <= 0.1);
        assert!(sheet["mesh"]["volume"].as_f64().unwrap() > sheet["tool_volume"].as_f64().unwrap());
    }
    assert_eq!(all[6]["source"]["line"], 27);
    assert!(all[3]["source"]["from"].as_str().unwrap().contains("A-10"));
}

#[test]
fn several_meshes_are_numbered_and_closed() {
    let out = folder("several");
    let item = |motion: &str| flat(&format!(r#"{motion}, "tolerance": 0.2"#));
    let input = format!(
        "[{}, {}]",
        item(r#""screw": { "turn": [0, 30, 0], "velocity": [12, 0, 0] }"#),
        item(r#""move": { "from": [0, 0, 0], "to": [9, 4, -3] }"#)
    );
    let run = kinecut(&["envelope", "-", "--json", "--out", &out.display().to_string()], &input);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let all: Value = serde_json::from_slice(&run.stdout).unwrap();
    for (i, sheet) in all.as_array().unwrap().iter().enumerate() {
        let bytes = std::fs::read(out.join(format!("envelope-{}.stl", i + 1))).unwrap();
        let (volume, triangles) = closed(&bytes);
        assert_eq!(triangles as u64, sheet["mesh"]["triangles"].as_u64().unwrap());
        let told = sheet["mesh"]["volume"].as_f64().unwrap();
        assert!((volume / told - 1.0).abs() < 1e-4, "{volume} {told}");
        let glb = std::fs::read(out.join(format!("envelope-{}.glb", i + 1))).unwrap();
        assert_eq!(&glb[..4], b"glTF");
    }
    assert!(std::fs::read_to_string(out.join("envelope.html")).unwrap().contains("2 envelopes"));
    std::fs::remove_dir_all(&out).unwrap();
}

/// Volume and triangles of a binary STL in which every edge is run once in each direction; corners are joined by their bits.
fn closed(bytes: &[u8]) -> (f64, usize) {
    let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize;
    assert_eq!(bytes.len(), 84 + 50 * count);
    let mut edges: BTreeMap<[[u32; 3]; 2], i64> = BTreeMap::new();
    let mut volume = 0.0;
    for face in bytes[84..].chunks(50) {
        let word = |k: usize| u32::from_le_bytes(face[12 + 4 * k..16 + 4 * k].try_into().unwrap());
        // A zero has one sign only.
        let corner =
            |c: usize| [0, 1, 2].map(|k| if word(3 * c + k) == 1 << 31 { 0 } else { word(3 * c + k) });
        let corners = [corner(0), corner(1), corner(2)];
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            if a == b {
                // Corners that singles cannot tell apart.
                continue;
            }
            if a < b {
                *edges.entry([a, b]).or_default() += 1;
            } else {
                *edges.entry([b, a]).or_default() -= 1;
            }
        }
        let [a, b, c] = corners.map(|v| v.map(|w| f64::from(f32::from_bits(w))));
        let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
        volume += (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0;
    }
    assert!(edges.values().all(|n| *n == 0), "edges that are not closed");
    (volume, count)
}

#[test]
fn a_move_of_nothing_is_the_tool_and_says_so() {
    let still = kinecut(&["envelope", "-"], &flat(r#""move": { "from": [1, 2, 3], "to": [1, 2, 3] }"#));
    assert_eq!(still.status.code(), Some(0), "{}", text(&still.stderr));
    let denied = kinecut(
        &["envelope", "-", "--deny", "warnings"],
        &flat(r#""move": { "from": [1, 2, 3], "to": [1, 2, 3] }"#),
    );
    assert_eq!(denied.status.code(), Some(1), "{}", text(&denied.stderr));
    let shown = text(&still.stderr);
    assert!(shown.contains("KC1201") && shown.contains("sweeps itself"), "{shown}");
    let run = kinecut(&["envelope", "-", "--json"], &flat(r#""screw": { "turn": [0, 0, 90] }"#));
    assert_eq!(run.status.code(), Some(0));
    let sheet: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(sheet["findings"][0]["code"], "KC1201");
    let ratio = sheet["mesh"]["volume"].as_f64().unwrap() / sheet["tool_volume"].as_f64().unwrap();
    assert!((ratio - 1.0).abs() < 2e-3, "{ratio}");
}

#[test]
fn what_lies_inside_is_told_and_the_mesh_is_said_to_cut_itself() {
    let line = json(&ball(r#""move": { "from": [0, 0, 0], "to": [20, 3, -9] }"#));
    // A convex tool that does not turn: everything is on the boundary.
    assert_eq!(line["walls"]["inside"], 0.0);
    assert_eq!(line["untrimmed"]["may_cut_itself"], false);
    assert_eq!(line["mesh"]["deeper"], 0);
    assert!(line["cusps"].as_array().unwrap().is_empty());
    let shown = text(&kinecut(&["envelope", &example("06_five_axis_sweep/envelope.toml")], "").stdout);
    // Lines break anywhere.
    let shown = shown.split_whitespace().collect::<Vec<_>>().join(" ");
    for word in [
        "great circle",
        "Way of the tip",
        "it cuts itself",
        "vertices looked at are deeper",
        "F_tt < 0",
        "volume entered",
        "Curves that are born",
    ] {
        assert!(shown.contains(word), "{word}\n{shown}");
    }
    assert!(!shown.contains("closed form"), "none is known of a turning tool\n{shown}");
}

#[test]
fn an_array_gives_an_array_and_a_wrong_item_does_not_stop_the_rest() {
    let fine = flat(r#""move": { "from": [0, 0, 0], "to": [5, 0, 0] }"#);
    let input = format!("[{fine}, {}]", flat(r#""move": { "from": [0, 0, 0] }"#));
    let run = kinecut(&["envelope", "-", "--json"], &input);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    let answer: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(answer[0]["length"], 5.0);
    assert_eq!(answer[1]["error"]["code"], "KC0102");
    assert_eq!(answer[1]["error"]["key"], "envelope[1].move.to");
}

#[test]
fn wrong_tools_are_refused_with_their_place() {
    refused(&lines(&[[5.0, 0.0], [-1.0, 20.0], [0.0, 20.0]]), "KC0704", &["-1 mm"]);
    refused(&lines(&[[5.0, 0.0], [1.0, 20.0], [6.0, 20.0], [2.0, 2.0], [0.0, 30.0]]), "KC0704", &["cross"]);
    refused(&lines(&[[5.0, 0.0], [5.0, 20.0], [1.0, 20.0]]), "KC0704", &["axis"]);
    refused(r#"{ "move": { "from": [0, 0, 0], "to": [1, 0, 0] } }"#, "KC0102", &["there is no tool"]);
    refused(
        "tool_file = \"nowhere.dxf\"\nmove = { from = [0, 0, 0], to = [1, 0, 0] }",
        "KC0001",
        &["nowhere.dxf"],
    );
}

#[test]
fn wrong_moves_are_refused() {
    let way = |rest: &str| flat(&format!(r#""move": {{ "from": [0, 0, 0], {rest} }}"#));
    refused(&flat(r#""tolerance": 0.1"#), "KC1212", &["0 moves", "joints"]);
    refused(&flat(r#""move": { "from": [0, 0, 0], "to": [1, 0, 0] }, "screw": {}"#), "KC1212", &["2 moves"]);
    refused(&way(r#""axis": [0, 0, 1]"#), "KC0102", &["no end"]);
    refused(&way(r#""to": [1, 0, 0], "turn": 90"#), "KC0102", &["belongs to an arc"]);
    refused(&way(r#""centre": [1, 0, 0]"#), "KC0102", &["no angle"]);
    refused(&way(r#""centre": [0, 0, 5], "turn": 90"#), "KC0801", &["radius"]);
    refused(&way(r#""to": [1e9, 0, 0]"#), "KC0103", &["out of all measure", "10000 mm"]);
    refused(&way(r#""to": [1, 0, 0], "axis": [0, 0, 0]"#), "KC1203", &["no length"]);
    refused(
        &way(r#""to": [1, 0, 0], "axis": [0, 0, 1], "axis_to": [0, 0, -2]"#),
        "KC1203",
        &["180 degrees", "divide the move"],
    );
    let pose = |m: &str| flat(&format!(r#""screw": {{ "pose": {m}, "velocity": [5, 0, 0] }}"#));
    refused(&pose("[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]]"), "KC1202", &["no rotation"]);
    refused(&pose("[[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]"), "KC1202", &["left-handed"]);
    refused(&pose("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"), "KC0102", &["four numbers"]);
    let within = |tolerance: &str| {
        flat(&format!(r#""move": {{ "from": [0, 0, 0], "to": [9, 0, 0] }}, "tolerance": {tolerance}"#))
    };
    refused(&within("0"), "KC1204", &["0 mm"]);
    refused(&within("-1"), "KC1204", &["-1 mm"]);
    refused(&within("1").replace("\"tolerance\": 1", "\"points\": 4000000000"), "KC0103", &["1000000"]);
    refused(
        &flat(r#""move": { "from": [9, 0, 0], "centre": [0, 0, 0], "turn": 360 }, "tolerance": 1e-12"#),
        "KC1205",
        &["larger tolerance"],
    );
}

#[test]
fn what_a_machine_cannot_do_is_refused() {
    let joints = |rest: &str| flat(&format!(r#""joints": {{ "machine": "trt_xyzac", {rest} }}"#));
    let fine = joints(r#""from": { "A": 0 }, "to": { "A": 20, "C": 10 }, "length": 50"#);
    let sheet = json(&fine);
    assert!(sheet["turn"].as_f64().unwrap() > 19.0);
    refused(&joints(r#""from": { "B": 0 }, "to": { "A": 20 }"#), "KC0703", &["no axis `B`", "X, Y, Z"]);
    refused(&joints(r#""from": { "AC": 0 }, "to": { "A": 20 }"#), "KC0703", &["no letter"]);
    refused(&flat(r#""joints": { "machine": "no_such", "from": {}, "to": {} }"#), "KC1117", &["no_such"]);
    let folder = folder("machine");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(
        folder.join("machine.toml"),
        "code = \"641203\"\ntravel = { X = [-50, 50], A = [-30, 60] }\n",
    )
    .unwrap();
    let file = folder.join("move.toml");
    let refused_here = |joints: &str, words: &[&str]| {
        std::fs::write(&file, format!("tool.shape.end-mill = {{ diameter = 10, flute_length = 30 }}\n[joints]\nmachine = \"machine.toml\"\n{joints}")).unwrap();
        let run = kinecut(&["envelope", file.to_str().unwrap()], "");
        let error = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{error}");
        assert!(error.contains("KC1203"), "{error}");
        words.iter().for_each(|w| assert!(error.contains(w), "`{w}`\n{error}"));
    };
    refused_here("from = { A = 0 }\nto = { A = 75 }\n", &["axis A", "75 degrees", "60 degrees"]);
    refused_here("from = { X = -60 }\nto = { A = 10 }\n", &["axis X", "-60 mm", "-50 mm"]);
    // The tip is out of reach at the end of its way only.
    refused_here(
        "from = { A = 0 }\nto = { A = 10 }\ntip = { from = [0, 0, 0], to = [200, 0, 0] }\n",
        &["axis X", "50 mm"],
    );
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn wrong_texts_are_refused_with_their_place() {
    refused("{", "KC0101", &["JSON"]);
    refused("tool = ", "KC0101", &["-:1"]);
    let tool = "[tool]\nshape.end-mill = { diameter = 10, flute_length = 20 }\n";
    refused(
        &format!("{tool}[move]\nform = [0, 0, 0]\nto = [1, 0, 0]\n"),
        "KC0102",
        &["-:4", "did you mean `from`"],
    );
    refused(&format!("{tool}[move]\nfrom = [0, nan, 0]\nto = [1, 0, 0]\n"), "KC0103", &["-:4"]);
    let missing = kinecut(&["envelope", "nowhere.toml"], "");
    assert_eq!(missing.status.code(), Some(2));
    assert!(text(&missing.stderr).contains("KC0001"));
}

#[test]
fn files_stand_alone_and_are_whole_or_absent() {
    let out = folder("files");
    let svg = out.join("swept.svg");
    let (dir, file) = (out.display().to_string(), svg.display().to_string());
    let input =
        ball(r#""move": { "from": [0, 0, 0], "to": [20, 0, -4], "axis_to": [0, 0.5, 1] }, "tolerance": 0.2"#);
    let run = kinecut(&["envelope", "-", "--out", &dir, "--svg", &file], &input);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let page = std::fs::read_to_string(out.join("envelope.html")).unwrap();
    let drawing = std::fs::read_to_string(&svg).unwrap();
    assert!(drawing.starts_with("<svg") && drawing.contains("t-teal") && drawing.contains("c-ink w-thin"));
    for text in [&page, &drawing] {
        assert!(!text.contains("NaN") && !text.contains("inf "), "every number is one");
        assert_eq!(text.matches("http://").count(), text.matches("http://www.w3.org").count());
    }
    let (volume, _) = closed(&std::fs::read(out.join("envelope.stl")).unwrap());
    let (untrimmed, _) = closed(&std::fs::read(out.join("envelope-untrimmed.stl")).unwrap());
    assert!((volume / untrimmed - 1.0).abs() < 0.1, "{volume} {untrimmed}");
    let mut names: Vec<String> = std::fs::read_dir(&out)
        .unwrap()
        .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(
        names,
        ["envelope-untrimmed.stl", "envelope.glb", "envelope.html", "envelope.stl", "swept.svg"]
    );
    // A folder in the way of the page: nothing is written.
    let other = folder("in-the-way");
    std::fs::create_dir_all(other.join("envelope.html")).unwrap();
    let run = kinecut(&["envelope", "-", "--out", &other.display().to_string()], &input);
    assert_eq!(run.status.code(), Some(2));
    assert!(text(&run.stderr).contains("KC0003"));
    assert_eq!(std::fs::read_dir(&other).unwrap().count(), 1);
    for folder in [out, other] {
        std::fs::remove_dir_all(folder).unwrap();
    }
}

#[test]
fn a_move_at_equal_moments_has_poses_curves_and_walls() {
    let motion = r#""tolerance": 0.05, "move": { "from": [0, 0, 0], "to": [20, 0, 0] }"#;
    let run = kinecut(&["envelope", "-", "--moments", "4", "--json"], &flat(motion));
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let growth: Value = serde_json::from_slice(&run.stdout).unwrap();
    let moments = growth["moments"].as_array().unwrap();
    assert_eq!(moments.len(), 5);
    for (k, m) in moments.iter().enumerate() {
        let t = 0.25 * k as f64;
        assert_eq!((m["t"].as_f64().unwrap(), m["pose"][0][3].as_f64().unwrap()), (t, 20.0 * t));
        assert_eq!(three(&m["velocity"]), [20.0, 0.0, 0.0]);
        // By the whole move the tool enters its section, 10 by 30.
        assert!((m["volume_rate"].as_f64().unwrap() - 6000.0).abs() < 1e-6, "{m}");
    }
    let triangles: Vec<u64> = moments.iter().map(|m| m["triangles"].as_u64().unwrap()).collect();
    assert_eq!(triangles[0], 0);
    assert!(triangles.windows(2).all(|p| p[0] < p[1]), "{triangles:?}");
    assert_eq!(growth["ends"][0][0].as_u64(), triangles.last().copied());
    assert_eq!(growth["ends"][1][1], growth["triangles"]);
    assert!(growth["stream"].as_str().unwrap().len() > 100);
    let shown = kinecut(&["envelope", "-", "--moments", "4"], &flat(motion));
    assert!(text(&shown.stdout).contains("15.0000"), "{}", text(&shown.stdout));
    assert_eq!(kinecut(&["envelope", "-", "--moments", "0"], &flat(motion)).status.code(), Some(2));
}

#[test]
fn a_move_is_swept_up_to_a_share_of_it() {
    // Half of each way is the move that ends there.
    let volume = |motion: &str| {
        let sheet = json(&flat(&format!(r#""step": 1, "points": 0, {motion}"#)));
        (
            sheet["length"].as_f64().unwrap(),
            sheet["untrimmed"]["volume"].as_f64().unwrap(),
            sheet["until"].as_f64().unwrap(),
        )
    };
    let halves = [
        (
            r#""move": { "from": [0, 0, 0], "to": [20, 0, -4] }"#,
            r#""move": { "from": [0, 0, 0], "to": [10, 0, -2] }"#,
        ),
        (
            r#""screw": { "turn": [0, 40, 0], "velocity": [9, 0, 0] }"#,
            r#""screw": { "turn": [0, 20, 0], "velocity": [4.5, 0, 0] }"#,
        ),
        (
            r#""joints": { "machine": "trt_xyzac", "length": 120, "from": { "A": -10 }, "to": { "X": 40, "A": -30 } }"#,
            r#""joints": { "machine": "trt_xyzac", "length": 120, "from": { "A": -10 }, "to": { "X": 20, "A": -20 } }"#,
        ),
    ];
    for (whole, half) in halves {
        let (a, b) = (volume(&format!(r#""until": 0.5, {whole}"#)), volume(half));
        assert_eq!((a.2, b.2), (0.5, 1.0));
        assert!((a.0 - b.0).abs() < 1e-9 && (a.1 / b.1 - 1.0).abs() < 1e-5, "{a:?} {b:?}");
    }
    let line = r#""move": { "from": [0, 0, 0], "to": [20, 0, 0] }"#;
    refused(&flat(&format!(r#""until": 0, {line}"#)), "KC0103", &["share of the move", "above 0"]);
    refused(&flat(&format!(r#""until": 1.5, {line}"#)), "KC0103", &["1.5"]);
}
