//! From a checked job to programs: one for each setup.

use glam::DVec3;

use super::check::{BoreOperation, Job, JobSetup, Operation};
use super::file::{BoreTable, Direction, EntryTable};
use crate::base::{Code, Result};
use crate::geom::Line;
use crate::holes::{
    self, BorePlan, BoreSpec, CutterData, Entry, Finish, Pace, PlannedMove, Rough, RoughStart, Sense,
    plan_bore,
};
use crate::program::{
    Coolant, Frame, Move, Origin, Path, Program, Role, SetupId, Speed, Spindle, State, StopKind, Target,
};

/// The planned program of one setup.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The program.
    pub program: Program,
    /// What the planner says of each bore, with the number of its operation.
    pub bores: Vec<(u32, BorePlan)>,
    /// Height above the work zero that is assumed for a retracted tool where the machine position is not known [mm].
    pub retract_height: f64,
}

/// Plans all setups of a job.
///
/// # Errors
/// The planner's, with the key of the operation.
pub fn plan(job: &Job) -> Result<Vec<Planned>> {
    let mut number = 0;
    let mut planned = Vec::with_capacity(job.setups.len());
    for (i, setup) in job.setups.iter().enumerate() {
        planned.push(plan_setup(job, setup, &mut number).map_err(|e| e.under(&format!("setup[{i}]")))?);
    }
    Ok(planned)
}

/// Assumed distance of a retracted tool above the safe height [mm].
const RETRACTED_ABOVE_SAFE: f64 = 100.0;

fn plan_setup(job: &Job, setup: &JobSetup, number: &mut u32) -> Result<Planned> {
    let mut program = Program::new(vec![setup.setup.clone()]);
    let frame = program.add_frame(Frame::Work(setup.offset));
    let mut state = State::start(SetupId(0), frame);
    state.blend = job.post.control.usual_blend();
    // Up is the upper end of the travel: machine zero only where it is not known.
    let up = job.machine.as_ref().and_then(|m| m.axes[2].travel).map_or(0.0, |[_, max]| max);
    let retract = Move { end: Target::Joints([None, None, Some(up)]), path: Path::Line };
    let mut bores = Vec::new();
    let mut in_spindle = None;
    for (i, operation) in setup.operations.iter().enumerate() {
        let Operation::Bore(bore) = operation;
        let origin = Origin { operation: Some(*number), role: Role::Link, ..Origin::default() };
        let spec = spec(job, setup, bore);
        let plan = plan_bore(&spec).map_err(|mut e| {
            if e.code() == Code::CUTTER_TOO_LARGE {
                // Of bore, cutter and allowance the bore is where a person looks first.
                e.0.key = Some("diameter".to_owned());
            }
            e.under(&format!("operation[{i}]"))
        })?;
        state.speed = Speed::Rapid { linear: true };
        if in_spindle != Some(bore.tool.number) {
            state.spindle = Spindle::Off;
            state.coolant = Coolant::Off;
            program.push_move(retract, &state, origin);
            let register = job.post.control.length_register(bore.tool.number);
            program.push_tool(bore.tool.number, Some(register), Some(register), &state, origin);
            in_spindle = Some(bore.tool.number);
        }
        state.spindle = Spindle::Clockwise(bore.spindle);
        let diameter = bore.table.diameter;
        program.push_text(
            format!("BORE D{diameter} X{} Y{}", bore.table.at[0], bore.table.at[1]),
            &state,
            origin,
        );
        push_bore(&mut program, &mut state, &plan.moves, bore, origin);
        bores.push((*number, plan));
        *number += 1;
    }
    let origin = Origin::default();
    state.speed = Speed::Rapid { linear: true };
    state.coolant = Coolant::Off;
    program.push_move(retract, &state, origin);
    state.spindle = Spindle::Off;
    program.push_stop(StopKind::End, &state, origin);
    Ok(Planned { program, bores, retract_height: setup.safe_height + RETRACTED_ABOVE_SAFE })
}

fn push_bore(
    program: &mut Program,
    state: &mut State,
    moves: &[PlannedMove],
    bore: &BoreOperation,
    origin: Origin,
) {
    let mut first = true;
    for m in moves {
        state.speed = match m.pace {
            Pace::Rapid => Speed::Rapid { linear: true },
            Pace::Feed(feed) => Speed::PerMinute(feed),
        };
        let origin = Origin { role: role(m), ..origin };
        if first {
            // From wherever the tool stands: first over the place, then down.
            let at = m.curve.start();
            let over = Line { start: at, end: DVec3::new(at.x, at.y, f64::NAN) };
            let travel = State { speed: Speed::Rapid { linear: true }, ..*state };
            program.push_move(Move::along(&over.into()), &travel, origin);
            program.push_move(Move::along(&Line { start: at, end: at }.into()), &travel, origin);
            state.coolant = bore.coolant;
            first = false;
        }
        program.push_move(Move::along(&m.curve), state, origin);
    }
}

fn role(m: &PlannedMove) -> Role {
    match m.role {
        holes::Role::Rough => Role::Rough,
        holes::Role::Circle if m.finishing => Role::Finish,
        holes::Role::Circle => Role::Rough,
        holes::Role::Finish => Role::Finish,
        holes::Role::Entry | holes::Role::LeadIn | holes::Role::LeadOut => Role::Lead,
        holes::Role::Approach | holes::Role::Link | holes::Role::Retract => Role::Link,
    }
}

/// Distance above material at which rapids end [mm].
const CLEARANCE: f64 = 2.0;

fn spec(job: &Job, setup: &JobSetup, bore: &BoreOperation) -> BoreSpec {
    let t: &BoreTable = &bore.table;
    let tool = &bore.tool;
    let per_second = |feed: f64| feed / 60.0;
    let from_centre = |p: [f64; 2]| [p[0] - t.at[0], p[1] - t.at[1]];
    let cutter = CutterData {
        diameter: tool.cutter.diameter(tool.flute_length),
        flute_length: tool.flute_length,
        centre_cutting: tool.centre_cutting,
        max_ramp_angle: tool.max_ramp_angle,
    };
    let (entry, drilled) = match &t.entry {
        Some(EntryTable::Plunge) => (Entry::Plunge, None),
        Some(EntryTable::Helix(h)) => (Entry::Helix { radius: h.radius, pitch: h.pitch }, None),
        Some(EntryTable::PreDrilled(d)) => (Entry::PreDrilled, Some(d.diameter)),
        None => (usual_entry(&cutter, t), None),
    };
    let point = t.rough.as_ref().and_then(|r| r.start).map(from_centre);
    BoreSpec {
        centre: t.at,
        top: t.top,
        depth: t.depth,
        breakthrough: (t.breakthrough > 0.0).then_some(t.breakthrough),
        diameter: t.diameter,
        cutter,
        sense: match t.direction {
            Direction::Climb => Sense::Climb,
            Direction::Conventional => Sense::Conventional,
        },
        start: match (drilled, point) {
            (Some(diameter), None) => RoughStart::PreDrilled { diameter },
            (_, Some(point)) => RoughStart::Point(point),
            (None, None) => RoughStart::Centre,
        },
        entry,
        rough: t.rough.as_ref().map(|r| Rough {
            step: r.step,
            allowance: r.allowance,
            feed: per_second(r.feed),
            plunge_feed: per_second(r.plunge_feed.unwrap_or(r.feed / 4.0)),
            axial_step: r.axial_step,
        }),
        finish: t.finish.as_ref().map(|f| Finish {
            turns: f.turns.unwrap_or(2),
            feed: per_second(f.feed),
            start: f.start.map(from_centre),
            end: f.end.map(from_centre),
            axial_step: f.axial_step,
            wear: None,
        }),
        retract_z: setup.safe_height,
        approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, setup.safe_height),
        resolution: job.post.control.has_involute().then(|| job.post.control.resolution(job.post.decimals)),
    }
}

/// The entry when the job names none: a helix that leaves no core, as steep as the cutter is known to follow.
fn usual_entry(cutter: &CutterData, t: &BoreTable) -> Entry {
    /// Ramp that nearly every cutter follows [rad].
    const RAMP: f64 = 0.035;
    /// Share of the cutter's radius: below 1 no core is left, and the load of the helix is even.
    const SHARE: f64 = 0.6;
    let room = (t.diameter - cutter.diameter) / 4.0;
    let radius = SHARE * cutter.diameter / 2.0;
    // A bore without room is refused by the planner; here the helix only stays a helix.
    let radius = if room > 0.0 && room < radius { room } else { radius };
    // A tenth below what is allowed: the planner may move the radius a little.
    let ramp = 0.9 * cutter.max_ramp_angle.unwrap_or(RAMP).clamp(0.0, RAMP);
    Entry::Helix { radius, pitch: std::f64::consts::TAU * radius * ramp.tan() }
}
