//! Moves as elements: their shapes, and their limits from those of the axes.
//!
//! Source: LinuxCNC 2.10, `src/emc/task/emccanon.cc`, at `getStraightVelocity`, `getStraightAcceleration` and `ARC_FEED`.

use glam::DVec3;

use super::super::super::AxisLimit;
use super::super::joint::AXES;
use super::super::run::Piece;
use super::super::straight::straight;
use super::element::{Element, Passage};
use super::shape::{Arc, Shape};
use super::{NORMAL_SHARE, TANGENTIAL_SHARE};
use crate::trace::{AxisJet, AxisPath};

type Limits = [Option<AxisLimit>; AXES];

/// Way of an axis below which it counts as none [mm, rad].
const NO_WAY: f64 = 1e-6;
/// Distance of a chord from a curve that is neither a line nor an arc [mm].
const CHORD: f64 = 0.002;
/// Most chords of one move.
const MOST_CHORDS: f64 = 100_000.0;

/// How a move goes into the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) enum Ending {
    /// It stops (`G61.1`).
    Stop,
    /// It goes on where the directions are nearly the same, and stops elsewhere: canned cycles run so.
    Exact,
    /// It leaves the corner by this distance at most (`G64 P`) [mm]; zero: a quarter of the move.
    Within(f64),
}

/// Whether a move is straight, turns an axis, and goes on straight in the next one.
pub(super) fn goes_on(piece: &Piece, next: &Piece) -> bool {
    /// Difference of two unit vectors that are one.
    const SAME: f64 = 1e-9;
    let direction = |piece: &Piece| {
        let rates = straight(&piece.path)?;
        let size = rates.iter().map(|rate| rate * rate).sum::<f64>().sqrt();
        Some(rates.map(|rate| rate / size))
    };
    let (Some(this), Some(other)) = (direction(piece), direction(next)) else { return false };
    this[3..].iter().any(|rate| *rate != 0.0) && this.iter().zip(other).all(|(a, b)| (a - b).abs() < SAME)
}

/// The elements of a move, handed to `sink`; `way`: the move with those that go on straight. `None` if an axis that moves has
/// no limits.
pub(super) fn elements<'a>(
    index: usize,
    piece: &Piece<'a>,
    way: &[Piece],
    ending: Ending,
    limits: &Limits,
    sink: &mut impl FnMut(Element<'a>),
) -> Option<()> {
    let whole = piece.path.length();
    let mut one = |shape: Shape<'a>, length: f64, time: f64, end: Passage| {
        let [fastest, acceleration] = bounds(&shape, length, limits)?;
        let [from, to] = [0.0, length].map(|s| shape.at(s));
        let mut element = Element {
            shape,
            piece: index,
            is_rapid: piece.feed.is_infinite(),
            turns: (3..AXES).any(|a| from[a].q != to[a].q),
            length,
            nominal: length,
            feed: (length / time).min(fastest),
            fastest,
            acceleration,
            share: TANGENTIAL_SHARE,
            kink: None,
            taken: [0.0; 2],
            overlaps_before: false,
            end,
            tolerance: if let Ending::Within(tolerance) = ending { tolerance } else { 0.0 },
            last_speed: 0.0,
            is_fixed: false,
        };
        element.hold_for_a_cycle();
        element.bend();
        sink(element);
        Some(())
    };
    let end = match ending {
        Ending::Stop => Passage::Stop,
        Ending::Exact => Passage::Exact,
        Ending::Within(_) => Passage::Overlap,
    };
    if straight(&piece.path).is_some() {
        let last = way.last().unwrap_or(piece);
        let ends = [piece.path.at(0.0), last.path.at(last.path.length())];
        let time = way.iter().map(|piece| piece.path.length() / piece.feed).sum();
        return line(&ends).map_or(Some(()), |(shape, length)| one(shape, length, time, end));
    }
    let time = whole / piece.feed;
    if let Some(arc) = arc(&piece.path) {
        let length = arc.length();
        return one(Shape::Arc(arc), length, time, end);
    }
    let middle = piece.path.at(0.5 * whole);
    if middle[3..].iter().any(|jet| jet.d1 != 0.0) {
        return one(Shape::Turning(piece.path.clone()), whole, time, end);
    }
    let bend = middle.iter().map(|jet| jet.d2 * jet.d2).sum::<f64>().sqrt();
    // A chord of length c is c^2 k / 8 from an arc of curvature k.
    let chords = (whole * (bend / (8.0 * CHORD)).sqrt()).ceil().clamp(1.0, MOST_CHORDS);
    let step = whole / chords;
    let mut from = piece.path.at(0.0);
    for k in 1..=chords as usize {
        let to = piece.path.at((step * k as f64).min(whole));
        let end = if k as f64 == chords { end } else { Passage::Overlap };
        if let Some((shape, length)) = line(&[from, to]) {
            one(shape, length, time / chords, end)?;
        }
        from = to;
    }
    Some(())
}

/// The straight way between two positions, and its length: of X Y Z, or of the rotary axes where those stand.
fn line(ends: &[[AxisJet; AXES]; 2]) -> Option<(Shape<'static>, f64)> {
    let from = ends[0].map(|jet| jet.q);
    let ways: [f64; AXES] = std::array::from_fn(|a| ends[1][a].q - from[a]);
    let [linear, rotary] = [&ways[..3], &ways[3..]].map(|w| w.iter().map(|v| v * v).sum::<f64>().sqrt());
    let length = if linear > NO_WAY { linear } else { rotary };
    (length > NO_WAY).then(|| (Shape::Line { from, rates: ways.map(|way| way / length) }, length))
}

/// The circular arc or helix that a path is.
fn arc(path: &AxisPath) -> Option<Arc> {
    /// Distance of the path from the arc that it is taken for [mm].
    const SAME: f64 = 1e-6;
    let length = path.length();
    let jets = path.at(0.0);
    let vector = |of: fn(&AxisJet) -> f64| DVec3::new(of(&jets[0]), of(&jets[1]), of(&jets[2]));
    let [q, d2, d3] = [vector(|jet| jet.q), vector(|jet| jet.d2), vector(|jet| jet.d3)];
    // About the axis the second derivative turns at an even rate.
    let rate = d3.length() / d2.length();
    if !(rate.is_finite() && rate > 0.0) {
        return None;
    }
    let normal = d2.cross(d3).normalize_or_zero();
    let end = path.at(length);
    let d1 = vector(|jet| jet.d1);
    let rotary = [[3, 4, 5].map(|a| jets[a].q), [3, 4, 5].map(|a| (end[a].q - jets[a].q) / length)];
    let centre = q + d2 / (rate * rate);
    let arc = Arc {
        centre,
        start: q - centre,
        normal,
        angle: rate * length,
        rise: d1.dot(normal) * length,
        rotary,
    };
    let shape = Shape::Arc(arc.clone());
    let is_it = [0.25, 0.5, 0.75, 1.0].into_iter().all(|part| {
        let (there, here) = (path.at(part * length), shape.at(part * arc.length()));
        (0..AXES).all(|a| (there[a].q - here[a].q).abs() < SAME)
    });
    is_it.then_some(arc)
}

/// Largest speed and acceleration of a shape [mm/s, mm/s^2]; `None` if an axis that moves has no limits.
fn bounds(shape: &Shape<'_>, length: f64, limits: &Limits) -> Option<[f64; 2]> {
    let (from, to) = (shape.at(0.0), shape.at(length));
    // Times at the limits of the axes, from end to end.
    let mut times = [0.0_f64; 2];
    for a in 0..AXES {
        let way = (to[a].q - from[a].q).abs();
        if way > NO_WAY {
            let limit = limits[a]?;
            times = [times[0].max(way / limit.velocity), times[1].max(way / limit.acceleration)];
        }
    }
    if let Shape::Turning(path) = shape {
        // From place to place: from end to end axes may come back, and beside an end they may turn on the spot.
        const PLACES: u32 = 8;
        let at = |k: u32| path.at(path.length() * f64::from(k) / f64::from(PLACES)).map(|jet| jet.q);
        for k in 0..PLACES {
            for ((from, to), limit) in at(k).into_iter().zip(at(k + 1)).zip(limits) {
                let way = (to - from).abs() * f64::from(PLACES);
                if way > NO_WAY {
                    let limit = (*limit)?;
                    times = [times[0].max(way / limit.velocity), times[1].max(way / limit.acceleration)];
                }
            }
        }
    }
    if let Shape::Arc(arc) = shape {
        let mut plane = [f64::INFINITY; 2];
        for a in 0..3 {
            if 1.0 - arc.normal[a].powi(2) > NO_WAY {
                let limit = limits[a]?;
                plane = [plane[0].min(limit.velocity), plane[1].min(limit.acceleration)];
            }
        }
        let [velocity, acceleration] = plane;
        let way = arc.radius() * arc.angle;
        let across = (NORMAL_SHARE * acceleration * arc.radius()).sqrt();
        times = [times[0].max(way / velocity.min(across)), times[1].max(way / acceleration)];
    }
    Some(times.map(|time| length / time))
}
