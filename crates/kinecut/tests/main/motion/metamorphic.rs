//! What must not change the time, or must change it by a known factor.

use kinecut::motion::{AxisLimit, Course, TimeLaw};

use super::courses::{Planar, USUAL};
use crate::common::random::Random;

/// A course seen otherwise: from its end, with its axes exchanged or mirrored, at another feed.
struct Seen<'a> {
    course: &'a Planar,
    reversed: bool,
    exchanged: bool,
    signs: [f64; 2],
    feed: f64,
    knots: Vec<f64>,
}

impl Seen<'_> {
    fn new(course: &Planar) -> Seen<'_> {
        let (signs, feed) = ([1.0; 2], course.feed);
        Seen { course, reversed: false, exchanged: false, signs, feed, knots: course.knots().to_vec() }
    }

    fn reversed(course: &Planar) -> Seen<'_> {
        let knots = course.knots().iter().rev().map(|k| course.length() - k).collect();
        Seen { reversed: true, knots, ..Seen::new(course) }
    }
}

impl Course<2> for Seen<'_> {
    fn length(&self) -> f64 {
        self.course.length()
    }

    fn derivatives(&self, s: f64) -> [[f64; 3]; 2] {
        let mut jets = self.course.derivatives(if self.reversed { self.length() - s } else { s });
        for (jet, sign) in jets.iter_mut().zip(self.signs) {
            // Odd derivatives change their sign with the direction.
            let odd = if self.reversed { -sign } else { sign };
            *jet = [odd * jet[0], sign * jet[1], odd * jet[2]];
        }
        if self.exchanged {
            jets.swap(0, 1);
        }
        jets
    }

    fn feed(&self, _: f64) -> f64 {
        self.feed
    }

    fn knots(&self) -> &[f64] {
        &self.knots
    }
}

/// Both axes differ, so that exchanging them alone would change the time.
const UNEVEN: [AxisLimit; 2] = [USUAL, AxisLimit { velocity: 300.0, acceleration: 2000.0, jerk: 80_000.0 }];

fn time<C: Course<2>>(course: &C, limits: &[AxisLimit; 2]) -> f64 {
    TimeLaw::new(course, limits).unwrap().duration()
}

/// Paths of a few pieces whose curvature is continuous.
fn courses() -> Vec<Planar> {
    let mut random = Random(21);
    let mut random = |feed: f64| {
        let mut from = random.between(-0.3, 0.3);
        let pieces: Vec<(f64, [f64; 2])> = (0..5)
            .map(|_| {
                let to = random.between(-0.3, 0.3);
                let piece = (random.between(2.0, 30.0), [from, to]);
                from = to;
                piece
            })
            .collect();
        Planar::pieces(random.between(-3.0, 3.0), &pieces, feed)
    };
    vec![random(100.0), random(500.0), random(20.0), Planar::straight(40.0, 0.4, 300.0)]
}

#[test]
fn the_way_back_takes_as_long() {
    for course in courses() {
        let (there, back) = (time(&course, &UNEVEN), time(&Seen::reversed(&course), &UNEVEN));
        // Cells of the way back are others: each is as long as its own start asks for.
        assert!((there / back - 1.0).abs() < 3e-4, "{there} {back}");
    }
}

#[test]
fn mirrored_and_exchanged_axes_take_as_long() {
    let [x, y] = UNEVEN;
    for course in courses() {
        let seen = Seen::new(&course);
        let base = time(&seen, &UNEVEN);
        assert_eq!(base, time(&course, &UNEVEN));
        for signs in [[-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
            let mirrored = time(&Seen { signs, ..Seen::new(&course) }, &UNEVEN);
            assert!((mirrored / base - 1.0).abs() < 1e-9, "{base} {mirrored}");
        }
        let exchanged = time(&Seen { exchanged: true, ..Seen::new(&course) }, &[y, x]);
        assert!((exchanged / base - 1.0).abs() < 1e-9, "{base} {exchanged}");
    }
}

#[test]
fn limits_of_a_faster_clock_give_the_time_of_a_faster_clock() {
    for course in courses() {
        let base = time(&course, &UNEVEN);
        for k in [0.1, 0.5, 2.0, 7.0] {
            let limits = UNEVEN.map(|l| AxisLimit {
                velocity: k * l.velocity,
                acceleration: k * k * l.acceleration,
                jerk: k.powi(3) * l.jerk,
            });
            let seen = Seen { feed: k * course.feed, ..Seen::new(&course) };
            let found = time(&seen, &limits) * k;
            assert!((found / base - 1.0).abs() < 1e-6, "{k}: {base} {found}");
        }
    }
}

/// So many waves: curvature goes up and down between two values, the heading from side to side.
fn waves(count: usize, feed: f64) -> (Planar, f64) {
    let (k, long) = (0.2, 6.0);
    let wave = [(long, [0.0, k]), (long, [k, 0.0]), (long, [0.0, -k]), (long, [-k, 0.0])];
    let pieces: Vec<_> = std::iter::repeat_n(wave, count).flatten().collect();
    (Planar::pieces(0.3, &pieces, feed), 4.0 * long)
}

#[test]
fn a_path_solved_in_windows_keeps_its_limits_and_has_the_same_time_for_each_wave() {
    for feed in [60.0, 400.0] {
        let [short, long] = [40, 80].map(|count| {
            let (course, wave) = waves(count, feed);
            let law = TimeLaw::new(&course, &UNEVEN).unwrap();
            let shares = law.shares(&course, &UNEVEN);
            for share in [shares.velocity, shares.acceleration, shares.jerk] {
                assert!(share <= 1.0 + 1e-9, "{shares:?}");
            }
            // Seams that do not fit would have to be paid for by the whole run.
            assert!(law.dilation() < 1.0 + 1e-4, "{}", law.dilation());
            // Waves away from both ends.
            let place = |i: usize| law.speed().moment(i as f64 * wave);
            let each: Vec<f64> = (5..count - 5).map(|i| place(i + 1) - place(i)).collect();
            let mean = each.iter().sum::<f64>() / each.len() as f64;
            for (i, one) in each.iter().enumerate() {
                assert!((one / mean - 1.0).abs() < 1e-4, "wave {}: {one} {mean}", i + 5);
            }
            (law, mean)
        });
        assert!(long.0.cells() > 6000, "{} cells are one window", long.0.cells());
        assert!((long.1 / short.1 - 1.0).abs() < 1e-4, "{} {}", long.1, short.1);
        let more = (long.0.duration() - short.0.duration()) / 40.0;
        assert!((more / short.1 - 1.0).abs() < 1e-4, "{more} {}", short.1);
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let (course, _) = waves(80, 400.0);
    let moments = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let law = pool.install(|| TimeLaw::new(&course, &UNEVEN)).unwrap();
        let knots = law.speed().knots();
        let mut all: Vec<u64> = knots.iter().map(|k| law.speed().moment(*k).to_bits()).collect();
        all.extend([law.duration().to_bits(), law.without_jerk().to_bits(), law.dilation().to_bits()]);
        all
    };
    let one = moments(1);
    assert_eq!(one, moments(2));
    assert_eq!(one, moments(3));
}
