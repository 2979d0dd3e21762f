//! Feeds in inside corners: the largest chip by brute force, from the stock that dense discs of the roughing have left.

use std::f64::consts::{FRAC_PI_2, PI};

use kinecut::contouring::SlowedFeed;

use super::*;

/// Largest chip of a cutter at a place, in feeds per tooth: by dense points of its front half; none where nothing is cut.
fn thickest(rough: &[DVec2], before: &[DVec2], a: f64, (p, along): (DVec2, DVec2)) -> f64 {
    const POINTS: u32 = 361;
    let heading = along.to_angle();
    let near: Vec<DVec2> = rough.iter().chain(before).copied().filter(|c| c.distance(p) < 2.0 * a).collect();
    let mut most = 0.0_f64;
    for i in 0..=POINTS {
        let off = -FRAC_PI_2 + PI * f64::from(i) / f64::from(POINTS);
        let q = p + a * DVec2::from_angle(heading + off);
        if !near.iter().any(|c| c.distance(q) < a - 2e-4) {
            most = most.max(off.cos());
        }
    }
    most
}

/// Points along moves at a height, with the heading and the feed, closer than a length.
fn dense(moves: &[PlannedMove], every: f64, keep: impl Fn(&PlannedMove) -> bool) -> Vec<(DVec2, DVec2, f64)> {
    let mut all = Vec::new();
    for m in moves.iter().filter(|m| keep(m)) {
        let ToolpathPace::Feed(feed) = m.pace else { continue };
        let count = (m.curve.length() / every).ceil().max(1.0);
        for i in 0..=count as u32 {
            let s = f64::from(i) / count * m.curve.length();
            let at = |s: f64| m.curve.at(s.clamp(0.0, m.curve.length())).p.truncate();
            let along = at(s + 1e-6) - at(s - 1e-6);
            if along.length() > 0.0 {
                all.push((at(s), along / along.length(), feed));
            }
        }
    }
    all
}

/// The largest chip of each place of the finish times its feed, over that of a straight wall; with the least share of the feed.
fn chips(spec: &ContourSpec, plan: &ContourPlan) -> Vec<(f64, f64)> {
    let (finish, a) = (spec.finish.unwrap(), spec.radius());
    let floor = spec.bottom();
    let low = |m: &PlannedMove| [m.curve.start().z, m.curve.end().z].iter().all(|z| (z - floor).abs() < 1e-9);
    let rough: Vec<DVec2> =
        dense(&plan.moves, 0.02, |m| !m.finishing && low(m)).iter().map(|d| d.0).collect();
    let lap = dense(&plan.moves, 0.06, |m| m.role == ToolpathRole::Finish && low(m));
    let straight = (1.0 - (1.0 - finish.allowance / a).powi(2)).sqrt();
    let mut found = Vec::new();
    let mut gone: Vec<DVec2> = Vec::new();
    for (p, along, feed) in &lap {
        let chip = thickest(&rough, &gone, a, (*p, *along));
        found.push((chip * feed / (straight * finish.feed), feed / finish.feed));
        gone.push(*p);
    }
    found
}

fn of(outline: Outline, side: ContourSide, allowance: f64) -> ContourSpec {
    let finish = ContourFinish {
        allowance,
        feed: 15.0,
        stepdown: None,
        spring_passes: 0,
        wear: None,
        corner_feed: true,
    };
    ContourSpec { side, finish: Some(finish), stepdown: None, ..ContourSpec::new(outline, 4.0, CUTTER, 15.0) }
}

#[test]
fn the_chip_in_corners_is_no_thicker_than_along_a_straight_wall() {
    let triangle = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(24.0, 0.0), dvec2(7.0, 19.0)]).unwrap();
    let round = OutlineEdge::arc(DVec2::ZERO, 6.0, 0.0, TAU);
    let ring = Outline::new(vec![vec![round]], vec![]).unwrap();
    let cross = [
        dvec2(0.0, 0.0),
        dvec2(10.0, 0.0),
        dvec2(10.0, -9.0),
        dvec2(19.0, -9.0),
        dvec2(19.0, 14.0),
        dvec2(0.0, 14.0),
    ];
    let cases = [
        (rectangle(20.0, 14.0), ContourSide::Inside, 0.3, Some(0.8_f64.powi(4))),
        (rectangle(20.0, 14.0), ContourSide::Inside, 0.1, Some(0.3)),
        (rectangle(20.0, 14.0), ContourSide::Inside, 1.2, None),
        (triangle.clone(), ContourSide::Inside, 0.4, None),
        // Outside corners alone: nothing is slower.
        (triangle, ContourSide::Outside, 0.4, Some(1.0)),
        (ring, ContourSide::Inside, 0.4, None),
        (Outline::polygon(&cross).unwrap(), ContourSide::Outside, 0.5, None),
    ];
    for (outline, side, allowance, least) in cases {
        for sense in [Sense::Climb, Sense::Conventional] {
            let spec = ContourSpec { sense, ..of(outline.clone(), side, allowance) };
            let plan = plan_contour(&spec).unwrap();
            sound(&spec, &plan);
            let SlowedFeed { length, least: told, thickest } = plan.slowed.unwrap();
            let chips = chips(&spec, &plan);
            let slowest = chips.iter().map(|c| c.1).fold(1.0, f64::min);
            assert!(
                (told - slowest).abs() < 1e-9 && (length > 0.0) == (told < 1.0),
                "{side:?} {told} {slowest}"
            );
            if let Some(least) = least {
                assert!((told - least).abs() < 1e-9, "{side:?} {told}");
            }
            let worst = chips.iter().map(|c| c.0).fold(0.0, f64::max);
            // Rounding of the dense discs: 0.2 um of 0.3 mm, and half a point of the circle.
            assert!((worst - thickest).abs() < 0.02, "{side:?} {allowance}: {worst}, told {thickest}");
            for (chip, share) in chips {
                assert!(chip < 1.03 || (share - 0.3).abs() < 1e-9, "{side:?} {allowance}: {chip} at {share}");
            }
        }
    }
}

#[test]
fn along_a_whole_circle_the_feed_is_that_of_its_engagement() {
    // cos E = ((rc + a - h)^2 - rc^2 - a^2) / (2 rc a) for a wall of 6 mm.
    let (a, h, rc) = (3.0_f64, 0.4, 3.0);
    let cos = ((rc + a - h).powi(2) - rc * rc - a * a) / (2.0 * rc * a);
    let wanted = (1.0 - (1.0 - h / a).powi(2)).sqrt() / (1.0 - cos * cos).sqrt();
    let round = OutlineEdge::arc(DVec2::ZERO, 6.0, 0.0, TAU);
    let spec = of(Outline::new(vec![vec![round]], vec![]).unwrap(), ContourSide::Inside, h);
    let plan = plan_contour(&spec).unwrap();
    let slowed = plan.slowed.unwrap();
    assert!(slowed.least <= wanted * 1.01 && slowed.least > 0.79 * wanted, "{} {wanted}", slowed.least);
    assert!((slowed.length - TAU * rc).abs() < 1e-6, "{}", slowed.length);
}

#[test]
fn laps_without_stock_and_wide_strips_are_as_fast_as_given() {
    let spec = of(rectangle(20.0, 14.0), ContourSide::Inside, 0.3);
    let lap = |spring_passes: u32| {
        let finish = ContourFinish { spring_passes, ..spec.finish.unwrap() };
        let plan = plan_contour(&ContourSpec { finish: Some(finish), ..spec.clone() }).unwrap();
        let slow = plan.moves.iter().filter(|m| m.role == ToolpathRole::Finish);
        let slow = slow.filter(|m| matches!(m.pace, ToolpathPace::Feed(f) if f < 15.0 - 1e-9));
        slow.map(|m| m.curve.length()).sum::<f64>()
    };
    assert!(lap(0) > 0.3 && (lap(0) - lap(2)).abs() < 1e-6, "{} {}", lap(0), lap(2));
    // A strip of more than the radius has the thickest chip along the straight wall already.
    let wide = of(rectangle(40.0, 30.0), ContourSide::Inside, 3.5);
    let slowed = plan_contour(&wide).unwrap().slowed.unwrap();
    assert_eq!((slowed.length, slowed.least, slowed.thickest), (0.0, 1.0, 1.0));
    let plain = ContourFinish { corner_feed: false, ..spec.finish.unwrap() };
    assert_eq!(plan_contour(&ContourSpec { finish: Some(plain), ..spec }).unwrap().slowed, None);
}
