//! The way to the reference point: `G28` with the axes that go there, over the point that their words say; `G30 P2` to `P4`
//! likewise to the further ones, whose places are parameters of the machine (FANUC 1241 to 1243) too.
//!
//! `G91 G28 Z0.` goes there straight, for an increment of zero leaves the axis where it is. The reference point is a
//! parameter of the machine (FANUC 1240), or was stored by the operator (`G28.1`): it is read as machine zero, and that is
//! noted.

use glam::DVec3;

use crate::base::Result;
use crate::nc::dialect::{AXES, Code};
use crate::nc::multi_axis::ROTARY;
use crate::program::{Move, Path, Speed, Target, Tcp, ToolAxis};

use super::block::Word;
use super::place::Bytes;
use super::reader::{Kind, Reader, take, take_way};

impl<'s> Reader<'s> {
    /// Executes `G28` and `G30`.
    pub(super) fn reference_move(&mut self, words: &mut [Word<'s>], code: Code, bytes: &Bytes) -> Result<()> {
        let point = self.reference_point(words, code)?;
        let speed = Speed::Rapid { linear: self.dialect.straight_rapid };
        let mut joints = [None; 6];
        let mut over = self.modal.position;
        let mut goes_over = false;
        for axis in 0..3 {
            let Some(word) = take(words, AXES[axis]) else { continue };
            joints[axis] = Some(0.0);
            let value = word.value * self.modal.length_unit;
            over[axis] = match (self.modal.absolute, over[axis]) {
                (true, _) => Some(value),
                // An increment of nothing: the axis stays, wherever it is.
                (false, before) if value == 0.0 => before,
                (false, Some(before)) => Some(before + value),
                (false, None) => {
                    let finding =
                        self.lacks(&word.bytes, "an increment from a position that the program has not set");
                    return Err(finding.help("write 0 to go straight to the reference point").into());
                }
            };
            goes_over |= self.modal.absolute || value != 0.0;
        }
        for axis in 0..3 {
            if self.dialect.axes.rotary.is_none() {
                break;
            }
            let Some((word, _)) = take_way(words, ROTARY[axis]) else { continue };
            self.zero_kept(axis, bytes)?;
            let there = self.modal.rotary_axes.rotaries.at[axis] == Some(word.value);
            if !(there || word.value == 0.0) {
                let finding =
                    self.lacks(&word.bytes, "a rotary axis goes to its reference point over an angle");
                return Err(finding.help("turn it there first, and write 0").into());
            }
            joints[3 + axis] = Some(0.0);
        }
        let stored = self.stored_places[usize::from(point.is_some())];
        if joints == [None; 6] {
            if self.dialect.point {
                return Err(self.lacks(bytes, "the way to the reference point without an axis").into());
            }
            joints[..3].fill(Some(0.0));
            // An axis that stands elsewhere than at zero there goes, too.
            for axis in 0..3 {
                if stored.is_some_and(|place| place.turned[axis].is_some_and(|turned| turned != 0.0)) {
                    joints[3 + axis] = Some(0.0);
                }
            }
        }
        if goes_over {
            self.check_along()?;
            self.flush(Kind::Tip);
            let point = DVec3::from_array(over.map(|v| v.unwrap_or(f64::NAN)));
            let axis = self.modal.rotary_axes.kept();
            debug_assert!(axis == ToolAxis::Fixed || self.dialect.axes.rotary.is_some());
            let motion = Move { end: Target::Tip { point, axis }, path: Path::Line };
            self.program.push_move(motion, &self.state(speed), self.origin);
            self.modal.position = over;
            if over[2].is_some() {
                self.modal.tool_item = None;
            }
        }
        if let Some(place) = stored {
            let named = |first: usize| [0, 1, 2].map(|axis| joints[first + axis].is_some());
            return self.goes_to_stored(place, named(0), named(3), bytes);
        }
        for axis in 0..3 {
            if joints[axis].is_some() {
                self.modal.position[axis] = None;
            }
            if joints[3 + axis].is_some() {
                self.modal.rotary_axes.rotaries.set(axis, 0.0);
                self.modal.rotary_axes.along = None;
            }
        }
        let tilted = self.modal.rotary_axes.plane.is_some() || self.modal.rotary_axes.tcp != Tcp::Off;
        if tilted || self.modal.turned.is_turned() && (joints[0].is_some() || joints[1].is_some()) {
            self.modal.position = [None; 3];
        }
        self.flush(Kind::Other);
        let motion = Move { end: Target::Joints(joints), path: Path::Line };
        self.program.push_move(motion, &self.state(speed), self.origin);
        // A Haas forgets the tool length there (96-8000, `G49`).
        if self.dialect.haas && self.modal.tool.length.take().is_some() {
            self.length_lost = true;
            self.offsets_change();
        }
        match point {
            None => self.note("the reference point (G28) is taken to be machine zero"),
            Some(point) => self.say_further_reference(point, bytes),
        }
        Ok(())
    }

    /// The reference point that `G30 P` names: the second where there is no P.
    fn reference_point(&self, words: &mut [Word<'s>], code: Code) -> Result<Option<u32>> {
        if code != Code::FurtherReference {
            return Ok(None);
        }
        let Some(word) = take(words, "P") else { return Ok(Some(2)) };
        match self.count(&word, "a reference point")? {
            point @ 2..=4 => Ok(Some(point)),
            _ => Err(self.place.malformed(&word.bytes, "the reference points of G30 are P2 to P4").into()),
        }
    }

    /// Says that the place of a further reference point is not known.
    fn say_further_reference(&mut self, point: u32, bytes: &Bytes) {
        let parameter = if self.dialect.point { (1239 + point).to_string() } else { "G30.1".to_owned() };
        let message = format!(
            "the place of reference point {point} (G30) is a parameter of the machine ({parameter}): machine zero is assumed"
        );
        self.doubt(bytes, &message, "see that the way there is free");
    }
}
