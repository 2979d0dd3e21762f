//! Calls of cycles by name, once or after each block that moves (`MCALL`).
//!
//! A call is in a block of its own and runs at the present position, under the feed in force; the modal codes are
//! after it what they were before. `MCALL CYCLE81(...)` runs the cycle at the end of each block that moves an axis,
//! until `MCALL` alone.

use crate::base::{Error, Result};
use crate::nc::dialect::Plane;
use crate::nc::sinumerik::{cycle, swivel};
use crate::program::{Cycle, Item, Speed, State, Tapping, Tcp};

use super::block::Call;
use super::reader::{Kind, Reader};

impl<'s> Reader<'s> {
    /// A block with a call, or with `MCALL` alone.
    pub(super) fn called(&mut self, call: Option<&Call<'s>>, modal: bool) -> Result<()> {
        let here = self.here.clone();
        if self.codes.len() > usize::from(modal) {
            return Err(self.lacks(&here, "a call stands in a block of its own").into());
        }
        let Some(call) = call else {
            self.modal.modal_call = None;
            return Ok(());
        };
        if call.name.eq_ignore_ascii_case(swivel::NAME) {
            if modal || self.modal.modal_call.is_some() {
                let finding =
                    self.lacks(&here, "the coordinates change while a cycle is called after each block");
                return Err(finding.help("end it first (MCALL)").into());
            }
            return self.swivel(call);
        }
        let Some(kind) = cycle::Call::parse(call.name) else {
            return Err(self.place.not_understood(&call.bytes, "this call is not read yet").into());
        };
        let read = kind.read(&call.arguments, self.modal.length_unit, self.modal.speed).map_err(|wrong| {
            let (bytes, what) = match wrong.argument {
                Some(place) => (call.places.get(place).unwrap_or(&call.bytes), kind.argument(place)),
                None => (&call.bytes, "the call"),
            };
            self.place.not_understood(bytes, &format!("{what} of {}: {}", kind.name(), wrong.why))
        })?;
        if let Some(what) = read.disputed {
            self.note(&format!("{} is read as usual, not checked against a manual: {what}", kind.name()));
        }
        if modal {
            self.modal.modal_call = Some(read);
            return Ok(());
        }
        self.run_call(read)
    }

    /// Runs the modal cycle if a block has moved; `before`: number of items before the block.
    pub(super) fn call_after_motion(&mut self, before: usize) -> Result<()> {
        let Some(call) = self.modal.modal_call else { return Ok(()) };
        let moved =
            (before..self.program.items.len()).any(|i| matches!(self.program.items.get(i), Item::Move(_)));
        if moved { self.run_call(call) } else { Ok(()) }
    }

    fn run_call(&mut self, cycle::Read { cycle, spindle, .. }: cycle::Read) -> Result<()> {
        let here = self.here.clone();
        if self.modal.plane != Plane::Xy {
            return Err(self.place.not_understood(&here, "cycles are read in G17 only").into());
        }
        let speed = match cycle {
            Cycle::Tap(Tapping { pitch, .. }) => Speed::PerRevolution(pitch),
            _ => self.feed_speed()?,
        };
        if matches!(speed, Speed::Duration(_)) {
            return Err(self.lacks(&here, "a cycle in inverse time (G93)").into());
        }
        if self.state(speed).comp != crate::program::Comp::Off {
            return Err(self.lacks(&here, "a cycle is called while the cutter compensation is on").into());
        }
        self.check_along()?;
        if self.modal.rotary_axes.tcp != Tcp::Off {
            return Err(self.lacks(&here, "a cycle under control of the tool centre point").into());
        }
        self.start()?;
        self.flush(Kind::Tip);
        let state = self.state(speed);
        let state = State { spindle: spindle.map_or(state.spindle, |[within, _]| within), ..state };
        let located = |e: Error| e.0.at(self.place.sources.locate(self.place.span(&here)));
        self.program.push_cycle(cycle, &state, self.origin).map_err(located)?;
        let [_, _, retract] = cycle.heights();
        self.modal.position[2] = Some(retract);
        self.modal.spindle = spindle.map_or(self.modal.spindle, |[_, after]| after);
        Ok(())
    }
}
