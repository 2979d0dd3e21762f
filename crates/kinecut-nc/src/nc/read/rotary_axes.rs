//! Rotary axes and control of the tool centre point.
//!
//! Rotary words are degrees; `IC()` counts from the place before, `DC()`, `ACP()` and `ACN()` go to the angle by the
//! shortest way, upwards or downwards. A move that names none keeps the tool axis: along Z as long as every rotary axis
//! that was ever named is at zero.
//!
//! The meaning of coordinates changes where control of the tip begins and ends; no position is known then.

use glam::DVec3;

use crate::base::Result;
use crate::nc::dialect::{Code, OFFSETS};
use crate::nc::multi_axis::{ROTARY, TcpWord};
use crate::program::{Comp, Speed, Tcp, ToolAxis};

use super::block::{Word, WordMode};
use super::place::Bytes;
use super::reader::{Reader, take, take_way};
use super::rotary_state::ZERO;

/// Shortest vector of a tool axis: below it is a slip of the pen.
const LEAST_VECTOR: f64 = 1e-3;

impl<'s> Reader<'s> {
    /// Words of a tool axis as a vector, in force.
    fn vector_words(&self) -> Option<[&'static str; 3]> {
        let words = self.dialect.axes.vector?.0;
        (words != OFFSETS || self.modal.rotary_axes.by_vector)
            .then_some(words.map(|w| w.trim_end_matches('=')))
    }

    /// Whether the block has a word of a rotary axis or of a tool axis.
    pub(super) fn has_rotary(&self, words: &[Word<'s>]) -> bool {
        if self.only_axes {
            return false;
        }
        let says = |names: [&str; 3]| words.iter().any(|w| !w.used && names.iter().any(|n| w.is(n)));
        self.dialect.axes.rotary.is_some() && says(ROTARY) || self.vector_words().is_some_and(says)
    }

    /// Whether I, J and K are a tool axis.
    pub(super) fn centre_is_axis(&self) -> bool {
        self.vector_words() == Some(OFFSETS)
    }

    /// Angles that a block names [deg], and their places; the rotary axes go there.
    pub(super) fn rotary_end(&mut self, words: &mut [Word<'s>]) -> Result<[Option<f64>; 3]> {
        let mut end = [None; 3];
        if self.dialect.axes.rotary.is_none() {
            return Ok(end);
        }
        for (axis, name) in ROTARY.into_iter().enumerate() {
            let Some((word, way)) = take_way(words, name) else { continue };
            self.zero_kept(axis, &word.bytes)?;
            if self.modal.rotary_axes.plane.is_some() {
                let finding = self.lacks(&word.bytes, "a rotary axis moves in a tilted plane");
                return Err(finding.help("end the plane first").into());
            }
            let before = self.modal.rotary_axes.rotaries.at[axis];
            let way = if way == WordMode::Plain && !self.modal.absolute { WordMode::Increment } else { way };
            let to = match (way, before) {
                (WordMode::Plain | WordMode::Absolute, _) => word.value,
                (_, None) => {
                    let finding = self.lacks(
                        &word.bytes,
                        "an angle that counts from a place which the program has not set",
                    );
                    return Err(finding.help("turn this axis to an absolute angle first").into());
                }
                (WordMode::Increment, Some(at)) => at + word.value,
                (WordMode::Shortest, Some(at)) => word.value + 360.0 * ((at - word.value) / 360.0).round(),
                (WordMode::Up, Some(at)) => word.value + 360.0 * ((at - word.value) / 360.0 - ZERO).ceil(),
                (WordMode::Down, Some(at)) => word.value + 360.0 * ((at - word.value) / 360.0 + ZERO).floor(),
            };
            if before != Some(to) {
                self.modal.rotary_axes.along = None;
                self.modal.rotary_axes.vector = None;
            }
            self.modal.rotary_axes.rotaries.set(axis, to);
            end[axis] = Some(to);
        }
        Ok(end)
    }

    /// The tool axis of a move, from the words of its block.
    pub(super) fn tool_axis(&mut self, words: &mut [Word<'s>]) -> Result<ToolAxis> {
        if self.only_axes {
            return Ok(self.modal.rotary_axes.kept());
        }
        let turned = self.rotary_end(words)?;
        let said = match self.vector_words() {
            Some(names) => {
                let mut bytes: Option<Bytes> = None;
                let vector = names.map(|name| {
                    take(words, name).map_or(0.0, |v| {
                        bytes.get_or_insert(v.bytes);
                        v.value
                    })
                });
                bytes.map(|b| (DVec3::from_array(vector), b))
            }
            None => None,
        };
        let Some((vector, bytes)) = said else {
            return Ok(match turned {
                [None, None, None] => self.modal.rotary_axes.kept(),
                angles => ToolAxis::Rotary(angles.map(|a| a.map(f64::to_radians))),
            });
        };
        if turned != [None; 3] {
            return Err(self.lacks(&bytes, "a tool axis both as angles and as a vector").into());
        }
        if self.modal.rotary_axes.tcp == Tcp::Off {
            let finding =
                self.lacks(&bytes, "a tool axis as a vector without control of the tool centre point");
            return Err(finding.help("program TRAORI first").into());
        }
        let length = vector.length();
        if !(length >= LEAST_VECTOR) {
            return Err(self.lacks(&bytes, "a tool axis of no length").value(length, "").into());
        }
        let vector = vector / length;
        self.modal.rotary_axes.swing(None);
        self.modal.rotary_axes.vector = Some(vector);
        Ok(ToolAxis::Vector(vector))
    }

    /// Refuses a block whose words of a tool axis its curve does not take.
    pub(super) fn only_straight(&self) -> Result<()> {
        let turns = self.modal.rotary_axes.turns_next();
        match self.modal.motion {
            Some(Code::Rapid | Code::Feed | Code::Arc { .. }) => Ok(()),
            _ if turns => Err(self
                .lacks(&self.here, "rotary axes turn on lines and arcs only, as they are read")
                .into()),
            _ => Ok(()),
        }
    }

    /// G43.4 and G43.5 with the length they call; the register.
    pub(super) fn tip_control(&mut self, vector: bool, bytes: &Bytes) -> Result<()> {
        if self.modal.rotary_axes.plane.is_some() {
            let finding = self.lacks(bytes, "control of the tool centre point in a tilted plane");
            return Err(finding.help("program G69 first").into());
        }
        self.no_compensation_with_tip(bytes)?;
        self.modal.rotary_axes.tcp = Tcp::Axes;
        self.modal.rotary_axes.by_vector = vector;
        self.modal.rotary_axes.lapsed = false;
        self.modal.position = [None; 3];
        Ok(())
    }

    /// Whatever ends the control of the tip together with a length (G43, G49).
    pub(super) fn tip_control_ends(&mut self, length: bool) {
        let rotary_axes = &mut self.modal.rotary_axes;
        rotary_axes.lapsed = !length && (rotary_axes.lapsed || rotary_axes.tcp != Tcp::Off);
        if rotary_axes.tcp != Tcp::Off {
            rotary_axes.tcp = Tcp::Off;
            rotary_axes.by_vector = false;
            self.modal.position = [None; 3];
        }
    }

    /// TRAORI, TRAFOOF, ORIAXES, ORIVECT.
    pub(super) fn transformation(&mut self) -> Result<()> {
        if let Some((Code::Interpolation { vector }, _)) =
            self.code(|c| matches!(c, Code::Interpolation { .. }))
        {
            let tcp = if vector { Tcp::Vector } else { Tcp::Axes };
            self.modal.rotary_axes.interpolation = Some(tcp);
            if self.modal.rotary_axes.tcp != Tcp::Off {
                self.modal.rotary_axes.tcp = tcp;
            }
        }
        let Some((Code::Transformation { on }, bytes)) =
            self.code(|c| matches!(c, Code::Transformation { .. }))
        else {
            return Ok(());
        };
        self.modal.position = [None; 3];
        if !on {
            self.modal.rotary_axes.tcp = Tcp::Off;
            return Ok(());
        }
        if self.modal.rotary_axes.plane.is_some() {
            let finding = self.lacks(&bytes, "control of the tool centre point in a tilted plane");
            return Err(finding.help("end it first (CYCLE800())").into());
        }
        self.no_compensation_with_tip(&bytes)?;
        let usual = if self.dialect.axes.tcp == TcpWord::Transformation { Tcp::Vector } else { Tcp::Axes };
        self.modal.rotary_axes.tcp = self.modal.rotary_axes.interpolation.unwrap_or(usual);
        Ok(())
    }

    /// Notes what is assumed of the interpolation, at the first move that needs it.
    pub(super) fn note_interpolation(&mut self) {
        let rotary_axes = &self.modal.rotary_axes;
        if self.dialect.axes.tcp == TcpWord::Transformation
            && rotary_axes.tcp != Tcp::Off
            && rotary_axes.interpolation.is_none()
        {
            self.note("neither ORIAXES nor ORIVECT was said: ORIVECT is assumed, as a control begins");
        }
    }

    /// Notes what the feed of a move that turns an axis is not certain to mean.
    pub(super) fn note_feed(&mut self, speed: Speed) {
        let rotary_axes = &self.modal.rotary_axes;
        if rotary_axes.tcp == Tcp::Off && rotary_axes.turns_next() && matches!(speed, Speed::PerMinute(_)) {
            self.note(
                "the feed of a block that turns a rotary axis counts millimetres or degrees as the control does; in inverse \
                 time (G93) it is certain",
            );
        }
    }

    fn no_compensation_with_tip(&self, bytes: &Bytes) -> Result<()> {
        if self.modal.comp == Comp::Off {
            return Ok(());
        }
        Err(self.while_on(bytes).into())
    }
}
