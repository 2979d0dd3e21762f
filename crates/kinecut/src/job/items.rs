//! Lists of tables of one kind: one table, an array of them (`[[name]]` in TOML, an array in JSON), each item with an error of
//! its own, which keeps its place in the text.

use std::collections::BTreeMap;
use std::ops::Range;

use schemars::JsonSchema;
use schemars::generate::SchemaGenerator;
use serde::de::DeserializeOwned;
use serde_json::value::RawValue;
use serde_json::{Value, json};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::lacking::with_lines_of_whole;
use super::places::Places;
use super::read::{FromToml, decode, text_tables};
use super::renamed::{self, without_old_names};
use super::unknown::nearest;
use crate::base::{Code, Error, FileId, Finding, Result, Sources};

/// Tables of a text. A long list is read one item at a time: the text is all that is kept.
#[derive(Clone, Debug)]
pub struct TextItems<T> {
    /// Name of the list, if the text has one.
    pub list: Option<&'static str>,
    name: String,
    text: String,
    form: Form<T>,
}

#[derive(Clone, Debug)]
enum Form<T> {
    /// JSON: the bytes of each item.
    Json(Vec<Range<usize>>),
    /// TOML with a header `[[name]]` for each item: from header to header.
    Pieces(Vec<ItemPart>, FromToml<T>),
    /// TOML of any other form, read at once.
    Whole(Vec<Result<T>>, Places, Sources),
}

impl<T: DeserializeOwned + Clone> TextItems<T> {
    /// Reads a text of TOML or JSON; it is JSON when it begins like JSON. A list is called `list`.
    ///
    /// # Errors
    /// `KC0101` for a text that is neither. What is wrong with one item stands in its place.
    pub fn read(name: &str, text: impl Into<String>, list: &'static str) -> Result<TextItems<T>>
    where
        T: JsonSchema,
    {
        TextItems::read_named(name, text.into(), &[list], |sources, id, table| decode(sources, id, table))
    }

    /// As [`TextItems::read`] with a list of any of the names `lists`, and items of TOML texts made by `from_toml`. A list without
    /// a name takes the first.
    ///
    /// # Errors
    /// As [`TextItems::read`].
    pub(crate) fn read_named(
        name: &str,
        text: String,
        lists: &[&'static str],
        from_toml: FromToml<T>,
    ) -> Result<TextItems<T>> {
        let start = text.trim_start();
        let json = start.starts_with('{')
            || start.strip_prefix('[').is_some_and(|rest| rest.trim_start().starts_with(['{', ']']));
        let (form, list) = if json {
            let (ranges, list) = json_ranges(&text, lists)?;
            (Form::Json(ranges), list)
        } else if let Some((pieces, list)) = pieces(&text, lists) {
            (Form::Pieces(pieces, from_toml), Some(list))
        } else {
            let mut sources = Sources::default();
            let id = sources.add(name, text.as_str());
            let (items, list, places) = text_tables(&sources, id, lists, from_toml)?;
            (Form::Whole(items, places, sources), list)
        };
        Ok(TextItems { list, name: name.to_owned(), text, form })
    }

    /// Number of items.
    pub fn count(&self) -> usize {
        match &self.form {
            Form::Json(ranges) => ranges.len(),
            Form::Pieces(parts, _) => parts.len(),
            Form::Whole(items, ..) => items.len(),
        }
    }

    /// An item.
    ///
    /// # Errors
    /// `KC0101`, `KC0102` for what is wrong with it; `KC0102` for an item that is not there.
    pub fn item(&self, index: usize) -> Result<T> {
        let none = || Finding::error(Code::JOB_SHAPE, "there is no such item").into();
        match &self.form {
            Form::Whole(items, ..) => items.get(index).cloned().unwrap_or_else(|| Err(none())),
            Form::Json(ranges) => {
                let text = ranges.get(index).and_then(|r| self.text.get(r.clone())).ok_or_else(none)?;
                from_json(serde_json::from_str(text).map_err(|e| no_json(&e))?)
            }
            Form::Pieces(parts, from_toml) => {
                let piece = ItemText::of(self, parts.get(index).ok_or_else(none)?);
                let (mut items, ..) = text_tables(&piece.sources, piece.id, self.list.as_slice(), *from_toml)
                    .map_err(|e| piece.in_text(e))?;
                items.pop().unwrap_or_else(|| Err(none())).map_err(|e| piece.in_text(e))
            }
        }
    }

    /// A note for each key of an item that has a new name, at its place in the text.
    pub fn notes(&self, index: usize) -> Vec<Finding> {
        let key = |index: usize| self.list.map(|list| format!("{list}[{index}]"));
        let mut notes = Vec::new();
        match &self.form {
            Form::Json(ranges) => {
                let text = ranges.get(index).and_then(|r| self.text.get(r.clone())).unwrap_or_default();
                note_keys(
                    &serde_json::from_str(text).unwrap_or_default(),
                    &key(index).unwrap_or_default(),
                    &mut notes,
                );
            }
            Form::Whole(_, places, sources) => {
                notes = places.renamed(sources);
                let above = key(index).map_or_else(String::new, |key| format!("{key}."));
                notes.retain(|note| note.key.as_ref().is_some_and(|key| key.starts_with(&above)));
            }
            Form::Pieces(parts, _) => {
                let Some(part) = parts.get(index) else { return notes };
                let piece = ItemText::of(self, part);
                let Ok(places) = Places::read(&piece.sources, piece.id) else { return notes };
                for mut note in places.renamed(&piece.sources) {
                    if let (Some(own), Some(first), Some(named)) = (&mut note.key, key(0), key(index)) {
                        *own = own.replacen(&first, &named, 1);
                    }
                    notes.push(*piece.in_text(note.into()).0);
                }
            }
        }
        notes
    }

    /// An item's error with its place in the text.
    pub fn locate(&self, index: usize, error: Error) -> Error {
        let under = |error: Error, index: usize| match self.list {
            Some(list) => error.under(&format!("{list}[{index}]")),
            None => error,
        };
        match &self.form {
            Form::Json(_) => under(error, index),
            Form::Whole(_, places, sources) => places.locate(sources, under(error, index)),
            Form::Pieces(parts, _) => {
                let key = under(error.clone(), index).0.key;
                let mut error = error;
                let placed = error.0.place.as_ref().is_some_and(|p| p.line > 0);
                if let (false, Some(part)) = (placed, parts.get(index)) {
                    let piece = ItemText::of(self, part);
                    if let Ok(places) = Places::read(&piece.sources, piece.id) {
                        error = piece.in_text(places.locate(&piece.sources, under(error, 0)));
                    }
                }
                error.0.key = key;
                error
            }
        }
    }
}

/// One item's part of a text of TOML.
#[derive(Clone, Debug)]
struct ItemPart {
    bytes: Range<usize>,
    /// Number of lines before it.
    lines: usize,
}

/// The same as a text of its own.
struct ItemText {
    sources: Sources,
    id: FileId,
    /// Bytes and lines of the whole text before it.
    before: [u32; 2],
}

impl ItemText {
    fn of<T>(items: &TextItems<T>, part: &ItemPart) -> ItemText {
        let mut sources = Sources::default();
        let id = sources.add(items.name.as_str(), items.text.get(part.bytes.clone()).unwrap_or_default());
        ItemText { sources, id, before: [part.bytes.start, part.lines].map(|n| n as u32) }
    }

    /// An error of the piece, its place counted in the whole text.
    fn in_text(&self, mut error: Error) -> Error {
        if let Some(place) = error.0.place.as_mut().filter(|p| p.line > 0) {
            let [bytes, lines] = self.before;
            (place.start, place.end, place.line) =
                (place.start + bytes, place.end + bytes, place.line + lines);
            error.0.help = with_lines_of_whole(&error.0.help, lines);
        }
        error
    }
}

/// The parts of a text of TOML that is nothing but a list of one of these names, each under its own header `[[name]]`; none
/// for a text of any other form, and for one that is wrong.
fn pieces(text: &str, lists: &[&'static str]) -> Option<(Vec<ItemPart>, &'static str)> {
    // A text of several lines could hold what looks like a header.
    if text.contains("\"\"\"") || text.contains("'''") {
        return None;
    }
    let mut parts: Vec<ItemPart> = Vec::new();
    let mut list = None;
    let mut at = 0;
    for (lines, line) in text.split_inclusive('\n').enumerate() {
        let code = line.trim();
        let name = code.strip_prefix("[[").and_then(|rest| Some(rest.split_once("]]")?.0.trim()));
        if let Some(known) = lists.iter().copied().find(|l| Some(*l) == name) {
            if list.is_some_and(|l| l != known) {
                return None;
            }
            list = Some(known);
            parts.push(ItemPart { bytes: at..at, lines });
        } else if parts.is_empty() && !code.is_empty() && !code.starts_with('#') {
            return None;
        }
        at += line.len();
        if let Some(part) = parts.last_mut() {
            part.bytes.end = at;
        }
    }
    let list = list?;
    let one = |part: &ItemPart| {
        DeTable::parse(&text[part.bytes.clone()]).is_ok_and(|root| {
            let array = root.get_ref().get(list).map(Spanned::get_ref);
            root.get_ref().len() == 1 && array.and_then(DeValue::as_array).is_some_and(|a| a.len() == 1)
        })
    };
    parts.iter().all(one).then_some((parts, list))
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

fn no_json(error: &serde_json::Error) -> Error {
    Finding::error(Code::JOB_SYNTAX, format!("the text is no JSON: {error}")).into()
}

/// The bytes of each item of a JSON text, and the name of their list.
fn json_ranges(text: &str, lists: &[&'static str]) -> Result<(Vec<Range<usize>>, Option<&'static str>)> {
    let found = || -> serde_json::Result<_> {
        let whole: &RawValue = serde_json::from_str(text)?;
        fn list_of(raw: &RawValue) -> serde_json::Result<Vec<&RawValue>> {
            serde_json::from_str(raw.get())
        }
        let (raws, list) = match whole.get().starts_with('[') {
            true => (list_of(whole)?, lists.first().copied()),
            false => {
                let map: BTreeMap<String, &RawValue> = serde_json::from_str(text)?;
                let is_list =
                    |name: &&str| map.len() == 1 && map.get(*name).is_some_and(|v| v.get().starts_with('['));
                match lists.iter().copied().find(is_list).and_then(|list| Some((list, map.get(list)?))) {
                    Some((list, values)) => (list_of(values)?, Some(list)),
                    None => (vec![whole], None),
                }
            }
        };
        // Each is JSON that can be taken apart; it is again when it is wanted.
        for raw in &raws {
            serde_json::from_str::<Value>(raw.get())?;
        }
        let range = |raw: &&RawValue| {
            let start = raw.get().as_ptr() as usize - text.as_ptr() as usize;
            start..start + raw.get().len()
        };
        Ok((raws.iter().map(range).collect(), list))
    };
    // The places in an error are those of the whole text.
    found().map_err(|e| no_json(&serde_json::from_str::<Value>(text).err().unwrap_or(e)))
}

/// Notes about the keys of a value that have a new name; `above` is its own key.
fn note_keys(value: &Value, above: &str, notes: &mut Vec<Finding>) {
    for (name, value) in value.as_object().into_iter().flatten() {
        let key = if above.is_empty() { name.clone() } else { format!("{above}.{name}") };
        notes.extend(renamed::note(&key));
        note_keys(value, &key, notes);
    }
}

fn from_json<T: DeserializeOwned>(value: Value) -> Result<T> {
    serde_path_to_error::deserialize::<_, T>(value).map_err(|e| {
        let message = without_old_names(&e.inner().to_string());
        let finding =
            Finding::error(Code::JOB_SHAPE, message.clone()).help(nearest(&message).unwrap_or_default());
        let path = e.path().to_string();
        Error::from(if path == "." { finding } else { finding.key(path) })
    })
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    #[derive(Clone, Debug, Deserialize, schemars::JsonSchema)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "read, and not looked at")]
    struct Hole {
        tool: Tool,
        operation: Operation,
    }

    #[derive(Clone, Debug, Deserialize, schemars::JsonSchema)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "read, and not looked at")]
    struct Tool {
        diameter: f64,
    }

    #[derive(Clone, Debug, Deserialize, schemars::JsonSchema)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "read, and not looked at")]
    struct Operation {
        speed: f64,
    }

    /// Three holes, the second with `second` in its operation, on line 13; a comment before the first.
    fn holes(second: &str) -> String {
        let hole = |more: &str| format!("[[hole]]\n[hole.tool]\ndiameter = 10\n\n[hole.operation]\n{more}\n");
        format!("# three\n{}{}{}", hole("speed = 900"), hole(second), hole("speed = 800"))
    }

    #[test]
    fn an_item_read_by_itself_has_its_place_in_the_whole_text() {
        let whole = |text: &str, index: usize, error: Error| {
            let mut sources = Sources::default();
            let id = sources.add("h.toml", text);
            Places::read(&sources, id).unwrap().locate(&sources, error.under(&format!("hole[{index}]")))
        };
        let text = holes("sped = 5");
        let items = TextItems::<Hole>::read("h.toml", text.as_str(), "hole").unwrap();
        assert!(matches!(items.form, Form::Pieces(..)) && items.count() == 3);
        assert!(items.item(0).is_ok() && items.item(2).is_ok() && items.item(3).is_err());
        let place = items.item(1).unwrap_err().0.place.unwrap();
        assert_eq!((place.line as usize, place.text.as_str()), (13, "sped = 5"));
        assert_eq!(&text[place.start as usize..place.end as usize], "sped");
        // A fault found later is at its key, or at the nearest key above.
        for key in ["operation.speed", "operation.depth", "tool.diameter", "nothing"] {
            let error = || Error::from(Finding::error(Code::JOB_VALUE, "wrong").key(key));
            let text = holes("speed = 5");
            let items = TextItems::<Hole>::read("h.toml", text.as_str(), "hole").unwrap();
            assert_eq!(items.locate(1, error()), whole(&text, 1, error()), "{key}");
        }
    }

    #[test]
    fn texts_of_other_forms_are_read_at_once() {
        let text = holes("speed = 5");
        for other in [
            format!("title = 1\n{text}"),
            format!("{text}title = \"\"\"\n[[hole]]\n\"\"\"\n"),
            format!("{text}[tool]\n"),
            text.replacen("[[hole]]", "[[drill]]", 1),
        ] {
            assert!(pieces(&other, &["hole", "drill"]).is_none(), "{other}");
        }
        let read = |name: &str, text: &str| TextItems::<Hole>::read(name, text, "hole").unwrap_err();
        let broken = read("h.toml", &holes("speed = "));
        assert_eq!((broken.code(), broken.0.place.as_ref().unwrap().line), (Code::JOB_SYNTAX, 13));
        let broken = read("h.json", "[{\"tool\": 1},\n {\"tool\": }]");
        assert!(broken.to_string().contains("line 2 column 11"), "{broken}");
    }
}
