//! Rotary axes and control of the tool centre point.
//!
//! Every rotary axis whose number changes is written, and one whose place the control may have forgotten is taken for
//! changed. A move whose tool axis is Z of the work offset is refused while a rotary axis stands elsewhere: the writer
//! adds no motion to bring it back. A feed is written as it is given: without control of the tip only that in inverse time
//! means the same on every control.
//!
//! Control of the tool centre point begins at the first move that wants it and ends before a plane, another work offset,
//! a tool change, a move in machine coordinates and the end. Both change what coordinates mean: every position is unknown
//! then. FANUC has it as another call of the tool length, one for angles and one for vectors; when it ends the plain length
//! is called again with the next Z.

use glam::DVec3;

use crate::base::{Code, Finding, Result};
use crate::nc::grid::Grid;
use crate::nc::multi_axis::{Rotaries, TcpWord};
use crate::program::{Comp, State, Tcp, ToolAxis};

use super::plane::Plane;
use super::{Writer, unsupported};

/// Difference of a tool axis from a unit vector: rounding of numbers with six decimals.
const UNIT: f64 = 1e-5;

/// Rotary axes, tilted plane and tip as written to the control; modal.
#[derive(Clone, Debug, Default)]
pub(super) struct RotaryAxes {
    /// Places of the rotary axes, in steps.
    pub(super) rotaries: Rotaries<i64>,
    /// Which of them need not be said again.
    said: [bool; 3],
    /// Words of the rotary axes for the next block of motion.
    pub(super) words: String,
    /// Tool axis that was said last, in steps.
    vector: Option<[i64; 3]>,
    /// Control of the tip, and whether the tool axis is a vector under it.
    tcp: Tcp,
    by_vector: bool,
    /// Plane in force.
    pub(super) plane: Option<Plane>,
    /// Plane along which the rotary axes have turned the tool.
    pub(super) along: Option<Plane>,
    /// The block that turns it says the plane too.
    pub(super) orienting: bool,
}

impl RotaryAxes {
    /// Every rotary axis is said again.
    pub(super) fn forget_words(&mut self) {
        self.said = [false; 3];
    }

    /// Whether the tool axis is a vector in each block.
    pub(super) fn takes_vectors(&self) -> bool {
        self.tcp != Tcp::Off && self.by_vector
    }

    /// Whether coordinates mean the same.
    pub(super) fn same_coordinates(&self, other: &RotaryAxes) -> bool {
        self.tcp == other.tcp && self.by_vector == other.by_vector && self.plane == other.plane
    }

    /// After a tool change.
    pub(super) fn after_tool(&self) -> RotaryAxes {
        RotaryAxes {
            rotaries: self.rotaries,
            along: self.along,
            vector: self.vector,
            ..RotaryAxes::default()
        }
    }
}

impl Writer<'_> {
    /// Steps of a rotary axis.
    fn rotary_grid(&self) -> Result<Option<([&'static str; 3], Grid)>> {
        let Some((words, decimals)) = self.dialect.axes.rotary else { return Ok(None) };
        Ok(Some((words, Grid::new(decimals, None, self.dialect.point)?)))
    }

    fn no_rotaries(&self) -> crate::base::Error {
        let title = self.settings.control.title();
        unsupported(format!("{title} has no rotary axes")).help("use another control").into()
    }

    /// The word of a rotary axis and its place; always where `always`.
    pub(super) fn rotary(&mut self, words: &mut String, axis: usize, angle: f64, always: bool) -> Result<()> {
        let Some((names, grid)) = self.rotary_grid()? else { return Err(self.no_rotaries()) };
        let degrees = angle.to_degrees();
        if !(degrees.is_finite() && degrees.abs() <= MOST_DEGREES) {
            return Err(Finding::error(
                Code::POST_NUMBER,
                "an angle does not fit the number format of the control",
            )
            .value(degrees, "deg")
            .bound(MOST_DEGREES, "deg")
            .into());
        }
        let count = grid.round(degrees)?;
        self.beyond_turn |= degrees.abs() > 360.0;
        let rotary_axes = &mut self.modal.rotary_axes;
        let moves = rotary_axes.rotaries.at[axis] != Some(count);
        if moves {
            rotary_axes.along = None;
            rotary_axes.vector = None;
        }
        if always || moves || !rotary_axes.said[axis] {
            grid.word(words, names[axis], count);
        }
        rotary_axes.rotaries.set(axis, count);
        rotary_axes.said[axis] = !always;
        Ok(())
    }

    /// Whether the tool stands along Z of the work offset.
    pub(super) fn upright(&self) -> bool {
        let whole = self.dialect.axes.rotary.map_or(1, |r| 360 * 10i64.pow(u32::from(r.1)));
        let rotary_axes = &self.modal.rotary_axes;
        match rotary_axes.vector {
            Some([0, 0, z]) => z > 0,
            Some(_) => false,
            None => rotary_axes.rotaries.upright(|count| count % whole == 0),
        }
    }

    /// The tool axis of a move that turns nothing.
    pub(super) fn kept_axis(&self) -> ToolAxis {
        let rotary_axes = &self.modal.rotary_axes;
        let tilted = rotary_axes.plane.is_some() || self.modal.turn.tilt.is_some();
        if tilted || self.upright() { ToolAxis::Fixed } else { ToolAxis::Rotary([None; 3]) }
    }

    /// Takes back what the words of a state do not need any more of tip control and plane.
    pub(super) fn rotary_axes_for(&mut self, state: &State) -> Result<()> {
        let plane = self.plane_of(state);
        if plane.is_some() && state.tcp != Tcp::Off {
            return Err(unsupported("control of the tool centre point in a tilted plane")
                .help("give the points in the work offset")
                .into());
        }
        let offset = self.program.in_work(state.frame).map(|f| f.0).or(plane.map(|p| p.offset));
        if state.tcp == Tcp::Off || plane.is_some() || offset != self.modal.offset {
            self.tcp_off()?;
        }
        if self.modal.rotary_axes.plane != plane {
            self.plane_off()?;
        }
        Ok(())
    }

    /// Control of the tip and the words of the tool axis for a move.
    pub(super) fn tool_axis(&mut self, axis: ToolAxis, state: &State) -> Result<()> {
        self.along_plane()?;
        self.tcp_on(&axis, state)?;
        let mut words = String::new();
        match axis {
            ToolAxis::Fixed if self.modal.rotary_axes.plane.is_some() || self.upright() => {}
            ToolAxis::Fixed => {
                return Err(Finding::error(
                    Code::NC_STATE,
                    "a move with the tool along Z while the rotary axes stand elsewhere",
                )
                .help("turn them back by a move that names them")
                .into());
            }
            ToolAxis::Rotary(angles) => {
                for (letter, angle) in angles.into_iter().enumerate() {
                    let Some(angle) = angle else { continue };
                    if self.modal.rotary_axes.plane.is_some() {
                        return Err(unsupported("a rotary axis moves in a tilted plane")
                            .help("leave the plane first")
                            .into());
                    }
                    self.rotary(&mut words, letter, angle, false)?;
                }
            }
            ToolAxis::Vector(v) => self.vector(&mut words, v)?,
        }
        self.modal.rotary_axes.words = words;
        Ok(())
    }

    fn vector(&mut self, words: &mut String, v: DVec3) -> Result<()> {
        if self.modal.rotary_axes.tcp == Tcp::Off {
            return Err(unsupported(
                "a tool axis given as a vector without control of the tool centre point",
            )
            .help("give the angles of the rotary axes, or switch it on")
            .into());
        }
        let Some((names, decimals)) = self.dialect.axes.vector else {
            let title = self.settings.control.title();
            return Err(unsupported(format!("{title} has no words for a tool axis as a vector"))
                .help("give the angles of the rotary axes")
                .into());
        };
        if !((v.length() - 1.0).abs() <= UNIT) {
            return Err(Finding::error(Code::NC_STATE, "a tool axis is no unit vector")
                .value(v.length(), "")
                .bound(1.0, "")
                .into());
        }
        let grid = Grid::new(decimals, None, self.dialect.point)?;
        let mut counts = [0; 3];
        for ((count, value), name) in counts.iter_mut().zip(v.to_array()).zip(names) {
            *count = grid.round(value)?;
            grid.word(words, name, *count);
        }
        let rotary_axes = &mut self.modal.rotary_axes;
        rotary_axes.rotaries.swing();
        rotary_axes.along = None;
        rotary_axes.vector = Some(counts);
        Ok(())
    }

    fn tcp_on(&mut self, axis: &ToolAxis, state: &State) -> Result<()> {
        if state.tcp == Tcp::Off {
            return Ok(());
        }
        if state.comp != Comp::Off || self.modal.comp.is_some() {
            return Err(Finding::error(
                Code::COMPENSATION,
                "cutter compensation under control of the tool centre point",
            )
            .help("give the path of the tool centre")
            .into());
        }
        let rotary_axes = &self.modal.rotary_axes;
        let by_vector = match axis {
            ToolAxis::Vector(_) => true,
            ToolAxis::Rotary(angles) if angles.iter().any(Option::is_some) => false,
            _ => rotary_axes.by_vector,
        };
        let on = rotary_axes.tcp != Tcp::Off;
        match self.dialect.axes.tcp {
            TcpWord::None => {
                let title = self.settings.control.title();
                return Err(unsupported(format!(
                    "{title} has no words for control of the tool centre point"
                ))
                .help("post to positions of the machine's axes")
                .into());
            }
            TcpWord::Length => {
                if state.tcp == Tcp::Vector {
                    return Err(unsupported("this control does not turn the tool axis in a plane")
                        .help("divide the move and let the rotary axes go straight (Tcp::Axes)")
                        .into());
                }
                if on && rotary_axes.by_vector == by_vector {
                    return Ok(());
                }
                self.tcp_off()?;
                let Some(register) = self.length else {
                    return Err(Finding::error(
                        Code::NC_STATE,
                        "control of the tool centre point without a tool length",
                    )
                    .help("call the tool with its length register")
                    .into());
                };
                let word = if by_vector { "G43.5 H" } else { "G43.4 H" };
                self.page.block(format!("{word}{register}"));
                self.length_pending = None;
                self.lose_place();
            }
            TcpWord::Transformation => {
                if on && rotary_axes.tcp == state.tcp {
                    self.modal.rotary_axes.by_vector = by_vector;
                    return Ok(());
                }
                if !on {
                    self.page.block("TRAORI".to_owned());
                    self.lose_place();
                }
                self.page.block(if state.tcp == Tcp::Vector { "ORIVECT" } else { "ORIAXES" }.to_owned());
            }
        }
        self.modal.rotary_axes.tcp = state.tcp;
        self.modal.rotary_axes.by_vector = by_vector;
        Ok(())
    }

    /// Ends control of the tip, if it is on.
    pub(super) fn tcp_off(&mut self) -> Result<()> {
        if self.modal.rotary_axes.tcp == Tcp::Off {
            return Ok(());
        }
        self.end_series();
        self.modal.rotary_axes.tcp = Tcp::Off;
        self.modal.rotary_axes.by_vector = false;
        match self.dialect.axes.tcp {
            TcpWord::Length => {
                self.page.block(self.dialect.length_off.to_owned());
                // The length that the program has called stays the program's.
                if let Some(register) = self.length {
                    self.length_pending = Some(format!("{}{register}", self.dialect.length_on));
                }
            }
            _ => self.page.block("TRAFOOF".to_owned()),
        }
        self.lose_place();
        Ok(())
    }

    /// Says in the head what a rotary axis beyond a whole turn counts on.
    pub(super) fn remark_whole_turns(&mut self) {
        let remark = self.dialect.axes.whole_turns;
        if self.beyond_turn && !remark.is_empty() {
            let from = self.page.len();
            self.comment(remark);
            self.page.bring_up(from, self.remarks_end);
        }
    }

    /// Takes back control of the tip and plane.
    pub(super) fn rotary_axes_off(&mut self) -> Result<()> {
        self.tcp_off()?;
        self.plane_off()
    }
}

/// Largest angle written [deg]: more turns than a rotary axis counts.
const MOST_DEGREES: f64 = 99_999.0;
