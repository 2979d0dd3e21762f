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
