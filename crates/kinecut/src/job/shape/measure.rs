//! What was measured of each wanted surface.

use glam::DVec3;

use super::claim::{Claim, Side};
use super::wall::Wall;
use super::wanted::Wanted;
use crate::stock::CutId;

/// What was measured of one bore.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoreMeasure {
    /// Number of the operation over all setups.
    pub operation: u32,
    /// Wanted radius at the bottom [mm], of a round wall: without the allowance, if the operation does not finish.
    pub wanted_radius: Option<f64>,
    /// Least and greatest distance of the wall found inside of the wanted one [mm]: positive where stock is left.
    pub wall: [f64; 2],
    /// Least and greatest height of the floor above the wanted one [mm]; `None` for a bore that goes through.
    pub floor: Option<[f64; 2]>,
    /// Number of line ends measured.
    pub ends: usize,
    /// Worst stock left [mm], where, and by which cut.
    pub left: Worst,
    /// Worst gouge [mm], where, and by which cut.
    pub gouge: Worst,
    /// Whether other operations cut away all of what this one wanted: then there is nothing to measure.
    pub replaced: bool,
}

/// The worst of many deviations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// Deviation [mm], not negative.
    pub depth: f64,
    /// Where [part coordinates].
    pub point: DVec3,
    /// The cut.
    pub cut: CutId,
}

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
        }
    }

    /// Least and greatest radius found [mm], of a round wall that was measured; of a conical one as at the bottom.
    pub fn radius(&self) -> Option<[f64; 2]> {
        let wanted = self.wanted_radius.filter(|_| self.wall[0].is_finite())?;
        Some([wanted - self.wall[1], wanted - self.wall[0]])
    }

    /// The larger of stock left and gouge [mm].
    pub fn worst(&self) -> f64 {
        self.left.depth.max(self.gouge.depth)
    }

    /// Takes an end in.
    pub(super) fn note(&mut self, claim: Claim, point: DVec3, cut: CutId) {
        let d = f64::from(claim.deviation);
        let widened = |[least, most]: [f64; 2]| [least.min(d), most.max(d)];
        match claim.side {
            Side::Wall => self.wall = widened(self.wall),
            Side::Floor => self.floor = self.floor.map(widened),
            Side::Within => return self.left.note(d, point, cut),
        }
        self.ends += 1;
        self.left.note(d, point, cut);
        self.gouge.note(-d, point, cut);
    }
}

impl Worst {
    pub(in crate::job) fn note(&mut self, depth: f64, point: DVec3, cut: CutId) {
        if depth > self.depth {
            *self = Worst { depth, point, cut };
        }
    }
}
