//! The edge of an outline that is nearest to a point.

use glam::DVec2;

use super::{EdgeBins, OutlineEdge};

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
}

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
        NearestEdge { rounding: 1e-9 * (1.0 + bins.size()), bins, edges: edges.to_vec() }
    }

    /// Distance below which two points may be one [mm].
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// An edge by its index.
    pub fn edge(&self, index: usize) -> &OutlineEdge {
        &self.edges[index]
    }

    /// The nearest edge, if there is one within a distance [mm].
    pub fn at(&self, p: DVec2, within: f64) -> Option<EdgeDistance> {
        let mut best: Option<(f64, EdgeDistance)> = None;
        let limit = |best: &Option<(f64, EdgeDistance)>| {
            best.map_or(within, |(_, found)| found.distance.abs() + self.rounding)
        };
        self.bins.outwards(p, within, &mut |edge| {
            let e = &self.edges[edge];
            let (share, distance) = e.nearest(p);
            if distance > within {
                return limit(&best);
            }
            let out = DVec2::from_angle(e.outward(share));
            let side = out.dot(p - e.at(share));
            // At a corner two edges are as near: the one that sees the point more squarely knows its side.
            let better = best.is_none_or(|(of, old)| {
                let (a, b) = (distance, old.distance.abs());
                a < b - self.rounding || (a <= b + self.rounding && side.abs() > of + self.rounding)
            });
            if better {
                best = Some((side.abs(), EdgeDistance { edge, share, distance: distance.copysign(side) }));
            }
            limit(&best)
        });
        best.map(|(_, found)| found)
    }
}
