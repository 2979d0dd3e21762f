//! `kinecut grazing` as a shell sees it.

use std::f64::consts::PI;

use serde_json::Value;

use crate::shell::{example, folder, kinecut, text};

/// A ball-nose cutter of 10 by 30 under a motion, as JSON.
fn ball(motion: &str) -> String {
    format!(
        r#"{{ "tool": {{ "shape": {{ "ball-nose": {{ "diameter": 10, "flute_length": 30 }} }} }}, {motion} }}"#
    )
}

/// A tool of lines through points, from the axis, under a motion.
fn lines(points: &[[f64; 2]]) -> String {
    let elements: Vec<String> =
        points.iter().map(|p| format!(r#"{{ "to": [{}, {}] }}"#, p[0], p[1])).collect();
    format!(
        r#"{{ "tool": {{ "shape": {{ "contour": {{ "elements": [{}] }} }} }}, "twist": {{ "velocity": [60, 0, 0] }} }}"#,
        elements.join(", ")
    )
}

/// Half a section as DXF, of lines.
fn drawing(lines: &[[f64; 4]]) -> String {
    let line =
        |l: &[f64; 4]| format!("0\nLINE\n8\n0\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n", l[0], l[1], l[2], l[3]);
    let body: String = lines.iter().map(line).collect();
    format!("0\nSECTION\n2\nENTITIES\n{body}0\nENDSEC\n0\nEOF\n")
}

fn json(input: &str) -> Value {
    let run = kinecut(&["grazing", "-", "--json"], input);
    assert_eq!(run.status.code(), Some(0), "{}{}", text(&run.stdout), text(&run.stderr));
    serde_json::from_slice(&run.stdout).unwrap()
}

/// The error of wrong input: exit code 2, its code, and all of the words in it.
fn refused(input: &str, code: &str, words: &[&str]) {
    let run = kinecut(&["grazing", "-"], input);
    let error = text(&run.stderr);
    assert_eq!(run.status.code(), Some(2), "{input}\n{error}");
    assert!(error.contains(code), "{code} for {input}\n{error}");
    for word in words {
        assert!(error.contains(word), "`{word}` for {input}\n{error}");
    }
}

#[test]
fn a_ball_along_x_has_half_a_great_circle_and_two_generators() {
    let sheet = json(&ball(r#""twist": { "velocity": [60, 0, 0] }"#));
    assert_eq!(sheet["loops"].as_array().unwrap().len(), 1);
    // Half a circle of radius 5, two lines of 25, and the top across its diameter touches nothing: it grazes as a whole.
    let length = sheet["loops"][0]["length"].as_f64().unwrap();
    assert!((length - (5.0 * PI + 50.0)).abs() < 1e-9, "{length}");
    for p in sheet["loops"][0]["points"].as_array().unwrap() {
        assert!(p["point"][0].as_f64().unwrap().abs() < 1e-9, "{p}");
    }
    // The section of 10 by 30 with a round end, at 60 mm/min.
    let gained = sheet["entering"]["gained"].as_f64().unwrap();
    assert!((gained - 60.0 * (250.0 + 0.5 * PI * 25.0)).abs() < 1e-6, "{gained}");
    assert!((sheet["entering"]["lost"].as_f64().unwrap() - gained).abs() < 1e-6);
}

#[test]
fn every_point_has_no_normal_velocity() {
    let sheet = json(&ball(r#""twist": { "velocity": [600, 100, -150], "turn": [300, -200, 40] }"#));
    let three = |v: &Value| [0, 1, 2].map(|i| v[i].as_f64().unwrap());
    let (v, w) = (three(&sheet["twist"]["velocity"]), three(&sheet["twist"]["turn"]).map(f64::to_radians));
    let points: Vec<&Value> =
        sheet["loops"].as_array().unwrap().iter().flat_map(|l| l["points"].as_array().unwrap()).collect();
    assert!(points.len() > 50);
    for p in points {
        let (at, n) = (three(&p["point"]), three(&p["normal"]));
        let speed = [
            v[0] + w[1] * at[2] - w[2] * at[1],
            v[1] + w[2] * at[0] - w[0] * at[2],
            v[2] + w[0] * at[1] - w[1] * at[0],
        ];
        let across: f64 = (0..3).map(|i| n[i] * speed[i]).sum();
        assert!(across.abs() < 1e-9 * 600.0, "{p} {across}");
    }
}

#[test]
fn a_pose_and_its_rate_are_the_twist_that_they_stand_for() {
    // Turned by 90 degrees about Z, moving along Y of the work: along X of the tool. The rate is per second.
    let pose = ball(
        r#""pose": [[0, -1, 0, 5], [1, 0, 0, 6], [0, 0, 1, 7]], "rate": [[0, 0, 0, 0], [0, 0, 0, 2], [0, 0, 0, 0]]"#,
    );
    let sheet = json(&pose);
    assert_eq!(sheet["twist"]["velocity"][0].as_f64().unwrap(), 120.0);
    assert_eq!(sheet["source"]["pose"][0][3], 5.0);
    let with_last_row = pose
        .replace("0, 1, 7]]", "0, 1, 7], [0, 0, 0, 1]]")
        .replace("[0, 0, 0, 0]] }", "[0, 0, 0, 0], [0, 0, 0, 0]] }");
    assert_eq!(json(&with_last_row)["loops"], sheet["loops"]);
}

#[test]
fn motions_that_are_special_are_named() {
    let said = |motion: &str| text(&kinecut(&["grazing", "-"], &ball(motion)).stdout);
    assert!(said(r#""twist": { "velocity": [0, 0, -60] }"#).contains("plunge"));
    assert!(said(r#""twist": { "velocity": [60, 0, -6] }"#).contains("ramp"));
    let across = said(r#""twist": { "velocity": [60, 0, 0] }"#);
    assert!(across.contains("grazes as a whole") && across.contains("across the axis"), "{across}");
    let swing = said(r#""twist": { "turn": [0, 60, 0], "at": [0, 0, 5] }"#);
    assert!(swing.contains("sphere grazes as a whole"), "{swing}");
    let spin = kinecut(&["grazing", "-"], &ball(r#""twist": { "turn": [0, 0, 60] }"#));
    assert_eq!(spin.status.code(), Some(0));
    assert!(text(&spin.stderr).contains("KC1201"), "{}", text(&spin.stderr));
}

#[test]
fn a_moment_of_a_program_has_its_tool_its_line_and_its_feed() {
    let run = kinecut(&["grazing", &example("06_five_axis_sweep/moment.toml"), "--json"], "");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let sheet: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(sheet["source"]["line"], 27);
    let v = &sheet["twist"]["velocity"];
    let speed: f64 = (0..3).map(|i| v[i].as_f64().unwrap().powi(2)).sum::<f64>().sqrt();
    assert!((speed - 1200.0).abs() < 1e-6, "{speed}");
    let turning: f64 = (0..3).map(|i| sheet["twist"]["turn"][i].as_f64().unwrap().abs()).sum();
    assert!(turning > 1.0, "both tip and direction change: {turning}");
    assert!(v[1].as_f64().unwrap().abs() < 1e-6, "X of the tool is where the feed goes: {v}");
    assert_eq!(sheet["pieces"].as_array().unwrap().iter().filter(|p| p["fan"] == false).count(), 5);
}

#[test]
fn an_array_gives_an_array_and_a_wrong_item_does_not_stop_the_rest() {
    let input = format!("[{}, {}]", ball(r#""twist": { "velocity": [1, 0, 0] }"#), ball(r#""twist": {}"#));
    let run = kinecut(&["grazing", "-", "--json"], &input);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    let answer: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(answer[0]["loops"].as_array().unwrap().len(), 1);
    assert_eq!(answer[1]["error"]["code"], "KC1201");
    let list = kinecut(&["grazing", &example("06_five_axis_sweep/motions.toml"), "--json"], "");
    let answer: Value = serde_json::from_slice(&list.stdout).unwrap();
    assert_eq!(answer.as_array().unwrap().len(), 4);
}

#[test]
fn wrong_profiles_are_refused_with_their_place() {
    let beyond = lines(&[[5.0, 0.0], [-1.0, 20.0], [0.0, 20.0]]);
    refused(&beyond, "KC0704", &["-1 mm"]);
    let crossing = lines(&[[5.0, 0.0], [1.0, 20.0], [6.0, 20.0], [2.0, 2.0], [0.0, 30.0]]);
    refused(&crossing, "KC0704", &["cross"]);
    let open = lines(&[[5.0, 0.0], [5.0, 20.0], [1.0, 20.0]]);
    refused(&open, "KC0704", &["axis"]);
    let negative =
        ball(r#""twist": { "velocity": [1, 0, 0] }"#).replace("\"diameter\": 10", "\"diameter\": -10");
    refused(&negative, "KC0701", &["diameter", "-10 mm"]);
}

#[test]
fn a_drawing_with_a_gap_is_refused_where_it_is() {
    let folder = folder("grazing-gap");
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("tool.toml");
    std::fs::write(
        &file,
        "tool.shape.outline = { file = \"tool.dxf\", unit = \"mm\" }\ntwist = { velocity = [60, 0, 0] }\n",
    )
    .unwrap();
    let run = |gap: f64| {
        let section = drawing(&[[0.0, 0.0, 5.0, 0.0], [5.0, gap, 5.0, 20.0], [5.0, 20.0, 0.0, 20.0]]);
        std::fs::write(folder.join("tool.dxf"), section).unwrap();
        kinecut(&["grazing", file.to_str().unwrap()], "")
    };
    let whole = run(0.0);
    assert_eq!(whole.status.code(), Some(0), "{}", text(&whole.stderr));
    let broken = run(0.5);
    assert_eq!(broken.status.code(), Some(2));
    assert!(text(&broken.stderr).contains("gap between"), "{}", text(&broken.stderr));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn wrong_motions_are_refused() {
    refused(&ball(r#""twist": { "velocity": [0, 0, 0] }"#), "KC1201", &["does not move"]);
    refused(
        &ball(r#""twist": { "velocity": [1, 0, 0] }, "moment": { "job": "a", "line": 1 }"#),
        "KC1211",
        &["2 motions"],
    );
    refused(&ball(r#""tolerance": 0.1"#), "KC1211", &["0 motions"]);
    refused(&ball(r#""pose": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]"#), "KC1211", &["rate"]);
    let pose = |matrix: &str| {
        ball(&format!(r#""pose": {matrix}, "rate": [[0, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0]]"#))
    };
    refused(&pose("[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]]"), "KC1202", &["no rotation"]);
    refused(&pose("[[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]"), "KC1202", &["left-handed"]);
    refused(&pose("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"), "KC0102", &["four numbers"]);
    refused(&pose("[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]"), "KC0102", &["last row"]);
    refused(&ball(r#""twist": { "velocity": [1e300, 0, 0] }"#), "KC0103", &["too large"]);
    refused(&ball(r#""twist": { "velocity": [1, 0, 0] }, "tolerance": 0"#), "KC0103", &["tolerance"]);
    refused(&ball(r#""twist": { "velocity": [1, 0, 0] }, "tolerance": -1e-3"#), "KC0103", &["tolerance"]);
}

#[test]
fn wrong_texts_are_refused_with_their_place() {
    refused("{", "KC0101", &["JSON"]);
    refused("tool = ", "KC0101", &["-:1"]);
    refused(
        "[tool]\nshape.ball-nose = { diameter = 10, flute_length = 20 }\n[twist]\nvelocty = [1, 0, 0]\n",
        "KC0102",
        &["-:4", "did you mean `velocity`"],
    );
    refused(
        "[tool]\nshape.ball-nose = { diameter = 10, flute_length = 20 }\n[twist]\nvelocity = [1, nan, 0]\n",
        "KC0103",
        &["-:4"],
    );
    refused("twist = { velocity = [1, 0, 0] }", "KC0102", &["there is no tool"]);
    refused("tool_file = \"nowhere.dxf\"\ntwist = { velocity = [1, 0, 0] }", "KC0001", &["nowhere.dxf"]);
    let missing = kinecut(&["grazing", "nowhere.toml"], "");
    assert_eq!(missing.status.code(), Some(2));
    assert!(text(&missing.stderr).contains("KC0001"));
}

#[test]
fn a_line_that_moves_nothing_names_the_nearest_that_does() {
    let folder = folder("grazing");
    std::fs::create_dir_all(&folder).unwrap();
    for name in ["job.toml", "saddle.cl"] {
        std::fs::copy(example(&format!("06_five_axis_sweep/{name}")), folder.join(name)).unwrap();
    }
    let file = folder.join("moment.toml");
    std::fs::write(&file, "moment = { job = \"job.toml\", line = 1 }\n").unwrap();
    let run = kinecut(&["grazing", file.to_str().unwrap()], "");
    let error = text(&run.stderr);
    assert_eq!(run.status.code(), Some(2), "{error}");
    assert!(error.contains("KC1211") && error.contains("nearest line"), "{error}");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn the_pictures_stand_alone() {
    let folder = folder("grazing-out");
    let svg = folder.join("curve.svg");
    let out = folder.display().to_string();
    let run = kinecut(
        &["grazing", &example("06_five_axis_sweep/tool.toml"), "--out", &out, "--svg", svg.to_str().unwrap()],
        "",
    );
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let (page, drawing) = (
        std::fs::read_to_string(folder.join("grazing.html")).unwrap(),
        std::fs::read_to_string(&svg).unwrap(),
    );
    assert!(page.contains("Parameter plane") || page.contains("parameter plane"));
    assert!(drawing.starts_with("<svg") && drawing.contains("class=\"c-k4 "), "the torus has its colour");
    for text in [&page, &drawing] {
        assert!(!text.contains("NaN") && !text.contains("inf "), "every number is one");
        assert!(
            !text.contains("http://")
                || text.matches("http://").count() == text.matches("http://www.w3.org").count()
        );
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn the_gallery_says_what_is_right_and_what_is_corrected() {
    let run = kinecut(&["grazing", "--gallery"], "");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let shown = text(&run.stdout);
    for word in [
        "180.0\u{b0} on the half sphere",
        "2, 1, 0 points",
        "0, 1, 2, the whole disc",
        "two through-branches",
        "as 1/n",
        "0 curves stay open",
    ] {
        assert!(shown.contains(word), "{word}\n{shown}");
    }
}

#[test]
fn the_gallery_writes_a_drawing_of_each_case() {
    let folder = folder("gallery");
    let run = kinecut(&["grazing", "--gallery", "--out", folder.to_str().unwrap()], "");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let shown = text(&run.stdout);
    let listed: Vec<&str> =
        shown.lines().filter_map(|l| l.strip_prefix("  ")?.strip_suffix(".svg")).collect();
    let mut there: Vec<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".svg"))
        .collect();
    there.sort();
    let mut sorted: Vec<String> = listed.iter().map(|stem| format!("{stem}.svg")).collect();
    sorted.sort();
    assert_eq!(there, sorted);
    let page = std::fs::read_to_string(folder.join("gallery.html")).unwrap();
    assert!(there.len() > 20);
    assert_eq!(page.matches("-tool\"").count(), there.len(), "a file of each case");
    for name in &there {
        let drawing = std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(drawing.contains("<svg") && !drawing.contains("NaN"), "{name}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn bands_folds_and_ends_are_those_of_the_curve() {
    let run = kinecut(&["grazing", &example("06_five_axis_sweep/tool.toml"), "--json"], "");
    let sheet: Value = serde_json::from_slice(&run.stdout).unwrap();
    let number = |v: &Value| v.as_f64().unwrap();
    let all = |v: &Value| v.as_array().unwrap().clone();
    // Folds: as many as the spans say, each a point of a curve with the parameter of its span's end.
    let ends = all(&sheet["spans"]).iter().flat_map(|s| all(&s["folds"])).filter(|f| *f == true).count();
    let folds = all(&sheet["folds"]);
    assert_eq!((folds.len(), ends), (8, 8));
    for fold in &folds {
        let span = &sheet["spans"][fold["span"].as_u64().unwrap() as usize];
        assert!(fold["u"] == span["from"] || fold["u"] == span["to"], "{fold} {span}");
        let on = |p: &Value| p["span"] == fold["span"] && p["point"] == fold["point"];
        assert!(all(&sheet["loops"]).iter().any(|l| all(&l["points"]).iter().any(on)), "{fold}");
    }
    // Areas of the bands that enter: those of the pieces, but for the strips' straight borders.
    for (i, piece) in all(&sheet["pieces"]).iter().enumerate().filter(|(_, p)| p["fan"] == false) {
        let mut area = 0.0;
        for band in all(&sheet["bands"]).iter().filter(|b| b["piece"] == i && !b["enters"].is_null()) {
            let at = |k: usize, j: usize| number(&band["places"][k][j]);
            let slant = (at(1, 0) - at(0, 0)).hypot(at(1, 1) - at(0, 1));
            let wide = |k: usize| number(&band["enters"][k][1]) - number(&band["enters"][k][0]);
            // Simpson over the way of radius and angle, which are straight.
            let part = |t: f64| {
                (at(0, 0) * (1.0 - t) + at(1, 0) * t) * (wide(0) * (1.0 - t) + wide(1) * t).to_radians()
            };
            area += slant * (part(0.0) + 4.0 * part(0.5) + part(1.0)) / 6.0;
        }
        let exact = number(&piece["entering_area"]);
        assert!((area - exact).abs() < 0.005 * number(&piece["area"]) + 1e-9, "{area} {exact} {piece}");
    }
    // Velocities at both ends: v + w x p.
    let v = |k: usize, j: usize| number(&sheet["ends"][k]["velocity"][j]);
    let high = number(&sheet["ends"][1]["z"]);
    assert_eq!((number(&sheet["ends"][0]["z"]), high), (0.0, 54.0));
    let by = 1100f64.to_radians() * high;
    assert!(
        (v(0, 0) - 1200.0).abs() < 1e-9
            && (v(1, 0) - 1200.0 - by).abs() < 1e-9
            && (v(1, 2) + 220.0).abs() < 1e-9
    );
    assert_eq!(sheet["pieces"][1]["outcome"], "one U");
    assert_eq!((number(&sheet["pieces"][1]["radius"]), number(&sheet["pieces"][1]["centre"][0])), (5.0, 5.0));
}
