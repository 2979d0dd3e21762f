//! Writing and reading NC text are inverse: random programs, tiny arcs, involutes, hostile comments.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use kinecut::base::Sources;
use kinecut::geom::{Arc, Curve, InvoluteRecord, Line};
use kinecut::nc::{self, Control, PostSettings, Posted, Reading, Units};
use kinecut::program::{
    Blend, Coolant, Frame, Item, Move, Origin, Path, Program, SetupId, Speed, Spindle, State, StopKind,
    Target, ToolAxis, ToolNumber, WorkOffset,
};
use proptest::prelude::*;

const CONTROLS: &[Control] = Control::WRITTEN;

/// What a control can carry of a state: the nearest feed, coolant and passage.
fn carried_state(control: Control, state: &mut State) {
    state.blend = control.blend(state.blend);
    if control == Control::Grbl {
        if let Speed::PerRevolution(feed) = state.speed {
            state.speed = Speed::PerMinute(feed);
        }
        if state.coolant == Coolant::Mist {
            state.coolant = Coolant::Flood;
        }
    }
}

fn settings(control: Control, decimals: u8) -> PostSettings {
    PostSettings { decimals, ..PostSettings::new(control) }
}

fn read(text: &str, control: Control) -> Reading {
    nc::read(&mut Sources::default(), "test", text, control, &[]).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn post(program: &Program, control: Control, decimals: u8) -> Posted {
    nc::write(program, &[], &settings(control, decimals)).unwrap_or_else(|e| panic!("{e}"))
}

/// A program that starts with a tool above the origin.
struct Builder {
    program: Program,
    state: State,
    at: DVec3,
}

impl Builder {
    fn new(start: DVec3) -> Builder {
        let mut program = Program::default();
        let frame = program.add_frame(Frame::Work(WorkOffset::G54));
        let mut state = State::start(SetupId(0), frame);
        program.push_tool(ToolNumber(1), Some(1), None, &state, Origin::default());
        state.spindle = Spindle::Clockwise(1200.0 / 60.0 * TAU);
        state.blend = Blend::Continuous;
        let mut b = Builder { program, state, at: start };
        b.rapid(start);
        b.state.speed = Speed::PerMinute(50.0);
        b
    }

    fn curve(&mut self, curve: impl Into<Curve>) {
        let curve = curve.into();
        self.program.push_move(Move::along(&curve), &self.state, Origin::default());
        self.at = curve.end();
    }

    fn rapid(&mut self, to: DVec3) {
        let speed = std::mem::replace(&mut self.state.speed, Speed::Rapid { linear: true });
        self.curve(Line { start: self.at, end: to });
        self.state.speed = speed;
    }

    fn arc(&mut self, radius: f64, from: f64, sweep: f64, rise: f64) {
        let centre = self.at - (DVec2::from_angle(from) * radius).extend(0.0);
        self.curve(Arc { start: self.at, centre, axis: DVec3::Z, sweep, rise });
    }
}

/// Curves of the moves of a program in order, with the item of each.
fn curves(program: &Program) -> Vec<(usize, Curve)> {
    let mut at = DVec3::NAN;
    let mut out = Vec::new();
    for i in 0..program.items.len() {
        let Item::Move(motion) = program.items.get(i) else { continue };
        let Target::Tip { point, .. } = motion.end else { continue };
        if at.is_finite() {
            out.push((i, motion.curve(at).unwrap()));
        }
        at = point;
    }
    out
}

fn samples(curve: &Curve, n: usize) -> Vec<DVec3> {
    (0..=n).map(|k| curve.at(curve.length() * k as f64 / n as f64).p).collect()
}

/// Distance of a point from a polyline, by brute force.
fn distance(p: DVec3, line: &[DVec3]) -> f64 {
    line.windows(2).fold((p - line[0]).length(), |least, w| {
        let d = w[1] - w[0];
        let t = if d == DVec3::ZERO { 0.0 } else { ((p - w[0]).dot(d) / d.length_squared()).clamp(0.0, 1.0) };
        least.min((w[0] + d * t - p).length())
    })
}

/// Largest distance of either path from the other. `n` samples for each curve.
fn apart(a: &[Curve], b: &[Curve], n: usize) -> f64 {
    let points = |c: &[Curve]| c.iter().flat_map(|c| samples(c, n)).collect::<Vec<_>>();
    let (pa, pb) = (points(a), points(b));
    let one =
        |from: &[DVec3], to: &[DVec3]| from.iter().fold(0.0, |worst: f64, p| worst.max(distance(*p, to)));
    one(&pa, &pb).max(one(&pb, &pa))
}

#[derive(Clone, Debug)]
enum Step {
    Line(DVec3),
    Rapid(DVec3),
    Arc { radius: f64, from: f64, sweep: f64, rise: f64 },
    Feed(Speed),
    Spindle(Spindle),
    Coolant(Coolant),
    Blend(Blend),
    Tool(u32, Option<u32>),
    Retract,
    Dwell(f64),
    Text(String),
    Stop,
    Offset(WorkOffset),
}

fn point() -> impl Strategy<Value = DVec3> {
    (-500.0..500.0f64, -500.0..500.0f64, -100.0..100.0f64).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn step() -> impl Strategy<Value = Step> {
    let full = prop_oneof![
        Just(TAU),
        Just(-TAU),
        Just(PI),
        Just(-3.0 * TAU),
        (-8.0..-1.0f64, 0u32..3).prop_map(|(e, n)| TAU * f64::from(n + 1) - 10f64.powf(e)),
        (-8.0..-1.0f64, 1u32..3).prop_map(|(e, n)| -TAU * f64::from(n) - 10f64.powf(e)),
    ];
    prop_oneof![
        4 => point().prop_map(Step::Line),
        2 => point().prop_map(Step::Rapid),
        8 => (0.05..400.0f64, -4.0..4.0f64, -20.0..20.0f64, prop_oneof![Just(0.0), -20.0..20.0f64])
            .prop_map(|(radius, from, sweep, rise)| Step::Arc { radius, from, sweep, rise }),
        2 => (0.05..400.0f64, -4.0..4.0f64, full, prop_oneof![Just(0.0), -20.0..20.0f64])
            .prop_map(|(radius, from, sweep, rise)| Step::Arc { radius, from, sweep, rise }),
        1 => prop_oneof![
            (0.1..500.0f64).prop_map(Speed::PerMinute),
            (0.01..2.0f64).prop_map(Speed::PerRevolution),
            (0.1..60.0f64).prop_map(Speed::Duration),
        ].prop_map(Step::Feed),
        1 => prop_oneof![
            Just(Spindle::Off),
            (1.0..2000.0f64).prop_map(Spindle::Clockwise),
            (1.0..2000.0f64).prop_map(Spindle::CounterClockwise),
        ].prop_map(Step::Spindle),
        1 => prop_oneof![Just(Coolant::Off), Just(Coolant::Mist), Just(Coolant::Flood)].prop_map(Step::Coolant),
        1 => prop_oneof![
            Just(Blend::Stop),
            Just(Blend::Exact),
            Just(Blend::Continuous),
            (1u32..500).prop_map(|k| Blend::within(f64::from(k) / 1000.0)),
            // Their sum is exact, too.
            (1u32..60, 0u32..60).prop_map(|(k, m)| Blend::Tolerance {
                path: f64::from(k) / 64.0,
                merge: f64::from(m) / 64.0,
                angle: 0.0,
            }),
        ].prop_map(Step::Blend),
        1 => (1u32..4, prop::option::weighted(0.8, 1u32..4)).prop_map(|(t, l)| Step::Tool(t, l)),
        1 => Just(Step::Retract),
        1 => (0.0..9.0f64).prop_map(Step::Dwell),
        1 => "[A-Z ]{0,12}[(),;%$\n\r\u{1b}ü/#\\[\\]]{0,4}[A-Z0-9 ]{1,40}".prop_map(Step::Text),
        1 => Just(Step::Stop),
        1 => prop_oneof![Just("G54"), Just("G55"), Just("G57")]
            .prop_map(|o| Step::Offset(WorkOffset::parse(o).unwrap())),
    ]
}

/// What a control can carry of a step: `TOOL CALL` takes a length always, and klartext has no exact stop; GRBL has no
/// registers.
fn carried(step: Step, control: Control) -> Step {
    match step {
        Step::Tool(number, None) if control == Control::Heidenhain => Step::Tool(number, Some(1)),
        Step::Tool(number, _) if control == Control::Grbl => Step::Tool(number, Some(1)),
        Step::Blend(Blend::Stop | Blend::Exact) if control == Control::Heidenhain => {
            Step::Blend(Blend::Continuous)
        }
        Step::Blend(Blend::Exact) if control != Control::LinuxCnc => Step::Blend(Blend::Stop),
        other => other,
    }
}

fn build(steps: &[Step], control: Control) -> Program {
    let mut b = Builder::new(DVec3::new(1.0, 2.0, 30.0));
    let mut length = Some(1);
    for step in steps {
        carried_state(control, &mut b.state);
        match carried(step.clone(), control) {
            Step::Line(to) => b.curve(Line { start: b.at, end: to }),
            Step::Rapid(to) => b.rapid(to),
            Step::Arc { radius, from, sweep, rise } => b.arc(radius, from, sweep, rise),
            Step::Feed(speed) => b.state.speed = speed,
            Step::Spindle(spindle) => b.state.spindle = spindle,
            Step::Coolant(coolant) => b.state.coolant = coolant,
            Step::Blend(blend) => b.state.blend = blend,
            Step::Tool(number, register) => {
                let id = ToolNumber(number);
                let items = &b.program.items;
                let last = (0..items.len()).rev().find_map(|i| match items.get(i) {
                    Item::Tool { id, length, .. } => Some((id, length)),
                    _ => None,
                });
                if last != Some((id, register)) {
                    b.program.push_tool(id, register, None, &b.state, Origin::default());
                    length = register;
                    b.rapid(b.at);
                } else if control != Control::Heidenhain {
                    // There a second call of the same tool changes nothing.
                    b.program.push_tool(id, register, None, &b.state, Origin::default());
                    b.program.change_again();
                    b.rapid(b.at);
                }
            }
            Step::Retract => {
                let speed = std::mem::replace(&mut b.state.speed, Speed::Rapid { linear: true });
                let up =
                    Move { end: Target::Joints([None, None, Some(0.0), None, None, None]), path: Path::Line };
                b.program.push_move(up, &b.state, Origin::default());
                // Approach: the place is known in X and Y only.
                let end =
                    Target::Tip { point: DVec3::new(b.at.x + 1.0, b.at.y, f64::NAN), axis: ToolAxis::Fixed };
                b.program.push_move(Move { end, path: Path::Line }, &b.state, Origin::default());
                b.state.speed = speed;
                b.at.x += 1.0;
                b.rapid(b.at);
            }
            Step::Dwell(seconds) => {
                b.program.push_dwell((seconds * 100.0).round() / 100.0, &b.state, Origin::default())
            }
            Step::Text(text) => b.program.push_text(text, &b.state, Origin::default()),
            Step::Stop => b.program.push_stop(StopKind::Optional, &b.state, Origin::default()),
            Step::Offset(offset) => {
                b.state.frame = b.program.add_frame(Frame::Work(offset));
                b.rapid(b.at);
            }
        }
    }
    let _ = length;
    carried_state(control, &mut b.state);
    b.program.push_stop(StopKind::End, &b.state, Origin::default());
    b.program
}

/// Items that a reader must find again: comments apart (they are wrapped), and moves that do not move.
fn meant(program: &Program) -> Vec<usize> {
    (0..program.items.len()).filter(|i| !matches!(program.items.get(*i), Item::Text(_))).collect()
}

fn offset_of(program: &Program, index: usize) -> WorkOffset {
    match program.frames[program.state(index).frame.0 as usize] {
        Frame::Work(offset) => offset,
        ref other => panic!("{other:?}"),
    }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * a.abs().max(b.abs())
}

fn same_speed(a: Speed, b: Speed, units: Units) -> bool {
    match (a, b) {
        (Speed::Rapid { .. }, Speed::Rapid { .. }) => true,
        (Speed::PerMinute(x), Speed::PerMinute(y)) | (Speed::Duration(x), Speed::Duration(y)) => close(x, y),
        // Eight decimals of an inch.
        (Speed::PerRevolution(x), Speed::PerRevolution(y)) => {
            close(x, y) || units.is_inch() && (x - y).abs() < 1.3e-7
        }
        _ => false,
    }
}

fn same_spindle(a: Spindle, b: Spindle) -> bool {
    match (a, b) {
        (Spindle::Off, Spindle::Off) => true,
        (Spindle::Clockwise(x), Spindle::Clockwise(y))
        | (Spindle::CounterClockwise(x), Spindle::CounterClockwise(y)) => close(x, y),
        _ => false,
    }
}

/// Whether passages are the same, in inches but for the digits of a tolerance.
fn same_blend(a: Blend, b: Blend, units: Units) -> bool {
    match (a, b) {
        (Blend::Tolerance { path: p, merge: m, .. }, Blend::Tolerance { path: q, merge: n, .. })
            if units.is_inch() =>
        {
            (p - q).abs() < 1e-6 * p.max(1.0) && (m - n).abs() < 1e-6 * m.max(1.0)
        }
        _ => a == b,
    }
}

/// Each item of the text belongs to an item of the program, in order, and is the same.
fn check_identity(program: &Program, posted: &Posted, control: Control, decimals: u8, units: Units) {
    let unit = units.mm() * control.resolution(decimals);
    let mut sources = Sources::default();
    let reading = nc::read(&mut sources, "test", &posted.text, control, &[])
        .unwrap_or_else(|e| panic!("{e}\n{}", posted.text));
    let back = &reading.program;
    assert_eq!(posted.lines.len(), posted.text.lines().count());
    let item_of = |i: usize| {
        let line = sources.line(back.origin(i).span.unwrap()) as usize - 1;
        posted.lines[line].map(|i| i as usize)
    };
    let found = meant(back);
    let mut next = 0;
    let (mut at, mut at_back) = (DVec3::NAN, DVec3::NAN);
    for i in meant(program) {
        let from = next;
        while next < found.len() && item_of(found[next]) == Some(i) {
            next += 1;
        }
        let pieces = &found[from..next];
        let context = || format!("item {i} {:?}\n{}", program.items.get(i), posted.text);
        match program.items.get(i) {
            Item::Move(motion) => {
                let state = program.state(i);
                let seconds = |p: &usize| match back.state(*p).speed {
                    Speed::Duration(seconds) => Some(seconds),
                    _ => None,
                };
                let total: Option<f64> = pieces.iter().map(seconds).sum();
                for &p in pieces {
                    let Item::Move(_) = back.items.get(p) else { panic!("{}", context()) };
                    let other = back.state(p);
                    // In inverse time the blocks of a move share its time.
                    let speed = if pieces.len() > 1 { total.map(Speed::Duration) } else { None };
                    assert!(same_speed(state.speed, speed.unwrap_or(other.speed), units), "{}", context());
                    assert!(same_spindle(state.spindle, other.spindle), "{}", context());
                    assert_eq!(state.coolant, other.coolant, "{}", context());
                    assert!(same_blend(state.blend, other.blend, units), "{}", context());
                    if matches!(motion.end, Target::Tip { .. }) {
                        assert_eq!(offset_of(program, i), offset_of(back, p), "{}", context());
                    }
                }
                match motion.end {
                    Target::Orient => unreachable!("these programs have no tilted plane"),
                    Target::Joints(joints) => {
                        let [p] = pieces else { panic!("{}", context()) };
                        let Item::Move(other) = back.items.get(*p) else { unreachable!() };
                        let Target::Joints(found) = other.end else { panic!("{}", context()) };
                        for (a, b) in joints.into_iter().zip(found) {
                            let is_near = |(a, b): (f64, f64)| (a - b).abs() <= 0.51 * unit;
                            let near = a == b || units.is_inch() && a.zip(b).is_some_and(is_near);
                            assert!(near, "{}", context());
                        }
                        (at, at_back) = (DVec3::NAN, DVec3::NAN);
                    }
                    Target::Tip { point, .. } => {
                        let mut read_curves = Vec::new();
                        for &p in pieces {
                            let Item::Move(other) = back.items.get(p) else { unreachable!() };
                            let Target::Tip { point, .. } = other.end else { panic!("{}", context()) };
                            if at_back.is_finite() {
                                read_curves.push(other.curve(at_back).unwrap());
                            }
                            at_back = point;
                        }
                        for k in 0..3 {
                            assert!(
                                point[k].is_nan() || (at_back[k] - point[k]).abs() <= 0.501 * unit,
                                "{}",
                                context()
                            );
                        }
                        if at.is_finite() && point.is_finite() {
                            let exact = motion.curve(at).unwrap();
                            let sum: f64 = read_curves.iter().map(Curve::length).sum();
                            // A radius off by 1.5 steps for up to 20 rad.
                            assert!(
                                (sum - exact.length()).abs() < 35.0 * unit,
                                "{sum} {} {}",
                                exact.length(),
                                context()
                            );
                            // Equal fractions of the path lie together.
                            let mut before = 0.0;
                            for c in &read_curves {
                                for p in 0..=6 {
                                    let s = c.length() * f64::from(p) / 6.0;
                                    let there = exact.at((before + s) / sum.max(1e-300) * exact.length()).p;
                                    let gap = (c.at(s).p - there).length();
                                    assert!(gap < 12.0 * unit, "{gap} {}", context());
                                }
                                before += c.length();
                            }
                        }
                        at = point;
                    }
                }
            }
            Item::Tool { id, length, .. } => {
                // A length that is called with the next move of Z stands in its line.
                let own = next..next + 1;
                if pieces.is_empty()
                    && found.get(next).is_some_and(|&p| matches!(back.items.get(p), Item::Tool { .. }))
                {
                    next += 1;
                }
                let pieces = if pieces.is_empty() { &found[own.start..next] } else { pieces };
                let [p] = pieces else { panic!("{pieces:?} {}", context()) };
                let Item::Tool { id: other, length: register, .. } = back.items.get(*p) else {
                    panic!("{}", context())
                };
                assert_eq!((id, length), (other, register), "{}", context());
                (at, at_back) = (DVec3::NAN, DVec3::NAN);
            }
            Item::Dwell(seconds) => {
                let [p] = pieces else { panic!("{}", context()) };
                assert!(
                    matches!(back.items.get(*p), Item::Dwell(s) if (s - seconds).abs() < 1e-6),
                    "{}",
                    context()
                );
            }
            Item::Stop(kind) => {
                let [p] = pieces else { panic!("{}", context()) };
                assert_eq!(back.items.get(*p), Item::Stop(kind), "{}", context());
            }
            other => panic!("{other:?}"),
        }
        // A change of offset starts from nowhere.
        if let (Some(&p), Item::Move(_)) = (pieces.last(), program.items.get(i))
            && p + 1 < back.items.len()
            && i + 1 < program.items.len()
            && offset_of(program, i) != offset_of(program, i + 1)
        {
            (at, at_back) = (DVec3::NAN, DVec3::NAN);
        }
    }
    assert_eq!(next, found.len(), "the text has more than the program\n{}", posted.text);
}

/// Reading what was written gives the program, and writing that gives the same bytes.
fn written_and_read(steps: &[Step], control: Control, decimals: u8, numbers: bool, units: Units) {
    let program = build(steps, control);
    let settings = PostSettings { block_numbers: numbers, units, ..settings(control, decimals) };
    let posted = nc::write(&program, &[], &settings).unwrap();
    check_identity(&program, &posted, control, decimals, units);
    let again = nc::write(&read(&posted.text, control).program, &[], &settings).unwrap();
    assert_eq!(posted.text, again.text);
}

/// Arcs and helices whose centre is farther than any number of a control.
#[test]
fn arcs_about_a_centre_that_is_kilometres_away_are_lines() {
    for (radius, sweep) in [(2.239_367e7, 1e-6), (1.2e6, 1e-4), (1.2e6, -2e-5)] {
        for rise in [0.0, -1.5] {
            let mut b = Builder::new(DVec3::new(3.0, -4.0, 2.0));
            b.arc(radius, 0.7, sweep, rise);
            for &control in CONTROLS {
                let posted = post(&b.program, control, 4);
                let exact: Vec<Curve> = curves(&b.program).into_iter().map(|c| c.1).collect();
                let found: Vec<Curve> =
                    curves(&read(&posted.text, control).program).into_iter().map(|c| c.1).collect();
                let apart = apart(&exact, &found, 200);
                assert!(
                    apart < 2.5 * control.resolution(4),
                    "{control} {radius} {rise}: {apart}\n{}",
                    posted.text
                );
            }
        }
    }
}

/// The spindle turns first in a move that goes nowhere and is not written: its speed is not in the text either.
#[test]
fn a_speed_that_only_an_empty_move_has_is_not_written() {
    let offset = Step::Offset(WorkOffset::parse("G57").unwrap());
    let steps = [
        Step::Spindle(Spindle::Off),
        Step::Tool(2, None),
        offset.clone(),
        Step::Spindle(Spindle::Clockwise(1.0)),
        offset,
    ];
    for &control in CONTROLS {
        written_and_read(&steps, control, 3, false, Units::Millimetres);
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(120))]

    #[test]
    fn reading_what_was_written_gives_the_program(
        steps in prop::collection::vec(step(), 1..25), decimals in 3u8..=6, numbers: bool,
    ) {
        for &control in CONTROLS {
            written_and_read(&steps, control, decimals, numbers, Units::Millimetres);
        }
    }

    #[test]
    fn reading_what_was_written_in_inches_gives_the_program(
        steps in prop::collection::vec(step(), 1..25), decimals in 4u8..=6, numbers: bool,
    ) {
        for &control in CONTROLS {
            written_and_read(&steps, control, decimals, numbers, Units::Inches);
        }
    }

    /// Arcs of any size, down to far below the resolution, stay themselves: above all a short arc is never a circle.
    #[test]
    fn small_and_flat_arcs_keep_their_shape(
        log_radius in -5.0..4.0f64, from in -4.0..4.0f64, log_sweep in -7.0..0.8f64, ccw: bool,
        x in 0.0..1.0f64, y in 0.0..1.0f64, decimals in 3u8..=4,
    ) {
        let (radius, sweep) = (10f64.powf(log_radius), 10f64.powf(log_sweep) * if ccw { 1.0 } else { -1.0 });
        let mut b = Builder::new(DVec3::new(x, y, 0.0));
        b.arc(radius, from, sweep, 0.0);
        for &control in CONTROLS {
            let posted = post(&b.program, control, decimals);
            let unit = control.resolution(decimals);
            let exact: Vec<Curve> = curves(&b.program).into_iter().map(|c| c.1).collect();
            let found: Vec<Curve> = curves(&read(&posted.text, control).program).into_iter().map(|c| c.1).collect();
            let length = |c: &[Curve]| c.iter().map(Curve::length).sum::<f64>();
            if found.is_empty() {
                prop_assert!(length(&exact) < 4.0 * unit, "{}", posted.text);
                continue;
            }
            let chord = radius * (sweep / 200.0).powi(2) / 8.0;
            prop_assert!(apart(&exact, &found, 200) < 2.5 * unit + chord, "{} {}", apart(&exact, &found, 200), posted.text);
            prop_assert!((length(&exact) - length(&found)).abs() < 20.0 * unit, "{}", posted.text);
        }
    }

    /// The comment of a planner can be anything and changes nothing.
    #[test]
    fn hostile_comments_change_nothing(text in any::<String>(), tail in "[();%\n\r]{0,6}(M30|G0 Z-50|%|MSG,x|O1 sub)?") {
        let hostile = format!("{text}{tail}");
        let build = |text: Option<&str>| {
            let mut b = Builder::new(DVec3::ZERO);
            if let Some(text) = text {
                b.program.push_text(text, &b.state, Origin::default());
            }
            b.curve(Line { start: b.at, end: DVec3::new(10.0, 0.0, -1.0) });
            b.arc(10.0, 0.0, 1.0, 0.0);
            b.program
        };
        for &control in CONTROLS {
            let clean = post(&build(None), control, 4);
            let mut settings = settings(control, 4);
            settings.program_name.clone_from(&hostile);
            settings.header = vec![hostile.clone()];
            let dirty = nc::write(&build(Some(&hostile)), &[], &settings).unwrap();
            prop_assert!(dirty.text.bytes().all(|b| b == b'\n' || (b' '..=b'~').contains(&b)));
            let blocks = |text: &str| {
                // Klartext counts its comments too, and begins and ends with the name.
                let counted = |l: &&str| l.split_once(' ').is_none_or(|p| !p.1.starts_with([';', 'B', 'E']));
                text.lines().filter(|l| !l.starts_with(['(', ';'])).filter(counted).map(|l| l.split_once(' ').map_or(l, |p| p.1).to_owned()).collect::<Vec<_>>()
            };
            prop_assert_eq!(blocks(&clean.text), blocks(&dirty.text));
            let moves = |text: &str| {
                let program = read(text, control).program;
                (0..program.items.len())
                    .filter(|i| !matches!(program.items.get(*i), Item::Text(_)))
                    .map(|i| format!("{:?}", program.items.get(i)))
                    .collect::<Vec<_>>()
            };
            prop_assert_eq!(moves(&clean.text), moves(&dirty.text));
        }
    }

    /// Whatever the bytes, a reader answers: a program or an error with a place inside the text.
    #[test]
    fn any_bytes_are_answered(text in "[GMXYZIJKRFSTNHDPQL0-9 .;()%=\n/+-]{0,120}|\\PC{0,80}") {
        for &control in CONTROLS {
            if let Err(error) = nc::read(&mut Sources::default(), "test", &text, control, &[]) {
                let place = error.0.place.clone().unwrap_or_else(|| panic!("{error}"));
                prop_assert!(place.line >= 1 && place.start as usize <= text.len(), "{error}");
            }
        }
    }
}

/// Involutes of the kinds a bore has, written by both controls: the read-back curve lies within a micrometre and one
/// step of the exact one, by brute force.
fn check_involute(record: InvoluteRecord, control: Control, decimals: u8, native: bool) {
    let start = record.start().extend(-5.0);
    let mut b = Builder::new(start);
    b.curve(Curve::involute(record, -5.0, 0.0));
    let posted = post(&b.program, control, decimals);
    let unit = control.resolution(decimals);
    let said = ["INV", "G2.2", "G3.2"].iter().any(|w| posted.text.contains(w));
    assert_eq!(said, native && control.has_involute(), "{}", posted.text);
    assert_eq!(posted.notes.involutes + posted.notes.chains, 1, "{:?}", posted.notes);
    let reading = read(&posted.text, control);
    let found: Vec<Curve> = curves(&reading.program).into_iter().map(|c| c.1).collect();
    let exact = Curve::involute(record, -5.0, 0.0);
    // Each sample of the text against the exact curve near the same length, sampled finely.
    let total: f64 = found.iter().map(Curve::length).sum();
    assert!((total - exact.length()).abs() < 0.05, "{total} {}", exact.length());
    let n = (exact.length() / 0.02) as usize;
    let fine = samples(&exact, n);
    let mut before = 0.0;
    let mut worst: f64 = 0.0;
    for c in &found {
        for p in 0..=16 {
            let s = c.length() * f64::from(p) / 16.0;
            let guess = ((before + s) / exact.length() * n as f64) as usize;
            let window = &fine[guess.saturating_sub(60).min(n - 1)..(guess + 60).min(n + 1)];
            worst = worst.max(distance(c.at(s).p, window));
        }
        before += c.length();
    }
    assert!(worst < 0.001 + unit, "{worst} {control} {decimals}\n{}", posted.text);
    let again = post(&reading.program, control, decimals);
    assert_eq!(posted.text, again.text);
    assert!((found[found.len() - 1].end() - exact.end()).abs().max_element() <= 0.501 * unit);
}

#[test]
fn involutes_read_back_within_a_micrometre() {
    let r = 80.0 / (2.0 * TAU);
    // The finishing lead-in of Sorokin, But, Kombarov 2013.
    let lead_in =
        InvoluteRecord::new(242.249726898481, [-40.0, 40.0], 9.99138208933461, 57.5810791850552, 80.0)
            .unwrap();
    assert!((lead_in.base_radius() - r).abs() < 1e-12);
    // An annular spiral with a base radius on the grid, and the same inwards and clockwise.
    let r = 0.628;
    let inner = 79.0 - r * TAU * 19.0;
    let spiral = InvoluteRecord::new(PI * 19.0 * (inner + 79.0), [0.3, -7.7], 0.7, inner, 79.0).unwrap();
    for decimals in [3, 4] {
        for &control in CONTROLS {
            for record in [lead_in, spiral] {
                let back = record.reversed();
                for record in [record, back, record.mirrored(), back.mirrored()] {
                    check_involute(record, control, decimals, true);
                }
            }
        }
    }
}

#[test]
fn involutes_that_a_control_cannot_run_become_arcs() {
    // From the base circle: rounding would put the start inside it.
    let cusp = InvoluteRecord::new(4963.71639267187, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
    // The paper's spiral without its first turn: three decimals of the base radius miss by 63 um at its end.
    let coarse = cusp.split(InvoluteRecord::length_at_turn(&cusp, TAU)).1;
    for &control in CONTROLS {
        check_involute(cusp, control, 4, false);
        check_involute(coarse, control, 3, false);
    }
}

#[test]
fn the_blocks_of_the_paper_are_written_and_read() {
    let text = "G17 G90 G94 G710\nG54\nG0 X-40 Y40 Z0\nF3000\n\
        INVCCW X64.91311883 Y-46.75774806 I36.27913663 J-45.16562187 CR=6.36619772\n\
        G0 X0 Y-3.95\nINVCCW X0 Y-79 I-0.62866203 J3.95 CR=0.62866203 F6000\nM30\n";
    let reading = read(text, Control::Sinumerik840d);
    let all = curves(&reading.program);
    assert!((all[0].1.length() - 242.249726898481).abs() < 1e-6, "{}", all[0].1.length());
    let whole = 4963.71639267187;
    // From radius H the first turn, 2 pi^2 r = pi H long, is missing.
    assert!((all[2].1.length() - (whole - PI * 3.95)).abs() < 2e-4, "{}", all[2].1.length());
    assert!(reading.involute_difference < 2e-6);
    let posted = post(&reading.program, Control::Sinumerik840d, 4);
    assert!(
        posted.text.contains("INVCCW X64.9131 Y-46.7577 I36.2791 J-45.1656 CR=6.3662"),
        "{}",
        posted.text
    );
}
