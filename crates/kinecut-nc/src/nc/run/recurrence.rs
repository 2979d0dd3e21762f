//! Programs that come back to where they were.
//!
//! A program whose variables, position and calls are at a jump what they were at that jump before runs for ever. The state
//! is kept as a number of 128 bits and compared with one from before, which is renewed at each power of two (R. P. Brent,
//! "An improved Monte Carlo factorization algorithm", 1980): a circle of n jumps is found within 3 n.

/// The state at jumps backwards.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::nc) struct Recurrence {
    /// The part of the state that mostly changes, and the whole state.
    kept: Option<(u128, u128)>,
    steps: u64,
    limit: u64,
}

impl Recurrence {
    /// Whether a state is one that was there before; the whole of it is asked for only where its part is the same.
    pub(in crate::nc) fn is_back(&mut self, part: u128, whole: impl FnOnce() -> u128) -> bool {
        let same = self.kept.filter(|kept| kept.0 == part);
        let renewed = self.steps == self.limit;
        if same.is_some() || renewed {
            let whole = whole();
            if same.is_some_and(|kept| kept.1 == whole) {
                return true;
            }
            if renewed {
                self.kept = Some((part, whole));
            }
        }
        if renewed {
            self.steps = 0;
            self.limit = (2 * self.limit).max(1);
        }
        self.steps += 1;
        false
    }
}

/// A number mixed from a place and the bits of what is there.
pub(in crate::nc) fn mixed(place: u64, bits: u64) -> u128 {
    let half = |salt: u64| {
        // The finaliser of SplitMix64 (S. Vigna), once for each half and once for both.
        let mut z = (place ^ salt).wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(bits);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    };
    u128::from(half(0x5851_F42D_4C95_7F2D)) << 64 | u128::from(half(0x1405_7B7E_F767_814F))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_is_found_and_a_straight_way_is_not() {
        for lead in [0u64, 1, 7, 100] {
            for circle in [1u64, 2, 5, 64] {
                let mut seen = Recurrence::default();
                let at = |i: u64| mixed(0, if i < lead { i } else { lead + (i - lead) % circle });
                let back = |i| seen.is_back(mixed(1, at(i) as u64 % 3), || at(i));
                let found = (0..).position(back).unwrap() as u64;
                assert!(found <= 3 * (lead + circle) + 2, "{lead} {circle} {found}");
            }
        }
        let mut seen = Recurrence::default();
        assert!((0..10_000).all(|i| !seen.is_back(7, || mixed(1, i))));
    }
}
