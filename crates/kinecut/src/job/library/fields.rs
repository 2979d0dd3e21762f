//! Fields of a JSON object: those that are asked for are taken, the others are named.

use std::collections::BTreeSet;

use serde_json::Value;

/// Most fields that are named of one tool.
const MOST_NAMED: usize = 100;

/// A JSON object of which some fields are taken. Paths are keys with points between them.
pub(super) struct Fields<'a> {
    value: &'a Value,
    taken: BTreeSet<String>,
}

impl<'a> Fields<'a> {
    pub(super) fn new(value: &'a Value) -> Fields<'a> {
        Fields { value, taken: BTreeSet::new() }
    }

    /// The object.
    pub(super) fn whole(&self) -> &'a Value {
        self.value
    }

    /// The value of a path, without taking it.
    pub(super) fn look(&self, path: &str) -> Option<&'a Value> {
        path.split('.').try_fold(self.value, |value, key| value.get(key)).filter(|value| says(value))
    }

    /// Takes the value of a path, where it says something.
    pub(super) fn take(&mut self, path: &str) -> Option<&'a Value> {
        let value = self.look(path)?;
        self.taken.insert(path.to_owned());
        Some(value)
    }

    /// Takes a text.
    pub(super) fn text(&mut self, path: &str) -> Option<&'a str> {
        let text = self.look(path)?.as_str()?;
        self.take(path).map(|_| text)
    }

    /// Takes a number.
    pub(super) fn number(&mut self, path: &str) -> Option<f64> {
        let number = self.look(path)?.as_f64()?;
        self.take(path).map(|_| number)
    }

    /// The paths that say something and were not taken, in the order of their names.
    pub(super) fn left(&self) -> Vec<String> {
        let mut left = Vec::new();
        self.walk(self.value, "", &mut left);
        if left.len() > MOST_NAMED {
            let more = left.len() - MOST_NAMED;
            left.truncate(MOST_NAMED);
            left.push(format!("{more} more"));
        }
        left
    }

    fn walk(&self, value: &Value, path: &str, left: &mut Vec<String>) {
        if !says(value) || self.taken.contains(path) {
            return;
        }
        match value {
            Value::Object(fields) => {
                for (key, value) in fields {
                    let key: String = key.chars().filter(|c| !c.is_control()).take(60).collect();
                    let path = if path.is_empty() { key } else { format!("{path}.{key}") };
                    self.walk(value, &path, left);
                }
            }
            _ => left.push(path.to_owned()),
        }
    }
}

/// Whether a value says something: null, false, nought and what is empty do not.
pub(super) fn says(value: &Value) -> bool {
    match value {
        Value::Null | Value::Bool(false) => false,
        Value::Bool(true) => true,
        Value::Number(number) => number.as_f64() != Some(0.0),
        Value::String(text) => !text.trim().is_empty(),
        Value::Array(items) => items.iter().any(says),
        Value::Object(fields) => fields.values().any(says),
    }
}

/// A name that is fit for a tool; and whether it was changed.
pub(super) fn fit_name(name: &str) -> (Option<String>, bool) {
    const MOST: usize = 120;
    let clean: String =
        name.trim().chars().map(|c| if c.is_control() { ' ' } else { c }).take(MOST).collect();
    let clean = clean.trim().to_owned();
    let changed = clean != name.trim();
    ((!clean.is_empty()).then_some(clean), changed)
}
