//! Random paths, limits and feeds: every limit holds, by two checks that share nothing with the law.

use kinecut::motion::{AxisLimit, Course, TimeLaw};
use kinecut_cases::cases;
use rayon::prelude::*;

use super::courses::Planar;
use crate::common::random::Random;

fn power(random: &mut Random, low: f64, high: f64) -> f64 {
    10f64.powf(random.between(low, high))
}

/// 3 to 30 pieces of 0.5 to 50 mm; curvature is continuous and changes either all the way or between arcs.
fn course(random: &mut Random) -> Planar {
    let count = 3 + random.below(28);
    // A tenth of the places are straight.
    let curvature = |random: &mut Random| {
        let size = power(random, -3.0, -0.2);
        if random.share() < 0.1 { 0.0 } else { size.copysign(random.unit()) }
    };
    let with_arcs = random.share() < 0.5;
    let mut pieces = Vec::new();
    let mut from = curvature(random);
    for i in 0..count {
        let length = random.between(0.5, 50.0);
        if with_arcs {
            pieces.push((length, [from; 2]));
            let to = curvature(random);
            if i + 1 < count {
                pieces.push((power(random, -1.3, 0.0), [from, to]));
            }
            from = to;
        } else {
            let to = curvature(random);
            pieces.push((length, [from, to]));
            from = to;
        }
    }
    Planar::pieces(random.between(-3.0, 3.0), &pieces, power(random, 0.7, 2.7))
}

fn limits(random: &mut Random) -> [AxisLimit; 2] {
    [0, 1].map(|_| AxisLimit {
        velocity: power(random, 1.0, 4.0),
        acceleration: power(random, 2.0, 5.0),
        jerk: power(random, 3.0, 6.0),
    })
}

/// Largest shares of feed and speed, of acceleration and of jerk.
type Shares = [f64; 3];

fn larger(a: Shares, b: Shares) -> Shares {
    [0, 1, 2].map(|i| a[i].max(b[i]))
}

/// Shares at a place, with the derivatives of the speed on this side of it.
fn shares_at(course: &Planar, limits: &[AxisLimit; 2], s: f64, [b, b1, b2]: [f64; 3]) -> Shares {
    let v = b.sqrt();
    let mut worst = [v / course.feed(s), 0.0, 0.0];
    for (q, limit) in course.derivatives(s).iter().zip(limits) {
        // The chain rule with dv/dt = b'/2 and d2v/dt2 = v b''/2.
        let (dv, ddv) = (0.5 * b1, 0.5 * v * b2);
        let velocity = q[0] * v;
        let acceleration = q[1] * v * v + q[0] * dv;
        let jerk = q[2] * v.powi(3) + 3.0 * q[1] * v * dv + q[0] * ddv;
        let here =
            [velocity / limit.velocity, acceleration / limit.acceleration, jerk / limit.jerk].map(f64::abs);
        worst = larger(worst, here);
    }
    worst
}

/// Largest shares at eight places of each cell and 20 of those at rest, and anywhere in them.
fn analytic(course: &Planar, limits: &[AxisLimit; 2], law: &TimeLaw, random: &mut Random) -> [Shares; 2] {
    let speed = law.speed();
    let (knots, length) = (speed.knots(), course.length());
    let mut worst = [[0.0; 3]; 2];
    let mut look = |kind: usize, s: f64| {
        worst[kind] = larger(worst[kind], shares_at(course, limits, s, speed.square(s)));
    };
    for pair in knots.windows(2) {
        let h = pair[1] - pair[0];
        // Beside the knots, where third derivatives step; as near as numbers tell the sides apart.
        let beside = (1e-9_f64).max(4.0 * f64::EPSILON * pair[1] / h);
        for i in 0..8 {
            look(0, pair[0] + h * (f64::from(i) / 7.0).clamp(beside, 1.0 - beside));
        }
        look(1, pair[0] + h * random.between(beside, 1.0 - beside));
    }
    let (first, last) = (knots[0], length - knots[knots.len() - 1]);
    for i in 1..=20 {
        let beside = 1.0 - 1e-9;
        look(0, first * f64::from(i) / 20.0 * beside);
        look(0, length - last * f64::from(i) / 20.0 * beside);
        look(1, first * random.share());
        look(1, length - last * random.share());
    }
    worst
}

/// Largest shares of differences of positions over steps of time. A difference is a mean of the derivative over its steps:
/// it can only be smaller than the largest one.
fn by_differences(course: &Planar, limits: &[AxisLimit; 2], law: &TimeLaw) -> Shares {
    let (duration, length) = (law.duration(), course.length());
    let jerk = limits[0].jerk.min(limits[1].jerk);
    // A millisecond, but 2000 to 200 000 steps, and none in which a place is rounded by more than 1e-5 of the jerk.
    let rounded = (8.0 * f64::EPSILON * length / (1e-5 * jerk)).cbrt();
    let step = 1e-3_f64.min(duration / 2000.0).max(duration / 200_000.0).max(rounded);
    let count = (duration / step) as usize;
    let places: Vec<f64> = (0..=count).map(|i| law.speed().place(i as f64 * step)).collect();
    let ways: Vec<[f64; 2]> = places.windows(2).map(|p| course.way(p[0], p[1])).collect();
    let mut worst = [0.0; 3];
    for w in ways.windows(3) {
        for (a, limit) in limits.iter().enumerate() {
            let [first, second, third] = [w[0][a], w[1][a], w[2][a]];
            let here = [
                first / step / limit.velocity,
                (second - first) / step.powi(2) / limit.acceleration,
                (third - 2.0 * second + first) / step.powi(3) / limit.jerk,
            ];
            worst = larger(worst, here.map(f64::abs));
        }
        worst[0] = worst[0].max(w[0][0].hypot(w[0][1]) / step / course.feed);
    }
    worst
}

/// The case of this number: what is wrong with it.
fn fault(number: u64) -> Option<String> {
    let mut random = Random(0x5eed ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let course = course(&mut random);
    let limits = limits(&mut random);
    let law = match TimeLaw::new(&course, &limits) {
        Ok(law) => law,
        Err(error) => return Some(error.to_string()),
    };
    let (duration, length) = (law.duration(), course.length());
    let [checked, between] = analytic(&course, &limits, &law, &mut random);
    let differences = by_differences(&course, &limits, &law);
    let mut moments = 0.0_f64;
    for _ in 0..50 {
        let time = duration * random.between(1e-3, 1.0 - 1e-3);
        let place = law.speed().place(time);
        let off = (law.speed().moment(place) - time).abs();
        // What a place is rounded by takes this long.
        let rounded = f64::EPSILON * length / law.speed().square(place)[0].sqrt();
        moments = moments.max(off / (1e-12 * duration + 4.0 * rounded));
    }
    let ends =
        [law.speed().place(0.0), law.speed().place(duration) - length, law.speed().moment(length) - duration];
    let most = |shares: Shares| shares[0].max(shares[1]).max(shares[2]);
    let found = [
        (!duration.is_finite(), "its duration is not finite"),
        (!(most(checked) <= 1.0 + 1e-9), "a limit is exceeded at eight places of a cell"),
        (!(most(between) <= 1.0 + 1e-4), "a limit is exceeded between these places"),
        (!(most(differences) <= 1.0 + 1e-4), "differences of positions exceed a limit"),
        (!(duration >= law.without_jerk()), "it is faster than without jerk limits"),
        (!(moments <= 1.0), "moment and place are no inverses"),
        (ends.iter().any(|e| e.abs() > 1e-12 * length.max(duration)), "it does not run from end to end"),
        (!(law.dilation() < 1.05), "it was slowed much so that limits hold"),
    ];
    let found: Vec<&str> = found.iter().filter(|(wrong, _)| *wrong).map(|(_, what)| *what).collect();
    (!found.is_empty()).then(|| {
        format!(
            "case {number}: {}\n {duration} s ({} without jerk), dilation {}, {} cells; shares at places {checked:?}, \
             between {between:?}, of differences {differences:?}; moments {moments}; ends {ends:?}\n {limits:?}",
            found.join("; "),
            law.without_jerk(),
            law.dilation(),
            law.cells()
        )
    })
}

#[test]
fn limits_hold_on_random_paths_in_derivatives_and_in_differences_of_positions() {
    let count = cases(6, 10_000);
    let faults: Vec<String> =
        (0..count).into_par_iter().with_max_len(1).filter_map(|n| fault(u64::from(n))).collect();
    assert!(faults.is_empty(), "{} of {count} cases\n{}", faults.len(), faults.join("\n"));
}
