//! Items that nobody checked in a run. A sentence that would come in every verdict says nothing, and is left out.

use std::collections::BTreeMap;

use super::super::check::Job;
use super::super::contacts::machine::MachineContacts;
use super::super::setup_outcome::SetupOutcome;
use super::super::simulate::Simulation;
use super::{Heading, UncheckedList};
use crate::job::TakenData;
use crate::job::engagement::force_of;
use crate::tool::{Cutter, Tool, ToolNumber};
use crate::trace::StandKind;

/// Items of the programs that were not checked.
pub(in crate::job) fn not_checked(
    job: &Job,
    setups: &[SetupOutcome],
    simulation: &Simulation,
) -> UncheckedList {
    let mut list = UncheckedList::default();
    if job.design.is_none() {
        let what = if setups.iter().any(|s| s.external.is_none()) {
            "no design mesh given: surfaces that no operation names are not compared"
        } else {
            "no design mesh given: the part is not compared with anything"
        };
        list.add(Heading::Shape, what);
    }
    bodies(job, setups, simulation, &mut list);
    if let Some(certificate) = &simulation.certificate {
        let uncertain = [
            (certificate.left_out, "moves of drills that leave a core: not certified"),
            (
                certificate.sampled,
                "moves along spirals and cubics: certified with a sampled bound on their curvature",
            ),
        ];
        for (count, what) in uncertain.into_iter().filter(|(count, _)| *count > 0) {
            list.add(Heading::Moves, format!("{count} {what}"));
        }
    }
    tools(job, setups, &mut list);
    travel(job, &mut list);
    load(job, setups, simulation, &mut list);
    not_compared(job, setups, &mut list);
    for done in setups {
        program(done, &mut list);
    }
    list
}

/// Cuts deeper than their speeds and feeds are for; power and torque, where the machine says what its spindle has.
fn load(job: &Job, setups: &[SetupOutcome], simulation: &Simulation, list: &mut UncheckedList) {
    if simulation.engagement.is_none() && job.cutting.iter().any(TakenData::has_start) {
        let what = "the depth of cuts with values to start with: engagement was not measured (simulate.engagement = true)";
        list.add(Heading::Tools, what);
    }
    let Some(machine) = &job.machine else { return };
    if !machine.knows_spindle() {
        return;
    }
    if force_of(job.material.as_deref()).is_none() {
        let what = "what the cuts need of the spindle: the job has no material whose cutting force is known";
        list.add(Heading::Tools, what);
    } else if simulation.engagement.is_none() {
        let what =
            "what the cuts need of the spindle: engagement was not measured (simulate.engagement = true)";
        list.add(Heading::Tools, what);
    }
    let forms = |tool: &&Tool| matches!(&tool.cutter, Cutter::Tap(tap) if tap.forming);
    let runs = |tool: &Tool| {
        let mut moves = setups.iter().flat_map(|done| &done.trace.segments);
        moves.any(|segment| segment.tool == Some(tool.number))
    };
    if job.tools.iter().filter(forms).any(runs) {
        list.add(Heading::Tools, "the torque of taps that form their thread: no formula for it is known");
    }
}

/// Clamps, fixtures and the machine's own bodies.
fn bodies(job: &Job, setups: &[SetupOutcome], simulation: &Simulation, list: &mut UncheckedList) {
    let bare: Vec<String> = (1..)
        .zip(&job.setups)
        .filter(|(_, setup)| setup.setup.fixtures.is_empty())
        .map(|(number, _)| number.to_string())
        .collect();
    let of_machine = job.machine.as_ref().map_or(0, |machine| machine.bodies.len());
    let none_given = bare.len() == job.setups.len();
    if none_given && of_machine == 0 {
        list.add(Heading::Bodies, "clamps, fixtures and the machine's own bodies: not modelled");
        return;
    }
    if none_given {
        list.add(Heading::Bodies, "clamps and fixtures: not modelled");
    } else if !bare.is_empty() {
        let setups = if bare.len() == 1 { "setup" } else { "setups" };
        list.add(Heading::Bodies, format!("clamps and fixtures of {setups} {}: not given", bare.join(", ")));
    }
    if of_machine == 0 {
        let what = "the machine's own bodies: not modelled, fixtures are compared with tools, shanks and holders only";
        list.add(Heading::Bodies, if none_given { "the machine's own bodies: not modelled" } else { what });
    }
    for (setup, done) in job.setups.iter().zip(setups).filter(|(own, _)| !own.setup.fixtures.is_empty()) {
        changes(job, setup.setup.located, done, list);
    }
    for (done, contacts) in setups.iter().zip(&simulation.machine) {
        if let Some(contacts) = contacts {
            of_machine_in(done, contacts, list);
        }
    }
}

/// Tool changes among clamps and fixtures: a tool comes there by its length.
fn changes(job: &Job, located: bool, done: &SetupOutcome, list: &mut UncheckedList) {
    let changed = done.trace.stands.iter().filter_map(|stand| match stand.kind {
        StandKind::Change(number) => Some((stand.item, number)),
        _ => None,
    });
    let length = |number| job.tools.iter().find(|t| t.number == number).and_then(|t| t.gauge_length);
    let unknown = |number: &ToolNumber| !located || length(*number).is_none();
    let lines: Vec<u32> = changed
        .filter(|(_, number)| unknown(number))
        .filter_map(|(item, _)| done.lines.get(item as usize).copied().flatten().map(|l| l + 1))
        .collect();
    if !lines.is_empty() {
        let reason = if located { "its gauge length" } else { "the place of the part on the machine" };
        let what = format!(
            "the tool as it comes into the spindle: not compared with clamps and fixtures, {reason} is not given"
        );
        list.at(Heading::Bodies, &done.file, lines, what);
    }
}

/// Bodies of a machine along the program of a setup.
fn of_machine_in(done: &SetupOutcome, contacts: &MachineContacts, list: &mut UncheckedList) {
    let file = &done.file;
    let line = |item: u32| done.lines.get(item as usize).copied().flatten().map(|l| l + 1);
    let all = "the machine's bodies: not compared with the part, the tool and one another";
    if let Some(reason) = contacts.not_compared {
        list.at(Heading::Bodies, file, None, format!("{all}, {reason}"));
    }
    for tool in &contacts.without_length {
        list.at(
            Heading::Bodies,
            file,
            None,
            format!("{all} in moves of {tool}, its gauge length is not given"),
        );
    }
    if !contacts.met.lost.is_empty() {
        let items = contacts.met.lost.iter().map(|i| done.trace.segments[*i as usize].item);
        let mut lines: Vec<u32> = items.filter_map(line).collect();
        lines.dedup();
        list.at(Heading::Bodies, file, lines, format!("{all}, the positions of the axes are not known"));
    }
    for [standing, moving] in &contacts.touching {
        let [one, other] = [moving, standing].map(|i| &contacts.bodies[*i as usize].name);
        let what = format!("`{one}` and `{other}`: not compared, they touch where the program begins");
        list.at(Heading::Bodies, file, None, what);
    }
}

/// Surfaces that operations name and nothing is compared with, at the line where each operation begins.
fn not_compared(job: &Job, setups: &[SetupOutcome], list: &mut UncheckedList) {
    if job.design.is_some() {
        return;
    }
    let mut number = 0;
    for (setup, done) in job.setups.iter().zip(setups) {
        let begins = begins(done);
        for operation in &setup.operations {
            if let Some(what) = operation.not_compared().filter(|_| done.external.is_none()) {
                let line = begins.get(&number).and_then(|item| done.line_of_planned(*item));
                let what = format!("{what}: compared with nothing, there is no design mesh");
                list.at(Heading::Shape, &done.file, line.map(|l| l + 1), what);
            }
            number += 1;
        }
    }
}

/// For each operation of a plan, by its number over all setups, its first item that has a line.
fn begins(done: &SetupOutcome) -> BTreeMap<u32, u32> {
    let program = &done.planned.program;
    let mut begins = BTreeMap::new();
    for item in 0..program.items.len() as u32 {
        if let Some(number) = program.origin(item as usize).operation
            && !begins.contains_key(&number)
            && done.line_of_planned(item).is_some()
        {
            begins.insert(number, item);
        }
    }
    begins
}

fn tools(job: &Job, setups: &[SetupOutcome], list: &mut UncheckedList) {
    let used =
        |number| setups.iter().any(|s| s.trace.segments.iter().any(|segment| segment.tool == Some(number)));
    for tool in job.tools.iter().filter(|t| used(t.number)) {
        if tool.holder.is_none() {
            list.add(Heading::Tools, format!("holder of {}: not given", tool.number));
        }
        if tool.gauge_length.is_none() {
            let number = tool.number;
            list.add(
                Heading::Tools,
                format!("gauge length of {number}: not given, its height on the machine is not known"),
            );
        }
    }
}

fn travel(job: &Job, list: &mut UncheckedList) {
    match &job.machine {
        None => list.add(Heading::Travel, "travel of the axes: no machine given"),
        Some(machine) => {
            for axis in machine.joints.iter().filter(|a| a.travel.is_none()) {
                list.add(Heading::Travel, format!("travel of {}: not given", axis.letter));
            }
        }
    }
    for setup in job.setups.iter().filter(|s| !s.setup.located) {
        let name = &setup.setup.name;
        list.add(
            Heading::Travel,
            format!("place of {name} on the machine: not given, travel is compared by span only"),
        );
    }
}

fn program(done: &SetupOutcome, list: &mut UncheckedList) {
    let line = |item: u32| done.lines.get(item as usize).copied().flatten().map(|l| l + 1);
    for untraced in &done.trace.untraced {
        let what = "the program does not say where this move starts";
        list.at(Heading::Moves, &done.file, line(untraced.item), what);
    }
    for unfollowed in done.external.iter().flat_map(|f| &f.unfollowed) {
        list.at(Heading::Blocks, &done.file, unfollowed.line, &unfollowed.what);
    }
    for assumed in &done.trace.assumed {
        list.at(Heading::Assumed, &done.file, None, assumed);
    }
    if done.planned.operations.iter().any(|o| !o.plan.taken_out().is_empty()) {
        let what = "a loose core has to be taken out at the program stop";
        list.at(Heading::RegisterState, &done.file, None, what);
    }
}
