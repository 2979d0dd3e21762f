//! The cut stock against the wanted part.
//!
//! A wanted part is anything that knows the signed distance of a point from its surface. The stock is exact at the
//! end points of its lines, so that is where it is measured; the vertices of its surface mesh are measured only to
//! colour pictures.

use glam::DVec3;
use rayon::prelude::*;

use super::{Axis, CutId, DexelGrid, EndPoint, unfixed};
use crate::base::{Code, Finding, Result};
use crate::geom::{Aabb, Mesh, MeshDistance};

/// A wanted surface.
pub trait Design: Sync {
    /// Distance [mm] of a point of the stock's surface from the wanted surface: positive where stock is left (the
    /// point is outside the wanted body), negative where it is gouged. NaN where nothing is wanted of the point.
    fn signed_distance(&self, p: DVec3) -> f64;

    /// The same for an end point of which the outward normal of the stock is known too: where surfaces meet, it
    /// tells to which of them the point belongs.
    fn signed_distance_facing(&self, p: DVec3, normal: DVec3) -> f64 {
        let _ = normal;
        self.signed_distance(p)
    }
}

impl Design for MeshDistance {
    fn signed_distance(&self, p: DVec3) -> f64 {
        self.signed(p)
    }
}

/// A cylindrical bore: wall, and floor if it is blind.
///
/// ```
/// use kinecut::stock::{Bore, Design};
/// let bore = Bore::new([0.0; 3].into(), [0.0, 0.0, 1.0].into(), 10.0, 30.0, true, 1.0).unwrap();
/// assert!((bore.signed_distance([9.98, 0.0, -5.0].into()) - 0.02).abs() < 1e-12); // stock left on the wall
/// assert!((bore.signed_distance([1.0, 2.0, -30.01].into()) + 0.01).abs() < 1e-12); // floor too deep
/// assert!(bore.signed_distance([14.0, 0.0, 0.0].into()).is_nan()); // the face around it
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bore {
    rim: DVec3,
    axis: DVec3,
    radius: f64,
    depth: f64,
    blind: bool,
    reach: f64,
}

/// Points this near to the planes of the rim, and of the lower end of a through bore, belong to the faces there and
/// not to the bore [mm]: a fraction of any tolerance, and more than the rounding of end points.
const FACE: f64 = 1e-3;

/// A surface whose normal has this cosine with the axis (45 degrees) or a greater one is a face or a floor, no wall.
const ACROSS: f64 = 0.707;

impl Bore {
    /// A bore from the centre of its rim, the direction out of it, radius and depth [mm]. `blind`: it has a floor.
    /// Points farther than `reach` [mm] from wall and floor belong to other surfaces, unless they lie inside.
    ///
    /// # Errors
    /// `KC0801` when a number is not finite, a length not positive, or the direction zero.
    pub fn new(rim: DVec3, out: DVec3, radius: f64, depth: f64, blind: bool, reach: f64) -> Result<Bore> {
        let refuse =
            |what: &str, value: f64| Finding::error(Code::GEOMETRY, what).value_mm(value).bound_mm(0.0);
        for (what, value) in [("radius", radius), ("depth", depth), ("reach", reach)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(refuse(&format!("the {what} of a wanted bore must be positive"), value).into());
            }
        }
        match out.try_normalize() {
            Some(axis) if rim.is_finite() => Ok(Bore { rim, axis, radius, depth, blind, reach }),
            _ => Err(refuse("the axis of a wanted bore is not a direction at a point", out.length()).into()),
        }
    }
}

impl Design for Bore {
    fn signed_distance(&self, p: DVec3) -> f64 {
        let q = p - self.rim;
        let height = q.dot(self.axis);
        let r = (q - height * self.axis).length();
        let (beyond, above) = (r - self.radius, height + self.depth);
        if height > FACE || (beyond > FACE && height > -FACE) {
            return f64::NAN;
        }
        if !self.blind {
            // The lower end is open: what lies there is the lower face, or nothing.
            let on_wall = above > FACE || (beyond < FACE && above >= -FACE);
            return if !on_wall || beyond > self.reach { f64::NAN } else { -beyond };
        }
        if beyond <= 0.0 && above >= 0.0 {
            return (-beyond).min(above);
        }
        let deep = beyond.max(0.0).hypot((-above).max(0.0));
        if deep > self.reach { f64::NAN } else { -deep }
    }

    fn signed_distance_facing(&self, p: DVec3, normal: DVec3) -> f64 {
        let along = normal.dot(self.axis);
        let floor = self.blind && along > 0.0 && (p - self.rim).dot(self.axis) < -FACE;
        if along.abs() > ACROSS && !floor { f64::NAN } else { self.signed_distance(p) }
    }
}

/// The worst of many deviations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorstEnd {
    /// How far [mm], not negative; zero when there was none.
    pub depth: f64,
    /// Where [mm].
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

/// Compares all end points of a body in a region (all of them, if none is given) with a wanted surface. Of equal
/// deviations the first counts, by axis and line, so that the answer does not depend on the number of threads.
pub fn deviation<G: DexelGrid + ?Sized>(
    grid: &G,
    design: &(impl Design + ?Sized),
    region: Option<Aabb>,
) -> DeviationSummary {
    let lattice = grid.lattice();
    let region = region.unwrap_or(Aabb { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY });
    let mut all = DeviationSummary::default();
    for axis in Axis::ALL {
        let (u, v) = axis.others();
        let within = |axis: Axis, at: f64| region.min[axis.index()] <= at && at <= region.max[axis.index()];
        let rows: Vec<DeviationSummary> = (0..lattice.counts[v.index()])
            .into_par_iter()
            .map(|b| {
                let mut row = DeviationSummary::default();
                let mut p = DVec3::ZERO;
                p[v.index()] = lattice.coordinate(v, b);
                if !within(v, p[v.index()]) {
                    return row;
                }
                for a in 0..lattice.counts[u.index()] {
                    p[u.index()] = lattice.coordinate(u, a);
                    if !within(u, p[u.index()]) {
                        continue;
                    }
                    for end in grid.line(axis, a, b).iter().flat_map(|i| [i.lo, i.hi]) {
                        p[axis.index()] = unfixed(end.at);
                        if within(axis, p[axis.index()]) {
                            row.note(design.signed_distance_facing(p, end.normal.normal()), p, end);
                        }
                    }
                }
                row
            })
            .collect();
        all = rows.into_iter().fold(all, DeviationSummary::and);
    }
    all
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

    fn and(self, other: DeviationSummary) -> DeviationSummary {
        DeviationSummary {
            gouge: self.gouge.or(other.gouge),
            left: self.left.or(other.left),
            ends: self.ends + other.ends,
        }
    }
}

/// Deviation [mm] at each vertex of a surface mesh; NaN where nothing is wanted.
pub fn deviation_at_vertices(mesh: &Mesh, design: &(impl Design + ?Sized)) -> Vec<f32> {
    mesh.vertices.par_iter().map(|&v| design.signed_distance(v) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::Silent;
    use crate::stock::surface::bodies::{Solid, TestGrid, cuboid};
    use crate::stock::surface::{SurfaceOptions, surface};

    /// A plate with a blind bore of a radius, its axis shifted by `off`.
    fn plate(radius: f64, floor: f64, off: f64) -> TestGrid {
        let (min, max) = (DVec3::new(-8.0, -8.0, -5.0), DVec3::new(8.0, 8.0, 0.0));
        let bore = Solid::Cylinder(DVec3::new(off, 0.0, 0.0), DVec3::Z, radius);
        let above = Solid::Planes(vec![(-DVec3::Z, -floor)]);
        TestGrid::of(min, max, 0.2, &cuboid(min, max), &[vec![bore, above]])
    }

    fn wanted(blind: bool) -> Bore {
        Bore::new(DVec3::ZERO, 2.0 * DVec3::Z, 6.0, if blind { 3.0 } else { 5.0 }, blind, 1.0).unwrap()
    }

    #[test]
    fn a_right_bore_deviates_by_nothing() {
        let d = deviation(&plate(6.0, -3.0, 0.0), &wanted(true), None);
        assert!(d.gouge.depth < 1e-5 && d.left.depth < 1e-5 && d.ends > 4000, "{d:?}");
    }

    #[test]
    fn a_shifted_bore_is_left_on_one_side_and_gouged_on_the_other() {
        let d = deviation(&plate(6.0, -3.04, 0.1), &wanted(true), None);
        assert!((d.gouge.depth - 0.1).abs() < 1e-3 && d.gouge.point.x > 5.9, "{d:?}");
        assert!((d.left.depth - 0.1).abs() < 1e-3 && d.left.point.x < -5.8, "{d:?}");
        // In the middle only the floor is met.
        let middle = Aabb { min: DVec3::new(-3.0, -3.0, -9.0), max: DVec3::new(3.0, 3.0, 9.0) };
        let d = deviation(&plate(6.0, -3.04, 0.1), &wanted(true), Some(middle));
        assert!((d.gouge.depth - 0.04).abs() < 1e-5 && d.left.depth == 0.0 && d.ends == 30 * 30, "{d:?}");
    }

    #[test]
    fn a_through_bore_has_a_wall_only() {
        let d = deviation(&plate(5.99, -9.0, 0.0), &wanted(false), None);
        assert!((d.left.depth - 0.01).abs() < 1e-5 && d.gouge.depth == 0.0, "{d:?}");
        // The lower face reaches up to the wall: here its nearest line is 0.5 um beside it.
        let radius = 3.5f64.hypot(4.9) - 0.0005;
        let bore = Bore::new(DVec3::ZERO, DVec3::Z, radius, 5.0, false, 1.0).unwrap();
        let d = deviation(&plate(radius, -9.0, 0.0), &bore, None);
        assert!(d.left.depth < 1e-5 && d.gouge.depth < 1e-5 && d.ends > 4000, "{d:?}");
        for p in [[7.0, 0.0, 0.0], [6.2, 0.0, -5.0], [2.0, 0.0, -5.5], [8.0, 0.0, -2.0], [1.0, 1.0, 0.5]] {
            assert!(wanted(false).signed_distance(p.into()).is_nan(), "{p:?}");
        }
    }

    #[test]
    fn a_mesh_design_agrees_with_the_bore_and_vertices_with_both() {
        let body = plate(5.98, -2.99, 0.0);
        let wish = surface(&plate(6.0, -3.0, 0.0), &SurfaceOptions::default(), &Silent).unwrap();
        let design = MeshDistance::new(&wish).unwrap();
        let d = deviation(&body, &design, None);
        // The wanted mesh is within a fiftieth of the step, 0.004 mm.
        assert!((d.left.depth - 0.02).abs() < 0.004 && d.gouge.depth < 1e-4, "{d:?}");
        let mesh = surface(&body, &SurfaceOptions::default(), &Silent).unwrap();
        let at = deviation_at_vertices(&mesh, &wanted(true));
        assert_eq!(at.len(), mesh.vertices.len());
        for (v, d) in mesh.vertices.iter().zip(at) {
            let r = v.truncate().length();
            match d {
                // Vertices of the wall, of the floor, and of the faces around.
                d if d.is_nan() => assert!(r > 5.9 || v.z < -4.9, "{v}"),
                d if v.z > -2.95 => assert!((f64::from(d) - 0.02).abs() < 1e-3, "{v} {d}"),
                d => assert!((f64::from(d) - 0.01).abs() < 1e-3, "{v} {d}"),
            }
        }
    }

    #[test]
    fn a_bore_without_size_is_refused() {
        for (radius, out) in [(0.0, DVec3::Z), (f64::NAN, DVec3::Z), (1.0, DVec3::ZERO)] {
            let error = Bore::new(DVec3::ZERO, out, radius, 1.0, true, 1.0).unwrap_err();
            assert_eq!(error.code(), Code::GEOMETRY);
        }
    }
}
