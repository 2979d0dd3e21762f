//! Slots: loops of a trochoid judged as pockets are, passes as wide as the cutter.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, dvec2};
use kinecut::base::Code;
use kinecut::clearing::{CentreLine, SlotSpec, Trochoid, plan_slot};
use kinecut::geom::Outline;
use kinecut::holes::{CutterData, Sense, ToolpathPace, ToolpathRole};

use super::{judge, rectangle};
use crate::common::random::Random;

fn cutter(diameter: f64) -> CutterData {
    CutterData { diameter, centre_cutting: true, max_ramp_angle: None, flute_length: 22.0 }
}

fn straight(length: f64) -> CentreLine {
    CentreLine::line(dvec2(-0.5 * length, 3.0), dvec2(0.5 * length, 3.0)).expect("a line")
}

fn slot(line: CentreLine, width: f64, diameter: f64, degrees: f64) -> SlotSpec {
    let mut spec = SlotSpec::new(line, width, 6.0, cutter(diameter), 10.0).expect("a slot");
    spec.pocket.engagement = degrees.to_radians();
    spec
}

/// Engagement of a cutter at an angle of a loop, by points of its circle.
fn by_points(loops: Trochoid, pitch: f64, at: f64) -> f64 {
    let (a, reach) = (loops.cutter, loops.cutter + loops.around);
    let centre = dvec2(pitch, 0.0) + loops.around * DVec2::from_angle(at);
    let steps = 50_000;
    let is_cut = |k: &i32| {
        let angle = at + PI * (f64::from(*k) + 0.5) / f64::from(steps);
        (centre + a * DVec2::from_angle(angle)).length() > reach
    };
    (0..steps).filter(is_cut).count() as f64 * PI / f64::from(steps)
}

#[test]
fn the_largest_engagement_of_a_loop_is_before_its_front() {
    // The figures of the specification, by brute force: engagement in front, the largest, its angle.
    for (around, pitch, [front, largest, at]) in
        [(3.0, 1.0, [54.9, 60.0, -34.0]), (1.5, 0.8, [58.7, 69.5, -52.0])]
    {
        let loops = Trochoid { cutter: 5.0, around };
        assert!((loops.engagement(pitch, 0.0).to_degrees() - front).abs() < 0.06);
        assert!((loops.largest(pitch).to_degrees() - largest).abs() < 0.06);
        let there = loops.engagement(pitch, f64::to_radians(at)).to_degrees();
        assert!((there - largest).abs() < 0.1, "{there}");
    }
    let mut random = Random(3);
    for _ in 0..200 {
        let loops = Trochoid { cutter: random.between(0.5, 10.0), around: random.between(0.02, 12.0) };
        let pitch = loops.cutter * random.between(0.001, 1.5);
        let at = random.between(-FRAC_PI_2, FRAC_PI_2);
        let (found, counted) = (loops.engagement(pitch, at), by_points(loops, pitch, at));
        assert!((found - counted).abs() < 3e-4, "{loops:?} {pitch} {at}: {found} {counted}");
        let densest = (0..=4000).map(|k| loops.engagement(pitch, PI * (f64::from(k) / 2000.0 - 1.0)));
        let largest = loops.largest(pitch);
        assert!(densest.clone().all(|e| e <= largest + 1e-9));
        assert!(densest.fold(0.0, f64::max) > largest - 1e-3);
        let wanted = random.between(0.2, 2.0);
        let fits = loops.pitch(wanted);
        assert!(fits == 2.0 * loops.cutter || (loops.largest(fits) - wanted).abs() < 1e-9);
    }
}

#[test]
fn loops_keep_the_engagement_and_clear_the_slot() {
    let arc = |sweep: f64| CentreLine::arc(dvec2(0.0, 0.0), 30.0, 0.3, sweep).expect("an arc");
    let cases = [
        ("W 13", slot(straight(40.0), 13.0, 10.0, 60.0)),
        ("W 16", slot(straight(40.0), 16.0, 10.0, 60.0)),
        ("W 11", slot(straight(20.0), 11.0, 10.0, 45.0)),
        ("wide", slot(straight(30.0), 24.0, 10.0, 60.0)),
        ("90", slot(straight(30.0), 7.5, 6.0, 90.0)),
        ("arc to the left", slot(arc(1.5), 13.0, 10.0, 60.0)),
        ("arc to the right", slot(arc(-1.5), 13.0, 10.0, 60.0)),
    ];
    for (name, spec) in cases {
        let plan = plan_slot(&spec).expect(name);
        let wanted = spec.pocket.engagement.to_degrees();
        let found = judge(&spec.pocket, &plan, 151);
        assert!(found.pass < wanted + 1.0, "{name}: {found:?}");
        assert!(found.link < 16.0, "{name}: {found:?}");
        assert!(found.left == 0.0, "{name}: {found:?}");
        let largest = plan.figures.largest.to_degrees();
        assert!(largest < wanted + 1.0 && largest > wanted - 2.0, "{name}: {largest}");
        let joined = plan.moves.windows(2).all(|w| (w[1].curve.start() - w[0].curve.end()).length() < 1e-6);
        assert!(joined, "{name}");
        assert!(plan.findings.is_empty() && plan.figures.left == 0.0, "{name}: {:?}", plan.figures);
    }
}

#[test]
fn conventional_slots_are_the_mirror_of_climb() {
    let line = CentreLine::arc(dvec2(0.0, 0.0), 30.0, 0.3, 1.2).expect("an arc");
    let climb = slot(line.clone(), 13.0, 10.0, 60.0);
    let mut mirrored = slot(line.mirrored(), 13.0, 10.0, 60.0);
    mirrored.pocket.sense = Sense::Conventional;
    let [one, two] = [&climb, &mirrored].map(|s| plan_slot(s).expect("a plan"));
    assert_eq!(one.moves.len(), two.moves.len());
    for (m, n) in one.moves.iter().zip(&two.moves) {
        let flip = |p: glam::DVec3| glam::dvec3(p.x, -p.y, p.z);
        assert!(flip(m.curve.start()).distance(n.curve.start()) < 1e-9);
    }
}

#[test]
fn a_slot_as_wide_as_the_cutter_wants_it_said() {
    let mut spec = slot(straight(40.0), 10.0, 10.0, 60.0);
    spec.pocket.stepdown = Some(3.0);
    let error = plan_slot(&spec).unwrap_err().0;
    assert_eq!(error.key.as_deref(), Some("engagement"));
    assert!(error.message.contains("leaves no room for loops to a cutter of 10.000 mm"), "{error:?}");
    spec.pocket.engagement = PI;
    let plan = plan_slot(&spec).expect("a plan");
    assert_eq!((plan.levels.len(), plan.figures.largest), (2, PI));
    // Down along the line within the angle, and all of the floor of each level cut level.
    for m in
        plan.moves.iter().filter(|m| matches!(m.pace, ToolpathPace::Feed(_)) && m.role != ToolpathRole::Link)
    {
        let way = m.curve.end() - m.curve.start();
        let flat = way.truncate().length();
        let upright = flat < 1e-9 && m.curve.end().z > -1e-9;
        assert!(upright || (-way.z).atan2(flat) <= spec.pocket.ramp + 1e-9, "{m:?}");
        assert!((m.curve.start().y - 3.0).abs() < 1e-9);
    }
    for level in &plan.levels {
        let flat: f64 = plan
            .moves
            .iter()
            .filter(|m| m.role == ToolpathRole::Rough && (m.curve.start().z - level).abs() < 1e-9)
            .map(|m| m.curve.length())
            .sum();
        assert!((flat - 40.0).abs() < 1e-9, "{flat}");
    }
    // Nothing is retracted between levels.
    let up = plan.moves.iter().filter(|m| m.role == ToolpathRole::Retract).count();
    assert_eq!(up, 1);
}

#[test]
fn slots_that_cannot_be_are_refused_with_their_key() {
    let refused = |spec: &SlotSpec| plan_slot(spec).unwrap_err().0;
    let error = refused(&slot(straight(40.0), 9.0, 10.0, 60.0));
    assert_eq!((error.code, error.key.as_deref()), (Code::CUTTER_TOO_LARGE, Some("tool")));
    let mut flat = slot(straight(40.0), 12.0, 10.0, 60.0);
    flat.pocket.cutter.centre_cutting = false;
    assert_eq!(refused(&flat).code, Code::ENTRY_IMPOSSIBLE);
    // A hole that is wide enough, and an end beyond the stock, are ways in.
    let mut drilled = flat.clone();
    drilled.pocket.holes = vec![(dvec2(20.0, 3.0), 5.5)];
    let plan = plan_slot(&drilled).expect("a plan");
    assert_eq!(plan.figures.entries, 0);
    let found = judge(&drilled.pocket, &plan, 151);
    assert!(found.pass < 61.0 && found.left == 0.0, "{found:?}");
    let mut open = flat.clone();
    open.pocket.stock = Some(rectangle(80.0, 80.0).moved(0.0, dvec2(-12.0, -40.0)));
    let plan = plan_slot(&open).expect("a plan");
    assert_eq!(plan.figures.entries, 0);
    let found = judge(&open.pocket, &plan, 151);
    assert!(found.pass < 61.0 && found.left == 0.0, "{found:?}");
    let mut wide = slot(straight(40.0), 12.0, 10.0, 150.0);
    wide.pocket.helix_radius = None;
    assert_eq!(refused(&wide).key.as_deref(), Some("engagement"));
    let tiny = slot(straight(400.0), 10.07, 10.0, 5.0);
    assert!(plan_slot(&tiny).is_err() || plan_slot(&tiny).unwrap().figures.passes < 25_000);
}

#[test]
fn centre_lines_have_the_outline_of_their_slot() {
    let area = |line: &CentreLine, width: f64| line.outline(width).expect("an outline").area();
    let line = straight(40.0);
    assert!((area(&line, 12.0) - 480.0 - PI * 36.0).abs() < 1e-9);
    for sweep in [2.0, -2.0, 5.0] {
        // Pappus: length of the line times the width, and the two round ends.
        let arc = CentreLine::arc(dvec2(5.0, -3.0), 30.0, 0.3, sweep).expect("an arc");
        assert!((area(&arc, 12.0) - 30.0 * f64::abs(sweep) * 12.0 - PI * 36.0).abs() < 1e-9, "{sweep}");
        assert!((area(&arc.reversed(), 12.0) - area(&arc, 12.0)).abs() < 1e-9);
        assert!((area(&arc.mirrored(), 12.0) - area(&arc, 12.0)).abs() < 1e-9);
    }
    let error = |line: kinecut::base::Result<CentreLine>| line.unwrap_err().0.message;
    assert!(error(CentreLine::line(DVec2::ONE, DVec2::ONE)).contains("no length"));
    assert!(error(CentreLine::arc(DVec2::ONE, 10.0, 0.0, TAU)).contains("closed"));
    let tight = CentreLine::arc(DVec2::ONE, 5.0, 0.0, 1.0).expect("an arc");
    assert!(tight.outline(10.0).unwrap_err().0.message.contains("inner wall vanishes"));
    // One that runs into itself.
    let around = CentreLine::arc(DVec2::ZERO, 30.0, 0.0, 6.2).expect("an arc");
    assert!(around.outline(12.0).map(|o: Outline| o.area()).is_err());
}
