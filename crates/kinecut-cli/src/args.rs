//! The command line as a user writes it.

use std::path::PathBuf;

use clap::{Parser, Subcommand, ValueEnum};
use kinecut::base::Error;
use kinecut::job;
use kinecut::verbs::envelope::envelope_schema;
use kinecut::verbs::explain::{Manual, page};
use kinecut::verbs::grazing::grazing_schema;
use kinecut::verbs::hole::hole_schema;
use kinecut::verbs::schema::Schema;

use crate::answers::{Data, To, answer};
use crate::layouts::Layouts;
use crate::machine::{Fk, Ik, Machine, Reach};
use crate::open::Open;
use crate::planned::{Drill, Face, Hole};
use crate::printing::Printing;
use crate::program::{Check, Post, Run, Simulate};
use crate::surface::Surface;
use crate::swept::{Envelope, Grazing};
use crate::time::Time;
use crate::tools::Tools;

/// Plans, posts and proves metal cutting.
#[derive(Debug, Parser)]
#[command(name = "kinecut", version, after_help = EXAMPLES, disable_help_subcommand = true)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) verb: Verb,
    #[command(flatten)]
    pub(crate) printing: Printing,
}

const EXAMPLES: &str = "\
Examples:
  kinecut run examples/01_bore/job.toml --out out   plan, post, read back, simulate, report
  kinecut open examples/01_bore                     the workbench: edit, see and save a job in the browser
  kinecut verify out/verdict.json                   does the verdict still hold?
  kinecut simulate O1234.nc --job job.toml          cut a program that others wrote
  kinecut check O1234.nc --control fanuc            read it, and say what is wrong with it
  kinecut time O1234.nc --job job.toml              how long it takes on the machine, and where time is lost
  kinecut post O1234.nc --from fanuc --to linuxcnc  write it for another control
  kinecut hole hole.toml --out out                  one hole planned, with figures of its lead-in
  kinecut hole hole.toml --compare --out out        all strategies on one hole, compared
  kinecut drill hole.toml --out out                 zones, Z, feeds and times of drilled holes
  kinecut face face.toml --out out                  the placement with the least burr, certified
  kinecut grazing tool.toml --out out               the curve on a tool under a motion, drawn
  kinecut envelope move.toml --out out              what a tool sweeps in a move: mesh, picture, numbers
  kinecut surface cone                              code, redistributions and processes of a surface
  kinecut layouts XYZAC --full                      every layout of these axes, compared
  kinecut ik trt_xyzac --at \"X10 Z5 J-0.7 K0.7\"    all axis positions for a pose
  kinecut tools library.tools --to toml             the tools of a Fusion library for a job
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
    Simulate(Box<Simulate>),
    /// Read a program that others wrote and say what is wrong with it; nothing is cut
    Check(Check),
    /// Time of a program or a job under the limits of the machine's axes, where it is lost, samples of the motion
    Time(Time),
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
    /// Show the tools of a file, and what of it is not taken; write them in another format
    Tools(Tools),
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
    /// Open the workbench in the browser: a job with its program and its part, planned again as it is edited
    Open(Open),
    /// Say whether a verdict still holds for the files as they are now
    Verify(Verify),
    /// Print the JSON Schema of an input
    Schema {
        /// The input
        #[arg(value_enum)]
        name: SchemaName,
    },
    /// Print the manual page of a finding, or the list of all
    Explain {
        /// Code, for example KC0501
        code: Option<String>,
    },
}

impl Verb {
    /// Runs the verb; the exit code.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let to = To::default();
        match self {
            Verb::Run(verb) => verb.answer(args),
            Verb::Simulate(verb) => verb.answer(args),
            Verb::Check(verb) => verb.answer(args),
            Verb::Time(verb) => verb.answer(args),
            Verb::Post(verb) => verb.answer(args),
            Verb::Hole(verb) => verb.answer(args),
            Verb::Drill(verb) => verb.answer(args),
            Verb::Face(verb) => verb.answer(args),
            Verb::Grazing(verb) => verb.answer(args),
            Verb::Envelope(verb) => verb.answer(args),
            Verb::Machine(verb) => verb.answer(args),
            Verb::Tools(verb) => verb.answer(args),
            Verb::Fk(verb) => verb.answer(args),
            Verb::Ik(verb) => verb.answer(args),
            Verb::Reach(verb) => verb.answer(args),
            Verb::Layouts(verb) => verb.answer(args),
            Verb::Surface(verb) => verb.answer(args),
            Verb::Open(verb) => verb.answer(args),
            Verb::Verify(of) => answer(args, to, kinecut::verify(&of.verdict, of.job.as_deref())?),
            Verb::Schema { name } => answer(args, To { data: Data::Alone, ..to }, name.schema()),
            Verb::Explain { code: None } => answer(args, to, Manual::all()),
            Verb::Explain { code: Some(code) } => answer(args, to, page(code)?),
        }
    }
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
    /// Tools and holders in a file of their own
    Tools,
    /// Cutting data of a shop in a file of their own
    Cutting,
    /// A surface by its generating lines
    Surface,
    /// A tool of any form of revolution: shape, shank, holder
    #[value(alias = "tool")]
    Contour,
}

impl SchemaName {
    /// The schema of this name.
    pub(crate) fn schema(self) -> Schema {
        Schema(match self {
            SchemaName::Job => job::file::schema(),
            SchemaName::Hole => hole_schema(),
            SchemaName::Outline => job::file::outline_schema(),
            SchemaName::Envelope => envelope_schema(),
            SchemaName::Grazing => grazing_schema(),
            SchemaName::Machine => job::file::machine_schema(),
            SchemaName::Tools => job::file::tools_schema(),
            SchemaName::Cutting => job::file::cutting_schema(),
            SchemaName::Surface => job::file::surface_schema(),
            SchemaName::Contour => job::file::contour_schema(),
        })
    }
}
