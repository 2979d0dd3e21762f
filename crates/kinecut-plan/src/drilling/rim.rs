//! The extremes of height of a surface less height of the edge along the rim of an offset hole: a guaranteed search.
//!
//! The rim is split where the edge or the surface changes its form or its sense, so that on each piece both heights run
//! one way. If they run against each other the ends are the extremes. Otherwise greatest surface less least edge bounds
//! the piece from above, and it is halved unless the bounds of the derivative say that it is monotone, or the bound is
//! no farther than [`BOUND`] from a value found. What is given up for that counts with its bound: the result never lies
//! within the true extremes.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use super::region::Disc;
use crate::drilling::BoundarySurface;
use crate::geom::{EdgeProfile, EdgeSegment};

/// Largest distance of the result outside the true extreme [mm]: a thousandth of what any machine posts.
pub(super) const BOUND: f64 = 1e-9;
/// Pieces narrower than this cannot be halved usefully [rad].
const NARROWEST: f64 = 1e-14;

/// A place on the rim: the value wanted and the radius of the edge there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Peak {
    pub(super) value: f64,
    pub(super) radius: f64,
}

/// The rim of a hole under a surface and an edge. `sign` 1 looks for the greatest S - z, -1 for the least, with its sign
/// turned.
struct Rim<'a> {
    surface: &'a BoundarySurface,
    turn: f64,
    segment: &'a EdgeSegment,
    hole: Disc,
    sign: f64,
}

/// The greatest `sign (S - z)` on the part of the rim that lies over the edge and under the surface, whose coordinate u
/// runs at the angle `turn`. `None` without that part.
pub(super) fn peak(
    edge: &EdgeProfile,
    surface: &BoundarySurface,
    turn: f64,
    hole: Disc,
    sign: f64,
) -> Option<Peak> {
    let breaks = breaks(edge, surface, turn, hole);
    let mut best: Option<Peak> = None;
    let mut given_up = f64::NEG_INFINITY;
    for pair in breaks.windows(2) {
        let middle = hole.rim(0.5 * (pair[0] + pair[1]));
        let over = middle.length();
        let here = |s: &&EdgeSegment| over >= s.range()[0] && over <= s.range()[1];
        if !covers(surface, turn, middle) {
            continue;
        }
        for segment in edge.segments().iter().filter(here) {
            let rim = Rim { surface, turn, segment, hole, sign };
            for end in pair {
                rim.note(*end, &mut best);
            }
            let mut open = vec![(pair[0], pair[1])];
            while let Some((a, b)) = open.pop() {
                let found = best.map_or(f64::NEG_INFINITY, |p| p.value);
                let bound = rim.bound(a, b);
                if bound <= found + BOUND || b - a < NARROWEST {
                    given_up = if bound > given_up { bound } else { given_up };
                } else if !rim.monotone(a, b) {
                    let m = 0.5 * (a + b);
                    rim.note(m, &mut best);
                    open.extend([(a, m), (m, b)]);
                }
            }
        }
    }
    best.map(|p| Peak { value: if given_up > p.value { given_up } else { p.value }, ..p })
}

/// Whether a cylinder lies over a point; a plane lies over all.
pub(super) fn covers(surface: &BoundarySurface, turn: f64, p: DVec2) -> bool {
    match *surface {
        BoundarySurface::Plane { .. } => true,
        BoundarySurface::Ridge { radius, offset, .. } | BoundarySurface::Valley { radius, offset, .. } => {
            (offset + p.dot(DVec2::from_angle(turn))).abs() <= radius
        }
    }
}

/// Angles between which heights of edge and surface run one way, ascending over a full turn.
fn breaks(edge: &EdgeProfile, surface: &BoundarySurface, turn: f64, hole: Disc) -> Vec<f64> {
    let towards = hole.centre.to_angle();
    let mut all = Vec::with_capacity(32);
    for k in 0..4 {
        all.extend([turn + FRAC_PI_2 * f64::from(k), towards + FRAC_PI_2 * f64::from(k)]);
    }
    for s in edge.segments() {
        let [a, b] = s.range();
        let bottom = if let EdgeSegment::Arc { centre, .. } = s { centre[0] } else { a };
        for r in [a, b, bottom] {
            all.extend(hole.crossings(DVec2::ZERO, r).into_iter().flatten());
        }
    }
    if let BoundarySurface::Ridge { radius, offset, .. } | BoundarySurface::Valley { radius, offset, .. } =
        *surface
    {
        for w in [-radius, 0.0, radius] {
            let cosine = (w - offset - hole.centre.dot(DVec2::from_angle(turn))) / hole.radius;
            if cosine.abs() <= 1.0 {
                all.extend([turn - cosine.acos(), turn + cosine.acos()]);
            }
        }
    }
    all.iter_mut().for_each(|a| *a = a.rem_euclid(TAU));
    all.sort_by(f64::total_cmp);
    all.push(all[0] + TAU);
    all
}

impl Rim<'_> {
    /// Distance from the axis, kept within the segment's ring against rounding.
    fn radius(&self, angle: f64) -> f64 {
        let [a, b] = self.segment.range();
        self.hole.rim(angle).length().clamp(a, b)
    }

    /// The coordinate u of the surface.
    fn along(&self, angle: f64) -> f64 {
        self.hole.rim(angle).dot(DVec2::from_angle(self.turn))
    }

    /// `sign S` and `sign z`.
    fn heights(&self, angle: f64) -> [f64; 2] {
        let z = self.segment.height(self.radius(angle));
        [self.sign * self.surface.height(self.along(angle)), self.sign * z]
    }

    fn note(&self, angle: f64, best: &mut Option<Peak>) {
        let [s, z] = self.heights(angle);
        if best.is_none_or(|p| s - z > p.value) {
            *best = Some(Peak { value: s - z, radius: self.radius(angle) });
        }
    }

    /// Greatest surface less least edge; both lie at the ends.
    fn bound(&self, a: f64, b: f64) -> f64 {
        let ([s, z], [t, y]) = (self.heights(a), self.heights(b));
        (if s > t { s } else { t }) - if z < y { z } else { y }
    }

    /// Whether the derivative has one sign all along a piece.
    fn monotone(&self, a: f64, b: f64) -> bool {
        let ends = |f: &dyn Fn(f64) -> f64| hull(f(a), f(b));
        // Each factor runs one way on a piece, so that its ends bound it.
        let slope = ends(&|t| surface_slope(self.surface, self.along(t)));
        let across = ends(&|t| -self.hole.radius * (t - self.turn).sin());
        let rise = ends(&|t| {
            let slope = self.segment.slope(self.radius(t));
            if slope.is_nan() { f64::INFINITY } else { slope }
        });
        let towards = self.hole.centre.to_angle();
        let d = self.hole.centre.length();
        let numerator = ends(&|t| -self.hole.radius * d * (t - towards).sin());
        let inverse = ends(&|t| 1.0 / self.radius(t));
        let outwards = product(numerator, inverse);
        let (s, z) = (product(slope, across), product(rise, outwards));
        // With an infinite slope against zero neither comparison holds.
        s[0] - z[1] >= 0.0 || s[1] - z[0] <= 0.0
    }
}

/// Slope of a surface; infinite where it is upright.
fn surface_slope(surface: &BoundarySurface, u: f64) -> f64 {
    let half = |radius: f64, w: f64| w / ((radius - w) * (radius + w)).clamp(0.0, f64::INFINITY).sqrt();
    match *surface {
        BoundarySurface::Plane { slope, .. } => slope,
        BoundarySurface::Ridge { radius, offset, .. } => -half(radius, offset + u),
        BoundarySurface::Valley { radius, offset, .. } => half(radius, offset + u),
    }
}

fn hull(a: f64, b: f64) -> [f64; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// Bounds of a product; no number where zero meets infinity.
fn product(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let all = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    if all.iter().any(|v| v.is_nan()) {
        return [f64::NAN; 2];
    }
    all.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| {
        [if v < low { v } else { low }, if v > high { v } else { high }]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_centred_rim_under_a_slope_has_its_peak_uphill() {
        let edge = EdgeProfile::polyline(&[[0.0, 0.0], [5.0, 3.0]]).unwrap();
        let plane = BoundarySurface::Plane { height: 2.0, slope: 0.5 };
        let hole = Disc { centre: DVec2::new(1.0, 0.0), radius: 2.0 };
        // Along x: uphill the rim lies at x = 3, downhill at x = -1.
        let high = peak(&edge, &plane, 0.0, hole, 1.0).unwrap();
        let dense = |sign: f64| {
            (0..100_000)
                .map(|i| {
                    let p = hole.rim(f64::from(i) * TAU / 100_000.0);
                    sign * (2.0 + 0.5 * p.x - 0.6 * p.length())
                })
                .fold(f64::NEG_INFINITY, f64::max)
        };
        assert!(high.value >= dense(1.0) && high.value < dense(1.0) + 1e-7, "{high:?} {}", dense(1.0));
        let low = peak(&edge, &plane, 0.0, hole, -1.0).unwrap();
        assert!(low.value >= dense(-1.0) && low.value < dense(-1.0) + 1e-7);
        // A rim beyond the edge is not there.
        let beyond = Disc { centre: DVec2::ZERO, radius: 6.0 };
        assert!(peak(&edge, &plane, 0.0, beyond, 1.0).is_none());
    }
}
