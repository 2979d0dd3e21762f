//! HEIDENHAIN klartext with rotary axes, tool directions, control of the tool centre point and tilted planes: what is
//! written, what it means when it is read, and what is refused.

use glam::{DMat3, DVec3};
use kinecut::base::{Error, Sources};
use kinecut::geom::{Line, Rigid};
use kinecut::nc::{self, Control, PostSettings, Posted, Reading};
use kinecut::program::{
    Blend, Cycle, Frame, FrameId, Item, Move, Origin, Path, Program, RotarySolution, SetupId, Speed, State,
    Target, Tcp, ToolAxis, ToolNumber, WorkOffset,
};

mod identity;
mod read;
mod refused;
mod written;

const RAPID: Speed = Speed::Rapid { linear: true };
const FEED: Speed = Speed::PerMinute(10.0);

fn try_read(text: &str) -> Result<Reading, Error> {
    nc::read(&mut Sources::default(), "a.h", text, Control::Heidenhain, &[])
}

fn read_text(text: &str) -> Reading {
    try_read(text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A turn about an axis by Rodrigues' formula [deg].
fn about(axis: DVec3, degrees: f64) -> DMat3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let turned = |v: DVec3| v * cos + axis.cross(v) * sin + axis * axis.dot(v) * (1.0 - cos);
    DMat3::from_cols(turned(DVec3::X), turned(DVec3::Y), turned(DVec3::Z))
}

fn degrees(values: [Option<f64>; 3]) -> ToolAxis {
    ToolAxis::Rotary(values.map(|v| v.map(f64::to_radians)))
}

/// A program under construction; points in the frame of the state.
struct Builder {
    program: Program,
    state: State,
}

impl Builder {
    fn new() -> Builder {
        let mut program = Program::default();
        let frame = program.add_frame(Frame::Work(WorkOffset::G54));
        let mut state = State::start(SetupId(0), frame);
        state.blend = Blend::Continuous;
        program.push_tool(ToolNumber(4), Some(1), Some(1), &state, Origin::default());
        Builder { program, state }
    }

    fn to(&mut self, end: Target, speed: Speed) {
        self.state.speed = speed;
        self.program.push_move(Move { end, path: Path::Line }, &self.state, Origin::default());
    }

    fn tip(&mut self, x: f64, y: f64, z: f64, axis: ToolAxis, speed: Speed) {
        self.to(Target::Tip { point: DVec3::new(x, y, z), axis }, speed);
    }

    fn line(&mut self, x: f64, y: f64, z: f64, speed: Speed) {
        self.tip(x, y, z, ToolAxis::Fixed, speed);
    }

    fn work(&mut self) {
        self.state.frame = self.program.add_frame(Frame::Work(WorkOffset::G54));
    }

    fn tilt(&mut self, rotation: DMat3, translation: DVec3, branch: RotarySolution) -> FrameId {
        let parent = self.program.add_frame(Frame::Work(WorkOffset::G54));
        let motion = Rigid { rotation, translation };
        self.state.frame = self.program.add_frame(Frame::Tilted { parent, motion, branch });
        self.state.frame
    }

    fn post(&self) -> Result<Posted, Error> {
        let settings = PostSettings { block_numbers: false, ..PostSettings::new(Control::Heidenhain) };
        nc::write(&self.program, &[], &settings)
    }

    /// The blocks after the tool call.
    fn blocks(&self) -> Vec<String> {
        let text = self.post().unwrap().text;
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let from = lines.iter().position(|l| l.starts_with("TOOL CALL")).unwrap() + 1;
        lines[from..].to_vec()
    }
}

/// The moves of a program, with their states.
fn moves(program: &Program) -> Vec<(Move, State)> {
    (0..program.items.len())
        .filter_map(|i| match program.items.get(i) {
            Item::Move(motion) => Some((motion, *program.state(i))),
            _ => None,
        })
        .collect()
}

/// The moves of blocks that follow preset, tool and a first position at (0, 0, 100), which is not among them; F 600 holds.
fn moves_of(blocks: &str) -> (Program, Vec<(Move, State)>) {
    let text = format!(
        "BEGIN PGM A MM\nCYCL DEF 247 Q339=+1\nTOOL CALL 4 Z S1000\nL X+0 Y+0 Z+100 R0 FMAX M3\nL F600\n{blocks}\nM30\nEND \
         PGM A MM\n"
    );
    let program = read_text(&text).program;
    let found = moves(&program)[1..].to_vec();
    (program, found)
}

fn tilted(program: &Program, state: &State) -> (Rigid, RotarySolution) {
    let (_, motion, branch) = program.in_tilted(state.frame).unwrap_or_else(|| panic!("{:?}", state.frame));
    (motion, branch)
}

fn same_rotation(a: &DMat3, b: &DMat3, tolerance: f64) -> bool {
    (*a - *b).to_cols_array().iter().all(|v| v.abs() <= tolerance)
}

fn line_to(x: f64, y: f64, z: f64) -> Move {
    let end = DVec3::new(x, y, z);
    Move::along(&Line { start: end, end }.into())
}

fn drill() -> Cycle {
    Cycle::Drill { reference: 2.0, bottom: -10.0, retract: 5.0, dwell: 0.0 }
}
