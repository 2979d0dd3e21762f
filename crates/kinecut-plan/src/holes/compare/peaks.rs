//! Peak velocity, acceleration and jerk of the axes along a path at constant feed.
//!
//! No spiral from the centre can be run at constant feed: its curvature grows beyond bounds there. So the feed is lowered
//! near the centre, for all strategies by the same law: at the distance `q` from the centre to what a circle of that
//! radius may have, `min(F, sqrt(A q), (J q^2)^(1/3))`. Changes of the feed itself are not counted.
//!
//! Around a joint the exact derivatives step or are impulses; a control sees positions in time steps. So second and
//! third differences of positions are taken there too, each time step from the joint, for the worst of many phases of
//! the clock.

use serde::Serialize;

use super::chain::Chain;
use super::limits::Limits;
use crate::motion::PathByLength as _;
use crate::num::bisect::bisected;

/// Peaks along a path [mm/s, mm/s^2, mm/s^3].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct AxisPeaks {
    /// Velocity of X and Y.
    pub velocity: [f64; 2],
    /// Acceleration of X and Y.
    pub acceleration: [f64; 2],
    /// Jerk of X and Y, without the steps and impulses of joints.
    pub jerk: [f64; 2],
}

/// Peaks of differences of positions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Sampled {
    /// Time step [s].
    pub time_step: f64,
    /// Second differences [mm/s^2].
    pub acceleration: f64,
    /// Third differences [mm/s^3].
    pub jerk: f64,
}

/// Path speed at a distance `q` from the centre [mm/s].
pub fn feed_cap(limits: &Limits, q: f64) -> f64 {
    // A circle of that radius: curvature 1/q, third derivative 1/q^2.
    if q > 0.0 { limits.cap(1.0 / q, 1.0 / (q * q)) } else { 0.0 }
}

/// Radius within which the feed is lowered [mm].
pub(super) fn capped_radius(limits: &Limits) -> f64 {
    let feed = limits.feed;
    let (a, j) = (feed * feed / limits.acceleration, (feed.powi(3) / limits.jerk).sqrt());
    if a > j { a } else { j }
}

/// Heading between two places [rad]: an axis' peak is then missed by 5e-5 of it at most.
const TURN: f64 = 0.02;

/// Peaks of each axis.
pub(super) fn axis_peaks(chain: &Chain, limits: &Limits) -> AxisPeaks {
    let mut peaks = AxisPeaks::default();
    let grow = |peak: &mut [f64; 2], v: glam::DVec3| {
        for (p, v) in peak.iter_mut().zip([v.x.abs(), v.y.abs()]) {
            // A speed that is not finite (a cusp, reached at speed zero) is no peak.
            if v > *p && v.is_finite() {
                *p = v;
            }
        }
    };
    for curve in &chain.curves {
        for station in curve.stations(TURN) {
            let v = feed_cap(limits, station.point.length());
            if v > 0.0 {
                grow(&mut peaks.velocity, station.tangent * v);
                grow(&mut peaks.acceleration, station.curvature * (v * v));
                grow(&mut peaks.jerk, station.third * v.powi(3));
            }
        }
    }
    peaks
}

/// Acceleration and jerk at constant feed [mm/s^2, mm/s^3] in the first place that is `radius` from the centre.
pub(super) fn at_radius(chain: &Chain, radius: f64, feed: f64) -> Option<[f64; 2]> {
    for curve in &chain.curves {
        let stations = curve.stations(TURN);
        let Some(i) =
            stations.windows(2).position(|w| w[0].point.length() <= radius && w[1].point.length() > radius)
        else {
            continue;
        };
        // The distance grows between the two places; halved to rounding.
        const HALVINGS: u32 = 50;
        let between = [stations[i].s, stations[i + 1].s];
        let [low, _] = bisected(between, HALVINGS, |s| curve.at(s).p.length() <= radius);
        let jet = curve.at(low);
        return Some([feed.powi(2) * jet.d2.length(), feed.powi(3) * jet.d3.length()]);
    }
    None
}

/// Time steps to both sides of a joint that are looked at.
const AROUND: i32 = 63;
/// Phases of the clock against the joint.
const PHASES: u32 = 20;

/// Peaks of differences around the last joint of a chain, at constant feed, for the worst phase of the clock.
pub(super) fn sampled_at_last(chain: &Chain, feed: f64, time_step: f64) -> Sampled {
    // The neighbourhood alone: a place on a long spiral costs as much as the way to it.
    let reach = f64::from(AROUND + 1) * feed * time_step;
    let (near, s) = match &chain.curves[..] {
        [.., a, b] if a.length() > reach && b.length() > reach => {
            let parts = vec![a.part(a.length() - reach, a.length()), b.part(0.0, reach)];
            let near = Chain::new(parts);
            let s = near.starts[1];
            (near, s)
        }
        curves => {
            let s = chain.starts[curves.len().saturating_sub(1)];
            (Chain::new(curves.to_vec()), s)
        }
    };
    let chain = &near;
    let phases = (0..PHASES).map(|i| f64::from(i) / f64::from(PHASES));
    phases.map(|phase| sampled(chain, s, feed, time_step, phase)).fold(
        Sampled { time_step, ..Sampled::default() },
        |worst, next| Sampled {
            time_step,
            acceleration: if next.acceleration > worst.acceleration {
                next.acceleration
            } else {
                worst.acceleration
            },
            jerk: if next.jerk > worst.jerk { next.jerk } else { worst.jerk },
        },
    )
}

/// The same for one phase: a tick of the clock lies `phase` ticks after the joint.
pub(super) fn sampled(chain: &Chain, s: f64, feed: f64, time_step: f64, phase: f64) -> Sampled {
    let points: Vec<_> =
        (-AROUND..=AROUND).map(|i| chain.point(s + (f64::from(i) + phase) * feed * time_step)).collect();
    let peak = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |a, b| if b > a { b } else { a });
    let second = &mut points.windows(3).map(|p| (p[2] - 2.0 * p[1] + p[0]).length());
    let third = &mut points.windows(4).map(|p| (p[3] - 3.0 * p[2] + 3.0 * p[1] - p[0]).length());
    Sampled {
        time_step,
        acceleration: peak(second) / time_step.powi(2),
        jerk: peak(third) / time_step.powi(3),
    }
}
