//! The verb `kinecut grazing`: the grazing curve of a tool at one moment, as a sheet of numbers for a person or another
//! program, and the paper's cases as a gallery.

mod gallery;
mod json;
mod moment;
mod motion;
mod sheet;
pub(crate) mod show;
mod survey;
mod table;

pub use gallery::{GalleryCase, GalleryGroup, PaperClaim, PaperVerdict, gallery};
pub use json::{kind_name, role_name};
pub use motion::MotionSource;
pub(crate) use motion::rows;
pub(crate) use sheet::piece_words;
pub use sheet::{GrazingSheet, LoopSheet, SpanSheet, grazing_sheet};
pub use survey::{Outcome, Survey, survey};

pub use show::{
    gallery_html, gallery_json, gallery_svgs, gallery_text, grazing_html, grazing_svg, grazing_text,
};
pub use table::*;

use serde::{Serialize, Serializer};

use super::{Answer, page};
use crate::base::{Finding, Result};
use crate::job::Outputs;

/// The JSON Schema of the input of `kinecut grazing`.
pub fn grazing_schema() -> serde_json::Value {
    let what =
        "What `kinecut grazing` reads: one tool with its motion, a list, or a table with a list `grazing`.";
    crate::job::items::schema::<GrazingTable>("GrazingInput", what, &[GRAZING_LIST])
}

/// Name of a list of tables in a text.
pub const GRAZING_LIST: &str = "grazing";

impl Answer for GrazingSheet {
    fn text(&self) -> String {
        grazing_text(self)
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
#[derive(Clone, Debug)]
pub struct Gallery(pub Vec<GalleryGroup>);

impl Serialize for Gallery {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        gallery_json(&self.0).serialize(serializer)
    }
}

impl Answer for Gallery {
    fn text(&self) -> String {
        gallery_text(&self.0)
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
