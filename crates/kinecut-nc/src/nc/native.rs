//! Which drilling cycles a control has of its own, and what of their motion a program cannot choose.

use crate::program::Cycle;

/// Form of a control's own drilling cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Native {
    /// It has none.
    None,
    /// `G81` and its like, in a series that `G80` ends.
    Canned(Canned),
    /// Calls with arguments (`CYCLE81`).
    Calls,
    /// Definitions that are called afterwards (`CYCL DEF`).
    Defined,
}

/// The words by which a control taps rigidly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TapWord {
    /// It has no spindle that the feed can be geared to.
    None,
    /// `M29 S`, then `G84` or `G74` in a series that `G80` ends.
    Canned,
    /// `G33.1 Z K`, a block a hole.
    Synchronised,
    /// `CYCLE84`.
    Called,
    /// `CYCL DEF 207`.
    Defined,
}

/// Details of canned cycles that their words do not give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Canned {
    /// Distance above the last depth at which the rapid back in of `G83` ends [mm].
    pub(super) clearance: f64,
    /// Lift of `G73` [mm].
    pub(super) lift: f64,
    /// Whether the interpreter finds its steps by subtracting Q again and again until the bottom is passed, so that the
    /// rounding of doubles may leave a step of no depth.
    pub(super) subtracts: bool,
    /// Whether these distances are parameters of the machine, which a program cannot know.
    pub(super) by_parameter: bool,
}

impl Canned {
    /// Whether the control makes the moves of this cycle, and no other.
    pub(super) fn runs_as_told(&self, cycle: &Cycle) -> bool {
        let (reference, bottom, step, above) = match *cycle {
            Cycle::Peck { reference, bottom, step, clearance, .. } => (reference, bottom, step, clearance),
            Cycle::ChipBreak { reference, bottom, step, lift, .. } => (reference, bottom, step, lift),
            _ => return true,
        };
        // A lift larger than the step would lead above R.
        if above > step {
            return false;
        }
        if !self.subtracts {
            return true;
        }
        let Ok(meant) = cycle.expansion() else { return false };
        let mut steps = 1;
        let mut depth = reference - step;
        while depth > bottom {
            depth -= step;
            steps += 1;
            if steps > meant.len() {
                return false;
            }
        }
        let told = meant.iter().filter(|s| matches!(s, crate::program::CycleStep::Feed(_))).count();
        steps == told
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NGC: Canned = Canned { clearance: 0.254, lift: 0.254, subtracts: true, by_parameter: false };

    fn peck(bottom: f64, step: f64) -> Cycle {
        Cycle::Peck { reference: 2.0, bottom, retract: 2.0, step, clearance: 0.254 }
    }

    #[test]
    fn a_step_of_no_depth_is_seen() {
        assert!(NGC.runs_as_told(&peck(-10.0, 4.0)));
        assert!(NGC.runs_as_told(&peck(-10.0, 5.0)));
        // 0.3 taken 40 times from 2 ends above -10 by the rounding.
        let mut depth = 2.0;
        for _ in 0..40 {
            depth -= 0.3;
        }
        assert_eq!(NGC.runs_as_told(&peck(-10.0, 0.3)), depth <= -10.0);
        assert!(Canned { subtracts: false, ..NGC }.runs_as_told(&peck(-10.0, 0.3)));
    }

    #[test]
    fn a_lift_beyond_the_step_is_seen() {
        let lift =
            |step: f64| Cycle::ChipBreak { reference: 2.0, bottom: 1.0, retract: 2.0, step, lift: 0.254 };
        assert!(!NGC.runs_as_told(&lift(0.2)) && NGC.runs_as_told(&lift(0.5)));
    }
}
