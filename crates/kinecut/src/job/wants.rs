//! Settings of the simulation that are given beside the job.

use super::check::{Design, Job, Uncertainty, step};
use super::part_surface::PartSurface;
use super::{Subject, sha256};
use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{MemoryLoader, Result};
use crate::geom::load_mesh;

/// Settings of the simulation that replace those of a job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StockWants {
    /// Distance of the lines of the stock model [mm]; default: that of the job.
    pub step: Option<f64>,
    /// Largest distance of the surface of the cut part from the ends of the lines [mm]; default: that of the job.
    pub mesh_tolerance: Option<f64>,
    /// Largest memory of the run, in MB; default: that of the job.
    pub memory: Option<f64>,
    /// Whether the cut stock is proven against the moves; if not, the job may still say so.
    pub certified: bool,
    /// Whether the engagement of the tools is measured; default: as the job says.
    pub engagement: Option<bool>,
    /// Distances by which a person may be off; default: as the job says.
    pub uncertainty: Option<Uncertainty>,
    /// Whether the stock over time is wanted, for the report; default no.
    pub playback: bool,
    /// Surface of the cut part that is wanted.
    pub surface: PartSurface,
    /// The wanted part; default: that of the job.
    pub design: Option<DesignWants>,
}

/// A wanted part, in the coordinates of the part: of a program by itself those of its work offset.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignWants {
    /// Name of its file.
    pub name: String,
    /// The file: a closed mesh.
    pub bytes: Vec<u8>,
    /// Largest allowed distance of the cut surface from it [mm]; default: that of the job, then 0.1.
    pub tolerance: Option<f64>,
}

/// Largest allowed distance from a design, if nothing says it [mm].
const TOLERANCE: f64 = 0.1;

impl DesignWants {
    fn apply(&self, job: &mut Job) -> Result<Subject> {
        let loader = MemoryLoader::default().with(&self.name, self.bytes.clone());
        let mesh = load_mesh(&self.name, &loader)?;
        let of_job = job.design.as_ref().map_or(TOLERANCE, |design| design.tolerance);
        let tolerance = length("--design-tolerance", self.tolerance.unwrap_or(of_job), 1e-6, 100.0)?;
        job.design = Some(Design::new(mesh, tolerance));
        Ok(Subject {
            role: "given design".to_owned(),
            file: Some(self.name.clone()),
            sha256: sha256(&self.bytes),
        })
    }
}

impl StockWants {
    /// Puts the settings in the place of the job's, and gives the further subject of its verdict.
    ///
    /// # Errors
    /// `KC0103` for a step, tolerance or memory out of range; those of a mesh as design.
    pub(super) fn apply(&self, job: &mut Job) -> Result<Option<Subject>> {
        if let Some(step) = self.step {
            job.step = length("--step", step, 1e-4, MAX_LENGTH)?;
            job.default_step = false;
        }
        if let Some(memory) = self.memory {
            job.memory = (positive("--memory", memory, 1e6, "MB")? * 1e6) as u64;
        }
        job.surface = match self.mesh_tolerance {
            Some(tolerance) => step::surface("--mesh-tolerance", Some(tolerance), job.step)?,
            None => step::surface("simulate.mesh_tolerance", job.surface.tolerance, job.step)?,
        };
        job.certified |= self.certified;
        job.engagement = self.engagement.or(job.engagement);
        if let Some(off) = self.uncertainty {
            job.uncertainty = Some(off.checked("--uncertainty")?).filter(Uncertainty::is_any);
        }
        job.playback = self.playback;
        job.part_surface = self.surface;
        self.design.as_ref().map(|design| design.apply(job)).transpose()
    }
}
