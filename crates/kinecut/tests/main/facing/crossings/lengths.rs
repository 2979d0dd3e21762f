//! The lengths that teeth leave, against the limit of many teeth; properties of the limit with arcs.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;
use kinecut::facing::{
    BadPart, BadSet, FaceCase, Placement, Sweep, ToothedPass, bad_length, bad_stretches, toothed_lengths,
};
use kinecut::geom::{Outline, OutlineEdge};
use proptest::prelude::*;

use super::shapes::{bracket_with_bore, outlines, slot};

fn limit(case: &FaceCase, placement: Placement, sweep: Sweep, rho: f64) -> f64 {
    let mut sum = 0.0;
    for (edge, weight) in case.outline.edges().iter().zip(&case.weights) {
        bad_stretches(edge, case, placement, sweep, rho, |b| {
            sum += (b.to - b.from) * b.weight * edge.length() * weight;
        });
    }
    sum
}

fn case(outline: Outline, radius: f64, threshold_deg: f64) -> FaceCase {
    FaceCase::new(outline, radius, BadSet::below(threshold_deg.to_radians()).unwrap()).unwrap()
}

/// A placement that covers the whole outline, the offset at a share of its range.
fn covering(case: &FaceCase, angle: f64, share: f64) -> Placement {
    let [low, high] = case.offsets(angle, 0.02 * case.radius);
    assert!(low < high);
    Placement { angle, offset: low + share * (high - low) }
}

/// Bad length by points along each edge: exit angles from the velocity of a tooth that is there.
fn by_points(case: &FaceCase, placement: Placement, sweep: Sweep, rho: f64, n: usize) -> f64 {
    let mut sum = 0.0;
    let moved = case.outline.moved(placement.angle, DVec2::new(0.0, -placement.offset));
    for (edge, weight) in moved.edges().iter().zip(&case.weights) {
        for i in 0..n {
            let s = (i as f64 + 0.5) / n as f64;
            let cos = -edge.at(s).y / case.radius;
            if cos.abs() >= 1.0 {
                continue;
            }
            let tau = if sweep == Sweep::Front { TAU - cos.acos() } else { cos.acos() };
            let velocity = DVec2::new(rho - tau.cos(), tau.sin());
            let psi = DVec2::from_angle(edge.heading(s)).angle_to(velocity);
            sum += case.bad.weight(psi) * edge.length() / n as f64 * weight;
        }
    }
    sum
}

proptest! {
    #![proptest_config(kinecut_cases::property(64))]

    #[test]
    fn the_limit_is_what_points_say(
        outline in outlines(),
        angle in 0.0..TAU,
        share in -0.3..1.3f64,
        rho in prop_oneof![Just(0.0), 0.001..0.4],
        threshold in 20.0..170.0f64,
        back in any::<bool>(),
    ) {
        let radius = 0.5 * outline.perimeter();
        let case = case(outline, radius.min(90.0), threshold);
        let placement = covering(&case, angle, share);
        let sweep = if back { Sweep::Back } else { Sweep::Front };
        let n = 2000;
        let (have, want) = (limit(&case, placement, sweep, rho), by_points(&case, placement, sweep, rho, n));
        // Each edge may err by a point at each end of its bad stretches.
        let longest = case.outline.edges().iter().map(OutlineEdge::length).fold(0.0, f64::max);
        let most = 8.0 * longest / n as f64 * case.outline.edges().len() as f64;
        prop_assert!((have - want).abs() < most, "{have} against {want}");
    }

    #[test]
    fn the_limit_does_not_know_how_the_outline_is_written(
        outline in outlines(),
        angle in 0.0..TAU,
        share in 0.0..1.0f64,
        rho in prop_oneof![Just(0.0), 0.001..0.2],
        at in 0.1..0.9f64,
    ) {
        let one = case(outline.clone(), 90.0, 75.0);
        let placement = covering(&one, angle, share);
        let value = limit(&one, placement, Sweep::Front, rho);
        let mut loops: Vec<Vec<OutlineEdge>> =
            outline.loops().iter().map(|l| outline.edges()[l.edges.clone()].to_vec()).collect();
        for edges in &mut loops {
            let first = edges.remove(0);
            edges.extend(split(first, at));
            edges.rotate_left(1);
        }
        loops.reverse();
        let other = case(Outline::new(loops, vec![]).unwrap(), 90.0, 75.0);
        let again = limit(&other, placement, Sweep::Front, rho);
        prop_assert!((value - again).abs() < 1e-9, "{value} {again}");
        let turned = Placement { angle: angle + TAU, ..placement };
        prop_assert!((value - limit(&one, turned, Sweep::Front, rho)).abs() < 1e-9);
    }

    #[test]
    fn the_limit_grows_with_threshold_and_guard(
        outline in outlines(),
        angle in 0.0..TAU,
        share in 0.0..1.0f64,
        rho in prop_oneof![Just(0.0), 0.001..0.2],
        threshold in 20.0..120.0f64,
        more in 0.1..40.0f64,
    ) {
        let one = case(outline, 90.0, threshold);
        let placement = covering(&one, angle, share);
        let value = limit(&one, placement, Sweep::Front, rho);
        let wider = FaceCase { bad: BadSet::below((threshold + more).to_radians()).unwrap(), ..one.clone() };
        prop_assert!(limit(&wider, placement, Sweep::Front, rho) >= value - 1e-9);
        let guarded = FaceCase { bad: one.bad.guarded(more.to_radians()), ..one.clone() };
        prop_assert!(limit(&guarded, placement, Sweep::Front, rho) >= value - 1e-9);
    }

    #[test]
    fn entries_and_exits_make_the_whole_outline(
        outline in outlines(),
        angle in 0.0..TAU,
        share in 0.0..1.0f64,
        rho in prop_oneof![Just(0.0), 0.001..0.02],
        back in any::<bool>(),
    ) {
        let one = FaceCase { bad: BadSet::below(PI).unwrap(), ..case(outline, 90.0, 75.0) };
        let placement = covering(&one, angle, share);
        let sweep = if back { Sweep::Back } else { Sweep::Front };
        let mut sums = [0.0; 2];
        for edge in one.outline.edges() {
            // What enters at an edge leaves at the same edge travelled the other way.
            for (sum, edge) in sums.iter_mut().zip([*edge, edge.reversed()]) {
                bad_stretches(&edge, &one, placement, sweep, rho, |b| *sum += (b.to - b.from) * edge.length());
            }
        }
        let perimeter = one.outline.perimeter();
        prop_assert!((sums[0] + sums[1] - perimeter).abs() < 1e-9 * perimeter, "{sums:?} of {perimeter}");
        let pass = ToothedPass::even(3, 90.0, 0.05, placement).unwrap();
        let teeth = toothed_lengths(&one, &pass, sweep).unwrap();
        let all = teeth.exits + teeth.entries + teeth.uncrossed;
        prop_assert!((all - perimeter).abs() < 1e-9 * perimeter);
        if teeth.uncrossed == 0.0 {
            prop_assert!((teeth.bad - teeth.exits).abs() < 1e-9);
        }
    }
}

/// An edge in two.
fn split(edge: OutlineEdge, at: f64) -> [OutlineEdge; 2] {
    match edge.turn {
        None => [OutlineEdge::line(edge.start, edge.at(at)), OutlineEdge::line(edge.at(at), edge.end)],
        Some(t) => [
            OutlineEdge::arc(t.centre, t.radius, t.from, at * t.sweep),
            OutlineEdge::arc(t.centre, t.radius, t.from + at * t.sweep, (1.0 - at) * t.sweep),
        ],
    }
}

/// Mean difference of the real teeth's length from the limit over placements.
fn mean_difference(outline: &Outline, feed_per_tooth: f64) -> f64 {
    let case = case(outline.clone(), 60.0, 90.0);
    let mut sum = 0.0;
    let n = 40;
    for i in 0..n {
        let share = f64::from(i * 7 % n) / f64::from(n);
        let placement = covering(&case, 0.1 + TAU * f64::from(i) / f64::from(n), share);
        let pass = ToothedPass::even(1, 60.0, feed_per_tooth, placement).unwrap();
        let teeth = toothed_lengths(&case, &pass, Sweep::Front).unwrap();
        sum += (teeth.bad - bad_length(&case, placement)).abs();
    }
    sum / f64::from(n)
}

#[test]
fn real_teeth_tend_to_the_limit_as_the_feed_falls() {
    for outline in [bracket_with_bore(), slot()] {
        let coarse = mean_difference(&outline, 0.64);
        let fine = mean_difference(&outline, 0.04);
        // At worst as the root of the feed: a fourth of a sixteenth; in the mean better.
        assert!(fine < 0.25 * coarse && fine > 0.0, "{coarse} {fine}");
        assert!(fine < 2e-3 * outline.perimeter(), "{fine}");
    }
}

#[test]
fn many_teeth_at_one_feed_tend_to_the_limit_of_their_trochoids() {
    for outline in [bracket_with_bore(), slot()] {
        let case = case(outline, 60.0, 70.0);
        for (angle, share) in [(0.4, 0.3), (1.9, 0.8), (3.0, 0.1), (5.1, 0.6)] {
            let placement = covering(&case, angle, share);
            // 2 mm per radian: the trochoid is far from a circle. A cell at a tangency is 0.8 mm long.
            let pass = ToothedPass::even(2000, 60.0, 2.0 * TAU / 2000.0, placement).unwrap();
            for sweep in [Sweep::Front, Sweep::Back] {
                let have = toothed_lengths(&case, &pass, sweep).unwrap().bad;
                let exact = limit(&case, placement, sweep, pass.rho(&case));
                assert!((have - exact).abs() < 0.4, "{angle} {sweep:?}: {have} against {exact}");
            }
        }
    }
}

#[test]
fn weights_of_edges_and_angles_multiply() {
    let parts = |a, b| {
        let part = |from: f64, to, weight| BadPart { from, to, weight };
        BadSet::new(vec![part(0.0, 0.7, a), part(0.7, FRAC_PI_2, b)]).unwrap()
    };
    let outline = bracket_with_bore();
    let n = outline.edges().len();
    let whole = |bad: BadSet, weights: Vec<f64>| {
        let case = FaceCase::new(outline.clone(), 60.0, bad).unwrap().with_weights(weights).unwrap();
        let pass = ToothedPass::even(2, 60.0, 0.1, covering(&case, 0.7, 0.4)).unwrap();
        toothed_lengths(&case, &pass, Sweep::Front).unwrap().bad
    };
    let even = vec![1.0; n];
    let (first, second) = (whole(parts(1.0, 0.0), even.clone()), whole(parts(0.0, 1.0), even.clone()));
    assert!(first > 1.0 && second > 1.0);
    assert!((whole(parts(3.0, 5.0), even) - 3.0 * first - 5.0 * second).abs() < 1e-9);
    let mut sum = 0.0;
    let mut weights = vec![0.0; n];
    for i in 0..n {
        weights.fill(0.0);
        weights[i] = 2.0;
        sum += whole(parts(1.0, 1.0), weights.clone());
    }
    assert!((sum - 2.0 * (first + second)).abs() < 1e-9);
}
