//! The cut stock against a wanted part, given by the signed distance of a point from its surface: measured at the end points
//! of the stock's lines, where the stock is exact.

use glam::DVec3;

use super::{CutId, DexelGrid, EndMap, EndPoint};
use crate::base::Result;

/// The worst of many deviations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorstEnd {
    /// Depth [mm], not negative; zero when there was none.
    pub depth: f64,
    /// Place [mm].
    pub point: DVec3,
    /// The move that cut it.
    pub cut: CutId,
}

impl WorstEnd {
    /// The greater; of equal ones the first.
    fn or(self, other: WorstEnd) -> WorstEnd {
        if other.depth > self.depth { other } else { self }
    }
}

/// The cut stock against a wanted surface at the end points of its lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DeviationSummary {
    /// Deepest gouge.
    pub gouge: WorstEnd,
    /// Most stock left.
    pub left: WorstEnd,
    /// Number of end points measured.
    pub ends: u64,
}

/// The deviation of each end point of a body: what `distance` says of its place [mm], positive where stock is left (the point
/// lies outside of the wanted body), negative where it is gouged, NaN where nothing is wanted.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::{geom::Aabb, stock::{TriDexel, deviation, summary}};
/// let bounds = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.05].into() };
/// let stock = TriDexel::from_box(bounds, 0.5).unwrap();
/// // A face is wanted at height 0: there is 0.05 mm too much.
/// let above = deviation(&stock, |p| if p.z > -5.0 { p.z } else { f64::NAN }).unwrap();
/// assert!((summary(&stock, &above).left.depth - 0.05).abs() < 1e-9);
/// ```
///
/// # Errors
/// `KC0105` for a body with too many end points.
pub fn deviation<G: DexelGrid + ?Sized>(
    grid: &G,
    distance: impl Fn(DVec3) -> f64 + Sync,
) -> Result<EndMap<f64>> {
    let mut map = EndMap::new(grid, f64::NAN)?;
    map.replace(grid, |p, _, _| distance(p));
    Ok(map)
}

/// The worst of the deviations at the end points of a body. Of equal ones the first counts, by axis and line, so that the
/// answer does not depend on the number of threads.
pub fn summary<G: DexelGrid + ?Sized>(grid: &G, deviations: &EndMap<f64>) -> DeviationSummary {
    let mut all = DeviationSummary::default();
    deviations.visit(grid, |p, end, d| all.note(d, p, end));
    all
}

/// The first cut that went deeper into a wanted surface than a tolerance [mm], as far as it is still seen, with its deepest end.
pub fn first_gouge<G: DexelGrid + ?Sized>(
    grid: &G,
    deviations: &EndMap<f64>,
    tolerance: f64,
) -> Option<WorstEnd> {
    let mut first: Option<WorstEnd> = None;
    deviations.visit(grid, |point, end, d| {
        if d < -tolerance && end.cut != 0 && first.is_none_or(|f| (end.cut, f.depth) < (f.cut, -d)) {
            first = Some(WorstEnd { depth: -d, point, cut: end.cut });
        }
    });
    first
}

impl DeviationSummary {
    fn note(&mut self, distance: f64, point: DVec3, end: EndPoint) {
        if distance.is_nan() {
            return;
        }
        self.ends += 1;
        let worst = WorstEnd { depth: distance.abs(), point, cut: end.cut };
        if distance < 0.0 {
            self.gouge = self.gouge.or(worst);
        } else {
            self.left = self.left.or(worst);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::Silent;
    use crate::geom::MeshDistance;
    use crate::stock::surface::bodies::{Solid, TestGrid, cuboid};
    use crate::stock::surface::{SurfaceOptions, surface};

    /// A plate with a blind bore of a radius, its axis shifted by `off`.
    fn plate(radius: f64, floor: f64, off: f64) -> TestGrid {
        let (min, max) = (DVec3::new(-8.0, -8.0, -5.0), DVec3::new(8.0, 8.0, 0.0));
        let bore = Solid::Cylinder(DVec3::new(off, 0.0, 0.0), DVec3::Z, radius);
        let above = Solid::Planes(vec![(-DVec3::Z, -floor)]);
        TestGrid::of(min, max, 0.2, &cuboid(min, max), &[vec![bore, above]])
    }

    /// Of a wall of radius 6 down to a floor at -3.
    fn wall(p: DVec3) -> f64 {
        let radius = p.truncate().length();
        if radius < 7.0 && p.z < -1e-3 && p.z > -2.9 { 6.0 - radius } else { f64::NAN }
    }

    #[test]
    fn a_shifted_bore_is_left_on_one_side_and_gouged_on_the_other() {
        let body = plate(6.0, -3.0, 0.1);
        let d = summary(&body, &deviation(&body, wall).unwrap());
        assert!((d.gouge.depth - 0.1).abs() < 1e-3 && d.gouge.point.x > 5.9, "{d:?}");
        assert!((d.left.depth - 0.1).abs() < 1e-3 && d.left.point.x < -5.8, "{d:?}");
        let right = plate(6.0, -3.0, 0.0);
        let d = summary(&right, &deviation(&right, wall).unwrap());
        assert!(d.gouge.depth < 1e-5 && d.left.depth < 1e-5 && d.ends > 1000, "{d:?}");
    }

    #[test]
    fn a_mesh_design_shows_what_the_cylinder_does() {
        let body = plate(5.98, -2.99, 0.0);
        let wish = surface(&plate(6.0, -3.0, 0.0), &SurfaceOptions::default(), &Silent).unwrap();
        let design = MeshDistance::new(&wish).unwrap();
        let d = summary(&body, &deviation(&body, |p| design.signed(p)).unwrap());
        // The wanted mesh is within a fiftieth of the step, 0.004 mm.
        assert!((d.left.depth - 0.02).abs() < 0.004 && d.gouge.depth < 1e-4, "{d:?}");
    }
}
