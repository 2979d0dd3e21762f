//! Contact of an edge with one triangle, exactly: every place is looked at where the height of the triangle less the
//! height of the edge can be extreme.
//!
//! Over a ring of the annulus (a segment of the edge) and a triangle with the gradient g these are: corners; the axis;
//! on the circles that bound the ring, and on those at which an arc is as steep as the triangle, the points along g;
//! on each side its foot, its crossings with the circles, and where the edge is as steep along it as the side. An extra
//! candidate does no harm.
//!
//! Notation for a side: t length along it from its foot, d distance of the foot from the axis, m its slope. Line of
//! slope k: stationary at t = d m / sqrt(k^2 - m^2), either sign. Arc of radius rho about (rc, zc): m r sqrt(rho^2 -
//! (r - rc)^2) = (r - rc) t, squared a polynomial of degree 4 in r.

use glam::DVec2;

use crate::geom::{EdgeProfile, EdgeSegment};
use crate::num::polynomial::quartic_roots;

/// A place of an edge on a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// Height of the surface less height of the edge [mm].
    pub(super) z: f64,
    /// Distance from the axis [mm].
    pub(super) radius: f64,
    /// Place across the axis [mm].
    pub(super) at: DVec2,
    /// Height of the surface [mm].
    pub(super) height: f64,
}

/// A triangle seen along the feed, counter-clockwise, not upright.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    /// Corners across the axis [mm].
    corners: [DVec2; 3],
    /// Heights of the corners [mm].
    heights: [f64; 3],
    /// Rise of the plane per length.
    gradient: DVec2,
}

/// A side of a facet.
struct Side {
    along: DVec2,
    foot: DVec2,
    distance: f64,
    from: f64,
    to: f64,
    height: f64,
    slope: f64,
}

impl Facet {
    /// A facet of corners that have an area.
    pub(super) fn new(corners: [DVec2; 3], heights: [f64; 3]) -> Facet {
        let (p, q) = (corners[1] - corners[0], corners[2] - corners[0]);
        let (h, k) = (heights[1] - heights[0], heights[2] - heights[0]);
        let gradient = DVec2::new(h * q.y - k * p.y, k * p.x - h * q.x) / p.perp_dot(q);
        Facet { corners, heights, gradient }
    }

    fn height(&self, p: DVec2) -> f64 {
        self.heights[0] + self.gradient.dot(p - self.corners[0])
    }

    fn contains(&self, p: DVec2) -> bool {
        let c = &self.corners;
        (0..3).all(|i| (c[(i + 1) % 3] - c[i]).perp_dot(p - c[i]) >= 0.0)
    }

    fn sides(&self) -> [Option<Side>; 3] {
        [0, 1, 2].map(|i| {
            let j = (i + 1) % 3;
            let (a, b) = (self.corners[i], self.corners[j]);
            let length = (b - a).length();
            let along = (b - a).try_normalize()?;
            let from = a.dot(along);
            let foot = a - along * from;
            Some(Side {
                along,
                foot,
                distance: foot.length(),
                from,
                to: from + length,
                height: self.heights[i],
                slope: (self.heights[j] - self.heights[i]) / length,
            })
        })
    }

    /// Calls `note` at every place where the edge can be nearest to the facet or farthest from it.
    pub(super) fn candidates(&self, edge: &EdgeProfile, mut note: impl FnMut(Touch)) {
        let sides = self.sides();
        let axis_inside = self.contains(DVec2::ZERO);
        let radii = self.corners.map(DVec2::length);
        let farthest = radii.iter().fold(0.0, |a: f64, &r| if r > a { r } else { a });
        let nearest = sides.iter().flatten().fold(f64::INFINITY, |a, s| {
            let t = 0f64.clamp(s.from, s.to);
            let r = s.distance.hypot(t);
            if r < a { r } else { a }
        });
        let nearest = if axis_inside { 0.0 } else { nearest };
        for segment in edge.segments() {
            let [a, b] = segment.range();
            if nearest > b || farthest < a {
                continue;
            }
            let mut at = |radius: f64, p: DVec2, height: f64| {
                if radius >= a && radius <= b {
                    note(Touch { z: height - segment.height(radius), radius, at: p, height });
                }
            };
            for i in 0..3 {
                at(radii[i], self.corners[i], self.heights[i]);
            }
            if axis_inside {
                at(0.0, DVec2::ZERO, self.height(DVec2::ZERO));
            }
            let steep = self.gradient.length();
            let uphill = self.gradient.try_normalize().unwrap_or(DVec2::X);
            let mut circles = [a, b, f64::NAN, f64::NAN, f64::NAN];
            if let EdgeSegment::Arc { centre, radius, .. } = *segment {
                let s = radius * steep / steep.hypot(1.0);
                circles = [a, b, centre[0], centre[0] + s, centre[0] - s];
            }
            for c in circles {
                // Also a circle that does not exist, of no number, goes here.
                if !(c > 0.0 && c >= nearest && c <= farthest) {
                    continue;
                }
                for p in [uphill * c, uphill * -c] {
                    if self.contains(p) {
                        at(c, p, self.height(p));
                    }
                }
            }
            for side in sides.iter().flatten() {
                let d = side.distance;
                let mut on = |t: f64, radius: f64| {
                    if t >= side.from && t <= side.to {
                        let height = side.height + side.slope * (t - side.from);
                        at(radius, side.foot + side.along * t, height);
                    }
                };
                on(0.0, d);
                for c in circles {
                    if c >= d {
                        let t = ((c - d) * (c + d)).sqrt();
                        on(t, c);
                        on(-t, c);
                    }
                }
                let m = side.slope;
                match *segment {
                    EdgeSegment::Line { .. } => {
                        let k = segment.slope(a);
                        let s = (k - m) * (k + m);
                        if s > 0.0 {
                            let t = d * m / s.sqrt();
                            on(t, d.hypot(t));
                            on(-t, d.hypot(t));
                        }
                    }
                    EdgeSegment::Arc { centre: [rc, _], radius: rho, .. } => {
                        let (q, n) = (1.0 + m * m, m * rho);
                        let polynomial = [
                            -rc * rc * d * d,
                            2.0 * rc * d * d,
                            rc * rc * q - d * d - n * n,
                            -2.0 * rc * q,
                            q,
                        ];
                        let from = if d > a { d } else { a };
                        for r in quartic_roots(polynomial, from, b) {
                            let t = ((r - d) * (r + d)).clamp(0.0, f64::INFINITY).sqrt();
                            on(t, r);
                            on(-t, r);
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn edge(kind: u8) -> EdgeProfile {
        let line = |r: [f64; 2], z: [f64; 2]| EdgeSegment::Line { r, z };
        match kind {
            0 => EdgeProfile::polyline(&[[0.0, 0.0], [5.0, 3.0]]),
            1 => EdgeProfile::polyline(&[[0.0, 1.0], [2.0, 0.0], [5.0, 1.8]]),
            2 => EdgeProfile::polyline(&[[2.0, 0.0], [2.5, 0.0], [2.5, 0.4], [5.0, 0.9]]),
            3 => EdgeProfile::new(&[EdgeSegment::Arc { r: [0.0, 5.0], centre: [0.0, 7.0], radius: 7.0 }]),
            4 => EdgeProfile::new(&[
                line([0.0, 2.0], [0.0, 1.5]),
                EdgeSegment::Arc { r: [2.0, 5.0], centre: [2.6, 3.0], radius: 2.6 },
            ]),
            _ => EdgeProfile::new(&[EdgeSegment::Arc { r: [0.5, 5.0], centre: [3.0, 3.0], radius: 3.0 }]),
        }
        .unwrap()
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(400))]
        /// Points of a dense grid over the triangle never lie beyond the candidates, and come near to them.
        #[test]
        fn no_place_of_a_triangle_is_beyond_its_candidates(
            kind in 0u8..6,
            p in prop::array::uniform6(-6.0..6.0f64),
            heights in prop::array::uniform3(-3.0..3.0f64),
        ) {
            let mut corners = [DVec2::new(p[0], p[1]), DVec2::new(p[2], p[3]), DVec2::new(p[4], p[5])];
            let area = (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]);
            prop_assume!(area.abs() > 0.5);
            if area < 0.0 {
                corners.swap(1, 2);
            }
            let edge = edge(kind);
            let facet = Facet::new(corners, heights);
            let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
            facet.candidates(&edge, |touch| {
                least = least.min(touch.z);
                greatest = greatest.max(touch.z);
            });
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            let n = 120;
            for i in 0..=n {
                for j in 0..=n - i {
                    let [u, v] = [i, j].map(|k| f64::from(k) / f64::from(n));
                    let w = 1.0 - u - v;
                    let q = corners[0] * w + corners[1] * u + corners[2] * v;
                    let h = heights[0] * w + heights[1] * u + heights[2] * v;
                    for s in edge.segments() {
                        let [a, b] = s.range();
                        if q.length() >= a && q.length() <= b {
                            low = low.min(h - s.height(q.length()));
                            high = high.max(h - s.height(q.length()));
                        }
                    }
                }
            }
            prop_assert!(low >= least - 1e-9 && high <= greatest + 1e-9, "{low} {least} {high} {greatest}");
            // A triangle that only grazes the annulus need not have a point of the grid in it.
            if low.is_finite() && area.abs() > 4.0 {
                let steep = facet.gradient.length() + 8.0;
                prop_assert!(low - least < steep * 0.3 && greatest - high < steep * 0.3);
            }
        }
    }
}
