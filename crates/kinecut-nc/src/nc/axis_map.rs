//! Coordinates that are scaled and mirrored axis by axis: `q = factor p + shift`.

use glam::DVec3;

use crate::program::{Comp, Path};

use super::dialect::Plane;

/// Largest part by which two factors that are the same differ: decimals of a text.
const SAME: f64 = 1e-12;

/// A factor and a shift for each axis [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AxisMap {
    factor: DVec3,
    shift: DVec3,
}

impl AxisMap {
    pub(super) const IDENTITY: AxisMap = AxisMap { factor: DVec3::ONE, shift: DVec3::ZERO };

    /// That with these factors about a point.
    pub(super) fn about(centre: DVec3, factor: DVec3) -> AxisMap {
        AxisMap { factor, shift: centre - factor * centre }
    }

    /// `first`, then this.
    pub(super) fn after(&self, first: &AxisMap) -> AxisMap {
        AxisMap { factor: self.factor * first.factor, shift: self.factor * first.shift + self.shift }
    }

    pub(super) fn point(&self, p: DVec3) -> DVec3 {
        self.factor * p + self.shift
    }

    /// A place known in part, in the coordinates to which it maps.
    pub(super) fn place(&self, at: [Option<f64>; 3]) -> [Option<f64>; 3] {
        std::array::from_fn(|i| at[i].map(|v| self.factor[i] * v + self.shift[i]))
    }

    /// A place known in part, in the coordinates from which it maps.
    pub(super) fn place_before(&self, at: [Option<f64>; 3]) -> [Option<f64>; 3] {
        std::array::from_fn(|i| at[i].map(|v| (v - self.shift[i]) / self.factor[i]))
    }

    /// Whether it leaves an axis as it is.
    pub(super) fn keeps(&self, axis: usize) -> bool {
        self.factor[axis] == 1.0 && self.shift[axis] == 0.0
    }

    /// Whether it turns left into right in a plane.
    pub(super) fn mirrors(&self, plane: Plane) -> bool {
        let [a, b, _] = plane.axes();
        self.factor[a] * self.factor[b] < 0.0
    }

    /// Whether a circle of a plane stays a circle.
    pub(super) fn keeps_circles(&self, plane: Plane) -> bool {
        let [a, b, _] = plane.axes();
        let (a, b) = (self.factor[a].abs(), self.factor[b].abs());
        (a - b).abs() <= SAME * a
    }

    /// A path; arcs about a main axis of a plane whose circles stay circles.
    pub(super) fn path(&self, path: Path, plane: Plane) -> Path {
        let Path::Arc { centre, axis, sweep, rise } = path else { return path };
        let [_, _, n] = plane.axes();
        let sweep = if self.mirrors(plane) { -sweep } else { sweep };
        Path::Arc { centre: self.point(centre), axis, sweep, rise: rise * self.factor[n] }
    }

    /// The side of a cutter compensation in XY.
    pub(super) fn side(&self, comp: Comp) -> Comp {
        match comp {
            Comp::Left(register) if self.mirrors(Plane::Xy) => Comp::Right(register),
            Comp::Right(register) if self.mirrors(Plane::Xy) => Comp::Left(register),
            other => other,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_go_back_and_follow_one_another() {
        let twice = AxisMap::about(DVec3::new(1.0, 0.0, 5.0), DVec3::new(2.0, 2.0, 0.5));
        let mirror = AxisMap::about(DVec3::X * 3.0, DVec3::new(-1.0, 1.0, 1.0));
        let both = twice.after(&mirror);
        // 7 is mirrored to -1, and that is 2 from 1: -3.
        assert_eq!(both.point(DVec3::new(7.0, 4.0, 7.0)), DVec3::new(-3.0, 8.0, 6.0));
        let place = [Some(7.0), None, Some(7.0)];
        assert_eq!(both.place_before(both.place(place)), place);
        assert!(both.mirrors(Plane::Xy) && !both.mirrors(Plane::Yz));
        assert!(both.keeps_circles(Plane::Xy) && !both.keeps_circles(Plane::Zx));
        assert_eq!(both.side(Comp::Left(3)), Comp::Right(3));
        assert!(mirror.keeps(2) && !mirror.keeps(0) && !twice.keeps(2));
    }
}
