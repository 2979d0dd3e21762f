//! The verb `kinecut grazing`: the grazing curve of a tool at one moment, as a sheet of numbers for a person or another
//! program, and the paper's cases as a gallery.

mod gallery;
mod json;
mod moment;
mod motion;
mod sheet;
mod survey;

pub use gallery::{GalleryCase, GalleryGroup, PaperClaim, PaperVerdict, gallery};
pub use json::{kind_name, role_name};
pub use motion::MotionSource;
pub(super) use motion::rows;
pub(super) use sheet::piece_words;
pub use sheet::{GrazingSheet, LoopSheet, SpanSheet, grazing_sheet};
pub use survey::{Outcome, Survey, survey};

use super::file::GrazingTable;

/// The JSON Schema of the input of `kinecut grazing`.
pub fn grazing_schema() -> serde_json::Value {
    let what =
        "What `kinecut grazing` reads: one tool with its motion, a list, or a table with a list `grazing`.";
    super::items::schema::<GrazingTable>("GrazingInput", what, &[GRAZING_LIST])
}

/// Name of a list of tables in a text.
pub const GRAZING_LIST: &str = "grazing";
