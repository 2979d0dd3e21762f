//! Golden numbers of involute hole milling, from an independent reference.
//!
//! Rule, as the file prints it: pass when `|a - b| <= rel_tol * max(|b|, S)`, with `S` the largest length in the
//! input for lengths, 1 for angles and counts, `1/S` for curvature; angles modulo 2 pi. Derivatives of curvature
//! are held to `1/S^2`. A kind or a key that this harness does not know fails.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use kinecut::geom::{InvoluteRecord, arc_chain, arcs_needed, biarcs_needed, chord_rolls, chords_needed};
use kinecut::holes::{roll, spiral};
use serde_json::Value;

fn number(v: &Value) -> f64 {
    v.as_f64().expect("a number")
}

fn list(v: &Value) -> &[Value] {
    v.as_array().expect("a list")
}

struct Case<'a> {
    id: &'a str,
    input: &'a Value,
    expect: &'a Value,
    tol: f64,
    /// Largest length of the input [mm].
    size: f64,
    /// What was found, by key.
    found: BTreeMap<&'static str, Value>,
}

impl Case<'_> {
    fn input(&self, key: &str) -> f64 {
        self.input[key].as_f64().unwrap_or_else(|| panic!("{}: no input {key}", self.id))
    }

    fn record(&self) -> InvoluteRecord {
        let v: Vec<f64> = list(&self.input["record"]).iter().map(number).collect();
        InvoluteRecord::new(v[0], [v[1], v[2]], v[3], v[4], v[5]).expect("a record")
    }

    fn put(&mut self, key: &'static str, value: impl Into<Value>) {
        assert!(self.found.insert(key, value.into()).is_none(), "{key} twice");
    }

    fn near(&self, key: &str, found: f64, expected: f64) {
        let angle = matches!(key, "phi" | "psi" | "theta0" | "theta" | "circle_theta");
        let scale = match key {
            "phi0" | "n_visible" | "n_visible_paper" | "n" | "turns" | "AR_deg" => 1.0,
            "arcs" | "chords" | "biarcs" | "phi_1" | "phi_mid" => 1.0,
            "k" | "dk_jump" => 1.0 / self.size,
            "dk_ds" | "dk_ds_jump" => 1.0 / (self.size * self.size),
            _ if angle => 1.0,
            _ => self.size,
        };
        let difference = if angle { kinecut::num::angle::wrap(found - expected) } else { found - expected };
        let mut allowed = self.tol * expected.abs().max(scale);
        // Ill conditioned: the case gives the slope dphi/dt and allows a few ulp of t through it; t itself is
        // printed with 15 digits.
        if let Some(slope) = self.expect["dphi_dt"].as_f64() {
            let t = self.input("t");
            let printed = 0.5 * 10f64.powf(t.log10().floor() - 14.0);
            allowed = allowed.min(1e-13 * expected + slope * (t * 1e-15 + printed));
        }
        assert!(
            difference.abs() <= allowed,
            "{} {key}: {found} instead of {expected}, off by {difference:e}, allowed {allowed:e}",
            self.id
        );
    }

    /// The six numbers of a record; the fourth is an angle.
    fn near_record(&self, found: &[Value], expected: &[Value]) {
        assert_eq!(found.len(), 6);
        for (i, (a, b)) in found.iter().zip(expected).enumerate() {
            self.near(if i == 3 { "theta0" } else { "length" }, number(a), number(b));
        }
    }

    fn compare(&self) {
        let expect = self.expect.as_object().expect("an object");
        let mut checked = 0;
        for (key, expected) in expect {
            if key == "dphi_dt" {
                continue;
            }
            let found =
                self.found.get(key.as_str()).unwrap_or_else(|| panic!("{}: key {key} unknown", self.id));
            match (found, expected) {
                (Value::Number(_), Value::Number(_)) => {
                    self.near(key, number(found), number(expected));
                }
                (Value::Array(a), Value::Array(b)) if b.len() == 6 => self.near_record(a, b),
                (Value::Array(a), Value::Array(b)) => {
                    assert_eq!(a.len(), b.len());
                    a.iter().zip(b).for_each(|(a, b)| self.near(key, number(a), number(b)));
                }
                (a, b) => assert_eq!(a, b, "{} {key}", self.id),
            }
            checked += 1;
        }
        assert!(checked > 0, "{}: nothing checked", self.id);
    }
}

fn six(r: &InvoluteRecord) -> Value {
    serde_json::json!([
        r.length(),
        r.start().x,
        r.start().y,
        r.start_angle(),
        r.start_radius(),
        r.end_radius()
    ])
}

fn solve(kind: &str, c: &mut Case) {
    match kind {
        "roll" => {
            let roll = roll::roll_angle(c.input("t")).expect("valid input");
            assert!(roll.iterations <= roll::MAX_ITERATIONS);
            c.put("phi", roll.angle);
        }
        "record" => {
            let (record, s) = (c.record(), c.input("s"));
            let (jet, centre) = (record.at(s), record.base_centre());
            c.put("x", jet.p.x);
            c.put("y", jet.p.y);
            c.put("theta", jet.angle);
            c.put("k", jet.curvature);
            c.put("dk_ds", jet.curvature_slope);
            c.put("base_radius", record.base_radius().abs());
            c.put("base_x", centre.x);
            c.put("base_y", centre.y);
        }
        "split" => {
            let (first, second) = c.record().split(c.input("s"));
            c.put("first", six(&first));
            c.put("second", six(&second));
        }
        "reverse" => c.put("record", six(&c.record().reversed())),
        "rough" => {
            let radius = spiral::path_radius(c.input("D_hole"), c.input("D_cutter"), c.input("delta"))
                .expect("valid input");
            let n = spiral::turns(radius, c.input("H_max")).expect("valid input");
            let record = spiral::from_centre(radius, n, 0.0).expect("valid input");
            let circle = spiral::circle(radius, 0.0).expect("valid input");
            let (end, next) = (record.at(record.length()), circle.at(0.0));
            c.put("R", radius);
            c.put("n", n);
            c.put("H", TAU * record.base_radius());
            c.put("r", record.base_radius());
            c.put("L", record.length());
            c.put("circle_L", circle.length());
            c.put("Rn", record.start_radius());
            c.put("Rk", record.end_radius());
            c.put("start", record.start().to_array().to_vec());
            c.put("circle_start", circle.start().to_array().to_vec());
            c.put("circle_theta", circle.start_angle());
            c.put("dk_jump", next.curvature - end.curvature);
            c.put("dk_ds_jump", next.curvature_slope - end.curvature_slope);
        }
        "lead_in" => {
            let lead =
                spiral::lead_in(c.input("R"), c.input("n") as u32, [c.input("x0"), c.input("y0")], 0.0)
                    .expect("valid input");
            let (end, centre) = (lead.record.at(lead.record.length()), lead.record.base_centre());
            c.put("r", lead.base_radius);
            c.put("phi0", lead.roll);
            c.put("psi", lead.psi);
            c.put("theta0", lead.record.start_angle());
            c.put("L", lead.record.length());
            c.put("Rn", lead.record.start_radius());
            c.put("Rk", lead.record.end_radius());
            c.put("n_visible", lead.turns);
            let distance = c.input("x0").hypot(c.input("y0"));
            let printed = spiral::turns_as_printed(c.input("R"), c.input("n") as u32, distance);
            c.put("n_visible_paper", printed);
            c.put("tangent_x", end.p.x);
            c.put("tangent_y", end.p.y);
            c.put("base_x", centre.x);
            c.put("base_y", centre.y);
            c.put("dk_ds_jump", -end.curvature_slope);
        }
        "lead_in_cw" => {
            let lead =
                spiral::lead_in(c.input("R"), c.input("n") as u32, [-c.input("x0"), c.input("y0")], 0.0)
                    .expect("valid input");
            c.put("record", six(&lead.record.mirrored()));
            c.put("circle", six(&spiral::circle(c.input("R"), lead.psi).expect("valid input").mirrored()));
        }
        "involute_block" => {
            let block = c.record().block().expect("valid input");
            c.put("word", if block.ccw { "INVCCW" } else { "INVCW" });
            c.put("fanuc", if block.ccw { "G03.2" } else { "G02.2" });
            c.put("X", block.end.x);
            c.put("Y", block.end.y);
            c.put("I", block.centre.x);
            c.put("J", block.centre.y);
            c.put("CR", block.base_radius);
            c.put("AR_deg", block.opening.to_degrees());
            c.put("away", block.away);
            c.put("turns", block.turns);
        }
        "segmentation" => {
            let n = c.input("n") as u32;
            let record = spiral::from_centre(c.input("R"), n, 0.0).expect("valid input");
            let needed = arcs_needed(record.base_radius(), TAU * f64::from(n), c.input("eps"));
            let chain = arc_chain(&record, c.input("eps")).expect("valid input").len() as u64;
            assert!(chain <= needed + 4, "{}: {chain} arcs", c.id);
            c.put("arcs", needed);
            let (r, end, eps) = (record.base_radius(), TAU * f64::from(n), c.input("eps"));
            let rolls = chord_rolls(r, 0.0, end, eps);
            c.put("chords", chords_needed(r, 0.0, end, eps));
            c.put("phi_1", rolls[1]);
            c.put("phi_mid", rolls[(rolls.len() - 1) / 2]);
            c.put("biarcs", biarcs_needed(r, end, eps));
        }
        other => panic!("golden case of an unknown kind: {other}"),
    }
}

fn largest_length(input: &Value) -> f64 {
    let mut size = 0f64;
    for (key, value) in input.as_object().expect("an object") {
        match (key.as_str(), value) {
            ("record", Value::Array(v)) => {
                // Coordinates and radii; not the length, not the angle.
                for i in [1, 2, 4, 5] {
                    size = size.max(number(&v[i]).abs());
                }
            }
            ("n" | "t" | "s", _) => {}
            (_, v) => size = size.max(number(v).abs()),
        }
    }
    size
}

#[test]
fn golden_involutes_hold() {
    let file: Value = serde_json::from_str(include_str!("golden/involute.json")).unwrap();
    let mut count: BTreeMap<&str, u32> = BTreeMap::new();
    for kind in [
        "roll",
        "record",
        "split",
        "reverse",
        "rough",
        "lead_in",
        "lead_in_cw",
        "involute_block",
        "segmentation",
    ] {
        count.insert(kind, 0);
    }
    for case in file["cases"].as_array().unwrap() {
        let kind = case["kind"].as_str().unwrap();
        let mut c = Case {
            id: case["id"].as_str().unwrap(),
            input: &case["input"],
            expect: &case["expect"],
            tol: case["rel_tol"].as_f64().unwrap(),
            size: largest_length(&case["input"]),
            found: BTreeMap::new(),
        };
        solve(kind, &mut c);
        c.compare();
        *count.entry(kind).or_default() += 1;
    }
    assert!(count.values().all(|n| *n > 0), "a kind has no case: {count:?}");
}

#[test]
#[should_panic(expected = "unknown kind")]
fn a_case_of_an_unknown_kind_fails() {
    let nothing = serde_json::json!({});
    let mut c =
        Case { id: "x", input: &nothing, expect: &nothing, tol: 0.0, size: 1.0, found: BTreeMap::new() };
    solve("lens", &mut c);
}
