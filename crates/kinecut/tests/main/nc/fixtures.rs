//! The text of one small program on each control, letter by letter.
//!
//! After a wanted change: `INSTA_UPDATE=always cargo test -p kinecut --test main nc::fixtures`, then read the difference.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use kinecut::base::{Code, Sources};
use kinecut::geom::{Arc, Curve, InvoluteRecord, Line};
use kinecut::nc::{self, Control, PostSettings, Posted};
use kinecut::program::{
    Blend, Comp, Coolant, Cycle, Frame, Move, Origin, Path, Program, SetupId, Speed, Spindle, State,
    StopKind, Target, ToolAxis, ToolNumber, WorkOffset,
};
use kinecut::tool::{Cutter, Tool};

use crate::common::fixture::assert_is_fixture;

const RAPID: Speed = Speed::Rapid { linear: false };

struct Builder {
    /// Whose registers of tool lengths are named; otherwise the tool's own number.
    control: Option<Control>,
    program: Program,
    state: State,
    at: DVec3,
}

impl Builder {
    fn new() -> Builder {
        let mut program = Program::default();
        let frame = program.add_frame(Frame::Work(WorkOffset::G54));
        Builder { control: None, program, state: State::start(SetupId(0), frame), at: DVec3::NAN }
    }

    fn go(&mut self, speed: Speed, curve: impl Into<Curve>) {
        self.state.speed = speed;
        let curve = curve.into();
        self.at = curve.end();
        self.program.push_move(Move::along(&curve), &self.state, Origin::default());
    }

    fn line(&mut self, speed: Speed, x: f64, y: f64, z: f64) {
        let end = DVec3::new(x, y, z);
        self.go(speed, Line { start: self.at, end });
    }

    fn joints(&mut self) {
        self.state.speed = RAPID;
        let end = Target::Joints([None, None, Some(0.0), None, None, None]);
        self.program.push_move(Move { end, path: Path::Line }, &self.state, Origin::default());
    }

    /// Approach in X and Y while Z is not known in the frame.
    fn over(&mut self, x: f64, y: f64) {
        self.state.speed = RAPID;
        let end = Target::Tip { point: DVec3::new(x, y, f64::NAN), axis: ToolAxis::Fixed };
        self.program.push_move(Move { end, path: Path::Line }, &self.state, Origin::default());
        self.at = DVec3::new(x, y, f64::NAN);
    }

    fn tool(&mut self, number: u32) {
        let register = Some(self.control.map_or(number, |c| c.length_register(ToolNumber(number))));
        self.program.push_tool(ToolNumber(number), register, register, &self.state, Origin::default());
    }
}

fn mill(number: u32, name: &str, diameter: f64) -> Tool {
    Tool {
        number: ToolNumber(number),
        name: name.to_owned(),
        cutter: Cutter::EndMill { diameter },
        teeth: 4,
        spacing: Default::default(),
        flute_length: 45.0,
        stickout: 90.0,
        shank_diameter: 36.0,
        holder: None,
        centre_cutting: true,
        max_ramp_angle: None,
        gauge_length: Some(170.0),
        limits: Default::default(),
        elasticity: None,
    }
}

/// Helix, annular spiral, wall circle, lead-in; then two holes with a second tool.
fn part(control: Control) -> Program {
    let mut b = Builder::new();
    let small = control == Control::Grbl;
    if small {
        b.control = Some(control);
    }
    let feed = |mm_min: f64| Speed::PerMinute(mm_min / 60.0);
    b.state.blend = Blend::Continuous;
    b.joints();
    b.tool(1);
    b.program.push_text("BORE (200)", &b.state, Origin::default());
    b.state.spindle = Spindle::Clockwise(2400.0 / 60.0 * TAU);
    b.over(3.95, 0.0);
    b.line(RAPID, 3.95, 0.0, 50.0);
    b.state.coolant = Coolant::Flood;
    b.line(RAPID, 3.95, 0.0, 1.0);
    let helix = Arc { start: b.at, centre: DVec3::Z, axis: DVec3::Z, sweep: 3.0 * TAU, rise: -6.0 };
    b.go(feed(1500.0), helix);
    b.go(feed(1500.0), Arc { start: b.at, centre: DVec3::ZERO, axis: DVec3::Z, sweep: TAU, rise: 0.0 });
    // From the circle of the helix to the wall in 10 turns, base radius on the grid.
    let r = 1.1945;
    let inner = 79.0 - TAU * 10.0 * r;
    let spiral =
        InvoluteRecord::new(PI * 10.0 * (inner + 79.0), [inner, 0.0], PI / 2.0, inner, 79.0).unwrap();
    let at_rest = DVec2::new(-r, 0.0);
    let spiral = spiral.shifted(DVec2::new(3.95, 0.0) - spiral.start());
    assert!(at_rest.x < 0.0 && spiral.base_radius() > 1.19);
    b.go(feed(6000.0), Curve::involute(spiral, -5.0, 0.0));
    b.line(RAPID, -40.0, 40.0, -3.0);
    let lead_in =
        InvoluteRecord::new(242.249726898481, [-40.0, 40.0], 9.99138208933461, 57.5810791850552, 80.0)
            .unwrap();
    b.line(feed(300.0), -40.0, 40.0, -5.0);
    b.go(feed(3000.0), Curve::involute(lead_in, -5.0, 0.0));
    let centre = DVec3::new(0.0, 0.0, -5.0);
    b.go(feed(3000.0), Arc { start: b.at, centre, axis: DVec3::Z, sweep: TAU, rise: 0.0 });
    let out = Arc { start: b.at, centre: b.at * 0.5 + centre * 0.5, axis: -DVec3::Z, sweep: -PI, rise: 0.0 };
    b.go(feed(3000.0), out);
    b.program.push_dwell(0.5, &b.state, Origin::default());
    b.line(RAPID, b.at.x, b.at.y, 50.0);
    b.joints();
    b.state.spindle = Spindle::Off;
    b.state.coolant = Coolant::Off;
    b.program.push_stop(StopKind::Optional, &b.state, Origin::default());
    b.tool(2);
    b.state.spindle = Spindle::Clockwise(3500.0 / 60.0 * TAU);
    b.state.coolant = if small { Coolant::Flood } else { Coolant::Mist };
    b.state.blend = Blend::within(0.01);
    for x in [-110.0, 110.0] {
        b.line(RAPID, x, 110.0, 50.0);
        b.state.speed = if small { feed(420.0) } else { Speed::PerRevolution(0.12) };
        let cycle = if x < 0.0 {
            Cycle::Peck { reference: 2.0, bottom: -15.0, retract: 50.0, step: 9.0, clearance: 0.5 }
        } else {
            Cycle::Drill { reference: 2.0, bottom: -15.0, retract: 50.0, dwell: 0.25 }
        };
        b.program.push_cycle(cycle, &b.state, Origin::default()).unwrap();
    }
    b.joints();
    b.program.push_stop(StopKind::End, &b.state, Origin::default());
    b.program
}

fn post(control: Control) -> Posted {
    post_program(&part(control), control)
}

fn post_program(program: &Program, control: Control) -> Posted {
    let mut settings = PostSettings::new(control);
    settings.program_name = "HOUSING".to_owned();
    settings.header = vec!["job housing.toml".to_owned()];
    nc::write(program, &[mill(1, "shoulder mill", 40.0), mill(2, "drill; (8.5)", 8.5)], &settings).unwrap()
}

#[test]
fn the_text_is_that_of_the_fixture() {
    for control in Control::WRITTEN {
        let posted = post(*control);
        assert_is_fixture(&posted.text, "housing", *control);
    }
}

#[test]
fn the_fixture_read_and_written_again_is_the_same() {
    for control in Control::WRITTEN {
        let posted = post(*control);
        let reading = nc::read(&mut Sources::default(), "housing", &posted.text, *control, &[]).unwrap();
        assert!(reading.findings.is_empty(), "{:?}", reading.findings);
        assert_eq!(post_program(&reading.program, *control).text, posted.text);
    }
}

#[test]
fn what_a_control_cannot_carry_is_refused_with_the_item() {
    let refused = |change: &dyn Fn(&mut Builder), control: Control, code: Code| {
        let mut b = Builder::new();
        b.control = Some(control);
        b.tool(1);
        b.line(RAPID, 0.0, 0.0, 5.0);
        change(&mut b);
        let error = nc::write(&b.program, &[], &PostSettings::new(control)).expect_err("refused");
        assert_eq!(error.code(), code, "{error}");
        let last = b.program.items.len() - 1;
        assert_eq!(error.0.item, Some(last as u32), "{error}");
    };
    let feed = Speed::PerMinute(10.0);
    for control in Control::WRITTEN.iter().copied() {
        let line = |b: &mut Builder, x: f64| b.line(feed, x, 0.0, 0.0);
        refused(&|b| line(b, 1e7), control, Code::POST_NUMBER);
        refused(&|b| line(b, f64::INFINITY), control, Code::NC_STATE);
        refused(&|b| line(b, f64::NAN), control, Code::NC_STATE);
        refused(&|b| b.line(Speed::PerMinute(0.0), 1.0, 0.0, 0.0), control, Code::NC_STATE);
        refused(&|b| b.line(Speed::PerMinute(f64::NAN), 1.0, 0.0, 0.0), control, Code::NC_STATE);
        refused(
            &|b| {
                b.state.comp = Comp::Left(1);
                b.line(feed, 0.0, 0.0, 1.0);
            },
            control,
            if control == Control::Grbl { Code::POST_CONTROL } else { Code::COMPENSATION },
        );
        if !control.has_tcp(kinecut::program::Tcp::Axes) {
            refused(
                &|b| {
                    b.state.tcp = kinecut::program::Tcp::Axes;
                    line(b, 1.0);
                },
                control,
                Code::POST_CONTROL,
            );
        }
        refused(
            &|b| {
                b.state.frame = b.program.add_frame(Frame::Machine);
                line(b, 1.0);
            },
            control,
            Code::POST_CONTROL,
        );
        refused(
            &|b| {
                b.state.setup = SetupId(1);
                line(b, 1.0);
            },
            control,
            Code::POST_CONTROL,
        );
        let slanted = DVec3::new(0.0, 0.6, 0.8);
        let arc = |axis: DVec3, sweep: f64| Arc {
            start: DVec3::Z * 5.0,
            centre: DVec3::new(1.0, 0.0, 5.0),
            axis,
            sweep,
            rise: 0.0,
        };
        refused(&|b| b.go(feed, arc(slanted, 1.0)), control, Code::POST_CONTROL);
        refused(&|b| b.go(feed, arc(DVec3::Z, 1e5)), control, Code::POST_CONTROL);
        refused(&|b| b.go(RAPID, arc(DVec3::Z, 1.0)), control, Code::POST_CONTROL);
        refused(
            &|b| {
                b.joints();
                b.go(feed, arc(DVec3::Z, 1.0));
            },
            control,
            Code::NC_STATE,
        );
        let wrong = if control == Control::Sinumerik840d { "G58" } else { "G505" };
        refused(
            &|b| {
                b.state.frame = b.program.add_frame(Frame::Work(WorkOffset::parse(wrong).unwrap()));
                line(b, 1.0);
            },
            control,
            Code::POST_CONTROL,
        );
    }
    let registers =
        |b: &mut Builder| b.program.push_tool(ToolNumber(1), Some(1), Some(2), &b.state, Origin::default());
    refused(&registers, Control::Sinumerik840d, Code::POST_CONTROL);
    for decimals in [2, 7] {
        let settings = PostSettings { decimals, ..PostSettings::new(Control::LinuxCnc) };
        assert_eq!(
            nc::write(&part(Control::LinuxCnc), &[], &settings).unwrap_err().code(),
            Code::POST_NUMBER
        );
    }
}
