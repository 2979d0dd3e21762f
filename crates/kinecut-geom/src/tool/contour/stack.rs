//! Bodies on one axis, each at its height, as one contour: the outer boundary of what they fill together.
//!
//! From the lowest point of the axis the way follows the body that it is on. Wherever it meets another body (crosses it,
//! touches it, or runs along a face that both share) it takes the way that leads farthest to the right, away from the
//! material of both. So steps become the rings that are seen, what lies inside another body is gone, and hollows that
//! are closed all around too.

use std::f64::consts::PI;

use super::check::{GAP, edge_of};
use super::{Contour, ContourElement, ContourShape, ElementRole};
use crate::base::{Code, Finding, Result};
use crate::geom::{OutlineEdge, meetings};
use crate::num::angle::wrap;

/// Distance at which things of two bodies are in one place, as a share of the gap that a contour may have.
const NEAR: f64 = 0.25;
/// Directions nearer than this are one [rad]: the rounding of a heading on a short element.
const ALONG: f64 = 1e-7;

/// An element of a body in its place.
#[derive(Clone, Copy)]
struct Side {
    element: ContourElement,
    edge: OutlineEdge,
    /// Index of the one that follows in the body; none: it ends on the axis.
    next: Option<usize>,
}

impl Contour {
    /// Bodies, each with the height [mm] by which it is raised, as one tool: their outer boundary. Elements of the body `i`
    /// are given the body number `i`. Where only a ring is left of the face that ends a body at its top, it has the role of
    /// the element below it.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::{Contour, ToolForm};
    /// let disc = |diameter, flute_length| ToolForm::EndMill { diameter, flute_length }.contour().unwrap();
    /// let nut = Contour::stack(&[(disc(10.0, 4.0), 0.0), (disc(6.0, 12.0), 4.0), (disc(20.0, 3.0), 12.0)]).unwrap();
    /// let volume = std::f64::consts::PI * (25.0 * 4.0 + 9.0 * 8.0 + 100.0 * 3.0 + 9.0 * 1.0);
    /// assert!((nut.volume() - volume).abs() < 1e-9);
    /// ```
    ///
    /// # Errors
    /// `KC0704` when there is no body, or two leave a gap on the axis, with the number of the body; a height that is not finite; when one hangs on a point
    /// of another, or a rounded edge rests on a face: the cusp between them has no side.
    pub fn stack(bodies: &[(Contour, f64)]) -> Result<Contour> {
        let raise = |(i, (body, by)): (usize, &(Contour, f64))| {
            body.raised(*by).map_err(|e| e.under(&format!("body[{i}]")))
        };
        let raised: Vec<Contour> = bodies.iter().enumerate().map(raise).collect::<Result<_>>()?;
        let size = raised.iter().map(|c| c.largest_radius() + c.extent()[0].abs().max(c.extent()[1].abs()));
        let tolerance = NEAR * GAP * size.fold(0.0, f64::max);
        check_touching(&raised, tolerance)?;
        let mut sides = Vec::new();
        for (i, body) in raised.iter().enumerate() {
            let count = body.elements.len();
            for (k, element) in body.elements.iter().enumerate() {
                let next = (k + 1 < count).then(|| sides.len() + 1);
                let element = ContourElement { body: u16::try_from(i).unwrap_or(u16::MAX), ..*element };
                sides.push(Side { element, edge: edge_of(&element.shape), next });
            }
        }
        let lowest = raised.iter().enumerate().min_by(|(_, a), (_, b)| a.bottom().total_cmp(&b.bottom()));
        let Some((lowest, _)) = lowest else {
            return Err(Finding::error(Code::CONTOUR, "a stack has no bodies").value(0.0, "bodies").into());
        };
        let first = raised[..lowest].iter().map(|c| c.elements.len()).sum();
        Contour::new(walk(&sides, first, tolerance))
    }
}

fn check_touching(bodies: &[Contour], tolerance: f64) -> Result<()> {
    let mut order: Vec<usize> = (0..bodies.len()).collect();
    order.sort_by(|&a, &b| bodies[a].bottom().total_cmp(&bodies[b].bottom()).then(a.cmp(&b)));
    let mut top = f64::INFINITY;
    for (k, &i) in order.iter().enumerate() {
        let body = &bodies[i];
        if k > 0 && body.bottom() > top + tolerance {
            let below = order[k - 1];
            return Err(Finding::error(
                Code::CONTOUR,
                format!("bodies {below} and {i} of a stack do not touch on the axis"),
            )
            .key(format!("body[{i}]"))
            .value_mm(body.bottom())
            .bound_mm(top)
            .help("lower the upper one")
            .into());
        }
        top = if k == 0 || body.height() > top { body.height() } else { top };
    }
    Ok(())
}

/// The outer boundary from the side `at`, which begins on the axis.
fn walk(sides: &[Side], mut at: usize, tolerance: f64) -> Vec<ContourElement> {
    let mut way = Vec::new();
    let mut from = 0.0;
    // Every side is entered at its start or at a meeting: fewer times than there are pairs.
    for _ in 0..=sides.len() * (sides.len() + 2) {
        let side = &sides[at];
        let mut stops = meeting_shares(sides, at, from, tolerance);
        stops.push(1.0);
        let mut left = None;
        for share in stops {
            if let Some((to, begin)) = way_on(sides, at, share, tolerance) {
                left = Some((share, to, begin));
                break;
            }
        }
        let (share, next) = left.map_or((1.0, None), |(share, to, begin)| (share, Some((to, begin))));
        if (share - from) * side.edge.length() > tolerance {
            let mut piece = part(&side.element, from, share);
            if side.next.is_none() && next.is_some() && piece.role == ElementRole::Shank {
                // A ring of the face that ends a body.
                piece.role = below(sides, at).unwrap_or(piece.role);
            }
            way.push(piece);
        }
        match next {
            Some((to, begin)) => (at, from) = (to, begin),
            None => break,
        }
    }
    way
}

/// The role of the side before the last of a body.
fn below(sides: &[Side], last: usize) -> Option<ElementRole> {
    sides.iter().find(|s| s.next == Some(last)).map(|s| s.element.role)
}

/// The places of a side beyond `from`, before its end, where it meets sides of other bodies, as shares of its length.
fn meeting_shares(sides: &[Side], at: usize, from: f64, tolerance: f64) -> Vec<f64> {
    let side = &sides[at];
    let length = side.edge.length();
    let mut shares: Vec<f64> = sides
        .iter()
        .filter(|s| s.element.body != side.element.body)
        .flat_map(|s| meetings(&side.edge, &s.edge, tolerance))
        .map(|p| side.edge.nearest(p).0)
        .filter(|&s| (s - from) * length > tolerance && (1.0 - s) * length > tolerance)
        .collect();
    shares.sort_by(f64::total_cmp);
    shares
}

/// The side on which the way leads on from a place of a side, and its place there as a share of its length. `None`
/// inside a side: stay on it; at its end: the contour ends.
fn way_on(sides: &[Side], at: usize, share: f64, tolerance: f64) -> Option<(usize, f64)> {
    let side = &sides[at];
    let place = side.edge.at(share);
    let heading = side.edge.heading(share);
    // Angle to the right at which a path leads on, and its curvature to the right.
    let turn = |edge: &OutlineEdge, s: f64| {
        let turn = wrap(edge.heading(s) - heading);
        let bend = edge.turn.map_or(0.0, |t| t.sweep.signum() / t.radius);
        (if turn.abs() > PI - ALONG { PI } else { turn }, bend)
    };
    let right_of = |a: (f64, f64), b: (f64, f64)| {
        a.0 < b.0 - ALONG || (a.0 < b.0 + ALONG && a.1 < b.1 - ALONG * (a.1.abs() + b.1.abs()))
    };
    let mut best: Option<((f64, f64), usize, f64)> = match side.next {
        _ if share < 1.0 => Some((turn(&side.edge, share), at, share)),
        Some(next) => Some((turn(&sides[next].edge, 0.0), next, 0.0)),
        None => None,
    };
    for (i, other) in sides.iter().enumerate() {
        if other.element.body == side.element.body {
            continue;
        }
        let (s, distance) = other.edge.nearest(place);
        // An edge that ends here continues in the one after it.
        if distance > tolerance || (1.0 - s) * other.edge.length() <= tolerance {
            continue;
        }
        let s = if s * other.edge.length() <= tolerance { 0.0 } else { s };
        let candidate = turn(&other.edge, s);
        if best.is_none_or(|(b, ..)| right_of(candidate, b)) {
            best = Some((candidate, i, s));
        }
    }
    let (_, to, begin) = best?;
    (to != at).then_some((to, begin))
}

/// The part of an element between two shares of its length.
fn part(element: &ContourElement, from: f64, to: f64) -> ContourElement {
    if from == 0.0 && to == 1.0 {
        return *element;
    }
    let shape = match element.shape {
        ContourShape::Line { start, end } => {
            let at = |s: f64| if s == 1.0 { end } else { start + s * (end - start) };
            ContourShape::Line { start: at(from), end: at(to) }
        }
        ContourShape::Arc { centre, radius, convex, from: a, to: b } => {
            let at = |s: f64| if s == 1.0 { b } else { a + s * (b - a) };
            ContourShape::Arc { centre, radius, convex, from: at(from), to: at(to) }
        }
    };
    ContourElement { shape, ..*element }
}
