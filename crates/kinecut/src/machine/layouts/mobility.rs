//! What a chain can do at all: the rank of its motions, and whether its translations stay at right angles.
//!
//! The rank is that of the twists of the joints in the work frame together with the spin of the tool, less one, at a pose
//! without any symmetry (at home ranks are often lower: C stands parallel to the spindle). Rotary axes pass through one
//! point here: offsets change no rank.

use glam::{DMat3, DVec3};

use super::Sizes;
use crate::machine::Word;

/// Positions without symmetry: fractional parts of multiples of the golden ratio, shifted.
const STEP: f64 = 0.618_033_988_749_894_9;
/// Pivots below this share of the unit columns are rounding.
const SINGULAR: f64 = 1e-9;

/// Rank of a word modulo the spin of the tool about the spindle: 5 for a machine that brings its tool to every place in
/// every direction. Of the sizes only the directions of spindle and inclined axes count.
///
/// ```
/// use kinecut::machine::{Word, layouts::{Sizes, rank_without_spin}};
/// let rank = |code| rank_without_spin(&Word::parse(code).unwrap(), &Sizes::default());
/// assert_eq!((rank("64123"), rank("12346"), rank("123")), (5, 4, 3)); // a last C only spins the tool
/// ```
pub fn rank_without_spin(word: &Word, sizes: &Sizes) -> usize {
    let mut turn = DMat3::IDENTITY;
    let mut at = DVec3::ZERO;
    let mut twists: Vec<[f64; 6]> = Vec::with_capacity(word.0.len() + 1);
    for (i, &motion) in word.0.iter().enumerate() {
        let axis = sizes.direction(motion);
        let value = ((i + 1) as f64 * STEP).fract() + 0.3;
        let moved = turn * axis;
        if motion.is_rotation() {
            twists.push(unit_twist(moved, at.cross(moved)));
            turn *= DMat3::from_axis_angle(axis, value);
        } else {
            twists.push(unit_twist(DVec3::ZERO, moved));
            at += moved * value;
        }
    }
    let spin = turn * sizes.spindle();
    twists.push(unit_twist(spin, at.cross(spin)));
    rank(twists) - 1
}

fn unit_twist(w: DVec3, v: DVec3) -> [f64; 6] {
    let length = (w.length_squared() + v.length_squared()).sqrt().max(f64::MIN_POSITIVE);
    [w.x, w.y, w.z, v.x, v.y, v.z].map(|c| c / length)
}

/// Rank of vectors, by orthogonalisation of the longest remainder.
fn rank(mut vectors: Vec<[f64; 6]>) -> usize {
    let dot = |a: &[f64; 6], b: &[f64; 6]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut found = 0;
    while let Some(longest) = (0..vectors.len())
        .max_by(|&i, &j| dot(&vectors[i], &vectors[i]).total_cmp(&dot(&vectors[j], &vectors[j])))
    {
        let length = dot(&vectors[longest], &vectors[longest]).sqrt();
        if !(length > SINGULAR) {
            break;
        }
        let unit = vectors.swap_remove(longest).map(|c| c / length);
        found += 1;
        // Twice: the second pass takes away what rounding left of the first.
        for v in &mut vectors {
            for _ in 0..2 {
                let along = dot(v, &unit);
                v.iter_mut().zip(&unit).for_each(|(c, u)| *c -= along * u);
            }
        }
    }
    found
}

/// Whether the translations of a word can be brought together by motions that change places: then they stay at right
/// angles whatever the rotations do. A rotation that must stand after one translation and before another one forbids it.
///
/// ```
/// use kinecut::machine::{Word, layouts::is_regular};
/// assert!(is_regular(&Word::parse("64123").unwrap()) && is_regular(&Word::parse("14235").unwrap()));
/// assert!(!is_regular(&Word::parse("14253").unwrap())); // B turns Z against X
/// ```
pub fn is_regular(word: &Word) -> bool {
    let len = word.0.len().min(16);
    // Bits of the motions that must stand before each one; `before` of earlier ones is complete.
    let mut before = [0u16; 16];
    for i in 0..len {
        for j in (0..i).filter(|&j| !word.0[j].commutes(word.0[i])) {
            before[i] |= before[j] | 1 << j;
        }
    }
    let set = |rotary: bool| {
        (0..len).filter(|&i| word.0[i].is_rotation() == rotary).fold(0u16, |set, i| set | 1 << i)
    };
    let (rotations, translations) = (set(true), set(false));
    (0..len).filter(|&t| translations & (1 << t) != 0).all(|t| {
        (0..len).filter(|&r| rotations & before[t] & (1 << r) != 0).all(|r| before[r] & translations == 0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Elementary;

    /// Least volume of the block that the three translations span, over turns of the rotations.
    fn least_volume(word: &Word) -> f64 {
        let mut least = 1.0f64;
        for i in 0..15 {
            for j in 0..15 {
                let mut angles = [f64::from(i) * 0.43, f64::from(j) * 0.43].into_iter();
                let (mut turn, mut columns) = (DMat3::IDENTITY, Vec::new());
                for &motion in &word.0 {
                    let axis = motion.direction().unwrap();
                    if motion.is_rotation() {
                        turn *= DMat3::from_axis_angle(axis, angles.next().unwrap());
                    } else {
                        columns.push(turn * axis);
                    }
                }
                let volume = DMat3::from_cols(columns[0], columns[1], columns[2]).determinant().abs();
                least = least.min(volume);
            }
        }
        least
    }

    #[test]
    fn regular_words_are_those_whose_translations_stay_at_right_angles() {
        for pair in [[4, 5], [5, 4], [4, 6], [6, 4], [5, 6], [6, 5]] {
            let motions = [1, 2, 3, pair[0], pair[1]].map(|d| Elementary::from_digit(d).unwrap());
            for word in crate::machine::layouts::orders(&motions).unwrap() {
                assert_eq!(is_regular(&word), least_volume(&word) > 1.0 - 1e-9, "{word}");
            }
        }
    }

    #[test]
    fn a_nutating_head_has_full_rank() {
        let rank = |word: &Word, inclined| {
            rank_without_spin(word, &Sizes { inclined: [inclined; 3], ..Sizes::default() })
        };
        let word = Word::parse("12367").unwrap();
        assert_eq!(rank(&word, DVec3::new(0.0, 1.0, 1.0)), 5);
        assert_eq!(rank(&word, DVec3::Z), 3);
        assert_eq!(rank(&Word::default(), DVec3::Z), 0);
    }
}
