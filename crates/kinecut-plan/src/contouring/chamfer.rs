//! A chamfer by a V cutter, in numbers: how deep and how far from the wall its tip runs.

/// A chamfer that the edge of a conical cutter makes along a contour, at an even distance from the wall.
///
/// The tip runs below the chamfer's lower edge, beside the wall, so that it does not cut. Source: the triangle of the cutter's
/// section over the wall.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::contouring::Chamfer;
/// let half_angle = 45f64.to_radians();
/// let chamfer = Chamfer { width: 1.0, half_angle, tip_diameter: 0.2, tip_clearance: 0.3 };
/// assert!((chamfer.depth() - 1.3).abs() < 1e-12 && (chamfer.offset() - 0.4).abs() < 1e-12);
/// assert!((chamfer.top_radius() - 1.4).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chamfer {
    /// Width, in the plane of the edge [mm].
    pub width: f64,
    /// Angle between the cutter's axis and its edge [rad].
    pub half_angle: f64,
    /// Diameter of the cutter's flat tip [mm].
    pub tip_diameter: f64,
    /// Depth of the tip below the lower edge of the chamfer [mm].
    pub tip_clearance: f64,
}

impl Chamfer {
    /// Height of the chamfer [mm].
    pub fn leg(&self) -> f64 {
        self.width / self.half_angle.tan()
    }

    /// Depth of the tip below the edge [mm].
    pub fn depth(&self) -> f64 {
        self.leg() + self.tip_clearance
    }

    /// Distance of the cutter's axis from the wall [mm].
    pub fn offset(&self) -> f64 {
        0.5 * self.tip_diameter + self.tip_clearance * self.half_angle.tan()
    }

    /// Radius of the cutter at the height of the edge, the largest that cuts [mm].
    pub fn top_radius(&self) -> f64 {
        self.offset() + self.width
    }
}
