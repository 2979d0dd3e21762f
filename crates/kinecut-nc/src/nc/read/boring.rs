//! Boring cycles of FANUC and Haas in which the tool steps aside: `G76`, `G87` of FANUC; and those whose way out is by hand: `G88`,
//! `G87` of Haas.
//!
//! `G76` feeds to Z, waits P, stops the spindle at its angle, steps aside, leaves in rapid and steps back. `G87` steps aside at the
//! height where the series began, goes down to R below the work, steps back, feeds up to Z with the spindle turning, waits, steps
//! aside with the spindle at its angle, leaves to where it began and steps back. It returns there only (`G98`).
//!
//! Q is the length of the step, without a sign; its direction is a parameter of the machine (FANUC 5148, 6240; Haas setting 27): the
//! first axis of the plane is assumed, and that is a doubt. `I J` say both, in `G17`; a FANUC then steps at the feed.
//!
//! Source: operator's manual of the 15i (`G76`, I J, Q), fixed cycles of the 9/Series (`G87`), pages of the Haas manual 96-8000.

use crate::base::Result;
use crate::nc::dialect::{CycleKind, Plane, SeriesRule};
use crate::program::{Between, Cycle, DeepHole, Path, Shortening, Speed, Spindle, StopKind};

use super::block::Word;
use super::hole::Hole;
use super::reader::{Reader, take};
use super::sticky::Sticky;

/// Step of the tool aside, in the plane [mm].
#[derive(Clone, Copy, Debug)]
pub(super) struct Shift {
    by: [f64; 2],
    at_feed: bool,
}

impl<'s> Reader<'s> {
    /// Takes the words that only some cycles have: the step aside, and the three depths of a step of Haas.
    pub(super) fn words_of_kind(&mut self, words: &mut [Word<'s>], kind: CycleKind) -> Result<()> {
        if self.dialect.series != SeriesRule::Fanuc {
            return Ok(());
        }
        let unit = self.modal.length_unit;
        match kind {
            CycleKind::FineBore | CycleKind::BackBore if self.modal.plane == Plane::Xy => {
                let [i, j] = ["I", "J"].map(|name| take(words, name).map(|v| v.value * unit));
                if i.is_some() || j.is_some() {
                    self.modal.sticky.shift = Some([i.unwrap_or(0.0), j.unwrap_or(0.0)]);
                }
            }
            CycleKind::Peck | CycleKind::ChipBreak if self.dialect.haas => {
                let said = ["I", "J", "K"].map(|name| take(words, name));
                if let [Some(first), Some(less), Some(least)] = &said {
                    self.modal.sticky.pecks = Some([first, less, least].map(|v| v.value * unit));
                } else if let Some(word) = said.into_iter().flatten().next() {
                    let why = "of the steps by I, J and K all three are read, and no others";
                    return Err(self.place.not_understood(&word.bytes, why).into());
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// The drilling cycle in steps that a Haas says beyond a FANUC: steps that shorten, and a wait at the bottom.
    pub(super) fn own_steps(&self, cycle: Cycle, sticky: &Sticky) -> Cycle {
        if !self.dialect.haas {
            return cycle;
        }
        let (between, step) = match cycle {
            Cycle::Peck { clearance, step, .. } => (Between::Withdraw { clearance, dwell: 0.0 }, step),
            Cycle::ChipBreak { lift, step, .. } => (Between::Lift { lift, at_feed: false }, step),
            _ => return cycle,
        };
        let [reference, bottom, retract] = cycle.heights();
        let dwell_bottom = sticky.dwell.unwrap_or(0.0);
        let (first, step, shortening) = match sticky.pecks {
            Some([first, decrement, least]) => {
                (first, (first - decrement).max(least), Shortening::By { decrement, least })
            }
            None if dwell_bottom > 0.0 => (step, step, Shortening::None),
            None => return cycle,
        };
        let first = reference - first;
        let hole = DeepHole {
            reference,
            first,
            bottom,
            retract,
            step,
            shortening,
            between,
            first_feed: 1.0,
            dwell: 0.0,
            dwell_bottom,
        };
        Cycle::DeepHole(hole)
    }

    /// The step aside of a cycle that has one.
    pub(super) fn shift_of(&mut self, kind: CycleKind, sticky: &Sticky) -> Result<Option<Shift>> {
        if !matches!(kind, CycleKind::FineBore | CycleKind::BackBore) {
            return Ok(None);
        }
        let here = self.here.clone();
        if kind == CycleKind::BackBore {
            if !self.modal.return_to_start {
                let finding = self.lacks(&here, "back boring (G87) returns to where it began only");
                return Err(finding.help("program G98").into());
            }
            if let (Some(r), Some(z), Some(begun)) = (sticky.reference, sticky.bottom, sticky.begun)
                && !(r < z && z <= begun)
            {
                let finding = self.lacks(&here, "back boring (G87) begins at R below Z, and under its start");
                return Err(finding.value_mm(r).bound_mm(z).into());
            }
        }
        match (sticky.step.map(f64::abs).filter(|q| *q > 0.0), sticky.shift) {
            // A Haas takes I and J where there is no Q; a FANUC has one or the other by a parameter.
            (None, Some(by)) => Ok(Some(Shift { by, at_feed: !self.dialect.haas })),
            (Some(_), Some(_)) if !self.dialect.haas => {
                let message =
                    "whether Q or I and J is the step aside is a parameter of the machine (6200 SIJ)";
                Err(self.lacks(&here, message).help("program one of them").into())
            }
            (Some(q), _) => {
                let parameter = if self.dialect.haas { "setting 27" } else { "5148" };
                let axis = ["X", "Z", "Y"][self.modal.plane as usize];
                let message = format!(
                    "the direction of the step aside in a boring cycle is a parameter of the machine ({parameter}): {axis}+ is assumed"
                );
                self.doubt(&here, &message, "see that the tool is free on all sides");
                Ok(Some(Shift { by: [q, 0.0], at_feed: false }))
            }
            (None, None) => {
                Err(self.lacks(&here, "a cycle that steps aside without Q").help("program Q").into())
            }
        }
    }

    fn step_aside(&mut self, shift: Shift, back: bool, feed: Speed) {
        let [a, b, _] = self.modal.plane.axes();
        let mut at = self.modal.position;
        for (axis, by) in [a, b].into_iter().zip(shift.by) {
            at[axis] = at[axis].map(|v| if back { v - by } else { v + by });
        }
        let rapid = Speed::Rapid { linear: self.dialect.straight_rapid };
        self.push_tip(at, Path::Line, if shift.at_feed { feed } else { rapid });
    }

    /// Aside with the spindle at its angle, to a height in rapid, and back; the spindle turns again.
    fn aside_to(&mut self, height: f64, shift: Shift, feed: Speed) {
        let (turning, place) = (self.modal.spindle, self.modal.position);
        self.modal.spindle = Spindle::Off;
        self.step_aside(shift, false, feed);
        self.go_to_height(height, Speed::Rapid { linear: self.dialect.straight_rapid });
        self.step_aside(shift, true, feed);
        self.placed_as(place);
        self.modal.spindle = turning;
    }

    /// Down to R in rapid, to the bottom at feed, and the wait there.
    fn bored_to_bottom(&mut self, hole: &Hole) {
        let [reference, bottom, _] = hole.cycle.heights();
        if self.height() != reference {
            self.go_to_height(reference, Speed::Rapid { linear: self.dialect.straight_rapid });
        }
        self.go_to_height(bottom, hole.speed);
        self.wait(hole.dwell);
    }

    /// The moves of `G76`, from above the hole.
    pub(super) fn fine_bored(&mut self, hole: &Hole, shift: Shift) {
        self.bored_to_bottom(hole);
        self.aside_to(hole.cycle.heights()[2], shift, hole.speed);
    }

    /// The moves of `G87` of FANUC, from above the hole.
    pub(super) fn back_bored(&mut self, hole: &Hole, shift: Shift) {
        let [reference, bottom, retract] = hole.cycle.heights();
        self.aside_to(reference, shift, hole.speed);
        self.go_to_height(bottom, hole.speed);
        self.wait(hole.dwell);
        self.aside_to(retract, shift, hole.speed);
    }

    /// The moves of `G88`, and of `G87` of Haas, from above the hole: the operator takes the tool out.
    pub(super) fn left_by_hand(&mut self, hole: &Hole) {
        let turning = self.modal.spindle;
        self.bored_to_bottom(hole);
        self.modal.spindle = Spindle::Off;
        self.push_stop(StopKind::Program);
        let message = "the tool leaves the hole by hand after a boring cycle stops: a rapid out is assumed";
        let here = self.here.clone();
        self.warn(&here, message);
        self.go_to_height(hole.cycle.heights()[2], Speed::Rapid { linear: self.dialect.straight_rapid });
        self.modal.spindle = turning;
    }

    /// Back in the plane, to the last bit.
    fn placed_as(&mut self, place: [Option<f64>; 3]) {
        let [a, b, _] = self.modal.plane.axes();
        (self.modal.position[a], self.modal.position[b]) = (place[a], place[b]);
    }
}
