//! The passes of a hole for whoever draws them: their curves as the records of the paper, and their run on the machine.

use serde::Serialize;

use super::HoleTable;
use super::comparison::machine_terms;
use super::plan::HoleLimits;
use crate::base::Result;
use crate::geom::{Curve, PlaneCurve};
use crate::holes::compare::{Cut, PassPiece, PassRun, Terms, pass_run};
use crate::holes::{BorePlan, Entry, PassFigures, ToolpathPace, ToolpathRole};
use crate::num::angle::wrap_positive;
use crate::operations::bore::BoreOperation;

/// A curve of a pass: the record of the paper's tables, about the bore's centre.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HoleCurve {
    /// "line", "arc", "involute", or "spiral" for any other law.
    pub kind: &'static str,
    /// Length [mm].
    pub length: f64,
    /// Start [mm].
    pub start: [f64; 2],
    /// Tangent angle at the start [rad]: of a record with its turns, as in the paper's tables; of other laws from 0 to 2 pi.
    pub start_angle: f64,
    /// Radius of curvature at the start, positive to the left [mm]; none of a line.
    pub start_radius: Option<f64>,
    /// The same at the end.
    pub end_radius: Option<f64>,
    /// Base radius of an involute [mm]; zero for others.
    pub base_radius: f64,
    /// Centre of its base circle, or of an arc.
    pub base_centre: Option<[f64; 2]>,
}

/// Curves that are told of: a path of loops has thousands.
const CURVES: usize = 40;

pub(super) fn curves(pass: &PassFigures) -> Vec<HoleCurve> {
    pass.curves.iter().take(CURVES).map(hole_curve).collect()
}

fn hole_curve(curve: &PlaneCurve) -> HoleCurve {
    let jet = curve.at(0.0);
    let known = |radius: f64| radius.is_finite().then_some(radius);
    let (kind, radii, base) = match curve {
        PlaneCurve::Record(r) if r.is_line() => ("line", [None; 2], None),
        PlaneCurve::Record(r) => {
            let kind = if r.base_radius() == 0.0 { "arc" } else { "involute" };
            (kind, [known(r.start_radius()), known(r.end_radius())], Some(r))
        }
        PlaneCurve::Spiral(_) => {
            let end = curve.at(curve.length()).curvature;
            ("spiral", [known(1.0 / jet.curvature), known(1.0 / end)], None)
        }
    };
    HoleCurve {
        kind,
        length: curve.length(),
        start: curve.start().to_array(),
        start_angle: match curve {
            PlaneCurve::Record(_) => jet.angle,
            PlaneCurve::Spiral(_) => wrap_positive(jet.angle),
        },
        start_radius: radii[0],
        end_radius: radii[1],
        base_radius: base.map_or(0.0, |r| r.base_radius()),
        base_centre: base.map(|r| r.base_centre().to_array()),
    }
}

/// Roles of moves that a run has: all that cut in the plane, and what leads to and from it.
const CUTS: [ToolpathRole; 5] = [
    ToolpathRole::Rough,
    ToolpathRole::Circle,
    ToolpathRole::LeadIn,
    ToolpathRole::Finish,
    ToolpathRole::LeadOut,
];

/// Roles of the moves with which the curves of a pass begin.
const BEGINS: [ToolpathRole; 2] = [ToolpathRole::Rough, ToolpathRole::LeadIn];

/// Distance of two places that are the same [mm].
const SAME: f64 = 1e-6;

/// The last level of a pass as it is run; none where no move of it is in a plane.
pub(super) fn run(
    table: &HoleTable,
    bore: &BorePlan,
    of: &BoreOperation,
    finishing: bool,
) -> Result<(Option<PassRun>, HoleLimits)> {
    let pass = if finishing { &bore.finish } else { &bore.rough };
    let chosen = || bore.moves.iter().filter(|m| m.finishing == finishing && CUTS.contains(&m.role));
    let last = chosen().map(|m| m.level).max();
    let at = of.table.at;
    let mut pieces: Vec<PassPiece> = Vec::new();
    let (mut length, mut begins) = (0.0, None);
    for m in chosen().filter(|m| Some(m.level) == last) {
        let ToolpathPace::Feed(feed) = m.pace else { continue };
        // The foot of a helix, a circle, starts in the same place as the spiral.
        if begins.is_none() && BEGINS.contains(&m.role) && starts(pass.as_ref(), &m.curve, at) {
            begins = Some(length);
        }
        length += m.curve.length();
        pieces.push(PassPiece { curve: m.curve.clone(), feed });
    }
    let cutter = 0.5 * of.milling.tool.cutter.diameter(of.milling.tool.flute_length);
    let feed = pieces.first().map_or(1.0, |p| p.feed);
    let terms = machine_terms(table, Terms::new(of.table.diameter, cutter, cutter, feed))?;
    terms.limits.check()?;
    let limits = HoleLimits {
        rapid: terms.limits.axis_velocity * 60.0,
        acceleration: terms.limits.acceleration / 1000.0,
        jerk: terms.limits.jerk / 1000.0,
    };
    let (Some(pass), false) = (pass, pieces.is_empty()) else { return Ok((None, limits)) };
    let cut =
        begins.map(|from| Cut { curves: &pass.curves, from, open: open(bore, of, pass, finishing, cutter) });
    // A path that also goes down cuts less than its plane has.
    let cut = cut.filter(|_| finishing || of.table.strategy.clearing().is_some());
    Ok((Some(pass_run(&pieces, at, cut, &terms)?), limits))
}

/// Whether a move starts where the curves of a pass do.
fn starts(pass: Option<&PassFigures>, curve: &Curve, [x, y]: [f64; 2]) -> bool {
    let Some(first) = pass.and_then(|p| p.curves.first()) else { return false };
    let (p, start) = (curve.start(), first.start());
    (p.x - x - start.x).hypot(p.y - y - start.y) < SAME
}

/// Radius that is open before a pass cuts [mm].
fn open(
    bore: &BorePlan,
    of: &BoreOperation,
    pass: &PassFigures,
    finishing: bool,
    cutter: f64,
) -> Option<f64> {
    let drilled = match of.table.entry {
        Some(Entry::PreDrilled { diameter }) => Some(0.5 * diameter),
        _ => None,
    };
    let before = match (&bore.rough, finishing) {
        (Some(rough), true) => Some(rough.path_radius + cutter),
        // The entry circle is run in full.
        _ if pass.inner_radius > 0.0 && drilled.is_none() => Some(pass.inner_radius + cutter),
        _ => None,
    };
    before.into_iter().chain(drilled).reduce(f64::max)
}
