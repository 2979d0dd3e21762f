use std::f64::consts::PI;

use glam::dvec2;

use super::*;

/// Largest distance of dense points of a curve from the nearest dense point of the edges.
fn off(edges: &[OutlineEdge], curve: impl Fn(f64) -> DVec2) -> f64 {
    let dense: Vec<DVec2> =
        edges.iter().flat_map(|e| (0..=400).map(|i| e.at(f64::from(i) / 400.0))).collect();
    let nearest = |p: DVec2| dense.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
    (0..=200).map(|i| nearest(curve(f64::from(i) / 200.0))).fold(0.0, f64::max)
}

fn gap(edges: &[OutlineEdge]) -> f64 {
    edges.windows(2).map(|w| w[0].end.distance(w[1].start)).fold(0.0, f64::max)
}

#[test]
fn ellipses_stand_as_few_arcs_and_circles_as_one() {
    let ellipse = EllipticArc {
        centre: dvec2(3.0, 4.0),
        major: dvec2(16.0, 12.0),
        minor: dvec2(-6.0, 8.0),
        from: 0.3,
        sweep: TAU,
    };
    let edges = ellipse.edges(0.005).unwrap();
    assert!(edges.len() < 60, "{}", edges.len());
    assert!(off(&edges, |t| ellipse.point(0.3 + TAU * t)) < 0.005 + 0.02);
    assert_eq!(gap(&edges), 0.0);
    assert_eq!(edges[0].start, edges[edges.len() - 1].end);
    let round = EllipticArc { minor: dvec2(12.0, -16.0), sweep: 1.0, ..ellipse };
    let edges = round.edges(0.005).unwrap();
    assert_eq!(edges.len(), 1);
    assert!(off(&edges, |t| round.point(0.3 + t)) < 0.06);
    assert!(edges[0].end.distance(round.point(1.3)) < 1e-12);
}

#[test]
fn a_rational_quadratic_is_a_circle() {
    // Nine points of the textbook: a full circle of radius 10.
    let r = 10.0;
    let points: Vec<DVec2> =
        [(r, 0.0), (r, r), (0.0, r), (-r, r), (-r, 0.0), (-r, -r), (0.0, -r), (r, -r), (r, 0.0)]
            .map(Into::into)
            .to_vec();
    let h = 0.5f64.sqrt();
    let weights = [1.0, h, 1.0, h, 1.0, h, 1.0, h, 1.0];
    let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
    let edges = Spline::new(2, knots, &points, &weights).unwrap().edges(0.001).unwrap();
    for e in &edges {
        for s in [0.0, 0.3, 0.8] {
            assert!((e.at(s).length() - r).abs() < 0.001);
        }
    }
    let length: f64 = edges.iter().map(OutlineEdge::length).sum();
    assert!((length - TAU * r).abs() < 1e-3);
    assert!(gap(&edges) < 1e-12);
}

#[test]
fn cubic_splines_and_bezier_curves_agree_and_corners_stay() {
    let points = [dvec2(0.0, 0.0), dvec2(3.0, 8.0), dvec2(9.0, -4.0), dvec2(12.0, 2.0)];
    let bezier = |t: f64| {
        let u = 1.0 - t;
        points[0] * (u * u * u)
            + points[1] * (3.0 * u * u * t)
            + points[2] * (3.0 * u * t * t)
            + points[3] * (t * t * t)
    };
    let knots = vec![5.0, 5.0, 5.0, 5.0, 9.0, 9.0, 9.0, 9.0];
    let spline = Spline::new(3, knots, &points, &[]).unwrap().edges(0.005).unwrap();
    let cubic = cubic_edges(points, 0.005).unwrap();
    for edges in [&spline, &cubic] {
        assert!(off(edges, bezier) < 0.005 + 0.01);
        assert!(edges[0].start == points[0] && edges[edges.len() - 1].end.distance(points[3]) < 1e-12);
    }
    let corner = [dvec2(0.0, 0.0), dvec2(5.0, 0.0), dvec2(5.0, 5.0)];
    let line = Spline::new(1, vec![0.0, 0.0, 1.0, 2.0, 2.0], &corner, &[]).unwrap().edges(0.005).unwrap();
    assert_eq!(line.len(), 2);
    assert!((line[1].heading(0.5) - 0.5 * PI).abs() < 1e-12);
}

#[test]
fn splines_that_contradict_themselves_are_refused() {
    let points = [DVec2::ZERO, DVec2::X, DVec2::Y];
    assert!(Spline::new(3, vec![0.0; 7], &points, &[]).is_err());
    assert!(Spline::new(2, vec![0.0; 5], &points, &[]).is_err());
    assert!(Spline::new(2, vec![0.0, 0.0, 1.0, 0.5, 1.0, 1.0], &points, &[]).is_err());
    assert!(Spline::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], &points, &[1.0, -1.0, 1.0]).is_err());
    assert!(Spline::new(0, vec![0.0; 4], &points, &[]).is_err());
}

/// Cubic Bezier curves with a cusp within, at an end, at both, and stretches that are a point.
#[test]
fn splines_are_parted_at_cusps() {
    let bezier = |p: [DVec2; 4], t: f64| {
        let u = 1.0 - t;
        p[0] * (u * u * u) + p[1] * (3.0 * u * u * t) + p[2] * (3.0 * u * t * t) + p[3] * (t * t * t)
    };
    // The velocity of the first vanishes in its middle.
    let within = [dvec2(0.0, 0.0), dvec2(10.0, 10.0), dvec2(0.0, 10.0), dvec2(10.0, 0.0)];
    let nearly = [dvec2(0.0, 0.0), dvec2(10.0, 10.0), dvec2(1e-6, 10.0), dvec2(10.0, 0.0)];
    let start = [dvec2(0.0, 0.0), dvec2(0.0, 0.0), dvec2(8.0, 1.0), dvec2(10.0, 6.0)];
    let both = [dvec2(0.0, 0.0), dvec2(0.0, 0.0), dvec2(10.0, 6.0), dvec2(10.0, 6.0)];
    for points in [within, nearly, start, both] {
        for shift in [dvec2(0.0, 0.0), dvec2(-300.0, 170.0)] {
            let points = points.map(|p| p + shift);
            let knots = [[0.0; 4], [1.0; 4]].concat();
            let spline = Spline::new(3, knots, &points, &[]).unwrap().edges(0.005).unwrap();
            for edges in [&spline, &cubic_edges(points, 0.005).unwrap()] {
                assert!(off(edges, |t| bezier(points, t)) < 0.005 + 0.02, "{points:?}");
                assert!(edges.len() < 120 && gap(edges) < 1e-9, "{}", edges.len());
                assert!(edges[0].start.distance(points[0]) < 1e-9);
                assert!(edges[edges.len() - 1].end.distance(points[3]) < 1e-9);
            }
        }
    }
    let corner = cubic_edges(within, 0.005).unwrap();
    let turns =
        corner.windows(2).map(|w| crate::num::angle::wrap(w[1].heading(0.0) - w[0].heading(1.0)).abs());
    assert!(turns.filter(|t| *t > 3.0).count() == 1);
    // The last stretch stays where it is.
    let points = [dvec2(0.0, 0.0), dvec2(5.0, 5.0), dvec2(9.0, 1.0), dvec2(9.0, 1.0), dvec2(9.0, 1.0)];
    let knots = vec![0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0];
    let edges = Spline::new(2, knots, &points, &[]).unwrap().edges(0.005).unwrap();
    assert!(edges[edges.len() - 1].end.distance(points[4]) < 1e-12);
    let knots = vec![0.0; 3].into_iter().chain(vec![1.0; 3]).collect();
    assert!(Spline::new(2, knots, &[points[4]; 3], &[]).unwrap().edges(0.005).unwrap().is_empty());
}
