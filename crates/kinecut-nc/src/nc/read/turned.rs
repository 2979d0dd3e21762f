//! Shift and rotation that are in force.

use glam::{DVec2, DVec3};

use crate::geom::Rigid;
use crate::nc::dialect::TurnWord;
use crate::nc::turn;
use crate::program::WorkOffset;

/// Shifts and turns of the coordinates; mm, degrees.
#[derive(Clone, Debug)]
pub(super) struct Turned {
    /// Shift of all work offsets, or programmable shift.
    pub(super) shift: DVec3,
    pub(super) degrees: f64,
    /// Centre of the rotation (FANUC).
    pub(super) centre: DVec2,
    /// Rotation of each work offset (LinuxCNC).
    pub(super) offsets: Vec<(WorkOffset, f64)>,
    /// Maps the coordinates into the work offset.
    pub(super) motion: Rigid,
    /// Axes in which an increment has two meanings.
    pub(super) fresh: [bool; 3],
}

impl Default for Turned {
    fn default() -> Turned {
        Turned {
            shift: DVec3::ZERO,
            degrees: 0.0,
            centre: DVec2::ZERO,
            offsets: Vec::new(),
            motion: Rigid::IDENTITY,
            fresh: [false; 3],
        }
    }
}

impl Turned {
    /// Whether the coordinates are turned.
    pub(super) fn is_turned(&self) -> bool {
        self.motion.rotation != glam::DMat3::IDENTITY
    }

    /// Whether the coordinates are those of the work offset.
    pub(super) fn is_none(&self) -> bool {
        self.motion == Rigid::IDENTITY && self.offsets.iter().all(|o| o.1 == 0.0)
    }

    pub(super) fn motion(&self, word: TurnWord, offset: WorkOffset) -> Rigid {
        match word {
            TurnWord::Offset => turn::motion(word, self.shift, self.of(offset)),
            TurnWord::Local if self.degrees != 0.0 && self.centre != DVec2::ZERO => {
                let rotation = turn::rotation(self.degrees);
                let centre = self.centre.extend(0.0);
                Rigid { rotation, translation: self.shift + centre - rotation * centre }
            }
            _ => turn::motion(word, self.shift, self.degrees),
        }
    }

    /// Rotation of a work offset.
    pub(super) fn of(&self, offset: WorkOffset) -> f64 {
        self.offsets.iter().find(|o| o.0 == offset).map_or(0.0, |o| o.1)
    }
}
