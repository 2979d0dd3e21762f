//! Shifted and turned frames: as the control's own words, or turned into the coordinates.
//!
//! Before anything is written, the frames of the program become what the control can say (its shift on the grid of
//! coordinates, its angle in so many decimals), and the points are given in those frames, so that rounding a shift or an
//! angle moves nothing. Only where an angle's rounding moves no point of its frame by more than a tenth of a step are
//! the points left as they are, and moves along the axes of the frame stay along those of the text. A control without
//! these words gets everything in its work offsets.
//!
//! The words are taken back before a tool change, a stop, a move in machine coordinates and the end, whatever the control
//! would allow: a person who stops there finds the coordinates of the work offset. The first move after they are said
//! names X, Y and Z where they are known, since controls differ in what a coordinate that is left out then means.

use glam::DVec3;

use crate::base::Result;
use crate::geom::Rigid;
use crate::nc::dialect::{AXES, Dialect, Plane, TurnWord};
use crate::nc::grid::Grid;
use crate::nc::heidenhain::plane as spatial;
use crate::nc::multi_axis::TiltWord;
use crate::nc::{PostSettings, turn};
use crate::program::{
    Frame, FrameId, Item, Program, RotarySolution, Speed, State, WorkOffset, moved, turn_about_z,
};

use super::plane::{self, Plane as Tilt, Root};
use super::{ToolPosition, Writer, unsupported};

/// Part of a step by which the rounding of an angle may move a point.
const UNSEEN: f64 = 0.1;
/// Shifts closer than this are equal [mm]: rounding of products of doubles at a kilometre.
const SAME: f64 = 1e-9;

/// A shift in steps of the grid and an angle in steps of its last decimal, or a shift and a tilted plane there; the
/// default: neither shift nor angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Turn {
    pub(super) ticks: i64,
    shift: [i64; 3],
    pub(super) tilt: Option<SpatialPlane>,
}

/// Spatial angles of a tilted plane, in steps of their last decimal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SpatialPlane {
    pub(super) angles: [i64; 3],
    pub(super) branch: RotarySolution,
}

impl Turn {
    fn is_shifted(&self) -> bool {
        self.shift != [0; 3]
    }

    fn motion(&self, dialect: &Dialect, grid: &Grid) -> Rigid {
        let shift = DVec3::from_array(self.shift.map(|c| grid.value(c)));
        let degrees = self.ticks as f64 / 10f64.powi(i32::from(dialect.angle_decimals));
        turn::motion(dialect.turn, shift, degrees)
    }
}

/// A program in frames that the control can say.
pub(super) struct Sayable {
    pub(super) program: Program,
    /// The words of each frame: a shift and a turn or spatial angles, or another tilted plane.
    pub(super) turns: Vec<Turn>,
    pub(super) planes: Vec<Option<Tilt>>,
    /// Largest distance by which the rounding of a plane's angles moves a point [mm].
    pub(super) tilt: f64,
}

/// The program in frames that the control can say; none where it is so already.
pub(super) fn supported(
    program: &Program,
    settings: &PostSettings,
    dialect: &Dialect,
    grid: &Grid,
) -> Result<Option<Sayable>> {
    if !program.frames.iter().any(|f| matches!(f, Frame::Shift { .. } | Frame::Tilted { .. })) {
        return Ok(None);
    }
    let reach = reach(program);
    let mut frames = program.frames.clone();
    let mut turns = vec![Turn::default(); frames.len()];
    let mut into = Vec::with_capacity(frames.len());
    let mut planes = vec![None; frames.len()];
    let mut tilt = 0.0f64;
    let multi = plane::with_rotaries(program);
    let far = plane::reach(program);
    for (index, frame) in program.frames.iter().enumerate() {
        let id = FrameId(index as u32);
        if let (Some((offset, motion, branch)), TurnWord::Cycles) = (program.in_tilted(id), dialect.turn) {
            let (turn, written) =
                tilted(&motion, branch, grid).map_err(|e| e.under(&format!("frame[{index}]")))?;
            let parent =
                frames.iter().position(|f| *f == Frame::Work(offset)).map_or(id, |i| FrameId(i as u32));
            frames[index] = Frame::Tilted { parent, motion: written, branch };
            turns[index] = turn;
            let (change, off) = plane::change(&written, &motion);
            tilt = tilt.max(off * far[index]);
            into.push((id, change));
            continue;
        }
        if let (Frame::Tilted { branch, .. }, true) = (frame, dialect.axes.tilt != TiltWord::None) {
            let (words, written, exact) = plane::words(program, id, *branch, dialect, grid)?;
            let (change, off) = plane::change(&written, &exact);
            tilt = tilt.max(off * far[index]);
            planes[index] = Some(words);
            into.push((id, change));
            continue;
        }
        match (frame, plane::root(program, id)) {
            (Frame::Shift { .. }, Root::Plane(plane, motion)) => {
                into.push((plane, motion));
                continue;
            }
            (Frame::Shift { .. }, Root::Askew) => {
                return Err(unsupported("a frame in a tilted plane is turned about another axis than its Z")
                    .help("give it as a tilted plane of its own")
                    .into());
            }
            _ => {}
        }
        let (Frame::Shift { .. }, Some((offset, motion))) = (frame, program.in_work(id)) else {
            into.push((id, Rigid::IDENTITY));
            continue;
        };
        let parent = frames.iter().position(|f| *f == Frame::Work(offset)).map_or(id, |i| FrameId(i as u32));
        let native = settings.rotation && dialect.turn != TurnWord::None && !multi[index];
        let turn = if native { rounded(&motion, dialect, grid)? } else { Turn::default() };
        if turn == Turn::default() {
            into.push((parent, motion));
            continue;
        }
        let written = turn.motion(dialect, grid);
        frames[index] = Frame::Shift { parent, motion: written };
        turns[index] = turn;
        let exact = written.inverse().after(&motion);
        let off = turn_about_z(&exact.rotation).unwrap_or(f64::INFINITY).abs();
        let moved_by = if off == 0.0 { 0.0 } else { off * reach[index] };
        let change = if moved_by <= UNSEEN * grid.unit() {
            let gap = written.rotation.transpose() * (motion.translation - written.translation);
            Rigid::from_translation(if gap.length() <= SAME { DVec3::ZERO } else { gap })
        } else {
            exact
        };
        into.push((id, change));
    }
    Ok(Some(Sayable { program: program.reframed(frames, &into)?, turns, planes, tilt }))
}

/// The nearest shift and spatial angles, and the motion that they are.
fn tilted(motion: &Rigid, branch: RotarySolution, grid: &Grid) -> Result<(Turn, Rigid)> {
    let Some(angles) = spatial::nearest_spatial(&motion.rotation) else {
        return Err(unsupported("the axes of a tilted plane are not at right angles, or left-handed").into());
    };
    let mut shift = [0; 3];
    for (count, value) in shift.iter_mut().zip(motion.translation.to_array()) {
        *count = grid.round(value)?;
    }
    let [a, b, c] = angles.map(spatial::degrees);
    let written = Rigid {
        rotation: spatial::spatial(a, b, c),
        translation: DVec3::from_array(shift.map(|c| grid.value(c))),
    };
    Ok((Turn { ticks: 0, shift, tilt: Some(SpatialPlane { angles, branch }) }, written))
}

/// The nearest shift and angle that the control can say.
fn rounded(motion: &Rigid, dialect: &Dialect, grid: &Grid) -> Result<Turn> {
    let angle = turn_about_z(&motion.rotation).unwrap_or(0.0);
    let scale = 10f64.powi(i32::from(dialect.angle_decimals));
    let ticks = (angle.to_degrees() * scale).round();
    // Half a turn has two signs.
    let ticks = if ticks == -180.0 * scale { -ticks } else { ticks } as i64;
    let degrees = ticks as f64 / scale;
    let turned = Rigid { rotation: turn::rotation(degrees), ..*motion };
    let shift = turn::shift(dialect.turn, &turned).to_array();
    let mut counts = [0; 3];
    for (count, value) in counts.iter_mut().zip(shift) {
        *count = grid.round(value)?;
    }
    Ok(Turn { ticks, shift: counts, tilt: None })
}

/// Largest distance of the points of each frame from its axis Z [mm].
fn reach(program: &Program) -> Vec<f64> {
    let mut reach = vec![0.0f64; program.frames.len()];
    for index in 0..program.items.len() {
        let Item::Move(motion) = program.items.get(index) else { continue };
        if let (Some(far), Some(most)) =
            (motion.reach(), reach.get_mut(program.state(index).frame.0 as usize))
        {
            *most = most.max(far);
        }
    }
    reach
}

impl Writer<'_> {
    /// Work offset and turn of the frame of a state.
    pub(super) fn frame_of(&self, state: &State) -> Result<(WorkOffset, Turn)> {
        if self.program.frames.get(state.frame.0 as usize).is_none() {
            return Err(unsupported("a state names a frame that the program does not have").into());
        }
        let turn = self.turns.get(state.frame.0 as usize).copied().unwrap_or_default();
        if let (Some((offset, ..)), Some(_)) = (self.program.in_tilted(state.frame), turn.tilt) {
            return Ok((offset, turn));
        }
        if let Some(plane) = self.plane_of(state) {
            return Ok((plane.offset, Turn::default()));
        }
        let Some((offset, _)) = self.program.in_work(state.frame) else {
            let title = self.settings.control.title();
            return Err(unsupported(format!(
                "{title} has no words for this frame: it is tilted or the machine's"
            ))
            .help("give the points in a work offset, or post to positions of the machine's axes")
            .into());
        };
        Ok((offset, turn))
    }

    /// Whether the words of a state's frame are those in force.
    pub(super) fn stays_in_frame(&self, state: &State) -> Result<bool> {
        let (offset, turn) = self.frame_of(state)?;
        Ok(self.modal.offset == Some(offset) && self.modal.turn == turn)
    }

    /// Writes the changes to the frame of a state; afterwards the place is that in this frame.
    pub(super) fn frame(&mut self, state: &State) -> Result<()> {
        let (offset, turn) = self.frame_of(state)?;
        if !(self.dialect.has_offset)(offset) {
            let message = format!("{} has no work offset {offset}", self.settings.control.title());
            return Err(unsupported(message).help("use G54 to G57").into());
        }
        match self.modal.owners.iter().find(|(o, _)| *o == offset) {
            Some((_, setup)) if *setup != state.setup => {
                return Err(unsupported(format!(
                    "two clampings share {offset}: the text cannot tell them apart"
                ))
                .help("give each clamping a work offset of its own")
                .into());
            }
            Some(_) => {}
            None => self.modal.owners.push((offset, state.setup)),
        }
        let other_offset = self.modal.offset != Some(offset);
        if other_offset || self.modal.turn != turn {
            self.uncompensated("the work offset or its rotation changes")?;
        }
        if self.modal.turn != turn || other_offset && self.modal.turn != Turn::default() {
            self.turn_off()?;
        }
        self.place_in(offset, turn);
        if other_offset {
            self.modal.offset = Some(offset);
            if self.klartext() {
                self.klartext_preset(offset);
            } else {
                self.page.block(offset.to_string());
            }
        }
        if self.modal.turn != turn {
            self.turn_on(offset, turn)?;
        }
        self.plane(state)
    }

    /// Gives the place in another frame: that of the same work offset is known.
    fn place_in(&mut self, offset: WorkOffset, turn: Turn) {
        let before = self.modal.placed_in.replace((offset, turn));
        if before == Some((offset, turn)) {
            return;
        }
        let exact = match before {
            // The tip's position in a plane depends on the rotary axes.
            Some((same, old)) if same == offset && old.tilt.is_none() && turn.tilt.is_none() => {
                let work = moved(&old.motion(self.dialect, &self.grid), DVec3::from_array(self.place.exact));
                moved(&turn.motion(self.dialect, &self.grid).inverse(), work).to_array()
            }
            _ => [f64::NAN; 3],
        };
        self.place = ToolPosition { written: [None; 3], exact };
        self.modal.pen.forget_place();
    }

    fn turn_on(&mut self, offset: WorkOffset, turn: Turn) -> Result<()> {
        if self.modal.plane != Some(Plane::Xy) && !self.klartext() {
            self.page.block(Plane::Xy.word().to_owned());
            self.modal.plane = Some(Plane::Xy);
        }
        let (turned, shifted) = (turn.ticks != 0, turn.is_shifted());
        match self.dialect.turn {
            TurnWord::None => {}
            TurnWord::Programmable => {
                if shifted {
                    let words = self.shift_words(turn.shift);
                    self.page.block(format!("TRANS {words}"));
                }
                if turned {
                    let word = if shifted { "AROT RPL=" } else { "ROT RPL=" };
                    let word = self.angle_word(word, turn.ticks)?;
                    self.page.block(word);
                }
            }
            TurnWord::Local => {
                if shifted {
                    let words = self.shift_words(turn.shift);
                    self.page.block(format!("G52 {words}"));
                }
                if turned {
                    let mut block = String::from("G68 ");
                    self.grid.word(&mut block, AXES[0], 0);
                    self.grid.word(&mut block, AXES[1], 0);
                    let word = self.angle_word("R", turn.ticks)?;
                    self.page.block(format!("{block} {word}"));
                }
            }
            TurnWord::Offset => {
                self.turns_kept = true;
                if turned {
                    let word = self.angle_word("R", turn.ticks)?;
                    self.page.block(format!("G10 L2 P{} {word}", number(offset)));
                }
                if shifted {
                    let words = self.shift_words(turn.shift);
                    self.page.block(format!("G52 {words}"));
                }
            }
            TurnWord::Cycles => {
                if shifted {
                    self.klartext_shift(turn.shift);
                }
                if turned {
                    let word = self.angle_word("ROT", turn.ticks)?;
                    self.klartext_rotation(&word);
                }
                if let Some(tilt) = turn.tilt {
                    self.klartext_plane(tilt)?;
                }
            }
        }
        self.modal.turn = turn;
        self.modal.motion = None;
        self.place.written = [None; 3];
        self.modal.pen.forget_place();
        Ok(())
    }

    /// Takes the words of a frame back, if there are any in force.
    pub(super) fn turn_off(&mut self) -> Result<()> {
        let turn = std::mem::take(&mut self.modal.turn);
        if turn == Turn::default() {
            return Ok(());
        }
        self.uncompensated("turned coordinates end")?;
        self.end_series();
        let (turned, shifted) = (turn.ticks != 0, turn.is_shifted());
        match (self.dialect.turn, self.modal.placed_in) {
            (TurnWord::None, _) => {}
            (TurnWord::Programmable, _) => {
                self.page.block(if shifted { "TRANS" } else { "ROT" }.to_owned());
            }
            (TurnWord::Local, _) => {
                if turned {
                    self.page.block("G69".to_owned());
                }
                if shifted {
                    let words = self.shift_words([0; 3]);
                    self.page.block(format!("G52 {words}"));
                }
            }
            (TurnWord::Offset, placed) => {
                if shifted {
                    let words = self.shift_words([0; 3]);
                    self.page.block(format!("G52 {words}"));
                }
                if let (true, Some((offset, _))) = (turned, placed) {
                    let word = self.angle_word("R", 0)?;
                    self.page.block(format!("G10 L2 P{} {word}", number(offset)));
                }
            }
            (TurnWord::Cycles, _) => {
                if turn.tilt.is_some() {
                    self.klartext_level();
                }
                if turned {
                    let word = self.angle_word("ROT", 0)?;
                    self.klartext_rotation(&word);
                }
                if shifted {
                    self.klartext_shift([0; 3]);
                }
            }
        }
        self.modal.motion = None;
        self.modal.pen.forget_place();
        Ok(())
    }

    /// Whether the rotation in force keeps arcs to the XY plane: FANUC's alarm 144.
    pub(super) fn turned_plane_only(&self) -> bool {
        self.dialect.turn == TurnWord::Local && self.modal.turn.ticks != 0
    }

    /// Before a curve, cycle or switch of the compensation under words of a frame that were just said: the present place
    /// in its coordinates, without a movement.
    pub(super) fn name_place(&mut self, speed: Speed) -> Result<()> {
        let unsaid = self.place.written.iter().any(Option::is_none);
        if unsaid && self.place.exact.iter().all(|v| v.is_finite()) {
            let wanted = self.modal.pen.hold();
            self.line(self.place.exact, speed)?;
            self.modal.pen.release(wanted);
        }
        Ok(())
    }

    /// Whether a state's frame differs from that in force only by its turn.
    pub(super) fn turns_for(&self, state: &State) -> Result<bool> {
        Ok(self.frame_of(state)?.1 != self.modal.turn)
    }

    fn shift_words(&self, shift: [i64; 3]) -> String {
        let mut words = String::new();
        for (axis, count) in AXES.into_iter().zip(shift) {
            self.grid.word(&mut words, axis, count);
        }
        words
    }

    fn angle_word(&self, word: &str, ticks: i64) -> Result<String> {
        let grid = Grid::new(self.dialect.angle_decimals, None, self.dialect.point)?;
        let mut text = String::new();
        let grid = if self.klartext() { grid.signed() } else { grid };
        grid.word(&mut text, word, ticks);
        Ok(text)
    }

    /// Says in the head what a rotation leaves behind that the control keeps beyond the program.
    pub(super) fn remark_turns(&mut self) {
        if self.turns_kept {
            let from = self.page.len();
            self.comment("Turned coordinates: G10 L2 R sets the rotation of the work offset itself, also beyond the program");
            self.comment(
                "A rotation set there before is lost. After an abort take it back: G10 L2 P0 R0, G52 X0 Y0 Z0",
            );
            self.page.bring_up(from, self.remarks_end);
        }
    }
}

/// The number of a work offset in `G10 L2 P`: G54 is 1, G59.3 is 9.
pub(super) fn number(offset: WorkOffset) -> u16 {
    match offset.tenths() {
        tenths @ ..=590 => (tenths - 530) / 10,
        tenths => tenths - 584,
    }
}
