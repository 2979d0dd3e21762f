//! Stock that an earlier, larger cutter has left of the same face: corners, and places into which it does not go.
//!
//! A cutter reaches the region of its centre, grown by its radius. A place is left by the larger cutter where the smaller one
//! reaches and it does not. The places are found along the borders of both reaches, exactly; each has a window around it, and within the
//! windows all counts as stock that the larger cutter has not cleared with some overlap. Nothing else is stock.

use std::collections::{BTreeMap, VecDeque};
use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use super::level::box_of;
use super::region::CentreRegion;
use super::spec::EarlierCutter;
use super::swept::{Clearing, Scratch};
use super::walk::point_on_grid;
use crate::base::Result;
use crate::geom::{OffsetLoop, Outline, OutlineEdge, convex_hull};
use crate::num::angle::wrap;

/// Free space around what is left that passes sweep too: in radii of the cutter, and at least [mm].
const OVERLAP: (f64, f64) = (0.1, 0.2);
/// Distance between looks along a border and along the wall, in radii of the cutter.
const STEP: f64 = 0.05;
/// Steps within which two places of borders belong to one place that is left.
const JOINED: f64 = 3.0;
/// Thickness of what is left that is nothing [mm].
const NOTHING: f64 = 1e-3;
/// Rounding of a place on a border [mm].
const ROUNDING: f64 = 1e-6;
/// Engagement along the wall below which a place is left to the lap along it [rad].
const TO_LAP: f64 = 10.0 / 180.0 * std::f64::consts::PI;
/// Directions in which a window is wider than its place.
const AROUND: u32 = 16;

/// Stock that an earlier cutter has left.
#[derive(Clone, Debug)]
pub(super) struct LeftStock {
    /// Outlines of the stock: it is what all of them hold.
    pub(super) stock: Vec<Outline>,
    /// Number of places that passes clear.
    pub(super) places: usize,
    /// Number of places that are left to the lap along the wall.
    pub(super) to_lap: usize,
}

/// A place that is left.
#[derive(Clone, Debug)]
struct Place {
    /// Points of its border.
    points: Vec<DVec2>,
    /// Its window: a convex polygon, counter-clockwise.
    window: Vec<DVec2>,
}

/// Two cutters in one face.
struct Cutters<'a> {
    earlier: &'a CentreRegion,
    /// Radius up to which the earlier one cuts at the floor [mm].
    reach: f64,
    region: &'a CentreRegion,
    radius: f64,
    overlap: f64,
}

impl LeftStock {
    /// Of a face, cleared by an earlier cutter, for a cutter of a radius [mm] with a region; `free`: the area with the job's stock, nothing
    /// swept yet.
    ///
    /// # Errors
    /// Those of offsets.
    pub(super) fn new(
        face: &Outline,
        cutter: &EarlierCutter,
        (region, radius): (&CentreRegion, f64),
        free: &Clearing,
    ) -> Result<LeftStock> {
        let Some(earlier) = CentreRegion::new(face, cutter.radius + cutter.allowance)? else {
            // It has gone nowhere.
            return Ok(LeftStock { stock: Vec::new(), places: 1, to_lap: 0 });
        };
        let (share, least) = OVERLAP;
        let overlap = (share * radius).max(least);
        let reach = cutter.radius - cutter.corner;
        let cutters = Cutters { earlier: &earlier, reach, region, radius, overlap };
        let mut places = cutters.places();
        let beyond = box_of(&face.bounds(), 10.0 * cutter.radius);
        let windows = |places: &[Place]| {
            Outline::polygons(&places.iter().map(|p| p.window.clone()).collect::<Vec<_>>())
        };
        let uncut =
            |less: f64| -> Result<Outline> { Ok(around(&earlier.grown((reach - less).max(0.0))?, beyond)) };
        let all = places.len();
        if all > 0 {
            let exact = free.clone().with_stock(&uncut(0.0)?).with_stock(&windows(&places)?);
            let thick = cutters.thick(&places, &exact);
            let mut keep = thick.into_iter();
            places.retain(|_| keep.next() == Some(true));
        }
        let stock = match places.is_empty() {
            true => Vec::new(),
            false => vec![uncut(overlap)?, windows(&places)?],
        };
        Ok(LeftStock { stock, places: places.len(), to_lap: all - places.len() })
    }
}

/// All around loops of a face, within a box.
fn around(loops: &[OffsetLoop], [low, high]: [DVec2; 2]) -> Outline {
    let corners = [low, DVec2::new(low.x, high.y), high, DVec2::new(high.x, low.y)];
    let edges = (0..4).map(|k| OutlineEdge::line(corners[k], corners[(k + 1) % 4])).collect();
    let turned = loops.iter().filter(|l| !l.collapsed).map(|l| OffsetLoop {
        edges: l.edges.iter().rev().map(OutlineEdge::reversed).collect(),
        collapsed: false,
    });
    let all: Vec<OffsetLoop> =
        std::iter::once(OffsetLoop { edges, collapsed: false }).chain(turned).collect();
    Outline::of_offset(&all)
}

/// Points a step [mm] apart on the border of what a cutter reaches with its centre in a region; some may lie within.
fn border(region: &CentreRegion, radius: f64, step: f64) -> Vec<DVec2> {
    let mut points = Vec::new();
    for of in &region.loops {
        for (i, edge) in of.edges.iter().enumerate() {
            let turn = edge.turn.map_or(0.0, |t| t.sweep.abs());
            let count = ((edge.length() + turn * radius) / step).ceil().max(1.0);
            // The wall is on the right.
            points.extend((0..=count as usize).map(|k| {
                let share = k as f64 / count;
                edge.at(share) + radius * DVec2::from_angle(edge.heading(share) - FRAC_PI_2)
            }));
            let next = &of.edges[(i + 1) % of.edges.len()];
            let from = edge.heading(1.0);
            let turn = wrap(next.heading(0.0) - from);
            if turn > 0.0 {
                let count = (turn * radius / step).ceil().max(1.0);
                points.extend((1..count as usize).map(|k| {
                    edge.end + radius * DVec2::from_angle(from - FRAC_PI_2 + turn * k as f64 / count)
                }));
            }
        }
    }
    points
}

impl Cutters<'_> {
    fn step(&self) -> f64 {
        STEP * self.radius
    }

    /// The places that are left, no two windows of which meet.
    fn places(&self) -> Vec<Place> {
        let step = self.step();
        let beyond_earlier = |p: DVec2| -self.earlier.room(p) - self.reach;
        let within = |p: DVec2| self.region.room(p) + self.radius;
        let earlier = border(self.earlier, self.reach, step);
        let own = border(self.region, self.radius, step);
        let points: Vec<DVec2> = earlier
            .into_iter()
            .filter(|p| beyond_earlier(*p) > -ROUNDING && within(*p) > NOTHING)
            .chain(own.into_iter().filter(|p| within(*p) < ROUNDING && beyond_earlier(*p) > NOTHING))
            .collect();
        let mut places: Vec<Place> =
            joined(points, JOINED * step).into_iter().map(|points| self.place(points)).collect();
        // Places whose windows meet are one.
        let mut i = 0;
        while i < places.len() {
            match (i + 1..places.len()).find(|j| !are_apart(&places[i].window, &places[*j].window)) {
                Some(j) => {
                    let other = places.remove(j);
                    let points = places[i].points.drain(..).chain(other.points).collect();
                    places[i] = self.place(points);
                    // The larger window may meet those before.
                    i = 0;
                }
                None => i += 1,
            }
        }
        places
    }

    fn place(&self, points: Vec<DVec2>) -> Place {
        let wider = (self.overlap + self.step()) / (0.5 * TAU / f64::from(AROUND)).cos();
        let ring = |p: &DVec2| {
            let p = *p;
            (0..AROUND).map(move |k| {
                // On a grid no two corners are nearly one.
                point_on_grid(p + wider * DVec2::from_angle(f64::from(k) * TAU / f64::from(AROUND)))
            })
        };
        let inner = convex_hull(points.clone());
        Place { window: convex_hull(inner.iter().flat_map(ring).collect()), points }
    }

    /// For each place whether a pass clears it: where the lap along the wall alone would cut there with more than a little, or
    /// not reach all of it.
    fn thick(&self, places: &[Place], left: &Clearing) -> Vec<bool> {
        let mut thick: Vec<bool> = places
            .iter()
            .map(|place| place.points.iter().any(|p| self.region.room(*p) > self.radius))
            .collect();
        let mut work = Scratch::default();
        for edge in self.region.loops.iter().flat_map(|l| &l.edges) {
            let count = (edge.length() / self.step()).ceil().max(1.0);
            for k in 0..=count as usize {
                let share = k as f64 / count;
                let at = edge.at(share);
                let near = |place: &Place| distance(&place.window, at) <= self.radius;
                if !places.iter().zip(&thick).any(|(place, thick)| !thick && near(place)) {
                    continue;
                }
                if left.engaged(at, edge.heading(share), self.radius, &mut work).total >= TO_LAP {
                    for (place, thick) in places.iter().zip(&mut thick) {
                        *thick |= near(place);
                    }
                }
            }
        }
        thick
    }
}

/// Points in groups: those of one are joined by steps no longer than a distance [mm].
fn joined(points: Vec<DVec2>, distance: f64) -> Vec<Vec<DVec2>> {
    let cell = |p: DVec2| (p / distance).floor().to_array().map(|x| x as i64);
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for (i, p) in points.iter().enumerate() {
        cells.entry(cell(*p)).or_default().push(i);
    }
    let mut groups = Vec::new();
    let mut known = vec![false; points.len()];
    for first in 0..points.len() {
        if known[first] {
            continue;
        }
        known[first] = true;
        let (mut group, mut next) = (Vec::new(), VecDeque::from([first]));
        while let Some(i) = next.pop_front() {
            group.push(points[i]);
            let [x, y] = cell(points[i]);
            for beside in (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y])) {
                for &j in cells.get(&beside).into_iter().flatten() {
                    if !known[j] && points[j].distance(points[i]) <= distance {
                        known[j] = true;
                        next.push_back(j);
                    }
                }
            }
        }
        groups.push(group);
    }
    groups
}

/// The sides of a polygon.
fn sides(polygon: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> + '_ {
    (0..polygon.len()).map(|i| [polygon[i], polygon[(i + 1) % polygon.len()]])
}

/// Whether two convex polygons, counter-clockwise, have no common point: a side of one has all of the other beyond it.
fn are_apart(a: &[DVec2], b: &[DVec2]) -> bool {
    let beyond = |of: &[DVec2], other: &[DVec2]| {
        sides(of).any(|[from, to]| other.iter().all(|p| (to - from).perp_dot(*p - from) < 0.0))
    };
    beyond(a, b) || beyond(b, a)
}

/// Distance of a point from a convex polygon, counter-clockwise; 0 inside [mm].
fn distance(polygon: &[DVec2], p: DVec2) -> f64 {
    if sides(polygon).all(|[from, to]| (to - from).perp_dot(p - from) >= 0.0) {
        return 0.0;
    }
    sides(polygon).map(|[from, to]| OutlineEdge::line(from, to).nearest(p).1).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;

    fn rectangle(x: f64, y: f64) -> Outline {
        Outline::polygon(&[dvec2(0.0, 0.0), dvec2(x, 0.0), dvec2(x, y), dvec2(0.0, y)]).unwrap()
    }

    /// The stock that a cutter of a radius leaves of a face to one of another.
    fn left(face: &Outline, earlier: f64, allowance: f64, radius: f64) -> LeftStock {
        let region = CentreRegion::new(face, radius + 0.02).unwrap().unwrap();
        let cutter = EarlierCutter { radius: earlier, corner: 0.0, allowance };
        let free = Clearing::new(region.bounds(), radius);
        LeftStock::new(face, &cutter, (&region, radius), &free).unwrap()
    }

    #[test]
    fn all_that_is_left_is_stock_with_its_overlap_and_the_middle_is_not() {
        let face = rectangle(60.0, 40.0);
        let found = left(&face, 8.0, 0.0, 3.0);
        assert_eq!((found.places, found.to_lap, found.stock.len()), (4, 0, 2));
        let is_stock = |p: DVec2| found.stock.iter().all(|s| s.contains(p));
        // By closed forms: the corner at the origin beyond the fillets of both cutters.
        let (mut inside, mut outside) = (0, 0);
        for i in 0..400 {
            for j in 0..400 {
                let p = dvec2(0.05 * f64::from(i) + 0.021, 0.05 * f64::from(j) + 0.021);
                let beyond = |radius: f64, inset: f64| {
                    let c = dvec2(radius + inset, radius + inset);
                    p.x < inset || p.y < inset || p.x < c.x && p.y < c.y && p.distance(c) > radius
                };
                let is_left = beyond(8.0, 0.0) && !beyond(3.0, 0.02);
                let overlapped = beyond(7.7, 0.0) || p.distance(dvec2(8.0, 8.0)) > 7.7;
                if is_left {
                    inside += 1;
                    assert!(is_stock(p), "{p}");
                } else if !overlapped && p.x > 0.4 && p.y > 0.4 {
                    outside += 1;
                    assert!(!is_stock(p), "{p}");
                }
            }
        }
        assert!(inside > 1000 && outside > 10_000, "{inside} {outside}");
        // Along the walls, off the corners, nothing is left.
        assert!(!is_stock(dvec2(30.0, 0.1)) && !is_stock(dvec2(0.1, 20.0)));
    }

    #[test]
    fn little_is_left_to_the_lap_and_a_place_without_the_earlier_cutter_is_all_stock() {
        // A disc with 0.03 mm between what both reach; without a difference, nothing.
        let disc = vec![vec![OutlineEdge::arc(DVec2::ZERO, 25.0, 0.0, TAU)]];
        let disc = Outline::new(disc, Vec::new()).unwrap();
        let found = left(&disc, 8.0, 0.05, 3.0);
        assert_eq!((found.places, found.to_lap), (0, 1));
        assert!(found.stock.is_empty());
        let found = left(&disc, 8.0, 0.0, 3.0);
        assert_eq!((found.places, found.to_lap), (0, 0));
        let face = rectangle(60.0, 40.0);
        // Beside a wall on which the earlier one has left more: all around.
        let found = left(&face, 8.0, 1.0, 3.0);
        assert_eq!(found.places, 1);
        assert!(found.stock.iter().all(|s| s.contains(dvec2(30.0, 0.9))));
        assert!(!found.stock.iter().all(|s| s.contains(dvec2(30.0, 1.5))));
        let found = left(&rectangle(60.0, 12.0), 8.0, 0.0, 3.0);
        assert!(found.places == 1 && found.stock.is_empty());
    }
}
