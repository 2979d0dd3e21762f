//! The bad length that real teeth leave.

use serde::Serialize;

use super::ToothedPass;
use super::pass::next_edge;
use crate::base::Result;
use crate::facing::exits::as_exit;
use crate::facing::{FaceCase, Sweep, bad_stretches};

/// Effect of a pass of real teeth on the edges in one half of the cutter. All lengths are weighted with the edges'
/// weights.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ToothedLengths {
    /// Edge with bad exits, weighted with the exit angle's weight too [mm].
    pub bad: f64,
    /// Edge where teeth enter [mm].
    pub entries: f64,
    /// Edge where teeth leave the material, at whatever angle [mm].
    pub exits: f64,
    /// Edge that no tooth crosses in this half: what is bad of it is taken from the limit of many teeth [mm].
    pub uncrossed: f64,
}

/// The lengths of edge that real teeth leave in one half of the cutter. On each edge the crossings of that half,
/// entries and exits, are sorted; each owns the edge up to the middles towards its neighbours.
///
/// The paper counts the edges on which a bad exit lies; a length of single points it does not define.
///
/// ```
/// # use kinecut_plan as kinecut;
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
/// As [`ToothedPass::crossings`].
pub fn toothed_lengths(case: &FaceCase, pass: &ToothedPass, sweep: Sweep) -> Result<ToothedLengths> {
    pass.few(&case.outline)?;
    let halves = [sweep == Sweep::Front, sweep == Sweep::Back];
    let mut lengths = ToothedLengths { bad: 0.0, exits: 0.0, entries: 0.0, uncrossed: 0.0 };
    let (mut pieces, mut here) = (Vec::new(), Vec::new());
    for (index, (edge, &weight)) in case.outline.edges().iter().zip(&case.weights).enumerate() {
        let length = edge.length() * weight;
        here.clear();
        let next = next_edge(&case.outline, index);
        pass.visit_edge(&case.outline, [index, next], halves, &mut pieces, &mut |c| {
            // A guard reaches a little beyond 0 and pi.
            here.push((c.share, c.exit, case.bad.weight(as_exit(c.exit_angle()))));
        });
        if here.is_empty() {
            lengths.uncrossed += length;
            bad_stretches(edge, case, pass.placement, sweep, pass.rho(case), |b| {
                lengths.bad += (b.to - b.from) * b.weight * length;
            });
            continue;
        }
        here.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (i, &(share, exit, bad)) in here.iter().enumerate() {
            let from = if i > 0 { 0.5 * (here[i - 1].0 + share) } else { 0.0 };
            let to = here.get(i + 1).map_or(1.0, |next| 0.5 * (share + next.0));
            let owned = (to - from) * length;
            if exit {
                lengths.exits += owned;
            } else {
                lengths.entries += owned;
            }
            lengths.bad += owned * bad;
        }
    }
    Ok(lengths)
}
