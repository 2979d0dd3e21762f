//! Burrs that are to be taken off, as intervals of exit angles.

use std::f64::consts::PI;

use super::BurrTable;
use crate::base::Result;
use crate::base::bounded::{MAX_LENGTH, positive};
use crate::facing::{BadPart, BadSet};

/// Exit angles whose burrs are taken off.
#[derive(Clone, Debug, PartialEq)]
pub enum BurrChoice {
    /// Those of a set of bad ones.
    Bad(BadSet),
    /// Those at which a table gives more than this [mm].
    Above(f64),
}

/// Exit angles nearer than this to the end of a bad interval are not bad [rad], as for the faces themselves.
const ANGLE_ZERO: f64 = 1e-10;
/// Heights nearer than this to a limit do not exceed it [mm]: an edge along the feed keeps one exit angle.
const HEIGHT_ZERO: f64 = 1e-10;

impl BurrChoice {
    /// Burrs higher than a limit [mm].
    ///
    /// # Errors
    /// `KC0103` for a limit that is not above 0.
    pub fn above(limit: f64) -> Result<BurrChoice> {
        Ok(BurrChoice::Above(positive("above", limit, MAX_LENGTH, "mm")?))
    }

    /// Whether the burr at an exit angle [rad] is chosen; without a table none is higher than anything.
    pub fn takes(&self, exit_angle: f64, table: Option<&BurrTable>) -> bool {
        match self {
            BurrChoice::Bad(set) => {
                let within = |p: &BadPart| p.from + ANGLE_ZERO < exit_angle && exit_angle < p.to - ANGLE_ZERO;
                set.parts().iter().any(within)
            }
            BurrChoice::Above(limit) => table.is_some_and(|t| t.at(exit_angle) > limit + HEIGHT_ZERO),
        }
    }

    /// Exit angles from 0 to pi, ascending, between which the choice is one and the height straight.
    pub(super) fn bounds(&self, table: Option<&BurrTable>) -> Vec<f64> {
        let mut bounds = vec![0.0, PI];
        match self {
            BurrChoice::Bad(set) => bounds.extend(set.parts().iter().flat_map(|p| [p.from, p.to])),
            BurrChoice::Above(limit) => bounds.extend(table.iter().flat_map(|t| t.passes(*limit))),
        }
        bounds.extend(table.iter().flat_map(|t| t.points()).map(|p| p[0]));
        bounds.retain(|b| (0.0..=PI).contains(b));
        bounds.sort_by(f64::total_cmp);
        bounds.dedup_by(|b, a| *b - *a <= ANGLE_ZERO);
        bounds
    }
}
