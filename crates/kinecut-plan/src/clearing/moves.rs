//! The moves of one level: the ways that clear it at their heights and feeds.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::level::{Cleared, Element};
use super::plan::CELLS;
use super::spec::PocketSpec;
use crate::base::{CountBound, Result};
use crate::geom::OutlineEdge;
use crate::holes::route::Route;
use crate::holes::{ToolpathPace, ToolpathRole};

/// Least length of an arc on which a link rises or falls, in heights.
const SLOPE: f64 = 3.0;
/// Height over the material at which feeds down begin [mm].
const ABOVE: f64 = 0.5;

/// The moves of one level.
pub(super) fn run(
    spec: &PocketSpec,
    cleared: &Cleared,
    route: &mut Route,
    [above, floor]: [f64; 2],
) -> Result<()> {
    let (feed, plunge) = (ToolpathPace::Feed(spec.feed), ToolpathPace::Feed(spec.plunge_feed));
    let begin = (above + ABOVE).min(spec.approach_z);
    for element in &cleared.elements {
        match element {
            Element::Helix { middle, radius, from } => {
                let start = *middle + *radius * DVec2::from_angle(*from);
                route.over(start);
                // What a level above has cut is open.
                let open = if above < spec.top { ToolpathPace::Rapid } else { plunge };
                route.vertically(ToolpathRole::Entry, open, begin);
                helix(spec, route, (*middle, *radius, *from), floor)?;
            }
            Element::Down(at) => {
                route.over(*at);
                if floor + ABOVE < spec.approach_z {
                    route.vertically(ToolpathRole::Entry, feed, floor + ABOVE);
                }
                route.vertically(ToolpathRole::Entry, plunge, floor);
            }
            Element::Link(edges) => link(spec, route, edges, floor)?,
            Element::Back(edges) => route.edges(ToolpathRole::Link, spec.link_feed, edges)?,
            Element::Ramp(edges) => ramp(spec, route, edges, [above, floor])?,
            Element::Pass(pass) => route.edges(ToolpathRole::Rough, spec.feed, &pass.edges)?,
        }
    }
    Ok(())
}

/// Through what is cleared, off the floor.
fn link(spec: &PocketSpec, route: &mut Route, edges: &[OutlineEdge], floor: f64) -> Result<()> {
    let pace = ToolpathPace::Feed(spec.link_feed);
    let high = floor + spec.lift;
    // Up and down along arcs that are long enough; a link without them is a stop anyway.
    let is_slope = |edge: &OutlineEdge| edge.turn.is_some() && edge.length() >= SLOPE * spec.lift;
    let last = edges.len() - 1;
    for (i, edge) in edges.iter().enumerate() {
        let from = route.height();
        if i == 0 && last > 0 && is_slope(edge) && from < high {
            route.edge(ToolpathRole::Link, pace, edge, [from, high])?;
            continue;
        }
        route.vertically(ToolpathRole::Link, pace, high);
        if i == last && i > 0 && is_slope(edge) {
            route.edge(ToolpathRole::Link, ToolpathPace::Feed(spec.feed), edge, [high, floor])?;
        } else {
            route.edge(ToolpathRole::Link, pace, edge, [high, high])?;
        }
    }
    route.vertically(ToolpathRole::Entry, ToolpathPace::Feed(spec.plunge_feed), floor);
    Ok(())
}

/// Down on a helix to a floor, and once around on it.
fn helix(
    spec: &PocketSpec,
    route: &mut Route,
    (middle, radius, from): (DVec2, f64, f64),
    floor: f64,
) -> Result<()> {
    let height = route.height() - floor;
    let pitch = TAU * radius * spec.ramp.tan();
    let turns = (height / pitch - 1e-9).ceil().max(1.0);
    CountBound { what: "turns of the helix", most: 1e4, bytes: 1000, ..CELLS }.check(turns)?;
    let side = if spec.keeps_right() { 1.0 } else { -1.0 };
    let mut z = route.height();
    let halves = 2.0 * turns;
    let half = |k: f64| OutlineEdge::arc(middle, radius, from + side * k * PI, side * PI);
    let plunge = ToolpathPace::Feed(spec.plunge_feed);
    for k in 0..halves as usize {
        let to = floor + height * (halves - 1.0 - k as f64) / halves;
        route.edge(ToolpathRole::Entry, plunge, &half((k % 2) as f64), [z, to])?;
        z = to;
    }
    route.edges(ToolpathRole::Entry, spec.plunge_feed, &[half(0.0), half(1.0)])
}

/// Down along a way, to and fro from the end that is nearer, and once along it on the floor.
fn ramp(spec: &PocketSpec, route: &mut Route, edges: &[OutlineEdge], [above, floor]: [f64; 2]) -> Result<()> {
    let back: Vec<OutlineEdge> = edges.iter().rev().map(OutlineEdge::reversed).collect();
    let ends = [edges, &back].map(|way| way.first().map_or(DVec2::ZERO, |e| e.start));
    let here = route.place().map(DVec3::truncate);
    let from_end = here.is_some_and(|at| at.distance(ends[1]) < at.distance(ends[0]));
    let ways = if from_end { [&back[..], edges] } else { [edges, &back[..]] };
    let start = if from_end { ends[1] } else { ends[0] };
    let plunge = ToolpathPace::Feed(spec.plunge_feed);
    if here.is_none_or(|at| at.distance(start) > 1e-9) || route.height() > spec.approach_z + 1e-9 {
        route.over(start);
        let open = if above < spec.top { ToolpathPace::Rapid } else { plunge };
        route.vertically(ToolpathRole::Entry, open, (above + ABOVE).min(spec.approach_z));
    }
    let length: f64 = edges.iter().map(OutlineEdge::length).sum();
    let from = route.height();
    let legs = ((from - floor) / (length * spec.ramp.tan()) - 1e-9).ceil().max(1.0);
    CountBound { what: "legs of the ramp", most: 1e4, bytes: 1000, ..CELLS }.check(legs)?;
    let fall = (from - floor) / (legs * length);
    let mut z = from;
    for leg in 0..legs as usize {
        for (i, edge) in ways[leg % 2].iter().enumerate() {
            let ends_leg = i + 1 == edges.len();
            // The last one ends on the floor itself.
            let to = if ends_leg {
                floor + (legs - 1.0 - leg as f64) * fall * length
            } else {
                z - fall * edge.length()
            };
            route.edge(ToolpathRole::Entry, plunge, edge, [z, to])?;
            z = to;
        }
    }
    route.edges(ToolpathRole::Rough, spec.feed, ways[legs as usize % 2])
}
