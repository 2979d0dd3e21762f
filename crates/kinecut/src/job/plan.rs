//! From a checked job to programs: one for each setup.

use glam::DVec3;

use super::check::{BoreOperation, Job, JobSetup, Operation};
use super::file::{BoreStrategy, BoreTable, ContactName, Direction, EntryTable, FeedAt, FinishTable};
use crate::base::{Code, Error, Finding, Result};
use crate::geom::{LensOrder, Line};
use crate::holes::clearing::Clearing;
use crate::holes::{
    self, BorePlan, BoreSpec, CutterData, Entry, Finish, LeadEnd, Pace, PlannedMove, Rough, RoughStart,
    Sense, Strategy, Wear, plan_bore,
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
        let at = |e: Error| e.under(&format!("operation[{i}]"));
        let spec = spec(job, setup, bore).map_err(at)?;
        let plan = plan_bore(&spec).map_err(|mut e| {
            if e.code() == Code::CUTTER_TOO_LARGE {
                // Of bore, cutter and allowance the bore is where a person looks first.
                e.0.key = Some("diameter".to_owned());
            }
            at(e)
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

/// The bore operation in the planner's words.
///
/// # Errors
/// `KC0103` for keys that exclude each other.
pub(super) fn spec(job: &Job, setup: &JobSetup, bore: &BoreOperation) -> Result<BoreSpec> {
    let t: &BoreTable = &bore.table;
    let tool = &bore.tool;
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
        None => (Entry::Automatic, None),
    };
    let point = t.rough.as_ref().and_then(|r| r.start).map(from_centre);
    let mut spec = BoreSpec {
        centre: t.at,
        top: t.top,
        breakthrough: (t.breakthrough > 0.0).then_some(t.breakthrough),
        bottom_diameter: t.bottom_diameter,
        leave: [t.leave, t.leave_floor],
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
            engagement: r.engagement.map(f64::to_radians),
            allowance: r.allowance,
            plunge_feed: per_second(r.plunge_feed.unwrap_or(r.feed / 4.0)),
            axial_step: r.axial_step,
            ..Rough::new(r.step, per_second(r.feed))
        }),
        retract_z: setup.safe_height,
        approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, setup.safe_height),
        resolution: job.post.control.has_involute().then(|| job.post.control.resolution(job.post.decimals)),
        ..BoreSpec::new(t.diameter, t.depth, cutter)
    };
    spec.finish = t.finish.as_ref().map(|f| finish(f, t.at)).transpose().map_err(|e| e.under("finish"))?;
    spec.strategy = strategy(&spec, t)?;
    Ok(spec)
}

fn per_second(feed: f64) -> f64 {
    feed / 60.0
}

/// Largest wear that a register may get when the job says nothing [mm].
const USUAL_WEAR: f64 = 0.1;

fn finish(f: &FinishTable, at: [f64; 2]) -> Result<Finish> {
    let end = |key: &str, point: Option<[f64; 2]>, radius: Option<f64>, length: Option<f64>| match (
        point, radius, length,
    ) {
        (None, None, None) => Ok(LeadEnd::Usual),
        (Some(p), None, None) => Ok(LeadEnd::Point([p[0] - at[0], p[1] - at[1]])),
        (None, Some(r), None) => Ok(LeadEnd::Radius(r)),
        (None, None, Some(l)) => Ok(LeadEnd::Length(l)),
        _ => Err(Error::from(
            Finding::error(
                Code::JOB_SHAPE,
                format!("`{key}`, `{key}_radius` and `{key}_length` exclude each other"),
            )
            .cure("give one of them, or none")
            .key(key),
        )),
    };
    let wear = f.wear_offset.as_deref().map(|name| {
        let number = name.strip_prefix(['D', 'd']).and_then(|n| n.parse().ok());
        let register = number.filter(|n| (1..=MOST_REGISTER).contains(n)).ok_or_else(|| {
            Finding::error(Code::JOB_VALUE, format!("`{}` is no wear register", name.escape_default()))
                .cure("write the letter D and a number, such as \"D2\"")
                .key("wear_offset")
        })?;
        Ok::<_, Error>(Wear { register, largest: f.wear_largest.unwrap_or(USUAL_WEAR) })
    });
    Ok(Finish {
        turns: f.turns.unwrap_or(2),
        lead: match f.contact {
            ContactName::G2 => LensOrder::Zero,
            ContactName::G4 => LensOrder::One,
            ContactName::G6 => LensOrder::Two,
        },
        feed_at_wall: f.feed_at == FeedAt::Wall,
        start: end("start", f.start, f.start_radius, f.start_length)?,
        end: end("end", f.end, f.end_radius, f.end_length)?,
        spring_passes: f.spring_passes,
        wear: wear.transpose()?,
        axial_step: f.axial_step,
        ..Finish::new(per_second(f.feed))
    })
}

/// Largest register that a control has.
const MOST_REGISTER: u32 = 999;

fn strategy(spec: &BoreSpec, t: &BoreTable) -> Result<Strategy> {
    let pitch = || match (t.rough.as_ref().and_then(|r| r.pitch), &spec.rough) {
        (Some(pitch), _) => pitch,
        (None, Some(rough)) => holes::entry_table::usual_pitch(spec, rough),
        (None, None) => 0.0,
    };
    let from_centre = spec.entry == Entry::Plunge || matches!(spec.start, RoughStart::Point(_));
    if t.strategy == BoreStrategy::Annular && from_centre {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "an annular involute starts on a circle, not in a point",
        )
        .cure("enter by a helix or a pre-drilled hole, or use `involute`")
        .key("strategy")
        .into());
    }
    Ok(match t.strategy {
        BoreStrategy::Involute | BoreStrategy::Annular => Strategy::Clear(Clearing::Involute),
        BoreStrategy::Lens1 => Strategy::Clear(Clearing::Lens(LensOrder::One)),
        BoreStrategy::Lens2 => Strategy::Clear(Clearing::Lens(LensOrder::Two)),
        BoreStrategy::ConstantEngagement => Strategy::Clear(Clearing::ConstantEngagement(LensOrder::One)),
        BoreStrategy::Arcs2 => Strategy::Clear(Clearing::Poles(2)),
        BoreStrategy::Arcs4 => Strategy::Clear(Clearing::Poles(4)),
        BoreStrategy::Archimedean => Strategy::Clear(Clearing::Archimedes),
        BoreStrategy::Rings => Strategy::Clear(Clearing::RingsRadial),
        BoreStrategy::RingsTangent => Strategy::Clear(Clearing::RingsTangent),
        BoreStrategy::Trochoidal => Strategy::Clear(Clearing::Trochoid),
        BoreStrategy::Ramping => Strategy::Ramp(LensOrder::One),
        BoreStrategy::Helix => Strategy::Helix { pitch: pitch() },
        BoreStrategy::OutlineHelix => Strategy::Outline { pitch: pitch() },
    })
}
