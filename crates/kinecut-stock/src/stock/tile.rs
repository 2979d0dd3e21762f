//! A tile: 16 x 16 neighbouring lines of one direction, the unit of work and of memory of the stock.
//!
//! A line holds one interval in place, or up to two in a tile where one has ever had two; a line with more keeps them in a run of
//! the tile's arena. A tile whose lines are all alike (raw stock) holds one line only, until one of them is changed.

use super::{CutId, EndPoint, Interval};

/// Lines along an edge of a tile.
pub(crate) const TILE_EDGE: u32 = 16;
/// Lines of a tile.
pub(crate) const TILE_LINES: usize = (TILE_EDGE * TILE_EDGE) as usize;
/// Most intervals held in place.
const IN_PLACE: usize = 2;

/// Intervals of one line in the arena.
#[derive(Clone, Copy, Debug, Default)]
struct Run {
    start: u32,
    len: u32,
    room: u32,
}

/// 16 x 16 lines.
#[derive(Clone, Debug)]
pub(crate) struct Tile {
    /// The line that all are like, while `heads` is empty.
    alike: Option<Interval>,
    /// Per line: number of intervals in place, or `IN_PLACE + 1` + index of its run.
    heads: Vec<u16>,
    /// Intervals in place, `room` for each line.
    places: Vec<Interval>,
    /// Intervals that a line may have in place: one or two.
    room: u8,
    runs: Vec<Run>,
    /// Indices of runs that no line uses.
    idle: Vec<u32>,
    arena: Vec<Interval>,
    /// Stretches of material that cuts take, in order, while somebody wants to know.
    taken: Option<Vec<TakenStretch>>,
}

/// A stretch of material that a cut has taken from a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TakenStretch {
    /// The cut.
    pub(crate) cut: CutId,
    /// Index of the line in its tile.
    pub(crate) line: u16,
    /// Its ends [fixed steps].
    pub(crate) ends: [i32; 2],
}

impl Tile {
    /// Bytes of a tile without arena, all lines apart.
    pub(crate) const BYTES: usize =
        size_of::<Tile>() + TILE_LINES * (size_of::<u16>() + size_of::<[Interval; IN_PLACE]>());

    /// Bytes of the tile with its lines.
    pub(crate) fn bytes(&self) -> usize {
        let places = size_of_val(&self.heads[..]) + size_of_val(&self.places[..]);
        size_of::<Tile>() + places + size_of_val(&self.runs[..]) + size_of_val(&self.arena[..])
    }

    /// A tile of equal lines.
    pub(crate) fn of(alike: Option<Interval>) -> Tile {
        Tile {
            alike,
            heads: Vec::new(),
            places: Vec::new(),
            room: 1,
            runs: Vec::new(),
            idle: Vec::new(),
            arena: Vec::new(),
            taken: None,
        }
    }

    /// Notes from now on what cuts take.
    pub(crate) fn note_taken(&mut self) {
        self.taken = Some(Vec::new());
    }

    /// All that cuts have taken since; nothing is noted any more.
    pub(crate) fn take_noted(&mut self) -> Vec<TakenStretch> {
        self.taken.take().unwrap_or_default()
    }

    fn note(&mut self, line: usize, cut: CutId, ends: [i32; 2]) {
        if let Some(taken) = &mut self.taken {
            taken.push(TakenStretch { cut, line: line as u16, ends });
        }
    }

    /// The intervals of a line.
    pub(crate) fn line(&self, line: usize) -> &[Interval] {
        match self.heads.get(line) {
            None => self.alike.as_slice(),
            Some(&head) if head as usize <= IN_PLACE => {
                &self.places[line * self.room as usize..][..head as usize]
            }
            Some(&head) => {
                let run = self.runs[head as usize - IN_PLACE - 1];
                &self.arena[run.start as usize..][..run.len as usize]
            }
        }
    }

    /// The intervals of a line of its own.
    fn line_mut(&mut self, line: usize) -> &mut [Interval] {
        self.part();
        match self.heads[line] as usize {
            head if head <= IN_PLACE => &mut self.places[line * self.room as usize..][..head],
            head => {
                let run = self.runs[head - IN_PLACE - 1];
                &mut self.arena[run.start as usize..][..run.len as usize]
            }
        }
    }

    /// True if all lines are alike.
    pub(crate) fn is_alike(&self) -> bool {
        self.heads.is_empty()
    }

    /// Coordinates between which all material of the lines `0..width` of the rows `0..height` lies [fixed steps];
    /// `None` without material.
    pub(crate) fn hull(&self, width: u32, height: u32) -> Option<(i32, i32)> {
        let (width, height) = if self.is_alike() { (1, 1) } else { (width, height) };
        let mut hull = (i32::MAX, i32::MIN);
        for l in (0..height).flat_map(|b| (0..width).map(move |a| (b * TILE_EDGE + a) as usize)) {
            let line = self.line(l);
            if let (Some(first), Some(last)) = (line.first(), line.last()) {
                hull = (hull.0.min(first.lo.at), hull.1.max(last.hi.at));
            }
        }
        (hull.0 < hull.1).then_some(hull)
    }

    /// Replaces the intervals of a line (sorted, disjoint, none empty).
    pub(crate) fn set(&mut self, line: usize, intervals: &[Interval]) {
        self.part();
        let head = self.heads[line] as usize;
        if intervals.len() <= IN_PLACE {
            if head > IN_PLACE {
                self.idle.push((head - IN_PLACE - 1) as u32);
            }
            self.make_room(intervals.len());
            self.places[line * self.room as usize..][..intervals.len()].copy_from_slice(intervals);
            self.heads[line] = intervals.len() as u16;
            return;
        }
        let run = if head > IN_PLACE {
            head - IN_PLACE - 1
        } else if let Some(run) = self.idle.pop() {
            run as usize
        } else {
            self.runs.push(Run::default());
            self.runs.len() - 1
        };
        self.heads[line] = (run + IN_PLACE + 1) as u16;
        if (self.runs[run].room as usize) < intervals.len() {
            let room = intervals.len().next_power_of_two();
            self.runs[run] = Run { start: self.arena.len() as u32, len: 0, room: room as u32 };
            self.arena.resize(self.arena.len() + room, Interval::default());
        }
        let start = self.runs[run].start as usize;
        self.runs[run].len = intervals.len() as u32;
        self.arena[start..][..intervals.len()].copy_from_slice(intervals);
        self.compact();
    }

    /// Takes the material from `lo.at` to `hi.at` out of a line; the new ends of what remains get normal, class
    /// and cut of `lo` and `hi`. An end that two moves leave is that of the earlier one, in whichever order they come. Returns the length
    /// removed [fixed steps].
    pub(crate) fn subtract(&mut self, line: usize, lo: EndPoint, hi: EndPoint) -> i64 {
        let old = self.line(line);
        if lo.at >= hi.at {
            return 0;
        }
        if !old.iter().any(|i| i.lo.at < hi.at && lo.at < i.hi.at) {
            if old.iter().any(|i| is_later(&i.lo, &hi) || is_later(&i.hi, &lo)) {
                for i in self.line_mut(line) {
                    *i = kept_beside(i, lo, hi);
                }
            }
            return 0;
        }
        if let &[i] = old {
            // Nearly all calls.
            let (from, to) = (i.lo.at.max(lo.at), i.hi.at.min(hi.at));
            self.part();
            self.note(line, lo.cut, [from, to]);
            let (left, right) = (i.lo.at < lo.at, hi.at < i.hi.at);
            self.make_room(usize::from(left) + usize::from(right));
            let place = line * self.room as usize;
            if left {
                self.places[place] = Interval { lo: i.lo, hi: lo };
            }
            if right {
                self.places[place + usize::from(left)] = Interval { lo: hi, hi: i.hi };
            }
            self.heads[line] = u16::from(left) + u16::from(right);
            return i64::from(to) - i64::from(from);
        }
        let mut kept = [Interval::default(); 8];
        let mut spill = Vec::new();
        let kept: &mut [Interval] = if old.len() < kept.len() {
            &mut kept
        } else {
            spill.resize(old.len() + 1, Interval::default());
            &mut spill
        };
        let (mut n, mut removed) = (0, 0);
        for i in old {
            let (from, to) = (i.lo.at.max(lo.at), i.hi.at.min(hi.at));
            if from >= to {
                kept[n] = kept_beside(i, lo, hi);
                n += 1;
                continue;
            }
            removed += i64::from(to) - i64::from(from);
            if i.lo.at < lo.at {
                kept[n] = Interval { lo: i.lo, hi: lo };
                n += 1;
            }
            if hi.at < i.hi.at {
                kept[n] = Interval { lo: hi, hi: i.hi };
                n += 1;
            }
        }
        if self.taken.is_some() {
            for [from, to] in self.within(line, [lo.at, hi.at]) {
                self.note(line, lo.cut, [from, to]);
            }
        }
        self.set(line, &kept[..n]);
        removed
    }

    /// The material of a line between two coordinates.
    fn within(&self, line: usize, [low, high]: [i32; 2]) -> Vec<[i32; 2]> {
        let part = |i: &Interval| [i.lo.at.max(low), i.hi.at.min(high)];
        self.line(line).iter().map(part).filter(|[from, to]| from < to).collect()
    }

    /// Length of all material of the lines `0..width` of the rows `0..height` [fixed steps].
    pub(crate) fn content(&self, width: u32, height: u32) -> i64 {
        let mut sum = 0;
        for b in 0..height {
            for a in 0..width {
                let line = self.line((b * TILE_EDGE + a) as usize);
                sum += line.iter().map(|i| i64::from(i.hi.at) - i64::from(i.lo.at)).sum::<i64>();
            }
        }
        sum
    }

    /// Gives each line its own place.
    fn part(&mut self) {
        if self.is_alike() {
            let first = self.alike.unwrap_or_default();
            self.heads = vec![u16::from(self.alike.is_some()); TILE_LINES];
            self.places = vec![first; TILE_LINES];
        }
    }

    /// Lets lines have so many intervals in place, if as many may be.
    fn make_room(&mut self, count: usize) {
        if count > self.room as usize {
            self.places = self.places.iter().flat_map(|own| [*own, Interval::default()]).collect();
            self.room = IN_PLACE as u8;
        }
    }

    /// Drops the arena's dead room when it is more than half.
    fn compact(&mut self) {
        // Looked at only when the arena is about to grow anyway: the cost is shared by the growth.
        if self.arena.len() < 64 || self.arena.len() < self.arena.capacity() {
            return;
        }
        let live: usize = self
            .heads
            .iter()
            .filter(|h| **h as usize > IN_PLACE)
            .map(|h| self.runs[*h as usize - IN_PLACE - 1].room as usize)
            .sum();
        if live * 2 > self.arena.len() {
            return;
        }
        let mut arena = Vec::with_capacity(live * 2);
        let mut runs = Vec::with_capacity(self.runs.len());
        for head in self.heads.iter_mut().filter(|h| **h as usize > IN_PLACE) {
            let run = self.runs[*head as usize - IN_PLACE - 1];
            *head = (runs.len() + IN_PLACE + 1) as u16;
            runs.push(Run { start: arena.len() as u32, ..run });
            arena.extend_from_slice(&self.arena[run.start as usize..][..run.room as usize]);
        }
        (self.arena, self.runs) = (arena, runs);
        self.idle.clear();
    }
}

/// True if an end was left by a later move than a new one in the same place.
fn is_later(old: &EndPoint, new: &EndPoint) -> bool {
    old.at == new.at && 0 < new.cut && new.cut < old.cut
}

/// An interval beside a stretch that is taken out.
fn kept_beside(i: &Interval, lo: EndPoint, hi: EndPoint) -> Interval {
    Interval {
        lo: if is_later(&i.lo, &hi) { hi } else { i.lo },
        hi: if is_later(&i.hi, &lo) { lo } else { i.hi },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn end(at: i32, cut: u32) -> EndPoint {
        EndPoint { at, cut, ..EndPoint::default() }
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        /// Against a row of booleans; one tile lives through all of a case so that the arena is compacted.
        #[test]
        fn lines_are_sets_of_points(cuts in prop::collection::vec((0usize..6, 0i32..256, 1i32..12, any::<bool>()), 1..400)) {
            let mut tile = Tile::of(Some(Interval { lo: end(0, 0), hi: end(256, 0) }));
            let mut model = vec![vec![true; 256]; 6];
            for (line, from, length, refill) in cuts {
                if refill {
                    tile.set(line, &[Interval { lo: end(0, 0), hi: end(256, 0) }]);
                    model[line] = vec![true; 256];
                }
                let to = (from + length).min(256);
                let removed = tile.subtract(line, end(from, 1), end(to, 2));
                let mut count = 0;
                for p in from..to {
                    count += i64::from(std::mem::replace(&mut model[line][p as usize], false));
                }
                prop_assert_eq!(removed, count);
            }
            for (l, model) in model.iter().enumerate() {
                let line = tile.line(l);
                prop_assert!(line.iter().all(|i| i.lo.at < i.hi.at));
                prop_assert!(line.windows(2).all(|w| w[0].hi.at <= w[1].lo.at));
                for (p, inside) in model.iter().enumerate() {
                    let p = p as i32;
                    prop_assert_eq!(*inside, line.iter().any(|i| i.lo.at <= p && p < i.hi.at));
                }
            }
            prop_assert_eq!(tile.line(200).len(), 1);
        }
    }

    #[test]
    fn an_end_left_twice_is_that_of_the_earlier_cut() {
        let full = Interval { lo: end(0, 0), hi: end(100, 0) };
        // On a line with one interval, two, and more.
        for holes in [&[][..], &[60], &[60, 70, 80]] {
            let made = [(4, 9), (9, 4)].map(|(first, second)| {
                let mut tile = Tile::of(Some(full));
                for hole in holes {
                    tile.subtract(5, end(*hole, 2), end(hole + 4, 2));
                }
                assert_eq!(tile.subtract(5, end(20, first), end(30, first)), 10);
                assert_eq!(tile.subtract(5, end(20, second), end(25, second)), 0);
                assert_eq!(tile.subtract(5, end(25, second), end(30, second)), 0);
                // What is known to be void, and the face of the raw stock, belong to no move.
                tile.subtract(5, end(20, 0), end(30, 0));
                tile.subtract(5, end(-9, 1), end(0, 1));
                assert_eq!(
                    tile.subtract(5, end(20, second), end(62, second)),
                    if holes.is_empty() { 32 } else { 30 }
                );
                tile.line(5).iter().map(|i| (i.lo.at, i.lo.cut, i.hi.at, i.hi.cut)).collect::<Vec<_>>()
            });
            for line in &made {
                assert_eq!((line[0].1, line[0].2, line[0].3), (0, 20, 4), "{made:?}");
            }
        }
    }

    #[test]
    fn new_ends_carry_the_cut_that_made_them() {
        let mut tile = Tile::of(Some(Interval { lo: end(0, 0), hi: end(100, 0) }));
        assert_eq!(tile.subtract(3, end(20, 7), end(30, 8)), 10);
        let cuts: Vec<_> = tile.line(3).iter().map(|i| (i.lo.cut, i.hi.cut)).collect();
        assert_eq!(cuts, [(0, 7), (8, 0)]);
        assert_eq!(tile.subtract(3, end(30, 9), end(200, 9)), 70);
        assert_eq!(tile.line(3).len(), 1);
        assert_eq!(tile.line(4).len(), 1);
        assert_eq!(tile.hull(16, 16), Some((0, 100)));
    }
}
