//! Samples of the motion at a control's cycle, in a file.

use std::path::Path;

use serde::Serialize;

use super::in_order::gaps;
use super::sample_rows::{Form, SampleRows};
use super::timed::Timed;
use crate::base::{Code, FilesRead, Finding, Location, Progress, Result};
use crate::job::StreamedFile;
use crate::motion::sample_count;
use crate::page;

/// Most samples of a file: some gigabytes.
const MOST: f64 = 1e7;

/// Samples that were written.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SamplesWritten {
    /// File.
    pub file: String,
    /// Their number.
    pub count: u64,
    /// Time between two of them [s].
    pub cycle: f64,
    /// Moves without samples: their stretch has no law.
    pub moves_left_out: usize,
    /// Their time [s].
    pub time_left_out: f64,
    /// Places at which an axis is somewhere else than the move before left it: what is between could not be followed.
    pub jumps: usize,
    /// Whether accelerations jump somewhere, because jerk is not limited or not on all moves: jerk is then that between the
    /// jumps.
    pub accelerations_jump: bool,
}

impl Timed {
    /// Writes samples of the motion at a cycle [s] to a file, `.csv` or `.json`: whole or not at all. Programs of several
    /// setups follow one another.
    ///
    /// # Errors
    /// `KC0404` for a cycle that is not positive, or so short that there would be more than ten million samples; `KC0003`
    /// to `KC0005` when the file cannot be written or was read in this run, or its name is neither; `KC0009` when it was cancelled.
    pub fn write_samples(
        &self,
        file: &Path,
        cycle: f64,
        read: &FilesRead,
        progress: &dyn Progress,
    ) -> Result<SamplesWritten> {
        let form = form(file)?;
        self.bounded(cycle)?;
        let mut output = StreamedFile::begin(file, read, progress)?;
        let mut rows = SampleRows::new(form, &self.machine, self.programs.len() > 1);
        output.put(&rows.head(cycle))?;
        let sampled = self.in_order(cycle, "samples", progress, &mut |one| {
            output.put(&rows.row(one.sample, one.before, one.number, one.line))
        })?;
        output.put(rows.tail())?;
        output.finish()?;
        Ok(SamplesWritten {
            file: file.display().to_string(),
            count: sampled.count,
            cycle,
            moves_left_out: sampled.left_out,
            time_left_out: sampled.left_out_time,
            jumps: sampled.jumps,
            accelerations_jump: self.accelerations_jump(),
        })
    }

    /// That there are not too many samples.
    fn bounded(&self, cycle: f64) -> Result<()> {
        let count =
            |cycle: f64| self.programs.iter().map(|(_, time)| sample_count(time.total(), cycle)).sum::<f64>();
        // A cycle that is not positive is another error.
        if !(cycle > 0.0) || count(cycle) <= MOST {
            return Ok(());
        }
        let fits = shortest(self.total(), self.programs.len(), MOST);
        Err(Finding::error(Code::PLAN_VALUE, format!("at a cycle of {cycle} s there are too many samples"))
            .value(count(cycle), "samples")
            .bound(MOST, "samples")
            .key("cycle")
            .help(format!("a cycle of {fits} s fits: --cycle {fits}"))
            .into())
    }
}

/// The shortest cycle [s], of two digits, of which programs of this time have so many samples at most.
fn shortest(time: f64, programs: usize, most: f64) -> f64 {
    // Each program has a sample at its end, and one that its last part of a cycle needs.
    let exact = time / (most - 2.0 * programs as f64);
    let digit = 10f64.powf(exact.log10().floor() - 1.0);
    let cycle = (exact / digit).ceil();
    // A decimal power as a quotient has the digits that it is written with.
    if digit < 1.0 { cycle / (1.0 / digit).round() } else { cycle * digit }
}

/// The form that the name of a file tells.
fn form(file: &Path) -> Result<Form> {
    let ending = file.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("csv") => Ok(Form::Csv),
        Some("json") => Ok(Form::Json),
        _ => {
            let name = file.display().to_string();
            Err(Finding::error(Code::OUTPUT_NOT_WRITTEN, format!("`{name}` does not tell its form"))
                .at(Location::whole_file(name))
                .help("samples are written as .csv or .json")
                .into())
        }
    }
}

impl SamplesWritten {
    pub(super) fn words(&self) -> String {
        let each = page::trimmed(self.cycle * 1e3, 6);
        let mut words = vec![format!("{} in {}, one each {each} ms", self.count, self.file)];
        words.extend(gaps(self.moves_left_out, self.time_left_out, self.jumps));
        if self.accelerations_jump {
            words.push("accelerations jump: jerk is that between the jumps".to_owned());
        }
        words.join("; ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_cycle_has_two_digits_and_fits() {
        for (time, cycle) in
            [(36_000.0, 0.0037), (10_500.0, 0.0011), (9_999.0, 0.001), (1e9, 110.0), (2.5e-3, 2.6e-10)]
        {
            let found = shortest(time, 1, 1e7);
            assert!((found / cycle - 1.0).abs() < 1e-12, "{time}: {found}");
            assert!(sample_count(time, found) <= 1e7, "{time}");
        }
    }
}
