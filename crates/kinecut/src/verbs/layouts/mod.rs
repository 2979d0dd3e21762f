//! Layouts of a code or a set of axes, in the units of the shop: the question as a command line puts it, the answer as a
//! table.

mod page;
pub(crate) mod show;
mod wants;

pub use page::layouts_html;
pub use show::{
    layout_drawing, layout_figure, layout_machine, layout_scheme, layout_sheet as layouts_drawing,
    machine_drawing, machine_drawing_at, with_usual_bodies,
};

pub use wants::{LISTED, LayoutWants};

use serde::Serialize;

use crate::base::{Code, Finding, Progress, Result};
use crate::job::Outputs;
use crate::machine::Elementary;
use crate::machine::layouts::{Attitude, Criterion, Layout, LayoutKind, Query, Sizes, layouts_watched};
use crate::page::Section;
use crate::verbs::Answer;

/// The answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LayoutSheet {
    /// Question.
    pub of: String,
    /// Number of layouts before conditions.
    pub enumerated: usize,
    /// Number of layouts that each condition leaves out by itself.
    pub left_out: Vec<(&'static str, usize)>,
    /// Number of layouts that are left.
    pub left: usize,
    /// Number of classes of those.
    pub classes: usize,
    /// The best of them, in order.
    pub layouts: Vec<Layout>,
    /// Weights of the scores; 0 for one that does not count.
    pub weights: Vec<(&'static str, f64)>,
    /// Findings.
    pub findings: Vec<Finding>,
    /// Sizes that they were asked with.
    #[serde(skip)]
    pub sizes: Sizes,
}

/// All layouts that are asked for, the best first; `of` is what they are layouts of, in words.
///
/// # Errors
/// `KC1121`, `KC1122` for too many axes or a number out of range; `KC0009` when cancelled.
pub fn layout_sheet(of: &str, query: &Query, progress: &dyn Progress) -> Result<LayoutSheet> {
    let found = layouts_watched(query, progress)?;
    let classes = found.classes().len();
    let left = found.layouts.len();
    Ok(LayoutSheet {
        of: of.to_owned(),
        enumerated: found.enumerated,
        left_out: found.left_out,
        left,
        classes,
        layouts: found.layouts.into_iter().take(query.listed).collect(),
        weights: Criterion::ALL
            .iter()
            .map(|c| (c.name(), query.weights.iter().find(|(own, _)| own == c).map_or(0.0, |(_, w)| *w)))
            .collect(),
        findings: found.findings,
        sizes: query.sizes.clone(),
    })
}

/// Attitudes of the spindle by name: "vertical", "horizontal", "both".
///
/// # Errors
/// `KC0102` for any other name.
pub fn attitudes(name: &str) -> Result<Vec<Attitude>> {
    match name {
        "vertical" => Ok(vec![Attitude::Vertical]),
        "horizontal" => Ok(vec![Attitude::Horizontal]),
        "both" => Ok(vec![Attitude::Vertical, Attitude::Horizontal]),
        other => Err(unknown("attitude of the spindle", other, &["vertical", "horizontal", "both"])),
    }
}

/// Kinds of layouts by their names.
///
/// # Errors
/// `KC0102` for an unknown name.
pub fn kinds(names: &[String]) -> Result<Vec<LayoutKind>> {
    const KINDS: [(&str, LayoutKind); 6] = [
        ("linear", LayoutKind::Linear),
        ("table", LayoutKind::Table),
        ("head", LayoutKind::Head),
        ("table-table", LayoutKind::TableTable),
        ("head-table", LayoutKind::HeadTable),
        ("head-head", LayoutKind::HeadHead),
    ];
    let kind = |name: &String| {
        let found = KINDS.iter().find(|(known, _)| known == name).map(|(_, kind)| *kind);
        found.ok_or_else(|| unknown("kind of layout", name, &KINDS.map(|(known, _)| known)))
    };
    names.iter().map(kind).collect()
}

/// Criteria by their names, with their weights.
///
/// # Errors
/// `KC0102` for an unknown name.
pub fn criteria(weights: &[(String, f64)]) -> Result<Vec<(Criterion, f64)>> {
    let weight = |(name, value): &(String, f64)| {
        let criterion = Criterion::parse(name)
            .ok_or_else(|| unknown("criterion", name, &Criterion::ALL.map(Criterion::name)))?;
        Ok((criterion, *value))
    };
    weights.iter().map(weight).collect()
}

/// The motions of axes: "XYC".
///
/// # Errors
/// `KC0102` for an unknown letter.
pub fn motions(letters: &str) -> Result<Vec<Elementary>> {
    let motion = |c: char| {
        Elementary::from_iso(&c.to_string())
            .ok_or_else(|| unknown("axis", &c.to_string(), &["X", "Y", "Z", "A", "B", "C", "7", "8", "9"]))
    };
    letters.chars().filter(|c| !c.is_whitespace()).map(motion).collect()
}

fn unknown(what: &str, name: &str, known: &[&str]) -> crate::base::Error {
    Finding::error(Code::JOB_SHAPE, format!("`{name}` is no {what}"))
        .help(format!("write one of {}", known.join(", ")))
        .into()
}

/// Drawings beside each other on a sheet.
const COLUMNS: usize = 4;

impl Answer for LayoutSheet {
    fn sections(&self) -> Vec<Section> {
        page::sections(self)
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }

    /// A search that finds nothing is an answer that says no.
    fn is_no(&self) -> bool {
        self.layouts.is_empty()
    }

    fn svg(&self) -> Result<String> {
        let title = format!("{}: {} of {} layouts", self.of, self.layouts.len(), self.left);
        Ok(layouts_drawing(&title, &self.layouts, &self.sizes, COLUMNS))
    }

    fn files(answers: &[&LayoutSheet]) -> Result<Outputs> {
        let mut outputs = Outputs::default();
        answers.iter().for_each(|sheet| outputs.add("layouts.html", layouts_html(sheet)));
        Ok(outputs)
    }
}
