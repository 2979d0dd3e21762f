//! The region in which the cutter's centre may be.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec2;

use super::far::{Far, Side};
use crate::base::Result;
use crate::geom::{NearestEdge, OffsetLoop, Outline, OutlineEdge, offset};

/// The region of the cutter's centre: a face, smaller all around by the cutter's radius and what stays on its wall. Its loops
/// are travelled with the wall on the right: counter-clockwise around it, clockwise around islands.
#[derive(Clone, Debug)]
pub(super) struct CentreRegion {
    pub(super) loops: Vec<WallLoop>,
    face: Outline,
    near: NearestEdge,
    bounds: [DVec2; 2],
    far: Option<Far>,
}

/// A loop along the wall.
#[derive(Clone, Debug)]
pub(super) struct WallLoop {
    pub(super) edges: Vec<OutlineEdge>,
    /// The face within it, less its islands, where it is an outer loop; none for one around an island.
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
        let kept: Vec<&OffsetLoop> = made.loops.iter().filter(|l| !l.collapsed).collect();
        let parts = parts(&kept);
        for (i, one) in kept.iter().enumerate() {
            let islands = parts.iter().filter(|(_, of)| *of == i).map(|(island, _)| kept[*island]);
            let face = || Outline::of_offset(std::iter::once(*one).chain(islands));
            let around = (one.area() > 0.0).then(face);
            let edges = one.edges.iter().rev().map(OutlineEdge::reversed).collect();
            loops.push(WallLoop { edges, around });
        }
        if loops.is_empty() {
            return Ok(None);
        }
        let edges: Vec<OutlineEdge> = loops.iter().flat_map(|l| l.edges.iter().copied()).collect();
        let ends = loops.iter().filter_map(|l| l.around.as_ref()).map(Outline::bounds);
        let bounds = ends.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |all, [low, high]| {
            [all[0].min(low), all[1].max(high)]
        });
        let face = Outline::of_offset(kept);
        Ok(Some(CentreRegion { loops, face, near: NearestEdge::new(&edges), bounds, far: None }))
    }

    /// With cells in which the places farther than a distance [mm] from its border are known: looks within it are quick.
    #[must_use]
    pub(super) fn with_far(mut self, distance: f64) -> CentreRegion {
        let room = |p: DVec2, most: f64| self.near.at(p, most).map_or(most, |n| n.distance);
        self.far = Some(Far::new(self.bounds, distance, room));
        self
    }

    /// Area that a cutter of a radius [mm] reaches with its centre in the region [mm2]; where the region has crumbs that no offset
    /// can be made of, by points.
    pub(super) fn reached(&self, radius: f64) -> f64 {
        /// Points along the radius.
        const FINE: f64 = 24.0;
        if let Ok(grown) = offset(&self.face, -radius) {
            return grown.area();
        }
        let step = radius / FINE;
        let [low, high] = [self.bounds[0] - radius, self.bounds[1] + radius];
        let count = |length: f64| (length / step).ceil() as usize;
        let point = |i: usize, j: usize| low + step * DVec2::new(i as f64 + 0.5, j as f64 + 0.5);
        let inside = |i: usize| {
            (0..count(high.y - low.y)).filter(|j| self.room_within(point(i, *j), radius) > -radius).count()
        };
        (0..count(high.x - low.x)).map(inside).sum::<usize>() as f64 * step * step
    }

    /// The loops of the region, larger all around by a distance [mm].
    ///
    /// # Errors
    /// Those of offsets.
    pub(super) fn grown(&self, distance: f64) -> Result<Vec<OffsetLoop>> {
        Ok(offset(&self.face, -distance)?.loops)
    }

    /// The corners of the box around it.
    pub(super) fn bounds(&self) -> [DVec2; 2] {
        self.bounds
    }

    /// Room from a point to the border, negative outside [mm].
    pub(super) fn room(&self, p: DVec2) -> f64 {
        self.near.at(p, f64::INFINITY).map_or(f64::NEG_INFINITY, |n| n.distance)
    }

    /// The same where the border is nearer than a distance, else that distance, negative outside [mm].
    pub(super) fn room_within(&self, p: DVec2, distance: f64) -> f64 {
        let Some(far) = self.far.as_ref().filter(|far| distance <= far.reach()) else {
            return self.room(p).clamp(-distance, distance);
        };
        let side = far.side(p);
        let found = match side {
            Side::FarInside => return distance,
            Side::FarOutside => return -distance,
            // With no border between a point and the middle of its cell, both lie on one side.
            Side::Inside | Side::Outside => self.near.at(p, distance.max(far.around())),
        };
        match found {
            Some(n) => n.distance.clamp(-distance, distance),
            None if side == Side::Inside => distance,
            None => -distance,
        }
    }

    /// Whether a point is inside, or on the border.
    pub(super) fn holds(&self, p: DVec2) -> bool {
        self.room_within(p, 2.0 * ROUNDING) >= -ROUNDING
    }

    /// The point itself where it is inside, the nearest point of the border where it is outside.
    pub(super) fn nearest_inside(&self, p: DVec2) -> DVec2 {
        match self.near.at(p, f64::INFINITY) {
            Some(n) if n.distance < 0.0 => self.near.edge(n.edge).at(n.share),
            _ => p,
        }
    }

    /// The point with the most room around it inside a part of the region, and that room [mm].
    pub(super) fn widest(of: &Outline) -> (DVec2, f64) {
        /// Share of the room that a better point would have to add.
        const WORTH: f64 = 1e-3;
        let [low, high] = of.bounds();
        let size = (high - low).max_element();
        // Another part in one of its islands is no room of this one.
        let near = NearestEdge::new(of.edges());
        let room = |p: DVec2| near.at(p, f64::INFINITY).map_or(f64::NEG_INFINITY, |n| -n.distance);
        // The middle, unless another place has more room by something.
        let middle = 0.5 * (low + high);
        let mut best = (middle, room(middle));
        let mut squares = BinaryHeap::from([Square { most: f64::INFINITY, order: 0, middle: best.0, size }]);
        let mut order = 0;
        while let Some(Square { most, middle, size, .. }) = squares.pop() {
            if most <= best.1 + WORTH * best.1.abs().max(1e-3) {
                break;
            }
            for (sx, sy) in [(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)] {
                let p = middle + size * DVec2::new(sx, sy);
                let room = room(p);
                if room > best.1 + WORTH * best.1.abs().clamp(1e-3, 1e3) {
                    best = (p, room);
                }
                let half = 0.5 * size;
                order += 1;
                let most = room + half * std::f64::consts::FRAC_1_SQRT_2;
                squares.push(Square { most, order, middle: p, size: half });
            }
        }
        best
    }
}

/// A square by the most room that a point of it may have; of equal ones the first that was made comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Square {
    most: f64,
    order: usize,
    middle: DVec2,
    size: f64,
}

impl Eq for Square {}

impl Ord for Square {
    fn cmp(&self, other: &Square) -> Ordering {
        self.most.total_cmp(&other.most).then(other.order.cmp(&self.order))
    }
}

impl PartialOrd for Square {
    fn partial_cmp(&self, other: &Square) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The islands among loops, each with the outer loop that is next around it.
fn parts(loops: &[&OffsetLoop]) -> Vec<(usize, usize)> {
    let mut outer = Vec::new();
    for (i, one) in loops.iter().enumerate().filter(|(_, one)| one.area() > 0.0) {
        outer.push((i, one.area(), Outline::of_offset([*one])));
    }
    outer.sort_by(|a, b| a.1.total_cmp(&b.1));
    let islands = loops.iter().enumerate().filter(|(_, one)| one.area() <= 0.0);
    let within = |(i, one): (usize, &&OffsetLoop)| {
        let of = outer
            .iter()
            .find(|(_, area, face)| *area > -one.area() && face.contains(one.edges[0].at(0.5)))?;
        Some((i, of.0))
    };
    islands.filter_map(within).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use glam::dvec2;

    use super::*;
    use crate::num::random::Random;

    fn plate() -> Outline {
        let corners =
            [dvec2(0.0, 0.0), dvec2(90.0, 0.0), dvec2(70.0, 40.0), dvec2(30.0, 25.0), dvec2(-10.0, 50.0)];
        let edges = Outline::polygon(&corners).unwrap().edges().to_vec();
        let islands = [dvec2(20.0, 9.0), dvec2(62.0, 20.0)].map(|p| vec![OutlineEdge::arc(p, 4.0, 0.0, TAU)]);
        Outline::new(std::iter::once(edges).chain(islands).collect(), Vec::new()).unwrap()
    }

    #[test]
    fn looks_with_cells_are_those_without() {
        let mut random = Random(2);
        for radius in [0.7, 2.0, 3.5] {
            let plain = CentreRegion::new(&plate(), radius).unwrap().unwrap();
            let region = plain.clone().with_far(radius);
            for round in 0..20_000 {
                let p = dvec2(-25.0, -15.0) + dvec2(130.0 * random.share(), 80.0 * random.share());
                // Every fourth one beside the border.
                let near = plain.near.at(p, f64::INFINITY).unwrap();
                let at = plain.near.edge(near.edge).at(near.share);
                let p = if round % 4 == 0 { at + 1e-5 * (p - at) } else { p };
                let most = radius * if round % 3 == 0 { random.share() } else { 1.0 };
                let exact = plain.room(p);
                assert!(
                    (region.room_within(p, most) - exact.clamp(-most, most)).abs() < 1e-12,
                    "{round}: {p}"
                );
                assert_eq!(region.holds(p), exact >= -ROUNDING, "{round}: {p}");
            }
        }
    }

    #[test]
    fn the_widest_place_has_the_most_room_of_all() {
        let region = CentreRegion::new(&plate(), 2.0).unwrap().unwrap();
        for one in region.loops.iter().filter_map(|l| l.around.as_ref()) {
            let (at, room) = CentreRegion::widest(one);
            assert!((region.room(at) - room).abs() < 1e-9);
            let [low, high] = one.bounds();
            let look = |k: u32| low + (high - low) * dvec2(f64::from(k % 200), f64::from(k / 200)) / 200.0;
            let most = (0..40_000)
                .map(look)
                .filter(|p| one.contains(*p))
                .map(|p| region.room(p))
                .fold(0.0, f64::max);
            assert!(room > 0.998 * most, "{room} {most}");
        }
    }
}
