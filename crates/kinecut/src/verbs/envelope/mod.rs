//! The verb `kinecut envelope`: what a tool sweeps in a move, as a sheet of numbers and a mesh for a person or another program.

mod given_move;
mod growth;
mod joints;
mod json;
mod moving;
mod sheet;
pub(crate) mod show;
mod table;
mod walls;

pub use given_move::MoveSource;
pub use growth::{Growth, GrowthMoment, Growths, MOST_INTERVALS, growths};
pub use sheet::{EnteringAt, EnvelopeSheet, envelope_sheets};
pub use walls::WallCell;

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use super::{Answer, page, several_drawings};
use crate::base::{Finding, Result};
use crate::geom::{write_glb, write_stl};
use crate::job::Outputs;
use crate::page::Section;

pub use show::{envelope_html, envelope_svg};
pub use table::*;

/// Question of `kinecut envelope`: one tool with its move, a list, or a table with a list `envelope`.
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

/// The envelopes of one question: one, or of a line of a program one for each of its moves.
#[derive(Clone, Debug)]
pub struct Envelopes(pub Vec<EnvelopeSheet>);

impl Serialize for Envelopes {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Moves<'a> {
            moves: &'a [EnvelopeSheet],
        }
        match &self.0[..] {
            [one] => one.serialize(serializer),
            moves => Moves { moves }.serialize(serializer),
        }
    }
}

impl Answer for Envelopes {
    fn sections(&self) -> Vec<Section> {
        self.0.iter().map(show::section).collect()
    }

    fn findings(&self) -> Vec<&Finding> {
        self.0.iter().flat_map(|sheet| &sheet.findings).collect()
    }

    fn svg(&self) -> Result<String> {
        match &self.0[..] {
            [one] => envelope_svg(one),
            all => Err(several_drawings(all.len())),
        }
    }

    /// The page, and of each envelope the boundary of what is swept in both forms and the envelope untrimmed; numbered when there are several.
    fn files(answers: &[&Envelopes]) -> Result<Outputs> {
        let sheets: Vec<&EnvelopeSheet> = answers.iter().flat_map(|answer| &answer.0).collect();
        let mut outputs = page("envelope.html", envelope_html(&sheets)?);
        for (i, sheet) in sheets.iter().enumerate() {
            let name = if sheets.len() > 1 { format!("envelope-{}", i + 1) } else { "envelope".to_owned() };
            outputs.add(format!("{name}.stl"), write_stl(&sheet.trimmed.mesh));
            outputs.add(format!("{name}.glb"), write_glb(&sheet.trimmed.mesh, None)?);
            outputs.add(format!("{name}-untrimmed.stl"), write_stl(&sheet.envelope.mesh));
        }
        Ok(outputs)
    }
}
