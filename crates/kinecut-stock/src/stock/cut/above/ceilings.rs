//! Ceilings of the ways between lines that are farther apart.

use std::sync::Arc;

use rayon::prelude::*;

use super::field::{Field, OWN};
use super::patch::{Known, PatchCeilings, SIDE};

/// The ceilings of all ways of a grid, by patch.
pub(super) struct KeptCeilings<'a> {
    pub(super) ceilings: &'a [Known],
    /// Number of patches along the first direction.
    pub(super) across: usize,
    /// Ceiling where none is known: above all material [mm].
    pub(super) highest: f64,
}

impl KeptCeilings<'_> {
    /// Ceiling of the way along the direction `k` to a line from the one before it; rounded upwards.
    fn of_way(&self, k: usize, [a, b]: [i64; 2]) -> f32 {
        let patch = (b / OWN) as usize * self.across + (a / OWN) as usize;
        let at = (b % OWN + 1) as usize * SIDE + (a % OWN + 1) as usize;
        let none = (self.highest as f32).next_up();
        self.ceilings[patch].as_ref().map_or(none, |ceilings| ceilings[k][at])
    }

    /// By patch of sparse lines, the ceilings of the ways between these: the greatest along each.
    pub(super) fn sparse(&self, field: &Field) -> Vec<Known> {
        let [columns, rows] = field.patches();
        (0..columns * rows).into_par_iter().map(|patch| Some(Arc::new(self.of_patch(field, patch)))).collect()
    }

    fn of_patch(&self, field: &Field, patch: usize) -> PatchCeilings {
        let mut all = [[f32::NEG_INFINITY; SIDE * SIDE]; 2];
        let first = field.first(patch);
        for r in 1..SIDE {
            for c in 1..SIDE {
                let (a, b) = (first[0] + c as i64, first[1] + r as i64);
                for (k, all) in all.iter_mut().enumerate().filter(|(k, _)| field.has_way(*k, a, b)) {
                    let along = if k == 0 { a } else { b };
                    let across = field.in_whole(1 - k, if k == 0 { b } else { a });
                    let ways = field.ways(k, along);
                    let ceiling =
                        |way: i64| self.of_way(k, if k == 0 { [way, across] } else { [across, way] });
                    all[r * SIDE + c] = ways.map(ceiling).fold(f32::NEG_INFINITY, f32::max);
                }
            }
        }
        all
    }
}
