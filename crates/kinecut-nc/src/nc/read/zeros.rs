//! Zeros of the work offsets, as far as the program has set them or the control has kept them.
//!
//! A zero without known machine coordinates may have a known distance from that of another work offset: `G10 L20` puts one where
//! the tool stands in the other.

use glam::DVec3;

use crate::program::WorkOffset;

/// A coordinate along an axis of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::nc) struct Spot {
    /// The work offset from whose zero, as the setup has it, it counts; `None` is machine zero.
    pub(super) from: Option<WorkOffset>,
    /// The coordinate [mm].
    pub(super) at: f64,
}

impl Spot {
    /// A machine coordinate.
    pub(super) fn machine(at: f64) -> Spot {
        Spot { from: None, at }
    }

    /// The machine coordinate, where it is known.
    pub(super) fn in_machine(self) -> Option<f64> {
        self.from.is_none().then_some(self.at)
    }

    /// Distance from another place, not a number where it is not known.
    pub(in crate::nc) fn minus(self, other: Spot) -> f64 {
        if self.from == other.from { self.at - other.at } else { f64::NAN }
    }
}

/// The zero of a work offset.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::nc) struct Zero {
    /// Place of the zero that the setup has, where that is known.
    pub(super) first: [Option<Spot>; 3],
    /// The zero that the program has set since, from that one [mm].
    pub(super) shift: DVec3,
}

/// Zeros of work offsets; `None` is what is added to all of them.
#[derive(Clone, Debug, Default)]
pub(in crate::nc) struct Zeros {
    known: Vec<(Option<WorkOffset>, Zero)>,
}

impl Zeros {
    /// The zero of a work offset, if the program has set it.
    pub(super) fn of(&self, offset: Option<WorkOffset>) -> Option<&Zero> {
        self.known.iter().find(|(o, _)| *o == offset).map(|(_, zero)| zero)
    }

    /// The zero of a work offset.
    pub(super) fn of_mut(&mut self, offset: Option<WorkOffset>) -> &mut Zero {
        let index = match self.known.iter().position(|(o, _)| *o == offset) {
            Some(index) => index,
            None => {
                self.known.push((offset, Zero::default()));
                self.known.len() - 1
            }
        };
        &mut self.known[index].1
    }

    /// Puts the zero that the setup has, along an axis; zeros that count from it stay where they are.
    pub(super) fn put(&mut self, offset: Option<WorkOffset>, axis: usize, spot: Spot) {
        let before = self.of_mut(offset).first[axis].replace(spot);
        let mut base = before;
        for (other, zero) in self.known.iter_mut().filter(|(o, _)| *o != offset) {
            let Some(from) = zero.first[axis].filter(|spot| offset.is_some() && spot.from == offset) else {
                continue;
            };
            zero.first[axis] = base.map(|base| Spot { from: base.from, at: base.at + from.at });
            // Of those that count from a zero without a place, the first becomes the one from which the others count.
            base = base.or(Some(Spot { from: *other, at: -from.at }));
        }
    }

    /// Shift of a work offset from the zero that the setup has [mm].
    pub(super) fn shift(&self, offset: WorkOffset) -> DVec3 {
        [Some(offset), None].into_iter().filter_map(|o| self.of(o)).map(|zero| zero.shift).sum()
    }

    /// All shifts and places of zeros, as numbers.
    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let first = |spot: Option<Spot>| spot.map_or(f64::NAN, |spot| spot.at);
        self.known
            .iter()
            .flat_map(move |(_, zero)| zero.shift.to_array().into_iter().chain(zero.first.map(first)))
    }

    /// Machine coordinate of the zero that the setup has, without what is added to all work offsets [mm].
    pub(super) fn in_machine(&self, offset: Option<WorkOffset>, axis: usize) -> Option<f64> {
        match offset {
            Some(offset) => self.spot(offset, axis).in_machine(),
            None => self.of(None)?.first[axis]?.in_machine(),
        }
    }

    /// Place of the zero that the setup has.
    pub(in crate::nc) fn first(&self, offset: WorkOffset) -> [Spot; 3] {
        [0, 1, 2].map(|axis| {
            let spot = self.spot(offset, axis);
            let all = self.of(None).and_then(|zero| zero.first[axis]).map_or(0.0, |all| all.at);
            Spot { at: spot.at + all, ..spot }
        })
    }

    /// Follows the distances from one zero to the next.
    fn spot(&self, offset: WorkOffset, axis: usize) -> Spot {
        let mut spot = Spot { from: Some(offset), at: 0.0 };
        // No zero is put where it counts from itself, so that each is met once.
        while let Some(next) = spot.from.and_then(|from| self.of(Some(from))?.first[axis]) {
            spot = Spot { from: next.from, at: spot.at + next.at };
        }
        spot
    }
}

/// A place known in part, as a vector that is not a number where it is not known.
pub(super) fn vector(place: [Option<f64>; 3]) -> DVec3 {
    DVec3::from_array(place.map(|v| v.unwrap_or(f64::NAN)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_are_found_over_other_zeros() {
        let of = |tenths| WorkOffset::from_tenths(tenths).unwrap();
        let (g54, g55, g56) = (of(540), of(550), of(560));
        let mut zeros = Zeros::default();
        zeros.put(Some(g55), 0, Spot { from: Some(g54), at: 10.0 });
        zeros.put(Some(g56), 0, Spot { from: Some(g55), at: 5.0 });
        let x = |zeros: &Zeros, offset| zeros.first(offset)[0];
        assert_eq!(x(&zeros, g56), Spot { from: Some(g54), at: 15.0 });
        assert_eq!(x(&zeros, g56).minus(x(&zeros, g55)), 5.0);
        assert!(zeros.first(g56)[1].minus(zeros.first(g54)[1]).is_nan());
        assert_eq!(zeros.in_machine(Some(g56), 0), None);
        let mut moved = zeros.clone();
        zeros.put(Some(g55), 0, Spot::machine(7.0));
        assert_eq!(x(&zeros, g56), Spot { from: Some(g54), at: 15.0 });
        assert_eq!((zeros.in_machine(Some(g55), 0), zeros.in_machine(Some(g54), 1)), (Some(7.0), None));
        // G55 and G56 counted from G54, and count from each other now.
        moved.put(Some(g54), 0, Spot::machine(100.0));
        assert_eq!(moved.in_machine(Some(g54), 0), Some(100.0));
        assert_eq!(x(&moved, g56).minus(x(&moved, g55)), 5.0);
        assert!(x(&moved, g56).minus(x(&moved, g54)).is_nan());
        // Two that counted from the same zero.
        let mut two = Zeros::default();
        two.put(Some(g55), 0, Spot { from: Some(g54), at: 10.0 });
        two.put(Some(g56), 0, Spot { from: Some(g54), at: 25.0 });
        two.put(Some(g54), 0, Spot::machine(100.0));
        assert_eq!(x(&two, g56), Spot { from: Some(g55), at: 15.0 });
    }
}
