//! `M70` to `M73` of LinuxCNC: the modal state is saved, and taken again.
//!
//! Saved are units, plane, distances, feed and its mode, work offset, whether a tool length is on (not which: it is taken again as that
//! of the tool in the spindle), height of the return, path mode, spindle and coolant, not the motion code. `M70` and `M73` save it for the subprogram that says so, `M72` takes it again, `M71` forgets it; behind `M73` the
//! return from the subprogram takes it too.

use crate::base::Result;
use crate::nc::dialect::Code;
use crate::program::Comp;

use super::modal::Modal;
use super::place::Bytes;
use super::reader::Reader;

/// A state that was saved.
#[derive(Clone, Debug)]
pub(super) struct Saved {
    /// Calls in force where it was saved.
    depth: usize,
    /// Whether the return takes it again.
    returns: bool,
    modal: Modal,
}

impl<'s> Reader<'s> {
    /// Executes `M70` to `M73`.
    pub(super) fn saving(&mut self) -> Result<()> {
        let is = |c: Code| matches!(c, Code::Save { .. } | Code::Forget | Code::TakeAgain);
        let Some((code, bytes)) = self.code(is) else { return Ok(()) };
        let depth = self.depth;
        match code {
            Code::Save { returns } => {
                self.saved.retain(|s| s.depth != depth);
                self.saved.push(Saved { depth, returns, modal: self.modal.clone() });
                Ok(())
            }
            Code::Forget => {
                self.saved.retain(|s| s.depth != depth);
                Ok(())
            }
            _ => match self.saved.iter().position(|s| s.depth == depth) {
                Some(index) => {
                    let modal = self.saved[index].modal.clone();
                    self.takes(modal, &bytes)
                }
                None => {
                    let finding = self.lacks(&bytes, "M72 without a state that was saved");
                    Err(finding.help("program M70 or M73 before it").into())
                }
            },
        }
    }

    /// The return from a subprogram.
    pub(super) fn returned(&mut self, depth: usize, bytes: &Bytes) -> Result<()> {
        let Some(index) = self.saved.iter().position(|s| s.depth == depth) else { return Ok(()) };
        let saved = self.saved.swap_remove(index);
        if saved.returns { self.takes(saved.modal, bytes) } else { Ok(()) }
    }

    /// Takes a saved state again.
    fn takes(&mut self, saved: Modal, bytes: &Bytes) -> Result<()> {
        if self.modal.comp != saved.comp || self.modal.comp != Comp::Off {
            return Err(self
                .lacks(bytes, "a saved state is taken again while the compensation is on")
                .into());
        }
        let modal = &mut self.modal;
        modal.plane = saved.plane;
        (modal.length_unit, modal.feed_unit) = (saved.length_unit, saved.feed_unit);
        modal.diameters = saved.diameters;
        (modal.absolute, modal.centre_absolute) = (saved.absolute, saved.centre_absolute);
        (modal.feed_mode, modal.feed) = (saved.feed_mode, saved.feed);
        (modal.speed, modal.spindle, modal.coolant) = (saved.speed, saved.spindle, saved.coolant);
        (modal.blend, modal.rounding) = (saved.blend, saved.rounding);
        (modal.return_to_start, modal.return_said) = (saved.return_to_start, saved.return_said);
        // Only whether a length is on is saved (`interp_write.cc`), which counts where an offset is not zero.
        let on = |modal: &Modal| {
            modal.tool.length.is_some_and(|length| length != 0) && modal.tool_offsets != [Some(0.0); 3]
        };
        if on(modal) != on(&saved) {
            let called = on(&saved).then_some(modal.tool.id).flatten().map(|tool| tool.0);
            modal.length_hidden = false;
            modal.length_stale = false;
            self.modal.tool.length = called.map(|register| self.called_length(register));
            self.tool_origin = self.origin;
            self.offsets_change();
        }
        if let Some(offset) = saved.offset.filter(|o| self.modal.offset != Some(*o)) {
            self.work_offset(offset);
        }
        Ok(())
    }
}
