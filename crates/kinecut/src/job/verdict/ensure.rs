//! The list that a person goes through before the program runs: each thing as the run took it, and by how much it may be off before
//! something is met.

use serde::{Deserialize, Serialize};

use super::super::check::Job;
use super::super::contacts::machine::{BodyKind, MachineContacts};
use super::super::contacts::noun::noun;
use super::super::contacts::{ACCURACY, LOOK};
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
        let compared =
            Compared { fixtures: !own.setup.fixtures.is_empty(), machine: simulation.machine[i].as_ref() };
        let room = |tool: Option<ToolNumber>| {
            let own = passes.iter().filter(|pass| tool.is_none() || pass.tool == tool);
            compared.any(tool).then(|| room(done, own, compared.all(tool)))
        };
        for (offset, zero) in &own.setup.work_offsets {
            let value = match own.setup.located {
                true => {
                    let [x, y, z] = zero.translation.to_array().map(millimetres);
                    format!("machine X {x} Y {y} Z {z}")
                }
                false => "where the job has its zero on the part".to_owned(),
            };
            list.push(ToEnsure { what: format!("{offset}{of}"), value, room: room(None) });
        }
        let names: Vec<String> = own.setup.fixtures.iter().map(|f| format!("`{}`", f.name)).collect();
        if !names.is_empty() {
            let value = format!("{}, where the job has them", names.join(", "));
            list.push(ToEnsure { what: format!("clamps and fixtures{of}"), value, room: None });
        }
        for tool in &job.tools {
            if done.trace.segments.iter().any(|s| s.tool == Some(tool.number)) {
                let (what, value) = (format!("{}{of}", tool.number), value(tool, done));
                list.push(ToEnsure { what, value, room: room(Some(tool.number)) });
            }
        }
        let given = own.program.iter().flat_map(|program| &program.radii);
        let mut radii: Vec<(u32, f64)> = given.chain(&done.planned.radii).copied().collect();
        radii.sort_by_key(|(register, _)| *register);
        radii.dedup();
        for (register, radius) in radii {
            // As the operator types it.
            let value = match job.post.control.compensation_radius(1.0) {
                1.0 => format!("radius {} mm", millimetres(radius)),
                share => format!("diameter {} mm", millimetres(radius / share)),
            };
            list.push(ToEnsure { what: format!("register D{register}{of}"), value, room: None });
        }
    }
    list
}

/// Bodies of a setup that were compared.
#[derive(Clone, Copy)]
struct Compared<'a> {
    fixtures: bool,
    machine: Option<&'a MachineContacts>,
}

impl Compared<'_> {
    fn lacks_length(of: &MachineContacts, tool: Option<ToolNumber>) -> bool {
        match tool {
            Some(tool) => of.without_length.contains(&tool),
            None => !of.without_length.is_empty(),
        }
    }

    /// Whether anything was compared with a tool, or with anything.
    fn any(&self, tool: Option<ToolNumber>) -> bool {
        let by_machine =
            |m: &MachineContacts| m.compared > 0 && (tool.is_none() || !Compared::lacks_length(m, tool));
        self.fixtures || self.machine.is_some_and(by_machine)
    }

    /// Whether all was compared in all of its moves.
    fn all(&self, tool: Option<ToolNumber>) -> bool {
        self.machine.is_none_or(|m| {
            m.not_compared.is_none() && m.met.lost.is_empty() && !Compared::lacks_length(m, tool)
        })
    }
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

/// Passes and contacts along the program of a setup; those of the stock do not count.
fn passes(job: &Job, done: &SetupOutcome, simulation: &Simulation, setup: usize) -> Vec<Pass> {
    let segment = |watched: u32| &done.trace.segments[watched as usize];
    let fixtures = simulation.meetings[setup].iter().map(|m| {
        let name = &job.setups[setup].setup.fixtures[m.body as usize].name;
        let segment = segment(m.watched);
        let words = format!("the {} and `{name}`", noun(m.part));
        Pass { tool: segment.tool, words, distance: m.distance, item: segment.item }
    });
    let machine = simulation.machine[setup].iter().flat_map(|contacts| {
        let name = |body: u32| contacts.party(Party::Body(body));
        let touching = contacts.touching.iter().map(move |[standing, moving]| {
            let words = format!("{} and {}", name(*moving), name(*standing));
            Pass { tool: None, words, distance: 0.0, item: contacts.begins }
        });
        let stock =
            |body: u32| matches!(contacts.bodies[body as usize].kind, BodyKind::Stock | BodyKind::StockThen);
        let met = contacts.met.meetings.iter().filter(move |m| !stock(m.standing)).map(move |m| {
            let segment = segment(m.watched);
            let tool = segment.tool.filter(|_| matches!(m.moving, Party::Tool(_)));
            let words =
                format!("{} and {}", contacts.party(m.moving), contacts.party(Party::Body(m.standing)));
            Pass { tool, words, distance: m.distance, item: segment.item }
        });
        touching.chain(met)
    });
    fixtures.chain(machine).collect()
}

/// The nearest pass in words; whether all was compared in all moves.
fn room<'a>(done: &SetupOutcome, passes: impl Iterator<Item = &'a Pass>, all: bool) -> String {
    let compared = if all { "" } else { ", in the moves compared" };
    let Some(nearest) = passes.min_by(|a, b| a.distance.total_cmp(&b.distance)) else {
        return format!("more than {LOOK} mm{compared}");
    };
    let line = done.lines.get(nearest.item as usize).copied().flatten();
    let line = line.map(|line| format!(", line {}", line + 1)).unwrap_or_default();
    match nearest.distance {
        0.0 => format!("{} touch{line}", nearest.words),
        // Not more than there is.
        distance => {
            let least = ((distance - ACCURACY).max(0.0) * 100.0).floor() / 100.0;
            format!("{least:.2} mm: {}{line}{compared}", nearest.words)
        }
    }
}
