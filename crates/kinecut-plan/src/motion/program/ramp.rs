//! A straight stretch that begins or ends at rest, in closed form.

use super::super::{AxisLimit, End, Moment, SCurve};
use super::joint::AXES;

/// A straight stretch with a rest at one end at least.
pub(super) struct Ramp {
    curve: SCurve,
    without_jerk: SCurve,
    ends: [End; 2],
    length: f64,
}

impl Ramp {
    /// The stretch of this length [mm]; `along` gives the limits along it from those of the axes.
    pub(super) fn new(
        length: f64,
        ends: [End; 2],
        along: impl Fn([Option<AxisLimit>; AXES]) -> AxisLimit,
        limits: &[Option<AxisLimit>; AXES],
    ) -> Ramp {
        // From rest to its speed a path runs as in the first half of one of twice the length.
        let times = if ends == [End::Rest; 2] { 1.0 } else { 2.0 };
        let own = along(*limits);
        let no_jerk = along(limits.map(|l| Some(AxisLimit { jerk: f64::INFINITY, ..l? })));
        Ramp {
            curve: SCurve::new(times * length, own),
            without_jerk: SCurve::new(times * length, no_jerk),
            ends,
            length,
        }
    }

    fn time(&self, curve: &SCurve) -> f64 {
        match self.ends {
            [End::Rest, End::Rest] => curve.duration(),
            _ => 0.5 * curve.duration(),
        }
    }

    /// Time [s].
    pub(super) fn duration(&self) -> f64 {
        self.time(&self.curve)
    }

    /// Time where jerk has no limit [s].
    pub(super) fn without_jerk(&self) -> f64 {
        self.time(&self.without_jerk)
    }

    /// Rates at both ends [mm/s].
    pub(super) fn rates(&self) -> [f64; 2] {
        self.ends.map(|end| if end == End::Rest { 0.0 } else { self.curve.peak() })
    }

    /// Motion along it at a moment [s].
    pub(super) fn at(&self, time: f64) -> Moment {
        match self.ends {
            [End::Rest, _] => self.curve.at(time),
            [End::Even, _] => {
                let at = self.curve.at(0.5 * self.curve.duration() + time);
                Moment { way: at.way - self.length, ..at }
            }
        }
    }

    /// Moment [s] at which a place is reached [mm].
    pub(super) fn moment(&self, s: f64) -> f64 {
        match self.ends {
            [End::Rest, _] => self.curve.moment(s),
            [End::Even, _] => {
                let half = 0.5 * self.curve.duration();
                self.curve.moment(self.length + s) - half
            }
        }
    }
}
