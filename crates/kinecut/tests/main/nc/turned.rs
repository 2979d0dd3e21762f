//! Shifted and turned frames on the controls: what is written is the path that was meant, whether the control turns it or
//! the writer does, and reading it gives it back.

mod read;
mod written;

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::{DMat3, DVec2, DVec3};
use kinecut::base::Sources;
use kinecut::geom::{Arc, Curve, InvoluteRecord, Line, Rigid};
use kinecut::job::compare;
use kinecut::nc::{self, Control, PostSettings, Posted, Reading};
use kinecut::program::{
    Coolant, Cycle, Frame, FrameId, Move, Origin, Path, Program, Setup, SetupId, Speed, Spindle, State,
    StopKind, Target, ToolAxis, ToolNumber, WorkOffset,
};
use kinecut::tool::{Cutter, Tool};
use kinecut::trace::{CompStart, Trace, TraceOptions, trace};
use proptest::prelude::*;

const RAPID: Speed = Speed::Rapid { linear: false };

/// A motion by an angle [deg] and a shift, from the definition of sine and cosine.
fn motion(degrees: f64, x: f64, y: f64, z: f64) -> Rigid {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let rotation =
        DMat3::from_cols(DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0), DVec3::new(0.0, 0.0, 1.0));
    Rigid { rotation, translation: DVec3::new(x, y, z) }
}

fn setup() -> Setup {
    // The part lies askew on the table.
    let at = |x: f64| Rigid { translation: DVec3::new(x, 200.0, -50.0), ..motion(0.0, 0.0, 0.0, 0.0) };
    let offset = |name: &str| WorkOffset::parse(name).unwrap();
    Setup {
        name: "1".to_owned(),
        part_on_table: motion(10.0, 1.0, 2.0, 3.0),
        work_offsets: BTreeMap::from([(offset("G54"), at(300.0)), (offset("G55"), at(-40.0))]),
        located: false,
        stock: None,
        fixtures: Vec::new(),
    }
}

fn tool(number: u32) -> Tool {
    Tool {
        number: ToolNumber(number),
        name: format!("mill {number}"),
        cutter: Cutter::EndMill { diameter: 63.0 },
        teeth: 6,
        spacing: Default::default(),
        flute_length: 20.0,
        stickout: 60.0,
        shank_diameter: 30.0,
        holder: None,
        centre_cutting: true,
        max_ramp_angle: None,
        gauge_length: Some(120.0),
        limits: Default::default(),
        elasticity: None,
    }
}

fn traced(program: &Program) -> Trace {
    let tools = [tool(1), tool(2)];
    let options = TraceOptions {
        chord: 1e-3,
        machine: None,
        tools: &tools,
        retract_height: 100.0,
        operator: kinecut::trace::RegisterState::default(),
        radii: &[(1, 5.0)],
        comp_start: CompStart::AtNext,
    };
    trace(program, &options).unwrap()
}

fn read_text(text: &str, control: Control) -> Reading {
    nc::read(&mut Sources::default(), "test", text, control, &[setup()])
        .unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A program under construction.
struct Builder {
    control: Control,
    program: Program,
    state: State,
    /// Tip in the frame of the state.
    at: DVec3,
}

impl Builder {
    fn new(control: Control) -> Builder {
        let mut program = Program::new(vec![setup()]);
        let frame = program.add_frame(Frame::Work(WorkOffset::G54));
        let mut state = State::start(SetupId(0), frame);
        state.blend = control.usual_blend();
        let mut b = Builder { control, program, state, at: DVec3::NAN };
        b.tool(1);
        b
    }

    fn tool(&mut self, number: u32) {
        let register = Some(self.control.length_register(ToolNumber(number)));
        let radius = register.filter(|_| self.control.wear_holds_length());
        self.state.spindle = Spindle::Off;
        self.state.coolant = Coolant::Off;
        self.program.push_tool(ToolNumber(number), register, radius, &self.state, Origin::default());
        self.state.spindle = Spindle::Clockwise(2000.0 / 60.0 * TAU);
    }

    fn resolved(&self, frame: FrameId) -> (WorkOffset, Rigid) {
        match self.program.frames[frame.0 as usize] {
            Frame::Work(offset) => (offset, motion(0.0, 0.0, 0.0, 0.0)),
            Frame::Shift { parent, motion } => {
                let (offset, outer) = self.resolved(parent);
                (offset, outer.after(&motion))
            }
            ref other => panic!("{other:?}"),
        }
    }

    fn frame(&mut self, frame: FrameId) {
        let ((old, from), (new, to)) = (self.resolved(self.state.frame), self.resolved(frame));
        self.at = if old == new { to.inverse().point(from.point(self.at)) } else { DVec3::NAN };
        self.state.frame = frame;
    }

    fn shifted(&mut self, parent: FrameId, motion: Rigid) -> FrameId {
        self.program.add_frame(Frame::Shift { parent, motion })
    }

    fn work(&mut self, name: &str) -> FrameId {
        self.program.add_frame(Frame::Work(WorkOffset::parse(name).unwrap()))
    }

    fn go(&mut self, speed: Speed, curve: impl Into<Curve>) {
        self.state.speed = speed;
        let curve = curve.into();
        self.at = curve.end();
        self.program.push_move(Move::along(&curve), &self.state, Origin::default());
    }

    fn line(&mut self, speed: Speed, x: f64, y: f64, z: f64) {
        self.go(speed, Line { start: self.at, end: DVec3::new(x, y, z) });
    }

    fn arc(&mut self, speed: Speed, radius: f64, from: f64, sweep: f64, rise: f64) {
        let centre = self.at - (DVec2::from_angle(from) * radius).extend(0.0);
        self.go(speed, Arc { start: self.at, centre, axis: DVec3::Z, sweep, rise });
    }

    /// To a point of which some coordinates stay.
    fn partly(&mut self, point: DVec3) {
        self.state.speed = RAPID;
        let end = Target::Tip { point, axis: ToolAxis::Fixed };
        self.program.push_move(Move { end, path: Path::Line }, &self.state, Origin::default());
        let pick = |said: f64, stays: f64| if said.is_nan() { stays } else { said };
        self.at = DVec3::new(pick(point.x, self.at.x), pick(point.y, self.at.y), pick(point.z, self.at.z));
    }

    fn retract(&mut self) {
        self.state.speed = RAPID;
        let end = Target::Joints([None, None, Some(0.0), None, None, None]);
        self.program.push_move(Move { end, path: Path::Line }, &self.state, Origin::default());
        self.at.z = f64::NAN;
    }

    fn cycle(&mut self, speed: Speed, cycle: Cycle) {
        self.state.speed = speed;
        self.program.push_cycle(cycle, &self.state, Origin::default()).unwrap();
        self.at.z = cycle.expansion().map_or(f64::NAN, |_| match cycle {
            Cycle::Drill { retract, .. } | Cycle::Peck { retract, .. } => retract,
            _ => f64::NAN,
        });
    }

    fn stop(&mut self, kind: StopKind) {
        self.program.push_stop(kind, &self.state, Origin::default());
    }
}

/// Least distance of a point from a curve near a fraction of its length: by nested intervals around the guess.
fn off(curve: &Curve, p: DVec3, fraction: f64) -> f64 {
    let length = curve.length();
    let (mut low, mut high) = ((fraction - 0.02).max(0.0) * length, (fraction + 0.02).min(1.0) * length);
    for _ in 0..100 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if (curve.at(a).p - p).length() < (curve.at(b).p - p).length() { high = b } else { low = a }
    }
    (curve.at(low).p - p).length()
}

/// What a job's own comparison of plan and text says.
fn read_back(program: &Program, posted: &Posted, control: Control) -> f64 {
    let mut sources = Sources::default();
    let reading = nc::read(&mut sources, "test", &posted.text, control, &[setup()]).unwrap();
    let item_of = |i: u32| {
        let line = sources.line(reading.program.origin(i as usize).span.unwrap()) as usize - 1;
        posted.lines[line]
    };
    let found = compare(&traced(program), &traced(&reading.program), item_of);
    found.unwrap_or_else(|e| panic!("{e}\n{}", posted.text)).largest
}

/// Largest distance of the path of a text from that of its program, move by move.
fn apart(program: &Program, posted: &Posted, control: Control) -> f64 {
    let mut sources = Sources::default();
    let reading = nc::read(&mut sources, "test", &posted.text, control, &[setup()])
        .unwrap_or_else(|e| panic!("{e}\n{}", posted.text));
    let item_of = |i: u32| {
        let line = sources.line(reading.program.origin(i as usize).span.unwrap()) as usize - 1;
        posted.lines[line]
    };
    let segments = |t: Trace| t.segments.into_iter().filter(|s| !s.alternative).collect::<Vec<_>>();
    let planned = segments(traced(program));
    let written = segments(traced(&reading.program));
    let mut next = 0;
    let mut worst = 0.0f64;
    for group in planned.chunk_by(|a, b| a.item == b.item) {
        // Coordinates that are said anew in another frame are rounded anew.
        while written.get(next).is_some_and(|s| item_of(s.item) < Some(group[0].item)) {
            assert!(written[next].curve.length() < 0.002, "{}", posted.text);
            next += 1;
        }
        let from = next;
        // In a series of holes the move to a hole is written for the item of its cycle.
        let own = |i: u32| item_of(i) == Some(group[0].item);
        while next < written.len() && own(written[next].item) {
            next += 1;
        }
        let mut pieces = &written[from..next];
        if group.len() > 1 {
            if pieces.len() == group.len() + 1 {
                assert!(pieces[0].curve.length() < 0.002, "{}", posted.text);
                pieces = &pieces[1..];
            }
            assert_eq!(group.len(), pieces.len(), "item {}\n{}", group[0].item, posted.text);
            for (segment, piece) in group.iter().zip(pieces) {
                for s in [0.0, 1.0] {
                    let at = |c: &Curve| c.at(s * c.length()).p;
                    worst = worst.max((at(&segment.curve) - at(&piece.curve)).length());
                }
            }
            continue;
        }
        let curve = &group[0].curve;
        if pieces.is_empty() {
            assert!(curve.length() < 1e-6, "item {} is lost\n{}", group[0].item, posted.text);
            continue;
        }
        let whole: f64 = pieces.iter().map(|p| p.curve.length()).sum();
        assert!(
            (whole - curve.length()).abs() < 0.02 + 1e-4 * curve.length(),
            "item {} {whole} {}\n{}",
            group[0].item,
            curve.length(),
            posted.text
        );
        let mut before = 0.0;
        for piece in pieces {
            for k in 0..=8 {
                let s = piece.curve.length() * f64::from(k) / 8.0;
                worst = worst.max(off(curve, piece.curve.at(s).p, (before + s) / whole));
            }
            before += piece.curve.length();
        }
        worst = worst.max((pieces[pieces.len() - 1].curve.end() - curve.end()).length());
    }
    assert_eq!(next, written.len(), "{}", posted.text);
    worst
}

#[derive(Clone, Debug)]
enum Step {
    Line(DVec3),
    Rapid(DVec3),
    Sideways(f64),
    Arc { radius: f64, from: f64, sweep: f64, rise: f64 },
    Upright { radius: f64, sweep: f64 },
    Involute { angle: f64 },
    Hole(f64),
    Frame(usize),
    Retract,
    Tool,
    Stop,
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    let point =
        || (-300.0..300.0f64, -300.0..300.0f64, 1.0..60.0f64).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    let step = prop_oneof![
        3 => point().prop_map(Step::Line),
        2 => point().prop_map(Step::Rapid),
        1 => (-300.0..300.0f64).prop_map(Step::Sideways),
        3 => (0.5..200.0f64, -4.0..4.0f64, -12.0..12.0f64, prop_oneof![Just(0.0), -20.0..20.0f64])
            .prop_map(|(radius, from, sweep, rise)| Step::Arc { radius, from, sweep, rise }),
        1 => (2.0..30.0f64, -3.0..3.0f64).prop_map(|(radius, sweep)| Step::Upright { radius, sweep }),
        1 => (-3.0..3.0f64).prop_map(|angle| Step::Involute { angle }),
        2 => (-300.0..300.0f64).prop_map(Step::Hole),
        5 => (0usize..7).prop_map(Step::Frame),
        1 => Just(Step::Retract),
        1 => Just(Step::Tool),
        1 => Just(Step::Stop),
    ];
    prop::collection::vec(step, 1..10)
}

fn build(control: Control, steps: &[Step], motions: [Rigid; 4]) -> Program {
    let mut b = Builder::new(control);
    let feed = Speed::PerMinute(20.0);
    let (g54, g55) = (b.work("G54"), b.work("G55"));
    let [a, c, d, e] = motions;
    let first = b.shifted(g54, a);
    let frames = [
        g54,
        first,
        b.shifted(g54, c),
        b.shifted(first, d),
        g55,
        b.shifted(g55, a),
        b.shifted(g55, Rigid { rotation: DMat3::IDENTITY, ..e }),
    ];
    b.line(RAPID, 1.0, 2.0, 30.0);
    for (index, step) in steps.iter().enumerate() {
        match *step {
            Step::Line(to) => b.line(feed, to.x, to.y, to.z),
            Step::Rapid(to) => b.line(RAPID, to.x, to.y, to.z),
            Step::Sideways(x) => b.partly(DVec3::new(x, f64::NAN, f64::NAN)),
            Step::Arc { radius, from, sweep, rise } => b.arc(feed, radius, from, sweep, rise),
            Step::Upright { radius, sweep } => {
                let centre = b.at + DVec3::Z * radius;
                b.go(feed, Arc { start: b.at, centre, axis: DVec3::Y, sweep, rise: 0.0 });
            }
            Step::Involute { angle } => {
                let record = InvoluteRecord::new(
                    242.249726898481,
                    [-40.0, 40.0],
                    9.99138208933461,
                    57.5810791850552,
                    80.0,
                );
                let record = record.unwrap().rotated(angle);
                let record = record.shifted(b.at.truncate() - record.start());
                b.go(feed, Curve::involute(record, b.at.z, 0.0));
            }
            Step::Hole(x) => {
                b.line(RAPID, x, b.at.y, b.at.z.max(5.0));
                // Each of its own depth: no series.
                let bottom = -12.5 - 0.5 * index as f64;
                let hole = Cycle::Drill { reference: 2.0, bottom, retract: b.at.z, dwell: 0.0 };
                b.cycle(Speed::PerMinute(3.0), hole);
            }
            Step::Frame(number) => {
                b.frame(frames[number]);
                if b.at.is_nan() {
                    b.line(RAPID, 5.0, 6.0, 40.0);
                }
                // Heights may differ by the shift: above the holes again.
                if b.at.z < 3.0 {
                    b.partly(DVec3::new(f64::NAN, f64::NAN, 20.0));
                }
            }
            Step::Retract => {
                let at = b.at;
                b.retract();
                b.partly(DVec3::new(at.x + 1.0, at.y, f64::NAN));
                b.line(RAPID, at.x + 1.0, at.y, at.z);
            }
            Step::Tool => {
                let at = b.at;
                b.retract();
                b.tool(2);
                b.partly(DVec3::new(at.x, at.y, f64::NAN));
                b.line(RAPID, at.x, at.y, at.z);
                b.tool(1);
                b.line(RAPID, at.x, at.y, at.z);
            }
            Step::Stop => b.stop(StopKind::Optional),
        }
    }
    b.stop(StopKind::End);
    b.program
}

fn turn() -> impl Strategy<Value = Rigid> {
    let angle = prop_oneof![
        -180.0..180.0f64,
        (-1800i32..1800).prop_map(|t| f64::from(t) * 0.1),
        (-4i32..4).prop_map(|q| f64::from(q) * 90.0),
    ];
    let shift = prop_oneof![
        Just(DVec3::ZERO),
        (-100.0..100.0f64, -100.0..100.0f64, -5.0..5.0f64).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    ];
    (angle, shift).prop_map(|(degrees, s)| motion(degrees, s.x, s.y, s.z))
}

proptest! {
    #![proptest_config(kinecut_cases::property(24))]

    /// What is written lies on what was meant, said by the control's words or turned by the writer; and what was read is
    /// written again with the same bytes.
    #[test]
    fn the_path_of_the_text_is_that_of_the_program(
        steps in steps(), motions in [turn(), turn(), turn(), turn()], decimals in 3u8..=5,
    ) {
        for &control in Control::WRITTEN {
            let program = build(control, &steps, motions);
            for rotation in [true, false] {
                let settings = PostSettings { rotation, decimals, ..PostSettings::new(control) };
                let posted = nc::write(&program, &[], &settings).unwrap_or_else(|e| panic!("{control} {e}"));
                let words = ["RPL=", "G68 ", "G10 L2", "ROT+", "ROT-", "TRANS", "G52"];
                prop_assert!(rotation || words.iter().all(|w| !posted.text.contains(w)), "{}", posted.text);
                let apart = apart(&program, &posted, control);
                let unit = control.resolution(decimals);
                prop_assert!(read_back(&program, &posted, control) < 0.001 + 2.0 * unit, "{control}\n{}", posted.text);
                prop_assert!(apart < 0.001 + 2.0 * unit, "{control} {apart}\n{}", posted.text);
                let again = nc::write(&read_text(&posted.text, control).program, &[], &settings).unwrap();
                prop_assert_eq!(&posted.text, &again.text);
            }
        }
    }
}
