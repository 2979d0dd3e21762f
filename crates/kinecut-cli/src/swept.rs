//! The verbs about what a moving tool does: `grazing`, `envelope`.

use std::path::PathBuf;

use kinecut::base::{Error, Silent};
use kinecut::job::TextItems;
use kinecut::verbs::envelope::{
    ENVELOPE_LIST, EnvelopeTable, Envelopes, MOST_INTERVALS, envelope_sheets, growths,
};
use kinecut::verbs::grazing::{GRAZING_LIST, Gallery, GrazingTable, gallery, grazing_sheet};

use crate::answers::{To, answer, answers};
use crate::files;
use crate::printing::Printing;

#[derive(Debug, clap::Args)]
pub(crate) struct Grazing {
    /// A tool with its motion, or a list of them, in TOML or JSON; `-` reads standard input
    #[arg(default_value = "-")]
    file: String,
    /// Show the cases of the paper instead, each beside what was computed
    #[arg(long, conflicts_with = "svg")]
    gallery: bool,
    /// Folder for grazing.html (with --gallery: gallery.html and an SVG file of each case), made if it is not there
    #[arg(long)]
    out: Option<PathBuf>,
    /// Draw the tool with its curve, and the parameter plane, into this SVG file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl Grazing {
    /// Grazing curves, or the paper's cases.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let to = To { out: self.out.as_deref(), svg: self.svg.as_deref(), ..To::default() };
        if self.gallery {
            return answer(args, to, Gallery(gallery()?));
        }
        let (text, loader) = files::question(&self.file)?;
        let tools = TextItems::<GrazingTable>::read(&self.file, text, GRAZING_LIST)?;
        answers(args, to, &tools, |table| grazing_sheet(table, &loader))
    }
}

#[derive(Debug, clap::Args)]
pub(crate) struct Envelope {
    /// A tool with its move, or a list of them, in TOML or JSON; `-` reads standard input
    #[arg(default_value = "-")]
    file: String,
    /// Show the move at the ends of so many equal parts of its time instead: poses, grazing curves, the walls up to each
    /// moment; nothing is trimmed
    #[arg(long, value_name = "N", conflicts_with_all = ["out", "svg"],
          value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_INTERVALS)))]
    moments: Option<u32>,
    /// Folder for envelope.html, envelope.stl and envelope.glb (numbered when there are several), made if it is not there
    #[arg(long)]
    out: Option<PathBuf>,
    /// Draw what is swept into this SVG file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl Envelope {
    /// Volumes that tools sweep in a move.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let (text, loader) = files::question(&self.file)?;
        let moves = TextItems::<EnvelopeTable>::read(&self.file, text, ENVELOPE_LIST)?;
        let to = To { out: self.out.as_deref(), svg: self.svg.as_deref(), ..To::default() };
        if let Some(moments) = self.moments {
            return answers(args, to, &moves, |table| growths(table, moments, &loader, &Silent));
        }
        answers(args, to, &moves, |table| envelope_sheets(table, &loader, &Silent).map(Envelopes))
    }
}
