//! The holes of a drilling operation, each with zones of its own.

use rayon::prelude::*;

use super::bodies::{DrilledBody, Met};
use super::surfaces::{across, bore, exit_face, face, pre_hole};
use super::there::{There, nothing_left};
use super::{DrillOperation, DrillTable, ExitTable, FaceTable};
use crate::base::{Code, Error, Finding, Result, Severity, manual};
use crate::drilling::{
    BoundarySurface, DrillMethod, DrillPlan, DrillSpec, End, PaperCase, PaperResult, PartFace, Passage,
    PreHole, Side, SpindleSpeed, paper, plan_drill,
};
use crate::operations::Setting;
use crate::operations::kind::Checked as _;
use crate::operations::places::HolePlace;

/// A planned hole.
#[derive(Clone, Debug)]
pub struct PlannedHole {
    /// Its number in the operation, from 0.
    pub number: usize,
    /// X and Y, in coordinates of the work offset [mm].
    pub at: [f64; 2],
    /// Height of the entry's frame, in coordinates of the work offset [mm]: what is added to every Z of the plan.
    pub zero: f64,
    /// Hole that was asked for.
    pub spec: DrillSpec,
    /// The plan.
    pub plan: DrillPlan,
    /// First item of the program that belongs to it.
    pub first_item: u32,
    /// First item of the program after it.
    pub next_item: u32,
    /// The faces of entry and exit, if the job gives them.
    pub faces: Option<[Option<PartFace>; 2]>,
}

/// Plans the holes; those that cannot be drilled come as findings.
///
/// # Errors
/// That of the first hole when none can be drilled.
pub(super) fn plan_holes(
    setting: &Setting<'_>,
    drill: &DrillOperation,
) -> Result<(Vec<PlannedHole>, Vec<Finding>)> {
    let mut holes = Vec::with_capacity(drill.holes.len());
    let mut failed: Vec<(usize, Error)> = Vec::new();
    for (number, hole) in plan_each(setting, drill)?.into_iter().enumerate() {
        match hole {
            Ok(hole) => holes.push(hole),
            Err(e) => failed.push((number, e)),
        }
    }
    if holes.is_empty() && !failed.is_empty() {
        return Err(failed.swap_remove(0).1);
    }
    let mut findings: Vec<Finding> =
        failed.into_iter().map(|(number, e)| of_hole(drill, number, *e.0)).collect();
    for hole in &holes {
        findings.extend(hole.plan.findings.iter().map(|f| of_hole(drill, hole.number, f.clone())));
    }
    Ok((holes, grouped(findings)))
}

/// A finding with the hole it belongs to.
fn of_hole(drill: &DrillOperation, number: usize, mut finding: Finding) -> Finding {
    if drill.holes.len() > 1 {
        let [x, y] = drill.holes[number].at;
        finding.message = format!("hole {} at X{x} Y{y}: {}", number + 1, finding.message);
    } else {
        finding.message = format!("{}: {}", drill.name(), finding.message);
    }
    if finding.key.is_none() && drill.table.points.is_some() {
        finding.key = Some(format!("points[{number}]"));
    }
    finding
}

/// Findings of one code beyond the first few are counted, not listed: a pattern has thousands of holes alike.
fn grouped(findings: Vec<Finding>) -> Vec<Finding> {
    const LISTED: usize = 5;
    let mut kept: Vec<Finding> = Vec::new();
    let mut more: Vec<(Code, Severity, usize)> = Vec::new();
    for f in findings {
        let alike = kept.iter().filter(|k| (k.code, k.severity) == (f.code, f.severity)).count();
        if alike < LISTED {
            kept.push(f);
        } else if let Some(m) = more.iter_mut().find(|m| (m.0, m.1) == (f.code, f.severity)) {
            m.2 += 1;
        } else {
            more.push((f.code, f.severity, 1));
        }
    }
    kept.extend(more.into_iter().map(|(code, severity, count)| {
        let title = manual().iter().find(|p| p.code == code).map_or("the same", |p| p.title);
        Finding::new(code, severity, format!("{title}, at {count} further holes"))
    }));
    kept
}

/// Plans each hole for itself, on all cores; the answers are in the order of the holes.
///
/// # Errors
/// Those of the body.
pub(crate) fn plan_each(setting: &Setting<'_>, drill: &DrillOperation) -> Result<Vec<Result<PlannedHole>>> {
    let clearance = drill.table.clearance.unwrap_or(setting.clamping.safe_height);
    let body = match drill.table.entry {
        Some(_) => None,
        None => Some(DrilledBody::new(setting, drill).map_err(|e| e.under("body"))?),
    };
    let one = |(number, place): (usize, &HolePlace)| {
        let hole = plan_hole(setting, drill, body.as_ref(), number, place.at)?;
        below(hole.plan.travel.start + hole.zero, clearance)?;
        Ok(hole)
    };
    Ok(drill.holes.par_iter().enumerate().map(one).collect())
}

/// A hole starts below the height of the moves between holes.
fn below(start: f64, clearance: f64) -> Result<()> {
    if start <= clearance {
        return Ok(());
    }
    let what = "the moves between holes run below the start of a hole";
    let finding = Finding::error(Code::DRILL_CASE, what).value_mm(clearance).bound_mm(start);
    Err(finding.help("raise `clearance`, or the safe height of the setup").key("clearance").into())
}

fn plan_hole(
    setting: &Setting<'_>,
    drill: &DrillOperation,
    body: Option<&DrilledBody<'_>>,
    number: usize,
    at: [f64; 2],
) -> Result<PlannedHole> {
    let t = &drill.table;
    let hole_there = |across: f64| {
        let made = t.pre_hole.as_ref().map(|table| pre_hole(table, t.top, across));
        made.transpose().map_err(|e| e.under("pre_hole"))
    };
    // Bodies are asked for the edge that cuts, which depends on the hole that is there.
    let surfaces = match (&t.entry, body) {
        (Some(entry), _) => given(drill, entry, at)?,
        (None, Some(body)) => {
            let edge = spec(drill, blind_end(t).unwrap_or(End::Tip(0.0)), hole_there(0.0)?).cutting_edge()?;
            let met = body.meet(&edge, glam::DVec3::new(at[0], at[1], t.top))?;
            let [entry, exit] = met.surfaces;
            let faces = met.faces.map_or([None, None], |f| f.map(Some));
            let Met { passages, there, across, .. } = met;
            Found { entry, exit: Some(exit), faces, passages, there, across, exit_turn: 0.0 }
        }
        (None, None) => {
            let finding = Finding::error(Code::DRILL_CASE, "the hole has no surfaces");
            return Err(finding.help("give `entry`").into());
        }
    };
    let end = match (blind_end(t), surfaces.exit) {
        (Some(end), _) => end,
        (None, Some(exit)) => {
            End::Through { exit, overrun: t.overrun.unwrap_or_else(|| usual_overrun(drill)) }
        }
        (None, None) => {
            let finding = Finding::error(Code::DRILL_CASE, "the hole has no end");
            return Err(finding.help("give `exit`, `depth`, `tip` or `reach_diameter`").into());
        }
    };
    let mouth = match surfaces.entry {
        BoundarySurface::Plane { height, slope: 0.0 } => {
            let point = glam::DVec3::new(at[0], at[1], t.top);
            let to_part = setting.clamping.to_work().inverse();
            setting.mouths.iter().rev().find_map(|mouth| mouth.seen(&to_part, point, height))
        }
        _ => None,
    };
    let There { opened, floor, ceiling } = surfaces.there;
    let stated = hole_there(surfaces.across)?;
    let is_plain = t.cross_bores.is_empty() && stated.as_ref().is_none_or(PreHole::leaves_annulus);
    let there = stated.or(opened);
    let level = matches!(surfaces.entry, BoundarySurface::Plane { slope: 0.0, .. });
    let floor = floor.filter(|_| level && t.cross_bores.is_empty());
    let spec = DrillSpec {
        entry: surfaces.entry,
        bores: t.cross_bores.iter().map(|b| bore(b, at, t.top, surfaces.across)).collect(),
        exit_turn: surfaces.exit_turn,
        passages: surfaces.passages,
        mouth: floor.or(mouth),
        ceiling: ceiling.filter(|_| is_plain),
        ..spec(drill, end, there)
    };
    let plan = plan_drill(&spec).map_err(|e| match &floor {
        // Its tip comes no deeper than the floor of a hole that is there.
        Some(floor) if e.0.key.as_deref() == Some("depth") => {
            let diameter = 2.0 * floor.edge.outer_radius();
            nothing_left(diameter, Some(floor.height + t.top)).key("depth").into()
        }
        _ => e,
    })?;
    let (spec, plan) = match surfaces.exit.filter(|_| t.entry.is_none()) {
        Some(exit) => coming_out(&spec, &plan, exit)?.unwrap_or((spec, plan)),
        None => (spec, plan),
    };
    let faces = surfaces.faces[0].is_some().then_some(surfaces.faces);
    Ok(PlannedHole { number, at, zero: t.top, plan, spec, first_item: 0, next_item: 0, faces })
}

/// A blind hole whose full diameter comes out of the body, as one that goes through, as deep.
///
/// # Errors
/// Those of the planner.
fn coming_out(
    spec: &DrillSpec,
    plan: &DrillPlan,
    exit: BoundarySurface,
) -> Result<Option<(DrillSpec, DrillPlan)>> {
    /// Height that is rounding [mm].
    const ROUNDING: f64 = 1e-9;
    let is_blind = matches!(spec.end, End::FullDiameter(_) | End::Tip(_));
    let tip = plan.travel.end;
    let is_above = match (exit, &spec.ceiling) {
        (_, Some(ceiling)) if ceiling.covers(&plan.edge) => tip > ceiling.height,
        (BoundarySurface::Plane { height, slope }, _) => tip > height + 0.5 * spec.diameter * slope.abs(),
        _ => false,
    };
    if !is_blind || is_above {
        return Ok(None);
    }
    let through = |overrun| DrillSpec { end: End::Through { exit, overrun }, ..spec.clone() };
    // Where it does not come out whole, it is planned as it is written.
    let Ok(out) = plan_drill(&through(0.0)) else { return Ok(None) };
    let beyond = out.travel.end - tip;
    if beyond < -ROUNDING {
        return Ok(None);
    }
    let spec = through(if beyond > 0.0 { beyond } else { 0.0 });
    let plan = plan_drill(&spec)?;
    Ok(Some((spec, plan)))
}

/// Hole to drill, without its surfaces.
fn spec(drill: &DrillOperation, end: End, pre_hole: Option<PreHole>) -> DrillSpec {
    let t = &drill.table;
    DrillSpec {
        method: drill.method,
        diameter: drill.diameter(),
        point: drill.milling.tool.cutter.point().clone(),
        entry: BoundarySurface::Plane { height: 0.0, slope: 0.0 },
        length: t.length.unwrap_or(0.0),
        end,
        pre_hole,
        mouth: None,
        ceiling: None,
        bores: Vec::new(),
        exit_turn: 0.0,
        passages: None,
        approach: t.approach,
        tolerance: t.surface_tolerance,
        turning: SpindleSpeed::Spindle(drill.milling.spindle),
        feed: drill.feed,
        guided: t.guided,
    }
}

/// End of a blind hole.
fn blind_end(t: &DrillTable) -> Option<End> {
    match (t.depth, t.reach_diameter, t.tip) {
        (Some(depth), ..) => Some(End::FullDiameter(depth)),
        (_, Some(reached), _) => Some(End::Reached(reached)),
        (_, _, Some(tip)) => Some(End::Tip(tip - t.top)),
        _ => None,
    }
}

/// The surfaces that the operation names.
fn given(drill: &DrillOperation, entry_table: &FaceTable, at: [f64; 2]) -> Result<Found> {
    let t = &drill.table;
    let surface = |face: &PartFace, side: Side, height: f64| {
        face.surface(side, height).map_err(|e| e.under(side.word()))
    };
    let entry = face(entry_table, at);
    let exit = t.exit.as_ref().map(|e| exit_face(e, entry_table, at));
    // The direction of the surfaces counts only relative to that of the entry.
    let exit_turn = match &t.exit {
        Some(ExitTable::Face(table)) => across(table) - across(entry_table),
        _ => 0.0,
    };
    let bottom = -t.length.unwrap_or(0.0);
    Ok(Found {
        entry: surface(&entry, Side::Entry, 0.0)?,
        exit: exit.as_ref().map(|e| surface(e, Side::Exit, bottom)).transpose()?,
        faces: [Some(entry), exit],
        passages: None,
        there: There::default(),
        across: across(entry_table),
        exit_turn,
    })
}

/// The surfaces of a hole, wherever they come from.
struct Found {
    entry: BoundarySurface,
    exit: Option<BoundarySurface>,
    faces: [Option<PartFace>; 2],
    passages: Option<Vec<Passage>>,
    there: There,
    /// Direction of the entry's u from X of the work offset [rad].
    across: f64,
    /// Angle of the exit's u from it [rad].
    exit_turn: f64,
}

/// Way beyond the last of the edge [mm]: the paper's 2 mm; a reamer's land must follow.
fn usual_overrun(drill: &DrillOperation) -> f64 {
    const USUAL: f64 = 2.0;
    let quarter = drill.diameter() / 4.0;
    if drill.method == DrillMethod::Reaming && quarter > USUAL { quarter } else { USUAL }
}

impl PlannedHole {
    /// Result of the paper's own formulas; `None` if it has none, or if the surfaces were found in a body.
    pub fn paper(&self) -> Option<PaperResult> {
        let [Some(entry), Some(exit)] = self.faces? else { return None };
        let is_plain = self.spec.pre_hole.is_none() && self.spec.ceiling.is_none();
        if !is_plain || !self.spec.bores.is_empty() {
            return None;
        }
        let End::Through { overrun, .. } = self.spec.end else { return None };
        paper(&PaperCase {
            point: self.spec.point.clone(),
            diameter: self.spec.diameter,
            entry,
            exit,
            length: self.spec.length,
            approach: self.spec.approach,
            overrun,
            spindle: self.plan.spindle,
            feeds: self.plan.feeds,
        })
    }
}
