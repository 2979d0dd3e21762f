//! Feeds that an axis cannot hold: the even run along a move against the limits of the axes.

use rayon::prelude::*;

use super::super::AxisLimit;
use super::super::station::places;
use super::joint::AXES;
use super::run::derivatives;
use super::setting::control_limits;
use super::stretch::feed;
use crate::geom::CurveKind;
use crate::machine::Machine;
use crate::trace::{AxisPath, Segment, SegmentPace, Trace};

/// Limit of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisBound {
    /// Its speed.
    Velocity,
    /// Its acceleration.
    Acceleration,
    /// Its jerk.
    Jerk,
}

/// A move whose feed an axis cannot hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedBeyond {
    /// Index of the segment in the trace.
    pub segment: usize,
    /// Largest share of the programmed feed at which the whole move can be run evenly, below 1.
    pub share: f64,
    /// Letter of the axis that allows no more.
    pub axis: char,
    /// Its limit that is reached.
    pub bound: AxisBound,
}

/// Axes in the order of their positions.
const LETTERS: [char; AXES] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
/// Shares that are 1 but for rounding.
const ROUNDING: f64 = 1e-6;

/// The moves at feed that the axes cannot run evenly at their feed, in the order of the trace; each once for each kind of limit
/// that is in the way. With the speed `f` along the move an axis `q` needs `q' f`, `q'' f^2`, `q''' f^3`. Looked at where a
/// curve turns by 0.1 rad, of moves on which the tool turns at the ends and in the middle. Joints of moves are not looked at,
/// nor axes whose limits are not known.
pub fn feeds_beyond(trace: &Trace, machine: &Machine) -> Vec<FeedBeyond> {
    let limits = control_limits(machine);
    let beyond = |(i, segment): (usize, &Segment)| -> Option<[Option<FeedBeyond>; 3]> {
        if segment.alternative || !matches!(segment.motion, SegmentPace::Feed(_)) {
            return None;
        }
        let path = segment.axis_path()?;
        let feed = feed(segment, path.length());
        let held = held(&path, &places_of(segment, &path), &limits);
        let found = held.map(|(bound, rate, axis)| {
            let share = rate / feed;
            let is_beyond = feed.is_finite() && share < 1.0 - ROUNDING;
            is_beyond.then_some(FeedBeyond { segment: i, share, axis: LETTERS[axis], bound })
        });
        Some(found)
    };
    trace.segments.par_iter().enumerate().filter_map(beyond).flatten_iter().flatten_iter().collect()
}

/// For each kind of limit the largest rate of the parameter of a move [mm/s] at which it can be run evenly, and the axis that
/// allows no more.
fn held(path: &AxisPath, places: &[f64], limits: &[Option<AxisLimit>; AXES]) -> [(AxisBound, f64, usize); 3] {
    let kinds = [AxisBound::Velocity, AxisBound::Acceleration, AxisBound::Jerk];
    let mut least = kinds.map(|bound| (bound, f64::INFINITY, 0));
    for s in places {
        for (axis, (jet, limit)) in derivatives(path, *s).iter().zip(limits).enumerate() {
            let Some(limit) = limit else { continue };
            let rates = [
                limit.velocity / jet[0].abs(),
                (limit.acceleration / jet[1].abs()).sqrt(),
                (limit.jerk / jet[2].abs()).cbrt(),
            ];
            for ((_, most, by), rate) in least.iter_mut().zip(rates) {
                // A cusp allows no even rate at all, and is passed from or to a stop.
                if rate > 0.0 && rate < *most {
                    (*most, *by) = (rate, axis);
                }
            }
        }
    }
    least
}

/// Places at which a move is looked at [mm].
fn places_of(segment: &Segment, path: &AxisPath) -> Vec<f64> {
    /// Turn of a curve between places [rad].
    const TURN: f64 = 0.1;
    let length = path.length();
    if segment.turning.is_some() {
        return vec![0.0, 0.5 * length, length];
    }
    match segment.curve.kind() {
        CurveKind::Line(_) => vec![0.5 * length],
        _ => places(&segment.curve, TURN),
    }
}
