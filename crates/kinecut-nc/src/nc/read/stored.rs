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
}

impl Stored {
    /// A place in the machine [mm].
    pub(super) fn at(machine: [f64; 3]) -> Stored {
        Stored { tip: machine.map(|at| Some(Spot::machine(at))), length: None, offsets: [Some(0.0); 3] }
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
        let stored = Stored { tip: self.machine_place(), length, offsets };
        self.stored_places[usize::from(second)] = Some(stored);
    }

    /// Goes to a stored place with the axes that are named.
    pub(super) fn goes_to_stored(&mut self, place: Stored, axes: [bool; 3], bytes: &Bytes) -> Result<()> {
        let speed = Speed::Rapid { linear: self.dialect.straight_rapid };
        let known = |of: [Option<f64>; 3]| (0..3).all(|axis| !axes[axis] || of[axis].is_some());
        let (mut tip, in_machine) = (self.machine_place(), place.in_machine());
        let there = place.tip_with(self.modal.tool.length, self.modal.tool_offsets);
        for axis in (0..3).filter(|axis| axes[*axis]) {
            tip[axis] = there[axis];
        }
        if known(in_machine) {
            let mut joints = [None; 6];
            for axis in (0..3).filter(|axis| axes[*axis]) {
                joints[axis] = in_machine[axis];
            }
            self.flush(Kind::Other);
            let motion = Move { end: Target::Joints(joints), path: Path::Line };
            self.program.push_move(motion, &self.state(speed), self.origin);
            self.modal.position = self.place_of(tip);
            return Ok(());
        }
        let end = self.place_of(tip);
        if !known(end) {
            let finding = self
                .lacks(bytes, "the place that was stored here (G28.1, G30.1) is not known to the program");
            return Err(finding.help("move to a known place before it is stored").into());
        }
        self.modal.rotary_axes.next = Some(ToolAxis::Fixed);
        self.push_tip(end, Path::Line, speed);
        Ok(())
    }
}
