//! The report of a job's outcome: what every job has. Each operation adds its own section.

use super::model::{PartView, Report, ReportVerdict};
use super::programs::Programs;
use super::tools::{tools, uses};
use super::{before_run, cutting, design, engagement, fixtures, machine};
use crate::base::at_most;
use crate::job::check::Job;
use crate::job::feeds::lowered_words;
use crate::job::held_feed::HeldFeed;
use crate::job::inches::report_in_inches;
use crate::job::simulate::Simulation;
use crate::job::time_terms::terms;
use crate::job::{Outcome, PartSurface, SetupOutcome};
use crate::operations::OperationPlan;
use crate::page;
use crate::page::{Block, Fact, Section};

/// The report of an outcome.
pub fn of_job(outcome: &Outcome) -> Report {
    with(outcome, true)
}

/// The report of an outcome without what only its page shows: the lines of the programs have no text, and there is no path.
pub fn of_job_in_words(outcome: &Outcome) -> Report {
    with(outcome, false)
}

fn with(outcome: &Outcome, page: bool) -> Report {
    let mut report = Report::new(&outcome.job.title, verdict(outcome));
    report.job_file = outcome.job_file.clone();
    report.time = Some(outcome.setups.iter().map(SetupOutcome::seconds).sum());
    let mut part =
        PartView::new(&outcome.part, outcome.deviation.at_vertices.clone(), outcome.deviation.tolerance);
    part.relative = outcome.deviation.relative;
    report.part = (outcome.job.part_surface != PartSurface::None).then_some(part);
    report.drawn_step = outcome.drawn_step;
    report.tools = tools(&outcome.job, &outcome.setups);
    let Simulation { playback, engagement, .. } = &outcome.simulation;
    let programs = Programs::of(&outcome.job, &outcome.setups, page, |number, index, segment, piece| {
        let clock = playback.as_ref().map(|played| (&played.clock, played.first_move[number]));
        piece.done = clock.map_or(0.0, |(clock, first)| clock.done(first + index, 1.0) as f32);
        if let Some(moves) = engagement.as_ref().map(|engagement| &engagement.moves[number]) {
            piece.engaged =
                engagement::runs(&outcome.setups[number], segment, &moves[index], &outcome.job.tools);
        }
    });
    if page {
        let lines = programs.lines();
        report.fixtures = fixtures::views(&outcome.job, &programs.first_lines, lines);
        let compared = outcome.simulation.machine.iter().flatten().any(|c| c.not_compared.is_none());
        report.machine = Some(&outcome.job)
            .filter(|_| compared)
            .and_then(|job| machine::view(job, &programs.path, &programs.first_lines, lines));
        report.playback = playback.as_ref().map(|played| played.surface.clone());
    }
    let Programs { view, first_lines, begins, path } = programs;
    report.path = path;
    report.program = Some(view);
    let setups = first_lines.iter().enumerate();
    let shown: Vec<_> = setups.flat_map(|(i, first)| outcome.shown(i, &begins, *first)).collect();
    report.sections = OperationPlan::sections(&shown);
    report.sections.extend(cutting::section(&outcome.job));
    report.sections.extend(engagement::section(outcome, &begins, &first_lines));
    report.sections.extend(design::section(outcome, &first_lines));
    report.sections.extend(design::rest(outcome));
    report.sections.extend(fixtures::section(outcome, &first_lines));
    report.sections.extend(machine::section(outcome, &first_lines, page));
    report.sections.extend(before_run::section(&outcome.verdict.to_ensure));
    count_in_own_programs(&mut report.sections, &first_lines);
    report.findings = outcome.verdict.found.clone();
    if outcome.job.units.is_inch() {
        report_in_inches(&mut report, &outcome.job);
    }
    report
}

/// Gives the rows of all tables the line as the program of their own setup counts it; programs begin at `first_lines`.
pub(super) fn count_in_own_programs(sections: &mut [Section], first_lines: &[u32]) {
    for block in sections.iter_mut().flat_map(|s| &mut s.blocks) {
        let Block::Table(table) = block else { continue };
        for row in &mut table.rows {
            let first = row.block.and_then(|b| first_lines.iter().rfind(|first| **first <= b));
            row.line = row.block.zip(first).map(|(block, first)| block - first + 1);
        }
    }
}

fn verdict(outcome: &Outcome) -> ReportVerdict {
    let found = &outcome.verdict.found;
    let mut verdict = ReportVerdict::new(outcome.verdict.outcome, outcome.verdict.headline.clone());
    verdict.scope = outcome.verdict.scope.clone();
    verdict.sentence = outcome.verdict.sentence();
    verdict.facts = program_facts(&outcome.job, &outcome.setups);
    if let Some(largest) = outcome.deviation.largest {
        let side = match largest.deviation {
            d if d.abs() < SHOWN => "",
            d if d < 0.0 => "too deep, ",
            _ => "stock left, ",
        };
        let value = match side {
            "" => format!("{} \u{b5}m", at_most(0.0, 1)),
            _ => unsigned(largest.deviation.abs()),
        };
        let note = format!("{side}allowed {}", unsigned(largest.tolerance));
        verdict.facts.push(Fact::new("Largest deviation", value).note(note));
    } else if outcome.job.design.is_some() || outcome.setups.iter().any(|s| s.external.is_none()) {
        verdict.facts.push(Fact::new("Largest deviation", "not measured"));
    }
    let (removed, cm3) = (outcome.removed, 1000.0);
    // A thousandth of a cubic millimetre is nothing to a person.
    let digits = removed.digits(cm3, 1).min(3);
    let rounded = 10f64.powi(digits as i32);
    // Rounded up: never kinder than it is.
    let bound = (removed.bound / cm3 * rounded).ceil() / rounded;
    verdict.facts.push(
        Fact::new("Removed", format!("{} cm\u{b3}", page::fixed(removed.value / cm3, digits)))
            .note(format!("\u{b1} {} cm\u{b3}", page::fixed(bound, digits))),
    );
    let budget = &outcome.simulation.budget;
    verdict.facts.push(Fact::new("Stock model", budget.step(&outcome.job)).note(budget.lines()));
    let planned = outcome.setups.iter().filter(|s| s.external.is_none());
    if let Some(largest) = planned.map(|s| s.read_back.largest).reduce(f64::max) {
        verdict.facts.push(
            Fact::new("Text to plan", format!("{} \u{b5}m", at_most(largest * 1e3, 2)))
                .note("largest distance of the posted path"),
        );
    }
    verdict.proven = outcome.verdict.proven.iter().map(|p| format!("{} ({})", p.claim, p.bound)).collect();
    verdict.found = found.iter().map(ToString::to_string).collect();
    verdict.not_checked = outcome.verdict.not_checked.clone();
    verdict.to_ensure = outcome.verdict.to_ensure.clone();
    // A program that was named on a command line is the one that was simulated, whatever the job names.
    let subjects = || outcome.verdict.subjects.iter();
    let given = subjects().any(|s| s.role == "given program");
    let programs = subjects().filter(|s| match given {
        true => s.role == "given program",
        false => s.role.ends_with("program"),
    });
    verdict.sha256 = programs.map(|s| s.sha256.as_str()).collect::<Vec<_>>().join(" ");
    verdict
}

/// Micrometres where the word beside them says to which side.
/// Least deviation that is not shown as a zero [mm].
const SHOWN: f64 = 5e-5;

fn unsigned(mm: f64) -> String {
    page::micrometres(mm).trim_start_matches('+').to_owned()
}

/// What the programs tell without any cutting: their time, the feed that the axes hold, the tools.
pub(super) fn program_facts(job: &Job, setups: &[SetupOutcome]) -> Vec<Fact> {
    let time: f64 = setups.iter().map(SetupOutcome::seconds).sum();
    let times: Vec<_> = setups.iter().map(|s| (&s.trace, s.time.as_ref())).collect();
    let mut facts = vec![Fact::new("Time", page::duration(time)).note(terms(&times, job.machine.as_ref()))];
    for s in setups {
        let line = |item: u32| s.lines.get(item as usize).copied().flatten();
        let held = s.time.as_ref().and_then(|law| HeldFeed::of(&s.trace, law).words(line));
        let note = |slowest: String| {
            let words = Some(slowest).filter(|words| !words.is_empty()).into_iter().chain(lowered_words(s));
            words.collect::<Vec<_>>().join("; ")
        };
        facts.extend(held.map(|(held, slowest)| Fact::new("Feed", held).note(note(slowest))));
    }
    let used: Vec<String> = job
        .tools
        .iter()
        .filter(|t| uses(setups, t).next().is_some())
        .map(|t| format!("{} {}", t.number, t.name))
        .collect();
    facts.push(match used.len() {
        0..=2 => Fact::new("Tools", used.join(", ")),
        many => Fact::new("Tools", many.to_string()).note(used.join(", ")),
    });
    facts
}
