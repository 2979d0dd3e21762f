//! Words of cutter compensation, in the block of the straight move on which it is switched on or off.
//!
//! Refused, as by the controls: a switch on anything but a straight move in XY (LinuxCNC enters on an arc too), and a change of side, register, tool,
//! work offset, plane or to machine coordinates while it is on.

use glam::DVec3;

use crate::base::{Code, Finding, Result};
use crate::nc::dialect::{CompWord, Plane};
use crate::program::{Comp, Move, Path, State};

use super::{Writer, unsupported};

/// Cosine between the axis of an arc and Z from which they are parallel: rounding of unit vectors.
const LEVEL: f64 = 1.0 - 1e-9;

impl Writer<'_> {
    /// Refuses an entry on an arc of which several blocks became: the control enters on the first alone.
    pub(super) fn entered_in_one_block(&self, motion: &Move, enters: bool, before: usize) -> Result<()> {
        if !enters || motion.path == Path::Line || self.page.len() == before + 1 {
            return Ok(());
        }
        Err(refused("a compensation is switched on an arc that does not fit into one block")
            .help("enter by a straight move")
            .into())
    }

    /// The words before a move to `point`, where its state switches the compensation.
    pub(super) fn compensation(&mut self, motion: &Move, point: DVec3, state: &State) -> Result<()> {
        let before = self.modal.comp.unwrap_or(Comp::Off);
        if state.comp == before {
            return Ok(());
        }
        let word = match (before, state.comp) {
            (_, Comp::Off) => "G40".to_owned(),
            (Comp::Off, Comp::Left(register)) => self.switch_on("G41", register)?,
            (Comp::Off, Comp::Right(register)) => self.switch_on("G42", register)?,
            _ => {
                return Err(refused("the side or register of a compensation changes while it is on")
                    .help("switch it off on a straight move first")
                    .into());
            }
        };
        let mut moves = false;
        for (axis, value) in [point.x, point.y].into_iter().enumerate() {
            let Some(written) = self.place.written[axis] else {
                return Err(refused("a compensation is switched where the position is not known")
                    .help("move to X and Y first")
                    .into());
            };
            moves |= !value.is_nan() && self.grid.round(value)? != written;
        }
        // LinuxCNC enters on an arc too.
        let on_arc = state.comp != Comp::Off && self.dialect.comp == CompWord::Register;
        let straight = match motion.path {
            Path::Line => true,
            Path::Arc { axis, .. } => on_arc && axis.z.abs() >= LEVEL,
            _ => false,
        };
        if !straight || !moves {
            return Err(refused("a compensation is switched on a move that is not straight in the plane")
                .help("enter and leave by straight moves in XY")
                .into());
        }
        self.modal.comp = Some(state.comp).filter(|c| *c != Comp::Off);
        let word = match self.dialect.centre_feed.filter(|_| !self.modal.centre_feed) {
            Some(feed) if state.comp != Comp::Off => {
                self.modal.centre_feed = true;
                format!("{feed} {word}")
            }
            _ => word,
        };
        self.modal.comp_word = Some(match self.modal.plane {
            Some(Plane::Xy) => word,
            _ => {
                self.modal.plane = Some(Plane::Xy);
                format!("{} {word}", Plane::Xy.word())
            }
        });
        Ok(())
    }

    fn switch_on(&self, word: &str, register: u32) -> Result<String> {
        match self.dialect.comp {
            CompWord::None => {
                Err(unsupported(format!("{} has no cutter compensation", self.settings.control.title()))
                    .help("plan the finishing without a wear register")
                    .into())
            }
            CompWord::Edge if self.length != Some(register) => {
                let message =
                    "the radius of a compensation is that of the cutting edge in force, not of another";
                let in_force = f64::from(self.length.unwrap_or(0));
                Err(refused(message)
                    .value(f64::from(register), "register")
                    .bound(in_force, "edge in force")
                    .help("call the edge before the approach")
                    .into())
            }
            CompWord::Edge => Ok(word.to_owned()),
            CompWord::Register | CompWord::ModalRegister if register == 0 => {
                Err(refused("D0 is no radius register").value(0.0, "").bound(1.0, "").into())
            }
            CompWord::Register | CompWord::ModalRegister => Ok(match self.own_radius(register)? {
                Some(radius) => format!("{word}.1 D{}", self.grid.length(2.0 * radius)),
                None => format!("{word} D{register}"),
            }),
        }
    }

    /// Refuses what a control does not take while the compensation is on.
    pub(super) fn uncompensated(&self, what: &str) -> Result<()> {
        if self.modal.comp.is_none() {
            return Ok(());
        }
        Err(refused(format!("{what} while the cutter compensation is on"))
            .help("switch it off on a straight move first")
            .into())
    }
}

fn refused(what: impl Into<String>) -> Finding {
    Finding::error(Code::COMPENSATION, what)
}
