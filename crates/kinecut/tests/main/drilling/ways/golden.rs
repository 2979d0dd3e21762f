//! Numbers of an independent computation: cross bores, countersinks and centre holes.

use kinecut::drilling::{CrossBore, DrillWay, Feeds, PartFace, PreHole, Side, Travel, ZoneStage, zones};
use kinecut::geom::EdgeProfile;
use kinecut::tool::{DrillPoint, StepStage as Step};
use serde_json::Value;

use crate::common::golden::{self, number};

/// Half a unit of the last digit given, and the rounding of both.
const DIGITS: f64 = 1e-6;

#[test]
fn cross_bores_begin_and_end_where_they_should() {
    let all = golden::file("drilling");
    let mut compared = 0;
    for case in all["cross_bores"].as_array().unwrap() {
        let (given, exact) = (&case["inputs"], &case["exact"]);
        let point = DrillPoint::SinglePlane { angle: number(case, "two_phi").to_radians() };
        let edge = point.edge(number(given, "D")).unwrap();
        let bore = CrossBore {
            radius: number(given, "Rc"),
            offset: number(given, "e"),
            height: number(given, "zc"),
            turn: 0.0,
        };
        // In a block, on both sides of the axis.
        let plane = PartFace::Plane { inclination: 0.0, offset: 0.0 };
        let mut way = DrillWay::new(
            plane.surface(Side::Entry, 0.0).unwrap(),
            Some(plane.surface(Side::Exit, -90.0).unwrap()),
        );
        for offset in [bore.offset, -bore.offset] {
            way.bores = vec![CrossBore { offset, ..bore }];
            let passages = way.passages(&edge).unwrap();
            let hit = exact["hit"].as_bool().unwrap();
            assert_eq!(passages.len(), if hit { 4 } else { 2 }, "{case}");
            assert_eq!(bore.passages(&edge).unwrap().is_some(), hit);
            let mut found = Vec::new();
            let feeds = Feeds { entry: 0.2, steady: 0.3, exit: 0.1 };
            zones(&passages, Travel { start: 2.0, end: -100.0 }, &feeds, &mut found);
            // What lies between the first two steady stretches.
            let steady = found.iter().position(|z| z.stage == ZoneStage::Steady).unwrap();
            let rest = &found[steady + 1..];
            let Some(end) = rest.iter().position(|z| z.stage == ZoneStage::Steady) else {
                assert!(!hit);
                continue;
            };
            let crossed = &rest[..end];
            let wanted: Vec<[f64; 2]> = serde_json::from_value(exact["zones"].clone()).unwrap();
            assert!((crossed[0].from - wanted[0][0]).abs() < DIGITS, "{case} {crossed:?}");
            assert!((crossed[end - 1].to - wanted[wanted.len() - 1][1]).abs() < DIGITS, "{case} {crossed:?}");
            let air: Vec<_> =
                crossed.iter().filter(|z| z.stage == ZoneStage::Air && z.length() > DIGITS).collect();
            match serde_json::from_value::<Option<[f64; 2]>>(exact["air"].clone()).unwrap() {
                Some([from, to]) => {
                    assert!((air[0].from - from).abs() < DIGITS && (air[0].to - to).abs() < DIGITS);
                }
                None => assert!(air.is_empty(), "{case} {air:?}"),
            }
            compared += 1;
        }
    }
    assert_eq!(compared, 10);
}

fn edge(drill: &Value) -> EdgeProfile {
    let angle = |key: &str| number(drill, key).to_radians();
    let point = match drill["type"].as_str().unwrap() {
        "twist_single" => DrillPoint::SinglePlane { angle: angle("two_phi") },
        "twist_double" => DrillPoint::DoubleGround { angle: angle("two_phi"), second: angle("two_phi1") },
        "cone_flat" => DrillPoint::Cone { angle: angle("two_phi"), nose: number(drill, "d_nose") },
        "center_drill" => {
            let pilot = Step {
                diameter: number(drill, "d1"),
                length: number(drill, "lp"),
                shoulder: angle("two_psi"),
            };
            DrillPoint::Stepped { angle: angle("two_phi"), stages: vec![pilot] }
        }
        other => panic!("{other}"),
    };
    point.edge(number(drill, "D")).unwrap()
}

#[test]
fn blind_holes_countersinks_and_centres_are_full_where_they_should() {
    for case in golden::file("drilling")["blind"].as_array().unwrap() {
        let (given, exact) = (&case["inputs"], &case["exact"]);
        let face = &given["entry"];
        let offset = face["x"].as_f64().unwrap_or(0.0);
        let radius = face["RS"].as_f64().unwrap_or(0.0);
        let face = match face["kind"].as_str().unwrap() {
            "plane" => PartFace::Plane { inclination: number(face, "alpha_deg").to_radians(), offset },
            "cyl_outer" => PartFace::OuterCylinder { radius, offset },
            _ => PartFace::InnerCylinder { radius, offset },
        };
        let mut edge = edge(&given["drill"]);
        if let Some(reached) = given["stop"]["diameter"].as_f64() {
            edge = edge.clipped(0.0, 0.5 * reached).unwrap();
        }
        let mut way = DrillWay::new(face.surface(Side::Entry, 0.0).unwrap(), None);
        way.pre_hole = given["drill"]["d0"].as_f64().map(PreHole::through);
        let [entry] = way.passages(&edge).unwrap()[..] else { panic!("{case}") };
        assert!((entry.transient.first - number(exact, "Z_first")).abs() < DIGITS, "{case} {entry:?}");
        assert!((entry.transient.last - number(exact, "Z_full")).abs() < DIGITS, "{case} {entry:?}");
        assert!((entry.share - 1.0).abs() < 1e-12);
    }
}
