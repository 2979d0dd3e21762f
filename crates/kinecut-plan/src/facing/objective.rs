//! The objective that is minimised or surveyed: the limit of many teeth, or the teeth of a cutter.

use super::{FaceCase, Placement, Sweep, Tooth, ToothedPass, bad_length, toothed_lengths};
use crate::base::Result;

/// The function evaluated at a placement.
#[derive(Clone, Debug, PartialEq)]
pub enum Objective {
    /// The limit of infinitely many teeth, [`bad_length`].
    Limit,
    /// Real teeth, [`toothed_lengths`] of the front half. It ripples with `along` as teeth meet other points.
    Teeth {
        /// The teeth.
        teeth: Vec<Tooth>,
        /// Feed in a radian of the spindle's turn [mm].
        feed_per_radian: f64,
        /// Shift of the part along the feed [mm].
        along: f64,
    },
}

impl Objective {
    /// The bad length at a placement [mm].
    ///
    /// # Errors
    /// `KC1001` for teeth as in [`ToothedPass::checked`] and [`toothed_lengths`]; never for the limit.
    pub fn value(&self, case: &FaceCase, placement: Placement) -> Result<f64> {
        match self.pass(placement)? {
            None => Ok(bad_length(case, placement)),
            Some(pass) => Ok(toothed_lengths(case, &pass, Sweep::Front)?.bad),
        }
    }

    /// The pass of the teeth at a placement; none in the limit.
    ///
    /// # Errors
    /// As [`ToothedPass::checked`].
    pub fn pass(&self, placement: Placement) -> Result<Option<ToothedPass>> {
        match self {
            Objective::Limit => Ok(None),
            Objective::Teeth { teeth, feed_per_radian, along } => {
                let (teeth, feed_per_radian, along) = (teeth.clone(), *feed_per_radian, *along);
                ToothedPass { teeth, feed_per_radian, placement, along }.checked().map(Some)
            }
        }
    }
}
