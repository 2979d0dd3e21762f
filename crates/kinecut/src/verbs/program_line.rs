//! The move of a line of a job's program: the program is posted or read, and followed on the job's machine.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::{Code, FileKind, Finding, Loader, Result, Silent, Sources};
use crate::job::following::trace_options;
use crate::job::{JobText, check, plan};
use crate::nc;
use crate::tool::{Contour, Tool};
use crate::trace::{Segment, trace};

/// A line of a job's program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProgramLineTable {
    /// The job file: machine, control, tools, set-ups.
    #[schemars(example = &"job.toml")]
    pub job: String,
    /// A program of this job's control; default: the one that the job posts.
    #[serde(default)]
    pub program: Option<String>,
    /// Number of the set-up, from 1; default 1.
    #[serde(default)]
    pub setup: Option<u32>,
    /// Line of the program, from 1. Where it makes several moves, each has its own envelope.
    #[schemars(example = 12)]
    pub line: u32,
}

/// A line and its moves, at least one.
pub(crate) struct ProgramLine {
    /// Name of the program.
    pub(crate) program: String,
    /// The block.
    pub(crate) block: String,
    /// The moves in order [part coordinates].
    pub(crate) segments: Vec<Segment>,
    tools: Vec<Tool>,
}

impl ProgramLine {
    /// Name and contour of the tool of a move, if the job has it.
    pub(crate) fn tool(&self, segment: &Segment) -> Result<Option<(String, Contour)>> {
        match segment.tool.and_then(|n| self.tools.iter().find(|tool| tool.number == n)) {
            Some(tool) => Ok(Some((format!("T{}", tool.number.0), Contour::of_tool(tool)?))),
            None => Ok(None),
        }
    }
}

/// The moves of a line; what is wrong with the choice has the code `wrong`.
///
/// # Errors
/// `wrong` for a set-up that is not there and for a line that moves nothing; those of the job, its plan, its program and of
/// following it.
pub(crate) fn program_line(
    wants: &ProgramLineTable,
    wrong: Code,
    loader: &dyn Loader,
) -> Result<ProgramLine> {
    let text = loader.read_text(&wants.job).map_err(|e| e.under("job"))?;
    let mut sources = Sources::default();
    let id = sources.add(wants.job.as_str(), text);
    let folder = Folder { of: Path::new(&wants.job).parent().unwrap_or(Path::new("")), loader };
    let job_text = JobText::read(&mut sources, id, &folder)?;
    let locate = |e| job_text.locate(&sources, e);
    let job = check(&job_text.file, "MOVES", &folder).map_err(locate)?;
    let planned = plan(&job, &Silent).map_err(locate)?;
    let setup = wants.setup.unwrap_or(1);
    let Some(planned) = planned.into_iter().nth((setup as usize).wrapping_sub(1)) else {
        return Err(Finding::error(wrong, "the job has no such set-up")
            .value(f64::from(setup), "")
            .bound(job.setups.len() as f64, "")
            .key("setup")
            .into());
    };
    let (name, text) = match &wants.program {
        Some(name) => {
            (name.clone(), loader.read_text_as(name, FileKind::Program).map_err(|e| e.under("program"))?)
        }
        None => {
            let mut post = job.post.clone();
            post.header = vec![job.title.clone()];
            let name = format!("{}.{}", post.program_name, post.control.extension());
            (name, nc::write(&planned.program, &job.tools, &post)?.text.to_string())
        }
    };
    let mut sources = Sources::default();
    let program = nc::read(&mut sources, &name, &text, job.post.control, &planned.program.setups)?.program;
    let options = trace_options(&job, &planned);
    let followed = trace(&program, &options)?;
    let line_of = |s: &Segment| program.origin(s.item as usize).span.map(|span| sources.line(span));
    let block = text.lines().nth((wants.line as usize).wrapping_sub(1)).unwrap_or("").trim().to_owned();
    let nearest = followed.segments.iter().filter_map(line_of).min_by_key(|l| l.abs_diff(wants.line));
    let on_line = |s: &Segment| !s.alternative && line_of(s) == Some(wants.line);
    let segments: Vec<Segment> = followed.segments.iter().filter(|s| on_line(s)).cloned().collect();
    if segments.is_empty() {
        let help = nearest.map_or("the program moves nothing".to_owned(), |l| {
            format!("the nearest line that moves the tool is {l}")
        });
        let what = format!("line {} of {name} moves no tool: {block}", wants.line);
        return Err(Finding::error(wrong, what).key("line").help(help).into());
    }
    Ok(ProgramLine { program: name, block, segments, tools: job.tools.clone() })
}

/// Files as the job names them: from its own folder.
struct Folder<'a> {
    of: &'a Path,
    loader: &'a dyn Loader,
}

impl Loader for Folder<'_> {
    fn read_as(&self, name: &str, kind: FileKind) -> Result<Vec<u8>> {
        self.loader.read_as(&self.of.join(name).to_string_lossy(), kind)
    }
}
