//! The moments that a playback tells apart.

/// Most ticks: they are told in 16 bits, with two of their numbers kept for what never was and for what remains.
const MOST: f64 = 60_000.0;

/// The time of a playback: the way of the tools on moves that may take material, in ticks of one length. Fast and slow moves count alike,
/// so that material goes in even steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Clock {
    /// The way before each move, and last that of all [mm].
    starts: Vec<f64>,
    ticks: u16,
}

impl Clock {
    /// `ways`: of each move the length of its way, 0 for one that takes nothing whatever comes [mm]. `tick`: length of a tick [mm]; it
    /// becomes longer where 16 bits do not suffice.
    pub fn new(ways: impl IntoIterator<Item = f64>, tick: f64) -> Clock {
        let mut starts = vec![0.0];
        let mut sum = 0.0;
        for way in ways {
            sum += if way.is_finite() { way.max(0.0) } else { 0.0 };
            starts.push(sum);
        }
        Clock { starts, ticks: (sum / tick).ceil().clamp(1.0, MOST) as u16 }
    }

    /// Number of ticks.
    pub fn ticks(&self) -> u16 {
        self.ticks
    }

    /// Part of all the way that is done at a fraction of a move, from 0 to 1. Material that goes in the tick `n` is there up to
    /// `(n - 1/2) / ticks`.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::stock::cut::Clock;
    /// let clock = Clock::new([30.0, 0.0, 70.0], 1.0);
    /// assert_eq!((clock.ticks(), clock.done(0, 0.5), clock.done(2, 0.5)), (100, 0.15, 0.65));
    /// ```
    pub fn done(&self, number: usize, fraction: f64) -> f64 {
        let last = self.starts.len() - 1;
        let all = self.starts[last];
        if number >= last || all == 0.0 {
            return 1.0;
        }
        (self.starts[number] + (self.starts[number + 1] - self.starts[number]) * fraction) / all
    }

    /// The tick at a fraction of a move, from 1 on.
    pub(super) fn tick(&self, number: usize, fraction: f64) -> u16 {
        ((self.done(number, fraction) * f64::from(self.ticks)) as u16).min(self.ticks - 1) + 1
    }
}
