//! Lists of tables of one kind: one table, an array of them (`[[name]]` in TOML, an array in JSON), each item with an error of
//! its own, which keeps its place in the text.

use schemars::JsonSchema;
use schemars::generate::SchemaGenerator;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use toml::Spanned;
use toml::de::DeTable;

use super::read::{Places, decode, nearest, text_tables};
use crate::base::{Code, Error, FileId, Finding, Result, Sources};

/// How a table of a TOML text becomes an item.
pub(crate) type FromToml<T> = fn(&Sources, FileId, Spanned<DeTable<'_>>) -> Result<T>;

/// Tables as read.
#[derive(Clone, Debug)]
pub struct Items<T> {
    /// Each as read, or why it cannot be.
    pub items: Vec<Result<T>>,
    /// Name of the list, if the text has one.
    pub list: Option<&'static str>,
    places: Option<Places>,
    sources: Sources,
}

impl<T: DeserializeOwned> Items<T> {
    /// Reads a text of TOML or JSON; it is JSON when it begins like JSON. A list is called `list`.
    ///
    /// # Errors
    /// `KC0101` for a text that is neither. What is wrong with one item stands in its place.
    pub fn read(name: &str, text: &str, list: &'static str) -> Result<Items<T>> {
        Items::read_named(name, text, &[list], |sources, id, table| decode(sources, id, table))
    }

    /// As [`Items::read`] with a list of any of the names `lists`, and items of TOML texts made by `from_toml`. A list without
    /// a name takes the first.
    ///
    /// # Errors
    /// As [`Items::read`].
    pub(crate) fn read_named(
        name: &str,
        text: &str,
        lists: &[&'static str],
        from_toml: FromToml<T>,
    ) -> Result<Items<T>> {
        let mut sources = Sources::default();
        let start = text.trim_start();
        let json = start.starts_with('{')
            || start.strip_prefix('[').is_some_and(|rest| rest.trim_start().starts_with(['{', ']']));
        if json {
            let (values, list) = json_values(text, lists)?;
            let items = values.into_iter().map(from_json).collect();
            return Ok(Items { items, list, places: None, sources });
        }
        let id = sources.add(name, text);
        let (items, list, places) = text_tables(&sources, id, lists, from_toml)?;
        Ok(Items { items, list, places: Some(places), sources })
    }

    /// An item's error with its place in the text.
    pub fn locate(&self, index: usize, error: Error) -> Error {
        let error = match self.list {
            Some(list) => error.under(&format!("{list}[{index}]")),
            None => error,
        };
        match &self.places {
            Some(places) => places.locate(&self.sources, error),
            None => error,
        }
    }
}

/// The JSON Schema of a text of items: one, an array of them, or a table with an array of one of the names `lists`.
pub(crate) fn schema<T: JsonSchema>(title: &str, description: &str, lists: &[&str]) -> Value {
    let mut generator = SchemaGenerator::default();
    let one = generator.subschema_for::<T>();
    let array = json!({ "items": one, "type": "array" });
    let named = lists
        .iter()
        .map(|&list| json!({ "properties": { list: array }, "required": [list], "type": "object" }));
    let any: Vec<Value> = [json!(one), array.clone()].into_iter().chain(named).collect();
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "description": description,
        "anyOf": any,
        "$defs": generator.take_definitions(true),
    })
}

fn json_values(text: &str, lists: &[&'static str]) -> Result<(Vec<Value>, Option<&'static str>)> {
    let value: Value = serde_json::from_str(text)
        .map_err(|e| Finding::error(Code::JOB_SYNTAX, format!("the text is no JSON: {e}")))?;
    Ok(match value {
        Value::Array(values) => (values, lists.first().copied()),
        Value::Object(mut map) => {
            let is_list = |name: &&str| map.len() == 1 && map.get(*name).is_some_and(Value::is_array);
            match lists.iter().copied().find(is_list).map(|list| (list, map.remove(list))) {
                Some((list, Some(Value::Array(values)))) => (values, Some(list)),
                _ => (vec![Value::Object(map)], None),
            }
        }
        one => (vec![one], None),
    })
}

fn from_json<T: DeserializeOwned>(value: Value) -> Result<T> {
    serde_path_to_error::deserialize::<_, T>(value).map_err(|e| {
        let message = e.inner().to_string();
        let finding =
            Finding::error(Code::JOB_SHAPE, message.clone()).cure(nearest(&message).unwrap_or_default());
        let path = e.path().to_string();
        Error::from(if path == "." { finding } else { finding.key(path) })
    })
}
