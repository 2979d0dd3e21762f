//! Items of a program, as a struct of arrays, and the program itself.

use glam::DVec3;

use super::frame_index::FrameIndex;
use super::runs::{Advance, Runs};
use super::{
    Comp, ControlData, Cycle, CycleStep, Frame, FrameId, Origin, OriginId, Setup, Speed, State, StateId,
    ToolNumber,
};
use crate::base::{Code, CountBound, Span, Sum};
use crate::geom::{Arc, CubicSpan, Curve, CurveKind, InvoluteRecord, Line, Rise, Spiral};

/// Direction of the tool axis at the end of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolAxis {
    /// The Z axis of the frame.
    Fixed,
    /// A unit vector from tip to holder, in the frame.
    Vector(DVec3),
    /// Positions of the rotary axes A, B, C [rad]; `None` keeps an axis where it is.
    Rotary([Option<f64>; 3]),
}

/// Axis positions of the machine by letter, in the order X Y Z A B C [mm, rad]; `None` keeps an axis where it is.
pub type AxisPositions = [Option<f64>; 6];

/// End of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// The tool tip in the frame of the state [mm]. Where rotary axes are moved without control of the tool centre point
    /// the coordinates are positions of the linear axes, counted from the work offset as it lies with all rotary axes at
    /// zero.
    Tip {
        /// Point. A coordinate that is not a number is still unknown, or stays where it is; only rapid moves may
        /// have one.
        point: DVec3,
        /// Tool axis.
        axis: ToolAxis,
    },
    /// Positions of the machine's axes.
    Joints(AxisPositions),
    /// The rotary axes turn until the tool is along the Z of the frame, which is tilted; linear axes do not move.
    Orient,
}

/// Path of a move to its end. The start is the end of the move before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Path {
    /// Straight.
    Line,
    /// Arc or helix, as [`Arc`] (the start point is the end of the move before).
    Arc {
        /// Centre [mm].
        centre: DVec3,
        /// Unit vector of the axis.
        axis: DVec3,
        /// Right-handed angle about the axis [rad].
        sweep: f64,
        /// Movement along the axis [mm].
        rise: f64,
    },
    /// Circle involute in a plane parallel to XY of the frame.
    Involute {
        /// The planar curve.
        record: InvoluteRecord,
        /// Movement along Z [mm].
        rise: f64,
    },
    /// Spiral in a plane parallel to XY of the frame.
    Spiral {
        /// The planar curve.
        spiral: Spiral,
        /// Movement along Z.
        rise: Rise,
    },
    /// Cubic Bezier curve in a plane parallel to XY of the frame.
    Bezier {
        /// The planar curve.
        span: CubicSpan,
    },
}

/// A move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// End.
    pub end: Target,
    /// Path.
    pub path: Path,
}

impl Move {
    /// The move along a curve whose involutes, spirals and cubics lie in planes parallel to XY.
    pub fn along(curve: &Curve) -> Move {
        let path = match curve.kind() {
            CurveKind::Line(_) => Path::Line,
            CurveKind::Arc(arc) => {
                Path::Arc { centre: arc.centre, axis: arc.axis, sweep: arc.sweep, rise: arc.rise }
            }
            CurveKind::Involute { record, rise, frame } => {
                // Planners make involutes at a height; a turned plane would need a turned frame.
                let shift = frame.point(DVec3::ZERO).truncate();
                Path::Involute { record: record.shifted(shift), rise }
            }
            CurveKind::Spiral { spiral, rise, frame } => {
                let shift = frame.point(DVec3::ZERO).truncate();
                Path::Spiral { spiral: spiral.shifted(shift), rise }
            }
            CurveKind::Bezier { span, frame } => {
                Path::Bezier { span: span.shifted(frame.point(DVec3::ZERO).truncate()) }
            }
        };
        Move { end: Target::Tip { point: curve.end(), axis: ToolAxis::Fixed }, path }
    }

    /// The exact curve from `start`, for a move that ends at a tip position.
    pub fn curve(&self, start: DVec3) -> Option<Curve> {
        let Target::Tip { point, .. } = self.end else { return None };
        Some(match self.path {
            Path::Line => Line { start, end: point }.into(),
            Path::Arc { centre, axis, sweep, rise } => Arc { start, centre, axis, sweep, rise }.into(),
            Path::Involute { record, rise } => Curve::involute(record, start.z, rise),
            Path::Spiral { spiral, rise } => Curve::spiral(spiral, start.z, rise),
            Path::Bezier { span } => Curve::cubic(span, start.z),
        })
    }
}

/// Kind of a stop, which ends or interrupts a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopKind {
    /// `M0`.
    Program,
    /// `M1`.
    Optional,
    /// `M60`: the pallets are exchanged, then a stop.
    Pallet,
    /// `M2`, `M30`.
    End,
}

/// An item, as seen by a reader of the program.
#[derive(Clone, Debug, PartialEq)]
pub enum Item<'a> {
    /// A move.
    Move(Move),
    /// A cycle and its expansion along the tool axis, at the present position.
    Cycle(&'a Cycle, &'a [CycleStep]),
    /// A tool and the registers of its length and radius; the tool is changed when the number differs from the
    /// one before, or `again` says so. `length: None` is an offset switched off.
    Tool {
        /// Tool in the spindle.
        id: ToolNumber,
        /// Register of the length offset.
        length: Option<u32>,
        /// Register of the radius.
        radius: Option<u32>,
        /// The change is called for though the tool is in the spindle already (a second `M6`): the spindle stops, and the place
        /// after it is the control's.
        again: bool,
    },
    /// A wait [s].
    Dwell(f64),
    /// A stop.
    Stop(StopKind),
    /// A comment.
    Text(&'a str),
    /// A message to the operator, which the control shows while it runs on; empty takes the one before away.
    Message(&'a str),
    /// Data that the program sets at the control.
    Data(ControlData),
}

/// Kind of an item, and where its values are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Slot {
    /// A straight move of the tip along the tool axis of its frame: nearly all of a long program.
    Straight(u32),
    Move(u32),
    Cycle(u32),
    Tool(u32),
    Dwell(u32),
    Stop(StopKind),
    Text(u32),
    Message(u32),
    Data(u32),
}

impl Advance for Slot {
    #[inline]
    fn advanced(self, steps: u32) -> Slot {
        match self {
            Slot::Straight(i) => Slot::Straight(i + steps),
            Slot::Move(i) => Slot::Move(i + steps),
            Slot::Cycle(i) => Slot::Cycle(i + steps),
            Slot::Tool(i) => Slot::Tool(i + steps),
            Slot::Dwell(i) => Slot::Dwell(i + steps),
            Slot::Stop(kind) => Slot::Stop(kind),
            Slot::Text(i) => Slot::Text(i + steps),
            Slot::Message(i) => Slot::Message(i + steps),
            Slot::Data(i) => Slot::Data(i + steps),
        }
    }
}

impl Advance for StateId {
    #[inline]
    fn advanced(self, _steps: u32) -> StateId {
        self
    }
}

impl Advance for OriginId {
    #[inline]
    fn advanced(self, _steps: u32) -> OriginId {
        self
    }
}

/// A tool with the registers of its length and radius.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ToolCall {
    id: ToolNumber,
    length: Option<u32>,
    radius: Option<u32>,
    again: bool,
}

/// The straight move of the tip to a point.
fn straight(point: DVec3) -> Move {
    Move { end: Target::Tip { point, axis: ToolAxis::Fixed }, path: Path::Line }
}

/// The items of a program: one array for each property, and what neighbours share once for all of them.
#[derive(Clone, Debug, Default)]
pub struct Items {
    slots: Runs<Slot>,
    states: Runs<StateId>,
    origins: Runs<OriginId>,
    /// First and last byte of the place of each, where its origin has one.
    spans: Vec<[u32; 2]>,
    straights: Vec<DVec3>,
    moves: Vec<Move>,
    tools: Vec<ToolCall>,
    dwells: Vec<f64>,
    cycles: Vec<(Cycle, Vec<CycleStep>)>,
    texts: Vec<String>,
    data: Vec<ControlData>,
}

impl Items {
    /// Number of items.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// True if there are no items.
    pub fn is_empty(&self) -> bool {
        self.slots.len() == 0
    }

    /// The item at an index.
    pub fn get(&self, index: usize) -> Item<'_> {
        match self.slots.get(index) {
            Slot::Straight(i) => Item::Move(straight(self.straights[i as usize])),
            Slot::Move(i) => Item::Move(self.moves[i as usize]),
            Slot::Cycle(i) => {
                let (cycle, steps) = &self.cycles[i as usize];
                Item::Cycle(cycle, steps)
            }
            Slot::Tool(i) => {
                let ToolCall { id, length, radius, again } = self.tools[i as usize];
                Item::Tool { id, length, radius, again }
            }
            Slot::Dwell(i) => Item::Dwell(self.dwells[i as usize]),
            Slot::Stop(kind) => Item::Stop(kind),
            Slot::Text(i) => Item::Text(&self.texts[i as usize]),
            Slot::Message(i) => Item::Message(&self.texts[i as usize]),
            Slot::Data(i) => Item::Data(self.data[i as usize]),
        }
    }

    /// The end of a straight move of the tip along the tool axis of its frame, which nearly all items of a long program
    /// are; `None` for all others.
    pub(crate) fn straight(&self, index: usize) -> Option<DVec3> {
        match self.slots.get(index) {
            Slot::Straight(i) => Some(self.straights[i as usize]),
            _ => None,
        }
    }

    /// Indices of all items but the straight moves of the tip, ascending: few in a long program.
    pub fn few(&self) -> impl Iterator<Item = usize> + '_ {
        let mut next = 0;
        std::iter::from_fn(move || {
            while next < self.len() && matches!(self.slots.get(next), Slot::Straight(_)) {
                next = self.slots.end_of_run(next);
            }
            next += 1;
            (next <= self.len()).then_some(next - 1)
        })
    }

    /// Makes room for so many straight moves, so that none of them is copied while their number grows.
    pub(crate) fn reserve(&mut self, moves: usize) {
        self.straights.reserve_exact(moves);
        self.spans.reserve_exact(moves);
    }

    /// Gives back the memory that was taken for items to come.
    pub(crate) fn shrink_to_fit(&mut self) {
        self.slots.shrink_to_fit();
        self.states.shrink_to_fit();
        self.origins.shrink_to_fit();
        self.spans.shrink_to_fit();
        self.straights.shrink_to_fit();
        self.moves.shrink_to_fit();
    }

    /// Bytes that they take, but for cycles and texts.
    #[cfg(test)]
    pub(crate) fn bytes(&self) -> usize {
        let runs = self.slots.bytes() + self.states.bytes() + self.origins.bytes();
        let straights = self.straights.capacity() * size_of::<DVec3>();
        runs + self.spans.capacity() * 8 + straights + self.moves.capacity() * size_of::<Move>()
    }

    /// The state of the item at an index.
    pub fn state(&self, index: usize) -> StateId {
        self.states.get(index)
    }

    /// The origin of the item at an index.
    pub fn origin(&self, index: usize) -> OriginId {
        self.origins.get(index)
    }
}

/// Steps of all drilling cycles of a program: a thousand deep holes have a hundred thousand.
const CYCLE_STEPS: CountBound = CountBound {
    what: "steps of drilling cycles in one program",
    most: 1e6,
    bytes: 600,
    code: Code::NC_STATE,
    help: "use fewer repetitions or larger steps, or several programs",
};

/// A program: setups, frames, items with their states and origins.
///
/// ```
/// # use kinecut_nc as kinecut;
/// use glam::DVec3;
/// use kinecut::geom::Line;
/// use kinecut::program::{Frame, Item, Move, Origin, Program, SetupId, Speed, State, WorkOffset};
/// let mut program = Program::default();
/// let frame = program.add_frame(Frame::Work(WorkOffset::G54));
/// let mut state = State::start(SetupId(0), frame);
/// state.speed = Speed::PerMinute(50.0);
/// let cut = Line { start: DVec3::ZERO, end: DVec3::X * 10.0 }.into();
/// program.push_move(Move::along(&cut), &state, Origin::default());
/// assert!(matches!(program.items.get(0), Item::Move(_)));
/// assert_eq!(program.state(0).speed, Speed::PerMinute(50.0));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Setups, in the order in which they run.
    pub setups: Vec<Setup>,
    /// Frames.
    pub frames: Vec<Frame>,
    /// Items.
    pub items: Items,
    index: FrameIndex,
    /// Steps of all cycles.
    cycle_steps: Sum,
    states: Vec<State>,
    origins: Vec<Origin>,
}

impl Program {
    /// An empty program for these setups.
    pub fn new(setups: Vec<Setup>) -> Program {
        Program { setups, ..Program::default() }
    }

    /// Adds a frame, or finds the equal one.
    pub fn add_frame(&mut self, frame: Frame) -> FrameId {
        FrameId(self.index.place(&mut self.frames, frame))
    }

    /// Whether an item runs under a cutter compensation.
    pub fn compensates(&self) -> bool {
        self.states.iter().any(|state| state.comp != Comp::Off)
    }

    /// Appends a move.
    #[inline]
    pub fn push_move(&mut self, motion: Move, state: &State, origin: Origin) {
        let slot = match motion {
            Move { end: Target::Tip { point, axis: ToolAxis::Fixed }, path: Path::Line } => {
                self.items.straights.push(point);
                Slot::Straight(self.items.straights.len() as u32 - 1)
            }
            _ => {
                self.items.moves.push(motion);
                Slot::Move(self.items.moves.len() as u32 - 1)
            }
        };
        self.push(slot, state, origin);
    }

    /// Appends a cycle at the present position.
    ///
    /// # Errors
    /// Those of [`Cycle::expansion`]; `KC0204` when all cycles of the program together have a million steps.
    pub fn push_cycle(&mut self, cycle: Cycle, state: &State, origin: Origin) -> crate::base::Result<()> {
        let steps = cycle.expansion()?;
        self.cycle_steps.add(&CYCLE_STEPS, steps.len() as f64)?;
        self.items.cycles.push((cycle, steps));
        let slot = Slot::Cycle(self.items.cycles.len() as u32 - 1);
        self.push(slot, state, origin);
        Ok(())
    }

    /// Appends a tool call or a change of its offsets.
    pub fn push_tool(
        &mut self,
        id: ToolNumber,
        length: Option<u32>,
        radius: Option<u32>,
        state: &State,
        origin: Origin,
    ) {
        self.items.tools.push(ToolCall { id, length, radius, again: false });
        let slot = Slot::Tool(self.items.tools.len() as u32 - 1);
        self.push(slot, state, origin);
    }

    /// Gives the tool item at an index another register of its length; other items stay as they are.
    pub fn set_tool_length(&mut self, index: usize, register: Option<u32>) {
        if index < self.items.len()
            && let Slot::Tool(i) = self.items.slots.get(index)
        {
            self.items.tools[i as usize].length = register;
        }
    }

    /// Makes the last item, a tool, a change that is called for though that tool is in the spindle already.
    pub fn change_again(&mut self) {
        if let Some(Slot::Tool(i)) = self.items.slots.last() {
            self.items.tools[i as usize].again = true;
        }
    }

    /// Gives the item at an index another speed; other items stay as they are.
    pub fn set_speed(&mut self, index: usize, speed: Speed) {
        if index < self.items.len() && self.state(index).speed != speed {
            self.states.push(State { speed, ..*self.state(index) });
            self.items.states.set(index, StateId(self.states.len() as u32 - 1));
        }
    }

    /// Gives the move at an index another end and path; other items stay as they are.
    pub(crate) fn set_move(&mut self, index: usize, motion: Move) {
        let plain = match motion {
            Move { end: Target::Tip { point, axis: ToolAxis::Fixed }, path: Path::Line } => Some(point),
            _ => None,
        };
        if index >= self.items.len() {
            return;
        }
        match (self.items.slots.get(index), plain) {
            (Slot::Straight(i), Some(point)) => self.items.straights[i as usize] = point,
            (Slot::Move(i), _) => self.items.moves[i as usize] = motion,
            (Slot::Straight(_), None) => {
                self.items.moves.push(motion);
                self.items.slots.set(index, Slot::Move(self.items.moves.len() as u32 - 1));
            }
            _ => {}
        }
    }

    /// Marks moves along Z while rotary axes are turned in machine coordinates as leaving these where they are: their
    /// coordinates are then positions of the linear axes.
    pub fn hold_rotary_axes(&mut self) {
        let mut at = [0.0; 3];
        for i in 0..self.items.len() {
            let tilted =
                matches!(self.frames.get(self.state(i).frame.0 as usize), Some(Frame::Tilted { .. }));
            let index = match self.items.slots.get(i) {
                Slot::Move(index) => index,
                Slot::Straight(index) if at != [0.0; 3] && !tilted => {
                    // It is no plain one any more.
                    self.items.moves.push(straight(self.items.straights[index as usize]));
                    let index = self.items.moves.len() as u32 - 1;
                    self.items.slots.set(i, Slot::Move(index));
                    index
                }
                _ => continue,
            };
            match &mut self.items.moves[index as usize].end {
                Target::Joints(joints) => {
                    for (place, said) in at.iter_mut().zip(&joints[3..]) {
                        *place = said.unwrap_or(*place);
                    }
                }
                Target::Tip { axis, .. } if *axis == ToolAxis::Fixed && at != [0.0; 3] && !tilted => {
                    *axis = ToolAxis::Rotary([None; 3]);
                }
                _ => {}
            }
        }
    }

    /// Appends a wait [s].
    pub fn push_dwell(&mut self, seconds: f64, state: &State, origin: Origin) {
        self.items.dwells.push(seconds);
        let slot = Slot::Dwell(self.items.dwells.len() as u32 - 1);
        self.push(slot, state, origin);
    }

    /// Appends a stop.
    pub fn push_stop(&mut self, kind: StopKind, state: &State, origin: Origin) {
        self.push(Slot::Stop(kind), state, origin);
    }

    /// Adds the origin of a call, for the items within it.
    pub fn add_origin(&mut self, origin: Origin) -> OriginId {
        self.origins.push(origin);
        OriginId(self.origins.len() as u32 - 1)
    }

    /// The origin of a call.
    pub fn call(&self, id: OriginId) -> Origin {
        self.origins[id.0 as usize]
    }

    /// Appends a message to the operator.
    pub fn push_message(&mut self, text: impl Into<String>, state: &State, origin: Origin) {
        self.items.texts.push(text.into());
        let slot = Slot::Message(self.items.texts.len() as u32 - 1);
        self.push(slot, state, origin);
    }

    /// Appends data that the program sets at the control.
    pub fn push_data(&mut self, data: ControlData, state: &State, origin: Origin) {
        self.items.data.push(data);
        let slot = Slot::Data(self.items.data.len() as u32 - 1);
        self.push(slot, state, origin);
    }

    /// Appends a comment.
    pub fn push_text(&mut self, text: impl Into<String>, state: &State, origin: Origin) {
        self.items.texts.push(text.into());
        let slot = Slot::Text(self.items.texts.len() as u32 - 1);
        self.push(slot, state, origin);
    }

    fn push(&mut self, slot: Slot, state: &State, origin: Origin) {
        // Neighbours mostly share their state and often their origin; an earlier equal one is not searched for.
        if self.states.last() != Some(state) {
            self.states.push(*state);
        }
        // A place is an item's own, and only its file is shared.
        let span = origin.span.unwrap_or_default();
        let shared = Origin { span: origin.span.map(|s| Span { start: 0, end: 0, ..s }), ..origin };
        if self.origins.last() != Some(&shared) {
            self.origins.push(shared);
        }
        self.items.spans.push([span.start, span.end]);
        self.items.slots.push(slot);
        self.items.states.push(StateId(self.states.len() as u32 - 1));
        self.items.origins.push(OriginId(self.origins.len() as u32 - 1));
    }

    /// The state of the item at an index.
    pub fn state(&self, index: usize) -> &State {
        &self.states[self.items.states.get(index).0 as usize]
    }

    /// The origin of the item at an index.
    pub fn origin(&self, index: usize) -> Origin {
        let shared = self.origins[self.items.origins.get(index).0 as usize];
        let [start, end] = self.items.spans[index];
        Origin { span: shared.span.map(|s| Span { start, end, ..s }), ..shared }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::FileId;

    /// A program of moves to and fro, its feed said anew in every `feed`-th of them.
    fn straight_moves(count: u32, feed: u32) -> Program {
        let mut program = Program::default();
        let mut state = State::start(super::super::SetupId(0), FrameId(0));
        for i in 0..count {
            let point = DVec3::new(f64::from(i), f64::from(i % 7), 0.0);
            state.speed = Speed::PerMinute(f64::from(i / feed));
            let span = Some(Span { file: FileId(0), start: i * 20, end: i * 20 + 19 });
            program.push_move(straight(point), &state, Origin { span, ..Origin::default() });
        }
        program.items.shrink_to_fit();
        program
    }

    #[test]
    fn a_straight_move_takes_its_end_and_its_place() {
        let program = straight_moves(100_000, 100_000);
        let each = program.items.bytes() as f64 / 100_000.0;
        assert!(each < 32.5, "{each} bytes a move");
        // Also where every second block says another feed.
        let each = straight_moves(100_000, 2).items.bytes() as f64 / 100_000.0;
        assert!(each < 40.0, "{each} bytes a move");
    }

    #[test]
    fn few_items_are_no_straight_moves() {
        let mut program = straight_moves(100, 30);
        let state = State::start(super::super::SetupId(0), FrameId(0));
        program.push_dwell(1.0, &state, Origin::default());
        program.push_dwell(2.0, &state, Origin::default());
        program.push_move(straight(DVec3::X), &state, Origin::default());
        program.push_stop(StopKind::End, &state, Origin::default());
        assert_eq!(program.items.few().collect::<Vec<_>>(), [100, 101, 103]);
        assert_eq!(program.items.get(101), Item::Dwell(2.0));
        assert_eq!(program.state(59).speed, Speed::PerMinute(1.0));
        assert_eq!(program.origin(59).span.map(|s| s.start), Some(59 * 20));
        program.set_speed(59, Speed::PerMinute(7.0));
        assert_eq!([58, 59, 60].map(|i| program.state(i).speed), [1.0, 7.0, 2.0].map(Speed::PerMinute));
        assert!(Program::default().items.few().next().is_none());
    }
}
