//! The verb `kinecut grazing`: the grazing curve of a tool at one moment, as a sheet of numbers for a person or another
//! program, and the paper's cases as a gallery.

mod gallery;
mod given_motion;
pub(super) mod json;
mod moment;
mod motion;
mod sheet;
pub(crate) mod show;
mod survey;
mod table;

pub use gallery::{ConesError, GalleryCase, GalleryGroup, PaperClaim, PaperVerdict, gallery};
pub use given_motion::MotionSource;
pub(crate) use sheet::piece_words;
pub use sheet::{GrazingSheet, LoopSheet, SpanSheet, grazing_sheet};
pub use survey::{PieceOutcome, Survey, survey};

pub use show::{gallery_html, gallery_svgs, grazing_html, grazing_svg};
pub use table::*;

use serde::Serialize;

use super::{Answer, page};
use crate::base::{Finding, Result};
use crate::job::Outputs;
use crate::page::Section;

/// The JSON Schema of the input of `kinecut grazing`.
pub fn grazing_schema() -> serde_json::Value {
    let what =
        "The input of `kinecut grazing`: one tool with its motion, a list, or a table with a list `grazing`.";
    crate::job::items::schema::<GrazingTable>("GrazingInput", what, &[GRAZING_LIST])
}

/// Name of a list of tables in a text.
pub const GRAZING_LIST: &str = "grazing";

impl Answer for GrazingSheet {
    fn sections(&self) -> Vec<Section> {
        vec![show::section(self, None)]
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }

    fn svg(&self) -> Result<String> {
        Ok(grazing_svg(self))
    }

    fn files(answers: &[&GrazingSheet]) -> Result<Outputs> {
        Ok(page("grazing.html", grazing_html(answers)))
    }
}

/// The cases of the paper, each beside what was computed.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct Gallery(pub Vec<GalleryGroup>);

impl Answer for Gallery {
    fn sections(&self) -> Vec<Section> {
        show::gallery_sections(&self.0, false)
    }

    fn files(answers: &[&Gallery]) -> Result<Outputs> {
        let mut outputs = Outputs::default();
        for gallery in answers {
            outputs.add("gallery.html", gallery_html(&gallery.0));
            for (name, svg) in gallery_svgs(&gallery.0) {
                outputs.add(&name, svg);
            }
        }
        Ok(outputs)
    }
}
