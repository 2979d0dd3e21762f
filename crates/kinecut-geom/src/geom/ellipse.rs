//! Distance from an ellipse in the plane.

use glam::DVec2;

use crate::num::root::bracketed_newton;

/// Signed distance [mm] of a point from the ellipse with half axes `a` along X and `b` along Y about the origin:
/// positive inside.
///
/// The foot of the perpendicular is where `F(t) = (a x / (t + a^2))^2 + (b y / (t + b^2))^2 - 1` has its largest root;
/// F falls and is convex there, so that a bracketed Newton iteration always finds it (Eberly 2013).
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::ellipse_distance;
/// assert!((ellipse_distance([60.0, 40.0], [0.0, 39.0].into()) - 1.0).abs() < 1e-13);
/// assert!((ellipse_distance([60.0, 40.0], [0.0, 0.0].into()) - 40.0).abs() < 1e-13);
/// assert!((ellipse_distance([60.0, 40.0], [62.0, 0.0].into()) + 2.0).abs() < 1e-13);
/// ```
pub fn ellipse_distance([a, b]: [f64; 2], p: DVec2) -> f64 {
    // The first quadrant, the long axis along X.
    let (a, b, p) = if a >= b { (a, b, p.abs()) } else { (b, a, DVec2::new(p.y, p.x).abs()) };
    let inside = (p.x / a).powi(2) + (p.y / b).powi(2) <= 1.0;
    let foot = if p.y > 0.0 {
        let (zx, zy) = (p.x / b, p.y / b);
        let ratio = (a / b).powi(2);
        // w = t/b^2 + 1, so that a point next to the long axis, w next to 0, loses nothing; between the bounds that
        // each term alone gives.
        let beyond = ratio - 1.0;
        let f = |w: f64| {
            let (u, v) = (ratio.sqrt() * zx / (w + beyond), zy / w);
            let value = u * u + v * v - 1.0;
            let slope = -2.0 * (u * u / (w + beyond) + v * v / w);
            (-value, -slope)
        };
        let (low, high) = (zy, (ratio.sqrt() * zx).hypot(zy));
        /// Newton doubles the digits; where it leaves the bracket it is halved.
        const STEPS: u32 = 200;
        let (w, _) = bracketed_newton(f, low, low, if high > low { high } else { low }, STEPS);
        DVec2::new(ratio * p.x / (w + beyond), p.y / w)
    } else {
        // On the long axis: between the centres of curvature the foot leaves the axis.
        let x = a * a * p.x / (a * a - b * b);
        if x.is_finite() && x < a {
            DVec2::new(x, b * (1.0 - (x / a).powi(2)).sqrt())
        } else {
            DVec2::new(a, 0.0)
        }
    };
    let distance = (p - foot).length();
    if inside { distance } else { -distance }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The distance of the nearest of many points, sought on between the neighbours of each that is nearer than they.
    fn least_of_all([a, b]: [f64; 2], p: DVec2) -> f64 {
        const COUNT: u32 = 2000;
        let away = |t: f64| (DVec2::new(a * t.cos(), b * t.sin()) - p).length();
        let time = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(COUNT);
        let mut least = f64::INFINITY;
        for i in 1..=COUNT {
            let [mut low, mut high] = [time(i - 1), time(i + 1)];
            if away(time(i)) > away(low).min(away(high)) {
                continue;
            }
            while high - low > 1e-11 {
                let third = (high - low) / 3.0;
                if away(low + third) < away(high - third) { high -= third } else { low += third }
            }
            least = least.min(away(0.5 * (low + high)));
        }
        least
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn it_is_the_least_over_many_points(a in 1.0..80.0f64, b in 1.0..80.0f64, x in -100.0..100.0f64, y in -100.0..100.0f64, axis in 0u8..5) {
            let p = match axis { 0 => DVec2::new(x, 0.0), 1 => DVec2::new(0.0, y), 2 => DVec2::new(x, y * 1e-17), _ => DVec2::new(x, y) };
            let found = ellipse_distance([a, b], p);
            let least = least_of_all([a, b], p);
            prop_assert!((found.abs() - least).abs() < 1e-9 * (1.0 + least), "{found} {least}");
            prop_assert_eq!(found > 0.0, (p.x / a).powi(2) + (p.y / b).powi(2) <= 1.0);
        }
    }
}
