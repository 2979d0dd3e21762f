use glam::{DMat3, DVec2, DVec3};
use proptest::prelude::*;

use super::*;
use crate::geom::{Profile, Rigid};
use crate::num::minimum::minimum_over;

/// Least distance to points of a surface, by search over its parameters.
fn brute(surface: impl Fn(f64, f64) -> DVec3, domain: [[f64; 2]; 2], p: DVec3) -> f64 {
    minimum_over(|[u, v]| surface(u, v).distance(p), domain, [40, 40]).1
}

const TURN: [f64; 2] = [-std::f64::consts::PI, std::f64::consts::PI];

#[test]
fn the_first_point_of_a_flank_may_be_nearer_than_a_normal() {
    let flank = InvoluteFlank { base: 3.0, start: 0.4, clockwise: false, teeth: 5 };
    let p = DVec3::new(0.0, -3.0420267118652067, 0.0);
    let first = |k: f64| {
        let (s, c) = (0.4 + k * 0.4 * std::f64::consts::PI).sin_cos();
        DVec3::new(3.0 * c, 3.0 * s, 0.0)
    };
    let least = (0..5).map(|k| (first(f64::from(k)) - p).length()).fold(9.0, f64::min);
    assert!((flank.signed(p).abs() - least).abs() < 1e-12 && least < 1.6194, "{} {least}", flank.signed(p));
}

proptest! {
    #![proptest_config(kinecut_cases::property(24))]

    #[test]
    fn bodies_agree_with_their_surfaces(x in -9.0..9.0f64, y in -9.0..9.0f64, z in -9.0..9.0f64) {
        let p = DVec3::new(x, y, z);
        let torus = ElementaryBody::Torus { centre: DVec3::ZERO, axis: DVec3::Z, major: 6.0, minor: 2.0 };
        let on = |u: f64, v: f64| {
            let r = 6.0 + 2.0 * v.cos();
            DVec3::new(r * u.cos(), r * u.sin(), 2.0 * v.sin())
        };
        prop_assert!((torus.signed(p).abs() - brute(on, [TURN, TURN], p)).abs() < 1e-6);
        let cone = ElementaryBody::Cone { apex: DVec3::Z, axis: DVec3::NEG_Z, half_angle: 0.4 };
        // The search of the check divides the generating line into steps of one: the foot must lie off the apex.
        let foot = p.truncate().length() * 0.4f64.sin() + (1.0 - z) * 0.4f64.cos();
        prop_assume!(!(-1.5..1.5).contains(&foot));
        let on = |u: f64, s: f64| {
            DVec3::new(s * 0.4f64.sin() * u.cos(), s * 0.4f64.sin() * u.sin(), 1.0 - s * 0.4f64.cos())
        };
        prop_assert!((cone.signed(p).abs() - brute(on, [TURN, [0.0, 40.0]], p)).abs() < 1e-6);
        prop_assert_eq!(cone.signed(p) < 0.0, p.truncate().length() < (1.0 - z) * 0.4f64.tan());
        let sheet = Hyperboloid { throat: 3.0, slope: 0.5 };
        let on = |u: f64, h: f64| {
            let r = (9.0 + 0.25 * h * h).sqrt();
            DVec3::new(r * u.cos(), r * u.sin(), h)
        };
        prop_assert!((sheet.signed(p).abs() - brute(on, [TURN, [-20.0, 20.0]], p)).abs() < 1e-6);
        prop_assert_eq!(sheet.signed(p) < 0.0, p.truncate().length_squared() < 9.0 + 0.25 * z * z);
    }

    #[test]
    fn an_involute_flank(x in -9.0..9.0f64, y in -9.0..9.0f64) {
        let p = DVec3::new(x, y, 5.0);
        prop_assume!(p.truncate().length() > 3.0);
        for clockwise in [false, true] {
            let side = if clockwise { -1.0 } else { 1.0 };
            let flank = InvoluteFlank { base: 3.0, start: 0.4, clockwise, teeth: 5 };
            let on = |tooth: u32, t: f64| {
                let (s, c) = (0.4 * side + t + std::f64::consts::TAU / 5.0 * f64::from(tooth)).sin_cos();
                DVec3::new(c + t * s, (s - t * c) * side, 0.0) * 3.0 + DVec3::Z * 5.0
            };
            let least = (0..5).map(|k| brute(|t, _| on(k, t), [[0.0, 9.0], [0.0, 0.0]], p)).fold(9.0, f64::min);
            prop_assert!((flank.signed(p).abs() - least).abs() < 1e-6, "{} {least}", flank.signed(p));
        }
    }

    #[test]
    fn a_mill_as_a_meridian_is_the_union_of_its_parts(x in -9.0..9.0f64, z in -4.0..14.0f64, a in 0.0..6.0f64) {
        let p = DVec3::new(x * a.cos(), x * a.sin(), z);
        let mill = Meridian::of_profile(&Profile::bull_nose(10.0, 2.0, 10.0).unwrap());
        // In the half-plane: the hull of discs of radius 2 over a rectangle whose upper side is sharp.
        let q = DVec2::new(x.abs(), z);
        let expected = if q.y < 2.0 && (q.x > 3.0 || q.y < 0.0) {
            (q.x - 3.0).max(0.0).hypot(2.0 - q.y) - 2.0
        } else if q.y <= 10.0 && q.x <= 5.0 {
            (q.x - 5.0).max(q.y - 10.0).max(-q.y)
        } else {
            (q.x - 5.0).max(0.0).hypot((q.y - 10.0).max(0.0))
        };
        let found = mill.signed(p);
        prop_assert!((found - expected).abs() < 1e-12 || found < 0.0 && expected < 0.0, "{found} {expected}");
    }

    #[test]
    fn a_prism_and_a_placed_hollow_body(x in -4.0..7.0f64, y in -4.0..7.0f64) {
        let p = DVec3::new(x, y, 3.0);
        let square = Prism::new([[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]].map(DVec2::from).to_vec()).unwrap();
        let q = (p.truncate() - 1.5).abs() - 1.5;
        let expected = q.max(DVec2::ZERO).length() + q.max_element().min(0.0);
        prop_assert!((square.signed(p) - expected).abs() < 1e-12);
        let motion = Rigid { rotation: DMat3::from_rotation_y(0.7), translation: DVec3::new(1.0, 2.0, 3.0) };
        let placed = Placed::new(Hollow(&square), motion);
        let at = motion.point(p);
        prop_assert!((placed.signed(at) + expected).abs() < 1e-12);
        prop_assume!(expected.abs() > 1e-3 && (q.x - q.y).abs() > 1e-3);
        prop_assert!((placed.gradient(at) + motion.vector(square.gradient(p))).length() < 1e-9);
    }

    #[test]
    fn feet_on_a_parametric_surface(x in -30.0..30.0f64, y in -30.0..30.0f64, z in -12.0..12.0f64) {
        let p = DVec3::new(x, y, z);
        prop_assume!((p.truncate().length() - 20.0).hypot(z) > 0.5);
        let torus = |u: f64, v: f64| {
            let r = 20.0 + 6.0 * v.cos();
            DVec3::new(r * u.cos(), r * u.sin(), 6.0 * v.sin())
        };
        let patch = ParametricSurface::new(torus, [TURN, TURN], [16, 12], false).unwrap();
        let exact = ElementaryBody::Torus { centre: DVec3::ZERO, axis: DVec3::Z, major: 20.0, minor: 6.0 };
        prop_assert!((patch.signed(p) - exact.signed(p)).abs() < 1e-9, "{} {}", patch.signed(p), exact.signed(p));
    }
}

#[test]
fn a_ring_and_points_on_the_axis() {
    let centre = DVec2::new(5.0, 1.0);
    let arc = MeridianPiece::Arc { centre, radius: 2.0, from: 0.3, sweep: std::f64::consts::TAU };
    let ring = Meridian::new(vec![arc]).unwrap();
    assert!((ring.signed(DVec3::new(0.0, 5.0, 1.0)) + 2.0).abs() < 1e-14);
    assert!((ring.signed(DVec3::new(0.0, 0.0, 1.0)) - 3.0).abs() < 1e-14);
    let ball = Meridian::of_profile(&Profile::bull_nose(10.0, 5.0, 10.0).unwrap());
    assert!((ball.signed(DVec3::NEG_Z) - 1.0).abs() < 1e-12);
    assert!((ball.signed(DVec3::Z * 12.0) - 2.0).abs() < 1e-12);
    assert!((ball.signed(DVec3::Z * 5.0) + 5.0).abs() < 1e-12);
    let sheet = Hyperboloid { throat: 3.0, slope: 0.5 };
    assert!(sheet.signed(DVec3::ZERO) == -3.0 && sheet.signed(DVec3::X * 3.0) == 0.0);
}

#[test]
fn meridians_polygons_and_patches_that_make_no_body_are_refused() {
    let line = |a: [f64; 2], b: [f64; 2]| MeridianPiece::Line { from: a.into(), to: b.into() };
    for pieces in [
        vec![],
        vec![line([1.0, 0.0], [2.0, 0.0])],
        vec![line([0.0, 0.0], [2.0, 0.0]), line([2.0, 1.0], [0.0, 1.0])],
        vec![line([0.0, 0.0], [-2.0, 0.0]), line([-2.0, 0.0], [0.0, 1.0])],
        vec![line([0.0, f64::NAN], [2.0, 0.0])],
    ] {
        let error = Meridian::new(pieces).unwrap_err();
        assert_eq!(error.code().as_str(), "KC1131");
    }
    assert!(Prism::new(vec![DVec2::ZERO, DVec2::X]).is_err());
    let flat = |u: f64, v: f64| DVec3::new(u, v, 0.0);
    assert!(ParametricSurface::new(flat, [[0.0, 0.0], [0.0, 1.0]], [2, 2], false).is_err());
    let broken = |u: f64, v: f64| DVec3::new(u, v, (u - 0.5).ln());
    assert!(ParametricSurface::new(broken, [[0.0, 1.0], [0.0, 1.0]], [2, 2], false).is_err());
}
