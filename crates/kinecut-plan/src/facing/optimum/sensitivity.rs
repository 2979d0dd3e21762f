//! Effect of set-up errors on a placement.

use rayon::prelude::*;

use super::domain::Domain;
use super::{Options, PlacementSensitivity};
use crate::facing::{FaceCase, Placement, bad_length};
use crate::num::angle::wrap;

/// Samples to either side, of the angle and of the offset.
const SIDE: i32 = 5;
/// Sine of the angle to the feed below which an edge is said to be parallel to it.
const PARALLEL: f64 = 1e-9;

/// The worst value within the errors of set-up, by samples that hold the corners, the middle, and just past either side
/// of it, where edges parallel to the feed flip.
pub(super) fn sensitivity(
    case: &FaceCase,
    domain: &Domain,
    options: &Options,
    at: Placement,
) -> PlacementSensitivity {
    let [angle, offset] = options.set_up_error;
    let flip = if angle > FLIP { FLIP } else { angle };
    let mut angles: Vec<f64> = (-SIDE..=SIDE).map(|k| angle * f64::from(k) / f64::from(SIDE)).collect();
    angles.extend([-flip, flip]);
    let local = domain.local(at);
    let worst = angles
        .par_iter()
        .flat_map_iter(|&da| {
            (-SIDE..=SIDE).map(move |k| {
                let place = domain.placement(at.angle + da, local + offset * f64::from(k) / f64::from(SIDE));
                (bad_length(case, place), place)
            })
        })
        .collect::<Vec<_>>();
    let worst = worst.into_iter().fold((bad_length(case, at), at), |a, b| if b.0 > a.0 { b } else { a });
    let parallel = |e: usize| {
        let edge = &case.outline.edges()[e];
        edge.turn.is_none() && wrap(edge.heading(0.0) + at.angle).sin().abs() < PARALLEL
    };
    PlacementSensitivity {
        worst: worst.0,
        worst_at: worst.1,
        feed_parallel: (0..case.outline.edges().len()).filter(|&e| parallel(e)).collect(),
    }
}

/// A turn that flips edges and moves nothing else [rad].
const FLIP: f64 = 1e-7;
