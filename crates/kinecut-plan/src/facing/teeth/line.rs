//! Crossings of one tooth with one piece of a straight edge.
//!
//! On an edge of the heading beta the distance of the tooth from the line is, per radius,
//! A + kappa t + cos(t + phase + beta), kappa = rho sin(beta). With t + phase + beta = v +- pi/2 (exit, entry) it
//! vanishes where sin(v) - k v = B, k = +-kappa, on |v| <= arccos(k), where the left side increases. From one
//! revolution to the next B grows by 2 pi k: the last root, carried on by its first three derivatives, starts the
//! next, and a step of third order mostly ends it.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use super::ToothCrossing;
use super::pieces::{CrossedPiece, PlacedEdge, Trochoid};

/// Iterations after which a root is taken as it is: bisection alone needs 60.
const ITERATIONS: u32 = 100;

/// A step below this share of the slope leaves an error below 1e-16, as the step is of third order.
const LAST_STEP: f64 = 4e-6;

/// Largest change of B per slope squared for which the last root starts the next.
const NEAR: f64 = 0.1;

/// Calls `found` with the crossings; `tooth` and `edge` of a crossing are left 0.
pub(super) fn crossings(
    trochoid: Trochoid,
    phase: f64,
    edge: &PlacedEdge,
    piece: &CrossedPiece,
    mut found: impl FnMut(ToothCrossing),
) {
    let [first, last] = piece.revolutions(phase / TAU);
    if !(first <= last) {
        return;
    }
    let Trochoid { radius, feed } = trochoid;
    let rho = feed / radius;
    let along = edge.end - edge.start;
    let length = along.length();
    let (cos_b, sin_b) = (along.x / length, along.y / length);
    let beta = along.y.atan2(along.x);
    let (side, centre) = if piece.exit { (1.0, FRAC_PI_2) } else { (-1.0, -FRAC_PI_2) };
    let kappa = rho * sin_b;
    let k = side * kappa;
    // The turn that brings the phase v + centre - beta into the half of the piece.
    let middle = edge.start.y + 0.5 * (piece.gone[0] + piece.gone[1]) * along.y;
    let centre = centre + TAU * ((trochoid.phase(middle, piece.front) + beta - centre) / TAU).round();
    let shift = centre - beta;
    let (sin_d, cos_d) = shift.sin_cos();
    let base = side * ((edge.start.y * cos_b - edge.start.x * sin_b) / radius + kappa * (shift - phase));
    let step_b = TAU * k;
    let limit = k.acos();
    let carry = |v: f64, sin: f64, slope: f64, cos: f64| {
        let e = step_b / slope;
        let bend = sin / slope;
        v + e * (1.0 + e * (0.5 * bend + e * (0.5 * bend * bend + cos / (6.0 * slope))))
    };

    let start_gone = if piece.turns[0] < piece.turns[1] { piece.gone[0] } else { piece.gone[1] };
    let mut v = trochoid.phase(edge.start.y + start_gone * along.y, piece.front) - shift;
    let mut carried = false;
    let mut turn = first;
    while turn <= last {
        let b = base + step_b * turn;
        if !carried {
            v = (b + k * v).clamp(-1.0, 1.0).asin();
        }
        let (v_now, sin, cos) = root(v, k, b, limit);
        let u = v_now + shift;
        let (sin_u, cos_u) = (sin * cos_d + cos * sin_d, cos * cos_d - sin * sin_d);
        let turned = TAU * turn;
        let point = DVec2::new(feed * (turned + u - phase) - radius * sin_u, -radius * cos_u);
        let share = ((point.x - edge.start.x) * cos_b + (point.y - edge.start.y) * sin_b) / length;
        let slope = cos - k;
        found(ToothCrossing {
            tooth: 0,
            edge: 0,
            exit: piece.exit,
            front: piece.front,
            time: turned + u - phase,
            share: share.clamp(0.0, BELOW_ONE),
            point,
            along: rho * cos_b + side * sin,
            outward: side * slope,
            ahead: -sin_u,
        });
        carried = step_b.abs() < NEAR * slope * slope;
        v = if carried { carry(v_now, sin, slope, cos) } else { v_now };
        turn += 1.0;
    }
}

/// The largest share that is not the end of the edge.
pub(super) const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

/// The root of sin(v) - k v = b with its sine and cosine.
#[inline]
fn root(start: f64, k: f64, b: f64, limit: f64) -> (f64, f64, f64) {
    let mut v = start.clamp(-limit, limit);
    let (mut lo, mut hi) = (-limit, limit);
    for _ in 0..ITERATIONS {
        let (sin, cos) = v.sin_cos();
        let (value, slope) = (sin - k * v - b, cos - k);
        let newton = value / slope;
        if slope > 0.0 && newton.abs() <= LAST_STEP * slope {
            let d = newton * (0.5 * newton * sin / slope - 1.0);
            let half = 0.5 * d * d;
            return (v + d, sin + d * cos - half * sin, cos - d * sin - half * cos);
        }
        if value > 0.0 {
            hi = v;
        } else {
            lo = v;
        }
        let next = v - newton + 0.5 * newton * newton * sin / slope;
        let newton_only = v - newton;
        v = if lo < next && next < hi && (next - v) * (newton_only - v) > 0.0 {
            next
        } else if lo < newton_only && newton_only < hi {
            newton_only
        } else {
            0.5 * (lo + hi)
        };
        if hi - lo <= f64::EPSILON {
            break;
        }
    }
    let (sin, cos) = v.sin_cos();
    (v, sin, cos)
}
