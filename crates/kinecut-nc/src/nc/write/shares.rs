//! The time of a move in inverse time, shared by the blocks that it is written in.
//!
//! `G93` gives the time of a block. A curve that a control takes in several blocks (turns of a helix, arcs of a chain, chords) is
//! written twice: once to find the blocks and their lengths, as the control will run them, and then with the time of each,
//! in proportion to its length. A move of one block is written once and has its own number.

use crate::base::Result;
use crate::program::Speed;

use super::Writer;

/// Largest number of an inverse time [1/min]: seven digits, more than the shortest block of a program needs.
const MOST_RATE: f64 = 9_999_999.0;

/// Blocks of a move.
#[derive(Clone, Debug)]
pub(super) enum Shares {
    /// Their lengths, while they are measured [mm].
    Lengths(Vec<f64>),
    /// The times of those to come [s].
    Times(std::vec::IntoIter<f64>),
}

/// The time of each block [s], in proportion to its length; one that is too short for the number of its time takes the least
/// time that has one, from the others.
fn times(lengths: &[f64], seconds: f64) -> Vec<f64> {
    let least = 60.0 / MOST_RATE;
    let total: f64 = lengths.iter().sum();
    let count = lengths.len() as f64;
    let share = |length: f64| if total > 0.0 { seconds * (length / total) } else { seconds / count };
    let is_short = |length: &&f64| share(**length) < least;
    let short = least * lengths.iter().filter(is_short).count() as f64;
    // There is nothing to take from where all are short.
    if 2.0 * short >= seconds || total <= 0.0 {
        return lengths.iter().map(|length| share(*length)).collect();
    }
    let long: f64 = lengths.iter().filter(|l| !is_short(l)).sum();
    let time = |l: &f64| if is_short(&l) { least } else { (seconds - short) * (l / long) };
    lengths.iter().map(time).collect()
}

impl Shares {
    /// Whether a move became more than one block.
    fn are_several(&self) -> bool {
        matches!(self, Shares::Lengths(lengths) if lengths.len() > 1)
    }
}

impl Writer<'_> {
    /// Writes a move that takes `seconds`, which its blocks share; `write` may be called twice.
    pub(super) fn in_shared_time(
        &mut self,
        seconds: f64,
        write: impl Fn(&mut Self) -> Result<()>,
    ) -> Result<()> {
        let (modal, place, notes) = (self.modal.clone(), self.place, self.notes);
        let (pending, lines) = (self.length_pending.clone(), self.page.len());
        self.shares = Some(Shares::Lengths(Vec::new()));
        let done = write(self);
        let measured = self.shares.take();
        done?;
        let Some(Shares::Lengths(lengths)) = measured.filter(Shares::are_several) else { return Ok(()) };
        (self.modal, self.place, self.notes, self.length_pending) = (modal, place, notes, pending);
        self.page.truncate(lines);
        self.shares = Some(Shares::Times(times(&lengths, seconds).into_iter()));
        let done = write(self);
        self.shares = None;
        done
    }

    /// The speed of a block of this length [mm], which may be a part of a move.
    pub(super) fn timed(&mut self, speed: Speed, length: f64) -> Speed {
        match (&mut self.shares, speed) {
            (Some(Shares::Lengths(lengths)), Speed::Duration(_)) => {
                lengths.push(length);
                speed
            }
            (Some(Shares::Times(times)), Speed::Duration(_)) => times.next().map_or(speed, Speed::Duration),
            _ => speed,
        }
    }

    /// Length of the straight move from these counts to the present ones [mm].
    pub(super) fn straight_length(&self, before: [Option<i64>; 3]) -> f64 {
        let counts = before.into_iter().zip(self.place.written);
        let mut way = [0.0; 3];
        for (way, (from, to)) in way.iter_mut().zip(counts) {
            *way = from.zip(to).map_or(0.0, |(from, to)| self.grid.value(to) - self.grid.value(from));
        }
        if let (Some(beside), [Some(x), Some(y), _]) = (self.modal.pen.beside, self.place.written) {
            way[0] = self.grid.value(x) - beside.x;
            way[1] = self.grid.value(y) - beside.y;
        }
        glam::DVec3::from_array(way).length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_in_proportion_and_add_up() {
        assert_eq!(times(&[1.0, 2.0, 5.0], 4.0), [0.5, 1.0, 2.5]);
        // A micrometre behind a metre: a number of seven digits, and the sum stays.
        let found = times(&[1e3, 1e-6], 0.1);
        assert!(
            60.0 / found[1] <= MOST_RATE + 1e-6 && (found[0] + found[1] - 0.1).abs() < 1e-15,
            "{found:?}"
        );
        // Too short altogether.
        assert_eq!(times(&[1.0, 1.0], 2e-9), [1e-9, 1e-9]);
    }
}
