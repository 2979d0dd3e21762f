//! Data of the control: `G10` and `G92`.

use crate::base::{Finding, Result};
use crate::nc::Control;
use crate::nc::dialect::AXES;
use crate::nc::grid::plain;
use crate::program::{ControlData, OWN_REGISTERS, State, WorkOffset};

use super::{Writer, turn, unsupported};

impl Writer<'_> {
    /// Writes data that the program sets.
    pub(super) fn control_data(&mut self, data: &ControlData, state: &State) -> Result<()> {
        self.uncompensated("data of the control are set")?;
        let control = self.settings.control;
        let [linuxcnc, fanuc, grbl] = [
            control == Control::LinuxCnc,
            matches!(control, Control::Fanuc | Control::Haas),
            matches!(control, Control::Grbl | Control::GrblHal),
        ];
        let block = match *data {
            ControlData::Zero { offset: Some(offset), place } if fanuc && offset.extension().is_some() => {
                let number = offset.extension().unwrap_or_default();
                format!("G10 L20 P{number}{}", self.axis_words(place)?)
            }
            ControlData::Zero { offset, place } if linuxcnc || fanuc || grbl => {
                let number = match offset {
                    None if fanuc => 0,
                    None => return Err(cannot("the offset that is added to all work offsets").into()),
                    Some(offset) => self.offset_number(offset)?,
                };
                format!("G10 L2 P{number}{}", self.axis_words(place)?)
            }
            ControlData::Here { offset: Some(offset), place }
                if (linuxcnc || grbl) && !self.program.is_in(offset, state.frame) =>
            {
                self.turn_off()?;
                format!("G10 L20 P{}{}", self.offset_number(offset)?, self.axis_words(place)?)
            }
            ControlData::Here { offset, place } if linuxcnc || grbl || fanuc && offset.is_none() => {
                self.state(state, true)?;
                let words = self.axis_words(place)?;
                for axis in 0..3 {
                    if let Some(value) = place[axis] {
                        self.place.written[axis] = Some(self.grid.round(value)?);
                        self.place.exact[axis] = value;
                    }
                }
                match offset {
                    None => format!("G92{words}"),
                    Some(offset) => format!("G10 L20 P{}{words}", self.offset_number(offset)?),
                }
            }
            ControlData::Probe { kind, place } if linuxcnc || grbl => {
                self.state(state, true)?;
                let mut block = String::new();
                if let (mode, Some(feed)) = self.feed_words(state.speed)? {
                    block = mode.map_or_else(String::new, |mode| format!("{mode} "));
                    block.push_str(&format!("F{feed} "));
                }
                block.push_str(&format!("G38.{kind}{}", self.axis_words(place)?));
                self.modal.motion = None;
                for axis in 0..3 {
                    if place[axis].is_some() {
                        self.place.written[axis] = None;
                        self.place.exact[axis] = f64::NAN;
                    }
                }
                block
            }
            ControlData::OwnLength { .. } if self.klartext() => {
                return Err(cannot("a length made of numbers (G43.1, G43.2)").into());
            }
            ControlData::OwnLength { length, .. } => {
                self.own_lengths.push(length);
                return Ok(());
            }
            ControlData::Radius { register, radius } if register >= OWN_REGISTERS => {
                self.own_radii.push((register, radius));
                return Ok(());
            }
            ControlData::LengthCall { register } if self.dialect.has_lengths && !self.klartext() => {
                return self.length_word(register);
            }
            ControlData::Orient { degrees, way, seconds } if linuxcnc => {
                let mut block = "M19".to_owned();
                for (word, value) in [("R", degrees), ("P", f64::from(way)), ("Q", seconds)] {
                    if value != 0.0 {
                        block.push_str(&format!(" {word}{}", plain(value)));
                    }
                }
                block
            }
            ControlData::Orient { degrees: 0.0, way: 0, .. } if fanuc => "M19".to_owned(),
            ControlData::Length { register, offset } if linuxcnc => {
                format!("G10 L1 P{register}{}", self.length_words(offset))
            }
            ControlData::Radius { register, radius } if linuxcnc => {
                format!("G10 L1 P{register} R{}", self.grid.length(radius))
            }
            ControlData::Length { register, offset: [None, None, Some(length)] } if fanuc => {
                format!("G10 L10 P{register} R{}", self.word_number(length))
            }
            ControlData::Radius { register, radius } if fanuc => {
                format!("G10 L12 P{register} R{}", self.word_number(radius))
            }
            ControlData::Zero { .. } => return Err(cannot("the zero of a work offset").into()),
            ControlData::Here { .. } => return Err(cannot("the coordinates of the present place").into()),
            ControlData::Probe { .. } => return Err(cannot("a move of a probe").into()),
            ControlData::Orient { .. } => return Err(cannot("the place where the spindle stands").into()),
            ControlData::LengthCall { .. } => {
                return Err(cannot("a length without a tool").into());
            }
            ControlData::Length { .. } | ControlData::Radius { .. } => {
                return Err(cannot("a line of the tool table").into());
            }
        };
        self.page.block(block);
        Ok(())
    }

    /// A radius that the program gives as a number [mm], for a control that takes it so.
    pub(super) fn own_radius(&self, register: u32) -> Result<Option<f64>> {
        if register < OWN_REGISTERS {
            return Ok(None);
        }
        let found = self.own_radii.iter().rev().find(|(own, _)| *own == register);
        let value = found.filter(|_| self.settings.control == Control::LinuxCnc).map(|(_, value)| *value);
        value.map(Some).ok_or_else(|| {
            unsupported("the program gives a radius as a number (G41.1), which this control does not take")
                .help("give it by a register")
                .into()
        })
    }

    /// The blocks that put a length in force behind another one, and whether they count from that.
    pub(super) fn length_blocks(
        &self,
        length: Option<u32>,
        behind: Option<u32>,
    ) -> Result<(Vec<String>, bool)> {
        let Some(register) = length else { return Ok((vec![self.dialect.length_off.to_owned()], false)) };
        let Some(index) = register.checked_sub(OWN_REGISTERS) else {
            return Ok((vec![format!("{}{register}", self.dialect.length_on)], false));
        };
        let found =
            self.own_lengths.get(index as usize).filter(|_| self.settings.control == Control::LinuxCnc);
        let Some(own) = found else {
            return Err(unsupported(
                "the program gives a length as a number or a sum (G43.1, G43.2), which this control does not take",
            )
            .help("give it by a register")
            .into());
        };
        let stays = own.set.iter().any(Option::is_none);
        let (mut blocks, counts) = match own.before {
            _ if !stays => (Vec::new(), false),
            before if before == behind => (Vec::new(), true),
            // Each counts from one before it.
            before => self.length_blocks(before, behind)?,
        };
        if own.set != [None; 3] {
            blocks.push(format!("G43.1{}", self.length_words(own.set)));
        }
        if let Some(register) = own.add {
            blocks.push(format!("G43.2 H{register}"));
        }
        Ok((blocks, counts))
    }

    /// P of a work offset.
    fn offset_number(&self, offset: WorkOffset) -> Result<u16> {
        let has = (self.dialect.has_offset)(offset) && offset.tenths() <= 593;
        has.then(|| turn::number(offset)).ok_or_else(|| cannot(&format!("the zero of {offset}")).into())
    }

    fn axis_words(&self, place: [Option<f64>; 3]) -> Result<String> {
        let mut words = String::new();
        for (axis, value) in AXES.iter().zip(place) {
            if let Some(value) = value {
                let count = self.grid.round(value)?;
                words.push_str(&format!(" {axis}{}", self.word_number(self.grid.value(count))));
            }
        }
        Ok(words)
    }

    fn word_number(&self, value: f64) -> String {
        let mut number = self.grid.length(value);
        if self.dialect.point && !number.contains('.') {
            number.push('.');
        }
        number
    }

    /// Words of the axes that are said, with all digits.
    fn length_words(&self, values: [Option<f64>; 3]) -> String {
        let words = AXES.iter().zip(values);
        words.filter_map(|(axis, value)| Some(format!(" {axis}{}", self.grid.length(value?)))).collect()
    }
}

fn cannot(what: &str) -> Finding {
    unsupported(format!("the program sets {what}, which is not written for this control"))
        .help("set it up at the control, and leave it out of the program")
}
