//! Programs with the time that they take on their machine.

use std::path::Path;

use super::moving::MovingProgram;
use super::sheet::TimeSheet;
use crate::base::{Code, FilesRead, Finding, Location, Progress, Result};
use crate::job::external::given::GivenJob;
use crate::job::posted;
use crate::machine::Machine;
use crate::motion::{ProgramTime, axis_limits, program_time};
use crate::verbs::run::job_text;

/// Programs of one machine with their times; in a job, those of all its setups.
#[derive(Debug)]
pub struct Timed {
    pub(super) name: String,
    pub(super) machine: Machine,
    pub(super) programs: Vec<(MovingProgram, ProgramTime)>,
}

/// The time of a program that others wrote.
///
/// ```
/// use kinecut::base::Silent;
/// use kinecut::job::{GivenFile, ProgramWants, given_alone};
/// use kinecut::machine::{CoordinateCode, Dynamics, Machine};
/// use kinecut::verbs::time::time_of_program;
/// let dynamics = Dynamics { rapid: Some(500.0), acceleration: Some(5000.0), jerk: Some(50_000.0) };
/// let machine = Machine::new(CoordinateCode::parse("2103").unwrap(), [None; 3], dynamics).unwrap();
/// let wants = ProgramWants { machine: Some(machine), ..ProgramWants::default() };
/// let bytes = b"G21 G90 G94 G54\nT1 M6\nG43\nG0 X0 Y0 Z5\nG1 Z-1 F300\nX30\nM2\n";
/// let given = given_alone(GivenFile { name: "slot.ngc", bytes }, &wants, false).unwrap();
/// let sheet = time_of_program(&given, &Silent).unwrap().sheet(10);
/// // 36 mm at 5 mm/s take 7.2 s; the corner and both ends take a little more.
/// assert!(sheet.time > 7.2 && sheet.time < 7.5 && sheet.time_without_jerk_limit < sheet.time);
/// ```
///
/// # Errors
/// `KC0703` for a machine that is missing or does not say how fast its axes are; those of the reader and of the trace, each at
/// its place in the program; `KC0009` when it was cancelled.
pub fn time_of_program(given: &GivenJob, progress: &dyn Progress) -> Result<Timed> {
    let program = MovingProgram::of_given(given)?;
    let name = program.file.clone();
    Timed::new(name, given.job().machine.clone(), vec![program], progress)
}

/// The time of the programs of a job: planned, posted, read back and followed, and not cut. The files that are read are noted
/// in `read`.
///
/// # Errors
/// `KC0703` as [`time_of_program`]; those of the job, its plan and its programs; `KC0009` when it was cancelled.
pub fn time_of_job(job: &Path, read: &FilesRead, progress: &dyn Progress) -> Result<Timed> {
    let (text, loader) = job_text(job, read)?;
    let name = job.display().to_string();
    let (job, setups) = posted(&name, &text, &loader, progress)?;
    let programs = setups.into_iter().map(|setup| MovingProgram::of_setup(&job, setup)).collect();
    Timed::new(name, job.machine, programs, progress)
}

impl Timed {
    fn new(
        name: String,
        machine: Option<Machine>,
        programs: Vec<MovingProgram>,
        progress: &dyn Progress,
    ) -> Result<Timed> {
        let Some(machine) = machine else {
            let missing = Finding::error(Code::MACHINE_AXIS, "there is no machine, and a time needs one")
                .at(Location::whole_file(name))
                .help(format!("give it: --machine FILE, or [machine] in the job, with {DYNAMICS}"));
            return Err(missing.into());
        };
        let moves = programs.iter().map(|p| p.trace.segments.len() as u64).sum();
        progress.stage("time", moves);
        let mut timed = Vec::with_capacity(programs.len());
        for program in programs {
            match program_time(&program.program, &program.trace, &machine, progress)? {
                Some(time) => timed.push((program, time)),
                None => return Err(without_limits(&machine, &program).into()),
            }
        }
        Ok(Timed { name, machine, programs: timed })
    }

    /// The times as an answer, with so many of the slowest blocks.
    pub fn sheet(&self, slowest: usize) -> TimeSheet {
        TimeSheet::of(self, slowest)
    }

    /// The same with graphs of the motion.
    ///
    /// # Errors
    /// `KC0009` when it was cancelled.
    pub fn sheet_with_graphs(&self, slowest: usize, progress: &dyn Progress) -> Result<TimeSheet> {
        let sheet = self.sheet(slowest);
        let graphs = self.graphs(&sheet.slowest, progress)?;
        Ok(TimeSheet { graphs, ..sheet })
    }

    /// Time of all programs [s].
    pub fn total(&self) -> f64 {
        self.programs.iter().map(|(_, time)| time.total()).sum()
    }
}

/// Keys that say how fast an axis is.
const DYNAMICS: &str = "dynamics = { rapid = 30000, acceleration = 5, jerk = 50 } (mm/min, m/s2, m/s3)";

/// The error about a machine that does not say how fast its axes are.
fn without_limits(machine: &Machine, program: &MovingProgram) -> Finding {
    let limits = axis_limits(machine);
    let has_none = |a: &usize| limits[*a].is_none() && machine.joint(LETTERS[*a]).is_some();
    let axes: Vec<String> = (0..LETTERS.len()).filter(has_none).map(|a| LETTERS[a].to_string()).collect();
    let at = |finding: Finding| finding.at(Location::whole_file(program.file.clone()));
    if axes.is_empty() {
        let what =
            "the tool turns, and the positions of the rotary axes are not known: the time is not, either";
        return at(Finding::error(Code::MACHINE_AXIS, what));
    }
    let are = if axes.len() == 1 { "axis" } else { "axes" };
    let what = format!(
        "the machine has no rapid speed or no acceleration for {are} {}: it has no times",
        axes.join(", ")
    );
    let rotary = axes.iter().find(|axis| "ABC".contains(axis.as_str()));
    let own = rotary.map_or_else(String::new, |axis| {
        format!("; rotary axes by themselves: [axis.{axis}] with rapid (rev/min), acceleration (degrees/s2), jerk (degrees/s3)")
    });
    at(Finding::error(Code::MACHINE_AXIS, what).key("machine.dynamics"))
        .help(format!("give it {DYNAMICS}{own}"))
}

/// Letters of the axes of a program.
pub(super) const LETTERS: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
