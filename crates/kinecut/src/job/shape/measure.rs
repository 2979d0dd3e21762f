//! Ends of lines taken into the measure of a wanted surface.

use glam::DVec3;

use super::claim::{Claim, Side};
use super::wanted::Wanted;
use crate::operations::measured::{BoreMeasure, Worst};
use crate::operations::wanted::Wall;
use crate::stock::CutId;

impl BoreMeasure {
    /// Nothing measured yet.
    pub(super) fn of(bore: &Wanted<'_>) -> BoreMeasure {
        BoreMeasure {
            operation: bore.number,
            wanted_radius: matches!(bore.wall, Wall::Round { .. }).then(|| bore.wall.radius(bore.bottom)),
            wall: [f64::INFINITY, f64::NEG_INFINITY],
            floor: bore.floor.map(|_| [f64::INFINITY, f64::NEG_INFINITY]),
            ends: 0,
            left: Worst::default(),
            gouge: Worst::default(),
            replaced: false,
            of_edge: bore.wall.slope().is_some(),
        }
    }

    /// Takes an end in.
    pub(super) fn note(&mut self, claim: Claim, point: DVec3, cut: CutId) {
        let d = f64::from(claim.deviation);
        let widened = |[least, most]: [f64; 2]| [least.min(d), most.max(d)];
        match claim.side {
            Side::Wall => self.wall = widened(self.wall),
            Side::Floor => self.floor = self.floor.map(widened),
            Side::Within => return self.left.note(d, point, cut),
            // It is no place of the wanted surface.
            Side::Beside => {
                self.left.note(d, point, cut);
                return self.gouge.note(-d, point, cut);
            }
        }
        self.ends += 1;
        self.left.note(d, point, cut);
        self.gouge.note(-d, point, cut);
    }
}
