//! End points and intervals on a line, twelve bytes an end.

use glam::DVec3;

/// Resolution of an end point [mm]: 10 nm, so that an `i32` spans 42 m.
pub const FIXED_STEP: f64 = 1e-5;

/// A coordinate [mm] as fixed point, rounded to the nearest step and kept in range.
pub fn fixed(mm: f64) -> i32 {
    // Half away from zero by a cast: it keeps in range by itself and, unlike `round`, is no call of the C library.
    (mm * (1.0 / FIXED_STEP) + 0.5f64.copysign(mm)).clamp(-2_147_483_647.0, 2_147_483_647.0) as i32
}

/// A fixed-point coordinate in mm.
pub fn unfixed(value: i32) -> f64 {
    f64::from(value) * FIXED_STEP
}

/// The move that made an end point: its index in the list of moves plus one; 0 is the surface of the raw stock.
pub type CutId = u32;

/// An outward unit normal in 24 bits (octahedral, exact for the axis directions; error under 0.06 degrees) and
/// a face class in 8 bits: end points of one class of one cut lie on one smooth face of the tool's sweep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PackedNormal(pub u32);

impl PackedNormal {
    const MAX: f64 = 2047.0;

    /// Packs an outward normal (need not be of unit length, must not be zero) and a class.
    pub fn new(normal: DVec3, class: u8) -> PackedNormal {
        let n = normal / (normal.x.abs() + normal.y.abs() + normal.z.abs());
        let (mut u, mut v) = (n.x, n.y);
        if n.z < 0.0 {
            (u, v) = ((1.0 - n.y.abs()) * 1f64.copysign(n.x), (1.0 - n.x.abs()) * 1f64.copysign(n.y));
        }
        // Rounded by the cast: w + 1 is not negative.
        let q = |w: f64| ((w + 1.0) * Self::MAX + 1.5) as u32 & 0xfff;
        PackedNormal(q(u) | q(v) << 12 | u32::from(class) << 24)
    }

    /// The unit normal.
    pub fn normal(self) -> DVec3 {
        let f = |w: u32| f64::from((w & 0xfff) as i32 - 2048) / Self::MAX;
        let (u, v) = (f(self.0), f(self.0 >> 12));
        let z = 1.0 - u.abs() - v.abs();
        let n = if z >= 0.0 {
            DVec3::new(u, v, z)
        } else {
            DVec3::new((1.0 - v.abs()) * 1f64.copysign(u), (1.0 - u.abs()) * 1f64.copysign(v), z)
        };
        n / n.length()
    }

    /// The face class.
    pub fn class(self) -> u8 {
        (self.0 >> 24) as u8
    }
}

/// One end of an interval.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EndPoint {
    /// Absolute coordinate along the line in steps of [`FIXED_STEP`].
    pub at: i32,
    /// Outward normal of the material there, and face class.
    pub normal: PackedNormal,
    /// The move that cut it.
    pub cut: CutId,
}

/// Material from `lo.at` to `hi.at` on a line; half open, `lo.at < hi.at`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Interval {
    /// Lower end.
    pub lo: EndPoint,
    /// Upper end.
    pub hi: EndPoint,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axis_normals_are_exact_and_others_within_six_hundredths_of_a_degree() {
        for n in [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z] {
            assert_eq!(PackedNormal::new(n, 7).normal(), n);
            assert_eq!(PackedNormal::new(n, 7).class(), 7);
        }
        let mut worst: f64 = 1.0;
        for i in 0..2000 {
            let z = -1.0 + 2.0 * (f64::from(i) + 0.5) / 2000.0;
            let (s, c) = (f64::from(i) * 2.399963).sin_cos();
            let n = DVec3::new(c * (1.0 - z * z).sqrt(), s * (1.0 - z * z).sqrt(), z);
            worst = worst.min(PackedNormal::new(n, 0).normal().dot(n));
        }
        assert!(worst.acos().to_degrees() < 0.06, "{}", worst.acos().to_degrees());
    }
}
