//! Planned drillings as the report takes them: of a job's outcome, and of the sheet of `kinecut drill`.

use super::drill::{
    DrilledHole, RefusedHole, drill_html, drill_list, drill_sections, drill_text, refused_text,
};
use super::model::ProgramView;
use crate::drilling::PaperResult;
use crate::job::{DrillSheet, Operation, Outcome, PlannedHole, SetupOutcome};
use crate::page::Section;
use crate::program::{Item, Speed};

/// Places along a hole at which the simulated share is shown.
const PLACES: u32 = 400;

/// A hole with what belongs to it, kept for the borrowing view.
struct Shown<'a> {
    title: String,
    hole: &'a PlannedHole,
    paper: Option<PaperResult>,
    simulated: Vec<[f64; 2]>,
    starts_at: Option<f64>,
}

impl<'a> Shown<'a> {
    fn new(title: String, hole: &'a PlannedHole) -> Shown<'a> {
        Shown { title, hole, paper: None, simulated: Vec::new(), starts_at: None }
    }

    fn view(&self) -> DrilledHole<'_> {
        let [x, y] = self.hole.at;
        DrilledHole {
            at: Some([x, y, self.hole.zero]),
            paper: self.paper.as_ref(),
            simulated: &self.simulated,
            starts_at: self.starts_at,
            ..DrilledHole::new(&self.title, &self.hole.spec, &self.hole.plan)
        }
    }
}

/// Of one hole what is done there; of many which one it is.
fn title(name: &str, hole: &PlannedHole, count: usize) -> String {
    if count == 1 {
        return name[..1].to_uppercase() + &name[1..];
    }
    let [x, y] = hole.at.map(|v| (v * 1e3).round() / 1e3 + 0.0);
    format!("D{} hole {} at X{x} Y{y}", hole.spec.diameter, hole.number + 1)
}

/// The sections of a job's drillings. `view` has the time of each line; lines of a setup begin at `first_lines`.
pub(super) fn sections(outcome: &Outcome, view: &ProgramView, first_lines: &[u32]) -> Vec<Section> {
    let operations: Vec<&Operation> = outcome.job.setups.iter().flat_map(|s| &s.operations).collect();
    let mut sections = Vec::new();
    let begins: Vec<f64> = sums(&view.time);
    for (done, first) in outcome.setups.iter().zip(first_lines) {
        for drilling in &done.planned.drillings {
            let name = operations.get(drilling.operation as usize).map_or_else(String::new, |o| o.name());
            let count = drilling.holes.len();
            let shown: Vec<Shown<'_>> = drilling
                .holes
                .iter()
                .map(|hole| Shown {
                    simulated: outcome.engagement(drilling.operation, hole, PLACES),
                    starts_at: starts_at(done, hole, &begins, *first),
                    ..Shown::new(title(&name, hole, count), hole)
                })
                .collect();
            let views: Vec<DrilledHole<'_>> = shown.iter().map(Shown::view).collect();
            sections.extend(drill_sections(&views, &[]));
        }
    }
    sections
}

/// Time of the program when a hole starts at feed [s]; `None` for holes whose stretches are a cycle's, in which time and
/// way are not one to one.
fn starts_at(done: &SetupOutcome, hole: &PlannedHole, begins: &[f64], first: u32) -> Option<f64> {
    let program = &done.planned.program;
    let at_feed = |i: &usize| !matches!(program.state(*i).speed, Speed::Rapid { .. });
    let item = (hole.first_item as usize..program.items.len()).find(at_feed)?;
    if matches!(program.items.get(item), Item::Cycle(..)) {
        return None;
    }
    let line = (first + done.line_of_planned(item as u32)?) as usize;
    begins.get(line).copied()
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

/// The holes of sheets, and those that were refused.
fn of_sheets(sheets: &[DrillSheet], paper: bool) -> (Vec<Shown<'_>>, Vec<RefusedHole>) {
    let (mut shown, mut refused) = (Vec::new(), Vec::new());
    for sheet in sheets {
        for (number, hole) in sheet.holes.iter().enumerate() {
            match hole {
                Ok(hole) => {
                    let title = title(&sheet.name, hole, sheet.holes.len());
                    let paper = if paper { hole.paper() } else { None };
                    shown.push(Shown { paper, ..Shown::new(title, hole) });
                }
                Err(e) => refused.push(RefusedHole {
                    title: format!("{}: hole {}", sheet.name, number + 1),
                    at: None,
                    finding: (*e.0).clone(),
                }),
            }
        }
    }
    (shown, refused)
}

/// The page of `kinecut drill`; `paper` adds what the paper's own formulas give.
pub fn sheets_html(sheets: &[DrillSheet], paper: bool) -> String {
    let (shown, refused) = of_sheets(sheets, paper);
    let views: Vec<DrilledHole<'_>> = shown.iter().map(Shown::view).collect();
    drill_html(&views, &refused)
}

/// A sheet as text: a hole in full, of a pattern a line each.
pub fn sheet_text(sheet: &DrillSheet, paper: bool) -> String {
    let (shown, refused) = of_sheets(std::slice::from_ref(sheet), paper);
    let views: Vec<DrilledHole<'_>> = shown.iter().map(Shown::view).collect();
    match (&views[..], &refused[..]) {
        ([one], []) => drill_text(one),
        ([], [one]) => refused_text(one),
        (views, refused) => drill_list(views, refused),
    }
}
