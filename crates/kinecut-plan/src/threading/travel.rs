//! The way round: counter-clockwise or clockwise, upwards or downwards.

use super::ThreadSide;
use crate::holes::Sense;
use crate::tool::Hand;

/// The way in which a helix is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ThreadTravel {
    /// Counter-clockwise, seen from above.
    pub counter_clockwise: bool,
    /// Upwards, from the bottom of the thread to its mouth.
    pub upwards: bool,
}

impl ThreadTravel {
    /// The way for a thread of a hand, in a sense of milling; `left_cutter`: the spindle turns counter-clockwise.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::{holes::Sense::Climb, threading::{ThreadSide::Inside, ThreadTravel}, tool::Hand};
    /// let way = ThreadTravel::of(Inside, Hand::Right, Climb, false);
    /// assert!(way.counter_clockwise && way.upwards);
    /// ```
    pub fn of(side: ThreadSide, hand: Hand, sense: Sense, left_cutter: bool) -> ThreadTravel {
        // With a clockwise spindle climb milling keeps the material on the right.
        let keeps_right = (sense == Sense::Climb) != left_cutter;
        let counter_clockwise = keeps_right == (side == ThreadSide::Inside);
        ThreadTravel { counter_clockwise, upwards: counter_clockwise == (hand == Hand::Right) }
    }

    /// 1 counter-clockwise, -1 clockwise.
    pub(super) fn turn(self) -> f64 {
        if self.counter_clockwise { 1.0 } else { -1.0 }
    }

    /// 1 upwards, -1 downwards.
    pub(super) fn climb(self) -> f64 {
        if self.upwards { 1.0 } else { -1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_directions() {
        use Hand::{Left, Right};
        use Sense::{Climb, Conventional};
        use ThreadSide::{Inside, Outside};
        // Side, hand, sense: counter-clockwise, upwards, for a spindle that turns clockwise.
        let table = [
            (Inside, Right, Climb, true, true),
            (Inside, Right, Conventional, false, false),
            (Inside, Left, Climb, true, false),
            (Inside, Left, Conventional, false, true),
            (Outside, Right, Climb, false, false),
            (Outside, Right, Conventional, true, true),
            (Outside, Left, Climb, false, true),
            (Outside, Left, Conventional, true, false),
        ];
        for (side, hand, sense, counter_clockwise, upwards) in table {
            let way = ThreadTravel::of(side, hand, sense, false);
            assert_eq!(way, ThreadTravel { counter_clockwise, upwards }, "{side:?} {hand:?} {sense:?}");
            // A left-hand cutter is the mirror image, in which the hand of the thread changes too.
            let other = if hand == Right { Left } else { Right };
            let mirrored = ThreadTravel::of(side, other, sense, true);
            assert_eq!(mirrored, ThreadTravel { counter_clockwise: !counter_clockwise, upwards });
        }
    }
}
