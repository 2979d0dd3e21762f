//! A surface with all that follows from its generating lines.

use std::collections::BTreeMap;

use serde::Serialize;

use super::SplitRow;
use crate::base::{Finding, Result};
use crate::machine::surface::{
    EnvelopeMethod, GeneratedSurface, GeneratingMethod, KnownProcess, MethodsRow, Sample, Split,
    arrangements, chain_text, envelopes_of, sliding_group, word,
};

/// Samples of each variable for the sliding group.
const SAMPLES: usize = 12;

/// Processes of a method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodProcesses {
    /// "tracing", "copying", "touching", "rolling".
    pub method: &'static str,
    /// Names, and motions in Fedotenok's notation.
    pub processes: Vec<(&'static str, &'static str)>,
}

/// A way to envelop a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EnvelopeRow {
    /// Name of the process.
    pub process: &'static str,
    /// "touching" or "rolling".
    pub method: &'static str,
    /// Chain of the machine.
    pub machine: &'static str,
    /// Chain of the tool.
    pub tool: &'static str,
    /// The contact: normal, velocity, their product, which vanishes, and its solution.
    pub contact: String,
}

fn processes(name: &str) -> Vec<MethodProcesses> {
    let Some(row) = MethodsRow::of(name) else { return Vec::new() };
    let all = [
        (GeneratingMethod::Tracing, row.tracing),
        (GeneratingMethod::Copying, row.copying),
        (GeneratingMethod::Touching, row.touching),
        (GeneratingMethod::Rolling, row.rolling),
    ];
    let some = all.into_iter().filter(|(_, processes)| !processes.is_empty());
    let one = |(method, processes): (GeneratingMethod, &[KnownProcess])| MethodProcesses {
        method: method.name(),
        processes: processes.iter().map(|p| (p.name, p.motions)).collect(),
    };
    some.map(one).collect()
}

fn envelope(envelope: &EnvelopeMethod) -> Result<EnvelopeRow> {
    Ok(EnvelopeRow {
        process: envelope.process,
        method: envelope.method.name(),
        machine: envelope.machine,
        tool: envelope.tool,
        contact: envelope.contact()?.text(&envelope.variables),
    })
}

/// A surface and how it can be made.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurfaceSheet {
    /// Short name.
    pub name: String,
    /// Name of the surface in words.
    pub title: String,
    /// Parameters [mm or rad].
    pub parameters: BTreeMap<String, f64>,
    /// Free variables with their domains [mm or rad].
    pub variables: Vec<(String, f64, f64)>,
    /// Chain of the directrix.
    pub directrix: String,
    /// Chain of the generatrix.
    pub generatrix: String,
    /// The primary chain: both, with what they share written once.
    pub chain: String,
    /// The function of the surface as a product of matrices.
    pub product: String,
    /// The matrices with their entries: four rows each.
    pub matrices: Vec<[String; 4]>,
    /// The product multiplied out: the point of the surface.
    pub point: String,
    /// The primary code.
    pub code: String,
    /// The code in its canonical order.
    pub canonical: String,
    /// Number of orders of the motions that make the same surface.
    pub orders: usize,
    /// Number of layouts of the primary code: orders times places of the bed.
    pub layouts: usize,
    /// Kind of surface by the motions that carry it in itself.
    pub form: &'static str,
    /// Those motions.
    pub slides: Vec<String>,
    /// Every redistribution of the motions between machine and tool.
    pub splits: Vec<SplitRow>,
    /// Known processes by the method of Fedotenok that makes one of the lines.
    pub processes: Vec<MethodProcesses>,
    /// Ways to envelop the surface by a tool that touches or rolls.
    pub envelopes: Vec<EnvelopeRow>,
    /// Places in which the surface folds over or shrinks to a point.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<Finding>,
    /// The surface itself.
    #[serde(skip)]
    pub surface: GeneratedSurface,
    /// The redistributions themselves.
    #[serde(skip)]
    pub found: Vec<Split>,
}

/// Everything about a surface.
///
/// # Errors
/// Those of [`GeneratedSurface::check`], of its splits and of the sliding group (`KC1104`, `KC1105`, `KC1109`).
pub fn surface_sheet(surface: &GeneratedSurface) -> Result<SurfaceSheet> {
    surface.check()?;
    let shape = surface.compiled()?;
    let [u, v] = &surface.variables;
    let mut samples = Vec::with_capacity(SAMPLES * SAMPLES);
    for i in 0..SAMPLES {
        for j in 0..SAMPLES {
            let fraction = |k: usize| (k as f64 + 0.5) / SAMPLES as f64;
            let (a, b) = (u.at(fraction(i)), v.at(fraction(j)));
            if let Some(normal) = shape.normal(a, b) {
                samples.push(Sample { point: shape.point(a, b), normal, weight: 1.0 });
            }
        }
    }
    let group = sliding_group(&samples, 0.0)?;
    let found = surface.splits()?;
    let code = surface.code();
    let formula = surface.formula();
    let orders = arrangements(&code).len();
    Ok(SurfaceSheet {
        name: surface.name.clone(),
        title: surface.title.clone(),
        parameters: surface.parameters.iter().cloned().collect(),
        variables: surface.variables.iter().map(|v| (v.name.clone(), v.from, v.to)).collect(),
        directrix: chain_text(&surface.directrix),
        generatrix: chain_text(&surface.generatrix),
        chain: chain_text(&surface.chain()),
        product: formula.product_text(),
        matrices: formula.matrices().iter().map(|m| m.rows_text()).collect(),
        point: formula.point_text(),
        canonical: word(&surface.canonical()).to_string(),
        orders,
        layouts: orders * (code.0.len() + 1),
        code: code.to_string(),
        form: group.form.name(),
        slides: group.slides.iter().map(ToString::to_string).collect(),
        splits: found.iter().map(|split| SplitRow::of(split, surface)).collect(),
        processes: processes(&surface.name),
        envelopes: envelopes_of(surface).map(envelope).collect::<Result<_>>()?,
        findings: surface.fold_findings()?,
        surface: surface.clone(),
        found,
    })
}
