//! One hole of a canned cycle: the way to it, and its moves.
//!
//! Holes along Z that only go down and up again are cycles of the program. Along X and Y, with a way out at feed or with a spindle
//! that stops or turns back, they are moves: no other control would run them from its own words.

use crate::base::Result;
use crate::nc::dialect::{CycleKind, Plane, SeriesRule};
use crate::program::{Cycle, CycleStep, Path, Speed, Spindle, State};
use crate::tool::Hand;

use super::boring::Shift;
use super::reader::{Kind, Reader};

/// A hole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hole {
    pub(super) kind: CycleKind,
    /// Its heights, along the axis that is square to the plane.
    pub(super) cycle: Cycle,
    /// Words of the plane's axes [mm], and whether each is absolute.
    pub(super) moves: [Option<(f64, bool)>; 2],
    /// Heights of the way to it: first to one, then to the hole at another [mm]; not numbers where the height is not known.
    pub(super) way: [f64; 2],
    pub(super) speed: Speed,
    pub(super) spindle: Spindle,
    /// Wait at the bottom [s].
    pub(super) dwell: f64,
    /// Step aside at the bottom.
    pub(super) shift: Option<Shift>,
}

impl Reader<'_> {
    /// Height at which the tool is, where a cycle is read [mm].
    pub(super) fn height(&self) -> f64 {
        let [_, _, n] = self.modal.plane.axes();
        self.modal.position[n].unwrap_or_default()
    }

    /// Refuses a cycle whose spindle does not turn as it must.
    pub(super) fn turns_as_it_must(&self, kind: CycleKind) -> Result<()> {
        let interpreter = self.dialect.series != SeriesRule::Fanuc;
        let turns = match (kind, self.modal.spindle) {
            (CycleKind::BoreStop, Spindle::Off) => !interpreter,
            (CycleKind::Floating(Hand::Right), spindle) => matches!(spindle, Spindle::Clockwise(_)),
            (CycleKind::Floating(Hand::Left), spindle) => matches!(spindle, Spindle::CounterClockwise(_)),
            _ => true,
        };
        if turns {
            return Ok(());
        }
        let what = "the spindle does not turn as this cycle needs it";
        Err(self.lacks(&self.here, what).help("program M3 (G74: M4) before it").into())
    }

    /// The way to a hole, and the hole.
    pub(super) fn drill(&mut self, hole: &Hole) -> Result<()> {
        let [a, b, n] = self.modal.plane.axes();
        let [first, height] = hole.way;
        let rapid = Speed::Rapid { linear: self.dialect.straight_rapid };
        let mut at = self.modal.position;
        if first.is_finite() && at[n] != Some(first) {
            at[n] = Some(first);
            self.push_tip(at, Path::Line, rapid);
        }
        for (axis, to) in [a, b].into_iter().zip(hole.moves) {
            if let Some((to, absolute)) = to {
                at[axis] = Some(if absolute { to } else { at[axis].unwrap_or(0.0) + to });
            }
        }
        at[n] = Some(height).filter(|z| z.is_finite());
        self.push_tip(at, Path::Line, rapid);
        let [reference, _, retract] = hole.cycle.heights();
        if height.is_nan() {
            // Down or up to R, which is known.
            at[n] = Some(reference);
            self.push_tip(at, Path::Line, rapid);
        }
        let plain = matches!(
            hole.kind,
            CycleKind::Drill
                | CycleKind::DrillDwell
                | CycleKind::Peck
                | CycleKind::ChipBreak
                | CycleKind::Tap(_)
        );
        if self.modal.plane != Plane::Xy || !plain {
            if retract.is_nan() {
                let what = "this cycle begins at a height that the program has not set, and returns to it";
                return Err(self.lacks(&self.here, what).help("move Z there first").into());
            }
            return self.moves_of(hole);
        }
        self.flush(Kind::Tip);
        let state = State { spindle: hole.spindle, ..self.state(hole.speed) };
        let located = |e: crate::base::Error| e.0.at(self.place.sources.locate(self.place.span(&self.here)));
        self.program.push_cycle(hole.cycle, &state, self.origin).map_err(located)?;
        self.modal.position[n] = Some(retract).filter(|z| z.is_finite());
        Ok(())
    }

    /// A feed move of `G84` or `G74`, which the interpreter of LinuxCNC 2.9 makes in G18 as it should in G19, and the other way
    /// round (its test-suite expects it so): to another place than that of the hole.
    fn floating_feed(&mut self, height: f64, speed: Speed) {
        let [a, b, n] = self.modal.plane.axes();
        let exchanged = match self.modal.plane {
            Plane::Zx => Plane::Yz,
            Plane::Yz => Plane::Zx,
            Plane::Xy => return self.go_to_height(height, speed),
        };
        self.warn(
            &self.here.clone(),
            "LinuxCNC 2.9 exchanges axes in G84 and G74 outside of G17: the tool goes beside the hole",
        );
        let mut believed = self.modal.position;
        believed[n] = Some(height);
        let mut at = [None; 3];
        let [c, d, m] = exchanged.axes();
        (at[c], at[d], at[m]) = (believed[a], believed[b], Some(height));
        self.push_tip(at, Path::Line, speed);
        // Where the interpreter takes the tool to be.
        self.modal.position = believed;
    }

    /// The moves of a hole, one by one.
    fn moves_of(&mut self, hole: &Hole) -> Result<()> {
        let rapid = Speed::Rapid { linear: self.dialect.straight_rapid };
        let [reference, bottom, retract] = hole.cycle.heights();
        let Cycle::Drill { dwell, .. } = hole.cycle else { return self.expanded(hole) };
        if matches!(hole.kind, CycleKind::Drill | CycleKind::DrillDwell) {
            return self.expanded(hole);
        }
        match (hole.kind, hole.shift) {
            (CycleKind::FineBore, Some(shift)) => {
                self.fine_bored(hole, shift);
                return Ok(());
            }
            (CycleKind::BackBore, Some(shift)) => {
                self.back_bored(hole, shift);
                return Ok(());
            }
            (CycleKind::LeftByHand, _) => {
                self.left_by_hand(hole);
                return Ok(());
            }
            _ => {}
        }
        if self.height() != reference {
            self.go_to_height(reference, rapid);
        }
        match hole.kind {
            CycleKind::Floating(_) => self.floating_feed(bottom, hole.speed),
            _ => self.go_to_height(bottom, hole.speed),
        }
        let turning = self.modal.spindle;
        match hole.kind {
            CycleKind::BoreStop => {
                self.wait(dwell);
                self.modal.spindle = Spindle::Off;
                self.go_to_height(retract, rapid);
            }
            CycleKind::Floating(_) => {
                self.modal.spindle = match turning {
                    Spindle::Clockwise(rate) => Spindle::CounterClockwise(rate),
                    Spindle::CounterClockwise(rate) => Spindle::Clockwise(rate),
                    Spindle::Off => Spindle::Off,
                };
                // The spindle turns back while the axis rests.
                self.push_dwell(dwell);
                self.floating_feed(retract, hole.speed);
            }
            _ => {
                self.wait(if hole.kind == CycleKind::BoreDwell { dwell } else { 0.0 });
                // LinuxCNC goes on at feed to the height of the return behind a wait.
                let at_feed =
                    hole.kind == CycleKind::BoreDwell && self.dialect.series == SeriesRule::Interpreter;
                self.go_to_height(if at_feed { retract } else { reference }, hole.speed);
                if self.height() != retract {
                    self.go_to_height(retract, rapid);
                }
            }
        }
        self.modal.spindle = turning;
        Ok(())
    }

    /// The steps of a drilling cycle.
    fn expanded(&mut self, hole: &Hole) -> Result<()> {
        let rapid = Speed::Rapid { linear: self.dialect.straight_rapid };
        let located = |e: crate::base::Error| e.0.at(self.place.sources.locate(self.place.span(&self.here)));
        let steps = hole.cycle.expansion().map_err(located)?;
        for step in steps {
            match step {
                CycleStep::Dwell(seconds) => self.wait(seconds),
                CycleStep::Rapid(height) => {
                    if self.height() != height {
                        self.go_to_height(height, rapid);
                    }
                }
                CycleStep::Feed(height) => self.go_to_height(height, hole.speed),
                CycleStep::FeedAt { height, factor } => self.go_to_height(height, hole.speed.times(factor)),
                CycleStep::Thread { .. } => {
                    let what = "a thread that is not along Z is not read";
                    return Err(self.place.not_understood(&self.here, what).into());
                }
            }
        }
        Ok(())
    }

    pub(super) fn go_to_height(&mut self, height: f64, speed: Speed) {
        let [_, _, n] = self.modal.plane.axes();
        let mut end = self.modal.position;
        end[n] = Some(height);
        self.push_tip(end, Path::Line, speed);
    }

    pub(super) fn wait(&mut self, seconds: f64) {
        if seconds > 0.0 {
            self.push_dwell(seconds);
        }
    }
}
