//! Tilted planes: as the words of a control.
//!
//! A tilted frame is written from its work offset, whatever it was tilted in: its origin on the grid of coordinates, its
//! angles in so many decimals. Points are given from the rounded origin; what the rounding of the angles moves is noted
//! ([`PostNotes::tilt`](crate::nc::PostNotes)). A frame that is shifted within a plane has its points given in the plane.
//!
//! Nothing moves in a plane before the tool stands along it. The words are taken back before another plane or offset, a
//! tool change, a move in machine coordinates and the end; when they are said again and no rotary axis has moved, the
//! tool still stands along the plane. A change of plane makes every position unknown: where the tip is then depends on
//! the machine.

use glam::DVec3;

use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::nc::dialect::{AXES, Dialect, OFFSETS};
use crate::nc::grid::Grid;
use crate::nc::multi_axis::TiltWord;
use crate::nc::sinumerik::swivel;
use crate::nc::tilt::{self, XYZ, ZXZ};
use crate::program::{
    Frame, FrameId, Item, Move, Path, Program, RotarySolution, Speed, State, Target, Tcp, ToolAxis,
    WorkOffset, turn_about_z,
};

use super::{ToolPosition, Writer, unsupported};

/// Shifts closer than this are equal [mm]: rounding of products of doubles at a kilometre.
const SAME: f64 = 1e-9;

/// A tilted plane as its words say it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    pub(super) offset: WorkOffset,
    /// Origin, in steps of the grid.
    origin: [i64; 3],
    /// Angles, in steps of their last decimal.
    angles: [i64; 3],
    branch: RotarySolution,
}

/// Location of a frame.
pub(super) enum Root {
    /// In a tilted plane, by a motion about its Z.
    Plane(FrameId, Rigid),
    /// In a tilted plane, turned about another axis than its Z.
    Askew,
    /// Elsewhere.
    Flat,
}

/// Whether a frame lies in a tilted plane.
pub(super) fn root(program: &Program, frame: FrameId) -> Root {
    let mut motion = Rigid::IDENTITY;
    let mut at = frame;
    // A chain of frames is never longer than their list.
    for _ in 0..=program.frames.len() {
        match program.frames.get(at.0 as usize) {
            Some(Frame::Shift { parent, motion: own }) => {
                motion = own.after(&motion);
                at = *parent;
            }
            Some(Frame::Tilted { .. }) if turn_about_z(&motion.rotation).is_some() => {
                return Root::Plane(at, motion);
            }
            Some(Frame::Tilted { .. }) => return Root::Askew,
            _ => return Root::Flat,
        }
    }
    Root::Flat
}

/// The work offset that a frame lies in, whatever the frames between, and the motion into it.
fn in_offset(program: &Program, frame: FrameId) -> Option<(WorkOffset, Rigid)> {
    let mut motion = Rigid::IDENTITY;
    let mut at = frame;
    for _ in 0..=program.frames.len() {
        match *program.frames.get(at.0 as usize)? {
            Frame::Work(offset) => return Some((offset, motion)),
            Frame::Shift { parent, motion: own } | Frame::Tilted { parent, motion: own, .. } => {
                motion = own.after(&motion);
                at = parent;
            }
            _ => return None,
        }
    }
    None
}

/// The words of a tilted frame, and the motion that they make into the work offset; `exact` is the one that is meant.
pub(super) fn words(
    program: &Program,
    frame: FrameId,
    branch: RotarySolution,
    dialect: &Dialect,
    grid: &Grid,
) -> Result<(Plane, Rigid, Rigid)> {
    let Some((offset, exact)) = in_offset(program, frame) else {
        return Err(unsupported("a tilted plane that lies in no work offset")
            .help("give it in a work offset")
            .into());
    };
    let square = (exact.rotation * exact.rotation.transpose() - glam::DMat3::IDENTITY).to_cols_array();
    if !exact.translation.is_finite()
        || !square.iter().all(|v| v.abs() < SAME)
        || !(exact.rotation.determinant() > 0.0)
    {
        return Err(Finding::error(Code::NC_STATE, "a tilted plane is no rotation")
            .value(exact.rotation.determinant(), "determinant")
            .bound(1.0, "")
            .into());
    }
    let order = if dialect.axes.tilt == TiltWord::Feature { ZXZ } else { XYZ };
    let scale = 10f64.powi(i32::from(dialect.axes.tilt_decimals));
    let angles = tilt::ticks(order, &exact.rotation, scale);
    let mut origin = [0; 3];
    for (count, value) in origin.iter_mut().zip(exact.translation.to_array()) {
        *count = grid.round(value)?;
    }
    let rotation = tilt::turning(order, angles.map(|t| t as f64 / scale));
    let translation = DVec3::from_array(origin.map(|c| grid.value(c)));
    Ok((Plane { offset, origin, angles, branch }, Rigid { rotation, translation }, exact))
}

/// The shift that gives points of the meant plane in the written one, and how far its angles are off [rad].
pub(super) fn change(written: &Rigid, exact: &Rigid) -> (Rigid, f64) {
    let gap = written.rotation.transpose() * (exact.translation - written.translation);
    let off = written.rotation.transpose() * exact.rotation;
    let skew =
        DVec3::new(off.y_axis.z - off.z_axis.y, off.z_axis.x - off.x_axis.z, off.x_axis.y - off.y_axis.x);
    let gap = if gap.length() <= SAME { DVec3::ZERO } else { gap };
    (Rigid::from_translation(gap), 0.5 * skew.length())
}

/// Largest distance of a point from the origin of each frame [mm].
pub(super) fn reach(program: &Program) -> Vec<f64> {
    let mut reach = vec![0.0f64; program.frames.len()];
    for index in 0..program.items.len() {
        if let Item::Move(Move { end: Target::Tip { point, .. }, .. }) = program.items.get(index)
            && let Some(most) = reach.get_mut(program.state(index).frame.0 as usize)
        {
            *most = point.to_array().iter().filter(|v| v.is_finite()).fold(*most, |m, v| m.max(v.abs()));
        }
    }
    reach
}

/// Frames in which rotary axes move or the tip is controlled: their coordinates are given in the work offset.
pub(super) fn with_rotaries(program: &Program) -> Vec<bool> {
    let mut used = vec![false; program.frames.len()];
    for index in 0..program.items.len() {
        let state = program.state(index);
        let turned = matches!(program.items.get(index),
            Item::Move(Move { end: Target::Tip { axis, .. }, .. }) if axis != ToolAxis::Fixed);
        if let (true, Some(frame)) = (turned || state.tcp != Tcp::Off, used.get_mut(state.frame.0 as usize)) {
            *frame = true;
        }
    }
    used
}

impl Writer<'_> {
    /// The words of the plane of a state, if its frame is one.
    pub(super) fn plane_of(&self, state: &State) -> Option<Plane> {
        self.planes.get(state.frame.0 as usize).copied().flatten()
    }

    /// Says a plane; `turn`: the rotary axes turn along it too, where that is one word.
    fn plane_on(&mut self, plane: Plane, turn: bool) -> Result<()> {
        self.uncompensated("a tilted plane comes")?;
        self.end_series();
        if self.modal.plane != Some(crate::nc::dialect::Plane::Xy) {
            self.page.block("G17".to_owned());
            self.modal.plane = Some(crate::nc::dialect::Plane::Xy);
        }
        match self.dialect.axes.tilt {
            TiltWord::None => {
                let title = self.settings.control.title();
                return Err(unsupported(format!("{title} has no words for a tilted plane"))
                    .help("post to positions of the machine's axes")
                    .into());
            }
            TiltWord::Feature => {
                let mut block = String::from("G68.2 ");
                for (axis, count) in AXES.into_iter().zip(plane.origin) {
                    self.grid.word(&mut block, axis, count);
                }
                let angles = self.angle_grid()?;
                for (word, ticks) in OFFSETS.into_iter().zip(plane.angles) {
                    angles.word(&mut block, word, ticks);
                }
                self.page.block(block);
            }
            TiltWord::Swivel => {
                let (mut call, direction) = swivel::written(turn.then_some(plane.branch));
                let angles = self.angle_grid()?;
                for (grid, counts) in [(&self.grid, plane.origin), (&angles, plane.angles)] {
                    for count in counts {
                        call.push(',');
                        call.push_str(&grid.text(count));
                    }
                }
                self.page.block(format!("{call},0,0,0,{direction})"));
            }
        }
        self.modal.rotary_axes.plane = Some(plane);
        self.lose_place();
        Ok(())
    }

    fn angle_grid(&self) -> Result<Grid> {
        Grid::new(self.dialect.axes.tilt_decimals, None, self.dialect.point)
    }

    /// Takes the words of a plane back, if there are any in force.
    pub(super) fn plane_off(&mut self) -> Result<()> {
        if self.modal.rotary_axes.plane.take().is_none() {
            return Ok(());
        }
        self.uncompensated("a tilted plane ends")?;
        self.end_series();
        let word = match self.dialect.axes.tilt {
            TiltWord::Swivel => "CYCLE800()",
            _ => "G69",
        };
        self.page.block(word.to_owned());
        self.lose_place();
        Ok(())
    }

    /// No position is known any more.
    pub(super) fn lose_place(&mut self) {
        self.place = ToolPosition::default();
        self.modal.motion = None;
        self.modal.rotary_axes.forget_words();
        self.modal.pen.forget_place();
    }

    /// Says the plane of a state, for moves in it.
    pub(super) fn plane(&mut self, state: &State) -> Result<()> {
        let Some(plane) = self.plane_of(state) else { return Ok(()) };
        if self.modal.rotary_axes.plane != Some(plane) && !self.modal.rotary_axes.orienting {
            if !self.stands_along(&plane) {
                return Err(not_along());
            }
            self.plane_on(plane, false)?;
        }
        Ok(())
    }

    /// Whether the rotary axes stand as a plane has turned them that is parallel to this one.
    fn stands_along(&self, plane: &Plane) -> bool {
        let along = self.modal.rotary_axes.along;
        along.is_some_and(|p| p.offset == plane.offset && p.angles == plane.angles)
    }

    /// Refuses a move in a plane along which the tool does not stand.
    pub(super) fn along_plane(&self) -> Result<()> {
        match &self.modal.rotary_axes.plane {
            Some(plane) if !self.stands_along(plane) => Err(not_along()),
            _ => Ok(()),
        }
    }

    /// Turns the rotary axes until the tool stands along the plane of a state.
    pub(super) fn orient(&mut self, motion: &Move, state: &State) -> Result<()> {
        let Some(plane) = self.plane_of(state) else {
            let finding = match self.dialect.axes.tilt {
                TiltWord::None => {
                    let title = self.settings.control.title();
                    unsupported(format!("{title} has no words for a tilted plane"))
                }
                _ => {
                    Finding::error(Code::NC_STATE, "the tool is turned along a frame that is no tilted plane")
                }
            };
            return Err(finding.help("post to positions of the machine's axes").into());
        };
        if motion.path != Path::Line || !matches!(state.speed, Speed::Rapid { .. }) {
            return Err(unsupported("rotary axes turn along a plane by a straight rapid move").into());
        }
        self.uncompensated("the tool is turned along a plane")?;
        self.modal.rotary_axes.orienting = true;
        let said = self.state(state, true);
        self.modal.rotary_axes.orienting = false;
        said?;
        match self.dialect.axes.tilt {
            TiltWord::Swivel => self.plane_on(plane, true)?,
            _ => {
                if self.modal.rotary_axes.plane != Some(plane) {
                    self.plane_on(plane, true)?;
                }
                // Under G1 it would turn at the feed of the path.
                self.page.block("G0".to_owned());
                let choice = match plane.branch {
                    RotarySolution::Free => "",
                    RotarySolution::Positive => " P1",
                    RotarySolution::Negative => " P2",
                };
                self.page.block(format!("G53.1{choice}"));
            }
        }
        self.modal.rotary_axes.rotaries.swing();
        self.modal.rotary_axes.along = Some(plane);
        self.lose_place();
        Ok(())
    }
}

fn not_along() -> crate::base::Error {
    Finding::error(Code::NC_STATE, "a move in a tilted plane along which the tool does not stand")
        .help("turn the tool along the plane first (Target::Orient)")
        .into()
}
