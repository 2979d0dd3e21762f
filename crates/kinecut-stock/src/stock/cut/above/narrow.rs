//! Whole numbers of which most are small.

/// Whole numbers, each in as few bytes as the greatest of them needs.
#[derive(Clone, Debug)]
pub(super) enum Narrow {
    One(Box<[u8]>),
    Two(Box<[u16]>),
    Four(Box<[u32]>),
}

impl Narrow {
    /// The numbers of a list.
    pub(super) fn of(all: &[u32]) -> Narrow {
        let greatest = all.iter().copied().fold(0, u32::max);
        // Nothing is lost: none is greater.
        match greatest {
            0..=0xff => Narrow::One(all.iter().map(|n| *n as u8).collect()),
            0x100..=0xffff => Narrow::Two(all.iter().map(|n| *n as u16).collect()),
            _ => Narrow::Four(all.into()),
        }
    }

    /// The number at an index.
    #[inline(always)]
    pub(super) fn get(&self, index: usize) -> u32 {
        match self {
            Narrow::One(all) => u32::from(all[index]),
            Narrow::Two(all) => u32::from(all[index]),
            Narrow::Four(all) => all[index],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_from_each_width() {
        for greatest in [0, 0xff, 0x100, 0xffff, 0x1_0000, u32::MAX] {
            let all = [0, greatest / 3, greatest, 1.min(greatest)];
            let narrow = Narrow::of(&all);
            assert_eq!(all.map(|n| n), std::array::from_fn(|i| narrow.get(i)), "{greatest}");
        }
        assert!(matches!(Narrow::of(&[255]), Narrow::One(_)) && matches!(Narrow::of(&[256]), Narrow::Two(_)));
    }
}
