//! The walls of the stock at one height: the ends of its lines there, with the normal of the surface.

use glam::DVec3;

use super::cut::CutAxis;
use super::{Axis, DexelGrid, unfixed};

/// An end of a line of the stock at a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallEnd {
    /// End of the line [part coordinates, mm].
    pub point: DVec3,
    /// Outward unit normal of the surface.
    pub normal: DVec3,
    /// Length of wall that the end represents [mm]: the distance of the lines, seen along the wall.
    pub length: f64,
}

/// The ends of the lines across `up` in the layer of the lattice that is nearest to the `height` along `up`, with the
/// height of that layer: each stretch of wall once, by the lines that meet it more steeply. Ends on faces that lean by
/// more than 45 degrees from `up` are floors and left out.
pub fn wall_ends(stock: &(impl DexelGrid + ?Sized), up: CutAxis, height: f64) -> (f64, Vec<WallEnd>) {
    let lattice = stock.lattice();
    let towards = up.vector();
    let axis = Axis::ALL.into_iter().find(|a| towards[a.index()] != 0.0).unwrap_or(Axis::Z);
    let sign = towards[axis.index()];
    let last = lattice.counts[axis.index()].saturating_sub(1);
    let place = (sign * height - lattice.origin[axis.index()]) / lattice.step;
    let layer = place.round().clamp(0.0, f64::from(last)) as u32;
    let across = axis.others();
    let mut ends = Vec::new();
    for along in [across.0, across.1] {
        let (a, b) = along.others();
        let fixed_first = a == axis;
        let other = if fixed_first { b } else { a };
        for i in 0..lattice.counts[other.index()] {
            let line = if fixed_first { (layer, i) } else { (i, layer) };
            for interval in stock.line(along, line.0, line.1) {
                for end in [interval.lo, interval.hi] {
                    let normal = end.normal.normal();
                    let steep = normal[along.index()].abs();
                    let floor = normal[axis.index()].abs() > std::f64::consts::FRAC_1_SQRT_2;
                    let flatter = steep < normal[other.index()].abs();
                    // At 45 degrees both lines meet it alike: the first one counts.
                    let alike = steep == normal[other.index()].abs() && along == across.1;
                    if floor || flatter || alike {
                        continue;
                    }
                    let mut point = DVec3::ZERO;
                    point[axis.index()] = lattice.coordinate(axis, layer);
                    point[other.index()] = lattice.coordinate(other, i);
                    point[along.index()] = unfixed(end.at);
                    ends.push(WallEnd { point, normal, length: lattice.step / steep });
                }
            }
        }
    }
    (sign * lattice.coordinate(axis, layer), ends)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::stock::TriDexel;

    #[test]
    fn the_wall_of_a_bar_is_as_long_as_its_circumference_and_stands_on_it() {
        let bar = TriDexel::from_cylinder(DVec3::new(3.0, -2.0, 1.0), 20.0, 10.0, 0.5).unwrap();
        let (height, ends) = wall_ends(&bar, CutAxis::PlusZ, 8.1);
        assert!((height - 8.1).abs() <= 0.25 + 1e-9);
        let length: f64 = ends.iter().map(|e| e.length).sum();
        // Each eighth of the circle may have an end more or less.
        assert!((length - TAU * 20.0).abs() < 8.0 * 0.5, "{length}");
        for end in &ends {
            let out = (end.point - DVec3::new(3.0, -2.0, end.point.z)) / 20.0;
            assert!((out - end.normal).length() < 2e-3 && end.point.z == height);
        }
    }

    #[test]
    fn seen_from_below_heights_are_counted_downwards() {
        let bar = TriDexel::from_cylinder(DVec3::ZERO, 5.0, 10.0, 0.5).unwrap();
        let (height, ends) = wall_ends(&bar, CutAxis::MinusZ, -2.0);
        assert!((height + 2.0).abs() <= 0.25 + 1e-9 && !ends.is_empty());
    }
}
