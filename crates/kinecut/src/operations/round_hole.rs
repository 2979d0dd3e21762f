//! Round holes that are there when an operation begins: those of the raw stock, and those that operations before it leave.

use glam::{DVec2, DVec3};

use super::Setting;
use super::wanted::{Wall, WantedWall};
use crate::geom::{EdgeProfile, Rigid};

/// A round hole along the Z of an operation's coordinates [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RoundHole {
    /// Centre.
    pub(crate) centre: DVec2,
    /// Diameter.
    pub(crate) diameter: f64,
    /// Height of its rim.
    pub(crate) top: f64,
    /// Lowest height at which it has its diameter all round.
    pub(crate) bottom: f64,
    /// Whether it is open below.
    pub(crate) through: bool,
    /// Form of its floor, where it has one that is known.
    pub(crate) floor: Option<HoleFloor>,
}

/// The floor of a blind hole, as the tool has left it that made it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HoleFloor {
    /// Height of the tool's tip, where its edge has the height 0 [mm].
    pub(crate) tip: f64,
    /// The edge, from the axis to the radius of the hole.
    pub(crate) edge: EdgeProfile,
}

/// A hole that an operation leaves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MadeHole {
    /// The hole, in coordinates of that operation.
    pub(crate) hole: RoundHole,
    /// Maps these into those of the part.
    pub(crate) to_part: Rigid,
}

/// Length that is rounding [mm].
const ROUNDING: f64 = 1e-6;

impl RoundHole {
    /// A wanted wall as a hole; `None` unless it is a cylinder.
    pub(crate) fn of_wall(wall: &WantedWall) -> Option<RoundHole> {
        let Wall::Round { radii: [upper, lower], .. } = wall.wall else { return None };
        ((upper - lower).abs() <= ROUNDING).then_some(RoundHole {
            centre: wall.centre,
            diameter: 2.0 * lower,
            top: wall.top,
            bottom: wall.floor.unwrap_or(wall.bottom),
            through: wall.floor.is_none(),
            floor: None,
        })
    }

    /// The hole under a motion; `None` where it is no longer along Z, or no longer open above.
    fn moved(&self, motion: &Rigid) -> Option<RoundHole> {
        let ends = [self.top, self.bottom].map(|z| motion.point(self.centre.extend(z)));
        let along = motion.vector(DVec3::Z).z;
        // Seen from its other side, one that goes through is the same hole.
        let is_turned = along < ROUNDING - 1.0 && self.through;
        let [top, bottom] = if is_turned { [ends[1], ends[0]] } else { ends };
        (along > 1.0 - ROUNDING || is_turned).then_some(RoundHole {
            centre: top.truncate(),
            top: top.z,
            bottom: bottom.z,
            floor: self.floor.map(|f| HoleFloor { tip: f.tip + (bottom.z - self.bottom), ..f }),
            ..*self
        })
    }
}

impl MadeHole {
    /// Its upper and its lower end in part coordinates; of a floor whose form is known, the place of the tip.
    pub(crate) fn ends(&self) -> [DVec3; 2] {
        let low = self.hole.floor.map_or(self.hole.bottom, |floor| floor.tip);
        [self.hole.top, low].map(|z| self.to_part.point(self.hole.centre.extend(z)))
    }
}

impl Setting<'_> {
    /// The round holes along Z that are there when the operation begins, in its coordinates.
    pub(crate) fn holes(&self) -> Vec<RoundHole> {
        let to_work = self.clamping.to_work();
        let floor = self.stock.bounds().min.z;
        let raw = self.drilled.iter().filter_map(|d| {
            let hole = RoundHole {
                centre: d.base.truncate(),
                diameter: d.diameter,
                top: d.base.z + d.height,
                bottom: d.base.z,
                through: d.base.z <= floor + ROUNDING,
                floor: None,
            };
            hole.moved(&to_work)
        });
        raw.chain(self.made.iter().filter_map(|m| m.hole.moved(&to_work.after(&m.to_part)))).collect()
    }
}
