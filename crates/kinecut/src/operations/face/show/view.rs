//! A planned face as the report takes it, without the job's types.

use glam::DVec2;

use crate::base::Finding;
use crate::facing::optimum::{ObjectiveMap, Options};
use crate::facing::{FacePlan, MillingWay, Placement, SimplexDescent, SurveyPoint, Tooth, ToothCrossing};

/// A planned face and what a person wants to know of it. Plan, options and descents are as an M3 spindle sees them.
pub(crate) struct MilledFace<'a> {
    /// Title.
    pub(crate) title: &'a str,
    /// A word that no other face of the page has, for the names of its pictures.
    pub(crate) id: String,
    /// Which exit angles are bad, in words.
    pub(crate) rule: &'a str,
    /// Notes of the outline's reader.
    pub(crate) notes: &'a [String],
    /// The plan.
    pub(crate) plan: &'a FacePlan,
    /// Constraints of the placement.
    pub(crate) options: Options,
    /// Exit angles this near to a bad one count as bad in what was optimised [rad].
    pub(crate) guard: f64,
    /// The cutter's teeth.
    pub(crate) teeth: &'a [Tooth],
    /// Feed [mm/s].
    pub(crate) feed: f64,
    /// Feed per revolution [mm].
    pub(crate) feed_per_revolution: f64,
    /// Speed of links [mm/s].
    pub(crate) rapid: f64,
    /// Angle by which the part is turned on the table [rad].
    pub(crate) part_turned: f64,
    /// Direction of X of turned coordinates from X of the work offset [rad]; 0: none are used.
    pub(crate) coordinates_turned: f64,
    /// Depth of each level below the one before [mm].
    pub(crate) depths: Vec<f64>,
    /// Findings.
    pub(crate) findings: &'a [Finding],
    /// The crossings of the real teeth with the outline, if they are wanted; else empty.
    pub(crate) events: &'a [ToothCrossing],
    /// Largest exit angle and objective over the orientation, the cutter over the middle; may be empty.
    pub(crate) survey: &'a [SurveyPoint],
    /// The paper's method from the part as drawn, the cutter over the middle, if it is known.
    pub(crate) from_drawn: Option<&'a SimplexDescent>,
    /// Descents of the paper's method from random starts; may be empty.
    pub(crate) descents: &'a [SimplexDescent],
    /// The objective over all placements, if it is known already.
    pub(crate) map: Option<&'a ObjectiveMap>,
}

impl MilledFace<'_> {
    /// The way chosen.
    pub(super) fn chosen(&self) -> &MillingWay {
        &self.plan.ways[self.plan.chosen]
    }

    /// A placement of the plan, as the part lies.
    pub(super) fn seen(&self, placement: Placement) -> Placement {
        if self.plan.left_hand { placement.mirrored() } else { placement }
    }

    /// A point of the plan's outline, as the part lies.
    pub(super) fn seen_point(&self, p: DVec2) -> DVec2 {
        if self.plan.left_hand { DVec2::new(p.x, -p.y) } else { p }
    }

    /// The number of an edge of the plan in the outline as given.
    pub(super) fn seen_edge(&self, edge: usize) -> usize {
        let of = self.plan.case.outline.loops().iter().find(|l| l.edges.contains(&edge));
        match of.filter(|_| self.plan.left_hand) {
            Some(l) => l.edges.start + l.edges.end - 1 - edge,
            None => edge,
        }
    }

    /// Mean feed per tooth [mm].
    pub(super) fn feed_per_tooth(&self) -> f64 {
        self.feed_per_revolution / self.teeth.len().max(1) as f64
    }
}
