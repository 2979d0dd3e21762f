//! The same program with its points given in other frames.
//!
//! A frame moved within a work offset is looked up to its root: [`Program::in_work`]. A writer that cannot say a frame,
//! or only one near it, has the points given in what it can say: [`Program::reframed`]. The path on the machine stays the
//! same to the rounding of doubles; curves stay exact.

use glam::{DMat3, DVec2, DVec3};

use super::{
    ControlData, Cycle, Frame, FrameId, Item, Move, Origin, Path, Program, RotarySolution, Target, ToolAxis,
    WorkOffset,
};
use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;

/// Largest difference of an element of a matrix from that of a turn about Z: rounding of products of a few turns.
const EXACT: f64 = 1e-12;

/// Angle of a rotation about Z [rad], if it is one.
///
/// ```
/// # use kinecut_nc as kinecut;
/// use glam::DMat3;
/// use kinecut::program::turn_about_z;
/// assert!((turn_about_z(&DMat3::from_rotation_z(0.3)).unwrap() - 0.3).abs() < 1e-15);
/// assert!(turn_about_z(&DMat3::from_rotation_x(0.3)).is_none());
/// ```
pub fn turn_about_z(rotation: &DMat3) -> Option<f64> {
    let [x, y, z] = [rotation.x_axis, rotation.y_axis, rotation.z_axis];
    let upright = (z - DVec3::Z).length() <= EXACT && x.z.abs() <= EXACT && y.z.abs() <= EXACT;
    let square = (y - DVec3::new(-x.y, x.x, 0.0)).length() <= EXACT && (x.length() - 1.0).abs() <= EXACT;
    (upright && square).then(|| x.y.atan2(x.x))
}

impl Program {
    /// The work offset that a frame lies in, and the motion that maps the frame's points into it; none for frames that
    /// lie in no work offset, are tilted, or are turned about another axis than Z.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use glam::DVec3;
    /// use kinecut::geom::Rigid;
    /// use kinecut::program::{Frame, Program, WorkOffset};
    /// let mut program = Program::default();
    /// let parent = program.add_frame(Frame::Work(WorkOffset::G54));
    /// let motion = Rigid::from_translation(DVec3::X);
    /// let once = program.add_frame(Frame::Shift { parent, motion });
    /// let twice = program.add_frame(Frame::Shift { parent: once, motion });
    /// assert_eq!(program.in_work(twice).unwrap().1.point(DVec3::ZERO), DVec3::X * 2.0);
    /// ```
    pub fn in_work(&self, frame: FrameId) -> Option<(WorkOffset, Rigid)> {
        let mut motion = Rigid::IDENTITY;
        let mut at = frame;
        // A chain of frames is never longer than their list.
        for _ in 0..=self.frames.len() {
            match *self.frames.get(at.0 as usize)? {
                Frame::Work(offset) => {
                    let upright = turn_about_z(&motion.rotation).is_some();
                    return (upright && motion.translation.is_finite()).then_some((offset, motion));
                }
                Frame::Shift { parent, motion: own } => {
                    motion = own.after(&motion);
                    at = parent;
                }
                _ => return None,
            }
        }
        None
    }

    /// Whether a frame lies in a work offset, as far as [`Program::in_work`] tells it.
    pub(crate) fn is_in(&self, offset: WorkOffset, frame: FrameId) -> bool {
        self.in_work(frame).is_some_and(|(found, _)| found == offset)
    }

    /// The work offset that a frame lies in, the motion that maps the frame's points into it, and the choice of the rotary
    /// axes' solution, for a frame that is tilted or lies in one that is; none for all others.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use glam::{DMat3, DVec3};
    /// use kinecut::geom::Rigid;
    /// use kinecut::program::{RotarySolution, Frame, Program, WorkOffset};
    /// let mut program = Program::default();
    /// let parent = program.add_frame(Frame::Work(WorkOffset::G54));
    /// let rotation = DMat3::from_rotation_x(0.5);
    /// let motion = Rigid { rotation, translation: DVec3::X };
    /// let tilted = program.add_frame(Frame::Tilted { parent, motion, branch: RotarySolution::Negative });
    /// assert_eq!(program.in_tilted(tilted), Some((WorkOffset::G54, motion, RotarySolution::Negative)));
    /// assert!(program.in_tilted(parent).is_none());
    /// ```
    pub fn in_tilted(&self, frame: FrameId) -> Option<(WorkOffset, Rigid, RotarySolution)> {
        let (mut motion, mut branch) = (Rigid::IDENTITY, None);
        let mut at = frame;
        // A chain of frames is never longer than their list.
        for _ in 0..=self.frames.len() {
            let (parent, own) = match *self.frames.get(at.0 as usize)? {
                Frame::Work(offset) => {
                    return branch.filter(|_| motion.translation.is_finite()).map(|b| (offset, motion, b));
                }
                Frame::Shift { parent, motion: own } => (parent, own),
                Frame::Tilted { parent, motion: own, branch: choice } => {
                    // The innermost tilt decides on the solution of the rotary axes.
                    branch = branch.or(Some(choice));
                    (parent, own)
                }
                Frame::Machine => return None,
            };
            motion = own.after(&motion);
            at = parent;
        }
        None
    }

    /// The same program, item for item, with the points of each frame given in another one of the same work offset.
    ///
    /// `frames` are those of the new program; `into` gives for each frame of this one the new frame and the motion that
    /// maps the old frame's points into it, which turns about Z only.
    ///
    /// # Errors
    /// `KC0204` for a move that names only one of X and Y where the other is not known and the motion turns, or for a
    /// motion that turns about another axis; those of [`Program::push_cycle`].
    pub fn reframed(&self, frames: Vec<Frame>, into: &[(FrameId, Rigid)]) -> Result<Program> {
        let mut new = Program::new(self.setups.clone());
        new.frames = frames;
        let mut place = TipPosition::default();
        for index in 0..self.items.len() {
            let mut state = *self.state(index);
            let origin: Origin = self.origin(index);
            let known = into.get(state.frame.0 as usize).copied();
            let (frame, motion) = known.unwrap_or((state.frame, Rigid::IDENTITY));
            let angle = turn_about_z(&motion.rotation).ok_or_else(|| {
                Finding::error(Code::NC_STATE, "a frame is turned about another axis than Z")
                    .item(index as u32)
            })?;
            let (root, before) = (self.in_work(state.frame), state.frame);
            state.frame = frame;
            match self.items.get(index) {
                Item::Move(mut one) => {
                    if let Target::Tip { point, axis } = &mut one.end {
                        place.enter(root.map(|r| r.0), before, state.setup.0);
                        let to_work = root.map_or(Rigid::IDENTITY, |r| r.1);
                        let said = place.fill(*point, &to_work);
                        if angle != 0.0 && said.x.is_nan() != said.y.is_nan() {
                            return Err(Finding::error(
                                Code::NC_STATE,
                                "a move in turned coordinates names only one of X and Y where the other is not known",
                            )
                            .item(index as u32)
                            .help("give both")
                            .into());
                        }
                        place.at = moved(&to_work, said);
                        // A coordinate that stays must not be given in a frame that is merely shifted.
                        let said = if angle == 0.0 { *point } else { said };
                        *point = moved(&motion, said);
                        if let ToolAxis::Vector(v) = axis {
                            *v = motion.vector(*v);
                        }
                        one.path = turned(&one.path, &motion, angle);
                    } else if let Target::Joints(joints) = one.end {
                        for (axis, joint) in joints.iter().take(3).enumerate() {
                            if joint.is_some() {
                                place.at[axis] = f64::NAN;
                            }
                        }
                    } else {
                        place.at = DVec3::NAN;
                    }
                    new.push_move(one, &state, origin);
                }
                Item::Cycle(cycle, _) => {
                    let raised = cycle.raised(motion.translation.z);
                    new.push_cycle(raised, &state, origin)?;
                    place.at.z = f64::NAN;
                }
                Item::Tool { id, length, radius, again } => {
                    place.at = DVec3::NAN;
                    new.push_tool(id, length, radius, &state, origin);
                    if again {
                        new.change_again();
                    }
                }
                Item::Dwell(seconds) => new.push_dwell(seconds, &state, origin),
                Item::Stop(kind) => new.push_stop(kind, &state, origin),
                Item::Text(text) => new.push_text(text, &state, origin),
                Item::Message(text) => new.push_message(text, &state, origin),
                Item::Data(data) => {
                    if let ControlData::Here { .. } | ControlData::Probe { .. } = data {
                        place.at = DVec3::NAN;
                    }
                    new.push_data(data, &state, origin);
                }
            }
        }
        Ok(new)
    }
}

/// The tip in the coordinates of a work offset, not a number where unknown.
struct TipPosition {
    at: DVec3,
    /// Work offset, or the frame that lies in none, and setup.
    inside: (Option<WorkOffset>, FrameId, u32),
}

impl Default for TipPosition {
    fn default() -> TipPosition {
        TipPosition { at: DVec3::NAN, inside: (None, FrameId(0), 0) }
    }
}

impl TipPosition {
    fn enter(&mut self, offset: Option<WorkOffset>, frame: FrameId, setup: u32) {
        let inside = (offset, if offset.is_some() { FrameId(0) } else { frame }, setup);
        if self.inside != inside {
            *self = TipPosition { at: DVec3::NAN, inside };
        }
    }

    /// A point with the coordinates that stay filled in where they are known.
    fn fill(&self, point: DVec3, to_work: &Rigid) -> DVec3 {
        let here = moved(&to_work.inverse(), self.at);
        let pick = |said: f64, stays: f64| if said.is_nan() { stays } else { said };
        DVec3::new(pick(point.x, here.x), pick(point.y, here.y), pick(point.z, here.z))
    }
}

/// A point under a motion about Z; an unknown coordinate does not spread from Z to X and Y or back.
pub(crate) fn moved(motion: &Rigid, p: DVec3) -> DVec3 {
    let flat = motion.rotation * p.truncate().extend(0.0);
    if motion.rotation == DMat3::IDENTITY {
        return p + motion.translation;
    }
    DVec3::new(flat.x + motion.translation.x, flat.y + motion.translation.y, p.z + motion.translation.z)
}

fn turned(path: &Path, motion: &Rigid, angle: f64) -> Path {
    let shift = motion.translation.truncate();
    let flat = |p: DVec2| motion.point(p.extend(0.0)).truncate();
    match *path {
        Path::Arc { centre, axis, sweep, rise } => {
            Path::Arc { centre: motion.point(centre), axis: motion.vector(axis), sweep, rise }
        }
        Path::Involute { record, rise } => {
            Path::Involute { record: record.rotated(angle).shifted(shift), rise }
        }
        Path::Spiral { spiral, rise } => Path::Spiral { spiral: spiral.rotated(angle).shifted(shift), rise },
        Path::Bezier { span } => Path::Bezier { span: span.mapped(flat) },
        Path::Line => Path::Line,
    }
}

impl Cycle {
    /// The same cycle with all its heights raised [mm].
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::program::{Cycle, CycleStep};
    /// let hole = Cycle::Drill { reference: 2.0, bottom: -10.0, retract: 5.0, dwell: 0.0 };
    /// assert_eq!(hole.raised(1.0).expansion().unwrap()[1], CycleStep::Feed(-9.0));
    /// ```
    #[must_use]
    pub fn raised(&self, by: f64) -> Cycle {
        let mut cycle = *self;
        for height in cycle.heights_mut() {
            *height += by;
        }
        if let Cycle::DeepHole(hole) = &mut cycle {
            hole.first += by;
        }
        cycle
    }
}

impl Move {
    /// Largest distance of a point of the move's end or curve from the axis Z of its frame [mm]; an upper bound for
    /// curves, infinite where only one of X and Y is known; `None` for a move in machine coordinates.
    pub(crate) fn reach(&self) -> Option<f64> {
        let Target::Tip { point, .. } = self.end else { return None };
        let end = match (point.x.is_nan(), point.y.is_nan()) {
            (false, false) => point.truncate().length(),
            (true, true) => 0.0,
            _ => f64::INFINITY,
        };
        Some(match self.path {
            Path::Arc { centre, .. } => {
                let centre = centre.truncate();
                end.max(centre.length() + (point.truncate() - centre).length())
            }
            Path::Involute { record, .. } => end.max(record.start().length() + record.length()),
            Path::Spiral { spiral, .. } => end.max(spiral.start().length() + spiral.length()),
            Path::Bezier { span } => span.points().iter().fold(end, |most, p| most.max(p.length())),
            Path::Line => end,
        })
    }
}
