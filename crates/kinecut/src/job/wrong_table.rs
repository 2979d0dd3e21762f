//! The error of a table that has not the form of its type: all keys that it lacks, or the value that is wrong.

#[cfg(test)]
mod tests;

use std::collections::BTreeSet;
use std::ops::Range;

use schemars::JsonSchema;
use schemars::generate::SchemaGenerator;
use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::file::{MachineTable, ToolLibraryTable};
use super::forms::{Form, KeyAt, Kind, Misfit};
use super::lacking::{Lacking, in_place_of, is_missing, lacking, missing, others_in_words};
use super::places::{parse, span, toml_error};
use super::unknown::{nearest, unknown_field};
use super::wrong_value::wrong_value;
use crate::base::{Code, Error, FileId, Finding, Loader, Sources};

/// The error of a table at `range` of a text that cannot be decoded as a `T`; `error` is what serde has met first. Other tables that
/// lack keys are in its help.
pub(super) fn wrong_table<T: JsonSchema>(
    sources: &Sources,
    id: FileId,
    range: &Range<usize>,
    error: &toml::de::Error,
) -> Error {
    let mut told = toml_error(sources, id, Code::JOB_SHAPE, error);
    let Ok(root) = parse(sources, id, sources.text(id)) else { return told };
    let Some(table) = table_at(&root, range) else { return told };
    let schema = schema::<T>();
    let Some(form) = Form::of_root(&schema).meant_table(table) else { return told };
    let lacks = lacking(table, range.clone(), form);
    if let (true, Some(error)) = (is_missing(error.message()), missing(sources, id, &lacks)) {
        return error;
    }
    let place = error.span().and_then(|span| place_of(table, form, &span));
    // Other messages are a type's own, or about names that are not known.
    if ["invalid ", "data did not match", "wanted "].iter().any(|begin| error.message().starts_with(begin)) {
        // A value that serde has kept for a second reading has lost its place.
        let misfit = match &place {
            Some(place) => place.at.form.misfit(place.at.value),
            None => form.misfit_in(table),
        };
        let at = place.as_ref().map(|place| place.at);
        match misfit.map(|misfit| (misfit.keys.last().copied().or(at), misfit)) {
            Some((_, Misfit { unknown: Some((unknown, known)), range, .. })) => {
                told.0.message = unknown_field(unknown, &known);
                told.0.help = nearest(&told.0.message).unwrap_or_default();
                told.0.place = Some(sources.locate(span(id, &range)));
            }
            Some((Some(at), misfit)) => {
                // A type may say itself what it takes.
                let said = error.message().split_once(", expected ").map(|(_, said)| said);
                let said = said.filter(|said| said.starts_with("the "));
                (told.0.message, told.0.help) = wrong_value(&misfit, at, said);
                told.0.place = Some(sources.locate(span(id, &misfit.range)));
            }
            _ if error.message().starts_with("data did not match") => {
                if let Some(error) = missing(sources, id, &lacks) {
                    return error;
                }
            }
            _ => {}
        }
    }
    let others = without_named(lacks, &told.0.message);
    let words = others_in_words(sources, id, &others, "", BTreeSet::new());
    add_help(&mut told, words);
    told
}

/// The error of the first list of a text that is longer than its key takes; serde leaves the rest of it unread.
pub(super) fn too_long<T: JsonSchema>(
    sources: &Sources,
    id: FileId,
    root: &Spanned<DeTable<'_>>,
) -> Option<Error> {
    let schema = schema::<T>();
    let at = long_list(root.get_ref(), Form::of_root(&schema))?;
    let misfit = at.form.misfit(at.value)?;
    let (message, help) = wrong_value(&misfit, at, None);
    let place = sources.locate(span(id, &misfit.range));
    Some(Finding::error(Code::JOB_SHAPE, message).at(place).help(help).into())
}

/// The first key of a table, or of one in it, with a list that is too long.
fn long_list<'v, 'a>(table: &'v DeTable<'v>, form: Form<'a>) -> Option<KeyAt<'v, 'a>> {
    table.iter().find_map(|(name, value)| {
        let key: &str = name.get_ref();
        let own = form.key(key)?;
        if is_long(value, own) {
            return Some(KeyAt { key, within: form, form: own, value });
        }
        long_within(value, own)
    })
}

fn long_within<'v, 'a>(value: &'v Spanned<DeValue<'v>>, form: Form<'a>) -> Option<KeyAt<'v, 'a>> {
    match value.get_ref() {
        DeValue::Table(table) => long_list(table, form.meant_table(table)?),
        DeValue::Array(list) if form.meant(value)?.kind() == Kind::List => {
            let item = form.meant(value)?.item();
            list.iter().find_map(|value| long_within(value, item))
        }
        _ => None,
    }
}

fn is_long<'v>(value: &'v Spanned<DeValue<'v>>, form: Form<'_>) -> bool {
    let DeValue::Array(list) = value.get_ref() else { return false };
    let Some(form) = form.meant(value).filter(|form| form.kind() == Kind::List) else { return false };
    list.len() as u64 > form.counts().1 || list.iter().any(|item| is_long(item, form.item()))
}

/// The tables without a key in place of which a message has an unknown one: it is not missing.
fn without_named(lacks: Vec<Lacking>, message: &str) -> Vec<Lacking> {
    let unknown = message.strip_prefix("unknown field `").and_then(|rest| rest.split('`').next());
    let Some(unknown) = unknown else { return lacks };
    let end = in_place_of(unknown);
    let mut lacks = lacks;
    lacks.iter_mut().for_each(|table| table.keys.retain(|(_, write)| !write.ends_with(&end)));
    lacks.retain(|table| !table.keys.is_empty());
    lacks
}

/// An error of a job with the keys that are missing in its other files: that of its machine and those of its tools.
pub(super) fn with_other_files(
    sources: &Sources,
    id: FileId,
    loader: &dyn Loader,
    mut error: Error,
) -> Error {
    if error.code() != Code::JOB_SHAPE {
        return error;
    }
    let Ok(root) = parse(sources, id, sources.text(id)) else { return error };
    let root = root.get_ref();
    let own = error.0.place.as_ref().map_or_else(String::new, |place| place.file.clone());
    let mut words = Vec::new();
    let named = |key: &str| root.get(key).map(names).unwrap_or_default();
    let machine = named("machine").into_iter().map(|name| (name, schema::<MachineTable> as fn() -> Value));
    let tools = named("tools").into_iter().map(|name| (name, schema::<ToolLibraryTable> as fn() -> Value));
    for (name, schema) in machine.chain(tools).filter(|(name, _)| *name != own && name.ends_with(".toml")) {
        let Ok(text) = loader.read_text(&name) else { continue };
        let mut sources = Sources::default();
        let id = sources.add(name.as_str(), text.as_str());
        let Ok(root) = parse(&sources, id, &text) else { continue };
        let schema = schema();
        let lacks = lacking(root.get_ref(), root.span(), Form::of_root(&schema));
        words.extend(others_in_words(&sources, id, &lacks, &format!("{name} "), BTreeSet::new()));
    }
    add_help(&mut error, words);
    error
}

/// The names of files that a value has: a text, `file` of a table, or a list of these.
pub(super) fn names(value: &Spanned<DeValue<'_>>) -> Vec<String> {
    match value.get_ref() {
        DeValue::String(name) => vec![name.to_string()],
        DeValue::Table(table) => table.get("file").map(names).unwrap_or_default(),
        DeValue::Array(list) => list.iter().flat_map(names).collect(),
        _ => Vec::new(),
    }
}

fn add_help(error: &mut Error, words: Vec<String>) {
    if words.is_empty() {
        return;
    }
    let words = words.join("; ");
    let help = &mut error.0.help;
    *help = match help.chars().last() {
        None => words,
        Some('?') => format!("{help} {}{}", words[..1].to_uppercase(), &words[1..]),
        Some(_) => format!("{help}; {words}"),
    };
}

fn schema<T: JsonSchema>() -> Value {
    SchemaGenerator::default().into_root_schema_for::<T>().to_value()
}

/// The table at a range of a text.
fn table_at<'a, 'de>(root: &'a Spanned<DeTable<'de>>, range: &Range<usize>) -> Option<&'a DeTable<'de>> {
    fn within<'a, 'de>(table: &'a DeTable<'de>, range: &Range<usize>) -> Option<&'a DeTable<'de>> {
        table.values().find_map(|value| of_value(value, range))
    }
    fn of_value<'a, 'de>(value: &'a Spanned<DeValue<'de>>, range: &Range<usize>) -> Option<&'a DeTable<'de>> {
        match value.get_ref() {
            DeValue::Table(table) if value.span() == *range => Some(table),
            DeValue::Table(table) => within(table, range),
            DeValue::Array(list) => list.iter().find_map(|item| of_value(item, range)),
            _ => None,
        }
    }
    if root.span() == *range { Some(root.get_ref()) } else { within(root.get_ref(), range) }
}

/// A key whose name or value is at a place of a text.
struct Place<'v, 'a> {
    at: KeyAt<'v, 'a>,
    /// Length of the key or value around the place.
    length: usize,
}

/// The nearest key around a place.
fn place_of<'v, 'a>(table: &'v DeTable<'v>, form: Form<'a>, wanted: &Range<usize>) -> Option<Place<'v, 'a>> {
    let around = |range: &Range<usize>| range.start <= wanted.start && wanted.end <= range.end;
    let of_key = |(key, value): (&'v Spanned<_>, &'v Spanned<DeValue<'v>>)| {
        let name: &'v std::borrow::Cow<'v, str> = key.get_ref();
        let own = form.key(name)?;
        let ranges = [key.span(), value.span()].into_iter().filter(around);
        let here = ranges
            .map(|range| range.len())
            .min()
            .map(|length| Place { at: KeyAt { key: name, within: form, form: own, value }, length });
        nearer(here, within(value, own, wanted))
    };
    table.iter().map(of_key).fold(None, nearer)
}

/// The nearest key around a place in a value.
fn within<'v, 'a>(
    value: &'v Spanned<DeValue<'v>>,
    form: Form<'a>,
    wanted: &Range<usize>,
) -> Option<Place<'v, 'a>> {
    let form = form.meant(value)?;
    match value.get_ref() {
        DeValue::Table(table) => place_of(table, form, wanted),
        DeValue::Array(list) => list.iter().map(|item| within(item, form.item(), wanted)).fold(None, nearer),
        _ => None,
    }
}

/// The nearer one of two, the second where they are as near.
fn nearer<'v, 'a>(a: Option<Place<'v, 'a>>, b: Option<Place<'v, 'a>>) -> Option<Place<'v, 'a>> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.length <= a.length { b } else { a }),
        (a, b) => a.or(b),
    }
}
