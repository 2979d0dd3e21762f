//! From the machine table to a checked machine: names of axes resolved against the code, directions made unit vectors,
//! degrees and minutes turned into radians and seconds.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::axes::{axis_finding, axis_names, axis_of, direction, point};
use super::control::control;
use super::joint::{axis, linear_axes, travel, usual_letters};
use super::setup::rotation;
use crate::base::bounded::text;
use crate::base::{Code, Error, Finding, Loader, MeshesIn, Result};
use crate::geom::Rigid;
use crate::job::file::{AxisTable, FrameTable, MachineTable, SpindleTable};
use crate::machine::{CoordinateCode, Elementary, Machine, OwnCode, TorqueCurve};

/// Least volume that the directions of three translations span: below it one of them follows from the others.
const LEAST_VOLUME: f64 = 1e-3;

/// The machine of a table; its errors have the key within the table. Meshes of its
/// bodies come through `loader`.
pub(crate) fn machine(t: &MachineTable, loader: &dyn Loader) -> Result<Machine> {
    super::numbers::within(t)?;
    let mut machine = base(t)?;
    if let Some(name) = &t.name {
        machine.name = text("name", name)?;
    }
    let keys: Vec<(usize, &String, &AxisTable)> = t
        .axis
        .iter()
        .map(|(key, axis)| Ok((known_axis(&machine, key, "axis")?, key, axis)))
        .collect::<Result<_>>()?;
    let mut named = vec![false; machine.joints.len()];
    for &(index, key, table) in &keys {
        if std::mem::replace(&mut named[index], true) {
            return Err(axis_finding(format!("`{key}` names an axis that another table names too"))
                .help("keep one of them")
                .key(format!("axis.{key}"))
                .into());
        }
        axis(&mut machine.joints[index], key, table)?;
    }
    usual_letters(&mut machine.joints);
    if t.preset.is_none() {
        for (i, joint) in machine.joints.iter().enumerate() {
            if joint.motion.direction().is_none()
                && !keys.iter().any(|&(k, _, a)| k == i && a.direction.is_some())
            {
                return Err(axis_finding(format!("the inclined axis {} has no direction", joint.motion))
                    .help(format!("add [axis.{}] with direction = [0, 1, 1] or what it is", joint.motion))
                    .key("code")
                    .into());
            }
        }
    }
    for (key, &limits) in &t.travel {
        let index = known_axis(&machine, key, "travel")?;
        let twice = keys.iter().any(|&(k, _, axis)| k == index && axis.travel.is_some());
        if twice {
            return Err(axis_finding(format!("the travel of `{key}` is given twice"))
                .help("give it in [travel] or in the table of the axis")
                .key(format!("travel.{key}"))
                .into());
        }
        travel(&mut machine.joints[index], limits, &format!("travel.{key}"))?;
    }
    machine.dynamics = linear_axes(&t.dynamics)?.over(machine.dynamics);
    machine.control = control(&t.dynamics)?.over(machine.control);
    if let Some(points) = &t.dynamics.spindle_curve {
        let points: Vec<[f64; 2]> =
            points.iter().map(|[turns, torque]| [turns * TAU / 60.0, *torque]).collect();
        machine.spindle_curve =
            Some(TorqueCurve::new(&points).map_err(|e| e.under("dynamics.spindle_curve"))?);
    }
    machine.rapids = t.rapids.or(machine.rapids);
    if !t.codes.is_empty() {
        let codes = t.codes.iter().map(|(name, effect)| {
            OwnCode::parse(name, *effect).map_err(|e| Error::from(e.0.key(format!("codes.{name}"))))
        });
        machine.codes = codes.collect::<Result<Vec<OwnCode>>>()?.into();
    }
    if let Some(table) = &t.spindle {
        machine.spindle = spindle(table, machine.spindle)?;
    }
    if let Some(table) = &t.work {
        machine.work = frame(table)?;
    }
    independent(&machine)?;
    let unit = t.units.map_or(loader.mesh_unit(), |units| units.units().mm());
    machine.bodies = super::body::bodies(&t.bodies, &machine, &MeshesIn { loader, unit })?.into();
    machine.check()?;
    Ok(machine)
}

/// The machine without what the table says of its axes.
fn base(t: &MachineTable) -> Result<Machine> {
    let code = t.code.as_deref().map(CoordinateCode::parse_any).transpose().map_err(|e| e.under("code"))?;
    let Some(name) = &t.preset else {
        let Some(code) = code else {
            return Err(Finding::error(Code::JOB_SHAPE, "the machine has no code")
                .help("add code = \"2103\" (workpiece to tool) or preset = \"...\"")
                .into());
        };
        return Ok(Machine::of_code(code));
    };
    let mut machine = Machine::preset(name).map_err(|e| e.under("preset"))?;
    if let Some(code) = code {
        if code.word() != machine.code.word() {
            return Err(Finding::error(
                Code::MACHINE_CODE,
                format!("the code {code} is not that of the preset {name}, {}", machine.code),
            )
            .help("leave one of them out; beside a preset, a code may only move the bed (0)")
            .key("code")
            .into());
        }
        machine.code = code;
    }
    Ok(machine)
}

fn known_axis(machine: &Machine, key: &str, table: &str) -> Result<usize> {
    axis_of(machine, key).ok_or_else(|| {
        axis_finding(format!("the machine {} has no axis `{key}`", machine.code))
            .help(format!("its axes are {}", axis_names(machine)))
            .key(format!("{table}.{key}"))
            .into()
    })
}

/// The rotation that takes Z the shortest way to a direction.
pub(crate) fn shortest(direction: DVec3) -> DMat3 {
    let axis = DVec3::Z.cross(direction);
    match axis.try_normalize() {
        Some(unit) => DMat3::from_axis_angle(unit, axis.length().atan2(direction.z)),
        None if direction.z < 0.0 => DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0)),
        None => DMat3::IDENTITY,
    }
}

fn spindle(t: &SpindleTable, before: Rigid) -> Result<Rigid> {
    let translation = t.point.map_or(Ok(before.translation), |p| point(p, "spindle.point"))?;
    let z = t.direction.map(|d| direction(d, "spindle.direction")).transpose()?;
    let rotation = match (z, t.x) {
        (None, None) => before.rotation,
        (Some(z), None) => shortest(z),
        (z, Some(x)) => {
            let z = z.unwrap_or(before.rotation.z_axis);
            rotation(x, z.to_array()).map_err(|e| e.under("spindle"))?.transpose()
        }
    };
    Ok(Rigid { rotation, translation })
}

fn frame(t: &FrameTable) -> Result<Rigid> {
    let translation = t.point.map_or(Ok(DVec3::ZERO), |p| point(p, "work.point"))?;
    let x = t.x.unwrap_or([1.0, 0.0, 0.0]);
    let z = t.z.unwrap_or([0.0, 0.0, 1.0]);
    let rotation = rotation(x, z).map_err(|e| e.under("work"))?.transpose();
    Ok(Rigid { rotation, translation })
}

/// Refuses three translations in one plane, and two along one line.
fn independent(machine: &Machine) -> Result<()> {
    let shifts: Vec<DVec3> =
        machine.joints.iter().filter(|j| !j.motion.is_rotation()).map(|j| j.direction).collect();
    let volume = match shifts[..] {
        [a, b, c] => a.cross(b).dot(c).abs(),
        [a, b] => a.cross(b).length(),
        _ => 1.0,
    };
    if volume < LEAST_VOLUME {
        return Err(axis_finding("the directions of the translations are not independent".to_owned())
            .value(volume, "")
            .bound(LEAST_VOLUME, "")
            .help("X, Y and Z do not lie in one plane")
            .key("axis")
            .into());
    }
    Ok(())
}

/// Refuses a machine without X, Y or Z.
pub(crate) fn three_translations(machine: &Machine) -> Result<()> {
    for motion in [Elementary::X, Elementary::Y, Elementary::Z] {
        if !machine.code.has(motion) {
            let letter = motion.letter().unwrap_or('X');
            return Err(axis_finding(format!("machine {} has no {letter} axis", machine.code))
                .help("a milling job needs 1, 2 and 3 in the code")
                .key("code")
                .into());
        }
    }
    Ok(())
}
