//! The decision at each joint: a stop, or a smoothing that is passed on the way.

use super::super::AxisLimit;
use super::joint::{AXES, Joint, Step, Tolerance};
use super::run::Piece;
use super::straight::along;

type Limits = [Option<AxisLimit>; AXES];

/// Joint of two moves.
pub(super) struct Between {
    pub(super) step: Step,
    /// True for an exact stop.
    pub(super) stops: bool,
    pub(super) tolerance: Tolerance,
    /// True if an axis turns on the spot there.
    pub(super) on_the_spot: bool,
}

/// End of a move.
pub(super) enum Passing {
    /// Passed on the way, smoothed where something steps, with the distance by which the path may be left [mm].
    Passed(Option<Joint>, f64),
    Stop,
}

/// For each joint: a stop, or the way in which it is passed.
pub(super) fn passings(pieces: &[Piece], joints: &[Between], limits: &Limits) -> Vec<Passing> {
    // Way from each joint to the next one at which the tool may have to be slow, backward and forward.
    let length = |i: usize| pieces[i].path.length();
    let mut back = vec![0.0; joints.len()];
    let mut way = 0.0;
    for (i, joint) in joints.iter().enumerate() {
        way += length(i);
        back[i] = way;
        if joint.step.is_sharp() {
            way = 0.0;
        }
    }
    let mut ends = Vec::with_capacity(joints.len());
    let mut way = 0.0;
    for (i, joint) in joints.iter().enumerate().rev() {
        way += length(i + 1);
        ends.push(passing([&pieces[i], &pieces[i + 1]], joint, [back[i], way], limits));
        if joint.step.is_sharp() {
            way = 0.0;
        }
    }
    ends.reverse();
    ends
}

fn passing(pieces: [&Piece; 2], joint: &Between, ways: [f64; 2], limits: &Limits) -> Passing {
    /// Share of the limits that a joint may use up at the feed: the path beside it needs some, too.
    const SHARE: f64 = 0.2;
    let Between { step, stops, tolerance, on_the_spot } = joint;
    if *stops || *on_the_spot {
        return Passing::Stop;
    }
    if step.is_none() {
        return Passing::Passed(None, tolerance.way);
    }
    let along = pieces.map(|piece| at_feed(piece, limits));
    let feed = along[0].velocity.max(along[1].velocity);
    let half = step.longest(*tolerance).min(step.needed(feed, SHARE, limits));
    if !(half > 0.0) {
        return Passing::Stop;
    }
    let passed = Passing::Passed(Some(Joint { at: 0.0, half, step: *step }), tolerance.way);
    let crossing = step.crossing(half, limits);
    let loss = |speed: f64, half: f64| -> f64 {
        along.iter().zip(ways).map(|(along, way)| lost(along, 0.5 * way, speed, half)).sum()
    };
    if loss(crossing, half) < loss(0.0, 0.0) { passed } else { Passing::Stop }
}

/// Limits of the parameter in the middle of a move.
fn at_feed(piece: &Piece, limits: &Limits) -> AxisLimit {
    let rates = piece.derivatives(0.5 * piece.path.length()).map(|d| d[0]);
    along(&rates, limits, piece.feed)
}

/// Time that a path loses when a place of it is passed at `speed` [mm/s] over `half` [mm], against passing it at its feed;
/// `way`: what is there to get from one to the other [mm].
fn lost(along: &AxisLimit, way: f64, speed: f64, half: f64) -> f64 {
    let (a, j) = (along.acceleration, along.jerk);
    let reached = along.velocity.min((way * way * j).cbrt()).min((2.0 * a * way).sqrt());
    let slower = (reached - speed).max(0.0);
    let ramp = if slower * j < a * a { 2.0 * (slower / j).sqrt() } else { slower / a + a / j };
    let crossing = if half > 0.0 && slower > 0.0 { half * (1.0 / speed - 1.0 / reached) } else { 0.0 };
    ramp * slower / (2.0 * reached) + crossing
}
