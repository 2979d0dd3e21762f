//! The command line as a user writes it.

use std::io::IsTerminal as _;
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
    /// Findings that count in the exit code beside errors and what is not proven
    #[arg(long, global = true, value_enum, value_name = "WHAT")]
    pub(crate) deny: Vec<Deny>,
}

impl Args {
    /// Whether messages have colours.
    pub(crate) fn colour(&self) -> bool {
        match self.color {
            Colour::Always => true,
            Colour::Never => false,
            Colour::Auto => std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none(),
        }
    }
}

/// A kind of finding that may be denied.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Deny {
    /// A warning exits with 1, as an error does
    Warnings,
}

const EXAMPLES: &str = "\
Examples:
  kinecut run examples/01_bore/job.toml --out out   plan, post, read back, simulate, report
  kinecut verify out/verdict.json                   does the verdict still hold?
  kinecut simulate O1234.nc --job job.toml          cut a program that others wrote
  kinecut check O1234.nc --control fanuc            read it, and say what is wrong with it
  kinecut post O1234.nc --from fanuc --to linuxcnc  write it for another control
  kinecut hole hole.toml --compare --out out        all strategies on one hole, compared
  kinecut drill hole.toml --out out                 zones, Z, feeds and times of drilled holes
  kinecut face face.toml --out out                  the placement with the least burr, certified
  kinecut grazing tool.toml --out out               the curve on a tool under a motion, drawn
  kinecut envelope move.toml --out out              what a tool sweeps in a move: mesh, picture, numbers
  kinecut surface cone                              code, redistributions and processes of a surface
  kinecut layouts XYZAC --full                      every layout of these axes, compared
  kinecut ik trt_xyzac --at \"X10 Z5 J-0.7 K0.7\"    all axis positions for a pose
  kinecut schema job > job.schema.json              completion and checks in an editor
  kinecut explain KC0501                            what a finding means

Exit codes: 0 done, and the verdict is SAFE; 1 NOT SAFE, NOT PROVEN, or a denied warning; 2 wrong input, or it cannot
be said; 3 a defect of kinecut.
A proof on a model does not replace the dry run.";

#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Plan, post, read back, simulate and report a job
    Run(Run),
    /// Simulate a program that others wrote: cut part, findings, comparison, report
    Simulate(Simulate),
    /// Read a program that others wrote and say what is wrong with it; nothing is cut
    Check(Check),
    /// Write a program for another control, and compare the two motions
    Post(Post),
    /// Plan one hole, or compare all strategies on it
    Hole(Hole),
    /// Plan drilling: zones, Z coordinates, feeds and times of one hole or many
    Drill(Drill),
    /// Plan face milling: exit angles, the certified placement with the least burr, passes and their price
    Face(Face),
    /// Grazing curve: where the surface of a tool slides along what it sweeps, at one moment of any motion
    Grazing(Grazing),
    /// Envelope: what a tool sweeps in a move, as a closed mesh (STL, GLB), a picture and numbers
    Envelope(Envelope),
    /// Show a machine: code, axes at home, travel; write it as a machine file
    Machine(Machine),
    /// Forward kinematics: axis positions to tip and direction of the tool
    Fk(Fk),
    /// Inverse kinematics: tip and direction to all axis positions
    Ik(Ik),
    /// Reach of a machine: tilt, singular directions, share of all directions
    Reach(Reach),
    /// All layouts of a code or of a set of axes, filtered, scored and sorted
    Layouts(Layouts),
    /// Generation of a surface: codes, redistributions between machine and tool, processes
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
}

/// A program that others wrote, and what is known about it.
#[derive(Debug, clap::Args)]
pub(crate) struct ProgramOf {
    /// The program
    pub(crate) program: PathBuf,
    /// Job file with tools, stock, machine, clamping and design; its own operations do not count
    #[arg(long, value_name = "JOB", conflicts_with_all = ["machine", "tools", "position"])]
    pub(crate) job: Option<PathBuf>,
    /// With --job: the clamping of the job that it runs in
    #[arg(long, value_name = "N", requires = "job")]
    pub(crate) setup: Option<usize>,
    /// The machine, for axis limits and rotary axes: a machine file, or a machine that kinecut knows
    #[arg(long, value_name = "MACHINE")]
    pub(crate) machine: Option<String>,
    /// Machine position of the work zero, mm
    #[arg(long, value_name = "X,Y,Z", value_parser = triple, allow_hyphen_values = true, requires = "machine")]
    pub(crate) position: Option<[f64; 3]>,
    /// TOML file with the tools ([[tool]], [[holder]]); a job file is one
    #[arg(long, value_name = "FILE")]
    pub(crate) tools: Option<PathBuf>,
    /// Number of the tool in the spindle before the program calls one
    #[arg(long, value_name = "N")]
    pub(crate) tool: Option<u32>,
}

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  kinecut simulate O1234.nc --job job.toml --out out
  kinecut simulate part.ngc --stock \"-5,-5,-20,105,65,0\" --tools tools.toml --out out
  kinecut simulate job.toml --out out    a job whose setup says program = { file = \"O1234.nc\" }")]
pub(crate) struct Simulate {
    #[command(flatten)]
    pub(crate) of: ProgramOf,
    /// The control that runs it; default: that of the job, then that of the file's ending (.mpf .ngc .gcode .h)
    #[arg(long, value_name = "CONTROL")]
    pub(crate) control: Option<String>,
    /// Raw stock: least and greatest corner of a block in coordinates of the work offset, mm
    #[arg(long, value_name = "X0,Y0,Z0,X1,Y1,Z1", value_parser = corners, allow_hyphen_values = true, conflicts_with = "job")]
    pub(crate) stock: Option<[f64; 6]>,
    /// Distance of the lines of the stock model, mm
    #[arg(long, value_name = "MM")]
    pub(crate) step: Option<f64>,
    /// Folder for the results, made if it is not there
    #[arg(long, default_value = "out")]
    pub(crate) out: PathBuf,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) of: ProgramOf,
    /// The control that runs it; default: that of the job, then that of the file's ending (.mpf .ngc .gcode .h)
    #[arg(long, value_name = "CONTROL")]
    pub(crate) control: Option<String>,
}

#[derive(Debug, clap::Args)]
#[command(
    after_help = "A word that the other control does not have is an error at its block; one that moves nothing there is a
finding. The new text is read back and compared with the old one."
)]
pub(crate) struct Post {
    #[command(flatten)]
    pub(crate) of: ProgramOf,
    /// The control that it was written for; default: that of the job, then that of the file's ending
    #[arg(long, value_name = "CONTROL")]
    pub(crate) from: Option<String>,
    /// The control that it is to be written for: sinumerik-840d, fanuc, linuxcnc, grbl, heidenhain
    #[arg(long, value_name = "CONTROL")]
    pub(crate) to: String,
    /// Form of the directions of the tool; default: as they are in the program
    #[arg(long, value_enum)]
    pub(crate) orientation: Option<Orientation>,
    /// Decimals of coordinates, 3 to 6; default: as usual on the control
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(3..=6))]
    pub(crate) decimals: Option<u8>,
    /// File for the new text; without it: standard output
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

/// Form of the directions of the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Orientation {
    /// As vectors, with control of the tool centre point
    Vectors,
    /// As angles of the rotary axes, with control of the tool centre point
    Angles,
    /// As positions of all axes
    Axes,
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
    /// Plan other ways too, each with its price: rows, frames, other straight passes
    #[arg(long)]
    pub(crate) compare: bool,
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
    /// Folder for face.html, made if it is not there; the page has what --compare and --paper show
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Grazing {
    /// A tool with its motion, or a list of them, in TOML or JSON; `-` reads standard input
    #[arg(default_value = "-")]
    pub(crate) file: String,
    /// Show the cases of the paper instead, each beside what was computed
    #[arg(long, conflicts_with = "svg")]
    pub(crate) gallery: bool,
    /// Folder for grazing.html (with --gallery: gallery.html and an SVG file of each case), made if it is not there
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Draw the tool with its curve, and the parameter plane, into this SVG file
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Envelope {
    /// A tool with its move, or a list of them, in TOML or JSON; `-` reads standard input
    #[arg(default_value = "-")]
    pub(crate) file: String,
    /// Folder for envelope.html, envelope.stl and envelope.glb (numbered when there are several), made if it is not there
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Draw what is swept into this SVG file
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
}

/// Facts of a machine that its LinuxCNC configuration does not tell.
#[derive(Debug, clap::Args)]
pub(crate) struct Configuration {
    /// HAL file beside those that a LinuxCNC INI file names; may be given again
    #[arg(long, value_name = "FILE")]
    pub(crate) hal: Vec<String>,
    /// Coordinate code, for a LinuxCNC configuration that does not tell it
    #[arg(long, value_name = "CODE")]
    pub(crate) code: Option<String>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MachineName {
    /// A machine file (TOML), an INI file of LinuxCNC, or a machine that kinecut knows
    #[arg(value_name = "MACHINE")]
    pub(crate) name: String,
    #[command(flatten)]
    pub(crate) configuration: Configuration,
}

#[derive(Debug, clap::Args)]
pub(crate) struct Machine {
    /// A machine file (TOML), an INI file of LinuxCNC, or a machine that kinecut knows; without it: the known machines
    #[arg(value_name = "MACHINE")]
    pub(crate) name: Option<String>,
    #[command(flatten)]
    pub(crate) configuration: Configuration,
    /// Print the machine as a machine file
    #[arg(long, conflicts_with = "json")]
    pub(crate) toml: bool,
    /// Draw the machine, to scale, into this SVG file: the bodies that its file gives, or the usual ones
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// Draw it with its axes at these positions: "A-45 C30"; needs bodies in the machine file
    #[arg(long, value_name = "WORDS", requires = "svg")]
    pub(crate) at: Option<String>,
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
    /// Of a path: positions of the axes before it: "C90"; default: anywhere
    #[arg(long, value_name = "WORDS", requires = "path")]
    pub(crate) from: Option<String>,
    /// Of a path: refuse it when the tool must be retracted for a flip or to unwind
    #[arg(long, requires = "path")]
    pub(crate) no_retract: bool,
    /// Of a path: the axis that should start at a positive position
    #[arg(long, value_name = "AXIS", requires = "path")]
    pub(crate) positive: Option<char>,
    /// Of a path on a control that moves the axes straight: how far the tip may leave its straight line, mm; shows how far
    /// it does, and the points between that prevent it
    #[arg(long, value_name = "MM", requires = "path", allow_negative_numbers = true)]
    pub(crate) tolerance: Option<f64>,
    /// With --tolerance: how far the tool may leave its direction on the great circle, degrees
    #[arg(
        long,
        value_name = "DEG",
        requires = "tolerance",
        default_value_t = 0.1,
        allow_negative_numbers = true
    )]
    pub(crate) axis_tolerance: f64,
    /// A spare axis, swept over its travel: the solutions at each place; of a path the place where it is held best (fewest
    /// retractions, then farthest from limits and singular poses at the worst pose, then least turning)
    #[arg(long, value_name = "AXIS")]
    pub(crate) sweep: Option<char>,
    /// With --sweep: number of places over the travel
    #[arg(long, value_name = "N", requires = "sweep", default_value_t = 25)]
    pub(crate) places: usize,
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
    /// Strokes of X, Y, Z, mm: 600,500,500; shows measures of the workspace too
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
    /// Stand of the spindle: vertical, horizontal, both
    #[arg(long)]
    pub(crate) spindle: Option<String>,
    /// Layouts that differ by a quarter turn of the machine count once
    #[arg(long)]
    pub(crate) quarter_turns: bool,
    /// Weight of a score, instead of the usual: moved-mass=2; may be given again
    #[arg(long, value_name = "NAME=WEIGHT", value_parser = weight)]
    pub(crate) weight: Vec<(String, f64)>,
    /// Number of layouts listed
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
    /// With --machine: most error of a surface that counts as reached, micrometres
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

/// Six numbers with commas between.
fn corners(text: &str) -> Result<[f64; 6], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|t| t.trim().parse::<f64>()).collect();
    match numbers.ok().and_then(|n| <[f64; 6]>::try_from(n).ok()) {
        Some(n) if n.iter().all(|v| v.is_finite()) => Ok(n),
        _ => {
            Err("write the least and the greatest corner as six numbers, such as -5,-5,-20,105,65,0"
                .to_owned())
        }
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
    /// The input of `kinecut envelope`
    Envelope,
    /// The input of `kinecut grazing`
    Grazing,
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
