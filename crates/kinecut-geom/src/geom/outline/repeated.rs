//! Repetitions in a drawing: the same line over another, the same circle, the same loop.

use std::collections::BTreeSet;

use glam::DVec2;

use super::OutlineEdge;
use super::drawing::{Drawing, sentences};

/// Leaves out open paths that follow an earlier one within `near` [mm], either way round.
pub(super) fn leave_out_repeated_paths(drawing: &mut Drawing, near: f64, notes: &mut Vec<String>) {
    let paths = std::mem::take(&mut drawing.paths);
    let marks = |p: &Vec<OutlineEdge>| ends_and_middles(p);
    drawing.paths = leave_out(drawing, paths, marks, near, notes);
}

/// Leaves out loops that follow an earlier one within `near` [mm], either way round and from any point on.
pub(super) fn leave_out_repeated_loops(drawing: &mut Drawing, near: f64, notes: &mut Vec<String>) {
    let loops = std::mem::take(&mut drawing.loops);
    let marks = |l: &Vec<OutlineEdge>| match (&l[..], l.first().and_then(|e| e.turn)) {
        // A circle begins where it likes.
        ([_], Some(t)) => {
            [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y].map(|d| t.centre + t.radius * d).to_vec()
        }
        _ => ends_and_middles(l),
    };
    drawing.loops = leave_out(drawing, loops, marks, near, notes);
}

fn ends_and_middles(edges: &[OutlineEdge]) -> Vec<DVec2> {
    edges.iter().flat_map(|e| [e.start, e.at(0.5), e.end]).collect()
}

/// Leaves out chains whose marks are, in any order, those of an earlier one.
fn leave_out(
    drawing: &Drawing,
    chains: Vec<Vec<OutlineEdge>>,
    marks: impl Fn(&Vec<OutlineEdge>) -> Vec<DVec2>,
    near: f64,
    notes: &mut Vec<String>,
) -> Vec<Vec<OutlineEdge>> {
    let mut each = Vec::new();
    let all: Vec<Vec<DVec2>> = chains.iter().map(marks).collect();
    let centre = |m: &[DVec2]| m.iter().sum::<DVec2>() / m.len().max(1) as f64;
    // Equal chains have equal centres: sorted by them only near ones are compared.
    let mut order: Vec<(f64, usize)> = all.iter().enumerate().map(|(i, m)| (centre(m).x, i)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut repeated = BTreeSet::new();
    for (k, &(x, i)) in order.iter().enumerate() {
        for &(y, j) in order[k + 1..].iter().take_while(|(y, _)| y - x <= near) {
            debug_assert!(y >= x, "sorted");
            let (first, last) = if i < j { (i, j) } else { (j, i) };
            if all[first].len() == all[last].len()
                && centre(&all[first]).distance(centre(&all[last])) <= near
                && covers(&all[first], &all[last], near)
                && covers(&all[last], &all[first], near)
                && !repeated.contains(&first)
                && repeated.insert(last)
            {
                let [first, last] = [first, last].map(|c| chains[c].first().map_or(0, |e| e.label));
                each.push(format!(
                    "{} repeats {} and is left out",
                    drawing.entity(last),
                    drawing.entity(first)
                ));
            }
        }
    }
    notes.extend(sentences("entities that repeat others", &each));
    chains.into_iter().enumerate().filter(|(i, _)| !repeated.contains(i)).map(|(_, c)| c).collect()
}

/// True if each point has one of the others nearby.
fn covers(points: &[DVec2], others: &[DVec2], near: f64) -> bool {
    points.iter().all(|p| others.iter().any(|q| q.distance(*p) <= near))
}
