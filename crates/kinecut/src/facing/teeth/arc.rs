//! Crossings of one tooth with one piece of a circular edge: the revolution as a function of the angle gone is
//! monotone there and is inverted by Newton's method in a bracket; a step in both phase and angle makes the root
//! exact where the cutter's top or bottom spoils the revolution's derivative.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use super::Crossing;
use super::line::BELOW_ONE;
use super::pieces::{Form, Piece, PlacedEdge, Trochoid};
use crate::num::root::bracketed_newton;

/// Iterations after which a root is taken as it stands: bisection alone needs 60.
const ITERATIONS: u32 = 100;

/// Larger changes of phase or angle [rad] are no polish: the step is left out.
const POLISH: f64 = 1e-6;

/// Calls `found` with the crossings; `tooth` and `edge` of a crossing are left 0.
pub(super) fn crossings(
    trochoid: Trochoid,
    phase: f64,
    edge: &PlacedEdge,
    piece: &Piece,
    mut found: impl FnMut(Crossing),
) {
    let Form::Arc { centre, radius, from, sweep } = edge.form else { return };
    let [first, last] = piece.revolutions(phase / TAU);
    let Trochoid { radius: cutter, feed } = trochoid;
    let (rho, sign, front) = (feed / cutter, sweep.signum(), piece.front);
    let [lo, hi] = piece.gone;
    let up = (piece.turns[1] - piece.turns[0]).signum();
    let mut gone = if up > 0.0 { lo } else { hi };
    let mut last_turn = if up > 0.0 { piece.turns[0] } else { piece.turns[1] } + phase / TAU;
    let mut slope = f64::INFINITY;
    let mut turn = first;
    while turn <= last {
        // Revolutions against the wanted one, and their slope, at an angle gone.
        let value = |gone: f64| {
            let (sin, cos) = (from + sign * gone).sin_cos();
            let point = centre + radius * DVec2::new(cos, sin);
            let q = -point.y / cutter;
            let root = ((1.0 - q) * (1.0 + q)).sqrt();
            let lift = -radius * cos / cutter / root * (q / rho - 1.0);
            let slope = (-radius * sin / feed + if front { lift } else { -lift }) * sign / TAU;
            (up * (trochoid.turns(point, front) + phase / TAU - turn), up * slope)
        };
        let ahead = (turn - last_turn) / slope;
        let (root, _) = bracketed_newton(value, gone + up * ahead, lo, hi, ITERATIONS);
        gone = root;
        slope = value(gone).1;
        last_turn = turn;

        let mut phi = from + sign * gone;
        let mut u = trochoid.phase(centre.y + radius * phi.sin(), front);
        let turned = TAU * turn - phase;
        for _ in 0..2 {
            let tooth = DVec2::new(feed * (turned + u) - cutter * u.sin(), -cutter * u.cos());
            let velocity = DVec2::new(feed - cutter * u.cos(), cutter * u.sin());
            let outward = DVec2::from_angle(phi);
            let (miss, tangent) = (tooth - centre - radius * outward, radius * outward.perp());
            let across = velocity.perp_dot(tangent);
            let (du, dphi) = (-miss.perp_dot(tangent) / across, velocity.perp_dot(miss) / across);
            if !(du.abs() < POLISH && dphi.abs() < POLISH) {
                break;
            }
            u += du;
            phi += dphi;
        }
        let (sin_u, cos_u) = u.sin_cos();
        let velocity = DVec2::new(rho - cos_u, sin_u);
        let heading = DVec2::from_angle(phi + sign * FRAC_PI_2);
        found(Crossing {
            tooth: 0,
            edge: 0,
            exit: piece.exit,
            front,
            time: turned + u,
            share: ((phi - from) / sweep).clamp(0.0, BELOW_ONE),
            point: DVec2::new(feed * (turned + u) - cutter * sin_u, -cutter * cos_u),
            along: heading.dot(velocity),
            outward: heading.perp_dot(velocity),
            ahead: -sin_u,
        });
        turn += 1.0;
    }
}
