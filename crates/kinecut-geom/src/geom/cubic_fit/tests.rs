use std::f64::consts::TAU;

use proptest::prelude::*;

use super::*;
use crate::geom::{ConstantEngagement, InvoluteRecord, LensOrder, Spiral, SpiralLaw, Support};

/// Distance of a point from a chain: the least over dense points of each span, refined by halving about the best.
fn distance(spans: &[CubicSpan], from: usize, p: DVec2) -> f64 {
    let near = &spans[from.saturating_sub(1)..(from + 2).min(spans.len())];
    let mut best = f64::INFINITY;
    for span in near {
        let off = |t: f64| span.point(t.clamp(0.0, 1.0)).distance(p);
        let n = 24;
        let mut t =
            (0..=n).map(|i| f64::from(i) / f64::from(n)).min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap();
        let mut h = 1.0 / f64::from(n);
        while h > 1e-9 {
            t = [t - h, t, t + h]
                .into_iter()
                .min_by(|a, b| off(*a).total_cmp(&off(*b)))
                .unwrap()
                .clamp(0.0, 1.0);
            h *= 0.6;
        }
        best = best.min(off(t));
    }
    best
}

/// Largest distance of the curve from its chain.
fn worst(curve: &PlaneCurve, spans: &[CubicSpan], per_span: usize) -> f64 {
    let count = spans.len() * per_span;
    let lengths: Vec<f64> = spans
        .iter()
        .scan(0.0, |sum, s| {
            *sum += s.length();
            Some(*sum)
        })
        .collect();
    (1..count)
        .map(|i| {
            let s = curve.length() * i as f64 / count as f64;
            let k = lengths.partition_point(|l| *l < s).min(spans.len() - 1);
            distance(spans, k, curve.at(s).p)
        })
        .fold(0.0, f64::max)
}

fn joined(curve: &PlaneCurve, spans: &[CubicSpan]) {
    let (first, last) = (&spans[0], &spans[spans.len() - 1]);
    assert!((first.start() - curve.start()).length() < 1e-9);
    assert!((last.end() - curve.end()).length() < 1e-9);
    for w in spans.windows(2) {
        assert_eq!(w[0].end(), w[1].start());
        let (a, b) = (w[0].at_parameter(1.0), w[1].at_parameter(0.0));
        assert!((a.d1 - b.d1).length() < 1e-9);
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(24))]

    #[test]
    fn an_involute_is_within_the_tolerance(
        a in 0.0..40.0f64, turned in 0.3..8.0f64, r in 0.05..3.0f64, exponent in -4.3..-2.0f64,
        cw in any::<bool>(), inward in any::<bool>(),
    ) {
        let b = a + turned;
        let plain = InvoluteRecord::new(0.5 * r * (b - a) * (b + a), [3.0, -1.0], 0.4, r * a, r * b).unwrap();
        let plain = if cw { plain.mirrored() } else { plain };
        let curve: PlaneCurve = if inward { plain.reversed() } else { plain }.into();
        let tolerance = 10f64.powf(exponent);
        let spans = cubics_along(&curve, tolerance).unwrap();
        joined(&curve, &spans);
        let found = worst(&curve, &spans, 40);
        prop_assert!(found <= tolerance, "{found} > {tolerance}, {} spans", spans.len());
    }
}

#[test]
fn the_spirals_of_a_bore_are_within_the_tolerance() {
    let r = 69.0 / (20.0 * TAU);
    let lens = |inner: f64, order| Support::Lens { inner, base_radius: r, order }.into();
    let engaged = ConstantEngagement::new(5.0, 40.0, 5.0, 1.2, LensOrder::One);
    let laws: [(SpiralLaw, f64); 5] = [
        (lens(10.0, LensOrder::One), 4.0 * TAU),
        (lens(0.0, LensOrder::Two), 3.0 * TAU),
        (Support::ConstantEngagement(engaged).into(), 3.0 * TAU),
        (SpiralLaw::Archimedes { growth: 0.5 }, 4.0 * TAU),
        // Waves with inflections.
        (SpiralLaw::Trochoid { carrier: 20.0, loop_radius: 0.5, rate: 25.0 }, 1.0),
    ];
    for (law, to) in laws {
        let plain = Spiral::new(law, 0.0, to).unwrap();
        for spiral in [plain, plain.reversed().rotated(1.0)] {
            let curve: PlaneCurve = spiral.into();
            for tolerance in [0.01, 0.0005] {
                let spans = cubics_along(&curve, tolerance).unwrap();
                joined(&curve, &spans);
                let found = worst(&curve, &spans, 24);
                assert!(found <= tolerance, "{law:?} {found}");
                assert!(found > 0.5 * tolerance, "{law:?} {found}: too many spans");
            }
        }
    }
}

#[test]
fn the_count_is_that_of_the_formula() {
    // The error is rho D^6 / 8100.
    let curve: PlaneCurve = InvoluteRecord::new(500.0, [0.0; 2], 0.0, 40.0, 45.0).unwrap().into();
    for tolerance in [0.01, 0.001, 0.0001] {
        let steps = curve.turn() / (8100.0 * tolerance / 42.5f64).powf(1.0 / 6.0);
        let n = cubics_along(&curve, tolerance).unwrap().len() as f64;
        assert!(n >= 0.9 * steps && n <= 1.15 * steps + 1.0, "{n} {steps}");
    }
}

#[test]
fn a_tolerance_that_is_none_is_refused_and_a_line_is_one_cubic() {
    let line: PlaneCurve =
        InvoluteRecord::new(9.0, [1.0, 0.0], 0.5, f64::INFINITY, f64::INFINITY).unwrap().into();
    let spans = cubics_along(&line, 0.001).unwrap();
    assert!(spans.iter().map(CubicSpan::length).sum::<f64>() - 9.0 < 1e-12);
    joined(&line, &spans);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-30] {
        let curve: PlaneCurve = InvoluteRecord::new(500.0, [0.0; 2], 0.0, 40.0, 45.0).unwrap().into();
        assert_eq!(cubics_along(&curve, bad).unwrap_err().code(), Code::GEOMETRY, "{bad}");
    }
}
