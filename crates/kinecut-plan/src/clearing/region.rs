//! The region in which the cutter's centre may be.

use glam::DVec2;

use crate::base::Result;
use crate::geom::{NearestEdge, Outline, OutlineEdge, offset};

/// The region of the cutter's centre: a face, smaller all around by the cutter's radius and what stays on its wall. Its loops
/// are travelled with the wall on the right: counter-clockwise around it, clockwise around islands.
#[derive(Clone, Debug)]
pub(super) struct CentreRegion {
    pub(super) loops: Vec<WallLoop>,
    near: NearestEdge,
    bounds: [DVec2; 2],
}

/// A loop along the wall.
#[derive(Clone, Debug)]
pub(super) struct WallLoop {
    pub(super) edges: Vec<OutlineEdge>,
    /// The face within it where it is an outer loop; none for one around an island.
    pub(super) around: Option<Outline>,
}

/// Distance beyond the border that is rounding [mm].
const ROUNDING: f64 = 1e-7;

impl CentreRegion {
    /// Of a face at a distance [mm]; `None` where nothing is left of it.
    ///
    /// # Errors
    /// Those of offsets.
    pub(super) fn new(face: &Outline, distance: f64) -> Result<Option<CentreRegion>> {
        let made = offset(face, distance)?;
        let mut loops = Vec::new();
        for one in made.loops.iter().filter(|l| !l.collapsed) {
            let around = (one.area() > 0.0).then(|| Outline::new(vec![one.edges.clone()], Vec::new()));
            let edges = one.edges.iter().rev().map(OutlineEdge::reversed).collect();
            loops.push(WallLoop { edges, around: around.transpose()? });
        }
        if loops.is_empty() {
            return Ok(None);
        }
        let edges: Vec<OutlineEdge> = loops.iter().flat_map(|l| l.edges.iter().copied()).collect();
        let ends = loops.iter().filter_map(|l| l.around.as_ref()).map(Outline::bounds);
        let bounds = ends.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |all, [low, high]| {
            [all[0].min(low), all[1].max(high)]
        });
        Ok(Some(CentreRegion { loops, near: NearestEdge::new(&edges), bounds }))
    }

    /// Area that a cutter of a radius [mm] reaches with its centre in the region [mm2].
    ///
    /// # Errors
    /// Those of offsets.
    pub(super) fn reached(&self, radius: f64) -> Result<f64> {
        let loops = self.loops.iter().map(|l| l.edges.iter().rev().map(OutlineEdge::reversed).collect());
        let outline = Outline::new(loops.collect(), Vec::new())?;
        Ok(offset(&outline, -radius)?.area())
    }

    /// The corners of the box around it.
    pub(super) fn bounds(&self) -> [DVec2; 2] {
        self.bounds
    }

    /// Room from a point to the border, negative outside [mm].
    pub(super) fn room(&self, p: DVec2) -> f64 {
        self.near.at(p, f64::INFINITY).map_or(f64::NEG_INFINITY, |n| n.distance)
    }

    /// The same for a point inside, where it is below a distance; else at least that [mm].
    pub(super) fn room_within(&self, p: DVec2, distance: f64) -> f64 {
        self.near.at(p, distance).map_or(distance, |n| n.distance)
    }

    /// Whether a point is inside, or on the border.
    pub(super) fn holds(&self, p: DVec2) -> bool {
        self.room(p) >= -ROUNDING
    }

    /// The point itself where it is inside, the nearest point of the border where it is outside.
    pub(super) fn nearest_inside(&self, p: DVec2) -> DVec2 {
        match self.near.at(p, f64::INFINITY) {
            Some(n) if n.distance < 0.0 => self.near.edge(n.edge).at(n.share),
            _ => p,
        }
    }

    /// The point with the most room around it inside an outline of a loop, and that room [mm].
    pub(super) fn widest(&self, of: &Outline) -> (DVec2, f64) {
        /// Share of the room that a better point would have to add.
        const WORTH: f64 = 1e-3;
        let [low, high] = of.bounds();
        let size = (high - low).max_element();
        let inside = |p: DVec2| of.contains(p);
        // The middle, unless another place has more room by something.
        let middle = 0.5 * (low + high);
        let mut best = (middle, if inside(middle) { self.room(middle) } else { f64::NEG_INFINITY });
        // Squares by the most room that a point of them may have, the largest first.
        let mut squares = vec![(f64::INFINITY, best.0, size)];
        while let Some(at) = (0..squares.len()).max_by(|&a, &b| squares[a].0.total_cmp(&squares[b].0)) {
            let (most, middle, size) = squares.swap_remove(at);
            if most <= best.1 + WORTH * best.1.abs().max(1e-3) {
                break;
            }
            for (sx, sy) in [(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)] {
                let p = middle + size * DVec2::new(sx, sy);
                let room = self.room(p);
                if room > best.1 + WORTH * best.1.abs().clamp(1e-3, 1e3) && inside(p) {
                    best = (p, room);
                }
                let half = 0.5 * size;
                squares.push((room + half * std::f64::consts::FRAC_1_SQRT_2, p, half));
            }
        }
        best
    }
}
