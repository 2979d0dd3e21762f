//! Does a verdict still hold?

use std::path::Path;

use serde::Serialize;

use super::parts::parts;
use super::{JobText, Verdict, check::check};
use crate::base::{DiskLoader, Finding, Loader, Result, Sources};

/// The answer: what was changed, and what was not.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct VerdictCheck {
    /// One finding (`KC0106`, or that a file is not there) for each subject that is not what it was; empty: the
    /// verdict holds.
    pub void: Vec<Finding>,
    /// Roles of the subjects that are unchanged.
    pub unchanged: Vec<String>,
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
    let mut answer = VerdictCheck::default();
    for subject in &verdict.subjects {
        let result = match (subject.role.as_str(), &subject.file) {
            ("job", Some(name)) => {
                let path = job.map_or_else(|| job_path(folder, name), Path::to_owned);
                let loader = DiskLoader::new(folder_of(&path));
                let bytes = loader.read(&name_of(&path));
                // The parts of the job are compared too, so that the answer names what was changed.
                if let Ok(bytes) = &bytes {
                    job_parts(&verdict, &path, bytes, &loader, &mut answer);
                } else {
                    let missing = bytes
                        .map_err(|e| (*e.0).cure("name the job file with --job, if it was moved").into());
                    answer.void.extend(missing.err().map(|e: crate::base::Error| *e.0));
                    continue;
                }
                bytes.and_then(|b| Verdict::check_subject(subject, &b))
            }
            ("program" | "output", Some(name)) => {
                beside.read(name).and_then(|b| Verdict::check_subject(subject, &b))
            }
            // What was named on a command line lies where it was, not beside the verdict.
            ("given program", Some(name)) => here(name).and_then(|b| Verdict::check_subject(subject, &b)),
            ("tools", Some(name)) => here(name).and_then(|b| Verdict::check_subject(subject, &b)),
            _ => continue,
        };
        match result {
            Ok(()) => answer.unchanged.push(label(&subject.role, subject.file.as_deref())),
            Err(error) => answer.void.push(*error.0),
        }
    }
    answer.void.dedup();
    Ok(answer)
}

fn job_parts(verdict: &Verdict, path: &Path, bytes: &[u8], loader: &dyn Loader, answer: &mut VerdictCheck) {
    let mut sources = Sources::default();
    let id = sources.add(path.display().to_string(), String::from_utf8_lossy(bytes).into_owned());
    let read = JobText::read(&mut sources, id, loader)
        .and_then(|text| check(&text.file, "job", loader).map(|_| text));
    let now = match read.and_then(|text| parts(&text.file, loader)) {
        Ok(now) => now,
        Err(error) => {
            answer.void.push(*error.0);
            return;
        }
    };
    for subject in verdict
        .subjects
        .iter()
        .filter(|s| !["job", "program", "output", "given program"].contains(&s.role.as_str()))
    {
        let same = now
            .iter()
            .any(|n| n.role == subject.role && n.file == subject.file && n.sha256 == subject.sha256);
        if same {
            answer.unchanged.push(label(&subject.role, subject.file.as_deref()));
        } else {
            let what = label(&subject.role, subject.file.as_deref());
            answer.void.push(
                Finding::error(
                    crate::base::Code::VERDICT_VOID,
                    format!("the {what} was changed after the verdict"),
                )
                .cure("run the job again"),
            );
        }
    }
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

fn label(role: &str, file: Option<&str>) -> String {
    file.map_or_else(|| role.to_owned(), |f| format!("{role} `{f}`"))
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn name_of(path: &Path) -> String {
    path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default()
}
