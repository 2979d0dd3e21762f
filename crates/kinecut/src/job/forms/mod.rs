//! Forms of the values that the keys of a file take, from its JSON schema: in words, with their unit and an example.
//!
//! The doc comments of the tables are the one place of what a key is and of its unit; `#[schemars(example = ..)]` is that of
//! its example. Both reach editors through `kinecut schema`.

mod example;
mod fit;
mod inches;
mod mend;
mod unit;
mod words;

#[cfg(test)]
mod tests;

use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

pub(super) use example::toml_text;
pub(super) use fit::{KeyAt, Misfit};
pub(super) use inches::{InMm, factors};
pub(super) use unit::{Unit, number_with_unit};
pub(super) use words::given;

/// The form of a value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Form<'a> {
    /// The schema as it is beside its key.
    beside: &'a Value,
    /// The schema to which that refers.
    own: &'a Value,
    root: &'a Value,
    /// The words about the nearest key.
    about: &'a str,
}

/// Kind of a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind<'a> {
    /// A number.
    Number,
    /// A whole number.
    Whole,
    /// Any text.
    Text,
    /// True or false.
    Truth,
    /// One word.
    Word(&'a str),
    /// A list.
    List,
    /// A table.
    Table,
    /// One of several forms.
    Choice,
    /// Anything.
    Any,
}

impl<'a> Form<'a> {
    /// Of a whole file.
    pub(super) fn of_root(root: &'a Value) -> Form<'a> {
        Form { beside: root, own: root, root, about: "" }.with(root)
    }

    /// That of a schema within this one.
    fn with(self, schema: &'a Value) -> Form<'a> {
        let own = resolved(schema, self.root);
        let described = schema["description"].as_str().or_else(|| own["description"].as_str());
        Form { beside: schema, own, about: described.unwrap_or(self.about), ..self }
    }

    /// Its kind.
    pub(super) fn kind(self) -> Kind<'a> {
        if let Some(word) = self.own["const"].as_str() {
            return Kind::Word(word);
        }
        if ["oneOf", "anyOf", "enum"].iter().any(|key| self.own[*key].is_array()) {
            return Kind::Choice;
        }
        let kind = &self.own["type"];
        let listed = || kind.as_array()?.iter().filter_map(Value::as_str).find(|t| *t != "null");
        match kind.as_str().or_else(listed) {
            Some("number") => Kind::Number,
            Some("integer") => Kind::Whole,
            Some("string") => Kind::Text,
            Some("boolean") => Kind::Truth,
            Some("array") => Kind::List,
            Some("object") => Kind::Table,
            _ => Kind::Any,
        }
    }

    /// The forms of which it is one, none of them a choice itself; itself where it is no choice.
    pub(super) fn choices(self) -> Vec<Form<'a>> {
        let mut all = Vec::new();
        self.add_choices(&mut all);
        all
    }

    fn add_choices(self, all: &mut Vec<Form<'a>>) {
        let of = |key: &str| self.own[key].as_array();
        if let Some(words) = of("enum") {
            let root = self.root;
            all.extend(words.iter().map(|word| Form { beside: word, own: word, root, about: self.about }));
            return;
        }
        match of("oneOf").or_else(|| of("anyOf")) {
            None => all.push(self),
            Some(several) => several
                .iter()
                .filter(|schema| schema["type"] != "null")
                .for_each(|schema| self.with(schema).add_choices(all)),
        }
    }

    /// The form that a value is meant to have; `None` where that cannot be said.
    pub(super) fn meant<'v>(self, value: &'v Spanned<DeValue<'v>>) -> Option<Form<'a>> {
        if self.kind() != Kind::Choice {
            return Some(self);
        }
        if let DeValue::Table(table) = value.get_ref() {
            return self.meant_table(table);
        }
        let choices = self.choices();
        let mut fitting = choices.iter().filter(|form| form.misfit(value).is_none_or(|m| m.is_within()));
        match (fitting.next(), fitting.next()) {
            (Some(one), None) => Some(*one),
            (Some(one), Some(_)) if one.misfit(value).is_none() => Some(*one),
            _ => None,
        }
    }

    /// The form that a table is meant to have: that of its type, or the one with most of its keys.
    pub(super) fn meant_table(self, table: &DeTable<'_>) -> Option<Form<'a>> {
        if self.kind() != Kind::Choice {
            return Some(self);
        }
        let shared = |form: &Form<'_>| table.keys().filter(|k| form.key(k.get_ref()).is_some()).count();
        let choices = self.choices();
        let tables = choices.iter().filter(|form| form.kind() == Kind::Table && form.is_of_type(table));
        let best = tables.clone().max_by_key(|form| shared(form))?;
        (shared(best) > 0 || tables.count() == 1).then_some(*best)
    }

    /// Whether the type that a table says is the one of this form.
    fn is_of_type(self, table: &DeTable<'_>) -> bool {
        let wanted = self.own["properties"]["type"]["const"].as_str();
        let said = table.get("type").and_then(|value| value.get_ref().as_str());
        wanted.is_none_or(|wanted| said == Some(wanted))
    }

    /// That of a key of its tables.
    pub(super) fn key(self, key: &str) -> Option<Form<'a>> {
        match self.own["properties"].get(key) {
            Some(schema) => Some(self.with(schema)),
            None => {
                let any = &self.own["additionalProperties"];
                any.is_object().then(|| self.with(any))
            }
        }
    }

    /// The keys that its tables may have, where there are no others.
    fn known(self) -> Option<Vec<&'a str>> {
        let closed = self.own["additionalProperties"] == false;
        closed.then(|| self.keys().map(|(key, _)| key).collect())
    }

    /// The keys of its tables with their forms.
    pub(super) fn keys(self) -> impl Iterator<Item = (&'a str, Form<'a>)> {
        let properties = self.own["properties"].as_object();
        properties.into_iter().flatten().map(move |(key, schema)| (key.as_str(), self.with(schema)))
    }

    /// The keys that its tables must have.
    pub(super) fn required(self) -> impl Iterator<Item = &'a str> {
        self.own["required"].as_array().into_iter().flatten().filter_map(Value::as_str)
    }

    /// That of the items of its lists.
    pub(super) fn item(self) -> Form<'a> {
        self.with(&self.own["items"])
    }

    /// The least and the largest number of items.
    pub(super) fn counts(self) -> (u64, u64) {
        let count = |key: &str| self.own[key].as_u64();
        (count("minItems").unwrap_or(0), count("maxItems").unwrap_or(u64::MAX))
    }

    /// Least and largest value of a whole number.
    fn bounds(self) -> (Option<f64>, Option<f64>) {
        (self.own["minimum"].as_f64(), self.own["maximum"].as_f64())
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
