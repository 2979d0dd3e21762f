//! A program that begins with what LinuxCNC has kept: tool table and parameters.
//!
//! Parameters 5161 to 5186 are the places of `G28` and `G30`, 5210 to 5219 the shift of `G92`, 5220 the work offset in force, 5221 to
//! 5390 the zeros and rotations of the work offsets, all in machine units whatever `G20` and `G21` say.

use crate::base::Result;
use crate::nc::Kept;
use crate::nc::multi_axis::ROTARY;
use crate::nc::run::{Known, Value};
use crate::program::WorkOffset;

use super::place::Bytes;
use super::reader::Reader;
use super::stored::Stored;
use super::zeros::Spot;

/// Numbers of a work offset's parameters: three linear axes, three rotary ones, three further linear ones, the rotation.
const EACH: u32 = 20;
/// The first of G54.
const FIRST: u32 = 5221;
/// Reasons why a parameter is not known without the files.
const OFFSETS: &str =
    "the machine knows its offsets, the program does not set this one: give its parameter file";
const REFERENCE: &str =
    "the machine knows its reference point, the program does not set it: give its parameter file";
const TABLE: &str = "it is in the tool table of the machine, which is not given";

/// The work offset of a number from 1 on.
pub(super) fn offset_by_number(number: u32) -> Option<WorkOffset> {
    match number {
        1..=6 => WorkOffset::from_tenths(530 + 10 * number),
        7..=9 => WorkOffset::from_tenths(584 + number),
        _ => None,
    }
}

impl Reader<'_> {
    /// Begins with what the control has kept.
    pub(super) fn begins_with(&mut self, kept: &Kept) {
        if let Some(tools) = &kept.tools {
            self.table.keeps(tools);
        }
        let Some(parameters) = &kept.parameters else { return };
        let length = |number: u32| parameters.value(number) * parameters.unit();
        for (number, value) in parameters.all().filter(|(number, _)| *number <= 5000) {
            self.variables.set_numbered(number, Value::Number(value));
        }
        for number in 1..=9 {
            let Some(offset) = offset_by_number(number) else { continue };
            let base = FIRST + EACH * (number - 1);
            for axis in 0..3 {
                let spot = Spot::machine(length(base + axis as u32));
                self.modal.turned.zeros.put(Some(offset), axis, spot);
            }
            self.modal.turned.turn_offset(offset, parameters.value(base + 9));
        }
        for (second, base) in [(0, 5161), (1, 5181)] {
            let turned = [3, 4, 5].map(|axis| parameters.value(base + axis));
            self.stored_places[second] = Some(Stored::at([0, 1, 2].map(|axis| length(base + axis)), turned));
        }
        self.stored_shift = glam::DVec3::from_array([0, 1, 2].map(|axis| length(5211 + axis)));
        if parameters.value(5210) != 0.0 {
            self.modal.turned.shift = self.stored_shift;
        }
        self.kept = Some(parameters.clone());
        self.modal.offset = offset_by_number(parameters.value(5220).round().max(0.0) as u32);
        self.set_frame();
    }

    /// Refuses to turn an axis whose zero the control has kept elsewhere.
    pub(super) fn zero_kept(&self, axis: usize, bytes: &Bytes) -> Result<()> {
        let Some(kept) = &self.kept else { return Ok(()) };
        let numbers = (0..9).map(|offset| FIRST + EACH * offset).chain([5211]);
        let Some(number) = numbers.map(|base| base + 3 + axis as u32).find(|n| kept.value(*n) != 0.0) else {
            return Ok(());
        };
        let message = format!(
            "the machine has a rotary axis {} whose zero is shifted (#{number}), which is not followed",
            ROTARY[axis]
        );
        let finding = self.lacks(bytes, &message).value(kept.value(number), "deg");
        Err(finding.help("set it to 0 at the machine, and turn the part in the setup").into())
    }

    /// A parameter of offsets and of the tool in the spindle.
    pub(super) fn offset_parameter(&self, index: u32) -> Known {
        let known = |value: Option<f64>, otherwise| match value {
            Some(value) => Known::Value(Value::Number(value)),
            None => Known::Unknown(otherwise),
        };
        let unit = self.kept.as_ref().map_or(1.0, |kept| kept.unit());
        let as_kept = || self.kept.as_ref().map(|kept| kept.value(index));
        // The unit of the machine tells what a length is there.
        let length = |value: Option<f64>| value.filter(|_| self.kept.is_some()).map(|value| value / unit);
        match index {
            5161..=5163 | 5181..=5183 => {
                let place = self.stored_places[usize::from(index >= 5181)];
                known(length(place.and_then(|p| p.in_machine()[(index % 20 - 1) as usize])), REFERENCE)
            }
            5164..=5169 | 5184..=5189 => known(as_kept(), REFERENCE),
            5210 => known(
                as_kept().map(|_| f64::from(u8::from(self.shift_said.unwrap_or(as_kept() != Some(0.0))))),
                OFFSETS,
            ),
            5211..=5213 => known(length(Some(self.stored_shift[(index - 5211) as usize])), OFFSETS),
            5214..=5219 => known(as_kept(), OFFSETS),
            FIRST..=5390 => {
                let Some(offset) = offset_by_number((index - FIRST) / EACH + 1) else {
                    return Known::Missing;
                };
                match (index - FIRST) % EACH {
                    axis @ 0..=2 => {
                        let zeros = &self.modal.turned.zeros;
                        let first = zeros.in_machine(Some(offset), axis as usize);
                        known(length(first.map(|first| first + zeros.shift(offset)[axis as usize])), OFFSETS)
                    }
                    9 => known(as_kept().map(|_| self.modal.turned.of(offset)), OFFSETS),
                    _ => known(as_kept(), OFFSETS),
                }
            }
            5401..=5403 => {
                let tool = self.modal.tool.id.map_or(0, |id| id.0);
                let offset = self.table.offset(tool).and_then(|offset| offset[(index - 5401) as usize]);
                known(length(if tool == 0 { Some(0.0) } else { offset }), TABLE)
            }
            _ => Known::Unknown(TABLE),
        }
    }
}
