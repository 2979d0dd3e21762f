//! Shifted and turned coordinates: `G52`, `G68`, `G69`, `G10 L2 R`, `TRANS`, `ATRANS`, `ROT`, `AROT`.
//!
//! About Z only. The present place is given in the new coordinates, so that an increment or a coordinate that is left out
//! counts in them; where only one of X and Y was known and the coordinates turn, neither is known then.
//!
//! - SINUMERIK: `TRANS` and `ROT` replace all that was shifted and turned, `ATRANS` and `AROT` go on from it, `TRANS` or
//!   `ROT` alone take all back; a change of work offset keeps it. Whether an increment right after them travels the shift
//!   too is setting data 42440: those increments are refused.
//! - FANUC: `G52` shifts all work offsets, with the coordinates that it names; `G68` turns about a centre in these
//!   coordinates, or about the present place. In a rotation there is no `G52`, `G53` to `G59` and no change of plane; a
//!   further `G68` is read about the same centre only, where it cannot mean two things. `R` in `G91` counts from the angle
//!   in force where parameter 5400 RIN says so: it is read where none is in force.
//! - LinuxCNC: `G10 L2 P R` turns a work offset about its zero and stays beyond the program; `G52` shifts in the turned
//!   coordinates. `G10` is next door.

use glam::{DVec2, DVec3};

use crate::base::Result;
use crate::geom::Rigid;
use crate::nc::dialect::{AXES, Code, Plane, TurnWord};
use crate::nc::turn;
use crate::program::{Frame, WorkOffset};

use super::block::Word;
use super::place::Bytes;
use super::reader::{Reader, Value, take};

/// Distance within which two centres of rotation are the same [mm]: rounding of decimal numbers.
const SAME: f64 = 1e-9;

impl<'s> Reader<'s> {
    /// Executes the words of a block that shift or turn the coordinates.
    pub(super) fn turning(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let turning = |c: Code| {
            matches!(
                c,
                Code::Rotation { .. }
                    | Code::LocalShift
                    | Code::SetData
                    | Code::FrameShift { .. }
                    | Code::FrameTurn { .. }
            )
        };
        let Some((code, bytes)) = self.code(turning) else { return Ok(()) };
        if self.code(|c| turning(c) && c != code).is_some() {
            return Err(self.lacks(&bytes, "a shift and a rotation stand in blocks of their own").into());
        }
        if self.modal.modal_call.is_some() {
            let finding =
                self.lacks(&bytes, "the coordinates change while a cycle is called after each block");
            return Err(finding.help("end it first (MCALL)").into());
        }
        match code {
            Code::Rotation { on: false } => self.modal.turned.degrees = 0.0,
            Code::Rotation { on: true } => self.rotation(words, &bytes)?,
            Code::LocalShift => self.local_shift(words, &bytes)?,
            Code::SetData => self.set_data(words, &bytes)?,
            Code::FrameShift { add } => self.frame_shift(words, add, &bytes)?,
            Code::FrameTurn { add } => self.frame_turn(words, add, &bytes)?,
            _ => {}
        }
        if code == (Code::Rotation { on: false }) {
            self.modal.turned.centre = DVec2::ZERO;
        }
        self.modal.sticky.end();
        self.set_frame();
        Ok(())
    }

    /// Refuses the codes that the control does not take in a rotation.
    pub(super) fn check_rotation(&self) -> Result<()> {
        if self.dialect.turn != TurnWord::Local || self.modal.turned.degrees == 0.0 {
            return Ok(());
        }
        let ends = self.code(|c| c == Code::Rotation { on: false }).is_some();
        let forbidden = |c: Code| match c {
            Code::MachineFrame | Code::Reference | Code::FurtherReference => !ends,
            Code::Work(_) | Code::LocalShift => !ends,
            Code::Plane(plane) => plane != Plane::Xy,
            _ => false,
        };
        match self.code(forbidden) {
            Some((_, bytes)) => {
                let message = format!("`{}`: not while the coordinates are turned", self.place.shown(&bytes));
                Err(self.lacks(&bytes, &message).help("program G69 first").into())
            }
            None => Ok(()),
        }
    }

    /// Gives the state and the place in the coordinates in force.
    pub(super) fn set_frame(&mut self) {
        let offset = self.modal.offset.unwrap_or(WorkOffset::G54);
        let parent = match self.modal.rotary_axes.plane {
            Some((plane, _)) => plane,
            None => self.program.add_frame(Frame::Work(offset)),
        };
        let motion = self.modal.turned.motion_of(self.dialect.turn, offset);
        let before = std::mem::replace(&mut self.modal.turned.motion, motion);
        self.modal.frame = match motion == Rigid::IDENTITY {
            true => parent,
            false => self.program.add_frame(Frame::Shift { parent, motion }),
        };
        if before == motion {
            return;
        }
        let place = turn::restated(self.mapped(self.modal.position), &before, &motion);
        self.modal.position = self.programmed(place);
        let raised = before.translation.z != motion.translation.z;
        self.modal.turned.fresh = [true, true, raised];
        self.modal.cubic_end = None;
    }

    /// A rotation is in the plane XY.
    fn in_plane(&self, bytes: &Bytes) -> Result<()> {
        if self.modal.plane == Plane::Xy {
            return Ok(());
        }
        Err(self.place.not_understood(bytes, "rotations are read in G17 only").into())
    }

    fn rotation(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        self.in_plane(bytes)?;
        let unit = self.modal.length_unit;
        let [x, y] = [take(words, AXES[0]), take(words, AXES[1])].map(|w| w.map(|v| v.value * unit));
        let Some(angle) = take(words, "R") else {
            let finding =
                self.lacks(bytes, "a rotation without its angle: parameter 5410 of the machine would count");
            return Err(finding.help("program R").into());
        };
        let degrees = self.modal.turned.degrees;
        if degrees != 0.0 && !self.modal.absolute {
            let finding = self.lacks(
                &angle.bytes,
                "whether an angle in G91 counts from the rotation in force is a parameter of the machine (5400 RIN)",
            );
            return Err(finding.help("program G69 first, or G90").into());
        }
        let [mapped_x, mapped_y, _] = self.mapped([x, y, None]);
        let centre = match (mapped_x, mapped_y, self.mapped(self.modal.position)) {
            (Some(x), Some(y), _) => DVec2::new(x, y),
            (None, None, [Some(x), Some(y), _]) if degrees == 0.0 => {
                if self.dialect.haas {
                    let message = "a rotation without X and Y is about the present position, or by another reading about the zero of the work";
                    self.warn(bytes, message);
                }
                DVec2::new(x, y)
            }
            (None, None, _) if degrees == 0.0 => {
                let finding =
                    self.lacks(bytes, "a rotation about the present place, which the program has not set");
                return Err(finding.help("program X and Y of the centre").into());
            }
            (None, None, _) => self.modal.turned.centre,
            _ => return Err(self.lacks(bytes, "the centre of a rotation needs both X and Y").into()),
        };
        if degrees != 0.0 && (centre - self.modal.turned.centre).length() > SAME {
            let finding = self.lacks(bytes, "a rotation about another centre within a rotation");
            return Err(finding.help("program G69 first").into());
        }
        self.modal.turned.centre = centre;
        let mirrored = self.scaling.map.is_some_and(|map| map.mirrors(Plane::Xy));
        self.modal.turned.degrees = if mirrored { -angle.value } else { angle.value };
        Ok(())
    }

    fn local_shift(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        // LinuxCNC sets it in G91 too.
        if !self.modal.absolute && self.dialect.turn != TurnWord::Offset {
            let finding = self.lacks(bytes, "a local shift (G52) as increments (G91)");
            return Err(finding.help("program G90").into());
        }
        let named = self.lengths(words);
        if named == [None; 3] {
            return Err(self.lacks(bytes, "a local shift without an axis").into());
        }
        let shift = &mut self.modal.turned.shift;
        for (axis, value) in named.into_iter().enumerate() {
            shift[axis] = value.unwrap_or(shift[axis]);
        }
        (self.stored_shift, self.shift_said) = (self.modal.turned.shift, Some(true));
        Ok(())
    }

    fn frame_shift(&mut self, words: &mut [Word<'s>], add: bool, bytes: &Bytes) -> Result<()> {
        self.alone(bytes)?;
        let named = self.lengths(words);
        let by = DVec3::from_array(named.map(|v| v.unwrap_or(0.0)));
        let turned = &mut self.modal.turned;
        if add {
            if named == [None; 3] {
                return Err(self.lacks(bytes, "a further shift without an axis").into());
            }
            turned.shift += turn::rotation(turned.degrees) * by;
        } else {
            (turned.shift, turned.degrees) = (by, 0.0);
        }
        Ok(())
    }

    fn frame_turn(&mut self, words: &mut [Word<'s>], add: bool, bytes: &Bytes) -> Result<()> {
        self.alone(bytes)?;
        let tilts: Vec<Value> =
            [AXES[0], AXES[1]].iter().filter_map(|a| take(words, a)).filter(|v| v.value != 0.0).collect();
        if let Some(tilt) = tilts.first() {
            return Err(self.place.not_understood(&tilt.bytes, "rotations about Z only are read").into());
        }
        let (about_z, in_plane) = (take(words, AXES[2]), take(words, "RPL"));
        if in_plane.is_some() {
            self.in_plane(bytes)?;
        }
        let angle = match (about_z, in_plane) {
            (Some(_), Some(second)) => return Err(self.twice(&second.bytes).into()),
            (Some(angle), None) | (None, Some(angle)) => angle.value,
            (None, None) if add => {
                return Err(self.lacks(bytes, "a further rotation without an angle").into());
            }
            (None, None) => 0.0,
        };
        let turned = &mut self.modal.turned;
        if add {
            turned.degrees += angle;
        } else {
            (turned.shift, turned.degrees) = (DVec3::ZERO, angle);
        }
        Ok(())
    }

    /// `TRANS` and its like are in blocks of their own.
    fn alone(&self, bytes: &Bytes) -> Result<()> {
        if self.codes.len() == 1 {
            return Ok(());
        }
        Err(self.lacks(bytes, "a shift or rotation of the coordinates stands in a block of its own").into())
    }

    /// The lengths that a block names [mm].
    pub(super) fn lengths(&self, words: &mut [Word<'s>]) -> [Option<f64>; 3] {
        AXES.map(|axis| take(words, axis).map(|v| v.value * self.modal.length_unit))
    }
}
