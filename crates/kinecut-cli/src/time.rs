//! The verb `time`.

use std::path::PathBuf;

use kinecut::base::Error;
use kinecut::verbs::time::{time_of_job, time_of_program};

use crate::answers::{To, answer};
use crate::files;
use crate::printing::Printing;
use crate::program::{ProgramOf, RunBy, is_job};
use crate::progress::Bar;

#[derive(Debug, clap::Args)]
#[command(mut_arg("program", |arg| arg.help("The program, or a job file (.toml)")))]
#[command(after_help = "Examples:
  kinecut time job.toml              the programs of a job, as run posts them
  kinecut time O1234.nc --control fanuc --machine mill.toml --slowest 20
  kinecut time O1234.nc --job job.toml --samples motion.csv --cycle 0.002
Nothing is cut. The machine says how fast its axes are: rapid, acceleration and jerk in `dynamics`,
rotary axes in [axis.C].")]
pub(crate) struct Time {
    #[command(flatten)]
    of: ProgramOf,
    #[command(flatten)]
    by: RunBy,
    /// Folder for time.html, made if it is not there: the times with graphs of the motion
    #[arg(long)]
    out: Option<PathBuf>,
    /// Number of blocks in the table of those that lose most time, and of corners in that of those smoothed most (ten at most)
    #[arg(long, value_name = "N", default_value_t = 10)]
    slowest: usize,
    /// File for samples of the motion, .csv or .json: time, line, and position, velocity, acceleration and jerk of each axis
    #[arg(long, value_name = "FILE")]
    samples: Option<PathBuf>,
    /// Time between two samples, s
    #[arg(long, value_name = "SECONDS", default_value_t = 0.001, requires = "samples")]
    cycle: f64,
}

impl Time {
    /// The time of a program of others, or of those of a job.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let bar = Bar::new();
        let timed = if is_job(&self.of.program) {
            time_of_job(&self.of.program, files::read(), &bar)?
        } else {
            time_of_program(&self.of.given(self.by.control.as_ref(), None, false, None)?, &bar)?
        };
        let mut sheet = match self.out {
            Some(_) => timed.sheet_with_graphs(self.slowest, &bar)?,
            None => timed.sheet(self.slowest),
        };
        if let Some(file) = &self.samples {
            sheet.samples = Some(timed.write_samples(file, self.cycle, files::read(), &bar)?);
        }
        drop(bar);
        answer(args, To { out: self.out.as_deref(), ..To::default() }, sheet)
    }
}
