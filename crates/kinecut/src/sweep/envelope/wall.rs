//! The walls of an envelope: strips between the grazing curves of neighbouring moments.
//!
//! On the plane of place along the chain and time, the circles with two grazing points fill regions; the envelope lies over them
//! in two sheets, one for each branch, which meet in folds. A moment cuts the regions in intervals, one for each curve. Intervals
//! of neighbouring moments that overlap belong together: for each sheet one strip joins the lower to the upper ones. Where their
//! numbers differ, two curves join or part: the gap between them becomes an edge of both sheets, where they meet as well. An
//! interval without a partner is closed between its own branches. So every edge has two faces, whatever the curves do.

use std::ops::Range;

use super::slice::{Slice, WIDTH};
use super::strip::{Builder, Station};

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

    fn stations<'a>(
        &'a self,
        slice: &'a Slice,
        loops: Range<usize>,
        branch: usize,
        by_place: bool,
    ) -> impl Iterator<Item = Station> + 'a {
        slice.loops[loops].iter().flat_map(|of| of.clone()).map(move |i| {
            let node = &slice.nodes[i];
            let along = if by_place { node.place } else { node.along };
            Station { along, vertex: self.vertices[i][branch] }
        })
    }
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
    let (mut lower, mut upper) = (Vec::new(), Vec::new());
    for kin in kin(before.0, after.0) {
        // Curves of the same stretches are joined at the same parts of them.
        let alike = kin.is_plain() && before.0.kinds[kin.before.start] == after.0.kinds[kin.after.start];
        for branch in 0..2 {
            lower.clear();
            upper.clear();
            lower.extend(before.1.stations(before.0, kin.before.clone(), branch, alike));
            upper.extend(after.1.stations(after.0, kin.after.clone(), branch, alike));
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
            builder.strip(&lower, &upper, branch == 1);
        }
        if kin.before.is_empty() || kin.after.is_empty() {
            // Born or gone: closed between its own branches.
            let (slice, rail, loops, born) = if kin.before.is_empty() {
                (after.0, after.1, kin.after, true)
            } else {
                (before.0, before.1, kin.before, false)
            };
            let [plus, minus] =
                [0, 1].map(|branch| rail.stations(slice, loops.clone(), branch, false).collect::<Vec<_>>());
            builder.strip(&plus, &minus, born);
        }
    }
}

/// Places as parts of the whole.
fn by_part(line: &mut [Station]) {
    let (Some(first), Some(last)) = (line.first().copied(), line.last().copied()) else { return };
    let width = last.along - first.along;
    for station in line {
        station.along = if width > 0.0 { (station.along - first.along) / width } else { 0.0 };
    }
}
