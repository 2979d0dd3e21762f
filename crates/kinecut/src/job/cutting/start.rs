//! Values to start with for a tool of a job.

use crate::base::{Code, Finding};
use crate::cutting::{Material, StartCut, StartData};
use crate::job::file::{ToolTable, ToolType};

/// Least likeness of a name that is proposed.
const ALIKE: f64 = 0.7;
/// Engagement from which on a cutter cuts in its full width [rad].
const WHOLE: f64 = std::f64::consts::PI - 1e-3;
/// Most names that are proposed.
const PROPOSED: usize = 3;

/// Values to start with, and the material of the edges where the tool does not say it.
pub(super) fn start_of(
    material: &Material,
    cut: StartCut,
    tool: &ToolTable,
) -> Option<(StartData, Option<&'static str>)> {
    let edge = tool.edge_material();
    let cut = cut_of(tool.kind, cut);
    let data = material.start(cut, edge, largest(tool), tool.stickout)?;
    Some((data, tool.material.is_none().then_some(edge.name())))
}

/// The largest diameter of a tool [mm].
pub(super) fn largest(tool: &ToolTable) -> f64 {
    match (tool.kind, tool.half_angle) {
        (ToolType::Tapered, Some(half)) => tool.diameter + 2.0 * tool.flute_length * half.to_radians().tan(),
        _ => tool.diameter,
    }
}

/// The cut of a kind of tool: a face mill cuts as one wherever it is used, and an end mill on a face as in its full width.
pub(super) fn cut_of(kind: ToolType, cut: StartCut) -> StartCut {
    match (kind, cut) {
        (ToolType::FaceMill, _) => StartCut::Face,
        (_, StartCut::Face) => StartCut::Slot,
        (_, StartCut::Side(arc)) if arc >= WHOLE => StartCut::Slot,
        (_, cut) => cut,
    }
}

/// The error of an operation that lacks `lack` where nothing has it: neither a preset nor a row of values to start with.
pub(super) fn none_there(lack: &str, tool: &ToolTable, material: &str, table: Option<&str>) -> Finding {
    let shown = material.escape_debug();
    let number = tool.number;
    let (why, first) = match Material::of(material) {
        Some(_) => (format!("there are no values to start with for {shown}"), String::new()),
        None => {
            let near = near(material);
            let first = if near.is_empty() { String::new() } else { format!("did you mean {near}? or ") };
            (format!("the material `{shown}` is not known"), first)
        }
    };
    let row = table.map(|file| format!(" `{file}` has no row for it,")).unwrap_or_default();
    let message = format!("the operation needs {lack}: T{number} has no preset for {shown},{row} and {why}");
    let give = match lack {
        "a feed" => "give feed_per_tooth or feed_per_rev (mm)",
        _ => "give cutting_speed (m/min) or speed (rev/min)",
    };
    let help = format!("{first}{give}, or T{number} a [[tool.preset]] for this material");
    Finding::error(Code::JOB_SHAPE, message).help(help)
}

/// Names of materials like a name.
fn near(name: &str) -> String {
    let plain = name.to_lowercase();
    let all = Material::all().iter().filter(|m| m.has_start());
    let like = |m: &Material| {
        m.names().map(|other| strsim::jaro_winkler(&plain, &other.to_lowercase())).fold(0.0, f64::max)
    };
    let mut names: Vec<(f64, &str)> = all.map(|m| (like(m), m.name)).filter(|(a, _)| *a > ALIKE).collect();
    names.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    let names: Vec<String> = names.iter().take(PROPOSED).map(|(_, name)| format!("`{name}`")).collect();
    names.join(" or ")
}
