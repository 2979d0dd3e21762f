//! One way to mill a face, with its price.

use super::passes::{EdgeStretch, Met, PassPath, PathBurr, exit_angle};
use super::{FaceCase, Placement};

/// A way to mill a face: its path, what it leaves, and what it costs. As an M3 spindle sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct MillingWay {
    /// Name in findings and reports.
    pub name: String,
    /// The way of the cutter's centre.
    pub path: PassPath,
    /// The placement under which its rows run along the feed; none for a path round the outline.
    pub angle: Option<f64>,
    /// Ordinate of the centre line, of one straight pass [mm].
    pub offset: Option<f64>,
    /// Weighted bad length, without guard [mm].
    pub bad: f64,
    /// The same with the guard [mm].
    pub guarded: f64,
    /// Effect on the outline, without guard.
    pub burr: PathBurr,
    /// Length at feed [mm].
    pub feed_length: f64,
    /// Time at feed and rapids [s].
    pub time: f64,
    /// A place of the face that it does not reach; `None`: it reaches all.
    pub unreached: Option<[f64; 2]>,
    /// No other way is both faster and leaves less.
    pub unbeaten: bool,
}

impl MillingWay {
    /// The placement of one straight pass.
    pub fn placement(&self) -> Option<Placement> {
        Some(Placement { angle: self.angle?, offset: self.offset? })
    }

    /// The exit angle at a place of a stretch of the outline that is met in feed [rad]; `s` is the share of the edge's
    /// length.
    pub fn exit_angle(&self, case: &FaceCase, stretch: &EdgeStretch, s: f64) -> Option<f64> {
        let Met::First { chain, piece, .. } = stretch.met else { return None };
        let piece = self.path.chains.get(chain)?.get(piece)?;
        Some(exit_angle(case.outline.edges().get(stretch.edge)?, s, piece, case.radius))
    }
}
