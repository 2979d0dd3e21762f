//! Lists of tables of one kind: one table, an array of them (`[[name]]` in TOML, an array in JSON), each item with an error of
//! its own, which keeps its place in the text.

use serde::de::DeserializeOwned;
use serde_json::Value;

use super::read::{Places, TextTables, nearest};
use crate::base::{Code, Error, Finding, Result, Sources};

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
        let mut sources = Sources::default();
        let start = text.trim_start();
        let json = start.starts_with('{')
            || start.strip_prefix('[').is_some_and(|rest| rest.trim_start().starts_with(['{', ']']));
        if json {
            let (values, is_list) = json_values(text, list)?;
            let items = values.into_iter().map(decode).collect();
            return Ok(Items { items, list: is_list.then_some(list), places: None, sources });
        }
        let id = sources.add(name, text);
        let (items, is_list, places) = TextTables::read(&sources, id, list)?;
        Ok(Items { items, list: is_list.then_some(list), places: Some(places), sources })
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

fn json_values(text: &str, list: &str) -> Result<(Vec<Value>, bool)> {
    let value: Value = serde_json::from_str(text)
        .map_err(|e| Finding::error(Code::JOB_SYNTAX, format!("the text is no JSON: {e}")))?;
    Ok(match value {
        Value::Array(values) => (values, true),
        Value::Object(mut map) => match (map.len(), map.remove(list)) {
            (1, Some(Value::Array(values))) => (values, true),
            (_, Some(other)) => {
                map.insert(list.to_owned(), other);
                (vec![Value::Object(map)], false)
            }
            (_, None) => (vec![Value::Object(map)], false),
        },
        one => (vec![one], false),
    })
}

fn decode<T: DeserializeOwned>(value: Value) -> Result<T> {
    serde_path_to_error::deserialize::<_, T>(value).map_err(|e| {
        let message = e.inner().to_string();
        let finding =
            Finding::error(Code::JOB_SHAPE, message.clone()).cure(nearest(&message).unwrap_or_default());
        let path = e.path().to_string();
        Error::from(if path == "." { finding } else { finding.key(path) })
    })
}
