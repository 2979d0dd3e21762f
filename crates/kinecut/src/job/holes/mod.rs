//! Holes by their size: the operations that make them, with tools that are taken by their diameters.

mod choose;
mod material;
mod recess;
mod size;
mod steps;

use self::choose::ToolList;
use self::size::Size;
use self::steps::{Maker, Named, Step};
use super::file::{HoleTable, JobFile};
use super::library::Shop;
use super::places::Places;
use crate::base::{Code, Finding, Result};
use crate::nc::Control;
use crate::operations::{CalledTool, OperationTable};

/// Puts operations in the place of the holes of all setups; from then on the places of keys are those of the new list. Notes about
/// tools that were chosen come back, each with the key of its operation.
///
/// # Errors
/// One finding with its key in the text as it was read.
pub(super) fn expand(file: &mut JobFile, places: &mut Places, shop: &mut Shop) -> Result<Vec<Finding>> {
    let mut notes = Vec::new();
    // A control that is not known is an error later.
    let Ok(control) = Control::parse(&file.post.control) else { return Ok(notes) };
    for s in 0..file.setups.len() {
        if file.setups[s].holes.is_empty() {
            continue;
        }
        let entries = entries(&mut file.setups[s]);
        let list = format!("setup[{s}].operation");
        let (mut operations, mut origins) = (Vec::new(), Vec::new());
        let mut own = Vec::new();
        let mut group: Vec<(usize, Step)> = Vec::new();
        // The height of the face milled last.
        let mut top = 0.0;
        for (at, entry) in entries {
            match entry {
                Entry::Operation(operation) => {
                    drain(&mut group, &mut operations, &mut origins);
                    top = operation.face().map_or(top, |face| face.top);
                    operations.push(*operation);
                    origins.push(at);
                }
                Entry::Hole(hole) => {
                    let key = format!("{list}[{at}]");
                    let (steps, found) =
                        made(&hole, top, control, file, places, shop).map_err(|e| e.under(&key))?;
                    group.extend(steps.into_iter().map(|step| (at, step)));
                    own.extend(found.into_iter().map(|f| (at, f)));
                }
            }
        }
        drain(&mut group, &mut operations, &mut origins);
        places.renumber(&list, &origins);
        notes.extend(own.into_iter().map(|(at, finding)| {
            let first = origins.iter().position(|origin| *origin == at).unwrap_or_default();
            finding.under(&format!("{list}[{first}]"))
        }));
        file.setups[s].operations = operations;
    }
    Ok(notes)
}

/// An entry of a setup.
enum Entry {
    Operation(Box<OperationTable>),
    Hole(Box<HoleTable>),
}

/// The entries of a setup in the order of the text, each with its place there.
fn entries(setup: &mut super::file::SetupTable) -> Vec<(usize, Entry)> {
    let holes = std::mem::take(&mut setup.holes);
    let taken: Vec<usize> = holes.iter().map(|(at, _)| *at).collect();
    let free = (0..).filter(|at| !taken.contains(at));
    let operations = std::mem::take(&mut setup.operations).into_iter().map(|o| Entry::Operation(Box::new(o)));
    let mut entries: Vec<(usize, Entry)> = free.zip(operations).collect();
    entries.extend(holes.into_iter().map(|(at, hole)| (at, Entry::Hole(Box::new(hole)))));
    entries.sort_by_key(|(at, _)| *at);
    entries
}

/// Appends the steps of holes that follow one another: all spots, then all drills, then what brings them to size; of each those
/// with one tool together.
fn drain(group: &mut Vec<(usize, Step)>, operations: &mut Vec<OperationTable>, origins: &mut Vec<usize>) {
    let steps = std::mem::take(group);
    let first = |step: &Step| {
        steps.iter().position(|(_, s)| (s.stage, s.tool) == (step.stage, step.tool)).unwrap_or(usize::MAX)
    };
    let mut order: Vec<usize> = (0..steps.len()).collect();
    order.sort_by_key(|&i| (steps[i].1.stage, first(&steps[i].1), i));
    for i in order {
        operations.push(steps[i].1.table.clone());
        origins.push(steps[i].0);
    }
}

/// The operations of a hole, and notes.
fn made(
    hole: &HoleTable,
    top: f64,
    control: Control,
    file: &mut JobFile,
    places: &mut Places,
    shop: &mut Shop,
) -> Result<(Vec<Step>, Vec<Finding>)> {
    let size = Size::of(&hole.size, file.units.unwrap_or_default().units().mm())?;
    // Tools by name are taken first: the rest knows them by their numbers.
    let no_tool = None;
    let countersink = hole.countersink.as_ref().map_or(&no_tool, |c| &c.tool);
    let counterbore = hole.counterbore.as_ref().map_or(&no_tool, |c| &c.tool);
    let keys = [
        ("spot_drill", &hole.spot_drill),
        ("drill", &hole.drill),
        ("tool", &hole.tool),
        ("countersink.tool", countersink),
        ("counterbore.tool", counterbore),
    ];
    let mut numbers = [None; 5];
    for (number, (key, called)) in numbers.iter_mut().zip(keys) {
        let Some(called) = called else { continue };
        let found = shop.call(file, places, called).map_err(|e| renamed(e, key))?;
        *number = Some(found.ok_or_else(|| undefined(called, key))?);
    }
    let find = |number: Option<u32>| number.and_then(|n| file.tools.iter().find(|tool| tool.number == n));
    let [spot, drill, tool, countersink, counterbore] = numbers.map(find);
    let named = Named { spot, drill, tool, recess: countersink.or(counterbore) };
    for ((key, called), found) in keys.into_iter().zip([spot, drill, tool, countersink, counterbore]) {
        if let (Some(called), None) = (called, found) {
            return Err(undefined(called, key).into());
        }
    }
    let list = ToolList { tools: shop.usable(file), place: shop.place() };
    let mut maker =
        Maker { hole, size, top: hole.top.unwrap_or(top), control, tools: &list, named, notes: Vec::new() };
    let steps = maker.steps()?;
    material::known(file.material.as_deref())?;
    let notes = maker.notes.iter().map(|note| Finding::note(Code::TOOL_CHOSEN, note.clone()).key("size"));
    Ok((steps, notes.collect()))
}

/// An error about a tool that has the key of the hole.
fn renamed(mut error: crate::base::Error, key: &str) -> crate::base::Error {
    if error.0.key.as_deref() == Some("tool") {
        error.0.key = Some(key.to_owned());
    }
    error
}

fn undefined(called: &CalledTool, key: &str) -> Finding {
    Finding::error(Code::JOB_REFERENCE, format!("{called} is not defined"))
        .help("define it with [[tool]]")
        .key(key)
}
