//! The tools of a job as its report shows them.

use super::ToolView;
use crate::geom::ProfileElement;
use crate::job::SetupOutcome;
use crate::job::check::Job;
use crate::tool::{Cutter, Tool};
use crate::trace::{Segment, SegmentPace};

/// The segments that a tool makes, with their times [s].
pub(super) fn uses<'a>(
    setups: &'a [SetupOutcome],
    tool: &'a Tool,
) -> impl Iterator<Item = (&'a Segment, f64)> {
    let segments = setups.iter().flat_map(|s| s.trace.segments.iter().zip(s.segment_times()));
    segments.filter(move |(s, _)| s.tool == Some(tool.number) && !s.alternative)
}

/// The tools of a job with the time and the way of each at feed.
pub(super) fn tools(job: &Job, setups: &[SetupOutcome]) -> Vec<ToolView> {
    job.tools
        .iter()
        .map(|tool| {
            let diameter = tool.cutter.diameter(tool.flute_length);
            let mut view = ToolView::new(tool.number.0, &tool.name, diameter, tool.flute_length);
            view.stickout = Some(tool.stickout);
            view.teeth = tool.teeth;
            view.corner = match tool.cutter {
                Cutter::BallNose { diameter } => diameter / 2.0,
                Cutter::BullNose { corner_radius, .. } => corner_radius,
                _ => 0.0,
            };
            for (segment, time) in uses(setups, tool).filter(|(s, _)| s.motion != SegmentPace::Rapid) {
                view.time += time;
                view.length += segment.curve.length();
            }
            if tool.holder.is_none() {
                view.note = "no holder given".to_owned();
            }
            view.outline = outline(tool);
            view
        })
        .collect()
}

/// Half outline of a tool from the tip upwards, arcs in steps.
fn outline(tool: &Tool) -> Vec<[f32; 2]> {
    const ARC_STEPS: u32 = 8;
    let mut points = vec![[0.0, 0.0]];
    // The tools of a checked job have valid profiles.
    let bodies = [tool.cutting_profile().ok().map(|p| (p, 0.0)), tool.shank_profile().ok().flatten()];
    let holder = tool.holder_profiles().unwrap_or_default();
    for (profile, z) in bodies.into_iter().flatten().chain(holder) {
        for element in profile.elements() {
            let steps = if matches!(element, ProfileElement::Torus { .. }) { ARC_STEPS } else { 1 };
            let (low, high) = (element.bottom(), element.top());
            if let ProfileElement::Cone { z0, r0, .. } = *element {
                points.push([r0 as f32, (z + z0) as f32]);
            }
            for i in 1..=steps {
                let h = low + (high - low) * f64::from(i) / f64::from(steps);
                points.push([element.radius(h) as f32, (z + h) as f32]);
            }
        }
    }
    points
}
