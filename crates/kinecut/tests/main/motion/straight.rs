//! Straight moves from rest to rest: the closed form against phases found by bisection, the law against the closed form.

use kinecut::motion::{AxisLimit, SCurve, TimeLaw};
use kinecut_cases::cases;

use super::courses::{Planar, USUAL};
use crate::common::random::Random;

/// Phases of constant jerk: time and jerk of each.
type Phases = [(f64, f64); 7];

/// Way, speed and acceleration at a moment of these phases from rest, stepped through.
fn stepped(phases: &Phases, time: f64) -> [f64; 3] {
    let ([mut way, mut velocity, mut acceleration], mut left) = ([0.0; 3], time);
    for (long, jerk) in phases {
        let t = left.min(*long);
        way += t * (velocity + t * (0.5 * acceleration + t * jerk / 6.0));
        velocity += t * (acceleration + 0.5 * t * jerk);
        acceleration += t * jerk;
        left -= t;
    }
    [way, velocity, acceleration]
}

/// The phases of a move that reaches this speed and keeps it for some time.
fn phases(speed: f64, cruise: f64, limit: AxisLimit) -> Phases {
    // Half of the speed is gained while jerk builds the acceleration up, unless that gets to its limit before.
    let jerking = (speed / limit.jerk).sqrt().min(limit.acceleration / limit.jerk);
    let steady = (speed / (limit.jerk * jerking) - jerking).max(0.0);
    let (up, down) = ((jerking, limit.jerk), (jerking, -limit.jerk));
    [up, (steady, 0.0), down, (cruise, 0.0), down, (steady, 0.0), up]
}

/// The fastest phases over a length: the largest speed whose ramps fit, by bisection.
fn fastest(length: f64, limit: AxisLimit) -> Phases {
    let way = |speed: f64| {
        let phases = phases(speed, 0.0, limit);
        stepped(&phases, phases.iter().map(|p| p.0).sum())[0]
    };
    let full = way(limit.velocity);
    if full <= length {
        return phases(limit.velocity, (length - full) / limit.velocity, limit);
    }
    // By the logarithm: lengths lie many decades apart.
    let (mut low, mut high) = (limit.velocity.ln() - 200.0, limit.velocity.ln());
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if way(middle.exp()) < length {
            low = middle;
        } else {
            high = middle;
        }
    }
    phases(low.exp(), 0.0, limit)
}

fn power(random: &mut Random, low: f64, high: f64) -> f64 {
    10f64.powf(random.between(low, high))
}

#[test]
fn the_closed_form_is_the_fastest_of_seven_phases() {
    let mut random = Random(11);
    for case in 0..cases(2000, 200_000) {
        let limit = AxisLimit {
            velocity: power(&mut random, -3.0, 5.0),
            acceleration: power(&mut random, -2.0, 7.0),
            jerk: power(&mut random, -1.0, 9.0),
        };
        let length = power(&mut random, -9.0, 6.0);
        let (curve, phases) = (SCurve::new(length, limit), fastest(length, limit));
        let total: f64 = phases.iter().map(|p| p.0).sum();
        let what = || format!("case {case}: {length} {limit:?}");
        assert!((curve.duration() / total - 1.0).abs() < 1e-9, "{} {total} {}", curve.duration(), what());
        let peak = phases[0].0 * limit.jerk * (phases[0].0 + phases[1].0);
        assert!((curve.peak() / peak - 1.0).abs() < 1e-9, "{} {peak} {}", curve.peak(), what());
        assert!(curve.peak() <= limit.velocity * (1.0 + 1e-12), "{}", what());
        let mut before = curve.at(0.0);
        assert_eq!((before.way, before.velocity), (0.0, 0.0));
        for i in 0..=40 {
            let t = curve.duration() * f64::from(i) / 40.0;
            let at = curve.at(t);
            let [way, velocity, acceleration] = stepped(&phases, t);
            assert!((at.way - way).abs() <= 1e-8 * length, "{i} {at:?} {way} {}", what());
            // Where phases are far shorter than the move, moments are rounded by a part of them.
            let most = 1e-8 * peak + 4.0 * f64::EPSILON * total * limit.acceleration;
            assert!((at.velocity - velocity).abs() <= most, "{i} {at:?} {velocity} {}", what());
            let most = 1e-7 * phases[0].0 * limit.jerk + 4.0 * f64::EPSILON * total * limit.jerk;
            assert!((at.acceleration - acceleration).abs() <= most, "{i} {at:?} {acceleration} {}", what());
            assert!(at.velocity.abs() <= limit.velocity * (1.0 + 1e-12), "{i} {at:?} {}", what());
            assert!(at.acceleration.abs() <= limit.acceleration * (1.0 + 1e-12), "{i} {at:?} {}", what());
            assert!(at.jerk.abs() <= limit.jerk, "{i} {at:?} {}", what());
            assert!(at.way >= before.way, "{i} {at:?} {}", what());
            before = at;
        }
        assert!((before.way / length - 1.0).abs() < 1e-12, "{}", what());
    }
}

/// Speed and way are integrals of the acceleration, by the midpoint rule over small steps.
#[test]
fn way_and_speed_are_integrals_of_the_acceleration_and_nothing_jumps() {
    let mut random = Random(12);
    for case in 0..40 {
        let limit = AxisLimit {
            velocity: power(&mut random, 1.0, 3.0),
            acceleration: power(&mut random, 2.0, 4.0),
            jerk: if case % 4 == 0 { f64::INFINITY } else { power(&mut random, 3.0, 6.0) },
        };
        let length = power(&mut random, -2.0, 3.0);
        let curve = SCurve::new(length, limit);
        let steps = 20_000;
        let h = curve.duration() / f64::from(steps);
        let (mut way, mut velocity) = (0.0, 0.0);
        let mut before = curve.at(0.0);
        for i in 1..=steps {
            let half = curve.at((f64::from(i) - 0.5) * h);
            let at = curve.at(f64::from(i) * h);
            way += h * (velocity + 0.5 * h * half.acceleration);
            velocity += h * half.acceleration;
            let what = || format!("case {case} step {i}: {at:?} after {before:?}, {limit:?}");
            assert!((at.way - before.way).abs() <= h * limit.velocity * (1.0 + 1e-9), "{}", what());
            assert!(
                (at.velocity - before.velocity).abs() <= h * limit.acceleration * (1.0 + 1e-6),
                "{}",
                what()
            );
            if limit.jerk.is_finite() {
                let most = h * limit.jerk * (1.0 + 1e-6) + 1e-9 * limit.acceleration;
                assert!((at.acceleration - before.acceleration).abs() <= most, "{}", what());
            }
            // The rule is off by a step in which the acceleration jumps or bends.
            let off = 2.0 * h * limit.acceleration + 1e-9 * curve.peak();
            assert!((at.velocity - velocity).abs() < off, "{velocity} {}", what());
            assert!((at.way - way).abs() < off * curve.duration(), "{way} {}", what());
            before = at;
        }
    }
}

#[test]
fn without_a_jerk_limit_the_closed_form_is_the_trapezoid() {
    let mut random = Random(13);
    for _ in 0..2000 {
        let (v, a) = (power(&mut random, -3.0, 5.0), power(&mut random, -2.0, 7.0));
        let limit = AxisLimit { velocity: v, acceleration: a, jerk: f64::INFINITY };
        let length = power(&mut random, -9.0, 6.0);
        let expected = if length < v * v / a { 2.0 * (length / a).sqrt() } else { length / v + v / a };
        let curve = SCurve::new(length, limit);
        assert!((curve.duration() / expected - 1.0).abs() < 1e-12, "{length} {limit:?}");
        assert!((curve.peak() / v.min((a * length).sqrt()) - 1.0).abs() < 1e-12, "{length} {limit:?}");
        let at = curve.at(0.25 * curve.duration());
        let ramp = curve.peak() / a;
        let (t, peak) = (0.25 * expected, curve.peak());
        let (way, speed) = if t < ramp { (0.5 * a * t * t, a * t) } else { (peak * (t - 0.5 * ramp), peak) };
        assert!((at.way / way - 1.0).abs() < 1e-9, "{at:?} {way}");
        assert!((at.velocity / speed - 1.0).abs() < 1e-9, "{at:?} {speed}");
        // The limit of ever larger jerks.
        let limited = SCurve::new(length, AxisLimit { jerk: 1e9 * a / expected, ..limit });
        assert!((limited.duration() / expected - 1.0).abs() < 1e-8, "{length} {limit:?}");
    }
}

#[test]
fn no_length_takes_no_time() {
    let curve = SCurve::new(0.0, USUAL);
    assert_eq!((curve.duration(), curve.peak(), curve.at(0.1).way), (0.0, 0.0, 0.0));
}

#[test]
fn the_law_of_a_straight_leg_is_hardly_slower_than_the_closed_form_and_never_faster() {
    // Cells are as fine as the way to the feed asks for: a leg that is over before is coarser, and the closed form times it.
    let legs =
        [(0.5, [8.5e-3, 9e-3]), (5.0, [7e-3, 8.5e-3]), (100.0, [1.2e-3, 6.5e-3]), (1000.0, [1.2e-3; 2])];
    for (i, feed) in [100.0, 500.0].into_iter().enumerate() {
        for (length, within) in legs {
            let within = within[i];
            for heading in [0.0_f64, 0.7, 2.5] {
                let course = Planar::straight(length, heading, feed);
                // The parameter may do what the axis that binds first allows.
                let most = heading.cos().abs().max(heading.sin().abs());
                let along = AxisLimit {
                    velocity: feed.min(USUAL.velocity / most),
                    acceleration: USUAL.acceleration / most,
                    jerk: USUAL.jerk / most,
                };
                let exact = SCurve::new(length, along).duration();
                let law = TimeLaw::new(&course, &[USUAL; 2]).unwrap();
                let slower = law.duration() / exact - 1.0;
                let what = format!("{length} mm at {feed} mm/s, heading {heading}: {slower}");
                assert!(slower >= -1e-9 && slower <= within, "{what}");
                let free = SCurve::new(length, AxisLimit { jerk: f64::INFINITY, ..along }).duration();
                assert!((law.without_jerk() / free - 1.0).abs() < 2e-3, "{what}: {}", law.without_jerk());
            }
        }
    }
}
