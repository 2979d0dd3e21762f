//! The area that a triangle and a disc have in common, in closed form: along each side of the triangle the sector or
//! triangle to the disc's centre, signed.

use glam::DVec2;

/// Area common to a triangle, counter-clockwise, and the disc of a radius about the origin [mm^2].
pub(super) fn common_area(corners: &[DVec2; 3], radius: f64) -> f64 {
    (0..3).map(|i| side(corners[i], corners[(i + 1) % 3], radius)).sum()
}

/// Signed area of the disc's part in the triangle of the origin and a directed side.
fn side(a: DVec2, b: DVec2, radius: f64) -> f64 {
    let sector = |p: DVec2, q: DVec2| 0.5 * radius * radius * p.perp_dot(q).atan2(p.dot(q));
    let along = b - a;
    let squared = along.length_squared();
    if squared == 0.0 {
        return 0.0;
    }
    // Parameters of the side's line at which it crosses the circle.
    let foot = -a.dot(along) / squared;
    let gap = a.perp_dot(along) / squared.sqrt();
    let half = (radius - gap.abs()) * (radius + gap.abs());
    if half <= 0.0 {
        return sector(a, b);
    }
    let half = (half / squared).sqrt();
    let (from, to) = (foot - half, foot + half);
    if from >= 1.0 || to <= 0.0 {
        return sector(a, b);
    }
    let (mut p, mut q, mut area) = (a, b, 0.0);
    if from > 0.0 {
        p = a + along * from;
        area += sector(a, p);
    }
    if to < 1.0 {
        q = a + along * to;
        area += sector(q, b);
    }
    area + 0.5 * p.perp_dot(q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    #[test]
    fn known_areas() {
        let big = [DVec2::new(-9.0, -9.0), DVec2::new(9.0, -9.0), DVec2::new(0.0, 20.0)];
        assert!((common_area(&big, 2.0) - 4.0 * PI).abs() < 1e-13);
        let small = [DVec2::ZERO, DVec2::X, DVec2::Y];
        assert!((common_area(&small, 2.0) - 0.5).abs() < 1e-15);
        assert!((common_area(&[DVec2::ZERO, DVec2::X * 9.0, DVec2::Y * 9.0], 2.0) - PI).abs() < 1e-14);
        // Half of the disc lies beyond a side through its centre.
        let half = [DVec2::new(-9.0, 0.0), DVec2::new(9.0, 0.0), DVec2::new(0.0, 30.0)];
        assert!((common_area(&half, 2.0) - 2.0 * PI).abs() < 1e-14);
        let beside = [DVec2::new(2.0, 0.0), DVec2::new(3.0, 0.0), DVec2::new(2.0, 3.0)];
        assert!(common_area(&beside, 2.0).abs() < 1e-14);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn areas_against_chords(p in prop::array::uniform6(-3.0..3.0f64)) {
            let mut t = [DVec2::new(p[0], p[1]), DVec2::new(p[2], p[3]), DVec2::new(p[4], p[5])];
            if (t[1] - t[0]).perp_dot(t[2] - t[0]) < 0.0 {
                t.swap(1, 2);
            }
            // Area over chords at equal steps of x.
            let (n, r) = (4000, 2.0f64);
            let mut area = 0.0;
            for i in 0..n {
                let x = -r + 2.0 * r * (f64::from(i) + 0.5) / f64::from(n);
                let h = (r * r - x * x).sqrt();
                let (mut low, mut high) = (-h, h);
                for k in 0..3 {
                    let (a, d) = (t[k], t[(k + 1) % 3] - t[k]);
                    // Inside: d.x (y - a.y) >= d.y (x - a.x).
                    let bound = d.y * (x - a.x);
                    if d.x > 0.0 {
                        low = f64::max(low, a.y + bound / d.x);
                    } else if d.x < 0.0 {
                        high = f64::min(high, a.y + bound / d.x);
                    }
                }
                area += f64::max(high - low, 0.0) * 2.0 * r / f64::from(n);
            }
            prop_assert!((common_area(&t, r) - area).abs() < 2e-3, "{} {area}", common_area(&t, r));
        }
    }
}
