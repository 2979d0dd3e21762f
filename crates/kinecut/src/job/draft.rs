//! A job as far as it is planned, posted, read back and followed: nothing is cut. For a page that shows a plan while its job is
//! being written.

use std::collections::BTreeMap;

use super::check::{Job, check};
use super::contacts;
use super::external::GivenJob;
use super::facets::facets_note;
use super::feeds;
use super::following::line_place;
use super::inches::{error_in_its_units, findings_in_their_units, in_other_unit};
use super::plan::plan;
use super::run::{head_line, post_all, stem, still_wanted, under_stock, worst_first};
use super::setup_outcome::SetupOutcome;
use super::{JobText, Subject, parts};
use crate::base::{Error, Finding, Loader, Progress, Result, Sources};
use crate::motion::program_time;
use crate::operations::{OperationJson, OperationPlan, Shown};
use crate::trace::travel_findings;

/// A job with its programs.
///
/// ```
/// use kinecut::base::{MemoryLoader, Silent};
/// use kinecut::job::Draft;
/// let job = r#"
///     format = 1
///     stock = { box = { min = [0, 0, -10], max = [40, 30, 0] } }
///     post = { control = "linuxcnc" }
///     tool = [{ number = 1, type = "drill", diameter = 8, point_angle = 118, flute_length = 40 }]
///     [[setup]]
///     offset = "G54"
///     [[setup.operation]]
///     type = "drill"
///     tool = 1
///     points = [[10, 10], [30, 10]]
///     top = 0
///     depth = 6
///     speed = 1000
///     feed_per_rev = { steady = 0.1 }
/// "#;
/// let draft = Draft::of("plate.toml", job, &MemoryLoader::default(), &Silent).unwrap();
/// assert_eq!((draft.setups.len(), draft.setups[0].file.as_str()), (1, "plate.ngc"));
/// assert!(draft.setups[0].posted.text.contains("X30"));
/// ```
#[derive(Debug)]
pub struct Draft {
    /// Name of the job file as the user gave it.
    pub job_file: String,
    /// The checked job.
    pub job: Job,
    /// For each setup its program.
    pub setups: Vec<SetupOutcome>,
    /// What is known without cutting, the worst first: of the text, of the plan, of following the programs.
    pub findings: Vec<Finding>,
    /// Files of programs that others wrote, with their hashes.
    pub(super) subjects: Vec<Subject>,
}

impl Draft {
    /// Plans and posts a job from its text, and follows its programs. Their times are those of the programmed feeds until
    /// [`Draft::take_times`].
    ///
    /// # Errors
    /// Those of [`run`](super::run()) before it cuts.
    pub fn of(name: &str, text: &str, loader: &dyn Loader, progress: &dyn Progress) -> Result<Draft> {
        Draft::of_text(name, text, loader, progress).map_err(|e| error_in_its_units(text, loader, e))
    }

    fn of_text(name: &str, text: &str, loader: &dyn Loader, progress: &dyn Progress) -> Result<Draft> {
        let mut sources = Sources::default();
        let id = sources.add(name, text);
        let job_text = JobText::read(&mut sources, id, loader)?;
        let locate = |e: Error| job_text.locate(&sources, e);
        let mut job = check(&job_text.file, &stem(name), loader).map_err(locate)?;
        job.in_other_unit = in_other_unit(text, loader);
        let mut notes = job_text.notes(&sources);
        notes.extend(job.data_notes().into_iter().map(|note| *locate(note.into()).0));
        // Only programs of others are named by a hash.
        let has_given = job.setups.iter().any(|setup| setup.program.is_some());
        let subjects = if has_given { parts(&job_text.file, loader)? } else { Vec::new() };
        Draft::followed(name, job, (subjects, notes), &locate, progress)
    }

    /// As [`Draft::of`], for a program that others wrote.
    ///
    /// # Errors
    /// Those of [`simulate_given`](super::simulate_given) before it cuts.
    pub fn of_given(given: GivenJob, progress: &dyn Progress) -> Result<Draft> {
        let (name, job, subjects, place) = given.into_parts();
        Draft::followed(&name, job, (subjects, Vec::new()), &|e| place.locate(e), progress)
    }

    fn followed(
        name: &str,
        job: Job,
        (subjects, notes): (Vec<Subject>, Vec<Finding>),
        locate: &dyn Fn(Error) -> Error,
        progress: &dyn Progress,
    ) -> Result<Draft> {
        progress.stage("plan", 1);
        let planned = plan(&job, progress).map_err(locate)?;
        still_wanted(progress)?;
        let setups = post_all(&job, &planned, &head_line(&[])).map_err(locate)?;
        still_wanted(progress)?;
        let located = |finding: Finding| *locate(finding.into()).0;
        let mut found: Vec<Finding> = under_stock(&job).map(located).into_iter().collect();
        found.extend(notes);
        found.extend(contacts::fixtures::in_stock(&job)?);
        for done in &setups {
            found.extend(done.planned.findings.iter().cloned().map(located));
            found.extend(of_following(&job, done));
        }
        worst_first(&mut found, &setups);
        findings_in_their_units(&job, &mut found);
        Ok(Draft { job_file: name.to_owned(), job, setups, findings: found, subjects })
    }

    /// Takes the time of each program under the limits of the machine, where it has any: as long again as all before, and more.
    ///
    /// # Errors
    /// `KC0009` when cancelled; those of the time law.
    pub fn take_times(&mut self, progress: &dyn Progress) -> Result<()> {
        let Draft { job, setups, findings, .. } = self;
        let Some(machine) = &job.machine else { return Ok(()) };
        progress.stage("time", setups.iter().map(|s| s.trace.segments.len() as u64).sum());
        let mut found = Vec::new();
        for done in setups.iter_mut() {
            done.time = program_time(&done.program, &done.trace, machine, progress)?;
            still_wanted(progress)?;
            let facets = done.time.as_ref().and_then(|time| facets_note(&done.trace, time, machine));
            let reason = done.time.as_ref().and_then(|time| time.reason.clone());
            found.extend(facets.into_iter().chain(reason).map(|note| at_line(done, note)));
        }
        findings_in_their_units(job, &mut found);
        findings.extend(found);
        worst_first(findings, setups);
        Ok(())
    }

    /// The planned operations of a setup with all that their sections may show: nothing was measured.
    pub(crate) fn shown<'a>(
        &'a self,
        setup: usize,
        begins: &'a [f64],
        first_line: u32,
    ) -> Vec<(&'a OperationPlan, Shown<'a>)> {
        let time = |setups: &[SetupOutcome]| setups.iter().map(SetupOutcome::seconds).sum::<f64>();
        let posted = self.setups[setup].posted_plan(setup, &self.job.setups[setup]);
        let operations = self.setups[setup].planned.operations.iter();
        let one = operations.map(|operation| {
            let shown = Shown {
                number: operation.number,
                name: self.job.operation_name(operation.number),
                posted,
                first_line,
                begins,
                time: [time(&self.setups[..setup]), time(&self.setups)],
                rapid: self.job.machine.as_ref().and_then(|m| m.dynamics.rapid),
                points: &[],
                walls: Vec::new(),
                plane: None,
            };
            (&operation.plan, shown)
        });
        one.collect()
    }

    /// What the operations of a setup say of themselves, one list for each kind.
    pub(super) fn lists(&self, setup: usize) -> BTreeMap<&'static str, Vec<OperationJson>> {
        OperationJson::lists(&self.shown(setup, &[], 0)).into_iter().collect()
    }
}

/// A finding about an item of a followed program, at its line.
fn at_line(done: &SetupOutcome, mut finding: Finding) -> Finding {
    let line = finding.item.take().and_then(|item| done.lines.get(item as usize).copied().flatten());
    finding.place = line_place(&done.file, &done.posted.text, line);
    finding
}

/// Findings about a followed program that no stock is needed for, each at its line.
fn of_following(job: &Job, done: &SetupOutcome) -> Vec<Finding> {
    let mut found: Vec<Finding> = done.external.iter().flat_map(|given| given.findings.clone()).collect();
    found.extend(done.planned.operations.iter().flat_map(|o| o.plan.remarks().iter().cloned()));
    if let Some(machine) = &job.machine {
        let travel = travel_findings(&done.trace, &done.program, machine).into_iter();
        let feeds = feeds::not_held(&done.trace, machine);
        found.extend(travel.chain(feeds).map(|finding| at_line(done, finding)));
    }
    found
}
