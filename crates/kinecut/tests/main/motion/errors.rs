//! Limits and courses that cannot be run: an error that says why, and no panic.

use std::sync::atomic::{AtomicUsize, Ordering};

use kinecut::base::Code;
use kinecut::motion::{AxisLimit, Course, TimeLaw, WithoutJerk};

use super::courses::{Planar, USUAL};

#[test]
fn limits_that_are_none_are_refused_with_axis_and_key() {
    let set = |key: &str, value: f64| match key {
        "velocity" => AxisLimit { velocity: value, ..USUAL },
        "acceleration" => AxisLimit { acceleration: value, ..USUAL },
        _ => AxisLimit { jerk: value, ..USUAL },
    };
    USUAL.check('X').unwrap();
    for (axis, key) in [('X', "velocity"), ('B', "acceleration"), ('Z', "jerk")] {
        for value in [0.0, -0.0, -5.0, f64::NAN, f64::NEG_INFINITY, f64::INFINITY] {
            let found = set(key, value).check(axis);
            if key == "jerk" && value == f64::INFINITY {
                found.unwrap();
                continue;
            }
            let error = found.unwrap_err();
            assert_eq!((error.code(), error.0.key.as_deref()), (Code::PLAN_VALUE, Some(key)), "{value}");
            assert!(error.to_string().contains(&format!("axis {axis}")), "{error}");
        }
    }
}

/// A straight way of 10 mm with one thing wrong from a place on.
struct Wrong {
    length: f64,
    feed: f64,
    derivatives: [f64; 3],
    from: f64,
    /// Times that it was asked: a grid that does not get on would fill the memory.
    asked: AtomicUsize,
}

impl Wrong {
    /// With nothing wrong yet.
    fn new() -> Wrong {
        let asked = AtomicUsize::new(0);
        Wrong { length: 10.0, feed: 100.0, derivatives: [1.0, 0.0, 0.0], from: 0.0, asked }
    }
}

impl Course<1> for Wrong {
    fn length(&self) -> f64 {
        self.length
    }

    fn derivatives(&self, s: f64) -> [[f64; 3]; 1] {
        assert!(self.asked.fetch_add(1, Ordering::Relaxed) < 1_000_000, "it is asked without end");
        [if s >= self.from { self.derivatives } else { [1.0, 0.0, 0.0] }]
    }

    fn feed(&self, s: f64) -> f64 {
        if s >= self.from { self.feed } else { 100.0 }
    }

    fn knots(&self) -> &[f64] {
        &[]
    }
}

fn refused(course: Wrong, what: &str) {
    let error = TimeLaw::new(&course, &[USUAL]).map(|law| law.duration()).expect_err(what);
    assert_eq!(error.code(), Code::PLAN_VALUE, "{what}: {error}");
    let error = WithoutJerk::new(&course, &[USUAL]).map(|law| law.duration()).expect_err(what);
    assert_eq!(error.code(), Code::PLAN_VALUE, "{what}: {error}");
}

#[test]
fn a_course_without_a_length_is_refused() {
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(Wrong { length, ..Wrong::new() }, &format!("length {length}"));
    }
    let none = Planar::straight(0.0, 0.3, 100.0);
    assert_eq!(TimeLaw::new(&none, &[USUAL; 2]).unwrap_err().code(), Code::PLAN_VALUE);
}

#[test]
fn a_derivative_that_is_not_finite_is_refused_everywhere_and_in_places() {
    for d in 0..3 {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for from in [0.0, 5.0, 9.0] {
                let mut derivatives = Wrong::new().derivatives;
                derivatives[d] = value;
                refused(
                    Wrong { derivatives, from, ..Wrong::new() },
                    &format!("derivative {d} {value} from {from}"),
                );
            }
        }
    }
}

#[test]
fn a_course_with_nothing_wrong_is_run() {
    TimeLaw::new(&Wrong::new(), &[USUAL]).unwrap();
    WithoutJerk::new(&Wrong::new(), &[USUAL]).unwrap();
}

#[test]
fn a_feed_that_is_none_is_refused_everywhere_and_in_places() {
    for feed in [0.0, f64::NAN] {
        for from in [9.0, 5.0, 0.0] {
            refused(Wrong { feed, from, ..Wrong::new() }, &format!("feed {feed} from {from}"));
        }
    }
}

#[test]
fn a_long_way_at_hardly_any_feed_has_an_end() {
    for (length, feed) in [(1e3, 1e-5), (1e5, 1e-7)] {
        let law = TimeLaw::new(&Wrong { length, feed, ..Wrong::new() }, &[USUAL]).unwrap();
        assert!((law.duration() * feed / length - 1.0).abs() < 1e-6, "{length} {feed}: {}", law.duration());
    }
}

#[test]
fn a_course_that_turns_without_measure_is_refused_before_it_fills_the_memory() {
    struct Wound;
    impl Course<1> for Wound {
        fn length(&self) -> f64 {
            100.0
        }
        fn derivatives(&self, _: f64) -> [[f64; 3]; 1] {
            [[1.0, 1e9, 0.0]]
        }
        fn feed(&self, _: f64) -> f64 {
            1e-3
        }
        fn knots(&self) -> &[f64] {
            &[]
        }
    }
    let error = TimeLaw::new(&Wound, &[USUAL]).unwrap_err();
    assert_eq!(error.0.bound.as_ref().map(|b| b.value), Some(2e6), "{error}");
}
