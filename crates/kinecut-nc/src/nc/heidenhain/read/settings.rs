//! M functions and tool calls.

use std::f64::consts::TAU;

use crate::base::Result;
use crate::nc::read::place::Bytes;
use crate::program::{Coolant, Spindle, StopKind, Tcp, ToolNumber};

use super::statement::Word;
use super::{RAPID, Reader};

/// M functions that act with or after the movement of their block.
#[derive(Debug, Default)]
pub(super) struct Functions {
    /// `M91`.
    pub(super) machine: Option<Bytes>,
    /// `M140 MB MAX`.
    pub(super) retract: Option<Bytes>,
    /// `M99`.
    pub(super) call: bool,
    /// `M129`.
    tip_off: bool,
    spindle_off: bool,
    coolant_off: bool,
    stop: Option<StopKind>,
}

/// Functions that move no axis and change no coordinate, with what they do.
const HARMLESS: &[(u32, &str)] = &[
    (90, "constant path speed"),
    (107, "no alarm for oversize tools"),
    (108, "alarm for oversize tools"),
    (116, "feed of rotary axes in mm/min"),
    (117, "feed of rotary axes in deg/min"),
    (141, "touch probe monitoring off"),
    (148, "lift-off at an NC stop"),
    (149, "no lift-off at an NC stop"),
];

impl<'s> Reader<'s> {
    /// A block of M functions alone.
    pub(super) fn functions(&mut self, words: &mut [Word<'s>], stop: Option<StopKind>) -> Result<()> {
        let mut functions = self.before(words)?;
        if let Some(bytes) = &functions.machine {
            return Err(self.lacks(bytes, "machine coordinates without an axis").into());
        }
        functions.stop = functions.stop.or(stop);
        if functions.call {
            self.drill()?;
        }
        self.finish_functions(&functions)
    }

    /// Reads the M words of a block and executes those that act at its start.
    pub(super) fn before(&mut self, words: &mut [Word<'s>]) -> Result<Functions> {
        let mut functions = Functions::default();
        let mut coolant = None;
        let mut spindle = None;
        for at in 0..words.len() {
            if words[at].used || !words[at].is("M") {
                continue;
            }
            words[at].used = true;
            let bytes = words[at].bytes.clone();
            let Some(value) = words[at].value else {
                return Err(self.place.malformed(&bytes, "a number is missing").into());
            };
            let number = self.count(value, &bytes, "an M function")?;
            let stop = match number {
                0 => Some(StopKind::Program),
                1 => Some(StopKind::Optional),
                2 | 30 => Some(StopKind::End),
                _ => None,
            };
            let turning = match number {
                3 | 13 => Some(true),
                4 | 14 => Some(false),
                _ => None,
            };
            let repeated = stop.is_some() && functions.stop.is_some()
                || (turning.is_some() || number == 5) && (spindle.is_some() || functions.spindle_off);
            if repeated {
                return Err(self.twice(&bytes).into());
            }
            functions.stop = functions.stop.or(stop);
            if let Some(clockwise) = turning {
                spindle = Some((clockwise, bytes.clone()));
            }
            match number {
                0..=4 | 30 => {}
                5 => functions.spindle_off = true,
                7 => coolant = Some(Coolant::Mist),
                8 | 13 | 14 => coolant = Some(Coolant::Flood),
                9 => functions.coolant_off = true,
                91 => functions.machine = Some(bytes),
                99 => functions.call = true,
                126 | 127 => self.modal.shorter = number == 126,
                128 => {
                    // The feed after it is that of the compensating moves.
                    if let Some(feed) =
                        words.get_mut(at + 1).filter(|w| w.is("FMAX") || w.is("F") && w.value.is_some())
                    {
                        feed.used = true;
                    }
                    self.control_tip(Tcp::Axes)?;
                }
                129 => functions.tip_off = true,
                136 | 137 => {
                    self.modal.per_revolution = number == 136;
                    self.modal.feed = None;
                }
                140 => {
                    let up = words.get(at + 1).is_some_and(|w| w.is("MB") && w.value.is_none())
                        && words.get(at + 2).is_some_and(|w| w.is("MAX"));
                    if !up {
                        let why = "a retraction is read as M140 MB MAX only";
                        return Err(self.place.not_understood(&bytes, why).into());
                    }
                    words[at + 1].used = true;
                    words[at + 2].used = true;
                    self.warn(
                        &bytes,
                        "M140 MB MAX lifts the tool to the end of its travel: this move is not followed, Z is \
                         unknown until it is said",
                    );
                    functions.retract = Some(bytes);
                }
                _ => match HARMLESS.iter().find(|h| h.0 == number) {
                    Some((_, what)) => {
                        let text = format!(
                            "`{}` ({what}) is not followed: it moves no axis",
                            self.place.shown(&bytes)
                        );
                        self.note(&text);
                    }
                    None => {
                        let why = "kinecut does not know what the control does with it";
                        return Err(self.place.not_understood(&bytes, why).into());
                    }
                },
            }
        }
        if let Some((clockwise, bytes)) = spindle {
            self.spindle_on(clockwise, &bytes);
        }
        self.modal.coolant = coolant.unwrap_or(self.modal.coolant);
        if functions.retract.is_some() {
            self.modal.position[2] = None;
            if self.modal.tilt.is_some() || !self.upright() {
                self.unplace();
            }
        }
        Ok(functions)
    }

    /// Switches the spindle on at the speed that the program has said.
    fn spindle_on(&mut self, clockwise: bool, bytes: &Bytes) {
        if self.modal.rate.is_none() {
            self.warn(bytes, "the spindle is switched on without a speed (S)");
        }
        let rate = self.modal.rate.unwrap_or(0.0);
        self.modal.spindle =
            if clockwise { Spindle::Clockwise(rate) } else { Spindle::CounterClockwise(rate) };
    }

    /// Executes the M functions that act at the end of a block.
    pub(super) fn finish_functions(&mut self, functions: &Functions) -> Result<()> {
        if functions.tip_off {
            self.control_tip(Tcp::Off)?;
        }
        if functions.spindle_off {
            self.modal.spindle = Spindle::Off;
        }
        if functions.coolant_off {
            self.modal.coolant = Coolant::Off;
        }
        if let Some(kind) = functions.stop {
            self.stop(kind);
        }
        Ok(())
    }

    /// `TOOL CALL` and `TOOL DEF`.
    pub(super) fn tool(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let Some(kind) = words.get_mut(1) else {
            return Err(self.place.malformed(&self.here, "a tool is called or defined").into());
        };
        kind.used = true;
        let number = kind.value;
        let bytes = kind.bytes.clone();
        if kind.is("DEF") {
            if words.iter().any(|w| w.is("L") || w.is("R")) {
                self.note("TOOL DEF is not followed: the measures of the tools are the job's");
            }
            words.iter_mut().for_each(|w| w.used = true);
            return Ok(());
        }
        if !kind.is("CALL") {
            return Err(self.place.not_understood(&bytes, "a tool is called or defined").into());
        }
        if let Some(name) = words.iter().find(|w| w.text.is_some()) {
            let finding = self.place.not_understood(&name.bytes, "tools are called by their number");
            return Err(finding.help("program TOOL CALL with a number").into());
        }
        if let Some(axis) = words.iter_mut().find(|w| w.is("Z") && w.value.is_none()) {
            axis.used = true;
        }
        for name in ["DL", "DR", "DR2"] {
            if let Some((value, bytes)) = self.take(words, name)?
                && value != 0.0
            {
                let why = "allowances of a tool call are not read";
                let finding = self.place.not_understood(&bytes, why);
                return Err(finding.help("add it to the tool's length or radius").into());
            }
        }
        let speed = self.take(words, "S")?;
        let feed = self.take(words, "F")?;
        if number.is_some() && self.modal.tcp != Tcp::Off {
            self.warn(&bytes, "a tool is called while the tool centre point is controlled (M128)");
        }
        if let Some(number) = number {
            let (number, register) = self.tool_line(number, &bytes)?;
            let (same, line) = (self.modal.tool == Some(number), self.modal.register == register);
            if !same {
                self.modal.tool = Some(number);
                self.modal.spindle = Spindle::Off;
                self.modal.position = [None; 3];
                self.modal.direction = None;
            }
            if !same || !line {
                self.uncompensated("a tool is called")?;
                self.modal.register = register;
                self.modal.position[2] = None;
                let state = self.state(RAPID);
                let register = Some(register);
                self.program.push_tool(ToolNumber(number), register, register, &state, self.origin);
            }
        }
        if let Some((speed, bytes)) = speed {
            if speed < 0.0 {
                return Err(self.place.malformed(&bytes, "a spindle speed is not negative").into());
            }
            let rate = speed * TAU / 60.0;
            self.modal.rate = Some(rate);
            if let Spindle::Clockwise(r) | Spindle::CounterClockwise(r) = &mut self.modal.spindle {
                *r = rate;
            }
        }
        if let Some((feed, bytes)) = feed {
            if feed < 0.0 {
                return Err(self.place.malformed(&bytes, "a feed is not negative").into());
            }
            self.modal.tool_feed = Some(self.feed(feed));
            self.modal.feed = self.modal.tool_feed;
        }
        Ok(())
    }

    /// A tool and its line of the table: `5` is 5 and 1, `5.2` is 5 and 2.
    fn tool_line(&self, value: f64, bytes: &Bytes) -> Result<(u32, u32)> {
        let tenths = (value * 10.0).round();
        // Within rounding of the decimal fraction.
        if !(0.0..=f64::from(u32::MAX)).contains(&tenths) || (tenths - value * 10.0).abs() > 1e-6 {
            return Err(self
                .place
                .malformed(bytes, "a tool number is whole, or has one digit as its index")
                .into());
        }
        let (tool, index) = (tenths as u32 / 10, tenths as u32 % 10);
        match index {
            0 => Ok((tool, 1)),
            1 => Err(self.place.not_understood(bytes, "the lines .2 to .9 of a tool are read").into()),
            _ => Ok((tool, index)),
        }
    }
}
