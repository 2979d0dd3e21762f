//! A segment of a traced program as a move.

use super::{Kind, ToolMotion};
use crate::base::Result;
use crate::trace::{Carried, Segment};

impl ToolMotion {
    /// The move of a segment [part coordinates]. Where joints go straight without control of the tool centre point, it is the
    /// exact motion, of which the segment's curve is a chord.
    ///
    /// # Errors
    /// `KC1203` when a number of the segment is not finite.
    pub fn of_segment(segment: &Segment) -> Result<ToolMotion> {
        let Some(turning) = &segment.turning else {
            return ToolMotion::fixed(segment.curve, segment.axis);
        };
        match turning.carried() {
            Carried::Plane => {
                let (from, rate) = turning.axis(0.0);
                ToolMotion::turning(segment.curve, super::upright_on(from)?, rate)
            }
            Carried::Joints { chain, from, to, to_part } => {
                let mut motion = ToolMotion::joints(chain, &from, &to)?;
                if let Kind::Joints { place, .. } = &mut motion.kind {
                    *place = to_part;
                }
                Ok(motion)
            }
            Carried::TipAndJoints { chain, from, to, to_part } => {
                let mut motion = ToolMotion::tip_and_joints(segment.curve, chain, &from, &to)?;
                if let Kind::TipAndJoints { place, .. } = &mut motion.kind {
                    *place = to_part.rotation;
                }
                Ok(motion)
            }
        }
    }
}
