//! The bad length that real teeth leave.

use std::f64::consts::FRAC_PI_2;

use super::{Crossing, ToothedPass};
use crate::base::Result;
use crate::facing::{FaceCase, Sweep, bad_stretches};
use crate::num::angle::wrap;

/// What a pass of real teeth does to the edges in one half of the cutter. All lengths are weighted with the edges'
/// weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothedLengths {
    /// Edge with bad exits, weighted with the exit angle's weight too [mm].
    pub bad: f64,
    /// Edge where teeth leave the material, at whatever angle [mm].
    pub exits: f64,
    /// Edge where teeth enter [mm].
    pub entries: f64,
    /// Edge that no tooth crosses in this half: what is bad of it is taken from the limit of many teeth [mm].
    pub uncrossed: f64,
}

/// The lengths of edge that real teeth leave in one half of the cutter. On each edge the crossings of that half,
/// entries and exits, are sorted; each owns the edge up to the middles towards its neighbours.
///
/// The paper counts the edges on which a bad exit lies; a length of single points it does not define.
///
/// ```
/// use glam::dvec2;
/// use kinecut::facing::{BadSet, FaceCase, Placement, Sweep, ToothedPass, bad_length, toothed_lengths};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)])?;
/// let case = FaceCase::new(plate, 50.0, BadSet::below(90f64.to_radians())?)?;
/// let placement = Placement { angle: 0.3, offset: 45.0 };
/// let pass = ToothedPass::even(6, 50.0, 0.05, placement)?;
/// let toothed = toothed_lengths(&case, &pass, Sweep::Front)?;
/// assert!((toothed.bad - bad_length(&case, placement)).abs() < 0.1);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
///
/// # Errors
/// `KC1001` for too many crossings on the outline, see [`ToothedPass::crossings`].
pub fn toothed_lengths(case: &FaceCase, pass: &ToothedPass, sweep: Sweep) -> Result<ToothedLengths> {
    let all = pass.crossings(&case.outline)?;
    Ok(lengths_of(case, pass, sweep, &all))
}

/// The same of crossings that are already there.
pub(super) fn lengths_of(
    case: &FaceCase,
    pass: &ToothedPass,
    sweep: Sweep,
    crossings: &[Crossing],
) -> ToothedLengths {
    let edges = case.outline.edges();
    let mut on_edge: Vec<Vec<&Crossing>> = vec![Vec::new(); edges.len()];
    for crossing in crossings.iter().filter(|c| c.front == (sweep == Sweep::Front)) {
        on_edge[crossing.edge as usize].push(crossing);
    }
    let mut lengths = ToothedLengths { bad: 0.0, exits: 0.0, entries: 0.0, uncrossed: 0.0 };
    for ((edge, &weight), here) in edges.iter().zip(&case.weights).zip(&mut on_edge) {
        let length = edge.length() * weight;
        if here.is_empty() {
            lengths.uncrossed += length;
            bad_stretches(edge, case, pass.placement, sweep, pass.rho(case), |b| {
                lengths.bad += (b.to - b.from) * b.weight * length;
            });
            continue;
        }
        here.sort_by(|a, b| a.share.total_cmp(&b.share));
        for (i, crossing) in here.iter().enumerate() {
            let from = if i > 0 { 0.5 * (here[i - 1].share + crossing.share) } else { 0.0 };
            let to = here.get(i + 1).map_or(1.0, |next| 0.5 * (crossing.share + next.share));
            let owned = (to - from) * length;
            if crossing.exit {
                lengths.exits += owned;
            } else {
                lengths.entries += owned;
            }
            // A guard reaches a little beyond 0 and pi.
            let angle = wrap(crossing.exit_angle() - FRAC_PI_2) + FRAC_PI_2;
            lengths.bad += owned * case.bad.weight(angle);
        }
    }
    lengths
}
