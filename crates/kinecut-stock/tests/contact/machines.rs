//! Bodies on the links of machines of three and five axes, along programs.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use glam::{DMat3, DVec3};
use kinecut_stock::base::Silent;
use kinecut_stock::contact::{
    Body, Contact, LinkBody, MachineMeeting, MachineMove, MachineParts, ToolInSpindle,
};
use kinecut_stock::geom::{Arc, Curve, Rigid};
use kinecut_stock::machine::{CoordinateCode, JointValues, Link, Machine};
use kinecut_stock::program::{
    Frame, Move, Origin, Path, Program, Setup, SetupId, Speed, State, Target, Tcp, ToolAxis, ToolNumber,
    WorkOffset,
};
use kinecut_stock::tool::{Cutter, Tool};
use kinecut_stock::trace::{CompStart, RegisterState, Segment, TraceOptions, trace};

use crate::judge::{Random, Shown, apart, body, meets, tool};

/// Three axes; five with two tables, two heads, one of each; a rotary axis between linear ones.
const CODES: [&str; 8] = ["2103", "0213", "641203", "651203", "450123", "012365", "612035", "261035"];

/// A machine with offsets, so that nothing cancels by chance.
fn machine(random: &mut Random, code: &str) -> Machine {
    let code = CoordinateCode::parse(code).expect("a case of these numbers");
    let mut machine = Machine::new(code, [None; 3], Default::default()).expect("a case of these numbers");
    for joint in &mut machine.joints {
        if joint.motion.is_rotation() {
            joint.point = random.point(60.0);
            joint.sense = if random.next() < 0.3 { -1.0 } else { 1.0 };
        }
    }
    machine
}

const WORK: DVec3 = DVec3::new(30.0, -20.0, 15.0);

fn placed() -> Rigid {
    Rigid { rotation: DMat3::from_rotation_z(FRAC_PI_2), translation: WORK }
}

/// A program of one move behind its start.
fn program(random: &mut Random, machine: &Machine) -> Program {
    let setup = Setup {
        name: "setup 1".to_owned(),
        part_on_table: placed(),
        work_offsets: BTreeMap::from([(WorkOffset::G54, Rigid::from_translation(WORK))]),
        located: true,
        stock: None,
        fixtures: Vec::new(),
    };
    let mut program = Program::new(vec![setup]);
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    state.speed = Speed::Rapid { linear: true };
    program.push_tool(ToolNumber(1), Some(1), None, &state, Origin::default());
    let mut to = |state: &State, point: DVec3, axis: ToolAxis, path: Path| {
        let end = Target::Tip { point, axis };
        program.push_move(Move { end, path }, state, Origin::default());
    };
    let start = random.point(60.0);
    let letters = ['A', 'B', 'C'].map(|l| machine.joint(l).is_some());
    let angles = |random: &mut Random, by: f64| {
        ToolAxis::Rotary([0, 1, 2].map(|i| letters[i].then(|| random.between(-by, by))))
    };
    let turns = machine.is_multi_axis();
    let begin = if turns { angles(random, 1.2) } else { ToolAxis::Fixed };
    to(&state, start, begin, Path::Line);
    state.speed = Speed::PerMinute(900.0);
    let kind = if turns { random.next() } else { random.between(0.75, 1.0) };
    let end = random.point(80.0);
    if kind < 0.3 {
        state.tcp = Tcp::Axes;
        to(&state, end, angles(random, 1.4), Path::Line);
    } else if kind < 0.5 {
        state.tcp = Tcp::Vector;
        to(&state, end, angles(random, 0.8), Path::Line);
    } else if kind < 0.75 {
        to(&state, end, angles(random, 3.0), Path::Line);
    } else if kind < 0.87 {
        to(&state, end, ToolAxis::Fixed, Path::Line);
    } else {
        state.tcp = if turns { Tcp::Axes } else { Tcp::Off };
        let centre = start + random.point(40.0).with_z(0.0);
        let (sweep, rise) = (random.between(-6.0, 6.0), random.between(-9.0, 9.0));
        let arc = Arc::new(start, centre, DVec3::Z, sweep, rise).expect("a case of these numbers");
        let end = Curve::from(arc).end();
        to(&state, end, ToolAxis::Fixed, Path::Arc { centre, axis: DVec3::Z, sweep, rise });
    }
    program
}

fn followed(program: &Program, machine: &Machine, tool: &Tool) -> Option<Vec<Segment>> {
    let tools = [tool.clone()];
    let options = TraceOptions {
        machine: Some(machine),
        tools: &tools,
        retract_height: 250.0,
        operator: RegisterState::default(),
        radii: &[],
        comp_start: CompStart::AtNext,
        chord: 0.5,
    };
    trace(program, &options).ok().map(|trace| trace.segments)
}

const LENGTH: f64 = 120.0;

/// The tool of the program; its form is that of the judge.
fn in_program() -> Tool {
    Tool {
        number: ToolNumber(1),
        name: String::new(),
        cutter: Cutter::EndMill { diameter: 10.0 },
        teeth: 2,
        spacing: Default::default(),
        flute_length: 20.0,
        stickout: 40.0,
        shank_diameter: 10.0,
        holder: None,
        centre_cutting: true,
        max_ramp_angle: None,
        gauge_length: Some(LENGTH),
        limits: Default::default(),
        elasticity: None,
    }
}

/// A body of the judge's on a link.
struct Carried {
    link: Link,
    shown: Vec<Shown>,
    reach: f64,
}

/// Two carried bodies along a segment, as the judge sees them.
struct Case<'a> {
    machine: &'a Machine,
    segment: &'a Segment,
    moving: Carried,
    standing: Carried,
}

impl Case<'_> {
    fn joints(&self, t: f64) -> JointValues {
        let axes = self.segment.joints(t).expect("a case of these numbers");
        let values: Vec<f64> = self
            .machine
            .joints
            .iter()
            .map(|j| axes["XYZABC".find(j.letter).expect("a case of these numbers")])
            .collect();
        JointValues::new(&values)
    }

    /// The place of a link in the coordinates of the standing one.
    fn seen(&self, link: Link, t: f64) -> Rigid {
        let q = self.joints(t);
        self.machine.link(self.standing.link, &q).inverse().after(&self.machine.link(link, &q))
    }

    fn distance_of(&self, standing: &Shown, t: f64) -> f64 {
        let at = self.seen(self.moving.link, t);
        let one = |shown: &Shown| apart((shown, &at), (standing, &Rigid::IDENTITY));
        self.moving.shown.iter().map(one).fold(f64::INFINITY, f64::min)
    }

    /// A bound on the speed of all points of the moving body [mm by `t`]: the largest of many, with room.
    fn speed(&self) -> f64 {
        const STEPS: u32 = 400;
        let at = |k: u32| self.seen(self.moving.link, f64::from(k) / f64::from(STEPS));
        let centre = self.moving.shown[0].place.translation;
        let one = |k: u32| {
            let (a, b) = (at(k), at(k + 1));
            let turned = b.rotation - a.rotation;
            let turned = turned.to_cols_array().iter().map(|c| c * c).sum::<f64>().sqrt();
            (b.point(centre) - a.point(centre)).length() + self.moving.reach * turned
        };
        1.2 * f64::from(STEPS) * (0..STEPS).map(one).fold(0.0, f64::max)
    }
}

#[test]
fn contacts_and_near_misses_of_links_are_those_of_another_library() {
    const NEAR: f64 = 0.5;
    let mut random = Random(11);
    let (mut contacts, mut misses, mut tools, mut lifts) = (0, 0, 0, 0);
    let mut by_code = [0; CODES.len()];
    let mut round = 0;
    while contacts < 200 || misses < 200 || by_code.iter().any(|count| *count < 8) {
        round += 1;
        let code = round % CODES.len();
        let machine = machine(&mut random, CODES[code]);
        let program = program(&mut random, &machine);
        let Some(segments) = followed(&program, &machine, &in_program()) else { continue };
        let Some(segment) = segments.get((random.next() * segments.len() as f64) as usize) else { continue };
        let joints = machine.joints.len();
        // Places between joints, from the work to the tool.
        let low = (random.next() * joints as f64) as usize;
        let high = low + 1 + (random.next() * (joints - low) as f64) as usize;
        let bed = machine.code.bed();
        let link = |gap: usize| match gap {
            gap if gap == bed => Link::Bed,
            gap => Link::Axis(if gap < bed { gap } else { gap - 1 }),
        };
        let with_tool = high == joints && random.next() < 0.5;
        let (in_spindle, mut shown, reach) = tool(&mut random);
        let at_home = machine.spindle.after(&Rigid::from_translation(DVec3::Z * -LENGTH));
        let mut bodies = Vec::new();
        let link_body = |link: Link, body: Body| LinkBody { link, body, of_machine: with_tool };
        let moving = if with_tool {
            shown.iter_mut().for_each(|s| s.place = at_home.after(&s.place));
            Carried { link: link(high), shown, reach }
        } else {
            let at = at_home.translation + random.point(80.0);
            let (solid, place, shown) = body(&mut random, at);
            bodies.push(link_body(link(high), Body::new("moving", &solid, place, 0.0).unwrap()));
            Carried { link: link(high), shown: vec![shown], reach: 80.0 }
        };
        let standing = Carried { link: link(low), shown: Vec::new(), reach: 0.0 };
        let case = Case { machine: &machine, segment, moving, standing };
        if (0..=20).any(|k| segment.joints(f64::from(k) / 20.0).is_none()) {
            continue;
        }
        // At a pole the axes swing round at once: no speed bounds that for the judge.
        let swings = |k: u32| {
            let [a, b] = [k, k + 1].map(|k| case.joints(f64::from(k) / 400.0));
            (0..joints).any(|i| machine.joints[i].motion.is_rotation() && (b[i] - a[i]).abs() > 0.1)
        };
        let speed = case.speed();
        if speed < 1.0 || (0..400).any(swings) {
            continue;
        }
        let there = case.seen(case.moving.link, random.next());
        let near = there.point(case.moving.shown[0].place.translation) + random.point(70.0);
        let (solid, place, mut judged) = body(&mut random, near);
        let find_off = |bodies: &[LinkBody], by: DVec3, off: f64| -> Vec<MachineMeeting> {
            let place = Rigid { translation: place.translation + by, ..place };
            let mut bodies = bodies.to_vec();
            let standing = Body::new("standing", &solid, place, NEAR).unwrap().off_by(off);
            bodies.push(link_body(link(low), standing));
            let tool = ToolInSpindle { tool: in_spindle.clone(), length: LENGTH };
            let parts = MachineParts::new(&machine, placed(), bodies, vec![tool]).unwrap();
            let met = parts.meetings(&[MachineMove { segment, tool: 0 }], &[], &Silent).unwrap();
            assert!(met.lost.is_empty());
            met.meetings
        };
        let find = |bodies: &[LinkBody], by: DVec3| find_off(bodies, by, 0.0);
        let judge = |standing: &Shown, touch: f64, from: f64, way: f64| {
            meets(|t| case.distance_of(standing, t), speed, from, way, touch)
        };
        let (met, least) = judge(&judged, 1e-4, 0.0, 1.0);
        if let Some(first) = met {
            // A mesh of the judge has no inside: a body that begins within is no case for it.
            if least == 0.0 && first == 0.0 {
                continue;
            }
            let found = find(&bodies, DVec3::ZERO);
            let touched: Vec<Contact> = found.iter().filter_map(|m| m.contact).collect();
            assert!(!touched.is_empty(), "{}: a contact at {first} is not found", CODES[code]);
            let from = touched.iter().map(|c| c.from).fold(1.0, f64::min);
            let to = touched.iter().map(|c| c.to).fold(0.0, f64::max);
            let last = judge(&judged, 1e-4, 1.0, -1.0).0.unwrap();
            let [sooner, later] =
                [judge(&judged, 0.01, 0.0, 1.0).0.unwrap(), judge(&judged, 0.01, 1.0, -1.0).0.unwrap()];
            let room = 0.01 / speed;
            assert!(from <= first + room && from >= sooner - room, "{from} {first} {sooner} {room}");
            assert!(to >= last - room && to <= later + room, "{to} {last} {later} {room}");
            contacts += 1;
            by_code[code] += 1;
            tools += u32::from(with_tool);
            lifts += u32::from(touched.iter().any(|c| c.clears_by.is_some()));
        } else if least > 0.2 {
            assert!(find(&bodies, DVec3::ZERO).iter().all(|m| m.contact.is_none()));
            // Moved to 0.2 mm: nearer by what it was farther, along the shortest way.
            let steps = (0..=400).map(|i| f64::from(i) / 400.0);
            let far = |t: f64| case.distance_of(&judged, t);
            let nearest = steps.min_by(|a, b| far(*a).total_cmp(&far(*b))).unwrap();
            let moved = |by: DVec3| {
                let place = Rigid { translation: judged.place.translation + by, ..judged.place };
                case.distance_of(&Shown { shape: judged.shape.clone_dyn(), place }, nearest)
            };
            let slope = |axis: DVec3| (moved(axis * 1e-3) - moved(axis * -1e-3)) / 2e-3;
            let away = DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z)).normalize_or_zero();
            let by = away * (0.2 - least);
            judged.place.translation += by;
            let least = judge(&judged, 1e-4, 0.0, 1.0).1;
            if !(0.1..0.3).contains(&least) {
                continue;
            }
            let found = find(&bodies, by);
            assert!(found.iter().all(|m| m.contact.is_none()), "{least}");
            let nearest = found.iter().map(|m| m.distance).fold(f64::INFINITY, f64::min);
            // The judge steps by the distance: it is at least half a step off the nearest.
            assert!(nearest <= least + 2e-3 && nearest >= least - 0.11, "{nearest} {least}");
            let may = find_off(&bodies, by, least + 0.02);
            let mut contacts = may.iter().filter_map(|m| m.contact);
            assert!(contacts.any(|contact| !contact.certain) && may.iter().all(|m| !m.is_certain()));
            assert!(find_off(&bodies, by, nearest - 0.03).iter().all(|m| m.contact.is_none()));
            misses += 1;
        }
    }
    assert!(tools > 20 && lifts > 5, "{tools} {lifts}");
}
