//! Places of the values of a TOML text, by their keys.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::renamed;
use super::unknown::{in_serde_words, nearest};
use super::wrong_type::wrong_type;
use crate::base::{Code, Error, FileId, Finding, Result, Sources, Span};

/// Places of the values of a TOML text, by their keys ("setup[0].operation[1].rough.step").
#[derive(Clone, Debug)]
pub(crate) struct Places {
    file: FileId,
    ranges: BTreeMap<String, Range<usize>>,
    /// Places of files that the job names, by the key that names them, with the key within the file.
    included: BTreeMap<String, (Arc<Places>, String)>,
}

impl Places {
    /// The places of a text that stands in `sources`.
    ///
    /// # Errors
    /// `KC0101` for broken TOML.
    pub(crate) fn read(sources: &Sources, id: FileId) -> Result<Places> {
        parse(sources, id, sources.text(id)).map(|root| Places::of(id, &root))
    }

    pub(super) fn of(file: FileId, root: &Spanned<DeTable<'_>>) -> Places {
        let mut ranges = BTreeMap::new();
        walk_table(root.get_ref(), "", &mut ranges);
        Places { file, ranges, included: BTreeMap::new() }
    }

    /// Adds the places of a file that a key names.
    pub(super) fn include(&mut self, key: &str, file: FileId, root: &Spanned<DeTable<'_>>) {
        self.included.insert(key.to_owned(), (Arc::new(Places::of(file, root)), String::new()));
    }

    /// Adds the places of a part of a file under a key: `own` within the file.
    pub(super) fn include_part(&mut self, key: &str, places: &Arc<Places>, own: &str) {
        self.included.insert(key.to_owned(), (Arc::clone(places), own.to_owned()));
    }

    /// Gives the entries of a list the numbers of another: its entry `i` is that of `origins[i]` in the text.
    pub(super) fn renumber(&mut self, list: &str, origins: &[usize]) {
        let under = |prefix: &str| -> Vec<(String, Range<usize>)> {
            let own = self.ranges.range(prefix.to_owned()..).take_while(|(key, _)| key.starts_with(prefix));
            own.map(|(key, range)| (key[prefix.len()..].to_owned(), range.clone())).collect()
        };
        let all: Vec<Vec<(String, Range<usize>)>> =
            origins.iter().map(|origin| under(&format!("{list}[{origin}]"))).collect();
        let before = format!("{list}[");
        self.ranges.retain(|key, _| !key.starts_with(&before));
        for (i, own) in all.into_iter().enumerate() {
            self.ranges.extend(own.into_iter().map(|(rest, range)| (format!("{list}[{i}]{rest}"), range)));
        }
    }

    /// A note for each key that has a new name, in the order of the keys.
    pub(super) fn renamed(&self, sources: &Sources) -> Vec<Finding> {
        self.ranges
            .keys()
            .filter_map(|key| Some(*self.locate(sources, renamed::note(key)?.into()).0))
            .collect()
    }

    /// The error with the place of its key, or of the nearest key above it.
    pub(crate) fn locate(&self, sources: &Sources, mut error: Error) -> Error {
        if error.0.place.as_ref().is_some_and(|p| p.line > 0) {
            return error;
        }
        let Some(key) = error.0.key.clone() else { return error };
        for (prefix, (places, own)) in &self.included {
            if let Some(rest) = key.strip_prefix(prefix.as_str()).and_then(|r| r.strip_prefix('.')) {
                error.0.key = Some(if own.is_empty() { rest.to_owned() } else { format!("{own}.{rest}") });
                let mut located = places.locate(sources, error);
                located.0.key = Some(key);
                return located;
            }
        }
        let mut at = key.as_str();
        loop {
            let old = || renamed::old_key(at).and_then(|old| self.ranges.get(&old));
            if let Some(range) = self.ranges.get(at).or_else(old) {
                error.0.place = Some(sources.locate(span(self.file, range)));
                return error;
            }
            match at.rfind(['.', '[']) {
                Some(cut) => at = &at[..cut],
                None => return error,
            }
        }
    }
}

pub(crate) fn span(file: FileId, range: &Range<usize>) -> Span {
    Span { file, start: range.start as u32, end: range.end as u32 }
}

fn walk_table(table: &DeTable<'_>, prefix: &str, ranges: &mut BTreeMap<String, Range<usize>>) {
    for (key, value) in table.iter() {
        let name: &str = key.get_ref();
        let path = if prefix.is_empty() { name.to_owned() } else { format!("{prefix}.{name}") };
        // Of a table the key is the better place to point at: its own span may be many lines.
        let range =
            if value.get_ref().is_table() || value.get_ref().is_array() { key.span() } else { value.span() };
        walk_value(value.get_ref(), &path, ranges);
        ranges.insert(path, range);
    }
}

fn walk_value(value: &DeValue<'_>, path: &str, ranges: &mut BTreeMap<String, Range<usize>>) {
    match value {
        DeValue::Table(table) => walk_table(table, path, ranges),
        DeValue::Array(array) => {
            for (i, element) in array.iter().enumerate() {
                let path = format!("{path}[{i}]");
                walk_value(element.get_ref(), &path, ranges);
                ranges.insert(path, element.span());
            }
        }
        _ => {}
    }
}

pub(super) fn parse<'a>(sources: &Sources, id: FileId, text: &'a str) -> Result<Spanned<DeTable<'a>>> {
    DeTable::parse(text).map_err(|e| toml_error(sources, id, Code::JOB_SYNTAX, &e))
}

/// A TOML error as a finding: its place, and for an unknown key the nearest known one.
pub(super) fn toml_error(sources: &Sources, id: FileId, code: Code, error: &toml::de::Error) -> Error {
    let message = error.message().lines().next().unwrap_or("the text cannot be read");
    let (message, help) = wrong_type(message).unwrap_or_else(|| {
        let message = renamed::without_old_names(&in_serde_words(message));
        let help = nearest(&message).unwrap_or_default();
        (message, help)
    });
    let range = error.span().unwrap_or(0..0);
    Finding::error(code, message).at(sources.locate(span(id, &range))).help(help).into()
}
