//! Edges of material that a body of a leaning tool may clip between the lines.
//!
//! An overlap between the lines is no farther than the diagonal of four lines from lines of all three directions that have material
//! there. A line sees it in one of two ways: its material ends near the body, and the plane of that end, continued, reaches
//! into the body; or it goes on under the body. A direction whose material all ends in planes that keep clear says that nothing
//! is met. If none says so, and the plane of some end reaches in, an edge may be clipped. Places along a move are not told from
//! one another: a closer look decides.

use glam::DVec3;

use super::super::body::ConvexPart;
use super::super::effect::{Effects, Looked, near};
use super::chord::{Gauge, LineFrom};
use super::rest::deepest;
use super::span::Pose;
use super::swept::StockLine;
use super::task::SpanTask;
use crate::geom::Aabb;
use crate::stock::tile::Tile;
use crate::stock::{EndPoint, fixed, unfixed};

/// Way of the tool between two looks at an end, as a part of the diagonal of four lines.
const APART: f64 = 0.5;

/// Steps in which a point of a disc is sought that lies in a part, and how far in [mm].
const STEPS: usize = 24;
const BEYOND: f64 = 1e-4;

/// Least part of a span between two looks.
const SHORTEST: f64 = 1e-3;

/// Notes what a line has near a body.
pub(super) fn note(
    tile: &Tile,
    l: usize,
    task: &SpanTask,
    line: &StockLine,
    looked: Looked,
    effects: &mut Effects,
) {
    let Some((grown, beside)) = &task.tool.grown else { return };
    let beside = *beside;
    let (body, grown) = (task.tool.looked_at(looked), &grown[looked as usize]);
    for (part, wide) in body.parts.iter().zip(&grown.parts) {
        task.poses.covers(wide, task.bend, line, |[lo, hi]| {
            let (from, to) = (fixed(lo.s), fixed(hi.s));
            for i in tile.line(l).iter().filter(|i| i.lo.at < to && i.hi.at > from) {
                let ends = [i.lo, i.hi].into_iter().filter(|end| end.at >= from && end.at <= to);
                let (mut ended, mut reached) = (false, None);
                for end in ends {
                    ended = true;
                    reached = reached.or_else(|| reaches(task, part, line, &end, beside));
                }
                let at = |s: f64| {
                    let mut point = line.start;
                    point[line.along] = s;
                    point
                };
                let kept = effects.of(task.index);
                let k = looked as usize;
                let bounds = |p: DVec3| Aabb::of_points([p]).grown(beside);
                let middle = at(unfixed(i.lo.at.max(from)));
                near(&mut kept.thin[k], (i64::from(!ended), middle.to_array(), bounds(middle)));
                if let Some(point) = reached {
                    near(&mut kept.edges[k], (i64::from(fixed(beside)), point.to_array(), bounds(point)));
                }
            }
        });
    }
}

/// A point of a part behind the plane of an end, or on it, that is no farther from the end across the plane than `beside`, at some
/// time: the deepest point of the part, or one of the plane where that lies elsewhere.
fn reaches(
    task: &SpanTask,
    part: &ConvexPart,
    line: &StockLine,
    end: &EndPoint,
    beside: f64,
) -> Option<DVec3> {
    let mut place = line.start;
    place[line.along] = unfixed(end.at);
    let normal = end.normal.normal();
    let height = |pose: &Pose| (deepest(part, pose, -normal, place) - place).dot(normal);
    // Each point of the part keeps to a straight way but for the bend.
    let [first, last] = [0, 2].map(|i| height(&task.poses.poses[i]));
    if first.min(last) >= 2.0 * task.bend {
        return None;
    }
    let apart = (APART * beside / task.travel).clamp(SHORTEST, 0.25);
    // Between two times the part goes on by so much.
    let near = beside * (1.0 + APART);
    let mut t = -0.5;
    loop {
        let pose = task.poses.span.at(t);
        let off = deepest(part, &pose, -normal, place) - place;
        let mut gap = off.dot(normal);
        if gap < 0.0 {
            if (off - normal * gap).length() <= near {
                return Some(place + off);
            }
            match on_disc(part, &pose, (place, normal), near) {
                Ok(point) => return Some(point),
                Err(least) => gap = least,
            }
        }
        if t >= 0.5 {
            return None;
        }
        // No point of the tool moves farther than its travel: a gap stays open for so long.
        let free = gap / task.travel;
        t = (t + if free > apart { free } else { apart }).min(0.5);
    }
}

/// A point of a disc that lies in a part; else a bound on the gauge over the disc, or 0 where none was found [mm].
///
/// The gauge is convex: each step goes to where its tangent plane meets the disc at 0, and a tangent plane that stays above 0 over
/// the disc proves that there is no point.
fn on_disc(
    part: &ConvexPart,
    pose: &Pose,
    (middle, axis): (DVec3, DVec3),
    radius: f64,
) -> Result<DVec3, f64> {
    let mut point = middle;
    for _ in 0..STEPS {
        let gauge = gauge(part, pose, point);
        if gauge.value < 0.0 {
            return Ok(point);
        }
        let across = gauge.normal - axis * gauge.normal.dot(axis);
        let slope = across.length();
        let least = gauge.value + across.dot(middle - point) - slope * radius;
        if least > 0.0 {
            return Err(least);
        }
        // Not a number where the plane is level over the disc: it touches there.
        let next = point - across * ((gauge.value + BEYOND) / (slope * slope));
        if !next.is_finite() {
            break;
        }
        point = middle + (next - middle).clamp_length_max(radius);
    }
    Err(0.0)
}

/// The gauge of a part at a point of the stock [mm].
fn gauge(part: &ConvexPart, pose: &Pose, point: DVec3) -> Gauge {
    let start = DVec3::new(point.x, point.y, 0.0);
    LineFrom::new(start, 2, pose).gauge(part, point.z)
}
