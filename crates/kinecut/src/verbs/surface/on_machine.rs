//! A surface on a machine: which of its redistributions and envelopes the machine can make, with the laws of its axes, how
//! far what it makes is from what is wanted, and what errors of its axes do.

use glam::{DQuat, DVec3};
use rayon::prelude::*;

use super::on_machine_rows::{
    AlternativeRow, EnvelopedRow, HowMade, MadeRow, NearestRow, OnMachine, ResidualRow,
};
use crate::base::{Code, Finding, Progress, Quantity, Result};
use crate::geom::Rigid;
use crate::machine::Machine;
use crate::machine::generation::{
    AxisErrors, FeasibleOptions, Hold, Obstacle, SurfaceBudget, Task, Touched, envelope_surface, make_split,
    nearest_machines, sensitivity,
};
use crate::machine::surface::{EnvelopeMethod, GeneratedSurface, ShapeFunction, Split, envelopes_of};

/// Most other machines in the answer.
const ALTERNATIVES: usize = 3;

/// Settings other than the surface and the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct OnMachineWants {
    /// Length of the tool from the gauge point [mm].
    pub length: f64,
    /// Whether machines that could are looked for where this one cannot.
    pub alternatives: bool,
    /// Only this redistribution: code of the machine's part ("-" for none), or both parts ("615|3"); "touching" and "rolling"
    /// are the envelopes.
    pub only: Option<String>,
    /// Largest deviation at which a point of the surface counts as reached [mm].
    pub tolerance: f64,
    /// Errors of all axes.
    pub errors: AxisErrors,
    /// Errors of axes that have their own.
    pub own_errors: Vec<(char, AxisErrors)>,
}

impl Default for OnMachineWants {
    fn default() -> OnMachineWants {
        OnMachineWants {
            length: 0.0,
            alternatives: false,
            only: None,
            tolerance: FeasibleOptions::default().tolerance,
            errors: AxisErrors::default(),
            own_errors: Vec::new(),
        }
    }
}

impl OnMachineWants {
    /// The errors of each axis of a machine, in the order of its code.
    fn errors_of(&self, machine: &Machine) -> Vec<AxisErrors> {
        let own = |letter: char| self.own_errors.iter().rev().find(|(l, _)| *l == letter).map(|(_, e)| *e);
        machine.joints.iter().map(|j| own(j.letter).unwrap_or(self.errors)).collect()
    }

    /// Checks the numbers and the names.
    fn check(&self, machine: &Machine) -> Result<()> {
        let fail = |what: &str, value: f64, unit: &'static str, key: &str| {
            let finding =
                Finding::error(Code::GENERATION_INPUT, format!("{what} must be a number, not negative"));
            Err(finding.value(value, unit).bound(0.0, unit).key(key.to_owned()).into())
        };
        let good = |x: f64| x.is_finite() && x >= 0.0;
        if !self.length.is_finite() {
            return fail("the length of the tool", self.length, "mm", "length");
        }
        if !good(self.tolerance) {
            return fail("the tolerance", self.tolerance * 1e3, "um", "tolerance");
        }
        for errors in self.own_errors.iter().map(|(_, e)| e).chain([&self.errors]) {
            if !good(errors.shift) {
                return fail("the error of an axis", errors.shift * 1e3, "um", "errors");
            }
            if !good(errors.turn) {
                return fail("the error of an axis", errors.turn.to_degrees() * 3600.0, "arcsec", "errors");
            }
        }
        if let Some((letter, _)) = self.own_errors.iter().find(|(l, _)| machine.joint(*l).is_none()) {
            let axes: Vec<String> = machine.joints.iter().map(|j| j.letter.to_string()).collect();
            return Err(Finding::error(
                Code::MACHINE_AXIS,
                format!("axis {letter} has errors, but the machine {} has no such axis", machine.code),
            )
            .help(format!("its axes are {}", axes.join(", ")))
            .into());
        }
        Ok(())
    }

    fn wants_split(&self, split: &Split) -> bool {
        self.only.as_deref().is_none_or(|only| {
            let part = |code: String| if code.is_empty() { "-".to_owned() } else { code };
            let (machine, tool) =
                (part(split.machine_code().to_string()), part(split.tool_code().to_string()));
            match only.split_once('|') {
                Some((m, t)) => m.trim() == machine && t.trim() == tool,
                None => only.trim() == machine,
            }
        })
    }

    fn wants_envelope(&self, envelope: &EnvelopeMethod) -> bool {
        self.only.as_deref().is_none_or(|only| only.trim().eq_ignore_ascii_case(envelope.method.name()))
    }
}

/// Asks a machine for every redistribution of a surface with a rigid tool and for every known envelope of it.
///
/// # Errors
/// `KC1131` for a redistribution that the surface does not have, or an invalid number; `KC0703` for errors of an axis
/// that the machine does not have; those of [`make_split`] and [`envelope_surface`]; `KC0009` when cancelled.
pub fn on_machine(
    surface: &GeneratedSurface,
    splits: &[Split],
    machine: &Machine,
    wants: &OnMachineWants,
    progress: &dyn Progress,
) -> Result<OnMachine> {
    wants.check(machine)?;
    let asked: Vec<&Split> = splits.iter().filter(|s| s.is_valid() && wants.wants_split(s)).collect();
    let known: Vec<&EnvelopeMethod> = envelopes_of(surface).filter(|e| wants.wants_envelope(e)).collect();
    if asked.is_empty() && known.is_empty() {
        return Err(no_such_split(surface, splits, wants));
    }
    let ask = Ask { surface, machine, wants, errors: wants.errors_of(machine), progress };
    let rows: Vec<Result<MadeRow>> = asked.par_iter().map(|split| ask.split(split)).collect();
    let touched: Vec<Result<EnvelopedRow>> =
        known.par_iter().map(|envelope| ask.envelope(envelope)).collect();
    Ok(OnMachine {
        machine: machine.name.clone(),
        code: machine.code.to_string(),
        tolerance_um: wants.tolerance * 1e3,
        splits: rows.into_iter().collect::<Result<_>>()?,
        envelopes: touched.into_iter().collect::<Result<_>>()?,
        errors: ask.errors_text(),
    })
}

fn no_such_split(surface: &GeneratedSurface, splits: &[Split], wants: &OnMachineWants) -> crate::base::Error {
    let part = |code: String| if code.is_empty() { "-".to_owned() } else { code };
    let valid = splits.iter().filter(|s| s.is_valid());
    let mut known: Vec<String> = valid
        .map(|s| format!("{}|{}", part(s.machine_code().to_string()), part(s.tool_code().to_string())))
        .collect();
    let mut methods: Vec<String> = envelopes_of(surface).map(|e| e.method.name().to_owned()).collect();
    methods.dedup();
    known.extend(methods);
    let only = wants.only.as_deref().unwrap_or_default();
    Finding::error(
        Code::GENERATION_INPUT,
        format!("surface `{}` has no redistribution `{only}` with a rigid tool", surface.name),
    )
    .help(format!("it has {}", known.join(", ")))
    .into()
}

/// A question to a machine.
struct Ask<'a> {
    surface: &'a GeneratedSurface,
    machine: &'a Machine,
    wants: &'a OnMachineWants,
    errors: Vec<AxisErrors>,
    progress: &'a dyn Progress,
}

impl Ask<'_> {
    fn options(&self) -> FeasibleOptions {
        FeasibleOptions {
            tool_length: self.wants.length,
            tolerance: self.wants.tolerance,
            ..FeasibleOptions::default()
        }
    }

    fn budget(&self, touched: &[Touched]) -> Option<SurfaceBudget> {
        let places: Vec<(&[f64], DVec3, DVec3)> =
            touched.iter().map(|t| (&*t.joints, t.point, t.normal)).collect();
        sensitivity(self.machine, &places, &self.errors)
    }

    /// The sizes of the errors as a person reads them.
    fn errors_text(&self) -> String {
        let shown = |e: &AxisErrors| {
            let seconds = Quantity::new((e.turn.to_degrees() * 3600.0 * 1e6).round() / 1e6, "arcsec");
            format!("{} and {seconds}", Quantity::new((e.shift * 1e9).round() / 1e6, "um"))
        };
        let mut text = format!("{} an axis", shown(&self.wants.errors));
        for (letter, errors) in &self.wants.own_errors {
            text += &format!(", {letter} {}", shown(errors));
        }
        text
    }

    fn split(&self, split: &Split) -> Result<MadeRow> {
        let (surface, machine, options) = (self.surface, self.machine, self.options());
        let mut made = make_split(surface, split, machine, Rigid::IDENTITY, &options, self.progress)?;
        let mut mounted = None;
        if made.hold == Hold::Frame && matches!(made.outcome, Err(Obstacle::Unreached { .. })) {
            // A tool with an edge is built for its machine: as it stands where the motion has its zero.
            let mount = mount_at_zero(surface, split, machine, &options)?;
            let other = make_split(surface, split, machine, mount, &options, self.progress)?;
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
            made: HowMade {
                possible: made.outcome.is_ok(),
                laws: Vec::new(),
                residual: made
                    .residual
                    .as_ref()
                    .map(|r| ResidualRow::of(r.least.distance, r.greatest.distance, r.rms, r.worst().point)),
                coverage: made.coverage,
                budget: self.budget(&made.touched),
            },
            obstacle: None,
            nearest: None,
        };
        match &made.outcome {
            Ok(way) => row.made.laws = mounted.into_iter().chain(way.lines()).collect(),
            Err(obstacle) => {
                row.obstacle = Some(obstacle.finding(machine, made.hold, &names));
                if self.wants.alternatives {
                    row.nearest = Some(self.nearest(split, made.hold, &options)?);
                }
            }
        }
        Ok(row)
    }

    fn nearest(&self, split: &Split, hold: Hold, options: &FeasibleOptions) -> Result<NearestRow> {
        let surface = self.surface;
        let motion = ShapeFunction::new(surface, &split.machine)?;
        let edge = ShapeFunction::new(surface, &split.tool)?;
        let domain = surface.variables.each_ref().map(|v| {
            let moves = split.machine_variables.contains(&v.name);
            [v.from, if moves { v.to } else { v.from }]
        });
        let names = surface.variables.each_ref().map(|v| v.name.as_str());
        let [u, v] = &surface.variables;
        let control = if hold == Hold::Point { edge.point(u.from, v.from) } else { DVec3::ZERO };
        let task = Task { control, ..Task::new(&motion, domain, names, hold) };
        let found = nearest_machines(self.machine, &task, options, ALTERNATIVES, self.progress)?;
        Ok(NearestRow {
            layouts: found.layouts,
            classes: found.classes,
            machines: found
                .found
                .iter()
                .map(|a| AlternativeRow {
                    code: a.code.to_string(),
                    distance: a.distance,
                    changes: a.changes.clone(),
                    laws: a.way.lines(),
                })
                .collect(),
        })
    }

    fn envelope(&self, envelope: &EnvelopeMethod) -> Result<EnvelopedRow> {
        let made = envelope_surface(self.surface, envelope, self.machine, &self.options(), self.progress)?;
        let mut row = EnvelopedRow {
            process: envelope.process.to_owned(),
            method: envelope.method.name(),
            tool: made.tool.clone(),
            made: HowMade {
                possible: made.outcome.is_ok(),
                budget: self.budget(&made.contacts),
                ..HowMade::default()
            },
            unverified: None,
            obstacle: None,
        };
        match &made.outcome {
            Ok(way) => row.made.laws = way.lines(),
            Err(obstacle) => row.obstacle = Some(obstacle.finding(self.machine, made.hold, &made.names)),
        }
        match made.left {
            Some(Ok(left)) => {
                row.made.residual = Some(ResidualRow::of(left.least, left.greatest, left.rms, left.worst));
                row.made.coverage = Some(left.coverage);
            }
            Some(Err(why)) => row.unverified = Some(why),
            None => {}
        }
        Ok(row)
    }
}

/// The mount with which the tool stands as it must where the variables are zero, or nearest to it, while all axes of the
/// machine are at zero.
fn mount_at_zero(
    surface: &GeneratedSurface,
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

/// Mounting of a tool, in words.
fn mount_line(mount: &Rigid) -> String {
    let turn = DQuat::from_mat3(&mount.rotation.transpose());
    let (axis, angle) = turn.to_axis_angle();
    let [x, y, z] = axis.to_array().map(|c| format!("{c:.3}"));
    format!(
        "the edge is set in the tool turned by {:.3} deg about ({x}, {y}, {z}) of the tool's frame",
        angle.to_degrees()
    )
}
