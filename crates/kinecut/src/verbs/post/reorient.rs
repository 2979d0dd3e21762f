//! A program whose directions of the tool are said in another way: as vectors, as angles of the rotary axes, or as positions
//! of all axes.
//!
//! Every move is taken from the trace, which knows the pose and the axis positions at any part of it. Where the other way of
//! saying would turn the tool otherwise on the way, or where the linear axes do not run straight, the move is divided into as
//! many equal parts as the tolerance needs.

use glam::DVec3;

use crate::base::{Code, Finding, Result};
use crate::geom::{Arc, CurveKind, Rigid};
use crate::job::external::Followed;
use crate::machine::Machine;
use crate::nc::Control;
use crate::operations::OrientationName;
use crate::program::{
    Frame, FrameId, Item, Move, Path, Program, Speed, State, Target, Tcp, ToolAxis, ToolNumber,
};
use crate::trace::{Segment, SegmentPace, axis_positions};

/// Angle between the direction on the way and the one meant [rad]: 3 thousandths of a degree, half a micrometre at 10 mm from
/// the tip.
const DIRECTION: f64 = 5e-5;
/// Angle by which two directions differ, or a rotary axis is off zero, if they do [rad]: rounding.
const TURNED: f64 = 1e-9;
/// Most parts of a move.
const MOST_PARTS: u32 = 4096;

/// A program said in another way, and for each of its items that of the source.
#[derive(Debug)]
pub(crate) struct Reoriented {
    pub(crate) program: Program,
    pub(crate) of: Vec<u32>,
}

/// Machine, control and form for which directions are written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Saying<'a> {
    /// The machine.
    pub(crate) machine: &'a Machine,
    /// Wanted form of the directions.
    pub(crate) wanted: OrientationName,
    /// The control that is to read it.
    pub(crate) to: Control,
    /// Largest distance of the linear axes from the straight way between two positions [mm].
    pub(crate) tolerance: f64,
}

/// Says the directions of a program in another way; `program` are the items of the source, maybe with other registers.
///
/// # Errors
/// `KC0301` when the control has no such way, `KC0104` when axis positions need the place of the work or the length of a tool,
/// `KC1119` when a move would need too many parts, each with its item.
pub(crate) fn reorient(source: &Followed, program: &Program, say: &Saying<'_>) -> Result<Reoriented> {
    let tcp = match say.wanted {
        OrientationName::Vectors if say.to.turns_in_plane() => Tcp::Vector,
        OrientationName::Vectors | OrientationName::Angles => Tcp::Axes,
        OrientationName::Axes => Tcp::Off,
    };
    if !say.to.has_tcp(tcp) {
        return Err(Finding::error(
            Code::POST_CONTROL,
            format!("{} does not control the tool centre point", say.to.title()),
        )
        .help("use --orientation axes")
        .into());
    }
    let mut made = Program::new(program.setups.clone());
    for frame in &program.frames {
        made.add_frame(*frame);
    }
    let mut walk = Walk { source, program, say, tcp, made, of: Vec::new(), tool: None, on: false };
    for index in 0..program.items.len() {
        walk.item(index).map_err(|mut e| {
            e.0.item.get_or_insert(index as u32);
            e
        })?;
    }
    Ok(Reoriented { program: walk.made, of: walk.of })
}

struct Walk<'a> {
    source: &'a Followed,
    program: &'a Program,
    say: &'a Saying<'a>,
    /// Control of the tip in the new program.
    tcp: Tcp,
    made: Program,
    of: Vec<u32>,
    tool: Option<ToolNumber>,
    /// Whether the new program has the tip under control, and has said where it is.
    on: bool,
}

impl<'a> Walk<'a> {
    fn item(&mut self, index: usize) -> Result<()> {
        let mut state = *self.program.state(index);
        let controlled = state.tcp != Tcp::Off;
        let plain = !tilted(self.program, state.frame);
        let origin = self.program.origin(index);
        if let (Item::Move(motion), true) = (self.program.items.get(index), plain)
            && let Target::Tip { point, axis } = motion.end
        {
            let segments = self.segments(index as u32);
            let turned =
                segments.iter().any(|s| s.turning.is_some() || s.rotary().iter().any(|q| q.abs() > TURNED));
            if controlled || turned {
                state.tcp = self.tcp;
                return match segments {
                    [] => self.without_way(index, &motion, (point, axis), &state),
                    segments => segments.iter().try_for_each(|s| self.segment(index, &motion, s, &state)),
                };
            }
        }
        if controlled {
            state.tcp = self.tcp;
        } else if matches!(self.program.items.get(index), Item::Move(_) | Item::Cycle(..) | Item::Tool { .. })
        {
            self.on = false;
        }
        match self.program.items.get(index) {
            Item::Move(motion) => self.made.push_move(motion, &state, origin),
            Item::Cycle(cycle, _) => self.made.push_cycle(*cycle, &state, origin)?,
            Item::Tool { id, length, radius, again } => {
                self.tool = Some(id);
                self.made.push_tool(id, length, radius, &state, origin);
                if again {
                    self.made.change_again();
                }
            }
            Item::Dwell(seconds) => self.made.push_dwell(seconds, &state, origin),
            Item::Stop(kind) => self.made.push_stop(kind, &state, origin),
            Item::Text(text) => self.made.push_text(text, &state, origin),
            Item::Message(text) => self.made.push_message(text, &state, origin),
            Item::Data(data) => self.made.push_data(data, &state, origin),
        }
        self.of.push(index as u32);
        Ok(())
    }

    /// Segments of an item, without the machine's alternative ways.
    fn segments(&self, item: u32) -> &'a [Segment] {
        let all = &self.source.trace.segments;
        let from = all.partition_point(|s| s.item < item);
        let to = all.partition_point(|s| s.item <= item);
        // An alternative follows the segment that it replaces.
        let own = all[from..to].iter().take_while(|s| !s.alternative).count();
        &all[from..from + own]
    }

    /// A move whose way is not known, or that has none: its end is where the next one starts.
    fn without_way(
        &mut self,
        index: usize,
        motion: &Move,
        (point, axis): (DVec3, ToolAxis),
        state: &State,
    ) -> Result<()> {
        let all = &self.source.trace.segments;
        let next =
            all.get(all.partition_point(|s| s.item <= index as u32)).filter(|s| s.setup == state.setup);
        let origin = self.program.origin(index);
        if self.say.wanted == OrientationName::Axes {
            let Some(next) = next.filter(|_| point.is_finite()) else {
                return Err(Finding::error(
                    Code::NC_STATE,
                    "the place of this move is not known as a whole: it cannot be given as axis positions",
                )
                .help("name X, Y and Z in the first block under control of the tool centre point")
                .into());
            };
            return self.push(index, next, 0.0, Path::Line, state);
        }
        // Always said: a control may have one word for vectors and another for angles.
        let said = match next {
            None => axis,
            Some(next) => self.direction(next, 0.0, &self.to_frame(state)?)?,
        };
        let end = Target::Tip { point, axis: said };
        self.made.push_move(Move { end, path: motion.path }, state, origin);
        self.on = point.is_finite();
        self.of.push(index as u32);
        Ok(())
    }

    /// A move along a segment, in as many parts as it needs.
    fn segment(&mut self, index: usize, motion: &Move, segment: &Segment, state: &State) -> Result<()> {
        let frame = self.to_frame(state)?;
        if self.tcp != Tcp::Off && !self.on {
            // The place is given anew where control of the tip begins: nothing moves.
            let rapid = State { speed: Speed::Rapid { linear: true }, ..*state };
            self.push(index, segment, 0.0, Path::Line, &rapid)?;
        }
        let mut parts = 1;
        while !self.is_close(segment, parts, &frame)? {
            parts *= 2;
            if parts > MOST_PARTS {
                return Err(Finding::error(Code::TOO_MANY_PARTS, "this move would need too many parts")
                    .bound(f64::from(MOST_PARTS), "parts")
                    .into());
            }
        }
        for k in 1..=parts {
            let path = match (self.tcp, segment.curve.kind()) {
                (Tcp::Off, _) | (_, CurveKind::Line(_)) => Path::Line,
                (_, CurveKind::Arc(_)) if parts == 1 => motion.path,
                (_, CurveKind::Arc(arc)) => part_of(&arc, parts, &frame),
                _ if parts == 1 => motion.path,
                _ => {
                    let what = "the tool turns along a curve that is no line or arc";
                    return Err(Finding::error(Code::POST_CONTROL, what).into());
                }
            };
            let mut state = *state;
            if let (Tcp::Off, SegmentPace::Feed(feed), Some(_)) = (self.tcp, segment.motion, &segment.turning)
            {
                // The feed is that of the tip along the work, which no sum of axis speeds tells.
                let way = segment.curve.length() / f64::from(parts);
                let seconds =
                    if way > 0.0 { Some(way / feed) } else { segment.duration.map(|d| d / f64::from(parts)) };
                if let Some(seconds) = seconds.filter(|s| s.is_finite() && *s > 0.0) {
                    state.speed = Speed::Duration(seconds);
                }
            }
            self.push(index, segment, f64::from(k) / f64::from(parts), path, &state)?;
        }
        Ok(())
    }

    /// Appends a move to the place of a segment at part `t`.
    fn push(&mut self, index: usize, segment: &Segment, t: f64, path: Path, state: &State) -> Result<()> {
        let frame = self.to_frame(state)?;
        let axis = self.direction(segment, t, &frame)?;
        let point = match self.tcp {
            Tcp::Off => self.counted(segment, t, &frame)?,
            _ => frame.point(segment.curve.at(t * segment.curve.length()).p),
        };
        let origin = self.program.origin(index);
        self.made.push_move(Move { end: Target::Tip { point, axis }, path }, state, origin);
        self.of.push(index as u32);
        self.on = self.tcp != Tcp::Off;
        Ok(())
    }

    /// The direction of the tool at part `t` of a segment, as it is to be said.
    fn direction(&self, segment: &Segment, t: f64, frame: &Rigid) -> Result<ToolAxis> {
        if self.say.wanted == OrientationName::Vectors {
            return Ok(ToolAxis::Vector(frame.vector(axis_at(segment, t))));
        }
        let [_, _, _, rotary @ ..] = joints(segment, t)?;
        let mut said = [None; 3];
        for (i, letter) in ['A', 'B', 'C'].into_iter().enumerate() {
            said[i] = self.say.machine.joint(letter).map(|_| rotary[i]);
        }
        Ok(ToolAxis::Rotary(said))
    }

    /// Positions of the linear axes at part `t`, counted as the program counts them without control of the tip.
    fn counted(&self, segment: &Segment, t: f64, frame: &Rigid) -> Result<DVec3> {
        let setup = &self.program.setups[segment.setup.0 as usize];
        let tool = segment.tool.and_then(|n| self.source.magazine.tools.iter().find(|t| t.number == n));
        let lacking = match (setup.located, tool.and_then(|t| t.gauge_length)) {
            (false, _) => "the machine position of the work zero",
            (true, None) => "the gauge length of the tool",
            (true, Some(length)) => {
                let [_, _, _, rotary @ ..] = joints(segment, t)?;
                let tip = setup.part_on_table.point(segment.curve.at(t * segment.curve.length()).p);
                let tip = axis_positions(self.say.machine, length, rotary, tip)?;
                return Ok(frame.point(setup.part_on_table.inverse().point(tip)));
            }
        };
        Err(Finding::error(Code::JOB_REFERENCE, format!("axis positions need {lacking}"))
            .help("give a job file with it: --job")
            .into())
    }

    /// Whether a segment in this many equal parts is near enough to the segment itself.
    fn is_close(&self, segment: &Segment, parts: u32, frame: &Rigid) -> Result<bool> {
        let near = |k: u32| -> Result<bool> {
            let at = |half: u32| f64::from(2 * k + half) / f64::from(2 * parts);
            let [from, middle, to] = [at(0), at(1), at(2)];
            if segment.turning.is_some() {
                let close = match self.tcp {
                    Tcp::Vector => {
                        let between = axis_at(segment, from) + axis_at(segment, to);
                        between.angle_between(axis_at(segment, middle)) < DIRECTION
                    }
                    _ => {
                        let [a, b, c] =
                            [joints(segment, from)?, joints(segment, middle)?, joints(segment, to)?];
                        (3..6).all(|i| (0.5 * (a[i] + c[i]) - b[i]).abs() < DIRECTION)
                    }
                };
                if !close {
                    return Ok(false);
                }
            }
            if self.tcp != Tcp::Off {
                return Ok(true);
            }
            let [a, b, c] = [
                self.counted(segment, from, frame)?,
                self.counted(segment, middle, frame)?,
                self.counted(segment, to, frame)?,
            ];
            Ok((0.5 * (a + c) - b).length() < self.say.tolerance)
        };
        for k in 0..parts {
            if !near(k)? {
                return Ok(false);
            }
        }
        // A full turn has its middle between its ends.
        let whole = matches!(segment.curve.kind(), CurveKind::Arc(arc) if self.tcp == Tcp::Off && arc.sweep.abs() > 1.0);
        Ok(!(whole && parts < 8))
    }

    /// Maps part coordinates into the frame of a state.
    fn to_frame(&self, state: &State) -> Result<Rigid> {
        let setup = &self.program.setups[state.setup.0 as usize];
        let mut motion = Rigid::IDENTITY;
        let mut id = state.frame;
        loop {
            match self.program.frames.get(id.0 as usize) {
                Some(Frame::Shift { parent, motion: shift }) if parent.0 < id.0 => {
                    motion = shift.after(&motion);
                    id = *parent;
                }
                Some(Frame::Work(offset)) => {
                    let work = setup.work_offsets.get(offset).copied().unwrap_or(Rigid::IDENTITY);
                    return Ok(work.after(&motion).inverse().after(&setup.part_on_table));
                }
                _ => {
                    return Err(Finding::error(
                        Code::POST_CONTROL,
                        "directions of the tool in this frame cannot be said otherwise",
                    )
                    .into());
                }
            }
        }
    }
}

/// Whether a frame lies in a tilted plane.
fn tilted(program: &Program, id: FrameId) -> bool {
    match program.frames.get(id.0 as usize) {
        Some(Frame::Tilted { .. }) => true,
        Some(Frame::Shift { parent, .. }) if parent.0 < id.0 => tilted(program, *parent),
        _ => false,
    }
}

/// Direction of the tool at part `t` of a segment [part coordinates].
fn axis_at(segment: &Segment, t: f64) -> DVec3 {
    segment.turning.as_ref().map_or(segment.axis, |turning| turning.axis(t).0)
}

/// Axis positions at part `t` of a segment.
fn joints(segment: &Segment, t: f64) -> Result<[f64; 6]> {
    segment.joints(t).ok_or_else(|| {
        Finding::error(Code::OUTSIDE_TRAVEL, "the rotary axes cannot follow the tool on the way of this move")
            .help("divide the move, or use another machine")
            .into()
    })
}

/// One of equal parts of an arc, in a frame.
fn part_of(arc: &Arc, parts: u32, frame: &Rigid) -> Path {
    Path::Arc {
        centre: frame.point(arc.centre),
        axis: frame.vector(arc.axis),
        sweep: arc.sweep / f64::from(parts),
        rise: arc.rise / f64::from(parts),
    }
}
