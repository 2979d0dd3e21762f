//! Result of reading a program of others without cutting: counts, range, time, findings.

use serde::Serialize;

use crate::base::{Code, Finding, Result, Silent};
use crate::geom::Rigid;
use crate::job::external::given::GivenJob;
use crate::job::external::{Errors, Missing, MotionSums, at_block, follow_passing};
use crate::job::facets::facets_note;
use crate::job::feeds::not_held;
use crate::job::held_feed::HeldFeed;
use crate::job::time_terms::{at_programmed_feeds, terms};
use crate::motion::{ProgramTime, program_time};
use crate::page::{self, Block, Fact, Section};
use crate::program::{Frame, Item, Program, StopKind};
use crate::trace::{Segment, Taker, travel_findings};
use crate::verbs::Answer;

/// Result of reading a program; mm, s, degrees.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProgramSheet {
    /// File.
    pub file: String,
    /// Control that it was read for.
    pub control: String,
    /// Lines of the text.
    pub lines: usize,
    /// Moves at feed.
    pub feed_moves: usize,
    /// Rapid moves.
    pub rapid_moves: usize,
    /// Drilling cycles.
    pub cycles: usize,
    /// Stops within the program (`M0`, `M1`).
    pub stops: usize,
    /// Tools that it calls.
    pub tools: Vec<String>,
    /// Work offsets that it moves in.
    pub offsets: Vec<String>,
    /// Least and greatest place of the tip at feed, in coordinates of the first work offset; none without feed moves.
    pub range: Option<[[f64; 3]; 2]>,
    /// Way at feed.
    pub feed_length: f64,
    /// Time [s]: under the limits of the machine's axes where they are known, else at the programmed speeds.
    pub time: f64,
    /// The same if jerk had no limit [s].
    pub time_without_jerk_limit: Option<f64>,
    /// Whether rapid moves are in the time.
    pub time_has_rapids: bool,
    /// Terms of the time, in words.
    pub time_terms: String,
    /// On which share of the way the axes hold the feed, and where most time is lost; where the limits are known.
    pub feed_held: Option<String>,
    /// Kinds of blocks that are wrong or not understood: behind the first of them no move is proven.
    pub errors: usize,
    /// Whether the moves that were read could be followed; without, their counts, way and time are nought.
    pub followed: bool,
    /// Findings.
    pub findings: Vec<Finding>,
    /// Parts that were read and are not followed, and assumptions.
    pub remarks: Vec<String>,
}

/// Reads a given program, follows it and compares axis positions with the travel of the machine, if there is one.
///
/// ```
/// use kinecut::job::{GivenFile, ProgramWants, given_alone};
/// use kinecut::verbs::check::program_sheet;
/// let bytes = b"G21 G90 G94 G54\nT1 M6\nG43\nG0 X0 Y0 Z5\nG1 Z-1 F300\nX30\nM2\n";
/// let program = GivenFile { name: "slot.ngc", bytes };
/// let sheet = program_sheet(&given_alone(program, &ProgramWants::default(), false).unwrap()).unwrap();
/// assert_eq!(sheet.feed_moves, 2);
/// // 6 mm down and 30 mm along at 5 mm/s.
/// assert!((sheet.time - 7.2).abs() < 1e-9 && sheet.findings.is_empty());
/// ```
///
/// # Errors
/// Those of the reader and of the trace, each at its place in the program.
pub fn program_sheet(given: &GivenJob) -> Result<ProgramSheet> {
    let job = given.job();
    let program = given.program()?;
    let none = MotionSums::new(to_work(given));
    let mut sums = none.clone();
    // Only the law of the axes needs all segments at once.
    let mut add = |segments: &[Segment]| sums.add(segments);
    let each: Option<&mut Taker<'_>> = if job.machine.is_some() { None } else { Some(&mut add) };
    let done = follow_passing(job, 0, program, (Missing::StoodFor, Errors::GoOn), each)?;
    sums.add(&done.trace.segments);
    if !done.followed {
        sums = none;
    }
    let line = |item: u32| done.line(item);
    let read = &done.reading.program;
    let mut findings = done.errors.clone();
    findings.extend(done.findings.iter().cloned());
    if let Some(machine) = &job.machine {
        let travel = travel_findings(&done.trace, read, machine).into_iter();
        let found = travel.chain(not_held(&done.trace, machine));
        findings.extend(found.map(|f| *at_block(f.into(), program, line).0));
    }
    let few = || read.items.few().map(|i| read.items.get(i));
    let moves = |item| matches!(item, Item::Move(_) | Item::Cycle(..));
    if !(0..read.items.len()).any(|i| moves(read.items.get(i))) {
        findings.push(
            Finding::warning(Code::NC_STATE, "the program moves nothing").help("is it the right file?"),
        );
    }
    let law = match &job.machine {
        Some(machine) if done.errors.is_empty() => program_time(read, &done.trace, machine, &Silent)?,
        _ => None,
    };
    let reason = law.as_ref().and_then(|law| law.reason.clone());
    let facets = law.as_ref().zip(job.machine.as_ref());
    let facets = facets.and_then(|(law, machine)| facets_note(&done.trace, law, machine));
    findings.extend(facets.into_iter().chain(reason).map(|f| *at_block(f.into(), program, line).0));
    findings.sort_by_key(|f| std::cmp::Reverse(f.severity));
    let programmed = sums.time + done.trace.dwells.iter().map(|d| d.1).sum::<f64>();
    let machine = job.machine.as_ref();
    let remarks = done.unfollowed.iter().map(ToString::to_string);
    let remarks = remarks.chain(done.trace.assumed.iter().cloned());
    Ok(ProgramSheet {
        file: program.file.clone(),
        control: program.control.name().to_owned(),
        lines: line_count(&program.text),
        feed_moves: sums.feed_moves,
        rapid_moves: sums.rapid_moves,
        cycles: few().filter(|item| matches!(item, Item::Cycle(..))).count(),
        stops: few().filter(|item| matches!(item, Item::Stop(kind) if *kind != StopKind::End)).count(),
        tools: tools(read),
        offsets: offsets(read),
        range: sums.range.map(|all| [all.min.to_array(), all.max.to_array()]),
        feed_length: sums.feed_length,
        time: law.as_ref().map_or(programmed, ProgramTime::total),
        time_without_jerk_limit: law.as_ref().map(ProgramTime::total_without_jerk),
        time_has_rapids: sums.is_timed || law.is_some(),
        feed_held: law.as_ref().and_then(|law| {
            let (held, slowest) = HeldFeed::of(&done.trace, law).words(line)?;
            Some(if slowest.is_empty() { held } else { format!("{held}; {slowest}") })
        }),
        time_terms: match &law {
            Some(law) => terms(&[(&done.trace, Some(law))], machine),
            None => at_programmed_feeds(sums.is_timed, machine),
        },
        errors: done.errors.len(),
        followed: done.followed,
        findings,
        remarks: remarks.collect(),
    })
}

/// The tools that a program calls, in their order.
fn tools(program: &Program) -> Vec<String> {
    let mut tools = Vec::new();
    for i in program.items.few() {
        if let Item::Tool { id, .. } = program.items.get(i) {
            let name = id.to_string();
            if !tools.contains(&name) {
                tools.push(name);
            }
        }
    }
    tools
}

/// The work offsets in which a program moves, in their order.
fn offsets(program: &Program) -> Vec<String> {
    let mut offsets = Vec::new();
    let mut last = None;
    for i in 0..program.items.len() {
        // Neighbours of one state have one frame.
        let state = Some(program.items.state(i));
        if state == last || !matches!(program.items.get(i), Item::Move(_)) {
            continue;
        }
        last = state;
        let mut frame = program.state(i).frame;
        while let Some(Frame::Shift { parent, .. } | Frame::Tilted { parent, .. }) =
            program.frames.get(frame.0 as usize)
        {
            frame = *parent;
        }
        if let Some(Frame::Work(offset)) = program.frames.get(frame.0 as usize) {
            let name = offset.to_string();
            if !offsets.contains(&name) {
                offsets.push(name);
            }
        }
    }
    offsets
}

/// Maps part coordinates into those of the first work offset.
fn to_work(given: &GivenJob) -> Rigid {
    let Some(setup) = given.job().setups.first() else { return Rigid::IDENTITY };
    let work = setup.setup.work_offsets.get(&setup.offset).copied().unwrap_or(Rigid::IDENTITY);
    work.inverse().after(&setup.setup.part_on_table)
}

impl Answer for ProgramSheet {
    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }

    fn sections(&self) -> Vec<Section> {
        let head = format!("{} for {}, {} lines", self.file, self.control, self.lines);
        let cycles = if self.cycles > 0 { format!(", {} cycles", self.cycles) } else { String::new() };
        let stops = if self.stops > 0 { format!(", {} stops", self.stops) } else { String::new() };
        let moves = format!("{} at feed, {} rapid{cycles}{stops}", self.feed_moves, self.rapid_moves);
        let mut facts = vec![Fact::new("Program", head)];
        if let Some(first) = self.findings.iter().filter(|_| self.errors > 0).find_map(|f| f.place.as_ref()) {
            let kinds = if self.errors == 1 { "one kind of block is" } else { "several kinds of blocks are" };
            let read = format!(
                "in part: {kinds} wrong or not understood; from line {} on nothing is proven",
                first.line
            );
            facts.push(Fact::new("Read", read));
        }
        if self.followed {
            facts.push(Fact::new("Moves", moves));
        }
        let lists = [("Tools", &self.tools), ("Offsets", &self.offsets)];
        let lists = lists.into_iter().filter(|(_, list)| !list.is_empty());
        facts.extend(lists.map(|(label, list)| Fact::new(label, list.join(", "))));
        if let Some([low, high]) = self.range {
            let one = |i: usize, letter: char| format!("{letter} {:.3} to {:.3}", low[i], high[i]);
            facts.push(Fact::new("At feed", format!("{}, {}, {} mm", one(0, 'X'), one(1, 'Y'), one(2, 'Z'))));
        }
        let time =
            format!("{}, {}; {:.0} mm at feed", page::duration(self.time), self.time_terms, self.feed_length);
        if self.followed {
            let of = if self.errors > 0 { ", of what was followed" } else { "" };
            facts.push(Fact::new("Time", format!("{time}{of}")));
        }
        facts.extend(self.feed_held.as_ref().map(|held| Fact::new("Feed", held.as_str())));
        facts.extend(self.remarks.iter().map(|remark| Fact::new("Remark", remark.as_str())));
        vec![Section::default().with(Block::Facts(facts))]
    }
}

/// Lines of a text, the last one with or without its end.
fn line_count(text: &str) -> usize {
    let ends = text.bytes().filter(|b| *b == b'\n').count();
    ends + usize::from(!text.is_empty() && !text.ends_with('\n'))
}
