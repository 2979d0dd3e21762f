//! The keys of a table that breaks an edge.

use super::EdgesName;
use crate::contouring::ContourLoops;
use crate::holes::Sense;
use crate::operations::chamfer::ChamferSide;
use crate::operations::outlines::OutlineKeys;
use crate::operations::{CalledTool, PlaneTable};
use crate::program::Coolant;

/// The keys of a table, whichever it is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeKeys<'a> {
    /// Noun of the operation.
    pub(crate) noun: &'static str,
    pub(crate) tool: &'a CalledTool,
    pub(crate) name: Option<&'a str>,
    pub(crate) of: Option<&'a str>,
    /// The outline that the table itself says.
    pub(crate) own: OutlineKeys<'a>,
    pub(crate) edges: Option<EdgesName>,
    pub(crate) above: Option<f64>,
    pub(crate) burr: Option<&'a [[f64; 2]]>,
    pub(crate) plane: Option<&'a PlaneTable>,
    pub(crate) side: Option<ChamferSide>,
    pub(crate) loops: Option<ContourLoops>,
    pub(crate) top: Option<f64>,
    pub(crate) stock_to_leave: Option<f64>,
    pub(crate) tolerance: Option<f64>,
    pub(crate) direction: Sense,
    pub(crate) lead_radius: Option<f64>,
    pub(crate) start: Option<[f64; 2]>,
    pub(crate) overlap: Option<f64>,
    pub(crate) speed: Option<f64>,
    pub(crate) cutting_speed: Option<f64>,
    pub(crate) feed: Option<f64>,
    pub(crate) feed_per_tooth: Option<f64>,
    pub(crate) plunge_feed: Option<f64>,
    pub(crate) coolant: Coolant,
}

/// The keys of a table that has all of them.
macro_rules! edge_keys {
    ($table:expr, $noun:expr) => {
        $crate::operations::edge::EdgeKeys {
            noun: $noun,
            tool: &$table.tool,
            name: $table.name.as_deref(),
            of: $table.of.as_deref(),
            own: $crate::operations::outlines::OutlineKeys {
                polyline: $table.polyline.as_deref(),
                ..$crate::operations::outlines::outline_keys!($table)
            },
            edges: $table.edges,
            above: $table.above,
            burr: $table.burr.as_deref(),
            plane: $table.plane.as_ref(),
            side: $table.side,
            loops: $table.loops,
            top: $table.top,
            stock_to_leave: $table.stock_to_leave,
            tolerance: $table.tolerance,
            direction: $table.direction,
            lead_radius: $table.lead_radius,
            start: $table.start,
            overlap: $table.overlap,
            speed: $table.speed,
            cutting_speed: $table.cutting_speed,
            feed: $table.feed,
            feed_per_tooth: $table.feed_per_tooth,
            plunge_feed: $table.plunge_feed,
            coolant: $table.coolant,
        }
    };
}
pub(crate) use edge_keys;
