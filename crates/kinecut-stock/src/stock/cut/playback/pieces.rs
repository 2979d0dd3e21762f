//! Pieces of lines by the tick in which they go.

use crate::stock::tile::TILE_LINES;

/// A piece of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Piece {
    /// Its ends [fixed steps].
    pub(super) ends: [i32; 2],
    /// Index of the line in its tile.
    pub(super) line: u16,
    pub(super) tick: u16,
}

/// Pieces from which on a tile is put in order before more come.
const MANY: usize = 4096;

/// All pieces of a tile.
#[derive(Clone, Debug, Default)]
pub(super) struct TilePieces {
    pieces: Vec<Piece>,
    /// Pieces from which on they are put in order again.
    limit: usize,
}

impl TilePieces {
    /// Adds some; `thin`: thickness below which a piece may go with the one beside it [fixed steps].
    pub(super) fn add(&mut self, more: Vec<Piece>, thin: i32) {
        self.pieces.extend(more);
        if self.pieces.len() > self.limit.max(MANY) {
            self.order(thin);
            self.limit = 2 * self.pieces.len();
        }
    }

    /// Sorts the pieces by line and place. Those that touch become one where they go in one tick, or where one of them is thin: then it
    /// goes with the other.
    fn order(&mut self, thin: i32) {
        self.pieces.sort_unstable_by_key(|piece| (piece.line, piece.ends, piece.tick));
        self.pieces.dedup_by(|next, last| {
            let is_thin = |piece: &Piece| piece.ends[1].saturating_sub(piece.ends[0]) < thin;
            let touch = next.line == last.line && next.ends[0] <= last.ends[1];
            let is_one = touch && (next.tick == last.tick || is_thin(next) || is_thin(last));
            if is_one {
                last.tick = if is_thin(last) { next.tick } else { last.tick };
                last.ends[1] = last.ends[1].max(next.ends[1]);
            }
            is_one
        });
    }

    /// The pieces in order, with what remains.
    pub(super) fn with_rest(mut self, rest: impl Iterator<Item = Piece>, thin: i32) -> TileLinePieces {
        self.order(thin);
        self.pieces.extend(rest);
        self.pieces.sort_unstable_by_key(|piece| (piece.line, piece.ends));
        let mut starts = vec![0; TILE_LINES + 1];
        for piece in &self.pieces {
            starts[piece.line as usize + 1] += 1;
        }
        for line in 0..TILE_LINES {
            starts[line + 1] += starts[line];
        }
        TileLinePieces { pieces: self.pieces, starts }
    }
}

/// The pieces of the lines of a tile.
#[derive(Clone, Debug)]
pub(super) struct TileLinePieces {
    pieces: Vec<Piece>,
    starts: Vec<u32>,
}

impl TileLinePieces {
    /// Pieces of a line in order.
    pub(super) fn line(&self, line: usize) -> &[Piece] {
        &self.pieces[self.starts[line] as usize..self.starts[line + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_that_go_together_become_one() {
        let piece = |line: u16, from: i32, to: i32, tick: u16| Piece { ends: [from, to], line, tick };
        let mut tile = TilePieces::default();
        tile.add(vec![piece(3, 20, 30, 5), piece(3, 0, 10, 5), piece(2, 0, 10, 5)], 3);
        tile.add(vec![piece(3, 10, 20, 5), piece(3, 30, 32, 7), piece(3, 40, 42, 9), piece(3, 50, 90, 2)], 3);
        let tile = tile.with_rest([piece(3, 42, 50, u16::MAX)].into_iter(), 3);
        assert_eq!(tile.line(2), [piece(2, 0, 10, 5)]);
        // A thin one goes with its neighbour; one alone stays.
        let kept = [piece(3, 0, 32, 5), piece(3, 40, 42, 9), piece(3, 42, 50, u16::MAX), piece(3, 50, 90, 2)];
        assert_eq!(tile.line(3), kept);
    }
}
