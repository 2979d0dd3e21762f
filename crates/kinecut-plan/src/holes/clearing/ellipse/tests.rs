use super::*;
use crate::geom::{ContactOrder, joint};
use proptest::prelude::*;

fn pocket(half_axes: [f64; 2], cutter: f64, inner: f64, step: f64) -> EllipsePocket {
    EllipsePocket { half_axes, cutter, allowance: 0.0, inner, step, order: LensOrder::One }
}

#[test]
fn the_example_of_the_spec() {
    // A path ellipse of 60 x 40 is what a cutter of vanishing radius runs in the same wall.
    let cutter = 4.0;
    let law = ForwardSpiral::law(&pocket([60.0, 40.0], 1e-300, 0.0, 4.0), 0.0, 15);
    assert!(
        (ForwardSpiral::least_radius(&law, 1, 15) - 2.565).abs() < 5e-3,
        "{}",
        ForwardSpiral::least_radius(&law, 1, 15)
    );
    let path = ellipse(&pocket([64.0, 44.0], cutter, 0.0, 4.0)).unwrap();
    // A semicircle, and fifteen turns less the first.
    assert_eq!(path.turns, 14.5);
    assert_eq!(path.reach, [60.0, 40.0]);
    let end = path.curves[1].at(path.curves[1].length());
    assert!((end.p - DVec2::new(0.0, -40.0)).length() < 1e-11);
    // a^2/b of the wall less the cutter, with no slope.
    assert!((1.0 / end.curvature - (64.0 * 64.0 / 44.0 - cutter)).abs() < 1e-9);
    assert!(end.curvature_slope.abs() < 1e-12);
}

fn checked(p: &EllipsePocket) -> ClearedEllipse {
    let path = ellipse(p).unwrap();
    assert!(path.step <= p.step * (1.0 + 1e-9), "{p:?} {}", path.step);
    assert!(path.least_radius > 0.0);
    let mut curves: Vec<_> = path.curves.iter().map(|c| c.at_height(0.0, 0.0)).collect();
    curves.push(path.closing.at_height(0.0, 0.0));
    let joints: Vec<ContactOrder> = curves.windows(2).map(|c| joint(&c[0], &c[1]).contact).collect();
    let (wall, inside) = joints.split_last().unwrap();
    let expected = [ContactOrder::G2, ContactOrder::G4, ContactOrder::G6][p.order as usize];
    assert_eq!(*wall, expected, "{p:?}");
    assert!(inside.iter().all(|c| *c >= ContactOrder::G1), "{p:?} {inside:?}");
    // Inside the wall, by the distance from it on its normal.
    for (s, jet) in path.closing.walk(90) {
        let [u, v] = [jet.d1.y, -jet.d1.x];
        let wall = jet.p + DVec2::new(u, v) * (p.cutter + p.allowance);
        let share = (wall.x / p.half_axes[0]).powi(2) + (wall.y / p.half_axes[1]).powi(2);
        assert!((share - 1.0).abs() < 1e-9, "{p:?} {s}");
    }
    path
}

/// Whether the swept discs leave anything of the ellipse: points of a grid against points of the path.
fn uncovered(p: &EllipsePocket, path: &ClearedEllipse) -> Option<DVec2> {
    let slack = 0.02 * p.cutter;
    let spacing = (8.0 * p.cutter * slack).sqrt();
    let mut points = vec![path.curves[0].start()];
    for c in path.curves.iter().chain([&path.closing]) {
        points.extend(c.walk((c.length() / spacing * 4.0).ceil() as usize).iter().map(|(_, j)| j.p));
    }
    let n = 40;
    (0..n * n)
        .map(|i| DVec2::new(f64::from(i % n) + 0.5, f64::from(i / n) + 0.5) * (2.0 / f64::from(n)) - 1.0)
        .filter(|q| q.length() < 1.0)
        .map(|q| q * (DVec2::from_array(p.half_axes) - p.allowance - 2.0 * slack))
        .filter(|q| p.inner == 0.0 || q.length() > p.inner + p.cutter)
        .find(|q| points.iter().all(|c| (*c - *q).length() > p.cutter + slack))
}

#[test]
fn pockets_of_all_shapes_are_cleared() {
    for p in [
        pocket([68.0, 48.0], 8.0, 0.0, 4.0),
        pocket([48.0, 68.0], 8.0, 5.0, 4.0),
        pocket([50.0, 50.0], 10.0, 3.0, 7.0),
        pocket([90.0, 30.0], 8.0, 0.0, 4.0),
        pocket([90.0, 30.0], 8.0, 3.0, 15.0),
        pocket([30.0, 28.0], 10.0, 0.0, 20.0),
        EllipsePocket { order: LensOrder::Two, allowance: 0.5, ..pocket([60.0, 45.0], 10.0, 6.0, 3.0) },
        EllipsePocket { order: LensOrder::Zero, ..pocket([60.0, 45.0], 10.0, 0.0, 3.0) },
    ] {
        let path = checked(&p);
        assert_eq!(uncovered(&p, &path), None, "{p:?}");
        let smaller = EllipsePocket { cutter: 0.4 * path.step, inner: 0.0, ..p };
        assert!(uncovered(&smaller, &path).is_some());
    }
}

#[test]
fn the_engagement_is_that_of_brute_force() {
    for p in [pocket([68.0, 48.0], 8.0, 5.0, 4.0), pocket([40.0, 55.0], 10.0, 6.0, 3.0)] {
        let path = ellipse(&p).unwrap();
        let first = InvoluteRecord::circle(p.inner, 0.0).unwrap();
        let mut curves = vec![PlaneCurve::from(first)];
        curves.extend(&path.curves);
        curves.push(path.closing);
        let samples = crate::holes::engagement(&curves, p.cutter, Some(p.inner + p.cutter), 1500).unwrap();
        let spiral = path.curves[0].length();
        // From the second turn on; turns are of very different lengths, so by the angle.
        let PlaneCurve::Spiral(s) = path.curves[0] else { panic!("a spiral") };
        let from = first.length() + s.length_to(TAU);
        assert!(from < spiral);
        let brute = samples.iter().filter(|x| x.s > from).map(|x| x.angle).fold(0.0, f64::max);
        let difference = (brute - path.engagement).to_degrees();
        assert!(difference.abs() < 0.7, "{p:?}: {} {}", brute.to_degrees(), path.engagement.to_degrees());
    }
}

#[test]
fn what_does_not_fit_is_said_with_the_place() {
    let e = ellipse(&pocket([90.0, 30.0], 11.0, 0.0, 4.0)).unwrap_err();
    assert_eq!(e.code(), Code::CUTTER_TOO_LARGE);
    assert_eq!(e.0.point, Some([90.0, 0.0, 0.0]));
    assert!(e.0.message.contains("(90, 0) and (-90, 0)"), "{e}");
    assert!((e.0.bound.as_ref().unwrap().value - 10.0).abs() < 1e-12 && e.0.value.unwrap().value == 11.0);
    let upright = ellipse(&pocket([30.0, 90.0], 11.0, 0.0, 4.0)).unwrap_err();
    assert_eq!(upright.0.point, Some([0.0, 90.0, 0.0]));
    for (p, code) in [
        (pocket([60.0, 40.0], 40.0, 0.0, 4.0), Code::CUTTER_TOO_LARGE),
        (pocket([60.0, 0.0], 4.0, 0.0, 4.0), Code::PLAN_VALUE),
        (pocket([f64::NAN, 40.0], 4.0, 0.0, 4.0), Code::PLAN_VALUE),
        (pocket([60.0, 40.0], 0.0, 0.0, 4.0), Code::PLAN_VALUE),
        (pocket([60.0, 40.0], 8.0, 0.0, 17.0), Code::PLAN_VALUE),
        (pocket([60.0, 40.0], 8.0, 0.0, 1e-9), Code::PLAN_VALUE),
        (pocket([60.0, 40.0], 8.0, 32.0, 4.0), Code::PLAN_VALUE),
        (pocket([60.0, 40.0], 8.0, -1.0, 4.0), Code::PLAN_VALUE),
        (EllipsePocket { allowance: -1.0, ..pocket([60.0, 40.0], 8.0, 0.0, 4.0) }, Code::PLAN_VALUE),
        (EllipsePocket { allowance: 25.0, ..pocket([60.0, 40.0], 8.0, 0.0, 4.0) }, Code::CUTTER_TOO_LARGE),
    ] {
        assert_eq!(ellipse(&p).unwrap_err().code(), code, "{p:?}");
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(16))]
    #[test]
    fn any_pocket_into_which_the_cutter_fits_is_cleared_or_refused(
        long in 20.0..90.0f64, share in 0.4..1.0f64, cutter in 0.2..0.9f64, inner in 0.0..0.8f64,
        step in 0.1..1.0f64, plunge in any::<bool>(),
    ) {
        let short = long * share;
        let radius = cutter * short * short / long;
        let start = if plunge { 0.0 } else { (inner * (short - radius)).min(0.95 * radius) };
        let p = pocket([long, short], radius, start, step * radius);
        match ellipse(&p) {
            Ok(_) => { checked(&p); }
            Err(e) => prop_assert_eq!(e.code(), Code::PLAN_VALUE, "{:?}", p),
        }
    }
}
