//! `G10`: data of the control that a program sets, and the machine coordinates that are known from it.
//!
//! - `L2 P`: machine coordinates of the zero of a work offset. The first of an axis tells where in the machine the zero of the setup is
//!   taken to be, which is said; another one later shifts the coordinates. On FANUC `G91` adds to the zero, and `P0` is the
//!   offset that is added to all; on LinuxCNC and GRBL `P0` is the work offset in force, `G91` changes nothing, and LinuxCNC turns the
//!   offset by `R`.
//!   FANUC sets the work offsets beyond G59 by `L20 P`.
//! - `L20 P` (LinuxCNC, GRBL): the zero is put where the present place gets the coordinates that are said. The first of a work
//!   offset other than that in force tells where it lies from that one.
//! - `L1`, `L10`, `L11` (LinuxCNC), `L10`, `L12` (FANUC): the tool table, next door.
//!
//! Once the zero of a work offset is known in the machine, so is the place behind a move in machine coordinates; once the
//! distance of two zeros is known, so is the place in one from that in the other.

use glam::DVec3;

use crate::base::Result;
use crate::nc::dialect::{FlowWords, TurnWord};
use crate::nc::multi_axis::ROTARY;
use crate::program::{ControlData, Item, Program, Speed, WorkOffset, moved};

use super::block::Word;
use super::kept::offset_by_number;
use super::place::Bytes;
use super::reader::{Kind, Reader, Value, take};
use super::zeros::{Spot, vector};

impl<'s> Reader<'s> {
    /// Executes `G10`.
    pub(super) fn set_data(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        let Some(kind) = take(words, "L") else {
            let finding = self.lacks(bytes, "G10 without L").help("program L2 to set a work offset");
            return Err(self.answers(finding, 28).into());
        };
        let fanuc = self.dialect.flow == FlowWords::MacroB;
        let number = self.count(&kind, "L")?;
        match number {
            2 | 20 if number == 2 || fanuc => self.set_zero(words, number == 20, bytes),
            20 if !fanuc => self.set_zero_here(words, bytes),
            10 | 12 if fanuc => self.set_register(words, number == 10, bytes),
            1 | 10 | 11 if self.dialect.turn == TurnWord::Offset => self.set_tool(words, number, bytes),
            _ => {
                let why = "of G10 only work offsets and the tool table are read (L2, L20; L1, L10, L11; on FANUC L2, L10, L12)";
                Err(self.place.not_understood(&kind.bytes, why).into())
            }
        }
    }

    /// `G10 L2 P X Y Z R`, and `G10 L20 P X Y Z` of FANUC for a work offset beyond G59.
    fn set_zero(&mut self, words: &mut [Word<'s>], further: bool, bytes: &Bytes) -> Result<()> {
        let offset = self.offset_of(words, further, bytes)?;
        let named = self.lengths(words);
        self.no_turned_zero(words)?;
        let angle = match self.dialect.turn {
            TurnWord::Offset => take(words, "R"),
            _ => None,
        };
        if named == [None; 3] && angle.is_none() {
            return Err(self.lacks(bytes, "G10 L2 without an axis or a rotation").into());
        }
        if let (Some(angle), Some(offset)) = (angle, offset) {
            self.modal.turned.turn_offset(offset, angle.value);
        }
        if !self.modal.absolute && self.dialect.flow == FlowWords::MacroB {
            let zero = self.modal.turned.zeros.of_mut(offset);
            zero.shift += DVec3::from_array(named.map(|v| v.unwrap_or(0.0)));
            return Ok(());
        }
        let known = |axis: usize| self.modal.turned.zeros.in_machine(offset, axis);
        let first: Vec<usize> =
            (0..3).filter(|axis| named[*axis].is_some() && known(*axis).is_none()).collect();
        if !first.is_empty() {
            self.unmoved(offset, bytes)?;
        }
        let mut place = [None; 3];
        for axis in 0..3 {
            let Some(value) = named[axis] else { continue };
            let first = self.modal.turned.zeros.in_machine(offset, axis);
            let zeros = &mut self.modal.turned.zeros;
            match first {
                None => {
                    let at = value - zeros.of_mut(offset).shift[axis];
                    zeros.put(offset, axis, Spot::machine(at));
                    place[axis] = Some(at);
                }
                Some(first) => zeros.of_mut(offset).shift[axis] = value - first,
            }
        }
        if place != [None; 3] {
            let in_force = offset.is_none() || offset == self.modal.offset.or(Some(WorkOffset::G54));
            for axis in first.into_iter().filter(|_| in_force) {
                self.modal.position[axis] = None;
            }
            self.data(ControlData::Zero { offset, place });
            let message = "the program sets the zero of a work offset in machine coordinates (G10 L2): the setup is taken to have it there";
            self.assume(bytes, message);
        }
        Ok(())
    }

    /// Refuses the first zero of a work offset in which the tip was moved already.
    fn unmoved(&self, offset: Option<WorkOffset>, bytes: &Bytes) -> Result<()> {
        if !moves_in(&self.program, offset) {
            return Ok(());
        }
        let which = offset.map_or("all work offsets".to_owned(), |o| o.to_string());
        let message =
            format!("the zero of {which} changes after moves in it, by how much the machine alone knows");
        Err(self.lacks(bytes, &message).help("set it before the first move").into())
    }

    /// `G10 L20 P X Y Z`.
    fn set_zero_here(&mut self, words: &mut [Word<'s>], bytes: &Bytes) -> Result<()> {
        let offset = self.offset_of(words, false, bytes)?.unwrap_or(WorkOffset::G54);
        let named = self.lengths(words);
        self.no_turned_zero(words)?;
        if named == [None; 3] {
            return Err(self.lacks(bytes, "G10 L20 without an axis").into());
        }
        let own = offset == self.modal.offset.unwrap_or(WorkOffset::G54);
        if own && self.unknown_axes(named) {
            self.gets_coordinates(Some(offset), named, bytes)?;
        }
        let here = self.machine_place();
        let zero = self.modal.turned.zeros.first(offset);
        let motion = self.modal.turned.motion_of(self.dialect.turn, offset);
        // Within the work offset as the setup has it.
        let within = [0, 1, 2].map(|axis| here[axis].map_or(f64::NAN, |here| here.minus(zero[axis])));
        let within = DVec3::from_array(within);
        let before = moved(&motion.inverse(), within);
        let wanted = DVec3::from_array([0, 1, 2].map(|i| named[i].unwrap_or(before[i])));
        let wanted = moved(&motion, wanted);
        let askew = motion.rotation != glam::DMat3::IDENTITY;
        let mut place = [None; 3];
        for axis in 0..3 {
            if named[axis].is_none() && !(askew && axis < 2) {
                continue;
            }
            let step = within[axis] - wanted[axis];
            if !step.is_nan() {
                self.modal.turned.zeros.of_mut(Some(offset)).shift[axis] += step;
                continue;
            }
            let Some(here) = here[axis].filter(|_| !own && !wanted[axis].is_nan()) else {
                let message =
                    format!("G10 L20 sets the zero of {offset} from a place that is not known in it");
                let finding = self.lacks(bytes, &message);
                return Err(finding.help("set the zeros of both work offsets first (G10 L2)").into());
            };
            self.unmoved(Some(offset), bytes)?;
            let spot = Spot { at: here.at - wanted[axis], ..here };
            self.modal.turned.zeros.put(Some(offset), axis, spot);
            place[axis] = Some(wanted[axis]);
        }
        if place != [None; 3] {
            self.data(ControlData::Here { offset: Some(offset), place });
            let message = "the program sets the zero of a work offset from the present place (G10 L20): the setup is taken to have it there";
            self.assume(bytes, message);
        }
        Ok(())
    }

    /// The work offset of P; none is what is added to all of them.
    fn offset_of(&self, words: &mut [Word<'s>], further: bool, bytes: &Bytes) -> Result<Option<WorkOffset>> {
        let Some(number) = take(words, "P") else {
            return Err(self.answers(self.lacks(bytes, "G10 without the work offset P"), 28).into());
        };
        let fanuc = self.dialect.flow == FlowWords::MacroB;
        let found = match self.count(&number, "a work offset")? {
            n if further => WorkOffset::extended(n),
            0 if fanuc => return Ok(None),
            0 => Some(self.modal.offset.unwrap_or(WorkOffset::G54)),
            n if n <= 6 || !fanuc => offset_by_number(n),
            _ => None,
        };
        let (least, most) = match (further, fanuc) {
            (true, _) if self.dialect.haas => (1, 99),
            (true, _) => (1, 300),
            (false, true) => (0, 6),
            (false, false) => (0, 9),
        };
        found.filter(|o| (self.dialect.has_offset)(*o)).map(Some).ok_or_else(|| {
            let message = format!("these work offsets are P{least} to P{most}");
            let finding = self.place.malformed(&number.bytes, &message);
            finding.value(number.value, "").bound(f64::from(most), "").into()
        })
    }

    /// Refuses the zero of a rotary axis that is not zero.
    pub(super) fn no_turned_zero(&self, words: &mut [Word<'s>]) -> Result<()> {
        if self.dialect.axes.rotary.is_none() {
            return Ok(());
        }
        let turned: Option<Value> = ROTARY.iter().filter_map(|r| take(words, r)).find(|v| v.value != 0.0);
        match turned {
            Some(word) => {
                let why = "a work offset that turns the zero of a rotary axis is not followed";
                Err(self.place.not_understood(&word.bytes, why).into())
            }
            None => Ok(()),
        }
    }

    /// Appends data of the control.
    pub(super) fn data(&mut self, data: ControlData) {
        self.flush(Kind::Other);
        self.program.push_data(data, &self.state(Speed::Rapid { linear: false }), self.origin);
    }

    /// The place in the machine, or from the zero of a work offset.
    pub(super) fn machine_place(&self) -> [Option<Spot>; 3] {
        self.machine_place_in(self.modal.offset)
    }

    /// That of the place in the coordinates of a work offset.
    pub(super) fn machine_place_in(&self, offset: Option<WorkOffset>) -> [Option<Spot>; 3] {
        let zero = self.modal.turned.zeros.first(offset.unwrap_or(WorkOffset::G54));
        let within = moved(&self.modal.turned.motion, vector(self.modal.position));
        [0, 1, 2].map(|axis| {
            let at = zero[axis].at + within[axis];
            Some(Spot { at, ..zero[axis] }).filter(|_| !at.is_nan())
        })
    }

    /// The place in the coordinates in force of a place in the machine, where that is known [mm].
    pub(super) fn place_of(&self, machine: [Option<Spot>; 3]) -> [Option<f64>; 3] {
        let zero = self.modal.turned.zeros.first(self.modal.offset.unwrap_or(WorkOffset::G54));
        let within = [0, 1, 2].map(|axis| machine[axis].map_or(f64::NAN, |spot| spot.minus(zero[axis])));
        let here = moved(&self.modal.turned.motion.inverse(), DVec3::from_array(within));
        here.to_array().map(|v| Some(v).filter(|v| !v.is_nan()))
    }
}

/// Whether the tip was moved in a work offset, in any of them for none.
fn moves_in(program: &Program, offset: Option<WorkOffset>) -> bool {
    (0..program.items.len()).any(|i| {
        let moves = match program.items.get(i) {
            Item::Move(motion) => matches!(motion.end, crate::program::Target::Tip { .. }),
            Item::Cycle(..) => true,
            _ => false,
        };
        moves && offset.is_none_or(|o| program.in_work(program.state(i).frame).is_some_and(|(of, _)| of == o))
    })
}
