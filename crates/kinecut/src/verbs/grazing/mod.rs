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

/// The JSON Schema of the input of `kinecut grazing`.
pub fn grazing_schema() -> serde_json::Value {
    let what =
        "What `kinecut grazing` reads: one tool with its motion, a list, or a table with a list `grazing`.";
    crate::job::items::schema::<GrazingTable>("GrazingInput", what, &[GRAZING_LIST])
}

/// Name of a list of tables in a text.
pub const GRAZING_LIST: &str = "grazing";
