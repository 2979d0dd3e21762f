//! How the tool is looked at: to the side of its motion and a little from below, in parallel projection.

use glam::{DVec2, DVec3};

use crate::verbs::grazing::GrazingSheet;

/// How far the viewer stands to the side of where the tool goes [rad].
const ASIDE: f64 = 0.95;
/// How far below [rad].
const BELOW: f64 = 0.42;

/// A view of the tool on paper.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    /// Direction to the viewer.
    pub(crate) viewer: DVec3,
    right: DVec3,
    up: DVec3,
    scale: f64,
    zero: DVec2,
}

impl View {
    /// The view that fits the tool into a box: left, top, width, height [px].
    pub(crate) fn new(sheet: &GrazingSheet, at: [f64; 4]) -> View {
        let extent = extent(sheet);
        let middle = DVec3::new(0.0, 0.0, 0.5 * (extent[1] + extent[2]));
        let velocity = sheet.twist.velocity(middle).truncate();
        let tip = sheet.twist.velocity(DVec3::new(0.0, 0.0, extent[1])).truncate();
        let ahead = velocity.try_normalize().or_else(|| tip.try_normalize()).unwrap_or(DVec2::X);
        let [right, up, viewer] = looking(ahead, -BELOW);
        let (sin_e, cos_e) = (-BELOW).sin_cos();
        // Circles of the largest radius at both ends of the axis bound all that is drawn.
        let [radius, low, high] = extent;
        let half = [radius, 0.5 * (high - low) * cos_e + radius * sin_e.abs()];
        let scale = (0.5 * at[2] / half[0]).min(0.5 * at[3] / half[1]);
        let centre = DVec2::new(at[0] + 0.5 * at[2], at[1] + 0.5 * at[3]);
        let seen = DVec2::new(middle.dot(right), -middle.dot(up));
        View { viewer, right, up, scale, zero: centre - seen * scale }
    }

    /// A view that fits points into a box: left, top, width, height [px]; from the side of where the tool goes, a little from
    /// below.
    pub(crate) fn fitting(ahead: DVec2, points: &[DVec3], at: [f64; 4]) -> View {
        let [right, up, viewer] = looking(ahead, -BELOW);
        let seen = |p: &DVec3| DVec2::new(p.dot(right), -p.dot(up));
        let low = points.iter().map(seen).reduce(DVec2::min).unwrap_or(DVec2::ZERO);
        let high = points.iter().map(seen).reduce(DVec2::max).unwrap_or(DVec2::ONE);
        let scale = (at[2] / (high.x - low.x)).min(at[3] / (high.y - low.y));
        let centre = DVec2::new(at[0] + 0.5 * at[2], at[1] + 0.5 * at[3]);
        View { viewer, right, up, scale, zero: centre - 0.5 * (low + high) * scale }
    }

    /// Right, up, and to the viewer: unit vectors.
    pub(crate) fn axes(&self) -> [DVec3; 3] {
        [self.right, self.up, self.viewer]
    }

    /// A place on paper [px].
    pub(crate) fn px(&self, p: DVec3) -> [f64; 2] {
        (self.zero + DVec2::new(p.dot(self.right), -p.dot(self.up)) * self.scale).to_array()
    }

    /// Length on paper of a direction [px].
    pub(crate) fn turned(&self, v: DVec3) -> DVec2 {
        DVec2::new(v.dot(self.right), -v.dot(self.up))
    }

    /// Shade of a normal from 0, the lightest, to 2.
    pub(crate) fn shade(&self, normal: DVec3) -> u8 {
        let light = (self.viewer + 0.5 * self.up - 0.7 * self.right).normalize_or_zero();
        match normal.dot(light) {
            l if l > 0.72 => 0,
            l if l > 0.36 => 1,
            _ => 2,
        }
    }

    /// A length of paper [px] as one of the tool [mm].
    pub(crate) fn mm(&self, px: f64) -> f64 {
        px / self.scale
    }
}

/// Right, up, and to the viewer, who stands to the side of where the tool goes at an elevation [rad].
fn looking(ahead: DVec2, elevation: f64) -> [DVec3; 3] {
    let azimuth = ahead.y.atan2(ahead.x) - ASIDE;
    let ((sin, cos), (sin_e, cos_e)) = (azimuth.sin_cos(), elevation.sin_cos());
    let viewer = DVec3::new(cos * cos_e, sin * cos_e, sin_e);
    let right = DVec3::new(-sin, cos, 0.0);
    [right, viewer.cross(right), viewer]
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
