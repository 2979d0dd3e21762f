//! `G92`: the present position gets new coordinates, over all work offsets.
//!
//! At a place that the program has not set the coordinates are taken to be those of the setup, as `G54` is where nobody has set
//! it: that is said, and what was given so cannot be taken back.
//!
//! The shift is kept in the place of `G52`: LinuxCNC keeps both in the parameters 5211 to 5219. `G92.1` takes it back for good,
//! `G92.2` until `G92.3`. It is in force beyond the end of the program: LinuxCNC and GRBL keep it, which is said.

use glam::DVec3;

use crate::base::Result;
use crate::geom::Rigid;
use crate::nc::dialect::{AXES, Code};
use crate::program::{ControlData, WorkOffset};

use super::block::Word;
use super::place::Bytes;
use super::reader::Reader;

impl<'s> Reader<'s> {
    /// Executes `G92` to `G92.3`.
    pub(super) fn presetting(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let is = |c: Code| matches!(c, Code::PresetShift | Code::ShiftOff { .. } | Code::ShiftAgain);
        let Some((code, bytes)) = self.code(is) else { return Ok(()) };
        // `G92.1` and `G92.2` switch it off.
        self.shift_said = Some(!matches!(code, Code::ShiftOff { .. }));
        match code {
            Code::PresetShift => self.preset(words, &bytes)?,
            Code::ShiftOff { keep } => {
                self.modal.turned.shift = DVec3::ZERO;
                for axis in (0..3).filter(|axis| self.modal.turned.given[*axis]) {
                    self.modal.turned.adrift[axis] = true;
                    self.modal.position[axis] = None;
                }
                if !keep {
                    self.stored_shift = DVec3::ZERO;
                }
            }
            _ => self.modal.turned.shift = self.stored_shift,
        }
        self.modal.sticky.end();
        self.set_frame();
        Ok(())
    }

    fn preset(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        let named = self.lengths(words);
        if named == [None; 3] {
            return Err(self.lacks(bytes, "G92 without an axis").into());
        }
        if self.unknown_axes(named) {
            self.gets_coordinates(None, named, bytes)?;
        }
        let mut by = DVec3::ZERO;
        for axis in 0..3 {
            if let (Some(value), Some(here)) = (named[axis], self.modal.position[axis]) {
                by[axis] = here - value;
            }
        }
        // Shifts of these controls count in the coordinates that a work offset turns.
        self.modal.turned.shift += by;
        self.stored_shift = self.modal.turned.shift;
        Ok(())
    }

    /// Whether the place of one of the axes is not known.
    pub(super) fn unknown_axes(&self, named: [Option<f64>; 3]) -> bool {
        (0..3).any(|axis| named[axis].is_some() && self.modal.position[axis].is_none())
    }

    /// Gives coordinates to the axes whose place is not known.
    pub(super) fn gets_coordinates(
        &mut self,
        offset: Option<WorkOffset>,
        named: [Option<f64>; 3],
        bytes: &Bytes,
    ) -> Result<()> {
        let unknown: Vec<usize> =
            (0..3).filter(|axis| named[*axis].is_some() && self.modal.position[*axis].is_none()).collect();
        let moved = self.modal.turned.motion != Rigid::IDENTITY;
        if let Some(axis) = unknown.iter().find(|axis| moved || self.modal.turned.adrift[**axis]) {
            let message =
                format!("coordinates are given to a place whose {} the program has not set", AXES[*axis]);
            return Err(self.lacks(bytes, &message).help("move there first").into());
        }
        let mut place = [None; 3];
        for axis in unknown {
            place[axis] = named[axis];
            self.modal.position[axis] = named[axis];
            self.modal.turned.given[axis] = offset.is_none();
        }
        self.data(ControlData::Here { offset, place });
        self.assume(bytes, "the program gives coordinates to a place that it has not set: the setup is taken to have that zero");
        Ok(())
    }
}
