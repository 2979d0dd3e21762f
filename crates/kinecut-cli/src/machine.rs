//! The verbs about machines: `machine`, `fk`, `ik`, `reach`.

use std::path::Path;

use kinecut::base::{Code, Error, Finding, Silent};
use kinecut::job::machine::{LoadOptions, Loaded, load, machine_toml};
use kinecut::machine::layouts::Attitude;
use kinecut::machine::presets;
use kinecut::verbs::kinematics::{
    self, AxisValues, InverseWants, PathSheet, PathWants, PoseTexts, PoseWords, StraightWants, SweepWants,
};
use kinecut::verbs::layouts::machine_drawing_at;
use kinecut::verbs::machine::{MachineSheet, import_text};
use serde::Serialize;

use crate::args::{Args, Fk, Ik, Machine, MachineName, Reach};
use crate::hole::{Item, print_items};
use crate::{FINDINGS, FINE, colour, complain, data, files, print_json, put, render};

/// The machine of a name.
fn loaded(name: &str, hal: &[String], code: Option<&String>) -> Result<Loaded, Error> {
    let (loader, file) = files::beside(Path::new(name));
    let options = LoadOptions { hal: hal.to_vec(), code: code.cloned() };
    load(&file, name, &options, &loader)
}

/// The machine of a name alone.
pub(crate) fn of_name(name: &str) -> Result<kinecut::machine::Machine, Error> {
    loaded(name, &[], None).map(|l| l.machine)
}

fn named(machine: &MachineName) -> Result<kinecut::machine::Machine, Error> {
    loaded(&machine.name, &machine.hal, machine.code.as_ref()).map(|l| l.machine)
}

/// Shows a machine, or lists those that are known.
pub(crate) fn machine(args: &Args, machine: &Machine) -> Result<u8, Error> {
    let Some(name) = &machine.name else {
        if args.json {
            let row = |p: &kinecut::machine::Preset| serde_json::json!({ "name": p.name, "code": p.code, "note": p.note });
            print_json(&presets().iter().map(row).collect::<Vec<_>>());
        } else {
            presets().iter().for_each(|p| put(format!("{:<26} {:<8} {}\n", p.name, p.code, p.note)));
        }
        return Ok(FINE);
    };
    let loaded = loaded(name, &machine.hal, machine.code.as_ref())?;
    if let Some(file) = &machine.svg {
        let at = drawn_at(&loaded.machine, machine.at.as_ref())?;
        files::write_one(file, &machine_drawing_at(&loaded.machine, Attitude::Vertical, &at))?;
    }
    if machine.toml {
        data(&machine_toml(&loaded.machine));
        return Ok(FINE);
    }
    let sheet = MachineSheet::of(&loaded.machine);
    if args.json {
        #[derive(Serialize)]
        struct Shown {
            #[serde(flatten)]
            sheet: MachineSheet,
            #[serde(skip_serializing_if = "Option::is_none")]
            import: Option<serde_json::Value>,
        }
        let import = loaded.import.map(|i| {
            serde_json::json!({ "module": i.module, "lines": i.lines, "missing": i.missing, "remarks": i.remarks })
        });
        print_json(&Shown { sheet, import });
    } else {
        put(sheet.text());
        if let Some(import) = &loaded.import {
            put(import_text(import));
        }
    }
    Ok(FINE)
}

/// Axis positions of a drawing.
fn drawn_at(machine: &kinecut::machine::Machine, words: Option<&String>) -> Result<Vec<f64>, Error> {
    let values = lock("--at", words)?.joints(machine)?;
    if words.is_some() && machine.bodies.is_empty() {
        let what = "the machine has no bodies that could be drawn at these positions";
        return Err(Finding::error(Code::MACHINE_BODY, what)
            .cure("add [[body]] to the machine file, or leave --at out")
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

fn each<T>(poses: &PoseTexts, run: impl Fn(&PoseWords) -> Result<T, Error>) -> Vec<Item<T>> {
    let one = |(i, item): (usize, &Result<PoseWords, Error>)| match item.clone().and_then(|words| run(&words))
    {
        Ok(done) => Item::Fine(done),
        Err(e) => Item::Wrong { error: poses.locate(i, e).0 },
    };
    poses.items.iter().enumerate().map(one).collect()
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
    let items = each(&poses, |words| kinematics::forward(&machine, words, length));
    let code = print_items(args, poses.list, &items, |p| p.text());
    let found = || items.iter().flat_map(|i| if let Item::Fine(p) = i { &p.findings[..] } else { &[] });
    if !args.json {
        found().for_each(|f| complain(render::finding(f, colour(args))));
    }
    // A position beyond its travel is an answer that says no.
    Ok(if code == FINE && found().next().is_some() { FINDINGS } else { code })
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
            let answer = kinematics::sweep_path(&machine, &poses, &wants, &swept, &Silent)?;
            return Ok(show_path(args, &answer, &answer.path, || answer.text()));
        }
        let sheet = kinematics::path(&machine, &poses, &wants, &Silent)?;
        return Ok(show_path(args, &sheet, &sheet, || sheet.text()));
    }
    if let Some(swept) = swept {
        let items = each(&poses, |words| kinematics::sweep(&machine, words, &wants, &swept));
        let code = print_items(args, poses.list, &items, |p| p.text());
        let outside = items.iter().any(|i| matches!(i, Item::Fine(p) if !p.reachable()));
        return Ok(if code == FINE && outside { FINDINGS } else { code });
    }
    let items = each(&poses, |words| kinematics::inverse(&machine, words, &wants));
    let code = print_items(args, poses.list, &items, |p| p.text());
    let outside = items.iter().any(|i| matches!(i, Item::Fine(p) if !p.reachable()));
    Ok(if code == FINE && outside { FINDINGS } else { code })
}

/// Prints a path; retractions and steps that no points help are findings.
fn show_path(args: &Args, whole: &impl Serialize, path: &PathSheet, text: impl Fn() -> String) -> u8 {
    if args.json {
        print_json(whole);
    } else {
        put(text());
        path.findings().for_each(|f| complain(render::finding(f, colour(args))));
    }
    if path.retracts.is_empty() && path.findings().next().is_none() { FINE } else { FINDINGS }
}

/// What a machine reaches.
pub(crate) fn reach(args: &Args, reach: &Reach) -> Result<u8, Error> {
    let machine = named(&reach.machine)?;
    let sheet = kinematics::reach(&machine, &lock("--lock", reach.lock.as_ref())?, &reach.direction)?;
    if args.json {
        print_json(&sheet);
    } else {
        put(sheet.text());
    }
    Ok(if sheet.directions.iter().all(|d| d.reached) { FINE } else { FINDINGS })
}
