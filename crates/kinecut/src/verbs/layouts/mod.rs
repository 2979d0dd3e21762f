//! Layouts of a code or a set of axes, in the units of the shop: the question as a command line puts it, the answer as a
//! table.

mod page;
pub(crate) mod show;

pub use page::layouts_html;
pub use show::{
    layout_drawing, layout_figure, layout_scheme, layout_sheet as layouts_drawing, machine_drawing,
    machine_drawing_at,
};

use serde::Serialize;

use crate::base::{Code, Finding, Result};
use crate::job::Outputs;
use crate::machine::Elementary;
use crate::machine::layouts::{Attitude, Criterion, Layout, LayoutKind, Query, Sizes, layouts};
use crate::page::Section;
use crate::verbs::Answer;

/// Measures of a workspace, where strokes or a part are given.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WorkspaceRow {
    /// Product of the strokes, in litres.
    pub litres: f64,
    /// Space that both work and tool pass over the space that one of them passes.
    pub utilisation: f64,
    /// Volume of the workspace over that of the box about all that moves.
    pub space_efficiency: f64,
    /// Side of the largest cube that can be worked in all directions of the worked tilt [mm].
    pub largest_cube: Option<f64>,
    /// Its volume over that of the workspace.
    pub orientation_space: Option<f64>,
    /// Ranges of the rotary axes over what could be of use.
    pub orientation_angle: Option<f64>,
}

/// A layout with its raw scores.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LayoutRow {
    /// Digits.
    pub code: String,
    /// As ISO 10791 writes it.
    pub iso: String,
    /// Canonical word of its class.
    pub class: String,
    /// Where its rotary axes are.
    pub kind: &'static str,
    /// How the spindle stands.
    pub spindle: &'static str,
    /// Rank modulo the spin of the tool.
    pub rank: usize,
    /// Whether the translations stay at right angles.
    pub regular: bool,
    /// Axes that carry the work.
    pub work_links: usize,
    /// Rotary axes that carry the work.
    pub work_rotaries: usize,
    /// Rotary axes that carry the tool.
    pub tool_rotaries: usize,
    /// Sum over the axes of the mass that each moves.
    pub moved_mass: f64,
    /// Mass that the vertical axis lifts.
    pub lifted_mass: f64,
    /// Strokes that do not run on the bed [mm].
    pub overhang: f64,
    /// Shift of the tip by the errors of the links [mm].
    pub error_gain: f64,
    /// Strokes [mm].
    pub stroke: [f64; 3],
    /// Share of all directions that is reached.
    pub cover: Option<f64>,
    /// Angle from home within which all directions are reached [deg].
    pub tilt_deg: Option<f64>,
    /// Measures of the workspace, where strokes or a part are given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub workspace: Option<WorkspaceRow>,
    /// Weighted sum of the scores, each from 0 for the best of the list to 1 for the worst.
    pub cost: f64,
    /// Whether no other one is as good in all that counts and better in something.
    pub pareto: bool,
}

/// The answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LayoutSheet {
    /// What was asked.
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
    pub layouts: Vec<LayoutRow>,
    /// What a person should know.
    pub findings: Vec<Finding>,
    /// The layouts themselves, for drawings.
    #[serde(skip)]
    pub found: Vec<Layout>,
    /// Sizes that they were asked with.
    #[serde(skip)]
    pub sizes: Sizes,
}

/// All layouts that are asked for, the best first; `of` is what they are layouts of, in words; `sized` tells whether strokes
/// or a part were given, so that workspaces are measured.
///
/// # Errors
/// `KC1121`, `KC1122` for too many axes or a number out of range.
pub fn layout_sheet(of: &str, query: &Query, sized: bool) -> Result<LayoutSheet> {
    let found = layouts(query)?;
    let classes = found.classes().len();
    let left = found.layouts.len();
    let shown: Vec<Layout> = found.layouts.into_iter().take(query.listed).collect();
    Ok(LayoutSheet {
        of: of.to_owned(),
        enumerated: found.enumerated,
        left_out: found.left_out,
        left,
        classes,
        layouts: shown.iter().map(|l| row(l, sized)).collect(),
        findings: found.findings,
        found: shown,
        sizes: query.sizes.clone(),
    })
}

/// How the spindle stands: "vertical", "horizontal", "both".
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
/// `KC0102` for a name that is none.
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
/// `KC0102` for a name that is none.
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
/// `KC0102` for a letter that is none.
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

fn row(l: &Layout, sized: bool) -> LayoutRow {
    LayoutRow {
        code: l.code.to_string(),
        iso: l.code.iso(),
        class: l.class.to_string(),
        kind: l.kind.name(),
        spindle: l.attitude.name(),
        rank: l.rank,
        regular: l.regular,
        work_links: l.scores.work_links,
        work_rotaries: l.scores.work_rotaries,
        tool_rotaries: l.scores.tool_rotaries,
        moved_mass: l.scores.moved_mass,
        lifted_mass: l.scores.lifted_mass,
        overhang: l.scores.overhang,
        error_gain: l.scores.error_gain,
        stroke: l.stroke,
        cover: l.reach.map(|r| r.cover),
        tilt_deg: l.reach.map(|r| r.tilt.to_degrees()),
        workspace: l.workspace.filter(|_| sized).map(|w| WorkspaceRow {
            litres: w.volume * 1e-6,
            utilisation: w.utilisation,
            space_efficiency: w.space_efficiency,
            largest_cube: w.largest_cube,
            orientation_space: w.orientation_space,
            orientation_angle: w.orientation_angle,
        }),
        cost: l.cost,
        pareto: l.pareto,
    }
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
        self.found.is_empty()
    }

    fn svg(&self) -> Result<String> {
        let title = format!("{}: {} of {} layouts", self.of, self.found.len(), self.left);
        Ok(layouts_drawing(&title, &self.found, &self.sizes, COLUMNS))
    }

    fn files(answers: &[&LayoutSheet]) -> Result<Outputs> {
        let mut outputs = Outputs::default();
        answers.iter().for_each(|sheet| outputs.add("layouts.html", layouts_html(sheet)));
        Ok(outputs)
    }
}
