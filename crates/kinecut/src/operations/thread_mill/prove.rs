//! Whether the posted text mills the wanted threads: its helices are read back and compared, point by point.
//!
//! Radius, pitch, hand, direction, height and phase are those of the points; the pitch diameter follows by the envelope of
//! [`Cut`](super::envelope::Cut), with the numbers of the standards written down here. Shared with the planner are the thread and
//! the tool as the job has them, the value of the wear register, which moves of the program are helices and which of them finish,
//! and the list of helices by their places.

use super::PlannedThreadMilling;
use super::posted::PostedHelix;
use super::wanted::Wanted;
use crate::base::{Code, Finding};
use crate::operations::measured::Proof;
use crate::operations::{Judged, PostedPlan, Tally};
use crate::page::fixed;

/// Compares all helices; the largest deviation of the pitch diameter where all are right and it follows from them [mm].
pub(super) fn judged(plan: &PlannedThreadMilling, posted: &PostedPlan<'_>) -> (Judged, Option<f64>) {
    let mut judged = Judged::default();
    let wanted = Wanted::of(plan);
    let found = PostedHelix::all(plan, posted);
    let runs = &plan.plan.runs;
    let places = &plan.of.places;
    let start = found.first().map_or(plan.items.start, |h| h.item);
    if let Some(finding) = surplus(&plan.of.thread_name(), found.len(), runs.len()) {
        judged.tally.bad = places.len();
        judged.findings.push((finding, start));
        return (judged, None);
    }
    for (place, at) in places.iter().enumerate() {
        let name = plan.of.at(at.at);
        let own = |of: usize| of == place;
        let helices: Vec<&PostedHelix> =
            runs.iter().zip(&found).filter(|(run, _)| own(run.place)).map(|(_, helix)| helix).collect();
        let missing = runs.iter().filter(|run| own(run.place)).count() != helices.len();
        match wanted.compared(at.at.into(), &helices) {
            Ok(_) if missing => {
                judged.tally.bad += 1;
                let message = format!("{name}: the text lacks a helix of it");
                judged.findings.push((Finding::error(Code::THREAD_FORM, message), start));
            }
            Ok(worst) if wanted.by_envelope => {
                judged.tally.good += 1;
                judged.tally.worst = judged.tally.worst.max(worst);
            }
            // What the maker corrected in the profile is not known here.
            Ok(_) => judged.tally.unmeasured += 1,
            Err(wrong) => {
                judged.tally.bad += 1;
                judged.findings.push((wrong.finding(&name), wrong.item.unwrap_or(start)));
            }
        }
    }
    let deviation = (judged.tally.bad == 0 && wanted.by_envelope).then_some(judged.tally.worst);
    (judged, deviation)
}

/// A finding where the text has more helices than the plan.
fn surplus(thread: &str, found: usize, planned: usize) -> Option<Finding> {
    (found > planned).then(|| {
        let message = format!("{thread}: the text has {found} helices, the plan {planned}");
        Finding::error(Code::THREAD_FORM, message).value(found as f64, "").bound(planned as f64, "")
    })
}

/// The claim about all milled threads of a job, and what it leaves out.
pub(super) fn sum_up(tallies: &[Tally]) -> (Option<Proof>, Option<String>) {
    let sum = |of: fn(&Tally) -> usize| tallies.iter().map(of).sum::<usize>();
    let (good, bad, unmeasured) = (sum(|t| t.good), sum(|t| t.bad), sum(|t| t.unmeasured));
    let threads = |count: usize| {
        if count == 1 { "1 milled thread".to_owned() } else { format!("{count} milled threads") }
    };
    let unchecked = (unmeasured > 0).then(|| {
        format!(
            "pitch diameter of {}: it depends on the profile that the maker corrected; gauge the first thread",
            threads(unmeasured)
        )
    });
    if good + unmeasured == 0 || bad > 0 {
        return (None, unchecked);
    }
    let worst = tallies.iter().map(|t| t.worst).fold(0.0, f64::max);
    let within = format!("within {} \u{b5}m", fixed((worst * 1e4).ceil() * 0.1, 1));
    let diameter = match (good, unmeasured) {
        (0, _) => String::new(),
        (_, 0) => format!(", and by the envelope of straight flanks its pitch diameter {within}"),
        _ => format!("; {good} of them by the envelope of straight flanks its pitch diameter {within}"),
    };
    let proof = Proof {
        claim: format!(
            "{}: the helix of the text has the pitch, hand, direction and depth of the thread{diameter}",
            threads(good + unmeasured)
        ),
        bound:
            "points of each helix, 64 a turn; for the profile and diameter of the tool that the job states, and, where a wear register is used, for its value there"
                .to_owned(),
    };
    (Some(proof), unchecked)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn helices_beyond_the_plan_are_counted() {
        assert!(surplus("M8", 2, 2).is_none() && surplus("M8", 1, 2).is_none());
        let finding = surplus("M8x1.25", 3, 2).unwrap();
        assert_eq!(finding.code, Code::THREAD_FORM);
        assert_eq!(finding.message, "M8x1.25: the text has 3 helices, the plan 2");
    }

    #[test]
    fn a_pitch_diameter_is_claimed_only_where_it_follows() {
        let tally = |good, bad, unmeasured| Tally { good, bad, unmeasured, worst: 0.0004 };
        let claim = |tallies: &[Tally]| {
            let (proof, unchecked) = sum_up(tallies);
            (proof.map(|p| p.claim).unwrap_or_default(), unchecked.unwrap_or_default())
        };
        let (all, left) = claim(&[tally(2, 0, 0)]);
        assert!(
            all.starts_with("2 milled threads: ") && all.ends_with("its pitch diameter within 0.4 \u{b5}m")
        );
        assert_eq!(left, "");
        let (none, left) = claim(&[tally(0, 0, 1)]);
        assert!(none.ends_with("depth of the thread") && !none.contains("pitch diameter"), "{none}");
        assert!(
            left.starts_with("pitch diameter of 1 milled thread: ")
                && left.ends_with("gauge the first thread")
        );
        let (some, left) = claim(&[tally(2, 0, 0), tally(0, 0, 3)]);
        assert!(
            some.starts_with("5 milled threads: ") && some.contains("; 2 of them by the envelope"),
            "{some}"
        );
        assert!(left.starts_with("pitch diameter of 3 milled threads: "), "{left}");
        let (bad, left) = claim(&[tally(2, 1, 0), tally(0, 0, 3)]);
        assert!(bad.is_empty() && !left.is_empty());
    }
}
