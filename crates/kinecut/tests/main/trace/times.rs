//! Closed forms.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use kinecut::base::Code;
use kinecut::geom::{Arc, Curve, InvoluteRecord, Line, PlaneCurve};
use kinecut::motion::{Limits, PathByLength, pointwise};

fn record(length: f64, start: [f64; 2], angle: f64, radii: [f64; 2]) -> PlaneCurve {
    InvoluteRecord::new(length, start, angle, radii[0], radii[1]).unwrap().into()
}

fn circle(radius: f64) -> PlaneCurve {
    record(TAU * radius, [0.0, -radius], 0.0, [radius, radius])
}

/// At 6, 18 and 36 m/min; the axes do not bind.
fn times<W: PathByLength>(chain: &[W]) -> [f64; 3] {
    [100.0, 300.0, 600.0].map(|f| {
        let limits = Limits { axis_velocity: 1e4, ..Limits::usual(f) };
        pointwise(chain, &limits).unwrap().time
    })
}

#[test]
fn a_circle_is_held_to_acceleration_and_to_jerk() {
    // A of 5000 on R 10: 223.6 mm/s; J of 1e5: (1e5 * 100)^(1/3) = 215.4 mm/s binds first.
    let limits = Limits::usual(400.0);
    assert!((limits.cap(0.1, 0.01) - 1e7f64.cbrt()).abs() < 1e-9);
    assert!((limits.cap(0.1, 1e-9) - 50_000f64.sqrt()).abs() < 1e-9);
    assert_eq!(limits.cap(0.0, f64::NAN), 400.0);
    assert_eq!(Limits { axis_velocity: 30.0, ..limits }.cap(0.0, 0.0), 30.0);
    let v = 1e7f64.cbrt();
    let law = pointwise(&[circle(10.0)], &limits).unwrap();
    // Two ramps of v/A, each the way of half that time at full speed.
    let expected = TAU * 10.0 / v + v / 5000.0;
    assert!((law.time - expected).abs() < 1e-4 * expected, "{} {expected}", law.time);
    let middle = law.places[law.places.len() / 2];
    assert!((middle.speed - v).abs() < 1e-9 && (middle.jerk - 1e5).abs() < 1e-3, "{middle:?}");
}

#[test]
fn a_corner_is_passed_at_the_speed_its_kink_allows() {
    let line = |a: [f64; 3], b: [f64; 3]| Curve::from(Line { start: a.into(), end: b.into() });
    let chain = [line([0.0; 3], [50.0, 0.0, 0.0]), line([50.0, 0.0, 0.0], [50.0, 50.0, 0.0])];
    let law = pointwise(&chain, &Limits::usual(100.0)).unwrap();
    let at_corner = law.places.iter().find(|p| p.s == 50.0).unwrap();
    assert!((at_corner.speed - 5.0 / FRAC_PI_2).abs() < 1e-9);
    // Four ramps; those at the corner end at v: each loses (F - v)^2 / (2 A F).
    let v = 5.0 / FRAC_PI_2;
    let expected = 1.0 + 2.0 * 100.0 / (2.0 * 5000.0) + 2.0 * (100.0 - v).powi(2) / (2.0 * 5000.0 * 100.0);
    assert!((law.time - expected).abs() < 1e-4, "{} {expected}", law.time);
}

#[test]
fn a_path_in_space_takes_as_long_as_in_its_plane_and_a_helix_longer() {
    let spiral = record(PI * 9.0 * 89.0, [0.0, -10.0], 0.0, [10.0, 79.0]);
    let plane = [circle(10.0), spiral, circle(79.0)];
    let space: Vec<Curve> = plane.iter().map(|c| c.at_height(-3.0, 0.0)).collect();
    for (a, b) in times(&plane).iter().zip(times(&space)) {
        assert!((a - b).abs() < 1e-3 * a, "{a} {b}");
    }
    let helix = Arc::new(DVec3::new(0.0, -10.0, 0.0), DVec3::ZERO, DVec3::Z, TAU, -2.0).unwrap();
    let flat = pointwise(&[circle(10.0)], &Limits::usual(20.0)).unwrap().time;
    let found = pointwise(&[Curve::from(helix)], &Limits::usual(20.0)).unwrap();
    assert!((found.time - flat - (found.length - TAU * 10.0) / 20.0).abs() < 1e-4);
}

#[test]
fn limits_that_are_none_are_refused_with_their_key() {
    let refused = |limits: Limits| pointwise(&[circle(5.0)], &limits).unwrap_err();
    let error = refused(Limits { jerk: 0.0, ..Limits::usual(50.0) });
    assert_eq!((error.code(), error.0.key.as_deref()), (Code::PLAN_VALUE, Some("jerk")));
    let error = refused(Limits { feed: f64::NAN, ..Limits::usual(50.0) });
    assert_eq!(error.0.key.as_deref(), Some("feed"));
    let none: [PlaneCurve; 0] = [];
    assert_eq!(pointwise(&none, &Limits::usual(50.0)).map(|l| l.time).unwrap_or(0.0), 0.0);
}
