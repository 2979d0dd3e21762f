//! Random outlines with arcs and holes, random passes.

use std::f64::consts::TAU;
use std::ops::Range;

use glam::{DVec2, dvec2};
use kinecut::facing::{Placement, Tooth, ToothedPass};
use kinecut::geom::{Outline, OutlineEdge};
use proptest::prelude::*;

/// A star-shaped loop with bulged edges, and a bore in it or not.
pub(crate) fn outlines() -> impl Strategy<Value = Outline> {
    let corner = (14.0..40.0, prop_oneof![2 => Just(0.0), 1 => -0.08..0.35]);
    let middle = (-30.0..30.0, -30.0..30.0);
    (prop::collection::vec(corner, 4..9), middle, prop::option::of(0.5..5.0)).prop_map(
        |(corners, middle, bore)| {
            let middle = dvec2(middle.0, middle.1);
            let n = corners.len();
            let at = |i: usize| {
                let (radius, _) = corners[i % n];
                middle + radius * DVec2::from_angle(TAU * i as f64 / n as f64 + 0.2)
            };
            let outer = (0..n).map(|i| OutlineEdge::bulge(at(i), at(i + 1), corners[i].1)).collect();
            let mut loops = vec![outer];
            loops.extend(bore.map(|r| vec![OutlineEdge::arc(middle, r, 1.0, TAU)]));
            Outline::new(loops, vec![]).unwrap()
        },
    )
}

/// A pass of one to three uneven teeth, with the feed per radian and radius in a range.
pub(crate) fn passes(rho: Range<f64>) -> impl Strategy<Value = ToothedPass> {
    let teeth = prop::collection::vec((0.0..TAU, 0.99..1.0f64), 1..4);
    (teeth, 20.0..70.0, rho, 0.0..TAU, -50.0..50.0, -10.0..10.0).prop_map(
        |(teeth, radius, rho, angle, offset, along)| {
            ToothedPass {
                teeth: teeth
                    .into_iter()
                    .map(|(phase, part)| Tooth { phase, radius: radius * part })
                    .collect(),
                feed_per_radian: rho * radius,
                placement: Placement { angle, offset },
                along,
            }
            .checked()
            .unwrap()
        },
    )
}

/// An angle with a bore.
pub(crate) fn bracket_with_bore() -> Outline {
    let corners = [(0.0, 0.0), (60.0, 0.0), (60.0, 18.0), (20.0, 18.0), (20.0, 50.0), (0.0, 50.0)];
    let at = |i: usize| DVec2::from(corners[i % 6]);
    let outer = (0..6).map(|i| OutlineEdge::line(at(i), at(i + 1))).collect();
    Outline::new(vec![outer, vec![OutlineEdge::arc(dvec2(40.0, 9.0), 5.0, 0.4, TAU)]], vec![]).unwrap()
}

/// A plate with round ends, and a slot in it.
pub(crate) fn slot() -> Outline {
    let stadium = |half: f64, radius: f64| {
        let [a, b, c, d] =
            [(-half, -radius), (half, -radius), (half, radius), (-half, radius)].map(DVec2::from);
        vec![
            OutlineEdge::line(a, b),
            OutlineEdge::bulge(b, c, 1.0),
            OutlineEdge::line(c, d),
            OutlineEdge::bulge(d, a, 1.0),
        ]
    };
    Outline::new(vec![stadium(30.0, 20.0), stadium(15.0, 4.0)], vec![]).unwrap()
}
