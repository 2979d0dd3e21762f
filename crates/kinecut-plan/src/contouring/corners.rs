//! Corners of the wall that the cutter does not reach: it leaves a fillet of its own radius.

use glam::DVec2;

use super::track::Track;
use crate::base::{Code, Finding};
use crate::geom::{NearestEdge, OutlineEdge, OutlineLoop};
use crate::num::angle::wrap;

/// A corner that stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UncutCorner {
    /// Centre of the cutter where it is deepest in the corner [mm].
    pub at: DVec2,
    /// Directions from there to where the fillet begins and ends on the wall.
    pub between: [DVec2; 2],
    /// Stock that stays, at its thickest [mm]; none where the walls belong to two loops, between which the cutter does not go.
    pub thickness: Option<f64>,
    /// Length of the wall between the places where the fillet begins and ends [mm]; none where the walls belong to two loops.
    pub length: Option<f64>,
}

impl UncutCorner {
    /// Whether it is no corner but a part of the outline that a cutter of a radius [mm] does not enter: it is thicker than the cutter
    /// is wide.
    pub fn is_part(&self, radius: f64) -> bool {
        self.thickness.is_some_and(|t| t > 2.0 * radius)
    }
}

/// Least thickness that counts [mm].
const LEAST: f64 = 1e-3;
/// Least turn of a path that is a corner of it [rad].
const TURN: f64 = 1e-6;

/// Corners of a track that keeps the wall on its right or left; `wall`: distance of the wall [mm].
pub(super) fn uncut(
    track: &Track,
    keeps_right: bool,
    (edges, loops): (&[OutlineEdge], &[OutlineLoop]),
    near: &NearestEdge,
    wall: f64,
) -> Vec<UncutCorner> {
    let own = track.edges();
    let side = if keeps_right { 1.0 } else { -1.0 };
    let mut found = Vec::new();
    for i in 0..own.len() {
        let (edge, next) = (&own[i], &own[(i + 1) % own.len()]);
        // Towards the wall the path of a convex part never turns sharply; away from it, it does in each inside corner.
        let turn = side * wrap(next.heading(0.0) - edge.heading(1.0));
        if turn < TURN {
            continue;
        }
        let at = edge.end;
        let to_wall = |heading: f64| -side * DVec2::from_angle(heading).perp();
        let between = [to_wall(edge.heading(1.0)), to_wall(next.heading(0.0))];
        let stays = left(at, between, wall, (edges, loops), near);
        let (thickness, length) = (stays.map(|s| s.thickness), stays.map(|s| s.length));
        if thickness.is_none_or(|t| t > LEAST) {
            found.push(UncutCorner { at, between, thickness, length });
        }
    }
    found
}

/// Corners that stay, in a sentence.
pub(super) fn remark(corners: &[UncutCorner], a: f64) -> Option<Finding> {
    let places = |count: usize| if count == 1 { "1 place".to_owned() } else { format!("{count} places") };
    let thickest = |part: bool| {
        let of_kind =
            corners.iter().filter(|c| c.is_part(a) == part).filter_map(|c| Some((c.thickness?, c.at)));
        of_kind.max_by(|x, y| x.0.total_cmp(&y.0))
    };
    let (worst, narrow) = (thickest(false), thickest(true));
    let between: Vec<&UncutCorner> = corners.iter().filter(|c| c.thickness.is_none()).collect();
    let radius = (a * 1e3).round() / 1e3;
    let mut parts = Vec::new();
    if let Some((thickness, _)) = worst {
        let places = places(corners.iter().filter(|c| c.thickness.is_some() && !c.is_part(a)).count());
        parts.push(format!(
            "inside corners stay at {places}: a cutter of radius {radius} leaves up to {thickness:.3} mm"
        ));
    }
    if let Some((thickness, at)) = narrow {
        parts.push(format!(
            "a cutter of radius {radius} does not go into a part of the outline: up to {thickness:.1} mm stay near ({:.3}, {:.3})",
            at.x, at.y
        ));
    }
    if let Some(first) = between.first() {
        parts.push(format!(
            "a cutter of radius {radius} does not go between two loops at {}, for example near ({:.3}, {:.3})",
            places(between.len()),
            first.at.x,
            first.at.y
        ));
    }
    let at = narrow.or(worst).map(|(_, at)| at).or(between.first().map(|c| c.at))?;
    let finding = Finding::warning(Code::CORNERS_STAY, parts.join("; ")).point([at.x, at.y, 0.0]);
    Some(finding.help("finish the corners with a smaller cutter, or give them its radius in the drawing"))
}

/// The wall beyond the cutter in a corner.
#[derive(Clone, Copy, Debug)]
struct Left {
    /// Its greatest distance from the cutter [mm].
    thickness: f64,
    /// Its length [mm].
    length: f64,
}

/// The wall that stays in a corner; none between walls of two loops.
fn left(
    at: DVec2,
    between: [DVec2; 2],
    wall: f64,
    (edges, loops): (&[OutlineEdge], &[OutlineLoop]),
    near: &NearestEdge,
) -> Option<Left> {
    let foot = |towards: DVec2| near.at(at + wall * towards, 0.1 * wall + 1e-3);
    let feet = [foot(between[0])?, foot(between[1])?];
    let [first, last] = feet.map(|foot| foot.edge);
    let one = loops.iter().find(|l| l.edges.contains(&first) && l.edges.contains(&last))?;
    let step = |i: usize, on: bool| match on {
        true if i + 1 == one.edges.end => one.edges.start,
        true => i + 1,
        false if i == one.edges.start => one.edges.end - 1,
        false => i - 1,
    };
    // The shorter way along the loop from one foot to the other.
    let ways = [true, false].map(|on| {
        // Of the first edge what lies beyond its foot, of the last one what lies before.
        let share = |s: f64| if on { s } else { 1.0 - s };
        let of = |i: usize, s: f64| share(s) * edges[i].length();
        let (mut i, mut thickness, mut length) = (first, 0.0_f64, -of(first, feet[0].share));
        while i != last {
            let corner = if on { edges[i].end } else { edges[i].start };
            thickness = thickness
                .max(corner.distance(at))
                .max(edges[step(i, on)].at(0.5).distance(at) * f64::from(u8::from(step(i, on) != last)));
            length += edges[i].length();
            i = step(i, on);
        }
        Left { thickness: thickness - wall, length: length + of(last, feet[1].share) }
    });
    let [on, back] = ways;
    Some(if on.length.abs() <= back.length.abs() { on } else { back })
}
