//! Joins open chains of edges into loops at their ends, and leaves out what is drawn twice.
//!
//! Ends no farther apart than the snap are one joint. Exactly two ends meet in a joint: one is a gap, three a branch. Where
//! ends differ, the end of an arc wins over that of a line, so that arcs stay as drawn; lines and pairs of arcs meet in
//! the middle.

use std::collections::BTreeMap;

use glam::DVec2;

use super::OutlineEdge;
use super::drawing::{Drawing, sentences};
use super::repeated::{leave_out_repeated_loops, leave_out_repeated_paths};
use super::through::with_ends;
use crate::base::{Code, Result};
use crate::num::sets::Sets;

/// Distance at which ends are the same point whatever the snap [mm]: the last digit of drawings.
const SAME: f64 = 1e-9;

/// Turns the open chains of a drawing into loops.
///
/// # Errors
/// `KC0803` where a chain stays open, or branches.
pub(super) fn chain(drawing: &mut Drawing, snap: f64) -> Result<()> {
    chains(drawing, snap, Joints::AllClosed).map(|_| ())
}

/// The chains of a drawing that stay open, each in the direction of its first entity; the others become loops of it.
///
/// # Errors
/// `KC0803` where chains branch.
pub(super) fn open_chains(drawing: &mut Drawing, snap: f64) -> Result<Vec<Vec<OutlineEdge>>> {
    chains(drawing, snap, Joints::Open)
}

/// As [`open_chains`]; where more than two ends meet, each chain ends.
pub(super) fn drawn_chains(drawing: &mut Drawing, snap: f64) -> Result<Vec<Vec<OutlineEdge>>> {
    chains(drawing, snap, Joints::Any)
}

/// Numbers of ends that may meet in a joint.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Joints {
    /// Two.
    AllClosed,
    /// One or two.
    Open,
    /// Any.
    Any,
}

fn chains(drawing: &mut Drawing, snap: f64, allowed: Joints) -> Result<Vec<Vec<OutlineEdge>>> {
    let snap = if snap > SAME { snap } else { SAME };
    let mut notes = Vec::new();
    drop_specks(drawing, snap, &mut notes);
    leave_out_repeated_paths(drawing, snap, &mut notes);
    let joints = joints(&drawing.paths, snap);
    let mut ends_of: Vec<Vec<usize>> = vec![Vec::new(); drawing.paths.len() * 2];
    for (end, &joint) in joints.iter().enumerate() {
        ends_of[joint].push(end);
    }
    if allowed != Joints::Any {
        no_branches(drawing, &ends_of)?;
    }
    if allowed == Joints::AllClosed {
        no_open_ends(drawing, &ends_of)?;
    }
    let mut widest: (f64, usize) = (0.0, 0);
    let mut used = vec![false; drawing.paths.len()];
    let mut lines = Vec::new();
    // The end by which the next path is entered from one that is left by an end.
    let beyond = |left: usize| match ends_of[joints[left]][..] {
        [a, b] => Some(if a == left { b } else { a }),
        _ => None,
    };
    for first in 0..drawing.paths.len() {
        if used[first] {
            continue;
        }
        // Even ends are starts, odd ones ends.
        let (mut edges, is_loop) = walk(drawing, &mut used, 2 * first, beyond);
        if !is_loop && let Some(before) = beyond(2 * first) {
            let (behind, _) = walk(drawing, &mut used, before, beyond);
            edges = behind.iter().rev().map(OutlineEdge::reversed).chain(edges).collect();
        }
        let (gap, count) = close(&mut edges, is_loop);
        widest = (if gap > widest.0 { gap } else { widest.0 }, widest.1 + count);
        if is_loop {
            drawing.loops.push(edges);
        } else {
            lines.push(edges);
        }
    }
    drawing.paths.clear();
    if widest.1 > 0 {
        notes.push(format!("{} joints of ends up to {:.2e} mm apart were closed", widest.1, widest.0));
    }
    leave_out_repeated_loops(drawing, snap, &mut notes);
    drawing.notes.append(&mut notes);
    Ok(lines)
}

/// The edges from a path, entered by an end, on to an end that no other meets, or around back to it: then it is a loop.
fn walk(
    drawing: &Drawing,
    used: &mut [bool],
    mut entered: usize,
    beyond: impl Fn(usize) -> Option<usize>,
) -> (Vec<OutlineEdge>, bool) {
    let mut edges: Vec<OutlineEdge> = Vec::new();
    loop {
        let path = entered / 2;
        used[path] = true;
        let forward = &drawing.paths[path];
        if entered.is_multiple_of(2) {
            edges.extend(forward.iter().copied());
        } else {
            edges.extend(forward.iter().rev().map(OutlineEdge::reversed));
        }
        // Left by the end that was not entered; two ends meet in a joint, so that the walk comes back only to where it began.
        match beyond(entered ^ 1) {
            None => return (edges, false),
            Some(next) if used[next / 2] => return (edges, true),
            Some(next) => entered = next,
        }
    }
}

/// The ends that no other end meets, as index of the path and true if it is the path's last point.
pub(super) fn open_ends(paths: &[Vec<OutlineEdge>], snap: f64) -> Vec<(usize, bool)> {
    let joints = joints(paths, if snap > SAME { snap } else { SAME });
    let mut count = vec![0usize; joints.len()];
    for &joint in &joints {
        count[joint] += 1;
    }
    let open = (0..joints.len()).filter(|&end| count[joints[end]] == 1);
    open.map(|end| (end / 2, !end.is_multiple_of(2))).collect()
}

/// Leaves out paths that begin and end in one joint and are no longer than it is wide.
fn drop_specks(drawing: &mut Drawing, snap: f64, notes: &mut Vec<String>) {
    let length = |p: &[OutlineEdge]| p.iter().map(OutlineEdge::length).sum::<f64>();
    let paths = std::mem::take(&mut drawing.paths);
    let (kept, specks): (Vec<_>, Vec<_>) = paths.into_iter().partition(|p| length(p) > snap);
    drawing.paths = kept;
    let each: Vec<String> = specks
        .iter()
        .filter_map(|p| p.first())
        .map(|e| format!("{} is shorter than the snap and left out", drawing.entity(e.label)))
        .collect();
    notes.extend(sentences("entities shorter than the snap", &each));
}

/// The joint of each end, numbered by its lowest end; ends `2 i` and `2 i + 1` are start and end of path `i`.
fn joints(paths: &[Vec<OutlineEdge>], snap: f64) -> Vec<usize> {
    let points: Vec<DVec2> = paths
        .iter()
        .flat_map(|p| [p.first().map(|e| e.start), p.last().map(|e| e.end)])
        .map(Option::unwrap_or_default)
        .collect();
    let cell = |p: DVec2| ((p.x / snap).floor() as i64, (p.y / snap).floor() as i64);
    let mut cells: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    for (i, &p) in points.iter().enumerate() {
        cells.entry(cell(p)).or_default().push(i);
    }
    let mut joint = Sets::new(points.len());
    for (i, &p) in points.iter().enumerate() {
        let (cx, cy) = cell(p);
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            let Some(near) = cells.get(&(cx.saturating_add(dx), cy.saturating_add(dy))) else { continue };
            for &j in near.iter().filter(|&&j| j < i && points[j].distance(p) <= snap) {
                joint.join(i as u32, j as u32);
            }
        }
    }
    (0..points.len()).map(|i| joint.least(i as u32) as usize).collect()
}

/// The edge at an end, and its point.
fn edge_at(drawing: &Drawing, end: usize) -> (OutlineEdge, DVec2) {
    let path = &drawing.paths[end / 2];
    if end.is_multiple_of(2) {
        (path[0], path[0].start)
    } else {
        (path[path.len() - 1], path[path.len() - 1].end)
    }
}

fn no_branches(drawing: &Drawing, ends_of: &[Vec<usize>]) -> Result<()> {
    let edge_at = |end: usize| edge_at(drawing, end);
    if let Some(branch) = ends_of.iter().find(|ends| ends.len() > 2) {
        let p = edge_at(branch[0]).1;
        let names: Vec<String> = branch.iter().map(|&e| drawing.entity(edge_at(e).0.label)).collect();
        let what = format!("{} ends meet at ({:.4}, {:.4}): {}", branch.len(), p.x, p.y, names.join(", "));
        return Err(drawing
            .error_at(edge_at(branch[0]).0.label, Code::OUTLINE_OPEN, what)
            .value(branch.len() as f64, "ends")
            .bound(2.0, "ends")
            .point([p.x, p.y, 0.0])
            .help("remove or move to another layer what does not belong to the outline")
            .into());
    }
    Ok(())
}

fn no_open_ends(drawing: &Drawing, ends_of: &[Vec<usize>]) -> Result<()> {
    let edge_at = |end: usize| edge_at(drawing, end);
    let open: Vec<usize> = ends_of.iter().filter(|ends| ends.len() == 1).map(|ends| ends[0]).collect();
    let Some(&end) = open.first() else { return Ok(()) };
    let (edge, p) = edge_at(end);
    // The nearest open end is most likely the one that was meant.
    let nearest = open
        .iter()
        .copied()
        .filter(|&other| other != end)
        .min_by(|&a, &b| edge_at(a).1.distance(p).total_cmp(&edge_at(b).1.distance(p)));
    let (other, q) = nearest.map_or((edge, p), edge_at);
    let what = format!(
        "the outline is open: gap between ({:.4}, {:.4}), {}, and ({:.4}, {:.4}), {}; {} open ends in all",
        p.x,
        p.y,
        drawing.entity(edge.label),
        q.x,
        q.y,
        drawing.entity(other.label),
        open.len(),
    );
    Err(drawing
        .error_at(edge.label, Code::OUTLINE_OPEN, what)
        .value_mm(p.distance(q))
        .point([p.x, p.y, 0.0])
        .help("close the gap in the drawing, or allow a larger snap")
        .into())
}

/// Brings the ends of neighbours together, and in a loop those of the last and the first; the widest gap and their number.
fn close(edges: &mut [OutlineEdge], is_loop: bool) -> (f64, usize) {
    let n = edges.len();
    let mut widest = (0.0, 0);
    for i in 0..if is_loop { n } else { n.saturating_sub(1) } {
        let next = (i + 1) % n;
        let (a, b) = (edges[i].end, edges[next].start);
        let gap = a.distance(b);
        if gap == 0.0 {
            continue;
        }
        if gap > SAME {
            widest = (if gap > widest.0 { gap } else { widest.0 }, widest.1 + 1);
        }
        let p = match (edges[i].turn, edges[next].turn) {
            (Some(_), None) => a,
            (None, Some(_)) => b,
            _ => 0.5 * (a + b),
        };
        edges[i] = with_ends(&edges[i], edges[i].start, p);
        edges[next] = with_ends(&edges[next], p, edges[next].end);
    }
    widest
}
