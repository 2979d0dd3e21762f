//! Facets: chains of short straight moves in place of a curve, at whose joints a control brakes.

use super::super::AxisLimit;
use super::joint::AXES;
use super::program_time::ProgramTime;
use super::run::derivatives;
use super::setting::control_limits;
use super::stretch::feed;
use crate::geom::CurveKind;
use crate::machine::Machine;
use crate::trace::{Segment, SegmentPace, Trace};

/// Straight moves that together stand for curves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facets {
    /// Their number.
    pub moves: usize,
    /// Their time under the law [s].
    pub time: f64,
    /// Time of even runs along smooth curves through the same points, at most the programmed feeds [s]; ramps are not
    /// counted.
    pub smooth: f64,
    /// Largest distance between such a move and its curve [mm].
    pub farthest: f64,
    /// The move of a chain that loses most: its segment.
    pub slowest: usize,
}

/// A move of a chain.
struct Facet {
    segment: usize,
    length: f64,
    feed: f64,
    direction: [f64; AXES],
}

/// Largest step of direction between two facets of one curve: 20 degrees.
const SHARP: f64 = 0.35;
/// Largest ratio of the lengths of neighbouring facets.
const UNLIKE: f64 = 4.0;
/// Least number of facets of a curve.
const LEAST: usize = 5;

/// The facets of a program and the time that they cost: chains of five and more straight moves at feed, each within 20 degrees
/// and four lengths of the next one. Their curve has the derivatives that the differences of their directions say.
pub fn facets(trace: &Trace, time: &ProgramTime, machine: &Machine) -> Option<Facets> {
    let limits = control_limits(machine);
    let mut all: Option<Facets> = None;
    let mut most = 0.0;
    let mut chain: Vec<Facet> = Vec::new();
    let mut close = |chain: &mut Vec<Facet>| {
        if chain.len() >= LEAST {
            let own = of_chain(chain, &time.segments, &limits);
            let lost = own.time - own.smooth;
            let sum = all.get_or_insert(Facets { moves: 0, time: 0.0, smooth: 0.0, farthest: 0.0, ..own });
            sum.moves += own.moves;
            sum.time += own.time;
            sum.smooth += own.smooth;
            sum.farthest = sum.farthest.max(own.farthest);
            if lost > most {
                (most, sum.slowest) = (lost, own.slowest);
            }
        }
        chain.clear();
    };
    for (i, segment) in trace.segments.iter().enumerate() {
        if segment.alternative {
            continue;
        }
        let Some(next) = facet(i, segment) else {
            close(&mut chain);
            continue;
        };
        if chain.last().is_some_and(|last| !goes_on(trace, last, &next)) {
            close(&mut chain);
        }
        chain.push(next);
    }
    close(&mut chain);
    all
}

fn facet(index: usize, segment: &Segment) -> Option<Facet> {
    let straight = matches!(segment.curve.kind(), CurveKind::Line(_));
    if !straight || !matches!(segment.motion, SegmentPace::Feed(_)) {
        return None;
    }
    let path = segment.axis_path()?;
    let length = path.length();
    let direction = derivatives(&path, 0.5 * length).map(|d| d[0]);
    let feed = feed(segment, length);
    let is_known = length > 0.0 && feed.is_finite() && direction.iter().all(|d| d.is_finite());
    is_known.then_some(Facet { segment: index, length, feed, direction })
}

fn goes_on(trace: &Trace, last: &Facet, next: &Facet) -> bool {
    /// Distance of two ends that are one place [mm].
    const SAME: f64 = 1e-6;
    let [a, b] = [last, next].map(|facet| &trace.segments[facet.segment]);
    let step = (0..3).map(|i| (next.direction[i] - last.direction[i]).powi(2)).sum::<f64>().sqrt();
    let ratio = last.length / next.length;
    (a.curve.end() - b.curve.start()).length() <= SAME
        && step < SHARP
        && (1.0 / UNLIKE..=UNLIKE).contains(&ratio)
}

/// The facets of one chain.
fn of_chain(chain: &[Facet], times: &[f64], limits: &[Option<AxisLimit>; AXES]) -> Facets {
    // Second derivatives of the axes at the joints.
    let bends: Vec<[f64; AXES]> = chain
        .windows(2)
        .map(|w| {
            let way = 0.5 * (w[0].length + w[1].length);
            std::array::from_fn(|a| (w[1].direction[a] - w[0].direction[a]) / way)
        })
        .collect();
    let mut sum =
        Facets { moves: chain.len(), time: 0.0, smooth: 0.0, farthest: 0.0, slowest: chain[0].segment };
    let mut most = 0.0;
    for (k, facet) in chain.iter().enumerate() {
        let before = &bends[k.saturating_sub(1)];
        let after = &bends[k.min(bends.len() - 1)];
        let mut rate = facet.feed;
        for (a, limit) in limits.iter().enumerate() {
            let Some(limit) = limit else { continue };
            let bend = before[a].abs().max(after[a].abs());
            let third = (after[a] - before[a]).abs() / facet.length;
            rate = rate
                .min(limit.velocity / facet.direction[a].abs())
                .min((limit.acceleration / bend).sqrt())
                .min((limit.jerk / third).cbrt());
        }
        let bend = before[..3].iter().map(|d| d * d).sum::<f64>().sqrt();
        sum.farthest = sum.farthest.max(bend * facet.length * facet.length / 8.0);
        let (own, smooth) = (times[facet.segment], facet.length / rate);
        sum.time += own;
        sum.smooth += smooth;
        if own - smooth > most {
            (most, sum.slowest) = (own - smooth, facet.segment);
        }
    }
    sum
}
