//! The distance of the lines of the stock model, where the job does not say it.

use crate::geom::Aabb;
use crate::stock::TriDexel;
use crate::tool::Tool;

use super::Drilled;

/// Lines of a stock model by default.
const LINES: f64 = 2e6;

/// The lines are brought so much nearer together for the sake of a thin tool, not more: the time goes with the square.
const MOST_FINER: f64 = 3.0;

/// The step at which a box has about two million lines, or half the diameter of the thinnest tool or hole, if that needs
/// no more than nine times the lines and half the memory [bytes].
pub(super) fn default_step(bounds: Aabb, tools: &[Tool], drilled: &[Drilled], memory: f64) -> f64 {
    let s = bounds.size();
    let step = ((s.x * s.y + s.y * s.z + s.z * s.x) / LINES).sqrt();
    // Two significant digits: a number that a person would choose.
    let magnitude = 10f64.powf(step.log10().floor() - 1.0);
    let usual = (step / magnitude).ceil() * magnitude;
    let widths = tools.iter().filter_map(|t| t.cutting_profile().ok().map(|p| 2.0 * p.max_radius()));
    let thinnest = widths.chain(drilled.iter().map(|d| d.diameter)).fold(f64::INFINITY, f64::min);
    if thinnest >= 2.0 * usual {
        return usual;
    }
    let finest = usual / MOST_FINER;
    // Tenths of the way back to the usual step until the memory suffices.
    let wanted = (0.5 * thinnest).max(finest);
    let tries = (0..10).map(|i| wanted + (usual - wanted) * f64::from(i) / 10.0);
    let fits = |step: &f64| (TriDexel::memory(bounds, *step) as f64) < 0.5 * memory;
    tries.map(|step| (step / (0.1 * magnitude)).floor() * 0.1 * magnitude).find(fits).unwrap_or(usual)
}
