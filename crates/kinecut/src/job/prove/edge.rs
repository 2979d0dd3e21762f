//! Edges of the stock that a tool passes with less room than the lines of the stock model can tell from an overlap.
//!
//! Walls and floors are met exactly however little a tool reaches into them. Only where it clips an edge, by less than a
//! step and not as wide as the diagonal of four lines, no line may see it: then nothing is proven.

use crate::base::{Code, Finding};
use crate::job::prove::Simulated;
use crate::job::simulate::{Missed, may_clip};
use crate::trace::Motion;

/// Doubts: for each block the widest overlap that may lie between the lines.
pub(super) fn edge(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found: Vec<(usize, u32, f64, Finding)> = Vec::new();
    for (setup, done) in simulated.setups.iter().enumerate() {
        for (segment, effect) in done.trace.segments.iter().zip(&simulated.simulation.effects[setup]) {
            let Some(edge) = may_clip(effect) else { continue };
            if found.last().is_some_and(|f| (f.0, f.1) == (setup, segment.item) && f.2 >= edge.width) {
                continue;
            }
            let moving = match (segment.motion, segment.spindle_on) {
                (Motion::Rapid, _) => "a rapid move",
                (_, false) => "the tool, its spindle standing,",
                (_, true) => "the shank or the holder",
            };
            let Missed { step, .. } = simulated.simulation.missed;
            let finding = Finding::doubt(
                Code::OVERLAP_MISSED,
                format!(
                    "{moving} passes an edge of the stock with less room than the {step} mm between the lines of the stock model can tell from an overlap"
                ),
            )
            .value(edge.width, "mm that it may overlap")
            .bound_mm(Missed::UNTOLD)
            .point(edge.point)
            .cure(format!("set simulate.step to {}, or leave more room", finer(edge.height, edge.width)));
            if found.last().is_some_and(|f| (f.0, f.1) == (setup, segment.item)) {
                found.pop();
            }
            found.push((setup, segment.item, edge.width, simulated.at(setup, segment.item, finding)));
        }
    }
    found.into_iter().map(|(.., finding)| finding).collect()
}

/// A step at which an overlap of this height and width is met if it is there [mm], in hundredths.
fn finer(height: f64, width: f64) -> f64 {
    let step = height.max(width * std::f64::consts::FRAC_1_SQRT_2);
    ((step * 100.0).floor() / 100.0).max(0.01)
}
