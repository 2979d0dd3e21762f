//! Law of a stretch of a run.

use super::super::{Moment, TimeLaw, WithoutJerk};
use super::ramp::Ramp;

/// Law of a stretch.
pub(super) enum Law {
    Straight(Ramp),
    Limited(Box<TimeLaw>),
    WithoutJerk(WithoutJerk),
}

impl Law {
    /// Time [s].
    pub(super) fn duration(&self) -> f64 {
        match self {
            Law::Straight(ramp) => ramp.duration(),
            Law::Limited(law) => law.duration(),
            Law::WithoutJerk(law) => law.duration(),
        }
    }

    /// Time where jerk has no limit [s].
    pub(super) fn without_jerk(&self) -> f64 {
        match self {
            Law::Straight(ramp) => ramp.without_jerk(),
            Law::Limited(law) => law.without_jerk(),
            Law::WithoutJerk(law) => law.duration(),
        }
    }

    /// Motion along the stretch at a moment [s].
    pub(super) fn at(&self, time: f64) -> Moment {
        match self {
            Law::Straight(ramp) => ramp.at(time),
            Law::Limited(law) => law.speed().at(time),
            Law::WithoutJerk(law) => law.at(time),
        }
    }

    /// Moment [s] at which a place is reached [mm].
    pub(super) fn moment(&self, s: f64) -> f64 {
        match self {
            Law::Straight(ramp) => ramp.moment(s),
            Law::Limited(law) => law.speed().moment(s),
            Law::WithoutJerk(law) => law.moment(s),
        }
    }

    /// Rates of the parameter at both ends [mm/s].
    pub(super) fn ends(&self) -> [f64; 2] {
        match self {
            Law::Straight(ramp) => ramp.rates(),
            Law::Limited(law) => [law.speed().first(), law.speed().last()],
            Law::WithoutJerk(law) => law.ends(),
        }
    }

    /// Factor by which it was slowed: where most, and at its ends.
    pub(super) fn dilations(&self) -> [f64; 2] {
        if let Law::Limited(law) = self { [law.dilation(), law.dilation_at_ends()] } else { [1.0; 2] }
    }
}
