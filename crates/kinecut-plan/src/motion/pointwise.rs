//! The time along a chain of exact curves, each limit held in every point for itself.
//!
//! For comparing paths on equal terms: it sees curvature, its slope and every joint, and nothing of a control's own
//! blending. Method, in this order:
//! 1. speed caps: the feed, the axes' speed, `sqrt(A/k)` and `(J / hypot(k^2, k'))^(1/3)`, that is the acceleration
//!    and jerk that the shape alone asks for at constant speed;
//! 2. caps at joints: a step of curvature is a step of acceleration that may be `J T` at most, `v^2 dk <= J T`; a kink
//!    is a step of velocity of `A T` at most, `v dtheta <= A T`, with the joint time `T` of the control;
//! 3. one pass forward and one backward with the tangential acceleration `A`, from rest to rest; between two places the
//!    speed ramps with `A` and then stays, where the caps allow it, else evenly.
//!
//! Limits of validity: the tangential jerk is not limited, and tangential and normal acceleration do not share their
//! limit; so the time is a lower one, and joints are under-penalised. The places are refined until the time settles.

use serde::Serialize;

use super::{PathByLength, Station};
use crate::base::{Code, Finding, Result};

/// Limits of feed, speed, acceleration and jerk that a machine sets to a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limits {
    /// Programmed path speed [mm/s].
    pub feed: f64,
    /// Largest speed of an axis [mm/s]; in any direction of the path.
    pub axis_velocity: f64,
    /// Largest acceleration [mm/s^2].
    pub acceleration: f64,
    /// Largest jerk [mm/s^3].
    pub jerk: f64,
    /// Time in which a control smooths a step [s]: a step of acceleration counts as jerk over this time.
    pub joint_time: f64,
}

impl Limits {
    /// Limits of a middling machining centre at a feed [mm/s]: 30 m/min, 5 m/s^2, 100 m/s^3, 1 ms.
    pub fn usual(feed: f64) -> Limits {
        Limits { feed, axis_velocity: 500.0, acceleration: 5000.0, jerk: 1e5, joint_time: 1e-3 }
    }

    /// Checks that each limit is positive and finite.
    ///
    /// # Errors
    /// `KC0404` with the key of the first that is not.
    pub fn check(&self) -> Result<()> {
        for (key, value, unit) in [
            ("feed", self.feed, "mm/s"),
            ("axis_velocity", self.axis_velocity, "mm/s"),
            ("acceleration", self.acceleration, "mm/s2"),
            ("jerk", self.jerk, "mm/s3"),
            ("joint_time", self.joint_time, "s"),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Finding::error(Code::PLAN_VALUE, format!("`{key}` must be positive"))
                    .value(value, unit)
                    .bound(0.0, unit)
                    .key(key)
                    .into());
            }
        }
        Ok(())
    }

    /// Path speed that the shape allows where the derivatives by arc length are `curvature` [1/mm] and `third`
    /// [1/mm^2] in size [mm/s]; what is not a number does not bind.
    pub fn cap(&self, curvature: f64, third: f64) -> f64 {
        let mut v = if self.axis_velocity < self.feed { self.axis_velocity } else { self.feed };
        for cap in [(self.acceleration / curvature).sqrt(), (self.jerk / third).cbrt()] {
            if cap < v {
                v = cap;
            }
        }
        v
    }
}

/// A place of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunPoint {
    /// Arc length from the start of the chain [mm].
    pub s: f64,
    /// Time from the start [s].
    pub time: f64,
    /// Path speed [mm/s].
    pub speed: f64,
    /// Acceleration, tangential and normal together [mm/s^2].
    pub acceleration: f64,
    /// Jerk [mm/s^3], without the steps of joints and of the tangential acceleration.
    pub jerk: f64,
}

/// A run along a chain.
#[derive(Clone, Debug, PartialEq)]
pub struct RunLaw {
    /// Time [s].
    pub time: f64,
    /// Length [mm].
    pub length: f64,
    /// Change of the time in the last refinement, relative.
    pub uncertainty: f64,
    /// The run; two places at each joint.
    pub places: Vec<RunPoint>,
}

/// Heading between two places of the first try [rad].
const FIRST_TURN: f64 = 0.1;
/// Refinements, each halving the distance of places.
const MOST_REFINEMENTS: u32 = 7;
/// Change of the time, as a share of it, at which refining ends: a hundredth of a second in a quarter hour.
const SETTLED: f64 = 1e-5;

/// The run along a chain of curves, each starting where the one before ended, from rest to rest.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::geom::{InvoluteRecord, PlaneCurve};
/// use kinecut::motion::{Limits, pointwise};
/// // A line of 100 mm at 100 mm/s: 1 s and the two ramps of 20 ms, each half as long again.
/// let line = InvoluteRecord::new(100.0, [0.0, 0.0], 0.0, f64::INFINITY, f64::INFINITY).unwrap();
/// let law = pointwise(&[PlaneCurve::from(line)], &Limits::usual(100.0)).unwrap();
/// assert!((law.time - 1.02).abs() < 1e-4);
/// ```
///
/// # Errors
/// `KC0404` for limits that are not positive, or a path that cannot be left: a curve of no radius at both ends of a
/// step.
pub fn pointwise<W: PathByLength>(chain: &[W], limits: &Limits) -> Result<RunLaw> {
    limits.check()?;
    let mut law = run(chain, limits, FIRST_TURN);
    for i in 1..=MOST_REFINEMENTS {
        let finer = run(chain, limits, FIRST_TURN * 0.5f64.powi(i as i32));
        let change = (finer.time - law.time).abs() / finer.time;
        law = RunLaw { uncertainty: change, ..finer };
        if change <= SETTLED {
            break;
        }
    }
    if !law.time.is_finite() {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "the path stands still: its curvature is infinite over a length",
        )
        .into());
    }
    Ok(law)
}

/// Size of a joint's kink and curvature step; nothing where one side has a cusp.
fn joint_cap(before: &Station, after: &Station, limits: &Limits) -> f64 {
    // Rounding of chained curves must not count as a kink or a step.
    const NO_KINK: f64 = 1e-8;
    const NO_STEP: f64 = 1e-12;
    let mut v = f64::INFINITY;
    let kink = before.tangent.cross(after.tangent).length().atan2(before.tangent.dot(after.tangent));
    if kink > NO_KINK {
        v = limits.acceleration * limits.joint_time / kink;
    }
    let step = (after.curvature - before.curvature).length();
    if step > NO_STEP && step.is_finite() {
        let cap = (limits.jerk * limits.joint_time / step).sqrt();
        if cap < v {
            v = cap;
        }
    }
    v
}

fn run<W: PathByLength>(chain: &[W], limits: &Limits, turn: f64) -> RunLaw {
    let mut stations: Vec<Station> = Vec::new();
    let mut caps: Vec<f64> = Vec::new();
    // Without those of joints, which hold in a point only.
    let mut open: Vec<f64> = Vec::new();
    let mut before = 0.0;
    for way in chain {
        let first = stations.len();
        for mut station in way.stations(turn) {
            let cap = limits.cap(station.curvature.length(), station.third.length());
            station.s += before;
            stations.push(station);
            caps.push(cap);
            open.push(cap);
        }
        if first > 0 && first < stations.len() {
            let cap = joint_cap(&stations[first - 1], &stations[first], limits);
            for c in &mut caps[first - 1..=first] {
                if cap < *c {
                    *c = cap;
                }
            }
        }
        before += way.length();
    }
    let squares = ramps(&stations, &caps, limits.acceleration);
    let places = places(&stations, &squares, &open, limits.acceleration);
    RunLaw { time: places.last().map_or(0.0, |p| p.time), length: before, uncertainty: f64::INFINITY, places }
}

/// Squares of the speed under the caps and the tangential acceleration, from rest to rest.
fn ramps(stations: &[Station], caps: &[f64], acceleration: f64) -> Vec<f64> {
    let mut squares: Vec<f64> = caps.iter().map(|v| v * v).collect();
    let n = squares.len();
    if let [first, .., last] = &mut squares[..] {
        *first = 0.0;
        *last = 0.0;
    }
    let limit = |squares: &mut [f64], from: usize, to: usize| {
        let most = squares[from] + 2.0 * acceleration * (stations[to].s - stations[from].s).abs();
        if squares[to] > most {
            squares[to] = most;
        }
    };
    for i in 1..n {
        limit(&mut squares, i - 1, i);
    }
    for i in (1..n).rev() {
        limit(&mut squares, i, i - 1);
    }
    squares
}

/// Time of a stretch of length `d` between the speeds `a` and `b`, where `cap` is allowed at both ends: the ramp as steep
/// as may be and the rest at the higher speed, if that is allowed; else an even ramp.
fn stretch(d: f64, [a, b]: [f64; 2], cap: f64, acceleration: f64) -> f64 {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    let ramp = (high * high - low * low) / (2.0 * acceleration);
    if high <= cap && ramp < d { (high - low) / acceleration + (d - ramp) / high } else { 2.0 * d / (a + b) }
}

fn places(stations: &[Station], squares: &[f64], open: &[f64], acceleration: f64) -> Vec<RunPoint> {
    let mut time = 0.0;
    (0..stations.len())
        .map(|i| {
            let (here, b) = (&stations[i], squares[i]);
            let v = b.sqrt();
            if i > 0 {
                let d = here.s - stations[i - 1].s;
                if d > 0.0 {
                    let cap = if open[i] < open[i - 1] { open[i] } else { open[i - 1] };
                    time += stretch(d, [squares[i - 1].sqrt(), v], cap, acceleration);
                }
            }
            // The tangential acceleration of the step behind, of the step ahead at a start.
            let slope =
                |a: usize, c: usize| (squares[c] - squares[a]) / (2.0 * (stations[c].s - stations[a].s));
            let behind = i > 0 && here.s > stations[i - 1].s;
            let ahead = i + 1 < stations.len() && stations[i + 1].s > here.s;
            let along = if behind {
                slope(i - 1, i)
            } else if ahead {
                slope(i, i + 1)
            } else {
                0.0
            };
            // At a cusp the speed is zero, and so is what its infinite curvature asks for.
            let part =
                |d: glam::DVec3, factor: f64| if factor > 0.0 { d * factor } else { glam::DVec3::ZERO };
            let normal = part(here.curvature, b);
            let jerk = part(here.third, b * v) + part(here.curvature, v) * (3.0 * along);
            RunPoint {
                s: here.s,
                time,
                speed: v,
                acceleration: (here.tangent * along + normal).length(),
                jerk: jerk.length(),
            }
        })
        .collect()
}
