//! Places that `G28.1` and `G30.1` store, where `G28` and `G30` go from then on (LinuxCNC, GRBL).

use crate::base::Result;
use crate::nc::dialect::Code;
use crate::program::{Move, Path, Speed, Target, ToolAxis, WorkOffset, moved};

use super::place::Bytes;
use super::reader::{Kind, Reader};
use super::zeros::vector;

/// A place that was stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stored {
    /// In the machine, as far as it is known there [mm].
    machine: [Option<f64>; 3],
    /// In the work offset in force, as far as it is known [mm].
    work: [Option<f64>; 3],
    offset: WorkOffset,
    length: Option<u32>,
}

impl<'s> Reader<'s> {
    /// Executes `G28.1` and `G30.1`.
    pub(super) fn storing(&mut self) {
        let Some((Code::StorePlace { second }, _)) = self.code(|c| matches!(c, Code::StorePlace { .. }))
        else {
            return;
        };
        let mut machine = self.machine_place();
        if self.modal.tool.length.is_some() || self.lift != 0.0 {
            machine[2] = None;
        }
        let work = moved(&self.modal.turned.motion, vector(self.modal.position));
        let work = work.to_array().map(|v| Some(v).filter(|v| !v.is_nan()));
        let offset = self.modal.offset.unwrap_or(WorkOffset::G54);
        self.stored_places[usize::from(second)] =
            Some(Stored { machine, work, offset, length: self.modal.tool.length });
    }

    /// Goes to a stored place with the axes that are named.
    pub(super) fn goes_to_stored(&mut self, place: Stored, axes: [bool; 3], bytes: &Bytes) -> Result<()> {
        let speed = Speed::Rapid { linear: self.dialect.straight_rapid };
        let known = |of: [Option<f64>; 3]| (0..3).all(|axis| !axes[axis] || of[axis].is_some());
        if known(place.machine) {
            let mut joints = [None; 6];
            let mut machine = self.machine_place();
            for axis in (0..3).filter(|axis| axes[*axis]) {
                joints[axis] = place.machine[axis];
                machine[axis] = place.machine[axis].filter(|_| axis < 2 || self.modal.tool.length.is_none());
            }
            self.flush(Kind::Other);
            let motion = Move { end: Target::Joints(joints), path: Path::Line };
            self.program.push_move(motion, &self.state(speed), self.origin);
            self.modal.position = self.place_of(machine);
            return Ok(());
        }
        let same = self.modal.offset.unwrap_or(WorkOffset::G54) == place.offset
            && self.modal.tool.length == place.length;
        if !(same && known(place.work)) {
            let finding = self
                .lacks(bytes, "the place that was stored here (G28.1, G30.1) is not known to the program");
            return Err(finding.help("move to a known place before it is stored").into());
        }
        let mut work = moved(&self.modal.turned.motion, vector(self.modal.position));
        for axis in (0..3).filter(|axis| axes[*axis]) {
            work[axis] = place.work[axis].unwrap_or(f64::NAN);
        }
        let end = moved(&self.modal.turned.motion.inverse(), work);
        self.modal.rotary_axes.next = Some(ToolAxis::Fixed);
        self.push_tip(end.to_array().map(|v| Some(v).filter(|v| !v.is_nan())), Path::Line, speed);
        Ok(())
    }
}
