//! Settings of the simulation that are given beside the job.

use super::check::{Job, step};
use super::part_surface::PartSurface;
use crate::base::Result;
use crate::base::bounded::{MAX_LENGTH, length, positive};

/// Settings of the simulation that replace those of a job.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StockWants {
    /// Distance of the lines of the stock model [mm]; default: that of the job.
    pub step: Option<f64>,
    /// Largest distance of the surface of the cut part from the ends of the lines [mm]; default: that of the job.
    pub mesh_tolerance: Option<f64>,
    /// Largest memory of the run, in MB; default: that of the job.
    pub memory: Option<f64>,
    /// Whether the cut stock is proven against the moves; if not, the job may still say so.
    pub certified: bool,
    /// Surface of the cut part that is wanted.
    pub surface: PartSurface,
}

impl StockWants {
    /// Puts the settings in the place of the job's.
    ///
    /// # Errors
    /// `KC0103` for a step, tolerance or memory out of range.
    pub(super) fn apply(&self, job: &mut Job) -> Result<()> {
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
        job.part_surface = self.surface;
        Ok(())
    }
}
