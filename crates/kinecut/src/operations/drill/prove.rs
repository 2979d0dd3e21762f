//! Whether the simulated point meets the stock where the zones say: each hole is measured in the stock as it is before
//! it is drilled.

use glam::DVec3;

use super::{PlannedDrilling, PlannedHole};
use crate::base::{Code, Finding, Severity, at_most};
use crate::drilling::ZoneStage;
use crate::operations::measured::{Probe, Proof};
use crate::operations::setting::is_along_axis;
use crate::operations::{Found, Judged, PostedPlan, Shown, Tally};
use crate::stock::PointEngagement;

impl PlannedDrilling {
    /// The holes to measure, the first of them, each with the item of the text that drills it.
    pub(super) fn probes_of(&self, posted: &PostedPlan<'_>, most: usize) -> Vec<Probe> {
        let to_part = posted.to_part(&self.of.milling);
        let out = to_part.vector(DVec3::Z);
        if !is_along_axis(out) {
            return Vec::new();
        }
        let items = posted.program.items.len() as u32;
        let mut probes = Vec::new();
        let mut item = 0;
        for hole in self.holes.iter().take(most) {
            // Items of the text follow those of the plan.
            while item < items && posted.planned_item(item).is_none_or(|p| p < hole.first_item) {
                item += 1;
            }
            if item == items {
                break;
            }
            probes.push(Probe {
                setup: posted.index,
                item,
                at: self.zero_of(posted, hole),
                out,
                edge: hole.plan.edge,
            });
        }
        probes
    }

    /// The point of a hole's axis where the plan's Z is 0 [part coordinates].
    fn zero_of(&self, posted: &PostedPlan<'_>, hole: &PlannedHole) -> DVec3 {
        posted.to_part(&self.of.milling).point(DVec3::new(hole.at[0], hole.at[1], hole.zero))
    }

    /// Share of a hole's point in material over the plan's Z [mm], falling, at so many places.
    pub(super) fn engagement(
        &self,
        shown: &Shown<'_>,
        hole: &PlannedHole,
        measured: &PointEngagement,
        places: u32,
    ) -> Vec<[f64; 2]> {
        let zero = measured.height(self.zero_of(&shown.posted, hole));
        let (from, to) = (hole.plan.travel.start, hole.plan.travel.end);
        (0..=places)
            .map(|i| {
                let z = from + (to - from) * f64::from(i) / f64::from(places);
                [z, measured.share(z + zero)]
            })
            .collect()
    }

    /// Compares the measured engagement with the zones.
    pub(super) fn judged(&self, posted: &PostedPlan<'_>, found: &Found<'_>) -> Judged {
        let mut judged = Judged::default();
        let tally = &mut judged.tally;
        for ((hole, probe), measured) in self.holes.iter().zip(&found.probes.points).zip(found.points) {
            let zero = measured.height(self.zero_of(posted, hole));
            match mismatch(hole, measured, zero, found.step) {
                Some(finding) => {
                    let [x, y] = hole.at;
                    let message = format!("hole {} at X{x} Y{y}: {}", hole.number + 1, finding.message);
                    judged.findings.push((Finding { message, ..finding }, probe.item));
                    tally.bad += 1;
                }
                None => {
                    tally.good += 1;
                    let exact = hole.plan.entry.first - hole.spec.tolerance;
                    let late = measured.first().map_or(0.0, |z| exact - (z - zero));
                    tally.worst = tally.worst.max(late.abs());
                }
            }
        }
        tally.unmeasured = self.holes.len() - found.points.len();
        judged
    }
}

/// The claim about all measured holes of a job.
pub(super) fn claim(tallies: &[Tally], step: f64) -> Option<Proof> {
    let good: usize = tallies.iter().map(|t| t.good).sum();
    if good == 0 || tallies.iter().any(|t| t.bad > 0) {
        return None;
    }
    let worst = tallies.iter().map(|t| t.worst).fold(0.0, f64::max);
    let holes = if good == 1 { "1 drilled hole".to_owned() } else { format!("{good} drilled holes") };
    Some(Proof {
        claim: format!(
            "{holes}: nothing of the point enters material outside of its entry zones or leaves it outside of its exit zones, and through holes end in air"
        ),
        bound: format!(
            "columns of the stock, {step} mm between them; first contact found {} mm from the computed Z",
            at_most(worst, 3)
        ),
    })
}

/// Error in a hole's zones: the point meets or leaves material where the plan has no change.
fn mismatch(hole: &PlannedHole, measured: &PointEngagement, zero: f64, step: f64) -> Option<Finding> {
    let finding = |z: f64, what: &str| {
        let f = Finding::error(Code::DRILL_ZONES, what.to_owned()).value(z + hole.zero, "mm (Z)");
        f.help("give the surfaces of the stock as it is then, or change the order of the operations")
    };
    let Some(first) = measured.first() else {
        return (measured.columns() > 0)
            .then(|| finding(hole.plan.entry.first, "the point meets no material"));
    };
    let start = hole.plan.travel.start;
    if first - zero > start {
        return Some(finding(first - zero, "material begins above the start of the hole"));
    }
    for zone in &hole.plan.zones {
        // Borders are known to a step if the stock is a mesh or a grid of columns.
        let (from, to) = (zone.from - step + zero, zone.to + step + zero);
        if from <= to {
            continue;
        }
        let (begins, ends) = (measured.first_start(from, to), measured.first_end(from, to));
        let (begins, ends) = match zone.stage {
            ZoneStage::Entry => (None, ends),
            ZoneStage::Exit => (begins, None),
            ZoneStage::Mixed => continue,
            ZoneStage::Steady | ZoneStage::Partial | ZoneStage::Air => (begins, ends),
        };
        if let Some(z) = begins {
            let late = finding(
                z - zero,
                "a part of the point meets material later than planned, at the feed of a later zone",
            );
            // Into a recess that was not described; a danger for the edge, not for the machine.
            let severity = if zone.stage == ZoneStage::Steady { Severity::Warning } else { Severity::Error };
            return Some(Finding { severity, ..late });
        }
        if let Some(z) = ends {
            return Some(finding(z - zero, "material ends where the plan goes on in it"));
        }
        let engaged = measured.share(0.5 * (from + to)) > 0.0;
        match (zone.stage, engaged) {
            (ZoneStage::Air, true) => {
                return Some(finding(0.5 * (from + to) - zero, "there is material where the plan has air"));
            }
            (ZoneStage::Steady | ZoneStage::Partial, false) => {
                return Some(finding(0.5 * (from + to) - zero, "there is no material in a steady zone"));
            }
            _ => {}
        }
    }
    let end = hole.plan.travel.end;
    if hole.plan.exit.is_some() && measured.engaged(end + zero) > 0 {
        return Some(finding(end, "the hole does not go through: there is material at its end"));
    }
    None
}
