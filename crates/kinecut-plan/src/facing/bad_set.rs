//! Exit angles that leave a primary burr, with their weights.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::unit::Deg;
use crate::base::{Code, Finding, Result};

/// Exit angles that are bad, with what a millimetre of edge counts there. The exit angle is the angle from the edge's
/// direction (material on its right) to the tooth's velocity, counter-clockwise: 0 to pi.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::facing::BadSet;
/// let paper = BadSet::below(90f64.to_radians())?;
/// assert_eq!(paper.weight(1.5), 1.0);
/// assert_eq!(paper.weight(1.6), 0.0);
/// assert_eq!(paper.supplement().weight(1.6), 1.0);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BadSet {
    parts: Vec<BadPart>,
    layers: Vec<BadPart>,
}

/// An open interval of bad exit angles [rad]; in a file degrees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BadPart {
    /// Exit angles above this, degrees in a file,
    #[serde(with = "Deg")]
    #[schemars(example = 0)]
    pub from: f64,
    /// and below this are bad, degrees in a file.
    #[serde(with = "Deg")]
    #[schemars(example = 60)]
    pub to: f64,
    /// Weight: the cost of a millimetre of edge there; default 1.
    #[serde(default = "one")]
    pub weight: f64,
}

fn one() -> f64 {
    1.0
}

impl BadSet {
    /// Exit angles below the threshold, each counting 1: the paper's primary burr.
    ///
    /// # Errors
    /// As [`BadSet::new`].
    pub fn below(threshold: f64) -> Result<BadSet> {
        BadSet::new(vec![BadPart { from: 0.0, to: threshold, weight: 1.0 }])
    }

    /// The set of these intervals.
    ///
    /// # Errors
    /// `KC1001` unless the intervals lie within 0 to pi, do not overlap, and their weights are not negative.
    pub fn new(mut parts: Vec<BadPart>) -> Result<BadSet> {
        parts.sort_by(|a, b| a.from.total_cmp(&b.from));
        for (i, part) in parts.iter().enumerate() {
            let inside = part.from >= 0.0 && part.to <= PI && part.from < part.to;
            if !inside {
                return Err(Finding::error(
                    Code::FACE_CASE,
                    "bad exit angles lie between 0 and 180 degrees, the lesser first",
                )
                .value(if part.from >= 0.0 { part.to } else { part.from }.to_degrees(), "deg")
                .bound(180.0, "deg")
                .into());
            }
            if !(part.weight >= 0.0 && part.weight <= BadSet::MAX_WEIGHT) {
                return Err(Finding::error(Code::FACE_CASE, "the weight of an exit angle is out of range")
                    .value(part.weight, "")
                    .bound(BadSet::MAX_WEIGHT, "")
                    .into());
            }
            if i > 0 && part.from < parts[i - 1].to {
                return Err(Finding::error(Code::FACE_CASE, "intervals of bad exit angles overlap")
                    .value(part.from.to_degrees(), "deg")
                    .bound(parts[i - 1].to.to_degrees(), "deg")
                    .into());
            }
        }
        parts.retain(|p| p.weight > 0.0);
        Ok(BadSet::of(parts))
    }

    /// Of intervals that are ascending and do not overlap.
    fn of(parts: Vec<BadPart>) -> BadSet {
        BadSet { layers: layers(&parts), parts }
    }

    /// Largest weight: sums stay finite and exact enough.
    pub const MAX_WEIGHT: f64 = 1e6;

    /// The intervals, ascending, not overlapping.
    pub fn parts(&self) -> &[BadPart] {
        &self.parts
    }

    /// Intervals that lie over each other, whose weights add up to the weight of an angle: those that touch have one
    /// interval in common, with the lesser weight, so that the angle at which they touch is bad too.
    pub fn layers(&self) -> &[BadPart] {
        &self.layers
    }

    /// Weight of a millimetre of edge with this exit angle [rad]; 0 for a good one. Where two intervals touch it is the
    /// lesser of their weights.
    pub fn weight(&self, exit_angle: f64) -> f64 {
        self.layers.iter().filter(|p| p.from < exit_angle && exit_angle < p.to).map(|p| p.weight).sum()
    }

    /// The largest weight of the set.
    pub fn largest_weight(&self) -> f64 {
        self.parts.iter().fold(0.0, |w, p| if p.weight > w { p.weight } else { w })
    }

    /// The set on the other side of the velocity: an angle is bad in it when pi minus the angle was. For sources that
    /// draw the exit angle from the opposite direction of the edge.
    #[must_use]
    pub fn supplement(&self) -> BadSet {
        let flipped =
            self.parts.iter().rev().map(|p| BadPart { from: PI - p.to, to: PI - p.from, weight: p.weight });
        BadSet::of(flipped.collect())
    }

    /// The set of angles that are at most `guard` [rad] from a bad one, each counting what the worst one within the
    /// guard counts: what set-up errors up to the guard can make bad. Its angles reach from `-guard` to `pi + guard`.
    #[must_use]
    pub fn guarded(&self, guard: f64) -> BadSet {
        if !(guard > 0.0) {
            return self.clone();
        }
        let wide: Vec<BadPart> = self
            .parts
            .iter()
            .map(|p| BadPart { from: p.from - guard, to: p.to + guard, weight: p.weight })
            .collect();
        let mut cuts: Vec<f64> = wide.iter().flat_map(|p| [p.from, p.to]).collect();
        cuts.sort_by(f64::total_cmp);
        let mut parts: Vec<BadPart> = Vec::new();
        for w in cuts.windows(2).filter(|w| w[1] > w[0]) {
            let middle = 0.5 * (w[0] + w[1]);
            let worst = wide.iter().filter(|p| p.from < middle && middle < p.to);
            let weight = worst.fold(0.0, |a, p| if p.weight > a { p.weight } else { a });
            match parts.last_mut() {
                Some(last) if last.to == w[0] && last.weight == weight => last.to = w[1],
                _ if weight > 0.0 => parts.push(BadPart { from: w[0], to: w[1], weight }),
                _ => {}
            }
        }
        BadSet::of(parts)
    }
}

/// The layers of intervals that are ascending and do not overlap: of each run of intervals that touch, one over all of it
/// with the least weight, and the layers of what is left.
fn layers(parts: &[BadPart]) -> Vec<BadPart> {
    let mut out = Vec::new();
    for run in parts.chunk_by(|a, b| a.to == b.from) {
        let least = run.iter().fold(f64::INFINITY, |w, p| if p.weight < w { p.weight } else { w });
        out.push(BadPart { from: run[0].from, to: run[run.len() - 1].to, weight: least });
        let rest: Vec<BadPart> = run
            .iter()
            .map(|p| BadPart { weight: p.weight - least, ..*p })
            .filter(|p| p.weight > 0.0)
            .collect();
        out.extend(layers(&rest));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_guard_takes_the_worst_angle_within_reach() {
        let part = |from, to, weight| BadPart { from, to, weight };
        let set = BadSet::new(vec![part(1.0, 2.0, 1.0), part(0.0, 0.5, 3.0), part(2.0, 2.5, 2.0)]).unwrap();
        let wide = set.guarded(0.1);
        for k in 0..3000 {
            let angle = -0.3 + 0.0011 * f64::from(k);
            let around = (-100..=100).map(|j| set.weight(angle + 0.000_999_99 * f64::from(j)));
            let worst = around.fold(0.0, f64::max);
            // Samples are 0.001 apart: angles that near to an end are not compared.
            let near_end =
                wide.parts().iter().any(|p| (p.from - angle).abs() < 2e-3 || (p.to - angle).abs() < 2e-3);
            assert!(near_end || wide.weight(angle) == worst, "{angle}");
        }
        assert_eq!(BadSet::below(1.0).unwrap().guarded(0.1).parts(), [part(-0.1, 1.1, 1.0)]);
    }

    #[test]
    fn intervals_that_touch_leave_no_good_angle_between() {
        let part = |from, to, weight| BadPart { from, to, weight };
        let set = BadSet::new(vec![
            part(0.0, 0.5, 2.0),
            part(0.5, 1.0, 1.0),
            part(1.0, 1.5, 4.0),
            part(1.7, 2.0, 3.0),
        ])
        .unwrap();
        assert_eq!([0.5, 1.0, 1.5, 1.7].map(|a| set.weight(a)), [1.0, 1.0, 0.0, 0.0]);
        assert_eq!([0.25, 0.75, 1.25, 1.6, 1.8].map(|a| set.weight(a)), [2.0, 1.0, 4.0, 0.0, 3.0]);
        assert_eq!(
            set.layers(),
            [part(0.0, 1.5, 1.0), part(0.0, 0.5, 1.0), part(1.0, 1.5, 3.0), part(1.7, 2.0, 3.0)]
        );
        // Halves of one interval are the interval.
        let halves = BadSet::new(vec![part(0.0, 0.5, 1.0), part(0.5, 1.0, 1.0)]).unwrap();
        assert_eq!(halves.layers(), [part(0.0, 1.0, 1.0)]);
        // The guard widens the first to 0.6, where it touches the second.
        assert_eq!([0.55, 0.6, 0.65].map(|a| set.guarded(0.1).weight(a)), [2.0, 1.0, 1.0]);
        let flipped = halves.supplement();
        assert_eq!(flipped.weight(PI - 0.5), 1.0);
    }

    #[test]
    fn sets_that_make_no_sense_are_refused() {
        let part = |from, to, weight| BadPart { from, to, weight };
        for bad in [
            part(-0.1, 1.0, 1.0),
            part(0.0, 3.2, 1.0),
            part(1.0, 1.0, 1.0),
            part(0.0, 1.0, -1.0),
            part(f64::NAN, 1.0, 1.0),
            part(0.0, 1.0, f64::NAN),
        ] {
            assert_eq!(BadSet::new(vec![bad]).unwrap_err().code(), Code::FACE_CASE);
        }
        assert!(BadSet::new(vec![part(0.0, 1.0, 1.0), part(0.9, 2.0, 1.0)]).is_err());
    }
}
