//! Arguments of `G65`: letters and the local variables that they fill.

use crate::nc::run::Level;

/// Local variables of a call.
const LOCALS: usize = 33;

/// Letters and their variables, in the order of the alphabet; `G`, `L`, `N`, `O` and `P` are none.
const LETTERS: [(u8, usize); 21] = [
    (b'A', 1),
    (b'B', 2),
    (b'C', 3),
    (b'D', 7),
    (b'E', 8),
    (b'F', 9),
    (b'H', 11),
    (b'I', 4),
    (b'J', 5),
    (b'K', 6),
    (b'M', 13),
    (b'Q', 17),
    (b'R', 18),
    (b'S', 19),
    (b'T', 20),
    (b'U', 21),
    (b'V', 22),
    (b'W', 23),
    (b'X', 24),
    (b'Y', 25),
    (b'Z', 26),
];

/// Fills local variables from arguments, one after the other.
///
/// `I`, `J` and `K` that come again begin a further set: `#4` to `#6`, then `#7` to `#9`, up to `#33`. Where a letter and a set
/// name one variable the later one counts (operator's manual of the 16/18).
#[derive(Debug)]
pub(in crate::nc) struct Arguments {
    level: Level,
    /// Letters of the present set of I, J, K, and the number of the set.
    seen: [bool; 3],
    set: usize,
}

impl Arguments {
    pub(in crate::nc) fn new() -> Arguments {
        Arguments { level: Level::new(LOCALS, true), seen: [false; 3], set: 0 }
    }

    /// Takes an argument; `false` for a letter that fills no variable.
    pub(in crate::nc) fn take(&mut self, letter: u8, value: f64) -> bool {
        let letter = letter.to_ascii_uppercase();
        let Some((_, mut variable)) = LETTERS.iter().find(|(l, _)| *l == letter).copied() else {
            return false;
        };
        if let Some(i) = [b'I', b'J', b'K'].iter().position(|l| *l == letter) {
            if self.seen[i] {
                self.set += 1;
                self.seen = [false; 3];
            }
            self.seen[i] = true;
            variable += 3 * self.set;
        }
        match self.level.locals.get_mut(variable - 1) {
            Some(place) => {
                *place = value;
                true
            }
            None => false,
        }
    }

    pub(in crate::nc) fn level(self) -> Level {
        self.level
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_later_argument_of_a_variable_counts() {
        let filled = |arguments: &[(u8, f64)]| {
            let mut all = Arguments::new();
            arguments.iter().for_each(|(letter, value)| assert!(all.take(*letter, *value)));
            all.level().locals
        };
        let both = filled(&[(b'A', 1.0), (b'I', 2.0), (b'I', 3.0), (b'D', 9.0)]);
        assert_eq!((both[0], both[3], both[6]), (1.0, 2.0, 9.0));
        assert_eq!(filled(&[(b'D', 9.0), (b'I', 2.0), (b'I', 3.0)])[6], 3.0);
        assert!(filled(&[(b'X', 1.0)])[0].is_nan());
        assert!(!Arguments::new().take(b'G', 1.0));
        let mut many = Arguments::new();
        assert!((0..10).all(|i| many.take(b'K', f64::from(i))));
        assert!(!many.take(b'K', 0.0));
    }
}
