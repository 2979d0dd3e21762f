//! The answer: times, their terms and shares, the blocks that lose most time.

use serde::Serialize;

use super::moving::MovingProgram;
use super::page::time_html;
use super::samples::SamplesWritten;
use super::shares::TimeShares;
use super::slow_block::SlowBlock;
use super::smoothed_block::SmoothedBlock;
use super::timed::Timed;
use crate::base::{Finding, Result};
use crate::job::Outputs;
use crate::job::facets::facets_note;
use crate::job::feeds::not_held;
use crate::job::held_feed::HeldFeed;
use crate::job::time_terms::terms;
use crate::motion::ProgramTime;
use crate::page::{self, Block, Fact, Section};
use crate::verbs::Answer;

/// Time of one program; s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedProgram {
    /// File.
    pub file: String,
    /// Control.
    pub control: String,
    /// Lines of the text.
    pub lines: usize,
    /// Time under the limits of the axes.
    pub time: f64,
    /// The same if jerk had no limit.
    pub time_without_jerk_limit: f64,
    /// The same at programmed feeds, rapids at full speed.
    pub time_at_programmed_feeds: f64,
    /// On which share of the way the axes hold the feed.
    pub feed_held: Option<String>,
}

/// Times of programs on their machine; mm, s, feeds in mm/min.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimeSheet {
    /// The file that was asked about: a program, or a job.
    pub file: String,
    /// Name of the machine.
    pub machine: String,
    /// The programs.
    pub programs: Vec<TimedProgram>,
    /// Time of all under the limits of the axes.
    pub time: f64,
    /// The same if jerk had no limit.
    pub time_without_jerk_limit: f64,
    /// The same at programmed feeds, rapids at full speed.
    pub time_at_programmed_feeds: f64,
    /// Terms of the time, in words.
    pub time_terms: String,
    /// Parts of the time.
    pub shares: TimeShares,
    /// The blocks that lose most time, the worst first.
    pub slowest: Vec<SlowBlock>,
    /// The blocks at whose start the control leaves the programmed path most, the farthest first.
    pub smoothed: Vec<SmoothedBlock>,
    /// The graphs of the motion, where they are asked for.
    #[serde(skip)]
    pub graphs: Vec<Section>,
    /// The samples that were written.
    pub samples: Option<SamplesWritten>,
    /// Findings.
    pub findings: Vec<Finding>,
    /// Parts that were read and are not followed, and assumptions.
    pub remarks: Vec<String>,
}

impl TimeSheet {
    pub(super) fn of(timed: &Timed, slowest: usize) -> TimeSheet {
        let all = &timed.programs;
        let programs: Vec<TimedProgram> =
            all.iter().map(|(program, time)| TimedProgram::new(program, time)).collect();
        let sum = |time: fn(&TimedProgram) -> f64| programs.iter().map(time).sum();
        let laws: Vec<_> = all.iter().map(|(program, time)| (&program.trace, Some(time))).collect();
        let mut findings: Vec<Finding> = Vec::new();
        for (program, time) in all {
            findings.extend(program.findings.iter().cloned());
            let facets = facets_note(&program.trace, time, &timed.machine);
            let found = not_held(&program.trace, &timed.machine).into_iter().chain(facets);
            findings.extend(found.chain(time.reason.clone()).map(|finding| program.at_line(finding)));
        }
        findings.sort_by_key(|f| std::cmp::Reverse(f.severity));
        TimeSheet {
            file: timed.name.clone(),
            machine: timed.machine.name.clone(),
            time: sum(|p| p.time),
            time_without_jerk_limit: sum(|p| p.time_without_jerk_limit),
            time_at_programmed_feeds: sum(|p| p.time_at_programmed_feeds),
            time_terms: terms(&laws, Some(&timed.machine)),
            shares: TimeShares::of(all),
            slowest: SlowBlock::most(all, slowest),
            smoothed: SmoothedBlock::farthest(all, slowest),
            graphs: Vec::new(),
            samples: None,
            findings,
            remarks: all.iter().flat_map(|(program, _)| program.remarks.iter().cloned()).collect(),
            programs,
        }
    }
}

impl TimedProgram {
    fn new(program: &MovingProgram, time: &ProgramTime) -> TimedProgram {
        let changes = [time.tool_changes, time.spindle_changes].into_iter().filter_map(|c| c.time);
        let held = HeldFeed::of(&program.trace, time).words(|item| program.line(item));
        TimedProgram {
            file: program.file.clone(),
            control: program.control.name().to_owned(),
            lines: program.text.lines().count(),
            time: time.total(),
            time_without_jerk_limit: time.total_without_jerk(),
            time_at_programmed_feeds: program.trace.duration().0 + changes.sum::<f64>(),
            feed_held: held.map(|(held, _)| held),
        }
    }

    /// Its facts; with its own time where it is one of several.
    fn facts(&self, several: bool) -> Vec<Fact> {
        let head = format!("{} for {}, {} lines", self.file, self.control, self.lines);
        let own = if several { format!(", {}", page::duration(self.time)) } else { String::new() };
        let mut facts = vec![Fact::new("Program", head + &own)];
        facts.extend(self.feed_held.as_ref().map(|held| Fact::new("Feed", held.as_str())));
        facts
    }
}

impl Answer for TimeSheet {
    fn files(answers: &[&TimeSheet]) -> Result<Outputs> {
        let mut outputs = Outputs::default();
        answers.iter().for_each(|sheet| outputs.add("time.html", time_html(sheet)));
        Ok(outputs)
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }

    fn sections(&self) -> Vec<Section> {
        let several = self.programs.len() > 1;
        let mut facts: Vec<Fact> = self.programs.iter().flat_map(|program| program.facts(several)).collect();
        facts.push(Fact::new("Time", page::duration(self.time)).note(self.time_terms.as_str()));
        let programmed = page::duration(self.time_at_programmed_feeds);
        facts.push(Fact::new("At programmed feeds", programmed).note("rapids at full speed"));
        facts.push(Fact::new("Shares", self.shares.words()));
        facts.extend(self.samples.as_ref().map(|samples| Fact::new("Samples", samples.words())));
        let mut section = Section::default().with(Block::Facts(facts));
        if !self.remarks.is_empty() {
            section = section.with(Block::List(self.remarks.clone()));
        }
        if !self.slowest.is_empty() {
            section = section.with(SlowBlock::table(&self.slowest, several));
        }
        if !self.smoothed.is_empty() {
            section = section.with(SmoothedBlock::table(&self.smoothed, several));
        }
        vec![section]
    }
}
