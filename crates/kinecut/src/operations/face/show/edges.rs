//! Which edges keep a bad burr: stretch by stretch, the longest first.

use glam::DVec2;

use super::MilledFace;
use super::strokes::Kind;
use crate::facing::MillingWay;
use crate::facing::passes::{EdgeStretch, Met};

/// A stretch of an edge with a bad exit, numbered and placed as in the outline as given.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BadEdge {
    /// Number of the edge.
    pub(super) edge: usize,
    /// Its label, if it has one.
    pub(super) label: Option<String>,
    /// Shares of the edge's length where the stretch begins and ends.
    pub(super) shares: [f64; 2],
    /// Its begin and end [mm].
    pub(super) ends: [DVec2; 2],
    /// Length [mm].
    pub(super) length: f64,
    /// Length by the weights of edge and exit angle [mm].
    pub(super) counted: f64,
    /// Least and largest exit angle [rad].
    pub(super) exit_angles: [f64; 2],
    /// Least and largest thickness of the chip where teeth leave [mm].
    pub(super) chip: [f64; 2],
}

/// Places of a stretch at which angles are taken, its ends among them.
const PLACES: u32 = 16;

/// The bad stretches of a way, those that count most first.
pub(super) fn bad_edges(face: &MilledFace<'_>, way: &MillingWay) -> Vec<BadEdge> {
    let case = &face.plan.case;
    let bad = way.burr.stretches.iter().filter(|s| Kind::of(case, s) == Kind::Bad);
    let mut all: Vec<BadEdge> = bad.filter_map(|s| one(face, way, s)).collect();
    all.sort_by(|a, b| b.counted.total_cmp(&a.counted).then(a.edge.cmp(&b.edge)));
    all
}

fn one(face: &MilledFace<'_>, way: &MillingWay, stretch: &EdgeStretch) -> Option<BadEdge> {
    let case = &face.plan.case;
    let edge = case.outline.edges().get(stretch.edge)?;
    let Met::First { weight, .. } = stretch.met else { return None };
    let length = (stretch.to - stretch.from) * edge.length();
    let (mut exit_angles, mut chip) =
        ([f64::INFINITY, f64::NEG_INFINITY], [f64::INFINITY, f64::NEG_INFINITY]);
    for k in 0..=PLACES {
        // Just inside of the ends: there the next stretch begins.
        let share = (f64::from(k) / f64::from(PLACES)).clamp(1e-9, 1.0 - 1e-9);
        let s = stretch.from + share * (stretch.to - stretch.from);
        let Some(angle) = way.exit_angle(case, stretch, s) else { continue };
        exit_angles = [exit_angles[0].min(angle), exit_angles[1].max(angle)];
        if let Some(thick) = chip_at(face, way, stretch, s, angle) {
            chip = [chip[0].min(thick), chip[1].max(thick)];
        }
    }
    let left = face.plan.left_hand;
    let (from, to) = if left { (stretch.to, stretch.from) } else { (stretch.from, stretch.to) };
    Some(BadEdge {
        edge: face.seen_edge(stretch.edge),
        label: case.outline.label(stretch.edge).map(str::to_owned),
        shares: if left { [1.0 - from, 1.0 - to] } else { [from, to] },
        ends: [from, to].map(|s| face.seen_point(edge.at(s))),
        length,
        counted: length * weight * case.weights.get(stretch.edge).copied().unwrap_or(1.0),
        exit_angles,
        chip,
    })
}

/// Feed per tooth times the cosine of the tooth's angle from the feed.
fn chip_at(
    face: &MilledFace<'_>,
    way: &MillingWay,
    stretch: &EdgeStretch,
    s: f64,
    exit_angle: f64,
) -> Option<f64> {
    let case = &face.plan.case;
    let edge = case.outline.edges().get(stretch.edge)?;
    let Met::First { chain, piece, .. } = stretch.met else { return None };
    let piece = way.path.chains.get(chain)?.get(piece)?;
    let arm = DVec2::from_angle(edge.outward(s) + exit_angle);
    let feed = match piece.turn {
        None => (piece.end - piece.start).normalize_or_zero(),
        Some(t) => {
            let out = (edge.at(s) - case.radius * arm - t.centre).normalize_or_zero();
            if t.sweep > 0.0 { out.perp() } else { -out.perp() }
        }
    };
    let thick = face.feed_per_tooth() * arm.dot(feed);
    Some(if thick > 0.0 { thick } else { 0.0 })
}
