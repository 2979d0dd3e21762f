//! Pairs that are far enough from each other for many short moves: one distance serves all of them.
//!
//! Where two bodies are known to be apart in one pose, they are apart by no less than that distance less the way that any point of the
//! moving one has gone since. Only when that is used up the distance is sought again.

use std::collections::BTreeMap;

use super::motion::{Moment, Motion, Standing};
use super::pair::{Pair, TOUCH};
use crate::geom::Rigid;

/// Ways of the present move that a new distance is sought for, if there is room.
const AHEAD: f64 = 32.0;
/// Greatest distance that is sought beyond the one that is needed [mm].
const MOST_AHEAD: f64 = 50.0;
/// A distance that serves fewer moves than this is not worth it ...
const LEAST_MOVES: f64 = 4.0;
/// ... and is not sought for so many moves.
const REST: u32 = 16;
/// The accuracy of distances [mm], with room.
const ACCURACY: f64 = 2e-3;

/// Known distances of pairs.
#[derive(Debug)]
pub(super) struct Clearances<K>(BTreeMap<K, Known>);

#[derive(Clone, Copy, Debug)]
struct Known {
    pose: Rigid,
    /// They are not nearer than this in that pose [mm].
    distance: f64,
    /// Moves for which it is not sought.
    rest: u32,
}

impl<K: Ord + Copy> Clearances<K> {
    pub(super) fn new() -> Clearances<K> {
        Clearances(BTreeMap::new())
    }

    /// Whether a pair is known to stay farther apart than `open` [mm], and does not touch, in a move.
    pub(super) fn clear<M: Motion>(
        &mut self,
        key: K,
        pair: &Pair<'_, M>,
        ends: &[Moment; 2],
        open: f64,
    ) -> bool {
        let ball = &pair.moving.ball;
        let needed = open.max(TOUCH) + ACCURACY;
        let start = ends[0].pose;
        let travel = ball.travel(&start, &ends[1].pose) + pair.motion.room(ends[0].t, ends[1].t, ball);
        if let Some(known) = self.0.get_mut(&key) {
            if known.distance - ball.travel(&known.pose, &start) - travel > needed {
                return true;
            }
            known.rest = known.rest.saturating_sub(1);
            if known.rest > 0 {
                return false;
            }
        }
        let ahead = AHEAD * travel;
        if ahead > MOST_AHEAD {
            return false;
        }
        let resting = Pair { motion: &Standing(start), moving: pair.moving, standing: pair.standing };
        let here = [Moment { t: 0.0, pose: start }; 2];
        let reach = needed + ahead;
        let distance = match resting.within(&here) {
            Some(_) => 0.0,
            None => resting.nearest(&here, reach).map_or(reach, |found| found.distance - ACCURACY),
        };
        let rest = if distance - needed < LEAST_MOVES * travel { REST } else { 0 };
        self.0.insert(key, Known { pose: start, distance, rest });
        distance - travel > needed
    }
}
