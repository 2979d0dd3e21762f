//! Places that `G28.1` and `G30.1` store, where `G28` and `G30` go from then on (LinuxCNC, GRBL).

use crate::base::Result;
use crate::nc::dialect::Code;
use crate::program::{Move, Path, Speed, Target, ToolAxis};

use super::place::Bytes;
use super::reader::{Kind, Reader};
use super::zeros::Spot;

/// A place that was stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stored {
    /// Of the tip, as far as it is known.
    tip: [Option<Spot>; 3],
    length: Option<u32>,
    /// Offsets of that length [mm].
    offsets: [Option<f64>; 3],
    /// Of the rotary axes, as far as it is known [deg].
    pub(super) turned: [Option<f64>; 3],
}

impl Stored {
    /// A place in the machine: of the linear axes [mm], and of the rotary ones [deg].
    pub(super) fn at(machine: [f64; 3], turned: [f64; 3]) -> Stored {
        Stored {
            tip: machine.map(|at| Some(Spot::machine(at))),
            length: None,
            offsets: [Some(0.0); 3],
            turned: turned.map(Some),
        }
    }

    /// Of the spindle in the machine [mm], as far as it is known there.
    pub(super) fn in_machine(&self) -> [Option<f64>; 3] {
        [0, 1, 2].map(|axis| Some(self.tip[axis]?.in_machine()? + self.offsets[axis]?))
    }

    /// Of the tip with a length in force and its offsets.
    fn tip_with(&self, length: Option<u32>, offsets: [Option<f64>; 3]) -> [Option<Spot>; 3] {
        if length == self.length {
            return self.tip;
        }
        [0, 1, 2].map(|axis| {
            let tip = self.tip[axis]?;
            Some(Spot { at: tip.at + (self.offsets[axis]? - offsets[axis]?), ..tip })
        })
    }
}

impl<'s> Reader<'s> {
    /// Executes `G28.1` and `G30.1`.
    pub(super) fn storing(&mut self) {
        let Some((Code::StorePlace { second }, _)) = self.code(|c| matches!(c, Code::StorePlace { .. }))
        else {
            return;
        };
        let (length, offsets) = (self.modal.tool.length, self.modal.tool_offsets);
        let turned = self.modal.rotary_axes.rotaries.at;
        let stored = Stored { tip: self.machine_place(), length, offsets, turned };
        self.stored_places[usize::from(second)] = Some(stored);
    }

    /// Goes to a stored place with the axes that are named; `turned` are those of the rotary ones.
    pub(super) fn goes_to_stored(
        &mut self,
        place: Stored,
        axes: [bool; 3],
        turned: [bool; 3],
        bytes: &Bytes,
    ) -> Result<()> {
        let speed = Speed::Rapid { linear: self.dialect.straight_rapid };
        let known = |of: [Option<f64>; 3]| (0..3).all(|axis| !axes[axis] || of[axis].is_some());
        let in_machine = place.in_machine();
        let there = place.tip_with(self.modal.tool.length, self.modal.tool_offsets);
        let unknown = || {
            let message = "the place to which G28 or G30 goes is not known as far as the program goes there";
            self.lacks(bytes, message).help("store it at a place that the program has set (G28.1, G30.1)")
        };
        let mut joints = [None; 6];
        for axis in (0..3).filter(|axis| turned[*axis]) {
            let Some(degrees) = place.turned[axis] else { return Err(unknown().into()) };
            joints[3 + axis] = Some(degrees.to_radians());
        }
        // The control turns the place into the coordinates in force, and goes there with the axes that are named in them.
        let askew = self.modal.turned.is_turned() && axes[0] != axes[1];
        if known(in_machine) && !askew {
            let mut tip = self.machine_place();
            for axis in (0..3).filter(|axis| axes[*axis]) {
                (joints[axis], tip[axis]) = (in_machine[axis], there[axis]);
            }
            self.flush(Kind::Other);
            let motion = Move { end: Target::Joints(joints), path: Path::Line };
            self.program.push_move(motion, &self.state(speed), self.origin);
            self.modal.position = self.place_of(tip);
            for axis in (0..3).filter(|axis| turned[*axis]) {
                self.modal.rotary_axes.rotaries.set(axis, place.turned[axis].unwrap_or_default());
                self.modal.rotary_axes.along = None;
            }
            let upright = self.modal.rotary_axes.rotaries.at.iter().all(|a| a.is_none_or(|a| a == 0.0));
            if turned.contains(&true) && !upright {
                self.modal.position = [None; 3];
            }
            return Ok(());
        }
        let whole = self.place_of(there);
        let mut end = self.modal.position;
        for axis in (0..3).filter(|axis| axes[*axis]) {
            end[axis] = whole[axis];
        }
        if !known(end) || turned.contains(&true) || askew && (end[0].is_none() || end[1].is_none()) {
            return Err(unknown().into());
        }
        self.modal.rotary_axes.next = Some(ToolAxis::Fixed);
        self.push_tip(end, Path::Line, speed);
        Ok(())
    }
}
