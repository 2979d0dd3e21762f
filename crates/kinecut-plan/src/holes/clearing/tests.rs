//! Properties of every strategy, measured on points of the paths.

use std::f64::consts::TAU;

use glam::DVec2;
use proptest::prelude::*;

use super::*;
use crate::geom::{ContactOrder, Curve, InvoluteRecord, PlaneCurve, joint, on_circle};

const ALL: [Clearing; 14] = [
    Clearing::Involute,
    Clearing::Lens(LensOrder::Zero),
    Clearing::Lens(LensOrder::One),
    Clearing::Lens(LensOrder::Two),
    Clearing::ConstantEngagement(LensOrder::Zero),
    Clearing::ConstantEngagement(LensOrder::One),
    Clearing::ConstantEngagement(LensOrder::Two),
    Clearing::Poles(2),
    Clearing::Poles(3),
    Clearing::Poles(4),
    Clearing::Archimedes,
    Clearing::RingsRadial,
    Clearing::RingsTangent,
    Clearing::Trochoid,
];

/// The paper's rough pass.
fn paper(inner: f64) -> Disc {
    Disc {
        inner,
        inner_most: inner,
        outer: 79.0,
        cutter: 20.0,
        step: 4.0,
        engagement: Some(60f64.to_radians()),
        psi: 0.0,
        resolution: None,
    }
}

fn length(path: &Cleared) -> f64 {
    path.curves.iter().map(PlaneCurve::length).sum::<f64>() + path.closing.length()
}

fn in_space(path: &Cleared) -> Vec<Curve> {
    let closing = PlaneCurve::from(path.closing);
    path.curves.iter().chain([&closing]).map(|c| c.at_height(0.0, 0.0)).collect()
}

#[test]
fn the_lengths_of_the_comparison_table() {
    // Section "competing strategies", closing circle included, to the digits given.
    let disc = paper(0.0);
    let of = |c: Clearing| length(&c.path(&disc).unwrap());
    for (clearing, expected) in [
        (Clearing::Poles(2), 5336.00),
        (Clearing::Poles(4), 5398.04),
        (Clearing::Archimedes, 5461.98),
        (Clearing::RingsRadial, 5290.90),
        (Clearing::Involute, 5460.09),
        (Clearing::Lens(LensOrder::Zero), 5460.09),
        (Clearing::Lens(LensOrder::One), 5460.09),
        (Clearing::Lens(LensOrder::Two), 5460.09),
    ] {
        let found = of(clearing);
        assert!((found - expected).abs() < 0.005, "{} {found}", clearing.name());
        let path = clearing.path(&disc).unwrap();
        assert!((path.step - 3.95).abs() < 1e-12, "{}", clearing.name());
    }
    // 126 loops of the ring from 20 are 23541 mm; the path has a half loop more.
    let ring = Disc { step: 3.95, ..paper(20.0) };
    let found = of_loops(&ring);
    assert!((found / 126.5 * 126.0 - 23541.0).abs() < 30.0, "{found}");
}

fn of_loops(disc: &Disc) -> f64 {
    Clearing::Trochoid.path(disc).unwrap().curves.iter().map(PlaneCurve::length).sum()
}

#[test]
fn the_table_of_constant_engagement() {
    // Free steps: the cap is as large as the cutter allows.
    for (limit, inner, turns, rounded) in [(60.0, 10.0, 11.0, 2800.0), (60.0, 18.0, 9.0, 2618.0)] {
        let disc = Disc { engagement: Some(f64::to_radians(limit)), step: 40.0, ..paper(inner) };
        let path = Clearing::ConstantEngagement(LensOrder::One).path(&disc).unwrap();
        assert_eq!(path.turns, turns);
        let found: f64 = path.curves.iter().map(PlaneCurve::length).sum();
        assert!((found - rounded).abs() < 0.5, "{found}");
    }
}

#[test]
fn each_path_is_a_chain_from_the_inner_circle_to_the_wall() {
    for clearing in ALL {
        for inner in [0.0, 0.3, 10.0, 18.0, 70.0] {
            if inner == 0.0 && matches!(clearing, Clearing::ConstantEngagement(_)) {
                continue;
            }
            for psi in [0.0, 2.5, -40.0] {
                let disc = Disc { psi, ..paper(inner) };
                let path = clearing.path(&disc).unwrap();
                let name = clearing.name();
                let wall = on_circle(disc.outer, psi);
                let start = path.curves[0].start();
                assert!((start - on_circle(inner, psi)).length() < 1e-10, "{name} {inner} {start}");
                let end = path.curves[path.curves.len() - 1].end();
                assert!((end - wall).length() < 1e-10, "{name} {inner} {end} {wall}");
                assert!((path.closing.start() - wall).length() < 1e-12);
                assert!(path.curves.iter().all(|c| c.length() > 0.0));
                for pair in path.curves.windows(2) {
                    assert!((pair[0].end() - pair[1].start()).length() < 1e-10, "{name} {inner}");
                }
                assert!(path.step <= disc.step * (1.0 + 1e-12), "{name} {inner}");
            }
        }
    }
}

#[test]
fn the_contact_of_each_strategy_is_the_one_it_has_in_the_books() {
    for (clearing, at_wall, inside) in [
        (Clearing::Involute, ContactOrder::G2, ContactOrder::Smooth),
        (Clearing::Lens(LensOrder::Zero), ContactOrder::G2, ContactOrder::Smooth),
        (Clearing::Lens(LensOrder::One), ContactOrder::G4, ContactOrder::Smooth),
        (Clearing::Lens(LensOrder::Two), ContactOrder::G6, ContactOrder::Smooth),
        (Clearing::ConstantEngagement(LensOrder::Zero), ContactOrder::G2, ContactOrder::G2),
        (Clearing::ConstantEngagement(LensOrder::One), ContactOrder::G4, ContactOrder::G4),
        (Clearing::ConstantEngagement(LensOrder::Two), ContactOrder::G6, ContactOrder::G6),
        (Clearing::Poles(2), ContactOrder::G1, ContactOrder::G1),
        (Clearing::Poles(4), ContactOrder::G1, ContactOrder::G1),
        (Clearing::Archimedes, ContactOrder::G0, ContactOrder::Smooth),
        (Clearing::RingsRadial, ContactOrder::G0, ContactOrder::G0),
        (Clearing::RingsTangent, ContactOrder::G1, ContactOrder::G1),
        (Clearing::Trochoid, ContactOrder::G1, ContactOrder::Smooth),
    ] {
        for inner in [0.0, 10.0] {
            let name = clearing.name();
            let Ok(path) = clearing.path(&paper(inner)) else {
                assert!(inner == 0.0 && matches!(clearing, Clearing::ConstantEngagement(_)), "{name}");
                continue;
            };
            let curves = in_space(&path);
            let joints: Vec<ContactOrder> = curves.windows(2).map(|p| joint(&p[0], &p[1]).contact).collect();
            let (last, before) = joints.split_last().unwrap();
            assert_eq!(*last, at_wall, "{name} {inner}");
            assert!(before.iter().all(|c| *c == inside), "{name} {inner} {before:?}");
            // The closing circle ends where it began.
            let back = joint(&curves[curves.len() - 1], &curves[curves.len() - 1]);
            assert_eq!(back.contact, ContactOrder::Smooth);
        }
    }
}

/// Whether each point of a polar grid lies within the cutter's radius of a point of the path, or in the starting
/// circle's disc; the path's points are so dense that `slack` [mm] holds their scallops.
fn uncovered(path: &Cleared, disc: &Disc, slack: f64) -> Option<DVec2> {
    let spacing = (8.0 * disc.cutter * slack).sqrt();
    let mut points: Vec<DVec2> = vec![path.curves[0].start()];
    for curve in in_space(path) {
        let chords = curve.polyline(slack);
        points.extend(chords.windows(2).flat_map(|p| {
            let n = ((p[1] - p[0]).length() / spacing).ceil().max(1.0);
            let pair = [p[0], p[1]];
            (1..=n as u32).map(move |i| pair[0].lerp(pair[1], f64::from(i) / n).truncate())
        }));
    }
    // Cells of a cutter radius.
    let reach = disc.cutter + slack;
    let half = disc.outer + disc.cutter;
    let n = (2.0 * half / reach).ceil() as usize + 1;
    let cell = |p: DVec2| (((p.x + half) / reach) as usize, ((p.y + half) / reach) as usize);
    let mut cells = vec![Vec::new(); (n + 1) * (n + 1)];
    for p in points {
        let (c, r) = cell(p);
        cells[r * (n + 1) + c].push(p);
    }
    let rings = 50;
    (1..=rings)
        .flat_map(|i| (0..48).map(move |j| (i, j)))
        .map(|(i, j)| {
            let radius = (half - 4.0 * slack) * f64::from(i) / f64::from(rings);
            DVec2::from_angle(TAU * (f64::from(j) + 0.37) / 48.0) * radius
        })
        .find(|p| {
            if disc.inner > 0.0
                && p.length() <= disc.inner + disc.cutter
                && p.length() >= disc.inner - disc.cutter
            {
                return false;
            }
            let (c, r) = cell(*p);
            !(r.saturating_sub(1)..=(r + 1).min(n)).any(|row| {
                (c.saturating_sub(1)..=(c + 1).min(n)).any(|column| {
                    cells[row * (n + 1) + column].iter().any(|q: &DVec2| (*q - *p).length() < reach)
                })
            })
        })
}

#[test]
fn each_path_clears_the_whole_disc() {
    for clearing in ALL {
        for (inner, step) in [(0.0, 38.0), (19.0, 39.0), (12.0, 25.0)] {
            let disc = Disc { step, psi: 1.0, engagement: Some(1.9), ..paper(inner) };
            let Ok(path) = clearing.path(&disc) else { continue };
            assert_eq!(uncovered(&path, &disc, 0.1), None, "{} {inner} {step}", clearing.name());
            // The measure sees what a smaller cutter would leave.
            let smaller = Disc { cutter: 0.4 * path.step, ..disc };
            let seen = uncovered(&path, &smaller, 0.1).is_some();
            assert!(seen || clearing == Clearing::Trochoid, "{} {inner} {step}", clearing.name());
        }
    }
}

/// Largest engagement on each turn of a path that starts with the full inner circle, by brute force [deg].
fn engaged(disc: &Disc, path: &Cleared, looks: usize) -> Vec<f64> {
    let first = PlaneCurve::from(InvoluteRecord::circle(disc.inner, disc.psi).unwrap());
    let mut curves = vec![first];
    curves.extend(&path.curves);
    let count = ((path.turns + 1.0) * looks as f64) as usize;
    let samples =
        crate::holes::engagement(&curves, disc.cutter, Some(disc.inner + disc.cutter), count).unwrap();
    let mut at = first.length();
    let mut found = Vec::new();
    for curve in &path.curves {
        let whole = curve.turn() / TAU;
        let n = whole.round() as u32;
        for i in 1..=n {
            let end = match curve {
                PlaneCurve::Spiral(s) => s.length_to(TAU * f64::from(i)),
                PlaneCurve::Record(r) => r.length_at_turn(TAU * f64::from(i)),
            };
            let from = match curve {
                PlaneCurve::Spiral(s) => s.length_to(TAU * f64::from(i - 1)),
                PlaneCurve::Record(r) => r.length_at_turn(TAU * f64::from(i - 1)),
            };
            let on = samples.iter().filter(|s| s.s >= at + from && s.s <= at + end);
            found.push(on.map(|s| s.angle).fold(0.0, f64::max).to_degrees());
        }
        at += curve.length();
    }
    found
}

fn kept_within(disc: &Disc, order: LensOrder, below: f64) {
    let limit = disc.engagement.unwrap().to_degrees();
    let path = Clearing::ConstantEngagement(order).path(disc).unwrap();
    assert!(path.step <= disc.step * (1.0 + 1e-9), "{disc:?} {}", path.step);
    let kept = path.engagement.unwrap().to_degrees();
    let found = engaged(disc, &path, 48);
    assert!(found.iter().all(|e| *e <= limit + 0.5), "{disc:?} {order:?} {found:?}");
    // On the turns of constant engagement; the step alone binds on the others.
    if let PlaneCurve::Spiral(s) = path.curves[0]
        && let crate::geom::SpiralLaw::Support(crate::geom::Support::ConstantEngagement(_)) = s.law()
    {
        let turns = (s.parameters()[1] / TAU).round() as usize;
        let low = found[..turns].iter().copied().fold(f64::INFINITY, f64::min);
        assert!(low >= kept - below, "{disc:?} {order:?} kept {kept} {found:?}");
    }
}

#[test]
fn the_engagement_is_kept_by_brute_force() {
    use LensOrder::{One, Two, Zero};
    // Free steps: within 5 degrees below the angle kept, and near it where the starting circle is not small.
    for (inner, outer, cutter, limit, order, below) in [
        (10.0, 79.0, 20.0, 60.0, One, 2.5),
        (18.0, 79.0, 20.0, 60.0, Zero, 1.5),
        (18.0, 79.0, 20.0, 45.0, Two, 1.0),
        (30.0, 79.0, 8.0, 90.0, One, 1.0),
        (18.0, 150.0, 40.0, 75.0, One, 3.0),
        (6.0, 40.0, 20.0, 30.0, One, 1.0),
        (3.0, 12.0, 8.0, 60.0, Two, 5.0),
        (60.0, 79.0, 8.0, 60.0, One, 0.5),
    ] {
        let disc = Disc {
            outer,
            cutter,
            step: 2.0 * cutter,
            engagement: Some(f64::to_radians(limit)),
            psi: 0.7,
            ..paper(inner)
        };
        kept_within(&disc, order, below);
    }
    // With the step as a cap, of a few parts, and one where the cap binds next to a small starting circle.
    for (inner, outer, cutter, limit, step, below) in [
        (10.0, 79.0, 20.0, 60.0, 4.0, 5.0),
        (18.0, 79.0, 20.0, 45.0, 4.0, 1.0),
        (18.0, 150.0, 20.0, 60.0, 7.5, 3.0),
        (1.0, 40.0, 40.0, 75.0, 8.0, 12.0),
        (19.0, 60.0, 20.0, 60.0, 1.0, 0.0),
    ] {
        let disc = Disc { outer, cutter, step, engagement: Some(f64::to_radians(limit)), ..paper(inner) };
        kept_within(&disc, LensOrder::One, below);
    }
}

#[test]
fn the_exact_engagement_of_turns_is_that_of_brute_force() {
    let disc = Disc { step: 5.0, ..paper(6.0) };
    let path = Clearing::Lens(LensOrder::One).path(&disc).unwrap();
    let PlaneCurve::Spiral(spiral) = path.curves[0] else { panic!("a spiral") };
    let crate::geom::SpiralLaw::Support(support) = *spiral.law() else { panic!("a support curve") };
    let turns = super::turns::Turns { inner: 6.0, parts: &[(support, path.turns)] };
    let first = InvoluteRecord::circle(6.0, 0.0).unwrap();
    for theta in [1.0, 3.0, 5.0, 8.0, 12.0, 30.0, 60.0] {
        let part = spiral.between(0.0, theta);
        let samples =
            crate::holes::engagement(&[PlaneCurve::from(first), part.into()], 20.0, Some(26.0), 2).unwrap();
        let (brute, exact) = (samples[samples.len() - 1].angle, turns.engagement(20.0, theta));
        assert!((brute - exact).abs().to_degrees() < 0.1, "{theta} {brute} {exact}");
    }
}

#[test]
fn numbers_that_give_no_path_are_refused_with_a_help() {
    use crate::base::Code;
    let even = Clearing::ConstantEngagement(LensOrder::One);
    let limit = |degrees: f64| Disc { engagement: Some(degrees.to_radians()), ..paper(10.0) };
    for (clearing, disc, word) in [
        (even, paper(0.0), "helix"),
        (even, Disc { engagement: None, ..paper(10.0) }, "largest engagement angle"),
        (even, limit(0.0), "60 deg"),
        (even, limit(180.0), "60 deg"),
        (even, limit(f64::NAN), "60 deg"),
        (even, limit(0.01), "larger step or engagement"),
        (Clearing::Poles(1), paper(0.0), "semicircles"),
        (Clearing::Poles(u32::MAX), paper(0.0), "units"),
        (Clearing::Trochoid, Disc { step: 1e-3, ..paper(0.0) }, "units"),
        (Clearing::Archimedes, Disc { step: 41.0, ..paper(0.0) }, "between the turns"),
        (Clearing::Archimedes, Disc { step: 0.0, ..paper(0.0) }, "positive step"),
        (Clearing::RingsRadial, Disc { step: 1e-6, ..paper(0.0) }, "units"),
        (Clearing::RingsTangent, paper(79.0), "smaller circle"),
        (Clearing::Lens(LensOrder::One), Disc { psi: f64::INFINITY, ..paper(0.0) }, ""),
        (Clearing::Lens(LensOrder::One), Disc { cutter: f64::NAN, ..paper(0.0) }, ""),
    ] {
        let e = clearing.path(&disc).unwrap_err();
        assert_eq!(e.code(), Code::PLAN_VALUE, "{} {disc:?}", clearing.name());
        assert!(e.0.value.is_some() || e.0.help.contains(word), "{} {disc:?}", clearing.name());
        assert!(e.0.help.contains(word), "{} {disc:?}: {}", clearing.name(), e.0.help);
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(24))]
    #[test]
    fn turned_and_scaled_holes_have_turned_and_scaled_paths(
        which in 0..ALL.len(), inner in 0.02..0.9f64, psi in -7.0..7.0f64, scale in 0.05..20.0f64,
    ) {
        let clearing = ALL[which];
        let disc = paper(79.0 * inner);
        let other = Disc {
            inner: disc.inner * scale,
            inner_most: disc.inner_most * scale,
            outer: disc.outer * scale,
            cutter: disc.cutter * scale,
            step: disc.step * scale,
            psi,
            ..disc
        };
        let (a, b) = (clearing.path(&disc).unwrap(), clearing.path(&other).unwrap());
        // An arc on the starting circle may be there or not, as psi happens to lie.
        let shared = a.curves.len().min(b.curves.len());
        let tail = |p: &Cleared| p.curves[p.curves.len() - shared..].to_vec();
        prop_assert!((length(&b) / (length(&a) * scale) - 1.0).abs() < 1e-9);
        for (x, y) in tail(&a).iter().zip(tail(&b)) {
            for share in [0.0, 0.3, 0.77, 1.0] {
                let p = DVec2::from_angle(psi).rotate(x.at(share * x.length()).p) * scale;
                let q = y.at(share * y.length()).p;
                prop_assert!((p - q).length() < 1e-7 * scale * disc.outer, "{} {p} {q}", clearing.name());
            }
        }
    }
}
