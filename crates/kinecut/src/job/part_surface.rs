//! The surface of the cut part: of all lines of the stock model, or of those that a picture shows.

use super::check::Job;
use super::setup_outcome::SetupOutcome;
use super::shape::compares;
use super::simulate::{Simulation, surface};
use crate::base::{Progress, Result};
use crate::stock::surface::{CutSurface, SurfaceOptions};

/// Surface of the cut part that a run makes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PartSurface {
    /// Of all lines of the stock model: for meshes, sections, points, and for what the part is compared with.
    #[default]
    Full,
    /// For the picture of the report: of about as many lines as it shows, and the volume is known by the lines alone, all of them. Where
    /// the part is compared with something it is the full surface.
    Picture,
    /// No surface: the volume is known by the lines alone.
    None,
}

/// Lines of a picture, about: twice as many triangles are as many as a page shows quickly.
const LINES: u64 = 300_000;

/// Number of lines of the stock model for each line of a picture, along each direction.
pub(super) fn every(lines: u64) -> u32 {
    let every = (lines as f64 / LINES as f64).sqrt().ceil();
    every.clamp(1.0, f64::from(u32::MAX)) as u32
}

/// A surface with the distance of its lines [mm], where these are not all.
pub(super) struct MadeSurface {
    pub(super) surface: CutSurface,
    pub(super) drawn_step: Option<f64>,
}

/// The surface that a job asks for.
///
/// # Errors
/// `KC0105` when it needs more memory than the job allows; `KC0009` when cancelled.
pub(super) fn part_surface(
    job: &Job,
    setups: &[SetupOutcome],
    simulation: &mut Simulation,
    progress: &dyn Progress,
) -> Result<Option<MadeSurface>> {
    let every = every(simulation.budget.line_count);
    match job.part_surface {
        PartSurface::None => Ok(None),
        PartSurface::Picture if every > 1 && !compares(job, setups) => {
            let options = simulation.budget.surface_options(job, &simulation.stock);
            let step = job.step * f64::from(every);
            let usual = SurfaceOptions::default().tolerance(step);
            let tolerance = Some(options.tolerance(job.step).max(usual));
            let some = simulation.stock.sieved(every, progress);
            let surface = surface(&some, &SurfaceOptions { tolerance, ..options }, progress)?;
            Ok(Some(MadeSurface { surface, drawn_step: Some(step) }))
        }
        PartSurface::Picture | PartSurface::Full => {
            simulation.stock.settle(progress);
            let options = simulation.budget.surface_options(job, &simulation.stock);
            let surface = surface(&simulation.stock, &options, progress)?;
            Ok(Some(MadeSurface { surface, drawn_step: None }))
        }
    }
}
