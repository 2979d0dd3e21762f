//! The chain against the exact curve, sampled densely, and its counts against the closed form.

use std::f64::consts::TAU;

use super::*;
use crate::geom::{
    ConstantEngagement, InvoluteRecord, LensOrder, RiseShape, SpiralLaw, Support, biarcs_needed,
};

/// Spirals of the kinds that a bore has.
fn spirals() -> Vec<Spiral> {
    let r = 69.0 / (20.0 * TAU);
    let mut all = Vec::new();
    for order in [LensOrder::One, LensOrder::Two] {
        let law = Support::Lens { inner: 10.0, base_radius: r, order };
        all.push(Spiral::new(law.into(), 0.0, 20.0 * TAU).unwrap());
        let from_centre = Support::Lens { inner: 0.0, base_radius: 79.0 / (20.0 * TAU), order };
        all.push(Spiral::new(from_centre.into(), 0.0, 20.0 * TAU).unwrap());
    }
    let engaged = ConstantEngagement::new(5.0, 40.0, 5.0, 1.2, LensOrder::One);
    let turns = engaged.turns();
    all.push(Spiral::new(Support::ConstantEngagement(engaged).into(), 0.0, turns * TAU).unwrap());
    let morph = Support::Morph {
        inner: 5.0,
        half_axes: [50.0, 30.0],
        offset: 6.0,
        turns: 9.0,
        order: LensOrder::One,
    };
    all.push(Spiral::new(morph.into(), 0.0, 9.0 * TAU).unwrap());
    all.push(Spiral::new(SpiralLaw::Archimedes { growth: 0.5 }, 0.0, 12.0 * TAU).unwrap());
    // Loops that turn back, and waves with inflections.
    all.push(
        Spiral::new(SpiralLaw::Trochoid { carrier: 20.0, loop_radius: 3.0, rate: 25.0 }, 0.0, TAU).unwrap(),
    );
    all.push(
        Spiral::new(SpiralLaw::Trochoid { carrier: 20.0, loop_radius: 0.5, rate: 25.0 }, 0.0, TAU).unwrap(),
    );
    all
}

/// Distance of a point from a piece in its plane, with its ends.
fn off(arc: &PlanarArc, p: DVec2) -> f64 {
    // The nearest point of the circle if it lies on the arc, otherwise an end.
    let ends = (p - arc.start).length().min((p - arc.end).length());
    if arc.is_line() {
        let d = arc.end - arc.start;
        let t = (p - arc.start).dot(d) / d.length_squared();
        return if (0.0..=1.0).contains(&t) { (p - arc.start - d * t).length() } else { ends };
    }
    let (a, b) = (arc.start - arc.centre, p - arc.centre);
    let turned = a.angle_to(b) * arc.sweep.signum();
    let turned = if turned < 0.0 { turned + TAU } else { turned };
    if turned <= arc.sweep.abs() { (b.length() - a.length()).abs() } else { ends }
}

/// Largest distance of the curve from the chain, by dense points, each against the pieces near it.
fn worst(spiral: &Spiral, pieces: &[PlanarArc], per_piece: usize) -> f64 {
    let [from, to] = spiral.parameters();
    let n = pieces.len() * per_piece;
    let mut at = 0;
    (0..=n).fold(0.0, |worst: f64, i| {
        let p = spiral.point(from + (to - from) * i as f64 / n as f64);
        let window =
            |k: usize| (k.saturating_sub(2)..(k + 6).min(pieces.len())).map(|j| (off(&pieces[j], p), j));
        let (d, j) = window(at).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        at = j;
        worst.max(d)
    })
}

#[test]
fn chains_of_spirals_keep_the_tolerance_and_use_it() {
    for spiral in spirals() {
        for placed in
            [spiral, spiral.reversed(), spiral.mirrored().rotated(1.0).shifted(DVec2::new(30.0, -20.0))]
        {
            for tolerance in [0.01, 0.0005] {
                let pieces = arcs_along(&placed.into(), tolerance).unwrap();
                assert_eq!(pieces[0].start, placed.start());
                assert_eq!(pieces[pieces.len() - 1].end, placed.end());
                for pair in pieces.windows(2) {
                    assert_eq!(pair[0].end, pair[1].start);
                    // Tangents at the joint.
                    let t = |a: &PlanarArc, p: DVec2| (p - a.centre).perp() * a.sweep.signum();
                    if !pair[0].is_line() && !pair[1].is_line() {
                        let angle = t(&pair[0], pair[0].end).angle_to(t(&pair[1], pair[1].start));
                        assert!(angle.abs() < 1e-6, "{angle} {pair:?}");
                    }
                }
                let error = worst(&placed, &pieces, 11);
                assert!(error <= tolerance, "{error} {} pieces {:?}", pieces.len(), placed.law());
                // A coarse tolerance is not used up if the turn of a biarc is the limit.
                assert!(
                    error >= 0.6 * tolerance || tolerance > 0.005,
                    "{error} wastes the tolerance {tolerance}"
                );
            }
        }
    }
}

/// An involute as a walk, to compare with the closed count.
struct Walked(InvoluteRecord);

impl Walk for Walked {
    fn ends(&self) -> [f64; 2] {
        [0.0, self.0.turn(self.0.length())]
    }

    fn at(&self, u: f64) -> (DVec2, DVec2) {
        let jet = self.0.at(InvoluteRecord::length_at_turn(&self.0, u));
        (jet.p, jet.d1)
    }

    fn length(&self, a: f64, b: f64) -> f64 {
        InvoluteRecord::length_at_turn(&self.0, b) - InvoluteRecord::length_at_turn(&self.0, a)
    }
}

#[test]
fn the_chain_of_an_involute_has_nearly_the_least_number_of_biarcs() {
    let record = InvoluteRecord::new(4963.71639267187, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
    let biarcs = biarcs_needed(record.base_radius(), record.turn(record.length()), 0.001) as usize;
    let least = 2 * biarcs;
    let found = chain(&Walked(record), &Rise::NONE, 0.001).unwrap().len();
    assert!(found >= least && found <= least * 12 / 10, "{found} {least}");
}

#[test]
fn the_height_of_a_rising_spiral_is_kept() {
    let spiral = spirals()[0];
    for shape in [RiseShape::Even, RiseShape::Smooth, RiseShape::FadeOut] {
        let rise = Rise::new(shape, -30.0);
        let tolerance = 0.001;
        let pieces = helices_along(&spiral, 5.0, &rise, tolerance).unwrap();
        let exact = Curve::spiral(spiral, 5.0, rise);
        assert_eq!(pieces[pieces.len() - 1].end().z, exact.end().z);
        let total: f64 = pieces.iter().map(Curve::length).sum();
        assert!((total - exact.length()).abs() < 1e-3 * exact.length());
        // Heights at the nearest points: both advance together along the plane curve.
        let mut s = 0.0;
        let plane = |c: &Curve| (c.length().powi(2) - (c.end().z - c.start().z).powi(2)).sqrt();
        let whole: f64 = pieces.iter().map(plane).sum();
        for piece in &pieces {
            for k in 0..4 {
                let f = f64::from(k) / 4.0;
                let at = (s + plane(piece) * f) / whole;
                let z = piece.at(piece.length() * f).p.z;
                assert!(
                    (z - 5.0 - rise.at(at)).abs() < 3.0 * tolerance,
                    "{shape:?} {z} {}",
                    5.0 + rise.at(at)
                );
            }
            s += plane(piece);
        }
    }
}

#[test]
fn bad_tolerances_are_refused() {
    let spiral = spirals()[0];
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
        assert!(arcs_along(&spiral.into(), bad).is_err(), "{bad}");
    }
}
