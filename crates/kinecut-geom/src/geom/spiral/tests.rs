use std::f64::consts::TAU;

use glam::DVec2;

use super::*;
use crate::geom::{ConstantEngagement, LensOrder, Support};

fn all() -> Vec<(Spiral, &'static str)> {
    let lens = |inner: f64, order| Support::Lens { inner, base_radius: 0.62, order }.into();
    let even = ConstantEngagement::new(10.0, 79.0, 20.0, 1.0, LensOrder::One);
    let morph = Support::Morph {
        inner: 5.0,
        half_axes: [60.0, 40.0],
        offset: 8.0,
        turns: 15.0,
        order: LensOrder::One,
    };
    let list: [(SpiralLaw, f64, f64, &str); 8] = [
        (lens(0.0, LensOrder::Zero), 3.0, 50.0, "lens 0"),
        (lens(10.0, LensOrder::One), 0.0, 30.0, "lens 1"),
        (lens(10.0, LensOrder::Two), 30.0, 4.0, "lens 2"),
        (Support::ConstantEngagement(even).into(), 0.0, even.turns() * TAU, "constant engagement"),
        (morph.into(), 0.0, 15.0 * TAU, "morph"),
        (Support::Ellipse { half_axes: [60.0, 40.0], offset: 8.0 }.into(), 1.0, 7.0, "ellipse"),
        (SpiralLaw::Archimedes { growth: 0.7 }, 0.0, 40.0, "archimedes"),
        (SpiralLaw::Trochoid { carrier: 50.0, loop_radius: 29.0, rate: 127.0 }, 0.0, 0.3, "trochoid"),
    ];
    list.into_iter()
        .map(|(law, a, b, name)| {
            let plain = Spiral::new(law, a, b).unwrap();
            (plain.mirrored().rotated(0.4).shifted(DVec2::new(3.0, -7.0)), name)
        })
        .collect()
}

#[test]
fn the_derivatives_are_those_of_the_points() {
    for (curve, name) in all() {
        for i in 1..20 {
            let s = curve.length() * f64::from(i) / 20.0;
            let jet = curve.at(s);
            let h = 1e-3 / (1.0 + jet.curvature.abs());
            let p = |k: f64| curve.at(s + k * h).p;
            let d1 = (p(1.0) - p(-1.0)) / (2.0 * h);
            let d2 = (p(1.0) - p(0.0) * 2.0 + p(-1.0)) / (h * h);
            let k = jet.curvature.abs() + 1e-2;
            assert!((d1 - jet.d1).length() < 1e-5, "{name} {s} {d1} {}", jet.d1);
            assert!((d2 - jet.d2).length() < 1e-3 * k + 1e-6, "{name} {s} {d2} {}", jet.d2);
            let slope = |x: f64| curve.at(x).curvature;
            let d3 = (slope(s + h) - slope(s - h)) / (2.0 * h);
            assert!((d3 - jet.curvature_slope).abs() < 1e-4 * k * k + 1e-7, "{name} {d3} {jet:?}");
            assert!((DVec2::from_angle(jet.angle) - jet.d1).length() < 1e-12);
        }
    }
}

#[test]
fn the_length_is_that_of_a_fine_polyline() {
    for (curve, name) in all() {
        let [a, b] = curve.parameters();
        let n = 200_000;
        let at = |i: i32| curve.point(a + (b - a) * f64::from(i) / f64::from(n));
        let sum: f64 = (0..n).map(|i| (at(i + 1) - at(i)).length()).sum();
        assert!((sum / curve.length() - 1.0).abs() < 1e-6, "{name} {sum} {}", curve.length());
        let middle = curve.parameter(0.4 * curve.length());
        assert!((curve.length_to(middle) / curve.length() - 0.4).abs() < 1e-12, "{name}");
        let parts = curve.parts(TAU);
        let whole: f64 = parts.iter().map(Spiral::length).sum();
        assert!((whole / curve.length() - 1.0).abs() < 1e-12, "{name}");
        assert_eq!(parts[parts.len() - 1].end(), curve.end());
        let back = curve.reversed();
        assert!((back.at(0.25 * curve.length()).p - curve.at(0.75 * curve.length()).p).length() < 1e-9);
        assert!((back.at(1.0).d1 + curve.at(curve.length() - 1.0).d1).length() < 1e-9);
    }
}

#[test]
fn the_step_of_a_lens_is_constant_along_the_normal() {
    // The definition of the theorem, on points: along the normal the next turn is 2 pi r away.
    let law = Support::Lens { inner: 10.0, base_radius: 0.62, order: LensOrder::Two };
    let spiral = Spiral::new(law.into(), 0.0, 60.0).unwrap();
    for i in 0..50 {
        let th = f64::from(i);
        let (p, q) = (spiral.point(th), spiral.point(th + TAU));
        let normal = DVec2::new(th.sin(), -th.cos());
        assert!((q - p - normal * (TAU * 0.62)).length() < 1e-11, "{th}");
    }
}

#[test]
fn a_cusp_has_a_place_and_a_direction() {
    let law = Support::Lens { inner: 0.0, base_radius: 0.62, order: LensOrder::One };
    let spiral = Spiral::new(law.into(), 0.0, 9.0).unwrap();
    let jet = spiral.at(0.0);
    assert_eq!(jet.d1, DVec2::X);
    assert!(jet.p.length() < 1e-15 && jet.curvature == f64::INFINITY);
    assert!(Spiral::new(law.into(), 1.0, 1.0).is_err());
    assert!(Spiral::new(law.into(), 1.0, f64::NAN).is_err());
}
