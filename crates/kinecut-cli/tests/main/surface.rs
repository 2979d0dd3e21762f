//! `kinecut surface` as a shell sees it.

use serde_json::Value;

use crate::shell::{folder, kinecut, text};

fn json(args: &[&str], input: &str) -> Value {
    let run = kinecut(args, input);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    serde_json::from_slice(&run.stdout).unwrap()
}

#[test]
fn the_cone_of_the_paper() {
    let run = kinecut(&["surface", "cone"], "");
    let shown = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    for part in [
        "r0 = A6(phi) A1(R) A5(-alpha) A3(z) e4",
        "r0 = ((R - z*sin(alpha))*cos(phi), (R - z*sin(alpha))*sin(phi), z*cos(alpha))",
        "Primary code 6153",
        "5 redistributions between machine and tool, 5 with a rigid tool",
        "Layouts with the bed 5",
        "surface of revolution",
        "615 | 3 Tool is",
        "+1 (setting link), free, margin 0.9394",
        "v(B1)s(P2)",
        "copying",
    ] {
        let words = shown.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(part), "{part}\n{shown}");
    }
    let sheet = json(&["surface", "cone", "--json", "--set", "R=40", "--set", "alpha=20*pi/180"], "");
    assert_eq!((sheet["parameters"]["R"].as_f64(), sheet["code"].as_str()), (Some(40.0), Some("6153")));
    assert!((sheet["parameters"]["alpha"].as_f64().unwrap() - 20f64.to_radians()).abs() < 1e-15);
    let splits = sheet["splits"].as_array().unwrap();
    let codes: Vec<(&str, &str)> = splits
        .iter()
        .map(|s| (s["machine_code"].as_str().unwrap(), s["tool_code"].as_str().unwrap()))
        .collect();
    for pair in [("6153", ""), ("615", "3"), ("61", "53"), ("6", "153"), ("", "6153")] {
        assert!(codes.contains(&pair), "{pair:?} {codes:?}");
    }
    // The margin of the die along its axis is the sine of the cone's angle.
    let die = splits.iter().find(|s| s["machine_code"] == "").unwrap();
    assert_eq!(die["setup"]["motion"], "+3");
    assert!((die["setup"]["margin"].as_f64().unwrap() - 20f64.to_radians().sin()).abs() < 1e-9, "{die}");
}

#[test]
fn an_apex_within_the_domain_is_a_warning() {
    let run = kinecut(&["surface", "cone", "--set", "R=10", "--json"], "");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let sheet: Value = serde_json::from_slice(&run.stdout).unwrap();
    let found = sheet["findings"].as_array().unwrap();
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0]["code"], "KC1108");
    // The apex is R / sin(alpha) along the generatrix.
    let message = found[0]["message"].as_str().unwrap();
    assert!(message.ends_with(&format!("z = {:.6}", 10.0 / 0.35_f64.sin())), "{message}");
    assert!(json(&["surface", "cone", "--json"], "")["findings"].is_null());
}

#[test]
fn the_catalogue_is_listed_and_all_of_it_can_be_shown() {
    let list = json(&["surface", "--json"], "");
    let names: Vec<&str> = list.as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap()).collect();
    assert!(names.len() >= 18 && names.contains(&"cylinder"), "{names:?}");
    let sheet = json(&["surface", "cylinder", "--json"], "");
    assert_eq!(sheet["splits"].as_array().unwrap().len(), 6);
    assert_eq!((sheet["layouts"].as_u64(), sheet["form"].as_str()), (Some(12), Some("circular cylinder")));
}

#[test]
fn a_lathe_is_asked_for_a_cone_and_a_thread() {
    let svg = std::env::temp_dir().join(format!("kinecut-surface-{}.svg", std::process::id()));
    let path = svg.display().to_string();
    let answer = json(&["surface", "cone", "--machine", "lathe_xzc", "--svg", &path, "--json"], "");
    let splits = answer["on_machine"]["splits"].as_array().unwrap();
    let of = |code: &str| splits.iter().find(|s| s["machine_code"] == code).unwrap();
    assert_eq!(of("6153")["possible"], true);
    assert!(of("6153")["residual"]["greatest_um"].as_f64().unwrap().abs() < 1e-3);
    // X follows Z by the tangent of the cone's angle, 0.35 rad.
    let laws = of("6153")["laws"].to_string();
    assert!(laws.contains("X follows Z, -0.365028 mm/mm"), "{laws}");
    // A hollow mill is held as the lathe needs it: its axis along the work, not across as the turret points.
    assert_eq!(of("6")["possible"], true);
    assert!(of("6")["laws"].to_string().contains("the edge is set in the tool turned by"), "{}", of("6"));
    let drawn = std::fs::read_to_string(&svg).unwrap();
    assert!(drawn.starts_with("<svg") && drawn.contains("machine 6153") && drawn.contains("tool 6153"));
    std::fs::remove_file(svg).unwrap();
    // A knee mill cannot turn the work: no redistribution with a moving machine is possible.
    let mill = kinecut(&["surface", "cone", "--machine", "mill3_xyz"], "");
    assert!(text(&mill.stdout).contains("lacks"), "{}", text(&mill.stdout));
}

#[test]
fn a_place_and_the_sketches_come_as_numbers() {
    let told = json(&["surface", "cone", "--at", "phi=1", "--at", "z=20", "--sketch", "--json"], "");
    let point = [12.5036996551, 19.4733584297, 18.7874542569];
    for (i, wanted) in point.into_iter().enumerate() {
        assert!((told["place"]["point"][i].as_f64().unwrap() - wanted).abs() < 1e-9);
    }
    let digits: Vec<u64> =
        told["place"]["motions"].as_array().unwrap().iter().map(|m| m["digit"].as_u64().unwrap()).collect();
    assert_eq!(digits, [6, 1, 5, 3]);
    let lines: Vec<&str> =
        told["place"]["lines"].as_array().unwrap().iter().map(|l| l["line"].as_str().unwrap()).collect();
    assert_eq!(lines, ["directrix", "generatrix"]);
    let splits = told["sketch"]["splits"].as_array().unwrap();
    let tools: Vec<&str> = splits.iter().map(|s| s["tool"].as_str().unwrap()).collect();
    assert_eq!(tools, ["point", "edge", "edge", "edge", "surface"]);
    // The point of the point tool is the place; the edge goes through it.
    assert_eq!(splits[0]["points"][0], told["place"]["point"]);
    // Every corner of the mesh is on the cone: its distance from the axis falls by the tangent of the angle.
    for p in told["sketch"]["mesh"].as_array().unwrap().iter().flat_map(|row| row.as_array().unwrap()) {
        let [x, y, z] = [0, 1, 2].map(|i| p[i].as_f64().unwrap());
        assert!((x.hypot(y) - (30.0 - z * 0.35f64.tan())).abs() < 1e-9);
    }
    let wrong = kinecut(&["surface", "cone", "--at", "z=70"], "");
    assert!(
        wrong.status.code() == Some(2) && text(&wrong.stderr).contains("0 to 50"),
        "{}",
        text(&wrong.stderr)
    );
}

/// A thread of its own: a groove of a rounded profile on a screw.
const GROOVE: &str = r#"title = "rounded groove"
parameters = { p = "6/(2*pi)", R = 20, r = 3 }
variables = [{ name = "phi", from = 0, to = "4*pi" }, { name = "t", from = -0.5, to = 0.5 }]
directrix = "6(phi) 3(p*phi)"
generatrix = "1(R - r*cos(t)) 3(r*sin(t))"
"#;

#[test]
fn a_surface_of_ones_own_comes_from_a_file() {
    let sheet = json(&["surface", "-", "--json"], GROOVE);
    assert_eq!((sheet["code"].as_str(), sheet["form"].as_str()), (Some("6313"), Some("screw surface")));
    assert!(sheet["slides"][0].as_str().unwrap().contains('6'), "{}", sheet["slides"]);
    let as_json = r#"{ "like": "sphere", "parameters": { "R": 12 } }"#;
    assert_eq!(json(&["surface", "-", "--json"], as_json)["parameters"]["R"].as_f64(), Some(12.0));
    let listed = GROOVE.replace("\"6(phi) 3(p*phi)\"", "[[6, \"phi\"], [3, \"p*phi\"]]");
    assert_eq!(json(&["surface", "-", "--json"], &listed)["chain"], sheet["chain"]);
}

#[test]
fn faces_of_a_mesh_are_named() {
    let file = std::env::temp_dir().join(format!("kinecut-surface-{}.stl", std::process::id()));
    // A cylinder of radius 10 and height 30 with 48 facets around, in text form.
    let mut stl = String::from("solid c\n");
    let corner = |i: usize, z: f64| {
        let (s, c) = (std::f64::consts::TAU * (i % 48) as f64 / 48.0).sin_cos();
        format!("vertex {} {} {z}\n", 10.0 * c, 10.0 * s)
    };
    let mut facet = |a: String, b: String, c: String| {
        stl += &format!("facet normal 0 0 0\nouter loop\n{a}{b}{c}endloop\nendfacet\n");
    };
    let middle = |z: f64| format!("vertex 0 0 {z}\n");
    for i in 0..48 {
        for z in [0.0, 10.0, 20.0] {
            facet(corner(i, z), corner(i + 1, z), corner(i + 1, z + 10.0));
            facet(corner(i, z), corner(i + 1, z + 10.0), corner(i, z + 10.0));
        }
        facet(middle(30.0), corner(i, 30.0), corner(i + 1, 30.0));
        facet(middle(0.0), corner(i + 1, 0.0), corner(i, 0.0));
    }
    stl += "endsolid c\n";
    std::fs::write(&file, stl).unwrap();
    let sheet = json(&["surface", &file.display().to_string(), "--json"], "");
    let forms: Vec<&str> =
        sheet["faces"].as_array().unwrap().iter().map(|f| f["form"].as_str().unwrap()).collect();
    assert_eq!(forms, ["circular cylinder", "plane", "plane"], "{sheet:#}");
    assert!(sheet["faces"][0]["shape"].as_str().unwrap().contains("radius"), "{sheet:#}");
    std::fs::remove_file(file).unwrap();
    let missing = kinecut(&["surface", "none.stl"], "");
    assert!(missing.status.code() == Some(2) && text(&missing.stderr).contains("KC0001"));
}

#[test]
fn wrong_surfaces_exit_2_with_their_place() {
    let cases: &[(&str, &str, &str, u32)] = &[
        ("6(phi) 3", "6(phi) q", "no motion", 4),
        ("1(R - r*cos(t))", "1(R - r*cos(t)", "does not close", 5),
        ("1(R - r*cos(t))", "1(R - r*cs(t))", "KC1101", 5),
        ("1(R - r*cos(t))", "1(Q - r*cos(t))", "`Q`", 0),
        ("\"6/(2*pi)\"", "\"6/(2*q)\"", "KC1102", 2),
        ("from = -0.5", "from = 1", "empty domain", 0),
        (", { name = \"t\", from = -0.5, to = 0.5 }", "", "two", 3),
        ("directrix", "directrx", "unknown field", 4),
        ("directrix = \"6(phi) 3(p*phi)\"", "", "no lines or variables", 0),
    ];
    for (from, to, part, line) in cases {
        assert!(GROOVE.contains(from), "{from}");
        let run = kinecut(&["surface", "-"], &GROOVE.replacen(from, to, 1));
        let message = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{to}: {message}");
        assert!(message.contains(part), "{to}: {message}");
        if *line > 0 {
            assert!(message.contains(&format!(":{line}:")), "{to}: {message}");
        }
    }
    let run = kinecut(&["surface", "kone"], "");
    assert!(run.status.code() == Some(2) && text(&run.stderr).contains("`cone`"), "{}", text(&run.stderr));
    let run = kinecut(&["surface", "cone", "--set", "S=3"], "");
    assert!(run.status.code() == Some(2) && text(&run.stderr).contains("`S`"), "{}", text(&run.stderr));
}

#[test]
fn the_surfaces_of_the_example_on_a_lathe() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/05_machine_from_code");
    let row = |name: &str, tool: &str| {
        let file = format!("{folder}/{name}.toml");
        let sheet = json(&["surface", &file, "--machine", "lathe_xzc", "--json"], "");
        let rows = sheet["on_machine"]["splits"].as_array().unwrap().clone();
        rows.into_iter().find(|r| r["tool_code"] == tool).unwrap_or_else(|| panic!("{name}: {sheet}"))
    };
    let laws =
        |row: &Value| row["laws"].as_array().unwrap().iter().map(|l| l.to_string()).collect::<String>();
    let thread = row("thread", "");
    assert!(thread["possible"] == true && laws(&thread).contains("Z follows C, 3 mm/rev"), "{thread}");
    // A threading insert is clamped as the lathe needs it.
    for tool in ["1", "51", "151"] {
        let thread = row("thread", tool);
        assert!(thread["possible"] == true && laws(&thread).contains("3 mm/rev"), "{thread}");
    }
    let cone = row("cone", "");
    assert!(cone["possible"] == true, "{cone}");
    // The flank of a gear needs a Y axis.
    let flank = row("gear_flank", "3");
    assert!(
        flank["possible"] == false && flank["obstacle"].to_string().contains("lacks a motion"),
        "{flank}"
    );
}

#[test]
fn a_machine_proves_what_it_makes() {
    let answer = json(
        &[
            "surface",
            "cylinder",
            "--machine",
            "lathe_xzc",
            "--json",
            "--errors",
            "4,0",
            "--error-of",
            "x=10,0",
        ],
        "",
    );
    let made = &answer["on_machine"];
    let turning = made["splits"].as_array().unwrap().iter().find(|s| s["machine_code"] == "613").unwrap();
    assert_eq!(turning["coverage"]["share"], 1.0);
    // Without turns of the guides each axis moves the surface by its own figure: 10 um of X, 4 um of Z and of C's bearing.
    let budget = &turning["budget"];
    let axis = |letter: &str| {
        budget["axes"].as_array().unwrap().iter().find(|a| a["axis"] == letter).unwrap().clone()
    };
    assert_eq!(axis("X")["position_um"], 10.0);
    assert_eq!(
        (axis("Z")["position_um"].as_f64(), axis("C")["position_um"].as_f64()),
        (Some(0.0), Some(0.0))
    );
    let independent = budget["independent_um"].as_f64().unwrap();
    assert!((independent - (100.0f64 + 16.0 + 16.0).sqrt()).abs() < 1e-4, "{independent}");
    // The lathe's tool points across, so its wheel cannot stand along the work; on a rotary table it can, and leaves nothing
    // and takes nothing too much.
    assert_eq!(made["envelopes"][0]["possible"], false);
    let answer =
        json(&["surface", "cylinder", "--machine", "trt_xyzac", "--verify", "touching", "--json"], "");
    let grinding = &answer["on_machine"]["envelopes"][0];
    assert_eq!((&grinding["method"], &grinding["possible"]), (&"touching".into(), &true.into()));
    assert!(grinding["residual"]["least_um"].as_f64().unwrap() > -1e-3);
    assert!(grinding["residual"]["greatest_um"].as_f64().unwrap() < 1e-3);
    assert_eq!(grinding["coverage"]["share"], 1.0);

    // In a bore the wheel of 8 mm stands inside; in one of 5 mm it takes too much.
    let bore = |radius: &str| {
        let set = format!("R={radius}");
        json(
            &[
                "surface",
                "cylinder",
                "--reversed",
                "--set",
                &set,
                "--machine",
                "trt_xyzac",
                "--verify",
                "touching",
                "--json",
            ],
            "",
        )["on_machine"]["envelopes"][0]["residual"]["least_um"]
            .as_f64()
            .unwrap()
    };
    assert!(bore("20") > -1e-3, "{}", bore("20"));
    assert!((bore("5") + 6000.0).abs() < 1.0, "{}", bore("5"));
}

#[test]
fn the_nearest_machines_are_told_with_their_measure() {
    let out =
        kinecut(&["surface", "cylinder", "--machine", "mill3_xyz", "--verify", "61", "--alternatives"], "");
    let told = text(&out.stdout).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(told.contains("could, 1 change: with a rotation C"), "{told}");
    assert!(told.contains("6690 layouts of two to five axes"), "{told}");
}

#[test]
fn a_page_holds_the_formulas_the_sketches_and_the_answer() {
    let folder = folder("page");
    let out = folder.display().to_string();
    let run = kinecut(&["surface", "cone", "--machine", "lathe_xzc", "--out", &out], "");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let page = std::fs::read_to_string(folder.join("surface.html")).unwrap();
    assert!(
        page.starts_with("<!DOCTYPE html>") && page.contains("<math>") && page.contains("Errors of the axes")
    );
    assert_eq!(page.matches("role=\"img\"").count(), 5);
    for outside in ["http:", "https:", "<link", "<script src", "@import", "url("] {
        let allowed = "http://www.w3.org/";
        assert!(!page.replace(allowed, "").contains(outside), "{outside}");
    }
    let run = kinecut(&["layouts", "2103", "--out", &out, "--show", "6"], "");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let page = std::fs::read_to_string(folder.join("layouts.html")).unwrap();
    assert_eq!(page.matches("role=\"img\"").count(), 6);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_wrong_question_to_a_machine_is_refused_with_what_it_could_be() {
    for (arguments, told) in [
        (vec!["--verify", "77"], "it has 6153|-"),
        (vec!["--tolerance", "NaN"], "must be a number"),
        (vec!["--tolerance=-1"], "must be a number"),
        (vec!["--errors", "NaN,1"], "must be a number"),
        (vec!["--error-of", "B=1,1"], "its axes are C, Z, X"),
        (vec!["--length", "inf"], "must be a number"),
        (vec!["--set", "R=0/0"], ""),
        (vec!["--set", "alfa=1"], "its parameters are"),
    ] {
        let mut all = vec!["surface", "cone", "--machine", "lathe_xzc"];
        all.extend(&arguments);
        let out = kinecut(&all, "");
        assert_eq!(out.status.code(), Some(2), "{arguments:?}");
        assert!(text(&out.stderr).contains(told), "{arguments:?}: {}", text(&out.stderr));
    }
    let out = kinecut(&["surface", "cone", "--machine", "no-such-machine"], "");
    assert_eq!(out.status.code(), Some(2));
}

/// One band of quads: both rings lie on a sphere too.
#[test]
fn a_wall_of_quads_is_a_cylinder() {
    let point = |i: usize, z: f64| {
        let angle = std::f64::consts::TAU * i as f64 / 48.0;
        [10.0 * angle.cos(), 10.0 * angle.sin(), z]
    };
    let mut stl = String::from("solid wall\n");
    for i in 0..48 {
        let quad = [point(i, 0.0), point(i + 1, 0.0), point(i + 1, 30.0), point(i, 30.0)];
        for triangle in [[0, 1, 2], [0, 2, 3]] {
            stl += "facet normal 0 0 0\nouter loop\n";
            for corner in triangle {
                let [x, y, z] = quad[corner];
                stl += &format!("vertex {x} {y} {z}\n");
            }
            stl += "endloop\nendfacet\n";
        }
    }
    stl += "endsolid wall\n";
    let file = std::env::temp_dir().join(format!("kinecut-wall-{}.stl", std::process::id()));
    std::fs::write(&file, stl).unwrap();
    let sheet = json(&["surface", &file.display().to_string(), "--json"], "");
    std::fs::remove_file(file).unwrap();
    assert_eq!(sheet["faces"].as_array().unwrap().len(), 1);
    assert_eq!(sheet["faces"][0]["form"], "circular cylinder");
    assert!(sheet["faces"][0]["shape"].as_str().unwrap().contains("10"), "{}", sheet["faces"][0]["shape"]);
}
