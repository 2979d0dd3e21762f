//! What a person has to make sure of before the program runs, as the run took it, and by how much it may be off before something is met.

use serde::{Deserialize, Serialize};

use super::super::check::Job;
use super::super::contacts::LOOK;
use super::super::contacts::noun::noun;
use super::super::setup_outcome::SetupOutcome;
use super::super::simulate::Simulation;
use crate::contact::Party;
use crate::geom::Solid;
use crate::program::Item;
use crate::tool::{Tool, ToolNumber};

/// One thing to make sure of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ToEnsure {
    /// The thing.
    pub what: String,
    /// Its value as the run took it.
    pub value: String,
    /// By how much it may be off before a body that is given is met; the stock does not count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub room: Option<String>,
}

/// A pass of two bodies, or a contact.
struct Pass {
    tool: Option<ToolNumber>,
    words: String,
    distance: f64,
    item: u32,
}

/// The list for the programs of a job.
pub(in crate::job) fn to_ensure(
    job: &Job,
    setups: &[SetupOutcome],
    simulation: &Simulation,
) -> Vec<ToEnsure> {
    let mut list = vec![ToEnsure { what: "raw stock".to_owned(), value: stock(&job.stock), room: None }];
    for (i, done) in setups.iter().enumerate() {
        let own = &job.setups[i];
        let of = if setups.len() > 1 { format!(" of {}", own.setup.name) } else { String::new() };
        let passes = passes(job, done, simulation, i);
        let bodies = !own.setup.fixtures.is_empty()
            || simulation.machine[i].as_ref().is_some_and(|m| m.not_compared.is_none());
        let room = |of: &dyn Fn(&Pass) -> bool| bodies.then(|| room(done, passes.iter().filter(|p| of(p))));
        for (offset, zero) in &own.setup.work_offsets {
            let value = match own.setup.located {
                true => {
                    let [x, y, z] = zero.translation.to_array().map(millimetres);
                    format!("machine X {x} Y {y} Z {z}")
                }
                false => "where the job has its zero on the part".to_owned(),
            };
            list.push(ToEnsure { what: format!("{offset}{of}"), value, room: room(&|_| true) });
        }
        let names: Vec<String> = own.setup.fixtures.iter().map(|f| format!("`{}`", f.name)).collect();
        if !names.is_empty() {
            let value = format!("{}, where the job has them", names.join(", "));
            list.push(ToEnsure { what: format!("clamps and fixtures{of}"), value, room: None });
        }
        for tool in &job.tools {
            if done.trace.segments.iter().any(|s| s.tool == Some(tool.number)) {
                let room = room(&|pass| pass.tool == Some(tool.number));
                list.push(ToEnsure { what: format!("{}{of}", tool.number), value: value(tool, done), room });
            }
        }
        for (register, radius) in own.program.iter().flat_map(|program| &program.radii) {
            let value = format!("radius {} mm", millimetres(*radius));
            list.push(ToEnsure { what: format!("register D{register}{of}"), value, room: None });
        }
    }
    list
}

/// A length in words.
fn millimetres(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn stock(solid: &Solid) -> String {
    let size = solid.bounds().size().to_array().map(millimetres).join(" x ");
    match solid {
        Solid::Box(_) => format!("block {size} mm"),
        Solid::Cylinder { radius, height, .. } => {
            format!("cylinder {} mm in diameter, {} mm high", millimetres(2.0 * radius), millimetres(*height))
        }
        Solid::Mesh(_) => format!("as its mesh, {size} mm"),
    }
}

/// A tool with the length that the run took for it, and the register that holds it.
fn value(tool: &Tool, done: &SetupOutcome) -> String {
    let name = if tool.name.is_empty() { String::new() } else { format!("`{}`, ", tool.name) };
    let Some(length) = tool.gauge_length else { return format!("{name}its length as measured") };
    let items = &done.program.items;
    let register = items.few().find_map(|i| match items.get(i) {
        // That of its own number needs no word.
        Item::Tool { id, length: Some(register), .. } if id == tool.number && register != id.0 => {
            Some(register)
        }
        _ => None,
    });
    let register = register.map(|r| format!(" in register {r}")).unwrap_or_default();
    format!("{name}gauge length {} mm{register}", millimetres(length))
}

/// Passes and contacts along the program of a setup.
fn passes(job: &Job, done: &SetupOutcome, simulation: &Simulation, setup: usize) -> Vec<Pass> {
    let segment = |watched: u32| &done.trace.segments[watched as usize];
    let fixtures = simulation.meetings[setup].iter().map(|m| {
        let name = &job.setups[setup].setup.fixtures[m.body as usize].name;
        let segment = segment(m.watched);
        let words = format!("the {} and `{name}`", noun(m.part));
        Pass { tool: segment.tool, words, distance: m.distance, item: segment.item }
    });
    let machine = simulation.machine[setup].iter().flat_map(|contacts| {
        contacts.met.meetings.iter().map(|m| {
            let segment = segment(m.watched);
            let tool = segment.tool.filter(|_| matches!(m.moving, Party::Tool(_)));
            let words =
                format!("{} and {}", contacts.party(m.moving), contacts.party(Party::Body(m.standing)));
            Pass { tool, words, distance: m.distance, item: segment.item }
        })
    });
    fixtures.chain(machine).collect()
}

/// The nearest pass in words.
fn room<'a>(done: &SetupOutcome, passes: impl Iterator<Item = &'a Pass>) -> String {
    let Some(nearest) = passes.min_by(|a, b| a.distance.total_cmp(&b.distance)) else {
        return format!("more than {LOOK} mm");
    };
    let line = done.lines.get(nearest.item as usize).copied().flatten();
    let line = line.map(|line| format!(", line {}", line + 1)).unwrap_or_default();
    match nearest.distance {
        0.0 => format!("{} touch{line}", nearest.words),
        // Not more than there is.
        distance => format!("{:.2} mm: {}{line}", (distance * 100.0).floor() / 100.0, nearest.words),
    }
}
