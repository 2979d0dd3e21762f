//! The verbs that plan one operation: `hole`, `drill`, `face`.

use std::path::PathBuf;

use kinecut::base::Error;
use kinecut::verbs::drill::plan_drill_sheet;
use kinecut::verbs::face::{SheetWants, plan_face_sheet};
use kinecut::verbs::hole::{compare_hole, plan_hole, read_holes};

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
    /// Folder for hole.html, with figures of the lead-in, or compare.html; made if it is not there
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Hole {
    /// Plans holes, or compares all strategies on them.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let (text, _) = files::question(&self.file)?;
        let holes = read_holes(&self.file, text)?;
        let to = To { out: self.out.as_deref(), ..To::default() };
        match self.compare {
            true => answers(args, to, &holes, compare_hole),
            false => answers(args, to, &holes, plan_hole),
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
        answers(args, to, &holes, |table| plan_drill_sheet(table, self.paper, &loader))
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
        let wants =
            SheetWants { compare: self.compare || page, paper: self.paper || page, events: self.events };
        let to = To { out: self.out.as_deref(), data: below(self.program), ..To::default() };
        let bar = progress::Bar::new();
        answers(args, to, &faces, |table| plan_face_sheet(table, wants, &loader, &bar))
    }
}
