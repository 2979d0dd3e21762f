//! Machine files: what is read, that every error points at its value, that writing and reading give the same machine.

use glam::{DMat3, DVec3};
use kinecut::base::Code;
use kinecut::job::machine::{machine_toml, read};
use kinecut::machine::{Interpolator, Machine, MotionControl};
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

/// A three-axis machine with these keys of `dynamics`.
fn with_dynamics(keys: &str) -> String {
    format!("code = \"2103\"\ndynamics = {{ {keys} }}\n")
}

/// All values of control, spindle and tool change.
const CONTROL: &str = "max_feed = 6000, max_speed = 12000, interpolator = \"junction-deviation\", tolerance = 0.02, \
                       turn_tolerance = 0.1, junction_deviation = 0.01, servo_bandwidth = 25, tool_change = 4.5, spindle_ramp = 1.5, \
                       spindle_power = 7.5, spindle_torque = 48";

#[test]
fn every_key_of_control_and_spindle_arrives_in_its_unit() {
    let control = read("c.toml", &with_dynamics(CONTROL)).unwrap().control;
    // 12000 rev/min are 400 pi rad/s, 0.1 degrees are pi/1800.
    let pi = std::f64::consts::PI;
    assert!((control.max_speed.unwrap() - 400.0 * pi).abs() < 1e-9);
    assert!((control.turn_tolerance.unwrap() - pi / 1800.0).abs() < 1e-15);
    let expected = MotionControl {
        max_feed: Some(100.0),
        max_speed: control.max_speed,
        spindle_power: Some(7500.0),
        spindle_torque: Some(48.0),
        interpolator: Some(Interpolator::JunctionDeviation),
        tolerance: Some(0.02),
        turn_tolerance: control.turn_tolerance,
        junction_deviation: Some(0.01),
        servo_bandwidth: Some(25.0),
        tool_change: Some(4.5),
        spindle_ramp: Some(1.5),
    };
    assert_eq!(control, expected);
    assert_eq!(read("c.toml", &with_dynamics("rapid = 30000")).unwrap().control, MotionControl::default());
    for (word, interpolator) in [
        ("jerk-limited", Interpolator::JerkLimited),
        ("trapezoid", Interpolator::Trapezoid),
        ("exact-stop", Interpolator::ExactStop),
        ("linuxcnc", Interpolator::LinuxCnc),
    ] {
        let control = read("c.toml", &with_dynamics(&format!("interpolator = \"{word}\""))).unwrap().control;
        assert_eq!(control, MotionControl { interpolator: Some(interpolator), ..MotionControl::default() });
    }
}

#[test]
fn a_curve_of_torque_is_read_and_written() {
    let machine = read("c.toml", &with_dynamics("spindle_curve = [[1500, 40], [6000, 10]]")).unwrap();
    let turns = std::f64::consts::TAU / 60.0;
    assert!((machine.spindle_curve.as_ref().unwrap().torque(3000.0 * turns) - 20.0).abs() < 1e-9);
    let again = read("c.toml", &machine_toml(&machine)).unwrap();
    let points = |m: &Machine| m.spindle_curve.as_ref().unwrap().points().to_vec();
    for (a, b) in points(&machine).iter().zip(points(&again)) {
        assert!((a[0] - b[0]).abs() < 1e-9 && a[1] == b[1]);
    }
    let e = read("c.toml", &with_dynamics("spindle_curve = [[1500, 40], [1200, 10]]")).unwrap_err();
    assert_eq!(e.0.key.as_deref(), Some("dynamics.spindle_curve[1]"));
}

#[test]
fn values_of_control_and_spindle_are_held_to_their_bounds() {
    let junction = "interpolator = \"junction-deviation\"";
    let speed = "max_speed = 8000";
    // What stands beside it, the key, its greatest value, its unit.
    for (beside, key, most, unit) in [
        ("rapid = 30000", "tolerance", 1.0, "mm"),
        ("rapid = 30000", "turn_tolerance", 5.0, "deg"),
        ("rapid = 30000", "tool_change", 600.0, "s"),
        (speed, "spindle_ramp", 120.0, "s"),
        (junction, "junction_deviation", 1.0, "mm"),
    ] {
        let with = |value: &str| read("c.toml", &with_dynamics(&format!("{beside}, {key} = {value}")));
        for fine in [0.0, 0.5 * most, most] {
            with(&fine.to_string()).unwrap_or_else(|e| panic!("{key} = {fine}: {e}"));
        }
        for (value, bound) in [
            ("-0.001", Some(0.0)),
            ("-inf", Some(0.0)),
            ("601", Some(most)),
            ("1e300", None),
            ("inf", Some(most)),
            ("nan", None),
        ] {
            let error = with(value).expect_err(value);
            let f = &error.0;
            assert_eq!(
                (f.code, f.key.as_deref()),
                (Code::JOB_VALUE, Some(&*format!("dynamics.{key}"))),
                "{f}"
            );
            assert_eq!(f.place.as_ref().map(|p| (p.file.as_str(), p.line)), Some(("c.toml", 2)), "{f}");
            assert!(!f.help.is_empty(), "{f}");
            if let Some(bound) = bound {
                let shown = f.bound.as_ref().unwrap();
                assert_eq!((shown.value, &*shown.unit), (bound, unit), "{f}");
                assert_eq!(f.value.as_ref().unwrap().value, value.parse::<f64>().unwrap(), "{f}");
            }
        }
        with("\"1\"").expect_err("a text is no number");
    }
}

#[test]
fn values_of_control_and_spindle_that_need_another_ask_for_it() {
    // The keys, the code, the key of the finding, a part of the message, a part of the help.
    let (axis, shape) = (Code::MACHINE_AXIS, Code::JOB_SHAPE);
    for (keys, code, key, part, help) in [
        ("spindle_ramp = 2", axis, "spindle_ramp", "max_speed", "add max_speed"),
        ("junction_deviation = 0.01", axis, "junction_deviation", "interpolator", "\"junction-deviation\""),
        (
            "junction_deviation = 0.01, interpolator = \"trapezoid\"",
            axis,
            "junction_deviation",
            "interpolator",
            "\"junction-deviation\"",
        ),
        ("interpolator = \"mach3\"", shape, "", "unknown variant `mach3`", ""),
        ("corner_tolerance = 1", shape, "", "unknown field `corner_tolerance`", ""),
    ] {
        let error = read("c.toml", &with_dynamics(keys)).expect_err(keys);
        let f = &error.0;
        assert_eq!(f.code, code, "{f}");
        assert!(f.to_string().contains(part) && f.help.contains(help), "{f:?}");
        assert_eq!(f.place.as_ref().map(|p| p.line), Some(2), "{f}");
        if code == axis {
            assert_eq!(f.key.as_deref(), Some(&*format!("dynamics.{key}")), "{f}");
            assert!(f.value.is_some(), "{f}");
        }
    }
    let axis = with_dynamics("rapid = 30000") + "[axis.X]\ntolerance = 0.1\n";
    assert!(read("c.toml", &axis).unwrap_err().to_string().contains("unknown field `tolerance`"));
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
        (
            "point = [0, 20, 10]",
            "point = [0, 20]",
            Code::JOB_SHAPE,
            8,
            "`point` takes a list of 3 numbers in mm, not of 2",
            false,
            false,
        ),
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
    machines.push(read("c.toml", &with_dynamics(CONTROL)).unwrap());
    for word in ["jerk-limited", "trapezoid", "exact-stop"] {
        let keys = format!(
            "interpolator = \"{word}\", tolerance = 0, turn_tolerance = 0.0123456789, tool_change = 0"
        );
        let rapids = "rapids = \"axis-by-axis\"\n";
        machines.push(read("c.toml", &(with_dynamics(&keys) + rapids)).unwrap());
    }
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
        assert_eq!((again.control, again.rapids), (machine.control, machine.rapids), "{text}");
        assert_eq!(machine_toml(&again), text, "writing is stable");
    }
}
