//! Rank of the motions that joints give a tool.

use glam::DVec3;

use super::Hold;

/// Number of independent motions of the tip and of what matters of its frame, angles weighed by `arm` [mm], from the
/// velocities of the tip and the turns of each joint. Modified Gram and Schmidt with the longest rest first.
pub(super) fn rank(rates: impl Iterator<Item = (DVec3, DVec3)>, hold: Hold, axis: DVec3, arm: f64) -> usize {
    let mut rest: Vec<(DVec3, DVec3)> = rates
        .map(|(shift, turn)| match hold {
            Hold::Point => (shift, DVec3::ZERO),
            Hold::Axis => (shift, (turn - axis * axis.dot(turn)) * arm),
            Hold::Frame => (shift, turn * arm),
        })
        .collect();
    let dot = |a: &(DVec3, DVec3), b: &(DVec3, DVec3)| a.0.dot(b.0) + a.1.dot(b.1);
    let longest = |rest: &[(DVec3, DVec3)]| {
        rest.iter().enumerate().map(|(i, r)| (dot(r, r), i)).max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let Some((scale, _)) = longest(&rest) else { return 0 };
    let mut rank = 0;
    while let Some((squared, i)) = longest(&rest) {
        if !(squared > scale * DEPENDENT) {
            break;
        }
        rank += 1;
        let unit = rest.swap_remove(i);
        for r in &mut rest {
            let share = dot(&unit, r) / squared;
            *r = (r.0 - unit.0 * share, r.1 - unit.1 * share);
        }
    }
    rank
}

/// Square of the relative length at which a motion is lost in the others.
const DEPENDENT: f64 = 1e-14;
