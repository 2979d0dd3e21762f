//! Rigid tapping as the control's own cycle. A thread is never written as moves: feed and spindle would not keep together.

use std::f64::consts::TAU;

use crate::base::{Code, Finding, Result};
use crate::nc::grid::plain;
use crate::nc::native::{Native, TapWord};
use crate::program::{Cycle, CycleStep, Spindle, State, Tapping};

use super::{Writer, unsupported};

impl Writer<'_> {
    /// A thread at the present position.
    ///
    /// # Errors
    /// `KC0301` where the control has no rigid tapping, `KC0204` where the place or the spindle does not allow it.
    pub(super) fn tap(
        &mut self,
        index: usize,
        tapping: &Tapping,
        steps: &[CycleStep],
        state: &State,
    ) -> Result<()> {
        if self.dialect.tap == TapWord::None {
            let title = self.settings.control.title();
            let finding = unsupported(format!("{title} has no synchronised spindle: tapping is refused"));
            return Err(finding.help("post for a control with rigid tapping, or tap by hand").into());
        }
        let wanted = Spindle::turning(tapping.hand, state.spindle.rate());
        if wanted != state.spindle || state.spindle.rate() <= 0.0 {
            let what = "a tapping cycle needs the spindle to turn in the sense of its thread";
            return Err(Finding::error(Code::NC_STATE, what).into());
        }
        let cycle = Cycle::Tap(*tapping);
        let written = match (self.dialect.tap, self.dialect.native) {
            (TapWord::Canned, Native::Canned(canned)) => self.canned(canned, &cycle, steps, state)?,
            (TapWord::Called, _) => self.call_cycle(index, &cycle, steps, state)?,
            (TapWord::Defined, _) => self.klartext_tap(tapping, steps, state)?,
            (TapWord::Synchronised, _) => self.synchronised_tap(tapping, steps, state)?,
            _ => false,
        };
        if !written {
            let what = "a tapping cycle cannot be written here";
            let finding = Finding::error(Code::NC_STATE, what);
            return Err(finding
                .help("move over the hole in its work offset first, without compensation")
                .into());
        }
        if matches!(self.dialect.tap, TapWord::Canned | TapWord::Defined) {
            // The cycle may stop it: it is switched on or off again.
            self.modal.spindle = Some(Spindle::Clockwise(f64::NAN));
        }
        Ok(())
    }

    /// A thread as its words are read, its heights in steps of the grid, and its pitch as written.
    pub(super) fn thread_on_grid(&self, tapping: &Tapping) -> Result<(Tapping, [i64; 3], String)> {
        let counts = self.on_grid([tapping.reference, tapping.bottom, tapping.retract])?;
        let [reference, bottom, retract] = counts.map(|c| self.grid.value(c));
        let pitch = self.grid.length(tapping.pitch);
        let read = pitch.parse::<f64>().unwrap_or(0.0) * self.settings.units.mm();
        Ok((Tapping { reference, bottom, retract, pitch: read, ..*tapping }, counts, pitch))
    }

    /// `M29`.
    pub(super) fn rigid(&mut self, spindle: Spindle) {
        self.page.block(format!("M29 S{}", plain(spindle.rate() / TAU * 60.0)));
    }

    /// `G33.1`, from the reference height and back to it; whether it was written.
    fn synchronised_tap(&mut self, tapping: &Tapping, steps: &[CycleStep], state: &State) -> Result<bool> {
        let (read, [top, low, _], pitch) = self.thread_on_grid(tapping)?;
        if !self.takes_cycle(state) || low >= top || !self.same_moves(steps, &Cycle::Tap(read)) {
            return Ok(false);
        }
        self.end_series();
        self.state(state, true)?;
        if self.place.written.iter().any(Option::is_none) {
            return Ok(false);
        }
        self.axial(tapping.reference, true, state)?;
        self.page.block(format!("G33.1 Z{} K{pitch}", self.grid.text(low)));
        self.modal.motion = None;
        self.axial(tapping.retract, true, state)?;
        Ok(true)
    }
}
