//! Moves that go where their own tool has cut before: they meet nothing.
//!
//! A move that was cut from above has left nothing above its underside (`above`). A tool that was made smaller by the clearance, no
//! farther beside the way of the same tool than half of that and no lower, lies in what that took, at any height: retracts beside a
//! wall, descents to where the tool has been, ways back along a slot. Whether this holds on all of a straight way is asked of the
//! moves before it, one after another; each covers an interval of it, as both ways are convex.

use glam::{DVec2, DVec3};

use super::axis::ToolFrame;
use super::list::CutList;
use super::piece::{MovePiece, pieces};
use super::plan::Plan;
use crate::geom::{Aabb, CurveKind};

/// Moves just before one that are asked first: a retract follows the cut.
const LAST: usize = 12;

/// Ways shorter than this, seen along the tool, have no direction [mm].
const STANDING: f64 = 1e-9;

/// A straight way of a tool that shall meet nothing, in the frame of the tool.
struct Way {
    start: DVec3,
    along: DVec3,
    /// Length across the tool axis.
    length: f64,
    /// Distance that counts as none [mm].
    near: f64,
    /// Intervals that are known to be clear, by fractions of the way.
    clear: Vec<(f64, f64)>,
}

/// Whether a move that should meet nothing is known to do so by the moves from `from` on before it for which `whole` says that they
/// were cut from above, or will be.
pub(super) fn is_followed(
    list: &CutList,
    (from, index): (usize, usize),
    frame: &ToolFrame,
    whole: impl Fn(usize) -> bool + Copy,
) -> bool {
    let one = &list.moves[index];
    let CurveKind::Line(line) = one.curve.kind() else { return false };
    let tool = &list.tools[one.body as usize];
    // The shank is asked for by itself where it is wider than what cuts.
    if tool.hollow.is_some() || tool.shank.radius > tool.cutting.radius {
        return false;
    }
    let to_frame = frame.rotation();
    let [start, end] = [line.start, line.end].map(|p| to_frame.point(p));
    let along = end - start;
    let near = 0.5 * list.options.clearance;
    let mut way = Way { start, along, length: along.truncate().length(), near, clear: Vec::new() };
    let mut asked = |i: usize| {
        let earlier = &list.moves[i];
        let cuts =
            earlier.removes && !earlier.watch && earlier.body == one.body && earlier.stance == one.stance;
        cuts && whole(i) && {
            let (parts, _) = pieces(&earlier.curve, frame, list.options.path_tolerance);
            parts.iter().any(|piece| way.note(piece))
        }
    };
    let last = from.max(index.saturating_sub(LAST));
    if (last..index).rev().any(&mut asked) {
        return true;
    }
    let around = Aabb::of_points([line.start, line.end]).grown(near);
    let meets = |grown: Aabb| {
        let (min, max) = (grown.min + tool.radius, grown.max - tool.radius);
        let across = frame.axes.iter().take(2).map(|axis| axis.index());
        across.into_iter().all(|k| min[k] <= around.max[k] && around.min[k] <= max[k])
    };
    list.near(from..last, meets).rev().any(asked)
}

impl Way {
    /// Notes what a piece of a move has cut on the way; true when all of it is known to be clear.
    fn note(&mut self, piece: &MovePiece) -> bool {
        let clear = if self.length > STANDING { self.beside(piece) } else { self.above(piece) };
        let Some((from, to)) = clear.filter(|(from, to)| from < to) else { return false };
        self.clear.push((from, to));
        self.clear.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.clear.iter().fold(0.0, |end, (from, to)| if *from <= end && *to > end { *to } else { end })
            >= 1.0
    }

    /// The interval of a way along the tool axis that lies above a piece.
    fn above(&self, piece: &MovePiece) -> Option<(f64, f64)> {
        let at = self.start.truncate();
        let t = piece.plan.nearest(at);
        if piece.plan.point(t).distance(at) > self.near {
            return None;
        }
        let floor = match piece.plan {
            Plan::Dot(_) => piece.w[0].min(piece.w[1]),
            _ => piece.tip(t),
        } - self.near;
        let [low, high] = [self.start.z, self.start.z + self.along.z];
        if low.min(high) >= floor {
            return Some((0.0, 1.0));
        }
        let passed = (floor - low) / self.along.z;
        match (low >= floor, high >= floor) {
            (true, false) => Some((0.0, passed)),
            (false, true) => Some((passed, 1.0)),
            _ => None,
        }
    }

    /// The interval of a way across the tool axis that runs above a straight piece.
    fn beside(&self, piece: &MovePiece) -> Option<(f64, f64)> {
        let Plan::Line(line) = piece.plan else { return None };
        let fraction =
            |p: DVec2| (p - self.start.truncate()).dot(self.along.truncate()) / (self.length * self.length);
        let [a, b] = [line.start, line.start + line.way].map(fraction);
        // A little beyond its ends, so that one piece joins the next.
        let beyond = 0.5 * self.near / self.length;
        let (from, to) = ((a.min(b) - beyond).max(0.0), (a.max(b) + beyond).min(1.0));
        let is_clear = |t: f64| {
            let p = self.start + self.along * t;
            let nearest = piece.plan.nearest(p.truncate());
            piece.plan.point(nearest).distance(p.truncate()) <= self.near
                && piece.tip(nearest) - self.near <= p.z
        };
        (from < to && is_clear(from) && is_clear(to)).then_some((from, to))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::reference::Random;
    use super::super::{CutAxis, CutMove, CutOptions, ToolBody};
    use super::*;
    use crate::geom::{Arc, Curve, Line, Profile};

    const STEP: f64 = 0.5;

    /// Ways of one tool in and out of a slot that it cuts, some of them beside it, with a clearance that shows.
    fn story(random: &mut Random, axis: CutAxis) -> Vec<CutMove> {
        let up = axis.vector();
        let (side, other) = (DVec3::new(up.z, up.x, up.y), up.cross(DVec3::new(up.z, up.x, up.y)));
        let at = |x: f64, y: f64, z: f64| side * x + other * y + up * z;
        let line = |start: DVec3, end: DVec3| CutMove::new(Line { start, end }, axis, 0);
        let mut moves = Vec::new();
        let depth = |random: &mut Random| -random.within(0.5, 3.0);
        for row in 0..6 {
            let y = f64::from(row) * random.within(0.5, 2.0);
            let stations: Vec<DVec3> = (0..5).map(|k| at(2.0 * f64::from(k), y, depth(random))).collect();
            for pair in stations.windows(2) {
                moves.push(line(pair[0], pair[1]));
            }
            let centre = stations[4] + other;
            let curve: Curve = match row % 2 {
                0 => Arc::new(stations[4], centre, up, 2.0, -0.3).unwrap().into(),
                _ => Line { start: stations[4], end: stations[4] + other * 0.7 }.into(),
            };
            let end = curve.end();
            moves.push(CutMove::new(curve, axis, 0));
            // Up beside what was cut, back over it, and down again, more or less where the tool has been.
            let off = |random: &mut Random| random.within(-0.04, 0.04);
            moves.push(line(end + side * off(random), end + up * 5.0).watched());
            let (from, to) = (random.within(0.0, 8.0), random.within(0.0, 8.0));
            let z = -random.within(0.0, 1.0);
            let beside = off(random);
            moves.push(line(at(from, y + beside, z), at(to, y + off(random), z)).watched());
            moves.push(line(at(from, y + beside, 4.0), at(from, y + beside, z)).watched());
            moves.push(line(at(2.0, y + beside, z - 1.0), at(2.0, y + beside, 1.0)).watched());
        }
        moves
    }

    /// Least height of the underside of a tool over a place, over many poses of moves; in the frame of the tool.
    fn underside(list: &CutList, moves: std::ops::Range<usize>, frame: &ToolFrame, over: DVec2) -> f64 {
        let mut least = f64::INFINITY;
        for m in list.moves[moves].iter().filter(|m| !m.watch) {
            let n = 4000;
            for i in 0..=n {
                let s = m.curve.length() * f64::from(i) / f64::from(n);
                let tip = frame.rotation().point(m.curve.at(s).p);
                let rho = tip.truncate().distance(over);
                for part in list.tools[0].cutting.parts.iter().filter(|part| rho <= part.r1) {
                    least = least.min(tip.z + part.height(rho));
                }
            }
        }
        least
    }

    #[test]
    fn a_tool_that_follows_lies_in_what_it_has_cut() {
        let mut random = Random(31);
        let shapes = [
            Profile::bull_nose(6.0, 3.0, 20.0),
            Profile::bull_nose(6.0, 1.0, 20.0),
            Profile::cylinder(6.0, 20.0),
        ];
        let (mut followed, mut asked) = (0, 0);
        for round in 0..kinecut_cases::cases(12, 200) {
            let axis = CutAxis::ALL[round as usize % 6];
            let frame = ToolFrame::new(axis);
            let tool = ToolBody::new(shapes[round as usize % 3].clone().unwrap());
            let options = CutOptions { clearance: 0.05, ..CutOptions::default() };
            let list = CutList::new(&[tool], story(&mut random, axis), &options, STEP).unwrap();
            for index in (0..list.moves.len()).filter(|i| list.moves[*i].watch) {
                asked += 1;
                if !is_followed(&list, (0, index), &frame, |_| true) {
                    continue;
                }
                followed += 1;
                let m = &list.moves[index];
                for _ in 0..6 {
                    let tip = frame.rotation().point(m.curve.at(m.curve.length() * random.unit()).p);
                    let part = list.tools[0].contact.parts[0];
                    let (rho, angle) = (part.r1 * random.unit().sqrt(), random.within(0.0, 6.3));
                    let over = tip.truncate() + DVec2::from_angle(angle) * rho;
                    let floor = underside(&list, 0..index, &frame, over);
                    let own = tip.z + part.height(rho);
                    assert!(floor <= own, "round {round}, move {index}: {floor} above {own}");
                }
            }
        }
        assert!(5 * followed > asked && 5 * followed < 4 * asked, "{followed} of {asked}");
    }

    #[test]
    fn moves_that_were_not_cut_from_above_count_for_nothing() {
        let (axis, frame) = (CutAxis::PlusZ, ToolFrame::new(CutAxis::PlusZ));
        let at = |x: f64, z: f64| DVec3::new(x, 0.0, z);
        let line = |start: DVec3, end: DVec3| CutMove::new(Line { start, end }, axis, 0);
        let back = |moves: &[CutMove], whole: bool| {
            let mut moves = moves.to_vec();
            moves.push(line(at(5.0, -1.0), at(0.0, -1.0)).watched());
            let tool = ToolBody::new(Profile::cylinder(6.0, 20.0).unwrap());
            let index = moves.len() - 1;
            let list = CutList::new(&[tool], moves, &CutOptions::default(), STEP).unwrap();
            is_followed(&list, (0, index), &frame, |_| whole)
        };
        let halves = [line(at(0.0, -1.0), at(2.0, -1.0)), line(at(2.0, -1.2), at(6.0, -1.2))];
        assert!(back(&halves, true));
        assert!(!back(&halves, false));
        // A gap, a step up, and a way that was only looked at.
        assert!(!back(&[halves[0].clone(), line(at(2.1, -1.2), at(6.0, -1.2))], true));
        assert!(!back(&[halves[0].clone(), line(at(2.0, -0.9), at(6.0, -0.9))], true));
        assert!(!back(&[halves[0].clone().watched(), halves[1].clone()], true));
    }
}
