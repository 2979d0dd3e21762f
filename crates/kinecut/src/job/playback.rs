//! The stock over time, for the 3-D view of the report: a pass of its own, with lines farther apart.

use glam::DVec3;

use super::check::Job;
use super::closer::Story;
use super::raw::{drill, raw_stock, take_out};
use super::replay::{Part, parts};
use crate::base::{Progress, Result};
use crate::stock::TriDexel;
use crate::stock::cut::{Clock, Playback, PlayedSurface};

/// Lattice cells of the stock of this pass, about.
const CELLS: f64 = 1e6;
/// Faces of the raw stock at most: of a large sheet they alone would be more than a page can have.
const RAW_FACES: f64 = 3e5;
/// Length of a tick in steps of the lattice.
const TICK: f64 = 1.5;
/// Most faces over time: of those some tenth is there at a moment, and a page has some 5 MB of them.
const MOST_FACES: usize = 1_000_000;
/// Most ticks that may become one to keep to that; beyond it the points are taken farther apart.
const MOST_SHARED: u16 = 4;
/// Step of a further pass as a multiple of that before.
const COARSER: f64 = 1.4;
/// Passes after which ticks become as long as they have to.
const MOST_PASSES: usize = 3;

/// The stock over time.
#[derive(Clone, Debug, PartialEq)]
pub struct PlayedStock {
    /// Its surface.
    pub surface: PlayedSurface,
    /// The clock of all moves of all setups.
    pub clock: Clock,
    /// For each setup the number of its first move.
    pub first_move: Vec<usize>,
}

/// Distance of the lines of the pass [mm]: that of the stock model, or more where that would be too many.
pub(super) fn step(job: &Job) -> f64 {
    job.step.max(step_for(job.stock.bounds().size()))
}

fn step_for(size: DVec3) -> f64 {
    let usual = (size.x * size.y * size.z / CELLS).cbrt();
    let area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
    usual.max((area / RAW_FACES).sqrt())
}

/// The stock of a job over time, where it is wanted.
pub(super) fn play(story: &Story<'_>, progress: &dyn Progress) -> Result<Option<PlayedStock>> {
    let job = story.job;
    if !job.playback {
        return Ok(None);
    }
    let mut ways = Vec::new();
    let mut first_move = Vec::new();
    for list in story.moves {
        first_move.push(ways.len());
        ways.extend((0..list.moves().len()).map(|i| list.way(i)).collect::<Result<Vec<f64>>>()?);
    }
    let mut step = step(job);
    for _ in 0..MOST_PASSES {
        let (surface, clock) = pass(story, &ways, step, progress)?;
        if clock.ticks().div_ceil(surface.ticks) <= MOST_SHARED {
            return Ok(Some(PlayedStock { surface, clock, first_move }));
        }
        step *= COARSER;
    }
    let (surface, clock) = pass(story, &ways, step, progress)?;
    Ok(Some(PlayedStock { surface, clock, first_move }))
}

/// The surface over time with points at a distance [mm].
fn pass(
    story: &Story<'_>,
    ways: &[f64],
    step: f64,
    progress: &dyn Progress,
) -> Result<(PlayedSurface, Clock)> {
    let mut stock: TriDexel = raw_stock(&story.job.stock, step)?;
    drill(&mut stock, story.job)?;
    let mut playback = Playback::new(&stock, Clock::new(ways.iter().copied(), TICK * step));
    for part in parts(story) {
        match part {
            Part::Moves(_, moves) => playback.cut(&mut stock, story.bodies, moves, progress)?,
            Part::Core(core, number) => {
                playback.take_out(&mut stock, |stock| take_out(stock, core, number))?;
            }
        }
    }
    let clock = playback.clock().clone();
    Ok((playback.surface(&stock, MOST_FACES), clock))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_has_a_million_points_and_a_large_sheet_no_more_faces_than_a_page_can_have() {
        let block = step_for(DVec3::new(200.0, 200.0, 40.0));
        assert!((block - 1.6f64.cbrt()).abs() < 1e-12);
        let sheet = step_for(DVec3::new(2000.0, 1000.0, 3.0));
        assert!((2.0 * (2e6 + 9e3) / sheet.powi(2) / 3e5 - 1.0).abs() < 1e-9, "{sheet}");
    }
}
