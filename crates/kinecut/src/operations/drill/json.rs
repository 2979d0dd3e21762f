//! SetupPlan holes as JSON: lengths in mm, Z in the frame that its name says, speeds in rev/min, feeds in
//! mm/rev, times in s.

use serde::Serialize;

use super::{DrilledHole, LoadCurve, PlannedHole};
use crate::base::Finding;
use crate::drilling::{DrillPlan, PaperResult, Zone, ZoneStage};

/// A hole.
#[derive(Debug, Serialize)]
pub(crate) struct HoleJson {
    number: usize,
    at: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Finding>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    plan: Option<PlanJson>,
}

#[derive(Debug, Serialize)]
struct PlanJson {
    zero: f64,
    lengths: LengthsJson,
    coordinates: CoordinatesJson,
    zones: Vec<ZoneJson>,
    spindle_speed: f64,
    time: f64,
    constant_feed: f64,
    constant_feed_time: f64,
    saved_time: f64,
    first_contact_radius: f64,
    last_contact_radius: f64,
    lip_eccentricity: Option<f64>,
    lip_difference: f64,
    findings: Vec<Finding>,
    #[serde(skip_serializing_if = "Option::is_none")]
    load: Option<LoadCurve>,
    #[serde(skip_serializing_if = "Option::is_none")]
    paper: Option<PaperJson>,
}

#[allow(non_snake_case, reason = "the paper's symbols are the names")]
#[derive(Debug, Serialize)]
struct LengthsJson {
    L_vr1: f64,
    L_vr2: f64,
    L_vyh1: f64,
    L_vyh2: Option<f64>,
    L_nvr: f64,
    L_kvyh: Option<f64>,
    L_vr: f64,
    L_ust: f64,
    L_vyh: Option<f64>,
    L_rx: f64,
}

#[allow(non_snake_case, reason = "the paper's symbols are the names")]
#[derive(Debug, Serialize)]
struct CoordinatesJson {
    Z_nvr1: f64,
    Z_nvr2: f64,
    Z_kvyh1: Option<f64>,
    Z_kvyh2: Option<f64>,
    Z_nvyh1: Option<f64>,
    Z_nvyh2: Option<f64>,
    Z_end: f64,
    best_zero_h: Option<f64>,
    best_zero_k: Option<f64>,
}

#[derive(Debug, Serialize)]
struct ZoneJson {
    stage: &'static str,
    from: f64,
    to: f64,
    from_exit_frame: f64,
    to_exit_frame: f64,
    feed: f64,
    feed_from: &'static str,
    revolutions: f64,
    time: f64,
}

#[allow(non_snake_case, reason = "the paper's symbols are the names")]
#[derive(Debug, Serialize)]
struct PaperJson {
    lengths: LengthsJson,
    coordinates: CoordinatesJson,
    times: [f64; 3],
    L_vr1_as_printed: Option<f64>,
    printed_lengths: std::collections::BTreeMap<&'static str, f64>,
    printed_times: [f64; 4],
}

/// A planned hole; with what the paper's formulas give, and with the load along the way, where asked for.
pub(crate) fn hole_json(hole: &PlannedHole, with_paper: bool, with_load: bool) -> HoleJson {
    let plan = Some(plan_json(hole, with_paper, with_load));
    HoleJson { number: hole.number, at: hole.at, error: None, plan }
}

/// A hole that cannot be drilled.
pub(crate) fn refused_json(number: usize, at: [f64; 2], error: Finding) -> HoleJson {
    HoleJson { number, at, error: Some(error), plan: None }
}

fn plan_json(hole: &PlannedHole, with_paper: bool, with_load: bool) -> PlanJson {
    let p = &hole.plan;
    PlanJson {
        zero: hole.zero,
        lengths: lengths(&p.lengths),
        coordinates: coordinates(&p.coordinates),
        zones: p.zones.iter().map(|z| zone(z, hole)).collect(),
        spindle_speed: p.spindle * 60.0 / std::f64::consts::TAU,
        time: p.time,
        constant_feed: p.feeds.least(),
        constant_feed_time: p.constant_time,
        saved_time: p.constant_time - p.time,
        first_contact_radius: p.entry.first_radius,
        last_contact_radius: p.entry.last_radius,
        lip_eccentricity: Some(p.balance.eccentricity).filter(|e| e.is_finite()),
        lip_difference: p.balance.difference,
        findings: p.findings.clone(),
        load: with_load.then(|| LoadCurve::of(&DrilledHole::new("", &hole.spec, p))),
        paper: if with_paper { hole.paper().map(|p| paper_json(&p)) } else { None },
    }
}

fn paper_json(p: &PaperResult) -> PaperJson {
    let names = crate::drilling::PRINTED_LENGTHS;
    PaperJson {
        lengths: lengths(&p.lengths),
        coordinates: coordinates(&p.coordinates),
        times: p.times,
        L_vr1_as_printed: p.point_as_printed,
        printed_lengths: names.into_iter().zip(p.printed.lengths).collect(),
        printed_times: p.printed.times,
    }
}

fn lengths(l: &crate::drilling::Lengths) -> LengthsJson {
    LengthsJson {
        L_vr1: l.point,
        L_vr2: l.entry_surface,
        L_vyh1: l.point,
        L_vyh2: l.exit_surface,
        L_nvr: l.to_entry,
        L_kvyh: l.to_exit,
        L_vr: l.entry,
        L_ust: l.steady,
        L_vyh: l.exit,
        L_rx: l.stroke,
    }
}

fn coordinates(c: &crate::drilling::Coordinates) -> CoordinatesJson {
    CoordinatesJson {
        Z_nvr1: c.entry[0],
        Z_nvr2: c.entry[1],
        Z_kvyh1: c.exit_own.map(|z| z[0]),
        Z_kvyh2: c.exit_own.map(|z| z[1]),
        Z_nvyh1: c.exit.map(|z| z[0]),
        Z_nvyh2: c.exit.map(|z| z[1]),
        Z_end: c.end,
        best_zero_h: c.best_zeros[0],
        best_zero_k: c.best_zeros[1],
    }
}

/// Source of a stage's feed.
fn source(stage: ZoneStage, plan: &DrillPlan) -> &'static str {
    let [entry, steady, exit] = plan.feed_sources;
    match stage {
        ZoneStage::Entry => entry,
        ZoneStage::Exit => exit,
        ZoneStage::Steady | ZoneStage::Air => steady,
        ZoneStage::Mixed if plan.feeds.entry < plan.feeds.exit => entry,
        ZoneStage::Mixed => exit,
        ZoneStage::Partial if plan.feeds.entry < plan.feeds.steady => entry,
        ZoneStage::Partial => steady,
    }
}

fn zone(z: &Zone, hole: &PlannedHole) -> ZoneJson {
    ZoneJson {
        stage: z.stage.word(),
        from: z.from,
        to: z.to,
        from_exit_frame: z.from + hole.spec.length,
        to_exit_frame: z.to + hole.spec.length,
        feed: z.feed,
        feed_from: source(z.stage, &hole.plan),
        revolutions: z.revolutions(),
        time: z.time(hole.plan.spindle),
    }
}
