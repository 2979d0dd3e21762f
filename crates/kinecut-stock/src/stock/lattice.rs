//! The lattice that the three grids share, and the view of a tri-dexel body that its surface is made from.

use std::ops::Range;

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

    /// The indices along an axis whose coordinates lie between two values [mm], and one more on each side; none beyond the ends.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::stock::{Axis, Lattice};
    /// let lattice = Lattice { origin: [0.5, 0.5, 0.5].into(), step: 1.0, counts: [10, 4, 4] };
    /// assert_eq!(lattice.between(Axis::X, [2.7, 4.1]), 2..5);
    /// assert_eq!(lattice.between(Axis::Y, [-9.0, 0.2]), 0..1);
    /// assert!(lattice.between(Axis::Z, [7.0, 9.0]).is_empty());
    /// ```
    pub fn between(&self, axis: Axis, [low, high]: [f64; 2]) -> Range<u32> {
        let (at, count) = (axis.index(), self.counts[axis.index()]);
        // Casts keep in range by themselves.
        let index = |x: f64| (x - self.origin[at]) / self.step;
        let from = index(low).floor() as u32;
        let to = (index(high).ceil() + 1.0) as u32;
        from.min(count)..to.min(count).max(from.min(count))
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
