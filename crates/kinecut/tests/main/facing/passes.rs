//! Passes over a face against brute force and the golden figures: first contact of any path, rows, frames, coverage.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, dvec2};
use kinecut::base::{Code, Silent};
use kinecut::facing::passes::{
    Corner, Fill, FrameOptions, Met, MilledRow, MilledRows, PassKind, PassOptions, PassPath, RowWays,
    best_rows, frames, offset_loops, pareto, path_burr, uncovered,
};
use kinecut::facing::{BadPart, BadSet, FaceCase, Placement, bad_length};
use kinecut::geom::{Outline, OutlineEdge};
use proptest::prelude::*;

use crate::common::burr_golden::Golden;
use crate::common::stop::Stop;

fn below_90(outline: Outline, radius: f64) -> FaceCase {
    FaceCase::new(outline, radius, BadSet::below(FRAC_PI_2).unwrap()).unwrap()
}

fn straight(case: &FaceCase, placement: Placement) -> PassPath {
    let extent = case.outline.extent(placement.feed_in_part());
    PassPath::straight(placement, extent, case.radius + 5.0)
}

/// A flange: an outer loop of lines and arcs, a round bore, a slot.
fn flange() -> Outline {
    let outer = vec![
        OutlineEdge::line(dvec2(-60.0, -30.0), dvec2(50.0, -30.0)),
        OutlineEdge::arc(dvec2(50.0, 0.0), 30.0, -FRAC_PI_2, PI),
        OutlineEdge::line(dvec2(50.0, 30.0), dvec2(10.0, 30.0)),
        OutlineEdge::arc(dvec2(0.0, 30.0), 10.0, 0.0, -PI),
        OutlineEdge::line(dvec2(-10.0, 30.0), dvec2(-60.0, 35.0)),
        OutlineEdge::line(dvec2(-60.0, 35.0), dvec2(-60.0, -30.0)),
    ];
    let bore = vec![OutlineEdge::arc(dvec2(45.0, 2.0), 14.0, 1.0, TAU)];
    let slot = vec![
        OutlineEdge::line(dvec2(-40.0, -10.0), dvec2(-10.0, -8.0)),
        OutlineEdge::line(dvec2(-10.0, -8.0), dvec2(-12.0, 8.0)),
        OutlineEdge::line(dvec2(-12.0, 8.0), dvec2(-40.0, 5.0)),
        OutlineEdge::line(dvec2(-40.0, 5.0), dvec2(-40.0, -10.0)),
    ];
    Outline::new(vec![outer, bore, slot], vec![]).unwrap()
}

fn two_parts() -> BadSet {
    BadSet::new(vec![
        BadPart { from: 0.0, to: 0.7, weight: 2.0 },
        BadPart { from: 1.2, to: 2.1, weight: 0.5 },
    ])
    .unwrap()
}

/// Lengths by walking along the path in small steps until a sample of an edge is covered: shares no code with what it
/// checks.
struct Walked {
    bad: f64,
    exits: f64,
    uncut: f64,
    lowered: f64,
}

fn walk(case: &FaceCase, path: &PassPath, spacing: f64, clockwise: bool) -> Walked {
    let mut walked = Walked { bad: 0.0, exits: 0.0, uncut: 0.0, lowered: 0.0 };
    for (edge, edge_weight) in case.outline.edges().iter().zip(&case.weights) {
        let n = (edge.length() / spacing).ceil();
        for k in 0..n as usize {
            let s = (k as f64 + 0.5) / n;
            let (p, cell) = (edge.at(s), edge.length() / n);
            let Some((centre, lowered)) = first_centre(path, p, case.radius) else {
                walked.uncut += cell;
                continue;
            };
            if lowered {
                walked.lowered += cell;
                continue;
            }
            let arm = p - centre;
            let ahead = edge.at((s + 1e-6).min(1.0)) - edge.at(s - 1e-6);
            // Against the clock all is seen in a mirror: the edge runs the other way, angles count clockwise.
            let psi = if clockwise {
                let velocity = dvec2(arm.y, -arm.x);
                ahead.perp_dot(velocity).atan2(ahead.dot(velocity))
            } else {
                let velocity = dvec2(-arm.y, arm.x);
                (-velocity.perp_dot(ahead)).atan2(-velocity.dot(ahead))
            };
            if psi > 0.0 {
                walked.exits += cell;
                walked.bad += cell * edge_weight * case.bad.weight(psi);
            }
        }
    }
    walked
}

fn first_centre(path: &PassPath, p: DVec2, radius: f64) -> Option<(DVec2, bool)> {
    for chain in &path.chains {
        if chain[0].start.distance(p) <= radius {
            return Some((chain[0].start, true));
        }
        for piece in chain {
            // A step never passes over contact: the centre must come nearer by the gap.
            let (mut s, length) = (0.0, piece.length());
            while s <= 1.0 {
                let gap = piece.at(s).distance(p) - radius;
                if gap <= 1e-7 {
                    return Some((piece.at(s), false));
                }
                s += gap / length;
            }
        }
    }
    None
}

#[test]
fn a_straight_pass_is_the_closed_form_on_all_golden_cases() {
    let golden = Golden::read();
    for c in &golden.cases {
        let bad = BadSet::below(c.psi0_deg.to_radians()).unwrap();
        let case = FaceCase::new(golden.outline(&c.polygon), c.radius, bad).unwrap();
        let placement = Placement { angle: c.gamma_deg.to_radians(), offset: c.r - c.ty };
        let burr = path_burr(&case, &straight(&case, placement));
        assert!((burr.bad - c.f_limit).abs() < 1e-8, "{}: {} against {}", c.id, burr.bad, c.f_limit);
        let total = burr.exits + burr.entries + burr.uncut + burr.lowered;
        assert!((total - case.outline.perimeter()).abs() < 1e-9, "{}", c.id);
    }
}

#[test]
fn the_z_plate_at_its_optimum_has_its_golden_value_as_a_path() {
    let golden = Golden::read();
    let plate = &golden.polygons["Z_plate"];
    let o = plate.optima.iter().find(|o| o.psi0_deg == 90.0 && o.guard_deg == 0.0).unwrap();
    let case = below_90(plate.outline(), o.radius);
    let placement = Placement { angle: o.gamma_deg.to_radians(), offset: o.c };
    let burr = path_burr(&case, &straight(&case, placement));
    assert!((burr.bad - 63.436).abs() < 5e-4, "{}", burr.bad);
    assert!((burr.bad - o.value).abs() < 1e-6, "{} against {}", burr.bad, o.value);
}

proptest! {
    #![proptest_config(kinecut_cases::property(200))]
    #[test]
    fn a_straight_pass_over_arcs_is_the_closed_form(
        angle in -3.2..3.2f64, offset in -60.0..60.0f64, radius in 20.0..90.0f64, guard in 0.0..0.1f64,
    ) {
        let case = FaceCase::new(flange(), radius, two_parts().guarded(guard)).unwrap();
        let weights = (0..case.outline.edges().len()).map(|i| 0.5 * (i % 4) as f64).collect();
        let case = case.with_weights(weights).unwrap();
        let placement = Placement { angle, offset };
        let have = path_burr(&case, &straight(&case, placement)).bad;
        let want = bad_length(&case, placement);
        prop_assert!((have - want).abs() < 1e-9 * case.outline.perimeter(), "{have} against {want}");
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(30))]
    #[test]
    fn a_path_of_any_form_is_what_walking_along_it_finds(
        c in prop::collection::vec(-1.0..1.0f64, 16), radius in 12.0..45.0f64, lower_inside: bool,
    ) {
        let start = if lower_inside { dvec2(20.0 * c[0], 20.0 * c[1]) } else { dvec2(-160.0, 60.0 * c[1]) };
        let first = OutlineEdge::line(start, dvec2(-20.0 + 30.0 * c[2], 30.0 * c[3]));
        let bend = OutlineEdge::bulge(first.end, dvec2(60.0 * c[4], 40.0 * c[5]), 1.5 * c[6]);
        let turn = OutlineEdge::bulge(bend.end, dvec2(70.0 * c[7], 40.0 * c[8]), 3.0 * c[9]);
        let centre = dvec2(40.0 * c[10], 20.0 * c[11]);
        let ring = OutlineEdge::arc(centre, 3.0 + 40.0 * c[12].abs(), 3.0 * c[13], TAU.copysign(c[14]));
        let last = OutlineEdge::line(dvec2(-200.0, 60.0 * c[15]), dvec2(200.0, 40.0 * c[14]));
        let path = PassPath::new(vec![vec![first, bend, turn], vec![ring], vec![last]]);
        let weights = (0..flange().edges().len()).map(|i| 0.5 * (i % 4) as f64).collect();
        let case = FaceCase::new(flange(), radius, two_parts()).unwrap().with_weights(weights).unwrap();
        let burr = path_burr(&case, &path);
        let walked = walk(&case, &path, 0.1, true);
        // Each of some dozens of ends is found by samples to within half their spacing, weights up to 3.
        for (have, want) in [
            (burr.bad, walked.bad),
            (burr.exits, walked.exits),
            (burr.uncut, walked.uncut),
            (burr.lowered, walked.lowered),
        ] {
            prop_assert!((have - want).abs() < 1.5, "{have} against {want}: {burr:?}");
        }
        let mut at = (0, 0.0);
        for s in &burr.stretches {
            prop_assert!(s.from < s.to);
            if s.edge != at.0 {
                prop_assert!(at.1 == 1.0 && s.from == 0.0 && s.edge == at.0 + 1);
            } else {
                prop_assert!(s.from == at.1);
            }
            at = (s.edge, s.to);
            if let Met::First { angles, exit, .. } = s.met {
                for psi in angles {
                    let (low, high) = if exit { (0.0, PI) } else { (-FRAC_PI_2, 1.5 * PI) };
                    prop_assert!(low - 1e-6 <= psi && psi <= high + 1e-6, "{psi} {s:?}");
                }
            }
        }
        // M4 is the mirror image.
        let mirrored = path_burr(&case.mirrored(), &path.mirrored());
        let walked = walk(&case, &path, 0.1, false);
        prop_assert!((mirrored.bad - walked.bad).abs() < 1.5, "{} {}", mirrored.bad, walked.bad);
        prop_assert!((mirrored.exits - burr.entries).abs() < 1e-6);
        // Turning part and path together changes nothing.
        let moved = FaceCase { outline: case.outline.moved(1.1, dvec2(30.0, -9.0)), ..case.clone() };
        let moved = path_burr(&moved, &path.moved(1.1, dvec2(30.0, -9.0)));
        prop_assert!((moved.bad - burr.bad).abs() < 1e-6, "{} {}", moved.bad, burr.bad);
    }
}

fn plate_200_by_120() -> FaceCase {
    let corners = [dvec2(0.0, 0.0), dvec2(200.0, 0.0), dvec2(200.0, 120.0), dvec2(0.0, 120.0)];
    below_90(Outline::polygon(&corners).unwrap(), 40.0)
}

#[test]
fn golden_rows_of_the_plate() {
    let case = plate_200_by_120();
    let zigzag = MilledRows::even(&case, 0.0, 3, RowWays::Zigzag);
    assert!((path_burr(&case, &zigzag.path(&case, 45.0)).bad - 260.0).abs() < 1e-9);
    for (count, golden) in [(2, 44.0), (3, 6.0), (4, 0.0)] {
        let margin = 0.8;
        let rows = best_rows(&case, 0.0, count, margin, RowWays::Free).unwrap();
        let path = rows.path(&case, 45.0);
        let burr = path_burr(&case, &path);
        assert!(burr.bad <= golden + 1e-9, "{count}: {} against {golden}", burr.bad);
        assert!((burr.bad - rows.bad_length(&case)).abs() < 1e-9);
        assert!(uncovered(&case, &path, margin, 9).is_none());
        assert!(burr.uncut == 0.0 && burr.lowered == 0.0);
    }
}

/// Where a row's reach grazes an arc of radius r, rounding e of a coordinate moves the end of a stretch by sqrt(2 r e):
/// half a micrometre for 20 mm and 1e-14 mm.
const GRAZED: f64 = 2e-6;

proptest! {
    #![proptest_config(kinecut_cases::property(60))]
    #[test]
    fn the_cost_of_rows_is_that_of_their_path(
        angle in -3.2..3.2f64,
        radius in 15.0..50.0f64,
        offsets in prop::collection::vec((-70.0..70.0f64, any::<bool>()), 1..5),
    ) {
        let case = FaceCase::new(flange(), radius, two_parts()).unwrap();
        let mut rows = MilledRows { angle, rows: Vec::new() };
        rows.rows.extend(offsets.into_iter().map(|(offset, forward)| MilledRow { offset, forward }));
        rows.rows.sort_by(|a, b| a.offset.total_cmp(&b.offset));
        let burr = path_burr(&case, &rows.path(&case, radius + 1.0));
        let have = rows.bad_length(&case);
        prop_assert!((have - burr.bad).abs() < GRAZED, "{have} against {}", burr.bad);
        prop_assert!(burr.lowered == 0.0);
        // Seen from the other side the rows are the same lines; milled in this order they still are.
        let flip = |row: &MilledRow| MilledRow { offset: -row.offset, forward: !row.forward };
        let half = MilledRows { angle: rows.angle + PI, rows: rows.rows.iter().map(flip).collect() };
        let again = path_burr(&case, &half.path(&case, radius + 1.0)).bad;
        prop_assert!((again - burr.bad).abs() < GRAZED, "{again} {}", burr.bad);
    }

    #[test]
    fn best_rows_are_not_beaten_by_random_ones(
        angle in -3.2..3.2f64,
        shares in prop::collection::vec(0.0..1.0f64, 40),
        ways in prop::collection::vec(any::<bool>(), 40),
    ) {
        let case = FaceCase::new(flange(), 30.0, two_parts()).unwrap();
        let (count, margin) = (3, 0.6);
        let reach = case.radius - margin;
        let Some(best) = best_rows(&case, angle, count, margin, RowWays::Free) else {
            prop_assert!(MilledRows::least(&case, angle, margin).unwrap() > count);
            return Ok(());
        };
        let value = best.bad_length(&case);
        let [low, high] = case.outline.extent(dvec2(angle.sin(), angle.cos()));
        for k in 0..13 {
            let mut before = low - reach;
            let mut rows = MilledRows { angle, rows: Vec::new() };
            for j in 0..count {
                before += 2.0 * reach * shares[3 * k + j].sqrt();
                rows.rows.push(MilledRow { offset: before, forward: ways[3 * k + j] });
            }
            if before >= high - reach {
                prop_assert!(rows.bad_length(&case) >= value - 1e-9, "{rows:?} beats {best:?}");
            }
        }
    }
}

#[test]
fn rows_of_a_flange_that_one_descent_does_not_find() {
    let case = FaceCase::new(flange(), 30.0, two_parts()).unwrap();
    let angle = -1.7636276604453798;
    let best = best_rows(&case, angle, 3, 0.6, RowWays::Free).unwrap();
    let row = |offset, forward| MilledRow { offset, forward };
    let rows =
        vec![row(-54.04432641017894, false), row(-5.875581388568165, true), row(52.33478625514255, true)];
    let given = MilledRows { angle, rows };
    let [have, found] = [given.bad_length(&case), best.bad_length(&case)];
    assert!(found <= have + 1e-9, "{found} {best:?} against {have}");
}

#[test]
fn golden_frames_of_the_plate() {
    let case = plate_200_by_120();
    for (outside, clockwise, counter) in [(10.0, 0.0, 90.0), (0.0, 0.0, 120.0), (-20.0, 60.0, 520.0)] {
        for corner in [Corner::Sharp, Corner::Round] {
            let one = &offset_loops(&case.outline, outside, corner)[0];
            for (reversed, golden) in [(false, clockwise), (true, counter)] {
                let path = PassPath::new(vec![one.clone()]);
                let mut path = if reversed { path.reversed() } else { path };
                // Straight in from beside the part.
                let first = path.chains[0][0];
                let from = first.start - 300.0 * DVec2::from_angle(first.heading(0.0));
                path.chains[0].insert(0, OutlineEdge::line(from, first.start));
                let burr = path_burr(&case, &path);
                assert!((burr.bad - golden).abs() < 1e-9, "{outside} {reversed}: {}", burr.bad);
            }
            for fill in [Fill::Rings, Fill::Rows(0.0)] {
                let options =
                    FrameOptions { outside, corner, fill, holes: false, margin: 0.8, clearance: 5.0 };
                let path = frames(&case, &options).unwrap();
                let burr = path_burr(&case, &path);
                assert!((burr.bad - clockwise).abs() < 1e-9, "{options:?}: {}", burr.bad);
                assert!(burr.uncut == 0.0 && burr.lowered == 0.0);
                assert!(uncovered(&case, &path, 0.8, 9).is_none());
                for w in path.chains.iter().flat_map(|c| c.windows(2)) {
                    assert!(w[0].end.distance(w[1].start) < 1e-9);
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(40))]
    #[test]
    fn offsets_bound_what_is_nearer_to_the_outline(aside in -16.0..25.0f64, angle in -3.0..3.0f64, sharp: bool) {
        prop_assume!(aside.abs() > 0.5);
        let outline = flange().moved(angle, dvec2(7.0, -3.0));
        let corner = if sharp { Corner::Sharp } else { Corner::Round };
        let offset = offset_loops(&outline, aside, corner);
        let dots: Vec<DVec2> =
            outline.edges().iter().flat_map(|e| (0..=400).map(|k| e.at(f64::from(k) / 400.0))).collect();
        let away = |p: DVec2| dots.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
        for one in &offset {
            for (edge, next) in one.iter().zip(one.iter().cycle().skip(1)) {
                prop_assert!(edge.end.distance(next.start) < 1e-9);
                let gap = away(edge.at(0.5));
                prop_assert!(gap > aside.abs() - 1e-5, "{gap}");
                prop_assert!(sharp || gap < aside.abs() + 0.05, "{gap}");
            }
        }
        let within = (!offset.is_empty()).then(|| Outline::new(offset, vec![]).unwrap());
        for k in 0..300 {
            let p = dvec2(7.0, -3.0) + (0.35 * f64::from(k)) * DVec2::from_angle(2.4 * f64::from(k));
            let (gap, in_part) = (away(p), outline.contains(p));
            // Near the offset itself samples do not tell; sharp corners are farther than the offset.
            if (gap - aside.abs()).abs() < 0.1 || sharp && gap > aside.abs() && gap < 1.6 * aside.abs() {
                continue;
            }
            let want = if aside > 0.0 { in_part || gap < aside } else { in_part && gap > -aside };
            let have = within.as_ref().is_some_and(|o| o.contains(p));
            prop_assert!(have == want, "{aside} {p}");
        }
    }
}

#[test]
fn every_plan_covers_and_none_that_is_efficient_is_beaten() {
    let options =
        PassOptions { more_rows: 1, even_angles: 2, frames: vec![0.25, -0.25], ..PassOptions::default() };
    for case in [plate_200_by_120(), below_90(flange(), 25.0)] {
        let optimum = Placement { angle: 0.3, offset: 2.0 };
        let plans = pareto(&case, &[optimum], &options, &Silent).unwrap();
        assert!(plans.windows(2).all(|w| w[0].time <= w[1].time));
        // As drawn, and too wide for one pass: with the place that is left.
        let drawn = plans.iter().find(|p| p.uncovered.is_some()).unwrap();
        let left = drawn.uncovered.unwrap();
        assert!(case.outline.contains(left) && drawn.path.distance(left) > case.radius - options.margin);
        assert_eq!(drawn.finding().unwrap().code, Code::FACE_UNCUT);
        assert!(!drawn.efficient && plans.iter().filter(|p| p.uncovered.is_some()).count() == 1);
        let best: Vec<_> = plans.iter().filter(|p| p.efficient).collect();
        assert!(best.len() >= 3);
        assert!(best.windows(2).all(|w| w[1].burr.bad < w[0].burr.bad && w[1].time > w[0].time));
        for plan in plans.iter().filter(|p| p.uncovered.is_none()) {
            assert!(plan.burr.uncut == 0.0 && plan.burr.lowered == 0.0, "{}", plan.note);
            let beaten = best.iter().any(|b| b.burr.bad <= plan.burr.bad + 1e-6 && b.time <= plan.time);
            assert!(beaten, "{}", plan.note);
            let feed: f64 = plan.path.feed_length() / options.feed;
            assert!(plan.time >= feed && plan.time < 1.2 * feed);
            if let PassKind::Rows { rows, .. } = &plan.kind {
                assert!((rows.bad_length(&case) - plan.burr.bad).abs() < 1e-8, "{}", plan.note);
            }
        }
        assert_eq!(plans, pareto(&case, &[optimum], &options, &Silent).unwrap());
    }
}

#[test]
fn a_search_that_is_stopped_says_so_and_bad_options_are_refused() {
    let case = plate_200_by_120();
    let options = PassOptions::default();
    assert_eq!(pareto(&case, &[], &options, &Stop).unwrap_err().code(), Code::CANCELLED);
    for bad in [
        PassOptions { margin: 40.0, ..options.clone() },
        PassOptions { margin: f64::NAN, ..options.clone() },
        PassOptions { feed: 0.0, ..options.clone() },
        PassOptions { rapid: f64::INFINITY, ..options.clone() },
        PassOptions { lift: -1.0, ..options.clone() },
        PassOptions { angles: vec![f64::NAN], ..options.clone() },
    ] {
        assert_eq!(pareto(&case, &[], &bad, &Silent).unwrap_err().code(), Code::FACE_CASE);
    }
}

#[test]
fn paths_that_make_no_sense_do_no_harm() {
    let case = plate_200_by_120();
    let perimeter = case.outline.perimeter();
    assert!((path_burr(&case, &PassPath::default()).uncut - perimeter).abs() < 1e-9);
    assert!(uncovered(&case, &PassPath::default(), 1.0, 6).is_some());
    let dot = PassPath::lines(&[vec![dvec2(0.0, 0.0), dvec2(0.0, 0.0)]]);
    let burr = path_burr(&case, &dot);
    assert!((burr.lowered - 80.0).abs() < 1e-9 && (burr.uncut - perimeter + 80.0).abs() < 1e-9);
    let nan = PassPath::lines(&[vec![dvec2(f64::NAN, 0.0), dvec2(0.0, 0.0)]]);
    assert!((path_burr(&case, &nan).uncut - perimeter).abs() < 1e-9);
    assert!(best_rows(&case, 0.0, 1, 0.8, RowWays::Free).is_none());
    assert!(best_rows(&case, 0.0, 0, 0.8, RowWays::Free).is_none());
    assert!(best_rows(&case, 0.0, 3, 40.0, RowWays::Free).is_none());
    assert_eq!(MilledRows::least(&case, 0.0, 0.8), Some(2));
    assert_eq!(MilledRows::least(&case, 0.0, 41.0), None);
}
