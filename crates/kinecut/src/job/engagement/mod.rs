//! Engagement of the tools along the programs of a job: a second pass over the stock, with lines farther apart.

mod blocks;
mod course;
mod give;
mod load;
mod tapping;

use super::check::Job;
use super::closer::Story;
use super::raw::{drill, raw_stock, take_out};
use super::replay::{Part, parts};
use crate::base::{Progress, Result};
use crate::stock::TriDexel;
use crate::stock::cut::{MoveEngagement, adjust_volumes, engagements};

pub use blocks::engagement_json;
pub(crate) use blocks::{Block, blocks};
pub(crate) use course::{Chips, Course, course};
pub(crate) use give::deflection_beside;
pub(crate) use load::{Deflection, Loads, force_of};
pub(crate) use tapping::tapped;

/// Moves below which engagement is measured unasked.
const FEW: u64 = 20_000;
/// Lattice cells of the stock of this pass, about.
const CELLS: f64 = 5e5;
/// Lines along the thinnest side of the stock.
const LEAST_LINES: f64 = 2.0;

/// Engagement of the tools along the programs of a job.
#[derive(Clone, Debug, PartialEq)]
pub struct Engagement {
    /// Distance of the lines of this pass [mm].
    pub step: f64,
    /// For each setup the engagement of each segment of its trace.
    pub moves: Vec<Vec<MoveEngagement>>,
    /// Volume that the moves have taken from the stock model, loose cores left out [mm^3]: the volumes of the moves are adjusted to it.
    pub taken: f64,
    /// Sum of the volumes of the moves as this pass tells them [mm^3].
    pub told: f64,
}

/// Whether the engagement of this many moves is measured.
pub(super) fn is_wanted(job: &Job, moves: u64) -> bool {
    job.engagement.unwrap_or(moves < FEW)
}

/// Distance of the lines of the pass [mm]: that of the stock model, or more where that would be too many.
pub(super) fn step(job: &Job) -> f64 {
    let size = job.stock.bounds().size();
    job.step.max((size.x * size.y * size.z / CELLS).cbrt().min(size.min_element() / LEAST_LINES))
}

/// Measures the engagement of a job's moves where it is wanted.
///
/// `gone`: volume that is missing from the stock model, loose cores included [mm^3].
pub(super) fn measure(
    story: &Story<'_>,
    gone: impl FnOnce() -> f64,
    progress: &dyn Progress,
) -> Result<Option<Engagement>> {
    let job = story.job;
    if !is_wanted(job, story.moves.iter().map(|list| list.moves().len() as u64).sum()) {
        return Ok(None);
    }
    let step = step(job);
    let mut stock: TriDexel = raw_stock(&job.stock, step)?;
    drill(&mut stock, job)?;
    let mut all = Engagement { step, moves: Vec::new(), taken: gone(), told: 0.0 };
    all.moves = story.moves.iter().map(|list| Vec::with_capacity(list.moves().len())).collect();
    for part in parts(story) {
        match part {
            Part::Moves(setup, moves) => {
                all.moves[setup].extend(engagements(&mut stock, story.bodies, moves, progress)?);
            }
            Part::Core(core, number) => {
                let before = stock.volume();
                take_out(&mut stock, core, number)?;
                all.taken -= before - stock.volume();
            }
        }
    }
    all.told = all.moves.iter().flatten().map(MoveEngagement::removed).sum();
    adjust_volumes(all.moves.iter_mut().flatten(), all.taken);
    Ok(Some(all))
}
