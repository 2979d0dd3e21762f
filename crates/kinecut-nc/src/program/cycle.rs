//! Cycles of drilling and tapping, and their expansion into moves.

use super::deep_hole::WHOLE_STEP;
use super::{DeepHole, Tapping};
use crate::base::{Code, Finding, Result};

/// A cycle at one position; heights in the frame of the program [mm], along the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cycle {
    /// Feed to depth, rapid out (`G81`); with a dwell [s] at the bottom (`G82`).
    Drill {
        /// Height from which to feed.
        reference: f64,
        /// Height of the bottom.
        bottom: f64,
        /// Height to which the tool returns.
        retract: f64,
        /// Dwell at the bottom [s].
        dwell: f64,
    },
    /// Feed in steps with full retraction (`G83`).
    Peck {
        /// Height from which to feed.
        reference: f64,
        /// Height of the bottom.
        bottom: f64,
        /// Height to which the tool returns.
        retract: f64,
        /// Depth of a step.
        step: f64,
        /// Distance above the last depth at which the rapid back in ends.
        clearance: f64,
    },
    /// Feed in steps with a small lift to break the chip (`G73`).
    ChipBreak {
        /// Height from which to feed.
        reference: f64,
        /// Height of the bottom.
        bottom: f64,
        /// Height to which the tool returns.
        retract: f64,
        /// Depth of a step.
        step: f64,
        /// Lift after each step.
        lift: f64,
    },
    /// Feed in steps with all that a control can say of them.
    DeepHole(DeepHole),
    /// Rigid tapping (`G84` and `G74` with `M29`, `CYCLE84`, `CYCL DEF 207`, `G33.1`).
    Tap(Tapping),
}

/// One step of an expanded cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CycleStep {
    /// Rapid to this height [mm].
    Rapid(f64),
    /// Feed to this height [mm].
    Feed(f64),
    /// Feed to this height at a part of the feed.
    FeedAt {
        /// The height [mm].
        height: f64,
        /// Part of the feed.
        factor: f64,
    },
    /// Move to this height with the feed geared to the spindle.
    Thread {
        /// The height [mm].
        height: f64,
        /// Way of one revolution [mm].
        pitch: f64,
    },
    /// Wait [s].
    Dwell(f64),
}

impl Cycle {
    /// Most steps that an expansion may have.
    pub const MAX_STEPS: usize = 100_000;

    /// The heights that every cycle has: reference, bottom, and that to which the tool returns [mm], not a number where the program has
    /// not set it.
    pub fn heights(&self) -> [f64; 3] {
        let mut cycle = *self;
        cycle.heights_mut().map(|height| *height)
    }

    /// The same, to be changed.
    pub(super) fn heights_mut(&mut self) -> [&mut f64; 3] {
        match self {
            Cycle::Drill { reference, bottom, retract, .. }
            | Cycle::Peck { reference, bottom, retract, .. }
            | Cycle::ChipBreak { reference, bottom, retract, .. }
            | Cycle::DeepHole(DeepHole { reference, bottom, retract, .. })
            | Cycle::Tap(Tapping { reference, bottom, retract, .. }) => [reference, bottom, retract],
        }
    }

    /// The moves along the tool axis, from the position above the hole.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::program::{Cycle, CycleStep::*};
    /// let g83 = Cycle::Peck { reference: 2.0, bottom: -10.0, retract: 50.0, step: 7.0, clearance: 0.5 };
    /// assert_eq!(
    ///     g83.expansion().unwrap(),
    ///     [Rapid(2.0), Feed(-5.0), Rapid(2.0), Rapid(-4.5), Feed(-10.0), Rapid(50.0)]
    /// );
    /// ```
    ///
    /// # Errors
    /// `KC0204` when heights are out of order, a step is not positive, or the steps are too many.
    pub fn expansion(&self) -> Result<Vec<CycleStep>> {
        use CycleStep::{Dwell, Feed, Rapid};
        let [reference, bottom, retract] = self.heights();
        let ordered =
            bottom.is_finite() && !retract.is_infinite() && bottom < reference && !(reference > retract);
        if !ordered {
            return Err(Finding::error(
                Code::NC_STATE,
                "a cycle must have its bottom below the reference height",
            )
            .value_mm(bottom)
            .bound_mm(reference)
            .into());
        }
        let mut steps = vec![Rapid(reference)];
        match *self {
            Cycle::Drill { dwell, .. } => {
                steps.push(Feed(bottom));
                if dwell > 0.0 {
                    steps.push(Dwell(dwell));
                }
            }
            Cycle::DeepHole(hole) => steps.extend(hole.steps(Cycle::MAX_STEPS / 4)?),
            Cycle::Tap(tapping) => steps.extend(tapping.steps()?),
            Cycle::Peck { step, .. } | Cycle::ChipBreak { step, .. } => {
                let count = ((reference - bottom) / step - WHOLE_STEP).ceil().max(1.0);
                if !(step > 0.0 && count < (Cycle::MAX_STEPS / 4) as f64) {
                    return Err(Finding::error(Code::NC_STATE, "the step of a drilling cycle is too small")
                        .value_mm(step)
                        .bound_mm((reference - bottom) * 4.0 / Cycle::MAX_STEPS as f64)
                        .into());
                }
                let count = count as u32;
                for i in 1..=count {
                    let depth = if i == count { bottom } else { reference - step * f64::from(i) };
                    steps.push(Feed(depth));
                    match *self {
                        Cycle::Peck { clearance, .. } if i < count => {
                            steps.push(Rapid(reference));
                            steps.push(Rapid(reference.min(depth + clearance)));
                        }
                        Cycle::ChipBreak { lift, .. } if i < count => {
                            steps.push(Rapid(reference.min(depth + lift)))
                        }
                        _ => {}
                    }
                }
            }
        }
        steps.push(Rapid(retract));
        Ok(steps)
    }

    /// The drilling cycle of a hole that needs one step only.
    pub(crate) fn in_one_go(steps: &[CycleStep]) -> Option<Cycle> {
        use CycleStep::{Dwell, Feed, Rapid};
        match *steps {
            [Rapid(reference), Feed(bottom), Rapid(retract)] => {
                Some(Cycle::Drill { reference, bottom, retract, dwell: 0.0 })
            }
            [Rapid(reference), Feed(bottom), Dwell(dwell), Rapid(retract)] => {
                Some(Cycle::Drill { reference, bottom, retract, dwell })
            }
            _ => None,
        }
    }
}
