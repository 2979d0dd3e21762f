//! Ways of a tool at depth: what of them may be in air at most, and, of moves that are asked for, what is.
//!
//! Looking for material near a move costs far more than its bound. So a pattern is looked for among the bounds, and moves are asked
//! spread over what they leave: where there is material, a few tell.

use std::ops::Range;

use rayon::prelude::*;

use crate::job::prove::Done;

/// A way at depth, and what of it is in air [mm].
#[derive(Clone, Copy, Debug)]
pub(super) struct AirMove {
    pub(super) depth: f64,
    pub(super) air: f64,
}

impl AirMove {
    /// Whether all of it is in air.
    fn is_free(self) -> bool {
        self.air > 0.0 && self.air >= 0.99 * self.depth
    }
}

/// Moves that are asked together, by all threads.
const AT_ONCE: usize = 16;

/// A move, and what is known of it.
#[derive(Clone, Copy)]
struct Way<'a> {
    done: &'a Done<'a>,
    of: AirMove,
    is_bound: bool,
}

/// The ways of a piece of work, in its order.
pub(super) struct Ways<'a, F> {
    all: Vec<Way<'a>>,
    exact: F,
}

impl<'a, F: Fn(&Done<'_>) -> AirMove + Sync> Ways<'a, F> {
    /// Ways by the most that may be in air of each; `exact` is what of a move is.
    pub(super) fn new(bounds: Vec<(&'a Done<'a>, AirMove)>, exact: F) -> Ways<'a, F> {
        let all = bounds.into_iter().map(|(done, of)| Way { done, of, is_bound: true }).collect();
        Ways { all, exact }
    }

    /// The moves with what may be in air of them.
    pub(super) fn moves(&self) -> impl Iterator<Item = (&'a Done<'a>, AirMove)> + '_ {
        self.all.iter().map(|way| (way.done, way.of))
    }

    /// Finds out what of some moves is in air.
    pub(super) fn ask(&mut self, moves: &[usize]) {
        // What has none at most has none.
        let open = |at: &usize| self.all[*at].is_bound && self.all[*at].of.air > 0.0;
        let open: Vec<usize> = moves.iter().copied().filter(open).collect();
        let exact = |at: usize| (at, (self.exact)(self.all[at].done));
        let found: Vec<(usize, AirMove)> = open.into_par_iter().map(exact).collect();
        for (at, of) in found {
            self.all[at] = Way { of, is_bound: false, ..self.all[at] };
        }
    }

    /// Lengths of some moves at depth, and in air at most.
    pub(super) fn sums(&self, moves: Range<usize>) -> AirMove {
        let start = AirMove { depth: 0.0, air: 0.0 };
        self.all[moves]
            .iter()
            .fold(start, |sum, way| AirMove { depth: sum.depth + way.of.depth, air: sum.air + way.of.air })
    }

    /// The length in air, if it is a share of that at depth or more, and longer than `least`.
    pub(super) fn nearly_all(&mut self, share: f64, least: f64) -> Option<f64> {
        let AirMove { depth, mut air } = self.sums(0..self.all.len());
        let enough = |air: f64| air >= share * depth && air > least;
        for some in spread(0..self.all.len()).chunks(AT_ONCE) {
            if !enough(air) {
                return None;
            }
            let sum = |ways: &Self| some.iter().map(|at| ways.all[*at].of.air).sum::<f64>();
            let before = sum(self);
            self.ask(some);
            air -= before - sum(self);
        }
        Some(self.sums(0..self.all.len()).air).filter(|air| enough(*air))
    }

    /// The longest way through air without a break, longer than `least`, and the item at which it begins.
    pub(super) fn longest(&mut self, least: f64) -> Option<(f64, u32)> {
        let mut best: Option<(f64, usize)> = None;
        let is_long = |run: &(f64, usize, usize)| run.0 > least;
        let mut open = self.runs();
        open.retain(is_long);
        // The longest first: shorter ones cannot be longer than it is found to be.
        while let Some(next) = open.iter().enumerate().max_by(|a, b| a.1.0.total_cmp(&b.1.0)).map(|(i, _)| i)
        {
            let (length, from, to) = open.swap_remove(next);
            if best.is_some_and(|(most, first)| (most, from) > (length, first)) {
                break;
            }
            match self.broken(from..to) {
                Some(broken) => {
                    let parts = [self.run(from, broken), self.run(broken + 1, to)];
                    open.extend(parts.into_iter().filter(is_long));
                }
                // Of equal ones the first.
                None if best.is_none_or(|(most, first)| (length, first) > (most, from)) => {
                    best = Some((length, from));
                }
                None => {}
            }
        }
        best.map(|(length, first)| (length, self.all[first].done.segment.item))
    }

    /// A move of some that is not free.
    fn broken(&mut self, moves: Range<usize>) -> Option<usize> {
        spread(moves).chunks(AT_ONCE).find_map(|some| {
            self.ask(some);
            some.iter().copied().find(|at| !self.all[*at].of.is_free())
        })
    }

    /// The unbroken ways that may be in air: length, first move, and the one behind the last.
    fn runs(&self) -> Vec<(f64, usize, usize)> {
        let mut runs = Vec::new();
        let mut from = 0;
        for at in 0..=self.all.len() {
            let goes_on = at > from
                && self.all.get(at).is_some_and(|way| {
                    // A rapid between two feed moves ends the way.
                    way.of.is_free() && way.done.index == self.all[at - 1].done.index + 1
                });
            if goes_on {
                continue;
            }
            if at > from {
                runs.push(self.run(from, at));
            }
            from = if self.all.get(at).is_some_and(|way| way.of.is_free()) { at } else { at + 1 };
        }
        runs
    }

    fn run(&self, from: usize, to: usize) -> (f64, usize, usize) {
        (self.all[from..to].iter().map(|way| way.of.air).sum(), from, to)
    }
}

/// All numbers of a range, neighbours far apart.
fn spread(of: Range<usize>) -> Vec<usize> {
    // By the golden section, as long as that passes all.
    let part = (of.len() as f64 * 0.618) as usize;
    let stride = (part..).find(|stride| gcd(*stride, of.len()) == 1).unwrap_or(1);
    (0..of.len()).map(|i| of.start + (of.len() / 2 + i * stride) % of.len()).collect()
}

fn gcd(mut a: usize, mut b: usize) -> usize {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_numbers_are_all_of_them_once_and_neighbours_are_apart() {
        for count in [0, 1, 2, 3, 10, 97, 1000, 1024] {
            let all = spread(5..5 + count);
            let mut sorted = all.clone();
            sorted.sort_unstable();
            assert!(sorted.into_iter().eq(5..5 + count), "{count}");
            let near = |pair: &[usize]| pair[0].abs_diff(pair[1]) < count / 4;
            assert!(count < 10 || !all.windows(2).any(near), "{count}: {all:?}");
        }
    }
}
