//! Material near a tool along an axis of the stock.
//!
//! Lines along the axis see floors, lines across it see walls: both are exact along themselves, so a wall or floor is found at
//! any distance of the lines, provided the tool is thicker than that.

use glam::DVec3;

use crate::geom::Profile;
use crate::stock::cut::CutAxis;
use crate::stock::tri_dexel::LINE_OFFSET;
use crate::stock::{Axis, DexelGrid, EndPoint, Interval, Lattice, unfixed};

/// Height of the highest material of all [mm], if there is any.
pub(super) fn highest<G: DexelGrid + ?Sized>(stock: &G, axis: CutAxis) -> Option<f64> {
    let (a, b) = axis.along().others();
    let counts = stock.lattice().counts;
    let mut top: Option<f64> = None;
    for j in 0..counts[b.index()] {
        for i in 0..counts[a.index()] {
            let line = stock.line(axis.along(), i, j);
            let end = if axis.sign() > 0.0 { line.last() } else { line.first() };
            if let Some(end) = end.map(|i| heights(i, axis)[1])
                && top.is_none_or(|t| end > t)
            {
                top = Some(end);
            }
        }
    }
    top
}

/// Longest stretch of material above the height of `tip` on a line along the axis that is at most `radius` from it [mm].
/// The circle is made wide enough for a line.
pub(super) fn above<G: DexelGrid + ?Sized>(stock: &G, tip: DVec3, axis: CutAxis, radius: f64) -> f64 {
    let floor = tip.dot(axis.vector());
    let mut longest: f64 = 0.0;
    columns(stock, tip, axis, radius, |_, [a, b]| {
        let length: f64 = stock
            .line(axis.along(), a, b)
            .iter()
            .map(|i| heights(i, axis))
            .map(|[lo, hi]| (hi - if lo > floor { lo } else { floor }).max(0.0))
            .sum();
        longest = longest.max(length);
    });
    longest
}

/// Heights at which material ends upwards on the lines along the axis whose distance from `at` is between two radii.
pub(super) fn tops<G: DexelGrid + ?Sized>(stock: &G, at: DVec3, axis: CutAxis, radii: [f64; 2]) -> Vec<f64> {
    let mut found = Vec::new();
    columns(stock, at, axis, radii[1], |r, [a, b]| {
        let line = stock.line(axis.along(), a, b);
        let end = if axis.sign() > 0.0 { line.last() } else { line.first() };
        if r >= radii[0] {
            found.extend(end.map(|i| heights(i, axis)[1]));
        }
    });
    found
}

/// True if a tool at rest at `tip` touches material: if one of its parts, with a `margin` [mm] on all sides, overlaps
/// some. Parts are given with their heights above the tip [mm]; their radius is taken not to fall upwards.
pub(super) fn touches<G: DexelGrid + ?Sized>(
    stock: &G,
    parts: &[(&Profile, f64)],
    tip: DVec3,
    axis: CutAxis,
    margin: f64,
) -> bool {
    parts.iter().any(|(profile, at)| {
        let foot = tip + axis.vector() * *at;
        on_floor(stock, profile, foot, axis, margin) || at_wall(stock, profile, foot, axis, margin)
    })
}

fn on_floor<G: DexelGrid + ?Sized>(
    stock: &G,
    profile: &Profile,
    foot: DVec3,
    axis: CutAxis,
    margin: f64,
) -> bool {
    let base = foot.dot(axis.vector());
    any_column(stock, foot, axis, profile.max_radius() + margin, |r, line| {
        let from = base + lowest(profile, r - margin) - margin;
        stock.has_material(axis.along(), line, between(axis, from, base + profile.top()))
    })
}

/// True if a line along the axis, in a tool at rest at `tip` or next to it, has material at the heights of the tool.
pub(super) fn may_touch<G: DexelGrid + ?Sized>(
    stock: &G,
    parts: &[(&Profile, f64)],
    tip: DVec3,
    axis: CutAxis,
    margin: f64,
) -> bool {
    /// From a wall to the line behind it: more than the diagonal of a square of lines [steps].
    const BEHIND: f64 = 1.5;
    parts.iter().any(|(profile, at)| {
        let heights = [profile.bottom() - margin, profile.top()];
        let [from, to] = heights.map(|z| tip.dot(axis.vector()) + at + z);
        let radius = profile.max_radius() + margin + BEHIND * stock.lattice().step;
        let has_material = |line| stock.has_material(axis.along(), line, between(axis, from, to));
        any_column(stock, tip, axis, radius, |_, line| has_material(line))
    })
}

/// The lowest height at which a profile is as wide as `r` [mm].
fn lowest(profile: &Profile, r: f64) -> f64 {
    let (mut below, mut wide) = (profile.bottom(), profile.top());
    if profile.radius(below) >= r {
        return below;
    }
    // To a tenth of a micrometre over any tool.
    for _ in 0..24 {
        let middle = 0.5 * (below + wide);
        if profile.radius(middle) >= r { wide = middle } else { below = middle }
    }
    wide
}

/// Layers next to the foot of a part that are all looked at, and the approximate number of layers in all.
const FOOT: usize = 8;
const MOST_LAYERS: usize = 24;

/// The layers of the lattice across an axis between two heights above a point, the lowest first.
fn indices_along(lattice: &Lattice, foot: DVec3, axis: CutAxis, heights: [f64; 2]) -> Vec<u32> {
    let at = foot[axis.along().index()];
    let ends = heights.map(|h| at + axis.sign() * h);
    let (from, to) = if ends[0] < ends[1] { (ends[0], ends[1]) } else { (ends[1], ends[0]) };
    let mut layers: Vec<u32> = indices(lattice, axis.along(), from, to).collect();
    if axis.sign() < 0.0 {
        layers.reverse();
    }
    layers
}

/// A surface whose normal has less than this across the axis is a floor.
const LEANS: f64 = 0.7;

fn at_wall<G: DexelGrid + ?Sized>(
    stock: &G,
    profile: &Profile,
    foot: DVec3,
    axis: CutAxis,
    margin: f64,
) -> bool {
    let lattice = stock.lattice();
    let up = axis.along();
    let (first, second) = up.others();
    let layers = indices_along(lattice, foot, axis, [profile.bottom(), profile.top()]);
    // All layers near the foot, and of those above it some.
    let (foot_layers, few) = (FOOT.min(layers.len()), (layers.len() / MOST_LAYERS).max(1));
    for (k, layer) in layers.into_iter().enumerate() {
        if k >= foot_layers && k % few != 0 {
            continue;
        }
        let z = axis.sign() * (lattice.coordinate(up, layer) + LINE_OFFSET) - foot.dot(axis.vector());
        if z < profile.bottom() || z > profile.top() {
            continue;
        }
        let reach = profile.radius(z) + margin;
        for along in [first, second] {
            let other = if along == first { second } else { first };
            let centre = foot[other.index()];
            for i in indices(lattice, other, centre - reach - lattice.step, centre + reach + lattice.step) {
                let aside = lattice.coordinate(other, i) + LINE_OFFSET - centre;
                let half = (reach * reach - aside * aside).max(0.0).sqrt();
                let (from, to) = (foot[along.index()] - half, foot[along.index()] + half);
                let line = if along.others().0 == up {
                    stock.line(along, layer, i)
                } else {
                    stock.line(along, i, layer)
                };
                let reaches = |i: &Interval| unfixed(i.lo.at) < to && unfixed(i.hi.at) > from;
                if aside.abs() < reach && line.iter().any(reaches) {
                    return true;
                }
                // A line next to the place of touch: the wall goes on from its end across the normal there.
                let touched = |end: &EndPoint| {
                    let normal = end.normal.normal();
                    let [n, m] = [normal[along.index()], normal[other.index()]];
                    let [x, y] = [foot[along.index()] - unfixed(end.at), -aside];
                    let wide = n.hypot(m);
                    let (out, beside) = ((x * n + y * m) / wide, (y * n - x * m) / wide);
                    wide > LEANS && (0.0..reach).contains(&out) && beside.abs() <= lattice.step
                };
                if line.iter().any(|i| touched(&i.lo) || touched(&i.hi)) {
                    return true;
                }
            }
        }
    }
    false
}

/// Calls for each line along the axis that is at most `radius` from a point, with its distance and its indices.
fn columns<G: DexelGrid + ?Sized>(
    stock: &G,
    at: DVec3,
    axis: CutAxis,
    radius: f64,
    mut each: impl FnMut(f64, [u32; 2]),
) {
    any_column(stock, at, axis, radius, |r, line| {
        each(r, line);
        false
    });
}

/// True if something holds of a line along the axis that is at most `radius` from a point, by its distance and its indices.
fn any_column<G: DexelGrid + ?Sized>(
    stock: &G,
    at: DVec3,
    axis: CutAxis,
    radius: f64,
    mut holds: impl FnMut(f64, [u32; 2]) -> bool,
) -> bool {
    let lattice = stock.lattice();
    // Half the diagonal of a cell, and a little: a circle of that has a line in it.
    let radius = radius.max(0.75 * lattice.step);
    let (a, b) = axis.along().others();
    let centre = [at[a.index()], at[b.index()]];
    let [columns, mut rows] =
        [(a, 0), (b, 1)].map(|(axis, k)| indices(lattice, axis, centre[k] - radius, centre[k] + radius));
    rows.any(|j| {
        columns.clone().any(|i| {
            let x = lattice.coordinate(a, i) + LINE_OFFSET - centre[0];
            let y = lattice.coordinate(b, j) + LINE_OFFSET - centre[1];
            let r = x.hypot(y);
            r <= radius && holds(r, [i, j])
        })
    })
}

/// The indices of the lattice along an axis whose coordinates lie between two.
fn indices(lattice: &Lattice, axis: Axis, from: f64, to: f64) -> std::ops::Range<u32> {
    let index = |x: f64| (x - LINE_OFFSET - lattice.origin[axis.index()]) / lattice.step;
    let count = f64::from(lattice.counts[axis.index()]);
    let first = index(from).ceil().clamp(0.0, count);
    let end = (index(to).floor() + 1.0).clamp(first, count);
    first as u32..end as u32
}

/// The coordinates between two heights along the tool axis.
fn between(axis: CutAxis, from: f64, to: f64) -> [f64; 2] {
    if axis.sign() > 0.0 { [from, to] } else { [-to, -from] }
}

/// Lower and upper end of an interval, heights along the tool axis.
fn heights(interval: &Interval, axis: CutAxis) -> [f64; 2] {
    let [lo, hi] = [unfixed(interval.lo.at), unfixed(interval.hi.at)];
    if axis.sign() > 0.0 { [lo, hi] } else { [-hi, -lo] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Aabb;
    use crate::stock::TriDexel;

    /// A block of 20 x 20 x 10 below Z0, its lines coarse compared with what is asked.
    fn block() -> TriDexel {
        TriDexel::from_box(Aabb { min: DVec3::new(0.0, 0.0, -10.0), max: DVec3::new(20.0, 20.0, 0.0) }, 1.0)
            .unwrap()
    }

    #[test]
    fn a_wall_and_a_floor_are_touched_within_the_margin_and_not_beyond_it_from_all_sides() {
        let mill = Profile::cylinder(6.0, 15.0).unwrap();
        let touched = |tip: [f64; 3], axis| touches(&block(), &[(&mill, 0.0)], tip.into(), axis, 0.05);
        // Outside the wall at X20, radius 3.
        assert!(touched([23.04, 10.3, -4.0], CutAxis::PlusZ));
        assert!(!touched([23.06, 10.3, -4.0], CutAxis::PlusZ));
        assert!(touched([10.3, -3.04, -4.0], CutAxis::PlusZ));
        assert!(!touched([10.3, -3.06, -4.0], CutAxis::PlusZ));
        // On the top, and from below.
        assert!(touched([10.0, 10.0, 0.04], CutAxis::PlusZ) && !touched([10.0, 10.0, 0.06], CutAxis::PlusZ));
        assert!(touched([10.0, 10.0, -10.04], CutAxis::MinusZ));
        assert!(!touched([10.0, 10.0, -10.06], CutAxis::MinusZ));
        assert!(touched([-0.04, 10.0, -5.0], CutAxis::MinusX));
        assert!(!touched([-0.06, 10.0, -5.0], CutAxis::MinusX));
    }

    #[test]
    fn what_touches_may_touch_and_what_is_far_may_not() {
        let (mill, ball) =
            (Profile::cylinder(6.0, 15.0).unwrap(), Profile::bull_nose(8.0, 4.0, 15.0).unwrap());
        let stock = block();
        let mut touched = 0;
        for i in 0..4000u32 {
            // Places all about the block, spread evenly; a part that hangs lower than the tip's.
            let part = |irrational: f64, wide: f64| (f64::from(i) * irrational).fract() * wide;
            let tip = DVec3::new(
                part(0.414_213_56, 30.0) - 5.0,
                part(0.732_050_8, 30.0) - 5.0,
                part(0.236_067_98, 20.0) - 15.0,
            );
            let parts = [(if i % 2 == 0 { &mill } else { &ball }, f64::from(i % 3) - 1.0)];
            let axis = CutAxis::ALL[i as usize % 6];
            let touches = touches(&stock, &parts, tip, axis, 0.05);
            assert!(!touches || may_touch(&stock, &parts, tip, axis, 0.05), "{tip} {axis:?}");
            touched += u32::from(touches);
        }
        assert!((500..3500).contains(&touched), "{touched}");
        let beside =
            |x: f64| may_touch(&stock, &[(&mill, 0.0)], DVec3::new(x, 10.3, -4.0), CutAxis::PlusZ, 0.05);
        assert!(beside(23.04) && !beside(25.0));
    }

    #[test]
    fn a_ball_is_round_below() {
        let ball = Profile::bull_nose(8.0, 4.0, 15.0).unwrap();
        // At 3 outside the edge of the block the ball is 4 - sqrt(7) = 1.354 above its tip.
        let touched =
            |z: f64| touches(&block(), &[(&ball, 0.0)], DVec3::new(23.0, 10.0, z), CutAxis::PlusZ, 1e-3);
        assert!(touched(-1.9) && !touched(-1.3));
    }

    #[test]
    fn material_above_a_tip_and_the_tops_around_it_are_measured() {
        let above_it = |x: f64| above(&block(), DVec3::new(x, 10.0, -3.0), CutAxis::PlusZ, 0.1);
        assert!((above_it(10.0) - 3.0).abs() < 1e-4 && above_it(22.0) == 0.0);
        let below = above(&block(), DVec3::new(10.0, 10.0, -3.0), CutAxis::MinusZ, 0.1);
        assert!((below - 7.0).abs() < 1e-4, "{below}");
        let ring = tops(&block(), DVec3::new(10.0, 10.0, -3.0), CutAxis::PlusZ, [4.0, 5.5]);
        assert!(!ring.is_empty() && ring.iter().all(|t| t.abs() < 1e-4));
        assert_eq!(highest(&block(), CutAxis::MinusZ), Some(10.0));
    }
}
