//! Tools and motions of the golden file.

use glam::{DMat3, DVec3};
use kinecut::geom::{Line, Rigid};
use kinecut::machine::kinematics::Twist;
use kinecut::machine::{Elementary, Joint, Kinematics};
use kinecut::sweep::ToolMotion;
use kinecut::tool::{Contour, ContourElement, ElementRole};
use serde_json::Value;

use super::golden::{numbers, vector};

/// The contour of a tool of the file.
pub(crate) fn contour(golden: &Value, name: &str) -> Contour {
    let elements = golden["tools"][name]["elements"].as_array().unwrap();
    let pair = |v: &Value| <[f64; 2]>::try_from(numbers(v)).unwrap();
    let number = |v: &Value| v.as_f64().unwrap();
    Contour::new(
        elements
            .iter()
            .map(|e| {
                let role = match e["role"].as_str().unwrap() {
                    "cutting" => ElementRole::Cutting,
                    "shank" => ElementRole::Shank,
                    _ => ElementRole::Holder,
                };
                if e["kind"] == "line" {
                    ContourElement::line(pair(&e["p0"]), pair(&e["p1"]), role)
                } else {
                    let (r, from, to) = (number(&e["r"]), number(&e["phi0"]), number(&e["phi1"]));
                    ContourElement::arc(pair(&e["c"]), r, from, to, role)
                }
            })
            .collect(),
    )
    .unwrap()
}

/// Two rotary tables, C outside of A, about one pivot, and three linear axes.
pub(crate) fn trunnion(pivot: DVec3) -> Kinematics {
    let rotary = |motion, letter, direction| Joint {
        letter,
        direction,
        point: pivot,
        sense: 1.0,
        ..Joint::standard(motion)
    };
    let linear =
        |motion, letter, direction| Joint { letter, direction, sense: 1.0, ..Joint::standard(motion) };
    let joints = [
        rotary(Elementary::C, 'C', DVec3::Z),
        rotary(Elementary::A, 'A', DVec3::X),
        linear(Elementary::X, 'X', DVec3::X),
        linear(Elementary::Y, 'Y', DVec3::Y),
        linear(Elementary::Z, 'Z', DVec3::Z),
    ];
    Kinematics::new(&joints, Rigid::IDENTITY, Rigid::IDENTITY)
}

/// A motion of the file.
pub(crate) fn motion(m: &Value) -> ToolMotion {
    match m["kind"].as_str().unwrap() {
        "TcpSlerp" => {
            let rows: Vec<DVec3> = m["R0"].as_array().unwrap().iter().map(vector).collect();
            let start = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
            let line = Line { start: vector(&m["p0"]), end: vector(&m["p1"]) };
            ToolMotion::turning(line.into(), start, vector(&m["W"])).unwrap()
        }
        "TrunnionAC" => {
            let order = |v: &Value| {
                let q = numbers(v);
                [q[4], q[3], q[0], q[1], q[2]]
            };
            let (from, to) = (order(&m["q0"]), order(&m["q1"]));
            ToolMotion::joints(trunnion(vector(&m["pivot"])), &from, &to).unwrap()
        }
        "Screw" => {
            let twist = Twist { turn: vector(&m["w"]), shift: vector(&m["v"]) };
            ToolMotion::screw(Rigid::IDENTITY, twist).unwrap()
        }
        other => panic!("motion {other}"),
    }
}
