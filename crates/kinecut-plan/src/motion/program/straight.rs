//! Moves on which all axes go straight.

use super::super::{AxisLimit, SCurve};
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
    rates
        .iter()
        .zip(limits)
        .filter_map(|(rate, limit)| Some(SCurve::new(rate.abs() * length, (*limit)?).duration()))
        .fold(0.0, f64::max)
}
