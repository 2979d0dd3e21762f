//! Chamfers as planned: golden numbers, the cutter's cone against the outline, its leads, webs at corners.

use std::f64::consts::TAU;

use glam::dvec2;
use kinecut::base::Code;
use kinecut::contouring::{Chamfer, ContourLoops, ContourPlan, ContourSide, ContourSpec, plan_contour};
use kinecut::geom::{Outline, OutlineEdge};
use kinecut::holes::{CutterData, PlannedMove, Sense, ToolpathPace, ToolpathRole};

use super::{signed, star};
use crate::common::golden::{file, number};
use crate::common::random::Random;

pub(super) fn chamfer(width: f64) -> Chamfer {
    Chamfer { width, half_angle: 0.25 * std::f64::consts::PI, tip_diameter: 0.0, tip_clearance: 0.5 }
}

pub(super) fn spec(outline: Outline, chamfer: Chamfer) -> ContourSpec {
    let cutter = CutterData {
        diameter: 2.0 * chamfer.offset(),
        centre_cutting: true,
        max_ramp_angle: None,
        flute_length: 20.0,
    };
    ContourSpec {
        ramp: None,
        room: Some(chamfer.top_radius()),
        overlap: Some(1.0),
        ..ContourSpec::new(outline, chamfer.depth(), cutter, 15.0)
    }
}

/// Distances of a move from the wall along it.
fn away(spec: &ContourSpec, m: &PlannedMove) -> Vec<f64> {
    let side = if spec.side == ContourSide::Inside { -1.0 } else { 1.0 };
    let at = |i: u32| m.curve.at(m.curve.length() * f64::from(i) / 24.0).p.truncate();
    (0..=24).map(|i| side * signed(&spec.outline, at(i))).collect()
}

/// The axis keeps its offset wherever the cutter is below the edge; up and down, and at the free ends of leads, the cone lies
/// beside all edges, and along leads it only comes nearer to them.
#[track_caller]
pub(super) fn sound(spec: &ContourSpec, plan: &ContourPlan) {
    let room = spec.room.unwrap();
    assert_eq!(plan.levels.len(), 1);
    for pair in plan.moves.windows(2) {
        assert!((pair[1].curve.start() - pair[0].curve.end()).length() < 1e-6, "{pair:?}");
    }
    for m in &plan.moves {
        let (from, to) = (m.curve.start(), m.curve.end());
        if from.z.max(to.z) - spec.top > 1.9 && from.z.min(to.z) >= spec.approach_z - 1e-9 {
            continue;
        }
        assert!(from.z > spec.top || to.z > spec.top || matches!(m.pace, ToolpathPace::Feed(_)));
        let found = away(spec, m);
        let least = found.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(least >= spec.radius() + spec.stock_to_leave - 1e-6, "{least} of {m:?}");
        if (from - to).truncate().length() < 1e-9 {
            assert!(least >= room - 2e-6, "{least} below {room}: {m:?}");
        }
        let near: Vec<f64> = found.iter().map(|d| d.min(room)).collect();
        match m.role {
            ToolpathRole::LeadIn => assert!(near.windows(2).all(|w| w[1] <= w[0] + 2e-6), "{near:?}"),
            ToolpathRole::LeadOut => assert!(near.windows(2).all(|w| w[1] >= w[0] - 2e-6), "{near:?}"),
            _ => {}
        }
    }
}

#[test]
fn golden_chamfers() {
    let mut seen = 0;
    for case in file("contour")["cases"].as_array().unwrap().iter().filter(|c| c["kind"] == "chamfer") {
        let (input, want, tolerance) = (&case["input"], &case["expected"], &case["tolerance"]);
        let chamfer = Chamfer {
            width: number(input, "width"),
            half_angle: 0.5 * number(input, "included").to_radians(),
            tip_diameter: number(input, "tip_diameter"),
            tip_clearance: number(input, "tip_clearance"),
        };
        for (key, found) in [
            ("depth", chamfer.depth()),
            ("offset", chamfer.offset()),
            ("top_radius", chamfer.top_radius()),
            ("leg", chamfer.leg()),
        ] {
            assert!((found - number(want, key)).abs() <= number(tolerance, key), "{key} of {case}: {found}");
        }
        seen += 1;
    }
    assert_eq!(seen, 4);
}

#[test]
fn random_outlines_are_not_gouged_by_the_cone() {
    let mut random = Random(23);
    let mut planned = 0;
    for round in 0..120 {
        let Some(outline) = star(&mut random, [12.0, 30.0], (dvec2(1.0, -1.0), [2.0, 5.0])) else { continue };
        let chamfer = Chamfer {
            width: random.between(0.2, 2.5),
            half_angle: random.between(0.4, 1.1),
            tip_diameter: if random.share() < 0.5 { 0.0 } else { random.between(0.1, 1.0) },
            tip_clearance: random.between(0.2, 1.0),
        };
        let loops = [ContourLoops::All, ContourLoops::Outer, ContourLoops::Inner];
        let spec = ContourSpec {
            side: if random.share() < 0.5 { ContourSide::Inside } else { ContourSide::Outside },
            loops: loops[random.below(3)],
            sense: if random.share() < 0.5 { Sense::Climb } else { Sense::Conventional },
            left_hand: random.share() < 0.3,
            ..spec(outline, chamfer)
        };
        let plan = match plan_contour(&spec) {
            Ok(plan) => plan,
            Err(e) if [Code::CUTTER_TOO_LARGE, Code::LEAD_ROOM].contains(&e.code()) => continue,
            Err(e) => panic!("{round}: {e}"),
        };
        planned += 1;
        sound(&spec, &plan);
        // Loops that are not asked for keep their edges.
        let wanted = |outer: bool| match spec.loops {
            ContourLoops::All => true,
            ContourLoops::Outer => outer,
            ContourLoops::Inner => !outer,
        };
        for other in spec.outline.loops().iter().filter(|l| !wanted(l.outer)) {
            for edge in plan.loops.iter().flat_map(|l| &l.edges) {
                for i in 0..=20 {
                    let p = edge.at(f64::from(i) / 20.0);
                    let own = &spec.outline.edges()[other.edges.clone()];
                    let far = own.iter().map(|e| e.nearest(p).1).fold(f64::INFINITY, f64::min);
                    assert!(far >= chamfer.top_radius() - 2e-3, "{round}: {far}");
                }
            }
        }
    }
    assert!(planned > 50, "{planned}");
}

#[test]
fn webs_are_as_long_as_the_corners_angle_says() {
    // An equilateral triangle, a square, an L.
    let triangle = [dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(20.0, 20.0 * 3f64.sqrt())];
    let square = [dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(40.0, 40.0), dvec2(0.0, 40.0)];
    let l = [
        dvec2(0.0, 0.0),
        dvec2(40.0, 0.0),
        dvec2(40.0, 15.0),
        dvec2(15.0, 15.0),
        dvec2(15.0, 40.0),
        dvec2(0.0, 40.0),
    ];
    let cases = [
        (&triangle[..], ContourSide::Inside, 3, 60.0_f64),
        (&square[..], ContourSide::Inside, 4, 90.0),
        (&l[..], ContourSide::Outside, 1, 90.0),
        (&square[..], ContourSide::Outside, 0, 90.0),
    ];
    for (corners, side, count, angle) in cases {
        for reversed in [false, true] {
            let sense = if reversed { Sense::Conventional } else { Sense::Climb };
            let spec = ContourSpec { side, sense, ..spec(Outline::polygon(corners).unwrap(), chamfer(1.0)) };
            let plan = plan_contour(&spec).unwrap();
            sound(&spec, &plan);
            assert_eq!(plan.uncut.len(), count);
            let each = 2.0 * spec.radius() / (0.5 * angle.to_radians()).tan();
            for corner in &plan.uncut {
                assert!((corner.length.unwrap() - each).abs() < 1e-9, "{corner:?}");
            }
        }
    }
    // An inside arc that is tighter than the offset keeps one along all of it.
    let r = 0.3;
    let rounded = [
        OutlineEdge::line(dvec2(r, 0.0), dvec2(30.0, 0.0)),
        OutlineEdge::line(dvec2(30.0, 0.0), dvec2(30.0, 30.0)),
        OutlineEdge::line(dvec2(30.0, 30.0), dvec2(0.0, 30.0)),
        OutlineEdge::line(dvec2(0.0, 30.0), dvec2(0.0, r)),
        OutlineEdge::arc(dvec2(r, r), r, 0.5 * TAU, 0.25 * TAU),
    ];
    let outline = Outline::new(vec![rounded.to_vec()], vec![]).unwrap();
    let spec = ContourSpec { side: ContourSide::Inside, ..spec(outline, chamfer(1.0)) };
    let plan = plan_contour(&spec).unwrap();
    let shortest = plan.uncut.iter().filter_map(|c| c.length).fold(f64::INFINITY, f64::min);
    assert_eq!(plan.uncut.len(), 4);
    assert!((shortest - (2.0 * 0.2 + 0.25 * TAU * r)).abs() < 1e-9, "{shortest}");
}

#[test]
fn mirrored_and_turned_chamfers_are_as_long() {
    let corners = [
        dvec2(0.0, 0.0),
        dvec2(50.0, 0.0),
        dvec2(50.0, 18.0),
        dvec2(20.0, 18.0),
        dvec2(20.0, 40.0),
        dvec2(0.0, 40.0),
    ];
    let outline = Outline::polygon(&corners).unwrap();
    for side in [ContourSide::Outside, ContourSide::Inside] {
        let length = |outline: Outline, sense: Sense| {
            let spec = ContourSpec { side, sense, ..spec(outline, chamfer(1.5)) };
            let plan = plan_contour(&spec).unwrap();
            sound(&spec, &plan);
            let feeds = plan.moves.iter().filter(|m| matches!(m.pace, ToolpathPace::Feed(_)));
            feeds.map(|m| m.curve.length()).sum::<f64>()
        };
        let plain = length(outline.clone(), Sense::Climb);
        for (other, sense) in [
            (outline.moved(0.7, dvec2(11.0, 5.0)), Sense::Climb),
            (outline.mirrored(), Sense::Climb),
            (outline.clone(), Sense::Conventional),
        ] {
            assert!((length(other, sense) - plain).abs() < 1e-6);
        }
    }
}
