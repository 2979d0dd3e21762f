//! Swept parts that may reach what is left of a line, side by side: those that stay away from it are told by tangents at three times.
//!
//! Source: the gauge of a convex part is convex in the frame of the tool. A place goes through that frame on a way that is straight but
//! for its bend, so that the gauge there lies above its tangents in time, less what the bend takes with the square of the time
//! ([`SpanPoses::nearer`]). The tangents are those in the middle of the time, at the end to which the part comes nearer, and where both
//! say that it is nearest.

use glam::DVec3;
use pulp::{Arch, NullaryFnOnce};

use super::bundle::Shape;
use super::lanes::{LANES, Lane, Seen, Vector, WAY, Ways, along, dot, put};
use super::near::SweptPart;

/// Parts side by side.
pub(super) struct AwayBounds {
    arch: Arch,
    ways: Ways,
}

impl Default for AwayBounds {
    fn default() -> AwayBounds {
        AwayBounds { arch: Arch::default(), ways: [[0.0; LANES]; WAY] }
    }
}

impl AwayBounds {
    /// By part, of no more than there are lanes: a bound on its gauge at all the material between two places, the first of which it is
    /// nearer to [mm]; without bound where its shape is not that of the first.
    pub(super) fn bounds<'p>(
        &mut self,
        parts: impl Iterator<Item = (&'p SweptPart<'p>, [DVec3; 2])>,
    ) -> [f64; LANES] {
        let (mut places, mut first) = ([[0.0; LANES]; 6], None);
        let mut alike = [false; LANES];
        for (lane, (one, [p, q])) in parts.take(LANES).enumerate() {
            alike[lane] = std::ptr::eq(*first.get_or_insert(one.part), one.part);
            put(&mut self.ways, lane, one);
            for (of, place) in places.iter_mut().zip(p.to_array().into_iter().chain(q.to_array())) {
                of[lane] = place;
            }
        }
        let mut bounds = [f64::NEG_INFINITY; LANES];
        if let Some(shape) = first.and_then(Shape::of) {
            self.arch.dispatch(Bounds { shape, ways: &self.ways, places: &places, bounds: &mut bounds });
        }
        for (bound, _) in bounds.iter_mut().zip(alike).filter(|(_, alike)| !alike) {
            *bound = f64::NEG_INFINITY;
        }
        bounds
    }
}

/// See [`AwayBounds::bounds`].
struct Bounds<'a> {
    shape: Shape,
    ways: &'a Ways,
    places: &'a [[f64; LANES]; 6],
    bounds: &'a mut [f64; LANES],
}

/// A bound on the gauge some time after the tangent's own, up to half of the time; negative for a time before it.
#[inline(always)]
fn least(seen: &Seen, way: f64) -> f64 {
    lesser(seen.value, seen.value + seen.rate * way - 4.0 * seen.half * way * way)
}

/// A bound on the gauge at a place beside, half of the time before and after.
#[inline(always)]
fn beside(seen: &Seen, off: Vector, length: f64) -> f64 {
    let rate = 0.5 * (seen.rate.abs() + length * seen.turns);
    seen.value + dot(seen.normal, off) - rate - seen.half - length * seen.by_way
}

#[inline(always)]
fn lesser(a: f64, b: f64) -> f64 {
    // Not a number is the lesser: it bounds nothing.
    if a > b { b } else { a }
}

impl NullaryFnOnce for Bounds<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Bounds { shape, ways, places, bounds } = self;
        // In a place of its own: nothing else is written to, so that all lanes are gone through at once.
        let mut found = [0.0; LANES];
        for (lane, bound) in found.iter_mut().enumerate() {
            let near = [places[0][lane], places[1][lane], places[2][lane]];
            let off = along([places[3][lane], places[4][lane], places[5][lane]], near, -1.0);
            let length = dot(off, off).sqrt();
            let lane = Lane { shape, ways, lane };
            let middle = lane.at(near, 0.0);
            // The end of the time to which the gauge falls.
            let time = if middle.rate > 0.0 { -0.5 } else { 0.5 };
            let last = lane.at(near, time);
            let (falls, rises) = (middle.rate.abs(), last.rate * (2.0 * time));
            // Where the rate comes to nothing between them, or that end.
            let share = if rises > 0.0 { falls / (falls + rises) } else { 1.0 };
            let nearest = lane.at(near, time * share);
            let (before, after) = (-0.5 * time * share, 0.5 * time * (1.0 - share));
            let first = lesser(least(&middle, -time), least(&middle, -before));
            let second = lesser(least(&nearest, before), least(&nearest, after));
            let here = lesser(lesser(first, second), least(&last, -after));
            let there = lesser(beside(&middle, off, length), beside(&nearest, off, length));
            *bound = lesser(here, lesser(there, beside(&last, off, length)));
        }
        *bounds = found;
    }
}
