//! The cutter of a milled wall in the planner's words.

use crate::holes::CutterData;
use crate::tool::Tool;

/// Distance above material at which rapids end [mm].
pub(crate) const CLEARANCE: f64 = 2.0;

pub(crate) fn cutter(tool: &Tool) -> CutterData {
    CutterData {
        diameter: tool.cutter.diameter(tool.flute_length),
        flute_length: tool.flute_length,
        centre_cutting: tool.centre_cutting,
        max_ramp_angle: tool.max_ramp_angle,
    }
}
