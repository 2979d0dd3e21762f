//! Tables of milled walls in the planner's words.

use super::{ContactName, EntryTable, RoughTable};
use crate::geom::LensOrder;
use crate::holes::{CutterData, Entry, Rough};
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

pub(crate) fn entry(table: &Option<EntryTable>) -> Entry {
    match *table {
        Some(EntryTable::Plunge) => Entry::Plunge,
        Some(EntryTable::Helix { radius, pitch }) => Entry::Helix { radius, pitch },
        Some(EntryTable::PreDrilled { .. }) => Entry::PreDrilled,
        None => Entry::Automatic,
    }
}

pub(crate) fn drilled(table: &Option<EntryTable>) -> Option<f64> {
    if let Some(EntryTable::PreDrilled { diameter }) = table { Some(*diameter) } else { None }
}

pub(crate) fn rough(r: &RoughTable) -> Rough {
    Rough {
        engagement: r.engagement.map(f64::to_radians),
        allowance: r.allowance,
        plunge_feed: per_second(r.plunge_feed.unwrap_or(r.feed / 4.0)),
        stepdown: r.stepdown,
        ..Rough::new(r.stepover, per_second(r.feed))
    }
}

pub(crate) fn order(contact: ContactName) -> LensOrder {
    match contact {
        ContactName::G2 => LensOrder::Zero,
        ContactName::G4 => LensOrder::One,
        ContactName::G6 => LensOrder::Two,
    }
}

pub(crate) fn per_second(feed: f64) -> f64 {
    feed / 60.0
}
