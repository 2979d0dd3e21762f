//! The verb `kinecut schema`: the JSON Schema of an input.

use std::borrow::Cow;

use serde::Serialize;
use serde_json::Value;

use super::Answer;
use crate::job::json_text;
use crate::page::Section;

/// The JSON Schema of an input.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct Schema(pub Value);

impl Answer for Schema {
    fn sections(&self) -> Vec<Section> {
        Vec::new()
    }

    fn data(&self) -> Cow<'_, str> {
        Cow::Owned(json_text(self))
    }
}
