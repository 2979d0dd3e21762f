use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::dvec2;
use proptest::prelude::*;

use super::*;
use crate::base::Code;
use crate::geom::Outline;

fn refused(loops: Vec<Vec<OutlineEdge>>) -> DVec2 {
    let error = Outline::new(loops, vec![]).unwrap_err();
    assert_eq!(error.code(), Code::OUTLINE_CROSSES, "{error}");
    let [x, y, _] = error.0.point.unwrap();
    dvec2(x, y)
}

fn polygon(points: &[[f64; 2]]) -> Vec<OutlineEdge> {
    let p = |i: usize| DVec2::from(points[i % points.len()]);
    (0..points.len()).map(|i| OutlineEdge::line(p(i), p(i + 1))).collect()
}

#[test]
fn crossing_lines_touching_vertices_and_overlaps_are_refused_with_the_point() {
    let bow = polygon(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [4.0, 4.0]]);
    assert!(refused(vec![bow]).distance(dvec2(2.0, 2.0)) < 1e-12);
    // A vertex on an edge, and two vertices in one point.
    let on_edge = polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]]);
    assert!(refused(vec![on_edge]).distance(dvec2(2.0, 0.0)) < 1e-12);
    let pinched = polygon(&[[0.0, 0.0], [2.0, 1.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0], [0.0, 4.0]]);
    assert!(refused(vec![pinched]).distance(dvec2(2.0, 1.0)) < 1e-12);
    // Doubling back, exactly and nearly.
    refused(vec![polygon(&[[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [2.0, 3.0]])]);
    refused(vec![polygon(&[[0.0, 0.0], [4.0, 0.0], [1.0, 1e-10], [1.0, 3.0]])]);
    // The same loop twice, and loops with a common side.
    let square = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    refused(vec![square.clone(), square.clone()]);
    let beside = polygon(&[[1.0, 0.2], [2.0, 0.2], [2.0, 0.8], [1.0, 0.8]]);
    refused(vec![square, beside]);
}

#[test]
fn arcs_that_cross_touch_or_overlap_are_refused() {
    let circle = |x: f64, r: f64| vec![OutlineEdge::arc(dvec2(x, 0.0), r, 0.3, TAU)];
    let at = refused(vec![circle(0.0, 5.0), circle(6.0, 5.0)]);
    assert!((at.x - 3.0).abs() < 1e-12 && (at.y.abs() - 4.0).abs() < 1e-12);
    assert!(refused(vec![circle(0.0, 5.0), circle(8.0, 3.0)]).distance(dvec2(5.0, 0.0)) < 1e-6);
    assert!(refused(vec![circle(0.0, 5.0), circle(2.0, 3.0)]).distance(dvec2(5.0, 0.0)) < 1e-6);
    refused(vec![circle(0.0, 5.0), circle(0.0, 5.0)]);
    assert!(Outline::new(vec![circle(0.0, 5.0), circle(1.9, 3.0), circle(9.0, 3.9)], vec![]).is_ok());
    // A square's side tangent to a circle, and through one.
    let side = |x: f64| polygon(&[[x, -9.0], [x, 9.0], [-9.0, 9.0], [-9.0, -9.0]]);
    assert!(refused(vec![side(5.0), circle(0.0, 5.0)]).distance(dvec2(5.0, 0.0)) < 1e-6);
    refused(vec![side(4.0), circle(0.0, 5.0)]);
    assert!(Outline::new(vec![side(5.0 + 1e-6), circle(0.0, 5.0)], vec![]).is_ok());
}

#[test]
fn neighbours_may_be_tangent_and_may_meet_in_a_cusp_but_not_again() {
    // A slot: lines tangent to half circles, turned so that nothing is exact.
    let slot = [
        OutlineEdge::line(dvec2(-5.0, -2.0), dvec2(5.0, -2.0)),
        OutlineEdge::arc(dvec2(5.0, 0.0), 2.0, -FRAC_PI_2, PI),
        OutlineEdge::line(dvec2(5.0, 2.0), dvec2(-5.0, 2.0)),
        OutlineEdge::arc(dvec2(-5.0, 0.0), 2.0, FRAC_PI_2, PI),
    ];
    for k in 0..50 {
        let turned = |e: &OutlineEdge| e.moved(0.1 * f64::from(k), dvec2(17.3, -4.0));
        assert!(Outline::new(vec![slot.iter().map(turned).collect()], vec![]).is_ok(), "{k}");
    }
    // The gap between two circles that touch, closed by a line: a cusp of two arcs.
    let cusp = [
        OutlineEdge::arc(dvec2(0.0, 5.0), 5.0, 0.0, -FRAC_PI_2),
        OutlineEdge::arc(dvec2(0.0, 2.0), 2.0, -FRAC_PI_2, FRAC_PI_2),
        OutlineEdge::line(dvec2(2.0, 2.0), dvec2(5.0, 5.0)),
    ];
    for k in 0..50 {
        let turned = |e: &OutlineEdge| e.moved(0.13 * f64::from(k), dvec2(170.3, -4.0));
        assert!(Outline::new(vec![cusp.iter().map(turned).collect()], vec![]).is_ok(), "{k}");
    }
    // A chord through its own arc: the line leaves the arc's end into the circle and leaves it again through the arc.
    let start = dvec2(3.0, 0.0);
    let arc = OutlineEdge::arc(DVec2::ZERO, 3.0, 0.0, 5.0);
    let out = dvec2(-1.0, 8.0);
    let through = vec![arc, OutlineEdge::line(arc.end, out), OutlineEdge::line(out, start)];
    assert!((refused(vec![through]).length() - 3.0).abs() < 1e-12);
}

#[test]
fn a_slanted_comb_of_long_teeth_is_simple() {
    // A comb of long teeth at an angle: every edge overlaps every other along X and along Y.
    let teeth = 400;
    let mut points = Vec::new();
    for i in 0..teeth {
        let x = f64::from(i);
        points.extend([dvec2(x, 0.0), dvec2(x, 500.0), dvec2(x + 0.5, 500.0), dvec2(x + 0.5, 0.0)]);
    }
    points.extend([dvec2(f64::from(teeth), -5.0), dvec2(0.0, -5.0)]);
    let turned: Vec<DVec2> = points.iter().map(|&p| DVec2::from_angle(0.8).rotate(p)).collect();
    assert!(Outline::polygon(&turned).is_ok());
}

/// Least distance between two edges of a loop of arcs and lines: by distances between dense points of both, without a
/// formula for crossings.
fn brute(edges: &[OutlineEdge]) -> f64 {
    const N: usize = 160;
    let dense: Vec<Vec<DVec2>> =
        edges.iter().map(|e| (0..=N).map(|i| e.at(i as f64 / N as f64)).collect()).collect();
    let mut least = f64::INFINITY;
    let n = edges.len();
    let segment = |p: DVec2, a: DVec2, b: DVec2| {
        let s = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        p.distance(a + s * (b - a))
    };
    for i in 0..n {
        for j in i + 1..n {
            for (k, &p) in dense[i].iter().enumerate() {
                for (l, w) in dense[j].windows(2).enumerate() {
                    // Points near the shared vertex are left out: a tenth of both edges.
                    let near = N / 10;
                    let joint = (j == i + 1 && k + near > N && l < near)
                        || ((i, j) == (0, n - 1) && k < near && l + near > N);
                    if !joint {
                        let d = segment(p, w[0], w[1]);
                        least = if d < least { d } else { least };
                    }
                }
            }
        }
    }
    least
}

proptest! {
    #![proptest_config(kinecut_cases::property(120))]

    /// Loops of mixed edges: where dense points come together a crossing is found, where they stay apart none.
    #[test]
    fn agrees_with_dense_points(
        corners in prop::collection::vec((0.0..10.0f64, 0.0..10.0f64, prop_oneof![Just(0.0), -1.5..1.5f64]), 3..6),
    ) {
        let n = corners.len();
        let p = |i: usize| dvec2(corners[i % n].0, corners[i % n].1);
        let edges: Vec<OutlineEdge> = (0..n).map(|i| OutlineEdge::bulge(p(i), p(i + 1), corners[i].2)).collect();
        prop_assume!(edges.iter().all(|e| e.length() > 0.1));
        let loops = [OutlineLoop { edges: 0..n, outer: true }];
        let found = first_crossing(&edges, &loops, false, 1e-8);
        let step = edges.iter().map(|e| e.length()).fold(0.0, f64::max) / 160.0;
        let apart = brute(&edges);
        match found {
            Some(c) => {
                // Near a vertex that both share, the dense points say nothing.
                let shared = |k: usize| [edges[k].start, edges[k].end].into_iter().any(|v| v.distance(c.point) < 0.2 * edges[k].length());
                if !c.edges.into_iter().any(shared) {
                    prop_assert!(apart <= step, "{c:?} {apart}");
                }
                for i in c.edges {
                    // The point lies on both edges.
                    let on = (0..=2000).map(|k| edges[i].at(f64::from(k) / 2000.0).distance(c.point)).fold(1e9, f64::min);
                    prop_assert!(on <= edges[i].length() / 2000.0, "{on}");
                }
            }
            None => prop_assert!(apart > 1e-5, "{apart}"),
        }
    }
}
