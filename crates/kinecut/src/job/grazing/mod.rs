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
pub use sheet::{GrazingSheet, LoopSheet, SpanSheet, grazing_sheet};
pub use survey::{Outcome, Survey, survey};

use schemars::JsonSchema;

use super::file::{ContourTable, GrazingTable};
use crate::base::{Loader, Result};
use crate::tool::Contour;

/// What `kinecut grazing` reads: one tool with its motion, a list, or a table with a list `grazing`.
#[derive(JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "only its schema is used; texts are decoded item by item")]
enum GrazingInput {
    One(Box<GrazingTable>),
    List(Vec<GrazingTable>),
    Named { grazing: Vec<GrazingTable> },
}

/// The JSON Schema of the input of `kinecut grazing`.
pub fn grazing_schema() -> serde_json::Value {
    schemars::schema_for!(GrazingInput).to_value()
}

/// Name of a list of tables in a text.
pub const GRAZING_LIST: &str = "grazing";

/// The tool of a table.
fn tool(table: &ContourTable, _loader: &dyn Loader) -> Result<Contour> {
    use crate::tool::{ContourElement, Role};
    let ContourTable::Elements { elements } = table;
    let one = |e: &Vec<f64>| match e[..] {
        [x0, z0, x1, z1] => ContourElement::line([x0, z0], [x1, z1], Role::Cutting),
        [x, z, r, a, b] => ContourElement::arc([x, z], r, a.to_radians(), b.to_radians(), Role::Cutting),
        _ => ContourElement::line([0.0; 2], [0.0; 2], Role::Cutting),
    };
    Contour::new(elements.iter().map(one).collect())
}

fn of_tool(_: &crate::tool::Tool) -> Result<Contour> {
    Contour::new(Vec::new())
}
