//! Cutting the stock along the traces, what is measured in it between two cuts, and what goes wrong on the way.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use glam::DVec3;

use super::budget::Budget;
use super::check::Job;
use super::closer::{Story, look_closer};
use super::contacts::machine::MachineContacts;
use super::contacts::{fixtures, machine, stock_at};
use super::engagement;
use super::engagement::Engagement;
use super::look::{Look, Looks, looks};
use super::missed::Missed;
use super::part_surface::PartSurface;
use super::playback::{self, PlayedStock};
use super::raw::{drill, off_axis, raw_stock, take_out};
use super::uncertain::{self, UncertainStock};
use crate::base::{Code, Finding, Progress, Result, Severity};
use crate::contact::Meeting;
use crate::geom::Solid;
use crate::operations::measured::{Loose, Probe, WallProbe};
use crate::stock::certify::{Certificate, CertifiedRun, certify};
use crate::stock::cut::{CutAxis, CutList, CutMove, CutOptions, MoveEffect, Stance, ToolBody, cut_list};
use crate::stock::surface::{CutSurface, SurfaceOptions, surface_with_cuts};
use crate::stock::{PointEngagement, TriDexel, Volume, WallEnd, point_engagement, wall_ends};
use crate::sweep::ToolMotion;
use crate::tool::{Cutter, DrillPoint, Tool, ToolNumber};
use crate::trace::{Segment, SegmentPace, Trace};

/// The stock after all setups, and what each segment did to it.
#[derive(Debug)]
pub struct Simulation {
    /// Memory that was known to be needed before anything was cut.
    pub budget: Budget,
    /// The cut stock.
    pub stock: TriDexel,
    /// Volume of the raw stock by its lines along Z [mm^3], as [`TriDexel::volume`] counts it: to compare what lines hold
    /// before and after.
    pub raw_volume: f64,
    /// Volume of the raw stock.
    pub raw: Volume,
    /// Sizes of features that may lie between the lines undetected.
    pub missed: Missed,
    /// For each setup, the effect of each segment of its trace.
    pub effects: Vec<Vec<MoveEffect>>,
    /// For each setup, the number of cuts before it: segment `i` is cut `first_cut + i + 1`.
    pub first_cut: Vec<u32>,
    /// Largest distance of the path that was cut from the exact one [mm].
    pub path_error: f64,
    /// Engagement found by each probe, in their order.
    pub engagements: Vec<PointEngagement>,
    /// The walls of the stock before each measured face is milled, in the order of the faces.
    pub walls: Vec<Vec<WallEnd>>,
    /// For each setup, what rules have asked of the stock.
    pub looks: Vec<Looks>,
    /// For each setup, tools that meet clamps and fixtures, or pass them closely.
    pub meetings: Vec<Vec<Meeting>>,
    /// For each setup, the bodies of the machine along its program; nothing where the machine has no bodies.
    pub machine: Vec<Option<MachineContacts>>,
    /// The proof of the cut stock against the moves, if the job asks for it.
    pub certificate: Option<Certificate>,
    /// Engagement of the tools, where it was measured.
    pub engagement: Option<Engagement>,
    /// Contacts with the stock that are possible where something is off, if the job says by how much it may be.
    pub uncertain: Option<UncertainStock>,
    /// The stock over time, where it is wanted for the report.
    pub playback: Option<PlayedStock>,
}

/// Cuts the stock of a job along the trace of each setup's program; `loose` are the cores that are taken out in each,
/// `probes` and `faces` what is measured on the way. At one item a core is taken out first, then it is measured, then cut.
///
/// # Errors
/// `KC0105` when the run would need more memory than the job allows; `KC0703` when a probe or a measured face does not
/// lie along an axis of the part; `KC0801` for a probe of a setup that is not there; errors of the tools' profiles.
pub fn simulate(
    job: &Job,
    traces: &[&Trace],
    loose: &[Vec<Loose>],
    probes: &[Probe],
    faces: &[WallProbe],
    progress: &dyn Progress,
) -> Result<Simulation> {
    let budget = Budget::new(job, traces);
    budget.check(job)?;
    progress.note(&budget.told(job));
    progress.stage("stock", 1);
    let mut stock = raw_stock(&job.stock, job.step)?;
    drill(&mut stock, job)?;
    let raw_volume = stock.volume();
    let raw = if job.drilled.is_empty() {
        Volume::of_solid(&job.stock)
    } else {
        let surface = match job.part_surface {
            PartSurface::Full => {
                Some(surface(&stock, &budget.surface_options(job, &stock), &crate::base::Silent)?)
            }
            PartSurface::Picture | PartSurface::None => None,
        };
        left(job, &stock, surface.as_ref())
    };
    let bodies = job.tools.iter().map(body).collect::<Result<Vec<_>>>()?;
    let mut simulation = Simulation {
        budget,
        stock,
        raw_volume,
        raw,
        missed: Missed::between(job.step),
        effects: Vec::new(),
        first_cut: Vec::new(),
        path_error: 0.0,
        engagements: Vec::new(),
        walls: vec![Vec::new(); faces.len()],
        looks: Vec::new(),
        meetings: Vec::new(),
        machine: Vec::new(),
        certificate: None,
        engagement: None,
        uncertain: None,
        playback: None,
    };
    let mut measured: Vec<Option<PointEngagement>> = probes.iter().map(|_| None).collect();
    // Cuts are numbered: drilled holes, cores taken out, then the segments.
    let mut taken = job.drilled.len() as u32;
    let mut first = taken + loose.iter().map(|l| l.len() as u32).sum::<u32>();
    let mut all = Vec::new();
    for &trace in traces {
        let options = CutOptions { first_cut: first, ..CutOptions::default() };
        all.push(CutList::new(&bodies, moves(job, trace)?, &options, job.step)?);
        simulation.first_cut.push(first);
        first += trace.segments.len() as u32;
    }
    for (i, (&trace, list)) in traces.iter().zip(&all).enumerate() {
        let count = list.moves().len();
        progress.stage("cut", count as u64);
        let mut effects = Vec::new();
        let mut done = 0;
        let cores = loose.get(i).map_or(&[][..], Vec::as_slice);
        let mut looked = Looks::default();
        for (item, pause) in pauses(cores, probes, faces, &looks(job, trace), i) {
            let to = trace.segments.partition_point(|s| s.item < item);
            // Pauses before the same segment share it.
            if to > done {
                append(&mut effects, cut_list(&mut simulation.stock, list, done..to, progress)?);
                done = to;
            }
            match pause {
                Pause::Core(core) => {
                    take_out(&mut simulation.stock, core, taken)?;
                    taken += 1;
                }
                Pause::Probe(p) => {
                    let probe = &probes[p];
                    simulation.stock.settle_along(progress);
                    let axis = CutAxis::of(probe.out).ok_or_else(off_axis)?;
                    measured[p] = Some(point_engagement(&simulation.stock, &probe.edge, probe.at, axis));
                }
                Pause::Face(f) => {
                    simulation.stock.settle_along(progress);
                    let axis = CutAxis::of(faces[f].out).ok_or_else(off_axis)?;
                    simulation.walls[f] = wall_ends(&simulation.stock, axis, faces[f].height).1;
                }
                Pause::Look(look) => {
                    looked.answer(look, (job, trace), &bodies, &mut simulation.stock);
                }
            }
        }
        append(&mut effects, cut_list(&mut simulation.stock, list, done..count, progress)?);
        simulation.path_error =
            effects.iter().fold(simulation.path_error, |worst, e| worst.max(e.path_error));
        simulation.effects.push(effects);
        simulation.looks.push(looked);
        let setup = &job.setups[i].setup;
        simulation.meetings.push(fixtures::contacts(job, setup, trace, progress)?);
        simulation.machine.push(machine::contacts(job, setup, trace, progress)?);
    }
    let story = Story { job, traces, loose, moves: &all, bodies: &bodies };
    look_closer(&story, &mut simulation.effects, progress)?;
    stock_at::settle(&story, &mut simulation.machine, progress)?;
    let gone = || simulation.raw_volume - simulation.stock.volume();
    simulation.engagement = engagement::measure(&story, gone, progress)?;
    simulation.uncertain = uncertain::look(&story, progress)?;
    simulation.playback = playback::play(&story, progress)?;
    if job.certified {
        let runs = simulation.first_cut.iter().zip(&all);
        let runs: Vec<_> =
            runs.map(|(first, list)| CertifiedRun { first_cut: *first, moves: list.moves() }).collect();
        simulation.certificate = Some(certify(&mut simulation.stock, &bodies, &runs, progress)?);
    }
    simulation.engagements = measured.into_iter().enumerate().map(found).collect::<Result<_>>()?;
    Ok(simulation)
}

/// Appends to a list that is mostly empty: then it is the other one.
fn append<T>(all: &mut Vec<T>, more: Vec<T>) {
    if all.is_empty() {
        *all = more;
    } else {
        all.extend(more);
    }
}

/// The surface of a stock of a job.
///
/// # Errors
/// `KC0105` at `simulate.mesh_tolerance` when that does not suffice; `KC0009` when cancelled.
pub(super) fn surface(
    stock: &TriDexel,
    options: &SurfaceOptions,
    progress: &dyn Progress,
) -> Result<CutSurface> {
    surface_with_cuts(stock, options, progress).map_err(|e| match e.code() {
        Code::JOB_BUDGET => e.under("simulate.mesh_tolerance"),
        _ => e,
    })
}

/// Volume of a stock of a job, from its lines or its surface: whichever has the lesser bound.
pub(super) fn left(job: &Job, stock: &TriDexel, surface: Option<&CutSurface>) -> Volume {
    let by_lines = Volume::of_lines(stock);
    let is_box = matches!(job.stock, Solid::Box(_));
    let by_surface = surface.map(|s| Volume::of_surface(s, &job.surface, stock, is_box));
    by_surface.filter(|v| v.bound < by_lines.bound).unwrap_or(by_lines)
}

/// Action on the stock between two cuts.
enum Pause<'a> {
    Core(&'a Loose),
    /// Index of the probe.
    Probe(usize),
    /// Index of the face.
    Face(usize),
    /// A question of a rule.
    Look(Look),
}

/// The pauses of a setup by the item that they precede: in order, and at one item cores first.
fn pauses<'a>(
    cores: &'a [Loose],
    probes: &[Probe],
    faces: &[WallProbe],
    looks: &[(u32, Look)],
    setup: usize,
) -> Vec<(u32, Pause<'a>)> {
    let cores = cores.iter().map(|c| (c.item, Pause::Core(c)));
    let probes = probes.iter().enumerate().filter(|(_, p)| p.setup == setup);
    let faces = faces.iter().enumerate().filter(|(_, f)| f.setup == setup);
    let faces = faces.map(|(i, f)| (f.item, Pause::Face(i)));
    let looks = looks.iter().map(|(item, look)| (*item, Pause::Look(*look)));
    let probes = probes.map(|(i, p)| (p.item, Pause::Probe(i)));
    let mut list: Vec<_> = cores.chain(probes).chain(faces).chain(looks).collect();
    list.sort_by_key(|(item, _)| *item);
    list
}

/// Engagement found by a probe.
fn found((i, measured): (usize, Option<PointEngagement>)) -> Result<PointEngagement> {
    measured.ok_or_else(|| {
        Finding::error(Code::GEOMETRY, "a probe names a setup that is not there")
            .key(format!("probes[{i}].setup"))
            .into()
    })
}

fn body(tool: &Tool) -> Result<ToolBody> {
    Ok(ToolBody {
        cutting: tool.cutting_profile()?,
        edge: match &tool.cutter {
            Cutter::Drill { diameter, point } => Some(point.edge(*diameter)?),
            _ => None,
        },
        shank: tool.shank_profile()?.into_iter().collect(),
        holder: tool.holder_profiles()?,
    })
}

/// The moves of the segments of a setup, in their order.
fn moves(job: &Job, trace: &Trace) -> Result<Vec<CutMove>> {
    // Neighbours mostly have one axis.
    let mut last = (DVec3::NAN, None);
    let mut along = |axis: DVec3| {
        if axis != last.0 {
            last = (axis, CutAxis::of(axis));
        }
        last.1
    };
    let mut one = |s: &Segment| -> Result<CutMove> {
        let body = s.tool.and_then(|t| job.tools.iter().position(|x| x.number == t)).ok_or_else(|| {
            Finding::error(Code::NC_STATE, "the program moves before a tool is called")
                .help("call a tool first")
        })?;
        let stance = match along(s.axis).filter(|_| s.turning.is_none()) {
            Some(axis) => Stance::Along(axis),
            None => Stance::Leaning(Arc::new(ToolMotion::of_segment(s)?)),
        };
        // A way that the machine only may take is looked at, not cut; so is where a contact would be a finding.
        let watch = s.alternative || s.motion == SegmentPace::Rapid || !s.spindle_on;
        Ok(CutMove { curve: s.curve.clone(), stance, body: body as u32, removes: !s.alternative, watch })
    };
    let mut moves = Vec::with_capacity(trace.segments.len());
    for segment in &trace.segments {
        moves.push(one(segment)?);
    }
    Ok(moves)
}

/// Whether a tool has a nose that does not cut.
fn blunt(number: Option<ToolNumber>, tools: &[Tool]) -> bool {
    let tool = number.and_then(|n| tools.iter().find(|t| t.number == n));
    tool.is_some_and(|t| matches!(t.cutter.point(), DrillPoint::Cone { .. }))
}

/// Faults of the segments of one setup's program: one finding for each code and item, at its worst segment. `place` gives
/// the item's place.
pub(super) fn findings(
    trace: &Trace,
    effects: &[MoveEffect],
    tools: &[Tool],
    place: impl Fn(u32) -> Option<crate::base::Location>,
) -> Vec<Finding> {
    faults(trace, effects, tools).into_iter().map(|(item, f)| Finding { place: place(item), ..f }).collect()
}

/// The same with the item of each.
pub(super) fn faults(trace: &Trace, effects: &[MoveEffect], tools: &[Tool]) -> Vec<(u32, Finding)> {
    let mut found: Vec<(u32, f64, Finding)> = Vec::new();
    let mut known: HashMap<(u32, Code), usize> = HashMap::new();
    let mut add = |item: u32, weight: f64, finding: Finding| match known.entry((item, finding.code)) {
        Entry::Vacant(new) => {
            new.insert(found.len());
            found.push((item, weight, finding));
        }
        Entry::Occupied(old) => {
            let entry = &mut found[*old.get()];
            if weight > entry.1 {
                *entry = (item, weight, finding);
            }
        }
    };
    for (segment, effect) in trace.segments.iter().zip(effects) {
        let item = segment.item;
        if let Some(point) = effect.first_contact {
            let rapid = segment.motion == SegmentPace::Rapid;
            let way = if segment.alternative { " when the axes run one by one" } else { "" };
            if rapid {
                let (code, what, help) = match segment.turning {
                    Some(_) => (
                        Code::TURNED_INTO_STOCK,
                        "the tool turns through stock at rapid",
                        "retract the tool before the rotary axes turn",
                    ),
                    None => (
                        Code::RAPID_IN_STOCK,
                        "a rapid move goes through stock",
                        "lift the tool above the stock first, or come in at feed",
                    ),
                };
                let finding = Finding::error(code, format!("{what}{way}"))
                    .value(effect.overlap(), "mm deep")
                    .point(point)
                    .help(help);
                add(item, effect.overlap(), finding);
            } else if !segment.spindle_on {
                let finding =
                    Finding::error(Code::SPINDLE_OFF, "the tool cuts while the spindle stands still")
                        .value(effect.overlap(), "mm deep")
                        .point(point)
                        .help("start the spindle before the cut");
                add(item, effect.overlap(), finding);
            }
        }
        if let Some(core) = effect.core()
            && blunt(segment.tool, tools)
        {
            let finding =
                Finding::error(Code::NOSE_IN_STOCK, "the nose of the tool, which does not cut, meets stock")
                    .value(core.overlap(), "mm deep")
                    .point(core.point)
                    .help("drill the hole first, or give the stock the hole it has");
            add(item, core.overlap(), finding);
        }
        if effect.as_filled {
            let finding =
                Finding::error(Code::DRILL_SIDEWAYS, "a drill that leaves a core or a nub cuts sideways")
                    .value(effect.overlap(), "mm deep")
                    .help("retract the drill along its axis before it moves on");
            add(item, effect.overlap(), finding);
        }
        for (contact, code, what, help) in [
            (
                effect.shank(),
                Code::SHANK_IN_STOCK,
                "the shank meets stock",
                "use longer flutes or a thinner shank, or cut in more levels",
            ),
            (
                effect.holder(),
                Code::HOLDER_IN_STOCK,
                "the holder meets stock",
                "use more stickout or a slimmer holder",
            ),
        ] {
            if let Some(contact) = contact {
                let finding = Finding::error(code, what)
                    .value(contact.overlap(), "mm deep")
                    .point(contact.point)
                    .help(help);
                add(item, contact.overlap(), finding);
            }
        }
    }
    found
        .into_iter()
        .map(|(item, _, f)| {
            debug_assert_eq!(f.severity, Severity::Error);
            (item, f)
        })
        .collect()
}
