//! A conservative bound of what a tool sweeps while it leans or turns: each of its bodies as a capsule about the axis of the
//! tool, at places of the move so near to one another that the motion between them is a small part of the distance.
//!
//! The bound is one-sided: what it calls clear is clear; what it does not call clear may be.

use glam::DVec3;

use crate::base::Result;
use crate::geom::{Aabb, Profile};
use crate::job::look::is_cut;
use crate::tool::Tool;
use crate::trace::Segment;

/// Which part of a tool a body is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ToolPart {
    /// The flutes.
    Cutting,
    /// The shank between flutes and holder.
    Shank,
    /// A segment of the holder.
    Holder,
}

/// A body of revolution about the axis of a tool.
#[derive(Clone, Debug)]
pub(super) struct RevolvedBody {
    /// Which part it is.
    pub(super) part: ToolPart,
    /// Its section.
    pub(super) profile: Profile,
    /// Height of the section's zero above the tip [mm].
    pub(super) at: f64,
}

impl RevolvedBody {
    /// Lowest and greatest height above the tip [mm].
    pub(super) fn heights(&self) -> [f64; 2] {
        [self.at + self.profile.bottom(), self.at + self.profile.top()]
    }

    /// Greatest radius [mm].
    pub(super) fn radius(&self) -> f64 {
        self.profile.max_radius()
    }
}

/// The bodies of a tool, flutes first.
///
/// # Errors
/// Those of the tool's profiles.
pub(super) fn bodies(tool: &Tool) -> Result<Vec<RevolvedBody>> {
    let mut all = vec![RevolvedBody { part: ToolPart::Cutting, profile: tool.cutting_profile()?, at: 0.0 }];
    all.extend(tool.shank_profile()?.map(|(profile, at)| RevolvedBody {
        part: ToolPart::Shank,
        profile,
        at,
    }));
    let holder = tool.holder_profiles()?.into_iter();
    all.extend(holder.map(|(profile, at)| RevolvedBody { part: ToolPart::Holder, profile, at }));
    Ok(all)
}

/// Tip and direction from tip to holder at a part `t` of a segment, from 0 to 1 [part coordinates].
pub(super) fn place(segment: &Segment, t: f64) -> (DVec3, DVec3) {
    let tip = segment.curve.at(t * segment.curve.length()).p;
    let axis = segment.turning.as_ref().map_or(segment.axis, |turning| turning.axis(t).0);
    (tip, axis)
}

/// Bound on the travel of a point of the axis, at most `height` above the tip, in a part `by` of a segment [mm].
pub(super) fn most_moved(segment: &Segment, height: f64, by: f64) -> f64 {
    let turned = segment.turning.as_ref().map_or(0.0, |turning| turning.most_turned());
    by * (segment.curve.length() + height.abs() * turned)
}

/// Whether no body comes nearer than `margin` to a box anywhere on a segment; `error` is how far the tip may run beside the
/// segment's curve [mm].
pub(super) fn is_clear(
    segment: &Segment,
    bodies: &[RevolvedBody],
    bounds: Aabb,
    margin: f64,
    error: f64,
) -> bool {
    bodies.iter().all(|body| {
        let [low, high] = body.heights();
        let gap = |t: f64| {
            let (tip, axis) = place(segment, t);
            to_box([tip + axis * low, tip + axis * high], bounds) - body.radius() - margin - error
        };
        keeps_positive(&gap, &|by| most_moved(segment, high, by), 0.0, 1.0)
    })
}

/// Motion below which a gap is not looked at more closely [mm].
const FINE: f64 = 0.05;

/// Whether `gap` stays positive between two places, if it changes by at most `change` of half the part between them on
/// either side of its middle.
pub(super) fn keeps_positive(
    gap: &dyn Fn(f64) -> f64,
    change: &dyn Fn(f64) -> f64,
    from: f64,
    to: f64,
) -> bool {
    let mut open = vec![(from, to)];
    while let Some((from, to)) = open.pop() {
        let middle = 0.5 * (from + to);
        let (gap, change) = (gap(middle), change(0.5 * (to - from)));
        if gap > change {
            continue;
        }
        // Not a number is never clear.
        if !(gap > 0.0) || change < FINE {
            return false;
        }
        open.extend([(middle, to), (from, middle)]);
    }
    true
}

/// A lower bound of the distance of a straight piece from a box [mm], within a hundredth of a millimetre.
fn to_box([start, end]: [DVec3; 2], bounds: Aabb) -> f64 {
    const WITHIN: f64 = 0.01;
    let distance = |s: f64| {
        let p = start.lerp(end, s);
        (bounds.min - p).max(p - bounds.max).max(DVec3::ZERO).length()
    };
    // The distance from a convex body is convex along a line.
    let length = (end - start).length();
    let (mut from, mut to) = (0.0, 1.0);
    while (to - from) * length > WITHIN {
        let third = (to - from) / 3.0;
        let (a, b) = (from + third, to - third);
        if distance(a) < distance(b) { to = b } else { from = a }
    }
    distance(0.5 * (from + to)) - 0.5 * WITHIN
}

/// Distance of a point from a straight piece [mm].
pub(super) fn to_piece(point: DVec3, [start, end]: [DVec3; 2]) -> f64 {
    let along = end - start;
    let s = (point - start).dot(along) / along.length_squared();
    (point - start - along * if s.is_finite() { s.clamp(0.0, 1.0) } else { 0.0 }).length()
}

/// Whether the stock is not cut along a segment although the tool may remove something there.
pub(super) fn is_uncut(segment: &Segment) -> bool {
    !is_cut(segment)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_of_a_piece_from_a_box_is_that_of_its_nearest_point() {
        let bounds = Aabb { min: DVec3::splat(-10.0), max: DVec3::splat(10.0) };
        let gap = to_box([DVec3::new(-50.0, 0.0, 13.0), DVec3::new(60.0, 0.0, 13.0)], bounds);
        assert!(gap <= 3.0 && gap > 2.98, "{gap}");
        let corner = to_box([DVec3::new(13.0, 14.0, 0.0), DVec3::new(13.0, 14.0, 90.0)], bounds);
        assert!(corner <= 5.0 && corner > 4.98, "{corner}");
        assert!(to_box([DVec3::new(-50.0, 0.0, 0.0), DVec3::new(50.0, 0.0, 0.0)], bounds) <= 0.0);
    }

    #[test]
    fn a_gap_that_closes_between_two_places_is_found() {
        let narrow = |t: f64| (t - 0.3001).abs() * 100.0 - 0.2;
        assert!(!keeps_positive(&narrow, &|by| 100.0 * by, 0.0, 1.0));
        let wide = |t: f64| (t - 0.3001).abs() * 100.0 + 0.2;
        assert!(keeps_positive(&wide, &|by| 100.0 * by, 0.0, 1.0));
        assert!(!keeps_positive(&|_| f64::NAN, &|_| 0.0, 0.0, 1.0));
    }
}
