//! Does a verdict still hold?

use std::path::Path;

use serde::Serialize;

use super::super::JobText;
use super::super::check::check;
use super::super::parts::parts;
use super::{Judgement, Subject, Verdict};
use crate::base::{Code, DiskLoader, Finding, Loader, Result, Sources};

/// The answer: what was changed, what cannot be said, what is as it was; and what the verdict says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VerdictCheck {
    /// The outcome of the verdict.
    pub outcome: Judgement,
    /// The verdict in a line.
    pub sentence: String,
    /// One finding (`KC0106`) for each subject that is not what it was: the verdict is void.
    pub void: Vec<Finding>,
    /// One finding (`KC0107`) for each subject that cannot be compared, because a file is not there.
    pub unknown: Vec<Finding>,
    /// Roles of the subjects that are unchanged.
    pub unchanged: Vec<String>,
}

impl VerdictCheck {
    /// Whether every subject was compared and is what it was.
    pub fn holds(&self) -> bool {
        self.void.is_empty() && self.unknown.is_empty()
    }

    fn note(&mut self, subject: &Subject, now: Result<Vec<u8>>) {
        let label = label(subject);
        match now {
            Ok(bytes) => match Verdict::check_subject(subject, &bytes) {
                Ok(()) => self.unchanged.push(label),
                Err(error) => self.void.push(*error.0),
            },
            Err(error) => self.unknown.push(unknown(&label, &error.0)),
        }
    }
}

/// Compares every subject of a verdict with the files as they are now: outputs beside the verdict, the job where
/// it was (or at `job`), and the tools, machine, stock, setups and design that it defines.
///
/// # Errors
/// `KC0001` and `KC0106` when the verdict itself cannot be read or was changed.
pub fn verify(verdict: &Path, job: Option<&Path>) -> Result<VerdictCheck> {
    let file = if verdict.is_dir() { verdict.join("verdict.json") } else { verdict.to_owned() };
    let folder = folder_of(&file);
    let beside = DiskLoader::new(folder);
    let verdict = Verdict::from_json(&beside.read_text(&name_of(&file))?)?;
    let mut answer = VerdictCheck {
        outcome: verdict.outcome,
        sentence: verdict.sentence(),
        void: Vec::new(),
        unknown: Vec::new(),
        unchanged: Vec::new(),
    };
    let has_job = verdict.subjects.iter().any(|s| s.role == "job");
    for subject in &verdict.subjects {
        let Some(name) = &subject.file else { continue };
        match subject.role.as_str() {
            "job" => {
                let path = job.map_or_else(|| job_path(folder, name), Path::to_owned);
                let loader = DiskLoader::new(folder_of(&path));
                let bytes = loader.read(&name_of(&path));
                // The parts of the job are compared too, so that the answer names what was changed.
                if let Ok(bytes) = &bytes {
                    job_parts(&verdict, &path, bytes, &loader, &mut answer);
                }
                answer.note(subject, bytes);
            }
            "program" | "output" => answer.note(subject, beside.read(name)),
            // A file named on a command line lies at its own path, not in the verdict's folder.
            "given program" | "given design" => answer.note(subject, here(name)),
            "tools" | "stock" if !has_job => answer.note(subject, here(name)),
            _ => {}
        }
    }
    answer.void.dedup();
    answer.unknown.dedup();
    Ok(answer)
}

/// Compares the parts that a job defines with those of the verdict.
fn job_parts(verdict: &Verdict, path: &Path, bytes: &[u8], loader: &dyn Loader, answer: &mut VerdictCheck) {
    const NOT_PARTS: [&str; 5] = ["job", "program", "output", "given program", "given design"];
    let mut sources = Sources::default();
    let id = sources.add(path.display().to_string(), String::from_utf8_lossy(bytes).into_owned());
    let read = JobText::read(&mut sources, id, loader)
        .and_then(|text| check(&text.file, "job", loader).map(|_| text));
    let now = match read.and_then(|text| parts(&text.file, loader)) {
        Ok(now) => now,
        Err(error) => {
            let missing = error.code() == Code::FILE_NOT_READ;
            let list = if missing { &mut answer.unknown } else { &mut answer.void };
            list.push(if missing { unknown("job", &error.0) } else { *error.0 });
            return;
        }
    };
    for subject in verdict.subjects.iter().filter(|s| !NOT_PARTS.contains(&s.role.as_str())) {
        if now.contains(subject) {
            answer.unchanged.push(label(subject));
        } else {
            let message = format!("the {} was changed after the verdict", label(subject));
            answer.void.push(Finding::error(Code::VERDICT_VOID, message).help("run the job again"));
        }
    }
}

/// A subject that cannot be compared.
fn unknown(label: &str, error: &Finding) -> Finding {
    let mut finding =
        Finding::doubt(Code::VERDICT_UNKNOWN, format!("the {label} cannot be compared: {}", error.message));
    finding.place.clone_from(&error.place);
    finding.help("run the command where the files are, or name the job file with --job")
}

/// The bytes of a file as a command line named it.
fn here(name: &str) -> Result<Vec<u8>> {
    let path = Path::new(name);
    DiskLoader::new(folder_of(path)).read(&name_of(path))
}

/// The job as the run was given it, seen from here or from the verdict's folder.
fn job_path(folder: &Path, name: &str) -> std::path::PathBuf {
    let here = Path::new(name);
    if here.is_file() { here.to_owned() } else { folder.join(name) }
}

fn label(subject: &Subject) -> String {
    subject.file.as_deref().map_or_else(|| subject.role.clone(), |f| format!("{} `{f}`", subject.role))
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn name_of(path: &Path) -> String {
    path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default()
}
