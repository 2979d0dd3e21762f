//! `kinecut drill` as a shell sees it.

use std::path::Path;

use serde_json::Value;

use crate::shell::{folder, kinecut, text};

fn example() -> String {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/03_drill_through_shaft/figure_7.toml");
    path.display().to_string()
}

#[test]
fn the_papers_example_is_shown_as_printed_and_as_it_is() {
    let run = kinecut(&["drill", &example(), "--paper", "--program"], "");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let shown = text(&run.stdout);
    for number in ["-159.907", "-159.405", "1.485", "2.490", "26.784", "7.091", "35.360", "G1 Z-7.9067 F0.6"]
    {
        assert!(shown.contains(number), "{number}\n{shown}");
    }
    // Nobody knows how high the tool may travel: the program says so, in words that no control reads.
    assert!(shown.contains("Z<SAFE HEIGHT>") && !shown.contains("10000"), "{shown}");
    let plain = text(&kinecut(&["drill", &example()], "").stdout);
    assert!(!plain.contains("1.485") && plain.contains("36.743"), "{plain}");
    let json: Value =
        serde_json::from_slice(&kinecut(&["drill", &example(), "--json", "--paper"], "").stdout).unwrap();
    let hole = &json["holes"][0];
    assert!((hole["coordinates"]["Z_end"].as_f64().unwrap() - -159.906656).abs() < 1e-6);
    assert_eq!(hole["paper"]["printed_times"][0], 1.485);
    assert_eq!(hole["paper"]["printed_lengths"]["L_vyh2"], 0.501);
    assert_eq!(hole["zones"].as_array().unwrap().len(), 3);
    assert!(
        (hole["saved_time"].as_f64().unwrap() - (161.906656 / 0.2 / 397.887358 * 60.0 - 36.743222)).abs()
            < 1e-3
    );
}

#[test]
fn an_array_gives_an_array_and_each_wrong_hole_its_own_error() {
    let hole = |extra: &str| {
        format!(
            r#"{{ "tool": {{ "number": 1, "type": "drill", "diameter": 10, "flute_length": 80 }},
                 "operation": {{ "type": "drill", "tool": 1, "depth": 60, "speed": 900,
                                 "feed_per_rev": {{ "steady": 0.2 }} {extra} }} }}"#
        )
    };
    let inner = |radius: &str| format!(r#", "entry": {{ "surface": "inner-cylinder", "radius": {radius} }}"#);
    let input =
        format!("[{}, {}, {}, {}]", hole(""), hole(&inner("4")), hole(&inner("30")), hole(r#", "depht": 3"#));
    let run = kinecut(&["drill", "--json"], &input);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stdout));
    let items: Vec<Value> = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(items.len(), 4);
    // Shown one by one, and yet as one document.
    let document = text(&run.stdout);
    assert!(document.starts_with("[\n  {\n    \"title\"") && document.ends_with("\n  }\n]\n"), "{document}");
    // A square face and our default feeds.
    assert!((items[0]["holes"][0]["zones"][0]["feed"].as_f64().unwrap() - 0.15).abs() < 1e-12);
    // Wider than the bore it starts in.
    assert_eq!(items[1]["error"]["code"], "KC0902");
    assert_eq!(items[1]["error"]["key"], "hole[1].operation.entry.offset");
    assert!((items[2]["holes"][0]["coordinates"]["Z_nvr2"].as_f64().unwrap() - -33.004303).abs() < 1e-6);
    assert_eq!(items[3]["error"]["code"], "KC0102");
    // As text the good ones still come out.
    let shown = kinecut(&["drill"], &input);
    assert!(text(&shown.stdout).contains("-33.004") && text(&shown.stderr).contains("depht"));
}

#[test]
fn nothing_that_can_be_drilled_is_wrong_input() {
    let input = r#"
        [tool]
        number = 1
        type = "drill"
        diameter = 20
        flute_length = 80
        [operation]
        type = "drill"
        tool = 1
        entry = { surface = "outer-cylinder", radius = 40, offset = 31 }
        exit = "same"
        cutting_speed = 25
        feed_per_rev = { steady = 0.2 }
    "#;
    let run = kinecut(&["drill"], input);
    assert_eq!(run.status.code(), Some(2), "{}", text(&run.stdout));
    let all = text(&run.stderr);
    assert!(all.contains("-:10:69"), "its place in the text: {all}");
    assert!(all.contains("opens sideways") && all.contains("41 mm") && all.contains("40"), "{all}");
    let bore = kinecut(
        &["drill"],
        "[tool]\nnumber = 1\ntype = \"end-mill\"\ndiameter = 4\nflute_length = 9\n[operation]\ntype = \"bore\"\ntool = 1\nat = [0, 0]\ndiameter = 9\ndepth = 3\nstrategy = \"involute\"\nspeed = 900\n",
    );
    assert_eq!(bore.status.code(), Some(2));
    assert!(text(&bore.stderr).contains("kinecut hole"), "{}", text(&bore.stderr));
}

#[test]
fn a_hole_is_placed_on_a_mesh_by_point_and_direction() {
    let folder = folder("mesh");
    // A tetrahedron of 90 mm; its slanted face is drilled square.
    let corners = [[0.0, 0.0, 0.0], [90.0, 0.0, 0.0], [0.0, 90.0, 0.0], [0.0, 0.0, 90.0]];
    let mut stl = String::from("solid t\n");
    for t in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] {
        stl += "facet normal 0 0 0\nouter loop\n";
        for i in t {
            let [x, y, z]: [f64; 3] = corners[i];
            stl += &format!("vertex {x} {y} {z}\n");
        }
        stl += "endloop\nendfacet\n";
    }
    std::fs::write(folder.join("part.stl"), stl + "endsolid t\n").unwrap();
    let case = "part = { mesh = \"part.stl\", at = [30, 30, 30], direction = [-1, -1, -1] }
        tool = { number = 1, type = \"drill\", diameter = 8, flute_length = 90 }
        [operation]
        type = \"drill\"
        tool = 1
        depth = 20
        cutting_speed = 20
        feed_per_rev = { steady = 0.1 }\n";
    let file = folder.join("hole.toml");
    std::fs::write(&file, case).unwrap();
    let file = file.display().to_string();
    let out = folder.join("out").display().to_string();
    let run = kinecut(&["drill", &file, "--json", "--out", &out], "");
    assert_eq!(run.status.code(), Some(0), "{}{}", text(&run.stdout), text(&run.stderr));
    let sheet: Value = serde_json::from_slice(&run.stdout).unwrap();
    let z = &sheet["holes"][0]["coordinates"];
    // The face is square to the direction: the tip first, at the point itself.
    assert!(
        z["Z_nvr1"].as_f64().unwrap() - 2.0 < 1e-5 && z["Z_nvr2"].as_f64().unwrap() - -4.0 / 1.6642795 < 1e-5,
        "{z}"
    );
    assert!(std::fs::read_to_string(Path::new(&out).join("drill.html")).unwrap().contains("<svg"));
    // An open mesh is told, and nothing is written.
    let stl = std::fs::read_to_string(folder.join("part.stl")).unwrap();
    let open =
        stl.replacen("facet", "endsolid t\nsolid u facet", 4).replacen("vertex 90 0 0", "vertex 91 0 0", 1);
    std::fs::write(folder.join("part.stl"), open).unwrap();
    let run = kinecut(&["drill", &file], "");
    assert_eq!(run.status.code(), Some(2), "{}", text(&run.stdout));
    assert!(
        text(&run.stderr).contains("KC0602") || text(&run.stderr).contains("KC0601"),
        "{}",
        text(&run.stderr)
    );
    std::fs::remove_dir_all(folder).unwrap();
}
