//! The verbs that plan one operation: `hole`, `drill`, `face`.

use std::path::PathBuf;

use kinecut::base::Error;
use kinecut::verbs::drill::{DrillSheet, plan_drill_sheet};
use kinecut::verbs::face::{SheetWants, plan_face_sheet};
use kinecut::verbs::hole::{HoleSamples, compare_hole, plan_hole_sheet, read_holes};

use crate::answers::{Data, To, answers};
use crate::printing::Printing;
use crate::{files, progress};

#[derive(Debug, clap::Args)]
pub(crate) struct Hole {
    /// A hole, or a list of holes, in TOML or JSON; `-` reads standard input
    #[arg(default_value = "-")]
    file: String,
    /// Run every strategy and compare them
    #[arg(long)]
    compare: bool,
    /// Give with --json the passes as they are run: way, speed, acceleration, jerk, curvature, load in samples
    #[arg(long, value_name = "PASS", conflicts_with = "compare")]
    samples: Option<Samples>,
    /// Folder for hole.html, with figures of the lead-in, or compare.html; made if it is not there
    #[arg(long)]
    out: Option<PathBuf>,
}

/// Passes in samples.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Samples {
    Rough,
    Finish,
    All,
}

impl From<Samples> for HoleSamples {
    fn from(samples: Samples) -> HoleSamples {
        match samples {
            Samples::Rough => HoleSamples::Rough,
            Samples::Finish => HoleSamples::Finish,
            Samples::All => HoleSamples::All,
        }
    }
}

impl Hole {
    /// Plans holes, or compares all strategies on them.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let (text, _) = files::question(&self.file)?;
        let holes = read_holes(&self.file, text)?;
        let to = To { out: self.out.as_deref(), ..To::default() };
        match self.compare {
            true => answers(args, to, &holes, compare_hole),
            false => {
                let samples = self.samples.map_or(HoleSamples::None, HoleSamples::from);
                answers(args, to, &holes, |table| plan_hole_sheet(table, samples))
            }
        }
    }
}

#[derive(Debug, clap::Args)]
pub(crate) struct Drill {
    /// A drilling, or a list of them, in TOML or JSON; `-` reads standard input
    #[arg(default_value = "-")]
    file: String,
    /// Show what the formulas of Belyakov and Seleznev 2023 give as printed, beside the exact numbers
    #[arg(long)]
    paper: bool,
    /// Add the share of the point in material along the way of each hole to the JSON
    #[arg(long)]
    load: bool,
    /// Print the program too: its blocks, not simulated
    #[arg(long)]
    program: bool,
    /// Folder for drill.html, made if it is not there
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Drill {
    /// Plans drillings.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let (text, loader) = files::question(&self.file)?;
        let holes = read_holes(&self.file, text)?;
        let to = To { out: self.out.as_deref(), data: below(self.program), ..To::default() };
        answers(args, to, &holes, |table| {
            let sheet = plan_drill_sheet(table, self.paper, &loader)?;
            Ok(DrillSheet { load: self.load, ..sheet })
        })
    }
}

/// A program that is shown below its plan if it is wanted.
fn below(wanted: bool) -> Data<'static> {
    if wanted { Data::Below } else { Data::Nowhere }
}

#[derive(Debug, clap::Args)]
pub(crate) struct Face {
    /// A face, or a list of them, in TOML or JSON; `-` reads standard input
    #[arg(default_value = "-")]
    file: String,
    /// Plan other ways too, each with its price: rows, frames, other straight passes
    #[arg(long)]
    compare: bool,
    /// Show what the program of Kryzhanivskyi and Kryzhanivska 2011 does: exit angles over the orientation, and local
    /// minima from random starts
    #[arg(long)]
    paper: bool,
    /// List every crossing of every tooth with the outline
    #[arg(long)]
    events: bool,
    /// Add the bad length over all placements of one straight pass to the JSON
    #[arg(long)]
    map: bool,
    /// Add the steps of the paper's method from the placement that is chosen to the JSON
    #[arg(long)]
    walk: bool,
    /// Print the program too: its blocks, not simulated
    #[arg(long)]
    program: bool,
    /// Folder for face.html, made if it is not there; the page has what --compare and --paper show
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Face {
    /// Plans faces.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let (text, loader) = files::question(&self.file)?;
        let faces = read_holes(&self.file, text)?;
        let page = self.out.is_some();
        let wants = SheetWants {
            compare: self.compare || page,
            paper: self.paper || page,
            events: self.events,
            map: self.map,
            walk: self.walk,
        };
        let to = To { out: self.out.as_deref(), data: below(self.program), ..To::default() };
        let bar = progress::Bar::new();
        answers(args, to, &faces, |table| plan_face_sheet(table, wants, &loader, &bar))
    }
}
