//! The outline in strokes of one look: where teeth enter, leave well, leave badly.

use super::looks;
use super::motion::{Timed, first_met};
use crate::facing::passes::{EdgeStretch, Met};
use crate::facing::{FaceCase, MillingWay};
use crate::page::Ink;

/// Contact of the teeth along a stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// No tooth comes there, or the cutter is lowered onto it.
    Unmet,
    /// Teeth enter.
    Entry,
    /// Teeth leave well.
    Good,
    /// Teeth leave badly, on an edge that counts nothing.
    Excused,
    /// Teeth leave badly.
    Bad,
}

impl Kind {
    pub(crate) const ALL: [Kind; 5] = [Kind::Unmet, Kind::Entry, Kind::Good, Kind::Excused, Kind::Bad];

    /// Of a stretch of the outline.
    pub(crate) fn of(case: &FaceCase, stretch: &EdgeStretch) -> Kind {
        match stretch.met {
            Met::Never | Met::Lowered { .. } => Kind::Unmet,
            Met::First { exit, weight, .. } => match (weight > 0.0, exit) {
                (true, _) if case.weights.get(stretch.edge) == Some(&0.0) => Kind::Excused,
                (true, _) => Kind::Bad,
                (false, true) => Kind::Good,
                (false, false) => Kind::Entry,
            },
        }
    }

    pub(crate) fn ink(self) -> Ink {
        match self {
            Kind::Unmet => looks::UNMET,
            Kind::Entry => looks::ENTRY,
            Kind::Good => looks::GOOD_EXIT,
            Kind::Excused => looks::EXCUSED,
            Kind::Bad => looks::BAD_EXIT,
        }
    }

    pub(crate) fn word(self) -> &'static str {
        match self {
            Kind::Unmet => "not met in feed",
            Kind::Entry => "teeth enter",
            Kind::Good => "good exit",
            Kind::Excused => "bad exit that does not count",
            Kind::Bad => "bad exit",
        }
    }
}

/// A piece of an edge of one look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stroke {
    /// The edge, as the plan numbers it.
    pub(crate) edge: usize,
    /// Share of its length where the stroke begins.
    pub(crate) from: f64,
    /// Share where it ends.
    pub(crate) to: f64,
    /// Look.
    pub(crate) kind: Kind,
    /// When its middle is first met [s]; none where nothing moves or nothing comes.
    pub(crate) met: Option<f64>,
}

/// Pieces into which the whole outline is cut for a motion, about.
const PIECES: f64 = 320.0;

/// The strokes of a way, bad ones last so that they lie on top; with `chains` cut small and with their times.
pub(crate) fn strokes(case: &FaceCase, way: &MillingWay, chains: Option<&Timed>) -> Vec<Stroke> {
    let piece = case.outline.perimeter() / PIECES;
    let mut all = Vec::new();
    for stretch in &way.burr.stretches {
        let Some(edge) = case.outline.edges().get(stretch.edge) else { continue };
        let kind = Kind::of(case, stretch);
        let long = (stretch.to - stretch.from) * edge.length();
        let count = if chains.is_some() { (long / piece).ceil().max(1.0) as u32 } else { 1 };
        for k in 0..count {
            let at = |k: u32| stretch.from + (stretch.to - stretch.from) * f64::from(k) / f64::from(count);
            let (from, to) = (at(k), at(k + 1));
            let met = chains.and_then(|c| first_met(c, edge.at(0.5 * (from + to)), case.radius));
            all.push(Stroke { edge: stretch.edge, from, to, kind, met });
        }
    }
    all.sort_by_key(|s| s.kind);
    all
}
