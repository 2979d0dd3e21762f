//! The transient of an edge at a plane or a cylinder over the edge's annulus less an offset hole, and the share of that
//! domain which the surface covers.
//!
//! An extremum lies inside the domain, where it is one of the candidates of the whole annulus (taken as places now, not
//! as circles, and kept if they lie outside the hole), or on the rim of the hole ([`super::rim`]).

use std::f64::consts::PI;

use glam::DVec2;

use super::region::{Disc, Strip, common_area};
use super::rim::{covers, peak};
use super::transient::Search;
use super::{BoundarySurface, Cover, Transient, transient};
use crate::base::Result;
use crate::geom::{EdgeProfile, EdgeSegment};

/// A surface with the direction of its coordinate u: an angle from the x axis across the tool [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Laid {
    pub(crate) surface: BoundarySurface,
    pub(crate) turn: f64,
}

impl Laid {
    /// Height over a point [mm].
    pub(crate) fn height(&self, p: DVec2) -> f64 {
        self.surface.height(p.dot(DVec2::from_angle(self.turn)))
    }

    /// Whether it lies over a point.
    pub(crate) fn covers(&self, p: DVec2) -> bool {
        covers(&self.surface, self.turn, p)
    }

    /// The strip that it covers.
    fn strip(&self) -> Option<Strip> {
        match self.surface {
            BoundarySurface::Plane { .. } => None,
            BoundarySurface::Ridge { radius, offset, .. }
            | BoundarySurface::Valley { radius, offset, .. } => Some(Strip {
                along: DVec2::from_angle(self.turn),
                range: [-radius - offset, radius - offset],
            }),
        }
    }
}

/// The transient over the domain of the edge less a hole; `None` when the surface lies over no point of it.
///
/// # Errors
/// `KC0902` as [`transient`].
pub(crate) fn transient_outside(
    edge: &EdgeProfile,
    laid: &Laid,
    cover: Cover,
    hole: Option<&Disc>,
) -> Result<Option<Transient>> {
    let whole = transient(edge, &laid.surface, cover)?;
    let Some(hole) = hole else { return Ok(Some(whole)) };
    let mut search = Search::new();
    let along = DVec2::from_angle(laid.turn);
    for segment in edge.segments() {
        let [a, b] = segment.range();
        let mut at = |r: f64| {
            if !(r >= a && r <= b) {
                return;
            }
            let z = segment.height(r);
            let mut place = |u: f64| {
                if u.abs() <= r {
                    let level = ((r - u) * (r + u)).sqrt();
                    for p in [along * u + along.perp() * level, along * u - along.perp() * level] {
                        if !hole.contains(p) && laid.covers(p) {
                            let s = laid.surface.height(u);
                            search.note(s - z, s - z, r);
                        }
                    }
                }
            };
            place(r);
            place(-r);
            if let BoundarySurface::Ridge { radius, offset, .. }
            | BoundarySurface::Valley { radius, offset, .. } = laid.surface
            {
                for w in [0.0, radius, -radius] {
                    place(w - offset);
                }
            }
        };
        at(a);
        at(b);
        match (laid.surface, *segment) {
            (BoundarySurface::Plane { slope, .. }, EdgeSegment::Arc { centre: [rc, _], radius: rho, .. }) => {
                let s = rho * slope / slope.hypot(1.0);
                [rc, rc + s, rc - s].into_iter().for_each(at);
            }
            (BoundarySurface::Plane { .. }, EdgeSegment::Line { .. }) => {}
            (
                BoundarySurface::Ridge { radius, offset, .. }
                | BoundarySurface::Valley { radius, offset, .. },
                _,
            ) => {
                let x = offset.abs();
                [x, x - radius, radius - x, x + radius].into_iter().for_each(&mut at);
                match *segment {
                    EdgeSegment::Line { .. } => {
                        let k = segment.slope(a);
                        let q = radius * k / k.hypot(1.0);
                        [x - q, x + q, q - x, -q - x].into_iter().for_each(at);
                    }
                    EdgeSegment::Arc { centre: [rc, _], radius: rho, .. } => {
                        let (sum, less) = (radius + rho, radius - rho);
                        let far = (x * rho + rc * radius) / less;
                        let near = (rc * radius - x * rho) / less;
                        // Also no number, where both radii are equal, is no place.
                        [rc, (x * rho + rc * radius) / sum, (rc * radius - x * rho) / sum, far, near]
                            .into_iter()
                            .for_each(at);
                    }
                }
            }
        }
    }
    if let Some(high) = peak(edge, &laid.surface, laid.turn, *hole, 1.0) {
        search.note(high.value, f64::INFINITY, high.radius);
    }
    if let Some(low) = peak(edge, &laid.surface, laid.turn, *hole, -1.0) {
        search.note(f64::NEG_INFINITY, -low.value, low.radius);
    }
    // The rim's bound must not reach beyond the exact extremes of the whole annulus.
    let mut found = search.found;
    found.first = if found.first > whole.first { whole.first } else { found.first };
    found.last = if found.last < whole.last { whole.last } else { found.last };
    Ok((found.first.is_finite() && found.last.is_finite()).then_some(found))
}

/// Area of the annulus of an edge less a hole, of the part that a surface covers if one is given [mm^2].
pub(crate) fn area(edge: &EdgeProfile, laid: Option<&Laid>, hole: Option<&Disc>) -> f64 {
    let (inner, outer) = (edge.inner_radius(), edge.outer_radius());
    let strip = laid.and_then(Laid::strip);
    let mut sum = 0.0;
    for (radius, sign) in [(outer, 1.0), (inner, -1.0)] {
        if radius > 0.0 {
            let disc = Disc::centred(radius);
            let without = match (strip, hole) {
                (None, None) => PI * radius * radius,
                (strip, None) => common_area(&[disc], strip.as_ref()),
                (strip, Some(hole)) => {
                    common_area(&[disc], strip.as_ref()) - common_area(&[disc, *hole], strip.as_ref())
                }
            };
            sum += sign * without;
        }
    }
    sum
}
