//! More than three axes in the ISO controls: rotary axes, control of the tool centre point, tilted planes. What is written
//! is what a hand would write, and reading gives it back.

mod read;
mod round_trip;
mod written;

use std::f64::consts::TAU;

use glam::{DMat3, DQuat, DVec3};
use kinecut::base::Sources;
use kinecut::geom::Rigid;
use kinecut::nc::{self, Control, PostSettings, Posted, Reading};
use kinecut::program::{
    Blend, Frame, FrameId, Move, Origin, Path, Program, RotarySolution, SetupId, Speed, Spindle, State,
    Target, Tcp, ToolAxis, ToolNumber, WorkOffset,
};

const RAPID: Speed = Speed::Rapid { linear: false };

/// The product of rotations about axes that turn along, by quaternions [deg].
fn turned(turns: &[(DVec3, f64)]) -> DMat3 {
    let product = turns
        .iter()
        .fold(DQuat::IDENTITY, |q, (axis, degrees)| q * DQuat::from_axis_angle(*axis, degrees.to_radians()));
    DMat3::from_quat(product)
}

/// FANUC's Euler angles.
fn euler(i: f64, j: f64, k: f64) -> DMat3 {
    turned(&[(DVec3::Z, i), (DVec3::X, j), (DVec3::Z, k)])
}

fn rotary(a: Option<f64>, b: Option<f64>, c: Option<f64>) -> ToolAxis {
    ToolAxis::Rotary([a, b, c].map(|v| v.map(f64::to_radians)))
}

fn apart(a: &Rigid, b: &Rigid) -> f64 {
    let far = (a.rotation - b.rotation).to_cols_array().iter().fold(0.0f64, |m, v| m.max(v.abs()));
    far.max((a.translation - b.translation).length())
}

fn read_text(text: &str, control: Control) -> Reading {
    nc::read(&mut Sources::default(), "test", text, control, &[]).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn refused(text: &str, control: Control) -> String {
    match nc::read(&mut Sources::default(), "test", text, control, &[]) {
        Ok(_) => panic!("this was read:\n{text}"),
        Err(error) => error.to_string(),
    }
}

/// A program under construction.
struct Builder {
    control: Control,
    program: Program,
    state: State,
}

impl Builder {
    fn new(control: Control, tool: u32) -> Builder {
        let mut program = Program::default();
        let frame = program.add_frame(Frame::Work(WorkOffset::G54));
        let mut state = State::start(SetupId(0), frame);
        state.blend = Blend::Continuous;
        let mut b = Builder { control, program, state };
        b.tool(tool);
        b
    }

    fn tool(&mut self, number: u32) {
        let length = Some(self.control.length_register(ToolNumber(number)));
        let radius = length.filter(|_| self.control.wear_holds_length());
        self.state.spindle = Spindle::Off;
        self.program.push_tool(ToolNumber(number), length, radius, &self.state, Origin::default());
        self.state.spindle = Spindle::Clockwise(1000.0 / 60.0 * TAU);
    }

    fn tilted(&mut self, rotation: DMat3, translation: DVec3, branch: RotarySolution) -> FrameId {
        let parent = self.program.add_frame(Frame::Work(WorkOffset::G54));
        let frame = Frame::Tilted { parent, motion: Rigid { rotation, translation }, branch };
        self.program.add_frame(frame)
    }

    fn go(&mut self, end: Target, path: Path, speed: Speed) {
        let state = State { speed, ..self.state };
        self.program.push_move(Move { end, path }, &state, Origin::default());
    }

    fn to(&mut self, x: f64, y: f64, z: f64, axis: ToolAxis, speed: Speed) {
        self.go(Target::Tip { point: DVec3::new(x, y, z), axis }, Path::Line, speed);
    }

    fn orient(&mut self, frame: FrameId) {
        self.state.frame = frame;
        self.go(Target::Orient, Path::Line, RAPID);
    }

    fn settings(&self) -> PostSettings {
        PostSettings { block_numbers: false, ..PostSettings::new(self.control) }
    }

    fn post(&self) -> Posted {
        nc::write(&self.program, &[], &self.settings()).unwrap_or_else(|e| panic!("{e}"))
    }

    /// The message of a refusal and its key.
    fn refused(&self) -> (String, Option<u32>) {
        match nc::write(&self.program, &[], &self.settings()) {
            Ok(posted) => panic!("this was written:\n{}", posted.text),
            Err(error) => (error.to_string(), error.0.item),
        }
    }

    /// The blocks after those that are the same in every program.
    fn blocks(&self) -> String {
        let text = self.post().text;
        let from = text.find("\nT").unwrap_or_else(|| panic!("{text}")) + 1;
        text[from..].trim_end_matches("%\n").to_owned()
    }
}
