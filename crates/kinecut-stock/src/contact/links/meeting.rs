//! All moves of a machine past all of its bodies.

use glam::DVec3;
use rayon::prelude::*;

use super::super::body::Body;
use super::super::clearance::Clearances;
use super::super::meeting::{Contact, MOST_LIFTS, TASK, cancelled, contact, reach};
use super::super::motion::{Moment, Standing};
use super::super::nearest_of::NearestOf;
use super::super::pair::{Pair, TOUCH, clearing, may_meet};
use super::super::piece::Piece;
use super::super::search::Nearest;
use super::super::tool::{MovingTool, ToolPart};
use super::axes::{Axes, tip_at_home};
use super::motion::LinkMotion;
use super::way::Way;
use crate::base::{Progress, Result};
use crate::geom::{Aabb, Rigid};
use crate::machine::{JointValues, Kinematics, Link, Machine};
use crate::trace::Segment;

/// A body that a link carries, in the coordinates of the machine with all axes at zero.
#[derive(Clone, Debug)]
pub struct LinkBody {
    /// The link.
    pub link: Link,
    /// The body.
    pub body: Body,
    /// A body of the machine. Two of them on neighbouring links are not compared, as one is guided by the other; nor is anything
    /// else with the tool: what stands on the table is watched for itself ([`crate::contact::meetings`]).
    pub of_machine: bool,
}

/// A tool in the spindle.
#[derive(Clone, Debug)]
pub struct ToolInSpindle {
    /// Its parts.
    pub tool: MovingTool,
    /// Distance of its tip from the gauge point of the spindle [mm].
    pub length: f64,
}

/// A move of a machine.
#[derive(Clone, Copy, Debug)]
pub struct MachineMove<'a> {
    /// The segment.
    pub segment: &'a Segment,
    /// Index of the tool.
    pub tool: u32,
}

impl MachineMove<'_> {
    /// Memory of one [bytes].
    pub const BYTES: u64 = size_of::<MachineMove<'static>>() as u64;
}

/// One of two that meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Party {
    /// Index of a body.
    Body(u32),
    /// A part of the tool in the spindle.
    Tool(ToolPart),
}

/// Two bodies that meet in a move, or come nearer than one of them allows.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineMeeting {
    /// Index of the move.
    pub watched: u32,
    /// The one whose link is nearer to the tool.
    pub moving: Party,
    /// The other one: index of a body.
    pub standing: u32,
    /// A place of the other one that is met first, or is nearest [part coordinates at that moment, mm].
    pub place: DVec3,
    /// Least distance [mm]; zero in a contact that is certain.
    pub distance: f64,
    /// The contact, if it is one; its lift is along the axis Z.
    pub contact: Option<Contact>,
}

impl MachineMeeting {
    /// Whether it is a contact of bodies where they are said to be.
    pub fn is_certain(&self) -> bool {
        self.contact.is_some_and(|contact| contact.certain)
    }
}

/// All that was found in moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Met {
    /// Contacts in the order of the moves, then the nearest pass of each pair in moves without a contact of it.
    pub meetings: Vec<MachineMeeting>,
    /// Moves in which joint positions are not known, all the way or somewhere: not compared in whole.
    pub lost: Vec<u32>,
    /// Moves whose bounds rest on derivatives at single places.
    pub sampled: Vec<u32>,
}

/// A pair: the tool in the spindle if it is one of the two, the moving one, the standing one.
type Two = (Option<u32>, Party, u32);

/// Nearest passes of pairs.
type Passes = NearestOf<Two, MachineMeeting>;

/// Distances that serve later moves.
struct Kept {
    near: Passes,
    clear: Clearances<Two>,
}

/// A machine with its bodies, tools, and what stands on its table.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use glam::DVec3;
/// use kinecut::base::Silent;
/// use kinecut::contact::{Body, LinkBody, MachineMove, MachineParts, MovingTool, Party, ToolInSpindle};
/// use kinecut::geom::{Aabb, Rigid, Solid};
/// use kinecut::machine::{CoordinateCode, Machine};
/// use kinecut::program::{Frame, Move, Origin, Path, Program, Setup, SetupId, Speed, State, Target, ToolAxis, WorkOffset};
/// use kinecut::trace::{CompStart, RegisterState, TraceOptions, trace};
/// // The table of this machine moves in X and Y, its head in Z; the tip runs 100 mm along X.
/// let code = CoordinateCode::parse("2103").unwrap();
/// let machine = Machine::new(code, [None; 3], Default::default()).unwrap();
/// let setup = Setup {
///     name: "setup 1".to_owned(),
///     part_on_table: Rigid::IDENTITY,
///     work_offsets: [(WorkOffset::G54, Rigid::IDENTITY)].into(),
///     located: true,
///     stock: None,
///     fixtures: Vec::new(),
/// };
/// let mut program = Program::new(vec![setup]);
/// let frame = program.add_frame(Frame::Work(WorkOffset::G54));
/// let mut state = State::start(SetupId(0), frame);
/// state.speed = Speed::Rapid { linear: true };
/// for x in [0.0, 100.0] {
///     let end = Target::Tip { point: DVec3::new(x, 0.0, 30.0), axis: ToolAxis::Fixed };
///     program.push_move(Move { end, path: Path::Line }, &state, Origin::default());
/// }
/// let options = TraceOptions {
///     machine: Some(&machine),
///     tools: &[],
///     retract_height: 250.0,
///     operator: RegisterState::default(),
///     radii: &[],
///     comp_start: CompStart::AtNext,
///     chord: 0.5,
/// };
/// let trace = trace(&program, &options).unwrap();
/// let segment = trace.segments.last().unwrap();
/// // A head 40 mm wide, and a post on the table that begins at X 60.
/// let body = |name: &str, link, min, max| {
///     let solid = Solid::Box(Aabb { min, max });
///     LinkBody { link, body: Body::new(name, &solid, Rigid::IDENTITY, 0.0).unwrap(), of_machine: true }
/// };
/// let head = body("head", machine.tool_link(), DVec3::new(-20.0, -20.0, 0.0), DVec3::new(20.0, 20.0, 100.0));
/// let post = body("post", machine.work_link(), DVec3::new(60.0, -10.0, 0.0), DVec3::new(80.0, 10.0, 50.0));
/// let tool = ToolInSpindle { tool: MovingTool::new([]), length: 0.0 };
/// let parts = MachineParts::new(&machine, Rigid::IDENTITY, vec![head, post], vec![tool]).unwrap();
/// let met = parts.meetings(&[MachineMove { segment, tool: 0 }], &[], &Silent).unwrap();
/// let [meeting] = &met.meetings[..] else { panic!() };
/// assert_eq!((meeting.moving, meeting.standing), (Party::Body(0), 1));
/// // From X 40 on; 20 mm higher it clears.
/// let contact = meeting.contact.as_ref().unwrap();
/// assert!((contact.from - 0.4).abs() < 1e-3 && contact.to == 1.0);
/// assert!((contact.clears_by.unwrap() - 20.0).abs() < 0.02);
/// ```
#[derive(Clone, Debug)]
pub struct MachineParts {
    machine: Machine,
    axes: Axes,
    part_on_table: Rigid,
    bodies: Vec<LinkBody>,
    /// For each tool its parts, its chain, and its place in front of the spindle.
    tools: Vec<(MovingTool, Kinematics, Rigid)>,
    /// Pairs of bodies by their links.
    pairs: Vec<LinkPair>,
    /// Bodies of the machine between the work and the tool, by their links.
    below_tool: Vec<LinkPair>,
    /// Chains from each place between joints to each later one.
    between: Vec<Vec<Kinematics>>,
}

/// Bodies on two links.
#[derive(Clone, Debug)]
struct LinkPair {
    /// Joints before the link that is nearer to the work, and before the other one.
    joints: [usize; 2],
    /// Pairs of bodies: standing, moving. For the tool the second has no meaning.
    bodies: Vec<[u32; 2]>,
    /// A box about all that stands.
    standing: Aabb,
    /// A body about all that moves.
    moving: Body,
}

impl MachineParts {
    /// A machine with tools and bodies; `part_on_table` maps part coordinates into its table frame. `None` where its axes cannot be
    /// followed: three independent linear ones and rotary ones, with the letters X Y Z A B C.
    pub fn new(
        machine: &Machine,
        part_on_table: Rigid,
        bodies: Vec<LinkBody>,
        tools: Vec<ToolInSpindle>,
    ) -> Option<MachineParts> {
        let axes = Axes::of(machine)?;
        let count = machine.joints.len();
        let chain = |from: usize, to: usize| {
            Kinematics::new(&machine.joints[from..to.max(from)], Rigid::IDENTITY, Rigid::IDENTITY)
        };
        let between = (0..=count).map(|from| (0..=count).map(|to| chain(from, to)).collect()).collect();
        let gap = |i: usize| match bodies[i].link {
            Link::Bed => machine.code.bed(),
            Link::Axis(joint) if joint < machine.code.bed() => joint,
            Link::Axis(joint) => joint + 1,
        };
        let mut pairs: Vec<LinkPair> = Vec::new();
        let mut below_tool: Vec<LinkPair> = Vec::new();
        let add = |list: &mut Vec<LinkPair>, joints: [usize; 2], pair: [u32; 2]| {
            let body = |i: u32| &bodies[i as usize].body;
            let standing = body(pair[0]).bounds.grown(most_of(body(pair[0]), body(pair[1])));
            let place = match list.iter().position(|p| p.joints == joints) {
                Some(place) => place,
                None => {
                    let (standing, moving) = (Aabb::EMPTY, whole(Aabb::EMPTY));
                    list.push(LinkPair { joints, bodies: Vec::new(), standing, moving });
                    list.len() - 1
                }
            };
            let of = &mut list[place];
            of.bodies.push(pair);
            of.standing = of.standing.union(standing);
            of.moving = whole(of.moving.bounds.union(body(pair[1]).bounds));
        };
        for i in 0..bodies.len() {
            for j in 0..bodies.len() {
                let joints = [gap(i), gap(j)];
                let both = bodies[i].of_machine && bodies[j].of_machine;
                if joints[0] < joints[1] && !(both && joints[1] == joints[0] + 1) {
                    add(&mut pairs, joints, [i as u32, j as u32]);
                }
            }
            if bodies[i].of_machine && gap(i) < count {
                add(&mut below_tool, [gap(i), count], [i as u32; 2]);
            }
        }
        let tool = |t: ToolInSpindle| (t.tool, machine.kinematics(t.length), tip_at_home(machine, t.length));
        let tools = tools.into_iter().map(tool).collect();
        let machine = machine.clone();
        Some(MachineParts { machine, axes, part_on_table, bodies, tools, pairs, below_tool, between })
    }

    /// The bodies.
    pub fn bodies(&self) -> &[LinkBody] {
        &self.bodies
    }

    /// Pairs of bodies that touch at the start of a move: where a program begins they are rather drawn wrongly, or stand on one
    /// another, than met by a motion. `None` where the positions of the joints are not known.
    pub fn touching(&self, first: &MachineMove<'_>) -> Option<Vec<[u32; 2]>> {
        let q = self.way(first)?.at(0.0);
        let mut touching = Vec::new();
        for pair in &self.pairs {
            let [from, to] = pair.joints;
            let motion = Standing(self.between[from][to].forward(&q[from..to]));
            let ends = [Moment::of(&motion, 0.0); 2];
            touching.extend(pair.bodies.iter().copied().filter(|[standing, moving]| {
                let body = |i: &u32| &self.bodies[*i as usize].body;
                let pair = Pair { motion: &motion, moving: body(moving), standing: body(standing) };
                pair.touch(&ends, 0.0).is_some()
            }));
        }
        touching.sort_unstable();
        Some(touching)
    }

    /// All meetings in moves, without those of pairs of bodies that are left out (in ascending order).
    ///
    /// # Errors
    /// `KC0009` when cancelled.
    pub fn meetings(
        &self,
        moves: &[MachineMove<'_>],
        left_out: &[[u32; 2]],
        progress: &dyn Progress,
    ) -> Result<Met> {
        progress.stage("contacts of the machine", moves.len() as u64);
        let task = |(n, moves): (usize, &[MachineMove<'_>])| {
            let mut met = Met::default();
            let mut kept = Kept { near: NearestOf::new(), clear: Clearances::new() };
            if progress.cancelled() {
                return (met, kept.near);
            }
            for (i, one) in moves.iter().enumerate() {
                let watched = (n * TASK + i) as u32;
                match self.way(one) {
                    Some(way) => {
                        if way.is_sampled() {
                            met.sampled.push(watched);
                        }
                        self.one_move(watched, &way, one.tool, left_out, (&mut met.meetings, &mut kept));
                        if way.is_lost() {
                            met.lost.push(watched);
                        }
                    }
                    None => met.lost.push(watched),
                }
            }
            progress.advance(moves.len() as u64);
            (met, kept.near)
        };
        let tasks: Vec<_> = moves.chunks(TASK).enumerate().collect();
        let found: Vec<(Met, Passes)> = tasks.into_par_iter().map(task).collect();
        cancelled(progress)?;
        let (mut met, mut near) = (Met::default(), NearestOf::new());
        for (part, passes) in found {
            near.join(passes);
            met.meetings.extend(part.meetings);
            met.lost.extend(part.lost);
            met.sampled.extend(part.sampled);
        }
        let mut contacts: Vec<&mut MachineMeeting> = met.meetings.iter_mut().take(MOST_LIFTS).collect();
        contacts.par_iter_mut().for_each(|meeting| self.lift(&moves[meeting.watched as usize], meeting));
        met.meetings.extend(near.into_passes());
        Ok(met)
    }

    fn way<'a>(&'a self, one: &MachineMove<'a>) -> Option<Way<'a>> {
        let (_, chain, _) = &self.tools[one.tool as usize];
        Way::new(one.segment, &self.axes, chain, &self.part_on_table)
    }

    /// Meetings in one move.
    fn one_move(
        &self,
        watched: u32,
        way: &Way<'_>,
        tool: u32,
        left_out: &[[u32; 2]],
        (found, kept): (&mut Vec<MachineMeeting>, &mut Kept),
    ) {
        let rates = way.rates(0.0, 1.0);
        let moves = |[from, to]: [usize; 2]| rates[from..to].iter().any(|(rate, _)| *rate > 0.0);
        let body = |i: u32| &self.bodies[i as usize].body;
        for pair in self.pairs.iter().filter(|pair| moves(pair.joints)) {
            let motion = self.motion(way, pair.joints, Rigid::IDENTITY);
            let ends = [0.0, 1.0].map(|t| Moment::of(&motion, t));
            if !may_meet(&motion, &pair.moving, &ends, pair.standing, TOUCH) {
                continue;
            }
            for [standing, moving] in pair.bodies.iter().filter(|p| left_out.binary_search(p).is_err()) {
                let (most, off) = most_and_off(body(*standing), body(*moving));
                let pair = Pair { motion: &motion, moving: body(*moving), standing: body(*standing) };
                let two = (None, Party::Body(*moving), *standing);
                self.meeting(watched, two, &pair, (&ends, most, off), (found, kept));
            }
        }
        let (parts, _, place) = &self.tools[tool as usize];
        for pair in self.below_tool.iter().filter(|pair| moves(pair.joints)) {
            let motion = self.motion(way, pair.joints, *place);
            let ends = [0.0, 1.0].map(|t| Moment::of(&motion, t));
            for (part, moving) in &parts.parts {
                if !may_meet(&motion, moving, &ends, pair.standing, TOUCH) {
                    continue;
                }
                for [standing, _] in &pair.bodies {
                    let pair = Pair { motion: &motion, moving, standing: body(*standing) };
                    let two = (Some(tool), Party::Tool(*part), *standing);
                    let Body { near, off, .. } = *body(*standing);
                    self.meeting(watched, two, &pair, (&ends, near, off), (found, kept));
                }
            }
        }
    }

    /// The contact of two bodies that may be `off`, or their pass where it is nearer than `most` and the nearest so far.
    fn meeting(
        &self,
        watched: u32,
        two: Two,
        pair: &Pair<'_, LinkMotion<'_>>,
        (ends, most, off): (&[Moment; 2], f64, f64),
        (found, Kept { near, clear }): (&mut Vec<MachineMeeting>, &mut Kept),
    ) {
        let (_, moving, standing) = two;
        let open = near.open(two, most);
        let asked = open.max(reach(off));
        let near_it = may_meet(pair.motion, pair.moving, ends, pair.standing.bounds, asked.max(TOUCH));
        if !near_it || clear.clear(two, pair, ends, asked) {
            return;
        }
        let LinkMotion { way, first, .. } = pair.motion;
        let meeting = |t: f64, place: DVec3, distance: f64, contact: Option<Contact>| {
            let place = self.in_part(&way.at(t), *first, place);
            MachineMeeting { watched, moving, standing, place, distance, contact }
        };
        if let Some((contact, Nearest { t, distance, place })) = contact(pair, ends, off) {
            found.push(meeting(t, place, distance, Some(contact)));
            return;
        }
        if open > 0.0
            && let Some(nearest) = pair.nearest(ends, open)
        {
            near.note(two, nearest.distance, meeting(nearest.t, nearest.place, nearest.distance, None));
        }
    }

    fn motion<'a>(&'a self, way: &'a Way<'a>, [first, last]: [usize; 2], place: Rigid) -> LinkMotion<'a> {
        LinkMotion { way, chain: &self.between[first][last], first, last, place }
    }

    /// Part coordinates of a place on the link behind this many joints.
    fn in_part(&self, q: &JointValues, joints: usize, place: DVec3) -> DVec3 {
        let at_work = self.between[0][joints].forward(&q[..joints]).point(place);
        self.part_on_table.inverse().after(&self.machine.work.inverse()).point(at_work)
    }

    /// Finds the lift along Z that clears, where Z is between the two and no rotary joint moves.
    fn lift(&self, one: &MachineMove<'_>, meeting: &mut MachineMeeting) {
        let list = if matches!(meeting.moving, Party::Body(_)) { &self.pairs } else { &self.below_tool };
        let is_own = |p: &&LinkPair| {
            p.bodies.iter().any(|[standing, moving]| {
                let same =
                    |i: u32| matches!(meeting.moving, Party::Tool(_)) || meeting.moving == Party::Body(i);
                *standing == meeting.standing && same(*moving)
            })
        };
        let (Some(way), Some(pair), Some(up)) =
            (self.way(one).filter(Way::is_still), list.iter().find(is_own), self.axes.upward())
        else {
            return;
        };
        let [first, last] = pair.joints;
        if !(first..last).contains(&up) {
            return;
        }
        let joint = &self.machine.joints[up];
        let before = self.between[first][up].forward(&way.at(0.0)[first..up]);
        let up = before.vector(joint.direction * joint.sense);
        let standing = &self.bodies[meeting.standing as usize].body;
        let (parts, _, place) = &self.tools[one.tool as usize];
        let lift = match meeting.moving {
            Party::Body(i) => {
                let motion = self.motion(&way, pair.joints, Rigid::IDENTITY);
                clearing(&motion, std::iter::once(&self.bodies[i as usize].body), standing, up)
            }
            Party::Tool(_) => clearing(&self.motion(&way, pair.joints, *place), parts.bodies(), standing, up),
        };
        if let Some(contact) = &mut meeting.contact {
            contact.clears_by = Some(lift);
        }
    }
}

/// The distance up to which two bodies are looked at, and how far off they may be [mm].
fn most_and_off(a: &Body, b: &Body) -> (f64, f64) {
    (a.near.max(b.near), a.off.max(b.off))
}

/// The distance within which anything counts [mm].
fn most_of(a: &Body, b: &Body) -> f64 {
    let (near, off) = most_and_off(a, b);
    near.max(off)
}

/// A body that is a box.
fn whole(bounds: Aabb) -> Body {
    Body::convex(String::new(), vec![Piece::Box { place: Rigid::IDENTITY, bounds }], false)
}
