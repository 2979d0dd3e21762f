//! Moves on which all axes go straight.

use super::super::{AxisLimit, Moment, SCurve};
use super::joint::AXES;
use crate::trace::AxisPath;

/// First derivatives of the axes along a move on which they are constant; `None` on others.
pub(super) fn straight(path: &AxisPath) -> Option<[f64; AXES]> {
    /// Rates of a coordinate that went through a chain of axes and back differ by rounding.
    const ROUNDING: f64 = 1e-12;
    let length = path.length();
    let [first, middle, last] = [0.0, 0.5, 1.0].map(|part| path.at(part * length));
    let same = (0..AXES).all(|a| {
        let alike = |jet: &[crate::trace::AxisJet; AXES]| {
            (jet[a].d1 - first[a].d1).abs() <= ROUNDING && jet[a].d2 == 0.0 && jet[a].d3 == 0.0
        };
        alike(&first) && alike(&middle) && alike(&last)
    });
    same.then(|| first.map(|jet| jet.d1))
}

/// Limits of the parameter on a straight move: those of the axis that binds first, and the feed [mm/s].
pub(super) fn along(rates: &[f64; AXES], limits: &[Option<AxisLimit>; AXES], feed: f64) -> AxisLimit {
    let mut most = AxisLimit { velocity: feed, acceleration: f64::INFINITY, jerk: f64::INFINITY };
    for (rate, limit) in rates.iter().zip(limits) {
        if let Some(limit) = limit
            && *rate != 0.0
        {
            most.velocity = most.velocity.min(limit.velocity / rate.abs());
            most.acceleration = most.acceleration.min(limit.acceleration / rate.abs());
            most.jerk = most.jerk.min(limit.jerk / rate.abs());
        }
    }
    most
}

/// Time of a straight rapid on which each axis runs for itself [s]: that of the slowest one.
pub(super) fn axis_by_axis(rates: &[f64; AXES], length: f64, limits: &[Option<AxisLimit>; AXES]) -> f64 {
    Apart::new(&rates.map(|rate| rate * length), limits).duration()
}

/// Axes that run for themselves from rest to rest.
pub(super) struct Apart([Option<(f64, SCurve)>; AXES]);

impl Apart {
    /// Over these ways [mm, rad]; an axis without limits stands.
    pub(super) fn new(ways: &[f64; AXES], limits: &[Option<AxisLimit>; AXES]) -> Apart {
        let curve = |a: usize| Some((ways[a].signum(), SCurve::new(ways[a].abs(), limits[a]?)));
        Apart(std::array::from_fn(curve))
    }

    /// Time of the slowest one [s].
    pub(super) fn duration(&self) -> f64 {
        self.0.iter().flatten().map(|(_, curve)| curve.duration()).fold(0.0, f64::max)
    }

    /// Motion of each axis at a moment [s].
    pub(super) fn at(&self, time: f64) -> [Moment; AXES] {
        let none = Moment { way: 0.0, velocity: 0.0, acceleration: 0.0, jerk: 0.0 };
        self.0.map(|axis| {
            axis.map_or(none, |(sign, curve)| {
                let Moment { way, velocity, acceleration, jerk } = curve.at(time);
                Moment {
                    way: sign * way,
                    velocity: sign * velocity,
                    acceleration: sign * acceleration,
                    jerk: sign * jerk,
                }
            })
        })
    }
}
