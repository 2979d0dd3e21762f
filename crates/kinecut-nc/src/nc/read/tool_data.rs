//! Lines of the tool table that a program sets: `G10 L1`, `L10`, `L11` (LinuxCNC), `L10`, `L12` (FANUC, Haas).
//!
//! - `L1 P` sets offsets as they are, `L10 P` so that the present place would have the coordinates that are said, `L11 P` likewise in
//!   G59.3 without the shift of `G92`. They count from the next call of the length on.
//! - A length that was called is another one from then on: on LinuxCNC it is followed as one that the program makes.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3};

use crate::base::Result;
use crate::geom::Rigid;
use crate::nc::TableTool;
use crate::nc::dialect::{AXES, TurnWord};
use crate::program::{ControlData, WorkOffset, moved};

use super::block::Word;
use super::place::Bytes;
use super::reader::{Reader, take};

/// A line of the tool table, as far as it is known.
#[derive(Clone, Debug, Default)]
struct Line {
    /// Offsets along X, Y and Z [mm].
    offset: [Option<f64>; 3],
    /// Whether it has offsets of rotary axes, which are not followed.
    turned: bool,
    /// Whether its length was called.
    called: bool,
    /// Whether the program has changed it since.
    changed: bool,
}

/// The tool table: lines by their numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Table {
    /// Lines that the program has called or set.
    used: BTreeMap<u32, Line>,
    /// Those that the control has kept; none where its table is not given.
    kept: Option<BTreeMap<u32, Line>>,
}

impl Table {
    /// Takes what the control has kept: it has no other tools.
    pub(super) fn keeps(&mut self, tools: &[TableTool]) {
        let line =
            |tool: &TableTool| Line { offset: tool.offset.map(Some), turned: tool.turned, ..Line::default() };
        self.kept = Some(tools.iter().map(|tool| (tool.number, line(tool))).collect());
    }

    fn get(&self, register: u32) -> Option<&Line> {
        self.used.get(&register).or_else(|| self.kept.as_ref()?.get(&register))
    }

    fn line(&mut self, register: u32) -> &mut Line {
        let kept = || self.kept.as_ref().and_then(|kept| kept.get(&register)).cloned().unwrap_or_default();
        self.used.entry(register).or_insert_with(kept)
    }

    /// All in it that may change, as numbers.
    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let flags = |line: &Line| f64::from(u8::from(line.called) + 2 * u8::from(line.changed));
        let offsets = |line: &Line| line.offset.map(|offset| offset.unwrap_or(f64::NAN));
        self.used.values().flat_map(move |line| offsets(line).into_iter().chain([flags(line)]))
    }

    /// Offsets along X, Y and Z [mm] of a line that is known in part.
    pub(super) fn offset(&self, register: u32) -> Option<[Option<f64>; 3]> {
        self.get(register).map(|line| line.offset)
    }

    /// Calls a length; its offsets where the program has changed them since the first call.
    pub(super) fn called(&mut self, register: u32) -> Option<[Option<f64>; 3]> {
        let line = self.line(register);
        line.called = true;
        line.changed.then_some(line.offset)
    }
}

impl<'s> Reader<'s> {
    /// `G10 L1`, `L10` and `L11 P X Y Z R`: a line of LinuxCNC's tool table.
    pub(super) fn set_tool(&mut self, words: &mut [Word<'s>], kind: u32, bytes: &Bytes) -> Result<()> {
        let Some(tool) = take(words, "P") else {
            return Err(self.lacks(bytes, &format!("G10 L{kind} without the tool P")).into());
        };
        let number = self.count(&tool, "a tool number")?;
        let radius = take(words, "R").map(|radius| radius.value * self.modal.length_unit);
        self.in_table(number, &tool.bytes)?;
        // Angles and the side of turning tools.
        let turning = ["I", "J", "Q"].map(|word| take(words, word).is_some()).contains(&true);
        let named = self.lengths(words);
        self.no_turned_zero(words)?;
        if named == [None; 3] && radius.is_none() && !turning {
            return Err(self.lacks(bytes, &format!("G10 L{kind} without an offset or radius")).into());
        }
        if let Some(radius) = radius {
            self.radius_is(number, radius);
        }
        if named == [None; 3] {
            return Ok(());
        }
        let offset = match kind {
            1 => named,
            _ => self.offset_from_here(number, named, kind == 11, bytes)?,
        };
        self.offset_is(number, offset, bytes)
    }

    /// Refuses a tool that the control does not have, where its table is given.
    pub(super) fn in_table(&self, tool: u32, bytes: &Bytes) -> Result<()> {
        let line = self.table.get(tool);
        if line.is_some_and(|line| line.turned) {
            let message =
                format!("T{tool} has offsets of rotary axes in the tool table, which are not followed");
            return Err(self.lacks(bytes, &message).help("set them to 0").into());
        }
        if tool == 0 || self.table.kept.is_none() || line.is_some() {
            return Ok(());
        }
        let finding = self.lacks(bytes, &format!("T{tool} is not in the tool table of the machine"));
        Err(finding.help("LinuxCNC stops here: give the table that the machine has").into())
    }

    /// Offsets with which the present place would have coordinates: in the work offset in force, or in G59.3 without `G92`.
    fn offset_from_here(
        &self,
        tool: u32,
        named: [Option<f64>; 3],
        fixture: bool,
        bytes: &Bytes,
    ) -> Result<[Option<f64>; 3]> {
        let turned = &self.modal.turned;
        let system = match (fixture, self.modal.offset) {
            (true, _) => WorkOffset::from_tenths(593).unwrap_or(WorkOffset::G54),
            (false, offset) => offset.unwrap_or(WorkOffset::G54),
        };
        let mut motion = turned.motion_of(self.dialect.turn, system);
        if fixture {
            motion.translation -= motion.rotation * turned.shift;
        }
        let (here, zero) = (self.machine_place(), turned.zeros.first(system));
        // Of the spindle, in the coordinates of the system.
        let within = [0, 1, 2].map(|axis| {
            let tip = here[axis].map_or(f64::NAN, |here| here.minus(zero[axis]));
            tip + self.modal.tool_offsets[axis].unwrap_or(f64::NAN)
        });
        let within = moved(&motion.inverse(), DVec3::from_array(within));
        let own = self.table.offset(tool).unwrap_or([None; 3]);
        let own = own.map(|offset| offset.unwrap_or(0.0));
        let askew = motion.rotation != DMat3::IDENTITY;
        let mut offset = motion.rotation.transpose() * DVec3::from_array(own);
        for axis in 0..3 {
            if let Some(value) = named[axis] {
                offset[axis] = within[axis] - value;
            }
        }
        let offset = moved(&Rigid { rotation: motion.rotation, ..Rigid::IDENTITY }, offset);
        let counts =
            |axis: usize| named[axis].is_some() || askew && axis < 2 && (named[0].or(named[1])).is_some();
        if let Some(axis) = (0..3).find(|axis| counts(*axis) && offset[*axis].is_nan()) {
            let message = format!(
                "G10 L{} sets an offset along {} from a place that is not known",
                if fixture { 11 } else { 10 },
                AXES[axis]
            );
            return Err(self.lacks(bytes, &message).help("move there first, or set it by G10 L1").into());
        }
        Ok([0, 1, 2].map(|axis| Some(offset[axis]).filter(|_| counts(axis))))
    }

    /// `G10 L10 P R` and `G10 L12 P R` of FANUC: registers of lengths and radii.
    pub(super) fn set_register(&mut self, words: &mut [Word<'s>], length: bool, bytes: &Bytes) -> Result<()> {
        let (Some(number), Some(value)) = (take(words, "P"), take(words, "R")) else {
            return Err(self
                .lacks(bytes, "a register of the tool table needs its number P and its value R")
                .into());
        };
        if !self.modal.absolute {
            let finding =
                self.lacks(bytes, "an increment of a register (G91), which the machine alone knows");
            return Err(finding.help("program G90").into());
        }
        let (number, value) = (self.count(&number, "a register")?, value.value * self.modal.length_unit);
        if length {
            return self.offset_is(number, [None, None, Some(value)], bytes);
        }
        self.radius_is(number, value);
        Ok(())
    }

    /// A radius that the program sets [mm].
    pub(super) fn radius_is(&mut self, register: u32, radius: f64) {
        self.radii.retain(|r| r.0 != register);
        self.radii.push((register, radius));
        self.data(ControlData::Radius { register, radius });
    }

    /// Offsets that the program sets [mm].
    fn offset_is(&mut self, register: u32, offset: [Option<f64>; 3], bytes: &Bytes) -> Result<()> {
        let own = self.dialect.turn == TurnWord::Offset;
        let line = self.table.line(register);
        let differs = (0..3).any(|axis| offset[axis].is_some() && offset[axis] != line.offset[axis]);
        if line.called && differs && !own {
            let message =
                format!("the length of {register} changes after it was called, which is not followed");
            let finding = self.lacks(bytes, &message).value_mm(offset[2].unwrap_or(0.0));
            return Err(finding.help("set it once").into());
        }
        line.changed |= line.called && differs;
        let changes = line.called && differs;
        for axis in 0..3 {
            line.offset[axis] = offset[axis].or(line.offset[axis]);
        }
        if changes && self.length_counts_from(register) {
            self.keep_length_in_force();
        }
        let line = self.table.line(register);
        // What the register holds where it is called by its number.
        if let (false, Some(length)) = (line.called, offset[2]) {
            self.lengths_set.retain(|l| l.0 != register);
            self.lengths_set.push((register, length));
        }
        self.data(ControlData::Length { register, offset });
        Ok(())
    }
}
