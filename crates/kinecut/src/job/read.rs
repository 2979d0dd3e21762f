//! Job text to [`JobFile`], with the place of every key.

use std::ops::Range;

use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::cutting::ShopTable;
use super::file::{HoleTable, JobFile, MachineEntry, MachineTable, OperationEntry};
use super::forms::InMm;
use super::holes::expand;
use super::library::Shop;
use super::places::{Places, parse, span};
use super::wrong_table::{too_long, with_other_files, wrong_table};
use crate::base::{Code, Error, FileId, Finding, Loader, Result, Sources};
use crate::operations::{Decode, OperationTable};

/// A job file as read: its content, and the place of each key.
#[derive(Clone, Debug)]
pub struct JobText {
    /// The content.
    pub file: JobFile,
    /// The source text in the run's sources.
    pub id: FileId,
    places: Places,
    shop: Shop,
    /// Notes about tools that were chosen for holes.
    chosen: Vec<Finding>,
}

impl JobText {
    /// Reads a job text in `sources`; files that it names come through `loader`.
    ///
    /// # Errors
    /// `KC0101` for broken TOML, `KC0102` for unknown or missing keys and wrong types, each with its place;
    /// the loader's errors for a machine file.
    pub fn read(sources: &mut Sources, id: FileId, loader: &dyn Loader) -> Result<JobText> {
        JobText::read_with_files(sources, id, loader).map_err(|e| with_other_files(sources, id, loader, e))
    }

    fn read_with_files(sources: &mut Sources, id: FileId, loader: &dyn Loader) -> Result<JobText> {
        let text = sources.text(id).to_owned();
        let (in_mm, machine_in_mm, machine_text);
        let mut root = parse(sources, id, &text)?;
        let mut places = Places::of(id, &root);
        if let Some(error) = too_long::<JobFile>(sources, id, &root) {
            return Err(error);
        }
        in_mm = InMm::of::<JobFile>(&mut root);
        in_mm.put_into::<JobFile>(&mut root);
        let whole = root.span();
        // Whatever is wrong with a part is said of the whole text, with all that it lacks.
        let wrong = |e: &toml::de::Error| wrong_table::<JobFile>(sources, id, &whole, e);
        let operations = take_operations(root.get_mut());
        let machine = root.get_mut().remove("machine");
        let mut file = JobFile::deserialize(Deserializer::from(root)).map_err(|e| wrong(&e))?;
        let mut decoded = Vec::with_capacity(operations.len());
        for tables in operations {
            let own: Result<Vec<Entry>> =
                tables.into_iter().map(|table| entry(sources, id, table, &wrong)).collect();
            decoded.push(own?);
        }
        for (setup, own) in file.setups.iter_mut().zip(decoded) {
            for (at, entry) in own.into_iter().enumerate() {
                match entry {
                    Entry::Operation(operation) => setup.operations.push(*operation),
                    Entry::Hole(hole) => setup.holes.push((at, *hole)),
                }
            }
        }
        file.machine = match machine.map(|m| (m.span(), m.into_inner())) {
            None => None,
            Some((_, DeValue::String(name))) => {
                let name = name.into_owned();
                machine_text =
                    loader.read_text(&name).map_err(|e| places.locate(sources, e.under("machine")))?;
                let file_name = name.clone();
                let machine_id = sources.add(name, machine_text.clone());
                let mut table = parse(sources, machine_id, &machine_text)?;
                places.include("machine", machine_id, &table);
                machine_in_mm = InMm::of::<MachineTable>(&mut table);
                machine_in_mm.put_into::<MachineTable>(&mut table);
                let mut table = decode::<MachineTable>(sources, machine_id, table)?;
                in_folder_of(&file_name, &mut table);
                Some(MachineEntry::Table(Box::new(table)))
            }
            Some((span, value)) => {
                let table = table_of(sources, id, span, value)?;
                let table = MachineTable::deserialize(Deserializer::from(table)).map_err(|e| wrong(&e))?;
                Some(MachineEntry::Table(Box::new(table)))
            }
        };
        let mut shop = Shop::read(sources, &mut file, &places, loader)?;
        let chosen = expand(&mut file, &mut places, &mut shop).map_err(|e| places.locate(sources, e))?;
        let table = ShopTable::read(sources, &file, &places, loader)?;
        shop.fill(&mut file, &mut places, &table, loader).map_err(|e| places.locate(sources, e))?;
        Ok(JobText { file, id, places, shop, chosen })
    }

    /// A note for each key that has a new name; what was taken of tool files, and what not.
    pub fn notes(&self, sources: &Sources) -> Vec<Finding> {
        let mut notes = self.places.renamed(sources);
        let about_tools = self.chosen.iter().cloned().chain(self.shop.notes());
        notes.extend(about_tools.map(|note| *self.locate(sources, note.into()).0));
        notes
    }

    /// Takes the tools that a program may call into a job made of this one.
    ///
    /// # Errors
    /// Those of tools that cannot be taken together.
    pub(super) fn call_program(&mut self, file: &mut JobFile, text: &str) -> Result<()> {
        self.shop.call_program(file, &mut self.places, text)
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

/// Reads a table from a text of its own in `sources`; its check gets the place of its key.
///
/// # Errors
/// As [`JobText::read`], and those of `check`.
pub(crate) fn read_table<T: DeserializeOwned + JsonSchema, U>(
    sources: &Sources,
    id: FileId,
    check: impl FnOnce(&T) -> Result<U>,
) -> Result<U> {
    let root = parse(sources, id, sources.text(id))?;
    let places = Places::of(id, &root);
    let table: T = decode(sources, id, root)?;
    check(&table).map_err(|e| places.locate(sources, e))
}

/// Reading of a table of a TOML text as an item.
pub(crate) type FromToml<T> = fn(&Sources, FileId, Spanned<DeTable<'_>>) -> Result<T>;

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

/// Decodes a table.
///
/// # Errors
/// `KC0102` for what is wrong with it: all keys that it lacks at once.
pub(crate) fn decode<'de, T: Deserialize<'de> + JsonSchema>(
    sources: &Sources,
    id: FileId,
    table: Spanned<DeTable<'de>>,
) -> Result<T> {
    let range = table.span();
    T::deserialize(Deserializer::from(table)).map_err(|e| wrong_table::<T>(sources, id, &range, &e))
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

/// Decodes an operation.
///
/// # Errors
/// `KC0102` for what is wrong with it: all keys that it lacks at once.
pub(crate) fn decode_operation(
    sources: &Sources,
    id: FileId,
    value: Spanned<DeValue<'_>>,
) -> Result<OperationTable> {
    let range = value.span();
    let wrong = |e: &toml::de::Error| wrong_table::<OperationEntry>(sources, id, &range, e);
    match entry(sources, id, value, &wrong)? {
        Entry::Operation(operation) => Ok(*operation),
        Entry::Hole(_) => {
            let at = sources.locate(span(id, &range));
            let what = "`hole` becomes several operations, with tools of a job";
            let finding = Finding::error(Code::JOB_SHAPE, what).at(at);
            Err(finding.help("use `kinecut run` on the job, or write an operation").into())
        }
    }
}

/// An entry of a setup's list of operations.
enum Entry {
    Operation(Box<OperationTable>),
    Hole(Box<HoleTable>),
}

/// The name of holes by their size in the job file.
const HOLE: &str = "hole";
/// The name of spots: drilling by the method `centring`.
const SPOT: &str = "spot";

/// The error of a table in the words of its text.
type Wrong<'a> = &'a dyn Fn(&toml::de::Error) -> Error;

fn entry(sources: &Sources, id: FileId, value: Spanned<DeValue<'_>>, wrong: Wrong<'_>) -> Result<Entry> {
    let range = value.span();
    let mut table = table_of(sources, id, range.clone(), value.into_inner())?;
    let kind = table.get_mut().remove("type");
    let fail = |message: String, range: &Range<usize>| {
        Err(Finding::error(Code::JOB_SHAPE, message)
            .at(sources.locate(span(id, range)))
            .help(format!(
                "write type = \"{}\" or \"{SPOT}\" or \"{HOLE}\"",
                OperationTable::NAMES.join("\" or \"")
            ))
            .into())
    };
    let Some(kind) = kind else { return fail("an operation has no type".to_owned(), &range) };
    match kind.get_ref().as_str() {
        Some(HOLE) => Ok(Entry::Hole(Box::new(InText { table, wrong }.table()?))),
        Some(SPOT) if table.get_ref().contains_key("method") => {
            fail("a spot has no method: it is drilling with method = \"centring\"".to_owned(), &kind.span())
        }
        Some(name) => match OperationTable::of_kind(
            if name == SPOT { as_drilling(&mut table, &kind.span()) } else { name },
            InText { table, wrong },
        ) {
            Some(operation) => Ok(Entry::Operation(Box::new(operation?))),
            None => fail(format!("unknown operation `{name}`"), &kind.span()),
        },
        None => fail("the type of an operation must be a text".to_owned(), &kind.span()),
    }
}

/// Makes the table of a spot one of drilling; the name of that kind.
fn as_drilling(table: &mut Spanned<DeTable<'_>>, at: &Range<usize>) -> &'static str {
    let method = DeValue::String("centring".into());
    table.get_mut().insert(Spanned::new(at.clone(), "method".into()), Spanned::new(at.clone(), method));
    "drill"
}

/// A table of a text.
struct InText<'a, 'de> {
    table: Spanned<DeTable<'de>>,
    wrong: Wrong<'a>,
}

impl Decode for InText<'_, '_> {
    fn table<T: DeserializeOwned + JsonSchema>(self) -> Result<T> {
        T::deserialize(Deserializer::from(self.table)).map_err(|e| (self.wrong)(&e))
    }
}
