//! What the search gives.

use crate::facing::Placement;

/// The best placement of one straight pass, with the proof that there is none much better.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimum {
    /// Weighted bad length at the placement [mm].
    pub value: f64,
    /// The best placement found.
    pub placement: Placement,
    /// No allowed placement has a lesser value [mm].
    pub lower_bound: f64,
    /// Boxes of placements looked at.
    pub nodes: usize,
    /// Whether the gap between value and bound is the one asked for; otherwise the search was stopped or ran out of
    /// nodes.
    pub complete: bool,
    /// Other local minima, distinct in placement, best first.
    pub alternatives: Vec<LocalMinimum>,
    /// What no straight pass avoids, loop by loop; empty unless asked for.
    pub irreducible: Vec<Irreducible>,
    /// What errors of set-up can do.
    pub sensitivity: PlacementSensitivity,
}

impl Optimum {
    /// How far the value may be above the best one at most [mm].
    pub fn gap(&self) -> f64 {
        self.value - self.lower_bound
    }

    /// The bad length that no allowed straight pass avoids, as a sum over the loops [mm]: chamfer there before milling.
    pub fn irreducible_length(&self) -> f64 {
        self.irreducible.iter().map(|i| i.length).sum()
    }
}

/// A placement better than all near it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalMinimum {
    /// Weighted bad length [mm].
    pub value: f64,
    /// Where.
    pub placement: Placement,
}

/// What of a loop is bad under every allowed straight pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Irreducible {
    /// Index of the loop in the outline.
    pub outline_loop: usize,
    /// No allowed placement leaves less of this loop's weighted length bad [mm]: certified.
    pub length: f64,
    /// The same per weighted length of the loop.
    pub share: f64,
}

/// What errors of set-up do to a placement.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacementSensitivity {
    /// The worst value found within the errors of set-up [mm].
    pub worst: f64,
    /// Where.
    pub worst_at: Placement,
    /// Straight edges that the placement has exactly parallel to the feed: their exits flip together.
    pub feed_parallel: Vec<usize>,
}
