//! Golden numbers of the grazing curve.

use std::f64::consts::PI;

use kinecut::machine::Twist;
use kinecut::sweep::{ChainPiece, Grazing, GrazingBranch, Motion, PieceKind, PieceShape, ProfileChain};
use kinecut::tool::{Contour, ContourElement, ElementRole};
use serde_json::Value;

use crate::common::golden::{self, vector};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn pair(value: &Value) -> [f64; 2] {
    [number(&value[0]), number(&value[1])]
}

fn role(value: &Value) -> ElementRole {
    match value.as_str().unwrap() {
        "cutting" => ElementRole::Cutting,
        "shank" => ElementRole::Shank,
        _ => ElementRole::Holder,
    }
}

fn element(value: &Value) -> ContourElement {
    match value["kind"].as_str().unwrap() {
        "line" => ContourElement::line(pair(&value["p0"]), pair(&value["p1"]), role(&value["role"])),
        _ => ContourElement::arc(
            pair(&value["c"]),
            number(&value["r"]),
            number(&value["phi0"]),
            number(&value["phi1"]),
            role(&value["role"]),
        ),
    }
}

fn chain(golden: &Value, tool: &str) -> ProfileChain {
    let elements = list(&golden["tools"][tool]["elements"]).iter().map(element).collect();
    ProfileChain::new(&Contour::new(elements).unwrap())
}

fn twist(case: &Value) -> Twist {
    Twist { turn: vector(&case["w"]), shift: vector(&case["v"]) }
}

fn near(a: f64, b: f64, tolerance: f64, what: &dyn Fn() -> String) {
    assert!((a - b).abs() <= tolerance, "{}: {a} is not {b}, off by {:e}", what(), (a - b).abs());
}

fn angle_near(a: f64, b: f64, tolerance: f64, what: &dyn Fn() -> String) {
    let off = (a - b + PI).rem_euclid(2.0 * PI) - PI;
    assert!(off.abs() <= tolerance, "{}: angle {a} is not {b}, off by {off:e}", what());
}

#[test]
fn chains_are_those_of_the_reference() {
    let golden = golden::file("sweep");
    let tools = golden["tools"].as_object().unwrap();
    assert_eq!(tools.len(), 12);
    for (name, tool) in tools {
        let chain = chain(&golden, name);
        let wanted = list(&tool["chain"]);
        assert_eq!(chain.pieces().len(), wanted.len(), "{name}");
        for (i, (piece, wanted)) in chain.pieces().iter().zip(wanted).enumerate() {
            let what = || format!("{name} piece {i}");
            assert_eq!(piece.role, role(&wanted["role"]), "{}", what());
            match piece.shape {
                PieceShape::Line { start, .. } => {
                    let end = piece.point(piece.to);
                    for (point, key) in [(start, "p0"), (end, "p1")] {
                        near(point.x, number(&wanted[key][0]), 1e-12, &what);
                        near(point.y, number(&wanted[key][1]), 1e-12, &what);
                    }
                    assert_eq!(piece.kind, PieceKind::Element);
                }
                PieceShape::Arc { centre, radius } => {
                    near(centre.x, number(&wanted["c"][0]), 1e-12, &what);
                    near(centre.y, number(&wanted["c"][1]), 1e-12, &what);
                    let sign = number(&wanted["s"]);
                    near(radius, number(&wanted["r"]) * sign, 1e-12, &what);
                    near(piece.from, number(&wanted["phi0"]), 1e-12, &what);
                    near(piece.to, number(&wanted["phi1"]), 1e-12, &what);
                    assert_eq!(piece.is_convex(), sign > 0.0, "{}", what());
                    assert_eq!(piece.is_fan(), wanted["edge"].as_bool().unwrap_or(false), "{}", what());
                    let pole = wanted["pole"].as_bool().unwrap_or(false);
                    assert_eq!(piece.kind == PieceKind::Pole, pole, "{}", what());
                }
            }
        }
    }
}

#[test]
fn normal_velocities_and_grazing_angles() {
    let golden = golden::file("sweep");
    let mut compared = 0;
    for case in list(&golden["cases"]) {
        let chain = chain(&golden, case["tool"].as_str().unwrap());
        let twist = twist(case);
        let size = twist.shift.length() + twist.turn.length() * chain.reach();
        for rows in list(&case["chain"]) {
            let index = rows["chain"].as_u64().unwrap() as usize;
            for sample in list(&rows["samples"]) {
                let what = || format!("{} piece {index} at {}", case["id"], sample["u"]);
                let u = number(&sample["u"]);
                let found = chain.normal_velocity(&twist, index, u);
                near(found.across.x, number(&sample["A"]), 1e-12 * size, &what);
                near(found.across.y, number(&sample["B"]), 1e-12 * size, &what);
                near(found.mean, number(&sample["C"]), 1e-12 * size, &what);
                let d = found.across.length_squared() - found.mean * found.mean;
                if d.abs() < 1e-9 * size * size || sample["theta"].is_string() {
                    continue;
                }
                let wanted: Vec<f64> = list(&sample["theta"]).iter().map(number).collect();
                assert_eq!(wanted.len(), if d > 0.0 { 2 } else { 0 }, "{}", what());
                for (theta, branch) in wanted.iter().zip(GrazingBranch::BOTH) {
                    angle_near(found.psi() + branch.sign() * found.alpha(), *theta, 1e-12, &what);
                    let e = found.directions(d.sqrt())[usize::from(branch == GrazingBranch::Minus)];
                    angle_near(e.y.atan2(e.x), *theta, 1e-12, &what);
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// The fold parameters that a grazing curve has on a piece.
fn folds(grazing: &Grazing, index: usize) -> Vec<f64> {
    let spans = grazing.spans.iter().filter(|s| s.piece == index);
    spans.flat_map(|s| [(s.from, s.folds[0]), (s.to, s.folds[1])]).filter(|f| f.1).map(|f| f.0).collect()
}

#[test]
fn curves_have_the_folds_windings_and_lengths() {
    let golden = golden::file("sweep");
    let cases = list(&golden["cases"]);
    assert_eq!(cases.len(), 28);
    for case in cases {
        let id = case["id"].as_str().unwrap();
        let chain = chain(&golden, case["tool"].as_str().unwrap());
        let grazing = chain.grazing(&twist(case));
        let whole: Vec<usize> =
            list(&case["all_grazing_elements"]).iter().map(|v| v.as_u64().unwrap() as usize).collect();
        assert_eq!(grazing.whole, whole, "{id}");
        let circles = list(&case["full_circles"]);
        assert_eq!(grazing.circles.len(), circles.len(), "{id}: {:?}", grazing.circles);
        for (found, wanted) in grazing.circles.iter().zip(circles) {
            assert_eq!(found.0 as u64, wanted["chain"].as_u64().unwrap(), "{id}");
            near(found.1, number(&wanted["u"]), 1e-10, &|| format!("{id} circle"));
        }
        let wanted_status = case["status"].as_str().unwrap();
        let status = match (grazing.loops.is_empty(), grazing.is_degenerate()) {
            (false, false) => "generic",
            (false, true) => "generic+degenerate",
            (true, _) => "degenerate",
        };
        assert_eq!(status, wanted_status, "{id}");
        let across = !matches!(grazing.motion, Motion::General) && twist(case).shift.z == 0.0;
        for rows in list(&case["chain"]) {
            let index = rows["chain"].as_u64().unwrap() as usize;
            if rows["fold_status"] == "simple" && !across {
                let piece = &chain.pieces()[index];
                let mut wanted: Vec<f64> = list(&rows["fold_u"]).iter().map(number).collect();
                // A fold on the axis, where all of the piece but its end has points, is none of the piece's inside.
                wanted.retain(|u| (u - piece.from).abs() > 1e-10 && (u - piece.to).abs() > 1e-10);
                let mut found = folds(&grazing, index);
                found.retain(|u| (u - piece.from).abs() > 1e-10 && (u - piece.to).abs() > 1e-10);
                assert_eq!(found.len(), wanted.len(), "{id} piece {index}: {found:?} {wanted:?}");
                for (a, b) in found.iter().zip(&wanted) {
                    near(*a, *b, 1e-10, &|| format!("{id} piece {index} fold"));
                }
            }
        }
        let loops = list(&case["loops"]);
        assert_eq!(grazing.loops.len() as u64, case["n_loops"].as_u64().unwrap(), "{id}");
        assert_eq!(2 * grazing.spans.len() as u64, case["n_segments"].as_u64().unwrap(), "{id}");
        for (found, wanted) in grazing.loops.iter().zip(loops) {
            assert_eq!(u64::from(found.winding), wanted["winding"].as_u64().unwrap(), "{id}");
            assert_eq!(2 * found.spans.len() as u64, wanted["n_branches"].as_u64().unwrap(), "{id}");
            assert_eq!(found.closed, wanted["kind"] != "open", "{id} {}", wanted["kind"]);
            let (length, known) = (chain.loop_length(&grazing, found), number(&wanted["length"]));
            near(length, known, 1e-9 * known, &|| format!("{id} length"));
        }
    }
}

/// Length of the angle intervals of an edge.
#[test]
fn edges_have_the_arcs_on_which_their_faces_part() {
    let golden = golden::file("sweep");
    let mut compared = 0;
    for case in list(&golden["cases"]).iter().filter(|c| c["status"] == "generic") {
        let chain = chain(&golden, case["tool"].as_str().unwrap());
        let grazing = chain.grazing(&twist(case));
        for rows in list(&case["chain"]).iter().filter(|r| r["edge_length"].is_number()) {
            let index = rows["chain"].as_u64().unwrap() as usize;
            let spans = grazing.spans.iter().filter(|s| s.piece == index);
            let length: f64 = spans.map(|s| chain.span_lengths(s).iter().sum::<f64>()).sum();
            let known = number(&rows["edge_length"]);
            near(length, known, 1e-9 * known.max(1.0), &|| format!("{} edge {index}", case["id"]));
            compared += 1;
        }
    }
    assert!(compared > 30, "{compared}");
}

/// The velocity of a point is tangential where the curve passes, and the curve is closed.
#[test]
fn points_of_the_curves_graze() {
    let golden = golden::file("sweep");
    for case in list(&golden["cases"]) {
        let id = case["id"].as_str().unwrap();
        let chain = chain(&golden, case["tool"].as_str().unwrap());
        let twist = twist(case);
        let size = twist.shift.length() + twist.turn.length() * chain.reach();
        let grazing = chain.grazing(&twist);
        for curve in &grazing.loops {
            let points = chain.curve(&grazing, curve, 1e-3);
            for p in &points {
                let velocity = twist.shift + twist.turn.cross(p.point);
                let off = p.normal.dot(velocity).abs();
                assert!(off <= 1e-12 * size, "{id} piece {} {:?} {}: {off:e}", p.piece, p.branch, p.u);
                assert!((p.normal.length() - 1.0).abs() < 1e-14);
            }
            for pair in points.windows(2) {
                let same_circle =
                    on_whole_circle(&grazing, &chain.pieces()[pair[0].piece as usize], pair[0].piece);
                let far = (pair[1].point - pair[0].point).length();
                assert!(same_circle || far < 16.0, "{id}: {far} between {:?} and {:?}", pair[0], pair[1]);
            }
            if curve.closed {
                let (first, last) = (points[0], points[points.len() - 1]);
                assert!(
                    (first.point - last.point).length() < 1e-7,
                    "{id}: open by {}",
                    (first.point - last.point).length()
                );
            }
        }
    }
}

fn on_whole_circle(grazing: &Grazing, _: &ChainPiece, piece: u32) -> bool {
    grazing.circles.iter().any(|c| c.0.abs_diff(piece as usize) <= 1)
}
