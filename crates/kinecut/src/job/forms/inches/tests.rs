//! Inches of every key, and of what is made of them.

use std::fmt::Write as _;

use toml::de::DeTable;

use super::*;
use crate::job::file::{self, CuttingFileTable, JobFile, MachineTable, ToolLibraryTable};

/// The numbers of a text after it was read, in the order of the text.
fn read<T: JsonSchema>(text: &str) -> Vec<f64> {
    let mut root = DeTable::parse(text).unwrap();
    let in_mm = InMm::of::<T>(&mut root);
    in_mm.put_into::<T>(&mut root);
    fn all(value: &DeValue<'_>, out: &mut Vec<f64>) {
        match value {
            DeValue::Table(table) => table.values().for_each(|value| all(value.get_ref(), out)),
            DeValue::Array(list) => list.iter().for_each(|value| all(value.get_ref(), out)),
            value => out.extend(number(value)),
        }
    }
    let mut out = Vec::new();
    root.get_ref().values().for_each(|value| all(value.get_ref(), &mut out));
    out
}

#[test]
fn lengths_feeds_and_speeds_are_turned_and_all_else_stays() {
    let job = r#"
        format = 1
        units = "in"
        stock = { box = { min = [-1, 0x2, -0.5], max = [1, 1, 0] } }
        post = { control = "fanuc", resolution = 0.0001 }
        [[tool]]
        number = 3
        type = "drill"
        diameter = 0.25
        point_angle = 118
        [[setup]]
        [[setup.operation]]
        type = "face"
        thresholds = [[0.02, 90], [0.04, 60]]
        axial_step = 0.1
        cutting_speed = 100
        feed = 20
    "#;
    let got = read::<JobFile>(job);
    let wanted = [
        // format; post; setup with speed, feed, the step under its old name, thresholds.
        vec![1.0, 0.0001 * 25.4],
        vec![0.1 * 25.4, 100.0 * 0.3048, 20.0 * 25.4, 0.02 * 25.4, 90.0, 0.04 * 25.4, 60.0],
        vec![25.4, 25.4, 0.0, -25.4, 2.0 * 25.4, -12.7],
        vec![0.25 * 25.4, 3.0, 118.0],
    ];
    assert_eq!(got, wanted.concat());
    assert_eq!(read::<JobFile>(&job.replace("\"in\"", "\"mm\""))[1], 0.0001);
}

#[test]
fn a_part_says_its_own_units() {
    // A machine in mm within a job in inches, loops with a unit of their own, and a post of its own.
    let job = r#"
        units = "in"
        post = { control = "fanuc", units = "mm", resolution = 0.005 }
        machine = { units = "mm", travel = { X = [0, 500], A = [-90, 90] } }
        [[setup]]
        [[setup.operation]]
        type = "contour"
        depth = 1
        outline = { unit = "mm", loops = [{ centre = [1, 2], radius = 3 }] }
    "#;
    // A bulge is no length.
    let bulged = "units = \"in\"\n[[setup]]\n[[setup.operation]]\ntype = \"contour\"\n\
        outline = { loops = [[[0, 1], [2, 0, -1], [2, 3]], { points = [[1, 1, 0.5], [2, 2]] }] }";
    let l = 25.4;
    let wanted = [0.0, l, 2.0 * l, 0.0, -1.0, 2.0 * l, 3.0 * l, l, l, 0.5, 2.0 * l, 2.0 * l];
    assert_eq!(read::<JobFile>(bulged), wanted);
    let line = "units = \"in\"\n[[setup]]\n[[setup.operation]]\ntype = \"contour\"\n\
        polyline = [[0, 1], [2, 0, -1], [2, 3, 0.5]]";
    assert_eq!(read::<JobFile>(line), [0.0, l, 2.0 * l, 0.0, -1.0, 2.0 * l, 3.0 * l, 0.5]);
    let lines = "units = \"in\"\n[[setup]]\n[[setup.operation]]\ntype = \"contour\"\n\
        outline = { lines = [[[0, 1], [2, 0, -1], [2, 3]]] }";
    assert_eq!(read::<JobFile>(lines), [0.0, l, 2.0 * l, 0.0, -1.0, 2.0 * l, 3.0 * l]);
    assert_eq!(read::<JobFile>(job), [-90.0, 90.0, 0.0, 500.0, 0.005, 25.4, 1.0, 2.0, 3.0]);
    let machine = r#"
        units = "in"
        travel = { X = [0, 20], A = [-90, 90] }
        [axis.X]
        rapid = 1000
        acceleration = 100
        [axis.A]
        rapid = 10
        acceleration = 1000
        travel = [-5, 5]
        point = [1, 2, 3]
        [dynamics]
        jerk = 1000
        max_speed = 8000
        spindle_power = 5
    "#;
    let got = read::<MachineTable>(machine);
    let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
    let wanted = [
        vec![1000.0, 25.4, 50.8, 76.2, 10.0, -5.0, 5.0],
        vec![100.0 * 0.0254, 25_400.0],
        vec![1000.0 * 0.0254, 8000.0, 5.0],
        vec![-90.0, 90.0, 0.0, 508.0],
    ]
    .concat();
    assert!(got.len() == wanted.len() && got.iter().zip(&wanted).all(|(a, b)| close(*a, *b)), "{got:?}");
}

/// Every key with a number, with its factor: read by a person when it changes.
#[test]
fn every_number_of_every_file_has_its_factor() {
    let mut out = String::new();
    for (name, schema) in [
        ("job", file::schema()),
        ("machine", file::machine_schema()),
        ("tools", file::tools_schema()),
        ("cutting", file::cutting_schema()),
    ] {
        let mut lines = Vec::new();
        numbers_of(Form::of_root(&schema), &schema, name, &mut lines);
        lines.sort();
        lines.dedup();
        lines.iter().for_each(|line| _ = writeln!(out, "{line}"));
    }
    insta::assert_snapshot!("factors_of_inches", out);
}

fn numbers_of(root: Form<'_>, schema: &Value, name: &str, lines: &mut Vec<String>) {
    match schema {
        Value::Object(map) => {
            if schema["properties"].is_object() {
                for (key, form) in root.with(schema).keys() {
                    for choice in form.choices() {
                        leaf(choice, &format!("{name}.{key}"), lines);
                    }
                }
            }
            for (key, value) in map {
                let deeper = match key.as_str() {
                    "$defs" => "job".to_owned(),
                    "properties" | "items" | "oneOf" | "anyOf" | "additionalProperties" => name.to_owned(),
                    _ if name == "job" => key.clone(),
                    _ => format!("{name}.{key}"),
                };
                numbers_of(root, value, &deeper, lines);
            }
        }
        Value::Array(list) => {
            for value in list {
                let kind = value["properties"]["type"]["const"].as_str();
                let own = kind.map_or_else(|| name.to_owned(), |kind| format!("{name}[{kind}]"));
                numbers_of(root, value, &own, lines);
            }
        }
        _ => {}
    }
}

fn leaf(form: Form<'_>, name: &str, lines: &mut Vec<String>) {
    match form.kind() {
        Kind::List => {
            form.item().choices().into_iter().for_each(|item| leaf(item, &format!("{name}[]"), lines))
        }
        Kind::Number => {
            let of = |axis, at| {
                form.unit()
                    .and_then(|unit| factor(unit, Place { inch: true, axis, at, of_loops: false }))
                    .unwrap_or(1.0)
            };
            let all = [of("X", 0), of("X", 1), of("A", 0)];
            let shown = if all == [all[0]; 3] { format!("{}", all[0]) } else { format!("{all:?}") };
            lines.push(format!("{name}: {shown}"));
        }
        _ => {}
    }
}

#[test]
fn keys_of_one_name_and_two_units_have_no_factor() {
    let all = factors::<JobFile>();
    let of = |key: &str| all.get(key).copied();
    assert_eq!((of("depth"), of("feed"), of("cutting_speed")), (Some(25.4), Some(25.4), Some(0.3048)));
    assert_eq!((of("teeth"), of("point_angle"), of("speed"), of("travel")), (None, None, None, Some(25.4)));
    assert_eq!(factors::<CuttingFileTable>().get("diameter"), Some(&25.4));
    assert_eq!(factors::<ToolLibraryTable>().get("stickout"), Some(&25.4));
}
