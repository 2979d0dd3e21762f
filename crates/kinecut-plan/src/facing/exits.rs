//! The stretches of the outline under a straight pass, in the limit of many teeth: entry, exit, bad exit, with its exit
//! angles.

use std::f64::consts::{FRAC_PI_2, PI};

use serde::Serialize;

use super::limit::{exit_angle, stretches_in};
use super::{BadPart, BadStretch, FaceCase, Placement, Sweep};
use crate::geom::OutlineEdge;

/// A stretch of an edge under the front of the cutter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ExitStretch {
    /// Index of the edge.
    pub edge: usize,
    /// Share of the edge's length where it begins.
    pub from: f64,
    /// Share of the edge's length where it ends.
    pub to: f64,
    /// Least and largest exit angle on it, 0 to pi [rad].
    pub exit_angles: [f64; 2],
    /// Weight of a millimetre for its exit angle, without the edge's own weight; 0 for a good exit.
    pub weight: f64,
}

/// The stretches of the outline on which teeth leave the material, edge after edge, from share to share; bad ones
/// have a weight. On the rest of what the cutter covers, teeth enter.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::{BadSet, FaceCase, Placement, exit_stretches};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)])?;
/// let case = FaceCase::new(plate, 50.0, BadSet::below(90f64.to_radians())?)?;
/// let exits = exit_stretches(&case, Placement { angle: 0.0, offset: 30.0 });
/// // The side on the right of the feed at 53 degrees, the far end above the centre line, the near end below it.
/// assert_eq!(exits.len(), 3);
/// let bad: Vec<_> = exits.iter().filter(|e| e.weight > 0.0).collect();
/// assert_eq!(bad.len(), 2);
/// assert!(bad.iter().any(|e| (e.exit_angles[0].to_degrees() - 53.13).abs() < 0.01 && e.to - e.from == 1.0));
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn exit_stretches(case: &FaceCase, placement: Placement) -> Vec<ExitStretch> {
    // Cutting all exits at the ends of the bad intervals makes each stretch bad or not.
    let mut bounds: Vec<f64> = case.bad.parts().iter().flat_map(|p| [p.from, p.to]).collect();
    bounds.extend([0.0, PI]);
    bounds.retain(|b| (0.0..=PI).contains(b));
    bounds.sort_by(f64::total_cmp);
    bounds.dedup();
    let mut stretches = Vec::new();
    for (index, edge) in case.outline.edges().iter().enumerate() {
        let first = stretches.len();
        for w in bounds.windows(2) {
            let weight = case.bad.weight(0.5 * (w[0] + w[1]));
            let part = BadPart { from: w[0], to: w[1], weight };
            stretches_in(edge, case.radius, placement, part, Sweep::Front, 0.0, &mut |b: BadStretch| {
                let exit_angles = angles(edge, case, placement, [b.from, b.to]);
                stretches.push(ExitStretch { edge: index, from: b.from, to: b.to, exit_angles, weight });
            });
        }
        stretches[first..].sort_by(|a: &ExitStretch, b| a.from.total_cmp(&b.from));
    }
    stretches
}

/// The least and largest exit angle between two places of an edge where all teeth leave.
fn angles(edge: &OutlineEdge, case: &FaceCase, placement: Placement, ends: [f64; 2]) -> [f64; 2] {
    let mut angles = [f64::INFINITY, f64::NEG_INFINITY];
    let mut at = |share: f64| {
        // Rounding may take an end beyond 0 or pi.
        let psi = as_exit(exit_angle(edge, share, case.radius, placement)).clamp(0.0, PI);
        angles =
            [if psi < angles[0] { psi } else { angles[0] }, if psi > angles[1] { psi } else { angles[1] }];
    };
    at(ends[0]);
    at(ends[1]);
    if let Some(turn) = edge.turn {
        // The polar angle on the cutter and the normal's direction turn alike where
        // arc^2 cos^2(phi) = R^2 - (rise + arc sin(phi))^2.
        let (sin, cos) = placement.angle.sin_cos();
        let rise = sin * turn.centre.x + cos * turn.centre.y - placement.offset;
        let s = (case.radius * case.radius - rise * rise - turn.radius * turn.radius)
            / (2.0 * rise * turn.radius);
        if s.abs() <= 1.0 {
            for phi in [s.asin(), PI - s.asin()] {
                let gone = (phi - placement.angle - turn.from) * turn.sweep.signum();
                let share = crate::num::angle::wrap_positive(gone) / turn.sweep.abs();
                if ends[0] < share && share < ends[1] {
                    at(share);
                }
            }
        }
    }
    angles
}

/// The largest exit angle of a placement [rad], which the paper plots over the orientation; 0 without exits.
pub fn largest_exit_angle(case: &FaceCase, placement: Placement) -> f64 {
    let stretches = exit_stretches(case, placement);
    stretches.iter().fold(0.0, |a, s| if s.exit_angles[1] > a { s.exit_angles[1] } else { a })
}

/// An exit angle as bad sets hold it, between -pi/2 and 3 pi/2.
pub(super) fn as_exit(angle: f64) -> f64 {
    crate::num::angle::wrap(angle - FRAC_PI_2) + FRAC_PI_2
}
