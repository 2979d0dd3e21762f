//! Raw stock: box, cylinder, and any simple solid.

use glam::{DVec2, DVec3};

use super::skimmed::Skimmed;
use super::tri_dexel::LINE_OFFSET;
use super::{Axis, DexelGrid, EndPoint, Interval, PackedNormal, TriDexel, fixed};
use crate::base::{Code, Finding, Result};
use crate::geom::{Aabb, Solid};

/// Face classes of raw stock: the faces of a box and of a cylinder; a mesh has class 0 everywhere.
pub(super) mod class {
    /// Faces normal to an axis: 2 * axis towards minus, one more towards plus.
    pub(in crate::stock) fn face(axis: usize, plus: bool) -> u8 {
        2 * axis as u8 + u8::from(plus)
    }
    /// The round side of a cylinder.
    pub(in crate::stock) const ROUND: u8 = 6;
    /// Ends at which only a part of the stock is looked at and its material goes on.
    pub(in crate::stock) const BEYOND: u8 = 255;
}

impl TriDexel {
    /// The stock of a solid.
    ///
    /// # Errors
    /// See [`TriDexel::from_box`], [`TriDexel::from_cylinder`], [`TriDexel::from_mesh`].
    pub fn from_solid(solid: &Solid, step: f64) -> Result<TriDexel> {
        match solid {
            Solid::Box(bounds) => TriDexel::from_box(*bounds, step),
            Solid::Cylinder { base, radius, height } => {
                TriDexel::from_cylinder(*base, *radius, *height, step)
            }
            Solid::Mesh(mesh) => TriDexel::from_mesh(mesh, step),
        }
    }

    /// The part of a solid within a box [mm], which must meet the solid's own.
    ///
    /// # Errors
    /// See [`TriDexel::from_solid`].
    pub fn part_of_solid(solid: &Solid, part: Aabb, step: f64) -> Result<TriDexel> {
        let whole = solid.bounds();
        let part = Aabb { min: whole.min.max(part.min), max: whole.max.min(part.max) };
        let mut stock = match solid {
            Solid::Box(_) => TriDexel::from_box(part, step)?,
            Solid::Cylinder { base, radius, .. } => TriDexel::of_cylinder(*base, *radius, part, step)?,
            Solid::Mesh(mesh) => TriDexel::of_mesh(mesh, part, step)?,
        };
        stock.end_at(part, whole);
        Ok(stock)
    }

    /// Ends all lines at the faces of a part of the stock, and marks where the material goes on.
    fn end_at(&mut self, part: Aabb, whole: Aabb) {
        let lattice = *self.lattice();
        for axis in Axis::ALL {
            let (a, b) = axis.others();
            let k = axis.index();
            let [lo, hi] = [fixed(part.min[k]), fixed(part.max[k])];
            let beyond = |at: i32, plus: bool| {
                let cut_off = if plus { part.max[k] < whole.max[k] } else { part.min[k] > whole.min[k] };
                let class = if cut_off { class::BEYOND } else { class::face(k, plus) };
                let normal = DVec3::AXES[k] * if plus { 1.0 } else { -1.0 };
                EndPoint { at, normal: PackedNormal::new(normal, class), cut: 0 }
            };
            for (i, j) in (0..lattice.counts[b.index()])
                .flat_map(|j| (0..lattice.counts[a.index()]).map(move |i| (i, j)))
            {
                let within = |x: &Interval| {
                    let low = if x.lo.at > lo { x.lo } else { beyond(lo, false) };
                    let high = if x.hi.at < hi { x.hi } else { beyond(hi, true) };
                    (low.at < high.at).then_some(Interval { lo: low, hi: high })
                };
                let line: Vec<Interval> = self.line(axis, i, j).iter().filter_map(within).collect();
                self.set_line(axis, i, j, &line);
            }
        }
    }

    /// A full box with lines at a distance of `step` [mm].
    ///
    /// # Errors
    /// See [`TriDexel::empty`].
    pub fn from_box(bounds: Aabb, step: f64) -> Result<TriDexel> {
        let mut stock = TriDexel::filled(bounds, step, Axis::ALL.map(|axis| Some(span(bounds, axis))))?;
        stock.skimmed = Skimmed::WHOLE;
        Ok(stock)
    }

    /// A full cylinder standing on `base`, its axis along Z [mm].
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::stock::TriDexel;
    /// let stock = TriDexel::from_cylinder([0.0, 0.0, -10.0].into(), 20.0, 10.0, 0.1).unwrap();
    /// let exact = std::f64::consts::PI * 400.0 * 10.0;
    /// assert!((stock.volume() / exact - 1.0).abs() < 1e-4);
    /// ```
    ///
    /// # Errors
    /// `KC0801` when a size is not positive; see also [`TriDexel::empty`].
    pub fn from_cylinder(base: DVec3, radius: f64, height: f64, step: f64) -> Result<TriDexel> {
        for size in [radius, height] {
            if !(size.is_finite() && size > 0.0) {
                return Err(Finding::error(Code::GEOMETRY, "the cylinder of the stock has no size")
                    .value_mm(size)
                    .bound_mm(0.0)
                    .into());
            }
        }
        TriDexel::of_cylinder(base, radius, Solid::Cylinder { base, radius, height }.bounds(), step)
    }

    /// The lines of an upright cylinder over a box no higher than it is.
    fn of_cylinder(base: DVec3, radius: f64, bounds: Aabb, step: f64) -> Result<TriDexel> {
        let mut stock = TriDexel::empty(bounds, step)?;
        let lattice = *stock.lattice();
        let [nx, ny, nz] = lattice.counts;
        let centre = DVec2::new(base.x, base.y);
        let beside = |axis: Axis, i: u32| lattice.coordinate(axis, i) + LINE_OFFSET;
        let upright = span(bounds, Axis::Z);
        for (i, j) in (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))) {
            let p = DVec2::new(beside(Axis::X, i), beside(Axis::Y, j));
            if (p - centre).length_squared() < radius * radius {
                stock.set_line(Axis::Z, i, j, &[upright]);
            }
        }
        for (along, across, n) in [(Axis::X, Axis::Y, ny), (Axis::Y, Axis::X, nx)] {
            for i in 0..n {
                let d = beside(across, i) - base[across.index()];
                let half = ((radius - d) * (radius + d)).clamp(0.0, f64::INFINITY).sqrt();
                let end = |sign: f64| {
                    let mut n = DVec3::ZERO;
                    n[along.index()] = sign * half;
                    n[across.index()] = d;
                    let at = fixed(base[along.index()] + sign * half);
                    EndPoint { at, normal: PackedNormal::new(n, class::ROUND), cut: 0 }
                };
                let (lo, hi) = (end(-1.0), end(1.0));
                for k in (0..nz).filter(|_| lo.at < hi.at) {
                    let (a, b) = if along == Axis::X { (i, k) } else { (k, i) };
                    stock.set_line(along, a, b, &[Interval { lo, hi }]);
                }
            }
        }
        Ok(stock)
    }
}

/// The whole box along an axis.
fn span(bounds: Aabb, axis: Axis) -> Interval {
    let i = axis.index();
    let end = |at: f64, plus: bool| {
        let mut n = DVec3::ZERO;
        n[i] = if plus { 1.0 } else { -1.0 };
        EndPoint { at: fixed(at), normal: PackedNormal::new(n, class::face(i, plus)), cut: 0 }
    };
    Interval { lo: end(bounds.min[i], false), hi: end(bounds.max[i], true) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stock::DexelGrid;

    #[test]
    fn a_box_has_the_same_volume_along_all_axes() {
        let bounds = Aabb { min: DVec3::new(-3.0, 1.0, -7.0), max: DVec3::new(7.0, 9.0, -2.0) };
        let stock = TriDexel::from_box(bounds, 0.5).unwrap();
        assert_eq!(stock.lattice().counts, [20, 16, 10]);
        assert_eq!(stock.lattice().origin, DVec3::new(-2.75, 1.25, -6.75));
        for v in stock.volumes() {
            assert!((v - 400.0).abs() < 1e-9, "{v}");
        }
    }

    #[test]
    fn a_box_that_is_no_multiple_of_the_step_has_no_line_outside() {
        let bounds = Aabb { min: DVec3::ZERO, max: DVec3::new(1.2, 1.25, 0.05) };
        let stock = TriDexel::from_box(bounds, 0.5).unwrap();
        // Points at 0.25 and 0.75; 1.25 lies in the face of Y and beyond X.
        assert_eq!(stock.lattice().counts, [2, 2, 1]);
        assert_eq!(stock.lattice().origin.z, 0.025);
        assert!(TriDexel::from_box(bounds, 0.0).is_err());
        assert!(TriDexel::from_box(bounds, f64::NAN).is_err());
        assert!(TriDexel::from_box(bounds, 1e-3 / 1e3).is_err());
        assert!(TriDexel::from_box(Aabb::EMPTY, 0.5).is_err());
        assert_eq!(TriDexel::memory(Aabb::EMPTY, 0.5), u64::MAX);
    }

    #[test]
    fn a_cylinder_stands_on_its_base_with_radial_normals() {
        let stock = TriDexel::from_cylinder(DVec3::new(5.0, -2.0, 1.0), 4.0, 3.0, 0.1).unwrap();
        let exact = std::f64::consts::PI * 16.0 * 3.0;
        for v in stock.volumes() {
            assert!((v / exact - 1.0).abs() < 1e-3, "{v} {exact}");
        }
        let lattice = *stock.lattice();
        for j in 0..lattice.counts[1] {
            for end in stock.line(Axis::X, j, 3).iter().flat_map(|i| [i.lo, i.hi]) {
                let d = DVec2::new(super::super::unfixed(end.at) - 5.0, lattice.coordinate(Axis::Y, j) + 2.0);
                assert!((d.length() - 4.0).abs() < 2e-5);
                let n = end.normal.normal();
                assert!((n.x * d.x + n.y * d.y) / d.length() > 0.999_99);
            }
        }
    }
}
