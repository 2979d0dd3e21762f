//! Writing and reading are inverse: random programs of all that a control can say with more than three axes.

use super::*;
use kinecut::program::{Cycle, Item, StopKind};
use proptest::prelude::*;

#[derive(Clone, Debug)]
enum Step {
    /// A rapid or a feed in the work offset; rotary axes A and C [ticks of 0.001 deg].
    Line {
        to: [i32; 3],
        turn: Option<[i32; 2]>,
        feed: Option<u8>,
    },
    /// Quarter of a circle from where the tip is.
    Arc {
        radius: u16,
        turn: Option<i32>,
    },
    /// In a tilted plane: angles, origin, branch, points, and whether it is left and entered again.
    Plane {
        angles: [i32; 3],
        origin: [i32; 3],
        branch: RotarySolution,
        points: Vec<[i32; 3]>,
        hole: bool,
        again: bool,
    },
    /// With control of the tip, in the way that the control has.
    Tip {
        vector: bool,
        points: Vec<([i32; 3], [i32; 2])>,
        keeps: bool,
        by_vector: bool,
    },
    Joints(Option<[i32; 2]>),
    Tool(u32),
    Dwell,
    Text,
    Stop,
}

fn point() -> impl Strategy<Value = [i32; 3]> {
    [-200_000..200_000i32, -200_000..200_000i32, -50_000..50_000i32]
}

fn angle() -> impl Strategy<Value = i32> {
    prop_oneof![-200_000..200_000i32, Just(0), Just(90_000), Just(-90_000), Just(180_000), Just(360_000)]
}

fn step() -> impl Strategy<Value = Step> {
    let turn = || proptest::option::of([angle(), angle()]);
    let branch = prop_oneof![
        Just(RotarySolution::Free),
        Just(RotarySolution::Positive),
        Just(RotarySolution::Negative)
    ];
    prop_oneof![
        4 => (point(), turn(), proptest::option::of(1u8..40)).prop_map(|(to, turn, feed)| Step::Line { to, turn, feed }),
        1 => (1000..20_000u16, proptest::option::of(angle())).prop_map(|(radius, turn)| Step::Arc { radius, turn }),
        3 => ([angle(), angle(), angle()], point(), branch, proptest::collection::vec(point(), 1..4), any::<bool>(), any::<bool>())
            .prop_map(|(angles, origin, branch, points, hole, again)| Step::Plane { angles, origin, branch, points, hole, again }),
        3 => (any::<bool>(), proptest::collection::vec((point(), [angle(), angle()]), 1..4), any::<bool>(), any::<bool>())
            .prop_map(|(vector, points, keeps, by_vector)| Step::Tip { vector, points, keeps, by_vector }),
        1 => turn().prop_map(Step::Joints),
        1 => (1..4u32).prop_map(Step::Tool),
        1 => Just(Step::Dwell),
        1 => Just(Step::Text),
        1 => Just(Step::Stop),
    ]
}

fn length(ticks: i32) -> f64 {
    f64::from(ticks) / 1000.0
}

/// A program that the control can say, from the steps that make sense there.
struct Steps {
    b: Builder,
    work: FrameId,
    /// Places of A and C [ticks], where known.
    turned: Option<[i32; 2]>,
    ever: bool,
    at: Option<DVec3>,
    count: i32,
    tool: u32,
}

impl Steps {
    fn kept(&self) -> ToolAxis {
        let upright = match self.turned {
            Some(at) => at.iter().all(|t| t % 360_000 == 0),
            None => !self.ever,
        };
        if upright { ToolAxis::Fixed } else { ToolAxis::Rotary([None; 3]) }
    }

    fn turns(&mut self, turn: [i32; 2]) -> ToolAxis {
        self.turned = Some(turn);
        self.ever = true;
        rotary(Some(length(turn[0])), None, Some(length(turn[1])))
    }

    /// A point that is none of those before.
    fn fresh(&mut self, to: [i32; 3]) -> DVec3 {
        self.count += 1;
        DVec3::new(length(to[0] + self.count), length(to[1]), length(to[2]))
    }

    fn line(&mut self, to: DVec3, axis: ToolAxis, speed: Speed) {
        // The first move at a new place is a rapid.
        let speed = if self.at.is_some() { speed } else { RAPID };
        self.b.to(to.x, to.y, to.z, axis, speed);
        self.at = Some(to);
    }

    /// A tool and a first move, with which its length is called.
    fn approach(&mut self) {
        self.at = None;
        let to = self.fresh([0, 0, 80_000]);
        let axis = self.kept();
        self.line(to, axis, RAPID);
    }

    fn take(&mut self, step: &Step) {
        let control = self.b.control;
        match step {
            Step::Line { to, turn, feed } => {
                let to = self.fresh(*to);
                let axis = match turn {
                    Some(turn) => self.turns(*turn),
                    None => self.kept(),
                };
                let speed = match feed {
                    Some(feed) if turn.is_some() => Speed::Duration(f64::from(*feed) / 8.0),
                    Some(feed) => Speed::PerMinute(f64::from(*feed)),
                    None => RAPID,
                };
                self.line(to, axis, speed);
            }
            Step::Arc { radius, turn } => {
                let Some(at) = self.at else { return };
                let radius = f64::from(*radius) / 1000.0;
                let axis = match (turn, self.turned) {
                    (Some(c), Some([a, _])) => self.turns([a, *c]),
                    _ => self.kept(),
                };
                let centre = at + DVec3::X * radius;
                let end = centre + DVec3::Y * radius;
                self.b.go(
                    Target::Tip { point: end, axis },
                    Path::Arc { centre, axis: DVec3::Z, sweep: -TAU / 4.0, rise: 0.0 },
                    Speed::PerMinute(7.0),
                );
                self.at = Some(end);
            }
            Step::Plane { angles, origin, branch, points, hole, again } if control.has_planes() => {
                let [a, b, c] = angles.map(length);
                let rotation = match control {
                    Control::Fanuc => euler(a, b, c),
                    _ => turned(&[(DVec3::X, a), (DVec3::Y, b), (DVec3::Z, c)]),
                };
                let origin = DVec3::from_array(origin.map(length));
                let frame = self.b.tilted(rotation, origin, control.branch(*branch));
                self.b.orient(frame);
                (self.turned, self.ever, self.at) = (None, true, None);
                for to in points {
                    let to = self.fresh(*to);
                    self.line(to, ToolAxis::Fixed, Speed::PerMinute(5.0));
                }
                if *hole {
                    let up = self.at.map_or(0.0, |p| p.z);
                    let cycle = Cycle::Drill { reference: up, bottom: up - 5.0, retract: up, dwell: 0.0 };
                    let state = State { speed: Speed::PerMinute(3.0), ..self.b.state };
                    self.b.program.push_cycle(cycle, &state, Origin::default()).unwrap();
                }
                if *again {
                    self.b.go(Target::Joints([None, None, Some(0.0), None, None, None]), Path::Line, RAPID);
                    self.at = None;
                    let to = self.fresh([5, 5, 5]);
                    self.line(to, ToolAxis::Fixed, RAPID);
                }
                self.b.state.frame = self.work;
                self.at = None;
            }
            Step::Tip { vector, points, keeps, by_vector } if control.has_tcp(Tcp::Axes) => {
                let as_plane = *vector && control.has_tcp(Tcp::Vector);
                self.b.state.tcp = if as_plane { Tcp::Vector } else { Tcp::Axes };
                self.at = None;
                for (to, turn) in points {
                    let to = self.fresh(*to);
                    let axis = if *by_vector {
                        (self.turned, self.ever) = (None, true);
                        let [a, c] = turn.map(length);
                        ToolAxis::Vector(turned(&[(DVec3::Z, c), (DVec3::X, a)]) * DVec3::Z)
                    } else {
                        self.turns(*turn)
                    };
                    self.line(to, axis, Speed::PerMinute(5.0));
                }
                if *keeps && *by_vector {
                    let to = self.fresh([0, 0, 0]);
                    self.line(to, ToolAxis::Rotary([None; 3]), Speed::PerMinute(5.0));
                }
                self.b.state.tcp = Tcp::Off;
                self.at = None;
                // Back to known angles, so that what follows is known too.
                let to = self.fresh([0, 0, 90_000]);
                let axis = self.turns([0, 0]);
                self.line(to, axis, RAPID);
            }
            Step::Joints(turn) => {
                let turned = turn.map(|t| t.map(|v| length(v).to_radians()));
                let [a, c] = [turned.map(|t| t[0]), turned.map(|t| t[1])];
                self.b.go(Target::Joints([Some(1.5), None, Some(0.0), a, None, c]), Path::Line, RAPID);
                if turn.is_some() {
                    (self.turned, self.ever) = (*turn, true);
                }
                self.at = None;
            }
            Step::Tool(number) => {
                self.tool = (self.tool + number - 1) % 4 + 1;
                self.b.tool(self.tool);
                self.approach();
            }
            Step::Dwell => {
                let state = State { speed: RAPID, ..self.b.state };
                self.b.program.push_dwell(0.5, &state, Origin::default());
            }
            Step::Text => {
                let state = self.b.state;
                self.b.program.push_text("HELLO", &state, Origin::default());
            }
            Step::Stop => {
                let state = State { speed: RAPID, ..self.b.state };
                self.b.program.push_stop(StopKind::Program, &state, Origin::default());
            }
            _ => {}
        }
    }
}

/// What an item says, whatever way it is said.
#[derive(Clone, Debug, PartialEq)]
enum Said {
    Tip {
        offset: WorkOffset,
        tilted: Option<(Vec<f64>, RotarySolution)>,
        point: Vec<f64>,
        axis: Vec<f64>,
        arc: Vec<f64>,
        speed: (u8, f64),
        tcp: Tcp,
    },
    Joints(Vec<f64>),
    Orient {
        tilted: Vec<f64>,
        branch: RotarySolution,
    },
    Tool(u32, Option<u32>),
    Other(String),
}

fn speed(speed: Speed) -> (u8, f64) {
    match speed {
        Speed::PerMinute(v) => (1, v),
        Speed::Duration(v) => (2, v),
        Speed::PerRevolution(v) => (3, v),
        _ => (0, 0.0),
    }
}

/// Angles that are kept are filled in; a tool along Z is a vector.
fn said(program: &Program) -> Vec<Said> {
    let mut angles = [f64::NAN; 3];
    let mut held = None;
    let mut out = Vec::new();
    for index in 0..program.items.len() {
        let state = program.state(index);
        let frame = program.frames[state.frame.0 as usize];
        let (offset, tilted) = match frame {
            Frame::Work(offset) => (offset, None),
            Frame::Tilted { motion, branch, .. } => {
                let numbers =
                    motion.rotation.to_cols_array().into_iter().chain(motion.translation.to_array());
                (WorkOffset::G54, Some((numbers.collect(), branch)))
            }
            ref other => panic!("{other:?}"),
        };
        out.push(match program.items.get(index) {
            Item::Move(Move { end: Target::Tip { point, axis }, path }) => {
                let axis = match axis {
                    ToolAxis::Fixed if tilted.is_some() || held.is_some() => vec![0.0, 0.0, 1.0],
                    // Along Z because the rotary axes are at zero.
                    ToolAxis::Fixed => [4.0].into_iter().chain(angles).collect(),
                    ToolAxis::Vector(v) => held.insert(v).to_array().to_vec(),
                    ToolAxis::Rotary([None, None, None]) if held.is_some() => {
                        held.unwrap().to_array().to_vec()
                    }
                    ToolAxis::Rotary(turned) => {
                        held = None;
                        for (at, turned) in angles.iter_mut().zip(turned) {
                            *at = turned.unwrap_or(*at);
                        }
                        [4.0].into_iter().chain(angles).collect()
                    }
                };
                let arc = match path {
                    Path::Line => Vec::new(),
                    Path::Arc { centre, axis, sweep, rise } => {
                        centre.to_array().into_iter().chain((axis * sweep).to_array()).chain([rise]).collect()
                    }
                    ref other => panic!("{other:?}"),
                };
                let speed = speed(state.speed);
                Said::Tip {
                    offset,
                    tilted,
                    point: point.to_array().to_vec(),
                    axis,
                    arc,
                    speed,
                    tcp: state.tcp,
                }
            }
            Item::Move(Move { end: Target::Joints(joints), .. }) => {
                held = held.filter(|_| joints[3..] == [None; 3]);
                for (at, joint) in angles.iter_mut().zip(&joints[3..]) {
                    *at = joint.unwrap_or(*at);
                }
                Said::Joints(joints.iter().map(|j| j.unwrap_or(f64::NAN)).collect())
            }
            Item::Move(Move { end: Target::Orient, .. }) => {
                (angles, held) = ([f64::NAN; 3], None);
                let (tilted, branch) = tilted.unwrap();
                Said::Orient { tilted, branch }
            }
            Item::Cycle(Cycle::Drill { reference, bottom, retract, .. }, _) => {
                let heights = [reference, bottom, retract].map(|h| (*h * 1000.0).round());
                Said::Other(format!("Cycle {heights:?}"))
            }
            Item::Tool { id, length, .. } => Said::Tool(id.0, length),
            other => Said::Other(format!("{other:?}")),
        });
    }
    out
}

fn near(a: &[f64], b: &[f64], bound: f64) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.is_nan() && b.is_nan() || (a - b).abs() <= bound)
}

/// Rounding of a point, an angle and a vector of six decimals; the numbers were on the grid.
const POINT: f64 = 1e-9;
const ANGLE: f64 = 1e-11;
const VECTOR: f64 = 1.1e-6;

fn same(a: &Said, b: &Said) -> bool {
    match (a, b) {
        (
            Said::Tip { offset, tilted, point, axis, arc, speed, tcp },
            Said::Tip { offset: o, tilted: t, point: p, axis: x, arc: r, speed: s, tcp: c },
        ) => {
            let planes = match (tilted, t) {
                (None, None) => true,
                (Some((a, i)), Some((b, j))) => near(a, b, POINT) && i == j,
                _ => false,
            };
            let bound = if axis.len() == 4 { ANGLE } else { VECTOR };
            let speeds = speed.0 == s.0 && (speed.1 - s.1).abs() <= 1e-6 * speed.1;
            planes
                && offset == o
                && near(point, p, POINT)
                && near(axis, x, bound)
                && near(arc, r, 1e-3)
                && speeds
                && tcp == c
        }
        (Said::Joints(a), Said::Joints(b)) => near(a, b, ANGLE),
        (Said::Orient { tilted: a, branch: i }, Said::Orient { tilted: b, branch: j }) => {
            near(a, b, POINT) && i == j
        }
        _ => a == b,
    }
}

fn check(control: Control, steps: &[Step]) {
    let b = Builder::new(control, 1);
    let work = b.state.frame;
    let mut all = Steps { b, work, turned: None, ever: false, at: None, count: 0, tool: 1 };
    all.approach();
    for step in steps {
        all.take(step);
    }
    let posted = all.b.post();
    let reading = read_text(&posted.text, control);
    let skip = |said: &Said| {
        matches!(said, Said::Other(text) if text.contains("Text(") && !text.contains("HELLO"))
            || matches!(said, Said::Other(text) if text.contains("Stop(End)"))
    };
    let wanted = said(&all.b.program);
    let mut got: Vec<Said> = said(&reading.program).into_iter().filter(|s| !skip(s)).collect();
    // A cycle's own words of the place where the tool is are no move.
    for i in (2..got.len()).rev() {
        let hole = matches!(&got[i], Said::Other(text) if text.starts_with("Cycle"));
        if hole
            && let (Said::Tip { point: a, .. }, Said::Tip { point: b, .. }) = (&got[i - 2], &got[i - 1])
            && a == b
        {
            got.remove(i - 1);
        }
    }
    for (i, (a, b)) in wanted.iter().zip(&got).enumerate() {
        assert!(same(a, b), "item {i}:\n{a:?}\n{b:?}\n{}", posted.text);
    }
    assert_eq!(wanted.len(), got.len(), "{}\n{wanted:#?}\n{got:#?}", posted.text);
    // What was read is written with the same words.
    let again = nc::write(&reading.program, &[], &all.b.settings()).unwrap();
    let words = |text: &str| {
        text.lines().filter(|l| !l.starts_with(['(', ';', '%'])).map(str::to_owned).collect::<Vec<_>>()
    };
    if !steps.iter().any(|s| matches!(s, Step::Tip { by_vector: true, .. })) {
        assert_eq!(words(&again.text), words(&posted.text));
    }
}

/// Words of planes, rotary axes and tips, and what may stand beside them.
const WORDS: &[&str] = &[
    "G0",
    "G1 F100.",
    "G2",
    "G3",
    "X1.",
    "Y-2.5",
    "Z3.",
    "I1.",
    "J0.5",
    "K2.",
    "A30.",
    "B-45.",
    "C370.",
    "R5.",
    "P1",
    "P2",
    "Q123",
    "Q321",
    "H1",
    "H2",
    "D1",
    "T2",
    "M6",
    "G17",
    "G18",
    "G40",
    "G41",
    "G43",
    "G43.4",
    "G43.5",
    "G49",
    "G52",
    "G53",
    "G53.1",
    "G54",
    "G55",
    "G68",
    "G68.2",
    "G69",
    "G80",
    "G81 R1.",
    "G90",
    "G91",
    "G93",
    "G94",
    "TRAORI",
    "TRAORI(1)",
    "TRAFOOF",
    "ORIVECT",
    "ORIAXES",
    "A=IC(5)",
    "C=DC(350)",
    "C=ACN(1)",
    "X=IC(2)",
    "A3=1",
    "B3=0.5",
    "C3=-1",
    "TRANS",
    "AROT",
    "RPL=30",
    "SUPA",
    "\n",
    "\n",
    "\n",
    "\n",
    "CYCLE800()",
    "CYCLE800(0,\"\",0,57,1,2,3,10,20,30,0,0,1,1)",
    "CYCLE800(0,\"\",1,54,1,2,3,90,90,0,0,0,1,-1)",
    "CYCLE800(0,\"\",0,27,1,2,3,10,20,30,0,0,1,0)",
    "CYCLE800(0,\"0\")",
    "CYCLE800(,\"",
    "IC(",
    "A3=",
    "M30",
];

proptest! {
    #![proptest_config(kinecut_cases::property(256))]

    /// Whatever stands in a text, it is read or refused; what is read is written or refused.
    #[test]
    fn no_text_is_too_bad(words in proptest::collection::vec(proptest::sample::select(WORDS), 0..16)) {
        for control in Control::WRITTEN {
            for units in ["G21", "G710"] {
                let text = format!("{units} G54\nG0 X0. Y0. Z5.\n{}\n", words.join(" "));
                if let Ok(reading) = nc::read(&mut Sources::default(), "test", &text, *control, &[]) {
                    for other in Control::WRITTEN {
                        let _ = nc::write(&reading.program, &[], &PostSettings::new(*other));
                    }
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(96))]

    #[test]
    fn what_is_written_is_read(steps in proptest::collection::vec(step(), 1..14)) {
        for control in [Control::Fanuc, Control::Sinumerik840d, Control::LinuxCnc] {
            check(control, &steps);
        }
    }
}
