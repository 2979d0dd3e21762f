//! From the text of a control to a program.
//!
//! Line by line: bytes to words with their places, words to codes by the control's table, codes executed in the
//! order of the control. A word that no code of its block uses is an error, and so is everything the tables do not
//! have: nothing that could move an axis is skipped.
//!
//! Positions that the program has not set are unknown: at the beginning, after a tool change, in Z after a change
//! of length offset, in the axes of a move in machine coordinates, and after a change of work offset. A shift or rotation
//! of the coordinates gives the known position in the new ones; a tilted plane or control of the tool centre point gives none.
//! Moves may leave coordinates unknown (not a number); a feed move that starts at such a place is said, and its arc must
//! stay at the height that is not known.

mod arc;
mod block;
pub(super) mod bolt_holes;
mod boring;
mod by_number;
mod call;
mod called;
mod calls;
mod comp;
mod corner;
mod cubic;
mod cycle;
mod data;
mod execute;
mod extended_offset;
mod hole;
mod jump;
mod kept;
mod knots;
mod lex;
mod long_words;
mod message;
mod modal;
mod modal_macro;
mod modes;
mod motion;
pub(super) mod number;
mod nurbs;
mod o_lines;
mod orientation;
mod path_mode;
pub(super) mod place;
mod plain;
mod plane;
mod points;
mod polar;
mod preset;
mod probe;
mod reader;
mod reference;
mod rotary_axes;
mod rotary_state;
mod round_pocket;
mod run;
mod saved;
mod scaling;
mod settings;
mod statements;
mod sticky;
mod stored;
mod tap;
mod thread;
mod tool_data;
mod turn;
mod turned;
mod variables;
pub(super) mod zeros;

use glam::DVec3;

use crate::base::{Code, FileId, Finding, Result, Sources, Span};
use crate::program::{Item, OwnLength, Program, Setup, Tcp, WorkOffset};

use super::Control;
use block::Block;
use lex::Lexer;
use place::SourceText;
use points::Points;
use reader::Reader;
use run::Run;
use zeros::Zeros;

pub use called::called;
pub use settings::{NumberInput, ReadSettings};

/// A program read from a text.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The program; each item's origin has its place in the text.
    pub program: Program,
    /// Warnings and notes.
    pub findings: Vec<Finding>,
    /// Comments before the first block.
    pub header: Vec<String>,
    /// Largest difference of the distances of start and end from the centre of an arc, as written [mm].
    pub radius_difference: f64,
    /// Largest distance between the involutes of a written base radius through start and end [mm].
    pub involute_difference: f64,
    /// Blocks that are wrong or not understood, where reading goes on behind them.
    pub errors: Vec<Finding>,
    /// Radius registers that the program itself sets: number and radius [mm].
    pub radii: Vec<(u32, f64)>,
    /// Length registers that the program itself sets: number and length [mm].
    pub lengths: Vec<(u32, f64)>,
    /// Lengths that the program makes of numbers and registers, by the numbers of its own registers.
    pub own_lengths: Vec<OwnLength>,
    /// Whether the program asks for a continuous path without a tolerance (`G64` without P).
    pub rounds_freely: bool,
    /// Zeros of the work offsets.
    pub(in crate::nc) zeros: Zeros,
}

impl Reading {
    /// The zero of a work offset from that of another one, both as the setup has them, along the axes of the machine [mm]; none where
    /// the program does not tell all three.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use glam::DVec3;
    /// use kinecut::{base::Sources, nc::{self, Control}, program::WorkOffset};
    ///
    /// let text = "G10 L2 P1 X10 Y0 Z5\nG10 L2 P2 X110 Y0 Z5\nG54 G0 X0 Y0 Z9\nG55 G0 X0 Y0 Z9\nM2\n";
    /// let reading = nc::read(&mut Sources::default(), "two.ngc", text, Control::LinuxCnc, &[]).unwrap();
    /// let g55 = WorkOffset::from_tenths(550).unwrap();
    /// assert_eq!(reading.zero_from(WorkOffset::G54, g55), Some(DVec3::new(100.0, 0.0, 0.0)));
    /// ```
    pub fn zero_from(&self, other: WorkOffset, offset: WorkOffset) -> Option<DVec3> {
        let (there, here) = (self.zeros.first(offset), self.zeros.first(other));
        let way = DVec3::from_array([0, 1, 2].map(|axis| there[axis].minus(here[axis])));
        way.is_finite().then_some(way)
    }
}

/// Reads a program. The text is added to `sources` under `name`; `setups` are the clampings it runs on: a work
/// offset selects the clamping that has it.
///
/// ```
/// # use kinecut_nc as kinecut;
/// use kinecut::base::Sources;
/// use kinecut::nc::{self, Control};
/// use kinecut::program::{Item, Path};
///
/// let text = "G17 G90 G94 G710\nG54\nG0 X100 Y0 Z5\nG1 Z-1 F300\nG3 X100 Y0 I-100 J0 F600\nM30\n";
/// let reading = nc::read(&mut Sources::default(), "ring.mpf", text, Control::Sinumerik840d, &[]).unwrap();
/// let Item::Move(circle) = reading.program.items.get(2) else { panic!() };
/// let Path::Arc { sweep, .. } = circle.path else { panic!() };
/// assert_eq!(sweep, std::f64::consts::TAU);
///
/// let error = nc::read(&mut Sources::default(), "a.mpf", "G0 X1\nG1 Q7", Control::Sinumerik840d, &[]).unwrap_err();
/// assert!(error.to_string().starts_with("a.mpf:2:4: `Q7` is not understood"));
/// ```
///
/// # Errors
/// `KC0201` for words that are not understood, `KC0202` for malformed ones, `KC0203` for arcs that do not fit their
/// end points, `KC0204` for blocks that lack something, `KC0205` for what the control does not take in a cutter
/// compensation; each with its place.
pub fn read(
    sources: &mut Sources,
    name: &str,
    text: &str,
    control: Control,
    setups: &[Setup],
) -> Result<Reading> {
    let file = sources.add(name, text);
    read_source(sources, file, control, setups, &ReadSettings::default())
}

/// As [`read`], of a text that is among the sources, with settings.
///
/// # Errors
/// Those of [`read`].
pub fn read_source(
    sources: &Sources,
    file: FileId,
    control: Control,
    setups: &[Setup],
    settings: &ReadSettings,
) -> Result<Reading> {
    let place = SourceText::new(sources, file);
    let text = place.text();
    if text.len() >= u32::MAX as usize {
        return Err(Finding::error(Code::NC_SYNTAX, format!("`{}` is too large", sources.name(file)))
            .value(text.len() as f64, "bytes")
            .bound(f64::from(u32::MAX), "bytes")
            .into());
    }
    let dialect = control.dialect();
    if control == Control::Heidenhain {
        return super::heidenhain::read(place, setups);
    }
    let mut reader = Reader::new(place, dialect, setups);
    reader.points = Points::of(text, dialect, settings.input);
    reader.own_codes = settings.codes.clone();
    reader.tolerant = settings.tolerant;
    reader.check_own_codes()?;
    // Nearly every line of a long program is a move.
    let end = text.len() as u32;
    reader.program.items.reserve(sources.line(Span { file, start: end, end }) as usize);
    if control == Control::LinuxCnc {
        reader.begins_with(&settings.kept);
    }
    if let Some(start) = settings.start {
        reader.modal.position = start.map(Some);
    }
    Run::new(reader, settings).run()
}

/// State in which blocks leave a control that read nothing before them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Left {
    pub(super) ended: bool,
    pub(super) absolute: bool,
    pub(super) centre_absolute: bool,
    /// Whether it leaves the coordinates shifted or turned.
    pub(super) turned: bool,
    pub(super) inch: bool,
    pub(super) units_said: bool,
    /// Whether an axis moves.
    pub(super) moves: bool,
    /// Whether a line with `%` is among them.
    pub(super) tape: bool,
}

/// Reads a piece of a program, as if nothing came before it.
///
/// # Errors
/// Those of [`read`].
pub(super) fn left_by(sources: &mut Sources, name: &str, text: &str, control: Control) -> Result<Left> {
    let dialect = control.dialect();
    let file = sources.add(name, text);
    let place = SourceText::new(sources, file);
    let mut reader = Reader::new(place, dialect, &[]);
    let mut block = Block::default();
    let mut at = 0;
    let mut tape = false;
    for line in place.text().split('\n') {
        let lexer = Lexer { place, dialect, names: &reader };
        lexer.line(at, at + line.len(), &mut block)?;
        at += line.len() + 1;
        tape |= block.tape;
        reader.block(&mut block)?;
    }
    let items = &reader.program.items;
    let moves = (0..items.len()).any(|i| matches!(items.get(i), Item::Move(_) | Item::Cycle(..)));
    Ok(Left {
        ended: reader.ended,
        absolute: reader.modal.absolute,
        centre_absolute: reader.modal.centre_absolute,
        turned: !reader.modal.turned.is_none()
            || reader.modal.rotary_axes.plane.is_some()
            || reader.modal.rotary_axes.tcp != Tcp::Off,
        inch: reader.modal.length_unit != 1.0,
        units_said: reader.modal.units_said,
        moves,
        tape,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Room of the lists of a block after lines.
    fn room(text: &str) -> [usize; 3] {
        let mut sources = Sources::default();
        let file = sources.add("a", text);
        let place = SourceText::new(&sources, file);
        let reader = Reader::new(place, Control::LinuxCnc.dialect(), &[]);
        let lexer = Lexer { place, dialect: reader.dialect, names: &reader };
        let mut block = Block::default();
        let mut at = 0;
        for line in text.split('\n') {
            lexer.line(at, at + line.len(), &mut block).unwrap();
            at += line.len() + 1;
        }
        [block.words.capacity(), block.assignments.capacity(), block.comments.capacity()]
    }

    #[test]
    fn a_block_takes_no_memory_anew() {
        let turn = "N10 G1 X1.5 Y2 F100\n#1=2 #2=3 (counts)\n(behind it)\nX2\n\n";
        let once = room(turn);
        assert!(once.iter().all(|room| *room > 0));
        assert_eq!(room(&turn.repeat(100)), once);
    }

    #[test]
    fn a_program_takes_forty_bytes_a_line() {
        let line = |i: u32| format!("G1 X{}.5 Y{}\n", i % 97, i % 89);
        let text: String = (0..20_000).map(line).collect();
        let text = format!("G21 G90 G94 G54 G64\nG0 X0 Y0 Z0\nG1 Z-1 F300\n{text}M2\n");
        let reading = read(&mut Sources::default(), "a.ngc", &text, Control::LinuxCnc, &[]).unwrap();
        let each = reading.program.items.bytes() as f64 / 20_000.0;
        assert!(each < 40.0, "{each} bytes a line");
    }
}
