//! Volumes with how far they may be off.
//!
//! The volume of the cut part is taken from its mesh, that of the raw stock from its solid; where the stock has holes
//! already, from the mesh of the stock with them.
//!
//! **Bound.** The vertices of the mesh lie within its tolerance of the surface, and so do those at its edges; a
//! facet over a surface of curvature 1 / R leaves it by s^2 / (12 R) in the mean over a step s, a fiftieth of a step ([`BENT`]) at
//! R = 4 s. Both together, times the area that is not flat raw stock, are the most that the volume is off.
//! Measured with a tolerance of a fiftieth of a step on holes, slots, ball rasters and bars down to R = 1.25 s it is off by half of
//! that at most, and mostly by a tenth. What is thinner than the lines may not be in the mesh at all.

use crate::geom::{Mesh, Solid};
use crate::stock::surface::{CutSurface, SurfaceOptions};

/// Distance of facets from a bent surface, in the mean [grid steps].
const BENT: f64 = 0.02;

/// A volume.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::base::Silent;
/// use kinecut::geom::{Aabb, Solid};
/// use kinecut::stock::surface::{SurfaceOptions, surface_with_cuts};
/// use kinecut::stock::{TriDexel, Volume};
/// let bounds = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
/// let stock = TriDexel::from_box(bounds, 0.7).unwrap();
/// let options = SurfaceOptions::default();
/// let surface = surface_with_cuts(&stock, &options, &Silent).unwrap();
/// let removed = Volume::of_solid(&Solid::Box(bounds)).less(Volume::of_surface(&surface, &options, 0.7, true));
/// assert!(removed.value.abs() <= removed.bound + 1e-6);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Volume {
    /// The volume [mm^3].
    pub value: f64,
    /// The true volume is no farther from `value` than this [mm^3].
    pub bound: f64,
}

impl Volume {
    /// The volume of a solid, exact up to rounding.
    pub fn of_solid(solid: &Solid) -> Volume {
        let value = match solid {
            Solid::Box(bounds) => bounds.size().element_product(),
            Solid::Cylinder { radius, height, .. } => std::f64::consts::PI * radius * radius * height,
            Solid::Mesh(mesh) => mesh.volume(),
        };
        Volume { value, bound: 1e-12 * value.abs() }
    }

    /// The volume within a surface made with a tolerance from lines at a distance of `step` [mm]; `exact` when what no move has
    /// cut is a box, whose faces the mesh has exactly.
    pub fn of_surface(surface: &CutSurface, options: &SurfaceOptions, step: f64, exact: bool) -> Volume {
        let cuts = surface.mesh.triangles.iter().zip(&surface.cuts);
        let area: f64 =
            cuts.filter(|(_, cut)| !exact || **cut > 0).map(|(t, _)| area(&surface.mesh, *t)).sum();
        let value = surface.mesh.volume();
        Volume { value, bound: (options.tolerance(step) + BENT * step) * area + 1e-12 * value.abs() }
    }

    /// The volume taken away to leave `rest`.
    pub fn less(self, rest: Volume) -> Volume {
        Volume { value: self.value - rest.value, bound: self.bound + rest.bound }
    }

    /// Number of digits after the point at which the bound, in this unit of cubic millimetres, is shown: `least` or more.
    pub fn digits(self, unit: f64, least: usize) -> usize {
        /// Beyond it a volume has more digits than any scale.
        const MOST: f64 = 6.0;
        let digits = -(self.bound / unit).log10().floor();
        // Not a number or infinite where the bound is zero.
        if digits.is_finite() { (digits.clamp(0.0, MOST) as usize).max(least) } else { least }
    }
}

/// Area of a triangle [mm^2].
fn area(mesh: &Mesh, triangle: [u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize]);
    0.5 * (b - a).cross(c - a).length()
}
