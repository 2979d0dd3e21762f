//! The line in the middle of a part of the region, where two walls are equally near: a ramp goes down along it.
//!
//! The line is followed step by step: on a small circle about one of its points the room is largest where the line goes on.
//! The result is a tree of points; a piece of the line is a chain of it that turns little from step to step.

use std::collections::{BTreeMap, VecDeque};
use std::f64::consts::TAU;

use glam::DVec2;

use super::region::CentreRegion;
use super::walk::point_on_grid;
use crate::geom::{NearestEdge, Outline};
use crate::num::angle::wrap;

/// Directions that are looked at around a point before the best ones are refined.
const LOOKS: usize = 64;
/// Thirds by which a direction is refined.
const REFINED: u32 = 48;
/// Distance below which a point is one that is known, in steps: half a step is the most between two points of a line.
const KNOWN: f64 = 0.7;
/// Largest turn from step to step within a piece [rad].
const TURN: f64 = 20.0 / 180.0 * std::f64::consts::PI;
/// Least room at a point, in steps.
const LEAST_ROOM: f64 = 0.1;
/// Most points that are followed.
const MOST: usize = 20_000;
/// Share of the most room by which a place counts as equally wide.
const EQUAL: f64 = 1e-3;

/// Points of the line and which of them are joined.
#[derive(Debug)]
struct Tree<'a> {
    near: &'a NearestEdge,
    step: f64,
    points: Vec<DVec2>,
    joined: Vec<[usize; 2]>,
    cells: BTreeMap<[i64; 2], Vec<usize>>,
}

/// The longest piece of the line in the middle of a part of a region, by its points a step [mm] apart, no farther from the
/// widest place than `reach` along the line [mm]; its first end lies left of or below the other. One point where there is no line.
pub(super) fn longest_piece(of: &Outline, step: f64, reach: f64) -> Vec<DVec2> {
    let near = NearestEdge::new(of.edges());
    let (widest, _) = CentreRegion::widest(of);
    let mut tree = Tree { near: &near, step, points: Vec::new(), joined: Vec::new(), cells: BTreeMap::new() };
    let widest = point_on_grid(widest);
    // The widest place is known roughly; the best point of a circle about it lies on the line.
    let Some(first) = tree.ahead(widest).into_iter().next() else { return vec![widest] };
    tree.grow(first, reach);
    let chains = tree.chains();
    let longest = chains.into_iter().map(|chain| (chain.len(), chain)).reduce(|best, next| {
        // Of equal ones the first.
        if next.0 > best.0 { next } else { best }
    });
    let Some((_, chain)) = longest else { return vec![first] };
    let mut points: Vec<DVec2> = chain.into_iter().map(|i| tree.points[i]).collect();
    let [a, b] = [points[0], points[points.len() - 1]];
    if (b.x, b.y) < (a.x, a.y) {
        points.reverse();
    }
    points
}

/// A part of a line of points around its widest place, no longer than `most` [mm].
pub(super) fn around_widest(of: &Outline, points: &[DVec2], most: f64) -> Vec<DVec2> {
    let mut along = vec![0.0];
    for pair in points.windows(2) {
        along.push(along[along.len() - 1] + pair[0].distance(pair[1]));
    }
    let length = along[along.len() - 1];
    if length <= most {
        return points.to_vec();
    }
    let near = NearestEdge::new(of.edges());
    let rooms: Vec<f64> = points.iter().map(|p| room(&near, *p)).collect();
    let widest = rooms.iter().copied().fold(0.0, f64::max) * (1.0 - EQUAL);
    // Of places that are equally wide the one nearest to the middle.
    let off_middle = |i: &usize| (along[*i] - 0.5 * length).abs();
    let at = (0..points.len())
        .filter(|i| rooms[*i] >= widest)
        .min_by(|a, b| off_middle(a).total_cmp(&off_middle(b)))
        .map_or(0.5 * length, |i| along[i]);
    let from = (at - 0.5 * most).clamp(0.0, length - most);
    let to = from + most;
    let place = |at: f64| {
        let i = along.partition_point(|x| *x <= at).clamp(1, points.len() - 1);
        let share = (at - along[i - 1]) / (along[i] - along[i - 1]);
        point_on_grid(points[i - 1].lerp(points[i], share))
    };
    let inner = (0..points.len()).filter(|i| along[*i] > from && along[*i] < to).map(|i| points[i]);
    let mut part: Vec<DVec2> = std::iter::once(place(from)).chain(inner).chain([place(to)]).collect();
    part.dedup();
    part
}

/// Room from a point to the border, negative outside [mm].
fn room(near: &NearestEdge, p: DVec2) -> f64 {
    near.at(p, f64::INFINITY).map_or(f64::NEG_INFINITY, |n| -n.distance)
}

impl Tree<'_> {
    /// Points a step from another at which the room is larger than beside them, the widest first.
    fn ahead(&self, p: DVec2) -> Vec<DVec2> {
        let at = |angle: f64| p + self.step * DVec2::from_angle(angle);
        let value = |angle: f64| room(self.near, at(angle));
        let between = TAU / LOOKS as f64;
        let values: Vec<f64> = (0..LOOKS).map(|k| value(k as f64 * between)).collect();
        let mut found: Vec<(f64, DVec2)> = Vec::new();
        for k in 0..LOOKS {
            let (before, after) = (values[(k + LOOKS - 1) % LOOKS], values[(k + 1) % LOOKS]);
            if values[k] < before || values[k] <= after {
                continue;
            }
            let (mut low, mut high) = ((k as f64 - 1.0) * between, (k as f64 + 1.0) * between);
            for _ in 0..REFINED {
                let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
                if value(a) < value(b) { low = a } else { high = b }
            }
            let q = point_on_grid(at(0.5 * (low + high)));
            let least = LEAST_ROOM * self.step;
            let is_inside = |q: DVec2| room(self.near, q) > least;
            if is_inside(q) && is_inside(0.5 * (p + q)) {
                found.push((room(self.near, q), q));
            }
        }
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        found.into_iter().map(|(_, q)| q).collect()
    }

    fn cell(&self, p: DVec2) -> [i64; 2] {
        (p / self.step).floor().to_array().map(|x| x as i64)
    }

    fn is_known(&self, p: DVec2) -> bool {
        let [x, y] = self.cell(p);
        let mut cells = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
        let is_near = |i: &usize| self.points[*i].distance(p) < KNOWN * self.step;
        cells.any(|cell| self.cells.get(&cell).is_some_and(|of| of.iter().any(is_near)))
    }

    fn add(&mut self, p: DVec2) -> usize {
        let (index, cell) = (self.points.len(), self.cell(p));
        self.points.push(p);
        self.cells.entry(cell).or_default().push(index);
        index
    }

    /// Follows the line from one of its points.
    fn grow(&mut self, first: DVec2, reach: f64) {
        let mut next = VecDeque::from([(self.add(first), 0.0)]);
        while let Some((i, along)) = next.pop_front() {
            if along > reach || self.points.len() >= MOST {
                continue;
            }
            for q in self.ahead(self.points[i]) {
                if !self.is_known(q) {
                    let j = self.add(q);
                    self.joined.push([i, j]);
                    next.push_back((j, along + self.step));
                }
            }
        }
    }

    /// Chains that turn little from step to step; each joint belongs to one of them.
    fn chains(&self) -> Vec<Vec<usize>> {
        let mut of: Vec<Vec<usize>> = vec![Vec::new(); self.points.len()];
        for (k, ends) in self.joined.iter().enumerate() {
            ends.iter().for_each(|i| of[*i].push(k));
        }
        let mut used = vec![false; self.joined.len()];
        let mut chains = Vec::new();
        for k in 0..self.joined.len() {
            if used[k] {
                continue;
            }
            used[k] = true;
            let mut chain: VecDeque<usize> = self.joined[k].into();
            for _ in 0..2 {
                while let Some(next) = self.straight_on([chain[1], chain[0]], &of, &mut used) {
                    chain.push_front(next);
                }
                chain = chain.into_iter().rev().collect();
            }
            chains.push(chain.into());
        }
        chains
    }

    /// The point after two others that turns least, its joint then used.
    fn straight_on(&self, [from, at]: [usize; 2], of: &[Vec<usize>], used: &mut [bool]) -> Option<usize> {
        let heading = |from: usize, to: usize| (self.points[to] - self.points[from]).to_angle();
        let along = heading(from, at);
        let free = of[at].iter().filter(|k| !used[**k]).map(|k| {
            let next = self.joined[*k].into_iter().find(|i| *i != at).unwrap_or(at);
            (wrap(heading(at, next) - along).abs(), *k, next)
        });
        let (turn, k, next) = free.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (turn < TURN).then(|| {
            used[k] = true;
            next
        })
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;
    use crate::geom::OutlineEdge;

    fn length(points: &[DVec2]) -> f64 {
        points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }

    fn polygon(points: &[[f64; 2]]) -> Outline {
        Outline::polygon(&points.iter().map(|p| DVec2::from_array(*p)).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn a_strip_has_its_middle_line() {
        for angle in [0.0, 0.4, 1.1] {
            let strip =
                polygon(&[[0.0, 0.0], [30.0, 0.0], [30.0, 1.0], [0.0, 1.0]]).moved(angle, DVec2::ZERO);
            let found = longest_piece(&strip, 0.5, 100.0);
            let back = |p: DVec2| DVec2::from_angle(-angle).rotate(p);
            // From corner to corner of the square at either end, within a step.
            assert!((length(&found) - 29.0).abs() < 1.1, "{angle}: {}", length(&found));
            assert!(found.iter().all(|p| (back(*p).y - 0.5).abs() < 0.15), "{angle}");
            let inner = found.iter().filter(|p| (1.0..29.0).contains(&back(**p).x));
            assert!(inner.clone().count() > 50 && inner.clone().all(|p| (back(*p).y - 0.5).abs() < 2e-6));
        }
    }

    #[test]
    fn a_rectangle_has_a_line_less_its_width_and_a_square_a_diagonal() {
        let rectangle = polygon(&[[0.0, 0.0], [60.0, 0.0], [60.0, 30.0], [0.0, 30.0]]);
        let found = longest_piece(&rectangle, 0.5, 200.0);
        assert!((length(&found) - 31.0).abs() < 1.1, "{}", length(&found));
        assert!(found.iter().all(|p| (p.y - 15.0).abs() < 0.5));
        let square = polygon(&[[0.0, 0.0], [30.0, 0.0], [30.0, 30.0], [0.0, 30.0]]);
        let found = longest_piece(&square, 0.5, 200.0);
        assert!((length(&found) - 42.4).abs() < 1.5, "{}", length(&found));
    }

    #[test]
    fn a_ring_is_followed_around_and_every_point_is_equally_far_from_two_walls() {
        let circle = |radius: f64| vec![OutlineEdge::arc(DVec2::ZERO, radius, 0.0, TAU)];
        let ring = Outline::new(vec![circle(20.0), circle(18.0)], Vec::new()).unwrap();
        let found = longest_piece(&ring, 0.5, 1000.0);
        assert!(found.iter().all(|p| (p.length() - 19.0).abs() < 2e-6));
        assert!(length(&found) > 0.97 * TAU * 19.0, "{}", length(&found));
        let window = around_widest(&ring, &found, 12.0);
        assert!((length(&window) - 12.0).abs() < 1e-3);
        // A strip with walls of many corners.
        let side = |y: f64| (0..=40).map(move |k| [f64::from(k), y + 0.4 * (0.3 * f64::from(k)).sin()]);
        let mut corners: Vec<[f64; 2]> = side(0.0).collect();
        corners.extend(side(1.6).rev());
        let found = longest_piece(&polygon(&corners), 0.5, 1000.0);
        assert!(length(&found) > 37.0, "{}", length(&found));
    }

    #[test]
    fn a_disc_has_hardly_a_line() {
        let disc =
            Outline::new(vec![vec![OutlineEdge::arc(dvec2(3.0, 1.0), 9.0, 0.0, TAU)]], Vec::new()).unwrap();
        assert!(length(&longest_piece(&disc, 0.5, 100.0)) < 5.0);
    }
}
