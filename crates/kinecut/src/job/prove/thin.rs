//! Tools and holes that are thinner than the distance of the lines: they may pass between them.
//!
//! A cutter as wide as a step or wider always has a line across its axis in each layer. A thinner one may pass between
//! all lines: then the stock keeps what it cuts, and of what it meets nothing is known.

use crate::base::{Code, Finding};
use crate::job::prove::Simulated;
use crate::tool::Tool;
use crate::trace::{Segment, SegmentPace};

/// Doubts: for each setup and tool the first block that cuts with a tool thinner than the lines, and holes of the raw
/// stock that are.
pub(super) fn thin(simulated: &Simulated<'_>) -> Vec<Finding> {
    let (job, step) = (simulated.job, simulated.simulation.missed.step);
    let mut found = Vec::new();
    for (i, hole) in job.drilled.iter().enumerate().filter(|(_, h)| h.diameter < step) {
        let what = format!(
            "a hole that the stock has is thinner than the {} mm between the lines of the stock model and may be taken for material",
            step
        );
        found.push(doubt(what, hole.diameter, step).key(format!("drilled[{i}].diameter")));
    }
    for (i, done) in simulated.setups.iter().enumerate() {
        for tool in &job.tools {
            let Some(width) = width(tool).filter(|w| *w < step) else { continue };
            let cuts = |s: &&Segment| {
                s.tool == Some(tool.number) && !s.alternative && s.motion != SegmentPace::Rapid
            };
            let mut segments = done.trace.segments.iter().filter(cuts);
            let Some(first) = segments.find(|s| reaches(s, simulated, width)) else { continue };
            let what = format!(
                "{} is thinner than the {} mm between the lines of the stock model: what it cuts and meets may not be seen",
                tool.number, step
            );
            found.push(Finding {
                place: simulated.place(i, first.item),
                ..doubt(what, width, step).help(format!("set simulate.step to {} or less", 0.5 * width))
            });
        }
    }
    found
}

fn doubt(what: String, width: f64, step: f64) -> Finding {
    Finding::doubt(Code::OVERLAP_MISSED, what).value_mm(width).bound_mm(step)
}

/// Greatest width of the cutting part [mm].
fn width(tool: &Tool) -> Option<f64> {
    tool.cutting_profile().ok().map(|p| 2.0 * p.max_radius())
}

/// Whether the box of a segment's path, wider by the tool, meets the box of the stock.
fn reaches(segment: &Segment, simulated: &Simulated<'_>, width: f64) -> bool {
    let bounds = simulated.job.stock.bounds();
    let points = segment.curve.polyline(simulated.simulation.missed.step);
    let (min, max) = points
        .iter()
        .fold((glam::DVec3::INFINITY, glam::DVec3::NEG_INFINITY), |(a, b), p| (a.min(*p), b.max(*p)));
    (min - width).cmple(bounds.max).all() && (max + width).cmpge(bounds.min).all()
}
