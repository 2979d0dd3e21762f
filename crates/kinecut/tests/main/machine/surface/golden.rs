//! Surfaces, their codes and redistributions against the golden values of the reference implementation.

use std::collections::BTreeMap;

use glam::DVec3;
use kinecut::machine::formula::Expression;
use kinecut::machine::surface::{
    Candidate, ChainElement, GeneratedSurface, Retreat, Sample, SetupMotion, Slide, Split, SplitOptions,
    ToolKind, arrangements, catalogue, chain_text, parse_chain, sliding_group, word,
};
use kinecut::machine::{Elementary, Word};
use serde_json::Value;

use crate::common::golden::{self, vector};

/// Name in the catalogue of a surface of the golden file.
fn name(id: &str) -> &str {
    match id {
        "plane_xy" => "plane",
        "plane_polar" => "plane-facing",
        "sphere_cup" => "sphere-ring",
        "elliptic_cyl" => "elliptic-cylinder",
        "hyp_paraboloid" => "hyperbolic-paraboloid",
        "helicoid" => "right-helicoid",
        "helicoid_inclined" => "inclined-helicoid",
        "cyl_cam" => "cylindrical-cam",
        "involute" => "involute-cylinder",
        other => other,
    }
}

fn elements(value: &Value) -> Vec<ChainElement> {
    let element = |pair: &Value| {
        let motion = Elementary::from_digit(pair[0].as_u64().unwrap() as u8).unwrap();
        ChainElement::new(motion, Expression::parse(pair[1].as_str().unwrap()).unwrap())
    };
    value.as_array().unwrap().iter().map(element).collect()
}

/// Chains as text in one notation, so that `t**2` and `t^2` compare equal.
fn text(value: &Value) -> String {
    chain_text(&elements(value))
}

fn strings(value: &Value) -> Vec<String> {
    value.as_array().unwrap().iter().map(|s| s.as_str().unwrap().to_owned()).collect()
}

fn digits(value: &Value) -> Vec<u8> {
    value.as_array().unwrap().iter().map(|d| d.as_u64().unwrap() as u8).collect()
}

fn surfaces() -> Vec<(Value, GeneratedSurface)> {
    let golden = golden::file("kinematics");
    let list = golden["surfaces"].as_array().unwrap();
    assert!(list.len() >= 14);
    list.iter()
        .map(|s| (s.clone(), GeneratedSurface::named(name(s["id"].as_str().unwrap())).unwrap()))
        .collect()
}

#[test]
fn catalogue_has_the_definitions_of_the_golden_file() {
    for (wanted, surface) in surfaces() {
        let id = &wanted["id"];
        let parameters: BTreeMap<String, f64> = surface.parameters.iter().cloned().collect();
        for (key, value) in wanted["params"].as_object().unwrap() {
            assert!((parameters[key] - value.as_f64().unwrap()).abs() < 1e-12, "{id} {key}");
        }
        assert_eq!(parameters.len(), wanted["params"].as_object().unwrap().len(), "{id}");
        for variable in &surface.variables {
            let domain = &wanted["vars"][&variable.name];
            assert_eq!(
                [domain[0].as_f64(), domain[1].as_f64()],
                [Some(variable.from), Some(variable.to)],
                "{id}"
            );
        }
        assert_eq!(surface.overlap() as u64, wanted["overlap"].as_u64().unwrap(), "{id}");
        assert_eq!(chain_text(&surface.chain()), text(&wanted["chain"]), "{id}");
        assert_eq!(surface.code().to_string(), wanted["code"].as_str().unwrap(), "{id}");
        assert_eq!(word(&surface.canonical()).to_string(), wanted["normal_form"].as_str().unwrap(), "{id}");
        let chains = arrangements(&surface.code()).len() as u64;
        assert_eq!(chains, wanted["layouts"]["chains"].as_u64().unwrap(), "{id}");
        let with_bed = chains * (surface.chain().len() as u64 + 1);
        assert_eq!(with_bed, wanted["layouts"]["with_bed"].as_u64().unwrap(), "{id}");
    }
}

#[test]
fn points_and_normals_are_golden() {
    // The golden file has twelve digits of coordinates up to some ten mm.
    let bound = 2e-11;
    for (wanted, surface) in surfaces() {
        let shape = surface.compiled().unwrap();
        for sample in wanted["samples"].as_array().unwrap() {
            let [u, v] = [0, 1].map(|k| sample["v"][k].as_f64().unwrap());
            let point = shape.point(u, v);
            assert!(point.distance(vector(&sample["p"])) < 10.0 * bound, "{} {point}", surface.name);
            assert!(shape.frame(u, v).translation.distance(point) < 1e-13 * (1.0 + point.length()));
            let normal = shape.normal(u, v).unwrap();
            assert!(
                normal.distance(vector(&sample["n"])) < bound,
                "{} {u} {v} {normal} {}",
                surface.name,
                sample["n"]
            );
        }
    }
}

/// Chains that rest on nothing but the definition: the product of 4x4 matrices written out, and its differences.
#[test]
fn points_are_products_of_matrices_and_tangents_their_differences() {
    for surface in catalogue() {
        let shape = surface.compiled().unwrap();
        let at = |u: f64, v: f64| {
            surface.chain().iter().fold(glam::DMat4::IDENTITY, |m, e| {
                let names: Vec<String> = surface.parameters.iter().map(|(n, _)| n.clone()).collect();
                let mut values: Vec<f64> = surface.parameters.iter().map(|(_, x)| *x).collect();
                values.extend([u, v]);
                let mut names: Vec<&str> = names.iter().map(String::as_str).collect();
                names.extend(surface.variables.iter().map(|v| v.name.as_str()));
                m * matrix(e.motion.digit(), e.law.bind(&names).unwrap().value(&values))
            })
        };
        for (a, b) in [(0.1, 0.9), (0.37, 0.21), (0.8, 0.6)] {
            let (u, v) = (surface.variables[0].at(a), surface.variables[1].at(b));
            let jet = shape.jet(u, v);
            let point = |u: f64, v: f64| at(u, v).transform_point3(DVec3::ZERO);
            assert!(
                jet.point().distance(point(u, v)) < 1e-12 * (1.0 + jet.point().length()),
                "{}",
                surface.name
            );
            let h = 1e-5;
            let by_u = (point(u + h, v) - point(u - h, v)) / (2.0 * h);
            let by_v = (point(u, v + h) - point(u, v - h)) / (2.0 * h);
            assert!(jet.tangents[0].distance(by_u) < 1e-6, "{} {} {by_u}", surface.name, jet.tangents[0]);
            assert!(jet.tangents[1].distance(by_v) < 1e-6, "{} {} {by_v}", surface.name, jet.tangents[1]);
            let rotation = |u: f64, v: f64| glam::DMat3::from_mat4(at(u, v));
            let rate = (rotation(u + h, v) - rotation(u - h, v)) * (0.5 / h) * rotation(u, v).transpose();
            let spin = DVec3::new(rate.y_axis.z, rate.z_axis.x, rate.x_axis.y);
            assert!(jet.spins[0].distance(spin) < 1e-8, "{} {} {spin}", surface.name, jet.spins[0]);
        }
    }
}

fn matrix(k: u8, q: f64) -> glam::DMat4 {
    let (s, c) = q.sin_cos();
    let rows: [[f64; 4]; 3] = match k {
        1 => [[1.0, 0.0, 0.0, q], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
        2 => [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, q], [0.0, 0.0, 1.0, 0.0]],
        3 => [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, q]],
        4 => [[1.0, 0.0, 0.0, 0.0], [0.0, c, -s, 0.0], [0.0, s, c, 0.0]],
        5 => [[c, 0.0, s, 0.0], [0.0, 1.0, 0.0, 0.0], [-s, 0.0, c, 0.0]],
        _ => [[c, -s, 0.0, 0.0], [s, c, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
    };
    glam::DMat4::from_cols_array_2d(&[rows[0], rows[1], rows[2], [0.0, 0.0, 0.0, 1.0]]).transpose()
}

#[test]
fn implicit_equations_vanish_and_grow_along_the_normal() {
    let mut checked = 0;
    for surface in catalogue() {
        let Some(implicit) = &surface.implicit else { continue };
        let bound = surface.with_numbers(implicit).bind(&["X", "Y", "Z"]).unwrap();
        let value = |p: DVec3| bound.value(&p.to_array());
        let shape = surface.compiled().unwrap();
        for i in 0..9 {
            for j in 0..9 {
                let [u, v] = [
                    surface.variables[0].at(f64::from(i) / 8.0),
                    surface.variables[1].at(f64::from(j) / 8.0),
                ];
                // The equations of screws and scrolls hold for the half turn on either side of X.
                let point = shape.point(u, v);
                assert!(value(point).abs() < 1e-9, "{} {u} {v} {}", surface.name, value(point));
                let normal = shape.normal(u, v).unwrap();
                let step = 1e-4;
                let grows = value(point + normal * step) - value(point - normal * step);
                assert!(grows > 0.0, "{} {u} {v} {grows}", surface.name);
            }
        }
        checked += 1;
    }
    assert_eq!(checked, 18); // all but the ruled one
}

fn tool_type(split: &Split) -> Option<&'static str> {
    split.tool_kind.map(|kind| match kind {
        ToolKind::Point => "point",
        ToolKind::StraightEdge => "edge-straight",
        ToolKind::ProfiledEdge => "edge-profiled",
        ToolKind::Surface => "surface",
    })
}

fn check_candidate(found: &Candidate, wanted: &Value, what: &str) {
    let motion = match found.retreat {
        Retreat::Slide(Slide::Turn { pitch, .. }) => {
            let pitch_golden = wanted["pitch_per_rad"].as_f64().unwrap();
            assert!((pitch - pitch_golden).abs() < 1e-9, "{what} {pitch}");
            "screw".to_owned()
        }
        Retreat::Slide(Slide::Shift { .. }) => "translation".to_owned(),
        link @ Retreat::Link { .. } => link.to_string(),
    };
    assert_eq!(motion, wanted["motion"].as_str().unwrap(), "{what}");
    assert_eq!(found.source.name(), wanted["source"].as_str().unwrap(), "{what}");
    assert_eq!(found.verdict.name(), wanted["verdict"].as_str().unwrap(), "{what}");
    if let Some(margin) = wanted["margin"].as_f64() {
        assert!((found.margin - margin).abs() < 1e-10, "{what} {} {margin}", found.margin);
    }
}

fn check_setup(setup: &SetupMotion, wanted: &Value, what: &str) {
    assert_eq!(setup.needed, wanted["needed"].as_bool().unwrap(), "{what}");
    if !setup.needed {
        return;
    }
    let candidates = wanted["candidates"].as_array().unwrap();
    assert_eq!(setup.candidates.len(), candidates.len(), "{what}");
    setup.candidates.iter().zip(candidates).for_each(|(found, wanted)| check_candidate(found, wanted, what));
    assert_eq!(setup.chosen.is_some(), !wanted["chosen"].is_null(), "{what}");
    if let Some(chosen) = &setup.chosen {
        check_candidate(chosen, &wanted["chosen"], what);
    }
    assert_eq!(setup.sliding.map(|n| n as u64), wanted["sliding_group_dim"].as_u64(), "{what}");
}

#[test]
fn splits_are_golden_in_all_fields() {
    let options = SplitOptions { samples: 9, refine: false };
    let mut compared = 0;
    for (wanted, surface) in surfaces() {
        let splits = surface.splits_with(&options).unwrap();
        let golden = wanted["splits"].as_array().unwrap();
        assert_eq!(splits.len() as u64, wanted["n_splits"].as_u64().unwrap(), "{}", surface.name);
        assert_eq!(
            splits.iter().filter(|s| s.is_valid()).count() as u64,
            wanted["n_valid"].as_u64().unwrap()
        );
        assert_eq!(
            splits.iter().filter(|s| s.is_suffix()).count() as u64,
            wanted["n_suffix_splits"].as_u64().unwrap()
        );
        let mut left: Vec<&Value> = golden.iter().collect();
        for split in &splits {
            let (machine, tool) = (chain_text(&split.machine), chain_text(&split.tool));
            let what = format!("{}: {machine} | {tool}", surface.name);
            let at = left.iter().position(|g| text(&g["machine"]) == machine && text(&g["tool"]) == tool);
            let g = left.remove(at.unwrap_or_else(|| panic!("{what} is not golden")));
            assert_eq!(split.machine_code().to_string(), g["machine_code"].as_str().unwrap(), "{what}");
            assert_eq!(split.tool_code().to_string(), g["tool_code"].as_str().unwrap(), "{what}");
            let motions = |m: &[Elementary]| m.iter().map(|m| m.digit()).collect::<Vec<_>>();
            assert_eq!(motions(&split.forming), digits(&g["forming"]), "{what}");
            assert_eq!(motions(&split.setting), digits(&g["setting"]), "{what}");
            assert_eq!(split.machine_variables, strings(&g["machine_vars"]), "{what}");
            assert_eq!(split.tool_variables, strings(&g["tool_vars"]), "{what}");
            let links = g["complex_motions"].as_array().unwrap();
            assert_eq!(split.links.len(), links.len(), "{what}");
            for (link, wanted) in split.links.iter().zip(links) {
                assert_eq!(link.variable, wanted["var"].as_str().unwrap(), "{what}");
                assert_eq!(link.kind.name(), wanted["kind"].as_str().unwrap(), "{what}");
                let codes: Vec<u8> = link.elements.iter().map(|e| e.motion.digit()).collect();
                assert_eq!(codes, digits(&wanted["codes"]), "{what}");
                let laws: Vec<String> = link.elements.iter().map(|e| e.law.to_string()).collect();
                let golden: Vec<String> = strings(&wanted["laws"])
                    .iter()
                    .map(|l| Expression::parse(l).unwrap().to_string())
                    .collect();
                assert_eq!(laws, golden, "{what}");
            }
            assert_eq!(split.is_valid(), g["valid"].as_bool().unwrap(), "{what}");
            assert_eq!(tool_type(split), g["tool_type"].as_str(), "{what}");
            if split.is_valid() {
                assert_eq!(chain_text(&split.built_in), text(&g["built_in_constants"]), "{what}");
                check_setup(&split.setup, &g["plunge"], &what);
                assert_eq!(split.process, g["process"].as_str().unwrap(), "{what}");
            } else {
                assert!(split.remarks[0].contains("not be rigid"), "{what}");
            }
            compared += 1;
        }
        assert!(left.is_empty(), "{}", surface.name);
    }
    assert!(compared >= 100, "{compared}");
}

/// Closer samples, and the search between them, may only lower a margin; no verdict of the golden file changes.
#[test]
fn closer_looks_keep_the_verdicts() {
    for surface in catalogue() {
        let coarse = surface.splits_with(&SplitOptions { samples: 9, refine: false }).unwrap();
        let close = surface.splits().unwrap();
        for (a, b) in coarse.iter().zip(&close) {
            assert_eq!(a.process, b.process, "{}", surface.name);
            for (x, y) in a.setup.candidates.iter().zip(&b.setup.candidates) {
                assert!(y.margin <= x.margin + 1e-9, "{} {x:?} {y:?}", surface.name);
            }
        }
    }
}

/// The table of the specification, which has more surfaces than the golden file.
#[test]
fn counts_are_those_of_the_table() {
    let table: [(&str, &str, [usize; 3], usize, usize); 19] = [
        ("plane", "321", [4, 8, 8], 24, 3),
        ("plane-facing", "361", [4, 6, 6], 12, 3),
        ("cylinder", "613", [4, 6, 6], 12, 2),
        ("cone", "6153", [5, 5, 5], 5, 1),
        ("sphere", "653", [4, 4, 4], 4, 3),
        ("sphere-ring", "65361", [6, 8, 8], 18, 3),
        ("torus", "6151", [5, 5, 5], 5, 1),
        ("revolution", "613", [4, 6, 3], 12, 1),
        ("extrusion", "123", [4, 8, 4], 24, 1),
        ("elliptic-cylinder", "61613", [6, 10, 6], 30, 1),
        ("hyperbolic-paraboloid", "142", [4, 6, 3], 12, 0),
        ("ruled", "123653", [7, 12, 3], 56, 0),
        ("right-helicoid", "631", [4, 6, 3], 12, 1),
        ("inclined-helicoid", "63151", [6, 8, 5], 18, 1),
        ("screw", "6313", [5, 12, 3], 30, 1),
        ("cylindrical-cam", "631", [4, 6, 3], 12, 0),
        ("involute-cylinder", "6123", [5, 10, 6], 40, 1),
        ("hyperboloid", "6143", [5, 7, 7], 15, 1),
        ("scroll", "613", [4, 6, 4], 12, 1),
    ];
    assert_eq!(
        table.map(|row| row.0).to_vec(),
        catalogue().iter().map(|s| s.name.as_str()).collect::<Vec<_>>()
    );
    for (name, code, [suffix, all, valid], layouts, dimension) in table {
        let surface = GeneratedSurface::named(name).unwrap();
        assert_eq!(surface.code(), Word::parse(code).unwrap());
        let splits = surface.splits().unwrap();
        let counts = [splits.iter().filter(|s| s.is_suffix()).count(), splits.len()];
        assert_eq!(counts, [suffix, all], "{name}");
        assert_eq!(splits.iter().filter(|s| s.is_valid()).count(), valid, "{name}");
        assert_eq!(arrangements(&surface.code()).len() * (code.len() + 1), layouts, "{name}");
        let group = sliding_group(&samples(&surface, 9), 0.0).unwrap();
        assert_eq!(group.form.dimension(), dimension, "{name} {group:?}");
    }
}

fn samples(surface: &GeneratedSurface, n: usize) -> Vec<Sample> {
    let shape = surface.compiled().unwrap();
    let at = |i: usize| i as f64 / (n - 1) as f64;
    let place = |k: usize| (surface.variables[0].at(at(k / n)), surface.variables[1].at(at(k % n)));
    let sample = |(u, v): (f64, f64)| {
        shape.normal(u, v).map(|normal| Sample { point: shape.point(u, v), normal, weight: 1.0 })
    };
    (0..n * n).map(place).filter_map(sample).collect()
}

/// Each element of a split put back gives the chain: machine then tool is an arrangement of the whole.
#[test]
fn machine_and_tool_make_the_surface_again() {
    for surface in catalogue() {
        let whole = surface.compiled().unwrap();
        for split in surface.splits().unwrap() {
            let mut parts = surface.clone();
            parts.directrix = split.machine.clone();
            parts.generatrix = Vec::new();
            parts.directrix.extend(split.tool.clone());
            let again = parts.compiled().unwrap();
            let (u, v) = (surface.variables[0].at(0.3), surface.variables[1].at(0.7));
            assert!(again.point(u, v).distance(whole.point(u, v)) < 1e-12 * 100.0, "{}", surface.name);
        }
    }
}

#[test]
fn errata_of_the_paper_hold() {
    // The cone with the paper's sign of the rotation about Y opens outwards.
    let cone = GeneratedSurface::named("cone").unwrap();
    let mut wrong = cone.clone();
    wrong.generatrix = parse_chain("1(R) 5(alpha) 3(z)").unwrap();
    let z = 50.0;
    let [right, wrong] = [&cone, &wrong].map(|s| s.compiled().unwrap().point(1.0, z).truncate().length());
    let sine = 0.35_f64.sin();
    assert!((right - (30.0 - z * sine)).abs() < 1e-12 && (wrong - (30.0 + z * sine)).abs() < 1e-12);
    let point = cone.compiled().unwrap().point(1.0, 20.0);
    assert!(point.distance(DVec3::new(12.503_699_655_1, 19.473_358_429_7, 18.787_454_256_9)) < 1e-9);
}
