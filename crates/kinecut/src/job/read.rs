//! Job text to [`JobFile`], with the place of every key.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::file::{JobFile, MachineEntry, MachineTable};
use super::items::FromToml;
use super::renamed;
use super::unknown::{in_serde_words, nearest};
use crate::base::{Code, Error, FileId, Finding, Loader, Result, Sources, Span};
use crate::operations::{Decode, OperationTable};

/// A job file as read: its content, and where each key stands.
#[derive(Clone, Debug)]
pub struct JobText {
    /// The content.
    pub file: JobFile,
    /// The source text in the run's sources.
    pub id: FileId,
    places: Places,
}

/// Where each value of a TOML text stands, by its key ("setup[0].operation[1].rough.step").
#[derive(Clone, Debug)]
pub(crate) struct Places {
    file: FileId,
    ranges: BTreeMap<String, Range<usize>>,
    /// Places of files that the job names, by the key that names them.
    included: BTreeMap<String, Places>,
}

impl JobText {
    /// Reads a job text that stands in `sources`; files that it names come through `loader`.
    ///
    /// # Errors
    /// `KC0101` for broken TOML, `KC0102` for unknown or missing keys and wrong types, each with its place;
    /// the loader's errors for a machine file.
    pub fn read(sources: &mut Sources, id: FileId, loader: &dyn Loader) -> Result<JobText> {
        let text = sources.text(id).to_owned();
        let mut root = parse(sources, id, &text)?;
        let mut places = Places::of(id, &root);
        let operations = take_operations(root.get_mut());
        let machine = root.get_mut().remove("machine");
        let mut file: JobFile = decode(sources, id, root)?;
        for (s, tables) in operations.into_iter().enumerate() {
            for table in tables {
                let operation = decode_operation(sources, id, table)?;
                file.setups[s].operations.push(operation);
            }
        }
        file.machine = match machine.map(|m| (m.span(), m.into_inner())) {
            None => None,
            Some((_, DeValue::String(name))) => {
                let name = name.into_owned();
                let text = loader.read_text(&name).map_err(|e| places.locate(sources, e.under("machine")))?;
                let file_name = name.clone();
                let machine_id = sources.add(name, text.clone());
                let table = parse(sources, machine_id, &text)?;
                places.included.insert("machine".to_owned(), Places::of(machine_id, &table));
                let mut table = decode::<MachineTable>(sources, machine_id, table)?;
                in_folder_of(&file_name, &mut table);
                Some(MachineEntry::Table(Box::new(table)))
            }
            Some((span, value)) => {
                let table = decode::<MachineTable>(sources, id, table_of(sources, id, span, value)?)?;
                Some(MachineEntry::Table(Box::new(table)))
            }
        };
        Ok(JobText { file, id, places })
    }

    /// A note for each key that has a new name.
    pub fn renamed(&self, sources: &Sources) -> Vec<Finding> {
        renamed::notes(&self.places, sources)
    }

    /// An error or finding with the place of its key.
    pub fn locate(&self, sources: &Sources, error: Error) -> Error {
        self.places.locate(sources, error)
    }
}

/// Names of files in a machine file count from its own folder.
fn in_folder_of(file: &str, table: &mut MachineTable) {
    let Some((folder, _)) = file.rsplit_once('/') else { return };
    for mesh in table.bodies.iter_mut().filter_map(|body| body.mesh.as_mut()) {
        *mesh = format!("{folder}/{mesh}");
    }
}

/// Reads a table from a text of its own, which stands in `sources`; its check gets the place of its key.
///
/// # Errors
/// As [`JobText::read`], and those of `check`.
pub(crate) fn read_table<T: serde::de::DeserializeOwned, U>(
    sources: &Sources,
    id: FileId,
    check: impl FnOnce(&T) -> Result<U>,
) -> Result<U> {
    let root = parse(sources, id, sources.text(id))?;
    let places = Places::of(id, &root);
    let table: T = decode(sources, id, root)?;
    check(&table).map_err(|e| places.locate(sources, e))
}

/// Tables of a text, each or its error; the name of their list, if they are one; where their values stand.
pub(crate) type TablesRead<T> = (Vec<Result<T>>, Option<&'static str>, Places);

/// Reads one table, or those of a list of one of the names `lists`, from a TOML text; `item` makes one of a table.
pub(crate) fn text_tables<T>(
    sources: &Sources,
    id: FileId,
    lists: &[&'static str],
    item: FromToml<T>,
) -> Result<TablesRead<T>> {
    let mut root = parse(sources, id, sources.text(id))?;
    let places = Places::of(id, &root);
    let is_list = |name: &&str| {
        root.get_ref().len() == 1
            && root.get_ref().get(*name).is_some_and(|h| matches!(h.get_ref(), DeValue::Array(_)))
    };
    let Some(list) = lists.iter().copied().find(is_list) else {
        return Ok((vec![item(sources, id, root)], None, places));
    };
    let Some(DeValue::Array(values)) = root.get_mut().remove(list).map(Spanned::into_inner) else {
        return Ok((Vec::new(), Some(list), places));
    };
    let one = |v: Spanned<DeValue<'_>>| item(sources, id, table_of(sources, id, v.span(), v.into_inner())?);
    Ok((values.into_iter().map(one).collect(), Some(list), places))
}

impl Places {
    /// The places of a text that stands in `sources`.
    ///
    /// # Errors
    /// `KC0101` for broken TOML.
    pub(crate) fn read(sources: &Sources, id: FileId) -> Result<Places> {
        parse(sources, id, sources.text(id)).map(|root| Places::of(id, &root))
    }

    fn of(file: FileId, root: &Spanned<DeTable<'_>>) -> Places {
        let mut ranges = BTreeMap::new();
        walk_table(root.get_ref(), "", &mut ranges);
        Places { file, ranges, included: BTreeMap::new() }
    }

    /// All keys, in alphabetical order.
    pub(super) fn keys(&self) -> impl Iterator<Item = &String> {
        self.ranges.keys()
    }

    /// The error with the place of its key, or of the nearest key above it.
    pub(crate) fn locate(&self, sources: &Sources, mut error: Error) -> Error {
        if error.0.place.as_ref().is_some_and(|p| p.line > 0) {
            return error;
        }
        let Some(key) = error.0.key.clone() else { return error };
        for (prefix, places) in &self.included {
            if let Some(rest) = key.strip_prefix(prefix.as_str()).and_then(|r| r.strip_prefix('.')) {
                error.0.key = Some(rest.to_owned());
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

fn parse<'a>(sources: &Sources, id: FileId, text: &'a str) -> Result<Spanned<DeTable<'a>>> {
    DeTable::parse(text).map_err(|e| toml_error(sources, id, Code::JOB_SYNTAX, &e))
}

pub(crate) fn decode<'de, T: Deserialize<'de>>(
    sources: &Sources,
    id: FileId,
    table: Spanned<DeTable<'de>>,
) -> Result<T> {
    T::deserialize(Deserializer::from(table)).map_err(|e| toml_error(sources, id, Code::JOB_SHAPE, &e))
}

/// Takes the operations out of their setups: each is decoded for itself, so that errors keep their place.
fn take_operations<'a>(root: &mut DeTable<'a>) -> Vec<Vec<Spanned<DeValue<'a>>>> {
    let Some(setups) = root.get_mut("setup") else { return Vec::new() };
    let DeValue::Array(setups) = setups.get_mut() else { return Vec::new() };
    let take = |setup: &mut Spanned<DeValue<'a>>| -> Vec<Spanned<DeValue<'a>>> {
        let DeValue::Table(table) = setup.get_mut() else { return Vec::new() };
        match table.get("operation").map(Spanned::get_ref) {
            Some(DeValue::Array(_)) => match table.remove("operation").map(Spanned::into_inner) {
                Some(DeValue::Array(operations)) => operations.into_iter().collect(),
                _ => Vec::new(),
            },
            _ => Vec::new(),
        }
    };
    setups.iter_mut().map(take).collect()
}

fn table_of<'a>(
    sources: &Sources,
    id: FileId,
    range: Range<usize>,
    value: DeValue<'a>,
) -> Result<Spanned<DeTable<'a>>> {
    match value {
        DeValue::Table(table) => Ok(Spanned::new(range, table)),
        other => {
            Err(Finding::error(Code::JOB_SHAPE, format!("expected a table, found {}", other.type_str()))
                .at(sources.locate(span(id, &range)))
                .into())
        }
    }
}

pub(crate) fn decode_operation(
    sources: &Sources,
    id: FileId,
    value: Spanned<DeValue<'_>>,
) -> Result<OperationTable> {
    let range = value.span();
    let mut table = table_of(sources, id, range.clone(), value.into_inner())?;
    let kind = table.get_mut().remove("type");
    let fail = |message: String, range: &Range<usize>| {
        Err(Finding::error(Code::JOB_SHAPE, message)
            .at(sources.locate(span(id, range)))
            .help(format!("write type = \"{}\"", OperationTable::NAMES.join("\" or \"")))
            .into())
    };
    let Some(kind) = kind else { return fail("an operation has no type".to_owned(), &range) };
    match kind.get_ref().as_str() {
        Some(name) => OperationTable::of_kind(name, InText { sources, id, table })
            .unwrap_or_else(|| fail(format!("unknown operation `{name}`"), &kind.span())),
        None => fail("the type of an operation must be a text".to_owned(), &kind.span()),
    }
}

/// A table of a text.
struct InText<'a, 'de> {
    sources: &'a Sources,
    id: FileId,
    table: Spanned<DeTable<'de>>,
}

impl Decode for InText<'_, '_> {
    fn table<T: serde::de::DeserializeOwned>(self) -> Result<T> {
        decode(self.sources, self.id, self.table)
    }
}

/// A TOML error as a finding: its place, and for an unknown key the nearest known one.
fn toml_error(sources: &Sources, id: FileId, code: Code, error: &toml::de::Error) -> Error {
    let message = error.message().lines().next().unwrap_or("the text cannot be read");
    let message = renamed::without_old_names(&in_serde_words(message));
    let help = nearest(&message).unwrap_or_default();
    let range = error.span().unwrap_or(0..0);
    Finding::error(code, message).at(sources.locate(span(id, &range))).help(help).into()
}
