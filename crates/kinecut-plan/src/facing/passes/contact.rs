//! First contact of the cutter with a point: the general law of exit angles.
//!
//! Let C be the centre when a point p of an edge is first covered, |p - C| = R. The tooth that meets p then points in
//! the direction p - C, and the exit angle is the angle of p - C less the direction of the outward normal.
//!
//! Exit angle psi at first contact means: C = p - R unit(nu + psi) lies on the path. Along a straight edge that point
//! moves on a line parallel to it, along a circular one on a circle about the same centre: where the exit angle passes
//! a bound is where a line or circle meets a line or circle, never an equation to be solved by steps.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;

use super::meet::Whole;
use crate::geom::{OutlineEdge, Turn};
use crate::num::angle::wrap;

/// The centres from which the points of an edge have the exit angle `psi` [rad]: share by share of the edge.
pub(super) fn centres(edge: &OutlineEdge, radius: f64, psi: f64) -> Option<OutlineEdge> {
    let Some(turn) = edge.turn else {
        let shift = radius * DVec2::from_angle(edge.outward(0.0) + psi);
        return Some(OutlineEdge::line(edge.start - shift, edge.end - shift));
    };
    // r unit(phi) - R unit(phi + ahead): a vector that turns with phi.
    let ahead = if turn.convex() { psi } else { psi + PI };
    let arm = DVec2::new(turn.radius - radius * ahead.cos(), -radius * ahead.sin());
    let length = arm.length();
    // All points of the edge then have the same centre: no passing.
    (length > 0.0).then(|| {
        let turned = Turn { radius: length, from: turn.from + arm.y.atan2(arm.x), ..turn };
        let at = |a: f64| turn.centre + length * DVec2::from_angle(a);
        OutlineEdge {
            start: at(turned.from),
            end: at(turned.from + turned.sweep),
            turn: Some(turned),
            label: edge.label,
        }
    })
}

/// The lines and circles at which points stop or begin to be covered by a cutter on a piece of path: the offsets of the
/// piece, and the discs about its ends.
pub(super) fn borders(piece: &OutlineEdge, radius: f64) -> [Whole; 4] {
    let disc = |centre| Whole::Circle { centre, radius };
    let beside = |side: f64| match Whole::of(piece) {
        Whole::Line { point, along } => Whole::Line { point: point + side * radius * along.perp(), along },
        Whole::Circle { centre, radius: r } => Whole::Circle { centre, radius: (r + side * radius).abs() },
    };
    [disc(piece.start), disc(piece.end), beside(1.0), beside(-1.0)]
}

/// From the cutter's centre to the point at first contact, for a point that the piece covers but its start does not.
pub(super) fn arm(piece: &OutlineEdge, radius: f64, point: DVec2) -> DVec2 {
    match piece.turn {
        None => {
            let along = (piece.end - piece.start).normalize_or_zero();
            let aside = along.perp_dot(point - piece.start);
            let square = (radius - aside) * (radius + aside);
            let ahead = if square > 0.0 { square.sqrt() } else { 0.0 };
            ahead * along + aside * along.perp()
        }
        Some(turn) => {
            let out = point - turn.centre;
            let d = out.length();
            // Two centres on the circle touch the point; the one met first lies before it in the direction of travel.
            let cosine = ((turn.radius - radius) * (turn.radius + radius) + d * d) / (2.0 * turn.radius * d);
            let before = cosine.clamp(-1.0, 1.0).acos().copysign(turn.sweep);
            out - turn.radius * DVec2::from_angle(out.y.atan2(out.x) - before)
        }
    }
}

/// The exit angle of a point at the share `s` of an edge, first met by a piece: -pi/2 to 3 pi/2 [rad].
pub fn exit_angle(edge: &OutlineEdge, s: f64, piece: &OutlineEdge, radius: f64) -> f64 {
    let arm = arm(piece, radius, edge.at(s));
    wrap(arm.y.atan2(arm.x) - edge.outward(s) - FRAC_PI_2) + FRAC_PI_2
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;

    #[test]
    fn the_first_of_the_two_centres_that_touch_is_taken() {
        let radius = 5.0;
        for piece in [
            OutlineEdge::line(dvec2(-20.0, 1.0), dvec2(20.0, 3.0)),
            OutlineEdge::arc(dvec2(0.0, -12.0), 12.0, 2.8, -2.5),
            OutlineEdge::arc(dvec2(1.0, 2.0), 3.0, 0.4, 5.0),
            OutlineEdge::arc(dvec2(1.0, 2.0), 3.0, 0.4, -5.0),
        ] {
            let n = 20_000;
            let mut tried = 0;
            for k in 0..200 {
                let p = (0.1 * f64::from(k)) * DVec2::from_angle(2.4 * f64::from(k));
                let first = (0..=n).find(|&i| piece.at(f64::from(i) / f64::from(n)).distance(p) <= radius);
                let Some(i) = first.filter(|&i| i > 0) else { continue };
                let centre = piece.at(f64::from(i) / f64::from(n));
                let have = p - arm(&piece, radius, p);
                assert!(have.distance(centre) < 2e-2 * radius, "{piece:?} {p}: {have} {centre}");
                tried += 1;
            }
            assert!(tried > 5, "{piece:?}");
        }
    }
}
