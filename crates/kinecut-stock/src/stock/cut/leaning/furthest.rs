//! The furthest end of the chords of a line over a time: by branch and bound between looks.
//!
//! The rate of an end is `ds/dt = (n . v) / (n . d)`. Between two looks an end goes no further than their tangents, but for what the
//! turn of the tool and the bend of its way add.

use super::look::{Look, Met};

/// Accuracy of an end on its line [mm]: a tenth of an end point's rounding.
const CLOSE: f64 = 1e-6;

/// Way that bend and turn may add to an end, square to the face, without a further look [mm]: half of an end point's rounding.
const FINE: f64 = 5e-6;

/// Part of a span's time that is not parted further.
const SHORTEST: f64 = 1e-9;

/// Steps after which the best of an end is taken as it is.
const STEPS: usize = 48;

/// A search for the furthest end.
struct Search {
    best: Met,
    upper: bool,
    /// Cost at which all of the material is covered.
    enough: f64,
    /// Looks that are left.
    steps: usize,
}

impl Look<'_> {
    /// The furthest end of the chords at the times around looks in their order.
    pub(super) fn furthest(&self, mets: &[Met], around: [f64; 2], upper: bool) -> Option<Met> {
        let further = |a: Met, b: Met| if b.cost(upper).0 < a.cost(upper).0 { b } else { a };
        let best = mets.iter().copied().reduce(further)?;
        let [low, high] = self.line.material;
        let enough = if upper { -high } else { low };
        let mut search = Search { best, upper, enough, steps: STEPS };
        let (first, last) = (&mets[0], &mets[mets.len() - 1]);
        self.search([None, Some(first)], [around[0], first.t], &mut search);
        for pair in mets.windows(2) {
            self.search([Some(&pair[0]), Some(&pair[1])], [pair[0].t, pair[1].t], &mut search);
        }
        self.search([Some(last), None], [last.t, around[1]], &mut search);
        Some(search.best)
    }

    /// A bound on the cost of the furthest end at the times around looks.
    pub(super) fn least_of(&self, mets: &[Met], around: [f64; 2], upper: bool) -> f64 {
        let search = Search { best: mets[0], upper, enough: f64::NEG_INFINITY, steps: 0 };
        let between = |ends, times: [f64; 2]| {
            let least = self.least_end(ends, times, &search).map_or(f64::INFINITY, |(least, _)| least);
            // Not a number bounds nothing.
            if times[1] > times[0] && least.is_nan() { f64::NEG_INFINITY } else { least }
        };
        let (first, last) = (&mets[0], &mets[mets.len() - 1]);
        let mut all = between([None, Some(first)], [around[0], first.t]);
        all = all.min(between([Some(last), None], [last.t, around[1]]));
        for pair in mets.windows(2) {
            all = all.min(between([Some(&pair[0]), Some(&pair[1])], [pair[0].t, pair[1].t]));
        }
        mets.iter().map(|met| met.cost(upper).0).fold(all, f64::min)
    }

    /// Looks for a further end between two times, with the looks there; `None` where the line is not met.
    fn search(&self, ends: [Option<&Met>; 2], [from, to]: [f64; 2], search: &mut Search) {
        let upper = search.upper;
        let best = search.best.cost(upper).0;
        if !(to - from > SHORTEST) || search.steps == 0 || best <= search.enough {
            return;
        }
        let Some((least, next)) = self.least_end(ends, [from, to], search) else { return };
        if least >= best - CLOSE {
            return;
        }
        search.steps -= 1;
        let margin = 1e-3 * (to - from);
        let next = next.clamp(from + margin, to - margin);
        let met = self.at(next);
        if let Some(m) = met
            && m.cost(upper).0 < best
        {
            search.best = m;
        }
        let halves = [([ends[0], met.as_ref()], [from, next]), ([met.as_ref(), ends[1]], [next, to])];
        // The half in which the end goes on first.
        let rises = met.is_none_or(|m| m.cost(upper).1 > 0.0);
        for (ends, times) in if rises { halves } else { [halves[1], halves[0]] } {
            self.search(ends, times, search);
        }
    }

    /// The least cost of an end that is possible between two looks, and the time to look at next; `None` where there is nothing to
    /// be found.
    ///
    /// On a straight way the cost is convex in time, above its tangents. The bend of the way may take from a tangent what goes with
    /// the square of the time from it, and so may the turn, by the way of the end; both are the longer along the line the less that
    /// slants through the face.
    fn least_end(
        &self,
        ends: [Option<&Met>; 2],
        [from, to]: [f64; 2],
        search: &Search,
    ) -> Option<(f64, f64)> {
        let (upper, apart, middle) = (search.upper, to - from, 0.5 * (from + to));
        let turn = self.of.poses[1].axis_rate.length();
        let slant = |met: &Met| (met.slant[usize::from(upper)], met.bends[usize::from(upper)]);
        // The way that may be missing some time from a look, at a rate of the end; without bound where the face may turn so far that
        // the line lies in it.
        let missing = |rate: f64, (slant, bend): (f64, f64), apart: f64| {
            let off = (4.0 * bend + turn * rate.abs()) * apart * apart - FINE;
            let slant = slant - turn * apart;
            if !(off > 0.0) {
                0.0
            } else if slant > 0.0 {
                off / slant
            } else {
                f64::INFINITY
            }
        };
        // The least on the way from a look to the other end: what falls so is least at one of them.
        let from_look = |(cost, rate): (f64, f64), slant: (f64, f64), way: f64| {
            let other = cost + rate * way - missing(rate, slant, apart);
            // Not a number, or no end of it: look there.
            if other < cost || !other.is_finite() { other } else { cost }
        };
        match ends {
            [Some(a), Some(b)] => {
                let (first, last) = (a.cost(upper), b.cost(upper));
                let ((ca, ga), (cb, gb)) = (first, last);
                if !(ga < 0.0 && gb > 0.0) {
                    let (x, y) = (from_look(first, slant(a), apart), from_look(last, slant(b), -apart));
                    return Some((if x > y { x } else { y }, middle));
                }
                // No lower than where the tangents meet.
                let meet = ((cb - ca) + ga * from - gb * to) / (ga - gb);
                // A cubic where the chords change smoothly, the tangents at an edge; the middle in case.
                let next = match (STEPS - search.steps) % 4 {
                    1 => meet,
                    3 => middle,
                    _ => hermite([from, to], [ca, cb], [ga, gb]).unwrap_or(meet),
                };
                let rate = if -ga > gb { ga } else { gb };
                let (x, y) = (slant(a), slant(b));
                let least = ca + ga * (meet - from) - missing(rate, (x.0.min(y.0), x.1.max(y.1)), apart);
                Some((least, if next.is_finite() { next } else { middle }))
            }
            [Some(a), None] => Some((from_look(a.cost(upper), slant(a), apart), middle)),
            [None, Some(b)] => Some((from_look(b.cost(upper), slant(b), -apart), middle)),
            [None, None] => None,
        }
    }
}

/// The least place, between two places, of the cubic that has their values and slopes: it falls at the first and rises at the second.
fn hermite([a, b]: [f64; 2], [ca, cb]: [f64; 2], [ga, gb]: [f64; 2]) -> Option<f64> {
    let d = ga + gb - 3.0 * (ca - cb) / (a - b);
    let root = (d * d - ga * gb).sqrt();
    let t = b - (b - a) * (gb + root - d) / (gb - ga + 2.0 * root);
    t.is_finite().then_some(t)
}
