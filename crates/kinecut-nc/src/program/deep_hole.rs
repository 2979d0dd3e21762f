//! Deep-hole drilling: the stepped drilling cycle with everything that a control's own cycle can say of its steps.
//!
//! For readers and writers of NC texts. SINUMERIK's `CYCLE83` and HEIDENHAIN's cycles 200, 203 and 205 count their steps
//! from the surface and not from the height where the feed begins, drill the first step at a feed of its own, dwell
//! after each step, or make each step shorter than the one before. [`Cycle::Peck`](super::Cycle::Peck) and
//! [`Cycle::ChipBreak`](super::Cycle::ChipBreak) are the common cases of it, with steps counted from the reference.

use super::CycleStep;
use crate::base::{Code, Finding, Result};

/// A hole drilled in steps; heights in the frame of the program [mm], along the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeepHole {
    /// Height from which to feed, and to which the tool withdraws.
    pub reference: f64,
    /// Height of the bottom of the first step; at or below `bottom` the hole is drilled in one go.
    pub first: f64,
    /// Height of the bottom.
    pub bottom: f64,
    /// Height to which the tool returns.
    pub retract: f64,
    /// Depth of the second step [mm].
    pub step: f64,
    /// Law by which the steps after it shorten.
    pub shortening: Shortening,
    /// Motion between two steps.
    pub between: Between,
    /// Feed of the first step, as a part of the feed.
    pub first_feed: f64,
    /// Dwell after each step but the last [s].
    pub dwell: f64,
    /// Dwell at the bottom [s].
    pub dwell_bottom: f64,
}

/// Law by which the depths of the steps follow one another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shortening {
    /// All alike; the last is what remains.
    None,
    /// Each is shorter than the one before, down to a least depth; the last is what remains.
    By {
        /// Difference of two steps [mm].
        decrement: f64,
        /// Least depth of a step [mm].
        least: f64,
    },
    /// Each is shorter by an amount until it is that amount; what remains below twice the amount is halved.
    Degressive {
        /// The amount [mm].
        amount: f64,
    },
}

/// Motion between two steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Between {
    /// Rapid out to the reference height, rapid back in.
    Withdraw {
        /// Distance above the last depth at which the rapid back in ends [mm].
        clearance: f64,
        /// Dwell at the reference height [s].
        dwell: f64,
    },
    /// A small lift that breaks the chip.
    Lift {
        /// Its height [mm].
        lift: f64,
        /// True if it is made at the feed instead of in rapid.
        at_feed: bool,
    },
}

/// Remainder of a hole that is no step of its own, against the step: rounding of sums.
pub(super) const WHOLE_STEP: f64 = 1e-9;

impl DeepHole {
    /// The moves along the tool axis, after the one to the reference height and before the return.
    ///
    /// # Errors
    /// `KC0204` when a length, time or factor is not usable, or the steps are more than `most`.
    pub(super) fn steps(&self, most: usize) -> Result<Vec<CycleStep>> {
        let depths = self.depths(most)?;
        let last = depths.len() - 1;
        let mut steps = Vec::with_capacity(4 * depths.len());
        for (i, depth) in depths.iter().copied().enumerate() {
            steps.push(match i == 0 && self.first_feed != 1.0 {
                true => CycleStep::FeedAt { height: depth, factor: self.first_feed },
                false => CycleStep::Feed(depth),
            });
            let dwell = if i == last { self.dwell_bottom } else { self.dwell };
            if dwell > 0.0 {
                steps.push(CycleStep::Dwell(dwell));
            }
            if i == last {
                break;
            }
            match self.between {
                Between::Withdraw { clearance, dwell } => {
                    steps.push(CycleStep::Rapid(self.reference));
                    if dwell > 0.0 {
                        steps.push(CycleStep::Dwell(dwell));
                    }
                    steps.push(CycleStep::Rapid(self.reference.min(depth + clearance)));
                }
                Between::Lift { lift, at_feed } => {
                    let height = self.reference.min(depth + lift);
                    steps.push(if at_feed { CycleStep::Feed(height) } else { CycleStep::Rapid(height) });
                }
            }
        }
        Ok(steps)
    }

    /// Heights of the bottoms of the steps.
    fn depths(&self, most: usize) -> Result<Vec<f64>> {
        self.check()?;
        if self.first <= self.bottom + WHOLE_STEP * (self.reference - self.bottom) {
            return Ok(vec![self.bottom]);
        }
        let mut depths = vec![self.first];
        let mut at = self.first;
        let mut step = self.step;
        loop {
            let rest = at - self.bottom;
            step = match self.shortening {
                Shortening::Degressive { amount }
                    if step <= amount && rest < 2.0 * amount && rest > amount =>
                {
                    0.5 * rest
                }
                _ => step,
            };
            if rest <= step * (1.0 + WHOLE_STEP) {
                depths.push(self.bottom);
                return Ok(depths);
            }
            if depths.len() >= most {
                return Err(too_small(step, rest / most as f64).into());
            }
            at -= step;
            depths.push(at);
            step = match self.shortening {
                Shortening::None => step,
                Shortening::By { decrement, least } => (step - decrement).max(least.min(step)),
                Shortening::Degressive { amount } => (step - amount).max(amount.min(step)),
            };
            // Without a least depth the steps would shrink to nothing.
            if step <= WHOLE_STEP * (self.reference - self.bottom) {
                return Err(too_small(step, rest / most as f64).into());
            }
        }
    }

    fn check(&self) -> Result<()> {
        let state = |what: &str| Finding::error(Code::NC_STATE, what.to_owned());
        if !(self.first.is_finite() && self.first < self.reference) {
            let finding = state("the first step of a drilling cycle must end below the reference height");
            return Err(finding.value_mm(self.first).bound_mm(self.reference).into());
        }
        if !(self.step > 0.0 && self.step.is_finite()) && self.first > self.bottom {
            return Err(too_small(self.step, 0.0).into());
        }
        if !(self.first_feed > 0.0 && self.first_feed.is_finite()) {
            let finding = state("the feed of the first step of a drilling cycle is not usable");
            return Err(finding.value(self.first_feed, "").into());
        }
        let (distance, dwell) = match self.between {
            Between::Withdraw { clearance, dwell } => (clearance, dwell),
            Between::Lift { lift, .. } => (lift, 0.0),
        };
        let (less, least) = match self.shortening {
            Shortening::None => (0.0, 0.0),
            Shortening::By { decrement, least } => (decrement, least),
            Shortening::Degressive { amount } => (amount, amount),
        };
        for value in [distance, dwell, less, least, self.dwell, self.dwell_bottom] {
            if !(value >= 0.0 && value.is_finite()) {
                let finding = state("a distance or dwell of a drilling cycle is negative");
                return Err(finding.value(value, "").bound(0.0, "").into());
            }
        }
        Ok(())
    }
}

fn too_small(step: f64, bound: f64) -> Finding {
    Finding::error(Code::NC_STATE, "the step of a drilling cycle is too small").value_mm(step).bound_mm(bound)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Cycle;
    use CycleStep::{Dwell, Feed, FeedAt, Rapid};

    const HOLE: DeepHole = DeepHole {
        reference: 2.0,
        first: -6.0,
        bottom: -20.0,
        retract: 50.0,
        step: 6.0,
        shortening: Shortening::None,
        between: Between::Withdraw { clearance: 2.0, dwell: 0.0 },
        first_feed: 1.0,
        dwell: 0.0,
        dwell_bottom: 0.0,
    };

    fn expansion(hole: DeepHole) -> Vec<CycleStep> {
        Cycle::DeepHole(hole).expansion().unwrap()
    }

    fn depths(hole: DeepHole) -> Vec<f64> {
        let mut lowest = f64::INFINITY;
        let mut seen = Vec::new();
        for step in expansion(hole) {
            if let Feed(z) | FeedAt { height: z, .. } = step
                && z < lowest
            {
                lowest = z;
                seen.push(z);
            }
        }
        seen
    }

    #[test]
    fn steps_count_from_the_surface() {
        assert_eq!(
            expansion(HOLE),
            [
                Rapid(2.0),
                Feed(-6.0),
                Rapid(2.0),
                Rapid(-4.0),
                Feed(-12.0),
                Rapid(2.0),
                Rapid(-10.0),
                Feed(-18.0),
                Rapid(2.0),
                Rapid(-16.0),
                Feed(-20.0),
                Rapid(50.0)
            ]
        );
    }

    #[test]
    fn the_first_step_has_its_feed_and_each_its_dwell() {
        let between = Between::Lift { lift: 1.0, at_feed: true };
        let hole =
            DeepHole { bottom: -12.0, between, first_feed: 0.4, dwell: 0.5, dwell_bottom: 2.0, ..HOLE };
        assert_eq!(
            expansion(hole),
            [
                Rapid(2.0),
                FeedAt { height: -6.0, factor: 0.4 },
                Dwell(0.5),
                Feed(-5.0),
                Feed(-12.0),
                Dwell(2.0),
                Rapid(50.0)
            ]
        );
    }

    #[test]
    fn steps_shorten_to_the_least() {
        let shortening = Shortening::By { decrement: 2.0, least: 3.0 };
        assert_eq!(
            depths(DeepHole { shortening, step: 4.0, ..HOLE }),
            [-6.0, -10.0, -13.0, -16.0, -19.0, -20.0]
        );
        // Amount 2 after 6: 4, 2, 2, then the rest of 3 in halves.
        let shortening = Shortening::Degressive { amount: 2.0 };
        let hole = DeepHole { shortening, step: 4.0, bottom: -17.0, ..HOLE };
        assert_eq!(depths(hole), [-6.0, -10.0, -12.0, -14.0, -15.5, -17.0]);
    }

    #[test]
    fn a_whole_number_of_steps_has_no_sliver() {
        for (step, count) in [(0.1, 60), (0.7, 9), (1.3, 30)] {
            let bottom = 2.0 - step * f64::from(count);
            let hole = DeepHole { first: 2.0 - step, step, bottom, ..HOLE };
            assert_eq!(depths(hole).len(), count as usize, "{step}");
        }
    }

    #[test]
    fn what_cannot_be_drilled_is_refused() {
        let refused = |hole: DeepHole| Cycle::DeepHole(hole).expansion().expect_err("refused").code();
        for hole in [
            DeepHole { first: 2.0, ..HOLE },
            DeepHole { first: f64::NAN, ..HOLE },
            DeepHole { step: 0.0, ..HOLE },
            DeepHole { step: 1e-7, ..HOLE },
            DeepHole { first_feed: 0.0, ..HOLE },
            DeepHole { dwell: -1.0, ..HOLE },
            DeepHole { bottom: 3.0, ..HOLE },
            DeepHole { retract: 0.0, ..HOLE },
            DeepHole { shortening: Shortening::By { decrement: 4.0, least: 0.0 }, ..HOLE },
            DeepHole { between: Between::Withdraw { clearance: -1.0, dwell: 0.0 }, ..HOLE },
        ] {
            assert_eq!(refused(hole), Code::NC_STATE, "{hole:?}");
        }
    }
}
