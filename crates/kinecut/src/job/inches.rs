//! Messages and pages of a job in inches.

use std::collections::BTreeMap;

use toml::de::DeTable;

use super::check::Job;
use super::file::JobFile;
use super::forms::factors;
use super::report::Report;
use crate::base::{Error, Finding, Quantity};
use crate::page::inches;

/// Texts of a job in inches: lengths, the numbers of keys that a message says to write, and the names that operations give
/// themselves.
#[derive(Debug)]
pub(super) struct InInches {
    keys: BTreeMap<String, f64>,
    /// Names of operations in mm, and in inches.
    names: Vec<[String; 2]>,
}

impl InInches {
    /// Those of a job, where it has come so far.
    pub(super) fn of(job: Option<&Job>) -> InInches {
        let operations = job.into_iter().flat_map(|job| &job.setups).flat_map(|setup| &setup.operations);
        let names = operations.map(|operation| operation.name()).flat_map(|name| {
            let inch = inches::name(&name);
            [[heading(&name), heading(&inch)], [name, inch]]
        });
        InInches { keys: factors::<JobFile>(), names: names.collect() }
    }

    /// A text.
    pub(super) fn text(&self, text: &mut String) {
        *text = inches::in_inches(text, &|key| self.keys.get(key).copied());
        self.named(text);
    }

    /// The names of operations in a text.
    fn named(&self, text: &mut String) {
        for [mm, inch] in &self.names {
            if text.contains(mm.as_str()) {
                *text = text.replace(mm.as_str(), inch);
            }
        }
    }

    /// A finding.
    pub(super) fn finding(&self, finding: &mut Finding) {
        self.text(&mut finding.message);
        self.text(&mut finding.help);
        for quantity in [&mut finding.value, &mut finding.bound].into_iter().flatten() {
            let (mm, unit) = match quantity.unit.as_str() {
                "mm" => (25.4, "in"),
                "mm/min" => (25.4, "in/min"),
                "mm/rev" => (25.4, "in/rev"),
                "m/min" => (0.3048, "ft/min"),
                _ => continue,
            };
            *quantity = Quantity::new(quantity.value / mm, unit);
        }
    }
}

/// A name as a heading.
fn heading(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// An error of a job in the units of its text.
pub(super) fn error_in_its_units(text: &str, mut error: Error) -> Error {
    let units = |root: &DeTable<'_>| Some(root.get("units")?.get_ref().as_str()? == "in");
    let says_inches = DeTable::parse(text).is_ok_and(|root| units(root.get_ref()) == Some(true));
    if says_inches {
        InInches::of(None).finding(&mut error.0);
    }
    error
}

/// The sections of a page in inches; its view of the part, drawings, charts and plans stay in mm. Its findings are in inches already.
pub(super) fn report_in_inches(report: &mut Report, job: &Job) {
    let inches = InInches::of(Some(job));
    let turn = |text: &mut String| {
        inches::words(text);
        inches.named(text);
    };
    report.sections.iter_mut().for_each(|section| inches::section(section, &turn));
    report.inches = true;
}
