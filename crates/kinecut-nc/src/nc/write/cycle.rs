//! Cycles of drilling: as the control's own where it then makes the same moves, otherwise as those moves.
//!
//! The words of a cycle are rounded, read as the control reads them, and expanded; only if every height, dwell and kind
//! of move is that of the program's cycle within the rounding is the cycle written. A control whose lift or clearance is
//! a fixed one therefore never makes another motion than the program. Cycles are written at known positions only.
//!
//! Holes that follow one another with the same words are a series: `write::series`.

use crate::base::{Code, Finding, Result};
use crate::nc::dialect::{AXES, Plane};
use crate::nc::grid::plain;
use crate::nc::native::{Canned, Native};
use crate::program::{Comp, Cycle, CycleStep, SAME_PITCH, Speed, State, Tapping, Tcp};
use crate::tool::Hand;

use super::series::Series;
use super::{Writer, unsupported};

/// Largest difference of two heights that are the same on the grid, in its steps: half a step, and the rounding of
/// doubles.
const SAME: f64 = 0.5 + 1e-6;

impl Writer<'_> {
    /// A cycle, natively or as moves.
    pub(super) fn cycle(
        &mut self,
        index: usize,
        cycle: &Cycle,
        steps: &[CycleStep],
        state: &State,
    ) -> Result<()> {
        let cycle = &Cycle::in_one_go(steps).unwrap_or(*cycle);
        if cycle.heights()[2].is_nan() {
            let message = "a cycle returns to a height that the program has not set";
            return Err(Finding::error(Code::NC_STATE, message).help("move Z there before the cycle").into());
        }
        if state.tcp != Tcp::Off && !self.klartext() {
            return Err(unsupported("a drilling cycle under control of the tool centre point")
                .help("drill in a tilted plane, or give the moves")
                .into());
        }
        if self.turns_for(state)? {
            self.end_series();
            self.state(state, true)?;
            self.name_place(Speed::Rapid { linear: false })?;
        }
        if let Cycle::Tap(tapping) = cycle {
            return self.tap(index, tapping, steps, state);
        }
        let written = match self.dialect.native {
            Native::None => false,
            Native::Canned(canned) => self.canned(canned, cycle, steps, state)?,
            Native::Calls => self.call_cycle(index, cycle, steps, state)?,
            Native::Defined => self.klartext_cycle(cycle, steps, state)?,
        };
        if written {
            return Ok(());
        }
        self.end_series();
        self.cycle_moves(steps, state)
    }

    /// The moves of a cycle, one by one.
    fn cycle_moves(&mut self, steps: &[CycleStep], state: &State) -> Result<()> {
        for step in steps {
            match *step {
                CycleStep::Rapid(height) => self.axial(height, true, state)?,
                CycleStep::Feed(height) => self.axial(height, false, state)?,
                CycleStep::FeedAt { height, factor } => {
                    let speed = state.speed.times(factor);
                    self.axial(height, false, &State { speed, ..*state })?;
                }
                // A thread is never written as moves.
                CycleStep::Thread { .. } => return Err(unsupported("a thread as moves").into()),
                CycleStep::Dwell(seconds) if self.klartext() => self.klartext_dwell(seconds)?,
                CycleStep::Dwell(seconds) => self.dwell(seconds),
            }
        }
        Ok(())
    }

    /// Whether a control's own cycle is allowed here at all.
    pub(super) fn takes_cycle(&self, state: &State) -> bool {
        let known = self.place.written.iter().all(Option::is_some);
        let fed =
            matches!(state.speed, Speed::PerMinute(f) | Speed::PerRevolution(f) if f.is_finite() && f > 0.0);
        known && fed && state.comp == Comp::Off && self.length_pending.is_none() && !self.length_suspended
    }

    /// Whether the moves of a cycle as the control reads its words are those that were meant, within the rounding;
    /// notes the rounding if they are.
    pub(super) fn same_moves(&mut self, steps: &[CycleStep], read: &Cycle) -> bool {
        let Ok(read) = read.expansion() else { return false };
        if read.len() != steps.len() {
            return false;
        }
        let mut rounding = 0.0f64;
        for (a, b) in steps.iter().zip(&read) {
            let difference =
                match (*a, *b) {
                    (CycleStep::Rapid(a), CycleStep::Rapid(b)) | (CycleStep::Feed(a), CycleStep::Feed(b)) => {
                        a - b
                    }
                    (
                        CycleStep::FeedAt { height: a, factor: f },
                        CycleStep::FeedAt { height: b, factor: g },
                    ) if f == g => a - b,
                    (
                        CycleStep::Thread { height: a, pitch: p },
                        CycleStep::Thread { height: b, pitch: q },
                    ) if (p - q).abs() <= SAME_PITCH => a - b,
                    (CycleStep::Dwell(a), CycleStep::Dwell(b)) if (a - b).abs() <= self.dwell_rounding() => {
                        continue;
                    }
                    _ => return false,
                };
            if !(difference.abs() <= SAME * self.grid.unit()) {
                return false;
            }
            rounding = rounding.max(difference.abs());
        }
        self.notes.rounding = self.notes.rounding.max(rounding);
        true
    }

    /// `G81`, `G82`, `G83`, `G73`; whether it was written.
    pub(super) fn canned(
        &mut self,
        canned: Canned,
        cycle: &Cycle,
        steps: &[CycleStep],
        state: &State,
    ) -> Result<bool> {
        if self.takes_up(cycle, state) {
            let words = self.modal.hole.take().unwrap_or_default();
            let words = if words.is_empty() { self.hole_words()? } else { words };
            self.page.block(words);
            return Ok(true);
        }
        if !self.takes_cycle(state) {
            return Ok(false);
        }
        let Some(block) = self.canned_block(canned, cycle, steps)? else { return Ok(false) };
        self.end_series();
        self.state(state, true)?;
        // The state may have changed the work offset, after which no position is known.
        if self.place.written.iter().any(Option::is_none) {
            return Ok(false);
        }
        // A cycle that begins below R rises to it first.
        if let Some(CycleStep::Rapid(reference)) = steps.first().copied()
            && self.place.written[2] < Some(self.grid.round(reference)?)
        {
            self.axial(reference, true, state)?;
        }
        let (code, rest) = block;
        let axes = format!("{} {rest}", self.hole_words()?);
        let speed = match *cycle {
            Cycle::Tap(Tapping { pitch, .. }) => {
                self.rigid(state.spindle);
                Speed::PerRevolution(pitch)
            }
            _ => state.speed,
        };
        self.emit(Some(Plane::Xy), Some(&code), &axes, speed)?;
        self.after_cycle(steps)?;
        self.parameters_used |=
            canned.by_parameter && matches!(cycle, Cycle::Peck { .. } | Cycle::ChipBreak { .. });
        self.modal.series = Some(Series { cycle: *cycle, state: *state, end: "G80" });
        Ok(true)
    }

    /// Says in the head what cycles count on that a program cannot say.
    pub(super) fn remark_parameters(&mut self) {
        if self.parameters_used {
            let from = self.page.len();
            self.comment("Parameters 5114 (lift of G73) and 5115 (clearance of G83) must be 1 mm");
            self.page.bring_up(from, self.remarks_end);
        }
    }

    /// Sets the position of the tool after a cycle.
    pub(super) fn after_cycle(&mut self, steps: &[CycleStep]) -> Result<()> {
        self.modal.motion = None;
        if let Some(CycleStep::Rapid(height)) = steps.last().copied() {
            self.place.written[2] = Some(self.grid.round(height)?);
            self.place.exact[2] = height;
        }
        Ok(())
    }

    /// The place of the present hole.
    fn hole_words(&self) -> Result<String> {
        let mut words = String::new();
        for axis in 0..2 {
            self.grid.word(&mut words, AXES[axis], self.written(axis)?);
        }
        Ok(words)
    }

    /// Code and words of a canned cycle, if it makes these moves.
    fn canned_block(
        &mut self,
        canned: Canned,
        cycle: &Cycle,
        steps: &[CycleStep],
    ) -> Result<Option<(String, String)>> {
        let (Some(level), false) = (self.place.written[2], steps.is_empty()) else { return Ok(None) };
        let (reference, bottom, retract, step, dwell) = match *cycle {
            Cycle::Drill { reference, bottom, retract, dwell } => (reference, bottom, retract, None, dwell),
            Cycle::Peck { reference, bottom, retract, step, .. }
            | Cycle::ChipBreak { reference, bottom, retract, step, .. } => {
                (reference, bottom, retract, Some(step), 0.0)
            }
            Cycle::Tap(Tapping { reference, bottom, retract, .. }) => (reference, bottom, retract, None, 0.0),
            _ => return Ok(None),
        };
        let [top, low, up] =
            [self.grid.round(reference)?, self.grid.round(bottom)?, self.grid.round(retract)?];
        // It returns to R or to where the series began.
        let back = if up == top {
            "G99"
        } else if up == level && up > top {
            "G98"
        } else {
            return Ok(None);
        };
        let q = step.map(|s| self.grid.round(s)).transpose()?;
        let [reference, bottom, retract] = [top, low, up].map(|c| self.grid.value(c));
        let step = q.map_or(0.0, |q| self.grid.value(q));
        let pause = match dwell {
            0.0 => None,
            seconds => Some(self.dwell_number(seconds)),
        };
        let dwell = pause.as_ref().and_then(|p| p.parse::<f64>().ok()).unwrap_or(0.0) * self.dialect.dwell.1;
        let (code, read) = match cycle {
            Cycle::Drill { .. } => {
                let code = if pause.is_some() { "G82" } else { "G81" };
                (code, Cycle::Drill { reference, bottom, retract, dwell })
            }
            Cycle::Peck { .. } => {
                ("G83", Cycle::Peck { reference, bottom, retract, step, clearance: canned.clearance })
            }
            Cycle::Tap(tapping) => {
                let code = if tapping.hand == Hand::Right { "G84" } else { "G74" };
                (code, Cycle::Tap(Tapping { reference, bottom, retract, ..*tapping }))
            }
            _ => ("G73", Cycle::ChipBreak { reference, bottom, retract, step, lift: canned.lift }),
        };
        if low >= top || !canned.runs_as_told(&read) || !self.same_moves(steps, &read) {
            return Ok(None);
        }
        let mut words = String::new();
        self.grid.word(&mut words, AXES[2], low);
        self.grid.word(&mut words, "R", top);
        if let Some(q) = q {
            self.grid.word(&mut words, "Q", q);
        }
        if let Some(pause) = pause {
            words.push_str(" P");
            words.push_str(&pause);
        }
        Ok(Some((format!("{back} {code}"), words)))
    }

    /// Largest difference of a dwell that was written and read.
    fn dwell_rounding(&self) -> f64 {
        match self.dialect.dwell.1 {
            // Seconds have seven decimals.
            1.0 => 1e-7,
            unit => SAME * unit,
        }
    }

    /// The time of a dwell in the control's unit.
    pub(super) fn dwell_number(&self, seconds: f64) -> String {
        let unit = self.dialect.dwell.1;
        if unit == 1.0 {
            return plain(seconds);
        }
        // A count of milliseconds, not less than one for a dwell at all.
        let count = (seconds / unit).round();
        plain(if count == 0.0 && seconds > 0.0 { 1.0 } else { count })
    }
}

/// The surface from which a hole counts, of its reference height and its bottom in steps of the grid: mostly the work zero; if the
/// hole does not begin there, the reference height.
pub(super) fn surface(top: i64, low: i64) -> i64 {
    if low < 0 && top > 0 { 0 } else { top }
}
