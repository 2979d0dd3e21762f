//! The end mill of traces and times.

use kinecut::program::ToolNumber;
use kinecut::tool::{Cutter, Tool};

/// An end mill of diameter 10 with this number and gauge length [mm].
pub(crate) fn end_mill(number: u32, gauge_length: f64) -> Tool {
    Tool {
        number: ToolNumber(number),
        name: "end mill".into(),
        cutter: Cutter::EndMill { diameter: 10.0 },
        teeth: 2,
        spacing: Default::default(),
        flute_length: 20.0,
        stickout: 40.0,
        shank_diameter: 10.0,
        holder: None,
        centre_cutting: true,
        max_ramp_angle: None,
        gauge_length: Some(gauge_length),
        limits: Default::default(),
        elasticity: None,
    }
}
