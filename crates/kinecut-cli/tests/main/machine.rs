//! `kinecut machine`, `fk`, `ik`, `reach` and `layouts` as a shell sees them.

use serde_json::Value;

use crate::shell::{folder, kinecut, text};

fn json(args: &[&str], input: &str) -> (Option<i32>, Value) {
    let run = kinecut(args, input);
    let value = serde_json::from_slice(&run.stdout);
    (run.status.code(), value.unwrap_or_else(|e| panic!("{e}: {}{}", text(&run.stdout), text(&run.stderr))))
}

fn near(value: &Value, wanted: f64) -> bool {
    (value.as_f64().unwrap() - wanted).abs() < 1e-9
}

#[test]
fn a_machine_is_shown_listed_written_and_read_again() {
    let folder = folder("show");
    let list = text(&kinecut(&["machine"], "").stdout);
    assert!(list.contains("trt_xyzac") && list.contains("641203") && list.lines().count() >= 14, "{list}");
    let shown = text(&kinecut(&["machine", "trt_xyzac"], "").stdout);
    assert!(shown.contains("w C' A' X' Y' b Z (C1) t") && shown.contains("0 20 10"), "{shown}");
    let file = folder.join("m.toml").display().to_string();
    std::fs::write(&file, kinecut(&["machine", "nut_head_c_b45", "--toml"], "").stdout).unwrap();
    let (code, machine) = json(&["machine", &file, "--json"], "");
    assert_eq!((code, machine["code"].as_str()), (Some(0), Some("012367")));
    assert_eq!(
        (machine["axes"][4]["axis"].as_str(), machine["axes"][4]["digit"].as_u64()),
        (Some("B"), Some(7))
    );
    assert!(
        near(&machine["axes"][4]["direction"][2], 0.5f64.sqrt())
            && near(&machine["axes"][4]["travel"][0], -185.0)
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn flags_about_a_machine_are_not_passed_over() {
    for (args, key) in [
        (&["machine", "--at", "X1"][..], "--at"),
        (&["machine", "--bodies", "--json"], "--bodies"),
        (&["machine", "--toml"], "--toml"),
        (&["machine", "--spindle", "vertical"], "--spindle"),
        (&["machine", "trt_xyzac", "--stroke", "600,500,500"], "--stroke"),
    ] {
        let run = kinecut(args, "");
        let error = text(&run.stderr) + &text(&run.stdout);
        assert_eq!(run.status.code(), Some(2), "{args:?}: {error}");
        assert!(error.contains(key) && error.contains("help"), "{args:?}: {error}");
    }
}

#[test]
fn wrong_machines_exit_2_with_place_or_names() {
    let folder = folder("wrong");
    let unknown = kinecut(&["machine", "trt_xyzak"], "");
    let message = text(&unknown.stderr);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(message.contains("KC1117") && message.contains("trt_xyzac"), "{message}");
    let file = folder.join("m.toml").display().to_string();
    std::fs::write(&file, "code = \"641203\"\n\n[axis.A]\ndirection = [0, 0, 0]\n").unwrap();
    let wrong = kinecut(&["fk", &file, "--at", "X1"], "");
    let message = text(&wrong.stderr);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(message.contains("KC0703") && message.contains("m.toml:4:"), "{message}");
    let missing = kinecut(&["machine", &folder.join("none.toml").display().to_string()], "");
    assert!(missing.status.code() == Some(2) && text(&missing.stderr).contains("KC0001"));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_configuration_of_linuxcnc_is_a_machine_and_every_line_is_told() {
    let folder = folder("cnc");
    let ini = "[EMC]\nMACHINE = my mill\n[KINS]\nKINEMATICS = xyzac-trt-kins\n[HAL]\nHALFILE = LIB:sim.tcl\n\
               HALFILE = m.hal\n[TRAJ]\nCOORDINATES = XYZAC\nLINEAR_UNITS = inch\n[JOINT_3]\nMIN_LIMIT = -100\n\
               MAX_LIMIT = 50\nMAX_VELOCITY = 30\nMAX_ACCELERATION = 300\n";
    std::fs::write(folder.join("m.ini"), ini).unwrap();
    std::fs::write(folder.join("m.hal"), "setp xyzac-trt-kins.y-offset 2\nloadrt motmod\n").unwrap();
    let file = folder.join("m.ini").display().to_string();
    let shown = kinecut(&["machine", &file], "");
    let out = text(&shown.stdout);
    assert_eq!(shown.status.code(), Some(0), "{}", text(&shown.stderr));
    for part in [
        "0 50.8 0",
        "against ISO 841",
        "used m.hal:1: setp xyzac-trt-kins.y-offset 2",
        "ignored m.hal:2: loadrt motmod",
        "missing HAL pin xyzac-trt-kins.z-offset: 0",
        "[JOINT_3]MIN_LIMIT = -100",
    ] {
        let out: Vec<&str> = out.split_whitespace().collect();
        assert!(out.join(" ").contains(part), "{part}\n{out:?}");
    }
    let (code, fk) = json(&["fk", &file, "--at", "A90", "--json"], "");
    // The module counts against ISO 841: A 90 turns the work by +90 about the line y = 50.8, z = 0.
    assert_eq!(code, Some(1)); // 90 is beyond 50
    assert!(near(&fk["tip"][1], 50.8) && near(&fk["tip"][2], 50.8), "{fk}");
    std::fs::write(folder.join("max.ini"), "[KINS]\nKINEMATICS = maxkins\n").unwrap();
    let refused = kinecut(&["machine", &folder.join("max.ini").display().to_string()], "");
    let message = text(&refused.stderr);
    assert!(
        refused.status.code() == Some(2) && message.contains("KC1141") && message.contains("max.ini:2:"),
        "{message}"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn forward_and_back_over_pipes_with_an_error_in_its_place() {
    let poses = "X10 Y-20 Z30 A-40 C70\nX1 Q2\n\n; a comment\nX0 Y0 Z0\n";
    let (code, list) = json(&["fk", "trt_xyzac", "-", "--json"], poses);
    assert_eq!((code, list.as_array().unwrap().len()), (Some(1), 3));
    assert_eq!(list[1]["error"]["code"], "KC0703");
    assert_eq!(list[1]["error"]["place"]["line"], 2);
    let back = serde_json::json!({ "tip": list[0]["tip"], "axis": list[0]["axis"] }).to_string();
    let (code, found) = json(&["ik", "trt_xyzac", "--json"], &back);
    assert_eq!(code, Some(0));
    let solutions = found["solutions"].as_array().unwrap();
    assert!(
        solutions.iter().any(|s| {
            [("X", 10.0), ("Y", -20.0), ("Z", 30.0), ("A", -40.0), ("C", 70.0)]
                .iter()
                .all(|(axis, v)| near(&s["joints"][*axis], *v))
        }),
        "{found:#}"
    );
    assert_eq!(solutions.len(), 2);
    // The other solution has A 40 and C -110.
    assert!(solutions.iter().any(|s| near(&s["joints"]["A"], 40.0) && near(&s["joints"]["C"], -110.0)));
}

#[test]
fn unreachable_directions_say_by_how_much() {
    let run = kinecut(&["ik", "nut_head_c_b45", "--at", "X0 Y0 Z0 K-1", "--json"], "");
    let error: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!((run.status.code(), error["code"].as_str()), (Some(2), Some("KC1111")), "{error}");
    assert!(error["message"].as_str().unwrap().contains("90"), "{error}");
    let (code, sheet) =
        json(&["reach", "nut_head_c_b45", "--direction", "0,-1,1", "--direction", "0,0,-1", "--json"], "");
    assert_eq!(code, Some(1));
    assert!(near(&sheet["tilt_deg"][0], 0.0) && near(&sheet["tilt_deg"][1], 90.0), "{sheet}");
    assert_eq!(
        (sheet["directions"][0]["reached"].as_bool(), sheet["directions"][1]["reached"].as_bool()),
        (Some(true), Some(false))
    );
    assert!(near(&sheet["directions"][1]["outside_deg"], 90.0), "{sheet}");
    let (_, trunnion) = json(&["reach", "trt_xyzac", "--json"], "");
    assert!((trunnion["cover_sphere"].as_f64().unwrap() - 0.587).abs() < 1e-3, "{trunnion}");
    let locked = kinecut(&["ik", "six_axis_trsrn", "--at", "X1 Y2 Z3 J-0.1 K1", "--lock", "A5"], "");
    assert!(
        locked.status.code() == Some(0) && text(&locked.stdout).contains("A5 "),
        "{}",
        text(&locked.stderr)
    );
    let open = kinecut(&["ik", "six_axis_trsrn", "--at", "X1 Y2 Z3 J-0.1 K1"], "");
    assert!(text(&open.stderr).contains("KC1113"), "{}", text(&open.stderr));
}

#[test]
fn a_path_starts_where_it_need_not_unwind() {
    // Three turns at a tilt, for which C must start at one end of its travel.
    let mut poses = String::new();
    for i in 0..=216 {
        let (s, c) = (90.0 + f64::from(i) * 5.0).to_radians().sin_cos();
        poses += &format!("X0 Y0 Z0 I{} J{} K{}\n", 0.48 * c, 0.48 * s, 0.8773);
    }
    let folder = folder("path");
    let machine = |limit: &str| {
        let file = folder.join(format!("m{limit}.toml")).display().to_string();
        std::fs::write(
            &file,
            format!("code = \"641203\"\ntravel = {{ C = [-{limit}, {limit}], A = [-90, 90] }}\n"),
        )
        .unwrap();
        file
    };
    let (code, sheet) = json(&["ik", &machine("541"), "-", "--path", "--json"], &poses);
    assert_eq!((code, sheet["retracts"].as_array().unwrap().len()), (Some(0), 0));
    let c = |i: usize| sheet["joints"][i]["C"].as_f64().unwrap();
    assert!(((c(216) - c(0)).abs() - 1080.0).abs() < 1e-6);
    assert!((0..216).all(|i| (c(i + 1) - c(i)).abs() < 5.1 && c(i).abs() <= 541.0));
    let (code, tight) = json(&["ik", &machine("360"), "-", "--path", "--json"], &poses);
    assert_eq!((code, tight["retracts"].as_array().unwrap().len()), (Some(1), 1), "{}", tight["retracts"]);
    let refused = kinecut(&["ik", &machine("360"), "-", "--path", "--no-retract"], &poses);
    assert!(
        refused.status.code() == Some(2) && text(&refused.stderr).contains("KC1116"),
        "{}",
        text(&refused.stderr)
    );
    let words = kinecut(&["ik", &machine("541"), "-", "--path"], &poses).stdout;
    let back = kinecut(&["fk", &machine("541"), "-", "--json"], &text(&words));
    let back: Value = serde_json::from_slice(&back.stdout).unwrap();
    assert_eq!(back.as_array().unwrap().len(), 217);
    assert!((back[216]["axis"][1].as_f64().unwrap() - 0.48).abs() < 1e-4, "{}", back[216]);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_lathe_follows_the_tip() {
    let (code, found) = json(&["ik", "lathe_xzc", "--at", "X0 Y20 Z5", "--json"], "");
    assert_eq!(code, Some(0));
    let within: Vec<&Value> =
        found["solutions"].as_array().unwrap().iter().filter(|s| near(&s["joints"]["X"], 20.0)).collect();
    assert!(
        within.len() == 1 && near(&within[0]["joints"]["C"], 90.0) && near(&within[0]["joints"]["Z"], 5.0),
        "{found}"
    );
}

#[test]
fn wrong_poses_exit_2() {
    for (input, part) in [
        ("X1 Y", "no number"),
        ("X1 X2", "given twice"),
        ("1X", "no letter"),
        ("", "no pose"),
        ("[{\"XX\": 1}]", "no letter"),
        ("{\"X\": \"1\"}", "no number"),
        ("{\"tip\": [1, 2]}", "three numbers"),
        ("[1, 2]", "object"),
        ("{", "no JSON"),
    ] {
        let run = kinecut(&["fk", "mill3_xyz"], input);
        let message = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{input}: {message}");
        assert!(message.contains(part), "{input}: {message}");
    }
    let zero = kinecut(&["ik", "trt_xyzac", "--at", "I0 J0 K0"], "");
    assert!(zero.status.code() == Some(2) && text(&zero.stderr).contains("KC1114"), "{}", text(&zero.stderr));
    assert_eq!(kinecut(&["reach", "trt_xyzac", "--direction", "1,2"], "").status.code(), Some(2));
}

#[test]
fn layouts_are_counted_filtered_and_sorted() {
    for (of, options, count) in [
        ("XYZ", &[][..], 24),
        ("XYZAC", &["--full"][..], 360),
        ("regular", &[][..], 648),
        ("641203", &["--kind", "table-table"][..], -1),
    ] {
        let mut args = vec!["layouts", of, "--json", "--show", "1000"];
        args.extend(options);
        let (code, sheet) = json(&args, "");
        assert_eq!(code, Some(0));
        let rows = sheet["layouts"].as_array().unwrap();
        assert_eq!(rows.len() as u64, sheet["left"].as_u64().unwrap());
        if count >= 0 {
            assert_eq!(rows.len(), count as usize, "{of}");
        }
        let costs: Vec<f64> = rows.iter().map(|r| r["cost"].as_f64().unwrap()).collect();
        assert!(costs.is_sorted(), "{of}");
        assert!(rows.iter().any(|r| r["pareto"] == true));
    }
    let shown = text(&kinecut(&["layouts", "2103", "--work-links", "1", "--show", "3"], "").stdout);
    let shown = shown.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in ["Layouts 24", "Left 12", "Classes 1 (", "And 9 more."] {
        assert!(shown.contains(said), "{said}: {shown}");
    }
    let none = kinecut(&["layouts", "XYZ", "--tilt", "30"], "");
    assert_eq!(none.status.code(), Some(1), "{}", text(&none.stdout));
    assert!(text(&none.stderr).contains("KC1123"), "{}", text(&none.stderr));
    for (args, part) in [
        (["layouts", "XQZ", "--show", "1"], "`Q`"),
        (["layouts", "XYX", "--show", "1"], "second time"),
        (["layouts", "XYZ", "--kind", "round"], "kind of layout"),
        (["layouts", "XYZ", "--weight", "beauty=1"], "criterion"),
        (["layouts", "XYZ", "--stroke", "1,0,1"], "KC1122"),
    ] {
        let run = kinecut(&args, "");
        assert!(
            run.status.code() == Some(2) && text(&run.stderr).contains(part),
            "{args:?} {}",
            text(&run.stderr)
        );
    }
}

#[test]
fn bodies_are_listed_written_drawn_and_moved() {
    let folder = folder("bodies");
    let file = folder.join("m.toml").display().to_string();
    let body =
        "[[body]]\nname = \"table\"\nlink = \"work\"\nbox = { min = [-100, -50, -20], max = [100, 50, 0] }\n";
    std::fs::write(&file, format!("code = \"641203\"\n{body}")).unwrap();
    let picture = folder.join("m.svg").display().to_string();
    let run = kinecut(&["machine", &file, "--svg", &picture, "--json"], "");
    let sheet: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(
        (sheet["bodies"][0]["link"].as_str(), sheet["bodies"][0]["form"].as_str()),
        (Some("C"), Some("box"))
    );
    let home = std::fs::read_to_string(&picture).unwrap();
    // The usual bodies would stand on a bed.
    let tinted = |tint: &str| home.contains(&format!("class=\"t-{tint} "));
    assert!(tinted("blue") && !tinted("grey"), "the body of the file is drawn");
    let moved = kinecut(&["machine", &file, "--svg", &picture, "--at", "C30 A-20"], "");
    assert_eq!(moved.status.code(), Some(0));
    assert_ne!(std::fs::read_to_string(&picture).unwrap(), home);
    let written = text(&kinecut(&["machine", &file, "--toml"], "").stdout);
    assert!(written.contains("link = \"C\"") && written.contains("max = [100, 50, 0]"), "{written}");
    // Usual bodies move too.
    let usual = |at: &str| {
        let run = kinecut(&["machine", "trt_xyzac", "--svg", &picture, "--at", at], "");
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
        std::fs::read_to_string(&picture).unwrap()
    };
    assert_ne!(usual("C0"), usual("A-30 C30"));
    let layout = text(&kinecut(&["machine", "--layout", "641203", "--toml"], "").stdout);
    assert!(layout.contains("code = \"641203\"") && layout.contains("[[body]]"), "{layout}");
    let (code, posed) = json(&["machine", "trt_xyzac", "--at", "A80", "--json"], "");
    assert_eq!((code, posed["pose"]["findings"][0]["code"].as_str()), (Some(1), Some("KC0507")));
    std::fs::write(&file, "code = \"641203\"\n[[body]]\nlink = \"C\"\nmesh = \"no.stl\"\n").unwrap();
    let missing = kinecut(&["machine", &file], "");
    let message = text(&missing.stderr);
    assert!(
        missing.status.code() == Some(2) && message.contains("m.toml:4") && message.contains("no.stl"),
        "{message}"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn straight_axes_and_spare_axes_are_answered() {
    let poses = "X0 Y0 Z0 I0.1 J0 K1\nX10 Y0 Z0 I0.2 J0.1 K1\nX20 Y5 Z0 I0.2 J0.4 K1\n";
    let (code, sheet) = json(&["ik", "trt_xyzac", "-", "--path", "--tolerance", "0.05", "--json"], poses);
    assert_eq!(code, Some(0));
    let steps = sheet["straight"].as_array().unwrap();
    assert_eq!(steps.len(), 2);
    assert!(
        steps.iter().all(|s| s["left"].as_f64().unwrap() <= 0.05 && s["deviation"].as_f64().unwrap() > 0.5)
    );
    // The text with its points is again a list of positions.
    let words = text(&kinecut(&["ik", "trt_xyzac", "-", "--path", "--tolerance", "0.05"], poses).stdout);
    let (_, back) = json(&["fk", "trt_xyzac", "-", "--json"], &words);
    let inserted: usize = steps.iter().map(|s| s["inserted"].as_array().unwrap().len()).sum();
    assert_eq!(back.as_array().unwrap().len(), 3 + inserted);
    let (code, swept) =
        json(&["ik", "six_axis_trsrn", "-", "--path", "--sweep", "a", "--places", "7", "--json"], poses);
    assert_eq!(code, Some(0));
    let at = swept["at"].as_f64().unwrap();
    assert!(swept["path"]["joints"].as_array().unwrap().iter().all(|j| near(&j["A"], at)));
    let (code, one) =
        json(&["ik", "six_axis_trsrn", "--at", "X1 K1", "--sweep", "A", "--places", "5", "--json"], "");
    assert_eq!((code, one["places"].as_array().unwrap().len()), (Some(0), 5));
    for wrong in
        [&["--tolerance", "1"][..], &["--places", "3"], &["--path", "--tolerance", "0"], &["--sweep", "Q"]]
    {
        let run = kinecut(&[&["ik", "trt_xyzac", "-"], wrong].concat(), poses);
        assert_eq!(run.status.code(), Some(2), "{wrong:?}: {}", text(&run.stderr));
    }
}

#[test]
fn workspaces_are_shown_where_sizes_are_given() {
    let plain = text(&kinecut(&["layouts", "641203", "--show", "2"], "").stdout);
    let sized = text(&kinecut(&["layouts", "641203", "--show", "2", "--stroke", "600,500,500"], "").stdout);
    assert!(!plain.contains("litres") && sized.contains("litres"), "{sized}");
    let (_, sheet) = json(&["layouts", "641203", "--show", "2", "--stroke", "600,500,500", "--json"], "");
    let space = &sheet["layouts"][0]["workspace"];
    assert!(near(&space["litres"], 150.0) && near(&space["orientation_angle"], 1.0), "{space}");
    assert!(sheet["layouts"].as_array().unwrap().len() == 2);
}
