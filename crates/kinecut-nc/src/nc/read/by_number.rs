//! Lengths and radii given as numbers in a block, without the tool table: `G43.1`, `G43.2`, `G41.1`, `G42.1` (LinuxCNC).
//!
//! Each number becomes a register of the program's own. Before the program has called a tool, a length moves the place of Z on the
//! machine and belongs to no tool.

use crate::base::Result;
use crate::nc::dialect::AXES;
use crate::program::{ControlData, OWN_REGISTERS};

use super::block::Word;
use super::place::Bytes;
use super::reader::{Reader, take};

impl<'s> Reader<'s> {
    /// Executes `G43.1 Z` and `G43.2 H`.
    pub(super) fn length_by_number(
        &mut self,
        words: &mut [Word<'s>],
        add: bool,
        bytes: &Bytes,
    ) -> Result<()> {
        let before = match self.modal.tool.length {
            Some(register) => self.length_of(register),
            None => Some(self.lift),
        };
        let length = if add {
            let Some(word) = take(words, "H") else {
                return Err(self.lacks(bytes, "G43.2 without the tool H whose length it adds").into());
            };
            let register = self.count(&word, "a tool number")?;
            match (before, self.length_of(register)) {
                (Some(before), Some(length)) => before + length,
                _ => {
                    let finding =
                        self.lacks(bytes, "G43.2 adds lengths that only the tool table of the machine has");
                    return Err(finding
                        .help("set them by G10 L1 first, or write G43.1 with their sum")
                        .into());
                }
            }
        } else {
            let named = self.lengths(words);
            if let Some(axis) = (0..2).find(|axis| named[*axis].is_some_and(|v| v != 0.0)) {
                let why = format!("a tool that is offset along {} is not followed", AXES[axis]);
                return Err(self.place.not_understood(bytes, &why).into());
            }
            if named == [None; 3] {
                return Err(self.lacks(bytes, "G43.1 without an axis").into());
            }
            let Some(length) = named[2] else { return Ok(()) };
            length
        };
        if self.modal.tool.id.is_none() {
            self.lifted(length);
            return Ok(());
        }
        self.modal.tool.length = Some(self.own_length(length));
        Ok(())
    }

    /// A length without a tool.
    pub(super) fn lifted(&mut self, length: f64) {
        if length != self.lift {
            self.lift = length;
            self.modal.position[2] = None;
            self.data(ControlData::Lift { length });
        }
    }

    /// A length in the tool table that the program has set.
    fn length_of(&self, register: u32) -> Option<f64> {
        self.lengths_set.iter().find(|l| l.0 == register).map(|l| l.1)
    }

    /// Register of a length that is given as a number.
    pub(super) fn own_length(&mut self, length: f64) -> u32 {
        let own = |l: &&(u32, f64)| l.0 >= OWN_REGISTERS && l.1 == length;
        if let Some(found) = self.lengths_set.iter().find(own) {
            return found.0;
        }
        let register = OWN_REGISTERS + self.lengths_set.len() as u32;
        self.lengths_set.push((register, length));
        self.data(ControlData::Length { register, length });
        register
    }

    /// Register and side of a compensation whose diameter is a number: a negative one changes the side.
    pub(super) fn own_radius(
        &mut self,
        words: &mut [Word<'s>],
        left: bool,
        bytes: &Bytes,
    ) -> Result<(u32, bool)> {
        let Some(word) = take(words, "D") else {
            return Err(self.lacks(bytes, "a compensation by number (G41.1, G42.1) without D").into());
        };
        let (radius, left) = (0.5 * word.value.abs() * self.modal.length_unit, left != (word.value < 0.0));
        let own = |r: &&(u32, f64)| r.0 >= OWN_REGISTERS && r.1 == radius;
        let register = match self.radii.iter().find(own) {
            Some(found) => found.0,
            None => {
                let register = OWN_REGISTERS + self.radii.len() as u32;
                self.radius_is(register, radius);
                register
            }
        };
        Ok((register, left))
    }
}
