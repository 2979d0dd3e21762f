//! The walls of an envelope: strips between the grazing curves of neighbouring moments.
//!
//! On the plane of place along the chain and time, the circles with two grazing points fill regions; the envelope lies over them
//! in two sheets, one for each branch, which meet in folds. A moment cuts the regions in intervals, one for each curve. Intervals
//! of neighbouring moments that overlap belong together: for each sheet one strip joins the lower to the upper ones. Where their
//! numbers differ, two curves join or part: over the gap between them both sheets meet as well, at a vertex of their own. An
//! interval without a partner is closed between its own branches. So every edge has two faces, whatever the curves do.

use std::ops::Range;

use glam::DVec3;

use super::slice::{Node, Slice, WIDTH};
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

/// Kind of a point of a line across a slice.
#[derive(Clone, Copy, Debug)]
pub(super) enum At {
    /// A point of a branch at a node.
    Node { node: usize, branch: usize },
    /// The middle between a loop and the next one.
    Gap { after_loop: usize },
}

/// A point of one of two slices, with its place along the line that it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rung {
    pub along: f64,
    /// It belongs to the later slice.
    pub after: bool,
    pub at: At,
}

impl Rung {
    /// Its place [workpiece], and the pieces that it lies on or between.
    pub(super) fn place(&self, slice: &Slice) -> (DVec3, [usize; 2]) {
        match self.at {
            At::Node { node, branch } => {
                let node = &slice.nodes[node];
                (node.points[branch], [node.piece as usize; 2])
            }
            At::Gap { after_loop } => {
                let [a, b] = gap(slice, after_loop);
                (0.5 * (a.points[0] + b.points[0]), [a.piece as usize, b.piece as usize])
            }
        }
    }
}

impl Rung {
    /// True for a point of a circle that grazes as a whole.
    pub(super) fn is_still(&self, slice: &Slice) -> bool {
        matches!(self.at, At::Node { node, .. } if slice.nodes[node].still.is_some())
    }
}

/// The nodes between which there is a gap: the end of a loop and the start of the next.
fn gap(slice: &Slice, after_loop: usize) -> [&Node; 2] {
    let (a, b) = (&slice.loops[after_loop], &slice.loops[after_loop + 1]);
    [&slice.nodes[a.end - 1], &slice.nodes[b.start]]
}

/// Loops of two neighbouring slices that belong together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Kin {
    pub before: Range<usize>,
    pub after: Range<usize>,
}

impl Kin {
    /// True if one curve goes on as one curve.
    pub(super) fn is_plain(&self) -> bool {
        self.before.len() == 1 && self.after.len() == 1
    }
}

/// Overlap of intervals that counts as touching: twice the width of a circle.
const TOUCH: f64 = 3.0 * WIDTH;

/// Loops of two slices that belong together: those whose intervals overlap.
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
    let (mut below, mut above) = (Vec::new(), Vec::new());
    // Vertices in gaps: both sheets of this wall have them, and no other wall and no cap.
    let mut gaps: Vec<(bool, usize, u32)> = Vec::new();
    sheets(before.0, after.0, |lower, upper, flip| {
        let mut station = |rung: &Rung| {
            let (slice, rail) = if rung.after { after } else { before };
            let vertex = match rung.at {
                At::Node { node, branch } => rail.vertices[node][branch],
                At::Gap { after_loop } => {
                    let there = gaps.iter().find(|g| (g.0, g.1) == (rung.after, after_loop)).map(|g| g.2);
                    there.unwrap_or_else(|| {
                        let vertex = builder.vertex(rung.place(slice).0);
                        gaps.push((rung.after, after_loop, vertex));
                        vertex
                    })
                }
            };
            Station { along: rung.along, vertex }
        };
        below.clear();
        above.clear();
        below.extend(lower.iter().map(&mut station));
        above.extend(upper.iter().map(&mut station));
        builder.strip(&below, &above, flip);
        false
    });
    for kin in kin(before.0, after.0) {
        if kin.before.is_empty() {
            kin.after.for_each(|of| close(builder, after, of, true));
        } else if kin.after.is_empty() {
            kin.before.for_each(|of| close(builder, before, of, false));
        }
    }
}

/// Closes a loop that is born, or gone, between its own branches: over a line in their middle, as a cap may have edges across.
fn close(builder: &mut Builder, (slice, rail): (&Slice, &Rail), of: usize, born: bool) {
    let nodes = slice.loops[of].clone();
    let middle: Vec<Station> = nodes
        .clone()
        .map(|i| {
            let node = &slice.nodes[i];
            let own = rail.vertices[i][0];
            let vertex = if node.one { own } else { builder.vertex(0.5 * (node.points[0] + node.points[1])) };
            Station { along: node.along, vertex }
        })
        .collect();
    let [plus, minus] = [0, 1].map(|branch| -> Vec<Station> {
        let station = |i: usize| Station { along: slice.nodes[i].along, vertex: rail.vertices[i][branch] };
        nodes.clone().map(station).collect()
    });
    builder.strip(&plus, &middle, born);
    builder.strip(&middle, &minus, born);
}

/// True if any edge across the strips between two slices is as asked, diagonals among them; of a loop that is born or
/// gone, those across it.
pub(super) fn any_edge(before: &Slice, after: &Slice, mut asked: impl FnMut([&Rung; 2]) -> bool) -> bool {
    let across =
        |asked: &mut dyn FnMut([&Rung; 2]) -> bool, slice: &Slice, loops: Range<usize>, after: bool| {
            let rung = |node: usize, branch: usize| Rung {
                along: slice.nodes[node].along,
                after,
                at: At::Node { node, branch },
            };
            loops.flat_map(|of| slice.loops[of].clone()).any(|i| asked([&rung(i, 0), &rung(i, 1)]))
        };
    for kin in kin(before, after) {
        let found = match (kin.before.is_empty(), kin.after.is_empty()) {
            (true, _) => across(&mut asked, after, kin.after, true),
            (_, true) => across(&mut asked, before, kin.before, false),
            _ => false,
        };
        if found {
            return true;
        }
    }
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

/// Gives the strips between two slices, as a lower and an upper line and true if their sense is turned, until one is as
/// asked.
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
    }
    false
}

/// One branch of some loops as a line.
fn line(
    into: &mut Vec<Rung>,
    slice: &Slice,
    loops: Range<usize>,
    [after, by_place]: [bool; 2],
    branch: usize,
) {
    into.clear();
    for k in loops.clone() {
        into.extend(slice.loops[k].clone().map(|node| {
            let along = if by_place { slice.nodes[node].place[branch] } else { slice.nodes[node].along };
            Rung { along, after, at: At::Node { node, branch } }
        }));
        if k + 1 < loops.end {
            let [a, b] = gap(slice, k);
            into.push(Rung { along: 0.5 * (a.along + b.along), after, at: At::Gap { after_loop: k } });
        }
    }
}

/// Places as parts of the whole.
fn by_part(line: &mut [Rung]) {
    let (Some(first), Some(last)) = (line.first().copied(), line.last().copied()) else { return };
    let width = last.along - first.along;
    for rung in line {
        rung.along = if width > 0.0 { (rung.along - first.along) / width } else { 0.0 };
    }
}
