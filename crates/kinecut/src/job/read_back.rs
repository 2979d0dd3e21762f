//! Distance of the posted text, as the control would read it, from the plan.

use serde::Serialize;

use crate::base::{Code, Error, Finding, Result};
use crate::geom::{Curve, CurveKind, Rigid, Rise, Spiral};
use crate::trace::{Segment, Trace};

/// The comparison of the text with the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ReadBack {
    /// Largest distance of the text's path from the exact curve of the plan [mm].
    pub largest: f64,
    /// Its place [part coordinates, mm].
    pub at: [f64; 3],
    /// Index of the item of the text there.
    pub item: u32,
    /// Number of moves compared.
    pub moves: usize,
    /// Number of points compared.
    pub points: usize,
    /// Largest angle between the directions of the tool [rad]; zero where the tool does not turn.
    pub largest_angle: f64,
}

/// Samples for each curve of the text, besides its ends: arcs of a chain lie off at a quarter and three quarters.
const SAMPLES: usize = 16;
/// Largest step of tangent angle between samples of an involute [rad].
const SAMPLE_TURN: f64 = 0.1;

/// Compares the trace of the text with the trace of the plan. `planned_item` gives for an item of the text the item
/// of the plan that it was written for.
///
/// # Errors
/// `KC0303` when a cutting move of the plan is missing from the text or has become something else.
pub fn compare(plan: &Trace, text: &Trace, planned_item: impl Fn(u32) -> Option<u32>) -> Result<ReadBack> {
    let mut answer = ReadBack::default();
    let moves =
        |t: &Trace| -> Vec<Segment> { t.segments.iter().filter(|s| !s.alternative).cloned().collect() };
    let (planned, written) = (moves(plan), moves(text));
    let mut next = 0;
    let groups: Vec<&[Segment]> = planned.chunk_by(|a, b| a.item == b.item).collect();
    let pieces_of = |item: u32, from: usize| {
        from + written[from..].iter().take_while(|s| planned_item(s.item) == Some(item)).count()
    };
    let mut at = 0;
    // A move is one segment of the plan and one or many pieces of the text; a cycle is many, one to one.
    while let Some(group) = groups.get(at) {
        // Coordinates that are said anew after a change of frame are rounded anew: the plan does not move there.
        let said_anew = |s: &Segment| {
            planned_item(s.item).is_some_and(|i| i < group[0].item) && s.curve.length() <= LOST_BELOW
        };
        while written.get(next).is_some_and(said_anew) {
            next += 1;
        }
        let to = pieces_of(group[0].item, next);
        let pieces = &written[next..to];
        // In a series of holes one block is the move to the hole and its cycle.
        if let ([_], Some(cycle)) = (*group, groups.get(at + 1).filter(|c| c.len() > 1)) {
            let both = pieces_of(cycle[0].item, to);
            let one_block = pieces.is_empty() != (both == to);
            if one_block && both - next == 1 + cycle.len() {
                for (segment, piece) in group.iter().chain(*cycle).zip(&written[next..both]) {
                    compare_move(segment, std::slice::from_ref(piece), &mut answer)?;
                }
                (at, next) = (at + 2, both);
                continue;
            }
        }
        (at, next) = (at + 1, to);
        if group.iter().chain(pieces).any(|s| s.turning.is_some()) {
            compare_turning(group, pieces, &mut answer)?;
            continue;
        }
        let pieces = match (*group, pieces) {
            ([_, _, ..], [place, cycle @ ..])
                if cycle.len() == group.len() && place.curve.length() <= LOST_BELOW =>
            {
                cycle
            }
            _ => pieces,
        };
        if let [segment] = group {
            compare_move(segment, pieces, &mut answer)?;
            continue;
        }
        // About a corner that is hardly one the control makes an arc in the plan and none in the text, or the other way round.
        let is_long = |s: &&Segment| s.curve.length() > LOST_BELOW || group.len() == pieces.len();
        let planned: Vec<&Segment> = group.iter().filter(is_long).collect();
        let there: Vec<&Segment> = pieces.iter().filter(is_long).collect();
        if planned.len() != there.len() {
            return Err(lost(&group[0]));
        }
        for (segment, piece) in planned.into_iter().zip(there) {
            compare_move(segment, std::slice::from_ref(piece), &mut answer)?;
        }
    }
    // A move of the user's template belongs to no item; it is simulated, not compared.
    while next < written.len() && planned_item(written[next].item).is_none() {
        next += 1;
    }
    if next < written.len() {
        return Err(Finding::error(Code::READ_BACK, "the text has a move that the plan does not have")
            .item(written[next].item)
            .point(written[next].curve.start().to_array())
            .help("this is a defect of the post: do not run the program")
            .into());
    }
    if !(answer.largest.is_finite() && answer.largest_angle.is_finite()) {
        return Err(Finding::error(
            Code::READ_BACK,
            "a move of the text could not be compared with the plan",
        )
        .item(answer.item)
        .help("this is a defect of kinecut: report it with the job")
        .into());
    }
    Ok(answer)
}

/// Places of a move in which the tool turns.
const TURNING_SAMPLES: u32 = 32;
/// Turn of the tool that may be lost in the rounding of the text [rad]: a few units of the third decimal of a degree.
const TURN_LOST_BELOW: f64 = 1e-4;

/// Compares a move in which the tool turns with what was written for it. Both are functions of the part of the way that is
/// done: the control moves all axes in proportion.
fn compare_turning(group: &[Segment], pieces: &[Segment], answer: &mut ReadBack) -> Result<()> {
    let [Some(first), Some(last)] = [group.first(), group.last()] else { return Ok(()) };
    let at = |segments: &[Segment], t: f64| {
        let place = t * segments.len() as f64;
        let index = (place as usize).min(segments.len() - 1);
        let segment = &segments[index];
        let part = place - index as f64;
        let pose = segment.pose(part * segment.curve.length());
        // A tool that turns about its tip has no arc length.
        let axis = match &segment.turning {
            Some(turning) => turning.axis(part).0,
            None => pose.axis,
        };
        (pose.tip.p, axis)
    };
    if pieces.is_empty() {
        let moved = (last.curve.end() - first.curve.start()).length();
        if moved > LOST_BELOW || first.axis.angle_between(last.end_axis()) > TURN_LOST_BELOW {
            return Err(lost(first));
        }
        return Ok(());
    }
    let rapid = |s: &Segment| s.motion == crate::trace::SegmentPace::Rapid;
    if pieces.iter().any(|p| rapid(p) != rapid(first)) {
        return Err(lost(first));
    }
    answer.moves += 1;
    for k in 0..=TURNING_SAMPLES {
        let t = f64::from(k) / f64::from(TURNING_SAMPLES);
        let ((tip, axis), (planned, wanted)) = (at(pieces, t), at(group, t));
        let distance = (tip - planned).length();
        answer.points += 1;
        answer.largest_angle = answer.largest_angle.max(axis.cross(wanted).length().atan2(axis.dot(wanted)));
        if distance > answer.largest {
            *answer = ReadBack { largest: distance, at: tip.to_array(), item: pieces[0].item, ..*answer };
        }
    }
    Ok(())
}

/// Compares a move of the plan with the pieces of the text that were written for it.
fn compare_move(segment: &Segment, pieces: &[Segment], answer: &mut ReadBack) -> Result<()> {
    let length: f64 = pieces.iter().map(|p| p.curve.length()).sum();
    if pieces.is_empty() && segment.curve.length() > LOST_BELOW
        || pieces.iter().any(|p| p.motion != segment.motion && !close_feed(p, segment))
            && !shares_time(segment, pieces)
    {
        return Err(lost(segment));
    }
    answer.moves += pieces.len();
    let mut before = 0.0;
    let mut foot = SpiralFoot::of(&segment.curve);
    for piece in pieces {
        for (s, p) in samples(&piece.curve) {
            let guess = (before + s) / length * segment.curve.length();
            let distance = match &mut foot {
                Some(foot) => foot.distance(p),
                None => distance_to(&segment.curve, p, guess),
            };
            answer.points += 1;
            if distance > answer.largest {
                *answer = ReadBack { largest: distance, at: p.to_array(), item: piece.item, ..*answer };
            }
        }
        before += piece.curve.length();
    }
    // The other way round, the text must reach the end of the plan's curve.
    if let Some(last) = pieces.last() {
        let gap = (last.curve.end() - segment.curve.end()).length();
        if gap > answer.largest {
            *answer =
                ReadBack { largest: gap, at: segment.curve.end().to_array(), item: last.item, ..*answer };
        }
    }
    Ok(())
}

fn lost(segment: &Segment) -> Error {
    Finding::error(Code::READ_BACK, "a move of the plan is not in the text as it was meant")
        .item(segment.item)
        .point(segment.curve.start().to_array())
        .help("this is a defect of the post: do not run the program")
        .into()
}

/// Moves shorter than any control's resolution may vanish when they are written [mm].
const LOST_BELOW: f64 = 2e-3;

/// Whether the pieces of a move take its time, at one feed: chords are a little shorter than their curve, and where the time is
/// given they are slower by as much. A piece that could as well vanish has a time of few digits.
fn shares_time(segment: &Segment, pieces: &[Segment]) -> bool {
    use crate::trace::SegmentPace::Feed;
    let mut time = 0.0;
    let mut length = 0.0;
    for piece in pieces {
        let (Feed(_), Some(seconds)) = (piece.motion, piece.duration) else { return false };
        time += seconds;
        length += piece.curve.length();
    }
    let (Feed(_), Some(planned)) = (segment.motion, segment.duration) else { return false };
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-3 * b.abs();
    let even = |p: &Segment| {
        p.curve.length() <= LOST_BELOW || matches!(p.motion, Feed(feed) if close(feed, length / time))
    };
    close(time, planned) && pieces.iter().all(even)
}

/// Feeds are written with few decimals: equal to a thousandth.
fn close_feed(a: &Segment, b: &Segment) -> bool {
    use crate::trace::SegmentPace::Feed;
    matches!((a.motion, b.motion), (Feed(x), Feed(y)) if (x - y).abs() <= 1e-3 * y.abs())
}

fn samples(curve: &Curve) -> Vec<(f64, glam::DVec3)> {
    let n = match curve.kind() {
        CurveKind::Involute { record, .. } => {
            SAMPLES.max((record.turn(record.length()).abs() / SAMPLE_TURN).ceil() as usize)
        }
        _ => SAMPLES,
    };
    (0..=n)
        .map(|i| {
            let s = curve.length() * i as f64 / n as f64;
            (s, curve.at(s).p)
        })
        .collect()
}

/// Distance of a point from a curve near arc length `guess`: Newton on the foot of the perpendicular.
fn distance_to(curve: &Curve, p: glam::DVec3, guess: f64) -> f64 {
    let mut s = guess.clamp(0.0, curve.length());
    let mut best = f64::INFINITY;
    for _ in 0..8 {
        let jet = curve.at(s);
        let off = p - jet.p;
        best = best.min(off.length());
        let slope = jet.d1.dot(jet.d1) - off.dot(jet.d2);
        let step = off.dot(jet.d1) / if slope.is_finite() && slope > 0.1 { slope } else { 1.0 };
        s = (s + step).clamp(0.0, curve.length());
        if step.abs() < 1e-12 * (1.0 + s) {
            break;
        }
    }
    best
}

/// The foot of the perpendicular on a spiral, followed from point to point in the spiral's own parameter: arc length
/// would cost a quadrature for each look.
struct SpiralFoot {
    spiral: Spiral,
    to_plane: Rigid,
    rise: Rise,
    parameter: f64,
}

impl SpiralFoot {
    fn of(curve: &Curve) -> Option<SpiralFoot> {
        let CurveKind::Spiral { spiral, frame, rise } = curve.kind() else { return None };
        let [from, _] = spiral.parameters();
        Some(SpiralFoot { spiral, to_plane: frame.inverse(), rise, parameter: from })
    }

    /// Distance of a point from the place of the spiral that is nearest in the plane [mm]: never less than from the
    /// spiral itself.
    fn distance(&mut self, p: glam::DVec3) -> f64 {
        /// Newton from the foot of a neighbouring point.
        const STEPS: u32 = 30;
        /// Newton stops when the parameter changes by less than this [rad].
        const DONE: f64 = 1e-13;
        let q = self.to_plane.point(p);
        let [from, to] = self.spiral.parameters();
        let (low, high) = if from < to { (from, to) } else { (to, from) };
        let off = |u: f64| {
            let [x, y] = self.spiral.series::<3>(u);
            let d = glam::DVec2::new(q.x - x.0[0], q.y - y.0[0]);
            let (t, k) = (glam::DVec2::new(x.0[1], y.0[1]), glam::DVec2::new(x.0[2], y.0[2]) * 2.0);
            (d, t, k)
        };
        let mut u = self.parameter;
        for _ in 0..STEPS {
            let (d, t, k) = off(u);
            let squared = t.length_squared();
            let slope = squared - d.dot(k);
            let step = d.dot(t) / if slope > 0.1 * squared { slope } else { squared };
            // A step beyond a tenth of a turn would lose the foot.
            let step = if step.is_finite() { step.clamp(-0.6, 0.6) } else { 1e-6 };
            let next = (u + step).clamp(low, high);
            let moved = (next - u).abs();
            u = next;
            if moved < DONE {
                break;
            }
        }
        self.parameter = u;
        let planar = off(u).0.length();
        let height = match self.rise.is_even() {
            Some(0.0) => 0.0,
            _ => self.rise.at(self.spiral.length_to(u) / self.spiral.length()),
        };
        planar.hypot(q.z - height)
    }
}
