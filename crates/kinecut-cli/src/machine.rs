//! The verbs about machines: `machine`, `fk`, `ik`, `reach`.

use std::path::Path;

use kinecut::base::{Code, Error, Finding, Silent};
use kinecut::job::machine::{LoadOptions, Loaded, load, machine_toml};
use kinecut::machine::layouts::Attitude;
use kinecut::verbs::fk::forward;
use kinecut::verbs::ik::{self, InverseWants, PathWants, StraightWants, SweepWants};
use kinecut::verbs::layouts::machine_drawing_at;
use kinecut::verbs::machine::{KnownMachines, MachineAnswer};
use kinecut::verbs::poses::{AxisValues, PoseTexts, PoseWords};
use kinecut::verbs::reach;

use crate::answers::{To, answer, answers};
use crate::args::{Args, Configuration, Fk, Ik, Machine, MachineName, Reach};
use crate::{FINE, data, files};

/// The machine of a name.
fn loaded(name: &str, options: &LoadOptions) -> Result<Loaded, Error> {
    let (loader, file) = files::beside(Path::new(name));
    load(&file, name, options, &loader)
}

/// The machine of a name alone.
pub(crate) fn of_name(name: &str) -> Result<kinecut::machine::Machine, Error> {
    loaded(name, &LoadOptions::default()).map(|l| l.machine)
}

fn options(configuration: &Configuration) -> LoadOptions {
    LoadOptions { hal: configuration.hal.clone(), code: configuration.code.clone() }
}

fn named(machine: &MachineName) -> Result<kinecut::machine::Machine, Error> {
    loaded(&machine.name, &options(&machine.configuration)).map(|l| l.machine)
}

/// Shows a machine, or lists those that are known.
pub(crate) fn machine(args: &Args, machine: &Machine) -> Result<u8, Error> {
    let Some(name) = &machine.name else { return answer(args, To::default(), KnownMachines::all()) };
    let loaded = loaded(name, &options(&machine.configuration))?;
    let mut svg = String::new();
    if let Some(file) = &machine.svg {
        let at = drawn_at(&loaded.machine, machine.at.as_ref())?;
        svg = machine_drawing_at(&loaded.machine, Attitude::Vertical, &at);
        if machine.toml {
            files::write_one(file, &svg)?;
        }
    }
    if machine.toml {
        data(&machine_toml(&loaded.machine));
        return Ok(FINE);
    }
    let to = To { svg: machine.svg.as_deref(), ..To::default() };
    answer(args, to, MachineAnswer { svg, ..MachineAnswer::of(loaded) })
}

/// Axis positions of a drawing.
fn drawn_at(machine: &kinecut::machine::Machine, words: Option<&String>) -> Result<Vec<f64>, Error> {
    let values = lock("--at", words)?.joints(machine)?;
    if words.is_some() && machine.bodies.is_empty() {
        let what = "the machine has no bodies that could be drawn at these positions";
        return Err(Finding::error(Code::MACHINE_BODY, what)
            .help("add [[body]] to the machine file, or leave --at out")
            .key("--at")
            .into());
    }
    Ok(values.to_vec())
}

/// The poses of a file, or those given as words.
fn poses(file: &str, at: &[String]) -> Result<PoseTexts, Error> {
    if at.is_empty() {
        PoseTexts::read(file, &files::text(file)?)
    } else {
        PoseTexts::read("--at", &at.join("\n"))
    }
}

/// A length that can be one.
fn length(value: f64) -> Result<f64, Error> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(Finding::error(Code::JOB_VALUE, "the length of the tool is not finite").key("--length").into())
}

/// Axis positions to poses.
pub(crate) fn fk(args: &Args, fk: &Fk) -> Result<u8, Error> {
    let machine = named(&fk.machine)?;
    let length = length(fk.length)?;
    let poses = poses(&fk.poses, &fk.at)?;
    answers(args, To::default(), &poses, |words| forward(&machine, words, length))
}

/// Words of axes.
fn lock(option: &str, words: Option<&String>) -> Result<AxisValues, Error> {
    let Some(words) = words else { return Ok(AxisValues::default()) };
    let texts = PoseTexts::read(option, words)?;
    let first = texts.items.into_iter().next().unwrap_or_else(|| Ok(PoseWords::default()));
    first.map(|pose| AxisValues(pose.words))
}

/// Poses to axis positions.
pub(crate) fn ik(args: &Args, ik: &Ik) -> Result<u8, Error> {
    let to = To::default();
    let machine = named(&ik.machine)?;
    let wants = InverseWants { locked: lock("--lock", ik.lock.as_ref())?, length: length(ik.length)? };
    let poses = poses(&ik.poses, &ik.at)?;
    let swept = ik.sweep.map(|axis| SweepWants { axis: axis.to_ascii_uppercase(), places: ik.places });
    if let Some(swept) = &swept {
        swept.check(&machine, &wants.locked)?;
    }
    if ik.path {
        let straight = StraightWants { axis_tolerance: ik.axis_tolerance, ..StraightWants::new(0.0) };
        let wants = PathWants {
            poses: wants,
            from: ik.from.as_ref().map(|words| lock("--from", Some(words))).transpose()?,
            without_retract: ik.no_retract,
            prefer_positive: ik.positive.map(|letter| letter.to_ascii_uppercase()),
            straight: ik.tolerance.map(|tolerance| StraightWants { tolerance, ..straight }),
        };
        if let Some(swept) = swept {
            return answer(args, to, ik::sweep_path(&machine, &poses, &wants, &swept, &Silent)?);
        }
        return answer(args, to, ik::path(&machine, &poses, &wants, &Silent)?);
    }
    match swept {
        Some(swept) => answers(args, to, &poses, |words| ik::sweep(&machine, words, &wants, &swept)),
        None => answers(args, to, &poses, |words| ik::inverse(&machine, words, &wants)),
    }
}

/// What a machine reaches.
pub(crate) fn reach(args: &Args, reach: &Reach) -> Result<u8, Error> {
    let machine = named(&reach.machine)?;
    let locked = lock("--lock", reach.lock.as_ref())?;
    answer(args, To::default(), reach::reach(&machine, &locked, &reach.direction)?)
}
