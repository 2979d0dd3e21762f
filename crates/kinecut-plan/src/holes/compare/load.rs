//! The load along a path: engagement angle, and the radial depth that it stands for.

use serde::Serialize;

use super::Terms;
use super::chain::Chain;
use crate::base::Result;
use crate::holes::engagement::engagement;

/// The load in one place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LoadSample {
    /// Arc length from the start of the clearing path [mm].
    pub s: f64,
    /// Engaged angle of the cutter [rad].
    pub angle: f64,
    /// Radial depth of cut [mm]: of the parallel wall that would engage the cutter as much.
    pub depth: f64,
}

/// The load along a path, the closing circle included.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Load {
    /// Largest angle [rad].
    pub most: f64,
    /// Mean angle over the length [rad].
    pub mean: f64,
    /// Place of the largest angle [mm].
    pub most_at: f64,
    /// Samples, evenly in arc length.
    pub samples: Vec<LoadSample>,
}

/// Places at which the load is measured.
const SAMPLES: usize = 700;

/// Radial depth [mm] of the wall parallel to the path that engages a cutter by `angle` [rad], on a path of signed
/// `curvature` [1/mm], positive where it turns away from the wall's side (counter-clockwise in a hole): the inverse of
/// [`crate::holes::engagement_formula`].
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::holes::{compare::radial_depth, engagement_formula};
/// let angle = engagement_formula(79.0, 20.0, 3.95);
/// assert!((radial_depth(1.0 / 79.0, 20.0, angle) - 3.95).abs() < 1e-12);
/// ```
pub fn radial_depth(curvature: f64, cutter: f64, angle: f64) -> f64 {
    let q = cutter * curvature;
    if !q.is_finite() {
        return 0.0;
    }
    let sine = (0.5 * angle).sin();
    let root = (1.0 + q * q + 2.0 * q * angle.cos()).clamp(0.0, f64::INFINITY).sqrt();
    let below = 1.0 + q + root;
    if below > 0.0 { (4.0 * cutter * sine * sine / below).clamp(0.0, 2.0 * cutter) } else { 2.0 * cutter }
}

/// The load of a clearing path that starts on the entry circle, run in full, or in the centre.
pub(super) fn load(chain: &Chain, terms: &Terms) -> Result<Load> {
    let opened = if terms.entry > 0.0 { Some(terms.entry + terms.cutter) } else { None };
    let hole = match (opened, terms.drilled) {
        (Some(a), Some(b)) => Some(if a > b { a } else { b }),
        (a, b) => a.or(b),
    };
    let samples: Vec<LoadSample> = engagement(&chain.curves, terms.cutter, hole, SAMPLES)?
        .iter()
        .map(|e| LoadSample {
            s: e.s,
            angle: e.angle,
            depth: radial_depth(e.curvature, terms.cutter, e.angle),
        })
        .collect();
    let mut most = LoadSample { s: 0.0, angle: 0.0, depth: 0.0 };
    let mut work = 0.0;
    for pair in samples.windows(2) {
        work += 0.5 * (pair[0].angle + pair[1].angle) * (pair[1].s - pair[0].s);
    }
    for sample in &samples {
        if sample.angle > most.angle {
            most = *sample;
        }
    }
    Ok(Load { most: most.angle, mean: work / chain.length(), most_at: most.s, samples })
}

impl Load {
    /// Angle at an arc length, between samples in proportion [rad].
    pub fn at(&self, s: f64) -> f64 {
        let i = self.samples.partition_point(|x| x.s < s);
        match (i.checked_sub(1).and_then(|i| self.samples.get(i)), self.samples.get(i)) {
            (Some(a), Some(b)) if b.s > a.s => a.angle + (b.angle - a.angle) * (s - a.s) / (b.s - a.s),
            (_, Some(b)) => b.angle,
            (Some(a), None) => a.angle,
            (None, None) => 0.0,
        }
    }
}
