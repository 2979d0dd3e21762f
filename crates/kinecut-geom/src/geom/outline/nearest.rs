//! The edge of an outline that is nearest to a point.

use glam::DVec2;

use super::edge::EdgeFoot;
use super::{EdgeBins, Outline, OutlineEdge};

/// Edges of an outline, sorted so that the one nearest to a point is found without a look at all of them.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use glam::dvec2;
/// use kinecut::geom::{NearestEdge, Outline};
/// let corners = [dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(40.0, 30.0), dvec2(0.0, 30.0)];
/// let plate = Outline::polygon(&corners)?;
/// let near = NearestEdge::new(plate.edges());
/// let beside = near.at(dvec2(43.0, 10.0), 5.0).ok_or("farther")?;
/// assert!((beside.distance - 3.0).abs() < 1e-12);
/// let inside = near.at(dvec2(20.0, 1.0), 5.0).ok_or("farther")?;
/// assert!((inside.distance + 1.0).abs() < 1e-12);
/// assert!(near.at(dvec2(20.0, 15.0), 5.0).is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct NearestEdge {
    edges: Vec<OutlineEdge>,
    bins: EdgeBins,
    rounding: f64,
    /// Whether every point is outside.
    of_lines: bool,
}

/// Least sum of curvatures at a tip that has an arc (1/mm).
const TIP: f64 = 1e-9;

/// The nearest edge to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeDistance {
    /// Its index.
    pub edge: usize,
    /// The place, as the share of the edge's length.
    pub share: f64,
    /// Distance [mm]: positive on the left of the edge, outside of the material, negative on its right.
    pub distance: f64,
}

impl NearestEdge {
    /// Of edges in loops, each beginning where the one before it ends.
    pub fn new(edges: &[OutlineEdge]) -> NearestEdge {
        let bins = EdgeBins::new(edges);
        NearestEdge { rounding: 1e-9 * (1.0 + bins.size()), bins, edges: edges.to_vec(), of_lines: false }
    }

    /// Of the edges of an outline; of one that is made of open lines every point is outside.
    pub fn of(outline: &Outline) -> NearestEdge {
        NearestEdge { of_lines: outline.is_of_lines(), ..NearestEdge::new(outline.edges()) }
    }

    /// Distance below which two points may be one [mm].
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// An edge by its index.
    pub fn edge(&self, index: usize) -> &OutlineEdge {
        &self.edges[index]
    }

    /// Whether one of two edges goes on from the other.
    fn is_joined(&self, [a, b]: [usize; 2]) -> bool {
        let (a, b) = (&self.edges[a], &self.edges[b]);
        a.end.distance(b.start) <= self.rounding || b.end.distance(a.start) <= self.rounding
    }

    /// On which side a point beyond a tip is, where one edge ends and the next goes back along it: outside (1) of a tip of the
    /// material, inside (-1) of one that is cut into it; outside where one edge lies on the other, with nothing between them.
    fn beyond_tip(&self, edges: [usize; 2]) -> f64 {
        let apart = edges.map(|edge| self.edges[edge].curvature()).iter().sum::<f64>();
        if apart < -TIP { -1.0 } else { 1.0 }
    }

    /// The nearest edge, if there is one within a distance [mm].
    pub fn at(&self, p: DVec2, within: f64) -> Option<EdgeDistance> {
        let mut best: Option<(usize, EdgeFoot)> = None;
        let limit = |best: &Option<(usize, EdgeFoot)>| {
            best.map_or(within, |(_, found)| found.distance + self.rounding)
        };
        let mut ahead: Option<(usize, f64)> = None;
        self.bins.outwards(p, within, &mut |edge| {
            let foot = self.edges[edge].foot(p);
            if foot.distance > within {
                return limit(&best);
            }
            // At a corner two edges are as near: the one that sees the point more squarely knows its side.
            let better = best.is_none_or(|(known, old)| {
                let (a, b) = (foot.distance, old.distance);
                let more = foot.side.abs() - old.side.abs();
                if a > b + self.rounding || a < b - self.rounding || more.abs() > self.rounding {
                    return a < b - self.rounding || (a <= b + self.rounding && more > self.rounding);
                }
                // At a tip both see it as squarely, from either side, or from straight ahead.
                let is_ahead = foot.side.abs() <= self.rounding;
                let is_tip = (foot.side * old.side < 0.0 || is_ahead) && a > self.rounding && known != edge;
                if !is_tip || !self.is_joined([known, edge]) {
                    return false;
                }
                let side = self.beyond_tip([known, edge]);
                if is_ahead {
                    ahead = Some((known, side));
                }
                !is_ahead && side == foot.side.signum()
            });
            if better {
                best = Some((edge, foot));
            }
            limit(&best)
        });
        best.map(|(edge, foot)| {
            let share = foot.share(&self.edges[edge]);
            let side = match ahead.filter(|&(known, _)| known == edge) {
                _ if self.of_lines => 1.0,
                Some((_, side)) => side,
                None => foot.side,
            };
            EdgeDistance { edge, share, distance: foot.distance.copysign(side) }
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use glam::dvec2;
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(kinecut_cases::property(512))]
        /// The edge found without angles is the one found with them, for lines and for arcs of any sweep.
        #[test]
        fn the_nearest_place_is_that_of_angles(
            x in -20.0..20.0f64, y in -20.0..20.0f64, r in 0.5..12.0f64, from in -4.0..4.0f64, sweep in -TAU..TAU,
        ) {
            let p = dvec2(x, y);
            let line = OutlineEdge::line(dvec2(15.0, 1.0), dvec2(r - 10.0, from));
            for edge in [OutlineEdge::arc(dvec2(1.0, -2.0), r, from, sweep), line] {
                let found = NearestEdge::new(&[edge]).at(p, f64::INFINITY).unwrap();
                let (share, distance) = edge.nearest(p);
                let side = DVec2::from_angle(edge.outward(share)).dot(p - edge.at(share));
                prop_assert!((found.distance.abs() - distance).abs() < 1e-9);
                // From a point at the same distance of both ends either is right.
                let other = edge.at(found.share).distance(p);
                prop_assert!((found.share - share).abs() < 1e-6 || (other - distance).abs() < 1e-9);
                prop_assert!(side.abs() < 1e-9 || (found.share - share).abs() > 1e-6 || (found.distance > 0.0) == (side > 0.0));
            }
        }
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        /// Of many edges the nearest is found, from inside and outside of the box around them, and none beyond the limit.
        #[test]
        fn the_nearest_of_many_edges_is_that_of_all(
            seed in 0..1000_u32, count in 3..80_u32, x in -40.0..40.0f64, y in -40.0..40.0f64, within in 0.1..60.0f64,
        ) {
            let corner = |k: u32| {
                let share = |of: f64| (f64::from(seed) * 0.37 + f64::from(k % count) * of).fract() - 0.5;
                dvec2(40.0 * share(0.754_877_666), 24.0 * share(0.569_840_291))
            };
            let edges: Vec<_> = (0..count).map(|k| OutlineEdge::line(corner(k), corner(k + 1))).collect();
            let p = dvec2(x, y);
            let least = edges.iter().map(|e| e.nearest(p).1).fold(f64::INFINITY, f64::min);
            let near = NearestEdge::new(&edges);
            let found = near.at(p, f64::INFINITY).unwrap();
            prop_assert!((found.distance.abs() - least).abs() < 1e-9);
            match near.at(p, within) {
                Some(found) => prop_assert!((found.distance.abs() - least).abs() < 1e-9 && least < within + 1e-9),
                None => prop_assert!(least > within - 1e-9),
            }
        }
    }
}
