//! Messages and pages of a job in inches.

use std::collections::BTreeMap;

use toml::de::DeTable;

use super::check::Job;
use super::file::JobFile;
use super::forms::factors;
use super::report::Report;
use super::wrong_table::names;
use crate::base::{Error, Finding, Loader, Quantity};
use crate::page::{self, inches};

/// Units of the numbers of findings: metric, in inches, and one of the second in the first.
const LENGTHS: [(&str, &str, f64); 4] =
    [("mm/min", "in/min", 25.4), ("mm/rev", "in/rev", 25.4), ("m/min", "ft/min", 0.3048), ("mm", "in", 25.4)];

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
            [[page::heading(&name), page::heading(&inch)], [name, inch]]
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
            // Words may follow: "mm of edge".
            let unit = LENGTHS.iter().find_map(|(metric, inch, size)| {
                let rest = quantity.unit.strip_prefix(metric)?;
                let ends = !rest.starts_with(|c: char| c.is_alphanumeric() || c == '/');
                ends.then(|| (format!("{inch}{rest}"), size))
            });
            if let Some((unit, size)) = unit {
                *quantity = Quantity::new(quantity.value / size, &unit);
            }
        }
    }
}

/// Whether the lengths of a TOML text are in inches.
fn is_inch(text: &str) -> bool {
    let units = |root: &DeTable<'_>| Some(root.get("units")?.get_ref().as_str()? == "in");
    DeTable::parse(text).is_ok_and(|root| units(root.get_ref()) == Some(true))
}

/// The files that a job names whose lengths are in the other unit than its own: of its machine, its tools and its cutting data.
pub(super) fn in_other_unit(text: &str, loader: &dyn Loader) -> Vec<String> {
    let own = is_inch(text);
    let Ok(root) = DeTable::parse(text) else { return Vec::new() };
    let named = |key: &str| root.get_ref().get(key).map(names).unwrap_or_default();
    let files = ["machine", "tools", "cutting"].into_iter().flat_map(named);
    let other = |name: &String| {
        name.ends_with(".toml") && loader.read_text(name).is_ok_and(|text| is_inch(&text) != own)
    };
    files.filter(other).collect()
}

/// An error of a job in the units of the text that it is about.
pub(super) fn error_in_its_units(text: &str, loader: &dyn Loader, mut error: Error) -> Error {
    let place = error.0.place.as_ref().map_or("", |place| place.file.as_str());
    let is_other = || in_other_unit(text, loader).iter().any(|file| file == place);
    if is_inch(text) != is_other() {
        InInches::of(None).finding(&mut error.0);
    }
    error
}

/// Findings of a job in the units of the text that each is about.
pub(super) fn findings_in_their_units(job: &Job, found: &mut [Finding]) {
    if !job.units.is_inch() && job.in_other_unit.is_empty() {
        return;
    }
    let inches = InInches::of(Some(job));
    for finding in found {
        let place = finding.place.as_ref().map(|place| &place.file);
        let is_other = place.is_some_and(|file| job.in_other_unit.contains(file));
        if job.units.is_inch() != is_other {
            inches.finding(finding);
        }
    }
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
