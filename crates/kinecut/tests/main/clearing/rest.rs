//! Pockets of which a larger cutter has cleared most: what that one has left, judged by its own points.

use std::collections::HashMap;
use std::f64::consts::TAU;

use glam::{DVec2, dvec2};
use kinecut::base::Code;
use kinecut::clearing::{EarlierCutter, PocketPlan, PocketSpec, plan_pocket};
use kinecut::contouring::{ContourSide, ContourSpec, plan_contour};
use kinecut::geom::{NearestEdge, Outline};
use kinecut::holes::PlannedMove;

use super::{Swept, ell, judge_in, polygon, rectangle, spec, with_circle};

/// A place of the floor of the first level on every 0.02 mm of moves.
fn sweep(swept: &mut Swept, moves: &[PlannedMove], floor: f64) {
    for planned in moves.iter().filter(|m| m.level == 0) {
        let length = planned.curve.length();
        let count = (length / 0.02).ceil().max(1.0) as usize;
        for k in 0..=count {
            let p = planned.curve.at(length * k as f64 / count as f64).p;
            if p.z < floor + 1e-6 {
                swept.add(p.truncate());
            }
        }
    }
}

/// All that a cutter sweeps by its passes and its lap along the wall.
fn by_cutter(spec: &PocketSpec, plan: Option<&PocketPlan>) -> Swept {
    let mut swept = Swept { radius: spec.radius(), cells: HashMap::new() };
    let Some(plan) = plan else { return swept };
    sweep(&mut swept, &plan.moves, plan.levels[0]);
    let lap = ContourSpec {
        side: ContourSide::Inside,
        cleared: true,
        stock_to_leave: spec.allowance,
        retract_z: spec.retract_z,
        approach_z: spec.approach_z,
        ..ContourSpec::new(spec.outline.clone(), spec.depth, spec.cutter, spec.feed)
    };
    let lap = plan_contour(&lap).expect("a lap along the wall");
    sweep(&mut swept, &lap.moves, plan.levels[0]);
    swept
}

/// Places of a lattice that a cutter surely reaches, the wall's stock less.
fn reached(outline: &Outline, radius: f64, inset: f64) -> Vec<DVec2> {
    let near = NearestEdge::new(outline.edges());
    let room = |p: DVec2| -near.at(p, f64::INFINITY).expect("an edge").distance;
    let [low, high] = outline.bounds();
    let lattice = |step: f64| {
        let count = |x: f64| (x / step).ceil() as usize;
        let (nx, ny) = (count(high.x - low.x), count(high.y - low.y));
        (0..nx).flat_map(move |i| (0..ny).map(move |j| low + step * dvec2(i as f64 + 0.37, j as f64 + 0.41)))
    };
    let mut centres = Swept { radius: radius - 0.15, cells: HashMap::new() };
    lattice(0.2).filter(|p| room(*p) >= radius + inset).for_each(|p| centres.add(p));
    lattice(0.25).filter(|p| room(*p) > 0.0 && centres.holds(*p)).collect()
}

fn rest_of(of: &PocketSpec, diameter: f64) -> (PocketSpec, PocketSpec) {
    let first = PocketSpec { cutter: kinecut::holes::CutterData { diameter, ..of.cutter }, ..of.clone() };
    let earlier = EarlierCutter { radius: 0.5 * diameter, corner: 0.0, allowance: of.allowance };
    (first, PocketSpec { rest: Some(earlier), ..of.clone() })
}

#[test]
fn all_that_the_larger_cutter_has_left_is_cleared_within_the_engagement() {
    let island = with_circle(&rectangle(90.0, 60.0), dvec2(20.0, 30.0), 9.0);
    let legs = polygon(&[[0.0, 0.0], [60.0, 0.0], [60.0, 9.0], [30.0, 9.0], [30.0, 40.0], [0.0, 40.0]]);
    let cases = [
        ("rectangle", rectangle(60.0, 40.0), 16.0, 6.0, 60.0, 4),
        ("turned", rectangle(60.0, 40.0).moved(0.3, DVec2::ZERO), 16.0, 5.0, 45.0, 4),
        ("L", ell(), 20.0, 8.0, 60.0, 5),
        ("narrow beside an island", island, 16.0, 6.0, 60.0, 0),
        ("a leg without the larger cutter", legs, 12.0, 4.0, 60.0, 0),
        (
            "star",
            polygon(&[[0.0, 0.0], [50.0, 5.0], [70.0, 50.0], [20.0, 60.0], [-10.0, 30.0]]),
            20.0,
            6.0,
            30.0,
            5,
        ),
    ];
    for (name, outline, larger, smaller, degrees, places) in cases {
        let (first, second) = rest_of(&spec(outline.clone(), smaller, degrees), larger);
        let before = plan_pocket(&first).expect(name);
        let cleared = by_cutter(&first, Some(&before));
        let plan = plan_pocket(&second).expect(name);
        let f = plan.figures;
        let rest = f.rest.expect("figures of the rest");
        assert!(places == 0 || rest.places == places, "{name}: {rest:?}");
        assert_eq!((f.entries, rest.to_lap), (0, 0), "{name}: {f:?}");
        let found = judge_in(&second, &plan, 23, |p| !cleared.holds(p));
        assert!(found.pass < degrees + 1.0 && found.pass > 15.0, "{name}: {found:?}");
        assert!(found.link < 16.0, "{name}: {found:?}");
        let mut own = Swept { radius: second.radius(), cells: HashMap::new() };
        sweep(&mut own, &plan.moves, plan.levels[0]);
        let all = reached(&outline, second.radius(), 0.02);
        let left = all.iter().filter(|p| !cleared.holds(**p) && !own.holds(**p)).count();
        assert!(all.len() > 1000 && left == 0, "{name}: {left} of {}", all.len());
        let only_corners = all.iter().filter(|p| !cleared.holds(**p)).count();
        assert!(only_corners > 10, "{name}: {only_corners}");
        // Shorter by far than all of it with the smaller cutter.
        let whole = plan_pocket(&PocketSpec { rest: None, ..second.clone() }).expect(name).figures.cutting;
        assert!(f.cutting > 10.0 && f.cutting < 0.6 * whole, "{name}: {} of {whole}", f.cutting);
    }
}

#[test]
fn a_corner_of_the_larger_cutter_leaves_a_band_at_the_floor() {
    let (_, plain) = rest_of(&spec(rectangle(60.0, 40.0), 6.0, 60.0), 16.0);
    let round = EarlierCutter { corner: 1.0, ..plain.rest.expect("a cutter") };
    let band = PocketSpec { rest: Some(round), ..plain.clone() };
    let [plain, band] = [&plain, &band].map(|s| plan_pocket(s).expect("a plan"));
    assert_eq!(
        (plain.figures.rest.map(|r| r.places), band.figures.rest.map(|r| r.places)),
        (Some(4), Some(1))
    );
    // Along all of the wall.
    assert!(band.figures.cutting > 150.0 && plain.figures.cutting < 150.0);
}

#[test]
fn closed_places_get_a_way_down_and_nothing_is_a_note() {
    // A chamber behind a neck into which the larger cutter does not go, nor the smaller one past the neck.
    let bone = polygon(&[
        [0.0, 0.0],
        [40.0, 0.0],
        [40.0, 13.5],
        [50.0, 13.5],
        [50.0, 12.0],
        [80.0, 12.0],
        [80.0, 25.0],
        [50.0, 25.0],
        [50.0, 18.0],
        [40.0, 18.0],
        [40.0, 30.0],
        [0.0, 30.0],
    ]);
    let (_, second) = rest_of(&spec(bone, 6.0, 60.0), 16.0);
    let plan = plan_pocket(&second).expect("a plan");
    assert_eq!(plan.figures.entries, 1, "{:?}", plan.figures);
    let found = judge_in(&second, &plan, 23, |p| {
        p.x > 45.0 || {
            // The larger chamber is free but for its corners.
            let near = |c: f64, low: f64, high: f64| c.clamp(low + 8.0, high - 8.0);
            p.distance(dvec2(near(p.x, 0.0, 40.0), near(p.y, 0.0, 30.0))) > 8.0
        }
    });
    assert!(found.pass < 61.0, "{found:?}");
    let disc = kinecut::geom::Outline::new(
        vec![vec![kinecut::geom::OutlineEdge::arc(DVec2::ZERO, 25.0, 0.0, TAU)]],
        Vec::new(),
    )
    .expect("a disc");
    let (_, second) = rest_of(&spec(disc, 6.0, 60.0), 16.0);
    let plan = plan_pocket(&second).expect("a plan");
    assert!(plan.moves.is_empty() && plan.findings.iter().any(|f| f.code == Code::POCKET_REST));
    // A little more on the wall: the lap takes it with 8.6 degrees of the circle.
    let little = EarlierCutter { allowance: 0.05, ..second.rest.expect("a cutter") };
    let plan = plan_pocket(&PocketSpec { rest: Some(little), ..second.clone() }).expect("a plan");
    let rest = plan.figures.rest.expect("figures");
    assert!(rest.places == 0 && rest.to_lap == 1 && plan.moves.is_empty(), "{rest:?}");
    // More of it, where no pass finds a beginning, is a warning with its area: 2 pi 25 times 0.1 mm, the wall's stock less.
    let more = EarlierCutter { allowance: 0.12, ..little };
    let plan = plan_pocket(&PocketSpec { rest: Some(more), ..second }).expect("a plan");
    let warned =
        plan.findings.iter().any(|f| f.code == Code::POCKET_LEFT && f.message.contains("left to the lap"));
    assert!(plan.figures.passes > 0 || warned && plan.figures.left > 10.0, "{:?}", plan.findings);
}
