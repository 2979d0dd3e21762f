//! Concentric rings, each run in full, joined by radial lines (a stop at each corner) or by tangent S links.
//!
//! An S link leaves the ring of radius `a` on an arc that turns outwards by `A` with the radius `g` and comes to the
//! ring of radius `b = a + step` on an arc of the same radius that turns back by `pi - B`. The centres lie at `a + g`
//! and `b - g` from the origin and `2 g` apart: `A` and `B` are the angles of that triangle at them. There is such a
//! triangle for `step/4 <= g <= a + step/2`. The curvature jumps by `1/g + 1/radius` at each joint.
//!
//! The radius of a link is half that of the ring it leaves, but at least half a step: the acceleration of the link is
//! then twice that of the ring, and the link takes a fair part of a turn; a longer one only lengthens the cut in full
//! material. From the centre the first link is a semicircle.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::disc::{Cleared, Disc, along_inner, arc, line, turns};
use crate::base::Result;
use crate::geom::{InvoluteRecord, PlaneCurve, on_circle};

/// Radii of the rings, the starting circle (or centre) first, the wall last, with the step.
fn radii(disc: &Disc) -> Result<(Vec<f64>, f64)> {
    let n = turns(disc.outer - disc.inner, disc.step)?;
    let step = (disc.outer - disc.inner) / f64::from(n);
    let mut radii: Vec<f64> = (0..n).map(|i| disc.inner + step * f64::from(i)).collect();
    radii.push(disc.outer);
    Ok((radii, step))
}

pub(super) fn radial(disc: &Disc) -> Result<Cleared> {
    let (radii, step) = radii(disc)?;
    let mut curves = Vec::with_capacity(2 * radii.len());
    for pair in radii.windows(2) {
        if !curves.is_empty() {
            curves.push(InvoluteRecord::circle(pair[0], disc.psi)?.into());
        }
        curves.push(line(on_circle(pair[0], disc.psi), on_circle(pair[1], disc.psi))?);
    }
    disc.cleared(curves, (radii.len() - 2) as f64, step)
}

/// An S link.
struct Link {
    /// Radius of both arcs [mm].
    radius: f64,
    /// Angles turned outwards and back [rad].
    turns: [f64; 2],
}

impl Link {
    /// From the ring of radius `a` to that of radius `b` [mm].
    fn new(a: f64, b: f64) -> Link {
        if a == 0.0 {
            return Link { radius: 0.5 * b, turns: [0.0, PI] };
        }
        let g = 0.5 * a.max(b - a);
        let (to_first, to_second, between) = (a + g, b - g, 2.0 * g);
        // Cosine rule; the sides make a triangle for this radius, so the clamp holds off rounding only.
        let corner = |x: f64, y: f64, opposite: f64| {
            ((x * x + y * y - opposite * opposite) / (2.0 * x * y)).clamp(-1.0, 1.0).acos()
        };
        let out = corner(to_first, between, to_second);
        let back = PI - corner(to_second, between, to_first);
        Link { radius: g, turns: [out, back] }
    }

    /// Polar angle by which it goes on [rad].
    fn advance(&self) -> f64 {
        self.turns[1] - self.turns[0]
    }
}

pub(super) fn tangent(disc: &Disc) -> Result<Cleared> {
    let (radii, step) = radii(disc)?;
    let links: Vec<Link> = radii.windows(2).map(|pair| Link::new(pair[0], pair[1])).collect();
    let advance: f64 = links.iter().map(Link::advance).sum();
    // So much before the wall point it has to leave the starting circle.
    let mut angle = disc.psi - advance;
    let mut curves = Vec::with_capacity(3 * radii.len());
    curves.extend(along_inner(disc, -advance)?);
    let mut turned = curves.iter().map(PlaneCurve::turn).sum::<f64>() + advance;
    for (i, (pair, link)) in radii.windows(2).zip(&links).enumerate() {
        if i > 0 {
            curves.push(arc(DVec2::ZERO, pair[0], angle, TAU)?);
            turned += TAU;
        }
        let [out, back] = link.turns;
        if out > 0.0 {
            curves.push(arc(on_circle(pair[0] + link.radius, angle), -link.radius, angle, out)?);
        }
        let arrival = angle + link.advance();
        let centre = on_circle(pair[1] - link.radius, arrival);
        curves.push(arc(centre, link.radius, angle - out, back)?);
        angle = arrival;
    }
    disc.cleared(curves, turned / TAU, step)
}
