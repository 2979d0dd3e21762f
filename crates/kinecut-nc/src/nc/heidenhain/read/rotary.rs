//! Rotary axes and tool directions: `L A B C`, `LN TX TY TZ`, `M128` and `FUNCTION TCPM`.
//!
//! Without control of the tool centre point the coordinates are positions of the linear axes. A block that names rotary
//! axes only leaves the linear ones where they are; in a tilted plane it is a move of the machine's axes. A block without
//! a word for the tool axis leaves it where it is.
//!
//! Angles are positions. `M126` lets an axis that counts from 0 to 360 degrees take the shorter way: a step of more than
//! half a turn is then refused, all others are the same on every machine.

use glam::DVec3;

use crate::base::Result;
use crate::nc::heidenhain::TOOL_VECTOR;
use crate::nc::multi_axis::ROTARY;
use crate::nc::read::place::Bytes;
use crate::program::{Move, Path, Speed, Target, Tcp, ToolAxis};

use super::Reader;
use super::motion::has_axis;
use super::statement::Word;

/// Increments of rotary axes.
const MORE: [&str; 3] = ["IA", "IB", "IC"];
/// Surface normals, for 3D compensation.
const NORMAL: [&str; 3] = ["NX", "NY", "NZ"];
/// Largest deviation of the length of a tool direction from 1: what four decimals of its components leave.
const UNIT: f64 = 1e-3;
/// Half a turn [deg], with the rounding of decimal fractions.
const HALF: f64 = 180.0 + 1e-9;

impl<'s> Reader<'s> {
    /// The rotary axes that a block names [rad].
    pub(super) fn rotary(&mut self, words: &mut [Word<'s>]) -> Result<[Option<f64>; 3]> {
        let mut said = [None; 3];
        for axis in 0..3 {
            let known = self.modal.rotaries.at[axis];
            let (degrees, bytes) = match (self.take(words, ROTARY[axis])?, self.take(words, MORE[axis])?) {
                (None, None) => continue,
                (Some((value, bytes)), None) => (value, bytes),
                (None, Some((value, bytes))) => match known {
                    Some(before) => (before + value, bytes),
                    None => {
                        let message = "an increment from a position that the program has not set";
                        let finding = self.lacks(&bytes, message);
                        return Err(finding.help("move this axis to an absolute position first").into());
                    }
                },
                (Some(_), Some((_, bytes))) => return Err(self.twice(&bytes).into()),
            };
            let step = known.map_or(0.0, |before| (degrees - before).abs());
            if self.modal.shorter && step > HALF {
                let why = "M126 is on: which way a step of more than half a turn goes depends on the machine";
                let finding = self.place.not_understood(&bytes, why);
                return Err(finding
                    .value(step, "deg")
                    .bound(180.0, "deg")
                    .help("program M127, or a smaller step")
                    .into());
            }
            self.modal.rotaries.set(axis, degrees);
            said[axis] = Some(degrees.to_radians());
        }
        Ok(said)
    }

    /// Whether the tool stands along Z because no rotary axis is away from zero.
    pub(super) fn upright(&self) -> bool {
        self.modal.rotaries.upright(|degrees| degrees % 360.0 == 0.0)
    }

    /// The tool axis of a block that does not name it.
    pub(super) fn kept_axis(&self) -> ToolAxis {
        if self.modal.tilt.is_some() || self.upright() {
            ToolAxis::Fixed
        } else {
            ToolAxis::Rotary([None; 3])
        }
    }

    /// A straight block that names rotary axes.
    pub(super) fn turning(
        &mut self,
        words: &mut [Word<'s>],
        said: [Option<f64>; 3],
        speed: Option<Speed>,
    ) -> Result<()> {
        self.uncompensated("a rotary axis moves")?;
        let speed = self.known_speed(speed)?;
        let linear = has_axis(words);
        let known = self.modal.position.iter().all(Option::is_some);
        let alone = !linear && self.modal.tcp == Tcp::Off;
        if self.modal.tilt.is_some() || alone && !known {
            if linear {
                let why = "linear and rotary axes move together in a tilted plane: where they go is not read";
                let finding = self.place.not_understood(&self.here, why);
                return Err(finding.help("turn the rotary axes in a block of their own").into());
            }
            let [a, b, c] = said;
            if self.modal.tilt.is_some() {
                self.unplace();
            }
            self.modal.direction = None;
            let motion = Move { end: Target::Joints([None, None, None, a, b, c]), path: Path::Line };
            self.program.push_move(motion, &self.state(speed), self.origin);
            return Ok(());
        }
        let end = self.end(words)?;
        if !matches!(speed, Speed::Rapid { .. }) {
            self.start()?;
        }
        self.modal.direction = None;
        self.push_axis(end, ToolAxis::Rotary(said), Path::Line, speed);
        Ok(())
    }

    /// `LN`: a straight block with the direction of the tool axis, or of the surface.
    pub(super) fn vector_line(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let functions = self.before(words)?;
        let speed = self.speed(words)?;
        let before = self.modal.comp;
        self.side(words)?;
        self.uncompensated("a block with vectors comes")?;
        self.switched(before, None)?;
        if let Some(bytes) = functions.machine.as_ref().or(functions.retract.as_ref()) {
            return Err(self.twice(bytes).into());
        }
        if self.vector(words, NORMAL)?.is_some() {
            self.note(
                "surface normals (NX, NY, NZ) are not followed: they only compensate a tool's allowance",
            );
        }
        let tool = self.vector(words, TOOL_VECTOR)?;
        if let (Some((_, bytes)), Tcp::Off) = (&tool, self.modal.tcp) {
            let finding = self.lacks(bytes, "a tool direction without control of the tool centre point");
            return Err(finding.help("switch it on (M128, FUNCTION TCPM) first").into());
        }
        let speed = self.known_speed(speed)?;
        if !has_axis(words) {
            return Err(self.lacks(&self.here, "a block with vectors names X, Y and Z").into());
        }
        let end = self.end(words)?;
        if !matches!(speed, Speed::Rapid { .. }) {
            self.start()?;
        }
        self.modal.direction = None;
        let axis = match tool {
            Some((direction, _)) => {
                self.modal.rotaries.swing();
                ToolAxis::Vector(direction)
            }
            None => self.kept_axis(),
        };
        self.push_axis(end, axis, Path::Line, speed);
        self.after(functions)
    }

    /// A direction of three components, all or none.
    fn vector(&self, words: &mut [Word<'s>], names: [&str; 3]) -> Result<Option<(DVec3, Bytes)>> {
        let mut found = [0.0; 3];
        let mut at: Option<Bytes> = None;
        let mut count = 0;
        for (value, name) in found.iter_mut().zip(names) {
            if let Some((number, bytes)) = self.take(words, name)? {
                *value = number;
                at = Some(at.map_or(bytes.start, |b| b.start)..bytes.end).map(|b| b.start.min(b.end)..b.end);
                count += 1;
            }
        }
        let Some(bytes) = at else { return Ok(None) };
        if count != 3 {
            let message = format!("a direction needs {}, {} and {}", names[0], names[1], names[2]);
            return Err(self.lacks(&bytes, &message).into());
        }
        let vector = DVec3::from_array(found);
        let length = vector.length();
        match vector.try_normalize() {
            Some(unit) if (length - 1.0).abs() <= UNIT => Ok(Some((unit, bytes))),
            _ => {
                let finding = self.place.malformed(&bytes, "a direction is a vector of length 1");
                Err(finding.value(length, "").bound(1.0, "").into())
            }
        }
    }

    /// `FUNCTION TCPM ..` and `FUNCTION RESET TCPM`.
    pub(super) fn function(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let named = |at: usize, name: &str| words.get(at).is_some_and(|w| w.is(name));
        let unknown = self.place.not_understood(&self.here, "this function is not read yet");
        if named(1, "RESET") && named(2, "TCPM") {
            words[1].used = true;
            words[2].used = true;
            return self.control_tip(Tcp::Off);
        }
        if !named(1, "TCPM") {
            return Err(unknown.into());
        }
        words[1].used = true;
        let mut path = None;
        let mut at = 2;
        while let Some(word) = words.get(at).filter(|w| !w.is("F") || w.value.is_none()) {
            let (next, bytes) =
                (words.get(at + 1).map_or("", |w| w.name).to_ascii_uppercase(), word.bytes.clone());
            let refused = match (word.name.to_ascii_uppercase().as_str(), next.as_str()) {
                ("F", "TCP") | ("AXIS", "POS") => None,
                ("F", "CONT") => {
                    self.note("FUNCTION TCPM F CONT is not followed: the feed is read as that of the tip");
                    None
                }
                ("AXIS", "SPAT") => {
                    Some("angles of rotary axes as spatial angles are not read: use AXIS POS")
                }
                ("PATHCTRL", "AXIS") => path.replace(Tcp::Axes).map(|_| "the path is said twice"),
                ("PATHCTRL", "VECTOR") => path.replace(Tcp::Vector).map(|_| "the path is said twice"),
                ("REFPNT", "TIP") if named_at(words, at + 2, "TIP") => {
                    words[at + 2].used = true;
                    None
                }
                ("REFPNT", _) => Some("the tool is guided by its tip only (REFPNT TIP-TIP)"),
                _ => Some("this part of TCPM is not known"),
            };
            if let Some(why) = refused {
                return Err(self.place.not_understood(&bytes, why).into());
            }
            at += 2 + usize::from(words[at].is("REFPNT"));
            for word in words.iter_mut().take(at) {
                word.used = true;
            }
        }
        // A limit of the compensating moves.
        self.take(words, "F")?;
        let Some(path) = path else {
            return Err(self.lacks(&self.here, "FUNCTION TCPM without PATHCTRL").into());
        };
        self.control_tip(path)
    }

    /// Switches the control of the tool centre point.
    pub(super) fn control_tip(&mut self, tcp: Tcp) -> Result<()> {
        if self.modal.tcp == tcp {
            return Ok(());
        }
        self.uncompensated("control of the tool centre point is switched")?;
        if self.modal.tilt.is_some() && tcp != Tcp::Off {
            let why = "control of the tool centre point within a tilted plane is not read";
            return Err(self.place.not_understood(&self.here, why).help("take the plane back first").into());
        }
        self.modal.tcp = tcp;
        if !self.upright() {
            // Positions of the axes are now positions of the tip, or the other way round.
            self.unplace();
        }
        Ok(())
    }
}

fn named_at(words: &[Word<'_>], at: usize, name: &str) -> bool {
    words.get(at).is_some_and(|w| w.is(name))
}
