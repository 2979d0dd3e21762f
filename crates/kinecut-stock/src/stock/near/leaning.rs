//! Material near a tool whose axis leans, by the lines along the axis of the stock that is nearest to its own.

use glam::DVec3;

use crate::stock::tri_dexel::LINE_OFFSET;
use crate::stock::{Axis, DexelGrid, Interval, unfixed};

/// Calls for the upper end of each line along the axis nearest to a direction.
fn upper_ends<G: DexelGrid + ?Sized>(stock: &G, axis: DVec3, mut each: impl FnMut(DVec3)) {
    let along = Axis::nearest(axis);
    let (a, b) = along.others();
    let lattice = stock.lattice();
    let counts = lattice.counts;
    for j in 0..counts[b.index()] {
        for i in 0..counts[a.index()] {
            let line = stock.line(along, i, j);
            let end = if axis[along.index()] > 0.0 {
                line.last().map(|last| last.hi)
            } else {
                line.first().map(|first| first.lo)
            };
            if let Some(end) = end {
                let mut point = DVec3::ZERO;
                point[a.index()] = lattice.coordinate(a, i) + LINE_OFFSET;
                point[b.index()] = lattice.coordinate(b, j) + LINE_OFFSET;
                point[along.index()] = unfixed(end.at);
                each(point);
            }
        }
    }
}

/// See [`super::highest`].
pub(super) fn highest<G: DexelGrid + ?Sized>(stock: &G, axis: DVec3) -> Option<f64> {
    let mut top: Option<f64> = None;
    upper_ends(stock, axis, |point| {
        let height = point.dot(axis);
        top = Some(top.map_or(height, |t| if height > t { height } else { t }));
    });
    top
}

/// See [`super::tops`].
pub(super) fn tops<G: DexelGrid + ?Sized>(stock: &G, at: DVec3, axis: DVec3, radii: [f64; 2]) -> Vec<f64> {
    let mut found = Vec::new();
    upper_ends(stock, axis, |point| {
        let from = point - at;
        let beside = (from - axis * from.dot(axis)).length();
        if beside >= radii[0] && beside <= radii[1] {
            found.push(point.dot(axis));
        }
    });
    found
}

/// See [`super::face_below`].
pub(super) fn face_below<G: DexelGrid + ?Sized>(
    stock: &G,
    tip: DVec3,
    axis: DVec3,
    radius: f64,
    reach: f64,
) -> Option<DVec3> {
    /// Length of the mean of unit normals below which they cancel one another.
    const ONE_WAY: f64 = 0.5;
    /// Lines below which the normals of a round face may not cancel as they should.
    const FEWEST: u32 = 8;
    let along = Axis::nearest(axis);
    let (a, b) = along.others();
    let lattice = stock.lattice();
    let ends = [tip, tip - axis * reach];
    let index = |of: Axis, x: f64| ((x - LINE_OFFSET - lattice.origin[of.index()]) / lattice.step).round();
    let range = |of: Axis| {
        let k = of.index();
        let [low, high] = [ends[0][k].min(ends[1][k]) - radius, ends[0][k].max(ends[1][k]) + radius];
        let count = f64::from(lattice.counts[k]);
        index(of, low).clamp(0.0, count) as u32..(index(of, high) + 1.0).clamp(0.0, count) as u32
    };
    let mut tops: Vec<(f64, DVec3)> = Vec::new();
    for j in range(b) {
        for i in range(a) {
            let mut point = DVec3::ZERO;
            point[a.index()] = lattice.coordinate(a, i) + LINE_OFFSET;
            point[b.index()] = lattice.coordinate(b, j) + LINE_OFFSET;
            let upper = |part: &Interval| if axis[along.index()] > 0.0 { part.hi } else { part.lo };
            for end in stock.line(along, i, j).iter().map(upper) {
                point[along.index()] = unfixed(end.at);
                let from = point - tip;
                let height = from.dot(axis);
                if (from - axis * height).length() <= radius && height <= 0.0 && height >= -reach {
                    tops.push((height, end.normal.normal()));
                }
            }
        }
    }
    let highest = tops.iter().map(|(height, _)| *height).fold(f64::NEG_INFINITY, f64::max);
    let first = tops.iter().filter(|(height, _)| *height >= highest - radius);
    let (count, sum) = first.fold((0u32, DVec3::ZERO), |(n, sum), (_, normal)| (n + 1, sum + *normal));
    let mean = sum / f64::from(count.max(1));
    mean.try_normalize().filter(|_| mean.length() > ONE_WAY && count >= FEWEST)
}

/// See [`super::above`]: counted at every quarter of a step.
pub(super) fn above<G: DexelGrid + ?Sized>(stock: &G, tip: DVec3, axis: DVec3) -> f64 {
    let along = Axis::nearest(axis);
    let (a, b) = along.others();
    let lattice = stock.lattice();
    let apart = 0.25 * lattice.step;
    // Between the heights of the box of the lines.
    let size = DVec3::from_array(lattice.counts.map(f64::from)) * lattice.step;
    let ends = [lattice.origin - lattice.step, lattice.origin + size];
    let [from, to] = (0..3).fold([0.0, f64::INFINITY], |[from, to]: [f64; 2], i| {
        if axis[i] == 0.0 {
            return [from, to];
        }
        let ends = ends.map(|x| (x[i] - tip[i]) / axis[i]);
        let (low, high) = if ends[0] < ends[1] { (ends[0], ends[1]) } else { (ends[1], ends[0]) };
        [from.max(low), to.min(high)]
    });
    // Not a number and none at all alike.
    if !(to > from) {
        return 0.0;
    }
    let index = |axis: Axis, x: f64| -> Option<u32> {
        let i = ((x - LINE_OFFSET - lattice.origin[axis.index()]) / lattice.step).round();
        (i >= 0.0 && i < f64::from(lattice.counts[axis.index()])).then_some(i as u32)
    };
    let inside = |point: DVec3| {
        let Some((i, j)) = index(a, point[a.index()]).zip(index(b, point[b.index()])) else { return false };
        let z = point[along.index()];
        stock.line(along, i, j).iter().any(|part| unfixed(part.lo.at) < z && z < unfixed(part.hi.at))
    };
    let places = ((to - from) / apart).ceil();
    let apart = (to - from) / places;
    let met = (0..places as u64).filter(|k| inside(tip + axis * (from + apart * (*k as f64 + 0.5)))).count();
    met as f64 * apart
}

#[cfg(test)]
mod tests {
    use super::super::{above, face_below, highest, may_touch, tops, touches};
    use super::*;
    use crate::geom::{Aabb, Profile};
    use crate::stock::TriDexel;

    fn block() -> TriDexel {
        TriDexel::from_box(Aabb { min: DVec3::new(0.0, 0.0, -10.0), max: DVec3::new(20.0, 20.0, 0.0) }, 0.5)
            .unwrap()
    }

    /// Leans by 30 degrees towards X.
    fn lean() -> DVec3 {
        DVec3::new(0.5, 0.0, 0.75f64.sqrt())
    }

    #[test]
    fn heights_are_counted_along_the_axis_of_the_tool() {
        let corner = DVec3::new(20.0, 0.0, 0.0).dot(lean());
        let top = highest(&block(), lean()).unwrap();
        assert!(top <= corner && top > corner - 0.3, "{top}");
        let below = highest(&block(), -lean()).unwrap();
        assert!((below - 10.0 * 0.75f64.sqrt()).abs() < 0.3, "{below}");
        // From 4 mm below the top up along the axis.
        let deep = above(&block(), DVec3::new(10.0, 10.0, -4.0), lean(), 0.1);
        assert!((deep - 4.0 / 0.75f64.sqrt()).abs() < 0.25, "{deep}");
        assert_eq!(above(&block(), DVec3::new(10.0, 10.0, 0.1), lean(), 0.1), 0.0);
        assert_eq!(above(&block(), DVec3::new(40.0, 10.0, -4.0), lean(), 0.1), 0.0);
        let ring = tops(&block(), DVec3::new(10.0, 10.0, 0.0), lean(), [2.0, 3.0]);
        let (low, high) = ring.iter().fold((f64::MAX, f64::MIN), |(a, b), h| (a.min(*h), b.max(*h)));
        let middle = DVec3::new(10.0, 10.0, 0.0).dot(lean());
        // The ring is an ellipse on the top: 3 mm across the axis are 3.46 mm along X there.
        assert!((middle - low - 3.0 * 30f64.to_radians().tan()).abs() < 0.3, "{low}");
        assert!((high - middle - 3.0 * 30f64.to_radians().tan()).abs() < 0.3, "{high}");
    }

    #[test]
    fn the_face_below_a_tool_has_a_normal_where_lines_enough_meet_it() {
        let top = DVec3::new(10.0, 10.0, 0.0);
        let below = |axis: DVec3, radius: f64, reach: f64| {
            face_below(&block(), top + axis * 5.0, axis, radius, reach)
        };
        for axis in [lean(), DVec3::Z] {
            assert!(below(axis, 3.0, 9.0).unwrap().angle_between(DVec3::Z) < 1e-3);
            assert_eq!(below(axis, 3.0, 2.0), None);
            assert_eq!(below(axis, 0.4, 9.0), None);
        }
        let beside = DVec3::new(20.0, 10.0, -5.0) + DVec3::X * 5.0;
        assert!(face_below(&block(), beside, DVec3::X, 3.0, 9.0).unwrap().angle_between(DVec3::X) < 1e-3);
    }

    #[test]
    fn a_leaning_tool_touches_within_the_margin_and_not_beyond_it() {
        let ball = Profile::bull_nose(6.0, 3.0, 15.0).unwrap();
        let touched = |centre: DVec3| touches(&block(), &[(&ball, 0.0)], centre - lean() * 3.0, lean(), 0.05);
        assert!(touched(DVec3::new(10.1, 10.2, 3.04)) && !touched(DVec3::new(10.1, 10.2, 3.06)));
        assert!(touched(DVec3::new(10.1, -3.04, -5.0)) && !touched(DVec3::new(10.1, -3.06, -5.0)));
        // Along the side of the tool: the wall at X0 is met where the cylinder leans over it.
        let mill = Profile::cylinder(6.0, 40.0).unwrap();
        let over = DVec3::new(-20.0, 10.0, -15.0);
        let gap = |x: f64| touches(&block(), &[(&mill, 0.0)], over + DVec3::X * x, lean(), 0.05);
        // The upper edge of the wall at X0 Z0 is 15 above the tip: from the axis by 3 mm across it.
        let x = 20.0 - 15.0 * 30f64.to_radians().tan() - 3.0 / 30f64.to_radians().cos();
        assert!(!gap(x - 0.2) && gap(x + 0.2));
    }

    #[test]
    fn what_touches_may_touch_and_what_is_far_may_not() {
        let (mill, ball) =
            (Profile::cylinder(6.0, 15.0).unwrap(), Profile::bull_nose(8.0, 4.0, 15.0).unwrap());
        let (stock, mut touched, mut apart) = (block(), 0, 0);
        for i in 0..3000u32 {
            // Places all about the block, and directions, spread evenly.
            let part = |irrational: f64, wide: f64| (f64::from(i) * irrational).fract() * wide;
            let tip = DVec3::new(
                part(0.414_213_56, 34.0) - 7.0,
                part(0.732_050_8, 34.0) - 7.0,
                part(0.236_067_98, 24.0) - 16.0,
            );
            let axis = DVec3::new(part(0.618_033_99, 2.0) - 1.0, part(0.324_717_96, 2.0) - 1.0, 1.1)
                .normalize_or(DVec3::Z);
            let parts = [(if i % 2 == 0 { &mill } else { &ball }, f64::from(i % 3) - 1.0)];
            let touches = touches(&stock, &parts, tip, axis, 0.05);
            let may = may_touch(&stock, &parts, tip, axis, 0.05);
            assert!(!touches || may, "{tip} {axis}");
            touched += u32::from(touches);
            apart += u32::from(!may);
        }
        assert!(touched > 500 && apart > 300, "{touched} {apart}");
    }
}
