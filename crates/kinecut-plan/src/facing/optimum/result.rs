//! Results of the search.

use serde::Serialize;

use crate::facing::Placement;

/// The best placement of one straight pass, with the proof that no other is much better.
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
    /// The gap between value and bound is the one asked for; otherwise the search was stopped or ran out of nodes.
    pub complete: bool,
    /// Other local minima, distinct in placement, best first.
    pub alternatives: Vec<LocalMinimum>,
    /// The part that no straight pass avoids, loop by loop; empty unless asked for.
    pub irreducible: Vec<Irreducible>,
    /// Effect of set-up errors.
    pub sensitivity: PlacementSensitivity,
}

impl Optimum {
    /// Largest possible distance of the value above the best one [mm].
    pub fn gap(&self) -> f64 {
        self.value - self.lower_bound
    }

    /// The bad length that no allowed straight pass avoids, as a sum over the loops [mm]: chamfer there before milling.
    pub fn irreducible_length(&self) -> f64 {
        self.irreducible.iter().map(|i| i.length).sum()
    }
}

/// A placement better than all near it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LocalMinimum {
    /// The placement.
    pub placement: Placement,
    /// Weighted bad length [mm].
    pub value: f64,
}

/// The part of a loop that is bad under every allowed straight pass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Irreducible {
    /// No allowed placement leaves less of this loop's weighted length bad [mm]: certified.
    pub length: f64,
    /// Index of the loop in the outline; in JSON `loop`.
    #[serde(rename = "loop")]
    pub outline_loop: usize,
    /// The same per weighted length of the loop.
    pub share: f64,
}

/// Effect of set-up errors on a placement.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacementSensitivity {
    /// The worst value found within the errors of set-up [mm].
    pub worst: f64,
    /// Placement with the worst value.
    pub worst_at: Placement,
    /// Straight edges that the placement has exactly parallel to the feed: their exits flip together.
    pub feed_parallel: Vec<usize>,
}
