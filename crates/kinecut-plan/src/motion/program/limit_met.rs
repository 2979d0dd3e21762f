//! The limit that a motion is at.

use super::super::AxisLimit;
use super::held::AxisBound;
use super::samples::MotionSample;

/// The limit that a motion is at, at a moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitMet {
    /// The programmed feed.
    Feed,
    /// A limit of an axis, which is counted X Y Z A B C.
    Axis(usize, AxisBound),
    /// None to [`LimitMet::SHARE`].
    Nothing,
}

impl LimitMet {
    /// Share of a limit from which the motion is at it.
    pub const SHARE: f64 = 0.95;

    /// Limit of which a sample uses the largest share. The programmed `feed` [mm/s] is infinite where a move has no feed.
    ///
    /// ```
    /// use kinecut_plan::motion::{AxisBound, AxisLimit, AxisMoment, LimitMet, MotionSample};
    /// let limit = AxisLimit { velocity: 500.0, acceleration: 5000.0, jerk: 50_000.0 };
    /// let mut axes = [AxisMoment::default(); 6];
    /// axes[1] = AxisMoment { position: 0.0, velocity: 90.0, acceleration: -4900.0, jerk: 0.0 };
    /// let sample = MotionSample { time: 0.0, item: 0, segment: Some(0), feed: 90.0, axes };
    /// let met = |feed: f64| LimitMet::of(&sample, feed, &[Some(limit); 6]);
    /// assert_eq!(met(100.0), LimitMet::Axis(1, AxisBound::Acceleration));
    /// assert_eq!(met(90.0), LimitMet::Feed);
    /// ```
    pub fn of(sample: &MotionSample, feed: f64, limits: &[Option<AxisLimit>; 6]) -> LimitMet {
        let mut met = (sample.feed / feed, LimitMet::Feed);
        for (axis, (at, limit)) in sample.axes.iter().zip(limits).enumerate() {
            let Some(limit) = limit else { continue };
            let shares = [
                (at.velocity / limit.velocity, AxisBound::Velocity),
                (at.acceleration / limit.acceleration, AxisBound::Acceleration),
                (at.jerk / limit.jerk, AxisBound::Jerk),
            ];
            for (share, bound) in shares {
                if share.abs() > met.0 {
                    met = (share.abs(), LimitMet::Axis(axis, bound));
                }
            }
        }
        if met.0 >= LimitMet::SHARE { met.1 } else { LimitMet::Nothing }
    }
}
