//! Cutting the stock along the traces, and what goes wrong on the way.

use glam::DVec3;

use super::check::Job;
use crate::base::{Code, Finding, Progress, Result, Severity};
use crate::geom::{Curve, Line, Profile, Solid};
use crate::stock::{CutMove, CutOptions, MoveEffect, ToolAxis, ToolBody, TriDexel, cut};
use crate::tool::Tool;
use crate::trace::{Motion, Trace};

/// The stock after all setups, and what each segment did to it.
#[derive(Debug)]
pub struct Simulation {
    /// The cut stock.
    pub stock: TriDexel,
    /// Volume of the raw stock [mm^3].
    pub raw_volume: f64,
    /// For each setup, the effect of each segment of its trace.
    pub effects: Vec<Vec<MoveEffect>>,
    /// For each setup, the cut identity of the first segment; later ones follow.
    pub first_cut: Vec<u32>,
    /// Tolerance with which curves were followed [mm].
    pub tolerance: f64,
}

/// Cuts the stock of a job along the trace of each setup's program.
///
/// # Errors
/// `KC0105` when the stock model would need more memory than the job allows; `KC0703` when a tool axis is not
/// along an axis of the part; errors of the tools' profiles.
pub fn simulate(job: &Job, traces: &[Trace], progress: &dyn Progress) -> Result<Simulation> {
    let bounds = job.stock.bounds();
    let bytes = TriDexel::memory(bounds, job.step);
    if bytes > job.memory {
        // Memory goes with the inverse square of the step.
        let fits = job.step * (bytes as f64 / job.memory as f64).sqrt();
        return Err(Finding::error(Code::JOB_BUDGET, "the stock model would need more memory than allowed")
            .value(bytes as f64 / 1e6, "MB")
            .bound(job.memory as f64 / 1e6, "MB")
            .cure(format!("set simulate.step to {:.3} or more, or raise simulate.memory", fits * 1.001))
            .key("simulate.step")
            .into());
    }
    progress.stage("stock", 1);
    let mut stock = match &job.stock {
        Solid::Box(b) => TriDexel::from_box(*b, job.step)?,
        Solid::Cylinder { base, radius, height } => TriDexel::from_cylinder(*base, *radius, *height, job.step)?,
        Solid::Mesh(mesh) => TriDexel::from_mesh(mesh, job.step)?,
    };
    let options = CutOptions::default();
    drill(&mut stock, job, &options)?;
    let raw_volume = stock.volume();
    let bodies = job.tools.iter().map(body).collect::<Result<Vec<_>>>()?;
    let mut simulation =
        Simulation { stock, raw_volume, effects: Vec::new(), first_cut: Vec::new(), tolerance: options.tolerance };
    let mut first = 1;
    for trace in traces {
        let moves = moves(job, trace)?;
        let options = CutOptions { first_cut: first, ..options.clone() };
        let effects = cut(&mut simulation.stock, &bodies, &moves, &options, progress)?;
        simulation.first_cut.push(first);
        first += moves.len() as u32;
        simulation.effects.push(effects);
    }
    Ok(simulation)
}

/// Takes the holes that the raw stock already has out of it; their surface counts as raw stock.
fn drill(stock: &mut TriDexel, job: &Job, options: &CutOptions) -> Result<()> {
    for hole in &job.drilled {
        let body = ToolBody { cutting: Profile::cylinder(hole.diameter, hole.height)?, shank: vec![], holder: vec![] };
        let down = Line { start: hole.base + DVec3::Z * hole.height, end: hole.base };
        let plunge = CutMove { curve: Curve::from(down), axis: ToolAxis::PlusZ, body: 0, rapid: false };
        let options = CutOptions { first_cut: 0, ..options.clone() };
        cut(stock, &[body], &[plunge], &options, &crate::base::Silent)?;
    }
    Ok(())
}

fn body(tool: &Tool) -> Result<ToolBody> {
    Ok(ToolBody {
        cutting: tool.cutting_profile()?,
        shank: tool.shank_profile()?.into_iter().collect(),
        holder: tool.holder_profiles()?,
    })
}

fn moves(job: &Job, trace: &Trace) -> Result<Vec<CutMove>> {
    let one = |s: &crate::trace::Segment| {
        let axis = ToolAxis::of(s.axis).ok_or_else(|| {
            Finding::error(Code::MACHINE_AXIS, "the tool axis does not run along an axis of the part")
                .cure("turn the part in steps of 90 degrees, or give the stock in a turned frame")
        })?;
        let body = s.tool.and_then(|t| job.tools.iter().position(|x| x.number == t)).ok_or_else(|| {
            Finding::error(Code::NC_STATE, "the program moves before a tool is called").cure("call a tool first")
        })?;
        Ok(CutMove { curve: s.curve, axis, body: body as u32, rapid: s.motion == Motion::Rapid })
    };
    trace.segments.iter().map(one).collect()
}

/// What the segments of one setup's program did that they should not: one finding for each code and item, at its
/// worst segment. `key` gives the item's place.
pub fn findings(trace: &Trace, effects: &[MoveEffect], place: impl Fn(u32) -> Option<crate::base::Location>) -> Vec<Finding> {
    let mut found: Vec<(u32, f64, Finding)> = Vec::new();
    let mut add = |item: u32, weight: f64, finding: Finding| {
        match found.iter_mut().find(|(i, _, f)| *i == item && f.code == finding.code) {
            Some(entry) if weight > entry.1 => *entry = (item, weight, finding),
            Some(_) => {}
            None => found.push((item, weight, finding)),
        }
    };
    for (segment, effect) in trace.segments.iter().zip(effects) {
        let item = segment.item;
        if let Some(point) = effect.first_contact {
            let rapid = segment.motion == Motion::Rapid;
            let way = if segment.alternative { " when the axes run one by one" } else { "" };
            if rapid {
                let finding = Finding::error(Code::RAPID_IN_STOCK, format!("a rapid move goes through stock{way}"))
                    .value(effect.removed, "mm3 removed")
                    .point(point)
                    .cure("lift the tool above the stock first, or come in at feed");
                add(item, effect.removed, finding);
            } else if !segment.spindle_on {
                let finding = Finding::error(Code::SPINDLE_OFF, "the tool cuts while the spindle stands still")
                    .value(effect.removed, "mm3 removed")
                    .point(point)
                    .cure("start the spindle before the cut");
                add(item, effect.removed, finding);
            }
        }
        for (contact, code, what, cure) in [
            (&effect.shank, Code::SHANK_IN_STOCK, "the shank meets stock", "use longer flutes or a thinner shank, or cut in more levels"),
            (&effect.holder, Code::HOLDER_IN_STOCK, "the holder meets stock", "use more stickout or a slimmer holder"),
        ] {
            if let Some(contact) = contact {
                let finding = Finding::error(code, what).value(contact.depth, "mm deep").point(contact.point).cure(cure);
                add(item, contact.depth, finding);
            }
        }
    }
    found
        .into_iter()
        .map(|(item, _, mut f)| {
            f.place = place(item);
            debug_assert_eq!(f.severity, Severity::Error);
            f
        })
        .collect()
}
