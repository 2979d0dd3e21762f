//! Whether a path keeps all of its edges under the largest wear of the control's register.
//!
//! Under a positive wear the control moves the path away from the wall. There inside arcs and short edges between inside
//! corners may vanish, and loops part: LinuxCNC stops, other controls cut the corner. Towards the wall, under a negative wear,
//! nothing vanishes: each point keeps the place of the wall that it has.

use glam::DVec2;

use super::check::out_of_range;
use crate::base::{Code, Finding, Result};
use crate::geom::{NearestEdge, OutlineEdge};

/// Shortest edge of a path that counts [mm]: less than a control resolves.
const LEAST: f64 = 2e-5;
/// Step in which messages show the largest wear [mm].
const TOLD: f64 = 1e-4;

/// Looks whether a path keeps its loops and edges under a wear. `paths` has the path farther from the wall by as much; `radius`:
/// that of the cutter, `wall`: distance of the path from the wall [mm].
///
/// # Errors
/// `KC0404` with the place and the largest wear that fits; those of `paths`.
pub(super) fn fits(
    path: &[Vec<OutlineEdge>],
    paths: impl Fn(f64) -> Result<Vec<Vec<OutlineEdge>>>,
    wear: f64,
    (radius, wall): (f64, f64),
) -> Result<()> {
    if wear >= radius {
        let what = "the wear is as large as the cutter";
        let help = "allow a smaller wear_largest: the register holds what the wall is off, not the radius";
        return Err(out_of_range("finish.wear_largest", what, wear, radius, "mm", help));
    }
    let Some(mut trouble) = Trouble::of(path, &paths(wear)?, wear) else { return Ok(()) };
    let (mut low, mut high) = (0.0, wear);
    while high - low > 0.01 * TOLD {
        let middle = 0.5 * (low + high);
        match paths(middle).map(|moved| Trouble::of(path, &moved, middle)) {
            Ok(None) => low = middle,
            Ok(Some(found)) => (high, trouble) = (middle, found),
            Err(_) => high = middle,
        }
    }
    let largest = (low / TOLD).floor() * TOLD;
    let (what, at) = trouble.told(radius, wall);
    let message = format!(
        "the wear does not fit: {what}; LinuxCNC stops there, other controls cut the corner or gouge the wall"
    );
    let help = match largest > 0.0 {
        true => {
            format!("allow a smaller wear, wear_largest = {largest:.4} at most, or take a smaller cutter")
        }
        false => "take a smaller cutter, or leave out `wear_offset`".to_owned(),
    };
    Err(Finding::error(Code::PLAN_VALUE, message)
        .value_mm(wear)
        .bound_mm((largest / TOLD).round() * TOLD)
        .point([at.x, at.y, 0.0])
        .help(help)
        .key("finish.wear_largest")
        .into())
}

/// The part of a path that a wear takes away.
enum Trouble {
    /// An edge vanishes.
    Edge(OutlineEdge),
    /// Loops part or join, near a point.
    Loops(DVec2),
}

impl Trouble {
    /// Of a path, and the same moved by a wear [mm].
    fn of(path: &[Vec<OutlineEdge>], moved: &[Vec<OutlineEdge>], wear: f64) -> Option<Trouble> {
        let own: Vec<OutlineEdge> = path.concat();
        let near = NearestEdge::new(&own);
        let mut is_kept = vec![false; own.len()];
        for edge in moved.iter().flatten() {
            // Back towards the wall it comes to the edge that it was.
            if let Some(source) = near.at(edge.at(0.5), wear + 10.0 * near.rounding()) {
                is_kept[source.edge] = true;
            }
        }
        // An arc about a corner that is hardly one is as near as the edges beside it.
        let is_moved = |e: &OutlineEdge| {
            let Some(of) = e.turn else { return false };
            let arcs = moved.iter().flatten().filter_map(|m| m.turn);
            arcs.into_iter().any(|t| {
                let off = (t.radius - of.radius).abs() - wear;
                t.centre.distance(of.centre) <= 10.0 * near.rounding() && off.abs() <= 10.0 * near.rounding()
            })
        };
        let gone = own.iter().zip(is_kept).filter(|(e, kept)| !kept && e.length() > LEAST).map(|(e, _)| e);
        let gone = gone.filter(|e| !is_moved(e));
        // The smallest arc, else the shortest edge.
        let size = |e: &OutlineEdge| (e.turn.is_none(), e.turn.map_or(e.length(), |t| t.radius));
        let least = gone.min_by(|a, b| {
            let ((line, of), (other_line, other)) = (size(a), size(b));
            line.cmp(&other_line).then(of.total_cmp(&other))
        });
        let is_one = path.len() == moved.len();
        if let Some(edge) = least {
            // What does not vanish by being small is where the path runs beside itself.
            let is_small = edge.turn.map_or(is_one, |t| t.radius <= wear + near.rounding());
            return Some(if is_small { Trouble::Edge(*edge) } else { Trouble::Loops(edge.at(0.5)) });
        }
        (!is_one).then(|| {
            // A corner where there was none.
            let moved: Vec<OutlineEdge> = moved.concat();
            let corners = |edges: &[OutlineEdge]| edges.iter().map(|e| e.start).collect::<Vec<_>>();
            let old = corners(&own);
            let far = |p: &DVec2| old.iter().map(|q| q.distance(*p)).fold(f64::INFINITY, f64::min);
            let new = corners(&moved).into_iter().max_by(|a, b| far(a).total_cmp(&far(b)));
            Trouble::Loops(new.unwrap_or(own[0].start))
        })
    }

    /// In words, with its place.
    fn told(&self, radius: f64, wall: f64) -> (String, DVec2) {
        let shown = |mm: f64| (mm * 1e4).round() / 1e4;
        match self {
            Trouble::Edge(edge) => {
                let at = edge.at(0.5);
                let place = format!("({:.3}, {:.3})", at.x, at.y);
                let what = match edge.turn {
                    Some(t) => format!(
                        "the path has an inside arc of radius {} at {place}, R{} in the drawing beside a cutter of R{}",
                        shown(t.radius),
                        shown(t.radius + wall),
                        shown(radius)
                    ),
                    None => format!(
                        "the path has a line of {} mm between inside corners at {place}",
                        shown(edge.length())
                    ),
                };
                (what, at)
            }
            Trouble::Loops(at) => {
                let what = format!("the path comes too near to itself at ({:.3}, {:.3})", at.x, at.y);
                (what, *at)
            }
        }
    }
}
