//! Golden numbers of involute hole milling, from an independent reference.
//!
//! Rule, as the file prints it: pass when `|a - b| <= rel_tol * max(|b|, S)`, with `S` the largest length in the
//! input for lengths, 1 for angles and counts, `1/S` for curvature; angles modulo 2 pi. Derivatives of curvature
//! are held to `1/S^2`. A kind or a key that this harness does not know fails.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use kinecut::geom::{
    Arc, CubicSpan, InvoluteRecord, LensOrder, PlaneCurve, Spiral, SpiralLaw, Support, arc_chain,
    arcs_needed, biarcs_needed, chord_rolls, chords_needed, joint,
};
use kinecut::holes::clearing::{Cleared, Clearing, Disc, rings_of_equal_engagement, turns};
use kinecut::holes::{engagement_formula, lead_in, lens_lead_in, path_radius, roll, spiral};
use serde_json::Value;

use crate::common::golden;

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
            "N" | "turns_real" | "alpha" | "angle" | "straight" | "slope" | "tangent_break" => 1.0,
            "k" | "dk_jump" | "first_dk" | "last_dk" | "k_start" | "k_end" => 1.0 / self.size,
            "dk_ds" | "dk_ds_jump" | "k1" | "k1_end" => 1.0 / (self.size * self.size),
            "k2" => 1.0 / self.size.powi(3),
            // Kinematics: relative to the value itself.
            key if key.contains("_accel") || key.contains("_jerk") || key.contains("velocity") => 0.0,
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
                (Value::Array(a), Value::Array(b)) if b[0].is_array() => {
                    assert_eq!(a.len(), b.len());
                    for (a, b) in a.iter().zip(b) {
                        assert_eq!(list(a).len(), list(b).len());
                        list(a).iter().zip(list(b)).for_each(|(a, b)| self.near(key, number(a), number(b)));
                    }
                }
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

/// The disc of a case that gives R and n: from the centre, n turns, a cutter of any radius that leaves no core.
fn disc(c: &Case) -> Disc {
    let (outer, turns) = (c.input("R"), c.input("n"));
    Disc {
        inner: 0.0,
        inner_most: 0.0,
        outer,
        cutter: 20.0,
        step: outer / turns,
        engagement: None,
        psi: 0.0,
        resolution: None,
    }
}

fn order(c: &Case) -> LensOrder {
    [LensOrder::Zero, LensOrder::One, LensOrder::Two][c.input("order") as usize]
}

fn length(path: &Cleared) -> f64 {
    path.curves.iter().map(PlaneCurve::length).sum()
}

/// Curvature where one curve ends and the next begins.
fn step_of_curvature(a: &PlaneCurve, b: &PlaneCurve) -> f64 {
    b.at(0.0).curvature - a.at(a.length()).curvature
}

/// Angle between the tangents at the wall.
fn break_at_wall(path: &Cleared) -> f64 {
    let last = path.curves.last().expect("a curve").at_height(0.0, 0.0);
    joint(&last, &PlaneCurve::from(path.closing).at_height(0.0, 0.0)).angle
}

/// Largest distance along the normal between the last arc of an arc spiral and the involute of the circle about the
/// polygon's middle that has the same radius of curvature in the middle of the arc.
fn deviation_of_poles(path: &Cleared, poles: usize) -> f64 {
    let records: Vec<InvoluteRecord> = path
        .curves
        .iter()
        .map(|c| match c {
            PlaneCurve::Record(r) => *r,
            PlaneCurve::Spiral(_) => panic!("an arc"),
        })
        .collect();
    let last = records[records.len() - 1];
    // The vertices of the polygon are the centres of the last arcs.
    let around = &records[records.len() - poles..];
    let middle = around.iter().map(InvoluteRecord::base_centre).sum::<DVec2>() / poles as f64;
    let (angle, rise) = (TAU / poles as f64, path.step / TAU);
    let mid = last.start_angle() + 0.5 * angle;
    // Twice the support's difference is symmetric about the middle of the arc: the maximum lies in its second half.
    let away = |x: f64| {
        let u = DVec2::new((mid + x).sin(), -(mid + x).cos());
        ((last.base_centre() - middle).dot(u) - rise * x).abs()
    };
    let (mut lo, mut hi) = (0.0, 0.5 * angle);
    while hi - lo > 1e-9 {
        let (a, b) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
        if away(a) < away(b) { lo = a } else { hi = b }
    }
    away(0.5 * (lo + hi))
}

fn solve(kind: &str, c: &mut Case) {
    match kind {
        "lens" => {
            let (base_radius, theta) = (c.input("R") / (TAU * c.input("n")), c.input("theta"));
            let law = Support::Lens { inner: 0.0, base_radius, order: order(c) };
            let spiral = Spiral::new(law.into(), 0.0, theta).expect("valid input");
            let jet = spiral.at_parameter(theta);
            let [x, y] = spiral.arc_series::<5>(theta);
            let fourth = DVec2::new(x.derivative(4), y.derivative(4));
            let [q, slope] = law.at(theta);
            c.put("x", jet.p.x);
            c.put("y", jet.p.y);
            c.put("s", spiral.length());
            c.put("rho", law.radius(theta));
            c.put("k", jet.curvature);
            c.put("k1", jet.curvature_slope);
            // The fourth derivative along the normal is k'' - k^3.
            c.put("k2", fourth.dot(DVec2::new(-theta.sin(), theta.cos())) + jet.curvature.powi(3));
            c.put("q", q);
            c.put("q1", slope);
        }
        "lens_lead_in" => {
            let start = [0.0, c.input("rho0")];
            let lead = lens_lead_in(c.input("R"), c.input("n") as u32, start, 0.0, order(c)).expect("valid");
            assert!((lead.spiral.start() - DVec2::from_array(start)).length() < 1e-11);
            c.put("theta", lead.theta);
            c.put("L", lead.spiral.length());
            c.put("Rn", 1.0 / lead.spiral.at(0.0).curvature);
        }
        "poles" => {
            let m = c.input("m") as u32;
            let path = Clearing::Poles(m).path(&disc(c)).expect("valid input");
            let last = path.curves.last().expect("arcs");
            c.put("arcs", path.curves.len());
            c.put("L_spiral", length(&path));
            c.put("first_radius", 1.0 / path.curves[0].at(0.0).curvature);
            c.put("last_dk", step_of_curvature(last, &path.closing.into()));
            c.put("first_dk", step_of_curvature(&path.curves[0], &path.curves[1]));
            c.put("end", last.end().to_array().to_vec());
            c.put("max_dev_from_involute", deviation_of_poles(&path, m as usize));
        }
        "archimedes" => {
            let path = Clearing::Archimedes.path(&disc(c)).expect("valid input");
            let (start, end) = (path.curves[0].at(0.0), path.curves[0].at(length(&path)));
            c.put("L", length(&path));
            c.put("k_start", start.curvature);
            c.put("k_end", end.curvature);
            c.put("k1_end", end.curvature_slope);
            c.put("tangent_break", break_at_wall(&path));
        }
        "concentric" => {
            let path = Clearing::RingsRadial.path(&disc(c)).expect("valid input");
            c.put("L", length(&path) + path.closing.length());
        }
        "helix" => {
            let (cutter, pitch, depth) = (0.5 * c.input("D_cutter"), c.input("pitch"), c.input("depth"));
            let radius = path_radius(c.input("D_hole"), 2.0 * cutter, 0.0).expect("valid input");
            let start = DVec3::new(radius, 0.0, 0.0);
            let helix = Arc::new(start, DVec3::ZERO, DVec3::Z, TAU * depth / pitch, -depth).expect("a helix");
            let jet = helix.at(0.3 * helix.length());
            let core = 2.0 * (radius - cutter).max(0.0);
            c.put("R", radius);
            if c.expect.get("L_helix").is_some() {
                c.put("L_helix", helix.length());
                c.put("k", jet.curvature());
                c.put("slope", (-jet.d1.z).asin());
            }
            c.put("core_diameter", core);
            c.put("ok", core == 0.0);
        }
        "kinematics" => {
            let (at, feed) = (disc(c), c.input("F_mm_s"));
            let (squared, cubed) = (feed * feed, feed * feed * feed);
            let path = |clearing: Clearing| clearing.path(&at).expect("valid input");
            let involute = path(Clearing::Involute);
            let closing = PlaneCurve::from(involute.closing).at_height(0.0, 0.0).at(1.0);
            let end = involute.curves[0].at(length(&involute));
            c.put("circle_accel", squared * closing.d2.length());
            c.put("circle_jerk", cubed * closing.d3.length());
            c.put("involute_jerk_step", cubed * end.curvature_slope.abs());
            // At a roll of 1 rad the length is half a base radius.
            let early = involute.curves[0].at(0.5 * involute.step / TAU);
            c.put("involute_accel_at_phi1", squared * early.curvature);
            let last = |path: &Cleared| {
                squared * step_of_curvature(&path.curves[path.curves.len() - 1], &path.closing.into()).abs()
            };
            // The joint in which the radius becomes one step.
            let at_step = |path: &Cleared, poles: usize| {
                squared * step_of_curvature(&path.curves[poles - 2], &path.curves[poles - 1]).abs()
            };
            let (two, four) = (path(Clearing::Poles(2)), path(Clearing::Poles(4)));
            c.put("pole2_accel_step_last", last(&two));
            c.put("pole4_accel_step_last", last(&four));
            c.put("pole2_accel_step_radH", at_step(&two, 2));
            c.put("pole4_accel_step_radH", at_step(&four, 4));
            let kink = break_at_wall(&path(Clearing::Archimedes));
            c.put("archimedes_velocity_step", 2.0 * feed * (0.5 * kink).sin());
        }
        "engagement" => {
            let (cutter, step) = (c.input("cutter_radius"), c.input("H"));
            c.put("angle", engagement_formula(c.input("rc"), cutter, step));
            c.put("straight", engagement_formula(f64::INFINITY, cutter, step));
        }
        "const_engagement" => {
            let (cutter, limit) = (c.input("cutter_radius"), c.input("max_deg").to_radians());
            let (inner, outer, theta) = (c.input("R1"), c.input("R"), c.input("theta"));
            let free = kinecut::geom::ConstantEngagement::new(inner, outer, cutter, limit, order(c));
            c.put("turns_real", free.turns());
            // The step does not bind.
            let disc = Disc {
                inner,
                inner_most: inner,
                outer,
                cutter,
                step: 2.0 * cutter,
                engagement: Some(limit),
                psi: 0.0,
                resolution: None,
            };
            let path = Clearing::ConstantEngagement(order(c)).path(&disc).expect("valid input");
            let PlaneCurve::Spiral(spiral) = path.curves[0] else { panic!("a spiral") };
            let SpiralLaw::Support(law) = *spiral.law() else { panic!("a support curve") };
            let ([q, slope], point) = (law.at(theta), spiral.point(theta));
            c.put("N", path.turns as u64);
            c.put("alpha", path.engagement.expect("an angle"));
            c.put("q", q);
            c.put("q1", slope);
            c.put("rho", law.radius(theta));
            c.put("x", point.x);
            c.put("y", point.y);
            c.put("rings", rings_of_equal_engagement(outer, inner, cutter, limit));
        }
        "morph_ellipse" => {
            let (half_axes, theta) = ([c.input("a"), c.input("b")], c.input("theta"));
            let turns = turns(half_axes[0].max(half_axes[1]), c.input("H")).expect("valid input");
            let law = Support::Morph {
                inner: 0.0,
                half_axes,
                offset: 0.0,
                turns: f64::from(turns),
                order: order(c),
            };
            let [q, slope] = law.at(theta);
            let spiral = Spiral::new(law.into(), TAU, theta).expect("valid input");
            c.put("N", turns);
            c.put("q", q);
            c.put("q1", slope);
            c.put("rho", law.radius(theta));
            c.put("x", spiral.end().x);
            c.put("y", spiral.end().y);
        }
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
            let radius =
                path_radius(c.input("D_hole"), c.input("D_cutter"), c.input("delta")).expect("valid input");
            let n = turns(radius, c.input("H_max")).expect("valid input");
            let record = spiral::from_centre(radius, n, 0.0).expect("valid input");
            let circle = InvoluteRecord::circle(radius, 0.0).expect("valid input");
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
                lead_in::lead_in(c.input("R"), c.input("n") as u32, [c.input("x0"), c.input("y0")], 0.0)
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
            let printed = lead_in::turns_as_printed(c.input("R"), c.input("n") as u32, distance);
            c.put("n_visible_paper", printed);
            c.put("tangent_x", end.p.x);
            c.put("tangent_y", end.p.y);
            c.put("base_x", centre.x);
            c.put("base_y", centre.y);
            c.put("dk_ds_jump", -end.curvature_slope);
        }
        "lead_in_cw" => {
            let lead =
                lead_in::lead_in(c.input("R"), c.input("n") as u32, [-c.input("x0"), c.input("y0")], 0.0)
                    .expect("valid input");
            c.put("record", six(&lead.record.mirrored()));
            c.put(
                "circle",
                six(&InvoluteRecord::circle(c.input("R"), lead.psi).expect("valid input").mirrored()),
            );
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
        "bezier" => {
            let record = c.record();
            let [s0, s1] = [c.input("s0"), c.input("s1")];
            let middle = record.at(0.5 * (s0 + s1)).p;
            let span = CubicSpan::touching([record.at(s0), record.at(s1)], middle).expect("a cubic");
            c.put("points", span.points().map(|p| p.to_array().to_vec()).to_vec());
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
            ("n" | "t" | "s" | "m" | "order" | "theta" | "F_mm_s" | "max_deg", _) => {}
            (_, v) => size = size.max(number(v).abs()),
        }
    }
    size
}

#[test]
fn golden_involutes_hold() {
    let file: Value = golden::file("involute");
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
        "lens",
        "lens_lead_in",
        "poles",
        "helix",
        "const_engagement",
        "archimedes",
        "concentric",
        "kinematics",
        "engagement",
        "morph_ellipse",
        "bezier",
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
    solve("spline", &mut c);
}
