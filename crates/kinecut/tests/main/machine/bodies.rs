//! Bodies of a machine: what its file says arrives, what is wrong is named, writing and reading give the same, they move with
//! their links and stand in the drawing.

use glam::DVec3;
use kinecut::base::{Code, MemoryLoader};
use kinecut::geom::{Mesh, Solid, write_stl};
use kinecut::job::machine::{Loaded, machine_toml, read, read_with};
use kinecut::machine::Link;
use kinecut::machine::layouts::Attitude;
use kinecut::verbs::Answer as _;
use kinecut::verbs::layouts::{machine_drawing, machine_drawing_at};
use kinecut::verbs::machine::MachineAnswer;

const MACHINE: &str = r#"code = "641203"
[[body]]
name = "table"
link = "work"
cylinder = { base = [0, 0, -40], diameter = 400, height = 40 }
[[body]]
link = "A"
cylinder = { base = [-250, 0, -100], axis = [2, 0, 0], diameter = 120.3, height = 500 }
[[body]]
link = "bed"
box = { min = [-400, -300, -300], max = [400, 300, -200.1] }
[[body]]
link = "spindle"
mesh = "head.stl"
"#;

/// A tetrahedron.
fn head() -> Vec<u8> {
    let vertices = vec![DVec3::ZERO, DVec3::X * 80.0, DVec3::Y * 60.0, DVec3::Z * 100.0];
    write_stl(&Mesh { vertices, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] })
}

fn files() -> MemoryLoader {
    MemoryLoader::default().with("head.stl", head()).with("open.stl", head()[..head().len() - 50].to_vec())
}

#[test]
fn bodies_arrive_with_their_links_and_survive_writing_and_reading() {
    let machine = read_with("m.toml", MACHINE, &files()).unwrap();
    let links: Vec<Link> = machine.bodies.iter().map(|b| b.link).collect();
    assert_eq!(links, [Link::Axis(0), Link::Axis(1), Link::Bed, Link::Axis(4)]);
    let drum = &machine.bodies[1];
    assert!((drum.bounds().max - DVec3::new(250.0, 60.15, -39.85)).length() < 1e-9);
    assert_eq!(drum.place.rotation.z_axis, DVec3::X);
    assert!(matches!(&machine.bodies[3].solid, Solid::Mesh(mesh) if (mesh.volume() - 80_000.0).abs() < 1e-2));
    let text = machine_toml(&machine);
    let again = read_with("m.toml", &text, &files()).unwrap();
    assert_eq!(again.bodies, machine.bodies, "{text}");
    assert_eq!(machine_toml(&again), text);
    // Directions that are not along an axis too, bit by bit.
    let leaning = MACHINE.replace("axis = [2, 0, 0]", "axis = [0.3, -0.7, 0.1]");
    let machine = read_with("m.toml", &leaning, &files()).unwrap();
    assert_eq!(read_with("m.toml", &machine_toml(&machine), &files()).unwrap().bodies, machine.bodies);
    let answer = MachineAnswer::of(Loaded { machine, import: None });
    assert_eq!(answer.sheet.bodies[0].link, "C");
    let shown = answer.text();
    let row = ["C", "table", "cylinder", "-200", "-200", "-40", "200", "200", "0"];
    assert!(shown.lines().any(|line| line.split_whitespace().eq(row)), "{shown}");
}

#[test]
fn wrong_bodies_are_named_with_line_value_bound_and_help() {
    let body = Code::MACHINE_BODY;
    // What is replaced, by what, code, line, a part of the message, whether a value.
    let cases: &[(&str, &str, Code, u32, &str, bool)] = &[
        ("\"work\"", "\"table\"", body, 4, "no link `table`", false),
        ("\"A\"", "\"B\"", body, 7, "no link `B`", false),
        ("-200.1", "-300", body, 11, "greatest corner", true),
        ("-200.1", "nan", Code::JOB_VALUE, 11, "not a number", false),
        ("[-400, -300, -300]", "[-1e6, -300, -300]", Code::JOB_VALUE, 11, "", true),
        ("diameter = 400", "diameter = 0", Code::JOB_VALUE, 5, "positive", true),
        ("height = 40 ", "height = -40 ", Code::JOB_VALUE, 5, "positive", true),
        ("axis = [2, 0, 0]", "axis = [0, 0, 0]", Code::MACHINE_AXIS, 8, "no direction", true),
        ("\"head.stl\"", "\"hand.stl\"", Code::FILE_NOT_READ, 14, "hand.stl", false),
        ("\"head.stl\"", "\"open.stl\"", Code::MESH_UNREADABLE, 14, "open.stl", true),
        ("mesh = \"head.stl\"", "", body, 13, "no form", false),
        (
            "mesh =",
            "box = { min = [0, 0, 0], max = [1, 1, 1] }\nmesh =",
            body,
            15,
            "more than one form",
            false,
        ),
        ("mesh =", "mash =", Code::JOB_SHAPE, 14, "unknown field", false),
    ];
    for (from, to, code, line, part, value) in cases {
        assert!(MACHINE.contains(from), "{from}");
        let error = read_with("m.toml", &MACHINE.replacen(from, to, 1), &files()).expect_err(to);
        let f = &error.0;
        assert_eq!(f.code, *code, "{to}: {f}");
        assert!(f.to_string().contains(part), "{to}: {f}");
        assert_eq!(f.value.is_some(), *value, "{to}: {f}");
        assert_eq!(f.place.as_ref().map(|p| p.line), Some(*line), "{to}: {f:?}");
    }
    // Without a loader there are no files.
    assert_eq!(read("m.toml", MACHINE).unwrap_err().code(), Code::FILE_NOT_READ);
}

#[test]
fn bodies_move_with_their_links() {
    let machine = read_with("m.toml", MACHINE, &files()).unwrap();
    // C A X Y Z: the table goes against X, turned and tilted with its cradle; the bed stands.
    let q = [0.5, -0.3, 100.0, 20.0, -50.0];
    let moved = machine.body_motions(&q);
    assert_eq!(moved[2].translation, DVec3::ZERO);
    assert_eq!(moved[3].translation, DVec3::new(0.0, 0.0, -50.0));
    // By hand: the cradle turns by +0.3 about X and lies at (-100, -20).
    let p = DVec3::new(1.0, 2.0, 3.0);
    let (sin, cos) = 0.3f64.sin_cos();
    let tilted = DVec3::new(1.0 - 100.0, cos * 2.0 - sin * 3.0, sin * 2.0 + cos * 3.0);
    let wanted = tilted - DVec3::new(0.0, cos * 20.0 * 0.0 + 20.0, 0.0);
    assert!((moved[1].point(p) - wanted).length() < 1e-12, "{:?}", moved[1].point(p));
}

#[test]
fn the_drawing_shows_the_bodies_of_the_file_where_the_axes_are() {
    let with = read_with("m.toml", MACHINE, &files()).unwrap();
    let without = read("m.toml", "code = \"641203\"").unwrap();
    let [own, usual] = [&with, &without].map(|m| machine_drawing(m, Attitude::Vertical));
    assert_ne!(own, usual);
    // Letters of all axes, primed on the work side.
    for letter in ["C\u{2032}", "A\u{2032}", "X\u{2032}", "Y\u{2032}", "Z"] {
        assert!(own.contains(&format!(">{letter}</text>")), "{letter}");
    }
    assert!(!own.contains("NaN") && !own.contains("inf"));
    let moved = machine_drawing_at(&with, Attitude::Vertical, &[0.3, -0.5, 50.0, 0.0, -20.0]);
    assert_ne!(moved, own);
    assert_eq!(machine_drawing_at(&with, Attitude::Vertical, &[0.0; 5]), own);
    assert!(machine_drawing(&with, Attitude::Horizontal).contains("class=\"t-"));
}
