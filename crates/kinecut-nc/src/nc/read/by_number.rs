//! Lengths and radii given as numbers in a block, without the tool table: `G43.1`, `G43.2`, `G41.1`, `G42.1` (LinuxCNC).
//!
//! Each becomes a register of the program's own. `G43.1` gives the offsets of the tool that it names, the others stay; `G43.2` adds those
//! of a tool to what is in force. An offset across the axis of the tool moves the place of its tip on the machine: the tip is
//! followed where the program means it, and that is said.

use crate::base::Result;
use crate::nc::dialect::{AXES, TurnWord};
use crate::program::{ControlData, OWN_REGISTERS, OwnLength, Speed};

use super::block::Word;
use super::place::Bytes;
use super::reader::{Reader, take};

/// Most lengths that are added to one another.
const MOST_ADDED: usize = 20;

impl<'s> Reader<'s> {
    /// Executes `G43.1 X Y Z` and `G43.2 H`.
    pub(super) fn length_by_number(
        &mut self,
        words: &mut [Word<'s>],
        add: bool,
        bytes: &Bytes,
    ) -> Result<()> {
        let before = self.modal.tool.length.filter(|register| *register != 0);
        let replaced = !add && AXES.iter().all(|axis| words.iter().any(|word| !word.used && word.is(axis)));
        if self.modal.length_stale && !replaced {
            let message =
                "the tool table has another length than the one in force, to which this one is added";
            return Err(self.lacks(bytes, message).help("call the length again first (G43 H)").into());
        }
        self.modal.length_stale = false;
        let own = before.and_then(|register| self.own_length_of(register)).copied();
        if add {
            let Some(word) = take(words, "H") else {
                return Err(self.lacks(bytes, "G43.2 without the tool H whose length it adds").into());
            };
            let register = self.spindle_for_zero(self.count(&word, "a tool number")?);
            self.in_table(register, &word.bytes)?;
            if register == 0 {
                return Ok(());
            }
            if self.table.called(register).is_some() {
                let (here, more) = (self.modal.tool_offsets, self.offsets_of(Some(register)));
                let sum = [0, 1, 2].map(|axis| Some(here[axis]? + more[axis]?));
                if sum.contains(&None) {
                    let message = format!(
                        "the length of {register} has changed, and is added to one that is not known"
                    );
                    return Err(self.lacks(bytes, &message).help("write G43.1 with their sum").into());
                }
                let length = OwnLength { before: None, set: sum, add: None };
                self.modal.tool.length = Some(self.own_length(length));
                return Ok(());
            }
            if self.added(before) >= MOST_ADDED {
                let finding = self.lacks(bytes, "more lengths are added to one another than kinecut follows");
                let finding = finding.value(self.added(before) as f64 + 1.0, "").bound(MOST_ADDED as f64, "");
                return Err(finding.help("write G43.1 with their sum").into());
            }
            // Numbers and a register are one length.
            let length = match own.filter(|own| own.add.is_none()) {
                Some(own) => OwnLength { add: Some(register), ..own },
                None => OwnLength { before, set: [None; 3], add: Some(register) },
            };
            self.modal.tool.length = Some(self.own_length(length));
            return Ok(());
        }
        let named = self.lengths(words);
        if named == [None; 3] {
            return Err(self.lacks(bytes, "G43.1 without an axis").into());
        }
        let mut length = match own.filter(|own| own.add.is_none()) {
            Some(own) => OwnLength { set: [0, 1, 2].map(|axis| named[axis].or(own.set[axis])), ..own },
            None => OwnLength { before, set: named, add: None },
        };
        if length.set.iter().all(Option::is_some) {
            length.before = None;
        }
        self.modal.tool.length = Some(self.own_length(length));
        Ok(())
    }

    /// The tool that `H` names: on LinuxCNC `H0` is the one in the spindle, or no length where none was called.
    pub(super) fn spindle_for_zero(&self, register: u32) -> u32 {
        match (register, self.modal.tool.id) {
            (0, Some(tool)) if self.dialect.turn == TurnWord::Offset => tool.0,
            _ => register,
        }
    }

    /// Whether the length in force counts from a register.
    pub(super) fn length_counts_from(&self, register: u32) -> bool {
        let mut at = self.modal.tool.length;
        while let Some(number) = at {
            let own = self.own_length_of(number);
            if number == register || own.is_some_and(|own| own.add == Some(register)) {
                return true;
            }
            at = own.and_then(|own| own.before);
        }
        false
    }

    /// Keeps the length in force as numbers, since a register from which it counts changes.
    pub(super) fn keep_length_in_force(&mut self) {
        let set = self.modal.tool_offsets;
        if set.contains(&None) {
            self.modal.length_stale = true;
        } else {
            let kept = Some(self.own_length(OwnLength { before: None, set, add: None }));
            // It is the same length: no item tells it.
            if self.modal.told.length == self.modal.tool.length {
                self.modal.told.length = kept;
            }
            self.modal.tool.length = kept;
        }
    }

    /// The register with which a length is called, where the program has changed what it holds: one of the program's own.
    pub(super) fn called_length(&mut self, register: u32) -> u32 {
        match self.table.called(register) {
            Some(set) => {
                let before = set.contains(&None).then_some(register);
                self.own_length(OwnLength { before, set, add: None })
            }
            None => register,
        }
    }

    /// Count of the lengths that are added in that of a register.
    fn added(&self, mut register: Option<u32>) -> usize {
        let mut count = 0;
        while let Some(own) = register.and_then(|register| self.own_length_of(register)) {
            (register, count) = (own.before, count + usize::from(own.add.is_some()));
        }
        count
    }

    /// The length of a register of the program's own.
    fn own_length_of(&self, register: u32) -> Option<&OwnLength> {
        self.own_lengths.get(register.checked_sub(OWN_REGISTERS)? as usize)
    }

    /// Offsets of a tool whose length is in force: those across its axis are zero where nothing says otherwise.
    pub(super) fn offsets_of(&self, register: Option<u32>) -> [Option<f64>; 3] {
        match register {
            None | Some(0) => [Some(0.0); 3],
            Some(register) => match self.own_length_of(register) {
                // Each counts from one before it, and few are added.
                Some(own) => own.offset(|register| Some(self.offsets_of(Some(register)))),
                None => {
                    let [x, y, z] = self.table.offset(register).unwrap_or([None; 3]);
                    // A FANUC adds a wear that no file tells.
                    let z = z.filter(|_| self.dialect.turn == TurnWord::Offset);
                    [x.or(Some(0.0)), y.or(Some(0.0)), z]
                }
            },
        }
    }

    /// After another length is in force: the axes stay, and the coordinates of the tip change by what the offsets differ.
    pub(super) fn offsets_change(&mut self) {
        let after = self.offsets_of(self.modal.tool.length);
        let before = std::mem::replace(&mut self.modal.tool_offsets, after);
        if after[..2].iter().any(|across| across.is_some_and(|across| across != 0.0)) {
            let message = "a tool is offset across its axis: its tip is followed where the program means it";
            self.doubt(&self.here.clone(), message, "a tool that turns in the spindle has no such offset");
        }
        let same = |axis: usize| before[axis].is_some() && before[axis] == after[axis];
        let turned = self.modal.turned.is_turned() && !(same(0) && same(1));
        for axis in 0..3 {
            if axis == 2 || turned || !same(axis) {
                self.modal.position[axis] = None;
            }
        }
    }

    /// Register of a length that the program makes.
    fn own_length(&mut self, length: OwnLength) -> u32 {
        let bits = |value: Option<f64>| value.map_or(u64::MAX, f64::to_bits);
        let key = (length.before, length.set.map(bits), length.add);
        let next = OWN_REGISTERS + self.own_lengths.len() as u32;
        let register = *self.own_numbers.entry(key).or_insert(next);
        if register == next {
            self.own_lengths.push(length);
            let data = ControlData::OwnLength { register, length };
            // It does nothing yet: an item of the tool that waits stays behind it.
            self.program.push_data(data, &self.state(Speed::Rapid { linear: false }), self.origin);
        }
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
