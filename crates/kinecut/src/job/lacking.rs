//! Keys that the tables of a file must have and lack, all of them at once, each with its unit and an example.

use std::collections::BTreeSet;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::forms::{Form, Kind, Unit};
use super::places::span;
use super::renamed::old_name;
use super::unknown::is_near;
use crate::base::{Code, Error, FileId, Finding, Sources};

/// Beginning of serde's message about a key that a table lacks.
const MISSING: &str = "missing field ";
/// Keys of a table, and tables, of which a message says what is to be written.
const DESCRIBED: usize = 12;

/// A table that lacks keys.
#[derive(Clone, Debug)]
pub(super) struct Lacking {
    /// Its place.
    pub(super) range: Range<usize>,
    /// Each key, and what to write.
    pub(super) keys: Vec<(String, String)>,
}

/// The tables of a text that lack keys, in the order of the text.
pub(super) fn lacking<'v>(table: &'v DeTable<'v>, range: Range<usize>, form: Form<'_>) -> Vec<Lacking> {
    let mut found = Vec::new();
    look(table, range, form, true, &mut found);
    found.sort_by_key(|l| l.range.start);
    found
}

fn look<'v>(
    table: &'v DeTable<'v>,
    range: Range<usize>,
    form: Form<'_>,
    is_whole: bool,
    found: &mut Vec<Lacking>,
) {
    let has = |key: &str| table.contains_key(key);
    let lacks = form.required().filter(|key| !has(key) && !old_name(key).is_some_and(has));
    let unknown: Vec<&str> = table.keys().map(|key| -> &str { key.get_ref() }).collect();
    let unknown: Vec<&str> = unknown.into_iter().filter(|key| form.key(key).is_none()).collect();
    let one = |key: &str| {
        let write = in_words(key, form.key(key)?, is_whole);
        // A key of a wrong name is not known either.
        let meant = unknown.iter().find(|u| is_near(u, key) && old_name(key).is_none_or(|old| old != **u));
        Some((key.to_owned(), meant.map_or(write.clone(), |u| write + &in_place_of(u))))
    };
    let keys: Vec<(String, String)> = lacks.filter_map(one).collect();
    if !keys.is_empty() {
        found.push(Lacking { range, keys });
    }
    for (key, value) in table.iter() {
        if let Some(of) = form.key(key.get_ref()) {
            look_into(value, key.span(), of, found);
        }
    }
}

fn look_into<'v>(
    value: &'v Spanned<DeValue<'v>>,
    range: Range<usize>,
    form: Form<'_>,
    found: &mut Vec<Lacking>,
) {
    let Some(form) = form.meant(value) else { return };
    match value.get_ref() {
        DeValue::Table(table) => look(table, range, form, false, found),
        DeValue::Array(list) if form.kind() == Kind::List => {
            list.iter().for_each(|item| look_into(item, item.span(), form.item(), found));
        }
        _ => {}
    }
}

/// An example of a key, with its unit and what it is: "flute_length = 22 (mm, height of the cutting part above the tip)".
fn in_words(key: &str, form: Form<'_>, is_whole: bool) -> String {
    let is_list = form.kind() == Kind::List && form.item().kind() == Kind::Table;
    let example = match form.example() {
        // The tables of a whole file have headers.
        Some(_) if is_whole && is_list => {
            let rows = form.item().example_rows().unwrap_or_default();
            format!("[[{key}]] with {}", rows.join(", "))
        }
        Some(example) => format!("{key} = {example}"),
        None => format!("`{key}`"),
    };
    let (unit, named) = match form.unit() {
        Some(Unit::Of(unit)) => (unit.to_owned(), format!(", {unit}")),
        Some(Unit::Count) => ("a whole number".to_owned(), String::new()),
        Some(Unit::Pure) | None => (String::new(), String::new()),
    };
    let words = form.first_words();
    let mut words = if named.is_empty() { words } else { words.replace(&named, "") };
    words = words.trim_end_matches(" in a file").to_owned();
    if begins_small(&words) {
        words[..1].make_ascii_lowercase();
    }
    let is_new = words != key.replace('_', " ");
    let about: Vec<String> = [unit, if is_new { words } else { String::new() }].into();
    let about: Vec<String> = about.into_iter().filter(|part| !part.is_empty()).collect();
    if about.is_empty() { example } else { format!("{example} ({})", about.join(", ")) }
}

/// The end of the words about a key that a table lacks and has most likely under a wrong name.
pub(super) fn in_place_of(unknown: &str) -> String {
    format!(", in place of `{unknown}`")
}

/// Whether a sentence may begin with a small letter: not with that of an axis.
fn begins_small(words: &str) -> bool {
    let first = words.split(' ').next().unwrap_or_default();
    first == "A" || first.len() > 1 && first.is_ascii() && first[1..].chars().all(|c| c.is_ascii_lowercase())
}

/// Whether an error of serde is about a key that a table lacks.
pub(super) fn is_missing(message: &str) -> bool {
    message.starts_with(MISSING)
}

/// One error for all tables of a text that lack keys; `None` without any.
pub(super) fn missing(sources: &Sources, id: FileId, all: &[Lacking]) -> Option<Error> {
    let (first, others) = all.split_first()?;
    let names: Vec<String> = first.keys.iter().map(|(key, _)| format!("`{key}`")).collect();
    let verb = if first.keys.len() == 1 { "is" } else { "are" };
    let examples: Vec<&str> = first.keys.iter().take(DESCRIBED).map(|(_, write)| write.as_str()).collect();
    let mut help = vec![format!("for example {}", examples.join("; "))];
    let said = first.keys.iter().take(DESCRIBED).map(|(_, write)| write.as_str()).collect();
    help.extend(others_in_words(sources, id, others, "", said));
    let place = sources.locate(span(id, &first.range));
    let finding = Finding::error(Code::JOB_SHAPE, format!("{} {verb} missing", in_a_row(&names)));
    Some(finding.at(place).help(help.join("; ")).into())
}

/// For each table that lacks keys its line, behind the name of its file, and these; what `said` has is named only.
pub(super) fn others_in_words<'a>(
    sources: &Sources,
    id: FileId,
    others: &'a [Lacking],
    file: &str,
    mut said: BTreeSet<&'a str>,
) -> Vec<String> {
    let mut all = Vec::new();
    for other in others.iter().take(DESCRIBED) {
        let place = sources.locate(span(id, &other.range));
        let keys: Vec<String> = other
            .keys
            .iter()
            .map(|(key, write)| if said.insert(write) { write.clone() } else { format!("`{key}`") })
            .collect();
        all.push(format!("{file}line {} lacks {}", place.line, in_a_row(&keys)));
    }
    if others.len() > DESCRIBED {
        all.push(format!("{file}{} more tables lack keys", others.len() - DESCRIBED));
    }
    all
}

/// A help of a part of a text whose lines are counted in the whole text, `lines` before it.
pub(super) fn with_lines_of_whole(help: &str, lines: u32) -> String {
    const LINE: &str = "line ";
    let mut parts = help.split(LINE);
    let mut whole = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len());
        let (number, rest) = part.split_at(digits);
        whole += LINE;
        match number.parse::<u32>() {
            Ok(number) if rest.starts_with(" lacks ") => whole += &(number + lines).to_string(),
            _ => whole += number,
        }
        whole += rest;
    }
    whole
}

fn in_a_row(all: &[String]) -> String {
    match all.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => all.concat(),
    }
}
