//! The floor of a blind hole that was made from the other side, about the drill's axis: the drill comes out into it.

use super::pre_hole::meeting;
use super::{Cover, Passage, Side, Transient, transient};
use crate::base::{Code, Finding, Result};
use crate::drilling::BoundarySurface;
use crate::geom::EdgeProfile;

/// A floor that looks away from the drill, of revolution about its axis [mm].
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::drilling::*;
/// use kinecut::tool::DrillPoint;
/// // A plate of 20 mm, drilled 12 mm deep from below with 8 mm and 118 degrees; now 6 mm with 140 degrees from above.
/// let made = DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(8.0)?;
/// let point = DrillPoint::SinglePlane { angle: 140f64.to_radians() };
/// let level = |height: f64| BoundarySurface::Plane { height, slope: 0.0 };
/// let spec = DrillSpec {
///     ceiling: Some(Ceiling { height: -8.0, edge: made }),
///     ..DrillSpec::new(6.0, point, level(0.0), level(-20.0))
/// };
/// let exit = plan_drill(&spec)?.exit.unwrap();
/// let cot = |angle: f64| 1.0 / angle.to_radians().tan();
/// assert!((exit.first - -8.0).abs() < 1e-12);
/// // Its corner comes out last: both cones fall there.
/// assert!((exit.last - (-8.0 - 3.0 * (cot(59.0) + cot(70.0)))).abs() < 1e-12);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ceiling {
    /// Z at which the edge that made it has the height 0: that of the tip.
    pub height: f64,
    /// The edge that made it, from the axis to the radius of that hole.
    pub edge: EdgeProfile,
}

impl Ceiling {
    /// Checks that it is the floor of a hole.
    ///
    /// # Errors
    /// `KC0901` when the height is not finite or the edge has a core.
    pub(super) fn check(&self) -> Result<()> {
        if self.height.is_finite() && self.edge.inner_radius() == 0.0 {
            return Ok(());
        }
        let what = "the floor of the hole from the other side must reach its axis, at a finite height";
        let finding = Finding::error(Code::DRILL_CASE, what).value_mm(self.edge.inner_radius());
        Err(finding.bound_mm(0.0).key("ceiling").into())
    }

    /// Whether all of an edge comes out into it.
    pub fn covers(&self, edge: &EdgeProfile) -> bool {
        /// Radii nearer than this are equal [mm].
        const SAME: f64 = 1e-6;
        self.edge.outer_radius() >= edge.outer_radius() - SAME
    }

    /// The exits of an edge: into it, and beside it out of a face; shares of the whole edge.
    ///
    /// # Errors
    /// Those of the face.
    pub(super) fn exits(&self, edge: &EdgeProfile, face: &BoundarySurface) -> Result<Vec<Passage>> {
        let area = |e: &EdgeProfile| e.outer_radius().powi(2) - e.inner_radius().powi(2);
        let rim = self.edge.outer_radius();
        let beside = if self.covers(edge) {
            None
        } else {
            edge.clipped(rim.max(edge.inner_radius()), edge.outer_radius())
        };
        let outside = beside.as_ref().map_or(0.0, |beside| area(beside) / area(edge));
        let mut exits = Vec::with_capacity(2);
        // Over a hair that the edge is wider, its corner has the height that the floor has at its rim.
        if let Some(into) = meeting(edge, [self.height, -1.0], &self.edge, 0.0) {
            exits.push(Passage { transient: into, side: Side::Exit, share: 1.0 - outside });
        }
        if let Some(beside) = beside {
            let transient = transient(&beside, face, Cover::Whole)?;
            exits.push(Passage { transient, side: Side::Exit, share: outside });
        }
        Ok(exits)
    }
}

/// Exits of parts of an edge as one.
pub(super) fn joined(exits: &[Passage]) -> Option<Transient> {
    let first = exits.iter().max_by(|a, b| a.transient.first.total_cmp(&b.transient.first))?.transient;
    let last = exits.iter().min_by(|a, b| a.transient.last.total_cmp(&b.transient.last))?.transient;
    Some(Transient { last: last.last, last_radius: last.last_radius, ..first })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drilling::{DrillSpec, ZoneStage, plan_drill};
    use crate::tool::DrillPoint;
    use proptest::prelude::*;

    fn level(height: f64) -> BoundarySurface {
        BoundarySurface::Plane { height, slope: 0.0 }
    }

    fn point(kind: usize, diameter: f64) -> DrillPoint {
        let deg = f64::to_radians;
        [
            DrillPoint::SinglePlane { angle: deg(118.0) },
            DrillPoint::Flat,
            DrillPoint::Rounded { radius: 0.6 * diameter },
            DrillPoint::CornerRadius { angle: deg(118.0), radius: 0.2 * diameter },
            DrillPoint::Gun { apex: Some(0.2 * diameter), outer_angle: deg(60.0), inner_angle: deg(70.0) },
        ][kind]
            .clone()
    }

    #[test]
    fn a_narrower_hole_from_below_lets_the_middle_out_first() {
        let made = DrillPoint::Flat.edge(4.0).unwrap();
        let spec = DrillSpec::new(10.0, DrillPoint::Flat, level(0.0), level(-20.0));
        let spec = DrillSpec { ceiling: Some(Ceiling { height: -8.0, edge: made }), ..spec };
        let plan = plan_drill(&spec).unwrap();
        let exit = plan.exit.unwrap();
        assert_eq!((exit.first, exit.last, plan.travel.end), (-8.0, -20.0, -22.0));
        let stages: Vec<(ZoneStage, f64)> = plan.zones.iter().map(|z| (z.stage, z.to)).collect();
        // Four tenths of the radius: 0.16 of the disc run in air below -8.
        use ZoneStage::{Entry, Exit, Partial, Steady};
        assert_eq!(stages, [(Entry, 0.0), (Steady, -8.0), (Partial, -20.0), (Exit, -22.0)]);
        assert!((plan.passages[1].share - 0.16).abs() < 1e-12, "{:?}", plan.passages);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(200))]
        /// Dense radii against heights that no code here gives: of the two edges by themselves.
        #[test]
        fn dense_radii_find_the_same_exit(kind in 0usize..5, made in 0usize..5, diameter in 1.0..12.0f64) {
            let edge = point(kind, 8.0).edge(8.0).unwrap();
            let other = point(made, diameter).edge(diameter).unwrap();
            let ceiling = Ceiling { height: -5.0, edge: other };
            let exits = ceiling.exits(&edge, &level(-30.0)).unwrap();
            let joined = joined(&exits).unwrap();
            let (mut first, mut last) = (f64::NEG_INFINITY, f64::INFINITY);
            let n = 4000;
            for i in 0..=n {
                let r = 4.0 * f64::from(i) / f64::from(n);
                let Some(z) = edge.height(r) else { continue };
                let under = other.height(r).map_or(-30.0, |h| -5.0 - h);
                (first, last) = (first.max(under - z), last.min(under - z));
            }
            prop_assert!(first <= joined.first + 1e-9 && last >= joined.last - 1e-9, "{first} {last} {joined:?}");
            prop_assert!(joined.first - first < 0.02 && last - joined.last < 0.02, "{first} {last} {joined:?}");
            let shares: f64 = exits.iter().map(|p| p.share).sum();
            prop_assert!((shares - 1.0).abs() < 1e-12);
        }
    }
}
