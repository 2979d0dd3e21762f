//! Ways of a tool at depth: what of them may be in air at most, and, of moves that are asked for, what is.
//!
//! Looking for material near a move costs far more than its bound. So a pattern is looked for among the bounds, and moves are asked
//! spread over what they leave: where there is material, a few tell.

use std::ops::Range;

use rayon::prelude::*;

/// A way at depth, and what of it is in air [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
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
struct Way {
    /// Index in the trace.
    index: usize,
    of: AirMove,
    is_bound: bool,
}

/// The ways of a piece of work, in its order.
pub(super) struct Ways<F> {
    all: Vec<Way>,
    exact: F,
}

impl<F: Fn(usize) -> AirMove + Sync> Ways<F> {
    /// Ways by their indices in the trace, and the most that may be in air of each; `exact` is what of the way at a place in this list is.
    pub(super) fn new(bounds: impl Iterator<Item = (usize, AirMove)>, exact: F) -> Ways<F> {
        let all = bounds.map(|(index, of)| Way { index, of, is_bound: true }).collect();
        Ways { all, exact }
    }

    /// The first way that may be in air.
    pub(super) fn first(&self) -> Option<usize> {
        self.all.iter().position(|way| way.of.air > 0.0)
    }

    /// Finds out what of some moves is in air.
    pub(super) fn ask(&mut self, moves: &[usize]) {
        // What has none at most has none.
        let open = |at: &usize| self.all[*at].is_bound && self.all[*at].of.air > 0.0;
        let open: Vec<usize> = moves.iter().copied().filter(open).collect();
        let exact = |at: usize| (at, (self.exact)(at));
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

    /// The longest way through air without a break, longer than `least`, and where it begins.
    pub(super) fn longest(&mut self, least: f64) -> Option<(f64, usize)> {
        let mut best: Option<(f64, usize)> = None;
        let is_long = |run: &(f64, usize, usize)| run.0 > least;
        let mut open = self.runs();
        open.retain(is_long);
        // The longest first: shorter ones cannot be longer than it is found to be.
        while let Some(next) = open.iter().enumerate().max_by(|a, b| a.1.0.total_cmp(&b.1.0)).map(|(i, _)| i)
        {
            let (length, from, to) = open.swap_remove(next);
            if best.is_some_and(|(most, _)| most > length) {
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
        best
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
                    way.of.is_free() && way.index == self.all[at - 1].index + 1
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
    use proptest::prelude::*;

    use super::*;

    /// The longest run and the sum by going through all ways, as the rule says them.
    fn by_all(
        ways: &[(usize, AirMove)],
        least: f64,
        [share, short]: [f64; 2],
    ) -> (Option<(f64, usize)>, Option<f64>) {
        let (mut run, mut best): ((f64, usize), Option<(f64, usize)>) = ((0.0, 0), None);
        let (mut depth, mut air, mut next) = (0.0, 0.0, 0);
        for (at, (index, way)) in ways.iter().enumerate() {
            (depth, air) = (depth + way.depth, air + way.air);
            if way.air <= 0.0 || way.air < 0.99 * way.depth {
                run = (0.0, 0);
            } else {
                run = if run.0 > 0.0 && *index == next { (run.0 + way.air, run.1) } else { (way.air, at) };
            }
            next = index + 1;
            if run.0 > least && best.is_none_or(|(most, _)| run.0 > most) {
                best = Some(run);
            }
        }
        (best, Some(air).filter(|air| *air >= share * depth && *air > short))
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn what_is_asked_of_some_is_what_all_say(
            moves in prop::collection::vec((1..4usize, 0..5u32, 0..20u32, prop::bool::ANY), 0..120),
            least in 0..12u32,
            free in 0..20u32,
        ) {
            // Depth in whole numbers; a way is all in air as often as `free` says, or in part, or met material.
            let mut index = 0;
            let ways: Vec<(usize, AirMove, AirMove)> = moves
                .iter()
                .map(|&(gap, depth, of_twenty, met)| {
                    index += if gap < 3 { 1 } else { 2 };
                    let depth = f64::from(depth);
                    let bound = if met && of_twenty > 17 { 0.0 } else { depth };
                    let air = if of_twenty >= free { bound } else { (0.5 * bound).floor() };
                    (index, AirMove { depth, air: bound }, AirMove { depth, air })
                })
                .collect();
            let exact: Vec<(usize, AirMove)> = ways.iter().map(|(index, _, of)| (*index, *of)).collect();
            let bounds = || ways.iter().map(|(index, bound, _)| (*index, *bound));
            let (least, some) = (f64::from(least), [0.9, f64::from(least)]);
            let (longest, air) = by_all(&exact, least, some);
            prop_assert_eq!(Ways::new(bounds(), |at| exact[at].1).longest(least), longest);
            prop_assert_eq!(Ways::new(bounds(), |at| exact[at].1).nearly_all(some[0], some[1]), air);
        }
    }

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
