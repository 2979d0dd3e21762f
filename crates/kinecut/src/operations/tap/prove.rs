//! Whether the core holes are there: each is measured in the stock as it is before its thread is cut, down to the lowest point of
//! the tap.

use glam::DVec3;

use super::core::short;
use super::{PlannedTapping, PlannedThread};
use crate::base::{Code, Finding};
use crate::operations::measured::{Probe, Proof};
use crate::operations::setting::is_along_axis;
use crate::operations::{Found, Judged, PostedPlan, Tally};
use crate::tool::DrillPoint;

/// Difference in diameter of the measured disc and the core hole [mm]: the rounding of its wall.
const WITHIN: f64 = 0.01;
/// Way of material that counts [mm].
const LEAST: f64 = 1e-3;

impl PlannedTapping {
    /// The first core holes, each with the item of the text that cuts its thread.
    pub(super) fn probes_of(&self, posted: &PostedPlan<'_>, most: usize) -> Vec<Probe> {
        let out = posted.to_part(&self.of.milling).vector(DVec3::Z);
        if !is_along_axis(out) {
            return Vec::new();
        }
        let probe = |thread: &PlannedThread| {
            let edge = DrillPoint::Flat.edge(thread.core.diameter - WITHIN).ok()?;
            let item = posted.item_after_planned(thread.item)?;
            Some(Probe { setup: posted.index, item, at: self.zero_of(posted, thread), out, edge })
        };
        self.threads.iter().take(most).map_while(probe).collect()
    }

    /// The point of a thread's axis at Z 0 [part coordinates].
    fn zero_of(&self, posted: &PostedPlan<'_>, thread: &PlannedThread) -> DVec3 {
        let [x, y] = thread.at;
        posted.to_part(&self.of.milling).point(DVec3::new(x, y, 0.0))
    }

    /// Looks for material in the way of the tap.
    pub(super) fn judged(&self, posted: &PostedPlan<'_>, found: &Found<'_>) -> Judged {
        let mut judged = Judged::default();
        for ((thread, probe), measured) in self.threads.iter().zip(&found.probes.points).zip(found.points) {
            let met = measured.first().map(|z| z - measured.height(self.zero_of(posted, thread)));
            match met.filter(|z| *z > self.of.bottom() + LEAST) {
                _ if measured.columns() == 0 => judged.tally.unmeasured += 1,
                None => judged.tally.good += 1,
                Some(z) => {
                    let [x, y] = thread.at;
                    let message = format!(
                        "{} at X{} Y{}: there is material in the core hole",
                        self.of.thread(),
                        short(x),
                        short(y)
                    );
                    let finding = Finding::error(Code::TAP_MEETS, message).value(z, "mm (Z)");
                    let help = "drill the core hole before it, as wide and as deep as the job says";
                    judged.findings.push((finding.help(help), probe.item));
                    judged.tally.bad += 1;
                }
            }
        }
        judged.tally.unmeasured += self.threads.len() - found.points.len();
        judged
    }
}

/// The claim about all threads of a job, and what it leaves out.
pub(super) fn sum_up(tallies: &[Tally], step: f64) -> (Option<Proof>, Option<String>) {
    let sum = |of: fn(&Tally) -> usize| tallies.iter().map(of).sum::<usize>();
    let (good, bad, unmeasured) = (sum(|t| t.good), sum(|t| t.bad), sum(|t| t.unmeasured));
    let threads = if good == 1 { "1 thread".to_owned() } else { format!("{good} threads") };
    let proof = (good > 0 && bad == 0).then(|| Proof {
        claim: format!("{threads}: the core hole is free down to the lowest point of the tap"),
        bound: format!("columns of the stock, {step} mm between them"),
    });
    (
        proof,
        (unmeasured > 0)
            .then(|| format!("core holes of {unmeasured} further threads: not measured in the stock")),
    )
}
