//! The verbs about machines: `machine`, `fk`, `ik`, `reach`.

use std::path::{Path, PathBuf};

use kinecut::base::{Code, Error, Finding, Silent};
use kinecut::job::machine::{LoadOptions, Loaded, load};
use kinecut::machine::Machine as Loadable;
use kinecut::verbs::fk::forward;
use kinecut::verbs::ik::{self, InverseWants, PathWants, StraightWants, SweepWants};
use kinecut::verbs::machine::{KnownMachines, MachineWants};
use kinecut::verbs::poses::{AxisValues, PoseTexts, PoseWords};
use kinecut::verbs::reach::reach;

use crate::answers::{Data, To, answer, answers};
use crate::files;
use crate::numbers::triple;
use crate::printing::Printing;

/// Facts of a machine that its LinuxCNC configuration does not tell.
#[derive(Debug, Default, clap::Args)]
struct Configuration {
    /// HAL file beside those that a LinuxCNC INI file names; may be given again
    #[arg(long, value_name = "FILE")]
    hal: Vec<String>,
    /// Coordinate code, for a LinuxCNC configuration that does not tell it
    #[arg(long, value_name = "CODE")]
    code: Option<String>,
}

impl Configuration {
    /// The machine of a name.
    fn load(&self, name: &str) -> Result<Loaded, Error> {
        let (loader, file) = files::beside(Path::new(name));
        load(&file, name, &LoadOptions { hal: self.hal.clone(), code: self.code.clone() }, &loader)
    }
}

/// The machine of a name alone.
pub(crate) fn of_name(name: &str) -> Result<Loadable, Error> {
    Configuration::default().load(name).map(|l| l.machine)
}

#[derive(Debug, clap::Args)]
struct MachineName {
    /// A machine file (TOML), an INI file of LinuxCNC, or a machine that kinecut knows
    #[arg(value_name = "MACHINE")]
    name: String,
    #[command(flatten)]
    configuration: Configuration,
}

impl MachineName {
    fn load(&self) -> Result<Loadable, Error> {
        self.configuration.load(&self.name).map(|l| l.machine)
    }
}

#[derive(Debug, clap::Args)]
pub(crate) struct Machine {
    /// A machine file (TOML), an INI file of LinuxCNC, or a machine that kinecut knows; without it: the known machines
    #[arg(value_name = "MACHINE")]
    name: Option<String>,
    #[command(flatten)]
    configuration: Configuration,
    /// Print the machine as a machine file
    #[arg(long, conflicts_with = "json")]
    toml: bool,
    /// Draw the machine, to scale, into this SVG file: the bodies that its file gives, or the usual ones
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// The machine with its axes at these positions: "A-45 C30": tip and direction of the tool, motions of its links; drawn
    /// so. Usual bodies turn about their own middles
    #[arg(long, value_name = "WORDS")]
    at: Option<String>,
    /// With --json: the bodies with their faces, for a program that draws them itself
    #[arg(long)]
    bodies: bool,
    /// A layout as a machine, with usual bodies: its code
    #[arg(long, value_name = "CODE", conflicts_with = "name")]
    layout: Option<String>,
    /// With --layout: strokes of X, Y, Z, mm: 600,500,500
    #[arg(long, value_name = "X,Y,Z", value_parser = triple, requires = "layout")]
    stroke: Option<[f64; 3]>,
    /// Stand of the spindle: vertical, horizontal
    #[arg(long)]
    spindle: Option<String>,
    #[command(flatten)]
    tool: ToolLength,
}

impl Machine {
    /// Shows a machine, or lists those that are known.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let wants = MachineWants {
            at: self.at.clone(),
            bodies: self.bodies,
            svg: self.svg.is_some(),
            spindle: self.spindle.clone(),
            stroke: self.stroke,
            length: self.tool.given()?,
        };
        let loaded = match (&self.name, &self.layout) {
            (None, None) => {
                self.asks_nothing()?;
                return answer(args, To::default(), KnownMachines::all());
            }
            (Some(_), _) if self.stroke.is_some() => {
                let what = "strokes are those of a layout, and a machine has its own";
                let finding = Finding::error(Code::JOB_SHAPE, what).key("--stroke");
                return Err(finding
                    .help("leave out --stroke, or give --layout CODE in place of the machine")
                    .into());
            }
            (Some(name), _) => self.configuration.load(name)?,
            (None, Some(code)) => Loaded { machine: wants.layout(code)?, import: None },
        };
        let to = To { svg: self.svg.as_deref(), ..To::default() };
        if self.toml {
            let file = wants.file(&loaded.machine, self.layout.is_some())?;
            return answer(args, To { data: Data::Alone, ..to }, file);
        }
        answer(args, to, wants.answer(loaded)?)
    }
}

impl Machine {
    /// The list of known machines is asked for without more.
    fn asks_nothing(&self) -> Result<(), Error> {
        let given = [
            ("--at", self.at.is_some()),
            ("--svg", self.svg.is_some()),
            ("--toml", self.toml),
            ("--bodies", self.bodies),
            ("--spindle", self.spindle.is_some()),
            ("--hal", !self.configuration.hal.is_empty()),
            ("--code", self.configuration.code.is_some()),
        ];
        let Some((key, _)) = given.into_iter().find(|(_, given)| *given) else { return Ok(()) };
        let finding =
            Finding::error(Code::JOB_SHAPE, format!("{key} is about a machine, and no machine is named"));
        Err(finding.help("name it: kinecut machine trt_xyzac, or --layout CODE").key(key).into())
    }
}

/// Words of axes.
fn axes(option: &str, words: Option<&String>) -> Result<AxisValues, Error> {
    let Some(words) = words else { return Ok(AxisValues::default()) };
    let first = PoseTexts::read(option, words)?.items.into_iter().next();
    first.unwrap_or_else(|| Ok(PoseWords::default())).map(|pose| AxisValues(pose.words))
}

/// The poses of a file, or those given as words.
fn poses(file: &str, at: &[String]) -> Result<PoseTexts, Error> {
    if at.is_empty() {
        PoseTexts::read(file, &files::text(file)?)
    } else {
        PoseTexts::read("--at", &at.join("\n"))
    }
}

/// Length of the tool.
#[derive(Debug, clap::Args)]
struct ToolLength {
    /// Length of the tool from the gauge point, mm
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    length: f64,
}

impl ToolLength {
    /// A length that can be one.
    fn given(&self) -> Result<f64, Error> {
        if self.length.is_finite() {
            return Ok(self.length);
        }
        Err(Finding::error(Code::JOB_VALUE, "the length of the tool is not finite").key("--length").into())
    }
}

#[derive(Debug, clap::Args)]
pub(crate) struct Fk {
    #[command(flatten)]
    machine: MachineName,
    /// Axis positions: a file with a line of words each (X10 A-30) or JSON; `-` reads standard input
    #[arg(default_value = "-", value_name = "POSES")]
    poses: String,
    /// Axis positions as words, instead of a file; may be given again
    #[arg(long, value_name = "WORDS", conflicts_with = "poses")]
    at: Vec<String>,
    #[command(flatten)]
    tool: ToolLength,
}

impl Fk {
    /// Axis positions to poses.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let (machine, length) = (self.machine.load()?, self.tool.given()?);
        let poses = poses(&self.poses, &self.at)?;
        answers(args, To::default(), &poses, |words| forward(&machine, words, length))
    }
}

#[derive(Debug, clap::Args)]
pub(crate) struct Ik {
    #[command(flatten)]
    machine: MachineName,
    /// Poses: a file with a line of words each (X10 Z5 J-0.7 K0.7) or JSON; `-` reads standard input
    #[arg(default_value = "-", value_name = "POSES")]
    poses: String,
    /// A pose as words, instead of a file; may be given again
    #[arg(long, value_name = "WORDS", conflicts_with = "poses")]
    at: Vec<String>,
    /// Axes that are held, or free axes at singular poses: "A10"
    #[arg(long, value_name = "WORDS")]
    lock: Option<String>,
    /// Take the poses as a path: one solution for each, so that the rotary axes turn least and stay within travel
    #[arg(long)]
    path: bool,
    /// Of a path: positions of the axes before it: "C90"; default: anywhere
    #[arg(long, value_name = "WORDS", requires = "path")]
    from: Option<String>,
    /// Of a path: refuse it when the tool must be retracted for a flip or to unwind
    #[arg(long, requires = "path")]
    no_retract: bool,
    /// Of a path: the axis that should start at a positive position
    #[arg(long, value_name = "AXIS", requires = "path")]
    positive: Option<char>,
    /// Of a path on a control that moves the axes straight: how far the tip may leave its straight line, mm; shows how far
    /// it does, and the points between that prevent it
    #[arg(long, value_name = "MM", requires = "path", allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// With --tolerance: how far the tool may leave its direction on the great circle, degrees
    #[arg(
        long,
        value_name = "DEG",
        requires = "tolerance",
        default_value_t = 0.1,
        allow_negative_numbers = true
    )]
    axis_tolerance: f64,
    /// A spare axis, swept over its travel: the solutions at each place; of a path the place where it is held best (fewest
    /// retractions, then farthest from limits and singular poses at the worst pose, then least turning)
    #[arg(long, value_name = "AXIS")]
    sweep: Option<char>,
    /// With --sweep: number of places over the travel
    #[arg(long, value_name = "N", requires = "sweep", default_value_t = 25)]
    places: usize,
    #[command(flatten)]
    tool: ToolLength,
}

impl Ik {
    /// Poses to axis positions.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let machine = self.machine.load()?;
        let wants = InverseWants { locked: axes("--lock", self.lock.as_ref())?, length: self.tool.given()? };
        let poses = poses(&self.poses, &self.at)?;
        let swept =
            self.sweep.map(|axis| SweepWants { axis: axis.to_ascii_uppercase(), places: self.places });
        if let Some(swept) = &swept {
            swept.check(&machine, &wants.locked)?;
        }
        let to = To::default();
        match (self.path, swept) {
            (true, swept) => self.along(args, &machine, &poses, wants, swept.as_ref()),
            (false, Some(swept)) => {
                answers(args, to, &poses, |words| ik::sweep(&machine, words, &wants, &swept))
            }
            (false, None) => answers(args, to, &poses, |words| ik::inverse(&machine, words, &wants)),
        }
    }

    /// The poses as a path.
    fn along(
        &self,
        args: &Printing,
        machine: &Loadable,
        poses: &PoseTexts,
        wants: InverseWants,
        swept: Option<&SweepWants>,
    ) -> Result<u8, Error> {
        let axis_tolerance = self.axis_tolerance;
        let wants = PathWants {
            poses: wants,
            from: self.from.as_ref().map(|words| axes("--from", Some(words))).transpose()?,
            without_retract: self.no_retract,
            prefer_positive: self.positive.map(|letter| letter.to_ascii_uppercase()),
            straight: self.tolerance.map(|tolerance| StraightWants { tolerance, axis_tolerance }),
        };
        let to = To { data: Data::Alone, ..To::default() };
        match swept {
            Some(swept) => answer(args, to, ik::sweep_path(machine, poses, &wants, swept, &Silent)?),
            None => answer(args, to, ik::path(machine, poses, &wants, &Silent)?),
        }
    }
}

#[derive(Debug, clap::Args)]
pub(crate) struct Reach {
    #[command(flatten)]
    machine: MachineName,
    /// A direction of the tool, from tip to holder: 0,-1,1; may be given again
    #[arg(long, value_name = "I,J,K", value_parser = triple, allow_hyphen_values = true)]
    direction: Vec<[f64; 3]>,
    /// Axes that are held: "A10"
    #[arg(long, value_name = "WORDS")]
    lock: Option<String>,
}

impl Reach {
    /// The space that a machine reaches.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let locked = axes("--lock", self.lock.as_ref())?;
        answer(args, To::default(), reach(&self.machine.load()?, &locked, &self.direction)?)
    }
}
