//! The verbs `kinecut run` and `kinecut simulate`: a job, or a program that others wrote, from its text to the files that
//! prove it.

use std::path::Path;

use rayon::prelude::*;
use serde::Serialize;

use super::Answer;
use crate::base::{Code, DiskLoader, FilesRead, Finding, Loader, Location, Progress, Result};
use crate::geom::{Mesh, write_3mf, write_glb, write_ply, write_stl};
use crate::job::{
    self, InspectWants, Inspection, Outcome, Outputs, PartSurface, RunWants, StockWants, Verdict,
    still_wanted,
};
use crate::page::Section;

/// A form in which the cut part is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshForm {
    /// `part.stl`, binary.
    Stl,
    /// `part.glb`, for viewers.
    Glb,
    /// `part.ply`, binary; each vertex once.
    Ply,
    /// `part.3mf`, for printers and CAD.
    ThreeMf,
}

impl MeshForm {
    /// Name of the file and its bytes.
    fn file(self, part: &Mesh) -> Result<(&'static str, Vec<u8>)> {
        Ok(match self {
            MeshForm::Stl => ("part.stl", write_stl(part)),
            MeshForm::Glb => ("part.glb", write_glb(part, None)?),
            MeshForm::Ply => ("part.ply", write_ply(part)),
            MeshForm::ThreeMf => ("part.3mf", write_3mf(part)?),
        })
    }
}

/// Files that are written beside the programs, the plan and the verdict.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultFiles {
    /// Forms of the cut part; default STL and GLB.
    pub meshes: Vec<MeshForm>,
    /// `report.html`; default yes.
    pub report: bool,
    /// In the 3-D view of the report material goes as the program runs; default yes.
    pub playback: bool,
    /// Sections, points and distances of the part: `inspection.json`, a picture for each section, a section of the report.
    pub inspect: InspectWants,
}

impl Default for ResultFiles {
    fn default() -> ResultFiles {
        ResultFiles {
            meshes: vec![MeshForm::Stl, MeshForm::Glb],
            report: true,
            playback: true,
            inspect: InspectWants::default(),
        }
    }
}

impl ResultFiles {
    /// The settings of a simulation for these files: no surface is made that none of them shows.
    fn settings(&self, wants: &StockWants) -> StockWants {
        let surface = match wants.surface {
            PartSurface::Full if !self.meshes.is_empty() || !self.inspect.is_empty() => PartSurface::Full,
            PartSurface::Full if self.report => PartSurface::Picture,
            PartSurface::Full => PartSurface::None,
            given => given,
        };
        StockWants { surface, playback: self.report && self.playback, ..wants.clone() }
    }
}

/// A job that was planned or read, simulated and judged.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct Done {
    /// The verdict, which is about all files.
    pub verdict: Verdict,
    /// The report without its pictures.
    #[serde(skip)]
    pub sections: Vec<Section>,
    /// The programs, `plan.json`, `engagement.json` where it was measured, the [`ResultFiles`] and, last, `verdict.json`.
    #[serde(skip)]
    pub outputs: Outputs,
}

impl Answer for Done {
    fn sections(&self) -> Vec<Section> {
        self.sections.clone()
    }

    fn findings(&self) -> Vec<&Finding> {
        self.verdict.found.iter().collect()
    }

    fn is_no(&self) -> bool {
        !self.verdict.is_safe()
    }

    fn files(answers: &[&Done]) -> Result<Outputs> {
        Ok(answers.first().map(|done| done.outputs.clone()).unwrap_or_default())
    }
}

/// Runs the job file `job`. The files that it reads are noted in `read`.
///
/// # Errors
/// One finding that says what is wrong with the job or a file it names.
pub fn run(
    job: &Path,
    wants: &RunWants,
    files: &ResultFiles,
    read: &FilesRead,
    progress: &dyn Progress,
) -> Result<Done> {
    let (text, loader) = job_text(job, read)?;
    run_text((&job.display().to_string(), &text), wants, files, &loader, progress)
}

/// As [`run`], from the name and the text of a job; files that it names come through `loader`.
///
/// # Errors
/// As [`run`].
pub fn run_text(
    (name, text): (&str, &str),
    wants: &RunWants,
    files: &ResultFiles,
    loader: &dyn Loader,
    progress: &dyn Progress,
) -> Result<Done> {
    let wants = RunWants { stock: files.settings(&wants.stock), ..wants.clone() };
    done(job::run_with(name, text, &wants, loader, progress)?, files, progress)
}

/// As [`run`], for a job with programs of others in all its setups: nothing is planned or posted.
///
/// # Errors
/// As [`run`]; `KC0102` when a setup has operations instead.
pub fn simulate_job(
    job: &Path,
    wants: &StockWants,
    files: &ResultFiles,
    read: &FilesRead,
    progress: &dyn Progress,
) -> Result<Done> {
    let outcome =
        outcome_of(job, &RunWants { compare: false, stock: files.settings(wants) }, read, progress)?;
    if let Some(planned) = outcome.setups.iter().position(|s| s.external.is_none()) {
        return Err(Finding::error(Code::JOB_SHAPE, "this job plans its program itself")
            .at(Location::whole_file(job.display().to_string()))
            .key(format!("setup[{planned}]"))
            .help("run it: kinecut run; or name the program to simulate: kinecut simulate O1234.nc --job job.toml")
            .into());
    }
    done(outcome, files, progress)
}

/// Simulates a program that others wrote, given by itself.
///
/// # Errors
/// As [`run`].
pub fn simulate_given(
    mut given: job::GivenJob,
    files: &ResultFiles,
    progress: &dyn Progress,
) -> Result<Done> {
    given.simulated(&files.settings(&StockWants::default()))?;
    done(job::simulate_given(given, progress)?, files, progress)
}

fn outcome_of(job: &Path, wants: &RunWants, read: &FilesRead, progress: &dyn Progress) -> Result<Outcome> {
    let (text, loader) = job_text(job, read)?;
    job::run_with(&job.display().to_string(), &text, wants, &loader, progress)
}

/// The text of a job file, and a loader for what it names.
pub(super) fn job_text(job: &Path, read: &FilesRead) -> Result<(String, DiskLoader)> {
    let folder = job.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let loader = DiskLoader::new(folder).noting(read);
    let file = job.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let text = loader.read_text(&file).map_err(|mut e| {
        e.0.place = Some(Location::whole_file(job.display().to_string()));
        e
    })?;
    Ok((text, loader))
}

fn done(outcome: Outcome, files: &ResultFiles, progress: &dyn Progress) -> Result<Done> {
    progress.stage("report", 1);
    let mut report = match files.report {
        true => job::report::of_job(&outcome),
        false => job::report::of_job_in_words(&outcome),
    };
    let inspection = Inspection::of(&outcome, &files.inspect)?;
    let inspected: Vec<Section> = inspection.iter().map(Inspection::shown).collect();
    report.sections.extend_from_slice(&inspected);
    still_wanted(progress)?;
    let mut outputs = Outputs::default();
    for setup in outcome.setups.iter().filter(|s| s.external.is_none()) {
        outputs.add(&setup.file, setup.posted.text.as_bytes());
    }
    // Each file by itself: they need nothing of each other.
    let meshes = || files.meshes.par_iter().map(|form| form.file(&outcome.part)).collect::<Result<Vec<_>>>();
    let page = || files.report.then(|| job::report::html(&report));
    let ((plan, page), meshes) = rayon::join(|| (job::plan_json(&outcome), page()), meshes);
    still_wanted(progress)?;
    outputs.add("plan.json", plan);
    if let Some(engagement) = job::engagement_json(&outcome) {
        outputs.add("engagement.json", engagement);
    }
    for (name, bytes) in meshes? {
        outputs.add(name, bytes);
    }
    if let Some(inspection) = &inspection {
        outputs.add("inspection.json", inspection.to_json());
        for (name, picture) in inspection.pictures() {
            outputs.add(name, picture);
        }
    }
    if let Some(page) = page {
        outputs.add("report.html", page);
    }
    // The report tells the verdict, and the verdict is about the report: it has the last word.
    let verdict = outcome.verdict.with_outputs(outputs.files());
    outputs.seal("verdict.json", verdict.to_json());
    let mut sections = job::report::sections(&report);
    // Before the reminder that ends every run.
    let last = sections.len().saturating_sub(1);
    sections.splice(last..last, inspected);
    Ok(Done { verdict, sections, outputs })
}
