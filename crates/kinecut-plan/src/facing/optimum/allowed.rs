//! The placements that constraints allow, for other searches than the certified one.

use super::Options;
use super::domain::Domain;
use crate::base::Result;
use crate::facing::{FaceCase, Placement};

/// The allowed placements of a case.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::optimum::{AllowedPlacements, Options};
/// use kinecut::facing::{BadSet, FaceCase, Placement};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)])?;
/// let case = FaceCase::new(plate, 50.0, BadSet::below(90f64.to_radians())?)?;
/// let options = Options { engagement: [-60f64.to_radians(), 60f64.to_radians()], ..Options::for_cutter(50.0) };
/// let allowed = AllowedPlacements::new(&case, &options)?;
/// assert_eq!(allowed.shortfall(Placement { angle: 0.0, offset: 30.0 }), 0.0);
/// // The far side would leave at 66 degrees.
/// let beyond = allowed.shortfall(Placement { angle: 0.0, offset: 45.5 });
/// assert!((beyond - (45.5 - 50.0 * 60f64.to_radians().sin())).abs() < 1e-9);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct AllowedPlacements<'a> {
    case: &'a FaceCase,
    domain: Domain,
}

impl<'a> AllowedPlacements<'a> {
    /// The placements of a case that the constraints of the options allow.
    ///
    /// # Errors
    /// `KC1001` for options that make no sense.
    pub fn new(case: &'a FaceCase, options: &Options) -> Result<AllowedPlacements<'a>> {
        options.check(case)?;
        Ok(AllowedPlacements { case, domain: Domain::new(case, options) })
    }

    /// The intervals of offsets allowed at an angle [mm], ascending; none where the angle is forbidden or the part too
    /// wide.
    pub fn offsets(&self, angle: f64) -> Vec<[f64; 2]> {
        if !self.domain.allows(angle) {
            return Vec::new();
        }
        let shift = self.domain.placement(angle, 0.0).offset;
        let spans = self.domain.offsets(angle).into_iter().filter(|s| s[0] <= s[1]);
        spans.map(|s| s.map(|c| c + shift)).collect()
    }

    /// Distance of a placement from the allowed ones [mm], 0 inside: that of its offset, and that of its angle along
    /// the cutter's circle.
    pub fn shortfall(&self, placement: Placement) -> f64 {
        let turn = self.case.radius * self.domain.turn_to_allowed(placement.angle);
        let local = self.domain.local(placement);
        // Where an interval is empty its ends cross: the larger shortfall is the one that counts.
        let beyond = |s: &[f64; 2]| if s[0] - local > local - s[1] { s[0] - local } else { local - s[1] };
        let spans = self.domain.offsets(placement.angle);
        let short = spans.iter().map(beyond).fold(f64::INFINITY, |a, b| if b < a { b } else { a });
        turn + if short > 0.0 { short } else { 0.0 }
    }
}
