//! The pieces of moves that went lowest on the lines of a patch.

/// The number of a move, and that of its piece.
pub(super) type Mover = (u32, u16);

/// Pieces of moves, each once, in the order in which they were found.
pub(super) struct Movers {
    all: Vec<Mover>,
    /// By a hash of the piece, its index and one, in the first place from there on that is free; 0 where none is.
    places: Box<[u16; PLACES]>,
    /// The one asked for last, and its index: neighbours mostly have the same.
    last: (Mover, u16),
}

/// More than twice as many as a patch has lines.
const PLACES: usize = 2048;

impl Movers {
    pub(super) fn new() -> Movers {
        Movers { all: Vec::new(), places: Box::new([0; PLACES]), last: ((u32::MAX, u16::MAX), u16::MAX) }
    }

    /// The index of a piece, of which there are no more than lines in a patch.
    pub(super) fn index(&mut self, mover: Mover) -> u16 {
        if mover == self.last.0 && self.last.1 != u16::MAX {
            return self.last.1;
        }
        let hash = (mover.0 ^ u32::from(mover.1) << 16).wrapping_mul(0x9e37_79b1);
        let mut place = (hash >> 21) as usize;
        let index = loop {
            match self.places[place] {
                0 => {
                    self.all.push(mover);
                    self.places[place] = self.all.len() as u16;
                    break self.all.len() as u16 - 1;
                }
                found if self.all[usize::from(found) - 1] == mover => break found - 1,
                _ => place = (place + 1) % PLACES,
            }
        };
        self.last = (mover, index);
        index
    }

    /// All of them by index.
    pub(super) fn into_all(self) -> Box<[Mover]> {
        self.all.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_has_one_index() {
        let mut movers = Movers::new();
        let of = |i: u32| (i % 961 * 2048, (i % 3) as u16);
        let first: Vec<u16> = (0..961).map(|i| movers.index(of(i))).collect();
        assert!(first.iter().copied().eq(0..961));
        assert!((0..961).rev().all(|i| movers.index(of(i)) == first[i as usize]));
        let all = movers.into_all();
        assert!(all.iter().copied().eq((0..961).map(of)));
    }
}
