//! Shift and rotation that are in force.

use glam::{DVec2, DVec3};

use crate::geom::Rigid;
use crate::nc::dialect::TurnWord;
use crate::nc::turn;
use crate::program::WorkOffset;

use super::zeros::Zeros;

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
    /// Zeros of the work offsets that the program has set.
    pub(super) zeros: Zeros,
    /// Axes whose coordinates were given to a place that was not known, and of which those were taken back.
    pub(super) given: [bool; 3],
    pub(super) adrift: [bool; 3],
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
            zeros: Zeros::default(),
            given: [false; 3],
            adrift: [false; 3],
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

    /// Maps coordinates into the work offset as the setup has it.
    pub(super) fn motion_of(&self, word: TurnWord, offset: WorkOffset) -> Rigid {
        let motion = self.within(word, offset);
        Rigid { translation: motion.translation + self.zeros.shift(offset), ..motion }
    }

    fn within(&self, word: TurnWord, offset: WorkOffset) -> Rigid {
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

    /// Zeros and rotations of the work offsets, as numbers.
    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        self.offsets.iter().map(|(_, degrees)| *degrees).chain(self.zeros.numbers())
    }

    /// Turns a work offset [deg].
    pub(super) fn turn_offset(&mut self, offset: WorkOffset, degrees: f64) {
        match self.offsets.iter_mut().find(|o| o.0 == offset) {
            Some(found) => found.1 = degrees,
            None => self.offsets.push((offset, degrees)),
        }
    }

    /// Rotation of a work offset.
    pub(super) fn of(&self, offset: WorkOffset) -> f64 {
        self.offsets.iter().find(|o| o.0 == offset).map_or(0.0, |o| o.1)
    }
}
