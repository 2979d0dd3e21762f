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
pub(super) const ABOVE: f64 = 0.5;
/// Feed straight down into the stock, in that of passes.
const PLUNGE: f64 = 0.3;

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
            Element::Ramp(edges) => {
                let back: Vec<OutlineEdge> = edges.iter().rev().map(OutlineEdge::reversed).collect();
                let here = route.place().map(DVec3::truncate);
                let far = |way: &[OutlineEdge]| {
                    here.zip(way.first()).map_or(0.0, |(here, edge)| here.distance(edge.start))
                };
                let is_back = far(&back) < far(edges);
                let ways = if is_back { [&back[..], edges] } else { [edges, &back[..]] };
                ramp(spec, route, ways, [above, floor], (ToolpathRole::Rough, spec.feed))?;
            }
            Element::RampIn(edges) => {
                let back: Vec<OutlineEdge> = edges.iter().rev().map(OutlineEdge::reversed).collect();
                // The last way, along the floor, is the one from its first edge to its last.
                let is_even = legs(spec, edges, begin - floor)? % 2 == 0;
                let ways = if is_even { [edges, &back[..]] } else { [&back[..], edges] };
                // From above in any case: the number of ways hangs on the height.
                come_down(spec, route, ways[0], above);
                ramp(spec, route, ways, [above, floor], (ToolpathRole::Entry, spec.plunge_feed))?;
            }
            Element::PlungeIn(at, edges) => {
                let into = ToolpathPace::Feed(spec.plunge_feed.min(PLUNGE * spec.feed));
                route.over(*at);
                let open = if above < spec.top { ToolpathPace::Rapid } else { into };
                route.vertically(ToolpathRole::Entry, open, begin);
                route.vertically(ToolpathRole::Entry, into, floor);
                route.edges(ToolpathRole::Entry, spec.plunge_feed, edges)?;
            }
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

/// From above to where a way begins, a little over the material.
fn come_down(spec: &PocketSpec, route: &mut Route, way: &[OutlineEdge], above: f64) {
    route.over(way.first().map_or(DVec2::ZERO, |e| e.start));
    // The cut of a level above is open.
    let open = if above < spec.top { ToolpathPace::Rapid } else { ToolpathPace::Feed(spec.plunge_feed) };
    route.vertically(ToolpathRole::Entry, open, (above + ABOVE).min(spec.approach_z));
}

/// Number of times that a ramp goes along a way to fall by a height [mm].
fn legs(spec: &PocketSpec, edges: &[OutlineEdge], height: f64) -> Result<usize> {
    let length: f64 = edges.iter().map(OutlineEdge::length).sum();
    let legs = (height / (length * spec.ramp.tan()) - 1e-9).ceil().max(1.0);
    CountBound { what: "legs of the ramp", most: 1e4, bytes: 1000, ..CELLS }.check(legs)?;
    Ok(legs as usize)
}

/// Down along a way and back in turn, the first of two ways first, and once along it on the floor with a role and a feed.
fn ramp(
    spec: &PocketSpec,
    route: &mut Route,
    ways: [&[OutlineEdge]; 2],
    [above, floor]: [f64; 2],
    (role, feed): (ToolpathRole, f64),
) -> Result<()> {
    let here = route.place().map(DVec3::truncate);
    let start = ways[0].first().map_or(DVec2::ZERO, |e| e.start);
    let plunge = ToolpathPace::Feed(spec.plunge_feed);
    if here.is_none_or(|at| at.distance(start) > 1e-9) || route.height() > spec.approach_z + 1e-9 {
        come_down(spec, route, ways[0], above);
    }
    let length: f64 = ways[0].iter().map(OutlineEdge::length).sum();
    let from = route.height();
    let legs = legs(spec, ways[0], from - floor)?;
    let fall = (from - floor) / (legs as f64 * length);
    let mut z = from;
    for leg in 0..legs {
        for (i, edge) in ways[leg % 2].iter().enumerate() {
            let ends_leg = i + 1 == ways[0].len();
            // The last one ends on the floor itself.
            let to = if ends_leg {
                floor + (legs - 1 - leg) as f64 * fall * length
            } else {
                z - fall * edge.length()
            };
            route.edge(ToolpathRole::Entry, plunge, edge, [z, to])?;
            z = to;
        }
    }
    route.edges(role, feed, ways[legs % 2])
}
