//! From a model to paper in parallel projection, with the light of all pictures.

use glam::{DVec2, DVec3};

use super::Ink;

/// A view of a model on paper.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    /// Direction to the viewer, of length one.
    pub(crate) viewer: DVec3,
    /// Directions of right and up on paper: their lengths are those of a millimetre there at scale one.
    right: DVec3,
    up: DVec3,
    scale: f64,
    zero: DVec2,
}

impl View {
    /// Isometric: X to the lower right, Y to the upper right, Z up, all as long as they are.
    pub(crate) fn isometric() -> View {
        let wide = 3f64.sqrt() / 2.0;
        View {
            viewer: DVec3::new(1.0, -1.0, 1.0) / 3f64.sqrt(),
            right: DVec3::new(wide, wide, 0.0),
            up: DVec3::new(-0.5, 0.5, 1.0),
            scale: 1.0,
            zero: DVec2::ZERO,
        }
    }

    /// From an azimuth and an elevation [rad], Z up.
    pub(crate) fn from(azimuth: f64, elevation: f64) -> View {
        let ((sin, cos), (sin_e, cos_e)) = (azimuth.sin_cos(), elevation.sin_cos());
        let viewer = DVec3::new(cos * cos_e, sin * cos_e, sin_e);
        let right = DVec3::new(-sin, cos, 0.0);
        View { viewer, right, up: viewer.cross(right), scale: 1.0, zero: DVec2::ZERO }
    }

    /// The same so that points fill a box: left, top, width, height [px].
    pub(crate) fn fitting(self, points: impl IntoIterator<Item = DVec3>, at: [f64; 4]) -> View {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for q in points.into_iter().filter(|p| p.is_finite()).map(|p| self.turned(p)) {
            (low, high) = (low.min(q), high.max(q));
        }
        self.showing([low, high], at)
    }

    /// The same so that a window of the paper at scale one fills a box: left, top, width, height [px].
    pub(crate) fn showing(self, [low, high]: [DVec2; 2], at: [f64; 4]) -> View {
        let (low, high) = if low.cmple(high).all() { (low, high) } else { (DVec2::ZERO, DVec2::ONE) };
        let size = (high - low).max(DVec2::splat(1e-9));
        let scale = (at[2] / size.x).min(at[3] / size.y);
        let centre = DVec2::new(at[0] + 0.5 * at[2], at[1] + 0.5 * at[3]);
        View { scale, zero: centre - 0.5 * (low + high) * scale, ..self }
    }

    /// A place on paper [px].
    pub(crate) fn px(&self, p: DVec3) -> [f64; 2] {
        (self.zero + self.turned(p) * self.scale).to_array()
    }

    /// A direction on paper, y downwards, at scale one.
    pub(crate) fn turned(&self, v: DVec3) -> DVec2 {
        DVec2::new(v.dot(self.right), -v.dot(self.up))
    }

    /// A place of paper [px] at scale one.
    pub(crate) fn back(&self, p: [f64; 2]) -> DVec2 {
        (DVec2::from(p) - self.zero) / self.scale
    }

    /// Nearness of a place to the viewer.
    pub(crate) fn depth(&self, p: DVec3) -> f64 {
        p.dot(self.viewer)
    }

    /// A length of paper [px] in the model.
    pub(crate) fn mm(&self, px: f64) -> f64 {
        px / self.scale
    }

    /// Shade of a surface by its normal, from 0, the lightest: light comes from the upper left.
    pub(crate) fn shade(&self, normal: DVec3) -> u8 {
        /// Part of the way from fully lit to turned away at which a surface is darkest.
        const DARKEST: f64 = 1.25;
        let [right, up] = [self.right, self.up].map(DVec3::normalize_or_zero);
        let light = (self.viewer + 0.7 * up - 0.45 * right).normalize_or_zero();
        let dark = (1.0 - normal.dot(light)).clamp(0.0, DARKEST) / DARKEST;
        ((dark * f64::from(Ink::SHADES)) as u8).min(Ink::SHADES - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_of_an_isometric_view_are_as_long_as_they_are() {
        let view = View::isometric();
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            assert!((view.turned(axis).length() - 1.0).abs() < 1e-12);
        }
        assert!(view.turned(view.viewer).length() < 1e-12);
        assert!(view.turned(DVec3::X).y > 0.0 && view.turned(DVec3::Y).y < 0.0);
    }

    #[test]
    fn a_fitted_view_fills_its_box_and_goes_back() {
        let points = [DVec3::ZERO, DVec3::new(30.0, 10.0, -5.0), DVec3::new(-4.0, 8.0, 60.0)];
        for view in [View::isometric(), View::from(0.3, -0.4)] {
            let view = view.fitting(points, [10.0, 20.0, 300.0, 200.0]);
            let seen = points.map(|p| view.px(p));
            assert!(
                seen.iter().all(|p| p[0] > 9.9 && p[0] < 310.1 && p[1] > 19.9 && p[1] < 220.1),
                "{seen:?}"
            );
            assert!((view.back(seen[1]) - view.turned(points[1])).length() < 1e-9);
            assert!(view.shade(view.viewer) < view.shade(-view.viewer));
        }
    }
}
