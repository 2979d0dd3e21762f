//! Segments of a traced program as moves.

use std::ops::Range;

use super::{Kind, ToolMotion, joints};
use crate::base::Result;
use crate::machine::JointValues;
use crate::trace::{Carried, Segment};

/// Largest distance of positions from the straight way of their joints that is rounding, by its length [mm, rad].
const STRAIGHT: f64 = 1e-9;

impl ToolMotion {
    /// The move of a segment [part coordinates]. If joints go straight without control of the tool centre point, it is
    /// the exact motion; the segment's curve is a chord of it.
    ///
    /// # Errors
    /// `KC1203` when a number of the segment is not finite.
    pub fn of_segment(segment: &Segment) -> Result<ToolMotion> {
        let Some(turning) = &segment.turning else {
            return ToolMotion::fixed(segment.curve.clone(), segment.axis);
        };
        match turning.carried() {
            Carried::Plane => {
                let (from, rate) = turning.axis(0.0);
                ToolMotion::turning(segment.curve.clone(), super::upright_on(from)?, rate)
            }
            Carried::Joints { chain, from, to, to_part } => {
                let mut motion = ToolMotion::joints(chain, &from, &to)?;
                if let Kind::Joints { place, .. } = &mut motion.kind {
                    *place = to_part;
                }
                Ok(motion)
            }
            Carried::TipAndJoints { chain, from, to, to_part } => {
                let mut motion = ToolMotion::tip_and_joints(segment.curve.clone(), chain, &from, &to)?;
                if let Kind::TipAndJoints { place, .. } = &mut motion.kind {
                    *place = to_part.rotation;
                }
                Ok(motion)
            }
        }
    }

    /// The moves of segments that follow one another, each with its segments: chords of one straight way of all joints are one
    /// move again.
    ///
    /// # Errors
    /// As [`ToolMotion::of_segment`].
    pub fn of_segments(segments: &[Segment]) -> Result<Vec<(Range<usize>, ToolMotion)>> {
        let mut all: Vec<(Range<usize>, ToolMotion)> = Vec::new();
        for (i, segment) in segments.iter().enumerate() {
            let next = ToolMotion::of_segment(segment)?;
            let goes_on = all
                .last_mut()
                .filter(|(range, _)| segments[range.start].item == segment.item)
                .is_some_and(|(range, last)| {
                    let goes_on = last.go_on(&next);
                    if goes_on {
                        range.end = i + 1;
                    }
                    goes_on
                });
            if !goes_on {
                all.push((i..i + 1, next));
            }
        }
        Ok(all)
    }

    /// Takes the next move into this one if both are parts of one straight way of all joints.
    fn go_on(&mut self, next: &ToolMotion) -> bool {
        let (Kind::Joints { from, to, .. }, Kind::Joints { from: again, to: end, .. }) =
            (&mut self.kind, &next.kind)
        else {
            return false;
        };
        let way = |a: &JointValues, b: &JointValues| -> f64 {
            a.iter().zip(b.iter()).map(|(a, b)| (b - a) * (b - a)).sum::<f64>().sqrt()
        };
        let all = way(from, end);
        let part = if all > 0.0 { way(from, to) / all } else { 0.0 };
        let goes_on =
            way(to, again) <= STRAIGHT * all && way(&joints::between(from, end, part), to) <= STRAIGHT * all;
        if goes_on {
            *to = *end;
        }
        goes_on
    }
}
