//! The holes of a drilling operation, each with zones of its own.

use rayon::prelude::*;

use super::super::check::{DrillOperation, HolePlace, Job, JobSetup};
use super::super::file::{ExitTable, FaceTable};
use super::bodies::DrilledBody;
use super::surfaces::{across, bore, exit_face, face, pre_hole};
use crate::base::{Code, Error, Finding, Result, Severity};
use crate::drilling::{
    DrillPlan, DrillSpec, End, Face, FeedChoice, Method, Passage, PreHole, Side, Surface, Turning, plan_drill,
};

/// The holes of one operation.
#[derive(Clone, Debug)]
pub struct DrilledHoles {
    /// Number of the operation over all setups.
    pub operation: u32,
    /// The holes that can be drilled.
    pub holes: Vec<PlannedHole>,
}

/// A planned hole.
#[derive(Clone, Debug)]
pub struct PlannedHole {
    /// Its number in the operation, from 0.
    pub number: usize,
    /// X and Y, in coordinates of the work offset [mm].
    pub at: [f64; 2],
    /// Height of the entry's frame, in coordinates of the work offset [mm]: what is added to every Z of the plan.
    pub zero: f64,
    /// What was to be drilled.
    pub spec: DrillSpec,
    /// The plan.
    pub plan: DrillPlan,
    /// First item of the program that belongs to it.
    pub first_item: u32,
    /// First item of the program after it.
    pub next_item: u32,
    /// The faces of entry and exit, if the job gives them.
    pub faces: Option<[Option<Face>; 2]>,
}

/// Plans the holes; those that cannot be drilled come as findings.
///
/// # Errors
/// That of the first hole when none can be drilled.
pub(in crate::job) fn plan_holes(
    job: &Job,
    setup: &JobSetup,
    drill: &DrillOperation,
) -> Result<(Vec<PlannedHole>, Vec<Finding>)> {
    let mut holes = Vec::with_capacity(drill.holes.len());
    let mut failed: Vec<(usize, Error)> = Vec::new();
    for (number, hole) in plan_each(job, setup, drill)?.into_iter().enumerate() {
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
        Finding::new(code, severity, format!("the same at {count} further holes"))
    }));
    kept
}

/// Plans each hole for itself, on all cores; the answers are in the order of the holes.
///
/// # Errors
/// Those of the body.
pub(super) fn plan_each(
    job: &Job,
    setup: &JobSetup,
    drill: &DrillOperation,
) -> Result<Vec<Result<PlannedHole>>> {
    let clearance = drill.table.clearance.unwrap_or(setup.safe_height);
    let body = match drill.table.entry {
        Some(_) => None,
        None => Some(DrilledBody::new(job, setup, drill).map_err(|e| e.under("body"))?),
    };
    let one = |(number, place): (usize, &HolePlace)| {
        let hole = plan_hole(drill, body.as_ref(), number, place.at)?;
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
    Err(finding.cure("raise `clearance`, or the safe height of the setup").key("clearance").into())
}

fn plan_hole(
    drill: &DrillOperation,
    body: Option<&DrilledBody<'_>>,
    number: usize,
    at: [f64; 2],
) -> Result<PlannedHole> {
    let t = &drill.table;
    let length = t.length.unwrap_or(0.0);
    let diameter = drill.diameter();
    let surface =
        |face: &Face, side: Side, height: f64| face.surface(side, height).map_err(|e| e.under(side.word()));
    // Where the surfaces are turned counts only relative to the entry's direction.
    let turn = |table: Option<&FaceTable>| table.map_or(0.0, across);
    let base = turn(t.entry.as_ref());
    let (met, exit_turn) = match (&t.entry, body) {
        (Some(entry_table), _) => {
            let entry = face(entry_table, at);
            let exit = t.exit.as_ref().map(|e| exit_face(e, entry_table, at));
            let exit_table =
                if let Some(ExitTable::Face(table)) = &t.exit { Some(table) } else { t.entry.as_ref() };
            let top = surface(&entry, Side::Entry, 0.0)?;
            // A blind hole has no exit; the entry stands in its place and is not looked at.
            let bottom = exit.as_ref().map(|e| surface(e, Side::Exit, -length)).transpose()?;
            let met = Found {
                surfaces: [Some(top), bottom],
                faces: [Some(entry), exit],
                passages: None,
                pre_hole: None,
            };
            (met, turn(exit_table) - base)
        }
        (None, Some(body)) => {
            let edge = drill.point.edge(diameter)?;
            let met = body.meet(&edge, glam::DVec3::new(at[0], at[1], t.top))?;
            let faces = met.faces.map_or([None, None], |f| f.map(Some));
            let [entry, exit] = met.surfaces;
            let found = Found {
                surfaces: [Some(entry), Some(exit)],
                faces,
                passages: met.passages,
                pre_hole: met.pre_hole,
            };
            (found, 0.0)
        }
        (None, None) => {
            return Err(Finding::error(Code::DRILL_CASE, "the hole has no surfaces")
                .cure("give `entry`")
                .into());
        }
    };
    let [Some(entry), exit] = met.surfaces else {
        return Err(Finding::error(Code::DRILL_CASE, "the hole has no entry").into());
    };
    let end = match (t.depth, t.reach_diameter, t.tip, exit) {
        (Some(depth), ..) => End::FullDiameter(depth),
        (_, Some(reached), ..) => End::Reached(reached),
        (_, _, Some(tip), _) => End::Tip(tip - t.top),
        (.., Some(exit)) => End::Through { exit, overrun: t.overrun.unwrap_or_else(|| usual_overrun(drill)) },
        (.., None) => End::Tip(0.0),
    };
    let pre_hole = match &t.pre_hole {
        Some(table) => Some(pre_hole(table, t.top, base).map_err(|e| e.under("pre_hole"))?),
        None => met.pre_hole,
    };
    let spec = DrillSpec {
        method: drill.method,
        diameter,
        point: drill.point,
        entry,
        length,
        end,
        pre_hole,
        bores: t.cross_bores.iter().map(|b| bore(b, at, t.top, base)).collect(),
        exit_turn,
        passages: met.passages,
        approach: t.approach,
        tolerance: t.surface_tolerance,
        turning: Turning::Spindle(drill.milling.spindle),
        feed: FeedChoice {
            entry: t.feed_per_rev.entry,
            steady: t.feed_per_rev.steady,
            exit: t.feed_per_rev.exit,
        },
        guided: t.guided,
    };
    let plan = plan_drill(&spec)?;
    let faces = met.faces[0].is_some().then_some(met.faces);
    Ok(PlannedHole { number, at, zero: t.top, plan, spec, first_item: 0, next_item: 0, faces })
}

/// The surfaces of a hole, wherever they come from.
struct Found {
    surfaces: [Option<Surface>; 2],
    faces: [Option<Face>; 2],
    passages: Option<Vec<Passage>>,
    pre_hole: Option<PreHole>,
}

/// Way beyond the last of the edge [mm]: the paper's 2 mm; a reamer's land must follow.
fn usual_overrun(drill: &DrillOperation) -> f64 {
    const USUAL: f64 = 2.0;
    let quarter = drill.diameter() / 4.0;
    if drill.method == Method::Reaming && quarter > USUAL { quarter } else { USUAL }
}
