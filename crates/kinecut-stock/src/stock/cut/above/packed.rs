//! The ceilings of a patch in few bytes, each as it was.
//!
//! A ceiling is counted, in steps of a number of its type, from what its neighbours say: those before it in its row and column, or the
//! ceiling of a way in the other direction to the same line, which mostly is the same. Most differences take a byte or none.

use super::patch::{LINES, PatchCeilings, SIDE};

/// The ceilings of a patch, packed.
#[derive(Clone, Debug)]
pub(super) struct PackedCeilings(Box<[u8]>);

/// Two bits for each ceiling of both directions: the length of its difference.
const LENGTHS: usize = 2 * LINES / 4;

/// Differences from this on take four more bytes.
const LONG: u32 = 0xff_ffff;

/// Most bytes of a difference.
const MOST: usize = 7;

/// Places from a way to those in the other direction that lead to or from the same line.
const BESIDE: [isize; 4] = [0, 1, -(SIDE as isize), 1 - SIDE as isize];

/// A whole number that grows with a height, one from each number to the next.
#[inline(always)]
fn ordered(height: f32) -> i32 {
    let bits = height.to_bits() as i32;
    if bits < 0 { bits ^ i32::MAX } else { bits }
}

/// The height of a whole number, as [`ordered`] has it.
#[inline(always)]
fn height(ordered: i32) -> f32 {
    f32::from_bits((if ordered < 0 { ordered ^ i32::MAX } else { ordered }) as u32)
}

/// The ceiling that those before it in its row and column suggest.
#[inline(always)]
fn by_neighbours(own: &[i32; LINES], at: usize) -> i32 {
    let before = |back: usize| at.checked_sub(back).map_or(0, |i| own[i]);
    match (at % SIDE, at / SIDE) {
        (0, _) => before(SIDE),
        (_, 0) => before(1),
        _ => before(1).wrapping_add(before(SIDE)).wrapping_sub(before(SIDE + 1)),
    }
}

/// The ceiling in the other direction at a place beside.
#[inline(always)]
fn by_other(other: &[i32; LINES], at: usize, beside: isize) -> i32 {
    at.checked_add_signed(beside).and_then(|at| other.get(at)).copied().unwrap_or_default()
}

impl PackedCeilings {
    /// Packs the ceilings of a patch.
    pub(super) fn of(ceilings: &PatchCeilings) -> PackedCeilings {
        // Not by `map`: of so many it makes copies.
        let [mut along, mut up] = [[0; LINES]; 2];
        for at in 0..LINES {
            (along[at], up[at]) = (ordered(ceilings[0][at]), ordered(ceilings[1][at]));
        }
        // The place beside at which most ceilings are the same.
        let same = |beside: isize| {
            let (far, back) = (beside.max(0) as usize, (-beside).max(0) as usize);
            up[back..].iter().zip(&along[far..]).map(|(a, b)| u32::from(a == b)).sum::<u32>()
        };
        let beside = (0..BESIDE.len()).max_by_key(|i| same(BESIDE[*i])).unwrap_or_default();
        let mut bytes = [0; 1 + LENGTHS + 2 * LINES * MOST];
        bytes[0] = beside as u8;
        let mut end = 1 + LENGTHS;
        for at in 0..LINES {
            put((&mut bytes, &mut end), at, along[at].wrapping_sub(by_neighbours(&along, at)));
        }
        for at in 0..LINES {
            let other = by_other(&along, at, BESIDE[beside]);
            put((&mut bytes, &mut end), LINES + at, up[at].wrapping_sub(other));
        }
        PackedCeilings(bytes[..end].into())
    }

    /// The ceilings.
    pub(super) fn unpacked(&self) -> PatchCeilings {
        let (head, mut rest) = self.0.split_at(1 + LENGTHS);
        let beside = BESIDE[usize::from(head[0])];
        let mut all = [[0; LINES]; 2];
        let [along, up] = &mut all;
        for at in 0..LINES {
            along[at] = by_neighbours(along, at).wrapping_add(take(&head[1..], at, &mut rest));
        }
        for at in 0..LINES {
            up[at] = by_other(along, at, beside).wrapping_add(take(&head[1..], LINES + at, &mut rest));
        }
        let mut ceilings = [[0.0; LINES]; 2];
        for (ceilings, all) in ceilings.iter_mut().zip(&all) {
            for (ceiling, ordered) in ceilings.iter_mut().zip(all) {
                *ceiling = height(*ordered);
            }
        }
        ceilings
    }
}

/// Writes a difference, the one at an index, behind the others.
#[inline(always)]
fn put((bytes, end): (&mut [u8], &mut usize), index: usize, difference: i32) {
    // Small ones of both signs become small.
    let n = (difference << 1 ^ difference >> 31) as u32;
    let length = match n {
        0 => 0,
        1..=0xff => 1,
        0x100..=0xffff => 2,
        _ => 3,
    };
    bytes[1 + index / 4] |= (length as u8) << (index % 4 * 2);
    // More than is needed: what follows is written over it.
    bytes[*end..*end + 4].copy_from_slice(&n.min(LONG).to_le_bytes());
    *end += length;
    if n >= LONG {
        bytes[*end..*end + 4].copy_from_slice(&n.to_le_bytes());
        *end += 4;
    }
}

/// Takes the difference at an index off the front.
#[inline(always)]
fn take(lengths: &[u8], index: usize, rest: &mut &[u8]) -> i32 {
    let length = usize::from(lengths[index / 4] >> (index % 4 * 2) & 3);
    let mut n = little(rest, length);
    if n == LONG {
        n = little(rest, 4);
    }
    (n >> 1) as i32 ^ -((n & 1) as i32)
}

/// Takes a number of some bytes off the front.
#[inline(always)]
fn little(rest: &mut &[u8], length: usize) -> u32 {
    let (own, behind) = rest.split_at(length);
    *rest = behind;
    own.iter().rev().fold(0, |n, byte| n << 8 | u32::from(*byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ceilings_come_back_bit_for_bit() {
        let bowl = |r: usize, c: usize| ((r * r + 3 * c * c) as f32).mul_add(0.01, -7.3);
        let wild = |r: usize, c: usize| {
            let bits = ((r * 31 + c) as u32).wrapping_mul(0x9e37_79b1);
            let some = [f32::NEG_INFINITY, f32::INFINITY, 0.0, -0.0, f32::MAX, f32::from_bits(bits)];
            some[(bits >> 7) as usize % some.len()]
        };
        let of = |height: &dyn Fn(usize, usize) -> f32| -> [f32; LINES] {
            std::array::from_fn(|at| match (at / SIDE, at % SIDE) {
                (0, _) | (_, 0) => f32::NEG_INFINITY,
                (r, c) => height(r, c),
            })
        };
        let later = |r: usize, c: usize| bowl(r - 1, c + 1);
        for (k, [along, up]) in
            [[of(&bowl), of(&bowl)], [of(&bowl), of(&later)], [of(&wild), of(&bowl)], [of(&bowl), of(&wild)]]
                .into_iter()
                .enumerate()
        {
            let packed = PackedCeilings::of(&[along, up]);
            let bits = |of: [f32; LINES]| of.map(f32::to_bits);
            assert_eq!(packed.unpacked().map(bits), [along, up].map(bits), "{k}");
            assert!(k > 1 || packed.0.len() < 4 * LINES, "{}", packed.0.len());
        }
    }
}
