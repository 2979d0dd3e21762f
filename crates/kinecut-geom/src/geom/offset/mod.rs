//! Offsets of a face: the loops at a distance from its outline.
//!
//! `cavalier_contours` makes them; the result is checked against the outline it came from (`check.rs`), and where it
//! fails they are made directly, from all candidates cut at all their meetings (`direct.rs`), and checked again. Lines
//! stay lines, arcs stay arcs; about a corner that opens goes an arc, the only path that keeps the distance.

mod chain;
mod check;
mod direct;
mod library;
#[cfg(test)]
mod lines;

use super::{Outline, OutlineEdge};
use crate::base::{Code, Finding, Result};

/// Widest loop that counts as a line [mm]: less than a control resolves.
const COLLAPSED: f64 = 2e-5;

/// Longest edge of an offset that is rounding [mm].
const CRUMB: f64 = 2e-6;

/// The loops at a distance from an outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Offset {
    /// Closed loops, the material of the offset face on the right of the travel, as in an [`Outline`]. Loops may touch one
    /// another, so that they are not always the loops of one outline.
    pub loops: Vec<OffsetLoop>,
    /// Whether the loops were made directly, because those of the library were wrong.
    pub direct: bool,
}

/// A loop of an offset.
#[derive(Clone, Debug, PartialEq)]
pub struct OffsetLoop {
    /// Its edges, each beginning where the one before it ends.
    pub edges: Vec<OutlineEdge>,
    /// Whether it has no width: the face is as wide there as twice the distance, and the loop runs to and fro.
    pub collapsed: bool,
}

impl OffsetLoop {
    fn new(edges: Vec<OutlineEdge>) -> OffsetLoop {
        let length: f64 = edges.iter().map(OutlineEdge::length).sum();
        let area = 0.5 * edges.iter().map(OutlineEdge::twice_area).sum::<f64>();
        OffsetLoop { collapsed: 2.0 * area.abs() < COLLAPSED * length, edges }
    }

    /// Its edges without crumbs, each exactly from the end of the one before: where a joint has a gap, or a crumb is left out, an edge
    /// keeps its turn between its new ends.
    pub(super) fn joined(&self) -> Vec<OutlineEdge> {
        let kept: Vec<&OutlineEdge> = self.edges.iter().filter(|edge| edge.length() > CRUMB).collect();
        let next = |i: usize| kept[(i + 1) % kept.len()].start;
        let joined = |(i, edge): (usize, &&OutlineEdge)| {
            if edge.end == next(i) || kept.len() == 1 {
                return **edge;
            }
            let bulge = edge.turn.map_or(0.0, |t| (0.25 * t.sweep).tan());
            OutlineEdge::bulge(edge.start, next(i), bulge).labelled(edge.label)
        };
        kept.iter().enumerate().map(joined).collect()
    }

    /// Length [mm].
    pub fn length(&self) -> f64 {
        self.edges.iter().map(OutlineEdge::length).sum()
    }

    /// Area that it encloses [mm2]: positive around material, negative around a hole.
    pub fn area(&self) -> f64 {
        -0.5 * self.edges.iter().map(OutlineEdge::twice_area).sum::<f64>()
    }
}

impl Offset {
    /// Length of all loops [mm].
    pub fn length(&self) -> f64 {
        self.loops.iter().map(OffsetLoop::length).sum()
    }

    /// Area of the offset face [mm2].
    pub fn area(&self) -> f64 {
        self.loops.iter().map(OffsetLoop::area).sum()
    }
}

/// The offset of an outline by `distance` [mm]: positive shrinks the face, negative grows it. There are no loops where
/// nothing is left of the face.
///
/// Source: the rules of parallel curves; each result is checked: distance and side of its points, its joints, its turning,
/// and that no point which belongs to it is missing.
///
/// # Errors
/// `KC0806` with a place, where neither way gives loops that pass the check.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use glam::dvec2;
/// use kinecut::geom::{Outline, offset};
/// let square = [dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(40.0, 40.0), dvec2(0.0, 40.0)];
/// let square = Outline::polygon(&square)?;
/// assert!((offset(&square, 5.0)?.area() - 900.0).abs() < 1e-9);
/// // Outwards there is an arc about each corner.
/// let grown = offset(&square, -5.0)?;
/// assert!((grown.area() - (2400.0 + 25.0 * std::f64::consts::PI)).abs() < 1e-9);
/// assert_eq!(grown.loops[0].edges.len(), 8);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn offset(outline: &Outline, distance: f64) -> Result<Offset> {
    if !distance.is_finite() {
        return Err(Finding::error(Code::OFFSET, "the distance of an offset is not finite").into());
    }
    if distance == 0.0 {
        let loops =
            outline.loops().iter().map(|l| OffsetLoop::new(outline.edges()[l.edges.clone()].to_vec()));
        return Ok(Offset { loops: loops.collect(), direct: false });
    }
    let check = check::Check::new(outline, distance);
    // The library takes a line there and back for a fault of the drawing.
    let by_library = (!outline.is_of_lines()).then(|| library::loops(outline, distance)).flatten();
    let by_library = by_library.filter(|loops| check.of(loops).is_ok());
    let (loops, direct) = match by_library {
        Some(loops) => (loops, false),
        None => (checked_direct(outline, distance, &check)?, true),
    };
    Ok(Offset { loops: loops.into_iter().map(OffsetLoop::new).collect(), direct })
}

/// The offset made directly, without the library: slower, to judge by.
///
/// # Errors
/// As [`offset`].
pub fn offset_direct(outline: &Outline, distance: f64) -> Result<Offset> {
    let check = check::Check::new(outline, distance);
    let loops = checked_direct(outline, distance, &check)?;
    Ok(Offset { loops: loops.into_iter().map(OffsetLoop::new).collect(), direct: true })
}

/// The loops made directly that pass the check.
fn checked_direct(
    outline: &Outline,
    distance: f64,
    check: &check::Check<'_>,
) -> Result<Vec<Vec<OutlineEdge>>> {
    let mut refused = None;
    for deficit in direct::DEFICITS {
        let loops = direct::loops(outline, distance, check.near(), deficit);
        match check.of(&loops) {
            Ok(()) => return Ok(loops),
            Err(error) => refused.get_or_insert(error),
        };
    }
    refused.map_or_else(|| Ok(Vec::new()), Err)
}

/// The error of an offset that fails, and where.
fn failed(what: &str, at: glam::DVec2, distance: f64) -> crate::base::Error {
    Finding::error(Code::OFFSET, format!("the offset {what} at ({:.4}, {:.4})", at.x, at.y))
        .value_mm(distance)
        .point([at.x, at.y, 0.0])
        .help("simplify the drawing there, or take another distance: a cutter a little smaller or larger")
        .into()
}

#[cfg(test)]
mod tests;
