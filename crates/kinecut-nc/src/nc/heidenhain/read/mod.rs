//! From klartext to a program.
//!
//! Statement by statement. A word that its statement does not use is an error, and so is every statement that is
//! not known: nothing that could move an axis is skipped. Datum shifts and rotations (`CYCL DEF 7`, `10`) and tilted
//! planes are frames; `BLK FORM` draws only.

mod arc;
mod cycle;
mod drilling;
mod feed;
mod motion;
mod pecking;
mod plane;
mod rotary;
mod settings;
mod statement;
mod tapping;
mod turn;

use glam::DVec2;

use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::nc::Reading;
use crate::nc::multi_axis::Rotaries;
use crate::nc::read::place::{Bytes, SourceText};
use crate::program::{
    Blend, Comp, Coolant, Frame, FrameId, Origin, Program, Setup, SetupId, Speed, Spindle, State, StopKind,
    Tapping, Tcp, WorkOffset,
};

use drilling::Drilling;
use pecking::Pecking;
use statement::{Lexer, Statement, Word};

/// Modal state of the control; mm, s, rad.
#[derive(Debug)]
struct Modal {
    /// Millimetres in the program's unit of length, and mm/s in its unit of feed.
    unit: f64,
    feed_unit: f64,
    unit_said: bool,
    feed: Option<Speed>,
    /// Feed of the tool call, for `FAUTO`.
    tool_feed: Option<Speed>,
    /// `F` is per revolution (`M136`).
    per_revolution: bool,
    spindle: Spindle,
    rate: Option<f64>,
    coolant: Coolant,
    blend: Blend,
    comp: Side,
    offset: Option<WorkOffset>,
    frame: FrameId,
    setup: SetupId,
    tool: Option<u32>,
    /// Line of the tool: 1, or its index.
    register: u32,
    /// Datum shift and rotation [deg], and what they do together: from the coordinates to those of the preset.
    shift: [f64; 3],
    degrees: f64,
    motion: Rigid,
    /// The tilted plane at the shifted datum, and the shift within it; `degrees` then count there.
    tilt: Option<plane::Tilt>,
    inner: [f64; 3],
    /// Words after which the coordinates that shift and rotation count in are uncertain.
    uncertain: Option<Bytes>,
    tcp: Tcp,
    /// Rotary axes [deg].
    rotaries: Rotaries<f64>,
    /// Rotary axes take the shorter way (`M126`).
    shorter: bool,
    pole: Option<DVec2>,
    /// Tip in the shifted and turned coordinates; `None` where the program has not said it.
    position: [Option<f64>; 3],
    /// Direction in the plane at the end of the last move.
    direction: Option<DVec2>,
    /// The cycle that a call runs.
    hole: Option<Hole>,
}

/// A cycle that was defined.
#[derive(Clone, Copy, Debug)]
enum Hole {
    Drilling(Drilling),
    Pecking(Pecking),
    Tapping(Tapping),
}

/// Side of the contour on which the tool runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Off,
    Left,
    Right,
}

struct Reader<'s> {
    place: SourceText<'s>,
    program: Program,
    findings: Vec<Finding>,
    header: Vec<String>,
    radius_difference: f64,
    started: bool,
    ended: bool,
    origin: Origin,
    here: Bytes,
    modal: Modal,
}

/// Reads a program; see [`crate::nc::read`].
pub(in crate::nc) fn read(place: SourceText<'_>, setups: &[Setup]) -> Result<Reading> {
    let mut reader = Reader::new(place, setups);
    let lexer = Lexer { place };
    let text = place.text();
    let mut at = 0;
    while at < text.len() && !reader.ended {
        let (mut statement, next) = lexer.statement(at)?;
        at = next;
        reader.statement(&mut statement)?;
    }
    reader.finish(at)
}

impl<'s> Reader<'s> {
    fn new(place: SourceText<'s>, setups: &[Setup]) -> Reader<'s> {
        let mut program = Program::new(setups.to_vec());
        let frame = program.add_frame(Frame::Work(WorkOffset::G54));
        let modal = Modal {
            unit: 1.0,
            feed_unit: 1.0 / 60.0,
            unit_said: false,
            feed: None,
            tool_feed: None,
            per_revolution: false,
            spindle: Spindle::Off,
            rate: None,
            coolant: Coolant::Off,
            blend: Blend::Continuous,
            comp: Side::Off,
            offset: None,
            frame,
            setup: SetupId(0),
            tool: None,
            register: 1,
            shift: [0.0; 3],
            degrees: 0.0,
            motion: Rigid::IDENTITY,
            tilt: None,
            inner: [0.0; 3],
            uncertain: None,
            tcp: Tcp::Off,
            rotaries: Rotaries::default(),
            shorter: false,
            pole: None,
            position: [None; 3],
            direction: None,
            hole: None,
        };
        Reader {
            place,
            program,
            findings: Vec::new(),
            header: Vec::new(),
            radius_difference: 0.0,
            started: false,
            ended: false,
            origin: Origin::default(),
            here: 0..0,
            modal,
        }
    }

    fn finish(mut self, at: usize) -> Result<Reading> {
        let text = self.place.text();
        if self.modal.comp != Side::Off {
            let end = at.min(text.len()) as u32;
            self.warn(&(end..end), "the radius compensation is on at the end of the program");
        }
        for (on, what) in [
            (self.modal.tcp != Tcp::Off, TIP_CONTROLLED),
            (self.modal.tilt.is_some(), "a plane is tilted at the end of the program"),
        ] {
            if on {
                let end = at.min(text.len()) as u32;
                self.warn(&(end..end), what);
            }
        }
        let rest = text[at.min(text.len())..].trim();
        if !self.ended {
            let end = text.len() as u32;
            self.warn(&(end..end), "the program has no end (M30, END PGM)");
        } else if !rest.is_empty() && !is_end(rest) {
            let start = (rest.as_ptr() as usize - text.as_ptr() as usize) as u32;
            self.warn(&(start..start + 1), "text after the end of the program is not run");
        }
        Ok(Reading {
            program: self.program,
            findings: self.findings,
            header: self.header,
            radius_difference: self.radius_difference,
            involute_difference: 0.0,
            errors: Vec::new(),
            radii: Vec::new(),
            lengths: Vec::new(),
            own_lengths: Vec::new(),
            zeros: crate::nc::read::zeros::Zeros::default(),
            rounds_freely: false,
        })
    }

    fn statement(&mut self, statement: &mut Statement<'s>) -> Result<()> {
        self.here = statement.bytes.clone();
        self.origin = Origin { span: Some(self.place.span(&self.here)), ..Origin::default() };
        if let Some(skip) = &statement.skip {
            self.warn(skip, "a block with `/` is read as if the skip switch were off");
        }
        let words = &mut statement.words;
        let frame = words.first().is_some_and(|w| w.is("BEGIN") || w.is("BLK"));
        self.started |= !words.is_empty() && !frame;
        // A comment in a block with words belongs to them.
        for (text, bytes) in statement.comments.iter().filter(|c| words.is_empty() && !c.0.is_empty()) {
            if self.started {
                let origin = Origin { span: Some(self.place.span(bytes)), ..Origin::default() };
                self.program.push_text(*text, &self.state(RAPID), origin);
            } else {
                self.header.push((*text).to_owned());
            }
        }
        let Some(first) = words.first_mut() else { return Ok(()) };
        first.used = true;
        let name = first.name.to_ascii_uppercase();
        match name.as_str() {
            "BEGIN" => self.begin(words)?,
            "END" => self.end_program(),
            "BLK" => words.iter_mut().for_each(|w| w.used = true),
            "L" => self.line(words)?,
            "LN" => self.vector_line(words)?,
            "PLANE" => self.plane(words)?,
            "FUNCTION" => self.function(words)?,
            "CC" => self.pole(words)?,
            "C" => self.arc(words)?,
            "CR" => self.arc_by_radius(words)?,
            "CT" => self.tangent_arc(words)?,
            "LP" => self.polar_line(words)?,
            "CP" => self.polar_arc(words)?,
            "TOOL" => self.tool(words)?,
            "CYCL" | "CYCLE" => self.cycle(words)?,
            "TRANS" => self.transformation(words)?,
            "LBL" => {
                self.note("labels are passed: what calls them is not read");
                words.iter_mut().take(2).for_each(|w| w.used = true);
                if let (Some(_), Some(word)) = (words[0].value, words.get_mut(1)) {
                    word.used = false;
                }
            }
            "STOP" => {
                self.functions(words, Some(StopKind::Program))?;
            }
            "M" => {
                words[0].used = false;
                self.functions(words, None)?;
            }
            _ => {
                let why = "kinecut does not know what the control does with it";
                return Err(self.place.not_understood(&words[0].bytes.clone(), why).into());
            }
        }
        match words.iter().find(|w| !w.used) {
            Some(word) => Err(self.place.not_understood(&word.bytes, "this block does not use it").into()),
            None => Ok(()),
        }
    }

    /// `BEGIN PGM name MM`.
    fn begin(&mut self, words: &[Word<'s>]) -> Result<()> {
        let line = words.first().and_then(|w| w.text).unwrap_or("");
        let unit = line.split(';').next().unwrap_or("").split_ascii_whitespace().next_back().unwrap_or("");
        if self.started || self.modal.unit_said {
            return Err(self.place.not_understood(&self.here, "a program within a program").into());
        }
        if unit.eq_ignore_ascii_case("INCH") {
            self.modal.unit = INCH;
            // Tenths of an inch in a minute (from memory).
            self.modal.feed_unit = 0.1 * INCH / 60.0;
        } else if !unit.eq_ignore_ascii_case("MM") {
            let finding = self.place.malformed(&self.here, "a program begins with its name and its unit");
            return Err(finding.help("program BEGIN PGM name MM").into());
        }
        self.modal.unit_said = true;
        Ok(())
    }

    fn end_program(&mut self) {
        self.stop(StopKind::End);
    }

    fn stop(&mut self, kind: StopKind) {
        if kind == StopKind::End {
            self.modal.spindle = Spindle::Off;
            self.modal.coolant = Coolant::Off;
            self.ended = true;
        }
        self.program.push_stop(kind, &self.state(RAPID), self.origin);
    }

    fn state(&self, speed: Speed) -> State {
        let register = self.modal.register;
        State {
            setup: self.modal.setup,
            frame: self.modal.frame,
            speed,
            spindle: self.modal.spindle,
            blend: self.modal.blend,
            tcp: self.modal.tcp,
            comp: match self.modal.comp {
                Side::Off => Comp::Off,
                Side::Left => Comp::Left(register),
                Side::Right => Comp::Right(register),
            },
            coolant: self.modal.coolant,
        }
    }

    fn warn(&mut self, bytes: &Bytes, message: &str) {
        // One finding of a kind is enough: the help is the same.
        if self.findings.iter().all(|f| f.message != message) {
            self.findings.push(self.place.warning(Code::NC_STATE, bytes, message));
        }
    }

    /// Notes an assumption, once.
    fn assume(&mut self, message: &str) {
        if self.findings.iter().all(|f| f.message != message) {
            let place = self.place.sources.locate(self.place.span(&self.here));
            self.findings.push(Finding::note(Code::NC_STATE, message).at(place));
        }
    }

    /// Notes what is not followed because it moves no axis.
    fn note(&mut self, what: &str) {
        if self.findings.iter().all(|f| f.message != what) {
            let place = self.place.sources.locate(self.place.span(&self.here));
            self.findings.push(Finding::note(Code::NC_WORD, what).at(place));
        }
    }

    fn lacks(&self, bytes: &Bytes, message: &str) -> Finding {
        self.place.error(Code::NC_STATE, bytes, message)
    }

    fn twice(&self, bytes: &Bytes) -> Finding {
        let message =
            format!("`{}`: the block says this twice, or contradicts itself", self.place.shown(bytes));
        self.place.error(Code::NC_SYNTAX, bytes, message)
    }

    /// The number of a word of this name, if the block has it.
    fn take(&self, words: &mut [Word<'s>], name: &str) -> Result<Option<(f64, Bytes)>> {
        let mut found = None;
        for word in words.iter_mut().filter(|w| !w.used && w.is(name)) {
            if found.is_some() {
                return Err(self.twice(&word.bytes).into());
            }
            let Some(value) = word.value else {
                return Err(self.place.malformed(&word.bytes, "a number is missing").into());
            };
            word.used = true;
            found = Some((value, word.bytes.clone()));
        }
        Ok(found)
    }

    /// A whole number, not negative.
    fn count(&self, value: f64, bytes: &Bytes, what: &str) -> Result<u32> {
        if value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value) {
            return Ok(value as u32);
        }
        Err(self.place.malformed(bytes, &format!("{what} is a whole number")).into())
    }
}

/// Finding at the end of a program that leaves `M128` on.
pub(in crate::nc) const TIP_CONTROLLED: &str =
    "control of the tool centre point is on at the end of the program (M128)";

const RAPID: Speed = Speed::Rapid { linear: true };
/// Millimetres in an inch.
const INCH: f64 = 25.4;

/// Whether a text is the last block of a program and nothing else.
fn is_end(rest: &str) -> bool {
    let rest = rest.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
    !rest.contains('\n') && rest.get(..7).is_some_and(|w| w.eq_ignore_ascii_case("END PGM"))
}
