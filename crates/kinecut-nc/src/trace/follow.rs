//! Following a program: positions, frames, cycles, speeds.

use std::cell::Cell;
use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::chain::Chain;
use super::comp::{Programmed, compensate, refused};
use super::passing::{TOGETHER, Taker};
use super::rapids;
use super::straight::filled;
use super::turning::AxisTurning;
use super::{CompStart, RegisterState, Segment, SegmentPace, Stand, StandKind, Trace, Untraced};
use crate::base::{Code, Finding, Result};
use crate::geom::{Curve, Line, Rigid};
use crate::machine::Machine;
use crate::program::{
    AxisPositions, Comp, ControlData, CycleStep, Frame, FrameId, Item, Move, Path, Program, Setup, SetupId,
    Speed, State, Target, Tcp, ToolAxis, ToolNumber, moved,
};
use crate::tool::Tool;

/// Input of a trace in addition to the program.
#[derive(Clone, Copy, Debug)]
pub struct TraceOptions<'a> {
    /// The machine, if it is known.
    pub machine: Option<&'a Machine>,
    /// The tools in the magazine.
    pub tools: &'a [Tool],
    /// Height of the tip above the table frame's origin [mm] that is assumed for a retraction of the Z axis when
    /// the setup's place on the machine, or the tool's length, is not known.
    pub retract_height: f64,
    /// Values of the radius registers of cutter compensation: number and radius [mm], which may be zero or negative.
    /// A diameter register counts by half.
    pub radii: &'a [(u32, f64)],
    /// Other values of the control's registers, and the tool in the spindle; the default for a program that calls each
    /// tool by its own registers.
    pub operator: RegisterState<'a>,
    /// End of the entry of a compensation, as the control has it.
    pub comp_start: CompStart,
    /// Largest distance of the chords along which the tip is followed while rotary axes turn without control of the tool
    /// centre point [mm].
    pub chord: f64,
}

/// Follows a program.
///
/// # Errors
/// `KC0204` when a feed move has no feed, when a compensated contour or a cycle starts at an unknown position, or for a move that cannot be followed: in a
/// tilted plane before the rotary axes are turned to it, along an arc while rotary axes turn without tool centre point
/// control. `KC0205` when the control could not compensate the contour, `KC0104` for a radius register without a value.
pub fn trace(program: &Program, options: &TraceOptions<'_>) -> Result<Trace> {
    followed(program, options, None)
}

pub(super) fn followed<'a>(
    program: &'a Program,
    options: &'a TraceOptions<'a>,
    mut each: Option<&mut Taker<'_>>,
) -> Result<Trace> {
    let mut follow = Follow {
        program,
        options,
        trace: Trace::default(),
        chain: multi_axis(options.machine).map(|machine| Chain::new(machine, 0.0)).transpose()?,
        rotary: [0.0; 3],
        rotary_said: [false; 3],
        axis: DVec3::Z,
        tip: [None; 3],
        said: None,
        tool: None,
        lift: 0.0,
        setup: None,
        assumed_retract: false,
        assumed_home: false,
        compensated_to: 0,
        on_leg: false,
        passed: 0,
        has_untimed_rapid: false,
        has_turned: false,
        last_frame: Cell::new(None),
    };
    if let Some(number) = options.operator.in_spindle {
        follow.tool_call(number, None)?;
        follow.lift = 0.0;
    }
    match &mut each {
        // Nearly every item of a long program is a move.
        None => follow.trace.segments.reserve_exact(program.items.len()),
        Some(_) => follow.trace.segments.reserve_exact(TOGETHER),
    }
    for index in 0..program.items.len() {
        if let Some(each) = &mut each
            && follow.trace.segments.len() >= TOGETHER
            && index >= follow.compensated_to
        {
            follow.pass_on(each);
        }
        follow.item(index)?;
    }
    if let Some(each) = each {
        each(&follow.trace.segments);
        follow.trace.segments = Vec::new();
    }
    if follow.assumed_retract {
        follow.trace.assumed.push(format!(
            "retracted in machine coordinates, the tip stands {} mm above the work zero or higher",
            (options.retract_height * 1e3).round() / 1e3
        ));
    }
    if follow.has_untimed_rapid {
        follow
            .trace
            .assumed
            .push("rapid moves take no time: the machine's rapid speed is not given".to_owned());
    }
    if follow.has_turned && follow.assumed_home {
        follow.trace.assumed.push("rotary axes stand at zero before the program moves them".to_owned());
    }
    Ok(follow.trace)
}

/// A machine whose rotary axes have to be followed.
pub(super) fn multi_axis(machine: Option<&Machine>) -> Option<&Machine> {
    machine.filter(|m| m.is_multi_axis())
}

/// Moves up to this length are dropped [mm]: rest of an end that is the start, after its coordinates went through a
/// turned frame and back; rounding of doubles at a hundred metres.
const NO_MOVE: f64 = 1e-10;

pub(super) struct Follow<'a> {
    pub(super) program: &'a Program,
    pub(super) options: &'a TraceOptions<'a>,
    pub(super) trace: Trace,
    /// The machine with the tool in its spindle, if it has rotary axes.
    pub(super) chain: Option<Chain>,
    /// Positions of the rotary axes [rad].
    pub(super) rotary: [f64; 3],
    /// True for each of them that the program has moved.
    pub(super) rotary_said: [bool; 3],
    /// Unit vector from tip to holder [table frame].
    pub(super) axis: DVec3,
    /// Tip in the table frame, which goes with the work; a coordinate is `None` until the program has set it.
    pub(super) tip: [Option<f64>; 3],
    /// Coordinates that were given in a turned frame while the tip was not known; not a number where none was given.
    said: Option<(Rigid, DVec3)>,
    pub(super) tool: Option<&'a Tool>,
    /// Height of the tip above the programmed place, along the tool [mm].
    pub(super) lift: f64,
    setup: Option<SetupId>,
    assumed_retract: bool,
    pub(super) assumed_home: bool,
    /// First item whose move is not part of a compensated run that was followed already.
    pub(super) compensated_to: usize,
    /// True while a path is followed that the machine may, but need not, take.
    pub(super) on_leg: bool,
    /// Segments that were handed over and are kept no more.
    pub(super) passed: usize,
    /// Whether there was a rapid without a time, and a segment with the tool axis turned.
    has_untimed_rapid: bool,
    has_turned: bool,
    /// The frame of the move before, in the table frame.
    last_frame: Cell<Option<(SetupId, FrameId, Rigid)>>,
}

impl<'a> Follow<'a> {
    fn item(&mut self, index: usize) -> Result<()> {
        let program = self.program;
        let state = program.state(index);
        if self.setup != Some(state.setup) {
            let count = self.program.setups.len();
            if state.setup.0 as usize >= count {
                let what = format!("the item is of setup {}, and the program has {count}", state.setup.0);
                let finding = Finding::error(Code::NC_STATE, what);
                return Err(self.at(index, finding.help("add the setup to the program: they count from 0")));
            }
            // Another clamping: nothing of the old position is valid.
            let first = self.setup.is_none();
            self.setup = Some(state.setup);
            self.tip = [None; 3];
            if let Some(start) = self.options.operator.start.filter(|_| first) {
                self.tip = self.frame(FrameId(0), index, state)?.point(start).to_array().map(Some);
            }
            (self.rotary, self.rotary_said, self.axis) = ([0.0; 3], [false; 3], DVec3::Z);
        }
        if let Some(point) = program.items.straight(index)
            && state.comp == Comp::Off
        {
            return self.straight(index, point, state);
        }
        match program.items.get(index) {
            Item::Move(motion) => self.motion(index, &motion, state),
            Item::Cycle(_, steps) => self.cycle(index, steps, state),
            Item::Tool { id, length, .. } => {
                if self.tool.is_some_and(|t| t.number != id) {
                    self.stands(index, StandKind::Change(id), state);
                }
                self.tool_call(id, length).map_err(|e| in_item(e, index))
            }
            Item::Dwell(seconds) => {
                self.trace.dwells.push((index as u32, seconds));
                self.stands(index, StandKind::Dwell(seconds), state);
                Ok(())
            }
            Item::Stop(kind) => {
                self.stands(index, StandKind::Stop(kind), state);
                Ok(())
            }
            // The zero of a work offset that is not in force is where the setup has it.
            Item::Data(ControlData::Here { offset, place })
                if offset.is_none_or(|offset| self.program.is_in(offset, state.frame)) =>
            {
                self.given(index, place, state)
            }
            Item::Data(ControlData::Probe { place, .. }) => {
                for axis in 0..3 {
                    self.tip[axis] = self.tip[axis].filter(|_| place[axis].is_none());
                }
                Ok(())
            }
            Item::Data(ControlData::LengthCall { register }) => {
                if let Some(tool) = self.tool {
                    self.lift = self.options.operator.lift(tool, register);
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// The place of the tip gets coordinates.
    fn given(&mut self, index: usize, place: [Option<f64>; 3], state: &State) -> Result<()> {
        let frame = self.frame(state.frame, index, state)?;
        if frame.rotation == glam::DMat3::IDENTITY {
            for axis in 0..3 {
                if let Some(value) = place[axis] {
                    self.tip[axis] = Some(value + frame.translation[axis]);
                }
            }
        } else if let [Some(x), Some(y), Some(z)] = place {
            self.tip = frame.point(DVec3::new(x, y, z)).to_array().map(Some);
        }
        Ok(())
    }

    /// Notes that the tool rests here, if its place is known.
    fn stands(&mut self, index: usize, kind: StandKind, state: &State) {
        let to_part = self.setup_of(state).part_on_table.inverse();
        // Within a compensated contour, followed as a whole at its beginning, the tool rests at the end of the item
        // before.
        let next = self.trace.segments.partition_point(|s| (s.item as usize) < index);
        let within = index < self.compensated_to;
        let place = match self.trace.segments[..next].iter().rev().find(|s| !s.alternative) {
            Some(last) if within => Some((last.curve.end(), last.end_axis())),
            _ => match self.tip {
                [Some(x), Some(y), Some(z)] => {
                    Some((to_part.point(DVec3::new(x, y, z)), to_part.vector(self.axis)))
                }
                _ => None,
            },
        };
        if let (Some((tip, axis)), Some(tool)) = (place, self.tool) {
            let (tool, spindle_on) = (tool.number, state.spindle.rate() != 0.0);
            let (item, next) = (index as u32, self.passed + next);
            self.trace.stands.push(Stand { item, kind, tool, tip, axis, spindle_on, next });
        }
    }

    fn tool_call(&mut self, id: ToolNumber, length: Option<u32>) -> Result<()> {
        let found = self.options.tools.iter().find(|t| t.number == id);
        let tool = found.ok_or_else(|| {
            Finding::error(
                Code::JOB_REFERENCE,
                format!("the program calls {id}, which is not among the tools"),
            )
            .help("define the tool in the job")
        })?;
        // No axis moves while the tool is changed: the tip moves by the difference of the lengths.
        let old = self.tool.map_or(Some(0.0), |t| t.gauge_length);
        let located = self.setup.is_some_and(|s| self.program.setups[s.0 as usize].located);
        if let (Some(old), Some(new)) = (old, tool.gauge_length)
            && located
        {
            let lower = self.axis * (old - new);
            for i in 0..3 {
                self.tip[i] = self.tip[i].map(|q| q + lower[i]);
            }
        }
        if let Some(machine) = multi_axis(self.options.machine) {
            self.chain = Some(Chain::new(machine, tool.gauge_length.unwrap_or(0.0))?);
        }
        self.lift = self.options.operator.lift(tool, length);
        self.tool = Some(tool);
        Ok(())
    }

    fn motion(&mut self, index: usize, motion: &crate::program::Move, state: &State) -> Result<()> {
        if index < self.compensated_to {
            return Ok(());
        }
        if state.comp != Comp::Off {
            return self.compensated(index, state);
        }
        let turns = |joints: &AxisPositions| joints[3..].iter().any(Option::is_some);
        match motion.end {
            Target::Joints(joints) if turns(&joints) || self.is_turned() => {
                self.machine_axes(index, joints, state)
            }
            Target::Joints(joints) => self.joints(index, joints, state),
            Target::Orient => self.orient(index, state),
            Target::Tip { axis, point } if stands(axis, state) => {
                let frame = self.frame_of_moves(index, state)?;
                let end = self.resolve(&frame, point);
                let path = self.path_in(&frame, motion, point, end);
                self.run(index, path, end, state)
            }
            Target::Tip { axis, point } => self.turning_move(index, motion, point, axis, state),
        }
    }

    /// The exact path of a move in a frame [table frame], when its start and end are known.
    pub(super) fn path_in(
        &self,
        frame: &Rigid,
        motion: &Move,
        point: DVec3,
        end: [Option<f64>; 3],
    ) -> Option<Curve> {
        let start = self.start_in(frame)?;
        let point = filled(point, start);
        let path = match motion.path {
            // A helix whose start the program has not set.
            Path::Arc { centre, axis, sweep, rise } if rise.is_nan() => {
                let along = |i: usize| axis[i] != 0.0;
                let centre =
                    DVec3::from_array([0, 1, 2].map(|i| if along(i) { start[i] } else { centre[i] }));
                Path::Arc { centre, axis, sweep, rise: (point - start).dot(axis) }
            }
            path => path,
        };
        let whole = Move { end: Target::Tip { point, axis: ToolAxis::Fixed }, path };
        let known = end.iter().all(Option::is_some);
        known.then(|| whole.curve(start)).flatten().map(|c| c.moved(frame))
    }

    /// Follows the compensated moves from `index` on, and the move on which the compensation ends.
    fn compensated(&mut self, index: usize, state: &State) -> Result<()> {
        let program = self.program;
        let (register, side) = match state.comp {
            Comp::Left(register) => (register, 1.0),
            Comp::Right(register) => (register, -1.0),
            Comp::Off => return Ok(()),
        };
        let value =
            self.options.radii.iter().find(|(number, _)| *number == register).map(|(_, value)| *value);
        let own = self.tool.filter(|_| self.options.operator.own_radius).map(|tool| {
            let radius = tool.cutter.diameter(tool.flute_length) / 2.0;
            let note = format!("radius register {register} holds the radius of {}, {radius} mm", tool.number);
            if !self.trace.assumed.contains(&note) {
                self.trace.assumed.push(note);
            }
            radius
        });
        let value = value.or(own).filter(|v| v.is_finite()).ok_or_else(|| {
            let message =
                format!("the program compensates by radius register {register}, whose value is not given");
            let finding = Finding::error(Code::JOB_REFERENCE, message).help("give the value of the register");
            self.at(index, finding)
        })?;
        let frame = self.frame_of_moves(index, state)?;
        let mut here = self.start_in(&frame).ok_or_else(|| self.unknown_start(index))?;
        let mut contour = Vec::new();
        let mut exit = None;
        for item in index..program.items.len() {
            let now = program.state(item);
            let fail = |what: &str| refused(item, what).help("switch the compensation off (G40) before it");
            let motion = match program.items.get(item) {
                Item::Move(motion) => motion,
                Item::Tool { .. } => return Err(fail("a tool or register changes in a compensation").into()),
                Item::Cycle(..) => return Err(fail("a cycle runs in a compensation").into()),
                _ => continue,
            };
            if now.setup != state.setup || now.frame != state.frame {
                return Err(fail("the frame changes in a compensation").into());
            }
            let Target::Tip { axis: ToolAxis::Fixed, point } = motion.end else {
                return Err(fail("a compensated move does not end at a place of the contour").into());
            };
            let curve = motion.curve(here).filter(|_| point.is_finite());
            let programmed = Programmed { item, curve: curve.ok_or_else(|| self.unknown_start(item))? };
            here = point;
            self.compensated_to = item + 1;
            if now.comp == Comp::Off {
                exit = Some(programmed);
                break;
            }
            if now.comp != state.comp {
                return Err(fail("the side or register of a compensation changes while it is on").into());
            }
            contour.push(programmed);
        }
        if exit.is_none() {
            self.trace.assumed.push("the cutter compensation is on until the end of the program".to_owned());
        }
        for moved in compensate(&contour, exit.as_ref(), side * value, self.options.comp_start)? {
            let curve = moved.curve.moved(&frame);
            self.tip = curve.end().to_array().map(Some);
            if curve.length() > 0.0 {
                self.segment(moved.item, &curve, program.state(moved.item))?;
            }
        }
        Ok(())
    }

    fn cycle(&mut self, index: usize, steps: &[CycleStep], state: &State) -> Result<()> {
        let frame = self.frame_of_moves(index, state)?;
        for step in steps {
            let (height, motion_state) = match *step {
                CycleStep::Dwell(seconds) => {
                    self.trace.dwells.push((index as u32, seconds));
                    continue;
                }
                CycleStep::Rapid(z) => (z, State { speed: Speed::Rapid { linear: true }, ..*state }),
                CycleStep::Feed(z) => (z, *state),
                CycleStep::FeedAt { height, factor } => {
                    (height, State { speed: state.speed.times(factor), ..*state })
                }
                CycleStep::Thread { height, pitch } => {
                    (height, State { speed: Speed::PerRevolution(pitch), ..*state })
                }
            };
            if height.is_nan() {
                // A height that the program has not set.
                let end = if frame.rotation.z_axis == DVec3::Z {
                    [self.tip[0], self.tip[1], None]
                } else {
                    [None; 3]
                };
                self.run(index, None, end, &motion_state)?;
                continue;
            }
            let start = self.start_in(&frame).ok_or_else(|| self.unknown_start(index))?;
            let end = DVec3::new(start.x, start.y, height);
            let path = Curve::from(Line { start, end }).moved(&frame);
            let end = frame.point(end).to_array().map(Some);
            self.run(index, Some(path), end, &motion_state)?;
        }
        Ok(())
    }

    fn joints(&mut self, index: usize, joints: AxisPositions, state: &State) -> Result<()> {
        let setup = self.setup_of(state);
        let mut end = self.tip;
        for i in 0..2 {
            if let Some(q) = joints[i] {
                end[i] = setup.located.then_some(q);
            }
        }
        if let Some(q) = joints[2] {
            let length = self.tool.map_or(Some(0.0), |t| t.gauge_length);
            end[2] = Some(match length {
                Some(length) if setup.located => q - length,
                _ => {
                    self.assumed_retract = true;
                    self.options.retract_height
                }
            });
        }
        let whole = |p: [Option<f64>; 3]| Some(DVec3::new(p[0]?, p[1]?, p[2]?));
        let path = whole(self.tip).zip(whole(end)).map(|(start, end)| Curve::from(Line { start, end }));
        self.run(index, path, end, state)
    }

    /// The end of a move in the table frame; a coordinate that the program has not set stays as it is.
    pub(super) fn resolve(&mut self, frame: &Rigid, point: DVec3) -> [Option<f64>; 3] {
        if point.is_finite() {
            return frame.point(point).to_array().map(Some);
        }
        if frame.rotation == DMat3::IDENTITY {
            let moved = (point + frame.translation).to_array();
            return [0, 1, 2].map(|i| if moved[i].is_finite() { Some(moved[i]) } else { self.tip[i] });
        }
        if frame.rotation.z_axis == DVec3::Z && point.x.is_finite() && point.y.is_finite() {
            // Turned about Z: the height has nothing to do with X and Y.
            let over = moved(frame, point);
            return [Some(over.x), Some(over.y), self.tip[2]];
        }
        let start = match self.start_in(frame) {
            Some(start) => start.to_array(),
            // Coordinates given before in the same frame stay, though the tip was not known.
            None => {
                self.said.filter(|(said_in, _)| said_in == frame).map_or([f64::NAN; 3], |s| s.1.to_array())
            }
        };
        let mut filled = point.to_array();
        for i in 0..3 {
            if !filled[i].is_finite() {
                filled[i] = start[i];
            }
        }
        let filled = DVec3::from_array(filled);
        self.said = Some((*frame, filled));
        if filled.is_finite() { frame.point(filled).to_array().map(Some) } else { [None; 3] }
    }

    /// The present tip in a frame, when it is known.
    pub(super) fn start_in(&self, frame: &Rigid) -> Option<DVec3> {
        let tip = DVec3::new(self.tip[0]?, self.tip[1]?, self.tip[2]?);
        Some(frame.inverse().point(tip))
    }

    /// Runs to `end` along `path` [table frame]; a move without a known start is noted.
    pub(super) fn run(
        &mut self,
        index: usize,
        path: Option<Curve>,
        end: [Option<f64>; 3],
        state: &State,
    ) -> Result<()> {
        match path {
            Some(path) if path.length() > NO_MOVE => self.segment(index, &path, state)?,
            Some(_) => {}
            None => self.untraced(index, end, state),
        }
        self.tip = end;
        Ok(())
    }

    /// Notes a move whose start is not known.
    pub(super) fn untraced(&mut self, index: usize, end: [Option<f64>; 3], state: &State) {
        self.trace.untraced.push(Untraced {
            item: index as u32,
            setup: state.setup,
            tool: self.tool.map(|t| t.number),
            axis: self.axis,
            feed: !matches!(state.speed, Speed::Rapid { .. }),
            start: self.tip,
            end,
        });
    }

    fn segment(&mut self, index: usize, path: &Curve, state: &State) -> Result<()> {
        let axis_rapid = self.options.machine.and_then(|m| m.dynamics.rapid);
        let rapid = axis_rapid.map(|rapid| (path.end() - path.start()).abs().max_element() / rapid);
        let seconds = self.seconds(path.length(), rapid, state);
        self.piece(index, path, None, seconds, state)
    }

    /// Time of a way of this length at the programmed speed [s]; `rapid` that of a rapid.
    pub(super) fn seconds(&self, length: f64, rapid: Option<f64>, state: &State) -> Option<f64> {
        match state.speed {
            Speed::Rapid { .. } => rapid,
            Speed::PerMinute(feed) => Some(length / feed),
            Speed::PerRevolution(pitch) => {
                let feed = pitch * state.spindle.rate() / std::f64::consts::TAU;
                (feed > 0.0).then(|| length / feed)
            }
            Speed::Duration(seconds) => Some(seconds),
        }
    }

    /// Adds a segment along `path` [table frame] that takes these seconds.
    pub(super) fn piece(
        &mut self,
        index: usize,
        path: &Curve,
        turning: Option<AxisTurning>,
        seconds: Option<f64>,
        state: &State,
    ) -> Result<()> {
        let setup = self.setup_of(state);
        let to_part = setup.part_on_table.inverse();
        let rate = state.spindle.rate();
        let motion = match state.speed {
            Speed::Rapid { .. } => SegmentPace::Rapid,
            Speed::PerMinute(feed) => SegmentPace::Feed(feed),
            Speed::PerRevolution(pitch) => SegmentPace::Feed(pitch * rate / std::f64::consts::TAU),
            Speed::Duration(_) => SegmentPace::Feed(seconds.map_or(f64::NAN, |s| path.length() / s)),
        };
        // A tool that only turns has no path speed.
        if let SegmentPace::Feed(feed) = motion
            && !(feed.is_finite() && (feed > 0.0 || feed == 0.0 && turning.is_some()))
        {
            return Err(self.at(
                index,
                Finding::error(Code::NC_STATE, "a feed move has no feed").value(feed * 60.0, "mm/min"),
            ));
        }
        let segment = Segment {
            curve: path.moved(&to_part),
            axis: to_part.vector(self.axis),
            turning: turning.map(Arc::new),
            motion,
            tool: self.tool.map(|t| t.number),
            spindle_on: rate != 0.0,
            item: index as u32,
            setup: state.setup,
            duration: seconds,
            alternative: false,
            start_axes: self.start_axes(index, state)?,
        };
        let dog_leg = match segment.turning.is_none() && self.runs_apart(state) {
            true => self.dog_leg(path.start(), path.end()),
            false => Vec::new(),
        };
        let legs = dog_leg.into_iter().map(|leg| {
            let curve = Curve::from(leg).moved(&to_part);
            Segment { curve, alternative: true, ..segment.clone() }
        });
        let legs: Vec<Segment> = legs.collect();
        self.has_untimed_rapid |= motion == SegmentPace::Rapid && seconds.is_none();
        self.has_turned |= segment.axis_is_turned();
        self.trace.segments.push(segment);
        self.trace.segments.extend(legs);
        Ok(())
    }

    /// The ways of a rapid axis by axis [table frame]: the axes do not run along the table's when that is turned.
    fn dog_leg(&self, start: DVec3, end: DVec3) -> Vec<Line> {
        let speeds = self.rapid_speeds();
        let on_axes = self.chain.as_ref().filter(|_| self.is_turned()).and_then(|chain| {
            let (to, shift) = chain.to_linear(self.rotary)?;
            let (back, zero) = chain.of_linear(self.rotary);
            let legs = rapids::ways(to * start + shift, to * end + shift, speeds);
            let leg = |l: Line| Line { start: back * l.start + zero, end: back * l.end + zero };
            Some(legs.into_iter().map(leg).collect())
        });
        on_axes.unwrap_or_else(|| rapids::ways(start, end, speeds))
    }

    pub(super) fn frame(&self, id: FrameId, index: usize, state: &State) -> Result<Rigid> {
        // Nearly always that of the move before.
        if let Some((setup, last, frame)) = self.last_frame.get()
            && (setup, last) == (state.setup, id)
        {
            return Ok(frame);
        }
        let frame = self.found_frame(id, index, state)?;
        self.last_frame.set(Some((state.setup, id, frame)));
        Ok(frame)
    }

    fn found_frame(&self, id: FrameId, index: usize, state: &State) -> Result<Rigid> {
        match self.program.frames[id.0 as usize] {
            Frame::Work(offset) => self.setup_of(state).work_offsets.get(&offset).copied().ok_or_else(|| {
                let finding =
                    Finding::error(Code::JOB_REFERENCE, format!("{offset} is not defined in this setup"));
                self.at(index, finding.help("give the setup this work offset"))
            }),
            Frame::Shift { parent, motion } | Frame::Tilted { parent, motion, .. } => {
                Ok(self.frame(parent, index, state)?.after(&motion))
            }
            _ => Err(self.unsupported(index, "this coordinate frame")),
        }
    }

    pub(super) fn setup_of(&self, state: &State) -> &'a Setup {
        &self.program.setups[state.setup.0 as usize]
    }

    pub(super) fn unknown_start(&self, index: usize) -> crate::base::Error {
        let finding = Finding::error(Code::NC_STATE, "a feed move starts where the position is not known");
        self.at(index, finding.help("position all axes with a rapid move first"))
    }

    pub(super) fn unsupported(&self, index: usize, what: &str) -> crate::base::Error {
        self.at(index, Finding::error(Code::NC_STATE, format!("{what} cannot be followed")))
    }

    /// An error about an item: the caller knows the sources and turns the item into a place.
    pub(super) fn at(&self, index: usize, finding: Finding) -> crate::base::Error {
        finding.item(index as u32).into()
    }
}

/// An error that belongs to an item, if it names none itself.
fn in_item(mut error: crate::base::Error, index: usize) -> crate::base::Error {
    if error.0.key.is_none() {
        error.0.item.get_or_insert(index as u32);
    }
    error
}

/// True if a move leaves the rotary axes where they are, and counts its coordinates as a move along Z does.
fn stands(axis: ToolAxis, state: &State) -> bool {
    axis == ToolAxis::Fixed || axis == ToolAxis::Rotary([None; 3]) && state.tcp == Tcp::Off
}
