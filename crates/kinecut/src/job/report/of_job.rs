//! The report of a job's outcome: what every job has. Each operation adds its own section.

use super::model::{PartView, ProgramPart, ProgramView, Report, ReportVerdict, ToolView};
use super::{PathPiece, PathRole, before_run, cutting, design, engagement, fixtures, machine};
use crate::base::at_most;
use crate::geom::ProfileElement;
use crate::job::feeds::lowered_words;
use crate::job::held_feed::HeldFeed;
use crate::job::inches::report_in_inches;
use crate::job::simulate::Simulation;
use crate::job::time_terms::terms;
use crate::job::{Outcome, PartSurface, SetupOutcome};
use crate::operations::OperationPlan;
use crate::page;
use crate::page::{Block, Fact, Section};
use crate::program::Role;
use crate::tool::{Cutter, Tool};
use crate::trace::{Segment, SegmentPace};

/// Largest distance of the drawn path from the true one [mm].
const DRAWN_CHORD: f64 = 0.02;

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
    report.tools = tools(outcome);
    let mut controls: Vec<&str> = outcome.setups.iter().map(|s| s.control(&outcome.job).name()).collect();
    controls.dedup();
    let mut view = ProgramView { control: controls.join(", "), ..ProgramView::default() };
    let mut first_lines = Vec::with_capacity(outcome.setups.len());
    for (number, setup) in outcome.setups.iter().enumerate() {
        let offset = view.lines.len() as u32;
        first_lines.push(offset);
        if outcome.setups.len() > 1 {
            view.parts.push(ProgramPart { file: setup.file.clone(), first: offset });
        }
        let shown = |line: &str| if page { line.to_owned() } else { String::new() };
        view.lines.extend(setup.posted.text.lines().map(shown));
        view.time.resize(view.lines.len(), 0.0);
        view.length.resize(view.lines.len(), 0.0);
        times(setup, offset, &mut view);
        if page {
            path(outcome, number, offset, &mut report.path);
        }
    }
    if page {
        report.fixtures = fixtures::views(outcome, &first_lines, view.lines.len() as u32);
        report.machine = machine::view(outcome, &report.path, &first_lines, view.lines.len() as u32);
        report.playback = outcome.simulation.playback.as_ref().map(|played| played.surface.clone());
    }
    let begins = sums(&view.time);
    view.file = outcome.setups.iter().map(|s| s.file.as_str()).collect::<Vec<_>>().join(", ");
    report.program = Some(view);
    let setups = first_lines.iter().enumerate();
    let shown: Vec<_> = setups.flat_map(|(i, first)| outcome.shown(i, &begins, *first)).collect();
    report.sections = OperationPlan::sections(&shown);
    report.sections.extend(cutting::section(outcome));
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

/// For each line the time at which it begins [s], and last the time of all.
fn sums(times: &[f32]) -> Vec<f64> {
    let mut sum = 0.0;
    let ends = times.iter().map(|t| {
        sum += f64::from(*t);
        sum
    });
    std::iter::once(0.0).chain(ends).collect()
}

/// Gives the rows of all tables the line as the program of their own setup counts it; programs begin at `first_lines`.
fn count_in_own_programs(sections: &mut [Section], first_lines: &[u32]) {
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
    let time: f64 = outcome.setups.iter().map(SetupOutcome::seconds).sum();
    let times: Vec<_> = outcome.setups.iter().map(|s| (&s.trace, s.time.as_ref())).collect();
    verdict
        .facts
        .push(Fact::new("Time", page::duration(time)).note(terms(&times, outcome.job.machine.as_ref())));
    for s in &outcome.setups {
        let line = |item: u32| s.lines.get(item as usize).copied().flatten();
        let held = s.time.as_ref().and_then(|law| HeldFeed::of(&s.trace, law).words(line));
        let note = |slowest: String| {
            let words = Some(slowest).filter(|words| !words.is_empty()).into_iter().chain(lowered_words(s));
            words.collect::<Vec<_>>().join("; ")
        };
        verdict.facts.extend(held.map(|(held, slowest)| Fact::new("Feed", held).note(note(slowest))));
    }
    let used: Vec<String> = outcome
        .job
        .tools
        .iter()
        .filter(|t| uses(outcome, t).next().is_some())
        .map(|t| format!("{} {}", t.number, t.name))
        .collect();
    verdict.facts.push(match used.len() {
        0..=2 => Fact::new("Tools", used.join(", ")),
        many => Fact::new("Tools", many.to_string()).note(used.join(", ")),
    });
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

fn uses<'a>(outcome: &'a Outcome, tool: &'a Tool) -> impl Iterator<Item = (&'a Segment, f64)> {
    let segments = outcome.setups.iter().flat_map(|s| s.trace.segments.iter().zip(s.segment_times()));
    segments.filter(move |(s, _)| s.tool == Some(tool.number) && !s.alternative)
}

fn tools(outcome: &Outcome) -> Vec<ToolView> {
    let tools = &outcome.job.tools;
    tools
        .iter()
        .map(|tool| {
            let diameter = tool.cutter.diameter(tool.flute_length);
            let mut view = ToolView::new(tool.number.0, &tool.name, diameter, tool.flute_length);
            view.stickout = Some(tool.stickout);
            view.teeth = tool.teeth;
            view.corner = match tool.cutter {
                Cutter::BallNose { diameter } => diameter / 2.0,
                Cutter::BullNose { corner_radius, .. } => corner_radius,
                _ => 0.0,
            };
            for (segment, time) in uses(outcome, tool).filter(|(s, _)| s.motion != SegmentPace::Rapid) {
                view.time += time;
                view.length += segment.curve.length();
            }
            if tool.holder.is_none() {
                view.note = "no holder given".to_owned();
            }
            view.outline = outline(tool);
            view
        })
        .collect()
}

/// Half outline of a tool from the tip upwards, arcs in steps.
fn outline(tool: &Tool) -> Vec<[f32; 2]> {
    const ARC_STEPS: u32 = 8;
    let mut points = vec![[0.0, 0.0]];
    // The tools of a checked job have valid profiles.
    let bodies = [tool.cutting_profile().ok().map(|p| (p, 0.0)), tool.shank_profile().ok().flatten()];
    let holder = tool.holder_profiles().unwrap_or_default();
    for (profile, z) in bodies.into_iter().flatten().chain(holder) {
        for element in profile.elements() {
            let steps = if matches!(element, ProfileElement::Torus { .. }) { ARC_STEPS } else { 1 };
            let (low, high) = (element.bottom(), element.top());
            if let ProfileElement::Cone { z0, r0, .. } = *element {
                points.push([r0 as f32, (z + z0) as f32]);
            }
            for i in 1..=steps {
                let h = low + (high - low) * f64::from(i) / f64::from(steps);
                points.push([element.radius(h) as f32, (z + h) as f32]);
            }
        }
    }
    points
}

/// The segments of a setup's program with the line of the report, counted from `offset`, that each belongs to, and the time
/// of each [s].
fn on_lines(setup: &SetupOutcome, offset: u32) -> impl Iterator<Item = (u32, usize, &Segment, f64)> {
    let all = setup.trace.segments.iter().zip(setup.segment_times()).enumerate();
    all.filter(|(_, (s, _))| !s.alternative).filter_map(move |(index, (segment, time))| {
        let line = setup.lines.get(segment.item as usize).copied().flatten()?;
        Some((line + offset, index, segment, time))
    })
}

fn times(setup: &SetupOutcome, offset: u32, view: &mut ProgramView) {
    for (block, _, segment, time) in on_lines(setup, offset) {
        view.time[block as usize] += time as f32;
        view.length[block as usize] += segment.curve.length() as f32;
    }
}

fn path(outcome: &Outcome, number: usize, offset: u32, path: &mut Vec<PathPiece>) {
    let setup = &outcome.setups[number];
    let Simulation { playback, engagement, .. } = &outcome.simulation;
    let clock = playback.as_ref().map(|played| (&played.clock, played.first_move[number]));
    let engaged = engagement.as_ref().map(|engagement| &engagement.moves[number]);
    for (block, index, segment, _) in on_lines(setup, offset) {
        let planned = setup.planned_item(segment.item).map(|i| setup.planned.program.origin(i as usize).role);
        let role = match (segment.motion, planned.unwrap_or_default()) {
            (SegmentPace::Rapid, _) => PathRole::Rapid,
            (_, Role::Lead) => PathRole::Lead,
            (_, Role::Rough) => PathRole::Rough,
            (_, Role::Finish) => PathRole::Finish,
            // Of a program that others wrote it is not known what a feed move is for.
            (_, Role::Link) if setup.external.is_some() => PathRole::Feed,
            (_, Role::Link) => PathRole::Link,
        };
        let points = segment.curve.polyline(DRAWN_CHORD).iter().map(|p| p.as_vec3().to_array()).collect();
        let mut piece = PathPiece::new(block, role, points);
        piece.tool =
            outcome.job.tools.iter().position(|t| Some(t.number) == segment.tool).unwrap_or(0) as u32;
        piece.axis = segment.axis.as_vec3().to_array();
        piece.done = clock.map_or(0.0, |(clock, first)| clock.done(first + index, 1.0) as f32);
        piece.engaged = engaged
            .map_or(Vec::new(), |moves| engagement::runs(setup, segment, &moves[index], &outcome.job.tools));
        if let Some(machine) = outcome.job.machine.as_ref().filter(|machine| !machine.bodies.is_empty()) {
            piece.joints = machine::joints(machine, segment, &piece.points);
        }
        path.push(piece);
    }
}
