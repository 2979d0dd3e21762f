//! Tilted planes: `G68.2`, `G53.1`, `G69`, `CYCLE800`.
//!
//! The plane is given from the work offset, or within the plane in force (`CYCLE800` additive). No position is known in
//! it until the program sets one, and nothing moves in it before the tool stands along it. Where rotary axes turn
//! along a plane they do so in rapid, whatever motion is in force.
//!
//! `G68.2 P1` turns about the axes of the work offset, which stay fixed, in the order of Q (123 where it is left out):
//! as implementations that follow the manual do; noted.

use glam::{DMat3, DVec3};

use crate::base::Result;
use crate::geom::Rigid;
use crate::nc::dialect::{AXES, Code, OFFSETS, Plane};
use crate::nc::multi_axis::TiltWord;
use crate::nc::sinumerik::swivel;
use crate::nc::tilt::{self, XYZ, ZXZ};
use crate::program::{Comp, Frame, FrameId, Move, Path, RotarySolution, Speed, Target, Tcp, WorkOffset};

use super::block::{Call, Word};
use super::place::Bytes;
use super::reader::{Kind, Reader, take};
use super::rotary_state::Along;

impl<'s> Reader<'s> {
    /// Executes the words of a block that tilt the coordinates.
    pub(super) fn tilting(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let tilting = |c: Code| {
            matches!(c, Code::Tilt | Code::TiltByTool | Code::Orient | Code::Rotation { on: false })
        };
        let Some((code, bytes)) = self.code(tilting) else { return Ok(()) };
        match code {
            Code::Tilt => self.feature(words, &bytes),
            Code::TiltByTool => {
                let why = "a plane by the direction of the tool is not read: it depends on the machine";
                Err(self.place.not_understood(&bytes, why).into())
            }
            Code::Orient => self.along_feature(words, &bytes),
            _ => {
                self.end_plane();
                Ok(())
            }
        }
    }

    /// Refuses the codes that the control does not take in a tilted plane.
    pub(super) fn check_plane(&self) -> Result<()> {
        if self.modal.rotary_axes.plane.is_none() {
            return Ok(());
        }
        let ends = self.code(|c| c == Code::Rotation { on: false }).is_some();
        let forbidden = |c: Code| match c {
            Code::Tilt | Code::TiltByTool | Code::TipControl { .. } | Code::ToolChange => !ends,
            Code::LocalShift | Code::Rotation { on: true } | Code::SetData => !ends,
            Code::Plane(plane) => plane != Plane::Xy,
            Code::Work(offset) => !ends && self.modal.offset != Some(offset),
            _ => false,
        };
        match self.code(forbidden) {
            Some((_, bytes)) => {
                let message = format!("`{}`: not in a tilted plane", self.place.shown(&bytes));
                let end = match self.dialect.axes.tilt {
                    TiltWord::Swivel => "CYCLE800()",
                    _ => "G69",
                };
                Err(self.lacks(&bytes, &message).help(format!("program {end} first")).into())
            }
            None => Ok(()),
        }
    }

    /// Refuses a move in a plane along which the tool does not stand.
    pub(super) fn check_along(&self) -> Result<()> {
        let Some((_, rotation)) = self.modal.rotary_axes.plane else { return Ok(()) };
        let offset = self.modal.offset.unwrap_or(WorkOffset::G54);
        if self.modal.rotary_axes.along.is_some_and(|a| a.offset == offset && a.rotation == rotation) {
            return Ok(());
        }
        let help = match self.dialect.axes.tilt {
            TiltWord::Swivel => "program CYCLE800 with _DIR -1 or 1",
            _ => "program G53.1 after G68.2",
        };
        let message = "a move in a tilted plane along which the tool was not turned";
        Err(self.lacks(&self.here, message).help(help).into())
    }

    /// A plane begins: its motion within `parent`, and that one's rotation into the work offset.
    fn begin_plane(&mut self, parent: FrameId, outer: DMat3, motion: Rigid, branch: RotarySolution) {
        let rotation = outer * motion.rotation;
        let offset = self.modal.offset.unwrap_or(WorkOffset::G54);
        // Said again while the tool stands along it: the choice was made.
        let branch = match self.modal.rotary_axes.along {
            Some(a) if branch == RotarySolution::Free && a.offset == offset && a.rotation == rotation => {
                a.branch
            }
            _ => branch,
        };
        let frame = self.program.add_frame(Frame::Tilted { parent, motion, branch });
        self.modal.rotary_axes.plane = Some((frame, rotation));
        self.enter_plane();
    }

    fn enter_plane(&mut self) {
        self.modal.sticky.end();
        self.set_frame();
        self.modal.position = [None; 3];
        self.modal.cubic_end = None;
    }

    fn end_plane(&mut self) {
        if self.modal.rotary_axes.plane.take().is_some() {
            self.enter_plane();
        }
    }

    /// The rotary axes turn along the plane in force.
    fn turn_along(&mut self, branch: RotarySolution) {
        let Some((frame, rotation)) = self.modal.rotary_axes.plane else { return };
        if let Some(Frame::Tilted { parent, motion, .. }) = self.program.frames.get(frame.0 as usize).copied()
        {
            let frame = self.program.add_frame(Frame::Tilted { parent, motion, branch });
            self.modal.rotary_axes.plane = Some((frame, rotation));
        }
        let offset = self.modal.offset.unwrap_or(WorkOffset::G54);
        self.modal.rotary_axes.swing(Some(Along { offset, rotation, branch }));
        self.enter_plane();
        self.flush(Kind::Other);
        let motion = Move { end: Target::Orient, path: Path::Line };
        let speed = Speed::Rapid { linear: self.dialect.straight_rapid };
        self.program.push_move(motion, &self.state(speed), self.origin);
    }

    /// G68.2.
    fn feature(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        if self.modal.rotary_axes.tcp != Tcp::Off {
            let finding = self.lacks(bytes, "a tilted plane under control of the tool centre point");
            return Err(finding.help("program G49 first").into());
        }
        if self.modal.turned.motion != Rigid::IDENTITY {
            let finding = self.lacks(bytes, "a tilted plane in shifted or turned coordinates");
            return Err(finding.help("take G52 and G68 back first").into());
        }
        if self.modal.plane != Plane::Xy {
            return Err(self.place.not_understood(bytes, "tilted planes are read in G17 only").into());
        }
        let kind = take(words, "P");
        let said = kind.as_ref().map(|p| p.bytes.clone());
        let order = take(words, "Q");
        let unit = self.modal.length_unit;
        let translation = AXES.map(|name| take(words, name).map_or(0.0, |v| v.value * unit));
        let angles = OFFSETS.map(|name| take(words, name).map_or(0.0, |v| v.value));
        let rotation = match kind.as_ref().map_or(Ok(0), |p| self.count(p, "the kind of a plane"))? {
            0 => tilt::turning(ZXZ, angles),
            1 => {
                let digits = order.as_ref().map_or(Ok(123), |q| self.count(q, "an order of axes"))?;
                let axes = [digits / 100, digits / 10 % 10, digits % 10].map(|d| d.wrapping_sub(1) as usize);
                let mut sorted = axes;
                sorted.sort_unstable();
                if sorted != XYZ {
                    let place = order.map_or(bytes.clone(), |q| q.bytes);
                    return Err(self.place.malformed(&place, "an order of axes names 1, 2 and 3").into());
                }
                self.note(
                    "G68.2 P1 is read as rotations about the axes of the work offset, which stand still; not checked against a manual",
                );
                tilt::standing(axes, angles)
            }
            kind => {
                let why = match kind {
                    2 => "a plane by three points is not read",
                    3 => "a plane by two vectors is not read",
                    4 => "a plane by projected angles is not read",
                    _ => "this kind of plane is not known",
                };
                let place = said.unwrap_or_else(|| bytes.clone());
                return Err(self.place.not_understood(&place, why).into());
            }
        };
        let parent = self.modal.frame;
        let motion = Rigid { rotation, translation: DVec3::from_array(translation) };
        self.begin_plane(parent, DMat3::IDENTITY, motion, RotarySolution::Free);
        Ok(())
    }

    /// G53.1.
    fn along_feature(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        if self.modal.rotary_axes.plane.is_none() {
            let finding = self.lacks(bytes, "the tool is turned along a plane, but there is none");
            return Err(finding.help("program G68.2 first").into());
        }
        let choice = match take(words, "P") {
            Some(p) => match self.count(&p, "the choice of a solution")? {
                0 => RotarySolution::Free,
                1 => RotarySolution::Positive,
                2 => RotarySolution::Negative,
                _ => return Err(self.place.not_understood(&p.bytes, "solutions are P0 to P2").into()),
            },
            None => RotarySolution::Free,
        };
        self.turn_along(choice);
        Ok(())
    }

    /// CYCLE800.
    pub(super) fn swivel(&mut self, call: &Call<'s>) -> Result<()> {
        let here = call.bytes.clone();
        if self.modal.comp != Comp::Off {
            return Err(self.while_on(&here).into());
        }
        let read = swivel::read(&call.arguments, call.text).map_err(|(place, why)| {
            let bytes = call.places.get(place).unwrap_or(&call.bytes);
            self.place.not_understood(bytes, &format!("CYCLE800: {why}"))
        })?;
        if self.modal.turned.motion != Rigid::IDENTITY {
            let finding = self.lacks(&here, "CYCLE800 in shifted or turned coordinates");
            return Err(finding.help("take them back first (TRANS)").into());
        }
        let Some(swivel) = read else {
            self.end_plane();
            return Ok(());
        };
        if self.modal.rotary_axes.tcp != Tcp::Off {
            let finding = self.lacks(&here, "a tilted plane under control of the tool centre point");
            return Err(finding.help("program TRAFOOF first").into());
        }
        if self.modal.plane != Plane::Xy {
            return Err(self.place.not_understood(&here, "tilted planes are read in G17 only").into());
        }
        if swivel.withdraws {
            self.warn(
                &here,
                "CYCLE800 withdraws the tool before it swivels (_FR) to a place of the machine's data: not followed",
            );
        }
        let unit = self.modal.length_unit;
        let length = |v: [f64; 3]| DVec3::from_array(v) * unit;
        let rotation = tilt::turning(swivel.order, swivel.angles);
        let translation = length(swivel.point) + rotation * length(swivel.shift);
        let (parent, outer) = match self.modal.rotary_axes.plane {
            Some(plane) if swivel.add => plane,
            _ => {
                let offset = self.modal.offset.unwrap_or(WorkOffset::G54);
                (self.program.add_frame(Frame::Work(offset)), DMat3::IDENTITY)
            }
        };
        let branch = swivel.turn.unwrap_or_default();
        self.begin_plane(parent, outer, Rigid { rotation, translation }, branch);
        if swivel.turn.is_some() {
            self.turn_along(branch);
        }
        Ok(())
    }
}
