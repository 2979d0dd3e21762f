//! Contours along open lines: distances by dense points, the side, the travel, what is reached.

use std::f64::consts::PI;

use kinecut::contouring::PlannedLoop;

use super::*;

fn line(points: &[[f64; 3]]) -> Vec<OutlineEdge> {
    let at = |p: &[f64; 3]| dvec2(p[0], p[1]);
    points.windows(2).map(|w| OutlineEdge::bulge(at(&w[0]), at(&w[1]), w[0][2])).collect()
}

fn lines(points: &[[f64; 3]]) -> Outline {
    Outline::of_lines(vec![line(points)], vec![]).unwrap()
}

fn along(outline: &Outline, side: ContourSide) -> ContourSpec {
    ContourSpec { side, ramp: None, ..spec(outline.clone()) }
}

/// Distance of a point from the lines, by dense points of them, and whether it is on their left.
fn beside(outline: &Outline, p: DVec2) -> (f64, bool) {
    let mut best = (f64::INFINITY, false);
    for edge in outline.lines().flatten() {
        for i in 0..=2000 {
            let s = f64::from(i) / 2000.0;
            let q = edge.at(s);
            if q.distance(p) < best.0 {
                best = (q.distance(p), DVec2::from_angle(edge.heading(s)).perp_dot(p - q) > 0.0);
            }
        }
    }
    best
}

/// The lowest moves beside the line, without leads.
fn laps(plan: &ContourPlan) -> Vec<&PlannedMove> {
    let is_lap = |m: &&PlannedMove| matches!(m.role, ToolpathRole::Circle | ToolpathRole::Finish);
    plan.moves.iter().filter(is_lap).collect()
}

#[test]
fn a_path_along_a_line_keeps_to_its_side_and_direction() {
    let bent = lines(&[[0.0, 0.0, 0.0], [40.0, 0.0, 0.4], [40.0, 30.0, 0.0], [10.0, 45.0, 0.0]]);
    for (side, sense, left_hand, with_line) in [
        (ContourSide::Left, Sense::Climb, false, true),
        (ContourSide::Left, Sense::Conventional, false, false),
        (ContourSide::Left, Sense::Climb, true, false),
        (ContourSide::Right, Sense::Climb, false, false),
        (ContourSide::Right, Sense::Conventional, false, true),
    ] {
        let spec = ContourSpec { sense, left_hand, ..along(&bent, side) };
        let plan = plan_contour(&spec).unwrap();
        for m in laps(&plan) {
            for i in 1..20 {
                let p = m.curve.at(m.curve.length() * f64::from(i) / 20.0).p.truncate();
                let (far, on_left) = beside(&bent, p);
                assert!((far - 3.0).abs() < 1e-3 && on_left == (side == ContourSide::Left), "{p} {far}");
            }
        }
        let all = laps(&plan);
        let (first, last) = (all[0].curve.start().truncate(), all[all.len() - 1].curve.end().truncate());
        let forward = last.distance(dvec2(0.0, 0.0)) > first.distance(dvec2(0.0, 0.0));
        assert_eq!(forward, with_line, "{side:?} {sense:?} {left_hand}");
        // Three levels, each from one end to the other.
        assert_eq!(plan.levels.len(), 3);
        // The right side goes around the arc and the corner: both turn to the left.
        let length = plan.loops[0].length();
        let sweep = 4.0 * 0.4_f64.atan();
        let radius = 15.0 / (0.5 * sweep).sin();
        let (out, corner) = (radius * sweep, 45.0_f64.hypot(0.0));
        assert!(length > 60.0 && length < 40.0 + out + corner + 6.0 * PI, "{length}");
    }
}

#[test]
fn a_straight_line_has_the_path_of_its_length() {
    let straight = lines(&[[0.0, 0.0, 0.0], [40.0, 0.0, 0.0]]);
    for (side, y) in [(ContourSide::Left, 3.4), (ContourSide::Right, -3.4), (ContourSide::On, 0.0)] {
        let leave = if side == ContourSide::On { 0.0 } else { 0.4 };
        let spec = ContourSpec { stock_to_leave: leave, ..along(&straight, side) };
        let plan = plan_contour(&spec).unwrap();
        assert!((plan.loops[0].length() - 40.0).abs() < 1e-9);
        assert!(laps(&plan).iter().all(|m| (m.curve.start().y - y).abs() < 1e-9));
        assert!(plan.uncut.is_empty() && plan.findings.is_empty());
    }
}

#[test]
fn a_ramp_goes_to_and_fro_and_never_steeper() {
    let straight = lines(&[[0.0, 0.0, 0.0], [30.0, 0.0, 0.0], [30.0, 10.0, 0.0]]);
    let angle = 3.0_f64.to_radians();
    let spec = ContourSpec { ramp: Some(angle), ..along(&straight, ContourSide::Left) };
    let plan = plan_contour(&spec).unwrap();
    let slope = |m: &&PlannedMove| {
        let (a, b) = (m.curve.start(), m.curve.end());
        (a.z - b.z) / (a - b).truncate().length()
    };
    let ramps: Vec<&PlannedMove> = plan
        .moves
        .iter()
        .filter(|m| {
            m.role == ToolpathRole::Entry && (m.curve.start() - m.curve.end()).truncate().length() > 1e-6
        })
        .collect();
    // To and fro at each of three levels, with a corner on the way.
    assert!(ramps.len() >= 4, "{}", ramps.len());
    for m in &ramps {
        assert!((slope(m) - angle.tan()).abs() < 1e-9, "{m:?}");
    }
    // Down all of the depth, and half a millimetre over each level.
    let fallen: f64 = ramps.iter().map(|m| m.curve.start().z - m.curve.end().z).sum();
    assert!((fallen - 11.5).abs() < 1e-9, "{fallen}");
    reaches(&spec, &plan);
}

/// All of the wanted side is reached at full depth, but in corners.
fn reaches(spec: &ContourSpec, plan: &ContourPlan) {
    let sign = if spec.side == ContourSide::Left { 1.0 } else { -1.0 };
    let wall = spec.radius() + spec.stock_to_leave;
    let low: Vec<Vec<DVec2>> = plan
        .moves
        .iter()
        .filter(|m| {
            let ends = [m.curve.start().z, m.curve.end().z];
            ends.iter().all(|z| (z - spec.bottom()).abs() < 1e-9) && m.finishing == spec.finish.is_some()
        })
        .map(|m| {
            (0..=200).map(|k| m.curve.at(m.curve.length() * f64::from(k) / 200.0).p.truncate()).collect()
        })
        .collect();
    for edge in spec.outline.lines().flatten() {
        for i in 1..10 {
            let s = f64::from(i) / 10.0;
            let p = edge.at(s) + sign * wall * DVec2::from_angle(edge.heading(s)).perp();
            if beside(&spec.outline, p).0 < wall - 1e-3 {
                continue;
            }
            assert!(low.iter().flatten().any(|q| q.distance(p) < 0.4), "{p} is not reached");
        }
    }
}

#[test]
fn random_lines_are_cut_on_either_side() {
    let mut random = Random(20_261_130);
    let (mut planned, mut finished) = (0, 0);
    for round in 0..kinecut_cases::cases(120, 3000) {
        let mut points = vec![[0.0, 0.0, 0.0]];
        let mut heading = 0.0;
        for _ in 0..1 + random.below(6) {
            heading += random.between(-2.0, 2.0);
            let last = points.len() - 1;
            points[last][2] = if random.share() < 0.4 { random.between(-0.6, 0.6) } else { 0.0 };
            let next = dvec2(points[last][0], points[last][1])
                + random.between(8.0, 40.0) * DVec2::from_angle(heading);
            points.push([next.x, next.y, 0.0]);
        }
        let Ok(outline) = Outline::of_lines(vec![line(&points)], vec![]) else { continue };
        let finish = (random.share() < 0.5).then_some(ContourFinish {
            allowance: 0.3,
            feed: 10.0,
            stepdown: None,
            spring_passes: random.below(2) as u32,
            wear: None,
            corner_feed: random.share() < 0.5,
        });
        let spec = ContourSpec {
            side: if random.share() < 0.5 { ContourSide::Left } else { ContourSide::Right },
            sense: if random.share() < 0.5 { Sense::Climb } else { Sense::Conventional },
            ramp: (random.share() < 0.5).then_some(0.1),
            finish,
            ..spec(outline.clone())
        };
        let plan = match plan_contour(&spec) {
            Ok(plan) => plan,
            Err(e) if [Code::CUTTER_TOO_LARGE, Code::LEAD_ROOM].contains(&e.code()) => continue,
            Err(e) => panic!("{round}: {e} {points:?}"),
        };
        planned += 1;
        finished += usize::from(finish.is_some());
        sound(&spec, &plan);
        reaches(&spec, &plan);
        let sign = if spec.side == ContourSide::Left { 1.0 } else { -1.0 };
        for one in &plan.loops {
            let wall = spec.radius() + if one.finishing { 0.0 } else { finish.map_or(0.0, |f| f.allowance) };
            // At its middle, the path runs on the wanted side.
            let half = 0.5 * one.length();
            let mut gone = 0.0;
            let middle = one.edges.iter().find(|e| {
                gone += e.length();
                gone >= half
            });
            let p = middle.unwrap().at(0.5);
            let foot = outline
                .lines()
                .flatten()
                .map(|e| (e, e.nearest(p)))
                .min_by(|a, b| a.1.1.total_cmp(&b.1.1))
                .unwrap();
            assert!((foot.1.1 - wall).abs() < 1e-6, "{round}");
            let ahead = DVec2::from_angle(foot.0.heading(foot.1.0));
            let side = ahead.perp_dot(p - foot.0.at(foot.1.0));
            // About an end either edge of the line is as near.
            assert!(side * sign > -1e-6, "{round} {p} {side}");
        }
    }
    assert!(planned > 40 && finished > 10, "{planned} {finished}");
}

#[test]
fn lines_and_faces_have_sides_of_their_own() {
    let open = lines(&[[0.0, 0.0, 0.0], [40.0, 0.0, 0.0]]);
    let refused = |spec: &ContourSpec| plan_contour(spec).unwrap_err();
    for side in [ContourSide::Outside, ContourSide::Inside] {
        assert_eq!(refused(&along(&open, side)).code(), Code::PLAN_VALUE);
    }
    for side in [ContourSide::Left, ContourSide::Right] {
        assert_eq!(refused(&along(&rectangle(40.0, 30.0), side)).code(), Code::PLAN_VALUE);
    }
    let tabs =
        Tabs { count: 1, width: 4.0, height: 1.0, shape: TabShape::Flat, finish: true, places: vec![] };
    let held = ContourSpec { tabs: Some(tabs), ..along(&open, ContourSide::Left) };
    assert_eq!(refused(&held).0.key.as_deref(), Some("tabs"));
    // A channel that is narrower than the cutter has no path inside.
    let channel = lines(&[[0.0, 0.0, 0.0], [40.0, 0.0, 0.0], [40.0, 5.0, 0.0], [0.0, 5.0, 0.0]]);
    let narrow = refused(&along(&channel, ContourSide::Left));
    assert!(narrow.code() == Code::CUTTER_TOO_LARGE && narrow.0.key.as_deref() == Some("tool"), "{narrow}");
    assert!(plan_contour(&along(&channel, ContourSide::Right)).is_ok());
    // A cutter that does not cut at its centre comes down only where all is clear.
    let blunt = CutterData { centre_cutting: false, ..CUTTER };
    let spec = ContourSpec { cutter: blunt, ..along(&open, ContourSide::Left) };
    assert_eq!(refused(&spec).code(), Code::ENTRY_IMPOSSIBLE);
    assert!(plan_contour(&ContourSpec { clear_ends: true, ..spec }).is_ok());
}

#[test]
fn behind_a_neck_all_of_the_wall_is_finished() {
    // A chamber of 24 by 20 behind a neck of 5, which a cutter of 6 does not pass.
    let corners = [
        [-40.0, 0.0],
        [-2.5, 0.0],
        [-2.5, -5.0],
        [-12.0, -5.0],
        [-12.0, -25.0],
        [12.0, -25.0],
        [12.0, -5.0],
        [2.5, -5.0],
        [2.5, 0.0],
        [40.0, 0.0],
    ];
    let outline = lines(&corners.map(|[x, y]| [x, y, 0.0]));
    let finish = ContourFinish {
        allowance: 0.3,
        feed: 10.0,
        stepdown: None,
        spring_passes: 0,
        wear: None,
        corner_feed: false,
    };
    // About the corners of the neck, the path turns by this angle on each side.
    let about = 3.0 * (2.5_f64 / 3.0).asin();
    for (side, sense) in [
        (ContourSide::Left, Sense::Climb),
        (ContourSide::Left, Sense::Conventional),
        (ContourSide::Right, Sense::Climb),
    ] {
        let spec = ContourSpec {
            sense,
            finish: Some(finish),
            ramp: Some(0.1),
            extended: vec![[8.0, 8.0]],
            ..along(&outline, side)
        };
        let plan = plan_contour(&spec).unwrap();
        sound(&spec, &plan);
        reaches(&spec, &plan);
        let piece = |one: &PlannedLoop| one.piece.as_ref().is_some_and(|p| p.closed);
        let finishing: Vec<&PlannedLoop> = plan.loops.iter().filter(|l| l.finishing).collect();
        let closed: Vec<f64> = finishing.iter().filter(|l| piece(l)).map(|l| l.length()).collect();
        let open: Vec<f64> = finishing.iter().filter(|l| !piece(l)).map(|l| l.length()).collect();
        assert_eq!((open.len(), closed.len()), (1, usize::from(side == ContourSide::Left)));
        if side == ContourSide::Left {
            let around = 18.0 + 2.0 * 14.0 + 2.0 * 6.5 + 2.0 * about;
            assert!((closed[0] - around).abs() < 1e-6, "{} {around}", closed[0]);
            // Over the neck; shorter by the leads where the line was made longer.
            let over = 2.0 * 37.5 + 2.0 * about;
            assert!(open[0] < over - 1.0 && open[0] > over - 16.0, "{} {over}", open[0]);
        }
    }
    let blunt = CutterData { centre_cutting: false, ..CUTTER };
    let spec = ContourSpec { cutter: blunt, clear_ends: true, ..along(&outline, ContourSide::Left) };
    let e = plan_contour(&spec).unwrap_err();
    assert!(e.code() == Code::ENTRY_IMPOSSIBLE && e.0.key.as_deref() == Some("entry"), "{e}");
}
