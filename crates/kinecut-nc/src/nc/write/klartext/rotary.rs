//! Rotary axes and tool directions in klartext: `L A B C`, `LN TX TY TZ`, `M128` and `FUNCTION TCPM`.
//!
//! A rotary axis is named where it changes, or where its position is not known. The control of the tool centre
//! point is switched in blocks of its own, off before the coordinates change, before a move in machine coordinates, a
//! tool call, a stop and the end, and on again with the next move that needs it. There is no inverse time: the time of a
//! block is written as the feed of the tip, where its way is known, and refused elsewhere.

use glam::DVec3;

use crate::base::{Code, Finding, Result};
use crate::nc::grid::Grid;
use crate::nc::heidenhain::plane::{ANGLE_DECIMALS, degrees};
use crate::nc::heidenhain::{TOOL_VECTOR, VECTOR_DECIMALS};
use crate::nc::multi_axis::ROTARY;
use crate::nc::write::{ToolPosition, Writer, unsupported};
use crate::program::{Comp, Move, Path, Speed, State, Tcp, ToolAxis};

/// Largest number of a rotary axis [deg]: five digits before the point.
const MOST_DEGREES: f64 = 99_999.0;
/// Largest deviation of the length of a tool direction from 1.
const UNIT: f64 = 1e-6;

/// Tool axis after a block.
#[derive(Clone, Debug)]
pub(in crate::nc::write) enum Orientation {
    /// As before.
    Kept,
    /// Rotary axes with their counts of steps; the words of those that change.
    Rotary([Option<i64>; 3], String),
    /// Words of a direction.
    Vector(String),
}

impl Writer<'_> {
    /// Words of a move of the tip for the tool axis.
    pub(in crate::nc::write) fn klartext_orientation(
        &self,
        motion: &Move,
        axis: ToolAxis,
        state: &State,
    ) -> Result<Orientation> {
        let tilted = self.program.in_tilted(state.frame).is_some();
        let found = match axis {
            ToolAxis::Fixed => {
                self.along_z(state)?;
                Orientation::Kept
            }
            ToolAxis::Rotary(angles) => {
                let counts = rotary_counts(angles)?;
                let words = self.changed_axes(counts)?;
                if words.is_empty() { Orientation::Kept } else { Orientation::Rotary(counts, words) }
            }
            ToolAxis::Vector(axis) => {
                if state.tcp == Tcp::Off {
                    return Err(unsupported(
                        "a tool direction as a vector needs control of the tool centre point (M128)",
                    )
                    .help("give the angles of the rotary axes")
                    .into());
                }
                Orientation::Vector(vector_words(axis)?)
            }
        };
        if let Orientation::Kept = found {
            return Ok(found);
        }
        if tilted {
            return Err(unsupported("rotary axes do not move within a tilted plane")
                .help("give the points in the work offset, or turn the axes in machine coordinates")
                .into());
        }
        if motion.path != Path::Line {
            return Err(unsupported("rotary axes move on straight moves only")
                .help("give the curve as chords")
                .into());
        }
        if state.comp != Comp::Off {
            return Err(unsupported("cutter compensation while rotary axes move is not written")
                .help("give the path of the tool centre")
                .into());
        }
        Ok(found)
    }

    /// Refuses a tool along Z of coordinates that are not tilted while the rotary axes stand elsewhere.
    pub(in crate::nc::write) fn along_z(&self, state: &State) -> Result<()> {
        if self.upright() || self.program.in_tilted(state.frame).is_some() {
            return Ok(());
        }
        let message = "a move with the tool along Z while the rotary axes stand elsewhere";
        Err(Finding::error(Code::NC_STATE, message).help("turn them back by a move that names them").into())
    }

    /// The words of the rotary axes that change.
    pub(in crate::nc::write) fn changed_axes(&self, counts: [Option<i64>; 3]) -> Result<String> {
        let grid = Grid::new(ANGLE_DECIMALS, None, false)?.signed();
        let mut words = String::new();
        for ((count, name), known) in counts.into_iter().zip(ROTARY).zip(self.modal.pen.rotary) {
            if let Some(count) = count.filter(|c| known != Some(*c)) {
                grid.word(&mut words, name, count);
            }
        }
        Ok(words)
    }

    /// The words of rotary axes in machine coordinates: named whatever is known, since the preset may shift an axis.
    pub(in crate::nc::write) fn joint_words(
        &mut self,
        counts: [Option<i64>; 3],
        block: &mut String,
    ) -> Result<()> {
        for (known, count) in self.modal.pen.rotary.iter_mut().zip(counts) {
            *known = known.filter(|_| count.is_none());
        }
        let words = self.changed_axes(counts)?;
        if !words.is_empty() && !block.is_empty() {
            block.push(' ');
        }
        block.push_str(&words);
        self.rotary_at(counts, false);
        Ok(())
    }

    /// A block that turns the tool axis.
    pub(in crate::nc::write) fn klartext_turning(
        &mut self,
        point: DVec3,
        orientation: &Orientation,
        state: &State,
    ) -> Result<()> {
        let speed = self.tip_feed(point, state)?;
        let vector = matches!(orientation, Orientation::Vector(_));
        if vector && !point.is_finite() {
            return Err(Finding::error(Code::NC_STATE, "a block with a tool direction names X, Y and Z")
                .help("give all three coordinates")
                .into());
        }
        let mut words = String::new();
        for (axis, value) in point.to_array().into_iter().enumerate() {
            let always = vector || axis != 2 && self.modal.pen.beside.is_some();
            self.axis(&mut words, axis, value, always)?;
        }
        let (name, more) = match orientation {
            Orientation::Kept => ("L", ""),
            Orientation::Rotary(_, words) => ("L", words.as_str()),
            Orientation::Vector(words) => ("LN", words.as_str()),
        };
        let blank = if words.is_empty() { "" } else { " " };
        self.klartext_block(format!("{name} {words}{blank}{more}"), speed)?;
        match *orientation {
            Orientation::Rotary(counts, _) => self.rotary_at(counts, state.tcp == Tcp::Vector),
            _ => {
                self.modal.pen.rotary = [None; 3];
                self.modal.rotary_axes.rotaries.swing();
            }
        }
        Ok(())
    }

    /// Notes where the rotary axes are; with a path of the tool axis the control may have taken its other solution.
    pub(in crate::nc::write) fn rotary_at(&mut self, counts: [Option<i64>; 3], free: bool) {
        for (axis, count) in counts.into_iter().enumerate() {
            if let Some(count) = count {
                self.modal.pen.rotary[axis] = Some(count);
                self.modal.rotary_axes.rotaries.set(axis, count);
            }
        }
        if free {
            self.modal.pen.rotary = [None; 3];
        }
    }

    /// The speed of a block that turns the tool axis: a time becomes the feed of the tip.
    fn tip_feed(&self, point: DVec3, state: &State) -> Result<Speed> {
        let Speed::Duration(seconds) = state.speed else { return Ok(state.speed) };
        let way = (point - DVec3::from_array(self.place.exact)).length();
        let usable = state.tcp != Tcp::Off && way > 0.0 && seconds > 0.0;
        if usable && (way / seconds).is_finite() {
            return Ok(Speed::PerMinute(way / seconds));
        }
        Err(unsupported("this control has no inverse time: the time of a block is written as the feed of the tip, \
                         which needs control of the tool centre point and a tip that moves from a known place")
            .help("give a feed per minute")
            .into())
    }

    /// Switches the control of the tool centre point; afterwards the place is not known.
    pub(in crate::nc::write) fn klartext_tcp(&mut self, tcp: Tcp) -> Result<()> {
        if self.modal.pen.tcp == tcp {
            return Ok(());
        }
        self.uncompensated("control of the tool centre point is switched")?;
        self.klartext_tcp_off();
        let word = match tcp {
            Tcp::Off => return Ok(()),
            Tcp::Axes => "M128",
            Tcp::Vector => "FUNCTION TCPM F TCP AXIS POS PATHCTRL VECTOR",
        };
        self.page.block(word.to_owned());
        self.modal.pen.tcp = tcp;
        self.unplace();
        Ok(())
    }

    /// Switches the control of the tool centre point off, if it is on.
    pub(in crate::nc::write) fn klartext_tcp_off(&mut self) {
        let word = match std::mem::take(&mut self.modal.pen.tcp) {
            Tcp::Off => return,
            Tcp::Axes => "M129",
            Tcp::Vector => "FUNCTION RESET TCPM",
        };
        self.page.block(word.to_owned());
        self.unplace();
    }

    fn unplace(&mut self) {
        self.place = ToolPosition::default();
        self.modal.pen.forget_place();
    }
}

/// Rotary axes in steps.
pub(in crate::nc::write) fn rotary_counts(angles: [Option<f64>; 3]) -> Result<[Option<i64>; 3]> {
    let mut counts = [None; 3];
    for (count, angle) in counts.iter_mut().zip(angles) {
        let Some(angle) = angle else { continue };
        let value = angle.to_degrees();
        if !(value.is_finite() && value.abs() <= MOST_DEGREES) {
            let finding = Finding::error(
                Code::POST_NUMBER,
                "a rotary axis does not fit the number format of the control",
            );
            return Err(finding.value(value, "deg").bound(MOST_DEGREES, "deg").into());
        }
        // Half turns keep their sign: they are positions, not directions.
        *count = Some((value / degrees(1)).round() as i64);
    }
    Ok(counts)
}

fn vector_words(axis: DVec3) -> Result<String> {
    if !((axis.length() - 1.0).abs() <= UNIT) {
        let finding = Finding::error(Code::POST_NUMBER, "a tool direction is not a unit vector");
        return Err(finding.value(axis.length(), "").bound(1.0, "").into());
    }
    let words = axis.to_array().into_iter().zip(TOOL_VECTOR).map(|(value, name)| {
        let text = format!("{value:+.VECTOR_DECIMALS$}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        let text = if matches!(text, "-0" | "+0" | "-" | "+") { "+0" } else { text };
        format!("{name}{text}")
    });
    Ok(words.collect::<Vec<_>>().join(" "))
}
