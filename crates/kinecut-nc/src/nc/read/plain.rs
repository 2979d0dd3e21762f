//! Plain blocks: `G0` and `G1` with ends of X, Y, Z and a feed as plain numbers, nearly all of a long program, read in one go.
//!
//! Nothing here has a meaning of its own. A block that says anything else is read as any other, and so is every block in a state
//! in which more than its end counts ([`Reader::is_quiet`]).

use crate::base::Result;
use crate::nc::dialect::{Code, Dialect};
use crate::program::{Comp, Origin, Path, Speed, Tcp};

use super::lex::LARGEST;
use super::modal::FeedMode;
use super::number::Number;
use super::place::Bytes;
use super::reader::Reader;

/// A plain block.
#[derive(Debug)]
pub(super) struct Plain {
    code: Option<Code>,
    ends: [Option<f64>; 3],
    feed: Option<f64>,
    /// From its first to its last word.
    bytes: Bytes,
    /// The first byte of the next line.
    pub(super) next: usize,
}

impl Plain {
    /// The block of the line that begins at a byte, if it is plain.
    pub(super) fn at(text: &str, start: usize, dialect: &Dialect) -> Option<Plain> {
        let bytes = text.as_bytes();
        let mut block = Plain { code: None, ends: [None; 3], feed: None, bytes: 0..0, next: 0 };
        let mut at = start;
        let mut first = None;
        let mut last = start;
        loop {
            let letter = match bytes.get(at) {
                None | Some(b'\n') => break,
                Some(b' ' | b'\t' | b'\r') => {
                    at += 1;
                    continue;
                }
                Some(letter) => letter.to_ascii_uppercase(),
            };
            if !matches!(letter, b'F' | b'G' | b'N' | b'X' | b'Y' | b'Z') {
                return None;
            }
            let number = Number::written(text, at + 1, false);
            let value = number.value.filter(|v| v.abs() <= LARGEST)?;
            let closed = match bytes.get(number.end) {
                None | Some(b'\n' | b'\r' | b' ' | b'\t') => true,
                // Letters behind a number may belong to it, or to a longer address.
                Some(b) => {
                    b.is_ascii_alphabetic() && !b.eq_ignore_ascii_case(&b'o') && !dialect.long_addresses
                }
            };
            // A number without a point counts in steps on some controls.
            let counts = number.point || !dialect.point;
            let room = match letter {
                b'X' => &mut block.ends[0],
                b'Y' => &mut block.ends[1],
                b'Z' => &mut block.ends[2],
                b'F' if value >= 0.0 => &mut block.feed,
                b'G' if closed && block.code.is_none() && (value == 0.0 || value == 1.0) => {
                    block.code = Some(if value == 0.0 { Code::Rapid } else { Code::Feed });
                    first.get_or_insert(at);
                    (at, last) = (number.end, number.end);
                    continue;
                }
                b'N' if closed && first.is_none() && value >= 0.0 => {
                    first = Some(at);
                    (at, last) = (number.end, number.end);
                    continue;
                }
                _ => return None,
            };
            if !closed || !counts || room.replace(value).is_some() {
                return None;
            }
            first.get_or_insert(at);
            (at, last) = (number.end, number.end);
        }
        block.next = at + 1;
        block.bytes = first? as u32..last as u32;
        block.ends.iter().any(Option::is_some).then_some(block)
    }
}

impl<'s> Reader<'s> {
    /// Whether a straight move is its end and its speed, and no more.
    pub(super) fn is_quiet(&self) -> bool {
        let modal = &self.modal;
        let rotary = &modal.rotary_axes;
        let turned = &modal.turned;
        matches!(modal.motion, Some(Code::Rapid | Code::Feed))
            && modal.position.iter().all(Option::is_some)
            && modal.feed_mode != FeedMode::InverseTime
            && (modal.motion_said && modal.units_said && modal.blend_said && modal.offset.is_some())
            && modal.moved_in == Some(modal.length_unit)
            && (modal.comp == Comp::Off && modal.comp_turned.is_none())
            && (rotary.plane.is_none() && rotary.tcp == Tcp::Off && rotary.next.is_none() && !rotary.lapsed)
            && !turned.adrift.iter().chain(&turned.fresh).any(|no| *no)
            && (modal.modal_call.is_none() && self.modal_macros.reach == 0)
            && (self.corner.is_none() && self.nurbs.is_none() && self.polar.is_none())
            && (self.scaling.map.is_none() && !modal.diameters && !self.length_lost && !self.ended)
    }

    /// Executes a plain block in a quiet state.
    pub(super) fn plain_block(&mut self, block: Plain) -> Result<()> {
        self.only_axes = true;
        self.points.increment = None;
        self.codes.clear();
        self.here = block.bytes;
        self.origin =
            Origin { span: Some(self.place.span(&self.here)), parent: self.parent, ..Origin::default() };
        if let Some(feed) = block.feed {
            self.set_feed(feed);
        }
        if let Some(code) = block.code {
            self.puts_in_force(code);
            self.modal.sticky.end();
            self.modal.cubic_end = None;
        }
        let unit = self.modal.length_unit;
        let mut end = self.modal.position;
        for (end, said) in end.iter_mut().zip(block.ends) {
            let Some(value) = said.map(|v| v * unit) else { continue };
            *end = if self.modal.absolute { Some(value) } else { end.map(|before| before + value) };
        }
        let speed = match self.modal.motion {
            Some(Code::Rapid) => Speed::Rapid { linear: self.dialect.straight_rapid },
            _ => self.feed_speed()?,
        };
        self.push_tip(end, Path::Line, speed);
        Ok(())
    }
}
