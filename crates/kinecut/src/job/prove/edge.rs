//! Edges of the stock that a tool passes with less room than the lines of the stock model can tell from an overlap.
//!
//! Walls and floors are met exactly however little a tool reaches into them. Only where it clips an edge, by less than a
//! step and not as wide as the diagonal of four lines, no line may see it: then nothing is proven.

use crate::base::{Code, Finding};
use crate::job::missed::{Missed, may_clip};
use crate::job::prove::Simulated;
use crate::stock::cut::Edge;
use crate::trace::SegmentPace;

/// A doubt for each setup and kind of body, at the first block, with the widest overlap of all that may lie between the lines.
pub(super) fn edge(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    for (setup, done) in simulated.setups.iter().enumerate() {
        let mut near: Vec<Near> = Vec::new();
        for (segment, effect) in done.trace.segments.iter().zip(&simulated.simulation.effects[setup]) {
            let Some(edge) = may_clip(effect) else { continue };
            let moving = match (segment.motion, segment.spindle_on) {
                (SegmentPace::Rapid, _) => "a rapid move",
                (_, false) => "the tool, its spindle standing,",
                (_, true) => "the shank or the holder",
            };
            let item = segment.item;
            match near.iter_mut().find(|n| n.moving == moving) {
                Some(n) => {
                    n.blocks += usize::from(n.last != item);
                    n.last = item;
                    n.step = f64::min(n.step, finer(&edge));
                    if edge.width > n.widest.width {
                        n.widest = edge;
                    }
                }
                None => near.push(Near {
                    moving,
                    first: item,
                    last: item,
                    blocks: 1,
                    step: finer(&edge),
                    widest: edge,
                }),
            }
        }
        found.extend(
            near.into_iter()
                .map(|n| simulated.at(setup, n.first, n.finding(simulated.simulation.missed.step))),
        );
    }
    found
}

/// Edges of one program that one kind of body passes.
struct Near {
    moving: &'static str,
    /// First and last item, and the number of items.
    first: u32,
    last: u32,
    blocks: usize,
    /// A step at which all would be found [mm].
    step: f64,
    widest: Edge,
}

impl Near {
    fn finding(&self, step: f64) -> Finding {
        let blocks = match self.blocks {
            1 => String::new(),
            n => format!(" (in {n} blocks, this is the first)"),
        };
        let what = format!(
            "{} passes an edge of the stock with less room than the {step} mm between the lines of the stock model can tell from an overlap{blocks}",
            self.moving
        );
        Finding::doubt(Code::OVERLAP_MISSED, what)
            .value(self.widest.width, "mm that it may overlap")
            .bound_mm(Missed::UNTOLD)
            .point(self.widest.point)
            .help(format!("set simulate.step to {}, or leave more room", self.step))
    }
}

/// A step at which an overlap at an edge is met if it is there [mm], in hundredths.
fn finer(edge: &Edge) -> f64 {
    let step = edge.height.max(edge.width * std::f64::consts::FRAC_1_SQRT_2);
    ((step * 100.0).floor() / 100.0).max(0.01)
}
