//! `kinecut face` as a shell sees it.

use std::path::Path;

use serde_json::Value;

use crate::shell::{kinecut, text};

fn example() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/04_gear_pump_cover/face.toml");
    path.display().to_string()
}

/// A face of 60 x 40 as JSON; `more` are keys of the operation.
fn plate(width: f64, more: &str) -> String {
    format!(
        r#"{{ "tool": {{ "number": 1, "type": "face-mill", "diameter": 80, "teeth": 5, "flute_length": 8 }},
            "operation": {{ "type": "face", "tool": 1, "depth": 0.5, "speed": 800, "feed_per_tooth": 0.1,
                "outline": {{ "loops": [[[0, 0], [{width}, 0], [{width}, 40], [0, 40]]] }} {more} }} }}"#
    )
}

#[test]
fn the_cover_is_placed_with_its_certificate() {
    let run = kinecut(&["face", &example(), "--program"], "");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let shown = text(&run.stdout);
    assert!(shown.contains("Z<SAFE HEIGHT>") && !shown.contains("Z10000"), "{shown}");
    for word in ["117.690", "180.835", "material on its right", "GEAR_BORES", "no allowed placement", "G1 "] {
        assert!(shown.contains(word), "{word}\n{shown}");
    }
    let json: Value = serde_json::from_slice(&kinecut(&["face", &example(), "--json"], "").stdout).unwrap();
    let optimum = &json["optimum"];
    let (value, lower) = (optimum["value"].as_f64().unwrap(), optimum["lower_bound"].as_f64().unwrap());
    // The value with true circles; a polygon with 96 sides a circle has 118.995.
    assert!(
        (value - 117.690).abs() < 1e-3 && lower <= value && value - lower < 2e-6 * 638.2,
        "{value} {lower}"
    );
}

#[test]
fn other_ways_are_planned_when_they_are_asked_for() {
    let ways = |more: &[&str]| {
        let run = kinecut(&[&["face", "-", "--json"], more].concat(), &plate(60.0, ""));
        let json: Value = serde_json::from_slice(&run.stdout).unwrap();
        let chosen = json["ways"][json["chosen"].as_u64().unwrap() as usize].clone();
        (json["ways"].as_array().unwrap().len(), chosen["bad"].clone(), chosen["path"].clone())
    };
    let (one, all) = (ways(&[]), ways(&["--compare"]));
    assert_eq!((one.0, &one.1, &one.2), (1, &all.1, &all.2));
    assert!(all.0 > 3, "{}", all.0);
    assert!(text(&kinecut(&["face", "-"], &plate(60.0, "")).stdout).contains("--compare"));
    // A run too plans them when they are asked for.
    let folder = crate::shell::folder("ways");
    let job = crate::shell::example("04_gear_pump_cover/job.toml");
    let planned = |more: &[&str]| {
        let run = kinecut(&[&["run", &job, "--out", &folder.display().to_string()], more].concat(), "");
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
        let plan = std::fs::read(folder.join("plan.json")).unwrap();
        let plan: Value = serde_json::from_slice(&plan).unwrap();
        plan["setups"][0]["faces"][0]["plan"]["ways"].as_array().unwrap().len()
    };
    let (one, all) = (planned(&[]), planned(&["--compare"]));
    assert!(one == 1 && all > 3, "{one} {all}");
    std::fs::remove_dir_all(folder).unwrap();
    // Which way is best is known after all were planned.
    let best = kinecut(&["face", "-", "--json"], &plate(60.0, ", \"passes\": \"fastest\""));
    let json: Value = serde_json::from_slice(&best.stdout).unwrap();
    assert!(json["ways"].as_array().unwrap().len() > 3);
}

#[test]
fn an_array_gives_an_array_and_a_wrong_item_does_not_stop_the_rest() {
    let input = format!("[{}, {}, {}]", plate(60.0, ""), plate(200.0, ""), plate(60.0, r#", "feed": 1"#));
    let run = kinecut(&["face", "-", "--json"], &input);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    let json: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert!(json[0]["optimum"]["value"].as_f64().unwrap() > 0.0);
    let too_wide = json[1]["error"].as_object();
    // 200 x 40 fits under a cutter of 80 lengthwise.
    assert!(too_wide.is_none(), "{too_wide:?}");
    assert_eq!(json[2]["error"]["code"], "KC0102");
}

#[test]
fn real_teeth_are_listed_and_the_papers_way_is_shown() {
    let input = plate(60.0, r#", "guard": 0"#);
    let events = kinecut(&["face", "-", "--json", "--events"], &input);
    let json: Value = serde_json::from_slice(&events.stdout).unwrap();
    let list = json["events"].as_array().unwrap();
    let exits = list.iter().filter(|e| e["exit"].as_bool().unwrap()).count();
    // Each tooth that enters leaves again.
    assert!(list.len() > 1000 && 2 * exits == list.len(), "{} {exits}", list.len());
    // The text lists the same crossings, each on a line of its own.
    let shown = text(&kinecut(&["face", "-", "--events"], &input).stdout);
    let lines = shown.lines().filter_map(|l| {
        let words: Vec<&str> = l.split_whitespace().collect();
        let at = words.iter().position(|w| ["exit", "entry"].contains(w) && words.len() > 6)?;
        let number = |i: usize| words.get(i).and_then(|w| w.parse::<f64>().ok());
        Some((number(0)?, number(1)?, number(2)?, number(3)?, words[at] == "exit", number(at + 2)?))
    });
    let lines: Vec<_> = lines.collect();
    assert_eq!(lines.len(), list.len(), "{shown}");
    for (event, (tooth, edge, x, y, exit, angle)) in list.iter().zip(lines) {
        assert_eq!((event["tooth"].as_f64(), event["edge"].as_f64()), (Some(tooth), Some(edge)));
        assert_eq!(event["exit"].as_bool(), Some(exit));
        // On the border of the plate as given.
        let [dx, dy] = [x.min(60.0 - x), y.min(40.0 - y)];
        assert!(dx > -1e-3 && dy > -1e-3 && dx.min(dy) < 1e-3, "{x} {y}");
        assert!(!exit || (event["exit_angle"].as_f64().unwrap() - angle).abs() < 0.006, "{event} {angle}");
    }
    assert!(!text(&kinecut(&["face", "-"], &input).stdout).contains("tooth by tooth"));
    let paper = kinecut(&["face", "-", "--paper"], &input);
    assert_eq!(paper.status.code(), Some(0));
    assert!(text(&paper.stdout).contains("Nelder"), "{}", text(&paper.stdout));
}

#[test]
fn a_part_wider_than_the_cutter_says_which_passes_it_needs() {
    let input = plate(120.0, "").replace("40]", "110]");
    let one = input.replace("\"depth\": 0.5", "\"depth\": 0.5, \"passes\": \"one\"");
    let run = kinecut(&["face", "-"], &one);
    assert_eq!(run.status.code(), Some(2));
    let error = text(&run.stderr);
    assert!(error.contains("KC1002") && error.contains("mill it in 2 passes"), "{error}");
    // Where nothing is said, it is milled in them.
    let fewest = kinecut(&["face", "-"], &input);
    assert_eq!(fewest.status.code(), Some(0), "{}", text(&fewest.stderr));
    let rows = input.replace("\"depth\": 0.5", "\"depth\": 0.5, \"passes\": { \"rows\": 2 }");
    let run = kinecut(&["face", "-"], &rows);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
}

#[test]
fn top_needs_a_job_and_other_operations_their_own_verb() {
    let top = r#"{ "tool": { "number": 1, "type": "face-mill", "diameter": 80, "flute_length": 8 },
        "operation": { "type": "face", "tool": 1, "depth": 1, "speed": 800, "feed": 500, "outline": "top" } }"#;
    let run = kinecut(&["face", "-"], top);
    assert_eq!(run.status.code(), Some(2));
    assert!(text(&run.stderr).contains("run the operation as a job"), "{}", text(&run.stderr));
    let run = kinecut(&["hole", "-"], &plate(60.0, ""));
    assert!(text(&run.stderr).contains("kinecut face"), "{}", text(&run.stderr));
}
