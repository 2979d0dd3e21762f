//! Variables as a program reads and sets them: its own, and those in which a control shows its state.
//!
//! LinuxCNC: `#1` to `#30` are local, `#31` to `#5000` of all calls, above are those of the control. FANUC: `#1` to `#33` are
//! local, `#100` to `#199` and `#500` to `#999` of all, `#1000` and above those of the control. What the machine alone knows
//! (offsets, inputs, the clock) has no value here: a program that moves by it is refused where it reads it.

use crate::base::{Code as FindingCode, Finding, Result};
use crate::nc::dialect::{Code, FlowWords, Plane};
use crate::nc::run::{Known, Names, Value};
use crate::program::{Comp, Coolant, Spindle, StopKind, WorkOffset};

use super::block::{Assignment, Variable};
use super::modal::FeedMode;
use super::place::Bytes;
use super::reader::Reader;

/// Variables of the machine: what they hold.
const OFFSETS: &str = "the machine knows its offsets, the program does not set this one";
const TABLE: &str = "it is in the tool table of the machine";
const PROBE: &str = "it is what the machine has probed";
const SIGNAL: &str = "it is a signal of the machine";
const CLOCK: &str = "it is a clock of the machine";
const PLACE: &str = "the program has not set this position";

/// Most variables of which it is said that they were not set.
const MOST_UNSET: usize = 50;

fn number(value: f64) -> Known {
    Known::Value(Value::Number(value))
}

fn truth(value: bool) -> Known {
    number(f64::from(u8::from(value)))
}

impl Names for Reader<'_> {
    fn numbered(&self, index: u32) -> Known {
        let own = self.variables.numbered(index);
        match self.dialect.flow {
            FlowWords::MacroB => match (own, index) {
                (_, 0) => Known::Value(Value::Vacant),
                (Some(value), _) => Known::Value(value),
                (None, 1..=999) => self.unset(index, Value::Vacant),
                _ => self.fanuc(index),
            },
            _ => match (own, index) {
                (Some(value), 1..=5000) => Known::Value(value),
                (None, 1..=5000) => self.unset(index, Value::Number(0.0)),
                _ => self.linuxcnc(index),
            },
        }
    }

    fn named(&self, name: &str) -> Known {
        match self.variables.named(name) {
            Some(value) => Known::Value(value),
            None => self.linuxcnc_named(name),
        }
    }
}

impl Reader<'_> {
    /// A variable that the program has not set, with the value that it has then.
    fn unset(&self, index: u32, value: Value) -> Known {
        let said = self.unset_said.contains(&index) || self.unset_said.len() >= MOST_UNSET;
        if self.unset.get().is_none() && !said {
            self.unset.set(Some(index));
        }
        Known::Value(value)
    }

    /// A coordinate of the tip in the coordinates and the unit of the program.
    fn coordinate(&self, axis: usize) -> Known {
        if axis < 3 && self.scaling.map.is_some_and(|map| !map.keeps(axis)) {
            return Known::Unknown("what it holds while coordinates are scaled or mirrored is not known");
        }
        match self.modal.position.get(axis) {
            Some(Some(place)) => number(place / self.modal.length_unit),
            Some(None) => Known::Unknown(PLACE),
            None => match self.modal.rotary_axes.rotaries.at[axis - 3] {
                Some(angle) => number(angle),
                None => Known::Unknown(PLACE),
            },
        }
    }

    fn linuxcnc(&self, index: u32) -> Known {
        match index {
            5061..=5070 => Known::Unknown(PROBE),
            5220 => number(self.offset_number()),
            5399 => Known::Unknown(SIGNAL),
            5400 => number(self.modal.tool.id.map_or(0.0, |t| f64::from(t.0))),
            5161..=5169 | 5181..=5189 | 5210..=5390 | 5401..=5413 => self.offset_parameter(index),
            5420..=5425 => self.coordinate(index as usize - 5420),
            5426..=5428 => number(0.0),
            _ => Known::Missing,
        }
    }

    /// The work offset in force, counted from 1.
    fn offset_number(&self) -> f64 {
        let offset = self.modal.offset.unwrap_or(WorkOffset::G54).tenths();
        f64::from(match offset {
            540..=590 => offset / 10 - 53,
            _ => offset - 584,
        })
    }

    fn linuxcnc_named(&self, name: &str) -> Known {
        let modal = &self.modal;
        let per_minute = |speed: f64| speed * 60.0 / std::f64::consts::TAU;
        match name {
            "_x" => self.coordinate(0),
            "_y" => self.coordinate(1),
            "_z" => self.coordinate(2),
            "_a" => self.coordinate(3),
            "_b" => self.coordinate(4),
            "_c" => self.coordinate(5),
            "_u" | "_v" | "_w" => number(0.0),
            "_lathe_diameter_mode" => truth(modal.diameters),
            "_lathe_radius_mode" => truth(!modal.diameters),
            "_metric" => truth(modal.length_unit == 1.0),
            "_imperial" => truth(modal.length_unit != 1.0),
            "_absolute" => truth(modal.absolute),
            "_incremental" => truth(!modal.absolute),
            "_inverse_time" => truth(modal.feed_mode == FeedMode::InverseTime),
            "_units_per_minute" => truth(modal.feed_mode == FeedMode::PerMinute),
            "_units_per_rev" => truth(modal.feed_mode == FeedMode::PerRevolution),
            "_coord_system" => number(f64::from(modal.offset.unwrap_or(WorkOffset::G54).tenths())),
            "_plane" => number(match modal.plane {
                Plane::Xy => 170.0,
                Plane::Zx => 180.0,
                Plane::Yz => 190.0,
            }),
            "_ccomp" => number(match modal.comp {
                Comp::Off => 400.0,
                Comp::Left(_) => 410.0,
                Comp::Right(_) => 420.0,
            }),
            "_retract_old_z" => truth(modal.return_to_start),
            "_retract_r_plane" => truth(!modal.return_to_start),
            "_current_tool" => number(modal.tool.id.map_or(0.0, |t| f64::from(t.0))),
            "_selected_tool" => number(modal.chosen.map_or(0.0, f64::from)),
            "_spindle_on" => truth(modal.spindle != Spindle::Off),
            "_spindle_cw" => truth(matches!(modal.spindle, Spindle::Clockwise(_))),
            "_mist" => truth(matches!(modal.coolant, Coolant::Mist | Coolant::Both)),
            "_flood" => truth(matches!(modal.coolant, Coolant::Flood | Coolant::Both)),
            "_rpm" => number(modal.speed.map_or(0.0, per_minute)),
            "_feed" => match (modal.feed_mode, modal.feed) {
                (_, None) => number(0.0),
                (FeedMode::PerMinute, Some(feed)) => number(feed * 60.0 / modal.feed_unit),
                (FeedMode::PerRevolution, Some(feed)) => number(feed / modal.feed_unit),
                (FeedMode::InverseTime, Some(feed)) => number(feed),
            },
            "_line" => number(f64::from(self.place.sources.line(self.place.span(&self.here)))),
            "_value" => number(self.value_returned.0),
            "_value_returned" => truth(self.value_returned.1),
            "_call_level" => number(self.depth as f64),
            "_remap_level" => number(0.0),
            // A run on the machine, not its preview.
            "_task" => number(1.0),
            "_vmajor" => number(2.9),
            "_vminor" => number(0.0),
            _ if name.starts_with("_ini[") || name.starts_with("_hal[") => Known::Unknown(SIGNAL),
            _ => Known::Missing,
        }
    }

    fn fanuc(&self, index: u32) -> Known {
        let modal = &self.modal;
        match index {
            1000..=1199 => Known::Unknown(SIGNAL),
            2000..=2999 | 10_001..=13_999 => Known::Unknown(TABLE),
            3001 | 3002 | 3011 | 3012 => Known::Unknown(CLOCK),
            3003 | 3004 => number(0.0),
            3901 | 3902 => Known::Unknown("it counts parts on the machine"),
            4001 => match modal.path_code {
                Some(Code::Rapid) => number(0.0),
                Some(Code::Feed) => number(1.0),
                Some(Code::Arc { ccw: false }) => number(2.0),
                Some(Code::Arc { ccw: true }) => number(3.0),
                _ => Known::Unknown("a motion that no number tells is in force"),
            },
            4002 => number(match modal.plane {
                Plane::Xy => 17.0,
                Plane::Zx => 18.0,
                Plane::Yz => 19.0,
            }),
            4003 => number(if modal.absolute { 90.0 } else { 91.0 }),
            4005 => number(match modal.feed_mode {
                FeedMode::InverseTime => 93.0,
                FeedMode::PerMinute => 94.0,
                FeedMode::PerRevolution => 95.0,
            }),
            4006 => number(if modal.length_unit == 1.0 { 21.0 } else { 20.0 }),
            4007 => number(match modal.comp {
                Comp::Off => 40.0,
                Comp::Left(_) => 41.0,
                Comp::Right(_) => 42.0,
            }),
            4008 => number(if modal.tool.length.is_some() { 43.0 } else { 49.0 }),
            4010 => number(if modal.return_to_start { 98.0 } else { 99.0 }),
            4014 => number(match modal.offset.unwrap_or(WorkOffset::G54) {
                offset if offset.extension().is_some() => 54.1,
                offset => f64::from(offset.tenths()) / 10.0,
            }),
            4130 => number(modal.offset.and_then(WorkOffset::extension).map_or(0.0, f64::from)),
            4107 => number(modal.radius.map_or(0.0, f64::from)),
            4109 => match (modal.feed_mode, modal.feed) {
                (FeedMode::PerMinute, Some(feed)) => number(feed * 60.0 / modal.feed_unit),
                (_, Some(feed)) => number(feed / modal.feed_unit),
                (_, None) => number(0.0),
            },
            4111 => number(modal.tool.length.map_or(0.0, f64::from)),
            4119 => number(modal.speed.map_or(0.0, |s| (s * 60.0 / std::f64::consts::TAU).round())),
            4120 => number(modal.chosen.map_or(0.0, f64::from)),
            5001..=5006 => self.coordinate(index as usize - 5001),
            5041..=5046 => self.coordinate(index as usize - 5041),
            5021..=5028 => Known::Unknown("the machine knows its own coordinates"),
            5061..=5068 => Known::Unknown(PROBE),
            5081..=5088 => Known::Unknown(TABLE),
            5201..=5328 | 7001..=7959 | 14_001..=19_988 => Known::Unknown(OFFSETS),
            _ => Known::Missing,
        }
    }

    /// Notes a variable that was read before the program has set it.
    pub(super) fn note_unset(&mut self, bytes: &Bytes) {
        let Some(index) = self.unset.take() else { return };
        self.unset_said.push(index);
        let macro_b = self.dialect.flow == FlowWords::MacroB;
        let place = self.place.sources.locate(self.place.span(bytes));
        let read = format!("#{index} is read before the program sets it");
        let (finding, help) = if macro_b {
            // Common variables keep what another program left in them.
            let message =
                format!("{read}: it may hold what another program left in it, and is followed as empty");
            let finding = Finding::doubt(FindingCode::NC_ASSUMED, message);
            (finding, "the control keeps it from one program to the next: set it first")
        } else {
            let finding = Finding::warning(FindingCode::NC_ASSUMED, format!("{read}: 0 is assumed"));
            (finding, "the control keeps it only where its parameter file lists it: set it first")
        };
        self.findings.push(finding.at(place).help(help));
    }

    /// Gives a variable its value.
    pub(super) fn assign(&mut self, assignment: Assignment, comments: &[(&str, Bytes)]) -> Result<()> {
        let Assignment { variable, value, bytes } = assignment;
        match variable {
            Variable::Named(name) => {
                if self.linuxcnc_named(&name) != Known::Missing {
                    let why = "the control alone sets this parameter";
                    return Err(self.place.malformed(&bytes, why).into());
                }
                self.variables.set_named(&name, value);
                Ok(())
            }
            Variable::Numbered(index) if self.dialect.flow == FlowWords::MacroB => {
                self.assign_fanuc(index, value, &bytes, comments)
            }
            Variable::Numbered(index @ 1..=5000) => {
                self.variables.set_numbered(index, value);
                Ok(())
            }
            Variable::Numbered(index) => Err(self.not_set(index, &bytes).into()),
        }
    }

    /// Refuses to set a variable of the control.
    fn not_set(&self, index: u32, bytes: &Bytes) -> Finding {
        let why = match self.dialect.flow {
            FlowWords::MacroB => {
                "the control has this variable for its own state, which a program does not set here"
            }
            _ if (5001..=5602).contains(&index) => "the control keeps its own state in #5001 to #5602",
            _ => "parameters are #1 to #5602",
        };
        self.place.not_understood(bytes, why)
    }

    fn assign_fanuc(
        &mut self,
        index: u32,
        value: Value,
        bytes: &Bytes,
        comments: &[(&str, Bytes)],
    ) -> Result<()> {
        let text = || comments.first().map_or("", |c| c.0);
        match index {
            0 => Err(self.place.malformed(bytes, "#0 is always empty").into()),
            1..=999 => {
                self.variables.set_numbered(index, value);
                Ok(())
            }
            // Geometry of radius registers.
            13_001..=13_999 => {
                self.variables.set_numbered(index, value);
                let radius = value.number() * self.modal.length_unit;
                self.radii.retain(|r| r.0 != index - 13_000);
                self.radii.push((index - 13_000, radius));
                Ok(())
            }
            3000 => {
                let message = format!("the program stops itself with alarm {}: {}", value.number(), text());
                let finding = self.place.error(FindingCode::NC_STATE, bytes, message.trim_end_matches(": "));
                self.ended = true;
                Err(finding.help("what it checks before is not fulfilled").into())
            }
            3006 => {
                self.push_stop(StopKind::Program);
                Ok(())
            }
            3001..=3004 => {
                let message = format!("`{}` is not followed: it moves no axis", self.place.shown(bytes));
                self.note(&message);
                Ok(())
            }
            _ => Err(self.not_set(index, bytes).into()),
        }
    }
}
