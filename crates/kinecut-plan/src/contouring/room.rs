//! Room for a cutter that is wider above its tip: along leads, and beside the edges of loops that are not cut.

use glam::DVec2;

use super::lead::Lead;
use crate::geom::{NearestEdge, OutlineEdge};

/// Distance that is rounding [mm].
const ROUNDING: f64 = 1e-6;
/// Parts of an edge of a lead between which is looked.
const PARTS: u32 = 16;
/// Lines of leads that are tried.
const LINES: u32 = 32;
/// Length by which each is longer, in distances that the lead is to gain.
const LONGER: f64 = 0.125;
/// Piece of a path that is not divided any further [mm].
const PIECE: f64 = 2e-3;

/// The lead with the shortest line by which the free ends of all ways off a contour lie so far from all edges [mm] that the cutter
/// comes down there beside them, and comes nearer only towards the contour; `ways`: those of a lead. `wall`: distance of the path
/// from the wall [mm].
pub(super) fn reaching(
    lead: Lead,
    ways: impl Fn(&Lead) -> Vec<Vec<OutlineEdge>>,
    near: &NearestEdge,
    (wall, room): (f64, f64),
) -> Option<Lead> {
    let farther = room - wall;
    let least = if lead.line + lead.radius < farther { farther - lead.radius } else { lead.line };
    let is_free = |lead: &Lead| ways(lead).iter().all(|way| gains(way, near, room));
    let longer = |i: u32| Lead { line: least + f64::from(i) * LONGER * farther, ..lead };
    (0..LINES).map(longer).find(is_free)
}

/// Whether a way off a contour gains distance from the edges until it has all of `room`, and keeps that.
fn gains(way: &[OutlineEdge], near: &NearestEdge, room: f64) -> bool {
    let mut last = 0.0;
    for edge in way {
        for i in 0..=PARTS {
            let p = edge.at(f64::from(i) / f64::from(PARTS));
            let distance = near.at(p, room).map_or(room, |n| n.distance.abs());
            if distance < last - ROUNDING {
                return false;
            }
            last = distance;
        }
    }
    last >= room - ROUNDING
}

/// A point of an edge of a path that lies nearer than `room` to some edges [mm], if there is one.
pub(super) fn nearer(edge: &OutlineEdge, near: &NearestEdge, room: f64) -> Option<DVec2> {
    let (middle, half) = (edge.at(0.5), 0.5 * edge.length());
    let found = near.at(middle, room + half)?;
    if found.distance.abs() < room - ROUNDING {
        return Some(middle);
    }
    if 2.0 * half < PIECE {
        return None;
    }
    nearer(&edge.part(0.0, 0.5), near, room).or_else(|| nearer(&edge.part(0.5, 1.0), near, room))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use glam::dvec2;

    use super::*;
    use crate::geom::Outline;

    fn slot(width: f64) -> NearestEdge {
        let corners = [dvec2(0.0, 0.0), dvec2(60.0, 0.0), dvec2(60.0, width), dvec2(0.0, width)];
        NearestEdge::new(Outline::polygon(&corners).expect("a rectangle").edges())
    }

    #[test]
    fn lines_of_leads_reach_where_there_is_room() {
        let ways = |lead: &Lead| vec![lead.off(dvec2(30.0, 0.5), DVec2::X, true)];
        let lead = Lead { radius: 1.0, angle: FRAC_PI_2, line: 0.0 };
        let of = |width: f64, room: f64| reaching(lead, ways, &slot(width), (0.5, room));
        assert_eq!(of(20.0, 1.5), Some(lead));
        assert_eq!(of(20.0, 3.0).map(|l| l.line), Some(1.5));
        // Nowhere in a slot of 5 mm is as much room.
        assert!(of(5.0, 3.0).is_none() && of(6.1, 3.0).is_some());
    }

    #[test]
    fn places_that_are_too_near_are_found() {
        let near = slot(20.0);
        let path = OutlineEdge::line(dvec2(-30.0, -0.2), dvec2(90.0, -3.0));
        let found = nearer(&path, &near, 1.0).expect("one");
        assert!(near.at(found, 5.0).expect("near").distance < 1.0);
        assert_eq!(nearer(&path, &near, 0.8), None);
        assert_eq!(nearer(&OutlineEdge::line(dvec2(-3.0, -2.0), dvec2(70.0, -2.0)), &near, 2.0), None);
    }
}
