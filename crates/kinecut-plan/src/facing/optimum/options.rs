//! Constraints of a placement, and limits of the search.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::base::{Code, Finding, Result};
use crate::facing::FaceCase;

/// Constraints of a placement and limits of the search for the best one.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::facing::optimum::Options;
/// let options = Options::for_cutter(50.0);
/// assert_eq!(options.margin, 1.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Least distance of every point of the outline inside the cutter's reach to either side [mm]. Without a margin the
    /// part may touch the cutter circle, where exits have the angle 0 exactly and escape the count.
    pub margin: f64,
    /// Orientations that fixtures forbid: open intervals of the placement's angle, from the first counter-clockwise to
    /// the second [rad].
    pub forbidden: Vec<[f64; 2]>,
    /// Least and greatest polar angle at which the front of the cutter may meet a point of the outline, 0 straight
    /// ahead [rad].
    pub engagement: [f64; 2],
    /// Least distance of the centre line from the middle of the part's width, for a cutter that must not run centred
    /// [mm].
    pub least_off_middle: f64,
    /// Gap at which the search ends, per weighted perimeter.
    pub tolerance: f64,
    /// Number of nodes that the search looks at before it gives up proving.
    pub max_nodes: usize,
    /// Number of local minima given besides the best placement.
    pub alternatives: usize,
    /// Errors of set-up for the sensitivity: of the angle [rad] and of the offset [mm].
    pub set_up_error: [f64; 2],
    /// The part that no straight pass can avoid is worked out loop by loop.
    pub irreducible: bool,
}

impl Options {
    /// Share of the cutter's radius that is its margin where nothing is said.
    const MARGIN: f64 = 0.02;

    /// Usual options for a cutter of this radius [mm]: a margin of 2 % of it, set-up errors of 0.1 degrees and 0.1 mm.
    pub fn for_cutter(radius: f64) -> Options {
        Options {
            margin: Options::MARGIN * radius,
            forbidden: Vec::new(),
            engagement: [-FRAC_PI_2, FRAC_PI_2],
            least_off_middle: 0.0,
            tolerance: 1e-6,
            max_nodes: 400_000,
            alternatives: 5,
            set_up_error: [0.1f64.to_radians(), 0.1],
            irreducible: true,
        }
    }

    /// The constraints as the mirror image of the part has them, y and -y exchanged.
    #[must_use]
    pub fn mirrored(&self) -> Options {
        let flip = |[from, to]: [f64; 2]| [-to, -from];
        Options {
            forbidden: self.forbidden.iter().copied().map(flip).collect(),
            engagement: flip(self.engagement),
            ..self.clone()
        }
    }

    /// # Errors
    /// `KC1001` for numbers that make no sense for the case.
    pub(super) fn check(&self, case: &FaceCase) -> Result<()> {
        let refuse = |what: &str, value: f64, unit: &str, bound: f64| {
            Err(Finding::error(Code::FACE_CASE, what).value(value, unit).bound(bound, unit).into())
        };
        if !(self.margin >= 0.0 && self.margin < case.radius) {
            return refuse(
                "the margin lies between 0 and the cutter's radius",
                self.margin,
                "mm",
                case.radius,
            );
        }
        if !(self.least_off_middle >= 0.0 && self.least_off_middle < case.radius) {
            return refuse(
                "the distance from the middle lies between 0 and the cutter's radius",
                self.least_off_middle,
                "mm",
                case.radius,
            );
        }
        let [lo, hi] = self.engagement;
        if !(lo >= -FRAC_PI_2 && lo < hi && hi <= FRAC_PI_2) {
            return refuse(
                "the engagement lies between -90 and 90 degrees, the lesser first",
                lo.to_degrees(),
                "deg",
                hi.to_degrees(),
            );
        }
        let share = 1.0 - self.margin / case.radius;
        if !(lo.sin() < share && hi.sin() > -share) {
            return refuse(
                "the engagement leaves no room within the margin",
                lo.to_degrees(),
                "deg",
                share.asin().to_degrees(),
            );
        }
        if !(self.tolerance >= Options::LEAST_TOLERANCE) {
            return refuse(
                "the tolerance of the search is too small",
                self.tolerance,
                "",
                Options::LEAST_TOLERANCE,
            );
        }
        for [from, to] in &self.forbidden {
            if !(from <= to && to - from <= TAU && from.is_finite()) {
                return refuse(
                    "a forbidden interval of orientations spans a turn at most",
                    (to - from).to_degrees(),
                    "deg",
                    360.0,
                );
            }
        }
        if self.set_up_error.iter().any(|e| !(*e >= 0.0 && e.is_finite())) {
            return refuse("errors of set-up are not negative", self.set_up_error[0], "", 0.0);
        }
        Ok(())
    }

    /// Sums of some thousand lengths in double precision are not better than this.
    const LEAST_TOLERANCE: f64 = 1e-9;
}
