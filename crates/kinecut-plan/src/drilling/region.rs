//! Areas of what discs and a strip have in common, in closed form, by Green's theorem along the boundary: of each
//! circle the arcs, and of each line the chord, that lie within all the others.

use glam::DVec2;

/// Circles that differ by less coincide [mm]: rounding.
const SAME: f64 = 1e-9;

/// A disc across the tool axis [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Disc {
    /// Its centre.
    pub(crate) centre: DVec2,
    /// Its radius.
    pub(crate) radius: f64,
}

impl Disc {
    /// A disc about the tool axis.
    pub(crate) fn centred(radius: f64) -> Disc {
        Disc { centre: DVec2::ZERO, radius }
    }

    /// Whether a point lies inside, not on the rim.
    pub(crate) fn contains(&self, p: DVec2) -> bool {
        p.distance_squared(self.centre) < self.radius * self.radius
    }

    fn is_same(&self, other: &Disc) -> bool {
        self.centre.distance(other.centre) + (self.radius - other.radius).abs() <= SAME
    }

    /// The point of the rim at an angle.
    pub(crate) fn rim(&self, angle: f64) -> DVec2 {
        self.centre + DVec2::from_angle(angle) * self.radius
    }

    /// Angles of the rim at which it is as far from a point as `distance`, if it is.
    pub(crate) fn crossings(&self, point: DVec2, distance: f64) -> Option<[f64; 2]> {
        let to = point - self.centre;
        let d = to.length();
        let cosine = (d * d + (self.radius - distance) * (self.radius + distance)) / (2.0 * d * self.radius);
        // Also no number, where the centres coincide, is no crossing.
        (cosine.abs() <= 1.0).then(|| [to.to_angle() - cosine.acos(), to.to_angle() + cosine.acos()])
    }
}

/// The points whose coordinate along `along` lies between two numbers [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Strip {
    /// Unit vector across the strip.
    pub(crate) along: DVec2,
    /// Least and greatest coordinate.
    pub(crate) range: [f64; 2],
}

/// Area common to some discs and a strip [mm^2].
pub(crate) fn common_area(discs: &[Disc], strip: Option<&Strip>) -> f64 {
    let mut area = 0.0;
    for (n, disc) in discs.iter().enumerate() {
        let mut angles = vec![0.0];
        for (m, other) in discs.iter().enumerate() {
            if n != m {
                angles.extend(disc.crossings(other.centre, other.radius).into_iter().flatten());
            }
        }
        if let Some(s) = strip {
            for c in s.range {
                let cosine = (c - disc.centre.dot(s.along)) / disc.radius;
                if cosine.abs() <= 1.0 {
                    let at = s.along.to_angle();
                    angles.extend([at - cosine.acos(), at + cosine.acos()]);
                }
            }
        }
        let tau = std::f64::consts::TAU;
        angles.iter_mut().for_each(|a| *a = a.rem_euclid(tau));
        angles.sort_by(f64::total_cmp);
        for i in 0..angles.len() {
            let a = angles[i];
            let b = if i + 1 < angles.len() { angles[i + 1] } else { angles[0] + tau };
            let p = disc.rim(0.5 * (a + b));
            // Of circles that coincide the first one bounds.
            let inside = |(m, other): (usize, &Disc)| {
                m == n || if disc.is_same(other) { n < m } else { other.contains(p) }
            };
            let within = discs.iter().enumerate().all(inside)
                && strip.is_none_or(|s| (s.range[0]..s.range[1]).contains(&p.dot(s.along)));
            if within && b > a {
                let [from, to] = [a, b].map(DVec2::from_angle);
                let r = disc.radius;
                area += 0.5 * r * (r * (b - a) + disc.centre.perp_dot(to - from));
            }
        }
    }
    if let Some(s) = strip {
        for (k, c) in s.range.into_iter().enumerate() {
            let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
            for disc in discs {
                let gap = c - disc.centre.dot(s.along);
                let middle = disc.centre.dot(s.along.perp());
                let half = ((disc.radius - gap) * (disc.radius + gap)).clamp(0.0, f64::INFINITY).sqrt();
                from = if middle - half > from { middle - half } else { from };
                to = if middle + half < to { middle + half } else { to };
            }
            if to > from {
                area += 0.5 * c * (to - from) * if k == 0 { -1.0 } else { 1.0 };
            }
        }
    }
    area
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    #[test]
    fn known_areas() {
        let disc = |x: f64, radius: f64| Disc { centre: DVec2::new(x, 0.0), radius };
        assert!((common_area(&[disc(7.0, 2.0)], None) - 4.0 * PI).abs() < 1e-13);
        // Two unit circles a unit apart.
        let lens = 2.0 * PI / 3.0 - 0.5 * 3f64.sqrt();
        assert!((common_area(&[disc(0.0, 1.0), disc(1.0, 1.0)], None) - lens).abs() < 1e-14);
        assert!((common_area(&[disc(0.0, 5.0), disc(1.0, 1.0)], None) - PI).abs() < 1e-14);
        assert_eq!(common_area(&[disc(0.0, 1.0), disc(3.0, 1.0)], None), 0.0);
        assert!((common_area(&[disc(2.0, 1.0), disc(2.0, 1.0)], None) - PI).abs() < 1e-14);
        let strip = Strip { along: DVec2::Y, range: [0.0, 9.0] };
        assert!((common_area(&[disc(5.0, 2.0)], Some(&strip)) - 2.0 * PI).abs() < 1e-13);
        let beside = Strip { along: DVec2::Y, range: [3.0, 9.0] };
        assert_eq!(common_area(&[disc(5.0, 2.0)], Some(&beside)), 0.0);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn areas_against_chords(
            x in -3.0..3.0f64, y in -3.0..3.0f64, r in 0.3..4.0f64, turn in 0.0..6.3f64, a in -4.0..3.0f64, w in 0.1..5.0f64,
        ) {
            let discs = [Disc::centred(2.0), Disc { centre: DVec2::new(x, y), radius: r }];
            let along = DVec2::from_angle(turn);
            let found = common_area(&discs, Some(&Strip { along, range: [a, a + w] }));
            // Chords across the strip, at equal steps along it.
            let n = 3000;
            let mut sum = 0.0;
            for i in 0..n {
                let c = a + w * (f64::from(i) + 0.5) / f64::from(n);
                let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
                for d in discs {
                    let h = (d.radius * d.radius - (c - d.centre.dot(along)).powi(2)).max(0.0).sqrt();
                    let m = d.centre.perp_dot(along);
                    low = low.max(-m - h);
                    high = high.min(-m + h);
                }
                sum += (high - low).max(0.0) * w / f64::from(n);
            }
            prop_assert!((found - sum).abs() < 3e-3, "{found} {sum}");
        }
    }
}
