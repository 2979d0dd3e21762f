//! Following moves of rotary axes: with and without control of the tool centre point, tilted planes, machine
//! coordinates.

use glam::DVec3;

use super::Segment;
use super::follow::Follow;
use super::turning::{AxisTurning, TurningLaw, between};
use crate::base::{Code, Error, Finding, Result};
use crate::geom::{Curve, Line, Rigid};
use crate::program::{
    AxisPositions, Frame, FrameId, Move, Path, RotarySolution, Speed, State, Tcp, ToolAxis,
};

/// Length below which linear axes do not move [mm]: rounding of doubles at a hundred metres.
const NO_WAY: f64 = 1e-10;
/// Angle between two tool axes below which they are one [rad]: far below what an axis can do.
const SAME_AXIS: f64 = 1e-9;
/// Distance of the cosine of two directions from -1 within which they determine no plane: a thousandth of a degree.
const OPPOSITE: f64 = 2e-10;
/// Largest deviation of a matrix from a rotation that rounding explains.
const SQUARE: f64 = 1e-9;

impl Segment {
    /// True if its rotary axes turn, or are not all at zero.
    pub fn axis_is_turned(&self) -> bool {
        self.turning.is_some() || self.rotary() != [0.0; 3]
    }
}

impl Follow<'_> {
    /// True if a rotary axis is not at zero.
    pub(super) fn is_turned(&self) -> bool {
        self.rotary != [0.0; 3]
    }

    /// The frame of a move's points in the table frame. Without control of the tool centre point, programmed coordinates
    /// are positions of the linear axes, whatever the rotary axes do.
    pub(super) fn frame_of_moves(&self, index: usize, state: &State) -> Result<Rigid> {
        let frame = self.frame_of_points(index, state)?;
        if self.lift == 0.0 {
            return Ok(frame);
        }
        Ok(Rigid::from_translation(self.axis * self.lift).after(&frame))
    }

    fn frame_of_points(&self, index: usize, state: &State) -> Result<Rigid> {
        let frame = self.frame(state.frame, index, state)?;
        if let Some(z) = self.tilted(state.frame).then(|| frame.vector(DVec3::Z)) {
            if z.cross(self.axis).length() > SAME_AXIS || z.dot(self.axis) < 0.0 {
                let finding = Finding::error(
                    Code::NC_STATE,
                    "a move in a tilted plane comes before the rotary axes were turned to it",
                );
                return Err(self
                    .at(index, finding.help("turn the tool into the plane first (G53.1, PLANE ... TURN)")));
            }
            return Ok(frame);
        }
        if state.tcp != Tcp::Off || !self.is_turned() {
            return Ok(frame);
        }
        let Some(chain) = &self.chain else { return Ok(frame) };
        let located = self.setup_of(state).located;
        if !located {
            return Err(self.not_located(index));
        }
        let (to, shift) = chain.to_linear([0.0; 3]).ok_or_else(|| self.not_independent(index))?;
        let (back, zero) = chain.of_linear(self.rotary);
        let matrix = back * to;
        let skew = matrix.transpose() * matrix - glam::DMat3::IDENTITY;
        if skew.to_cols_array().iter().any(|e| e.abs() > SQUARE) {
            return Err(
                self.unsupported(index, "a move of linear axes that do not stay square to one another")
            );
        }
        Ok(Rigid { rotation: matrix, translation: back * shift + zero }.after(&frame))
    }

    /// True if a frame lies in a tilted plane.
    pub(super) fn tilted(&self, id: FrameId) -> bool {
        match self.program.frames.get(id.0 as usize) {
            Some(Frame::Tilted { .. }) => true,
            Some(Frame::Shift { parent, .. }) if parent.0 < id.0 => self.tilted(*parent),
            _ => false,
        }
    }

    fn branch(&self, id: FrameId) -> RotarySolution {
        match self.program.frames.get(id.0 as usize) {
            Some(Frame::Tilted { branch, .. }) => *branch,
            Some(Frame::Shift { parent, .. }) if parent.0 < id.0 => self.branch(*parent),
            _ => RotarySolution::Free,
        }
    }

    /// The rotary axes turn the tool into the plane of the frame; linear axes do not move.
    pub(super) fn orient(&mut self, index: usize, state: &State) -> Result<()> {
        let frame = self.frame(state.frame, index, state)?;
        let axis = frame.vector(DVec3::Z);
        let Some(chain) = &self.chain else {
            // The control knows its axes; later cuts do not depend on them.
            self.axis = axis;
            self.tip = [None; 3];
            self.untraced(index, self.tip, state);
            return Ok(());
        };
        let rotary = chain
            .rotary_for(axis, self.rotary, self.branch(state.frame))
            .map_err(|e| self.at(index, *e.0))?;
        self.turn_to(index, None, rotary, state)?;
        self.axis = axis;
        Ok(())
    }

    /// A move to axis positions of the machine while rotary axes turn or are turned.
    pub(super) fn machine_axes(&mut self, index: usize, to: AxisPositions, state: &State) -> Result<()> {
        self.has_axes(index, [to[3], to[4], to[5]])?;
        let rotary = [0, 1, 2].map(|i| to[3 + i].unwrap_or(self.rotary[i]));
        self.turn_to(index, Some([to[0], to[1], to[2]]), rotary, state)
    }

    /// A move with a direction of the tool.
    pub(super) fn turning_move(
        &mut self,
        index: usize,
        motion: &Move,
        point: DVec3,
        axis: ToolAxis,
        state: &State,
    ) -> Result<()> {
        let frame = self.frame(state.frame, index, state)?;
        if self.tilted(state.frame) {
            return Err(self.unsupported(index, "a move of rotary axes in a tilted plane"));
        }
        let (rotary, direction) = match axis {
            // A direction that was given as a vector stays as it is, with a machine or without.
            ToolAxis::Rotary([None, None, None]) if self.chain.is_none() && state.tcp != Tcp::Off => {
                (Some(self.rotary), self.axis)
            }
            ToolAxis::Rotary(said) => {
                self.has_axes(index, said)?;
                let rotary = [0, 1, 2].map(|i| said[i].unwrap_or(self.rotary[i]));
                if state.tcp == Tcp::Off {
                    let linear = self.linear_positions(index, motion, &frame, point, state)?;
                    return self.turn_to(index, Some(linear), rotary, state);
                }
                let direction =
                    self.chain.as_ref().map(|c| c.axis(rotary)).ok_or_else(|| self.no_machine(index))?;
                (Some(rotary), direction)
            }
            ToolAxis::Vector(v) => {
                let direction = frame.vector(v).normalize_or(self.axis);
                if state.tcp == Tcp::Off {
                    return Err(
                        self.unsupported(index, "a tool vector without control of the tool centre point")
                    );
                }
                if self.axis.dot(direction) < -1.0 + OPPOSITE {
                    return Err(self.unsupported(index, "a move that turns the tool upside down"));
                }
                let found =
                    self.chain.as_ref().map(|c| c.rotary_for(direction, self.rotary, RotarySolution::Free));
                let rotary = found.transpose().map_err(|e| self.at(index, *e.0))?;
                (rotary, direction)
            }
            _ => (Some(self.rotary), self.axis),
        };
        let end = self.resolve(&frame, point);
        let path = self.path_in(&frame, motion, point, end);
        let law = match (state.tcp, rotary) {
            (Tcp::Axes, Some(to)) => TurningLaw::Rotary { from: self.rotary, to, linear: None },
            (_, to) => {
                let rotary = to.map(|to| [self.rotary, to]);
                TurningLaw::Vector { from: self.axis, to: direction, rotary }
            }
        };
        let turns = rotary.is_some_and(|r| r != self.rotary)
            || self.axis.cross(direction).length() > SAME_AXIS
            || self.axis.dot(direction) < 0.0;
        match path {
            _ if !turns => self.run(index, path, end, state)?,
            Some(path) => {
                let rapid = self.rapid_time(&path, rotary);
                // A feed counts the degrees of the axes if the tool only turns.
                let turned = rotary.map_or(self.axis.angle_between(direction), |to| {
                    to.iter().zip(self.rotary).map(|(to, from)| (to - from).abs()).sum()
                });
                let way = if path.length() > NO_WAY { path.length() } else { turned.to_degrees() };
                let seconds = self.seconds(way, rapid, state);
                let to_part = self.setup_of(state).part_on_table.inverse();
                let turning = AxisTurning { to_part, chain: self.chain.clone(), law };
                let now = self.linear_now();
                self.piece(index, &path, Some(turning), seconds, state)?;
                if let (Some(from), Some(to)) = (now, rotary)
                    && let Some((matrix, shift)) = self.chain.as_ref().and_then(|c| c.to_linear(to))
                    && self.setup_of(state).located
                {
                    self.legs(index, [from, matrix * path.end() + shift], [self.rotary, to], state)?;
                }
                self.tip = end;
            }
            None => {
                self.run(index, None, end, state)?;
            }
        }
        self.rotary = rotary.unwrap_or(self.rotary);
        self.axis = direction;
        Ok(())
    }

    /// The positions of the linear axes that a move to a point means while rotary axes turn without control of the tool centre
    /// point; coordinates that are not named stay.
    fn linear_positions(
        &self,
        index: usize,
        motion: &Move,
        frame: &Rigid,
        point: DVec3,
        state: &State,
    ) -> Result<[Option<f64>; 3]> {
        let chain = self.chain.as_ref().ok_or_else(|| self.no_machine(index))?;
        if !self.setup_of(state).located {
            return Err(self.not_located(index));
        }
        if motion.path != Path::Line {
            return Err(self.unsupported(index, "an arc while rotary axes turn without G43.4"));
        }
        let (to, shift) = chain.to_linear([0.0; 3]).ok_or_else(|| self.not_independent(index))?;
        let now = self.linear_now();
        let full =
            frame.point(DVec3::from_array([0, 1, 2].map(|i| if point[i].is_nan() { 0.0 } else { point[i] })));
        let end = to * full + shift;
        if frame.rotation != glam::DMat3::IDENTITY && !point.is_finite() {
            return Err(self.unsupported(index, "a coordinate that stays in a turned frame"));
        }
        Ok([0, 1, 2].map(|i| match point[i].is_nan() {
            false => Some(end[i]),
            true => now.map(|n| n[i]),
        }))
    }

    /// The axes go straight from their present positions to these: the tip runs along a curve, which is followed by
    /// chords. Linear axes that are not given do not move.
    fn turn_to(
        &mut self,
        index: usize,
        linear: Option<[Option<f64>; 3]>,
        rotary: [f64; 3],
        state: &State,
    ) -> Result<()> {
        let chain = self.chain.clone().ok_or_else(|| self.no_machine(index))?;
        let located = self.setup_of(state).located;
        let from = self.linear_now().filter(|_| located);
        let said = linear.unwrap_or([None; 3]);
        let to = [0, 1, 2].map(|i| said[i].filter(|_| located).or(from.map(|f| f[i])));
        let end = to[0].zip(to[1]).zip(to[2]).map(|((x, y), z)| DVec3::new(x, y, z));
        let start_unknown = match from.zip(end) {
            Some((from, end)) => {
                self.by_chords(index, &chain, (from, end), rotary, state)?;
                false
            }
            None if matches!(state.speed, Speed::Rapid { .. }) => true,
            None => return Err(self.unknown_start(index)),
        };
        self.rotary = rotary;
        self.axis = chain.axis(rotary);
        self.tip = match end {
            Some(end) => chain.pose(end, rotary).translation.to_array().map(Some),
            None => [None; 3],
        };
        if start_unknown {
            self.untraced(index, self.tip, state);
        }
        Ok(())
    }

    fn by_chords(
        &mut self,
        index: usize,
        chain: &super::chain::Chain,
        (from, to): (DVec3, DVec3),
        rotary: [f64; 3],
        state: &State,
    ) -> Result<()> {
        let start = self.rotary;
        let turn = (0..3).map(|i| (rotary[i] - start[i]).abs()).sum::<f64>();
        if turn == 0.0 && (to - from).length() < NO_WAY {
            return Ok(());
        }
        let way = (to - from).length();
        let rapid = self.rapid_of_axes(to - from, start, rotary);
        let seconds = match state.speed {
            // A feed counts along the linear axes; where only rotary axes move it is their angle in degrees.
            _ if way > 0.0 => self.seconds(way, rapid, state),
            _ => self.seconds(turn.to_degrees(), rapid, state),
        };
        self.chords_of(index, chain, (from, to), rotary, seconds, state)?;
        if turn > 0.0 {
            self.rotary = start;
            self.legs(index, [from, to], [start, rotary], state)?;
        }
        Ok(())
    }

    /// The segments of a straight path of all axes from the present positions of the rotary axes, in these seconds.
    pub(super) fn chords_of(
        &mut self,
        index: usize,
        chain: &super::chain::Chain,
        (from, to): (DVec3, DVec3),
        rotary: [f64; 3],
        seconds: Option<f64>,
        state: &State,
    ) -> Result<()> {
        let start = self.rotary;
        let tip = |t: f64| chain.pose(from.lerp(to, t), between(start, rotary, t)).translation;
        let turn = (0..3).map(|i| (rotary[i] - start[i]).abs()).sum::<f64>();
        let to_part = self.setup_of(state).part_on_table.inverse();
        let places = chords(&tip, self.options.chord);
        let (mut at, mut error) = (0.0, 0f64);
        for &(t, off) in &places {
            error = error.max(off);
            let path = Curve::from(Line { start: tip(at), end: tip(t) });
            let law = TurningLaw::Rotary {
                from: between(start, rotary, at),
                to: between(start, rotary, t),
                linear: Some([from.lerp(to, at), from.lerp(to, t)]),
            };
            let turning = AxisTurning { to_part, chain: Some(chain.clone()), law };
            let part = seconds.map(|s| s * (t - at));
            // The path speed differs from chord to chord; the time does not.
            let timed = match (state.speed, part) {
                (Speed::Rapid { .. }, _) | (_, None) => *state,
                (_, Some(s)) => State { speed: Speed::Duration(s), ..*state },
            };
            self.rotary = between(start, rotary, at);
            self.axis = chain.axis(self.rotary);
            self.piece(index, &path, (turn > 0.0).then_some(turning), part, &timed)?;
            at = t;
        }
        self.trace.chord_error = self.trace.chord_error.max(error);
        Ok(())
    }

    /// Positions of the linear axes, when the tip is known.
    fn linear_now(&self) -> Option<DVec3> {
        let tip = DVec3::new(self.tip[0]?, self.tip[1]?, self.tip[2]?);
        let (matrix, shift) = self.chain.as_ref()?.to_linear(self.rotary)?;
        Some(matrix * tip + shift)
    }

    /// Time of a rapid with control of the tool centre point, by the ends of its axes [s].
    fn rapid_time(&self, path: &Curve, rotary: Option<[f64; 3]>) -> Option<f64> {
        let (chain, rotary) = (self.chain.as_ref()?, rotary?);
        let (from, shift) = chain.to_linear(self.rotary)?;
        let (to, end_shift) = chain.to_linear(rotary)?;
        let way = (to * path.end() + end_shift) - (from * path.start() + shift);
        self.rapid_of_axes(way, self.rotary, rotary)
    }

    /// Time of the slowest axis in rapid [s].
    fn rapid_of_axes(&self, way: DVec3, from: [f64; 3], to: [f64; 3]) -> Option<f64> {
        let machine = self.options.machine?;
        let mut most = 0.0f64;
        for (i, letter) in super::chain::LETTERS.into_iter().enumerate() {
            let by = if i < 3 { way[i] } else { to[i - 3] - from[i - 3] };
            if by == 0.0 {
                continue;
            }
            let own = machine.joint(letter).and_then(|(_, joint)| joint.dynamics.rapid);
            let speed = own.or(machine.dynamics.rapid.filter(|_| i < 3))?;
            most = most.max(by.abs() / speed);
        }
        Some(most)
    }

    fn has_axes(&mut self, index: usize, said: [Option<f64>; 3]) -> Result<()> {
        let chain = self.chain.as_ref().ok_or_else(|| self.no_machine(index))?;
        for i in 0..3 {
            if said[i].is_some() && !chain.has(i) {
                let letter = super::chain::LETTERS[3 + i];
                let finding = Finding::error(Code::MACHINE_AXIS, format!("the machine has no {letter} axis"));
                return Err(self.at(index, finding.help("use the machine that the program was written for")));
            }
        }
        for i in 0..3 {
            self.assumed_home |= said[i].is_none() && chain.has(i) && !self.rotary_said[i];
        }
        for i in 0..3 {
            self.rotary_said[i] |= said[i].is_some();
        }
        Ok(())
    }

    fn no_machine(&self, index: usize) -> Error {
        let finding = Finding::error(
            Code::MACHINE_AXIS,
            "the program moves rotary axes, and no machine with rotary axes is given",
        );
        self.at(index, finding.help("give the machine with its rotary axes"))
    }

    fn not_located(&self, index: usize) -> Error {
        let finding = Finding::error(
            Code::JOB_REFERENCE,
            "rotary axes turn, and it is not known where the work lies from them",
        );
        self.at(index, finding.help("give the setup its `position` on the machine"))
    }

    pub(super) fn not_independent(&self, index: usize) -> Error {
        let finding = Finding::error(
            Code::MACHINE_AXIS,
            "the linear axes of the machine are not independent at these rotary positions",
        );
        self.at(index, finding.help("stay away from this position, or use another machine"))
    }
}

/// Most chords of one move: the tolerance is then what they leave.
const MOST_CHORDS: u32 = 1 << 14;

/// Parameters at which the chords of a curve end, each with its largest distance from the curve at three places.
fn chords(curve: &dyn Fn(f64) -> DVec3, tolerance: f64) -> Vec<(f64, f64)> {
    let off = |a: f64, b: f64| {
        let (start, end) = (curve(a), curve(b));
        [0.25, 0.5, 0.75]
            .into_iter()
            .map(|t| (curve(a + (b - a) * t) - start.lerp(end, t)).length())
            .fold(0.0, f64::max)
    };
    let mut parts = 1;
    loop {
        let ends: Vec<(f64, f64)> = (0..parts)
            .map(|k| {
                let [a, b] = [k, k + 1].map(|i| f64::from(i) / f64::from(parts));
                (b, off(a, b))
            })
            .collect();
        let worst = ends.iter().fold(0.0, |most: f64, (_, off)| most.max(*off));
        if worst <= tolerance || parts >= MOST_CHORDS || !worst.is_finite() {
            return ends;
        }
        // The distance goes with the square of the length.
        let more = (worst / tolerance).sqrt().ceil().clamp(2.0, 64.0) as u32;
        parts = (parts * more).min(MOST_CHORDS);
    }
}
