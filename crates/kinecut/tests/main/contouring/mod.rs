//! Contours as planned: the path against dense points, its heights, its tabs, its leads, its feeds; turned and mirrored.

mod chamfer;
mod corner_feed;
mod lines;
mod pieces;
mod tabs;
mod wear;

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, dvec2};
use kinecut::base::{Code, Severity};
use kinecut::contouring::{
    ContourFinish, ContourLoops, ContourPlan, ContourSide, ContourSpec, TabShape, Tabs, centre_feed,
    plan_contour,
};
use kinecut::geom::{Outline, OutlineEdge};
use kinecut::holes::{CutterData, FeedAt, PlannedMove, Sense, ToolpathPace, ToolpathRole, Wear};

use crate::common::golden::{file, number, numbers};
use crate::common::random::Random;

const CUTTER: CutterData =
    CutterData { diameter: 6.0, centre_cutting: true, max_ramp_angle: None, flute_length: 20.0 };

fn rectangle(x: f64, y: f64) -> Outline {
    Outline::polygon(&[dvec2(0.0, 0.0), dvec2(x, 0.0), dvec2(x, y), dvec2(0.0, y)]).unwrap()
}

fn spec(outline: Outline) -> ContourSpec {
    ContourSpec { stepdown: Some(4.0), ..ContourSpec::new(outline, 10.0, CUTTER, 20.0) }
}

/// Signed distance of a point from the outline by all of its edges: positive outside of the face.
fn signed(outline: &Outline, p: DVec2) -> f64 {
    let far = outline.edges().iter().map(|e| e.nearest(p).1).fold(f64::INFINITY, f64::min);
    if outline.contains(p) { -far } else { far }
}

/// A star of lines and arcs with corners at distances from the origin, half of them with a round hole at a place, of a radius.
fn star(random: &mut Random, far: [f64; 2], (at, radii): (DVec2, [f64; 2])) -> Option<Outline> {
    let count = 3 + random.below(7);
    let corners: Vec<DVec2> = (0..count)
        .map(|i| {
            let angle = TAU * (i as f64 + 0.5 * random.share()) / count as f64;
            DVec2::from_angle(angle) * random.between(far[0], far[1])
        })
        .collect();
    let bulge = |r: &mut Random| if r.share() < 0.5 { 0.0 } else { r.between(-0.3, 0.3) };
    let edges =
        (0..count).map(|i| OutlineEdge::bulge(corners[i], corners[(i + 1) % count], bulge(random))).collect();
    let mut loops = vec![edges];
    if random.share() < 0.5 {
        loops.push(vec![OutlineEdge::arc(at, random.between(radii[0], radii[1]), 0.3, TAU)]);
    }
    Outline::new(loops, vec![]).ok()
}

fn is_feed(m: &PlannedMove) -> bool {
    matches!(m.pace, ToolpathPace::Feed(_))
}

/// Moves join, rapids down end above the material, and no move below the top comes nearer to what stays than it may.
#[track_caller]
fn sound(spec: &ContourSpec, plan: &ContourPlan) {
    let allowance = spec.finish.map_or(0.0, |f| f.allowance);
    let side = if spec.side == ContourSide::Inside { -1.0 } else { 1.0 };
    for pair in plan.moves.windows(2) {
        assert!((pair[1].curve.start() - pair[0].curve.end()).length() < 1e-6, "{pair:?}");
    }
    for m in &plan.moves {
        let (a, b) = (m.curve.start(), m.curve.end());
        if !is_feed(m) {
            let level = (a - b).truncate().length() < 1e-9;
            assert!(level || a.z.min(b.z) >= spec.retract_z - 1e-9, "{m:?}");
            assert!(b.z >= spec.approach_z - 1e-9, "{m:?}");
        }
        let wall = spec.radius() + spec.stock_to_leave + if m.finishing { 0.0 } else { allowance };
        for i in 0..=12 {
            let p = m.curve.at(m.curve.length() * f64::from(i) / 12.0).p;
            if p.z < spec.top {
                let away = side * signed(&spec.outline, p.truncate());
                assert!(away >= wall - 1e-6, "{away} at {p} of {m:?}");
            }
        }
    }
}

/// All places at which the wall is to be cut are reached at full depth: points beside the outline lie within a radius of the
/// lowest path, but in corners.
#[track_caller]
fn reaches_bottom(spec: &ContourSpec, plan: &ContourPlan) {
    let low: Vec<&PlannedMove> = plan
        .moves
        .iter()
        .filter(|m| {
            let ends = [m.curve.start().z, m.curve.end().z];
            ends.iter().all(|z| (z - spec.bottom()).abs() < 1e-9) && m.finishing == spec.finish.is_some()
        })
        .collect();
    let outward = if spec.side == ContourSide::Inside { -1.0 } else { 1.0 };
    for edge in spec.outline.edges() {
        for i in 1..10 {
            let s = f64::from(i) / 10.0;
            let p = edge.at(s)
                + outward * (spec.radius() + spec.stock_to_leave) * DVec2::from_angle(edge.outward(s));
            if outward * signed(&spec.outline, p) < spec.radius() + spec.stock_to_leave - 1e-6 {
                continue;
            }
            let near = low.iter().any(|m| {
                (0..=200).any(|k| {
                    m.curve.at(m.curve.length() * f64::from(k) / 200.0).p.truncate().distance(p) < 0.4
                })
            });
            assert!(near, "{p} is not reached");
        }
    }
}

#[test]
fn golden_feeds_at_arcs() {
    let mut seen = 0;
    for case in file("contour")["cases"].as_array().unwrap().iter().filter(|c| c["kind"] == "corner feed") {
        let (input, want) = (&case["input"], &case["expected"]);
        let of = |inside| {
            centre_feed(number(input, "wall_feed"), number(input, "wall_radius"), number(input, "a"), inside)
        };
        assert!((of(true) - number(want, "inside")).abs() < 1e-9);
        assert!((of(false) - number(want, "outside")).abs() < 1e-9);
        seen += 1;
    }
    assert_eq!(seen, 2);
}

#[test]
fn golden_levels() {
    let mut seen = 0;
    for case in file("contour")["cases"].as_array().unwrap().iter().filter(|c| c["kind"] == "levels") {
        let input = &case["input"];
        let one = ContourSpec {
            depth: number(input, "depth") - number(input, "floor_allowance"),
            stepdown: Some(number(input, "step")),
            cutter: CutterData { flute_length: 100.0, ..CUTTER },
            ..spec(rectangle(60.0, 40.0))
        };
        let (found, want) = (plan_contour(&one).unwrap().levels, numbers(&case["expected"]["levels"]));
        assert_eq!(found.len(), want.len(), "{case}");
        let tolerance = number(&case["tolerance"], "levels");
        assert!(found.iter().zip(&want).all(|(f, w)| (f - w).abs() <= tolerance), "{case}: {found:?}");
        seen += 1;
    }
    assert_eq!(seen, 4);
}

#[test]
fn a_ramped_contour_runs_its_ramps_and_one_lap_a_level() {
    let angle = 3f64.to_radians();
    for (outline, side) in [
        (rectangle(60.0, 40.0), ContourSide::Outside),
        (rectangle(61.0, 43.0), ContourSide::Inside),
        (
            Outline::new(vec![vec![OutlineEdge::arc(DVec2::ZERO, 33.0, 0.0, TAU)]], vec![]).unwrap(),
            ContourSide::Inside,
        ),
    ] {
        let free = ContourSpec { side, ..spec(outline) };
        let plan = plan_contour(&free).unwrap();
        sound(&free, &plan);
        let roles = [ToolpathRole::Entry, ToolpathRole::Circle];
        let run = |plan: &ContourPlan| -> f64 {
            let level = |m: &&PlannedMove| {
                let way = (m.curve.end() - m.curve.start()).truncate().length();
                roles.contains(&m.role) && is_feed(m) && way > 1e-9
            };
            plan.moves.iter().filter(level).map(|m| m.curve.length()).sum()
        };
        // Down from a little over the material, a lap on each of three levels, and half a radius on.
        let ramps = 10.0 / angle.sin();
        let laps = 3.0 * plan.loops[0].length();
        let found = run(&plan);
        assert!(found > ramps + laps && found < ramps + laps + 12.0, "{found} {ramps} {laps}");
        // Where a place is asked for, it is left there.
        let asked = ContourSpec { start: Some(plan.loops[0].edges[0].at(0.5)), ..free };
        let kept = plan_contour(&asked).unwrap();
        sound(&asked, &kept);
        let begins = kept.loops[0].edges[0].start;
        let last = kept.moves.iter().rposition(|m| roles.contains(&m.role)).unwrap();
        assert!(kept.moves[last].curve.end().truncate().distance(begins) < 3.0 && run(&kept) > found);
    }
}

#[test]
fn random_outlines_are_cut_whole_and_not_gouged() {
    let mut random = Random(5);
    let mut planned = 0;
    for round in 0..120 {
        let Some(outline) = star(&mut random, [25.0, 50.0], (dvec2(2.0, -1.0), [6.0, 9.0])) else { continue };
        let sides = [ContourSide::Outside, ContourSide::Inside];
        let wear = (random.share() < 0.5).then_some(Wear { register: 2, largest: 0.05 });
        let finish = ContourFinish {
            allowance: 0.3,
            feed: 15.0,
            stepdown: None,
            spring_passes: 1,
            wear,
            corner_feed: false,
        };
        let spec = ContourSpec {
            side: sides[random.below(2)],
            sense: if random.share() < 0.5 { Sense::Climb } else { Sense::Conventional },
            left_hand: random.share() < 0.3,
            breakthrough: if random.share() < 0.5 { 0.5 } else { 0.0 },
            stock_to_leave: if random.share() < 0.5 { 0.1 } else { 0.0 },
            ramp: (random.share() < 0.7).then_some(0.05),
            finish: (random.share() < 0.6).then_some(finish),
            ..spec(outline)
        };
        let plan = match plan_contour(&spec) {
            Ok(plan) => plan,
            Err(e) if [Code::CUTTER_TOO_LARGE, Code::LEAD_ROOM].contains(&e.code()) => continue,
            Err(e) if e.0.key.as_deref() == Some("finish.wear_largest") => continue,
            Err(e) => panic!("{round}: {e}"),
        };
        planned += 1;
        sound(&spec, &plan);
        reaches_bottom(&spec, &plan);
        // Climb keeps the material on the right of a clockwise spindle's travel.
        let right = (spec.sense == Sense::Climb) != spec.left_hand;
        let kept = if spec.side == ContourSide::Inside { -1.0 } else { 1.0 };
        for m in
            plan.moves.iter().filter(|m| m.role == ToolpathRole::Circle || m.role == ToolpathRole::Finish)
        {
            let middle = m.curve.at(0.5 * m.curve.length());
            let aside = middle.d1.truncate().perp() * if right { -1.0 } else { 1.0 };
            let step = 0.1 * aside;
            let nearer = kept
                * (signed(&spec.outline, middle.p.truncate() + step)
                    - signed(&spec.outline, middle.p.truncate()));
            assert!(m.curve.length() < 0.2 || nearer < -0.09, "{round}: {nearer}");
        }
    }
    assert!(planned > 80, "{planned}");
}

#[test]
fn turned_and_mirrored_contours_are_as_long() {
    let corners = [
        dvec2(0.0, 0.0),
        dvec2(70.0, 0.0),
        dvec2(70.0, 25.0),
        dvec2(30.0, 25.0),
        dvec2(30.0, 60.0),
        dvec2(0.0, 60.0),
    ];
    let outline = Outline::polygon(&corners).unwrap();
    let length = |spec: &ContourSpec| {
        let plan = plan_contour(spec).unwrap();
        sound(spec, &plan);
        plan.moves.iter().filter(|m| is_feed(m)).map(|m| m.curve.length()).sum::<f64>()
    };
    let plain = length(&spec(outline.clone()));
    for other in
        [outline.moved(0.7, dvec2(11.0, 5.0)), outline.moved(PI, dvec2(-300.0, 0.0)), outline.mirrored()]
    {
        assert!((length(&spec(other)) - plain).abs() < 1e-6);
    }
    let other = ContourSpec { sense: Sense::Conventional, left_hand: true, ..spec(outline) };
    assert!((length(&other) - plain).abs() < 1e-6);
}

#[test]
fn the_feed_at_the_wall_is_the_one_asked_for() {
    let arcs = |side: ContourSide| {
        let corner = |centre: DVec2, from: f64| OutlineEdge::arc(centre, 8.0, from, 0.5 * PI);
        let (a, b, c, d) = (dvec2(8.0, 8.0), dvec2(52.0, 8.0), dvec2(52.0, 32.0), dvec2(8.0, 32.0));
        let edges = vec![
            corner(a, PI),
            OutlineEdge::line(dvec2(8.0, 0.0), dvec2(52.0, 0.0)),
            corner(b, 1.5 * PI),
            OutlineEdge::line(dvec2(60.0, 8.0), dvec2(60.0, 32.0)),
            corner(c, 0.0),
            OutlineEdge::line(dvec2(52.0, 40.0), dvec2(8.0, 40.0)),
            corner(d, 0.5 * PI),
            OutlineEdge::line(dvec2(0.0, 32.0), dvec2(0.0, 8.0)),
        ];
        let outline = Outline::new(vec![edges], vec![]).unwrap();
        let spec = ContourSpec { side, feed_at: FeedAt::Wall, ..spec(outline) };
        let plan = plan_contour(&spec).unwrap();
        let flat = |m: &&PlannedMove| m.role == ToolpathRole::Circle && m.curve.length() < 20.0;
        let feeds: Vec<f64> = plan
            .moves
            .iter()
            .filter(flat)
            .filter(|m| m.curve.at(0.0).d2.length() > 1e-6)
            .map(|m| if let ToolpathPace::Feed(f) = m.pace { f } else { f64::NAN })
            .collect();
        assert!(feeds.len() >= 8);
        feeds
    };
    assert!(arcs(ContourSide::Outside).iter().all(|f| (f - 20.0 * 11.0 / 8.0).abs() < 1e-9));
    assert!(arcs(ContourSide::Inside).iter().all(|f| (f - 20.0 * 5.0 / 8.0).abs() < 1e-9));
}

#[test]
fn only_the_loops_that_are_asked_for_are_cut() {
    let plate = rectangle(80.0, 50.0).edges().to_vec();
    let hole = |r: f64| vec![OutlineEdge::arc(dvec2(40.0, 25.0), r, 0.0, TAU)];
    let outline = |r: f64| Outline::new(vec![plate.clone(), hole(r)], vec![]).unwrap();
    let cut = |r: f64, loops| plan_contour(&ContourSpec { loops, ..spec(outline(r)) });
    assert_eq!(cut(10.0, ContourLoops::All).unwrap().loops.len(), 2);
    // Holes come first: what they are in is then still held.
    assert!(!cut(10.0, ContourLoops::All).unwrap().loops[0].outer);
    assert!(cut(2.0, ContourLoops::Outer).unwrap().loops[0].outer);
    assert_eq!(cut(10.0, ContourLoops::Inner).unwrap().loops.len(), 1);
    let error = cut(2.0, ContourLoops::All).unwrap_err();
    let widest = error.0.bound.as_ref().unwrap().value;
    assert!(error.code() == Code::CUTTER_TOO_LARGE && (3.97..=4.0).contains(&widest), "{error}");
    let wide = cut(3.0, ContourLoops::All).unwrap_err();
    assert!(wide.code() == Code::CUTTER_TOO_LARGE, "{wide}");
}

#[test]
fn corners_that_stay_are_as_thick_as_they_are() {
    let inside = |outline: Outline| {
        let spec = ContourSpec { side: ContourSide::Inside, ..spec(outline) };
        plan_contour(&spec).unwrap()
    };
    let square = inside(rectangle(40.0, 30.0));
    assert_eq!(square.uncut.len(), 4);
    for corner in &square.uncut {
        assert!((corner.thickness.unwrap() - 3.0 * (2.0_f64.sqrt() - 1.0)).abs() < 1e-9);
    }
    assert!(square.findings.iter().any(|f| f.code == Code::CORNERS_STAY && f.severity == Severity::Warning));
    // A corner of 60 degrees, and one with a radius of 1.
    let triangle = inside(
        Outline::polygon(&[dvec2(0.0, 0.0), dvec2(60.0, 0.0), dvec2(30.0, 30.0 * 3f64.sqrt())]).unwrap(),
    );
    assert!(triangle.uncut.len() == 3 && (triangle.uncut[0].thickness.unwrap() - 3.0).abs() < 1e-9);
    let round = |r: f64| {
        let edges = vec![
            OutlineEdge::line(dvec2(r, 0.0), dvec2(40.0, 0.0)),
            OutlineEdge::line(dvec2(40.0, 0.0), dvec2(40.0, 30.0)),
            OutlineEdge::line(dvec2(40.0, 30.0), dvec2(0.0, 30.0)),
            OutlineEdge::line(dvec2(0.0, 30.0), dvec2(0.0, r)),
            OutlineEdge::arc(dvec2(r, r), r, PI, 0.5 * PI),
        ];
        inside(Outline::new(vec![edges], vec![]).unwrap())
    };
    let thin = round(1.0).uncut.iter().filter_map(|c| c.thickness).fold(f64::INFINITY, f64::min);
    assert!((thin - 2.0 * (2.0_f64.sqrt() - 1.0)).abs() < 1e-9, "{thin}");
    assert_eq!(round(3.5).uncut.len(), 3);
}

#[test]
fn gaps_between_loops_that_the_cutter_does_not_enter_are_named_with_their_place() {
    // An island 4 mm off the wall of a pocket: the cutter of 6 goes around both.
    let island: Vec<OutlineEdge> =
        rectangle(10.0, 8.0).edges().iter().map(|e| e.moved(0.0, dvec2(4.0, 20.0))).collect();
    let outline = Outline::new(vec![rectangle(60.0, 50.0).edges().to_vec(), island], vec![]).unwrap();
    let spec = ContourSpec { side: ContourSide::Inside, ..spec(outline) };
    let plan = plan_contour(&spec).unwrap();
    let between: Vec<DVec2> = plan.uncut.iter().filter(|c| c.thickness.is_none()).map(|c| c.at).collect();
    assert_eq!((plan.uncut.len(), between.len()), (6, 2), "{:?}", plan.uncut);
    assert!(between.iter().all(|p| (p.x - 3.0).abs() < 1e-6 && (p.y - 24.0).abs() < 8.0), "{between:?}");
    let message = &plan.findings[0].message;
    assert!(message.contains("stay at 4 places") && message.contains("up to 1.243 mm"), "{message}");
    assert!(
        message.contains("does not go between two loops at 2 places, for example near (3.000, "),
        "{message}"
    );
    assert!(!message.contains("inf"), "{message}");
}

#[test]
fn numbers_that_make_no_contour_are_refused_with_their_key() {
    let refused = |change: &dyn Fn(&mut ContourSpec)| {
        let mut one = spec(rectangle(60.0, 40.0));
        change(&mut one);
        plan_contour(&one).unwrap_err().0
    };
    let key = |f: &kinecut::base::Finding| f.key.clone().unwrap_or_default();
    assert_eq!(key(&refused(&|s| s.depth = 0.0)), "depth");
    assert_eq!(key(&refused(&|s| s.stepdown = Some(25.0))), "stepdown");
    assert_eq!(key(&refused(&|s| s.feed = f64::NAN)), "feed");
    let steep = refused(&|s| {
        s.cutter.max_ramp_angle = Some(0.04);
        s.ramp = Some(0.05);
    });
    assert_eq!(key(&steep), "entry.ramp");
    let plunge = refused(&|s| (s.ramp, s.cutter.centre_cutting) = (None, false));
    assert_eq!((plunge.code, key(&plunge).as_str()), (Code::ENTRY_IMPOSSIBLE, "entry"));
    let room = refused(&|s| (s.side, s.lead_radius) = (ContourSide::Inside, Some(40.0)));
    assert_eq!((room.code, key(&room).as_str()), (Code::LEAD_ROOM, "lead_radius"));
    let tabs =
        Tabs { count: 3, width: 5.0, height: 11.0, shape: TabShape::Flat, finish: true, places: vec![] };
    assert_eq!(key(&refused(&|s| s.tabs = Some(tabs.clone()))), "tabs.height");
    assert_eq!(
        refused(&|s| (s.side, s.cutter.diameter) = (ContourSide::Inside, 45.0)).code,
        Code::CUTTER_TOO_LARGE
    );
}

#[test]
fn leads_find_their_room_or_another_place() {
    // A part with a deep channel, 7 mm wide, whose flanks are the longest lines; the cutter of 6 has half a millimetre to spare.
    let channel = |width: f64| {
        let corners = [
            dvec2(0.0, 0.0),
            dvec2(90.0, 0.0),
            dvec2(90.0, 20.0),
            dvec2(12.0, 20.0),
            dvec2(12.0, 20.0 + width),
            dvec2(90.0, 20.0 + width),
            dvec2(90.0, 30.0 + width),
            dvec2(0.0, 30.0 + width),
        ];
        Outline::polygon(&corners).unwrap()
    };
    let at = |start: Option<DVec2>, lead_radius: Option<f64>, width: f64| {
        plan_contour(&ContourSpec { start, lead_radius, ..spec(channel(width)) })
            .inspect(|plan| sound(&ContourSpec { start, lead_radius, ..spec(channel(width)) }, plan))
    };
    let begins = |plan: &ContourPlan| plan.loops[0].edges[0].start;
    // By itself it begins at the longest line, outside.
    assert!(begins(&at(None, None, 7.0).unwrap()).y < 0.0);
    // In the channel there is no room for the smallest arc, but in wider ones there is, for a small one first.
    let inside = Some(dvec2(50.0, 20.0));
    assert_eq!(at(inside, None, 6.02).unwrap_err().code(), Code::LEAD_ROOM);
    let tight = at(inside, None, 6.5).unwrap();
    assert!((begins(&tight).y - 23.0).abs() < 1e-9);
    assert_eq!(at(inside, Some(1.5), 7.0).unwrap_err().code(), Code::LEAD_ROOM);
    let wide = at(inside, None, 7.0).unwrap();
    assert!((begins(&wide).y - 23.0).abs() < 1e-9);
}

#[test]
fn contours_among_islands_are_left_where_there_is_room() {
    // Twenty-five round islands 0.3 mm farther apart than the cutter is wide: every overlap ends beside a neighbour.
    let ring = OutlineEdge::arc(DVec2::ZERO, 70.0, 0.1, TAU);
    let island = |i: u32| {
        let at = 45.0 * DVec2::from_angle(TAU * f64::from(i) / 25.0);
        let corners: Vec<DVec2> =
            (0..20).map(|k| at + 2.5 * DVec2::from_angle(TAU * f64::from(k) / 20.0)).collect();
        Outline::polygon(&corners).unwrap().edges().to_vec()
    };
    let outline =
        Outline::new(std::iter::once(vec![ring]).chain((0..25).map(island)).collect(), vec![]).unwrap();
    for finish in [
        None,
        Some(ContourFinish {
            allowance: 0.1,
            feed: 15.0,
            stepdown: None,
            spring_passes: 0,
            wear: None,
            corner_feed: false,
        }),
    ] {
        let spec = ContourSpec { side: ContourSide::Inside, finish, ..spec(outline.clone()) };
        let plan = plan_contour(&spec).unwrap();
        sound(&spec, &plan);
        assert_eq!(plan.loops.len(), if finish.is_some() { 52 } else { 26 });
    }
}

#[test]
fn on_the_line_nothing_beside_it_is_cut() {
    let outline = rectangle(60.0, 40.0);
    for ramp in [Some(0.05), None] {
        let spec = ContourSpec { side: ContourSide::On, ramp, ..spec(outline.clone()) };
        let plan = plan_contour(&spec).unwrap();
        let below = plan.moves.iter().filter(|m| m.curve.start().z < -1e-9 || m.curve.end().z < -1e-9);
        for m in below {
            for i in 0..=8 {
                let p = m.curve.at(m.curve.length() * f64::from(i) / 8.0).p.truncate();
                assert!(signed(&outline, p).abs() < 1e-9, "{p}");
            }
        }
        assert!(plan.moves.windows(2).all(|w| (w[1].curve.start() - w[0].curve.end()).length() < 1e-6));
        let lengths: f64 =
            plan.moves.iter().filter(|m| m.role == ToolpathRole::Circle).map(|m| m.curve.length()).sum();
        assert!(lengths > 3.0 * 200.0);
    }
}

#[test]
fn no_arc_is_wider_than_a_half_circle() {
    let circle = Outline::new(vec![vec![OutlineEdge::arc(dvec2(5.0, 5.0), 20.0, 0.0, TAU)]], vec![]).unwrap();
    for start in [None, Some(dvec2(28.0, 5.0)), Some(dvec2(5.0, 28.0))] {
        let plan = plan_contour(&ContourSpec { start, ..spec(circle.clone()) }).unwrap();
        let around = plan.moves.iter().filter(|m| m.role == ToolpathRole::Circle).map(|m| m.curve.length());
        assert!(around.fold(0.0, f64::max) < 23.0 * PI + 1e-6);
    }
}

#[test]
fn finishing_comes_on_from_where_roughing_has_run() {
    for (allowance, lead_radius) in [(0.2, None), (2.5, None), (1.0, Some(0.5))] {
        for outline in [
            rectangle(60.0, 40.0),
            Outline::new(vec![vec![OutlineEdge::arc(DVec2::ZERO, 9.0, 0.0, TAU)]], vec![]).unwrap(),
        ] {
            for side in [ContourSide::Outside, ContourSide::Inside] {
                let finish = ContourFinish {
                    allowance,
                    feed: 15.0,
                    stepdown: None,
                    spring_passes: 0,
                    wear: None,
                    corner_feed: false,
                };
                let spec = ContourSpec { side, lead_radius, finish: Some(finish), ..spec(outline.clone()) };
                let plan = plan_contour(&spec).unwrap();
                sound(&spec, &plan);
                let first =
                    plan.moves.iter().find(|m| m.finishing && m.role == ToolpathRole::LeadIn).unwrap();
                let away = signed(&outline, first.curve.start().truncate()).abs();
                assert!((away - 3.0 - allowance).abs() < 1e-5, "{allowance} {side:?} {away}");
            }
        }
    }
}
