//! The stock over time, for the 3-D view of the report: a pass of its own, with lines farther apart.

use super::check::Job;
use super::closer::Story;
use super::raw::{drill, raw_stock, take_out};
use super::replay::{Part, parts};
use crate::base::{Progress, Result};
use crate::stock::TriDexel;
use crate::stock::cut::{Clock, Playback, PlayedSurface};

/// Lattice cells of the stock of this pass, about.
const CELLS: f64 = 1e6;
/// Lines along the thinnest side of the stock.
const LEAST_LINES: f64 = 4.0;
/// Length of a tick in steps of the lattice.
const TICK: f64 = 1.5;
/// Most faces; a page of them has at most some 9 MB for it.
const MOST_FACES: usize = 500_000;

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
    let size = job.stock.bounds().size();
    job.step.max((size.x * size.y * size.z / CELLS).cbrt().min(size.min_element() / LEAST_LINES))
}

/// The stock of a job over time, where it is wanted.
pub(super) fn play(story: &Story<'_>, progress: &dyn Progress) -> Result<Option<PlayedStock>> {
    let job = story.job;
    if !job.playback {
        return Ok(None);
    }
    let step = step(job);
    let mut stock: TriDexel = raw_stock(&job.stock, step)?;
    drill(&mut stock, job)?;
    let mut ways = Vec::new();
    let mut first_move = Vec::new();
    for list in story.moves {
        first_move.push(ways.len());
        ways.extend((0..list.moves().len()).map(|i| list.way(i)).collect::<Result<Vec<f64>>>()?);
    }
    let mut playback = Playback::new(&stock, Clock::new(ways, TICK * step));
    for part in parts(story) {
        match part {
            Part::Moves(_, moves) => playback.cut(&mut stock, story.bodies, moves, progress)?,
            Part::Core(core, number) => {
                playback.take_out(&mut stock, |stock| take_out(stock, core, number))?;
            }
        }
    }
    let clock = playback.clock().clone();
    Ok(Some(PlayedStock { surface: playback.surface(&stock, MOST_FACES), clock, first_move }))
}
