//! Measures of an operation in the simulated stock: walls, floors and faces at the ends of its lines, the engagement of
//! a point, the walls before a face; and the cores that leave the stock.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::geom::EdgeProfile;
use crate::page::micrometres;
use crate::stock::CutId;

/// Measures of one wanted wall.
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
    /// Whether it is the break of an edge, or a piece of it: pieces of an operation are counted as one.
    pub of_edge: bool,
}

/// The worst of many deviations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// Deviation [mm], not negative.
    pub depth: f64,
    /// Its place [part coordinates, mm].
    pub point: DVec3,
    /// The cut.
    pub cut: CutId,
}

impl BoreMeasure {
    /// Least and greatest radius found [mm], of a round wall that was measured; of a conical one as at the bottom.
    pub fn radius(&self) -> Option<[f64; 2]> {
        let wanted = self.wanted_radius.filter(|_| self.wall[0].is_finite())?;
        Some([wanted - self.wall[1], wanted - self.wall[0]])
    }

    /// The stock found on the wall, in words; `None` where it was not measured.
    pub(crate) fn stock_on_wall(&self) -> Option<String> {
        /// A deviation that is shown as none [mm].
        const SMALL: f64 = 1e-4;
        let [least, most] = self.wall;
        (least <= most).then(|| match least.abs() < SMALL && most.abs() < SMALL {
            true => "under 0.1 \u{b5}m off".to_owned(),
            false => format!("stock of {} to {}", micrometres(least), micrometres(most)),
        })
    }

    /// The larger of stock left and gouge [mm].
    pub fn worst(&self) -> f64 {
        self.left.depth.max(self.gouge.depth)
    }
}

impl Worst {
    pub(crate) fn note(&mut self, depth: f64, point: DVec3, cut: CutId) {
        if depth > self.depth {
            *self = Worst { depth, point, cut };
        }
    }
}

/// Measures of one milled face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceMeasure {
    /// Number of the operation over all setups.
    pub operation: u32,
    /// Least and greatest height found above the finished plane [mm]; not finite when no line runs through the face.
    pub height: [f64; 2],
    /// Number of line ends measured.
    pub ends: usize,
    /// Worst stock left [mm], where, and by which cut.
    pub left: Worst,
    /// Worst cut below the plane by this operation [mm], where, and by which cut.
    pub gouge: Worst,
}

/// A place at which the engagement of a drill's point is measured in the stock as it is before an item is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Index of the setup.
    pub setup: usize,
    /// Index of the item of the setup's program: the first one that drills there.
    pub item: u32,
    /// A point of the drill's axis [part coordinates, mm].
    pub at: DVec3,
    /// Direction from tip to holder [part coordinates].
    pub out: DVec3,
    /// The drill's edge.
    pub edge: EdgeProfile,
}

/// A loose core that leaves the stock: one that a person takes out while the program stands, or that of an annular
/// drill after it has broken through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loose {
    /// Index of the item of the program at which the core leaves.
    pub item: u32,
    /// Centre of its upper end [part coordinates].
    pub centre: DVec3,
    /// Direction out of the bore, a unit vector [part coordinates].
    pub out: DVec3,
    /// Diameter [mm].
    pub diameter: f64,
    /// Depth from its upper end [mm].
    pub depth: f64,
}

/// A loose core that a person takes out while the program waits at `M0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TakenOut {
    /// Centre of its upper end, in coordinates of the work offset [mm].
    pub centre: DVec3,
    /// Direction out of the bore, in coordinates of the work offset: a unit vector.
    pub out: DVec3,
    /// Diameter [mm].
    pub diameter: f64,
    /// Depth from its upper end down [mm].
    pub depth: f64,
}

/// A height at which the walls of the stock are measured before an item is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallProbe {
    /// Index of the setup.
    pub setup: usize,
    /// Index of the item of the setup's program: the first one that mills there.
    pub item: u32,
    /// Direction from the tool's tip to its holder [part coordinates].
    pub out: DVec3,
    /// Height of the finished plane along `out` [part coordinates, mm].
    pub height: f64,
}

/// Something proven, with the bound on what can have been missed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proof {
    /// The claim.
    pub claim: String,
    /// The bound below which something can have been missed, in words with numbers ("below 0.2 mm across the lines, exact along them").
    pub bound: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stock_on_a_wall_has_one_sign_a_number() {
        let of = |wall| {
            let m = BoreMeasure {
                operation: 0,
                wanted_radius: None,
                wall,
                floor: None,
                ends: 1,
                left: Worst::default(),
                gouge: Worst::default(),
                replaced: false,
                of_edge: false,
            };
            m.stock_on_wall()
        };
        assert_eq!(of([f64::INFINITY, f64::NEG_INFINITY]), None);
        assert_eq!(of([-9e-5, 9e-5]).as_deref(), Some("under 0.1 \u{b5}m off"));
        assert_eq!(of([-2e-4, 0.0]).as_deref(), Some("stock of -0.2 \u{b5}m to 0.0 \u{b5}m"));
        assert_eq!(of([0.0, 0.4]).as_deref(), Some("stock of 0.0 \u{b5}m to +400 \u{b5}m"));
    }
}
