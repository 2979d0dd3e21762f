//! Jobs that are run in memory.

use kinecut::base::{Finding, MemoryLoader, Result, Silent};
use kinecut::job::Outcome;

/// Runs a job that reads no file.
pub(crate) fn run(text: &str) -> Result<Outcome> {
    kinecut::job::run("job.toml", text, &MemoryLoader::default(), &Silent)
}

/// Runs a job that reads the program `P.nc`.
pub(crate) fn run_program(text: &str, program: &str) -> Result<Outcome> {
    kinecut::job::run("job.toml", text, &MemoryLoader::default().with("P.nc", program), &Silent)
}

/// The finding by which a job that reads no file is refused.
#[track_caller]
pub(crate) fn refused(text: &str) -> Finding {
    match run(text) {
        Err(error) => *error.0,
        Ok(outcome) => panic!("it is run: {:?}", outcome.verdict.found),
    }
}

/// What was cut off [mm³].
pub(crate) fn removed(outcome: &Outcome) -> f64 {
    outcome.simulation.raw_volume - outcome.simulation.stock.volume()
}
