//! Open pieces of contours: beside all of each piece and nothing else, with leads that do not gouge; edges broken by a ball.

use glam::{DVec2, dvec2};
use kinecut::base::{Code, Finding, Severity};
use kinecut::contouring::{
    BallBreak, ContourPlan, ContourSide, ContourSpec, EdgeBreak, OutlinePiece, plan_contour,
};
use kinecut::geom::{Outline, OutlineEdge};
use kinecut::holes::{PlannedMove, Sense, ToolpathPace, ToolpathRole};

use super::chamfer::{chamfer, sound, spec};
use super::{signed, star};
use crate::common::golden::{file, number};
use crate::common::random::Random;

#[test]
fn golden_balls() {
    let mut seen = 0;
    for case in file("edges")["cases"].as_array().unwrap().iter().filter(|c| c["kind"] == "ball break") {
        let (input, want, tolerance) = (&case["input"], &case["expected"], &case["tolerance"]);
        let ball = BallBreak { radius: number(input, "radius"), width: number(input, "width") };
        let cut = EdgeBreak::Ball(ball);
        for (key, found) in [
            ("centre_x", -cut.offset()),
            ("centre_z", ball.radius - cut.depth()),
            ("tip_z", -cut.depth()),
            ("sag", ball.hollow()),
        ] {
            assert!((found - number(want, key)).abs() <= number(tolerance, key), "{key} of {case}: {found}");
        }
        // Both ends of the break lie on the ball.
        let (x, z) = (-cut.offset(), ball.radius - cut.depth());
        for end in [dvec2(cut.width(), 0.0), dvec2(0.0, -cut.leg())] {
            assert!((end.distance(dvec2(x, z)) - ball.radius).abs() < 1e-12);
        }
        assert!((cut.top_radius() - (ball.radius * ball.radius - z * z).sqrt()).abs() < 1e-12);
        seen += 1;
    }
    assert_eq!(seen, 2);
}

/// Length of a loop.
fn loop_length(outline: &Outline, of_loop: usize) -> f64 {
    outline.edges()[outline.loops()[of_loop].edges.clone()].iter().map(OutlineEdge::length).sum()
}

/// Place of the point of an outline nearest to another: its loop, and the length along it.
fn place(outline: &Outline, p: DVec2) -> (usize, f64) {
    let far = |e: &OutlineEdge| e.nearest(p).1;
    let nearest = (0..outline.edges().len())
        .min_by(|a, b| far(&outline.edges()[*a]).total_cmp(&far(&outline.edges()[*b])))
        .unwrap();
    let of_loop = outline.loops().iter().position(|l| l.edges.contains(&nearest)).unwrap();
    let first = outline.loops()[of_loop].edges.start;
    let begin: f64 = outline.edges()[first..nearest].iter().map(OutlineEdge::length).sum();
    let edge = &outline.edges()[nearest];
    (of_loop, begin + edge.nearest(p).0 * edge.length())
}

/// The point of a loop at a length along it, and the outward direction there.
fn place_at(outline: &Outline, of_loop: usize, at: f64) -> (DVec2, DVec2) {
    let mut left = at.rem_euclid(loop_length(outline, of_loop));
    let edges = &outline.edges()[outline.loops()[of_loop].edges.clone()];
    for edge in edges {
        if left <= edge.length() {
            let share = left / edge.length();
            return (edge.at(share), DVec2::from_angle(edge.outward(share)));
        }
        left -= edge.length();
    }
    (edges[0].start, DVec2::from_angle(edges[0].outward(0.0)))
}

/// Points along the cut, not its leads.
fn cut(plan: &ContourPlan) -> impl Iterator<Item = DVec2> + '_ {
    let own = plan.moves.iter().filter(|m| m.role == ToolpathRole::Circle);
    own.flat_map(|m: &PlannedMove| {
        (0..=40).map(|i| m.curve.at(m.curve.length() * f64::from(i) / 40.0).p.truncate())
    })
}

/// Distance by which ends of pieces may lie farther, where a lead has found no room.
const FARTHER: f64 = 12.0;

#[test]
fn random_pieces_are_cut_whole_and_nothing_else() {
    let mut random = Random(31);
    let (mut planned, mut exact, mut seen) = (0, 0, [0, 0]);
    for round in 0..160 {
        let Some(outline) = star(&mut random, [15.0, 30.0], (dvec2(1.0, -1.0), [3.0, 5.0])) else { continue };
        let mut pieces = Vec::new();
        for of_loop in 0..outline.loops().len() {
            let whole = loop_length(&outline, of_loop);
            let from = random.between(0.0, whole);
            let length = random.between(2.0, 0.45 * whole);
            pieces.push(OutlinePiece { of_loop, along: [from, from + length] });
            if random.share() < 0.5 {
                let next = from + length + 0.1 * whole;
                pieces.push(OutlinePiece {
                    of_loop,
                    along: [next.rem_euclid(whole), next.rem_euclid(whole) + 0.3 * whole],
                });
            }
        }
        let chamfer = chamfer(random.between(0.1, 0.6));
        let spec = ContourSpec {
            side: if random.share() < 0.4 { ContourSide::Inside } else { ContourSide::Outside },
            sense: if random.share() < 0.5 { Sense::Climb } else { Sense::Conventional },
            left_hand: random.share() < 0.3,
            pieces: Some(pieces.clone()),
            ..spec(outline.clone(), chamfer)
        };
        let plan = match plan_contour(&spec) {
            Ok(plan) => plan,
            Err(e) if [Code::CUTTER_TOO_LARGE, Code::LEAD_ROOM].contains(&e.code()) => continue,
            Err(e) => panic!("{round}: {e}"),
        };
        planned += 1;
        sound(&spec, &plan);
        let side = if spec.side == ContourSide::Inside { -1.0 } else { 1.0 };
        // The path keeps its distance and its pieces.
        for p in cut(&plan) {
            assert!((side * signed(&outline, p) - spec.radius()).abs() < 1e-6, "{round}");
        }
        let is_on = |p: DVec2| {
            let (of_loop, at) = place(&outline, p);
            let whole = loop_length(&outline, of_loop);
            pieces.iter().filter(|o| o.of_loop == of_loop).any(|o| {
                let gone = (at - o.along[0]).rem_euclid(whole);
                gone <= o.along[1] - o.along[0] + 1e-6 || gone >= whole - 1e-6
            })
        };
        // It runs beside pieces, but at its ends, where it may go on for a lead.
        let mut whole = true;
        for one in &plan.loops {
            let parts = one
                .edges
                .iter()
                .flat_map(|e| (0..100).map(move |i| e.part(0.01 * f64::from(i), 0.01 * f64::from(i + 1))));
            let on: Vec<(f64, bool)> = parts.map(|e| (e.length(), is_on(e.at(0.5)))).collect();
            let before: f64 = on.iter().take_while(|(_, on)| !on).map(|(l, _)| l).sum();
            let after: f64 = on.iter().rev().take_while(|(_, on)| !on).map(|(l, _)| l).sum();
            let off: f64 = on.iter().filter(|(_, on)| !on).map(|(l, _)| l).sum();
            assert!(before < FARTHER + 0.5 && after < FARTHER + 0.5, "{round}: {before} {after}");
            assert!(off <= before + after + 1e-9, "{round}: {off} {before} {after}");
            whole &= off < 0.5;
        }
        exact += usize::from(whole);
        // All of each piece is cut but before inside corners.
        for piece in &pieces {
            let edges = &outline.edges()[outline.loops()[piece.of_loop].edges.clone()];
            for i in 1..60 {
                let at = piece.along[0] + (piece.along[1] - piece.along[0]) * f64::from(i) / 60.0;
                let mut left = at.rem_euclid(loop_length(&outline, piece.of_loop));
                let edge = edges.iter().find(|e| {
                    let within = left <= e.length();
                    left -= if within { 0.0 } else { e.length() };
                    within
                });
                let Some(edge) = edge else { continue };
                let s = left / edge.length();
                let q = edge.at(s) + side * spec.radius() * DVec2::from_angle(edge.outward(s));
                if side * signed(&outline, q) < spec.radius() - 1e-6 {
                    continue;
                }
                let path = plan.loops.iter().flat_map(|l| &l.edges);
                let far = path.map(|e| e.nearest(q).1).fold(f64::INFINITY, f64::min);
                assert!(far < 1e-6, "{round}: {far} from {q} of {piece:?}");
            }
        }
        // The stretches beside the path are those of the pieces, but for places to which it does not come before inside corners.
        let cuts: Vec<_> = plan.loops.iter().filter_map(|l| l.piece.as_ref()).collect();
        assert!(cuts.len() == plan.loops.len() && cuts.iter().all(|c| c.first_move < plan.moves.len()));
        for of_loop in 0..outline.loops().len() {
            let whole = loop_length(&outline, of_loop);
            let on = |[from, to]: [f64; 2], at: f64| (at - from).rem_euclid(whole) < to - from;
            let expected = |at: f64| {
                let is_piece = pieces.iter().any(|p| p.of_loop == of_loop && on(p.along, at));
                let (p, out) = place_at(&outline, of_loop, at);
                is_piece && side * signed(&outline, p + side * spec.radius() * out) > spec.radius() - 1e-6
            };
            for i in 0..500 {
                let at = whole * (f64::from(i) + 0.5) / 500.0;
                let want = expected(at);
                // Ends of stretches, and runs that are too short, are not looked at.
                if [-2e-3, 2e-3].iter().any(|d| expected(at + d) != want) {
                    continue;
                }
                let beside = cuts.iter().flat_map(|c| &c.beside);
                let found = beside.filter(|b| b.of_loop == of_loop).any(|b| on(b.along, at));
                assert_eq!(found, want, "{round}: {at} of loop {of_loop}");
                *if want { &mut seen[0] } else { &mut seen[1] } += 1;
            }
        }
    }
    assert!(planned > 60 && exact > 30 && seen.iter().all(|n| *n > 1000), "{planned} {exact} {seen:?}");
}

#[test]
fn a_piece_that_is_all_of_its_loop_is_the_loop() {
    let square = [dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(40.0, 30.0), dvec2(0.0, 30.0)];
    let outline = Outline::polygon(&square).unwrap();
    let whole = spec(outline.clone(), chamfer(0.3));
    let piece = OutlinePiece { of_loop: 0, along: [0.0, 140.0] };
    let pieces = ContourSpec { pieces: Some(vec![piece]), ..whole.clone() };
    assert_eq!(plan_contour(&whole).unwrap().moves, plan_contour(&pieces).unwrap().moves);
    // Without a piece nothing moves.
    let none = ContourSpec { pieces: Some(vec![]), ..whole.clone() };
    assert!(plan_contour(&none).unwrap().moves.is_empty());
    for along in [[0.0, 141.0], [3.0, 3.0], [5.0, 2.0], [f64::NAN, 2.0], [0.0, f64::INFINITY]] {
        let wrong = ContourSpec { pieces: Some(vec![OutlinePiece { of_loop: 0, along }]), ..whole.clone() };
        assert_eq!(plan_contour(&wrong).unwrap_err().code(), Code::PLAN_VALUE, "{along:?}");
    }
    let other =
        ContourSpec { pieces: Some(vec![OutlinePiece { of_loop: 1, along: [0.0, 1.0] }]), ..whole.clone() };
    assert_eq!(plan_contour(&other).unwrap_err().code(), Code::PLAN_VALUE);
    let ramp = ContourSpec { ramp: Some(0.05), ..pieces };
    assert_eq!(plan_contour(&ramp).unwrap_err().code(), Code::PLAN_VALUE);
}

#[test]
fn mirrored_pieces_are_mirrored() {
    let corners = [
        dvec2(0.0, 0.0),
        dvec2(50.0, 0.0),
        dvec2(50.0, 18.0),
        dvec2(20.0, 18.0),
        dvec2(20.0, 40.0),
        dvec2(0.0, 40.0),
    ];
    let outline = Outline::polygon(&corners).unwrap();
    let whole = loop_length(&outline, 0);
    for k in 0..24 {
        let from = whole * f64::from(k) / 24.0;
        let to = from + 9.0 + f64::from(k);
        let feeds = |outline: Outline, along: [f64; 2], sense: Sense, left_hand: bool| {
            let pieces = Some(vec![OutlinePiece { of_loop: 0, along }]);
            let spec = ContourSpec { pieces, sense, left_hand, ..spec(outline, chamfer(0.4)) };
            let plan = plan_contour(&spec).unwrap();
            sound(&spec, &plan);
            let feeds = plan.moves.iter().filter(|m| matches!(m.pace, ToolpathPace::Feed(_)));
            let mut sum = [0.0; 3];
            for m in feeds {
                let (a, b) = (m.curve.start(), m.curve.end());
                sum = [
                    sum[0] + m.curve.length(),
                    sum[1] + 0.5 * (a.x + b.x) * m.curve.length(),
                    sum[2] + 0.5 * (a.y + b.y) * m.curve.length(),
                ];
            }
            sum
        };
        let plain = feeds(outline.clone(), [from, to], Sense::Climb, false);
        // In the mirror the loop runs from the other end; the piece is that of the mirrored places.
        let mirror = outline.mirrored();
        let p = outline_point(&outline, to);
        let (_, begin) = place(&mirror, dvec2(p.x, -p.y));
        let seen = feeds(mirror, [begin, begin + to - from], Sense::Climb, true);
        for (a, b) in [(plain[0], seen[0]), (plain[1], seen[1]), (plain[2], -seen[2])] {
            assert!((a - b).abs() < 1e-6 * (1.0 + a.abs()), "{k}: {plain:?} {seen:?}");
        }
    }
}

fn outline_point(outline: &Outline, at: f64) -> DVec2 {
    let mut left = at.rem_euclid(loop_length(outline, 0));
    for edge in outline.edges() {
        if left <= edge.length() {
            return edge.at(left / edge.length());
        }
        left -= edge.length();
    }
    outline.edges()[0].start
}

/// A plate of 40 x 40 with a cavity under its upper edge that a neck of a width opens, cut from the edge into the neck or beyond it, down
/// to a place: the length of the piece, and the plan.
fn keyhole(neck: f64, to: DVec2) -> (f64, ContourPlan) {
    let (low, high) = (20.0 - 0.5 * neck, 20.0 + 0.5 * neck);
    let corners = [
        dvec2(0.0, 0.0),
        dvec2(40.0, 0.0),
        dvec2(40.0, 40.0),
        dvec2(high, 40.0),
        dvec2(high, 34.0),
        dvec2(30.0, 34.0),
        dvec2(30.0, 10.0),
        dvec2(10.0, 10.0),
        dvec2(10.0, 34.0),
        dvec2(low, 34.0),
        dvec2(low, 40.0),
        dvec2(0.0, 40.0),
    ];
    let outline = Outline::polygon(&corners).unwrap();
    let whole = loop_length(&outline, 0);
    let ends = [place(&outline, dvec2(10.0, 40.0)).1, place(&outline, to).1];
    // The shorter way: the material lies on the right of the loop, on which side of the piece its begin is does not matter.
    let length = (ends[1] - ends[0]).rem_euclid(whole);
    let (from, length) = if length < 0.5 * whole { (ends[0], length) } else { (ends[1], whole - length) };
    let piece = OutlinePiece { of_loop: 0, along: [from, from + length] };
    let spec = ContourSpec { pieces: Some(vec![piece]), ..spec(outline, chamfer(0.3)) };
    let plan = plan_contour(&spec).unwrap();
    sound(&spec, &plan);
    (length, plan)
}

fn warnings(plan: &ContourPlan, code: Code) -> Vec<&Finding> {
    plan.findings.iter().filter(|f| f.code == code && f.severity == Severity::Warning).collect()
}

#[test]
fn edges_that_are_cut_though_not_chosen_are_told() {
    // Through the neck into the cavity: the cutter reaches 0.8 mm, and the other side of the neck lies 0.7 or 1 mm from its axis.
    for (neck, told) in [(1.2, 1), (1.5, 0)] {
        let (_, plan) = keyhole(neck, dvec2(13.0, 34.0));
        let found = warnings(&plan, Code::CUTTER_TOO_LARGE);
        assert_eq!(found.len(), told, "{neck}: {:?}", plan.findings);
        assert!(warnings(&plan, Code::LEAD_ROOM).is_empty(), "{neck}: {:?}", plan.findings);
        let is_in_neck = |f: &&Finding| f.point.is_some_and(|[x, y, _]| (x - 20.0).abs() < 1.5 && y > 33.0);
        assert!(found.iter().all(is_in_neck) && found.iter().all(|f| f.message.contains("not chosen")));
    }
}

#[test]
fn pieces_that_go_on_for_a_lead_say_by_how_much() {
    // In the neck is no room for a lead: the path goes on into the cavity, 3 mm away.
    let (length, plan) = keyhole(1.5, dvec2(19.25, 37.0));
    let found = warnings(&plan, Code::LEAD_ROOM);
    assert_eq!(found.len(), 1, "{:?}", plan.findings);
    let words = &found[0].message;
    let farther = words.split("up to ").nth(1).and_then(|w| w.split(' ').next()).unwrap();
    let farther: f64 = farther.parse().unwrap();
    assert!((2.0..=12.0).contains(&farther), "{words}");
    // Beside the path lies the piece that was asked for, and no more.
    let beside = plan.loops.iter().filter_map(|l| l.piece.as_ref()).flat_map(|c| &c.beside);
    let sum: f64 = beside.map(|b| b.along[1] - b.along[0]).sum();
    assert!((sum - length).abs() < 1e-6 && plan.loops[0].length() > length + 2.0, "{sum} {length}");
}
