//! The report of a job that was planned and not cut.

use super::of_job::{count_in_own_programs, program_facts};
use super::programs::Programs;
use super::tools::tools;
use super::{BodyView, PartView, Report, ReportVerdict, cutting, fixtures, machine};
use crate::geom::Rigid;
use crate::job::inches::report_in_inches;
use crate::job::{Draft, Judgement, SetupOutcome};
use crate::operations::OperationPlan;
use crate::page::draw::Facets;

/// The report of a draft: path, programs, tools, the sections of its operations, and the raw stock in the place of the part. Nothing
/// was judged, which its verdict says.
pub fn of_draft(draft: &Draft) -> Report {
    let Draft { job, setups, .. } = draft;
    let mut report =
        Report::new(&job.title, ReportVerdict::new(Judgement::NotProven, "Planned, and not simulated"));
    report.verdict.facts = program_facts(job, setups);
    report.job_file = draft.job_file.clone();
    report.time = Some(setups.iter().map(SetupOutcome::seconds).sum());
    let BodyView { vertices, triangles, .. } = BodyView::new("", &Facets::of(&job.stock, &Rigid::IDENTITY));
    report.part =
        Some(PartView { vertices, triangles, deviation: Vec::new(), tolerance: 0.0, relative: false });
    report.tools = tools(job, setups);
    let programs = Programs::of(job, setups, true, |_, _, _, _| {});
    report.fixtures = fixtures::views(job, &programs.first_lines, programs.lines());
    report.machine = machine::view(job, &programs.path, &programs.first_lines, programs.lines());
    let Programs { view, first_lines, begins, path } = programs;
    report.path = path;
    report.program = Some(view);
    let numbered = first_lines.iter().enumerate();
    let shown: Vec<_> = numbered.flat_map(|(i, first)| draft.shown(i, &begins, *first)).collect();
    report.sections = OperationPlan::sections(&shown);
    report.sections.extend(cutting::section(job));
    count_in_own_programs(&mut report.sections, &first_lines);
    report.findings = draft.findings.clone();
    if job.units.is_inch() {
        report_in_inches(&mut report, job);
    }
    report
}
