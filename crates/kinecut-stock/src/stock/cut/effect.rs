//! Effects of moves on the lines of a tile, and the sum over tiles.

use super::{BodyContact, Edge, MoveEffect, RareEffect};
use crate::geom::Aabb;
use crate::stock::{FIXED_STEP, Interval};

/// The part of the tool that is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Looked {
    /// The cutting part.
    Cutting,
    /// The shank.
    Shank,
    /// The holder.
    Holder,
}

/// Length of material met [fixed steps], and where.
pub(super) type Touch = (i64, [f64; 3]);

/// An edge near a body: how much of it [fixed steps], where it is most, and the box of all places.
pub(super) type Near = (i64, [f64; 3], Aabb);

/// Takes in an edge seen near a body.
pub(super) fn near(kept: &mut Option<Near>, (length, point, bounds): Near) {
    let (most, at, all) = kept.unwrap_or((i64::MIN, point, Aabb::EMPTY));
    let (most, at) = if length > most { (length, point) } else { (most, at) };
    *kept = Some((most, at, all.union(bounds)));
}

/// Effect of a move on the lines of one direction in a tile or strip; lengths in fixed steps, along the lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Effect {
    /// Index of the move.
    pub(super) index: u32,
    pub(super) removed: i64,
    pub(super) deepest: i64,
    /// Fraction of the move and point.
    pub(super) first: Option<(f64, [f64; 3])>,
    pub(super) shank: Option<Touch>,
    pub(super) holder: Option<Touch>,
    pub(super) core: Option<Touch>,
    /// Edges of material near the bodies, by [`Looked`]: see `edge.rs`.
    pub(super) edges: [Option<Near>; 3],
    /// Walls thinner than the distance of the lines, just below the bodies; of a tool that leans all material near them, with a
    /// length above zero where it goes on under a body.
    pub(super) thin: [Option<Near>; 3],
}

/// The effects of moves on one tile, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct Effects {
    list: Vec<Effect>,
}

impl Effects {
    /// The entry of a move.
    pub(super) fn of(&mut self, index: u32) -> &mut Effect {
        if self.list.last().is_none_or(|e| e.index != index) {
            self.list.push(Effect { index, ..Effect::default() });
        }
        let last = self.list.len() - 1;
        &mut self.list[last]
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Effect> {
        self.list.iter()
    }
}

/// Keeps the deeper touch, the older one of equals.
pub(super) fn deeper(kept: &mut Option<Touch>, depth: i64, point: impl FnOnce() -> [f64; 3]) {
    if kept.is_none_or(|(d, _)| depth > d) {
        *kept = Some((depth, point()));
    }
}

/// Sums effects over tiles and strips: always called in their order.
pub(super) struct Sum {
    /// Removed length on the lines along the tool axis.
    removed: i128,
    /// Material met on the lines along the tool axis, and along the two axes across it.
    met: [Effect; 3],
    /// The tool leans or turns.
    leans: bool,
}

impl Sum {
    /// Nothing yet.
    pub(super) fn new(leans: bool) -> Sum {
        Sum { removed: 0, met: [Effect::default(); 3], leans }
    }

    /// Adds what was met on lines of a direction: 0 along the tool axis, 1 and 2 across it.
    pub(super) fn add(&mut self, e: &Effect, direction: usize) {
        self.removed += i128::from(e.removed);
        let sum = &mut self.met[direction];
        sum.deepest = sum.deepest.max(e.deepest);
        if let Some((t, point)) = e.first
            && sum.first.is_none_or(|(old, _)| t < old)
        {
            sum.first = Some((t, point));
        }
        for (kept, new) in [(&mut sum.shank, e.shank), (&mut sum.holder, e.holder), (&mut sum.core, e.core)] {
            if let Some((depth, point)) = new {
                deeper(kept, depth, || point);
            }
        }
        let edges = e.edges.into_iter().chain(e.thin);
        for (kept, new) in sum.edges.iter_mut().chain(&mut sum.thin).zip(edges) {
            if let Some(new) = new {
                near(kept, new);
            }
        }
    }

    /// In mm, for lines at a distance of `step`; `filled` when a hollow tool was cut as if it were none.
    pub(super) fn effect(&self, step: f64, path_error: f64, filled: bool) -> MoveEffect {
        let [along, u, v] = &self.met;
        let mm = |length: i64| length as f64 * FIXED_STEP;
        let contact = |of: fn(&Effect) -> Option<Touch>| {
            let [depth, a, b] = [along, u, v].map(of);
            let (_, point) = depth.or(match (a, b) {
                (Some(a), Some(b)) => Some(if a.0 <= b.0 { a } else { b }),
                (a, b) => a.or(b),
            })?;
            let length = |c: Option<Touch>| c.map_or(0, |c| c.0);
            Some(BodyContact { depth: mm(length(depth)), width: mm(lesser(length(a), length(b))), point })
        };
        // Of equals the one on a line along the axis.
        let earlier = |a: Option<(f64, [f64; 3])>, b: &Effect| match (a, b.first) {
            (Some(a), Some(b)) => Some(if b.0 < a.0 { b } else { a }),
            (a, b) => a.or(b),
        };
        let met_any = |of: fn(&Effect) -> Option<Touch>| self.met.iter().any(|e| of(e).is_some());
        let first = earlier(earlier(along.first, u), v);
        let (deepest, widest) = (along.deepest, lesser(u.deepest, v.deepest));
        let [cutting, shank, holder] = [first.is_some(), met_any(|e| e.shank), met_any(|e| e.holder)];
        let edge = if self.leans { edge_of_leaning } else { edge };
        let unmet = |looked: Looked, met: bool| if met { None } else { edge(&self.met, looked, &mm) };
        let edges =
            [unmet(Looked::Cutting, cutting), unmet(Looked::Shank, shank), unmet(Looked::Holder, holder)];
        let mut effect = MoveEffect {
            removed: self.removed as f64 * FIXED_STEP * step * step,
            deepest: mm(deepest),
            widest: mm(widest),
            first_contact: first.map(|(_, point)| point),
            as_filled: filled && deepest.max(widest) > 0,
            path_error,
            rare: None,
        };
        effect.set_rare(RareEffect {
            shank: contact(|e| e.shank),
            holder: contact(|e| e.holder),
            core: contact(|e| e.core),
            edge: edges.into_iter().flatten().reduce(|a, b| {
                let wider = if b.width > a.width { b } else { a };
                Edge { bounds: a.bounds.union(b.bounds), ..wider }
            }),
        });
        effect
    }
}

/// The edge of material that a body may clip between the lines: one that the lines along the tool axis and those across it
/// both say is near, or a wall between the lines.
fn edge([along, u, v]: &[Effect; 3], looked: Looked, mm: &dyn Fn(i64) -> f64) -> Option<Edge> {
    let k = looked as usize;
    let either = |a: Option<Near>, b: Option<Near>| match (a, b) {
        (Some(a), Some(b)) => Some((a.0.min(b.0), if a.0 <= b.0 { a.1 } else { b.1 }, a.2.union(b.2))),
        (a, b) => a.or(b),
    };
    // Along the tool axis it is seen where it is; across, where the wall below it is.
    let above = along.edges[k].zip(either(u.edges[k], v.edges[k]));
    let above = above.map(|((height, point, bounds), (width, ..))| (height, width, point, bounds));
    let thin = either(u.thin[k], v.thin[k]).map(|(width, point, bounds)| (0, width, point, bounds));
    let all = match (above, thin) {
        (Some(a), Some(b)) => Some((a.0, a.1.max(b.1), a.2, a.3.union(b.3))),
        (a, b) => a.or(b),
    };
    let (height, width, point, bounds) = all?;
    Some(Edge { height: mm(height), width: mm(width), point, bounds })
}

/// The edge of material that a body of a leaning tool may clip: lines of all directions that have material near the body say so.
fn edge_of_leaning(met: &[Effect; 3], looked: Looked, mm: &dyn Fn(i64) -> f64) -> Option<Edge> {
    let k = looked as usize;
    if met.iter().any(|e| e.edges[k].is_none() && e.thin[k].is_some_and(|(goes_on, ..)| goes_on == 0)) {
        return None;
    }
    let all = met.iter().filter_map(|e| e.edges[k]);
    let (width, point, bounds) = all.reduce(|a, b| {
        let wider = if b.0 > a.0 { b } else { a };
        (wider.0, wider.1, a.2.union(b.2))
    })?;
    Some(Edge { height: 0.0, width: mm(width), point, bounds })
}

/// The lesser of two lengths that were met; 0 marks a direction in which nothing was met.
fn lesser(a: i64, b: i64) -> i64 {
    if a == 0 || b == 0 { a.max(b) } else { a.min(b) }
}

/// True if a line has material between two coordinates, or ends at one of them: an end that an earlier move leaves as well.
pub(super) fn reaches(line: &[Interval], lo: i32, hi: i32) -> bool {
    line.iter().any(|i| i.lo.at <= hi && lo <= i.hi.at)
}

/// Length of the material of a line between two coordinates, and the ends of what is met.
pub(super) fn met(line: &[Interval], lo: i32, hi: i32) -> (i64, i32, i32) {
    let (mut length, mut first, mut last) = (0, i32::MAX, i32::MIN);
    for i in line {
        let (from, to) = (i.lo.at.max(lo), i.hi.at.min(hi));
        if from < to {
            length += i64::from(to) - i64::from(from);
            (first, last) = (first.min(from), last.max(to));
        }
    }
    (length, first, last)
}
