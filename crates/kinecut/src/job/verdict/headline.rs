//! The first sentence of a verdict, and of what it speaks: the same words in terminal, report, NC header and JSON.

use super::super::check::Job;
use super::super::contacts::machine::MachineContacts;
use super::super::setup_outcome::SetupOutcome;
use super::super::shape::Deviation;
use super::super::simulate::Simulation;
use super::Judgement;
use crate::base::{Finding, Severity};
use crate::operations::Operation;
use crate::operations::measured::BoreMeasure;

/// The outcome with its counts: "SAFE, 1 warning", "NOT SAFE, 5 errors".
pub(in crate::job) fn banner(found: &[Finding]) -> String {
    let count = |severity: Severity| found.iter().filter(|f| f.severity == severity).count();
    let outcome = Judgement::of(found);
    let (number, noun) = match outcome {
        Judgement::Safe => (count(Severity::Warning), "warning"),
        Judgement::NotProven => (count(Severity::Doubt), "doubt"),
        Judgement::NotSafe => (count(Severity::Error), "error"),
    };
    match number {
        0 => outcome.word().to_owned(),
        1 => format!("{outcome}, 1 {noun}"),
        n => format!("{outcome}, {n} {noun}s"),
    }
}

/// The reason of the outcome in one sentence, without a full stop: the worst finding, or that there is no fault.
pub(super) fn headline(found: &[Finding], files: &[String]) -> String {
    let outcome = Judgement::of(found);
    if outcome.is_safe() {
        return format!("No fault found in {}", files.join(", "));
    }
    let worst = found.iter().map(|f| f.severity).max();
    // Findings are in the order of the program.
    let Some(first) = found.iter().find(|f| Some(f.severity) == worst) else { return String::new() };
    let mut text = capital(&first.message);
    if let Some(value) = &first.value {
        text.push_str(&format!(", {value}"));
    }
    if let Some(place) = first.place.as_ref().filter(|p| p.line > 0) {
        match files {
            [only] if *only == place.file => text.push_str(&format!(", line {}", place.line)),
            _ => text.push_str(&format!(", `{}` line {}", place.file, place.line)),
        }
    }
    text
}

/// Subjects of the outcome, and inputs that nobody gave: sentences without a full stop.
pub(in crate::job) fn scope(
    job: &Job,
    setups: &[SetupOutcome],
    simulation: &Simulation,
    deviation: &Deviation,
) -> Vec<String> {
    let mut scope = vec![shape(job, deviation)];
    scope.extend(holders(job, setups));
    scope.push(bodies(job, simulation));
    if let Some(off) = job.uncertainty {
        scope.push(format!("Contacts of moving tools looked for with {}", off.words()));
    }
    if !job.machine.as_ref().is_some_and(|m| m.joints.iter().any(|j| j.travel.is_some())) {
        scope.push("Travel of the axes not given".to_owned());
    }
    scope
}

/// Bodies that were compared.
fn bodies(job: &Job, simulation: &Simulation) -> String {
    let of_machine = job.machine.as_ref().map_or(0, |m| m.bodies.len());
    let given = job.setups.iter().filter(|setup| !setup.setup.fixtures.is_empty()).count();
    let whole = |m: &Option<MachineContacts>| m.as_ref().is_some_and(MachineContacts::is_whole);
    let some = |m: &Option<MachineContacts>| m.as_ref().is_some_and(|m| m.compared > 0);
    let machine = match of_machine {
        0 => "machine bodies not modelled",
        _ if simulation.machine.iter().all(whole) => "machine bodies compared",
        _ if simulation.machine.iter().any(some) => "machine bodies compared in part",
        _ => "machine bodies not compared",
    };
    match (given, of_machine) {
        (0, 0) => "Clamps, fixtures and machine bodies not modelled".to_owned(),
        (0, _) => format!("Clamps and fixtures not modelled, {machine}"),
        (n, _) if n == job.setups.len() => format!("Fixtures as given compared, {machine}"),
        (n, _) => format!("Fixtures compared in {n} of {} setups, {machine}", job.setups.len()),
    }
}

/// Reference that the shape was compared with.
fn shape(job: &Job, deviation: &Deviation) -> String {
    // Pieces of a broken edge are one.
    let bores = &deviation.bores;
    let is_first = |i: usize| {
        let same = |b: &BoreMeasure| b.ends > 0 && b.operation == bores[i].operation;
        !bores[i].of_edge || !bores[..i].iter().any(same)
    };
    let walls = (0..bores.len()).filter(|i| is_first(*i)).map(|i| (bores[i].ends, bores[i].operation));
    let planes = deviation.faces.iter().map(|f| (f.ends, f.operation));
    let measured: Vec<&str> = walls
        .chain(planes)
        .filter(|(ends, _)| *ends > 0)
        .filter_map(|(_, number)| job.operation(number).map(Operation::noun))
        .collect();
    let count = |noun: &'static str| (noun, measured.iter().filter(|of| **of == noun).count());
    // Kinds may share their noun.
    let is_first = |i: usize| !Operation::NOUNS[..i].contains(&Operation::NOUNS[i]);
    let nouns = (0..Operation::NOUNS.len()).filter(|i| is_first(*i)).map(|i| Operation::NOUNS[i]);
    let counts = nouns.filter(|noun| !noun.is_empty()).map(count);
    let counted = counts.filter(|(_, n)| *n > 0).map(|(noun, n)| match n {
        1 => format!("1 {noun}"),
        n => format!("{n} {noun}s"),
    });
    let parts: Vec<String> = counted.collect();
    match (&job.design, parts.is_empty()) {
        (Some(_), _) => "Shape compared with the design".to_owned(),
        (None, true) => "Shape not compared: no design".to_owned(),
        (None, false) => format!("Shape compared at {} only: no design", parts.join(", ")),
    }
}

/// The tools that run without a holder.
fn holders(job: &Job, setups: &[SetupOutcome]) -> Option<String> {
    const NAMED: usize = 4;
    let used =
        |number| setups.iter().any(|s| s.trace.segments.iter().any(|segment| segment.tool == Some(number)));
    let bare: Vec<String> = job
        .tools
        .iter()
        .filter(|t| t.holder.is_none() && used(t.number))
        .map(|t| t.number.to_string())
        .collect();
    match bare.len() {
        0 => None,
        1 => Some(format!("Holder of {} not given", bare[0])),
        n if n <= NAMED => Some(format!("Holders of {} not given", bare.join(", "))),
        n => Some(format!("Holders of {n} tools not given")),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::{Code, Location};

    #[test]
    fn the_headline_is_the_first_of_the_worst_and_the_banner_counts_them() {
        let files = ["O1007.nc".to_owned()];
        let warning = Finding::warning(Code::FEED_IN_AIR, "feeds through air");
        assert_eq!(banner(&[]), "SAFE");
        assert_eq!(banner(std::slice::from_ref(&warning)), "SAFE, 1 warning");
        assert_eq!(headline(std::slice::from_ref(&warning), &files), "No fault found in O1007.nc");
        let place = Location { line: 48, ..Location::whole_file("O1007.nc") };
        let error = |what: &str| Finding::error(Code::RAPID_IN_STOCK, what).value(20.0, "mm deep");
        let found = [warning, error("a rapid move goes through stock").at(place), error("another")];
        assert_eq!(banner(&found), "NOT SAFE, 2 errors");
        assert_eq!(headline(&found, &files), "A rapid move goes through stock, 20 mm deep, line 48");
        // A line of another file is not one of the program.
        let place = Location { line: 7, ..Location::whole_file("job.toml") };
        let found = [error("stock is left").at(place)];
        assert_eq!(headline(&found, &files), "Stock is left, 20 mm deep, `job.toml` line 7");
    }
}
