//! Places along the wall at which passes begin: where what is cleared ends, in the direction of travel.

use std::collections::BTreeSet;

use glam::DVec2;

use super::link::Pose;
use super::region::WallLoop;

/// Places along the wall, in radii of the cutter.
const STEP: f64 = 0.1;
/// Farthest a pass changes whether the cutter cuts at a place, in radii of the cutter, with room for rounding.
const REACH: f64 = 2.01;

/// Places along all loops of the wall, and which of them are cleared. A place once cleared stays so.
#[derive(Debug)]
pub(super) struct Starts {
    places: Vec<Pose>,
    /// For each place the next one along its loop, and the one before.
    next: Vec<usize>,
    before: Vec<usize>,
    /// First place of each loop.
    first: Vec<usize>,
    cleared: Vec<bool>,
    /// Cleared places with one after them that is not.
    ends: BTreeSet<usize>,
    grid: Grid,
}

impl Starts {
    /// Of the loops of the wall for a cutter's radius [mm]; none of them is cleared yet.
    pub(super) fn new(loops: &[WallLoop], radius: f64) -> Starts {
        let (mut places, mut next, mut before, mut first) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for of in loops {
            let begin = places.len();
            first.push(begin);
            for edge in &of.edges {
                let count = (edge.length() / (STEP * radius)).ceil().max(1.0);
                for k in 0..count as usize {
                    let share = k as f64 / count;
                    places.push(Pose { at: edge.at(share), heading: edge.heading(share) });
                }
            }
            let end = places.len();
            next.extend((begin..end).map(|i| if i + 1 < end { i + 1 } else { begin }));
            before.extend((begin..end).map(|i| if i > begin { i - 1 } else { end - 1 }));
        }
        first.push(places.len());
        let grid = Grid::new(&places, radius);
        let cleared = vec![false; places.len()];
        Starts { places, next, before, first, cleared, ends: BTreeSet::new(), grid }
    }

    /// The places of a loop.
    pub(super) fn of(&self, one: usize) -> &[Pose] {
        &self.places[self.first[one]..self.first[one + 1]]
    }

    /// Takes in what a way has cleared; `None`: all that has been cleared so far. `touches`: whether the cutter cuts at a place.
    pub(super) fn update(&mut self, way: Option<&[DVec2]>, mut touches: impl FnMut(Pose) -> bool) {
        let mut found = Vec::new();
        let places = &self.places;
        let look = |i: usize| {
            let is_cleared = !touches(places[i]);
            if is_cleared {
                found.push(i);
            }
            is_cleared
        };
        match way {
            Some(way) => self.grid.take_near(way, look),
            None => self.grid.take(look),
        }
        for &i in &found {
            self.cleared[i] = true;
        }
        for i in found.into_iter().flat_map(|i| [i, self.before[i]]) {
            if self.cleared[i] && !self.cleared[self.next[i]] {
                self.ends.insert(i);
            } else {
                self.ends.remove(&i);
            }
        }
    }

    /// The place nearest to another at which a pass may begin, by its index.
    pub(super) fn nearest(&self, here: Option<DVec2>) -> Option<usize> {
        let far = |i: &usize| {
            let at = self.places[*i].at;
            here.map_or(at, |here| at - here).length_squared()
        };
        self.ends.iter().copied().min_by(|a, b| far(a).total_cmp(&far(b)))
    }

    /// A place by its index.
    pub(super) fn place(&self, i: usize) -> Pose {
        self.places[i]
    }

    /// No pass begins at a place any more.
    pub(super) fn give_up(&mut self, i: usize) {
        self.ends.remove(&i);
    }
}

/// Places by where they are.
#[derive(Debug)]
struct Grid {
    low: DVec2,
    width: f64,
    columns: usize,
    rows: usize,
    cells: Vec<Vec<usize>>,
}

impl Grid {
    fn new(places: &[Pose], width: f64) -> Grid {
        let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        let [low, high] = places.iter().fold(start, |[low, high], p| [low.min(p.at), high.max(p.at)]);
        let count = |length: f64| if length > 0.0 { (length / width) as usize + 1 } else { 1 };
        let (columns, rows) = (count(high.x - low.x), count(high.y - low.y));
        let mut grid = Grid { low, width, columns, rows, cells: vec![Vec::new(); columns * rows] };
        for (i, place) in places.iter().enumerate() {
            let [[column, row], _] = grid.around(place.at, 0.0);
            grid.cells[row * columns + column].push(i);
        }
        grid
    }

    /// The first and last cell, by column and row, of those that a square around a point with a half width [mm] touches.
    fn around(&self, p: DVec2, half: f64) -> [[usize; 2]; 2] {
        let at = |p: DVec2| {
            let cell = (p - self.low) / self.width;
            [(cell.x as usize).min(self.columns - 1), (cell.y as usize).min(self.rows - 1)]
        };
        [at(p - half), at(p + half)]
    }

    /// Takes out all places that `is_done` has.
    fn take(&mut self, mut is_done: impl FnMut(usize) -> bool) {
        for cell in &mut self.cells {
            cell.retain(|i| !is_done(*i));
        }
    }

    /// Takes out the places near a way that `is_done` has; each is asked for once.
    fn take_near(&mut self, way: &[DVec2], mut is_done: impl FnMut(usize) -> bool) {
        let mut near = BTreeSet::new();
        let mut last: Option<[[usize; 2]; 2]> = None;
        for p in way {
            let around = self.around(*p, REACH * self.width);
            if last.replace(around) == Some(around) {
                continue;
            }
            let [[left, low], [right, high]] = around;
            near.extend((low..=high).flat_map(|row| (left..=right).map(move |column| (row, column))));
        }
        for (row, column) in near {
            self.cells[row * self.columns + column].retain(|i| !is_done(*i));
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;
    use crate::geom::OutlineEdge;

    /// A square of 40 mm, travelled counter-clockwise: places 0.5 mm apart for a radius of 5.
    fn square() -> Starts {
        let corners = [dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(40.0, 40.0), dvec2(0.0, 40.0)];
        let edges = (0..4).map(|i| OutlineEdge::line(corners[i], corners[(i + 1) % 4])).collect();
        Starts::new(&[WallLoop { edges, around: None }], 5.0)
    }

    #[test]
    fn passes_begin_after_every_stretch_that_is_cleared() {
        let mut starts = square();
        assert_eq!((starts.of(0).len(), starts.nearest(None)), (320, None));
        // Two stretches, the second in the middle of what is left.
        starts.update(None, |p| !(p.at.y == 0.0 && (10.2..20.2).contains(&p.at.x)));
        let at = |starts: &Starts, near: DVec2| starts.nearest(Some(near)).map(|i| starts.place(i).at);
        assert_eq!(at(&starts, dvec2(0.0, 40.0)), Some(dvec2(20.0, 0.0)));
        let way = [dvec2(30.0, 35.0), dvec2(20.0, 35.0)];
        starts.update(Some(&way), |p| !(p.at.y == 40.0 && (18.2..32.2).contains(&p.at.x)));
        assert_eq!(at(&starts, dvec2(0.0, 40.0)), Some(dvec2(18.5, 40.0)));
        assert_eq!(at(&starts, dvec2(40.0, 0.0)), Some(dvec2(20.0, 0.0)));
        // What is cleared up to another stretch joins it, and a place that is given up is no beginning.
        starts.update(None, |p| {
            !(p.at.y == 0.0 && p.at.x > 19.0 || p.at.x == 40.0 || p.at.y == 40.0 && p.at.x > 25.0)
        });
        assert_eq!(at(&starts, dvec2(40.0, 0.0)), Some(dvec2(18.5, 40.0)));
        starts.give_up(starts.nearest(None).unwrap());
        assert_eq!(starts.nearest(None), None);
    }

    #[test]
    fn places_near_a_way_are_asked_for_once_and_all_of_them() {
        let mut starts = square();
        let way: Vec<DVec2> = (0..100).map(|k| dvec2(0.3 * f64::from(k), 0.2 * f64::from(k))).collect();
        let mut asked = Vec::new();
        starts.update(Some(&way), |p| {
            asked.push(p.at);
            true
        });
        let near = |p: &Pose| way.iter().any(|w| w.distance(p.at) <= 10.0);
        assert!(starts.of(0).iter().filter(|p| near(p)).all(|p| asked.contains(&p.at)));
        assert!(asked.iter().enumerate().all(|(i, p)| !asked[..i].contains(p)));
        assert!(asked.len() < 320);
    }
}
