//! A bore that crosses the drill's way: out through its roof, in again through its floor.
//!
//! Seen along the feed the roof of a level bore is a ridge and its floor a valley, both over a strip as wide as the bore.
//! A bore that swallows the drill has air between them. Otherwise its sides lie in the drill's way: roof and floor meet
//! there, the drill is loaded on one side all along, and both passages last from the first break-through to the end of
//! the re-entry.

use super::domain::{Laid, area, transient_outside};
use super::region::Disc;
use super::{BoundarySurface, Cover, Passage, Side, Transient};
use crate::base::{Code, Finding, Result};
use crate::geom::EdgeProfile;

/// A level cylindrical bore on the way [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossBore {
    /// Its radius.
    pub radius: f64,
    /// Signed distance of the tool axis from its axis, along u.
    pub offset: f64,
    /// Z of its axis.
    pub height: f64,
    /// Angle of u, which runs across the bore's axis, from the x axis of the hole [rad]. It counts only with an
    /// eccentric pre-hole, or where bores and faces meet under the drill.
    pub turn: f64,
}

impl CrossBore {
    /// The passages of an edge: roof and floor, merged where the bore does not swallow the drill. `None` when the drill
    /// passes beside it.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::drilling::CrossBore;
    /// use kinecut::tool::DrillPoint;
    /// let edge = DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(10.0)?;
    /// // As large as the drill: no air, one stretch.
    /// let bore = CrossBore { radius: 5.0, offset: 0.0, height: -40.0, turn: 0.0 };
    /// let [roof, floor] = bore.passages(&edge)?.unwrap();
    /// assert!((roof.transient.first - -35.0).abs() < 1e-12 && (floor.transient.last - -48.004303).abs() < 1e-6);
    /// # Ok::<(), kinecut::base::Error>(())
    /// ```
    ///
    /// # Errors
    /// `KC0902` when the radius is not positive or a number is not finite.
    pub fn passages(&self, edge: &EdgeProfile) -> Result<Option<[Passage; 2]>> {
        let whole = area(edge, None, None);
        Ok(self.over(edge, None, whole)?.map(|sheets| self.merged(edge.outer_radius(), sheets)))
    }

    /// True if all of a drill's disc lies within the bore, seen along the feed; `drill_radius` in mm.
    pub fn swallows(&self, drill_radius: f64) -> bool {
        self.offset.abs() + drill_radius <= self.radius
    }

    /// Roof and floor as surfaces.
    pub(super) fn surfaces(&self) -> [Laid; 2] {
        let (radius, offset, height) = (self.radius, self.offset, self.height);
        let [roof, floor] = [
            BoundarySurface::Ridge { radius, offset, height },
            BoundarySurface::Valley { radius, offset, height },
        ];
        [roof, floor].map(|surface| Laid { surface, turn: self.turn })
    }

    /// Roof and floor over an annulus less a hole, not merged; their shares are counted of the area `whole`.
    pub(super) fn over(
        &self,
        edge: &EdgeProfile,
        hole: Option<&Disc>,
        whole: f64,
    ) -> Result<Option<[Passage; 2]>> {
        if !(self.radius > 0.0 && self.radius.is_finite()) {
            return Err(Finding::error(Code::DRILL_SURFACE, "the radius of a cross bore must be positive")
                .value_mm(self.radius)
                .bound_mm(0.0)
                .key("radius")
                .into());
        }
        if !(self.offset.is_finite() && self.height.is_finite() && self.turn.is_finite()) {
            return Err(Finding::error(Code::DRILL_SURFACE, "the place of a cross bore is not finite")
                .key("offset")
                .into());
        }
        if self.offset.abs() - self.radius >= edge.outer_radius() {
            return Ok(None);
        }
        let [roof, floor] = self.surfaces();
        let share = area(edge, Some(&roof), hole) / whole;
        let passage = |laid: &Laid, side: Side| -> Result<Option<Passage>> {
            let found = transient_outside(edge, laid, Cover::Part, hole)?;
            Ok(found.map(|transient| Passage { transient, side, share }))
        };
        let (out, back) = (passage(&roof, Side::Exit)?, passage(&floor, Side::Entry)?);
        Ok(out.zip(back).map(|(out, back)| [out, back]))
    }

    /// Both passages as one stretch, unless the bore swallows the drill.
    pub(super) fn merged(&self, drill_radius: f64, [roof, floor]: [Passage; 2]) -> [Passage; 2] {
        if self.swallows(drill_radius) {
            return [roof, floor];
        }
        let (a, b) = (roof.transient, floor.transient);
        let (high, low) = (if a.first >= b.first { a } else { b }, if a.last < b.last { a } else { b });
        let transient = Transient {
            first: high.first,
            last: low.last,
            first_radius: high.first_radius,
            last_radius: low.last_radius,
        };
        [Passage { transient, ..roof }, Passage { transient, ..floor }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drilling::transient;
    use crate::tool::DrillPoint;

    #[test]
    fn the_floor_of_a_narrow_bore_is_met_first_at_its_side() {
        // 2 mm off the axis of a bore of 8 mm: its side, level with its axis, is 2 mm from that of the drill, where the
        // point is 1.2 mm high; the floor under the tip lies 3.46 mm deep.
        let edge = DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(20.0).unwrap();
        let floor = BoundarySurface::Valley { radius: 4.0, offset: 2.0, height: 0.0 };
        let t = transient(&edge, &floor, Cover::Part).unwrap();
        assert!((t.first + 2.0 / 59f64.to_radians().tan()).abs() < 1e-12 && t.first_radius == 2.0, "{t:?}");
    }

    #[test]
    fn bad_bores_are_refused() {
        let edge = DrillPoint::Flat.edge(10.0).unwrap();
        let good = CrossBore { radius: 4.0, offset: 2.0, height: -9.0, turn: 0.0 };
        assert!(good.passages(&edge).unwrap().is_some());
        for bad in [
            CrossBore { radius: 0.0, ..good },
            CrossBore { radius: f64::NAN, ..good },
            CrossBore { offset: f64::INFINITY, ..good },
            CrossBore { height: f64::NAN, ..good },
            CrossBore { turn: f64::NAN, ..good },
        ] {
            assert_eq!(bad.passages(&edge).unwrap_err().code(), Code::DRILL_SURFACE, "{bad:?}");
        }
    }
}
