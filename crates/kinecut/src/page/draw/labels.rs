//! Words in a picture that do not lie on one another.

use super::CHARACTER;
use crate::page::picture::{Anchor, Picture};

/// Height of a word [px].
const HEIGHT: f64 = 13.0;
/// Room between a thing and its name [px].
const OFF: f64 = 9.0;
/// Directions from its place in which a name may be put.
const ROUND: u32 = 12;
/// Distance of the points along a line that names keep off [px], and most of a stretch.
const APART: f64 = 5.0;
const MOST: f64 = 400.0;

/// Left, top, right, bottom [px].
type Box = [f64; 4];

/// The words of a picture and what they keep off.
pub(crate) struct Labels {
    within: Box,
    taken: Vec<Box>,
    /// Points that a name covers where it must.
    points: Vec<[f64; 2]>,
}

/// Width of a word [px].
pub(crate) fn width(text: &str) -> f64 {
    CHARACTER * text.chars().count() as f64
}

impl Labels {
    /// No words yet in a box: left, top, right, bottom [px].
    pub(crate) fn new(within: [f64; 4]) -> Labels {
        Labels { within, taken: Vec::new(), points: Vec::new() }
    }

    /// Keeps words off a box: left, top, right, bottom [px].
    pub(crate) fn keep_off(&mut self, taken: [f64; 4]) {
        self.taken.push(taken);
    }

    /// Keeps words off a line where it can, by each `every` of points along it.
    pub(crate) fn keep_off_line(&mut self, line: &[[f64; 2]], every: usize) {
        let mut points = Vec::new();
        for pair in line.windows(2) {
            let length = (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
            let steps = (length / APART).ceil().clamp(1.0, MOST) as usize;
            let at =
                |i: usize| [0, 1].map(|k| pair[0][k] + (pair[1][k] - pair[0][k]) * i as f64 / steps as f64);
            points.extend((0..steps).map(at));
        }
        points.extend(line.last());
        self.points.extend(points.into_iter().step_by(every));
    }

    /// The first of some places at which a word with its middle there is free; it is taken then.
    pub(crate) fn first(
        &mut self,
        text: &str,
        places: impl IntoIterator<Item = [f64; 2]>,
    ) -> Option<[f64; 2]> {
        let half = [0.5 * (width(text) + 6.0), 0.5 * HEIGHT];
        let found = places.into_iter().find(|&at| {
            let one = about(at, half);
            beyond(&one, &self.within) <= 0.0 && !self.taken.iter().any(|b| meet(b, &one))
        })?;
        self.taken.push(about(found, half));
        Some(found)
    }

    /// Puts a word with its middle at the first free of some places, if there is one.
    pub(crate) fn put(
        &mut self,
        picture: &mut Picture,
        text: &str,
        places: impl IntoIterator<Item = [f64; 2]>,
    ) -> bool {
        let found = self.first(text, places);
        if let Some([x, y]) = found {
            picture.word([x, y + 4.0], Anchor::Middle, text);
        }
        found.is_some()
    }

    /// The middle of a name of a width [px] beside a place, where it covers least; it is taken then.
    pub(crate) fn beside(&mut self, width: f64, place: [f64; 2]) -> [f64; 2] {
        let half = [0.5 * width, 0.5 * HEIGHT + 1.0];
        let mut best = (f64::INFINITY, place);
        for ring in [0u32, 1, 2, 4] {
            let out = OFF + f64::from(ring) * 15.0;
            for i in 0..ROUND {
                let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / f64::from(ROUND)).sin_cos();
                let at = [place[0] + cos * (out + half[0]), place[1] + sin * (out + half[1])];
                let one = about(at, half);
                let names = self.taken.iter().filter(|b| meet(b, &one)).count() as f64;
                let points = self.points.iter().filter(|p| meet(&about(**p, [2.0; 2]), &one)).count() as f64;
                let cost =
                    1e4 * names + 100.0 * beyond(&one, &self.within) + 6.0 * points + 10.0 * f64::from(ring);
                if cost < best.0 {
                    best = (cost, at);
                }
            }
        }
        self.taken.push(about(best.1, half));
        best.1
    }
}

fn about(at: [f64; 2], half: [f64; 2]) -> Box {
    [at[0] - half[0], at[1] - half[1], at[0] + half[0], at[1] + half[1]]
}

fn meet(a: &Box, b: &Box) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// Excess of a box beyond another one [px].
fn beyond(a: &Box, within: &Box) -> f64 {
    let over = |v: f64| v.max(0.0);
    over(within[0] - a[0]) + over(within[1] - a[1]) + over(a[2] - within[2]) + over(a[3] - within[3])
}

/// Middles of words that have wanted heights but need room, in the order given, each with its height: the least sum of
/// squares of displacements (pool adjacent violators).
pub(crate) fn spread(wanted: &[(f64, f64)]) -> Vec<f64> {
    // Without the room that the words before need, the heights must only not fall.
    let mut before = 0.0;
    let mut offsets = Vec::with_capacity(wanted.len());
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (i, &(at, height)) in wanted.iter().enumerate() {
        if i > 0 {
            before += (wanted[i - 1].1 + height) / 2.0;
        }
        offsets.push(before);
        pools.push((at - before, 1));
        while let [.., (a, n), (b, m)] = pools[..]
            && a > b
        {
            let (sum, count) = (a * n as f64 + b * m as f64, n + m);
            pools.truncate(pools.len() - 2);
            pools.push((sum / count as f64, count));
        }
    }
    let tops = pools.into_iter().flat_map(|(v, n)| std::iter::repeat_n(v, n));
    tops.zip(offsets).map(|(v, o)| v + o).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn names_of_one_place_do_not_lie_on_each_other() {
        let mut labels = Labels::new([0.0, 0.0, 300.0, 300.0]);
        labels.keep_off_line(&[[50.0, 50.0], [100.0, 100.0]], 1);
        for _ in 0..6 {
            labels.beside(40.0, [100.0, 100.0]);
        }
        for (i, a) in labels.taken.iter().enumerate() {
            assert!(labels.taken[..i].iter().all(|b| !meet(a, b)));
            assert!(!meet(a, &about([100.0, 100.0], [2.0; 2])));
        }
        assert_eq!(labels.taken.len(), 6);
    }

    #[test]
    fn a_word_takes_the_first_free_place_or_none() {
        let mut labels = Labels::new([0.0, 0.0, 100.0, 30.0]);
        let places = [[50.0, 8.0], [50.0, 22.0]];
        assert_eq!(labels.first("word", places), Some(places[0]));
        assert_eq!(labels.first("word", places), Some(places[1]));
        assert_eq!(labels.first("word", places), None);
        assert_eq!(labels.first("word", [[5.0, 8.0]]), None, "it would leave the box");
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn words_of_a_column_keep_their_room_and_order(
            wanted in proptest::collection::vec((0.0..400.0f64, 10.0..40.0f64), 1..12)
        ) {
            let mut wanted = wanted;
            wanted.sort_by(|a, b| a.0.total_cmp(&b.0));
            let at = spread(&wanted);
            for i in 1..at.len() {
                let room = (wanted[i - 1].1 + wanted[i].1) / 2.0;
                prop_assert!(at[i] - at[i - 1] >= room - 1e-9);
            }
        }
    }
}
