//! Reading a program of others, and following it on the machine.

use std::sync::Arc;

use glam::DVec3;

use super::super::check::{Job, JobProgram};
use super::super::following::{CHORD, line_place};
use super::Unfollowed;
use super::grouped::grouped;
use super::magazine::{Magazine, Missing};
use super::registers::Registers;
use crate::base::{Code, Error, FileId, Finding, Result, Severity, Sources, Span};
use crate::geom::Rigid;
use crate::nc::{self, Control, ReadSettings, Reading};
use crate::program::{Blend, Frame, Program, Setup, WorkOffset};
use crate::trace::{RegisterState, Segment, SegmentPace, Taker, Trace, TraceOptions, trace, trace_passing};

/// A program of others, read and followed.
#[derive(Debug)]
pub(crate) struct Followed {
    /// Blocks that are wrong or not understood, those of one kind as one.
    pub(crate) errors: Vec<Finding>,
    /// Whether the program, or the part of it that was read, could be followed.
    pub(crate) followed: bool,
    /// The program as read.
    pub(crate) reading: Reading,
    /// Its motion; without segments where they were handed over.
    pub(crate) trace: Trace,
    /// Warnings of the reader, and registers that are not the tools' own.
    pub(crate) findings: Vec<Finding>,
    /// Parts that were read and are not followed.
    pub(crate) unfollowed: Vec<Unfollowed>,
    /// Tools with which it was followed.
    pub(crate) magazine: Magazine,
    /// Values of radius registers [mm].
    pub(crate) radii: Vec<(u32, f64)>,
    /// The text with its lines.
    pub(crate) sources: Sources,
    /// The program among the texts.
    file: FileId,
}

impl Followed {
    /// The line of an item, 0-based.
    pub(crate) fn line(&self, item: u32) -> Option<u32> {
        line_of(&self.reading.program, &self.sources, self.file, item)
    }

    /// For each item its line, 0-based.
    pub(crate) fn lines(&self) -> Vec<Option<u32>> {
        let read = &self.reading.program;
        let mut lines = self.sources.lines((0..read.items.len()).map(|i| in_file(read, i, self.file)));
        lines.iter_mut().flatten().for_each(|line| *line -= 1);
        lines
    }
}

/// The line of an item, 0-based.
fn line_of(read: &Program, sources: &Sources, file: FileId, item: u32) -> Option<u32> {
    let item = Some(item as usize).filter(|item| *item < read.items.len())?;
    in_file(read, item, file).map(|span| sources.line(span) - 1)
}

/// What a block that is wrong or not understood ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Errors {
    /// The reading.
    Stop,
    /// That block: reading goes on behind it.
    GoOn,
}

/// An error or finding about an item, at the place of its block.
pub(crate) fn at_block(mut error: Error, program: &JobProgram, line: impl Fn(u32) -> Option<u32>) -> Error {
    if let Some(item) = error.0.item.take() {
        error.0.place = line_place(&program.file, &program.text, line(item));
    }
    error
}

/// A guess on which the rest depends.
fn guessed(what: &str) -> Finding {
    let finding = Finding::doubt(Code::NC_ASSUMED, what.to_owned());
    finding.help("kinecut simulate --write-job job.toml saves the guess as a job: correct it there")
}

/// The first segments of a trace that are remarked on.
#[derive(Clone, Copy, Debug, Default)]
struct Remarked {
    /// Item of the first without a tool.
    without_tool: Option<u32>,
    /// Item of the first at feed whose corners the control rounds as it likes.
    rounds: Option<u32>,
}

impl Remarked {
    /// `rounds`: whether it counts that corners are rounded as the control likes.
    fn look(&mut self, segments: &[Segment], read: &Program, rounds: bool) {
        if self.without_tool.is_none() {
            self.without_tool = segments.iter().find(|s| s.tool.is_none()).map(|s| s.item);
        }
        if rounds && self.rounds.is_none() {
            let rounds = |s: &&Segment| {
                s.motion != SegmentPace::Rapid && read.state(s.item as usize).blend == Blend::Continuous
            };
            self.rounds = segments.iter().find(rounds).map(|s| s.item);
        }
    }
}

/// Reads the program of a job's setup and follows it.
///
/// # Errors
/// Those of the reader and of the trace, each at its place in the program.
pub(crate) fn follow(
    job: &Job,
    setup: usize,
    program: &JobProgram,
    missing: Missing,
    errors: Errors,
) -> Result<Followed> {
    follow_passing(job, setup, program, (missing, errors), None)
}

/// As [`follow`]; the segments of its motion are handed over and not kept where somebody takes them. What was handed over
/// does not count where the program was not followed.
///
/// # Errors
/// Those of [`follow`].
pub(crate) fn follow_passing(
    job: &Job,
    setup: usize,
    program: &JobProgram,
    (missing, errors): (Missing, Errors),
    each: Option<&mut Taker<'_>>,
) -> Result<Followed> {
    let mut sources = Sources::default();
    let clamped = &job.setups[setup];
    let mut clamping = vec![clamped.setup.clone()];
    let file = sources.add(&program.file, Arc::clone(&program.text));
    let mut files = Vec::new();
    for called in &program.beside {
        files.push((called.name.clone(), sources.add(&called.file, Arc::clone(&called.text))));
    }
    let reads_on = errors == Errors::GoOn;
    let settings = ReadSettings {
        files,
        input: program.input,
        start: program.start,
        blocks: program.blocks,
        kept: program.kept.clone(),
        tolerant: program.tolerant,
        codes: job.machine.as_ref().map(|m| m.codes.to_vec()).unwrap_or_default(),
        reads_on,
    };
    let mut reading = nc::read_source(&sources, file, program.control, &clamping, &settings)?;
    let mut assumed = Vec::new();
    // Offsets that are known are no guess.
    let guess = missing == Missing::StoodFor;
    let (known, placed) = place_offsets(&mut clamping[0], clamped.offset, &reading, guess);
    if guess || !known.is_empty() {
        if !placed.is_empty() {
            assumed.push(format!("{} lies where {} does", placed.join(", "), clamped.offset));
        }
        if !known.is_empty() {
            let which = known.join(", ");
            assumed.push(format!(
                "{which}: placed from {} as the offsets of the control have it",
                clamped.offset
            ));
        }
        reading.program.setups = clamping;
    }
    let misplaced = reading
        .program
        .setups
        .first()
        .map(|setup| misplaced(setup, clamped.offset, &reading))
        .unwrap_or_default();
    let read_radii = reading.radii.clone();
    let read = &reading.program;
    let line = |item: u32| line_of(&reading.program, &sources, file, item);
    let magazine = Magazine::of(&job.tools, read, program.in_spindle, missing);
    let registers = Registers::of(job, clamped, program, &reading, magazine.in_spindle, |item| {
        read.origin(item as usize).span.map(|s| sources.locate(s))
    });
    let mut radii = registers.radii.clone();
    for (number, radius) in &read_radii {
        radii.retain(|r| r.0 != *number);
        radii.push((*number, *radius));
    }
    let options = TraceOptions {
        chord: CHORD,
        machine: job.machine.as_ref(),
        tools: &magazine.tools,
        retract_height: clamped.retract_height(),
        operator: RegisterState {
            in_spindle: magazine.in_spindle,
            start: program.start.map(DVec3::from_array),
            // Without cutting it is the path that counts, as the program means it.
            lengths: if missing == Missing::Refused { &registers.lengths } else { &[] },
            own_radius: true,
        },
        radii: &radii,
        comp_start: program.control.comp_start(),
    };
    let mut followed = true;
    let mut remarked = Remarked::default();
    let rounds = program.control == Control::LinuxCnc && reading.rounds_freely;
    let traced = match each {
        None => trace(read, &options).inspect(|trace| remarked.look(&trace.segments, read, rounds)),
        Some(each) => trace_passing(read, &options, &mut |segments| {
            remarked.look(segments, read, rounds);
            each(segments);
        }),
    };
    let mut trace = match traced {
        Ok(trace) => trace,
        // A part of a program need not make sense alone: nothing of it is followed, and that is said beside the rest.
        Err(error) if !reading.errors.is_empty() => {
            (followed, remarked) = (false, Remarked::default());
            let error = at_block(error, program, line);
            reading.errors.push(*error.0);
            Trace::default()
        }
        Err(error) => return Err(at_block(error, program, line)),
    };
    let errors = grouped(std::mem::take(&mut reading.errors));
    if let Some(item) = remarked.without_tool.filter(|_| errors.is_empty()) {
        let line = |item: u32| line_of(&reading.program, &sources, file, item);
        return Err(at_block(without_tool().item(item).into(), program, line));
    }
    if let Some(why) = &program.detected {
        trace.assumed.push(format!("the text is read as one for {}: {why}", program.control.title()));
    }
    trace.assumed.extend(assumed);
    // The control starts so, too: that would come in every program and says nothing.
    if let Some(first) = remarked.rounds {
        let line = line_of(&reading.program, &sources, file, first).map_or(0, |l| l + 1);
        trace.assumed.push(format!(
            "the path is followed exactly, and from line {line} on the control rounds corners as far as its acceleration asks: G64 has no tolerance (P)"
        ));
    }
    trace.assumed.extend(magazine.assumed.iter().cloned());
    if program.is_latin {
        trace.assumed.push("the file is no UTF-8: it was read as Latin-1".to_owned());
    }
    let (notes, findings): (Vec<Finding>, Vec<Finding>) = reading
        .findings
        .iter()
        .cloned()
        .chain(registers.findings)
        .chain(misplaced)
        .chain(program.guessed.iter().map(|what| guessed(what)))
        .partition(|f| f.severity == Severity::Note);
    let unfollowed = notes
        .into_iter()
        .map(|note| Unfollowed { line: note.place.map(|p| p.line).filter(|l| *l > 0), what: note.message })
        .collect();
    Ok(Followed { errors, followed, trace, findings, unfollowed, magazine, radii, reading, sources, file })
}

/// The place of an item in a file: of one that another file says, the call that led there.
fn in_file(program: &Program, item: usize, file: FileId) -> Option<Span> {
    let mut origin = program.origin(item);
    while let (Some(span), Some(call)) = (origin.span, origin.parent)
        && span.file != file
    {
        origin = program.call(call);
    }
    origin.span
}

/// Gives a clamping every work offset that a program uses: where the program or the control's parameters tell its distance from the one
/// it has, there, and, where it may be guessed, the others at its place; those that were added, in these two kinds.
fn place_offsets(
    setup: &mut Setup,
    first: WorkOffset,
    reading: &Reading,
    guess: bool,
) -> (Vec<String>, Vec<String>) {
    let at = setup.work_offsets.get(&first).copied().unwrap_or(Rigid::IDENTITY);
    let (mut known, mut placed) = (Vec::new(), Vec::new());
    for frame in &reading.program.frames {
        if let Frame::Work(offset) = frame
            && !setup.work_offsets.contains_key(offset)
        {
            let way = reading.zero_from(first, *offset);
            if way.is_none() && !guess {
                continue;
            }
            let there = way.map_or(at, |way| at.after(&Rigid::from_translation(way)));
            setup.work_offsets.insert(*offset, there);
            if way.is_some() { known.push(offset.to_string()) } else { placed.push(offset.to_string()) }
        }
    }
    (known, placed)
}

/// Work offsets that the setup has elsewhere than the control, as far as the program or the control's parameters tell their distance.
fn misplaced(setup: &Setup, first: WorkOffset, reading: &Reading) -> Vec<Finding> {
    /// Resolution of a touch probe [mm].
    const SAME: f64 = 1e-3;
    let Some(at) = setup.work_offsets.get(&first) else { return Vec::new() };
    let used = reading.program.frames.iter().filter_map(|frame| match frame {
        Frame::Work(offset) => Some(*offset),
        _ => None,
    });
    let apart = used.filter_map(|offset| {
        let (there, way) = (setup.work_offsets.get(&offset)?, reading.zero_from(first, offset)?);
        let apart = (there.translation - at.point(way)).length();
        (apart > SAME).then(|| {
            let apart = (apart * 1e3).round() / 1e3;
            let message =
                format!("{offset} lies {apart} mm from where the control has it, as seen from {first}");
            let finding = Finding::doubt(Code::NC_ASSUMED, message);
            finding
                .help("compare the offsets of the setup with the program and the parameters of the control")
        })
    });
    apart.collect()
}

/// The error of a program that moves before it has a tool.
fn without_tool() -> Finding {
    Finding::error(Code::NC_STATE, "the program moves before a tool is called")
        .help("call a tool first, or say which one is in the spindle: program = { tool = 1, .. }, --tool 1")
}
