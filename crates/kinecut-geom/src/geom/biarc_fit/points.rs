//! Arcs and lines along points.

use glam::DVec2;

use super::{Biarc, distance};
use crate::geom::{OutlineEdge, PlanarArc};
use crate::num::angle::wrap;

/// Turn between two chords from which a point is a corner [rad].
const CORNER: f64 = 0.15;
/// Turn from which a point is a corner between straighter ones [rad], and by how much it turns more than those beside it.
const KINK: (f64, f64) = (0.01, 3.0);
/// Largest angle between the direction of an arc and that of the way [rad].
const ASIDE: f64 = 0.005;
/// Most points of one biarc.
const MOST: usize = 96;
/// Largest turn of one biarc [rad].
const TURN: f64 = 1.5;

/// Lines and arcs along points: through the first and the last, within `tolerance` [mm] of the others, tangent to one another
/// but at corners.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use glam::DVec2;
/// use kinecut::geom::arcs_near;
/// let circle: Vec<DVec2> = (0..=200).map(|i| 20.0 * DVec2::from_angle(f64::from(i) * 0.02)).collect();
/// let arcs = arcs_near(&circle, 0.001);
/// assert!(arcs.len() <= 8);
/// let length: f64 = arcs.iter().map(|a| a.length()).sum();
/// assert!((length - 80.0).abs() < 1e-3);
/// ```
pub fn arcs_near(points: &[DVec2], tolerance: f64) -> Vec<OutlineEdge> {
    let mut found = Vec::new();
    let mut begin = 0;
    // Turns at the points; the ends have none.
    let last = points.len().saturating_sub(1);
    let turn = |i: usize| {
        if i == 0 || i >= last {
            return 0.0;
        }
        (points[i] - points[i - 1]).angle_to(points[i + 1] - points[i]).abs()
    };
    let is_corner = |i: usize| {
        let beside = turn(i - 1).max(turn(i + 1));
        turn(i) > CORNER || turn(i) > KINK.0 && turn(i) > KINK.1 * beside
    };
    for i in 1..points.len() {
        if i + 1 == points.len() || is_corner(i) {
            smooth(&points[begin..=i], tolerance, &mut found);
            begin = i;
        }
    }
    found
}

/// Points without a corner.
fn smooth(points: &[DVec2], tolerance: f64, found: &mut Vec<OutlineEdge>) {
    let tangents = tangents(points);
    let mut from = 0;
    while from + 1 < points.len() {
        let mut best = None;
        let (mut good, mut bad) = (from, points.len().min(from + MOST));
        let mut step = 1;
        // Ever longer, then between what fits and what does not.
        while good + 1 < bad {
            let to = if step > 0 { (good + step).min(bad - 1) } else { usize::midpoint(good, bad) };
            match fits(points, &tangents, [from, to], tolerance) {
                Some(biarc) => {
                    (good, best) = (to, Some(biarc));
                    step *= 2;
                }
                None => (bad, step) = (to, 0),
            }
        }
        match best {
            Some(biarc) => {
                found.extend(edge(&biarc.first));
                found.extend(edge(&biarc.last));
                from = good;
            }
            None => {
                found.push(OutlineEdge::line(points[from], points[from + 1]));
                from += 1;
            }
        }
    }
}

/// Direction of the circle through each point and its neighbours.
fn tangents(points: &[DVec2]) -> Vec<DVec2> {
    let angle = |i: usize| (points[i + 1] - points[i]).to_angle();
    let last = points.len() - 1;
    let towards = |i: usize| match i {
        _ if last == 1 => angle(0),
        // At an end the way turns on as it turns beside it.
        0 => angle(0) - 0.5 * wrap(angle(1) - angle(0)),
        _ if i == last => angle(i - 1) + 0.5 * wrap(angle(i - 1) - angle(i - 2)),
        _ => {
            let (before, after) = (points[i].distance(points[i - 1]), points[i].distance(points[i + 1]));
            angle(i - 1) + wrap(angle(i) - angle(i - 1)) * before / (before + after)
        }
    };
    (0..=last).map(|i| DVec2::from_angle(towards(i))).collect()
}

fn fits(points: &[DVec2], tangents: &[DVec2], [from, to]: [usize; 2], tolerance: f64) -> Option<Biarc> {
    let biarc = Biarc::new((points[from], tangents[from]), (points[to], tangents[to]))?;
    let (first, last) = (biarc.first.sweep, biarc.last.sweep);
    let wavers = first * last < 0.0 && first.abs().min(last.abs()) > ASIDE;
    if wavers || first.abs().max(last.abs()) > TURN {
        return None;
    }
    let joint = biarc.first.end;
    let near = (from + 1..to).all(|i| {
        let p = points[i];
        let arc = if (p - joint).dot(biarc.tangent) < 0.0 { &biarc.first } else { &biarc.last };
        let along = match arc.is_line() {
            true => arc.end - arc.start,
            false => (p - arc.centre).perp() * arc.sweep.signum(),
        };
        distance(arc, p) <= tolerance && along.angle_to(tangents[i]).abs() <= ASIDE
    });
    near.then_some(biarc)
}

fn edge(arc: &PlanarArc) -> Option<OutlineEdge> {
    if arc.start == arc.end {
        return None;
    }
    let line = OutlineEdge::line(arc.start, arc.end);
    if arc.is_line() {
        return Some(line);
    }
    let out = arc.start - arc.centre;
    let made = OutlineEdge::arc(arc.centre, out.length(), out.to_angle(), arc.sweep);
    Some(OutlineEdge { turn: made.turn, ..line })
}
