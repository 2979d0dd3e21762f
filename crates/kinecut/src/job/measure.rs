//! Measures that the operations of a job want taken in the stock while it is cut, and the comparison with their plans.

use std::ops::Range;

use super::check::Job;
use super::setup_outcome::SetupOutcome;
use super::simulate::Simulation;
use crate::operations::measured::{Loose, Probe, WallProbe};
use crate::operations::{Found, Judged, OperationPlan, Probes, Tally};
use crate::program::{Item, Program, StopKind};
use crate::stock::PointEngagement;

/// Most points that are measured: a measure of a hole of 20 mm holds 80 kB at a grid of 0.25 mm, half a megabyte at 0.1 mm.
const MOST_PROBES: usize = 500;

/// A planned operation with what was measured for it.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Index of its setup.
    pub setup: usize,
    /// Its index among the planned operations of the setup.
    pub index: usize,
    probes: Probes,
    /// Its points among those of the simulation.
    points: Range<usize>,
    /// Its walls among those of the simulation.
    walls: Option<usize>,
    /// The result of comparing it with the plan.
    pub(super) judged: Judged,
}

impl Measured {
    /// The engagements of its points.
    pub(crate) fn points<'a>(&self, simulation: &'a Simulation) -> &'a [PointEngagement] {
        simulation.engagements.get(self.points.clone()).unwrap_or(&[])
    }
}

/// The measures wanted by all operations.
#[derive(Debug, Default)]
pub(super) struct Wanted {
    /// Points.
    pub(super) points: Vec<Probe>,
    /// Walls.
    pub(super) walls: Vec<WallProbe>,
    measured: Vec<Measured>,
}

/// Asks the operations.
pub(super) fn wanted(job: &Job, setups: &[SetupOutcome]) -> Wanted {
    let mut wanted = Wanted::default();
    for (setup, done) in setups.iter().enumerate() {
        let posted = done.posted_plan(setup, &job.setups[setup]);
        for (index, operation) in done.planned.operations.iter().enumerate() {
            let first = wanted.points.len();
            let probes = operation.plan.probes(&posted, MOST_PROBES - first);
            wanted.points.extend(probes.points.iter().cloned());
            let walls = probes.walls.map(|_| wanted.walls.len());
            wanted.walls.extend(probes.walls);
            let points = first..wanted.points.len();
            wanted.measured.push(Measured { setup, index, probes, points, walls, judged: Judged::default() });
        }
    }
    wanted
}

/// Lets the operations compare their plans with what was measured.
pub(super) fn judged(
    job: &Job,
    setups: &mut [SetupOutcome],
    wanted: Wanted,
    simulation: &Simulation,
) -> Vec<Measured> {
    let mut measured = wanted.measured;
    for (setup, done) in setups.iter_mut().enumerate() {
        let mut operations = std::mem::take(&mut done.planned.operations);
        let posted = done.posted_plan(setup, &job.setups[setup]);
        for m in measured.iter_mut().filter(|m| m.setup == setup) {
            let Some(operation) = operations.get_mut(m.index) else { continue };
            let walls = m.walls.and_then(|i| simulation.walls.get(i)).map_or(&[][..], Vec::as_slice);
            let found = Found { step: job.step, probes: &m.probes, points: m.points(simulation), walls };
            let name = job.operation(operation.number).map(|o| o.name()).unwrap_or_default();
            m.judged = operation.plan.judge(&name, &posted, &found);
        }
        done.planned.operations = operations;
    }
    measured
}

/// The tallies of all operations, each with its plan.
pub(super) fn tallies<'a>(
    setups: &'a [SetupOutcome],
    measured: &[Measured],
) -> Vec<(&'a OperationPlan, Tally)> {
    let of = |m: &Measured| {
        let plan = &setups.get(m.setup)?.planned.operations.get(m.index)?.plan;
        Some((plan, m.judged.tally))
    };
    measured.iter().filter_map(of).collect()
}

/// The cores that leave the stock while the program of a setup runs: those that are taken out at the stops of the text that
/// were written for stops of the plan, and those that fall out.
pub(super) fn loose_cores(job: &Job, setup: usize, done: &SetupOutcome) -> Vec<Loose> {
    let clamping = &job.setups[setup];
    let posted = done.posted_plan(setup, clamping);
    let to_part = clamping.to_work().inverse();
    let stop =
        |program: &Program, i: u32| matches!(program.items.get(i as usize), Item::Stop(StopKind::Program));
    let plans = || done.planned.operations.iter().map(|o| &o.plan);
    let mut cores: Vec<Loose> = (0..done.program.items.len() as u32)
        .filter(|&i| stop(&done.program, i))
        .filter(|&i| done.planned_item(i).is_some_and(|p| stop(&done.planned.program, p)))
        .zip(plans().flat_map(OperationPlan::taken_out))
        .map(|(item, core)| Loose {
            item,
            centre: to_part.point(core.centre),
            out: to_part.vector(core.out),
            diameter: core.diameter,
            depth: core.depth,
        })
        .collect();
    cores.extend(plans().flat_map(|plan| plan.falling(&posted)));
    cores.sort_by_key(|c| c.item);
    cores
}

#[cfg(test)]
mod tests {
    use super::super::run::{followed, run};
    use super::*;
    use crate::base::{Code, MemoryLoader, Silent};
    use crate::nc::Posted;

    /// M8, 5 deep, in a hole that is there.
    const THREAD: &str = r#"format = 1
post = { control = "fanuc" }
stock = { box = { min = [10, 0, -30], max = [30, 20, 0] } }
drilled = [{ at = [20, 10], diameter = 6.647, top = 0, bottom = -30 }]
simulate = { step = 0.5, engagement = false }
[[tool]]
number = 4
type = "thread-mill"
diameter = 5
pitch = 1.25
teeth = 3
flute_length = 1.25
neck_diameter = 2.8
neck_length = 22
shank_diameter = 6
stickout = 40
gauge_length = 110
[[setup]]
offset = "G54"
[[setup.operation]]
type = "thread-mill"
tool = 4
size = "M8"
points = [[20, 10]]
depth = 5
speed = 6000
feed = 500
"#;

    /// Judges the thread by a changed text; the tally, and the message of the finding.
    fn judged_by(change: impl Fn(&str) -> String) -> (Tally, String) {
        let mut outcome = run("job.toml", THREAD, &MemoryLoader::default(), &Silent).unwrap();
        let SetupOutcome { planned, posted, .. } = outcome.setups.remove(0);
        let posted = Posted { text: change(&posted.text).into(), ..posted };
        let mut setups = [followed(&outcome.job, &outcome.job.post, planned, posted).unwrap()];
        let wanted = wanted(&outcome.job, &setups);
        let measured = judged(&outcome.job, &mut setups, wanted, &outcome.simulation);
        let own = &measured[0].judged;
        assert!(own.findings.iter().all(|(f, _)| f.code == Code::THREAD_FORM), "{:?}", own.findings);
        (own.tally, own.findings.iter().map(|(f, _)| f.to_string()).collect())
    }

    #[test]
    fn a_text_with_another_helix_is_not_the_wanted_thread() {
        let (tally, told) = judged_by(str::to_owned);
        assert_eq!((tally.good, tally.bad, told.as_str()), (1, 0, ""));
        let replaced = |text: &str, pairs: &[(&str, &str)]| {
            pairs.iter().fold(text.to_owned(), |text, (from, to)| {
                assert!(text.contains(from), "no {from} in {text}");
                text.replace(from, to)
            })
        };
        // The radius less by a hundredth, with the half circles to it.
        let radius =
            [("X21.476", "X21.466"), ("X18.524", "X18.534"), ("I-1.476", "I-1.466"), ("I0.738", "I0.733")];
        for (pairs, part) in [
            (&radius[..], "the pitch diameter by the helix of the text is off"),
            (&[("Z-4.375", "Z-4.355")][..], "does not have the pitch and hand of the thread"),
            (&[("G3 ", "G2 ")][..], "does not run counter-clockwise"),
        ] {
            let (tally, told) = judged_by(|text| replaced(text, pairs));
            assert_eq!((tally.good, tally.bad), (0, 1), "{told}");
            assert!(told.contains("M8x1.25 at X20 Y10") && told.contains(part), "no `{part}` in {told}");
        }
        let (tally, told) = judged_by(|_| "%\nO0001\nM30\n%\n".to_owned());
        assert_eq!((tally.good, tally.bad), (0, 1), "{told}");
        assert!(told.contains("leave Z -5 to Z 0.625 out"), "{told}");
    }
}
