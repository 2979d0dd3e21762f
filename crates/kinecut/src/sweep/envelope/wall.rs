//! The walls of an envelope: strips between the grazing curves of neighbouring moments.
//!
//! On the plane of place along the chain and time, the circles with two grazing points fill regions; the envelope lies over them
//! in two sheets, one for each branch, which meet in folds. A moment cuts the regions in intervals, one for each curve. Intervals
//! of neighbouring moments that overlap belong together: for each sheet one strip joins the lower to the upper ones. Where their
//! numbers differ, two curves join or part: the gap between them becomes an edge of both sheets, where they meet as well. An
//! interval without a partner is closed between its own branches. So every edge has two faces, whatever the curves do.

use std::ops::Range;

use super::slice::{Slice, WIDTH};
use super::strip::{Builder, Station, Step, steps};

/// The vertices of a slice: for each node those of the plus and of the minus branch.
pub(super) struct Rail {
    pub vertices: Vec<[u32; 2]>,
}

impl Rail {
    pub(super) fn new(slice: &Slice, builder: &mut Builder) -> Rail {
        let vertices = slice.nodes.iter().map(|node| {
            let plus = builder.vertex(node.points[0]);
            [plus, if node.one { plus } else { builder.vertex(node.points[1]) }]
        });
        Rail { vertices: vertices.collect() }
    }
}

/// A point of one of two slices, with its place along the line that it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rung {
    pub along: f64,
    /// Whether it is of the later slice.
    pub after: bool,
    pub node: usize,
    pub branch: usize,
}

/// Loops of two neighbouring slices that belong together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Kin {
    pub before: Range<usize>,
    pub after: Range<usize>,
}

impl Kin {
    /// Whether one curve goes on as one curve.
    pub(super) fn is_plain(&self) -> bool {
        self.before.len() == 1 && self.after.len() == 1
    }
}

/// Overlap of intervals that counts as touching: twice the width of a circle.
const TOUCH: f64 = 3.0 * WIDTH;

/// How the loops of two slices belong together: those whose intervals overlap.
pub(super) fn kin(before: &Slice, after: &Slice) -> Vec<Kin> {
    let (mut i, mut j) = (0, 0);
    let mut all = Vec::new();
    while i < before.loops.len() || j < after.loops.len() {
        let (i0, j0) = (i, j);
        let (mut start, mut end) = (f64::INFINITY, f64::NEG_INFINITY);
        loop {
            let next = |slice: &Slice, k: usize| slice.loops.get(k).map(|of| slice.extent(of));
            let (a, b) = (next(before, i), next(after, j));
            let first = match (a, b) {
                (Some(a), Some(b)) => a[0] <= b[0],
                (Some(_), None) => true,
                (None, Some(_)) => false,
                (None, None) => break,
            };
            let Some([from, to]) = (if first { a } else { b }) else { break };
            // Intervals that only touch are apart, but for those of no width: circles that graze as a whole.
            let beside = (from - end).abs() < TOUCH && (to - from < TOUCH || end - start < TOUCH);
            if end != f64::NEG_INFINITY && from >= end - TOUCH && !beside {
                break;
            }
            start = start.min(from);
            end = end.max(to);
            *(if first { &mut i } else { &mut j }) += 1;
        }
        all.push(Kin { before: i0..i, after: j0..j });
    }
    all
}

/// Adds the walls between two slices.
pub(super) fn wall(builder: &mut Builder, before: (&Slice, &Rail), after: (&Slice, &Rail)) {
    let station = |rung: &Rung| {
        let rail = if rung.after { after.1 } else { before.1 };
        Station { along: rung.along, vertex: rail.vertices[rung.node][rung.branch] }
    };
    let (mut below, mut above) = (Vec::new(), Vec::new());
    sheets(before.0, after.0, |lower, upper, flip| {
        below.clear();
        above.clear();
        below.extend(lower.iter().map(station));
        above.extend(upper.iter().map(station));
        builder.strip(&below, &above, flip);
        false
    });
}

/// Whether any edge across the strips between two slices is as asked, diagonals among them.
pub(super) fn any_edge(before: &Slice, after: &Slice, mut asked: impl FnMut([&Rung; 2]) -> bool) -> bool {
    sheets(before, after, |lower, upper, _| {
        let ([first, ..], [other, ..]) = (lower, upper) else { return false };
        let along = |line: &[Rung], k: usize| line.get(k).map(|rung| rung.along);
        asked([first, other])
            || steps(|i| along(lower, i), |j| along(upper, j)).any(|step| match step {
                Step::Lower { from, upper: j } => asked([&lower[from + 1], &upper[j]]),
                Step::Upper { from, lower: i } => asked([&lower[i], &upper[from + 1]]),
            })
    })
}

/// Tells the strips between two slices, as a lower and an upper line and whether their sense is turned, until one is as asked.
fn sheets(before: &Slice, after: &Slice, mut asked: impl FnMut(&[Rung], &[Rung], bool) -> bool) -> bool {
    let (mut lower, mut upper) = (Vec::new(), Vec::new());
    for kin in kin(before, after) {
        // Curves of the same stretches are joined at the same parts of them.
        let alike = kin.is_plain() && before.kinds[kin.before.start] == after.kinds[kin.after.start];
        for branch in 0..2 {
            line(&mut lower, before, kin.before.clone(), [false, alike], branch);
            line(&mut upper, after, kin.after.clone(), [true, alike], branch);
            if lower.is_empty() || upper.is_empty() {
                continue;
            }
            if let ([.., a], [.., b], [_, c, ..], [_, d, ..]) =
                (&lower[..], &upper[..], &upper[..], &lower[..])
                && (a.along <= c.along || b.along <= d.along)
            {
                // They hardly overlap: by their parts, as a triangle from end to end would be in both sheets.
                by_part(&mut lower);
                by_part(&mut upper);
            }
            if asked(&lower, &upper, branch == 1) {
                return true;
            }
        }
        if kin.before.is_empty() || kin.after.is_empty() {
            // Born or gone: closed between its own branches.
            let born = kin.before.is_empty();
            let (slice, loops) = if born { (after, kin.after) } else { (before, kin.before) };
            line(&mut lower, slice, loops.clone(), [born, false], 0);
            line(&mut upper, slice, loops, [born, false], 1);
            if asked(&lower, &upper, born) {
                return true;
            }
        }
    }
    false
}

/// One branch of some loops as a line.
fn line(into: &mut Vec<Rung>, slice: &Slice, loops: Range<usize>, [after, by_place]: [bool; 2], branch: usize) {
    into.clear();
    into.extend(slice.loops[loops].iter().flat_map(|of| of.clone()).map(|i| {
        let node = &slice.nodes[i];
        let along = if by_place { node.place } else { node.along };
        Rung { along, after, node: i, branch }
    }));
}

/// Places as parts of the whole.
fn by_part(line: &mut [Rung]) {
    let (Some(first), Some(last)) = (line.first().copied(), line.last().copied()) else { return };
    let width = last.along - first.along;
    for rung in line {
        rung.along = if width > 0.0 { (rung.along - first.along) / width } else { 0.0 };
    }
}
