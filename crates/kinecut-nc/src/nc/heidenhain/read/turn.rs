//! Datum shift and rotation: `CYCL DEF 7` and `CYCL DEF 10`.
//!
//! The shift is that of the preset, the rotation is about the shifted datum. A shift that is said within a rotation may
//! count in the turned coordinates: that program is refused as soon as it moves, but taking the shift back before the
//! rotation is not.

use glam::DVec3;

use crate::base::Result;
use crate::geom::Rigid;
use crate::nc::dialect::{AXES, TurnWord};
use crate::nc::turn;
use crate::program::{Frame, WorkOffset};

use super::Reader;
use super::motion::INCREMENTS;
use super::plane::Tilt;
use super::statement::Word;

impl<'s> Reader<'s> {
    /// `CYCL DEF 7.1 X+10`: the zero of the coordinates, relative to the preset.
    pub(super) fn shift(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        // Within a plane that lies at the datum of the preset only one shift can be meant.
        let within =
            self.modal.tilt.is_some() && self.modal.shift == [0.0; 3] && self.modal.uncertain.is_none();
        let before = if within { self.modal.inner } else { self.modal.shift };
        let mut shift = before;
        for (axis, (name, more)) in AXES.into_iter().zip(INCREMENTS).enumerate() {
            if let Some((value, _)) = self.take(words, name)? {
                shift[axis] = value * self.modal.unit;
            }
            if let Some((value, _)) = self.take(words, more)? {
                shift[axis] += value * self.modal.unit;
            }
        }
        let doubtful = self.modal.degrees != 0.0 || self.modal.tilt.is_some() && !within;
        if doubtful && shift != before {
            self.modal.uncertain = Some(self.here.clone());
        }
        *(if within { &mut self.modal.inner } else { &mut self.modal.shift }) = shift;
        self.set_frame();
        Ok(())
    }

    /// `CYCL DEF 10.1 ROT+30`, `IROT+5`.
    pub(super) fn rotation(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        match (self.take(words, "ROT")?, self.take(words, "IROT")?) {
            (Some((angle, _)), None) => self.modal.degrees = angle,
            (None, Some((angle, _))) => self.modal.degrees += angle,
            (Some(_), Some((_, bytes))) => return Err(self.twice(&bytes).into()),
            (None, None) => return Err(self.lacks(&self.here, "a rotation without its angle ROT").into()),
        }
        if self.modal.degrees == 0.0 && self.modal.tilt.is_none() {
            self.modal.uncertain = None;
        }
        self.set_frame();
        Ok(())
    }

    /// `TRANS ROTATION ROT+30`, `TRANS DATUM AXIS X Y Z` and their `RESET`, the newer words for the same (from memory). A
    /// shift is read with all three axes: whether one that is not named keeps its own is not certain.
    pub(super) fn transformation(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let unknown = self.place.not_understood(&self.here, "this transformation is not read yet");
        let [_, kind, rest @ ..] = words else { return Err(unknown.into()) };
        kind.used = true;
        let reset = matches!(rest, [only] if only.is("RESET"));
        if reset {
            rest[0].used = true;
        }
        if kind.is("ROTATION") {
            self.uncompensated("the coordinates are turned")?;
            if !reset {
                return self.rotation(words);
            }
            self.modal.degrees = 0.0;
            if self.modal.tilt.is_none() {
                self.modal.uncertain = None;
            }
        } else if kind.is("DATUM") && reset {
            self.uncompensated("the datum is moved")?;
            if self.modal.tilt.is_some() && self.modal.shift != [0.0; 3] {
                self.modal.uncertain = Some(self.here.clone());
            }
            self.modal.shift = [0.0; 3];
            self.modal.inner = [0.0; 3];
        } else if kind.is("DATUM")
            && rest.first().is_some_and(|w| w.is("AXIS"))
            && AXES.iter().all(|a| rest.iter().any(|w| w.is(a)))
        {
            rest[0].used = true;
            self.uncompensated("the datum is moved")?;
            return self.shift(words);
        } else {
            return Err(unknown.into());
        }
        self.set_frame();
        Ok(())
    }

    /// Gives the state and the place in the coordinates in force.
    pub(super) fn set_frame(&mut self) {
        let parent = Frame::Work(self.modal.offset.unwrap_or(WorkOffset::G54));
        let parent = self.program.add_frame(parent);
        let shift = DVec3::from_array(self.modal.shift);
        let (parent, shift) = match self.modal.tilt {
            None => (parent, shift),
            Some(Tilt { rotation, branch }) => {
                let motion = Rigid { rotation, translation: shift };
                let tilted = self.program.add_frame(Frame::Tilted { parent, motion, branch });
                (tilted, DVec3::from_array(self.modal.inner))
            }
        };
        let motion = turn::motion(TurnWord::Cycles, shift, self.modal.degrees);
        let before = std::mem::replace(&mut self.modal.motion, motion);
        self.modal.frame = match motion == Rigid::IDENTITY {
            true => parent,
            false => self.program.add_frame(Frame::Shift { parent, motion }),
        };
        if before == motion {
            return;
        }
        self.modal.position = turn::restated(self.modal.position, &before, &motion);
        self.modal.direction = None;
        // Whether a pole moves with the coordinates is not known for certain.
        self.modal.pole = None;
    }

    /// Refuses to move where shift and rotation may follow one another in two ways.
    pub(super) fn unambiguous(&self) -> Result<()> {
        match &self.modal.uncertain {
            Some(bytes) if self.modal.tilt.is_some() || self.modal.shift != [0.0; 3] => {
                let why = "shift, rotation and plane are said in an order in which it is not certain which of them counts \
                           in which coordinates";
                let finding = self.place.not_understood(bytes, why);
                let help =
                    "take them back in the reverse order: rotation (ROT+0), plane (PLANE RESET), shift";
                Err(finding.help(help).into())
            }
            _ => Ok(()),
        }
    }
}
