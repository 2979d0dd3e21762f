//! The lattice that the three grids share, and the view of a tri-dexel body that its surface is made from.

use glam::DVec3;
use serde::Serialize;

use super::{Interval, unfixed};

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub enum Axis {
    /// X.
    X,
    /// Y.
    Y,
    /// Z.
    Z,
}

impl Axis {
    /// The three axes in order.
    pub const ALL: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

    /// 0, 1 or 2.
    pub fn index(self) -> usize {
        self as usize
    }

    /// The axis that is nearest to a direction; of equally near ones the last.
    pub fn nearest(direction: DVec3) -> Axis {
        let size = direction.abs();
        if size.z >= size.x && size.z >= size.y {
            Axis::Z
        } else if size.y >= size.x {
            Axis::Y
        } else {
            Axis::X
        }
    }

    /// The two other axes in cyclic order: X -> (Y, Z), Y -> (Z, X), Z -> (X, Y). Lines along an axis are
    /// numbered by lattice indices along these two.
    pub fn others(self) -> (Axis, Axis) {
        match self {
            Axis::X => (Axis::Y, Axis::Z),
            Axis::Y => (Axis::Z, Axis::X),
            Axis::Z => (Axis::X, Axis::Y),
        }
    }
}

/// A cubic lattice of points `origin + step * (i, j, k)`, `0 <= i < counts[0]` and so on. The lattice of a
/// stock begins half a step inside its box, so that no line runs in a face of the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// The point (0, 0, 0) [mm].
    pub origin: DVec3,
    /// Distance of neighbouring points [mm].
    pub step: f64,
    /// Number of points along X, Y, Z.
    pub counts: [u32; 3],
}

impl Lattice {
    /// A lattice point [mm].
    pub fn point(&self, i: u32, j: u32, k: u32) -> DVec3 {
        self.origin + DVec3::new(f64::from(i), f64::from(j), f64::from(k)) * self.step
    }

    /// Coordinate of the index `i` along an axis [mm].
    pub fn coordinate(&self, axis: Axis, i: u32) -> f64 {
        self.origin[axis.index()] + f64::from(i) * self.step
    }
}

/// A body given by lines along three axes through the points of a lattice.
pub trait DexelGrid: Sync {
    /// The lattice.
    fn lattice(&self) -> &Lattice;

    /// The sorted, disjoint intervals of the line along `axis` through the lattice indices `a`, `b` along
    /// `axis.others()`.
    fn line(&self, axis: Axis, a: u32, b: u32) -> &[Interval];

    /// Whether a line has material between two coordinates along it [mm].
    fn has_material(&self, axis: Axis, [a, b]: [u32; 2], [low, high]: [f64; 2]) -> bool {
        self.line(axis, a, b).iter().any(|i| unfixed(i.lo.at) < high && unfixed(i.hi.at) > low)
    }
}
