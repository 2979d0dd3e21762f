//! Mobility of a chain: the rank of its motions, and the test for translations that stay at right angles.

use super::Sizes;
use crate::machine::Word;

/// Rank of a word modulo the spin of the tool about the spindle, at poses in general position: 5 for a machine that
/// brings its tool to every place in every direction. Of the sizes only the directions of spindle and inclined axes count.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::{Word, layouts::{Sizes, rank_without_spin}};
/// let rank = |code| rank_without_spin(&Word::parse(code).unwrap(), &Sizes::default());
/// assert_eq!((rank("64123"), rank("12346"), rank("123")), (5, 4, 3)); // a last C only spins the tool
/// ```
pub fn rank_without_spin(word: &Word, sizes: &Sizes) -> usize {
    sizes.kinematics(word).mobility()
}

/// Whether the translations of a word can be brought together by motions that change places: then they stay at right
/// angles whatever the rotations do. A rotation that must come after one translation and before another one forbids it.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::{Word, layouts::is_regular};
/// assert!(is_regular(&Word::parse("64123").unwrap()) && is_regular(&Word::parse("14235").unwrap()));
/// assert!(!is_regular(&Word::parse("14253").unwrap())); // B turns Z against X
/// ```
pub fn is_regular(word: &Word) -> bool {
    let len = word.0.len().min(16);
    // Bits of the motions that must come before each one; `before` of earlier ones is complete.
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
    use glam::{DMat3, DVec3};

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
