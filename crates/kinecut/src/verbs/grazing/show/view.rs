//! The viewer of a tool: to the side of its motion and a little from below.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::page::draw::View;
use crate::verbs::grazing::GrazingSheet;

/// Angle of the viewer to the side of the tool's motion [rad].
const ASIDE: f64 = 0.95;
/// Angle of the viewer below [rad].
const BELOW: f64 = 0.42;
/// Points of a circle round all that is drawn.
const ROUND: u32 = 60;

/// The view from the side of where the tool goes.
pub(crate) fn view_of(ahead: DVec2) -> View {
    View::from(ahead.to_angle() - ASIDE, -BELOW)
}

/// The view that fits the tool into a box: left, top, width, height [px].
pub(super) fn fitted(sheet: &GrazingSheet, at: [f64; 4]) -> View {
    let [radius, low, high] = extent(sheet);
    let middle = DVec3::new(0.0, 0.0, 0.5 * (low + high));
    let velocity = sheet.twist.velocity(middle).truncate();
    let tip = sheet.twist.velocity(DVec3::new(0.0, 0.0, low)).truncate();
    let ahead = velocity.try_normalize().or_else(|| tip.try_normalize()).unwrap_or(DVec2::X);
    // Circles of the largest radius at both ends of the axis bound all that is drawn.
    let ring = |z: f64| {
        (0..ROUND).map(move |i| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(ROUND)).sin_cos();
            DVec3::new(radius * cos, radius * sin, z)
        })
    };
    view_of(ahead).fitting(ring(low).chain(ring(high)), at)
}

/// Largest radius, lowest and highest height of a tool [mm].
pub(crate) fn extent(sheet: &GrazingSheet) -> [f64; 3] {
    let mut found = [0.0f64, f64::INFINITY, f64::NEG_INFINITY];
    for piece in sheet.chain.pieces() {
        let mut k = 0.0;
        while k <= 8.0 {
            let p = piece.point(piece.from + (piece.to - piece.from) * k / 8.0);
            found = [found[0].max(p.x), found[1].min(p.y), found[2].max(p.y)];
            k += 1.0;
        }
    }
    found
}
