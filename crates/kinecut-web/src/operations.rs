//! The operations of a job with the lines of its programs that were written for them, as the programs themselves tell.

use kinecut::base::{Code, Error, Finding, Loader, Location, Result, Sources};
use kinecut::job::{Job, JobText, SetupOutcome};
use serde::Serialize;

/// Lines of the programs, one after another, that were written for one operation.
#[derive(Serialize)]
pub(crate) struct Run {
    /// Key of the operation in the list of its setup.
    key: String,
    /// Place of the operation in the text of the job: holes by their size become several operations, so that the numbers in keys are
    /// not those of the text.
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<Location>,
    title: String,
    tool: u32,
    tool_name: String,
    /// First line among those of all programs, and the line after the last.
    from: usize,
    to: usize,
}

/// A tool of the job.
#[derive(Serialize)]
pub(crate) struct ToolShown<'a> {
    number: u32,
    name: &'a str,
}

/// The text of a job that was planned, for the places of its keys.
pub(crate) struct TextPlaces {
    sources: Sources,
    text: JobText,
}

impl TextPlaces {
    /// Reads the text.
    ///
    /// # Errors
    /// Those of reading a job.
    pub(crate) fn read(name: &str, text: &str, loader: &dyn Loader) -> Result<TextPlaces> {
        let mut sources = Sources::default();
        let id = sources.add(name, text);
        let text = JobText::read(&mut sources, id, loader)?;
        Ok(TextPlaces { sources, text })
    }

    fn of(&self, key: &str) -> Option<Location> {
        let asked: Error = Finding::note(Code::JOB_VALUE, "").key(key).into();
        self.text.locate(&self.sources, asked).0.place
    }
}

/// The tools of a job.
pub(crate) fn tools(job: &Job) -> Vec<ToolShown<'_>> {
    job.tools.iter().map(|tool| ToolShown { number: tool.number.0, name: &tool.name }).collect()
}

/// The runs of lines of all operations, in the order of the lines. Programs that others wrote have none.
pub(crate) fn runs(job: &Job, setups: &[SetupOutcome], places: Option<&TextPlaces>) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let (mut first_line, mut first_number) = (0, 0);
    for (s, done) in setups.iter().enumerate() {
        let mut last = None;
        for (line, item) in done.posted.lines.iter().enumerate() {
            let origin = item.map(|item| done.planned.program.origin(item as usize));
            let Some(number) = origin.and_then(|origin| origin.operation) else { continue };
            let to = first_line + line + 1;
            match runs.last_mut() {
                // Lines between two of an operation are of it too.
                Some(run) if last == Some(number) => run.to = to,
                _ => runs.extend(run(job, (s, first_number), number, to - 1, places)),
            }
            last = Some(number);
        }
        first_line += done.posted.text.lines().count();
        first_number += job.setups.get(s).map_or(0, |setup| setup.operations.len() as u32);
    }
    runs
}

/// The run of an operation that has one line as yet; `first` is the number of the first operation of its setup.
fn run(
    job: &Job,
    (setup, first): (usize, u32),
    number: u32,
    line: usize,
    places: Option<&TextPlaces>,
) -> Option<Run> {
    let operation = job.operation(number)?;
    let tool = &operation.milling().tool;
    let key = format!("setup[{setup}].operation[{}]", number.checked_sub(first)?);
    Some(Run {
        place: places.and_then(|places| places.of(&key)),
        key,
        title: operation.name(),
        tool: tool.number.0,
        tool_name: tool.name.clone(),
        from: line,
        to: line + 1,
    })
}
