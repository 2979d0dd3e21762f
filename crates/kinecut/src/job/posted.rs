//! A job up to its posted programs: read back and followed on the machine, nothing is cut.

use super::JobText;
use super::check::{Job, check};
use super::inches::error_in_its_units;
use super::plan::plan;
use super::run::{head_line, post_all, stem, still_wanted};
use super::setup_outcome::SetupOutcome;
use crate::base::{Error, Loader, Progress, Result, Sources};

/// Plans and posts a job from its text, and follows its programs; findings of the plan have their places in the job.
///
/// # Errors
/// Those of [`run`](super::run()) before it cuts.
pub(crate) fn posted(
    name: &str,
    text: &str,
    loader: &dyn Loader,
    progress: &dyn Progress,
) -> Result<(Job, Vec<SetupOutcome>)> {
    posted_text(name, text, loader, progress).map_err(|e| error_in_its_units(text, loader, e))
}

fn posted_text(
    name: &str,
    text: &str,
    loader: &dyn Loader,
    progress: &dyn Progress,
) -> Result<(Job, Vec<SetupOutcome>)> {
    let mut sources = Sources::default();
    let id = sources.add(name, text);
    let job_text = JobText::read(&mut sources, id, loader)?;
    let locate = |e: Error| job_text.locate(&sources, e);
    let job = check(&job_text.file, &stem(name), loader).map_err(locate)?;
    progress.stage("plan", 1);
    let planned = plan(&job, progress).map_err(locate)?;
    let mut setups = post_all(&job, &planned, &head_line(&[])).map_err(locate)?;
    still_wanted(progress)?;
    for finding in setups.iter_mut().flat_map(|s| &mut s.planned.findings) {
        *finding = *locate(finding.clone().into()).0;
    }
    Ok((job, setups))
}
