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
use super::chord::LineFrom;
use super::rest::deepest;
use super::span::Pose;
use super::swept::StockLine;
use super::tiles::SpanTask;
use crate::geom::Aabb;
use crate::stock::tile::Tile;
use crate::stock::{EndPoint, fixed, unfixed};

/// Way of the tool between two looks at an end, as a part of the diagonal of four lines.
const APART: f64 = 0.5;

/// Most looks at an end in a span.
const MOST_TIMES: f64 = 1000.0;

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
                // A line that goes on has no width of its own to tell.
                let seen = match (ended, reached) {
                    (true, point) => point.map(|point| (i64::from(fixed(beside)), point)),
                    (false, _) => Some((0, at(0.5 * (lo.s + hi.s)))),
                };
                let kept = effects.of(task.index);
                let k = looked as usize;
                let bounds = |p: DVec3| Aabb::of_points([p]).grown(beside);
                let middle = at(unfixed(i.lo.at.max(from)));
                near(&mut kept.thin[k], (0, middle.to_array(), bounds(middle)));
                if let Some((width, point)) = seen {
                    near(&mut kept.edges[k], (width, point.to_array(), bounds(point)));
                }
            }
        });
    }
}

/// A point of a part behind the plane of an end, or on it, that is no farther from the end across the plane than `beside`, at some
/// time: the deepest point of the part, or one of a net of the plane where that lies elsewhere.
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
    let (u, v) = normal.any_orthonormal_pair();
    let around = |far: f64, k: u32| {
        let (sin, cos) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
        place + (u * cos + v * sin) * (beside * far)
    };
    let times = (task.travel / (APART * beside)).ceil().clamp(4.0, MOST_TIMES);
    (0..=times as u32).find_map(|i| {
        let pose = task.poses.span.at(f64::from(i) / times - 0.5);
        let depth = |point: DVec3| gauge(part, &pose, point);
        let here = depth(place);
        if here < 0.0 {
            return Some(place);
        }
        // Between two times the part goes on by so much.
        let near = beside * (1.0 + APART);
        if here > near {
            return None;
        }
        let deepest = deepest(part, &pose, -normal, place);
        let off = deepest - place;
        let height = off.dot(normal);
        if height >= 0.0 {
            return None;
        }
        if (off - normal * height).length() <= near {
            return Some(deepest);
        }
        let ring = |far: f64| (0..8).map(move |k| (far, k));
        let mut all = [0.25, 0.5, 0.75, 1.0].into_iter().flat_map(ring).map(|(far, k)| around(far, k));
        all.find(|point| depth(*point) < 0.0)
    })
}

/// The gauge of a part at a point of the stock [mm].
fn gauge(part: &ConvexPart, pose: &Pose, point: DVec3) -> f64 {
    let start = DVec3::new(point.x, point.y, 0.0);
    LineFrom::new(start, 2, pose).gauge(part, point.z).value
}
