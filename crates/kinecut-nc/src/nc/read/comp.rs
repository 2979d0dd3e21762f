//! Cutter compensation: G40, G41, G42 and their radius register, and what a control refuses while it is on.
//!
//! Both switches need a straight move in the plane next, at whatever block (LinuxCNC enters on an arc too); in between there is no change of unit, plane, tool, register,
//! work offset or side, no cycle and no move in machine coordinates. The values of the registers are not in the
//! text.

use glam::DVec3;

use crate::base::{Code as FindingCode, Finding, Result};
use crate::nc::dialect::{AXES, Code, CompWord, Plane};
use crate::program::{Comp, Item, Move, Path, Target, Tcp};

use super::block::Word;
use super::place::Bytes;
use super::reader::{Reader, take};

/// State before a block that the compensation depends on.
pub(super) struct Before {
    comp: Comp,
    length: Option<u32>,
    position: [Option<f64>; 3],
    items: usize,
}

impl<'s> Reader<'s> {
    /// The state before a block; refuses a block that may not come while the compensation is on.
    pub(super) fn before(&self) -> Result<Before> {
        let off = self.modal.comp != Comp::Off && self.code(|c| c == Code::CompOff).is_some();
        let forbidden = |c: Code| match c {
            Code::Units { .. } | Code::ToolChange => true,
            Code::Plane(plane) => plane != Plane::Xy,
            Code::MachineFrame | Code::Reference | Code::FurtherReference => !off,
            Code::Work(_) | Code::LengthOn | Code::LengthOff | Code::LengthByNumber { .. } => !off,
            Code::TipControl { .. } | Code::Transformation { on: true } => !off,
            Code::Tilt | Code::TiltByTool | Code::Orient => true,
            Code::Rotation { .. }
            | Code::LocalShift
            | Code::SetData
            | Code::FrameShift { .. }
            | Code::FrameTurn { .. } => true,
            _ => false,
        };
        if self.modal.comp != Comp::Off
            && let Some((_, bytes)) = self.code(forbidden)
        {
            return Err(self.while_on(&bytes).into());
        }
        Ok(Before {
            comp: self.modal.comp,
            length: self.modal.tool.length,
            position: self.modal.position,
            items: self.program.items.len(),
        })
    }

    fn no_compensation(&self, bytes: &Bytes, message: &str) -> Finding {
        self.place.error(FindingCode::COMPENSATION, bytes, message)
    }

    /// Executes G40, G41, G42 and D.
    pub(super) fn compensation(&mut self, words: &mut [Word<'s>], before: &Before) -> Result<()> {
        let code = self.code(|c| matches!(c, Code::CompOff | Code::Comp { .. } | Code::CompByNumber { .. }));
        let stays = !matches!(code, Some((Code::CompOff, _)));
        if stays && before.comp != Comp::Off && before.length != self.modal.tool.length {
            return Err(self.while_on(&self.here).into());
        }
        let own = match &code {
            Some((Code::CompByNumber { left }, bytes)) => Some(self.own_radius(words, *left, bytes)?),
            _ => None,
        };
        let code = code.map(|(code, bytes)| (own.map_or(code, |(_, left)| Code::Comp { left }), bytes));
        let on = matches!(code, Some((Code::Comp { .. }, _)));
        let takes = match self.dialect.comp {
            CompWord::Register => on,
            CompWord::ModalRegister => true,
            CompWord::None | CompWord::Edge => false,
        };
        if let Some(word) = if takes { take(words, "D") } else { None } {
            let register = self.count(&word, "a register")?;
            if self.modal.comp != Comp::Off && !on && self.modal.radius != Some(register) {
                return Err(self.while_on(&word.bytes).into());
            }
            self.modal.radius = Some(register);
        } else if on && self.dialect.comp == CompWord::Register {
            self.modal.radius = own.map(|(register, _)| register);
        }
        let Some((code, bytes)) = code else { return Ok(()) };
        let Code::Comp { left } = code else {
            if self.modal.comp != Comp::Off {
                // Nothing was moved since it was switched on: nothing is to be taken back.
                self.modal.comp_turned = self.modal.comp_turned.is_none().then_some(bytes);
                self.modal.comp = Comp::Off;
            }
            return Ok(());
        };
        let register = match self.dialect.comp {
            CompWord::None => {
                return Err(self
                    .place
                    .not_understood(&bytes, "the control has no cutter compensation")
                    .into());
            }
            CompWord::Edge => self.modal.tool.length,
            CompWord::Register => self.modal.radius.or(self.modal.tool.id.map(|tool| tool.0)),
            CompWord::ModalRegister => self.modal.radius,
        };
        let Some(register) = register.filter(|r| *r != 0) else {
            let finding = self.no_compensation(&bytes, "a compensation without a radius register");
            return Err(finding.help("program D").into());
        };
        if self.modal.rotary_axes.tcp != Tcp::Off {
            let message = "a compensation under control of the tool centre point is not read";
            return Err(self.no_compensation(&bytes, message).into());
        }
        if self.modal.plane != Plane::Xy {
            let finding = self.no_compensation(&bytes, "compensation is read in G17 only");
            return Err(finding.help("program G17").into());
        }
        let comp = if left { Comp::Left(register) } else { Comp::Right(register) };
        if self.modal.comp == Comp::Off {
            self.modal.comp_turned = Some(bytes);
        } else if comp != self.modal.comp || self.dialect.comp == CompWord::Register {
            return Err(self.while_on(&bytes).into());
        }
        self.modal.comp = comp;
        Ok(())
    }

    pub(super) fn while_on(&self, bytes: &Bytes) -> Finding {
        let message = format!("`{}`: not while the cutter compensation is on", self.place.shown(bytes));
        self.no_compensation(bytes, &message).help("switch it off (G40) on a straight move first")
    }

    /// Checks a block that was executed.
    pub(super) fn check_compensation(&mut self, before: &Before) -> Result<()> {
        let is_on = self.modal.comp != Comp::Off;
        if !is_on && self.modal.comp_turned.is_none() {
            return Ok(());
        }
        let items = &self.program.items;
        let new = || (before.items..items.len()).map(|i| items.get(i));
        if is_on && new().any(|item| matches!(item, Item::Cycle(..))) {
            return Err(self.while_on(&self.here).into());
        }
        let mut moves =
            new().filter_map(|item| if let Item::Move(motion) = item { Some(motion) } else { None });
        // The switch waits for its move.
        let Some(first) = moves.next() else { return Ok(()) };
        let parts = 1 + moves.count();
        let Some(turned) = self.modal.comp_turned.take() else { return Ok(()) };
        match self.switch(&first, parts, before, is_on) {
            None => Ok(()),
            Some((what, help)) => {
                let line = self.place.sources.line(self.place.span(&turned));
                let help = format!("{help}; it is switched in line {line}");
                Err(self.no_compensation(&self.here, &what).help(help).into())
            }
        }
    }

    /// The fault of the first move after a switch of the compensation, and what to do about it; `parts`: moves of its block.
    fn switch(
        &self,
        first: &Move,
        parts: usize,
        before: &Before,
        is_on: bool,
    ) -> Option<(String, &'static str)> {
        let help = "enter and leave by G0 or G1 in XY";
        let Target::Tip { point, .. } = first.end else {
            return Some((
                "the first move after a switch of the compensation is in machine coordinates".to_owned(),
                help,
            ));
        };
        let [x, y, _] = self.mapped(before.position);
        let unknown: Vec<&str> = (0..2).filter(|i| before.position[*i].is_none()).map(|i| AXES[i]).collect();
        if !unknown.is_empty() {
            let what = format!(
                "the first move after a switch of the compensation starts where the program has not set {}",
                unknown.join(", ")
            );
            return Some((what, "move there before the compensation is switched"));
        }
        let fault = self.not_straight(first, parts, is_on);
        if fault.is_none() && (!point.truncate().is_finite() || Some(point.x) == x && Some(point.y) == y) {
            let what = "the first move after a switch of the compensation does not move in the plane";
            return Some((what.to_owned(), help));
        }
        fault.map(|what| (what.to_owned(), help))
    }

    /// The fault of a first move that is not straight: LinuxCNC enters on an arc too, and leaves by a straight move (`convert_arc`,
    /// `convert_arc_comp1`).
    fn not_straight(&self, first: &Move, parts: usize, is_on: bool) -> Option<&'static str> {
        let enters_on_arcs = is_on && self.dialect.comp == CompWord::Register;
        match first.path {
            Path::Line => None,
            Path::Arc { axis, .. } if enters_on_arcs && axis == DVec3::Z && parts == 1 => None,
            _ => Some("the first move after a switch of the compensation is not straight in the plane"),
        }
    }
}
