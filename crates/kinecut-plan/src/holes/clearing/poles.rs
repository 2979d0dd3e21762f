//! Arc spirals: arcs about the vertices of a regular polygon in turn, each larger by a part of the step.
//!
//! It is the involute of the polygon: of a segment for 2 poles (semicircles), of a square for 4. The polygon of side
//! `step / poles` has a vertex in the origin, so that the last arc goes over into the wall circle with a common
//! tangent (contact G1); the curvature jumps at each joint by `1/R - 1/(R + side)`.

use std::f64::consts::TAU;

use glam::DVec2;

use super::disc::{Cleared, Disc, MOST_PIECES, arc, too_many, turns};
use crate::base::{Code, Finding, Result};
use crate::geom::on_circle;

/// The first arc from a circle about the origin lies on that circle itself (its vertex is the origin); from the
/// centre it has no length.
pub(super) fn arcs(disc: &Disc, poles: u32) -> Result<Cleared> {
    if poles < 2 {
        return Err(Finding::error(Code::PLAN_VALUE, "an arc spiral needs at least two poles")
            .value(f64::from(poles), "poles")
            .bound(2.0, "poles")
            .help("choose 2 (semicircles) or 4")
            .into());
    }
    let n = turns(disc.outer - disc.inner, disc.step)?;
    let (m, count) = (f64::from(poles), f64::from(poles) * f64::from(n));
    if count > MOST_PIECES {
        return Err(too_many(count, "arcs"));
    }
    let (side, angle) = ((disc.outer - disc.inner) / count, TAU / m);
    // The tangent angle at the start of arc i is psi + i angle; vertices follow one another along its inward normal.
    let heading = |i: u32| disc.psi + angle * f64::from(i % poles);
    let mut vertices = vec![DVec2::ZERO];
    for i in 1..poles {
        vertices.push(vertices[i as usize - 1] - on_circle(side, heading(i)));
    }
    let first = u32::from(disc.inner == 0.0);
    let curves = (first..poles * n)
        .map(|i| {
            let radius = disc.inner + side * f64::from(i);
            arc(vertices[(i % poles) as usize], radius, heading(i), angle)
        })
        .collect::<Result<Vec<_>>>()?;
    let run = curves.len() as f64 / m;
    disc.cleared(curves, run, side * m)
}
