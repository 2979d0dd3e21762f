//! Bricks side by side, of which a swept part is asked at once: [`SweptPart::reach`] of it beyond each, without branches.

use glam::DVec3;
use pulp::{Arch, NullaryFnOnce};

use super::bundle::{NUMBERS, Shape};
use super::near::SweptPart;

/// Most bricks that are asked about at once: those of a pile.
const MOST: usize = 64;

/// Middles of bricks, number by number.
pub(super) struct Places {
    arch: Arch,
    count: usize,
    bricks: [u32; MOST],
    /// Coordinates of the middles, and half diagonals [mm].
    numbers: [[f64; MOST]; 4],
    /// Most that the part reaches beyond each middle [mm].
    reaches: [f64; MOST],
}

impl Default for Places {
    fn default() -> Places {
        Places {
            arch: Arch::default(),
            count: 0,
            bricks: [0; MOST],
            numbers: [[0.0; MOST]; 4],
            reaches: [0.0; MOST],
        }
    }
}

impl Places {
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    pub(super) fn is_full(&self) -> bool {
        self.count == MOST
    }

    /// Adds a brick with its middle and half its diagonal, if there is room.
    #[inline]
    pub(super) fn add(&mut self, brick: u32, numbers: [f64; 4]) {
        if self.count < MOST {
            self.bricks[self.count] = brick;
            for (of, number) in self.numbers.iter_mut().zip(numbers) {
                of[self.count] = number;
            }
            self.count += 1;
        }
    }

    /// Asks a swept part about all.
    pub(super) fn ask(&mut self, swept: &SweptPart) {
        let count = self.count;
        let numbers = self.numbers.each_ref().map(|of| &of[..count]);
        let reaches = &mut self.reaches[..count];
        if let Some(shape) = Shape::of(swept.part) {
            self.arch.dispatch(Reaches { shape, swept: swept.numbers(), numbers, reaches });
            return;
        }
        let [x, y, z, radius] = numbers;
        for (i, reach) in reaches.iter_mut().enumerate() {
            *reach = swept.reach(DVec3::new(x[i], y[i], z[i]), radius[i]);
        }
    }

    /// Calls for each brick that the part may reach, with the bound on its reach beyond the middle.
    pub(super) fn each_reached(&self, found: &mut impl FnMut(u32, f64)) {
        for i in 0..self.count {
            if self.reaches[i] >= -self.numbers[3][i] {
                found(self.bricks[i], self.reaches[i]);
            }
        }
    }
}

/// See [`Places::ask`].
struct Reaches<'a> {
    shape: Shape,
    swept: [f64; NUMBERS],
    numbers: [&'a [f64]; 4],
    reaches: &'a mut [f64],
}

impl NullaryFnOnce for Reaches<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Reaches { shape, swept, numbers, reaches } = self;
        let [x, y, z, radius] = numbers.map(|n| &n[..reaches.len()]);
        for i in 0..reaches.len() {
            reaches[i] = shape.reach(&swept, [x[i], y[i], z[i]], radius[i]);
        }
    }
}
