//! Travel of the joints, and turns of rotary axes inside it.

use std::f64::consts::TAU;

use crate::machine::MOST_JOINTS;

/// Distance beyond its travel at which an axis still counts as inside [mm or rad]: rounding of positions of some metres
/// and of many turns.
pub(super) const TRAVEL_SLACK: f64 = 1e-9;

/// Travel of the joints in the order of the chain [mm or rad]; `None` where it is unknown or endless.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Travels(pub [Option<[f64; 2]>; MOST_JOINTS]);

impl Travels {
    /// Distance of a position outside the travel of a joint [mm or rad]; zero inside.
    pub fn beyond(&self, joint: usize, value: f64) -> f64 {
        match self.0.get(joint).copied().flatten() {
            Some([least, _]) if value < least - TRAVEL_SLACK => least - value,
            Some([_, most]) if value > most + TRAVEL_SLACK => value - most,
            _ => 0.0,
        }
    }

    /// Only the travel of some joints.
    #[must_use]
    pub fn only(&self, keep: impl Fn(usize) -> bool) -> Travels {
        let mut travels = *self;
        for (joint, travel) in travels.0.iter_mut().enumerate() {
            if !keep(joint) {
                *travel = None;
            }
        }
        travels
    }

    /// Whole turns to add to an angle [rad] that keep it inside the travel of a joint, from least to most: empty when
    /// no turn fits, zero alone when the travel is unknown or endless.
    pub(super) fn turns(&self, joint: usize, angle: f64) -> std::ops::RangeInclusive<i64> {
        match self.0.get(joint).copied().flatten() {
            None => 0..=0,
            Some([least, most]) => {
                let first = ((least - TRAVEL_SLACK - angle) / TAU).ceil();
                let last = ((most + TRAVEL_SLACK - angle) / TAU).floor();
                first as i64..=last as i64
            }
        }
    }
}
