//! Motion blocks: lines, rapids, moves in machine coordinates; arcs, involutes and cycles are next door.

use glam::DVec3;

use crate::base::{Code as FindingCode, Result};
use crate::nc::dialect::{AXES, Code, OFFSETS, SeriesRule, TurnWord};
use crate::program::{Comp, Move, Path, Speed, Target, Tcp};

use super::block::{Word, WordMode};
use super::modal::FeedMode;
use super::place::Bytes;
use super::reader::{Kind, Reader, take, take_way};
use super::zeros::Spot;

impl<'s> Reader<'s> {
    /// Executes the motion of a block; `machine`: the place of a word for machine coordinates.
    pub(super) fn motion(&mut self, words: &mut [Word<'s>], machine: Option<Bytes>) -> Result<()> {
        if let Some((code, bytes)) = self.code(|c| matches!(c, Code::Reference | Code::FurtherReference)) {
            return self.reference_move(words, code, &bytes);
        }
        if let Some((Code::Holes(pattern), bytes)) = self.code(|c| matches!(c, Code::Holes(_))) {
            return self.pattern(words, pattern, &bytes);
        }
        if let Some((Code::RoundPocket { ccw }, bytes)) = self.code(|c| matches!(c, Code::RoundPocket { .. }))
        {
            if let Some((code, _)) = self.motion_code() {
                self.puts_in_force(code);
            }
            return self.round_pocket(words, ccw, &bytes);
        }
        if self.code(|c| matches!(c, Code::Probe { .. })).is_some() {
            self.modal.motion = None;
            self.modal.sticky.end();
            return Ok(());
        }
        let code = self.motion_code();
        if let Some((code, code_at)) = &code {
            let interpreter = self.dialect.series == SeriesRule::Interpreter;
            if interpreter && matches!(code, Code::Cycle(_)) && self.modal.motion != Some(*code) {
                self.modal.sticky.another();
            }
            self.puts_in_force(*code);
            if !matches!(code, Code::Cycle(_)) {
                self.modal.sticky.end();
            }
            if *code != Code::Cubic {
                self.modal.cubic_end = None;
            }
            if *code == Code::RunSpline {
                let bytes = code_at.clone();
                self.modal.motion = None;
                return self.run_spline(&bytes);
            }
            if self.nurbs.is_some() && !matches!(code, Code::ControlPoint | Code::KnotRow) {
                let bytes = code_at.clone();
                let finding = self.lacks(&bytes, "another motion before the spline is run");
                return Err(finding.help("program G5.3, or the last knots of G6.2").into());
            }
        }
        if self.gives_points() && (code.is_some() || words.iter().any(|w| !w.used)) {
            return match self.modal.motion {
                Some(Code::KnotRow) => self.knot_row(words),
                _ => self.control_point(words),
            };
        }
        let axis = self.has_axis(words);
        let curve = matches!(self.modal.motion, Some(Code::Arc { .. } | Code::Involute { .. }));
        let centre = curve && words.iter().any(|w| !w.used && OFFSETS.iter().any(|o| w.is(o)));
        if !axis && !centre {
            return match (code, machine) {
                (Some((Code::Arc { .. } | Code::Involute { .. }, bytes)), _) => {
                    Err(self.no_centre(&bytes).into())
                }
                (Some((Code::Cubic, bytes)), _) => Err(self.lacks(&bytes, "a cubic without X or Y").into()),
                (Some((Code::Cycle(_), bytes)), _) => {
                    Err(self.lacks(&bytes, "a cycle without an axis").into())
                }
                (_, Some(bytes)) => {
                    Err(self.answers(self.lacks(&bytes, "machine coordinates without an axis"), 26).into())
                }
                _ => Ok(()),
            };
        }
        if let Some(bytes) = machine {
            return self.machine_move(words, &bytes);
        }
        self.check_along()?;
        if curve && self.centre_is_axis() {
            let why = "an arc where I, J and K are the tool axis";
            return Err(self.lacks(&self.here, why).help("program it under G43.4, or as lines").into());
        }
        self.note_interpolation();
        let axis = self.tool_axis(words)?;
        self.modal.rotary_axes.next = Some(axis);
        let done = self.only_straight().and_then(|()| self.tip_move(words));
        self.modal.rotary_axes.next = None;
        done
    }

    /// Puts a motion code in force.
    pub(super) fn puts_in_force(&mut self, code: Code) {
        self.modal.motion_said |= code != Code::NoMotion;
        self.modal.motion = match code {
            Code::NoMotion => self.modal.path_code,
            _ => Some(code),
        };
        if self.dialect.cycles_apart() && !matches!(code, Code::NoMotion | Code::Cycle(_)) {
            self.modal.path_code = Some(code);
        }
    }

    /// Says that a move has no motion code yet, where the control begins with one.
    fn note_motion(&mut self) {
        if self.modal.motion_said || self.modal.motion.is_none() {
            return;
        }
        self.modal.motion_said = true;
        // A Haas begins with G0 whatever its settings are.
        if !self.dialect.haas {
            let here = self.here.clone();
            let message = "a move before any motion code: G0 is assumed, with which the control begins unless parameter 3402#0 says G1";
            self.doubt(&here, message, "program G0 or G1");
        }
    }

    fn tip_move(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        self.unit_is_the_same();
        self.note_motion();
        if self.length_lost
            && let Some(word) = words.iter().find(|w| !w.used && w.is(AXES[2]))
        {
            let message = "Z without a tool length: G28 has cancelled it on this control";
            return Err(self.lacks(&word.bytes, message).help("call it again with G43 H").into());
        }
        match self.modal.motion {
            Some(Code::Rapid) => self.straight(words, Speed::Rapid { linear: self.dialect.straight_rapid }),
            Some(Code::Feed) => {
                let speed = self.feed_speed()?;
                self.straight(words, speed)
            }
            Some(Code::Arc { ccw }) => self.arc(words, ccw),
            Some(Code::Involute { ccw }) => self.involute(words, ccw),
            Some(Code::Cubic) => self.cubic(words),
            Some(Code::Quadratic) => self.quadratic(words),
            Some(Code::Cycle(kind)) => self.cycle(words, kind),
            Some(Code::SynchronisedTap) => self.synchronised_tap(words),
            Some(Code::Geared) => self.geared_move(words),
            Some(Code::Thread) => self.thread(words),
            _ => {
                let here = self.here.clone();
                let finding = self.lacks(&here, "axis words without a motion code (G0, G1, ...)");
                Err(self.answers(finding, 31).into())
            }
        }
    }

    /// Warns of a program that has moved in one unit and now moves in the other.
    fn unit_is_the_same(&mut self) {
        let before = self.modal.moved_in.replace(self.modal.length_unit);
        let Some(changed) = self.modal.unit_said_at.clone() else { return };
        if before.is_none_or(|unit| unit == self.modal.length_unit) {
            return;
        }
        let message = "the program moves in both inches and millimetres";
        if self.findings.iter().all(|f| f.message != message) {
            let finding = self.place.warning(FindingCode::NC_ASSUMED, &changed, message);
            self.findings.push(finding.help("write it in one unit"));
        }
    }

    /// The end of a move; an axis that is neither said nor known stays `None`.
    pub(super) fn end(&mut self, words: &mut [Word<'s>]) -> Result<[Option<f64>; 3]> {
        let mut end = self.modal.position;
        for axis in 0..3 {
            let Some((word, way)) = take_way(words, AXES[axis]) else { continue };
            if self.modal.turned.adrift[axis] {
                let message = "the coordinates that this axis had before G92 are not known to the program";
                return Err(self.lacks(&word.bytes, message).help("begin with a known place").into());
            }
            let value = word.value * self.modal.length_unit;
            let absolute = match way {
                WordMode::Plain => self.modal.absolute,
                WordMode::Absolute => true,
                WordMode::Increment => false,
                _ => {
                    let why = "a direction of turning belongs to a rotary axis";
                    return Err(self.place.malformed(&word.bytes, why).into());
                }
            };
            if !absolute && self.modal.turned.fresh[axis] && self.dialect.turn == TurnWord::Programmable {
                let finding = self.lacks(
                    &word.bytes,
                    "whether an increment right after a shift or rotation travels that too is setting data 42440",
                );
                return Err(finding.help("move this axis to an absolute position first").into());
            }
            self.modal.turned.fresh[axis] = false;
            end[axis] = Some(match (absolute, end[axis]) {
                (true, _) => value,
                (false, Some(before)) => before + value,
                (false, None) => {
                    let finding =
                        self.lacks(&word.bytes, "an increment from a position that the program has not set");
                    return Err(finding.help("move this axis to an absolute position first").into());
                }
            });
        }
        Ok(end)
    }

    /// The known position, for a move that must start at one.
    pub(super) fn start(&self) -> Result<DVec3> {
        let [x, y, z] = self.modal.position;
        let (Some(x), Some(y), Some(z)) = (x, y, z) else {
            let missing: Vec<&str> =
                (0..3).filter(|i| self.modal.position[*i].is_none()).map(|i| AXES[i]).collect();
            let message = format!("a feed move starts where the program has not set {}", missing.join(", "));
            return Err(self.lacks(&self.here, &message).help("move there by a rapid first").into());
        };
        Ok(DVec3::new(x, y, z))
    }

    /// Speed of a feed move.
    pub(super) fn feed_speed(&mut self) -> Result<Speed> {
        let here = self.here.clone();
        match self.modal.feed.filter(|f| *f > 0.0) {
            Some(feed) => Ok(match self.modal.feed_mode {
                FeedMode::PerMinute => Speed::PerMinute(feed),
                FeedMode::PerRevolution => Speed::PerRevolution(feed),
                FeedMode::InverseTime => Speed::Duration(60.0 / feed),
            }),
            None => {
                let what = match self.modal.feed_mode {
                    FeedMode::InverseTime => "inverse time needs a feed (F) in each block",
                    _ if self.modal.feed.is_some() => "a feed move with feed zero",
                    _ => "a feed move without a feed (F)",
                };
                Err(self.answers(self.lacks(&here, what), 22).into())
            }
        }
    }

    pub(super) fn straight(&mut self, words: &mut [Word<'s>], speed: Speed) -> Result<()> {
        let end = self.end(words)?;
        if !matches!(speed, Speed::Rapid { .. }) && self.modal.position.iter().any(Option::is_none) {
            // Compensation leads into a contour, and out of it.
            if self.modal.comp != Comp::Off {
                self.start()?;
            }
            self.from_nowhere.push(self.place.span(&self.here));
        }
        let path = self.through_corner(end, Path::Line, speed)?;
        self.push_tip(end, path, speed);
        Ok(())
    }

    /// Appends a move of the tip.
    pub(super) fn push_tip(&mut self, end: [Option<f64>; 3], path: Path, speed: Speed) {
        let here = self.here.clone();
        if self.modal.offset.is_none() {
            let message = "no work offset before the first move: G54 is assumed";
            match self.has_one_offset() {
                true => self.note(message),
                false => self.warn(&here, message),
            }
        }
        if !self.modal.units_said {
            self.warn(&here, "no unit (inch or mm) before the first move: mm is assumed");
        }
        // Cycles stop by themselves.
        if !self.modal.blend_said && !matches!(speed, Speed::Rapid { .. }) {
            let what =
                "neither G60 nor G64 before the first move at feed: a stop after each block is assumed";
            self.note(what);
        }
        // The length that ended with the control of the tip is missed by a move of Z only.
        let waits = self.modal.rotary_axes.lapsed && end[2].is_none();
        self.flush(if waits { Kind::Other } else { Kind::Tip });
        if end[2].is_some() {
            self.modal.tool_item = None;
        }
        self.modal.position = end;
        let point = DVec3::from_array(self.mapped(end).map(|v| v.unwrap_or(f64::NAN)));
        let path = self.scaling.map.map_or(path, |map| map.path(path, self.modal.plane));
        self.note_feed(speed);
        let kept = self.modal.rotary_axes.kept();
        let axis = self.modal.rotary_axes.next.take().unwrap_or(kept);
        let motion = Move { end: Target::Tip { point, axis }, path };
        self.program.push_move(motion, &self.state(speed), self.origin);
    }

    fn machine_move(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        let speed = match self.modal.motion {
            Some(Code::Rapid) => Speed::Rapid { linear: self.dialect.straight_rapid },
            Some(Code::Feed) => self.feed_speed()?,
            _ => {
                let finding = self.lacks(bytes, "machine coordinates need G0 or G1");
                return Err(self.answers(finding, 30).into());
            }
        };
        if !self.modal.absolute {
            return Err(self
                .lacks(bytes, "machine coordinates as increments (G91)")
                .help("program G90")
                .into());
        }
        let mut joints = [None; 6];
        let mut machine = self.machine_place();
        for axis in 0..3 {
            if let Some(word) = take(words, AXES[axis]) {
                joints[axis] = Some(word.value * self.modal.length_unit);
                // It is the spindle that is there, and the tip below it.
                let tip =
                    joints[axis].zip(self.modal.tool_offsets[axis]).map(|(spindle, tool)| spindle - tool);
                machine[axis] = tip.map(Spot::machine);
                self.modal.position[axis] = None;
            }
        }
        let tilted = self.modal.rotary_axes.plane.is_some() || self.modal.rotary_axes.tcp != Tcp::Off;
        let plane = self.modal.rotary_axes.plane.take();
        let turned = self.rotary_end(words);
        self.modal.rotary_axes.plane = plane;
        for (joint, degrees) in joints[3..].iter_mut().zip(turned?) {
            *joint = degrees.map(f64::to_radians);
        }
        if tilted {
            self.modal.position = [None; 3];
        }
        if self.modal.turned.is_turned() && (joints[0].is_some() || joints[1].is_some()) {
            self.modal.position = [None, None, self.modal.position[2]];
        }
        if !tilted && self.modal.rotary_axes.rotaries.at.iter().all(|a| a.is_none_or(|a| a == 0.0)) {
            let place = self.place_of(machine);
            for (known, place) in self.modal.position.iter_mut().zip(place) {
                *known = known.or(place);
            }
        }
        if self.dialect.suspends_length && joints[2].is_some() && self.modal.tool.length.is_some() {
            let finding = self.lacks(
                bytes,
                "Z in machine coordinates while a tool length is active moves the tip, not the spindle",
            );
            return Err(finding.help("add D0 to the block").into());
        }
        self.flush(Kind::Other);
        let motion = Move { end: Target::Joints(joints), path: Path::Line };
        self.program.push_move(motion, &self.state(speed), self.origin);
        Ok(())
    }
}
