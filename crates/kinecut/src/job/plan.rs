//! From a checked job to programs: one for each setup.

use glam::{DMat3, DVec3};

use super::check::{BoreOperation, EllipseOperation, Job, JobSetup, Operation, corners};
use super::drill::{DrilledHoles, Drilling, plan_holes, push_holes};
use super::face::{Over, PlannedFace, plan_face, push_face};
use super::file::{
    BoreStrategy, BoreTable, ContactName, Direction, EntryTable, FeedAt, FinishTable, RoughTable,
};
use super::path::{OnMachine, push_turned, push_upright, turned_path};
use super::tilt::{all_zero, tilt, tilted};
use crate::base::{Code, Error, Finding, Progress, Result};
use crate::geom::{LensOrder, Line, Rigid};
use crate::holes::clearing::Clearing;
use crate::holes::{
    self, BorePlan, BoreSpec, CutterData, EllipseSpec, Entry, Finish, LeadEnd, Pace, PlannedMove, Rough,
    RoughStart, Sense, Strategy, Wear, plan_bore, plan_ellipse,
};
use crate::machine::Machine;
use crate::nc::Control;
use crate::program::{
    Comp, Coolant, Frame, Move, Origin, Path, Program, Role, SetupId, Speed, Spindle, State, StopKind, Target,
};
use crate::tool::Tool;

/// The planned program of one setup.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The program.
    pub program: Program,
    /// What the planner says of each bore, with the number of its operation.
    pub bores: Vec<(u32, BorePlan)>,
    /// The holes of each drilling.
    pub drillings: Vec<DrilledHoles>,
    /// The milled faces.
    pub faces: Vec<PlannedFace>,
    /// Operations and holes that were left out, and why; what the planner of drilling says.
    pub findings: Vec<Finding>,
    /// Cores that are taken out at the program stops, in order.
    pub slugs: Vec<TakenOut>,
    /// Values of the wear registers with which the program is simulated [mm].
    pub radii: Vec<(u32, f64)>,
    /// Height above the work zero that is assumed for a retracted tool where the machine position is not known [mm].
    pub retract_height: f64,
}

/// A loose core that a person takes out while the program stands at `M0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TakenOut {
    /// Centre of its upper end, in coordinates of the work offset [mm].
    pub centre: DVec3,
    /// Direction out of the bore, in coordinates of the work offset: a unit vector.
    pub out: DVec3,
    /// Diameter [mm].
    pub diameter: f64,
    /// Depth from its upper end down [mm].
    pub depth: f64,
}

impl Planned {
    /// Nothing planned: for a program that others wrote.
    fn nothing(setup: &JobSetup) -> Planned {
        Planned {
            program: Program::default(),
            bores: Vec::new(),
            drillings: Vec::new(),
            faces: Vec::new(),
            findings: Vec::new(),
            slugs: Vec::new(),
            radii: Vec::new(),
            retract_height: setup.retract_height(),
        }
    }
}

/// Plans all setups of a job; for those with a program that others wrote nothing is planned.
///
/// # Errors
/// The planner's, with the key of the operation.
pub fn plan(job: &Job, progress: &dyn Progress) -> Result<Vec<Planned>> {
    let mut number = 0;
    let mut planned = Vec::with_capacity(job.setups.len());
    for i in 0..job.setups.len() {
        if job.setups[i].program.is_some() {
            planned.push(Planned::nothing(&job.setups[i]));
            continue;
        }
        let under = format!("setup[{i}]");
        let mut one = plan_setup(job, i, &mut number, progress).map_err(|e| e.under(&under))?;
        for finding in one.findings.iter_mut().filter(|f| f.key.is_some()) {
            *finding = finding.clone().under(&under);
        }
        planned.push(one);
    }
    Ok(planned)
}

fn plan_setup(job: &Job, index: usize, number: &mut u32, progress: &dyn Progress) -> Result<Planned> {
    let setup = &job.setups[index];
    let mut program = Program::new(vec![setup.setup.clone()]);
    let frame = program.add_frame(Frame::Work(setup.offset));
    let mut state = State::start(SetupId(0), frame);
    state.blend = job.post.control.usual_blend();
    // Up is the upper end of the travel: machine zero only where it is not known.
    let up = job.machine.as_ref().and_then(|m| m.travel('Z')).map_or(0.0, |[_, max]| max);
    let retract = Move { end: Target::Joints([None, None, Some(up), None, None, None]), path: Path::Line };
    let mut bores = Vec::new();
    let mut radii: Vec<(u32, f64)> = Vec::new();
    let mut slugs = Vec::new();
    let mut drillings: Vec<DrilledHoles> = Vec::new();
    let mut faces: Vec<PlannedFace> = Vec::new();
    let mut findings = Vec::new();
    let mut in_spindle = None;
    let plain = frame;
    // Whether rotary axes do not stand at zero.
    let mut turned_axes = false;
    for (i, operation) in setup.operations.iter().enumerate() {
        let placed = setup.at(operation);
        let setup = &*placed;
        let origin = Origin { operation: Some(*number), role: Role::Link, ..Origin::default() };
        let at = |e: Error| e.under(&format!("operation[{i}]"));
        let milling = operation.milling();
        let (moves, register, slug) = match operation {
            Operation::Bore(bore) => {
                let mut spec = spec(job, setup, bore).map_err(at)?;
                if let Some(warning) = nothing_to_mill(&spec, operation) {
                    findings.push(warning);
                    *number += 1;
                    continue;
                }
                wear(job, bore, &mut spec).map_err(|e| at(e.under("finish")))?;
                let plan = plan_bore(&spec).map_err(|mut e| {
                    if e.code() == Code::CUTTER_TOO_LARGE {
                        // Of bore, cutter and allowance the bore is where a person looks first.
                        e.0.key = Some("diameter".to_owned());
                    }
                    at(e)
                })?;
                let register = spec.finish.and_then(|f| f.wear).map(|w| w.register);
                if let (Some(register), Some(f)) = (register, &bore.table.finish) {
                    let value = f.wear_value.unwrap_or(0.0);
                    if radii.iter().any(|&(r, other)| r == register && other != value) {
                        return Err(at(Finding::error(
                            Code::JOB_VALUE,
                            format!("two operations give D{register} different values"),
                        )
                        .value_mm(value)
                        .cure("give each bore a register of its own, or the same value")
                        .key("finish.wear_value")
                        .into()));
                    }
                    radii.push((register, value));
                }
                let moves = plan.moves.clone();
                let slug = plan.slug;
                bores.push((*number, plan));
                (moves, register, slug)
            }
            Operation::Ellipse(pocket) => {
                let plan = plan_ellipse(&ellipse_spec(setup, pocket)).map_err(at)?;
                (plan.moves, None, None)
            }
            Operation::Drill(drill) => {
                let (holes, found) = plan_holes(job, setup, drill).map_err(at)?;
                findings.extend(found.into_iter().map(|f| f.under(&format!("operation[{i}]"))));
                drillings.push(DrilledHoles { operation: *number, holes });
                (Vec::new(), None, None)
            }
            Operation::Face(face) => {
                let (planned, found) = plan_face(job, setup, face, *number, progress).map_err(at)?;
                findings.extend(found.into_iter().map(|f| f.under(&format!("operation[{i}]"))));
                if planned.part_turned != 0.0 {
                    planned.turn_part(setup, &mut program.setups[0]);
                }
                faces.push(planned);
                (Vec::new(), None, None)
            }
            Operation::Path(_) => (Vec::new(), None, None),
        };
        state.speed = Speed::Rapid { linear: true };
        let (control, tool) = (job.post.control, milling.tool.number);
        // Where the wear register holds the length too, it is called for the whole operation.
        let called =
            register.filter(|_| control.wear_holds_length()).unwrap_or(control.length_register(tool));
        if in_spindle != Some((tool, called)) {
            if in_spindle.map(|(t, _)| t) != Some(tool) {
                state.spindle = Spindle::Off;
                state.coolant = Coolant::Off;
                program.push_move(retract, &state, origin);
                if in_spindle.is_none() && job.machine.as_ref().is_some_and(Machine::is_multi_axis) {
                    // Wherever the rotary axes were left.
                    let home = Move { end: all_zero(job.machine.as_ref()), path: Path::Line };
                    program.push_move(home, &state, origin);
                }
            }
            program.push_tool(tool, Some(called), Some(called), &state, origin);
            in_spindle = Some((tool, called));
        }
        let plane = match (milling.plane, &job.machine) {
            (Some(plane), Some(machine)) => {
                Some(tilted(job, &job.setups[index], milling, &plane, machine).map_err(at)?)
            }
            _ => None,
        };
        let frame = plane.map_or(plain, |(frame, _)| program.add_frame(frame));
        if frame != state.frame || turned_axes {
            turned_axes = frame != plain;
            let turn = plane.map_or_else(|| all_zero(job.machine.as_ref()), |(_, turn)| turn);
            tilt(&mut program, &mut state, frame, (retract, turn), origin);
        }
        state.spindle = match operation {
            Operation::Face(face) if face.table.left_hand => Spindle::CounterClockwise(milling.spindle),
            _ => Spindle::Clockwise(milling.spindle),
        };
        program.push_text(operation.name().to_uppercase(), &state, origin);
        if let Some(register) = register {
            program.push_text(control.wear_note(tool, register), &state, origin);
            program.push_text("0 AS PLANNED, POSITIVE MAKES THE BORE SMALLER", &state, origin);
        }
        if let (Operation::Drill(drill), Some(planned)) = (operation, drillings.last_mut()) {
            if control == Control::LinuxCnc {
                program.push_text(
                    "G95 NEEDS THE SPINDLE SPEED FED BACK (spindle.0.speed-in)",
                    &state,
                    origin,
                );
            }
            let with = Drilling {
                control,
                resolution: job.post.resolution.unwrap_or(control.resolution(job.post.decimals)),
                clearance: drill.table.clearance.unwrap_or(setup.safe_height),
                coolant: milling.coolant,
            };
            push_holes(&mut program, &mut state, drill, &mut planned.holes, with, origin).map_err(at)?;
            *number += 1;
            continue;
        }
        if let Operation::Path(path) = operation {
            match job.machine.as_ref().filter(|_| path.is_multi_axis()) {
                None => push_upright(&mut program, &mut state, path, milling.coolant, origin),
                Some(machine) => {
                    let turned = turned_path(
                        path,
                        setup,
                        machine,
                        (job.orientation, job.post.control.turns_in_plane()),
                        progress,
                    )
                    .map_err(at)?;
                    findings
                        .extend(turned.findings.iter().cloned().map(|f| f.under(&format!("operation[{i}]"))));
                    let work = setup.setup.work_offsets.get(&setup.offset).copied();
                    let with = OnMachine {
                        machine,
                        work: work.unwrap_or(Rigid::IDENTITY),
                        retract,
                        coolant: milling.coolant,
                        corners: corners(&job.stock.bounds(), &setup.to_operation(operation)),
                    };
                    push_turned(&mut program, &mut state, path, &turned, &with, origin).map_err(at)?;
                    turned_axes = true;
                }
            }
            *number += 1;
            continue;
        }
        if let (Operation::Face(face), Some(planned)) = (operation, faces.last_mut()) {
            planned.first_item = program.items.len() as u32;
            let over = Over { clearance: setup.safe_height, coolant: milling.coolant };
            if planned.part_turned != 0.0 {
                let turned = planned.part_turned.to_degrees();
                let sense = if turned < 0.0 { "CLOCKWISE" } else { "COUNTERCLOCKWISE" };
                let text = format!("PART TURNED BY {:.3} DEG {sense} ABOUT THE WORK ZERO", turned.abs());
                program.push_text(text, &state, origin);
            }
            let plain = state.frame;
            if planned.coordinates_turned != 0.0 {
                let rotation = DMat3::from_rotation_z(planned.coordinates_turned);
                let motion = Rigid { rotation, translation: DVec3::ZERO };
                state.frame = program.add_frame(Frame::Shift { parent: plain, motion });
            }
            push_face(&mut program, &mut state, (face, &planned.programmed_path()), over, origin)
                .map_err(at)?;
            state.frame = plain;
            *number += 1;
            continue;
        }
        let clockwise = match operation {
            Operation::Bore(bore) => bore.table.direction == Direction::Conventional,
            Operation::Ellipse(pocket) => pocket.table.direction == Direction::Conventional,
            Operation::Drill(_) | Operation::Face(_) | Operation::Path(_) => false,
        };
        // The wall is on the outside of a path that runs round inside: to the right when it runs counter-clockwise.
        let comp = register.map(|r| if clockwise { Comp::Right(r) } else { Comp::Left(r) });
        match slug {
            None => push_moves(&mut program, &mut state, &moves, milling.coolant, comp, origin),
            Some(slug) => {
                let (before, after) = moves.split_at(slug.before);
                push_moves(&mut program, &mut state, before, milling.coolant, comp, origin);
                let running = state.spindle;
                (state.spindle, state.coolant) = (Spindle::Off, Coolant::Off);
                state.speed = Speed::Rapid { linear: true };
                // A person reaches under the tool.
                program.push_move(retract, &state, origin);
                program.push_text("TAKE OUT THE SLUG", &state, origin);
                program.push_stop(StopKind::Program, &state, origin);
                if let Operation::Bore(bore) = operation {
                    let t = &bore.table;
                    let plane = milling.plane.map_or(Rigid::IDENTITY, |p| p.motion);
                    let slug = TakenOut {
                        centre: plane.point(DVec3::new(t.at[0], t.at[1], t.top)),
                        out: plane.vector(DVec3::Z),
                        diameter: slug.diameter,
                        depth: t.depth + t.breakthrough,
                    };
                    slugs.push(slug);
                }
                state.spindle = running;
                push_moves(&mut program, &mut state, after, milling.coolant, comp, origin);
            }
        }
        *number += 1;
    }
    let origin = Origin::default();
    state.speed = Speed::Rapid { linear: true };
    state.coolant = Coolant::Off;
    program.push_move(retract, &state, origin);
    if turned_axes {
        tilt(&mut program, &mut state, plain, (retract, all_zero(job.machine.as_ref())), origin);
    }
    state.spindle = Spindle::Off;
    program.push_stop(StopKind::End, &state, origin);
    program.hold_rotary_axes();
    let retract_height = setup.retract_height();
    Ok(Planned { program, bores, drillings, faces, findings, radii, slugs, retract_height })
}

fn push_moves(
    program: &mut Program,
    state: &mut State,
    moves: &[PlannedMove],
    coolant: Coolant,
    comp: Option<Comp>,
    origin: Origin,
) {
    let mut first = true;
    for m in moves {
        state.speed = match m.pace {
            Pace::Rapid => Speed::Rapid { linear: true },
            Pace::Feed(feed) => Speed::PerMinute(feed),
        };
        state.comp = if m.comp { comp.unwrap_or(Comp::Off) } else { Comp::Off };
        let origin = Origin { role: role(m), ..origin };
        if first {
            // From wherever the tool stands: first over the place, then down.
            let at = m.curve.start();
            let over = Line { start: at, end: DVec3::new(at.x, at.y, f64::NAN) };
            let travel = State { speed: Speed::Rapid { linear: true }, ..*state };
            program.push_move(Move::along(&over.into()), &travel, origin);
            program.push_move(Move::along(&Line { start: at, end: at }.into()), &travel, origin);
            state.coolant = coolant;
            first = false;
        }
        program.push_move(Move::along(&m.curve), state, origin);
    }
    state.comp = Comp::Off;
}

/// A warning when the stock to leave, and nothing else, keeps the cutter out of the bore.
fn nothing_to_mill(spec: &BoreSpec, operation: &Operation) -> Option<Finding> {
    let (left, cutter) = (spec.wall_radius(spec.floor()), spec.cutter_radius());
    let fits_without = left + spec.leave[0] > cutter;
    (spec.leave[0] > 0.0 && left <= cutter && fits_without).then(|| {
        let most = left + spec.leave[0] - cutter;
        Finding::warning(
            Code::NOTHING_TO_MILL,
            format!(
                "{}: with the stock to leave it is not larger than the cutter; left out",
                operation.name()
            ),
        )
        .value_mm(spec.leave[0])
        .bound_mm(most)
        .cure(format!("leave less than {most:.3} mm, or use a smaller cutter"))
    })
}

/// What the control must offer for a wear register, and the value to simulate with.
fn wear(job: &Job, bore: &BoreOperation, spec: &mut BoreSpec) -> Result<()> {
    let Some(f) = &bore.table.finish else { return Ok(()) };
    let Some(wear) = spec.finish.and_then(|f| f.wear) else {
        if f.wear_value.is_some() || f.wear_largest.is_some() {
            return Err(Finding::error(Code::JOB_SHAPE, "a value of the wear register needs the register")
                .cure("add wear_offset = \"D2\"")
                .key("wear_value")
                .into());
        }
        return Ok(());
    };
    let value = f.wear_value.unwrap_or(0.0);
    if !(value.abs() <= wear.largest) {
        return Err(Finding::error(Code::JOB_VALUE, "the wear exceeds what the pass is planned for")
            .value_mm(value)
            .bound_mm(wear.largest)
            .cure("raise `wear_largest`, or finish with another cutter")
            .key("wear_value")
            .into());
    }
    let (control, tool) = (job.post.control, bore.milling.tool.number);
    if !control.has_compensation() {
        return Err(Finding::error(
            Code::POST_CONTROL,
            format!("{} has no cutter compensation", control.title()),
        )
        .cure("leave out `wear_offset`")
        .key("wear_offset")
        .into());
    }
    if wear.register == control.length_register(tool) {
        return Err(Finding::error(
            Code::JOB_VALUE,
            format!("the register D{} is that of {tool} itself and may hold its whole radius", wear.register),
        )
        .cure(format!("use a register of its own that holds the wear only: D{}", control.wear_register(tool)))
        .key("wear_offset")
        .into());
    }
    Ok(())
}

/// The pocket operation in the planner's words.
fn ellipse_spec(setup: &JobSetup, pocket: &EllipseOperation) -> EllipseSpec {
    let t = &pocket.table;
    let rough = rough(&t.rough);
    EllipseSpec {
        half_axes: t.half_axes,
        turned: t.angle.to_radians(),
        order: order(t.contact),
        bore: BoreSpec {
            centre: t.at,
            top: t.top,
            breakthrough: (t.breakthrough > 0.0).then_some(t.breakthrough),
            leave: [t.leave, t.leave_floor],
            sense: sense(t.direction),
            start: drilled(&t.entry)
                .map_or(RoughStart::Centre, |diameter| RoughStart::PreDrilled { diameter }),
            entry: entry(&t.entry),
            rough: Some(rough),
            finish: t.finish.as_ref().map(|f| Finish {
                spring_passes: f.spring_passes,
                axial_step: f.axial_step,
                ..Finish::new(per_second(f.feed))
            }),
            retract_z: setup.safe_height,
            approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, setup.safe_height),
            ..BoreSpec::new(2.0 * t.half_axes[0].min(t.half_axes[1]), t.depth, cutter(&pocket.milling.tool))
        },
    }
}

fn cutter(tool: &Tool) -> CutterData {
    CutterData {
        diameter: tool.cutter.diameter(tool.flute_length),
        flute_length: tool.flute_length,
        centre_cutting: tool.centre_cutting,
        max_ramp_angle: tool.max_ramp_angle,
    }
}

fn entry(table: &Option<EntryTable>) -> Entry {
    match table {
        Some(EntryTable::Plunge) => Entry::Plunge,
        Some(EntryTable::Helix(h)) => Entry::Helix { radius: h.radius, pitch: h.pitch },
        Some(EntryTable::PreDrilled(_)) => Entry::PreDrilled,
        None => Entry::Automatic,
    }
}

fn drilled(table: &Option<EntryTable>) -> Option<f64> {
    if let Some(EntryTable::PreDrilled(d)) = table { Some(d.diameter) } else { None }
}

fn rough(r: &RoughTable) -> Rough {
    Rough {
        engagement: r.engagement.map(f64::to_radians),
        allowance: r.allowance,
        plunge_feed: per_second(r.plunge_feed.unwrap_or(r.feed / 4.0)),
        axial_step: r.axial_step,
        ..Rough::new(r.step, per_second(r.feed))
    }
}

fn sense(direction: Direction) -> Sense {
    match direction {
        Direction::Climb => Sense::Climb,
        Direction::Conventional => Sense::Conventional,
    }
}

fn order(contact: ContactName) -> LensOrder {
    match contact {
        ContactName::G2 => LensOrder::Zero,
        ContactName::G4 => LensOrder::One,
        ContactName::G6 => LensOrder::Two,
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
    let from_centre = |p: [f64; 2]| [p[0] - t.at[0], p[1] - t.at[1]];
    let point = t.rough.as_ref().and_then(|r| r.start).map(from_centre);
    let mut spec = BoreSpec {
        centre: t.at,
        top: t.top,
        breakthrough: (t.breakthrough > 0.0).then_some(t.breakthrough),
        bottom_diameter: t.bottom_diameter,
        leave: [t.leave, t.leave_floor],
        sense: sense(t.direction),
        start: match (drilled(&t.entry), point) {
            (Some(diameter), None) => RoughStart::PreDrilled { diameter },
            (_, Some(point)) => RoughStart::Point(point),
            (None, None) => RoughStart::Centre,
        },
        entry: entry(&t.entry),
        rough: t.rough.as_ref().map(rough),
        retract_z: setup.safe_height,
        approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, setup.safe_height),
        resolution: (job.post.control.has_involute() && job.post.involute_native && job.post.arcs)
            .then(|| job.post.resolution.unwrap_or(job.post.control.resolution(job.post.decimals))),
        ..BoreSpec::new(t.diameter, t.depth, cutter(&bore.milling.tool))
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
        lead: order(f.contact),
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
