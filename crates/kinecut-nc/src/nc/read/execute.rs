//! The codes of a block, executed in the order of a control: feed mode, feed, speed, tool, spindle, coolant,
//! dwell, plane, units, length offset, work offset, path mode, distances, shift and rotation, motion, stop.

use std::f64::consts::TAU;

use crate::base::{Code as FindingCode, Finding, Result};
use crate::nc::dialect::{AXES, Code, FlowWords};
use crate::program::{Coolant, SetupId, Speed, Spindle, StopKind, Tcp, ToolNumber, WorkOffset};

use super::block::Word;
use super::modal::FeedMode;
use super::place::Bytes;
use super::reader::{Kind, Reader, take};

/// Millimetres in an inch.
const INCH: f64 = 25.4;

impl<'s> Reader<'s> {
    pub(super) fn execute(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        self.one_use_of_axes()?;
        self.set_mode(words)?;
        self.modal.sticky.rigid |= self.code(|c| c == Code::Rigid).is_some();
        let before = self.before()?;
        self.check_rotation()?;
        self.check_plane()?;
        let dwell = self.code(|c| c == Code::Dwell);
        if !self.dialect.feed_before_units {
            self.units();
        }
        self.feed_mode();
        // In a dwell block of some controls F and S are the dwell's.
        if dwell.is_none() || !self.dialect.feed_is_dwell() {
            self.feed(words)?;
            self.surface_speed(words)?;
            self.speed(words)?;
        }
        let mut chosen = false;
        if let Some(tool) = take(words, "T") {
            let number = self.count(&tool, "a tool number")?;
            self.in_table(number, &tool.bytes)?;
            self.modal.chosen = Some(number);
            chosen = true;
        }
        if let Some((_, bytes)) = self.code(|c| c == Code::ToolChange) {
            self.tool_change(&bytes)?;
        } else if let Some((_, bytes)) = self.code(|c| c == Code::ToolInSpindle) {
            self.tool_in_spindle(words, &bytes)?;
        } else if chosen && self.dialect.hand_change() {
            self.hand_change()?;
        }
        self.spindle_and_coolant();
        self.orientation(words)?;
        if let Some((_, bytes)) = &dwell {
            self.dwell(bytes, words)?;
        }
        if let Some((Code::Plane(plane), _)) = self.code(|c| matches!(c, Code::Plane(_))) {
            self.modal.plane = plane;
        }
        if self.dialect.feed_before_units {
            self.units();
        }
        let machine = self.code(|c| c == Code::MachineFrame).map(|c| c.1);
        self.length(words, machine.is_some())?;
        self.transformation()?;
        self.compensation(words, &before)?;
        if let Some((Code::Work(offset), _)) = self.code(|c| matches!(c, Code::Work(_))) {
            self.work_offset(offset);
        }
        self.path_mode(words)?;
        self.distances();
        self.devices(words);
        self.saving()?;
        self.storing();
        self.tilting(words)?;
        self.scaling(words)?;
        self.turning(words)?;
        self.presetting(words)?;
        self.probing(words)?;
        self.motion_and_corner(words, machine)?;
        self.check_compensation(&before)?;
        self.jumping(words)?;
        if let Some((Code::Stop(kind), bytes)) = self.code(|c| matches!(c, Code::Stop(_))) {
            if kind == StopKind::Pallet {
                let message = "the pallets are exchanged (M60): from here on another part may lie there";
                self.doubt(&bytes, message, "write the program of each part by itself");
            }
            if kind == StopKind::End {
                self.modal.spindle = Spindle::Off;
                self.modal.coolant = Coolant::Off;
                self.ended = true;
            }
            self.push_stop(kind);
        }
        Ok(())
    }

    pub(super) fn push_stop(&mut self, kind: StopKind) {
        self.flush(Kind::Other);
        self.program.push_stop(kind, &self.state(Speed::Rapid { linear: false }), self.origin);
    }

    /// Whether a block has nothing but a feed, ends of axes X, Y, Z and one of G0 and G1: nearly all of a long program.
    pub(super) fn only_moves(&self, words: &[Word<'s>]) -> bool {
        self.codes.iter().all(|(code, _)| matches!(code, Code::Rapid | Code::Feed))
            && self.modal.feed_mode != FeedMode::InverseTime
            && words.iter().all(|w| w.used || w.is("F") || AXES.iter().any(|axis| w.is(axis)))
    }

    /// Executes such a block: what [`Reader::execute`] does of it.
    pub(super) fn go_on(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let before = self.before()?;
        self.feed(words)?;
        self.only_axes = true;
        self.motion_and_corner(words, None)?;
        self.check_compensation(&before)
    }

    fn units(&mut self) {
        if let Some((Code::Units { inch, feeds }, bytes)) = self.code(|c| matches!(c, Code::Units { .. })) {
            let unit = if inch { INCH } else { 1.0 };
            self.modal.unit_said_at = Some(bytes);
            self.modal.length_unit = unit;
            self.modal.feed_unit = if feeds { unit } else { 1.0 };
            self.modal.units_said = true;
        }
    }

    fn feed_mode(&mut self) {
        let wanted = self.codes.iter().find_map(|(c, _)| match c {
            Code::FeedPerMinute => Some(FeedMode::PerMinute),
            Code::FeedPerRevolution => Some(FeedMode::PerRevolution),
            Code::InverseTime => Some(FeedMode::InverseTime),
            _ => None,
        });
        if let Some(mode) = wanted {
            if mode != self.modal.feed_mode || self.dialect.mode_forgets_feed {
                self.modal.feed = None;
            }
            self.modal.feed_mode = mode;
        }
    }

    fn feed(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        if self.modal.feed_mode == FeedMode::InverseTime {
            self.modal.feed = None;
        }
        if let Some(feed) = take(words, "F") {
            if feed.value < 0.0 {
                return Err(self.place.malformed(&feed.bytes, "a feed is not negative").into());
            }
            self.set_feed(feed.value);
        }
        Ok(())
    }

    pub(super) fn set_feed(&mut self, value: f64) {
        self.modal.feed = Some(match self.modal.feed_mode {
            FeedMode::PerMinute => value * self.modal.feed_unit / 60.0,
            FeedMode::PerRevolution => value * self.modal.feed_unit,
            FeedMode::InverseTime => value,
        });
    }

    /// `G96`: the speed of the spindle depends on the radius, which is not followed.
    fn surface_speed(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let Some((_, bytes)) = self.code(|c| c == Code::SurfaceSpeed) else { return Ok(()) };
        let Some(speed) = take(words, "S") else {
            return Err(self.lacks(&bytes, "a surface speed (G96) without S").help("program S").into());
        };
        take(words, "D");
        if speed.value < 0.0 {
            return Err(self.place.malformed(&speed.bytes, "a surface speed is not negative").into());
        }
        self.modal.speed = None;
        let message =
            "the spindle turns by a surface speed (G96), which is not followed: its speed is not known";
        self.warn(&bytes, message);
        Ok(())
    }

    fn speed(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let Some(speed) = take(words, "S") else { return Ok(()) };
        if speed.value < 0.0 {
            return Err(self.place.malformed(&speed.bytes, "a spindle speed is not negative").into());
        }
        let rate = speed.value * TAU / 60.0;
        self.modal.speed = Some(rate);
        if let Spindle::Clockwise(r) | Spindle::CounterClockwise(r) = &mut self.modal.spindle {
            *r = rate;
        }
        Ok(())
    }

    fn spindle_and_coolant(&mut self) {
        let rate = self.modal.speed;
        let codes = std::mem::take(&mut self.codes);
        for (code, bytes) in codes.iter().map(|(code, bytes)| (*code, bytes)) {
            match code {
                Code::SpindleClockwise | Code::SpindleCounterClockwise => {
                    if rate.is_none() {
                        self.warn(bytes, "the spindle is switched on without a speed (S)");
                    }
                    let rate = rate.unwrap_or(0.0);
                    let clockwise = code == Code::SpindleClockwise;
                    self.modal.spindle =
                        if clockwise { Spindle::Clockwise(rate) } else { Spindle::CounterClockwise(rate) };
                }
                Code::SpindleOff => self.modal.spindle = Spindle::Off,
                Code::Mist | Code::Flood => {
                    let on = if code == Code::Mist { Coolant::Mist } else { Coolant::Flood };
                    let before = self.modal.coolant;
                    let joins = self.dialect.both_coolants && before != Coolant::Off && before != on;
                    self.modal.coolant = if joins { Coolant::Both } else { on };
                }
                Code::CoolantOff => self.modal.coolant = Coolant::Off,
                Code::Harmless(what) => {
                    let message =
                        format!("`{}` ({what}) is not followed: it moves no axis", self.place.shown(bytes));
                    if self.findings.iter().all(|f| f.message != message) {
                        let place = self.place.sources.locate(self.place.span(bytes));
                        self.findings.push(Finding::note(FindingCode::NC_WORD, message).at(place));
                    }
                }
                _ => {}
            }
        }
        self.codes = codes;
    }

    /// Codes that switch or read devices, with their words: the program goes on as it would without them.
    fn devices(&mut self, words: &mut [Word<'s>]) {
        for (code, bytes) in self.codes.clone() {
            let Code::Tolerated(what) = code else { continue };
            if self.dialect.flow == FlowWords::OWords {
                // Arguments of the program that it calls.
                let _ = (take(words, "P"), take(words, "Q"));
            }
            let shown = self.place.shown(&bytes).to_owned();
            let message = format!(
                "`{shown}` ({what}) is passed over, neither followed nor written: it moves no axis unless the builder of the machine has put a macro behind it"
            );
            self.warn(&bytes, &message);
        }
        let Some((Code::Device(what), bytes)) = self.code(|c| matches!(c, Code::Device(_))) else { return };
        for name in ["P", "E", "L", "Q"] {
            take(words, name);
        }
        let message = format!("`{}` ({what}) is not followed: it moves no axis", self.place.shown(&bytes));
        self.note(&message);
    }

    fn tool_change(&mut self, bytes: &Bytes) -> Result<()> {
        let Some(number) = self.modal.chosen else {
            return Err(self
                .lacks(bytes, "a tool change without a tool number")
                .help("program T before M6")
                .into());
        };
        self.flush(Kind::Other);
        if self.modal.rotary_axes.tcp != Tcp::Off {
            let finding = self.lacks(bytes, "a tool change under control of the tool centre point");
            return Err(finding.help("end it first").into());
        }
        self.modal.tool.id = Some(ToolNumber(number));
        self.modal.rotary_axes.lapsed = false;
        if let Some(register) = self.dialect.register_after_change {
            self.modal.tool.length = Some(register);
            self.modal.tool_offsets = self.offsets_of(Some(register));
        }
        // Told again even if it is the same tool: the change is an item. LinuxCNC does not load the tool that is in the spindle, but
        // stops the spindle and goes to its place for changes (`convert_tool_change`, `CHANGE_TOOL`, `emcToolLoad`).
        self.modal.told.id = None;
        self.tool_origin = self.origin;
        (self.modal.length_hidden, self.length_lost) = (false, false);
        self.modal.spindle = Spindle::Off;
        self.modal.position = [None; 3];
        Ok(())
    }

    /// `M61 Q`: nothing moves, and the length in force stays.
    fn tool_in_spindle(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        let Some(tool) = take(words, "Q") else {
            return Err(self.lacks(bytes, "M61 without the number Q of the tool").into());
        };
        let number = self.count(&tool, "a tool number")?;
        self.in_table(number, &tool.bytes)?;
        let message = format!(
            "M61 says that tool {number} is in the spindle, and makes no change: it is read, and written, as a change of the tool"
        );
        self.warn(bytes, &message);
        self.flush(Kind::Other);
        self.modal.tool.id = Some(ToolNumber(number));
        self.modal.told.id = None;
        self.tool_origin = self.origin;
        Ok(())
    }

    /// A tool called at a control without a changer: a person changes it at the stop of the same block.
    fn hand_change(&mut self) -> Result<()> {
        let here = self.here.clone();
        let stop = self.codes.iter().position(|(c, _)| *c == Code::Stop(StopKind::Program));
        match stop {
            Some(stop) => {
                self.codes.remove(stop);
            }
            // The tool that is in the spindle when the program begins.
            None if self.modal.tool.id.is_none() => {}
            None => {
                return Err(self
                    .lacks(&here, "another tool is called without a stop to change it")
                    .help("program M0 in the block of T")
                    .into());
            }
        }
        self.tool_change(&here)
    }

    fn dwell(&mut self, bytes: &Bytes, words: &mut [Word<'s>]) -> Result<()> {
        let revolutions = if self.dialect.feed_is_dwell() { take(words, "S") } else { None };
        let said = self.dialect.dwell_words.iter().find_map(|(w, unit)| Some((take(words, w)?, *unit)));
        let (time, unit) = match (said, revolutions) {
            (Some((seconds, unit)), None) => (seconds, unit),
            (None, Some(turns)) => match self.modal.speed.filter(|s| *s > 0.0) {
                Some(speed) => (turns, TAU / speed),
                None => {
                    return Err(self
                        .lacks(&turns.bytes, "a dwell in revolutions without a spindle speed")
                        .into());
                }
            },
            (None, None) => {
                return Err(self.answers(self.lacks(bytes, "a dwell without a time"), 28).into());
            }
            (Some(_), Some(turns)) => return Err(self.twice(&turns.bytes).into()),
        };
        // An expression that comes to nothing may be below it by its rounding.
        const NOTHING: f64 = 1e-6;
        if time.value < -NOTHING {
            return Err(self.place.malformed(&time.bytes, "a dwell is not negative").into());
        }
        self.push_dwell(time.value.max(0.0) * unit);
        Ok(())
    }

    pub(super) fn push_dwell(&mut self, seconds: f64) {
        if self.waits_for_corner(seconds) {
            return;
        }
        self.flush(Kind::Other);
        self.program.push_dwell(seconds, &self.state(Speed::Rapid { linear: false }), self.origin);
    }

    fn length(&mut self, words: &mut [Word<'s>], machine: bool) -> Result<()> {
        let before = self.modal.tool.length;
        if self.dialect.one_register {
            let Some(register) = take(words, "D") else { return Ok(()) };
            let register = self.count(&register, "a register")?;
            self.modal.tool.length = (register != 0).then_some(register);
        } else if !self.dialect.has_lengths {
            // There is no length to switch: the zero of Z was set with the tool.
            return Ok(());
        } else {
            let of_length = |c: Code| {
                matches!(
                    c,
                    Code::LengthOn | Code::LengthOff | Code::LengthByNumber { .. } | Code::TipControl { .. }
                )
            };
            match self.code(of_length) {
                Some((code @ (Code::LengthOn | Code::TipControl { .. }), bytes)) => {
                    self.length_lost = false;
                    let register = match take(words, "H") {
                        Some(register) => {
                            let number = self.spindle_for_zero(self.count(&register, "a register")?);
                            self.in_table(number, &register.bytes)?;
                            number
                        }
                        None => match self.modal.tool.id.filter(|_| !self.dialect.length_with_z) {
                            Some(tool) => tool.0,
                            None => {
                                let finding =
                                    self.lacks(&bytes, "a length offset without a register or a tool");
                                return Err(finding.help("program H").into());
                            }
                        },
                    };
                    self.modal.tool.length = Some(self.called_length(register));
                    self.modal.length_stale = false;
                    match code {
                        Code::TipControl { vector } => self.tip_control(vector, &bytes)?,
                        _ => self.tip_control_ends(true),
                    }
                }
                Some((Code::LengthByNumber { add }, bytes)) => self.length_by_number(words, add, &bytes)?,
                Some(_) => {
                    self.length_lost = false;
                    self.modal.length_stale = false;
                    self.modal.tool.length = None;
                    self.tip_control_ends(false);
                }
                None => return Ok(()),
            }
        }
        if self.modal.tool.length != before {
            // A tool that was changed but has no item yet keeps the place of its change.
            if self.modal.told.id.is_some() {
                self.tool_origin = self.origin;
            }
            self.offsets_change();
            // While Z has not moved since the tool item, the length may as well have been called there.
            if let (true, Some(id), Some(item)) =
                (self.dialect.length_with_z, self.modal.tool.id, self.modal.tool_item)
                && self.modal.told.id == Some(id)
            {
                self.program.set_tool_length(item, self.modal.tool.length);
                self.modal.told.length = self.modal.tool.length;
            }
        }
        self.modal.length_hidden = machine && self.modal.tool.length.is_none();
        Ok(())
    }

    pub(super) fn work_offset(&mut self, offset: WorkOffset) {
        let before = self.modal.offset.replace(offset);
        if before == Some(offset) {
            return;
        }
        // These controls begin in G54.
        let begins = before.is_none() && offset == WorkOffset::G54 && !self.dialect.long_addresses;
        let machine = self.machine_place_in(before);
        if !begins {
            self.modal.position = [None; 3];
        }
        self.set_frame();
        if !begins && self.modal.rotary_axes.plane.is_none() && self.modal.rotary_axes.tcp == Tcp::Off {
            self.modal.position = self.place_of(machine);
        }
        let has = |i: usize| self.program.setups.get(i).is_some_and(|s| s.work_offsets.contains_key(&offset));
        let now = self.modal.setup.0 as usize;
        let count = self.program.setups.len();
        // The present clamping if it has the offset, otherwise the next one that has.
        if let Some(found) = (now..count).chain(0..now).find(|i| has(*i)) {
            self.modal.setup = SetupId(found as u32);
        }
    }

    fn distances(&mut self) {
        for (code, _) in &self.codes {
            match *code {
                Code::Absolute(yes) => self.modal.absolute = yes,
                Code::CentreAbsolute(yes) => self.modal.centre_absolute = yes,
                Code::ReturnToStart(yes) => {
                    (self.modal.return_to_start, self.modal.return_said) = (yes, true);
                }
                _ => {}
            }
        }
    }

    /// The motion code of the block.
    pub(super) fn motion_code(&self) -> Option<(Code, Bytes)> {
        if self.codes.is_empty() {
            return None;
        }
        let motion = |c: Code| c.group() == Code::Rapid.group();
        self.code(|c| motion(c) && c != Code::NoMotion).or_else(|| self.code(motion))
    }
}
