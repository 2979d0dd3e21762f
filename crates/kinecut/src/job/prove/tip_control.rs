//! Rotary axes that turn in a cut of a program of others without control of the tool centre point: the tip leaves the line
//! between the programmed points.
//!
//! A program may be meant so where one axis carries the work round (a cam, an engraved drum): there one linear axis moves with it.
//! Two that do are the coordinates of a tip.

use glam::DVec3;

use super::Simulated;
use crate::base::{Code, Finding};
use crate::job::setup_outcome::SetupOutcome;
use crate::nc::Control;
use crate::program::Speed;
use crate::trace::{Carried, Segment};

/// Least distance of the tip from its line that counts [mm].
const LEAST: f64 = 0.05;
/// Least way of an axis that moves [mm, rad].
const MOVES: f64 = 1e-6;
/// Places of a segment at which the tip is compared.
const PLACES: u32 = 8;

/// A doubt for each setup, at the first block, with the greatest distance of all.
pub(super) fn tip_control(simulated: &Simulated<'_>) -> Vec<Finding> {
    // The other controls have no word for it.
    if !matches!(simulated.job.post.control, Control::Fanuc | Control::Heidenhain | Control::Sinumerik840d) {
        return Vec::new();
    }
    let setups = simulated.setups.iter().enumerate().filter(|(_, done)| done.external.is_some());
    setups.filter_map(|(setup, done)| one(simulated, setup, done)).collect()
}

fn one(simulated: &Simulated<'_>, setup: usize, done: &SetupOutcome) -> Option<Finding> {
    let all: Vec<_> = simulated.segments(setup).collect();
    let mut found: Option<(u32, f64, usize)> = None;
    for block in all.chunk_by(|a, b| a.segment.item == b.segment.item) {
        let segments = || block.iter().map(|d| d.segment);
        let (first, last) = (block[0].segment, block[block.len() - 1].segment);
        let by_minute = matches!(done.program.state(first.item as usize).speed, Speed::PerMinute(_));
        if !by_minute || !block.iter().any(|d| d.cuts()) || !turns(first, last) {
            continue;
        }
        let [from, to] = [first.curve.start(), last.curve.end()];
        let off = segments().map(|s| farthest(s, from, to)).fold(0.0, f64::max);
        if off > LEAST {
            let (item, most, blocks) = found.unwrap_or((first.item, 0.0, 0));
            found = Some((item, if off > most { off } else { most }, blocks + 1));
        }
    }
    let (item, off, blocks) = found?;
    let also = if blocks > 1 { format!(" (in {blocks} blocks, this is the first)") } else { String::new() };
    let what = format!(
        "rotary axes turn in a cut without control of the tool centre point: the tip leaves the line between the points{also}"
    );
    let finding =
        Finding::doubt(Code::TIP_NOT_CONTROLLED, what).value((off * 1e3).round() / 1e3, "mm").bound_mm(LEAST);
    let help = match simulated.job.post.control {
        Control::Heidenhain => "switch it on (M128) before the cut",
        Control::Sinumerik840d => "switch it on (TRAORI) before the cut",
        _ => "switch it on (G43.4) before the cut",
    };
    Some(simulated.at(setup, item, finding.help(help)))
}

/// Whether the axes go straight, a rotary one and two linear ones or more among them.
fn turns(first: &Segment, last: &Segment) -> bool {
    let straight = first.turning.as_ref().is_some_and(|t| matches!(t.carried(), Carried::Joints { .. }));
    let Some((from, to)) = first.joints(0.0).zip(last.joints(1.0)).filter(|_| straight) else { return false };
    let moves = |i: usize| (to[i] - from[i]).abs() > MOVES;
    (3..6).any(moves) && (0..3).filter(|i| moves(*i)).count() > 1
}

/// Greatest distance of the tip from the line between two points on a segment [mm].
fn farthest(segment: &Segment, from: DVec3, to: DVec3) -> f64 {
    let way = (to - from).normalize_or_zero();
    let off = |i: u32| {
        let tip = segment.tool_at(f64::from(i) / f64::from(PLACES)).0 - from;
        (tip - way * tip.dot(way)).length()
    };
    (0..=PLACES).map(off).fold(0.0, f64::max)
}
