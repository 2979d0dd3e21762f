//! The verb `kinecut envelope`: what a tool sweeps in a move, as a sheet of numbers and a mesh for a person or another program.

mod joints;
mod json;
mod moving;
mod sheet;
pub(crate) mod show;
mod table;
mod walls;
mod way;

pub use moving::MoveSource;
pub use sheet::{EnteringAt, EnvelopeSheet, envelope_sheets};
pub use walls::WallCell;

use schemars::JsonSchema;

pub use show::{envelope_html, envelope_svg, envelope_text};
pub use table::*;

/// What `kinecut envelope` reads: one tool with its move, a list, or a table with a list `envelope`.
#[derive(JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "only its schema is used; texts are decoded item by item")]
enum EnvelopeInput {
    One(Box<EnvelopeTable>),
    List(Vec<EnvelopeTable>),
    Named { envelope: Vec<EnvelopeTable> },
}

/// The JSON Schema of the input of `kinecut envelope`.
pub fn envelope_schema() -> serde_json::Value {
    schemars::schema_for!(EnvelopeInput).to_value()
}

/// Name of a list of tables in a text.
pub const ENVELOPE_LIST: &str = "envelope";
