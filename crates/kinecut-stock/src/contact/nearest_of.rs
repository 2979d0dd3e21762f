//! The nearest pass of each pair among many moves.

use std::collections::BTreeMap;

/// Difference of two distances that counts as none [mm]: of those that are as near the first counts.
const AS_NEAR: f64 = 2e-3;

/// The nearest pass of each pair, and its distance [mm].
#[derive(Clone, Debug)]
pub(super) struct NearestOf<K, T>(BTreeMap<K, (f64, T)>);

impl<K: Ord + Copy, T> NearestOf<K, T> {
    pub(super) fn new() -> NearestOf<K, T> {
        NearestOf(BTreeMap::new())
    }

    /// Distance below which a pass of a pair has to be looked for, if those up to `near` count [mm].
    pub(super) fn open(&self, pair: K, near: f64) -> f64 {
        self.0.get(&pair).map_or(near, |(distance, _)| near.min(distance - AS_NEAR))
    }

    /// Notes a pass; those before it were in earlier moves.
    pub(super) fn note(&mut self, pair: K, distance: f64, pass: T) {
        if self.open(pair, f64::INFINITY) > distance {
            self.0.insert(pair, (distance, pass));
        }
    }

    /// Notes all passes of later moves.
    pub(super) fn join(&mut self, later: NearestOf<K, T>) {
        for (pair, (distance, pass)) in later.0 {
            self.note(pair, distance, pass);
        }
    }

    /// The passes, by pair.
    pub(super) fn into_passes(self) -> impl Iterator<Item = T> {
        self.0.into_values().map(|(_, pass)| pass)
    }
}
