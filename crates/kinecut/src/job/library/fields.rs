//! Fields of a JSON object: those that are asked for are taken, the others are named.

use std::collections::BTreeSet;

use serde_json::Value;

/// Most fields that are named of one tool.
const MOST_NAMED: usize = 100;
/// Most signs that are shown of a key.
const MOST_SHOWN: usize = 60;

/// A JSON object of which some fields are taken. Paths are keys with points between them.
pub(super) struct Fields<'a> {
    value: &'a Value,
    taken: BTreeSet<String>,
}

impl<'a> Fields<'a> {
    pub(super) fn new(value: &'a Value) -> Fields<'a> {
        Fields { value, taken: BTreeSet::new() }
    }

    /// The value of a path, without taking it, whether or not it says something.
    pub(super) fn there(&self, path: &str) -> Option<&'a Value> {
        path.split('.').try_fold(self.value, |value, key| value.get(key))
    }

    /// The value of a path, without taking it.
    pub(super) fn look(&self, path: &str) -> Option<&'a Value> {
        self.there(path).filter(|value| says(value))
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

    /// The fields that say something and were not taken.
    pub(super) fn left(&self) -> Left<'a> {
        let mut left = Left::default();
        left.add(self);
        left
    }

    fn walk(&self, value: &'a Value, path: &mut Vec<&'a str>, left: &mut Left<'a>) {
        let is_taken = |taken: &String| taken.split('.').eq(path.iter().copied());
        if !says(value) || self.taken.iter().any(is_taken) {
            return;
        }
        match value {
            Value::Object(fields) => {
                for (key, value) in fields {
                    path.push(key);
                    self.walk(value, path, left);
                    path.pop();
                }
            }
            _ => left.one(path),
        }
    }
}

/// Fields that were not taken, by their whole paths: the first hundred, and a count of the others.
#[derive(Default)]
pub(super) struct Left<'a> {
    paths: BTreeSet<Vec<&'a str>>,
    more: usize,
}

impl<'a> Left<'a> {
    /// Adds what was not taken of an object.
    pub(super) fn add(&mut self, fields: &Fields<'a>) {
        fields.walk(fields.value, &mut Vec::new(), self);
    }

    fn one(&mut self, path: &[&'a str]) {
        if self.paths.len() < MOST_NAMED {
            self.paths.insert(path.to_vec());
        } else if !self.paths.contains(path) {
            self.more += 1;
        }
    }

    /// The paths in the order of their keys, each behind `before`; keys that are cut end in two points.
    pub(super) fn shown(&self, before: &str) -> Vec<String> {
        let path = |keys: &Vec<&str>| {
            let keys: Vec<String> = keys.iter().map(|key| shown_key(key)).collect();
            format!("{before}{}", keys.join("."))
        };
        let mut all: Vec<String> = self.paths.iter().map(path).collect();
        if self.more > 0 {
            all.push(format!("{before}{} more", self.more));
        }
        all
    }
}

/// A key as it is shown.
fn shown_key(key: &str) -> String {
    let mut shown: String = key.chars().filter(|c| !c.is_control()).take(MOST_SHOWN).collect();
    if key.chars().nth(MOST_SHOWN).is_some() {
        shown.push_str("..");
    }
    shown
}

/// A length as a message shows it [mm]: 76.2, not 76.19999999999999.
pub(super) fn rounded(length: f64) -> f64 {
    (length * 1e4).round() / 1e4
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

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn every_field_is_named_or_counted() {
        let value = json!({ "a": { "b": 1, "c": 2 }, "a.b": 3, "n": 0 });
        let mut fields = Fields::new(&value);
        assert_eq!((fields.number("a.b"), fields.number("n")), (Some(1.0), None));
        // A key with a point is another one.
        assert_eq!(fields.left().shown(""), ["a.c", "a.b"]);
        // Two long keys with one beginning are two.
        let long = "k".repeat(MOST_SHOWN);
        let value = json!({ format!("{long}1"): 1, format!("{long}2"): 1, long.clone(): 1 });
        let mut fields = Fields::new(&value);
        fields.take(&long);
        assert_eq!(fields.left().shown("p."), vec![format!("p.{long}.."); 2]);
        let many: serde_json::Map<String, Value> = (0..250).map(|i| (format!("f{i}"), json!(1))).collect();
        let many = Value::Object(many);
        let shown = Fields::new(&many).left().shown("");
        assert_eq!((shown.len(), shown[MOST_NAMED].as_str()), (MOST_NAMED + 1, "150 more"));
        // The same fields of many objects are named once.
        let mut left = Left::default();
        (0..3).for_each(|_| left.add(&Fields::new(&value)));
        assert_eq!(left.shown("").len(), 3);
    }
}
