use proptest::prelude::*;

use crate::geom::PlanarArc;

use super::*;

fn any_span() -> impl Strategy<Value = CubicSpan> {
    let place = || (-10.0..10.0f64, -10.0..10.0f64).prop_map(|(x, y)| DVec2::new(x, y));
    (place(), place(), place(), place())
        .prop_filter_map("no length", |(a, b, c, d)| CubicSpan::new([a, b, c, d]).ok())
}

/// The Bernstein form, term by term.
fn bernstein(p: [DVec2; 4], t: f64) -> DVec2 {
    let u = 1.0 - t;
    p[0] * u.powi(3) + p[1] * (3.0 * u * u * t) + p[2] * (3.0 * u * t * t) + p[3] * t.powi(3)
}

proptest! {
    #![proptest_config(kinecut_cases::property(48))]

    #[test]
    fn the_length_is_that_of_a_fine_polyline(span in any_span(), share in 0.01..0.99f64) {
        let n = 4000;
        let at = |i: i32| bernstein(span.points(), f64::from(i) / f64::from(n));
        let sum: f64 = (0..n).map(|i| (at(i + 1) - at(i)).length()).sum();
        prop_assert!((sum - span.length()).abs() < 2e-5 * span.length(), "{sum} {}", span.length());
        let t = span.parameter(share * span.length());
        prop_assert!((span.length_between(0.0, t) - share * span.length()).abs() < 1e-11 * span.length());
        prop_assert!((span.point(t) - bernstein(span.points(), t)).length() < 1e-13);
        let parts = [span.between(0.0, t), span.between(t, 1.0)];
        prop_assert!((parts[0].length() + parts[1].length() - span.length()).abs() < 1e-12 * span.length());
        prop_assert_eq!(parts[0].start(), span.start());
        prop_assert_eq!(parts[1].end(), span.end());
        prop_assert!((parts[1].point(0.3) - span.point(t + 0.3 * (1.0 - t))).length() < 1e-12);
        let back = span.reversed();
        prop_assert!((back.at(share * span.length()).p - span.at((1.0 - share) * span.length()).p).length() < 1e-8);
        let moved = span.shifted(DVec2::new(3.0, -4.0));
        prop_assert!((moved.at(1.0).p - span.at(1.0).p - DVec2::new(3.0, -4.0)).length() < 1e-12);
    }

    #[test]
    fn the_derivatives_are_those_of_the_points(span in any_span(), share in 0.1..0.9f64) {
        let s = share * span.length();
        let jet = span.at(s);
        // Near a cusp differences tell nothing.
        prop_assume!(jet.curvature.abs() < 5.0 && jet.curvature_slope.abs() < 50.0);
        let h = 1e-4;
        let p = |k: f64| span.at(s + k * h).p;
        let d1 = (p(1.0) - p(-1.0)) / (2.0 * h);
        prop_assert!((d1 - jet.d1).length() < 1e-5, "{d1} {}", jet.d1);
        let slope = (span.at(s + h).d1 - span.at(s - h).d1) / (2.0 * h);
        prop_assert!((slope - jet.d2).length() < 1e-3 * (1.0 + jet.curvature.abs()), "{slope} {}", jet.d2);
        prop_assert!((jet.d1.perp_dot(jet.d2) - jet.curvature).abs() < 1e-9 * (1.0 + jet.curvature.abs()));
        let change = (span.at(s + h).curvature - span.at(s - h).curvature) / (2.0 * h);
        prop_assert!((change - jet.curvature_slope).abs() < 0.05 * (1.0 + jet.curvature_slope.abs()));
    }

    #[test]
    fn the_polyline_keeps_its_chord(span in any_span(), chord in 1e-4..0.1f64) {
        let line = span.polyline(chord);
        let n = line.len() - 1;
        for i in 0..n {
            let [a, b] = [line[i], line[i + 1]];
            let p = bernstein(span.points(), (i as f64 + 0.5) / n as f64);
            let d = (b - a).normalize_or_zero();
            prop_assert!((p - a).perp_dot(d).abs() <= chord * 1.0001);
        }
        prop_assert_eq!([line[0], line[n]], [span.start(), span.end()]);
    }
}

#[test]
fn a_cusp_has_a_place_and_a_direction() {
    // Handles of no length, and a cusp within: P'(1/2) = 0.
    let zero = DVec2::ZERO;
    let span = CubicSpan::new([zero, zero, DVec2::new(1.0, 1.0), DVec2::new(2.0, 0.0)]).unwrap();
    let jet = span.at(0.0);
    assert!((jet.d1 - DVec2::splat(0.5f64.sqrt())).length() < 1e-12 && jet.p == zero);
    assert!(jet.curvature == f64::NEG_INFINITY);
    let cusp =
        CubicSpan::new([zero, DVec2::new(1.0, 1.0), DVec2::new(0.0, 1.0), DVec2::new(1.0, 0.0)]).unwrap();
    assert!(cusp.velocity(0.5).length() < 1e-15);
    let half = cusp.length_between(0.0, 0.5);
    assert!((2.0 * half - cusp.length()).abs() < 1e-12);
    assert!((cusp.at(half).p - cusp.point(0.5)).length() < 1e-9);
    // Points without length or with a value that is not a number are refused.
    assert!(CubicSpan::new([zero; 4]).is_err());
    assert!(CubicSpan::new([zero, DVec2::NAN, zero, DVec2::X]).is_err());
}

#[test]
fn a_straight_cubic_and_a_circle_are_what_they_are() {
    let line = CubicSpan::new([0.0, 1.0, 2.0, 3.0].map(|x| DVec2::X * x)).unwrap();
    assert!((line.length() - 3.0).abs() < 1e-14 && line.turn() == 0.0);
    assert!((line.at(1.7).p - DVec2::X * 1.7).length() < 1e-14);
    assert!(line.arcs(1e-4).unwrap().iter().all(PlanarArc::is_line));
    let at = |angle: f64| PlanarJet {
        p: DVec2::from_angle(angle) * 5.0,
        d1: DVec2::from_angle(angle).perp(),
        d2: DVec2::ZERO,
        d3: DVec2::ZERO,
        angle: 0.0,
        curvature: 0.2,
        curvature_slope: 0.0,
    };
    let span = CubicSpan::touching([at(0.3), at(0.9)], DVec2::ZERO).unwrap();
    assert!((span.turn() - 0.6).abs() < 1e-12);
    for i in 0..=50 {
        let jet = span.at(span.length() * f64::from(i) / 50.0);
        assert!((jet.p.length() - 5.0).abs() < 5.0 * 0.6f64.powi(6) / 8100.0, "{i}");
    }
    assert!((span.at(0.0).curvature - 0.2).abs() < 1e-12);
    assert!((span.at(span.length()).curvature - 0.2).abs() < 1e-12);
}

#[test]
fn a_long_cubic_is_off_its_biarcs_and_a_short_one_is_not() {
    let points = [[0.0, 0.0], [30.0, 5.0], [-5.0, 20.0], [20.0, 25.0]].map(DVec2::from_array);
    let span = CubicSpan::new(points).unwrap();
    let offs = [8, 16, 32].map(|n| span.off_biarcs(n));
    // The error falls with the third power of the length.
    assert!(offs[0] < 1.0 && offs[1] > 1e-4, "{offs:?}");
    assert!((4.0..12.0).contains(&(offs[1] / offs[2])), "{offs:?}");
    let cusp = [[0.0, 0.0], [10.0, 10.0], [0.0, 10.0], [10.0, 0.0]].map(DVec2::from_array);
    assert!(CubicSpan::new(cusp).unwrap().off_biarcs(15) > 0.01);
    let line = CubicSpan::new([0.0, 1.0, 2.0, 3.0].map(|x| DVec2::X * x)).unwrap();
    assert!(line.off_biarcs(16) < 1e-15);
}

#[test]
fn its_arcs_are_near_it() {
    let span =
        CubicSpan::new([[0.0, 0.0], [30.0, 5.0], [-5.0, 20.0], [20.0, 25.0]].map(DVec2::from_array)).unwrap();
    let tolerance = 5e-4;
    let arcs = span.arcs(tolerance).unwrap();
    assert!(arcs.len() < 150, "{}", arcs.len());
    assert_eq!([arcs[0].start, arcs[arcs.len() - 1].end], [span.start(), span.end()]);
    for i in 1..2000 {
        let p = bernstein(span.points(), f64::from(i) / 2000.0);
        let near = arcs
            .iter()
            .filter(|a| {
                let d = a.end - a.start;
                (-0.01..1.01).contains(&((p - a.start).dot(d) / d.length_squared()))
            })
            .map(|a| {
                if a.is_line() {
                    return (p - a.start).perp_dot((a.end - a.start).normalize_or_zero()).abs();
                }
                (p.distance(a.centre) - a.radius()).abs()
            })
            .fold(f64::INFINITY, f64::min);
        assert!(near < tolerance, "{i} {near}");
    }
}

#[test]
fn in_space_it_is_the_same_curve_moved_turned_back_and_cut() {
    use crate::geom::{Curve, Rigid};
    use glam::{DMat3, DVec3};
    let points = [[1.0, 2.0], [30.0, 5.0], [20.0, 26.0], [-4.0, 25.0]].map(DVec2::from_array);
    let span = CubicSpan::new(points).unwrap();
    let motion = Rigid { rotation: DMat3::from_rotation_x(0.7), translation: DVec3::new(3.0, -1.0, 4.0) };
    let curve = Curve::cubic(span, -2.0).moved(&motion);
    let length = span.length();
    assert_eq!(curve.length(), length);
    let (a, b) = (0.2 * length, 0.7 * length);
    let (part, back) = (curve.part(a, b), curve.reversed());
    assert!((part.length() - (b - a)).abs() < 1e-11 * length);
    for i in 0..=20 {
        let s = length * f64::from(i) / 20.0;
        let jet = curve.at(s);
        assert!((jet.p - motion.point(span.at(s).p.extend(-2.0))).length() < 1e-12);
        let [p, d1, d2, d3, d4] = curve.derivatives::<5>(s);
        assert!((p - jet.p).length() < 1e-12 && (d1 - jet.d1).length() < 1e-12);
        assert!((d2 - jet.d2).length() < 1e-10 && (d3 - jet.d3).length() < 1e-9);
        let h = 1e-4;
        let between = |s: f64| s > h && s < length - h;
        if between(s) {
            let slope = (curve.at(s + h).d3 - curve.at(s - h).d3) / (2.0 * h);
            assert!((slope - d4).length() < 1e-6 * (1.0 + d4.length()), "{slope} {d4}");
        }
        assert!((back.at(length - s).p - jet.p).length() < 1e-9);
        assert!((back.at(length - s).d1 + jet.d1).length() < 1e-9);
        if s > a && s < b {
            assert!((part.at(s - a).p - jet.p).length() < 1e-10);
        }
    }
    let bounds = Curve::cubic(span, -2.0).bounds();
    let fine: Vec<DVec2> = (0..=3000).map(|i| bernstein(points, f64::from(i) / 3000.0)).collect();
    let most = fine.iter().map(|p| p.x).fold(0.0, f64::max);
    assert!(bounds.max.x >= most && bounds.max.x < most + 3e-3 && bounds.max.z < -1.99);
}
