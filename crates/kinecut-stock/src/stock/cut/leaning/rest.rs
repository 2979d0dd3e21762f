//! A leaning tool at rest near material.

use std::f64::consts::SQRT_2;
use std::ops::Range;

use glam::DVec3;

use super::super::body::{ConvexPart, Foot, RevolvedParts};
use super::super::effect::met;
use super::chord::LineFrom;
use super::span::Pose;
use crate::geom::{Aabb, Profile};
use crate::stock::tri_dexel::LINE_OFFSET;
use crate::stock::{Axis, DexelGrid, EndPoint, Lattice, fixed, unfixed};

/// True if parts of a tool, made larger by a margin on all sides, overlap material on a line, or reach by no more than twice the
/// margin into the plane of a line's end that is no farther than the diagonal of four lines from there.
pub(in crate::stock) fn meets_at_rest<G: DexelGrid + ?Sized>(
    stock: &G,
    parts: &[(&Profile, f64)],
    tip: DVec3,
    axis: DVec3,
    margin: f64,
) -> bool {
    let body = RevolvedParts::new(parts.iter().copied()).shrunk(-margin);
    let lattice = stock.lattice();
    let pose = Pose { tip, axis, tip_rate: DVec3::ZERO, axis_rate: DVec3::ZERO };
    let beside = SQRT_2 * lattice.step;
    // Nearly all ends are farther from the part than those that count.
    let far = beside + 2.0 * margin;
    let is_beside = |point: DVec3, part: &ConvexPart| {
        let from = point - tip;
        let height = from.dot(axis);
        let aside = from.length_squared() - height * height;
        (part.z0 - far..=part.top + far).contains(&height) && aside <= (part.r1 + far).powi(2)
    };
    let on_lines = |part: &ConvexPart, along: Axis| {
        let ends = [part.z0, part.top].map(|z| tip + axis * z);
        let bounds = Aabb::of_points(ends).grown(part.r1 + far);
        let (a, b) = along.others();
        let range = |axis: Axis| lines_within(lattice, axis, bounds);
        // Across the lines and the axis, which they pass at no more than the radius.
        let across = DVec3::AXES[along.index()].cross(axis).normalize_or_zero();
        let [from, to] = [bounds.min, bounds.max].map(|p| p[along.index()]);
        range(b).any(|j| {
            range(a).any(|i| {
                let mut start = DVec3::ZERO;
                start[a.index()] = lattice.coordinate(a, i) + LINE_OFFSET;
                start[b.index()] = lattice.coordinate(b, j) + LINE_OFFSET;
                if (start - tip).dot(across).abs() > part.r1 + far {
                    return false;
                }
                let line = stock.line(along, i, j);
                if !line.iter().any(|i| unfixed(i.lo.at) <= to && unfixed(i.hi.at) >= from) {
                    return false;
                }
                let chord = LineFrom::new(start, along.index(), &pose).chord(part);
                if chord.is_some_and(|c| met(line, fixed(c.lo), fixed(c.hi)).0 > 0) {
                    return true;
                }
                let grazes = |end: &EndPoint| {
                    let mut point = start;
                    point[along.index()] = unfixed(end.at);
                    if !is_beside(point, part) {
                        return false;
                    }
                    let normal = end.normal.normal();
                    let off = point - deepest(part, &pose, -normal, point);
                    let depth = off.dot(normal);
                    (0.0..=2.0 * margin).contains(&depth) && (off - normal * depth).length() <= beside
                };
                line.iter().any(|i| grazes(&i.lo) || grazes(&i.hi))
            })
        })
    };
    // Those first that the tool is nearest to: they are cut in any case, and mostly say enough.
    let nearest = Axis::nearest(axis);
    let axes = [nearest, nearest.others().0, nearest.others().1];
    axes.into_iter().any(|along| body.parts.iter().any(|part| on_lines(part, along)))
}

/// False only if no line along the axis nearest to the tool's, in the tool made larger by a margin and the diagonal of four lines, has
/// material: then nothing but a wall thinner than the lines are apart can touch it.
pub(in crate::stock) fn may_meet_at_rest<G: DexelGrid + ?Sized>(
    stock: &G,
    parts: &[(&Profile, f64)],
    tip: DVec3,
    axis: DVec3,
    margin: f64,
) -> bool {
    let lattice = stock.lattice();
    let body = RevolvedParts::new(parts.iter().copied()).shrunk(-margin - SQRT_2 * lattice.step);
    let pose = Pose { tip, axis, tip_rate: DVec3::ZERO, axis_rate: DVec3::ZERO };
    let along = Axis::nearest(axis);
    let (a, b) = along.others();
    let touches = |part: &ConvexPart| {
        let ends = [part.z0, part.top].map(|z| tip + axis * z);
        let bounds = Aabb::of_points(ends).grown(part.r1);
        let range = |axis: Axis| lines_within(lattice, axis, bounds);
        range(b).any(|j| {
            range(a).any(|i| {
                let mut start = DVec3::ZERO;
                start[a.index()] = lattice.coordinate(a, i) + LINE_OFFSET;
                start[b.index()] = lattice.coordinate(b, j) + LINE_OFFSET;
                let chord = LineFrom::new(start, along.index(), &pose).chord(part);
                chord.is_some_and(|c| stock.has_material(along, [i, j], [c.lo, c.hi]))
            })
        })
    };
    body.parts.iter().any(touches)
}

/// Indices of the lines whose coordinates along an axis lie within a box.
fn lines_within(lattice: &Lattice, axis: Axis, bounds: Aabb) -> Range<u32> {
    let k = axis.index();
    let index = |x: f64| (x - LINE_OFFSET - lattice.origin[k]) / lattice.step;
    let count = f64::from(lattice.counts[k]);
    let first = index(bounds.min[k]).ceil().clamp(0.0, count);
    let end = (index(bounds.max[k]).floor() + 1.0).clamp(first, count);
    first as u32..end as u32
}

/// The point of a part that lies furthest in a direction; of a flat side that one next to `near`.
pub(super) fn deepest(part: &ConvexPart, pose: &Pose, direction: DVec3, near: DVec3) -> DVec3 {
    /// Sine below which a direction is square to a flat side.
    const SQUARE: f64 = 1e-6;
    let along = direction.dot(pose.axis);
    let across = direction - pose.axis * along;
    let wide = across.length();
    let beside = |r: f64| {
        if wide > SQUARE {
            across * (r / wide)
        } else {
            let from = near - pose.tip;
            (from - pose.axis * from.dot(pose.axis)).clamp_length_max(r)
        }
    };
    let height = |low: f64, high: f64| {
        let z = (near - pose.tip).dot(pose.axis);
        if along.abs() > SQUARE { if along > 0.0 { high } else { low } } else { z.clamp(low, high) }
    };
    let at = |r: f64, z: f64| pose.tip + beside(r) + pose.axis * z;
    let mut best = at(part.r1, height(part.z1, part.top));
    let mut take = |point: DVec3| {
        if point.dot(direction) > best.dot(direction) {
            best = point;
        }
    };
    take(at(part.r0, part.z0));
    if let Foot::Torus { centre_radius, centre_z, radius } = part.foot
        && along < 0.0
    {
        let z = centre_z + radius * along;
        if z > part.z0 && z < part.z1 {
            take(at(centre_radius + radius * wide, z));
        }
    }
    best
}
