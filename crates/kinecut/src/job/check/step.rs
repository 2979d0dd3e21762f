//! The distance of the lines of the stock model, where the job does not say it.

use crate::base::Result;
use crate::base::bounded::length;
use crate::geom::Aabb;
use crate::operations::Drilled;
use crate::stock::TriDexel;
use crate::stock::surface::SurfaceOptions;
use crate::tool::Tool;

/// Lines of a stock model by default.
const LINES: f64 = 2e6;

/// The lines are brought so much nearer together for the sake of a thin tool, not more: the time goes with the square.
const MOST_FINER: f64 = 3.0;

/// Diameter of the thinnest tool or hole of the raw stock [mm].
pub(super) fn thinnest(tools: &[Tool], drilled: &[Drilled]) -> f64 {
    let widths = tools.iter().filter_map(|t| t.cutting_profile().ok().map(|p| 2.0 * p.max_radius()));
    widths.chain(drilled.iter().map(|d| d.diameter)).fold(f64::INFINITY, f64::min)
}

/// The step at which a box has about two million lines, or half the diameter of the thinnest tool or hole, if that
/// needs no more than nine times the lines, and with the surface half the memory [bytes].
pub(super) fn default_step(bounds: Aabb, thinnest: f64, memory: f64) -> f64 {
    let s = bounds.size();
    let step = ((s.x * s.y + s.y * s.z + s.z * s.x) / LINES).sqrt();
    // Two significant digits: a number that a person would choose.
    let magnitude = 10f64.powf(step.log10().floor() - 1.0);
    let usual = (step / magnitude).ceil() * magnitude;
    if thinnest >= 2.0 * usual {
        return usual;
    }
    // Tenths of the way back to the usual step until the memory suffices.
    let wanted = (0.5 * thinnest).max(usual / MOST_FINER);
    let tries = (0..10).map(|i| wanted + (usual - wanted) * f64::from(i) / 10.0);
    // Down to a tenth of that; a number that is one already stays.
    let rounded = |step: f64| (step / (0.1 * magnitude) + 1e-6).floor() * 0.1 * magnitude;
    let needed =
        |step: f64| TriDexel::memory(bounds, step).saturating_add(TriDexel::surface_memory(bounds, step));
    tries.map(rounded).find(|step| (needed(*step) as f64) < 0.5 * memory).unwrap_or(usual)
}

/// The fineness of the surface of a stock model with a step [mm]; `key` is where the tolerance is said.
///
/// # Errors
/// `KC0103` for a tolerance that is not positive, or larger than the step.
pub(in crate::job) fn surface(key: &str, tolerance: Option<f64>, step: f64) -> Result<SurfaceOptions> {
    if let Some(tolerance) = tolerance {
        length(key, tolerance, 1e-5, step)?;
    }
    Ok(SurfaceOptions { tolerance, ..SurfaceOptions::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thin_tools_bring_the_lines_nearer_together_within_the_memory() {
        let plate = Aabb { min: [0.0, 0.0, -20.0].into(), max: [600.0, 600.0, 0.0].into() };
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(near(default_step(plate, f64::INFINITY, 2e9), 0.44));
        assert!(near(default_step(plate, 0.9, 2e9), 0.44));
        assert!(near(default_step(plate, 0.6, 2e9), 0.3));
        // No more than three times as near, and no more than the memory holds.
        assert!(near(default_step(plate, 0.1, 4e9), 0.146));
        let tight = default_step(plate, 0.1, 6e8);
        assert!(tight > 0.2 && tight < 0.44, "{tight}");
        assert!((TriDexel::memory(plate, tight) as f64) < 3e8);
        assert!(near(default_step(plate, 0.1, 1e6), 0.44));
    }
}
