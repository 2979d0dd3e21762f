//! Some of the lines of a stock: those through the points of a coarser lattice, which are points of its own.

use super::{Axis, Lattice};

/// Every so manieth line of a lattice, along all axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sieve {
    lattice: Lattice,
    every: u32,
    /// Index of the first point along each axis: about half of those left out come before it.
    first: [u32; 3],
}

impl Sieve {
    /// A sieve of a lattice; `every` is 1 or more.
    pub(super) fn new(lattice: &Lattice, every: u32) -> Sieve {
        let every = every.max(1);
        let first = lattice.counts.map(|n| (every / 2).min(n.saturating_sub(1) / 2));
        Sieve { lattice: *lattice, every, first }
    }

    /// All lines of a lattice.
    pub(super) fn all(lattice: &Lattice) -> Sieve {
        Sieve::new(lattice, 1)
    }

    /// The lattice of the lines that are left.
    pub(super) fn lattice(&self) -> Lattice {
        let [i, j, k] = self.first;
        let count = |axis: usize| (self.lattice.counts[axis] - self.first[axis]).div_ceil(self.every);
        Lattice {
            origin: self.lattice.point(i, j, k),
            step: self.lattice.step * f64::from(self.every),
            counts: [0, 1, 2].map(count),
        }
    }

    /// Distance of the lines that are left, counted in lines.
    pub(super) fn every(&self) -> i64 {
        self.every.into()
    }

    /// The lattice of all lines.
    pub(super) fn whole(&self) -> &Lattice {
        &self.lattice
    }

    /// Index among all points along an axis of a point that is left.
    pub(super) fn whole_index(&self, axis: Axis, index: u32) -> u32 {
        self.first[axis.index()] + index * self.every
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_are_left_are_points_of_the_lattice_and_end_no_more_than_a_step_before_it() {
        let lattice = Lattice { origin: glam::DVec3::new(0.05, -3.0, 7.0), step: 0.1, counts: [1000, 7, 1] };
        for every in [1, 2, 3, 8] {
            let sieve = Sieve::new(&lattice, every);
            let coarse = sieve.lattice();
            for axis in Axis::ALL {
                let n = coarse.counts[axis.index()];
                for i in 0..n {
                    let whole = sieve.whole_index(axis, i);
                    assert!((lattice.coordinate(axis, whole) - coarse.coordinate(axis, i)).abs() < 1e-12);
                }
                let last = sieve.whole_index(axis, n - 1);
                assert!(last < lattice.counts[axis.index()] && lattice.counts[axis.index()] - last <= every);
            }
        }
    }
}
