//! Cusps: where the second derivative of the distance changes sign along a grazing curve.

use super::point::{EnvelopePoint, across};
use crate::num::bisect::bisected;
use crate::sweep::{MotionJet, ProfileChain, ToolMotion};

/// Parts of a span at which the sign is looked at: the second derivative is a smooth function with few waves.
const PARTS: u32 = 32;
/// Halvings to the resolution of a double.
const HALVINGS: u32 = 52;

impl ProfileChain {
    /// The points of the grazing curves at a moment beyond which the envelope lies inside of what is swept: its cusps. Edges
    /// have none.
    pub fn cusps(&self, motion: &ToolMotion, t: f64) -> Vec<EnvelopePoint> {
        let jet = motion.at(t);
        let grazing = self.grazing(&jet.twist);
        let mut all = Vec::new();
        for span in grazing.spans.iter().filter(|s| !self.pieces()[s.piece].is_fan()) {
            let at = |part: f64, branch: usize| self.on_span(&jet, t, span, part, branch);
            for branch in 0..2 {
                for k in 0..PARTS {
                    let [a, b] = [k, k + 1].map(|k| f64::from(k) / f64::from(PARTS));
                    let below = at(a, branch).second < 0.0;
                    if below == (at(b, branch).second < 0.0) {
                        continue;
                    }
                    let [a, b] = bisected([a, b], HALVINGS, |m| (at(m, branch).second < 0.0) == below);
                    all.push(at(0.5 * (a + b), branch));
                }
            }
        }
        all
    }

    fn on_span(
        &self,
        jet: &MotionJet,
        t: f64,
        span: &crate::sweep::GrazingSpan,
        part: f64,
        branch: usize,
    ) -> EnvelopePoint {
        let at = self.grazing_points(span, part)[branch];
        self.envelope_point(jet, t, span.piece, at.u, (at.branch, across(at.normal, at.point)))
    }
}
