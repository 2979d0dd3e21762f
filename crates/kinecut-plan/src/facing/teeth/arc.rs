//! Crossings of one tooth with one piece of a circular edge.
//!
//! Phase of the tooth and angle on the arc are solved for together by Newton's method, from one revolution to the next
//! carried on by their derivatives. What it finds within the piece is the crossing, as there is one only; what it does
//! not find is found in a bracket: the revolution as a function of the angle gone is monotone.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use super::ToothCrossing;
use super::line::BELOW_ONE;
use super::pieces::{CrossedPiece, Form, PlacedEdge, Trochoid};
use crate::num::root::bracketed_newton;

/// Iterations in the bracket after which a root is taken as it is: bisection alone needs 60.
const ITERATIONS: u32 = 100;

/// Newton steps before the bracket is asked: near a tangency they may never end.
const STEPS: u32 = 8;

/// A step whose square is below this, per sine of the angle between the ways, is the last: the error left is its
/// square.
const LAST_STEP: f64 = 1e-17;

/// A tooth on an arc: phase of the tooth, angle on the arc, how both change from one revolution to the next.
#[derive(Clone, Copy)]
struct Meeting {
    u: f64,
    phi: f64,
    du: f64,
    dphi: f64,
    tooth: DVec2,
    heading: DVec2,
    velocity: DVec2,
}

/// Calls `found` with the crossings; `tooth` and `edge` of a crossing are left 0.
pub(super) fn crossings(
    trochoid: Trochoid,
    phase: f64,
    edge: &PlacedEdge,
    piece: &CrossedPiece,
    mut found: impl FnMut(ToothCrossing),
) {
    let Form::Arc { centre, radius, from, sweep } = edge.form else { return };
    let [first, last] = piece.revolutions(phase / TAU);
    let sign = sweep.signum();
    let circle = Circle { centre, radius, trochoid, sign };
    let gone = |phi: f64| sign * (phi - from);
    let inside = |m: &Meeting| {
        let half = if piece.front { -PI < m.u && m.u < 0.0 } else { 0.0 < m.u && m.u < PI };
        half && (piece.gone[0]..=piece.gone[1]).contains(&gone(m.phi))
    };
    let mut carried: Option<[f64; 4]> = None;
    let mut turn = first;
    while turn <= last {
        let turned = TAU * turn - phase;
        let newton = carried.and_then(|[u, phi, ..]| circle.meet(u, phi, turned)).filter(inside);
        let meeting = newton.unwrap_or_else(|| {
            let phi = from + sign * circle.bracketed(piece, from, turn - phase / TAU);
            let u = trochoid.phase(centre.y + radius * phi.sin(), piece.front);
            let polished = circle.meet(u, phi, turned).filter(inside);
            polished.unwrap_or_else(|| circle.at(u, phi, turned))
        });
        let Meeting { u, phi, du, dphi, .. } = meeting;
        let sides = DVec2::new(trochoid.rho(), 0.0) + (meeting.velocity / trochoid.radius);
        found(ToothCrossing {
            tooth: 0,
            edge: 0,
            exit: piece.exit,
            front: piece.front,
            time: turned + u,
            share: (gone(phi) / sweep.abs()).clamp(0.0, BELOW_ONE),
            point: meeting.tooth,
            along: meeting.heading.dot(sides),
            outward: meeting.heading.perp_dot(sides),
            ahead: -meeting.velocity.y / trochoid.radius,
        });
        let (last_du, last_dphi) = carried.map_or((du, dphi), |c| (c[2], c[3]));
        carried = Some([u + 1.5 * du - 0.5 * last_du, phi + 1.5 * dphi - 0.5 * last_dphi, du, dphi]);
        turn += 1.0;
    }
}

struct Circle {
    centre: DVec2,
    radius: f64,
    trochoid: Trochoid,
    sign: f64,
}

impl Circle {
    /// Newton's method in both unknowns; none if it does not settle. `velocity` is that of the circle alone, without
    /// the feed.
    #[inline]
    fn meet(&self, mut u: f64, mut phi: f64, turned: f64) -> Option<Meeting> {
        let Trochoid { radius: cutter, feed } = self.trochoid;
        for _ in 0..STEPS {
            let (sin_u, cos_u) = u.sin_cos();
            let (sin, cos) = phi.sin_cos();
            let outward = DVec2::new(cos, sin);
            let tooth = DVec2::new(feed * (turned + u) - cutter * sin_u, -cutter * cos_u);
            let circle = DVec2::new(-cutter * cos_u, cutter * sin_u);
            let velocity = DVec2::new(feed + circle.x, circle.y);
            let tangent = self.radius * outward.perp();
            let miss = tooth - self.centre - self.radius * outward;
            let per_across = 1.0 / velocity.perp_dot(tangent);
            let (du, dphi) = (-miss.perp_dot(tangent) * per_across, velocity.perp_dot(miss) * per_across);
            u += du;
            phi += dphi;
            if (du * du + dphi * dphi) * cutter * self.radius * per_across.abs() < LAST_STEP {
                let shift = TAU * feed;
                return Some(Meeting {
                    u,
                    phi,
                    // The tooth is shifted by a revolution's feed along x.
                    du: -shift * tangent.y * per_across,
                    dphi: -shift * velocity.y * per_across,
                    tooth: tooth + du * velocity,
                    heading: self.sign * (outward.perp() - dphi * outward),
                    velocity: circle + du * cutter * DVec2::new(sin_u, cos_u),
                });
            }
        }
        None
    }

    /// The meeting as it is, for a root that Newton's method cannot better.
    fn at(&self, u: f64, phi: f64, turned: f64) -> Meeting {
        let Trochoid { radius: cutter, feed } = self.trochoid;
        let (sin_u, cos_u) = u.sin_cos();
        Meeting {
            u,
            phi,
            du: 0.0,
            dphi: 0.0,
            tooth: DVec2::new(feed * (turned + u) - cutter * sin_u, -cutter * cos_u),
            heading: DVec2::from_angle(phi + self.sign * FRAC_PI_2),
            velocity: DVec2::new(-cutter * cos_u, cutter * sin_u),
        }
    }

    /// Angle gone at which the revolution of phase 0 is `turn`, within a piece.
    fn bracketed(&self, piece: &CrossedPiece, from: f64, turn: f64) -> f64 {
        let Trochoid { radius: cutter, feed } = self.trochoid;
        let [lo, hi] = piece.gone;
        let up = (piece.turns[1] - piece.turns[0]).signum();
        let value = |gone: f64| {
            let (sin, cos) = (from + self.sign * gone).sin_cos();
            let point = self.centre + self.radius * DVec2::new(cos, sin);
            let q = -point.y / cutter;
            let root = ((1.0 - q) * (1.0 + q)).sqrt();
            let lift = -self.radius * cos / cutter / root * (q * cutter / feed - 1.0);
            let slope =
                (-self.radius * sin / feed + if piece.front { lift } else { -lift }) * self.sign / TAU;
            // At the cutter's side the slope is infinite and no guide: the bracket is halved.
            let slope = if slope.is_finite() { up * slope } else { f64::NAN };
            (up * (self.trochoid.turns(point, piece.front) - turn), slope)
        };
        bracketed_newton(value, 0.5 * (lo + hi), lo, hi, ITERATIONS).0
    }
}
