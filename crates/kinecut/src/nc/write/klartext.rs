//! HEIDENHAIN klartext: the same walk over the program, in blocks of another grammar.
//!
//! `L` for straight moves, `CC` and `C` for arcs in the plane, `CP IPA` for helices, `TOOL CALL`, `CYCL DEF 200` for
//! holes drilled in one go, `CYCL DEF 247` for work offsets, `CYCL DEF 32` for the tolerance of the path, `CYCL DEF 9` for a dwell. Arcs in other planes become
//! lines within the arc tolerance. What the words mean is told in `nc/heidenhain`.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::base::{Code, Finding, Result};
use crate::geom::{Aabb, Arc, Curve};
use crate::nc::Control;
use crate::nc::dialect::AXES;
use crate::nc::grid::{Grid, plain};
use crate::nc::heidenhain::polar::{TICKS, TURN, degrees, turned};
use crate::nc::heidenhain::{LONGEST_DWELL, REGISTERS, preset};
use crate::program::{
    Blend, Comp, Cycle, Frame, Item, Speed, Spindle, State, StopKind, Target, ToolNumber, WorkOffset,
};

use super::arc::{CHORD, FLAT, Rounded, round};
use super::{Writer, unsupported};

/// Most turns of one helix block: 5400 degrees, the limit of the older controls.
const MOST_TURNS: i64 = 15;
/// Distance within which a polar arc ends where it was meant to [mm]: rounding of doubles at a metre.
const SAME: f64 = 1e-9;
/// Longest program name.
const LONGEST_NAME: usize = 24;

/// What a klartext program has said beside the common words.
#[derive(Clone, Debug, Default)]
pub(super) struct Pen {
    /// Pole [steps].
    pole: Option<[i64; 2]>,
    /// Radius compensation in force and wanted.
    comp: Option<&'static str>,
    wanted: Option<&'static str>,
    /// Spindle speed of the last `TOOL CALL`.
    rpm: Option<String>,
    blend: Option<Blend>,
    /// The drilling cycle that is defined.
    cycle: Option<String>,
    /// Whether the item asks for an exact stop.
    stop: bool,
    /// Where the control stands after a polar arc, if that is no point of the grid [mm].
    pub(super) beside: Option<DVec2>,
}

impl Writer<'_> {
    /// Whether the text is klartext.
    pub(super) fn klartext(&self) -> bool {
        self.settings.control == Control::Heidenhain
    }

    /// First blocks: name, unit and the raw part for the control's graphics.
    pub(super) fn begin_program(&mut self) {
        let name = self.program_word();
        self.page.block(format!("BEGIN PGM {name} MM"));
        let Some(part) = self.raw_part() else { return };
        let mut corners = [String::from("BLK FORM 0.1 Z"), String::from("BLK FORM 0.2")];
        for (text, corner) in corners.iter_mut().zip([part.min, part.max]) {
            for (axis, value) in corner.to_array().into_iter().enumerate() {
                let Ok(count) = self.grid.round(value) else { return };
                text.push(' ');
                self.grid.word(text, AXES[axis], count);
            }
        }
        for text in corners {
            self.page.block(text);
        }
    }

    /// Last block.
    pub(super) fn end_program(&mut self) {
        let name = self.program_word();
        self.page.block(format!("END PGM {name} MM"));
    }

    fn program_word(&self) -> String {
        let name: String = self
            .settings
            .program_name
            .chars()
            .filter(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-'))
            .take(LONGEST_NAME)
            .collect();
        if name.is_empty() { "PROGRAM".to_owned() } else { name.to_ascii_uppercase() }
    }

    /// Box around the raw part of the first clamping, in the coordinates of the first move.
    fn raw_part(&self) -> Option<Aabb> {
        let items = &self.program.items;
        let first = (0..items.len())
            .find(|i| matches!(items.get(*i), Item::Move(m) if matches!(m.end, Target::Tip { .. })))?;
        let state = self.program.state(first);
        let Some(Frame::Work(offset)) = self.program.frames.get(state.frame.0 as usize) else { return None };
        let setup = self.program.setups.get(state.setup.0 as usize)?;
        let to_program = setup.work_offsets.get(offset)?.inverse().after(&setup.part_on_table);
        let Aabb { min, max } = setup.stock.as_ref()?.bounds();
        let corner = |i: u8| {
            let pick = |bit: u8, a: f64, b: f64| if i >> bit & 1 == 0 { a } else { b };
            DVec3::new(pick(0, min.x, max.x), pick(1, min.y, max.y), pick(2, min.z, max.z))
        };
        let part = Aabb::of_points((0..8).map(|i| to_program.point(corner(i))));
        (part.min.is_finite() && part.max.is_finite() && !part.is_empty()).then_some(part)
    }

    /// `TOOL CALL` with the speed that the tool will first turn at.
    pub(super) fn klartext_tool(
        &mut self,
        id: ToolNumber,
        length: Option<u32>,
        radius: Option<u32>,
    ) -> Result<()> {
        let Some(register) = length.filter(|r| REGISTERS.contains(r) && radius.is_none_or(|o| o == *r))
        else {
            return Err(unsupported(
                "TOOL CALL applies length and radius of the tool together, from register 1 (the tool) to 9 (its index)",
            )
            .value(length.or(radius).map_or(0.0, f64::from), "register")
            .cure("use one register from 1 to 9 for the length and the radius")
            .into());
        };
        let name = if register == 1 { id.0.to_string() } else { format!("{}.{register}", id.0) };
        if self.tool == Some(id) {
            if self.length != length {
                let speed = self.modal.pen.rpm.as_ref().map_or_else(String::new, |s| format!(" S{s}"));
                self.page.block(format!("TOOL CALL {name} Z{speed}"));
                // Heights are then another, so the next move names its Z.
                self.length = length;
                self.forget_axis(2);
                self.modal.pen.cycle = None;
            }
            return Ok(());
        }
        self.length = length;
        self.all_off();
        let rpm = self.first_speed(id);
        let speed = rpm.as_ref().map_or_else(String::new, |s| format!(" S{s}"));
        self.page.block(format!("TOOL CALL {name} Z{speed}"));
        self.tool = Some(id);
        self.place = super::Place::default();
        let blend = self.modal.pen.blend;
        self.modal.forget();
        self.modal.pen = Pen { rpm, blend, ..Pen::default() };
        Ok(())
    }

    /// The speed at which the tool called by the present item turns first.
    fn first_speed(&self, tool: ToolNumber) -> Option<String> {
        let items = &self.program.items;
        let from = self.page.item.map_or(items.len(), |i| i as usize + 1);
        for index in from..items.len() {
            match items.get(index) {
                Item::Tool { id, .. } if id != tool => return None,
                Item::Move(_) | Item::Cycle(..) | Item::Dwell(_) => {}
                Item::Stop(kind) if kind != StopKind::End => {}
                _ => continue,
            }
            if let Spindle::Clockwise(rate) | Spindle::CounterClockwise(rate) =
                self.program.state(index).spindle
            {
                let rpm = rate / TAU * 60.0;
                return (rpm.is_finite() && rpm >= 0.0).then(|| plain(rpm));
            }
        }
        None
    }

    /// Changes of the state.
    pub(super) fn klartext_state(&mut self, state: &State, in_work: bool) -> Result<()> {
        if state.tcp {
            return Err(unsupported("tool centre point control is not written yet").into());
        }
        self.modal.pen.wanted = Some(match state.comp {
            Comp::Off => "R0",
            Comp::Left(_) => "RL",
            Comp::Right(_) => "RR",
        });
        self.path_tolerance(state.blend)?;
        if let Some(name) = if in_work { self.work_offset(state)? } else { None } {
            // The offsets of this control were asked for by the caller.
            let number = WorkOffset::parse(&name).and_then(preset).unwrap_or(0);
            self.page.block("CYCL DEF 247 DATUM SETTING ~".to_owned());
            self.page.line(format!("    Q339=+{number} ;DATUM NUMBER"));
            self.modal.pen.pole = None;
            self.modal.pen.beside = None;
        }
        if let Some(words) = self.spindle(state.spindle)? {
            let word = match words.split_once(' ') {
                Some((speed, word)) => {
                    let rpm = speed.trim_start_matches('S');
                    if self.modal.pen.rpm.as_deref() != Some(rpm) {
                        self.page.block(format!("TOOL CALL S{rpm}"));
                        self.modal.pen.rpm = Some(rpm.to_owned());
                    }
                    word.to_owned()
                }
                None => words,
            };
            self.page.block(word);
        }
        if let Some(word) = self.coolant(state.coolant) {
            self.page.block(word);
        }
        Ok(())
    }

    /// `CYCL DEF 32`; an exact stop is refused where it would matter, in a feed move.
    fn path_tolerance(&mut self, blend: Blend) -> Result<()> {
        self.modal.pen.stop = blend == Blend::Stop;
        if blend == Blend::Stop || self.modal.pen.blend == Some(blend) {
            return Ok(());
        }
        self.modal.pen.blend = Some(blend);
        let value = match blend {
            Blend::Tolerance { path, .. } if path.is_finite() && path > 0.0 => format!(" T{}", plain(path)),
            Blend::Tolerance { path, .. } => {
                return Err(Finding::error(
                    Code::POST_NUMBER,
                    "the tolerance of a continuous path is not usable",
                )
                .value_mm(path)
                .into());
            }
            _ => String::new(),
        };
        self.page.block("CYCL DEF 32.0 TOLERANCE".to_owned());
        self.page.block(format!("CYCL DEF 32.1{value}"));
        Ok(())
    }

    /// `CYCL DEF 200` for a hole drilled in one go; whether it was written. Everything else is written as moves.
    pub(super) fn klartext_cycle(&mut self, cycle: &Cycle, state: &State) -> Result<bool> {
        let (&Cycle::Drill { reference, bottom, retract, dwell }, Speed::PerMinute(feed)) =
            (cycle, state.speed)
        else {
            return Ok(false);
        };
        let known = self.place.written[0].is_some() && self.place.written[1].is_some();
        let number = plain(feed * 60.0);
        let simple = known && state.blend != Blend::Stop && state.comp == Comp::Off;
        let usable =
            feed.is_finite() && feed > 0.0 && number != "0" && (0.0..=LONGEST_DWELL).contains(&dwell);
        if !simple || !usable {
            return Ok(false);
        }
        let [top, low, up] =
            [self.grid.round(reference)?, self.grid.round(bottom)?, self.grid.round(retract)?];
        if low >= top || top > up {
            return Ok(false);
        }
        self.state(state, true)?;
        if self.place.written[0].is_none() || self.place.written[1].is_none() {
            let finding = Finding::error(Code::NC_STATE, "a cycle is called where the position is not known");
            return Err(finding.cure("move there in its work offset first").into());
        }
        // The work zero is mostly the surface; if the hole does not begin there, the reference height is.
        let surface = if low < 0 && top > 0 { 0 } else { top };
        let value = |count: i64| {
            let mut text = String::new();
            self.grid.word(&mut text, "", count);
            text
        };
        let lines = [
            "CYCL DEF 200 DRILLING ~".to_owned(),
            format!("    Q200={} ;SET-UP CLEARANCE ~", value(top - surface)),
            format!("    Q201={} ;DEPTH ~", value(low - surface)),
            format!("    Q206=+{number} ;FEED RATE FOR PLNGNG ~"),
            format!("    Q202={} ;PLUNGING DEPTH ~", value(surface - low)),
            "    Q210=+0 ;DWELL TIME AT TOP ~".to_owned(),
            format!("    Q203={} ;SURFACE COORDINATE ~", value(surface)),
            format!("    Q204={} ;2ND SET-UP CLEARANCE ~", value(up - surface)),
            format!("    Q211=+{} ;DWELL TIME AT DEPTH", plain(dwell)),
        ];
        let definition = lines.join("\n");
        if self.modal.pen.cycle.as_ref() != Some(&definition) {
            for line in lines {
                self.page.block(line);
            }
            self.modal.pen.cycle = Some(definition);
        }
        self.page.block("CYCL CALL".to_owned());
        for (count, exact) in [(top, reference), (low, bottom), (up, retract)] {
            self.notes.rounding = self.notes.rounding.max((self.grid.value(count) - exact).abs());
        }
        self.place.written[2] = Some(up);
        self.place.exact[2] = retract;
        Ok(true)
    }

    /// `CYCL DEF 9`.
    pub(super) fn klartext_dwell(&mut self, seconds: f64) -> Result<()> {
        if seconds > LONGEST_DWELL {
            let finding = Finding::error(Code::POST_NUMBER, "a dwell is too long for this control");
            return Err(finding.value(seconds, "s").bound(LONGEST_DWELL, "s").into());
        }
        self.page.block("CYCL DEF 9.0 DWELL TIME".to_owned());
        self.page.block(format!("CYCL DEF 9.1 DWELL {}", plain(seconds)));
        Ok(())
    }

    /// A straight move.
    pub(super) fn klartext_line(&mut self, axes: &str, speed: Speed) -> Result<()> {
        self.modal.pen.beside = None;
        let mut block = format!("L {axes}");
        self.ending(&mut block, speed, true)?;
        self.page.block(block);
        Ok(())
    }

    /// A straight move in machine coordinates.
    pub(super) fn klartext_joints(&mut self, axes: &str, speed: Speed) -> Result<()> {
        if self.modal.pen.wanted.is_some_and(|w| w != "R0") {
            return Err(unsupported("a move in machine coordinates cannot be compensated").into());
        }
        if self.place.written[0].is_none() || self.place.written[1].is_none() {
            self.modal.pen.beside = None;
        }
        let mut block = format!("L {axes}");
        self.ending(&mut block, speed, true)?;
        block.push_str(" M91");
        self.page.block(block);
        Ok(())
    }

    /// An arc in the plane; `centre` relative to its start [steps].
    pub(super) fn klartext_arc(
        &mut self,
        end: [f64; 3],
        centre: [i64; 2],
        ccw: bool,
        speed: Speed,
    ) -> Result<()> {
        let pole = [self.written(0)? + centre[0], self.written(1)? + centre[1]];
        self.pole(pole);
        let mut block = String::from("C ");
        for (axis, value) in end.into_iter().enumerate() {
            self.axis(&mut block, axis, value, axis != 2)?;
        }
        self.modal.pen.beside = None;
        block.push_str(if ccw { " DR+" } else { " DR-" });
        self.ending(&mut block, speed, false)?;
        self.page.block(block);
        Ok(())
    }

    fn pole(&mut self, pole: [i64; 2]) {
        if self.modal.pen.pole.replace(pole) == Some(pole) {
            return;
        }
        let mut block = String::from("CC ");
        self.grid.word(&mut block, AXES[0], pole[0]);
        self.grid.word(&mut block, AXES[1], pole[1]);
        self.page.block(block);
    }

    /// Radius compensation and feed of a block.
    fn ending(&mut self, block: &mut String, speed: Speed, straight: bool) -> Result<()> {
        let (_, feed) = self.feed_words(speed)?;
        let rapid = matches!(speed, Speed::Rapid { .. });
        if self.modal.pen.stop && !rapid {
            return Err(unsupported("this control has no word for an exact stop at the end of a block")
                .cure("ask for a continuous path within a tolerance")
                .into());
        }
        let wanted = self.modal.pen.wanted.unwrap_or("R0");
        if straight {
            if rapid || self.modal.pen.comp != Some(wanted) {
                block.push(' ');
                block.push_str(wanted);
                self.modal.pen.comp = Some(wanted);
            }
        } else if self.modal.pen.comp.unwrap_or("R0") != wanted {
            return Err(unsupported("cutter compensation begins and ends on a straight move").into());
        }
        if rapid {
            block.push_str(" FMAX");
        } else if let Some(feed) = feed {
            block.push_str(match speed {
                Speed::PerRevolution(_) => " FU",
                Speed::Duration(_) => " FT",
                _ => " F",
            });
            block.push_str(&feed_value(speed, feed));
        }
        Ok(())
    }

    /// An arc outside the plane of the tool, as lines.
    pub(super) fn klartext_chords(&mut self, arc: &Arc, point: DVec3, speed: Speed) -> Result<()> {
        let tolerance = self.settings.arc_tolerance;
        self.notes.chain_tolerance = self.notes.chain_tolerance.max(tolerance);
        self.chords(&Curve::from(*arc), tolerance, speed)?;
        self.line(point.to_array(), speed)
    }

    /// A helix: `CP IPA`, and where its angle does not lead to a point of the grid, a short line at its end.
    ///
    /// `sweep` counter-clockwise about Z [rad].
    pub(super) fn polar_arc(
        &mut self,
        arc: &Arc,
        sweep: f64,
        least_radius: f64,
        point: DVec3,
        speed: Speed,
    ) -> Result<()> {
        let ticks = (sweep.to_degrees() * TICKS).round() as i64;
        if ticks.abs() > MOST_TURNS * TURN {
            let part = MOST_TURNS as f64 * TAU / sweep.abs();
            return self.split(arc, part, true, point, speed);
        }
        let pole = [self.grid.round(arc.centre.x)?, self.grid.round(arc.centre.y)?];
        let centre = DVec2::new(self.grid.value(pole[0]), self.grid.value(pole[1]));
        let start = match self.modal.pen.beside {
            Some(beside) => beside,
            None => self.written_xy()?,
        };
        let end = point.truncate();
        let goal = [self.grid.round(end.x)?, self.grid.round(end.y)?];
        let on_grid = DVec2::new(self.grid.value(goal[0]), self.grid.value(goal[1]));
        let radius = self.grid.steps((start - centre).length());
        if ticks != 0 && radius >= least_radius {
            let there = turned(start, centre, degrees(ticks));
            let exact = (there - on_grid).length() <= SAME;
            if exact || (there - end).length() <= SAME {
                self.polar_block(pole, ticks, point, speed)?;
                self.modal.pen.beside = (!exact).then_some(there);
                return Ok(());
            }
        }
        // The last bit is a line that leaves the arc by no more than the rounding does.
        let back = (8.0 * FLAT * radius).sqrt() / radius;
        let between = (start - centre).angle_to(on_grid - centre);
        let total = between + TAU * ((sweep - between) / TAU).round();
        let steps = [goal[0] - self.written(0)?, goal[1] - self.written(1)?];
        let from = DVec2::new(self.grid.value(self.written(0)?), self.grid.value(self.written(1)?));
        let offset = (arc.centre.truncate() - from) / self.grid.unit();
        let flat = match round(steps, offset, sweep, least_radius) {
            Rounded::Straight | Rounded::Chords => true,
            Rounded::Arc { .. } | Rounded::Split { .. } => false,
        };
        if flat || radius < least_radius || total.abs() < LEAST_PARTS * back {
            self.notes.straightened += 1;
            let curve = Curve::from(*arc);
            if arc.radius() > 0.0 && curve.length() > CHORD * self.grid.unit() {
                self.chords(&curve, CHORD * self.grid.unit(), speed)?;
            }
            return self.line(point.to_array(), speed);
        }
        let short = ((total.abs() - back).to_degrees() * TICKS).floor().copysign(total) as i64;
        let there = turned(start, centre, degrees(short));
        let part = degrees(short).to_radians() / total;
        let rise = point.z - self.place.exact[2];
        let mut height = self.place.exact[2] + rise * part;
        if self.grid.round(height)? == self.written(2)? {
            // A block without rise would be an arc in the plane.
            height = point.z;
        }
        self.polar_block(pole, short, there.extend(height), speed)?;
        self.modal.pen.beside = Some(there);
        self.line(point.to_array(), speed)
    }

    fn polar_block(&mut self, pole: [i64; 2], ticks: i64, end: DVec3, speed: Speed) -> Result<()> {
        self.pole(pole);
        let mut block = String::from("CP ");
        Grid::new(4)?.signed().word(&mut block, "IPA", ticks);
        let mut unsaid = String::new();
        for (axis, value) in end.to_array().into_iter().enumerate() {
            let words = if axis == 2 { &mut block } else { &mut unsaid };
            self.axis(words, axis, value, axis == 2)?;
        }
        block.push_str(if ticks >= 0 { " DR+" } else { " DR-" });
        self.ending(&mut block, speed, false)?;
        self.page.block(block);
        Ok(())
    }
}

/// A helix shorter than this many of its closing lines is written as lines altogether.
const LEAST_PARTS: f64 = 3.0;

/// The number of a feed; the time of a block instead of its inverse.
fn feed_value(speed: Speed, feed: String) -> String {
    match speed {
        Speed::Duration(seconds) => plain(seconds),
        _ => feed,
    }
}
