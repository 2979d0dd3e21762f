//! Machine files: what is read, that every error points at its value, that writing and reading give the same machine.

use glam::{DMat3, DVec3};
use kinecut::base::Code;
use kinecut::job::machine::{machine_toml, read};
use kinecut::machine::Machine;
use serde_json::Value;

use crate::common::golden::{self, vector};

/// A trunnion table: each test of errors breaks one thing of it.
const TRUNNION: &str = r#"name = "trunnion"
code = "641203"
travel = { X = [-200, 200], C = [-36000, 36000] }
dynamics = { rapid = 30000, acceleration = 4, jerk = 50 }

[axis.A]
direction = [2, 0, 0]
point = [0, 20, 10]
sense = -1
travel = [-100, 50]
rapid = 25
acceleration = 720

[axis.Z]
travel = [-120, 120]

[spindle]
point = [0, 0, 7]

[work]
point = [1, 2, 3]
x = [0, 1, 0]
"#;

#[test]
fn every_key_arrives_in_its_unit() {
    let m = read("t.toml", TRUNNION).unwrap();
    assert_eq!((m.name.as_str(), m.code.to_string().as_str()), ("trunnion", "641203"));
    let letters: String = m.joints.iter().map(|j| j.letter).collect();
    assert_eq!(letters, "CAXYZ");
    let (i, a) = m.joint('A').unwrap();
    assert_eq!((i, a.direction, a.point, a.sense), (1, DVec3::X, DVec3::new(0.0, 20.0, 10.0), -1.0));
    assert!((a.travel.unwrap()[0] + 1.745_329_251_994_33).abs() < 1e-12);
    // 25 rev/min are 2.618 rad/s.
    assert!((a.dynamics.rapid.unwrap() - 2.617_993_877_991_494).abs() < 1e-12);
    assert!((a.dynamics.acceleration.unwrap() - 12.566_370_614_359_17).abs() < 1e-12);
    assert_eq!(a.dynamics.jerk, None);
    assert_eq!(m.travel('X'), Some([-200.0, 200.0]));
    assert_eq!(m.travel('Z'), Some([-120.0, 120.0]));
    assert_eq!(m.travel('Y'), None);
    assert_eq!(
        (m.dynamics.rapid, m.dynamics.acceleration, m.dynamics.jerk),
        (Some(500.0), Some(4000.0), Some(50_000.0))
    );
    assert_eq!(m.spindle.translation, DVec3::new(0.0, 0.0, 7.0));
    // The frame of the table: its X is the machine's Y.
    assert!((m.work.vector(DVec3::X) - DVec3::Y).length() < 1e-15);
    assert!((m.work.vector(DVec3::Z) - DVec3::Z).length() < 1e-15);
    assert!((m.work.point(DVec3::ZERO) - DVec3::new(1.0, 2.0, 3.0)).length() < 1e-15);
}

#[test]
fn an_inclined_axis_has_a_digit_a_direction_and_a_letter() {
    let text = "code = \"012367\"\n[axis.7]\ndirection = [0, 1, 1]\npoint = [0, 50, 120]\n[spindle]\npoint = [0, 50, 0]\n";
    let m = read("n.toml", text).unwrap();
    let (i, b) = m.joint('B').unwrap();
    assert_eq!(i, 4);
    assert!((b.direction.y - 0.5f64.sqrt()).abs() < 1e-15 && b.direction.x == 0.0);
    let both = "code = \"0123657\"\n[axis.7]\ndirection = [0, 1, 1]\n";
    let m = read("n.toml", both).unwrap();
    let letters: String = m.joints.iter().map(|j| j.letter).collect();
    assert_eq!(letters, "XYZCBA"); // B is taken, A is free
    let named =
        "code = \"0123657\"\ntravel = { W = [-1, 1] }\n[axis.7]\nletter = \"W\"\ndirection = [0, 1, 1]\n";
    assert!((read("n.toml", named).unwrap().travel('W').unwrap()[1] - 0.017_453_292_519_943_3).abs() < 1e-15);
}

#[test]
fn wrong_machines_get_one_message_with_line_value_bound_and_help() {
    let axis = Code::MACHINE_AXIS;
    // What is replaced, by what, code, line, a part of the message, whether a value, whether a bound.
    let cases: &[(&str, &str, Code, u32, &str, bool, bool)] = &[
        ("641203", "64123", Code::MACHINE_CODE, 2, "0 beds", false, false),
        ("641203", "641x203", Code::MACHINE_CODE, 2, "641x203", false, false),
        ("641203", "6412033", Code::MACHINE_CODE, 2, "3 2 times", false, false),
        ("direction = [2, 0, 0]", "direction = [0, 0, 0]", axis, 7, "no direction", true, true),
        ("direction = [2, 0, 0]", "direction = [nan, 0, 0]", axis, 7, "no direction", true, true),
        ("direction = [2, 0, 0]", "direction = [0, 1, 0]", axis, 7, "digit 4 of the code", true, true),
        ("point = [0, 20, 10]", "point = [0, 1e9, 10]", Code::JOB_VALUE, 8, "too large", true, true),
        ("point = [0, 20, 10]", "point = [0, 20]", Code::JOB_SHAPE, 8, "array", false, false),
        ("sense = -1", "sense = 0.5", axis, 9, "sense", true, false),
        ("travel = [-100, 50]", "travel = [50, -100]", axis, 10, "reversed", true, true),
        ("travel = [-100, 50]", "travel = [-inf, 50]", axis, 10, "not finite", true, true),
        ("X = [-200, 200]", "X = [200, -200]", axis, 3, "reversed", true, true),
        ("X = [-200, 200]", "B = [-200, 200]", axis, 3, "no axis `B`", false, false),
        ("X = [-200, 200]", "A = [-20, 20]", axis, 3, "given twice", false, false),
        ("[axis.Z]", "[axis.4]", axis, 6, "another table", false, false),
        ("[axis.Z]", "[axis.Q]", axis, 14, "no axis `Q`", false, false),
        ("[axis.Z]", "[axis.Z]\npoint = [0, 0, 0]", axis, 15, "translation", false, false),
        ("[axis.Z]", "[axis.Z]\nletter = \"Q\"", axis, 15, "no address", false, false),
        ("[axis.Z]", "[axis.Z]\nletter = \"X\"", axis, 0, "two axes have this letter", false, false),
        ("rapid = 25", "rapid = 0", Code::JOB_VALUE, 11, "must be positive", true, true),
        ("rapid = 30000", "rapid = -1", Code::JOB_VALUE, 4, "must be positive", true, true),
        ("x = [0, 1, 0]", "x = [0, 1, 1]", Code::JOB_VALUE, 22, "right angles", true, true),
        ("[work]", "[spindel]", Code::JOB_SHAPE, 20, "unknown field", false, false),
        ("code = \"641203\"", "", Code::JOB_SHAPE, 0, "no code", false, false),
        ("code = \"641203\"", "preset = \"trt_xyzak\"", Code::MACHINE_PRESET, 2, "trt_xyzak", false, false),
    ];
    for (from, to, code, line, part, value, bound) in cases {
        assert!(TRUNNION.contains(from), "{from}");
        let error = read("t.toml", &TRUNNION.replacen(from, to, 1)).expect_err(to);
        let f = &error.0;
        assert_eq!(f.code, *code, "{to}: {f}");
        assert!(f.to_string().contains(part), "{to}: {f}");
        assert_eq!((f.value.is_some(), f.bound.is_some()), (*value, *bound), "{to}: {f}");
        if *line > 0 {
            let place = f.place.as_ref().unwrap_or_else(|| panic!("{to}: no place: {f:?}"));
            assert_eq!((place.file.as_str(), place.line), ("t.toml", *line), "{to}: {f}");
        }
    }
    let flat = "code = \"0123\"\n[axis.Y]\ndirection = [0, 1, 0.1]\n[axis.Z]\ndirection = [0, 0.17, 1]\n";
    assert!(read("t.toml", flat).is_ok());
    let inclined = read("t.toml", "code = \"012367\"\n").unwrap_err();
    assert_eq!((inclined.code(), inclined.0.place.as_ref().unwrap().line), (axis, 1), "{inclined}");
    assert!(inclined.0.help.contains("[axis.7]"), "{inclined}");
}

/// The machines of the golden file, made through the text of a machine file that this test writes itself.
fn golden() -> Vec<(Machine, Value)> {
    golden::file("kinematics")["machines"]
        .as_array()
        .unwrap()
        .iter()
        .map(|m| (read("golden.toml", &text_of(m)).unwrap(), m.clone()))
        .collect()
}

fn text_of(m: &Value) -> String {
    let mut text = format!("name = {}\ncode = {}\n", m["name"], m["code"]);
    let digits: Vec<char> = m["code"].as_str().unwrap().chars().filter(|c| *c != '0').collect();
    for (joint, digit) in m["joints"].as_array().unwrap().iter().zip(digits) {
        text += &format!(
            "[axis.{digit}]\nletter = \"{}\"\ndirection = {}\n",
            &joint["name"].as_str().unwrap()[..1],
            joint["dir"]
        );
        text += &format!("sense = {}\ntravel = [{}, {}]\n", joint["sign"], joint["lo"], joint["hi"]);
        if let Some(point) = joint.get("pt") {
            text += &format!("point = {point}\n");
        }
    }
    text + &format!("[spindle]\npoint = {}\ndirection = {}\n", m["tip0"], m["axis0"])
}

#[test]
fn a_preset_is_changed_by_what_stands_beside_it() {
    let text = "preset = \"trt_xyzac\"\ntravel = { A = [-30, 30] }\n[axis.A]\npoint = [0, 1, 2]\n";
    let m = read("p.toml", text).unwrap();
    let known = Machine::preset("trt_xyzac").unwrap();
    assert_eq!(m.joint('A').unwrap().1.point, DVec3::new(0.0, 1.0, 2.0));
    assert!((m.travel('A').unwrap()[0].to_degrees() + 30.0).abs() < 1e-12);
    assert_eq!((m.travel('X'), &m.code), (known.travel('X'), &known.code));
    // The bed may stand elsewhere, the order of the axes not.
    let moved = format!("code = \"461203\"\n{text}");
    assert_eq!(read("p.toml", &moved).unwrap_err().code(), Code::MACHINE_CODE);
    let moved = read("p.toml", &format!("code = \"w C' A' b X Y Z (C1) t\"\n{text}")).unwrap();
    assert_eq!(moved.code.to_string(), "640123");
}

#[test]
fn every_machine_that_is_known_goes_through_a_file() {
    for preset in kinecut::machine::presets() {
        let machine = preset.machine().unwrap();
        let again =
            read("again.toml", &machine_toml(&machine)).unwrap_or_else(|e| panic!("{}: {e}", preset.name));
        let q: Vec<f64> = (0..machine.joints.len()).map(|i| 0.3 + 0.4 * i as f64).collect();
        let (a, b) = (machine.kinematics(50.0).forward(&q), again.kinematics(50.0).forward(&q));
        assert!((a.translation - b.translation).length() < 1e-11, "{}", preset.name);
        assert!((a.rotation.x_axis - b.rotation.x_axis).length() < 1e-13, "{}", preset.name);
    }
}

#[test]
fn machines_of_the_golden_file_stand_where_it_says() {
    let mut poses = 0;
    for (machine, golden) in golden() {
        let kinematics = machine.kinematics(0.0);
        for pose in golden["poses"].as_array().unwrap() {
            let q: Vec<f64> = machine
                .joints
                .iter()
                .zip(pose["q_deg_mm"].as_array().unwrap())
                .map(|(j, v)| {
                    if j.motion.is_rotation() {
                        v.as_f64().unwrap().to_radians()
                    } else {
                        v.as_f64().unwrap()
                    }
                })
                .collect();
            let tip = kinematics.forward(&q);
            let off = (tip.translation - vector(&pose["tip"])).length();
            let turned = (tip.rotation.z_axis - vector(&pose["axis"])).length();
            // The file has twelve digits of lengths up to some hundred millimetres.
            assert!(off < 2e-9 && turned < 2e-11, "{}: {off:e} {turned:e}", golden["name"]);
            poses += 1;
        }
    }
    assert!(poses > 100, "{poses}");
}

#[test]
fn writing_and_reading_give_the_same_machine() {
    let mut machines: Vec<Machine> = golden().into_iter().map(|(m, _)| m).collect();
    let mut full = read("t.toml", TRUNNION).unwrap();
    full.name = "a \"quoted\" \\ name".to_owned();
    full.spindle.rotation = DMat3::from_cols(DVec3::Y, DVec3::NEG_Z, DVec3::NEG_X);
    machines.push(full);
    let mut down = read("t.toml", "code = \"2103\"").unwrap();
    down.spindle.rotation = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, -1.0));
    machines.push(down);
    for machine in machines {
        let text = machine_toml(&machine);
        let again = read("again.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_eq!((&again.name, &again.code), (&machine.name, &machine.code));
        let close = |a: DVec3, b: DVec3| (a - b).length() < 1e-14;
        for (a, b) in again.joints.iter().zip(&machine.joints) {
            assert_eq!(
                (a.motion, a.letter, a.sense, a.point),
                (b.motion, b.letter, b.sense, b.point),
                "{text}"
            );
            assert!(close(a.direction, b.direction), "{text}");
            let near = |a: Option<f64>, b: Option<f64>| match (a, b) {
                (Some(a), Some(b)) => (a - b).abs() <= 1e-13 * b.abs(),
                (a, b) => a == b,
            };
            for i in 0..2 {
                assert!(near(a.travel.map(|t| t[i]), b.travel.map(|t| t[i])), "{text}");
            }
            assert!(
                near(a.dynamics.rapid, b.dynamics.rapid) && near(a.dynamics.jerk, b.dynamics.jerk),
                "{text}"
            );
            assert!(near(a.dynamics.acceleration, b.dynamics.acceleration), "{text}");
        }
        for (a, b) in [(again.spindle, machine.spindle), (again.work, machine.work)] {
            assert_eq!(a.translation, b.translation);
            for i in 0..3 {
                assert!(close(a.rotation.col(i), b.rotation.col(i)), "{text}");
            }
        }
        assert_eq!(again.dynamics, machine.dynamics);
        assert_eq!(machine_toml(&again), text, "writing is stable");
    }
}
