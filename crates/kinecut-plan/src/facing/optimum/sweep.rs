//! The least value of a sum of piecewise linear functions, some with jumps, by one sweep over their sorted breaks.

/// A break of the sum.
#[derive(Clone, Copy, Debug)]
struct Break {
    at: f64,
    /// Growth of the slope here.
    slope: f64,
    /// Growth of the value here.
    jump: f64,
}

/// A sum on an interval, gathered function after function, then minimised. Reused without allocation.
#[derive(Clone, Debug, Default)]
pub(super) struct Sweep {
    from: f64,
    to: f64,
    value: f64,
    slope: Sum,
    breaks: Vec<Break>,
}

/// A sum with its rounding error: a steep ramp that ends leaves nothing behind.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    value: f64,
    error: f64,
}

impl Sum {
    #[inline]
    fn add(&mut self, x: f64) {
        let sum = self.value + x;
        let back = sum - self.value;
        self.error += (self.value - (sum - back)) + (x - back);
        self.value = sum;
    }

    #[inline]
    fn get(self) -> f64 {
        self.value + self.error
    }
}

/// The share of an edge above one line less that above another, over the offset: two ramps from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ramps {
    /// Offsets at which the upper end begins to be below its line, and at which all is.
    pub(super) rise: [f64; 2],
    /// The same for the lower line.
    pub(super) fall: [f64; 2],
}

impl Ramps {
    /// Share that lies between the lines at an offset, not negative.
    #[inline]
    pub(super) fn share(&self, at: f64) -> f64 {
        let share = ramp(at, self.rise) - ramp(at, self.fall);
        if share > 0.0 { share } else { 0.0 }
    }
}

/// From 0 at the first to 1 at the second.
#[inline]
fn ramp(at: f64, ends: [f64; 2]) -> f64 {
    if at <= ends[0] {
        0.0
    } else if at >= ends[1] {
        1.0
    } else {
        (at - ends[0]) / (ends[1] - ends[0])
    }
}

impl Sweep {
    /// Begins anew on the interval.
    pub(super) fn begin(&mut self, from: f64, to: f64) {
        self.breaks.clear();
        (self.from, self.to, self.value, self.slope) = (from, to, 0.0, Sum::default());
    }

    /// Adds `weight` inside of the open interval, 0 at its ends and outside.
    pub(super) fn add_window(&mut self, weight: f64, [start, end]: [f64; 2]) {
        if !(start < end) || end <= self.from || start >= self.to {
            return;
        }
        if start < self.from {
            self.value += weight;
        } else {
            self.breaks.push(Break { at: start, slope: 0.0, jump: weight });
        }
        if end <= self.to {
            self.breaks.push(Break { at: end, slope: 0.0, jump: -weight });
        }
    }

    /// Adds `weight` times the share of the ramps.
    pub(super) fn add_ramps(&mut self, weight: f64, ramps: &Ramps) {
        let Ramps { rise: [r0, r1], fall: [f0, f1] } = *ramps;
        if f1 <= self.from || r0 >= self.to || (r0 >= f0 && r1 >= f1) {
            return;
        }
        self.value += weight * ramps.share(self.from);
        let (up, down) = (weight / (r1 - r0), weight / (f1 - f0));
        if r0 <= f0 && r1 <= f1 {
            self.slope_change(r0, up);
            self.slope_change(r1, -up);
            self.slope_change(f0, -down);
            self.slope_change(f1, down);
            return;
        }
        // The ramps cross between their beginnings and ends; beyond the crossing, on one side, the share is 0.
        let meet = (up * r0 - down * f0) / (up - down);
        if r0 < f0 {
            let meet = meet.clamp(f0, f1);
            self.slope_change(r0, up);
            self.slope_change(f0, -down);
            self.slope_change(meet, down - up);
        } else {
            let meet = meet.clamp(r0, r1);
            self.slope_change(meet, up - down);
            self.slope_change(r1, -up);
            self.slope_change(f1, down);
        }
    }

    #[inline]
    fn slope_change(&mut self, at: f64, by: f64) {
        if at <= self.from {
            self.slope.add(by);
        } else if at < self.to {
            self.breaks.push(Break { at, slope: by, jump: 0.0 });
        }
    }

    /// The least value and where it is taken.
    pub(super) fn least(&mut self) -> (f64, f64) {
        // At one place the jumps upwards come last: in between the value is the one at the place itself.
        self.breaks.sort_unstable_by(|a, b| a.at.total_cmp(&b.at).then(a.jump.total_cmp(&b.jump)));
        let (mut at, mut value, mut slope) = (self.from, self.value, self.slope);
        let mut best = (value, at);
        for b in &self.breaks {
            value += slope.get() * (b.at - at);
            at = b.at;
            if b.jump <= 0.0 {
                value += b.jump;
            }
            if value < best.0 {
                best = (value, at);
            }
            if b.jump > 0.0 {
                value += b.jump;
            }
            slope.add(b.slope);
        }
        value += slope.get() * (self.to - at);
        if value < best.0 { (value, self.to) } else { best }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        /// Against the functions' definitions at every break and near it.
        #[test]
        fn the_sweep_finds_the_least_value(
            ramps in prop::collection::vec((0.0..10.0f64, 0.001..4.0f64, 0.0..10.0f64, 0.001..4.0f64, 0.1..3.0f64), 0..8),
            windows in prop::collection::vec((0.0..10.0f64, 0.0..3.0f64, 0.1..3.0f64), 0..6),
            from in 0.0..5.0f64, length in 0.0..6.0f64,
        ) {
            let to = from + length;
            let mut sweep = Sweep::default();
            sweep.begin(from, to);
            let ramps: Vec<(Ramps, f64)> = ramps
                .iter()
                .map(|&(a, da, b, db, w)| (Ramps { rise: [a, a + da], fall: [b, b + db] }, w))
                .collect();
            ramps.iter().for_each(|(r, w)| sweep.add_ramps(*w, r));
            windows.iter().for_each(|&(a, d, w)| sweep.add_window(w, [a, a + d]));
            let value = |c: f64| {
                let up = |c: f64, [a, b]: [f64; 2]| ((c - a) / (b - a)).clamp(0.0, 1.0);
                let r: f64 = ramps.iter().map(|(r, w)| w * (up(c, r.rise) - up(c, r.fall)).max(0.0)).sum();
                r + windows.iter().filter(|x| x.0 < c && c < x.0 + x.1).map(|x| x.2).sum::<f64>()
            };
            let mut places = vec![from, to];
            places.extend(ramps.iter().flat_map(|(r, _)| [r.rise, r.fall]).flatten());
            places.extend(windows.iter().flat_map(|x| [x.0, x.0 + x.1]));
            places.extend((0..2000).map(|k| from + length * f64::from(k) / 2000.0));
            let brute = places.iter().filter(|c| (from..=to).contains(*c)).map(|&c| value(c)).fold(f64::MAX, f64::min);
            let (least, at) = sweep.least();
            prop_assert!((from..=to).contains(&at));
            prop_assert!(least <= brute + 1e-9, "{least} {brute}");
            // The least value is taken, up to the rounding of a jump's place.
            let near = [at, at - 1e-12, at + 1e-12].map(value).into_iter().fold(f64::MAX, f64::min);
            prop_assert!(near <= least + 1e-7, "{near} {least}");
        }
    }

    #[test]
    fn a_steep_ramp_leaves_nothing_behind() {
        let mut sweep = Sweep::default();
        sweep.begin(0.0, 100.0);
        for k in 1..50 {
            let at = f64::from(k) * 0.7;
            sweep.add_ramps(7.0, &Ramps { rise: [at, at + 1e-10], fall: [90.0 + 0.1 * f64::from(k), 99.0] });
        }
        sweep.add_window(1.0, [50.0, 51.0]);
        let (least, at) = sweep.least();
        assert!(least.abs() < 1e-9 && !(1.0..=98.0).contains(&at), "{least} {at}");
        let mut sweep = Sweep::default();
        sweep.begin(0.0, 100.0);
        sweep.add_ramps(7.0, &Ramps { rise: [1.0, 1.0 + 1e-11], fall: [200.0, 201.0] });
        sweep.add_window(9.0, [-1.0, 2.0]);
        assert!((sweep.least().0 - 7.0).abs() < 1e-12);
    }
}
