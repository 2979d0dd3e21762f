//! From a checked job to programs: one for each setup.

use std::collections::BTreeMap;

use super::check::{Job, JobSetup};
use super::tilt::{all_zero, tilt, tilted};
use crate::base::{Code, Error, Finding, Progress, Result};
use crate::machine::Machine;
use crate::operations::{
    Attempt, Clamping, MadeHole, Milling, Operation, OperationPlan, Pen, PlacedMouth, PlacedPlane, Setting,
    WearRegister,
};
use crate::page::inches;
use crate::program::{
    Coolant, Frame, FrameId, Move, Origin, Path, Program, Role, SetupId, Speed, Spindle, State, StopKind,
    Target, ToolNumber,
};
use crate::tool::Hand;

/// The planned program of one setup.
#[derive(Clone, Debug)]
pub struct SetupPlan {
    /// The program.
    pub program: Program,
    /// The planned operations; those that were left out are not among them.
    pub operations: Vec<PlannedOperation>,
    /// Operations and holes that were left out, and why; what the planners say.
    pub findings: Vec<Finding>,
    /// Items of moves with a lower feed than the job asks for, with the asked one [mm/s].
    pub lowered: BTreeMap<u32, f64>,
    /// Values of the wear registers with which the program is simulated [mm].
    pub radii: Vec<(u32, f64)>,
    /// Height above the work zero that is assumed for a retracted tool where the machine position is not known [mm].
    pub retract_height: f64,
}

/// A planned operation.
#[derive(Clone, Debug)]
pub struct PlannedOperation {
    /// Its number over all setups.
    pub number: u32,
    /// Its plan.
    pub plan: OperationPlan,
}

impl SetupPlan {
    /// Nothing planned: for a program that others wrote.
    fn nothing(setup: &JobSetup) -> SetupPlan {
        SetupPlan {
            program: Program::default(),
            operations: Vec::new(),
            findings: Vec::new(),
            lowered: BTreeMap::new(),
            radii: Vec::new(),
            retract_height: setup.retract_height(),
        }
    }
}

/// Plans all setups of a job; for those with a program that others wrote nothing is planned.
///
/// # Errors
/// The planner's, with the key of the operation.
pub fn plan(job: &Job, progress: &dyn Progress) -> Result<Vec<SetupPlan>> {
    let mut number = 0;
    let mut planned = Vec::with_capacity(job.setups.len());
    let mut made = Made::default();
    for (i, setup) in job.setups.iter().enumerate() {
        if setup.program.is_some() {
            planned.push(SetupPlan::nothing(setup));
            continue;
        }
        let under = format!("setup[{i}]");
        let mut one = plan_setup(job, setup, number, &mut made, progress).map_err(|e| e.under(&under))?;
        number += setup.operations.len() as u32;
        for finding in one.findings.iter_mut().filter(|f| f.key.is_some()) {
            *finding = finding.clone().under(&under);
        }
        planned.push(one);
    }
    Ok(planned)
}

/// Holes, planes and recesses that operations leave, over all setups.
#[derive(Default)]
struct Made {
    holes: Vec<MadeHole>,
    planes: Vec<PlacedPlane>,
    mouths: Vec<PlacedMouth>,
}

/// Plans the operations of a setup, the first of which has the number `first`; `made` gathers what they leave.
fn plan_setup(
    job: &Job,
    setup: &JobSetup,
    first: u32,
    made: &mut Made,
    progress: &dyn Progress,
) -> Result<SetupPlan> {
    let mut writer = Writer::new(job, setup);
    let (mut operations, mut findings) = (Vec::new(), Vec::new());
    let mut milled = None;
    for (i, operation) in setup.operations.iter().enumerate() {
        let key = format!("operation[{i}]");
        let at = |e: Error| e.under(&key);
        let number = first + i as u32;
        let clamping = setup.at(operation.milling());
        let milled_before = milled.as_ref();
        let setting = Setting {
            made: &made.holes,
            faced: &made.planes,
            mouths: &made.mouths,
            milled: milled_before,
            ..setting(job, setup, &clamping, number, progress)
        };
        let mut plan = match operation.plan(&setting).map_err(at)? {
            Attempt::SetupPlan(plan, mut found) => {
                if is_cleared_later(operation, &setup.operations[i + 1..]) {
                    found.retain(|f| f.code != Code::CORNERS_STAY);
                }
                findings.extend(found.into_iter().map(|f| f.under(&key)));
                plan
            }
            Attempt::LeftOut(reason) => {
                findings.push(reason.under(&key));
                continue;
            }
        };
        plan.turn_part(&setting, &mut writer.program.setups[0]);
        writer.operation(operation, &mut plan, setting).map_err(at)?;
        let to_part = clamping.to_work().inverse();
        made.holes.extend(plan.holes().into_iter().map(|hole| MadeHole { hole, to_part }));
        made.planes.extend(plan.made_plane().map(|plane| PlacedPlane { plane, to_part }));
        made.mouths.extend(plan.mouths().into_iter().map(|mouth| PlacedMouth { mouth, to_part }));
        milled = plan.milled().or(milled);
        operations.push(PlannedOperation { number, plan });
    }
    let (program, lowered, radii) = writer.end();
    Ok(SetupPlan { program, operations, findings, lowered, radii, retract_height: setup.retract_height() })
}

/// Whether a pocket after another clears what that one leaves in its corners.
fn is_cleared_later(operation: &Operation, later: &[Operation]) -> bool {
    let pocket = |o: &Operation| match o {
        Operation::Pocket(of) => Some((of.table.name.clone(), of.table.rest.clone())),
        _ => None,
    };
    let Some((Some(name), _)) = pocket(operation) else { return false };
    later.iter().filter_map(pocket).any(|(_, rest)| rest.is_some_and(|rest| rest == name))
}

/// The setting of an operation of a setup; `clamping` is as the operation sees it, `number` its own over all setups.
pub(crate) fn setting<'a>(
    job: &'a Job,
    setup: &JobSetup,
    clamping: &'a Clamping,
    number: u32,
    progress: &'a dyn Progress,
) -> Setting<'a> {
    Setting {
        number,
        clamping,
        others: setup.operations.len().saturating_sub(1),
        stock: &job.stock,
        drilled: &job.drilled,
        made: &[],
        faced: &[],
        mouths: &[],
        milled: None,
        machine: job.machine.as_ref(),
        orientation: job.orientation,
        post: &job.post,
        feed_limit: job.feed_limit,
        compare: job.compare,
        progress,
    }
}

/// The program of a setup as it is written, operation after operation.
struct Writer<'a> {
    job: &'a Job,
    setup: &'a JobSetup,
    program: Program,
    state: State,
    /// The frame of the work offset.
    plain: FrameId,
    /// The retraction along the machine's Z.
    retract: Move,
    /// The tool with the register that was called for it.
    in_spindle: Option<(ToolNumber, u32)>,
    /// Whether rotary axes are not at zero.
    turned_axes: bool,
    lowered: BTreeMap<u32, f64>,
    radii: Vec<(u32, f64)>,
}

impl<'a> Writer<'a> {
    fn new(job: &'a Job, setup: &'a JobSetup) -> Writer<'a> {
        let mut program = Program::new(vec![setup.setup.clone()]);
        let plain = program.add_frame(Frame::Work(setup.offset));
        let mut state = State::start(SetupId(0), plain);
        state.blend = job.post.control.usual_blend();
        // Up is the upper end of the travel: machine zero only where it is not known.
        let up = job.machine.as_ref().and_then(|m| m.travel('Z')).map_or(0.0, |[_, max]| max);
        let retract =
            Move { end: Target::Joints([None, None, Some(up), None, None, None]), path: Path::Line };
        let (in_spindle, turned_axes, lowered, radii) = (None, false, BTreeMap::new(), Vec::new());
        Writer { job, setup, program, state, plain, retract, in_spindle, turned_axes, lowered, radii }
    }

    /// Calls the tool, tilts the plane, writes the name and the moves.
    fn operation(
        &mut self,
        operation: &Operation,
        plan: &mut OperationPlan,
        setting: Setting<'_>,
    ) -> Result<()> {
        let milling = operation.milling();
        let origin = Origin { operation: Some(setting.number), role: Role::Link, ..Origin::default() };
        self.wear(plan.wear())?;
        self.call(milling, plan.wear(), origin);
        self.tilt(milling, origin)?;
        let hand = if operation.is_left_hand() { Hand::Left } else { Hand::Right };
        self.state.spindle = Spindle::turning(hand, milling.spindle);
        let name = match self.job.post.units.is_inch() {
            true => inches::name(&operation.name()),
            false => operation.name(),
        };
        self.program.push_text(name.to_uppercase(), &self.state, origin);
        let (program, state, lowered) = (&mut self.program, &mut self.state, &mut self.lowered);
        plan.write(&mut Pen { program, state, origin, retract: self.retract, lowered, setting })?;
        self.turned_axes |= plan.leaves_axes_turned();
        Ok(())
    }

    /// Notes the value of a wear register.
    fn wear(&mut self, wear: Option<WearRegister>) -> Result<()> {
        let Some(WearRegister { number, value, radius }) = wear else { return Ok(()) };
        let value = value + radius;
        if self.radii.iter().any(|&(r, other)| r == number && other != value) {
            return Err(Finding::error(
                Code::JOB_VALUE,
                format!("two operations give D{number} different values"),
            )
            .value_mm(value)
            .help(
                "give each operation a register of its own, or the same value; two cutters need two numbers",
            )
            .key(if radius > 0.0 { "finish.wear_offset" } else { "finish.wear_value" })
            .into());
        }
        self.radii.push((number, value));
        Ok(())
    }

    /// Calls the tool, with the register of its wear where that holds the length too; retracts before a change.
    fn call(&mut self, milling: &Milling, wear: Option<WearRegister>, origin: Origin) {
        self.state.speed = Speed::Rapid { linear: true };
        let (control, tool) = (self.job.post.control, milling.tool.number);
        let own = wear.map(|w| w.number).filter(|_| control.wear_holds_length());
        let called = own.unwrap_or(control.length_register(tool));
        if self.in_spindle == Some((tool, called)) {
            return;
        }
        if self.in_spindle.map(|(t, _)| t) != Some(tool) {
            self.state.spindle = Spindle::Off;
            self.state.coolant = Coolant::Off;
            self.program.push_move(self.retract, &self.state, origin);
            if self.in_spindle.is_none() && self.job.machine.as_ref().is_some_and(Machine::is_multi_axis) {
                // Wherever the rotary axes were left.
                let home = Move { end: all_zero(self.job.machine.as_ref()), path: Path::Line };
                self.program.push_move(home, &self.state, origin);
            }
        }
        self.program.push_tool(tool, Some(called), Some(called), &self.state, origin);
        self.in_spindle = Some((tool, called));
    }

    /// Goes over to the plane of an operation, or back to the work offset.
    fn tilt(&mut self, milling: &Milling, origin: Origin) -> Result<()> {
        let plane = match (milling.plane, &self.job.machine) {
            (Some(plane), Some(machine)) => Some(tilted(self.job, self.setup, milling, &plane, machine)?),
            _ => None,
        };
        let frame = plane.map_or(self.plain, |(frame, _)| self.program.add_frame(frame));
        if frame != self.state.frame || self.turned_axes {
            self.turned_axes = frame != self.plain;
            let turn = plane.map_or_else(|| all_zero(self.job.machine.as_ref()), |(_, turn)| turn);
            tilt(&mut self.program, &mut self.state, frame, (self.retract, turn), origin);
        }
        Ok(())
    }

    /// Retracts, turns the axes back, and ends the program.
    fn end(mut self) -> (Program, BTreeMap<u32, f64>, Vec<(u32, f64)>) {
        let origin = Origin::default();
        self.state.speed = Speed::Rapid { linear: true };
        self.state.coolant = Coolant::Off;
        self.program.push_move(self.retract, &self.state, origin);
        if self.turned_axes {
            let turn = all_zero(self.job.machine.as_ref());
            tilt(&mut self.program, &mut self.state, self.plain, (self.retract, turn), origin);
        }
        self.state.spindle = Spindle::Off;
        self.program.push_stop(StopKind::End, &self.state, origin);
        self.program.hold_rotary_axes();
        (self.program, self.lowered, self.radii)
    }
}
