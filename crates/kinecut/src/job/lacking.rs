//! Keys that the tables of a file must have and lack, all of them at once.

use std::collections::BTreeMap;
use std::ops::Range;

use schemars::JsonSchema;
use schemars::generate::SchemaGenerator;
use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::places::span;
use super::renamed::old_name;
use crate::base::{Code, Error, FileId, Finding, Sources};

/// Beginning of serde's message about a key that a table lacks.
const MISSING: &str = "missing field ";
/// Keys of which a message says what they are.
const DESCRIBED: usize = 12;

/// The keys of a table, with those of the tables in it.
#[derive(Clone, Debug)]
pub(super) struct Keys {
    range: Range<usize>,
    keys: BTreeMap<String, Vec<Keys>>,
}

/// A table that lacks keys.
#[derive(Clone, Debug)]
pub(super) struct Lacking {
    range: Range<usize>,
    /// Each key, and what it is.
    keys: Vec<(String, String)>,
}

impl Keys {
    /// Of a table.
    pub(super) fn of(table: &Spanned<DeTable<'_>>) -> Keys {
        Keys::of_table(table.get_ref(), table.span())
    }

    fn of_table(table: &DeTable<'_>, range: Range<usize>) -> Keys {
        let one = |value: &Spanned<DeValue<'_>>, at: Range<usize>| {
            value.get_ref().as_table().map(|table| Keys::of_table(table, at))
        };
        let within = |key: Range<usize>, value: &Spanned<DeValue<'_>>| match value.get_ref().as_array() {
            Some(array) => array.iter().filter_map(|v| one(v, v.span())).collect(),
            None => one(value, key).into_iter().collect(),
        };
        let keys = table.iter().map(|(key, value)| (key.get_ref().to_string(), within(key.span(), value)));
        Keys { range, keys: keys.collect() }
    }

    /// The tables that lack keys of a type, in the order of the text.
    pub(super) fn lacking<T: JsonSchema>(&self) -> Vec<Lacking> {
        let schema = SchemaGenerator::default().into_root_schema_for::<T>();
        let mut found = Vec::new();
        self.look(schema.as_value(), schema.as_value(), &mut found);
        found.sort_by_key(|l| l.range.start);
        found
    }

    fn look(&self, schema: &Value, root: &Value, found: &mut Vec<Lacking>) {
        let schema = resolved(schema, root);
        let properties = &schema["properties"];
        let required = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
        let has = |key: &str| self.keys.contains_key(key);
        let lacks = required.filter(|key| !has(key) && !old_name(key).is_some_and(has));
        let keys: Vec<(String, String)> =
            lacks.map(|key| (key.to_owned(), first_words(&properties[key], root))).collect();
        if !keys.is_empty() {
            found.push(Lacking { range: self.range.clone(), keys });
        }
        for (key, tables) in &self.keys {
            let of = resolved(&properties[key], root);
            let of = if of["items"].is_object() { &of["items"] } else { of };
            tables.iter().for_each(|table| table.look(of, root, found));
        }
    }
}

/// The schema to which another refers, or the only one beside null.
fn resolved<'a>(schema: &'a Value, root: &'a Value) -> &'a Value {
    let mut at = schema;
    // References do not go in circles without a key between them.
    for _ in 0..8 {
        if let Some(name) = at["$ref"].as_str().and_then(|r| r.strip_prefix("#/$defs/")) {
            at = &root["$defs"][name];
        } else if let Some(any) = at["anyOf"].as_array() {
            let mut real = any.iter().filter(|s| s["type"] != "null");
            match (real.next(), real.next()) {
                (Some(one), None) => at = one,
                _ => break,
            }
        } else {
            break;
        }
    }
    at
}

/// The first sentence of what a key is.
fn first_words(schema: &Value, root: &Value) -> String {
    let own = schema["description"].as_str();
    let text = own.or_else(|| resolved(schema, root)["description"].as_str()).unwrap_or_default();
    let line = text.split("\n\n").next().unwrap_or_default().replace('\n', " ");
    let end = line.find(['.', ';']).unwrap_or(line.len());
    line[..end].trim().to_owned()
}

/// Whether an error of serde is about a key that a table lacks.
pub(super) fn is_missing(message: &str) -> bool {
    message.starts_with(MISSING)
}

/// One error for all tables of a text that lack keys; `None` without any.
pub(super) fn missing(sources: &Sources, id: FileId, all: &[Lacking]) -> Option<Error> {
    let (first, others) = all.split_first()?;
    let quoted = |l: &Lacking| {
        let names: Vec<String> = l.keys.iter().map(|(key, _)| format!("`{key}`")).collect();
        names.join(", ")
    };
    let verb = if first.keys.len() == 1 { "is" } else { "are" };
    let described = first.keys.iter().take(DESCRIBED).filter(|(_, what)| !what.is_empty());
    let mut help: Vec<String> = described.map(|(key, what)| format!("{key}: {what}")).collect();
    for other in others.iter().take(DESCRIBED) {
        let place = sources.locate(span(id, &other.range));
        help.push(format!("line {} lacks {}", place.line, quoted(other)));
    }
    if others.len() > DESCRIBED {
        help.push(format!("{} more tables lack keys", others.len() - DESCRIBED));
    }
    let place = sources.locate(span(id, &first.range));
    let finding = Finding::error(Code::JOB_SHAPE, format!("{} {verb} missing", quoted(first)));
    Some(finding.at(place).help(help.join("; ")).into())
}
