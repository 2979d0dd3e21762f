//! The certified bounds of the least burr against random placements: outlines of lines and arcs with holes, weights,
//! several bad intervals, guards, boxes of all sizes.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

use std::f64::consts::{PI, TAU};

use glam::{DVec2, dvec2};
use kinecut::base::{Code, Progress, Silent};
use kinecut::facing::optimum::{Options, box_bound, least_burr, objective_map};
use kinecut::facing::{BadPart, BadSet, FaceCase, Placement, bad_length};
use kinecut::geom::{Outline, OutlineEdge};
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// A star-shaped loop about the origin whose sides are straight or bulge in or out, away from the origin by `shift`.
fn star(radii: &[(f64, f64)], size: f64, arcs: bool, shift: DVec2) -> Vec<OutlineEdge> {
    let n = radii.len();
    let point = |k: usize| {
        let at = TAU * (k % n) as f64 / n as f64;
        shift + size * radii[k % n].0 * DVec2::from_angle(at)
    };
    (0..n).map(|k| OutlineEdge::bulge(point(k), point(k + 1), if arcs { radii[k].1 } else { 0.0 })).collect()
}

fn bad_set(kind: u8, guard: f64) -> BadSet {
    let part = |from: f64, to: f64, weight| BadPart { from: from.to_radians(), to: to.to_radians(), weight };
    let set = match kind {
        0 => BadSet::below(0.5 * PI).unwrap(),
        1 => BadSet::below(60f64.to_radians()).unwrap().supplement(),
        2 => BadSet::new(vec![part(0.0, 30.0, 2.0), part(30.0, 75.0, 0.5), part(120.0, 150.0, 1.5)]).unwrap(),
        _ => BadSet::new(vec![part(0.0, 180.0, 1.0)]).unwrap(),
    };
    set.guarded(guard)
}

prop_compose! {
    fn cases()(
        radii in prop::collection::vec((0.6..1.0f64, -0.3..0.3f64), 3..9),
        hole in prop::collection::vec((0.15..0.3f64, -0.3..0.3f64), 3..5),
        bore in 0.05..0.12f64,
        arcs in prop::bool::weighted(0.75),
        kind in 0u8..4,
        guarded in prop::bool::ANY,
        weights in prop::collection::vec(0.0..3.0f64, 20),
        away in (-200.0..200.0f64, -200.0..200.0f64),
    ) -> FaceCase {
        let shift = dvec2(away.0, away.1);
        let loops = vec![
            star(&radii, 30.0, arcs, shift),
            star(&hole, 30.0, arcs, shift),
            if arcs { vec![OutlineEdge::arc(shift + dvec2(13.0, 3.0), 30.0 * bore, 0.3, TAU)] } else { vec![] },
        ];
        let outline = Outline::new(loops, vec![]).unwrap();
        let weights = weights[..outline.edges().len()].to_vec();
        FaceCase::new(outline, 50.0, bad_set(kind, if guarded { 0.04 } else { 0.0 })).unwrap()
            .with_weights(weights).unwrap()
    }
}

/// A placement within the allowed ones near to the middle of a box.
fn within(case: &FaceCase, middle: Placement, spread: [f64; 2], at: [f64; 2], margin: f64) -> Option<Placement> {
    let [low, high] = case.outline.bounds();
    let about = 0.5 * (low + high);
    let height = |angle: f64| angle.sin() * about.x + angle.cos() * about.y;
    let local = middle.offset - height(middle.angle) + at[1] * spread[1];
    let angle = middle.angle + at[0] * spread[0];
    let offset = local + height(angle);
    let [least, most] = case.offsets(angle, margin);
    (least <= offset && offset <= most).then_some(Placement { angle, offset })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn no_placement_of_a_box_is_below_its_bound(
        case in cases(),
        angle in 0.0..TAU, share in 0.0..1.0f64, fine in prop::array::uniform2(0.0..7.0f64),
        parallel in prop::option::of(0usize..20),
        points in prop::collection::vec(prop::array::uniform2(-0.5..0.5f64), 24),
    ) {
        let options = Options { margin: 1.0, ..Options::for_cutter(50.0) };
        // Some boxes hold an angle at which an edge is parallel to the feed.
        let edge = parallel.map(|k| case.outline.edges()[k % case.outline.edges().len()]);
        let angle = edge.map_or(angle, |e| angle * 1e-3 - e.heading(0.0));
        let [least, most] = case.offsets(angle, 1.0);
        prop_assume!(least < most);
        let middle = Placement { angle, offset: least + share * (most - least) };
        let spread = [10f64.powf(-fine[0]), 10.0 * 10f64.powf(-fine[1])];
        let bound = box_bound(&case, &options, middle, spread).unwrap();
        let slack = 1e-9 * case.weighted_perimeter();
        let parallel = edge.map(|e| [(-e.heading(0.0) - angle) / spread[0], 0.1]);
        for at in points.into_iter().chain([[0.0, 0.0], [0.5, 0.5], [-0.5, 0.5], [0.5, -0.5], [-0.5, -0.5]])
            .chain(parallel.filter(|p| p[0].abs() < 0.5))
        {
            if let Some(place) = within(&case, middle, spread, at, 1.0) {
                let value = bad_length(&case, place);
                prop_assert!(bound <= value + slack, "{bound} {value} {place:?} {middle:?} {spread:?}");
            }
        }
    }

    /// Halving a box brings the bound to the value; where the value is smooth, quadratically.
    #[test]
    fn bounds_of_small_boxes_are_near_the_value(case in cases(), angle in 0.0..TAU, share in 0.1..0.9f64) {
        let options = Options { margin: 1.0, ..Options::for_cutter(50.0) };
        let [least, most] = case.offsets(angle, 1.0);
        prop_assume!(least < most);
        let middle = Placement { angle, offset: least + share * (most - least) };
        let value = bad_length(&case, middle);
        let bound = box_bound(&case, &options, middle, [1e-9, 1e-8]).unwrap();
        prop_assert!(bound <= value + 1e-9 * case.weighted_perimeter());
        prop_assert!(value - bound <= 1e-4 * (1.0 + case.weighted_perimeter()), "{bound} {value}");
    }
}
