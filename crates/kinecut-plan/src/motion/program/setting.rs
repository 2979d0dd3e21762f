//! The machine and its control, as the time of a program needs them.

use super::super::AxisLimit;
use super::axis_limits;
use super::joint::{AXES, Tolerance};
use super::linuxcnc::Ending;
use crate::base::Progress;
use crate::machine::{Interpolator, Machine};
use crate::program::{Blend, Item, Program};

/// Distance by which a control leaves the path at a corner where neither program nor machine says one [mm].
const USUAL_TOLERANCE: f64 = 0.01;
/// The same for rotary axes [rad].
const USUAL_TURN_TOLERANCE: f64 = 0.05 * std::f64::consts::PI / 180.0;
/// Joint deviation of a control that looks ahead by it, where the machine says none [mm]: Grbl's setting $11.
const USUAL_DEVIATION: f64 = 0.01;

/// Machine, control and the caller who waits.
pub(super) struct Setting<'a> {
    pub(super) machine: &'a Machine,
    pub(super) progress: &'a dyn Progress,
    /// Limits of the axes; jerk is not limited where the control does not limit it.
    pub(super) limits: [Option<AxisLimit>; AXES],
    /// Whether the motion over time is kept, beside its times.
    pub(super) keeps_motion: bool,
}

impl<'a> Setting<'a> {
    pub(super) fn new(machine: &'a Machine, progress: &'a dyn Progress) -> Setting<'a> {
        Setting { machine, progress, limits: control_limits(machine), keeps_motion: false }
    }

    /// True if some axis has a limit of jerk.
    pub(super) fn limits_jerk(&self) -> bool {
        self.limits.iter().flatten().any(|limit| limit.jerk.is_finite())
    }

    /// The deviation of a control that looks ahead by it [mm]; `None` of another control.
    pub(super) fn junction_deviation(&self) -> Option<f64> {
        let control = &self.machine.control;
        let looks_ahead = control.interpolator == Some(Interpolator::JunctionDeviation);
        looks_ahead.then(|| control.junction_deviation.unwrap_or(USUAL_DEVIATION))
    }

    /// True of a control whose own planner is followed: it passes from rapids to feed as that does, and axes that turn on the
    /// spot are part of their move.
    pub(super) fn has_own_planner(&self) -> bool {
        let own = [Interpolator::JunctionDeviation, Interpolator::LinuxCnc];
        self.machine.control.interpolator.is_some_and(|interpolator| own.contains(&interpolator))
    }

    /// True if LinuxCNC's planner is followed.
    pub(super) fn is_linuxcnc(&self) -> bool {
        self.machine.control.interpolator == Some(Interpolator::LinuxCnc)
    }

    /// How LinuxCNC goes from an item into the next one: `G64` alone has no tolerance there.
    pub(super) fn linuxcnc_ending(&self, program: &Program, item: u32) -> Ending {
        let cycle = |i: usize| i < program.items.len() && matches!(program.items.get(i), Item::Cycle(..));
        let i = item as usize;
        // The rapid to the place of a cycle is part of its block.
        let leads = cycle(i + 1) && program.origin(i).span == program.origin(i + 1).span;
        match program.state(i).blend {
            _ if leads || cycle(i) => Ending::Exact,
            Blend::Stop => Ending::Stop,
            Blend::Exact => Ending::Exact,
            Blend::Continuous => Ending::Within(self.machine.control.tolerance.unwrap_or(0.0)),
            // Its planner is given P alone; lines are merged before it.
            Blend::Tolerance { path, .. } => Ending::Within(path),
        }
    }

    /// Distance by which the control may leave the path at the end of an item; none for an exact stop.
    pub(super) fn tolerance(&self, program: &Program, item: u32) -> Option<Tolerance> {
        let control = &self.machine.control;
        if control.interpolator == Some(Interpolator::ExactStop) {
            return None;
        }
        let way = control.tolerance.unwrap_or(USUAL_TOLERANCE);
        let turn = control.turn_tolerance.unwrap_or(USUAL_TURN_TOLERANCE);
        match program.state(item as usize).blend {
            Blend::Stop => None,
            Blend::Exact => Some(Tolerance::NONE),
            Blend::Continuous => Some(Tolerance { way, turn }),
            Blend::Tolerance { path, merge, angle } => {
                Some(Tolerance { way: path + merge, turn: if angle > 0.0 { angle } else { turn } })
            }
        }
    }
}

/// Limits of the axes as the control of the machine keeps to them.
pub(super) fn control_limits(machine: &Machine) -> [Option<AxisLimit>; AXES] {
    let limits = axis_limits(machine);
    match machine.control.interpolator {
        Some(Interpolator::Trapezoid | Interpolator::JunctionDeviation | Interpolator::LinuxCnc) => {
            without_jerk(&limits)
        }
        _ => limits,
    }
}

/// The same limits without those of jerk.
pub(super) fn without_jerk(limits: &[Option<AxisLimit>; AXES]) -> [Option<AxisLimit>; AXES] {
    limits.map(|limit| Some(AxisLimit { jerk: f64::INFINITY, ..limit? }))
}
