//! A part goes through blocks: the tops of their lines and the ceilings of their ways become as low as it.

use glam::DVec2;
use pulp::NullaryFnOnce;

use super::super::field::rounded;
use super::super::round::Round;
use super::super::sweep::{BLOCK, Sweep, least, most};
use super::{BLOCKS, Blocks, HEIGHTS, Patch, SIDE, height_at, put_row, row_at};

impl Patch {
    /// Lets a part go through blocks, and tells what it takes, if that is asked for; its heights stay until they are forgotten.
    pub(in crate::stock::cut::above) fn sink(
        &mut self,
        sweep: &Sweep,
        blocks: Blocks,
        index: f64,
        tell: bool,
    ) -> [Sunk; BLOCKS] {
        if sweep.is_one_by_one() {
            self.raise_one_by_one(sweep, blocks);
            if self.between {
                self.sink_ceilings_one_by_one(sweep, blocks);
            }
        }
        self.arch.dispatch(Sink { patch: self, sweep, blocks, index, tell })
    }

    /// Lowers the tops of a block to the heights of a part; `TELL`: notes what is taken of each line.
    #[inline(always)]
    fn sink_tops<const TELL: bool>(&mut self, (c0, r0): (usize, usize), index: f64) -> Sunk {
        let (mut greatest, mut sum) = ([0.0; BLOCK], [0.0; BLOCK]);
        let mut lowest = [false; BLOCK];
        for r in r0..r0 + BLOCK {
            let start = r * SIDE + c0;
            let heights = row_at(&self.heights[..], height_at(r, c0));
            let (mut top, mut task) = (row_at(&self.top[..], start), row_at(&self.task[..], start));
            let bottom = row_at(&self.bottom[..], start);
            let mut overlap = [0.0; BLOCK];
            for c in 0..BLOCK {
                let at = most(rounded(heights[c]), bottom[c]);
                // Heights are whole numbers: of tasks that go equally low the first.
                let limit = top[c] + if index < task[c] { 0.5 } else { 0.0 };
                let goes_lowest = at < limit;
                task[c] = if goes_lowest { index } else { task[c] };
                lowest[c] |= goes_lowest;
                if TELL {
                    overlap[c] = most(top[c] - at, 0.0);
                    sum[c] += overlap[c];
                    greatest[c] = most(greatest[c], overlap[c]);
                }
                top[c] = least(top[c], at);
            }
            put_row(&mut self.top[..], start, top);
            put_row(&mut self.task[..], start, task);
            if TELL {
                put_row(&mut self.overlap[..], start, overlap);
            }
        }
        let is_new = lowest.into_iter().fold(false, |any, one| any | one);
        Sunk { greatest: greatest.into_iter().fold(0.0, most), sum: sum.into_iter().sum::<f64>(), is_new }
    }

    /// Lowers the ceilings of a block to where a part has taken both ends of a way, and all between; true if one has become lower.
    #[inline(always)]
    fn sink_ceilings(&mut self, (c0, r0): (usize, usize)) -> bool {
        let mut lower = [false; BLOCK];
        let heights = &self.heights[..];
        let [along, up] = &mut self.ceilings;
        for r in r0..r0 + BLOCK {
            let (start, at) = (r * SIDE + c0, height_at(r, c0));
            // Not by `map`, which does not become part of this.
            let (here, left, below) =
                (row_at(heights, at), row_at(heights, at - 1), row_at(heights, at - HEIGHTS));
            let (mut a, mut u) = (row_at(&along[..], start), row_at(&up[..], start));
            for c in 0..BLOCK {
                let (beside, behind) = (most(here[c], left[c]), most(here[c], below[c]));
                lower[c] |= beside < a[c] || behind < u[c];
                a[c] = least(a[c], beside);
                u[c] = least(u[c], behind);
            }
            put_row(&mut along[..], start, a);
            put_row(&mut up[..], start, u);
        }
        lower.into_iter().fold(false, |any, one| any | one)
    }

    /// The same for what is swept along an arc at one height.
    #[inline(always)]
    fn sink_ceilings_round(&mut self, (c0, r0): (usize, usize), sweep: &Sweep, round: &Round) -> bool {
        let mut lower = [false; BLOCK];
        let (x, mut left) = (row_at(&self.x, c0), row_at(&self.x, c0));
        for x in &mut left {
            *x -= self.step;
        }
        for r in r0..r0 + BLOCK {
            let (start, at) = (r * SIDE + c0, height_at(r, c0));
            let (y, below) = ([self.y[r]; BLOCK], [self.y[r] - self.step; BLOCK]);
            let here = row_at(&self.heights[..], at);
            for (k, (from, before)) in
                [([&left, &y], at - 1), ([&x, &below], at - HEIGHTS)].into_iter().enumerate()
            {
                let before = row_at(&self.heights[..], before);
                let mut ceilings = row_at(&self.ceilings[k][..], start);
                let mut any = false;
                for c in 0..BLOCK {
                    any |= most(here[c], before[c]) < ceilings[c];
                }
                if !any {
                    continue;
                }
                let between = sweep.between_round(round, [from, [&x, &y]], [&before, &here]);
                for c in 0..BLOCK {
                    lower[c] |= between[c] < ceilings[c];
                    ceilings[c] = least(ceilings[c], between[c]);
                }
                put_row(&mut self.ceilings[k][..], start, ceilings);
            }
        }
        lower.into_iter().fold(false, |any, one| any | one)
    }

    /// The same for what is swept along a rising arc, way by way.
    fn sink_ceilings_one_by_one(&mut self, sweep: &Sweep, blocks: Blocks) {
        for (c0, r0) in blocks.corners() {
            for (k, (dr, dc)) in [(0, (0, 1)), (1, (1, 0))] {
                for r in r0.max(1)..r0 + BLOCK {
                    for c in c0.max(1)..c0 + BLOCK {
                        let ceiling = &mut self.ceilings[k][r * SIDE + c];
                        let both = self.heights[height_at(r, c)].max(self.heights[height_at(r - dr, c - dc)]);
                        if both < *ceiling {
                            let at = |r: usize, c: usize| DVec2::new(self.x[c], self.y[r]);
                            *ceiling = ceiling.min(sweep.between(at(r - dr, c - dc), at(r, c)));
                        }
                    }
                }
            }
        }
    }
}

/// Lengths that a part took out of a block [fixed steps]: the most of one line, and of all.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::stock::cut::above) struct Sunk {
    pub(super) greatest: f64,
    pub(super) sum: f64,
    /// Whether it went lowest on a line, or in a way.
    is_new: bool,
}

/// A part goes through blocks; if it is along a straight path its heights are computed.
struct Sink<'a, 'b> {
    patch: &'a mut Patch,
    sweep: &'a Sweep<'b>,
    blocks: Blocks,
    index: f64,
    /// Whether lengths that are taken are noted.
    tell: bool,
}

impl NullaryFnOnce for Sink<'_, '_> {
    type Output = [Sunk; BLOCKS];

    #[inline(always)]
    fn call(self) -> [Sunk; BLOCKS] {
        let Sink { patch, sweep, blocks, index, tell } = self;
        let one_by_one = sweep.is_one_by_one();
        if !one_by_one {
            patch.raise(sweep, blocks);
        }
        let mut sunk = [Sunk::default(); BLOCKS];
        for (corner, sunk) in blocks.corners().zip(&mut sunk) {
            *sunk = if tell {
                patch.sink_tops::<true>(corner, index)
            } else {
                patch.sink_tops::<false>(corner, index)
            };
            if patch.between {
                sunk.is_new |= match sweep.round() {
                    // They were lowered before.
                    Some(_) if one_by_one => true,
                    Some(round) => patch.sink_ceilings_round(corner, sweep, round),
                    None => patch.sink_ceilings(corner),
                };
            }
        }
        let mut covers = patch.covers;
        for (b, _) in
            (0..BLOCKS).filter(|b| blocks.0 >> b & 1 == 1).zip(&sunk).filter(|(_, sunk)| sunk.is_new)
        {
            patch.hull[b] = patch.hull_of(b);
            patch.latest[b] = patch.latest_of(b);
            if let Some(covers) = &mut covers {
                covers[b] = patch.cover_of(b);
            }
        }
        patch.covers = covers;
        sunk
    }
}
