//! Sizes, masses and errors of a machine that is not built yet.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};

use glam::DVec3;

use crate::machine::Elementary;

/// Sizes of a machine that is not built yet.
#[derive(Clone, Debug, PartialEq)]
pub struct Sizes {
    /// Strokes of X, Y, Z [mm] that the machine has; without a part also those that are drawn and scored.
    pub stroke: [f64; 3],
    /// Size of the part in X, Y, Z [mm]. It lies on the table, whose rotary axes pass through the middle of its foot;
    /// strokes are then those that it needs.
    pub part: Option<[f64; 3]>,
    /// Distance from the tip of the tool to the rotary axes of a head [mm].
    pub tool_length: f64,
    /// Ranges of A, B, C, 7, 8, 9 in the sense of the code [rad]; a table axis that turns the work counts as the tool
    /// relative to the work. Without a range an axis turns freely.
    pub rotary: [Option<[f64; 2]>; 6],
    /// Directions of the rotations 7, 8, 9.
    pub inclined: [DVec3; 3],
    /// Direction of the spindle at home, from the tip of the tool to the holder.
    pub spindle: DVec3,
    /// Greatest tilt of the tool at which the part is worked [rad].
    pub worked_tilt: f64,
}

impl Default for Sizes {
    fn default() -> Sizes {
        let tilting = Some([-2.0 * PI / 3.0, 2.0 * PI / 3.0]);
        Sizes {
            stroke: [600.0, 500.0, 500.0],
            part: None,
            tool_length: 200.0,
            rotary: [tilting, tilting, None, None, None, None],
            inclined: [DVec3::new(0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2); 3],
            spindle: DVec3::Z,
            worked_tilt: FRAC_PI_2,
        }
    }
}

impl Sizes {
    /// Direction of a motion.
    pub fn direction(&self, motion: Elementary) -> DVec3 {
        let declared = || self.inclined[usize::from(motion.digit().clamp(7, 9)) - 7];
        motion.direction().or_else(|| declared().try_normalize()).unwrap_or(DVec3::Z)
    }

    /// Direction of the spindle at home, of length one.
    pub(super) fn spindle(&self) -> DVec3 {
        self.spindle.try_normalize().unwrap_or(DVec3::Z)
    }

    /// Range of a rotation [rad]; a whole turn where it turns freely.
    pub fn range(&self, motion: Elementary) -> [f64; 2] {
        self.limit(motion).unwrap_or([-PI, PI])
    }

    /// Range of a rotation [rad], if it has one below a whole turn.
    pub(super) fn limit(&self, motion: Elementary) -> Option<[f64; 2]> {
        let index = usize::from(motion.digit()).checked_sub(4)?;
        self.rotary.get(index).copied().flatten().filter(|[low, high]| high - low < 2.0 * PI)
    }
}

/// Masses, in any unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Masses {
    /// Mass of a link that has no mass of its own.
    pub link: f64,
    /// The workpiece.
    pub work: f64,
    /// The spindle with its tool.
    pub tool: f64,
    /// Links of their own: the moving body of the axis with digits 1 to 9.
    pub own: [Option<f64>; 9],
}

impl Default for Masses {
    fn default() -> Masses {
        Masses { link: 1.0, work: 1.0, tool: 1.0, own: [None; 9] }
    }
}

impl Masses {
    /// Mass of the moving body of an axis.
    pub fn of(&self, motion: Elementary) -> f64 {
        self.own[usize::from(motion.digit()) - 1].unwrap_or(self.link)
    }
}

/// Standard deviations of the small errors of a link, the same in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkErrors {
    /// Of each of three shifts [mm].
    pub shift: f64,
    /// Of each of three turns [rad].
    pub turn: f64,
}

impl Default for LinkErrors {
    fn default() -> LinkErrors {
        LinkErrors { shift: 0.003, turn: 2e-5 }
    }
}
