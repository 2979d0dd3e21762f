//! A surface on a machine: which of its redistributions the machine can make, with the laws of its axes.

use std::fmt::Write as _;

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use serde::Serialize;

use crate::base::{Finding, Progress, Result};
use crate::geom::Rigid;
use crate::machine::Machine;
use crate::machine::generation::{FeasibleOptions, Hold, Obstacle, Task, make_split, nearest_machines};
use crate::machine::surface::{ShapeFunction, Split, Surface};

/// Other machines that are told.
const ALTERNATIVES: usize = 3;
/// Micrometres in a millimetre.
const MICRO: f64 = 1e3;

/// How far what is generated is from what is wanted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ResidualRow {
    /// The lowest place [um].
    pub least_um: f64,
    /// The highest place [um].
    pub greatest_um: f64,
    /// Root mean square [um].
    pub rms_um: f64,
}

/// A machine that could.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AlternativeRow {
    /// Its code.
    pub code: String,
    /// What is changed.
    pub changes: Vec<String>,
    /// How it does it.
    pub laws: Vec<String>,
}

/// A redistribution on a machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MadeRow {
    /// Code of the machine's part.
    pub machine_code: String,
    /// Code of the tool's part.
    pub tool_code: String,
    /// What the trade calls it.
    pub process: String,
    /// Whether the machine can make it.
    pub possible: bool,
    /// Laws of its axes: settings, forming, linked.
    pub laws: Vec<String>,
    /// What is generated against what is wanted.
    pub residual: Option<ResidualRow>,
    /// Why not.
    pub obstacle: Option<Finding>,
    /// Machines that could, with few changes.
    pub alternatives: Vec<AlternativeRow>,
}

/// A surface on a machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OnMachine {
    /// Name of the machine.
    pub machine: String,
    /// Its code.
    pub code: String,
    /// Its answers to the redistributions.
    pub splits: Vec<MadeRow>,
}

/// What is wanted beside the surface and the machine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OnMachineWants {
    /// Length of the tool from the gauge point [mm].
    pub length: f64,
    /// Whether machines that could are looked for where this one cannot.
    pub alternatives: bool,
}

/// Asks a machine for every redistribution of a surface with a rigid tool.
///
/// # Errors
/// Those of [`make_split`]; `KC0009` when cancelled.
pub fn on_machine(
    surface: &Surface,
    splits: &[Split],
    machine: &Machine,
    wants: &OnMachineWants,
    progress: &dyn Progress,
) -> Result<OnMachine> {
    let options = FeasibleOptions { tool_length: wants.length, ..FeasibleOptions::default() };
    let rows: Vec<Result<MadeRow>> = splits
        .par_iter()
        .filter(|split| split.is_valid())
        .map(|split| row(surface, split, machine, &options, wants.alternatives, progress))
        .collect();
    Ok(OnMachine {
        machine: machine.name.clone(),
        code: machine.code.to_string(),
        splits: rows.into_iter().collect::<Result<_>>()?,
    })
}

/// The mount with which the tool stands as it must where the variables are zero, or nearest to it, while all axes of the
/// machine are at zero.
fn mount_at_zero(
    surface: &Surface,
    split: &Split,
    machine: &Machine,
    options: &FeasibleOptions,
) -> Result<Rigid> {
    let motion = ShapeFunction::new(surface, &split.machine)?;
    let [u, v] = surface.variables.each_ref().map(|x| 0f64.clamp(x.from.min(x.to), x.to.max(x.from)));
    let wanted = motion.frame(u, v).rotation;
    let home = machine.kinematics(options.tool_length).forward(&[]).rotation;
    Ok(Rigid { rotation: wanted.transpose() * home, translation: DVec3::ZERO })
}

/// How a tool is mounted, in words.
fn mount_line(mount: &Rigid) -> String {
    let turn = DQuat::from_mat3(&mount.rotation.transpose());
    let (axis, angle) = turn.to_axis_angle();
    let [x, y, z] = axis.to_array().map(|c| format!("{c:.3}"));
    format!(
        "the edge is set in the tool turned by {:.3} deg about ({x}, {y}, {z}) of the tool's frame",
        angle.to_degrees()
    )
}

fn row(
    surface: &Surface,
    split: &Split,
    machine: &Machine,
    options: &FeasibleOptions,
    alternatives: bool,
    progress: &dyn Progress,
) -> Result<MadeRow> {
    let mut made = make_split(surface, split, machine, Rigid::IDENTITY, options, progress)?;
    let mut mounted = None;
    if made.hold == Hold::Frame && matches!(made.outcome, Err(Obstacle::Unreached { .. })) {
        // A tool with an edge is built for its machine: as it stands where the motion has its zero.
        let mount = mount_at_zero(surface, split, machine, options)?;
        let other = make_split(surface, split, machine, mount, options, progress)?;
        if other.outcome.is_ok() {
            mounted = Some(mount_line(&mount));
            made = other;
        }
    }
    let names = surface.variables.each_ref().map(|v| v.name.clone());
    let mut row = MadeRow {
        machine_code: split.machine_code().to_string(),
        tool_code: split.tool_code().to_string(),
        process: split.process.clone(),
        possible: made.outcome.is_ok(),
        laws: Vec::new(),
        residual: made.residual.as_ref().map(|r| ResidualRow {
            least_um: r.least.distance * MICRO,
            greatest_um: r.greatest.distance * MICRO,
            rms_um: r.rms * MICRO,
        }),
        obstacle: None,
        alternatives: Vec::new(),
    };
    match &made.outcome {
        Ok(way) => row.laws = mounted.into_iter().chain(way.lines()).collect(),
        Err(obstacle) => {
            row.obstacle = Some(obstacle.finding(machine, made.hold, &names));
            if alternatives && split.tool_kind.is_some() {
                let motion = ShapeFunction::new(surface, &split.machine)?;
                let domain = surface.variables.each_ref().map(|v| {
                    let moves = split.machine_variables.contains(&v.name);
                    [v.from, if moves { v.to } else { v.from }]
                });
                let task = Task::new(&motion, domain, names.each_ref().map(String::as_str), made.hold);
                let found = nearest_machines(machine, &task, options, ALTERNATIVES, progress)?;
                row.alternatives = found
                    .iter()
                    .map(|a| AlternativeRow {
                        code: a.code.to_string(),
                        changes: a.changes.clone(),
                        laws: a.way.lines(),
                    })
                    .collect();
            }
        }
    }
    Ok(row)
}

impl OnMachine {
    /// As a person reads it.
    pub fn text(&self) -> String {
        let mut out = format!("\non machine {} {}\n", self.code, self.machine);
        for s in &self.splits {
            let part = |code: &str| if code.is_empty() { "-".to_owned() } else { code.to_owned() };
            let _ = writeln!(
                out,
                "\n{:>9} | {:<6} {}: {}",
                part(&s.machine_code),
                part(&s.tool_code),
                if s.possible { "yes" } else { "no" },
                s.process
            );
            for law in &s.laws {
                let _ = writeln!(out, "            {law}");
            }
            if let Some(r) = &s.residual {
                // Nanometres are below what any of this means; adding zero makes -0 to 0.
                let shown = |um: f64| (um * 1e3).round() / 1e3 + 0.0;
                let (least, greatest, rms) = (shown(r.least_um), shown(r.greatest_um), shown(r.rms_um));
                let _ =
                    writeln!(out, "            off the surface by {least} .. {greatest} um, rms {rms} um");
            }
            if let Some(obstacle) = &s.obstacle {
                let _ = writeln!(out, "            {obstacle}");
            }
            for a in &s.alternatives {
                let _ = writeln!(out, "            {} could, {}", a.code, a.changes.join(", "));
            }
        }
        out
    }
}
