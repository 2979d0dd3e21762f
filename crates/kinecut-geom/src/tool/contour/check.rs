//! Rules that make elements a contour.
//!
//! One way from the bottom of the axis to its top, without gaps, nothing of it on or beyond the axis but its two ends,
//! nowhere crossing, touching or retracing itself, the material on its left, no cusp. Closed by the axis it is an outline:
//! crossings are found by the exact tests of [`crate::geom`] between lines and arcs, and the side of the material is that of
//! the ends: a simple way right of the axis has the material on its left when it begins at the lower one.
//!
//! Arcs of more than a half turn become two, and normal angles begin within a half turn of 0: on a shorter arc the grazing
//! curve has two folds at most.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::element::{DOWN, UP, on_arc, turn};
use super::{ContourElement, ContourShape};
use crate::base::{Code, Finding, Result};
use crate::geom::{OutlineEdge, loop_crossing};
use crate::num::angle::wrap;

/// Largest distance of ends of elements from each other or from the axis, by the size of the contour: rounding of what
/// tangents and sines give, and what nine digits of a file leave.
pub(super) const GAP: f64 = 1e-9;
/// Largest distance of anything of a tool from its axis or its tip [mm].
const LARGEST: f64 = 10_000.0;
/// Angle by which an arc may pass a half turn and stay one [rad]: rounding of the sum of two quarters.
const HALF_TURN: f64 = 1e-12;
/// Angle of material, or of space, below which a corner is a cusp [rad]: the side to which the normal turns there would be
/// decided by rounding.
const CUSP: f64 = 1e-9;

/// The elements as a contour keeps them.
pub(super) fn checked(elements: Vec<ContourElement>) -> Result<Vec<ContourElement>> {
    if elements.is_empty() {
        return Err(Finding::error(Code::CONTOUR, "a contour has no elements")
            .value(0.0, "elements")
            .bound(1.0, "elements")
            .help("give its lines and arcs from the bottom of the axis to the top")
            .into());
    }
    let edges = elements.iter().enumerate().map(|(i, e)| edge(i, e)).collect::<Result<Vec<_>>>()?;
    let size = size(&edges);
    if size > LARGEST {
        return Err(Finding::error(Code::CONTOUR, "a tool is larger than any machine holds")
            .value_mm(size)
            .bound_mm(LARGEST)
            .help("give its lengths in mm")
            .into());
    }
    let tolerance = GAP * size;
    for (i, element) in elements.iter().enumerate() {
        if element.shape.length() <= tolerance {
            let found = refuse(i, element, "has no length").value_mm(element.shape.length());
            return Err(found.bound_mm(tolerance).help("leave it out").into());
        }
    }
    check_way(&elements, &edges, tolerance)?;
    check_simple(&elements, edges, tolerance)?;
    check_cusps(&elements)?;
    let last = elements.len() - 1;
    let mut kept = Vec::with_capacity(elements.len() + 1);
    for (i, mut element) in elements.into_iter().enumerate() {
        match &mut element.shape {
            ContourShape::Line { start, end } => {
                // Exactly on the axis, so that no edge of the size of rounding is left there.
                start.x = if i == 0 { 0.0 } else { start.x };
                end.x = if i == last { 0.0 } else { end.x };
                kept.push(element);
            }
            ContourShape::Arc { from, to, .. } => halves(*from, *to, |part| {
                let shape = with_range(element.shape, part);
                kept.push(ContourElement { shape, ..element });
            }),
        }
    }
    Ok(kept)
}

/// An element as an edge of an outline, travelled the same way.
pub(super) fn edge_of(shape: &ContourShape) -> OutlineEdge {
    match *shape {
        ContourShape::Line { start, end } => OutlineEdge::line(start, end),
        ContourShape::Arc { centre, radius, convex, from, to } => {
            let polar = if convex { from } else { from + PI };
            let arc = OutlineEdge::arc(centre, radius, polar, to - from);
            // The same rounding as the element's own ends.
            OutlineEdge {
                start: on_arc(centre, radius, convex, from),
                end: on_arc(centre, radius, convex, to),
                ..arc
            }
        }
    }
}

fn edge(i: usize, element: &ContourElement) -> Result<OutlineEdge> {
    match element.shape {
        ContourShape::Line { start, end } => {
            if let Some(bad) = [start.x, start.y, end.x, end.y].into_iter().find(|v| !v.is_finite()) {
                return Err(refuse(i, element, "has a coordinate that is not finite").value_mm(bad).into());
            }
        }
        ContourShape::Arc { centre, radius, convex, from, to } => {
            if let Some(bad) = [centre.x, centre.y, radius, from, to].into_iter().find(|v| !v.is_finite()) {
                return Err(refuse(i, element, "has a number that is not finite").value(bad, "").into());
            }
            if radius <= 0.0 {
                let found = refuse(i, element, "is an arc without a positive radius");
                return Err(found
                    .value_mm(radius)
                    .bound_mm(0.0)
                    .help("leave an edge out: it is there by itself")
                    .into());
            }
            if convex != (to > from) {
                let found = refuse(i, element, "is an arc whose normal turns against its convexity");
                let help = "the normal angle grows along a convex arc and falls along a concave one";
                return Err(found.value((to - from).to_degrees(), "deg").bound(0.0, "deg").help(help).into());
            }
            if (to - from).abs() > TAU - CUSP {
                let found = refuse(i, element, "is an arc of a whole turn or more");
                return Err(found.value((to - from).abs().to_degrees(), "deg").bound(360.0, "deg").into());
            }
        }
    }
    Ok(edge_of(&element.shape))
}

/// Largest distance of anything of the edges from the axis or from height 0 [mm].
fn size(edges: &[OutlineEdge]) -> f64 {
    let extents = edges.iter().flat_map(|e| [e.extent(DVec2::X), e.extent(DVec2::Y)]);
    extents.flatten().map(f64::abs).fold(0.0, f64::max)
}

fn check_way(elements: &[ContourElement], edges: &[OutlineEdge], tolerance: f64) -> Result<()> {
    let (first, last) = (0, elements.len() - 1);
    let mut at = DVec2::new(0.0, edges[first].start.y);
    for (i, (element, edge)) in elements.iter().zip(edges).enumerate() {
        let gap = edge.start.distance(at);
        if !(gap <= tolerance) {
            let (what, help) = if i == first {
                ("does not begin on the axis", "begin at the lowest point on the axis")
            } else {
                ("leaves a gap to the one before", "let each element begin where the one before ends")
            };
            return Err(refuse(i, element, what).value_mm(gap).bound_mm(tolerance).help(help).into());
        }
        at = edge.end;
        let [inner, outer] = edge.extent(DVec2::X);
        if inner < -tolerance {
            let found = refuse(i, element, "passes the axis").value_mm(inner).bound_mm(0.0);
            return Err(found.help("give the half of the section where the radius is positive").into());
        }
        if outer <= tolerance {
            let found = refuse(i, element, "lies on the axis").value_mm(outer).bound_mm(tolerance);
            return Err(found.help("leave it out: the axis is no surface").into());
        }
    }
    if !(at.x <= tolerance) {
        let found =
            refuse(last, &elements[last], "does not end on the axis").value_mm(at.x).bound_mm(tolerance);
        return Err(found.help("end at the highest point on the axis").into());
    }
    let rise = at.y - edges[first].start.y;
    if !(rise.abs() > tolerance) {
        let found =
            refuse(last, &elements[last], "ends where the contour begins").value_mm(rise).bound_mm(tolerance);
        return Err(found.help("a tool has some height on its axis").into());
    }
    Ok(())
}

fn check_simple(elements: &[ContourElement], mut edges: Vec<OutlineEdge>, tolerance: f64) -> Result<()> {
    let axis = edges.len();
    let (bottom, top) = (edges[0].start, edges[axis - 1].end);
    edges.push(OutlineEdge::line(top, bottom));
    if let Some(crossing) = loop_crossing(&edges, tolerance) {
        let [a, b] = crossing.edges;
        let what = if b == axis {
            "touches the axis between its ends".to_owned()
        } else {
            format!("is crossed or touched by element {b}")
        };
        let p = crossing.point;
        let place = format!("{what} at radius {:.6} and height {:.6}", p.x, p.y);
        return Err(at(refuse(a, &elements[a], &place), p)
            .help("the contour may meet itself nowhere")
            .into());
    }
    if top.y < bottom.y {
        return Err(Finding::error(
            Code::CONTOUR,
            "the contour has its material on the right: it is walked from the top",
        )
        .key("elements[0]")
        .value_mm(bottom.y)
        .bound_mm(top.y)
        .help("give the elements from the bottom of the axis to the top, each walked that way")
        .into());
    }
    Ok(())
}

/// At a cusp the normal turns by a half turn, to either side alike.
fn check_cusps(elements: &[ContourElement]) -> Result<()> {
    let mut phi = DOWN;
    for (i, element) in elements.iter().enumerate() {
        let [first, last] = element.shape.normals();
        if PI - turn(phi, first).abs() < CUSP {
            let what = "meets the one before in a cusp, where neither is left of the other";
            return Err(refuse(i, element, what)
                .value(turn(phi, first).to_degrees(), "deg")
                .bound(180.0, "deg")
                .into());
        }
        phi = last;
    }
    if PI - turn(phi, UP).abs() < CUSP {
        let last = elements.len() - 1;
        return Err(refuse(last, &elements[last], "meets the axis in a cusp").into());
    }
    Ok(())
}

/// The parts of a range of normal angles: itself, or two halves; they begin within a half turn of 0.
fn halves(from: f64, to: f64, mut part: impl FnMut([f64; 2])) {
    let start = wrap(from);
    let by = to - from;
    if by.abs() <= PI + HALF_TURN {
        part([start, if start == from { to } else { start + by }]);
    } else {
        part([start, start + 0.5 * by]);
        part([start + 0.5 * by, start + by]);
    }
}

fn with_range(shape: ContourShape, [a, b]: [f64; 2]) -> ContourShape {
    match shape {
        ContourShape::Arc { centre, radius, convex, .. } => {
            ContourShape::Arc { centre, radius, convex, from: a, to: b }
        }
        line => line,
    }
}

/// An error at an element: its number, and where it begins.
fn refuse(i: usize, element: &ContourElement, what: &str) -> Finding {
    let start = element.shape.start();
    let from = if start.is_finite() {
        format!(" (from radius {:.6}, height {:.6})", start.x, start.y)
    } else {
        String::new()
    };
    at(Finding::error(Code::CONTOUR, format!("element {i} of a contour{from} {what}")), start)
        .key(format!("elements[{i}]"))
}

fn at(found: Finding, p: DVec2) -> Finding {
    if p.is_finite() { found.point([p.x, 0.0, p.y]) } else { found }
}
