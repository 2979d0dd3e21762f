//! Whether the posted program leaves the edges of the simulated stock as planned: exit angles are measured where the
//! program, read back, first brings the cutter to the walls of the stock as it is before the face is milled.
//!
//! Nothing of the planner is used for it: the walls are the ends of the stock's lines with their own normals, the path
//! is that of the text, the first contact is searched for chord by chord.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use super::PlannedFace;
use crate::base::{Code, Finding, at_most};
use crate::facing::passes::Met;
use crate::geom::{OutlineEdge, Rigid};
use crate::num::angle::wrap;
use crate::operations::measured::{Proof, WallProbe};
use crate::operations::{Judged, PostedPlan};
use crate::program::Role;
use crate::stock::WallEnd;
use crate::trace::SegmentPace;

/// The exit angle of a place of the stock's wall, as simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulatedExit {
    /// Place, in coordinates of the work offset [mm].
    pub at: [f64; 2],
    /// Length of wall that it represents [mm].
    pub length: f64,
    /// Exit angle [rad]: an exit between 0 and pi.
    pub angle: f64,
    /// Exit angle of the plan there [rad]; none where the plan changes within the distance of the lines.
    pub planned: Option<f64>,
}

/// The exits of a face as simulated, against those planned.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SimulatedFace {
    /// Places on the outline.
    pub exits: Vec<SimulatedExit>,
    /// Length of the stock's walls at the outline [mm].
    pub matched: f64,
    /// Length of other walls of the stock within the outline [mm].
    pub strange: f64,
    /// Length of the outline's edges that the stock does not have [mm].
    pub missing: f64,
    /// Length with a bad exit, weighted, as simulated [mm].
    pub bad: f64,
    /// The same as planned [mm].
    pub planned_bad: f64,
    /// Length of wall whose exit angles were compared with the plan's [mm].
    pub compared: f64,
    /// Length where the angle differs from the plan's by more than the grid explains [mm].
    pub differing: f64,
    /// Largest difference among those that the grid explains [rad].
    pub largest: f64,
}

impl PlannedFace {
    /// The walls to measure, and the item of the text before which that has to be.
    pub(super) fn wall_probe(&self, posted: &PostedPlan<'_>) -> Option<WallProbe> {
        let to_part = posted.to_work().inverse();
        let mut items = 0..posted.program.items.len() as u32;
        let item = items.find(|&i| posted.planned_item(i).is_some_and(|p| p >= self.first_item))?;
        let out = to_part.vector(DVec3::Z);
        let height = out.dot(to_part.point(DVec3::new(0.0, 0.0, self.top)));
        Some(WallProbe { setup: posted.index, item, out, height })
    }
}

/// Measures the exits of a face on the walls of the stock; `step`: distance of its lines [mm].
pub(super) fn simulated_face(
    face: &PlannedFace,
    posted: &PostedPlan<'_>,
    walls: &[WallEnd],
    step: f64,
) -> SimulatedFace {
    let to_work = posted.to_work();
    // Into the outline's own frame, where the part may be turned against it.
    let to_face = |p: DVec3| face.in_outline(to_work.point(p).truncate());
    let chains = posted_chains(posted, face, &to_work);
    let case = &face.of.case;
    let edges = case.outline.edges();
    let clockwise = !face.of.table.left_hand;
    let reach = 0.5 * step;
    let planned_bad = face.chosen().bad;
    let mut found = SimulatedFace { planned_bad, ..SimulatedFace::default() };
    let mut covered = vec![0.0; edges.len()];
    for wall in walls {
        let at = to_face(wall.point);
        let tip = to_face(wall.point + wall.normal) - at;
        let Some((edge, s, distance)) = nearest(edges, at) else { continue };
        if distance > reach {
            if case.outline.contains(at) {
                found.strange += wall.length;
            }
            continue;
        }
        found.matched += wall.length;
        covered[edge] += wall.length;
        let Some(centre) = first_contact(&chains, at, case.radius) else { continue };
        let arm = at - centre;
        let (velocity, direction) = if clockwise {
            (arm.to_angle() - FRAC_PI_2, tip.to_angle() - FRAC_PI_2)
        } else {
            // Seen in a mirror: the angle is counted the other way.
            (-(arm.to_angle() + FRAC_PI_2), -(tip.to_angle() + FRAC_PI_2))
        };
        let angle = wrap(velocity - direction);
        let planned = planned_angle(face, edges, edge, s, step);
        if angle > 0.0 {
            found.bad += wall.length * case.weights[edge] * case.bad.weight(angle);
        }
        if let Some(planned) = planned {
            found.compared += wall.length;
            let off = wrap(angle - planned).abs();
            if off > allowed(&edges[edge], distance) {
                found.differing += wall.length;
            } else {
                found.largest = found.largest.max(off);
            }
        }
        found.exits.push(SimulatedExit { at: at.to_array(), length: wall.length, angle, planned });
    }
    for (edge, covered) in edges.iter().zip(covered) {
        // Ends come a step apart: an edge of a few steps may have lost one or two.
        let few = 4.0 * step;
        let short = edge.length() - covered;
        if short > few && short > 0.1 * edge.length() {
            found.missing += short;
        }
    }
    found
}

/// Difference of angles that grid and facets explain [rad]: normals are kept to 0.06 degrees, ends to 10 nm; the facet
/// of a mesh that lies `distance` inside of its arc leans against it.
fn allowed(edge: &OutlineEdge, distance: f64) -> f64 {
    const GRID: f64 = 0.02;
    /// Facets are measured anywhere on them: their middle may lie farther inside than the end that was met.
    const FACET: f64 = 0.01;
    let lean = edge.turn.map_or(0.0, |t| (1.0 - (distance + FACET) / t.radius).clamp(-1.0, 1.0).acos());
    GRID + lean
}

/// The way of the cutter's centre in the outline's frame as the text has it: chords of each chain at the finished plane.
fn posted_chains(posted: &PostedPlan<'_>, face: &PlannedFace, to_work: &Rigid) -> Vec<Vec<DVec2>> {
    /// Arcs become chords this near to them [mm].
    const CHORD: f64 = 1e-4;
    let mut chains: Vec<Vec<DVec2>> = Vec::new();
    let mut open = false;
    for segment in &posted.trace.segments {
        let planned = posted.planned_item(segment.item);
        let own = planned.is_some_and(|p| {
            let origin = posted.planned.origin(p as usize);
            origin.operation == Some(face.operation) && origin.role == Role::Finish
        });
        if !own || segment.alternative || !matches!(segment.motion, SegmentPace::Feed(_)) {
            open &= own;
            continue;
        }
        let points = segment.curve.polyline(CHORD).into_iter();
        let points = points.map(|p| face.in_outline(to_work.point(p).truncate()));
        match chains.last_mut().filter(|_| open) {
            Some(chain) => chain.extend(points),
            None => chains.push(points.collect()),
        }
        open = true;
    }
    chains
}

/// The cutter's centre when it first covers the point; `None` if a chain begins over the point, or no chain reaches it.
fn first_contact(chains: &[Vec<DVec2>], point: DVec2, radius: f64) -> Option<DVec2> {
    for chain in chains {
        if chain.first().is_some_and(|c| c.distance(point) < radius) {
            return None;
        }
        for chord in chain.windows(2) {
            if chord[1].distance(point) > radius {
                // Both ends outside: the chord may still pass through the disc.
                let along = chord[1] - chord[0];
                let t = (point - chord[0]).dot(along) / along.length_squared();
                let middle = chord[0] + t * along;
                if !(t > 0.0 && t < 1.0 && middle.distance(point) < radius) {
                    continue;
                }
                return Some(entering(chord[0], middle, point, radius));
            }
            return Some(entering(chord[0], chord[1], point, radius));
        }
    }
    None
}

/// Place on the way from `outside` to `inside` that is at the radius of the point, by halving.
fn entering(mut outside: DVec2, mut inside: DVec2, point: DVec2, radius: f64) -> DVec2 {
    for _ in 0..60 {
        let middle = 0.5 * (outside + inside);
        if middle.distance(point) > radius { outside = middle } else { inside = middle }
    }
    inside
}

/// The edge nearest to a point: its index, the share of its length, the distance.
fn nearest(edges: &[OutlineEdge], point: DVec2) -> Option<(usize, f64, f64)> {
    let one = |(i, edge): (usize, &OutlineEdge)| {
        let (s, distance) = edge.nearest(point);
        (i, s, distance)
    };
    edges.iter().enumerate().map(one).min_by(|a, b| a.2.total_cmp(&b.2))
}

/// The exit angle of the plan at a place of an edge, unless the plan changes nearer than two lines of the stock.
fn planned_angle(face: &PlannedFace, edges: &[OutlineEdge], edge: usize, s: f64, step: f64) -> Option<f64> {
    let margin = 2.0 * step / edges[edge].length();
    // A closed circle has no corner where it begins.
    let closed = edges[edge].start == edges[edge].end;
    let (stretch, s) = face.planned_stretch(edge, s)?;
    let near = |end: f64| (s - end).abs() < margin && !(closed && (end == 0.0 || end == 1.0));
    if near(stretch.from) || near(stretch.to) || !matches!(stretch.met, Met::First { .. }) {
        return None;
    }
    face.chosen().exit_angle(&face.plan.case, stretch, s)
}

impl SimulatedFace {
    /// Whether enough of the walls was compared with the plan to say that it is right: half of what the stock has.
    pub fn is_compared(&self) -> bool {
        self.compared > 0.5 * self.matched
    }
}

/// The finding of a face whose simulated exits are not those planned, if they are not.
fn judge_face(face: &SimulatedFace, name: &str, step: f64) -> Option<Finding> {
    /// Single places at which two walls meet within a line's distance.
    const FEW: f64 = 6.0;
    let bound = (0.01 * face.matched).max(FEW * step);
    let (what, value, help) = if face.missing > bound {
        (
            "the stock does not have all edges of the outline",
            face.missing,
            "correct the outline or the stock, or mill the face after the edges are made",
        )
    } else if face.strange > bound {
        (
            "the stock has edges that the outline does not",
            face.strange,
            "add them to the outline, or mill the face before they are made",
        )
    } else if face.differing > bound {
        (
            "simulated exit angles are not those planned",
            face.differing,
            "the stock at that moment has another outline: correct it, or the order of the operations",
        )
    } else {
        return None;
    };
    Some(
        Finding::error(Code::FACE_EXITS, format!("{name}: {what}"))
            .value(value, "mm of edge")
            .bound(bound, "mm of edge")
            .help(help),
    )
}

/// Compares the simulated exits with those planned.
pub(super) fn judged(face: &SimulatedFace, name: &str, item: u32, step: f64) -> Judged {
    let finding = judge_face(face, name, step);
    let proven = (finding.is_none() && face.is_compared()).then(|| Proof {
        claim: format!(
            "{name}: where the text brings the cutter to the walls of the stock, exit angles are those planned; bad length {:.2} mm, planned {:.2} mm",
            face.bad, face.planned_bad
        ),
        bound: format!(
            "{} places on {:.0} mm of wall, they differ by {} degrees; corners within {} mm not compared",
            face.exits.len(),
            face.matched,
            at_most(face.largest.to_degrees(), 2),
            2.0 * step
        ),
    });
    let unchecked = (!face.is_compared()).then(|| {
        format!(
            "exit angles of {name}: only {:.0} of {:.0} mm of wall could be compared at this step",
            face.compared, face.matched
        )
    });
    Judged {
        findings: finding.map(|f| (f, item)).into_iter().collect(),
        proven,
        unchecked,
        ..Judged::default()
    }
}
