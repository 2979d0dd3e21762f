//! The main job: plan, post, read back, compare, trace, cut, compare with the wanted part, judge.

use crate::base::{Code, Error, Finding, Loader, Location, Progress, Result, Sources};
use crate::geom::Aabb;
use crate::motion::program_time;
use crate::nc::{self, PostSettings, Posted};
use crate::operations::OperationPlan;
use crate::operations::known::Known;
use crate::operations::measured::Loose;
use crate::operations::setting::corners;
use crate::stock::surface::CutSurface;
use crate::trace::{Trace, trace, travel_findings};

use super::check::{Job, check};
use super::contacts;
use super::external::{GivenJob, external_setup};
use super::facets::facets_note;
use super::following::{LinePlaces, line_place, trace_options};
use super::inches::{InInches, error_in_its_units, findings_in_their_units, in_other_unit};
use super::measure::{self, Measured, loose_cores, tallies};
use super::outcome::Outcome;
use super::part_surface::part_surface;
use super::plan::{SetupPlan, plan};
use super::prove;
use super::read_back::{ReadBack, compare};
use super::setup_outcome::{SetupOutcome, block_of_cut};
use super::shape::{Deviation, deviation};
use super::simulate::{self, Simulation, left, simulate};
use super::uncertain;
use super::verdict::{banner, not_checked, proven, scope, to_ensure};
use super::wants::StockWants;
use super::{Heading, JobText, Judgement, Subject, Verdict, feeds, names, parts, sha256};

/// Runs a job from its text.
///
/// # Errors
/// One finding about a fault of the job, at its place: see the codes `KC00`, `KC01`, `KC04`, `KC06`, `KC07`. A fault of
/// the *program* is not an error but a finding in the verdict.
pub fn run(name: &str, text: &str, loader: &dyn Loader, progress: &dyn Progress) -> Result<Outcome> {
    run_with(name, text, &RunWants::default(), loader, progress)
}

/// Settings of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunWants {
    /// Other ways than those asked for are planned too, each with its price, for the report.
    pub compare: bool,
    /// Settings of the simulation.
    pub stock: StockWants,
}

/// As [`run`], with settings that the job does not hold.
///
/// # Errors
/// As [`run`]; `KC0103` for a setting out of range.
pub fn run_with(
    name: &str,
    text: &str,
    wants: &RunWants,
    loader: &dyn Loader,
    progress: &dyn Progress,
) -> Result<Outcome> {
    run_text(name, text, wants, loader, progress).map_err(|e| error_in_its_units(text, loader, e))
}

fn run_text(
    name: &str,
    text: &str,
    wants: &RunWants,
    loader: &dyn Loader,
    progress: &dyn Progress,
) -> Result<Outcome> {
    let mut sources = Sources::default();
    let id = sources.add(name, text);
    let job_text = JobText::read(&mut sources, id, loader)?;
    let locate = |e: Error| job_text.locate(&sources, e);
    let mut job =
        Job { compare: wants.compare, ..check(&job_text.file, &stem(name), loader).map_err(locate)? };
    job.in_other_unit = in_other_unit(text, loader);
    let design = wants.stock.apply(&mut job)?;
    let mut inputs = vec![Subject {
        role: "job".to_owned(),
        file: Some(name.to_owned()),
        sha256: sha256(text.as_bytes()),
    }];
    inputs.extend(parts(&job_text.file, loader)?);
    inputs.extend(design);
    let mut notes = job_text.notes(&sources);
    notes.extend(job.data_notes().into_iter().map(|note| *locate(note.into()).0));
    run_checked(name, job, (inputs, notes), &locate, progress)
}

/// Runs a checked job; `inputs` are the subjects of its verdict other than the programs that are written, `notes`
/// findings about its text; `locate` gives an error the place of its key.
///
/// # Errors
/// As [`run`].
pub(crate) fn run_checked(
    name: &str,
    job: Job,
    (inputs, notes): (Vec<Subject>, Vec<Finding>),
    locate: &dyn Fn(Error) -> Error,
    progress: &dyn Progress,
) -> Result<Outcome> {
    progress.stage("plan", 1);
    let planned = plan(&job, progress).map_err(locate)?;
    let post =
        |planned: &[SetupPlan], verdict_line: &str| post_all(&job, planned, verdict_line).map_err(locate);
    let mut setups = post(&planned, &head_line(&[]))?;
    still_wanted(progress)?;
    let traces: Vec<&Trace> = setups.iter().map(|s| &s.trace).collect();
    let loose: Vec<Vec<Loose>> =
        setups.iter().enumerate().map(|(i, done)| loose_cores(&job, i, done)).collect();
    let wanted = measure::wanted(&job, &setups);
    let mut simulation =
        simulate(&job, &traces, &loose, &wanted.points, &wanted.walls, progress).map_err(locate)?;
    let measured = measure::judged(&job, &mut setups, wanted, &simulation);
    still_wanted(progress)?;
    let made = part_surface(&job, &setups, &mut simulation, progress).map_err(locate)?;
    let full = made.as_ref().filter(|made| made.drawn_step.is_none()).map(|made| &made.surface);
    let removed = simulation.raw.less(left(&job, &simulation.stock, full));
    let drawn_step = made.as_ref().and_then(|made| made.drawn_step);
    let CutSurface { mesh: part, cuts: part_cuts } = made.map(|made| made.surface).unwrap_or_default();
    still_wanted(progress)?;
    progress.stage("compare", 1);
    let deviation = deviation(&job, &setups, &simulation, &part)?;
    still_wanted(progress)?;
    let notes = [notes, contacts::fixtures::in_stock(&job)?].concat();
    let located = |f: Finding| *locate(f.into()).0;
    let mut found = findings(&job, &setups, &simulation, &deviation, (&measured, &notes), &located);
    if head_line(&found) != head_line(&[]) && setups.iter().any(|s| s.external.is_none()) {
        // The same program with another line of comment in its head: nothing that was found moves.
        let planned: Vec<SetupPlan> = setups.into_iter().map(|s| s.planned).collect();
        setups = post(&planned, &head_line(&found))?;
        found = findings(&job, &setups, &simulation, &deviation, (&measured, &notes), &located);
    }
    still_wanted(progress)?;
    if let Some(machine) = &job.machine {
        let moves = setups.iter().map(|s| s.trace.segments.len() as u64).sum();
        progress.stage("time", moves);
        for s in &mut setups {
            s.time = program_time(&s.program, &s.trace, machine, progress)?;
            let facets = s.time.as_ref().and_then(|time| facets_note(&s.trace, time, machine));
            let reason = s.time.as_ref().and_then(|time| time.reason.clone());
            found.extend(facets.into_iter().chain(reason).map(|mut note| {
                let line = note.item.take().and_then(|item| s.lines.get(item as usize).copied().flatten());
                note.place = line_place(&s.file, &s.posted.text, line);
                note
            }));
        }
    }
    let subjects = subjects(inputs, &setups);
    let mut proven = proven(&job, &setups, &simulation, &deviation);
    proven.extend(measured.iter().filter_map(|m| m.judged.proven.clone()));
    let (claims, left_open) = OperationPlan::sum_up(&tallies(&setups, &measured), job.step);
    proven.extend(claims);
    let mut unchecked = not_checked(&job, &setups, &simulation);
    for thin in found.iter().filter(|f| f.code == Code::OVERLAP_MISSED) {
        unchecked.add(Heading::Moves, thin.message.clone());
    }
    for what in left_open.into_iter().chain(measured.iter().filter_map(|m| m.judged.unchecked.clone())) {
        unchecked.add(Heading::Shape, what);
    }
    let files: Vec<String> = setups.iter().map(|s| s.file.clone()).collect();
    let scope = scope(&job, &setups, &simulation, &deviation);
    let mut unchecked = unchecked.groups();
    let mut ensured = to_ensure(&job, &setups, &simulation);
    findings_in_their_units(&job, &mut found);
    if job.units.is_inch() {
        let inches = InInches::of(Some(&job));
        let claims = proven.iter_mut().flat_map(|proof| [&mut proof.claim, &mut proof.bound]);
        let open = unchecked.iter_mut().flat_map(|group| &mut group.items).map(|item| &mut item.what);
        let things = ensured
            .iter_mut()
            .flat_map(|item| [&mut item.what, &mut item.value].into_iter().chain(&mut item.room));
        claims.chain(open).chain(things).for_each(|text| inches.text(text));
    }
    let verdict = Verdict::new(subjects, &files, scope, proven, found, unchecked).ensuring(ensured);
    Ok(Outcome {
        job_file: name.to_owned(),
        job,
        setups,
        simulation,
        measured,
        part,
        part_cuts,
        drawn_step,
        removed,
        deviation,
        verdict,
    })
}

/// Whether the caller still waits for the result.
///
/// # Errors
/// `KC0009` when the run was cancelled.
pub(crate) fn still_wanted(progress: &dyn Progress) -> Result<()> {
    match progress.cancelled() {
        true => Err(Finding::error(Code::CANCELLED, "the run was cancelled").into()),
        false => Ok(()),
    }
}

/// The key of an operation in the job file.
fn operation_key(job: &Job, number: u32) -> Option<String> {
    let mut before = 0;
    for (i, setup) in job.setups.iter().enumerate() {
        let in_setup = (number as usize).checked_sub(before)?;
        if in_setup < setup.operations.len() {
            return Some(format!("setup[{i}].operation[{in_setup}]"));
        }
        before += setup.operations.len();
    }
    None
}

/// The line in the head of a program that says what was found in it.
pub(super) fn head_line(found: &[Finding]) -> String {
    let advice = match Judgement::of(found) {
        Judgement::Safe => "",
        Judgement::NotProven => ", look before you run",
        Judgement::NotSafe => ", do not run",
    };
    format!("simulated: {}{advice}, see verdict.json", banner(found))
}

/// File name without folder and ending, kept to letters that every control and file system takes.
pub(super) fn stem(name: &str) -> String {
    let mut parts = name.rsplit(['/', '\\']);
    let base = parts.next().unwrap_or(name);
    let base = base.strip_suffix(".toml").unwrap_or(base);
    // A file that is just called "job" takes the name of its folder.
    let folder = parts.next().filter(|f| base == "job" && f.chars().any(|c| c.is_ascii_alphanumeric()));
    let base = folder.unwrap_or(base);
    let clean: String =
        base.chars().map(|c| if c.is_ascii_alphanumeric() || c == '_' { c } else { '_' }).collect();
    if clean.is_empty() { "job".to_owned() } else { clean }
}

/// Posts each setup, reads its text back and follows it; of a setup with a program of others, that is read.
///
/// # Errors
/// Those of posting, reading and following.
pub(super) fn post_all(job: &Job, planned: &[SetupPlan], verdict_line: &str) -> Result<Vec<SetupOutcome>> {
    let posted = planned.iter().enumerate().map(|(i, p)| match &job.setups[i].program {
        Some(program) => external_setup(job, i, program, p.clone()),
        None => names::of_setup(&job.post, i, planned.len())
            .and_then(|post| setup(job, post, p.clone(), verdict_line)),
    });
    posted.collect()
}

fn setup(job: &Job, mut post: PostSettings, planned: SetupPlan, verdict_line: &str) -> Result<SetupOutcome> {
    /// Texts in which feeds are lowered again: the blocks stay, so that the second one holds but for rounding.
    const TEXTS: usize = 3;
    post.header = vec![job.title.clone(), verdict_line.to_owned()];
    let mut done = written(job, &post, planned)?;
    for _ in 0..TEXTS {
        let Some(planned) = feeds::lower(job, &done) else { break };
        done = written(job, &post, planned)?;
    }
    Ok(done)
}

/// The text of a plan, read back and compared.
fn written(job: &Job, post: &PostSettings, planned: SetupPlan) -> Result<SetupOutcome> {
    let posted = nc::write(&planned.program, &job.tools, post).map_err(at_post_key)?;
    let mut outcome = followed(job, post, planned, posted)?;
    outcome.read_back = compare(&outcome.plan_trace, &outcome.trace, |item| outcome.planned_item(item))?;
    Ok(outcome)
}

/// A text that was written for a plan, read back.
pub(super) fn followed(
    job: &Job,
    post: &PostSettings,
    planned: SetupPlan,
    posted: Posted,
) -> Result<SetupOutcome> {
    let file = format!("{}.{}", post.program_name, post.control.extension());
    let mut sources = Sources::default();
    let reading = nc::read(&mut sources, &file, &posted.text, post.control, &planned.program.setups)?;
    let program = reading.program;
    let lines: Vec<Option<u32>> = (0..program.items.len())
        .map(|i| program.origin(i).span.map(|s| sources.line(s).saturating_sub(1)))
        .collect();
    let options = trace_options(job, &planned);
    let place = |e: Error| in_text(e, &file, &posted, &lines);
    let plan_trace = trace(&planned.program, &options)?;
    let trace = trace(&program, &options).map_err(place)?;
    Ok(SetupOutcome {
        file,
        planned,
        posted,
        plan_trace,
        program,
        trace,
        read_back: ReadBack::default(),
        lines,
        time: None,
        external: None,
        known: Known::default(),
    })
}

/// An error about a template, at the key of the job that names its file.
fn at_post_key(mut error: Error) -> Error {
    let key = match error.0.key.as_deref() {
        Some("start_template") => "post.start",
        Some("end_template") => "post.end",
        _ => return error,
    };
    error.0.key = Some(key.to_owned());
    error
}

/// An error about an item of the text, with its line.
fn in_text(mut error: Error, file: &str, posted: &Posted, lines: &[Option<u32>]) -> Error {
    if let Some(item) = error.0.item.take() {
        error.0.place = line_place(file, &posted.text, lines.get(item as usize).copied().flatten());
    }
    error
}

/// A warning when the stock stands higher over the first operation of a job than that reckons with. Where other operations come
/// first the stock is not known here.
pub(super) fn under_stock(job: &Job) -> Option<Finding> {
    let setup = job.setups.first()?;
    let top = Aabb::of_points(corners(&job.stock.bounds(), &setup.to_work())).max.z;
    let finding = setup.operations.first()?.under_stock(top)?;
    Some(finding.under("setup[0].operation[0]"))
}

fn findings(
    job: &Job,
    setups: &[SetupOutcome],
    simulation: &Simulation,
    deviation: &Deviation,
    (measured, notes): (&[Measured], &[Finding]),
    located: &impl Fn(Finding) -> Finding,
) -> Vec<Finding> {
    let mut found: Vec<Finding> = under_stock(job).map(located).into_iter().collect();
    found.extend_from_slice(notes);
    found.extend(prove::findings(job, setups, simulation));
    for (i, s) in setups.iter().enumerate() {
        found.extend(s.planned.findings.iter().cloned().map(located));
        found.extend(s.external.iter().flat_map(|f| f.findings.iter().cloned()));
        let places = LinePlaces::new(&s.file, &s.posted.text);
        let place = |item: u32| places.at(s.lines.get(item as usize).copied().flatten());
        for (f, item) in measured.iter().filter(|m| m.setup == i).flat_map(|m| &m.judged.findings) {
            found.push(Finding { place: place(*item), ..f.clone() });
        }
        found.extend(s.planned.operations.iter().flat_map(|o| o.plan.remarks().iter().cloned()));
        found.extend(simulate::findings(&s.trace, &simulation.effects[i], &job.tools, place));
        if let Some(off) = &simulation.uncertain {
            let effects = (off.uncertainty, &off.effects[i][..]);
            let known = &simulation.effects[i];
            found.extend(uncertain::findings(&s.trace, effects, known, &job.tools, place));
        }
        let fixtures = (&job.setups[i].setup, job.uncertainty);
        found.extend(contacts::fixtures::findings(fixtures, &s.trace, &simulation.meetings[i], place));
        if let Some(machine) = &simulation.machine[i] {
            found.extend(contacts::machine::findings(machine, job.uncertainty, &s.trace, place));
        }
        if let Some(machine) = &job.machine {
            // Of a planned program too: moves on which the tool turns, and those of a template, are not lowered to them.
            let feeds = feeds::not_held(&s.trace, machine);
            for mut f in travel_findings(&s.trace, &s.program, machine).into_iter().chain(feeds) {
                f.place = f.item.take().and_then(place);
                found.push(f);
            }
        }
    }
    // A wrong surface is the doing of the program that cut it: the place is the block. Where nothing cut, it is what wanted
    // the surface.
    for (f, cut, operation) in &deviation.findings {
        let mut f = f.clone();
        f.place = block_of_cut(setups, simulation, *cut).and_then(|(s, item)| {
            let line = setups[s].lines.get(item as usize).copied().flatten();
            line_place(&setups[s].file, &setups[s].posted.text, line)
        });
        if f.place.is_none() {
            f.key = match operation {
                Some(number) => operation_key(job, *number),
                // A fault of a program of others is not one of the job.
                None => setups.iter().all(|s| s.external.is_none()).then(|| "design".to_owned()),
            };
            f = if f.key.is_some() { located(f) } else { f };
        }
        found.push(f);
    }
    for (f, number) in &deviation.unmeasured {
        let mut f = f.clone();
        f.key = operation_key(job, *number);
        found.push(located(f));
    }
    worst_first(&mut found, setups);
    found
}

/// The worst first; equal ones in the order of the programs, what has no line after them.
pub(super) fn worst_first(found: &mut [Finding], setups: &[SetupOutcome]) {
    found.sort_by_key(|f| {
        let of = |place: &Location| {
            let file = setups.iter().position(|s| s.file == place.file).unwrap_or(setups.len());
            (file, place.line)
        };
        let place = f.place.as_ref().filter(|p| p.line > 0).map_or((usize::MAX, u32::MAX), of);
        (std::cmp::Reverse(f.severity), place)
    });
}

/// The programs that are written, then what they were made from.
fn subjects(inputs: Vec<Subject>, setups: &[SetupOutcome]) -> Vec<Subject> {
    let mut subjects: Vec<Subject> = setups
        .iter()
        .filter(|s| s.external.is_none())
        .map(|s| Subject {
            role: "program".to_owned(),
            file: Some(s.file.clone()),
            sha256: sha256(s.posted.text.as_bytes()),
        })
        .collect();
    subjects.extend(inputs);
    subjects
}

/// Simulates a program that is given by itself: cut, compared and judged as a job's.
///
/// # Errors
/// Those of [`run`].
pub fn simulate_given(given: GivenJob, progress: &dyn Progress) -> Result<Outcome> {
    let (name, job, subjects, place) = given.into_parts();
    run_checked(&name, job, (subjects, Vec::new()), &|e| place.locate(e), progress)
}
