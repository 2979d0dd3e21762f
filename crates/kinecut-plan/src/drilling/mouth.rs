//! A recess about the drill's axis in the level face that it enters: the spot that a centre drill has left, or a chamfer.

use super::surface::BoundarySurface;
use super::transient::{Cover, transient};
use super::{Passage, PreHole, Side, Transient};
use crate::base::Result;
use crate::geom::EdgeProfile;

/// A recess of revolution about the drill's axis, open to the face that the drill enters [mm].
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::drilling::*;
/// use kinecut::tool::DrillPoint;
/// // A spot of 90 degrees and 7 mm before a drill of 6.6 mm with 118 degrees: its corner comes to the cone of the spot first.
/// let spot = DrillPoint::SinglePlane { angle: 90f64.to_radians() }.edge(7.0).unwrap();
/// let point = DrillPoint::SinglePlane { angle: 118f64.to_radians() };
/// let plane = BoundarySurface::Plane { height: 0.0, slope: 0.0 };
/// let exit = BoundarySurface::Plane { height: -20.0, slope: 0.0 };
/// let spec = DrillSpec {
///     mouth: Some(Mouth { height: -3.5, edge: spot }),
///     ..DrillSpec::new(6.6, point, plane, exit)
/// };
/// let entry = plan_drill(&spec).unwrap().entry;
/// assert!((entry.first - (-0.2 - 3.3 / 59f64.to_radians().tan())).abs() < 1e-9 && (entry.last - -3.5).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mouth {
    /// Z at which the edge that made it has the height 0: that of the tip.
    pub height: f64,
    /// The edge that made it, from the axis to its rim in the face.
    pub edge: EdgeProfile,
}

impl Mouth {
    /// The transient of an edge that goes into it, and beside it into a level face at a height [mm].
    ///
    /// # Errors
    /// Those of surfaces.
    pub(super) fn transient(&self, edge: &EdgeProfile, face: f64) -> Result<Transient> {
        let rim = self.edge.outer_radius();
        let within = PreHole::blind(2.0 * rim, self.height, self.edge).bottom_transient(edge);
        let level = BoundarySurface::Plane { height: face, slope: 0.0 };
        let beside = edge.clipped(rim.max(edge.inner_radius()), edge.outer_radius());
        let beside = beside.map(|beside| transient(&beside, &level, Cover::Whole)).transpose()?;
        match (within, beside) {
            (Some(a), Some(b)) => {
                let (first, last) =
                    (if a.first >= b.first { a } else { b }, if a.last <= b.last { a } else { b });
                Ok(Transient {
                    first: first.first,
                    first_radius: first.first_radius,
                    last: last.last,
                    last_radius: last.last_radius,
                })
            }
            (Some(one), None) | (None, Some(one)) => Ok(one),
            (None, None) => transient(edge, &level, Cover::Whole),
        }
    }

    /// Lowers the first passage into a body to the recess, where the edge between two radii goes in there.
    ///
    /// # Errors
    /// Those of surfaces.
    pub(super) fn lower(
        &self,
        passages: &mut [Passage],
        edge: &EdgeProfile,
        inner: f64,
        face: f64,
    ) -> Result<()> {
        let entries = passages.iter_mut().filter(|p| p.side == Side::Entry);
        let first = entries.max_by(|a, b| a.transient.first.total_cmp(&b.transient.first));
        let outside = edge.clipped(inner.max(edge.inner_radius()), edge.outer_radius());
        if let (Some(first), Some(outside)) = (first, outside) {
            first.transient = self.transient(&outside, face)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::DrillPoint;
    use proptest::prelude::*;

    #[test]
    fn a_rapid_move_ends_above_the_face_though_the_spot_is_deeper() {
        use crate::drilling::{DrillMethod, DrillSpec, plan_drill};
        use crate::tool::StepStage;
        let spot = DrillPoint::SinglePlane { angle: 90f64.to_radians() }.edge(7.0).unwrap();
        let level = |height: f64| BoundarySurface::Plane { height, slope: 0.0 };
        let twist = DrillPoint::SinglePlane { angle: 118f64.to_radians() };
        let stage = StepStage { diameter: 3.0, length: 2.0, shoulder: std::f64::consts::PI };
        let stepped = DrillPoint::Stepped { angle: 118f64.to_radians(), stages: vec![stage] };
        for (method, point) in [(DrillMethod::Drilling, twist), (DrillMethod::StepDrilling, stepped)] {
            let plain = DrillSpec::new(6.6, point, level(0.0), level(-20.0));
            let plain = DrillSpec { method, tolerance: 0.1, ..plain };
            let spotted = DrillSpec { mouth: Some(Mouth { height: -3.5, edge: spot }), ..plain.clone() };
            let [a, b] = [plain, spotted].map(|spec| plan_drill(&spec).unwrap());
            assert_eq!((a.travel.start, b.travel), (2.1, a.travel));
            assert!(b.entry.first < a.entry.first - 0.5, "{:?} {:?}", a.entry, b.entry);
            // What goes in on the way is that of the edge: of each diameter of a stepped one.
            let ins = b.passages.iter().filter(|p| p.side == Side::Entry).map(|p| p.transient);
            let first = ins.clone().map(|t| t.first).fold(f64::NEG_INFINITY, f64::max);
            let last = ins.map(|t| t.last).fold(f64::INFINITY, f64::min);
            assert!(
                (first - b.entry.first).abs() < 1e-9 && (last - b.entry.last).abs() < 1e-9,
                "{:?}",
                b.passages
            );
        }
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(200))]
        /// Dense places of the edge against the height of what stands below them.
        #[test]
        fn a_dense_edge_finds_the_same_transient(
            spot in 60.0..140.0f64, rim in 2.0..6.0f64, angle in 60.0..179.0f64, inner in 0.0..3.5f64, lips in any::<bool>(),
        ) {
            let made = DrillPoint::SinglePlane { angle: spot.to_radians() }.edge(2.0 * rim).unwrap();
            let [low, high] = made.extent();
            let mouth = Mouth { height: 1.5 - (high - low), edge: made };
            let point = match lips {
                true => DrillPoint::Rounded { radius: 5.0 },
                false => DrillPoint::SinglePlane { angle: angle.to_radians() },
            };
            let edge = point.edge(8.0).unwrap().clipped(inner, 4.0).unwrap();
            let t = mouth.transient(&edge, 1.5).unwrap();
            let (mut first, mut last) = (f64::NEG_INFINITY, f64::INFINITY);
            for segment in edge.segments() {
                let [a, b] = segment.range();
                for i in 0..=2000 {
                    let r = a + (b - a) * f64::from(i) / 2000.0;
                    // By the angle of the spot, not by its edge.
                    let below = if r < rim { 1.5 - (rim - r) / (0.5 * spot).to_radians().tan() } else { 1.5 };
                    let z = below - segment.height(r);
                    (first, last) = (first.max(z), last.min(z));
                }
            }
            prop_assert!(first <= t.first + 1e-9 && last >= t.last - 1e-9, "{first} {last} {t:?}");
            prop_assert!(t.first - first < 0.02 && last - t.last < 0.02, "{first} {last} {t:?}");
        }
    }
}
