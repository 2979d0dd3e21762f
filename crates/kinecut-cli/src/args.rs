//! The command line as a user writes it.

use std::path::PathBuf;

use clap::{Parser, Subcommand, ValueEnum};

/// Plans, posts and proves metal cutting.
#[derive(Debug, Parser)]
#[command(name = "kinecut", version, after_help = EXAMPLES, disable_help_subcommand = true)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) verb: Verb,
    /// One JSON document on standard output, errors included
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Colour of messages
    #[arg(long, global = true, value_enum, default_value_t = Colour::Auto, value_name = "WHEN")]
    pub(crate) color: Colour,
}

const EXAMPLES: &str = "\
Examples:
  kinecut run examples/01_bore/job.toml --out out   plan, post, read back, simulate, report
  kinecut verify out/verdict.json                   does the verdict still hold?
  kinecut hole hole.toml --compare --out out        all strategies on one hole, compared
  kinecut drill hole.toml --out out                 zones, Z, feeds and times of drilled holes
  kinecut face face.toml --out out                  the placement with the least burr, certified
  kinecut surface cone                              code, redistributions and processes of a surface
  kinecut layouts XYZAC --full                      every layout of these axes, compared
  kinecut ik trt_xyzac --at \"X10 Z5 J-0.7 K0.7\"    all axis positions for a pose
  kinecut schema job > job.schema.json              completion and checks in an editor
  kinecut explain KC0501                            what a finding means

Exit codes: 0 fine, 1 findings, 2 wrong input or usage, 3 a defect of kinecut.
A proof on a model does not replace the dry run.";

#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Plan, post, read back, simulate and report a job
    Run(Run),
    /// Plan one hole, or compare all strategies on it
    Hole(Hole),
    /// Plan drilling: zones, Z coordinates, feeds and times of one hole or many
    Drill(Drill),
    /// Plan face milling: exit angles, the certified placement with the least burr, passes and their price
    Face(Face),
    /// Show a machine: code, axes at home, travel; write it as a machine file
    Machine(Machine),
    /// Forward kinematics: axis positions to tip and direction of the tool
    Fk(Fk),
    /// Inverse kinematics: tip and direction to all axis positions
    Ik(Ik),
    /// What a machine reaches: tilt, singular directions, share of all directions
    Reach(Reach),
    /// All layouts of a code or of a set of axes, filtered, scored and sorted
    Layouts(Layouts),
    /// How a surface is generated: codes, redistributions between machine and tool, processes
    Surface(Surface),
    /// Say whether a verdict still holds for the files as they are now
    Verify(Verify),
    /// Print the JSON Schema of an input
    Schema {
        /// Which input
        #[arg(value_enum)]
        name: SchemaName,
    },
    /// Print the manual page of a finding, or the list of all
    Explain {
        /// Code, for example KC0501
        code: Option<String>,
    },
}

#[derive(Debug, clap::Args)]
pub(crate) struct Run {
    /// The job file
    pub(crate) job: PathBuf,
    /// Folder for the results, made if it is not there
    #[arg(long, default_value = "out")]
    pub(crate) out: PathBuf,
    /// Refuse to write a program that has findings of severity error
    #[arg(long)]
    pub(crate) strict: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Hole {
    /// A hole, or a list of holes, in TOML or JSON; `-` reads standard input
    #[arg(default_value = "-")]
    pub(crate) file: String,
    /// Run every strategy and compare them
    #[arg(long)]
    pub(crate) compare: bool,
    /// Folder for compare.html, made if it is not there
    #[arg(long, requires = "compare")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Drill {
    /// A drilling, or a list of them, in TOML or JSON; `-` reads standard input
    #[arg(default_value = "-")]
    pub(crate) file: String,
    /// Show what the formulas of Belyakov and Seleznev 2023 give as printed, beside the exact numbers
    #[arg(long)]
    pub(crate) paper: bool,
    /// Print the program too: its blocks, not simulated
    #[arg(long)]
    pub(crate) program: bool,
    /// Folder for drill.html, made if it is not there
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Face {
    /// A face, or a list of them, in TOML or JSON; `-` reads standard input
    #[arg(default_value = "-")]
    pub(crate) file: String,
    /// Show what the program of Kryzhanivskyi and Kryzhanivska 2011 does: exit angles over the orientation, and local
    /// minima from random starts
    #[arg(long)]
    pub(crate) paper: bool,
    /// List every crossing of every tooth with the outline
    #[arg(long)]
    pub(crate) events: bool,
    /// Print the program too: its blocks, not simulated
    #[arg(long)]
    pub(crate) program: bool,
    /// Folder for face.html, made if it is not there
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MachineName {
    /// A machine file (TOML), an INI file of LinuxCNC, or a machine that kinecut knows
    #[arg(value_name = "MACHINE")]
    pub(crate) name: String,
    /// HAL file beside those that a LinuxCNC INI file names; may be given again
    #[arg(long, value_name = "FILE")]
    pub(crate) hal: Vec<String>,
    /// Coordinate code, for a LinuxCNC configuration that does not tell it
    #[arg(long, value_name = "CODE")]
    pub(crate) code: Option<String>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Machine {
    /// A machine file (TOML), an INI file of LinuxCNC, or a machine that kinecut knows; without it: the known machines
    #[arg(value_name = "MACHINE")]
    pub(crate) name: Option<String>,
    /// HAL file beside those that a LinuxCNC INI file names; may be given again
    #[arg(long, value_name = "FILE")]
    pub(crate) hal: Vec<String>,
    /// Coordinate code, for a LinuxCNC configuration that does not tell it
    #[arg(long, value_name = "CODE")]
    pub(crate) code: Option<String>,
    /// Print the machine as a machine file
    #[arg(long, conflicts_with = "json")]
    pub(crate) toml: bool,
    /// Draw the machine, to scale, into this SVG file
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Fk {
    #[command(flatten)]
    pub(crate) machine: MachineName,
    /// Axis positions: a file with a line of words each (X10 A-30) or JSON; `-` reads standard input
    #[arg(default_value = "-", value_name = "POSES")]
    pub(crate) poses: String,
    /// Axis positions as words, instead of a file; may be given again
    #[arg(long, value_name = "WORDS", conflicts_with = "poses")]
    pub(crate) at: Vec<String>,
    /// Length of the tool from the gauge point, mm
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    pub(crate) length: f64,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Ik {
    #[command(flatten)]
    pub(crate) machine: MachineName,
    /// Poses: a file with a line of words each (X10 Z5 J-0.7 K0.7) or JSON; `-` reads standard input
    #[arg(default_value = "-", value_name = "POSES")]
    pub(crate) poses: String,
    /// A pose as words, instead of a file; may be given again
    #[arg(long, value_name = "WORDS", conflicts_with = "poses")]
    pub(crate) at: Vec<String>,
    /// Axes that are held, or free axes at singular poses: "A10"
    #[arg(long, value_name = "WORDS")]
    pub(crate) lock: Option<String>,
    /// Take the poses as a path: one solution for each, so that the rotary axes turn least and stay within travel
    #[arg(long)]
    pub(crate) path: bool,
    /// Of a path: where the axes stand before it: "C90"; default: anywhere
    #[arg(long, value_name = "WORDS", requires = "path")]
    pub(crate) from: Option<String>,
    /// Of a path: refuse it when the tool must be retracted for a flip or to unwind
    #[arg(long, requires = "path")]
    pub(crate) no_retract: bool,
    /// Of a path: the axis that should start at a positive position
    #[arg(long, value_name = "AXIS", requires = "path")]
    pub(crate) positive: Option<char>,
    /// Length of the tool from the gauge point, mm
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    pub(crate) length: f64,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Reach {
    #[command(flatten)]
    pub(crate) machine: MachineName,
    /// A direction of the tool, from tip to holder: 0,-1,1; may be given again
    #[arg(long, value_name = "I,J,K", value_parser = triple, allow_hyphen_values = true)]
    pub(crate) direction: Vec<[f64; 3]>,
    /// Axes that are held: "A10"
    #[arg(long, value_name = "WORDS")]
    pub(crate) lock: Option<String>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Layouts {
    /// A code (641203), a chain of ISO 10791, letters of axes in any order (XYZAC), or "regular"
    pub(crate) of: String,
    /// Only layouts of full mobility
    #[arg(long)]
    pub(crate) full: bool,
    /// Only layouts whose translations stay at right angles
    #[arg(long)]
    pub(crate) regular: bool,
    /// Most axes that carry the work; 0 or 1 for a heavy part
    #[arg(long, value_name = "N")]
    pub(crate) work_links: Option<usize>,
    /// Only these axes may carry the work: XYC
    #[arg(long, value_name = "AXES")]
    pub(crate) work_axes: Option<String>,
    /// Only these axes may carry the tool: XYZ
    #[arg(long, value_name = "AXES")]
    pub(crate) tool_axes: Option<String>,
    /// Kind: table-table, head-table, head-head, table, head, linear; may be given again
    #[arg(long)]
    pub(crate) kind: Vec<String>,
    /// Tilt of the tool from home that must be reached, degrees
    #[arg(long, value_name = "DEG")]
    pub(crate) tilt: Option<f64>,
    /// Strokes of X, Y, Z, mm: 600,500,500
    #[arg(long, value_name = "X,Y,Z", value_parser = triple)]
    pub(crate) stroke: Option<[f64; 3]>,
    /// Size of the part, mm; with strokes, only layouts that have room for it
    #[arg(long, value_name = "X,Y,Z", value_parser = triple)]
    pub(crate) part: Option<[f64; 3]>,
    /// Distance from the tip to the rotary axes of a head, mm
    #[arg(long, value_name = "MM")]
    pub(crate) tool_length: Option<f64>,
    /// At most so many translations on the tool side where a stroke is above so many mm: 2,1000
    #[arg(long, value_name = "N,MM", value_parser = stacking)]
    pub(crate) stacking: Option<(usize, f64)>,
    /// How the spindle stands: vertical, horizontal, both
    #[arg(long)]
    pub(crate) spindle: Option<String>,
    /// Layouts that differ by a quarter turn of the machine count once
    #[arg(long)]
    pub(crate) quarter_turns: bool,
    /// What counts, instead of the usual: moved-mass=2; may be given again
    #[arg(long, value_name = "NAME=WEIGHT", value_parser = weight)]
    pub(crate) weight: Vec<(String, f64)>,
    /// How many are listed
    #[arg(long, default_value_t = 24, value_name = "N")]
    pub(crate) show: usize,
    /// Draw those that are listed, to scale, into this SVG file
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// Folder for layouts.html, made if it is not there
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Surface {
    /// A surface of the catalogue, a file with its generating lines (TOML or JSON; `-` reads standard input), or an STL
    /// mesh whose faces are recognised; without it: the catalogue
    pub(crate) surface: Option<String>,
    /// A parameter: R=40, alpha=20*pi/180; may be given again
    #[arg(long, value_name = "NAME=VALUE", value_parser = named)]
    pub(crate) set: Vec<(String, String)>,
    /// The material on the other side: of a shaft the bore
    #[arg(long)]
    pub(crate) reversed: bool,
    /// Ask this machine for every redistribution: laws of its axes, or why not
    #[arg(long, value_name = "MACHINE")]
    pub(crate) machine: Option<String>,
    /// With --machine: length of the tool from the gauge point, mm
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true, requires = "machine")]
    pub(crate) length: f64,
    /// With --machine: only this redistribution (code of the machine's part such as 61, `-` for none, or both parts such as
    /// 615|3), or `touching` or `rolling`; without it all are verified
    #[arg(long, value_name = "SPLIT", requires = "machine", allow_hyphen_values = true)]
    pub(crate) verify: Option<String>,
    /// With --machine: how far the surface may be off and count as reached, micrometres
    #[arg(
        long,
        value_name = "UM",
        default_value_t = 10.0,
        allow_negative_numbers = true,
        requires = "machine"
    )]
    pub(crate) tolerance: f64,
    /// With --machine: errors of every axis for the budget, micrometres and seconds of arc
    #[arg(long, value_name = "UM,ARCSEC", default_value = "10,10", value_parser = pair, requires = "machine")]
    pub(crate) errors: [f64; 2],
    /// With --machine: errors of one axis: X=5,3; may be given again
    #[arg(long, value_name = "AXIS=UM,ARCSEC", value_parser = axis_errors, requires = "machine")]
    pub(crate) error_of: Vec<(char, [f64; 2])>,
    /// With --machine: the nearest machines that could where this one cannot, among all layouts of two to five axes
    #[arg(long, requires = "machine")]
    pub(crate) alternatives: bool,
    /// Sketch the redistributions into this SVG file: surface, tool, motions with arrows
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// Folder for surface.html, made if it is not there
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Of a mesh: the angle from which on an edge divides two faces, degrees; default 40
    #[arg(long, value_name = "DEG")]
    pub(crate) crease: Option<f64>,
}

/// Three numbers with commas between.
fn triple(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|t| t.trim().parse::<f64>()).collect();
    match numbers.as_deref() {
        Ok([x, y, z]) if [x, y, z].iter().all(|v| v.is_finite()) => Ok([*x, *y, *z]),
        _ => Err("write three numbers with commas between, such as 0,-1,1".to_owned()),
    }
}

/// Two numbers with a comma between.
fn pair(text: &str) -> Result<[f64; 2], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|t| t.trim().parse::<f64>()).collect();
    match numbers.as_deref() {
        Ok([a, b]) => Ok([*a, *b]),
        _ => Err("write micrometres and seconds of arc with a comma between, such as 5,3".to_owned()),
    }
}

/// An axis with its errors.
fn axis_errors(text: &str) -> Result<(char, [f64; 2]), String> {
    let wrong = || "write an axis and its errors, such as X=5,3".to_owned();
    let (axis, errors) = text.split_once('=').ok_or_else(wrong)?;
    let mut letters = axis.trim().chars();
    match (letters.next(), letters.next()) {
        (Some(letter), None) => Ok((letter.to_ascii_uppercase(), pair(errors)?)),
        _ => Err(wrong()),
    }
}

/// A count and a length.
fn stacking(text: &str) -> Result<(usize, f64), String> {
    text.split_once(',')
        .and_then(|(n, mm)| Some((n.trim().parse().ok()?, mm.trim().parse().ok()?)))
        .ok_or_else(|| "write a count and a length, such as 2,1000".to_owned())
}

/// A name with a number.
fn weight(text: &str) -> Result<(String, f64), String> {
    text.split_once('=')
        .and_then(|(name, value)| Some((name.trim().to_owned(), value.trim().parse().ok()?)))
        .ok_or_else(|| "write a name and a number, such as moved-mass=2".to_owned())
}

/// A name with a text.
fn named(text: &str) -> Result<(String, String), String> {
    text.split_once('=')
        .map(|(name, value)| (name.trim().to_owned(), value.trim().to_owned()))
        .ok_or_else(|| "write a name and a value, such as R=40".to_owned())
}

#[derive(Debug, clap::Args)]
pub(crate) struct Verify {
    /// The verdict file, or the folder that holds verdict.json
    pub(crate) verdict: PathBuf,
    /// The job file, if it is no longer where it was
    #[arg(long)]
    pub(crate) job: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SchemaName {
    /// The job file
    Job,
    /// The input of `kinecut hole`, `kinecut drill` and `kinecut face`
    #[value(aliases = ["drill", "face"])]
    Hole,
    /// An outline in JSON, as a face names it
    Outline,
    /// A machine file
    Machine,
    /// A surface by its generating lines
    Surface,
    /// A tool of any form of revolution: shape, shank, holder
    #[value(alias = "tool")]
    Contour,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Colour {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}
